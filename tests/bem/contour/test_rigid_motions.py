"""Rigid motions of an upright body on its plan: harmonic potentials that move with the bottom, by differences."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, iv, ivp, kv, kvp

from hakobune.bem.contour.hull.under_keel import UnderKeel
from hakobune.bem.contour.plan.circle import Circle, _bessel_ratios
from hakobune.bem.contour.plan.maps import CLASSES, Contour, table_wavenumber
from hakobune.bem.contour.rigid_motions import bottom_integral, motion

S, ALPHAS = 2.5, (0.4, 0.3, 0.7)
POINT, NORMAL = np.array([1.3, -0.8]), np.array([0.6, 0.8])
W = {2: lambda x, y: 1 + 0 * x, 3: lambda x, y: y, 4: lambda x, y: -x}


def psi(dof, x, y, zeta):
    """SR179 report (1982), eq. 2.1.5.25, with any α"""
    a = ALPHAS[dof - 2]
    if dof == 2:
        return (zeta**2 - a * x**2 - (1 - a) * y**2) / (2 * S)
    if dof == 3:
        return (zeta**2 * y - a * x**2 * y - (1 - a) * y**3 / 3) / (2 * S)
    return -(zeta**2 * x - a * x**3 / 3 - (1 - a) * x * y**2) / (2 * S)


@pytest.mark.parametrize("dof", [2, 3, 4])
def test_the_potential_under_the_keel_is_harmonic_at_rest_on_the_bed_and_moves_with_the_bottom(dof):
    h, (x, y) = 1e-3, POINT
    total = sum(psi(dof, x + i * h, y + j * h, 1.1 + k * h) for i, j, k in np.concatenate([np.eye(3), -np.eye(3)]))
    assert (total - 6 * psi(dof, x, y, 1.1)) / h**2 == pytest.approx(0.0, abs=1e-6)
    for zeta, rise in ((0.0, 0.0), (S, W[dof](x, y))):
        assert (psi(dof, x, y, zeta + h) - psi(dof, x, y, zeta - h)) / (2 * h) == pytest.approx(rise, abs=1e-9)


@pytest.mark.parametrize("dof", range(6))
def test_motions_have_their_velocities_on_the_side_and_their_potential_at_the_edge(dof):
    """One node that stands for 1/4 m, and one function that is 1 there: coefficients are the values themselves"""
    contour = Contour(*(np.array([v]) for v in (*POINT, *NORMAL, 0.25)))
    found = motion(dof, contour, np.ones((1, 1)), S, ALPHAS)
    (x, y), (nx, ny) = POINT, NORMAL
    side = [(nx, 0), (ny, 0), (0, 0), (0, -ny), (0, nx), (x * ny - y * nx, 0)][dof]
    assert found.side[:, 0] == pytest.approx(side)
    if dof not in (2, 3, 4):
        assert not found.value.any() and not found.slope.any()
        return
    h = 1e-5
    for zeta in (0.0, 1.7):
        value = found.value[0, 0] + found.value[1, 0] * zeta**2
        assert value == pytest.approx(psi(dof, x, y, zeta))
        slope = (psi(dof, x + h * nx, y + h * ny, zeta) - psi(dof, x - h * nx, y - h * ny, zeta)) / (2 * h)
        assert found.slope[0, 0] + found.slope[1, 0] * zeta**2 == pytest.approx(slope, rel=1e-8)


@pytest.mark.parametrize("dof", range(6))
def test_the_potential_times_the_bottoms_velocity_is_integrated_over_the_plan(dof):
    """∬ ψ w dA of a circle of 2 m, by polar coordinates"""
    circle = Circle(2.0)
    found = bottom_integral(dof, circle.polynomial_contour(6), S, ALPHAS)
    if dof not in W:
        assert found == 0.0
        return
    r, w = np.polynomial.legendre.leggauss(12)
    r, w = 1 + r, w
    theta = np.arange(24) * np.pi / 12
    x, y = r[:, None] * np.cos(theta), r[:, None] * np.sin(theta)
    exact = np.sum((w * r)[:, None] * psi(dof, x, y, S) * W[dof](x, y)) * np.pi / 12
    assert found == pytest.approx(exact, rel=1e-10)


def test_maps_of_a_circle_are_ratios_of_bessel_functions():
    """Kₘ/κKₘ' and Iₘ/κIₘ', times κ; −R/m and R/m of κ → 0; Hₘ/kHₘ' of waves"""
    radius, kappa = 3.0, np.array([0.05, 0.7, 30.0])
    outer, inner = _bessel_ratios(6, kappa * radius)
    m = np.arange(7)[:, None]
    assert outer == pytest.approx(kv(m, kappa * radius) / kvp(m, kappa * radius), rel=1e-10)
    assert inner == pytest.approx(iv(m, kappa * radius) / ivp(m, kappa * radius), rel=1e-10)
    circle = Circle(radius)
    maps, still = circle.maps(6, kappa), circle.laplace(6)
    orders = {(1, 1): [0, 2, 4, 6], (-1, 1): [1, 3, 5], (1, -1): [1, 3, 5], (-1, -1): [2, 4, 6]}
    contour, k = circle.contour(0.8, 6, 1e-8), 0.8
    waves = circle.waves(CLASSES, 6, k, contour, np.array([0.4]))
    total = 0
    for cls, own in orders.items():
        assert circle.orders(cls, 6).tolist() == own
        for i, order in enumerate(own):
            assert maps[cls][0][:, i, i] == pytest.approx(outer[order])
            assert maps[cls][1][:, i, i] == pytest.approx(inner[order])
            free = 0.0 if order == 0 else radius / order
            assert still[cls][1][i, i] == pytest.approx(free) and still[cls][0][i, i] == pytest.approx(-free)
            exact = hankel1(order, k * radius) / (k * h1vp(order, k * radius))
            assert waves[cls].weak[i, i] == pytest.approx(exact, rel=1e-10)
        total = total + waves[cls].wall[:, 0]
    # all classes together: the wave in front of a rigid cylinder (MacCamy and Fuchs 1954)
    n = np.arange(-30, 31)
    theta = np.arctan2(contour.y, contour.x)
    wall = 2j / (np.pi * k * radius * h1vp(n, k * radius)) * 1j ** (n % 4)
    assert total == pytest.approx(np.exp(1j * np.outer(theta - 0.4, n)) @ wall, rel=1e-8)


