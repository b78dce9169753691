"""Comparisons of computed with known results: the SR179 report (1982) repeated, other programs, laws of waves.

Only the command line imports this package.
"""
