import re
from dataclasses import replace

import numpy as np
import pytest

from hakobune.meshing.files import READABLE, WRITABLE, read_mesh, write_mesh
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import joined, structured
from hakobune.meshing.quality import findings
from hakobune.meshing.shapes import box, buoy

KEPT = {".gdf": "xy", ".pnl": "xy", ".nemoh": "y", ".mar": "y", ".dat": "y", ".msh": "", ".vtu": ""}


def sorted_centroids(mesh):
    centroids = mesh.whole().centroids
    return centroids[np.lexsort(centroids.round(6).T)]


@pytest.mark.parametrize("hull", (box(100, 50, 10, panels=124), buoy(10, 10, panels=124)), ids=("box", "buoy"))
@pytest.mark.parametrize("suffix", WRITABLE)
@pytest.mark.parametrize("covered", (False, True))
def test_what_is_written_is_read_again(tmp_path, hull, suffix, covered):
    path = tmp_path / f"hull{suffix}"
    write_mesh(hull, path, lid(hull) if covered else None)
    back = read_mesh(path)
    assert back.symmetry == KEPT[suffix]
    assert back.total == hull.total
    assert back.volume == pytest.approx(hull.volume, rel=1e-12)
    np.testing.assert_allclose(sorted_centroids(back), sorted_centroids(hull), atol=1e-9)
    assert findings(back) == []
    assert back.name == "hull"


@pytest.mark.parametrize("suffix", WRITABLE)
@pytest.mark.parametrize("symmetry", ("", "x", "y"))
def test_a_half_hull_comes_back_whole(tmp_path, suffix, symmetry):
    hull = buoy(10, 10, panels=60, symmetry=symmetry)
    write_mesh(hull, tmp_path / f"half{suffix}")
    back = read_mesh(tmp_path / f"half{suffix}")
    assert back.total == hull.total
    assert back.volume == pytest.approx(hull.volume, rel=1e-12)


def test_inward_normals_are_left_as_they_are(tmp_path):
    write_mesh(box(10, 5, 2, panels=40).flipped(), tmp_path / "a.gdf")
    assert read_mesh(tmp_path / "a.gdf").volume == pytest.approx(-100)


def test_a_gdf_as_wamit_writes_it_is_read(tmp_path):
    # comments after the numbers, Fortran exponents, a panel over several lines, a triangle
    (tmp_path / "a.gdf").write_text(
        "a prism by hand\n 1.0 9.80665   ULEN GRAV\n 1 0   ISX ISY\n 2  NPAN\n"
        "0.0 0 -1  0 1 -1\n 1.0D0 1 -1  1 0 -1\n"
        "1 0 -1  1 1 -1  1 1 0  1 1 0\n"
    )
    mesh = read_mesh(tmp_path / "a.gdf")
    assert mesh.symmetry == "x"
    np.testing.assert_allclose(mesh.areas, (1, 0.5))
    np.testing.assert_allclose(mesh.normals, ((0, 0, -1), (1, 0, 0)))


def test_a_gdf_in_feet_comes_in_metres(tmp_path):
    write_mesh(box(10, 5, 2, panels=40), tmp_path / "a.gdf")
    text = (tmp_path / "a.gdf").read_text().replace("9.80665", "32.174")
    (tmp_path / "a.gdf").write_text(text)
    assert read_mesh(tmp_path / "a.gdf").volume == pytest.approx(100 * 0.3048**3)


def tetrahedron():
    """Points and outward triangles of a body below z = 0 with its top open: corner at (0, 0, −1)."""
    points = np.array([[0, 0, -1], [1, 0, 0], [0, 1, 0], [-1, -1, 0.0]])
    return points, np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3]])


@pytest.mark.parametrize("suffix", (".stl", ".ply", ".obj", ".off", ".vtk", ".vtu", ".msh"))
def test_other_formats_are_read_and_their_points_welded(tmp_path, suffix):
    import meshio

    points, triangles = tetrahedron()
    options = {"file_format": "gmsh22"} if suffix == ".msh" else {}
    meshio.Mesh(points, [("triangle", triangles)]).write(tmp_path / f"a{suffix}", **options)
    mesh = read_mesh(tmp_path / f"a{suffix}")
    assert (len(mesh), len(mesh.points)) == (3, 4)
    assert mesh.volume == pytest.approx(1 / 3 * 1.5, rel=1e-6)  # base of area 3/2, height 1
    assert findings(mesh) == []


def test_corners_of_an_obj_may_have_normals_and_count_from_the_last_point(tmp_path):
    points, triangles = tetrahedron()
    lines = [*("v {} {} {}".format(*point) for point in points), "vn 0 0 1", "s off"]
    lines += [f"f {a + 1}//1 {b - 4}/1/1 {c - 4}  # a panel" for a, b, c in triangles]
    (tmp_path / "a.obj").write_text("\n".join(lines) + "\n")
    mesh = read_mesh(tmp_path / "a.obj")
    assert (len(mesh), len(mesh.points)) == (3, 4) and mesh.volume == pytest.approx(0.5)


