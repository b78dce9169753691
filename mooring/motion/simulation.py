"""A moored body in time: the door.  What does not depend on weather is prepared once, then every seed is a run."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from bem import DOFS
from bem.database.reader import Reader
from bem.time_domain.fast_states import slow_memory
from bem.time_domain.memory import MemoryArrays, memory_of_database

from ..environment.sea import Components, joined
from ..lines.system.equilibrium import rest
from ..lines.system.findings import beyond_tables
from ..response.bound_wave_drift import record as pair_record
from . import integrator, slow_damping
from .buoy import buoy_of
from .contact_loads import DEPTH, contact_work
from .contacts import at_rest, berth_stiffness, courses, no_berth
from .equation import FIRST_WORK, FLOAT, MEMORY, SLOW, WORKS, Body, Scene, room
from .expected import expected_motion
from .force_tables import TOLERANCE
from .given_forces import GivenForce, drift_of_half_waves, sampled
from .line_loads import REACH, body_lines, fairlead_course, line_loads, line_work, tables_of, tensions_along
from .moving_lines.packed import moving_work, state_pull
from .moving_lines.prepare import moving_of
from .moving_lines.trial import beside_static
from .streams import calm, current_stream, gust_at, stream_of, turning_drag, wind_stream
from .wave_loads import WaveForces, drift_of, no_waves, wave_forces, wave_table, waves_of

STEPS_AT_ONCE = 2000  # between reports of progress
FORGOTTEN = 20.0  # s, over which an error of a step is counted: a few cycles of a damped motion
SHARE = 0.3  # of the tolerance that the errors of one such time may have
MEMORY_TOLERANCES = (3e-4, 1e-3, 3e-3, 1e-2, 3e-2)
COUPLED, ONE_PLANE = 1e-6, 12  # share of added mass, and how many entries beside the diagonal a body with one plane of
# symmetry has; with more the fit takes a minute and a half to 1e-3, and 15 s to 3e-3
MEMORY_WANTED = 1e-3  # without a finding
FASTEST, BAND = 8.0, 2.0  # rad/s and times the band of the database, of states of the memory, those beyond both follow
# at once: explicit steps of 0.4 s are stable; within the band they would give energy, as at the scale of a model
FILTER = 0.25  # of the waves' peak frequency: slower motion is slow motion
MOTIONLESS = 1e-9  # m, rad: the deviation of a motion that is none
FINER, CHAOTIC = 0.1, 0.1  # tolerance of the run that estimates the error; error over σ of a path that is chance
NEGLIGIBLE, TRIAL = (
    0.1,
    600.0,
)  # of a line's largest tension, that its own motion may change; s of the run that shows it
COARSE = 0.01  # of its tension, by which elements may change a line at rest without a word
UNKNOWN = 0.4  # rad/s, mean frequency of waves that there are not
NEXT_SEA, GUSTS = 7919, 104729  # what is added to the seed of a run for each further sea, and for gusts: phases of
# two loads of a run are never drawn alike; those of runs whose seeds are as far apart as this would be
FEWEST, MOST = 200, 600  # wave components of a sea; at 600 their beats are closer than a slow resonance is wide


class SimulationError(ValueError):
    """A run that cannot be made or carried on: the message names the time, the number and the way out."""


@dataclass(frozen=True, eq=False)
class Moored:
    """A body on its lines, ready to be moved.

    reader : `bem.database.reader.Reader`; system : its `System`, None for a body without lines
    hull : `ExposedBox` that wind and current act on, None for none; memory : `bem.time_domain.memory.Memory`
    start : (6,) m, rad of the equilibrium at rest from the place given; spring, damping : (6, 6) linear, beside lines
    quadratic : (6,) N₂ of drag on each motion; stiffness : (6, 6) of water, lines and springs at rest
    slow_added_mass : (6, 6) of the lowest frequency known; waves : WaveForces
    tables : of lines with segments (`line_loads.tables_of`); findings : what a reader has to know, one line each
    berth : `contacts.Berth`, fenders and ropes; buoy : `buoy.BuoyOnLines` on hawsers, None for none
    free : motions that are not held, numbers 0 to 5
    """

    reader: object
    system: object
    hull: object
    memory: object
    start: np.ndarray
    spring: np.ndarray
    damping: np.ndarray
    quadratic: np.ndarray
    stiffness: np.ndarray
    slow_added_mass: np.ndarray
    waves: WaveForces
    tables: tuple
    findings: tuple[str, ...] = ()
    berth: object = field(default_factory=no_berth)
    buoy: object = None
    free: tuple[int, ...] = tuple(range(6))

    def __repr__(self):
        lines = 0 if self.system is None else len(self.system.lines)
        return f"<Moored {lines} lines, {self.memory}>"


class Realisation(NamedTuple):
    """One run.

    time : (n,) s; motion : (n, 6) m, rad of the rotation centre from its place at rest, yaw unwrapped
    velocity : (n, 6) m/s, rad/s in axes that turn with the heading; slow : (n, 3) low-passed x, y and yaw
    wave : (n,) m at the origin; wind_speed : (n,) m/s; tension : (n, lines) N at the body; seed : of the run
    estimated_error : (6,) of the motions, nan where not asked for; steps : taken
    deflection, reaction : (n, fenders) m, N; pull : (n, ropes) N
    work : {name: J} done on the body from the start of the ramp to the end; findings : one line each
    buoy : (n, 6) m, m/s, of the buoy from its place in its system, None without one
    hawser : (n, k), buoy_lines : (n, l) N, the largest since the sample before
    """

    time: np.ndarray
    motion: np.ndarray
    velocity: np.ndarray
    slow: np.ndarray
    wave: np.ndarray
    wind_speed: np.ndarray
    tension: np.ndarray
    seed: int
    estimated_error: np.ndarray
    steps: int
    work: dict
    findings: tuple[str, ...]
    deflection: np.ndarray
    reaction: np.ndarray
    pull: np.ndarray
    buoy: np.ndarray | None = None
    hawser: np.ndarray | None = None
    buoy_lines: np.ndarray | None = None


def moored(
    db, system=None, hull=None, *, memory=None, spring=None, damping=None, quadratic=None, berth=None, waves=None
):
    """`Moored` of an opened database or `Reader`, a `System` of one body, its axes at the rotation centre, and its hull

    hull : ExposedBox; the drag of the water on it is that of the box tests where they reach
    berth : `contacts.Berth`, fenders and ropes
    waves : WaveForces, memory : a Memory, by default those of the database
    spring, damping : (6, 6) SI; quadratic : (6,) N s²/m² …
    raises : ValueError naming what is missing or does not fit
    """
    body, findings = (db if isinstance(db, Reader) else db.reader).floating(), ()
    if memory is None:
        memory, findings = _memory(body)
    spring, damping = (np.zeros((6, 6)) if m is None else np.asarray(m, float) for m in (spring, damping))
    quadratic = np.zeros(6) if quadratic is None else np.asarray(quadratic, float)
    start, stiffness, tables = np.zeros(6), body.stiffness + spring, ((), ())
    if system is not None:
        _check_place(system, body)
        start, stiffness = _rest(system, body.stiffness, spring)
        tables = tables_of(system, start)
        findings = (*findings, *_of_tables(system, tables))
    berth = no_berth() if berth is None else berth
    if berth.names:
        start = _rest_at_berth(berth, system, tables, body, spring, start)
        stiffness = stiffness + berth_stiffness(berth, start)
    slow = body.held_added_mass(0.0)[0]
    rest_of_it = waves or wave_forces(body), tables, findings, berth
    return Moored(body, system, hull, memory, start, spring, damping, quadratic, stiffness, slow, *rest_of_it)


def with_memory(moored):
    """A `Moored` body with the memory of its water fitted.  Raises ValueError where that is not to be had."""
    memory, findings = _memory(moored.reader)
    return replace(moored, memory=memory, findings=(*moored.findings, *findings))


def simulate(moored, weather, settings, seed=0, progress=None):
    """One `Realisation` of a `Moored` body in a `Weather`.

    seed : whole number; the same gives the same bits.  progress : called with the share done
    raises : SimulationError where the motion cannot be followed
    """
    findings = list(moored.findings)
    settings, words = with_lines_chosen(moored, weather, settings)
    findings += words
    components = wave_components(moored, weather, settings, seed)
    table, expected = no_waves(), expected_motion(moored, components)
    if components is not None:
        reader = moored.reader
        wanted = settings.slow_drift in ("newman", "mean")
        table = wave_table(moored.waves, components, reader.depth, reader.rotation_center, reader.gravity, wanted)
    end = settings.ramp + settings.duration
    wind, current, drag = _streams(moored, weather, seed, end, findings)
    hull = None if weather.on_hull is None else weather.on_hull.water
    moving = moving_of(moored, settings)
    findings += [*_coarse(moored, settings, moving), *_of_lost(settings)]
    lost = [(name, settings.ramp + t) for name, t in settings.lines_lost]
    lines = body_lines(moored.system, lost, moored.tables, () if moving is None else moving[0].number)
    body = _body(moored, weather, settings, components, drag, current is not None)
    if components is not None:
        mean, constant = mean_frequency(components), settings.memory == "constant"
        mean = 2 * np.pi / settings.constant_period if settings.constant_period else mean
        findings += slow_damping.findings(moored, body, mean, constant, current is not None)
    streams = wind, calm() if current is None else current
    contacts = moored.berth.arrays
    scene = Scene(body, lines, line_work(lines), *streams, contacts, contact_work(contacts), hull, room(table.steps))
    waves = waves_of(table, settings.slow_drift == "mean")
    samples, clock, pulls, hung = _run(moored, settings, expected, scene, waves, moving, progress)
    found = _realisation(moored, settings, seed, scene, table, samples, clock, findings, pulls)
    if moored.buoy is not None:
        k, kept = len(moored.buoy.lengths), hung[1].kept
        found = found._replace(buoy=samples[:, 18:], hawser=kept[:, :k], buoy_lines=kept[:, k:])
    if not settings.estimate_error:
        return found
    finer = replace(settings, tolerance=FINER * settings.tolerance)
    again = _run(moored, finer, expected, scene, waves, moving_of(moored, finer), progress)
    return _with_error(found, again[0][:, :6], settings.tolerance)


def with_lines_chosen(moored, weather, settings):
    """Settings whose dynamic_lines are names, and findings on the choice, where it is "auto"; others as they are.

    The choice is by a trial, a run with all lines in their static shape, which is the same for every seed.
    raises : SimulationError as of `simulate`
    """
    if settings.dynamic_lines != "auto" or moored.system is None:
        return settings, ()
    still = replace(
        settings, dynamic_lines=(), lines_lost=(), estimate_error=False, duration=min(settings.duration, TRIAL)
    )
    run, lines = simulate(moored, weather, still), body_lines(moored.system)
    states = np.hstack([run.motion, run.velocity])
    courses = [fairlead_course(lines, i, states) for i in range(len(moored.system.lines))]
    tried = beside_static(moored.system, run, courses, settings.dynamic_elements)
    names = moored.system.line_names
    moving = [i for i, off in tried.off.items() if off > NEGLIGIBLE]
    told = ", ".join(f"{names[i]} {100 * tried.off[i]:.2g} %" for i in moving) or "none"
    words = (
        f'dynamic_lines = "auto": {len(moving)} of {len(names)} lines have a motion of their own, those that pull more '
        f"than {100 * NEGLIGIBLE:g} % of their largest tension otherwise with it, on a course of {still.duration:g} s: "
        f"{told}",
        *tried.refused,
    )
    return replace(settings, dynamic_lines=tuple(names[i] for i in moving)), words


def _with_error(found, finer, tolerance):
    """A Realisation with the root mean square difference from motions (n, 6) of a run to a smaller tolerance"""
    late = found.time >= 0
    error, spread = np.sqrt(np.mean((found.motion - finer)[late] ** 2, axis=0)), found.motion[late].std(axis=0)
    share = np.where(spread > MOTIONLESS, error / np.maximum(spread, MOTIONLESS), 0.0)
    worst, findings = int(np.argmax(share)), found.findings
    if share[worst] > tolerance:
        chaotic = "this motion forgets where it came from; believe statistics over seeds, not a single path"
        missed = f"the tolerance is {tolerance:g}; give a smaller one for a path as near as that"
        findings = (
            *findings,
            f"{DOFS[worst].lower()} of a run to a tenth of the tolerance differs by {share[worst]:.2g} of its standard "
            f"deviation: {chaotic if share[worst] > CHAOTIC else missed}",
        )
    return found._replace(estimated_error=error, findings=findings)


def wave_components(moored, weather, settings, seed):
    """Components of the weather's waves, None for none; as many as the record needs not to repeat."""
    if weather.regular is not None:
        w = weather.regular
        return Components(*(np.array([float(v)]) for v in (w.omega, 0.5 * w.height, 0.0, w.direction)))
    if not weather.seas:
        return weather.components
    low, high = moored.reader.omega[0], moored.reader.omega[-1]
    parts = []
    for number, sea in enumerate(weather.seas):
        band = np.clip(sea.spectrum.quantile((1e-5, 1 - 1e-3)), low, high)
        count = settings.components
        if count is None:
            count = int(np.clip(np.ptp(band) * settings.duration / (4 * np.pi), FEWEST, MOST))
        parts.append(sea.components(count, seed + NEXT_SEA * number, low=float(band[0]), high=float(band[1])))
    return parts[0] if len(parts) == 1 else joined(*parts)


