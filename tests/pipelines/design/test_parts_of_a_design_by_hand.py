"""Parts of a design with their neighbours replaced: changes of a study, pictures and numbers that are kept,
databases of levels, an earthquake, the verdict."""

import base64
import hashlib
import json
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.verdict import Case, judge
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design import advice, running, verdict
from hakobune.pipelines.design.kinds import berth, changes, earthquake, mooring, stored
from hakobune.pipelines.design.kinds.needs import ANCHOR, COEFFICIENT, DOLPHIN, OF_ALLOWABLE, TOTAL


def test_ways_of_a_study_are_series_of_growing_changes(monkeypatch):
    """Sizes of all types together, as many as the shorter catalogue has; less and more pretension; to three lines"""
    monkeypatch.setattr(
        changes, "larger_sizes", lambda kind, most: {"k1": ["k2", "k3", "k4"], "w1": ["w2", "w3"]}[kind]
    )
    study = {
        "types": {"chain": {"catalogue": "k1"}, "wire": {"catalogue": "w1"}, "own": {"weight": 1.0}},
        "spreads": [{"corner_headings_deg": [40.0, 50.0], "pretension_kN": 100.0}, {"corner_headings_deg": [30.0]}],
        "lines": [{"top_tension_tonf": 10.0}],
    }  # fmt: skip
    before = json.dumps(study)
    made = changes.ways(study)
    assert json.dumps(study) == before and list(made) == ["size", "less pretension", "more pretension", "number"]
    assert [one.words for one in made["size"]] == ["k2 for chain, w2 for wire", "k3 for chain, w3 for wire"]
    assert made["size"][1].study["types"] == {
        "chain": {"catalogue": "k3"},
        "wire": {"catalogue": "w3"},
        "own": {"weight": 1.0},
    }
    assert [one.words for one in made["less pretension"]] == [
        "a pretension of 80 kN, 8 tonf", "a pretension of 65 kN, 6.5 tonf", "a pretension of 50 kN, 5 tonf",
        "a pretension of 40 kN, 4 tonf"]  # fmt: skip
    assert [one.study["lines"][0]["top_tension_tonf"] for one in made["more pretension"]] == [12.5, 15, 20, 25]
    assert [one.words for one in made["number"]] == [f"{n + 2}, {n + 1} lines at each corner" for n in (1, 2, 3)]
    spreads = made["number"][0].study["spreads"]
    assert spreads[0]["corner_headings_deg"] == [35, 45, 55] and spreads[1]["corner_headings_deg"] == [20, 40]
    wide = {"spreads": [{"corner_headings_deg": [0.0, 60.0]}]}
    assert changes._more_lines(wide, 1).__next__().study["spreads"][0]["corner_headings_deg"] == [0, 30, 60]


def test_ropes_of_a_berth_are_made_stronger_and_doubled():
    study = {"rope": [{"name": "bow", "breaking_load_kN": 500.0, "tail_breaking_load_kN": 400.0, "pretension_kN": 20.0},
                      {"name": "stern", "breaking_load_kN": 300.0}]}  # fmt: skip
    made = changes.ways(study)
    assert len(made["size"]) == 10 and made["size"][0].words == "ropes of 330, 550 kN breaking load"
    assert made["size"][9].words == "ropes of 600, 1000 kN breaking load"
    loads = {"breaking_load_tonf": 80.0, "tail_breaking_load_tonf": 100.0}
    tonf = changes.ways({"rope": [loads | {"name": "bow"}]})["size"][0]
    assert tonf.words == "ropes of 88 tonf breaking load"
    assert [tonf.study["rope"][0][key] for key in loads] == pytest.approx([88.0, 110.0])
    first = made["size"][4].study["rope"]
    assert [first[0]["breaking_load_kN"], first[0]["tail_breaking_load_kN"], first[1]["breaking_load_kN"]] == [
        750,
        600,
        450,
    ]
    (twice,) = made["number"]
    assert twice.words == "4 ropes, two at each place"
    assert [one["name"] for one in twice.study["rope"]] == ["bow", "stern", "bow, second", "stern, second"]
    assert changes.ways({}) == {}
    buoy = changes.ways({"mooring": {"count": 6, "pretension_kN": 10.0}})
    assert [one.words for one in buoy["number"]] == [
        "7 lines at the buoy",
        "8 lines at the buoy",
        "9 lines at the buoy",
    ]
    assert buoy["more pretension"][3].study["mooring"]["pretension_kN"] == 25.0


