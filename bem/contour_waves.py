"""Plane waves on a plan contour, split by symmetry, and what follows from them: Froude–Krylov force and far field.

    exp(ik(x cosβ + y sinβ)) = Σ over classes of A(kx cosβ) B(ky sinβ),    A, B = cos or i sin

in products, so that no class is the small difference of others in long waves.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .modes import class_of
from .plan import CLASSES


class PlaneWaves(NamedTuple):
    """One symmetry class of plane waves at the nodes of a contour, (m, b) each; `turn…` is the β-derivative."""

    value: np.ndarray
    flux: np.ndarray  # 1/m, along the outward normal
    turn_value: np.ndarray
    turn_flux: np.ndarray


def plane_waves(cls, contour, k, beta):
    """`PlaneWaves` of k rad/m towards `beta` (b,) rad"""
    c, s, p = np.cos(beta), np.sin(beta), contour
    A, dA = _part(cls[0], np.multiply.outer(k * p.x, c))
    B, dB = _part(cls[1], np.multiply.outer(k * p.y, s))
    turn_a, turn_b = np.multiply.outer(-k * p.x, s), np.multiply.outer(k * p.y, c)
    nx, ny = k * p.nx[:, None], k * p.ny[:, None]
    return PlaneWaves(
        A * B,
        nx * c * dA * B + ny * s * A * dB,
        turn_a * dA * B + turn_b * A * dB,
        nx * (c * (turn_b * dA * dB - turn_a * A * B) - s * dA * B)
        + ny * (s * (turn_a * dA * dB - turn_b * A * B) + c * A * dB),
    )


def _part(sign, phase):
    """Even or odd part of exp(i phase) and its derivative"""
    if sign == 1:
        return np.cos(phase), -np.sin(phase)
    return 1j * np.sin(phase), 1j * np.cos(phase)


def froude_krylov(contour, k, beta, depth_integrals, keel):
    """Force of the undisturbed wave per unit amplitude and ρg, about the origin, (b, 6).

    depth_integrals : ∫Z dz and ∫zZ dz over the draft; keel : Z(−d)

    Over the bottom ∬ f dA = −∮ ∂f/∂n ds / k² and ∬ x f dA = −∮ (x ∂f/∂n − f n₁) ds / k².
    """
    one, z = depth_integrals
    c, force = contour, np.zeros((len(beta), 6), complex)
    waves = {cls: plane_waves(cls, c, k, beta) for cls in CLASSES}

    def around(dof, value, flux=0.0):
        w = waves[class_of(dof, "xy")]
        return 4 * (c.weights * value) @ w.value + 4 * (c.weights * flux) @ w.flux

    force[:, 0] = one * around(0, c.nx)
    force[:, 1] = one * around(1, c.ny)
    force[:, 2] = keel / k**2 * around(2, 0 * c.x, 1.0)
    force[:, 3] = -z * around(3, c.ny) - keel / k**2 * around(3, c.ny, -c.y)
    force[:, 4] = z * around(4, c.nx) + keel / k**2 * around(4, c.nx, -c.x)
    force[:, 5] = one * around(5, c.x * c.ny - c.y * c.nx)
    return -force


def far_field(cls, contour, k, theta, potential, velocity):
    """∮ (φ ∂ē/∂n − ē ∂φ/∂n) ds with ē = exp(−ik(x cosθ + y sinθ)) and its θ-derivative, (2, columns, t).

    potential, velocity : (m, columns) of the propagating mode at the nodes of the contour
    """
    waves = PlaneWaves(*(4 * contour.weights[:, None] * part.conj() for part in plane_waves(cls, contour, k, theta)))
    return np.array(
        [
            potential.T @ waves.flux - velocity.T @ waves.value,
            potential.T @ waves.turn_flux - velocity.T @ waves.turn_value,
        ]
    )
