"""Ctrl-C between frequencies, and the message of an interrupted command."""

import signal
import time
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parents[2]
AGAIN, PATIENCE = 0.01, 1.0  # s, between checks of the running code, and in total
STORING = (
    "box",
    "buoy",
    "ship",
    "solve",
    "compare",
    "simulate",
    "design",
)  # commands that complete their own interrupted file


def interrupted(command, arguments):
    """Message about a command that Ctrl-C ended at once"""
    if command in STORING and "--mesh-only" not in arguments:
        return "interrupted; solved frequencies are stored, and the same command continues"
    if command == "downtime":
        return "interrupted; finished states are stored, and the same command continues with the others"
    if command == "sweep":
        return "interrupted; finished cases are stored, and the same command continues with the others"
    if command == "qtf":
        return "interrupted; finished pairs are stored, and the same command continues with the others"
    return "interrupted"


class Interrupt:
    """Signal handler that raises KeyboardInterrupt at a point where it cannot be lost and leaves nothing half done.

    An interrupt during the import of a module would leave the module half loaded. In a callback (of a weak
    reference, of the compiler) an interrupt would be printed and lost. The handler therefore waits until code of
    this program runs; outside imports it waits no longer than PATIENCE.
    """

    def __init__(self):
        self.asked = None

    def __call__(self, number, frame):
        now, loading = time.monotonic(), _is_loading(frame)
        self.asked = now if loading or self.asked is None else self.asked
        if hasattr(signal, "setitimer") and (loading or (now - self.asked < PATIENCE and not _is_ours(frame))):
            signal.signal(signal.SIGALRM, self)
            signal.setitimer(signal.ITIMER_REAL, AGAIN)
        else:
            self.asked = None
            raise KeyboardInterrupt


def _is_ours(frame):
    return frame is not None and Path(frame.f_code.co_filename).is_relative_to(ROOT)


def _is_loading(frame):
    while frame is not None:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False


class Stop:
    """Whether a stop was requested."""

    asked = False


@contextmanager
def ctrl_c(say=None):
    """A `Stop` that the first Ctrl-C sets; the second Ctrl-C interrupts at once.

    say : called with one line at the first Ctrl-C; None if Ctrl-C should interrupt at once, as the second Ctrl-C does
    during compilation of kernels

    An exception during a compiled kernel appears as an error of the kernel, and would be mistaken for a failed
    frequency.  Outside the main thread, and where another process handles Ctrl-C, signals are unchanged.
    """
    stop = Stop()

    def note(number, frame):
        stop.asked = True
        signal.signal(signal.SIGINT, before)
        if say:
            say("stopping after this frequency; press Ctrl-C again to stop at once")
        elif callable(before) and hasattr(signal, "setitimer"):
            signal.signal(signal.SIGALRM, before)
            signal.setitimer(signal.ITIMER_REAL, PATIENCE)

    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        yield stop
        return
    try:
        before = signal.signal(signal.SIGINT, note)
    except ValueError:
        yield stop
        return
    try:
        yield stop
    finally:
        if not say and hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGINT, before)
