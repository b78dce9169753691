"""The operations of `bem.kernels.simd` on numpy arrays, for kernels that run with the compiler off.

A pointer is the flat view of an array, and a vector is an array of 8, 4 or 2 doubles.
"""

import numpy as np


def address(array):
    """Flat view of a contiguous array"""
    return array.reshape(-1)


def load_vector(pointer, n):
    """Elements n … n + 7 of the array that is `pointer`"""
    return pointer[n : n + 8].copy()


def repeated(number):
    """A vector of eight elements that are all equal to a number"""
    return np.full(8, number)


def split_halves(a):
    """The first and the second half of a vector"""
    half = len(a) // 2
    return a[:half], a[half:]


def to_scalars(a):
    """The elements of a vector as a tuple of numbers"""
    return tuple(a)


def store_vector(pointer, n, a):
    """Write a vector of eight to the elements n … n + 7 of the array that is `pointer`."""
    pointer[n : n + 8] = a


def choose_less(a, b, x, y):
    """x where a < b, y elsewhere"""
    return np.where(a < b, x, y)


def root(a):
    """Square root"""
    return np.sqrt(a)


def exponents_and_fractions(a):
    """k and m of a = m 2ᵏ with 1 ≤ m < 2"""
    fraction, exponent = np.frexp(a)
    return exponent - 1.0, 2.0 * fraction


def float_to_bits(number):
    """The 64 bits of a number as an integer"""
    return np.float64(number).view(np.int64)


def bits_to_float(integer):
    """The number with these 64 bits"""
    return np.int64(integer).view(np.float64)
