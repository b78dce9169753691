"""The computed comparisons of the SR179 report (1982), chapter 2, repeated: databases, tables, pictures.

The report prints these results as figures only, so they are compared with its text, not with its numbers.
"""
