"""Lines of OrcaFlex, of farms of FAST.Farm and RAFT, and what no reader of lines takes, by hand."""

import math

import numpy as np
import pytest

from hakobune.mooring.formats.fast_farm import read_fast_farm
from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn_system import read_moordyn_system
from hakobune.mooring.formats.moorpy import system_of_moorpy
from hakobune.mooring.formats.yaml_text import parse_yaml
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.pipelines.lines.system_file import read_system

ORCAFLEX = """%YAML 1.1
# Type: Model
---
General:
  UnitsSystem: {units}
Environment:
  Density: {density}
  WaterDepth: {depth}
LineTypes:
  - Name: chain
    OD: {diameter}
    ID: 0
    MassPerUnitLength: {mass}
    EA: {stiffness}
  - Name: float
    OD: {float}
    ID: 0
    MassPerUnitLength: {mass}
    EA: {stiffness}
Vessels:
  - Name: barge
    InitialPosition: [{place}, 0, 0]
    Orientation: [0, 0, 90]
Lines:
  - Name: one
    Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth:
      - [barge, {x}, 0, 0, 0]
      - [Anchored, {place}, {anchor}, 0, 0]
    LineType, Length, TargetSegmentLength:
      - [chain, {first}, 5]
      - [chain, {second}, 5]
  - Name: two
    EndAConnection: Fixed
    EndBConnection: barge
    EndAX: {place}
    EndAY: -{anchor}
    EndAZ: -{depth}
    EndBX: -{x}
    EndBY: 0
    EndBZ: 0
    LineType[1]: chain
    Length[1]: {whole}
  - Name: cable
    Connection, ConnectionX, ConnectionY, ConnectionZ:
      - [barge, {x}, 0, 0]
      - [Anchored, {place}, {anchor}, 0]
    LineType, Length:
      - [float, {whole}]
"""
SI = {"units": "SI", "density": 1.025, "depth": 50, "diameter": 0.18, "float": 0.6, "mass": 0.2, "stiffness": "854e3",
      "place": 20, "x": 10, "anchor": 190, "first": 100, "second": 90, "whole": 190}  # fmt: skip
FOOT, KIP_FORCE, KIP = 0.3048, 4448.2216152605, 453.59237


def us():
    """The same in kip and ft"""
    lengths = {key: SI[key] / FOOT for key in ("depth", "diameter", "float", "place", "x", "anchor", "first", "second",
                                               "whole")}  # fmt: skip
    return SI | lengths | {"units": "US", "density": 1025 * FOOT**3 / KIP, "mass": 200 * FOOT / KIP,
                           "stiffness": 854e6 / KIP_FORCE}  # fmt: skip


@pytest.mark.parametrize("words", [SI, us()], ids=["SI", "US"])
def test_lines_of_orcaflex_hang_by_their_weight_in_water_whatever_its_units(tmp_path, words):
    """Two lines alike on both sides of a barge turned by 90°: (200 − 1025 π/4 0.18²) g N/m; the cable floats"""
    (tmp_path / "a.yml").write_text(ORCAFLEX.format(**words))
    with pytest.warns(UserWarning, match=r"line cable floats \(float, -880.8"):
        system = read_system(tmp_path / "a.yml")
    one, two = system.lines
    weight = (200 - 1025 * math.pi / 4 * 0.18**2) * 9.80665
    assert [piece.weight for piece in one.segments] == pytest.approx([weight, weight])
    assert (two.type.weight, two.type.axial_stiffness, two.length) == pytest.approx((weight, 854e6, 190.0))
    assert system.depth == pytest.approx(50) and system.density == pytest.approx(1025)
    (body,) = system.bodies
    assert body.position == pytest.approx((20, 0, 0, 0, 0, math.pi / 2))
    found = rest(system)
    np.testing.assert_allclose(found.points[0], (20, 10, 0), atol=1e-6)  # 10 m ahead of a bow that heads +y
    np.testing.assert_allclose(found.lines.tension_a[0], found.lines.tension_b[1], rtol=1e-6)
    hanging = found.lines.tension_a[0] - found.lines.horizontal_a[0]  # w h, but for stretch: T₁ − T₀ of a catenary
    assert hanging == pytest.approx(weight * 50, rel=2e-3)


