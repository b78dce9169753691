"""Conversion of a study of a moving line to values of `mooring.lines.dynamics.simulation`: line, bed, bodies, current
and wave.
"""

import math

import numpy as np

from hakobune.mooring.lines.dynamics.strength import Strength

from ..common.line_tables import attached, check_bed, line_type, of_types
from ..common.quantities import StudyError, direction, positive, speed, water_density
from ..common.units import TONF
from ..common.weather.seas import mean_period
from .study import BedTable

ELEMENTS = 40  # elements of a line without given numbers; at least 4 per segment
LEVELS = 41  # heights at which a current over the depth is sampled
FEWEST, MOST = 10, 1000  # components of a sea


def line_of(study):
    """DynamicLine, and the Strength of its segments.  Raises ValueError."""
    from hakobune.mooring.lines.dynamics.simulation import DynamicLine

    water_density("water.density", study.water.density)
    kinds = {name: _properties(f"types.{name}", kind, study.water) for name, kind in study.types.items()}
    total = sum(positive(f"segments[{i}].length", part.length) for i, part in enumerate(study.segments))
    parts = [_segment(f"segments[{i}]", part, kinds, total) for i, part in enumerate(study.segments)]
    return DynamicLine(
        tuple(segment for segment, _ in parts),
        study.anchor,
        _bodies(study),
        _bed(study),
        study.water.density,
        study.water.gravity,
        bool(study.surface),
    ), Strength(tuple(breaking for _, breaking in parts), tuple(part.type for part in study.segments))


def _segment(where, part, kinds, total):
    from hakobune.mooring.lines.dynamics.simulation import DynamicSegment

    properties, breaking = of_types(where, part.type, kinds)
    elements = part.elements if part.elements is not None else max(4, round(ELEMENTS * part.length / total))
    try:
        return DynamicSegment(part.length, elements=elements, **properties), breaking
    except ValueError as error:
        raise StudyError(f"{where}, type {part.type}: {error}") from None


def _properties(where, kind, water):
    """Keywords of a DynamicSegment, and the breaking load in N"""
    from hakobune.mooring.lines.dynamics.line import felt
    from hakobune.mooring.lines.system.parts import LineDynamics

    static = line_type(where, kind, water.density, water.gravity)
    stiffness = static.axial_stiffness if kind.elongation_percent is None else _elongation(where, kind)
    if np.ndim(stiffness) == 0 and math.isinf(stiffness):
        raise StudyError(
            f"{where}: the axial stiffness is missing, which a line in motion needs; "
            "give one of axial_stiffness_tonf, axial_stiffness_kN, or elongation_percent with tensions"
        )
    for key, name in (("mass", "mass_kg_per_m"), ("diameter", "diameter")):
        if getattr(static, key) is None:
            raise StudyError(f"{where}: {name} is missing; give a number above 0, or a catalogue name")
    made = {"weight": static.weight, "axial_stiffness": stiffness, "mass": static.mass, "diameter": static.diameter}
    return made | felt(static.dynamics or LineDynamics()), static.breaking_load


def _elongation(where, kind):
    """Pairs of strain and tension, N"""
    if kind.axial_stiffness_tonf is not None or kind.axial_stiffness_kN is not None:
        raise StudyError(f"{where} has both an axial stiffness and a table; give one of them")
    given = {"tension_tonf": (kind.tension_tonf, TONF), "tension_kN": (kind.tension_kN, 1e3)}
    tables = [np.array(values, float) * unit for values, unit in given.values() if values is not None]
    if len(tables) != 1 or len(tables[0]) != len(kind.elongation_percent):
        count = len(kind.elongation_percent)
        raise StudyError(
            f"{where}: elongation_percent has {count} numbers; give the same number in one of {', '.join(given)}"
        )
    return tuple(zip((0.01 * np.array(kind.elongation_percent)).tolist(), tables[0].tolist(), strict=True))


def _bodies(study):
    from hakobune.mooring.lines.dynamics.simulation import AttachedBody

    found = []
    for i, body in enumerate(attached("", study.bodies, len(study.segments) - 1)):
        try:
            found.append(body and AttachedBody(body.mass, body.volume, body.drag_area, body.added_mass))
        except ValueError as error:
            raise StudyError(f"body after segment {i + 1}: {error}") from None
    return tuple(found)


