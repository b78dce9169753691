"""Row interpolative decomposition: a matrix computed from some of its rows, by randomised pivoted QR.

    A ≈ X A[rows],    X[rows] = 1

with A (n, m), the selected rows (r,), and the interpolation matrix X (n, r) (Cheng, Gimbutas, Martinsson & Rokhlin,
SIAM J. Sci. Comput. 26, 2005). A matrix with very many columns is never stored: pivoted QR selects the same rows from
A Ω, with Ω (m, width) a sparse random sign matrix, which keeps the norm of every combination of rows up to a factor
1 + O(width^(−1/2)) (Martinsson & Tropp, Acta Numerica 29, 2020).
"""

import numpy as np

from ..kernels.jit import kernel
from ..kernels.threads import parallel_rows

ENTRIES = 4  # non-zero entries in each row of Ω
SEED = 1_982
ENTRIES_AT_ONCE = 128  # entries of a column in one block, so that 2048 sums stay in the cache
PRODUCTS_PER_PAIR = 16  # take the time of one pair of point and source
ROUNDING = 1e-12  # rounding of the entries of A Aᵀ or Aᵀ A


class Sketch:
    """R A Ω of a matrix A (n, m) whose columns are added block by block, with R = diag(row_scale)."""

    def __init__(self, row_scale, width):
        """row_scale : (n,)"""
        self.row_scale, self.generator = np.asarray(row_scale, float), np.random.default_rng(SEED)
        self.transposed = np.zeros((width, len(self.row_scale)))

    @property
    def matrix(self):
        """R A Ω (n, width), real"""
        return (self.transposed * self.row_scale).T

    def add(self, *parts, scale=1.0):
        """Append columns to A: the columns of each of several blocks, times `scale`.

        parts : rows of the blocks, (…, nᵢ, m), on top of each other, Σ nᵢ = n; real and imaginary part of a complex
            column count as two columns; m may be 0
        scale : factors that broadcast to (…, m)

        Here weights of rows and columns cost no time, whereas a product for each block would.  One call for all
        blocks of a frequency with their weights takes half the time of a call for each block.
        """
        shape = parts[0].shape[:-2] + parts[0].shape[-1:]
        weights = np.broadcast_to(scale, shape).ravel() / np.sqrt(ENTRIES)
        places = self.generator.integers(0, len(self.transposed), (2, len(weights), ENTRIES), np.uintp)
        signs = (2.0 * self.generator.integers(0, 2, places.shape) - 1.0) * weights[:, None]
        row = 0
        for part in parts:
            self._add(part, places.reshape(-1, ENTRIES), signs.reshape(-1, ENTRIES), row)
            row += part.shape[-2]

    def _add(self, part, places, signs, row):
        def work(first, end):
            block = part[..., first:end, :].swapaxes(-1, -2)
            columns = np.empty((2, *block.shape))
            columns[0], columns[1] = block.real, block.imag
            _add_columns(columns.reshape(len(places), end - first), places, signs, self.transposed, row + first)

        parallel_rows(work, part.shape[-2], places.size * part.shape[-2] // PRODUCTS_PER_PAIR)


@kernel()
def _add_columns(columns, places, signs, sums, row):
    """sums[places[j, e], row + i] += signs[j, e] columns[j, i] for all j, e and i

    A product with a sparse matrix, then added to its rows, takes four times as long with two threads; indices that may
    be negative, which numba tests for, twice as long.
    """
    count = columns.shape[1]
    for start in range(0, count, ENTRIES_AT_ONCE):
        low, high = np.uintp(start), np.uintp(min(start + ENTRIES_AT_ONCE, count))
        for j in range(len(columns)):
            for e in range(ENTRIES):
                place, sign = places[j, e], signs[j, e]
                for i in range(low, high):
                    sums[place, np.uintp(row) + i] += sign * columns[j, i]


def interpolative_decomposition(matrix, tolerance):
    """Return (rows, X) with A ≈ X A[rows]; the error of a row is at most about `tolerance` in the 2-norm.

    matrix : A itself, (n, m), or `Sketch.matrix`; rows : increasing indices, (r,), r ≥ 1; X : (n, r)

    R of pivoted QR is the Cholesky factor of A Aᵀ with the pivots of QR. The Cholesky factorisation ends at the rank
    and takes at most a third of the time of QR. If the square of the tolerance is lost in rounding, R is computed by
    QR.
    """
    from scipy.linalg import solve_triangular

    factor, order, rank = _by_cholesky(matrix, tolerance) or _by_qr(matrix, tolerance)
    X = np.empty((len(matrix), rank))
    X[order[:rank]] = np.eye(rank)
    X[order[rank:]] = solve_triangular(factor[:rank, :rank], factor[:rank, rank:], check_finite=False).T
    sorting = np.argsort(order[:rank])
    return order[:rank][sorting], np.ascontiguousarray(X[:, sorting])


def _by_cholesky(matrix, tolerance):
    """R, its pivots and the rank; None if rounding is as large as the remainder at the rank"""
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
    """x of least norm with A x ≈ b, from singular values of at least `cutoff` times the largest

    A (n, m), n ≥ m, and b (n, k), real.  Unless the square of `cutoff` is lost in rounding, the singular values are
    computed as roots of the eigenvalues of Aᵀ A, which takes a fifth of the time for n = 14 m.
    """
    if cutoff**2 > ROUNDING:
        eigenvalues, V = np.linalg.eigh(A.T @ A)
        kept = eigenvalues > cutoff**2 * eigenvalues[-1]
        return (V[:, kept] / eigenvalues[kept]) @ (V[:, kept].T @ (A.T @ b))
    U, size, Vh = np.linalg.svd(A, full_matrices=False)
    kept = size > cutoff * size[0]
    return (Vh[kept].T / size[kept]) @ (U[:, kept].T @ b)
