"""A body and its buoy in one equation, compiled: slow motion of the body, all motion of the buoy, hawsers that snap.

    body    T ν̇ = F_water + F_wind + F_drift + Σ hawsers    in the plane (`slewing`); its wave motion is given
    buoy    (m + C_a ρ∇) ẇ = (1 + C_a) ρ∇ a + ½ρC_dA |q − w|(q − w) + buoyancy − weight + lines − Σ hawsers
    hawser  T = B (e/(L ε_B))ⁿ + c ė where it is longer than L, never below 0; 0 where it is shorter

q, a are velocity and acceleration of the water at the buoy, B, ε_B and n those of a rope (`mooring.lines.ropes`), lines
in their static form (`mooring.motion.line_loads`).  The body's wave motion is that of the free body, given in time: its
mass is far above the buoy's.  State: x, y, ψ, u, v, r of the body, place and velocity of the buoy in space.
Runge and Kutta's method of fourth order in equal steps; the largest tension of the steps between two samples is kept.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from ..motion.interpolation import EDGE, between_samples, on_ring
from ..motion.line_loads import line_loads
from ..motion.streams import Stream, stream_force

STATE = 12


class Floating(NamedTuple):
    """The body.  water : (RING + 3, 15) N over V^(2−k)(rL)ᵏ, rows of a ring; largest : rL/V; current : (2,) m/s

    turning : 1 for turning tests, or 0; quadratic : N₂ of yaw; linear : (3, 3); drift : (n + 3, 3) N, N m over headings
    mass, inverse : (3, 3); ends : (k, 3) m, of the hawsers, their height over the centre of
    mass; ropes : (k, 5) L, B, ε_B, n and c, N s/m; level : m, height of the buoy at which they lie level
    """

    water: np.ndarray
    length: float
    largest: float
    current: np.ndarray
    turning: float
    quadratic: float
    linear: np.ndarray
    drift: np.ndarray
    wind: Stream
    mass: np.ndarray
    inverse: np.ndarray
    ends: np.ndarray
    ropes: np.ndarray
    level: float


class Buoy(NamedTuple):
    """inverse : (3,) 1/kg, of mass and added mass; moved : (3,) kg, (1 + C_a) ρ∇; drag : (3,) ½ρC_dA, kg/m

    weight : N; stiffness : ρgA, N/m; draft, height : m, floating free of lines
    """

    inverse: np.ndarray
    moved: np.ndarray
    drag: np.ndarray
    weight: float
    stiffness: float
    draft: float
    height: float


class Sea(NamedTuple):
    """motion : (12, m) m, rad and rates of the free body's wave motion; water : (7, m) elevation, velocity and
    acceleration of the water at the buoy; both in equal steps from EDGE steps before 0 s; one column for none"""

    motion: np.ndarray
    water: np.ndarray
    step: float


class Room(NamedTuple):
    """Room for work of one evaluation"""

    c15: np.ndarray
    c3: np.ndarray
    weights: np.ndarray
    quintic: np.ndarray
    value: np.ndarray
    motion: np.ndarray
    water: np.ndarray
    force: np.ndarray
    buoy: np.ndarray
    place: np.ndarray
    R: np.ndarray
    moving: np.ndarray
    pull: np.ndarray
    lines: np.ndarray
    rope: np.ndarray


def room(hawsers):
    """`Room` for so many hawsers"""
    sizes = (15, 3, 4, 6, 1, 12, 7, 3, 3, 6)
    return Room(
        *(np.zeros(n) for n in sizes), np.zeros((3, 3)), np.zeros(3), np.zeros(6), np.zeros(6), np.zeros(hawsers)
    )


@kernel()
def hydrodynamic(body, y, room, out):
    """Add force and moment of the water to out (3,)"""
    u, v, r = y[3], y[4], y[5]
    V = np.sqrt(u * u + v * v)
    if V > 0.0:
        on_ring(body.water, np.arctan2(-v, -u), room.weights, room.c15)
        s = min(max(r * body.length, -body.largest * V), body.largest * V) / V
        for j in range(3):
            c = room.c15
            out[j] += V * V * (c[j] + s * (c[3 + j] + s * (c[6 + j] + s * (c[9 + j] + s * c[12 + j]))))
    out[2] -= body.quadratic * r * abs(r)
    for j in range(3):
        out[j] -= body.linear[j, 0] * u + body.linear[j, 1] * v + body.linear[j, 2] * r
    if body.turning == 0.0:
        along = body.mass[0, 0] * u + body.mass[0, 1] * v + body.mass[0, 2] * r
        across = body.mass[1, 0] * u + body.mass[1, 1] * v + body.mass[1, 2] * r
        out[0] += across * r
        out[1] -= along * r


@kernel()
def pull_of_rope(rope, stretch, rate):
    """N, of (L, B, ε_B, n, c) at an elongation, m, and its rate, m/s"""
    if stretch <= 0.0:
        return 0.0
    return max(rope[1] * (stretch / (rope[0] * rope[2])) ** rope[3] + rope[4] * rate, 0.0)


@kernel()
def hawsers(body, y, room, cos, sin):
    """Pull of the hawsers: room.pull (6,) force on the body in space, its moment, force on the buoy; room.rope (k,)"""
    w = room.motion
    room.pull[:] = 0.0
    psi = y[2] + w[5]
    c, s = np.cos(psi), np.sin(psi)
    ux, uy = cos * y[3] - sin * y[4] + body.current[0], sin * y[3] + cos * y[4] + body.current[1]
    for i in range(body.ends.shape[0]):
        px, py, lever = body.ends[i]
        up = w[2] + py * w[3] - px * w[4]
        px, py = px + lever * w[4], py - lever * w[3]
        ax, ay = c * px - s * py, s * px + c * py
        x = y[0] + cos * w[0] - sin * w[1] + ax
        z = y[1] + sin * w[0] + cos * w[1] + ay
        dx, dy, dz = y[6] - x, y[7] - z, y[8] - body.level - up
        distance = np.sqrt(dx * dx + dy * dy + dz * dz)
        room.rope[i] = 0.0
        if distance <= body.ropes[i, 0]:
            continue
        dx, dy, dz = dx / distance, dy / distance, dz / distance
        r = y[5] + w[11]
        vx = ux + cos * w[6] - sin * w[7] - r * ay
        vy = uy + sin * w[6] + cos * w[7] + r * ax
        vz = w[8] + py * w[9] - px * w[10]
        rate = dx * (y[9] - vx) + dy * (y[10] - vy) + dz * (y[11] - vz)
        T = pull_of_rope(body.ropes[i], distance - body.ropes[i, 0], rate)
        room.rope[i] = T
        room.pull[0] += T * dx
        room.pull[1] += T * dy
        room.pull[2] += T * (ax * dy - ay * dx)
        room.pull[3] -= T * dx
        room.pull[4] -= T * dy
        room.pull[5] -= T * dz


@kernel()
def floats(buoy, y, room):
    """Add buoyancy, weight, drag and inertia of the water to room.buoy (3,)"""
    w = room.water
    for j in range(3):
        relative = w[1 + j] - y[9 + j]
        room.buoy[j] += buoy.moved[j] * w[4 + j] + buoy.drag[j] * relative * abs(relative)
    immersed = min(max(buoy.draft + w[0] - y[8], 0.0), buoy.height)
    room.buoy[2] += buoy.stiffness * immersed - buoy.weight


@kernel()
def rates(body, buoy, lines, work, sea, room, t, y, out):
    """out (12,) rates of the state y (12,) at t s; returns whether all lines have a force

    The height of the buoy, y[8], counts from where it floats free of lines.
    """
    cos, sin = np.cos(y[2]), np.sin(y[2])
    if sea.motion.shape[1] > 1:
        between_samples(sea.motion, t / sea.step + EDGE, room.quintic, room.motion)
        between_samples(sea.water, t / sea.step + EDGE, room.quintic, room.water)
    room.force[:] = 0.0
    hydrodynamic(body, y, room, room.force)
    room.moving[0] = y[2]
    room.moving[1] = y[3] + cos * body.current[0] + sin * body.current[1]
    room.moving[2] = y[4] - sin * body.current[0] + cos * body.current[1]
    stream_force(body.wind, t, 1.0, room.moving, room.weights, room.quintic, room.c3, room.value)
    for j in range(3):
        room.force[j] += room.c3[j]
    on_ring(body.drift, y[2], room.weights, room.c3)
    for j in range(3):
        room.force[j] += room.c3[j]
    hawsers(body, y, room, cos, sin)
    room.force[0] += cos * room.pull[0] + sin * room.pull[1]
    room.force[1] += -sin * room.pull[0] + cos * room.pull[1]
    room.force[2] += room.pull[2]
    room.place[:] = 0.0
    for j in range(3):
        room.place[j] = y[6 + j]
    good = line_loads(lines, work, room.place, room.R, room.lines)
    for j in range(3):
        room.buoy[j] = room.lines[j] + room.pull[3 + j]
    floats(buoy, y, room)
    out[0] = cos * y[3] - sin * y[4] + body.current[0]
    out[1] = sin * y[3] + cos * y[4] + body.current[1]
    out[2] = y[5]
    for i in range(3):
        total = 0.0
        for j in range(3):
            total += body.inverse[i, j] * room.force[j]
        out[3 + i] = total
        out[6 + i] = y[9 + i]
        out[9 + i] = buoy.inverse[i] * room.buoy[i]
    return good


@kernel()
def steps(body, buoy, lines, work, sea, room, y, h, every, samples, tensions):
    """Fill samples (n, 12) and tensions (n, k + lines): the largest since the sample before; returns rows that are good

    y (12,) : state at 0 s, moved on; h : s; every : steps from one sample to the next
    """
    k = np.zeros((4, STATE))
    trial = np.zeros(STATE)
    count = body.ends.shape[0]
    for n in range(samples.shape[0]):
        samples[n] = y
        tensions[n] = 0.0
        for m in range(every):
            t = (n * every + m) * h
            good = rates(body, buoy, lines, work, sea, room, t, y, k[0])
            for i in range(count):
                tensions[n, i] = max(tensions[n, i], room.rope[i])
            for i in range(work.tension.shape[0]):
                tensions[n, count + i] = max(tensions[n, count + i], np.hypot(work.tension[i, 0], work.tension[i, 1]))
            for s in range(1, 4):
                step = h if s == 3 else 0.5 * h
                for i in range(STATE):
                    trial[i] = y[i] + step * k[s - 1, i]
                good = rates(body, buoy, lines, work, sea, room, t + step, trial, k[s]) and good
            if not good or not np.isfinite(k[3, 0] + k[3, 9]):
                return n
            for i in range(STATE):
                y[i] += h / 6.0 * (k[0, i] + 2.0 * k[1, i] + 2.0 * k[2, i] + k[3, i])
    return samples.shape[0]