@pytest.mark.parametrize(("yields", "coefficient"), [((1e3, 4e5), 0.2), (None, None), ((1e3, np.inf), 0.2)])
def test_an_earthquake_presses_fenders_by_every_method_that_has_values(monkeypatch, yields, coefficient):
    """Fenders of 2 m, allowed half; the second of three methods has no reaction; 3 dolphins of 400 kN over 600 kN"""
    rows = [
        SimpleNamespace(name=n, reason="", deflection=d, reaction=r)
        for n, d, r in (("rule", 0.8, 6e5), ("still", 0.0, 0.0))
    ]
    fenders = SimpleNamespace(fender=SimpleNamespace(own=lambda y: 0.5 * y), count=3)
    quake = SimpleNamespace(fenders=fenders, coefficient=coefficient)
    asked = []
    monkeypatch.setattr("hakobune.mooring.dolphins.methods.methods", lambda quake: (rows, None))
    monkeypatch.setattr(
        "hakobune.mooring.dolphins.methods.failures", lambda *given: asked.append(given) or ["FAILS: it"]
    )
    monkeypatch.setattr(earthquake, "quake_of", lambda *given: asked.append(given) or quake)
    monkeypatch.setattr(earthquake, "fender_of", lambda table: SimpleNamespace(height=2.0, allowable=0.5))
    monkeypatch.setattr(earthquake, "dolphin_of", lambda table, others: yields)
    monkeypatch.setattr(earthquake, "_alone", lambda table: table)
    study = SimpleNamespace(fender="table")
    made = earthquake._found(study, "folder", "db")
    assert asked == [(study, "folder", "db"), (quake, rows)] and made.warnings == ("FAILS: it",)
    assert made.parts[TOTAL] == {"rule": 0.2, "still": 0.0} and made.parts[OF_ALLOWABLE] == {"rule": 0.4, "still": 0.0}
    known = yields and np.isfinite(yields[1])
    assert made.parts.get(DOLPHIN) == ({"rule": pytest.approx(2.0)} if known else None)
    assert made.parts.get(COEFFICIENT) == ({"of the rule": 0.2} if coefficient else None)
    rows[1].reason = "the record is too short"
    with pytest.raises(ValueError, match="still: the record is too short"):
        earthquake._found(study, "folder", "db")


def test_a_picture_is_drawn_once_and_again_where_its_key_or_its_file_changed(tmp_path):
    place, drawn = tmp_path / "new" / "plan.png", []

    def draw(path):
        drawn.append(path)
        path.write_bytes(b"picture %d" % len(drawn))

    address = "data:image/png;base64," + base64.b64encode(b"picture 1").decode()
    assert stored.picture(place, "key", draw) == address == stored.picture(place, "key", draw) and drawn == [place]
    assert stored.picture(place, "other", draw).endswith(base64.b64encode(b"picture 2").decode())
    place.write_bytes(b"damaged")
    assert stored.picture(place, "other", draw).endswith(base64.b64encode(b"picture 3").decode())
    place.unlink()
    stored.picture(place, "other", draw)
    assert len(drawn) == 4


def test_values_are_kept_with_the_key_they_are_of_and_a_seal(tmp_path):
    place, made = tmp_path / "v.json", []

    def values():
        made.append(1)
        return {"a": len(made)}

    assert stored.kept(place, lambda: "k", values) == stored.kept(place, lambda: "k", values) == {"a": 1}
    assert stored.kept(place, lambda: "other", values) == {"a": 2}
    text = json.loads(place.read_text())
    place.write_text(json.dumps(text | {"values": {"a": 9}}))  # the seal is of {"a": 2}
    assert stored.kept(place, lambda: "other", values) == {"a": 3}
    for broken in ("{", "[]", '{"of": "other"}'):
        place.write_text(broken)
        stored.kept(place, lambda: "other", values)
    assert len(made) == 6


