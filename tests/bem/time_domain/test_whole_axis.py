"""Damping beyond the band, by the powers that are believed, and the added mass of known pairs."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.time_domain import whole_axis as module
from hakobune.bem.time_domain.whole_axis import (
    WholeAxis,
    _above,
    _below,
    _unseen,
    ends_of,
    kramers_kronig,
    monopole_damping,
    whole_axis,
    without_negative,
)

OMEGA = np.linspace(0.2, 2.0, 400)


def damped(*powers):
    """(n, 6, 6) of ω to these powers on the diagonal, and their geometric means between the first two"""
    B = np.zeros((len(OMEGA), 6, 6))
    for i, p in enumerate(powers):
        B[:, i, i] = (i + 1.0) * OMEGA**p
    B[:, 0, 1] = B[:, 1, 0] = 0.5 * np.sqrt(B[:, 0, 0] * B[:, 1, 1])
    return B


def test_below_the_band_damping_follows_its_own_power_between_one_and_twelve():
    """Slopes at ω₁; couplings with the mean of both"""
    axis, found = _below(OMEGA, damped(4.0, 6.0, 0.5, 14.0, 2.0), None)
    first, x = OMEGA[0], axis / OMEGA[0]
    assert axis[0] == 0.0 and len(axis) == 60 and axis[1] == pytest.approx(1e-3 * first)
    slopes = [first * (b[1] - b[0]) / (OMEGA[1] - OMEGA[0]) / b[0] for b in damped(4.0, 6.0).diagonal(0, 1, 2).T[:2]]
    for i, power in ((0, slopes[0]), (1, slopes[1]), (2, 1.0), (3, 12.0)):
        np.testing.assert_allclose(found[:, i, i], damped(4.0, 6.0, 0.5, 14.0, 2.0)[0, i, i] * x**power, rtol=1e-9)
    np.testing.assert_allclose(found[:, 0, 1], 0.5 * np.sqrt(2) * first**5 * x ** (0.5 * sum(slopes)), rtol=1e-9)


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_a_body_that_changes_its_volume_sends_the_waves_of_a_source(depth):
    """ρ ω q qᵀ / 4h, in deep water ρ ω³ q qᵀ / 2g; what is left has a power of its own, a dipole's 3 at least"""
    q = np.array([0, 0, 200.0, 10.0, -300.0, 0])
    source = monopole_damping(q, 1025.0, depth, 9.80665)
    w = np.array([0.1, 0.3])
    share = w / 80 if np.isfinite(depth) else w**3 / (2 * 9.80665)
    np.testing.assert_allclose(source(w), 1025.0 * share[:, None, None] * np.outer(q, q))
    rest = 1e5 * np.diag([1.0, 0.8, 0.6, 0.5, 0.3, 0.2])
    damping = source(OMEGA) + (OMEGA / OMEGA[0])[:, None, None] ** 2 * rest
    axis, found = _below(OMEGA, damping, source)
    x = (axis / OMEGA[0])[:, None]
    left = (found - source(axis)).diagonal(0, 1, 2)
    strong = np.diag(source(OMEGA[:1])[0]) > 0.1 * np.diag(damping[0])
    slope = (OMEGA[1] / OMEGA[0]) ** 2 - 1
    power = np.where(strong, max(1.0, slope * OMEGA[0] / (OMEGA[1] - OMEGA[0])), 3.0)
    assert strong.tolist()[2] and not strong[[0, 1, 5]].any()
    np.testing.assert_allclose(left, np.diag(rest) * x**power, rtol=1e-6, atol=1e-6)


