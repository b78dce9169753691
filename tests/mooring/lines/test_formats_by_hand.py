"""Each column of each table of MoorDyn and MoorPy files: a number of its own in, the same quantity out, in SI."""

import math
import warnings
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.formats import moordyn_left_out
from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn import moordyn_text, parse_moordyn
from hakobune.mooring.formats.moordyn_system import system_of_moordyn
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.formats.moorpy import system_of_moorpy
from hakobune.mooring.formats.yaml_text import parse_yaml
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import (
    Anchor,
    CompositeLine,
    Fairlead,
    FreePoint,
    LineDynamics,
    LineType,
    MooredBody,
    UniformLine,
)

FILE = """\
--------------------- MoorDyn Input File ---
---------------------- LINE TYPES ---
TypeName  Diam  Mass/m  EA  BA/-zeta  EI  Cd  Ca  CdAx  CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain  0.1   90.0  5.0d8  2.0d6  3.0d3  1.1  1.2  1.3  1.4
---------------------- ROD TYPES ---
TypeName  Diam  Mass/m  Cd  Ca  CdEnd  CaEnd
(name) (m) (kg/m) (-) (-) (-) (-)
bar       0.5   300.0   0.1  0.2  0.3  0.4
---------------------- BODIES ---
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG* I* Volume CdA* Ca*
(#) (-) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1  Free     1.0 2.0 -3.0 0 0 90 5000 0.1|0.2|-0.3 7 8.0 9 10
2  Coupled  4.0 5.0 -6.0 0 20 0 1 0 0 0 0 0
---------------------- RODS ---
ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs RodOutputs
(#) (name) (-) (m) (m) (m) (m) (m) (m) (-) (-)
1  bar  Body1  0 0 1  0 4 1  5 -
---------------------- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1  Fixed   100  0  -50  0 0 0 0
2  Body1   2.0  0  -1   0 0 0 0
3  Free    40  1  -20  300 0.4 0.5 0.6
4  Body2   1.0  0   0   0 0 0 0
5  Vessel  7.0  8.0 -9.0 0 0 0 0
---------------------- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs LineOutputs
(#) (name) (#) (#) (m) (-) (-)
1  chain 1 3 70.5 11 p
2  chain 3 2 45.0 12 p
3  chain 4 3 60.0 13 -
4  chain 5 1 120.0 14 -
---------------------- OPTIONS ---
60  WtrDpth
1010 WtrDnsty
9.7 g
0.45 FrictionCoefficient
---------------------- END ---
"""


def system(text=FILE, **words):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return system_of_moordyn(parse_moordyn(text), **words)


def test_a_line_type_has_each_of_its_columns():
    """Weight (90 − 1010 π/4 · 0.01) · 9.7 N/m; the numbers have Fortran's exponents"""
    made = system()
    assert (made.depth, made.density, made.gravity) == (60.0, 1010.0, 9.7)
    kind, felt = made.lines[0].type, made.lines[0].type.dynamics
    assert (kind.name, kind.mass, kind.diameter, kind.axial_stiffness) == ("chain", 90.0, 0.1, 5e8)
    assert kind.weight == pytest.approx((90.0 - 1010 * math.pi / 400) * 9.7, rel=1e-12)
    assert (felt.drag_normal, felt.added_mass_normal, felt.drag_tangential, felt.added_mass_tangential) == (
        1.1,
        1.2,
        1.3,
        1.4,
    )
    assert (felt.damping, felt.bending_stiffness) == (2e6, 3e3)


def test_lines_and_points_are_where_their_columns_say():
    made = system()
    lines = [(one.name, one.a, one.b, one.length, one.elements, one.bed_friction) for one in made.lines]
    assert lines == [("1", "1", "3", 70.5, 11, 0.45), ("2", "3", "2", 45.0, 12, 0.45), ("3", "4", "3", 60.0, 13, 0.45),
                     ("4", "5", "1", 120.0, 14, 0.45)]  # fmt: skip
    points = {point.name: point for point in made.points}
    assert isinstance(points["1"], Anchor) and points["1"].position == (100.0, 0.0, -50.0)
    assert (points["2"].body, points["2"].position) == ("body 1", (2.0, 0.0, -1.0))
    assert (points["4"].body, points["5"].body, points["5"].position) == ("body 2", "vessel", (7.0, 8.0, -9.0))
    free = points["3"]
    assert (free.position, free.mass, free.volume, free.drag_area, free.added_mass) == (
        (40.0, 1.0, -20.0),
        300.0,
        0.4,
        0.5,
        0.6,
    )


