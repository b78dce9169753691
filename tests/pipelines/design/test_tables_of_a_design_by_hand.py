"""Rows of the tables of a design, where a number is found again, and the cases of breakwaters and earthquakes."""

from collections import namedtuple
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria import verdict as of
from hakobune.pipelines.design import project, report_tables, running, verdict
from hakobune.pipelines.design.cases import LoadCase
from hakobune.pipelines.design.fatigue import QUANTITY as FATIGUE
from hakobune.pipelines.design.kinds import breakwater, earthquake, in_time
from hakobune.pipelines.design.kinds.needs import ANCHOR, COEFFICIENT, DOLPHIN, OF_ALLOWABLE, SCOPE, TOTAL

CASE = LoadCase("storm, 30 deg", "storm", "abnormal", "high", 30.0, 0.0, 0.0, "line 3", 1.5, {}, apart=False)


def numbers(**more):
    """Two lines, of which the second pulls less and carries more of its strength"""
    own = {
        "names": ("a", "b"), "place": np.array([3.0, 4.0, np.pi / 6]), "motions": np.array([0.6, 0.8, 9.0, 0, 0, 0]),
        "breaking": np.array([10e6, 4e6]), "largest": np.array([5e6, 3e6]), "horizontal": np.array([2e6, 1e6]),
        "uplift": np.array([-1e5, 3e5]), "parts": {}, "bodies": (),
    }  # fmt: skip
    made = namedtuple("Numbers", own)
    return made(**own | more)


def test_a_row_of_a_case_has_the_worst_line_and_the_largest_pulls_at_anchors():
    row = dict(zip(report_tables.CASE_HEAD, report_tables.case_row(running.Ran(CASE, None, numbers())), strict=True))
    wanted = {
        "case": "storm, 30 deg", "state": "storm", "level": "high", "incidence_deg": 30.0, "lost": "line 3",
        "motion_factor": 1.5, "x_m": 3.0, "y_m": 4.0, "yaw_deg": pytest.approx(30.0),
        "excursion_m": pytest.approx(5.0 + 1.0), "largest_tension_N": 3e6, "line": "b", "of_breaking_load": 0.75,
        "horizontal_at_anchor_N": 2e6, "uplift_at_anchor_N": 3e5, "fault": "",
    }  # fmt: skip
    assert row == wanted
    two = {"place": np.array([[0.0, 1.0, 0.0], [-3.0, 4.0, 0.1]]), "motions": np.zeros(12), "bodies": ("ship", "barge")}
    two["motions"][:2] = 9.0, 12.0
    row = report_tables.case_row(running.Ran(CASE, None, numbers(**two)))
    assert row[6:10] == pytest.approx((-3.0, 4.0, np.degrees(0.1), 1.0 + 15.0))  # of the barge; the ship moves farthest
    assert report_tables.farthest(numbers(**two))[0] == "barge"
    free = numbers(breaking=np.array([np.inf, np.inf]))
    row = dict(zip(report_tables.CASE_HEAD, report_tables.case_row(running.Ran(CASE, None, free)), strict=True))
    assert row["line"] == "a" and np.isnan(row["of_breaking_load"])


def test_a_case_without_lines_or_numbers_has_empty_cells():
    none = numbers(names=(), motions=np.zeros(0))
    row = report_tables.case_row(running.Ran(CASE, None, none))
    assert row[6:] == (3.0, 4.0, pytest.approx(30.0), 5.0, "", "", "", "", "", "")
    assert report_tables.case_row(running.Ran(CASE, None, None, None, "no equilibrium"))[6:] == ("",) * 9 + (
        "no equilibrium",
    )
    whole = CASE._replace(lost="")
    in_time = running.Ran(whole, None, none, {"excursion": 7.5})
    assert running.excursion(in_time) == 7.5
    runs = {"excursion": 7.5, "at_rest": 10.0}  # the lines that are left pull the body to another rest
    assert running.excursion(running.Ran(CASE._replace(lost="bow"), None, none, runs)) == 17.5
    assert running.excursion(running.Ran(whole, None, none, runs)) == 7.5
    assert running.excursion(running.Ran(CASE, None, none, {"largest": {}})) == 5.0  # runs of fixed bodies
    assert running.excursion(running.Ran(CASE, None, numbers(), {"largest": {}})) == pytest.approx(6.0)


