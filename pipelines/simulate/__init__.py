"""`hakobune simulate` and `animate`: a mooring study in time, seed by seed, into one file."""
