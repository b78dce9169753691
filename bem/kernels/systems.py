"""Linear systems of several symmetry classes: those of few unknowns side by side, each on one thread."""

from __future__ import annotations

import numpy as np

from .threads import blas_threads, parallel_rows

# up to which a system runs on one thread of BLAS beside the others: four of 944 unknowns, by two threads of BLAS one
# after another, took four times as long on a machine whose second core was taken, and as long where it was free
SIDE_BY_SIDE = 3000


def solved_systems(matrices, sides):
    """Solutions (n, columns) of matrices[i] x = sides[i], a list; NaN where a matrix is singular

    matrices : (c, n, n) real or complex; sides : c of (n, columns)
    """
    out = [None] * len(sides)

    def work(low, high):
        for i in range(low, high):
            try:
                out[i] = np.linalg.solve(matrices[i], sides[i])  # which releases the interpreter lock, scipy's does not
            except np.linalg.LinAlgError:
                out[i] = np.full(sides[i].shape, np.nan, np.result_type(matrices[i], sides[i]))

    n = matrices[0].shape[0] if len(sides) else 0
    if n > SIDE_BY_SIDE:
        work(0, len(sides))
        return out
    with blas_threads(1):
        parallel_rows(work, len(sides), n * n * len(sides))
    return out
