"""Panels one by one, by the geometry of plane figures."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.panels import PanelMesh, joined, structured
from hakobune.meshing.shapes import box, buoy


def one(*corners, **more):
    return PanelMesh(np.array(corners, float), [[0, 1, 2, 3] if len(corners) == 4 else [0, 1, 2, 2]], **more)


TRAPEZOID = one((5, 1, -2), (9, 1, -2), (8, 4, -2), (6, 4, -2))  # parallel sides 4 and 2 m, 3 m apart


def test_a_trapezoid_has_the_area_and_centroid_of_one():
    """ȳ = h/3 · (a + 2b) / (a + b) from the side a"""
    assert TRAPEZOID.areas == pytest.approx([9.0])
    np.testing.assert_allclose(TRAPEZOID.centroids, [[7, 1 + 4 / 3, -2]])
    np.testing.assert_allclose(TRAPEZOID.normals, [[0, 0, 1]])


def test_the_centroid_of_a_kite_lies_on_the_side_of_its_larger_triangle():
    """Triangles of height 1 and 5 over a diagonal: (−1·1/3 + 5·5/3) / 6 from it; whichever corner comes first"""
    corners = [(-1, 0, -9), (0, -1, -9), (1, 0, -9), (0, 5, -9)]
    for first in range(4):
        kite = one(*np.roll(corners, -first, axis=0))
        np.testing.assert_allclose(kite.centroids, [[0, 4 / 3, -9]], atol=1e-12)


def test_a_triangle_has_three_sides_and_its_centroid_at_the_mean_of_its_corners():
    triangle = one((0, 0, -1), (3, 0, -1), (0, 4, -1))
    np.testing.assert_allclose(triangle.edge_lengths, [[3, 5, 0, 4]])
    assert triangle.sizes == pytest.approx([5.0]) and triangle.areas == pytest.approx([6.0])
    np.testing.assert_allclose(triangle.centroids, [[1, 4 / 3, -1]])


def test_a_skew_panel_is_represented_by_its_mean_plane():
    """Corners 0.3 m above and below the plane by turns; the vector area is that of the plane square"""
    skew = one((10, 20, -4.7), (12, 20, -5.3), (12, 22, -4.7), (10, 22, -5.3))
    np.testing.assert_allclose(skew.flat_vertices[0, :, 2], -5.0, rtol=1e-12)
    np.testing.assert_allclose(skew.flat_vertices[0, :, :2], skew.vertices[0, :, :2])
    np.testing.assert_allclose(skew.area_vectors, [[0, 0, 4]], atol=1e-12)


def test_a_hull_says_its_panels_its_wetted_area_and_its_volume():
    """100 · 50 + 2 (100 + 50) 10 m²"""
    hull = box(100, 50, 10, counts=(5, 2, 3))
    assert repr(hull) == "<PanelMesh 124 panels, 8000 m² wetted, 50000 m³>"
    assert (hull.copies, replace(hull, symmetry="x").copies, replace(hull, symmetry="").copies) == (4, 2, 1)


def test_a_hull_moved_out_of_a_mirror_plane_is_written_out():
    hull = box(10, 6, 2, panels=40)
    half = replace(replace(hull, symmetry="y").whole(), symmetry="x")
    assert half.moved(dy=3).symmetry == "x" and half.moved(dz=-1).symmetry == "x" and half.moved(dx=1).symmetry == ""
    assert hull.moved(dy=3).symmetry == "" and hull.moved(dy=3).total == hull.total
    np.testing.assert_allclose(
        hydrostatics(hull.moved(dx=4, dy=3, dz=0.5).clipped()).center_of_buoyancy, (4, 3, -0.75), rtol=1e-12
    )


def test_a_quarter_turn_takes_x_to_y_and_y_to_minus_x():
    turned = one((1, 2, -3), (2, 2, -3), (2, 3, -3), (1, 3, -3)).rotated(np.pi / 2)
    np.testing.assert_allclose(turned.vertices, [[(-2, 1, -3), (-2, 2, -3), (-3, 2, -3), (-3, 1, -3)]], atol=1e-12)
    np.testing.assert_allclose(turned.normals, [[0, 0, 1]], atol=1e-12)


def test_a_hull_of_revolution_about_the_origin_is_round_also_as_files_round_it():
    quarter = buoy(3.0, 2.0, panels=96)
    filed = replace(quarter.whole(), points=np.round(quarter.whole().points, 5))
    moved, square = quarter.whole().moved(dx=1e-3), box(3.0, 3.0, 1.0, panels=48)
    assert [mesh.is_round for mesh in (quarter, filed, moved, square)] == [True, True, False, False]


def test_a_model_to_scale_has_the_cube_of_the_volume():
    hull = box(10, 6, 2, panels=40)
    assert hull.scaled(3.0).volume == pytest.approx(27 * 120)
    assert hull.scaled((1, 2, 0.5)).volume == pytest.approx(120) and hull.scaled((1, 2, 0.5)).draft == 1.0
    assert hull.scaled(3.0).symmetry == "xy"


def test_the_draft_is_that_of_points_that_panels_have():
    assert replace(TRAPEZOID, points=np.vstack([TRAPEZOID.points, [0, 0, -50]])).draft == 2.0


def test_a_half_is_mirrored_and_what_lies_on_both_sides_is_not():
    half = one((0, 1, -1), (2, 1, -1), (2, 3, -1), (0, 3, -1))
    assert half.mirrored("y").symmetry == "y" and half.mirrored("y").mirrored("x").symmetry == "xy"
    assert half.moved(dy=-4).mirrored("y").total == 2  # all on the other side
    for hull, axis in ((half.moved(dx=-1), "x"), (half.moved(dy=-2), "y"), (half.mirrored("y"), "y")):
        with pytest.raises(ValueError, match=f"already lies on both sides of {axis} = 0"):
            hull.mirrored(axis)
    assert half.moved(dx=-1).mirrored("y").symmetry == "y"


def test_a_panel_that_the_surface_cuts_keeps_what_is_below():
    """A kite from z = −3 to 1, 2 m wide at −1: 4 m² about z = −1, less a triangle of 1/2 m² about 1/3"""
    kite = one((0, 7, -3), (1, 7, -1), (0, 7, 1), (-1, 7, -1)).clipped()
    assert kite.areas.sum() == pytest.approx(3.5)
    assert kite.areas @ kite.centroids[:, 2] == pytest.approx(-4 - 1 / 6)
    np.testing.assert_allclose(kite.normals, np.tile([0, -1, 0], (len(kite), 1)), atol=1e-12)
    assert kite.points[:, 2].max() == 0.0 and sorted(kite.points[kite.points[:, 2] == 0, 0]) == [-0.5, 0.5]


@pytest.mark.parametrize(
    "corners, area",
    [
        ([(0, 0, -1), (4, 0, -1), (4, 0, 3), (0, 0, 3)], 4.0),  # two below: 4 x 1
        ([(0, 0, -1), (3, 0, 2), (0, 0, 5), (-3, 0, 2)], 1.0),  # one below: 2 x 1 / 2
        ([(0, 0, -1), (4, 0, -1), (2, 0, 1)], 3.0),  # of a triangle: from 4 to 2 m
        ([(0, 0, 1), (2, 0, -1), (-2, 0, -1)][::-1], 3.0),
        ([(0, 0, -1), (4, 0, -1), (4, 0, 0), (0, 0, 0)], 4.0),  # up to the surface
        ([(0, 0, -1), (4, 0, 0), (0, 0, 1)], 2.0),  # through a corner
    ],
)
def test_areas_below_the_surface(corners, area):
    clipped = one(*corners).clipped()
    assert clipped.areas.sum() == pytest.approx(area) and clipped.vertices[..., 2].max() == 0.0


def test_a_wall_that_stands_out_of_the_water_is_cut_to_a_box_whose_points_are_shared():
    tall = box(10, 6, 5, counts=(3, 2, 4), grading=False).moved(dz=1.7)
    cut = tall.clipped()
    assert cut.volume == pytest.approx(10 * 6 * 3.3, rel=1e-12) and cut.symmetry == "xy" and cut.name == tall.name
    assert np.ptp(hydrostatics(cut).volumes) < 1e-9 and len(np.unique(cut.points.round(9), axis=0)) == len(cut.points)
    with pytest.raises(ValueError, match="has no part below z = 0; its lowest point is at 1 m; move it down to"):
        tall.moved(dz=4.3).clipped()


def test_points_nearer_than_the_tolerance_are_one():
    corners = [(0, 0, -1), (10, 0, -1), (10, 10, -1), (0, 10, -1)]
    for away, points in ((2e-4, 4), (2e-2, 5)):
        loose = PanelMesh([*corners, (10 + away, 10, -1)], [[0, 1, 2, 3], [1, 4, 2, 2]])
        assert len(loose.merged(1e-3 / 10).points) == points  # 1e-3 m of 10 m


def test_meshes_are_joined_with_the_points_that_they_share():
    left, right = (
        one((0, 0, -1), (1, 0, -1), (1, 1, -1), (0, 1, -1)),
        one((1, 0, -1), (2, 0, -1), (2, 1, -1), (1, 1, -1)),
    )
    pair = joined([left, right, right.moved(dx=1)])
    assert len(pair) == 3 and len(pair.points) == 8
    np.testing.assert_allclose(np.sort(pair.centroids[:, 0]), (0.5, 1.5, 2.5))
    with pytest.raises(ValueError, match="different symmetry"):
        joined([left, replace(right, symmetry="x")])


def test_a_grid_faces_the_side_from_which_its_axes_turn_to_the_left():
    x, y = np.meshgrid([0.0, 1.0, 3.0], [0.0, 2.0], indexing="ij")
    grid = structured(np.stack([x, y, 0 * x - 1], axis=-1))
    np.testing.assert_allclose(grid.area_vectors, [[0, 0, 2], [0, 0, 4]])


def test_what_is_no_mesh_is_named():
    with pytest.raises(ValueError, match="symmetry is 'z'"):
        one((0, 0, 0), (1, 0, 0), (1, 1, 0), symmetry="z")
    PanelMesh(np.zeros((3, 3)), [[0, 1, 2, 2]])
    with pytest.raises(ValueError, match="names point 3, but the mesh has points 0 to 2"):
        PanelMesh(np.zeros((3, 3)), [[0, 1, 2, 3]])
    with pytest.raises(ValueError, match="the mesh has points 0 to 2"):
        PanelMesh(np.zeros((3, 3)), [[0, 1, 2, -1]])


def test_no_panels_are_no_round_hull():
    assert not PanelMesh(np.zeros((0, 3)), np.zeros((0, 4), int)).is_round


def test_points_on_the_axis_alone_are_no_round_hull():
    """Nor a warning: there is no radius to divide by"""
    assert not PanelMesh(np.outer([0.0, 1.0, 2.0], [0.0, 0.0, -1.0]), [[0, 1, 2, 2]]).is_round


def test_numbers_of_bodies_may_be_a_list_one_for_each_panel():
    corners = [[0, 1, 2, 2], [0, 2, 3, 3]]
    mesh = PanelMesh(np.eye(4, 3), corners, body=[0, 1])
    assert mesh.body.tolist() == [0, 1] and mesh.body.dtype == np.int64
    with pytest.raises(ValueError, match=r"body has shape \(3,\); allowed: \(2,\), one for each panel"):
        PanelMesh(np.eye(4, 3), corners, body=[0, 1, 1])


def test_a_cut_close_to_an_edge_leaves_no_sliver():
    """Of a triangle with an edge of 2 m at 1.1e-9 m depth a strip of 2.2e-9 m² is wet, below 1e-9 edge²"""
    sliver = one((-1, 0, -1.1e-9), (1, 0, -1.1e-9), (0, 0, 1))
    wall = one((-1, 1, -1), (1, 1, -1), (1, 1, 0), (-1, 1, 0))
    assert joined([sliver, wall]).clipped().areas == pytest.approx([2.0])
    strip = one((-1, 0, -1e-6), (1, 0, -1e-6), (0, 0, 1))
    assert joined([strip, wall]).clipped().areas.sum() == pytest.approx(2.0 + 2e-6, abs=1e-9)


def test_a_bottom_of_panels_of_its_own_is_a_bottom_also_where_it_is_not_quite_level():
    """A box of 4 x 2 x 1 m whose bottom is one panel below walls of two: within a millionth of the draft it closes
    them, and nothing is added to its volume; without it the foot of the walls is closed, to the same volume"""
    rim = np.array([(2, 1), (0, 1), (-2, 1), (-2, -1), (0, -1), (2, -1)], float)
    walls = [one((*a, 0), (*b, 0), (*b, -1), (*a, -1)) for a, b in zip(np.roll(rim, -1, axis=0), rim, strict=True)]
    bottom = one((2, 1, -1), (2, -1, -1), (-2, -1, -1), (-2, 1, -1 - 5e-7))
    closed = joined([*walls, bottom])
    assert closed.foot is None and closed.volume == pytest.approx(8.0, rel=1e-6)
    assert joined(walls).foot is not None and joined(walls).volume == pytest.approx(8.0)
