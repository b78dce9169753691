"""What values of moorings say of themselves, and small numbers behind them, by hand."""

import math
from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.breakwater.exact import free_exact
from hakobune.mooring.criteria.verdict import Case, judge
from hakobune.mooring.downtime import planes as of_planes
from hakobune.mooring.downtime.every_hour import _of_spreading
from hakobune.mooring.downtime.hindcast import Hindcast, WaveHours
from hakobune.mooring.environment.gusts import GustSpectrum
from hakobune.mooring.environment.scatter import Scatter
from hakobune.mooring.environment.spreading import CosinePower, HalfCosinePower, Mitsuyasu, WrappedNormal
from hakobune.mooring.fenders.fender import FenderError, fender_of_points
from hakobune.mooring.formats.moordyn import MoorDynFile
from hakobune.mooring.formats.moordyn_left_out import left_out
from hakobune.mooring.formats.moordyn_ropes import largest_tensions
from hakobune.mooring.formats.moordyn_writing import _positive
from hakobune.mooring.formats.orcaflex import _line, _named, _number, column
from hakobune.mooring.lines.multi_segment.segments import Segment
from hakobune.mooring.lines.system.bodies import places_along
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.parts import CompositeLine, LineType, UniformLine
from hakobune.mooring.single_point.equilibria import Equilibrium
from hakobune.mooring.studies.in_air import _weighs_as_in_water

CELL = fender_of_points("cell", 2.0, [0.0, 0.5, 1.0], [0.0, 5e5, 1e6], rated=0.5)


def test_values_say_what_they_are_in_units_of_their_readers():
    """A straight fender of 1e6 N/m takes ½ · 1e6 · 1² J at 1 m; σ is the root of the variance"""
    hours = np.array(["2001-01-01T00", "2001-01-01T03"], "datetime64[s]")
    waves = WaveHours(np.ones(2), np.ones(2), np.zeros(2))
    assert repr(Hindcast(hours, 10800.0, (waves,))) == (
        "<Hindcast 2 rows of 3 h, 2001-01-01T00:00:00 to 2001-01-01T03:00:00>"
    )
    assert repr(GustSpectrum("mine", 20.0, 9.0, 50.0, "kaimal")) == "<GustSpectrum mine, 20 m/s, σ = 3 m/s>"
    diagram = Scatter(np.array([1.0, 2.0]), np.array([6.0, 8.0, 10.0]), np.ones((2, 3)), "mean_period")
    assert repr(diagram) == "<Scatter 2 heights 1 to 2 m, 3 mean periods 6 to 10 s>"
    assert str(HalfCosinePower(5.0)).endswith("cosine of half the angle to the power of 10")
    assert str(WrappedNormal(math.radians(30.0))).endswith("normally, 30° of deviation")
    assert str(Mitsuyasu(25.0, 0.8)).endswith("after Mitsuyasu, s_max 25")
    assert repr(CELL) == "<Fender cell, 2 m: 1000 kN and 500 kJ at 50 %>"
    held = {one.name: None for one in fields(Equilibrium)} | {
        "heading": math.pi / 6,
        "force": np.array([3e4, 4e4, 9e9]),
    }
    assert repr(Equilibrium(**held)) == "<Equilibrium heading 30.00°, pull 5e+04 N>"


@pytest.mark.parametrize("power, words", [
    ((-math.pi / 2, math.pi / 2), ""), ((-0.5, math.pi / 2), " between -28.65° and 90°"),
    ((-math.pi / 2, 0.5), " between -90° and 28.65°"),
])  # fmt: skip
def test_a_power_of_cosine_names_its_sector_where_it_is_not_the_half_circle(power, words):
    assert str(CosinePower(4.0, *power)) == f"spread over directions by cosine to the power of 4{words}"


def test_as_many_reactions_as_deflections_are_required():
    with pytest.raises(FenderError, match="f: 3, 2 and 2 deflections, reactions and unloading values; allowed"):
        fender_of_points("f", 2.0, [0.0, 0.5, 1.0], [0.0, 5e5])
    with pytest.raises(FenderError, match="f: 2, 2 and 3 deflections"):
        fender_of_points("f", 2.0, [0.0, 1.0], [0.0, 5e5], [0.0, 1.0, 2.0])
    with pytest.raises(FenderError, match="f: 1, 1 and 1 deflections"):
        fender_of_points("f", 2.0, [0.0], [0.0])


