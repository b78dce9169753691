"""Kernels compiled by numba are announced at a terminal and timed; kernels loaded from disk are not."""

import sys
from contextlib import ExitStack

from ..printing import timing


def tell_first_use():
    """Announce the compilation of the next kernel on a terminal, and time all compilations; returns numba's
    listener."""
    from numba.core import event

    class Teller(event.Listener):
        said = False

        def __init__(self):
            self.open = []

        def on_start(self, event):
            if not self.said and sys.stderr.isatty():
                self.said = True
                print(
                    "compiling kernels, once on this computer: up to a minute; hakobune doctor --compile does it ahead",
                    file=sys.stderr,
                    flush=True,
                )
            self.open.append(ExitStack())
            self.open[-1].enter_context(timing.phase(timing.KERNELS))

        def on_end(self, event):
            self.open.pop().close()

    teller = Teller()
    event.register("numba:compile", teller)
    return teller
