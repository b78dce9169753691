"""One seed of a simulation, run by an executor: the run, its statistics, its row of the file."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import msgspec
import numpy as np

from hakobune.bem.hinges import ALONE, told_of
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.gaps import gaps, pairs_of
from hakobune.mooring.motion.statistics import (
    in_plane,
    settled_from,
    statistics_of_records,
    stillness,
    without_rounding,
)
from hakobune.mooring.studies.conditions import afloat
from hakobune.mooring.studies.places import check_floats, check_links, check_places, place_findings

from ..common.quantities import StudyError
from ..common.quay_tables import linked
from ..moor.quay import body_of
from ..moor.study import Study, sides_of
from ..response.study import ONE_BODY
from ..results.given import database_of
from ..results.heard import heard
from .file import LEFT_OUT, LONGEST, SERIES, first_what_is_left_out
from .stations import OF_SHAPES, loads_along, stations_of, told_of_stations, units_of_shapes
from .study import Plan, check_names, damping, level_of_pairs, motion_units, motions_of, plan_of, quadratic, spring

STATIC = (
    'left out: inertia and drag of the lines (dynamic_lines = "none"), so that {}; dynamic_lines = "auto" includes '
    "them where a trial requires it"
)
FARTHER = 0.5  # change of a gap over its size at rest, and over the smaller beam, above which it is reported
_prepared = {}  # of this process: the last task, and its `Ready`


@dataclass(frozen=True, eq=False)
class Task:
    """study : `moor.study.Study`; database : path; duration : s, or None for the duration of the study

    memory : memory of the water, fitted, None before that
    folder : folder of the study, for the files that it names
    moving : names of the dynamic lines, if already chosen
    """

    study: Study
    database: str
    duration: float | None
    memory: object
    folder: str = "."
    moving: tuple[str, ...] | None = None


class Ready(NamedTuple):
    """body : `Moored`; plan : `study.Plan` with the chosen methods; findings : one line each"""

    body: object
    plan: Plan
    findings: tuple


def prepared(task, db=None, waves=None):
    """`Ready` of a Task; a process keeps it for the next seed of the same Task

    db : its open database, which other processes open themselves
    waves : `mooring.motion.wave_loads.WaveForces` of the same body in another sea, reused where equal
    """
    key = msgspec.json.encode(task.study), task.folder, task.database, task.duration
    if key not in _prepared:
        ready = _ready(task, database_of(task.database if db is None else db), waves)
        _prepared.clear()
        _prepared[key] = ready
    return _prepared[key]


def _ready(task, db, waves):
    from hakobune.bem.time_domain.memory import no_memory
    from hakobune.mooring.motion.moving_lines.prepare import moving_of
    from hakobune.mooring.motion.simulation import moored
    from hakobune.mooring.motion.wave_loads import no_wave_forces
    from hakobune.mooring.response.viscous import in_time
    from hakobune.mooring.studies.wave_effects import along_few

    study, words = task.study, db.bodies_reader.words
    plan = plan_of(study, db.bodies_reader.omega, None, task.duration, task.folder, words, units_of_shapes(db))
    stations, hull = stations_of(study, db), study.hulls_of(db)
    first = study.remarks(hull, db)
    system = study.system_of(db, hull, in_time=True)
    lines = () if system is None else system.line_names
    check_names(plan.settings, lines)
    study.anchors_on(lines)
    berth = study.berth_of(db, hull)
    reader, of_quay = body_of(study, db)
    reader = linked(reader, study.hinges, db)
    first = (*first, *_placed(db, hull, system, reader.links))
    memory, constant = task.memory, plan.settings.memory == "constant"
    if memory is None and (of_quay or constant):
        memory = no_memory(reader)
    extra, drag = damping(study, reader.floating()), quadratic(study, words)
    if of_quay and reader.viscous is None:  # made from the database's by the far field
        viscous = in_time(db.reader, plan.weather.waves)
        extra, drag = extra + viscous.damping, drag + viscous.quadratic
    streams = study.hull or study.hulls or plan.weather.wind or plan.weather.current
    turned = along_few(db, reader, plan.weather)
    with heard() as caught:
        body = moored(
            reader, system, hull if streams else None, memory=memory, damping=extra, quadratic=drag, berth=berth,
            spring=spring(study, words), motions=motions_of(study, words),
            waves=no_wave_forces(reader) if plan.weather.waves is None else waves, linearised_in=plan.weather.waves,
            turned=turned,
        )  # fmt: skip
        if of_quay and task.memory is None and not constant:
            body = _remembering(body, db, plan.settings.memory)
        plan, left = with_pairs(plan, study, db, reader)
        choice = _lines_chosen(task, body, plan)
        moving_of(body, choice.settings)  # refused here, before a file exists
    if body.reader.links:
        boxes = (hull if isinstance(hull, dict) else {ALONE: hull}).items()
        check_floats(boxes, body.start[2 : body.reader.rigid : 6])
    _check_start(sides_of(db), body, plan.settings)
    plan = replace(
        plan,
        sides=sides_of(db),
        stations=stations,
        settings=choice.settings,
        pace=choice.pace,
        told=first_what_is_left_out(_told(db, reader, body.free, plan, turned, left, choice)),
    )
    _ = body.dynamic_stiffness  # computed for all seeds while its inputs exist
    if waves is None:
        reader.between.forget()
    return Ready(body, plan, (*first, *of_quay, *caught))


def _placed(db, hull, system, links):
    """Messages on ends of lines off their hulls.  Raises ValueError for an end or a hinge that is far off."""
    hulls = afloat(db, hull)
    check_links(links, hulls)
    if system is None:
        return ()
    check_places(system, hulls)
    return tuple(place_findings(system, hulls))


def _told(db, reader, free, plan, turned, left, choice):
    """Methods chosen and effects left out, one line each"""
    from hakobune.mooring.studies.wave_effects import FEW, NO_DRIFT, lacks_drift, stored_degrees

    if plan.weather.waves is not None and plan.settings.slow_drift != "none":
        yield from (OF_SHAPES,) * bool(db.modes)
        yield from (NO_DRIFT,) * lacks_drift(db, reader)
    if turned:
        yield FEW.format(stored_degrees(reader.ring))
    yield from choice.left_out
    yield from left
    held = [word for i, word in enumerate(db.bodies_reader.words) if i not in free]
    if held:
        yield f"{LEFT_OUT} {', '.join(held)}: fixed at rest, as set by simulation.motions"
    yield from choice.words


def _lines_chosen(task, body, plan):
    """The Choice of dynamic lines: that of a Task, or by a trial if the study requests one"""
    from hakobune.mooring.motion.simulation import Choice, able_to_move, with_lines_chosen
    from hakobune.mooring.motion.simulation.trial import TOO_LARGE

    settings = plan.settings
    if task.moving is not None:
        return Choice(replace(settings, dynamic_lines=task.moving))
    if settings.dynamic_lines:
        return with_lines_chosen(body, plan.weather, settings)
    able, left_out = able_to_move(body.system, settings)
    return Choice(settings, (), (*((STATIC.format(TOO_LARGE),) if able else ()), *left_out))


def _remembering(body, db, asked):
    """A `Moored` body with memory before a quay.  Raises StudyError if only coefficients at one frequency exist."""
    from hakobune.mooring.motion.simulation import with_memory

    why = "the resonance of the water between hull and quay is too sharp for a few states"
    if db.wall is not None:
        try:
            return with_memory(body)
        except ValueError as error:
            why = " ".join(str(error).split())
    raise StudyError(
        f'simulation.memory is "{asked}" in front of a quay; allowed: "constant", which takes added mass and '
        f"damping in front of the quay: {why}"
    )


def with_pairs(plan, study, db, reader):
    """The Plan with the forces of wave pairs of the study's level beyond Newman's approximation, and its findings

    By default ("auto") the highest level in the database, or Newman's approximation alone.
    """
    from hakobune.mooring.response.bound_wave_drift import left_out
    from hakobune.mooring.response.pair_levels import beside_newman

    weather, drift = plan.weather, plan.settings.slow_drift
    level = level_of_pairs(study, bool(weather.seas), drift)
    if db.modes:
        return plan, _without_pairs(plan, level, "bodies that bend")
    if db.bodies:
        return _with_pairs_of_each(plan, db, level)
    try:
        found, notes = [], []
        for sea in weather.seas:
            forces, said = (None, ()) if level == "newman" else beside_newman(db, sea, level, spread=True)
            found.append(forces)
            notes += said
            if forces is None and drift != "none" and not any(line.startswith(LEFT_OUT) for line in said):
                notes += left_out(reader.floating(), sea, *_way(study, db, level))
    except ValueError as error:
        raise StudyError(f"simulation: {error}") from None
    notes = tuple(dict.fromkeys(notes))
    return replace(plan, weather=replace(weather, beside_newman=found)), notes


def _with_pairs_of_each(plan, db, level):
    """Like `with_pairs` of several bodies"""
    from hakobune.mooring.response.pair_levels import beside_newman_of_bodies

    if level not in ("newman", "body", "auto"):
        raise StudyError(f'simulation.qtf is {level!r} with several bodies; allowed: "newman", "body", "auto"')
    seas, found, notes = plan.weather.seas if plan.settings.slow_drift != "none" else (), [], []
    for sea in seas:
        try:
            forces, said = beside_newman_of_bodies(db, sea, level)
        except ValueError as error:
            raise StudyError(f"simulation: {error}") from None
        found.append(forces)
        notes += said or (f"{LEFT_OUT}: the slow force of wave pairs beyond Newman's approximation",)
    return replace(plan, weather=replace(plan.weather, beside_newman=found)), tuple(dict.fromkeys(notes))


def _without_pairs(plan, level, which):
    """A finding for bodies that have Newman's rule alone.  Raises StudyError for a level with more."""
    if level not in ("newman", "auto"):
        raise StudyError(f'simulation.qtf is {level!r} with {which}; allowed: "newman", "auto"')
    slow = plan.weather.seas and plan.settings.slow_drift != "none"
    return (f"{LEFT_OUT} the slow force of wave pairs beyond Newman's approximation, for {which}",) * bool(slow)


