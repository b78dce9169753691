"""The equation of motion of a body in time, and the powers of all forces on it, compiled.

    (M + A∞) ν̇ + C(νₛ) ν + ∫₀ᵗ K(t−τ) ν(τ) dτ + B′ν + N₂ν|ν| + C η
        = F₁ + F₂ + F_wind + F_current + F_lines + F_fenders + F_ropes + F_given

η = (x, y, z, φ, θ, ψ): displacement of the rotation centre from rest, in space; roll and pitch; and the heading,
which is unlimited. The velocities ν = (u, v, w, φ̇, θ̇, ψ̇), forces and memory are in axes that turn with the
heading. νₛ is the slow velocity after the filter below; the centripetal forces of wave-frequency motion are part of
the drift. C(νₛ) is skew, so it does no work. In a current, Munk's moment on the added mass is part of the current
coefficients and is not included in C.  Hinges between bodies (`links`) add their constraint forces. The memory is a
linear system with the input ν (`bem.time_domain.memory`).  A buoy with mass between hawsers and lines of its own
(`buoy`) and a hull that slews in a current (`tables.hull_water`) are terms of the same equation. Filter of the slow
pose:  s̈ = ωc² (p − s) − 2 ωc ṡ  for x, y and ψ.

State of a body: η (6), ν (6), slow pose (3) and its rate (3), and the work done on the body by each of WORKS, J. The
full state contains the states of all bodies, one after another, then displacement (3) and velocity (3) of a buoy in
space, then the memory of all bodies. N bodies have one equation: M + A∞ and B′ are (6N, 6N), and the memory couples
all bodies. Lines, fenders and ropes between two bodies act on both with opposite signs. ψ is the heading of each
body; it need not be 0 at rest.

Flexible bodies also have shapes with amplitudes ξ. Shapes obey this equation without its terms of slow motion: mass,
memory, damping and restoring forces couple all motions, and first-order waves act at the slow pose of the body. The
force f of a line, fender or rope at a point p acts on a shape by Q_k = f · R u_k(p); shapes move the point by Σ ξ_k
R u_k(p). Shapes are in G groups of six; each group belongs to one body and is filled up with empty motions. For each
group the state contains ξ (6) and ξ̇ (6), which stand before the memory. Force vectors contain six numbers for each
group, which stand after those of all bodies.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.time_domain.memory_kernels import MemoryArrays, memory_force, memory_rate

from .buoy import buoy_rates
from .contact_loads import Contacts, ContactWork, contact_loads
from .line_loads import Lines, LineWork, line_loads
from .links import hold_together
from .streams import Stream, stream_force
from .tables.hull_water import HullWater, hull_water_force
from .tables.interpolation import EDGE, between_samples, on_ring
from .tables.wave_windows import ROWS

WORKS = ("waves", "drift", "wind", "current", "lines", "memory", "damping", "given", "fenders", "ropes",
         "hawsers")  # fmt: skip
BY_WAVES, BY_DRIFT, BY_WIND, BY_CURRENT, BY_LINES, BY_MEMORY, BY_DAMPING, BY_GIVEN, BY_FENDERS, BY_ROPES = range(10)
BY_HAWSERS = 10
SLOW, SLOW_RATE, FIRST_WORK = 12, 15, 18  # offsets of the parts of a body's state
BLOCK = 18 + len(WORKS)  # numbers of it
SAMPLED = 18  # number of stored states
OF_SHAPES = 12  # numbers of the state of a group of shapes


class Shapes(NamedTuple):
    """The f shapes of flexible bodies, in G groups of six.

    owner : (G,) number of the body of each group; place : (f,) number of each shape among the 6G
    stiffness : (6N + 6G, 6N + 6G), restoring forces on shapes, and of shapes on bodies; 0 between bodies
    """

    owner: np.ndarray
    place: np.ndarray
    stiffness: np.ndarray


@in_memory
class Body(NamedTuple):
    """Constants of the equation of N bodies, with n = 6N + 6G motions, G groups of shapes.

    mass_inverse : inverse of M + A∞, (n, n); rigid, slow : M of each body, and its added mass in slow motion, (N, 6,
        6)
    stiffness : hydrostatic stiffness for η in heading axes, (N, 6, 6); spring : stiffness for η in space axes, (N,
        6, 6)
    damping : (n, n) B′; quadratic : (n,) N₂; heading : (N,) rad, ψ at rest
    filter_rate : ωc, rad/s; ramp : s; munk : 1, or 0 where Munk's moment is part of the current coefficients
    wave_ramp : start of the waves and duration of their growth, (2,) s
    memory : `bem.time_domain.memory_kernels.MemoryArrays`
    drift_damping : (N, HEADINGS + 3, 6) B over headings ψ, rows of `interpolation.ring_table`; N s/m by (surge, sway)
    given : (6N, m) N and N m in heading axes, forces over time, from 0 s in steps of given_step s; one column for none
    bent : `Shapes`, or None for rigid bodies, for which no code of shapes is compiled
    """

    mass_inverse: np.ndarray
    rigid: np.ndarray
    slow: np.ndarray
    stiffness: np.ndarray
    spring: np.ndarray
    damping: np.ndarray
    quadratic: np.ndarray
    heading: np.ndarray
    filter_rate: float
    ramp: float
    wave_ramp: np.ndarray
    munk: float
    memory: MemoryArrays
    drift_damping: np.ndarray
    given: np.ndarray
    given_step: float
    shapes: Shapes
    bent: Shapes | None


@in_memory
class Work(NamedTuple):
    """Work arrays of one evaluation, and the window of wave forces in use.

    window : (N + G, ROWS, m); span : start and step of the window, s; force : (6N + 6G,); part : (6,); R : (N, 3, 3)
    place, pull : displacements, and forces of lines, (N, 6)
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
    place: np.ndarray
    pull: np.ndarray


