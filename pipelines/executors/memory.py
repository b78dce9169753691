"""Memory that was freed: whether the GNU C library keeps it for what comes next, or gives it back to Linux."""

from __future__ import annotations

import gc
import sys

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # of malloc.h


def keep():
    """Let arrays take the memory of those before, which Linux would take back and clear anew for every frequency.

    944 panels take a third less of the time of the system, a twentieth of all, and no more memory at the most.
    """
    mallopt = _of_the_library("mallopt")
    for option, limit in ((M_MMAP_THRESHOLD, 32 << 20), (M_TRIM_THRESHOLD, 1 << 30)) if mallopt else ():
        mallopt(option, limit)


def give_back():
    """After something large was let go and before long work that needs little: a tenth of a second."""
    gc.collect()
    trim = _of_the_library("malloc_trim")
    if trim:
        trim(0)


def _of_the_library(name):
    if sys.platform != "linux":
        return None
    import ctypes

    return getattr(ctypes.CDLL(None), name, None)
