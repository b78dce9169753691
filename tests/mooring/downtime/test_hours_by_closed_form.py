"""Every hour's integral against closed forms: a body whose |X|² over directions is a short Fourier sum."""

import numpy as np
import pytest

from hakobune.mooring.downtime import planes
from hakobune.mooring.downtime.every_hour import Response, Shape, lagrange, moments_of_hours, ring_of
from hakobune.mooring.downtime.hindcast import WaveHours
from hakobune.mooring.downtime.largest import drawn_of_years, largest_of_hours, return_values
from hakobune.mooring.downtime.planes import moments_of_planes
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower, Mitsuyasu
from hakobune.mooring.seas.shallow import tma

RING = ring_of(72)
OMEGA = np.linspace(0.05, 12.0, 3000)  # of waves of 6 s and more all but 1e-5


def of_harmonics():
    """P = 2 + cos 2β and 3 + cos(β − 0.4), the same at all frequencies"""
    power = np.stack([2 + np.cos(2 * RING), 3 + np.cos(RING - 0.4)], axis=1)
    return Response(("two", "one"), ("m", "m"), OMEGA, np.broadcast_to(power, (len(OMEGA), *power.shape)))


def hours():
    rng = np.random.default_rng(3)
    return WaveHours(rng.uniform(0.5, 6, 40), rng.uniform(6, 15, 40), rng.uniform(0, 2 * np.pi, 40))


def test_long_crested_hours_at_any_direction_have_the_exact_energy():
    waves = hours()
    m0, m2 = moments_of_hours(of_harmonics(), Shape("jonswap", "peak_period"), waves)
    exact = (
        waves.height[:, None] ** 2
        / 16
        * np.stack([2 + np.cos(2 * waves.direction), 3 + np.cos(waves.direction - 0.4)], axis=1)
    )
    np.testing.assert_allclose(m0, exact, rtol=2e-4)  # of the tail beyond the last frequency
    one = jonswap(waves.height[0], peak_period=waves.period[0])
    np.testing.assert_allclose(m2[0] / m0[0], one.moment(2, 0, OMEGA[-1]) / one.moment(0), rtol=2e-3)


def test_spread_hours_have_each_harmonic_by_that_of_the_spreading():
    """∫ (2/π) cos²θ cos 2(β + θ) dθ = ½ cos 2β;  of cos(β + θ): 8/3π"""
    waves = hours()
    m0, _ = moments_of_hours(of_harmonics(), Shape("jonswap", "peak_period", None, CosinePower(2.0)), waves)
    exact = (
        waves.height[:, None] ** 2
        / 16
        * np.stack([2 + 0.5 * np.cos(2 * waves.direction), 3 + 8 / (3 * np.pi) * np.cos(waves.direction - 0.4)], axis=1)
    )
    np.testing.assert_allclose(m0, exact, rtol=3e-4)


def test_spreading_after_mitsuyasu_weakens_each_harmonic_by_its_exponent_at_each_frequency():
    """∫ D cos θ dθ = s/(s + 1) and ∫ D cos 2θ dθ = s(s − 1)/((s + 1)(s + 2)), s by ω over the peak of the hour"""
    waves = WaveHours(np.array([2.0]), np.array([9.3]), np.array([1.1]))
    m0, _ = moments_of_hours(of_harmonics(), Shape("jonswap", "peak_period", None, Mitsuyasu(25.0, 1.0)), waves)
    x, S = OMEGA * 9.3 / (2 * np.pi), jonswap(2.0, peak_period=9.3).density(OMEGA)
    s = 25 * np.where(x <= 1, x**5, x**-2.5)
    exact = [np.trapezoid(S * (2 + s * (s - 1) / ((s + 1) * (s + 2)) * np.cos(2.2)), OMEGA),
             np.trapezoid(S * (3 + s / (s + 1) * np.cos(0.7)), OMEGA)]  # fmt: skip
    np.testing.assert_allclose(m0[0], exact, rtol=1e-5)


def test_seas_of_finite_depth_have_the_energy_of_their_height_and_the_mean_period_that_is_asked():
    waves = WaveHours(np.array([2.0, 0.0]), np.array([7.13, np.nan]), np.array([0.4, 0.0]))
    m0, m1 = moments_of_hours(of_harmonics(), Shape("tma", "mean_period", None, None, 8.0), waves, (0, 1))
    assert m0[0, 1] == pytest.approx(4 / 16 * 4, rel=1e-4) and m0[1, 1] == 0
    assert 2 * np.pi * m0[0, 1] / m1[0, 1] == pytest.approx(7.13, rel=1e-3)
    assert m1[0, 1] / 4 == pytest.approx(tma(2.0, 8.0, mean_period=7.13).moment(1, 0, OMEGA[-1]), rel=1e-4)


