"""Natural periods of a breakwater that floats freely or on elastic lines, by potential theory, and wave periods
around them.

    Re{C − ω²(M + A(ω))} = 0 for heave; the determinant of the 2 × 2 matrix for sway and roll

C is the stiffness of water and lines about the centre of gravity.
"""

from typing import NamedTuple

import numpy as np

from ...breakwater.elastic import stiffness_of
from ...breakwater.exact import HEAVE, ROLL, SWAY, about_gravity, moved_to_origin
from .breakwater import THEORIES
from .curves import response, sections

BEYOND = 0.7, 1.5  # lowest and highest frequency over those of the study's periods; a sea reaches as far
PLACES = 40  # frequencies between which a root is sought
AROUND = np.array(
    [0.0025, 0.005, 0.01, 0.015, 0.02, 0.03, 0.05, 0.08, 0.11, 0.15]
)  # relative distances of periods that show one


class Natural(NamedTuple):
    """holding, motion : names; period : s; transmission : K_T at this period; front : tension of the front line per
    wave amplitude, N/m², nan without lines
    """

    holding: str
    motion: str
    period: float
    transmission: float
    front: float


def natural(breakwater):
    """[Natural] within and a little beyond the study's periods, of its holdings that float by potential theory"""
    period, found = breakwater.waves.period, []
    if len(period) < 2 or THEORIES[0] not in breakwater.theories:
        return found
    ends = 2 * np.pi / period[[-1, 0]] * BEYOND
    for holding in breakwater.holdings:
        if holding in ("free", "elastic"):
            for motion, omega in _roots(*_dynamic(breakwater, holding), np.linspace(*ends, PLACES), holding):
                there = response(breakwater, holding, THEORIES[0], 0.0, np.array([omega]))
                front = float(abs(there.front[0]))
                found.append(Natural(holding, motion, 2 * np.pi / omega, float(abs(there.transmission[0])), front))
    return found


def around(period, found):
    """Periods (n,) s, with further periods inserted around those of Natural, within their range, for smooth curves"""
    more = [one.period * (1 + side * AROUND) for one in found for side in (-1, 1)]
    whole = np.unique(np.concatenate([period, [one.period for one in found], *more]))
    return whole[(whole >= period[0]) & (whole <= period[-1])]


def _dynamic(breakwater, holding):
    """Functions of ω: Re{C − ω²(M + A)} of heave, and its determinant of sway and roll"""
    if holding == "free":
        body, wetted = breakwater.afloat(0.0)
        stiffness = np.diag([0.0, body.heave_stiffness, body.roll_stiffness])
    else:
        body, wetted = breakwater.taut(0.0), breakwater.wetted(0.0)
        stiffness = stiffness_of(body, breakwater.lines.stretch)[0]
    mass, to_origin = np.diag([body.mass, body.mass, body.inertia]), moved_to_origin(body.z0)

    def matrix(omega):
        (section,) = sections(breakwater, wetted, 0.0, omega, breakwater.waves.obliquity)
        return stiffness - omega**2 * mass + about_gravity(section, to_origin)[0].real

    def heave(omega):
        return matrix(omega)[HEAVE, HEAVE]

    def swing(omega):
        return np.linalg.det(matrix(omega)[np.ix_((SWAY, ROLL), (SWAY, ROLL))])

    return heave, swing


def _roots(heave, swing, omega, holding):
    from scipy.optimize import brentq

    for motion, function in (("heave", heave), ("roll" if holding == "free" else "sway and roll", swing)):
        values = np.array([function(one) for one in omega])
        for i in np.flatnonzero(values[:-1] * values[1:] < 0):
            yield motion, brentq(function, omega[i], omega[i + 1], rtol=1e-6)
