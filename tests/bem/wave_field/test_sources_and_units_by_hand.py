"""Sources on a plan and waves of several units, term by term."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import hankel1

from hakobune.bem.wave_field.around import WavesAround, at_waterline, plan_of
from hakobune.bem.wave_field.sources import Sources, contour, perimeter, rectangle, shrunk, spaced
from hakobune.bem.wave_field.units import Field, field
from hakobune.meshing.shapes import box

SQUARE = rectangle(np.array([1.0, 1.0]))


def test_points_around_a_plan_are_evenly_spaced_from_half_a_step():
    """Eight of a square of 2 m: 0.5 and 1.5 m along each side; a fraction is rounded up"""
    along = [(-0.5, -1), (0.5, -1), (1, -0.5), (1, 0.5), (0.5, 1), (-0.5, 1), (-1, 0.5), (-1, -0.5)]
    for count in (8, 7.2):
        assert spaced(SQUARE, count) == pytest.approx(np.array(along, float))
    assert contour(SQUARE, 8) == pytest.approx(np.array(along, float))
    assert len(contour(SQUARE, 2)) == 8  # at least two on each side
    assert len(contour(rectangle(np.array([4.0, 1.0])), 10)) == 2 * 4 + 2 * 2  # of 2 m each, the shorter sides of two
    assert perimeter(rectangle(np.array([4.0, 1.0]))) == 20.0


def test_a_plan_shrinks_by_a_share_of_its_smaller_half_breadth_on_every_side():
    plan = rectangle(np.array([5.0, 2.0])) + [7.0, 3.0]
    assert shrunk(plan) == pytest.approx(rectangle(np.array([4.8, 1.8])) + [7.0, 3.0])
    assert shrunk(plan, 0.45) == pytest.approx(rectangle(np.array([4.1, 1.1])) + [7.0, 3.0])


def test_strengths_of_nothing_are_nothing_and_many_places_are_as_few(monkeypatch):
    theta = np.arange(32) * np.pi / 16
    one = Sources(rectangle(np.array([5.0, 2.0])), 0.5, theta)
    none, missed = one.strengths(np.zeros((2, 32)))
    assert not none.any() and missed == 0.0
    rng = np.random.default_rng(2)
    strengths, places = rng.normal(size=(3, len(one.points))), rng.normal(size=(7, 2)) * 9 + [30.0, 0.0]
    r = np.linalg.norm(places[:, None] - one.points, axis=-1)
    expected = strengths @ hankel1(0, 0.5 * r).T
    assert one.elevation(strengths, places) == pytest.approx(expected)
    monkeypatch.setattr("hakobune.bem.wave_field.sources.AT_ONCE", 3 * len(one.points))
    assert one.elevation(strengths, places) == pytest.approx(expected)
    assert one.elevation(strengths, places[:0]).shape == (3, 0)


class Made:
    """Two sources of a unit"""

    k, points = 0.3, np.array([[0.5, 0.0], [-0.25, 0.5]])
    angle = np.arange(8) * np.pi / 4
    sent = np.exp(-0.3j * (np.outer(np.cos(angle), points[:, 0]) + np.outer(np.sin(angle), points[:, 1])))

    def elevation(self, strengths, places):
        r = np.linalg.norm(places[:, None] - self.points, axis=-1)
        return strengths @ hankel1(0, self.k * r).T

    def covers(self, places):
        return np.hypot(*places.T) < 1.0


def test_waves_of_units_are_those_of_all_their_sources_and_the_wave_that_comes():
    """exp(ik·p) and Σ s H₀(k|p − p_u − p_j|); far away Σ s exp(−ik (p_u + p_j)·(cosθ, sinθ))"""
    rng = np.random.default_rng(4)
    middles, beta = np.array([[0.0, 0.0], [6.0, 2.0]]), np.array([0.4, 2.0])
    strengths = rng.normal(size=(2, 2, 2)) + 1j * rng.normal(size=(2, 2, 2))
    one = Field(Made(), middles, strengths, beta, 0.0)
    places = np.array([[3.0, -1.0], [-9.0, 4.0], [6.5, 2.5], [0.2, 0.3]])
    found = one.elevation(places)
    assert np.isnan(found[:, 2:]).all()  # in a unit
    far = one.far_field()
    for b in range(2):
        for n, p in enumerate(places[:2]):
            total = np.exp(0.3j * (p[0] * np.cos(beta[b]) + p[1] * np.sin(beta[b])))
            total += sum(
                strengths[b, u, j] * hankel1(0, 0.3 * np.linalg.norm(p - middles[u] - Made.points[j]))
                for u in range(2) for j in range(2)
            )  # fmt: skip
            assert found[b, n] == pytest.approx(total)
        for t, angle in enumerate(Made.angle):
            way = np.array([np.cos(angle), np.sin(angle)])
            total = sum(
                strengths[b, u, j] * np.exp(-0.3j * way @ (middles[u] + Made.points[j]))
                for u in range(2) for j in range(2)
            )  # fmt: skip
            assert far[b, t] == pytest.approx(total)


def test_one_unit_sends_what_it_sends_in_the_wave_at_its_middle():
    """H exp(ik·p) about its own middle; nothing of the ring of other waves is asked for"""
    theta, plan, k = np.arange(32) * np.pi / 16, rectangle(np.array([5.0, 2.0])), 0.5
    beta, middle = np.array([0.3, 1.2]), np.array([[4.0, -7.0]])
    own = np.exp(-1j * k * np.outer([1.0, 0.5], np.cos(theta)))
    one = field(plan, k, theta, own, None, None, beta, middle)
    strengths, missed = Sources(plan, k, theta).strengths(own)
    turn = np.exp(1j * k * (4.0 * np.cos(beta) - 7.0 * np.sin(beta)))
    assert one.strengths[:, 0] == pytest.approx(turn[:, None] * strengths) and one.strengths.shape[1] == 1
    assert one.missed == missed and one.beta is beta


@pytest.mark.parametrize("k, count", [(0.1, 24), (2.0, 8 * 28 * 2.0 / 2 / np.pi)])
def test_waves_that_arrive_are_met_at_eight_places_in_a_wave_around_a_unit_or_at_24(monkeypatch, k, count):
    """Of 10 x 4 m"""
    from hakobune.bem.wave_field import units

    theta, plan = np.arange(32) * np.pi / 16, rectangle(np.array([5.0, 2.0]))
    asked, kept = [], units.contour
    monkeypatch.setattr(units, "contour", lambda plan, count: asked.append(count) or kept(plan, count))
    own = np.exp(-1j * k * np.outer([1.0], np.cos(theta)))
    field(plan, k, theta, own, theta, np.tile(own, (32, 1)), np.zeros(1), np.array([[0.0, 0.0], [40.0, 0.0]]))
    assert asked == pytest.approx([count])


def test_waves_around_a_body_have_none_in_its_plan_unless_it_lies_below():
    sources = SimpleNamespace(covers=Made().covers, elevation=lambda s, places: 10.0 * places[:, 0])
    places = np.array([[3.2, 0.0], [8.0, 2.0]])
    for pierces in (True, False):
        one = WavesAround(1.0, 0.3, 0.7, sources, np.array([3.0, 0.0]), None, None, 0.0, pierces)
        found = one.elevation(places)
        wave = np.exp(0.3j * (places @ [np.cos(0.7), np.sin(0.7)])) + 10.0 * (places[:, 0] - 3.0)
        assert found[1] == pytest.approx(wave[1])
        assert np.isnan(found[0]) if pierces else found[0] == pytest.approx(wave[0])


def test_places_under_a_hull_are_taken_to_the_nearest_point_of_its_waterline():
    hull = box(10.0, 4.0, 2.0, panels=40)
    asked = [[4.5, 0.0], [0.0, 1.5], [0.0, -1.5], [4.9, 1.95], [6.0, 0.0], [0.0, 3.0]]
    wanted = [[5.0, 0.0], [0.0, 2.0], [0.0, -2.0], [4.9, 2.0], [6.0, 0.0], [0.0, 3.0]]
    assert at_waterline(hull, asked) == pytest.approx(np.array(wanted))
    below = hull.moved(dz=-1.0)
    assert at_waterline(below, asked[:1]) == pytest.approx(np.array(asked[:1])) and not plan_of(below)[1]
