"""What meshes, drawings and their numbers may be, from both sides of each limit, with what is said beyond it."""

import math

import numpy as np
import pytest

from hakobune.meshing.drawing import drawing_of
from hakobune.meshing.files import read_mesh, write_mesh
from hakobune.meshing.hydrostatics import inertia_matrix
from hakobune.meshing.panels import joined
from hakobune.meshing.shapes import box

BLOCK = {"shape": "box", "center": [0.0, 0.0, -1.0], "size": [4.0, 2.0, 2.0]}
TUBE = {"shape": "cylinder", "from": [0.0, 0.0, -3.0], "to": [0.0, 0.0, 1.0], "radius": 1.0}
SHEER = {"shape": "outline", "points": [[-2.0, 0.0], [0.0, -2.0], [2.0, 0.0]], "breadth": 3.0}
BOX = box(10.0, 5.0, 2.0, panels=40)


def drawing(**more):
    return drawing_of({"size": 1.0, "parts": [BLOCK]} | more)


def part(**more):
    return drawing(parts=[BLOCK | more])


def tube(**more):
    return drawing(parts=[TUBE | more])


def spun(*radii):
    return inertia_matrix(1.0, (0.0, 0.0, 0.0), radii)


LIMITS = {
    "panels around a circle": (lambda n: drawing(around=n), 8, 7,
        "around is 7; allowed: 8 to 200 panels around a circle"),
    "many on a circle": (lambda n: drawing(around=n), 200, 201,
        "around is 201; allowed: 8 to 200 panels around a circle"),
    "mirror planes": (lambda s: drawing(symmetry=s), "xy", "yx", "symmetry is 'yx'; allowed: x, y, xy"),
    "parts": (lambda n: drawing(parts=[BLOCK] * n), 1, 0, "there are no parts; allowed: size"),
    "key of a drawing": (lambda key: drawing(**{key: 24}), "around", "round", "round is unknown; allowed: size"),
    "the first of two keys": (lambda key: drawing(**{key: 24, "zoom": 1}) if key else drawing(), "", "ground",
        "ground is"),
    "place": (lambda p: part(center=p), [0.0, 0.0, -1.0], [0.0, math.inf, -1.0], "parts[0].center is [0.0, inf, -1.0]"),
    "numbers of a place": (lambda p: part(center=p), [0.0, 0.0, 0.0], [0.0, 0.0], "allowed: three finite numbers in m"),
    "size": (lambda s: part(size=[4.0, s, 2.0]), 1e-3, 0.0, "parts[0] has no size; allowed: lengths above 0"),
    "length of a tube": (lambda z: tube(to=[0.0, 0.0, z]), -2.9, -3.0,
     "parts[0] has no size; allowed: lengths above 0"),
    "radius": (lambda r: tube(radius=r), 0.1, 0.0, "parts[0]"),
    "second size of a box": (
        lambda keys: drawing(parts=[{key: BLOCK[key] for key in keys}]), BLOCK, ("shape", "center"),
        "parts[0].size is missing; a box needs center, size"),
    "first size of a box": (lambda keys: drawing(parts=[{key: BLOCK[key] for key in keys}]), BLOCK, ("shape", "size"),
        "parts[0].center is missing; a box needs center, size"),
    "radius of a tube": (lambda keys: drawing(parts=[{key: TUBE[key] for key in keys}]), TUBE, ("shape", "from", "to"),
        "parts[0].radius is missing; a cylinder needs from, to, radius"),
    "radius of an end": (lambda r: tube(end_radius=r), 0.1, -0.1, "parts[0]: end_radius is -0.1; allowed: m, above 0"),
    "breadth of an outline": (lambda b: drawing(parts=[SHEER | {"breadth": b}]), 0.1, 0.0, "parts[0]: breadth is 0.0"),
    "points of an outline": (lambda p: drawing(parts=[SHEER | {"points": p}]), SHEER["points"], [[0.0], [1.0], [2.0]],
        "parts[0].points is not a list of points [x, z]; allowed: three points or more, in m"),
    "end of a tube": (lambda z: tube(to=[0.0, 0.0, z]), 2.0, math.inf,
        "parts[0].to is [0.0, 0.0, inf]; allowed: three"),
    "numbers of a size": (lambda s: part(size=s), [1.0, 1.0, 1.0], [1.0, 1.0], "parts[0].size is [1.0, 1.0]; allowed"),
    "turns": (lambda n: part(turns=n), 24, 25, "parts[0].turns is 25; allowed: 1 to 24"),
    "no turn": (lambda n: part(turns=n), 1, 0, "parts[0].turns is 0; allowed: 1 to 24"),
    "shape": (lambda s: part(shape=s), "box", "bax", "parts[0].shape is 'bax'; allowed: "),
    "radii of gyration": (lambda r: spun(1.0, r, 1.0), 0.0, -0.1,
     "gyration is (1.0, -0.1, 1.0) m; allowed: three radii"),
    "finite radii": (lambda r: spun(1.0, r, 1.0), 9.0, math.inf, "gyration is (1.0, inf, 1.0); allowed: three finite"),
    "mirror planes of two": (
        lambda mesh: joined([BOX, mesh]), BOX, BOX.whole(),
        "meshes to join have different symmetry ['', 'xy']; use whole",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITS)
def test_meshes_are_taken_up_to_their_limits_and_refused_beyond(name):
    make, good, bad, says = LIMITS[name]
    make(good)
    with pytest.raises(ValueError) as refused:
        make(bad)
    assert says in str(refused.value)


@pytest.mark.parametrize("line, new, says", [
    (1, "1.0", "line 2 is '1.0'; it needs 2 numbers"),
    (2, "1 2", "line 3: symmetry 1 2; allowed: 0 or 1 each"),
    (3, "10 1", "a patch has [0, 0] spans and order [-2, 0]; allowed: 1 or more"),
])  # fmt: skip
def test_lines_of_a_wamit_mesh_say_what_they_may(line, new, says, tmp_path):
    path = tmp_path / "hull.gdf"
    write_mesh(BOX, path)
    assert read_mesh(path).volume == pytest.approx(100.0)
    lines = path.read_text().splitlines()
    lines[line] = new
    path.write_text("\n".join(lines))
    with pytest.raises(ValueError) as refused:
        read_mesh(path)
    assert says in str(refused.value)


def test_a_field_on_a_mesh_has_one_value_a_panel(tmp_path):
    path = tmp_path / "hull.vtu"
    write_mesh(BOX, path, fields={"pressure": np.arange(float(len(BOX)))})
    with pytest.raises(ValueError) as refused:
        write_mesh(BOX, path, fields={"pressure": np.zeros(len(BOX) + 1)})
    assert f"field 'pressure' has shape ({len(BOX) + 1},); allowed: ({len(BOX)},), one value for each panel" in str(
        refused.value
    )


def test_a_gdf_without_its_header_is_told_as_that(tmp_path):
    (tmp_path / "bare.gdf").write_text("10.0 5.0 -10.0\n" * 8)
    with pytest.raises(ValueError, match="begins with coordinates; a GDF file has a header, ULEN GRAV"):
        read_mesh(tmp_path / "bare.gdf")
