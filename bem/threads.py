"""How many threads a linear system is worth.

Below about seven hundred unknowns a second BLAS thread gains nothing, and where another program holds the core it
waits for it at every step: 316 unknowns took 915 ms instead of 10 on a busy machine with two cores.
"""

from __future__ import annotations

from contextlib import nullcontext
from functools import cache

WORTH_THREADS = 700


def blas_threads(unknowns):
    """Context in which BLAS works with one thread for small systems and is left alone for large ones."""
    return _controller().limit(limits=1, user_api="blas") if unknowns < WORTH_THREADS else nullcontext()


@cache
def _controller():
    import scipy.linalg  # noqa: F401  its BLAS has to be there to be controlled
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