def test_a_free_body_has_the_moments_of_its_weight_and_of_the_rods_on_it():
    """W = 5000 · 9.7 N at (0.1, 0.2, −0.3) and a rod of 4 m, (300 − 1010 π/4 · 0.25) 9.7 N/m, at (0, 2, 1); buoyancy
    1010 · 9.7 · 8 N at the origin.  Moments of −W at (x, y): −y W about x, x W about y; heeled, −Σ W z restores"""
    body = next(one for one in system().bodies if one.name == "body 1")
    own, rod = 5000 * 9.7, 4 * (300 - 1010 * math.pi / 16) * 9.7
    lift = 1010 * 9.7 * 8.0
    assert body.load == pytest.approx((0, 0, lift - own - rod, -(0.2 * own + 2 * rod), 0.1 * own, 0), rel=1e-12)
    righting = -(-0.3 * own + 1.0 * rod)
    assert np.diag(body.hydrostatic_stiffness) == pytest.approx([0, 0, 0, righting, righting, 0], rel=1e-12)
    assert body.position == pytest.approx((1.0, 2.0, -3.0, 0, 0, math.pi / 2)) and len(body.freedom) == 6
    held = next(one for one in system().bodies if one.name == "body 2")
    assert held.position == pytest.approx((4.0, 5.0, -6.0, 0, math.radians(20), 0)) and held.freedom == ()
    one = system(FILE.replace("0.1|0.2|-0.3", "-0.3"))
    body = next(b for b in one.bodies if b.name == "body 1")
    assert body.load == pytest.approx((0, 0, lift - own - rod, -2 * rod, 0.0, 0), rel=1e-12)


FREE_ROD = FILE.replace("1  bar  Body1  0 0 1  0 4 1  5 -", "1  bar  Free  10 0 -20  13 4 -20  5 -").replace(
    "3  chain 4 3 60.0", "3  chain 4 R1A 60.0"
)


def test_a_free_rod_is_a_body_in_its_middle_with_its_weight_in_water():
    """5 m between (10, 0) and (13, 4): middle (11.5, 2), ends ∓(1.5, 2)"""
    made = system(FREE_ROD)
    rod = next(body for body in made.bodies if body.name == "rod 1")
    assert rod.position == pytest.approx((11.5, 2.0, -20.0, 0, 0, 0))
    assert rod.load == pytest.approx((0, 0, -5 * (300 - 1010 * math.pi / 16) * 9.7, 0, 0, 0), rel=1e-12)
    ends = {point.name: point.position for point in made.points if point.name.startswith("R1")}
    assert ends == {"R1A": (-1.5, -2.0, 0.0), "R1B": (1.5, 2.0, 0.0)}


@pytest.mark.parametrize(
    "depth, option, said",
    [(None, "60 WtrDpth", None), (60.0, "60 WtrDpth", None), (80.0, "", None), (None, "40 WtrDpth", "depth is 40 m"),
     (None, "", "WtrDpth is missing; the bed is assumed at the lowest point, 50 m; give the depth if this is wrong"),
     (70.0, "bed.txt WtrDpth", "the bathymetry bed.txt (WtrDpth) is left out; the bed is flat at 70 m")],
)  # fmt: skip
def test_the_bed_is_at_the_depth_given_and_no_higher_than_the_lowest_point(depth, option, said):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = system_of_moordyn(parse_moordyn(FILE.replace("60  WtrDpth", option)), depth=depth)
    words = [str(one.message) for one in caught if "bed" in str(one.message)]
    assert made.depth == {
        (None, "60 WtrDpth"): 60,
        (60.0, "60 WtrDpth"): 60,
        (80.0, ""): 80,
        (70.0, "bed.txt WtrDpth"): 70,
    }.get((depth, option), 50.0)
    assert bool(words) == (said is not None) and (not said or said in words[0])


