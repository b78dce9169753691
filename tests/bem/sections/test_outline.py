"""Outlines of sections: what is under water, and what is no section."""

import numpy as np
import pytest

from hakobune.bem.sections.outline import Edge, Outline, OutlineError, circle, closed, rectangle


@pytest.mark.parametrize("draft", [0.3, 5.0, 9.1])
def test_a_circle_displaces_its_segment(draft):
    half = np.arccos(1 - draft / 5)
    area = 25 * (half - np.sin(half) * np.cos(half))
    wet = circle(10.0).wetted(draft)
    assert wet.area == pytest.approx(area, rel=1e-13)
    assert wet.waterline == pytest.approx(10 * np.sin(half), rel=1e-13)
    assert wet.center == pytest.approx(1j * (5 - draft - (wet.waterline / 2) ** 3 / 1.5 / area), abs=1e-12)
    assert wet.symmetric and circle(10.0).draft_of(area) == pytest.approx(draft, rel=1e-9)


def test_the_sense_and_the_first_point_of_an_outline_do_not_matter():
    points = np.array([-3, 3, 3 + 4j, 1 + 6j, -3 + 4j])
    there = closed(points).wetted(5.0)
    back = closed(np.roll(points, 2)[::-1]).wetted(5.0)
    assert back.edges == there.edges and back.area == there.area and not there.symmetric


def test_what_is_no_section_is_refused():
    with pytest.raises(
        OutlineError,
        match=r"the outline is not closed: edge 1 ends at \(1, 0\), and the next begins at \(1, 0\.5\), 0\.5 m away",
    ):
        Outline((Edge(0, 1), Edge(1 + 0.5j, 1j), Edge(1j, 0)))
    with pytest.raises(OutlineError, match="crosses itself: edges 1 and 3"):
        closed(np.array([0, 2 + 2j, 2, 2j]))
    with pytest.raises(OutlineError, match="draft is 4 m, but the section is 4 m high"):
        rectangle(2.0, 4.0).wetted(4.0)
    with pytest.raises(OutlineError, match="into 2 pieces"):
        closed(np.array([-3, -2, -2 + 2j, 2 + 2j, 2, 3, 3 + 4j, -3 + 4j])).wetted(1.0)


def test_the_distance_from_an_outline_is_that_of_a_circle_and_of_a_rectangle():
    assert circle(10.0).distance(1.0 + 2.0j) == 0
    assert circle(10.0).distance(6.0 + 8.0j) == pytest.approx(5.0, abs=5 * (1 - np.cos(np.pi / 128)))
    box = rectangle(10.0, 6.0)
    assert box.distance(8.0 + 10.0j) == pytest.approx(5.0) and box.distance(7.0 + 0.0j) == pytest.approx(2.0)
    assert box.distance(-5.0 - 3.0j) == pytest.approx(3.0)


def test_an_arc_is_that_of_its_bulge():
    """tan of a quarter of its angle: 1 is half a circle to the left; the bottom of one of 10 m from −5 to 5 is −5i"""
    half = Edge(-5 + 0j, 5 + 0j, 1.0)
    assert (
        half.angle == pytest.approx(np.pi)
        and half.center == pytest.approx(0)
        and half.length == pytest.approx(5 * np.pi)
    )
    assert half.at(0.5) == pytest.approx(-5j) and half.slope(0.5) == pytest.approx(5 * np.pi)
    quarter = Edge(5 + 0j, 5j, np.tan(np.pi / 8))
    assert quarter.center == pytest.approx(0) and quarter.length == pytest.approx(2.5 * np.pi)
    assert quarter.at(np.array([0.0, 0.5, 1.0])) == pytest.approx(5 * np.exp(0.25j * np.pi * np.arange(3)))
    back = Edge(5j, 5 + 0j, -np.tan(np.pi / 8))
    assert back.center == pytest.approx(0) and back.at(0.5) == pytest.approx(quarter.at(0.5))
    third = quarter.part(1 / 3, 1.0)
    assert third.start == pytest.approx(5 * np.exp(1j * np.pi / 6)) and third.end == 5j
    assert third.angle == pytest.approx(np.pi / 3) and third.center == pytest.approx(0)
    straight = Edge(1 + 1j, 4 + 5j)
    assert straight.length == 5.0 and straight.at(0.25) == 1.75 + 2j and straight.slope(0.3) == 3 + 4j


def test_edges_meet_a_height_where_they_reach_it():
    half = Edge(-5 + 0j, 5 + 0j, 1.0)
    found = half.at_height(-2.5)
    assert half.at(np.array(found)).imag == pytest.approx([-2.5, -2.5]) and found == pytest.approx([1 / 6, 5 / 6])
    assert half.at_height(1.0) == [] and half.at_height(-5.5) == []
    assert Edge(1 - 1j, 4 + 3j).at_height(0.0) == [0.25] and Edge(1 - 1j, 4 - 1j).at_height(-1.0) == []
    other = Edge(5 + 0j, -5 + 0j, -1.0).at_height(-2.5)
    assert other == pytest.approx([1 / 6, 5 / 6])


def test_the_height_of_a_section_counts_the_tops_of_its_arcs():
    """A half disc of 5 m under a box of 2 m"""
    made = closed(np.array([-5, 5, 5 + 2j, -5 + 2j]), (1.0, 0, 0, 0))
    assert made.bottom == pytest.approx(-5.0) and made.height == pytest.approx(7.0)
    wet = made.wetted(6.0)
    assert wet.area == pytest.approx(12.5 * np.pi + 10) and wet.draft == 6.0 and wet.symmetric
    # centre of a half disc 4r/3π below its straight side, which lies 1 m deep
    assert wet.center.imag == pytest.approx((12.5 * np.pi * -(1 + 20 / (3 * np.pi)) - 10 * 0.5) / wet.area)
    assert made.draft_of(12.5 * np.pi + 10) == pytest.approx(6.0, rel=1e-9)


