"""A solved static line: its forces, stiffness, grounded parts, profile, and the friction that the line keeps.

Coordinates and signs : `mooring.lines.multi_segment.line`.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

FORCES = [0, 2]  # columns of `newton.store` that change sign with x: H at both ends
STIFFNESS = [6, 7]  # further columns that change sign with x: ∂H/∂z, ∂V/∂x


class LineState(NamedTuple):
    """Tension that friction keeps on the bed: (k, 4), rows s₀, s₁ (m from the anchor), T₀, T₁ (N), from the top
    down.
    """

    pieces: np.ndarray


@dataclass(frozen=True)
class StaticSolution:
    """A line solved at one or many positions; all arrays have one shape (...).

    line : `mooring.lines.multi_segment.line.StaticLine`
    horizontal_fairlead, vertical_fairlead : N, pull on the fairlead towards the anchor and down
    horizontal_anchor, vertical_anchor : N, pull on the anchor towards the fairlead and up
    stiffness : (..., 2, 2) N/m, ∂(H, V at the fairlead)/∂(x, z)
    slack : whether the line hangs vertically, with the remaining length in a heap on the bed
    residual : largest error of an equation over the line length
    loads : states of the point loads, "submerged", "floating" or "emerged"; pieces : see `profile`; one position only
    """

    line: Any
    x: np.ndarray
    z: np.ndarray
    horizontal_fairlead: np.ndarray
    vertical_fairlead: np.ndarray
    horizontal_anchor: np.ndarray
    vertical_anchor: np.ndarray
    stiffness: np.ndarray
    slack: np.ndarray
    residual: np.ndarray
    loads: tuple = ()
    pieces: np.ndarray = field(default=None, repr=False)

    @property
    def tension_fairlead(self):
        """Tension at the fairlead, N; shape (...,)"""
        return np.hypot(self.horizontal_fairlead, self.vertical_fairlead)

    @property
    def tension_anchor(self):
        """Tension at the anchor, N; shape (...,)"""
        return np.hypot(self.horizontal_anchor, self.vertical_anchor)

    @property
    def anchor_uplift(self):
        """Angle of the pull on the anchor above the bed at the anchor, rad; shape (...,); 0 where the line lies on the
        bed"""
        up = np.arctan2(self.vertical_anchor, self.horizontal_anchor)
        beta = self.line.anchor_slope
        lifted = (self.tension_anchor > 0) & (up > beta + 1e-9)
        return np.where(lifted, up - beta, 0.0)

    @property
    def anchor_holds(self):
        """Whether the uplift is within the line's `uplift_limit`; shape (...,)"""
        return self.anchor_uplift <= self.line.uplift_limit

    @cached_property
    def _one(self):
        if self.pieces is None:
            raise ValueError(
                f"this quantity needs one position, but the solution has positions of shape "
                f"{np.shape(self.x)}; solve one position at a time"
            )
        return self.pieces

    @cached_property
    def state(self):
        """LineState for the next `solve`: the tension that friction keeps on the bed"""
        p = self._one[(self._one[:, 0] == 1) & (self._one[:, 2] > 0)]
        return LineState(_joined(np.column_stack([p[:, 1] - p[:, 2], p[:, 1], p[:, 5] - p[:, 6] * p[:, 2], p[:, 5]])))

    @property
    def grounded(self):
        """Start and end of each part on the bed, m from the anchor; shape (k, 2), ordered from the anchor up"""
        p = self._one[(self._one[:, 0] == 1) & (self._one[:, 2] > 0)]
        spans = []
        for top, length in p[:, 1:3]:
            if spans and spans[-1][0] - top <= 1e-12 * self.line.length:
                spans[-1][0] = top - length
            else:
                spans.append([top - length, top])
        return np.maximum(np.array(spans[::-1]).reshape(-1, 2), 0.0)

    @property
    def grounded_length(self):
        """Unstretched length on the bed, m"""
        return float(np.sum(np.diff(self.grounded, axis=1)))

    @property
    def slides(self):
        """Whether a part without tension, or a heap at the anchor, lies on a bed that is too steep for its friction.

        The solution leaves a part without tension in place; in reality this part would slide down to the nearest low
        point of the bed and pull the line. Sliding is solved for parts that slide towards the anchor or down the
        first facet. Sliding is not solved for lines with buoys, nor for lines whose traversal shows that they slide
        to a low point beyond the fairlead.
        """
        if self.line.bed is None:
            return False
        if self.slack and abs(np.tan(self.line.anchor_slope)) > self.line.bed.friction + 1e-12:
            return True
        p = self._one[self._one[:, 0] == 1]
        idle = np.maximum(p[:, 5], p[:, 5] - p[:, 6] * p[:, 2]) <= 1e-9 * self.line.weight
        steep = np.abs(np.tan(p[:, 10])) > self.line.bed.friction + 1e-12
        return bool(np.any(idle & steep & (p[:, 2] > 1e-9 * self.line.length)))

    def profile(self, points=101):
        """Points along the line, evenly spaced in s: (points, 4) with s from the anchor, x, z (m), and tension (N).

        For a slack line the heap on the bed is drawn stretched out towards the anchor.
        """
        s = np.linspace(0.0, self.line.length, points)
        return np.column_stack([s, self.at(s)])

    def places(self, count):
        """Places along the line, m from the anchor; shape (count,).

        They are evenly spaced, but some are moved to a joint, a lift-off point or, finally, a body
        """
        even = np.linspace(0.0, self.line.length, count)
        s, bodies = even.copy(), [load.position for load in self.line.loads]
        for end in (
            *self._one[:-1, 1],
            *self._one[:-1, 1] - self._one[:-1, 2],
            *bodies,
        ):
            s[int(np.argmin(np.abs(even - end)))] = end
        s[[0, -1]] = even[[0, -1]]
        return np.sort(s)

    def at(self, s):
        """Coordinates x and z, m, and tension, N, at unstretched lengths s (k,) m from the anchor; shape (k, 3)"""
        p = self._one
        top = p[:, 1]
        index = np.clip(np.searchsorted(-top, -s, side="right") - 1, 0, len(p) - 1)
        return _along(p[index], np.minimum(top[index] - s, p[index, 2]))

    @property
    def segment_tensions(self):
        """The largest tension in each segment, from the anchor up, N; shape (k,)"""
        on_bed, top, length, _, _, first, second, weight = self._one[:, :8].T
        on_bed = on_bed == 1
        upper = np.where(on_bed, first, np.hypot(first, second))
        lower = np.where(on_bed, first - second * length, np.hypot(first, second - weight * length))
        joints = np.cumsum([segment.length for segment in self.line.segments])[:-1]
        largest = np.zeros(len(self.line.segments))
        np.maximum.at(largest, np.searchsorted(joints, top - 0.5 * length), np.maximum(upper, lower))
        return largest


