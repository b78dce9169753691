"""Extremes of Gaussian responses and of records, return periods, long-term distributions."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.wave_records import elevation
from hakobune.mooring.response.extremes import (
    bandwidth,
    exceedance,
    expected_maximum,
    maximum_not_exceeded,
    mean_of_highest,
    record_peaks,
    significant_factor,
)
from hakobune.mooring.response.long_term import YEAR, long_term
from hakobune.mooring.response.return_period import probability_not_exceeded, return_period
from hakobune.mooring.site.extremes import fit_extremes

TABLE = Path(__file__).parents[2] / "published" / "simulation_statistics.csv"
DURATION = 1000 * 10.0  # s, 1000 mean wave periods


def rows():
    with TABLE.open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


@pytest.mark.parametrize("row", rows(), ids=lambda row: f"{row['quantity']} {row['line_type']}")
def test_published_simulation_statistics_follow_from_their_periods_within_three_per_cent(row):
    sigma, zero, peaks = (float(row[key]) for key in ("sigma", "T_zero_s", "T_pp_s"))
    found = significant_factor(np.sqrt(1 - (peaks / zero) ** 2)) * sigma
    # the print gives σ with two digits, half a unit of the last is up to 1.5 % of it
    assert np.isclose(found, float(row["significant_amp"]), rtol=0.03)
    if row["X_1000"]:
        assert np.isclose(expected_maximum(sigma, DURATION, zero), float(row["X_1000"]), rtol=0.03)


@pytest.mark.parametrize(("epsilon", "factor"), [(0.2, 1.99), (0.47, 1.94), (0.69, 1.83), (0.79, 1.74)])
def test_highest_third_of_maxima_of_wide_spectra(epsilon, factor):
    assert np.isclose(significant_factor(epsilon), factor, atol=0.005)


def test_narrow_spectra_have_rayleighs_maxima_and_the_widest_normal_ones():
    """ε = 0: mean of all √(π/2), of a third √(2 ln 3) + 3√(π/2) erfc √ln 3; ε = 1: 0 and 3φ(z), Φ(z) = 2/3."""
    from scipy.special import erfc
    from scipy.stats import norm

    third = np.sqrt(2 * np.log(3)) + 3 * np.sqrt(np.pi / 2) * erfc(np.sqrt(np.log(3)))
    assert np.isclose(mean_of_highest(1.0, 0.0), np.sqrt(np.pi / 2), rtol=1e-6)
    assert np.isclose(significant_factor(0.0), third, rtol=1e-6)
    assert np.isclose(mean_of_highest(1.0, 1.0), 0.0, atol=1e-6)
    assert np.isclose(significant_factor(1.0), 3 * norm.pdf(norm.ppf(2 / 3)), rtol=1e-6)


def test_mean_of_all_maxima_is_that_of_cartwright_and_longuet_higgins():
    """μ₁ = √(π/2) √(1 − ε²) for every width."""
    for epsilon in (0.1, 0.4, 0.7, 0.95):
        assert np.isclose(mean_of_highest(1.0, epsilon), np.sqrt(np.pi / 2 * (1 - epsilon**2)), rtol=1e-6)


def test_maxima_of_a_made_record_have_the_distribution_of_its_moments():
    """All local maxima of six hours, thinned to independent ones: Kolmogorov's test at 1 %."""
    from scipy.stats import kstest

    spectrum = jonswap(2.0, peak_period=8.0)
    limits = (0.4, 2.0)
    with pytest.warns(UserWarning, match="1.9 % of the energy"):
        waves = Sea(spectrum).components(2000, 4, low=limits[0], high=limits[1])
    eta = elevation(waves, np.arange(0, 21600, 0.1))
    top = eta[1:-1][(eta[1:-1] > eta[:-2]) & (eta[1:-1] >= eta[2:])]
    m0, m2, m4 = (np.sum(waves.omega**n * waves.amplitude**2) / 2 for n in (0, 2, 4))
    eps = bandwidth(m0, m2, m4)
    assert kstest(top[::7] / np.sqrt(m0), lambda x: 1 - exceedance(x, eps)).pvalue > 0.01
    assert np.isclose(len(top) * 2 * np.pi * np.sqrt(m2 / m4), 21600, rtol=0.02)


def test_expected_and_median_largest_of_many_gaussian_records_agree_with_the_formulas():
    """Largest of N independent Rayleigh maxima: 4000 draws scatter by 0.1 %; the asymptotic mean errs by 1/(ln N)²."""
    rng = np.random.default_rng(1)
    largest = np.sqrt(-2 * np.log1p(-(rng.random(4000) ** (1 / 1000))))
    assert np.isclose(expected_maximum(1.0, 1000.0, 1.0), largest.mean(), rtol=0.01)
    for p in (0.1, 0.5, 0.9):
        assert np.isclose(maximum_not_exceeded(1.0, 1000.0, 1.0, p), np.quantile(largest, p), rtol=0.01)


