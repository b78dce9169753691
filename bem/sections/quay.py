"""A section before a reflecting wall, from its results in open water: propagating waves only, no local waves.

A wave of unit amplitude travels towards the wall at y = P; c is the amplitude, referred to y = 0, of the wave returned
to the body.  With the transmission T and reflection R of the body, fixed or moving,

    c = T e^{2ikP} + R c e^{2ikP}      →      c = T e^{2ikP} / (1 − R e^{2ikP})

A floating section adds its radiated waves, with X its motions per unit amplitude:

    T = T₀ + Σ Xⱼ ηⱼ,    R = R₀ + Σ Xⱼ η′ⱼ;    without other losses  |T| = |sin(ε_z − ε_y)|,  |R| = |cos(ε_z − ε_y)|

ε_z and ε_y are the phases of heave and of the motions across (SR179 report (1982), eq. 3.7.3.8, with cos(ε_z − ε_H) for
its ε_z + ε_H).  The report, section 3.7.3, stops at c = T e^{2ikP}, and multiplies the motions by |1 + c| (π of
eq. 3.7.3.14, in which χ = δ_T − 2kP has δ_T = −arg T).  Both need a gap to the wall of more than a water depth or a
beam, so only waves cross the gap.  The panel method with a wall (`bem.methods.panel_problem.PanelProblem`) has no such
limit.
"""

from typing import NamedTuple

import numpy as np


class Floating(NamedTuple):
    """k : rad/m of the waves, towards +y; motions : (3,) complex sway, heave, roll per unit amplitude

    transmission, reflection : complex
    """

    k: float
    motions: np.ndarray
    transmission: complex
    reflection: complex


def floating(section, inertia, stiffness, damping=0.0):
    """`Floating` of a `bem.sections.coefficients.Section` that is free to move.

    inertia, stiffness, damping : (3, 3) per metre of length, of the body and its restraint, without contributions of
    waves
    """
    w = section.omega
    held = -(w**2) * (inertia + section.added_mass) - 1j * w * (section.damping + damping) + stiffness
    X = np.linalg.solve(held, section.excitation)
    transmitted, reflected = X @ section.radiated, X @ section.radiated_back
    waves = complex(section.transmission + transmitted), complex(section.reflection + reflected)
    return Floating(section.k, X, *waves)


def returned_wave(transmission, reflection, k, distance, repeated=True):
    """c of the module, complex.

    transmission, reflection : complex, referred to y = 0, of waves from either side; k : rad/m
    distance : m from the middle of the body to the wall
    repeated : False for the report's single reflection
    """
    turn = np.exp(2j * k * distance)
    return transmission * turn / (1 - reflection * turn if repeated else 1)


def force_before_wall(section, distance, repeated=True):
    """Complex forces of sway, heave and roll on a fixed `bem.sections.coefficients.Section`, waves running at the wall,
    N/m², N/m; shape (3,)."""
    c = returned_wave(section.transmission, section.reflection, section.k, distance, repeated)
    return section.excitation * (1 + c * np.array([-1, 1, -1]))


def motions_before_wall(body, distance, repeated=True):
    """Complex motions of a `Floating` body per unit amplitude, waves running at the wall; shape (3,)"""
    c = returned_wave(body.transmission, body.reflection, body.k, distance, repeated)
    return body.motions * (1 + c * np.array([-1, 1, -1]))


def magnification(body, distance):
    """|1 + T e^{2ikP}|, the report's factor on the motions of a `Floating` body or on a fixed section (eq. 3.7.3.14)"""
    return abs(1 + returned_wave(body.transmission, body.reflection, body.k, distance, repeated=False))
