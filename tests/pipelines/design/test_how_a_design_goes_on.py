"""What a design runs, in which order, and what it makes of what came out; cases, databases and pictures are made up."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design import advice as of_advice
from hakobune.pipelines.design import report_words, result, running, verdict
from hakobune.pipelines.design.advice import Advice, Tried, advise, after_lines_move
from hakobune.pipelines.design.cases import LoadCase
from hakobune.pipelines.design.kinds import berth, breakwater, in_time, mooring, single_point
from hakobune.pipelines.design.kinds.needs import DOLPHIN, OF_ALLOWABLE, OF_ENERGY, TOTAL
from hakobune.pipelines.design.kinds.numbers import Numbers
from hakobune.pipelines.design.kinds.versions import CODE, code
from hakobune.pipelines.simulate.over_runs import OF_LINES


def numbers(names=("a", "b"), **more):
    n = len(names)
    flat = dict.fromkeys(("length", "pretension", "static", "largest", "breaking", "horizontal", "uplift"), np.ones(n))
    given = {"names": names, "types": (("chain",),) * n, "fairlead": np.zeros((n, 3)), "anchor": np.zeros((n, 3)),
             **flat, "place": np.zeros(3), "motions": np.zeros(0), "parts": {}}  # fmt: skip
    return Numbers(**given | more)


def case(name="one", factor=1.0, lost="", state="storm", **more):
    given = dict(zip(LoadCase.__annotations__, (name, state, "extreme", "mean", 0.0, 0.0, 0.0, lost, factor, {}),
                     strict=False))  # fmt: skip
    return LoadCase(**given | {"apart": False} | more)


def ran(name="one", found=(), **more):
    return running.Ran(case(name, **more), Path(f"{name}.h5"), numbers(warnings=tuple(found)))


# ------------------------------------------------------------------ advice


def judged(quantity="tension", met=False, used=1.5, of="one"):
    criterion = SimpleNamespace(quantity=quantity, name=f"limit of {quantity}", sense="at most", limit=0.5)
    governing = None if used is None else SimpleNamespace(utilisation=used, case=of)
    return SimpleNamespace(criterion=criterion, met=met, governing=governing, uses=[] if used is None else [governing])


def read_project(fatigue=None, states=(), values=()):
    project = SimpleNamespace(fatigue=fatigue, states=states, values=values)
    return SimpleNamespace(project=project, study="study")


WAYS = {"more pretension": [SimpleNamespace(words=f"{k} kN", study=k) for k in (100, 200, 300)],
        "size": [SimpleNamespace(words=f"{k} mm", study=k) for k in (80, 90)]}  # fmt: skip


@pytest.fixture
def tried(monkeypatch):
    """Changes that were run, with what each was asked; a larger one uses less: 1.3, 0.9, 0.8 and 1.4, 1.2"""
    seen = []
    used = {100: 1.3, 200: 0.9, 300: 0.8, 80: 1.4, 90: 1.2}

    def try_it(read, way, change, criteria, keys, others, paths, place):
        seen.append((way, change.words, criteria, keys, place))
        return Tried(way, change.words, used[change.study], used[change.study] <= 1, criteria[0])

    monkeypatch.setattr(of_advice, "ways", lambda study: WAYS)
    monkeypatch.setattr(of_advice, "_tried", try_it)
    return seen


def test_each_way_is_tried_to_its_smallest_change_that_passes_or_its_best(tried):
    steps, cases = [], {"one": case(), "two": case("two", state="calm")}
    found = advise(read_project(), [judged(), judged("offset", True, 0.4, "two")], cases, {}, {}, Path("f"),
                   lambda *given: steps.append(given))  # fmt: skip
    assert [(one.way, one.words, one.passes) for one in found.found] == [
        ("more pretension", "200 kN", True), ("size", "90 mm", False),
    ]  # fmt: skip
    assert found.tried == ("more pretension", "size") and found.beyond == ""
    assert steps == [(1, 5, "100 kN"), (2, 5, "200 kN"), (3, 5, "80 mm"), (4, 5, "90 mm")]
    assert [given[4] for given in tried[1:3]] == [Path("f/more_pretension_2"), Path("f/size_1")]
    criteria, keys = tried[0][2:4]
    assert [one.quantity for one in criteria] == ["tension", "offset"]
    assert keys == {running.key_of(cases["one"]), running.key_of(cases["two"])}


def test_with_fatigue_all_cases_that_have_a_share_of_the_time_are_run_again(tried):
    states = [SimpleNamespace(name="storm", share=0.1), SimpleNamespace(name="calm", share=None),
              SimpleNamespace(name="mild", share=0.2)]  # fmt: skip
    cases = {"one": case(), "two": case("two", state="calm"), "three": case("three", state="mild"),
             "four": case("four", state="mild", lost="b")}  # fmt: skip
    advise(read_project("curve", states), [judged(of="two")], cases, {}, {}, Path("f"), lambda *_: None)
    assert tried[0][3] == {running.key_of(cases[name]) for name in ("one", "two", "three")}


@pytest.mark.parametrize("one, others, beyond", [
    (judged(met=True, used=0.9), {}, ""), (judged(met=None, used=None), {}, ""),
    (judged("service life"), {"service life": 20.0},
     "No change of lines affects limit of service life, service life at most 0.5, "
     "since the project gives these values."),
])  # fmt: skip
def test_nothing_is_tried_where_lines_change_nothing(one, others, beyond, tried):
    assert advise(read_project(), [one], {"one": case()}, others, {}, Path("f"), None) == Advice((), (), beyond)
    assert not tried


def test_nothing_is_tried_where_fenders_fail_in_an_earthquake_or_a_study_has_nothing_to_change(tried, monkeypatch):
    said = advise(read_project(), [judged()], {"one": case(apart=True)}, {}, {}, Path("f"), None)
    assert said.beyond.startswith("No change of lines was tried: a limit is exceeded in “one”") and not said.tried
    monkeypatch.setattr(of_advice, "ways", lambda study: {})
    said = advise(read_project(), [judged()], {"one": case()}, {}, {}, Path("f"), None)
    assert said == Advice((), (), of_advice.NOTHING)


def test_advice_of_static_lines_says_so_first():
    given = Advice(("size",), (), "And more.")
    still, moves = ran(), ran(found=(f"{OF_LINES} snap",))
    assert after_lines_move(given, [still]) == given
    said = after_lines_move(given, [still, moves, running.Ran(case(), Path("x"), None)])
    assert said.beyond.startswith(f"This advice was computed with static lines ({OF_LINES} snap).")
    assert said.beyond.endswith("first. And more.") and said.tried == ("size",)
    nothing = Advice((), (), "")
    assert after_lines_move(nothing, [moves]) == nothing


def test_a_change_is_judged_in_the_cases_asked_for_and_without_the_worst_line_of_its_own(monkeypatch, tmp_path):
    """A change that cannot be laid is no way out; what it uses is of the criterion that uses most"""
    asked = []

    def run(study, database, path, factors):
        asked.append((study, database, path.name))
        return numbers(largest=np.array([1.0, 2.0])), None

    kind = SimpleNamespace(lost=lambda base: ["a", "b"], run=run)
    read = SimpleNamespace(kind=kind, study=None, project=None)
    intact = [case(study="A"), case("calm", state="calm", study="B")]
    monkeypatch.setattr(of_advice, "base_of", lambda read, paths: "base")
    monkeypatch.setattr(of_advice, "factors_of", lambda read: [1.0])
    monkeypatch.setattr(of_advice, "repeated", lambda read, factors: factors)
    monkeypatch.setattr(of_advice, "intact_cases", lambda read, base, factors: iter(intact))
    monkeypatch.setattr(of_advice, "without_line", lambda read, one, name: case(lost=name, study=f"no {name}"))
    monkeypatch.setattr(of_advice, "fatigue", lambda read, ran: judged("fatigue", used=0.7))
    monkeypatch.setattr(of_advice, "judged_case", lambda read, group, others: group[1.0].case.lost)
    monkeypatch.setattr(of_advice, "judge", lambda criteria, cases: [judged(used=0.2 + len(cases)), judged(used=None)])
    keys = {running.key_of(intact[0])}
    found = of_advice._governing(read, [], keys, {}, {"mean": "db"}, tmp_path / "new")
    assert asked == [("A", "db", "0.h5")] and found.governing.utilisation == 1.2
    asked.clear()
    keys |= {running.key_of(case(lost="a"))}
    found = of_advice._governing(read, [], keys, {}, {"mean": "db"}, tmp_path)
    assert asked == [("A", "db", "0.h5"), ("no b", "db", "1.h5")] and found.governing.utilisation == 2.2
    monkeypatch.setattr(of_advice, "_governing", lambda *given: judged(used=given[0].study))
    monkeypatch.setattr(of_advice.msgspec.structs, "replace", lambda read, study: SimpleNamespace(study=study))
    for used, passes in ((1.0, True), (1.001, False)):
        change = SimpleNamespace(study=used, words="w")
        assert of_advice._tried(None, "size", change, [], set(), {}, {}, tmp_path)[:4] == ("size", "w", used, passes)

    def refused(*_):
        raise ValueError("it does not reach")

    monkeypatch.setattr(of_advice, "_governing", refused)
    assert of_advice._tried(None, "size", change, [], set(), {}, {}, tmp_path) is None


# ------------------------------------------------------------------ databases, cases, verdict


def own(**more):
    return SimpleNamespace(**{"database": None, "scene": None} | more)


@pytest.mark.parametrize("outcome, says", [
    (SimpleNamespace(interrupted=False, exit_status=0), None),
    (SimpleNamespace(interrupted=False, exit_status=1, failures=[("ω = 0.4:", "no memory")]),
     "the database of level 'low' is incomplete: ω = 0.4: no memory"),
    (SimpleNamespace(interrupted=False, exit_status=1, failures=[]), "not all frequencies are stored"),
])  # fmt: skip
def test_databases_of_levels_are_solved_and_an_incomplete_one_is_told(outcome, says, monkeypatch, tmp_path):
    monkeypatch.setattr(running, "scenes", lambda read: {"low": "scene"})
    monkeypatch.setattr("hakobune.pipelines.solve.run.solve", lambda *given, **_: outcome)
    read = SimpleNamespace(project=SimpleNamespace(project=own(scene="s.toml"), levels={}), folder=Path("p"))
    if says is None:
        assert running.databases(read, tmp_path, None, None) == {"low": tmp_path / "databases" / "low.h5"}
        outcome.interrupted = True
        with pytest.raises(KeyboardInterrupt):
            running.databases(read, tmp_path, None, None)
    else:
        with pytest.raises(StudyError) as refused:
            running.databases(read, tmp_path, None, None)
        assert says in str(refused.value)
    read.project.project = own(database="box.h5")
    assert running.databases(read, tmp_path, None, None) == {running.MEAN: Path("p/box.h5")}
    read.project = SimpleNamespace(project=own(), levels={"high": 1.0})
    assert running.databases(read, tmp_path, None, None) == {running.MEAN: None, "high": None}


def test_an_earthquake_that_fenders_do_not_stand_is_a_case_with_its_fault(monkeypatch, tmp_path):
    table = SimpleNamespace(study="quake.toml", name="big")
    read = SimpleNamespace(project=SimpleNamespace(earthquakes=[table, table]), folder=tmp_path)
    monkeypatch.setattr(running, "read_toml", lambda *_: ({"a": 1}, ""))
    answers = iter([numbers(()), ValueError("fenders\n yield")])

    def run(path, database, place):
        assert (path, database) == (tmp_path / "quake.toml", "db")
        found = next(answers)
        if isinstance(found, ValueError):
            raise found
        return found

    monkeypatch.setattr("hakobune.pipelines.design.kinds.earthquake.run", run)
    one, two = running._shaken(read, {running.MEAN: "db"}, tmp_path)
    assert one.numbers is not None and one.case.apart and one.case.name == two.case.name == "earthquake, big"
    assert (two.path, two.numbers, two.runs, two.fault) == (tmp_path / "quake.toml", None, None, "fenders yield")
    assert one.path.parent == tmp_path / "cases" and one.path.name.endswith("_numbers.json")
    read.project.earthquakes = []
    assert not list(running._shaken(read, {}, tmp_path))


def test_anchors_of_a_project_hold_what_it_gives_in_kilonewtons():
    anchors = SimpleNamespace(lines={"b": 700.0}, holding_kN=500.0)
    read = SimpleNamespace(project=SimpleNamespace(anchors=anchors))
    assert running._holding(read, ran()).tolist() == [5e5, 7e5]
    read.project.anchors = None
    assert running._holding(read, ran()) is None


def test_failures_that_cases_report_are_told_once_with_how_many_more_have_them():
    """Alike but for numbers; those of multiples of the motions and of cases that did not run are left out"""
    alike = [ran(name, (f"FAILS: line {i} parts", "a remark")) for i, name in enumerate(("p", "q", "r"), 1)]
    other, twice = ran("s", ("FAILS: a fender",)), ran("t", ("FAILS: line 9 parts",), factor=2.0)
    none = running.Ran(case(), Path("x"), None)
    assert list(verdict.broken_in([*alike, other, twice, none])) == [
        "FAILS: line 1 parts; in p, and in 2 more cases", "FAILS: a fender; in s",
    ]  # fmt: skip
    assert list(verdict.broken_in(alike[:2])) == ["FAILS: line 1 parts; in p, and in 1 more case"]
    both = ran("u", ("FAILS: a fender", "a remark", "FAILS: line 2 parts", "FAILS: an anchor of 3 t"))
    assert list(verdict.broken_in([alike[0], both])) == [
        "FAILS: line 1 parts; in p, and in 1 more case", "FAILS: a fender; in u", "FAILS: an anchor of 3 t; in u",
    ]  # fmt: skip


# ------------------------------------------------------------------ words of the report


def test_the_worst_part_of_a_case_is_the_least_where_a_criterion_asks_for_at_least(monkeypatch):
    monkeypatch.setattr(report_words, "read_rules", lambda: [SimpleNamespace(quantity="strength", sense="at least")])
    read = SimpleNamespace(criteria=[SimpleNamespace(quantity="strain", sense="at most")])
    one = running.Ran(case("p"), Path("x"), numbers(parts={"strain": {"F1": 0.2, "F2": 0.4}}))
    two = running.Ran(case("q"), Path("x"), numbers(parts={"strength": {"F1": 2.5, "F2": 1.25}}))
    made = report_words.part_table(read, SimpleNamespace(ran=[one, ran("none"), two]))
    assert made == (["strain", "strength"], [("p", ["0.4 F2", ""]), ("q", ["", "1.25 F2"])])


@pytest.mark.parametrize("used, css", [(1.0, "passes"), (1.001, "fails"), (0.0, "passes")])
def test_a_rule_set_passes_up_to_its_limit(used, css):
    criterion = SimpleNamespace(quantity="tension", sense="at most", limit=0.54321)
    use = SimpleNamespace(utilisation=used, case="storm", item="line a")
    one = SimpleNamespace(criterion=criterion, use=use, unread=2, chosen=True, judged=3, known=5, name="R",
                          subject="chain")  # fmt: skip
    made = report_words.rule_set(one)
    assert made["css"] == css and made["by"] == "storm, line a" and made["unread"].startswith("2 of them still to be")
    assert made["cells"] == ("R", "chain", "yes", "3 of 5", "tension at most 0.5432")
    one.unread, one.chosen = 0, False
    assert report_words.rule_set(one)["unread"] == "" and report_words.rule_set(one)["cells"][2] == "no"


def test_motions_of_a_report_are_in_metres_and_degrees():
    still, moves = ran("p"), ran("q")
    moves = running.Ran(moves.case, moves.path, numbers(motions=np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])))
    timed = running.Ran(case("r"), Path("x"), numbers(), {"motions": np.array([4.0, 5, 6, 0, 0, math.pi])})
    failed = running.Ran(case("s"), Path("x"), None)
    assert list(report_words.motion_rows(SimpleNamespace(ran=[still, moves, timed, failed]))) == [
        ("q", ["1", "2", "3", "5.73", "11.5", "17.2"]), ("r", ["4", "5", "6", "0", "0", "180"]),
    ]  # fmt: skip


@pytest.mark.parametrize("terminal", [True, False])
def test_how_far_the_cases_are_stands_on_a_terminal_and_in_a_log(terminal, tmp_path):
    said = []
    status = SimpleNamespace(start=lambda: said.append("start"), update=said.append, stop=lambda: said.append("stop"))
    console = SimpleNamespace(is_terminal=terminal, status=lambda words: status)
    log = tmp_path / "log.txt"
    log.write_text("old\n")
    with result._Counting(console, log) as step:
        step(1, 3, "storm")
        step(2, 3, "calm")
    assert said == (["start", "1 of 3: storm", "2 of 3: calm", "stop"] if terminal else [])
    assert [line[9:] for line in log.read_text().splitlines()] == ["1 of 3: storm", "2 of 3: calm"]
    with result._Counting(None, log) as step:
        step(1, 1, "x")


# ------------------------------------------------------------------ kinds of studies


def test_natural_periods_and_records_at_a_berth_are_told():
    file = SimpleNamespace(attrs={"natural_period": [12.345, math.inf, 60.0]})
    assert "".join(berth._periods(file)) == "natural periods of small motions at the berth: surge 12.3 s, yaw 60 s"
    file.attrs["natural_period"] = [math.inf] * 3
    assert "".join(berth._periods(file)).endswith("none, since nothing holds the body at rest")
    for kept, told in ((3, []), (2, ["steady strains come from 2 of 3 runs,"])):
        said = list(berth._steady_of_few({"deflection": [0] * kept, "seed": [0] * 3}))
        assert [line[: len(words)] for line, words in zip(said, told, strict=True)] == told


class Held:
    """What `held_at` and `rest` are given and give: tensions and forces at the anchors of two lines"""

    lines = SimpleNamespace(tension_b=np.array([5.0, 7.0]), horizontal_a=np.array([3.0, 4.0]),
                            vertical_a=np.array([-1.0, -2.0]))  # fmt: skip

    def __init__(self, monkeypatch):
        self.poses = []
        where = "hakobune.mooring.lines.system.equilibrium"
        monkeypatch.setattr(f"{where}.held_at", lambda system, poses: self.poses.append(poses) or "held")
        monkeypatch.setattr(f"{where}.rest", lambda system: SimpleNamespace(lines=self.lines, of=system))
        body = SimpleNamespace(name="ship", position=(1.0, 2.0, 3.0, 0.0, 0.0, 0.5))
        self.system = SimpleNamespace(bodies=[body], lines=[1, 2])


def test_lines_are_held_where_the_body_is_displaced_to(monkeypatch):
    """Tension, pull along and up at the anchor: what the line pulls down at its lower end pulls the anchor up"""
    held, place = Held(monkeypatch), (0.1, 0.2, 0.3, 0.0, 0.0, 0.05)
    assert in_time._held_line(held.system, 1, place) == (7.0, 4.0, 2.0)
    c, s = math.cos(0.5), math.sin(0.5)  # surge and sway are along the axes of a body that heads to 0.5 rad
    at = (1.0 + 0.1 * c - 0.2 * s, 2.0 + 0.1 * s + 0.2 * c, 3.3, 0.0, 0.0, 0.55)
    assert held.poses[0]["ship"] == pytest.approx(at)
    made = SimpleNamespace(system_of=lambda *_: held.system)
    assert berth._at_rest(made, None, None, place).of == "held"
    assert held.poses[1]["ship"] == pytest.approx((1.1, 2.2, 3.3, 0.0, 0.0, 0.55))  # along those of space
    made.system_of = lambda *_: None
    assert berth._at_rest(made, None, None, place) is None


@pytest.mark.parametrize("factor", [1.0, 2.0])
def test_the_body_is_moved_from_its_mean_to_where_each_line_pulls_most(factor, monkeypatch):
    """Surge 0, 3, 0 m and 1, 0, −1 m in two runs: from the mean 1 to 3 m, from 0 to ±1 m, by the factor"""
    seen = []
    made = SimpleNamespace(
        hulls_of=lambda db: None, system_of=lambda *_: SimpleNamespace(lines=["a"]), berth_of=lambda *_: "berth"
    )
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: "db")
    monkeypatch.setattr(in_time, "make_study_of", lambda path: made)
    monkeypatch.setattr(in_time, "_held_line", lambda system, line, at: (10 * at[0], 20 * at[0], 0.0))
    monkeypatch.setattr(
        in_time, "_held_rope", lambda berth, rope, at: seen.append((berth, rope, at[0])) or (at[0], 0.0, at[0])
    )
    motion = np.zeros((2, 3, 6))
    motion[0, :, 0], motion[1, :, 0] = [0.0, 3.0, 0.0], [1.0, 0.0, -1.0]
    tension = np.array([[[1.0, 0.0], [2.0, 0.0], [0.0, 9.0]], [[5.0, 1.0], [0.0, 0.0], [0.0, 0.0]]])
    found = in_time._moved("study", "db", motion, tension, factor)
    most = 1 + 2 * factor  # the first run, where the line pulls 2 N
    assert found[:, 0] == pytest.approx([10 * most, 20 * most, 0.0])
    ends = [1 - factor, factor]  # of the rope, in the first run at 0 m, in the second at 1 m
    assert seen == [("berth", 0, pytest.approx(ends[0])), ("berth", 0, pytest.approx(ends[1]))]
    assert found[:, 1] == pytest.approx([max(ends[1], 0), 0.0, max(ends[1], 0)])


def test_a_file_of_other_runs_is_simulated_afresh_and_a_seed_that_fails_is_told(monkeypatch):
    from hakobune.bem.database.integrity import DatabaseError

    asked = []

    def simulate(study, db, path, console, here, fresh=False):
        asked.append((study, db, path, fresh))
        if not fresh:
            raise DatabaseError("of another study")
        return SimpleNamespace(interrupted=False, failures=[(3, "no line")])

    monkeypatch.setattr("hakobune.pipelines.simulate.run.simulate", simulate)
    monkeypatch.setattr("hakobune.pipelines.simulate.run.input_of", lambda study: f"input of {study}")
    monkeypatch.setattr("hakobune.pipelines.results.given.database_of", lambda path: f"open {path}")
    with pytest.raises(ValueError, match="seed 3: no line"):
        in_time._simulated("s", "db", "runs.h5", [1.0])
    assert asked == [("input of s", "open db", "runs.h5", False), ("input of s", "open db", "runs.h5", True)]
    monkeypatch.setattr(in_time, "_run", lambda *_: SimpleNamespace(interrupted=True, failures=[]))
    with pytest.raises(KeyboardInterrupt):
        in_time._simulated("s", "db", "runs.h5", [1.0])


def test_a_fender_pressed_beyond_its_table_uses_all_its_energy(monkeypatch):
    """Its strain is told; of its dolphin nothing is left"""
    from hakobune.mooring.fenders.fender import fender_of_points

    one = fender_of_points("F", 2.0, [0.0, 0.5, 1.0], [0.0, 5e5, 1e6], rated=0.5)
    monkeypatch.setattr("hakobune.pipelines.common.fender_tables.fender_of", lambda table: one)
    monkeypatch.setattr("hakobune.pipelines.simulate.file.summary_of", lambda file, name: {"largest": 1.5})
    table = SimpleNamespace(on=None, dolphin=1.0, dolphin_yield=500.0, dolphin_beyond=None)
    pressed = SimpleNamespace(name="F", fender=one)
    records = SimpleNamespace(fenders=[pressed])
    file = {"time": np.arange(3.0), "deflection": np.zeros((1, 3, 1))}
    found = berth._of_fenders(file, SimpleNamespace(dolphin=[], fender=[table]), records)
    assert found[OF_ENERGY] == {"F": math.inf} and found[TOTAL] == {"F": 0.75} and found[OF_ALLOWABLE] == {"F": 1.5}
    assert found[DOLPHIN] == {"F": 0.0}


def test_a_breakwater_is_told_by_its_sizes_and_solved_without_what_a_case_needs_not(monkeypatch, tmp_path):
    section = {"shape": "rectangle", "draft": 3.0, "beam": 12.5, "height": 4.0}
    words = breakwater.body({"section": section})
    assert words == "A rectangle: beam 12.5 m, height 4 m, draft 3 m; per metre of its length."
    asked, files = [], []
    made = SimpleNamespace(detail=(0, 1, 2, 3), write=lambda path: files.append(path) or path.touch())
    monkeypatch.setattr("hakobune.pipelines.breakwater.result.breakwater", lambda raw: asked.append(raw) or made)
    monkeypatch.setattr(breakwater, "_numbers", lambda asked, found: numbers(warnings=(f"{asked} {found}",)))
    raw = {"section": {"draft": 3.0}, "map": {}, "measured": {}, "optimisation": {}}
    found, runs = breakwater.run(raw, None, tmp_path / "c.h5", [1.0])
    assert asked == [{"section": {"draft": 3.0}}] and files == [tmp_path / "c.h5"] and runs is None
    assert found.warnings == ("1 2",) and "draft = 3.0" in (tmp_path / "c.toml").read_text()
    drawn = []
    monkeypatch.setattr("hakobune.pipelines.breakwater.picture.draw", lambda *given: drawn.append(given))
    breakwater.draw(raw, None, None, "p.png")
    assert drawn == [("p.png", 0, 1, 2, None)]


def test_numbers_of_a_single_point_are_of_its_hawsers_and_then_of_its_lines(monkeypatch):
    """The largest of rest and run; what an anchor holds grows as the tension of its line; place from that at rest"""
    asked = []
    monkeypatch.setattr(single_point, "_alone", lambda best: np.array([11.0, 12.0]))
    monkeypatch.setattr(
        "hakobune.mooring.single_point.in_time.pulls",
        lambda *given: (
            asked.append(given)
            or {
                "at rest": (np.array([50.0, 60.0]), np.array([100.0, 200.0])),
                "run": (np.array([70.0, 55.0]), np.array([150.0, 180.0])),
            }
        ),
    )
    system = SimpleNamespace(
        arrays=SimpleNamespace(ends=np.array([[0, 1], [2, 3]])),
        breaking_load=np.array([1e3, 2e3]),
        lines=[SimpleNamespace(length=300.0), SimpleNamespace(length=310.0)],
    )
    lines = SimpleNamespace(
        system=system,
        points=np.arange(12.0).reshape(4, 3),
        tension=np.array([100.0, 200.0]),
        lines=SimpleNamespace(horizontal_a=np.array([80.0, 90.0]), vertical_a=np.array([-8.0, 9.0])),
    )
    best = SimpleNamespace(
        lines=lines,
        buoy=np.array([5.0, 7.0]),
        place=np.array([50.0, 70.0]),
        heading=math.pi + 0.5,
        hawser=np.array([50.0, 60.0]),
        point=SimpleNamespace(lengths=np.array([40.0, 40.0]), origin=np.array([1.0, 2.0])),
    )
    hawser = SimpleNamespace(breaking_load_tonf=None, breaking_load_kN=0.5, breaking_load=None)
    monkeypatch.setattr(single_point, "force", lambda *_: 500.0)
    study = SimpleNamespace(
        waves=None,
        hawser=hawser,
        mooring=SimpleNamespace(type="", segments=[SimpleNamespace(type="chain"), SimpleNamespace(type="wire")]),
    )
    away = SimpleNamespace(buoy=np.array([[1.0, 2.0], [7.0, 10.0]]))  # 10 m from (1, 2)
    run = SimpleNamespace(cycle=SimpleNamespace(amplitude=math.radians(7.0)), record=away)
    found = single_point._numbers(study, best, 1, None, run, ["h1", "h2"], ["l1", "l2"], ("w",))
    assert asked == [(best, None, run, False)]
    assert found.names == ("h1", "h2", "l1", "l2") and found.hawsers == ("h1", "h2") and found.warnings == ("w",)
    assert found.types == (("hawser",), ("hawser",), ("chain", "wire"), ("chain", "wire"))
    assert found.fairlead.tolist() == [[5, 7, 0], [5, 7, 0], [3, 4, 5], [9, 10, 11]]
    assert found.anchor.tolist() == [[50, 70, 0], [50, 70, 0], [0, 1, 2], [6, 7, 8]]
    assert found.length.tolist() == [40, 40, 300, 310] and found.pretension.tolist() == [0, 0, 11, 12]
    assert found.static.tolist() == [50, 60, 100, 200] and found.largest.tolist() == [70, 60, 150, 200]
    assert found.breaking.tolist() == [500, 500, 1e3, 2e3]
    assert found.horizontal.tolist() == [0, 0, 120, 90] and found.uplift.tolist() == [0, 0, 12, -9]
    assert found.place == pytest.approx([4.0, 5.0, 0.5 - math.pi])
    assert found.parts[single_point.STABLE] == {"at rest": 1.0} and found.parts[single_point.SLEWING][
        "heading"
    ] == pytest.approx(7.0)
    assert found.parts["excursion"] == {"buoy": 10.0}
    one = single_point._numbers(study, best, 2, None, None, [], ["l1", "l2"], ())
    assert one.parts["excursion"] == {"buoy": pytest.approx(math.hypot(4.0, 5.0))}
    assert one.names == ("l1", "l2") and single_point.SLEWING not in one.parts and one.largest.tolist() == [150, 200]
    best.point.lengths = np.array([40.0])
    alone = single_point._numbers(study, best, 2, None, None, ["h1"], ["l1", "l2"], ())
    assert alone.length.tolist() == [40, 300, 310] and alone.largest.tolist() == [70, 150, 200]


def test_a_single_point_is_solved_without_maps_and_its_files_lie_beside_the_case(monkeypatch, tmp_path):
    files, asked = [], []
    rest = [SimpleNamespace(slewing=SimpleNamespace(stable=stable)) for stable in (True, False, True)]
    detail = SimpleNamespace(study=SimpleNamespace(hawser=1), best=SimpleNamespace(hawser=[1, 2]), rest=rest, cycle="c",
                             run="r")  # fmt: skip
    made = SimpleNamespace(
        detail=detail, write=lambda path: files.append(path) or path.touch(), told=("t",), notes=("n",)
    )
    monkeypatch.setattr(
        "hakobune.pipelines.single_point.result.single_point", lambda *given: asked.append(given) or made
    )
    seen = []
    monkeypatch.setattr(single_point, "_numbers", lambda *given: seen.append(given) or numbers())
    raw = {"mooring": {"headings_deg": [0.0, 120.5]}, "maps": [1]}
    found, runs = single_point.run(raw, None, tmp_path / "c.h5", [1.0])
    assert asked == [({"mooring": raw["mooring"]}, None)] and files == [tmp_path / "c.h5"] and runs is None
    assert seen[0][2:] == (2, "c", "r", ["hawser 1", "hawser 2"], ["line at 0°", "line at 120.5°"], ("t", "n"))
    assert found.names == ("a", "b") and "headings_deg" in (tmp_path / "c.toml").read_text()
    assert single_point.without(raw, "line at 0°")["mooring"]["headings_deg"] == [120.5]


@pytest.mark.parametrize("at_berth, simulated", [(True, True), (False, True), (False, False)])
def test_a_moored_body_is_run_by_the_method_of_its_study(at_berth, simulated, monkeypatch, tmp_path):
    """Findings of the simplified method stand behind those of runs in time, but for what time changes"""
    runs = {"breaking": np.array([3.0, 4.0]), "findings": ("of time",), "parts": {"gap between hulls": {"a b": 2.0}}}
    asked = []
    monkeypatch.setattr(in_time, "simulated", lambda *given: asked.append(given) or runs)
    monkeypatch.setattr(mooring, "make_study", lambda raw: SimpleNamespace(at_berth=at_berth))
    stored = numbers(warnings=("of statics", f"x {mooring.FINDINGS_IN_TIME} y"))
    monkeypatch.setattr(mooring, "_solved", lambda *given: stored)
    monkeypatch.setattr(berth, "berth_numbers", lambda study, db, path, runs: numbers(warnings=(path.name,)))
    (tmp_path / "db.h5").write_bytes(b"")
    (tmp_path / "c_runs.h5").write_bytes(b"")
    study = {"simulation": {"seeds": 1}} if simulated else {"name": "x"}
    found, ran = mooring.run(study, tmp_path / "db.h5", tmp_path / "c.h5", [1.0, 2.0])
    if simulated:
        assert asked == [(tmp_path / "c.toml", tmp_path / "db.h5", tmp_path / "c_runs.h5", [1.0, 2.0])]
    if at_berth:
        assert found.warnings == ("c_runs.h5",) and ran is runs and (tmp_path / "c.toml").is_file()
    elif simulated:
        assert found.warnings == ("of time", "simplified method: of statics") and found.breaking.tolist() == [3, 4]
        assert ran is runs and found.parts["gap between hulls"] == {"a b": 2.0}
    else:
        assert found is stored and ran is None and not asked


@pytest.mark.parametrize(("at_berth", "bodies"), [(True, ()), (True, (1, 2)), (False, ())])
def test_a_moored_body_is_drawn_with_what_its_lines_use(at_berth, bodies, monkeypatch):
    drawn, db, kinds = [], SimpleNamespace(bodies=bodies), "hakobune.pipelines.design.kinds"
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: db)
    monkeypatch.setattr(mooring, "make_study", lambda raw: SimpleNamespace(at_berth=at_berth))
    monkeypatch.setattr(f"{kinds}.berth_plan.draw_berth", lambda *given: drawn.append(("one", *given)))
    monkeypatch.setattr(f"{kinds}.side_plan.draw_between", lambda *given: drawn.append(("more", *given)))
    monkeypatch.setattr("hakobune.pipelines.moor.plan_picture.draw_plan", lambda *given: drawn.append(given))
    monkeypatch.setattr("hakobune.pipelines.moor.result.studied", lambda made, db: ("found", None))
    one = numbers(largest=np.array([1.0, 2.0]), breaking=np.array([4.0, np.inf]))
    mooring.draw({}, "path", one, "p.png")
    if at_berth:
        assert drawn[0][0] == ("more" if bodies else "one") and drawn[0][2:] == (db, one, "p.png")
    else:
        assert drawn[0][:3] == ("found", db, "p.png") and drawn[0][3][0] == 0.25 and np.isnan(drawn[0][3][1])


def test_a_page_is_drawn_again_where_any_file_of_the_code_changes(tmp_path, monkeypatch):
    """A name, a byte or another package gives another digest; the same files the same"""
    for name in CODE:
        (tmp_path / name / "deep").mkdir(parents=True)
        (tmp_path / name / "deep" / "one.py").write_text("x")
    monkeypatch.setattr("importlib.import_module",
                        lambda name: SimpleNamespace(__path__=[str(tmp_path / name.split(".")[1])]))  # fmt: skip
    digest = code.__wrapped__
    seen = [digest(), digest()]
    for change in (lambda: (tmp_path / CODE[0] / "deep" / "one.py").write_text("y"),
                   lambda: (tmp_path / CODE[-1] / "deep" / "one.py").rename(tmp_path / CODE[-1] / "deep" / "two.py"),
                   lambda: (tmp_path / CODE[1] / "three.py").write_text("")):  # fmt: skip
        change()
        seen.append(digest())
    assert seen[0] == seen[1] and len(set(seen)) == 4 and len(seen[0]) == 64


def test_a_rope_pulls_at_its_bollard_along_the_straight_way(monkeypatch):
    """Of fenders 1, 2 and ropes 30, 70 N the second rope; from its bollard 3 m ahead, 4 m aside, 12 m up: 5/13 along"""
    monkeypatch.setattr("hakobune.mooring.motion.contacts.contact_forces", lambda berth, place: [1.0, 2.0, 30.0, 70.0])
    rope = SimpleNamespace(fairlead=np.array([10.0, 1.0, 2.0]), bollard=np.array([7.5, -2.75, -9.5]))
    arrays = SimpleNamespace(place=np.array([[10.0, 1.0, 2.0]]), body=[0] * 4, other=[-1] * 4)
    held = SimpleNamespace(fenders=[1, 2], ropes=[None, rope], arrays=arrays, heading=np.zeros(1))
    tension, along, up = in_time._held_rope(held, 1, np.array([0.5, 0.25, 0.5, 0.0, 0.0, 0.0]))
    assert (tension, along, up) == pytest.approx((70.0, 70 * 5 / 13, 70 * 12 / 13))
    turned = SimpleNamespace(fairlead=np.array([11.0, 1.0, 2.0]), bollard=np.array([10.0, -2.0, 2.0]))
    held.ropes = [turned, None]
    tension, along, up = in_time._held_rope(held, 0, np.array([0, 0, 0, 0, 0, math.pi / 2]))
    assert (tension, along, up) == pytest.approx((30.0, 30.0, 0.0))


def test_the_worst_is_what_uses_most_and_a_count_that_is_met_only_if_nothing_else_is_there():
    """Stable headings have no share of a limit: met they use 0, missed they count as any other"""

    def one(quantity, used, met=True):
        governing = None if used is None else SimpleNamespace(utilisation=used)
        return SimpleNamespace(governing=governing, met=met, criterion=SimpleNamespace(quantity=quantity))

    def worst(*judged):
        return report_words._worst(SimpleNamespace(judged=judged))

    count, missed = one("stable headings", 0.9), one("stable headings", 1.5, met=False)
    tension, surge, unknown = one("tension", 0.4), one("surge", 0.7), one("sway", None)
    assert worst(count, tension, surge, unknown) is surge and worst(count, unknown) is count
    assert worst(missed, surge) is missed and worst(tension, one("yaw", 1.2, met=False)).governing.utilisation == 1.2
    assert worst(unknown) is None and worst() is None
