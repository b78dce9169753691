"""What a design reads of the runs of a load case, of files and lines that are made up."""

from contextlib import contextmanager
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database.integrity import DatabaseError
from hakobune.pipelines.design import running
from hakobune.pipelines.design.kinds import in_time
from hakobune.pipelines.executors import choice
from hakobune.pipelines.results import given
from hakobune.pipelines.simulate import file as stored
from hakobune.pipelines.simulate import over_runs
from hakobune.pipelines.simulate import run as runs


class Text(list):
    def asstr(self):
        return {(): self}


class Data:
    def __init__(self, values):
        self.values = np.array(values)

    def __getitem__(self, key):
        return self.values[key]


@pytest.fixture
def simulated(monkeypatch):
    """`_simulated` of two lines, whose statics are 100 and 200 kN at the factor 1 and twice as much at 2"""
    known = SimpleNamespace(outcome=SimpleNamespace(interrupted=False, failures=[]), moved=[])
    file = {"line": Text(["a", "b"]), "motion": Data(np.zeros((1, 3, 6))), "tension": Data(np.ones((1, 3, 2))),
            "time": Data([0.0, 0.5, 1.0])}  # fmt: skip
    rows = {"tension a": {"largest": 3e5, "mean": 1e5}, "tension b": {"largest": 1.5e5, "mean": 2e5}}

    class File(dict):
        attrs = SimpleNamespace()

    made = File(file)
    made.attrs = {"breaking_load": [1e6, np.inf]}

    @contextmanager
    def opened(path):
        assert path == "runs.h5"
        yield made

    def moved(study, database, motion, tension, factor):
        known.moved.append((study, database, motion.shape, factor))
        return factor * np.array([[1e5, 2e5], [5e4, 6e4], [7e3, 8e3]])

    monkeypatch.setattr(stored, "opened", opened)
    monkeypatch.setattr(stored, "summary_of", lambda file, name: rows[name])
    monkeypatch.setattr("hakobune.pipelines.design.kinds.in_time._away_at_rest", lambda file: 5.0)
    monkeypatch.setattr(stored, "told", lambda file: ("left out", "same"))
    monkeypatch.setattr(stored, "stored_findings", lambda file: ("stored", "same"))
    monkeypatch.setattr(over_runs, "overloads", lambda file, share: (f"over {share:g}",))
    monkeypatch.setattr(over_runs, "on_anchors", lambda file: ("anchors",))
    monkeypatch.setattr(over_runs, "rare_findings", lambda file: ("rare",))
    monkeypatch.setattr(over_runs, "used_in_runs", lambda file: np.array([[0.1, 0.4], [0.3, 0.2]]))
    monkeypatch.setattr(in_time, "_run", lambda *of: known.outcome if of == ("study", "base", "runs.h5") else None)
    monkeypatch.setattr(over_runs, "excursion_in_runs", lambda file: 7.0)
    pulls = np.array([[9e4, np.nan], [2e3, np.nan]])
    monkeypatch.setattr(over_runs, "anchors_in_runs", lambda file: ([None, None], *pulls))
    monkeypatch.setattr(in_time, "_largest_motions", lambda file: "motions")
    monkeypatch.setattr(in_time, "_largest_ranges", lambda file: "ranges")
    monkeypatch.setattr(in_time, "_between", lambda file: {"gap": 1})
    monkeypatch.setattr(in_time, "cycles_of", lambda tension, step: ("cycles", step))
    monkeypatch.setattr(in_time, "strength", lambda *of: [one.tolist() for one in of])
    monkeypatch.setattr(in_time, "_moved", moved)
    return known


def test_forces_of_runs_have_the_ratio_of_runs_to_statics_at_least_one(simulated):
    """Three times the statics of the first line; the second, a rope, pulls less than its statics, whose pulls stay"""
    found = in_time._simulated("study", "base", "runs.h5", (0.5, 1, 2))
    assert found["mean"].tolist() == [1e5, 2e5]
    largest = {factor: values.tolist() for factor, values in found["largest"].items()}
    assert largest == {1.0: [3e5, 1.5e5], 0.5: [1.5e5, 1e5], 2: [6e5, 4e5]}
    assert found["horizontal"].tolist() == [9e4, 6e4] and found["uplift"].tolist() == [2e3, 8e3]
    assert found["breaking"] == [[1e6, np.inf], [3e5, 1.5e5], [0.3, 0.4]]
    assert (found["cycles"], found["motions"], found["ranges"], found["excursion"], found["parts"]) == (
        ("cycles", 0.5), "motions", "ranges", 7.0, {"gap": 1},
    )  # fmt: skip
    assert found["findings"] == ("left out", "same", "stored", "over 1", "anchors", "rare")
    assert [one[3] for one in simulated.moved] == [1.0, 0.5, 2] and simulated.moved[0][:3] == (
        "study",
        "base",
        (1, 3, 6),
    )