@pytest.mark.filterwarnings("ignore:.*line cable floats")
def test_a_vessel_of_orcaflex_that_says_no_turn_or_place_has_none(tmp_path):
    for old in ("    Orientation: [0, 0, 90]\n", "    InitialPosition: [20, 0, 0]\n"):
        text = ORCAFLEX.format(**SI)
        assert old in text
        (tmp_path / "a.yml").write_text(text.replace(old, ""))
        (body,) = read_system(tmp_path / "a.yml").bodies
        assert body.position[5] == (0.0 if "Orient" in old else math.pi / 2)
        assert body.position[0] == (20.0 if "Orient" in old else 0.0)


def test_what_a_model_of_orcaflex_lacks_is_named(tmp_path):
    good = ORCAFLEX.format(**SI)
    for old, new, says in (
        ("EA: 854e3", "EA: rope", "EA of line type chain is 'rope', as variable data are"),
        (
            "[barge, 10, 0, 0, 0]",
            "[buoy, 10, 0, 0, 0]",
            "end A of line one is connected to buoy; allowed: Fixed, Anchored",
        ),
        ("[chain, 100, 5]", "[wire, 100, 5]", "line one has the types wire, chain"),
        (
            "Orientation: [0, 0, 90]",
            "Orientation: [0, 5, 90]",
            "vessel barge has no InitialPosition of three",
        ),
        ("EndAZ: -50", "EndAW: 0", "end A of line two has no X, Y, Z"),
    ):
        assert old in good
        (tmp_path / "a.yml").write_text(good.replace(old, new))
        with pytest.raises(ValueError, match=says):
            read_system(tmp_path / "a.yml")
    with pytest.raises(FormatError, match=r"has no Lines: it contains only the differences from base\.dat"):
        system_of_moorpy(parse_yaml("BaseFile: base.dat\nVariableData: {}\n"))


FARM = """Lines between two turbines
----------------------- LINE TYPES ------------------------------------------------------
TypeName   Diam    MassDenInAir   EA         BA/-zeta   EI   Cd    Ca   CdAx  CaAx
(name)     (m)     (kg/m)         (N)        (N-s/-)    (-)  (-)   (-)  (-)   (-)
chain      0.18    200            8.54e8     -1         0    1.2   1    0     0
----------------------- POINTS ----------------------------------------------------------
ID  Attachment  X    Y   Z    Mass  Volume  CdA  Ca
(#) (-)         (m)  (m) (m)  (kg)  (m^3)  (m^2) (-)
1   Turbine1    10   0   -5   0     0       0    0
2   Turbine2   -10   0   -5   0     0       0    0
----------------------- LINES -----------------------------------------------------------
ID  LineType  AttachA  AttachB  UnstrLen  NumSegs  Outputs
(#) (name)    (#)      (#)      (m)       (-)      (-)
1   chain     1        2        105       20       -
----------------------- OPTIONS ---------------------------------------------------------
200   WtrDpth
"""
FSTF = """FAST.Farm by hand
3        Mod_SharedMooring - Shared mooring system model
"farm.dat"   SharedMoorFile - Name of file
--- WIND TURBINES ---
2     NumTurbines  - Number of wind turbines
WT_X    WT_Y    WT_Z    WT_FASTInFile
(m)     (m)     (m)     (string)
0.0     50.0    0.0     "one.fst"
120.0   50.0    0.0     "two.fst"
"""


