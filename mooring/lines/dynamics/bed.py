"""The bed under a moving line, as a value."""

from dataclasses import dataclass

import numpy as np

from ..multi_segment.bed import Bed

ROUND = 0.1  # rounded length on either side of an edge, over the shorter facet


@dataclass(frozen=True)
class ElasticBed:
    """A plane under the anchor, or hills and valleys along one course.

    slope : slope of the bed, rad, rising towards `uphill` (rad, 0 → +x); below : depth of the bed under the anchor, m
    points : (k, 2) m, in place of a slope: distance from the anchor towards `uphill`, ascending, and height.
        The points are joined by straight facets, the first and the last of infinite length.
        They are shifted so that the first is (0, 0), as in `multi_segment.bed.Bed`.
        Across `uphill` the bed is level, and its edges are rounded (`ROUND`)
    stiffness : Pa/m, and damping : Pa s/m, both multiplied by diameter and length; a line at rest lies on the plane
        itself
    friction : Coulomb coefficient
    slip : displacement that mobilises friction, m (elastic before, sliding after); by default a tenth of the
        stretch of an element by friction, because an element that slides moves at least that far. With a slip
        of a millimetre, friction would lose a third to nine tenths of its work in small motions (`line_energy.py`)
    """

    slope: float = 0.0
    uphill: float = 0.0
    below: float = 0.0
    stiffness: float = 3e5
    damping: float = 3e4
    friction: float = 0.0
    slip: float | None = None
    points: tuple = ()

    def __post_init__(self):
        if not abs(self.slope) < 1.0:
            raise ValueError(f"bed slope is {self.slope:g} rad; allowed: between −1 and 1")
        if len(self.points):
            if self.slope != 0:
                raise ValueError(f"bed slope is {self.slope:g} rad and bed points are given too; give one of them")
            object.__setattr__(self, "points", tuple(map(tuple, Bed(self.points).points.tolist())))
        check("bed stiffness", self.stiffness, 0.0, strict=True)
        if self.slip is not None:
            check("bed slip", self.slip, 0.0, strict=True)
        for name in ("below", "damping", "friction"):
            check(f"bed {name}", getattr(self, name), 0.0)

    @property
    def normal(self):
        """Normal of the bed, a unit vector upwards; shape (3,)"""
        s = np.sin(self.slope)
        return np.array([-s * np.cos(self.uphill), -s * np.sin(self.uphill), np.cos(self.slope)])

    def profile(self, z):
        """Rows of the bed along the course, shape (m, 4): start of the row's range, m, height, slope and curvature
            at the start.

        Empty for a plane. z : height of the anchor, m; the bed is `below` metres under the anchor
        """
        if not self.points:
            return np.zeros((0, 4))
        d, height = np.array(self.points).T
        slope, length = np.diff(height) / np.diff(d), np.diff(d)
        rows = [[d[0], height[0], slope[0], 0.0]]
        for i in range(1, len(slope)):
            half = ROUND * min(length[i - 1], length[i])
            before, after = slope[i - 1], slope[i]
            rows.append([d[i] - half, height[i] - half * before, before, (after - before) / (2 * half)])
            rows.append([d[i] + half, height[i] + half * after, after, 0.0])
        return np.array(rows) + [0.0, z - self.below, 0.0, 0.0]


def check(name, value, low, strict=False):
    """Raise ValueError for a number that is not finite, or not above (strict) or at least `low`"""
    if not (np.isfinite(value) and (value > low if strict else value >= low)):
        raise ValueError(f"{name} is {value:g}; allowed: finite, {'above' if strict else 'at least'} {low:g}")