def _of_lost(settings):
    """Findings on what the statistics of lines that break hold"""
    for name, at in settings.lines_lost:
        if at < settings.duration:
            yield (
                f"line {name} breaks {at:g} s after the ramp: its mean and σ are of a record that is zero from then on"
            )
        else:
            yield f"line {name} does not break: {at:g} s after the ramp, a run lasts {settings.duration:g} s"


def _of_tables(system, tables):
    """A finding where a table of a line is coarser than wanted"""
    for i, table in enumerate(tables[0]):
        if table.error > 2 * TOLERANCE:
            name = system.line_names[int(np.flatnonzero(tables[1] == i)[0])]
            off, wanted, where = 100 * table.error, 100 * TOLERANCE, 100 * table.coarse
            yield (
                f"line {name}: its table of forces is up to {off:.2g} % of the tension off, wanted {wanted:g} %, in "
                f"{where:.2g} % of the chords and heights"
            )


def _memory(body):
    """The Memory of a Reader to the smallest tolerance that it allows, and a finding where that is above the first"""
    A = body.held_added_mass(0.0)[0]
    size = np.sqrt(np.diag(A))
    coupled = np.count_nonzero(np.abs(A) > COUPLED * np.outer(size, size)) - len(A)
    for tolerance in MEMORY_TOLERANCES[2 * (coupled > ONE_PLANE) :]:
        try:
            memory = memory_of_database(body, tolerance)
        except ValueError as error:
            refused = error
            continue
        if tolerance <= MEMORY_WANTED:
            return memory, ()
        return memory, (
            f"memory of the water is fitted to {memory.error.max():.2g} of the largest, wanted "
            f"{MEMORY_WANTED:g}; store more frequencies over a wider band",
        )
    raise refused