def _way(study, db, level):
    """Remedy for neglected forces of wave pairs, empty if it is the key itself"""
    if study.quay is not None:
        return ("in front of a quay only Newman's approximation is available",)
    return (f"'hakobune qtf {db.path}' stores them, for several directions with --heading",) if level == "auto" else ()


def simulate_seed(task, seed, kept, progress=None):
    """Row of a seed, {name: value}, with its records if they are `kept`.  Raises ValueError."""
    from hakobune.mooring.motion.simulation import simulate

    body, plan, _ = prepared(task)
    with heard():  # the plan reports the energy outside the stored frequencies once
        run = simulate(body, plan.weather, plan.settings, seed, progress)
    late = run.time >= -1e-9
    extreme = 0.0 if plan.weather.regular is not None else 1000 * plan.mean_period if plan.mean_period else None
    run = run._replace(tension=np.column_stack([run.tension, run.pull]))
    met = [column for pair in zip(run.deflection.T, run.reaction.T, strict=True) for column in pair]
    apart = gaps(plan.sides, run.poses)
    told = [column for _, _, column in told_of(body.reader.links)]
    run = run._replace(
        links=np.zeros((len(run.time), 0)) if run.links is None else run.links.reshape(len(run.time), -1)[:, told]
    )
    loads = loads_along(body.reader, plan.stations, run.motion)
    columns = [run.motion, run.wave, run.wind_speed, apart, run.tension, *met, run.links, loads]
    columns = np.column_stack(columns)[late]
    if not np.all(np.isfinite(columns)):
        raise ValueError("the run has values that are not finite")
    whole = statistics_of_records(columns.T, plan.settings.step, plan.split, extreme)
    found, settled = whole, settled_from(run.time[late], in_plane(run.motion[late]), lost_at(plan.settings))
    if settled:
        found = statistics_of_records(columns[settled:].T, plan.settings.step, plan.split, extreme)
        found = [own._replace(largest=of.largest, smallest=of.smallest) for own, of in zip(found, whole, strict=True)]
    names = run.tension.shape[1], run.deflection.shape[1]
    reader = body.reader
    beams = plan.shapes, told_of_stations(reader, plan.stations)
    units = quantities_of(*(("",) * n for n in names), reader.words, plan.sides, reader.links, *beams)[1]
    still = stillness([one.sigma for one in found], units, 2 * reader.radius, reader.inertia[0, 0] * reader.gravity)
    row = {
        "statistics": np.array([without_rounding(*pair) for pair in zip(found, still, strict=True)]),
        "estimated_error": run.estimated_error,
        "steps": float(run.steps),
        "used": largest_use(body, run.motion[late], run.tension[late]),
        "findings": np.bytes_(
            "\n".join((*run.findings, *_at_new_place(run.time[late], settled), *_of_gaps(plan.sides, apart[late])))
            .encode()[:LONGEST]
            .decode(errors="ignore")
            .encode()
        ),
    }
    row["excursion"] = farthest(run.motion[late], body)
    if body.system is not None:
        found = anchor_pulls(body, run.motion[late], run.tension[late])
        row |= {"anchor_pull": found[:, :2], "on_bed": found[:, 2]}
    if kept:
        row |= {name: (loads if name == "loads" else getattr(run, name))[late] for name in SERIES}
    return row


