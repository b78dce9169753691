"""Sums of waves at equal steps, and sines and cosines without branches, against numpy."""

import numpy as np
from plain import plain

from hakobune.bem.kernels.jit import kernel
from hakobune.mooring.motion.tables.harmonics import at_step, harmonics, sine_and_cosine, sum_waves, zeros_in_lines


@kernel(counted=False)
def sum_of(rows, factor, sums, found):
    sum_waves(rows, factor, sums)
    for j in range(found.shape[0]):
        for n in range(found.shape[1]):
            found[j, n] = at_step(sums, j, n - found.shape[1] // 2)


@kernel(counted=False)
def turned(angles, out):
    for i in range(angles.size):
        out[0, i], out[1, i] = sine_and_cosine(angles[i])


def test_sums_after_and_before_an_instant_are_those_of_every_wave():
    rng, step, count = np.random.default_rng(5), 0.3, 21
    for waves in (1, 8, 13):
        omega, weights = rng.uniform(0.2, 3.0, waves), rng.normal(size=(waves, 2, 4))
        weights[:, :, 2] = 0.0
        factor = harmonics(omega, step, count)
        rows, sums = np.zeros((len(factor), 2, 4)), zeros_in_lines((4, 2, factor.shape[2]))
        rows[:waves] = weights
        found = np.zeros((4, 2 * count - 1))
        sum_of(rows, factor, sums, found)
        turn = np.multiply.outer(omega, step * np.arange(1 - count, count))
        wanted = weights[:, 0].T @ np.cos(turn) + weights[:, 1].T @ np.sin(turn)
        assert np.abs(found - wanted).max() <= 1e-13 * np.abs(weights).sum()
        assert not found[2].any()


def test_sines_and_cosines_are_those_of_numpy_to_rounding():
    angles = np.random.default_rng(6).uniform(-1e6, 1e6, 20000)
    angles = np.concatenate([angles, np.linspace(-10, 10, 20001), np.arange(-9, 10) * np.pi / 4, [0.0, -0.0]])
    out = np.zeros((2, len(angles)))
    turned(angles, out)
    assert np.abs(out - [np.sin(angles), np.cos(angles)]).max() <= 2.3e-16
    turned(np.array([np.nan]), out)
    assert np.isnan(out[:, 0]).all()


def test_zeros_begin_a_line_of_the_cache():
    assert all(zeros_in_lines((3, size)).ctypes.data % 64 == 0 for size in range(1, 20))


def test_sine_and_cosine_are_right_to_rounding_up_to_a_million_radians():
    tables = plain("mooring.motion.tables.harmonics")
    rng = np.random.default_rng(3)
    for turn in [*rng.uniform(-1e6, 1e6, 300), *np.linspace(-4.0, 4.0, 101)]:
        sine, cosine = tables.sine_and_cosine(turn)
        assert abs(sine - np.sin(turn)) <= 4e-16 and abs(cosine - np.cos(turn)) <= 4e-16