@in_memory
class Scene(NamedTuple):
    """All loads on a body, and work arrays: the arguments of `rates` besides time and state"""

    body: Body
    lines: Lines
    line_work: LineWork
    wind: Stream
    current: Stream
    contacts: Contacts
    contact_work: ContactWork
    hull: HullWater | None  # of a single body that slews
    work: Work


def room(columns, bodies=1, groups=0):
    """`Work` for windows with a given number of columns"""
    both = bodies + groups
    return Work(
        np.zeros((both, ROWS, columns)), np.zeros(2), np.zeros(6 * both), np.zeros(6), np.zeros(3), np.zeros(ROWS),
        np.zeros(6), np.zeros(1), np.zeros(6), np.zeros((bodies, 3, 3)), np.zeros(3), np.zeros(4), np.zeros(15),
        np.zeros((bodies, 6)), np.zeros((bodies, 6)),
    )  # fmt: skip


def buoy_at(bodies):
    """Index in the state at which the buoy begins"""
    return BLOCK * bodies


def shapes_at(bodies):
    """Index in the state at which the groups of shapes begin"""
    return BLOCK * bodies + 6


def memory_at(bodies, groups=0):
    """Index in the state at which the memory begins"""
    return BLOCK * bodies + 6 + OF_SHAPES * groups


def blocks(state, bodies):
    """Blocks of a state (n,), one for each body; shape (N, BLOCK)"""
    return state[: BLOCK * bodies].reshape(bodies, BLOCK)


@kernel(inline=True, counted=False)
def ramp(t, length):
    """Factor on the loads at time t, s, in a ramp: from 0 to 1, with continuous slope and curvature"""
    if length <= 0.0 or t >= length:
        return 1.0
    s = max(t / length, 0.0)
    return s * s * s * (10.0 - s * (15.0 - 6.0 * s))


@kernel(inline=True, counted=False)
def give(force, y, rate, part, count, number):
    """Add the first `count` numbers of a part to the force, and its power to the rate of its work."""
    power = 0.0
    for j in range(count):
        force[j] += part[j]
        power += part[j] * y[6 + j]
    rate[FIRST_WORK + number] += power


@kernel(inline=True, counted=False)
def add_horizontal(force, y, rate, x, y_force, moment, number):
    """Add a surge and sway force and a yaw moment"""
    force[0] += x
    force[1] += y_force
    force[5] += moment
    rate[FIRST_WORK + number] += x * y[6] + y_force * y[7] + moment * y[11]