def _rest(system, hydrostatic, spring):
    """(6,) place at rest from that given, and (6, 6) stiffness there"""
    body = replace(system.bodies[0], freedom=DOFS, hydrostatic_stiffness=hydrostatic + spring)
    state = rest(replace(system, bodies=(body,)))
    return (state.position - np.array([body.position]))[0], np.asarray(state.stiffness)[:6, :6]


def _rest_at_berth(berth, system, tables, body, spring, start):
    """(6,) place at rest with fenders and ropes beside lines and water"""
    lines, R, out = body_lines(system, (), tables), np.zeros((3, 3)), np.zeros(6)
    work = line_work(lines)

    def others(place):
        line_loads(lines, work, place, R, out)
        return out - (body.stiffness + spring) @ place

    radius = np.sqrt(np.diag(body.inertia)[3:] / body.inertia[0, 0])
    return at_rest(berth, others, start, np.concatenate([np.ones(3), 1 / radius]))


def _check_place(system, body):
    place, center = np.asarray(system.bodies[0].position[:3]), body.rotation_center
    if not np.allclose(place, center, rtol=0, atol=1e-9):
        raise ValueError(f"the body's axes lie at {place}; allowed: at the rotation centre {center} of the database")
    if not abs(system.depth - body.depth) <= 1e-6 * system.depth:
        raise ValueError(f"the lines are for {system.depth:g} m of water, the database for {body.depth:g} m")


