"""Start of the `hakobune` command: Ctrl-C gives one line from the first moment, before anything else is loaded."""

import gc
import os
import signal
import sys

from .printing import timing
from .printing.spelled import spell_out

# commands that solve large linear systems, which benefit from several BLAS threads
SOLVING = ("box", "buoy", "ship", "solve", "bench", "stress", "compare", "sections")


def main():
    """The command line of this process.  Returns the exit status."""
    signal.signal(signal.SIGINT, _leave)
    if not set(sys.argv[1:2]) & set(SOLVING):
        # products of some dozen rows gain nothing from BLAS threads, which wait for each other on a busy core: `moor`
        # took 5 s of processor time on a busy machine with two cores instead of 0.8
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
            os.environ.setdefault(name, "1")
    spell_out(sys.stdout, sys.stderr)
    if timing.FLAG in sys.argv:
        timing.begin()
    from hakobune.bem.kernels.jit import before_first_kernel

    from . import cli
    from .common.first_use import tell_first_use
    from .common.interrupt import Interrupt

    before_first_kernel(tell_first_use)
    signal.signal(signal.SIGINT, Interrupt())
    try:
        return cli.main()
    finally:
        # the work is done; the interpreter's end is no part of it: to search all objects for cycles takes it 0.2 s
        gc.freeze()
        for name in ("SIGINT", "SIGALRM"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), signal.SIG_IGN)


def _leave(number, frame):
    """Nothing has begun, so nothing is lost."""
    os.write(2, b"hakobune: interrupted\n")
    os._exit(130)
