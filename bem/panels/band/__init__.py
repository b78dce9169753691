"""Frequencies of a band that share the work on one body: equations, low-rank wave matrices, error test, cost."""
