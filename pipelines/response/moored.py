"""`hakobune response --moored`: the body of a response study on the lines of a mooring study, with its slow motion.

For several bodies, lines, ropes, fenders and hinges act by their linear stiffness at the place where they balance the
steady forces.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import failing

from ..common.quantities import StudyError
from ..common.weather.gusts import gusts_of

if TYPE_CHECKING:
    from hakobune.bem.database.reader import Reader
    from hakobune.mooring.studies.slow_motion import SlowMotion


class Moored(NamedTuple):
    """motion : `mooring.studies.slow_motion.SlowMotion`; notes, failures : one line each, failures of lines and body by
    the simplified method; stiffness : (6, 6) N/m … of water and lines; body : `Reader` of several bodies on their
    moorings, None for one
    """

    motion: SlowMotion
    notes: tuple[str, ...]
    failures: tuple[str, ...]
    stiffness: np.ndarray
    body: Reader | None = None


def moored(path, read, db, sea, duration, points):
    """`Moored` of the mooring study at `path` and a ResponseStudy.  Raises ValueError, with a message of one line."""
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

    if read.current is not None:
        raise StudyError(f"current is given with --moored; leave it out: {path} gives the current")
    study, _ = read_study(path)
    hull = study.without_berth("response --moored").hull_of(db.sizes)
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    spectrum, given, gusts = sea.spectrum, study.conditions(), gusts_of(study.wind)
    waves = Waves(spectrum.significant_height, spectrum.T01, sea.direction)
    conditions = replace(given, waves=waves, sea=sea, method="irregular", duration=duration)
    laws = viscous_laws(read, db)
    statics = multi_point(db, system, hull, conditions, study.allowable)
    held = read.restrained(db.reader.floating().restrained(stiffness=statics.equilibrium.stiffness))
    carrier = carrier_of(given.current)
    (free, _), (held, damping) = (
        in_sea(on_current(db.reader, carrier), sea, laws), in_sea(db.reader, sea, laws, on_current(held, carrier))
    )  # fmt: skip
    gust = None if gusts is None else (gusts, statics.loads["wind"][PLANE])
    alone = long_period(db, hull, statics, gusts)
    K = np.diag(statics.equilibrium.stiffness)[PLANE]
    water = np.where(np.isfinite(alone.period), alone.damping * K * alone.period / (2 * np.pi), 0.0)  # ν√(mK)
    loads = Loads(statics.displacement, gust, water)
    found = slow_motion(free, held, sea, duration, loads, points)
    notes = [
        f"moored by {len(system.lines)} lines of {path}: steady forces Fx {statics.steady_force[0] / 1e3:.4g}, "
        f"Fy {statics.steady_force[1] / 1e3:.4g} kN, Mz {statics.steady_force[5] / 1e3:.4g} kN m; "
        "slow drift by Newman's rule"
        + ("" if gust is None else f", gusts of {gusts.name}")
        + "; the drag of the hull is linearised; give the drag of the lines by body.damping_ratio"
    ]
    if given.waves is not None:
        notes.append(f"the waves of {path} are not used; the waves are those of the response study")
    notes += _of_bound_waves(spectrum, db)
    told = (*notes, *viscous_words(held, laws, damping))
    return Moored(found, told, tuple(failing(statics.warnings)), held.stiffness)


def moored_together(path, read, db, sea, duration, points):
    """`Moored` of several bodies; slow motions of the bodies follow one another"""
    from hakobune.bem.hinges import driven
    from hakobune.mooring.response.viscous import in_sea
    from hakobune.mooring.studies.conditions import Waves
    from hakobune.mooring.studies.long_period import drag_of_each
    from hakobune.mooring.studies.multi_point import multi_point
    from hakobune.mooring.studies.slow_motion import Loads, slow_motion
    from hakobune.mooring.studies.slow_spectrum import PLANE

    from ..common.quay_tables import linked
    from ..moor.study import read_study
    from .study import viscous_laws, viscous_words

    for name, given in (("current is", read.current is not None), ("hinges are", bool(read.hinges))):
        if given:
            raise StudyError(f"{name} given with --moored; leave the key out: {path} gives it")
    study, _ = read_study(path)
    hulls = study.hulls_of(db)
    system, berth = study.system_of(db, hulls), study.berth_of(db, hulls)
    if system is None:
        raise StudyError(f"{path} has no lines; give at least one [[spreads]] or [[lines]], or use hakobune simulate")
    waves = Waves(sea.spectrum.significant_height, sea.spectrum.T01, sea.direction)
    conditions = replace(study.conditions(), waves=waves, sea=sea, method="irregular", duration=duration)
    db.require_rigid()
    reader, laws = db.bodies_reader, viscous_laws(read, db)
    alone = linked(reader.floating(), study.hinges, db)
    statics = multi_point(db, system, hulls, conditions, study.allowable, berth, alone)
    held = read.restrained(alone.restrained(driven(alone).damping - alone.damping, statics.stiffness))
    (free, _), (held, damping) = (in_sea(reader, sea, laws, one) for one in (driven(alone), held))
    turns, gusts = [one.axes[:2, :2] for one in statics.hulls], gusts_of(study.wind)
    offset = _along(turns, statics.displacement.reshape(-1, 3)).ravel()
    wind = None if gusts is None else _along(turns, statics.loads["wind"].reshape(-1, 6)[:, PLANE]).ravel()
    gust = None if gusts is None else (gusts, wind)
    loads = Loads(offset, gust, drag=drag_of_each(conditions, statics.hulls, system.depth))
    found = slow_motion(free, held, sea, duration, loads, points)
    notes = [*_of_stiffness(path, statics, gusts), *_of_bound_waves(sea.spectrum, db)]
    told = (*notes, *viscous_words(held, laws, damping))
    return Moored(found, told, tuple(failing(statics.warnings)), held.stiffness, held)


def _along(turns, rows):
    """Rows (N, 3) of x, y and yaw in space, along the axes of bodies, columns of `turns`"""
    return np.array([[*(row[:2] @ turn), row[2]] for turn, row in zip(turns, rows, strict=True)])


def _of_stiffness(path, statics, gusts):
    """Notes on what holds several bodies in a `MultiPoint` of the study at `path`, and moves them slowly"""
    held = [f"{len(statics.system.lines)} lines", *(f"hinge {name}" for name in statics.hinges)]
    for word, parts in (("fender", statics.berth.fenders), ("rope", statics.berth.ropes)):
        held += [f"{len(parts)} {word}{'s' * (len(parts) > 1)}"] * bool(parts)
    yield (
        f"moored by {', '.join(held)} of {path}, with the stiffness that they have under the steady forces of wind, "
        "current and waves; slow drift of each body by Newman's rule"
        + ("" if gusts is None else f", gusts of {gusts.name}")
    )
    if statics.berth.names:
        idle = [name for name, force in zip(statics.berth.names, statics.contact[1, 1], strict=True) if force == 0]
        yield (
            "fenders and ropes are linear here; where motions exceed their deflection at rest they lose contact or go "
            "slack, which hakobune simulate includes"
        )
        if idle:
            yield (f"fenders and ropes without force under the steady forces have no stiffness here: {', '.join(idle)}")


def _of_bound_waves(spectrum, db):
    """Newman's approximation lacks the force of bound long waves; if kh at the peak is below 1 it may dominate"""
    from hakobune.bem.waves import wavenumber

    if not np.isfinite(db.water_depth):
        return
    kh = float(wavenumber(spectrum.peak_omega, db.water_depth, db.gravity)) * db.water_depth
    if kh < 1:
        yield (
            f"kh is {kh:.2g} at the spectral peak: bound long waves, which are not included, may move the body more "
            "than slow drift"
        )
