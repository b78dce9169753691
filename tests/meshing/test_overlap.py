"""Two hulls in one mesh: beside each other they are sound, in each other they are not."""

import numpy as np
import pytest

from hakobune.meshing.panels import joined
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.overlap import _solid_angles, connected, overlaps, winding
from hakobune.meshing.shapes import box, buoy

PONTOON = box(40, 10, 5, panels=120).whole()


def said(mesh):
    return [found.text for found in findings(mesh) if "overlap" in found.text]


@pytest.mark.parametrize("shift", [(10.0, 5.0, 0.0), (0.0, 2.0, 0.0), (0.0, 9.0, 0.0)])
def test_hulls_that_lie_in_each_other_are_an_error(shift):
    texts = said(joined([PONTOON, PONTOON.moved(*shift)]))
    assert texts and all("join them into one hull, or move them apart" in text for text in texts)


@pytest.mark.parametrize("shift", [(0.0, 10.5, 0.0), (0.0, 30.0, 0.0), (45.0, 3.0, 0.0)])
def test_hulls_beside_each_other_are_sound(shift):
    assert said(joined([PONTOON, PONTOON.moved(*shift)])) == []


def test_a_hull_within_another_is_found_from_the_inner_one():
    small, large = buoy(2, 2, panels=60).whole(), PONTOON
    ((inside, of, _),) = overlaps(joined([small, large]).merged())
    assert inside == of


@pytest.mark.parametrize("symmetry", ["", "xy"])
def test_a_cavity_has_its_normals_right_and_is_to_be_removed(symmetry):
    """An air space in the hull whose normals point into it, out of the steel; --flip would turn the hull inside out"""
    hull, space = box(40, 10, 5, panels=120, symmetry="xy"), box(10, 5, 2, panels=40, symmetry="xy").flipped()
    if not symmetry:
        hull, space = hull.whole(), space.whole()
    errors = [found.text for found in findings(joined([hull, space])) if found.severity == "error"]
    assert len(errors) == 1 and "or remove the inner one, which no water reaches" in errors[0]
    outward = [found.text for found in findings(joined([hull, space.flipped()])) if found.severity == "error"]
    assert len(outward) == 1 and "overlap" in outward[0]


def test_a_mirrored_half_is_no_second_hull():
    assert said(box(40, 10, 5, panels=120)) == [] and said(box(40, 10, 5, panels=120).moved()) == []


@pytest.mark.parametrize("seed", range(4))
def test_connected_parts_are_those_of_scipy(seed):
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 400))
    a, b = rng.integers(0, count, (2, int(rng.integers(0, 2 * count))))
    graph = coo_array((np.ones(len(a)), (a, b)), shape=(count, count))
    np.testing.assert_array_equal(connected(a, b, count), connected_components(graph, directed=False)[1])


def test_a_long_chain_in_any_order_is_one_part_and_two_of_them_are_two():
    order = np.random.default_rng(1).permutation(2000)
    chain = np.delete(np.arange(1999), 999)
    part = connected(order[chain], order[chain + 1], 2000)
    assert len(np.unique(part[order[:1000]])) == len(np.unique(part[order[1000:]])) == 1 and part.max() == 1


def test_the_solid_angle_of_an_octant_is_an_eighth_of_all():
    """And of a face of a cube from its middle a sixth, from a corner of it none of the three that meet there"""
    octant = np.eye(3)[None]
    assert _solid_angles(np.zeros((1, 3)), octant) == pytest.approx([1 / 8])
    assert _solid_angles(np.zeros((1, 3)), 7.0 * octant) == pytest.approx([1 / 8])
    face = np.array([[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1.0]])
    assert _solid_angles(np.array([[0, 0, 0], [1 - 1e-9, 0, 0], [-1e6, 0, 0]]), face[[[0, 1, 2], [0, 2, 3]]]) == (
        pytest.approx([1 / 6, 1 / 2, 0.0], abs=1e-6)
    )


def test_a_hull_and_its_image_wind_once_about_what_is_inside():
    """The solid angle of a closed surface is 4π seen from inside it, wherever that is, and nothing from outside"""
    panels = box(20, 10, 4, panels=40).whole().vertices
    inside = np.array([[0.0, 0, -1], [9.5, 4.5, -3.5], [-6.0, 2.0, 3.0]])
    assert np.abs(winding(inside, panels)) == pytest.approx([1.0] * 3, abs=1e-9)
    assert winding(np.array([[11.0, 0, -1], [0, 0, -4.5], [0, 5.5, 2.0]]), panels) == pytest.approx([0.0] * 3, abs=1e-9)


def test_the_place_of_an_overlap_is_a_panel_of_one_hull_within_the_other():
    """The end of a raft of 2 m of draft in the side of a pontoon of 5 m, whose bottom there is below the raft"""
    raft = box(20, 10, 2, panels=80).whole().moved(24.0, 2.0, 0.0)
    both = joined([PONTOON, raft]).merged()
    found = overlaps(both)
    assert len(found) == 2
    for inside, of, place in found:
        assert 0 < inside < of and 14.0 <= place[0] <= 20.0 and -3.0 <= place[1] <= 5.0 and -2.0 <= place[2] < 0.0
        assert np.abs(both.centroids - place).sum(axis=1).min() < 1e-12
