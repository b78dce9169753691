"""Functions under a keel and modes in depth: each moment against its integral, sums over modes against known ones."""

import numpy as np
import pytest
from exact.water_waves import evanescent_wavenumbers as by_bisection
from exact.water_waves import wavenumber
from scipy.integrate import quad
from scipy.special import eval_gegenbauer, gamma, jv, zeta

from hakobune.bem.depth_modes.gap import Gap, evanescent_wavenumbers, mode_sum, smooth_cutoff, tail_weights
from hakobune.bem.depth_modes.gap_profiles import Profiles
from hakobune.bem.waves import depth_factor

G = 9.80665
GAP = Gap(5.0, 8.0, 3)  # 3 m under the keel
S, D, H = 3.0, 5.0, 8.0
NU, P = np.repeat([1 / 6, 5 / 6, 1 / 2], 3), np.tile([0, 1, 2], 3)


def moment(f, weight):
    """∫ U weight dζ of function f, its mean that of p = 0 made one; ζ = s sin x takes the edge's singularity away"""
    nu, p = NU[f], P[f]

    def integrand(x, order, w):
        u = S ** (2 * nu - 1) * np.cos(x) ** (2 * nu) * S * eval_gegenbauer(2 * order, nu, np.sin(x))
        return u * w(S * np.sin(x))

    ends = 0, np.pi / 2
    scale = quad(integrand, *ends, args=(0, lambda z: 1.0), limit=200)[0] / S
    # Gegenbauer's integral has (−1)ᵖ J₂ₚ₊ν / (ls)^ν for every p: that fixes the size of the others
    size = quad(integrand, *ends, args=(p, np.cos if p == 0 else (lambda z: np.cos(2.0 * z))), limit=200)[0]
    l = 1.0 if p == 0 else 2.0
    expected = S * (-1) ** p * 2**nu * gamma(1 + nu) * jv(2 * p + nu, l * S) / (l * S) ** nu
    assert p > 0 or size / scale == pytest.approx(expected, rel=1e-6)
    return quad(integrand, *ends, args=(p, weight), limit=200)[0] * (expected / size)


@pytest.mark.parametrize("f", range(9))
def test_moments_of_the_functions_are_their_integrals(f):
    k, l = 0.4, np.array([0.7, 1.9, 5.0])
    assert (GAP.families[0][f], GAP.families[1][f], GAP.decays[f]) == (NU[f], P[f], NU[f] + 0.5)
    assert GAP.mean[f] == pytest.approx(moment(f, lambda z: 1.0), abs=1e-6)
    assert GAP.second_moment[f] == pytest.approx(moment(f, lambda z: z * z), abs=1e-5)
    for i, one in enumerate(l):
        assert GAP.cosine_moments(l)[f, i] == pytest.approx(moment(f, lambda z, one=one: np.cos(one * z)), abs=1e-6)
    wave = moment(f, lambda z: np.cosh(k * z) / np.cosh(k * H))
    assert GAP.wave_moments(k)[f] == pytest.approx(wave, rel=1e-5, abs=1e-9)


def test_rows_of_the_side_and_of_the_gap_are_their_integrals():
    """1 and z on the side, 1 and ζ² in the gap"""
    l, k = np.array([0.4, 2.3]), 0.3
    rows, wave = GAP.outer_rows(l), GAP.wave_rows(k)
    for i, one in enumerate(l):
        for place, power in ((-2, 0), (-1, 1)):
            exact = quad(lambda z, one=one, power=power: z**power * np.cos(one * (z + H)), -D, 0)[0]
            assert rows[place, i] == pytest.approx(exact, abs=1e-12)
    for place, power in ((-2, 0), (-1, 1)):
        exact = quad(lambda z, power=power: z**power * np.cosh(k * (z + H)) / np.cosh(k * H), -D, 0)[0]
        assert wave[place] == pytest.approx(exact, rel=1e-12)
    q = np.arange(1, 4) * np.pi / S
    inner = GAP.inner_rows(q)
    for i, one in enumerate(q):
        assert inner[-1, i] == pytest.approx(quad(lambda z, one=one: z * z * np.cos(one * z), 0, S)[0], abs=1e-12)
    assert not inner[-2].any() and GAP.mean_rows()[-2:] == pytest.approx([S, S**3 / 3])
    assert GAP.outer_decays[-2:] == pytest.approx([1, 1]) and GAP.inner_decays[-2:] == pytest.approx([2, 2])