@pytest.mark.parametrize(
    ("quantity", "kind", "file", "key"),
    [
        ("service life", {}, None, "project.service_life"),
        ("return period", {}, None, "project.service_life, project.probability"),
        ("gust factor", {}, None, "values"),
        ("surge", {"apart": True}, "c.h5", "values.parts.surge"),
        (of.PRETENSION, {"moved": False}, "c_numbers.json", "values.pretension"),
        (of.HOLDING, {"moved": False}, "c_numbers.json", "values.horizontal"),
        ("tension / breaking load", {"moved": False}, "c_numbers.json", "values.largest"),
        ("stable headings", {"moved": False}, "c_numbers.json", "values.parts.stable headings"),
        (of.PRETENSION, {}, "c.h5", "tension.at_rest"),
        (of.HOLDING, {}, "c.h5", "anchor.largest_horizontal"),
        ("tension / breaking load", {}, "c.h5", "tension.largest"),
        (SCOPE, {}, "c.h5", "line.length"),
        ("surge", {}, "c.h5", "motion.amplitude"),
        (of.PRETENSION, {"runs": {}}, "c.h5", "tension.at_rest"),
        (SCOPE, {"runs": {}}, "c.h5", "line.length"),
        (of.PRETENSION, {"runs": {}, "at_berth": True}, "c_runs_numbers.json", "values.pretension"),
        (SCOPE, {"runs": {}, "at_berth": True}, "c_runs_numbers.json", "values.length"),
        ("fender energy", {"runs": {}, "parts": {"fender energy": {}}}, "c_runs_numbers.json",
         "values.parts.fender energy"),
        (FATIGUE, {"runs": {}}, "c_runs_extremes.json", "values.cycles"),
        ("tension / breaking load", {"runs": {}}, "c_runs_extremes.json", "values.largest"),
        ("surge", {"runs": {}}, "c_runs_extremes.json", "values.motions"),
        ("surge", {"runs": {}, "statistic": "peak to peak"}, "c_runs_extremes.json", "values.ranges"),
        (ANCHOR, {"runs": {}}, "c_runs_extremes.json", "values.horizontal, uplift"),
        (ANCHOR, {}, "c.h5", "anchor"),
    ],
)  # fmt: skip
def test_the_file_and_the_key_of_a_number_are_those_that_have_it(tmp_path, quantity, kind, file, key):
    if kind.get("at_berth"):
        (tmp_path / "c_runs_numbers.json").write_text("{}")
    read = SimpleNamespace(
        project=SimpleNamespace(values=[SimpleNamespace(quantity="gust factor")]),
        kind=SimpleNamespace(MOVED=kind.get("moved", True)),
    )
    ran = SimpleNamespace(
        path=tmp_path / "c.h5", case=SimpleNamespace(apart=kind.get("apart", False)), runs=kind.get("runs"),
        numbers=SimpleNamespace(parts=kind.get("parts", {})),
    )  # fmt: skip
    where, found = report_tables.origin(
        read, ran, SimpleNamespace(quantity=quantity, statistic=kind.get("statistic", ""))
    )
    assert (where and Path(where).name, found) == (file, key)


def test_a_line_that_wears_has_the_strength_of_its_weakest_type(monkeypatch):
    """A ring that loses a tenth of its diameter keeps 0.81 of its load; what does not wear keeps all"""
    monkeypatch.setattr(running, "worn_diameters", lambda project, study: {"chain": (0.1, 0.01), "link": (0.1, 0.02)})
    lines = SimpleNamespace(breaking=np.array([10.0, 20.0, 30.0]), types=(("chain",), ("chain", "link"), ("rope",)))
    monkeypatch.setattr(running, "worn_breaking_load", lambda load, d, loss, factor: load * (1 - loss / d) ** 2)
    read = SimpleNamespace(project=None, study=None)
    assert running._worn_loads(read, lines) == pytest.approx([8.1, 20 * 0.64, 30.0])
    monkeypatch.setattr(running, "worn_diameters", lambda project, study: {})
    assert running._worn_loads(read, lines) is None


# ------------------------------------------------------------------ breakwater


