"""Answers of one shape to partial waves: a pile by closed forms, and pieces of the equations of a box."""

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, iv, ivp, jv, jvp, kv, kvp

from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.depth_modes.gap import OuterModes
from hakobune.bem.transfer.contour_shape import _at_least, _OneShape, answers
from hakobune.bem.transfer.partial_waves import PartialWaves

A, DEPTH, OMEGA, LAST = 2.0, 6.0, 1.3, 3
PILE, BOX = prepare_cylinder(A, DEPTH, DEPTH, 1e-4), prepare_box(5.0, 3.0, 2.0, DEPTH, 1e-2)


def modes_of(body, omega=OMEGA):
    return body.profiles.gap.outer_modes(omega, body.mode_count(omega**2 / 9.81), 9.81)


def waves_of(modes, decaying=2, first=True):
    more = [PartialWaves("decaying", float(k), LAST - 1) for k in modes.wavenumbers[:decaying]]
    return [PartialWaves("radiating", modes.k, LAST), *more] if first else more


def closed(one, m):
    """b of a = 1 before a wall, and dS/dr at it: R' + b S' = 0"""
    x = one.k * A
    if one.kind == "radiating":
        size = abs(hankel1(m, x))
        return -jvp(m, x) * size**2 / h1vp(m, x), one.k * h1vp(m, x) / size
    return -ivp(m, x) / iv(m, x) ** 2 / kvp(m, x), one.k * kvp(m, x) * iv(m, x)


def surface_value(one, m, b):
    """R + b S at the wall, of cos or sin of order m"""
    x = one.k * A
    if one.kind == "radiating":
        size = abs(hankel1(m, x))
        return jv(m, x) * size + b * hankel1(m, x) / size
    return 1.0 + b * kv(m, x) * iv(m, x)


def test_a_pile_scatters_each_wave_into_itself_and_is_pushed_by_order_one():
    modes = modes_of(PILE)
    waves = waves_of(modes)
    found, z = answers(PILE, modes, waves), np.linspace(-DEPTH, 0.0, 2001)
    counts = [2 * one.last + 1 for one in waves]
    T, E, sent = np.zeros((sum(counts),) * 2, complex), np.zeros((6, sum(counts)), complex), np.zeros((sum(counts), 6))
    sent, start = sent.astype(complex), 0
    for n, one in enumerate(waves):
        depth = np.cosh(one.k * (z + DEPTH)) / np.cosh(one.k * DEPTH) if n == 0 else np.cos(one.k * (z + DEPTH))
        zero, first, norm = (np.trapezoid(f, z) for f in (depth, z * depth, depth**2))
        orders = [*range(one.last + 1), *range(1, one.last + 1)]
        for i, m in enumerate(orders):
            b, slope = closed(one, m)
            T[start + i, start + i] = b
            if m == 1:
                push = np.pi * A * surface_value(one, 1, b)  # ∮ cos² ds
                x_first = i == 1
                E[0 if x_first else 1, start + i] = zero * push
                E[4 if x_first else 3, start + i] = first * push * (1 if x_first else -1)
                sent[start + i, 0 if x_first else 1] = zero / norm / slope
                sent[start + i, 4 if x_first else 3] = first / norm / slope * (1 if x_first else -1)
        start += 2 * one.last + 1
    assert found.scattered == pytest.approx(T, abs=2e-4 * np.abs(T).max())
    assert found.pressed == pytest.approx(E, abs=2e-4 * np.abs(E).max())
    assert found.sent == pytest.approx(sent, abs=2e-4 * np.abs(sent).max())
    assert found.residual < 1e-9 and found.radiation.shape == (6, 6)
    assert found.radiation == pytest.approx(found.radiation.T, abs=1e-6 * np.abs(found.radiation).max())
    assert sorted(np.concatenate(found.members)) == list(range(sum(counts)))


def test_without_the_propagating_mode_the_decaying_ones_are_answered_as_with_it():
    modes = modes_of(PILE)
    with_it, alone = (answers(PILE, modes, waves_of(modes, 2, first)) for first in (True, False))
    own = slice(2 * LAST + 1, None)
    assert alone.scattered == pytest.approx(with_it.scattered[own, own])
    assert alone.pressed == pytest.approx(with_it.pressed[:, own]) and alone.sent == pytest.approx(with_it.sent[own])


def test_in_the_limit_of_long_waves_what_has_order_m_comes_back_as_it_came():
    """(r/a)ᵐ cos mθ before a wall sends (a/r)ᵐ, and of order 0 nothing"""
    gap, k = PILE.profiles.gap, np.arange(1, 30) * np.pi / DEPTH
    first = np.array([DEPTH, -(DEPTH**2) / 2])
    modes = OuterModes(0.0, DEPTH, first, k, np.full(len(k), DEPTH / 2), gap.outer_rows(k))
    found = answers(PILE, modes, [PartialWaves("laplace", 0.0, LAST), PartialWaves("decaying", float(k[0]), 2)])
    n = 2 * LAST + 1
    assert found.scattered[:n, :n] == pytest.approx(np.diag([0.0, *np.ones(2 * LAST)]), abs=1e-3)
    # a pile that surges sends −u a (a/r) cos θ
    assert found.sent[1, 0] == pytest.approx(-A, rel=1e-3) and found.sent[LAST + 1, 1] == pytest.approx(-A, rel=1e-3)
    assert found.sent[1, 4] == pytest.approx(A * DEPTH / 2, rel=1e-3)


