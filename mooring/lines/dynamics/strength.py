"""Tensions of a moving line over breaking loads: each place is compared with the breaking load of its own segment."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


class Used(NamedTuple):
    """Place at which a line is nearest to breaking: tension and breaking load, N; time, s; segment : number, counted
    from 0
    """

    tension: float
    breaking: float
    time: float
    segment: int

    @property
    def share(self):
        """of the breaking load"""
        return self.tension / self.breaking


@dataclass(frozen=True)
class Strength:
    """breaking : breaking load of each segment from the anchor up, N, inf if unknown; names : names of the types of the
    segments"""

    breaking: tuple[float, ...]
    names: tuple[str, ...]

    @property
    def weakest(self):
        """Smallest breaking load of all segments, N, inf if none is known"""
        return min(self.breaking)

    @property
    def uniform(self):
        """Whether all segments have one breaking load"""
        return len(set(self.breaking)) == 1

    def nodes(self, line):
        """Nodes whose tensions a run must keep for this comparison: all nodes, or none for a uniform line"""
        return () if self.uniform else tuple(range(line.elements + 1))

    def most_used(self, line, result):
        """`Used` over the whole run, for a Result that has kept the tensions at `nodes`; None if no breaking load is
        known
        """
        if not np.isfinite(self.weakest):
            return None
        time, found = result.time, []
        for i, tension in self._tensions(line, result):
            top = int(np.argmax(tension))
            found.append(Used(float(tension[top]), self.breaking[i], float(time[top]), i))
        return max(found, key=lambda used: used.share)

    def _tensions(self, line, result):
        """Return (segment, tension (n,), N) of every end and element"""
        yield 0, result.tension_anchor
        yield len(self.breaking) - 1, result.tension_fairlead
        if self.uniform:
            yield 0, result.largest_tension
            return
        # a node stores the mean of the elements beside it, and the first that of its only one: they follow in turn
        kept, tension = result.station_tension, 0.0
        segments = np.repeat(np.arange(len(line.segments)), [segment.elements for segment in line.segments])
        for j, segment in enumerate(segments):
            tension = kept[:, 0] if j == 0 else 2 * kept[:, j] - tension
            yield int(segment), tension
