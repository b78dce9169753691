"""Mirror planes found in meshes that were written out whole."""

import numpy as np
import pytest

from hakobune.meshing.mirror import folded, healed
from hakobune.meshing.panels import PanelMesh, joined
from hakobune.meshing.shapes import box, buoy


def triangles(mesh):
    """Every panel cut in two, mirror images cut alike"""
    a, b, c, d = mesh.corners.T
    return PanelMesh(mesh.points, np.concatenate([np.stack([a, b, c, c], 1), np.stack([a, c, d, d], 1)]), mesh.symmetry)


@pytest.mark.parametrize("mesh", [box(100, 50, 10, panels=200), buoy(10, 10, panels=200), triangles(box(9, 5, 2))])
@pytest.mark.parametrize("kept", ["", "x", "y"])
def test_a_hull_written_out_is_folded_to_the_part_that_its_images_make_whole(mesh, kept):
    whole = mesh.whole()
    if kept:
        axis = "xy".index(kept)
        whole = PanelMesh(whole.points, whole.corners[whole.centroids[:, axis] > 0], kept)
    part = folded(whole)
    assert part.symmetry == "xy"
    assert 4 * len(part) == part.total == mesh.total
    assert part.volume == pytest.approx(mesh.volume, rel=1e-12)
    assert (
        np.abs((part.copies * part.area_vectors).sum(axis=0)[2] - (mesh.copies * mesh.area_vectors).sum(axis=0)[2])
        < 1e-9
    )


def test_numbers_of_a_text_file_are_exact_enough():
    whole = box(100, 50, 10, panels=200).whole()
    assert folded(PanelMesh(np.round(whole.points, 4), whole.corners)).symmetry == "xy"


def test_a_hull_that_is_no_image_of_itself_stays_whole():
    whole = box(100, 50, 10, panels=200).whole()
    bent = whole.points + np.where(whole.points[:, :1] > 40, [0.0, 0.01, 0.0], 0.0)
    assert folded(PanelMesh(bent, whole.corners)).symmetry == ""
    assert folded(whole.moved(dx=1.0)).symmetry == "y"
    one_turned = whole.corners.copy()
    one_turned[0] = one_turned[0][::-1]
    assert folded(PanelMesh(whole.points, one_turned)).symmetry == ""
    assert folded(PanelMesh(whole.points, whole.corners[1:])).symmetry == ""


def test_a_panel_across_the_plane_is_not_cut():
    one = PanelMesh([[-1, -1, -1], [-1, 1, -1], [1, 1, -1], [1, -1, -1]], [[0, 1, 2, 3]])
    assert folded(one) is one


@pytest.mark.parametrize("share, found", [(0.8e-6, "xy"), (1.2e-6, "y")])
def test_images_within_a_millionth_of_the_length_are_images(share, found):
    """Of 300 m: one end moved down, which changes the area of panels of 15 m by half of that times 15 m"""
    whole = box(300, 30, 3, counts=(10, 1, 1), grading=False).whole()
    end = (whole.points[:, 0] == 150) & (whole.points[:, 2] == 0)
    lower = whole.points - np.where(end[:, None], [0, 0, 300 * share], 0.0)
    assert folded(PanelMesh(lower, whole.corners)).symmetry == found


def test_points_near_a_plane_are_put_on_it():
    whole = box(300, 30, 3, counts=(2, 1, 1), grading=False).whole()
    off = whole.points - np.where(np.abs(whole.points[:, :1]) < 1, [1e-4, 0, 0], 0.0)
    part = folded(PanelMesh(off, whole.corners))
    assert part.symmetry == "xy" and part.points[:, :2].min() == 0.0
    assert np.sum(part.points[:, 0] == 0.0) == 3  # keel, bilge and waterline of the plane


def test_points_off_by_less_than_the_tolerance_are_healed():
    """A box of panels with corners of their own, each 0.01 mm off: the box again, which folds to a quarter"""
    whole = box(10.0, 6.0, 2.0, panels=64).whole()
    loose = whole.points[whole.corners].reshape(-1, 3)
    loose = loose + 1e-5 * np.sin(np.arange(loose.size)).reshape(-1, 3)
    found = healed(PanelMesh(loose, np.arange(len(loose)).reshape(-1, 4)), 1e-4)
    assert len(found.points) == len(whole.merged().points) and folded(found, 1e-5).symmetry == "xy"
    assert found.volume == pytest.approx(120.0, rel=1e-5)
    down = whole.rotated(np.pi, "x")  # drawn with z down: the same box above the water
    assert down.points[:, 2].min() == pytest.approx(0.0, abs=1e-12) and down.volume == pytest.approx(120.0)


def test_plates_that_lie_in_the_plane_of_symmetry_are_on_no_side_of_it():
    """A thin skeg below the keel, each of its sides a thousandth of a millimetre off the plane y = 0"""
    hull = box(100, 50, 10, panels=200).whole()
    corners = np.array([[0, -10], [0, -12], [20, -12], [20, -10], [-20, -12], [-20, -10]], float)
    sides = [np.insert(corners, 1, y, axis=1) for y in (1e-6, -1e-6)]
    panels = np.array([[0, 1, 2, 3], [5, 4, 1, 0]])
    skeg = PanelMesh(np.concatenate(sides), np.concatenate([panels, panels[:, ::-1] + 6]))
    assert folded(joined([hull, skeg])).symmetry == "x"
    apart = PanelMesh(skeg.points * [1, 1e3, 1], skeg.corners)  # by a millimetre there are two sides
    assert folded(joined([hull, apart])).symmetry == "xy"
