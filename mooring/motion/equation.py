"""The equation of motion of a body in time, and the powers of everything that acts on it, compiled.

    (M + A∞) ν̇ + C(νₛ) ν + ∫₀ᵗ K(t−τ) ν(τ) dτ + B′ν + N₂ν|ν| + C η
        = F₁ + F₂ + F_wind + F_current + F_lines + F_fenders + F_ropes + F_given

η = (x, y, z, φ, θ, ψ): place of the rotation centre from that at rest, in space, roll and pitch, and the heading, which
may be any.  ν = (u, v, w, φ̇, θ̇, ψ̇), forces and memory are in axes that turn with the heading.  νₛ is the slow velocity
(after a filter, below): the centripetal forces of wave-frequency motion are part of the drift.  C(νₛ) is skew, so that
it does no work; with a current its moment on the added mass (Munk's) is in the current coefficients and left out here.
The memory is a linear system that is driven by ν (`bem.time_domain.memory`).  A buoy with mass between hawsers and
lines of its own (`buoy`) and a hull that slews in a current (`tables.hull_water`) are terms of the same equation.
Filter of the slow pose:  s̈ = ωc² (p − s) − 2 ωc ṡ  for x, y and ψ.

State: η (6), ν (6), slow pose (3) and its rate (3), work done on the body by each of WORKS, J, displacement (3) and
velocity (3) of a buoy in space, memory.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.time_domain.memory import MemoryArrays
from hakobune.bem.time_domain.memory_kernels import memory_force, memory_rate

from .buoy import buoy_rates
from .contact_loads import Contacts, ContactWork, contact_loads
from .line_loads import Lines, LineWork, line_loads
from .streams import Stream, stream_force
from .tables.hull_water import HullWater, hull_water_force
from .tables.interpolation import EDGE, between_samples, on_ring
from .wave_loads import ROWS

WORKS = ("waves", "drift", "wind", "current", "lines", "memory", "damping", "given", "fenders", "ropes",
         "hawsers")  # fmt: skip
BY_WAVES, BY_DRIFT, BY_WIND, BY_CURRENT, BY_LINES, BY_MEMORY, BY_DAMPING, BY_GIVEN, BY_FENDERS, BY_ROPES = range(10)
BY_HAWSERS = 10
SLOW, SLOW_RATE, FIRST_WORK, FLOAT = 12, 15, 18, 18 + len(WORKS)  # where the parts of the state begin
MEMORY = FLOAT + 6


class Body(NamedTuple):
    """Constants of the equation.

    mass_inverse : (6, 6) of M + A∞; rigid, slow : (6, 6) M, and the added mass of slow motion
    stiffness : (6, 6) hydrostatic, on η in heading axes; spring : (6, 6) on η in space axes; damping : (6, 6) B′
    quadratic : (6,) N₂; filter_rate : ωc, rad/s; ramp : s; munk : 1, or 0 where its moment is in the current
    wave_ramp : (2,) s, begin of the waves and how long they grow
    memory : `bem.time_domain.memory.MemoryArrays`
    drift_damping : (HEADINGS + 3, 6) B over headings ψ, rows of `interpolation.ring_table`; N s/m by (surge, sway)
    given : (6, n) N and N m, a table in time in heading axes, from 0 s in steps of given_step s; one column for none
    """

    mass_inverse: np.ndarray
    rigid: np.ndarray
    slow: np.ndarray
    stiffness: np.ndarray
    spring: np.ndarray
    damping: np.ndarray
    quadratic: np.ndarray
    filter_rate: float
    ramp: float
    wave_ramp: np.ndarray
    munk: float
    memory: MemoryArrays
    drift_damping: np.ndarray
    given: np.ndarray
    given_step: float


class Work(NamedTuple):
    """Room for work of one evaluation, and the window of wave forces in use.

    window : (ROWS, m); span : start s, step s; force, part : (6,); R : (3, 3)
    """

    window: np.ndarray
    span: np.ndarray
    force: np.ndarray
    part: np.ndarray
    stream: np.ndarray
    waves: np.ndarray
    weights: np.ndarray
    value: np.ndarray
    drag: np.ndarray
    R: np.ndarray
    arm: np.ndarray
    moving: np.ndarray
    powers: np.ndarray


class Scene(NamedTuple):
    """All that acts on a body, and room for work: what `rates` takes beside time and state"""

    body: Body
    lines: Lines
    line_work: LineWork
    wind: Stream
    current: Stream
    contacts: Contacts
    contact_work: ContactWork
    hull: HullWater | None
    work: Work


def room(columns):
    """`Work` for windows of so many columns"""
    return Work(
        np.zeros((ROWS, columns)), np.zeros(2), np.zeros(6), np.zeros(6), np.zeros(3), np.zeros(ROWS), np.zeros(6),
        np.zeros(1), np.zeros(6), np.zeros((3, 3)), np.zeros(3), np.zeros(4), np.zeros(15),
    )  # fmt: skip


@kernel(inline=True)
def ramp(t, length):
    """Share of the loads at t s of a ramp: from 0 to 1, with a continuous slope and curvature"""
    if length <= 0.0 or t >= length:
        return 1.0
    s = max(t / length, 0.0)
    return s * s * s * (10.0 - s * (15.0 - 6.0 * s))


@kernel(inline=True)
def give(force, y, rate, part, count, number):
    """Add the first `count` numbers of a part to the force, and its power to the rate of its work."""
    power = 0.0
    for j in range(count):
        force[j] += part[j]
        power += part[j] * y[6 + j]
    rate[FIRST_WORK + number] += power


@kernel(inline=True)
def add_horizontal(work, y, rate, x, y_force, moment, number):
    """Add a surge and sway force and a yaw moment"""
    work.force[0] += x
    work.force[1] += y_force
    work.force[5] += moment
    rate[FIRST_WORK + number] += x * y[6] + y_force * y[7] + moment * y[11]


@kernel(inline=True)
def restore(body, y, rate, work):
    """Hydrostatic and spring forces and those of the turning axes, whose work is that of the current, if any"""
    cos, sin = np.cos(y[5]), np.sin(y[5])
    for i in range(6):
        total = 0.0
        for j in range(2, 5):
            total += body.stiffness[i, j] * y[j]
        work.force[i] -= total
    for i in range(6):
        total = 0.0
        for j in range(6):
            total += body.spring[i, j] * y[j]
        work.part[i] = -total
    work.force[0] += cos * work.part[0] + sin * work.part[1]
    work.force[1] += -sin * work.part[0] + cos * work.part[1]
    for i in range(2, 6):
        work.force[i] += work.part[i]
    u, v, r = cos * y[15] + sin * y[16], -sin * y[15] + cos * y[16], y[17]
    along = body.rigid[0, 0] * u + body.rigid[0, 1] * v + body.rigid[0, 5] * r
    across = body.rigid[1, 0] * u + body.rigid[1, 1] * v + body.rigid[1, 5] * r
    water_along = body.slow[0, 0] * u + body.slow[0, 1] * v + body.slow[0, 5] * r
    water_across = body.slow[1, 0] * u + body.slow[1, 1] * v + body.slow[1, 5] * r
    moment = (along + body.munk * water_along) * y[7] - (across + body.munk * water_across) * y[6]
    add_horizontal(work, y, rate, (across + water_across) * y[11], -(along + water_along) * y[11], moment, BY_CURRENT)


@kernel(inline=True)
def dissipate(body, y, rate, work):
    """Linear and quadratic damping, and the memory of the water with the rates of its states"""
    for i in range(6):
        total = body.quadratic[i] * y[6 + i] * abs(y[6 + i])
        for j in range(6):
            total += body.damping[i, j] * y[6 + j]
        work.part[i] = -total
    give(work.force, y, rate, work.part, 6, BY_DAMPING)
    memory_rate(body.memory, y[MEMORY:], y[6:12], rate[MEMORY:])
    memory_force(body.memory, y[MEMORY:], work.part)
    for j in range(6):
        work.part[j] = -work.part[j]
    give(work.force, y, rate, work.part, 6, BY_MEMORY)


@kernel(inline=True)
def load(body, wind, current, hull, t, y, rate, work):
    """Waves, drift, what is given, wind and current, each grown by the ramp; hull : HullWater, or None"""
    if work.window.shape[1] > 1:
        between_samples(work.window, (t - work.span[0]) / work.span[1] + EDGE, work.weights, work.waves)
        grown = ramp(t - body.wave_ramp[0], body.wave_ramp[1])
        for j in range(6):
            work.part[j] = grown * work.waves[j]
        give(work.force, y, rate, work.part, 6, BY_WAVES)
        on_ring(body.drift_damping, y[14], work.weights, work.drag)
        cos, sin = np.cos(y[14]), np.sin(y[14])
        u, v = cos * y[15] + sin * y[16], -sin * y[15] + cos * y[16]
        grown, d, w = grown * grown, work.drag, work.waves
        add_horizontal(
            work, y, rate, grown * (w[6] - d[0] * u - d[1] * v), grown * (w[7] - d[2] * u - d[3] * v),
            grown * (w[8] - d[4] * u - d[5] * v), BY_DRIFT,
        )  # fmt: skip
    if hull is not None:
        work.moving[0], work.moving[1], work.moving[2], work.moving[3] = y[5], y[6], y[7], y[11]
        hull_water_force(hull, ramp(t, body.ramp), work.moving, work.weights, work.powers, work.stream, work.arm)
        x, across, lever = work.stream[0], work.stream[1], hull.lever
        work.part[0], work.part[1], work.part[2] = x, across, 0.0
        work.part[3], work.part[4], work.part[5] = lever * across, -lever * x, work.stream[2]
        give(work.force, y, rate, work.part, 6, BY_CURRENT)
        add_horizontal(work, y, rate, work.arm[0], work.arm[1], work.arm[2], BY_DRIFT)
    if body.given.shape[1] > 1:
        between_samples(body.given, t / body.given_step, work.weights, work.part)
        share = ramp(t, body.ramp)
        for j in range(6):
            work.part[j] *= share
        give(work.force, y, rate, work.part, 6, BY_GIVEN)
    share = ramp(t, body.ramp)
    stream_force(wind, t, share, y[5:8], work.weights, work.part, work.value)
    give(work.force, y, rate, work.part, 6, BY_WIND)
    stream_force(current, t, share, y[5:8], work.weights, work.part, work.value)
    give(work.force, y, rate, work.part, 6, BY_CURRENT)


@kernel()
def rates(scene, buoy, t, y, rate):
    """rate (n,) of the state y (n,) of a `Scene` at t s; returns whether every line has a force.

    buoy : (Buoy, BuoyWork), None where there is none, and then nothing of it is compiled
    """
    work = scene.work
    rate[:] = 0.0
    work.force[:] = 0.0
    restore(scene.body, y, rate, work)
    dissipate(scene.body, y, rate, work)
    load(scene.body, scene.wind, scene.current, scene.hull, t, y, rate, work)
    scene.line_work.span[0] = t
    good = line_loads(scene.lines, scene.line_work, y[:6], work.R, work.part)
    give(work.force, y, rate, work.part, 6, BY_LINES)
    if len(scene.contacts.numbers):
        contact_loads(scene.contacts, scene.contact_work, y[:6], work.R, work.stream, work.arm)
        give(work.force, y, rate, scene.contact_work.parts[0], 6, BY_FENDERS)
        give(work.force, y, rate, scene.contact_work.parts[1], 6, BY_ROPES)
    if buoy is not None:
        body, (floating, kept) = scene.body, buoy
        grown, share = ramp(t - body.wave_ramp[0], body.wave_ramp[1]), ramp(t, body.ramp)
        at, place = (t - work.span[0]) / work.span[1] + EDGE, y[FLOAT : FLOAT + 6]
        good = buoy_rates(floating, kept, y, place, work.R, at, share, grown, rate[FLOAT : FLOAT + 6]) and good
        give(work.force, y, rate, kept.part, 6, BY_HAWSERS)
    cos, sin = np.cos(y[5]), np.sin(y[5])
    rate[0], rate[1] = cos * y[6] - sin * y[7], sin * y[6] + cos * y[7]
    for j in range(2, 6):
        rate[j] = y[6 + j]
    for i in range(6):
        total = 0.0
        for j in range(6):
            total += scene.body.mass_inverse[i, j] * work.force[j]
        rate[6 + i] = total
    c = scene.body.filter_rate
    for j in range(3):
        at = 5 if j == 2 else j
        rate[SLOW + j] = y[SLOW_RATE + j]
        rate[SLOW_RATE + j] = c * c * (y[at] - y[SLOW + j]) - 2 * c * y[SLOW_RATE + j]
    return good