def two_kinds():
    """Every number of a System that MoorDyn has a column for, each its own"""
    felt = LineDynamics(1.1, 1.3, 1.2, 1.4, 2e5, 3e4)
    light = LineType("thin rope", 50.0, 4e7, 12.0, 0.12, dynamics=LineDynamics(0.5, 0.6, 0.7, 0.8, -0.3, 0.0))
    heavy = LineType("chain", 700.0, 5e8, 90.0, 0.1, dynamics=felt)
    return System(
        60.0,
        [UniformLine("1", heavy, 70.5, "anchor", "clump", 0.4, 10), UniformLine("2", light, 45.0, "clump", "bow", 0.4)],
        [Anchor("anchor", (100.0, 2.0, -60.0)),
         FreePoint("clump", (40.0, 1.0, -20.0), 300.0, 0.4, drag_area=0.5, added_mass=0.6),
         Fairlead("bow", "ship", (3.0, 4.0, -5.0))],
        [MooredBody("ship", (7.0, 8.0, -1.0, 0.0, 0.0, math.pi / 6), freedom=())],
        1010.0,
        9.7,
    )  # fmt: skip


def written(made, source=None):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return moordyn_of_system(made, source)


def test_a_system_is_written_column_by_column():
    file = written(two_kinds())
    assert [tuple(row)[:10] for row in file.line_types] == [
        ("chain", 0.1, 90.0, "500000000.0", "200000.0", "30000.0", 1.1, 1.2, 1.3, 1.4),
        ("thin_rope", 0.12, 12.0, "40000000.0", "-0.3", "0.0", 0.5, 0.7, 0.6, 0.8),
    ]
    assert [tuple(row) for row in file.points] == [
        ("1", "Fixed", 100.0, 2.0, -60.0, 0.0, 0.0, 0.0, 0.0),
        ("2", "Free", 40.0, 1.0, -20.0, 300.0, 0.4, 0.5, 0.6),
        ("3", "Body1", 3.0, 4.0, -5.0, 0.0, 0.0, 0.0, 0.0),
    ]
    assert [tuple(row) for row in file.lines] == [
        ("1", "chain", "1", "2", 70.5, 10, "p"),
        ("2", "thin_rope", "2", "3", 45.0, 20, "p"),
    ]
    (body,) = file.bodies
    assert (body.id, body.attachment, body.x0, body.y0, body.z0) == ("1", "Coupled", 7.0, 8.0, -1.0)
    assert (body.roll0, body.pitch0, body.yaw0) == pytest.approx((0.0, 0.0, 30.0))
    options = {name: float(value) for name, value in file.options.items()}
    assert (options["WtrDpth"], options["WtrDnsty"], options["g"], options["FrictionCoefficient"]) == (
        60.0,
        1010.0,
        9.7,
        0.4,
    )
    assert (options["kBot"], options["cBot"]) == (3e6, 3e5) and file.outputs == (
        "FairTen1",
        "AnchTen1",
        "FairTen2",
        "AnchTen2",
    )
    again = parse_moordyn(moordyn_text(file))
    assert again.line_types == file.line_types and again.points == file.points and again.lines == file.lines


@pytest.mark.parametrize("name, said", [
    ("chain", "two line types have the name 'chain'; give each type its own name"),
    ("thin_rope", "two line types have the same name once blanks are replaced"),
])  # fmt: skip
def test_two_types_have_two_names(name, said):
    """Of three lines the second and the last are of two types"""
    made = two_kinds()
    other = replace(made.lines[1].type, name=name)
    first = UniformLine("3", other, 45.0, "clump", "bow", 0.4)
    with pytest.raises(FormatError, match=said):
        written(replace(made, lines=(*made.lines[::-1], first)))
    alike = replace(made.lines[0], name="3")
    assert len(written(replace(made, lines=(*made.lines, alike))).line_types) == 2


@pytest.mark.parametrize("change, said", [
    ({"mass": None}, "line type 'chain' has no mass or no diameter, which MoorDyn needs; give both"),
    ({"diameter": None}, "line type 'chain' has no mass or no diameter, which MoorDyn needs; give both"),
    ({"axial_stiffness": math.inf}, "line type 'chain' is inextensible, and a MoorDyn file needs EA; give EA"),
])  # fmt: skip
def test_a_type_without_what_its_line_moves_by_is_named(change, said):
    """Before the time step, which these numbers give"""
    made = two_kinds()
    lacking = replace(made.lines[0], type=replace(made.lines[0].type, **change))
    with pytest.raises(FormatError, match=said):
        written(replace(made, lines=(lacking, made.lines[1])))


