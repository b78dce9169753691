"""`hakobune response --moored`: the body of a response study on the lines of a mooring study, its slow motion too."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import failing

from ..common.quantities import StudyError
from ..common.weather.gusts import gusts_of

COLUMNS = {
    "mean_offset": "mean",
    "natural_period_s": "T natural",
    "damping_percent": "damping %",
    "slow_deviation": "σ slow",
    "of_drift_percent": "of drift %",
    "wave_deviation": "σ waves",
    "flat_spectrum_estimate": "√(πS/2NC)",
    "beating_force_estimate": "x_s/2ν",
    "largest": "largest",
    "largest_by_rule": "by rule",
}


class Moored(NamedTuple):
    """motion : `mooring.studies.slow_motion.SlowMotion`; notes, failures : one line each, failures of lines and body by
    the simplified method; stiffness : (6, 6) N/m … of water and lines"""

    motion: object
    notes: tuple[str, ...]
    failures: tuple[str, ...]
    stiffness: np.ndarray

    def csv(self):
        """Comment lines of a CSV file"""
        return lines_of_csv(self.motion)

    def datasets(self):
        """{name: (value, unit)} for a results file"""
        return datasets(self.motion)

    def show(self, console):
        """Print the table"""
        show(self.motion, console)


def moored(path, read, db, sea, duration, points):
    """`Moored` of the mooring study at `path` and a ResponseStudy.  Raises ValueError, one line."""
    from hakobune.mooring.on_current.body import on_current
    from hakobune.mooring.on_current.waves import carrier_of
    from hakobune.mooring.response.viscous import in_sea
    from hakobune.mooring.studies.conditions import Waves
    from hakobune.mooring.studies.long_period import long_period
    from hakobune.mooring.studies.multi_point import multi_point
    from hakobune.mooring.studies.slow_motion import Loads, slow_motion
    from hakobune.mooring.studies.slow_spectrum import PLANE

    from ..moor.study import read_study
    from .study import viscous_laws, viscous_words

    study, _ = read_study(path)
    hull = study.without_berth("response --moored").hull_of(db.dimensions)
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    spectrum, given = sea.spectrum, study.conditions()
    waves = Waves(spectrum.significant_height, spectrum.T01, sea.direction)
    conditions = replace(given, waves=waves, sea=sea, method="irregular", duration=duration)
    statics = multi_point(db, system, hull, conditions, study.allowable)
    laws = viscous_laws(read, db)
    held = read.restrained(db.reader.floating().restrained(stiffness=statics.equilibrium.stiffness))
    if read.current is not None:
        raise StudyError(f"current is given with --moored; allowed: the current of {path} alone")
    carrier = carrier_of(given.current)
    (free, _), (held, damping) = (
        in_sea(on_current(db.reader, carrier), sea, laws), in_sea(db.reader, sea, laws, on_current(held, carrier))
    )  # fmt: skip
    gusts = gusts_of(study.wind)
    gust = None if gusts is None else (gusts, statics.loads["wind"][PLANE])
    alone = long_period(db, hull, statics, gusts)
    K = np.diag(statics.equilibrium.stiffness)[PLANE]
    water = np.where(np.isfinite(alone.period), alone.damping * K * alone.period / (2 * np.pi), 0.0)  # ν√(mK)
    loads = Loads(statics.displacement, gust, water)
    found = slow_motion(free, held, sea, duration, loads, points)
    notes = [
        f"moored by {len(system.lines)} lines of {path}: steady forces Fx {statics.steady_force[0] / 1e3:.4g}, "
        f"Fy {statics.steady_force[1] / 1e3:.4g} kN, Mz {statics.steady_force[5] / 1e3:.4g} kN m; "
        "slow drift by Newman's rule" + ("" if gust is None else f", gusts of {gusts.name}") + "; drag of the hull "
        "linearised, that of the lines left to body.damping_ratio"
    ]
    if given.waves is not None:
        notes.append(f"waves of {path} are left out: those of the response study are taken")
    if np.isfinite(db.water_depth):
        notes += _of_bound_waves(spectrum, db)
    told = (*notes, *viscous_words(held, laws, damping))
    return Moored(found, told, tuple(failing(statics.warnings)), held.stiffness)


def _of_bound_waves(spectrum, db):
    """The force of the bound long waves is not in Newman's rule; where kh at the peak is below 1 it may lead"""
    from hakobune.bem.waves import wavenumber

    kh = float(wavenumber(spectrum.peak_omega, db.water_depth, db.gravity)) * db.water_depth
    if kh < 1:
        yield f"kh is {kh:.2g} at the peak of the waves: bound long waves, left out, may move the body more than drift"


def table(motion):
    """Names, units and (3, columns) of `COLUMNS` of a SlowMotion, yaw in degrees"""
    factor = np.array([1.0, 1.0, 180 / np.pi])
    values = {
        "mean_offset": factor * motion.offset,
        "natural_period_s": motion.period,
        "damping_percent": 100 * motion.ratio,
        "slow_deviation": factor * motion.slow,
        "of_drift_percent": 100 * motion.drift_share,
        "wave_deviation": factor * motion.fast_sigma,
        "flat_spectrum_estimate": factor * motion.estimates[:, 0],
        "beating_force_estimate": factor * motion.estimates[:, 1],
        "largest": factor * motion.largest,
        "largest_by_rule": factor * motion.rule,
    }
    return ("surge", "sway", "yaw"), ("m", "m", "°"), np.stack([values[name] for name in COLUMNS], axis=1)


def lines_of_csv(motion):
    """Comment lines of a CSV file"""
    names, units, values = table(motion)
    yield "moored: " + ",".join(["motion", "unit", *COLUMNS])
    for name, unit, row in zip(names, units, values, strict=True):
        yield "moored: " + ",".join([name, unit, *(f"{value:.6g}" for value in row)])


def show(motion, console):
    """Print the table of a SlowMotion"""
    from rich.box import SIMPLE
    from rich.table import Table

    names, units, values = table(motion)
    shown = Table(title="moored, mean and slow motion", title_justify="left", box=SIMPLE, pad_edge=False)
    shown.add_column("", no_wrap=True)
    for short in COLUMNS.values():
        shown.add_column(short, justify="right", no_wrap=True)
    for name, unit, row in zip(names, units, values, strict=True):
        shown.add_row(f"{name}, {unit}", *(f"{value:.3g}" for value in row))
    console.print(shown)


def datasets(motion):
    """{name: (value, unit)} for the results file"""
    return {
        "moored/offset": (motion.offset, "m, m, rad"),
        "moored/natural_period": (motion.period, "s"),
        "moored/damping_ratio": (motion.ratio, "1"),
        "moored/omega": (motion.omega, "rad/s"),
        "moored/force_spectrum": (motion.force, "N2 s/rad; of moments N m"),
        "moored/motion_spectrum": (motion.spectrum, "m2 s/rad, m2 s/rad, rad2 s/rad"),
        "moored/slow_deviation": (motion.slow, "m, m, rad"),
        "moored/wave_deviation": (motion.fast_sigma, "m, m, rad"),
        "moored/largest": (motion.largest, "m, m, rad"),
        "moored/largest_by_rule": (motion.rule, "m, m, rad"),
    }
