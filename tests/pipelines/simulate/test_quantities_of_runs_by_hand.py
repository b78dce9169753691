"""What the result of runs has of lines, fenders, gaps, hinges and windows, from a file that is made up."""

import json
from types import SimpleNamespace

import h5py
import numpy as np
import pytest

from hakobune.mooring.lines.catalogue import fibre_lines, line_type
from hakobune.mooring.lines.multi_segment.segments import Segment
from hakobune.mooring.lines.system.parts import CompositeLine, LineType, UniformLine
from hakobune.pipelines.simulate import findings, result
from hakobune.pipelines.simulate.file import STATISTICS, SUMMARY


class Texts:
    """A dataset of names"""

    def __init__(self, *names):
        self.names = names

    def asstr(self):
        return np.array(self.names, dtype=object)

    def __len__(self):
        return len(self.names)


class File(dict):
    """Stand-in of an open file: datasets by name, attributes"""

    def __init__(self, datasets, **attributes):
        super().__init__(datasets)
        self.attrs = attributes


def row(start):
    """{statistic: value} that rise by 1 from `start`, in the order of SUMMARY"""
    return {name: start + i for i, name in enumerate(SUMMARY)}


@pytest.fixture
def runs(monkeypatch):
    """Two whole runs and one that is not, of two lines and two fenders"""
    monkeypatch.setattr(result, "whole_rows", lambda file: np.array([True, False, True]))
    used = np.array([[0.2, 0.5], [0.4, 0.3]])
    monkeypatch.setattr(result, "used_in_runs", lambda file: used)
    largest = np.array([[1e5, 2e5], [4e5, 3e5]])
    monkeypatch.setattr(result, "largest_in_runs", lambda file, kind: (largest, ["bow", "stern"]))
    monkeypatch.setattr(result, "bodies_of", lambda file: ())
    return largest


def shown(made):
    return {name: (one.unit, bool(one.table), one.share) for name, one in made.items()}


def test_lines_have_their_largest_use_of_all_runs_and_the_largest_of_each(runs):
    """A file without ropes or fenders says breaking load and has no working load"""
    rows = [row(100.0), row(200.0)]
    made = result._of_lines(File({}, breaking_load=[1e6, np.inf], allowable=0.4), rows)
    assert made["tension.used"].values.tolist() == [0.4, 0.5]
    assert made["tension.largest_of_seed"].values.tolist() == runs.tolist()
    assert made["tension.largest_of_seed"].axes == ("seed", "line")
    for key in ("mean", "sigma", "smallest", "largest"):
        assert made[f"tension.{key}"].values.tolist() == [one[key] for one in rows]
    printed = {name for name, one in made.items() if one.table}
    assert printed == {f"tension.{key}" for key in ("mean", "sigma", "smallest", "largest", "used")}
    assert made["line.breaking_load"].description == "breaking load"
    assert {one.unit for name, one in made.items() if name in printed} == {"N", ""} and made["tension.used"].share
    assert not {"line.working_load", "tension.simplified"} & set(made)
    assert result._of_lines(File({}), []) == {}


def test_a_berth_has_working_loads_and_what_of_them_is_used(runs):
    """0.4 of 1000 and 800 kN; what is used of a breaking load over 0.4"""
    file = File({}, breaking_load=[1e6, 8e5], allowable=0.4, fender_height=[1.0])
    made = result._of_lines(file, [row(1.0), row(2.0)])
    assert made["line.working_load"].values == pytest.approx([4e5, 3.2e5])
    assert made["tension.used_of_working"].values == pytest.approx([1.0, 1.25])
    assert made["tension.used_of_working"].share and made["line.breaking_load"].description == "MBL"
    assert all(made[name].table == result.LINES for name in ("line.breaking_load", "line.working_load"))


