"""Databases in the files of other programs, and back: WAMIT, Nemoh, HAMS, BEMIO (WEC-Sim, HydroChrono), Capytaine.

Each module has `write(values, place)`, returning the paths made, and `read(place, known)`; `values.Values` stands
between.  Its numbers have this package's conventions: exp(−iωt), headings the waves travel to, SI.  The time factor of
WAMIT, HAMS and BEMIO is exp(+iωt): what is complex is conjugated, an amplitude stays, a phase changes its sign.
"""