@kernel(counted=False)
def restore(body, b, y, rate, force, work):
    """Hydrostatic and spring forces on body b, and the forces due to its turning axes.

    In a current, the work of the forces due to turning axes counts as work of the current.
    y, rate : (BLOCK,), and force : (6,), of body b
    """
    cos, sin = np.cos(y[5]), np.sin(y[5])
    for i in range(6):
        total = 0.0
        for j in range(2, 5):
            total += body.stiffness[b, i, j] * y[j]
        force[i] -= total
    for j in range(6):
        work.drag[j] = y[j]
    work.drag[5] -= body.heading[b]
    for i in range(6):
        total = 0.0
        for j in range(6):
            total += body.spring[b, i, j] * work.drag[j]
        work.part[i] = -total
    force[0] += cos * work.part[0] + sin * work.part[1]
    force[1] += -sin * work.part[0] + cos * work.part[1]
    for i in range(2, 6):
        force[i] += work.part[i]
    u, v, r = cos * y[15] + sin * y[16], -sin * y[15] + cos * y[16], y[17]
    along = body.rigid[b, 0, 0] * u + body.rigid[b, 0, 1] * v + body.rigid[b, 0, 5] * r
    across = body.rigid[b, 1, 0] * u + body.rigid[b, 1, 1] * v + body.rigid[b, 1, 5] * r
    water_along = body.slow[b, 0, 0] * u + body.slow[b, 0, 1] * v + body.slow[b, 0, 5] * r
    water_across = body.slow[b, 1, 0] * u + body.slow[b, 1, 1] * v + body.slow[b, 1, 5] * r
    moment = (along + body.munk * water_along) * y[7] - (across + body.munk * water_across) * y[6]
    add_horizontal(force, y, rate, (across + water_across) * y[11], -(along + water_along) * y[11], moment, BY_CURRENT)


@kernel(counted=False)
def dissipate(body, b, whole, changed, y, rate, force, work):
    """Linear and quadratic damping of body b, and the memory of the water with the rates of its states

    whole : (n,) state of all bodies; changed : (n,) its rates; y, rate, force : state, rates and force of this body
    """
    memory = BLOCK * body.heading.size + 6 + OF_SHAPES * body.shapes.owner.size
    for i in range(6):
        total = body.quadratic[6 * b + i] * y[6 + i] * abs(y[6 + i])
        for j in range(6):
            total += body.damping[6 * b + i, 6 * b + j] * y[6 + j]
        work.part[i] = -total
    for c in range(body.heading.size):
        if c != b:
            for i in range(6):
                for j in range(6):
                    work.part[i] -= body.damping[6 * b + i, 6 * c + j] * whole[BLOCK * c + 6 + j]
    give(force, y, rate, work.part, 6, BY_DAMPING)
    memory_rate(body.memory, whole[memory:], y[6:12], changed[memory:], b)
    memory_force(body.memory, whole[memory:], work.part, b)
    for j in range(6):
        work.part[j] = -work.part[j]
    give(force, y, rate, work.part, 6, BY_MEMORY)


@kernel(counted=False)
def load(scene, hull, b, t, y, rate, force, work):
    """Waves, drift, given forces, wind and current on body b of a `Scene`, each multiplied by the ramp

    hull : HullWater, or None; y, rate : (BLOCK,), and force : (6,), of body b
    """
    body = scene.body
    if work.window.shape[2] > 1:
        between_samples(work.window[b], (t - work.span[0]) / work.span[1] + EDGE, work.weights, work.waves)
        grown = ramp(t - body.wave_ramp[0], body.wave_ramp[1])
        for j in range(6):
            work.part[j] = grown * work.waves[j]
        give(force, y, rate, work.part, 6, BY_WAVES)
        on_ring(body.drift_damping[b], y[14], work.weights, work.drag)
        cos, sin = np.cos(y[14]), np.sin(y[14])
        u, v = cos * y[15] + sin * y[16], -sin * y[15] + cos * y[16]
        grown, d, w = grown * grown, work.drag, work.waves
        add_horizontal(
            force, y, rate, grown * (w[6] - d[0] * u - d[1] * v), grown * (w[7] - d[2] * u - d[3] * v),
            grown * (w[8] - d[4] * u - d[5] * v), BY_DRIFT,
        )  # fmt: skip
    if hull is not None:
        work.moving[0], work.moving[1], work.moving[2], work.moving[3] = y[5], y[6], y[7], y[11]
        hull_water_force(hull, ramp(t, body.ramp), work.moving, work.weights, work.powers, work.stream, work.arm)
        x, across, lever = work.stream[0], work.stream[1], hull.lever
        work.part[0], work.part[1], work.part[2] = x, across, 0.0
        work.part[3], work.part[4], work.part[5] = lever * across, -lever * x, work.stream[2]
        give(force, y, rate, work.part, 6, BY_CURRENT)
        add_horizontal(force, y, rate, work.arm[0], work.arm[1], work.arm[2], BY_DRIFT)
    if body.given.shape[1] > 1:
        between_samples(body.given[6 * b : 6 * b + 6], t / body.given_step, work.weights, work.part)
        share = ramp(t, body.ramp)
        for j in range(6):
            work.part[j] *= share
        give(force, y, rate, work.part, 6, BY_GIVEN)
    share = ramp(t, body.ramp)
    stream_force(scene.wind, b, t, share, y[5:8], work.weights, work.part, work.value)
    give(force, y, rate, work.part, 6, BY_WIND)
    stream_force(scene.current, b, t, share, y[5:8], work.weights, work.part, work.value)
    give(force, y, rate, work.part, 6, BY_CURRENT)


