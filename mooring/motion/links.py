"""Hinges, balls, sliders and rigid links between moving bodies, exact, with Lagrange's multipliers, compiled.

    W⁻¹ ν̇ = F + Gᵀμ,    G ν̇ = −Ġν − 2α Gν − α² g,    (G W Gᵀ) μ = −Ġν − 2α Gν − α² g − G W F

g (r,) contains the quantities that links keep at zero. The first kind is d, the distance in space from a link's
point on the first body to its point on the second; for a slider it is h · R₁ᵀd along two axes h of the first body.
The second kind is a rotation: Q = R₁ᵀR₂R₀ᵀ is the rotation of the second body from rest in axes of the first, and
its parts h · ½(Q₃₂ − Q₂₃, …) about the constrained axes h are zero. G is the derivative of g by the motions at the
present angles, along the axes of the forces. μ, the force and moment on the second body, therefore does no work
while the constraint is satisfied. A spring and a damper of a slider or a hinge give −k (s − rest) − c ṡ along or
about its axis R₁h, with the travel s = R₁h · d or the angle of Q about h.  Ġν is a difference quotient along the
course.  Errors that steps leave in g decay at the rate α (Baumgarte 1972). On a flexible body, the point of a link
moves by R Σ ξ u and its axes turn by exp(Σ ξ w), for shapes with amplitudes ξ; the rates of ξ are then among ν.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.hinges import SHOWN, end_of, of_shapes
from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from .line_loads import generalized, give_generalized, rotation_of
from .tables.groups import groups_of

BACK = 2.0  # α, rad/s: a larger value would need steps shorter than those for waves
ALONG, ABOUT = 1, 2  # an axis, the travel of a slider and of a hinge
AHEAD = 1e-3  # s, of the difference quotient: its error is a millionth of a second-order term


@in_memory
class Links(NamedTuple):
    """Data of k links with r constraints in the form that the kernels read.

    ends : (k, 2), numbers of the first and the second body, below 0 for a fixed point
    points : (k, 2, 3) m in the axes of these bodies; in space for a fixed point
    back : R₀ᵀ, (k, 3, 3); along, held : (k, 3, 3), rows h of positions (three in space) and of rotations, in axes of
        the first body
    first : (k + 1,), number of each link's first constraint; turns : (k,), number of its first constraint on a
        rotation
    place : (N, 3) m, origins of the axes of the bodies at rest
    shown : (k, 3, 3), rows are the axes of reported forces, in axes of the first body
    way : axis of a slider or a hinge, in axes of the first body, (k, 3); drive : k, c and rest, (k, 3)
    travels : (k,), ALONG an axis, ABOUT an axis, or 0 for no travel
    shapes : (f,), number of each bending shape among the motions, which are 6N and groups of six
    bent, turned : (k, 2, f, 3), displacements, m, and rotations, rad, at the points per unit of each shape, along
        body axes
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
    shapes: np.ndarray = np.zeros(0, np.int64)
    bent: np.ndarray = np.zeros((0, 2, 0, 3))
    turned: np.ndarray = np.zeros((0, 2, 0, 3))