def test_the_regular_waves_of_a_breakwater_are_as_high_as_the_highest_of_its_sea():
    """1800 waves of 6 s in three hours: H √(½ ln 1800)"""
    raw = {"section": {"beam": 4.0}, "waves": {"periods": [4.0, 8.0]}, "sea": {"height": 9.0, "duration_hours": 3.0},
           "map": {}}  # fmt: skip
    base = breakwater.base(raw, None)
    assert base == {"section": {"beam": 4.0}, "periods": [4.0, 8.0], "duration_hours": 3.0}
    assert breakwater.base({"waves": {"periods": [5.0]}}, None)["duration_hours"] == 3.0
    study = breakwater.at(base, 10.0, {"waves": {"height": 2.0, "period": 6.0, "incidence_deg": 30.0}})
    assert study == {
        "section": {"beam": 4.0},
        "sea": {"spectrum": "issc", "height": 2.0, "mean_period": 6.0, "obliquity_deg": 30.0, "duration_hours": 3.0},
        "waves": {"height": pytest.approx(2.0 * np.sqrt(0.5 * np.log(1800))), "periods": [4.0, 8.0],
                  "obliquity_deg": 30.0},
    }  # fmt: skip
    short = breakwater.at(base | {"duration_hours": 1e-4}, 10.0, {"waves": {"height": 2.0, "period": 6.0,
                                                                            "incidence_deg": 0.0}})  # fmt: skip
    assert short["waves"]["height"] == pytest.approx(2.0 * np.sqrt(0.5 * np.log(2)))  # two waves at least


def test_numbers_of_a_breakwater_are_of_lines_and_not_per_metre(monkeypatch):
    """A line each 4 m, 30° above level; the front one snaps at 25 kN/m"""
    monkeypatch.setattr("hakobune.pipelines.breakwater.findings.failures", lambda none, found: ("told",))
    lines = SimpleNamespace(spacing=4.0, allowable=200.0, attachment=5.0, attachment_height=1.0)
    asked = SimpleNamespace(design=("fixed", "linear"), lines=lines, angle=np.pi / 6, line=20.0,
                            section=SimpleNamespace(draft=3.0))  # fmt: skip
    heights = {"free": 1.5, "fixed, linear": 0.5}
    sea = SimpleNamespace(heights=heights, cells=SimpleNamespace(height=2.0), tension=np.array([10.0, 20.0]),
                          slack=np.array([0.1, 0.2]))  # fmt: skip
    anchors = [SimpleNamespace(name="block", utilisation=0.7), SimpleNamespace(name="pile", utilisation=None)]
    snapping = SimpleNamespace(found=SimpleNamespace(largest=(25.0, 3.0)))
    found = SimpleNamespace(pretension=SimpleNamespace(used=7.0), sea=sea, anchors=anchors, snapping=snapping,
                            warned=("warm",))  # fmt: skip
    made = breakwater._numbers(asked, found)
    assert made.parts == {
        breakwater.BEHIND: {"fixed, linear": 0.5}, breakwater.SHARE: {"fixed, linear": 0.25},
        breakwater.ANCHOR: {"block": 0.7}, breakwater.SLACK: {"front": 0.1, "back": 0.2},
        breakwater.ALLOWABLE: {"front": 0.5, "back": 0.4},
    }  # fmt: skip
    assert made.largest == pytest.approx([100.0, 80.0]) and made.static == pytest.approx([28.0, 28.0])
    assert made.horizontal == pytest.approx(np.array([100, 80]) * np.sqrt(0.75))
    assert made.uplift == pytest.approx([50.0, 40.0]) and made.length.tolist() == [20.0, 20.0]
    y = 5 + 20 * np.sqrt(0.75)
    assert made.fairlead == pytest.approx(np.array([[0, -5, -2], [0, 5, -2]]))
    assert made.anchor == pytest.approx(np.array([[0, -y, -12], [0, y, -12]])) and made.warnings == ("warm", "told")


def test_an_earthquake_has_strains_shares_of_what_is_allowed_and_of_what_dolphins_yield_at(monkeypatch):
    """Fenders of 2 m, allowed half of it; dolphins yield at 400 kN, three of them bear 1000 kN"""
    fenders = SimpleNamespace(fender=SimpleNamespace(own=lambda deflection: 0.6 * deflection), count=3)
    quake = SimpleNamespace(fenders=fenders, coefficient=0.2)
    rows = [SimpleNamespace(name="coefficient", reason="", deflection=0.5, reaction=1000.0),
            SimpleNamespace(name="record", reason="", deflection=1.0, reaction=0.0)]  # fmt: skip
    monkeypatch.setattr(earthquake, "quake_of", lambda study, folder, database=None: quake)
    monkeypatch.setattr(earthquake, "fender_of", lambda table: SimpleNamespace(height=2.0, allowable=0.5))
    monkeypatch.setattr(earthquake, "dolphin_of", lambda table, others: (1.0, 400.0))
    monkeypatch.setattr(earthquake, "_alone", lambda table: table)
    monkeypatch.setattr("hakobune.mooring.dolphins.methods.methods", lambda quake: (rows, None))
    monkeypatch.setattr("hakobune.mooring.dolphins.methods.failures", lambda quake, rows: ["told"])
    made = earthquake._found(SimpleNamespace(fender=None), None, None)
    assert {quantity: pytest.approx(values) for quantity, values in made.parts.items()} == {
        TOTAL: {"coefficient": 0.15, "record": 0.3}, OF_ALLOWABLE: {"coefficient": 0.3, "record": 0.6},
        DOLPHIN: {"coefficient": 1.2}, COEFFICIENT: {"of the rule": 0.2},
    }  # fmt: skip
    assert made.warnings == ("told",)
    rows[1].reason = "it yields"
    with pytest.raises(ValueError, match="record: it yields"):
        earthquake._found(SimpleNamespace(fender=None), None, None)


