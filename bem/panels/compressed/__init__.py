"""Influence matrices of very many panels in blocks of low rank: n log n in place of n², solved by iteration."""
