"""Waves in a study of statics: their mean drift, and the largest motions of the free body.

Irregular waves: drift is 2∫SD dω, motions the largest expected in a duration (`mooring.response.sea_state`).

Regular wave: the SR179 report (1982), section 5.1.1, replaces irregular waves by a regular wave with the significant
height as its height and the mean period as its period.  It has twice their energy, all of it at one frequency: its
drift may be several times that of the sea, its motions a quarter of the largest or twice them.
"""

from __future__ import annotations

from contextlib import suppress
from typing import NamedTuple

import numpy as np

from bem.database.between_frequencies import BetweenError

from ..environment.sea import Sea
from ..environment.spectra import issc
from ..response.sea_state import sea_state
from ..response.viscous import in_regular_waves, in_sea

METHODS = ("irregular", "regular_wave")
ROUNDING = 1e-9


class WaveEffects(NamedTuple):
    """drift : (3,) N, N, N m; amplitudes : (6,) m, rad; slow : (3,) deviation of the slow drift, or None; warnings"""

    drift: np.ndarray
    amplitudes: np.ndarray
    slow: np.ndarray | None = None
    warnings: tuple[str, ...] = ()


def wave_effects(db, conditions):
    """{method: WaveEffects} of a database in the waves of `Conditions`: the method of the conditions, and the other one
    where the database has what it needs.

    Raises ValueError or BetweenError where the method of the conditions is not possible.
    """
    if conditions.method not in METHODS:
        raise ValueError(f"method of the waves is {conditions.method!r}; allowed: {', '.join(METHODS)}")
    makers = {"irregular": _irregular, "regular_wave": _regular}
    found = {conditions.method: makers.pop(conditions.method)(db, conditions)}
    ((other, make),) = makers.items()
    with suppress(ValueError):  # BetweenError among them
        found[other] = make(db, conditions)
    return found


def sea_of(conditions):
    """The `Sea` of Conditions, of the ISSC spectrum with long crests where they name none"""
    if conditions.sea is not None:
        return conditions.sea
    w = conditions.waves
    return Sea(issc(w.height, mean_period=w.period), w.direction)


def _irregular(db, conditions):
    sea = sea_of(conditions)
    if not db.reader.knows_drift:
        raise BetweenError("drift_force must be stored for waves; run its command again with --only drift,kochin,rao")
    try:
        body, _ = in_sea(db.reader, sea)
    except BetweenError as error:
        raise BetweenError(f'{error}, or say method = "regular_wave"') from None
    state = sea_state(body, sea, conditions.duration)
    return WaveEffects(
        _cleared(state.slow.drift), state.expected_maximum[:6], _cleared(state.slow.sigma), state.warnings
    )


def _regular(db, conditions):
    w, amplitude = conditions.waves, 0.5 * conditions.waves.height
    body = db.reader
    if body.viscous is not None and body.viscous.wave_amplitude != amplitude:
        body, _ = in_regular_waves(body, w.omega, amplitude, w.direction)
    drift = body.drift([w.omega], [w.direction])[0, 0] * amplitude**2
    X = np.abs(body.motions([w.omega], [w.direction])[0, 0])
    return WaveEffects(_cleared(drift), np.concatenate([_cleared(X[:3]), _cleared(X[3:])]) * amplitude)


def _cleared(values):
    """Values (n,) without what is rounding of what symmetry makes zero"""
    return np.where(np.abs(values) > ROUNDING * np.abs(values).max(), values, 0.0)
