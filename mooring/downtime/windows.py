"""Weather windows: runs of usable hours, the length of a window, and the waiting time for a window.

A ship that arrives at any hour waits until the first hour at which a window of n hours remains.  Gaps of the record and
unknown hours end a window, and waits across them are excluded.
"""

from typing import NamedTuple

import numpy as np


class Windows(NamedTuple):
    """first : (w,), number of the first row of a window; steps : (w,), number of rows in the window

    whole : (w,), whether known rows precede and follow the window without a gap; otherwise it may have been longer
    """

    first: np.ndarray
    steps: np.ndarray
    whole: np.ndarray


def windows(usable, known, slot):
    """Windows of rows; usable, known : (n,), whether a row is usable, and whether it is known; slot :
    `hindcast.Hindcast.slot`, (n,)
    """
    good = usable & known
    follows = np.diff(slot, prepend=slot[0] - 2) == 1
    begins = good & ~(np.roll(good, 1) & follows)
    ends = good & ~(np.roll(good, -1) & np.roll(follows, -1))
    first, last = np.flatnonzero(begins), np.flatnonzero(ends)
    before = follows[first] & np.roll(known, 1)[first]
    after = np.roll(follows, -1)[last] & np.roll(known, -1)[last]
    return Windows(first, last - first + 1, before & after)


def in_windows(found, count, steps):
    """Whether each of `count` rows is in a window of at least `steps` rows; shape (n,)"""
    long = found.steps >= steps
    edge = np.zeros(count + 1, int)
    edge[found.first[long]] += 1
    edge[found.first[long] + found.steps[long]] -= 1
    return np.cumsum(edge[:-1]) > 0


def waiting(found, known, slot, steps):
    """Rows of waiting from each row for a window of `steps` rows; shape (n,); nan where the record does not
    determine the time of waiting

    The wait from a row inside a window is 0 if at least `steps` rows of the window remain.
    """
    count = len(slot)
    start = np.zeros(count, bool)
    for first, length in zip(found.first, found.steps, strict=True):
        start[first : first + max(length - steps + 1, 0)] = True
    rows = np.arange(count)
    following = np.minimum.accumulate(np.where(start, rows, count)[::-1])[::-1]
    broken = ~known | (np.diff(slot, prepend=slot[0] - 1) != 1)
    breaks = np.cumsum(broken)
    reached = np.minimum(following, count - 1)
    sure = (following < count) & known & (breaks[reached] == breaks)
    return np.where(sure, following - rows, np.nan)
