"""Waves in a static study: their mean drift, and the largest motions of the free body.

Irregular waves: drift is 2∫SD dω, and motions are the largest expected in a duration (`mooring.response.sea_state`).

Regular wave: the SR179 report (1982), section 5.1.1, replaces irregular waves by a regular wave with the significant
height as its height and the mean period as its period.  Such a wave has twice the energy of the sea, all of it at one
frequency. The drift in this wave may be several times the drift in the sea, and the motions a quarter to twice the
largest motions in the sea.
"""

from contextlib import suppress
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.hinges import told_of

from ..environment.sea import Sea
from ..environment.spectra import issc
from ..on_current.body import on_current
from ..on_current.waves import carrier_of, check_blocked
from ..response.findings import current_along_waves
from ..response.sea_state import drift_on_current, sea_state
from ..response.viscous import in_regular_waves, in_sea
from ..response.wave_drift_damping import of_current

METHODS = ("irregular", "regular_wave")
ROUNDING = 1e-9
NO_DRIFT = (
    "left out: the drift of the waves, which the imported files do not contain; offsets and slow motion are too small; "
    "import files with drift (.8 or .9 of WAMIT), or solve the hull by hakobune"
)
FEW = (
    "left out: the change of wave forces as the body turns: the imported files have waves to {} alone, and the forces "
    "keep their direction in space, as those of a round body; for a body that is not round and turns by more than a "
    "few degrees, give headings at most 45° apart in the program of the files"
)
BESIDE = 1e-3  # relative frequency step for the slope of the drift of a regular wave


class WaveEffects(NamedTuple):
    """drift : (3,), N, N, N m; amplitudes : (n,), m and rad; slow : standard deviation of the slow drift, (3,), or
    None; warnings
    by_current : part of the drift due to a current that carries the waves, (3,); None in still water
    held : largest increase of the forces of each link by motions, (k, 6), N and N m; None without links.
    With several bodies drift is (3,) for each moving body, one after another, and slow is that of all bodies about
    the origin
    """

    drift: np.ndarray
    amplitudes: np.ndarray
    slow: np.ndarray | None = None
    warnings: tuple[str, ...] = ()
    by_current: np.ndarray | None = None
    held: np.ndarray | None = None


def wave_effects(db, conditions, body=None):
    """{method: WaveEffects} of a database in the waves of `Conditions`: by the chosen method, and by the other method
    if the database has the quantities for it.

    body : its `Reader`, by default as stored.  Imported files without drift have none, and warnings say so
    raises : ValueError or BetweenError where the method of the conditions is not possible
    """
    if conditions.method not in METHODS:
        raise ValueError(f"method of the waves is {conditions.method!r}; allowed: {', '.join(METHODS)}")
    makers = {"irregular": _irregular, "regular_wave": _regular}
    reader = db.bodies_reader if body is None else body
    lacking = lacks_drift(db, reader)
    found = {conditions.method: makers.pop(conditions.method)(reader, conditions, lacking)}
    ((other, make),) = makers.items()
    with suppress(ValueError):  # BetweenError among them
        found[other] = make(reader, conditions, lacking)
    return found


def lacks_drift(db, body):
    """Whether a database of one body was imported from files without drift, so that the drift cannot be computed"""
    return "imported" in getattr(db, "attributes", ()) and not (body.bodies or body.knows_drift)


def along_few(db, body, weather):
    """Whether the waves of a `motion.weather.Weather` travel along headings of imported files that do not cover the
    circle.

    Forces then keep these headings relative to a body that turns. Raises ValueError for waves in any other
    direction.
    """
    wave, ring = weather.waves, body.ring
    if wave is None or body.bodies or "imported" not in getattr(db, "attributes", ()) or _goes_round(ring):
        return False
    seas = weather.seas or (wave,)
    towards = [sea.direction for sea in seas] if weather.components is None else np.unique(weather.components.direction)
    off = np.flatnonzero(ring.stored(np.array(towards, float)) < 0)
    if not off.size and all(getattr(sea, "spreading", None) is None for sea in seas):
        return True
    wrong = f"waves travel to {np.rad2deg(towards[off[0]]) % 360:.4g}°" if off.size else "waves have a spreading"
    raise BetweenError(
        f"{wrong}, but the imported files have forces of waves towards {stored_degrees(ring)} only; give "
        "long-crested waves towards one of these (direction_deg), or import files with headings all round, at "
        "most 45° apart"
    )


def _goes_round(ring):
    return bool(ring.reached(np.deg2rad(np.arange(0.0, 360.0, 3.0))).all())


def stored_degrees(ring):
    """Headings of a `bem.database.between_headings.Ring`, as words"""
    return ", ".join(f"{np.rad2deg(heading):.4g}°" for heading in ring.headings)


