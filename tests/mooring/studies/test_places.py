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
    assert said == "fairleads away from the hull: one 8 m; limit 1 m; check their coordinates"


def test_a_fairlead_off_the_hull_of_a_database_is_told():
    mesh = box(100, 50, 10, panels=60)
    assert not list(off_the_mesh(system((50.0, 25.0, 7.0)), "body", mesh))
    (said,) = off_the_mesh(system((60.0, 25.0, 7.0)), "body", mesh)
    assert said.startswith("fairleads away from the hull of the database: ") and "10 m; limit 1 m" in said


def test_a_line_that_no_material_stretches_to_its_anchor_is_refused():
    said = refused((50.0, 25.0, 0.0), (70.0, 25.0, -20.0), length=5.0)
    away = np.hypot(20, 20)
    assert f"one is 5 m long and its anchor {away:.4g} m from its fairlead" in said
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


def test_of_many_lines_some_are_named_and_the_rest_counted():
    assert some(["a", "b"]) == "a, b"
    assert some([f"L{i}" for i in range(500)], most=3) == "L0, L1, L2 and 497 more"