# ------------------------------------------------------------------ rule sets

Rule = namedtuple("Rule", "rule subject quantity status name")


def test_rule_sets_stand_side_by_side_by_what_they_use(monkeypatch):
    """Of what the study has, and of motions those of the project alone"""
    steel = Rule("A", "chain", "tension", "read", "A 1990")
    more = Rule("A", "chain", "uplift", "quoted", "A 1990")
    rope = Rule("B", "synthetic", "tension", "read", "B 2000")
    ship = Rule("C", "tanker", "surge", "read", "C 2010")
    port = Rule("D", "tanker", "sway", "read", "D 2020")
    unknown = Rule("E", "chain", "nothing", "read", "E 1970")
    uses = {steel: 0.6, more: 0.8, rope: 0.9, ship: 2.0, port: 1.2, unknown: None}

    def judge(criteria, cases):
        return [
            SimpleNamespace(criterion=one, governing=uses[one] and SimpleNamespace(utilisation=uses[one]))
            for one in criteria
        ]

    monkeypatch.setattr(verdict, "read_rules", lambda: [steel, more, rope, ship, unknown])
    monkeypatch.setattr(verdict, "judge", judge)
    read = SimpleNamespace(criteria=[port], study={"types": {"x": {"catalogue": "R3 studless 80 mm"}}})
    found = verdict.side_by_side(read, [])
    assert [(one.name, one.chosen, one.judged, one.known, one.criterion, one.unread) for one in found] == [
        ("D 2020", True, 1, 1, port, 0),
        ("A 1990", False, 2, 2, more, 1),
    ]
    assert found[1].use.utilisation == 0.8


@pytest.mark.parametrize(
    ("study", "has"),
    [
        ({"types": {"x": {"catalogue": "R3 studless 80 mm"}}}, {"multi-point", "chain"}),
        ({"types": {"x": {"catalogue": "wire 6x36 40 mm"}}, "attachment": {}}, {"single-point", "wire"}),
        ({"types": {"x": {"catalogue": "nylon 80 mm"}}, "hawser": {"a": 1}}, {"multi-point", "synthetic", "hawser"}),
        ({"rope": [{}], "fender": [{}]}, {"multi-point", "wire", "synthetic", "fender", "dolphin"}),
        ({"types": {"x": {}}}, {"multi-point", "chain", "wire", "synthetic"}),
    ],
)
def test_a_study_has_the_things_of_its_tables(study, has):
    assert {word for word, there in verdict._things(study).items() if there} == has


# ------------------------------------------------------------------ weather of a site, runs in time


def test_states_have_the_weather_of_their_site_and_the_project_its_life_where_it_gives_none(monkeypatch):
    values = SimpleNamespace(
        states={"storm": {"waves": {"height": 4.0}, "wind": {"speed": 30.0}}}, levels={"high": 2.0, "low": -1.0},
        site={"service_life": 50.0, "probability": 0.3, "name": "port"},
    )  # fmt: skip
    monkeypatch.setattr(project, "site_file", lambda path: values)
    raw = {"project": {"site": "port.json", "name": "berth"}, "levels": {"spring": 3.0}, "states": [
        {"name": "a", "weather": "storm", "waves": {"incidence_deg": 30.0}, "levels": ["high", "mean"]},
        {"name": "b", "waves": {"height": 1.0}},
    ]}  # fmt: skip
    made = project._at_site(raw, Path())
    assert made["project"] == {"site": "port.json", "name": "berth", "service_life": 50.0, "probability": 0.3}
    assert made["levels"] == {"high": 2.0, "spring": 3.0}
    assert made["states"][0]["waves"] == {"height": 4.0, "incidence_deg": 30.0}
    assert made["states"][0]["wind"] == {"speed": 30.0} and made["states"][1] == raw["states"][1]
    raw["project"]["service_life"] = 25.0
    assert "probability" not in project._at_site(raw, Path())["project"]
    with pytest.raises(ValueError, match=r"project\.site is missing;"):
        project._at_site(raw | {"project": {}}, Path())
    raw["states"][0]["waves"]["height"] = 3.0
    with pytest.raises(ValueError, match=r"states\[0\]\.waves\.height is given by the study and by its site"):
        project._at_site(raw, Path())


