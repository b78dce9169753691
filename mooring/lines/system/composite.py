"""Rows of lines of several segments for the assembly of a system, from the solver of such a line.

The solver counts from one end, the origin: the anchor of a line that lies on a bed, and end a of one that hangs free.
What hangs free has one horizontal force, and V_a + V_b is its weight, so its derivatives at the origin follow from
those at the other end; an anchor does not move, and its own are not asked for.

A uniform line that comes out of the water weighs above z = 0 what it does in air.  It is up to three segments, dry, wet
and dry, joined where it passes the surface, which is sought: Newton on the height of each joint over the slope of the
line there.  The joints' places do not enter its energy to first order (both weights times the height 0), so its forces
are those of the segments; their derivatives are differences.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..catenary.state import BeyondReachError, LineError, State
from ..multi_segment.bed import Bed
from ..multi_segment.line import StaticLine
from ..multi_segment.segments import Segment
from .checks import ON_BED
from .parts import Anchor, CompositeLine, LineSystemError, UniformLine

PROFILE = 200  # places along a line at which it is first looked for the surface
STEPS, CLOSE = 40, 1e-11  # of Newton; of the length, on the height of joints
SHIFT = 1e-5  # of the length: difference for derivatives


class Composite(NamedTuple):
    """A line as its solver reads it.

    number : of the line in its system; line : StaticLine from its origin; flipped : whether the origin is end b
    anchored : whether the origin is an anchor on a bed
    """

    number: int
    line: StaticLine
    flipped: bool
    anchored: bool

    @property
    def buoys(self):
        """(k,) m from the origin"""
        return np.array([load.position for load in self.line.loads if load.weight < 0])


def composite(system, number, end):
    """The Composite of a line whose `end` lies on a bed: "a", "b", or "" for neither.  Raises LineSystemError."""
    given = system.lines[number]
    points = {point.name: point for point in system.points}
    ends = points[given.a], points[given.b]
    if given.bed is not None and not end:
        raise LineSystemError(f"line {given.name} has a bed of its own and no anchor; allowed: an anchor at one end")
    if not end and all(isinstance(p, Anchor) and p.position[2] <= -system.depth + ON_BED for p in ends):
        raise LineSystemError(f"line {given.name} has segments and both ends on the bed; allowed: one end on it")
    return of_line(given, number, end, ends[end == "b"].position[2])


def of_line(given, number, end, height):
    """The Composite of a CompositeLine whose `end`, at z = height m, is an anchor on a bed; "" where it hangs free."""
    segments, loads, surface, bed = given.segments, given.loads, np.inf, None
    if end == "b":
        segments = segments[::-1]
        loads = [replace(load, position=given.length - load.position) for load in loads]
    if end:
        bed = Bed.sloping(0.0, given.bed_friction) if given.bed is None else given.bed
        surface = -float(height) if any(load.weight < 0 for load in loads) else np.inf
    try:
        return Composite(number, StaticLine(segments, loads, bed, surface), end == "b", bool(end))
    except ValueError as error:
        raise LineSystemError(f"line {given.name}: {error}") from None


def fill_row(row, one, A, B):
    """Fill the row (`catenary.flat_bed.ROW`) of a Composite from its origin A to B; returns its StaticSolution or None.

    Without a solution the first number of the row is the `State` that names why, the rest nan.
    """
    try:
        found = solution(one, A, B)
    except ValueError as error:
        row[:] = np.nan
        row[0] = State.BEYOND_REACH if isinstance(error, BeyondReachError) else State.UNSOLVED
        return None
    lying = found.grounded_length
    row[0] = State.SLACK if found.slack else State.GROUNDED if lying > 0 else State.SUSPENDED
    row[1], row[2], row[3] = found.horizontal_anchor, found.horizontal_fairlead, -found.vertical_anchor
    row[4], row[5] = found.vertical_fairlead, lying
    (xx, xz), (zx, zz) = found.stiffness
    row[9:12], row[15:18] = (xx, -xz, xz), (zx, -zz, zz)
    if not one.anchored:
        row[6:9], row[12:15] = row[9:12], -row[15:18]
    return found


def solution(one, A, B):
    """StaticSolution of a Composite from A to B, (3,) m each; raises LineError or ValueError"""
    return one.line.solve(np.hypot(B[0] - A[0], B[1] - A[1]), B[2] - A[2])


def points_along(one, found, A, B, s):
    """(k, 3) m in space at unstretched lengths s (k,) m from end a of a solved Composite with its origin at A."""
    span = np.hypot(*(B - A)[:2])
    outward = (B - A)[:2] / span if span > 0 else np.array([1.0, 0.0])
    x, z, _ = found.at(one.line.length - s if one.flipped else s).T
    return np.column_stack([A[:2] + x[:, None] * outward, A[2] + z])


def check_free(system, points, solutions):
    """Refuse a free line that touches the bed, or whose buoy comes out of the water: its solver knows neither."""
    for one in system.composites:
        if one.anchored:
            continue
        name, found = system.lines[one.number].name, solutions[one.number]
        level = points[system.arrays.ends[one.number, 0], 2]
        lowest = level + found.profile(200)[:, 2].min()
        if lowest < -system.depth - ON_BED:
            raise LineSystemError(
                f"line {name} hangs {-system.depth - lowest:.3g} m below the bed; allowed for a line of segments: "
                "clear of it, or with one end an anchor on it"
            )
        highest = level + found.at(one.buoys)[:, 1].max(initial=-np.inf)
        if highest > ON_BED:
            raise LineSystemError(
                f"line {name} has a buoy {highest:.3g} m above the water; allowed for a line of segments: below it, "
                "or with one end an anchor on the bed"
            )


@dataclass(frozen=True)
class Surfacing:
    """A UniformLine with a weight in air as its solver reads it, from its origin: its anchor on the bed, or end a.

    number : of the line in its system; anchored : whether the origin is an anchor on the bed, at z = bed
    """

    number: int
    line: UniformLine
    flipped: bool
    anchored: bool
    bed: float

    def between(self, x, low, high):
        """StaticSolution between heights `low` of the origin and `high`, x apart, m, and its dry lengths (2,) m.

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
        raise LineError(f"line {self.line.name}: the places where it passes the surface were not found")

    def _solved(self, dry, low, x, high):
        kind, L = self.line.type, self.line.length
        parts = ((dry[0], self.line.weight_in_air), (L - dry.sum(), kind.weight), (dry[1], self.line.weight_in_air))
        segments = [Segment(s, w, kind.axial_stiffness) for s, w in parts if s > 0]
        given = CompositeLine(self.line.name, tuple(segments), "a", "b", bed_friction=self.line.bed_friction)
        found = of_line(given, 0, "a" if self.anchored else "", low).line.solve(x, high - low)
        if not self.anchored and low + found.profile(PROFILE)[:, 2].min() < self.bed - ON_BED:
            raise LineSystemError(
                f"line {self.line.name} comes out of the water and lies on the bed; allowed for such a line: clear of "
                "it, or with one end an anchor on it"
            )
        return found


def surfacing(system):
    """(k,) Surfacing of every UniformLine with a weight in air, in the order of the lines"""
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
    """(4,) N as in a row: horizontal at the origin and the other end, downward pulls on both"""
    return np.array(
        [found.horizontal_anchor, found.horizontal_fairlead, -found.vertical_anchor, found.vertical_fairlead], float
    )


def surfacing_shape(one, A, B, count):
    """(count, 3) m in space, from end a to end b of a line with its origin at A"""
    away = (B - A)[:2]
    span = np.hypot(*away)
    found, _ = one.between(span, A[2], B[2])
    x, z, _ = found.at(np.linspace(0, one.line.length, count)).T
    outward = away / span if span > 0 else np.array([1.0, 0.0])
    made = np.column_stack([A[:2] + x[:, None] * outward, A[2] + z])
    return made[::-1] if one.flipped else made
