"""Integrals of three waves beyond a circle: what two circles differ by is between them, by its own form there."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, jv, jve, jvp

from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.surface_far import bessel_orders
from hakobune.bem.second_order.surface_forces import PairsOfOne, Products, _intervals, integrated
from hakobune.bem.second_order.surface_tail import Tails
from hakobune.bem.second_order.surface_waves import Field, SurfaceWaves, Wave
from hakobune.bem.waves import wavenumber

G, DEPTH, ORDERS = 9.80665, 20.0, 4
OMEGA = np.array([0.5, 0.7, 0.9])
RNG = np.random.default_rng(3)


def made_up(omega, incident):
    k = float(wavenumber(omega, DEPTH, G))
    m = np.arange(-ORDERS, ORDERS + 1)
    sent = (RNG.normal(size=m.shape) + 1j * RNG.normal(size=m.shape)) / np.abs(hankel1(m, 6.0))
    return Wave(omega, k, 0.4, incident, sent, np.zeros((0, 6, 8)))


WAVES = [made_up(omega, 1.0 - 0.5j) for omega in OMEGA]


def on_grid(wave, r, theta):
    """`Field` (1, r θ) of the sent wave and of the incident one"""
    m = np.arange(-40, 41)
    turn, z = np.exp(1j * np.outer(m, theta)), wave.k * r[:, None]
    sent = np.pad(wave.sent, (40 - ORDERS, 40 - ORDERS))
    out = []
    for c, value, slope in (
        (sent, hankel1(m, z), wave.k * h1vp(m, z)),
        (wave.incident_orders(40), jv(m, z), wave.k * jvp(m, z)),
    ):
        c = np.where(c == 0, 0, c)
        value, slope = (np.where(c == 0, 0, c * part) for part in (value, slope))
        parts = value, slope, 1j * m * value / r[:, None]
        value, slope, across = ((part @ turn).reshape(1, -1) for part in parts)
        out.append(Field(value, np.stack([slope, across])))
    return out


@pytest.mark.parametrize(
    "one, two, kind", [(2, 1, DIFFERENCE), (1, 0, DIFFERENCE), (2, 0, DIFFERENCE), (2, 0, SUM), (1, 1, SUM)]
)
def test_what_two_circles_differ_by_is_between_them(one, two, kind):
    edges = np.array([50.0, 70.0, 90.0, 250.0])
    of_force = kind.of(OMEGA[one], OMEGA[two])
    psi, third = [made_up(of_force, 0.0)] * 6, [float(wavenumber(w, DEPTH, G)) for w in (0.2, 1.8)]
    found = []
    for begin in (0, 2):
        tails = Tails(WAVES, edges, [begin] * 3, [3] * 3, third, 8.0, G, kind)
        one_pair, out = (
            PairsOfOne(of_force, np.array([one]), np.array([two]), None, psi, None),
            np.zeros((1, 6), complex),
        )
        tails.add(one_pair, out)
        found.append(out[0, 0])
    x, w = np.polynomial.legendre.leggauss(24)
    r, theta = 70.0 + 20.0 * x, 2 * np.pi * np.arange(180) / 180
    weights = np.repeat(20.0 * w * r * 2 * np.pi / 180, 180)
    (sent, coming), (other, met) = (on_grid(WAVES[n], r, theta) for n in (one, two))
    factors = Products.of(OMEGA[[one]], kind.negative(OMEGA[[two]]), G)
    third = on_grid(psi[0], r, theta)[0][None]
    between = integrated(factors, [(sent + coming, other.second(kind)), (sent, met.second(kind))], third, weights)[0, 0]
    assert abs(found[0] - found[1] - between) < 1e-8 * abs(between)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.2])
def test_bessel_functions_are_exact_beside_the_largest_order_and_by_themselves_near_the_origin(angle):
    z = np.geomspace(0.02, 400, 60) * np.exp(1j * angle)
    known = jve(np.arange(32)[:, None], z)
    off = np.abs(bessel_orders(30, z) - known)
    near = np.abs(z) < 40
    assert np.all(off < 1e-12 * np.abs(known).max(axis=0) + 1e-300)
    assert angle == 0 or np.all(off[:, near] < 1e-12 * np.abs(known[:, near]) + 1e-290)


def test_bessel_functions_of_orders_far_above_their_argument_are_finite():
    """Long waves beside a large hull and its shortest ones: J_m beyond what a double can hold is 0"""
    z = np.array([1e-3, 0.1, 0.39, 3.0, 40.0, 90.0, 700.0]) + 0j
    for most in (40, 120, 250):
        known = jve(np.arange(most + 2)[:, None], z)
        assert np.abs(bessel_orders(most, z) - known).max() < 1e-13


@pytest.mark.parametrize("planes", ["", "x", "y", "xy"])
def test_each_direction_of_a_ring_is_an_image_of_one_in_the_meshed_part(planes):
    theta = np.pi / 8 + np.arange(8) * np.pi / 4
    x, y = ((1, -1) if plane in planes else (1,) for plane in "xy")
    images = np.array([(a, b) for b in y for a in x])
    rings = SimpleNamespace(directions=theta, radii=np.array([[3.0], [5.0]]), centre=np.array([0.5, 0.0]))
    place, image, points = SurfaceWaves._quadrant(SimpleNamespace(images=images, rings=rings))
    ray = np.stack([np.cos(theta), np.sin(theta)], axis=1)
    own = (points.reshape(2, -1, 2)[0] - rings.centre) / 3.0
    assert len(own) == 8 // len(images)
    assert points.reshape(2, -1, 2)[1] == pytest.approx(rings.centre + 5.0 * own)
    assert own[place] * images[image] == pytest.approx(ray)
    assert np.bincount(image, minlength=len(images)).tolist() == [8 // len(images)] * len(images)


def test_beyond_the_rings_each_interval_is_wider_by_the_same_share_until_all_orders_are_small():
    """To kr of 1.2 times the largest order sent and 4 more, kR + 4 (kR)^(1/3) + 1, from the width of the last ring"""
    k, R, edges = np.array([0.02, 0.3]), 40.0, [50.0, 56.0, 60.0]
    waves = [SimpleNamespace(k=one, local=np.zeros(2)) for one in k]
    made, ends = _intervals(
        SimpleNamespace(waves=waves, rings=SimpleNamespace(edges=edges), circle=SimpleNamespace(radius=R))
    )
    needed = (1.2 * np.floor(k * R + 4 * np.cbrt(k * R) + 1) + 4) / k
    widths = np.diff(made)
    assert made[:3].tolist() == edges and made[-2] < needed.max() <= made[-1]
    assert widths[2:] == pytest.approx(4.0 * 1.6 ** np.arange(1, len(widths) - 1))
    assert [made[end - 1] < need <= made[end] for end, need in zip(ends, needed, strict=True)] == [True, True]


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM])
def test_a_pair_has_the_radii_of_its_first_wave_whatever_those_of_others(kind):
    """With a beginning and an end of its own for each of three frequencies as with those of the first for all"""
    edges, third = np.array([50.0, 70.0, 90.0, 250.0]), [float(wavenumber(w, DEPTH, G)) for w in (0.2, 1.8)]
    begin, end = [2, 1, 0], [3, 2, 3]
    mixed = Tails(WAVES, edges, begin, end, third, 8.0, G, kind)
    assert mixed.ends == [(2, 3), (1, 2), (0, 3)]
    for one, two in ((2, 1), (1, 0), (2, 0), (1, 1)):
        psi = [made_up(kind.of(OMEGA[one], OMEGA[two]) or 0.2, 0.0)] * 6
        pair = PairsOfOne(psi[0].omega, np.array([one]), np.array([two]), None, psi, None)
        found = []
        for tails in (mixed, Tails(WAVES, edges, [begin[one]] * 3, [end[one]] * 3, third, 8.0, G, kind)):
            out = np.zeros((1, 6), complex)
            tails.add(pair, out)
            found.append(out[0, 0])
        assert abs(found[0] - found[1]) < 1e-5 * abs(found[1])


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM])
def test_pairs_of_several_frequencies_are_added_as_each_by_itself(kind):
    """In any order, one of them twice, to what is there"""
    edges, third = np.array([50.0, 70.0, 90.0, 250.0]), [float(wavenumber(w, DEPTH, G)) for w in (0.2, 1.8)]
    tails = Tails(WAVES, edges, [1, 0, 0], [3, 3, 3], third, 8.0, G, kind)
    one, two = np.array([2, 1, 2, 2, 1]), np.array([1, 0, 0, 1, 1])
    psi = [made_up(kind.of(0.9, 0.7), 0.0)] * 6
    out = np.full((5, 6), 2.0 + 1j)
    tails.add(PairsOfOne(psi[0].omega, one, two, None, psi, None), out)
    for row, i, j in zip(out, one, two, strict=True):
        alone = np.zeros((1, 6), complex)
        tails.add(PairsOfOne(psi[0].omega, np.array([i]), np.array([j]), None, psi, None), alone)
        assert np.abs(alone).min() > 0 and row - (2.0 + 1j) == pytest.approx(alone[0], rel=1e-9)