def _bed(study):
    from hakobune.mooring.lines.dynamics.simulation import ElasticBed

    if math.isinf(study.water.depth):
        if study.bed is not None:
            raise StudyError("bed is given and water.depth is inf; a bed needs a finite depth")
        return None
    below, table = study.anchor[2] + study.water.depth, study.bed or BedTable()
    if below < -1e-9 * study.water.depth:
        raise StudyError(
            f"the anchor is at z = {study.anchor[2]:g} m, under the bed; allowed: {-study.water.depth:g} m or higher"
        )
    check_bed("bed", table.points, -study.water.depth)
    try:
        return ElasticBed(
            math.radians(table.slope_deg),
            _uphill(study, table),
            max(below, 0.0),
            1e3 * table.stiffness_kPa_per_m,
            1e3 * table.damping_kPa_s_per_m,
            table.friction,
            points=tuple(table.points),
        )
    except ValueError as error:
        raise StudyError(f"bed: {error}") from None


def _uphill(study, table):
    """rad, direction in which the bed rises, or along which its points lie"""
    if table.uphill_deg is not None or not table.points:
        return math.radians(table.uphill_deg or 0.0)
    if study.fairlead.position is None:
        raise StudyError("bed.points need a direction if the fairlead has a table; give bed.uphill_deg")
    x, y = (end - begin for begin, end in zip(study.anchor[:2], study.fairlead.position[:2], strict=True))
    return math.atan2(y, x)


def current_of(study):
    """CurrentProfile of `mooring.lines.dynamics.simulation`, or None.  Raises ValueError."""
    from hakobune.mooring.environment.current_profile import power_law, table
    from hakobune.mooring.lines.dynamics.simulation import CurrentProfile

    given, depth = study.current, study.water.depth
    if given is None:
        return None
    heading = direction("current", given)
    if (given.z is None) != (given.speeds is None):
        raise StudyError(
            "current: only one of z and speeds is given; give both with the same number of values, or speed"
        )
    if given.z is None:
        profile = power_law(speed("current", given), heading, depth, given.exponent)
        z = np.linspace(-depth, 0.0, LEVELS) if math.isfinite(depth) else np.array([0.0])
    elif given.speed is not None or given.speed_knots is not None or given.exponent != 0:
        raise StudyError("current: z and speeds are given with speed or exponent; give one of the two")
    else:
        profile = table(given.z, given.speeds, heading)
        z = np.unique(np.concatenate([given.z, np.linspace(given.z[0], given.z[-1], LEVELS)]))
    return CurrentProfile(z, profile.velocity(z)[:, :2])


def wave_of(study, ramp):
    """WaveTrain of the wave or the sea that fades in over `ramp` s, or None.

    Raises ValueError, also for a wave, or a sea with its height and period, that would break (Miche).
    """
    from hakobune.mooring.lines.dynamics.simulation import WaveTrain

    depth = study.water.depth
    if study.sea is not None:
        made = _components(study)
        period = 2 * math.pi / made.omega
        return WaveTrain(made.amplitude, period, made.direction, made.phase, depth, ramp)
    wave = study.wave
    if wave is None:
        return None
    height, period = positive("wave.height", wave.height), positive("wave.period", wave.period)
    _check_breaking("wave", height, period, study.water)
    towards, phase = direction("wave", wave), math.radians(wave.phase_deg)
    return WaveTrain(0.5 * wave.height, wave.period, towards, phase, depth, ramp)


def _components(study):
    """Components of the sea.  Raises StudyError."""
    sea = study.sea
    made = sea.sea("sea", study.water.depth)
    height = made.spectrum.significant_height if sea.height is None else sea.height
    _check_breaking("sea", height, mean_period("sea", sea, study.water.depth), study.water)
    for name, least, most in (("seed", 0, 2**32), ("components", FEWEST, MOST)):
        if not least <= getattr(sea, name) <= most:
            raise StudyError(f"sea.{name} is {getattr(sea, name)}; allowed: {least} to {most}")
    return made.components(sea.components, sea.seed)


def _check_breaking(where, height, period, water):
    from hakobune.bem.waves import wavenumber

    k = float(wavenumber(2 * math.pi / period, water.depth, water.gravity))
    breaking = 0.142 * 2 * math.pi / k * math.tanh(min(k * water.depth, 20.0))
    if height > breaking:
        raise StudyError(
            f"{where}.height is {height:g} m; allowed: up to {breaking:.3g} m, at which such a wave breaks"
        )