def test_thousand_waves_have_the_factor_of_the_report():
    """3.87 σ (SR179 report, eq. 3.7.1.3)"""
    assert np.isclose(expected_maximum(1.0, 1000.0, 1.0), 3.87, atol=0.005)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: bandwidth(1.0, 2.0, 1.0),
            "the moments m0, m2 and m4 do not belong to a spectrum; allowed: above 0, with m2² at most m0 m4",
        ),
        (lambda: expected_maximum(1.0, 10.0, 8.0), "1.25 zero crossings; allowed: above 3"),
        (lambda: maximum_not_exceeded(1.0, 1e4, 8.0, 1.0), "probability is 1.0; allowed: between 0 and 1"),
        (lambda: mean_of_highest(0.0, 0.3), "share of the maxima is 0"),
        (lambda: significant_factor(1.2), "bandwidth ε is 1.2"),
        (lambda: record_peaks([1.0, np.nan]), "a one-dimensional array of finite numbers"),
        (lambda: return_period(20, 1.0), "probability is 1.0; allowed"),
        (lambda: probability_not_exceeded(20, 1.0), "return period is 1.0 years; allowed: above 1"),
        (lambda: long_term([1.0], [1.0], [1.2]), "shares of time sum to 1.2"),
        (lambda: long_term([0.0], [0.0], [1.0]), "zero in every sea state"),
        (lambda: long_term([1.0], [1.0], [1.0]).level(1.0), "cycles; allowed: more than 1"),
        (
            lambda: long_term([1.0], [1.0], [1.0]).level(np.inf),
            "inf s contains inf cycles; allowed: more than 1, finite",
        ),
    ],
)
def test_impossible_input_is_refused_in_one_line(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_peaks_of_a_narrow_record_are_rayleighs():
    """shape 2 and scale √2 σ; a hundred independent groups leave 10 %."""
    spectrum = jonswap(2.0, peak_period=10.0, gamma=10.0)
    with pytest.warns(UserWarning, match="of the energy"):
        waves = Sea(spectrum).components(1000, 6, low=0.5, high=0.8)
    eta = elevation(waves, np.arange(0, 21600, 0.5))
    fit = fit_extremes(record_peaks(eta), "weibull")
    assert np.isclose(fit.shape, 2.0, rtol=0.15) and np.isclose(fit.scale, np.sqrt(2) * eta.std(), rtol=0.1)
    assert np.isclose(fit.value(1000), 3.72 * eta.std(), rtol=0.15)


def test_return_periods_of_the_guideline():
    """20 years with q = 0.5: 29.36 years; 50 years with 1/e: 50.50; and back."""
    assert np.isclose(return_period(20, 0.5), 29.36, atol=0.005)
    assert np.isclose(return_period(50, np.exp(-1)), 1 / (1 - np.exp(-1 / 50)))
    assert np.allclose(probability_not_exceeded(20, return_period(20, [0.1, 0.5, 0.99])), [0.1, 0.5, 0.99])


def test_one_sea_state_all_the_time_is_the_short_term():
    """Level once in t: σ√(2 ln(t/T))."""
    term = long_term([4.0], [4.0 * 0.5**2], [1.0])
    cycles = YEAR * 0.5 / (2 * np.pi)
    assert np.isclose(term.level(YEAR), 2.0 * np.sqrt(2 * np.log(cycles)), rtol=1e-9)
    assert np.isclose(term.crossing_rate(3.0) / term.crossing_rate(0.0), np.exp(-(3.0**2) / 8))
    assert np.isclose(term.not_exceeded(term.level(YEAR), YEAR), np.exp(-1))


@pytest.mark.filterwarnings("error")
def test_a_state_that_never_comes_and_one_that_is_small_change_no_level():
    alone = long_term([4.0], [1.0], [1.0])
    more = long_term([4.0, 1e8, 1e-8], [1.0, 1e8, 1e-8], [1.0, 0.0, 1e-9])
    assert more.level(YEAR) == pytest.approx(alone.level(YEAR), rel=1e-6)


def test_long_term_level_of_many_storms_is_that_of_simulated_maxima():
    """Hourly states of 400 years: the level once in a year is exceeded about 400 times; the scatter is 5 %."""
    rng = np.random.default_rng(5)
    sigma, period, share = np.array([0.5, 1.0, 1.6, 2.2]), np.array([6.0, 8.0, 9.0, 10.0]), [0.6, 0.3, 0.09, 0.01]
    term = long_term(sigma**2, (2 * np.pi / period) ** 2 * sigma**2, share)
    level = term.level(YEAR)
    hours = rng.multinomial(int(400 * YEAR / 3600), share)
    expected = sum(h * 3600 / T * np.exp(-0.5 * (level / s) ** 2) for h, T, s in zip(hours, period, sigma, strict=True))
    draws = 0
    for h, T, s in zip(hours, period, sigma, strict=True):
        draws += rng.binomial(int(h * 3600 / T), np.exp(-0.5 * (level / s) ** 2))
    assert abs(draws - 400) < 4 * 20 and np.isclose(expected, 400, rtol=0.05)