def test_the_wave_on_the_side_alone_is_projected_on_itself_and_on_cosines():
    k, l = 0.3, np.array([0.4, 2.3])
    own, others = GAP.side_wave_moments(k, l)

    def Z(z):
        return np.cosh(k * (z + H)) / np.cosh(k * H)

    assert own == pytest.approx(quad(lambda z: Z(z) ** 2, -D, 0)[0], rel=1e-12)
    assert others == pytest.approx([quad(lambda z, a=a: Z(z) * np.cos(a * (z + H)), -D, 0)[0] for a in l], rel=1e-12)


def test_modes_outside_have_their_wavenumbers_and_norms():
    modes = GAP.outer_modes(0.9, 5, G)
    assert modes.k == pytest.approx(wavenumber(0.9, H)) and modes.wavenumbers == pytest.approx(by_bisection(0.9, H, 5))
    assert modes.wave_norm == pytest.approx(quad(lambda z: depth_factor(z, modes.k, H) ** 2, -H, 0)[0], rel=1e-12)
    exact = [quad(lambda z, a=a: np.cos(a * (z + H)) ** 2, -H, 0)[0] for a in modes.wavenumbers]
    assert modes.norms == pytest.approx(exact, rel=1e-12)
    assert evanescent_wavenumbers(5.0, H, 3, G) == pytest.approx(by_bisection(5.0, H, 3))
    inner = GAP.inner_modes(3)
    assert inner.wavenumbers == pytest.approx(np.arange(1, 4) * np.pi / S)


@pytest.mark.parametrize("power", [1.5, 2.0, 3.0])
def test_sums_over_modes_are_carried_on_to_infinity(power):
    """ζ(power) of 60 terms; what oscillates is gone faster than any power: Σ cos(2.5 n)/n^power of 400"""
    n, many = np.arange(1.0, 401), np.arange(1.0, 1e6)
    assert tail_weights(60, power) @ n[:60] ** -power == pytest.approx(zeta(power), rel=1e-6)
    exact = np.sum(np.cos(2.5 * many) * many**-power)
    assert tail_weights(400, power) @ (np.cos(2.5 * n) * n**-power) == pytest.approx(exact, abs=1e-6)
    assert smooth_cutoff(0.05) == pytest.approx(1.0) and smooth_cutoff(1.2) == pytest.approx(0.0, abs=1e-12)
    assert smooth_cutoff(0.55) == pytest.approx(0.5)


def test_a_sum_of_products_has_the_decay_of_both_rows():
    """Σ (1/n) (1/n)(1/√n) and of each with itself"""
    n = np.arange(1, 101)
    rows = np.stack([1 / n, n**-0.5])
    found = mode_sum(rows, np.array([1.0, 0.5]), 1.0 / n)
    expected = [[zeta(3.0), zeta(2.5)], [zeta(2.5), zeta(2.0)]]
    assert found == pytest.approx(np.array(expected, float), rel=1e-7)


def test_profiles_are_orthonormal_in_the_norm_of_the_flow_beneath():
    """⟨u, Σ 2/(s l_q) cos cos u⟩ + (∫u)², by twenty thousand modes"""
    profiles = Profiles(GAP, 1e-6)
    l = np.arange(1, 20001) * np.pi / S
    moments = GAP.cosine_moments(l)
    norm = (moments * (2 / S / l)) @ moments.T + np.outer(GAP.mean, GAP.mean)
    own = profiles.combinations[:-2, :-2]
    assert own @ norm @ own.T == pytest.approx(np.eye(len(own)), abs=1e-3)
    assert 3 < len(own) <= 9 and profiles.height == S
    assert profiles.mean == pytest.approx(own @ GAP.mean) and profiles.second_moment == pytest.approx(
        own @ GAP.second_moment
    )
    assert profiles.mean_rows[-2:] == pytest.approx([S, S**3 / 3])
    values = np.random.default_rng(1).normal(size=(11, 11, 2))
    expected = np.einsum("ab,bdc,ed->aec", profiles.combinations, values, profiles.combinations)
    assert profiles.products(values) == pytest.approx(expected)