def farthest(motion, body):
    """m, largest horizontal distance from rest of a body in motion (t, n), m, rad"""
    away = (motion - body.start)[:, : body.reader.rigid]
    return float(np.hypot(away[:, 0::6], away[:, 1::6]).max(initial=0.0))


def on_bed(body, motion):
    """m on the bed of each line with the bodies held in motion (n,), m, rad; shape (lines,)"""
    return _at_rest_in(body, motion).grounded_length


def lost_at(settings):
    """s, when the last line breaks in a run, inf if none does"""
    return max((at for _, at in settings.lines_lost if at < settings.duration), default=math.inf)


def _at_new_place(time, settled):
    """A finding on a body that has found its new place after a loss"""
    if settled:
        yield (
            f"after the loss the body is at its new place from {time[settled]:.0f} s on: means, σ, periods and the "
            "watch circle are those from then on, smallest and largest those of the whole run"
        )


def largest_use(body, motion, tension):
    """Largest share of the breaking load, at the body, in motion (t, n), m, rad, and tension (t, lines), N; shape
    (lines,)

    Lines of segments include the utilisation of each segment, at the time of the largest pull on the body. Below a
    submerged buoy the tension exceeds the tension at the body.
    """
    system = body.system
    load = [*(() if system is None else system.breaking_load), *(one.breaking_load for one in body.berth.ropes)]
    used = tension.max(axis=0) / np.where(np.isfinite(load), load, np.nan)
    for i in () if system is None else (one.number for one in system.composites):
        used[i] = np.fmax(used[i], _at_rest_in(body, motion[tension[:, i].argmax()]).utilisation[i])
    return used