def _streams(moored, weather, seed, end, findings):
    """Wind and current Streams, None for no water drag, and N₂ of yaw"""
    reader, hull, own = moored.reader, moored.hull, weather.on_hull
    if own is not None:
        blows = weather.wind is not None and own.wind is not None
        wind = weather.wind
        wind = (
            stream_of(own.wind, wind.speed, wind.direction, weather.gusts, seed + GUSTS, 0.0, end) if blows else calm()
        )
        return wind, calm(), own.quadratic
    if hull is None:
        if weather.wind or weather.current:
            raise SimulationError("wind and current need the hull they act on; give its length, beam and freeboard")
        return calm(), None, 0.0
    wind = calm()
    if weather.wind:
        wind = wind_stream(weather.wind, hull, reader.rotation_center, weather.gusts, seed + GUSTS, 0.0, end)
    try:
        current = current_stream(weather.current, hull, reader.rotation_center, reader.density, reader.depth)
        table = None if weather.current is None else weather.current.table
        return wind, current, turning_drag(hull, reader.density, reader.depth, table)
    except ValueError as error:
        if weather.current:
            raise SimulationError(str(error)) from None
        findings.append(f"slow motion has no drag of the water: {error}")
        return wind, None, 0.0


def _body(moored, weather, settings, components, drag, munk):
    """`equation.Body` of a run"""
    reader, memory = moored.reader, moored.memory
    slow = slow_memory(memory, max(FASTEST, BAND * memory.band[1]))
    added, B, arrays = memory.added_mass_infinity + slow.inertia, moored.damping + slow.damping, slow.arrays
    if settings.memory == "constant":
        if components is None and settings.constant_period is None:
            raise SimulationError(
                'memory = "constant" takes coefficients at the mean frequency of waves, and there are none; '
                'give waves, or memory = "states"'
            )
        period = settings.constant_period
        w = np.array([2 * np.pi / period if period else mean_frequency(components)])
        A, radiated = reader.coefficients(w)
        added, B = A[0], moored.damping + radiated[0]
        if np.linalg.eigvalsh(reader.inertia + added).min() <= 0:
            raise SimulationError(
                f"mass and added mass at {w[0]:.3g} rad/s are not positive, as water that rings before a wall can make "
                "them; give another constant_period"
            )
        arrays = MemoryArrays(np.zeros(0), np.zeros(0), np.zeros((6, 0)), np.zeros((6, 0)))
    quadratic = moored.quadratic.copy()
    quadratic[5] += drag
    mean = UNKNOWN if components is None else mean_frequency(components)
    try:
        pushed = *_pairs(moored, weather, settings, components), *_half_waves(moored, settings, components)
        given = sampled((*weather.forces, *pushed), settings.ramp, settings.duration)
    except ValueError as error:
        raise SimulationError(str(error)) from None
    ring = np.zeros((4, 6))
    if components is not None and settings.wave_drift_damping and settings.slow_drift != "none" and reader.knows_drift:
        ring = slow_damping.drift_damping_ring(moored.waves, weather, reader.depth, reader.gravity)
    inverse, free = np.zeros((6, 6)), np.ix_(moored.free, moored.free)
    inverse[free] = np.linalg.inv((reader.inertia + added)[free])
    turned = weather.on_hull is None or not weather.on_hull.turning  # turning tests hold the inertia of the turn
    return Body(
        inverse,
        turned * reader.inertia,
        turned * moored.slow_added_mass,
        reader.stiffness,
        moored.spring,
        B,
        quadratic,
        FILTER * mean,
        float(settings.ramp),
        np.array((0.0, settings.ramp) if settings.wave_ramp is None else settings.wave_ramp, float),
        0.0 if munk else 1.0,
        arrays,
        ring,
        *given,
    )


