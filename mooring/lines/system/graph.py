"""Lines between bodies, anchors, buoys and sinkers as a graph: the system, a pose of it, and the forces in that pose.

Degrees of freedom: six of each body (shift of its origin, rotation about space axes), then three of each free
point, in the order in which the parts are given.  Stiffness is −∂(force, moment about the moving origin).
The bed is flat at z = −depth; lines weigh what they weigh in water, also where they leave it.  Friction of the bed
is counted on lines that end at an anchor on it: between free points it would depend on history.
Equations of equilibrium: SR179 report (1982), sections 3.1.5 and 3.5.1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .bodies import hydrostatic_load, rotation
from .checks import ON_BED, check_system
from .parts import Anchor, Body, Fairlead, FreePoint, LineSystemError, LineType, SystemLine


class Pose(NamedTuple):
    """Where the moving parts are.

    place : (b, 3) m, origins of the bodies; turn : (b, 3, 3) rotations; free : (f, 3) m, free points
    """

    place: np.ndarray
    turn: np.ndarray
    free: np.ndarray


class LineForces(NamedTuple):
    """Forces at the ends a and b of every line, each (n,).

    horizontal : N towards the other end; vertical : N, downward pull on what the end is made fast to
    tension : N; grounded_length : m; status : values of `mooring.catenary.State`
    """

    horizontal_a: np.ndarray
    horizontal_b: np.ndarray
    vertical_a: np.ndarray
    vertical_b: np.ndarray
    tension_a: np.ndarray
    tension_b: np.ndarray
    grounded_length: np.ndarray
    status: np.ndarray


class SystemLoad(NamedTuple):
    """force : (N,) on every degree of freedom; stiffness : (N, N); rows : (n, 18); points : (p, 3) m in space"""

    force: np.ndarray
    stiffness: np.ndarray
    rows: np.ndarray
    points: np.ndarray


@dataclass(frozen=True)
class System:
    """Lines, the points they join and the bodies these belong to.  depth : m; density : kg/m³; gravity : m/s²"""

    depth: float
    lines: tuple[SystemLine, ...]
    points: tuple[Anchor | Fairlead | FreePoint, ...]
    bodies: tuple[Body, ...] = ()
    density: float = 1025.0
    gravity: float = 9.80665

    def __post_init__(self):
        for name in ("lines", "points", "bodies"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        check_system(self)

    def __repr__(self):
        loose = len(self.free_points)
        return f"<System {len(self.lines)} lines, {len(self.bodies)} bodies, {loose} free points, {self.depth:g} m>"

    @cached_property
    def free_points(self):
        """FreePoints in the order of their degrees of freedom"""
        return tuple(point for point in self.points if isinstance(point, FreePoint))

    @property
    def line_names(self):
        return [line.name for line in self.lines]

    @property
    def breaking_load(self):
        """(n,) N"""
        return np.array([line.type.breaking_load for line in self.lines])

    @cached_property
    def pose(self):
        """Pose in which the system was given"""
        given = np.array([body.position for body in self.bodies], float).reshape(-1, 6)
        turn = np.array([rotation(*angles) for angles in given[:, 3:]]).reshape(-1, 3, 3)
        free = np.array([point.position for point in self.free_points], float).reshape(-1, 3)
        return Pose(given[:, :3].copy(), turn, free)

    @cached_property
    def arrays(self):
        """What the kernel wants: position, owner, column, floats, ends, turned, lines, bed"""
        from .assembly import FIXED, FREE

        number = {body.name: i for i, body in enumerate(self.bodies)}
        position = np.array([point.position for point in self.points], float)
        owner = np.full(len(self.points), FIXED, np.int64)
        column, floats = np.zeros(len(self.points), np.int64), np.zeros((len(self.points), 3))
        column_free = 6 * len(self.bodies)
        for i, point in enumerate(self.points):
            if isinstance(point, Fairlead):
                owner[i], column[i] = number[point.body], 6 * number[point.body]
            elif isinstance(point, FreePoint):
                owner[i], column[i] = FREE, column_free
                column_free += 3
                floats[i] = (
                    self.gravity * point.mass,
                    self.density * self.gravity * point.volume,
                    point.emersion_height,
                )
            elif abs(position[i, 2] + self.depth) <= ON_BED:
                position[i, 2] = -self.depth
        index = {point.name: i for i, point in enumerate(self.points)}
        ends = np.array([[index[line.a], index[line.b]] for line in self.lines], np.int64).reshape(-1, 2)
        anchored = self.anchored_ends
        lines = np.array(
            [
                [line.length, line.type.weight, 1 / line.type.axial_stiffness, line.bed_friction * bool(end)]
                for line, end in zip(self.lines, anchored, strict=True)
            ]
        )
        turned = np.array([end == "b" for end in anchored])
        return position, owner, column, floats, ends, turned, lines.reshape(-1, 4), -float(self.depth)

    @cached_property
    def anchored_ends(self):
        """(n,) which end of each line is an anchor on the bed: "a", "b", or "" where neither or both are"""
        on_bed = {
            point.name
            for point in self.points
            if isinstance(point, Anchor) and abs(point.position[2] + self.depth) <= ON_BED
        }
        found = [(line.a in on_bed, line.b in on_bed) for line in self.lines]
        return ["" if a == b else "a" if a else "b" for a, b in found]

    def load(self, pose=None) -> SystemLoad:
        """Forces of the lines and of the free points' weight and buoyancy, and their stiffness.

        The force is nan where a line cannot reach or an end is below the bed.  Loads and hydrostatics of the
        bodies are not in it: see `total_load`.
        """
        from .assembly import assemble

        return SystemLoad(*assemble(*self.arrays, *(self.pose if pose is None else pose)))

    def total_load(self, pose=None) -> SystemLoad:
        """`load` with the steady loads and the hydrostatic forces of the bodies."""
        pose = self.pose if pose is None else pose
        load = self.load(pose)
        for i, body in enumerate(self.bodies):
            own = slice(6 * i, 6 * i + 6)
            load.force[own] += body.load
            if body.hydrostatic_stiffness is not None:
                sinkage = pose.place[i, 2] - body.position[2]
                force, K = hydrostatic_load(body.hydrostatic_stiffness, sinkage, pose.turn[i])
                load.force[own] += force
                load.stiffness[own, own] += K
        return load

    def with_loads(self, loads):
        """The same system under other steady loads: {body name: (6,) N and N m}."""
        unknown = set(loads) - {body.name for body in self.bodies}
        if unknown:
            names = ", ".join(body.name for body in self.bodies) or "none, the system has no body"
            raise LineSystemError(f"body {min(unknown)!r} is unknown; allowed: {names}")
        bodies = [
            replace(body, load=tuple(map(float, loads[body.name]))) if body.name in loads else body
            for body in self.bodies
        ]
        return replace(self, bodies=tuple(bodies))

    def without(self, name):
        """The system after the loss of a line; what then hangs loose by one end goes with it."""
        if name not in self.line_names:
            raise LineSystemError(f"line {name!r} is unknown; allowed: {', '.join(self.line_names)}")
        lines = [line for line in self.lines if line.name != name]
        free = {point.name for point in self.free_points}
        while True:
            joined = [end for line in lines for end in (line.a, line.b)]
            loose = {point for point in free if joined.count(point) == 1}
            kept = [line for line in lines if not {line.a, line.b} & loose]
            if len(kept) == len(lines):
                break
            lines = kept
        points = [point for point in self.points if point.name not in free or point.name in joined]
        return replace(self, lines=tuple(lines), points=tuple(points))


def line_forces(load: SystemLoad) -> LineForces:
    """The forces at the ends of the lines, by name."""
    status, ha, hb, va, vb, lying = load.rows[:, :6].T
    return LineForces(ha, hb, va, vb, np.hypot(ha, va), np.hypot(hb, vb), lying, status.astype(int))


def system_of_layout(layout, depth, body=None, density=1025.0, gravity=9.80665):
    """The System of a `mooring.layout.Layout` on one Body (at the origin if none is given)."""
    body = body or Body("body")
    points, lines = [], []
    for line in layout.lines:
        points += [
            Anchor(f"{line.name} anchor", line.anchor),
            Fairlead(f"{line.name} fairlead", body.name, line.fairlead),
        ]
        kind = LineType(line.name, line.weight, line.axial_stiffness, breaking_load=line.breaking_load)
        ends = points[-2].name, points[-1].name
        lines.append(SystemLine(line.name, kind, line.length, *ends, line.bed_friction))
    return System(depth, lines, points, (body,), density, gravity)
