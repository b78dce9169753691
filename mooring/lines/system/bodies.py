"""Rotations of a body, and the hydrostatic forces of one that heaves, rolls, pitches and turns to any heading.

R takes body axes to space axes.  It is read as a turn ψ about the vertical followed by the shortest tilt that
carries the vertical to u = R e_z.  In axes that turn with ψ the hydrostatic force is −C (heave, roll, pitch)
with roll and pitch taken from the tilt e_z × u: exact in heading, linear in tilt, as C itself is.
"""

from __future__ import annotations

import math

import numpy as np

VERTICAL = np.array([0.0, 0.0, 1.0])


def rotation(roll, pitch, yaw):
    """(3, 3) R = Rz(yaw) Ry(pitch) Rx(roll), rad"""
    (a, b, c), (d, e, f) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return np.array(
        [
            [c * b, c * e * d - f * a, c * e * a + f * d],
            [f * b, f * e * d + c * a, f * e * a - c * d],
            [-e, b * d, b * a],
        ]
    )


def angles(R):
    """(3,) roll, pitch, yaw in rad of R = Rz Ry Rx, pitch within ±π/2"""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


def cross_matrix(a):
    """(3, 3) S with S v = a × v"""
    x, y, z = a
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rotated(R, turn):
    """R after a further rotation by the vector `turn` (3,) rad about space axes."""
    angle = math.sqrt(turn @ turn)
    S = cross_matrix(turn)
    half = 0.5 * angle
    one = math.sin(angle) / angle if angle > 0 else 1.0
    two = 0.5 * (math.sin(half) / half if half > 0 else 1.0) ** 2
    return R + one * (S @ R) + two * (S @ (S @ R))


def heading(R):
    """ψ, rad: the turn about the vertical that is left when the shortest tilt is taken off."""
    return np.arctan2(R[1, 0] - R[0, 1], R[0, 0] + R[1, 1])


def hydrostatic_load(stiffness, sinkage, R):
    """(6,) force and moment in space axes and its (6, 6) stiffness −∂/∂(shift, rotation about space axes).

    stiffness : (6, 6), of which heave, roll and pitch count; sinkage : m, height over that at rest
    """
    C = np.asarray(stiffness, float)[2:5, 2:5]
    u, psi = R[:, 2], heading(R)
    c, s = np.cos(psi), np.sin(psi)
    T = np.array([[1.0, 0, 0], [0, c, -s], [0, s, c]])  # heading axes → space, for (heave, roll, pitch)
    turn = np.array([[0.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # dT/dψ = turn T
    d = np.array([sinkage, -u[1], u[0]])
    local = T @ C @ T.T
    force = -local @ d
    d_turn = u[2] * np.eye(3) - np.outer(u, VERTICAL)  # ∂(e_z × u)/∂rotation
    psi_turn = (VERTICAL + u) / (1 + u[2])
    K = np.zeros((6, 6))
    K[2:5, 2] = local[:, 0]
    K[2:5, 3:] = local[:, 1:] @ d_turn[:2] + np.outer((turn @ local - local @ turn) @ d, psi_turn)
    return np.concatenate([[0.0, 0.0], force, [0.0]]), K
