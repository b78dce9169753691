"""Few frequencies for a whole band: added where the estimated error is largest until it is within tolerance everywhere.

Each frequency goes to the database as usual; the error between them is estimated from what is stored
(`bem.database.between_frequencies`).  A run that is resumed, or repeated, therefore asks only for what is missing
to the tolerance.  The tolerance is relative to the largest coefficient of a band; the height of a resonance hangs on
damping that can be a thousandth of it.  Resonances (`bem.database.resonances`) are therefore solved for too.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bem.database import open_database
from bem.database.between_frequencies import FORCES, RADIATION, between
from bem.database.interpolant import Abscissa, abscissa, chosen
from bem.database.resonances import resonances

FIRST = 12  # frequencies before an error is estimated
MOST = 120  # frequencies in a band; more means that the solver's own error is above the tolerance
PLACES = 400  # in a band, equally far apart
# standard deviations: the largest error is 1.3 to 1.8 of them for boxes of the series calculations, 0.9 to 2.1 for
# boxes and buoys that were not among those (tests/bench/fit_interpolation.py)
WIDTH = 1.35
SHARP = 0.02  # damping ratio of a resonance that is solved for, however well its damping is known
NEAR = 2e-3  # relative, of a resonance and a stored frequency: coefficients change by no more than they are known to
CONTROLLED = (*RADIATION, FORCES[0])


def filled_band(scene, file, fill, wider, console):
    """The outcome of all frequencies of the band.

    file : open database; fill(file) solves what it lacks, returning its `pipelines.solve.run.Outcome`
    wider(file, omega=…) → the open file with more frequencies
    """
    outcome = fill(file)
    while outcome.exit_status == 0:
        db = open_database(file)
        places, error = _estimated(scene, db)
        if console:
            console.print(_told(scene, db, error), highlight=False, markup=False, soft_wrap=True)
        if _inside(scene, db.omega) >= MOST:
            break
        new = _unseen(scene, db) if error <= scene.accuracy else _next(scene, db, places, error)
        if not len(new):
            break
        file = wider(file, omega=new)
        after = fill(file)
        outcome = replace(after, solved=outcome.solved + after.solved, jobs=outcome.jobs + after.jobs)
    if outcome.exit_status:
        return outcome
    left = "" if error <= scene.accuracy else "; the tolerance is not reached: ask for less, or solve more accurately"
    return replace(outcome, remarks=(*outcome.remarks, _told(scene, db, error) + left))


def controlled(scene, db):
    """Names of quantities that the tolerance applies to: coefficients and excitation, or another without them."""
    names = [name for name in CONTROLLED if name in db.names]
    smooth = ("Froude_Krylov_force", "diffraction_force", "drift_force_fixed", "kochin_radiation", "kochin_diffraction")
    return names or [name for name in smooth if name in db.names][:1]


def _estimated(scene, db):
    """Places (p,) rad/s over the band, and the largest error there; infinite with too few frequencies."""
    places, names = np.linspace(scene.waves.band.first, scene.waves.band.last, PLACES), controlled(scene, db)
    if not names:
        return places, 0.0
    if _inside(scene, db.omega) < FIRST:
        return places, np.inf
    return places, WIDTH * float(between(db).largest_error(places, names).max())


def _next(scene, db, places, error):
    """The next frequencies: one, or more at a time while far from the tolerance."""
    missing = FIRST - _inside(scene, db.omega)
    far = error / scene.accuracy
    count = missing if missing > 0 else 3 if far > 10 else 1
    length = between(db).length
    known, open_ = (abscissa(w, db.water_depth, db.gravity, length) for w in (db.omega, places))
    return places[chosen(Abscissa(*known), open_, count)]


def _unseen(scene, db):
    """The first resonance to be solved for, rad/s, none or one: sharp, or less sure than the tolerance"""
    for one in resonances(db.reader) if "rao" in db.names else ():
        apart = np.abs(db.omega / one.omega - 1).min()
        if apart > NEAR and (one.damping < SHARP or one.error > scene.accuracy * one.peak):
            return np.array([one.omega])
    return np.zeros(0)


def _inside(scene, omega):
    band = scene.waves.band
    return int(np.sum((omega >= band.first * (1 - 1e-9)) & (omega <= band.last * (1 + 1e-9))))


def _told(scene, db, error):
    band = scene.waves.band
    solved = f"{_inside(scene, db.omega)} frequencies from {band.first:g} to {band.last:g} rad/s"
    if not np.isfinite(error):
        return f"{solved}: too few to estimate the error between them"
    words = "coefficients and forces" if FORCES[0] in controlled(scene, db) else "coefficients"
    share, limit = 100 * error, 100 * scene.accuracy
    told = f"{solved}: estimated error of {words} between them {share:.2g} % (tolerance {limit:.2g} %)"
    less_sure = [word for word, name in (("motions", "rao"), ("drift", "drift_force")) if name in db.names]
    return told + f", of {' and '.join(less_sure)} more" * bool(less_sure)