def test_above_the_band_damping_falls_with_the_slope_of_its_last_seventh_from_three_to_twelve():
    """Of frequencies from ω₁ + 0.85 (Ω − ω₁) on; up to 300 Ω"""
    early = np.where(OMEGA < 0.2 + 0.85 * 1.8, OMEGA, 0.2 + 0.85 * 1.8) ** 8.0  # rises, then stays
    B = damped(-4.0, -8.0, -2.0, -14.0)
    B[:, 4, 4] = early * np.where(OMEGA < 0.2 + 0.85 * 1.8, 1.0, (OMEGA / (0.2 + 0.85 * 1.8)) ** -5.0)
    axis, found = _above(OMEGA, B)
    x = 2.0 / axis
    assert axis[-1] == pytest.approx(600.0) and axis[0] > 2.0 and len(axis) == 599
    for i, power in ((0, 4.0), (1, 8.0), (2, 3.0), (3, 12.0), (4, 5.0)):
        np.testing.assert_allclose(found[:, i, i], B[-1, i, i] * x**power, rtol=0.02, atol=1e-12 * B[-1, i, i])
    np.testing.assert_allclose(found[:, 0, 1], B[-1, 0, 1] * x**6.0, rtol=1e-6, atol=1e-20)


def test_what_gives_energy_is_taken_out_and_the_rest_is_as_it_was():
    """Of [[1, 2], [2, 1]] the eigenvalue −1 along (1, −1), in units of the largest damping of each motion"""
    unit = np.diag([1.0, 3.0, 1, 1, 1, 1])
    known = unit @ np.diag([1.0, 1.0, 1, 1, 1, 0]) @ unit
    known[0, 1] = known[1, 0] = 0.1
    wrong = known.copy()
    wrong[0, 1] = wrong[1, 0] = 2 * 3.0
    at_rest = np.stack([0 * known, known])  # nothing is damped at ω = 0
    found = without_negative(np.stack([known, wrong]), at_rest)
    np.testing.assert_array_equal(found[0], known)
    np.testing.assert_allclose(found[1][:2, :2], np.diag([1, 3.0]) @ np.full((2, 2), 1.5) @ np.diag([1, 3.0]))
    assert found[1, 2, 2] == pytest.approx(1.0) and found[1, 5, 5] == 0.0


def test_added_mass_of_damping_that_goes_on_beyond_the_band_is_found_with_its_limit():
    """K = exp(−at) cos bt: B = Re, A = A∞ − Im/ω of ½ Σ 1/(a − i(ω ± b)); a hump within the band and its tail"""
    a, b, infinity = 0.3, 0.9, 7.0

    def transform(w):
        return 0.5 * (1 / (a - 1j * (w - b)) + 1 / (a - 1j * (w + b))) - 1 / (a - 1j * w) * a**2 / (a**2 + b**2)

    exact = transform(OMEGA)
    shape = np.diag([1.0, 2.0, 0, 0, 0, 0])
    A, B = np.multiply.outer(infinity - exact.imag / OMEGA, shape), np.multiply.outer(exact.real, shape)
    free, held = whole_axis(OMEGA, A, B), whole_axis(OMEGA, A, B, infinity * shape)
    size = np.abs(exact).max()
    assert np.abs(free.added_mass_infinity - infinity * shape)[:2, :2].max() < 0.1 * size
    assert held.added_mass_infinity[1, 1] == 2 * infinity
    at = np.array([0.501, 0.903, 1.502])
    for one in (free, held):
        off = np.abs(one.transform(at)[:, 0, 0] - transform(at))
        assert off.max() < 0.05 * size
        np.testing.assert_allclose(one.transform(at)[:, 1, 1], 2 * one.transform(at)[:, 0, 0], rtol=1e-6)
        assert not one.damping[:, 2:].any()