def step_of(**changes):
    """dtM of one line of 100 m in 10 elements between a fixed and a free point"""
    kind = {"weight": 500.0, "axial_stiffness": 1e8, "mass": 100.0, "diameter": 0.1} | changes.pop("kind", {})
    felt, mass, source = (
        changes.pop("felt", {}),
        changes.pop("mass", 1e6),
        changes.pop("source", "3.0e2 kBot\n1.0 cBot\n"),
    )
    felt = LineDynamics(0, 0, 0, 0, felt.get("BA", 0.0), felt.get("EI", 0.0))
    line = UniformLine("1", LineType("t", **kind, dynamics=felt), 100.0, "a", "b", 0.0, 10)
    made = System(60.0, [line], [Anchor("a", (90.0, 0.0, -60.0)), FreePoint("b", (0.0, 0.0, -1.0), mass)])
    read = parse_moordyn(f"--- LINES ---\na\nb\n--- OPTIONS ---\n{source}")
    return float(written(made, read).options["dtM"])


@pytest.mark.parametrize(
    "changes, wanted",
    [
        ({}, 0.2 / (2 * math.sqrt(1e8 / 100) / 10)),  # axial waves, 200 rad/s
        ({"felt": {"BA": 5e6}}, 1 / (4 * 5e6 / (100 * 100))),  # their damping, 2000 1/s
        ({"felt": {"BA": -2.5}}, 1 / (2 * 2.5 * 200)),  # the same as a share of critical, 1000 1/s
        ({"felt": {"EI": 1e10}}, 0.2 / (4 * math.sqrt(1e10 / 100) / 100)),  # bending, 400 rad/s
        ({"source": "9.0e7 kBot\n1.0 cBot\n"}, 0.2 / math.sqrt(9e7 * 0.1 / 100)),  # the bed, 300 rad/s
        ({"source": "3.0e2 kBot\n2.5e6 cBot\n"}, 1 / (2.5e6 * 0.1 / 100)),  # its damping, 2500 1/s
        ({"mass": 0.0}, 0.2 / math.sqrt(2 * 1e7 / (0.5 * 100 * 10))),  # a free point on EA/l, half an element, alike
        ({"source": "3.0e2 kBot\n1.0 cBot\n0.00057 dtM\n"}, 0.00057),
    ],
)
def test_the_step_that_is_written_is_that_of_the_fastest_motion_rounded_down(changes, wanted):
    """0.2/ω, 1/σ; two digits, the next lower"""
    step = step_of(**changes)
    unit = 10.0 ** (math.floor(math.log10(wanted)) - 1)
    assert step == pytest.approx(math.floor(wanted / unit * (1 + 1e-9)) * unit, rel=1e-9)


YAML = """\
water_depth: 90
rho_water: 1010
line_types:
  - {name: wire, diameter: 0.1, mass_density: 40, stiffness: 3.0e8, breaking_load: 6.0e6}
  - {name: rope, diameter: 0.2, mass_density: 30, stiffness: 2.0e8}
points:
  - {name: a, type: fixed, location: [1, 2, -90]}
  - {name: f, type: free, location: [3, 4, -50], mass: 70, volume: 0.8}
  - {name: v, type: vessel, location: [5, 6, -7]}
  - {name: b, type: body2, location: [8, 9, -10]}
lines:
  - {name: one, endA: a, endB: f, type: wire, length: 55.5}
  - {name: two, endA: f, endB: v, type: rope, length: 66.5}
  - {name: three, endA: f, endB: b, type: rope, length: 77.5}
"""


def test_a_moorpy_file_has_each_of_its_keys():
    made = system_of_moorpy(parse_yaml(YAML))
    assert (made.depth, made.density) == (90.0, 1010.0)
    wire, rope = made.lines[0].type, made.lines[1].type
    assert (wire.name, wire.diameter, wire.mass, wire.axial_stiffness, wire.breaking_load) == (
        "wire",
        0.1,
        40.0,
        3e8,
        6e6,
    )
    assert wire.weight == pytest.approx((40 - 1010 * math.pi / 400) * 9.80665, rel=1e-12)
    assert (rope.breaking_load, rope.mass, rope.diameter) == (math.inf, 30.0, 0.2)
    assert [(one.name, one.a, one.b, one.length) for one in made.lines] == [
        ("one", "a", "f", 55.5), ("two", "f", "v", 66.5), ("three", "f", "b", 77.5)]  # fmt: skip
    points = {point.name: point for point in made.points}
    assert (points["f"].position, points["f"].mass, points["f"].volume) == ((3.0, 4.0, -50.0), 70.0, 0.8)
    assert points["v"].body == "vessel" and points["b"].body == "body 2" and points["b"].position == (8.0, 9.0, -10.0)
    assert sorted(body.name for body in made.bodies) == ["body 2", "vessel"]
    plain = system_of_moorpy(parse_yaml(YAML.replace("rho_water: 1010\n", "").replace("water_depth: 90", "depth: 90")))
    assert (plain.density, plain.depth) == (1025.0, 90.0)
    with pytest.raises(FormatError, match="water_depth is 90 m and the given depth is 80 m"):
        system_of_moorpy(parse_yaml(YAML), depth=80.0)
    assert system_of_moorpy(parse_yaml(YAML), depth=90.0).depth == 90.0


