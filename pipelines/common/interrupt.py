"""Ctrl-C between frequencies, and what is said of a command that it ended."""

from __future__ import annotations

import signal
from contextlib import contextmanager

STORING = ("box", "buoy", "solve", "compare")  # into databases, which the same command completes


def interrupted(command, arguments):
    """What to say of a command that Ctrl-C ended at once"""
    if command in STORING and "--mesh-only" not in arguments:
        return "interrupted; what was solved is stored, the same command goes on"
    return "interrupted"


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
