import itertools

import numpy as np
import pytest

from hakobune.meshing.panels import SYMMETRIES
from hakobune.meshing.quality import findings
from hakobune.meshing.shapes import box, box_counts, buoy, buoy_counts, fitted_counts


def shapes():
    yield from (box(100, 50, 10, panels=n, symmetry=s) for n in (20, 500) for s in SYMMETRIES)
    yield from (buoy(10, 10, panels=n, symmetry=s) for n in (60, 500) for s in SYMMETRIES)
    yield box(100, 50, 10, panels=200, grading=False)
    yield buoy(10, 30, counts=(5, 3, 4), grading=False)


@pytest.mark.parametrize("mesh", list(shapes()), ids=lambda mesh: f"{mesh.name} {mesh.symmetry} {len(mesh)}")
def test_no_shape_has_a_finding(mesh):
    assert findings(mesh, depth=400.0) == []


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_a_box_has_the_volume_and_the_areas_of_a_box(symmetry):
    mesh = box(100, 50, 10, symmetry=symmetry)
    assert mesh.volume == pytest.approx(100 * 50 * 10, rel=1e-12)
    sides = np.abs(mesh.area_vectors).sum(axis=0) * mesh.copies
    np.testing.assert_allclose(sides, (2 * 50 * 10, 2 * 100 * 10, 100 * 50), rtol=1e-12)


@pytest.mark.parametrize("symmetry", SYMMETRIES)
def test_a_buoy_has_the_volume_and_the_waterplane_of_a_cylinder(symmetry):
    mesh = buoy(7, 12, panels=300, symmetry=symmetry)
    assert mesh.volume == pytest.approx(np.pi * 7**2 * 12, rel=1e-12)
    assert -mesh.copies * mesh.area_vectors[:, 2].sum() == pytest.approx(np.pi * 7**2, rel=1e-12)


def test_the_wall_of_a_buoy_converges_at_second_order():
    walls = [buoy(10, 10, counts=(n, 2, 2), bottom=False).areas.sum() * 4 for n in (8, 16, 32)]
    excess = np.array(walls) / (2 * np.pi * 10 * 10) - 1
    np.testing.assert_allclose(np.log2(excess[:-1] / excess[1:]), 2, atol=0.02)
    assert excess[-1] == pytest.approx(np.pi**2 / (6 * 128**2), rel=1e-2)


def test_parts_with_their_images_are_the_whole_hull():
    whole = box(30, 20, 5, panels=200, symmetry="")
    for symmetry in ("x", "y", "xy"):
        part = box(30, 20, 5, panels=200, symmetry=symmetry)
        assert part.total == len(whole)
        found = part.whole()
        order = np.lexsort(found.centroids.round(9).T)
        expected = np.lexsort(whole.centroids.round(9).T)
        np.testing.assert_allclose(found.centroids[order], whole.centroids[expected], atol=1e-12)
        np.testing.assert_allclose(found.normals[order], whole.normals[expected], atol=1e-12)


def test_a_part_lies_on_the_positive_side_of_its_mirror_planes():
    for make, symmetry in itertools.product(
        (lambda s: box(9, 8, 7, symmetry=s), lambda s: buoy(5, 4, symmetry=s)), SYMMETRIES
    ):
        mesh = make(symmetry)
        for k, axis in enumerate("xy"):
            low = mesh.points[:, k].min()
            assert low == 0 if axis in symmetry else low < 0


def test_counts_are_panels_over_half_length_half_beam_and_draft():
    assert box(100, 50, 10, counts=(5, 2, 3)).total == 4 * (5 * 2 + (5 + 2) * 3)
    assert buoy(10, 10, counts=(4, 3, 5)).total == 4 * 4 * (3 + 5)
    assert buoy(10, 10, counts=(4, 3, 5), bottom=False).total == 4 * 4 * 5


def test_graded_points_follow_the_cosine_law():
    mesh = box(100, 50, 10, counts=(5, 3, 4))
    i = np.arange(6)
    np.testing.assert_allclose(np.unique(mesh.points[:, 0].round(10)), 50 * np.sin(np.pi / 10 * i), atol=1e-9)
    z = -5 * (1 - np.cos(np.pi / 4 * np.arange(4, -1, -1)))
    np.testing.assert_allclose(np.unique(mesh.points[:, 2].round(10)), z, atol=1e-9)


