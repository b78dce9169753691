"""Bound waves: the surface condition of second order by differences, set-down of long groups, Stokes, shallow water."""

import numpy as np
import pytest
from exact.bound_wave import amplitude

from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.waves import wavenumber

G = 9.80665


def first_order(omega, beta, depth):
    """φ(x, y, z, t) of a real wave of unit amplitude, written out here"""
    k = wavenumber(omega, depth)

    def potential(x, y, z, t):
        turn = k * (x * np.cos(beta) + y * np.sin(beta)) - omega * t
        return G / omega * np.cosh(k * (z + depth)) / np.cosh(k * depth) * np.sin(turn)

    return potential


def forcing(waves, depth, x, y, t):
    """φ₂_tt + g φ₂_z = −∂/∂t |∇φ|² + (1/g) φ_t ∂/∂z(φ_tt + g φ_z) at z = 0, of a real sea, by differences"""
    d = 1e-3

    def phi(x, y, z, t):
        return sum(wave(x, y, z, t) for wave in waves)

    def slope(f, axis, *at):
        step = np.eye(4)[axis] * d
        return (f(*(at + step)) - f(*(at - step))) / (2 * d)

    def square(*at):
        return sum(slope(phi, axis, *at) ** 2 for axis in range(3))

    def surface(*at):
        step = np.array([0, 0, 0, d])
        twice = (phi(*(at + step)) - 2 * phi(*at) + phi(*(at - step))) / d**2
        return twice + G * slope(phi, 2, *at)

    at = np.array([x, y, 0.0, t])
    return -slope(square, 3, *at) + slope(phi, 3, *at) / G * slope(surface, 2, *at)


@pytest.mark.parametrize("one, two, depth", [((0.9, 0.3), (0.6, 0.3), 15.0), ((1.3, -0.4), (0.8, 0.7), 8.0)])
def test_the_bound_wave_solves_the_surface_condition_of_second_order(one, two, depth):
    """Of the products of the two waves the parts at their difference frequency and at their sum"""
    both = bound_waves(one, two, depth), bound_waves(one, (-two[0], two[1]), depth)
    alone = [first_order(*wave, depth) for wave in (one, two)]
    x, y = 3.0, -2.0
    times = np.linspace(0.0, 2 * np.pi / both[0].omega, 240, endpoint=False)
    found = [forcing(alone, depth, x, y, t) - sum(forcing([w], depth, x, y, t) for w in alone) for t in times]
    expected, basis = [], []
    for bound in both:
        kappa, turn = np.hypot(*bound.number), bound.number @ [x, y] - bound.omega * times
        operator = G * kappa * np.tanh(kappa * depth) - bound.omega**2  # on φ₂ = 2s (g/Ω) sin(κ·x − Ωt)
        expected.append(operator * 2 * bound.amplitude * G / bound.omega * np.sin(turn))
        basis.append(np.stack([np.cos(turn), np.sin(turn)], axis=1))
    part = np.linalg.lstsq(np.concatenate(basis, axis=1), np.array(found), rcond=None)[0].reshape(2, 2)
    for shape, size, known in zip(basis, part, expected, strict=True):
        assert shape @ size == pytest.approx(known, abs=2e-4 * np.abs(known).max())


@pytest.mark.parametrize("kh", [0.3, 1.0, 3.0, 5.0])
def test_at_twice_its_frequency_a_wave_by_itself_carries_that_of_stokes(kh):
    """φ₂ = ⅜ ωa² cosh 2k(z+h)/sinh⁴kh sin 2(kx − ωt): s = ¾K cosh 2kh / sinh⁴kh, which in deep water is nothing"""
    depth = 20.0
    omega = np.sqrt(G * kh / depth * np.tanh(kh))
    bound = bound_waves((omega, 0.4), (-omega, 0.4), depth)
    stokes = 0.75 * omega**2 / G * np.cosh(2 * kh) / np.sinh(kh) ** 4
    assert bound.amplitude == pytest.approx(stokes, rel=1e-10, abs=1e-15)
    assert np.hypot(*bound.number) == pytest.approx(2 * kh / depth, rel=1e-14) and bound.omega == 2 * omega
    assert abs(bound_waves((omega, 0.4), (-omega, 0.4), np.inf).amplitude) < 1e-15


