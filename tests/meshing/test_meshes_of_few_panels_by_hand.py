"""Panels, waterlines and files of a few points, by hand."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing import drawing, files, lid, shapes
from hakobune.meshing.lid import waterline
from hakobune.meshing.mirror import _closed_up, healed
from hakobune.meshing.node_lists import read_dat, read_hydrostar, read_nemoh, read_pnl
from hakobune.meshing.panels import PanelMesh, joined
from hakobune.meshing.quality.findings import _position, findings
from hakobune.meshing.shapes import box, buoy
from hakobune.meshing.text_files import check_size
from hakobune.meshing.text_formats import read_obj, read_stl

SQUARE = "1 0 0 -1\n2 2 0 -1\n3 2 2 -1\n4 0 2 -1\n5 1 1 -2\n"


def corners(mesh):
    return mesh.points[mesh.corners].tolist()


FLAT = [[0, 0, -1], [2, 0, -1], [2, 2, -1], [0, 2, -1]]
PEAK = [[0, 0, -1], [2, 0, -1], [1, 1, -2], [1, 1, -2]]


@pytest.mark.parametrize(
    ("name", "text", "read", "symmetry"),
    [
        ("a.dat", "2 1\n" + SQUARE + "0 0. 0. 0.\n1 2 3 4\n1 2 5 5\n0 0 0 0\n", read_nemoh, "y"),
        ("a.dat", "2 0\n" + SQUARE + "0 0. 0. 0.\n1 2 3 4\n1 2 5 5\n0 0 0 0\n", read_dat, ""),
        ("a.pnl", "# mesh\n2 5 0 1 ! panels, nodes\n" + SQUARE + "1 4 1 2 3 4\n2 3 1 2 5\n", read_pnl, "y"),
        ("a.pnl", "2 5 1 0\n" + SQUARE + "1 4 1 2 3 4\n2 3 1 2 5 0\n", read_pnl, "x"),
        ("a.dat", "5 4\n" + SQUARE + "1 102 1 2\n2 204 1 2 3 4\n3 203 1 2 5 9\n4 102 2 3\n", read_dat, ""),
        ("a.dat", SQUARE + "*RETURN\n1 1 2 3 4\n* note\n2 1 2 5 5\n*RETURN\n", read_dat, ""),
        (
            "a.hst",
            "PROJECT\nNBBODY 1\nSYMMETRY_BODY 1 1\nCOORDINATES\n"
            + SQUARE
            + "ENDCOORDINATES\nPANEL TYPE 0\n1 2 3 4\n1 2 5 5\nENDPANEL\nENDFILE 1\n",
            read_hydrostar,
            "y",
        ),
        (
            "a.hst",
            "NBODY 1\nSYMMETRY_BODY 1 2\nCOORDINATES\n"
            + SQUARE
            + "ENDCOORDINATES\nPANEL TYPE 1\n1 1 2 3 4\n2 1 2 5 5\nENDPANEL\n9 9 9 9\n",
            read_hydrostar,
            "xy",
        ),
        (
            "a.hst",
            "SYMMETRY_BODY 1 0\nCOORDINATES\n" + SQUARE + "ENDCOORDINATES\nPANEL\n1 2 3 4\n1 2 5 1\n",
            read_hydrostar,
            "",
        ),
    ],
)
def test_numbered_points_are_the_corners_of_panels(tmp_path, name, text, read, symmetry):
    """A square, and a triangle down to a point; elements of other kinds, remarks and words after a panel are none"""
    (tmp_path / name).write_text(text)
    mesh = read(tmp_path / name)
    assert mesh.symmetry == symmetry and len(mesh) == 2
    assert corners(mesh)[0] == FLAT and [p for p in corners(mesh)[1] if p in PEAK][:3] == PEAK[:3]


@pytest.mark.parametrize(
    ("name", "text", "read", "says"),
    [
        (
            "a.pnl",
            "1 3 0 0\n1 0 0 0\n2 1 x 0\n3 1 1 0\n1 3 1 2 3\n",
            read_pnl,
            "a.pnl, line 3: 'x' is not a finite number",
        ),
        (
            "a.pnl",
            "1 3 0 0\n1 0 0 0\n2 1 0\n3 1 1 0\n1 3 1 2 3\n",
            read_pnl,
            "a.pnl, line 3 has 3 numbers; a node needs four",
        ),
        (
            "a.pnl",
            "1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 5 1 2 3\n",
            read_pnl,
            "a.pnl, line 5: a panel has a number, then 3 or 4",
        ),
        (
            "a.pnl",
            "1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 4 1 2 3\n",
            read_pnl,
            "a.pnl, line 5: a panel has a number, then 3 or 4",
        ),
        (
            "a.pnl",
            "1 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1\n",
            read_pnl,
            "a.pnl, line 5: a panel has a number, then 3 or 4",
        ),
        (
            "a.pnl",
            "1 3 0 2\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 3 1 2 3\n",
            read_pnl,
            "a.pnl, line 1: symmetry 0 2; allowed: 0 or 1 each",
        ),
        (
            "a.pnl",
            "2 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 3 1 2 3\n",
            read_pnl,
            "a.pnl has 4 lines of numbers, but 3 nodes and 2 panels need 5",
        ),
        ("a.pnl", "1 3 0\n", read_pnl, "a.pnl: no line with numbers of panels, nodes, x symmetry, y symmetry"),
        ("a.pnl", "x\n", read_pnl, "a.pnl: no line with numbers of panels"),
        (
            "a.dat",
            "2 2\n1 0 0 0\n",
            read_nemoh,
            "a.dat: line 1 is neither '2 0' nor '2 1'; give '2 1' for a mesh with the",
        ),
        ("a.dat", "2\n", read_nemoh, "a.dat: line 1 is neither"),
        ("a.dat", "", read_nemoh, "a.dat: line 1 is neither"),
        (
            "a.dat",
            "2 0\n1 0 0\n",
            read_nemoh,
            "a.dat, line 2 has 3 values; a point needs four: its number and its x, y, z",
        ),
        ("a.dat", "2 0\n1 0 0 0\n", read_nemoh, "a.dat: no line '0 0. 0. 0.' after the points"),
        ("a.dat", "2 0\n1 0 0 0\n0 0 0 0\n1 7 1 1\n", read_nemoh, "a.dat, line 4: there is no point 7; the file has 1"),
        ("a.dat", "2 0\n1 0 0 0\n0 0 0 0\n1 1\n", read_nemoh, "a.dat, line 4 has 2 nodes; a panel has 3 or 4"),
        ("a.hst", "NBODY 2\n", read_hydrostar, "a.hst, line 1 announces 2 bodies; allowed: one body in a file"),
        (
            "a.hst",
            "COORDINATES\n1 0 0\n",
            read_hydrostar,
            "a.hst, line 2 has 3 values; a point needs four: its number and its x, y, z",
        ),
        ("a.hst", "COORDINATES\n1 0 z 0\n", read_hydrostar, "a.hst, line 2: 'z' is not a finite number"),
        (
            "a.hst",
            "PANEL TYPE 0\n",
            read_hydrostar,
            "a.hst has no COORDINATES, which a mesh of HydroStar has; if it is a matrix",
        ),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 x\n", read_obj, "a.obj, line 4: 'x' is not a finite number"),
        ("a.obj", "v 0 0\n", read_obj, "a.obj, line 1 is '0 0'; it needs 3 numbers"),
        (
            "a.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n",
            read_obj,
            "a.obj, line 4: there is no point 4; the file has 3",
        ),
        ("a.stl", "vertex 0 0 0\nvertex 1 0 y\nvertex 1 1 0\n", read_stl, "a.stl: 'y' of a vertex is not a number"),
        ("a.stl", "vertex 0 0 0\nvertex 1 0 0\n", read_stl, "a.stl has 2 vertices; allowed: three for each triangle"),
        ("a.stl", "solid\n", read_stl, "a.stl has 0 vertices"),
    ],
)
def test_what_a_list_of_points_cannot_have_is_told_with_its_line(tmp_path, name, text, read, says):
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError) as error:
        read(tmp_path / name)
    assert says in str(error.value)


def test_a_deck_of_aqwa_has_points_in_fields_and_one_structure(tmp_path):
    """Points in columns 7 to 11 and behind, without blanks between negative numbers"""
    lines = [" 01 COOR", *(f"{'':6}{n:5d}{x:10.3f}{y:10.3f}{z:10.3f}" for n, x, y, z in (
        (1, 0, 0, -1), (2, 2, 0, -1), (3, 2, 2, -1), (4, 0, 2, -1), (5, -100.125, -100.25, -100.5)))]  # fmt: skip
    (tmp_path / "a.dat").write_text("\n".join([
        "JOB TANK DIFF", *(line if i == 0 else f"  01  {line[6:]}" for i, line in enumerate(lines)),
        " 02 ELM1", "     02SYMX", "  02QPPL DIFF   10(1)(    1)(    2)(    3)(    4)   * a panel",
        "  02TPPL DIFF   11(1)(    1)(    2)(    5)", "  02PMAS     15(1)(    1)(    1)(    1)", " END02FINI",
        " 03 ELM2", " END03FINI",
    ]))  # fmt: skip
    mesh = read_dat(tmp_path / "a.dat")
    assert mesh.symmetry == "y" and len(mesh) == 2
    assert corners(mesh)[0] == FLAT and corners(mesh)[1][2:] == [[-100.125, -100.25, -100.5]] * 2


def test_an_obj_counts_points_from_one_or_back_from_the_last_and_cuts_polygons(tmp_path):
    text = "# hull\nv 0 0 -1\nv 2 0 -1 1.0\nv 2 2 -1\nv 0 2 -1\nvn 0 0 1\nf 1/7/1 2/8/1 3//1 4 # a square\n"
    text += "v 1 1 -2\nf -5 -4 \\\n-1\nf 1 2 3 4 5\n"
    (tmp_path / "a.obj").write_text(text)
    mesh = read_obj(tmp_path / "a.obj")
    assert corners(mesh)[:2] == [FLAT, PEAK] and len(mesh) == 4
    whole = np.abs(mesh.area_vectors[2:].sum(axis=0))
    ring = np.array([*FLAT, [1, 1, -2]], float)
    assert whole == pytest.approx(np.abs(0.5 * np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)))


def test_a_waterline_forks_where_two_edges_end_as_where_two_begin():
    """Walls of which two end at (5, 0) and one begins there; the same turned round"""

    def wall(a, b):
        return PanelMesh([[*a, 0.0], [*b, 0.0], [*b, -1.0], [*a, -1.0]], [[0, 1, 2, 3]])

    two = joined([wall((0, 0), (5, 0)), wall((5, 3), (5, 0)), wall((5, 0), (9, 0))])
    for mesh in (two, replace(two, corners=two.corners[:, ::-1])):
        with pytest.raises(ValueError, match=r"lid: the waterline forks at x = 5, y = 0 m; see the mesh findings"):
            waterline(mesh)
    (line,) = waterline(joined([wall((0, 0), (5, 0)), wall((5, 0), (9, 0))]))
    assert {tuple(line[0]), tuple(line[-1])} == {(0, 0, 0), (9, 0, 0)} and len(line) == 3
    loops = waterline(
        joined([box(4, 2, 1, counts=(1, 1, 1)).whole(), box(4, 2, 1, counts=(1, 1, 1)).whole().moved(dx=9)])
    )
    assert len(loops) == 2 and all(np.array_equal(loop[0], loop[-1]) for loop in loops)


@pytest.mark.parametrize(("moved", "round_"), [(0.0, True), (1e-9, True), (1e-4, False), (0.2, False)])
def test_one_point_off_a_circle_is_enough_not_to_be_round(moved, round_):
    """A point of the bottom, inside of the rim; a millimetre of ten metres, ten times what files round"""
    mesh = buoy(10.0, 4.0, counts=(6, 3, 2)).whole()
    inside = np.hypot(*mesh.points[:, :2].T)
    number = int(np.argmin(np.abs(inside - 5.0)))
    points = mesh.points.copy()
    points[number, 2] += moved * 10
    assert bool(replace(mesh, points=points).is_round) is round_


def test_the_foot_of_walls_is_what_one_panel_alone_ends_at():
    """Two walls back to back inside a box without a bottom end at an edge of two panels, which is no foot"""
    walls = box(4.0, 2.0, 1.0, counts=(2, 1, 1), bottom=False).whole()
    assert walls.foot.area_vectors.sum(axis=0) == pytest.approx([0, 0, -8]) and walls.closed().volume == pytest.approx(
        8
    )
    inner = PanelMesh([[0.0, -1, 0], [0, 1, 0], [0, 1, -1], [0, -1, -1]], [[0, 1, 2, 3], [3, 2, 1, 0]])
    both = joined([walls, inner])
    assert both.foot.area_vectors.sum(axis=0) == pytest.approx([0, 0, -8]) and len(both.foot) == len(walls.foot)
    quarter = box(4.0, 2.0, 1.0, counts=(1, 1, 1), bottom=False)
    assert len(quarter.foot) == 2 and quarter.volume == pytest.approx(8)
    assert box(4.0, 2.0, 1.0, counts=(1, 1, 1)).foot is None and inner.foot is None


@pytest.mark.parametrize(("symmetry", "move", "says"), [
    ("x", (-1.0, 0, 0), ["across the mirror plane x = 0, down to x = -1 m; allowed: x ≥ 0"]),
    ("y", (0, -0.5, 0), ["across the mirror plane y = 0, down to y = -0.5 m; allowed: y ≥ 0"]),
    ("xy", (-1.0, -0.5, 0), ["mirror plane x = 0, down to x = -1 m", "mirror plane y = 0, down to y = -0.5 m"]),
    ("xy", (0, -0.5, 0), ["mirror plane y = 0, down to y = -0.5 m"]), ("xy", (0, 0, 0), []), ("", (-1.0, -0.5, 0), []),
    ("xy", (0, 0, 0.25), ["above the water, up to z = 0.25 m; allowed: z ≤ 0"]),
])  # fmt: skip
def test_a_mesh_lies_below_the_water_and_beside_each_of_its_mirror_planes(symmetry, move, says):
    quarter = box(4.0, 2.0, 1.0, counts=(2, 1, 1))
    mesh = PanelMesh(quarter.points + np.array(move), quarter.corners, symmetry)
    found = [one.text for one in _position(mesh)]
    assert len(found) == len(says) and all(one.severity == "error" for one in _position(mesh))
    for text, words in zip(found, says, strict=True):
        assert words in text and text.startswith(("2 of", "1 of", "3 of", "4 of", "5 of"))


@pytest.mark.parametrize(
    ("extent", "longest", "count"), [(10.0, 2.0, 8), (10.0, 5 * math.pi, 1), (10.0, 15.6, 2), (4.0, math.inf, 1)]
)
def test_the_longest_of_edges_spaced_by_a_cosine_is_half_pi_times_their_mean(extent, longest, count):
    """π/2 · 10/2 = 7.85"""
    assert shapes._most(extent, longest) == count


def test_points_that_are_meant_to_be_one_are_merged_at_their_middle():
    """Two corners 0.02 apart, one 0.005 off z = 0; a panel of which two corners are left has no area"""
    points = [[0.0, 0, 0.005], [2, 0, 0], [2, 2, -1], [2.02, 2, -1], [0.004, 2, -1], [9, 9, -9]]
    mesh = PanelMesh(points, [[0, 1, 2, 4], [0, 1, 3, 3], [2, 3, 4, 4], [1, 2, 5, 3]])
    made = healed(mesh, 0.025)
    found = corners(made)
    assert len(made) == 3 and found[0] == [[0, 0, 0], [2, 0, 0], [pytest.approx(2.01), 2, -1], [0, 2, -1]]
    assert found[1][2:] == [[pytest.approx(2.01), 2, -1]] * 2 and found[2][2:] == [[9, 9, -9]] * 2
    assert _closed_up([1, 2, 3, 4]) == [1, 2, 3, 4] and _closed_up([1, 2, 2, 3]) == [1, 2, 3, 3]


class Gmsh:
    """What a drawing asks of gmsh, of a hull of one box from −2 to 2, its sizes and options kept"""

    def __init__(self):
        self.options, self.named = {}, []
        occ = SimpleNamespace(
            fuse=lambda a, b: ([("fused", *a, *b)],),
            cut=lambda a, b: ([("cut", *a, *b)],),
            synchronize=lambda: None,
            getMass=lambda *one: 7.0,
            getCenterOfMass=lambda *one: (1.0, 2.0, 3.0),
        )
        self.model = SimpleNamespace(occ=occ, mesh=SimpleNamespace(generate=lambda n: None))
        self.option = SimpleNamespace(setNumber=self.options.__setitem__)


@pytest.mark.parametrize(("size", "good"), [(0.0401, True), (0.0399, False), (19.9, True), (20.1, False)])
def test_panels_of_a_drawing_are_a_thousandth_to_half_of_its_length(monkeypatch, size, good):
    from contextlib import contextmanager

    gmsh = Gmsh()

    @contextmanager
    def session(name):
        gmsh.named.append(name)
        yield gmsh

    monkeypatch.setattr(drawing, "session", session)
    monkeypatch.setattr(drawing, "_placed", lambda occ, part, turn, grown, seam: (part["shape"], turn, grown, seam))
    monkeypatch.setattr(drawing, "_extent", lambda gmsh, body: (np.array([-20.0, -5, -4]), np.array([20.0, 5, 3])))
    monkeypatch.setattr(drawing, "_below", lambda occ, body, low, high, symmetry: [("below", *body)])
    monkeypatch.setattr(
        drawing, "_wetted", lambda gmsh, body, reach, symmetry: setattr(gmsh, "body", body) or [(reach, symmetry)]
    )
    monkeypatch.setattr(
        drawing,
        "panels_of",
        lambda gmsh, sides, symmetry, name: SimpleNamespace(sides=list(sides), symmetry=symmetry, name=name, copies=2),
    )
    monkeypatch.setattr(drawing, "outwards", lambda mesh: mesh)
    monkeypatch.setattr(drawing, "_waterplane", lambda gmsh, body, near: 5.0)
    parts = [({"shape": "box"}, 0.0), ({"shape": "sphere"}, 0.5), ({"shape": "cylinder", "cut": True}, 0.0)]
    one = drawing.Drawing(size, "x", 20, parts)
    if not good:
        with pytest.raises(ValueError, match=rf"size is {size:g} m for a hull of 40 m; allowed: 0\.04 to 20 m"):
            drawing._panels(one, "", 1.1, 0.2, 6)
        return
    mesh, (volume, center, plane) = drawing._panels(one, "", 1.1, 0.2, 6)
    assert (
        mesh.sides == [(pytest.approx(4e-5), "x")]
        and (mesh.symmetry, mesh.name) == ("x", "")
        and gmsh.named == ["drawing"]
    )
    assert volume == 14.0 and center.tolist() == [0, 2, 3] and plane == 10.0
    parts = ("box", 0.0, 1.1, 0.2), ("sphere", 0.5, 1.1, 0.2), ("cylinder", 0.0, 1.1, 0.2)
    assert gmsh.body == [("below", ("cut", ("fused", *parts[:2]), parts[2]))]
    assert gmsh.options == {
        "Mesh.MeshSizeMax": size,
        "Mesh.MeshSizeMin": 0.25 * size,
        "Mesh.Algorithm": 6,
        "Mesh.MeshSizeFromCurvature": 40,
        "Mesh.RecombineAll": 1,
        "Mesh.MeshSizeExtendFromBoundary": 0,
    }
    drawing._panels(one, "barge", 1.0, 0.0, 8)
    assert gmsh.named[-1] == "barge"
    monkeypatch.setattr(drawing, "_extent", lambda gmsh, body: (np.array([-20.0, -5, 0]), np.array([20.0, 5, 3])))
    with pytest.raises(ValueError, match="no part lies below still water, z = 0"):
        drawing._panels(one, "", 1.0, 0.0, 8)


@pytest.mark.parametrize(
    ("draft", "lift", "told"), [(4.0, 3.9e-6, True), (4.0, 4.1e-6, False), (0.5, 4.9e-7, True), (0.5, 5.1e-7, False)]
)
def test_edges_a_millionth_of_the_draft_off_the_surface_are_in_the_waterline(draft, lift, told):
    wall = PanelMesh([[0, 0, -lift], [5, 0, -lift], [5, 0, -draft], [0, 0, -draft]], [[0, 1, 2, 3]])
    found = waterline(wall)
    assert len(found) == told and (not told or {tuple(end) for end in found[0]} == {(0, 0, 0), (5, 0, 0)})


@pytest.mark.parametrize("turned", [False, True])
def test_a_plan_keeps_a_notch_whichever_way_it_turns(turned):
    """An arrow: its notch turns back by 127°, more than any corner that turns on; it is kept whatever the size is"""
    ring = np.array([[0.0, 0, 0], [4, 2, 0], [0, 4, 0], [1.5, 2, 0]])
    ring = np.roll(ring[::-1] if turned else ring, 1, axis=0)
    made = lid._simplified(ring, 50.0)
    assert sorted(map(tuple, made)) == sorted(map(tuple, ring))


def test_what_is_drawn_a_hair_off_the_surface_or_either_mirror_plane_is_moved_into_it():
    """Four thousandths of the median edge of 2.8 m"""
    points = np.array([[0.007, 0.007, -0.007], [2, -0.0079, 0.0079], [2, 2, -2], [0.0118, 2.0, -0.0118]])
    mesh = PanelMesh(points, [[0, 1, 2, 3]])
    reach = 4e-3 * mesh.sizes[0]
    assert reach < 0.0118 < 1.05 * reach
    for symmetry in ("", "x", "y", "xy"):
        made = files._as_meant(replace(mesh, symmetry=symmetry)).points
        wanted = points.copy()
        for axis in ("z", *symmetry):
            column = wanted[:, "xyz".index(axis)]
            column[np.abs(column) <= reach] = 0.0
        assert made.tolist() == wanted.tolist() and (made != points).any()
    assert files._as_meant(replace(mesh, symmetry="xy")).points[0].tolist() == [0, 0, 0]


@pytest.mark.parametrize("flipped", [(), (0,), (1,), (0, 1), (2,), (1, 2), (0, 1, 2)])
def test_normals_that_point_inwards_are_told_of_each_part_and_of_all_that_stands_together(flipped):
    """A box afloat, and a ring of two walls on the bed, whose inner one has a negative volume"""
    afloat = box(4.0, 2.0, 1.0, counts=(1, 1, 1)).whole()
    outer = box(8.0, 8.0, 5.0, counts=(1, 1, 1), bottom=False).whole().moved(dx=20.0)
    inner = box(4.0, 4.0, 5.0, counts=(1, 1, 1), bottom=False).whole().moved(dx=20.0).flipped()
    parts = [part.flipped() if i in flipped else part for i, part in enumerate((afloat, outer, inner))]
    mesh = joined(parts)
    texts = [one.text for one in findings(mesh, 5.0) if "point into the body" in one.text]
    volumes = [one.volume for one in parts]
    wrong = [0] * (volumes[0] < 0) + [1, 2] * (volumes[1] + volumes[2] < 0)
    assert len(texts) == bool(wrong)
    if wrong:
        panels, whole = sum(len(parts[i]) for i in wrong), len(mesh)
        assert texts[0].startswith(f"the normals of {panels} of {whole} panels point into the body (volume ")


@pytest.mark.parametrize(("size", "good"), [(1_000_000, True), (1_000_001, False)])
def test_files_are_read_up_to_a_million_bytes_a_megabyte(tmp_path, size, good):
    path = tmp_path / "a.txt"
    with path.open("wb") as file:
        file.truncate(size)
    if good:
        check_size(path, largest=1)
    else:
        with pytest.raises(ValueError, match=r"a\.txt has 1 MB; allowed: up to 1 MB"):
            check_size(path, largest=1)
    with pytest.raises(ValueError, match="cannot be read: Is a directory"):
        check_size(tmp_path)
    with pytest.raises(ValueError, match="it is a device or a pipe, which may have no end; give a file"):
        check_size("/dev/null")


def test_a_deck_of_aqwa_ends_where_the_next_begins_whatever_is_in_that_one(tmp_path):
    """Rows of the decks of materials and of masses begin with numbers too, and are no points"""
    points = "".join(f"  01  {n:5d}{x:10.3f}{y:10.3f}{-1:10.3f}\n" for n, x, y in (
        (1, 0, 0), (2, 2, 0), (3, 2, 2), (4, 0, 2)))  # fmt: skip
    panel = "  02QPPL DIFF   10(1)(    1)(    2)(    3)(    4)\n"
    (tmp_path / "a.dat").write_text(
        f"**** DECK  1 ****\n  01  COOR\n{points}**** DECK  2 ****\n 02 MATE\n   03    7   5.0\n"
        f"**** DECK  3 ****\n 02 ELM1\n{panel} END02FINI\n"
    )
    mesh = read_dat(tmp_path / "a.dat")
    assert len(mesh.points) == 4 and corners(mesh) == [FLAT]