def _pairs(moored, weather, settings, components):
    """The force of pairs of waves beside Newman's, of a run, as a GivenForce, or nothing"""
    if weather.beside_newman is None or components is None:
        return ()
    known = moored.waves.drift is not None
    drift = drift_of(moored.waves, components, moored.start[5]) if known else None
    t, force = pair_record(weather.beside_newman, components, settings.ramp + settings.duration, drift)
    return (GivenForce(t - settings.ramp, force),)


def _half_waves(moored, settings, components):
    """The drift by half waves of a run, as a GivenForce, or nothing"""
    if settings.slow_drift != "half-waves" or components is None or not moored.reader.knows_drift:
        return ()
    return (drift_of_half_waves(moored.reader, components, moored.start[5], settings.ramp, settings.duration),)


def mean_frequency(components):
    """rad/s, of the energy of wave components"""
    energy = components.amplitude**2
    return float(components.omega @ energy / energy.sum())


def _run(moored, settings, expected, scene, waves, moving, progress):
    """Samples (n, 18 or 24), the last Clock, {number: (n,) N} of lines with a motion of their own, and the buoy"""
    end = settings.ramp + settings.duration
    rows = int(np.floor(end / settings.step + integrator.AT_ONCE)) + 1
    y = np.zeros(MEMORY + len(scene.body.memory.decay))
    y[:6] = moored.start
    y[SLOW : SLOW + 3] = moored.start[[0, 1, 5]]
    if moored.buoy is not None:
        y[FLOAT : FLOAT + 3] = moored.buoy.start
    scale = SHARE * settings.tolerance / FORGOTTEN * expected
    clock = integrator.clock_at_rest(y, end, settings.step, settings.fixed_step, scale)
    samples = np.zeros((rows, 18 if moored.buoy is None else 24))
    scene = scene._replace(line_work=line_work(scene.lines), contact_work=contact_work(scene.contacts))
    hung = None if moored.buoy is None else buoy_of(moored.buoy, waves.table, rows)
    pair = None if moving is None else (moving[0], moving_work(*moving, rows, len(scene.lines.lost)))
    while True:
        state = integrator.advance(scene, waves, clock, samples, STEPS_AT_ONCE, hung, pair)
        if progress is not None:
            progress(min(clock.now[integrator.TIME] / end, 1.0))
        if state == integrator.DONE:
            return samples, clock, {} if pair is None else _pulls(*pair), hung
        if state != integrator.RUNNING:
            stuck = -1 if pair is None else int(pair[1].stuck[0])
            raise SimulationError(_failure(state, clock, settings, scene, moored, hung, stuck))