def test_rings_of_the_buoy_bottom_are_similar_polygons():
    mesh = buoy(10, 10, counts=(6, 4, 3))
    bottom = np.isclose(mesh.points[:, 2], -10)
    radii = np.hypot(*mesh.points[bottom, :2].T)
    expected = radii.max() * np.sin(np.pi / 8 * np.arange(5))
    np.testing.assert_allclose(np.unique(radii.round(9)), expected, atol=1e-8)


@pytest.mark.parametrize("panels", (20, 75, 200, 500, 1000, 5000))
@pytest.mark.parametrize("size", ((100, 50, 10), (10, 10, 10), (200, 20, 1), (5, 5, 60)))
def test_panels_are_at_most_and_nearly_what_was_asked_for(panels, size):
    a, b, d = box_counts(*size, panels)
    total = 4 * (a * b + (a + b) * d)
    assert total <= panels
    cheapest = 4 * min(b + d, a + d, a + b)  # one more row in the direction where it costs least
    assert total + cheapest > panels


def test_panels_are_equally_thin_along_every_edge_of_a_box():
    a, b, d = box_counts(100, 50, 10, 20000)
    # first panel of cosine grading: extent π²/8n² from an edge at one end, half as much of twice the draft
    thin = [50 / a**2, 25 / b**2, 20 / d**2]
    assert max(thin) / min(thin) < 1.15


@pytest.mark.parametrize("longest", (2.0, 5.0))
def test_short_waves_get_short_edges(longest):
    assert box(100, 50, 10, panels=100, longest=longest).sizes.max() <= longest
    assert buoy(10, 10, panels=100, longest=longest).sizes.max() <= longest * 1.01  # the polygon is a little wider


def test_a_buoy_never_has_more_panels_than_asked_for():
    for panels in (40, 100, 500, 3000):
        q, r, d = buoy_counts(10, 5, panels)
        assert 0 < 4 * q * (r + d) <= panels


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"length": 0}, "length is 0"),
        ({"beam": -3}, "beam is -3"),
        ({"draft": float("nan")}, "draft is nan"),
        ({"length": float("inf")}, "length is inf"),
        ({"symmetry": "z"}, "symmetry is 'z'"),
        ({"panels": 3}, "panels is 3; allowed: at least 20"),
        ({"panels": float("nan")}, "panels is nan"),
        ({"counts": (1, 2)}, "three whole numbers"),
        ({"counts": (1, 2, 0)}, "three whole numbers"),
    ],
)
def test_what_cannot_be_meshed_is_named(arguments, words):
    with pytest.raises(ValueError, match=words):
        box(**{"length": 10, "beam": 5, "draft": 2} | arguments)


def test_shapes_are_named_by_their_dimensions():
    assert box(100, 50, 10).name == "box 100 x 50 x 10 m"
    assert buoy(10, 7.5).name == "buoy 10 m radius x 7.5 m"


def test_counts_are_the_largest_in_proportion_by_hand():
    """Edges 100, 20 and 20 m: roots 10 to 4.47.  (22, 9, 9) has 1908 panels, (22, 10, 10) 2160; one more along makes
    1980, below 2000, and one more across 2032"""
    assert box_counts(200, 40, 10, 2000) == (23, 9, 9)


def test_what_rounding_leaves_goes_to_the_direction_that_is_farthest_below_its_wish():
    """Roots 3, 2 and 1, as many panels as the sum of the counts: below t = 2 are (5, 3, 2), ten, of whose wishes 3/5,
    2/3 and 1/2 the second is the largest: (5, 4, 2), eleven"""
    assert fitted_counts((9.0, 4.0, 1.0), sum, 10, (1, 1, 1)) == (5, 3, 2)
    assert fitted_counts((9.0, 4.0, 1.0), sum, 11, (1, 1, 1)) == (5, 4, 2)


@pytest.mark.parametrize("value", [0, -3.0, float("nan"), float("inf")])
@pytest.mark.parametrize("name", ["radius", "draft"])
def test_a_buoy_has_a_positive_radius_and_draft(name, value):
    with pytest.raises(ValueError, match=f"^{name} is {value} m; allowed: a positive length$"):
        buoy(**{"radius": 5.0, "draft": 2.0} | {name: value})
    with pytest.raises(ValueError, match="symmetry is 'z'"):
        buoy(5.0, 2.0, symmetry="z")
