"""Panels that water reaches: drawings with copies, inner walls, folds, cavities and parts that touch."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.files import read_mesh
from hakobune.meshing.panels import PanelMesh, joined
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.outer import outer, wet
from hakobune.meshing.quality.outward import outward
from hakobune.meshing.shapes import box
from hakobune.pipelines.view.changing import change

HULL = box(8, 4, 2, counts=(2, 1, 1), symmetry="")  # 64 m³


def errors(mesh):
    return [found.text for found in findings(mesh) if found.severity == "error"]


def wall(*corners):
    return PanelMesh(corners, [[0, 1, 2, 3]])


def both_ways(mesh):
    return joined([mesh, mesh.flipped()])


BULKHEAD = wall((0, -2, -2), (0, 0, -2), (0, 0, 0), (0, -2, 0)), wall((0, 0, -2), (0, 2, -2), (0, 2, 0), (0, 0, 0))
FIN = wall((4, 0, -2), (5, 0, -2), (5, 0, 0), (4, 0, 0))
BROKEN = {
    "copies": (joined([HULL, replace(HULL, corners=HULL.corners[3:9])]), f"6 of {len(HULL) + 6} panels present twice"),
    "inner walls": (joined([HULL, *BULKHEAD]), "have the body on both sides"),
    "inner walls drawn from both sides": (joined([HULL, *map(both_ways, BULKHEAD)]), "present twice"),
    "folds": (joined([HULL, both_ways(FIN)]), "present twice"),
    "cavity": (joined([HULL, HULL.scaled(0.5).moved(dz=-0.5).flipped()]), "the inner one, which no water reaches"),
    "body in body": (joined([HULL, HULL.scaled(0.5).moved(dz=-0.5)]), "the inner one, which no water reaches"),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_what_no_water_reaches_is_told_and_left_out(kind):
    mesh, words = BROKEN[kind]
    (told,) = [text for text in errors(mesh) if words in text]
    assert "`hakobune mesh --outer`" in told
    left = outer(mesh)
    assert errors(left) == [] and len(left) == len(HULL) and left.volume == pytest.approx(64.0)


def test_a_fold_is_told_by_the_water_on_both_of_its_sides():
    """A fin of 1 m drawn as two sheets whose panels differ: one of a square, one of two triangles"""
    points = [(4, 0, -2), (5, 0, -2), (5, 0, 0), (4, 0, 0)]
    fin = joined([PanelMesh(points, [[0, 1, 2, 3]]), PanelMesh(points, [[2, 1, 0, 0], [3, 2, 0, 0]])])
    (told,) = errors(joined([HULL, fin]))
    assert "edges with more than two panels" in told and "2 have water on both sides" in told
    assert outer(joined([HULL, fin])).volume == pytest.approx(64.0)


@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_parts_that_touch_along_an_edge_are_sound(turn):
    """Two boxes whose corners meet in a vertical edge: of four panels there each has water on one side"""
    both = joined([HULL, HULL.moved(dx=8, dy=4)]).rotated(turn)
    assert errors(both) == [] and both.volume == pytest.approx(128.0)
    assert len(outer(both)) == len(both)


def test_walls_of_two_parts_that_lie_on_each_other_are_no_water():
    """The second box is cut otherwise, so that no corner of its wall is one of the first's but the outermost"""
    other = box(8, 3.5, 1.5, counts=(2, 2, 2), symmetry="").moved(dx=8)
    assert any("two parts of the hull overlap" in text for text in errors(joined([HULL, other])))


def test_a_quarter_stays_a_quarter():
    quarter = box(8, 4, 2, counts=(2, 2, 2), symmetry="xy")
    inner = quarter.scaled(0.5).moved(dz=-0.5)
    left = outer(joined([quarter, inner]))
    assert left.symmetry == "xy" and len(left) == len(quarter) and left.volume == pytest.approx(64.0)


def test_one_part_of_two_that_faces_inward_is_turned_and_not_the_other():
    pair = joined([HULL, HULL.moved(dx=20)])
    broken = joined([HULL, HULL.moved(dx=20).flipped()])
    assert any(f"{len(HULL)} of {2 * len(HULL)} panels point into the body" in text for text in errors(broken))
    np.testing.assert_allclose(outward(broken).area_vectors, pair.area_vectors, atol=1e-12)
    np.testing.assert_allclose(outward(outward(broken)).area_vectors, -pair.area_vectors, atol=1e-12)


def test_a_drawing_that_begins_at_the_surface_keeps_its_bottom_whichever_way_it_faces(tmp_path):
    """A closed box of 2 m between z = 0 and 1, inside out: once moved down by 0.5 m it has 2 m³ and its bottom"""
    points = [[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 1)]
    panels = [[1, 5, 7, 3], [0, 2, 6, 4], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]]
    lines = [f"v {x} {y} {z}" for x, y, z in points] + ["f " + " ".join(str(n + 1) for n in row) for row in panels]
    (tmp_path / "box.obj").write_text("\n".join(lines))
    (tmp_path / "in.obj").write_text(
        "\n".join([*lines[:8], *("f " + " ".join(line.split()[:0:-1]) for line in lines[8:])])
    )
    for name, sign in (("box.obj", 1), ("in.obj", -1)):
        below = read_mesh(tmp_path / name).moved(dz=-0.5).clipped()
        assert below.volume == pytest.approx(sign * 2.0) and below.foot is None


def test_a_deck_a_digit_of_float32_below_the_surface_is_left_out_by_a_cut():
    """A ship of 60 000 mm whose deck is drawn 1.5e-4 mm too deep, as single precision stores it"""
    hull = HULL.scaled(7500.0)
    deck = wall((-30000, -15000, 0), (30000, -15000, 0), (30000, 15000, 0), (-30000, 15000, 0)).moved(dz=-1.5e-4)
    assert len(joined([hull, deck]).clipped()) == len(hull)


def test_mesh_outer_writes_what_water_reaches(tmp_path, capsys):
    from hakobune.meshing.files import write_mesh

    write_mesh(BROKEN["inner walls"][0], tmp_path / "drawn.gdf")
    assert change(tmp_path / "drawn.gdf", tmp_path / "as_is.gdf") == 1
    assert change(tmp_path / "drawn.gdf", tmp_path / "wet.gdf", outer=True) == 0
    assert "64 m³" in capsys.readouterr().out
    assert len(read_mesh(tmp_path / "wet.gdf")) == len(HULL)


def test_up_to_three_tenths_is_water_and_from_six_tenths_is_the_body():
    assert wet(np.array([[0.29, 0.31, 0.29, 1.0], [0.61, 1.0, 0.59, 0.0]])).tolist() == [True, False, False, True]
