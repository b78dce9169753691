"""Linear equations of a chain of nodes, three unknowns each: block Gauss elimination in O(N).

    −B[j−1] x[j−1] + D[j] x[j] − B[j] x[j+1] = r[j],    j = first … last

D + D^T is positive definite for a line (mass on the diagonal, tension not negative), so no pivoting is needed
between blocks; within a block the inverse is written out.
"""

from __future__ import annotations

from bem.kernels.jit import kernel


@kernel(inline=True)
def invert(a):
    """Inverse of a (3, 3) matrix, in place."""
    a00, a01, a02 = a[0, 0], a[0, 1], a[0, 2]
    a10, a11, a12 = a[1, 0], a[1, 1], a[1, 2]
    a20, a21, a22 = a[2, 0], a[2, 1], a[2, 2]
    c00, c01, c02 = a11 * a22 - a12 * a21, a12 * a20 - a10 * a22, a10 * a21 - a11 * a20
    f = 1.0 / (a00 * c00 + a01 * c01 + a02 * c02)
    a[0, 0], a[1, 0], a[2, 0] = f * c00, f * c01, f * c02
    a[0, 1], a[1, 1], a[2, 1] = f * (a02 * a21 - a01 * a22), f * (a00 * a22 - a02 * a20), f * (a01 * a20 - a00 * a21)
    a[0, 2], a[1, 2], a[2, 2] = f * (a01 * a12 - a02 * a11), f * (a02 * a10 - a00 * a12), f * (a00 * a11 - a01 * a10)


@kernel()
def factor(D, B, first, last):
    """Replace D[first … last] by the inverses of its pivots; B[j] joins nodes j and j + 1."""
    for j in range(first, last + 1):
        if j > first:
            P, C, A = D[j - 1], B[j - 1], D[j]
            for m in range(3):
                w0 = C[m, 0] * P[0, 0] + C[m, 1] * P[1, 0] + C[m, 2] * P[2, 0]
                w1 = C[m, 0] * P[0, 1] + C[m, 1] * P[1, 1] + C[m, 2] * P[2, 1]
                w2 = C[m, 0] * P[0, 2] + C[m, 1] * P[1, 2] + C[m, 2] * P[2, 2]
                for n in range(3):
                    A[m, n] -= w0 * C[0, n] + w1 * C[1, n] + w2 * C[2, n]
        invert(D[j])


@kernel()
def substitute(D, B, r, x, first, last):
    """x of factored equations; r is overwritten and may be x itself."""
    for j in range(first + 1, last + 1):
        P, C = D[j - 1], B[j - 1]
        y0 = P[0, 0] * r[j - 1, 0] + P[0, 1] * r[j - 1, 1] + P[0, 2] * r[j - 1, 2]
        y1 = P[1, 0] * r[j - 1, 0] + P[1, 1] * r[j - 1, 1] + P[1, 2] * r[j - 1, 2]
        y2 = P[2, 0] * r[j - 1, 0] + P[2, 1] * r[j - 1, 1] + P[2, 2] * r[j - 1, 2]
        for m in range(3):
            r[j, m] += C[m, 0] * y0 + C[m, 1] * y1 + C[m, 2] * y2
    for j in range(last, first - 1, -1):
        if j < last:
            C = B[j]
            for m in range(3):
                r[j, m] += C[m, 0] * x[j + 1, 0] + C[m, 1] * x[j + 1, 1] + C[m, 2] * x[j + 1, 2]
        P, y0, y1, y2 = D[j], r[j, 0], r[j, 1], r[j, 2]
        for m in range(3):
            x[j, m] = P[m, 0] * y0 + P[m, 1] * y1 + P[m, 2] * y2
