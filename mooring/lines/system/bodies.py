"""Rotations of a body: R takes body axes to space axes."""

import math

import numpy as np


def rotation(roll, pitch, yaw):
    """Rotation R = Rz(yaw) Ry(pitch) Rx(roll), angles in rad; shape (3, 3)"""
    (a, b, c), (d, e, f) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return np.array(
        [
            [c * b, c * e * d - f * a, c * e * a + f * d],
            [f * b, f * e * d + c * a, f * e * a - c * d],
            [-e, b * d, b * a],
        ]
    )


def angles(R):
    """Roll, pitch, yaw in rad of R = Rz Ry Rx, pitch within ±π/2; shape (3,)"""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


def cross_matrix(a):
    """Matrix S with S v = a × v; shape (3, 3)"""
    x, y, z = a
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rotated(R, turn):
    """Rotation R after a further rotation by the vector `turn` (3,) rad about space axes."""
    x, y, z = turn.tolist()
    squared = x * x + y * y + z * z
    angle = math.sqrt(squared)
    half = 0.5 * angle
    one = math.sin(angle) / angle if angle > 0 else 1.0
    two = 0.5 * (math.sin(half) / half if half > 0 else 1.0) ** 2
    keep = 1.0 - two * squared  # Rodrigues, with S² = t t' − |t|²
    own, xy, xz, yz = two * x, two * x * y, two * x * z, two * y * z
    S = [
        [keep + own * x, xy - one * z, xz + one * y],
        [xy + one * z, keep + two * y * y, yz - one * x],
        [xz - one * y, yz + one * x, keep + two * z * z],
    ]
    return np.array(S) @ R


def axes_in_space(headings):
    """Matrix whose columns are the motion axes, in space axes, of bodies with headings (N,) rad; shape (6N, 6N)"""
    turn = np.zeros((6 * len(headings), 6 * len(headings)))
    for i, heading in enumerate(headings):
        turn[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = np.kron(np.eye(2), rotation(0.0, 0.0, heading))
    return turn


def places_along(headings):
    """Matrix whose columns are the changes of position by motions along body axes, for headings (N,) rad; shape (6N,
    6N)

    x and y of positions are along the axes of space; roll and pitch are already about the axes of the body.
    """
    turn = np.eye(6 * len(headings))
    for i, heading in enumerate(headings):
        turn[6 * i : 6 * i + 3, 6 * i : 6 * i + 3] = rotation(0.0, 0.0, heading)
    return turn
