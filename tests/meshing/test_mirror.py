"""Mirror planes found in meshes that were written out whole."""

import numpy as np
import pytest

from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import PanelMesh
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