def test_a_text_stl_may_begin_with_an_empty_line_and_in_capitals(tmp_path):
    points, triangles = tetrahedron()
    rows = [
        f"facet normal 0 0 0\nouter loop\n{corners}\nendloop\nendfacet"
        for corners in ("\n".join("VERTEX {} {} {}e+000".format(*points[i]) for i in row) for row in triangles)
    ]
    text = "\nsolid a name\n" + "\n".join(rows) + "\nendsolid\n"
    (tmp_path / "a.stl").write_text(text)
    assert read_mesh(tmp_path / "a.stl").volume == pytest.approx(0.5)
    (tmp_path / "a.stl").write_text(text.replace("VERTEX", "VERTX", 1))
    with pytest.raises(ValueError, match=r"a\.stl has 8 vertices; allowed: three for each triangle"):
        read_mesh(tmp_path / "a.stl")
    (tmp_path / "a.stl").write_text(text.replace("e+000", "e+x", 1))
    with pytest.raises(ValueError, match="of a vertex is not a number"):
        read_mesh(tmp_path / "a.stl")


def prism(sides):
    """Points and faces (from 0) of a prism of so many sides, 2 m deep below z = 0, its keel one polygon, open on top"""
    turn = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = [(*xy, z) for z in (0.0, -2.0) for xy in ring]
    after = np.roll(np.arange(sides), -1)
    return points, [
        [*range(2 * sides - 1, sides - 1, -1)],
        *([i, i + sides, j + sides, j] for i, j in enumerate(after.tolist())),
    ]


@pytest.mark.parametrize("sides", (5, 6, 7))
@pytest.mark.parametrize("suffix", (".obj", ".vtp", ".vtk"))
def test_a_keel_of_one_polygon_is_cut_into_panels(tmp_path, suffix, sides):
    points, faces = prism(sides)
    path = tmp_path / f"a{suffix}"
    if suffix == ".obj":
        rows = ["v {} {} {}".format(*point) for point in points] + [
            "f " + " ".join(str(n + 1) for n in f) for f in faces
        ]
        path.write_text("\n".join(rows) + "\n")
    else:
        pyvista = pytest.importorskip("pyvista")
        pyvista.PolyData(np.array(points), [n for face in faces for n in (len(face), *face)]).save(path)
    mesh = read_mesh(path)
    assert mesh.volume == pytest.approx(sides * np.sin(2 * np.pi / sides), rel=1e-6)  # 2 m deep
    assert findings(mesh) == []


def splines(knots, orders, points):
    """Text of a patch; points (nu, nv, 3)"""
    counts = [len(k) + 1 - 2 * n for k, n in zip(knots, orders, strict=True)]
    rows = [counts, orders, *knots, *np.asarray(points).swapaxes(0, 1).reshape(-1, 3)]
    return "\n".join(" ".join(f"{x:.12g}" for x in row) for row in rows) + "\n"


def test_patches_of_splines_of_wamit_are_cut_into_panels(tmp_path):
    """A quarter of a tub of elliptic section whose draft goes with a parabola, by one cubic and quadratic patch each

    z = −d (1 − (x/a)²) over |y| ≤ b: 8/3 a b d of the whole; the ends in y are plane patches.
    """
    a, b, d = 3.0, 2.0, 1.5
    # keel: u along x, of order 3: the parabola through its control points (0, −d), (a/2, −d), (a, 0); v along y
    keel = np.array([[(x, y, z) for y in (0.0, 0.5 * b, b)] for x, z in ((0, -d), (0.5 * a, -d), (a, 0.0))])
    side = np.array([[(x, b, f * z) for f in (1.0, 0.0)] for x, z in ((0, -d), (0.5 * a, -d), (a, 0.0))])
    bent, knots = [0, 0, 0, 1, 1, 1], [0, 0, 1, 2, 2]
    text = "tub\n1 9.81\n1 1\n2 1\n"
    text += splines([bent, knots], (3, 2), keel) + splines([bent, [0, 0, 1, 1]], (3, 2), side)
    (tmp_path / "a.gdf").write_text(text)
    mesh = read_mesh(tmp_path / "a.gdf")
    assert mesh.symmetry == "xy" and 1500 < len(mesh) < 3500
    assert mesh.whole().volume == pytest.approx(4 * 2 / 3 * a * b * d, rel=1e-3)
    assert [one.text for one in findings(mesh) if one.severity == "error"] == []
    (tmp_path / "a.gdf").write_text(text.replace("9.81", "32.174", 1))
    assert read_mesh(tmp_path / "a.gdf").whole().volume == pytest.approx(4 * 2 / 3 * a * b * d * 0.3048**3, rel=1e-3)


