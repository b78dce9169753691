"""States of a memory that decay within a fraction of every wave period, replaced by their instantaneous response.

    y = c (s − a)⁻¹ b ν  →  −c a⁻¹ b ν − c a⁻² b ν̇        |s| ≪ |a|

The two terms are a damping and an inertia; the neglected part is (ω/|a|)² of the force. With these states an explicit
integration would need steps of 3/|a|, however slow the motion.
"""

from typing import NamedTuple

import numpy as np

from .memory_kernels import MemoryArrays


class SlowMemory(NamedTuple):
    """arrays : `MemoryArrays` of the remaining states; damping, inertia : matrices (6, 6) that replace the fast
    states"""

    arrays: MemoryArrays
    damping: np.ndarray
    inertia: np.ndarray


def slow_memory(memory, fastest):
    """`SlowMemory` of a `Memory`; states with poles beyond `fastest` rad/s are replaced."""
    decay, turn, into, out = memory.arrays
    n, p = len(decay), len(turn)
    real, pairs = np.arange(n - 2 * p), n - 2 * p + np.arange(p)
    keep_real = decay[real] <= fastest
    keep_pair = np.hypot(decay[pairs], turn) <= fastest
    kept = np.concatenate([real[keep_real], pairs[keep_pair], pairs[keep_pair] + p])
    gone = np.setdiff1d(np.arange(n), kept)
    a = memory.matrices[0][np.ix_(gone, gone)]
    b, c = into[:, gone].T, out[:, gone]
    once = np.linalg.solve(a, b)
    left = (decay[kept], turn[keep_pair], into[:, kept], out[:, kept])
    arrays = MemoryArrays(*(np.ascontiguousarray(part) for part in left))
    return SlowMemory(arrays, -c @ once, -c @ np.linalg.solve(a, once))
