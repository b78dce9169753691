"""Threads of linear systems (BLAS) and of kernels that fill a matrix row by row.

A linear system of less than about 700 unknowns gains nothing from a second BLAS thread. If another program holds the
second core, every step waits: 316 unknowns took 915 ms instead of 10 ms on a busy machine with two cores. Kernels of
a few milliseconds lose time too. The threads of BLAS keep their cores busy for a while after their work, and a kernel
of 2 ms took 30 ms in a pool of threads.

A kernel computes a range of rows and releases the interpreter lock; Python threads call it.  Loops that numba
distributes over threads (`prange`) run equally fast, but take two to three times as long to compile.
"""

from contextlib import nullcontext
from functools import cache
from itertools import pairwise
from threading import Thread, local

import numpy as np

UNKNOWNS_WORTH_THREADS = 700
PAIRS_WORTH_THREADS = 20_000  # these take a millisecond: a second thread saves 0.4 of it, starting it costs 0.17
CHUNKS_PER_THREAD = 4  # chunks of rows per thread, so that idle threads take over the last ones of a slow thread
_own = local()  # .shares: whether this thread is one of several that share rows out


def blas_threads(unknowns):
    """Context in which BLAS uses one thread for systems of few unknowns, and the usual number of threads for larger
    systems"""
    return _controller().limit(limits=1, user_api="blas") if unknowns < UNKNOWNS_WORTH_THREADS else nullcontext()


def thread_count():
    """Threads that kernels may take: NUMBA_NUM_THREADS, or the number of cores"""
    from numba import config

    return config.NUMBA_NUM_THREADS


def parallel_rows(work, rows, pairs):
    """Call `work(low, high)` on ranges that cover 0 … rows, in several threads if there are enough pairs.

    work : a kernel call that writes only to the rows of its range, so that results do not depend on the number of
        threads
    pairs : number of pairs of points and sources in all rows together
    raises : the exception of the first range that fails; ranges that have not begun are then omitted.
    A call of `parallel_rows` within `work` uses only the thread of its range.
    """
    threads = min(thread_count(), rows)
    if threads == 1 or pairs < PAIRS_WORTH_THREADS or getattr(_own, "shares", False):
        work(0, rows)
        return
    ends = np.linspace(0, rows, min(CHUNKS_PER_THREAD * threads, rows) + 1).astype(int)
    chunks, faults = iter(list(pairwise(ends.tolist()))), []

    def process():
        _own.shares = True
        try:
            for low, high in chunks:
                work(low, high)
        finally:
            _own.shares = False

    def process_in_thread():
        try:
            process()
        except Exception as fault:
            faults.append(fault)
            _drop(chunks)

    # a pool takes a millisecond to start and distribute work; a thread starts in a sixth of that
    helpers = [Thread(target=process_in_thread) for _ in range(threads - 1)]
    try:
        for helper in helpers:
            helper.start()
        process()
    except BaseException:  # Ctrl-C as well
        _drop(chunks)
        raise
    finally:
        for helper in helpers:
            if helper.ident:
                helper.join()
    if faults:
        raise faults.pop()


def _drop(chunks):
    """Exhaust the iterator, so that no thread begins another range"""
    for _ in chunks:
        pass


@cache
def _controller():
    import scipy.linalg  # noqa: F401  its BLAS has to be there to be controlled
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
