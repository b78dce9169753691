"""Gust spectra against their closed forms and the formulas as printed, records against their spectrum."""

import warnings

import numpy as np
import pytest
from scipy.special import gamma

from hakobune.mooring.environment.gusts import (
    MissingVariance,
    davenport,
    gust_components,
    gust_record,
    hino,
    kaimal,
    npd,
)
from hakobune.mooring.environment.wind_profile import froya_intensity

ALL = [davenport(30.0, 0.003), davenport(50.0, 0.0015), hino(35.0, 0.003, 10.0, 1 / 7), hino(20.0, 0.0015, 50.0, 0.12)]
ALL += [npd(25.0), npd(12.0, 60.0), kaimal(20.0, 30.0, 0.14), kaimal(11.0, 90.0, 0.16)]
BAND = (2e-3 * np.pi, 2 * np.pi)  # 0.001 to 1 Hz, the report's


def integral(spectrum, low=1e-14, high=1e16):
    """∫ S dω, by trapezoids in ln ω"""
    x = np.linspace(np.log(low), np.log(high), 60001)
    return np.trapezoid(spectrum.density(np.exp(x)) * np.exp(x), x)


def test_variance_of_davenport_is_6_K_U2():
    assert np.isclose(integral(davenport(40.0, 0.003)), 6 * 0.003 * 40**2, rtol=1e-6)


def test_variance_of_hino_is_6_007_K_U2():
    """2.856 · ½ Γ(½) Γ(⅓) / Γ(5/6) = 6.0069"""
    assert np.isclose(2.856 * gamma(0.5) * gamma(1 / 3) / (2 * gamma(5 / 6)), 6.007, atol=5e-4)
    assert np.isclose(integral(hino(30.0, 0.003, 10.0, 1 / 7)) / (0.003 * 900), 6.007, atol=5e-4)


def test_variance_of_kaimal_is_that_of_its_intensity():
    assert np.isclose(integral(kaimal(20.0, 30.0, 0.14)), (0.14 * 20) ** 2, rtol=1e-6)


@pytest.mark.parametrize("spectrum", ALL, ids=lambda s: f"{s.name} {s.speed:g}")
def test_variance_and_its_shares_are_the_integrals_of_the_density(spectrum):
    assert np.isclose(integral(spectrum), spectrum.variance, rtol=1e-6)
    for low, high in (BAND, (0.02, 0.03), (1e-6, 1e-3)):
        assert np.isclose(spectrum.share(low, high), integral(spectrum, low, high) / spectrum.variance, rtol=1e-6)
    assert np.isclose(spectrum.share(0.0, np.inf), 1.0, rtol=1e-12)


def test_densities_are_the_formulas_as_published():
    """In f, per Hz; the density per rad/s is 2π times less."""
    f = np.array([0.0005, 0.004, 0.05, 0.3])
    U, K = 28.0, 0.0015
    X = 1200 * f / U
    assert np.allclose(
        2 * np.pi * davenport(U, K).density(2 * np.pi * f), 4 * K * U**2 * X**2 / f / (1 + X**2) ** (4 / 3)
    )
    assert np.allclose(2 * np.pi * davenport(U, K).density(2 * np.pi * f), 8640 * f / (1 + X**2) ** (4 / 3))
    beta = 1.169e-3 * U / 7 / np.sqrt(K) * 2.5 ** (4 / 7 - 1)
    expected = 2.856 * K * U**2 / beta * (1 + (f / beta) ** 2) ** (-5 / 6)
    assert np.allclose(2 * np.pi * hino(U, K, 25.0, 1 / 7).density(2 * np.pi * f), expected)
    tilde = 172 * f * 2.5 ** (2 / 3) * 2.8**-0.75
    expected = 320 * 2.8**2 * 2.5**0.45 / (1 + tilde**0.468) ** (5 / (3 * 0.468))
    assert np.allclose(2 * np.pi * npd(U, 25.0).density(2 * np.pi * f), expected)
    for z, scale in ((25.0, 0.7 * 25), (80.0, 42.0)):
        x = f * 8.1 * scale / U
        expected = (0.12 * U) ** 2 * 4 * x / f / (1 + 6 * x) ** (5 / 3)
        assert np.allclose(2 * np.pi * kaimal(U, z, 0.12).density(2 * np.pi * f), expected)


def test_inertial_subrange_at_10_m_is_that_of_kolmogorov():
    """f S/u*² = 0.3 (f z/U)^(−2/3) (Kaimal et al. 1972), u*² = K U²: what decides between 10⁻² and 10⁻³ in Hino's β."""
    U, K, f = 30.0, 0.003, 1.0
    S = 2 * np.pi * hino(U, K, 10.0, 1 / 7).density(2 * np.pi * f)
    assert np.isclose(f * S / (K * U**2), 0.3 * (f * 10 / U) ** (-2 / 3), rtol=0.15)


def test_npd_spectrum_agrees_with_the_intensity_of_the_same_measurements():
    """Standard deviation within the hour, up to 0.5 Hz; two fits of one data set."""
    for U in (10.0, 20.0, 30.0, 40.0):
        within = np.sqrt(npd(U).variance * npd(U).share(2 * np.pi / 3600, np.pi))
        assert np.isclose(within, froya_intensity(10.0, U) * U, rtol=0.15)


