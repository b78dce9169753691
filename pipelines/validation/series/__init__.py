"""`hakobune series`: the design series of the SR179 report (1982), computed again and compared with its results."""
