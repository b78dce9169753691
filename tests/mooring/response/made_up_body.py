"""A Body with known coefficients, that a spline follows exactly or nearly."""

from dataclasses import replace

import numpy as np

from mooring.response.body import Body

INERTIA = np.diag([5e7, 5e7, 5e7, 1.2e10, 4.4e10, 5.3e10])
STIFFNESS = np.diag([0, 0, 5e7, 8e9, 4e10, 0])
OMEGA = np.array([0.3, 0.4, 0.5, 0.55, 0.65, 0.8, 1.0])
HEADINGS = np.radians([0.0, 30.0, 60.0, 90.0])


def coefficients(w):
    """Added mass, damping: straight in frequency"""
    return (0.5 + 0.2 * w) * INERTIA, (0.01 + 0.02 * w) * INERTIA


def force(w, beta):
    """Excitation of a body with two planes of symmetry: powers of cos and sin with the parity of each mode"""
    c, s = np.cos(beta), np.sin(beta)
    one = np.ones_like(beta)
    parts = np.stack([1j * c, 1j * s, one, 1j * s, 1j * c, c * s], axis=-1)
    return (1 + w) * np.array([1e6, 2e6, 5e6, 2e7, 3e7, 1e7]) * parts


def exact_motion(w, beta, damping=0.0):
    A, B = coefficients(w)
    dynamic = -(w**2) * (INERTIA + A) - 1j * w * (B + damping) + STIFFNESS
    return np.linalg.solve(dynamic, force(w, np.asarray(beta)))


def made_up_body(**changes):
    added, damping = map(np.array, zip(*(coefficients(w) for w in OMEGA), strict=True))
    body = Body(
        OMEGA, HEADINGS, added, damping, np.array([force(w, HEADINGS) for w in OMEGA]), INERTIA, STIFFNESS,
        np.zeros((6, 6)), 20.0, 1025.0, 9.80665, np.zeros(3), symmetry="xy", radius=50.0,
    )  # fmt: skip
    return replace(body, **changes)
