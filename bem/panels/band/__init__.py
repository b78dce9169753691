"""Frequencies of a band that share the work on one body: their equations, low-rank wave matrices, error test and
cost."""
