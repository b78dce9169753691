"""A Reader of known coefficients, which are straight in frequency."""

from dataclasses import replace

import numpy as np

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader

INERTIA = np.diag([5e7, 5e7, 5e7, 1.2e10, 4.4e10, 5.3e10])
STIFFNESS = np.diag([0, 0, 5e7, 8e9, 4e10, 0])
OMEGA = np.linspace(0.3, 1.0, 29)
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


def made_up_body(headings=HEADINGS, symmetry="xy", radius=50.0, inertia=INERTIA, stiffness=STIFFNESS, **quantities):
    added, damping = map(np.array, zip(*(coefficients(w) for w in OMEGA), strict=True))
    stored = {
        "added_mass": added,
        "radiation_damping": damping,
        "excitation_force": np.array([force(w, headings) for w in OMEGA]),
    }
    plan = radius * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    between = Between(OMEGA, {**stored, **quantities}, 20.0, 9.80665, headings, np.zeros(1), plan)
    return Reader(between, 1025.0, np.zeros(3), inertia, stiffness, np.zeros((6, 6)), symmetry)


def thinned(body):
    """The same, known at every second frequency and at both ends"""
    b = body.between
    keep = np.unique(np.append(np.arange(0, len(b.omega), 2), len(b.omega) - 1))
    some = {name: values[keep] for name, values in b.quantities.items()}
    return replace(body, between=replace(b, omega=b.omega[keep], quantities=some))


def with_every_second_heading(body):
    """The same, known at every second heading"""
    b = body.between
    by_heading = ("excitation_force", "drift_force", "drift_force_fixed", "kochin_diffraction", "rao")
    some = {n: v[:, ::2] if n in by_heading else v for n, v in b.quantities.items()}
    return replace(body, between=replace(b, headings=b.headings[::2], quantities=some))
