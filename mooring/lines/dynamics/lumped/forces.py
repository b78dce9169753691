"""Forces on the nodes of a line, their tangent, and the power of each loss.

    m a = T₊ t₊ − T₋ t₋ − w + drag + water inertia + bed,      tangent  S = M + c_v C + c_q K

Tension T = max(0, EA f(ε) + BA g ε̇) with ε = ℓ/ℓ₀ − 1 and f(ε) = ε, or straight between the points of a table; a
slack element (ε ≤ 0) carries nothing, and damping fades in with g = min(1, ε/ε_s), so that tension is continuous.
Drag and inertia follow Morison on each half element, with its own tangent t (SR179 report, 1982, section 2.2, in three
dimensions):

    normal      ½ρ C_dn D |u_n| u_n,     ρA [(1 + C_an) u̇_n − C_an a_n]
    tangential  ½ρ C_dt πD |u_t| u_t,    ρA C_at (u̇_t − a_t)

Bed: `bed`.

The tangent is exact for tension, bed and friction and for drag against velocity; it leaves out how drag and added
mass turn with the line, which is h²|F|/mℓ times smaller.
"""

from __future__ import annotations

import math

from bem.kernels.jit import kernel

from .bed import bed_energy, bed_forces
from .books import DRAG, INERTIA, STRUCTURE, WORK


@kernel(inline=True)
def elongation_row(s, e, strain):
    """Row of s.elongation that holds at a strain of element e."""
    row = s.elongation_rows[e, 0]
    while row + 1 < s.elongation_rows[e, 1] and strain >= s.elongation[row + 1, 0]:
        row += 1
    return row


@kernel(inline=True)
def tension(s, e, strain, rate):
    """Tension of element e, its elastic part, ∂T/∂ε and ∂T/∂ε̇."""
    if strain <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    EA, BA, soft, row = s.stiffness[e], s.damping[e], s.soft_strain[e], elongation_row(s, e, strain)
    k = EA * s.elongation[row, 2]
    elastic = EA * s.elongation[row, 1] + k * (strain - s.elongation[row, 0])
    fade = min(1.0, strain / soft)
    T = elastic + BA * fade * rate
    if T <= 0.0:
        return 0.0, elastic, 0.0, 0.0
    return T, elastic, k + (BA * rate / soft if strain < soft else 0.0), BA * fade


@kernel()
def immersion(z, radius):
    """Share of a sphere's volume under z = 0, its derivative, and −∫ share dz from deep water to z, centre at z."""
    if z <= -radius:
        return 1.0, 0.0, -z
    if z >= radius:
        return 0.0, 0.0, 0.0
    x = z / radius
    share = 0.25 * (1 - x) * (1 - x) * (2 + x)
    return share, -0.75 * (1 - x * x) / radius, radius * (0.1875 - 0.25 * x * (2 - x * (1.5 - 0.25 * x * x)))


@kernel()
def axial_forces(s, q, v, cq, cv, r, D, B, T, tangent, power):
    """Tension of every element on its two nodes; unit vectors towards the fairlead into `tangent` (N, 3)."""
    lost = 0.0
    for e in range(s.length.size):
        x, y, z = q[e + 1, 0] - q[e, 0], q[e + 1, 1] - q[e, 1], q[e + 1, 2] - q[e, 2]
        squared, free = x * x + y * y + z * z, s.length[e]
        short = 1.0 / math.sqrt(squared)
        x, y, z = x * short, y * short, z * short
        wx, wy, wz = v[e + 1, 0] - v[e, 0], v[e + 1, 1] - v[e, 1], v[e + 1, 2] - v[e, 2]
        stretching = x * wx + y * wy + z * wz
        strain, rate = squared * short / free - 1.0, stretching / free
        pull, elastic, k, b = tension(s, e, strain, rate)
        lost += (pull - elastic) * stretching
        across, turning = cq * pull * short, cq * b * short / free
        axial = (cq * k + cv * b) / free - across - turning * stretching
        ax, ay, az = axial * x + turning * wx, axial * y + turning * wy, axial * z + turning * wz
        c, here, there = B[e], D[e], D[e + 1]
        # tension along the element, and that it turns with it
        c[0, 0], c[0, 1], c[0, 2] = x * ax + across, x * ay, x * az
        c[1, 0], c[1, 1], c[1, 2] = y * ax, y * ay + across, y * az
        c[2, 0], c[2, 1], c[2, 2] = z * ax, z * ay, z * az + across
        for i in range(3):
            for m in range(3):
                here[i, m] += c[i, m]
                there[i, m] += c[i, m]
        r[e, 0] += pull * x
        r[e, 1] += pull * y
        r[e, 2] += pull * z
        r[e + 1, 0] -= pull * x
        r[e + 1, 1] -= pull * y
        r[e + 1, 2] -= pull * z
        tangent[e, 0], tangent[e, 1], tangent[e, 2], T[e] = x, y, z, pull
    power[STRUCTURE] = lost


