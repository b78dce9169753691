"""The computed comparisons of the SR179 report (1982), chapter 2, made again: databases, tables, pictures.

The report prints them as figures only, so that what is here stands beside its words, not beside its numbers.
"""