def test_runs_stand_beside_the_simplified_method(runs):
    rows = [row(100.0), row(200.0)]
    largest = np.array([one["largest"] for one in rows])
    file = File({}, breaking_load=[1e6, 1e6], allowable=0.4, simplified_tension=[50.0, 400.0],
                simplified_utilisation=[0.1, 0.9])  # fmt: skip
    made = result._of_lines(file, rows)
    assert made["tension.simplified"].values.tolist() == [50.0, 400.0] and made["tension.simplified"].unit == "N"
    assert made["tension.over_simplified"].values == pytest.approx(largest / [50.0, 400.0])
    assert made["tension.used_simplified"].values.tolist() == [0.1, 0.9] and made["tension.used_simplified"].share


def test_fenders_have_deflections_reactions_and_what_of_the_rated_is_used(runs, monkeypatch):
    values = {f"{what} {name}": row(start) for what, start in (("deflection", 0.0), ("reaction", 1e5))
              for name, start in (("fore", start), ("aft", 2 * start + 1))}  # fmt: skip
    monkeypatch.setattr(result, "fender_strains", lambda file: (np.array([0.3, 0.4]), np.array([0.5, 0.6])))
    made = result._of_fenders(File({}, fender_rated_reaction=[4e5, 8e5]), ["fore", "aft"], values)
    for what, unit in (("deflection", "m"), ("reaction", "N")):
        rows = [values[f"{what} {name}"] for name in ("fore", "aft")]
        for key, statistic in (("mean", "mean"), ("largest", "largest"), ("extreme_median", "upper_median")):
            one = made[f"{what}.{key}"]
            assert one.values.tolist() == [each[statistic] for each in rows] and one.unit == unit
            assert bool(one.table) is (key != "extreme_median")
            assert one.description == f"{key} {what}" or key == "extreme_median"
    largest = np.array([values[f"reaction {name}"]["largest"] for name in ("fore", "aft")])
    assert made["reaction.used"].values == pytest.approx(largest / [4e5, 8e5]) and made["reaction.used"].share
    assert made["reaction.rated"].values.tolist() == [4e5, 8e5] and made["reaction.rated"].unit == "N"
    assert made["strain.largest"].values.tolist() == [0.3, 0.4] and made["strain.largest"].share
    assert made["strain.allowable"].values.tolist() == [0.5, 0.6] and made["strain.allowable"].share
    monkeypatch.setattr(result, "fender_strains", lambda file: None)
    less = result._of_fenders(File({}), ["fore", "aft"], values)
    assert not {"reaction.rated", "reaction.used", "strain.largest"} & set(less)
    assert result._of_fenders(File({}), [], {}) == {}


def test_gaps_have_their_mean_smallest_and_largest():
    names = ["surge", "gap a b", "gap b c"]
    values = {"surge": row(0.0), "gap a b": row(10.0), "gap b c": row(20.0)}
    made = result._of_gaps(names, values)
    assert set(made) == {"gap.mean", "gap.smallest", "gap.largest"}
    for key in ("mean", "smallest", "largest"):
        one = made[f"gap.{key}"]
        assert one.values.tolist() == [values["gap a b"][key], values["gap b c"][key]]
        assert (one.unit, one.axes, one.table) == ("m", ("gap",), result.GAPS)
    assert result._of_gaps(["surge"], values) == {}


def test_hinges_and_stations_have_the_units_of_each():
    units, values = {"pin Fx": "N", "pin My": "N m"}, {"pin Fx": row(1.0), "pin My": row(50.0)}
    made = result._at_places("hinge", result.HINGES, ["pin Fx", "pin My"], units, values)
    assert set(made) == {"hinge.mean", "hinge.sigma", "hinge.smallest", "hinge.largest"}
    for key in ("mean", "sigma", "smallest", "largest"):
        one = made[f"hinge.{key}"]
        assert one.values.tolist() == [values["pin Fx"][key], values["pin My"][key]] and one.unit == ("N", "N m")
        assert one.table == result.HINGES and one.axes == ("hinge",)
    assert result._at_places("hinge", "", [], {}, {}) == {}


