"""Panels on the water outside a hull: areas and halves of polygons, mirror images, what is covered, what is refused."""

import numpy as np
import pytest

from hakobune.meshing.panels import joined
from hakobune.meshing.shapes import box, buoy
from hakobune.meshing.surface.patches import counter_clockwise, covered, mirrored_in, moonpools, patch, patches

SQUARE = np.array([[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]])
KITE = np.array([[0.0, -1.0], [3.0, 0.5], [0.0, 2.0], [-1.0, 0.5]])


@pytest.mark.parametrize("symmetry, area", [("", 8.0), ("x", 4.0), ("y", 4.0), ("xy", 2.0)])
def test_a_patch_is_what_lies_on_the_side_of_the_mirror_planes_that_is_meshed(symmetry, area):
    made = patch(SQUARE, 0.5, symmetry)
    assert made.areas.sum() == pytest.approx(area) and made.symmetry == symmetry
    assert np.all(made.area_vectors[:, 2] > 0) and not made.points[:, 2].any()
    for axis in symmetry:
        assert made.points[:, "xy".index(axis)].min() >= 0
    assert len(made) == pytest.approx(area / 0.25, rel=0.5)


def test_a_polygon_that_a_mirror_plane_cuts_askew_keeps_its_part():
    """The kite's part in x > 0: ½ · 3 · 3 m²; in y > 0 all but the triangle below, ½ · 1 · (2 + ⅔) m²"""
    assert patch(KITE, 0.4, "x").areas.sum() == pytest.approx(4.5)
    below = 0.5 * 1.0 * (2.0 + 2 / 3)
    assert patch(KITE, 0.4).areas.sum() == pytest.approx(6.0) and patch(KITE, 0.4, "y").areas.sum() == pytest.approx(
        6.0 - below
    )


def test_a_polygon_on_the_other_side_has_no_patch_nor_one_that_only_touches():
    for corners in (SQUARE - [3.0, 0.0], SQUARE - [2.0, 0.0], SQUARE - [2.0 - 0.4e-6, 0.0]):
        assert patch(corners, 0.5, "x") is None
    assert patch(SQUARE - [1.5, 0.0], 0.5, "x").areas.sum() == pytest.approx(1.0)


def test_patches_are_one_mesh_with_a_count_for_each():
    made, counts = patches([SQUARE + [3.0, 0.0], SQUARE - [9.0, 0.0], SQUARE + [9.0, 4.0]], 1.0, "x")
    assert counts[1] == 0 and counts.sum() == len(made) and min(counts[0], counts[2]) > 0
    assert made.areas[: counts[0]].sum() == pytest.approx(8.0) == made.areas[counts[0] :].sum()
    assert (made.symmetry, made.name) == ("x", "damping lids")


@pytest.mark.parametrize("corners", [
    [[0, 0], [1, 0]], [[0, 0], [4, 0], [1, 1], [0, 4]], [[0, 0], [2, 0], [4, 0]], [[0, 0], [2, 2], [2, 0], [0, 2]],
])  # fmt: skip
def test_a_polygon_is_convex_with_an_area(corners):
    """Two corners, a bent one, a line, and one that crosses itself"""
    with pytest.raises(
        ValueError, match="is not a convex polygon; allowed: three or more corners in order round it; divide"
    ):
        counter_clockwise(corners)


def test_corners_are_turned_counter_clockwise_and_a_millionth_of_a_bend_is_none():
    assert counter_clockwise(SQUARE[::-1]).tolist() == SQUARE.tolist()
    assert counter_clockwise(SQUARE).tolist() == SQUARE.tolist()
    assert counter_clockwise([[0, 0], [1, 0], [0, 1]]).tolist() == [[0, 0], [1, 0], [0, 1]]
    for bend, convex in ((0.9e-6, True), (1.1e-6, False)):  # of the square of its size: 2 m, 1 m aside
        bent = [[0, 0], [1.0, 2 * bend], [2, 0], [2, 1], [0, 1]]
        if convex:
            assert len(counter_clockwise(bent)) == 5
        else:
            with pytest.raises(ValueError):
                counter_clockwise(bent)


def test_planes_in_which_polygons_are_images_of_each_other_or_of_themselves():
    left, right = SQUARE - [5.0, 0.0], SQUARE + [5.0, 0.0]
    assert mirrored_in([left, right], "xy") == "xy" and mirrored_in([left], "xy") == "y"
    assert mirrored_in([KITE], "xy") == "" and mirrored_in([KITE, KITE * [-1, 1]], "xy") == "x"
    assert mirrored_in([left, right, KITE], "xy") == "" and mirrored_in([left, right], "x") == "x"
    for off, alike in ((3e-6, True), (5e-6, False)):  # a millionth of 4 m
        assert mirrored_in([left, right + [off, 0.0]], "x") == ("x" if alike else "")


def test_a_moonpool_is_a_ring_of_water_inside():
    outer, inner = buoy(10, 3, panels=120, symmetry=""), buoy(3, 3, panels=60, symmetry="", bottom=False).flipped()
    (pool,) = moonpools(joined([outer, inner]))
    x, y = pool.T
    area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    assert area == pytest.approx(np.pi * 9, rel=0.03) and area > 0
    assert moonpools(outer) == [] and np.hypot(x, y).max() == pytest.approx(3.0, rel=0.03)


def test_points_are_covered_within_a_hull_but_not_in_its_pool():
    ring = joined([box(20, 10, 3, panels=60, symmetry=""), box(6, 4, 3, panels=60, symmetry="").flipped()])
    points = np.array(
        [[9.0, 4.0], [11.0, 0.0], [0.0, 0.0], [2.9, 1.9], [3.1, 1.9], [-9.9, -4.9], [0.0, 5.1], [-20.0, 1.0]]
    )
    assert covered(points, ring).tolist() == [True, False, False, False, True, True, False, False]
    assert covered(points, box(20, 10, 3, panels=60)).tolist() == [True, False, True, True, True, True, False, False]


def test_a_round_hull_covers_what_lies_within_its_sides():
    """Points 4 % within and beyond the polygon's radius, all round"""
    hull = buoy(10, 3, panels=400, symmetry="")
    angle = np.linspace(0.05, 2 * np.pi, 23)
    for radius, inside in ((9.6, True), (10.4, False), (3.0, True)):
        points = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        assert covered(points, hull).tolist() == [inside] * 23
