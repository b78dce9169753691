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
        OutlineError, match=r"leaks: edge 1 ends at \(1, 0\), the next begins at \(1, 0.5\), 0.5 m away"
    ):
        Outline((Edge(0, 1), Edge(1 + 0.5j, 1j), Edge(1j, 0)))
    with pytest.raises(OutlineError, match="crosses itself: edges 1 and 3"):
        closed(np.array([0, 2 + 2j, 2, 2j]))
    with pytest.raises(OutlineError, match="draft is 4 m, the section is 4 m high"):
        rectangle(2.0, 4.0).wetted(4.0)
    with pytest.raises(OutlineError, match="into 2 pieces"):
        closed(np.array([-3, -2, -2 + 2j, 2 + 2j, 2, 3, 3 + 4j, -3 + 4j])).wetted(1.0)


def test_the_distance_from_an_outline_is_that_of_a_circle_and_of_a_rectangle():
    assert circle(10.0).distance(1.0 + 2.0j) == 0
    assert circle(10.0).distance(6.0 + 8.0j) == pytest.approx(5.0, abs=5 * (1 - np.cos(np.pi / 128)))
    box = rectangle(10.0, 6.0)
    assert box.distance(8.0 + 10.0j) == pytest.approx(5.0) and box.distance(7.0 + 0.0j) == pytest.approx(2.0)
    assert box.distance(-5.0 - 3.0j) == pytest.approx(3.0)
