"""Hinges, balls, sliders and rigid links between moving bodies, exact, with Lagrange's multipliers, compiled.

    W⁻¹ ν̇ = F + Gᵀμ,    G ν̇ = −Ġν − 2α Gν − α² g,    (G W Gᵀ) μ = −Ġν − 2α Gν − α² g − G W F

g (r,) are the quantities that a link keeps at zero: d, the distance of its point on the second body from that on the
first, in space, or for a slider h · R₁ᵀd along two axes h of the first; and for Q = R₁ᵀR₂R₀ᵀ, the rotation of the
second from its position at rest in axes of the first, the parts h · ½(Q₃₂ − Q₂₃, …) about the constrained axes h.  G is
the derivative of g by the motions, along the axes of the forces, at the present angles; so μ, force and moment on the
second body, does no work while the constraint is satisfied.  A spring and a damper of a slider or a hinge give −k (s −
rest) − c ṡ along or about its axis R₁h, with the travel s = R₁h · d or the angle of Q about h.  Ġν is a difference
quotient along the course.  Remainders of g from errors of steps decay at the rate α (Baumgarte 1972).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.hinges import SHOWN, end_of
from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from .line_loads import generalized, give_generalized, rotation_of

BACK = 2.0  # α, rad/s: a larger value would need steps shorter than those for waves
ALONG, ABOUT = 1, 2  # an axis, the travel of a slider and of a hinge
AHEAD = 1e-3  # s, of the difference quotient: its error is a millionth of a second-order term


@in_memory
class Links(NamedTuple):
    """k links of r constraints in the form that the kernels read.

    ends : (k, 2) numbers of the first and the second body, below 0 for a fixed point
    points : (k, 2, 3) m from the origins of the axes of these, along them; in space for a fixed point
    back : (k, 3, 3) R₀ᵀ; along, held : (k, 3, 3) rows h, of positions (three in space) and of rotations, in axes of the
        first
    first : (k + 1,) number of the first constraint of each; turns : (k,) that of its first on a rotation
    place : (N, 3) m, origins of the axes of the bodies at rest
    shown : (k, 3, 3) rows, axes of the reported forces, in axes of the first
    way : (k, 3) of the axis of a slider or a hinge, in axes of the first; drive : (k, 3) k, c and rest
    travels : (k,) ALONG an axis, ABOUT one, or none, 0
    """

    ends: np.ndarray
    points: np.ndarray
    back: np.ndarray
    along: np.ndarray
    held: np.ndarray
    first: np.ndarray
    turns: np.ndarray
    place: np.ndarray
    shown: np.ndarray
    way: np.ndarray
    drive: np.ndarray
    travels: np.ndarray


@in_memory
class LinkWork(NamedTuple):
    """Room for work of one evaluation.

    rows : (r, 12) of G, of the first and the second body; gap : (r,) g; axis : (r, 3) of forces and moments, in space
    left, mu : (r,); matrix, shares : (r, r), (6N, r); speed : (6N,) ν; ahead : (N, 6) poses
    turn : (2, 3, 3); arms : (2, 3) m to the point of the second; arm, push : (3,); Q : (3, 3); free : (6N,)
    state, rate : (n,) of a sample; kept : (samples, SHOWN k) N, N m, on the second body along `Links.shown`, travels
    pull, travel : (k,) of springs and dampers, N or N m, m or rad; pulled : (k, 12), toward : (k, 3) their rows, axes
    """

    rows: np.ndarray
    gap: np.ndarray
    axis: np.ndarray
    left: np.ndarray
    mu: np.ndarray
    matrix: np.ndarray
    shares: np.ndarray
    speed: np.ndarray
    ahead: np.ndarray
    turn: np.ndarray
    arms: np.ndarray
    arm: np.ndarray
    push: np.ndarray
    Q: np.ndarray
    free: np.ndarray
    state: np.ndarray
    rate: np.ndarray
    kept: np.ndarray
    pull: np.ndarray
    travel: np.ndarray
    pulled: np.ndarray
    toward: np.ndarray


def links_of(reader):
    """`Links` of a `bem.database.reader.Reader`, or None.  Raises ValueError for unknown bodies."""
    if not reader.links:
        return None
    ends, points, backs, helds, shown, ways = [], [], [], ([], []), [], []
    for link in reader.links:
        bodies, moves = zip(*(end_of(reader, name) for name in link.bodies), strict=True)
        place, axes = bodies[0].in_scene(link.position), [np.eye(3) if one.fixed else one.axes for one in bodies]
        ends.append([-1 if own is None else own.start // 6 for own in moves])
        points.append([place if one.fixed else one.axes.T @ (place - one.rotation_center) for one in bodies])
        own = axes[0].T @ bodies[0].axes  # axes of the first body in those used for its rotations here
        along = link.along @ own.T if len(link.along) < 3 else np.eye(3)
        for part, held in zip(helds, (along, link.held @ own.T), strict=True):
            part.append(np.zeros((3, 3)))
            part[-1][: len(held)] = held
        backs.append((axes[0].T @ axes[1]).T)
        shown.append(own.T)
        ways.append(own @ np.asarray(link.axis, float) / np.linalg.norm(link.axis))
    first = np.cumsum([0, *(len(link.along) + len(link.held) for link in reader.links)])
    turns = first[:-1] + [len(link.along) for link in reader.links]
    return Links(
        np.array(ends), np.array(points), np.array(backs), *map(np.array, helds), first, turns,
        np.ascontiguousarray(reader.axes_at_rest[:, :3]), np.array(shown), np.array(ways),
        np.array([(link.stiffness, link.damping, link.rest) for link in reader.links], float),
        np.array([{"slider": ALONG, "hinge": ABOUT}.get(link.kind, 0) for link in reader.links]),
    )  # fmt: skip


def link_work(links, states=0, samples=0, groups=0):
    """`LinkWork` of Links, for so many numbers of a state, samples, and groups of shapes of bodies that bend"""
    r, n, k = int(links.first[-1]), len(links.place), len(links.ends)
    motions = 6 * (n + groups)
    return LinkWork(
        np.zeros((r, 12)), np.zeros(r), np.zeros((r, 3)), np.zeros(r), np.zeros(r), np.zeros((r, r)),
        np.zeros((motions, r)), np.zeros(6 * n), np.zeros((n, 6)), np.zeros((2, 3, 3)), np.zeros((2, 3)), np.zeros(3),
        np.zeros(3), np.zeros((3, 3)), np.zeros(motions), np.zeros(states), np.zeros(states),
        np.zeros((samples, SHOWN * k)), np.zeros(k), np.zeros(k), np.zeros((k, 12)), np.zeros((k, 3)),
    )  # fmt: skip


def rows_at(links, poses):
    """(r, 6N) of G and (r,) of g, of `links.Links` with the bodies at poses (N, 6)"""
    work, poses = link_work(links), np.ascontiguousarray(poses, float)
    fill_rows(links, work, poses, False)
    G = np.zeros((len(work.gap), poses.size))
    for k, ends in enumerate(links.ends):
        rows = slice(links.first[k], links.first[k + 1])
        for e, b in enumerate(ends):
            if b >= 0:
                G[rows, 6 * b : 6 * b + 6] = work.rows[rows, 6 * e : 6 * e + 6]
    return G, work.gap.copy()


def held_by(links, poses, mu):
    """(k, 6) N, N m exerted by the first body of each link on the second, along the axes of the first, from μ (r,)"""
    work, poses, out = link_work(links), np.ascontiguousarray(poses, float), np.zeros(SHOWN * len(links.ends))
    fill_rows(links, work, poses, True)
    drive(links, work, np.zeros(poses.size))
    work.mu[:] = mu
    put_forces(links, work, poses, out)
    return out.reshape(-1, SHOWN)[:, :6]


def springs_at(links, poses):
    """(6N,) N, N m along the axes of the bodies, of the springs of links with the bodies at rest at poses (N, 6)"""
    work, poses, force = link_work(links), np.ascontiguousarray(poses, float), np.zeros(np.size(poses))
    fill_rows(links, work, poses, True)
    drive(links, work, force)
    return force


@kernel(counted=False)
def give_row(links, work, poses, k, m, turns, row):
    """row (12,) of a unit force or moment along m (3,) in space on the second body of link k, and less on the first"""
    f = work.push
    for e in range(2):
        b, sign = links.ends[k, e], 2.0 * e - 1.0
        for j in range(3):
            f[j] = sign * m[j]
        if b >= 0 and turns:
            generalized(poses[b], 0.0, 0.0, 0.0, f[0], f[1], f[2], row[6 * e : 6 * e + 6])
        elif b >= 0:
            give_generalized(poses[b], work.arms[e], f, row[6 * e : 6 * e + 6])


@kernel(counted=False)
def fill_rows(links, work, poses, driven):
    """work.rows, gap and axis with the bodies at poses (N, 6); if `driven` also its travel, pulled and toward"""
    R, arms, Q, d, p = work.turn, work.arms, work.Q, work.arm, links.points
    work.rows[:] = 0.0
    for k in range(links.ends.shape[0]):
        d[:] = 0.0
        for e in range(2):
            b, sign = links.ends[k, e], 2.0 * e - 1.0
            for i in range(3):
                for j in range(3):
                    R[e, i, j] = 1.0 if i == j else 0.0
            if b >= 0:
                rotation_of(poses[b, 3:6], R[e])
            for i in range(3):
                arms[e, i] = R[e, i, 0] * p[k, e, 0] + R[e, i, 1] * p[k, e, 1] + R[e, i, 2] * p[k, e, 2]
                d[i] += sign * (arms[e, i] + (links.place[b, i] + poses[b, i] if b >= 0 else 0.0))
        slides = links.turns[k] - links.first[k] < 3
        for i in range(3 if slides else 0):
            arms[0, i] += d[i]
        for i in range(links.first[k], links.turns[k]):
            h, m = links.along[k, i - links.first[k]], work.axis[i]
            for j in range(3):
                m[j] = R[0, j, 0] * h[0] + R[0, j, 1] * h[1] + R[0, j, 2] * h[2] if slides else h[j]
            work.gap[i] = m[0] * d[0] + m[1] * d[1] + m[2] * d[2]
            give_row(links, work, poses, k, m, False, work.rows[i])
        if driven and links.travels[k] > 0:
            h, m = links.way[k], work.toward[k]
            for j in range(3):
                m[j] = R[0, j, 0] * h[0] + R[0, j, 1] * h[1] + R[0, j, 2] * h[2]
            work.pulled[k] = 0.0
            give_row(links, work, poses, k, m, links.travels[k] == ABOUT, work.pulled[k])
            work.travel[k] = m[0] * d[0] + m[1] * d[1] + m[2] * d[2]
        for i in range(3):  # Q = (R₁ᵀ R₂) R₀ᵀ; R₁ᵀR₂ row by row
            for j in range(3):
                d[j] = R[0, 0, i] * R[1, 0, j] + R[0, 1, i] * R[1, 1, j] + R[0, 2, i] * R[1, 2, j]
            for j in range(3):
                Q[i, j] = d[0] * links.back[k, 0, j] + d[1] * links.back[k, 1, j] + d[2] * links.back[k, 2, j]
        trace = Q[0, 0] + Q[1, 1] + Q[2, 2]
        if driven and links.travels[k] == ABOUT:
            h = links.way[k]
            sine = h[0] * (Q[2, 1] - Q[1, 2]) + h[1] * (Q[0, 2] - Q[2, 0]) + h[2] * (Q[1, 0] - Q[0, 1])
            work.travel[k] = np.arctan2(sine, trace - 1.0)
        for i in range(links.turns[k], links.first[k + 1]):
            h, m = links.held[k, i - links.turns[k]], work.axis[i]
            work.gap[i] = 0.5 * (h[0] * (Q[2, 1] - Q[1, 2]) + h[1] * (Q[0, 2] - Q[2, 0]) + h[2] * (Q[1, 0] - Q[0, 1]))
            for j in range(3):
                d[j] = 0.5 * (trace * h[j] - h[0] * Q[0, j] - h[1] * Q[1, j] - h[2] * Q[2, j])
            for j in range(3):
                m[j] = R[0, j, 0] * d[0] + R[0, j, 1] * d[1] + R[0, j, 2] * d[2]
            give_row(links, work, poses, k, m, True, work.rows[i])


@kernel(counted=False)
def drive(links, work, force):
    """work.pull of springs and dampers at the travels and rows filled in, with work.speed, and into the forces (6N,)"""
    for k in range(links.ends.shape[0]):
        if links.travels[k] > 0:
            speed, row = 0.0, work.pulled[k]
            for e in range(2):
                b = links.ends[k, e]
                if b >= 0:
                    for j in range(6):
                        speed += row[6 * e + j] * work.speed[6 * b + j]
            pull = -links.drive[k, 0] * (work.travel[k] - links.drive[k, 2]) - links.drive[k, 1] * speed
            work.pull[k] = pull
            for e in range(2):
                b = links.ends[k, e]
                if b >= 0:
                    for j in range(6):
                        force[6 * b + j] += pull * row[6 * e + j]


@kernel(inline=True, counted=False)
def along_rows(links, work, k, i, values):
    """Row i, of link k, times values (6N,)"""
    total = 0.0
    for e in range(2):
        b = links.ends[k, e]
        if b >= 0:
            for j in range(6):
                total += work.rows[i, 6 * e + j] * values[6 * b + j]
    return total


@kernel(counted=False)
def solve_positive(A, x):
    """x = A⁻¹ x of a symmetric positive definite A (r, r), which is overwritten with its lower factor"""
    n = x.size
    for i in range(n):
        for j in range(i + 1):
            total = A[i, j]
            for k in range(j):
                total -= A[i, k] * A[j, k]
            A[i, j] = np.sqrt(total) if i == j else total / A[j, j]
        total = x[i]
        for k in range(i):
            total -= A[i, k] * x[k]
        x[i] = total / A[i, i]
    for i in range(n - 1, -1, -1):
        total = x[i]
        for k in range(i + 1, n):
            total -= A[k, i] * x[k]
        x[i] = total / A[i, i]


@kernel(counted=False)
def fill_shares(links, work, inverse):
    """work.shares W Gᵀ and work.matrix G W Gᵀ of the rows, with W (6N, 6N)"""
    for k in range(links.ends.shape[0]):
        for i in range(links.first[k], links.first[k + 1]):
            for j in range(inverse.shape[0]):
                work.free[j] = along_rows(links, work, k, i, inverse[j])
                work.shares[j, i] = work.free[j]
    for k in range(links.ends.shape[0]):
        for i in range(links.first[k], links.first[k + 1]):
            for j in range(work.mu.size):
                total = 0.0
                for e in range(2):
                    b = links.ends[k, e]
                    if b >= 0:
                        for m in range(6):
                            total += work.rows[i, 6 * e + m] * work.shares[6 * b + m, j]
                work.matrix[i, j] = total


@kernel(counted=False)
def hold_together(links, work, poses, inverse, force):
    """Add the link forces to the forces (6N,) on bodies at poses (N, 6) with work.speed; W (6N, 6N) of `inverse`."""
    count, speed, mu = poses.shape[0], work.speed, work.mu
    for side in (1.0, -1.0):
        for b in range(count):
            cos, sin = np.cos(poses[b, 5]), np.sin(poses[b, 5])
            u, v, h = speed[6 * b], speed[6 * b + 1], side * AHEAD
            work.ahead[b, 0], work.ahead[b, 1] = (
                poses[b, 0] + h * (cos * u - sin * v),
                poses[b, 1] + h * (sin * u + cos * v),
            )
            for j in range(2, 6):
                work.ahead[b, j] = poses[b, j] + h * speed[6 * b + j]
        fill_rows(links, work, work.ahead, False)
        for k in range(links.ends.shape[0]):
            for i in range(links.first[k], links.first[k + 1]):
                before = 0.0 if side > 0.0 else work.left[i]
                work.left[i] = before - side * along_rows(links, work, k, i, speed) / (2.0 * AHEAD)
    fill_rows(links, work, poses, True)
    drive(links, work, force)
    fill_shares(links, work, inverse)
    for j in range(force.size):
        total = 0.0
        for i in range(force.size):
            total += inverse[j, i] * force[i]
        work.free[j] = total
    for k in range(links.ends.shape[0]):
        for i in range(links.first[k], links.first[k + 1]):
            away = along_rows(links, work, k, i, work.free) + 2.0 * BACK * along_rows(links, work, k, i, speed)
            mu[i] = work.left[i] - away - BACK * BACK * work.gap[i]
    solve_positive(work.matrix, mu)
    give_rows(links, work, mu, force)


@kernel(counted=False)
def give_rows(links, work, mu, force):
    """Add Gᵀμ to forces (6N,)."""
    for k in range(links.ends.shape[0]):
        for i in range(links.first[k], links.first[k + 1]):
            for e in range(2):
                b = links.ends[k, e]
                if b >= 0:
                    for j in range(6):
                        force[6 * b + j] += work.rows[i, 6 * e + j] * mu[i]


@kernel(counted=False)
def put_forces(links, work, poses, out):
    """out (SHOWN k,) of bodies at poses (N, 6): N, N m of work.mu and pull on the second along `Links.shown`; travel"""
    for k in range(links.ends.shape[0]):
        R = work.turn[0]
        for i in range(3):
            for j in range(3):
                R[i, j] = 1.0 if i == j else 0.0
        if links.ends[k, 0] >= 0:
            rotation_of(poses[links.ends[k, 0], 3:6], R)
        for part in range(2):
            work.arm[:] = 0.0
            for i in range(links.first[k], links.first[k + 1]):
                if (i >= links.turns[k]) == (part == 1):
                    for j in range(3):
                        work.arm[j] += work.mu[i] * work.axis[i, j]
            if links.travels[k] == part + 1:
                for j in range(3):
                    work.arm[j] += work.pull[k] * work.toward[k, j]
            for i in range(3):
                total = 0.0
                for j in range(3):
                    along = (
                        R[j, 0] * links.shown[k, i, 0] + R[j, 1] * links.shown[k, i, 1] + R[j, 2] * links.shown[k, i, 2]
                    )
                    total += along * work.arm[j]
                out[SHOWN * k + 3 * part + i] = total
        out[SHOWN * k + 6] = work.travel[k]
