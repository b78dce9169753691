"""How fine a rectangle or circle is resolved: nodes, degrees, lengths of panels, points inside; by their laws."""

import math
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.contour.accuracy import Accuracy
from hakobune.bem.contour.plan import rectangle
from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.plan.rectangle import Rectangle

PLAN = Rectangle(40.0, 10.0, 6, 5, 3)


@pytest.mark.parametrize("digits, nodes, count, extra", [(3, 6, 5, 3), (5, 9, 8, 6), (1, 3, 2, 1), (7.4, 13, 12, 9)])
def test_digits_give_nodes_and_polynomials(digits, nodes, count, extra):
    """1.6 d + 1, 1.6 d + ½ and 1.4 d − 1, rounded, of the last one at least"""
    assert Rectangle.to_digits(40, 10, digits) == Rectangle(40.0, 10.0, nodes, count, extra)
    assert (nodes, count) == (round(1.6 * digits + 1), round(1.6 * digits + 0.5))
    fine = Accuracy(4.0, 3, 1e-6, 30.0, 2.0, digits, 7, 1)
    assert PLAN.to(fine) == Rectangle(40.0, 10.0, nodes, count, 7, 1)
    assert Circle(3.0, 5).to(fine) == Circle(3.0, 5)


def test_lengths_of_a_rectangle_and_of_a_circle():
    assert PLAN.sizes == (40.0, 10.0) and PLAN.scale == 5.0 and PLAN.reach == pytest.approx(np.hypot(20, 5))
    assert PLAN.alphas == pytest.approx((100 / 1700,) * 3)
    assert replace(PLAN, length=10.0, beam=40.0).alphas == pytest.approx((1600 / 1700,) * 3)
    circle = Circle(3.0)
    assert (circle.sizes, circle.scale, circle.reach) == ((3.0,), 3.0, 3.0)
    assert PLAN.table_wavenumber(0.1) == pytest.approx(8 / 20) and circle.table_wavenumber(0.1) == pytest.approx(8 / 3)


@pytest.mark.parametrize("waves, tolerance", [(0.0, 1.0), (0.3, 1e-3), (1.5, 1e-3), (1.5, 1e-6)])
def test_degrees_are_for_the_corners_and_for_the_waves_along_each_side(waves, tolerance):
    """x and 2e √(side/shorter) or (1 + d/2) ∛x more, x half the side in radians, in steps of four; and `further`"""
    for further in (0, 1):
        plan, wanted = replace(PLAN, further=further), []
        for side in (10.0, 40.0):
            x, reach = waves * side / 2, math.sqrt(side / 10.0)
            more = max(2 * 3 * reach, (1 - math.log10(tolerance) / 2) * x ** (1 / 3))
            wanted.append(4 * math.ceil((x + more) / 4) + 2 * further * math.ceil(reach))
        assert plan.degree(waves, tolerance) == tuple(wanted)
    low = PLAN.degree(0.0, 1.0)
    assert PLAN.finest((low[0] + 3, low[1])) == pytest.approx(2 * 3 / 10.0)
    assert PLAN.finest((low[0], low[1] + 8)) == pytest.approx(2 * 8 / 40.0)


def test_polynomials_of_a_class_are_even_or_odd_along_each_side():
    """y along the end, x along the side"""
    for cls, end, side in (((1, 1), [0, 2, 4], [0, 2]), ((-1, 1), [0, 2, 4], [1, 3]), ((1, -1), [1, 3], [0, 2]),
                           ((-1, -1), [1, 3], [1, 3])):  # fmt: skip
        assert [part.tolist() for part in PLAN.orders(cls, (4, 3))] == [end, side]
        own = PLAN.subset(cls, (2, 1), (4, 3))
        counts = [len(part) for part in PLAN.orders(cls, (2, 1))]
        assert own.tolist() == [*range(counts[0]), *(len(end) + n for n in range(counts[1]))]


def test_many_polynomials_take_more_nodes_a_panel():
    """Five at least, and one more for each 64"""
    for degree, least in (((8, 64), 6), ((8, 65), 7), ((300, 8), 10)):
        fine = PLAN.for_degree(degree)
        assert (fine.nodes, fine.count) == (max(6, least), max(5, least))
    assert replace(PLAN, nodes=20, count=19).for_degree((300, 8)) == replace(PLAN, nodes=20, count=19)


@pytest.mark.parametrize("k", [0.0, 0.4, 5.0])
@pytest.mark.parametrize("degree", [(8, 12), (4, 90)])
def test_panels_have_a_phase_of_seven_tenths_of_a_radian_a_node(k, degree, monkeypatch):
    """At the corner of the scale, of the wave and of polynomials like √r there; away from it of wave and polynomials"""
    asked = []
    monkeypatch.setattr(rectangle, "quarter_panels", lambda *them: asked.append(them) or "panels")
    assert PLAN.panels(k, degree) == "panels"
    ((a, b, corner, longest, nodes),) = asked
    assert (a, b, nodes) == (20.0, 5.0, 6)
    for found, length, d, extent in zip(corner, longest, degree, (5.0, 20.0), strict=True):
        wave = 4.2 / k if k else np.inf
        assert found == pytest.approx(min(5.0, wave, extent * (4.2 / d) ** 2 / 2))
        assert length == pytest.approx(min(wave, 4.2 * extent / d))