def test_runs_have_their_number_duration_period_and_split(runs, monkeypatch):
    """Of three rows two are whole; the allowable share is in files alone, in per cent"""
    file = File({}, duration=1800.0, mean_period=8.0, split_frequency=0.3, allowable=0.4, spectral_slow=[1.0, 2.0, 0.1])
    made = result._scalars(file)
    assert {name: float(one.values) for name, one in made.items() if one.values.ndim == 0} == {
        "seeds": 2, "duration": 1800.0, "mean_period": 8.0, "split_frequency": 0.3, "allowable": 0.4,
    }  # fmt: skip
    assert shown(made) == {
        "seeds": ("", True, False), "duration": ("s", True, False), "mean_period": ("s", True, False),
        "split_frequency": ("rad/s", True, False), "allowable": ("", False, True),
        "slow_by_spectrum": (("m", "m", "rad"), False, False),
    }  # fmt: skip
    assert made["slow_by_spectrum"].values.tolist() == [1.0, 2.0, 0.1]
    monkeypatch.setattr(result, "bodies_of", lambda file: ("a", "b"))
    assert "slow_by_spectrum" not in result._scalars(file)


def test_periods_at_a_berth_are_those_of_the_file():
    made = result._of_berth(File({}, natural_period=[60.0, np.nan, 45.0]))["natural_period"]
    assert made.values == pytest.approx([60.0, np.nan, 45.0], nan_ok=True)
    assert (made.unit, made.axes, made.table) == ("s", ("plane",), result.BERTH)
    assert result._of_berth(File({})) == {}


def test_windows_are_of_the_first_record_that_is_kept(monkeypatch):
    asked, numbers = [], np.arange(6.0).reshape(2, 3)
    found = SimpleNamespace(start=[0.0, 100.0], amplitude=numbers, period=10 + numbers)
    monkeypatch.setattr(result, "windows", lambda motion, *more: asked.append((motion.shape, *more)) or found)
    file = File({"time": np.array([0.0, 0.25, 0.5]), "motion": np.zeros((2, 3, 6), np.float32), "kept_seed": [7, 8]})
    start, made = result._windows(file, 100.0)
    assert asked == [((3, 6), 0.25, 100.0)] and start == [0.0, 100.0]
    for k, (name, unit) in enumerate((("surge", "m"), ("sway", "m"), ("yaw", "rad"))):
        one, period = made[f"window.{name}"], made[f"window.{name}_period"]
        assert one.values.tolist() == [k, 3 + k] and one.unit == unit
        assert period.values.tolist() == [10 + k, 13 + k] and period.unit == "s"
        assert one.table == "seed 7 in windows of 100 s" and one.description == f"{name}, significant amplitude"


# ------------------------------------------------------------------ strains, and what fails


def test_strains_of_fenders_are_of_the_rubber_alone(monkeypatch):
    """0.5 m of 2 m is 0.25 of both; half of it is the fender's, of which 0.1 m is allowed of 1 m"""
    from hakobune.pipelines.simulate import berth

    knots = [[[0.0, 1.0], [0.0, 0.5]], [[0.0, 1.0], [0.0, 1.0]]]
    file = File({"fender": Texts("f", "g")}, fender_strains=json.dumps(knots), fender_height=[2.0, 1.0],
                fender_allowable=[0.12, 0.3])  # fmt: skip
    largest = {"deflection f": 0.5, "deflection g": 0.3}
    monkeypatch.setattr(berth, "summary_of", lambda file, name: {"largest": largest[name], "mean": 9.0})
    share, allowable = berth.fender_strains(file)
    assert share == pytest.approx([0.125, 0.3]) and allowable.tolist() == [0.12, 0.3]
    (failed,) = berth.findings_on_fenders(file)
    assert "f" in failed and "12" in failed
    assert berth.fender_strains(File({})) is None and list(berth.findings_on_fenders(File({}))) == []


