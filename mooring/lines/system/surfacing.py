"""Uniform lines that emerge from the water, with their weight in air above it, as rows of the assembly of a system.

Such a line has up to three segments, dry, wet and dry, joined where the line crosses the surface, z = 0. The joints
are found by Newton's method on the height of each joint, divided by the slope of the line there. To first order the
positions of the joints do not change the energy of the line, because the height of a joint is 0. The forces of the
line are therefore the forces of its segments; their derivatives are difference quotients.
"""

from dataclasses import dataclass

import numpy as np

from ..catenary.state import BeyondReachError, LineError, State
from ..multi_segment.segments import Segment
from .checks import ON_BED
from .composite import of_line
from .parts import CompositeLine, LineSystemError, UniformLine

PROFILE = 200  # places along a line in the first search for the surface
STEPS, CLOSE = 40, 1e-11  # steps of Newton's method; error of the height of joints, over the length
SHIFT = 1e-5  # difference for derivatives, over the length


@dataclass(frozen=True)
class Surfacing:
    """A UniformLine with a weight in air, as its solver reads it, from the anchor on the bed, or from end a without
    one.

    number : number of the line in its system; anchored : whether the origin is an anchor on the bed, at z = bed
    """

    number: int
    line: UniformLine
    flipped: bool
    anchored: bool
    bed: float

    def between(self, x, low, high):
        """StaticSolution between an origin at height `low` and an end at height `high`, x apart, m; and its dry
        lengths (2,) m.

        raises : LineError
        """
        L, dry = self.line.length, np.zeros(2)
        found = self._solved(dry, low, x, high)
        out = low > 0, high > 0
        if not any(out):
            return found, dry
        z = low + found.profile(PROFILE)[:, 2]
        s = np.linspace(0, L, len(z))
        wet = np.flatnonzero(z < 0)
        if not len(wet):
            dry = np.array([L, 0.0])
            return self._solved(dry, low, x, high), dry
        dry[:] = s[wet[0]] * out[0], (L - s[wet[-1]]) * out[1]
        for _ in range(STEPS):
            found = self._solved(dry, low, x, high)
            joints = np.array([dry[0], L - dry[1]])[list(out)]
            at, beside = (low + found.at(joints + d)[:, 1] for d in (0.0, -1e-6 * L))
            if np.abs(at).max() <= CLOSE * L:
                return found, dry
            step = at / ((at - beside) / (1e-6 * L)) * np.array([1, -1])[list(out)]
            dry[list(out)] = np.clip(dry[list(out)] - np.clip(step, -0.1 * L, 0.1 * L), 1e-9 * L, L)
            if dry.sum() >= L * (1 - 1e-9):
                dry *= (1 - 1e-6) * L / dry.sum()
        raise LineError(f"line {self.line.name}: the points where it passes through the surface were not found")

    def _solved(self, dry, low, x, high):
        kind, L = self.line.type, self.line.length
        parts = ((dry[0], self.line.weight_in_air), (L - dry.sum(), kind.weight), (dry[1], self.line.weight_in_air))
        segments = [Segment(s, w, kind.axial_stiffness) for s, w in parts if s > 0]
        given = CompositeLine(self.line.name, tuple(segments), "a", "b", bed_friction=self.line.bed_friction)
        found = of_line(given, 0, "a" if self.anchored else "", low).line.solve(x, high - low)
        if not self.anchored and low + found.profile(PROFILE)[:, 2].min() < self.bed - ON_BED:
            raise LineSystemError(
                f"line {self.line.name} comes out of the water and also lies on the bed; allowed for such a line: it "
                "is clear of the bed, or one end is an anchor on the bed"
            )
        return found


def surfacing(system):
    """Surfacing of every UniformLine with a weight in air, in the order of the lines; shape (k,)"""
    return tuple(
        Surfacing(i, line, end == "b", bool(end), -float(system.depth))
        for i, (line, end) in enumerate(zip(system.lines, system.anchored_ends, strict=True))
        if isinstance(line, UniformLine) and line.weight_in_air is not None
    )


def fill_surfacing(row, one, A, B):
    """Fill the row (`catenary.flat_bed.ROW`) of a Surfacing from its origin A to B, (3,) m; as `composite.fill_row`."""
    place = np.array([np.hypot(*(B - A)[:2]), A[2], B[2]])
    try:
        found, _ = one.between(*place)
    except LineSystemError:
        raise
    except ValueError as error:
        row[:] = np.nan
        row[0] = State.BEYOND_REACH if isinstance(error, BeyondReachError) else State.UNSOLVED
        return
    lying, h = found.grounded_length, SHIFT * one.line.length
    row[0] = State.SLACK if found.slack else State.GROUNDED if lying > 0 else State.SUSPENDED
    row[1:5], row[5] = _forces(found), lying
    for column in (0, 2) if one.anchored else (0, 1, 2):  # an anchor does not move
        step = h * (np.arange(3) == column)
        back = step if column or place[0] > h else 0 * step
        ahead, behind = (_forces(one.between(*at)[0]) for at in (place + step, place - back))
        row[6 + column : 18 : 3] = (ahead - behind) / (step + back)[column]


def _forces(found):
    """Forces of a row, N: horizontal at the origin and the other end, downward pulls on both; shape (4,)"""
    return np.array(
        [found.horizontal_anchor, found.horizontal_fairlead, -found.vertical_anchor, found.vertical_fairlead], float
    )


def surfacing_shape(one, A, B, count):
    """Points in space from end a to end b of a line with its origin at A, m; shape (count, 3)"""
    away = (B - A)[:2]
    span = np.hypot(*away)
    found, _ = one.between(span, A[2], B[2])
    x, z, _ = found.at(found.places(count)).T
    outward = away / span if span > 0 else np.array([1.0, 0.0])
    made = np.column_stack([A[:2] + x[:, None] * outward, A[2] + z])
    return made[::-1] if one.flipped else made
