"""Two hulls in one mesh: beside each other they are sound, in each other they are not."""

import pytest

from meshing.overlap import overlaps
from meshing.panels import joined
from meshing.quality import findings
from meshing.shapes import box, buoy

PONTOON = box(40, 10, 5, panels=120).whole()


def said(mesh):
    return [found.text for found in findings(mesh) if "lie in each other" in found.text]


@pytest.mark.parametrize("shift", [(10.0, 5.0, 0.0), (0.0, 2.0, 0.0), (0.0, 9.0, 0.0)])
def test_hulls_that_lie_in_each_other_are_an_error(shift):
    texts = said(joined([PONTOON, PONTOON.moved(*shift)]))
    assert texts and all("join them to one hull, or move them apart" in text for text in texts)


@pytest.mark.parametrize("shift", [(0.0, 10.5, 0.0), (0.0, 30.0, 0.0), (45.0, 3.0, 0.0)])
def test_hulls_beside_each_other_are_sound(shift):
    assert said(joined([PONTOON, PONTOON.moved(*shift)])) == []


def test_a_hull_within_another_is_found_from_the_inner_one():
    small, large = buoy(2, 2, panels=60).whole(), PONTOON
    ((inside, of, _),) = overlaps(joined([small, large]).merged())
    assert inside == of


def test_a_mirrored_half_is_no_second_hull():
    assert said(box(40, 10, 5, panels=120)) == [] and said(box(40, 10, 5, panels=120).moved()) == []
