"""Pull of the lines of a system on a body in time, each in its exact static form for where the fairlead is.

A uniform line follows the closed forms, started from its last solution (`mooring.lines.catenary.moving_end`).  A line
of segments, with sinkers and buoys or a bed of its own, is read from a table of its own solver over the span and
height its fairlead visits: bicubic Hermite polynomials through forces and their exact derivatives.

With R = Rz(ψ) Ry(θ) Rx(φ) the forces on the rates of x, y, z, φ, θ, ψ are those of virtual work,

    Q_φ = M · Rz Ry e_x,    Q_θ = M · Rz e_y,    Q_ψ = M · e_z,    M = Σ R p × f.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from ..lines.catenary.moving_end import pull_of_any, workspace
from ..lines.system.parts import Anchor, Fairlead, UniformLine

NEVER = np.inf  # s at which a line breaks that does not


class Lines(NamedTuple):
    """Lines as the kernels read them.

    anchor : (n, 3) m in space, fairlead : (n, 3) m in the body's axes; lines : (n, 4) length, weight, 1/EA, friction
    lost : (n,) s; bed : (1,) m, its height; table : (n,) number of its table, below 0 for a closed form
    origin, spacing : (k, 2) m of span and height of a table; values : (k, p, q, 2, 4) of H and V: f, f_x, f_z, f_xz
    place : (3,) m, origin of the body's axes at rest
    """

    anchor: np.ndarray
    fairlead: np.ndarray
    lines: np.ndarray
    lost: np.ndarray
    bed: np.ndarray
    table: np.ndarray
    origin: np.ndarray
    spacing: np.ndarray
    values: np.ndarray
    place: np.ndarray


class LineWork(NamedTuple):
    """What is kept of the lines between evaluations.

    kept (n, 2) and rows (n, ROW) of `moving_end`; tension : (n, 2) horizontal and vertical pull at the fairlead, N
    whole : (n,) whether a line has not broken yet
    """

    kept: np.ndarray
    rows: np.ndarray
    tension: np.ndarray
    whole: np.ndarray


def line_work(lines):
    """`LineWork` of lines none of which has broken"""
    count = len(lines.lost)
    return LineWork(*workspace(count), np.zeros((count, 2)), np.ones(count, bool))


def body_lines(system, lost=()):
    """`Lines` of a System of one body, whose lines run between anchors and fairleads; of None, none.

    lost : (name, s) of lines that break.  raises : ValueError for other systems, and names that are unknown
    """
    if system is None:
        return _arrays([], [], [], [], -1.0, np.zeros(3))
    points = {point.name: point for point in system.points}
    if len(system.bodies) != 1:
        raise ValueError(f"the system has {len(system.bodies)} bodies; a body in time is one")
    unknown = {name for name, _ in lost} - set(system.line_names)
    if unknown:
        raise ValueError(f"line {min(unknown)!r} that breaks is unknown; allowed: {', '.join(system.line_names)}")
    anchors, fairleads, given = [], [], []
    for line in system.lines:
        ends = points[line.a], points[line.b]
        kinds = [isinstance(end, kind) for end, kind in zip(ends, (Anchor, Fairlead), strict=True)]
        if not all(kinds) and isinstance(ends[1], Anchor) and isinstance(ends[0], Fairlead):
            ends, kinds = ends[::-1], [True, True]
        if not all(kinds):
            raise ValueError(f"line {line.name} runs from {line.a} to {line.b}; allowed: from an anchor to the body")
        anchors.append(ends[0].position)
        fairleads.append(ends[1].position)
        if not isinstance(line, UniformLine):
            raise ValueError(f"line {line.name} has segments; allowed in time: uniform lines")
        given.append((line.length, line.type.weight, 1 / line.type.axial_stiffness, line.bed_friction))
    anchors = np.array(anchors, float).reshape(-1, 3)
    near = np.abs(anchors[:, 2] + system.depth) <= 1e-6 * system.depth
    anchors[near, 2] = -system.depth
    times = np.full(len(given), NEVER)
    for name, when in lost:
        times[system.line_names.index(name)] = when
    place = np.array(system.bodies[0].position[:3], float)
    return _arrays(anchors, fairleads, given, times, -float(system.depth), place)


def _arrays(anchors, fairleads, given, times, bed, place):
    """Lines in closed form, without tables"""
    return Lines(
        np.asarray(anchors, float).reshape(-1, 3),
        np.array(fairleads, float).reshape(-1, 3),
        np.array(given, float).reshape(-1, 4),
        np.array(times, float),
        np.array([bed]),
        np.full(len(given), -1),
        np.zeros((0, 2)),
        np.zeros((0, 2)),
        np.zeros((0, 2, 2, 2, 4)),
        place,
    )


@kernel()
def rotation_of(angles, R):
    """R (3, 3) = Rz(yaw) Ry(pitch) Rx(roll) of (roll, pitch, yaw)"""
    a, b, c = np.cos(angles[0]), np.cos(angles[1]), np.cos(angles[2])
    d, e, f = np.sin(angles[0]), np.sin(angles[1]), np.sin(angles[2])
    R[0, 0], R[0, 1], R[0, 2] = c * b, c * e * d - f * a, c * e * a + f * d
    R[1, 0], R[1, 1], R[1, 2] = f * b, f * e * d + c * a, f * e * a - c * d
    R[2, 0], R[2, 1], R[2, 2] = -e, b * d, b * a


@kernel()
def line_loads(lines, work, position, R, out):
    """out (6,) generalized forces, in heading axes, of the lines on a body at `position` (6,); work.tension is filled.

    returns : whether every line has a force
    """
    rotation_of(position[3:6], R)
    out[:] = 0.0
    fx = fy = fz = mx = my = mz = 0.0
    good = True
    for i in range(lines.lost.size):
        if not work.whole[i]:
            work.tension[i, 0] = work.tension[i, 1] = 0.0
            continue
        p, a = lines.fairlead[i], lines.anchor[i]
        ax = R[0, 0] * p[0] + R[0, 1] * p[1] + R[0, 2] * p[2]
        ay = R[1, 0] * p[0] + R[1, 1] * p[1] + R[1, 2] * p[2]
        az = R[2, 0] * p[0] + R[2, 1] * p[1] + R[2, 2] * p[2]
        x = lines.place[0] + position[0] + ax - a[0]
        y = lines.place[1] + position[1] + ay - a[1]
        z = lines.place[2] + position[2] + az
        span = np.sqrt(x * x + y * y)
        length, weight, flexibility, friction = lines.lines[i]
        H, V = pull_of_any(
            work.kept[i], work.rows[i], span, a[2], z, lines.bed[0], length, weight, flexibility, friction
        )
        if not np.isfinite(H):
            good = False
            continue
        work.tension[i, 0], work.tension[i, 1] = H, V
        if span > 0.0:
            x, y = -H * x / span, -H * y / span
        else:
            x = y = 0.0
        fx, fy, fz = fx + x, fy + y, fz - V
        mx += ay * -V - az * y
        my += az * x + ax * V
        mz += ax * y - ay * x
    cos, sin = np.cos(position[5]), np.sin(position[5])
    out[0], out[1], out[2] = cos * fx + sin * fy, -sin * fx + cos * fy, fz
    pitch_x, pitch_z = np.cos(position[4]), -np.sin(position[4])
    out[3] = pitch_x * (cos * mx + sin * my) + pitch_z * mz  # M · Rz Ry e_x
    out[4] = -sin * mx + cos * my  # M · Rz e_y
    out[5] = mz
    return good
