"""Pull of the lines of a system on bodies in time; each line has the exact static shape for the positions of its ends.

A uniform line follows the closed forms, started from its last solution (`mooring.lines.catenary.moving_end`), eight
lines on the bed at once.  The pull of a multi-segment line, with sinkers, buoys or its own bed, is read from a table
that its solver fills over the span and height of the fairlead (`force_tables`). A hawser pulls along a straight line
with T(e) of its elongation. A hawser may run from one body to another body, which receives the opposite force.

With R = Rz(ψ) Ry(θ) Rx(φ) the forces on the rates of x, y, z, φ, θ, ψ are those of virtual work,

    Q_φ = M · Rz Ry e_x,    Q_θ = M · Rz e_y,    Q_ψ = M · e_z,    M = Σ R p × f.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, choose_less, load_vector, root, store_vector, to_scalars

from ..fenders.hysteresis import ContactTable, contact_table, reaction_of
from ..lines.catenary.moving_end import pull_of_any, tensions_near, workspace
from ..lines.catenary.state import GROUNDED
from ..lines.system.bodies import places_along, rotation
from ..lines.system.hawser import Hawser
from ..lines.system.parts import Anchor, Fairlead, UniformLine
from .force_tables import Packed, packed, packed_pull, tabulate
from .moving_lines.packed import Room
from .moving_lines.polynomial import TERMS, legendre
from .tables.groups import moved_by_shapes

reaction = kernel(inline=True, counted=False)(reaction_of)
NEVER = np.inf  # s, time of a line's break if it does not break
REACH = (1.5, 0.6)  # depths by which a span may decrease and a fairlead rise or sink in a table


@in_memory
class Lines(NamedTuple):
    """Lines in the form that the kernels read.

    anchor : (n, 3) m in space, or in axes of the `other` body; fairlead : (n, 3) m in axes of its `body`
    body, other : (n,), numbers of bodies; `other` is below 0 for an anchor; lines : (n, 4), length, weight, 1/EA,
        friction
    lost : times of breaks, (n,) s; bed : height of the bed, m; table : (n,), number of the line's table, below 0 for
        a closed form
    tables : `Packed`; hawser : (n,), number of the hawser's curve in `curves`, below 0 for all other lines
    place : origins of the bodies' axes at rest, (N, 3) m; moves : (n,), whether a line is dynamic
    bent : (2, n, f, 3), displacement u, m, per unit of f shapes at the `anchor` and the fairlead, in axes of their
        bodies
    """

    anchor: np.ndarray
    fairlead: np.ndarray
    body: np.ndarray
    other: np.ndarray
    lines: np.ndarray
    lost: np.ndarray
    bed: float
    table: np.ndarray
    tables: Packed
    hawser: np.ndarray
    curves: ContactTable
    place: np.ndarray
    moves: np.ndarray
    bent: np.ndarray


@in_memory
class LineWork(NamedTuple):
    """Values of the lines that are kept between evaluations.

    kept, rows : of `moving_end`; tension : (n, 2), horizontal and vertical pull at the fairlead, N
    uniform : (4, m), lines; on_bed : (m,), whether a line on the bed is solved together with others
    ends : (5, m), ends and spans of these lines; points : (6, m), their fairleads and anchors
    together : (m/8,), body of eight lines on the bed that are solved together from a rigid body, -1 for other groups
        of eight
    arm : (n, 2, 3) m in space, arms of the fairlead and of the other end on their bodies, or the anchor
    away : (n, 4) m, x and y from the other end, and the heights of both ends
    whole : (n,), whether a line is still unbroken
    given : (n, TERMS, 3) N in space, pull of dynamic lines as coefficients of Legendre's polynomials over a step of
        the body
    span : (3,) s, present time, and start and length of this step; terms : (TERMS,), work array
    sums : (N, 6), forces and moments in space on each body about the origin of its axes, N and N m
    bent : amplitudes of shapes, (f,), set by the caller; push : generalized forces on shapes, (f,)
    """

    kept: np.ndarray
    rows: np.ndarray
    uniform: np.ndarray
    on_bed: np.ndarray
    ends: np.ndarray
    points: np.ndarray
    together: np.ndarray
    arm: np.ndarray
    away: np.ndarray
    tension: np.ndarray
    whole: np.ndarray
    given: np.ndarray
    span: np.ndarray
    terms: np.ndarray
    sums: np.ndarray
    bent: np.ndarray
    push: np.ndarray


def line_work(lines):
    """`LineWork` of lines at 0 s"""
    count, shapes = len(lines.lost), lines.bent.shape[2]
    given, span = np.zeros((count, TERMS, 3)), np.array([0.0, 0.0, 1.0])
    kept, rows = workspace(count)
    uniform, on_bed = np.zeros((4, kept.shape[1])), np.zeros(kept.shape[1], bool)
    uniform[:, :count] = lines.lines.T
    sinks = (lines.lines[:, 1] > 0.0) & (lines.anchor[:, 2] == lines.bed) & (lines.other < 0)
    on_bed[:count] = sinks & (lines.table < 0) & (lines.hawser < 0) & ~lines.moves
    points = np.zeros((6, kept.shape[1]))
    points[:3, :count], points[3:, :count] = lines.fairlead.T, lines.anchor.T
    eights = [slice(n, min(n + WIDTH, count)) for n in range(0, count, WIDTH)]
    alike = [not shapes and on_bed[own].all() and np.ptp(lines.body[own]) == 0 for own in eights]
    together = np.array([lines.body[own][0] if same else -1 for own, same in zip(eights, alike, strict=True)], np.int64)
    return LineWork(
        kept, rows, uniform, on_bed, np.zeros((5, kept.shape[1])), points, together,
        np.zeros((count, 2, 3)), np.zeros((count, 4)),
        np.zeros((count, 2)), lines.lost > 0.0, given, span, np.zeros(TERMS),
        np.zeros((len(lines.place), 6)), np.zeros(shapes), np.zeros(shapes),
    )  # fmt: skip


@kernel(counted=False)
def hold(lines, work, t):
    """Mark the lines that are unbroken at t s."""
    for i in range(lines.lost.size):
        work.whole[i] = lines.lost[i] > t


def body_lines(system, lost=(), tables=((), ()), moving=(), bodies=1):
    """`Lines` of a System, from anchors to fairleads, or between bodies; for None, no lines on `bodies` bodies.

    tables : ForceTables, and for every line the number of its table, below 0 for a uniform line (`tables_of`)
    lost : (name, time in s) of lines that break; moving : numbers of dynamic lines
    raises : ValueError for systems of any other kind, and for unknown names
    """
    if system is None:
        return _arrays([], [], [], [], [], [], -1.0, np.zeros((bodies, 3)), tables, [], [], [])
    points = {point.name: point for point in system.points}
    unknown = {name for name, _ in lost} - set(system.line_names)
    if unknown:
        raise ValueError(f"the line to break, {min(unknown)!r}, is unknown; allowed: {', '.join(system.line_names)}")
    names, anchors, fairleads, given, owners = [body.name for body in system.bodies], [], [], [], []
    for line in system.lines:
        ends = ends_in_time(line, points)
        anchors.append(ends[0].position)
        fairleads.append(ends[1].position)
        owners.append([names.index(end.body) if isinstance(end, Fairlead) else -1 for end in ends])
        uniform = isinstance(line, UniformLine)
        kind = (line.type.weight, 1 / line.type.axial_stiffness) if uniform else (1.0, 1.0)  # tables stretch
        given.append((line.length, *kind, line.bed_friction))
    anchors, (other, body) = np.array(anchors, float).reshape(-1, 3), np.array(owners, np.int64).reshape(-1, 2).T
    near = (other < 0) & (np.abs(anchors[:, 2] + system.depth) <= 1e-6 * system.depth)
    anchors[near, 2] = -system.depth
    times = np.full(len(given), NEVER)
    for name, when in lost:
        times[system.line_names.index(name)] = when
    place = np.array([one.position[:3] for one in system.bodies], float)
    number = np.full(len(given), -1)
    number[list(system.hawsers)] = np.arange(len(system.hawsers))
    pulls = [system.lines[i].pull for i in system.hawsers]
    moves = np.isin(np.arange(len(given)), list(moving))
    level = -float(system.depth)
    return _arrays(anchors, fairleads, body, other, given, times, level, place, tables, number, pulls, moves)


def with_shapes(lines, reader):
    """`Lines` whose ends move with the shapes of the bodies of a `bem.database.reader.Reader`"""
    bent = np.zeros((2, len(lines.lost), len(reader.modes), 3))
    for own, owners, points in zip(bent, (lines.other, lines.body), (lines.anchor, lines.fairlead), strict=True):
        for body in set(owners[owners >= 0].tolist()):
            own[owners == body] = moved_by_shapes(reader, body, points[owners == body])
    return lines._replace(bent=bent)


def ends_at_rest(lines, at_rest):
    """Both ends of `Lines` in space, m, with the bodies' axes at (N, 6), m and rad; two arrays (n, 3)"""
    turns = [rotation(0.0, 0.0, heading) for heading in at_rest[:, 5]]

    def placed(body, point):
        if body < 0:
            return point
        return (point if at_rest[body, 5] == 0.0 else turns[body] @ point) + lines.place[body]

    return tuple(
        np.array([placed(*pair) for pair in zip(bodies, points, strict=True)]).reshape(-1, 3)
        for bodies, points in ((lines.other, lines.anchor), (lines.body, lines.fairlead))
    )