@pytest.mark.parametrize("law, harmonics", [
    (CosinePower(2.0, -math.pi / 2, math.pi / 2), [1.0, 8 / (3 * math.pi), 0.5]),
    (WrappedNormal(0.4), [math.exp(-0.5 * (n * 0.4) ** 2) for n in range(3)]),
    (HalfCosinePower(3.0), [1.0, 3 / 4, 3 * 2 / (4 * 5)]),
    (None, [1.0, 1.0, 1.0]),
])  # fmt: skip
def test_harmonics_of_a_spreading_are_its_integrals_with_cosines(law, harmonics):
    """∫ D cos nθ dθ: of (2/π) cos² over a half circle 8/3π and ½; of a wrapped normal e^{−n²σ²/2}

    Of cos²ˢ(θ/2) s/(s + 1), s (s − 1)/(s + 1)(s + 2)
    """
    found = _of_spreading(law, SimpleNamespace(peak_omega=1.0), np.array([1.0]), np.arange(3))
    assert found[0] == pytest.approx(harmonics, abs=1e-6)


def test_harmonics_of_mitsuyasus_spreading_are_those_of_its_exponent_at_each_frequency():
    """s = 10 (½)⁵ below the peak at half of it, 10 · 2^−2.5 at twice"""
    omega, number = np.array([0.4, 1.6]), np.arange(3)
    found = _of_spreading(Mitsuyasu(10.0, 0.3), SimpleNamespace(peak_omega=0.8), omega, number)
    for row, s in zip(found, (10 / 32, 10 / 2**2.5), strict=True):
        assert row == pytest.approx([1.0, s / (s + 1), s * (s - 1) / ((s + 1) * (s + 2))], abs=1e-9)


def test_planes_are_per_radian_per_second_and_hours_are_of_the_file_that_has_them(monkeypatch):
    """A density over f in Hz is 2π times that over ω"""
    monkeypatch.setattr(of_planes, "planes_of", lambda path, place: [(0, 0, 0, np.full((1, 1, 1), 2 * np.pi * path))])
    planes = of_planes.Planes((1.0, 3.0), (2, 1), None, np.ones(1), np.ones(1))
    assert [float(one[0, 0, 0]) for one in planes.density()] == pytest.approx([1.0, 3.0])
    assert [planes.path(row) for row in range(3)] == [1.0, 1.0, 3.0]


def test_a_body_that_capsizes_is_told_its_metacentric_height(monkeypatch):
    """GM = C/ρgA: −2e5/(1000 · 10 · 20) = −1 m"""
    monkeypatch.setattr("hakobune.mooring.breakwater.exact.check_section", lambda *_: None)
    body = SimpleNamespace(roll_stiffness=-2e5, density=1000.0, gravity=10.0, area=20.0)
    with pytest.raises(ValueError, match="metacentric height -1 m without lines: the body capsizes"):
        free_exact(body, None)


def criterion(**more):
    return SimpleNamespace(**{"quantity": "tension", "limit": 1.0, "sense": "max", "state": "any", "lines": "any",
                              "analysis": "any", "holds": lambda *_: True} | more)  # fmt: skip


def test_a_quantity_that_only_partial_cases_could_have_is_named(monkeypatch):
    """A case that is partial need not have a quantity, another has to; analysis, state and lines choose the cases"""

    def lacking(*_):
        raise LookupError("tension")

    monkeypatch.setattr("hakobune.mooring.criteria.verdict._use", lacking)
    case = SimpleNamespace(name="a", state="x", lines="y", analysis="z", partial=True)
    (one,) = judge([criterion()], [case])
    assert (one.uses, one.met, one.missing) == ((), None, "no load case has tension")
    case.partial = False
    (one,) = judge([criterion()], [case])
    assert one.missing == "a has no tension"
    left_out = criterion(holds=lambda *_: False, state="extreme", lines="lost")
    (one,) = judge([left_out], [case])
    assert one.missing.startswith("no load case is extreme, lines lost; add such a state")
    (one,) = judge([left_out], [])
    assert one.missing == "no load case could be run"


