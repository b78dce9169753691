"""Threads: how many a linear system is worth, and rows of pairs shared out among them.

Below about seven hundred unknowns a second BLAS thread gains nothing, and where another program holds the core it
waits for it at every step: 316 unknowns took 915 ms instead of 10 on a busy machine with two cores.  Blocks of a few
milliseconds are the same: beside the threads of BLAS, which look for work for a while longer, 2 ms took 30 in threads
that were kept for it.

Kernels work on some rows at a time and let go of the interpreter; threads of Python call them.  Loops that the
compiler shares out itself (`prange`) take as long, and two to three times as long to compile.
"""

from __future__ import annotations

from contextlib import nullcontext
from functools import cache
from itertools import pairwise
from threading import Thread

import numpy as np
from numba import config

WORTH_THREADS = 700
WORTH_PAIRS = 20_000  # a millisecond of them: two threads take 0.4 of one less, a thread begins in 0.17
SHARES = 4  # of the rows, for each thread: one that is held up leaves its last to the others


def blas_threads(unknowns):
    """Context in which BLAS works with one thread for small systems and is left alone for large ones."""
    return _controller().limit(limits=1, user_api="blas") if unknowns < WORTH_THREADS else nullcontext()


def thread_count():
    """Threads that kernels may take: NUMBA_NUM_THREADS, or the number of cores"""
    return config.NUMBA_NUM_THREADS


def share_rows(work, rows, pairs):
    """Call `work(low, high)` until all of `rows` rows are done, in threads if they have pairs enough.

    work : a kernel's call that writes to its own rows alone, so that results do not depend on the number of threads
    pairs : of points and sources, in all rows together
    """
    threads = 1 if pairs < WORTH_PAIRS else min(thread_count(), rows)
    if threads == 1:
        work(0, rows)
        return
    ends = np.linspace(0, rows, min(SHARES * threads, rows) + 1).astype(int)
    shares, faults = iter(list(pairwise(ends.tolist()))), []

    def take():
        for low, high in shares:
            work(low, high)

    def help_out():
        try:
            take()
        except Exception as fault:
            faults.append(fault)
            _drop(shares)

    # a pool of threads is begun, and hands out work, in a millisecond; a thread begins in a sixth of that
    helpers = [Thread(target=help_out) for _ in range(threads - 1)]
    try:
        for helper in helpers:
            helper.start()
        take()
    except BaseException:  # Ctrl-C as well
        _drop(shares)
        raise
    finally:
        for helper in helpers:
            if helper.ident:
                helper.join()
    if faults:
        raise faults.pop()


def _drop(shares):
    """Nothing is left to the other threads"""
    for _ in shares:
        pass


@cache
def _controller():
    import scipy.linalg  # noqa: F401  its BLAS has to be there to be controlled
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
