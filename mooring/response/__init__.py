"""Linear response of a floating body in irregular waves, its drift, and the statistics of both.

`body` reads a database once; `linear` gives transfer functions and response spectra, `points` what a point of the
body feels, `drift`, `slow_drift` and `wave_drift_damping` the forces of second order; `extremes`, `return_period`
and `long_term` turn spectra and records into design values.  `sea_state` and `climate` put them together.
Conventions are those of `bem`; spectra are one-sided in ω, S(ω) in m² s/rad.
"""
