"""Functions of two variables as polynomials of degree 7 in each variable, piece by piece on a rectangular grid.

In a piece each variable runs from −1 to 1, and f = Σ c[b, a] xᵃ yᵇ passes through 8 × 8 Chebyshev nodes. If the nearest
singularity of the function is at a distance d from the middle of a piece of half-width a, the error is of order
(2d/a)⁻⁸, and the error of the gradient is 64 times as much per half-width.  The 64 coefficients of a piece are
adjacent in memory.
Horner's rule in y runs on SIMD vectors of the eight coefficients of a power of y; then the eight sums are summed in x.
Two functions of one x are added between the two sums.  An evaluation with the gradient takes 7 ns.
"""

from functools import cache

import numpy as np

from ..kernels.jit import kernel
from ..kernels.simd import load_vector, split_halves, to_scalars

ORDER = 8


def aligned(array):
    """A copy that starts on a cache line (64 bytes), so that every row of eight doubles lies in one cache line."""
    memory = np.empty(array.size + 8)
    start = -memory.ctypes.data % 64 // 8
    copy = memory[start : start + array.size].reshape(array.shape)
    copy[:] = array
    return copy


@cache
def nodes():
    """Chebyshev nodes on (−1, 1); shape (8,)"""
    return -np.cos(np.pi * (np.arange(ORDER) + 0.5) / ORDER)


@cache
def _to_powers():
    return np.linalg.inv(np.vander(nodes(), increasing=True))


def sample_points(edges):
    """Nodes of n consecutive pieces between `edges`; shape (8 n,)"""
    edges = np.asarray(edges, float)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (middle[:, None] + half[:, None] * nodes()).ravel()


def fit_pieces(values):
    """Coefficients (m n, 8, 8) of m × n pieces from values (8 n, 8 m) at `sample_points` of x and y; pieces are
    ordered by y, then by x"""
    n, m = values.shape[0] // ORDER, values.shape[1] // ORDER
    T = _to_powers()
    rows = (T @ values.reshape(n, ORDER, -1)).reshape(n, ORDER, m, ORDER) @ T.T
    return np.ascontiguousarray(rows.transpose(2, 0, 3, 1)).reshape(m * n, ORDER, ORDER)


def fit_line(values):
    """Coefficients (n, 4, 8) of four functions of one variable from values (8 n, 4); a row has two powers of each
    function."""
    return np.einsum("ab,nbf->naf", _to_powers(), values.reshape(-1, ORDER, 4)).reshape(-1, 4, 8)


def pieces_per_distance(accuracy):
    """Distance d to the nearest singularity, in half-widths a of a piece, at which ∇(1/r) has the relative `accuracy`.

    The error of the gradient of 1/r on a piece is ½ (a/d)⁷ times the gradient.
    """
    return (0.5 / accuracy) ** (1 / 7)


@kernel(inline=True)
def sum_over_y(pieces, n, y):
    """Sum Σ_b c[b, a] yᵇ of piece n as a SIMD vector over a = 0 … 7, and its ∂/∂y"""
    s = t = load_vector(pieces, 64 * n + 56)
    for b in range(6, 0, -1):
        s = s * y + load_vector(pieces, 64 * n + 8 * b)
        t = t * y + s
    return s * y + load_vector(pieces, 64 * n), t


@kernel(inline=True)
def sum_over_x(c, x):
    """Σ_a c[a] xᵃ of a SIMD vector c, and its ∂/∂x, by halves: the upper half times x⁴ (then x², x) plus the lower
    half"""
    square = x * x
    low, high = split_halves(c)
    s, t = high * (square * square) + low, high * (4 * x * square)
    low, high = split_halves(s)
    low_slope, high_slope = split_halves(t)
    s, t = high * square + low, high_slope * square + low_slope + high * (2 * x)
    low, high = to_scalars(s)
    low_slope, high_slope = to_scalars(t)
    return low + high * x, low_slope + high_slope * x + high


@kernel(inline=True)
def evaluate_piece(pieces, n, x, y):
    """f, ∂f/∂x and ∂f/∂y of piece n at −1 ≤ x, y ≤ 1; pieces : `address` of coefficients of `fit_pieces`"""
    s, t = sum_over_y(pieces, n, y)
    f, fx = sum_over_x(s, x)
    return f, fx, sum_over_x(t, x)[0]


@kernel(inline=True)
def evaluate_line(lines, n, x):
    """Four functions of one variable on piece n at −1 ≤ x ≤ 1; lines : `address` of coefficients of `fit_line`"""
    s = load_vector(lines, 32 * n + 24)
    for a in range(2, -1, -1):
        s = s * (x * x) + load_vector(lines, 32 * n + 8 * a)
    even, odd = split_halves(s)
    return to_scalars(odd * x + even)