def ends_in_time(line, points):
    """The two ends of a line of a System: an anchor and a fairlead, or fairleads of two bodies joined by a hawser

    points : {name: point}. Raises ValueError for any other line.
    """
    a, b = points[line.a], points[line.b]
    if isinstance(b, Anchor):
        a, b = b, a
    if not isinstance(b, Fairlead) or not isinstance(a, Anchor | Fairlead):
        raise ValueError(f"line {line.name} runs from {line.a} to {line.b}; allowed: from an anchor to the body")
    if isinstance(a, Fairlead):
        if a.body == b.body:
            raise ValueError(f"line {line.name} runs from {a.body} to itself; allowed: to an anchor or another body")
        if not isinstance(line, Hawser):
            raise ValueError(
                f"line {line.name} hangs between {a.body} and {b.body}; a simulation allows a hawser there, of "
                "a type with elongation_percent and tension_kN, or spring_kN_per_m"
            )
    return a, b


def tables_of(system, start):
    """ForceTables of multi-segment lines about the bodies' positions at rest, and the index (n,) of each line's table.

    start : displacements of the bodies at rest from the given positions, (6N,). Equal lines share a table.
    raises : ValueError naming a line without equilibrium
    """
    points, R = {point.name: point for point in system.points}, np.zeros((3, 3))
    poses = {one.name: one.position + start[6 * i : 6 * i + 6] for i, one in enumerate(system.bodies)}
    reach = REACH[0] * system.depth, REACH[1] * system.depth
    tables, known, number = [], {}, np.full(len(system.lines), -1)
    for one in system.composites:
        line = system.lines[one.number]
        if not one.anchored:
            raise ValueError(f"line {line.name} has segments and no end on the bed; a simulation needs an anchored end")
        a, b = (points[line.b], points[line.a]) if one.flipped else (points[line.a], points[line.b])
        pose = poses[b.body]
        rotation_of(pose[3:], R)
        away = pose[:3] + R @ np.asarray(b.position, float) - np.asarray(a.position, float)
        span, height = float(np.hypot(*away[:2])), float(away[2])
        alike = (line.segments, line.loads, line.bed_friction, line.bed, round(span, 6), round(height, 6))
        if alike not in known:
            known[alike] = len(tables)
            try:
                tables.append(tabulate(one, line.breaking_load, span, height, reach))
            except ValueError as error:
                raise ValueError(f"line {line.name}: {error}") from None
        number[one.number] = known[alike]
    return tuple(tables), number


