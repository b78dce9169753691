"""Forces on the nodes of a line, their tangent, and the power of each loss.

    m a = T₊ t₊ − T₋ t₋ − w + drag + water inertia + bed,      tangent  S = M + c_v C + c_q K

Tension T = max(0, EA f(ε) + BA g ε̇) with ε = ℓ/ℓ₀ − 1 and f(ε) = ε, or linear between the points of a table. A
slack element (ε ≤ 0) carries nothing, and damping fades in with g = min(1, ε/ε_s) so that the tension is continuous.
Drag and inertia follow Morison on each half element, with its own tangent t (SR179 report, 1982, section 2.2, in
three dimensions):

    normal      ½ρ C_dn D |u_n| u_n,     ρA [(1 + C_an) u̇_n − C_an a_n]
    tangential  ½ρ C_dt πD |u_t| u_t,    ρA C_at (u̇_t − a_t)

Bed: `bed`; parts out of the water: `surface`; bending: `bending`.  Eight elements, then eight nodes, are taken at once
(`vectors`, `workspace`).

The tangent is exact for tension, bed, friction, and the dependence of drag on velocity. It neglects the rotation of
drag and added mass with the line, an effect smaller by the factor h²|F|/mℓ.
"""

import math

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, choose_less, load_vector, repeated, root, store_vector

from .bed import bed_energy, bed_forces
from .bending import bend, bending_energy
from .books import DRAG, INERTIA, STRUCTURE, WORK
from .surface import energy_dry, weigh_dry, wet
from .vectors import TINY, combine, dot, less, load_three, minus, more, store_three, total
from .workspace import (
    ADDED_NORMAL,
    ADDED_TANGENTIAL,
    BEGIN,
    DAMPING,
    DISPLACED,
    DRAG_NORMAL,
    DRAG_TANGENTIAL,
    HARD,
    MASS,
    OVER,
    SHORT,
    SLOPE,
    STIFFNESS,
    WEIGHT,
)


@kernel(inline=True, counted=False)
def elongation_row(s, e, strain):
    """Row of s.elongation that holds at a strain of element e."""
    row = s.elongation_rows[e, 0]
    while row + 1 < s.elongation_rows[e, 1] and strain >= s.elongation[row + 1, 0]:
        row += 1
    return row


@kernel(counted=False)
def find_rows(s, work):
    """For each element, the row of its type's tension table that applies at the present positions of its nodes"""
    q, known = work.q, work.element
    for e in range(s.length.size):
        x, y, z = q[0, e + 1] - q[0, e], q[1, e + 1] - q[1, e], q[2, e + 1] - q[2, e]
        row = elongation_row(s, e, math.sqrt(x * x + y * y + z * z) / s.length[e] - 1.0)
        known[BEGIN, e + 1], known[OVER, e + 1] = s.elongation[row, 0], s.elongation[row, 1]
        known[SLOPE, e + 1] = s.elongation[row, 2]


@kernel(inline=True, counted=False)
def tension(known, w, slot, strain, rate):
    """Tension of eight elements, its elastic part, ∂T/∂ε and ∂T/∂ε̇."""
    EA, hard = load_vector(known, STIFFNESS * w + slot), load_vector(known, HARD * w + slot)
    k = EA * load_vector(known, SLOPE * w + slot)
    elastic = EA * load_vector(known, OVER * w + slot) + k * (strain - load_vector(known, BEGIN * w + slot))
    damping = load_vector(known, DAMPING * w + slot)
    fade = strain * hard
    b = damping * less(fade, repeated(1.0))
    T = choose_less(0.0, strain, more(elastic + b * rate, repeated(0.0)), 0.0)
    k = k + choose_less(fade, 1.0, damping * rate * hard, 0.0)
    return T, choose_less(0.0, strain, elastic, 0.0), choose_less(0.0, T, k, 0.0), choose_less(0.0, T, b, 0.0)


@kernel(counted=False)
def immersion(z, radius):
    """Immersed share of the volume of a sphere with its centre at z, the derivative, and −∫ share dz from deep water
    to z.
    """
    if z <= -radius:
        return 1.0, 0.0, -z
    if z >= radius:
        return 0.0, 0.0, 0.0
    x = z / radius
    share = 0.25 * (1 - x) * (1 - x) * (2 + x)
    return share, -0.75 * (1 - x * x) / radius, radius * (0.1875 - 0.25 * x * (2 - x * (1.5 - 0.25 * x * x)))


