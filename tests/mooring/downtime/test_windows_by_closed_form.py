"""Windows and waiting against closed forms of Gaussian records, and intervals against climates of known truth."""

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import ndtr

from hakobune.mooring.downtime.windows import in_windows, waiting, windows
from hakobune.mooring.downtime.years import by_group, share_with_interval


def gaussian_record(count, length, seed):
    """Records of correlation exp(−τ²/2L²), made in the frequency domain"""
    k = np.fft.rfftfreq(count) * 2 * np.pi
    amplitude = np.exp(-0.25 * (k * length) ** 2)
    x = np.fft.irfft(amplitude * np.fft.rfft(np.random.default_rng(seed).standard_normal(count)), count)
    return x / x.std()


def test_upcrossings_and_mean_windows_of_a_gaussian_record_are_those_of_rice():
    """ν = exp(−u²/2) / 2πL, mean window below u: Φ(u)/ν, above it: Φ(−u)/ν"""
    L, u, count = 12.0, 0.7, 2**21
    x = gaussian_record(count, L, 5)
    known, slot = np.ones(count, bool), np.arange(count)
    rate = np.exp(-0.5 * u * u) / (2 * np.pi * L)
    below, above = (windows(side, known, slot) for side in (x < u, x >= u))
    assert len(above.first) / count == pytest.approx(rate, rel=0.02)
    assert below.steps.mean() == pytest.approx(ndtr(u) / rate, rel=0.02)
    assert above.steps.mean() == pytest.approx(ndtr(-u) / rate, rel=0.02)


@pytest.mark.parametrize("steps", [1, 3, 8])
def test_the_wait_for_a_window_in_white_noise_is_that_of_a_run_of_successes(steps):
    """Trials until the end of the first run of n successes: (1 − pⁿ)/(q pⁿ) (Feller), less n to its begin"""
    count, p = 2**20, 0.75
    usable = np.random.default_rng(steps).uniform(size=count) < p
    known, slot = np.ones(count, bool), np.arange(count)
    waited = waiting(windows(usable, known, slot), known, slot, steps)
    exact = (1 - p**steps) / ((1 - p) * p**steps) - steps
    assert np.nanmean(waited) == pytest.approx(exact, rel=0.02, abs=0.003)


def test_the_wait_in_a_record_of_ornstein_and_uhlenbeck_is_the_sum_of_its_chances():
    """E = Σ_k P(down for k rows on end); each by the kernel of x_{i+1} = a x_i + √(1 − a²) e over [u, ∞)"""
    a, u, count = np.exp(-1 / 20), 1.0, 2**21
    nodes, weights = np.polynomial.legendre.leggauss(300)
    x, w = u + 0.5 * 6 * (nodes + 1), 0.5 * 6 * weights
    s = np.sqrt(1 - a * a)
    kernel = np.exp(-0.5 * ((x - a * x[:, None]) / s) ** 2) / (s * np.sqrt(2 * np.pi)) * w
    density = np.exp(-0.5 * x * x) / np.sqrt(2 * np.pi)
    exact = float(w * density @ np.linalg.solve(np.eye(len(x)) - kernel, np.ones(len(x))))
    record = lfilter([s], [1, -a], np.random.default_rng(8).standard_normal(count))
    known, slot = np.ones(count, bool), np.arange(count)
    waited = waiting(windows(record < u, known, slot), known, slot, 1)
    assert np.nanmean(waited) == pytest.approx(exact, rel=0.02)


def test_windows_end_at_gaps_and_nobody_waits_across_them():
    usable = np.array([1, 1, 0, 1, 1, 1, 1, 1], bool)
    slot = np.array([0, 1, 2, 3, 4, 9, 10, 11])  # a gap after the fifth row
    known = np.ones(8, bool)
    found = windows(usable, known, slot)
    assert found.first.tolist() == [0, 3, 5] and found.steps.tolist() == [2, 2, 3]
    assert in_windows(found, 8, 3).tolist() == [False] * 5 + [True] * 3
    assert in_windows(found, 8, 2).tolist() == [True, True, False, True, True, True, True, True]
    assert in_windows(windows(usable[:5], known[:5], slot[:5]), 5, 2).tolist() == [True, True, False, True, True]
    alone = windows(np.array([0, 1, 1, 1, 0, 1, 0, 0], bool), known, np.arange(8))
    assert in_windows(alone, 8, 2).tolist() == [False, True, True, True, False, False, False, False]
    np.testing.assert_array_equal(waiting(found, known, slot, 2), [0, 2, 1, 0, np.nan, 0, 0, np.nan])
    np.testing.assert_array_equal(waiting(found, known, slot, 3)[:5], [np.nan] * 5)


def test_rows_that_are_not_known_are_in_no_window_and_no_wait():
    usable, known, slot = np.ones(4, bool), np.array([True, False, True, True]), np.arange(4)
    found = windows(usable & known, known, slot)
    assert found.steps.tolist() == [1, 2]
    np.testing.assert_array_equal(waiting(found, known, slot, 1), [0, np.nan, 0, 0])


def test_nine_of_ten_intervals_hold_the_truth_of_synthetic_climates():
    """200 climates of 40 years, hours correlated over 36 h, winters rougher: down above u with probability Φ(−u)"""
    climates, years, rows = 200, 40, 1461  # six-hourly
    a, season = np.exp(-6 / 36), 1.2 + 0.5 * np.cos(2 * np.pi * np.arange(rows) / rows)
    truth = ndtr(-season).mean()
    rng, year = np.random.default_rng(58), np.repeat(np.arange(years), rows)
    held = 0
    for _ in range(climates):
        x = lfilter([np.sqrt(1 - a * a)], [1, -a], rng.standard_normal(years * rows + 200))[200:]
        down = x > np.tile(season, years)
        _, low, high = share_with_interval(*by_group(down, np.ones_like(down), year, np.arange(years)))
        held += low <= truth <= high
    assert 0.87 <= held / climates <= 0.93, held / climates


def test_the_interval_of_equal_whole_years_is_students():
    """Shares 0.1, 0.2, 0.3, 0.2, 0.2: mean 0.2, standard error 0.0316, t₀.₉₅ of 4 degrees 2.1318"""
    down, known = np.array([10.0, 20, 30, 20, 20]), np.full(5, 100.0)
    share, low, high = share_with_interval(down, known)
    assert share == pytest.approx(0.2)
    assert (low, high) == (pytest.approx(0.2 - 0.067414, abs=1e-5), pytest.approx(0.2 + 0.067414, abs=1e-5))


def test_few_years_have_a_share_and_no_interval():
    share, low, high = share_with_interval(np.array([1.0, 3.0]), np.array([10.0, 10.0]))
    assert share == 0.2 and np.isnan(low) and np.isnan(high)
