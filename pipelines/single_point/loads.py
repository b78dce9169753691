"""Loads of a single-point study: wind, current and drift in the form of `mooring.single_point.loads`."""

import math

import numpy as np

from hakobune.mooring.loads.box_current import GROUNDED
from hakobune.mooring.loads.box_drag import about
from hakobune.mooring.loads.coefficients import shallow_coefficient
from hakobune.mooring.loads.on_hull import current_on, turning_drag, wind_on
from hakobune.mooring.loads.ship_derivatives import by_yaw_rate, clarke
from hakobune.mooring.loads.turning import OutsideTests, turning_coefficients
from hakobune.mooring.motion.wave_loads import wave_forces
from hakobune.mooring.on_current.waves import carrier_of, check_blocked
from hakobune.mooring.response.findings import MISSED, UNSURE
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.seas import outside
from hakobune.mooring.response.viscous import in_sea
from hakobune.mooring.seas.breaking import too_high, too_high_waves
from hakobune.mooring.single_point.loads import (
    DriftLoad,
    Loads,
    WaterLoad,
    WindLoad,
    isotropic_drift,
    still_table,
    turning_table,
)
from hakobune.mooring.single_point.rings import angles
from hakobune.mooring.single_point.waves import mean_drift
from hakobune.mooring.studies.conditions import ExposedBox

from ..common.quantities import StudyError, direction, positive, speed
from ..common.units import TONF
from ..common.weather.gusts import gusts_of
from ..common.weather.seas import PERIODS, sea_with_swell, spectrum_of
from ..common.weather.streams import current_of, doubtful_weather, no_box, superstructures, wind_of

MIDDLE = (0.0, 0.0)
SHIP = 4.0  # length over beam from which turning tests of barges are not offered
UNSAFE = 1.1  # growth of the side force in shallow water that is told
ONE_OF = "give one of turning, coefficients, file, ship"
PROPORTIONS = {"L/B": "length_over_beam = 2", "B/d": "beam_over_draft = 10", "H/d": "depth_over_draft = 8"}  # tested


def loads_of(study, db, density, center, mass, is_round=False):
    """Loads of a Study about its centre of mass (2,) m, and findings; mass : (3, 3) kg …, with added mass

    is_round : whether the hull is a vertical cylinder
    """
    h = study.hull
    hull = ExposedBox(h.length, h.beam, h.draft, h.freeboard, **superstructures(h), is_round=is_round)
    findings = doubtful_weather(study) + ([] if is_round else no_box(_block(h, density), hull, study))
    water, wind, drift = _each(
        lambda: _water(study, hull, density, center, mass, findings),
        lambda: _wind(study, hull, center),
        lambda: _drift(study, db, center, findings),
    )
    return Loads(water, wind, drift), findings


def _each(*parts):
    """Results of functions.  Raises StudyError with the messages of all that fail."""
    found, wrong = [], []
    for part in parts:
        try:
            found.append(part())
        except StudyError as error:
            wrong.append(str(error))
    if wrong:
        raise StudyError("; and ".join(wrong))
    return found


def _wind(study, hull, center):
    wind = wind_of(study.wind)
    if wind is None:
        return None
    try:
        found = wind_on(wind, hull)
    except ValueError as error:
        raise StudyError(str(error)) from None
    unit = about(found.unit(angles()), MIDDLE, center)
    return WindLoad(unit, wind.speed, wind.direction, gusts_of(study.wind), found.height)