@kernel(counted=False)
def pull_elements(work, elements, cq, cv):
    """Tensions, unit vectors towards the fairlead and tangent blocks of all elements; returns the power lost."""
    w, q, v, known = work.q.shape[1], address(work.q), address(work.v), address(work.element)
    T, tangent, B, lost = address(work.T), address(work.tangent), address(work.B), repeated(0.0)
    for e in range(0, elements, WIDTH):
        slot = e + 1
        d = minus(load_three(q, w, slot), load_three(q, w, e))
        squared, short = dot(d, d) + TINY, load_vector(known, SHORT * w + slot)
        inverse = 1.0 / root(squared)
        x, y, z = d[0] * inverse, d[1] * inverse, d[2] * inverse
        wx, wy, wz = minus(load_three(v, w, slot), load_three(v, w, e))
        stretching = x * wx + y * wy + z * wz
        pull, elastic, k, b = tension(known, w, slot, squared * inverse * short - 1.0, stretching * short)
        lost = lost + (pull - elastic) * stretching
        across, turning = cq * pull * inverse, cq * b * inverse * short
        axial = (cq * k + cv * b) * short - across - turning * stretching
        ax, ay, az = axial * x + turning * wx, axial * y + turning * wy, axial * z + turning * wz
        # tension along the element, and its rotation with it
        store_three(B, w, slot, (x * ax + across, x * ay, x * az))
        store_three(B, w, 3 * w + slot, (y * ax, y * ay + across, y * az))
        store_three(B, w, 6 * w + slot, (z * ax, z * ay, z * az + across))
        store_three(tangent, w, slot, (x, y, z))
        store_vector(T, slot, pull)
    return total(lost)


@kernel(inline=True, counted=False)
def half_water(known, w, slot, t, x, a, du, cv):
    """Drag and inertia (3) of the halves of eight elements at their nodes, and the tangent's components xx, yy, zz,
    xy, xz, yz.

    t : (3) unit vectors along the elements; x, du : velocity of the water past the nodes, acceleration of the water; a
    : acceleration of the nodes
    """
    along = dot(x, t)
    x = combine(1.0, x, -along, t)
    speed, normal = root(dot(x, x) + TINY), load_vector(known, DRAG_NORMAL * w + slot)
    dn, dt = normal * speed, load_vector(known, DRAG_TANGENTIAL * w + slot) * more(along, -along)
    an, at = load_vector(known, ADDED_NORMAL * w + slot), load_vector(known, ADDED_TANGENTIAL * w + slot)
    moved = an + load_vector(known, DISPLACED * w + slot)
    # difference between the tangential and the normal part of the accelerations of line and water
    c = (an - at) * dot(a, t) - (moved - at) * dot(du, t)
    drag = combine(dn, x, dt * along, t)
    ix, iy, iz = combine(moved, du, c, t)
    inertia = (ix - an * a[0], iy - an * a[1], iz - an * a[2])
    plain, f, g = an + cv * dn, (at - an) + cv * (2.0 * dt - dn), cv * normal / speed
    tx, ty, tz = t
    gx, gy, gz = g * x[0], g * x[1], g * x[2]
    fx, fy, fz = f * tx, f * ty, f * tz
    return (
        drag,
        inertia,
        (plain + fx * tx + gx * x[0], plain + fy * ty + gy * x[1], plain + fz * tz + gz * x[2]),
        (fx * ty + gx * x[1], fx * tz + gx * x[2], fy * tz + gy * x[2]),
    )


@kernel(counted=False)
def load_nodes(work, a, cv):
    """Residual and tangent of all nodes, without bed and bodies; returns the power lost to drag and to inertia."""
    w, v, known, node = work.q.shape[1], address(work.v), address(work.element), address(work.node)
    T, tangent, B, D, r = address(work.T), address(work.tangent), address(work.B), address(work.D), address(work.r)
    u, du, acceleration, lost_drag, lost_inertia = (
        address(work.u),
        address(work.du),
        address(a),
        repeated(0.0),
        repeated(0.0),
    )
    for j in range(0, a.shape[1] - WIDTH, WIDTH):
        before, after, speed = load_three(tangent, w, j), load_three(tangent, w, j + 1), load_three(v, w, j)
        now, water = load_three(acceleration, w, j), load_three(du, w, j)
        past, mass = minus(load_three(u, w, j), speed), load_vector(node, MASS * w + j)
        drag, inertia, square, mixed = half_water(known, w, j, before, past, now, water, cv)
        drag1, inertia1, square1, mixed1 = half_water(known, w, j + 1, after, past, now, water, cv)
        drag, inertia = combine(1.0, drag, 1.0, drag1), combine(1.0, inertia, 1.0, inertia1)
        lost_drag, lost_inertia = lost_drag - dot(drag, speed), lost_inertia - dot(inertia, speed)
        rx, ry, rz = combine(load_vector(T, j + 1), after, -load_vector(T, j), before)
        rx, ry = rx - mass * now[0] + drag[0] + inertia[0], ry - mass * now[1] + drag[1] + inertia[1]
        rz = rz - mass * now[2] - load_vector(node, WEIGHT * w + j) + drag[2] + inertia[2]
        store_three(r, w, j, (rx, ry, rz))
        xx, yy, zz = combine(1.0, square, 1.0, square1)
        xy, xz, yz = combine(1.0, mixed, 1.0, mixed1)
        bx, by, bz = combine(1.0, load_three(B, w, j), 1.0, load_three(B, w, j + 1))
        store_three(D, w, j, (bx + xx + mass, by + xy, bz + xz))
        bx, by, bz = combine(1.0, load_three(B, w, 3 * w + j), 1.0, load_three(B, w, 3 * w + j + 1))
        store_three(D, w, 3 * w + j, (bx + xy, by + yy + mass, bz + yz))
        bx, by, bz = combine(1.0, load_three(B, w, 6 * w + j), 1.0, load_three(B, w, 6 * w + j + 1))
        store_three(D, w, 6 * w + j, (bx + xz, by + yz, bz + zz + mass))
    return total(lost_drag), total(lost_inertia)


