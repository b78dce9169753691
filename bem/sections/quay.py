"""A section in front of a reflecting wall, computed from its results in open water, with propagating waves only.

A wave of unit amplitude travels towards the wall at y = P; c is the amplitude, referred to y = 0, of the wave that
returns to the body.  If T and R are transmission and reflection of the fixed or moving body,

    c = T e^{2ikP} + R c e^{2ikP}      →      c = T e^{2ikP} / (1 − R e^{2ikP})

A floating section also radiates waves. With motions X per unit amplitude

    T = T₀ + Σ Xⱼ ηⱼ,    R = R₀ + Σ Xⱼ η′ⱼ;    without other losses  |T| = |sin(ε_z − ε_y)|,  |R| = |cos(ε_z − ε_y)|

ε_z and ε_y are the phases of heave and of the motions across (SR179 report (1982), eq. 3.7.3.8, in which ε_z + ε_H is
replaced by cos(ε_z − ε_H)).
The report, section 3.7.3, uses only c = T e^{2ikP}, and multiplies the motions by |1 + c| (π of eq.
3.7.3.14, in which χ = δ_T − 2kP has δ_T = −arg T).  The equations here and in the report need a gap to the wall of
more than a water depth or a beam, so that only propagating waves cross the gap.
The panel method with a wall (`bem.methods.panel_problem.PanelProblem`) has no such
limit.
"""

from typing import NamedTuple

import numpy as np


class Floating(NamedTuple):
    """k : wavenumber of the waves, which travel towards +y, rad/m; motions : sway, heave, roll per unit amplitude,
    complex,
        (3,)

    transmission, reflection : complex
    """

    k: float
    motions: np.ndarray
    transmission: complex
    reflection: complex


def floating(section, inertia, stiffness, damping=0.0):
    """`Floating` of a `bem.sections.coefficients.Section` that is free to move.

    inertia, stiffness, damping : matrices of the body and its restraint per metre of length, without contributions
    of waves, (3, 3)
    """
    w = section.omega
    held = -(w**2) * (inertia + section.added_mass) - 1j * w * (section.damping + damping) + stiffness
    X = np.linalg.solve(held, section.excitation)
    transmitted, reflected = X @ section.radiated, X @ section.radiated_back
    waves = complex(section.transmission + transmitted), complex(section.reflection + reflected)
    return Floating(section.k, X, *waves)


def returned_wave(transmission, reflection, k, distance, repeated=True):
    """Amplitude c of the wave that returns from the wall, complex.

    transmission, reflection : coefficients for waves from either side, complex, referred to y = 0; k : rad/m
    distance : distance from the middle of the body to the wall, m
    repeated : whether all reflections are included; if False, only the first, as in the report
    """
    turn = np.exp(2j * k * distance)
    return transmission * turn / (1 - reflection * turn if repeated else 1)


def force_before_wall(section, distance, repeated=True):
    """Complex forces in sway, heave and roll, N/m², N/m, on a fixed `bem.sections.coefficients.Section` in waves that
    travel to the wall; shape (3,)."""
    c = returned_wave(section.transmission, section.reflection, section.k, distance, repeated)
    return section.excitation * (1 + c * np.array([-1, 1, -1]))


def motions_before_wall(body, distance, repeated=True):
    """Complex motions per unit amplitude of a `Floating` body in waves that travel to the wall; shape (3,)"""
    c = returned_wave(body.transmission, body.reflection, body.k, distance, repeated)
    return body.motions * (1 + c * np.array([-1, 1, -1]))


def magnification(body, distance):
    """|1 + T e^{2ikP}|, the factor of the report (eq. 3.7.3.14) for motions of a `Floating` body or forces on a fixed
    section"""
    return abs(1 + returned_wave(body.transmission, body.reflection, body.k, distance, repeated=False))
