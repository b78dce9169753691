"""Windows of wave forces, compiled: the forces of all waves at a slow pose are summed and stored for a window of time.

Equations and windows: `mooring.motion.wave_loads`.  A force X(ω) exp(−iωτ) of a wave is interpolated between nodes ω̃,

    Σ aᵢ X(ωᵢ) exp(−iωᵢτ) ≈ Σ Aₘ X(ω̃ₘ) exp(−iω̃ₘτ),    Aₘ = Σ aᵢ Lₘ(ωᵢ),    Lₘ Lagrange's polynomials of NEAR nodes,

for the short times τ of a window. Square roots of the drift have corners and sharp peaks, so they are summed wave by
wave.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, load_vector, repeated, split_halves, store_vector, to_scalars

from .harmonics import at_step, sine_and_cosine, sum_waves, zeros_in_lines
from .interpolation import EDGE, lagrange_weights

HEADINGS = 120  # headings of the force table, 3° apart, with polynomials of fifth degree in between
ROWS = 10  # six forces, three of drift, the elevation
OF_NODE, OF_WAVE = 7, 12  # six forces and the elevation; four roots of each of three drifts
FAR = EDGE + 2  # of every second step, beyond half a window: those that a quintic at its last step needs
NEAR = 6  # nodes on which the amplitude of a wave is shared


@in_memory
class WaveTable(NamedTuple):
    """Wave components, and their forces on a ring of headings, at M nodes of frequency, as the kernels read them.

    omega : frequency at a fixed place, (c,) rad/s; own : frequency in the water, which a current may carry along,
        (c,) rad/s
    amplitude, phase, direction : (c,); number : wavenumber along x and y, (2, c)
    force : (N + G, M, HEADINGS, 16) real and imaginary parts of six forces per metre and zeros, of each of N bodies and
    of G groups of shapes (`equation`), at the nodes; drift : (N + G, c, HEADINGS, 3) a square metre, of the components
    Single precision rounds the forces of every pose anew: a lightly damped buoy at a tolerance of 1e-4 was four times
    that off, and no nearer at 1e-7
    near : first node of each component, (c,); share : shares of each component on the nodes from its first, (c, WIDTH)
    towards : wave directions of the nodes, (M,) rad
    of_nodes : (M or more, 2, m), `harmonics` of the nodes at the steps of a window and EDGE steps beyond it
    of_drift : (c or more, 2, n), `harmonics` of the components at every second of these steps and at FAR steps
        beyond the window
    center : rotation centres, (N + G, 2) m; arm : arms from the database's origin to the centres, along body axes,
        (N + G, 2) m
    step, window : time between forces, and length of a window, s
    """

    omega: np.ndarray
    own: np.ndarray
    number: np.ndarray
    amplitude: np.ndarray
    phase: np.ndarray
    direction: np.ndarray
    force: np.ndarray
    drift: np.ndarray
    near: np.ndarray
    share: np.ndarray
    towards: np.ndarray
    of_nodes: np.ndarray
    of_drift: np.ndarray
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
    """table : `WaveTable`; mean_drift : whether only the mean drift of each component counts, without the beat of
    pairs

    rows : (c, 2, 12), node_rows : (M, 2, 7), turns : (2, c), nodes : (2, M + WIDTH), parts : (24,), weights : (6,) and
    slow : (3, 2n) room for work
    sums : (N, 2, 7, 2, m), drift_sums : (N, 2, 12, 2, n), `sum_waves` at the start of window k in place k % 2, at
        its end in the other place; mean : mean drift at start and end, (N, 2, 3)
    """

    table: WaveTable
    mean_drift: bool
    rows: np.ndarray
    node_rows: np.ndarray
    turns: np.ndarray
    nodes: np.ndarray
    parts: np.ndarray
    weights: np.ndarray
    slow: np.ndarray
    sums: np.ndarray
    drift_sums: np.ndarray
    mean: np.ndarray


def waves_of(table, mean_drift=False):
    """`Waves` of a `WaveTable`"""
    (M, _, m), (c, _, n), bodies = table.of_nodes.shape, table.of_drift.shape, len(table.force)
    return Waves(
        table, bool(mean_drift), np.zeros((c, 2, OF_WAVE)), np.zeros((M, 2, OF_NODE)), np.zeros((2, len(table.omega))),
        np.zeros((2, len(table.towards) + WIDTH)), np.zeros(24), np.zeros(6), np.zeros((3, 2 * n)),
        zeros_in_lines((bodies, 2, OF_NODE, 2, m)), zeros_in_lines((bodies, 2, OF_WAVE, 2, n)),
        np.zeros((bodies, 2, 3)),
    )  # fmt: skip


@kernel(inline=True, counted=False)
def turn_waves(table, x, y, start, turns):
    """Fill turns (2, c), amplitude times cosine and sine of the phase of each wave at (x, y) m and `start` s"""
    for i in range(table.omega.size):
        turn = table.number[0, i] * x + table.number[1, i] * y + table.phase[i] - table.omega[i] * start
        sine, cosine = sine_and_cosine(turn)
        turns[0, i] = table.amplitude[i] * cosine
        turns[1, i] = table.amplitude[i] * sine


@kernel(inline=True, counted=False)
def share_waves(table, turns, nodes):
    """Fill nodes (2, M + WIDTH), amplitudes of the nodes, then zeros, from the amplitudes of the waves, turns (2, c)

    Successive waves with common nodes are added before the nodes are written.
    """
    nodes[:] = 0.0
    shares, into, m, i = address(table.share), address(nodes), nodes.shape[1], 0
    while i < table.omega.size:
        first = table.near[i]
        a, b = load_vector(into, first), load_vector(into, m + first)
        while i < table.omega.size and table.near[i] == first:
            share = load_vector(shares, WIDTH * i)
            a, b, i = a + share * turns[0, i], b + share * turns[1, i], i + 1
        store_vector(into, first, a)
        store_vector(into, m + first, b)


@kernel(inline=True, counted=False)
def near_headings(direction, weights):
    """First of six headings around a direction, rad from the body's axes; fills the weights (6,) of these headings"""
    place = direction * (HEADINGS / (2 * np.pi))
    whole = np.floor(place)
    lagrange_weights(place - whole + 2.0, 6, weights)
    return int(whole) - 2


