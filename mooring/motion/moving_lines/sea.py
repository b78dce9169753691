"""The sea around moving lines: sums of all waves at the positions of their nodes, for a second or two at a time.

A line-dynamics run adds up its waves at every node and stage (`lines.dynamics.lumped.surroundings.water_at`), which for
hundreds of waves costs fifty times the line itself.  Here a table contains, for six times, the velocity of the water
and its gradient at the position predicted for each node in the middle of these times. The velocity at a node at a
distance δ from the predicted position is

    u(r + δ, t) = u(r, t) + (δ·∇)u,   ∂u/∂t in the same way,   a polynomial of fifth degree in time,

with a relative error of (kδ)²/2 for each wave.  The flow has a potential: its gradient has five numbers.  The waves
are the incident ones, without those scattered by the body.

The sums are products of small matrices in single precision. Sines and exponentials are polynomials accurate to 3e-7,
so that a loop over waves becomes vector instructions: 10 ns for each wave and node in place of 35.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH

from ...lines.dynamics.lumped.surroundings import OF_PLACE, SAMPLES
from ...lines.dynamics.surroundings import flowing

TURN = 2 * np.pi
DEEPEST = -12.0  # k z, below which a wave has its value there: 6e-6 of that at the surface
PHASE, FEW = (0.3, 0.6), 40  # rad of the quickest wave between two times, of few waves and of more


@in_memory
class LineSea(NamedTuple):
    """Causes of water motion around lines.

    waves : (9, c), wavenumbers along x and y, unit vector, wavenumber, aσ over 1 − exp(−2kh), exp(−2kh), frequency ω
        at a fixed place, phase; σ is the frequency in the water, which a current makes different from ω
    factor : (2c, SAMPLES), cos ωt and sin ωt at the times of a table; step : time between these, s
    farthest : limit of the predicted motion of a node up to the middle of a table, m
    depth : m; ramp : (2,) s, begin of the waves and duration of their growth
    current : (2,) m/s, constant over the depth; current_ramp : time in which the current grows, s
    carried : velocity at which the current carries the waves, (2,) m/s
    """

    waves: np.ndarray
    factor: np.ndarray
    step: float
    farthest: float
    depth: float
    ramp: np.ndarray
    current: np.ndarray
    current_ramp: float
    carried: np.ndarray


def line_sea(components, number, depth, current, wave_ramp, ramp, carried=(0.0, 0.0)):
    """`LineSea` of wave components (`mooring.environment.sea.Components`), or of no waves, None

    number : wavenumbers of the components along x and y, (2, c) rad/m; depth : m; current : (2,) m/s or None
    carried : velocity at which the current carries the waves, (2,) m/s, zero for "still" waves
    wave_ramp : start and length of the waves' ramp, (2,) s; ramp : s
    """
    velocity = np.zeros(2) if current is None else np.asarray(current, float)
    if components is None:
        none = np.zeros((9, 0)), np.zeros((0, SAMPLES), np.float32), 1.0, 0.0
        return LineSea(*none, float(depth), np.array(wave_ramp, float), velocity, float(ramp), np.zeros(2))
    omega, amplitude, phase, _ = (np.asarray(part, float) for part in components)
    kx, ky = number
    k = np.hypot(kx, ky)
    deep = np.exp(-2 * k * depth)
    carried = np.asarray(carried, float)
    met = omega + carried @ number
    waves = np.ascontiguousarray([kx, ky, kx / k, ky / k, k, amplitude * omega / (1 - deep), deep, met, phase])
    step, omega = PHASE[len(omega) > FEW] / np.abs(met).max(), met
    turn = np.multiply.outer(omega, step * np.arange(SAMPLES))
    factor = np.concatenate([np.cos(turn), np.sin(turn)]).astype(np.float32)
    rest = float(depth), np.array(wave_ramp, float), velocity, float(ramp), carried
    return LineSea(waves, factor, step, 1 / k.max(), *rest)


def water_of(sea, count, most):
    """`Water` of a LineSea for `count` nodes in total, and memory for the sums of a line, which has at most `most`
    nodes.

    returns : Water, (8 most, 2c) rows of `place_rows`, (4, c) velocities, (6 · 8 most,) sums
    """
    waves = sea.waves.shape[1]
    still = flowing(np.zeros(0), np.zeros((0, 2)))
    if waves:
        still = still._replace(
            table=np.zeros(SAMPLES * OF_PLACE * count + WIDTH),
            place=np.zeros(3 * count + WIDTH),
            clock=np.array([-np.inf, sea.step]),
            weights=np.zeros((2, SAMPLES)),
            begin=float(sea.ramp[0]),
            ramp=float(sea.ramp[1]),
            carried=sea.carried,
        )
    if np.any(sea.current):
        still = still._replace(level=np.zeros(1), current=sea.current[None], current_ramp=sea.current_ramp)
    rows = np.zeros((OF_PLACE * most, 2 * waves), np.float32)
    return still, rows, np.zeros((4, waves)), np.zeros(SAMPLES * OF_PLACE * most, np.float32)


def line_water(water, first, last):
    """`Water` at nodes `first` … `last` − 1; loops read eight values at once and may read beyond the last node"""
    if water.table.size == 0:
        return water
    table = water.table[SAMPLES * OF_PLACE * first : SAMPLES * OF_PLACE * last]
    return water._replace(table=table, place=water.place[3 * first : 3 * last])


@kernel(inline=True)
def sine_and_cosine(turn):
    """Sine and cosine of an angle, rad, by Taylor series of the half angle, within ±π/2; error 6e-8"""
    x = 0.5 * (turn - TURN * np.floor(turn * (1 / TURN) + 0.5))
    y = x * x
    s = x * (1 - y * (1 / 6) * (1 - y * (1 / 20) * (1 - y * (1 / 42) * (1 - y * (1 / 72) * (1 - y * (1 / 110))))))
    c = 1 - y * (1 / 56) * (1 - y * (1 / 90) * (1 - y * (1 / 132)))
    c = 1 - y * (1 / 2) * (1 - y * (1 / 12) * (1 - y * (1 / 30) * c))
    return 2 * s * c, 1 - 2 * s * s


@kernel(inline=True)
def falling(x):
    """exp x for −12 ≤ x ≤ 0, as the sixteenth power of a Taylor series; error 3e-7"""
    y = x * (1 / 16)
    f = 1 + y * (1 / 6) * (1 + y * (1 / 7) * (1 + y * (1 / 8) * (1 + y * (1 / 9))))
    f = 1 + y * (1 + y * (1 / 2) * (1 + y * (1 / 3) * (1 + y * (1 / 4) * (1 + y * (1 / 5) * f))))
    f = f * f
    f = f * f
    f = f * f
    return f * f


@kernel()
def place_rows(waves, start, x, y, z, n, j, room, rows):
    """Fill rows (8 n, 2c), coefficients of `factor` for node j of n at (x, y, z), z ≤ 0; start : start of the table, s

    Several loops follow each other, since a single loop is not vectorised.
    """
    c, kx, ky, ux, uy = waves.shape[1], waves[0], waves[1], waves[2], waves[3]
    AC, AS, PC, PS = room[0], room[1], room[2], room[3]
    for i in range(c):
        S, C = sine_and_cosine(kx[i] * x + ky[i] * y + waves[8, i] - waves[7, i] * start)
        rise = falling(max(waves[4, i] * z, DEEPEST))
        image = waves[6, i] / rise
        along, up = waves[5, i] * (rise + image), waves[5, i] * (rise - image)
        AC[i], AS[i], PC[i], PS[i] = along * C, along * S, up * C, up * S
    u, v, w = rows[j], rows[n + j], rows[2 * n + j]
    for i in range(c):
        u[i], u[c + i] = ux[i] * AC[i], ux[i] * AS[i]
    for i in range(c):
        v[i], v[c + i] = uy[i] * AC[i], uy[i] * AS[i]
    for i in range(c):
        w[i], w[c + i] = PS[i], -PC[i]
    xx, xy, yy, xz, yz = rows[3 * n + j], rows[4 * n + j], rows[5 * n + j], rows[6 * n + j], rows[7 * n + j]
    for i in range(c):
        xx[i], xx[c + i] = -kx[i] * ux[i] * AS[i], kx[i] * ux[i] * AC[i]
    for i in range(c):
        xy[i], xy[c + i] = -kx[i] * uy[i] * AS[i], kx[i] * uy[i] * AC[i]
    for i in range(c):
        yy[i], yy[c + i] = -ky[i] * uy[i] * AS[i], ky[i] * uy[i] * AC[i]
    for i in range(c):
        xz[i], xz[c + i] = kx[i] * PC[i], kx[i] * PS[i]
    for i in range(c):
        yz[i], yz[c + i] = ky[i] * PC[i], ky[i] * PS[i]


@kernel()
def foresee_place(sea, position, velocity):
    """Predicted x, y and z ≤ 0, m, of a node at the middle of a table that starts now"""
    later, speed = 0.5 * (SAMPLES - 1) * sea.step, 0.0
    for i in range(3):
        speed += velocity[i] * velocity[i]
    speed = np.sqrt(speed)
    if speed * later > sea.farthest:  # a whipping line does not keep such a speed
        later = sea.farthest / speed
    x, y, z = position[0] + later * velocity[0], position[1] + later * velocity[1], position[2] + later * velocity[2]
    return x, y, min(z, 0.0)


@kernel()
def sea_ahead(sea):
    """Duration of a table, s; inf without waves, or for None (still water)"""
    if sea is None:
        return np.inf
    return (SAMPLES - 1) * sea.step if sea.waves.shape[1] > 0 else np.inf


@kernel()
def open_sea(sea, water, nodes, position, velocity, room, start):
    """Fill the table of `water` from `start` s on, with the nodes of all lines at position (n, 3) m.

    nodes : (m + 1,), first node of each line, and the end; velocity : (n, 3) m/s; room : memory from `water_of`
    """
    if sea.waves.shape[1] == 0:
        return
    rows, parts, sums = room
    water.clock[0] = start
    for line in range(nodes.size - 1):
        first, n = nodes[line], nodes[line + 1] - nodes[line]
        own, place = rows[: OF_PLACE * n], water.place[3 * first :]
        for j in range(n):
            x, y, z = foresee_place(sea, position[first + j], velocity[first + j])
            place[j], place[n + j], place[2 * n + j] = x, y, z
            place_rows(sea.waves, start, x, y, z, n, j, parts, own)
        size = SAMPLES * OF_PLACE * n
        np.dot(sea.factor.T, own.T, sums[:size].reshape((SAMPLES, OF_PLACE * n)))
        table = water.table[size // n * first :]
        for i in range(size):
            table[i] = sums[i]
