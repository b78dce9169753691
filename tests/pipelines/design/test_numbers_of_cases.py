"""What load cases give to criteria, by hand: strains and energies of fenders, ten minutes, cycles, lost lines."""

import copy
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.fenders.dolphin import bilinear, in_series
from hakobune.mooring.fenders.fender import fender_of_points
from hakobune.pipelines.design.kinds import berth, breakwater, in_time, mooring
from hakobune.pipelines.design.kinds.needs import DOLPHIN, OF_ALLOWABLE, OF_ENERGY, SLOW, TOTAL
from hakobune.pipelines.design.running import Ran, _holding, factors_of, given_parts, repeated
from hakobune.pipelines.simulate.file import STATISTICS, SUMMARY

K = 1e6  # N/m of a linear fender of 2 m, its table to 1 m, rated at 0.8, allowed to 0.9 m


def spring(name="F"):
    x = np.linspace(0.0, 1.0, 11)
    return fender_of_points(name, 2.0, x, K * x, None, rated=0.4, allowable=0.45)


def test_a_mean_of_ten_minutes_is_the_largest_of_all_places_and_runs():
    """A block of 600 s at 0.5 in a record of 0.1, across no edge; shorter records count as a whole"""
    record = np.full((2, 2000), 0.1)
    record[1, 700:1300] = 0.5  # 600 s of steps of 1 s
    assert berth._longest_mean(record, 1.0) == pytest.approx(0.5)
    record[1, 1000:1300] = 0.1
    assert berth._longest_mean(record, 1.0) == pytest.approx(0.3)
    assert berth._longest_mean(np.array([[0.2, 0.4]]), 1.0) == pytest.approx(0.3)


def test_fenders_are_judged_by_their_own_strain_energy_and_the_yield_of_their_dolphin(monkeypatch):
    """0.8 m of fender and dolphin of 4 K: 0.64 m of the fender's own of 2 m; of 0.9 m that are allowed; ½ K x² of
    that at 0.8 m; it pushes with 640 kN, the dolphin yields at 800"""
    monkeypatch.setattr("hakobune.pipelines.common.fender_tables.fender_of", lambda table: spring())
    names = ("deflection F",)
    row = dict.fromkeys(SUMMARY, 0.0) | {"largest": 0.8}
    file = {
        "quantity": SimpleNamespace(asstr=lambda: np.array(names)), "summary": np.array([list(row.values())]),
        "time": np.arange(1000.0), "deflection": np.full((1, 1000, 1), 0.25),
    }  # fmt: skip
    table = SimpleNamespace(on=None, dolphin=4000.0, dolphin_yield=800.0, dolphin_beyond=500.0)
    pair = in_series(spring(), bilinear(4 * K, 800e3, 500e3))
    made = SimpleNamespace(fender=[table], dolphin=[])
    file = {key: (value if key in ("quantity",) else SimpleArray(value)) for key, value in file.items()}
    found = berth._of_fenders(file, made, SimpleNamespace(fenders=[SimpleNamespace(name="F", fender=pair)]))
    by_hand = {TOTAL: 0.32, SLOW: 0.1, OF_ALLOWABLE: 0.64 / 0.9, OF_ENERGY: (0.64 / 0.8) ** 2, DOLPHIN: 800 / 640,
               berth.REACTION: 640.0, berth.OF_REACTION: 0.64 / 0.8}  # fmt: skip
    assert {key: value["F"] for key, value in found.items()} == pytest.approx(by_hand, rel=1e-3)


class SimpleArray:
    """What a dataset gives by [()] and by a slice"""

    def __init__(self, values):
        self.values = np.asarray(values)

    def __getitem__(self, key):
        return self.values[key]


def test_a_dolphin_is_that_of_the_fender_or_the_one_it_stands_on():
    one = SimpleNamespace(stiffness=5000.0, yield_force=3000.0, stiffness_beyond=900.0)
    own = SimpleNamespace(on=None, dolphin=4000.0, dolphin_yield=None, dolphin_beyond=None)
    assert berth.dolphin_of(SimpleNamespace(on="D"), {"D": one}) == (5e6, 3e6, 9e5)
    assert berth.dolphin_of(own, {}) == (4e6, np.inf, None)
    assert berth.dolphin_of(SimpleNamespace(on=None, dolphin=None, dolphin_yield=None, dolphin_beyond=None), {}) == ()


