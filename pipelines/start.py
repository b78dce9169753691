"""Where the `hakobune` command begins: Ctrl-C is one line from the first moment, before anything else is loaded."""

from __future__ import annotations

import os
import signal


def main():
    """The command line of this process.  Returns the exit status."""
    signal.signal(signal.SIGINT, _leave)
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


def _leave(number, frame):
    """Nothing is begun, so nothing is lost."""
    os.write(2, b"hakobune: interrupted\n")
    os._exit(130)