def _coarse(moored, settings, moving):
    """Findings on lines with a motion of their own: what they leave out, and where elements make them pull otherwise"""
    if moving is None:
        return ()
    found = ["lines of dynamic_lines move in still water: waves and current push the body, not them"]
    lines, out = body_lines(moored.system, (), moored.tables), np.zeros(6)
    static = line_work(lines)
    line_loads(lines, static, moored.start, np.zeros((3, 3)), out)
    whole = np.hypot(*static.tension[moving[0].number].T)
    off = np.array([np.linalg.norm(state_pull(moving[0], i, one)) for i, one in enumerate(moving[1])]) / whole - 1
    worst = int(np.argmax(np.abs(off)))
    if abs(off[worst]) > COARSE:
        name, way = moored.system.line_names[moving[0].number[worst]], "more" if off[worst] > 0 else "less"
        found.append(
            f"line {name} in {settings.dynamic_elements} elements pulls {100 * abs(off[worst]):.2g} % {way} at rest "
            "than in its static shape; give more dynamic_elements"
        )
    return tuple(found)


def _pulls(lines, kept):
    """{number: (n,) N} of lines with a motion of their own"""
    return dict(zip(lines.number.tolist(), kept.tension.T, strict=True))


def _failure(state, clock, settings, scene, moored, hung, stuck):
    t, place = clock.now[integrator.TIME], clock.y[:6]
    where = f"at {t - settings.ramp:.4g} s after the ramp, the body {np.hypot(*place[:2]):.3g} m from its place"
    if state == integrator.BEYOND:
        i = int(scene.contact_work.beyond[0])
        depth, limit = scene.contact_work.now[i, DEPTH], scene.contacts.table.marks[i, 1]
        return (
            f"{where}: fender {moored.berth.names[i]} is pressed by {depth:.3g} m, beyond its table, which ends at "
            f"{limit:.3g} m; take a larger one, or give it an overload stiffness"
        )
    if state == integrator.STUCK:
        return (
            f"{where}: line {moored.system.line_names[stuck]} cannot be followed in its own motion; leave it out of "
            "dynamic_lines, or raise the tolerance"
        )
    if moored.buoy is not None and state in (integrator.NO_LINE, integrator.TOO_SHORT):
        return f"{where}: {_of_buoy(state, clock, hung[1])}"
    name, tension = _tightest(scene.line_work, moored)
    if state == integrator.NO_LINE and tension > (load := moored.system.breaking_load[_number(moored, name)]):
        return (
            f"{where}: line {name} pulls {tension:.3g} N, {tension / load:.2g} times its breaking load; it is lost: "
            "take a stronger one, or weaken the loads"
        )
    if state == integrator.NO_LINE:
        return (
            f"{where}: a line cannot reach its fairlead, its end is below the bed or, of segments, beyond the table of "
            f"its forces, {REACH[1]:g} of the depth up or down; lengthen it, or weaken the loads"
        )
    if state == integrator.TOO_SHORT:
        rigid = name and not scene.lines.lines[_number(moored, name), 2] > 0
        way = "give it an axial stiffness" if rigid else "raise the tolerance or soften it"
        return (
            f"{where}: steps below {integrator.SHORTEST:g} s would be needed, line {name} pulls {tension:.3g} N; {way}"
        )
    return f"{where}: the motion is not a finite number; look at inertia, damping and stiffness"