@pytest.mark.parametrize("degrees, taken", [(0.95, False), (1.05, True)])
def test_the_water_is_met_at_a_degree_or_more(degrees, taken):
    rise = 3 * np.tan(np.radians(degrees))
    made = closed(np.array([-2 - 3j, 2 - 3j, 2 - rise * 1j, 5, 5 + 2j, -2 + 2j]))
    raised = closed(np.array([-2 - 3j, 2 - 3j, 2 - 0.5 * rise * 1j, 5 + 0.5j * rise, 5 + 2j, -2 + 2j]))
    assert made is not raised
    if taken:
        assert raised.wetted(3.0).right == pytest.approx(3.5)
    else:
        with pytest.raises(OutlineError, match="at draft 3 m the section touches the water at an angle below 1°"):
            raised.wetted(3.0)


@pytest.mark.parametrize("degrees, taken", [(0.95, False), (1.05, True)])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_round_bilge_meets_the_water_at_its_own_end(degrees, taken, mirrored):
    """A sixth of a circle of 3 m flattens from the keel to the water, where its tangent rises by about a degree"""
    beyond, turn = np.radians(0.3), np.pi / 3
    at = lambda rise: 3 * np.exp(1j * (np.pi / 2 + rise)) - 3 * np.exp(1j * (np.pi / 2 + np.radians(degrees)))  # noqa: E731
    start, end = at(np.radians(degrees) + turn), at(np.radians(degrees) - beyond)
    corners = np.array([-5 + 1j * start.imag, start, end, 0.5 + 2j, -5 + 2j])
    bulges = [0, -np.tan((turn + beyond) / 4), 0, 0, 0]
    if mirrored:
        corners, bulges = -corners[::-1].conjugate(), [0, 0, bulges[1], 0, 0]
    made = closed(corners, bulges)
    if taken:
        assert made.wetted(-start.imag).draft == pytest.approx(-start.imag)
    else:
        with pytest.raises(OutlineError, match="the section touches the water at an angle below 1°"):
            made.wetted(-start.imag)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: Outline((Edge(0, 1),)), "the outline has 1 edges; allowed: 2 or more"),
        (lambda: closed(np.array([0, 1, np.nan])), "edge 2 has a number that is not finite"),
        (lambda: closed(np.array([0, 1, 1, 1j])), r"edge 2 has zero length at \(1, 0\)"),
        (lambda: closed(np.array([0, 1, 2 + 1e-12j, 3])), "crosses itself|encloses"),
        (
            lambda: rectangle(2.0, 4.0).draft_of(8.0),
            "the section has to displace 8 m², and its whole area is 8 m²; allowed: less than the whole area",
        ),
        (lambda: rectangle(2.0, 4.0).draft_of(0.0), "has to displace 0 m²"),
        (lambda: rectangle(2.0, 4.0).wetted(0.0), "draft is 0 m, but the section is 4 m high; allowed: above 0"),
    ],
)
def test_more_that_is_no_section_is_refused(make, words):
    with pytest.raises(OutlineError, match=words):
        make()


def test_edges_that_touch_from_aside_are_found_and_those_of_one_line_apart_are_not():
    with pytest.raises(OutlineError, match="crosses itself: edges 1 and 4"):
        closed(np.array([0, 4, 4 + 2j, 3 + 2j, 2 + 0j, 1 + 2j, 0 + 2j]))  # a notch down to the bottom
    closed(np.array([0, 4, 4 + 2j, 3 + 2j, 2 + 0.01j, 1 + 2j, 0 + 2j]))
    box = rectangle(4.0, 2.0)
    assert box.meets(-3 + 1j, 3 + 1j) and not box.meets(-3 + 3j, 3 + 3j) and not box.meets(-1 + 1j, 1 + 1j)


@pytest.mark.parametrize("point, distance", [
    (4 + 3j, 2.4), (1 - 0.5j, 0.5), (3.5 - 0.5j, 0.5), (-0.7 + 2.2j, 0.7), (7 - 4j, 5.0), (-3 + 7j, 5.0), (1 + 1j, 0.0),
    (2.4 + 4.4j, 2.56),
])  # fmt: skip
def test_the_nearest_point_of_a_triangle_is_a_foot_on_a_side_or_a_corner(point, distance):
    """Corners (0, 0), (4, 0) and (0, 3): 3y + 4z = 12 of the long side"""
    sides = closed([0, 4, 3j])
    assert sides.distance(point) == pytest.approx(distance)


@pytest.mark.parametrize("bulge, crosses", [(-0.49, False), (-0.51, True), (0.6, False)])
def test_an_arc_crosses_where_it_sags_and_not_its_chord(bulge, crosses):
    """Of a chord of 4 m by twice its bulge: 0.98 m and 1.02 m below a top 1 m above the bottom"""
    points = np.array([-2, 2, 2 + 1j, -2 + 1j])
    if crosses:
        with pytest.raises(OutlineError, match="the outline crosses itself: edges 1 and 3 meet near"):
            closed(points, (0, 0, bulge, 0))
    else:
        assert len(closed(points, (0, 0, bulge, 0)).edges) == 4
