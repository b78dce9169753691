"""Named tuples that kernels take by address hold in a kernel what they hold in Python."""

from typing import NamedTuple

import numpy as np
import pytest
from numba import config

from hakobune.bem.kernels.addresses import laid_out
from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel


@in_memory
class Inner(NamedTuple):
    number: float
    values: np.ndarray


@in_memory
class Outer(NamedTuple):
    count: int
    long: bool
    rows: np.ndarray
    pair: tuple
    inner: Inner
    members: list
    whole: np.ndarray


def outer(n, members):
    made = [Inner(0.5 + i, np.arange(i + 1.0)) for i in range(members)]
    pair = np.full(2, 7.0), Inner(-3.25, np.full((3, 2), 2.0)[1])
    return Outer(n, True, np.arange(2.0 * n).reshape(n, 2), pair, Inner(1.5, np.array([4.0, 8.0])), made,
                 np.arange(n))  # fmt: skip


@kernel(counted=False)
def inside(inner, i):
    return inner.number + inner.values[i]


@kernel(counted=False)
def read(given, out):
    """Every field, through another kernel and in place; a row is changed"""
    plain, deep = given.pair
    total = given.count + (100.0 if given.long else 0.0) + plain[1] + inside(deep, 1) + inside(given.inner, 0)
    for i in range(given.rows.shape[0]):
        total += given.rows[i, 1] + given.whole[i]
    for i in range(out.size):
        out[i] = inside(given.members[i], i)
    given.rows[0, 0] = -1.0
    return total


def test_a_kernel_reads_every_field_and_changes_what_arrays_hold():
    for n, members in ((3, 2), (5, 4)):  # other numbers and lengths of one type
        given, out = outer(n, members), np.zeros(members)
        wanted = n + 100.0 + 7.0 + (-3.25 + 2.0) + (1.5 + 4.0) + given.rows[:, 1].sum() + given.whole.sum()
        assert read(given, out) == pytest.approx(wanted, rel=1e-15)
        assert out == pytest.approx([0.5 + 2 * i for i in range(members)])
        assert given.rows[0, 0] == -1.0
    if not config.DISABLE_JIT:
        assert len(read._entry.overloads) == 1


def test_words_are_numbers_arrays_and_addresses_one_after_the_other():
    inner = Inner(1.5, np.array([[4.0, 8.0]]))
    words = laid_out(inner)
    assert words[:1].view(float)[0] == 1.5
    assert words[1:].tolist() == [0, 0, 2, 8, inner.values.ctypes.data, 1, 2, 16, 8]
    words = laid_out(outer(1, 2))
    place = 2 + 9 + 7  # of `inner` within the pair, behind two numbers, an array of two axes, and one of one
    assert (words[place] - words.ctypes.data) % 8 == 0 and 0 < words[place] - words.ctypes.data < words.nbytes


@in_memory
class Mixed(NamedTuple):
    nothing: None
    whole: int
    three: tuple
    row: list


def test_what_is_not_there_is_a_zero_and_tuples_of_numbers_lie_side_by_side():
    """Each further tuple is laid out once, behind those before it, and lists are the addresses of theirs"""
    rows = [Inner(float(n), np.array([n + 0.5])) for n in (3, 4)]
    given = Mixed(None, np.int64(-7), (1.5, True, np.bool_(False), 2), rows)
    words = laid_out(given)
    assert words[[0, 1, 3, 4, 5]].tolist() == [0, -7, 1, 0, 2] and words[2:3].view(float)[0] == 1.5
    begin = words.ctypes.data
    places = (words[7:9] - begin) // 8  # of both tuples of the list, of 8 words each: a number and an array of one axis
    assert (words[6] - begin) // 8 == 7 and places.tolist() == [9, 17] and len(words) == 25
    for place, row in zip(places, rows, strict=True):
        assert words[place : place + 1].view(float)[0] == row.number
        assert words[place + 1 : place + 8].tolist() == [0, 0, 1, 8, row.values.ctypes.data, 1, 8]
    with pytest.raises(TypeError, match="kernels cannot read a str; allowed: arrays, numbers, tuples of them"):
        laid_out(Inner("one", rows[0].values))


def test_a_field_of_several_words_is_read_word_by_word_after_those_before_it():
    """{number, two integers, {number, number}}: five words, read from the third on, each marked as never changing"""
    from llvmlite import ir

    from hakobune.bem.kernels.addresses import _read, _words

    i64, number = ir.IntType(64), ir.DoubleType()
    kind = ir.LiteralStructType([number, ir.ArrayType(i64, 2), ir.LiteralStructType([number, number])])
    assert [_words(one) for one in (number, i64.as_pointer(), ir.ArrayType(i64, 3), kind)] == [1, 1, 3, 5]
    module = ir.Module()
    made = ir.Function(module, ir.FunctionType(kind, [ir.IntType(8).as_pointer()]), "read")
    builder = ir.IRBuilder(made.append_basic_block())
    whole, after = _read(builder, kind, made.args[0], 2)
    builder.ret(whole)
    text = str(module)
    assert after == 7 and text.count("!invariant.load") == 5
    assert [f"i64 {8 * word}\n" in text for word in range(9)] == [False] * 2 + [True] * 5 + [False] * 2
