"""The computed comparisons of the SR179 report (1982), chapter 2, repeated: databases, tables, pictures.

The report prints them as figures only, so that the results here are compared with its text, not with its numbers.
"""
