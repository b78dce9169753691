"""Where the `hakobune` command begins: Ctrl-C is one line from the first moment, before anything else is loaded."""

from __future__ import annotations

import gc
import importlib
import os
import signal
import sys
from types import ModuleType

from .executors import memory
from .printing import timing

# commands that solve large linear systems, which more than one BLAS thread serves
SOLVING = ("box", "buoy", "ship", "solve", "bench", "stress", "compare", "sections")

# kernels of some lines or one system take milliseconds uncompiled, and up to a minute to compile
LINES = "hakobune.mooring.lines."
SHORT, SECONDS = (LINES + "catenary", LINES + "multi_segment", LINES + "system"), 10.0
# and of a few equilibria as long as it takes to load numba and them: 0.4 s for so many calls
FEW, CALLS = ("line", "lines", "moor"), 100_000

# objects made between two searches for cycles: Python's 700 take a tenth of the time of imports, 50 000 take 0.04 s of
# 40 frequencies by the contour method and 0.26 s of those on panels
YOUNG = 200_000

# whose files are the same to the byte whatever is compiled: sums of uncompiled kernels differ in their last digit
SAME = ("design",)

TOLD = ("keys", "new", "doctor")  # commands that tell what there is, and compute nothing


class _Later(ModuleType):
    """Stands for a module until something of it is asked for, and then imports it"""

    def __getattr__(self, name):
        return getattr(importlib.import_module(self.__name__), name)


def main():
    """The command line of this process.  Returns the exit status."""
    signal.signal(signal.SIGINT, _leave)
    gc.set_threshold(YOUNG)
    if not set(sys.argv[1:2]) & set(SOLVING):
        # products of some dozen rows gain nothing from BLAS threads, which wait for each other where a core is taken:
        # `moor` took 5 s of processor time on a busy machine with two cores in place of 0.8
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
            os.environ.setdefault(name, "1")
    memory.keep()
    if timing.FLAG in sys.argv:
        timing.begin()
    if len(sys.argv) > 1 and sys.argv[1][0:1] != "-" and sys.argv[1] not in TOLD and "--help" not in sys.argv:
        _spare_numpy()
        _tell_compiling()
        if sys.argv[1] not in SAME:
            _put_off_compiling()
    from . import cli
    from .common.interrupt import Interrupt

    signal.signal(signal.SIGINT, Interrupt())
    try:
        return cli.main()
    finally:
        # the work is done; the interpreter's end is no part of it
        for name in ("SIGINT", "SIGALRM"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), signal.SIG_IGN)
        _leave_cycles()


def _leave_cycles():
    """Let the interpreter's end search no object for cycles, which took 0.13 s of every command that loads kernels"""
    gc.disable()
    gc.freeze()


def _spare_numpy():
    """Let packages of numpy that nothing here uses wait: scipy, which copies all names of numpy, would load them.

    They took 0.15 s of processor time, a third of that of importing scipy.special.
    """
    import numpy

    for name in ("f2py", "testing"):
        vars(numpy).setdefault(name, _Later(f"numpy.{name}"))


def _put_off_compiling():
    """Let kernels of lines run uncompiled: for some seconds where none is on disk, in short commands in any case."""
    from hakobune.bem.kernels.uncompiled import allow

    allow(SHORT, SECONDS, CALLS if sys.argv[1] in FEW else 0)


def _tell_compiling():
    """Say at a terminal that kernels are compiled, when the first is"""
    if sys.stderr.isatty():
        from hakobune.bem.kernels.jit import before_first_kernel

        from .common.first_use import tell_first_use

        before_first_kernel(tell_first_use)


def _leave(number, frame):
    """Nothing is begun, so nothing is lost."""
    os.write(2, b"hakobune: interrupted\n")
    os._exit(130)
