"""Kernels of the tension on the bed one by one, as plain Python: slopes, capstans, weights and what friction keeps."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

friction, data = plain("mooring.lines.multi_segment.friction"), plain("mooring.lines.multi_segment.line_data")
H, V, X, Z, S, T, PHI, LENGTH, END, LOW, HIGH = range(11)
UNKNOWNS = 3
PULLS, GIVES = (math.sin(0.2) + sign * 0.5 * math.cos(0.2) for sign in (1, -1))  # slope 0.2, μ = 0.5
HISTORY = np.array([[50.0, 80.0, 4e4, 7e4], [10.0, 50.0, 1e4, 4e4]])  # 1 kN a metre down to 10 m, above 80 m none


def line(**more):
    given = {"kept": HISTORY, "friction": 0.5, "length": 100.0, "held": 0, "bed": np.array([[0.0, 0.0, 0.0]]),
             "loads": np.zeros((0, 3)), "lowest_buoy": 0, "least": 1.0}  # fmt: skip
    return SimpleNamespace(**given | more)


def state(tension, s=60.0, angle=0.2):
    q, g = np.zeros(7), np.random.default_rng(7).normal(size=(11, UNKNOWNS))
    q[[X, Z, S, T, PHI]] = 30.0, -5.0, s, tension, angle
    return q, g


@pytest.mark.parametrize("s, tension, slope, until", [
    (90.0, math.inf, 0.0, 80.0), (80.0, 7e4, 1e3, 50.0), (60.0, 5e4, 1e3, 50.0), (50.0, 4e4, 750.0, 10.0),
    (30.0, 2.5e4, 750.0, 10.0), (10.0, math.inf, 0.0, -math.inf),
])  # fmt: skip
def test_what_a_line_keeps_is_straight_between_its_places(s, tension, slope, until):
    """Off the bed before, it slides towards the anchor; without a history towards the fairlead"""
    assert friction.kept_tension(line(), s) == pytest.approx((tension, slope, until))
    assert friction.kept_tension(line(kept=np.zeros((0, 4))), s) == (-math.inf, 0.0, -math.inf)


@pytest.mark.parametrize("tension, rate, length, kept", [
    (5e4, 1000.0, 10.0, math.nan), (5.2e4, 1000 * PULLS, 10.0, math.nan),
    (4.8e4, 1000 * GIVES, 2 / (1 - GIVES), 0.0),
])  # fmt: skip
def test_a_line_on_the_bed_slides_until_it_has_what_it_keeps(tension, rate, length, kept):
    """At s = 60 it keeps 50 kN and 1 kN a metre; w (sin β ± μ cos β) where it slides, up to where both meet"""
    q, _ = state(tension)
    found = friction.friction_rate(line(), q, 1000.0, 0.2)
    assert found[:2] == pytest.approx((rate, length))
    if kept == 0.0:
        assert found[2] == pytest.approx(5e4 - 1e3 * length) and tension - rate * length == pytest.approx(found[2])
    else:
        assert math.isnan(found[2])


def test_a_line_that_loses_more_than_it_keeps_meets_that_below():
    """Of 52 kN on a slope on which it loses 2 kN a metre, 1 kN faster than what it keeps: after 2 m"""
    q, _ = state(5.2e4)
    weight = 2000 / PULLS
    assert friction.friction_rate(line(), q, weight, 0.2) == pytest.approx((2000.0, 2.0, 4.8e4))
    q[S] = 90.0  # off the bed before
    rate, until, kept = friction.friction_rate(line(), q, weight, 0.2)
    assert (rate, until) == pytest.approx((weight * GIVES, 10.0)) and math.isnan(kept)


@pytest.mark.parametrize("low, high, tension, row", [
    (3e4, 6e4, 5e4, None), (5.5e4, 6e4, 5.5e4, LOW), (1e4, 4e4, 4e4, HIGH), (-3e4, -1e4, 0.0, None),
])  # fmt: skip
def test_a_tension_is_the_kept_one_within_its_limits_and_never_below_0(low, high, tension, row):
    """Its derivatives are those of what it is: the kept slope along the line, a limit, or none at 0"""
    q, g = state(9e9)
    before = g.copy()
    friction.kept_within(line(), q, g, low, high)
    assert q[T] == pytest.approx(tension, rel=1e-6)
    wanted = before[row] if row else (1e3 * before[S] if tension else np.zeros(UNKNOWNS))
    assert g[T] == pytest.approx(wanted)


def test_a_line_bends_round_a_vertex_as_round_a_capstan():
    """From φ = 0.2 to 0.5 the tension below is T e^∓μΔβ: 0.86 and 1.16 T; kept in between where that lies there"""
    ratio = math.exp(-0.5 * 0.3)
    for tension, wanted, row in ((5.0e4, 5e4, S), (7e4, 7e4 * ratio, LOW), (3e4, 3e4 / ratio, HIGH)):
        q, g = state(tension)
        before = g.copy()
        friction.bend_at_vertex(line(), q, g, 0.5, 1)
        assert q[T] == pytest.approx(wanted, rel=1e-6) and q[PHI] == 0.5
        assert g[PHI].tolist() == [0.0, 1.0, 0.0]
        by_angle = np.array([0.0, 1.0, 0.0])
        if row == S:
            assert g[T] == pytest.approx(1e3 * before[S])
        else:
            sign = 1 if row == LOW else -1
            factor = ratio**sign
            assert g[T] == pytest.approx(factor * (before[T] + sign * 0.5 * tension * (before[PHI] - by_angle)))
    q, g = state(5e4)
    before = g.copy()
    friction.bend_at_vertex(line(friction=0.0), q, g, 0.5, -1)
    assert q[T] == 5e4 and g[T] == pytest.approx(before[T]) and not g[PHI].any()


def test_a_weight_on_the_bed_pulls_by_its_slope_and_its_friction():
    """Of 10 kN on a slope of 0.2: T − W (sin β ± μ cos β), the kept tension between both"""
    for tension, sign in ((7e4, 1), (3e4, -1)):
        q, g = state(tension)
        before = g.copy()
        friction.pass_weight_on_bed(line(), q, g, 0.2, 1e4)
        factor = math.sin(0.2) + sign * 0.5 * math.cos(0.2)
        assert q[T] == pytest.approx(tension - 1e4 * factor)
        assert g[T] == pytest.approx(before[T] - factor * before[LENGTH])
    q, g = state(5e4 + 1e4 * math.sin(0.2))
    friction.pass_weight_on_bed(line(), q, g, 0.2, 1e4)
    assert q[T] == pytest.approx(5e4, rel=1e-6)


def test_a_piece_on_the_bed_is_longer_by_its_mean_tension():
    """2 m at 50 kN that fall by 1 kN/m: 2 (λ + f · 49 kN) along the slope; derivatives by differences"""
    factor, flexibility, rate, angle = 1.01, 1e-7, 1e3, 0.2
    q, g = state(5e4)
    before = q.copy(), g.copy()
    friction.bed_step(q, g, 2.0, rate, factor, flexibility, angle)
    moved = 2 * (factor + flexibility * 4.9e4)
    assert q[[X, Z, T, S]] == pytest.approx(
        [30.0 - moved * math.cos(0.2), -5.0 - moved * math.sin(0.2), 4.8e4, 58.0]
    )  # fmt: skip
    for i in range(UNKNOWNS):
        ends = []
        for step in (1e-4, -1e-4):
            other = before[0] + step * np.array([before[1][row, i] for row in range(7)])
            friction.bed_step(
                other, before[1].copy(), 2.0 + step * before[1][LENGTH, i], rate, factor, flexibility, angle
            )
            ends.append(other)
        slope = (ends[0] - ends[1]) / 2e-4
        assert g[[X, Z, T, S], i] == pytest.approx(slope[[X, Z, T, S]], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("tension, held", [(5e4, 5e4), (0.3, 1.0)])
def test_a_line_leaves_the_bed_along_it_with_its_tension_and_comes_back_so(tension, held):
    q, g = state(tension)
    before = g.copy()
    friction.leave_bed(line(), q, g)
    assert (q[H], q[V], q[T]) == pytest.approx((held * math.cos(0.2), held * math.sin(0.2), held))
    by_tension = before[T] * (tension == held)
    assert g[H] == pytest.approx(math.cos(0.2) * by_tension - q[V] * before[PHI])
    assert g[V] == pytest.approx(math.sin(0.2) * by_tension + q[H] * before[PHI])
    q[[T, PHI]] = 0.0
    friction.place_on_vertex(line(bed=np.array([[1.0, 2.0, 0.1], [3.0, 4.0, 0.2]])), q, g, 1)
    assert (q[X], q[Z], q[T], q[PHI]) == pytest.approx((3.0, 4.0, held, 0.2))
    assert not g[X].any() and not g[Z].any()
    assert g[T] == pytest.approx(by_tension) and g[PHI] == pytest.approx(before[PHI])


@pytest.mark.parametrize("facet, slope, more, slides", [
    (1, 0.6, {}, True), (1, 0.4, {}, False), (0, 0.6, {}, True), (1, 0.6, {"kept": HISTORY}, False),
    (0, 0.6, {"buoy": True}, False), (1, 0.6, {"buoy": True}, True), (1, 0.6, {"buoy": True, "held": 1}, False),
    (1, 0.6, {"held": 1}, True),
])  # fmt: skip
def test_a_line_without_tension_slides_down_what_is_steeper_than_its_friction(facet, slope, more, slides):
    """tan β > μ = 0.5; not with a history, not on the first facet below a buoy, not what is held above one"""
    loads, at = np.array([[40.0, -1e4, -1e4]]), [0, 0 if more.pop("buoy", False) else -1]
    bed = np.array([[0.0, 0.0, math.atan(slope)]] * 2)
    one = line(**{"kept": np.zeros((0, 4)), "bed": bed, "loads": loads} | more)
    assert friction.slides_down(one, at, facet, 0.0) == slides


@pytest.mark.parametrize("facet, tension, held, slides", [
    (0, 100.0, 2, False), (0, 101.0, 2, True), (1, 100.0, 2, True), (0, 100.0, 1, True),
])  # fmt: skip
def test_what_a_slack_line_leaves_at_its_anchor_lies_in_a_heap(facet, tension, held, slides):
    """Up to a hundred times the least tension, on the first facet, further down the line than its lowest buoy"""
    bed = np.array([[0.0, 0.0, math.atan(0.6)]] * 2)
    one = line(kept=np.zeros((0, 4)), bed=bed, loads=np.array([[40.0, -1e4, -1e4]]), held=held)
    assert friction.slides_down(one, [0, -1], facet, tension) == slides
    one.lowest_buoy = 1  # no buoy
    assert friction.slides_down(one, [0, -1], facet, tension)