def _of_buoy(state, clock, work):
    """Why a body with a buoy cannot be followed"""
    away, pull = np.hypot(*clock.y[FLOAT : FLOAT + 2]), work.rope.max()
    if state == integrator.NO_LINE:
        return (
            f"the buoy is {away:.3g} m from its place without the body, a line cannot reach it; lengthen the lines or "
            "give them an axial stiffness"
        )
    return (
        f"steps below {integrator.SHORTEST:g} s would be needed, a hawser pulls {pull:.3g} N; soften it, or take a "
        "heavier buoy"
    )


def _number(moored, name):
    return moored.system.line_names.index(name)


def _tightest(kept, moored):
    """Name and pull of the line that pulls most; None without lines"""
    if not len(kept.whole):
        return None, 0.0
    pull = np.nan_to_num(np.hypot(*kept.tension.T))
    return moored.system.line_names[int(pull.argmax())], float(pull.max())


def _realisation(moored, settings, seed, scene, table, samples, clock, findings, pulls):
    time = settings.step * np.arange(len(samples)) - settings.ramp
    lines, wind = scene.lines, scene.wind
    tension = np.zeros((len(samples), len(lines.lost)))
    tensions_along(lines, line_work(lines), time + settings.ramp, samples, tension)
    for number, pull in pulls.items():
        tension[:, number] = pull
    if moored.system is not None:
        findings += beyond_tables(moored.system, tension.max(axis=0))
    wave = np.zeros(len(samples))
    if len(table.omega):
        from ..environment.wave_records import elevation

        parts = Components(table.omega, table.amplitude, table.phase, table.direction)
        wave = elevation(parts, time + settings.ramp, 0.0, 0.0, moored.reader.depth, moored.reader.gravity)
    speed = np.hypot(*wind.velocity) + gust_at(wind, time + settings.ramp)
    count = len(moored.berth.fenders)
    depth, force = courses(moored.berth, samples)
    depth = np.maximum(depth, 0.0)
    work = dict(zip(WORKS, clock.y[FIRST_WORK:FLOAT].tolist(), strict=True))
    return Realisation(
        time, samples[:, :6], samples[:, 6:12], samples[:, 12:15], wave, speed, tension, seed, np.full(6, np.nan),
        int(clock.counts[integrator.STEPS]), work, tuple(findings),
        depth[:, :count], force[:, :count], force[:, count:],
    )  # fmt: skip
