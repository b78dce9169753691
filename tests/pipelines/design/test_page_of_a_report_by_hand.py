"""The page of a report: every part in its place, addresses from its folder, bodies in the units of the field."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import database
from hakobune.bem.bodies import one_of_several
from hakobune.pipelines.design import report
from hakobune.pipelines.moor import study as moored
from hakobune.pipelines.solve import report as checks

WORDS = ("issue", "summary", "advice_words", "return_words", "time_words", "state_row", "line_rows", "criterion",
         "case", "rule_set", "motion_rows", "mooring_words", "band", "part_table")  # fmt: skip


class Asked:
    """Stand-in of the words of a report: each function gives its name and what it was given"""

    def __init__(self, **own):
        self.__dict__ |= own | {"MARK": {True: "yes", False: "no", None: "none"}}

    def __getattr__(self, name):
        assert name in WORDS
        return lambda *given: [name, *given]


@pytest.fixture
def page(monkeypatch):
    own = SimpleNamespace(name="quay 3", note="draft", other_rules=True)
    project = SimpleNamespace(project=own, states=["calm", "storm"])
    kind = SimpleNamespace(words=lambda project, study: ("door", "sources", ("method", study)))
    read = SimpleNamespace(project=project, study="study", text="project text", study_text="study text", kind=kind)
    ran = [SimpleNamespace(case=SimpleNamespace(name=name), path=Path(f"/p/cases/{name}.toml"),
                           numbers=numbers) for name, numbers in (("a", "numbers"), ("b", None))]  # fmt: skip
    verdict = SimpleNamespace(ran=ran, word="holds", judged=["one", "two"], rule_sets=["rules"])
    points = [SimpleNamespace(text=f"point {met}", met=met, how=f"how {met}") for met in (True, False, None)]

    def noted(name):
        return lambda *given: iter([(name, *given)])

    told = [{"text": "t", "aside": False}, {"text": "u", "aside": True}]
    words = Asked(
        warnings=lambda given: told if given is verdict else None,
        part_table=lambda *given: ("head", "rows") if given == (read, verdict) else None,
    )
    monkeypatch.setattr(report, "words", words)
    monkeypatch.setattr(report, "CSS", {"holds": "good"})
    monkeypatch.setattr(report, "WORDS", {True: "met", False: "not met"})
    monkeypatch.setattr(report, "checklist", lambda read, ran: points)
    monkeypatch.setattr(report, "versions", lambda: {"hakobune": "1.0", "numpy": "2.4"})
    monkeypatch.setattr(report, "_found_in", lambda *given: ("found in", *given))
    monkeypatch.setattr(report, "_of_body", lambda *given: {"body": ("body", *given)})
    monkeypatch.setattr(report, "_scene_text", lambda read: "scene text")
    monkeypatch.setattr(report, "use_picture", lambda *given: ("use", *given))
    for name in ("_levels", "plans", "records"):
        monkeypatch.setattr(report, name, noted(name))
    return read, verdict, own


def test_every_part_of_a_page_is_made_of_what_it_tells(page):
    read, verdict, own = page
    found = report._context(read, verdict, "advice", "paths", "/p/out")
    links = {"a": "../cases/a.toml", "b": "../cases/b.toml"}
    first, second = verdict.ran
    assert found == {
        "name": "quay 3", "note": "draft", "issue": ["issue", own], "word": "holds", "word_class": "good",
        "summary": ["summary", verdict], "advice": ["advice_words", "advice", verdict],
        "levels": [("_levels", read, "paths", "/p/out")], "return_period": ["return_words", own, verdict],
        "in_time": ["time_words", read], "not_run": 1, "mooring": ["mooring_words", read],
        "states": [["state_row", "calm"], ["state_row", "storm"]],
        "body": ("body", read, "paths", "/p/out"), "lines": ["line_rows", read, verdict],
        "criteria": [["criterion", one, ("found in", read, verdict, "/p/out")] for one in ("one", "two")],
        "cases": [["case", first, links], ["case", second, links]], "rule_sets": [["rule_set", "rules"]],
        "checklist": [
            ("point True", "met", "yes", "how True"), ("point False", "not met", "no", "how False"),
            ("point None", "does not apply", "none", "how None"),
        ],
        "part_head": "head", "parts": "rows", "plans": [("plans", read, verdict, "paths", "/p/out")],
        "records": [("records", verdict, "/p/out")], "motions": ["motion_rows", verdict],
        "use_picture": ("use", verdict, "/p/out"), "warnings": [{"text": "t", "aside": False}],
        "aside": [{"text": "u", "aside": True}], "band": ["band", verdict], "door": "door",
        "sources": "sources", "method": ("method", "study"),
        "inputs": {"project": "project text", "study": "study text", "scene": "scene text"},
        "versions": "hakobune 1.0, numpy 2.4",
    }  # fmt: skip
    own.other_rules = False
    assert report._context(read, verdict, "advice", "paths", "/p/out")["rule_sets"] == []


def test_levels_have_their_depth_and_the_address_of_their_database():
    read = SimpleNamespace(
        study={"water": {"depth": 20.0}}, project=SimpleNamespace(level=lambda name: len(name) - 1.5)
    )
    found = list(report._levels(read, {"mean": None, "high": "/p/bases/high.h5"}, "/p/out"))
    assert found == [{"name": "mean", "depth": "22.5", "link": ""},
                     {"name": "high", "depth": "22.5", "link": "../bases/high.h5"}]  # fmt: skip


def test_the_scene_of_a_project_lies_beside_it(tmp_path):
    (tmp_path / "s.toml").write_text("depth = 5 # æ", encoding="utf-8")
    read = SimpleNamespace(folder=tmp_path, project=SimpleNamespace(project=SimpleNamespace(scene="s.toml")))
    assert report._scene_text(read) == "depth = 5 # æ"
    read.project.project.scene = None
    assert report._scene_text(read) == ""


@pytest.mark.parametrize("text, escaped", [
    ("Quay 3, draft-2.", "Quay 3, draft-2."), ('a"b', "a\\22 b"), ("</style>", "\\3c \\2f style\\3e "),
    ("é\n", "é\\a "), ("a_b", "a\\5f b"),
])  # fmt: skip
def test_a_title_ends_neither_quotes_nor_rules_nor_elements(text, escaped):
    assert report._css_text(text) == escaped


@pytest.mark.parametrize("value, told", [
    (0.4, "0.4"), (99.64, "99.6"), (1234.4, "1 234"), (123456.0, "123 500"), (4100000.0, "4 100 000"), (45.67, "45.7"),
])  # fmt: skip
def test_tonnes_have_four_digits_with_thousands_apart(value, told):
    assert report._whole(value) == told


def one(mass=1000.0, center=(0.5, -0.25, -2.0)):
    return SimpleNamespace(displaced_volume=mass, center_of_mass=np.array(center))


def test_a_body_is_told_with_its_sizes_displacement_and_centre_of_gravity(monkeypatch):
    """1025 kg/m³ of 1000 m³ are 1025 t; periods 2π/ω"""
    base = SimpleNamespace(
        bodies=(), dimensions={"length": 50.0, "radius": 2.5}, density=1025.0, omega=2 * np.pi / np.array([20, 10, 4]),
        mesh=SimpleNamespace(total=480), wave_direction=np.zeros(3), **vars(one()),
    )  # fmt: skip
    end = "displacement 1 025 t, centre of gravity 0.5, -0.25, -2 m (z up from the water)"
    grid = "480 panels; 3 periods from 4 to 20 s, 3 headings."
    assert report._body_words(base) == f"length 50 m, radius 2.5 m; {end}. {grid}"
    base.dimensions = {}
    assert report._body_words(base) == f"A body from a mesh file; {end}. {grid}"
    base.bodies = [SimpleNamespace(name="ship"), SimpleNamespace(name="barge")]
    monkeypatch.setattr(one_of_several, "each_body", lambda db: [one(), one(2000.0, (1.0, 2.0, 3.0))])
    monkeypatch.setattr(moored, "box_of", lambda db, body: {"length": 10.0 * len(body.name)})
    other = "displacement 2 050 t, centre of gravity 1, 2, 3 m (z up from the water)"
    assert report._body_words(base) == f"ship: length 40 m; {end}. barge: length 50 m; {other}. {grid}"


def test_checks_that_do_not_hold_are_told_with_their_level_and_those_that_hold_together(monkeypatch):
    def check(name, passed):
        return SimpleNamespace(name=name, passed=passed, largest=0.0234, omega=0.7654, limit=0.01)

    found = {"a": [check("energy", True)], "b": [check("energy", False), check("Haskind relation", False)]}
    monkeypatch.setattr(database, "open_database", lambda path: path)
    monkeypatch.setattr(checks, "checked", lambda path: found[path])
    text = "reciprocity, Haskind relation, energy, residual, estimated errors, each against its stored limit."
    assert list(report._checks({"mean": "a"})) == [{"css": "source", "text": f"Checked, and passed: {text}"}]
    end = "is 0.023 at ω 0.765 rad/s; limit 0.01"
    assert list(report._checks({"mean": "a", "high": "b"})) == [
        {"css": "fails", "text": f"high: energy {end}"}, {"css": "fails", "text": f"high: Haskind relation {end}"},
        {"css": "source", "text": f"Checked besides: {text}"},
    ]  # fmt: skip


def test_equipment_is_that_of_the_box_and_displacement_of_one_hull(monkeypatch):
    asked = []
    monkeypatch.setattr(report, "equipment_of_box", lambda *given: asked.append(given) or [("rules", 123.4)])
    base = SimpleNamespace(bodies=(), dimensions="sizes", density=1025.0,
                           mesh=SimpleNamespace(whole=lambda: SimpleNamespace(volume=100.0)))  # fmt: skip
    read = SimpleNamespace(study={"hull": {"freeboard": 3.0}})
    assert report._equipment(read, base) == [("rules", 123.4)]
    report._equipment(SimpleNamespace(study={}), base)
    assert asked == [("sizes", 3.0, 102500.0), ("sizes", None, 102500.0)]
    base.bodies = ("ship", "barge")
    assert report._equipment(read, base) == ()


def test_a_study_without_a_database_tells_of_itself_and_one_with_a_database_of_its_body(monkeypatch):
    read = SimpleNamespace(study="study", kind=SimpleNamespace(body=lambda study: f"body of {study}"))
    assert report._of_body(read, {report.MEAN: None}, "f") == {
        "body": "body of study", "checks": [], "equipment": [], "body_pictures": [],
    }  # fmt: skip
    monkeypatch.setattr(database, "open_database", lambda path: f"open {path}")
    monkeypatch.setattr(report, "_body_words", lambda db: f"words of {db}")
    monkeypatch.setattr(report, "_checks", lambda paths: iter(["checked", *paths]))
    monkeypatch.setattr(report, "_equipment", lambda read, db: [("rules", 123.5), (db, 2.0)])
    monkeypatch.setattr(report, "body_pictures", lambda *given: given)
    assert report._of_body(read, {report.MEAN: "b.h5"}, "f") == {
        "body": "words of open b.h5", "checks": ["checked", report.MEAN],
        "equipment": [("rules", "124"), ("open b.h5", "2")], "body_pictures": ("b.h5", "f"),
    }  # fmt: skip
