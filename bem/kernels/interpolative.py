"""A few rows that stand for all rows of a matrix: interpolative decomposition by pivoted QR.

A ≈ X A[chosen], X[chosen] = 1: the interpolation is exact at the chosen rows, and every other row is a combination
of them (Cheng, Gimbutas, Martinsson & Rokhlin, SIAM J. Sci. Comput. 26, 2005).  A matrix of very many columns is
never kept: random sums of its columns, each with the norm that a row has, choose the same rows.
"""

from __future__ import annotations

import numpy as np

SIGNS = 4  # sums into which each column goes
SEED = 1_982


class Sketch:
    """Random sums of columns (n, width) of a matrix that comes block by block."""

    def __init__(self, rows, width):
        self.transposed, self.generator = np.zeros((width, rows)), np.random.default_rng(SEED)

    @property
    def sums(self):
        """(n, width)"""
        return self.transposed.T

    def add(self, block):
        """Columns (n, m), real or complex; complex ones count as two"""
        from scipy.sparse import csr_matrix

        m, width = block.shape[1], len(self.transposed)
        for part in (block.real, block.imag) if np.iscomplexobj(block) else (block,):
            into = self.generator.integers(0, width, m * SIGNS)
            sign = self.generator.choice([-1.0, 1.0], m * SIGNS) / np.sqrt(SIGNS)
            touched, place = np.unique(into, return_inverse=True)
            scatter = csr_matrix((sign, (place, np.repeat(np.arange(m), SIGNS))), (len(touched), m))
            self.transposed[touched] += scatter @ np.ascontiguousarray(part.T)


def chosen_rows(sums, allowed):
    """(rows, X) with A ≈ X A[rows] to `allowed`, absolute in a row's 2-norm.

    sums : (n, m) of `Sketch`; rows : (r,) increasing; X : (n, r)
    """
    from scipy.linalg import qr, solve_triangular

    R, order = qr(sums.T, mode="r", pivoting=True, check_finite=False)
    rank = max(int(np.count_nonzero(np.abs(np.diag(R)) > allowed)), 1)
    X = np.empty((len(sums), rank))
    X[order[:rank]] = np.eye(rank)
    X[order[rank:]] = solve_triangular(R[:rank, :rank], R[:rank, rank:], check_finite=False).T
    sorting = np.argsort(order[:rank])
    return order[:rank][sorting], np.ascontiguousarray(X[:, sorting])


def least_squares(A, b, allowed):
    """x of least norm with A x ≈ b, leaving out directions in which A is less than `allowed` of its largest"""
    U, size, Vh = np.linalg.svd(A, full_matrices=False)
    kept = size > allowed * size[0]
    return (Vh[kept].T / size[kept]) @ (U[:, kept].T @ b)