def test_more_motion_never_lowers_what_was_simulated(simulated, monkeypatch):
    monkeypatch.setattr(
        in_time, "_moved", lambda *of: np.array([[1e5, 2e5], [0, 0], [0, 0]]) * (0.01 if of[4] == 2 else 1)
    )
    largest = in_time._simulated("study", "base", "runs.h5", (1, 2))["largest"]
    assert largest[2].tolist() == largest[1.0].tolist() == [3e5, 1.5e5]


def test_a_seed_that_failed_is_a_case_that_failed_and_a_ctrl_c_ends_the_design(simulated):
    simulated.outcome.failures = [(3, "a line parts"), (4, "again")]
    with pytest.raises(ValueError, match=r"^seed 3: a line parts$"):
        in_time._simulated("study", "base", "runs.h5", (1,))
    simulated.outcome.interrupted = True
    with pytest.raises(KeyboardInterrupt):
        in_time._simulated("study", "base", "runs.h5", (1,))


@pytest.mark.parametrize("damaged", [False, True])
def test_runs_of_another_study_are_made_again(monkeypatch, damaged):
    asked = []

    def simulate(*of, **more):
        asked.append((of, more))
        if damaged and not more:
            raise DatabaseError("another study")
        return "outcome"

    monkeypatch.setattr(given, "database_of", lambda path: f"open {path}")
    monkeypatch.setattr(runs, "input_of", lambda path: f"input {path}")
    monkeypatch.setattr(runs, "simulate", simulate)
    monkeypatch.setattr(choice, "Here", lambda: "here")
    of = ("input s", "open b", "r.h5", None, "here")
    assert in_time._run("s", "b", "r.h5") == "outcome"
    assert asked == [(of, {}), (of, {"fresh": True})][: 1 + damaged]


def test_each_line_and_rope_is_held_where_it_pulled_most_and_farther_from_the_mean(monkeypatch):
    """Two runs of three samples; the second line is a rope.  Of the mean 2 and the sample 5: at 1.5 times, 6.5 m"""
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: f"open {path}")
    made = SimpleNamespace(
        hulls_of=lambda db: f"hulls of {db}", system_of=lambda db, hull: SimpleNamespace(lines=["a"], of=(db, hull)),
        berth_of=lambda db, hull: ("berth", db, hull),
    )  # fmt: skip
    held = []

    def line(system, number, at):
        held.append(("line", number, *at))
        return at[0], -at[0], 9

    def rope(berth, number, at):
        held.append(("rope", number, *at))
        return 1, at[0], at[0]

    monkeypatch.setattr(in_time, "make_study_of", lambda study: made if study == "study" else None)
    monkeypatch.setattr(
        in_time, "_held_line", lambda system, line, at: held.append(("line", line, *at)) or (at[0], -at[0], 9)
    )
    monkeypatch.setattr(
        in_time, "_held_rope", lambda berth, rope, at: held.append(("rope", rope, *at)) or (1, at[0], at[0])
    )
    motion = np.array([[[0.0], [1.0], [5.0]], [[-9.0], [3.0], [0.0]]])
    tension = np.array([[[1.0, 9.0], [2.0, 1.0], [7.0, 1.0]], [[1.0, 1.0], [8.0, 1.0], [2.0, 9.0]]])
    found = in_time._moved("study", "base", motion, tension, 1.5)
    assert held == [("line", 0, 6.5), ("rope", 0, -1.0), ("line", 0, 5.5), ("rope", 0, 1.0)]
    assert found.tolist() == [[6.5, 1.0], [0.0, 1.0], [9.0, 1.0]]


# ------------------------------------------------------------------ cases


def case(**more):
    return SimpleNamespace(**{"name": "storm", "kind": "abnormal", "lines": "intact", "apart": False} | more)


def numbers(**more):
    known = {"bodies": (), "motions": np.zeros(0), "parts": {"own": {"a": 1}}, "names": ("a", "b", "c"),
             "types": (("R3",), ("rope",), ("R3",)), "hawsers": ("c",)}  # fmt: skip
    return SimpleNamespace(**{"length": np.array([330.0, 50.0, 60.0])} | known | more)


def test_amplitudes_are_in_metres_and_degrees_of_one_body_or_by_name():
    of = [1.0, 2.0, 3.0, *np.radians([4.0, 5.0, 6.0])]
    one = running._motions((), np.array(of))
    assert one == pytest.approx({"surge": 1, "sway": 2, "heave": 3, "roll": 4, "pitch": 5, "yaw": 6})
    both = running._motions(("ship", "barge"), np.array([*of, *(2 * np.array(of))]))
    assert both["sway"] == {"ship": 2.0, "barge": 4.0} and both["yaw"] == pytest.approx({"ship": 6.0, "barge": 12.0})
    assert running._motions((), np.zeros(0)) == {}


@pytest.fixture
def judged(monkeypatch):
    monkeypatch.setattr(running, "_tensions", lambda read, ran, largest: (ran.name, largest))
    monkeypatch.setattr(running, "_motions", lambda bodies, amplitudes: (bodies, amplitudes))
    monkeypatch.setattr(running, "given_parts", lambda read, case, numbers: {"given": 1, "own": 2})
    monkeypatch.setattr(running, "anchors_used", lambda ran: {})
    monkeypatch.setattr(running, "excursion", lambda ran: 7.0)