def test_a_deck_in_the_water_surface_is_left_out(tmp_path):
    import meshio

    points, triangles = tetrahedron()
    meshio.Mesh(points, [("triangle", np.vstack([triangles, [1, 2, 3]]))]).write(tmp_path / "a.stl")
    assert len(read_mesh(tmp_path / "a.stl")) == 3


def test_what_is_drawn_a_hair_off_the_surface_is_in_it(tmp_path):
    """0.01 mm at panels of 5 mm and 1 m, either side; a deck 1 % of an edge below it is wetted"""
    for edge, off in ((0.005, 1e-5), (0.005, -1e-5), (1.0, 1e-5), (1.0, -2e-3)):
        hull = box(8 * edge, 4 * edge, edge, counts=(8, 4, 1), symmetry="y")
        points = hull.points + np.where(hull.points[:, 2:] == 0, (0, 0, off), 0)
        write_mesh(replace(hull, points=points), tmp_path / "a.gdf")
        mesh = read_mesh(tmp_path / "a.gdf")
        assert findings(mesh) == [], (edge, off)
        assert lid(mesh).areas.sum() == pytest.approx(16 * edge**2, rel=1e-9)
    deck = structured(np.array([[[-4, 0, -0.01], [-4, 2, -0.01]], [[4, 0, -0.01], [4, 2, -0.01]]]))
    write_mesh(joined([hull, replace(deck, symmetry="y")]), tmp_path / "a.gdf")
    assert len(read_mesh(tmp_path / "a.gdf")) == len(hull) + 1


NODES = "1 0 0 -1\n2 1 0 -1\n3 1 1 -1\n4 0 1 -1\n5 0.5 0.5 0\n"
PYRAMID = ((1, 4, 3, 2), (1, 2, 5), (2, 3, 5), (3, 4, 5), (4, 1, 5))


def rows_of(form, corners=PYRAMID):
    return "".join(f"{form.format(k)}{' '.join(map(str, row))}\n" for k, row in enumerate(corners, 1))


def aqwa():
    points = "".join(f"     1{i:5d}          {x:>9.4f}{y:>10.4f}{z:>10.4f}\n"
                     for i, x, y, z in (map(float, line.split()) for line in NODES.splitlines())
                     for i in (int(i),))  # fmt: skip
    panels = "".join(f"     1{'Q' if len(row) == 4 else 'T'}PPL DIFF   14(1)" + "".join(f"({n:5d})" for n in row) + "\n"
                     for row in PYRAMID)  # fmt: skip
    return f"********* DECK  1 ****\n          COOR\n      STRC        1\n{points} END\n********* DECK  2 ****\n" \
        f"          ELM1      Body1\n      ZLWL          (        0.)\n{panels} END\n          FINI\n"  # fmt: skip


def corners_of_pyramid():
    """(5, 4) places as text; triangles repeat their last corner"""
    places = {int(number): " ".join(at) for number, *at in map(str.split, NODES.splitlines())}
    return [[places[number] for number in (*row, row[-1])[:4]] for row in PYRAMID]


def tecplot():
    """One zone of WAMIT's panels for Tecplot: corners, then panels"""
    points = "".join(f"  {place}\n" for row in corners_of_pyramid() for place in row)
    panels = "".join(f" {k} {k + 1} {k + 2} {k + 3}\n" for k in range(1, 21, 4))
    return f'ZONE T="BODY PANEL", I= 20, J= 5, F=FEPOINT\n{points}{panels}'


LISTS = {
    "a_pan.dat": tecplot(),
    "a.dat": NODES + "*RETURN\n" + rows_of("{} "),
    "salome.dat": "5 6\n" + NODES + "9 102 1 2\n" + "".join(
        f"{k} {200 + len(row)} {' '.join(map(str, row))}\n" for k, row in enumerate(PYRAMID, 1)),
    "aqwa.dat": aqwa(),
    "a.hst": f"PROJECT: by hand\nNBODY 1\nCOORDINATES\n{NODES}ENDCOORDINATES\nPANEL TYPE 0\n{rows_of('')}ENDPANEL\n",
    "b.hst": f"NBBODY 1\nCOORDINATES\n{NODES}ENDCOORDINATES\nPANEL TYPE 1\n{rows_of('{} ')}ENDPANEL\nENDFILE\n",
    "a.mar": "2 0\n" + NODES + "0 0. 0. 0.\n" + rows_of("", [(*row, row[0])[:4] for row in PYRAMID]) + "0 0 0 0\n",
}  # fmt: skip


