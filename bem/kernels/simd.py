"""Vectors of 2, 4 or 8 numbers inside a kernel, for polynomials whose coefficients lie side by side.

A loop over eight is made into vectors or not, as the compiler sees fit in each place; these are vectors everywhere,
in pieces of the width that the processor has, and their sums have one order.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, models, register_model

WIDTH = 8
CONTRACT = ("contract",)  # a product and a sum may be one instruction


class Lanes(types.Type):
    def __init__(self, width):
        self.width = width
        super().__init__(name=f"Lanes({width})")


@register_model(Lanes)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.VectorType(ir.DoubleType(), kind.width))


def _filled(builder, kind, number):
    """The vector with `number` in every lane"""
    vector = ir.VectorType(number.type, kind.width)
    first = builder.insert_element(ir.Constant(vector, ir.Undefined), number, ir.Constant(ir.IntType(32), 0))
    return _picked(builder, first, [0] * kind.width)


def _picked(builder, vector, lanes):
    order = ir.Constant(ir.VectorType(ir.IntType(32), len(lanes)), lanes)
    return builder.shuffle_vector(vector, ir.Constant(vector.type, ir.Undefined), order)


@intrinsic
def lanes(typing, pointer, n):
    """Eight numbers from number n on of what `bem.green.piecewise_polynomials.address` points to."""

    def build(context, builder, signature, arguments):
        start = builder.gep(arguments[0], [arguments[1]])
        vector = context.get_value_type(signature.return_type)
        return builder.load(builder.bitcast(start, vector.as_pointer()), align=8)

    return Lanes(WIDTH)(pointer, types.int64), build


@intrinsic
def times(typing, a, x):
    """a x with a number x"""

    def build(context, builder, signature, arguments):
        return builder.fmul(arguments[0], _filled(builder, a, arguments[1]), flags=CONTRACT)

    return a(a, types.float64), build


@intrinsic
def plus(typing, a, b):
    def build(context, builder, signature, arguments):
        return builder.fadd(*arguments, flags=CONTRACT)

    return a(a, a), build


@intrinsic
def halves(typing, a):
    """The first and the second half of the lanes"""
    half = Lanes(a.width // 2)

    def build(context, builder, signature, arguments):
        parts = [_picked(builder, arguments[0], list(range(i, i + half.width))) for i in (0, half.width)]
        return context.make_tuple(builder, signature.return_type, parts)

    return types.UniTuple(half, 2)(a), build


@intrinsic
def numbers(typing, a):
    """The lanes as a tuple of numbers"""

    def build(context, builder, signature, arguments):
        parts = [builder.extract_element(arguments[0], ir.Constant(ir.IntType(32), i)) for i in range(a.width)]
        return context.make_tuple(builder, signature.return_type, parts)

    return types.UniTuple(types.float64, a.width)(a), build


@intrinsic
def bits(typing, number):
    """The 64 bits of a number as an integer"""

    def build(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.int64))

    return types.int64(types.float64), build


@intrinsic
def from_bits(typing, integer):
    """The number with these 64 bits"""

    def build(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.float64))

    return types.float64(types.int64), build
