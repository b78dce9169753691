"""Long waves past a rectangle: pressures integrated over its sides, the head that is lost, forces on lines."""

import math

import numpy as np
import pytest

from hakobune.mooring.breakwater.holdings import Response, fixed_response, long_wave_response, mean_drift
from hakobune.mooring.breakwater.long_waves import FixedBody, equal_area, line_tensions, long_wave, moment_factor
from hakobune.mooring.breakwater.loss import Keel, with_loss

G, H, D, L, Z0 = 9.8, 12.0, 4.0, 5.0, -1.5
OMEGA = np.array([0.5, 0.9, 1.4])
WATER = {"density": 1000.0, "gravity": G}


def test_factors_are_means_of_the_pressure_of_a_wave_over_side_and_bottom():
    """f_H the mean of cosh k(z+h)/cosh kh over the draft, f_B its mean over the gap; ω² = gk tanh kh; n = C_g/C"""
    wave = long_wave(L, D, H, OMEGA, G)
    x, w = np.polynomial.legendre.leggauss(30)
    for i, k in enumerate(wave.k):
        assert OMEGA[i] ** 2 == pytest.approx(G * k * math.tanh(k * H))
        assert wave.n[i] == pytest.approx(0.5 + k * H / math.sinh(2 * k * H))
        pressure = lambda z, k=k: np.cosh(k * (z + H)) / math.cosh(k * H)  # noqa: E731
        side, gap = 0.5 * D * (x - 1), -H + 0.5 * (H - D) * (x + 1)
        assert wave.f_H[i] == pytest.approx(w @ pressure(side) / 2)
        assert wave.f_B[i] == pytest.approx(w @ pressure(gap) / 2)
        assert wave.y_B[i] == pytest.approx(G * k * (H - D) * wave.f_B[i] ** 2 / (OMEGA[i] ** 2 * L * wave.n[i]))


def test_the_factor_of_the_moment_is_that_of_pressures_on_both_sides_and_under_the_keel():
    """Sides ±p(z) with arm z − z₀, over the draft times the half width, and a head that goes over linearly below:
    ∫ p(z)(z − z₀) dz/(d l) + f_B l/3d"""
    wave = long_wave(L, D, H, OMEGA, G)
    x, w = np.polynomial.legendre.leggauss(30)
    z = 0.5 * D * (x - 1)
    found = moment_factor(wave, L, D, H, Z0)
    for i, k in enumerate(wave.k):
        sides = 0.5 * D * w @ (np.cosh(k * (z + H)) / math.cosh(k * H) * (z - Z0)) / (D * L)
        y = 0.5 * L * (x + 1)
        under = 0.5 * L * w @ (wave.f_B[i] * (y / L) * y) / (D * L)
        assert found[i] == pytest.approx(sides + under)


def test_a_fixed_rectangle_keeps_the_energy_and_has_the_force_of_the_head_between_its_sides():
    found = long_wave_response("fixed", L, D, H, OMEGA, WATER)
    assert abs(found.transmission) ** 2 + abs(found.reflection) ** 2 == pytest.approx(np.ones(3))
    wave = long_wave(L, D, H, OMEGA, G)
    assert abs(found.transmission) == pytest.approx(wave.y_B / np.hypot(1, wave.y_B))
    assert np.isnan(found.front).all() and not found.sway.any()
    held = long_wave_response("fixed", L, D, H, OMEGA, WATER, angle=math.radians(60))
    both = (held.front + held.back) * math.sin(math.radians(60))
    assert both == pytest.approx(2 * 9800 * L * wave.f_B)
    assert (held.front - held.back) * 0.5 == pytest.approx(2 * 9800 * D * wave.f_H / (1 + 1j * wave.y_B))


