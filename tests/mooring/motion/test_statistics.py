"""Statistics of records against closed forms, and against the rows of the report's table of simulations."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.motion.statistics import (
    FEW,
    frequencies_in,
    highest_mean,
    over_runs,
    parts,
    record_statistics,
    settled_from,
    slow_part,
    stillness,
    without_rounding,
)
from hakobune.mooring.response.extremes import expected_maximum, mean_of_highest

STEP = 0.5
SINE = 2 * np.pi / 12.0
TABLE = Path(__file__).parents[2] / "published" / "simulation_statistics.csv"


def gaussian(low, high, seed, hours=24):
    """A Gaussian record of flat spectrum from `low` to `high` rad/s and σ = 1, by random Fourier coefficients"""
    n = int(hours * 3600 / STEP)
    omega = 2 * np.pi * np.fft.rfftfreq(n, STEP)
    inside = (omega > low) & (omega < high)
    rng = np.random.default_rng(seed)
    record = np.fft.irfft(np.where(inside, rng.normal(size=len(omega)) + 1j * rng.normal(size=len(omega)), 0.0), n)
    return record / record.std()


def test_a_sine_has_its_closed_forms():
    t = STEP * np.arange(14400)
    found = record_statistics(3.0 + 2.0 * np.cos(SINE * t + 0.3), STEP, 0.3)
    assert np.isclose(found.mean, 3.0, atol=1e-3) and np.isclose(found.sigma, np.sqrt(2), rtol=1e-3)
    assert np.allclose([found.T_zero, found.T_peak], 12.0, rtol=1e-3) and found.epsilon < 0.05
    assert np.allclose([found.mean_third, found.mean_tenth], 2.0, rtol=1e-3)
    assert np.allclose([found.largest, found.smallest], [5.0, 1.0], atol=5e-3)


def test_slow_and_wave_part_are_told_apart_by_frequency_and_their_squares_add_up():
    t = STEP * np.arange(14400)
    found = record_statistics(3.0 * np.sin(0.05 * t) + np.sin(0.6 * t), STEP, 0.3)
    assert np.isclose(found.slow, 3 / np.sqrt(2), rtol=5e-3) and np.isclose(found.wave, 1 / np.sqrt(2), rtol=5e-3)
    assert np.isclose(found.slow**2 + found.wave**2, found.sigma**2, rtol=1e-12)


def test_the_slow_part_has_the_variance_told_of_it_and_no_delay():
    t = STEP * np.arange(14400)
    slow = 1.0 + 3.0 * np.sin(2 * np.pi * 57 / (14400 * STEP) * t)  # whole periods of the record
    record = slow + np.sin(2 * np.pi * 690 / (14400 * STEP) * t)
    assert np.allclose(slow_part(record, STEP, 0.3), slow, atol=1e-10)
    assert np.isclose(slow_part(record, STEP, 0.3).std(), record_statistics(record, STEP, 0.3).slow, rtol=1e-12)


def test_a_body_is_at_its_new_place_once_it_stays_within_its_later_range():
    """A walk of 25 m after 300 s among waves of ±0.5 m: within a tenth more than that where 0.1 m are left"""
    t = STEP * np.arange(3600)
    left = 25.0 * np.where(t < 300, 1.0, np.exp(-(t - 300) / 60.0))
    motion = np.stack([left + 0.5 * np.sin(1.6 * t), 0 * t], axis=1)
    first = settled_from(t, motion, 300.0)
    assert 0.05 < left[first] < 0.15
    assert settled_from(t, motion, np.inf) == settled_from(t, motion, t[-10]) == 0


@pytest.mark.parametrize("low, high", [(0.55, 0.65), (0.2, 1.0)])
def test_a_gaussian_record_has_the_periods_bandwidth_and_maxima_of_its_spectrum(low, high):
    m0, m2, m4 = ((high ** (n + 1) - low ** (n + 1)) / (n + 1) / (high - low) for n in (0, 2, 4))
    found = record_statistics(gaussian(low, high, 3), STEP, 0.1)
    assert np.isclose(found.T_zero, 2 * np.pi * np.sqrt(m0 / m2), rtol=0.01)
    assert np.isclose(found.T_peak, 2 * np.pi * np.sqrt(m2 / m4), rtol=0.01)
    epsilon = np.sqrt(1 - m2**2 / (m0 * m4))
    assert np.isclose(found.epsilon, epsilon, atol=0.01)
    for value, share in ((found.mean_third, 1 / 3), (found.mean_tenth, 1 / 10)):
        assert np.isclose(value, mean_of_highest(share, epsilon), rtol=0.02)


def test_the_largest_of_many_gaussian_runs_has_the_mean_of_the_formula():
    runs = [record_statistics(gaussian(0.4, 0.8, seed, hours=3), STEP, 0.1) for seed in range(60)]
    zero = over_runs([r.T_zero for r in runs])
    assert np.isclose(np.mean([r.largest for r in runs]), expected_maximum(1.0, 3 * 3600, zero), rtol=0.03)
    assert np.isclose(np.mean([r.extreme for r in runs]), expected_maximum(1.0, 3 * 3600, zero), rtol=0.01)


def test_what_does_not_vary_has_a_mean_and_no_maxima():
    found = record_statistics(np.full(100, 7.0), STEP, 0.3)
    assert found.mean == found.largest == 7.0 and found.sigma == 0.0 and np.isnan(found.mean_third)


def test_a_record_that_is_not_finite_is_refused():
    with pytest.raises(ValueError, match="finite"):
        record_statistics(np.r_[np.zeros(20), np.nan], STEP, 0.3)


def test_printed_rows_keep_the_relations_between_their_own_columns():
    """X_1000 and 3.5.1.4 of printed σ, T_zero and ε; the table is rounded to two or three digits"""
    rows = list(csv.DictReader(line for line in TABLE.read_text(encoding="utf-8").splitlines() if line[0] != "#"))
    assert len(rows) == 21
    for row in (row for row in rows if row["X_1000"]):
        sigma, zero, epsilon = (float(row[key]) for key in ("sigma", "T_zero_s", "eps"))
        assert np.isclose(expected_maximum(sigma, 1000 * 10.0, zero), float(row["X_1000"]), rtol=0.02)
        assert np.isclose(mean_of_highest(1 / 3, epsilon) * sigma, float(row["significant_amp"]), rtol=0.04)


@pytest.mark.parametrize("n", [1000, 1001])
def test_every_frequency_of_a_record_counts_twice_but_the_mean_and_that_of_alternating_values(n):
    """Parseval for real values: σ² = 2 Σ |X_k|²/n² over 0 < k < n/2, and |X_{n/2}|²/n² of an even record alone.  A
    record at the last frequency of either length has all its variance in it."""
    k = n // 2
    record = np.cos(2 * np.pi * k * np.arange(n) / n + (0.7 if n % 2 else 0.0))
    slow, wave = parts(record - record.mean(), 0.5, 3.0)
    assert slow == pytest.approx(0.0, abs=1e-9)
    assert wave == pytest.approx(np.sqrt(np.mean(record**2)), rel=1e-9)
    assert wave == pytest.approx(1 / np.sqrt(2) if n % 2 else 1.0, rel=1e-9)


def test_the_highest_third_and_tenth_of_thirty_maxima_are_sums_by_hand():
    """Maxima 1 … 30: (21 + … + 30)/10 = 25.5 and (28 + 29 + 30)/3 = 29; of four the tenth is the largest alone"""
    falling = np.arange(30.0, 0.0, -1.0)
    assert (highest_mean(falling, 1 / 3), highest_mean(falling, 1 / 10)) == (25.5, 29.0)
    assert highest_mean(np.array([4.0, 3.0, 2.0, 1.0]), 1 / 10) == 4.0


def test_the_extreme_of_a_duration_follows_the_number_of_its_waves():
    """Cartwright & Longuet-Higgins (1956): σ(√(2 ln N) + γ/√(2 ln N)); 1000 waves 3.872 σ, 100 waves 3.225 σ"""
    t = STEP * np.arange(24 * 600)
    record = np.sqrt(2) * np.cos(SINE * t)
    for waves, factor in ((1000, 3.872), (100, 3.225)):
        assert record_statistics(record, STEP, 0.3, duration=waves * 12.0).extreme == pytest.approx(factor, rel=2e-3)


def test_what_is_rounding_beside_the_hull_and_what_else_moves_does_not_vary():
    """A hull of 100 m and 5e8 N: surge of 7e-16 m where nothing moves; beside heave of 1 m a millionth of it is none
    and two millionths are some; roll counts by what it moves an end, tensions by the largest of them"""
    units = ["m", "m", "rad", "N", "N"]
    nothing = stillness([7e-16, 1e-12, 1e-15, 0.0, 0.1], units, 100.0, 5e8)
    assert np.allclose(nothing, [1e-7, 1e-7, 2e-9, 0.5, 0.5])
    moving = stillness([1e-6, 1.0, 1e-9, 1e5, 2e-1], units, 100.0, 5e8)
    assert np.allclose(moving, [1e-6, 1e-6, 2e-8, 0.5, 0.5])
    t = STEP * np.arange(4000)
    for amplitude, varies in ((0.9e-6, False), (2.0e-6, True)):
        found = record_statistics(amplitude * np.sqrt(2) * np.sin(SINE * t), STEP, 0.3)
        told = without_rounding(found, moving[0])
        assert np.isfinite(told.T_zero) == varies and (told.sigma > 0) == varies and (told.largest > 0) == varies
    steady = without_rounding(record_statistics(4e5 + 0.3 * np.sin(SINE * t), STEP, 0.3), moving[3])
    assert steady.mean == pytest.approx(4e5) and steady.sigma == 0 and steady.largest > 0


def test_waves_of_one_and_two_frequencies_are_told_from_a_sea():
    t = STEP * np.arange(1200)  # ten minutes
    one, two = np.sin(SINE * t), np.sin(SINE * t) + np.sin(0.61 * t + 1.0)
    assert 1 <= frequencies_in(one) < frequencies_in(two) < FEW
    sea = gaussian(0.4, 1.2, 4, hours=1 / 6)
    assert frequencies_in(sea) > 3 * FEW and frequencies_in(np.ones(100)) == 0
