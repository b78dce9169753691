"""Row interpolative decomposition: a matrix from some of its own rows, by randomised pivoted QR.

    A ≈ X A[rows],    X[rows] = 1

A (n, m), rows (r,) the selected rows, X (n, r) the interpolation matrix (Cheng, Gimbutas, Martinsson & Rokhlin, SIAM
J. Sci. Comput. 26, 2005).  A matrix with very many columns is never stored: pivoted QR selects the same rows from
A Ω, with Ω (m, width) a sparse random sign matrix, which keeps the norm of every combination of rows up to a factor
1 + O(width^(−1/2)) (Martinsson & Tropp, Acta Numerica 29, 2020).
"""

from __future__ import annotations

import numpy as np

from .jit import kernel
from .threads import parallel_rows

ENTRIES = 4  # of Ω, not zero, in each of its rows
SEED = 1_982
ENTRIES_AT_ONCE = 64  # of a column: those of 2048 sums then stay in the cache
ROUNDING = 1e-12  # of the entries of A Aᵀ


class Sketch:
    """A Ω of a matrix A (n, m) whose columns come block by block."""

    def __init__(self, rows, width):
        self.transposed, self.generator = np.zeros((width, rows)), np.random.default_rng(SEED)

    @property
    def matrix(self):
        """A Ω (n, width), real"""
        return self.transposed.T

    def add(self, block):
        """Append columns (n, m) to A, real or complex; a complex one counts as two, its real and imaginary part"""
        (n, m), width = block.shape, len(self.transposed)
        for part in (block.real, block.imag) if np.iscomplexobj(block) else (block,):
            places = self.generator.integers(0, width, (m, ENTRIES), np.uintp)
            signs = self.generator.choice([-1.0, 1.0], (m, ENTRIES)) / np.sqrt(ENTRIES)
            self._add(np.ascontiguousarray(part.T), places, signs, ENTRIES * n * m)

    def _add(self, columns, places, signs, products):
        def work(first, end):
            _add_columns(columns, places, signs, self.transposed, first, end)

        parallel_rows(work, columns.shape[1], products)


@kernel()
def _add_columns(columns, places, signs, sums, first, end):
    """Entries `first` to `end` of sums[places[j, e]] += signs[j, e] columns[j], for all j and e

    A product with a sparse matrix, then added to the rows that it touches, takes four times as long with two threads.
    """
    for low in range(first, end, ENTRIES_AT_ONCE):
        high = min(low + ENTRIES_AT_ONCE, end)
        for j in range(len(columns)):
            for e in range(ENTRIES):
                place, sign = places[j, e], signs[j, e]
                for i in range(low, high):
                    sums[place, i] += sign * columns[j, i]


def interpolative_decomposition(matrix, tolerance):
    """(rows, X) with A ≈ X A[rows], the error of a row at most about `tolerance` in the 2-norm.

    matrix : (n, m) A itself or `Sketch.matrix`; rows : (r,) increasing, r ≥ 1; X : (n, r)

    R of pivoted QR is the Cholesky factor of A Aᵀ with the same pivots, which ends at the rank and takes a third of the
    time or less; where the square of the tolerance is lost in rounding it is made by QR.
    """
    from scipy.linalg import solve_triangular

    factor, order, rank = _by_cholesky(matrix, tolerance) or _by_qr(matrix, tolerance)
    X = np.empty((len(matrix), rank))
    X[order[:rank]] = np.eye(rank)
    X[order[rank:]] = solve_triangular(factor[:rank, :rank], factor[:rank, rank:], check_finite=False).T
    sorting = np.argsort(order[:rank])
    return order[:rank][sorting], np.ascontiguousarray(X[:, sorting])


def _by_cholesky(matrix, tolerance):
    """R, its pivots and the rank; None if rounding is as large as what is left at the rank"""
    from scipy.linalg.lapack import dpstrf

    gram = matrix @ matrix.T
    if not tolerance**2 > ROUNDING * gram.diagonal().max():
        return None
    factor, order, rank, _ = dpstrf(gram.T, tol=tolerance**2, overwrite_a=True)
    return factor, order - 1, max(int(rank), 1)


def _by_qr(matrix, tolerance):
    from scipy.linalg import qr

    R, order = qr(matrix.T, mode="r", pivoting=True, check_finite=False)
    return R, order, max(int(np.count_nonzero(np.abs(np.diag(R)) > tolerance)), 1)


def truncated_least_squares(A, b, cutoff):
    """x of least norm with A x ≈ b by singular values, those below `cutoff` times the largest left out"""
    U, size, Vh = np.linalg.svd(A, full_matrices=False)
    kept = size > cutoff * size[0]
    return (Vh[kept].T / size[kept]) @ (U[:, kept].T @ b)