def test_a_body_on_higher_water_rises_past_what_does_not_float():
    """2 m more: bollards and fenders lie 2 m lower against it, anchors and fairleads do not"""
    base = {
        "water": {"depth": 20.0}, "of_hull": {"wind": {"ship": "tanker, loaded"}, "current": {}},
        "lines": [{"name": "a", "anchor": [1.0, 2.0], "fairlead": [0.0, 0.0, 1.0]},
                  {"name": "h", "bollard": [5.0, 6.0, 7.0]}],
        "rope": [{"name": "r", "bollard": [1.0, 2.0, 3.0]}], "fender": [{"name": "f", "position": [0.0, 25.0, 3.0]}],
    }  # fmt: skip
    before = copy.deepcopy(base)
    made = mooring.at(base, 22.0, {"wind": {"speed": 30.0}})
    assert base == before and made["water"] == {"depth": 22.0}
    assert made["lines"][1]["bollard"] == [5.0, 6.0, 5.0] and made["rope"][0]["bollard"] == [1.0, 2.0, 1.0]
    assert made["fender"][0]["position"] == [0.0, 25.0, 1.0] and made["lines"][0]["fairlead"] == [0.0, 0.0, 1.0]
    assert made["wind"] == {"speed": 30.0, "ship": "tanker, loaded"} and "of_hull" not in made
    assert mooring.lost(made) == ["a", "h", "r"]
    left = mooring.without(made, "h")
    assert [one["name"] for one in left["lines"]] == ["a"] and mooring.lost(left) == ["a", "r"]


def test_cycles_of_all_runs_lie_beside_each_other():
    """Two runs of 100 steps of 0.5 s: 100 s in all; a sine of 5 cycles each"""
    t = np.arange(101) * 0.5
    tension = np.stack([np.sin(0.2 * np.pi * t), 2 * np.sin(0.2 * np.pi * t)])[..., None]
    ((duration, cycles),) = in_time.cycles_of(tension, 0.5)
    assert duration == pytest.approx(100.0)
    ranges, counts = np.asarray(cycles[0]), np.asarray(cycles[-1])
    assert counts.sum() == pytest.approx(10.0, abs=1.1) and ranges.max() == pytest.approx(4.0, rel=1e-3)


def test_motions_are_the_larger_side_from_their_means():
    names = ["surge", "sway", "heave", "roll", "pitch", "yaw"]
    rows = []
    for i in range(6):
        row = dict.fromkeys(SUMMARY, 0.0) | {"mean": 1.0, "largest": 3.0 + i, "smallest": -2.0 - 3 * i}
        rows.append(list(row.values()))
    file = {"quantity": {()}, "summary": SimpleArray(rows), "dof": names}
    file["quantity"] = SimpleNamespace(asstr=lambda: np.array(names))
    assert in_time._largest_motions(file) == pytest.approx([max(2.0 + i, 3.0 + 3 * i) for i in range(6)])


def test_ranges_are_largest_less_smallest_of_one_run(monkeypatch):
    """A push to one side: −0.6 to 1.4 m, mean 0.03 m; the other run from 1 to 2.5 m; the third is not whole"""
    monkeypatch.setattr("hakobune.pipelines.simulate.file.whole_rows", lambda file: np.array([True, True, False]))
    rows = np.zeros((3, 8, len(STATISTICS)))
    for run, ends in enumerate([(1.4, -0.6), (2.5, 1.0), (99.0, -99.0)]):
        for name, value in zip(("largest", "smallest"), ends, strict=True):
            rows[run, 0, STATISTICS.index(name)] = value
    found = in_time._largest_ranges({"statistics": SimpleArray(rows), "dof": range(6)})
    assert found == pytest.approx([2.0, 0, 0, 0, 0, 0])  # not 3.1, the largest of all less the smallest of all


