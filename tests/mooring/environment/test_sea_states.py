"""Spreading and components: integrals, means in closed form, energies, and what is refused."""

import re
import warnings

import numpy as np
import pytest
from scipy.integrate import quad

from hakobune.mooring.environment.sea import Sea, joined
from hakobune.mooring.environment.spectra import issc, jonswap
from hakobune.mooring.environment.spreading import CosinePower, HalfCosinePower, Mitsuyasu, WrappedNormal

SPECTRUM = issc(3.0, mean_period=8.0)
WIDE = [CosinePower(4), CosinePower(2, -0.5, 1.2), HalfCosinePower(8), WrappedNormal(0.5)]
ROUND = np.deg2rad(np.arange(0, 360, 15.0))


@pytest.mark.parametrize("spreading", [*WIDE, CosinePower(0), HalfCosinePower(0), WrappedNormal(np.pi)], ids=repr)
def test_a_spreading_holds_all_of_the_energy(spreading):
    cuts = [-0.5 * np.pi, -0.5, 0.0, 1.2, 0.5 * np.pi]
    total = quad(lambda a: float(spreading.density(np.array(a))), -np.pi, np.pi, points=cuts, epsabs=1e-11)[0]
    assert abs(total - 1) < 1e-9


def test_factor_of_cosine_to_the_fourth_is_that_of_the_report():
    """SR179 report (1982): a₄ = 8/3π over a half circle."""
    assert abs(CosinePower(4).density(np.array(0.0)) - 8 / (3 * np.pi)) < 1e-14


def test_mean_cosines_are_the_closed_forms():
    """∫ D cos θ dθ: s/(s+1) of cos²ˢ(θ/2), exp(−σ²/2) of the wrapped normal, 3π/8 ⋅ 16/15 ⋅ 8/3π of cos⁴."""
    angle = np.linspace(-np.pi, np.pi, 20001)[:-1]
    for spreading, closed in (
        (HalfCosinePower(3.0), 0.75),
        (HalfCosinePower(25.0), 25 / 26),
        (WrappedNormal(0.7), np.exp(-0.245)),
        (CosinePower(4), 8 / (3 * np.pi) * 16 / 15),
    ):
        mean = np.mean(spreading.density(angle) * np.cos(angle)) * 2 * np.pi
        assert abs(mean - closed) < 1e-8


def test_mitsuyasus_spreading_is_narrowest_at_the_peak():
    spreading, peak = Mitsuyasu(25.0, 0.7), HalfCosinePower(25.0)
    angle = np.linspace(-3, 3, 61)
    np.testing.assert_allclose(spreading.density(angle, 0.7), peak.density(angle), rtol=1e-12)
    # s = 25/32 and 25/2^2.5 an octave below and above
    for omega, s in ((0.35, 25 / 32), (1.4, 25 / 2**2.5)):
        np.testing.assert_allclose(spreading.density(angle, omega), HalfCosinePower(s).density(angle), rtol=1e-12)


@pytest.mark.parametrize("spreading", [*WIDE, Mitsuyasu(10.0, 0.6), None], ids=repr)
def test_shares_of_the_headings_sum_to_one(spreading):
    sea = Sea(SPECTRUM, 0.3, spreading)
    assert abs(sea.directional(ROUND).sum() - 1) < 1e-14
    rows = sea.directional(ROUND, np.array([0.4, 0.8, 1.6]))
    assert rows.shape == (3, 24) and np.abs(rows.sum(axis=1) - 1).max() < 1e-14
    assert np.all(rows >= 0)


def test_mean_over_headings_converges_at_second_order():
    """The mean of cos(θ) over cos²ˢ(θ/2) about 20° is s/(s+1) cos 20°."""
    sea, errors = Sea(SPECTRUM, np.deg2rad(20), HalfCosinePower(4.0)), []
    for n in (8, 16, 32):
        headings = 2 * np.pi * np.arange(n) / n
        errors.append(abs(sea.directional(headings) @ np.cos(headings) - 0.8 * np.cos(np.deg2rad(20))))
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.9), errors