DRY = """\
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
-
rope 0.1 20 1e7 0 0 0 0 0 0
--- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
-
1 Fixed  0 0 {low} 0 0 0 0
2 Fixed 10 0 6 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs LineOutputs
-
1 rope 1 2 {length} 5 -
--- OPTIONS ---
20 WtrDpth
"""


@pytest.mark.parametrize(
    "low, length, dry, air",
    [
        (4.0, 9.9, True, None),
        (4.0, 10.1, False, 20 * 9.80665),
        (1.0, 6.9, True, None),
        (-1.0, 6.9, False, 20 * 9.80665),
    ],
)
def test_a_line_whose_lowest_point_cannot_be_wet_weighs_as_in_air(low, length, dry, air):
    """The lowest point is no lower than (z_a + z_b − L)/2: (4 + 6 − 10)/2 = 0, to a thousandth of the length"""
    (line,) = system(DRY.format(low=low, length=length)).lines
    wet = (20 - 1025 * math.pi / 400) * 9.80665
    assert line.type.weight == pytest.approx(20 * 9.80665 if dry else wet, rel=1e-12)
    assert line.weight_in_air == (air if air is None else pytest.approx(air, rel=1e-12))


def test_a_line_of_a_table_is_one_segment_of_its_strains(tmp_path):
    (tmp_path / "stiff.dat").write_text("strain tension\n(-) (N)\n0.0 0.0\n0.1 2.0e5\n0.3 1.0e6\n")
    text = DRY.format(low=-19.0, length=30.0).replace("1e7", "stiff.dat")
    path = tmp_path / "lines.txt"
    path.write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (line,) = system_of_moordyn(parse_moordyn(text, path), path).lines
    assert isinstance(line, CompositeLine) and line.segments[0].length == pytest.approx(30.0)


@pytest.mark.parametrize("wrong", ["true", "1e999", "many", "[1, 2]"])
def test_what_is_no_number_of_a_moorpy_file_is_refused(wrong):
    with pytest.raises(FormatError, match=r"length of line one is .*; allowed: a number"):
        system_of_moorpy(parse_yaml(YAML.replace("length: 55.5", f"length: {wrong}")))


@pytest.mark.parametrize(("rods", "lines", "told"), [(1, 1, True), (0, 1, False), (1, 0, False)])
def test_bending_of_rods_is_left_out_where_there_are_rods_and_lines(monkeypatch, rods, lines, told):
    monkeypatch.setattr(moordyn_left_out, "_of_types", lambda file, moves: [])
    monkeypatch.setattr(moordyn_left_out, "_of_options", lambda file: [])
    rod = SimpleNamespace(id=1, xa=0, ya=0, za=0, xb=1, yb=0, zb=0)
    file = SimpleNamespace(
        rods=[rod] * rods, lines=[None] * lines, failures=[], bodies=[], syrope=None, control=None, external=None,
        rod_types=[SimpleNamespace(name="stiff")],
    )  # fmt: skip
    said = moordyn_left_out.left_out(file)
    assert said == (["bending and end forces of rods of type stiff are not included"] if told else [])


def test_options_of_time_and_of_the_water_are_known_and_others_are_told():
    options = {"dtM": "0.1", "rhoW": "1025", "WtrDpth": "20", "mystery": "3", "Currents": "1", "WaveKin": "0", "x": "-"}
    assert list(moordyn_left_out._of_options(SimpleNamespace(options=options))) == [
        "currents (Currents 1) is left out: the water is still and the bed is flat",
        "option mystery, x is unknown and ignored",
    ]