@pytest.mark.parametrize("kh", [0.2, 1.0, 10.0])
def test_at_the_sum_it_keeps_its_digits_and_does_not_know_the_order_of_the_pair(kh):
    depth = 20.0
    omega = np.sqrt(G * kh / depth * np.tanh(kh))
    for other in (omega * (1 + 1e-8), 1.5 * omega):
        for angle in (0.0, 1e-3, 2.0, np.pi):
            found = bound_waves((other, angle), (-omega, 0.0), depth)
            turned = bound_waves((omega, 0.0), (-other, angle), depth)
            known = amplitude(other, -omega, angle - np.pi, depth)
            assert found.amplitude == pytest.approx(known, rel=1e-10, abs=1e-14 * omega**2 / G)
            assert turned.amplitude == pytest.approx(found.amplitude, rel=1e-10, abs=1e-14 * omega**2 / G)
            np.testing.assert_allclose(turned.number, found.number, atol=1e-15)


@pytest.mark.parametrize("kh", [0.2, 0.5, 1.0, 2.0, 5.0])
def test_long_groups_have_the_set_down_of_the_radiation_stress(kh):
    """−g (2n − ½) / 2(gh − C_g²) m per m² (Longuet-Higgins and Stewart 1962), n = ½ + kh/sinh 2kh"""
    depth = 20.0
    omega = np.sqrt(G * kh / depth * np.tanh(kh))
    bound = bound_waves((omega, 0.0), (omega, 0.0), depth)
    k, K = kh / depth, omega**2 / G
    elevation = bound.amplitude - (k**2 - K**2) / (4 * K)  # −(½|∇φ|² + ζ φ_tz)/g
    n = 0.5 + kh / np.sinh(2 * kh)
    set_down = -G * (2 * n - 0.5) / (2 * (G * depth - (n * omega / k) ** 2))
    assert elevation == pytest.approx(set_down, rel=1e-11)


def test_shallow_water_tends_to_the_set_down_that_grows_with_the_fourth_power_of_the_period():
    """s → −3/(4 h (kh)²), Longuet-Higgins and Stewart's −3 g a² / (4 ω² h²) with ω² = g k² h"""
    depth = 10.0
    ratios = []
    for kh in (0.2, 0.1):
        omega = np.sqrt(G * kh / depth * np.tanh(kh))
        s = bound_waves((omega, 0.0), (omega, 0.0), depth).amplitude
        ratios.append(s / (-3 * G / (4 * omega**2 * depth**2)) - 1)
    assert abs(ratios[0]) < 0.05 and ratios[0] / ratios[1] == pytest.approx(4, rel=0.1)


def test_the_order_of_a_pair_does_not_matter_and_directions_enter_by_their_difference():
    one, two = bound_waves((0.7, 0.2), (0.5, 1.0), 20.0), bound_waves((0.5, 2.0), (0.7, 1.2), 20.0)
    assert one.amplitude == pytest.approx(two.amplitude, rel=1e-12)
    assert np.hypot(*one.number) == pytest.approx(np.hypot(*two.number), rel=1e-12)


@pytest.mark.parametrize("kh", [0.05, 0.2, 1.0, 10.0])
def test_it_keeps_its_digits_in_shallow_water_and_as_frequencies_meet(kh):
    depth = 20.0
    omega = np.sqrt(G * kh / depth * np.tanh(kh))
    for apart in (1e-8, 1e-5, 1e-2, 0.5):
        for angle in (0.0, 1e-3, 2.0):
            found = bound_waves((omega * (1 + apart), angle), (omega, 0.0), depth).amplitude
            assert found == pytest.approx(amplitude(omega * (1 + apart), omega, angle, depth), rel=1e-12)


def test_in_deep_water_one_way_it_is_the_waves_of_longuet_higgins():
    """φ₂ = a₁a₂ ω₁ exp{(k₁ − k₂)z} sin{(k₁ − k₂)x − (ω₁ − ω₂)t}, ω₁ > ω₂ (1963), from −(ig/Ω) s of both orders"""
    for one, two in ((0.9, 0.3), (0.6, 0.55)):
        bound = bound_waves((one, 0.0), (two, 0.0), np.inf)
        assert -2 * G / bound.omega * bound.amplitude == pytest.approx(one, rel=1e-12)
        assert bound.number[0] == pytest.approx((one**2 - two**2) / G)


@pytest.mark.parametrize("angle", [0.0, 0.4, 2.0, np.pi])
def test_very_deep_water_is_as_deep_water(angle):
    for one, two in ((0.9, 0.3), (0.6, 0.55), (0.6, 0.6)):
        found, known = (bound_waves((one, angle), (two, 0.0), depth).amplitude for depth in (1e7, np.inf))
        assert found == pytest.approx(known, rel=1e-6, abs=1e-6)