def test_shares_follow_the_headings_whatever_their_order_and_turn():
    sea = Sea(SPECTRUM, 1.0, WrappedNormal(0.4))
    share, mixed = sea.directional(ROUND), np.random.default_rng(1).permutation(24)
    np.testing.assert_allclose(sea.directional((ROUND - 4 * np.pi)[mixed]), share[mixed], atol=1e-12)


def test_half_a_circle_of_headings_serves_a_sea_that_stays_in_it():
    half = np.deg2rad(np.arange(0, 181, 30.0))
    share = Sea(SPECTRUM, np.pi / 2, CosinePower(2)).directional(half)
    np.testing.assert_allclose(share, share[::-1], atol=1e-12)
    with pytest.raises(ValueError, match=r"50\.0 % of the energy travels outside the headings 0, 30, "):
        Sea(SPECTRUM, 0.0, CosinePower(2)).directional(half)


def test_headings_too_far_apart_are_refused():
    with pytest.raises(ValueError, match="more than 45° apart"):
        Sea(SPECTRUM, 0.0, WrappedNormal(0.3)).directional(np.deg2rad(np.arange(0, 360, 60)))
    with pytest.raises(ValueError, match="45° apart"):
        Sea(SPECTRUM, 0.5).directional([0.0, 1.0])
    with pytest.raises(ValueError, match="heading 90° is given twice"):
        Sea(SPECTRUM, 0.5, CosinePower(2)).directional(np.deg2rad([0, 45, 90, 90]))


def test_a_long_crested_sea_lies_between_its_two_headings():
    share = Sea(SPECTRUM, np.deg2rad(20)).directional(ROUND)
    assert np.count_nonzero(share) == 2
    assert abs(share @ ROUND - np.deg2rad(20)) < 1e-14


def test_a_spreading_too_narrow_for_its_sum_is_refused():
    with pytest.raises(ValueError, match="long-crested"):
        CosinePower(2, -1e-3, 1e-3).shares()


@pytest.mark.parametrize("frequencies", ["equal_step", "equal_energy"])
def test_every_band_of_components_holds_its_energy(frequencies):
    spectrum = jonswap(3.0, peak_period=9.0)
    components = Sea(spectrum).components(400, 3, frequencies=frequencies)
    assert np.all(np.diff(components.omega) > 0)
    energy = 0.5 * components.amplitude**2
    assert 0.998 < energy.sum() / spectrum.moment(0) < 1
    for low, high in ((0.4, 0.65), (0.65, 0.8), (0.8, 1.5)):
        inside = (components.omega >= low) & (components.omega < high)
        # at each end one component may stand on either side
        nearest = energy[np.searchsorted(components.omega, [low, high])].sum()
        assert abs(energy[inside].sum() - spectrum.moment(0, low, high)) <= nearest


def test_random_amplitudes_are_those_of_rayleigh():
    """Σ a²/2 of n equal parts has mean m₀ and standard deviation m₀/√n; ⟨a⟩²/⟨a²⟩ = π/4."""
    n = 20_000
    a = Sea(SPECTRUM).components(n, 5, frequencies="equal_energy", amplitudes="random").amplitude
    held = SPECTRUM.moment(0) * (1 - 1e-3 - 1e-5)
    assert abs(0.5 * np.sum(a**2) / held - 1) < 4 / np.sqrt(n)
    # ⟨a⟩ has the relative standard deviation √((4/π − 1)/n)
    assert abs(np.mean(a) / np.sqrt(np.pi / 4 * 2 * held / n) - 1) < 4 * np.sqrt((4 / np.pi - 1) / n)


@pytest.mark.parametrize("spreading", [HalfCosinePower(8), WrappedNormal(0.5), CosinePower(4)], ids=repr)
def test_directions_of_any_band_are_those_of_the_spreading(spreading):
    components = Sea(SPECTRUM, 0.7, spreading).components(1000, 2)
    angle = np.linspace(-np.pi, np.pi, 20001)[:-1]
    mean = np.mean(spreading.density(angle) * np.cos(angle)) * 2 * np.pi
    for band in np.split(np.cos(components.direction - 0.7), 10):
        # multiples of the golden ratio leave no gap above 2.62/n of the circle
        assert abs(band.mean() - mean) < 2.62 / 100


