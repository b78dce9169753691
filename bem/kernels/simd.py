"""SIMD vectors of 2, 4 or 8 doubles inside a kernel, for numbers that are adjacent in memory.

The compiler may or may not vectorise a loop over eight numbers. The operations of this module are always vector
instructions of the processor's width, and add in a fixed order.  They are numba intrinsics on LLVM vector types.  A
polynomial of 8 × 8 coefficients with its gradient takes 7.3 ns; with plain loops over numbers it takes 18.6 ns
(`python tests/bench/simd.py`).  Vectors and numbers are added, subtracted, multiplied and divided with + − * /.

With the compiler off (NUMBA_DISABLE_JIT=1) these names are the functions of `simd_plain`.
"""

import operator

from llvmlite import ir
from numba import config, types
from numba.core.cgutils import get_or_insert_function
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model

WIDTH = 8  # doubles of a vector as it is loaded
CONTRACT = ("contract",)  # a product and a sum may be one instruction


class SimdVector(types.Type):
    """Numba type of a vector of `width` doubles"""

    def __init__(self, width):
        self.width = width
        super().__init__(name=f"SimdVector({width})")


@register_model(SimdVector)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.VectorType(ir.DoubleType(), kind.width))


def _broadcast(builder, kind, number):
    """The vector of `number` repeated"""
    vector = ir.VectorType(number.type, kind.width)
    first = builder.insert_element(ir.Constant(vector, ir.Undefined), number, ir.Constant(ir.IntType(32), 0))
    return _shuffled(builder, first, [0] * kind.width)


def _shuffled(builder, vector, indices):
    order = ir.Constant(ir.VectorType(ir.IntType(32), len(indices)), indices)
    return builder.shuffle_vector(vector, ir.Constant(vector.type, ir.Undefined), order)


@intrinsic
def address(typing, array):
    """Pointer to the first element of a contiguous array, which the caller must keep alive.

    Arrays that are arguments of a kernel which is not inlined are reference-counted: a pair of points then takes 500 ns
    instead of 50.
    """

    def build(context, builder, signature, arguments):
        return context.make_array(signature.args[0])(context, builder, arguments[0]).data

    return types.CPointer(array.dtype)(array), build


@intrinsic
def load_vector(typing, pointer, n):
    """Elements n … n + 7 of the array to which `pointer`, from `address`, points."""

    def build(context, builder, signature, arguments):
        start = builder.gep(arguments[0], [arguments[1]])
        vector = context.get_value_type(signature.return_type)
        return builder.load(builder.bitcast(start, vector.as_pointer()), align=8)

    return SimdVector(WIDTH)(pointer, types.int64), build


@intrinsic
def repeated(typing, number):
    """A vector of eight elements that are all equal to a number"""

    def build(context, builder, signature, arguments):
        return _broadcast(builder, signature.return_type, arguments[0])

    return SimdVector(WIDTH)(types.float64), build