class Read(dict):
    """A result of `hakobune moor` as it is read back"""

    told = ("note", "FAILS: it")

    def __init__(self, study, seal):
        names = (
            "fairlead.place",
            "anchor.place",
            "line.length",
            "tension.at_rest",
            "tension.steady",
            "tension.largest",
            "line.breaking_load",
            "tension.used",
            "anchor.largest_horizontal",
            "anchor.largest_vertical",
            "motion.amplitude",
        )
        super().__init__({name: name for name in names} | {"pose.x": 1.0, "pose.y": 2.0, "pose.yaw": 3.0})
        self.provenance = {"study": study, "database_sha256": seal}
        self.labels = {"line": SimpleNamespace(values=np.array(["bow", "stern"]))}


@pytest.mark.parametrize(
    ("text", "content", "known"), [("text", b"db", True), ("other", b"db", False), ("text", b"changed", False)]
)
def test_numbers_of_a_mooring_are_read_again_for_the_same_study_and_database_alone(
    monkeypatch, tmp_path, text, content, known
):
    database = tmp_path / "b.h5"
    database.write_bytes(content)
    kept = Read("text", hashlib.sha256(b"db").hexdigest())
    monkeypatch.setattr("hakobune.pipelines.results.file.read", lambda path, kind: kept)
    monkeypatch.setattr(mooring, "strength", lambda *given: given)
    monkeypatch.setattr(mooring, "types_of", lambda table: table["type"])
    study = {"lines": [{"type": "chain"}, {"type": "wire"}]}
    found = mooring._stored(tmp_path / "r.h5", study, text, database)
    if not known:
        assert found is None
        return
    assert found.names == ("bow", "stern") and found.types == ("chain", "wire") and found.place.tolist() == [1, 2, 3]
    assert found.breaking == ("line.breaking_load", "tension.largest", "tension.used") and found.warnings == kept.told
    assert (found.fairlead, found.anchor, found.length) == ("fairlead.place", "anchor.place", "line.length")
    assert (found.pretension, found.static, found.largest) == ("tension.at_rest", "tension.steady", "tension.largest")
    assert (found.horizontal, found.uplift) == ("anchor.largest_horizontal", "anchor.largest_vertical")
    assert found.motions == "motion.amplitude" and found.parts == {}

    def missing(path, kind):
        raise OSError

    monkeypatch.setattr("hakobune.pipelines.results.file.read", missing)
    assert mooring._stored(tmp_path / "r.h5", study, text, database) is None


def test_a_mooring_is_solved_where_nothing_is_stored_and_then_read(monkeypatch, tmp_path):
    asked, answers = [], [None, "numbers"]
    monkeypatch.setattr(mooring, "_stored", lambda *given: asked.append(given) or answers.pop(0))
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: f"open {path}")
    result = SimpleNamespace(write=lambda path: asked.append(("write", path)))
    monkeypatch.setattr("hakobune.pipelines.moor.result.moor", lambda *given: asked.append(given) or result)
    study, path = {"a": 1}, tmp_path / "c.h5"
    assert mooring._solved(study, "db.h5", path) == "numbers"
    key = (path, study, "a = 1\n", "db.h5")
    assert (
        asked == [key, (study, "open db.h5"), ("write", path), key] and (tmp_path / "c.toml").read_text() == "a = 1\n"
    )
    answers[:], asked[:] = ["kept"], []
    assert mooring._solved(study, "db.h5", path) == "kept" and asked == [key]


@pytest.mark.parametrize(("own", "wanted"), [
    ({"database": "b.h5", "scene": None}, "given"), ({"database": None, "scene": None}, "none"),
    ({"database": None, "scene": "s.toml"}, "solved")])  # fmt: skip
