"""Parts of a drawing as they are asked of the geometry kernel, which is replaced: places, axes, radii, cuts, and which
surfaces are wetted; and what a part may not be."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing import drawing


class Kernel:
    """Notes what is asked; every solid, point, line and surface has the next number"""

    def __init__(self):
        self.asked = []

    def __getattr__(self, name):
        def call(*given):
            self.asked.append((name, *given))
            if name == "extrude":
                return [(2, 7), (3, 40), (2, 8)]
            if name == "intersect":
                return [(3, 90), (3, 91)], "map"
            return len(self.asked)

        return call


def solid(part, grown=1.5, seam=0.25):
    kernel = Kernel()
    return drawing._solid(kernel, part, grown, seam), kernel.asked


CYLINDER = {"shape": "cylinder", "from": [1, 2, -9], "to": [1, 6, 3], "radius": 2.0}


def test_a_cylinder_goes_from_one_end_to_the_other_with_its_seam_turned_about_its_axis():
    """4 m along y and 12 up; the radius grows"""
    tag, (first, second) = solid(CYLINDER)
    assert tag == 1 and first == ("addCylinder", 1, 2, -9, 0, 4, 12, 3.0)
    assert second == ("rotate", [(3, 1)], 1, 2, -9, 0, 4, 12, 0.25)


@pytest.mark.parametrize("end, cone", [(2.0, False), (1.0, True), (3.0, True)])
def test_a_cone_has_two_radii_that_grow_alike(end, cone):
    _, (first, _) = solid(CYLINDER | {"end_radius": end})
    assert first == (
        ("addCone", 1, 2, -9, 0, 4, 12, 3.0, 1.5 * end) if cone else ("addCylinder", 1, 2, -9, 0, 4, 12, 3.0)
    )


def test_a_box_lies_about_its_middle_and_does_not_grow():
    tag, asked = solid({"shape": "box", "center": [10, 20, -3], "size": [8, 4, 6]})
    assert tag == 1 and asked == [("addBox", 6, 18, -6, 8, 4, 6)]


def test_a_sphere_grows_about_its_middle():
    assert solid({"shape": "sphere", "center": [1, 2, -3], "radius": 4.0}) == (1, [("addSphere", 1, 2, -3, 6.0)])


@pytest.mark.parametrize("y, begin", [(None, -5.0), (3.0, -2.0)])
def test_an_outline_is_a_closed_side_view_drawn_out_over_its_breadth(y, begin):
    part = {"shape": "outline", "points": [[0, 0], [10, 0], [5, -4]], "breadth": 10.0} | ({} if y is None else {"y": y})
    tag, asked = solid(part)
    assert tag == 40
    assert asked[:3] == [("addPoint", 0, begin, 0), ("addPoint", 10, begin, 0), ("addPoint", 5, begin, -4)]
    assert [sorted(one[1:]) for one in asked[3:6]] == [[1, 2], [2, 3], [1, 3]]
    assert asked[6:] == [
        ("addCurveLoop", [4, 5, 6]), ("addPlaneSurface", [7]), ("extrude", [(2, 8)], 0, 10.0, 0),
    ]  # fmt: skip


@pytest.mark.parametrize("turn", [0.0, 2.0])
def test_a_copy_is_turned_about_the_vertical_through_the_origin(turn):
    kernel = Kernel()
    part = {"shape": "sphere", "center": [1, 2, -3], "radius": 4.0}
    assert drawing._placed(kernel, part, turn, 1.0, 0.0) == (3, 1)
    assert kernel.asked[1:] == ([("rotate", [(3, 1)], 0, 0, 0, 0, 0, 1, 2.0)] if turn else [])


@pytest.mark.parametrize("symmetry, low", [("", (-42, -31, -27)), ("x", (0, -31, -27)), ("xy", (0, 0, -27))])
def test_what_is_meshed_lies_below_the_water_on_the_positive_side_of_its_mirror_planes(symmetry, low):
    """A body of 30 by 20 by 12 m from (−12, −1, 3): 30 m are left around it"""
    kernel = Kernel()
    begin, end = np.array([-12.0, -1.0, 3.0]), np.array([18.0, 19.0, 15.0])
    assert drawing._below(kernel, ["body"], begin, end, symmetry) == [(3, 90), (3, 91)]
    high = np.array([48.0, 49.0, 0.0])
    box, cut = kernel.asked
    assert box == ("addBox", *low, *(high - low)) and cut == ("intersect", ["body"], [(3, 1)])
    assert begin.tolist() == [-12.0, -1.0, 3.0]


BOXES = {1: (0, 0, -5, 9, 9, -5), 2: (0, 0, 0, 9, 9, 0), 3: (0, 0, -5, 0, 9, 0), 4: (0, 0, -5, 9, 0, 0),
         5: (0, 0, -5, 9, 9, 0), 6: (0, 0, -2e-6, 9, 9, 1e-6)}  # fmt: skip


def geometry(areas=None):
    def boundary(body, combined, oriented):
        assert body == ["body"] and combined
        return [(2, -tag if oriented and tag == 3 else tag) for tag in BOXES]

    model = SimpleNamespace(
        getBoundingBox=lambda dim, tag: BOXES[tag] if dim == 2 else (1.0 * tag, 0, -tag, 2 * tag, 5, tag),
        getBoundary=boundary, occ=SimpleNamespace(getMass=lambda dim, tag: 10.0 * tag),
    )  # fmt: skip
    return SimpleNamespace(model=model)


@pytest.mark.parametrize("symmetry, wet", [("", [1, 3, 4, 5]), ("x", [1, 4, 5]), ("y", [1, 3, 5]), ("xy", [1, 5])])
def test_sides_in_the_surface_and_in_mirror_planes_are_not_wetted(symmetry, wet):
    assert drawing._wetted(geometry(), ["body"], 3e-6, symmetry) == wet
    assert 6 in drawing._wetted(geometry(), ["body"], 1e-7, symmetry)


def test_the_waterplane_is_what_of_the_boundary_lies_in_the_surface():
    assert drawing._waterplane(geometry(), ["body"], 3e-6) == 80.0
    assert drawing._waterplane(geometry(), ["body"], 1e-6) == 20.0


def test_a_body_extends_from_the_lowest_to_the_highest_of_its_parts():
    low, high = drawing._extent(geometry(), [(3, 2), (3, 5)])
    assert low.tolist() == [2, 0, -5] and high.tolist() == [10, 5, 5]


def raw(part=None, **more):
    return {"size": 1.0, "parts": [CYLINDER | (part or {})]} | more


@pytest.mark.parametrize("given, says", [
    (raw(around=8), None), (raw(around=200), None),
    (raw(around=7), "around is 7; allowed: 8 to 200 panels around a circle"),
    (raw(around=201), "around is 201"), (raw(around=24.0), "around is 24.0"), (raw(symmetry="yx"), "symmetry is 'yx'"),
    *((raw(symmetry=planes), None) for planes in ("", "x", "y", "xy")),
    (raw(parts=[CYLINDER] * 200), None), (raw(parts=[CYLINDER] * 201), "there are no parts; allowed: size, symmetry"),
    (raw(parts=[]), "there are no parts"), (raw(parts="p"), "there are no parts"),
    ({"size": 1.0}, "there are no parts"),
    (raw(zise=1), "zise is unknown; allowed: size, symmetry, around, and 1 to 200 tables [[parts]]"),
    (raw(size=0.0), "the drawing: size is 0.0; allowed: m, above 0"), (raw(size=[1.0]), "the drawing: size is [1.0]"),
    (raw(size="a"), "the drawing: size is a"), (raw(size=math.inf), "the drawing: size is inf"),
    (raw({"turns": 24}), None), (raw({"turns": 1}), None),
    (raw({"turns": 25}), "parts[0].turns is 25; allowed: 1 to 24"),
    (raw({"turns": 0}), "parts[0].turns is 0"),
    (raw({"shape": "cone"}), "parts[0].shape is 'cone'; allowed: cylinder, "),
    (raw({"y": 1.0}), "parts[0].y is unknown; allowed for a cylinder: from, to, radius, end_radius, shape, turns, cut"),
    (raw({"radius": 0.0}), "parts[0]: radius is 0.0"), (raw({"end_radius": -1.0}), "parts[0]: end_radius is -1.0"),
    (raw({"from": [1, 2]}), "parts[0].from is [1, 2]; allowed: three finite numbers in m"),
    (raw({"to": [1, 2, math.nan]}), "parts[0].to is [1, 2, nan]"), (raw({"to": [1, 2, -9]}), "parts[0] has no size"),
    (raw({"to": 3.0}), "parts[0].to is 3.0"),
])  # fmt: skip
def test_a_drawing_is_taken_up_to_its_limits(given, says):
    if says is None:
        made = drawing.drawing_of(given)
        assert (
            made.size == 1.0 and made.around == given.get("around", 24) and made.symmetry == given.get("symmetry", "")
        )
        return
    with pytest.raises(ValueError) as refused:
        drawing.drawing_of(given)
    assert str(refused.value).startswith(says)


BOX = {"shape": "box", "center": [0, 0, -1], "size": [4, 2, 2]}
SPHERE = {"shape": "sphere", "center": [0, 0, -1], "radius": 2.0}
OUTLINE = {"shape": "outline", "points": [[0, 0], [1, 0], [0, -1]], "breadth": 2.0, "y": 1.0}


@pytest.mark.parametrize("part, change, says", [
    (BOX, {"size": [4, 0, 2]}, "parts[1] has no size; allowed: lengths above 0"),
    (BOX, {"size": [4, 2]}, "parts[1].size is"),
    (BOX, {"center": None}, "parts[1].center is None"), (SPHERE, {"radius": -2.0}, "parts[1]: radius is -2.0"),
    (SPHERE, {"center": [0, 0]}, "parts[1].center is [0, 0]"), (OUTLINE, {"breadth": 0}, "parts[1]: breadth is 0"),
    (OUTLINE, {"points": [[0, 0, 0]]},
     "parts[1].points is not a list of points [x, z]; allowed: three points or more, in m"),
    (OUTLINE, {"points": [[0, "a"]]}, "parts[1].points is not a list"),
    *((part, {key: ...},
       f"parts[1].{key} is missing; a {part['shape']} needs {', '.join(drawing.NEEDED[part['shape']])}")
      for part in (CYLINDER, BOX, SPHERE, OUTLINE) for key in drawing.NEEDED[part["shape"]]),
])  # fmt: skip
def test_a_part_has_its_own_keys_and_sizes(part, change, says):
    drawing.drawing_of({"size": 1.0, "parts": [BOX, part]})
    wrong = {key: value for key, value in (part | change).items() if value is not ...}
    with pytest.raises(ValueError) as refused:
        drawing.drawing_of({"size": 1.0, "parts": [BOX, wrong]})
    assert str(refused.value).startswith(says)


def test_copies_stand_in_equal_steps():
    made = drawing.drawing_of(raw({"turns": 3}))
    assert [turn for _, turn in made.parts] == pytest.approx([0, 2 * math.pi / 3, 4 * math.pi / 3])
    assert all(part["shape"] == "cylinder" for part, _ in made.parts)


class Hull(SimpleNamespace):
    def whole(self):
        return SimpleNamespace(points=np.array([[0, 0, 0], [100.0, 20, -5]]))


@pytest.mark.parametrize("center, volume, plane, body_plane, off", [
    ((0.1, 0, 9), 1.0, 1.0, 1.0, 1.0), ((0, -0.2, 0), 1.0, 1.0, 1.0, 2.0), ((0, 0, 0), 1.06, 1.0, 1.0, 2.0),
    ((0, 0, 0), 0.97, 1.0, 1.0, 1.0), ((0, 0, 0), 1.0, 1.09, 1.0, 3.0), ((0, 0, 0), 1.0, 9.0, 0.0, 0.0),
    ((0.05, 0.1, 0), 1.015, 1.06, 1.0, 2.0),
])  # fmt: skip
def test_panels_are_off_by_their_centre_in_plan_their_volume_or_their_waterplane(monkeypatch, center, volume, plane,
                                                                               body_plane, off):  # fmt: skip
    """A thousandth of 100 m, and three hundredths; heights do not count, nor the waterplane of what is submerged"""
    monkeypatch.setattr(drawing, "_center", lambda mesh: np.array(center, float))
    monkeypatch.setattr(drawing, "waterplane_area", lambda mesh: 50.0 * plane)
    body = drawing.Drawn(200.0, np.zeros(3), 50.0 * body_plane)
    assert drawing._off(Hull(volume=200.0 * volume), body) == pytest.approx(off)
