"""Rows of files of lines that few writers give: what each says, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.formats import fast_farm, moordyn, moordyn_system, moorpy, orcaflex
from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.lines.system.parts import Anchor, Fairlead

WATER = SimpleNamespace(density=1000.0, gravity=10.0, path="lines.txt")
LINES = ["  3   NumTurbines - of the farm", '"a b\\c.dat"  SC_FileName - of it', "o'brien.dat  MD_Name  - of lines", ""]


@pytest.mark.parametrize("name, value", [
    ("NumTurbines", "3"), ("SC_FileName", "a b/c.dat"), ("MD_Name", "o'brien.dat"), ("Turbines", None), ("Name", None),
])  # fmt: skip
def test_a_value_of_fast_farm_stands_before_its_name(name, value):
    """In quotes with blanks, by slashes of either kind, or with a quote of its own"""
    assert fast_farm._value(LINES, name) == value


def test_options_may_begin_with_their_names_and_units():
    rows = [(7, "Option  Value"), (8, "(-)  (-)"), (9, "50.0  WtrDpth  the depth"), (10, "0.5 dtM")]
    assert moordyn._options(rows, "f") == {"WtrDpth": "50.0", "dtM": "0.5"}
    with pytest.raises(FormatError, match=r"line 11.*'12.5' is not a value and a name"):
        moordyn._options([*rows, (11, " 12.5 ")], "f")


@pytest.mark.parametrize("value, text", [(None, "0"), (0.1, "0.1"), (1e-7, "1e-07"), (3, "3"), ("Fixed", "Fixed")])
def test_a_cell_of_moordyn_is_its_value_and_nought_without_one(value, text):
    assert moordyn._cell(value) == text


def rod(attachment, end=(0.0, 4.0, -2.0)):
    return SimpleNamespace(id="3", type="bar", attachment=attachment, xa=1.0, ya=2.0, za=-3.0,
                           xb=end[0], yb=end[1], zb=end[2])  # fmt: skip


BODIES = SimpleNamespace(bodies=[SimpleNamespace(id="7", attachment="Free")],
                         rod_types=[SimpleNamespace(name="bar", mass=300.0, diameter=0.5)])  # fmt: skip


@pytest.mark.parametrize("attachment, kind, body", [
    ("Fixed", Anchor, None), ("Vessel", Fairlead, "vessel"), ("Coupled", Fairlead, "vessel"),
    ("Body7", Fairlead, "body 7"), ("b7", Fairlead, "body 7"),
])  # fmt: skip
def test_a_rod_that_does_not_move_by_itself_is_its_two_ends(attachment, kind, body):
    (a, b), none = moordyn_system._rod(rod(attachment), BODIES, WATER)
    assert none == [] and type(a) is type(b) is kind
    assert (a.name, a.position, b.name, b.position) == ("R3A", (1.0, 2.0, -3.0), "R3B", (0.0, 4.0, -2.0))
    assert body is None or (a.body, b.body) == (body, body)


def test_a_free_rod_is_a_body_about_its_middle_that_weighs_what_it_does_in_water():
    """From (1, 2, −3) to (0, 4, −2), √6 m of 300 kg/m less 1000 · π/4 · 0.25 kg/m of water; without length a point"""
    (a, b), (body,) = moordyn_system._rod(rod("Free"), BODIES, WATER)
    weight = math.sqrt(6) * (300 - 1000 * math.pi / 16) * 10
    assert body.name == "rod 3" and body.position == (0.5, 3.0, -2.5, 0.0, 0.0, 0.0)
    assert body.load == pytest.approx((0, 0, -weight, 0, 0, 0)) and len(body.freedom) == 6
    assert (a.position, b.position, a.body) == ((0.5, -1.0, -0.5), (-0.5, 1.0, 0.5), "rod 3")
    (point,), none = moordyn_system._rod(rod("free", (1.0, 2.0, -3.0)), BODIES, WATER)
    assert none == [] and (point.name, point.position) == ("R3", (1.0, 2.0, -3.0))
    with pytest.raises(FormatError, match="rod 3: type 'bar' is unknown"):
        moordyn_system._rod(rod("Free"), SimpleNamespace(bodies=[], rod_types=[]), WATER)
    with pytest.raises(FormatError, match="attachment of rod 3 is 'Body8'; allowed: Fixed, Coupled, Free, or Body"):
        moordyn_system._rod(rod("Body8"), BODIES, WATER)


@pytest.mark.parametrize("attachment, of, told", [
    ("Body7Pinned", "Free", True), ("Body7", "Free", False), ("Body7Pinned", "Fixed", False),
    ("Pinned", "Free", False), ("Body8Pinned", "Free", False),
])  # fmt: skip
def test_a_rod_without_lines_counts_where_it_turns_about_a_point_of_a_moving_body(attachment, of, told):
    file = SimpleNamespace(bodies=[SimpleNamespace(id="7", attachment=of)])
    if told:
        with pytest.raises(FormatError, match=f"rod 3 is attached to {attachment} by a hinge; allowed on a free body"):
            moordyn_system._check_idle(rod(attachment), file, "f")
    else:
        moordyn_system._check_idle(rod(attachment), file, "f")


def test_a_body_has_one_number_or_one_for_each_axis():
    def numbers(text, count=3):
        return list(moordyn_system._numbers(SimpleNamespace(id="1", cg=text), "cg", "f", count))

    assert numbers("0.1|0.2|-3")[:3] == [0.1, 0.2, -3.0] and 5.0 in numbers("5")
    for text in ("1|2", "1|x|3", "1|2|3|4"):
        with pytest.raises(FormatError, match=r"cg of body 1 is .*; allowed: 1 or 3 numbers with \| between"):
            numbers(text)


def test_a_table_of_moorpy_may_name_a_file_of_moordyn_beside_it(monkeypatch):
    monkeypatch.setattr(moorpy, "read_moordyn_system", lambda *given, **more: (given, more))
    (path, depth), more = moorpy.system_of_moorpy({"file": "lines.dat"}, "/there/farm.yaml", 75.0)
    assert (str(path), depth, more) == ("/there/lines.dat", 75.0, {})
    rest = {"line_types": [1], "points": [1], "lines": [1], "bodies": [1]}
    for data in (rest, {"mooring": rest}):
        with pytest.raises(FormatError, match="the table bodies is not read"):
            moorpy.system_of_moorpy(data, "farm.yaml", 75.0)


UNITS = SimpleNamespace(length=0.3)


def of_orcaflex(**changes):
    row = {"Connection": ["Fixed", "ship"], "ConnectionX": [1.0, 4.0], "ConnectionY": [2.0, 5.0],
           "ConnectionZ": [-3.0, 6.0]} | changes  # fmt: skip
    return row


@pytest.mark.parametrize("kind, z", [("Fixed", -0.9), ("Anchored", -100.9)])
def test_an_end_of_orcaflex_is_fixed_in_space_or_above_the_bed(kind, z):
    """A foot of 0.3 m; heights of an anchored end begin on the bed at 100 m"""
    point, body = orcaflex._end(of_orcaflex(Connection=[kind, "ship"]), "L", 0, "A", {}, UNITS, 100.0, "f")
    assert body is None and isinstance(point, Anchor) and point.name == "L A"
    assert point.position == pytest.approx((0.3, 0.6, z))


def test_an_end_of_orcaflex_on_a_vessel_has_the_vessel_and_its_heading():
    vessels = {"ship": {"InitialPosition": [10.0, 20.0, 0.0], "Orientation": [0, 0, 90.0]}}
    point, body = orcaflex._end(of_orcaflex(), "L", 1, "B", vessels, UNITS, 100.0, "f")
    assert (point.name, point.body) == ("L B", "ship") and point.position == pytest.approx((1.2, 1.5, 1.8))
    assert body.position == pytest.approx((3.0, 6.0, 0.0, 0.0, 0.0, math.pi / 2))
    old = {"EndAConnection": "Fixed", "EndBConnection": "ship", "EndBX": 4.0, "EndBY": 5.0, "EndBZ": 6.0}
    other = {"ship": {"InitialX": 10.0, "InitialY": 20.0, "InitialZ": 0.0, "InitialHeading": 90.0, "InitialHeel": 0.0,
                      "InitialTrim": 0.0}}  # fmt: skip
    again, where = orcaflex._end(old, "L", 1, "B", other, UNITS, 100.0, "f")
    assert again.position == pytest.approx(point.position) and where.position == pytest.approx(body.position)


@pytest.mark.parametrize("changes, says", [
    ({"ConnectionX": ["~", 4.0]}, "end A of line L has no X, Y, Z"),
    ({"Connection": ["Fixed"]}, "line L has 1 connections; allowed: two"),
    ({"Connection": ["tug", "ship"]}, "end A of line L is connected to tug; allowed: Fixed, Anchored, or one of "),
])  # fmt: skip
def test_an_end_of_orcaflex_without_a_place_is_told(changes, says):
    with pytest.raises(FormatError, match=says):
        orcaflex._end(of_orcaflex(**changes), "L", 0, "A", {}, UNITS, 100.0, "f")


@pytest.mark.parametrize("row, upright", [
    ({"InitialPosition": [1, 2, 3], "Orientation": [0, 0, 5]}, True), ({}, True),
    ({"InitialPosition": [1, 2], "Orientation": [0, 0, 5]}, False),
    ({"InitialPosition": [1, 2, 3], "Orientation": [0, 5]}, False),
    ({"InitialPosition": [1, 2, 3], "Orientation": [1, 0, 5]}, False),
    ({"InitialPosition": [1, 2, 3], "Orientation": [0, 1, 5]}, False),
    ({"InitialPosition": [1, "x", 3]}, False),
])  # fmt: skip
def test_a_vessel_of_orcaflex_has_a_place_and_is_upright(row, upright):
    if upright:
        found = np.array(orcaflex._vessel(row, "ship", UNITS, "f").position)
        wanted = [0.3, 0.6, 0.9, 0, 0, math.radians(5)] if row else np.zeros(6)
        assert found == pytest.approx(wanted)
    else:
        with pytest.raises(FormatError, match="vessel ship has no InitialPosition of three numbers, or it heels"):
            orcaflex._vessel(row, "ship", UNITS, "f")
