"""Kernels of static lines: one uniform line (`uniform`), and a line of many parts (`pieces`, `walk`, `newton`)."""
