"""The design spectrum method for a body held by fenders alone, at a quay or with dolphins on one side."""

from typing import NamedTuple

import numpy as np

from ..response.viscous import in_sea
from .design_spectrum import Dolphins, Strains, beam_of, limit_height, strains


class AtQuay(NamedTuple):
    """count : number of fenders that the loads press; strains : strains of one fender; limit : allowable significant
    height, m
    """

    count: int
    strains: Strains
    limit: float


def at_quay(body, fenders, across, conditions, family):
    """`AtQuay` of a body in the sea of its Conditions; None if the loads compress no fender.

    body : `bem.database.reader.Reader`, at a quay if there is one; fenders : sequence of `QuayFender`
    across : force of wind and current across the body, N; family : function of height, mean_period= → spectrum
    raises : DolphinError where the fenders cannot carry the steady load
    """
    sea = conditions.sea
    beam = beam_of(in_sea(body, sea)[0], conditions.waves.direction)
    drift = 2 * np.trapezoid(beam.drift * sea.spectrum.density(beam.omega), beam.omega)
    side = np.sign(across + drift) or 1.0
    met = [one for one in fenders if one.normal[1] * side > 0.5]
    if not met:
        return None
    beam, steady = beam._replace(drift=side * beam.drift), side * across
    dolphins = Dolphins(met[0].fender, np.array([one.face for one in met]))
    found = strains(beam, dolphins, steady, sea.spectrum)
    return AtQuay(len(met), found, limit_height(beam, dolphins, steady, family, conditions.waves.period))
