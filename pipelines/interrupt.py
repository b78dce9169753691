"""Ctrl-C between frequencies."""

from __future__ import annotations

import signal
from contextlib import contextmanager


class Stop:
    """Whether someone has asked to stop."""

    asked = False


@contextmanager
def ctrl_c(say):
    """A `Stop` that the first Ctrl-C sets; the second one acts as ever.

    say : called with one line at the first

    An exception raised while a compiled kernel runs comes out of it as an error of the kernel, and would be
    taken for a frequency that fails.  Outside the main thread signals are left as they are.
    """
    stop = Stop()

    def note(number, frame):
        stop.asked = True
        signal.signal(signal.SIGINT, before)
        say("stopping after this frequency; Ctrl-C again stops at once")

    try:
        before = signal.signal(signal.SIGINT, note)
    except ValueError:
        yield stop
        return
    try:
        yield stop
    finally:
        signal.signal(signal.SIGINT, before)