@kernel(counted=False)
def fill_forces(waves, heading, body):
    """Fill waves.node_rows (M, 2, OF_NODE), six forces and the elevation at each node for a body at a heading, rad"""
    table, parts, weights, first, before = waves.table, waves.parts, waves.weights, 0, np.nan
    force, into = address(table.force), address(parts)
    for i in range(table.towards.size):
        if table.towards[i] != before:
            before = table.towards[i]
            first = near_headings(before - heading, weights)
        low = high = repeated(0.0)
        for n in range(6):
            at = ((body * table.towards.size + i) * HEADINGS + (first + n) % HEADINGS) * 16
            low = low + load_vector(force, at) * weights[n]
            high = high + load_vector(force, at + 8) * weights[n]
        store_vector(into, 0, low)
        store_vector(into, 8, high)
        a, b, by_cos, by_sin = waves.nodes[0, i], waves.nodes[1, i], waves.node_rows[i, 0], waves.node_rows[i, 1]
        for j in range(6):
            by_cos[j], by_sin[j] = a * parts[j] - b * parts[6 + j], b * parts[j] + a * parts[6 + j]
        by_cos[6], by_sin[6] = a, b


@kernel(counted=False)
def fill_drift(waves, ax, ay, heading, body):
    """Fill waves.rows (c, 2, OF_WAVE), real and imaginary square roots of the drift of each wave

    Wave groups act when they reach the rotation centre, which is (ax, ay) m from the reference point of the forces.
    """
    table, turns, parts, weights, first, before = waves.table, waves.turns, waves.parts, waves.weights, 0, np.nan
    drifts, by = address(table.drift), address(parts)
    for i in range(table.omega.size):
        if table.direction[i] != before:
            before = table.direction[i]
            first = near_headings(before - heading, weights) % HEADINGS
            for n in range(24):
                parts[n] = weights[n // 4]
        at = ((body * table.omega.size + i) * (HEADINGS + 6) + first) * 4
        pairs = load_vector(drifts, at) * load_vector(by, 0) + load_vector(drifts, at + 8) * load_vector(by, 8)
        even, odd = split_halves(pairs + load_vector(drifts, at + 16) * load_vector(by, 16))
        three = to_scalars(even + odd)
        c, d, by_cos, by_sin = turns[0, i], turns[1, i], waves.rows[i, 0], waves.rows[i, 1]
        if ax != 0.0 or ay != 0.0:
            sine, cosine = sine_and_cosine(table.number[0, i] * ax + table.number[1, i] * ay)
            c, d = c * cosine - d * sine, c * sine + d * cosine
        for j in range(3):
            drift = three[j]
            root = np.sqrt(abs(drift))
            up, down = (root, 0.0) if drift > 0.0 else (0.0, root)
            p = 4 * j
            by_cos[p], by_sin[p] = up * c, up * d
            by_cos[p + 1], by_sin[p + 1] = up * d, -up * c
            by_cos[p + 2], by_sin[p + 2] = down * c, down * d
            by_cos[p + 3], by_sin[p + 3] = down * d, -down * c


@kernel(counted=False)
def meet(waves, place, pose, start, body=0):
    """Compute the sums of `Waves` around `start` s into place 0 or 1, for a body at the slow pose (3,) at this time.

    The pose is x, y (m from the position at rest) and heading
    """
    table = waves.table
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    ax, ay = cos * table.arm[body, 0] - sin * table.arm[body, 1], sin * table.arm[body, 0] + cos * table.arm[body, 1]
    turn_waves(table, table.center[body, 0] + pose[0] - ax, table.center[body, 1] + pose[1] - ay, start, waves.turns)
    share_waves(table, waves.turns, waves.nodes)
    fill_forces(waves, pose[2], body)
    fill_drift(waves, ax, ay, pose[2], body)
    sum_waves(waves.node_rows, table.of_nodes, waves.sums[body, place])
    sum_waves(waves.rows, table.of_drift, waves.drift_sums[body, place])
    for j in range(3):
        p, total = 4 * j, 0.0
        for i in range(table.omega.size):
            a, b = waves.rows[i, 0], waves.rows[i, 1]
            total += a[p] ** 2 + b[p] ** 2 - a[p + 2] ** 2 - b[p + 2] ** 2
        waves.mean[body, place, j] = total


@kernel(counted=False)
def fill_window(waves, window, number, pose, start, body=0):
    """Fill window (ROWS, m) with forces of `Waves` at the steps of a window that starts at `start` s.

    number : number of the window, whose start is already summed; pose : slow pose at its end, which is summed here,
        (3,)
    """
    window[:] = 0.0
    if waves.table.omega.size == 0:
        return
    meet(waves, (number + 1) % 2, pose, start + waves.table.window, body)
    steps = window.shape[1] - 1 - 2 * EDGE
    for side in range(2):
        sums = waves.sums[body, (number + side) % 2]
        for n in range(window.shape[1]):
            at = n - EDGE - side * steps
            later = (n - EDGE) / steps
            share = 1.0 - later if side == 0 else later
            for j in range(6):
                window[j, n] += share * at_step(sums, j, at)
            window[9, n] += share * at_step(sums, 6, at)
        add_drift(waves, window, side, body, (number + side) % 2)


@kernel(counted=False)
def add_drift(waves, window, side, body, place):
    """Add the drift at the start (side 0) or the end (side 1) of a window, with its weight.

    The drift is summed at every second step; between these steps it is the quintic through six of them
    """
    sums, steps = waves.drift_sums[body, place], window.shape[1] - 1 - 2 * EDGE
    first = (-EDGE - side * steps) // 2 - 2
    for k in range((steps + 1) // 2 + 2 * EDGE + 3):
        for j in range(3):
            waves.slow[j, k] = waves.mean[body, place, j]
            if not waves.mean_drift:
                p, at = 4 * j, first + k
                slow = at_step(sums, p, at) ** 2 + at_step(sums, p + 1, at) ** 2
                waves.slow[j, k] = slow - at_step(sums, p + 2, at) ** 2 - at_step(sums, p + 3, at) ** 2
    for n in range(window.shape[1]):
        at, later = n - EDGE - side * steps, (n - EDGE) / steps
        share, k = 1.0 - later if side == 0 else later, at // 2 - first
        for j in range(3):
            slow = waves.slow[j]
            here = slow[k]
            if at % 2 != 0:
                near, next_, last = here + slow[k + 1], slow[k - 1] + slow[k + 2], slow[k - 2] + slow[k + 3]
                here = (150.0 * near - 25.0 * next_ + 3.0 * last) / 256.0
            window[6 + j, n] += share * here
