"""What an executor is given: one frequency, or one limit, of one body.

Everything here can be sent to another process.  A process keeps the geometry of the last body it worked on,
since that is expensive once and cheap for every frequency after.
"""

from __future__ import annotations

import hashlib
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import fields

_prepared = {}


def solve_one(setup, omega, headings, want, theta):
    """`bem.frequency.solve_frequency` for a setup.

    omega : rad/s; headings : (m,) rad; want : names; theta : (t,) rad
    """
    from bem.frequency import solve_frequency

    return solve_frequency(_prepare(setup), omega, headings, want, theta)


def limit_one(setup, name):
    """`added_mass_zero` or `added_mass_infinity` (6, 6) of a setup."""
    from bem.limits import added_mass_limit

    return added_mass_limit(_prepare(setup), name.removeprefix("added_mass_"))


class Here:
    """An executor without processes: the work is done in the call of `submit`."""

    def submit(self, function, *arguments):
        """A future that is already done.  KeyboardInterrupt passes through."""
        future = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def shutdown(self, wait=True, cancel_futures=False):
        """Nothing to do; here for the interface."""


def executor_of(text):
    """`local` or `processes:N`.  Raises ValueError for anything else.

    The processes are spawned, because a fork after numba has started its threads hangs; each gets its share
    of the cores.
    """
    kind, _, count = text.partition(":")
    if text == "local":
        return Here()
    if kind != "processes" or not count.isdigit() or not 1 <= int(count) <= 256:
        raise ValueError(f"executor is {text!r}; allowed: local, processes:N with N from 1 to 256")
    import multiprocessing
    import os

    share = max(1, len(os.sched_getaffinity(0)) // int(count)) if hasattr(os, "sched_getaffinity") else 1
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(int(count), context, _limit_threads, (share,))


def _limit_threads(count):
    import os
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides what Ctrl-C means
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ[name] = str(count)


def _prepare(setup):
    from bem.setup import prepare

    key = _key(setup)
    if key not in _prepared:
        _prepared.clear()
        _prepared[key] = prepare(setup)
    return _prepared[key]


def _key(setup):
    """Hash of the values of a setup; derived quantities that its meshes remember do not count."""
    digest = hashlib.sha256()
    for field in fields(setup):
        value = getattr(setup, field.name)
        parts = (value.points, value.corners, value.symmetry) if hasattr(value, "corners") else (value,)
        for part in parts:
            digest.update(part.tobytes() if hasattr(part, "tobytes") else repr(part).encode())
    return digest.hexdigest()
