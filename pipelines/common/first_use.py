"""Who waits at a terminal is told once when kernels are compiled; those that come from disk are no event of numba."""

from __future__ import annotations

import sys


def tell_first_use():
    """Say it on stderr before the next kernel is compiled; returns the listener of numba."""
    from numba.core import event

    class Teller(event.Listener):
        said = False

        def on_start(self, event):
            if not self.said:
                self.said = True
                print("compiling kernels, once on this computer: up to a minute", file=sys.stderr, flush=True)

        def on_end(self, event):
            pass

    teller = Teller()
    event.register("numba:compile", teller)
    return teller
