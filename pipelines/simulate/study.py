"""Weather, settings and seeds of a mooring study with `[simulation]`, gusts and a spectrum of waves.

[simulation]                     [waves]                              [wind]
duration_hours = 3.0             height = 4.5                         speed = 30.0
seeds = 20                       period = 10.0       # mean           direction_deg = 240.0
                                 incidence_deg = 60.0                 gusts = "davenport"
                                 spectrum = "issc"   # or regular
                                 spreading = "cosine:4"
[[simulation.sea]]               # a further sea, as swell: the keys of [waves]
[[simulation.force]]
file = "tug.csv"                 # beside the study: t, Fx, Fy, Fz, Mx, My, Mz
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.on_current.waves import carrier_of, check_blocked, in_water
from hakobune.mooring.response.seas import energy_outside, outside

from ..common.quantities import StudyError, direction, level_of, positive
from ..common.weather.gusts import gusts_of
from ..moor.checked import check_period
from ..moor.tables import SimulationTable
from ..response.study import ONE_BODY, checked_ratios, damping_of
from ..results.heard import heard
from .berth import check_harbour

LOWEST = 1e-3  # share of the waves' energy below the split of slow and wave part
MOST_SEEDS, FEWEST, MOST_SAMPLES = 10_000, 8, 2_000_000
MOST_COMPONENTS = 100_000
MOVING = ("auto", "all")  # words for lines that move
MOTION_UNITS = ("m", "m", "m", "rad", "rad", "rad")
MOST_OF_RECORD = 20_000  # waves, at which an hour takes minutes
MISSED = 0.01  # share of the energy outside the stored frequencies that is not named; above MOST_MISSED refused
MOST_MISSED = 0.25


@dataclass(frozen=True)
class Plan:
    """weather, settings : see `mooring.motion.weather`; seeds : seeds of all runs; split : frequency between slow
    and wave part, rad/s

    mean_period : mean period of the waves, s, None in still water; findings : one line each
    sides : `mooring.fenders.gaps.Side` of several bodies
    shapes : units of the bending shapes of flexible bodies, which follow the motions; stations :
        `mooring.response.points.Station`
    told : chosen methods and neglected effects, one line each, once a body is prepared
    pace : computing time for a simulated second on static and on moving lines, s; nan if unknown, and until a
        body is prepared
    """

    weather: Weather
    settings: Settings
    seeds: tuple[int, ...]
    keep_series: int
    split: float
    mean_period: float | None
    findings: tuple[str, ...]
    told: tuple[str, ...] = ()
    sides: tuple = ()
    shapes: tuple[str, ...] = ()
    stations: tuple = ()
    pace: tuple[float, float] = (math.nan, math.nan)


def plan_of(study, omega, seeds=None, duration=None, folder=None, words=ONE_BODY, shapes=()):
    """The Plan of a `Study` on a database with frequencies omega (n,) rad/s; `words` are the names of its motions.

    seeds : number of seeds, instead of the study's; duration : s, instead of the study's
    folder : folder of the force files, None to omit the forces in files
    shapes : units of the bending shapes of flexible bodies, which are the last motions
    raises : StudyError for a study that cannot be simulated
    """
    table = study.simulation
    if table is None and duration is None:
        raise StudyError("the study has no [simulation]; give [simulation] with duration (s), or --duration")
    table = SimulationTable() if table is None else table
    settings = _settings(table, _duration(table, duration), words, shapes)
    _check_damping(table, words)
    _check_held(settings, motions_of(study, words), words)
    if study.harbour is not None:
        check_harbour(study.harbour.periods)
    (conditions, of_seas), depth = study.conditions_and_warnings(), study.water.depth
    with heard() as of_more:
        seas = _seas(study, table, conditions)
    waves = None if seas else conditions.waves
    names = _names(len(seas) - len(table.sea), len(table.sea)) if len(seas) > 1 else ("",) * len(seas)
    found = (line for one, name in zip(seas, names, strict=True) for line in _outside(one.spectrum, omega, name))
    findings = [*dict.fromkeys(found)]
    if seas and table.sea:
        findings.append("the simplified method, run for comparison, uses [waves] only, without simulation.sea")
    if waves is not None:
        check_period(waves, omega)
    level_of_pairs(study, bool(seas), settings.slow_drift)
    carrier = carrier_of(conditions.current)
    for one in seas or ((waves,) if waves is not None else ()):
        findings += check_blocked(carrier, one, depth, 9.80665)
    components = None
    if table.record is not None:
        components, said = _record(study, table, settings, omega, folder)
        findings += said
    bodies = [word.removesuffix("surge").strip() for word in words[: len(words) - len(shapes) : 6]]
    forces, said = _forces(table, folder, bodies, settings.duration)
    findings += said
    streams = conditions.wind, gusts_of(study.wind), conditions.current
    weather = Weather(seas, waves, *streams, forces, components=components)
    mean = None if conditions.waves is None else conditions.waves.period
    if components is not None:
        energy = components.amplitude**2
        mean = 2 * np.pi * float(energy.sum() / (energy @ components.omega))
    split, findings = _split(weather, omega), (*of_seas, *of_more, *findings)
    return Plan(weather, settings, _seeds(table, seeds), _kept(table), split, mean, findings, shapes=shapes)


def _seas(study, table, conditions):
    """All irregular seas, first those of [waves].  Raises StudyError."""
    more = [one.sea("simulation.sea", study.water.depth) for one in table.sea]
    irregular = conditions.sea is not None and conditions.method != "regular_wave"
    if more and not irregular:
        raise StudyError("simulation.sea is a sea in addition to [waves], so it needs irregular [waves]")
    return (*getattr(conditions.sea, "systems", (conditions.sea,)), *more) if irregular else ()


def _split(weather, omega):
    """rad/s between slow and wave part of a motion in a Weather, for frequencies omega (n,) of the database"""
    if weather.seas:
        return float(min(one.spectrum.quantile(LOWEST) for one in weather.seas))
    if weather.components is not None:
        energy = weather.components.amplitude**2
        return float(weather.components.omega[np.searchsorted(np.cumsum(energy), LOWEST * energy.sum())])
    return 0.5 * weather.regular.omega if weather.regular else float(omega[0])


def level_of_pairs(study, seas, drift):
    """Level of `mooring.response.pair_levels` that a study needs besides Newman's rule; "auto" if it may need a
    higher level

    seas : whether there are irregular waves; drift : slow_drift of the settings.  Raises StudyError.
    """
    level = level_of("simulation.qtf", study.simulation.qtf if study.simulation else "newman")
    if level not in ("newman", "auto") and study.quay is not None:
        raise StudyError(f'simulation.qtf is {level!r} in front of a quay; allowed: "newman", "auto"')
    if level not in ("newman", "auto") and not seas:
        raise StudyError(f"simulation.qtf is {level!r}; allowed: newman, auto, or with irregular waves")
    return "newman" if level == "auto" and (study.quay is not None or drift != "newman") else level


def check_names(settings, names):
    """Raises StudyError if settings name a line that is not in `names`"""
    asked = [("lines_lost", name) for name, _ in settings.lines_lost]
    if not isinstance(settings.dynamic_lines, str):
        asked += [("dynamic_lines", name) for name in settings.dynamic_lines]
    for key, name in asked:
        if name not in names:
            known = ", ".join(names) or "none"
            raise StudyError(f"simulation.{key}: there is no line {name!r}; allowed: {known}")


def check_run(study, omega, names, folder, words=ONE_BODY):
    """Raises ValueError for a `Study` that cannot be simulated, as `plan_of` and `check_names` do"""
    check_names(plan_of(study, omega, folder=folder, words=words).settings, names)


def force_files(study, folder):
    """Paths of the forces and the record of waves that a study gives as tables"""
    table = study.simulation
    given = [] if table is None else [*table.force, *([] if table.record is None else [table.record])]
    return [Path(folder) / one.file for one in given]


def _record(study, table, settings, omega, folder):
    """`Components` of the record of a study, None without its folder, and findings.  Raises StudyError."""
    from hakobune.mooring.environment.wave_records import components_of, read_record

    where, wanted = "simulation.record", settings.ramp + settings.duration
    if study.waves is not None or table.sea:
        raise StudyError(f"{where} is given together with [waves] or simulation.sea; give only one of them")
    if table.qtf not in ("newman", "auto"):
        raise StudyError(f'{where}: a record already contains its bound waves; allowed: qtf = "newman", "auto"')
    towards = direction(where, table.record)
    if folder is None:
        return None, ()
    try:
        record = read_record(Path(folder) / table.record.file)
    except ValueError as error:
        raise StudyError(f"{where}: {error}") from None
    length = record.step * (len(record.elevation) - 1)
    if length < wanted * (1 - 1e-9):
        raise StudyError(f"{where} lasts {length:g} s; allowed: ramp and duration, {wanted:g} s, or longer")
    first = record._replace(elevation=record.elevation[: int(np.ceil(wanted / record.step)) + 1])
    given = table.record.shortest
    shortest = 2 * np.pi / omega[-1] * (1 - 1e-9) if given is None else positive(f"{where}.shortest", given)
    every, found = (components_of(first, towards, period) for period in (0.0, shortest))
    carrier = carrier_of(study.conditions().current)
    if carrier is not None:  # a record at a place has the met frequencies
        found = in_water(found, carrier._replace(absolute=True), study.water.depth, 9.80665)
    if not len(found.omega):
        raise StudyError(f"{where} has no waves of {shortest:.4g} s or longer; lower shortest")
    if len(found.omega) > MOST_OF_RECORD:
        raise StudyError(
            f"{where} has {len(found.omega)} waves; allowed: {MOST_OF_RECORD}; give a longer shortest, or a shorter run"
        )
    lost = 1.0 - float((found.amplitude**2).sum() / (every.amplitude**2).sum())
    told = ()
    if lost > MISSED:
        way = "give a shorter shortest" if given is not None else f"solve {every.omega[-1]:.3g} rad/s and less"
        told = (f"{100 * lost:.3g} % of the record's energy is of waves below {shortest:.3g} s, left out; {way}",)
    outside = (found.omega < omega[0]) | (found.omega > omega[-1])
    share = float((found.amplitude[outside] ** 2).sum() / (found.amplitude**2).sum())
    if share > MISSED:
        told += (
            f"{100 * share:.3g} % of the record's energy lies outside the stored frequencies, {omega[0]:.3g} to "
            f"{omega[-1]:.3g} rad/s, and is not included; solve {found.omega[0]:.3g} rad/s and above",
        )
    return found, told


def damping(study, body):
    """Damping matrix of a Body, SI, shape (n, n), from a study's damping ratios and linear damping.

    The springs of the study count as restoring.
    """
    if study.simulation is None:
        return np.zeros_like(body.damping)
    sprung = body.restrained(stiffness=spring(study, body.words)) if study.simulation.spring else body
    ratios = damping_of("simulation", study.simulation.damping_ratio, sprung)
    return ratios + np.diag(_by_motion("linear_damping", study.simulation.linear_damping, body.words))


def motions_of(study, words=ONE_BODY):
    """Indices of the motions of a study, by default all.  Raises StudyError."""
    asked = study.simulation.motions if study.simulation else []
    known = [word.lower() for word in words]
    for name in asked:
        if name.lower() not in known:
            raise StudyError(f"simulation.motions: there is no motion {name!r}; allowed: {', '.join(words)}")
    found = tuple(sorted({known.index(name.lower()) for name in asked})) or tuple(range(len(words)))
    if len(found) < len(words) and study.hinges:
        raise StudyError(
            "simulation.motions fixes motions that hinges may need; with hinges, name all motions, or leave out the key"
        )
    return found


def _check_held(settings, motions, words):
    """Raises StudyError for an initial displacement of a fixed motion"""
    for key in ("offset", "velocity"):
        for i, value in enumerate(getattr(settings, key) or ()):
            if value and i not in motions:
                raise StudyError(
                    f"simulation.{key}.{words[i]} is given, but simulation.motions holds this motion fixed; add it "
                    f"there"
                )


def _check_damping(table, words):
    """Raises StudyError for an unknown motion"""
    checked_ratios("simulation", table.damping_ratio, words)
    for key in ("linear_damping", "quadratic_damping", "spring"):
        _by_motion(key, getattr(table, key), words)


def quadratic(study, words=ONE_BODY):
    """Quadratic damping of a study, SI; shape (n,)"""
    return _by_motion("quadratic_damping", study.simulation.quadratic_damping if study.simulation else {}, words)


def spring(study, words=ONE_BODY):
    """Springs of a study, SI; shape (n, n)"""
    return np.diag(_by_motion("spring", study.simulation.spring if study.simulation else {}, words))


def _start(key, values, words, shapes):
    """Values in m and rad, or per second, from numbers in m and degrees by motion; shape (n,).  Raises StudyError."""
    found = _by_motion(key, values, words, -math.inf, 1.0)
    units = motion_units(words, shapes)
    return tuple(float(np.radians(value) if unit == "rad" else value) for unit, value in zip(units, found, strict=True))


def motion_units(words, shapes=()):
    """Units of the motions named in `words`, shape (n,); the last motions are bending shapes, whose units are given"""
    return *MOTION_UNITS * ((len(words) - len(shapes)) // 6), *shapes


def _by_motion(key, values, words, least=0.0, unit=1e3):
    """Values in SI from numbers in kN by motion, at least `least`; shape (n,).  Raises StudyError."""
    out, known = np.zeros(len(words)), [word.lower() for word in words]
    for name, value in values.items():
        if name.lower() not in known:
            raise StudyError(f"simulation.{key}: there is no motion {name!r}; allowed: {', '.join(words)}")
        if not (least <= value < math.inf and math.isfinite(value)):
            good = "0 or more, finite" if least == 0 else "finite"
            raise StudyError(f"simulation.{key}.{name} is {value:g}; allowed: {good}")
        out[known.index(name.lower())] = unit * value
    return out


def check_forces(table):
    """Raises StudyError or TableError for a force file of a SimulationTable that a run cannot use"""
    _forces(table, "", [one.body for one in table.force], _duration(table, None))


def _forces(table, folder, bodies, duration):
    """`GivenForce` of each file, and findings, for a run of `duration` s.  Raises StudyError for an unknown body or a
    table that does not last.
    """
    from hakobune.mooring.motion.given_forces import check_lasts, read_force

    for i, one in enumerate(table.force):
        if one.body not in bodies:
            raise StudyError(f"simulation.force[{i}].body is {one.body!r}; allowed: {', '.join(bodies) or 'none'}")
    with heard() as caught:
        forces = () if folder is None else tuple(
            _placed(read_force(Path(folder) / one.file), one.at, bodies.index(one.body)) for one in table.force
        )  # fmt: skip
    found = list(caught)
    for one, force in zip(table.force, forces, strict=False):
        try:
            check_lasts(force, duration)
        except ValueError as error:
            raise StudyError(f"{one.file}: {error}") from None
        if force.times[0] >= duration:
            found.append(
                f"{one.file}: the force begins at {force.times[0]:g} s, after the end of the run of {duration:g} s"
            )
    return forces, tuple(found)


def _placed(force, at, body):
    if not math.isfinite(at):
        raise StudyError(f"simulation.force.at is {at}; allowed: a finite time, s")
    return replace(force, times=force.times + at, body=body)


def _duration(table, duration):
    if duration is not None:
        return positive("--duration", duration)
    if (table.duration is None) == (table.duration_hours is None):
        state = "neither is given" if table.duration is None else "both are given"
        raise StudyError(f"simulation: {state}; give one of duration (s), duration_hours")
    if table.duration is None:
        return 3600 * positive("simulation.duration_hours", table.duration_hours)
    return positive("simulation.duration", table.duration)


def _settings(table, duration, words, shapes):
    names = ("ramp", "step", "tolerance", "components", "slow_drift", "wave_drift_damping", "memory",
             "constant_period", "dynamic_elements", "dynamic_water", "estimate_error")  # fmt: skip
    dynamic = moving_lines(table)
    if table.components is not None and table.components > MOST_COMPONENTS:
        raise StudyError(f"simulation.components is {table.components}; allowed: 1 to {MOST_COMPONENTS}")
    if isinstance(dynamic, str) and dynamic not in MOVING:
        raise StudyError(f'simulation.dynamic_lines is {dynamic!r}; allowed: "auto", "all", "none", or a list of names')
    if table.dynamic_water != "still" and not dynamic:
        raise StudyError(
            f"simulation.dynamic_water is {table.dynamic_water!r}, but no line is in motion; give "
            "dynamic_lines, or leave dynamic_water out"
        )
    lost = tuple((one.line, one.time) for one in table.lines_lost)
    wrong = [one for one in table.lines_lost if not 0 <= one.time < math.inf]
    if wrong:
        raise StudyError(f"simulation.lines_lost: {wrong[0].line} breaks at {wrong[0].time:g} s; allowed: from 0 s on")
    try:
        settings = Settings(
            duration, lines_lost=lost, dynamic_lines=dynamic, offset=_start("offset", table.offset, words, shapes),
            velocity=_start("velocity", table.velocity, words, shapes),
            **{name: getattr(table, name) for name in names},
        )  # fmt: skip
    except ValueError as error:
        raise StudyError(f"simulation: {error}") from None
    if duration < FEWEST * settings.step:
        least = FEWEST * settings.step
        raise StudyError(f"simulation has {duration:g} s; allowed: at least {least:g} s, {FEWEST} samples")
    samples = (duration + settings.ramp) / settings.step
    if samples > MOST_SAMPLES:
        raise StudyError(f"simulation has {samples:.3g} samples; allowed: {MOST_SAMPLES}; give a longer step")
    return settings


def moving_lines(table):
    """Value of dynamic_lines for the settings of a run: names, () for no line, "all" or "auto" """
    given = table.dynamic_lines
    return () if given == "none" else given if isinstance(given, str) else tuple(given)


def _seeds(table, count):
    given = table.seeds if count is None else count
    asked = given if isinstance(given, int) else len(given)
    if not 1 <= asked <= MOST_SEEDS:
        raise StudyError(f"there are {asked} seeds; allowed: 1 to {MOST_SEEDS}")
    seeds = tuple(range(1, given + 1)) if isinstance(given, int) else tuple(given)
    if min(seeds) < 0 or len(set(seeds)) < len(seeds):
        raise StudyError("seeds must be whole numbers from 0, each given once")
    return seeds


def _kept(table):
    if table.keep_series < 0:
        raise StudyError(f"simulation.keep_series is {table.keep_series}; allowed: a whole number from 0")
    return table.keep_series


def _names(systems, more):
    """Beginnings of messages on the systems of waves: [waves] with its swell, and `more` seas of [simulation]"""
    swell = [f"waves.swell[{i}]: " for i in range(systems - 1)]
    return "waves: ", *swell, *(f"simulation.sea[{i}]: " for i in range(more))


def _outside(spectrum, omega, name=""):
    """Finding on the energy outside the stored frequencies.  Raises StudyError if it is too much."""
    below, above = (float(share) for share in energy_outside(omega, spectrum))
    if below + above <= MISSED:
        return ()
    text = (
        f"{name}{100 * (below + above):.1f} % of the wave energy lies outside the stored frequencies "
        f"({100 * below:.1f} % below {omega[0]:.4g}, {100 * above:.1f} % above {omega[-1]:.4g} rad/s)"
    )
    band = outside(spectrum, omega, MISSED)[1]
    if below + above > MOST_MISSED:
        reached = outside(spectrum, omega, MOST_MISSED)[1]
        raise StudyError(f"{text}; allowed: {100 * MOST_MISSED:g} %; solve {band} as well, or at least {reached}")
    return (f"{text} and is not included; solve {band} as well",)
