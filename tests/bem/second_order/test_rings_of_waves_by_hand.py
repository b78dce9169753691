"""Rings of points around a body and what is known on them: where they are, how many, harmonics, slopes; Bessel sums."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import hankel1, hankel1e, hankel2, jv, jvp

from hakobune.bem.second_order import surface_far
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.surface_far import Rings

CENTRE = np.array([2.0, -1.0])


def test_orders_that_a_body_sends_are_those_of_its_circle_and_a_few_more():
    """x + 4 ∛x + 1"""
    x = np.array([0.0, 1.0, 8.0, 30.0])
    wanted = [int(one + 4 * one ** (1 / 3) + 1 + 1e-12) for one in x]
    assert surface_far.orders_sent(x).tolist() == wanted == [surface_far.orders_sent(float(one)) for one in x]
    assert wanted[:3] == [1, 6, 17]


def test_directions_resolve_a_product_of_three_waves():
    """Of orders up to 3M, of which the mean is taken: more than 3M + 1, divisible by four"""
    assert [surface_far.directions(most) for most in (0, 1, 5)] == [4, 8, 24]


@pytest.mark.parametrize("kind, depths, waves", [(DIFFERENCE, 2.0, 8.0), (SUM, 4.0, 32.0)])
def test_the_local_part_reaches_some_depths_wave_lengths_or_radii(kind, depths, waves):
    """The smallest of depths, of the larger of waves over k and the radius, and of nine radii more"""
    circle = SimpleNamespace(radius=10.0)
    for depth, k in ((3.0, 0.1), (100.0, 2.0), (1e6, 0.9), (1e6, 1e-3), (np.inf, 0.5)):
        wanted = 10.0 + min(depths * depth, max(waves / k, 10.0), 90.0)
        assert surface_far.reach_of_local(circle, depth, k, kind) == pytest.approx(wanted)


@pytest.mark.parametrize("depth, radius", [(6.0, 10.0), (40.0, 10.0)])
def test_rings_grow_from_half_the_depth_or_radius_to_where_the_longest_wave_has_no_local_part(depth, radius):
    circle = SimpleNamespace(radius=radius, centre=CENTRE)
    k = np.array([0.5, 2.0])
    made = surface_far.rings_about(circle, depth, k, 7, DIFFERENCE)
    end = surface_far.reach_of_local(circle, depth, 0.5, DIFFERENCE)
    widths = np.diff(made.edges)
    assert made.edges[0] == radius and widths[0] == pytest.approx(0.5 * min(depth, radius))
    assert widths[1:] / widths[:-1] == pytest.approx(1.6 * np.ones(len(widths) - 1))
    assert made.edges[-2] < end <= made.edges[-1] and made.centre is CENTRE
    assert made.count == 20  # twice seven orders and four, rounded up to a multiple of four
    assert surface_far.rings_about(circle, depth, 0.5, 6, DIFFERENCE).count == 16


def test_points_lie_between_the_axes_on_gauss_radii_and_harmonics_come_back():
    made = Rings(np.array([3.0, 5.0, 8.0]), 12, CENTRE)
    x = np.polynomial.legendre.leggauss(6)[0]
    assert made.radii == pytest.approx(np.stack([4.0 + x, 6.5 + 1.5 * x]))
    theta = made.directions
    assert theta == pytest.approx((np.arange(12) + 0.5) * np.pi / 6)
    assert sorted(made.orders.tolist()) == list(range(-6, 6))
    rng = np.random.default_rng(1)
    parts = rng.normal(size=(2, 11)) + 1j * rng.normal(size=(2, 11))
    orders = np.arange(-5, 6)
    found = made.transform(parts @ np.exp(1j * np.outer(orders, theta)))
    assert found[:, orders] == pytest.approx(parts)
    assert [made.within(radius) for radius in (3.0, 3.1, 5.0, 5.1, 8.0, 9.0)] == [0, 1, 1, 2, 2, 3]


@pytest.mark.parametrize("w", [0, 1])
def test_values_and_slopes_between_rings_are_those_of_the_polynomial_through_them(w):
    made, f = (
        Rings(np.array([3.0, 5.0, 8.0]), 8, CENTRE),
        np.polynomial.Polynomial([1.0, -2.0, 0.3, 0.01, 0.02, -0.003]),
    )
    x = np.array([-0.9, 0.1, 0.7])
    value, slope = made.interpolation(w, x)
    low, high = made.edges[w : w + 2]
    r = low + (high - low) * (1 + x) / 2
    assert value @ f(made.radii[w]) == pytest.approx(f(r)) and slope @ f(made.radii[w]) == pytest.approx(f.deriv()(r))


@pytest.mark.parametrize("kind", [1, 2])
def test_hankel_functions_of_all_orders_are_without_their_exponential(kind):
    z = np.array([0.7, 3.0, 40.0])
    found = surface_far.hankel_orders(kind, 5, z)
    of, sign = (hankel1, -1) if kind == 1 else (hankel2, 1)
    for m in range(7):
        assert found[m] == pytest.approx(of(m, z) * np.exp(sign * 1j * z), rel=1e-12)
    assert surface_far.hankel_orders(1, 1, np.array([2.0 + 3.0j]))[2] == pytest.approx(hankel1e(2, 2.0 + 3.0j))


def test_orders_of_both_signs_and_slopes_are_those_of_bessel_functions():
    z, k = np.array([0.5, 2.0]), 1.3
    values = jv(np.arange(5)[:, None], z)
    both = surface_far.both_signs(values)
    assert both == pytest.approx(jv(np.arange(-4, 5)[:, None], z))
    value, slope = surface_far.slopes(values, k)
    assert value == pytest.approx(values[:4]) and slope == pytest.approx(k * jvp(np.arange(4)[:, None], z))


def test_orders_sent_about_a_centre_are_those_of_the_kochin_function(monkeypatch):
    """−k²/(4 n ω) times the integrals over panels, n the group factor, seen from the centre; class by class"""
    k, omega, n, most = 0.4, 0.9, 0.8, 3
    c = {(1, 1): [0.5, 1j, 2.0, -1.0, 0.3, 0.0, 1.0], (-1, 1): [0.0, 1.0, -2.0, 0.5j, 0.0, 1.0, 0.2]}
    orders, asked = np.arange(-most, most + 1), []

    def integrals(theta, k, nodes, weights, normals, Z, images, signs, phi, V):
        asked.append((signs, phi.tolist(), V.tolist(), len(theta), weights, normals, images))
        away = np.exp(-1j * k * (np.cos(theta) * CENTRE[0] + np.sin(theta) * CENTRE[1]))
        return np.array([np.exp(1j * np.outer(theta, orders)) @ c[signs] * away])[None]

    monkeypatch.setattr(surface_far, "far_field_integrals", integrals)
    geometry = SimpleNamespace(images="images", signs=lambda cls: cls)
    run = SimpleNamespace(geometry=SimpleNamespace(without_lid=geometry), k=k, omega=omega, group_factor=n,
                          hull=(np.array([[0.0, 0.0, -1.0]]), "weights", "normals"),
                          problem=SimpleNamespace(depth=9.0))  # fmt: skip
    found = surface_far.sent_orders(run, {(1, 1): ([1.0], [2.0]), (-1, 1): ([3.0], [4.0])}, most, CENTRE)
    total = np.sum([c[cls] for cls in c], axis=0)
    assert found[0] == pytest.approx(-(k**2) / (4 * n * omega) * total)
    assert [one[:4] for one in asked] == [((1, 1), [1.0], [2.0], 12), ((-1, 1), [3.0], [4.0], 12)]
    assert {one[4:] for one in asked} == {("weights", "normals", "images")}
