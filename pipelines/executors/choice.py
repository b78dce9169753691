"""The executor named by a text, an executor that works in the calling process, and results in order."""

import time
from concurrent.futures import Future

EXECUTORS = "local, processes:N, dask:N, dask://host:port or slurm:N"
LOOK = 0.02  # s between checks whether to continue waiting
MOST = {"processes": 256, "dask": 256, "slurm": 10_000}


class Here:
    """An executor without processes: the work is done in the call of `submit`."""

    count = 1

    def submit(self, function, *arguments):
        """A finished future.  KeyboardInterrupt passes through."""
        future = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def shutdown(self, wait=True, cancel_futures=False):
        """Nothing to do; all executors have this method."""


def in_order(executor, calls):
    """Yield the result of each (function, *arguments), or its exception; an executor with processes works ahead."""
    for future in _futures(executor, calls):
        yield _outcome(future)


def in_order_until(stop, executor, calls):
    """Yield (place, result) as in `in_order`; after stop.asked only finished results, without new work.

    stop : `common.interrupt.Stop`
    """
    for place, future in enumerate(_futures(executor, calls)):
        while not (future.done() or stop.asked):
            time.sleep(LOOK)  # with a time limit, a result that dask cancels would also cancel all others
        if future.done():
            yield place, _outcome(future)
        if stop.asked and isinstance(executor, Here):
            return


def _futures(executor, calls):
    """Futures of (function, *arguments); where the caller's process does the work, each as it is asked for"""
    futures = (executor.submit(*call) for call in calls)
    return futures if isinstance(executor, Here) else list(futures)


def _outcome(future):
    try:
        return future.result()
    except Exception as error:
        return error


def executor_of(text):
    """`local`, `processes:N`, each with its share of the cores, or an executor of `cluster`.  Raises ValueError."""
    kind, _, rest = text.partition(":")
    if text == "local":
        return Here()
    if kind == "dask" and rest.startswith("//") and len(rest) > 2:
        from .cluster import there

        return there(text, rest[2:])
    if kind not in ("processes", "dask", "slurm") or not rest.isdigit() or not 1 <= int(rest) <= MOST[kind]:
        raise ValueError(f"executor is {text!r}; allowed: {EXECUTORS}, with N from 1 to 256, or to 10000 for slurm")
    if kind == "processes":
        from .processes import Processes

        return Processes(int(rest))
    from . import cluster

    return {"dask": cluster.here, "slurm": cluster.slurm}[kind](text, int(rest))
