"""The bed under the nodes of a line: reaction, friction, and the energy in both.

A plane, or hills and valleys along one course, z = f(d) with d = (r − r₀)·c: straight facets whose edges are rounded by
parabolas, so that the normal n = (−f′c, 1)/√(1 + f′²) turns without a jump.  On either a node at r has the penetration

    p = level + h − n·r

with the plane (n, level) that touches the bed above or below it.  Pressure k p²/2h for p ≤ h, k (p − h/2) beyond, with
h such that a node at rest has p = h and lies on the bed; damping c min(1, p/h) never pulls.  Friction μN acts against
the elastic displacement s of the node along the bed, −μN s/δ with |s| ≤ δ (elastic up to δ, then sliding).
"""

from __future__ import annotations

import math

from bem.kernels.jit import kernel

from .books import BED, FRICTION


@kernel(inline=True)
def plane_at(s, x, y):
    """Normal and level of the plane that touches the bed at (x, y), and how n turns along the course.

    The last is b = f″/(1 + f′²)^(3/2), with dn/dd = −b (c, f′).
    """
    rows = s.bed_profile.shape[0]
    if rows == 0:
        return (s.bed_normal[0], s.bed_normal[1], s.bed_normal[2]), s.bed_level, 0.0
    c = s.bed_course
    d, row = (x - c[0]) * c[2] + (y - c[1]) * c[3], 0
    while row + 1 < rows and d >= s.bed_profile[row + 1, 0]:
        row += 1
    more, slope, bend = d - s.bed_profile[row, 0], s.bed_profile[row, 2], s.bed_profile[row, 3]
    f, rise = s.bed_profile[row, 1] + more * (slope + 0.5 * bend * more), slope + bend * more
    up = 1.0 / math.sqrt(1.0 + rise * rise)
    n = (-rise * c[2] * up, -rise * c[3] * up, up)
    return n, n[0] * x + n[1] * y + up * f, bend * up * up * up


@kernel(inline=True)
def bearing(k, thickness, p):
    """Bed reaction without damping, its derivative and its energy at penetration p."""
    if p <= 0.0:
        return 0.0, 0.0, 0.0
    if p < thickness:
        return 0.5 * k * p * p / thickness, k * p / thickness, k * p * p * p / (6.0 * thickness)
    return k * (p - 0.5 * thickness), k, 0.5 * k * (p * p - p * thickness + thickness * thickness / 3.0)


@kernel(inline=True)
def slipped(n, x, y, z, limit):
    """Part of a displacement (x, y, z) along the bed, at most `limit` long, and the factor that cut it, ≤ 1."""
    up = n[0] * x + n[1] * y + n[2] * z
    x, y, z = x - up * n[0], y - up * n[1], z - up * n[2]
    size = math.sqrt(x * x + y * y + z * z)
    f = limit / size if size > limit else 1.0
    return (f * x, f * y, f * z), f


@kernel()
def bed_forces(s, q, v, slip, since, cq, cv, r, D, power):
    """Reaction and friction of the bed; slip: elastic displacement of friction when the nodes were at `since`."""
    for j in range(q.shape[0]):
        h = s.bed_thickness[j]
        n, level, turn = plane_at(s, q[j, 0], q[j, 1])
        p = level + h - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
        if p <= 0.0:
            continue
        spring, k, _ = bearing(s.bed_stiffness[j], h, p)
        rise = n[0] * v[j, 0] + n[1] * v[j, 1] + n[2] * v[j, 2]
        c = s.bed_damping[j] * min(1.0, p / h)
        N = max(0.0, spring - c * rise)
        power[BED] += (spring - N) * rise
        if N == 0.0:
            continue
        normal = cq * (k - (s.bed_damping[j] / h * rise if p < h else 0.0)) + cv * c
        x, cut = slipped(
            n,
            slip[j, 0] + q[j, 0] - since[j, 0],
            slip[j, 1] + q[j, 1] - since[j, 1],
            slip[j, 2] + q[j, 2] - since[j, 2],
            s.bed_slip,
        )
        G = s.bed_friction / s.bed_slip
        F = G * N
        # along the bed, and where it slides not along the displacement, friction resists like a spring
        hold, sliding = cq * F * cut, cq * F * cut / s.bed_slip**2 if cut < 1.0 else 0.0
        for i in range(3):
            r[j, i] += N * n[i] - F * x[i]
            power[FRICTION] += F * x[i] * v[j, i]
            D[j, i, i] += hold
            for m in range(3):
                D[j, i, m] += ((normal - hold) * n[i] - G * normal * x[i]) * n[m] - sliding * x[i] * x[m]
        if turn != 0.0:
            cx, cy = s.bed_course[2], s.bed_course[3]
            turned = (-cx, -cy, (n[0] * cx + n[1] * cy) / n[2])
            for i in range(3):
                D[j, i, 0] -= cq * N * turn * turned[i] * cx
                D[j, i, 1] -= cq * N * turn * turned[i] * cy


@kernel(inline=True)
def pressing(s, j, q, v):
    """N, reaction of the bed on node j, its damping included; 0 above the bed"""
    h = s.bed_thickness[j]
    n, level, _ = plane_at(s, q[j, 0], q[j, 1])
    p = level + h - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
    if p <= 0.0:
        return 0.0
    rise = n[0] * v[j, 0] + n[1] * v[j, 1] + n[2] * v[j, 2]
    return max(0.0, bearing(s.bed_stiffness[j], h, p)[0] - s.bed_damping[j] * min(1.0, p / h) * rise)


@kernel()
def keep_slip(s, q, v, slip, since, before):
    """Friction displacement of all nodes after a step from `since` (n, 3) m at `before` (n, 3) m/s to q at v.

    It is lost where a node has left the bed.  Returns the work against friction, J: that of the path from end to end
    of the step, elastic to δ and sliding beyond, because the power at the stages misses what turns within a millimetre.
    """
    work = 0.0
    for j in range(q.shape[0]):
        n, level, _ = plane_at(s, q[j, 0], q[j, 1])
        above = n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2] - level - s.bed_thickness[j]
        if above < 0.0:
            held = slip[j, 0] ** 2 + slip[j, 1] ** 2 + slip[j, 2] ** 2
            moved, cut = slipped(
                n,
                slip[j, 0] + q[j, 0] - since[j, 0],
                slip[j, 1] + q[j, 1] - since[j, 1],
                slip[j, 2] + q[j, 2] - since[j, 2],
                s.bed_slip,
            )
            slip[j, 0], slip[j, 1], slip[j, 2] = moved
            stretched = 0.5 * (moved[0] ** 2 + moved[1] ** 2 + moved[2] ** 2 - held)
            path = stretched + s.bed_slip**2 * (1.0 / cut - 1.0)
            if s.bed_friction > 0.0:
                mean = 0.5 * (pressing(s, j, since, before) + pressing(s, j, q, v))
                work += s.bed_friction / s.bed_slip * mean * path
        else:
            slip[j] = 0.0
    return work


@kernel()
def bed_energy(s, j, q):
    """J, stored in the bed under node j"""
    if s.bed_stiffness[j] == 0.0:
        return 0.0
    n, level, _ = plane_at(s, q[j, 0], q[j, 1])
    p = level + s.bed_thickness[j] - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
    return bearing(s.bed_stiffness[j], s.bed_thickness[j], p)[2]