@pytest.mark.parametrize("name", LISTS)
def test_lists_of_points_and_panels_of_other_programs_are_read(tmp_path, name):
    """A pyramid on a square of 1 m, 1 m high: 1/3 m³"""
    (tmp_path / name).write_text(LISTS[name])
    mesh = read_mesh(tmp_path / name)
    assert len(mesh) == 5
    np.testing.assert_allclose(mesh.volume, 1 / 3, rtol=1e-12)
    assert findings(mesh) == []


def test_zones_of_one_panel_have_images_turned_out_and_no_lid(tmp_path):
    """The pyramid and its images in x = 0, y = 0 and both: corners in the order of the original, so that the normals of
    two images point inward, and a lid of each"""
    each = [*corners_of_pyramid(), ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]]
    zones = ""
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        for a, b, c, d in each:
            places = (np.array(place.split(), float) * (x, y, 1) for place in (a, b, d, c))
            zones += "zone I=  2 J=  2 F=POINT\n" + "".join(f"{' '.join(map(str, place))}\n" for place in places)
    (tmp_path / "a_pan.dat").write_text(zones)
    mesh = read_mesh(tmp_path / "a_pan.dat")
    assert len(mesh) == 20 and mesh.volume == pytest.approx(4 / 3, rel=1e-12)
    quarter = (mesh.centroids[:, :2] > 0) @ [1, 2]
    parts = np.bincount(quarter, np.einsum("ni,ni->n", mesh.centroids, mesh.area_vectors) / 3)
    assert parts == pytest.approx([1 / 3] * 4, rel=1e-12)


def test_symmetries_of_hydrostar_and_aqwa_are_mirror_planes(tmp_path):
    half = "1 0 0 -1\n2 1 0 -1\n3 1 1 -1\n4 0 1 -1\n5 0 0 0\n6 1 0 0\n7 1 1 0\n8 0 1 0\n"
    faces = ((1, 4, 3, 2), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))
    (tmp_path / "a.hst").write_text(
        f"SYMMETRY_BODY 1 1\nNBBODY 1\nCOORDINATES\n{half}ENDCOORDINATES\nPANEL TYPE 0\n{rows_of('', faces)}ENDPANEL\n"
    )
    mesh = read_mesh(tmp_path / "a.hst")
    assert (mesh.symmetry, mesh.volume) == ("y", pytest.approx(2.0))
    (tmp_path / "a.hst").write_text((tmp_path / "a.hst").read_text().replace("SYMMETRY_BODY 1 1", "SYMMETRY_BODY 1"))
    assert read_mesh(tmp_path / "a.hst").symmetry == ""


def test_polygons_of_vtk_are_read_and_lines_are_told(tmp_path, capfd):
    """In one line of ours: the library itself, which would print many, is kept quiet"""
    pyvista = pytest.importorskip("pyvista")
    points = [[float(word) for word in line.split()[1:]] for line in NODES.splitlines()]
    faces = [number for row in PYRAMID for number in (len(row), *(n - 1 for n in row))]
    pyvista.PolyData(points, faces).save(tmp_path / "a.vtp")
    assert read_mesh(tmp_path / "a.vtp").volume == pytest.approx(1 / 3, rel=1e-6)
    pyvista.PolyData(points, faces).save(tmp_path / "points.vtp", binary=False)
    text = (tmp_path / "points.vtp").read_text()
    (tmp_path / "points.vtp").write_text(re.sub(r"(connectivity.*?>\s+)\d+", r"\1-1", text, flags=re.DOTALL))
    with pytest.raises(ValueError, match="3 or more corners, all of them points"):
        read_mesh(tmp_path / "points.vtp")
    pyvista.Line().save(tmp_path / "line.vtp")
    with pytest.raises(ValueError, match=r"line\.vtp: it has lines, points or strips, but no polygons"):
        read_mesh(tmp_path / "line.vtp")
    pyvista.PolyData(points).save(tmp_path / "cloud.vtp")
    with pytest.raises(ValueError, match=r"cloud\.vtp: it has lines, points or strips, but no polygons"):
        read_mesh(tmp_path / "cloud.vtp")
    pyvista.PolyData(points, strips=[4, 0, 1, 2, 3]).save(tmp_path / "strip.vtp")
    with pytest.raises(ValueError, match=r"strip\.vtp: it has lines, points or strips, but no polygons"):
        read_mesh(tmp_path / "strip.vtp")
    pyvista.PolyData().save(tmp_path / "none.vtp")
    with pytest.raises(ValueError, match=r"none\.vtp: it cannot be read, or it is empty; allowed: polygons"):
        read_mesh(tmp_path / "none.vtp")
    (tmp_path / "cut.vtp").write_bytes((tmp_path / "a.vtp").read_bytes()[:700])
    pytest.importorskip("vtkmodules.vtkCommonCore").vtkObject.GlobalWarningDisplayOn()
    capfd.readouterr()
    with pytest.raises(ValueError, match=r"cut\.vtp"):
        read_mesh(tmp_path / "cut.vtp")
    assert capfd.readouterr() == ("", "")