DRAFT = """\
---- MoorDyn input file ----
---- LINE DICTIONARY ----
LineType Diam MassDenInAir EA cIntDamp EI Can Cat Cdn Cdt A remark: Name is free, Diam in m
(-) (m) (kg/m) (N) (Pa-s) (N-m^2) (-) (-) (-) (-) and a word
chain 0.1 90.0 5.0e8 -1 0 0.2 0.3 1.4 1.5
---- BODY LIST ----
BodyID X0 Y0 Z0 r0 p0 y0 Xcg Ycg Zcg M V IX IY IZ CdA-x,y,z Ca-x,y,z
(-) (m) (m) (m) (deg) (deg) (deg) (m) (m) (m) (kg) (m^3) (kg-m^2) (kg-m^2) (kg-m^2) (m^2) (-)
1Coupled 1 2 -3 4 5 6 0.1 0.2 -0.3 5000 7 11 12 13 {drag}
---- POINT PROPERTIES ----
Node Type X Y Z M V FX FY FZ CdA Ca
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m2) ()
1 Fix 100 0 -50 0 0 0 0 0 0 0
2 Body1 2 0 -1 0 0 0 0 0 0 0
---- LINE PROPERTIES ----
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-) (-) (m) (-) (-) (-) (-)
1 chain 130 10 1 2 p
---- FAILURE ----
Node Line(s) FailTime FailTen
() (,) (s or 0) (N or 0)
2 1 5 0
---- need this line ----
"""


@pytest.mark.parametrize(
    ("drag", "CdA", "Ca"), (("9 8", "9", "8"), ("1 2 3 4", "1|2|3", "4"), ("1 2 3 4 5 6", "1|2|3", "4|5|6"))
)
def test_tables_of_drafts_of_version_2_and_remarks_behind_their_names_are_read(drag, CdA, Ca):
    file = parse_moordyn(DRAFT.format(drag=drag))
    (body,) = file.bodies
    assert body == ("1", "Coupled", 1, 2, -3, 4, 5, 6, 5000, "0.1|0.2|-0.3", "11|12|13", 7, CdA, Ca)
    (kind,) = file.line_types
    assert (kind.Ca, kind.CaAx, kind.Cd, kind.CdAx) == (0.2, 0.3, 1.4, 1.5)  # not in the order of version 2
    assert file.failures[0] == ("1", "2", "1", 5, 0)


def test_a_remark_that_may_be_a_column_is_told_and_a_body_of_other_entries_too():
    with pytest.raises(FormatError, match="LINE TYPES"):
        parse_moordyn(DRAFT.format(drag="9 8").replace("0.2 0.3 1.4 1.5", "0.2 0.3 1.4 1.5 7 8 9 1"))
    with pytest.raises(FormatError, match="BODIES: 18 entries; allowed: 14"):
        parse_moordyn(DRAFT.format(drag="9 8 7"))


EARLY = """MoorDyn
---- LINE TYPES ----
Name Diam MassDen EA BA/-zeta Can Cat Cdn Cdt
(-) (m) (kg/m) (N) (N-s/-) (-) (-) (-) (-)
main 0.1 90.0 5.0e8 -1 0.2 0.3 1.4 1.5
---- CONNECTION PROPERTIES ----
Node Type X Y Z M V FX FY FZ CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1 Fixed 100 0 -50 0 0 0 0 0 0 0 {note}
2 {vessel} 2 0 -1 0 0 0 0 0 0 0
---- LINE PROPERTIES ----
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs Control
(-) (-) (m) (-) (-) (-) (-) (-)
1 main 130 10 1 2 p {winch}
---- END ----
"""


def test_notes_after_an_exclamation_mark_vessel1_and_idle_winches_of_version_1_are_read():
    plain = system_of_moordyn(parse_moordyn(EARLY.format(note="", vessel="Vessel", winch="0")))
    early = EARLY.format(note="!#417.3 22.53 107.16", vessel="Vessel1", winch="0")
    assert system_of_moordyn(parse_moordyn(early)).points == plain.points and plain.points[1].body == "vessel"
    with pytest.raises(FormatError, match="line 14, section LINES: 3 is a force on a point or a winch channel"):
        parse_moordyn(EARLY.format(note="", vessel="Vessel", winch="3"))
    with pytest.raises(FormatError, match="attachment of point 2 is 'Vessel2'"):
        system_of_moordyn(parse_moordyn(EARLY.format(note="", vessel="Vessel2", winch="0")))