def _water(study, hull, density, center, mass, findings):
    c, h = study.current, study.hull
    if c is None and hull.is_round:
        water = current_on(None, hull, density, study.water.depth)
        findings += water.notes
        table = still_table(about(water.unit(angles()), MIDDLE, center))
        return WaterLoad(table, h.length, False, quadratic=turning_drag(water, h.length), height=water.height[1])
    if c is None:
        table = _turning(study, None, density, center, findings)
        return WaterLoad(table, h.length, True, height=-0.5 * h.draft)
    ways = [name for name in ("turning", "coefficients", "ship") if getattr(c, name) is not None]
    if len(ways) > 1:
        raise StudyError(f"current: {' and '.join(ways)} are given, and each defines the force; {ONE_OF}")
    stream = speed("current", c), direction("current", c)
    if ways == ["turning"] or not (ways or hull.is_round):
        own = [k for k in ("yaw_drag", "yaw_rate", "sway_damping", "yaw_damping") if getattr(c, k)]
        if own:
            raise StudyError(
                f"current.{own[0]} is given with turning tests, which already contain it; leave this key out"
            )
        height = -0.5 * h.draft if c.center_z is None else c.center_z
        table = _turning(study, c.turning, density, center, findings)
        return WaterLoad(table, h.length, True, *stream, height=height)
    water = current_on(current_of(c), hull, density, study.water.depth)
    drag = turning_drag(water, h.length) if c.yaw_drag is None else 1e3 * c.yaw_drag
    for key, value in (("yaw_drag", drag), ("sway_damping", c.sway_damping), ("yaw_damping", c.yaw_damping)):
        if not 0 <= value < math.inf:
            raise StudyError(f"current.{key} is {value:g}; allowed: at least 0, finite")
    linear = 1e3 * np.diag([0.0, c.sway_damping, c.yaw_damping]) if c.sway_damping or c.yaw_damping else None
    table = still_table(about(water.unit(angles()), MIDDLE, center))
    findings += water.notes
    if c.yaw_rate is not None or c.ship is not None:
        table[:, 1] = _by_yaw_rate(study, c.yaw_rate, density, mass)
    return WaterLoad(table, h.length, False, *stream, drag, linear, water.height[1], water.still)


def own_mass(h, density, is_round=False):
    """kg, of a box or a vertical cylinder if no displacement is given"""
    block = 0.25 * math.pi if is_round else 1.0
    return density * h.length * h.beam * h.draft * block if h.displacement is None else 1e3 * h.displacement


def _block(h, density):
    return own_mass(h, density) / (density * h.length * h.beam * h.draft)


def _by_yaw_rate(study, given, density, mass):
    """Table (count, 3) of a WaterLoad over V (rL), from a given YawRateTable or None and Clarke et al. (1983)"""
    h = study.hull
    own, block = own_mass(h, density), _block(h, density)
    if not block <= 1 + 1e-9:
        raise StudyError(f"hull.displacement fills {block:.3g} of length, beam and draft; allowed: at most 1")
    found = clarke(h.length, h.beam, h.draft, min(block, 1.0))
    for name in ("Y_r", "N_r"):
        value = getattr(given, name, None)
        if value is not None:
            if not math.isfinite(value) or (name == "N_r" and value > 0):
                raise StudyError(f"current.yaw_rate.{name} is {value:g}; allowed: finite, N_r at most 0")
            found = found._replace(**{name: value})
    return by_yaw_rate(found, h.length, density, max(mass[0, 0] - own, 0.0), angles())


def _turning(study, given, density, center, findings):
    """Table (count, 5, 3) from turning tests for the hull's proportions, or for the proportions given instead"""
    h = study.hull
    own = {
        "length_over_beam": h.length / h.beam,
        "beam_over_draft": h.beam / h.draft,
        "depth_over_draft": study.water.depth / h.draft,
    }
    if center[0] or center[1]:
        raise StudyError(
            "turning tests refer to midship, but hull.center is not at midship; give current coefficients or a file"
        )
    asked = {name: getattr(given, name, None) for name in own}
    taken = {name: value if asked[name] is None else asked[name] for name, value in own.items()}
    for name, value in taken.items():
        positive(f"current.turning.{name}", value)
        if not math.isclose(value, own[name], rel_tol=1e-6):
            findings.append(f"the turning tests were made with {name} = {value:g}, but the hull has {own[name]:.3g}")
    try:
        found = turning_coefficients(*taken.values())
    except OutsideTests as error:
        if own["length_over_beam"] > SHIP:
            raise StudyError(
                f"current: {error.limits}; the tests are of barges, and a ship of L/B = "
                f"{own['length_over_beam']:.3g} lies at another heading with another pull; give current.ship = "
                '"tanker", or coefficients, or file'
            ) from None
        tested = ", ".join(PROPORTIONS[name] for name in error.proportions)
        one = len(error.proportions) == 1
        what = "proportion to use instead" if one else "proportions to use instead"
        raise StudyError(
            f"current: {error.limits}; give current.turning with the {what} ({tested}), or coefficients, or file"
        ) from None
    findings += found.notes
    if taken["depth_over_draft"] > own["depth_over_draft"]:
        findings += _shallower(found, own["depth_over_draft"])
    return turning_table(found, h.length, h.draft, density)