@in_memory
class LinkWork(NamedTuple):
    """Work arrays of one evaluation.

    rows : rows of G for the first and the second body, (r, 12); gap : g, (r,); axis : axes of forces and moments in
        space, (r, 3)
    left, mu : (r,); matrix : (r, r); shares : (n, r) for n motions; speed : ν, (n,); ahead : poses, (N, 6)
    turn : (2, 3, 3); arms : arms of both bodies to the second body's point, (2, 3) m; arm, push : (3,); Q : (3, 3);
        free : (n,)
    state, rate : (n,), of a sample; kept : (samples, SHOWN k), forces on the second body along `Links.shown`, N and
        N m, and travels
    pull, travel : of springs and dampers, (k,), N or N m, and m or rad; pulled : their rows, (k, 12); toward : their
        axes, (k, 3)
    amplitude : amplitudes of shapes, (f,), set by the caller; by_shapes, pulled_by : parts of rows (r, f) and of
        `pulled` (k, f) by shapes
    moved, spun : displacement, m, and rotation, rad, in space of both ends of a link per unit of each shape, (2, f, 3)
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
    amplitude: np.ndarray
    by_shapes: np.ndarray
    pulled_by: np.ndarray
    moved: np.ndarray
    spun: np.ndarray


def links_of(reader):
    """`Links` of a `bem.database.reader.Reader`, or None.  Raises ValueError for unknown bodies."""
    if not reader.links:
        return None
    ends, points, backs, helds, shown, ways, bends = [], [], [], ([], []), [], [], []
    for link in reader.links:
        bodies, moves = zip(*(end_of(reader, name) for name in link.bodies), strict=True)
        place, axes = bodies[0].in_scene(link.position), [np.eye(3) if one.fixed else one.axes for one in bodies]
        ends.append([-1 if own is None else own.start // 6 for own in moves])
        points.append([place if one.fixed else one.axes.T @ (place - one.rotation_center) for one in bodies])
        at, none = [one.axes.T @ (place - (*one.place, 0.0)) for one in bodies], np.zeros((2, 3, len(reader.modes)))
        at = [none if one.fixed else of_shapes(reader, one, own) for one, own in zip(bodies, at, strict=True)]
        bends.append(np.array(at).transpose(1, 0, 3, 2))
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
        reader.rigid + groups_of(reader).place,
        *np.ascontiguousarray(np.stack(bends, axis=1)),
    )  # fmt: skip


def link_work(links, states=0, samples=0, groups=0):
    """`LinkWork` of Links; states, samples, groups : number of values in a state, of samples, and of groups of
    bending shapes
    """
    r, n, k = int(links.first[-1]), len(links.place), len(links.ends)
    motions, f = max(6 * (n + groups), 1 + int(links.shapes.max(initial=-1))), len(links.shapes)
    return LinkWork(
        np.zeros((r, 12)), np.zeros(r), np.zeros((r, 3)), np.zeros(r), np.zeros(r), np.zeros((r, r)),
        np.zeros((motions, r)), np.zeros(motions), np.zeros((n, 6)), np.zeros((2, 3, 3)), np.zeros((2, 3)), np.zeros(3),
        np.zeros(3), np.zeros((3, 3)), np.zeros(motions), np.zeros(states), np.zeros(states),
        np.zeros((samples, SHOWN * k)), np.zeros(k), np.zeros(k), np.zeros((k, 12)), np.zeros((k, 3)), np.zeros(f),
        np.zeros((r, f)), np.zeros((k, f)), np.zeros((2, f, 3)), np.zeros((2, f, 3)),
    )  # fmt: skip


def rows_at(links, poses, bent=0.0):
    """G, shape (r, 6N + f), and g, shape (r,), of `links.Links` with the bodies at poses (N, 6) and amplitudes of f
    shapes"""
    work, poses = link_work(links), np.ascontiguousarray(poses, float)
    work.amplitude[:] = bent
    fill_rows(links, work, poses, False)
    G = np.zeros((len(work.gap), poses.size + len(links.shapes)))
    G[:, poses.size :] = work.by_shapes
    for k, ends in enumerate(links.ends):
        rows = slice(links.first[k], links.first[k + 1])
        for e, b in enumerate(ends):
            if b >= 0:
                G[rows, 6 * b : 6 * b + 6] = work.rows[rows, 6 * e : 6 * e + 6]
    return G, work.gap.copy()


def held_by(links, poses, mu):
    """Forces, N, and moments, N m, of the first body of each link on the second, in axes of the first, from μ (r,);
    shape (k, 6)
    """
    work, poses, out = link_work(links), np.ascontiguousarray(poses, float), np.zeros(SHOWN * len(links.ends))
    fill_rows(links, work, poses, True)
    drive(links, work, np.zeros(len(work.free)))
    work.mu[:] = mu
    put_forces(links, work, poses, out)
    return out.reshape(-1, SHOWN)[:, :6]


def springs_at(links, poses, bent=0.0):
    """Forces of the springs of links at rest, along body axes, then on shapes, N and N m; shape (6N + f,); arguments
    as in `rows_at`
    """
    work, poses = link_work(links), np.ascontiguousarray(poses, float)
    force = np.zeros(len(work.free))
    work.amplitude[:] = bent
    fill_rows(links, work, poses, True)
    drive(links, work, force)
    return np.append(force[: poses.size], force[links.shapes])


@kernel(counted=False)
def give_row(links, work, poses, k, m, turns, row):
    """Fill row (12,) for a unit force or moment along m (3,) in space on link k's second body, and its opposite on
    the first
    """
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
def bend_ends(links, work, k):
    """Move both ends of link k by shapes and rotate its axes: changes work.arms, arm and turn, and fills work.moved
    and spun

    The rotation exp(θ), θ = Σ ξ w, follows Rodrigues' formula; a change of ξ turns it by w + (1 − cos θ)/θ² θ × w + ….
    """
    R, E, u = work.turn, work.Q, work.push
    for e in range(2):
        u[:] = 0.0
        for s in range(links.shapes.size):
            for i in range(3):
                work.moved[e, s, i] = 0.0
                for j in range(3):
                    work.moved[e, s, i] += R[e, i, j] * links.bent[k, e, s, j]
                work.arms[e, i] += work.amplitude[s] * work.moved[e, s, i]
                work.arm[i] += (2.0 * e - 1.0) * work.amplitude[s] * work.moved[e, s, i]
                u[i] += work.amplitude[s] * links.turned[k, e, s, i]
        square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
        angle = np.sqrt(square)
        first = 1.0 - square / 6.0 if angle < 1e-4 else np.sin(angle) / angle
        second = 0.5 - square / 24.0 if angle < 1e-4 else (1.0 - np.cos(angle)) / square
        third = 1.0 / 6.0 if angle < 1e-4 else (1.0 - first) / square
        for s in range(links.shapes.size):
            w = links.turned
            a, b, c = w[k, e, s, 0], w[k, e, s, 1], w[k, e, s, 2]
            x, y, z = u[1] * c - u[2] * b, u[2] * a - u[0] * c, u[0] * b - u[1] * a
            a += second * x + third * (u[1] * z - u[2] * y)
            b += second * y + third * (u[2] * x - u[0] * z)
            c += second * z + third * (u[0] * y - u[1] * x)
            for i in range(3):
                work.spun[e, s, i] = R[e, i, 0] * a + R[e, i, 1] * b + R[e, i, 2] * c
        E[0, 0], E[0, 1], E[0, 2] = 0.0, -u[2], u[1]
        E[1, 0], E[1, 1], E[1, 2] = u[2], 0.0, -u[0]
        E[2, 0], E[2, 1], E[2, 2] = -u[1], u[0], 0.0
        for i in range(3):
            a, b, c = R[e, i, 0], R[e, i, 1], R[e, i, 2]
            for j in range(3):
                once = a * E[0, j] + b * E[1, j] + c * E[2, j]
                along = a * u[0] + b * u[1] + c * u[2]
                own = a if j == 0 else b if j == 1 else c
                R[e, i, j] = own + first * once + second * (along * u[j] - square * own)


@kernel(counted=False)
def shape_row(links, work, m, turns, row, i):
    """Fill row i of an array (…, f), the part by shapes of a unit force or moment as in `give_row`; needs
    `bend_ends` before

    turns : 0 for a force along an axis of space, ALONG one of the first body, ABOUT for a moment
    """
    d, spun = work.arm, work.spun
    for s in range(links.shapes.size):
        total = 0.0
        for j in range(3):
            if turns == ABOUT:
                total += m[j] * (spun[1, s, j] - spun[0, s, j])
            else:
                total += m[j] * (work.moved[1, s, j] - work.moved[0, s, j])
        if turns == ALONG:  # the axis turns with the first body: w · (m × d)
            total += spun[0, s, 0] * (m[1] * d[2] - m[2] * d[1])
            total += spun[0, s, 1] * (m[2] * d[0] - m[0] * d[2])
            total += spun[0, s, 2] * (m[0] * d[1] - m[1] * d[0])
        row[i, s] = total


@kernel(counted=False)
def fill_rows(links, work, poses, driven):
    """Write rows, gap and axis into work for bodies at poses (N, 6); if `driven`, also travel, pulled and toward"""
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
        bends = links.shapes.size > 0
        if bends:
            bend_ends(links, work, k)
        slides = links.turns[k] - links.first[k] < 3
        for i in range(3 if slides else 0):
            arms[0, i] += d[i]
        for i in range(links.first[k], links.turns[k]):
            h, m = links.along[k, i - links.first[k]], work.axis[i]
            for j in range(3):
                m[j] = R[0, j, 0] * h[0] + R[0, j, 1] * h[1] + R[0, j, 2] * h[2] if slides else h[j]
            work.gap[i] = m[0] * d[0] + m[1] * d[1] + m[2] * d[2]
            give_row(links, work, poses, k, m, False, work.rows[i])
            if bends:
                shape_row(links, work, m, ALONG if slides else 0, work.by_shapes, i)
        if driven and links.travels[k] > 0:
            h, m = links.way[k], work.toward[k]
            for j in range(3):
                m[j] = R[0, j, 0] * h[0] + R[0, j, 1] * h[1] + R[0, j, 2] * h[2]
            work.pulled[k] = 0.0
            give_row(links, work, poses, k, m, links.travels[k] == ABOUT, work.pulled[k])
            if bends:
                shape_row(links, work, m, links.travels[k], work.pulled_by, k)
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
            if bends:
                shape_row(links, work, m, ABOUT, work.by_shapes, i)


@kernel(counted=False)
def drive(links, work, force):
    """Fill work.pull, forces of springs and dampers at the filled travels and work.speed, and add them to the forces
    (6N,)
    """
    for k in range(links.ends.shape[0]):
        if links.travels[k] > 0:
            speed, row = 0.0, work.pulled[k]
            for e in range(2):
                b = links.ends[k, e]
                if b >= 0:
                    for j in range(6):
                        speed += row[6 * e + j] * work.speed[6 * b + j]
            for s in range(links.shapes.size):
                speed += work.pulled_by[k, s] * work.speed[links.shapes[s]]
            pull = -links.drive[k, 0] * (work.travel[k] - links.drive[k, 2]) - links.drive[k, 1] * speed
            work.pull[k] = pull
            for e in range(2):
                b = links.ends[k, e]
                if b >= 0:
                    for j in range(6):
                        force[6 * b + j] += pull * row[6 * e + j]
            for s in range(links.shapes.size):
                force[links.shapes[s]] += pull * work.pulled_by[k, s]


@kernel(inline=True, counted=False)
def along_rows(links, work, k, i, values):
    """Product of row i, which belongs to link k, and the values (n,) of all motions"""
    total = 0.0
    for e in range(2):
        b = links.ends[k, e]
        if b >= 0:
            for j in range(6):
                total += work.rows[i, 6 * e + j] * values[6 * b + j]
    for s in range(links.shapes.size):
        total += work.by_shapes[i, s] * values[links.shapes[s]]
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
    """Fill work.shares = W Gᵀ and work.matrix = G W Gᵀ from the rows of G and from W (6N, 6N)"""
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
                for s in range(links.shapes.size):
                    total += work.by_shapes[i, s] * work.shares[links.shapes[s], j]
                work.matrix[i, j] = total


@kernel(counted=False)
def hold_together(links, work, poses, inverse, force):
    """Add the link forces to the forces (6N,) on bodies at poses (N, 6) with work.speed; inverse : W (6N, 6N)."""
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
        for s in range(links.shapes.size):
            work.amplitude[s] += side * AHEAD * speed[links.shapes[s]]
        fill_rows(links, work, work.ahead, False)
        for s in range(links.shapes.size):
            work.amplitude[s] -= side * AHEAD * speed[links.shapes[s]]
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
            for s in range(links.shapes.size):
                force[links.shapes[s]] += work.by_shapes[i, s] * mu[i]


@kernel(counted=False)
def put_forces(links, work, poses, out):
    """Fill out (SHOWN k,) for bodies at poses (N, 6): forces on the second body along `Links.shown`, N and N m, and
    travels
    """
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