@kernel(counted=False)
def of_one(scene, b, t, y, rate):
    """All loads on body b of a `Scene` except its moorings; y, rate : (n,), of all bodies

    Slices are made in this function and in those it calls, because in a loop over bodies the compiler would count
    references.
    """
    work, first = scene.work, BLOCK * b
    own, changed, force = y[first : first + BLOCK], rate[first : first + BLOCK], work.force[6 * b : 6 * b + 6]
    restore(scene.body, b, own, changed, force, work)
    dissipate(scene.body, b, y, rate, own, changed, force, work)
    load(scene, scene.hull, b, t, own, changed, force, work)


@kernel(inline=True, counted=False)
def give_to(work, b, y, rate, parts, number):
    """Call `give` for body b of several, with row b of parts (N, 6); number : kind of load; y, rate : (n,), of all"""
    first = BLOCK * b
    give(work.force[6 * b : 6 * b + 6], y[first : first + BLOCK], rate[first : first + BLOCK], parts[b], 6, number)


@kernel(counted=False)
def move(body, b, y, rate, force):
    """Rates of the motions and of the slow pose of body b, from the forces (6N,) on all bodies; y, rate : (n,), of
    all bodies
    """
    first, c = BLOCK * b, body.filter_rate
    own, changed = y[first : first + BLOCK], rate[first : first + BLOCK]
    cos, sin = np.cos(own[5]), np.sin(own[5])
    changed[0], changed[1] = cos * own[6] - sin * own[7], sin * own[6] + cos * own[7]
    for j in range(2, 6):
        changed[j] = own[6 + j]
    for i in range(6):
        total = 0.0
        for j in range(force.size):
            total += body.mass_inverse[6 * b + i, j] * force[j]
        changed[6 + i] = total
    for j in range(3):
        at = 5 if j == 2 else j
        changed[SLOW + j] = own[SLOW_RATE + j]
        changed[SLOW_RATE + j] = c * c * (own[at] - own[SLOW + j]) - 2 * c * own[SLOW_RATE + j]


@kernel(counted=False)
def of_shapes_on_body(body, b, y, rate, force, work):
    """Restoring forces and damping that shapes exert on body b; y, rate : (n,) of all bodies, force : (6,) on body b"""
    count, first = body.heading.size, BLOCK * b
    K, B = body.shapes.stiffness, body.damping
    for i in range(6):
        pull = drag = 0.0
        for h in range(body.shapes.owner.size):
            at, column = BLOCK * count + 6 + OF_SHAPES * h, 6 * (count + h)
            for j in range(6):
                pull += K[6 * b + i, column + j] * y[at + j]
                drag += B[6 * b + i, column + j] * y[at + 6 + j]
        force[i] -= pull
        work.part[i] = -drag
    give(force, y[first : first + BLOCK], rate[first : first + BLOCK], work.part, 6, BY_DAMPING)


