"""Named tuples that kernels take by address, not by value.

By value a tuple of ninety arrays is six hundred arguments of every kernel that receives it, each written and read
again. This took a quarter of the time to compile all kernels of bodies in time.  A class marked `in_memory` is laid out
word after word at every call from Python, and kernels pass its address.  Kernels read such a tuple, but neither make
nor change one; the contents of its arrays may change.  How numba reads it: `addresses`.
"""

marked = []  # classes that numba does not know yet


def in_memory(kind):
    """Decorator of a NamedTuple of numbers, arrays, further such tuples, and lists of marked tuples of one kind"""
    marked.append(kind)
    kind.in_memory = True
    return kind
