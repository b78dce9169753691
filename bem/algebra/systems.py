"""Linear systems of several symmetry classes; small systems are solved in parallel, each on one thread."""

import numpy as np

from ..kernels.threads import blas_threads, parallel_rows
from .real_times_complex import real_times_complex

# up to which a system runs on one thread of BLAS beside the others: four of 944 unknowns, by two threads of BLAS one
# after another, took four times as long on a machine whose second core was taken, and as long where it was free
SIDE_BY_SIDE = 3000
# residual relative to the right-hand side, above which A alone is too near to being singular
LARGEST_RESIDUAL = 1e-10
# unknowns from which real matrices are factored in single precision, in half the time, and their solutions refined
WORTH_REFINING = 500
ENOUGH, STEPS = 1e-12, 4  # residual that ends the refinement, and its most steps: of 3 136 unknowns 1e-6, 1e-13


def solved_systems(matrices, sides):
    """Solutions (n, columns) of matrices[i] x = sides[i], a list; NaN where a matrix is singular

    matrices : (c, n, n), real or complex; sides : right-hand sides, c arrays (n, columns)
    """
    solve = _solved if np.iscomplexobj(matrices) else _real
    return _each(lambda i: solve(matrices[i], sides[i]), len(sides), len(sides[0]) if len(sides) else 0)


def solved_beside_few(equations, counts):
    """Solutions (n, columns) of (A + i U Vᵀ) x = b, a list, NaN where a matrix is singular, and the largest residual.

    equations : real A (c, n, n), U and V (c, n, t) with few t, and complex b (c, n, columns); counts : number of
    columns of each of the c systems

    A is factored as a real matrix, which takes a quarter of the time, and x follows by the Woodbury identity. If A is
    nearly singular, the complex system is solved.
    """
    A, U, V, b = equations
    found = _each(lambda i: _beside_few(A[i], U[i], V[i], b[i][:, : counts[i]]), len(counts), A.shape[1])
    return [x for x, _ in found], float(np.max([left for _, left in found], initial=0.0))


def _each(solve, count, n):
    """[solve(i)] of so many systems of n unknowns"""
    out = [None] * count

    def work(low, high):
        for i in range(low, high):
            out[i] = solve(i)

    if n > SIDE_BY_SIDE:
        work(0, count)
        return out
    with blas_threads(1):
        parallel_rows(work, count, n * n * count)
    return out


def _solved(matrix, side):
    try:
        return np.linalg.solve(matrix, side)  # numpy's solve releases the interpreter lock, scipy's does not
    except np.linalg.LinAlgError:
        return np.full(side.shape, np.nan, np.result_type(matrix, side))


def _real(matrix, side):
    none = np.zeros((len(matrix), 0))
    return _beside_few(matrix, none, none, side.astype(complex))[0].real


def _beside_few(A, U, V, b):
    """x and its residual"""
    if len(A) >= WORTH_REFINING:
        x, left = _refined(A, U, V, b)
        if left < LARGEST_RESIDUAL:
            return x, left
    columns = b.shape[1]
    first = _solved(A, np.concatenate([b.real, b.imag, U], axis=1))
    x, of_waves = first[:, :columns] + 1j * first[:, columns : 2 * columns], first[:, 2 * columns :]
    x = x - 1j * (of_waves @ _solved(np.eye(U.shape[1]) + 1j * (V.T @ of_waves), V.T @ x))
    left = _left(A, U, V, b, x)
    if not left < LARGEST_RESIDUAL:
        x = _solved(A + 1j * (U @ V.T), b)
        left = _left(A, U, V, b, x)
    return x, left


def _refined(A, U, V, b):
    """x and its residual, by factors of A in single precision and what they leave of b (Wilkinson 1963)"""
    inverse = _about_inverse(A)
    of_waves = inverse(U)
    few = np.eye(U.shape[1]) + 1j * (V.T @ of_waves)
    x, rest, left = np.zeros_like(b), b, np.inf
    for _ in range(STEPS):
        y = inverse(np.concatenate([rest.real, rest.imag], axis=1))
        y = y[:, : b.shape[1]] + 1j * y[:, b.shape[1] :]
        x = x + y - 1j * (of_waves @ _solved(few, V.T @ y))
        rest = b - real_times_complex(A, x) - 1j * (U @ (V.T @ x))
        left = _relative(rest, b)
        if left < ENOUGH:
            break
    return x, left


def _about_inverse(A):
    """Function of real (n, columns) that gives A⁻¹ times them in single precision; its factors release the interpreter
    lock as numpy's do
    """
    from scipy.linalg.lapack import sgetrf, sgetrs

    # LAPACK wants columns: the transposed view is factored in place and solved transposed
    factors, pivots, _ = sgetrf(A.astype(np.float32).T, overwrite_a=True)
    return lambda b: sgetrs(factors, pivots, b.astype(np.float32), trans=1)[0].astype(float)


def _left(A, U, V, b, x):
    """Largest residual of a column relative to its right-hand side"""
    return _relative(real_times_complex(A, x) + 1j * (U @ (V.T @ x)) - b, b)


def _relative(rest, b):
    """Largest entry of a column relative to that of b, the largest of all columns"""
    return float((np.abs(rest).max(axis=0) / np.maximum(np.abs(b).max(axis=0), 1e-300)).max())