def test_values_of_the_project_go_to_the_cases_they_are_for():
    values = [SimpleNamespace(quantity="gust factor", value=1.3, source="code", state="abnormal", lines="any"),
              SimpleNamespace(quantity="scour", value=0.5, source="survey", state="any", lines="one lost")]  # fmt: skip
    project = SimpleNamespace(values=values, levels={})
    read = SimpleNamespace(project=project, study={})
    numbers = SimpleNamespace(names=(), hawsers=(), types=(), parts={})

    def given(kind, lines, apart=False):
        return given_parts(read, SimpleNamespace(kind=kind, lines=lines, apart=apart, name="x"), numbers)

    assert given("abnormal", "intact") == {"gust factor": {"code": 1.3}}
    assert given("normal", "one lost") == {"scour": {"survey": 0.5}}
    assert given("abnormal", "one lost", apart=True) == {}
    numbers.parts = {"gust factor": {}}
    with pytest.raises(ValueError, match="'gust factor' is given, but x computes it; leave the given value out"):
        given("abnormal", "intact")


def test_multiples_of_the_motions_are_those_that_criteria_ask_for():
    read = SimpleNamespace(criteria=(SimpleNamespace(motion_factor=1.5), SimpleNamespace(motion_factor=1.0)),
                           project=SimpleNamespace(simulation=None), kind=SimpleNamespace(MOVED=True))  # fmt: skip
    assert factors_of(read) == [1.0, 1.5] and repeated(read, [1.0, 1.5]) == [1.0, 1.5]
    read.project.simulation = SimpleNamespace()
    assert repeated(read, [1.0, 1.5]) == [1.0]


def test_the_largest_of_a_case_is_that_of_its_runs_where_there_are_some():
    numbers = SimpleNamespace(
        largest=np.array([1.0, 2.0]), _asdict=lambda: {"horizontal": [3.0, 4.0], "uplift": [5.0, 6.0]}
    )
    still = Ran(None, None, numbers)
    assert list(still.largest) == [1.0, 2.0] and still.at_anchors.tolist() == [[3.0, 4.0], [5.0, 6.0]]
    runs = {"largest": {1.0: np.array([7.0, 8.0]), 1.5: np.array([9.0, 9.0])}, "horizontal": [1, 1], "uplift": [2, 2]}
    moving = Ran(None, None, numbers, runs)
    assert list(moving.largest) == [7.0, 8.0] and moving.at_anchors.tolist() == [[1, 1], [2, 2]]


def test_anchors_of_a_study_hold_what_its_lines_are_judged_by_and_go_with_a_line_that_is_lost():
    """A sinker of 600 kN at μ = 0.5, lifted by 100 kN, holds 250 kN; a rope to a bollard has no anchor to judge"""
    sinker = {"kind": "sinker", "friction": 0.5, "weight_kN": 600.0, "lines": ["fore"]}
    line = {"name": "fore", "type": "chain", "length": 1.0, "fairlead": [0.0, 0.0, 0.0], "anchor": [1.0, 0.0]}
    study = {"water": {"depth": 20.0}, "lines": [line], "anchors": [sinker]}
    numbers = SimpleNamespace(names=("fore", "head"), types=(("chain",), ("rope",)),
                              _asdict=lambda: {"horizontal": [0.0, 0.0], "uplift": [100e3, 0.0]})  # fmt: skip
    read, ran = SimpleNamespace(project=SimpleNamespace(anchors=None)), Ran(SimpleNamespace(study=study), None, numbers)
    assert _holding(read, ran).tolist() == [250e3, np.inf]
    del sinker["weight_kN"]
    assert _holding(read, ran) is None
    assert mooring.without(study, "fore")["anchors"] == []
    sinker["lines"] = ["fore", "aft"]
    assert mooring.without(study, "fore")["anchors"][0]["lines"] == ["aft"]


def test_tensions_of_a_breakwater_are_of_the_curve_with_its_holding_and_theory():
    """Alone where one theory was computed; the first of all where neither is among them"""
    both = ["elastic (linear)", "elastic (exact)", "taut (linear)", "taut (exact)"]
    assert breakwater._curve(("taut", "exact"), both) == "taut (exact)"
    assert breakwater._curve(("elastic", "exact"), both) == "elastic (exact)"
    assert breakwater._curve(("taut", "exact"), ["elastic (exact)", "taut"]) == "taut"
    assert breakwater._curve(("taut", "linear"), ["free"]) == "free"
