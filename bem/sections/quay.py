"""A section before a reflecting wall, from what it does in open water: waves only, nothing that decays.

A wave of unit amplitude travels towards the wall at y = P; c is the amplitude, referred to y = 0, of the wave that
comes back from it onto the body.  With the transmission T and reflection R of the body, fixed or moving,

    c = T e^{2ikP} + R c e^{2ikP}      →      c = T e^{2ikP} / (1 − R e^{2ikP})

The SR179 report (1982), section 3.7.3, stops at c = T e^{2ikP}, and multiplies the motions by |1 + c| (π of
eq. 3.7.3.14, in which χ = δ_T − 2kP has δ_T = −arg T).  Both need a gap to the wall of more than a water depth or a
beam, so that only waves cross it.  The panel method with a wall (`bem.methods.panel_problem.PanelProblem`) has no such
limit.
"""

from __future__ import annotations

import numpy as np


def returned_wave(transmission, reflection, k, distance, repeated=True):
    """c of the module, complex.

    transmission, reflection : complex, referred to y = 0, of waves from either side; k : rad/m
    distance : m from the middle of the body to the wall
    repeated : False for the report's single reflection
    """
    turn = np.exp(2j * k * distance)
    return transmission * turn / (1 - reflection * turn if repeated else 1)


def force_before_wall(section, distance, repeated=True):
    """(3,) complex sway, heave, roll on a fixed `bem.sections.coefficients.Section`, waves running at the wall;
    N/m², N/m.
    """
    c = returned_wave(section.transmission, section.reflection, section.k, distance, repeated)
    return section.excitation * (1 + c * np.array([-1, 1, -1]))


def magnification(section, distance):
    """|1 + T e^{2ikP}|, the report's factor on heave (eq. 3.7.3.14)"""
    return abs(1 + returned_wave(section.transmission, section.reflection, section.k, distance, repeated=False))