def anchor_pulls(body, motion, tension):
    """Pull along the bed and up at the anchor of each line, N, and its length on the bed, m, where its pull on the body
    is largest; shape (lines, 3); nan for ropes.  Of the static shape with that tension at the body, whose height it has
    then: inertia and drag pull more than the statics there."""
    from hakobune.mooring.lines.system.characteristic import at_tension

    found = np.full((tension.shape[1], 3), np.nan)
    for i in range(0 if body.system is None else len(body.system.lines)):
        state = _held_in(body, motion[tension[:, i].argmax()])
        found[i] = at_tension(state, i, tension[:, i].max())
    return found


def _at_rest_in(body, motion):
    """`LineForces` of the lines with the bodies held in motion (n,), m, rad"""
    return _held_in(body, motion).lines


def _held_in(body, motion):
    """`SystemEquilibrium` of the lines, likewise"""
    from hakobune.mooring.lines.system.equilibrium import held_at, rest
    from hakobune.mooring.motion.simulation.realisation import poses_of
    from hakobune.mooring.motion.tables.groups import with_bent_fairleads

    rigid = body.reader.rigid
    poses = poses_of(motion[:rigid], body.reader.axes_at_rest)
    held = {hull.name: tuple(map(float, pose)) for hull, pose in zip(body.system.bodies, poses, strict=True)}
    return rest(held_at(with_bent_fairleads(body.system, body.reader, motion[rigid:]), held))


