"""Named tuples that kernels take by address, not by value.

By value a tuple of ninety arrays is six hundred arguments of every kernel that it is handed to, each written and read
again: half of the time that kernels of bodies in time took to compile.  A class marked `in_memory` is laid out word
after word at every call from Python, and kernels pass its address.  Kernels read it and do not make or change one;
what its arrays hold may change.  How numba reads it: `addresses`.
"""

from __future__ import annotations

import numpy as np

WORD = 8  # bytes of a number or an address
marked = []  # classes that numba does not know yet


def in_memory(kind):
    """Decorator of a NamedTuple of numbers, arrays, further tuples of them, and lists of marked ones of one kind"""
    marked.append(kind)
    kind.in_memory = True
    return kind


def laid_out(value):
    """(n,) int64 words of a marked tuple, that hold as long as this array and the tuple"""
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
    else:
        words.append(part if isinstance(part, float) else int(part))
