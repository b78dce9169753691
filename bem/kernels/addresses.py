"""The part of `in_memory` inside numba: the type of an address, the reading of fields, and the conversion from Python.

Fields are read word by word and marked as never changing (`invariant.load`), so that fields which a loop reads are
loaded before the loop.
"""

import hashlib
import operator

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.cgutils import get_or_insert_function
from numba.core.imputils import lower_getattr_generic
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, infer_global, signature
from numba.core.typing.typeof import typeof_impl
from numba.extending import NativeValue, lower_builtin, models, register_model, unbox

WORD = 8  # bytes of a number or an address
WORDS = types.Array(types.int64, 1, "C")


def laid_out(value):
    """Words of a tuple of a marked class as int64, valid as long as the returned array and the tuple exist; shape
    (n,)"""
    words, inner = [], [value]  # of each of `inner`, one after the other
    begins, places = {}, {}
    for number, one in enumerate(inner):  # grows
        begins[number] = len(words)
        for part in one:
            _put(part, words, inner, places)
    out = np.array([0 if isinstance(one, float) else one for one in words], np.int64)
    numbers = [i for i, one in enumerate(words) if isinstance(one, float)]
    out.view(float)[numbers] = [words[i] for i in numbers]
    for place, number in places.items():
        out[place] = out.ctypes.data + WORD * begins[number]
    return out


def _put(part, words, inner, places):
    """Append the words of a field; marked tuples and lists of them follow in `inner`, at an address in `places`"""
    if isinstance(part, np.ndarray):
        words += [0, 0, part.size, part.itemsize, part.ctypes.data, *part.shape, *part.strides]
    elif getattr(part, "in_memory", False) or isinstance(part, list):
        places[len(words)] = len(inner)
        inner.append(part)
        words.append(0)
    elif isinstance(part, tuple):
        for one in part:
            _put(one, words, inner, places)
    elif part is None:
        words.append(0)
    elif isinstance(part, float):
        words.append(part)
    elif isinstance(part, int | np.integer | np.bool_):
        words.append(int(part))
    else:
        raise TypeError(f"kernels cannot read a {type(part).__name__}; allowed: arrays, numbers, tuples of them")


class Address(types.Type):
    """Numba type of a tuple in memory, with the class of the tuple and the types of the fields"""

    def __init__(self, made, kinds):
        self.fields, self.kinds = made._fields, kinds
        digest = hashlib.sha256(" ".join(kind.name for kind in kinds).encode()).hexdigest()[:12]
        super().__init__(name=f"{made.__name__}_{digest}")  # short: it is part of the symbols of all kernels


class Row(types.Type):
    """Numba type of a list of tuples in memory: the addresses of the tuples in one array"""

    def __init__(self, kind):
        self.kind = kind
        super().__init__(name=f"Row({kind.name})")


@register_model(Address)
@register_model(Row)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.IntType(8).as_pointer())


@infer_getattr
class _Fields(AttributeTemplate):
    key = Address

    def generic_resolve(self, kind, name):
        return dict(zip(kind.fields, kind.kinds, strict=True)).get(name)


@lower_getattr_generic(Address)
def _field(context, builder, kind, value, name):
    """Read through a function of the module that is always inlined: one function replaces its code at each place"""
    place = kind.fields.index(name)
    part = context.get_data_type(kind.kinds[place])
    reads = get_or_insert_function(builder.module, ir.FunctionType(part, [value.type]), f"{kind.name}.{name}")
    if reads.is_declaration:
        reads.linkage = "internal"
        reads.attributes.add("alwaysinline")
        inside = ir.IRBuilder(reads.append_basic_block())
        before = sum(_words(context.get_data_type(one)) for one in kind.kinds[:place])
        inside.ret(_read(inside, part, reads.args[0], before)[0])
    return context.data_model_manager[kind.kinds[place]].from_data(builder, builder.call(reads, [value]))


@infer_global(operator.getitem)
class _Members(AbstractTemplate):
    def generic(self, arguments, keywords):
        row, _ = arguments
        return signature(row.kind, row, types.intp) if isinstance(row, Row) else None


@lower_builtin(operator.getitem, Row, types.intp)
def _member(context, builder, signature, arguments):
    row, number = arguments
    addresses = builder.bitcast(row, row.type.as_pointer())
    return builder.load(builder.gep(addresses, [number]))


def _parts(kind):
    return [kind.element] * kind.count if isinstance(kind, ir.ArrayType) else kind.elements


def _words(kind):
    return sum(map(_words, _parts(kind))) if isinstance(kind, ir.Aggregate) else 1


def _read(builder, kind, address, word):
    """A value of an LLVM type that begins with a word from an address on, and the word after it"""
    if isinstance(kind, ir.Aggregate):
        whole = ir.Constant(kind, ir.Undefined)
        for i, one in enumerate(_parts(kind)):
            part, word = _read(builder, one, address, word)
            whole = builder.insert_value(whole, part, i)
        return whole, word
    there = builder.gep(address, [ir.Constant(ir.IntType(64), WORD * word)])
    read = builder.load(builder.bitcast(there, kind.as_pointer()))
    read.set_metadata("invariant.load", builder.module.add_metadata([]))
    return read, word + 1


@unbox(Address)
def _handed_over(kind, value, c):
    lay = c.pyapi.unserialize(c.pyapi.serialize_object(laid_out))
    words = c.pyapi.call_function_objargs(lay, [value])
    c.pyapi.decref(lay)
    array = c.unbox(WORDS, words)
    data = c.context.make_array(WORDS)(c.context, c.builder, array.value).data

    def cleanup():
        if array.cleanup is not None:
            array.cleanup()
        c.pyapi.decref(words)

    return NativeValue(c.builder.bitcast(data, ir.IntType(8).as_pointer()), is_error=array.is_error, cleanup=cleanup)


def know(made):
    """Make numba pass objects of a marked class by address"""

    @typeof_impl.register(made)
    def _(value, purpose):
        return Address(made, tuple(_kind(part, purpose) for part in value))


def _kind(part, purpose):
    return Row(typeof_impl(part[0], purpose)) if isinstance(part, list) else typeof_impl(part, purpose)