WRONG = {
    "lid.pnl": ("1 4 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n1 4 1 2 3 4\n", "a lid or a deck"),
    "wamit.hst": (" 3 3 1.0E+00\n", "no COORDINATES"),
    "two.dat": (aqwa().replace("FINI", "FINI\n ELM2\n     1TPPL DIFF   14(1)(    1)(    2)(    5)"), "2 structures"),
    "gone.dat": (LISTS["a.dat"].replace("4 3 2", "4 3 9"), "line 7: there is no point 9"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_a_list_cannot_be_is_told(tmp_path, name):
    text, words = WRONG[name]
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=words):
        read_mesh(tmp_path / name)


def test_a_bottom_in_the_water_surface_is_kept(tmp_path):
    raft = structured(np.array([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0.0]]])).flipped()
    assert raft.normals[0, 2] < 0
    write_mesh(raft, tmp_path / "raft.gdf")
    assert len(read_mesh(tmp_path / "raft.gdf")) == 1


def test_fields_go_with_their_panels(tmp_path):
    import meshio

    hull = buoy(10, 10, panels=124)
    write_mesh(hull, tmp_path / "a.vtu", lid(hull), {"height": hull.centroids[:, 2]})
    found = meshio.read(tmp_path / "a.vtu")
    for kind, values in found.cell_data_dict["height"].items():
        on_hull = found.cell_data_dict["lid"][kind] == 0
        z = found.points[found.cells_dict[kind]][..., 2].mean(axis=1)
        np.testing.assert_allclose(values[on_hull], z[on_hull], atol=1e-9)
        assert np.isnan(values[~on_hull]).all()


def test_a_gmsh_file_has_hull_and_lid_as_groups(tmp_path):
    import meshio

    hull = box(10, 5, 2, panels=40)
    write_mesh(hull, tmp_path / "a.msh", lid(hull))
    assert set(meshio.read(tmp_path / "a.msh").field_data) == {"hull", "lid"}


BAD = {
    "short.gdf": ("one line\n", "1 lines"),
    "word.gdf": ("h\n1 9.81\n0 0\n1\n1 2 3 4 five\n", "line 5: 'five' is not a finite number"),
    "few.gdf": ("h\n1 9.81\n0 0\n1\n1 2 3\n", "3 coordinates after line 4; 1 panels need 12"),
    "gravity.gdf": ("h\n1 1.0\n0 0\n0\n", "GRAV is 1; allowed"),
    "wall.gdf": ("h\n1 9.81\n-1 0\n0\n", "symmetry -1 0"),
    "patches.gdf": ("h\n1 9.81\n0 0\n4 -10\n", "'4 -10' is a higher-order file of kind -10; allowed: flat panels"),
    "none.gdf": ("h\n1 9.81\n0 0\n0 1\n", "0 patches; allowed: 1 or more"),
    "point.gdf": ("h\n1 9.81\n0 0\n1 1\n1 1\n2 2\n0 0 1 1\n0 0 1 1\n" + "0 0 0\n" * 4, "its patches have no size"),
    "cut.gdf": ("h\n1 9.81\n0 0\n1 1\n1 1\n2 2\n0 0 1 1\n0 0 1 1\n0 0 0 1 0 0\n", "it ends within a patch"),
    "order.gdf": ("h\n1 9.81\n0 0\n1 1\n1 1\n0 2\n", "spans and order [0, 2]; allowed: 1 or more"),
    "letters.gdf": ("h\n1 9.81\n0 0\n1 1\n1 1\nx 2\n", "the text after line 4 contains something other than numbers"),
    "empty.gdf": ("h\n1 9.81\n0 0\n0\n", "no panels"),
    "far.obj": ("v 0 0 0\nf 1 2 1000000000000000000000\n", "line 2: there is no point 2; the file has 1"),
    "inf.nemoh": ("2 0\ninf 0 0 0\n0 0 0 0\n1 1 1 1\n0 0 0 0\n", "line 2: 'inf' is not a finite number"),
    "nan.gdf": ("h\n1 9.81\n0 0\n1\n" + "nan " * 12, "not a finite number"),
    "one nan.gdf": ("h\n1 9.81\n0 0\n1\n0 0 0 1 0 0 1 1 0 nan 1 0\n", "line 5: 'nan' is not a finite number"),
    "head.nemoh": ("1 2 3\n", "line 1"),
    "open.nemoh": ("2 0\n1 0 0 0\n", "after the points"),
    "point.dat": ("2 0\n1 0 0 0\n0 0 0 0\n1 2 3 4\n0 0 0 0\n", "line 4: there is no point 2"),
    "half.nemoh": ("2 0\n1 0 0 -1\n2 1 0 -1\n0 0 0 0\n1 2 1.5\n0 0 0 0\n", "there is no point 1.5"),
    "huge.ply": ("ply\nformat ascii 1.0\nelement vertex 100000000000\nend_header\n", "it announces 1e+11 points"),
    "huge.vtu": ('<Piece NumberOfPoints="100000000000" NumberOfCells="1">', "it announces 1e+11 points"),
    "huge.vtk": ("# vtk\nx\nASCII\nDATASET POLYDATA\nPOINTS 900000000 float\n", "it announces 9e+08 points"),
    "huge.msh": ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n900000000\n", "it announces 9e+08 points"),
    "huge.off": ("OFF\n4 900000000 0\n", "it announces 9e+08 points"),
    "empty.pnl": ("nothing\n", "no line with numbers"),
    "count.pnl": ("2 4 0 0\n1 0 0 0\n", "4 nodes and 2 panels need 6"),
    "five.pnl": ("1 1 0 0\n1 0 0 0\n1 5 1 1 1 1 1\n", "line 3: a panel has"),
    "bad.msh": ("hello", "cannot be read"),
    "bad.vtu": ("hello", "cannot be read"),
    "bad.stl": ("hello", "cannot be read"),
    "bad.ply": ("hello", "ends within its head"),
    "bad.off": ("hello", "ends within its head"),
    "half.ply": ("ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty", "ends within its head"),
    "half.off": ("OFF\n# a comment\n\n", "ends within its head"),
    "points.obj": ("v 0 0 0\n", "no panels"),
    "two.obj": ("v 0 0 0\nf 1 1\n", "line 2 has 2 nodes; a panel has 3 or 4"),
    "bad.xyz": ("hello", "cannot read .xyz; allowed: .gdf"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_named_with_what_is_wrong(tmp_path, capsys, name):
    text, words = BAD[name]
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError) as caught:
        read_mesh(tmp_path / name)
    assert words in str(caught.value)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)
    assert capsys.readouterr().out == ""


