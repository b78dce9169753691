"""Influence matrices of very many panels in blocks of low rank: cost n log n instead of n², solved by iteration."""