def _arrays(anchors, fairleads, body, other, given, times, bed, place, tables, hawser, pulls, moves):
    """Lines as arrays"""
    return Lines(
        np.asarray(anchors, float).reshape(-1, 3),
        np.array(fairleads, float).reshape(-1, 3),
        np.array(body, np.int64),
        np.array(other, np.int64),
        np.array(given, float).reshape(-1, 4),
        np.array(times, float),
        float(bed),
        np.asarray(tables[1], np.int64) if len(tables[1]) else np.full(len(given), -1),
        packed(tables[0]),
        np.asarray(hawser, np.int64),
        contact_table(pulls),
        place,
        np.asarray(moves, bool),
        np.zeros((2, len(given), 0, 3)),
    )


@kernel(inline=True, counted=False)
def rotation_of(angles, R):
    """R (3, 3) = Rz(yaw) Ry(pitch) Rx(roll) of (roll, pitch, yaw)"""
    a, b, c = np.cos(angles[0]), np.cos(angles[1]), np.cos(angles[2])
    d, e, f = np.sin(angles[0]), np.sin(angles[1]), np.sin(angles[2])
    R[0, 0], R[0, 1], R[0, 2] = c * b, c * e * d - f * a, c * e * a + f * d
    R[1, 0], R[1, 1], R[1, 2] = f * b, f * e * d + c * a, f * e * a - c * d
    R[2, 0], R[2, 1], R[2, 2] = -e, b * d, b * a


