"""Radii of the integrals of three waves beyond the rings: how many, how far, and which orders count."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import hankel1, hankel2, jv

from hakobune.bem.second_order import surface_tail
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.surface_far import orders_sent
from hakobune.bem.second_order.surface_tail import Path, Tails, _last, _orders

EDGES = np.array([50.0, 70.0, 110.0])
PATH = Path(EDGES, 0.4, 0.03, 0.05)


def test_real_radii_are_for_the_fastest_product_of_each_interval():
    """6 and 0.6 for a radian of three times the highest wavenumber over half the interval"""
    r, w = PATH.real
    counts = [int(6 + 0.6 * 3 * 0.4 * 20 / 2), int(6 + 0.6 * 3 * 0.4 * 40 / 2)]
    first = r < 70.0
    assert counts == [13, 20] and [first.sum(), (~first).sum()] == counts
    for own, low, high in ((first, 50.0, 70.0), (~first, 70.0, 110.0)):
        assert np.sum(w[own] * r[own] ** 9) == pytest.approx((high**10 - low**10) / 10)
    assert Path(EDGES[:1], 0.4, 0.03, 0.05).real.shape == (2, 0)


@pytest.mark.parametrize("name, least", [("down", 0.03), ("up", 0.05)])
def test_complex_radii_double_to_where_the_slowest_product_has_decayed(name, least):
    """From a quarter of 1/(k + 1/R) on, six points each, to e^(−30)"""
    x, w = getattr(PATH, name)
    ends = [0.25 / (0.4 + 1 / 110.0)]
    while ends[-1] < 30.0 / least:
        ends.append(2 * ends[-1])
    assert len(x) == 6 * len(ends) and np.sum(w) == pytest.approx(ends[-1]) and x.max() < ends[-1]
    assert np.sum((w * x**11)[:6]) == pytest.approx(ends[0] ** 12 / 12)
    assert np.sum((w * x**11)[6:12]) == pytest.approx((ends[1] ** 12 - ends[0] ** 12) / 12)
    assert Path(EDGES, 0.4, np.inf, 0.05).down.shape == (2, 0)


def test_columns_of_products_that_decay_faster_end_sooner():
    assert PATH.first == PATH.down.shape[1]
    for slope in (0.05, 0.5, 5.0):
        count = PATH.first + 3 + PATH.real.shape[1] + np.sum(PATH.up[0] < 30.0 / slope)
        assert PATH.reach(slope) == count
    assert PATH.reach(5.0) < PATH.reach(0.5) < PATH.reach(0.05)


def test_functions_are_at_three_kinds_of_radii_and_a_slope_is_at_the_first():
    """H and J of kr; along r ± ix without e^{±ikr}, J without e^{−ikr}; at the first radius twice value, once slope"""
    k, most, y, x = 0.2, 3, PATH.down[0], PATH.up[0]
    radii = PATH.real[0]
    for place in range(3):
        for kind, of, sign in ((1, hankel1, -1), (2, hankel2, 1)):
            found = PATH.hankel(kind, k, most, place)
            for m in range(most + 1):
                at = PATH.first
                z = k * (110.0 - 1j * y)
                assert found[m, :at] == pytest.approx(of(m, z) * np.exp(sign * 1j * z), rel=1e-9)
                three = np.repeat(of(m, k * 50.0), 3)
                three[place] = 0.5 * k * (of(m - 1, k * 50.0) - of(m + 1, k * 50.0))
                assert found[m, at : at + 3] == pytest.approx(three)
                assert found[m, at + 3 : at + 3 + len(radii)] == pytest.approx(of(m, k * radii))
        found = PATH.bessel(k, most, place)
        assert not found[:, : PATH.first].any()
        near = x < 15.0
        for m in range(most + 1):
            assert found[m, PATH.first + 3 : PATH.first + 3 + len(radii)] == pytest.approx(jv(m, k * radii), abs=1e-12)
            far = found[m, PATH.first + 3 + len(radii) :][near]
            z = k * (110.0 + 1j * x[near])
            assert far == pytest.approx(jv(m, z) * np.exp(1j * z), rel=1e-9)


def test_weights_turn_the_path_and_carry_what_decays():
    """−i C v r e^{−i down r} down, C u r between, i C w r e^{i up r} up; the sides times the first radius"""
    C, sides, up, down = 1.5 - 0.2j, (1.0, 2j, -3.0), 0.3, 0.1
    found, first = PATH.weights(up, down, C, sides), PATH.first
    (y, v), (r, u), (x, w) = PATH.down, PATH.real, PATH.up
    below, above = 110.0 - 1j * y, 110.0 + 1j * x
    assert found[:first] == pytest.approx(-1j * C * v * below * np.exp(-1j * down * below))
    assert found[first : first + 3] == pytest.approx(50.0 * np.array(sides))
    assert found[first + 3 : first + 3 + len(r)] == pytest.approx(C * u * r)
    assert found[first + 3 + len(r) :] == pytest.approx(1j * C * w * above * np.exp(1j * up * above))


@pytest.mark.parametrize("kind", [DIFFERENCE, SUM])
def test_paths_are_for_the_last_of_the_waves_that_share_their_ends(kind):
    """A third of the fastest product; what decays does so by twice the longest wave, or at differences the force"""
    waves = [SimpleNamespace(omega=w, k=k, most=most, sent=np.ones(2 * most + 1))
             for w, k, most in ((0.5, 0.05, 4), (0.5, 0.05, 4), (0.8, 0.1, 5), (1.1, 0.2, 6))]  # fmt: skip
    third = (0.01, 0.7)
    made = Tails(waves, EDGES, [0, 0, 0, 1], [2, 2, 2, 2], third, 9.0, 9.81, kind)
    assert made.omega.tolist() == [0.5, 0.8, 1.1] and made.number.tolist() == [0, 0, 1, 2]
    assert made.k.tolist() == [0.05, 0.1, 0.2] and made.most.tolist() == [4, 5, 6]
    assert made.ends == [(0, 2), (0, 2), (1, 2)] and set(made.paths) == {(0, 2), (1, 2)}
    assert made.of_third == orders_sent(0.7 * 9.0)
    for ends, k in (((0, 2), 0.1), ((1, 2), 0.2)):
        path = made.paths[ends]
        assert path.edges.tolist() == EDGES[ends[0] :].tolist()
        assert path.highest == pytest.approx(k if kind is DIFFERENCE else (2 * k + 0.7) / 3)
        down, up = (0.1, 0.02) if kind is DIFFERENCE else (np.inf, 0.1)
        assert (path.least_down, path.least_up) == pytest.approx((down, up))


def test_orders_are_kept_that_are_not_rounding_of_the_largest_of_their_wave():
    """|c_m H_m(z)| of each of two waves; a hundred-thousand-millionth"""
    z = 2.0
    size = np.abs(hankel1(np.arange(-4, 5), z))
    sent = np.zeros((2, 9))
    sent[0, 4], sent[0, 5] = 1.0 / size[4], 2e-11 / size[5]
    sent[1, 4], sent[1, 2], sent[1, 8] = 1e6 / size[4], 2e-5 / size[2], 0.5e-5 / size[8]
    assert _last(sent, z) == 2 and _last(sent[:1], z) == 1 and _last(np.zeros((1, 9)), z) == 0
    assert surface_tail.NEGLIGIBLE == 1e-11
    values = np.arange(7.0)
    assert _orders(values, 1).tolist() == [2, 3, 4] and _orders(values, 3).tolist() == values.tolist()
    assert _orders(values, 5).tolist() == [0, 0, *values, 0, 0]
