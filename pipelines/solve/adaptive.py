"""Few frequencies for a whole band, added where least is known until the estimated error is within tolerance.

Each frequency is stored as usual; the error between frequencies is estimated from the stored values
(`bem.database.between_frequencies`).  A resumed or repeated run therefore computes only the missing frequencies. The
places of frequencies do not depend on values (`bem.database.interpolant.chosen`): frequencies placed only where the
estimated error is largest could miss a resonance that no value has shown yet. The tolerance is relative to the
largest coefficient of a band, but the height of a resonance depends on damping that may be a thousandth of this
coefficient. Resonances (`bem.database.resonances`) are therefore solved too. For drift a resonance is also solved if
it amplifies the error ε of the radiated waves, by 1/2ζ, beyond the tolerance and no frequency lies within its width.
"""

from dataclasses import replace

import numpy as np

from hakobune.bem.database import open_database
from hakobune.bem.database.between_frequencies import FORCES, RADIATION, between
from hakobune.bem.database.interpolant import Abscissa, abscissa, chosen
from hakobune.bem.database.resonances import resonances
from hakobune.bem.kernels.threads import blas_threads
from hakobune.mooring.criteria.failing import fails

FIRST = 12  # frequencies before an error is estimated
MOST = 120  # frequencies in a band; more means that the solver's own error is above the tolerance
PLACES = 400  # equally spaced places in a band
# standard deviations: of 17 bodies, 14 of them random or held out, 16 end within a tolerance of half a per cent, one at
# 0.52 %; 1.35, which three boxes of the series calculations need, left 8 beyond it, the worst at 1.02 %
# (tests/bench/fit_interpolation.py)
WIDTH = 2.2
SHARP = 0.02  # damping ratio below which a resonance is always solved, however accurate its damping
NEAR = 2e-3  # relative distance of a resonance from a stored frequency: coefficients change less than their accuracy
CONTROLLED = (*RADIATION, FORCES[0])


def filled_band(scene, file, fill, wider, console):
    """The outcome of all frequencies of the band.

    file : open database; fill(file) solves its missing rows and returns its `pipelines.solve.run.Outcome`
    wider(file, omega=…) → the open file with more frequencies
    """
    outcome = fill(file)
    while outcome.exit_status == 0:
        db = open_database(file)
        with blas_threads(len(db.omega)):
            error, new = _missing(scene, db)
        if console:
            console.print(_text(scene, db, error), highlight=False, markup=False, soft_wrap=True)
        if not len(new):
            break
        file = wider(file, omega=new)
        after = fill(file)
        outcome = replace(after, solved=outcome.solved + after.solved, jobs=outcome.jobs + after.jobs)
    if outcome.exit_status:
        return outcome
    said = _text(scene, db, error)
    if error > scene.accuracy:
        said = fails(f"{said}; the tolerance is not reached; give a larger tolerance, or more panels")
    return replace(outcome, remarks=(*outcome.remarks, said))


def _missing(scene, db):
    """The estimated error of the band, and the frequencies (n,) rad/s to solve for next; none at the end"""
    known = between(db)
    places, error = _estimated(scene, known)
    if _inside(scene, db.omega) >= MOST:
        return error, np.zeros(0)
    return error, _unseen(scene, db, error) if error <= scene.accuracy else _next(scene, known, places, error)


def controlled(names):
    """Those `names` that the tolerance controls: coefficients and excitation, or any other quantity if these are
    missing.
    """
    smooth = ("Froude_Krylov_force", "diffraction_force", "drift_force_fixed", "kochin_radiation", "kochin_diffraction")
    return [name for name in CONTROLLED if name in names] or [name for name in smooth if name in names][:1]


def _estimated(scene, known):
    """Places (p,) rad/s over the band, and the largest error there; infinite with too few frequencies."""
    places = np.linspace(scene.waves.band.first, scene.waves.band.last, PLACES)
    names = controlled(known.quantities)
    if not names:
        return places, 0.0
    if _inside(scene, known.omega) < FIRST:
        return places, np.inf
    return places, WIDTH * float(known.largest_error(places, names).max())


def _next(scene, known, places, error):
    """The next frequencies: one, or more at a time while far from the tolerance."""
    missing = FIRST - _inside(scene, known.omega)
    far = error / scene.accuracy
    count = missing if missing > 0 else 3 if far > 10 else 1
    stored, open_ = (abscissa(w, known.depth, known.gravity, known.length) for w in (known.omega, places))
    return places[chosen(Abscissa(*stored), open_, count)]


def _unseen(scene, db, error):
    """The first resonance to be solved for, rad/s, none or one: sharp, unsure beyond the tolerance, or in drift so"""
    for one in resonances(db.bodies_reader) if "rao" in db.names else ():
        apart = np.abs(db.omega / one.omega - 1).min()
        drifts = "drift_force" in db.names and apart > one.damping / 2 and error > 2 * one.damping * scene.accuracy
        if apart > NEAR and (one.damping < SHARP or one.error > scene.accuracy * one.peak or drifts):
            return np.array([one.omega])
    return np.zeros(0)


def _inside(scene, omega):
    band = scene.waves.band
    return int(np.sum((omega >= band.first * (1 - 1e-9)) & (omega <= band.last * (1 + 1e-9))))


def _text(scene, db, error):
    band = scene.waves.band
    solved = f"{_inside(scene, db.omega)} frequencies from {band.first:g} to {band.last:g} rad/s"
    if not np.isfinite(error):
        return f"{solved}, too few to estimate the error between frequencies"
    words = "coefficients and forces" if FORCES[0] in controlled(db.names) else "coefficients"
    share, limit = 100 * error, 100 * scene.accuracy
    text = f"{solved}: estimated error of {words} between them {share:.2g} % (tolerance {limit:.2g} %)"
    less_sure = [word for word, name in (("motions", "rao"), ("drift", "drift_force")) if name in db.names]
    return text + f", and more for {' and '.join(less_sure)}" * bool(less_sure)
