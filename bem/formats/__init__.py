"""Databases in the files of other programs, and back: WAMIT, Nemoh, HAMS, BEMIO (WEC-Sim, HydroChrono), Capytaine.

Each module has `write(values, place)`, which returns the new paths, and `read(place, known)`; both use `values.Values`.
Its numbers have this package's conventions: exp(−iωt), headings that the waves travel to, SI.  The time factor of
WAMIT, HAMS and BEMIO is exp(+iωt): complex numbers are conjugated, amplitudes are unchanged, phases change their sign.
"""
