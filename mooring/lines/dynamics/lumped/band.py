"""Linear equations of a chain of nodes coupled to the next two: block elimination of a band, in O(N).

f[j−2] x[j−2] + (e[j−1] − B[j−1]) x[j−1] + D[j] x[j] + (e[j] − B[j]) x[j+1] + f[j] x[j+2] = r[j],   j = first … last

with numbers e and f for all three coordinates. D and B are those of `block_tridiagonal`. No pivoting is needed, for
the reason given in `block_tridiagonal`.

    M[j] = f[j−2] A[j−2]⁻¹,   L[j] = (e[j−1] − B[j−1] − M[j] U[j−2]) A[j−1]⁻¹
    A[j] = D[j] − f[j−2] M[j] − L[j] U[j−1],   U[j] = e[j] − B[j] − f[j−1] L[j]
    y[j] = r[j] − M[j] y[j−2] − L[j] y[j−1],   x[j] = A[j]⁻¹ (y[j] − U[j] x[j+1] − f[j] x[j+2])
"""

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import address

from .bending import NEXT, OVERNEXT, bends
from .block_tridiagonal import column, difference, factor, inverse, product, put, substitute

OF_BAND = 36  # numbers of each pivot: A⁻¹, U, L and M


@kernel(inline=True, counted=False)
def times(f, a):
    """The product f a of a number and a tuple of nine"""
    a0, a1, a2, a3, a4, a5, a6, a7, a8 = a
    return (f * a0, f * a1, f * a2, f * a3, f * a4, f * a5, f * a6, f * a7, f * a8)


@kernel(inline=True, counted=False)
def taken(memory, at):
    """Nine numbers from memory[at …] of a pointer"""
    return column(memory, 1, at)


@kernel(inline=True, counted=False)
def beside(e, b):
    """The matrix e I − b as a tuple of nine; e is a number, I the unit matrix, b a tuple of nine"""
    b0, b1, b2, b3, b4, b5, b6, b7, b8 = b
    return (e - b0, -b1, -b2, -b3, e - b4, -b5, -b6, -b7, e - b8)


@kernel(counted=False)
def factor_band(D, B, bending, pivots, first, last):
    """pivots[j], j = first … last, of D and B (9, w) as in `block_tridiagonal.factor`

    bending : `Work.bending`, whose last rows are e and f
    """
    w, nodes, elements, out = D.shape[1], address(D), address(B), address(pivots)
    for j in range(first, last + 1):
        A, U = column(nodes, w, j), beside(bending[NEXT, j], column(elements, w, j + 1))
        if j > first:
            at, below = OF_BAND * (j - 1), beside(bending[NEXT, j - 1], column(elements, w, j))
            if j > first + 1:
                f, far_at = bending[OVERNEXT, j - 2], OF_BAND * (j - 2)
                M = times(f, taken(out, far_at))
                A = difference(A, times(f, M))
                below = difference(below, product(M, taken(out, far_at + 9)))
                put(out, OF_BAND * j + 27, M)
            L = product(below, taken(out, at))
            A = difference(A, product(L, taken(out, at + 9)))
            U = difference(U, times(bending[OVERNEXT, j - 1], L))
            put(out, OF_BAND * j + 18, L)
        put(out, OF_BAND * j, inverse(A))
        put(out, OF_BAND * j + 9, U)


@kernel(inline=True, counted=False)
def applied(p, k, x, y, z):
    """Product of the matrix at p[k …] and a vector"""
    return (
        p[k] * x + p[k + 1] * y + p[k + 2] * z,
        p[k + 3] * x + p[k + 4] * y + p[k + 5] * z,
        p[k + 6] * x + p[k + 7] * y + p[k + 8] * z,
    )


@kernel(counted=False)
def substitute_band(pivots, bending, r, x, first, last):
    """Solution x (3, w) of factored equations for the right-hand side r (3, w), which may be x itself."""
    p = address(pivots)
    for j in range(first, last + 1):
        a, b, c = r[0, j], r[1, j], r[2, j]
        if j > first:
            d = applied(p, OF_BAND * j + 18, x[0, j - 1], x[1, j - 1], x[2, j - 1])
            a, b, c = a - d[0], b - d[1], c - d[2]
        if j > first + 1:
            d = applied(p, OF_BAND * j + 27, x[0, j - 2], x[1, j - 2], x[2, j - 2])
            a, b, c = a - d[0], b - d[1], c - d[2]
        x[0, j], x[1, j], x[2, j] = a, b, c
    for j in range(last, first - 1, -1):
        a, b, c = x[0, j], x[1, j], x[2, j]
        if j < last:
            d = applied(p, OF_BAND * j + 9, x[0, j + 1], x[1, j + 1], x[2, j + 1])
            a, b, c = a - d[0], b - d[1], c - d[2]
        if j < last - 1:
            f = bending[OVERNEXT, j]
            a, b, c = a - f * x[0, j + 2], b - f * x[1, j + 2], c - f * x[2, j + 2]
        x[0, j], x[1, j], x[2, j] = applied(p, OF_BAND * j, a, b, c)


@kernel(inline=True, counted=False)
def factor_line(D, B, bending, pivots, last):
    """Pivots of the inner nodes of a line of `last` elements"""
    if bends(bending):
        factor_band(D, B, bending, pivots, 1, last - 1)
    else:
        factor(D, B, pivots, 1, last - 1)


@kernel(inline=True, counted=False)
def substitute_line(pivots, bending, r, x, last):
    """Solution x (3, w) at the inner nodes for the right-hand side r (3, w), which may be x itself"""
    if bends(bending):
        substitute_band(pivots, bending, r, x, 1, last - 1)
    else:
        substitute(pivots, r, x, 1, last - 1)
