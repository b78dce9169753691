"""Rows of multi-segment lines for the assembly of a system, from the solver of such lines.

The solver counts from one end, the origin: the anchor of a line that lies on a bed, and end a of a free line. A free
line has one horizontal force, and V_a + V_b is its weight. The derivatives at its origin therefore follow from the
derivatives at the other end. An anchor does not move, so derivatives at an anchor are not needed.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..catenary.state import BeyondReachError, State
from ..multi_segment.bed import Bed
from ..multi_segment.line import StaticLine
from .checks import ON_BED
from .parts import Anchor, LineSystemError


class Composite(NamedTuple):
    """A multi-segment line in the form that its solver reads.

    number : number of the line in its system; line : StaticLine from its origin; flipped : whether the origin is end b
    anchored : whether the origin is an anchor on a bed
    """

    number: int
    line: StaticLine
    flipped: bool
    anchored: bool

    @property
    def buoys(self):
        """Positions of the buoys along the line, m from the origin; shape (k,)"""
        return np.array([load.position for load in self.line.loads if load.weight < 0])


def composite(system, number, end):
    """The Composite of a line whose `end` lies on a bed: "a", "b", or "" for neither.  Raises LineSystemError."""
    given = system.lines[number]
    points = {point.name: point for point in system.points}
    ends = points[given.a], points[given.b]
    if given.bed is not None and not end:
        raise LineSystemError(f"line {given.name} has its own bed, but no anchor; allowed: an anchor at one end")
    if not end and all(isinstance(p, Anchor) and p.position[2] <= -system.depth + ON_BED for p in ends):
        raise LineSystemError(f"line {given.name} has segments and both ends on the bed; allowed: one end on the bed")
    return of_line(given, number, end, ends[end == "b"].position[2])


def of_line(given, number, end, height):
    """The Composite of a CompositeLine whose `end`, at z = height m, is an anchor on a bed; "" for an end at which the
    line hangs free."""
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

    Without a solution the first number of the row is the `State` that gives the reason; all others are nan.
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
    """Points in space, m, at unstretched lengths s (k,) m from end a of a solved Composite whose origin is A; shape
    (k, 3).
    """
    span = np.hypot(*(B - A)[:2])
    outward = (B - A)[:2] / span if span > 0 else np.array([1.0, 0.0])
    x, z, _ = found.at(one.line.length - s if one.flipped else s).T
    return np.column_stack([A[:2] + x[:, None] * outward, A[2] + z])


def check_free(system, points, solutions):
    """Refuse a free line that touches the bed, or whose buoy emerges; the solver of free lines supports neither."""
    for one in system.composites:
        if one.anchored:
            continue
        name, found = system.lines[one.number].name, solutions[one.number]
        level = points[system.arrays.ends[one.number, 0], 2]
        lowest = level + found.profile(200)[:, 2].min()
        if lowest < -system.depth - ON_BED:
            raise LineSystemError(
                f"line {name} hangs {-system.depth - lowest:.3g} m below the bed; allowed for a line of segments: it "
                "is clear of the bed, or one end is an anchor on the bed"
            )
        highest = level + found.at(one.buoys)[:, 1].max(initial=-np.inf)
        if highest > ON_BED:
            raise LineSystemError(
                f"line {name} has a buoy {highest:.3g} m above the water; allowed for a line of segments: the buoy is "
                "below the surface, or one end is an anchor on the bed"
            )