@pytest.mark.parametrize("parts", [None, {}, {"strain": {"F1": 0.2, "F2": 0.6}}])
def test_what_a_criterion_is_of_is_sought_among_parts_motions_and_the_rest(parts):
    """The worst part; a motion from side to side is twice its amplitude; of none of them the case says so"""
    case = Case("c", "extreme", "intact", "any", {}, {"surge": 1.5}, {"life": 50.0}, parts)
    values = {}
    for quantity, statistic in (("strain", ""), ("surge", ""), ("surge", "peak to peak"), ("life", "")):
        one = criterion(quantity=quantity, statistic=statistic, motion_factor=1.0, utilisation=lambda value: value / 2)
        (found,) = judge([one], [case])
        values[quantity + statistic] = found.missing or (
            found.uses[0].item,
            found.uses[0].value,
            found.uses[0].utilisation,
        )
    assert values == {
        "strain": ("F2", 0.6, 0.3) if parts else "c has no strain", "surge": ("surge", 1.5, 0.75),
        "surgepeak to peak": ("surge", 3.0, 1.5), "life": ("life", 50.0, 25.0),
    }  # fmt: skip


@pytest.mark.parametrize("section, title", [("control", "CONTROL"), ("external", "EXTERNAL LOADS")])
def test_a_section_of_moordyn_that_is_not_used_is_told(section, title):
    said = left_out(MoorDynFile((), **{section: ("a row",)}))
    assert f"section {title} is not used" in said
    assert not any("is not used" in line for line in left_out(MoorDynFile(())))


@pytest.mark.parametrize("text, says", [
    ("1,2 5e5 2e5", None), ("1,7 5e5 2e5", "line 7 is unknown"), ("1,2 5e5", "'1,2 5e5' does not give line numbers"),
    ("1,2 many 2e5", "does not give line numbers, Tmax0 and Tmean0"), ("# a remark", None),
])  # fmt: skip
def test_largest_tensions_of_ropes_are_of_lines_that_are_there(text, says):
    file = SimpleNamespace(lines=[SimpleNamespace(id=i) for i in "12"], syrope=["names", "units", text])
    if says is None:
        assert largest_tensions(file, "f") == ({} if text[0] == "#" else {"1": 5e5, "2": 5e5})
    else:
        with pytest.raises(ValueError, match="f, section SYROPE IC") as refused:
            largest_tensions(file, "f")
        assert says in str(refused.value)


@pytest.mark.parametrize("name, text, taken", [
    ("dtM", "0.001", True), ("dtM", "0", False), ("dtM", "soon", False), ("dtM", "inf", False), ("kBot", "0", True),
    ("kBot", "-1", False), ("kBot", "hard", False),
])  # fmt: skip
def test_settings_that_are_kept_for_moordyn_are_numbers_from_0_and_a_step_above(name, text, taken):
    if taken:
        assert _positive(name, text) == float(text)
    else:
        with pytest.raises(ValueError, match=f"option {name} of the file that was read is '{text}'"):
            _positive(name, text)


