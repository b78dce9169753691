"""One seed of a moored body in time."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .. import integrator, slow_damping
from ..buoy import buoy_of
from ..contact_loads import contact_work
from ..equation import OF_SHAPES, SAMPLED, SLOW, Scene, blocks, buoy_at, memory_at, room, shapes_at
from ..line_loads import body_lines, line_work, loads_at, with_shapes
from ..links import link_work, links_of
from ..moving_lines.at_rest import moving_work, state_pull
from ..moving_lines.prepare import moving_of
from ..moving_lines.sea import line_sea
from ..streams import calm
from ..tables.groups import groups_of
from ..tables.wave_windows import Waves, waves_of
from ..wave_loads import no_waves, wave_table
from .body import body_of
from .expected import expected_motion
from .failures import SimulationError, stopped
from .linked import begin_together
from .loads import frequency_of_coefficients, streams, wave_components
from .realisation import Course, doubt_of, motion_of, poses_of, realisation_of, with_error
from .trial import Choice, chosen

STEPS_AT_ONCE = 5000, 200  # steps between progress reports, without and with moving lines: 0.05 to 0.5 s
FORGOTTEN = 20.0  # s, over which an error of a step is counted: a few cycles of a damped motion
SHARE = 0.3  # fraction of the tolerance for the errors within one such interval
FINER = 0.1  # tolerance of the run that estimates the error, over that of the study
# difference over tolerance above which a third run is made: of 2 000 random studies eight were beyond their
DOUBTED = 1 / 3
# tolerance while the second run showed 0.58 to 0.94 of it
COARSE = 0.01  # change of a static tension by discretisation accepted without a finding


class Begun(NamedTuple):
    """Initial data of a seed.

    scene : `equation.Scene`; waves : `wave_loads.Waves`; expected : (N + G, 12) scale of the errors
        (`expected_motion`)
    moving : as in `moving_of`; findings : one line each
    """

    scene: Scene
    waves: Waves
    expected: np.ndarray
    moving: tuple | None
    findings: tuple[str, ...]


def simulate(moored, weather, settings, seed=0, progress=None):
    """One `Realisation` of a `Moored` body in a `Weather`.

    seed : whole number; equal seeds give identical results. progress : function called with the finished fraction
    raises : SimulationError where the motion cannot be followed
    """
    settings, words, left_out, _ = with_lines_chosen(moored, weather, settings)
    begun = _begun(moored, weather, settings, seed)
    begun = begun._replace(findings=(*left_out, *moored.findings, *words, *begun.findings))
    found = realisation_of(moored, settings, seed, begun, _followed(moored, settings, begun, progress))
    if not settings.estimate_error:
        return found
    return _judged(moored, settings, begun, found, progress)


def _judged(moored, settings, begun, found, progress):
    """A `Realisation` with its errors by a second run, and by a third if the second is near the tolerance"""

    def motion(tolerance):
        finer = replace(settings, tolerance=tolerance)
        again = begun._replace(moving=_again(moored, finer, begun.moving))
        return motion_of(_followed(moored, finer, again, progress), moored.reader.axes_at_rest)

    wanted = settings.tolerance
    finer = motion(FINER * wanted)
    doubt = doubt_of(found, finer)
    if not DOUBTED * wanted < doubt.worst <= wanted:
        return with_error(found, doubt, wanted, moored.reader.words)
    doubt = doubt_of(found, finer, motion(FINER**2 * wanted))
    return with_error(found, doubt, wanted, moored.reader.words, "runs to a tenth and a hundredth of the tolerance")


def _again(moored, settings, moving):
    """The same moving lines, to other settings"""
    return None if moving is None else moving_of(moored, settings, moving[0].sea)


def _sea_of_lines(components, table, weather, settings, reader):
    """`LineSea` of a run with the wave components of its waves, None for none, and their `WaveTable`"""
    grown = (0.0, settings.ramp) if settings.wave_ramp is None else settings.wave_ramp
    carried = (0.0, 0.0) if weather.carrier is None else weather.carrier.velocity
    return line_sea(components, table.number, reader.depth, _current_at_lines(weather), grown, settings.ramp, carried)


def _current_at_lines(weather):
    """Current at the lines, m/s; shape (2,); None for none"""
    if weather.on_hull is not None:
        return weather.on_hull.water.velocity
    if weather.current is None:
        return None
    towards = weather.current.direction
    return weather.current.speed * np.array([np.cos(towards), np.sin(towards)])


def _begun(moored, weather, settings, seed):
    """`Begun` of a seed; settings.dynamic_lines are names"""
    components, reader = wave_components(moored, weather, settings, seed), moored.reader
    at_rest, groups = reader.axes_at_rest, groups_of(reader)
    table, meets = no_waves(bodies=len(at_rest) + groups.count), [*range(len(at_rest)), *groups.owner]
    if components is not None:
        wanted = settings.slow_drift in ("newman", "mean")
        place = reader.depth, at_rest[meets, :3], reader.gravity
        table = wave_table(moored.waves, components, *place, wanted, weather.carrier, at_rest[meets, 5])
    wind, current, drag, findings = streams(moored, weather, seed, settings.ramp + settings.duration)
    sea = _sea_of_lines(components, table, weather, settings, reader) if settings.dynamic_water == "sea" else None
    moving = moving_of(moored, settings, sea)
    findings += (*_coarse(moored, weather, settings, moving), *_of_lost(settings))
    lost = [(name, settings.ramp + t) for name, t in settings.lines_lost]
    own = () if moving is None else moving[0].number
    lines = with_shapes(body_lines(moored.system, lost, moored.tables, own, len(at_rest)), reader)
    body = body_of(moored, weather, settings, components, drag, current is not None)
    if components is not None:
        mean, constant = frequency_of_coefficients(settings, components), settings.memory == "constant"
        findings += tuple(slow_damping.findings(moored, body, mean, constant, current is not None))
    flows = wind, calm(len(at_rest)) if current is None else current
    hull = None if weather.on_hull is None else weather.on_hull.water
    contacts = moored.berth.arrays
    work = room(table.steps, len(at_rest), groups.count)
    scene = Scene(body, lines, line_work(lines), *flows, contacts, contact_work(contacts), hull, work)
    waves = waves_of(table, settings.slow_drift == "mean")
    return Begun(scene, waves, expected_motion(moored, components), moving, findings)


def with_lines_chosen(moored, weather, settings):
    """`trial.Choice`: settings with names in dynamic_lines; a trial replaces "auto" by names, otherwise they are
    unchanged.

    raises : SimulationError as in `simulate`
    """
    if settings.dynamic_lines != "auto":
        return Choice(settings)
    return chosen(simulate, moored, weather, settings)


def _followed(moored, settings, begun, progress):
    """`Course` of a body to the end.  Raises SimulationError."""
    end, scene, moving = settings.ramp + settings.duration, begun.scene, begun.moving
    rows = int(np.floor(end / settings.step + integrator.AT_ONCE)) + 1
    groups, rigid = groups_of(moored.reader), moored.reader.rigid
    count = rigid // 6
    y = np.zeros(memory_at(count, groups.count) + len(scene.body.memory.decay))
    states, (velocity, bending) = blocks(y, count), of_all(settings.velocity, moored.reader)
    states[:, :6] = begin(moored, settings.offset)
    states[:, 6:12] = velocity
    bent = y[shapes_at(count) :][: OF_SHAPES * groups.count].reshape(-1, 2, 6).swapaxes(0, 1)
    amplitudes = moored.start[rigid:] + of_all(settings.offset, moored.reader)[1]
    shapes, held = np.array([amplitudes, bending]), links_of(moored.reader)
    links = None if held is None else (held, link_work(held, len(y), rows, groups.count))
    if held is not None:
        moves = np.append(np.arange(rigid), held.shapes)
        inverse = scene.body.mass_inverse[np.ix_(moves, moves)]
        given = held, inverse, states[:, :6], states[:, 6:12], shapes
        states[:, :6], states[:, 6:12], shapes = begin_together(*given)
    bent[:, groups.place // 6, groups.place % 6] = shapes
    states[:, SLOW : SLOW + 3] = states[:, [0, 1, 5]]
    if moored.buoy is not None:
        y[buoy_at(count) : shapes_at(count) - 3] = moored.buoy.start
    scale = SHARE * settings.tolerance / FORGOTTEN * begun.expected
    smooth = moving is None and moored.buoy is None and held is None and without_corners(scene)
    clock = integrator.clock_at_rest(y, end, settings.step, settings.fixed_step, scale, groups.count, smooth)
    ends = np.cumsum([SAMPLED * count, OF_SHAPES * groups.count, 0 if moored.buoy is None else 6])
    samples = np.zeros((rows, ends[-1]))
    scene = scene._replace(line_work=line_work(scene.lines), contact_work=contact_work(scene.contacts))
    hung = None if moored.buoy is None else buoy_of(moored.buoy, begun.waves.table, rows)
    sizes = rows, len(scene.lines.lost), (count, SAMPLED), (len(groups.place), groups.count)
    pair = None if moving is None else (moving[0], moving_work(*moving, *sizes))
    while True:
        most = STEPS_AT_ONCE[pair is not None]
        state = integrator.advance(scene, begun.waves, clock, samples, most, hung, links, pair)
        if progress is not None:
            progress(min(clock.now[integrator.TIME] / end, 1.0))
        if state == integrator.DONE:
            pulls = {} if pair is None else dict(zip(pair[0].number.tolist(), pair[1].tension.T, strict=True))
            states, bent, buoy = np.split(samples, ends[:2], axis=1)
            pulled = None if links is None else links[1].kept
            bent = bent.reshape(rows, -1, 2, 6).swapaxes(1, 2).reshape(rows, 2, -1)[:, :, groups.place]
            states, hung = states.reshape(rows, count, SAMPLED), None if hung is None else hung[1].kept
            return Course(states, buoy, clock, pulls, hung, pulled, *bent.swapaxes(0, 1))
        if state != integrator.RUNNING:
            stuck = -1 if pair is None else int(pair[1].stuck[0])
            raise stopped(state, clock, settings, scene, moored, hung, stuck)


def without_corners(scene):
    """Whether a `Scene` has neither fenders, ropes nor hawsers, nor lines that are read from tables"""
    return not len(scene.contacts.numbers) and not np.any((scene.lines.hawser >= 0) | (scene.lines.table >= 0))


def begin(moored, offset=(0.0,)):
    """Displacements in space, m, and headings, rad, of bodies at an offset (n,), along their axes, from rest; shape
    (N, 6)
    """
    reader = moored.reader
    turned = reader.axes_at_rest * [0, 0, 0, 0, 0, 1]
    return moored.start[: reader.rigid].reshape(-1, 6) + poses_of(of_all(offset, reader)[0], turned)


def of_all(values, reader):
    """Values of bodies, shape (N, 6), and of shapes, shape (f,), from one value for each motion of a Reader; (6,)
    zeros mean none.

    raises : SimulationError for arrays of any other shape
    """
    values, count = np.asarray(values, float), len(reader.words)
    if not values.any():
        values = np.zeros(count)
    if values.size != count:
        raise SimulationError(
            f"offset or velocity has {values.size} numbers for {count} motions; allowed: the same number"
        )
    return values[: reader.rigid].reshape(-1, 6), values[reader.rigid :]


def _coarse(moored, weather, settings, moving):
    """Findings on lines with a motion of their own: neglected effects, and errors of their pull by their elements"""
    if moving is None:
        return ()
    found = [_around(weather, settings)]
    lines, poses = with_shapes(body_lines(moored.system, (), moored.tables), moored.reader), begin(moored)
    static = line_work(lines)
    static.bent[:] = moored.start[moored.reader.rigid :]
    loads_at(lines, static, poses, np.zeros((len(poses), 3, 3)), np.zeros_like(poses))
    whole = np.hypot(*static.tension[moving[0].number].T)
    if any(state.position[:, 2].max() > 0 for state in moving[1]):  # out of the water they are heavier, correctly
        moving = moving_of(moored, settings, surface=False)
    off = np.array([np.linalg.norm(state_pull(moving[0], i, one)) for i, one in enumerate(moving[1])]) / whole - 1
    worst = int(np.argmax(np.abs(off)))
    if abs(off[worst]) > COARSE:
        name, way = moored.system.line_names[moving[0].number[worst]], "more" if off[worst] > 0 else "less"
        found.append(
            f"line {name} in {settings.dynamic_elements} elements pulls {100 * abs(off[worst]):.2g} % {way} at rest "
            "than in its static shape; give more dynamic_elements"
        )
    return tuple(found)


def _around(weather, settings):
    """A finding on the water around lines with a motion of their own"""
    if settings.dynamic_water == "sea":
        how = " and the current, uniform over the depth" if weather.current or weather.on_hull else ""
        return f"lines of dynamic_lines move in the incident waves{how}, without disturbance by the body"
    return (
        "lines of dynamic_lines move in still water: waves and current act on the body, not on them; "
        'dynamic_water = "sea" includes that'
    )


def _of_lost(settings):
    """Findings on the statistics of lines that break"""
    for name, at in settings.lines_lost:
        if at < settings.duration:
            yield f"line {name} breaks {at:g} s after the ramp"
        else:
            yield (
                f"line {name} does not break, since its break time is {at:g} s after the ramp and a run lasts "
                f"{settings.duration:g} s"
            )