def test_davenport_peaks_where_X_is_the_root_of_3():
    """d/dX of X²/(1+X²)^(4/3) is 0 at X² = 3."""
    s = davenport(30.0, 0.003)
    omega = np.linspace(0.5, 2.0, 3001) * 2 * np.pi * np.sqrt(3) * 30 / 1200
    assert np.isclose(omega[np.argmax(omega * s.density(omega))] / (2 * np.pi), np.sqrt(3) * 30 / 1200, rtol=1e-3)


@pytest.mark.parametrize(("speed", "percent"), [(25.0, 92.4), (35.0, 90.5), (50.0, 88.0)])
def test_the_band_of_the_report_misses_a_tenth_of_davenport_and_says_so(speed, percent):
    spectrum = davenport(speed, 0.003)
    assert np.isclose(100 * spectrum.share(*BAND), percent, atol=0.05)
    with pytest.warns(MissingVariance, match=f"contains {percent} % of the variance of Davenport at {speed:g} m/s"):
        gust_components(spectrum, 1, *BAND, 100)


def test_a_wide_band_is_quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gust_components(davenport(30.0, 0.003), 1, 1e-4, 200.0, 50)


@pytest.mark.filterwarnings("ignore::mooring.environment.gusts.MissingVariance")
class TestRecords:
    def test_components_have_the_energy_of_their_band(self):
        for spectrum in ALL:
            omega, amplitude, _ = gust_components(spectrum, 5, 0.01, 8.0, 300)
            assert np.isclose(np.sum(amplitude**2) / 2, integral(spectrum, 0.01, 8.0), rtol=1e-6)
            part = (omega > 0.1) & (omega < 1.0)
            # a band is known to one component at each end
            assert np.isclose(np.sum(amplitude[part] ** 2) / 2, integral(spectrum, 0.1, 1.0), rtol=0.02)

    def test_an_instant_is_gaussian_with_the_variance_of_the_band(self):
        """3000 records: standard deviation of their variance √(2/3000) = 2.6 %, of their kurtosis √(24/3000) = 0.09."""
        spectrum = davenport(30.0, 0.003)
        u = np.array([gust_record(spectrum, 777.0, seed, *BAND, 100) for seed in range(3000)])
        variance = spectrum.variance * spectrum.share(*BAND)
        assert abs(u.mean()) < 4 * np.sqrt(variance / 3000)
        assert np.isclose(u.var(), variance, rtol=4 * 0.026)
        assert abs(np.mean(u**4) / u.var() ** 2 - 3) < 4 * 0.09

    def test_a_record_does_not_repeat_within_a_day(self):
        """A record of equal steps Δω has the correlation 1 again after 2π/Δω."""
        omega, amplitude, _ = gust_components(davenport(30.0, 0.003), 3, *BAND, 200)
        lag = np.arange(1200.0, 86400.0, 2.0)
        correlation = sum(a**2 * np.cos(w * lag) for w, a in zip(omega, amplitude, strict=True)) / np.sum(amplitude**2)
        assert np.abs(correlation).max() < 0.6
        assert len(np.unique(np.diff(omega))) == 199

    def test_the_seed_decides_the_record_at_any_times(self):
        t = np.arange(0.0, 600.0, 0.5)
        first, again, other = (gust_record(npd(20.0), t, seed, *BAND, 80) for seed in (1, 1, 2))
        assert np.array_equal(first, again) and not np.allclose(first, other)
        assert np.allclose(gust_record(npd(20.0), t[300:310], 1, *BAND, 80), first[300:310])
        omega, amplitude, phase = gust_components(npd(20.0), 1, *BAND, 80)
        assert np.allclose(first[7], np.sum(amplitude * np.cos(omega * t[7] + phase)))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: davenport(-1.0, 0.003), "wind speed is -1 m/s; allowed: above 0"),
        (lambda: davenport(20.0, 15.0), "surface drag K is 15; allowed: 0.0001 to 0.1"),
        (lambda: hino(20.0, 0.003, 0.0, 0.1), "height is 0 m; allowed: above 0"),
        (lambda: hino(20.0, 0.003, 10.0, 0.0), "exponent of the wind profile is 0"),
        (lambda: npd(np.nan), "one-hour wind speed at 10 m is nan m/s"),
        (lambda: kaimal(20.0, 10.0, 14.0), "turbulence intensity is 14; allowed: 0.0001 to 1"),
        (lambda: ALL[0].density(-0.1), "gust frequency is -0.1 rad/s; allowed: at least 0"),
        (lambda: gust_record(ALL[0], 0.0, 1, 0.0, 6.0, 100), "lowest frequency of the gusts is 0 rad/s"),
        (lambda: gust_record(ALL[0], 0.0, 1, 6.0, 0.1, 100), "from 6 to 0.1 rad/s; allowed: increasing"),
        (lambda: gust_record(ALL[0], 0.0, 1, 0.1, 6.0, 0), "number of gust components is 0"),
        (lambda: gust_record(ALL[0], 0.0, None, 0.1, 6.0, 10), "seed is None; allowed: a whole number from 0"),
    ],
)
def test_gusts_that_cannot_be_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