@intrinsic
def split_halves(typing, a):
    """The first and the second half of a vector"""
    half = SimdVector(a.width // 2)

    def build(context, builder, signature, arguments):
        parts = [_shuffled(builder, arguments[0], list(range(i, i + half.width))) for i in (0, half.width)]
        return context.make_tuple(builder, signature.return_type, parts)

    return types.UniTuple(half, 2)(a), build


@intrinsic
def to_scalars(typing, a):
    """The elements of a vector as a tuple of numbers"""

    def build(context, builder, signature, arguments):
        parts = [builder.extract_element(arguments[0], ir.Constant(ir.IntType(32), i)) for i in range(a.width)]
        return context.make_tuple(builder, signature.return_type, parts)

    return types.UniTuple(types.float64, a.width)(a), build


@intrinsic
def store_vector(typing, pointer, n, a):
    """Write a vector of eight to the elements n … n + 7 of the array to which `pointer` points."""

    def build(context, builder, signature, arguments):
        start = builder.gep(arguments[0], [arguments[1]])
        builder.store(arguments[2], builder.bitcast(start, arguments[2].type.as_pointer()), align=8)
        return context.get_dummy_value()

    return types.void(pointer, types.int64, a), build


@intrinsic
def choose_less(typing, a, b, x, y):
    """x where a < b, y elsewhere; a number is taken as a vector of equal elements"""
    kind = next(one for one in (a, b, x, y) if isinstance(one, SimdVector))
    taken = [one if isinstance(one, SimdVector) else types.float64 for one in (a, b, x, y)]

    def build(context, builder, signature, arguments):
        first, second, yes, no = (_as_vector(builder, kind, one) for one in arguments)
        return builder.select(builder.fcmp_ordered("<", first, second), yes, no)

    return kind(*taken), build


@intrinsic
def root(typing, a):
    """Square root of a vector"""

    def build(context, builder, signature, arguments):
        vector = arguments[0].type
        kind = ir.FunctionType(vector, [vector])
        known = get_or_insert_function(builder.module, kind, f"llvm.sqrt.v{a.width}f64")
        return builder.call(known, arguments)

    return a(a), build


@intrinsic
def exponents_and_fractions(typing, a):
    """Two vectors k and m with a = m 2ᵏ, 1 ≤ m < 2, for a vector a of numbers above 2⁻¹⁰²²"""

    def build(context, builder, signature, arguments):
        whole = ir.VectorType(ir.IntType(64), a.width)
        bits = builder.bitcast(arguments[0], whole)
        shift, bias, low, one = (ir.Constant(whole, [n] * a.width) for n in (52, 1023, 2**52 - 1, 1023 << 52))
        exponent = builder.sitofp(builder.sub(builder.lshr(bits, shift), bias), arguments[0].type)
        fraction = builder.bitcast(builder.or_(builder.and_(bits, low), one), arguments[0].type)
        return context.make_tuple(builder, signature.return_type, (exponent, fraction))

    return types.UniTuple(a, 2)(a), build


def _as_vector(builder, kind, value):
    return value if isinstance(value.type, ir.VectorType) else _broadcast(builder, kind, value)


class _Arithmetic(AbstractTemplate):
    def generic(self, arguments, keywords):
        kind = next((one for one in arguments if isinstance(one, SimdVector)), None)
        if kind is None:
            return None
        return signature(kind, *[one if isinstance(one, SimdVector) else types.float64 for one in arguments])


def _let_numba_know(symbol, instruction):
    """`symbol` of a vector, of two, or of a vector and a number"""
    infer_global(symbol)(type(f"_{instruction}", (_Arithmetic,), {}))

    def build(context, builder, signature, arguments):
        both = [_as_vector(builder, signature.return_type, one) for one in arguments]
        return getattr(builder, instruction)(*both, flags=CONTRACT)

    pairs = ((SimdVector, SimdVector), (SimdVector, types.Float), (types.Float, SimdVector))
    for kinds in ((SimdVector,),) if symbol is operator.neg else pairs:
        lower_builtin(symbol, *kinds)(build)


for _symbol, _instruction in (("add", "fadd"), ("sub", "fsub"), ("mul", "fmul"), ("truediv", "fdiv"), ("neg", "fneg")):
    _let_numba_know(getattr(operator, _symbol), _instruction)


@intrinsic
def float_to_bits(typing, number):
    """The 64 bits of a number as an integer"""

    def build(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.int64))

    return types.int64(types.float64), build


@intrinsic
def bits_to_float(typing, integer):
    """The number with these 64 bits"""

    def build(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.float64))

    return types.float64(types.int64), build


if config.DISABLE_JIT:
    from .simd_plain import (  # noqa: F401 - in place of those above
        address,
        bits_to_float,
        choose_less,
        exponents_and_fractions,
        float_to_bits,
        load_vector,
        repeated,
        root,
        split_halves,
        store_vector,
        to_scalars,
    )
