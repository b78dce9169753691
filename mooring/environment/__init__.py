"""The environment of a site: wave spectra, their spreading over directions, records of waves made, read and analysed.

Inside these modules frequencies are circular (rad/s), spectra one-sided in ω (m² s), directions those travelled to
(rad, 0 → +x), and a period is never given without its kind.
"""
