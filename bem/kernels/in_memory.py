"""Named tuples that kernels take by address, not by value.

A tuple of ninety arrays that is passed by value becomes six hundred arguments of every kernel that receives it, and
each argument is written and read again. This took a quarter of the time to compile all kernels for simulations.
Tuples of a class marked `in_memory` are laid out word after word at every call from Python, and kernels pass the
address. Kernels can read such a tuple, but neither make nor change one; the contents of its arrays may change.
`addresses` describes how numba reads a tuple.
"""

marked = []  # classes that numba does not know yet


def in_memory(kind):
    """Decorator of a NamedTuple whose fields are numbers, arrays, tuples of marked classes, or lists of tuples of one
    marked class"""
    marked.append(kind)
    kind.in_memory = True
    return kind
