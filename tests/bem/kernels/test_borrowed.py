"""Borrowed arrays are the arrays themselves, in tuples and out of them."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.borrowed import borrowed
from hakobune.bem.kernels.jit import kernel


class Held(NamedTuple):
    rows: np.ndarray
    counts: np.ndarray
    factor: float
    none: None


@kernel()
def fill(held, row):
    for j in range(held.rows.shape[1]):
        held.rows[row, j] = held.factor * held.counts[j]
        if held.none is not None:
            held.rows[row, j] = -1.0


@kernel()
def filled(given, times):
    """The sum of an array of the kernel's own that was lent, and what was lent by its caller filled"""
    held, own = borrowed(given), np.zeros((2, given.counts.size))
    lent = borrowed((own, 2.0))
    total = 0.0
    for _ in range(times):
        fill(held, 1)
        for j in range(held.counts.size):
            lent[0][1, j] += lent[1] * held.rows[1, j]
    for j in range(held.counts.size):
        total += lent[0][1, j]
    own[0, 0] = 0.0  # kept until here
    return total


def test_kernels_write_to_what_they_borrow():
    held = Held(np.zeros((2, 5)), np.arange(5), 0.5, None)
    assert filled(held, 3) == 3 * 2.0 * 0.5 * 10
    assert np.array_equal(held.rows, [np.zeros(5), 0.5 * np.arange(5)])


def test_a_borrowed_array_is_not_freed_by_those_who_borrow():
    held = Held(np.ones((2, 1000)), np.arange(1000), 1.0, None)
    for _ in range(200):
        filled(held, 1)
    assert np.array_equal(held.rows[0], np.ones(1000)) and np.array_equal(held.rows[1], np.arange(1000))


@kernel()
def made(rows):
    """An array or None, by a value that the compiler does not know"""
    return np.zeros((2, 3)) if rows > 0 else None


@kernel()
def of_what_may_be_none(rows, times):
    """Lent again and again: what may be None is borrowed too, else it would be freed by those who borrow"""
    own, total = (made(rows), 1.0), 0.0
    for _ in range(times):
        lent = borrowed(own)
        part = lent[0]
        if part is not None:
            total += part[1, 2] + part.size
    return total + own[1]


def test_what_may_be_none_is_not_freed_either():
    assert of_what_may_be_none(1, 50) == 50 * 6 + 1 and of_what_may_be_none(0, 50) == 1
