"""Plane waves on a plan contour, split by symmetry, and the resulting far field.

    exp(ik(x cosβ + y sinβ)) = Σ over classes of A(kx cosβ) B(ky sinβ),    A, B = cos or i sin

as products of A and B, so that no class is a small difference of large numbers in long waves.
"""

from typing import NamedTuple

import numpy as np

from ...kochin import folded
from ...waves import exponential_part

# signs of the mirror images of a plan with two planes of symmetry
IMAGES = np.array([[1, 1], [-1, 1], [1, -1], [-1, -1]])


class PlaneWaves(NamedTuple):
    """One symmetry class of plane waves at the nodes of a contour, arrays (m, b); names with `turn` are
    β-derivatives."""

    value: np.ndarray
    flux: np.ndarray  # 1/m, along the outward normal
    turn_value: np.ndarray
    turn_flux: np.ndarray


def plane_waves(cls, contour, k, beta):
    """`PlaneWaves` of k rad/m towards `beta` (b,) rad"""
    c, s, p = np.cos(beta), np.sin(beta), contour
    A, dA = exponential_part(cls[0], np.multiply.outer(k * p.x, c))
    B, dB = exponential_part(cls[1], np.multiply.outer(k * p.y, s))
    turn_a, turn_b = np.multiply.outer(-k * p.x, s), np.multiply.outer(k * p.y, c)
    nx, ny = k * p.nx[:, None], k * p.ny[:, None]
    return PlaneWaves(
        A * B,
        nx * c * dA * B + ny * s * A * dB,
        turn_a * dA * B + turn_b * A * dB,
        nx * (c * (turn_b * dA * dB - turn_a * A * B) - s * dA * B)
        + ny * (s * (turn_a * dA * dB - turn_b * A * B) + c * A * dB),
    )


def plane_wave_values(cls, contour, k, beta):
    """`PlaneWaves.value` alone"""
    (A, _), (B, _) = (
        exponential_part(sign, np.multiply.outer(k * x, turn))
        for sign, x, turn in ((cls[0], contour.x, np.cos(beta)), (cls[1], contour.y, np.sin(beta)))
    )
    return A * B


def far_field(cls, contour, k, theta, potential, velocity):
    """∮ (φ ∂ē/∂n − ē ∂φ/∂n) ds, ē = exp(−ik(x cosθ + y sinθ)), and the θ-derivative; shape (2, columns, t).

    potential, velocity : φ and ∂φ/∂n of the propagating mode at the nodes of the contour, (m, columns)
    """
    directions = folded(theta, IMAGES)
    parts = plane_waves(cls, contour, k, directions.angles)
    waves = PlaneWaves(*(4 * contour.weights[:, None] * part.conj() for part in parts))
    value = potential.T @ waves.flux - velocity.T @ waves.value
    slope = potential.T @ waves.turn_flux - velocity.T @ waves.turn_value
    return np.array(directions.unfolded(value, slope, np.where(IMAGES < 0, cls, 1).prod(axis=1)))