def test_partial_waves_on_a_contour_have_the_slope_of_their_normal():
    """R cos mθ or R sin mθ of the class, and differences across the contour"""
    modes = modes_of(BOX)
    waves = waves_of(modes)
    held, h = _OneShape(BOX, modes, waves), 1e-5
    for one in waves:
        seen = []
        for cls in CLASSES:
            m = held._orders(cls, one)
            assert all((-1) ** n == cls[0] * cls[1] for n in m) and (cls != (-1, -1) or 0 not in m)
            seen += held._members(cls, one).tolist()
            value, slope = held._partial(cls, one)

            def at(shift, cls=cls, m=m, one=one):
                c = held.contour
                x, y = c.x + shift * c.nx, c.y + shift * c.ny
                R = one.regular(BOX.plan.reach, np.hypot(x, y))[0][:, m]
                turn = np.multiply.outer(np.arctan2(y, x), m)
                return R * (np.cos(turn) if cls[1] == 1 else np.sin(turn))

            assert value == pytest.approx(at(0.0))
            assert slope == pytest.approx((at(h) - at(-h)) / (2 * h), abs=1e-6 * np.abs(value).max())
            # cos m and then sin m
            assert held._members(cls, one).tolist() == [n if cls[1] == 1 else one.last + n for n in m]
        assert sorted(seen) == list(range(2 * one.last + 1))


@pytest.mark.parametrize("first", [True, False])
def test_rows_norms_and_maps_are_those_of_the_modes_that_count(first):
    modes = modes_of(BOX)
    held = _OneShape(BOX, modes, waves_of(modes, 2, first))
    C, begin = BOX.profiles.combinations, int(first)
    assert held.decaying == 2 and len(held.rows) == len(held.norms) == 2 + begin
    if first:
        assert held.rows[0] == pytest.approx(C @ modes.wave_rows) and held.norms[0] == modes.wave_norm
    for n in range(2):
        assert held.rows[begin + n] == pytest.approx(C @ modes.rows[:, n]) and held.norms[begin + n] == modes.norms[n]
    for cls in CLASSES:
        maps = held._maps(cls)
        assert len(maps) == 2 + begin
        if first:
            found = BOX.plan.waves((cls,), held.degree, modes.k, held.contour, np.empty(0))[cls].weak
            assert maps[0] == pytest.approx(found)
        # a map at κ between the nodes: by the plan itself
        own = BOX.plan.subset(cls, held.degree, held.top)
        for n, k in enumerate(modes.wavenumbers[:2]):
            exact = BOX.plan.maps(held.top, np.array([k]))[cls][0][0][np.ix_(own, own)] / k
            assert maps[begin + n] == pytest.approx(exact, abs=2e-2 * np.abs(exact).max())


def test_degrees_are_for_the_highest_order_and_one_more():
    assert _at_least((3, 9), 5) == (5, 9) and _at_least(3, 5) == 5 and _at_least(7, 5) == 7
    modes = modes_of(BOX)
    held = _OneShape(BOX, modes, [PartialWaves("radiating", modes.k, 3), PartialWaves("decaying", 0.7, 50)])
    assert min(held.degree) == 51 and min(held.top) >= 51
    plain = _OneShape(BOX, modes, waves_of(modes))
    k, tolerance = modes.k, BOX.tolerance
    assert plain.degree == BOX.plan.degree(k, tolerance)
    assert plain.top == BOX.plan.degree(BOX.plan.table_wavenumber(k), tolerance)
    assert plain.a == BOX.plan.reach


def test_waves_outside_are_the_sum_over_all_modes():
    """κN of each mode over κ, weighted by the rows and 1/norm, in the class with six motions' parities"""
    modes = modes_of(BOX)
    held = _OneShape(BOX, modes, waves_of(modes))
    for cls in CLASSES:
        found, n = held._outside(cls), len(BOX.plan.subset(cls, held.degree, held.top))
        C = BOX.profiles.combinations
        r, table = len(C), BOX.outer_maps(cls, held.degree, held.top)
        total = np.multiply.outer(np.outer(C @ modes.wave_rows, C @ modes.wave_rows) / modes.wave_norm,
                                  held._first[cls]).transpose(0, 2, 1, 3)  # fmt: skip
        kappa, rows = modes.wavenumbers, C @ modes.rows
        N = np.tensordot(BOX.nodes(held.top).weights(kappa), table, 1) / kappa[:, None, None]
        total = total + np.einsum("pk,qk,kij->piqj", rows, rows / modes.norms, N)
        assert found.shape == (r * n, r * n)
        # modes beyond these add up to a thirtieth, and have no waves
        total = total.reshape(r * n, -1)
        assert found.imag == pytest.approx(total.imag, rel=1e-9, abs=1e-12)
        assert found.real == pytest.approx(total.real, abs=4e-2 * np.abs(total).max())
