"""Influence matrices of very many panels in blocks of low rank, solved by iteration at a cost n log n instead of n²."""
