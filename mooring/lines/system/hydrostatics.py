"""Steady loads of bodies, and hydrostatic forces of bodies that heave, roll, pitch and turn to any heading.

R converts body axes to space axes.  It is read as a turn ψ about the vertical followed by the shortest tilt that
carries the vertical to u = R e_z.  In axes that turn with ψ the hydrostatic force is −C (heave, roll, pitch), with
roll and pitch from the tilt e_z × u. It is exact in heading and, like C itself, linear in tilt.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel


@kernel()
def heading(R):
    """ψ, rad: the rotation about the vertical that remains after the shortest tilt."""
    return math.atan2(R[1, 0] - R[0, 1], R[0, 0] + R[1, 1])


@kernel()
def add_hydrostatics(force, K, first, stiffness, sinkage, R):
    """Add the force and moment of a body, and −∂/∂(shift, rotation about space axes); first : its first degree of
    freedom.

    stiffness : (6, 6), of which heave, roll and pitch are used; sinkage : m, height relative to the height at rest
    """
    psi, x, y, z = heading(R), R[0, 2], R[1, 2], R[2, 2]
    c, s = math.cos(psi), math.sin(psi)
    heave, roll, pitch = stiffness[2], stiffness[3], stiffness[4]
    # T C T' for (heave, roll, pitch), T from the heading's axes to space
    a, b = heave[2], c * heave[3] - s * heave[4]
    d, e, f = s * heave[3] + c * heave[4], c * roll[2] - s * pitch[2], s * roll[2] + c * pitch[2]
    rr, rp, pr, pp = roll[3], roll[4], pitch[3], pitch[4]
    g = c * (c * rr - s * rp) - s * (c * pr - s * pp)
    h = c * (s * rr + c * rp) - s * (s * pr + c * pp)
    m = s * (c * rr - s * rp) + c * (c * pr - s * pp)
    n = s * (s * rr + c * rp) + c * (s * pr + c * pp)
    # columns for sinkage, −y, x
    up, about_x, about_y = a * sinkage - b * y + d * x, e * sinkage - g * y + h * x, f * sinkage - m * y + n * x
    force[first + 2] -= up
    force[first + 3] -= about_x
    force[first + 4] -= about_y
    K[first + 2, first + 2] += a
    K[first + 3, first + 2] += e
    K[first + 4, first + 2] += f
    # change of the force with ψ, and of ψ and the tilt with the rotation of the body
    rows = (
        (b, d, b * x + d * y),
        (g, h, g * x + h * y - about_y),
        (m, n, m * x + n * y + about_x),
    )
    by_psi = 1.0 / (1.0 + z)
    for i in range(3):
        row = K[first + 2 + i]
        one, two, turn = rows[i]
        row[first + 3] += one * z + turn * x * by_psi
        row[first + 4] += two * z + turn * y * by_psi
        row[first + 5] += -one * x - two * y + turn


@kernel()
def add_loads(force, K, loads, springs, height, place, turn):
    """Add steady loads (b, 6) of bodies and their hydrostatic forces; springs : (b, 6, 6); height : z at rest, (b,)
    m.
    """
    for i in range(loads.shape[0]):
        for j in range(6):
            force[6 * i + j] += loads[i, j]
        add_hydrostatics(force, K, 6 * i, springs[i], place[i, 2] - height[i], turn[i])


def hydrostatic_load(stiffness, sinkage, R):
    """Force and moment in space axes, shape (6,), and their stiffness, shape (6, 6): see `add_hydrostatics`."""
    force, K = np.zeros(6), np.zeros((6, 6))
    add_hydrostatics(force, K, 0, np.asarray(stiffness, float), float(sinkage), np.asarray(R, float))
    return force, K
