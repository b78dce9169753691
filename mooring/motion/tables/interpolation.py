"""Interpolation between equal steps, compiled."""

import numpy as np

from hakobune.bem.kernels.jit import kernel

EDGE = 3  # samples beyond the ends that a quintic through six samples may need


SHARES = 1.0 / np.array(  # 1 / (−1)^(n−1−i) i! (n−1−i)! of n = 4 and 6
    [[-6.0, 2.0, -2.0, 6.0, 1.0, 1.0], [-120.0, 24.0, -12.0, 12.0, -24.0, 120.0]]
)


@kernel(inline=True, counted=False)
def lagrange_weights(place, n, weights):
    """Fill the first n of weights (6,), those of the polynomial through n = 4 or 6 samples at 0, 1, …, n−1, at a
    place between.
    """
    row = 0 if n == 4 else 1
    before = 1.0
    for i in range(n):
        weights[i] = before * SHARES[row, i]
        before *= place - i
    after = 1.0
    for i in range(n - 1, -1, -1):
        weights[i] *= after
        after *= place - i


@kernel(inline=True, counted=False)
def between_samples(samples, place, weights, out):
    """Fill out (k,) from samples (k, m) at equal steps, at a place counted in steps from the first; quintic through
    six samples.
    """
    m = samples.shape[1]
    first = min(max(int(np.floor(place)) - 2, 0), m - 6)
    lagrange_weights(place - first, 6, weights)
    for j in range(out.size):
        total = 0.0
        for i in range(6):
            total += weights[i] * samples[j, first + i]
        out[j] = total


def ring_table(values):
    """Values (n, k) at n equal steps of a circle, extended so that four neighbours always exist; shape (n + 3, k)"""
    values = np.asarray(values, float)
    return np.concatenate([values[-1:], values, values[:2]])


@kernel(inline=True, counted=False)
def on_ring(table, angle, weights, out):
    """Fill out (k,) from a `ring_table` at an angle, rad; cubic through four neighbours"""
    n = table.shape[0] - 3
    place = angle * (n / (2 * np.pi))
    whole = np.floor(place)
    lagrange_weights(place - whole + 1.0, 4, weights)
    first = int(whole) % n
    for j in range(out.size):
        total = 0.0
        for i in range(4):
            total += weights[i] * table[first + i, j]
        out[j] = total