def sea_of(conditions):
    """The `Sea` of Conditions; by default a long-crested ISSC spectrum"""
    if conditions.sea is not None:
        return conditions.sea
    w = conditions.waves
    return Sea(issc(w.height, mean_period=w.period), w.direction)


def _irregular(reader, conditions, lacking=False):
    sea = sea_of(conditions)
    if not (lacking or reader.knows_drift):
        raise BetweenError(
            "drift_force must be stored for waves; repeat the command that made the database, with --only "
            "drift,kochin,rao"
        )
    if reader.bodies and not reader.knows_drift_of_each:
        raise BetweenError(
            "body_drift_force must be stored for a study with waves; solve the scene of the bodies with --method panel"
        )
    try:
        body, _ = in_sea(on_current(reader, carrier_of(conditions.current)), sea)
    except BetweenError as error:
        raise BetweenError(f'{error}, or give method = "regular_wave"') from None
    state = sea_state(body, sea, conditions.duration)
    slow, amplitudes = state.slow, state.expected_maximum[: len(body.words)]
    if lacking:
        return WaveEffects(np.zeros(3), amplitudes, None, (NO_DRIFT, *state.warnings))
    drift = _of_moving(body, slow.of_each) if body.bodies else slow.drift
    return WaveEffects(
        _cleared(drift),
        amplitudes,
        _cleared(slow.sigma),
        state.warnings,
        slow.by_current,
        _held(body, state.names, state.expected_maximum),
    )


def _held(body, names, values):
    """Limits as in `WaveEffects.held`, from responses (c,) and their names; shape (k, 6)"""
    told = [values[names.index(name)] for name, unit, _ in told_of(body.links) if unit.startswith("N")]
    return np.array(told).reshape(-1, 6) if told else None


def _of_moving(body, of_each):
    """Drift of the moving bodies, one after another, three each, from the drift (bodies, 3) of several; None if
    unknown"""
    if of_each is None:
        raise BetweenError(
            'the drift of each of several bodies is known only for waves in still water; give waves = "still" '
            "under [current]"
        )
    return of_each[[i for i, one in enumerate(body.bodies) if not one.fixed]].ravel()


def _regular(reader, conditions, lacking=False):
    w, carrier, amplitude = conditions.waves, carrier_of(conditions.current), 0.5 * conditions.waves.height
    body = on_current(reader, carrier)
    if body.bodies and carrier is not None:
        _of_moving(body, None)
    if body.viscous is not None and body.viscous.wave_amplitude != amplitude:
        body, _ = in_regular_waves(body, w.omega, amplitude, w.direction)
    if body.bodies:
        drift = _of_moving(body, body.drift_of_each([w.omega], [w.direction])[0, 0]) * amplitude**2
    else:
        drift = np.zeros(3) if lacking else body.drift([w.omega], [w.direction])[0, 0] * amplitude**2
    motions = body.motions([w.omega], [w.direction])
    X = np.abs(motions[0, 0, : body.rigid]).reshape(-1, 2, 3).swapaxes(0, 1)
    held = amplitude * np.abs(body.link_forces([w.omega], [w.direction], motions)[0, 0]) if body.links else None
    amplitudes = np.stack([_cleared(X[0]), _cleared(X[1])], axis=1).ravel() * amplitude
    amplitudes = np.append(amplitudes, amplitude * np.abs(motions[0, 0, body.rigid :]))
    warnings = (NO_DRIFT,) * lacking
    if carrier is None:
        return WaveEffects(_cleared(drift), amplitudes, None, warnings, held=held)
    warnings += tuple(check_blocked(carrier, w, body.depth, body.gravity))
    if body.lacks_motions:
        warnings += (
            "motions on the current are taken from still water, since the database lacks the coefficients to compute "
            "them; repeat the command that made the database, with --only motions,radiation",
        )
    if lacking:
        return WaveEffects(_cleared(drift), amplitudes, None, warnings, held=held)
    near = np.clip(w.omega * (1 + BESIDE * np.array([-1.0, 0.0, 1.0])), *body.between.span)
    _, coefficients, known = drift_on_current(body, np.unique(near), [w.direction])
    place = int(np.searchsorted(np.unique(near), w.omega))
    added = of_current(body, coefficients)[place, 0] * amplitude**2
    warnings += tuple(current_along_waves(carrier, np.array([w.direction]), np.ones(1), known or None))
    return WaveEffects(_cleared(drift + added), amplitudes, None, warnings, added, held)


def _cleared(values):
    """Values (n,) without rounding errors of values that are zero by symmetry"""
    return np.where(np.abs(values) > ROUNDING * np.abs(values).max(), values, 0.0)