@kernel(inline=True, counted=False)
def generalized(position, fx, fy, fz, mx, my, mz, out):
    """Add a force and a moment about the origin of the body's axes, in space, to forces (6,) in heading axes."""
    cos, sin = np.cos(position[5]), np.sin(position[5])
    out[0] += cos * fx + sin * fy
    out[1] += -sin * fx + cos * fy
    out[2] += fz
    pitch_x, pitch_z = np.cos(position[4]), -np.sin(position[4])
    out[3] += pitch_x * (cos * mx + sin * my) + pitch_z * mz  # M · Rz Ry e_x
    out[4] += -sin * mx + cos * my  # M · Rz e_y
    out[5] += mz


@kernel(inline=True, counted=False)
def give_generalized(position, v, f, out):
    """Add a force f (3,) N in space at an arm v (3,) m to forces (6,) in heading axes."""
    generalized(
        position, f[0], f[1], f[2], v[1] * f[2] - v[2] * f[1], v[2] * f[0] - v[0] * f[2], v[0] * f[1] - v[1] * f[0], out
    )


@kernel(counted=False)
def fairlead_of(lines, i, state, bent, room, place, velocity):
    """Position (3,) m and velocity (3,) m/s in space of the fairlead of line i, from its body's state (12 or more,)

    bent : amplitudes of shapes and their rates, (2, f); room : `moving_lines.packed.Room`. The velocity along a
        direction is computed as the power of a unit force at the fairlead.
    """
    px, py, pz = lines.fairlead[i, 0], lines.fairlead[i, 1], lines.fairlead[i, 2]
    for k in range(bent.shape[1]):
        u, a = lines.bent[1, i, k], bent[0, k]
        px, py, pz = px + a * u[0], py + a * u[1], pz + a * u[2]
    rotation_of(state[3:6], room.R)
    for j in range(3):
        room.arm[j] = room.R[j, 0] * px + room.R[j, 1] * py + room.R[j, 2] * pz
        place[j] = lines.place[lines.body[i], j] + state[j] + room.arm[j]
    for j in range(3):
        room.unit[:] = 0.0
        room.push[:] = 0.0
        room.unit[j] = 1.0
        give_generalized(state, room.arm, room.unit, room.push)
        velocity[j] = 0.0
        for k in range(6):
            velocity[j] += room.push[k] * state[6 + k]
        for k in range(bent.shape[1]):
            u = lines.bent[1, i, k]
            velocity[j] += bent[1, k] * (room.R[j, 0] * u[0] + room.R[j, 1] * u[1] + room.R[j, 2] * u[2])


def fairlead_course(lines, i, states, bent=None):
    """Positions and velocities (2, n, 3), m and m/s, of the fairlead of line i, from its body's states (n, 12 or more)

    bent : amplitudes of shapes and their rates, (n, 2, f), None without shapes
    """
    bent = np.zeros((len(states), 2, 0)) if bent is None else bent
    room, course = Room(np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(6)), np.zeros((2, len(states), 3))
    for now, shapes, place, velocity in zip(states, bent, *course, strict=True):
        fairlead_of(lines, i, now, shapes, room, place, velocity)
    return course


@kernel(inline=True, counted=False)
def straight_pull(curves, number, length, span, rise):
    """Forces (H, V), N, of a hawser with the curve `number` and the unstretched length `length`, m; zero for a slack
    hawser
    """
    away = np.sqrt(span * span + rise * rise)
    T = reaction(curves, number, away - length, 1.0)
    return T * span / max(away, length), T * rise / max(away, length)


