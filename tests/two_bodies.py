"""Readers of two bodies of known coefficients, that see each other or not, and a third that is fixed."""

import numpy as np
from made_up_body import HEADINGS, INERTIA, OMEGA, STIFFNESS, coefficients, force

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.bem.modes import Body
from hakobune.bem.waves import wavenumber

DEPTH, G = 20.0, 9.80665
ASTERN = np.diag([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])  # of a body that heads the other way
BODIES = (
    Body("ship", (0.0, 30.0, 1.0), 0.0, False, (0.0, 30.0)),
    Body("pier", (0.0, 0.0, 0.0), 0.0, True, (0.0, 0.0)),
    Body("barge", (12.0, -30.0, 1.0), np.pi, False, (10.0, -30.0)),  # its rotation centre 2 m astern of its origin
)


def twice(matrix):
    """(12, 12) of two bodies apart"""
    return np.kron(np.eye(2), matrix)


def forces(w, headings):
    """(m, 12): each with the phase of the wave at its place, about which its axes turn"""
    k = float(wavenumber(w, DEPTH, G))
    ship = force(w, headings) * np.exp(1j * k * 30 * np.sin(headings))[:, None]
    turned = force(w, headings) @ ASTERN
    barge = turned * np.exp(1j * k * (10 * np.cos(headings) - 30 * np.sin(headings)))[:, None]
    return np.concatenate([ship, barge], axis=-1)


def two_bodies(headings=HEADINGS, **quantities):
    """Reader; quantities : stored ones beside added mass, damping and excitation"""
    added, damping = (
        np.array([twice(part) for part in parts]) for parts in zip(*map(coefficients, OMEGA), strict=True)
    )
    stored = {"added_mass": added, "radiation_damping": damping,
              "excitation_force": np.array([forces(w, headings) for w in OMEGA])}  # fmt: skip
    plans = [np.array([[50.0, y], [0.0, y + 10], [-50.0, y], [0.0, y - 10]]) for y in (30.0, -30.0)]
    water = DEPTH, G, headings, np.zeros(1), np.concatenate(plans)
    between = Between(OMEGA, {**stored, **quantities}, *water, outlines=tuple(plans))
    return Reader(
        between, 1025.0, np.zeros(3), twice(INERTIA), twice(STIFFNESS), np.zeros((12, 12)), bodies=BODIES
    )  # fmt: skip


def coupled_bodies(headings):
    """Reader of the same whose motions are coupled by the water"""
    other = np.diag([0.1, -0.05, 0.2, 0.05, 0.1, 0.1]) * INERTIA
    added = np.array([np.kron(np.eye(2), (0.5 + 0.2 * w) * INERTIA) for w in OMEGA])
    added[:, :6, 6:] = added[:, 6:, :6] = other
    damping = np.array([np.kron([[1, 0.2], [0.2, 1]], (0.01 + 0.02 * w) * INERTIA) for w in OMEGA])
    return two_bodies(headings, added_mass=added, radiation_damping=damping)