def test_lines_that_hold_a_body_carry_its_forces():
    """Front and back at 30°: (P_F − P_B) cos α = F_y, (P_F + P_B) sin α = F_z"""
    front, back = line_tensions(6.0, 4.0, math.radians(30))
    assert (front - back) * math.cos(math.radians(30)) == pytest.approx(6.0)
    assert (front + back) * 0.5 == pytest.approx(4.0)
    line_tensions(6.0, 4.0, math.radians(89.9))
    for degrees in (0.0, 90.0):
        with pytest.raises(ValueError, match=f"fixed body are at {degrees:g}°"):
            line_tensions(6.0, 4.0, math.radians(degrees))


def test_drift_is_the_momentum_that_comes_and_does_not_leave():
    """½ρg n cos²θ (1 + K_R² − K_T²) of K_R = 0.6, K_T = 0.5"""
    body = FixedBody(*(np.full(3, value + 0j) for value in (0.5j, 0.6, 0, 0)))
    wave = long_wave(L, D, H, OMEGA, G)
    found = mean_drift(fixed_response(body), OMEGA, H, density=1000.0, gravity=G, obliquity=math.radians(60))
    assert found == pytest.approx(0.5 * 9800 * wave.n * 0.25 * (1 + 0.36 - 0.25))


def test_power_that_is_lost_is_that_of_the_head_through_the_gap():
    """1 − K_R² − K_T² of ½ρg C_g a² is ½ρg Re ΔH Q*, ΔH = (8/3π) C |Q| Q/(2g s²), Q = (ω n/k f_B)(a/2)(1 − O)"""
    C, a, s = 1.7, 0.8, H - D
    still = long_wave_response("fixed", L, D, H, OMEGA, WATER, angle=1.0)
    found, wave = with_loss(still, C, a, OMEGA, Keel(L, D, H, G)), long_wave(L, D, H, OMEGA, G)
    odd = (found.reflection - found.transmission) * np.exp(2j * wave.k * L)
    Q = OMEGA * wave.n / (wave.k * wave.f_B) * a / 2 * abs(1 - odd)
    head = 8 / (3 * math.pi) * C * Q**2 / (2 * G * s**2)
    coming = wave.n * OMEGA / wave.k * a * a
    kept = abs(found.transmission) ** 2 + abs(found.reflection) ** 2
    assert (1 - kept) * coming == pytest.approx(head * Q, rel=1e-6)
    assert found.reflection + found.transmission == pytest.approx(still.reflection + still.transmission)
    assert found.front + found.back == pytest.approx(still.front + still.back)
    before = (still.reflection - still.transmission) * np.exp(2j * wave.k * L)
    assert (found.front - found.back) / (still.front - still.back) == pytest.approx((1 + odd) / (1 + before))


@pytest.mark.parametrize(
    ("fine", "wrong"), [((0.0, 1.0), (-0.1, 1.0)), ((1e4, 1.0), (10001.0, 1.0)), ((1.0, 0.0), (1.0, -0.1))]
)
def test_coefficients_of_loss_at_either_side_of_what_is_allowed(fine, wrong):
    still, keel = long_wave_response("fixed", L, D, H, OMEGA, WATER), Keel(L, D, H, G)
    assert isinstance(with_loss(still, *fine, OMEGA, keel), Response)
    with pytest.raises(ValueError, match=f"loss coefficient is {wrong[0]:g} and amplitude {wrong[1]:g} m"):
        with_loss(still, *wrong, OMEGA, keel)


def test_a_square_of_the_area_of_a_circle_has_its_middle():
    half, draft = equal_area(2.0, 1.5)
    assert (2 * half) ** 2 == pytest.approx(math.pi)
    assert draft - half == pytest.approx(0.5)  # depth of the middle of both


@pytest.mark.parametrize("sizes", [(0.0, 4, 12), (5, 0.0, 12), (5, 12.0, 12)])
def test_lengths_that_are_no_section_are_refused(sizes):
    long_wave(0.1, 0.1, 12, OMEGA, G)
    long_wave(5, 11.99, 12, OMEGA, G)
    with pytest.raises(ValueError, match="allowed: 0 < draft < depth"):
        long_wave(*sizes, OMEGA, G)
