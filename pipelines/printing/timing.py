"""Time of a command by phase, requested by --timing.

The time of a phase excludes the time of phases within it, so that the phases add up to the total.  Compilation of
kernels is a
separate phase wherever it happens (`pipelines.common.first_use`).
"""

import time
from contextlib import contextmanager, nullcontext

FLAG = "--timing"
KERNELS, REST = "kernels compiled", "everything else"
_asked = None  # the `Timeline` of a command while one is requested


class Timeline:
    """Wall time and processor time of phases, s. clock : function that returns both times, from any zero"""

    def __init__(self, clock=lambda: (time.perf_counter(), time.process_time())):
        self.clock, self.last, self.open, self.seconds = clock, clock(), [REST], {}

    @contextmanager
    def phase(self, name):
        """Context whose time counts as the phase `name`, except for the time of phases within this context"""
        self._turn()
        self.open.append(name)
        try:
            yield
        finally:
            self._turn()
            self.open.pop()

    def share(self, phase, name, wall):
        """Move `wall` seconds of a finished phase to another, with their share of its processor time"""
        whole = self.seconds.get(phase, (0.0, 0.0))
        part = min(1.0, wall / whole[0]) if whole[0] > 0 else 0.0
        moved = [part * value for value in whole]
        other = self.seconds.get(name, (0.0, 0.0))
        self.seconds[phase] = tuple(a - b for a, b in zip(whole, moved, strict=True))
        self.seconds[name] = tuple(a + b for a, b in zip(other, moved, strict=True))

    def _turn(self):
        now, before = self.clock(), self.seconds.get(self.open[-1], (0.0, 0.0))
        self.seconds[self.open[-1]] = tuple(spent + a - b for spent, a, b in zip(before, now, self.last, strict=True))
        self.last = now

    def lines(self):
        """Lines of text: the phases in the order of their first end, and the whole"""
        self._turn()
        whole = tuple(map(sum, zip(*self.seconds.values(), strict=True)))
        rows = [*((name, *self.seconds[name]) for name in self.seconds if name != REST), (REST, *self.seconds[REST])]
        return [
            f"{name:18} {wall:8.3f} s  {processor:8.3f} s of processor"
            for name, wall, processor in (*rows, ("whole", *whole))
        ]


def phase(name):
    """`Timeline.phase` of the command, if its time is requested"""
    return nullcontext() if _asked is None else _asked.phase(name)


def share(phase, name, wall):
    """`Timeline.share` of the command, if its time is requested"""
    if _asked is not None and wall:
        _asked.share(phase, name, wall)


def spent(name):
    """Wall seconds in a phase of the command so far; 0 if its time is not requested"""
    return 0.0 if _asked is None else _asked.seconds.get(name, (0.0, 0.0))[0]


def begin():
    """Start the timing of this process, unless a timing runs already."""
    global _asked
    if _asked is None:
        _asked = Timeline()


def told():
    """End the timing; returns its lines, none if there was no timing."""
    global _asked
    timeline, _asked = _asked, None
    return [] if timeline is None else timeline.lines()
