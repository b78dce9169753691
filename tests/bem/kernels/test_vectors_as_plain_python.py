"""Operations on vectors of eight numbers with the compiler off: numpy arrays in place of machine vectors."""

import numpy as np

from hakobune.bem.kernels import simd_plain as plain


def test_a_vector_is_eight_numbers_of_an_array_from_a_place_on():
    table = np.arange(24.0).reshape(4, 6)
    pointer = plain.address(table)
    one = plain.load_vector(pointer, 3)
    assert one.tolist() == [3, 4, 5, 6, 7, 8, 9, 10]
    one[0] = 99.0
    assert table[0, 3] == 3  # a copy
    plain.store_vector(pointer, 10, one)
    assert pointer.tolist() == [*range(10), 99, *range(4, 11), *range(18, 24)]
    assert table[1, 4] == 99.0  # but of the array itself
    assert plain.repeated(2.5).tolist() == [2.5] * 8
    low, high = plain.split_halves(plain.load_vector(pointer, 0))
    assert low.tolist() == [0, 1, 2, 3] and high.tolist() == [4, 5, 6, 7]
    assert plain.to_scalars(low) == (0, 1, 2, 3)


def test_choices_roots_and_exponents_are_those_of_each_number():
    a, b = np.array([1.0, 2.0, 3.0]), np.array([2.0, 2.0, 1.0])
    assert plain.choose_less(a, b, 10 * a, -b).tolist() == [10, -2, -1]
    assert plain.root(np.array([4.0, 9.0])).tolist() == [2, 3]
    exponents, fractions = plain.exponents_and_fractions(np.array([1.0, 6.0, 0.75]))
    assert exponents.tolist() == [0, 2, -1] and fractions.tolist() == [1.0, 1.5, 1.5]


def test_the_bits_of_a_number_are_an_integer():
    """0.5 and 1 are one apart in the exponent, 2⁵²"""
    assert plain.float_to_bits(1.0) - plain.float_to_bits(0.5) == 1 << 52
    assert plain.bits_to_float(plain.float_to_bits(-3.25)) == -3.25
