"""A single-point study in time, by its scheme (`mooring.single_point.runs`).

Waves need a database, a period and a scheme other than "slow"; gusts are those of [wind].
"""

import math

import numpy as np

from hakobune.mooring.lines.ropes import RopePart
from hakobune.mooring.motion.buoy import BuoyBody
from hakobune.mooring.response.viscous import in_sea
from hakobune.mooring.single_point.history import moves_in_waves
from hakobune.mooring.single_point.in_time import Run
from hakobune.mooring.single_point.one_equation import body_at
from hakobune.mooring.single_point.runs import Times, full_run, sea_components, slow_run, two_scale_run
from hakobune.mooring.single_point.two_scale import wave_body

from ..common.quantities import StudyError, force, positive
from ..common.weather.seas import sea_with_swell
from ..results.heard import heard
from .loads import waves_carrier
from .study import mass_of

SCHEMES = ("slow", "two_scale", "full")
MOST_SAMPLES = 1_000_000


def check(study, db=None):
    """Raises StudyError for a Study that cannot run in time; called before the computation"""
    s = study.slewing
    _check(s)
    if s.scheme == "two_scale" and not _with_waves(study, db):
        raise StudyError('slewing.scheme is "two_scale", which needs [waves] and --database; give both, or "slow"')
    if s.scheme == "full" and study.hawser is not None:
        _buoy_and_rope(study)


def run(study, steady, db=None) -> Run:
    """Run of a Study from near one of its equilibria.  Raises StudyError or SinglePointError."""
    check(study, db)
    s, waves = study.slewing, _with_waves(study, db)
    times = Times(s.duration, s.step, s.slow_step, s.waves_after, np.radians(s.offset_deg), s.tolerance, s.seed)
    if s.scheme == "full":
        return _in_one(study, times, steady, db, waves)
    return two_scale_run(steady, times, _wave_body(study, db)) if waves else slow_run(steady, times)


def _with_waves(study, db):
    return study.waves is not None and db is not None and study.slewing.scheme != "slow"


def _wave_body(study, db):
    lever = study.attachment.z - float(db.rotation_center[2])
    body, _ = in_sea(db.reader, _sea(study, db))
    return wave_body(body, _components(study, db), lever, waves_carrier(study))


def _in_one(study, times, steady, db, waves):
    body, rope = (None, None) if steady.point.lengths[0] == 0.0 else _buoy_and_rope(study, steady.point)
    with heard() as said:
        sea = _sea(study, db) if waves else None
        moved = body_at(
            steady, times.begin(steady), db, buoy=body, rope=rope, end_z=study.attachment.z, sea=sea
        )  # fmt: skip
    drift = waves and study.waves.drift_tonf_per_m2 is None
    found = full_run(
        steady, times, moved, _components(study, db) if waves else None, bool(drift), waves_carrier(study)
    )  # fmt: skip
    left = ()
    if study.waves is not None and not waves:
        left = ("waves act by their mean drift only; give --database for first-order motions",)
    return found._replace(findings=tuple(dict.fromkeys((*said, *left, *found.findings))))


def _buoy_and_rope(study, point=None):
    """BuoyBody and RopePart of a study; point : SinglePoint, for a mass by the draft.  Raises StudyError."""
    b, h = study.buoy, study.hawser
    if b.mass is None and b.draft is None:
        raise StudyError('slewing.scheme is "full"; with a hawser it needs mass, diameter and height of [buoy]')
    lever = 0.0 if b.hawser_z is None else b.hawser_z - b.z
    if b.hawser_z is not None and not b.z <= b.hawser_z <= b.height:
        allowed = f"at least buoy.z, {b.z:g} m, at most buoy.height, {b.height:g} m"
        raise StudyError(f"buoy.hawser_z is {b.hawser_z:g} m; allowed: {allowed}")
    body = BuoyBody(math.nan if point is None else mass_of(b, point.system), b.diameter, b.height, lever=lever)
    stiff, load = force("hawser", h, "axial_stiffness"), force("hawser", h, "breaking_load")
    if (stiff is None) == (load is None) or (load is not None) != (h.strain is not None):
        raise StudyError('hawser: slewing.scheme "full" needs axial_stiffness, or breaking_load with its strain')
    if stiff is not None:
        return body, RopePart(stiff, 1.0)
    return body, RopePart(load, positive("hawser.strain", h.strain), positive("hawser.exponent", h.exponent))


def words(run: Run):
    """Lines on a run"""
    c = run.cycle
    first = np.degrees(run.record.heading[0] - run.steady.heading)
    if c.stays and run.steady.slewing.stable and (run.drifts or np.ptp(run.record.wind_speed) > 0):
        yield (
            f"the heading swings ±{np.degrees(c.amplitude):.1f}° at about {c.period:.0f} s at the end: gusts and slow "
            "drift drive this motion; without them the heading is stable"
        )
    elif c.stays:
        yield (
            f"the {'body slews' if run.steady.slews else 'heading swings'}: ±{np.degrees(c.amplitude):.1f}° at a "
            f"period of {c.period:.0f} s at the end of the run" + (", still growing" if c.growing > 1.02 else "")
        )
    elif np.isfinite(run.settled):
        yield f"the heading decays from {first:.2g}° to within 0.2° of rest in {run.settled:.0f} s"
    else:
        yield f"the heading is still {np.degrees(c.amplitude):.2g}° about its mean at the end of the run"
    if not run.drifts and moves_in_waves(run):
        yield "the run does not include slow drift; the SR179 report adds 20 % for it"
    slack = np.mean(run.record.hawser == 0.0, axis=0)
    if run.steady.point.lengths[0] and np.any(slack > 0):
        shares = ", ".join(f"hawser {i} for {100 * share:.2g} %" for i, share in enumerate(slack, 1) if share > 0)
        yield f"the hawser falls slack and comes taut again: {shares} of the run"
    yield from run.findings


def _check(s):
    for key in ("duration", "slow_step", "tolerance"):
        positive(f"slewing.{key}", getattr(s, key))
    if s.step is not None:
        positive("slewing.step", s.step)
    if s.scheme is not None and s.scheme not in SCHEMES:
        raise StudyError(f"slewing.scheme is {s.scheme!r}; allowed: {', '.join(SCHEMES)}")
    if not 0 <= s.waves_after <= s.duration:
        raise StudyError(f"slewing.waves_after is {s.waves_after:g} s; allowed: 0 to the duration of {s.duration:g} s")
    if not abs(s.offset_deg) <= 180:
        raise StudyError(f"slewing.offset_deg is {s.offset_deg:g}; allowed: −180 to 180")
    if s.duration / (0.2 if s.step is None else s.step) > MOST_SAMPLES:
        raise StudyError(f"slewing has more than {MOST_SAMPLES} samples; give a longer step")
    if not (s.components >= 1 and s.seed >= 0):
        raise StudyError("slewing: components must be at least 1, and the seed a whole number from 0")


def _sea(study, db):
    return sea_with_swell("waves", study.waves, db.water_depth)


def _components(study, db):
    s = study.slewing
    try:
        return sea_components(_sea(study, db), s.components, s.seed, db.reader, waves_carrier(study))
    except ValueError as error:
        raise StudyError(str(error)) from None
