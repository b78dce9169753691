"""Functions of two variables as polynomials of degree 7 in each, piece by piece on a rectangular grid.

In each piece both variables run from −1 to 1; f = Σ c[b, a] xᵃ yᵇ through 8 × 8 Chebyshev nodes, whose error for a
function with its nearest singularity d from the middle of a piece of half-width a is of order (2d/a)⁻⁸, and that of
its gradient 64 times as much per half-width.  One piece is one block of 64 numbers, summed over b in eight lanes and
then over the lanes; two functions of the same x are added between the two sums: 7 ns with the gradient.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import types
from numba.extending import intrinsic

from ..kernels.jit import kernel
from ..kernels.simd import halves, lanes, numbers, plus, times

ORDER = 8


@intrinsic
def address(typing, array):
    """Pointer to the first number of a contiguous array, which the caller has to keep alive.

    Arrays handed from kernel to kernel are counted at every step that is not inlined: 500 ns a pair instead of 50.
    """

    def build(context, builder, signature, arguments):
        return context.make_array(signature.args[0])(context, builder, arguments[0]).data

    return types.CPointer(array.dtype)(array), build


def aligned(array):
    """A copy in which every row of eight is one line of the processor's cache."""
    memory = np.empty(array.size + 8)
    start = -memory.ctypes.data % 64 // 8
    copy = memory[start : start + array.size].reshape(array.shape)
    copy[:] = array
    return copy


@cache
def nodes():
    """(8,) Chebyshev nodes on (−1, 1)"""
    return -np.cos(np.pi * (np.arange(ORDER) + 0.5) / ORDER)


@cache
def _to_powers():
    return np.linalg.inv(np.vander(nodes(), increasing=True))


def sample_points(edges):
    """(8 n,) nodes of n consecutive pieces between `edges`"""
    edges = np.asarray(edges, float)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (middle[:, None] + half[:, None] * nodes()).ravel()


def fitted(values):
    """Coefficients (m n, 8, 8) of m × n pieces, the second variable's pieces outermost, from values (8 n, 8 m)."""
    n, m = values.shape[0] // ORDER, values.shape[1] // ORDER
    T = _to_powers()
    rows = (T @ values.reshape(n, ORDER, -1)).reshape(n, ORDER, m, ORDER) @ T.T
    return np.ascontiguousarray(rows.transpose(2, 0, 3, 1)).reshape(m * n, ORDER, ORDER)


def fitted_line(values):
    """Coefficients (n, 4, 8) of four functions of one variable from values (8 n, 4): in each row two powers of each."""
    return np.einsum("ab,nbf->naf", _to_powers(), values.reshape(-1, ORDER, 4)).reshape(-1, 4, 8)


def slope_error(half, distance):
    """Relative error of the gradient of a function that grows like 1/r, r from `distance` away."""
    return 0.5 * (half / distance) ** 7


def pieces_per_distance(accuracy):
    """Distance to the nearest singularity in half-widths of a piece: the inverse of `slope_error`."""
    return (0.5 / accuracy) ** (1 / 7)


@kernel(inline=True)
def by_second(pieces, n, y):
    """Piece n at y: Σ c[b, a] yᵇ in eight lanes a, and ∂/∂y."""
    s = t = lanes(pieces, 64 * n + 56)
    for b in range(6, 0, -1):
        s = plus(times(s, y), lanes(pieces, 64 * n + 8 * b))
        t = plus(times(t, y), s)
    return plus(times(s, y), lanes(pieces, 64 * n)), t


@kernel(inline=True)
def by_first(c, x):
    """Σ c[a] xᵃ of eight lanes a, and ∂/∂x: the upper half times x⁴, then x², then x, comes onto the lower."""
    square = x * x
    low, high = halves(c)
    s, t = plus(times(high, square * square), low), times(high, 4 * x * square)
    low, high = halves(s)
    low_slope, high_slope = halves(t)
    s, t = plus(times(high, square), low), plus(plus(times(high_slope, square), low_slope), times(high, 2 * x))
    low, high = numbers(s)
    low_slope, high_slope = numbers(t)
    return low + high * x, low_slope + high_slope * x + high


@kernel(inline=True)
def look(pieces, n, x, y):
    """f, ∂f/∂x and ∂f/∂y of piece n."""
    s, t = by_second(pieces, n, y)
    f, fx = by_first(s, x)
    return f, fx, by_first(t, x)[0]


@kernel(inline=True)
def look_line(lines, n, x):
    """Four functions of one variable: even powers in four lanes, odd ones in the others."""
    s = lanes(lines, 32 * n + 24)
    for a in range(2, -1, -1):
        s = plus(times(s, x * x), lanes(lines, 32 * n + 8 * a))
    even, odd = halves(s)
    return numbers(plus(times(odd, x), even))
