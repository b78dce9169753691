"""The environment of a site: wave spectra, spreading over directions, and wave records, generated, read and analysed.

In these modules frequencies are circular (rad/s) and spectra are one-sided in ω (m² s). Directions are directions of
travel (rad, 0 → +x). Every period is given with its kind.
"""