def test_a_binary_stl_that_is_cut_off_says_how_much_is_lost(tmp_path):
    import meshio

    points, triangles = tetrahedron()
    meshio.Mesh(points, [("triangle", triangles)]).write(tmp_path / "a.stl", binary=True)
    (tmp_path / "a.stl").write_bytes((tmp_path / "a.stl").read_bytes()[:200])
    with pytest.raises(ValueError, match="its header announces 3 triangles in 234 bytes, but the file has 200"):
        read_mesh(tmp_path / "a.stl")


def test_the_unit_of_lengths_follows_gravity_within_a_hundredth():
    """m from 9.7 to 9.9 m/s², feet from 31.8 to 32.5 ft/s²"""
    from hakobune.meshing.text_formats import length_unit

    assert length_unit("a", 9.71) == length_unit("a", 9.89) == 1.0
    assert length_unit("a", 31.81) == length_unit("a", 32.49) == 0.3048
    for gravity in (9.69, 9.91, 31.79, 32.51):
        with pytest.raises(ValueError, match=f"a, line 2: GRAV is {gravity:g}; allowed: 9.80665"):
            length_unit("a", gravity)


def test_suffixes_are_read_and_written_in_capitals(tmp_path):
    for suffix in (".GDF", ".VTU", ".PNL"):
        write_mesh(box(10, 5, 2, panels=40), tmp_path / f"a{suffix}")
        assert read_mesh(tmp_path / f"a{suffix}").volume == pytest.approx(100)


def test_a_file_of_more_than_32_megabytes_is_refused_unread(tmp_path):
    for size, words in ((31.9e6, "not text|lines; a GDF"), (32.1e6, "has 32 MB; allowed: up to 32 MB")):
        with (tmp_path / "a.gdf").open("wb") as file:
            file.truncate(int(size))
        with pytest.raises(ValueError, match=words):
            read_mesh(tmp_path / "a.gdf")


