"""How many threads a linear system, or a block of pairs, is worth.

Below about seven hundred unknowns a second BLAS thread gains nothing, and where another program holds the core it
waits for it at every step: 316 unknowns took 915 ms instead of 10 on a busy machine with two cores.  Blocks of a few
milliseconds are the same: beside the threads of BLAS, which look for work for a while longer, 2 ms took 30.
"""

from __future__ import annotations

from contextlib import contextmanager, nullcontext
from functools import cache

WORTH_THREADS = 700
WORTH_PAIRS = 100_000


def blas_threads(unknowns):
    """Context in which BLAS works with one thread for small systems and is left alone for large ones."""
    return _controller().limit(limits=1, user_api="blas") if unknowns < WORTH_THREADS else nullcontext()


@contextmanager
def pair_threads(pairs):
    """Context in which kernels over few pairs of points work with one thread"""
    import numba

    before = numba.get_num_threads()
    numba.set_num_threads(1 if pairs < WORTH_PAIRS else before)
    try:
        yield
    finally:
        numba.set_num_threads(before)


@cache
def _controller():
    import scipy.linalg  # noqa: F401  its BLAS has to be there to be controlled
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
