"""Hulls whose panels lie side to side without sharing corners: closed, as their volumes say."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.files import read_mesh, write_mesh
from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.panels import PanelMesh, joined, structured
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.seams import _divided, _pairs, _Ring, rings
from hakobune.meshing.shapes import box, buoy


def plate(corners, n, m):
    """n x m panels of a plane quadrilateral (4, 3), counter-clockwise seen from the water"""
    u, v = np.linspace(0, 1, n + 1)[:, None, None], np.linspace(0, 1, m + 1)[None, :, None]
    a, b, c, d = np.asarray(corners, float)
    return structured((1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d)


def five_faces(counts, shift=0.0):
    """A box of 20 x 10 x 4 m from five plates, each with its own counts of panels"""
    x, y, z = 10.0, 5.0, -4.0
    low = [(x, y, z), (x, -y, z), (-x, -y, z), (-x, y, z)]
    faces = [low]
    for one, two in zip(low, low[1:] + low[:1], strict=True):
        faces.append([two, one, (*one[:2], 0.0), (*two[:2], 0.0)])
    made = []
    for face, (n, m) in zip(faces, counts, strict=True):
        part = plate(face, n, m)
        out = part.centroids[0] - np.array([0, 0, -2.0])
        made.append(part if part.normals[0] @ out > 0 else part.flipped())
    return joined(made).moved(shift)


COUNTS = [(7, 5), (3, 2), (6, 3), (4, 2), (5, 1)]


@pytest.mark.parametrize("shift", [0.0, 40.0])
def test_a_box_of_plates_with_different_panels_is_closed_wherever_it_lies(shift):
    hull = five_faces(COUNTS, shift)
    still = hydrostatics(hull)
    assert still.volumes == pytest.approx([800.0] * 3)
    (found,) = findings(hull)
    assert found.severity == "warning" and "without sharing corners along" in found.text
    # all edges of the bottom, 2 (20 + 10) m, and of the upright ones of 4 m all but one, between 2 and 2 panels
    assert " m in all, up to" in found.text and float(found.text.split(" edges, ")[1].split(" m")[0]) <= 76


def test_one_panel_that_is_missing_is_a_hole_beside_the_seams():
    hull = five_faces(COUNTS)
    holed = replace(hull, corners=hull.corners[1:])
    said = [str(finding) for finding in findings(holed)]
    assert said[0].startswith("error: the hull is open along")


def test_plates_turned_inside_out_are_told_and_plates_that_are_right_are_not():
    hull = five_faces(COUNTS, 40.0)
    assert "normals" not in " ".join(map(str, findings(hull)))
    assert "the normals of 72 of 72 panels" in str(findings(hull.flipped())[0])


def test_chords_of_unequal_length_leave_their_sagittas_and_no_hole():
    """Bottom of 12 sides, wall of 24: 12 slits, each R(1 − cos 15°) wide in its middle, 3.4 % of R"""
    fine, coarse = np.arange(25) * np.pi / 12, np.arange(13) * np.pi / 6
    ring = np.stack([10 * np.cos(fine), 10 * np.sin(fine), 0 * fine], axis=1)
    wall = structured(np.stack([ring + [0, 0, -4], ring], axis=1))
    rim = np.stack([10 * np.cos(coarse), 10 * np.sin(coarse), 0 * coarse - 4], axis=1)
    bottom = structured(np.stack([0.5 * rim * [1, 1, 0] + [0, 0, -4], rim], axis=1))
    inner = structured(np.stack([0 * rim + [0, 0, -4], 0.5 * rim * [1, 1, 0] + [0, 0, -4]], axis=1))
    parts = [part if part.normals[0] @ side > 0 else part.flipped()
             for part, side in ((wall, ring[0]), (bottom, (0, 0, -1)), (inner, (0, 0, -1)))]  # fmt: skip
    hull = joined(parts).merged(1e-9)
    errors = [finding for finding in findings(hull) if "open" in finding.text or "normals" in finding.text]
    assert not errors
    assert any("without sharing corners" in finding.text for finding in findings(hull))


@pytest.mark.parametrize("size", [10.0, 2000.0, 0.02])
def test_rims_of_12_and_15_sides_with_no_corner_in_common_are_a_seam_and_an_open_tube_is_not(size):
    """Whatever the length of their sides"""

    def rim(sides, turn=0.0):
        angle = np.arange(sides + 1) * 2 * np.pi / sides + turn
        return size * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)

    down = [0, 0, -0.4 * size]
    wall = structured(np.stack([rim(15, 0.1) + down, rim(15, 0.1)], axis=1))
    bottom = structured(np.stack([0 * rim(12) + down, rim(12) + down], axis=1))
    wall = wall if wall.normals[0] @ wall.centroids[0] > 0 else wall.flipped()
    bottom = bottom if bottom.normals[0, 2] < 0 else bottom.flipped()
    closed = [str(finding) for finding in findings(joined([wall, bottom]).merged(1e-9))]
    assert any("without sharing corners along 27 edges" in text for text in closed)
    assert not any(text.startswith("error") for text in closed)
    tube = [str(finding) for finding in findings(wall.merged(1e-9))]
    assert tube[0].startswith("error: the hull is open along 15 edges")


def test_a_seam_across_a_mirror_plane_is_closed_by_its_image():
    """The half y ≥ 0 of a box, its bottom finer than its sides"""
    bottom = plate([(10, 5, -4), (10, 0, -4), (-10, 0, -4), (-10, 5, -4)], 3, 7)
    side = plate([(-10, 5, -4), (10, 5, -4), (10, 5, 0), (-10, 5, 0)], 4, 2)
    ends = [plate([(s * 10, 0, -4), (s * 10, 5, -4), (s * 10, 5, 0), (s * 10, 0, 0)], 2, 2) for s in (-1, 1)]
    parts = [part if part.normals[0] @ (part.centroids[0] - [0, 0, -2]) > 0 else part.flipped()
             for part in (bottom, side, *ends)]  # fmt: skip
    half = replace(joined(parts), symmetry="y")
    assert hydrostatics(half).volume == pytest.approx(800.0)
    assert [finding.severity for finding in findings(half)] == ["warning"]


@pytest.mark.parametrize("symmetry", ["y", "xy"])
@pytest.mark.parametrize("ending", [".gdf", ".pnl"])
def test_a_half_on_the_negative_side_is_the_same_hull(ending, symmetry, tmp_path):
    hull = box(20, 10, 4, panels=60)
    half = PanelMesh(hull.points, hull.corners, "x").whole() if symmetry == "y" else hull
    half = PanelMesh(half.points, half.corners, symmetry)
    mirrored = half.points.copy()
    for axis in symmetry:
        mirrored[:, "xy".index(axis)] *= -1
    turned = half.corners if len(symmetry) == 2 else half.corners[:, ::-1]
    write_mesh(PanelMesh(mirrored, turned, symmetry), tmp_path / f"other{ending}")
    found = read_mesh(tmp_path / f"other{ending}")
    assert found.volume == pytest.approx(800.0) and not findings(found)


def gdf(hull, remark="", tail=""):
    lines = ["a hull", "1.0 9.80665 ULEN GRAV", "1 1 ISX ISY", f"{len(hull)} NPAN"]
    for number, panel in enumerate(hull.vertices, 1):
        rows = [" ".join(f"{x:.6f}" for x in corner) for corner in panel]
        rows[-1] += remark.format(number)
        lines += rows
    return "\n".join([*lines, tail])


@pytest.mark.parametrize(
    ("remark", "tail"), [("   {}", "0   NPAND"), ("", "0"), ("  panel {}", ""), ("", "end of the file")]
)
def test_a_gdf_is_read_as_fortran_reads_lists(remark, tail, tmp_path):
    hull = buoy(5, 3, panels=40)
    (tmp_path / "a.gdf").write_text(gdf(hull, remark, tail))
    found = read_mesh(tmp_path / "a.gdf")
    assert found.volume == pytest.approx(hull.volume, rel=1e-5) and len(found) == len(hull)


def test_dipole_panels_are_refused_by_name(tmp_path):
    hull = buoy(5, 3, panels=40)
    (tmp_path / "a.gdf").write_text(gdf(hull, tail="3 NPAND\n0 0 0 1 0 0 1 1 0 0 1 0"))
    line, count = 5 + 4 * len(hull), len(hull)  # after the header and a line for each corner
    told = rf"a.gdf, line {line}: '3 NPAND' follows the {count} panels: either dipole panels \(NPAND"
    with pytest.raises(ValueError, match=told):
        read_mesh(tmp_path / "a.gdf")


def test_two_rings_on_a_border_are_rings_of_their_own():
    """A straight border 0 → 1 → 6 with the rings 1 → 2 → 3 → 1 and 1 → 4 → 5 → 1, right triangles of 3, 4 and 5 m

    The second turns back at 1, the first turns aside there, and both are left before the border goes on.
    """
    points = np.array([[-2, 0, 0], [0, 0, 0], [0, 3, 0], [4, 3, 0], [-3, 0, 0], [-3, -4, 0], [2, 0, 0.0]])
    start, end = np.array([0, 1, 2, 3, 1, 4, 5, 1]), np.array([1, 2, 3, 1, 4, 5, 1, 6])
    found = rings(points, start, end)
    assert len(found.length) == 3 and sorted(found.length.tolist()) == [4.0, 12.0, 12.0]
    assert found.number[0] == found.number[7] and len(set(found.number[1:4])) == len(set(found.number[4:7])) == 1
    closed = found.area[[found.number[1], found.number[4]]]
    assert closed == pytest.approx([6.0, 6.0])


def test_a_ring_that_an_image_closes_has_half_of_its_length_and_area():
    """A rhombus of 3 and 4 m about y = 0: four sides of 5 m and 24 m², two of them and 12 m² on either side"""
    points = np.array([[-3, 0, 0], [0, 4, 0], [3, 0, 0.0]])
    found = rings(points, np.array([0, 1]), np.array([1, 2]), "y")
    assert found.length == pytest.approx([10.0]) and found.area == pytest.approx([12.0])


def test_an_inward_hull_of_plates_beside_an_outward_one_is_found():
    """Parts hang together by their own seams alone"""
    one = five_faces(COUNTS)
    said = [str(finding) for finding in findings(joined([one, one.moved(dy=30.0).flipped()]))]
    assert said[0].startswith("error: the normals of 72 of 144 panels point into the body (volume -800 m³)")


def test_rims_that_close_each_other_are_found_among_all_that_are_open():
    """Two squares, two others a tenth above them that run the other way round, and one far away"""
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])

    def rim(x, z, up):
        return _Ring(
            [], 1.0, (square if up else square[::-1]) + [x, 0.0, z], np.array([0, 0, 1.0 if up else -1.0]), 4.0
        )

    found = [rim(0.0, 0.0, True), rim(5.0, 0.0, True), rim(0.0, 0.1, False), rim(5.0, 0.1, False), rim(9.0, 0.0, False)]
    assert list(_pairs(found, np.arange(5))) == [(0, 2), (1, 3)]
    assert list(_pairs(found, np.array([1, 2, 4]))) == []
    assert list(_pairs([rim(0.0, 0.0, True), rim(0.0, 0.1, True)], np.arange(2))) == []  # both the same way round


@pytest.mark.parametrize("apart, close", [(0.49, True), (0.51, False)])
def test_rims_half_a_side_apart_may_close_each_other(apart, close):
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    one = _Ring([], 1.0, square, np.array([0, 0, 1.0]), 4.0)
    other = _Ring([], 1.0, square[::-1] + [0.0, 0.0, apart], np.array([0, 0, -1.0]), 4.0)
    assert (list(_pairs([one, other], np.arange(2))) == [(0, 1)]) is close


def test_ends_of_edges_within_half_a_millionth_of_the_hull_are_one_point():
    """Cells of a millionth of 4 m: 1.6 µm from the middle of one is in it, 2.4 µm is not"""
    from hakobune.meshing.quality.seams import _whole

    for off, count in ((1.6e-6, 3), (2.4e-6, 4)):
        points = np.array([[0.0, 0, 0], [4.0, 0, 0], [0, 1.0, 0], [0, 1.0 + off, 0]])
        found, start, end = _whole(points, np.array([0, 3]), np.array([2, 1]), "")
        assert len(found) == count and found[start] == pytest.approx(points[[0, 3]], abs=1e-5)
        assert found[end] == pytest.approx(points[[2, 1]], abs=1e-5)


@pytest.mark.parametrize("size", [1.0, 200.0, 0.005])
def test_a_slit_is_a_tenth_of_the_side_of_the_longer_of_two_rims(size):
    """A square of 4 m and one within it of 8 sides: twice the area between them over both lengths, 0.36 and 0.46 m"""
    from hakobune.meshing.quality.seams import rings

    coarse = size * np.array([[0.0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]])
    fine = np.concatenate([[a, (a + b) / 2] for a, b in zip(coarse, np.roll(coarse, -1, axis=0), strict=True)])
    middle = size * np.array([2.0, 2.0, 0.0])
    for share, seam in ((0.82, True), (0.77, False)):
        inner = middle + share * (fine[::-1] - middle) + size * np.array([0.01, 0.013, 0.0])
        points = np.concatenate([coarse, inner])
        start = np.arange(12)
        end = np.concatenate([np.roll(np.arange(4), -1), 4 + np.roll(np.arange(8), -1)])
        found = rings(points, start, end)
        assert found.seam.tolist() == [seam] * 2


@pytest.mark.parametrize("symmetry, copies", [("", 1), ("x", 2), ("y", 2), ("xy", 4)])
def test_an_edge_has_an_image_in_each_plane_and_in_both_together(symmetry, copies):
    """Each mirroring turns its direction round: in both planes it runs as it was"""
    from hakobune.meshing.quality.seams import _whole

    points = np.array([[1.0, 2.0, 0.0], [3.0, 4.0, -1.0]])
    x, start, end = _whole(points, np.array([0]), np.array([1]), symmetry)
    assert len(start) == len(end) == copies and len(x) == 2 * copies
    found = {(tuple(x[a]), tuple(x[b])) for a, b in zip(start, end, strict=True)}
    wanted = set()
    for sx in (1, -1) if "x" in symmetry else (1,):
        for sy in (1, -1) if "y" in symmetry else (1,):
            ends = [tuple(point * [sx, sy, 1]) for point in points]
            wanted.add(tuple(ends if sx * sy > 0 else ends[::-1]))
    assert found == wanted


def test_rings_that_touch_twice_are_parted_where_each_turns_back_sharply():
    """Two slivers of 0.2 m width from (0, 0) to (0, 4), one to the left and one to the right: at both ends an edge of
    the other one goes on more straight, which would make two rings with all the space between the slivers"""
    x = np.array([[0, 0, 0], [0, 4, 0], [-1, 2, 0], [-1.2, 2, 0], [1, 2, 0], [1.2, 2, 0]], float)
    edges = np.array([(0, 2), (2, 1), (1, 5), (5, 0), (0, 4), (4, 1), (1, 3), (3, 0)])
    for order in (np.arange(8), np.arange(8)[::-1], np.array([4, 0, 2, 6, 1, 3, 5, 7])):
        start, end = edges[order].T
        found = [{*start[ring].tolist(), *end[ring].tolist()} for ring in _divided(x, start, end)]
        assert sorted(map(sorted, found)) == [[0, 1, 2, 3], [0, 1, 4, 5]]
    for number in np.random.default_rng(1).permutation(np.tile(np.arange(6), (5, 1)), axis=1):  # of each point
        places = np.empty_like(x)
        places[number] = x
        start, end = number[edges].T
        found = [{*start[ring].tolist(), *end[ring].tolist()} for ring in _divided(places, start, end)]
        assert sorted(map(sorted, found)) == sorted(
            sorted(number[ring].tolist()) for ring in ([0, 1, 2, 3], [0, 1, 4, 5])
        )
