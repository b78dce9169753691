"""Mooring lines of one body: where they are made fast, what they are made of, and how a spread is laid."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .lines.catenary.solve import solve_lines, span_at_tension


@dataclass(frozen=True)
class Line:
    """One uniform line.

    anchor : (3,) m, in space, on the bed
    fairlead : (3,) m, in body axes, which coincide with space axes at rest
    length : m, unstretched; weight : N/m, submerged; axial_stiffness : N, may be inf
    breaking_load : N, may be inf
    """

    name: str
    anchor: tuple[float, float, float]
    fairlead: tuple[float, float, float]
    length: float
    weight: float
    axial_stiffness: float = np.inf
    bed_friction: float = 0.0
    breaking_load: float = np.inf

    def __post_init__(self):
        if not self.breaking_load > 0:
            raise ValueError(f"line {self.name}: breaking_load is {self.breaking_load:g} N; allowed: above 0")
        if self.fairlead[2] < self.anchor[2]:
            raise ValueError(
                f"line {self.name}: fairlead z = {self.fairlead[2]:g} m is below its anchor, {self.anchor[2]:g} m"
            )


@dataclass(frozen=True)
class Layout:
    """All lines of a body; arrays follow the order of `lines`."""

    lines: tuple[Line, ...]

    def __post_init__(self):
        object.__setattr__(self, "lines", tuple(self.lines))
        names = [line.name for line in self.lines]
        if not names:
            raise ValueError("a layout needs at least one line")
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise ValueError(f"line name {twice!r} is used {names.count(twice)} times; allowed: once")

    def __len__(self):
        return len(self.lines)

    def __repr__(self):
        return f"<Layout {len(self)} lines, {self._column('length').sum():.6g} m>"

    def _column(self, name):
        return np.array([getattr(line, name) for line in self.lines], float)

    @cached_property
    def names(self):
        """(n,) names, in order"""
        return [line.name for line in self.lines]

    @cached_property
    def anchors(self):
        """(n, 3) m, in space"""
        return self._column("anchor")

    @cached_property
    def fairleads(self):
        """(n, 3) m, in body axes"""
        return self._column("fairlead")

    @cached_property
    def length(self):
        """(n,) m"""
        return self._column("length")

    @cached_property
    def weight(self):
        """(n,) N/m"""
        return self._column("weight")

    @cached_property
    def breaking_load(self):
        """(n,) N"""
        return self._column("breaking_load")

    @cached_property
    def _properties(self):
        return self.length, self.weight, self._column("axial_stiffness"), self._column("bed_friction")

    def solve(self, points, beyond_reach="mark"):
        """Lines with their fairleads at `points`.

        points : (n, 3) m, in space
        returns : LineSolution, and (n, 2) unit vectors pointing from anchor to fairlead in plan
        """
        away = (points - self.anchors)[:, :2]
        span = np.hypot(*away.T)
        # above its anchor a line has no direction; its horizontal force and stiffness there have none either
        outward = np.where(span[:, None] > 0, away / np.where(span > 0, span, 1.0)[:, None], [1.0, 0.0])
        height = points[:, 2] - self.anchors[:, 2]
        return solve_lines(span, height, *self._properties, beyond_reach=beyond_reach), outward


def pretensioned(
    name,
    fairlead,
    heading,
    depth,
    length,
    weight,
    pretension,
    axial_stiffness=np.inf,
    bed_friction=0.0,
    breaking_load=np.inf,
):
    """A Line whose anchor is placed so that the body at rest feels a given horizontal tension.

    fairlead : (3,) m; heading : rad, from the fairlead to the anchor; depth : m; pretension : N, horizontal
    """
    height = fairlead[2] + depth
    span, _ = span_at_tension(pretension, height, length, weight, axial_stiffness, bed_friction)
    anchor = (fairlead[0] + float(span) * np.cos(heading), fairlead[1] + float(span) * np.sin(heading), -depth)
    return Line(
        name,
        tuple(map(float, anchor)),
        tuple(map(float, fairlead)),
        length,
        weight,
        axial_stiffness,
        bed_friction,
        breaking_load,
    )


def corner_spread(hull_length, beam, headings, depth, length, weight, pretension, *, z=0.0, **properties):
    """Lines from the four corners of a box at mirrored headings.

    headings : rad between 0 and π/2, from the x axis, for the corner at +x, +y
    z : height of the fairleads, m; properties : further arguments of `pretensioned`
    returns : Layout, named by corner and number: "fore port 1", …
    """
    lines = []
    for end, sx in (("fore", 1), ("aft", -1)):
        for side, sy in (("port", 1), ("starboard", -1)):
            for number, angle in enumerate(headings, 1):
                heading = np.arctan2(sy * np.sin(angle), sx * np.cos(angle))
                fairlead = (0.5 * sx * hull_length, 0.5 * sy * beam, z)
                name = f"{end} {side} {number}"
                lines.append(pretensioned(name, fairlead, heading, depth, length, weight, pretension, **properties))
    return Layout(lines)