def test_directions_spread_with_the_frequency_where_the_spreading_does():
    sea = Sea(SPECTRUM, 0.0, Mitsuyasu(50.0, SPECTRUM.peak_omega))
    components = sea.components(2000, 2)
    x = components.omega / SPECTRUM.peak_omega
    for low, high in ((0.95, 1.05), (2.0, 2.1)):
        inside = (x >= low) & (x < high)
        s = 50 * np.where(x <= 1, x**5, x**-2.5)[inside]
        n = np.count_nonzero(inside)
        assert n > 20
        assert abs(np.cos(components.direction[inside]).mean() - np.mean(s / (s + 1))) < 2.62 / n


def test_the_same_seed_makes_the_same_sea_and_another_makes_another():
    sea = Sea(SPECTRUM, 0.2, CosinePower(2))
    one, same, other = (sea.components(50, seed) for seed in (7, 7, 8))
    assert all(np.array_equal(a, b) for a, b in zip(one, same, strict=True))
    assert not np.any(one.phase == other.phase) and not np.any(one.omega == other.omega)


def test_components_of_two_seas_keep_the_energy_of_both():
    wind, swell = Sea(SPECTRUM).components(100, 1), Sea(jonswap(1.0, peak_period=15.0), 1.0).components(80, 2)
    both = joined(wind, swell)
    assert len(both.omega) == 180
    assert abs(np.sum(both.amplitude**2) - np.sum(wind.amplitude**2) - np.sum(swell.amplitude**2)) < 1e-12


def test_energy_left_out_is_warned_of_with_its_share():
    missed = 100 * SPECTRUM.moment(0, 1.0) / SPECTRUM.moment(0)
    with pytest.warns(UserWarning, match=f"to 1 rad/s miss {missed:.1f} % of the energy; allowed: 1 %"):
        Sea(SPECTRUM).components(100, 1, high=1.0)
    with pytest.warns(UserWarning, match="rad/s is enough") as told:
        Sea(SPECTRUM).components(100, 1, high=1.0)
    low, high = map(float, re.search(r"%; (\S+) to (\S+) rad/s is enough", str(told[0].message)).groups())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Sea(SPECTRUM).components(100, 1, low=low, high=high)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Sea(SPECTRUM).components(0, 1), "count is 0; allowed: a whole number, at least 1"),
        (lambda: Sea(SPECTRUM).components(2.5, 1), "count is 2.5"),
        (lambda: Sea(SPECTRUM).components(10, -1), "seed is -1"),
        (lambda: Sea(SPECTRUM).components(10, 1, frequencies="even"), "frequencies is 'even'; allowed: equal_step"),
        (lambda: Sea(SPECTRUM).components(10, 1, amplitudes="exact"), "amplitudes is 'exact'; allowed: determ"),
        (lambda: Sea(SPECTRUM).components(10, 1, low=2.0, high=1.0), "components are requested from 2 to 1 rad/s"),
        (lambda: Sea(SPECTRUM, np.inf), "direction of the sea is inf"),
        (lambda: CosinePower(-1), "exponent of the spreading is -1"),
        (lambda: CosinePower(2, -2.0, 1.0), "spreading extends from -2 to 1 rad"),
        (lambda: WrappedNormal(0.0), "sigma of the spreading is 0 rad"),
        (lambda: Mitsuyasu(10, 1.0).density(0.0), "give the frequency omega"),
    ],
)
def test_what_cannot_be_is_refused(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("count", [1, 2, 5000])
def test_neighbours_in_frequency_never_coincide(count):
    omega = Sea(SPECTRUM).components(count, 1, low=0.4, high=3.6).omega
    assert len(omega) == count
    assert np.all(np.diff(omega) >= 0.3 * 3.2 / count * (1 - 1e-9))
