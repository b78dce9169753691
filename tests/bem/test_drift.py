"""Mean drift from Kochin functions that are short Fourier series, whose integrals are sums by hand."""

import numpy as np
import pytest
from exact import maccamy_fuchs

from hakobune.bem.drift import (
    about,
    ahead,
    drift_of_two,
    energy_defect,
    harmonics,
    mean_drift,
    mean_drift_of_series,
    slope_and_ahead,
)

THETA = np.arange(16) * np.pi / 8
WATER = {"density": 1000.0, "gravity": 10.0}
K, N = 0.2, 0.7
SERIES = {  # of two headings: order: coefficient
    0: {-2: 0.3 - 0.2j, 0: 0.5j, 1: -0.4, 3: 0.1 + 0.3j},
    1: {-1: 0.2j, 0: -0.1 + 0.1j, 2: 0.6},
}
BETA = np.array([0.4, 2.1])


def of(series, theta):
    return sum(c * np.exp(1j * m * theta) for m, c in series.items())


def slope_of(series, theta):
    return sum(1j * m * c * np.exp(1j * m * theta) for m, c in series.items())


def by_hand(one, other, beta, gamma):
    """Of two waves, by ∫ Hᵢ H̄ⱼ {cosθ, sinθ} dθ, ∫ H′ᵢ H̄ⱼ dθ term by term"""
    right = sum(c * np.conj(other.get(m + 1, 0j)) for m, c in one.items())
    left = sum(c * np.conj(other.get(m - 1, 0j)) for m, c in one.items())
    cos, sin = np.pi * (right + left), np.pi * (right - left) / 1j
    turning = 2 * np.pi * sum(1j * m * c * np.conj(other.get(m, 0j)) for m, c in one.items())
    H, back = of(one, gamma), np.conj(of(other, beta))
    x = -np.pi * (np.cos(gamma) * H + np.cos(beta) * back) - cos
    y = -np.pi * (np.sin(gamma) * H + np.sin(beta) * back) - sin
    m = 1j * np.pi * (slope_of(one, gamma) - np.conj(slope_of(other, beta))) + 1j * turning
    return 1000.0 * 10.0 * N / (np.pi * K) * np.array([x, y, m / K])


H = np.array([of(series, THETA) for series in SERIES.values()])
SLOPE = np.array([slope_of(series, THETA) for series in SERIES.values()])


def test_drift_is_the_momentum_of_the_waves_far_away():
    """Maruo (1960), Newman (1967), each integral by hand; the moment from Im H̄H′ and H′ ahead"""
    forward = np.array([of(SERIES[i], BETA[i]) for i in (0, 1)])
    forward_slope = np.array([slope_of(SERIES[i], BETA[i]) for i in (0, 1)])
    expected = np.array([by_hand(SERIES[i], SERIES[i], BETA[i], BETA[i]).real for i in (0, 1)])
    found = mean_drift(H, SLOPE, forward, forward_slope, THETA, BETA, K, N, **WATER)
    assert found == pytest.approx(expected, rel=1e-12)
    order, series = harmonics(H, THETA)
    assert mean_drift_of_series(order, series, forward, forward_slope, BETA, K, N, **WATER) == pytest.approx(expected)
    # one by hand to the last: H = c exp(iθ) towards β = 0 pushes by −2πn ρg/πk Re c, and turns by −2π (Re c + |c|²)/k
    c = 0.3 - 0.4j
    single = mean_drift(c * np.exp(1j * THETA)[None], 1j * c * np.exp(1j * THETA)[None], np.array([c]),
                        np.array([1j * c]), THETA, np.zeros(1), K, N, **WATER)[0]  # fmt: skip
    size = 1e4 * N / (np.pi * K)
    assert single == pytest.approx([-2 * np.pi * 0.3 * size, 0.0, -2 * np.pi * (0.3 + 0.25) * size / K], abs=1e-6)


def test_drift_of_two_waves_is_that_of_one_on_its_diagonal_and_hermitian():
    there, there_slope = (np.array([[f(SERIES[i], b) for b in BETA] for i in (0, 1)]) for f in (of, slope_of))
    found = drift_of_two(H, SLOPE, there, there_slope, THETA, BETA, K, N, **WATER)
    expected = np.array([[by_hand(SERIES[i], SERIES[j], BETA[i], BETA[j]) for j in (0, 1)] for i in (0, 1)])
    assert found == pytest.approx(expected, rel=1e-12)
    assert found == pytest.approx(found.conj().swapaxes(0, 1))


