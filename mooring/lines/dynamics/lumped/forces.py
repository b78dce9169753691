"""Forces on the nodes of a line, their tangent, and the power of each loss.

    m a = T₊ t₊ − T₋ t₋ − w + drag + water inertia + bed,      tangent  S = M + c_v C + c_q K

Tension T = max(0, EA f(ε) + BA g ε̇) with ε = ℓ/ℓ₀ − 1 and f(ε) = ε, or straight between the points of a table; a
slack element (ε ≤ 0) carries nothing, and damping fades in with g = min(1, ε/ε_s), so that tension is continuous.
Drag and inertia follow Morison on each half element, with its own tangent t (SR179 report, 1982, section 2.2, in three
dimensions):

    normal      ½ρ C_dn D |u_n| u_n,     ρA [(1 + C_an) u̇_n − C_an a_n]
    tangential  ½ρ C_dt πD |u_t| u_t,    ρA C_at (u̇_t − a_t)

Bed: pressure k p²/2h for penetration p ≤ h, k (p − h/2) beyond, with h such that a node at rest has p = h and lies
on the bed's plane; damping c min(1, p/h) never pulls.  Friction μN acts against the elastic displacement s of the
node along the bed, −μN s/δ with |s| ≤ δ (elastic up to δ, then sliding).

The tangent is exact for tension, bed and friction and for drag against velocity; it leaves out how drag and added
mass turn with the line, which is h²|F|/mℓ times smaller.
"""

from __future__ import annotations

import math

from bem.kernels.jit import kernel

WORK, DRAG, INERTIA, STRUCTURE, BED, FRICTION = range(6)


@kernel()
def elongation_row(s, e, strain):
    """Row of s.elongation that holds at a strain of element e."""
    row = s.elongation_rows[e, 0]
    while row + 1 < s.elongation_rows[e, 1] and strain >= s.elongation[row + 1, 0]:
        row += 1
    return row


@kernel()
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
def bearing(k, thickness, p):
    """Bed reaction without damping, its derivative and its energy at penetration p."""
    if p <= 0.0:
        return 0.0, 0.0, 0.0
    if p < thickness:
        return 0.5 * k * p * p / thickness, k * p / thickness, k * p * p * p / (6.0 * thickness)
    return k * (p - 0.5 * thickness), k, 0.5 * k * (p * p - p * thickness + thickness * thickness / 3.0)


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
    n = s.bed_normal
    for j in range(q.shape[0]):
        h = s.bed_thickness[j]
        p = s.bed_level + h - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
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


@kernel()
def pressing(s, j, q, v):
    """N, reaction of the bed on node j, its damping included; 0 above the bed"""
    n, h = s.bed_normal, s.bed_thickness[j]
    p = s.bed_level + h - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
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
    n, work = s.bed_normal, 0.0
    for j in range(q.shape[0]):
        above = n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2] - s.bed_level - s.bed_thickness[j]
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
    n = s.bed_normal
    for j in range(q.shape[0]):
        kinetic += 0.5 * s.mass[j] * (v[j, 0] ** 2 + v[j, 1] ** 2 + v[j, 2] ** 2)
        potential += s.weight[j] * q[j, 2]
        if s.body_buoyancy[j] > 0.0:
            potential += s.body_buoyancy[j] * immersion(q[j, 2], s.body_radius[j])[2]
        if s.bed_stiffness[j] > 0.0:
            p = s.bed_level + s.bed_thickness[j] - (n[0] * q[j, 0] + n[1] * q[j, 1] + n[2] * q[j, 2])
            bed += bearing(s.bed_stiffness[j], s.bed_thickness[j], p)[2]
    for e in range(q.shape[0] - 1):
        x, y, z = q[e + 1, 0] - q[e, 0], q[e + 1, 1] - q[e, 1], q[e + 1, 2] - q[e, 2]
        strain = math.sqrt(x * x + y * y + z * z) / s.length[e] - 1.0
        if strain > 0.0:
            row = elongation_row(s, e, strain)
            more = strain - s.elongation[row, 0]
            stored = s.elongation[row, 3] + more * (s.elongation[row, 1] + 0.5 * s.elongation[row, 2] * more)
            elastic += s.stiffness[e] * s.length[e] * stored
    return kinetic, elastic, potential, bed
