"""Where several panels are wrong in different degrees a finding counts all of them and tells the worst; numbers, words
and files of meshes at their limits."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing import drawing, files, text_formats
from hakobune.meshing.panels import PanelMesh, structured
from hakobune.meshing.quality.findings import _position, _resolution, _shapes, lid_findings
from hakobune.meshing.shapes import box


def said(generator):
    return [one.text for one in generator]


def square(x=0.0, y=0.0, z=-5.0, size=1.0, lift=0.0):
    """Corners of a square that faces down, those of one diagonal lifted"""
    return [(x, y + size, z), (x + size, y + size, z + lift), (x + size, y, z), (x, y, z + lift)]


def mesh(*squares, symmetry=""):
    return PanelMesh(np.concatenate(squares), np.arange(4 * len(squares)).reshape(-1, 4), symmetry)


def test_the_most_twisted_panel_is_told_of_all_that_are():
    """Corners ± e/2 off the mean plane of an edge √(1 + e²)"""
    e = np.array([0.3, 0.5, 0.4, 0.0])
    made = mesh(*(square(3.0 * i, lift=one) for i, one in enumerate(e)))
    share = 100 * (0.5 * 0.5 / math.sqrt(1.25))
    (line,) = said(_shapes(made))
    assert line.startswith(
        f"3 of 4 panels not flat, corners off the plane by up to {share:.3g} % of the longest edge, "
    )


def test_the_longest_panel_is_told_of_all_that_are_long():
    def long(x, length):
        return [(x, length, -5.0), (x + 1, length, -5.0), (x + 1, 0, -5.0), (x, 0, -5.0)]

    (line,) = said(_shapes(mesh(long(0, 150.0), long(3, 400.0), long(6, 90.0), long(9, 200.0))))
    assert line.startswith("3 of 4 panels with an aspect ratio up to 400, good: ≤ 100;")


def test_the_highest_panel_above_the_water_is_told_and_the_farthest_across_a_mirror_plane():
    made = mesh(square(z=2.0), square(z=7.0), square(z=-3.0), square(z=4.0))
    (line,) = said(_position(made))
    assert line.startswith("3 of 4 panels above the water, up to z = 7 m; allowed: z ≤ 0;")
    made = mesh(square(x=-2.0), square(x=-7.0, y=1.0), square(x=3.0, y=-0.5), symmetry="xy")
    across, other = said(_position(made))
    assert across.startswith("2 of 3 panels across the mirror plane x = 0, down to x = -7 m; allowed: x ≥ 0;")
    assert other.startswith("1 of 3 panels across the mirror plane y = 0, down to y = -0.5 m; allowed: y ≥ 0;")


@pytest.mark.parametrize("wave, told", [(3 * 1.999, 2), (3 * 2.0, 1), (3 * 4.0, 0), (None, 0)])
def test_the_longest_panel_is_told_for_the_waves(wave, told):
    made = mesh(square(), square(x=9.0, size=2.0), square(x=20.0, size=4.0))
    lines = said(_resolution(made, wave))
    assert len(lines) == bool(told)
    if told:
        assert lines[0].startswith(
            f"{told} of 3 panels up to 4 m long, coarse for the wave length {wave:.4g} m; good: ≤ "
        )


def test_a_lid_is_off_the_surface_by_its_farthest_corner_and_looks_up():
    hull = box(10, 8, 4, counts=(2, 2, 2), symmetry="")
    top = [(-5, -4, 0.25), (5, -4, -0.75), (5, 4, 0.5), (-5, 4, 0.0)]
    wrong = said(lid_findings(hull, PanelMesh(np.array(top[::-1], float), [[0, 1, 2, 3]], "x")))
    assert wrong[0] == "the lid is 0.75 m off the water surface; allowed: z = 0"
    assert wrong[1] == "the lid has normals that point down; allowed: up"
    assert wrong[2] == "the lid has the symmetry 'x', the hull ''"
    flat = np.array(top) * (1, 1, 0)
    assert said(lid_findings(hull, PanelMesh(flat, [[0, 1, 2, 3]]))) == []
    assert said(lid_findings(hull, None)) == []


@pytest.mark.parametrize("word, value", [
    ("1.5", 1.5), ("1.5,", 1.5), ("2D3", 2000.0), ("2d-3", 0.002), ("-4E1", -40.0), ("+.5", 0.5),
])  # fmt: skip
def test_numbers_are_read_as_fortran_writes_them(word, value):
    assert text_formats._number("f", 3, word) == value


@pytest.mark.parametrize("word, shown", [
    ("x" * 40, "x" * 40), ("x" * 41, "x" * 40 + "…"), ("nan", "nan"), ("inf", "inf"), ("1,5", "1,5"),
])  # fmt: skip
def test_a_word_that_is_no_number_is_shown_with_its_line(word, shown):
    with pytest.raises(ValueError) as refused:
        text_formats._number("f", 3, word)
    assert str(refused.value) == f"f, line 3: {shown!r} is not a finite number"


@pytest.mark.parametrize("gravity, unit", [(9.71, 1.0), (9.89, 1.0), (31.81, 0.3048), (32.49, 0.3048), (9.69, None),
                                           (9.91, None), (31.79, None), (32.51, None)])  # fmt: skip
def test_a_unit_of_length_follows_from_gravity(gravity, unit):
    if unit is not None:
        assert text_formats.length_unit("f", gravity) == unit
        return
    with pytest.raises(ValueError, match=r"GRAV is .*; allowed: 9.80665 \(metres\) or 32.174 \(feet\)"):
        text_formats.length_unit("f", gravity)


@pytest.mark.parametrize("flags, planes", [((0, 0), ""), ((1, 0), "x"), ((0, 1), "y"), ((1, 1), "xy"), ((2, 0), None),
                                           ((0, -1), None)])  # fmt: skip
def test_flags_of_mirror_planes_are_0_or_1(flags, planes):
    if planes is not None:
        assert text_formats._symmetry("f", 3, flags) == planes
        return
    with pytest.raises(ValueError, match=rf"f, line 3: symmetry {flags[0]} {flags[1]}; allowed: 0 or 1 each"):
        text_formats._symmetry("f", 3, flags)


def test_panels_by_number_repeat_the_last_corner_of_a_triangle_and_name_a_point_that_is_not_there():
    numbers = {7.0: 0, 8.0: 1, 9.0: 2, 4.0: 3}
    assert text_formats._panel("f", 3, [7, 9, 8, 4, 99], numbers) == [0, 2, 1, 3]
    assert text_formats._panel("f", 3, [7, 9, 8], numbers) == [0, 2, 1, 1]
    for row, says in (([7, 9], "f, line 3 has 2 nodes; a panel has 3 or 4"),
                      ([7, 9, 5], "f, line 3: there is no point 5; the file has 4")):  # fmt: skip
        with pytest.raises(ValueError) as refused:
            text_formats._panel("f", 3, row, numbers)
        assert str(refused.value) == says


@pytest.mark.parametrize("size, cut", [(83, False), (84, True), (133, True), (134, False), (200, False)])
def test_a_binary_stl_is_as_long_as_its_header_says(tmp_path, size, cut):
    """80 bytes, a count and 50 bytes for each triangle: one triangle are 134 bytes"""
    path = tmp_path / "a.STL"
    path.write_bytes((b"h" * 80 + (1).to_bytes(4, "little") + b"t" * 200)[:size])
    if not cut:
        files._check_head(path)
        return
    with pytest.raises(ValueError) as refused:
        files._check_head(path)
    assert f"its header announces 1 triangles in 134 bytes, but the file has {size} bytes; write or copy" in str(
        refused.value
    )


@pytest.mark.parametrize("name, content, good", [
    ("a.ply", b"ply\nend_header\n", True), ("a.ply", b"ply\n", False), ("a.off", b"OFF\n3 1 0\n", True),
    ("a.off", b"OFF\n", False), ("a.off", b"OFF\n# 3 1 0\n\n", False), ("a.stl", b"solid\nfacet", True),
])  # fmt: skip
def test_a_head_that_has_no_end_is_refused(tmp_path, name, content, good):
    (tmp_path / name).write_bytes(content)
    if good:
        files._check_head(tmp_path / name)
        return
    with pytest.raises(ValueError, match="it ends within its header; write or copy it again"):
        files._check_head(tmp_path / name)


def test_a_hull_on_the_negative_sides_is_turned_to_the_positive_ones_with_its_normals_outwards():
    quarter = box(10, 8, 4, counts=(2, 2, 2))
    for signs in ((-1, 1), (1, -1), (-1, -1)):
        turned = quarter.corners[:, :: int(np.prod(signs))]
        other = PanelMesh(quarter.points * (*signs, 1), turned, "xy")
        back = files._on_positive_side(other)
        assert back.points.min(axis=0)[:2].tolist() == [0, 0] and back.volume == pytest.approx(quarter.volume)
    assert files._on_positive_side(quarter) is quarter


def test_points_within_four_thousandths_of_a_usual_edge_are_put_into_the_surface():
    """Panels of 1, 2 and 20 m: the median is 2 m"""
    made = mesh(square(z=-0.0079, size=1.0), square(x=5, z=-0.0081, size=2.0), square(x=9, z=0.0079, size=20.0))
    z = files._as_meant(made).points[:, 2]
    assert z.tolist() == [0.0] * 4 + [-0.0081] * 4 + [0.0] * 4


def test_panels_without_area_and_dry_ones_are_left_out_with_their_points():
    up = [(0, 0, 0.0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    made = mesh(square(z=0.0), up, [(5, 0, -1), (6, 0, -1), (7, 0, -1), (7, 0, -1)], square(x=20.0, z=-2.0))
    kept = files.wetted(made)
    assert len(kept) == 2 and len(kept.points) == 8 and kept.points[:, 2].tolist() == [0.0] * 4 + [-2.0] * 4


def test_a_drawing_without_a_cylinder_has_one_try(monkeypatch):
    asked = []
    monkeypatch.setattr(drawing, "_of_volume", lambda *given: asked.append(given) or ("mesh", "body"))
    made = SimpleNamespace(parts=[({"shape": "box"}, 0.0), ({"shape": "sphere"}, 0.0)])
    assert drawing.meshed(made, "b") == "mesh" and asked == [(made, "b", 0.0, 8)]


def test_tries_end_at_the_first_within_the_limits_or_take_the_nearest(monkeypatch):
    off, asked = {}, []

    def of_volume(drawn, name, seam, algorithm):
        asked.append((drawn.around, name, seam, algorithm))
        hull = SimpleNamespace(volume=float(len(asked)))
        return hull, drawing.Drawn(4.0, None, 5.0)

    monkeypatch.setattr(drawing, "_of_volume", of_volume)
    monkeypatch.setattr(drawing, "_off", lambda mesh, body: off[int(mesh.volume)])
    monkeypatch.setattr(drawing, "waterplane_area", lambda mesh: 3.0)
    part = {"shape": "cylinder"}
    drawn = drawing.Drawing(1.0, "", 25, [({"shape": "box"}, 0.0), (part, 0.0)])
    off |= {1: 1.1, 2: 1.0}
    assert drawing.meshed(drawn, "b").volume == 2.0
    half = 0.5 * math.pi
    assert asked == [(25, "b", half, 8), (25, "b", 0.0, 8)]
    asked.clear()
    off |= {1: 3.0, 2: 1.2, 3: 1.4, 4: 9.0}
    with pytest.warns(UserWarning) as told:
        assert drawing.meshed(drawn, "").volume == 2.0
    assert asked == [(25, "", half, 8), (25, "", 0.0, 8), (38, "", half, 8), (25, "", half, 6)]
    assert str(told[0].message) == (
        "drawing: the panels have a volume of 2 m³ and a waterplane of 3 m², but the drawing has 4 m³ and "
        "5 m²; allowed: a difference of up to 3 %, and the same middle; give smaller panels or a larger "
        "`around`"
    )


def test_a_file_of_a_hull_with_its_lid_tells_which_panels_are_the_lid_and_has_no_field_there(tmp_path):
    """Half a box of ten panels and a lid of twelve: fields are those of the hull and its image, nothing on the lid"""
    import meshio

    hull = box(8.0, 4.0, 2.0, counts=(2, 1, 1), grading=False, symmetry="y")
    x, y = np.meshgrid(np.linspace(-4, 4, 7), np.linspace(0, 2, 3), indexing="ij")
    lid = replace(structured(np.stack([x, y, 0 * x], axis=2)), symmetry="y")
    field = np.arange(1.0, len(hull) + 1)
    files._write_vtu(hull, tmp_path / "h.vtu", lid, {"f": field})
    read = meshio.read(tmp_path / "h.vtu")
    marks, values = (np.concatenate(read.cell_data[name]) for name in ("lid", "f"))
    assert len(marks) == 2 * len(hull) + 24 and marks.sum() == 24 and np.isnan(values[marks == 1]).all()
    assert sorted(values[marks == 0]) == sorted([*field, *field])
    files._write_vtu(hull, tmp_path / "h.vtu", None, {"f": field})
    read = meshio.read(tmp_path / "h.vtu")
    assert len(np.concatenate(read.cell_data["f"])) == 2 * len(hull) and not np.concatenate(read.cell_data["lid"]).any()


@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
def test_walls_on_either_side_of_their_mirror_planes_are_closed_by_their_foot(signs):
    walls = box(10, 8, 4, counts=(2, 2, 2), bottom=False)
    made = PanelMesh(walls.points * (*signs, 1), walls.corners[:, :: int(np.prod(signs))], "xy")
    assert made.foot is not None and made.foot.area_vectors[:, 2].sum() == pytest.approx(-20.0)
    assert made.volume == pytest.approx(10 * 8 * 4)


@pytest.mark.parametrize("draft", [0.1, 1.0, 50.0])
@pytest.mark.parametrize("share, dry", [(0.9e-6, False), (1.1e-6, True)])
def test_a_millionth_of_the_draft_above_the_water_is_in_it(draft, share, dry):
    made = mesh(square(z=-draft), square(z=-0.5 * draft))
    points = made.points.copy()
    points[4:, 2] = share * draft
    lines = said(_position(PanelMesh(points, made.corners)))
    assert any("above the water" in line for line in lines) is dry