def test_any_of_several_counts_is_held_against_the_size_of_the_file(tmp_path):
    """One of points that is right does not vouch for one of panels; a compressed file may hold a thousand a byte"""
    head = "ply\nformat ascii 1.0\nelement vertex 3\nelement face {}\nend_header\n"
    size = len(head.format(10))
    for count, words in (
        (size, "cannot be read"),
        (size + 1, f"it announces {size + 1} points or panels, too many for its {size}"),
    ):
        (tmp_path / "a.ply").write_text(head.format(count))
        with pytest.raises(ValueError, match=words):
            read_mesh(tmp_path / "a.ply")
    text = '<Piece NumberOfPoints="3" NumberOfCells="{}">'
    for count, words in ((40 * 1000, "cannot be read"), (55 * 1000, "it announces 55000 points")):
        (tmp_path / "a.vtu").write_text(text.format(count))
        assert 40 <= len(text.format(count)) <= 52
        with pytest.raises(ValueError, match=words):
            read_mesh(tmp_path / "a.vtu")


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.off", "OFF\n3 1 0\n0 0 -1\nnan 0 -1\n1 1 -1\n3 0 1 2\n", "a coordinate is not a finite number"),
        ("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0 0 -1 1 0 -1\n"
         "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n3\n", "contains line; allowed: triangle, quad"),
        ("a", "", "cannot read a file without suffix; allowed: .gdf"),
        ("short.pnl", "1 4 0 0\n1 0 0 -1\n2 1 0 -1\n3 1 1\n4 0 1 -1\n1 4 1 2 3 4\n", "line 4 has 3 numbers; a node"),
        ("three.pnl", "1 3 0 0\n1 0 0 -1\n2 1 0 -1\n3 1 1 -1\n1 4 1 2 3\n", "line 5: a panel has a number, then 3 or "
            "4"),
        ("short.nemoh", "2 0\n1 0 0\n0 0 0 0\n", "line 2 has 3 values; a point needs four: its number"),
        ("side.nemoh", "2 2\n", "line 1 is neither '2 0' nor '2 1';"),
        ("few.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3 has 2 nodes; a panel has 3 or 4"),
        ("zero.pnl", "1 3 1 2\n", "symmetry 1 2; allowed: 0 or 1 each"),
        ("ninth.pnl", "1 3 0 0\n1 0 0 -1\n2 1 0 -1\n3 1 1 -1\n1 3 1 2 9\n", "ninth.pnl, line 5: there is no point 9; "
            "the file has 3"),
    ],
)  # fmt: skip
def test_more_that_cannot_be_read_is_named(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError) as caught:
        read_mesh(tmp_path / name)
    assert words in str(caught.value) and name in str(caught.value)


def test_as_many_triangles_as_quadrilaterals_are_panels(tmp_path):
    import meshio

    points = np.array([[0, 0, -1], [0, 1, -1], [1, 1, -1], [1, 0, -1], [2, 0, -1.0]])
    meshio.Mesh(points, [("quad", [[0, 1, 2, 3]]), ("triangle", [[3, 2, 4]])]).write(tmp_path / "a.vtu")
    np.testing.assert_allclose(read_mesh(tmp_path / "a.vtu").area_vectors, [[0, 0, -1], [0, 0, -0.5]])


def test_words_that_are_too_long_to_show_are_cut(tmp_path):
    for length, shown in ((40, "x" * 40), (41, "x" * 40 + "…")):
        (tmp_path / "a.gdf").write_text("h\n1 9.81\n0 0\n1\n" + "x" * length + "\n")
        with pytest.raises(ValueError, match=f"line 5: '{shown}' is not a finite number"):
            read_mesh(tmp_path / "a.gdf")


def test_files_of_points_by_number_are_read_in_any_order_and_with_triangles(tmp_path):
    """A half of a tetrahedral hole: points numbered 5, 9, 2, 7; of HAMS with a panel of three and one of four"""
    points = "5 0 0 -1\n9 2 0 -1\n2 2 1 -1\n7 0 1 -1\n"
    (tmp_path / "a.nemoh").write_text(f"2 1\n{points}0 0. 0. 0.\n7 2 9 5\n5 9 2\n0 0 0 0\n")
    (tmp_path / "a.pnl").write_text(
        f"2 4 0 1 ! counts\n\n# nodes\n{points}# panels\n1 4 7 2 9 5\n2 3 5 9 2 7 1\n# end\n"
    )
    for name in ("a.nemoh", "a.pnl"):
        mesh = read_mesh(tmp_path / name)
        assert mesh.symmetry == "y" and len(mesh) == 2
        np.testing.assert_allclose(mesh.area_vectors, [[0, 0, -2], [0, 0, 1]])
    (tmp_path / "xy.pnl").write_text(f"1 4 1 0\n{points}1 4 7 2 9 5\n")
    assert read_mesh(tmp_path / "xy.pnl").symmetry == "x"