def test_tables_of_orcaflex_are_rows_with_names_or_a_table_by_names():
    """A column stands alone, among others of a table, or by places in brackets, in whatever order"""
    by_names = _named({"Lines": {"a": {"Length": 3.0}, "b": None}}, "Lines", "f")
    assert by_names == {"a": {"Name": "a", "Length": 3.0}, "b": {"Name": "b"}}
    assert _named({"Lines": [{"Name": "a"}]}, "Lines", "f") == {"a": {"Name": "a"}} and _named({}, "Lines", "f") == {}
    for rows in (["a"], [{"Length": 3.0}], "a"):
        with pytest.raises(ValueError, match="f: Lines is not a list of entries with a Name each"):
            _named({"Lines": rows}, "Lines", "f")
    table = {"LineType, Length": [["chain", 10.0], ["wire", 20.0]], "OD": 0.1, "Weight": [1.0, 2.0]}
    assert column(table, "Length") == [10.0, 20.0] and column(table, "LineType") == ["chain", "wire"]
    assert (column(table, "OD"), column(table, "Weight"), column(table, "None")) == ([0.1], [1.0, 2.0], [])
    assert column({"Length[2]": 5.0, "Length[1]": 4.0}, "Length") == [4.0, 5.0]
    assert _number({"OD": "854e3"}, "OD", "w", "f", 1e3) == 854e6 and _number({}, "OD", "w", "f", 1e3, 2.0) == 2.0
    for given, says in (({"OD": "vary"}, "OD of w is 'vary', as variable data are"), ({}, "OD of w is missing"),
                        ({"OD": math.inf}, "OD of w is inf; allowed: finite")):  # fmt: skip
        with pytest.raises(ValueError, match=says):
            _number(given, "OD", "w", "f", 1e3)


def test_a_line_of_orcaflex_is_uniform_or_of_segments_and_its_attachments_are_told():
    kind, ends = LineType("chain", 900.0, 1e8, 80.0, 0.1, 5e6), ("a", "b")
    with pytest.warns(UserWarning, match="f: attachments of line n are not read: clump weights, floats"):
        one = _line({"AttachmentType": "clump"}, "n", ends, [(kind, 30.0)], "f")
    assert isinstance(one, UniformLine) and (one.length, one.a, one.b) == (30.0, "a", "b")
    two = _line({}, "n", ends, [(kind, 30.0), (kind, 5.0)], "f")
    assert isinstance(two, CompositeLine) and [part.length for part in two.segments] == [30.0, 5.0]
    (first, *_) = two.segments
    assert (first.weight, first.axial_stiffness, first.diameter, first.breaking_load) == (900.0, 1e8, 0.1, 5e6)


def test_places_of_bodies_turn_with_their_headings_and_their_turns_do_not():
    """A body headed to 90° surges along y of space and sways to −x; the second of two has its own heading"""
    turn = places_along(np.radians([90.0, 180.0]))
    surge, sway, roll = turn[:, 0], turn[:, 1], turn[:, 3]
    assert surge[:6] == pytest.approx([0, 1, 0, 0, 0, 0], abs=1e-12) and not surge[6:].any()
    assert sway[:3] == pytest.approx([-1, 0, 0], abs=1e-12) and roll[:6] == pytest.approx([0, 0, 0, 1, 0, 0])
    assert turn[6:9, 6:9] == pytest.approx(np.diag([-1.0, -1.0, 1.0]), abs=1e-12)
    assert turn[9:, 9:] == pytest.approx(np.eye(3)) and not turn[6:, :6].any()


@pytest.mark.parametrize("line, wet", [
    (UniformLine("n", LineType("t", 900.0, 1e8, 100.0), 30.0, "a", "b"), True),
    (UniformLine("n", LineType("t", 900.0, 1e8, 100.0), 30.0, "a", "b", weight_in_air=981.0), False),
    (UniformLine("n", LineType("t", 900.0, 1e8), 30.0, "a", "b"), True),
    (UniformLine("n", LineType("t", 981.0, 1e8, 100.0), 30.0, "a", "b"), False),
    (UniformLine("n", LineType("t", 979.9, 1e8, 100.0), 30.0, "a", "b"), True),
    (UniformLine("n", LineType("t", -20.0, 1e8, 100.0), 30.0, "a", "b"), False),
    (CompositeLine("n", (Segment(30.0, 900.0),), "a", "b"), True),
    (Hawser("n", pull_of_points("r", [0.0, 4.0], [0.0, 4e5]), 30.0, "a", "b"), False),
])  # fmt: skip
def test_a_line_weighs_above_the_water_as_in_it_unless_it_is_told_or_dry(line, wet):
    """100 kg/m weigh 981 N/m in air at 9.81 m/s², to a thousandth; what floats and a hawser are no matter of it"""
    assert _weighs_as_in_water(line, 9.81) is wet
