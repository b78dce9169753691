"""Transmission, motions and tensions of a breakwater over frequency, by holding, theory and level of the water."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...breakwater.holdings import Response, exact_response, long_wave_response, response_with_loss
from ...breakwater.loss import Keel, with_loss
from .breakwater import THEORIES, BreakwaterError

TOLERANCE = 1e-5
OBLIQUE_TOLERANCE = 1e-4  # a sea over directions needs a thousand sections


class Curve(NamedTuple):
    """A `Response` over the study's periods"""

    holding: str
    theory: str
    response: Response

    @property
    def name(self):
        return self.holding if self.theory == THEORIES[0] else f"{self.holding}, {self.theory}"


def curves(breakwater, omega):
    """All curves of a study at mean level, and messages on omitted curves; omega : (n,) rad/s"""
    made, left_out = [], []
    for theory in breakwater.theories:
        for holding in breakwater.holdings:
            try:
                made.append(Curve(holding, theory, response(breakwater, holding, theory, 0.0, omega)))
            except BreakwaterError as error:
                if theory == THEORIES[0]:
                    raise
                left_out.append(f"{holding} by {theory} is left out: {error}")
    return made, left_out


def response(breakwater, holding, theory, rise, omega, amplitude=None, obliquity=None):
    """`Response` at frequencies (n,) rad/s.  Raises BreakwaterError for a holding that a theory does not support.

    amplitude : wave amplitude for the head loss, m; obliquity : angle with the normal, (n,) rad; by default both are
        those of the study's regular waves
    """
    obliquity = breakwater.waves.obliquity if obliquity is None else obliquity
    angle = breakwater.angle
    if holding == "fixed":
        angle = angle if angle is not None and angle < np.pi / 2 else None
    if theory == THEORIES[0]:
        made = _exact(breakwater, holding, rise, omega, angle, obliquity, amplitude)
        return _with_loss(breakwater, made, holding, rise, omega, amplitude)
    if holding not in ("fixed", "taut"):
        raise BreakwaterError(f"the theory of {theory} covers fixed and taut bodies only")
    if np.any(obliquity):
        raise BreakwaterError(f"the theory of {theory} covers waves along the normal only")
    half, draft = breakwater.equal_rectangle(rise)
    body = breakwater.taut_rectangle(rise) if holding == "taut" else None
    return long_wave_response(holding, half, draft, breakwater.depth(rise), omega, breakwater.fluid, angle, body)


def _exact(breakwater, holding, rise, omega, angle, obliquity, amplitude):
    body, wetted, stiffness = None, None, None
    if holding == "free":
        body, wetted = breakwater.afloat(rise)
    elif holding in ("taut", "elastic"):
        body, stiffness = breakwater.taut(rise), breakwater.lines.stretch
    wetted = wetted or breakwater.wetted(rise)
    if breakwater.loses_exactly:
        flows = [_keel(wetted.waterline, wetted.draft, breakwater.depth(rise), *breakwater.fluid.values(), float(one))
                 for one in np.atleast_1d(omega)]  # fmt: skip
        amplitude = breakwater.waves.height / 2 if amplitude is None else amplitude
        return response_with_loss(holding, flows, body, breakwater.loss, amplitude, angle, stiffness)
    return exact_response(holding, sections(breakwater, wetted, rise, omega, obliquity), body, angle, stiffness)


def _with_loss(breakwater, made, holding, rise, omega, amplitude):
    if breakwater.loss is None or breakwater.loses_exactly:
        return made
    wetted = breakwater.afloat(rise)[1] if holding == "free" else breakwater.mirrored(breakwater.wetted(rise))
    amplitude = breakwater.waves.height / 2 if amplitude is None else amplitude
    keel = Keel(wetted.waterline / 2, wetted.draft, breakwater.depth(rise), breakwater.water.gravity)
    return with_loss(made, breakwater.loss, amplitude, omega, keel)


def sections(breakwater, wetted, rise, omega, obliquity=0.0):
    """`Section` of the wetted part at frequencies (n,) rad/s; shape (n,); obliquity : (n,) rad.

    Raises BreakwaterError.
    """
    water = (breakwater.depth(rise), *breakwater.fluid.values())
    if breakwater.section.shape == "rectangle":
        waves = zip(*np.broadcast_arrays(np.atleast_1d(omega), np.abs(obliquity)), strict=True)
        return [_rectangle(wetted.waterline, wetted.draft, *water, float(w), float(b)) for w, b in waves]
    if np.any(obliquity):
        raise BreakwaterError(f"section.shape is {breakwater.section.shape!r}; waves at an angle need a rectangle")
    return [_outline(wetted, *water, float(one)) for one in np.atleast_1d(omega)]


@lru_cache(maxsize=16384)
def _rectangle(beam, draft, depth, density, gravity, omega, obliquity):
    from hakobune.bem.sections.coefficients import section

    water = {"density": density, "gravity": gravity}
    tolerance = OBLIQUE_TOLERANCE if obliquity else TOLERANCE
    return section(beam, draft, depth, omega, tolerance=tolerance, obliquity=obliquity, **water)


@lru_cache(maxsize=4096)
def _keel(beam, draft, depth, density, gravity, omega):
    from hakobune.bem.sections.keel_loss import keel_flow

    return keel_flow(beam, draft, depth, omega, density=density, gravity=gravity, tolerance=TOLERANCE)


@lru_cache(maxsize=4096)
def _outline(wetted, depth, density, gravity, omega):
    from hakobune.bem.sections.any_section import any_section

    return any_section(wetted, depth, omega, density=density, gravity=gravity, tolerance=TOLERANCE)