def test_every_number_of_a_file_of_hams_is_where_its_manual_has_it(tmp_path):
    """Panels, nodes, x and y symmetry; number x y z; number, how many, nodes, quadrilaterals first"""
    hull = replace(buoy(10, 10, counts=(2, 2, 2)), symmetry="y", name="pile")
    write_mesh(hull, tmp_path / "a.pnl")
    text = (tmp_path / "a.pnl").read_text()
    rows = [line.split() for line in text.splitlines() if line.strip() and line.split()[0].isdigit()]
    assert "pile" in text.splitlines()[0]
    count, points = len(hull), len(hull.points)
    assert rows[0] == [str(count), str(points), "0", "1"] and len(rows) == 1 + points + count
    for k, row in enumerate(rows[1 : 1 + points]):
        assert int(row[0]) == k + 1
        np.testing.assert_array_equal(np.array(row[1:], float), hull.points[k])
    kinds = [int(row[1]) for row in rows[1 + points :]]
    assert kinds == sorted(kinds, reverse=True) and kinds.count(3) == 2
    assert [int(row[0]) for row in rows[1 + points :]] == list(range(1, count + 1))
    corners = {frozenset(map(int, row[2:])) for row in rows[1 + points :]}
    assert corners == {frozenset((panel + 1).tolist()) for panel in hull.corners}
    write_mesh(replace(hull, name=""), tmp_path / "a.pnl")
    assert "Hull Mesh File" in (tmp_path / "a.pnl").read_text().splitlines()[0]


def test_every_number_of_a_file_of_wamit_is_where_its_manual_has_it(tmp_path):
    """Title; ULEN GRAV; ISX ISY; NPAN; corners"""
    hull = replace(box(10, 6, 2, counts=(1, 1, 1)), symmetry="x", name="half a box")
    write_mesh(hull, tmp_path / "a.gdf")
    lines = (tmp_path / "a.gdf").read_text().splitlines()
    assert lines[0] == "half a box" and lines[1].split()[:2] == ["1.0", "9.80665"]
    assert lines[2].split()[:2] == ["1", "0"] and lines[3].split()[0] == "3"
    np.testing.assert_array_equal(np.array([line.split() for line in lines[4:]], float), hull.vertices.reshape(-1, 3))
    write_mesh(replace(hull, name=""), tmp_path / "a.gdf")
    assert (tmp_path / "a.gdf").read_text().startswith("panel mesh\n")


def test_a_panel_of_two_corners_cannot_be_written_as_one(tmp_path):
    hull = box(10, 6, 2, counts=(1, 1, 1))
    corners = hull.corners.copy()
    corners[1] = corners[1][[0, 0, 1, 1]]
    with pytest.raises(ValueError, match="panel 1 has fewer than three different corners"):
        write_mesh(replace(hull, corners=corners), tmp_path / "a.pnl")


def test_a_missing_file_is_missing(tmp_path):
    with pytest.raises(FileNotFoundError, match="no such file"):
        read_mesh(tmp_path / "absent.gdf")


def test_what_cannot_be_written_is_named(tmp_path):
    hull = box(10, 5, 2, panels=40)
    with pytest.raises(ValueError, match=r"cannot write .stl; allowed: .gdf"):
        write_mesh(hull, tmp_path / "a.stl")
    with pytest.raises(ValueError, match="file cannot store fields"):
        write_mesh(hull, tmp_path / "a.gdf", fields={"a": np.zeros(len(hull))})
    with pytest.raises(ValueError, match=r"field 'a' has shape \(3,\)"):
        write_mesh(hull, tmp_path / "a.vtu", fields={"a": np.zeros(3)})


def test_everything_written_can_be_read():
    assert set(WRITABLE) <= set(READABLE)


def test_a_packed_file_holds_a_thousand_values_a_byte_and_no_more(tmp_path):
    """zlib packs at most 1032 to 1 (its technical details)"""
    from hakobune.meshing.files import _check_counts

    path = tmp_path / "a.vtu"
    path.write_text('<Piece NumberOfPoints="100000">'.ljust(100))
    _check_counts(path)
    path.write_text('<Piece NumberOfPoints="100001">'.ljust(100))
    with pytest.raises(ValueError, match="it announces 100001 points"):
        _check_counts(path)


def test_slivers_that_merging_closes_up_are_no_panels(tmp_path):
    """A cube of 1 m whose corner C was drawn twice, 5e-7 m apart, with two slivers between: 10 triangles are left"""
    A, B, C, D, near = (0, 0, -1), (1, 0, -1), (1, 1, -1), (0, 1, -1), (1, 1 - 5e-7, -1)
    a, b, c, d = ((x, y, 0) for x, y, _ in (A, B, C, D))
    drawn = [(A, D, C), (A, C, near), (A, near, B), (B, near, b), (near, C, c), (near, c, b), (A, B, b), (A, b, a),
             (C, D, d), (C, d, c), (D, A, a), (D, a, d)]  # fmt: skip
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x} {y} {z}\n" for x, y, z in three)
        + "endloop\nendfacet\n"
        for three in drawn
    )
    (tmp_path / "cube.stl").write_text(f"solid cube\n{facets}endsolid\n")
    mesh = read_mesh(tmp_path / "cube.stl")
    assert mesh.total == 10 and mesh.volume == pytest.approx(1.0, rel=1e-6)
    assert [one.text for one in findings(mesh) if one.severity == "error"] == []
