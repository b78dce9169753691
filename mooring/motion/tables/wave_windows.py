"""Windows of wave forces, compiled: the waves are summed at a slow pose and stored for a window of time.

Equations and windows: `mooring.motion.wave_loads`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import address, load_vector, repeated, store_vector

from .harmonics import at_step, sine_and_cosine, sum_waves, zeros_in_lines
from .interpolation import EDGE, lagrange_weights

HEADINGS = 120  # headings of the force table, 3° apart, with polynomials of fifth degree in between
ROWS = 10  # six forces, three of drift, the elevation
OF_WAVE = 19  # six forces, the elevation, and four roots of each of three drifts


@in_memory
class WaveTable(NamedTuple):
    """Wave components, and the forces of each component on a ring of headings, as the kernels read them.

    omega : (c,) rad/s at which a place at rest meets them; own : (c,) rad/s, in the water, which a current moves along
    amplitude, phase, direction : (c,); number : (2, c) wavenumber along x and y
    force : (N + G, c, HEADINGS, 16) real and imaginary parts of six forces per metre, three of drift a square metre and
    a zero, of each of N bodies and of G groups of shapes (`equation`).  Single precision rounds the forces of every
    pose anew: a lightly damped buoy at a tolerance of 1e-4 was four times that off, and no nearer at 1e-7
    factor : (c or more, 2, m) `harmonics` of the steps of a window and EDGE beyond it
    center : (N + G, 2) m, rotation centres; arm : (N + G, 2) m, from the origin of the database to these, along axes of
    the bodies
    step, window : s, between forces and of a window
    """

    omega: np.ndarray
    own: np.ndarray
    number: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray
    direction: np.ndarray
    force: np.ndarray
    factor: np.ndarray
    center: np.ndarray
    arm: np.ndarray
    step: float
    window: float

    @property
    def steps(self):
        """Columns of a window, 1 without components"""
        return round(self.window / self.step) + 1 + 2 * EDGE if len(self.omega) else 1


@in_memory
class Waves(NamedTuple):
    """table : `WaveTable`; mean_drift : whether each component drifts alone, without the beat of pairs

    rows : (c, 2, 19), turns : (2, c), parts : (16,), weights : (6,) room for work
    sums : (N, 2, 19, 2, m) `sum_waves` of the begin of window n in place n % 2, those of its end in the other
    mean : (N, 2, 3) mean drift there
    """

    table: WaveTable
    mean_drift: bool
    rows: np.ndarray
    turns: np.ndarray
    parts: np.ndarray
    weights: np.ndarray
    sums: np.ndarray
    mean: np.ndarray


def waves_of(table, mean_drift=False):
    """`Waves` of a `WaveTable`"""
    c, _, m = table.factor.shape
    return Waves(
        table, bool(mean_drift), np.zeros((c, 2, OF_WAVE)), np.zeros((2, len(table.omega))), np.zeros(16), np.zeros(6),
        zeros_in_lines((len(table.force), 2, OF_WAVE, 2, m)), np.zeros((len(table.force), 2, 3)),
    )  # fmt: skip


@kernel(inline=True, counted=False)
def turn_waves(table, x, y, start, turns):
    """turns (2, c): amplitude times cosine and sine of the phase of each wave at (x, y) m and `start` s"""
    for i in range(table.omega.size):
        turn = table.number[0, i] * x + table.number[1, i] * y + table.phase[i] - table.omega[i] * start
        sine, cosine = sine_and_cosine(turn)
        turns[0, i] = table.amplitude[i] * cosine
        turns[1, i] = table.amplitude[i] * sine


@kernel(counted=False)
def fill_rows(waves, pose, start, body=0):
    """waves.rows (c, 2, OF_WAVE): six forces, the elevation and real and imaginary roots of the drift, of each wave

    pose : (3,) slow x, y (m from the place at rest) and heading of the body; start : s
    """
    table, turns, parts = waves.table, waves.turns, waves.parts
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    ax, ay = cos * table.arm[body, 0] - sin * table.arm[body, 1], sin * table.arm[body, 0] + cos * table.arm[body, 1]
    turn_waves(table, table.center[body, 0] + pose[0] - ax, table.center[body, 1] + pose[1] - ay, start, turns)
    weights, first, towards = waves.weights, 0, np.nan
    force, into = address(table.force), address(parts)
    for i in range(table.omega.size):
        if table.direction[i] != towards:
            towards = table.direction[i]
            place = (towards - pose[2]) * (HEADINGS / (2 * np.pi))
            whole = np.floor(place)
            lagrange_weights(place - whole + 2.0, 6, weights)
            first = int(whole) - 2
        low = high = repeated(0.0)
        for n in range(6):
            at = ((body * table.omega.size + i) * HEADINGS + (first + n) % HEADINGS) * 16
            low = low + load_vector(force, at) * weights[n]
            high = high + load_vector(force, at + 8) * weights[n]
        store_vector(into, 0, low)
        store_vector(into, 8, high)
        a, b = turns[0, i], turns[1, i]
        sine, cosine = sine_and_cosine(table.number[0, i] * ax + table.number[1, i] * ay)
        put_rows(waves.rows[i, 0], waves.rows[i, 1], a, b, a * cosine - b * sine, a * sine + b * cosine, parts)


@kernel(inline=True, counted=False)
def put_rows(by_cos, by_sin, a, b, c, d, parts):
    """Rows of a wave. Its amplitude is a + ib m at the body's moved origin, to which its forces refer, and c + id at
    the rotation centre, where its drift beats; parts (16,) : forces and drift of the wave as in a `WaveTable`"""
    for j in range(6):
        by_cos[j], by_sin[j] = a * parts[j] - b * parts[6 + j], b * parts[j] + a * parts[6 + j]
    by_cos[6], by_sin[6] = a, b
    for j in range(3):
        drift = parts[12 + j]
        root = np.sqrt(abs(drift))
        up, down = (root, 0.0) if drift > 0.0 else (0.0, root)
        p = 7 + 4 * j
        by_cos[p], by_sin[p] = up * c, up * d
        by_cos[p + 1], by_sin[p + 1] = up * d, -up * c
        by_cos[p + 2], by_sin[p + 2] = down * c, down * d
        by_cos[p + 3], by_sin[p + 3] = down * d, -down * c


@kernel(counted=False)
def meet(waves, place, pose, start, body=0):
    """Sums of `Waves` around `start` s, put into place 0 or 1 of the sums, for a body that is then at the slow pose
    (3,)"""
    fill_rows(waves, pose, start, body)
    sum_waves(waves.rows, waves.table.factor, waves.sums[body, place])
    for j in range(3):
        p, total = 7 + 4 * j, 0.0
        for i in range(waves.table.omega.size):
            a, b = waves.rows[i, 0], waves.rows[i, 1]
            total += a[p] ** 2 + b[p] ** 2 - a[p + 2] ** 2 - b[p + 2] ** 2
        waves.mean[body, place, j] = total


@kernel(counted=False)
def fill_window(waves, window, number, pose, start, body=0):
    """Fill window (ROWS, m) with forces of `Waves` at the steps of a window that begins at `start` s.

    number : number of the window; its begin is already summed. pose : (3,) slow pose of the body at its end, which is
    summed here
    """
    window[:] = 0.0
    if waves.table.omega.size == 0:
        return
    meet(waves, (number + 1) % 2, pose, start + waves.table.window, body)
    steps = window.shape[1] - 1 - 2 * EDGE
    for side in range(2):
        sums, mean = waves.sums[body, (number + side) % 2], waves.mean[body, (number + side) % 2]
        for n in range(window.shape[1]):
            at = n - EDGE - side * steps
            later = (n - EDGE) / steps
            share = 1.0 - later if side == 0 else later
            for j in range(6):
                window[j, n] += share * at_step(sums, j, at)
            window[9, n] += share * at_step(sums, 6, at)
            for j in range(3):
                slow = mean[j]
                if not waves.mean_drift:
                    p = 7 + 4 * j
                    slow = at_step(sums, p, at) ** 2 + at_step(sums, p + 1, at) ** 2
                    slow -= at_step(sums, p + 2, at) ** 2 + at_step(sums, p + 3, at) ** 2
                window[6 + j, n] += share * slow
