"""Equilibrium of a system of lines: Newton's method on the exact stiffness, with the bed as a one-sided support.

A free point on the bed stays there while forces press it down (z ≥ −depth and R ≥ 0, one of them zero); the bed has
no friction for free points.  A step is halved while the force after the step points back. In directions of negative
stiffness, damping makes the step follow the force.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from hakobune.bem import DOFS

from ..catenary.state import State
from .bodies import angles, rotated
from .composite import check_free
from .findings import culprit, freedom_name, warn_of_floating, warn_of_friction, warn_of_sliding
from .graph import LineForces, Pose, System, line_forces
from .parts import EquilibriumError

TARGET, LIMIT = 1e-12, 1e-9  # target and accepted limit of the residual, over the sum of all forces


@dataclass(frozen=True)
class SystemEquilibrium:
    """A system at rest.

    pose : Pose; points : (p, 3) m; lines : LineForces; iterations : steps taken
    residual : (N,), forces that remain on the free degrees of freedom, N and N m; 0 on fixed degrees of freedom
    stiffness : (N, N), of lines, buoyancy and hydrostatics; moving : (N,), whether a degree of freedom is free
    on_bed : (f,) whether a free point rests on the bed, with `bed_reaction` N
    """

    system: System
    pose: Pose
    points: np.ndarray
    lines: LineForces
    iterations: int
    force: np.ndarray
    residual: np.ndarray
    stiffness: np.ndarray
    moving: np.ndarray
    on_bed: np.ndarray
    bed_reaction: np.ndarray

    def __repr__(self):
        largest = np.max(np.maximum(self.lines.tension_a, self.lines.tension_b))
        return f"<SystemEquilibrium {len(self.system.lines)} lines, largest tension {largest:.5g} N>"

    @property
    def position(self):
        """Position of each body: origin, m, then roll, pitch and yaw, rad; shape (b, 6)"""
        attitude = np.array([angles(R) for R in self.pose.turn]).reshape(-1, 3)
        return np.hstack([self.pose.place, attitude])

    @property
    def tension(self):
        """Larger of the tensions at the two ends of each line, N; shape (n,)"""
        return np.maximum(self.lines.tension_a, self.lines.tension_b)


def freedom(system):
    """Numbers of the degrees of freedom on which forces may act; shape (N,)."""
    bodies = [[name in body.freedom for name in DOFS] for body in system.bodies]
    return np.concatenate([np.array(bodies, bool).ravel(), np.ones(3 * len(system.free_points), bool)])


def moved(system, pose, step):
    """The pose after a step (N,) of every degree of freedom; free points stop at the bed."""
    count = len(system.bodies)
    if count:
        steps = step[: 6 * count].reshape(count, 6)
        place = pose.place + steps[:, :3]
        turn = np.array([rotated(R, s) for R, s in zip(pose.turn, steps[:, 3:], strict=True)])
    else:
        place, turn = pose.place, pose.turn
    free = pose.free + step[6 * count :].reshape(-1, 3)
    if len(free):
        free[:, 2] = np.maximum(free[:, 2], -system.depth)
    return Pose(place, turn, free)


def rest(system: System, start: Pose | None = None, steps=2000) -> SystemEquilibrium:
    """The equilibrium of a system under the loads of its bodies, sought from a pose.

    start : Pose; by default the pose of the system
    raises : EquilibriumError, which names the remaining forces and the bodies or points where they act
    """
    from .steps import left_over

    pose = system.pose if start is None else start
    pose = moved(system, pose, np.zeros(6 * len(system.bodies) + 3 * len(system.free_points)))
    may = freedom(system)
    unit = _units(system)
    moving, residual = np.zeros(len(unit), bool), np.zeros(len(unit))
    given = _given(system)
    lengths = sorted(line.length for line in system.lines)
    radius = longest = 0.05 * float(lengths[len(lengths) // 2])
    load = system.total_load(pose)
    if np.any(load.rows[:, 0] >= State.BEYOND_REACH):
        a, b = load.points[system.arrays.ends].swapaxes(0, 1)
        where = "at the start of the search" if may.any() else "where its ends are held"
        raise EquilibriumError(culprit(system, load.rows, a, b, where))
    count, before = 0, np.zeros(len(unit))
    while count < steps:
        left, scale = left_over(load.force, load.rows, pose.free, -system.depth, may, unit, moving, residual)
        if left <= TARGET * (scale + given):
            break
        found = _advance(system, pose, load, moving, residual, unit, radius)
        count += 1
        if found is None:
            break
        pose, load, step = found
        radius = min(_next_radius(radius, step, before), 16 * longest)
        before = step
    return _found(system, pose, load, may, unit, count)


def _next_radius(radius, step, before):
    """m; when iterates go to and fro across a kink, such as a line that falls slack, steps become ever shorter"""
    size = math.sqrt(step @ step)
    back = before @ step < -0.5 * math.sqrt(before @ before) * size
    return 0.5 * size if back else max(2 * size, radius)


def _units(system):
    """Units in which the motions are compared, moments as forces at the outermost fairlead of the body; shape (N,)."""
    unit = np.ones(6 * len(system.bodies) + 3 * len(system.free_points))
    if not system.bodies:
        return unit
    arms = np.sqrt((system.arrays.position**2).sum(axis=1))
    for i in range(len(system.bodies)):
        unit[6 * i + 3 : 6 * i + 6] = arms[system.arrays.owner == i].max(initial=1.0)
    return unit


def _given(system):
    """N, all forces except those of the lines"""
    return sum(np.abs(body.load[:3]).sum() for body in system.bodies) + system.arrays.floats[:, :2].sum()


def _advance(system, pose, load, moving, residual, unit, radius):
    """The next pose, its load and the step (N,) m to it; None if no step is short enough.

    A step that overshoots is rejected, and repeated within a smaller radius with the same stiffness.
    """
    from .steps import FOUND, ahead_of, step_within

    step, least, indefinite = np.zeros_like(residual), 1e-14 * radius, None
    while radius > least:
        if indefinite is None and step_within(load.stiffness, residual, unit, moving, radius, step) != FOUND:
            indefinite = _Indefinite(load.stiffness, residual, unit, moving)
        if indefinite is not None:
            step[moving] = indefinite.within(radius)
        following = moved(system, pose, step / unit)
        ahead = system.total_load(following)
        forth, here, size = ahead_of(step, residual, ahead.force, following.free, -system.depth, unit)
        if forth >= -0.5 * abs(here):  # false for nan: out of reach
            return following, ahead, step
        radius = 0.5 * min(size, radius)
    return None


class _Indefinite:
    """Steps of a given length for a stiffness K with negative eigenvalues: (|K| + m) s = r, m ≥ 0.

    |K| has the absolute eigenvalues of the symmetric part of K.
    """

    def __init__(self, stiffness, residual, unit, moving):
        chosen = np.flatnonzero(moving)
        K = stiffness[np.ix_(chosen, chosen)] / np.outer(unit[chosen], unit[chosen])
        values, self.vectors = np.linalg.eigh(0.5 * (K + K.T))
        self.values, self.along = np.abs(values), self.vectors.T @ residual[chosen]

    def within(self, radius):
        """Step s of the k moving degrees of freedom, of length `radius`, or shorter if the step for m = 0 is; shape
        (k,)
        """
        high = np.linalg.norm(self.along) / radius
        if high == 0.0:
            return np.zeros(len(self.along))
        values = np.maximum(self.values, 1e-9 * high)
        if np.linalg.norm(self.along / values) <= radius:
            return self.vectors @ (self.along / values)
        low = 0.0
        for _ in range(60):
            if high - low <= 1e-2 * high:
                break
            middle = np.sqrt(max(low, 1e-12 * high) * high)
            low, high = (middle, high) if np.linalg.norm(self.along / (values + middle)) > radius else (low, middle)
        return self.vectors @ (self.along / (values + high))


def _found(system, pose, load, may, unit, count):
    from .steps import left_over

    moving, residual = np.zeros(len(unit), bool), np.zeros(len(unit))
    left, scale = left_over(load.force, load.rows, pose.free, -system.depth, may, unit, moving, residual)
    share = left / (scale + _given(system) or 1.0)
    residual *= unit
    if not share <= LIMIT:
        worst = int(np.argmax(np.abs(residual / unit)))
        raise EquilibriumError(
            f"no equilibrium was found in {count} steps: the residual on {freedom_name(system, worst)} is "
            f"{residual[worst]:.4g} {('N' if unit[worst] == 1 else 'N m')}, {share:.2g} of all forces; allowed: "
            f"{LIMIT:g}; start nearer to the equilibrium"
        )
    vertical = slice(6 * len(system.bodies) + 2, None, 3)
    on_bed = ~moving[vertical]
    reaction = np.where(on_bed, -load.force[vertical], 0.0)
    lines = line_forces(system, load.rows, load.solutions)
    check_free(system, load.points, load.solutions)
    warn_of_floating(system, load)
    warn_of_friction(system, lines)
    warn_of_sliding(system, lines)
    return SystemEquilibrium(
        system, pose, load.points, lines, count, load.force, residual, load.stiffness, moving, on_bed, reaction
    )


def held_at(system, positions):
    """The system with some bodies held at new positions {body name: (6,) m and rad}."""
    bodies = [
        replace(body, position=tuple(map(float, positions[body.name])), freedom=()) if body.name in positions else body
        for body in system.bodies
    ]
    return replace(system, bodies=tuple(bodies))
