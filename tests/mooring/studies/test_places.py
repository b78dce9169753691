"""Fairleads off the hull, lines through it and lines that cannot reach: refused or told with number and limit."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing.shapes import box
from hakobune.mooring.lines.system.moored_body import Leg, moored_body
from hakobune.mooring.lines.system.parts import LineType, UniformLine
from hakobune.mooring.response.findings import some
from hakobune.mooring.studies.conditions import ExposedBox, afloat
from hakobune.mooring.studies.places import check_places, off_the_mesh, place_findings

HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
HULLS = afloat(SimpleNamespace(bodies=(), rotation_center=np.zeros(3), density=1025.0), HULL)
CHAIN = LineType("chain", 3500.0, 1e9)


def system(fairlead, anchor=(150.0, 25.0, -20.0), length=120.0):
    return moored_body([Leg(UniformLine("one", CHAIN, length, "", ""), anchor, fairlead)], 20.0)


def refused(*place, **more):
    with pytest.raises(ValueError) as error:
        check_places(system(*place, **more), HULLS)
    return str(error.value)


@pytest.mark.parametrize(
    ("fairlead", "out"),
    [((450.0, 25.0, 0.0), 400.0), ((50.0, -70.0, 0.0), 45.0), ((50.0, 25.0, 60.0), 50.0), ((50.0, 25.0, -25.0), 15.0)],
)
def test_a_fairlead_off_the_hull_is_refused_with_its_distance(fairlead, out):
    assert f"{out:.4g} m off the hull of 100 by 50 m" in refused(fairlead)


@pytest.mark.parametrize("fairlead", [(50.0, 25.0, 0.0), (-50.0, 25.0, 10.0), (0.0, 0.0, -10.0), (58.0, 0.0, 5.0)])
def test_a_fairlead_on_the_hull_or_on_a_bracket_is_accepted(fairlead):
    check_places(system(fairlead, length=250.0), HULLS)


def test_a_fairlead_on_a_bracket_is_told():
    (said,) = place_findings(system((58.0, 0.0, 5.0)), HULLS)
    assert said == "these fairleads are away from the hull: one 8 m; limit 1 m; check their coordinates"


def test_a_fairlead_off_the_hull_of_a_database_is_told():
    mesh = box(100, 50, 10, panels=60)
    assert not list(off_the_mesh(system((50.0, 25.0, 7.0)), "body", mesh))
    (said,) = off_the_mesh(system((60.0, 25.0, 7.0)), "body", mesh)
    assert said.startswith("these fairleads are away from the hull of the database: ") and "10 m; limit 1 m" in said


def test_a_line_that_no_material_stretches_to_its_anchor_is_refused():
    said = refused((50.0, 25.0, 0.0), (70.0, 25.0, -20.0), length=5.0)
    away = np.hypot(20, 20)
    assert f"one is 5 m long, and its anchor is {away:.4g} m from its fairlead" in said
    assert f"stretched by {100 * (away / 5 - 1):.3g} %, limit 50 %" in said
    check_places(system((50.0, 25.0, 0.0), (70.0, 25.0, -20.0), length=20.0), HULLS)


@pytest.mark.parametrize(
    ("fairlead", "anchor", "inside"),
    [
        ((50.0, 25.0, 0.0), (150.0, 125.0, -20.0), 0.0),  # away from the corner
        ((50.0, 0.0, 0.0), (-150.0, 0.0, -20.0), 100.0),  # back along the hull, out by the keel
        ((0.0, 0.0, -10.0), (150.0, 0.0, -20.0), 0.0),  # from a turret under the keel
        ((0.0, 25.0, 0.0), (0.0, -125.0, -20.0), 50.0),  # across it
    ],
)
def test_a_line_through_the_hull_is_told_with_its_length_in_it(fairlead, anchor, inside):
    said = [text for text in place_findings(system(fairlead, anchor), HULLS) if "through the hull" in text]
    assert len(said) == (inside > 0)
    chord = np.linalg.norm(np.subtract(anchor, fairlead))
    share = min(inside / np.abs(np.subtract(anchor, fairlead)[:2]).sum(), 0.5)  # halfway it leaves by the keel
    assert all(f"one {share * chord:.3g} m" in text for text in said)


ROUND = afloat(
    SimpleNamespace(bodies=(), rotation_center=np.zeros(3), density=1025.0),
    ExposedBox(40.0, 40.0, 10.0, 10.0, is_round=True),
)


@pytest.mark.parametrize(
    ("fairlead", "anchor", "inside"),
    [
        ((14.2, 14.2, -5.0), (120.0, 120.0, -20.0), 0.0),  # at 45° on the rim (14.14 m), within the box around it
        ((20.0, 0.0, -5.0), (-120.0, 0.0, -5.0), 40.0),  # through the axis
        ((12.0, 16.0, -5.0), (12.0, -116.0, -5.0), 32.0),  # a chord of half length √(20² − 12²)
        ((19.0, 19.0, -5.0), (-81.0, 119.0, -5.0), 0.0),  # past it, through a corner of the box
        ((20.0, 0.0, -5.0), (-60.0, 0.0, -15.0), np.hypot(40.0, 5.0)),  # half the way, out by the keel
    ],
)
def test_lines_and_fairleads_of_a_round_hull_meet_its_circle(fairlead, anchor, inside):
    said = list(place_findings(system(fairlead, anchor), ROUND))
    through = [text for text in said if "through the hull" in text]
    assert len(through) == (inside > 0) and all(f"one {inside:.3g} m" in text for text in through)
    out = np.hypot(*fairlead[:2]) - 20.0
    beside = [text for text in said if text.startswith("these fairleads are away")]
    assert len(beside) == (out > 0.4) and all(f"one {out:.3g} m" in text for text in beside)


def test_a_line_straight_down_is_in_a_round_hull_or_beside_it():
    for x, inside in ((10.0, 15.0), (20.1, 0.0)):
        said = list(place_findings(system((x, 0.0, 5.0), (x, 0.0, -20.0)), ROUND))
        assert [f"one {inside:.3g} m" in text for text in said] == [True] * (inside > 0)


def test_of_many_lines_some_are_named_and_the_rest_counted():
    assert some(["a", "b"]) == "a, b"
    assert some([f"L{i}" for i in range(500)], most=3) == "L0, L1, L2 and 497 more"