def test_tables_are_shared_by_waves_up_to_eight_radians_and_then_by_half_as_many_again():
    for waves, expected in ((0.1, 8.0 / 20), (0.399, 0.4), (0.401, 0.6), (0.59, 0.6), (0.61, 0.9)):
        assert table_wavenumber(waves, 20.0) == pytest.approx(expected)


def test_a_circle_resolves_orders_until_waves_on_it_are_as_small_as_the_tolerance():
    """|J_m(x)| beyond ⌈x + (1 + 0.7 d) x^⅓ + d/2 + 1⌉ of d digits"""
    from scipy.special import jv

    for x in (0.5, 4.0, 60.0):
        for digits in (3, 6):
            last = Circle(1.0).degree(x, 10.0**-digits)
            assert last == max(3, int(np.ceil(x + (1 + 0.7 * digits) * np.cbrt(x) + digits / 2 + 1)))
            assert abs(jv(last + 1, x)) < 10.0**-digits
    contour = Circle(5.0).contour(0.3, 4, 1e-4)
    assert contour.weights.sum() == pytest.approx(2.5 * np.pi) and np.hypot(contour.x, contour.y) == pytest.approx(5.0)
    assert Circle(5.0).finest(9) == pytest.approx(6 / 5) and Circle(5.0).alphas == (0.5, 0.25, 0.75)


@pytest.mark.parametrize(("dof", "sign"), [(2, 1), (3, 1), (4, -1)])
def test_on_the_bottom_of_a_circle_it_has_one_order_about_the_axis(dof, sign):
    """(ζ² − r²/2)/2s, or (ζ²r − r³/4)/2s as sin θ or −cos θ, in functions of norm √2πR and √πR"""
    r, R, h = np.array([0.4, 1.1, 1.9]), 3.0, 1e-5
    of = SimpleNamespace(body=SimpleNamespace(profiles=SimpleNamespace(height=S)), radius=R)
    found, before, after = (UnderKeel._particular(of, dof, at, 4) for at in (r, r - h, r + h))
    wanted = (S**2 - r**2 / 2) / (2 * S) if dof == 2 else sign * (S**2 * r - r**3 / 4) / (2 * S)
    assert found[0, :, 0] == pytest.approx(wanted * np.sqrt((2 if dof == 2 else 1) * np.pi * R))
    assert found[1] == pytest.approx((after[0] - before[0]) / (2 * h), abs=1e-8)
    assert np.all(found[:, :, 1:] == 0)


@pytest.mark.parametrize("dof", [2, 3, 4])
def test_over_a_rectangle_every_motion_has_its_own_share(dof):
    """∬ ψ w dA at ζ = s over 6 × 4 m by Gauss points, with another α for heave, roll and pitch"""
    x, w = np.polynomial.legendre.leggauss(6)
    side = [1.5 * (1 + x), 1 + x]  # x of the long side, y of the end
    ones = np.ones(6)
    contour = Contour(
        np.concatenate([3 * ones, side[0]]), np.concatenate([side[1], 2 * ones]), np.concatenate([ones, 0 * ones]),
        np.concatenate([0 * ones, ones]), np.concatenate([w, 1.5 * w]),
    )  # fmt: skip
    X, Y = np.meshgrid(3 * x, 2 * x, indexing="ij")
    true = np.sum(6 * np.outer(w, w) * psi(dof, X, Y, S) * W[dof](X, Y))
    assert bottom_integral(dof, contour, S, ALPHAS) == pytest.approx(true)
