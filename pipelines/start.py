"""Where the `hakobune` command begins: Ctrl-C is one line from the first moment, before anything else is loaded."""

from __future__ import annotations

import os
import signal


def main():
    """The command line of this process.  Returns the exit status."""
    signal.signal(signal.SIGINT, _leave)
    from . import cli
    from .common.interrupt import after_loading

    signal.signal(signal.SIGINT, after_loading)
    return cli.main()


def _leave(number, frame):
    """Nothing is begun, so nothing is lost."""
    os.write(2, b"hakobune: interrupted\n")
    os._exit(130)
