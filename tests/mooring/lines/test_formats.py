"""MoorDyn and MoorPy files: what is written is read back equal, and faults are named with line and section."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn import MoorDynFile, moordyn_text, parse_moordyn, read_moordyn, write_moordyn
from hakobune.mooring.formats.moordyn_system import system_of_moordyn
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.formats.moorpy import system_of_moorpy
from hakobune.mooring.formats.yaml_text import parse_yaml
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, Fairlead, FreePoint, MooredBody, UniformLine

VERSION_2 = """\
--------------------- MoorDyn Input File ------------------------------------
three lines, one with a clump and a bridle
---------------------- LINE TYPES --------------------------------------------
TypeName   Diam     Mass/m     EA           BA/-zeta     EI         Cd     Ca     CdAx   CaAx
(name)     (m)      (kg/m)     (N)          (N-s/-)      (N-m^2)    (-)    (-)    (-)    (-)
chain      0.1378   122.54     653.3E6      -0.8         0          1.37   1.0    0.64   0.5
rope       0.12     12.0       2.5E7|4.0E7  1e5|2e5      0          1.2    1.0    0.0    0.0
---------------------- ROD TYPES ---------------------------------------------
TypeName   Diam     Mass/m     Cd     Ca     CdEnd    CaEnd
(name)     (m)      (kg/m)     (-)    (-)    (-)      (-)
---------------------- BODIES ------------------------------------------------
ID   Attachment  X0     Y0    Z0     r0    p0    y0    Mass   CG*    I*    Volume   CdA*   Ca*
(#)  (-)         (m)    (m)   (m)    (deg) (deg) (deg) (kg)   (m)    (kg-m^2) (m^3) (m^2)  (-)
1    Coupled     0      0     0      0     0     30    0      0      0     0        0      0
---------------------- POINTS ------------------------------------------------
ID   Attachment  X       Y       Z       Mass    Volume  CdA    Ca
(#)  (-)         (m)     (m)     (m)     (kg)    (m^3)   (m^2)  (-)
1    Fixed       -300    0       -70     0       0       0      0
2    Free        -60     0       -30     2.5d3   0.4     0      0
3    Body1       -20     5       -4      0       0       0      0
4    Body1       -20     -5      -4      0       0       0      0
5    Anchor      280     160     -70     0       0       0      0
6    B1          20      0       -4      0       0       0      0
7    Fixed       280     -160    -70     0       0       0      0
---------------------- LINES -------------------------------------------------
ID   LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)  (name)    (#)      (#)      (m)       (-)      (-)
1    chain     1        2        250.5     25       p
2    rope      2        3        52        10       -
3    rope      P2       Point4   52        10       p t
4    chain     5        6        315       30       -
5    chain     7        6        315       30       -
---------------------- FAILURE -----------------------------------------------
FailureID  Point  Line(s)  FailTime  FailTen
()         ()     (,)      (s)       (N)
1          2      1        0         2e6
---------------------- OPTIONS -----------------------------------------------
0.001    dtM      time step to use in mooring integration (s)
3.0e6    kBot
3.0e5    cBot
70       WtrDpth  water depth (m)
1000     rhoW
---------------------- OUTPUTS -----------------------------------------------
FairTen1
AnchTen1 Point2pz
--------------------- need this line ------------------------------------------
"""
VERSION_1 = """\
MoorDyn file of version 1
True  Echo
------------------------- LINE TYPES --------------------------------------------------
LineType  Diam   MassDen   EA        BA/-zeta   Can   Cat   Cdn   Cdt
(-)       (m)    (kg/m)    (N)       (Pa-s/-)   (-)   (-)   (-)   (-)
nylon     0.124  13.76     2515288.0 -0.8       1.0   0.0   1.6   0.05
----------------------- CONNECTION PROPERTIES -----------------------------------------
Node   Type    X      Y     Z     M    V    FX   FY   FZ   CdA   Ca
(-)    (-)     (m)    (m)   (m)   (kg) (m3) (kN) (kN) (kN) (m2)  (-)
1      Fix     -60.   0.    -40.  0    0    0    0    0    0     0
2      Vessel  -5.    0.    0.    0    0    0    0    0    0     0
3      Connect -30.   0.    -20.  150  0.1  0    0    0    0     0
-------------------------- LINE PROPERTIES --------------------------------------------
Line   LineType   UnstrLen   NumSegs   NodeAnch   NodeFair   Flags/Outputs
(-)    (-)        (m)        (-)       (-)        (-)        (-)
1      nylon      38.0       20        1          3          p
2      nylon      32.0       20        3          2          p
-------------------------- SOLVER OPTIONS ---------------------------------------------
40      WtrDpth
-------------------------- OUTPUTS ----------------------------------------------------
FairTen2
------------------------- need this line ------------------------------------------
"""
YAML = """\
# a taut leg, as MoorPy writes it
water_depth: 200   # m
water_density: 1025.0
line_types:
  - name: poly
    diameter: 0.14
    mass_density: 23.2      # kg/m
    stiffness: 1.4e8
    breaking_load: 7.0e+06
  -   {name: 'chain 84', diameter: 0.151, mass_density: 141, stiffness: 6.0E8}
points:
  - name: anchor1
    type: fixed
    location: [-800, 0, -200]
    anchor_type: drag
  - name: joint
    type: free
    location: [ -300.5,
                0, -120 ]
    mass: 500
  - {name: fair, type: vessel, location: [-20, 0, -14]}
lines:
- name: lower
  endA: anchor1
  endB: joint
  type: "chain 84"
  length: 520
- name: upper
  endA: joint
  endB: fair
  type: poly
  length: 315
anchor_types:
  - name: drag
    mass: 1000
"""


@pytest.mark.parametrize(
    "text",
    [
        VERSION_2.replace("--------------------- need this line", "--- END"),
        VERSION_1.replace("------------------------- need this line", "--- END"),
    ],
)
def test_a_moordyn_file_read_written_and_read_again_is_the_same(tmp_path, text):
    first = parse_moordyn(text)
    write_moordyn(first, tmp_path / "lines.txt")
    again = read_moordyn(tmp_path / "lines.txt")
    assert replace(again, title=()) == replace(first, title=())
    assert moordyn_text(again) == moordyn_text(first)


def test_version_2_says_what_it_says():
    file = parse_moordyn(VERSION_2)
    assert file.line_types[1].EA == "2.5E7|4.0E7" and file.points[1].mass == 2500.0
    assert file.lines[2].b == "Point4" and file.lines[2].outputs == "pt"
    assert file.options["WtrDpth"] == "70" and file.outputs == ("FairTen1", "AnchTen1", "Point2pz")
    assert file.failures[0].tension == 2e6 and file.bodies[0].yaw0 == 30.0


def test_version_1_columns_are_found_by_their_names():
    file = parse_moordyn(VERSION_1)
    kind = file.line_types[0]
    assert (kind.Ca, kind.CaAx, kind.Cd, kind.CdAx) == (1.0, 0.0, 1.6, 0.05)
    assert file.points[2].attachment == "Connect" and file.points[2].volume == 0.1
    assert (file.lines[0].a, file.lines[0].b, file.lines[0].length) == ("1", "3", 38.0)


def test_the_system_of_a_file_comes_to_rest():
    for text in (VERSION_1, VERSION_2):
        system = system_of_moordyn(parse_moordyn(text))
        state = rest(system)
        assert np.abs(state.residual).max() < 1e-9 * state.tension.sum()


def test_submerged_weight_is_mass_less_the_water_that_the_line_takes_the_place_of():
    system = system_of_moordyn(parse_moordyn(VERSION_2))
    weight = system.lines[0].type.weight
    assert weight == pytest.approx((122.54 - 1000 * np.pi / 4 * 0.1378**2) * 9.80665)
    assert system_of_moorpy(parse_yaml(YAML)).lines[1].type.weight == pytest.approx(
        (23.2 - 1025 * np.pi / 4 * 0.14**2) * 9.80665
    )


def bridle():
    chain, rope = line_type("R3 studless 76 mm"), line_type("polyester 120 mm")
    return System(
        60.0,
        [UniformLine("chain", chain, 180.0, "anchor", "buoy", 0.4), UniformLine("bow", rope, 40.0, "buoy", "bow", 0.4)],
        [
            Anchor("anchor", (220.0, 10.0, -60.0)),
            FreePoint("buoy", (70.0, 0.0, -2.0), 5e3, 20.0),
            Fairlead("bow", "barge", (30.0, 1.0, 1.0)),
        ],
        [MooredBody("barge", (0.0, 0.0, 0.0, 0.0, 0.0, 0.1), load=(-5e4, 0, 0, 0, 0, 0))],
    )


def quiet_system(text, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return system_of_moordyn(parse_moordyn(text), **settings)


def test_coupled_points_and_bodies_are_held_where_they_are_given():
    system = quiet_system(VERSION_2)
    assert system.bodies[0].freedom == () and system.bodies[0].name == "body 1"
    state = rest(quiet_system(VERSION_1))
    assert state.system.bodies[0].name == "vessel" and np.all(state.position == 0)
    fairlead = state.points[1]
    assert tuple(fairlead) == (-5.0, 0.0, 0.0)


def test_a_depth_stands_in_where_the_file_has_none_and_only_there():
    bare = VERSION_2.replace("70       WtrDpth  water depth (m)\n", "")
    assert quiet_system(bare, depth=75.0).depth == 75.0
    with pytest.warns(
        UserWarning,
        match="WtrDpth is missing; the bed is assumed at the lowest point, 70 m; give the depth if this is wrong",
    ):
        assert system_of_moordyn(parse_moordyn(bare)).depth == 70.0
    with pytest.warns(UserWarning, match="depth is 60 m, but the lowest point lies at 70 m"):
        assert system_of_moordyn(parse_moordyn(bare), depth=60.0).depth == 70.0
    with pytest.raises(FormatError, match="WtrDpth is 70 m and the given depth is 80 m"):
        quiet_system(VERSION_2, depth=80.0)
    bathymetry = VERSION_2.replace("70       WtrDpth", "bed.txt  WtrDpth")
    with pytest.warns(UserWarning, match="bathymetry bed.txt .WtrDpth. is left out; the bed is flat at 70 m"):
        assert system_of_moordyn(parse_moordyn(bathymetry), depth=70.0).depth == 70.0


LEFT_OUT = [
    ("-0.8         0 ", "-0.8         4e4 ", "bending stiffness EI of chain is not included"),
    ("1000     rhoW", "3 WaveKin", "waves (WaveKin 3) is left out"),
    ("1000     rhoW", "1 Currents", "currents (Currents 1) is left out"),
    ("1000     rhoW", "bed.txt SeafloorFile", "the bathymetry (SeafloorFile bed.txt) is left out"),
    ("1000     rhoW", "3 mystery", "option mystery is unknown and ignored"),
    ("-- OPTIONS", "-- SYROPE IC ---\nLine(s) Tmax0 Tmean0\n(-) (N) (N)\n2 1e6 5e5\n--- OPTIONS",
     "section SYROPE IC is not used: no line type is a Syrope rope"),
    ("3    Body1 ", "3    Coupled ", "dynamic stiffness (EA a|b) of rope is not included; the static"),
    ("1    Coupled     0      0     0      0     0     30 ", "1    Free        0      0     0      0    -90     0  ",
     "free body 1 starts heeled (r0, p0): the heel is not used; the search for its equilibrium starts from upright"),
    ("3    Body1 ", "3    Coupled ", "failure 1 of lines is left out: lines do not break in the statics"),
    ("7    Fixed       280     -160    -70     0       0       0      0\n",
     "7 Fixed 280 -160 -70 0 0 0 0\n8 Free 0 0 0 0 0 0 0\n", "point 8 is free and no line holds it, so it is ignored"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), LEFT_OUT)
def test_everything_that_lines_at_rest_leave_out_is_named(old, new, message):
    assert old in VERSION_2
    with pytest.warns(UserWarning) as said:
        system_of_moordyn(parse_moordyn(VERSION_2.replace(old, new, 1)))
    texts = [str(one.message) for one in said]
    assert sum(message in text for text in texts) == 1 and len(texts) == len(set(texts))


def test_how_a_free_body_is_heeled_to_begin_with_does_not_change_its_rest():
    free = "1 Free 0 0 0 {} 0 1e4 0|0|-3 1e5 30 0 0"
    row = next(line for line in VERSION_2.splitlines() if line.startswith("1    Coupled"))
    texts = (VERSION_2.replace(row, free.format(turn), 1) for turn in ("0 0", "0 -90"))
    upright, heeled = (rest(quiet_system(text)) for text in texts)
    assert np.array_equal(upright.tension, heeled.tension) and upright.tension.max() > 0


def test_a_still_and_plain_file_is_read_without_a_warning():
    still = VERSION_1.replace("40      WtrDpth", "40 WtrDpth\n0 WaveKin\n0 Currents\n0.001 dtM\n3e6 kBot\n1 writeLog")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        system_of_moordyn(parse_moordyn(still))


ROD = """\
--- ROD TYPES ---
TypeName Diam Mass/m Cd Ca CdEnd CaEnd
(name) (m) (kg/m) (-) (-) (-) (-)
tube 0.3 200.0 1 1 1 1
--- RODS ---
ID RodType Attachment Xa Ya Za Xb Yb Zb NumSegs Outputs
(#) (name) (-) (m) (m) (m) (m) (m) (m) (-) (-)
1 tube {rod} - # a note
--- POINTS ---
"""


def with_rod(rod):
    """Two lines of 450 m from anchors 900 m apart to the ends of a rod between them."""
    types = VERSION_2[VERSION_2.index("-- LINE TYPES") : VERSION_2.index("rope ")]
    rows = (
        "ID Attachment X Y Z Mass Volume CdA Ca\n- - - - - - - - -\n1 Fixed -450 0 0 0 0 0 0\n2 Fixed 450 0 0 0 0 0 0\n"
    )
    lines = "--- LINES ---\nID LineType AttachA AttachB UnstrLen NumSegs\n- - - - - -\n"
    lines += "1 chain 1 R1A 450 20\n2 chain 2 R1B 450 20\n"
    return f"-{types}{ROD.format(rod=rod)}{rows}{lines}--- OPTIONS ---\n150 WtrDpth\n"


def test_a_rod_hangs_between_its_lines_with_its_weight_in_water():
    state = rest(quiet_system(with_rod("Free -10 0 -75 10 0 -75 1")))
    weight = 20 * (200 - 1025 * np.pi / 4 * 0.3**2) * 9.80665
    assert state.system.bodies[0].name == "rod 1"
    total = 900 * state.system.lines[0].type.weight + weight
    assert np.sum(state.lines.vertical_a) == pytest.approx(total, rel=1e-6)
    assert np.allclose(state.position[0, 3:], 0, atol=1e-9)


def test_a_rod_without_length_joins_its_lines_and_one_that_is_held_ends_them():
    joint = quiet_system(with_rod("Free 0 0 -75 0 0 -75 0"))
    assert joint.lines[0].b == joint.lines[1].b == "R1" and isinstance(joint.points[-1], FreePoint)
    held = quiet_system(with_rod("Fixed -10 0 -75 10 0 -75 1"))
    assert [point.position for point in held.points[2:]] == [(-10.0, 0.0, -75.0), (10.0, 0.0, -75.0)]
    with pytest.raises(FormatError, match="attachment of rod 1 is 'Pinned'"):
        quiet_system(with_rod("Pinned -10 0 -75 10 0 -75 1"))


DRY = """\
--- LINE TYPES ---
Name Diam MassDen EA BA/-zeta EI Cd Ca CdAx CaAx
(-) (m) (kg/m) (N) (-) (-) (-) (-) (-) (-)
beam 0.25 100 1.5e9 -1 0 0 0 0 0
--- POINTS ---
ID Attachment X Y Z Mass Volume CdA Ca
- - - - - - - - -
1 Fixed 0 0 10 0 0 0 0
2 Fixed 10 0 10 0 0 0 0
3 Free 20 0 9 0 0 0 0
4 Fixed 40 0 -10 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs
- - - - - -
1 beam 1 2 10.1 20
2 beam 2 3 10 20
3 beam 2 4 45 20
--- OPTIONS ---
60 WtrDpth
"""


def test_lines_above_the_water_weigh_what_they_do_in_air(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        system = system_of_moordyn(parse_moordyn(DRY))
    state = rest(system)
    weight = 100 * system.gravity
    assert np.allclose((state.lines.vertical_a + state.lines.vertical_b)[:2], weight * np.array([10.1, 10]), rtol=1e-9)
    inside = 45 * system.lines[2].type.weight
    assert inside < state.lines.vertical_a[2] + state.lines.vertical_b[2] < 45 * weight
    write_moordyn(moordyn_of_system(system), tmp_path / "again.txt")
    again = rest(quiet_system((tmp_path / "again.txt").read_text()))
    assert np.allclose(again.tension, state.tension, rtol=1e-9)
    moving = quiet_system(DRY, moves=True)  # where each part weighs by where it is
    assert len({line.type for line in moving.lines}) == 1 and {line.weight_in_air for line in moving.lines} == {None}


def test_a_line_that_floats_is_said_to_weigh_in_air_what_it_does_in_water():
    with pytest.warns(
        UserWarning, match="line 3 leaves the water; its part in the air also has its weight in water here"
    ):
        system_of_moordyn(parse_moordyn(DRY.replace("0.25 100 ", "0.25 40 ")))


def test_what_a_run_in_time_needs_is_kept_when_a_file_is_read_and_written():
    first = parse_moordyn(VERSION_2.replace("3.0e6    kBot", "1.5e6    kb\n0.4 FrictionCoefficient\nRK4 tScheme"))
    system = quiet_system(VERSION_2.replace("0       0\n3    Body1", "0.3     0.7\n3    Body1"))
    again = parse_moordyn(moordyn_text(moordyn_of_system(system, first)))
    kinds = [(row.Cd, row.Ca, row.CdAx, row.CaAx, float(row.BA), float(row.EI)) for row in again.line_types]
    assert kinds == [(1.37, 1.0, 0.64, 0.5, -0.8, 0.0), (1.2, 1.0, 0.0, 0.0, 1e5, 0.0)]
    assert [row.segments for row in again.lines] == [25, 10, 10, 30, 30]
    assert (again.option("kBot"), again.option("cBot"), again.option("tScheme")) == ("1.5e6", "3.0e5", "RK4")


def test_written_options_have_the_names_that_moordyn_2_documents():
    options = moordyn_of_system(bridle()).options
    assert set(options) <= {"dtM", "kBot", "cBot", "WtrDpth", "WtrDnsty", "g", "FrictionCoefficient", "ICgenDynamic"}
    assert "rhoW" not in options


def test_the_written_time_step_is_stable_for_the_axial_waves_of_every_line():
    system = bridle()
    step = float(moordyn_of_system(system).options["dtM"])
    for line in system.lines:
        wave = np.sqrt(line.type.axial_stiffness / line.type.mass)
        assert step * 2 * wave / (line.length / 20) <= 0.5
    finer = replace(system, lines=tuple(replace(line, elements=200) for line in system.lines))
    assert float(moordyn_of_system(finer).options["dtM"]) == pytest.approx(step / 10, rel=0.1)
    read = parse_moordyn("--- LINES ---\na\nb\n--- OPTIONS ---\n1e-5 dtM\n")
    assert float(moordyn_of_system(system, read).options["dtM"]) == 1e-5


def test_a_system_written_for_moordyn_and_read_back_has_the_same_forces():
    with pytest.warns(UserWarning, match="line bow comes out of the water; its part in the air has its weight in air"):
        moordyn_of_system(bridle())
    points = [replace(point, position=(30.0, 1.0, -1.0)) if point.name == "bow" else point for point in bridle().points]
    system = replace(bridle(), points=tuple(points))
    again = system_of_moordyn(parse_moordyn(moordyn_text(moordyn_of_system(system))))
    number = {point.name: str(i) for i, point in enumerate(system.points, 1)}
    assert [(line.name, line.a, line.b, line.length) for line in again.lines] == [
        (str(i), number[line.a], number[line.b], line.length) for i, line in enumerate(system.lines, 1)
    ]
    assert np.allclose(again.load().stiffness, system.load().stiffness, rtol=1e-9)
    assert np.allclose(again.load().force, system.load().force, rtol=1e-9)


FAULTS = [
    ("122.54     653.3E6", "abc     653.3E6",
     "line 6, section LINE TYPES: mass is 'abc'; allowed: a number"),
    ("1        2        250.5     25       p", "1        9        250.5     25       p",
     "section LINES: line 1: its end 9 is not a point"),
    ("1    chain     1 ", "1    chane     1 ", "section LINES: line 1: type 'chane' is unknown; allowed: chain, rope"),
    ("250.5     25 ", "250.5     2.5 ", "segments is 2.5; allowed: a whole number"),
    ("2    Free        -60     0       -30     2.5d3   0.4     0      0", "2  Free",
     "section POINTS: 2 entries, x, y, z, mass, volume, CdA, Ca missing"),
    ("2    Free        -60     0       -30     2.5d3   0.4     0      0", "2  Free  -60  0  2.5d3  0.4  0  0",
     "section POINTS: 8 entries, Ca missing"),
    ("2    Free  ", "1    Free  ", "section POINTS: id 1 is used twice"),
    ("- LINES -", "- LNIES -", "section LNIES"),
    ("- OUTPUTS -", "- LINES -", "section LINES: appears twice"),
    ("70       WtrDpth  water depth (m)", "70", "section OPTIONS: '70' is not a value and a name"),
    ("- LINES -", "- OUTPUTS -", "appears twice, first at line"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), FAULTS)
def test_a_faulty_file_names_line_and_section(tmp_path, old, new, message):
    (tmp_path / "bad.txt").write_text(VERSION_2.replace(old, new, 1))
    with pytest.raises(FormatError) as fault:
        read_moordyn(tmp_path / "bad.txt")
    assert message in str(fault.value) and "bad.txt line" in str(fault.value) and "\n" not in str(fault.value)


REFUSED = [
    ("70       WtrDpth", "bathy.txt WtrDpth", "WtrDpth is 'bathy.txt', a bathymetry; allowed: a number"),
    ("653.3E6 ", "table.txt ", "EA of chain is 'table.txt'"),
    ("122.54     653.3E6", "0     653.3E6", "section LINE TYPES: Mass/m of chain is 0 kg/m; allowed: above 0"),
    ("3    Body1 ", "3    Turbine1 ", "point 3 is in the axes of Turbine1"),
    ("0      0     0      0     0     30 ", "0      0     0      5     0     30 ", "2 angles that are not 0"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), REFUSED)
def test_what_statics_cannot_represent_is_refused_by_name(old, new, message):
    with pytest.raises(FormatError, match=r"allowed|give") as fault:
        system_of_moordyn(parse_moordyn(VERSION_2.replace(old, new, 1)))
    assert message in str(fault.value)


def test_an_empty_or_missing_file_is_one_line(tmp_path):
    (tmp_path / "empty.txt").write_text("")
    for path, message in (("empty.txt", "no section LINES"), ("none.txt", "does not exist"), (".", "cannot be read")):
        with pytest.raises(FormatError, match=message):
            read_moordyn(tmp_path / path)


def test_yaml_of_moorpy_is_understood():
    system = system_of_moorpy(parse_yaml(YAML))
    assert (system.depth, len(system.lines), system.points[1].position) == (200.0, 2, (-300.5, 0.0, -120.0))
    assert system.lines[0].type.name == "chain 84" and system.lines[1].type.breaking_load == 7e6
    state = rest(system)
    assert np.abs(state.residual).max() < 1e-9 * state.tension.sum()


def test_the_mooring_of_a_raft_design_is_found_inside_it():
    data = parse_yaml(YAML)
    assert system_of_moorpy({"site": {"water_depth": 1}, "mooring": data}).depth == 200


def test_yaml_scalars_and_collections():
    text = "a: 1\nb: 1e3\nc: -.5\nd: 'x: y'\ne: true\nf:\ng: [1, [2, {h: 3}], \"t, u\"]\nh: word with blanks # note\n"
    assert parse_yaml(text) == {
        "a": 1,
        "b": 1000.0,
        "c": -0.5,
        "d": "x: y",
        "e": True,
        "f": None,
        "g": [1, [2, {"h": 3}], "t, u"],
        "h": "word with blanks",
    }
    assert parse_yaml("- 1\n- - 2\n  - 3\n-\n  a: 4\n") == [1, [2, 3], {"a": 4}]
    assert parse_yaml("") is None
    assert parse_yaml("a: &x [1, yes]\nb: *x\nc: |\n  text\n") == {"a": [1, "yes"], "b": [1, "yes"], "c": "text\n"}


YAML_FAULTS = [
    ("a: 1\na: 2", 'line 2: while constructing a mapping found duplicate key "a"'),
    ("a: [1, 2", "line 1: while parsing a flow sequence expected ',' or ']'"),
    ("a: 1\n   b: 2", "line 2: mapping values are not allowed here"),
    ("a:\n  - b: 1\n    c", "line 3: while scanning a simple key could not find expected ':'"),
    ("a:\n\t- 1", "line 2: while scanning for the next token found character '\\t'"),
    ("a: 'x", "line 1: while scanning a quoted scalar found unexpected end of stream"),
    ("a: 1\n---\nb: 2", "line 2: expected a single document in the stream but found another document"),
    ("a: 1\nb: !!python/name:os.system", "line 2: could not determine a constructor for the tag"),
    ("a: *x", "line 1: found undefined alias 'x'"),
    ("a: \x00", "unacceptable character"),
    ("[" * 5000, "nested too deep"),
    ("a: 1" + "0" * 5000, "4300 digits"),
]


@pytest.mark.parametrize(("text", "message"), YAML_FAULTS)
def test_yaml_that_is_not_plain_data_is_refused_with_its_line(text, message):
    with pytest.raises(FormatError) as fault:
        parse_yaml(text)
    assert message in str(fault.value)


MOORPY_FAULTS = [
    ("stiffness: 1.4e8", "stiffness: soft", "stiffness of line type poly is 'soft'; allowed: a number"),
    ("length: 315", "lenght: 315", "lines[1].lenght is unknown; allowed: endA"),
    ("type: poly", "type: silk", "type of line upper is 'silk'; allowed: poly, chain 84"),
    ("location: [-800, 0, -200]", "location: [-800, 0]", "location of point anchor1 is [-800, 0]"),
    ("water_depth: 200", "depht: 200", "water_depth of the file is missing"),
    ("water_depth: 200", "water_depth: .nan", "water_depth of the file is nan; allowed: a number"),
    ("water_depth: 200", "water_depth: 1" + "0" * 400, "water_depth of the file is 10000"),
    ("length: 315", "1: 315", "lines[1].1 is unknown; allowed: endA"),
    ("type: free", "type: loose", "type of point joint is 'loose'"),
    ("endB: joint", "endB: knee", "its end 'knee' is not a point of the system"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), MOORPY_FAULTS)
def test_a_faulty_moorpy_file_names_what_is_wrong(old, new, message):
    with pytest.raises(ValueError) as fault:
        system_of_moorpy(parse_yaml(YAML.replace(old, new, 1)))
    assert message in str(fault.value) and "\n" not in str(fault.value)


def test_a_key_of_a_moorpy_file_that_is_not_read_is_said():
    with pytest.warns(UserWarning, match="not read: water_densty; known tables: water_depth, depth, water_density"):
        system_of_moorpy(parse_yaml(YAML.replace("water_depth: 200", "water_depth: 200\nwater_densty: 1000", 1)))


def test_units_in_a_code_page_do_not_matter(tmp_path):
    (tmp_path / "lines.txt").write_bytes(VERSION_2.replace("(m^3)", "(m³)").encode("cp1252"))
    assert read_moordyn(tmp_path / "lines.txt").points == parse_moordyn(VERSION_2).points


def test_an_unknown_type_of_file_has_no_lines():
    with pytest.raises(FormatError, match="no section LINES"):
        parse_moordyn("hello\nworld")
    assert MoorDynFile().option("g") is None


def test_a_column_of_control_channels_is_read_where_it_is_nought():
    with_channels = VERSION_1.replace("Flags/Outputs\n", "Flags/Outputs  CtrlChan\n").replace(
        "      p\n", "      p  0\n"
    )
    assert parse_moordyn(with_channels).lines == parse_moordyn(VERSION_1).lines
    with pytest.raises(
        ValueError, match="2 is a force on a point or a winch channel, which is not supported; allowed: 0"
    ):
        parse_moordyn(with_channels.replace("      p  0\n", "      p  2\n"))


@pytest.mark.parametrize(
    "first",
    [
        "--- MoorDyn ---",
        "-----------------------",
        "---------- Mooring of a buoy, October -----",
        "--- MoorDyn, 3 LINES of a semi-submersible ---",
        "----- LINE TYPES and POINTS of the OPTIONS study -----",
    ],
)
def test_dashes_before_the_first_section_are_free_text(first):
    """MoorDyn: the lines before a heading are for notes"""
    file = parse_moordyn(VERSION_2.replace(VERSION_2.splitlines()[0], first))
    assert file.title[0] == first and replace(file, title=()) == replace(parse_moordyn(VERSION_2), title=())


@pytest.mark.parametrize("first", ["LINE TIPES", "OPTION", "POINT", "BODY"])
def test_a_first_heading_that_is_nearly_one_is_refused(first):
    with pytest.raises(FormatError, match=f"line 1, section {first}: is not a section"):
        parse_moordyn(VERSION_2.replace(VERSION_2.splitlines()[0], f"--- {first} ---"))


def test_numbers_of_an_older_yaml_are_read_without_a_warning():
    """Of 1.1 a number without a dot is a number, of which the reader of YAML warns; one with a leading zero is octal"""
    import ruamel.yaml  # noqa: F401 : its own filters go first

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert parse_yaml("%YAML 1.1\n---\na: 12e3\nb: 017\n") == {"a": 12000.0, "b": 15}
        assert parse_yaml("a: 12e3\nb: 017\n") == {"a": 12000.0, "b": 17}