def test_two_waves_towards_one_heading_push_with_the_square_of_their_sum():
    """Of the same H, a₁ + a₂ = 1.5: Σ Σ aᵢ aⱼ D_ij is 2.25 times the drift of one"""
    beta = np.array([0.4, 0.4])
    both, slopes = np.repeat(H[:1], 2, axis=0), np.repeat(SLOPE[:1], 2, axis=0)
    there, there_slope = np.full((2, 2), of(SERIES[0], 0.4)), np.full((2, 2), slope_of(SERIES[0], 0.4))
    D = drift_of_two(both, slopes, there, there_slope, THETA, beta, K, N, **WATER)
    a = np.array([1.0, 0.5])
    assert np.einsum("i,j,ijk->k", a, a, D).real == pytest.approx(2.25 * D[0, 0].real)


def test_drift_of_a_cylinder_on_the_bed_from_its_series():
    """Havelock (1940): the sum of MacCamy and Fuchs"""
    a, depth, omega, beta = 10.0, 15.0, 0.8, 0.7
    from exact.water_waves import group_factor, wavenumber

    k = wavenumber(omega, depth)
    theta = np.arange(64) * np.pi / 32
    c = maccamy_fuchs.harmonics(k * a)
    m = np.arange(1, len(c))
    angle = theta - beta
    value = c[0] + 2 * np.cos(np.outer(angle, m)) @ c[1:]
    slope = -2 * np.sin(np.outer(angle, m)) @ (m * c[1:])
    ahead_ = c[0] + 2 * c[1:].sum()
    found = mean_drift(value[None], slope[None], np.array([ahead_]), np.zeros(1, complex), theta, np.array([beta]), k,
                       group_factor(k, depth), 1025.0, 9.80665)[0]  # fmt: skip
    assert found[:2] == pytest.approx(maccamy_fuchs.drift(a, depth, omega, beta), rel=1e-12)
    assert abs(found[2]) < 1e-9 * abs(found[0])
    assert abs(energy_defect(value[None], np.array([ahead_]))[0]) < 1e-12


@pytest.mark.parametrize("first", [0.0, 0.3])
@pytest.mark.parametrize("count", [15, 16])
def test_a_series_is_found_again_with_its_slope_and_its_value_ahead(count, first):
    theta = first + np.arange(count) * 2 * np.pi / count
    values = np.array([of(series, theta) for series in SERIES.values()])
    order, series = harmonics(values, theta)
    assert list(np.diff(order)) == [1] * (count - 1)
    for row, terms in zip(series, SERIES.values(), strict=True):
        assert row == pytest.approx([terms.get(m, 0) for m in order], abs=1e-12)
    slope, value, steep = slope_and_ahead(values, theta, BETA)
    assert slope == pytest.approx(np.array([slope_of(series, theta) for series in SERIES.values()]), abs=1e-12)
    assert value == pytest.approx([of(SERIES[i], BETA[i]) for i in (0, 1)], abs=1e-12)
    assert steep == pytest.approx([slope_of(SERIES[i], BETA[i]) for i in (0, 1)], abs=1e-12)
    assert np.array(ahead(order, series, BETA)) == pytest.approx(np.array([value, steep]), abs=1e-12)


def test_the_highest_harmonic_of_an_even_count_has_no_slope():
    """cos 8θ at 16 angles is ±1: the half of exp(−8iθ) and of exp(8iθ), with a slope of zero at them"""
    slope, _, steep = slope_and_ahead(np.cos(8 * THETA)[None] + 0j, THETA, np.zeros(1))
    assert np.abs(slope).max() < 1e-12 and abs(steep[0]) < 1e-12


def test_what_breaks_energy_is_measured_by_the_largest_of_three():
    """(1/2π) ∫|H|² + Re H(β) over the larger of (1/2π) ∫|H|², |H(β)| and |H|"""
    one = np.full((1, 8), 0.2 + 0j)
    assert energy_defect(one, np.array([-0.04 + 0j])) == pytest.approx([0.0])
    assert energy_defect(one, np.array([-0.03 + 0j])) == pytest.approx([0.01 / 0.2])
    assert energy_defect(one, np.array([-0.8j])) == pytest.approx([0.04 / 0.8])
    assert energy_defect(10 * one, np.array([0j])) == pytest.approx([4 / 4])


def test_the_moment_about_another_point_lacks_the_force_there():
    """M′ = M − (x F_y − y F_x)"""
    load = np.array([[3.0, 5.0, 100.0]])
    assert about(load, (2.0, -1.0, 7.0)) == pytest.approx(np.array([[3.0, 5.0, 100.0 - (2 * 5 + 1 * 3)]]))
    assert load[0, 2] == 100.0