def test_the_worst_line_fender_or_motion_is_that_of_all_whole_runs(monkeypatch):
    """Without lines the fender, without both the motion that takes the hull of 100 by 40 m farthest, either way"""
    from hakobune.pipelines.simulate import pictures

    monkeypatch.setattr(pictures, "whole_rows", lambda file: np.array([True, False, True]))
    monkeypatch.setattr(pictures, "bodies_of", lambda file: ())
    motions = ["surge", "sway", "heave", "roll", "pitch", "yaw"]

    def file(lines, fenders, values):
        names = [*motions, "wave", *(f"tension {one}" for one in lines), *(f"deflection {one}" for one in fenders)]
        statistics = np.zeros((3, len(names), len(STATISTICS)))
        for (run, name), value in values.items():
            statistics[run, names.index(name), STATISTICS.index("largest" if value > 0 else "smallest")] = value
        return File({"line": Texts(*lines), "quantity": SimpleNamespace(asstr=lambda: np.array(names)),
                     "statistics": statistics}, hull=[100.0, 40.0, 10.0, 5.0])  # fmt: skip

    own = {(0, "tension a"): 5e5, (2, "tension b"): 6e5, (1, "tension a"): 9e9, (0, "deflection f"): 9e9}
    worst = pictures._worst(file(["a", "b"], ["f"], own))
    assert worst == ("tension", 1, "b", 1e-3, "kN") and worst.quantity == "tension b"
    own = {(0, "deflection f"): 0.2, (2, "deflection g"): 0.3, (1, "deflection f"): 9.0, (0, "surge"): 50.0}
    worst = pictures._worst(file([], ["f", "g"], own))
    assert worst == ("deflection", 1, "g", 1.0, "m") and worst.quantity == "deflection g"
    moved = {(0, "surge"): 3.0, (2, "roll"): np.radians(4.0), (1, "sway"): 9.0}  # 4° is 1.4 m at 20 m
    assert pictures._worst(file([], [], moved))[1:] == (0, "surge", 1.0, "m")
    worst = pictures._worst(file([], [], {**moved, (2, "pitch"): np.radians(-4.0)}))  # 3.5 m at 50 m
    assert worst[:3] == ("motion", 4, "pitch") and worst.unit == "°" and worst.quantity == "pitch"
    assert worst.factor == pytest.approx(180 / np.pi)
    assert pictures._worst(file([], [], {**moved, (2, "sway"): -3.1})).name == "sway"


@pytest.mark.parametrize(("least", "fibre", "told"), [
    (9.9e3, "bow", True), (10.1e3, "bow", False), (5e3, "stern", False), (5e3, "", False),
])  # fmt: skip
def test_ropes_of_fibre_are_slack_below_a_hundredth_of_what_breaks_them(least, fibre, told):
    """Of 1000 kN; the stern line keeps 20 kN"""
    with h5py.File("made up", "w", driver="core", backing_store=False) as file:
        file["line"], file["quantity"] = ["bow", "stern"], ["tension bow", "tension stern"]
        file["summary"] = [[{"smallest": low, "largest": 4e5}.get(key, 1e5) for key in SUMMARY] for low in (least, 2e4)]
        file.attrs["breaking_load"], file.attrs["fibre_lines"] = [1e6, 1e6], fibre
        said = list(findings.fibre_findings(file))
    assert bool(said) is told
    if told:
        assert said[0].startswith("ropes of fibre fall slack: bow 9.9 kN; limit of the smallest tension: 1 %")


def test_a_line_with_a_piece_of_polyester_is_one_of_fibre():
    chain, rope, bare = line_type("R3 studless 44 mm"), line_type("polyester 72 mm"), LineType("own", 100.0)
    lines = [UniformLine(name, one, 10.0, "e", "f") for name, one in zip("abc", (chain, rope, bare), strict=True)]
    lines.append(CompositeLine("d", tuple(Segment(9.0, one.weight, kind=one) for one in (chain, rope)), "e", "f"))
    system = SimpleNamespace(line_names=["a", "b", "c", "d"], lines=lines)
    assert list(fibre_lines(system)) == ["b", "d"]