def test_a_case_of_statics_has_the_tensions_of_each_factor_that_ran(judged):
    of_ship = numbers(motions="m", bodies=("ship",))
    ran = {
        factor: SimpleNamespace(name=f"x{factor}", case=case(), numbers=there, runs=None, largest=f"L{factor}")
        for factor, there in ((1.0, of_ship), (1.5, None), (2.0, of_ship))
    }
    found = running.judged_case(SimpleNamespace(kind=SimpleNamespace(MOVED=True)), ran, "others")
    assert found.tensions == {1.0: ("x1.0", "L1.0"), 2.0: ("x2.0", "L2.0")} and found.motions == (("ship",), "m")
    assert found.ranges is None
    assert found[:4] == ("storm", "abnormal", "intact", "quasi-static")
    assert found.others == "others" and found.partial is False
    assert found.parts == {"given": 1, "own": {"a": 1}, "excursion": {"from rest": 7.0}}


def test_a_case_in_time_has_the_tensions_and_motions_of_its_runs(judged):
    one = SimpleNamespace(name="x", case=case(apart=True), numbers=numbers(),
                          runs={"motions": "in time", "ranges": "whole", "largest": {1.0: "A", 1.5: "B"}})  # fmt: skip
    found = running.judged_case(SimpleNamespace(kind=SimpleNamespace(MOVED=True)), {1.0: one}, "others")
    assert found.tensions == {1.0: ("x", "A"), 1.5: ("x", "B")} and found.motions == ((), "in time") and found.partial
    assert found.ranges == ((), "whole")


def value(quantity="v", **more):
    return SimpleNamespace(**{"quantity": quantity, "state": "any", "lines": "any", "source": "s", "value": 2.0} | more)


@pytest.mark.parametrize("one, there", [
    (value(), True), (value(state="abnormal"), True), (value(state="normal"), False), (value(lines="intact"), True),
    (value(lines="one lost"), False),
])  # fmt: skip
def test_values_of_a_project_are_of_their_state_and_lines(one, there):
    read = SimpleNamespace(project=SimpleNamespace(values=[one, value("w")], levels={}), study={})
    found = running.given_parts(read, case(), numbers())
    assert found == ({"v": {"s": 2.0}} if there else {}) | {"w": {"s": 2.0}}
    assert running.given_parts(read, case(apart=True), numbers()) == {}
    read.project.values = [value("own")]
    with pytest.raises(
        running.StudyError, match="values: 'own' is given, but storm computes it; leave the given value out"
    ):
        running.given_parts(read, case(), numbers())


def test_lines_have_their_scope_over_five_depths_and_the_range_of_levels_but_no_ropes_and_hawsers():
    """330 m over 5 · 20 + (1 + 9) m"""
    read = SimpleNamespace(project=SimpleNamespace(values=[], levels={"high": 1.0, "low": -9.0}),
                           study={"water": {"depth": 20.0}})  # fmt: skip
    assert running.given_parts(read, case(), numbers()) == {running.SCOPE: {"a": 3.0}}
    read.project.levels = {"high": 10.0}
    assert running.given_parts(read, case(), numbers()) == {running.SCOPE: {"a": 3.0}}
    assert running.given_parts(read, case(), numbers(hawsers=("a", "c"))) == {}


def test_cases_run_side_by_side_each_on_the_database_of_its_level_and_are_told_in_order(tmp_path):
    asked, told = [], []

    def job(answer):
        def result():
            if isinstance(answer, Exception):
                raise answer
            return answer

        return SimpleNamespace(result=result)

    answers = [("numbers",), ValueError("no\n place"), ("numbers", "runs")]
    submit = lambda *given: asked.append(given) or job(answers[len(asked) - 1])  # noqa: E731
    cases = [SimpleNamespace(name=f"case {i}", study=f"study {i}", level="mean" if i else "high") for i in range(3)]
    read = SimpleNamespace(kind=SimpleNamespace(run="run"))
    paths = {"mean": "m.h5", "high": "h.h5"}
    found = running._run_all(read, cases, (1.0, 1.5), paths, tmp_path, SimpleNamespace(submit=submit),
                             lambda *step: told.append(step), 4)  # fmt: skip
    place = tmp_path / "cases"
    assert asked == [
        ("run", f"study {i}", "m.h5" if i else "h.h5", place / f"case_{i}.h5", (1.0, 1.5)) for i in range(3)
    ]
    assert [(one.numbers, one.runs, one.fault) for one in found] == [
        ("numbers", None, ""), (None, None, "no place"), ("numbers", "runs", ""),
    ]  # fmt: skip
    assert [one.path for one in found] == [place / f"case_{i}.h5" for i in range(3)]
    assert told == [(5, 7, "case 0"), (6, 7, "case 1"), (7, 7, "case 2")]
