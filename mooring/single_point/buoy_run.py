"""A body and its buoy in time in one equation (`buoy_equation`): what is given once, and a run.

The wave motion of the free body is that of its database along the slow path that `slewing.slew` foresees without waves;
water at the buoy is that at its steady place.  Steps are a twentieth of the shortest period: of the buoy between its
hawsers, or of the waves.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bem.waves import wavenumber

from ..lines.ropes import RopePart
from ..loads.turning import LARGEST_TURN
from ..motion.interpolation import EDGE, ring_table
from ..motion.line_loads import body_lines, line_work
from ..motion.streams import GUST_STEP, Stream
from .body import SinglePoint, SinglePointError
from .buoy_equation import Buoy, Floating, Sea, room, steps
from .slewing import SlowMotion
from .waves import at_heading, headings, mean_frequency, share_of_height

PER_PERIOD = 20  # steps in the shortest period
DAMPING = 0.05  # of critical, of a hawser between its ends
LONGEST, SHORTEST = 0.25, 1e-4  # s, of a step
MOST_STEPS = 50_000_000


@dataclass(frozen=True)
class BuoyBody:
    """mass : kg; diameter, height : m, of an upright cylinder; added : C_a sideways, and up and down of the same volume

    drag : C_d, of the side and the bottom; hawser_z : m, of the hawsers on the body over its centre of mass
    """

    mass: float
    diameter: float
    height: float
    added: tuple[float, float] = (1.0, 1.0)
    drag: tuple[float, float] = (1.0, 1.0)

    def draft(self, density):
        """m, floating free of lines"""
        return self.mass / (density * 0.25 * np.pi * self.diameter**2)


class BuoyRun(NamedTuple):
    """time : (n,) s; place : (n, 2) m, heading : (n,) rad of the slow motion; wave : (n, 6) m, rad beside it

    buoy : (n, 3) m from where it floats free of lines; hawser : (n, k), lines : (n, l) N, the largest since the sample
    before; wind_speed : (n,) m/s; step : s, of the integration
    """

    time: np.ndarray
    place: np.ndarray
    heading: np.ndarray
    wave: np.ndarray
    buoy: np.ndarray
    hawser: np.ndarray
    lines: np.ndarray
    wind_speed: np.ndarray
    step: float


class Given(NamedTuple):
    """Waves along a path in equal steps from EDGE steps before 0 s: motion (12, m), water (7, m); step : s"""

    motion: np.ndarray
    water: np.ndarray
    step: float


def no_given():
    """`Given` of water without waves"""
    return Given(np.zeros((12, 1)), np.zeros((7, 1)), 1.0)


def given_waves(reader, components, path: SlowMotion, buoy, draft, waves_after=0.0) -> Given:
    """Wave motion of a `bem.database.reader.Reader` along a path, and water at the middle of a buoy's draft.

    buoy : (2,) m, its steady place; draft : m; waves_after : s before which there are none, grown over two periods
    """
    omega, amplitude, phase, direction = (np.asarray(part, float) for part in components)
    order = np.argsort(omega)
    omega, amplitude, phase, direction = (part[order] for part in (omega, amplitude, phase, direction))
    step = 2 * np.pi / omega[-1] / 12
    t = step * (np.arange(int(np.ceil(path.time[-1] / step)) + 2 * EDGE + 2) - EDGE)
    k = wavenumber(omega, reader.depth, reader.gravity)
    motions = reader.floating().motions(omega, headings())  # (n, RING, 6)
    x, y, heading = (np.interp(t, path.time, part) for part in (*path.place.T, path.heading))
    out, water = np.zeros((12, len(t))), np.zeros((7, len(t)))
    grown = share_of_height(t, waves_after, mean_frequency(omega, amplitude))
    for i, w in enumerate(omega):
        X = at_heading(motions[i], direction[i] - heading)
        cos, sin = np.cos(direction[i]), np.sin(direction[i])
        carried = amplitude[i] * np.exp(1j * (k[i] * (cos * x + sin * y) + phase[i] - w * t)) * grown
        found = X.T * carried
        out[:6] += found.real
        out[6:] += (-1j * w * found).real
        here = amplitude[i] * np.exp(1j * (k[i] * (cos * buoy[0] + sin * buoy[1]) + phase[i] - w * t)) * grown
        level = np.exp(-0.5 * k[i] * draft)
        water[0] += here.real
        flow = w * here * level / np.tanh(k[i] * reader.depth)
        velocity = np.stack([cos * flow, sin * flow, -1j * w * here * level])
        water[1:4] += velocity.real
        water[4:7] += (-1j * w * velocity).real
    return Given(out, water, step)


def run_with_buoy(point: SinglePoint, buoy: BuoyBody, rope: RopePart, start, place, duration, sample, given=None,
                  wind=None, hawser_z=0.0) -> BuoyRun:  # fmt: skip
    """`BuoyRun` from a state (6,) of the body and (2,) m of the buoy, which is at rest.

    rope : of the hawsers, whose lengths are those of the point; duration, sample : s; given : None for no waves
    wind : (n,) m/s in steps of GUST_STEP from four of them before 0 s, None for the steady one
    hawser_z : m, height of the hawsers' ends over the centre of mass
    raises : SinglePointError where a line cannot follow
    """
    if point.lengths[0] == 0.0:
        raise SinglePointError("a contact buoy moves with the body; a buoy of its own needs a hawser")
    given = no_given() if given is None else given
    height = point.pull(place).height - point.system.bodies[0].position[2]
    floating = _floating(point, rope, buoy, wind, hawser_z, height)
    own = _buoy(point, buoy)
    lines = body_lines(point.system)
    h = _step(point, rope, own, given)
    every = max(1, int(np.ceil(sample / h)))
    h = sample / every
    n = int(np.floor(duration / sample + 1e-9)) + 1
    if n * every > MOST_STEPS:
        raise SinglePointError(f"{n * every:.3g} steps of {h:.2g} s would be needed; soften the hawser or run shorter")
    y = np.zeros(12)
    y[:6], y[6:8] = start, place
    y[8] = height
    samples, tensions = np.zeros((n, 12)), np.zeros((n, len(point.ends) + len(point.system.lines)))
    work = room(len(point.ends))
    good = steps(floating, own, lines, line_work(lines), Sea(*given), work, y, h, every, samples, tensions)
    if good < n:
        away = np.hypot(*samples[good, 6:8])
        raise SinglePointError(
            f"at {good * sample:.4g} s the motion cannot be followed, the buoy {away:.3g} m from its place at rest: "
            "a line cannot reach it; lengthen the lines or give them an axial stiffness"
        )
    time = sample * np.arange(n)
    wave = np.zeros((n, 6))
    if given.motion.shape[1] > 1:
        at = given.step * (np.arange(given.motion.shape[1]) - EDGE)
        wave = np.stack([np.interp(time, at, row) for row in given.motion[:6]], axis=-1)
    k = len(point.ends)
    mean = np.hypot(*floating.wind.velocity)
    speed = np.full(n, mean)
    if wind is not None:
        speed = np.interp(time, GUST_STEP * (np.arange(len(wind)) - 4), wind)
    return BuoyRun(
        time, samples[:, :2], samples[:, 2], wave, samples[:, 6:9], tensions[:, :k], tensions[:, k:], speed, h
    )


def _floating(point, rope, buoy, wind, hawser_z, level):
    loads, water = point.loads, point.loads.water
    count = len(water.table)
    ropes = np.array([(length, rope.breaking_load, rope.strain, rope.exponent, 0.0) for length in point.lengths])
    stiffness = _stiffness(rope, point.lengths)
    ropes[:, 4] = 2 * DAMPING * np.sqrt(stiffness * buoy.mass)
    drift = np.zeros((4, 3)) if loads.drift is None else loads.drift.table
    air = Stream(np.zeros((count + 3, 3)), np.zeros(2), np.zeros((1, 1)), 0.0)
    if loads.wind is not None:
        velocity = loads.wind.speed * np.array([np.cos(loads.wind.direction), np.sin(loads.wind.direction)])
        gusts = np.zeros((1, 1)) if wind is None else (np.asarray(wind, float) - loads.wind.speed)[None]
        air = Stream(ring_table(loads.wind.table), velocity, gusts, -4 * GUST_STEP)
    ends = np.column_stack([point.ends, np.full(len(point.ends), hawser_z)])
    linear = np.zeros((3, 3)) if water.linear is None else np.asarray(water.linear, float)
    return Floating(ring_table(water.table.reshape(count, 15)), water.length, LARGEST_TURN, water.velocity,
                    float(water.turning), water.quadratic, linear, ring_table(drift), air, point.mass, point.inverse,
                    ends, ropes, level)  # fmt: skip


def _buoy(point, buoy):
    density, gravity = point.system.density, point.system.gravity
    draft, area = buoy.draft(density), 0.25 * np.pi * buoy.diameter**2
    if not draft < buoy.height:
        raise SinglePointError(
            f"a buoy of {buoy.mass:g} kg floats at {draft:.3g} m; allowed: below its {buoy.height:g} m"
        )
    displaced = density * area * draft
    added = displaced * np.array([buoy.added[0], buoy.added[0], buoy.added[1]])
    drag = 0.5 * density * np.array([*[buoy.drag[0] * buoy.diameter * draft] * 2, buoy.drag[1] * area])
    return Buoy(1 / (buoy.mass + added), np.array([displaced, displaced, 0.0]) + added, drag, gravity * buoy.mass,
                density * gravity * area, draft, buoy.height)  # fmt: skip


def _stiffness(rope, lengths):
    """N/m of each hawser at a tenth of its breaking load"""
    strain = rope.strain_at(0.1 * rope.breaking_load)
    return 0.1 * rope.breaking_load * rope.exponent / (strain * lengths)


def _step(point, rope, own, given):
    stiffness = _stiffness(rope, point.lengths).sum() + np.linalg.norm(point.pull(point.origin).stiffness, 2)
    shortest = 2 * np.pi / np.sqrt(max(stiffness, own.stiffness) * own.inverse.max())
    h = min(shortest / PER_PERIOD, LONGEST, given.step if given.motion.shape[1] > 1 else np.inf)
    if h < SHORTEST:
        warnings.warn(f"steps of {h:.2g} s: the hawser is stiff against its buoy", stacklevel=3)
    return h
