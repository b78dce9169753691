"""Position of the fairlead and motion of the water: the given functions of time.

Waves are linear (`bem.waves`): with θ = ωt − k·x − ε the elevation is a cos θ and the velocity

    u_h = aω cosh k(z+h)/sinh kh · cos θ,    w = −aω sinh k(z+h)/sinh kh · sin θ.

Above still water the values at z = 0 are used. The current is constant above its highest and below its lowest level.
In place of the waves there may be a table of their sums over time at places near the nodes (`tabled_water`).
The ramp R = x³(10 − 15x + 6x²), x = t/ramp, has continuous velocity and acceleration.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, load_vector, repeated

from .vectors import combine, less, load_three, minus, store_three

SAMPLES = 6  # number of table times in a polynomial
OF_PLACE = 8  # u, v, w; ∂u/∂x, ∂u/∂y, ∂v/∂y, ∂u/∂z, ∂v/∂z, the others of a potential follow
SHARES = 1.0 / np.array([-120.0, 24.0, -12.0, 12.0, -24.0, 120.0])  # 1 / Π (i − m) over m ≠ i


@kernel(counted=False)
def ramp_at(t, ramp):
    """R, dR/dt and d²R/dt² at time t."""
    if t >= ramp:
        return 1.0, 0.0, 0.0
    x = max(t / ramp, 0.0)
    return (
        x * x * x * (10 - 15 * x + 6 * x * x),
        30 * x * x * (1 - x) * (1 - x) / ramp,
        60 * x * (1 - x) * (1 - 2 * x) / (ramp * ramp),
    )


@kernel(counted=False)
def fairlead_at(motion, t, p, v, a):
    """Position, velocity and acceleration of the fairlead, into p, v, a (3,)."""
    k, beyond = 0, motion.cubics.shape[0]
    while k + 1 < beyond:  # bisection to the last knot at or before t
        half = (k + beyond) // 2
        if motion.knots[half] <= t:
            k = half
        else:
            beyond = half
    c, x = motion.cubics, t - motion.knots[k]
    for i in range(3):
        p[i] = c[k, 0, i] + x * (c[k, 1, i] + x * (c[k, 2, i] + x * c[k, 3, i]))
        v[i] = c[k, 1, i] + x * (2 * c[k, 2, i] + 3 * x * c[k, 3, i])
        a[i] = 2 * c[k, 2, i] + 6 * x * c[k, 3, i]
    R, R1, R2 = ramp_at(t, motion.ramp)
    for m in range(motion.omega.size):
        w = motion.omega[m]
        cosine, sine = math.cos(w * t), math.sin(w * t)
        for i in range(3):
            s = motion.real[m, i] * cosine + motion.imag[m, i] * sine
            s1 = w * (motion.imag[m, i] * cosine - motion.real[m, i] * sine)
            p[i] += R * s
            v[i] += R * s1 + R1 * s
            a[i] += R2 * s + 2 * R1 * s1 - R * w * w * s


@kernel(counted=False)
def time_weights(x, weights):
    """Factors (2, SAMPLES) on the values at 0, 1, … for the polynomial through these values at x, and for its slope"""
    for i in range(SAMPLES):
        value, slope = SHARES[i], 0.0
        for m in range(SAMPLES):
            if m != i:
                slope = slope * (x - m) + value
                value *= x - m
        weights[0, i], weights[1, i] = value, slope


@kernel(inline=True, counted=False)
def in_time(table, weights, part, nodes, at):
    """Eight numbers of the table, from `at` on, or their slopes, at one time; table, weights : pointers"""
    total, w = weights[SAMPLES * part] * load_vector(table, at), SAMPLES * part
    for i in range(1, SAMPLES):
        total = total + weights[w + i] * load_vector(table, i * OF_PLACE * nodes + at)
    return total


@kernel(inline=True, counted=False)
def moved_water(table, weights, part, n, j, d):
    """Velocity or acceleration of the water at eight of n nodes, from j on, displaced by d (3) m from their tabled
    places
    """
    x, y, z = d
    xx, xy = in_time(table, weights, part, n, 3 * n + j), in_time(table, weights, part, n, 4 * n + j)
    yy, xz = in_time(table, weights, part, n, 5 * n + j), in_time(table, weights, part, n, 6 * n + j)
    yz = in_time(table, weights, part, n, 7 * n + j)
    return (
        in_time(table, weights, part, n, j) + xx * x + xy * y + xz * z,
        in_time(table, weights, part, n, n + j) + xy * x + yy * y + yz * z,
        in_time(table, weights, part, n, 2 * n + j) + xz * x + yz * y - (xx + yy) * z,
    )


@kernel(counted=False)
def tabled_water(water, q, nodes, t, R, R1, u, du):
    """Add the water of the table at time t, with its ramp R and dR/dt, to u and du (3, w).

    A current carries the waves past the nodes: it adds the convective part (V·∇)u to the local change.
    """
    time_weights((t - water.clock[0]) / water.clock[1], water.weights)
    w, table, weights, slower = q.shape[1], address(water.table), address(water.weights), 1.0 / water.clock[1]
    at, place, velocity, change = address(q), address(water.place), address(u), address(du)
    carried = water.carried[0] != 0.0 or water.carried[1] != 0.0
    for j in range(0, nodes, WIDTH):
        x, y, z = load_three(at, w, j)
        d = minus((x, y, less(z, repeated(0.0))), load_three(place, nodes, j))
        flow, rate = moved_water(table, weights, 0, nodes, j, d), moved_water(table, weights, 1, nodes, j, d)
        store_three(velocity, w, j, combine(1.0, load_three(velocity, w, j), R, flow))
        gained = combine(R * slower, rate, R1, flow)
        store_three(change, w, j, combine(1.0, load_three(change, w, j), 1.0, gained))
        if carried:
            there = minus(d, (repeated(-water.carried[0]), repeated(-water.carried[1]), repeated(0.0)))
            brought = minus(moved_water(table, weights, 0, nodes, j, there), flow)
            store_three(change, w, j, combine(1.0, load_three(change, w, j), R, brought))


@kernel(counted=False)
def add_current(water, q, nodes, U, U1, u, du):
    """Add the current, with its ramp U and dU/dt, to u and du (3, w)."""
    level = water.level
    for j in range(nodes):
        z, k = min(q[2, j], 0.0), 0
        while k + 1 < level.size and z >= level[k + 1]:
            k += 1
        inside = k + 1 < level.size and z > level[k]
        for i in range(2):
            speed = water.current[k, i]
            if inside:
                speed += (water.current[k + 1, i] - speed) / (level[k + 1] - level[k]) * (z - level[k])
            u[i, j] += U * speed
            du[i, j] += U1 * speed


@kernel(counted=False)
def add_waves(water, q, nodes, t, R, R1, u, du):
    """Add the sum of all waves, with their ramp R and dR/dt, to u and du (3, w)."""
    for j in range(nodes):
        z = min(q[2, j], 0.0)
        for m in range(water.omega.size):
            w, k, c, s = water.omega[m], water.wavenumber[m], water.heading[m, 0], water.heading[m, 1]
            theta = water.met[m] * t - k * (c * q[0, j] + s * q[1, j]) - water.phase[m]
            rise, image = math.exp(k * z), math.exp(-k * (z + 2 * water.depth))
            scale = water.amplitude[m] * w / (1.0 - math.exp(-2 * k * water.depth))
            along, up = scale * (rise + image), scale * (rise - image)
            cosine, sine = math.cos(theta), math.sin(theta)
            h, h1 = R * along * cosine, along * (R1 * cosine - R * w * sine)
            u[0, j] += c * h
            u[1, j] += s * h
            u[2, j] -= R * up * sine
            du[0, j] += c * h1
            du[1, j] += s * h1
            du[2, j] -= up * (R1 * sine + R * w * cosine)


@kernel(counted=False)
def water_at(water, q, nodes, t, u, du):
    """Velocity u and acceleration du of the water at the first `nodes` points q, all (3, w).

    Each part has its own kernel: a single loop for all parts took 5 µs for 21 nodes even without anything to add.
    """
    for i in range(3):
        for j in range(nodes):
            u[i, j], du[i, j] = 0.0, 0.0
    R, R1, _ = ramp_at(t - water.begin, water.ramp)
    if water.level.size > 0:
        U, U1, _ = ramp_at(t, water.current_ramp)
        add_current(water, q, nodes, U, U1, u, du)
    if water.omega.size > 0:
        add_waves(water, q, nodes, t, R, R1, u, du)
    if water.table.size > 0:
        tabled_water(water, q, nodes, t, R, R1, u, du)