def test_tensions_at_a_multiple_of_the_motions_grow_as_statics_says_and_never_below_what_was_simulated(monkeypatch):
    """Simulated 30 and 10 kN where statics has 20 and 40: times 1.5 and 1 of statics at the multiple"""
    statics = {1.0: [[20.0, 40.0], [16.0, 32.0], [2.0, 4.0]], 1.5: [[30.0, 8.0], 0, 0], 0.5: [[10.0, 8.0], 0, 0]}
    moved = []

    def held(study, database, motion, tension, factor):
        moved.append(factor)
        return [np.array(one) for one in statics[factor]]

    class File(dict):
        pass

    where = "hakobune.pipelines.simulate."
    rows = {"tension a": {"mean": 12.0, "largest": 30.0}, "tension b": {"mean": 5.0, "largest": 10.0}}
    file = File(
        line=SimpleNamespace(asstr=lambda: {(): ["a", "b"]}), motion={(): np.zeros((1, 3, 6))},
        tension={(): np.ones((1, 3, 2))}, time=np.array([0.0, 0.5, 1.0]),
    )  # fmt: skip
    file.attrs = {"breaking_load": [100.0, 200.0]}
    monkeypatch.setattr(in_time, "_run", lambda *_: SimpleNamespace(interrupted=False, failures=[]))
    monkeypatch.setattr(in_time, "_moved", held)
    monkeypatch.setattr(f"{where}over_runs.excursion_in_runs", lambda file: 7.0)
    monkeypatch.setattr(in_time, "_away_at_rest", lambda file: 2.5)
    monkeypatch.setattr(in_time, "_largest_motions", lambda file: np.arange(6.0))
    monkeypatch.setattr(in_time, "_largest_ranges", lambda file: np.arange(6.0))
    monkeypatch.setattr(in_time, "_between", lambda file: {"gap between hulls": {"a b": 1.5}})
    monkeypatch.setattr(f"{where}file.opened", lambda path: nullcontext(file))
    monkeypatch.setattr(f"{where}file.summary_of", lambda file, name: rows[name])
    monkeypatch.setattr(f"{where}file.told", lambda file: ["told", "twice"])
    monkeypatch.setattr(f"{where}file.stored_findings", lambda file: ["twice"])
    monkeypatch.setattr(f"{where}over_runs.overloads", lambda file, allowable: [f"over {allowable:g}"])
    monkeypatch.setattr(f"{where}over_runs.rare_findings", lambda file: ["rare"])
    monkeypatch.setattr(f"{where}over_runs.used_in_runs", lambda file: np.array([[0.3, 0.05]]))
    found = in_time._simulated(None, None, None, [1.0, 1.5, 0.5])
    assert moved == [1.0, 1.5, 0.5] and found["mean"].tolist() == [12.0, 5.0] and found["excursion"] == 7.0
    assert found["at_rest"] == 2.5
    assert found["largest"][1.0].tolist() == [30.0, 10.0] and found["largest"][1.5].tolist() == [45.0, 10.0]
    assert found["largest"][0.5].tolist() == [15.0, 8.0]
    assert found["horizontal"].tolist() == [24.0, 32.0] and found["uplift"].tolist() == [3.0, 4.0]
    assert found["parts"] == {"gap between hulls": {"a b": 1.5}}
    assert found["findings"] == ("told", "twice", "over 1", "rare") and found["cycles"][0][0] == 1.0
    monkeypatch.setattr(in_time, "_run", lambda *_: SimpleNamespace(interrupted=False, failures=[(3, "it capsizes")]))
    with pytest.raises(ValueError, match="seed 3: it capsizes"):
        in_time._simulated(None, None, None, [1.0])


@pytest.mark.parametrize("names, away", [((), 5.0), (("ship", "barge"), 13.0)])
def test_the_place_at_rest_is_that_of_the_body_farthest_from_its_place(names, away, monkeypatch):
    """Shapes of bodies that bend come after the motions of all bodies, and are no places"""
    monkeypatch.setattr("hakobune.pipelines.simulate.file.bodies_of", lambda file: names)
    rest = np.zeros(14)
    rest[[0, 1, 6, 7, 12, 13]] = 3.0, -4.0, 5.0, 12.0, 100.0, 100.0
    file = SimpleNamespace(attrs={"place_at_rest": rest})
    assert in_time._away_at_rest(file) == pytest.approx(away)
