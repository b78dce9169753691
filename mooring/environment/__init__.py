"""The environment of a site: wave spectra, spreading over directions, and wave records, generated, read and analysed.

Inside these modules frequencies are circular (rad/s), spectra are one-sided in ω (m² s), and directions are those in
which waves travel (rad, 0 → +x). Every period is given with its kind.
"""