def test_planes_have_the_energy_between_their_rows_by_hand():
    """A tent over ω about 1, 0.5 wide on either side, and over θ about 30°, 15° wide: ∬ ω = 0.5 · 1 · π/12"""
    omega, angle = np.array([0.5, 1.0, 1.5]), np.radians(np.arange(0.0, 360.0, 15.0))
    density = np.zeros((2, 3, 24))
    density[0, 1, 2], density[1] = 1.0, np.nan
    of_one = Response(("1",), ("m",), np.linspace(0.1, 3, 31), np.ones((31, 72, 1)))
    (m0, m1), (n0, _) = (moments_of_planes(one, omega, angle, [density], (0, 1)) for one in (of_one, of_harmonics()))
    assert m0[0, 0] == pytest.approx(0.5 * np.pi / 12, rel=1e-9) and m1[0, 0] == pytest.approx(m0[0, 0], rel=2e-3)
    tent = (2 - 2 * np.cos(np.pi / 12)) / (np.pi / 12)  # ∫ cos θ over a tent of width π/12
    assert n0[0, 1] / (0.5 * np.pi / 12) == pytest.approx(3 + np.cos(np.pi / 6 - 0.4) * tent / (np.pi / 12), rel=1e-3)
    assert np.isnan(m0[1]).all()
    sector = np.array([0.0, 1.0, 0.0])[None, :, None] * np.ones(7)  # of 90°: nothing is between its ends
    quarter = moments_of_planes(of_one, omega, angle[:7], [sector], (0,))[0]
    assert quarter[0, 0] == pytest.approx(0.5 * np.pi / 2, rel=1e-9)


def test_calm_hours_are_nil_and_unknown_hours_unknown():
    waves = WaveHours(np.array([0.0, np.nan, 1.0]), np.array([np.nan, 8.0, 8.0]), np.zeros(3))
    m0, _ = moments_of_hours(of_harmonics(), Shape("issc", "mean_period"), waves)
    assert np.all(m0[0] == 0) and np.all(np.isnan(m0[1])) and np.all(m0[2] > 0)


def test_six_nodes_are_exact_for_polynomials_of_degree_five():
    t = np.array([0.0, 0.3, 0.99])
    for degree in range(6):
        np.testing.assert_allclose(lagrange(t) @ np.arange(-2.0, 4.0) ** degree, t**degree, atol=1e-12)


def test_the_largest_of_an_hour_is_that_of_a_narrow_gaussian_record():
    """σ = 1 m, T_zero = 7.2 s: n = 500, s = √(2 ln 500) = 3.5255, s + 0.5772/s = 3.6892"""
    largest = largest_of_hours(np.array([1.0, 0.0]), np.array([(2 * np.pi / 7.2) ** 2, 0.0]), 3600.0)
    np.testing.assert_allclose(largest, [3.6892, 0.0], atol=1e-4)


def test_maxima_of_equal_years_have_the_law_of_their_hours():
    """All hours alike: P(x_y < x) = exp(−N exp(−x²/2)), of which the median is √(2 ln(N/ln 2)), N = a year over 10 s"""
    year = np.repeat(np.arange(100), 8766)
    m0 = np.ones((len(year), 1))
    years, maxima = drawn_of_years(m0, m0 * (2 * np.pi / 10) ** 2, year, 3600.0)
    N = 8766 * 360
    assert len(years) == 100
    assert np.median(maxima) == pytest.approx(np.sqrt(2 * np.log(N / np.log(2))), rel=0.015)
    value, low, high = return_values(maxima, 50.0)
    exact = np.sqrt(2 * np.log(N / -np.log(1 - 1 / 50)))
    assert low[0] < exact < high[0] and value[0] == pytest.approx(exact, rel=0.02)


def test_years_of_which_hours_are_missing_have_no_maximum():
    year = np.repeat([0, 1], [8766, 5000])
    m0 = np.ones((len(year), 1))
    assert list(drawn_of_years(m0, m0, year, 3600.0)[0]) == [0]


@pytest.mark.parametrize("first", [0.0, 20.0, 85.0, 350.0])
@pytest.mark.parametrize("order", [[0, 1, 2, 3], [2, 0, 3, 1]])
def test_a_plane_is_straight_between_its_directions_wherever_the_first_is(first, order):
    """Four directions 90° apart, in any order: 22.5° beyond one it has three quarters of that, a quarter of the next"""
    angle = np.radians((first + 90.0 * np.array(order)) % 360.0)
    for number, place in enumerate(order):
        beta = np.radians(first + 90.0 * place + np.array([0.0, 22.5, 360.0]))
        following = order.index((place + 1) % 4)
        wanted = np.zeros((3, 4))
        wanted[:, number], wanted[1, number], wanted[1, following] = 1.0, 0.75, 0.25
        assert planes._straight(angle, beta) == pytest.approx(wanted, abs=1e-12)


def test_a_sector_of_directions_has_nothing_across_its_gap():
    """20°, 50° and 80° alone: half of each between them, and of their ends only the ends themselves"""
    angle, beta = np.radians([20.0, 50.0, 80.0]), np.radians([35.0, 65.0, 20.0, 79.999999, 81.0, 200.0, 19.0])
    half, none = [0.5, 0.5, 0.0], [0.0] * 3
    wanted = [half, half[::-1], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], none, none, none]
    assert planes._straight(angle, beta) == pytest.approx(np.array(wanted), abs=1e-6)