def test_a_line_between_turbines_hangs_where_the_farm_has_them(tmp_path):
    """10 m towards each other of 120 m: 100 m apart, 5 m below the water"""
    (tmp_path / "farm.dat").write_text(FARM)
    (tmp_path / "farm.fstf").write_text(FSTF)
    (tmp_path / "farm.yaml").write_text(
        "array:\n  keys: [turbineID, x_location, y_location]\n  data:\n    - [1, 0, 50]\n    - [1, 120, 50]\n"
        "array_mooring:\n  file: farm.dat\nmooring:\n  water_depth: 200\n"
    )
    for system in (read_system(tmp_path / "farm.fstf"), read_system(tmp_path / "farm.yaml")):
        found = rest(system)
        np.testing.assert_allclose(found.points, [(10, 50, -5), (110, 50, -5)])
        assert found.lines.vertical_a[0] == pytest.approx(0.5 * 105 * (200 - 1025 * math.pi / 4 * 0.18**2) * 9.80665)
    with pytest.raises(
        FormatError, match="point 1 is in the axes of Turbine1, and this file does not give its position"
    ):
        read_moordyn_system(tmp_path / "farm.dat")
    with pytest.raises(FormatError, match="point 2 is in the axes of Turbine2, and 1 to 1 are known"):
        read_moordyn_system(tmp_path / "farm.dat", turbines={1: (0.0, 50.0, 0.0)})
    (tmp_path / "less.fstf").write_text(FSTF.replace("120.0   50.0    0.0", "x y z"))
    with pytest.raises(FormatError, match="2 turbines and 0 rows of WT_X"):
        read_fast_farm(tmp_path / "less.fstf")
    (tmp_path / "none.fstf").write_text(FSTF.replace("SharedMoorFile", "Other"))
    with pytest.raises(FormatError, match="lacks NumTurbines or SharedMoorFile"):
        read_fast_farm(tmp_path / "none.fstf")


def test_what_holds_no_system_is_told_for_what_it_is():
    for text, says in (
        ("site: {}\nmooring_line_configs: {}\nmooring_systems: {}\n", "is an ontology of FAModel"),
        ("modeling_options: {}\n", "has no mooring: .* it has modeling_options"),
        ("array_mooring:\n  file: a.dat\narray: {keys: [x]}\n", "array lacks x_location or y_location"),
    ):
        with pytest.raises(FormatError, match=says):
            system_of_moorpy(parse_yaml(text))


def test_columns_of_lines_in_another_order_are_known_or_refused(tmp_path):
    """MoorDyn of 2015: NumNodes for the number of segments, ends after it; a strange name there is no guess"""
    old = FARM.replace("Turbine1    10", "Fixed 10").replace("Turbine2   -10", "Fixed 110")
    head = "ID  LineType  AttachA  AttachB  UnstrLen  NumSegs  Outputs"
    row = "1   chain     1        2        105       20       -"
    old = old.replace(head, "Line LineType UnstrLen NumNodes NodeAnch NodeFair Flags/Outputs")
    old = old.replace(row, "1 chain 105 2 1 2 p")
    (tmp_path / "old.txt").write_text(old)
    (line,) = read_moordyn_system(tmp_path / "old.txt").lines
    assert (line.length, line.a, line.b, line.elements) == (105.0, "1", "2", 2)
    (tmp_path / "strange.txt").write_text(old.replace("NumNodes", "HowMany"))
    with pytest.raises(
        FormatError, match="column 'howmany' is unknown, and 'unstrlen' is not in its place in MoorDyn version 2"
    ):
        read_moordyn_system(tmp_path / "strange.txt")


@pytest.mark.filterwarnings("ignore:.*line cable floats")
def test_a_model_of_orcaflex_without_water_or_units_has_those_given_and_si(tmp_path):
    """1025 kg/m³; the depth is given beside the file, which an environment of its own need not repeat"""
    text = ORCAFLEX.format(**SI)
    environment, general = "Environment:\n  Density: 1.025\n  WaterDepth: 50\n", "General:\n  UnitsSystem: SI\n"
    assert environment in text and general in text
    for left_out, more in ((environment, ""), (environment, "Environment:\n"), (general, "General:\n")):
        (tmp_path / "a.yml").write_text(text.replace(left_out, more))
        system = read_system(tmp_path / "a.yml", 50.0)
        assert (system.depth, system.density) == (50.0, pytest.approx(1025.0))
        assert system.lines[1].type.axial_stiffness == pytest.approx(854e6)