def heaped(pieces, tangent):
    """Pieces of a slack line, laid out along the first facet, with the part beyond the anchor in a heap at the anchor.

    tangent : slope of the first facet.  Spans that buoys lift from the heap are placed over the anchor, at the same
        height.
    """
    from ..catenary.state import HEAP

    out = pieces.copy()
    beyond = pieces[:, 3] <= 0
    lies = beyond & (pieces[:, 0] == 1)
    out[beyond, 4] -= tangent * pieces[beyond, 3]
    out[beyond, 3] = 0.0
    out[lies, 4], out[lies, 8], out[lies, 9] = 0.0, HEAP, 0.0
    return out


def _joined(pieces):
    """Neighbouring pieces on one straight line T(s) merged, so that a long history stays short."""
    joined = []
    for s0, s1, t0, t1 in pieces:
        if joined:
            above = joined[-1]
            slope = (above[3] - above[2]) / (above[1] - above[0])
            size = 1e-12 * (abs(above[2]) + abs(above[3]))
            meets = above[0] - s1 <= 1e-12 * above[1] and abs(above[2] - t1) <= size
            if meets and abs(above[2] - slope * (above[0] - s0) - t0) <= size:
                above[0], above[2] = s0, t0
                continue
        joined.append([s0, s1, t0, t1])
    return np.array(joined).reshape(-1, 4)


def _along(p, down):
    """x, z and tension a length `down` below the tops of pieces `p` (n, 11)."""
    from ..catenary.free_piece import free_pieces

    _, _, _, x, z, first, second, weight, factor, flexibility, angle = p.T
    on_bed = p[:, 0] == 1
    H, V = np.where(on_bed, 1.0, first), np.where(on_bed, 0.0, second)
    dx, dz = free_pieces(np.abs(H), V - weight * down, down, weight, flexibility / factor)
    slid = down * (factor + flexibility * (first - 0.5 * second * down))
    dx = np.where(on_bed, slid * np.cos(angle), np.sign(first) * factor * dx)
    dz = np.where(on_bed, slid * np.sin(angle), factor * dz)
    tension = np.where(on_bed, first - second * down, np.hypot(H, V - weight * down))
    return np.column_stack([x - dx, z - dz, tension])


def turned(row, pieces):
    """Row of `newton.store` and pieces (n, 11) of a line, from those of its mirror image"""
    row, out = row.copy(), pieces.copy()
    row[FORCES + STIFFNESS] *= -1.0
    out[:, 3] *= -1.0
    free = out[:, 0] == 0
    out[free, 5] *= -1.0
    out[~free, 10] = np.pi - out[~free, 10]
    return row, out
