"""A body at a single point in time: gusts at the body, contact with the buoy, and the statistics of a run.

Significant values are the SR179 report's (1982, 3.6): steady + ⅔ of the largest amplitude.
"""

import warnings
from typing import NamedTuple

import numpy as np

from ..environment.gusts import MissingVariance, gust_record
from .equilibria import Equilibrium
from .history import Cycle, Record
from .scope import significant

GUSTS = 1e-3, 1.0, 400  # Hz, the report's band, and components
ALOFT = 104729  # added to the seed of the waves for the seed of the gusts
SLOW_DRIFT = 1.2  # factor of the report on line tensions, in place of slow drift
IN_TIME, WITH_FIFTH = (
    "in the run in time",
    "in the run in time, with 20 % for slow drift (SR179)",
)  # without and with it


class Run(NamedTuple):
    """record : slow motion and wave motion, or slow motion alone; steady : Equilibrium nearest to the start of the
    record

    cycle : Cycle of the last part of the record; settled : s, nan if the heading does not come to rest; radius : of
        the watch circle, m
    drifts : whether the run includes slow drift; findings : one line each
    full_waves : s, time from which the waves have their full height; inf if there are no waves
    """

    record: Record
    steady: Equilibrium
    cycle: Cycle
    settled: float
    radius: float
    drifts: bool = False
    findings: tuple[str, ...] = ()
    full_waves: float = np.inf


def gusty(point, duration, seed):
    """Function of time, s, that gives the gusty wind speed, m/s, over a duration, s; None for a steady wind"""
    wind = point.loads.wind
    if wind is None or wind.gusts is None:
        return None
    low, high, count = 2 * np.pi * GUSTS[0], 2 * np.pi * GUSTS[1], GUSTS[2]
    t = np.arange(0.0, duration + 2.0, 0.5)
    with warnings.catch_warnings():  # the report's band, beyond which no hull responds
        warnings.simplefilter("ignore", MissingVariance)
        record = wind.speed + gust_record(wind.gusts, t, seed + ALOFT, low, high, count)
    return lambda at: float(np.interp(at, t, record))


def of_contact(point, found, center):
    """Results of a Realisation with a contact buoy: position of the buoy (n, 2) m, pull on it (n, 1) N, line
    tensions (n, lines) N
    """
    heading, end = found.motion[:, 5], point.ends[0]
    cos, sin = np.cos(heading), np.sin(heading)
    at = found.motion[:, :2] + center + np.stack([cos * end[0] - sin * end[1], sin * end[0] + cos * end[1]], axis=1)
    pull = np.array([[np.hypot(*point.pull(place).force)] for place in at])
    return at, pull, found.tension


def ropes_of(run: Run):
    """{column: (k + n,) N} of hawsers and lines: steady, mean, significant, largest, and significant with a fifth
    added
    """
    steady = np.concatenate([run.steady.hawser, run.steady.lines.tension])
    record = np.concatenate([run.record.hawser, run.record.lines], axis=1)
    values = significant(record, steady)
    return {
        "steady": steady, "mean": record.mean(axis=0), "significant": values, "largest": record.max(axis=0),
        "significant_with_drift": SLOW_DRIFT * values,
    }  # fmt: skip


def _with_fifth(run, waves):
    return waves and not run.drifts


def largest_of(run: Run, waves):
    """Largest tensions of hawsers (k,) and lines (n,), N; as in the report a fifth is added if the `waves` have no
    slow drift
    """
    more = SLOW_DRIFT if _with_fifth(run, waves) else 1.0
    return more * run.record.hawser.max(axis=0), more * run.record.lines.max(axis=0)


def pulls(best, cycle=None, run=None, waves=False):
    """{where: (hawsers (k,), lines (n,)) N}, largest pulls at rest, in the limit cycle and in the run, if available

    best : Equilibrium; cycle : LimitCycle; run : Run; waves : whether waves act
    """
    found = {"at rest": (best.hawser, best.lines.tension)}
    if cycle is not None:
        found["in the limit cycle"] = cycle.hawser.max(axis=0), cycle.lines.max(axis=0)
    if run is not None:
        found[WITH_FIFTH if _with_fifth(run, waves) else IN_TIME] = largest_of(run, waves)
    return found


def used_in(pulled, best, hawser=None):
    """{where: (k + n,) tension over breaking load of hawsers and lines}, nan if unknown

    pulled : from `pulls`; best : Equilibrium; hawser : N, breaking load, nan if unknown, None without hawsers
    """
    count = 0 if hawser is None else len(best.hawser)
    breaking = np.array([*np.full(count, np.nan if hawser is None else hawser), *best.point.system.breaking_load])
    breaking[~np.isfinite(breaking)] = np.nan
    found = {where: np.array([*own[:count], *lines]) / breaking for where, (own, lines) in pulled.items()}
    at_rest = best.lines.lines.utilisation  # utilisation of the most loaded segment
    below_buoys = np.fmax(at_rest - found["at rest"][count:], 0.0)  # excess at a buoy over the pull at the body
    for used in found.values():
        used[count:] += np.nan_to_num(below_buoys)
    found["at rest"][count:] = at_rest
    return found
