"""Which load cases of a design run after which, which line is lost, and the plan of a berth, of numbers made up."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.design import advice, project, running
from hakobune.pipelines.design.cases import LoadCase
from hakobune.pipelines.design.kinds import berth_plan
from hakobune.pipelines.design.kinds.needs import OF_ALLOWABLE
from hakobune.pipelines.design.running import Ran, grouped, worst_of


def case(state="storm", incidence=0.0, factor=1.0, lost="", name="", study=None, level="mean"):
    return LoadCase(name or f"{state} {incidence:g}", state, "normal", level, incidence, 0.0, 0.0, lost, factor, study)


def ran(largest, breaking, names=("a", "b", "c"), of=None, runs=None):
    numbers = SimpleNamespace(names=names, largest=np.array(largest, float), breaking=np.array(breaking, float))
    return Ran(case() if of is None else of, Path("x.h5"), numbers, runs)


def test_the_worst_line_uses_most_of_its_breaking_load():
    """3/10, 4/20, 2/5; the one that pulls most where nothing is known; of those named alone"""
    assert worst_of(ran([3, 4, 2], [10, 20, 5])) == "c"
    assert worst_of(ran([3, 4, 2], [10, 20, 5]), ("a", "b")) == "a"
    assert worst_of(ran([3, 4, 2], [np.inf] * 3)) == "b"
    assert worst_of(ran([3, 4, 2], [10, 20, 5], runs={"largest": {1.0: np.array([9, 1, 1])}})) == "a"


def test_cases_of_a_state_and_direction_go_together_by_their_factor():
    cases = [case(), case(factor=1.5), case(incidence=45.0), case(lost="a"), case(state="calm"), case(level="high")]
    made = [ran([1] * 3, [1] * 3, of=one) for one in cases]
    groups = list(grouped(made).values())
    assert [list(one) for one in groups] == [[1.0, 1.5], [1.0], [1.0], [1.0], [1.0]]
    assert groups[0][1.5] is made[1] and groups[2][1.0] is made[3]


def read(lines=("intact", "one lost"), lost="worst", kind=None):
    state = SimpleNamespace(name="storm", lines=lines, lost=lost)
    return SimpleNamespace(project=SimpleNamespace(states=[state], earthquakes=[], simulation=None), kind=kind,
                           criteria=[SimpleNamespace(motion_factor=1.5)])  # fmt: skip


def test_the_worst_line_is_lost_or_every_one_and_none_where_no_state_asks(monkeypatch):
    monkeypatch.setattr(running, "without_line", lambda read, one, name: (one.factor, name))
    group = {1.0: ran([3, 4, 2], [10, 20, 5]), 1.5: ran([4, 5, 3], [10, 20, 5], of=case(factor=1.5))}
    names = ("a", "b", "c")
    assert list(running._lost(read(), group, names)) == [(1.0, "c"), (1.5, "c")]
    every = list(running._lost(read(lost="every"), group, names))
    assert every == [(factor, name) for name in names for factor in (1.0, 1.5)]
    assert list(running._lost(read(lines=("intact",)), group, names)) == []
    assert list(running._lost(read(), {1.0: Ran(case(), Path("x"), None)}, names)) == []


def test_a_change_is_judged_by_the_cases_that_governed_with_all_lines_and_without_the_worst(monkeypatch, tmp_path):
    """At both multiples of the motions; no other direction is run, and a criterion without a case does not count"""
    judged = [SimpleNamespace(governing=u and SimpleNamespace(utilisation=u)) for u in (0.4, 0.9, None)]
    groups, numbers = [], ran([3, 4, 2], [10, 20, 5]).numbers
    for name, value in {
        "base_of": lambda *_: None, "factors_of": lambda _: [1.0], "repeated": lambda *_: [],
        "fatigue": lambda *_: None,
        "intact_cases": lambda *_: [case(), case(factor=1.5), case(incidence=45.0)],
        "without_line": lambda _, one, name: case(factor=one.factor, lost=name),
        "judged_case": lambda _, group, others: [(factor, one.case.lost) for factor, one in group.items()],
        "judge": lambda _, cases: groups.extend(cases) or judged,
    }.items():  # fmt: skip
        monkeypatch.setattr(advice, name, value)
    kind = SimpleNamespace(lost=lambda _: ("a", "b", "c"), run=lambda *_: (numbers, None))
    keys = {running.key_of(case(lost="a"))}
    worst = advice._governing(SimpleNamespace(kind=kind), [], keys, {}, {"mean": None}, tmp_path / "advice")
    assert groups == [[(1.0, ""), (1.5, "")], [(1.0, "c"), (1.5, "c")]] and worst is judged[1]


class Executor:
    """Runs a job when its result is asked for"""

    def submit(self, run, *words):
        return SimpleNamespace(result=lambda: run(*words))


def test_intact_cases_run_first_and_those_that_lost_a_line_are_counted_with_them(monkeypatch, tmp_path):
    """A case that cannot run is kept with its fault in one line"""
    asked, steps = [], []

    def run(study, database, place, factors):
        asked.append((study, database, place.parent.name, tuple(factors)))
        if study == "bad":
            raise ValueError("no\n  rest")
        return SimpleNamespace(names=("a",), largest=np.ones(1), breaking=np.ones(1)), None

    kind = SimpleNamespace(run=run, MOVED=False, lost=lambda base: ("a",), base=lambda study, db: "base")
    intact = [case(name="one", study="good"), case(name="two", study="bad", incidence=45.0)]
    monkeypatch.setattr(running, "intact_cases", lambda *_: iter(intact))
    monkeypatch.setattr(running, "without_line", lambda read, one, name: one._replace(name="lost", lost=name))
    made = read(kind=kind)
    made.study = None
    found = running.run_cases(made, {"mean": None}, tmp_path, Executor(), lambda *told: steps.append(told))
    assert [(one.case.name, one.fault, one.numbers is None) for one in found] == [
        ("one", "", False), ("two", "no rest", True), ("lost", "", False)]  # fmt: skip
    assert steps == [(1, 2, "one"), (2, 2, "two"), (3, 3, "lost")]
    assert asked[0] == ("good", None, "cases", (1.0, 1.5)) and (tmp_path / "cases").is_dir()


L, B = 100.0, 20.0
PLACE = 1.0, 2.0, 0.5 * math.pi


def drawn(pictures, tmp_path, strain=0.5, place=PLACE):
    fenders = [SimpleNamespace(name="F1", face=np.array([20.0, -10.0, 0]), normal=np.array([0.0, 1.0, 0])),
               SimpleNamespace(name="F2", face=np.array([50.0, 0.0, 0]), normal=np.array([-1.0, 0.0, 0]))]  # fmt: skip
    made = SimpleNamespace(hull_of=lambda size: SimpleNamespace(length=L, beam=B),
                           berth=lambda hull, center: SimpleNamespace(fenders=fenders),
                           conditions=lambda: SimpleNamespace(wind=None, current=None, waves=None))  # fmt: skip
    numbers = SimpleNamespace(
        names=("bow", "stern"), largest=np.array([250.0, 600.0]), breaking=np.array([1000.0, 1000.0]),
        anchor=np.array([[80.0, -40.0, 5.0], [-80.0, 30.0, 5.0]]), parts={OF_ALLOWABLE: {"F1": strain}},
        fairlead=np.array([[50.0, -10.0, 3.0], [-50.0, 10.0, 3.0]]), place=np.array(place),
    )  # fmt: skip
    berth_plan.draw_berth(
        made, SimpleNamespace(dimensions={}, sizes={}, rotation_center=(0, 0, 0)), numbers, tmp_path / "b.png"
    )
    return pictures[0].axes


def test_the_plan_of_a_berth_has_its_ropes_hull_and_mean_place(pictures, tmp_path):
    axes, bar = drawn(pictures, tmp_path)
    lines = [np.column_stack(one.get_data()) for one in axes.lines]
    assert lines[0] == pytest.approx(np.array([[80, -40], [50, -10]])) and lines[1] == pytest.approx(
        np.array([[80, -40]])
    )
    assert lines[2] == pytest.approx(np.array([[-80, 30], [-50, 10]]))
    assert [lines[4][0].tolist(), lines[5][0].tolist()] == [[20, -10], [50, 0]]
    named = {one.get_label(): np.column_stack(one.get_data()) for one in axes.lines}
    assert named["as drawn"] == pytest.approx(np.array([[50, 10], [-50, 10], [-50, -10], [50, -10], [50, 10]]))
    turned = np.array([[-10, 50], [-10, -50], [10, -50], [10, 50], [-10, 50]]) + [
        1,
        2,
    ]  # a quarter to port, 1 and 2 m on
    assert named["mean place"] == pytest.approx(turned)
    assert axes.get_title() == "mean place 1.00 m, 2.00 m, yaw 90.00°"
    assert axes.get_xlim() == pytest.approx((-96, 96)) and (axes.get_xlabel(), axes.get_ylabel()) == ("x, m", "y, m")
    assert {one.get_text() for one in axes.texts} == {"bow 25 %", "stern 60 %", "F1 50 %", "F2 0 %", "bow"}
    assert bar.get_ylabel() == "tension / breaking load,\nstrain / allowable strain" and bar.get_ylim() == (0, 1)
    places = {one.get_text(): one.xyann for one in axes.texts}
    assert places["bow 25 %"][1] < -40 and places["stern 60 %"][1] > 30  # beyond the bollards of their side
    assert -10 < places["F1 50 %"][1] < 0  # within the hull
    low, high = axes.get_ylim()
    scale = berth_plan.WIDTH / (1.2 * 160)
    assert (low, high) == pytest.approx((-40 - 0.35 / scale, 30 + 0.35 / scale))


@pytest.mark.parametrize("strain, top", [(1.5, 1.5), (3.0, 2.0), (0.9, 1.0)])
def test_colours_go_to_what_is_used_most_at_most_twice(pictures, tmp_path, strain, top):
    assert drawn(pictures, tmp_path, strain)[1].get_ylim() == pytest.approx((0, top))


def test_names_in_a_row_do_not_lie_over_each_other():
    """Names of ten letters are 0.6 inches long: at 1 inch a metre those 0.7 m apart share a row, those 0.6 m do not"""
    words = [("a" * 10, np.array([x, 0.0])) for x in (1.4, 0.0, 0.7)]
    assert [[place[0] for _, place in row] for row in berth_plan.in_rows(words, 1.0)] == [[0.0, 0.7, 1.4]]
    close = [("a" * 10, np.array([x, 0.0])) for x in (0.0, 0.6, 1.2)]
    assert [[place[0] for _, place in row] for row in berth_plan.in_rows(close, 1.0)] == [[0.0, 1.2], [0.6]]
    above, below = berth_plan._by_side(["p", "s", "m"], np.zeros((3, 2)), [1.0, -1.0, 0.0], 1.0)
    assert [text for row in above for text, _ in row] == ["p", "m"] or len(above) == 2
    assert [text for row in below for text, _ in row] == ["s"]


def test_rules_of_a_file_lie_beside_the_project_and_unsure_ones_are_left_out(monkeypatch, tmp_path):
    asked, found = [], (SimpleNamespace(status="verified"), SimpleNamespace(status="unverified"))
    monkeypatch.setattr(project, "read_rules", asked.append)
    monkeypatch.setattr(project, "of_rule", lambda *_: found)
    given = (("a.toml", False), (None, True))
    tables = [SimpleNamespace(file=file, rule="R", subject="", confirmed=sure) for file, sure in given]
    chosen = project._criteria(SimpleNamespace(rules=tables, limits=()), tmp_path)
    assert asked == [tmp_path / "a.toml", None] and chosen == (found[0], *found)
