"""Results stored next to the runs: the simplified method, slow motion by spectra, a berth and its fenders.

All these results are computed before the first run and stored with it.
"""

import json
from dataclasses import dataclass

import numpy as np

from hakobune.mooring.studies.long_period import long_period
from hakobune.mooring.studies.multi_point import multi_point
from hakobune.mooring.studies.natural_periods import periods_at_berth

from ..common.weather.gusts import gusts_of
from ..moor.quay import body_of
from .berth import by_design_spectrum, check_harbour

SLOW = ("Surge", "Sway", "Yaw")


@dataclass(frozen=True)
class Beside:
    """tension : (lines,) N and utilisation : (lines,) of the simplified method, empty without it
    period : (3,) s of surge, sway and yaw on the lines under the mean loads, nan where unknown
    slow : (3,) m, m, rad, σ of slow motion on springs as stiff as the lines under the mean loads, nan where unknown
    findings : a line each
    """

    tension: np.ndarray
    utilisation: np.ndarray
    period: np.ndarray
    slow: np.ndarray
    findings: tuple[str, ...] = ()

    def attributes(self):
        """For the file"""
        return {
            "simplified_tension": self.tension,
            "simplified_utilisation": self.utilisation,
            "moored_period": self.period,
            "spectral_slow": self.slow,
        }


def simplified(study, db):
    """`Beside` for a Study on an open database"""
    unknown, none = np.full(3, np.nan), np.zeros(0)
    alone = not (study.spreads or study.lines or study.at_berth)
    for there, words in (
        (study.at_berth, ""), (bool(study.hinges), "hinges"), (study.quay is not None, "quay"),
        (alone, "body without lines"),
    ):  # fmt: skip
        if there:  # nobody expects it at a berth
            said = f"the simplified method does not cover {words} and was not run"
            return Beside(none, none, unknown, unknown, (said,) if words else ())
    hull = study.hulls_of(db)
    system = study.system_of(db, hull)
    try:
        found = multi_point(db, system, hull, study.conditions(), study.allowable)
    except ValueError as error:
        reason = f"the simplified method does not work here: {' '.join(str(error).split())}"
        return Beside(none, none, unknown, unknown, (reason,))
    if db.bodies:
        return Beside(found.tension, found.utilisation, unknown, unknown)
    state = found.at_equilibrium
    period = dict(zip(state.names, state.period, strict=True))
    slow = _slow(study, db, hull, found)
    return Beside(found.tension, found.utilisation, np.array([period.get(name, np.nan) for name in SLOW]), slow)


def _slow(study, db, hull, found):
    if found.conditions.sea is None or found.conditions.method == "regular_wave":
        return np.full(3, np.nan)
    try:
        return np.asarray(long_period(db, hull, found, gusts_of(study.wind)).by_spectrum, float)
    except ValueError:  # database without drift, or a spectrum outside its frequencies
        return np.full(3, np.nan)


def of_berth(study, db, body):
    """Attributes of the file: natural periods at the berth, of the harbour, fenders, design spectrum method"""
    fenders = body.berth.fenders
    own = {
        "fender_height": [one.fender.height for one in fenders],
        "fender_allowable": [one.fender.own_allowable for one in fenders],
        "fender_rated_reaction": [one.fender.rated_reaction for one in fenders],
        "fender_strains": json.dumps([_strains(one.fender) for one in fenders]),
    }
    if db.bodies:
        return own
    return own | {
        "natural_period": periods_at_berth(body),
        "harbour_period": [] if study.harbour is None else check_harbour(study.harbour.periods),
        "design_spectrum": by_design_spectrum(study, db, body_of(study, db)[0], body.hull, fenders),
    }


def _strains(fender):
    """Knots of deflection and of the fender's own part of it, over its height: a dolphin behind it takes the rest"""
    return [np.asarray(knots, float).tolist() for knots in getattr(fender, "strains", ((0.0, 1.0), (0.0, 1.0)))]


def differ(study):
    """Whether runs differ between seeds: by irregular waves or gusts"""
    conditions, gusts = study.conditions(), study.wind is not None and study.wind.gusts is not None
    return gusts or (conditions.sea is not None and conditions.method != "regular_wave")
