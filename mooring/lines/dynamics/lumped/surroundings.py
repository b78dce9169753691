"""Where the fairlead is and how the water moves: the given functions of time.

Waves are linear (`bem.waves`): with θ = ωt − k·x − ε the elevation is a cos θ and the velocity

    u_h = aω cosh k(z+h)/sinh kh · cos θ,    w = −aω sinh k(z+h)/sinh kh · sin θ.

Above still water the values of z = 0 are used; the current is constant beyond its highest and lowest level.
The ramp R = x³(10 − 15x + 6x²), x = t/ramp, has continuous velocity and acceleration.
"""

from __future__ import annotations

import math

import numpy as np

from bem.kernels.jit import kernel


@kernel()
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


@kernel()
def fairlead_at(motion, t, p, v, a):
    """Position, velocity and acceleration of the fairlead, into p, v, a (3,)."""
    k = min(max(np.searchsorted(motion.knots, t, side="right") - 1, 0), motion.cubics.shape[0] - 1)
    c, x = motion.cubics[k], t - motion.knots[k]
    for i in range(3):
        p[i] = c[0, i] + x * (c[1, i] + x * (c[2, i] + x * c[3, i]))
        v[i] = c[1, i] + x * (2 * c[2, i] + 3 * x * c[3, i])
        a[i] = 2 * c[2, i] + 6 * x * c[3, i]
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


@kernel()
def water_at(water, q, nodes, t, u, du):
    """Velocity u and acceleration du of the water at the first `nodes` points q, all (3, w), 0 where it is still."""
    levels, waves = water.level.size, water.omega.size
    if levels + waves == 0:
        return
    R, R1, _ = ramp_at(t, water.ramp)
    for j in range(nodes):
        for i in range(3):
            u[i, j], du[i, j] = 0.0, 0.0
        z = min(q[2, j], 0.0)
        if levels > 0:
            for i in range(2):
                u[i, j] = np.interp(z, water.level, water.current[:, i])
        for m in range(waves):
            w, k, c, s = water.omega[m], water.wavenumber[m], water.heading[m, 0], water.heading[m, 1]
            theta = w * t - k * (c * q[0, j] + s * q[1, j]) - water.phase[m]
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
