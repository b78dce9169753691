"""Arrays that kernels pass to each other without counting references.

Numba counts references to every array at every call of a kernel that is not inlined, for a named tuple of thirty arrays
thirty times two atomic additions: a quarter of the time of lines in motion.  A borrowed array is the same memory
without a count.  The caller must keep the owner: numba frees an array after the last line that names it.
"""

from __future__ import annotations

from numba import config, types
from numba.core.datamodel.models import ArrayModel
from numba.extending import intrinsic, register_model


class BorrowedArray(types.Array):
    """Numba type of an array whose references are not counted; a slice of it is a counted array"""

    def __init__(self, dtype, ndim, layout, readonly, aligned):
        name = f"BorrowedArray({dtype}, {ndim}, {layout}, {readonly}, {aligned})"
        super().__init__(dtype, ndim, layout, readonly, name, aligned)


@register_model(BorrowedArray)
class _Model(ArrayModel):
    """Memory layout of an array, without a reference count"""

    def traverse(self, builder):
        return []

    def has_nrt_meminfo(self):
        return False

    def contains_nrt_meminfo(self):
        return False


def _lent(kind):
    """The type returned by `borrowed`: arrays, also those in tuples, are borrowed, anything else is unchanged"""
    if isinstance(kind, types.Array):
        return BorrowedArray(kind.dtype, kind.ndim, kind.layout, not kind.mutable, kind.aligned)
    if isinstance(kind, types.Optional):
        return types.Optional(_lent(kind.type))
    if isinstance(kind, types.BaseTuple):
        parts = tuple(_lent(one) for one in kind)
        return types.BaseTuple.from_types(parts, getattr(kind, "instance_class", None))
    return kind


@intrinsic
def borrowed(typing, value):
    """The array, or the tuple or named tuple, with its arrays borrowed; the caller must keep `value`, see above"""
    return _lent(value)(value), lambda context, builder, signature, arguments: arguments[0]


if config.DISABLE_JIT:

    def borrowed(value):
        """The value itself, without compilation"""
        return value