@kernel(inline=True, counted=False)
def add_moment(sums, b, ax, ay, az, x, y, z):
    """Add a force in space at an arm, and its moment, to the sums (N, 6) of a body."""
    sums[b, 0] += x
    sums[b, 1] += y
    sums[b, 2] += z
    sums[b, 3] = sums[b, 3] + ay * z - az * y
    sums[b, 4] = sums[b, 4] + az * x - ax * z
    sums[b, 5] = sums[b, 5] + ax * y - ay * x


@kernel(inline=True, counted=False)
def push_shapes(shapes, R, x, y, z, push):
    """Add to push (f,) the products f · R u; f : force (x, y, z) in space, N; u : motion of its point per unit of
    shapes, (f, 3)
    """
    for k in range(push.size):
        ux, uy, uz = shapes[k, 0], shapes[k, 1], shapes[k, 2]
        along = x * (R[0, 0] * ux + R[0, 1] * uy + R[0, 2] * uz)
        along += y * (R[1, 0] * ux + R[1, 1] * uy + R[1, 2] * uz)
        push[k] += along + z * (R[2, 0] * ux + R[2, 1] * uy + R[2, 2] * uz)


@kernel(inline=True, counted=False)
def place_end(lines, work, i, positions, R):
    """Write the arms of both ends of line i into work.arm, and their distances into work.away"""
    b, other = lines.body[i], lines.other[i]
    px, py, pz = lines.fairlead[i, 0], lines.fairlead[i, 1], lines.fairlead[i, 2]
    for k in range(work.bent.size):
        u = lines.bent[1, i, k]
        px, py, pz = px + work.bent[k] * u[0], py + work.bent[k] * u[1], pz + work.bent[k] * u[2]
    ax = R[b, 0, 0] * px + R[b, 0, 1] * py + R[b, 0, 2] * pz
    ay = R[b, 1, 0] * px + R[b, 1, 1] * py + R[b, 1, 2] * pz
    az = R[b, 2, 0] * px + R[b, 2, 1] * py + R[b, 2, 2] * pz
    ox, oy, oz = lines.anchor[i, 0], lines.anchor[i, 1], lines.anchor[i, 2]
    if other >= 0:
        px, py, pz = ox, oy, oz
        for k in range(work.bent.size):
            u = lines.bent[0, i, k]
            px, py, pz = px + work.bent[k] * u[0], py + work.bent[k] * u[1], pz + work.bent[k] * u[2]
        ox = R[other, 0, 0] * px + R[other, 0, 1] * py + R[other, 0, 2] * pz
        oy = R[other, 1, 0] * px + R[other, 1, 1] * py + R[other, 1, 2] * pz
        oz = R[other, 2, 0] * px + R[other, 2, 1] * py + R[other, 2, 2] * pz
    bx, by, bz = ox, oy, oz
    if other >= 0:
        bx += lines.place[other, 0] + positions[other, 0]
        by += lines.place[other, 1] + positions[other, 1]
        bz += lines.place[other, 2] + positions[other, 2]
    arm, away = work.arm[i], work.away[i]
    arm[0, 0], arm[0, 1], arm[0, 2], arm[1, 0], arm[1, 1], arm[1, 2] = ax, ay, az, ox, oy, oz
    away[0] = lines.place[b, 0] + positions[b, 0] + ax - bx
    away[1] = lines.place[b, 1] + positions[b, 1] + ay - by
    away[2], away[3] = bz, lines.place[b, 2] + positions[b, 2] + az