def _shallower(deep, relative):
    """A line on turning tests in deeper water than the hull's, by how much the side force grows (UFC 4-159-03)"""
    side = min(abs(float(deep.C_y(0.5 * math.pi, 0.0))), GROUNDED)
    grows = shallow_coefficient(side, 1.0, relative) / side
    if grows > UNSAFE:
        yield (
            f"unsafe: in water of {relative:.3g} drafts a current from the side pushes the hull about "
            f"{grows:.2g} times as hard as in these tests, which were made in deeper water (UFC 4-159-03, eq. "
            "11); give coefficients or a file for this depth"
        )


def _drift(study, db, center, findings):
    w = study.waves
    if w is None:
        return None
    if w.drift_tonf_per_m2 is not None:
        if not 0 <= w.drift_tonf_per_m2 < math.inf:
            raise StudyError(f"waves.drift_tonf_per_m2 is {w.drift_tonf_per_m2:g}; allowed: at least 0")
        if w.height is None:
            raise StudyError("waves.height is missing; drift_tonf_per_m2 needs the significant height, m")
        if w.swell:
            raise StudyError("waves.swell is given with drift_tonf_per_m2; swell needs the drift of --database")
        height, to = positive("waves.height", w.height), direction("waves", w)
        known = any(getattr(w, kind) is not None for kind in PERIODS)
        Tp = spectrum_of("waves", w, study.water.depth).Tp if known else math.inf
        findings += too_high_waves(height, Tp, study.water.depth)
        return isotropic_drift(w.drift_tonf_per_m2 * TONF * height**2, to, center, MIDDLE)
    if db is None:
        raise StudyError("waves: the wave drift is unknown; give --database or drift_tonf_per_m2")
    if not db.reader.knows_drift:
        raise StudyError(
            'the database contains no drift; solve it with want = ["drift"], or give waves.drift_tonf_per_m2'
        )
    sea = sea_with_swell("waves", w, db.water_depth)
    findings += [*_outside(sea, db.reader), *too_high(sea.spectrum, db.water_depth)]
    body, _ = in_sea(db.reader, sea)
    findings += _between_waves(body, sea)
    carrier, forces = waves_carrier(study), wave_forces(body)
    findings += check_blocked(carrier, sea, body.depth, body.gravity)
    drift = mean_drift(forces, sea, carrier, body.depth, body.gravity)
    if carrier is not None:
        findings.append(_by_current(drift, mean_drift(forces, sea), study.current))
    return DriftLoad(drift)


def _outside(sea, reader):
    """A line on waves outside the stored frequencies, which have no drift"""
    missed, band = outside(sea.spectrum, reader.omega, MISSED)
    if missed > MISSED:
        yield (
            f"{100 * missed:.3g} % of the waves' energy lies outside the stored frequencies, and its drift is not "
            f"included; limit {100 * MISSED:g} %; solve {band} as well"
        )


def waves_carrier(study):
    """`Carrier` of the waves of a study, None without a current that carries the waves.  Raises StudyError."""
    return carrier_of(current_of(study.current))


def _by_current(drift, still, current):
    largest, before = (np.hypot(*of[:, :2].T).max() / 1e3 for of in (drift, still))
    return (
        f"on the current the mean drift of the waves is at most {largest:.4g} kN, and {before:.4g} kN in "
        f'still water (current.waves = "still"); waves are given in {current.waves} frequencies'
    )


def _between_waves(body, sea):
    """A warning if the mean drift in head waves is uncertain between the stored frequencies, all errors of one sign"""
    omega = frequencies(body)
    value, error = body.at(omega, "drift_force", [np.pi])
    density = sea.spectrum.density(omega)
    unsure, mean = (float(np.trapezoid(density * np.abs(of[:, 0, 0]), omega)) for of in (error, value))
    if unsure > UNSURE * mean:
        yield (
            f"mean drift of the waves is uncertain by {100 * unsure / mean:.3g} % between stored waves; limit "
            f"{100 * UNSURE:g} %; add frequencies to the database, or give waves.drift_tonf_per_m2"
        )
