"""What the result of a design tells of criteria and load cases, and what its parts are made from: by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.rules import Criterion
from hakobune.mooring.criteria.verdict import Judged, Use
from hakobune.pipelines.design import result
from hakobune.pipelines.design.running import Ran


def criterion(rule, quantity, limit, unit="-"):
    return Criterion(rule, "", quantity, "at most", limit, None, unit, "any", "any", "any", "", "", 1.0, "", "read")


USES = Use("storm", "bow", 0.3, 0.6), Use("calm", "bow", 0.1, 0.2)
CRITERIA = [
    Judged(criterion("API", "tension / breaking load", 0.5), USES),
    Judged(criterion("own", "excursion", 5.0, "m"), (Use("storm", "body", 5.02, 1.004),)),
    Judged(criterion("port", "strain", 0.6), (), "no fender in the study"),
]


def ran(name, largest, fault="", in_time=None):
    numbers = None if largest is None else SimpleNamespace(largest=np.array(largest), warnings=(), motions=np.ones(6))
    runs = None if in_time is None else {"largest": {1.0: np.array(in_time)}}
    return Ran(SimpleNamespace(name=name), None, numbers, runs, fault)


def verdict(**more):
    cases = [ran("storm", [1e5, 3e5, 2e5]), ran("calm", []), ran("tsunami", None, "no equilibrium")]
    own = {"judged": CRITERIA, "ran": cases, "word": "fails", "broken": ("FAILS a line parts",)}
    return SimpleNamespace(**own | more)


@pytest.fixture
def told(monkeypatch):
    monkeypatch.setattr(result, "summary", lambda verdict: ": because")
    monkeypatch.setattr(result, "advice_words", lambda change, verdict: (f"advice {change}",))
    return result.result_of(verdict(), "more chain", ("design.html",), {"project": "p.toml"})


def test_criteria_are_told_in_order_with_the_case_that_governs_and_blanks_where_none_does(told):
    assert told.labels["criterion"].values.tolist() == [
        "1 API: tension / breaking load", "2 own: excursion", "3 port: strain",
    ]  # fmt: skip
    values = {name: told[f"criterion.{name}"].tolist() for name in ("limit", "unit", "verdict", "item", "case")}
    assert values == {
        "limit": [0.5, 5.0, 0.6], "unit": ["", "m", ""], "verdict": ["met", "not met", "not judged"],
        "item": ["bow", "body", ""], "case": ["storm", "storm", ""],
    }  # fmt: skip
    assert told["criterion.used"] == pytest.approx([0.6, 1.004, np.nan], nan_ok=True)
    assert told["criterion.value"] == pytest.approx([0.3, 5.02, np.nan], nan_ok=True)
    shares = {name for name, one in told.quantities.items() if one.share}
    unprinted = {name for name, one in told.quantities.items() if not one.table}
    assert shares == {"criterion.used"} and unprinted == {"criterion.value", "verdict"}


def test_load_cases_have_their_largest_tension_in_newtons_where_they_have_lines(told):
    assert told["load_case.largest_tension"] == pytest.approx([3e5, np.nan, np.nan], nan_ok=True)
    one = told.quantities["load_case.largest_tension"]
    assert (one.unit, one.description) == ("N", "largest tension, simplified method")
    assert told.labels["load_case"].values.tolist() == ["storm", "calm", "tsunami"]


def test_load_cases_in_time_have_the_tensions_of_their_runs(monkeypatch):
    """not those of the simplified method, which gives them their place under steady forces alone"""
    cases = [ran("storm", [1e5, 3e5], in_time=[2e5, 1.5e5]), ran("calm", [4e5, 5e5], in_time=[6e5, 5e5])]
    monkeypatch.setattr(result, "summary", lambda verdict: "")
    found = result.result_of(verdict(ran=cases), None, (), {})
    assert found["load_case.largest_tension"].tolist() == [2e5, 6e5]
    assert found.quantities["load_case.largest_tension"].description == "largest tension, in time"


def test_findings_are_what_fails_is_not_judged_or_could_not_be_run_and_notes_the_verdict_and_advice(told):
    beyond, open_, unrun, broken = map(str, told.findings)
    assert "own: excursion at most 5 m: 100.4 %, body, storm" in beyond
    assert "port: strain at most 0.6: no fender in the study" in open_
    assert "tsunami could not be run: no equilibrium" in unrun and broken == "FAILS a line parts"
    assert told.notes == ("the mooring fails: because", "advice more chain") and told["verdict"] == "fails"
    assert told.detail[1] == ("design.html",) and told.provenance == {"project": "p.toml"} and told.kind == "design"


def test_a_design_without_criteria_or_cases_is_told_too(monkeypatch):
    monkeypatch.setattr(result, "summary", lambda verdict: "")
    monkeypatch.setattr(result, "advice_words", lambda change, verdict: ())
    found = result.result_of(verdict(judged=[], ran=[], broken=(), word="passes"), None, (), {})
    assert found.findings == () and found.notes == ("the mooring passes",) and len(found["criterion.limit"]) == 0


@pytest.mark.parametrize("asked", [True, False])
def test_parts_of_a_design_are_made_from_each_other(monkeypatch, tmp_path, asked):
    place, calls = "hakobune.pipelines.design", {}
    cases = [SimpleNamespace(case=SimpleNamespace(name=name)) for name in ("a", "b")]
    judged = SimpleNamespace(judged="judged", ran=cases, word="passes")

    def answer(name, value):
        return lambda *given: calls.__setitem__(name, given) or value

    for where, name, value in (
        ("running", "databases", "paths"), ("running", "run_cases", "ran"), ("running", "of_databases", "of paths"),
        ("verdict", "judged_project", judged), ("verdict", "project_quantities", "others"),
        ("advice", "advise", "advice"), ("advice", "after_lines_move", "moved"), ("report", "write_report", "names"),
    ):  # fmt: skip
        monkeypatch.setattr(f"{place}.{where}.{name}", answer(name, value))
    folder = tmp_path / "a" / "b"
    found = result.made("read", folder, "workers", None, asked)
    step = calls["run_cases"][-1]
    assert folder.is_dir() and (folder / "log.txt").exists() and callable(step)
    assert found == (judged, "names", "moved" if asked else None)
    assert calls["databases"] == ("read", folder, "workers", None)
    assert calls["run_cases"] == ("read", "paths", folder, "workers", step)
    assert calls["of_databases"] == ("read", "paths") and calls["judged_project"] == ("read", "ran", "of paths")
    assert calls["write_report"] == ("read", judged, "moved" if asked else None, "paths", folder)
    assert ("advise" in calls) is asked
    if asked:
        named = {one.case.name: one.case for one in cases}
        assert calls["advise"] == ("read", "judged", named, "others", "paths", folder / "advice", step)
        assert calls["after_lines_move"] == ("advice", cases)


def test_a_folder_is_looked_at_before_anything_is_made_and_workers_are_let_go(monkeypatch, tmp_path):
    said = []
    workers = SimpleNamespace(shutdown=lambda **words: said.append(words))
    read = SimpleNamespace(name="p.toml", study={"simulation": {"ramp": 9.0}}, raw={"simulation": {}})
    monkeypatch.setattr(result, "read_project", lambda project: read if project == read.name else None)
    monkeypatch.setattr(result, "executor_of", lambda name: workers)
    monkeypatch.setattr(result, "made", lambda *given: said.append(given) or ("verdict", "names", "change"))
    monkeypatch.setattr(result, "result_of", lambda *given: given)
    monkeypatch.setattr(result, "provenance", lambda **words: words)
    found = result.design("p.toml", tmp_path / "out", advice=False)
    made, ended = said
    assert made == (read, tmp_path / "out", workers, None, False)
    assert ended == {"wait": False, "cancel_futures": True}
    assert found[:4] == ("verdict", "change", "names", {"project": "p.toml", "folder": str(tmp_path / "out")})
    assert [line.split(";")[0] for line in found[4]] == ["left out: ramp = 9.0 in the study's [simulation]"]
    (tmp_path / "file").write_text("")
    with pytest.raises(ValueError, match="file"):
        result.design("p.toml", tmp_path / "file")
    assert len(said) == 2


@pytest.mark.parametrize(("study", "project", "told"), [
    ({}, {"simulation": {"seeds": 2}}, ""), ({"simulation": {"damping_ratio": {"roll": 0.03}}}, {}, ""),
    ({"simulation": {"duration": 600.0, "seeds": 5}}, {"simulation": {"duration_hours": 1.0}}, ""),
    ({"simulation": {"damping_ratio": {"roll": 0.03}}}, {"simulation": {"damping_ratio": {"roll": 0.05}}}, ""),
    ({"simulation": {"damping_ratio": {"roll": 0.03}, "seeds": 5}}, {"simulation": {"seeds": 2}},
     "left out: damping_ratio = {'roll': 0.03} in the study's [simulation]; a project reads only its own"),
])  # fmt: skip
def test_what_a_study_gives_its_simulation_and_the_project_does_not_is_told(study, project, told):
    said = list(result.unread_simulation(study, project))
    assert len(said) == bool(told) and all(line.startswith(told) for line in said)
