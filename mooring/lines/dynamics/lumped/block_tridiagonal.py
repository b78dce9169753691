"""Linear equations of a chain of nodes, three unknowns each: block Gauss elimination in O(N).

−B[j−1] x[j−1] + D[j] x[j] − B[j] x[j+1] = r[j],    j = first … last

    A[j] = D[j] − W[j] B[j−1],   W[j] = B[j−1] A[j−1]⁻¹,   y[j] = r[j] + W[j] y[j−1],   x[j] = A[j]⁻¹ y[j] + Z[j] x[j+1]

with Z[j] = A[j]⁻¹ B[j]: each pass takes one matrix product per node, down and up; two products would take twice as
long. D + D^T is positive definite for a line (mass on the diagonal, tension not negative), so no pivoting is needed
between blocks. Within a block the inverse is written out.
"""

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import address


@kernel(inline=True, counted=False)
def inverse(a):
    """Inverse of a (3, 3) matrix, both as tuples row by row"""
    a00, a01, a02, a10, a11, a12, a20, a21, a22 = a
    c00, c01, c02 = a11 * a22 - a12 * a21, a12 * a20 - a10 * a22, a10 * a21 - a11 * a20
    f = 1.0 / (a00 * c00 + a01 * c01 + a02 * c02)
    return (
        f * c00,
        f * (a02 * a21 - a01 * a22),
        f * (a01 * a12 - a02 * a11),
        f * c01,
        f * (a00 * a22 - a02 * a20),
        f * (a02 * a10 - a00 * a12),
        f * c02,
        f * (a01 * a20 - a00 * a21),
        f * (a00 * a11 - a01 * a10),
    )


@kernel(inline=True, counted=False)
def product(a, b):
    """a b of (3, 3) matrices as tuples row by row"""
    a0, a1, a2, a3, a4, a5, a6, a7, a8 = a
    b0, b1, b2, b3, b4, b5, b6, b7, b8 = b
    return (
        a0 * b0 + a1 * b3 + a2 * b6,
        a0 * b1 + a1 * b4 + a2 * b7,
        a0 * b2 + a1 * b5 + a2 * b8,
        a3 * b0 + a4 * b3 + a5 * b6,
        a3 * b1 + a4 * b4 + a5 * b7,
        a3 * b2 + a4 * b5 + a5 * b8,
        a6 * b0 + a7 * b3 + a8 * b6,
        a6 * b1 + a7 * b4 + a8 * b7,
        a6 * b2 + a7 * b5 + a8 * b8,
    )


@kernel(inline=True, counted=False)
def column(rows, w, j):
    """Column j of (9, w) rows that a pointer points to"""
    return (
        rows[j],
        rows[w + j],
        rows[2 * w + j],
        rows[3 * w + j],
        rows[4 * w + j],
        rows[5 * w + j],
        rows[6 * w + j],
        rows[7 * w + j],
        rows[8 * w + j],
    )


@kernel(inline=True, counted=False)
def difference(a, b):
    """a − b of tuples of nine"""
    a0, a1, a2, a3, a4, a5, a6, a7, a8 = a
    b0, b1, b2, b3, b4, b5, b6, b7, b8 = b
    return (a0 - b0, a1 - b1, a2 - b2, a3 - b3, a4 - b4, a5 - b5, a6 - b6, a7 - b7, a8 - b8)


@kernel(inline=True, counted=False)
def put(memory, at, a):
    """Write a tuple of nine into memory[at …] of a pointer"""
    (
        memory[at],
        memory[at + 1],
        memory[at + 2],
        memory[at + 3],
        memory[at + 4],
        memory[at + 5],
        memory[at + 6],
        memory[at + 7],
        memory[at + 8],
    ) = a


@kernel(counted=False)
def factor(D, B, pivots, first, last):
    """pivots[j], j = first … last: A⁻¹, W and Z of the blocks D[:, j] and B[:, j + 1], which joins nodes j and j + 1.

    D, B : (9, w) as in `workspace.Work`; pivots : (n, 27)
    """
    w, nodes, elements, out = D.shape[1], address(D), address(B), address(pivots)
    A = inverse(column(nodes, w, first))
    put(out, 27 * first, A)
    for j in range(first + 1, last + 1):
        C = column(elements, w, j)
        put(out, 27 * (j - 1) + 18, product(A, C))
        W = product(C, A)
        A = inverse(difference(column(nodes, w, j), product(W, C)))
        put(out, 27 * j, A)
        put(out, 27 * j + 9, W)


@kernel(counted=False)
def substitute(pivots, r, x, first, last):
    """Solution x (3, w) of factored equations for the right-hand side r (3, w), which may be x itself."""
    w, given, out, p = r.shape[1], address(r), address(x), address(pivots)
    a, b, c = given[first], given[w + first], given[2 * w + first]
    out[first], out[w + first], out[2 * w + first] = a, b, c
    for j in range(first + 1, last + 1):
        k = 27 * j + 9
        a, b, c = (
            given[j] + (p[k] * a + p[k + 1] * b + p[k + 2] * c),
            given[w + j] + (p[k + 3] * a + p[k + 4] * b + p[k + 5] * c),
            given[2 * w + j] + (p[k + 6] * a + p[k + 7] * b + p[k + 8] * c),
        )
        out[j], out[w + j], out[2 * w + j] = a, b, c
    a, b, c = 0.0, 0.0, 0.0
    for j in range(last, first - 1, -1):
        k, x0, x1, x2 = 27 * j, out[j], out[w + j], out[2 * w + j]
        y0 = p[k] * x0 + p[k + 1] * x1 + p[k + 2] * x2
        y1 = p[k + 3] * x0 + p[k + 4] * x1 + p[k + 5] * x2
        y2 = p[k + 6] * x0 + p[k + 7] * x1 + p[k + 8] * x2
        if j < last:
            y0 += p[k + 18] * a + p[k + 19] * b + p[k + 20] * c
            y1 += p[k + 21] * a + p[k + 22] * b + p[k + 23] * c
            y2 += p[k + 24] * a + p[k + 25] * b + p[k + 26] * c
        a, b, c = y0, y1, y2
        out[j], out[w + j], out[2 * w + j] = a, b, c
