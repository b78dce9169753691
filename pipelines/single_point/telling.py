"""Progress of a run in time and of a limit cycle, on stderr, with the time left."""

import sys
import time

import numpy as np

from hakobune.bem.kernels.progress import CYCLE, IN_TIME
from hakobune.mooring.single_point.limit_cycle import MOST

from ..common.progress import duration

EVERY = 10.0  # s between two lines


class Telling:
    """Callback of `bem.kernels.progress`: a line every `EVERY` s on a run in time and on a limit cycle"""

    def __init__(self):
        self.periods, self.run, self.share, self.cycle, self.told = 0, None, 0.0, None, time.monotonic()

    def __call__(self, stage, what):
        now = time.monotonic()
        if stage == IN_TIME:
            if self.run is None or what < self.share:  # a run begins, or begins again with finer steps
                self.run = now, what
            self.share = what
            self._say(now, self.run, what, lambda left: f"run in time: {100 * what:.0f} %, {left} left")
        elif stage == CYCLE:
            self.periods += 1
            self.cycle = self.cycle or (now, self.periods)
            (amplitude, change), n = what, self.periods
            self._say(now, self.cycle, n, lambda left: (
                f"limit cycle, period {n} of at most {MOST}: the heading swings {np.degrees(amplitude):.3g}° to either "
                f"side, {100 * change:+.2g} % a period; at most {left} left"
            ), MOST)  # fmt: skip

    def _say(self, now, begun, done, words, whole=1.0):
        """begun : (s, done) at the first call; words : function of the time left"""
        if now - self.told >= EVERY and done > begun[1]:
            self.told = now
            left = (now - begun[0]) / (done - begun[1]) * (whole - done)
            print(words(duration(left)), file=sys.stderr, flush=True)
