"""Functions of two variables as polynomials of degree 7 in each, piece by piece on a rectangular grid.

In each piece both variables run from −1 to 1; f = Σ c[a, b] xᵃ yᵇ through 8 × 8 Chebyshev nodes, whose error for a
function with its nearest singularity d from the middle of a piece of half-width a is of order (2d/a)⁻⁸, and that of
its gradient 64 times as much per half-width.  One piece is one block of 64 numbers, summed in one sweep of eight
lanes: 6 ns with the gradient.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import types
from numba.extending import intrinsic

from .jit import kernel

ORDER = 8
# the three bits of b = 0 … 7, those of b − 1, and b
BITS = np.array([[n >> bit & 1 for n in np.arange(ORDER) - less] for less in (0, 1) for bit in range(3)], float)
BITS = np.concatenate([BITS, np.arange(float(ORDER))[None]])


@intrinsic
def address(typing, array):
    """Pointer to the first number of a contiguous array, which the caller has to keep alive.

    Arrays handed from kernel to kernel are counted at every step that is not inlined: 500 ns a pair instead of 50.
    """

    def build(context, builder, signature, arguments):
        return context.make_array(signature.args[0])(context, builder, arguments[0]).data

    return types.CPointer(array.dtype)(array), build


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
    return np.ascontiguousarray(rows.transpose(2, 0, 1, 3)).reshape(m * n, ORDER, ORDER)


def fitted_line(values):
    """Coefficients (n, 8, …) of functions of one variable from values (8 n, …)."""
    return np.einsum("ab,nb...->na...", _to_powers(), values.reshape(-1, ORDER, *values.shape[1:]))


def slope_error(half, distance):
    """Relative error of the gradient of a function that grows like 1/r, r from `distance` away."""
    return 0.5 * (half / distance) ** 7


def pieces_per_distance(accuracy):
    """Distance to the nearest singularity in half-widths of a piece: the inverse of `slope_error`."""
    return (0.5 / accuracy) ** (1 / 7)


@kernel()
def look(pieces, n, x, y):
    """f, ∂f/∂x and ∂f/∂y of piece n.

    Eight lanes b at once; yᵇ is 1, y, y² and y⁴ picked by the bits of b: kept in memory, it would cost 8 ns more.
    """
    f, fx, fy = 0.0, 0.0, 0.0
    one, two = y - 1, y * y - 1
    four = (two + 1) * (two + 1) - 1
    for b in range(8):
        m = 64 * n + b
        s = pieces[m + 56]
        t = s
        s = s * x + pieces[m + 48]
        t = t * x + s
        s = s * x + pieces[m + 40]
        t = t * x + s
        s = s * x + pieces[m + 32]
        t = t * x + s
        s = s * x + pieces[m + 24]
        t = t * x + s
        s = s * x + pieces[m + 16]
        t = t * x + s
        s = s * x + pieces[m + 8]
        t = t * x + s
        s = s * x + pieces[m]
        power = (1 + one * BITS[0, b]) * (1 + two * BITS[1, b]) * (1 + four * BITS[2, b])
        slope = (1 + one * BITS[3, b]) * (1 + two * BITS[4, b]) * (1 + four * BITS[5, b]) * BITS[6, b]
        f += s * power
        fx += t * power
        fy += s * slope
    return f, fx, fy


@kernel()
def look_line(lines, n, x):
    """Two functions of one variable, f and g: f, f′, g, g′."""
    b = 16 * n
    f, g, df, dg = lines[b + 14], lines[b + 15], 0.0, 0.0
    for a in range(6, -1, -1):
        df, dg = df * x + f, dg * x + g
        f, g = f * x + lines[b + 2 * a], g * x + lines[b + 2 * a + 1]
    return f, df, g, dg
