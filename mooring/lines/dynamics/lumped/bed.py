"""The bed under the nodes of a line: reaction, friction, and the energy stored in the bed.

A plane, or hills and valleys along one course, z = f(d) with d = (r − r₀)·c: straight facets whose edges are rounded by
parabolas, so that the normal n = (−f′c, 1)/√(1 + f′²) turns without a jump.  The penetration of a node at r is

    p = level + h − n·r

with the plane (n, level) that touches the bed above or below it.  Pressure k p²/2h for p ≤ h, k (p − h/2) beyond; h
is chosen so that a node at rest has p = h and lies on the bed; damping c min(1, p/h) never pulls.  Friction μN acts
against the elastic displacement s of the node along the bed, −μN s/δ with |s| ≤ δ (elastic up to δ, then sliding).
"""

import math

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, choose_less, load_vector, repeated, root, store_vector

from .books import BED, FRICTION
from .vectors import TINY, combine, dot, largest, less, load_three, minus, more, store_three, total
from .workspace import BED_DAMPING, BED_STIFFNESS, BED_THIN, LEVEL, NORMAL, TURN


@kernel(inline=True, counted=False)
def plane_at(s, x, y):
    """Normal and level of the plane that touches the bed at (x, y), and the rate b at which n turns along the course.

    b = f″/(1 + f′²)^(3/2), with dn/dd = −b (c, f′).
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


@kernel(inline=True, counted=False)
def bearing(k, thickness, p):
    """Bed reaction without damping, its derivative and its energy at penetration p."""
    if p <= 0.0:
        return 0.0, 0.0, 0.0
    if p < thickness:
        return 0.5 * k * p * p / thickness, k * p / thickness, k * p * p * p / (6.0 * thickness)
    return k * (p - 0.5 * thickness), k, 0.5 * k * (p * p - p * thickness + thickness * thickness / 3.0)


@kernel(inline=True, counted=False)
def slipped(n, x, y, z, limit):
    """Component of a displacement (x, y, z) along the bed, shortened to at most `limit`, and the factor of this
    shortening, ≤ 1.
    """
    up = n[0] * x + n[1] * y + n[2] * z
    x, y, z = x - up * n[0], y - up * n[1], z - up * n[2]
    size = math.sqrt(x * x + y * y + z * z)
    f = limit / size if size > limit else 1.0
    return (f * x, f * y, f * z), f


@kernel(counted=False)
def find_planes(s, work):
    """The plane that touches an uneven bed under each node"""
    for j in range(s.mass.size):
        n, level, turn = plane_at(s, work.q[0, j], work.q[1, j])
        work.node[NORMAL, j], work.node[NORMAL + 1, j], work.node[NORMAL + 2, j] = n
        work.node[LEVEL, j], work.node[TURN, j] = level, turn


@kernel(inline=True, counted=False)
def add_outer(D, w, j, f, a, b):
    """Add f a bᵀ to eight blocks of D."""
    for i in range(3):
        row = 3 * i * w + j
        x, y, z = load_three(D, w, row)
        c = f * a[i]
        store_three(D, w, row, (x + c * b[0], y + c * b[1], z + c * b[2]))


@kernel(counted=False)
def bed_forces(s, work, slip, since, cq, cv):
    """Reaction and friction of the bed.

    slip : (3, w) m, elastic displacement of friction when the nodes were at `since` (3, w) m
    """
    uneven, w = s.bed_profile.shape[0] > 0, work.q.shape[1]
    if uneven:
        find_planes(s, work)
    q, v, node, r, D = address(work.q), address(work.v), address(work.node), address(work.r), address(work.D)
    held, began, lost, rubbed = address(slip), address(since), repeated(0.0), repeated(0.0)
    G, most = s.bed_friction / s.bed_slip, s.bed_slip
    for j in range(0, w - WIDTH, WIDTH):
        stiffness, thin = load_vector(node, BED_STIFFNESS * w + j), load_vector(node, BED_THIN * w + j)
        n, place = load_three(node, w, NORMAL * w + j), load_three(q, w, j)
        # penetration over that of a node at rest, and the part of stiffness and damping that acts
        deep = (load_vector(node, LEVEL * w + j) - dot(n, place)) * thin + 1.0
        share = less(more(deep, repeated(0.0)), repeated(1.0))
        if largest(share) == 0.0:
            continue
        speed, damping = load_three(v, w, j), load_vector(node, BED_DAMPING * w + j)
        rise, c = dot(n, speed), damping * share
        spring = stiffness / thin * share * (deep - 0.5 * share)
        N = more(spring - c * rise, repeated(0.0))
        lost = lost + (spring - N) * rise
        normal = cq * (stiffness * share - choose_less(deep, 1.0, damping * thin * rise, 0.0)) + cv * c
        normal = choose_less(0.0, N, normal, 0.0)
        out = load_three(r, w, j)
        out = combine(1.0, out, N, n)
        add_outer(D, w, j, normal, n, n)
        if G > 0.0:
            x = minus(place, load_three(began, w, j))
            x = combine(1.0, x, 1.0, load_three(held, w, j))
            x = combine(1.0, x, -dot(n, x), n)
            size = root(dot(x, x) + TINY)
            cut = less(most / size, repeated(1.0))
            x = combine(cut, x, 0.0, x)
            F = G * N
            out = combine(1.0, out, -F, x)
            rubbed = rubbed + F * dot(x, speed)
            # along the bed, and where it slides not along the displacement, friction resists like a spring
            hold = cq * F * cut
            sliding = choose_less(most, size, hold / (most * most), 0.0)
            add_outer(D, w, j, -hold, n, n)
            add_outer(D, w, j, -G * normal, x, n)
            add_outer(D, w, j, -sliding, x, x)
            for i in range(3):
                store_vector(D, 4 * i * w + j, load_vector(D, 4 * i * w + j) + hold)
        store_three(r, w, j, out)
        if uneven:
            turn = load_vector(node, TURN * w + j)
            cx, cy = s.bed_course[2], s.bed_course[3]
            turned = (repeated(-cx), repeated(-cy), (n[0] * cx + n[1] * cy) / n[2])
            add_outer(D, w, j, -cq * N * turn, turned, (repeated(cx), repeated(cy), repeated(0.0)))
    work.power[BED], work.power[FRICTION] = total(lost), total(rubbed)


@kernel(inline=True, counted=False)
def pressing(s, j, q, v):
    """Reaction of the bed on node j, N, including damping; 0 above the bed"""
    h = s.bed_thickness[j]
    n, level, _ = plane_at(s, q[0, j], q[1, j])
    p = level + h - (n[0] * q[0, j] + n[1] * q[1, j] + n[2] * q[2, j])
    if p <= 0.0:
        return 0.0
    rise = n[0] * v[0, j] + n[1] * v[1, j] + n[2] * v[2, j]
    return max(0.0, bearing(s.bed_stiffness[j], h, p)[0] - s.bed_damping[j] * min(1.0, p / h) * rise)


@kernel(counted=False)
def keep_slip(s, q, v, slip, since, before):
    """Friction displacement of all nodes after a step from `since` (3, w) m at `before` (3, w) m/s to q at v.

    The displacement is reset where a node has left the bed.  Returns the work against friction, J. It is the work along
    the path from end to end of the step, elastic to δ and sliding beyond, because the power at the stages misses
    reversals within a millimetre.
    """
    work = 0.0
    for j in range(s.mass.size):
        n, level, _ = plane_at(s, q[0, j], q[1, j])
        above = n[0] * q[0, j] + n[1] * q[1, j] + n[2] * q[2, j] - level - s.bed_thickness[j]
        if above < 0.0:
            held = slip[0, j] ** 2 + slip[1, j] ** 2 + slip[2, j] ** 2
            moved, cut = slipped(
                n,
                slip[0, j] + q[0, j] - since[0, j],
                slip[1, j] + q[1, j] - since[1, j],
                slip[2, j] + q[2, j] - since[2, j],
                s.bed_slip,
            )
            slip[0, j], slip[1, j], slip[2, j] = moved
            stretched = 0.5 * (moved[0] ** 2 + moved[1] ** 2 + moved[2] ** 2 - held)
            path = stretched + s.bed_slip**2 * (1.0 / cut - 1.0)
            if s.bed_friction > 0.0:
                mean = 0.5 * (pressing(s, j, since, before) + pressing(s, j, q, v))
                work += s.bed_friction / s.bed_slip * mean * path
        else:
            slip[0, j] = slip[1, j] = slip[2, j] = 0.0
    return work


@kernel(counted=False)
def bed_energy(s, j, q):
    """Energy stored in the bed under node j, J"""
    if s.bed_stiffness[j] == 0.0:
        return 0.0
    n, level, _ = plane_at(s, q[0, j], q[1, j])
    p = level + s.bed_thickness[j] - (n[0] * q[0, j] + n[1] * q[1, j] + n[2] * q[2, j])
    return bearing(s.bed_stiffness[j], s.bed_thickness[j], p)[2]
