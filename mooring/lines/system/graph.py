"""Lines between bodies, anchors, buoys and sinkers as a graph: the system, a pose of it, and the forces in that pose.

Degrees of freedom: six of each body (shift of its origin, rotation about space axes), then three of each free point, in
the order in which the parts are given.  Stiffness is −∂(force, moment about the moving origin). The bed is flat at z
= −depth. Lines without a weight in air have their weight in water also above the surface.  Friction of the bed acts
on lines that end at an anchor on the bed. Friction between free points would depend on history and is neglected.
Equations of equilibrium: SR179 report (1982), sections 3.1.5 and 3.5.1.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..catenary.state import State
from .bodies import rotation
from .checks import ON_BED, check_system
from .composite import composite, fill_row
from .findings import culprit
from .hawser import Hawser, fill_hawser
from .parts import (
    Anchor,
    CompositeLine,
    EquilibriumError,
    Fairlead,
    FreePoint,
    LineSystemError,
    MooredBody,
    UniformLine,
)
from .surfacing import fill_surfacing, surfacing


class Pose(NamedTuple):
    """Positions of the moving parts.

    place : (b, 3) m, origins of the bodies; turn : (b, 3, 3) rotations; free : (f, 3) m, free points
    """

    place: np.ndarray
    turn: np.ndarray
    free: np.ndarray


class LineForces(NamedTuple):
    """Forces at the ends a and b of every line, each (n,).

    horizontal : pull towards the other end, N; vertical : downward pull on the attachment, N
    tension : N; grounded_length : m; status : values of `mooring.catenary.State`
    utilisation : tension over breaking load in the segment with the largest ratio; nan without a known breaking
        load. Beyond the reach of a line its forces and utilisation are infinite
    solutions : {number of a multi-segment line: StaticSolution}
    """

    horizontal_a: np.ndarray
    horizontal_b: np.ndarray
    vertical_a: np.ndarray
    vertical_b: np.ndarray
    tension_a: np.ndarray
    tension_b: np.ndarray
    grounded_length: np.ndarray
    status: np.ndarray
    utilisation: np.ndarray
    solutions: dict


class SystemLoad(NamedTuple):
    """force : (N,) on every degree of freedom; stiffness : (N, N); rows : (n, 18); points : (p, 3) m in space

    solutions : {number of a multi-segment line: StaticSolution, or None without a solution}
    """

    force: np.ndarray
    stiffness: np.ndarray
    rows: np.ndarray
    points: np.ndarray
    solutions: dict


class SystemArrays(NamedTuple):
    """A system in the form that its kernels read.

    position : (p, 3) m, of points in space or in the axes of their body; owner : (p,), number of the body, FIXED or
        FREE
    column : (p,), first degree of freedom; floats : (p, 3), weight and buoyancy of free points, N, and their height, m
    ends : (n, 2), points of each line; flipped : (n,), whether the line is solved from end b, its anchor on the bed
    lines : (n, 4), length, weight, 1/EA and friction; 0 for lines that are not uniform or have a weight in air
    bed : height of the bed, m
    """

    position: np.ndarray
    owner: np.ndarray
    column: np.ndarray
    floats: np.ndarray
    ends: np.ndarray
    flipped: np.ndarray
    lines: np.ndarray
    bed: float


@dataclass(frozen=True)
class System:
    """Lines, the points that they join, and the bodies to which points belong.  depth : m; density : kg/m³; gravity :
    m/s²
    """

    depth: float
    lines: tuple[UniformLine | CompositeLine | Hawser, ...]
    points: tuple[Anchor | Fairlead | FreePoint, ...]
    bodies: tuple[MooredBody, ...] = ()
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

    @cached_property
    def breaking_load(self):
        """Breaking load of each line, N, of a multi-segment line the smallest; shape (n,)"""
        return np.array([line.breaking_load for line in self.lines])

    @cached_property
    def pose(self):
        """Pose in which the system was given"""
        given = np.array([body.position for body in self.bodies], float).reshape(-1, 6)
        turn = np.array([rotation(*angles) for angles in given[:, 3:]]).reshape(-1, 3, 3)
        free = np.array([point.position for point in self.free_points], float).reshape(-1, 3)
        return Pose(given[:, :3].copy(), turn, free)

    @cached_property
    def arrays(self):
        """SystemArrays"""
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
        lines = np.zeros((len(self.lines), 4))
        for i, (line, end) in enumerate(zip(self.lines, anchored, strict=True)):
            if isinstance(line, UniformLine) and line.weight_in_air is None:
                friction = line.bed_friction * bool(end)
                lines[i] = line.length, line.type.weight, 1 / line.type.axial_stiffness, friction
        flipped = np.array([end == "b" for end in anchored])
        return SystemArrays(position, owner, column, floats, ends, flipped, lines, -float(self.depth))

    @cached_property
    def composites(self):
        """Composite of every multi-segment line, in the order of the lines"""
        numbers = [i for i, line in enumerate(self.lines) if isinstance(line, CompositeLine)]
        return tuple(composite(self, i, self.anchored_ends[i]) for i in numbers)

    @cached_property
    def surfacing(self):
        """`surfacing.Surfacing` of every line with a weight in air"""
        return surfacing(self) if any(getattr(line, "weight_in_air", None) is not None for line in self.lines) else ()

    @cached_property
    def hawsers(self):
        """Numbers of the lines that are a `Hawser`"""
        return tuple(i for i, line in enumerate(self.lines) if isinstance(line, Hawser))

    @cached_property
    def anchored_ends(self):
        """Which end of each line is an anchor on the bed; shape (n,): "a", "b", or "" for neither or both"""
        anchors = {point.name: point.position[2] for point in self.points if isinstance(point, Anchor)}
        on_bed = {name for name, z in anchors.items() if abs(z + self.depth) <= ON_BED}
        found = []
        for line in self.lines:
            if isinstance(line, CompositeLine) and line.bed is not None:  # its own bed begins at its anchor
                found.append("a" if line.a in anchors else "b" if line.b in anchors else "")
            else:
                a, b = line.a in on_bed, line.b in on_bed
                found.append("" if a == b else "a" if a else "b")
        return found

    def load(self, pose=None) -> SystemLoad:
        """Forces of the lines and of the weight and buoyancy of the free points, and the stiffness of these forces.

        The force is nan beyond the reach of a line or for an end below the bed.  Loads and hydrostatics of the bodies
        are not included: see `total_load`.
        """
        from .assembly import assemble

        pose = self.pose if pose is None else pose
        if self.composites or self.hawsers or self.surfacing:
            return self._load_by_rows(pose)
        return SystemLoad(*assemble(*self.arrays, *pose), {})

    def _load_by_rows(self, pose):
        from .assembly import add_rows, place_points

        position, owner, column, floats, ends, flipped, _, _ = self.arrays
        points = place_points(position, owner, column, *pose)
        rows, solutions = self._rows(points, ends)
        size = 6 * len(self.bodies) + 3 * len(self.free_points)
        force, K = add_rows(rows, points, owner, column, floats, ends, flipped, pose.place, size)
        return SystemLoad(force, K, rows, points, solutions)

    def _rows(self, points, ends):
        """Rows of all lines, each from its anchored end, and {number: StaticSolution} of those of segments."""
        from .assembly import rows_of

        arrays, solutions = self.arrays, {}
        rows = rows_of(points, ends, arrays.flipped, arrays.lines, arrays.bed)
        for one in self.composites:
            A, B = points[ends[one.number][::-1] if one.flipped else ends[one.number]]
            solutions[one.number] = fill_row(rows[one.number], one, A, B)
        for i in self.hawsers:
            fill_hawser(rows[i], self.lines[i], *points[ends[i][::-1] if arrays.flipped[i] else ends[i]])
        for one in self.surfacing:
            fill_surfacing(rows[one.number], one, *points[ends[one.number][::-1] if one.flipped else ends[one.number]])
        return rows, solutions

    def forces_between(self, starts, ends) -> LineForces:
        """Forces of every line with its ends fixed at `starts` and `ends`, each (n, 3) m in space.

        Forces are infinite beyond the reach of a line.
        raises : EquilibriumError for a line whose forces cannot be computed for another reason
        """
        from ..catenary.flat_bed import exchange

        count = len(self.lines)
        pairs = np.column_stack([np.arange(count), count + np.arange(count)])
        rows, solutions = self._rows(np.concatenate([starts, ends]), pairs)
        if np.any(rows[:, 0] > State.BEYOND_REACH):
            raise EquilibriumError(culprit(self, rows, starts, ends, "where its ends are held"))
        for row, flipped in zip(rows, self.arrays.flipped, strict=True):
            if flipped:
                exchange(row)
        return line_forces(self, rows, solutions)

    def total_load(self, pose=None) -> SystemLoad:
        """The SystemLoad of `load` plus the steady loads and hydrostatic forces of the bodies."""
        pose = self.pose if pose is None else pose
        load = self.load(pose)
        if self.bodies:
            from .hydrostatics import add_loads

            add_loads(load.force, load.stiffness, *self.body_loads, pose.place, pose.turn)
        return load

    @cached_property
    def body_loads(self):
        """Steady load, N and N m, shape (b, 6); hydrostatic stiffness, shape (b, 6, 6), 0 for a body without it; and z
        at rest, m, shape (b,)"""
        springs = [body.hydrostatic_stiffness for body in self.bodies]
        springs = [np.zeros((6, 6)) if spring is None else np.array(spring, float) for spring in springs]
        loads = np.array([body.load for body in self.bodies], float)
        return loads, np.array(springs), self.pose.place[:, 2].copy()

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
        """The system after the loss of a line; lines that then hang by one end alone are removed too."""
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


def line_forces(system, rows, solutions) -> LineForces:
    """The forces at the ends of the lines, by name, from the rows of a SystemLoad."""
    beyond = np.flatnonzero(rows[:, 0] == State.BEYOND_REACH)
    if len(beyond):
        rows = rows.copy()
        rows[beyond, 1:5], rows[beyond, 5] = np.inf, 0.0
    status, ha, hb, va, vb, lying = rows[:, :6].T
    tension_a, tension_b = np.hypot(ha, va), np.hypot(hb, vb)
    with np.errstate(invalid="ignore"):
        used = np.maximum(tension_a, tension_b) / system.breaking_load
    for number, found in solutions.items():
        if found is not None:
            segments = zip(found.segment_tensions, found.line.segments, strict=True)
            used[number] = max(tension / segment.breaking_load for tension, segment in segments)
    used[np.isinf(system.breaking_load)] = np.nan
    used[beyond] = np.inf
    return LineForces(ha, hb, va, vb, tension_a, tension_b, lying, status.astype(int), used, solutions)
