"""Ctrl-C between frequencies, and what is said of a command that it ended."""

from __future__ import annotations

import signal
from contextlib import contextmanager

AGAIN = 0.02  # s, after which is looked again whether a module is loaded
STORING = ("box", "buoy", "solve", "compare")  # into databases, which the same command completes


def interrupted(command, arguments):
    """What to say of a command that Ctrl-C ended at once"""
    if command in STORING and "--mesh-only" not in arguments:
        return "interrupted; what was solved is stored, the same command goes on"
    return "interrupted"


def after_loading(number, frame):
    """Signal handler: KeyboardInterrupt, but not while a module is being loaded or a weak reference dropped.

    There it would leave the module half loaded, or be printed and lost in a callback: it comes when that is over.
    """
    if _would_be_lost(frame) and hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, after_loading)
        signal.setitimer(signal.ITIMER_REAL, AGAIN)
    else:
        raise KeyboardInterrupt


def _would_be_lost(frame):
    while frame is not None:
        code = frame.f_code
        if code.co_filename.startswith("<frozen importlib") or code.co_filename.endswith("weakref.py"):
            return True
        frame = frame.f_back
    return False


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