@pytest.mark.parametrize("known", [True, False])
def test_damping_that_rises_and_falls_beyond_the_band_is_found_from_the_added_mass_of_the_band(known):
    """(Ω/ω)³ − (Ω/ω)⁵ of one motion, whose part of the added mass is (2/π) ∫ B/(x² − ω²) dx by a fine rule; none of a
    motion without damping; A(∞) too where it is not known"""
    omega = np.linspace(0.2, 2.0, 181)
    above = 2.0 * np.geomspace(1, 30, 600)[1:]
    axis_omega = np.concatenate([[1e-4], omega, above])
    damping = np.zeros((len(axis_omega), 6, 6))
    damping[1:, 2, 2] = 1e-9  # none at rest
    x = 2.0 / above
    hidden = 5e4 * (x**3 - x**5)
    infinite = np.zeros((6, 6))
    infinite[2, 2] = 3e5
    fine = np.geomspace(2.0, 60.0, 200_001)
    of_fine = 5e4 * ((2 / fine) ** 3 - (2 / fine) ** 5)
    added = np.zeros((len(omega), 6, 6))
    for q, w in enumerate(omega[:-1]):
        added[q, 2, 2] = 3e5 + 2 / np.pi * np.trapezoid(of_fine / (fine**2 - w**2), fine)
    added[-1] = added[-2]
    excess = lambda at: np.zeros((len(at), 6, 6))  # noqa: E731
    axis = SimpleNamespace(omega=axis_omega, damping=damping, excess=excess,
                           added_mass_infinity=infinite if known else None)  # fmt: skip
    more, last = _unseen(omega, added, axis, above)
    assert more.shape == (len(above), 6, 6) and last[2, 2] == pytest.approx(3e5, rel=5e-3)
    assert abs(more[0, 2, 2]) < 0.15 * hidden.max() and abs(more[-1, 2, 2]) < 0.01 * hidden.max()
    assert more[:, 2, 2].max() == pytest.approx(hidden.max(), rel=0.3)
    more[:, 2, 2] = 0.0
    assert not more.any()


def test_damping_that_is_found_beyond_the_band_is_added_there_and_gives_no_energy(monkeypatch):
    B, A = damped(4.0, 5.0), np.ones((len(OMEGA), 6, 6))
    more = np.zeros((599, 6, 6))
    more[:, 0, 0], more[5, 0, 0], more[:, 2, 2] = 7.0, -1e9, 3.0
    monkeypatch.setattr(module, "_unseen", lambda omega, added, axis, above: (more, "limit"))
    axis = whole_axis(OMEGA, A, B, np.zeros((6, 6)))
    below, above = _below(OMEGA, B, None), _above(OMEGA, B)
    np.testing.assert_array_equal(axis.omega, np.concatenate([below[0], OMEGA, above[0]]))
    np.testing.assert_array_equal(axis.damping[: len(below[0]) + len(OMEGA)], np.concatenate([below[1], B]))
    high = axis.damping[len(below[0]) + len(OMEGA) :]
    np.testing.assert_allclose(np.delete(high, 5, 0), np.delete(above[1] + more, 5, 0))
    assert abs(high[5, 0, 0]) < 1e-12 and np.linalg.eigvalsh(high[5]).min() > -1e-9
    assert axis.added_mass_infinity == "limit"


def test_a_source_that_makes_more_waves_than_were_found_leaves_the_rest_its_own_power():
    """Rest −ω² of a fifth of the source: its slope gives the power 2, as of one above 0"""
    source = monopole_damping(np.array([0, 0, 200.0, 0, 0, 0]), 1025.0, 20.0, 9.80665)
    rest = -0.2 * source(OMEGA[:1])[0, 2, 2]
    damping = source(OMEGA)
    damping[:, 2, 2] += rest * (OMEGA / OMEGA[0]) ** 2
    axis, found = _below(OMEGA, damping, source)
    power = OMEGA[0] * ((OMEGA[1] / OMEGA[0]) ** 2 - 1) / (OMEGA[1] - OMEGA[0])
    np.testing.assert_allclose(
        found[:, 2, 2], source(axis)[:, 2, 2] + rest * (axis / OMEGA[0]) ** power, rtol=1e-9, atol=1e-9
    )


