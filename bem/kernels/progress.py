"""Progress callback of long preparations, called after every part; other modules display the progress."""

from contextlib import contextmanager
from contextvars import ContextVar

# stages and what is counted in them: rows of the wave matrices, rows of the Rankine matrices, symmetry classes
WAVES, MATRICES, FACTORS = "waves", "matrices", "factors"
FINER = "finer"  # a frequency starts again on more panels: in place of a count (prepared problem, ω in rad/s)
OWN = "own"  # a solution to compare another program's with begins: in place of a count (prepared problem, ω in rad/s)
CAUSE = "cause"  # the cause of a difference from it is sought: in place of a count the words for it
# forces of a long wave begin: in place of a count (prepared problem, ω in rad/s, its number, their count)
LONG = "long"
IN_TIME = "in time"  # a motion is followed in time: in place of a count its finished share, 0 to 1
CYCLE = "cycle"  # a period of a limit cycle is followed: in place of a count (amplitude in rad, its change a period)
_callback = ContextVar("progress callback", default=None)


@contextmanager
def progress_callback(callback):
    """Context in which callback(stage, count) is called when `count` more items of a stage are done; if None, no
    callback"""
    token = _callback.set(callback)
    try:
        yield
    finally:
        _callback.reset(token)


def report_progress(stage, count):
    """Call the callback of the context, if there is one: `count` more items of `stage` are done"""
    callback = _callback.get()
    if callback:
        callback(stage, count)