def test_waves_of_a_fifth_share_their_panels_and_points_inside():
    """From as many radians around half the contour as a panel has nodes; 8 points and k times the diagonal over 4"""
    fine, k, degree = PLAN._wave_arguments(0.01, (8, 12))
    assert (fine, k, degree) == (PLAN.for_degree((8, 12)), pytest.approx(6 / 50), (8, 12))
    steps = [PLAN._wave_arguments(k, (8, 12))[1] for k in (0.13, 0.14, 0.15, 1.0)]
    assert steps[0] == steps[1] == pytest.approx(1.2 * 6 / 50) and steps[2] == pytest.approx(1.44 * 6 / 50)
    assert 1.0 <= steps[3] < 1.2
    layout = PLAN.wave_layout(1.0, (8, 12))
    inside = layout.interior
    n = np.arange(1, int(8 + steps[3] * np.hypot(40.0, 10.0) / 4) + 1)
    assert inside.x == pytest.approx(18.0 * ((n * 0.6180339887498949) % 1.0))
    assert inside.y == pytest.approx(4.5 * ((n * 0.4142135623730951) % 1.0))
    assert PLAN.wave_layout(0.999 * steps[3], (8, 12)) is PLAN.wave_layout(1.0 * steps[3], (8, 12))


def test_nodes_of_a_contour_integrate_its_polynomials_and_the_arms_of_motions():
    """Of degrees 3 and 5 and 2 more each, 7 and 9 points"""
    c = PLAN.polynomial_contour((3, 5))
    end = c.nx > 0.5
    assert (end.sum(), (~end).sum()) == (7, 9) and np.all(c.x[end] == 20.0) and np.all(c.y[~end] == 5.0)
    assert np.sum(c.weights[end] * c.y[end] ** 13) == pytest.approx(5.0**14 / 14)
    assert np.sum(c.weights[~end] * c.x[~end] ** 17) == pytest.approx(20.0**18 / 18)
    assert len(PLAN.polynomial_contour(4).x) == 16


def test_points_on_a_circle_are_for_the_orders_of_waves_and_functions():
    """(m + 4)/2 and 4 more of a quarter; of the highest order of kR or the degree"""
    for k, degree, tolerance in ((0.0, 9, 1e-3), (3.0, 4, 1e-6)):
        digits, x = -math.log10(tolerance), 5.0 * k
        orders = max(degree, math.ceil(x + (1 + 0.7 * digits) * x ** (1 / 3) + digits / 2 + 1))
        c = Circle(5.0).contour(k, degree, tolerance)
        count = (orders + 4) // 2 + 4
        assert len(c.x) == count and c.weights == pytest.approx(np.full(count, 2.5 * np.pi / count))
        assert np.arctan2(c.y, c.x) == pytest.approx((np.arange(count) + 0.5) * np.pi / 2 / count)
    assert len(Circle(5.0).polynomial_contour(6).x) == len(Circle(5.0).contour(0.0, 10, 1e-3).x)
    assert Circle(1.0, 9).degree(0.1, 1e-3) == 9


def test_maps_without_waves_are_as_those_of_long_ones_on_finer_panels(monkeypatch):
    """κ of 1e-4, where the mean is free: 1/κ of it apart; three nodes more on a panel"""
    made = []
    panels = Rectangle.panels
    monkeypatch.setattr(Rectangle, "panels", lambda self, k, degree: made.append((self, k)) or panels(self, k, degree))
    still, long = PLAN.laplace((4, 4)), PLAN.maps((4, 4), np.array([1e-4]))
    fine = PLAN.for_degree((4, 4))
    assert made == [(replace(fine, nodes=fine.nodes + 3, count=fine.count + 3), 0.0), (fine, 0.0)]
    for cls in CLASSES:
        for n, (none, waves) in enumerate(zip(still[cls], long[cls], strict=True)):
            if cls == (1, 1) and n == 0:
                assert np.isnan(none).all()  # outside a source alone has no bound
                continue
            part = waves[0] / 1e-4
            if cls == (1, 1):
                c = PLAN.polynomial_contour((4, 4))
                unit = 4 * c.weights @ PLAN.basis(cls, (4, 4), c)
                mean = np.outer(unit, unit) / 100.0  # of the whole contour's length
                rest = np.eye(len(mean)) - mean
                none, part = rest @ none @ rest, rest @ part @ rest
            assert np.abs(none - part).max() < 2e-4 * np.abs(none).max()


def test_the_best_answer_of_too_many_equations_is_that_of_least_squares():
    rng = np.random.default_rng(3)
    matrix = rng.normal(size=(9, 4)) + 1j * rng.normal(size=(9, 4))
    right = rng.normal(size=(9, 2)) + 1j * rng.normal(size=(9, 2))
    assert rectangle._least_squares(matrix, right) == pytest.approx(np.linalg.lstsq(matrix, right)[0])
    with pytest.raises(np.linalg.LinAlgError, match="row 2 is not positive"):
        rectangle._least_squares(matrix * [1, 0, 1, 1], right)


def test_pieces_near_a_point_are_for_a_third_of_the_fastest_decay_and_wave(monkeypatch):
    """3/κ of the last of a table, 3/k of waves on the contour and inside, and none at κ = 0"""
    asked = []

    def noted(panels, x, y, own, count, smallest):
        asked.append((count, smallest, own[0] >= 0))
        raise InterruptedError

    monkeypatch.setattr(rectangle, "layers", noted)
    for call in (lambda: PLAN.maps((4, 4), np.array([0.5, 1.0, 4.0])), lambda: PLAN.laplace((4, 4))):
        with pytest.raises(InterruptedError):
            call()
    count = PLAN.for_degree((4, 4)).count
    assert asked == [(count, 0.75, True), (count + 3, np.inf, True)]
    asked.clear()
    monkeypatch.setattr(rectangle, "layers", lambda *them: asked.append((them[4], them[5], them[3][0])))
    rectangle._wave_layout.__wrapped__(PLAN, 0.3, (4, 4))
    assert asked == [(5, pytest.approx(10.0), -1), (5, pytest.approx(10.0), 0)]
