"""The environment of a site: wave spectra, spreading over directions, and wave records, generated, read and analysed.

Inside these modules frequencies are circular (rad/s), spectra one-sided in ω (m² s), directions those travelled to
(rad, 0 → +x), and every period is given with its kind.
"""