def test_databases_of_levels_lie_in_a_folder_of_their_own(monkeypatch, tmp_path, own, wanted):
    solved = []
    outcome = SimpleNamespace(interrupted=False, exit_status=0, failures=())
    monkeypatch.setattr(
        "hakobune.pipelines.solve.run.solve", lambda scene, path, **more: solved.append((scene, path, more)) or outcome
    )
    monkeypatch.setattr(running, "scenes", lambda read: {"mean": "scene 1", "high": "scene 2"})
    read = SimpleNamespace(
        project=SimpleNamespace(project=SimpleNamespace(**own), levels={"high": 2.0}), folder=tmp_path
    )
    found = running.databases(read, tmp_path / "out", "here", "console")
    place = tmp_path / "out" / "databases"
    assert found == {"given": {"mean": tmp_path / "b.h5"}, "none": {"mean": None, "high": None},
                     "solved": {"mean": place / "mean.h5", "high": place / "high.h5"}}[wanted]  # fmt: skip
    assert place.is_dir() is (wanted == "solved")
    more = {"executor": "here", "console": "console"}
    assert solved == (
        [("scene 1", place / "mean.h5", more), ("scene 2", place / "high.h5", more)] if wanted == "solved" else []
    )
    if wanted == "solved":
        outcome.exit_status, outcome.failures = 1, ((0.5, "no"), (0.6, "never"))
        with pytest.raises(StudyError, match=r"the database of level 'mean' is incomplete: 0\.5 no"):
            running.databases(read, tmp_path / "out", "here", "console")
        outcome.failures = ()
        with pytest.raises(StudyError, match="is incomplete:  not all frequencies are stored"):
            running.databases(read, tmp_path / "out", "here", "console")
        outcome.interrupted = True
        with pytest.raises(KeyboardInterrupt):
            running.databases(read, tmp_path / "out", "here", "console")


@pytest.mark.parametrize(("numbers", "met", "databases", "tired", "word"), [
    ((1, 1), (True, True), (), None, "PASSES"), ((1, 1), (True, False), (), None, "FAILS"),
    ((1, 1), (True, None), (), None, "OPEN"), ((1, None), (True, True), (), None, "OPEN"),
    ((1, 1), (True, True), ("FAILS: law",), None, "FAILS"), ((1, 1), (True, True), (), False, "FAILS"),
    ((1, 1), (True, True), (), True, "PASSES"), ((1, None), (True, False), (), None, "FAILS"),
    ((None, 1), (None, True), (), None, "OPEN"), ((2, 1), (True, True), (), None, "FAILS"),
])  # fmt: skip
def test_a_design_passes_where_every_criterion_is_met_and_nothing_is_unknown(
    monkeypatch, numbers, met, databases, tired, word
):
    """numbers : None of a case that could not be run, 2 of one whose study reports a failure"""
    ran = [
        SimpleNamespace(
            numbers=one and SimpleNamespace(warnings=["FAILS: line 3 parts at 9 kN"] * (one == 2)),
            case=SimpleNamespace(name=f"case {i}", factor=1),
        )
        for i, one in enumerate(numbers)
    ]
    judged, case = tuple(SimpleNamespace(met=one) for one in met), SimpleNamespace(parts={})
    asked = []
    monkeypatch.setattr(verdict, "grouped", lambda ran: {i: {1.0: one} for i, one in enumerate(ran)})
    monkeypatch.setattr(verdict, "project_quantities", lambda read: {"return period": 475.0})
    monkeypatch.setattr(verdict, "judged_case", lambda read, group, others: asked.append(group) or case)
    monkeypatch.setattr(verdict, "fatigue", lambda read, ran: None if tired is None else SimpleNamespace(met=tired))
    monkeypatch.setattr(verdict, "judge", lambda criteria, cases: asked.append(cases) or judged[: 9 * len(criteria)])
    monkeypatch.setattr(verdict, "side_by_side", lambda read, cases: "sets")
    made = verdict.judged_project(SimpleNamespace(criteria=("own",)), ran, databases)
    assert made.word == getattr(verdict, word) and made.return_period == 475.0 and made.rule_sets == "sets"
    assert len(made.judged) == 2 + (tired is not None) and asked[-2] == [case] * sum(one is not None for one in numbers)
    assert made.broken[: len(databases)] == databases and len(made.broken) == len(databases) + (2 in numbers)


def test_advice_of_lines_that_did_not_move_begins_with_it_and_keeps_the_rest():
    warned = SimpleNamespace(numbers=SimpleNamespace(warnings=["note", f"{advice.OF_LINES}, of 3 lines"]))
    none = SimpleNamespace(numbers=None)
    of = advice.Advice(("size",), (), "beyond")
    made = advice.after_lines_move(of, [none, warned])
    assert made.beyond == (
        f"This advice was computed with static lines ({advice.OF_LINES}, of 3 lines). Run the lines in "
        "motion first. beyond"
    )
    assert advice.after_lines_move(of._replace(beyond=""), [warned]).beyond.endswith("motion first.")
    assert advice.after_lines_move(of, [none]) is of
    untried = of._replace(tried=())
    assert advice.after_lines_move(untried, [warned]) is untried