@kernel(inline=True, counted=False)
def follow_on_bed(lines, work):
    """Write H and V of the lines that lay on the bed a moment earlier into work.ends; nan for all other lines"""
    for n in range(0, work.on_bed.size, WIDTH):
        if work.together[n // WIDTH] >= 0:
            continue
        some = False
        for i in range(n, n + WIDTH):
            work.ends[2, i] = np.nan
            if work.on_bed[i] and work.kept[0, i] == GROUNDED:
                some = True
                away = work.away[i]
                work.ends[0, i] = np.sqrt(away[0] * away[0] + away[1] * away[1])
                work.ends[1, i] = away[3] - lines.bed
            else:
                work.ends[0, i] = work.ends[1, i] = np.nan
        if some:
            tensions_near(work.kept, work.uniform, work.ends, n)


@kernel(inline=True, counted=False)
def total(a):
    """Sum of a vector"""
    c = to_scalars(a)
    return ((c[0] + c[1]) + (c[2] + c[3])) + ((c[4] + c[5]) + (c[6] + c[7]))


@kernel(counted=False)
def loads_of_eight(lines, work, positions, R, n):
    """`line_loads` of lines n … n + 7 of `LineWork.together`, in vectors; returns whether all of them have a force"""
    b = work.together[n // WIDTH]
    points, ends, m, at = address(work.points), address(work.ends), work.points.shape[1], lines.place[b]
    px, py, pz = load_vector(points, n), load_vector(points, m + n), load_vector(points, 2 * m + n)
    ax = px * R[b, 0, 0] + py * R[b, 0, 1] + pz * R[b, 0, 2]
    ay = px * R[b, 1, 0] + py * R[b, 1, 1] + pz * R[b, 1, 2]
    az = px * R[b, 2, 0] + py * R[b, 2, 1] + pz * R[b, 2, 2]
    x = ax + (at[0] + positions[b, 0]) - load_vector(points, 3 * m + n)
    y = ay + (at[1] + positions[b, 1]) - load_vector(points, 4 * m + n)
    span, state = root(x * x + y * y), load_vector(address(work.kept), n)
    before = choose_less(state, GROUNDED + 0.5, choose_less(GROUNDED - 0.5, state, span, np.nan), np.nan)
    store_vector(ends, n, before)
    store_vector(ends, m + n, az + (at[2] + positions[b, 2] - lines.bed))
    store_vector(ends, 4 * m + n, span)
    tensions_near(work.kept, work.uniform, work.ends, n)
    good = True
    for i in range(n, min(n + WIDTH, lines.lost.size)):
        if not work.whole[i]:
            work.ends[2, i] = work.ends[3, i] = 0.0
        elif np.isnan(work.ends[2, i]):
            kept, row, high = work.kept[:, i], work.rows[i], work.ends[1, i] + lines.bed
            length, weight = lines.lines[i, 0], lines.lines[i, 1]
            H, V = pull_of_any(kept, row, work.ends[4, i], lines.bed, high, lines.bed, length, weight,
                               lines.lines[i, 2], lines.lines[i, 3])  # fmt: skip
            work.ends[2, i], work.ends[3, i] = H, V
        if np.isfinite(work.ends[2, i]):
            work.tension[i, 0], work.tension[i, 1] = work.ends[2, i], work.ends[3, i]
        else:
            good = False
    H, V = load_vector(ends, 2 * m + n), load_vector(ends, 3 * m + n)
    H, V = choose_less(H, np.inf, H, 0.0), choose_less(H, np.inf, V, 0.0)  # none where there is no line, or no force
    pull, z = choose_less(0.0, span, -H / span, 0.0), -V
    x, y, sums = x * pull, y * pull, work.sums[b]
    sums[0] += total(x)
    sums[1] += total(y)
    sums[2] += total(z)
    sums[3] += total(ay * z - az * y)
    sums[4] += total(az * x - ax * z)
    sums[5] += total(ax * y - ay * x)
    return good


@kernel(counted=False)
def line_loads(lines, work, positions, R, out):
    """Fill out (N, 6), generalized forces, in heading axes, of the lines on bodies at `positions` (N, 6)

    work.tension and R (N, 3, 3) are filled.  returns : whether every line has a force
    """
    for b in range(len(positions)):
        rotation_of(positions[b, 3:6], R[b])
    out[:] = 0.0
    work.sums[:] = 0.0
    work.push[:] = 0.0
    good = True
    legendre(2 * (work.span[0] - work.span[1]) / work.span[2] - 1, work.terms)
    for n in range(work.together.size):
        if work.together[n] >= 0:
            good = loads_of_eight(lines, work, positions, R, WIDTH * n) and good
    for i in range(lines.lost.size):
        if work.together[i // WIDTH] < 0:
            place_end(lines, work, i, positions, R)
    follow_on_bed(lines, work)
    for i in range(lines.lost.size):
        if work.together[i // WIDTH] >= 0:
            continue
        b, other = lines.body[i], lines.other[i]
        x = y = z = H = V = 0.0
        if work.whole[i] and lines.moves[i]:
            for k in range(TERMS):
                c = work.terms[k]
                x, y, z = x + c * work.given[i, k, 0], y + c * work.given[i, k, 1], z + c * work.given[i, k, 2]
            H, V = np.sqrt(x * x + y * y), -z
        elif work.whole[i]:
            x, y, low, high = work.away[i, 0], work.away[i, 1], work.away[i, 2], work.away[i, 3]
            span = np.sqrt(x * x + y * y)
            length, weight = lines.lines[i, 0], lines.lines[i, 1]
            flexibility, friction = lines.lines[i, 2], lines.lines[i, 3]
            H, V = work.ends[2, i], work.ends[3, i]
            # one after the other: of branches of one condition the compiler joins the ends, and counts references there
            if lines.table[i] >= 0:
                H, V = packed_pull(lines.tables, lines.table[i], span, high - low)
            if lines.hawser[i] >= 0:
                H, V = straight_pull(lines.curves, lines.hawser[i], length, span, high - low)
            if lines.table[i] < 0 and lines.hawser[i] < 0 and np.isnan(H):
                kept, row = work.kept[:, i], work.rows[i]
                H, V = pull_of_any(kept, row, span, low, high, lines.bed, length, weight, flexibility, friction)
            x, y, z = (-H * x / span, -H * y / span, -V) if span > 0.0 else (0.0, 0.0, -V)
        if np.isfinite(H):
            work.tension[i, 0], work.tension[i, 1] = H, V
            arm = work.arm[i]
            add_moment(work.sums, b, arm[0, 0], arm[0, 1], arm[0, 2], x, y, z)
            push_shapes(lines.bent[1, i], R[b], x, y, z, work.push)
            if other >= 0:
                add_moment(work.sums, other, arm[1, 0], arm[1, 1], arm[1, 2], -x, -y, -z)
                push_shapes(lines.bent[0, i], R[other], -x, -y, -z, work.push)
        else:
            good = False
    for b in range(len(positions)):
        f = work.sums[b]
        generalized(positions[b], f[0], f[1], f[2], f[3], f[4], f[5], out[b])
    return good


@kernel(counted=False)
def loads_at(lines, work, positions, R, out):
    """`line_loads` for calls from Python; a direct call would compile `line_loads` a second time"""
    return line_loads(lines, work, positions, R, out)


def but_berth(system, tables, body, spring):
    """Function of positions (n,) in space that gives the forces (n,) of lines, water and springs along body axes.

    Amplitudes of shapes, and forces on shapes, stand after those of all bodies.
    """
    headings, rigid = body.axes_at_rest[:, 5], body.rigid
    turn = places_along(headings)
    count, held = len(headings), turn @ spring[:rigid, :rigid] @ turn.T
    lines = with_shapes(body_lines(system, (), tables, bodies=count), body)
    work = line_work(lines)
    R, out, of_shapes = np.zeros((count, 3, 3)), np.zeros((count, 6)), spring[rigid:, rigid:]

    def others(place):
        poses = place[:rigid].reshape(-1, 6).copy()
        poses[:, 5] += headings
        work.bent[:] = place[rigid:]
        loads_at(lines, work, poses, R, out)
        pulls = places_along(poses[:, 5]).T @ (held @ place[:rigid])
        return np.append(out.ravel(), work.push) - body.stiffness @ place - np.append(pulls, of_shapes @ place[rigid:])

    return others


@kernel()
def tensions_along(lines, work, times, positions, out, bent=None):
    """Fill out (n, lines), tensions at the fairleads, N, at times (n,) s with the bodies at positions (n, N, 6)

    bent : amplitudes of shapes, (n, f), None without shapes
    """
    count = lines.place.shape[0]
    R, force = np.zeros((count, 3, 3)), np.zeros((count, 6))
    for i in range(times.size):
        hold(lines, work, times[i])
        if bent is not None:
            for k in range(work.bent.size):
                work.bent[k] = bent[i, k]
        line_loads(lines, work, positions[i], R, force)
        for j in range(lines.lost.size):
            out[i, j] = np.sqrt(work.tension[j, 0] ** 2 + work.tension[j, 1] ** 2)