@kernel(counted=False)
def of_group(scene, g, t, y, rate):
    """All loads on group g of the shapes of a `Scene` except moorings; y, rate : (n,), of all bodies

    The work of a load on shapes is added to the work of this load on their body.
    """
    work, body = scene.work, scene.body
    count, K, B = body.heading.size, body.shapes.stiffness, body.damping
    b, memory = count + g, BLOCK * count + 6 + OF_SHAPES * body.shapes.owner.size
    at, works = BLOCK * count + 6 + OF_SHAPES * g, BLOCK * body.shapes.owner[g]
    own, force, done = y[at : at + OF_SHAPES], work.force[6 * b : 6 * b + 6], rate[works : works + BLOCK]
    for i in range(6):
        row, pull, drag = 6 * b + i, 0.0, body.quadratic[6 * b + i] * own[6 + i] * abs(own[6 + i])
        for c in range(count):
            x, across, turned = y[BLOCK * c], y[BLOCK * c + 1], y[BLOCK * c + 5] - body.heading[c]
            cos, sin = np.cos(y[BLOCK * c + 5]), np.sin(y[BLOCK * c + 5])
            pull += K[row, 6 * c] * (cos * x + sin * across) + K[row, 6 * c + 1] * (cos * across - sin * x)
            pull += K[row, 6 * c + 5] * turned
            for j in range(2, 5):
                pull += K[row, 6 * c + j] * y[BLOCK * c + j]
            for j in range(6):
                drag += B[row, 6 * c + j] * y[BLOCK * c + 6 + j]
        for h in range(body.shapes.owner.size):
            from_it, column = BLOCK * count + 6 + OF_SHAPES * h, 6 * (count + h)
            for j in range(6):
                pull += K[row, column + j] * y[from_it + j]
                drag += B[row, column + j] * y[from_it + 6 + j]
        force[i] -= pull
        work.part[i] = -drag
    give(force, own, done, work.part, 6, BY_DAMPING)
    memory_rate(body.memory, y[memory:], own[6:12], rate[memory:], b)
    memory_force(body.memory, y[memory:], work.part, b)
    for j in range(6):
        work.part[j] = -work.part[j]
    give(force, own, done, work.part, 6, BY_MEMORY)
    if work.window.shape[2] > 1:
        between_samples(work.window[b], (t - work.span[0]) / work.span[1] + EDGE, work.weights, work.waves)
        grown = ramp(t - body.wave_ramp[0], body.wave_ramp[1])
        for j in range(6):
            work.part[j] = grown * work.waves[j]
        give(force, own, done, work.part, 6, BY_WAVES)


@kernel(counted=False)
def of_shapes(shapes, scene, t, y, rate):
    """All loads on the shapes of a `Scene` except moorings, and the forces of shapes on bodies; y, rate : (n,), of
    all bodies
    """
    if shapes is not None:
        body, force = scene.body, scene.work.force
        for b in range(body.heading.size):
            of_shapes_on_body(body, b, y, rate, force[6 * b : 6 * b + 6], scene.work)
        for g in range(shapes.owner.size):
            of_group(scene, g, t, y, rate)


@kernel(counted=False)
def of_moorings_on_shapes(shapes, scene, y, rate, met):
    """Add the forces of lines on shapes, and if `met` those of fenders and ropes, to the forces and the rates of
    work
    """
    if shapes is None:
        return
    count = scene.body.heading.size
    for k in range(shapes.place.size):
        g, i = shapes.place[k] // 6, shapes.place[k] % 6
        at, works = BLOCK * count + 6 + OF_SHAPES * g + 6 + i, BLOCK * shapes.owner[g] + FIRST_WORK
        pull = scene.line_work.push[k]
        scene.work.force[6 * count + shapes.place[k]] += pull
        rate[works + BY_LINES] += pull * y[at]
        if met:
            pressed, roped = scene.contact_work.push[0, k], scene.contact_work.push[1, k]
            scene.work.force[6 * count + shapes.place[k]] += pressed + roped
            rate[works + BY_FENDERS] += pressed * y[at]
            rate[works + BY_ROPES] += roped * y[at]


@kernel(counted=False)
def move_shapes(shapes, body, y, rate, force):
    """Rates of all shapes from the forces (n,) on all motions; y, rate : (n,), of all bodies"""
    if shapes is None:
        return
    count = body.heading.size
    for g in range(shapes.owner.size):
        at = BLOCK * count + 6 + OF_SHAPES * g
        for i in range(6):
            rate[at + i] = y[at + 6 + i]
            total = 0.0
            for j in range(force.size):
                total += body.mass_inverse[6 * (count + g) + i, j] * force[j]
            rate[at + 6 + i] = total


