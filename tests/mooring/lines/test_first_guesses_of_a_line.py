"""First guesses and further tries of a search of a line of segments: a uniform chain by hand, ways in their order."""

import math

import pytest
from by_hand import span_of

from hakobune.mooring.lines.multi_segment import line as of_line
from hakobune.mooring.lines.multi_segment.line import StaticLine
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment

LENGTH, HEIGHT = 300.0, 50.0


@pytest.mark.parametrize("H", [2e4, 1e5, 4e5])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_first_guess_is_the_pull_of_a_uniform_chain_as_heavy(H, side):
    """Segments of 600 and 1200 N/m, together 900 N/m, and as they are stretched"""
    made = StaticLine((Segment(150.0, 600.0), Segment(150.0, 1200.0)))
    assert made._mean == pytest.approx((900.0, 0.0), abs=1e-12)
    assert made._like_a_uniform_line(side * span_of(H, 900.0, LENGTH, HEIGHT), HEIGHT) == pytest.approx(H, rel=1e-6)
    soft = StaticLine((Segment(150.0, 600.0, 1e8), Segment(150.0, 1200.0, 2e8)))
    assert soft._mean == pytest.approx((900.0, (150 / 1e8 + 150 / 2e8) / 300))


def test_loads_weigh_in_the_guess_and_buoys_leave_a_fifth_of_the_line():
    segments = (Segment(150.0, 600.0), Segment(150.0, 1200.0))
    for weight, mean in ((90e3, 1200.0), (-90e3, 600.0), (-250e3, 180.0)):
        made = StaticLine(segments, (PointLoad(100.0, weight),))
        assert made._mean[0] == pytest.approx(mean)


def test_the_guess_of_a_slack_line_is_nothing_and_of_one_that_cannot_reach_its_weight():
    made = StaticLine((Segment(LENGTH, 900.0),))
    assert made._like_a_uniform_line(200.0, HEIGHT) == 0.0  # 250 m would lie and hang
    assert made._like_a_uniform_line(400.0, HEIGHT) == pytest.approx(900.0 * LENGTH)
    hung = StaticLine((Segment(LENGTH, 900.0),), bed=None)
    a = 1e5 / 900.0  # a catenary between ends as high: x = 2a arsinh(L/2a)
    assert hung._like_a_uniform_line(2 * a * math.asinh(LENGTH / (2 * a)), 0.0) == pytest.approx(1e5, rel=1e-6)


def ways(made, **changes):
    search = of_line._search()
    data = made._data._replace(**changes)
    return data, [(way, tuple(map(float, tolerances))) for way, tolerances in made._further_tries(data)], search


def test_a_line_without_buoys_or_friction_is_sought_again_exactly_and_the_other_way():
    data, tries, search = ways(StaticLine((Segment(LENGTH, 900.0),)), friction=0.0)
    quick, exact = tuple(map(float, search.QUICK)), tuple(map(float, search.EXACT))
    assert [(way.to_place != data.to_place, tolerances) for way, tolerances in tries] == [
        (False, exact), (True, quick), (True, exact)]  # fmt: skip


def test_buoys_in_the_surface_are_sought_softly_and_friction_by_shares():
    made = StaticLine((Segment(LENGTH, 900.0),), (PointLoad(100.0, -1e4),), surface=60.0)
    _, tries, _ = ways(made, friction=0.5)
    assert tries[3][0].soft == pytest.approx(1e-3 * LENGTH)
    assert [way.friction for way, _ in tries[4:7]] == pytest.approx([0.25, 0.1, 0.0]) and len(tries) == 7
    _, deep, _ = ways(StaticLine((Segment(LENGTH, 900.0),), (PointLoad(100.0, -1e4),)), friction=0.0)
    assert len(deep) == 3


@pytest.mark.parametrize("weight", [0.09, 900.0, 9e6])
def test_a_line_is_slack_below_the_same_share_of_its_weight_however_heavy_it_is(weight):
    assert StaticLine((Segment(LENGTH, weight),))._data.least == pytest.approx(1e-11 * weight * LENGTH, rel=1e-12)