def test_weights_of_causality_are_principal_values_of_straight_lines():
    """⨍ B/(x² − ω²) dx by ∫ (B(x) − B(ω))/(x² − ω²) dx and B(ω) ln |(b − ω)(a + ω)/((b + ω)(a − ω))| / 2ω"""
    points, B = np.array([0.5, 1.0, 2.0, 4.0]), np.array([0.3, 1.0, -0.4, 0.7])
    s, v = np.polynomial.legendre.leggauss(60)
    for w in (0.2, 0.7, 1.6, 3.1, 5.0):
        weights = kramers_kronig(w, points)[0]
        level = np.interp(w, points, B) if 0.5 < w < 4 else 0.0
        total = level * np.log(abs((4 - w) * (0.5 + w) / ((4 + w) * (0.5 - w)))) / (2 * w)
        cuts = np.unique([*points, *([w] if 0.5 < w < 4 else [])])
        for a, b in pairwise(cuts):
            x = 0.5 * (a + b) + 0.5 * (b - a) * s
            total += 0.5 * (b - a) * v @ ((np.interp(x, points, B) - level) / (x**2 - w**2))
        assert weights @ B == pytest.approx(total, rel=1e-9)


def test_between_its_frequencies_damping_is_straight_and_added_mass_follows_from_all_of_it():
    """B − iω (2/π) ⨍ B/(x² − ω²) dx; frequencies in the middle of the gaps that are asked for, each once"""
    omega, B = np.array([0.0, 1.0, 2.0, 4.0]), np.zeros((4, 2, 2))
    B[:, 0, 0], B[:, 0, 1] = [0.0, 3.0, 1.0, 0.0], [0.0, 1.0, 2.0, 0.0]
    axis = WholeAxis(omega, B, np.diag([5.0, 6.0]))
    at = np.array([0.25, 3.0])
    found = axis.transform(at)
    assert found.real[:, 0, 0] == pytest.approx([0.75, 0.5]) and found.real[:, 0, 1] == pytest.approx([0.25, 1.0])
    excess = 2 / np.pi * kramers_kronig(at, omega) @ B[:, 0, 0]
    assert found.imag[:, 0, 0] == pytest.approx(-at * excess) and axis.excess(at)[:, 0, 0] == pytest.approx(excess)
    assert axis.between([0.1, 0.9, 1.5, 3.9, 9.0]).tolist() == [0.5, 1.5, 3.0]
    assert axis._gap(np.array([0.25, 3.0]))[1] == pytest.approx([0.25, 0.5])


def test_what_a_body_displaces_is_its_waterplane_with_moments_of_each_body_and_of_shapes():
    """q = (C₃₃, C₃₄, C₃₅)/ρg of each body, of a shape what it does to heave of all; 0 of motions not asked for"""
    C = np.zeros((13, 13))
    for first, row in ((0, [3.0, 0.5, -1.0]), (6, [7.0, -0.2, 2.0])):
        C[first + 2, first + 2 : first + 5] = row
    C[2, 12], C[8, 12] = 4.0, 5.0
    limit = np.arange(169.0).reshape(13, 13)
    body = SimpleNamespace(words=range(13), rigid=12, stiffness=1e4 * C, density=1000.0, gravity=10.0, depth=20.0,
                           between=SimpleNamespace(limits={"added_mass_infinity": limit}))  # fmt: skip
    q = np.array([0, 0, 3.0, 0.5, -1, 0, 0, 0, 7.0, -0.2, 2.0, 0, 9.0])
    found, waves = ends_of(body)
    assert np.array_equal(found, limit)
    assert waves(np.array([0.5]))[0] == pytest.approx(1000 * 0.5 / 80 * np.outer(q, q))
    some, waves = ends_of(body, [2, 4, 12])
    kept = np.isin(np.arange(13), [2, 4, 12])
    assert np.array_equal(some, np.where(np.outer(kept, kept), limit, 0))
    assert waves(np.array([0.5]))[0] == pytest.approx(1000 * 0.5 / 80 * np.outer(q * kept, q * kept))
    limit[3, 3] = np.inf
    assert ends_of(body)[0] is None and ends_of(body, [2, 4])[0] is not None
    body.stiffness, body.between.limits = None, {}
    assert ends_of(body) == (None, None)
