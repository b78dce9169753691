"""An executor of processes of this computer; this module is loaded only if such an executor is used."""

import multiprocessing
import os
import signal
import threading
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.connection import wait

from .beside import processors


class Processes(ProcessPoolExecutor):
    """Spawned processes, which end with their parent. A fork would lack the threads for which BLAS may wait."""

    def __init__(self, count):
        self.count = count
        super().__init__(count, multiprocessing.get_context("spawn"), _start, (max(1, processors() // count),))

    def shutdown(self, wait=True, *, cancel_futures=False):
        """Without `wait` the processes are ended, since nobody will read their results.

        Otherwise the interpreter would wait for them at its end, and after a Ctrl-C without limit.
        """
        for process in () if wait else list((self._processes or {}).values()):  # public from Python 3.14 on
            process.terminate()
        super().shutdown(wait=True, cancel_futures=cancel_futures)


def _start(threads):
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent handles Ctrl-C
    threading.Thread(target=_end_with_parent, daemon=True).start()
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ[name] = str(threads)


def _end_with_parent():
    """A killed parent cannot end its processes, which would then wait for work without limit."""
    wait([multiprocessing.parent_process().sentinel])
    os._exit(1)
