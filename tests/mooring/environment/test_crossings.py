"""Zero crossings: exact waves, orders of convergence, Rice's rates, Rayleigh's heights."""

import math

import numpy as np
import pytest

from hakobune.mooring.environment.crossings import expected_maximum_height, rayleigh_height, zero_crossings
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc, jonswap, tabulated
from hakobune.mooring.environment.wave_records import elevation


def test_waves_of_a_sine_are_found_at_high_order():
    """Heights by the parabola to the fourth order of the step, periods by the chord to the second and more."""
    height, period = [], []
    for n in (20, 40, 80):
        step = 10.0 / (n + 0.317)  # so that crests fall at many places between the values
        found = zero_crossings(1.5 * np.sin(2 * np.pi / 10 * (step * np.arange(37 * n) + 0.123)), step)
        assert len(found) in (35, 36)
        height.append(np.abs(found.heights - 3.0).max())
        period.append(np.abs(found.periods - 10.0).max())
    assert np.all(np.log2(np.divide(height[:-1], height[1:])) > 3.5), height
    assert period[-1] < 1e-3 and height[0] < 3.0 * (np.pi / 20) ** 4


def test_highest_waves_are_picked_by_height_with_their_periods():
    amplitudes, periods = np.array([1, 4, 2, 6, 3, 5.0]), np.array([5, 9, 6, 11, 7, 10.0])
    step, waves = 0.01, []
    for a, period in zip(amplitudes, periods, strict=True):
        waves.append(a * np.sin(2 * np.pi * np.arange(0, period, step) / period))
    record = np.concatenate([[-1e-6], *waves, [1e-6]])
    found = zero_crossings(record, step)
    np.testing.assert_allclose(found.heights, 2 * amplitudes, rtol=2e-3)
    np.testing.assert_allclose(found.periods, periods, atol=0.03)
    assert abs(found.significant_height - 11) < 0.02 and abs(found.significant_period - 10.5) < 0.02
    assert abs(found.maximum_height - 12) < 0.02 and abs(found.mean_period - 8) < 0.02
    assert found.tenth_height == found.maximum_height


def test_a_record_upside_down_swaps_crests_with_troughs_and_up_with_down():
    record = np.random.default_rng(2).standard_normal(500).cumsum()
    record -= np.linspace(record[0], record[-1], 500)
    up, down = zero_crossings(record, 0.3), zero_crossings(-record, 0.3, "down")
    np.testing.assert_allclose(up.crests, -down.troughs, rtol=1e-12)
    np.testing.assert_allclose(up.troughs, -down.crests, rtol=1e-12)
    np.testing.assert_allclose(up.periods, down.periods)


def test_crossings_and_maxima_come_at_the_rates_of_rice():
    """Mean period T02, mean time between maxima 2π√(m₂/m₄); ten hours of a band cut at 2 rad/s."""
    spectrum = jonswap(3.0, peak_period=10.0)
    components = Sea(spectrum).components(4000, 1, high=2.0)
    m = [spectrum.moment(n, components.omega[0], 2.0) for n in (0, 2, 4)]
    record = elevation(components, 0.1 * np.arange(360_000))
    found = zero_crossings(record, 0.1)
    # about 4600 waves whose number has a relative standard deviation below 1 %
    assert abs(found.mean_period / (2 * np.pi * math.sqrt(m[0] / m[1])) - 1) < 0.02
    assert abs(found.maxima_per_wave / math.sqrt(m[0] * m[2] / m[1] ** 2) - 1) < 0.02


def test_heights_of_a_narrow_spectrum_are_those_of_rayleigh():
    """A band of ±3 %, whose waves come in groups of twenty; heights over the deviation of their own record."""
    omega = 0.6 * np.array([0.97, 1.0, 1.03])
    sea, parts = Sea(tabulated(omega, [0.0, 1.0, 0.0])), []
    for seed in range(20):
        record = elevation(sea.components(400, seed, amplitudes="random"), np.arange(14_000.0))
        found = zero_crossings(record, 1.0)
        parts.append(np.array([found.mean_height, found.significant_height, found.tenth_height]) / record.std())
    # a record has about eighty groups: its deviation and its highest waves are known to 1/80 and scatter less
    theory = [rayleigh_height(1.0, part) for part in (1, 1 / 3, 1 / 10)]
    assert np.abs(np.mean(parts, axis=0) / theory - 1).max() < 0.03


def test_waves_of_a_broad_sea_are_lower_than_rayleigh_by_the_known_tenth():
    """Zero-crossing H1/3 of wind seas is 0.92 to 0.96 of 4.004√m₀ (Forristall 1978: 0.942 for storm seas)."""
    spectrum, ratios = issc(3.0, mean_period=8.0), []
    for seed in range(8):
        record = elevation(Sea(spectrum).components(500, seed), 0.25 * np.arange(43_200))
        ratios.append(zero_crossings(record, 0.25).significant_height / rayleigh_height(np.var(record), 1 / 3))
    assert 0.92 < np.mean(ratios) < 0.97


def test_ratios_of_rayleigh_are_those_the_report_prints():
    """SR179 report (1982), appendix 1: H̄ = 2.506, H1/3 = 4.004, highest of 100 = 6.45 times √m₀."""
    assert abs(rayleigh_height(1.0, 1.0) - 2.506) < 1e-3
    assert abs(rayleigh_height(1.0, 1 / 3) - 4.004) < 5e-4
    assert abs(rayleigh_height(1.0, 1 / 10) - 5.091) < 5e-4
    assert abs(expected_maximum_height(1.0, 100) / 6.45 - 1) < 5e-3


def test_the_highest_of_a_thousand_amplitudes_is_the_factor_of_the_report():
    """SR179 report (1982), eq. 3.7.1.3: 3.87 times the standard deviation, half a height."""
    assert abs(0.5 * expected_maximum_height(1.0, 1000) - 3.87) < 5e-3


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: zero_crossings(np.sin(np.arange(-3, 10, 0.1)), 0.1),
            "the record has 1 complete waves; allowed: at least 3; give a longer record",
        ),
        (lambda: zero_crossings(np.ones(100), 0.1), "the record has 0 complete waves; allowed: at least"),
        (lambda: zero_crossings([1.0, np.inf, 2.0], 0.1), "record is inf at index 1"),
        (lambda: zero_crossings(np.sin(np.arange(100)), 0.0), "step is 0 s"),
        (lambda: zero_crossings(np.sin(np.arange(100)), 1.0, "left"), "allowed: up, down"),
        (lambda: zero_crossings(np.sin(np.arange(100)), 1.0).highest(0), "highest waves to average is 0"),
        (lambda: rayleigh_height(1.0, 2), "the fraction of the highest waves to average is 2"),
        (lambda: expected_maximum_height(1.0, 3), "number of waves is 3; allowed: at least 10"),
    ],
)
def test_what_cannot_be_is_refused(call, words):
    with pytest.raises(ValueError, match=words):
        call()
