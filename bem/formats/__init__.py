"""Databases written to and read from files of WAMIT, Nemoh, HAMS, BEMIO (WEC-Sim, HydroChrono) and Capytaine.

The function `write(values, place)` of a module takes `values.Values` and returns the new paths; `read(place, known)`
returns `values.Values`, whose numbers have this package's conventions: exp(−iωt), headings that the waves travel to,
SI.  The time factor of WAMIT, HAMS and BEMIO is exp(+iωt): complex numbers are conjugated, amplitudes are unchanged,
phases change their sign.
"""