def test_fenders_of_runs_are_judged_one_by_one(monkeypatch):
    """Fenders of 2 m, allowed 1 m; largest 1.0 and −0.4 m of fender and dolphin together, half of it the fender's"""
    values = {"deflection F1": {"largest": 1.0}, "deflection F2": {"largest": -0.4}}

    monkeypatch.setattr("hakobune.pipelines.simulate.file.summary_of", lambda file, name: values[name])
    one = SimpleNamespace(height=2.0, allowable=0.5, energy=lambda y: 100.0 * y, rated_energy=200.0, rated_reaction=4e5)
    monkeypatch.setattr("hakobune.pipelines.common.fender_tables.fender_of", lambda table: one)
    monkeypatch.setattr(berth, "dolphin_of", lambda table, dolphins: (1.0, 9e5) if table == "t1" else None)
    monkeypatch.setattr(berth, "_longest_mean", lambda record, step: float(record.max()) + step)
    both = [
        SimpleNamespace(name=n, fender=SimpleNamespace(own=lambda y: 0.5 * y, largest_reaction=lambda y: 3e5))
        for n in ("F1", "F2")
    ]
    record = np.zeros((1, 3, 2))
    record[0, :, 0], record[0, :, 1] = 0.5, 0.25
    file = {"time": np.array([0.0, 0.125, 0.25]), "deflection": {(): record}}
    found = berth._of_fenders(file, SimpleNamespace(dolphin=(), fender=["t1", "t2"]), SimpleNamespace(fenders=both))
    assert found[TOTAL] == {"F1": 0.25, "F2": 0.0} and found[berth.SLOW] == {"F1": 0.625 / 4, "F2": 0.375 / 4}
    assert found[OF_ALLOWABLE] == {"F1": 0.5, "F2": 0.0} and found[berth.OF_ENERGY] == {"F1": 0.25, "F2": 0.0}
    assert found[DOLPHIN] == {"F1": pytest.approx(3.0)}
    assert found[berth.REACTION]["F1"] == 300.0 and found[berth.OF_REACTION]["F1"] == 0.75


STEVIN = {"kind": "drag", "type": "Stevin", "soil": "sand", "mass": 2500, "safety": 1.5}


@pytest.mark.parametrize("anchor, used", [
    (STEVIN | {"mass": 4536.0}, [1.5 * 367.0 / 734.0, 1.5 * 1000.0 / 734.0]),  # UFC 4-159-03: 734 kN at 10 000 lb
    ({"kind": "drag", "holding_kN": 500.0, "safety": 1.0}, [367.0 / 500.0, 2.0]),
    ({"kind": "drag", "type": "Stevin", "soil": "sand"}, None),  # one whose mass is asked for
    (None, None),
])  # fmt: skip
def test_anchors_of_known_capacity_are_judged_in_each_case_by_their_own_safety(anchor, used):
    study = {"water": {"depth": 9.0}, "types": {"chain": {"catalogue": "R3 studless 32 mm"}}, "spreads": [
        {"type": "chain", "length": 150.0, "corner_headings_deg": [30], "pretension_kN": 25.0}
    ]} | ({"anchors": [anchor]} if anchor else {})  # fmt: skip
    case = SimpleNamespace(study=study)
    numbers = SimpleNamespace(names=("a", "b", "hawser"), types=(("chain",), ("chain",), ("rope",)))
    pulls = {"horizontal": np.array([367e3, 1000e3, 9e9]), "uplift": np.zeros(3)}
    found = running.anchors_used(running.Ran(case, None, numbers, pulls))
    if used is None:
        assert found == {}
        return
    assert found[ANCHOR] == pytest.approx(dict(zip("ab", used, strict=True)), rel=1e-3)
    (judged,) = judge([verdict.OF_ANCHORS], [Case("c", "normal", "intact", "", {}, {}, {}, found)])
    assert judged.met is False and judged.governing.item == "b"
