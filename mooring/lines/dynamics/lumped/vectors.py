"""Eight places at once: three coordinates from rows (3, w) as three SIMD vectors, and operations on SIMD vectors."""

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import choose_less, load_vector, store_vector, to_scalars

TINY = 1e-300  # added under a root in a denominator


@kernel(inline=True, counted=False)
def load_three(rows, w, j):
    """Columns j … j + 7 of the rows (3, w) at a pointer"""
    return load_vector(rows, j), load_vector(rows, w + j), load_vector(rows, 2 * w + j)


@kernel(inline=True, counted=False)
def store_three(rows, w, j, a):
    """Write three vectors into rows (3, w)."""
    x, y, z = a
    store_vector(rows, j, x)
    store_vector(rows, w + j, y)
    store_vector(rows, 2 * w + j, z)


@kernel(inline=True, counted=False)
def minus(a, b):
    """a − b"""
    x, y, z = a
    p, q, r = b
    return x - p, y - q, z - r


@kernel(inline=True, counted=False)
def dot(a, b):
    """a · b"""
    x, y, z = a
    p, q, r = b
    return x * p + y * q + z * r


@kernel(inline=True, counted=False)
def combine(f, a, g, b):
    """The sum f a + g b of two vectors"""
    x, y, z = a
    p, q, r = b
    return f * x + g * p, f * y + g * q, f * z + g * r


@kernel(inline=True, counted=False)
def less(a, b):
    """The smaller number at each place"""
    return choose_less(a, b, a, b)


@kernel(inline=True, counted=False)
def more(a, b):
    """The larger number at each place"""
    return choose_less(a, b, b, a)


@kernel(inline=True, counted=False)
def total(a):
    """Sum of a vector"""
    c = to_scalars(a)
    return ((c[0] + c[1]) + (c[2] + c[3])) + ((c[4] + c[5]) + (c[6] + c[7]))


@kernel(inline=True, counted=False)
def largest(a):
    """Largest number of a vector"""
    c = to_scalars(a)
    return max(max(max(c[0], c[1]), max(c[2], c[3])), max(max(c[4], c[5]), max(c[6], c[7])))