@kernel(counted=False)
def body_forces(s, work, a, cq, cv):
    """Buoyancy, drag and inertia of the bodies. Buoyancy is that of spheres; bodies out of the water have no drag."""
    q, v, u, du, r, D, power = work.q, work.v, work.u, work.du, work.r, work.D, work.power
    for j in s.body_nodes:
        share, slope, _ = immersion(q[2, j], s.body_radius[j])
        r[2, j] += s.body_buoyancy[j] * share
        D[8, j] -= cq * s.body_buoyancy[j] * slope
        x = (u[0, j] - v[0, j], u[1, j] - v[1, j], u[2, j] - v[2, j])
        speed = math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])
        c = s.body_drag[j] * share
        for i in range(3):
            drag = c * speed * x[i]
            inertia = (s.body_added[j] + s.body_displaced[j] * share) * du[i, j] - s.body_added[j] * a[i, j]
            r[i, j] += drag + inertia
            power[DRAG] -= drag * v[i, j]
            power[INERTIA] -= inertia * v[i, j]
            D[4 * i, j] += s.body_added[j] + cv * c * speed
            for m in range(3):
                D[3 * i + m, j] += cv * c * x[i] * x[m] / speed if speed > 0.0 else 0.0


@kernel(counted=False)
def node_forces(s, work, a, slip, since, cq, cv):
    """Residual work.r = forces − mass · a of all nodes, tangent blocks D and B, tensions T and powers.

    The nodes are at work.q with velocity work.v, in water that moves with work.u and accelerates with work.du;
    a, slip, since : (3, w)
    """
    v, r, power, last = work.v, work.r, work.power, s.length.size
    for k in range(power.size):
        power[k] = 0.0
    if work.tabled:
        find_rows(s, work)
    if work.rises:
        wet(work, last)
    power[STRUCTURE] = pull_elements(work, last, cq, cv)
    power[DRAG], power[INERTIA] = load_nodes(work, a, cv)
    if work.rises:
        weigh_dry(work, last, cq)
    bend(work.bending, work.q, r, work.D, last, cq)
    if s.body_nodes.size > 0:
        body_forces(s, work, a, cq, cv)
    if s.bed_stiffness[last] > 0.0:
        bed_forces(s, work, slip, since, cq, cv)
    for i in range(3):
        power[WORK] -= r[i, last] * v[i, last] + r[i, 0] * v[i, 0]


@kernel(counted=False)
def stored_energy(s, q, v):
    """Kinetic energy of the dry line, elastic energy, potential of weight and buoyancy, and energy in the bed, J."""
    kinetic, elastic, potential, bed = 0.0, 0.0, 0.0, 0.0
    for j in range(s.mass.size):
        kinetic += 0.5 * s.mass[j] * (v[0, j] ** 2 + v[1, j] ** 2 + v[2, j] ** 2)
        potential += s.weight[j] * q[2, j]
        if s.body_buoyancy[j] > 0.0:
            potential += s.body_buoyancy[j] * immersion(q[2, j], s.body_radius[j])[2]
        bed += bed_energy(s, j, q)
    for e in range(s.length.size):
        x, y, z = q[0, e + 1] - q[0, e], q[1, e + 1] - q[1, e], q[2, e + 1] - q[2, e]
        strain = math.sqrt(x * x + y * y + z * z) / s.length[e] - 1.0
        if strain > 0.0:
            row = elongation_row(s, e, strain)
            above = strain - s.elongation[row, 0]
            stored = s.elongation[row, 3] + above * (s.elongation[row, 1] + 0.5 * s.elongation[row, 2] * above)
            elastic += s.stiffness[e] * s.length[e] * stored
        if s.buoyancy[e] > 0.0:
            potential += energy_dry(s, e, q)
    elastic += bending_energy(s.flexure, s.length, q)
    return kinetic, elastic, potential, bed