def sample_times(settings):
    """Times of the samples that are kept, after the ramp, s; shape (n,)"""
    whole = math.floor((settings.ramp + settings.duration) / settings.step + 1e-9) + 1
    time = settings.step * np.arange(whole) - settings.ramp
    return time[time >= -1e-9]


def _of_gaps(sides, apart):
    """Findings on hulls that meet, or go farther from each other than the water between them is known for"""
    for (one, other), gap in zip(pairs_of(sides), apart.T, strict=True):
        names, least = f"{one.name} and {other.name}", gap.min()
        at_rest = gaps((one, other), at_rest_of(sides))[0, 0]
        size = min(one.half.min(), other.half.min())
        if least < 0:
            yield fails(
                f"{names} collide: their hulls overlap by {-least:.3g} m, limit 0; keep them apart by fenders or lines"
            )
        elif max(gap.max() - at_rest, at_rest - least) > max(FARTHER * at_rest, size):
            yield (
                f"the gap between {names} varies from {least:.3g} to {gap.max():.3g} m and is {at_rest:.3g} m "
                "at rest, but the forces of the water between the hulls are computed for the gap at rest; give lines "
                "that hold the bodies there, or solve the bodies at the gap of the run"
            )


def _check_start(sides, body, settings):
    """Raise StudyError for hulls that overlap at the start of a run."""
    from hakobune.mooring.motion.simulation.run import begin

    for (one, other), gap in zip(pairs_of(sides), gaps(sides, begin(body, settings.offset)[None])[0], strict=True):
        if gap < 0:
            raise StudyError(
                f"{one.name} and {other.name} overlap by {-gap:.3g} m at the start of a run; allowed: no "
                "overlap; give a smaller offset, or less tension between them"
            )


def at_rest_of(sides):
    """Poses at rest of the moving bodies; shape (1, N, 6)"""
    return np.array([[[0, 0, 0, 0, 0, one.place[2]] for one in sides if one.moves >= 0]], float)


def quantities_of(lines, fenders=(), words=ONE_BODY, sides=(), links=(), shapes=(), loads=()):
    """Names and units of the columns of statistics; words : words of the motions; sides : sides of several bodies

    shapes : units of the shapes, which are the last motions; loads : (name, unit) of the loads in beams
    (`told_of_stations`)
    """
    between = [f"gap {one.name} {other.name}" for one, other in pairs_of(sides)]
    names = [*words, "wave", "wind speed", *between, *(f"tension {line}" for line in lines)]
    names += [f"{what} {fender}" for fender in fenders for what in ("deflection", "reaction")]
    told = told_of(links)
    names += [*(name for name, _, _ in told), *(name for name, _ in loads)]
    units = [
        *motion_units(words, shapes),
        "m",
        "m/s",
        *["m"] * len(between),
        *["N"] * len(lines),
        *["m", "N"] * len(fenders),
        *(unit for _, unit, _ in told),
        *(unit for _, unit in loads),
    ]
    return tuple(names), tuple(units)