@kernel()
def water_forces(s, v, a, u, du, cv, r, D, tangent, power):
    """Drag and inertia of both halves of every element."""
    lost_drag, lost_inertia = 0.0, 0.0
    for half in range(2 * s.length.size):
        e, j = half // 2, (half + 1) // 2
        tx, ty, tz = tangent[e, 0], tangent[e, 1], tangent[e, 2]
        x, y, z = u[j, 0] - v[j, 0], u[j, 1] - v[j, 1], u[j, 2] - v[j, 2]
        along = x * tx + y * ty + z * tz
        x, y, z = x - along * tx, y - along * ty, z - along * tz
        speed = math.sqrt(x * x + y * y + z * z)
        dn, dt = s.half_drag_normal[e] * speed, s.half_drag_tangential[e] * abs(along)
        an, at, water = s.half_added_normal[e], s.half_added_tangential[e], s.half_displaced[e]
        # what the tangential part of the accelerations of line and water has less, or more, than the normal part
        c = (an - at) * (a[j, 0] * tx + a[j, 1] * ty + a[j, 2] * tz)
        c -= (an + water - at) * (du[j, 0] * tx + du[j, 1] * ty + du[j, 2] * tz)
        drag_x, drag_y, drag_z = dn * x + dt * along * tx, dn * y + dt * along * ty, dn * z + dt * along * tz
        inertia_x = (an + water) * du[j, 0] - an * a[j, 0] + c * tx
        inertia_y = (an + water) * du[j, 1] - an * a[j, 1] + c * ty
        inertia_z = (an + water) * du[j, 2] - an * a[j, 2] + c * tz
        lost_drag -= drag_x * v[j, 0] + drag_y * v[j, 1] + drag_z * v[j, 2]
        lost_inertia -= inertia_x * v[j, 0] + inertia_y * v[j, 1] + inertia_z * v[j, 2]
        r[j, 0] += drag_x + inertia_x
        r[j, 1] += drag_y + inertia_y
        r[j, 2] += drag_z + inertia_z
        plain, f = an + cv * dn, (at - an) + cv * (2.0 * dt - dn)
        g = cv * s.half_drag_normal[e] / speed if speed > 0.0 else 0.0
        A = D[j]
        xy, xz, yz = f * tx * ty + g * x * y, f * tx * tz + g * x * z, f * ty * tz + g * y * z
        A[0, 0] += plain + f * tx * tx + g * x * x
        A[1, 1] += plain + f * ty * ty + g * y * y
        A[2, 2] += plain + f * tz * tz + g * z * z
        A[0, 1] += xy
        A[1, 0] += xy
        A[0, 2] += xz
        A[2, 0] += xz
        A[1, 2] += yz
        A[2, 1] += yz
    power[DRAG], power[INERTIA] = lost_drag, lost_inertia


@kernel()
def body_forces(s, q, v, a, u, du, cq, cv, r, D, power):
    """Buoyancy, drag and inertia of the bodies, spheres for buoyancy; out of the water they feel no drag."""
    for j in s.body_nodes:
        share, slope, _ = immersion(q[j, 2], s.body_radius[j])
        r[j, 2] += s.body_buoyancy[j] * share
        D[j, 2, 2] -= cq * s.body_buoyancy[j] * slope
        x = (u[j, 0] - v[j, 0], u[j, 1] - v[j, 1], u[j, 2] - v[j, 2])
        speed = math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])
        c = s.body_drag[j] * share
        for i in range(3):
            drag = c * speed * x[i]
            inertia = (s.body_added[j] + s.body_displaced[j] * share) * du[j, i] - s.body_added[j] * a[j, i]
            r[j, i] += drag + inertia
            power[DRAG] -= drag * v[j, i]
            power[INERTIA] -= inertia * v[j, i]
            D[j, i, i] += s.body_added[j] + cv * c * speed
            for m in range(3):
                D[j, i, m] += cv * c * x[i] * x[m] / speed if speed > 0.0 else 0.0


@kernel()
def node_forces(s, work, a, slip, since, cq, cv):
    """Residual work.r = forces − mass · a of all nodes, tangent blocks D and B, tensions T and powers.

    The nodes are at work.q with velocity work.v, in water that moves with work.u and accelerates with work.du.
    """
    q, v, r, D, power, last = work.q, work.v, work.r, work.D, work.power, work.q.shape[0] - 1
    for k in range(power.size):
        power[k] = 0.0
    for j in range(last + 1):
        for i in range(3):
            r[j, i] = -s.mass[j] * a[j, i]
            for m in range(3):
                D[j, i, m] = s.mass[j] if i == m else 0.0
        r[j, 2] -= s.weight[j]
    axial_forces(s, q, v, cq, cv, r, D, work.B, work.T, work.tangent, power)
    water_forces(s, v, a, work.u, work.du, cv, r, D, work.tangent, power)
    if s.body_nodes.size > 0:
        body_forces(s, q, v, a, work.u, work.du, cq, cv, r, D, power)
    if s.bed_stiffness[last] > 0.0:
        bed_forces(s, q, v, slip, since, cq, cv, r, D, power)
    for i in range(3):
        power[WORK] -= r[last, i] * v[last, i] + r[0, i] * v[0, i]


@kernel()
def stored_energy(s, q, v):
    """Kinetic energy of the dry line, elastic energy, potential of weight and buoyancy, and energy in the bed, J."""
    kinetic, elastic, potential, bed = 0.0, 0.0, 0.0, 0.0
    for j in range(q.shape[0]):
        kinetic += 0.5 * s.mass[j] * (v[j, 0] ** 2 + v[j, 1] ** 2 + v[j, 2] ** 2)
        potential += s.weight[j] * q[j, 2]
        if s.body_buoyancy[j] > 0.0:
            potential += s.body_buoyancy[j] * immersion(q[j, 2], s.body_radius[j])[2]
        bed += bed_energy(s, j, q)
    for e in range(q.shape[0] - 1):
        x, y, z = q[e + 1, 0] - q[e, 0], q[e + 1, 1] - q[e, 1], q[e + 1, 2] - q[e, 2]
        strain = math.sqrt(x * x + y * y + z * z) / s.length[e] - 1.0
        if strain > 0.0:
            row = elongation_row(s, e, strain)
            more = strain - s.elongation[row, 0]
            stored = s.elongation[row, 3] + more * (s.elongation[row, 1] + 0.5 * s.elongation[row, 2] * more)
            elastic += s.stiffness[e] * s.length[e] * stored
    return kinetic, elastic, potential, bed