@kernel(counted=False)
def of_moorings(scene, y, rate):
    """Add the forces of lines, fenders and ropes of a `Scene` on its bodies, and the rates of their work (n,)

    returns : whether every line has a force
    """
    work, count = scene.work, scene.body.heading.size
    for b in range(count):
        for j in range(6):
            work.place[b, j] = y[BLOCK * b + j]
    place = scene.body.shapes.place
    for k in range(place.size):
        bent = y[BLOCK * count + 6 + OF_SHAPES * (place[k] // 6) + place[k] % 6]
        scene.line_work.bent[k] = bent
        scene.contact_work.bent[k] = bent
    good = line_loads(scene.lines, scene.line_work, work.place, work.R, work.pull)
    met = len(scene.contacts.numbers) > 0
    if met:
        contact_loads(scene.contacts, scene.contact_work, work.place, work.R, work.stream, work.arm)
    of_moorings_on_shapes(scene.body.bent, scene, y, rate, met)
    for b in range(count):
        give_to(work, b, y, rate, work.pull, BY_LINES)
        if met:
            give_to(work, b, y, rate, scene.contact_work.parts[0], BY_FENDERS)
            give_to(work, b, y, rate, scene.contact_work.parts[1], BY_ROPES)
    return good


@kernel(counted=False)
def of_links_on_shapes(body, held, kept, y):
    """Copy amplitudes and rates of the shapes from the state y (n,) into the `LinkWork` of Links"""
    count = body.heading.size
    for s in range(held.shapes.size):
        n = held.shapes[s] - 6 * count
        at = BLOCK * count + 6 + OF_SHAPES * (n // 6) + n % 6
        kept.amplitude[s], kept.speed[held.shapes[s]] = y[at], y[at + 6]


@kernel(counted=False)
def of_links(scene, links, y, rate):
    """Add the forces of hinges between the bodies of a `Scene` in the state y (n,).

    The work of their dampers and springs, in the rates (n,), counts as work of the damping
    """
    held, kept = links
    for b in range(scene.body.heading.size):
        for j in range(6):
            kept.speed[6 * b + j] = y[BLOCK * b + 6 + j]
    of_links_on_shapes(scene.body, held, kept, y)
    hold_together(held, kept, scene.work.place, scene.body.mass_inverse, scene.work.force)
    for k in range(held.ends.shape[0]):
        for e in range(2):
            b = held.ends[k, e]
            if b >= 0:
                for j in range(6):
                    power = kept.pull[k] * kept.pulled[k, 6 * e + j] * y[BLOCK * b + 6 + j]
                    rate[BLOCK * b + FIRST_WORK + BY_DAMPING] += power
        for s in range(held.shapes.size):
            owner = scene.body.shapes.owner[(held.shapes[s] - 6 * scene.body.heading.size) // 6]
            power = kept.pull[k] * kept.pulled_by[k, s] * kept.speed[held.shapes[s]]
            rate[BLOCK * owner + FIRST_WORK + BY_DAMPING] += power


@kernel(counted=False)
def rates(scene, buoy, links, t, y, rate):
    """Fill rate (n,) of the state y (n,) of a `Scene` at t s; returns whether every line has a force.

    buoy : (Buoy, BuoyWork) of a buoy connected to the first body; links : (`links.Links`, LinkWork).
    Either is None where there is none, and its code is then not compiled
    """
    work, body = scene.work, scene.body
    count = body.heading.size
    rate[:] = 0.0
    work.force[:] = 0.0
    for b in range(count):
        of_one(scene, b, t, y, rate)
    of_shapes(body.bent, scene, t, y, rate)
    scene.line_work.span[0] = t
    good = of_moorings(scene, y, rate)
    if buoy is not None:
        floating, kept = buoy
        grown, share = ramp(t - body.wave_ramp[0], body.wave_ramp[1]), ramp(t, body.ramp)
        first = BLOCK * count
        at, place = (t - work.span[0]) / work.span[1] + EDGE, y[first : first + 6]
        good = buoy_rates(floating, kept, y, place, work.R[0], at, share, grown, rate[first : first + 6]) and good
        give(work.force, y, rate, kept.part, 6, BY_HAWSERS)
    if links is not None:
        of_links(scene, links, y, rate)
    for b in range(count):
        move(body, b, y, rate, work.force)
    move_shapes(body.bent, body, y, rate, work.force)
    return good
