"""Linear response and drift of a floating body in irregular waves, and their statistics.

`body` reads a database once; `linear` gives transfer functions and response spectra, `points` responses at points of
the body, `drift`, `slow_drift` and `wave_drift_damping` the forces of second order; `extremes`, `return_period` and
`long_term` turn spectra and records into design values.  `sea_state` and `climate` combine them. Conventions are those
of `bem`; spectra are one-sided in ω, S(ω) in m² s/rad.
"""
