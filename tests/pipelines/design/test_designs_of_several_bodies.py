"""A ship and a barge made fast to each other as a project: verdicts, page, tables, and what it may not have."""

import csv
import tomllib
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.bem.database import open_database
from hakobune.mooring.criteria.rules import OWN, Criterion
from hakobune.mooring.criteria.verdict import Case, judge
from hakobune.mooring.studies.conditions import Afloat, ExposedBox
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds import mooring, side_plan
from hakobune.pipelines.design.project import read_project

SHIP = {"name": "ship", "shape": "box", "length": 14.0, "beam": 5.0, "draft": 1.5, "place": [0.0, 3.5, 0.0],
        "gyration": [1.6, 4.0, 4.0]}  # fmt: skip
BARGE = {**SHIP, "name": "barge", "length": 10.0, "place": [1.0, -3.5, 180.0]}
SCENE = {"water": {"depth": 12.0}, "bodies": [SHIP, BARGE], "panels": 60,
         "waves": {"omegas": {"from": 0.8, "to": 2.0, "count": 4}, "headings_deg": [*range(0, 360, 45)]}}  # fmt: skip
CHAIN = {"weight_kg_per_m": 20.0, "axial_stiffness_tonf": 5000.0, "breaking_load_tonf": 40.0}
NYLON = {"elongation_percent": [0.0, 10.0, 30.0], "tension_kN": [0.0, 20.0, 90.0], "breaking_load_tonf": 12.0}
FENDER = {"name": "F", "body": "barge", "to": "ship", "position": [3.0, -4.5, 0.5], "family": "cell", "height": 1.0}
STUDY = {
    "water": {"depth": 12.0}, "hulls": {"ship": {"freeboard": 1.5}, "barge": {"freeboard": 1.5}},
    "types": {"chain": CHAIN, "nylon": NYLON},
    "spreads": [{"body": "ship", "type": "chain", "length": 60.0, "corner_headings_deg": [45], "pretension_tonf": 1.0}],
    "lines": [{"name": "tie", "type": "nylon", "body": "barge", "fairlead": [-4.0, -2.5, 1.0], "to": "ship",
               "bollard": [3.0, -2.5, 1.0], "pretension_tonf": 0.3}],
    "rope": [{"name": "R", "body": "barge", "fairlead": [4.0, -2.5, 1.0], "to": "ship", "bollard": [-1.0, -2.5, 1.0],
              "breaking_load_kN": 100.0, "break_strain": 0.3, "pretension_kN": 3.0}],
    "fender": [FENDER, {**FENDER, "name": "G", "position": [-1.0, -4.5, 0.5]}],
}  # fmt: skip
OWNER = {"source": "the owner"}
PROJECT = {
    "project": {"name": "Two hulls", "study": "study.toml", "scene": "scene.toml"},
    "states": [{"name": "storm", "state": "abnormal", "incidence_deg": [210.0], "lines": ["intact", "one lost"],
                "waves": {"height": 0.3, "period": 5.0, "method": "regular_wave"}}],
    "simulation": {"duration": 15.0, "ramp": 10.0, "memory": "constant", "dynamic_lines": "none",
                   "linear_damping": {"barge sway": 2.0}},
    "limits": [
        {"quantity": "tension / breaking load", "at_most": 0.5, **OWNER},
        {"quantity": "sway", "at_most": 1.0, "unit": "m", "subject": "barge", "lines": "intact", **OWNER},
        {"quantity": "roll", "at_most": 30.0, "statistic": "peak to peak", "lines": "intact", **OWNER},
        {"quantity": "gap between hulls", "at_least": 1.0, "unit": "m", "lines": "intact", **OWNER},
        {"quantity": "fender strain / allowable strain", "at_most": 1.0, **OWNER},
    ],
}  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """With the scene solved, as project.database"""
    folder = tmp_path_factory.mktemp("two")
    written(folder, "scene.toml", SCENE)
    written(folder, "study.toml", STUDY)
    hakobune.solve(SCENE, folder / "two.h5")
    return folder


@pytest.fixture(scope="module")
def done(folder):
    """(Result, folder of its report) of PROJECT, with the database"""
    written(folder, "project.toml", solved())
    return hakobune.design(folder / "project.toml", folder / "out", advice=False), folder / "out"


def solved(**changes):
    return {**PROJECT, "project": {"name": "Two hulls", "study": "study.toml", "database": "two.h5"}, **changes}


def written(folder, name, table):
    (folder / name).write_text(tomli_w.dumps(table), encoding="utf-8")
    return folder / name


def test_motions_gaps_and_fenders_are_those_of_the_runs_of_each_case(done):
    made, out = done
    used = dict(zip(made.labels["criterion"].values, made["criterion.value"], strict=True))
    item = made["criterion.item"].tolist()
    with h5py.File(out / "cases" / "storm_210_deg_runs.h5") as file:
        names, summary = file["quantity"].asstr()[()].tolist(), file["summary"][()]
        kinds = file["summary_statistic"].asstr()[()].tolist()
    row = {name: dict(zip(kinds, values, strict=True)) for name, values in zip(names, summary, strict=True)}

    def amplitude(name):
        return max(row[name]["largest"] - row[name]["mean"], row[name]["mean"] - row[name]["smallest"])

    def whole(name):
        return row[name]["largest"] - row[name]["smallest"]

    values = list(used.values())
    assert values[1] == pytest.approx(amplitude("barge sway"), rel=1e-6) and item[1] == "barge sway"
    assert values[2] == pytest.approx(np.degrees(max(map(whole, ("ship roll", "barge roll")))), rel=1e-6)
    assert values[3] == pytest.approx(row["gap ship barge"]["smallest"], rel=1e-6) and item[3] == "ship barge"
    assert item[4] in "FG" and made.labels["load_case"].values.tolist()[0] == "storm, 210 deg"
    assert "without" in made.labels["load_case"].values[1]


def test_the_page_has_both_hulls_with_their_motions_and_records(done):
    _, out = done
    page = (out / "report.html").read_text(encoding="utf-8")
    hulls = "ship: length 14 m, beam 5 m, draft 1.5 m; displacement 108 t", "barge: length 10 m"
    rows = "storm, 210 deg: ship", "storm, 210 deg: barge"
    for words in (*hulls, *rows, "barge, records", "ship, offsets", "responses and drift of barge"):
        assert words in page, words
    with (out / "parts.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert [row[1:3] for row in rows if row[1] == "gap between hulls"] == 2 * [["gap between hulls", "ship barge"]]


def test_a_case_is_a_study_that_simulate_repeats(done, folder, tmp_path):
    """Laid lines, in coordinates of their bodies, give the tensions of the design again"""
    made, out = done
    case = tomllib.loads((out / "cases" / "storm_210_deg.toml").read_text(encoding="utf-8"))
    again = hakobune.simulate(case, folder / "two.h5", tmp_path / "run.h5")
    largest = made["load_case.largest_tension"][0]
    assert again["tension.largest"].max() == pytest.approx(largest, rel=1e-9)
    fore, tie = case["lines"][0], case["lines"][-1]
    assert (
        fore["name"] == "ship fore port 1" and fore["body"] == "ship" and fore["fairlead"] == pytest.approx([7, 2.5, 0])
    )
    assert (
        tie["to"] == "ship" and tie["bollard"] == [3.0, -2.5, 1.0] and tie["fairlead"] == pytest.approx([-4, -2.5, 1])
    )


def test_hinges_are_judged_by_what_they_hold(folder):
    """By the simplified method: largest force along an axis of the hinge, as `moor` of the same case"""
    hinge = {"name": "H", "bodies": ["ship", "barge"], "position": [0.0, -3.5, 1.0], "axis": [1.0, 0.0, 0.0]}
    study = {key: value for key, value in STUDY.items() if key not in ("lines", "rope", "fender")} | {"hinges": [hinge]}
    written(folder, "hinged.toml", study)
    tension = PROJECT["limits"][0]
    project = {key: value for key, value in solved(limits=[tension]).items() if key != "simulation"}
    project["project"]["study"] = "hinged.toml"
    project["states"] = [{**PROJECT["states"][0], "lines": ["intact"]}]
    with pytest.raises(ValueError, match=r"the study has hinges \(hinges\), but no chosen criterion judges them"):
        read_project(written(folder, "hinged_project.toml", project))
    project["limits"] += [{"quantity": "hinge force", "at_most": 20.0, "unit": "kN", **OWNER}]
    path = written(folder, "hinged_project.toml", project)
    made = hakobune.design(path, folder / "hinged", advice=False)
    case = tomllib.loads((folder / "hinged" / "cases" / "storm_210_deg.toml").read_text(encoding="utf-8"))
    held = np.abs(hakobune.moor(case, folder / "two.h5")["hinge.largest"][:3])
    assert made["criterion.value"][1] == pytest.approx(held.max() / 1e3, rel=1e-9)
    assert made["criterion.item"][1] == f"H force {'xyz'[held.argmax()]}"


FAULTS = {
    "a body that is not there": (
        {"limits": [*PROJECT["limits"], {"quantity": "sway", "at_most": 1.0, "subject": "tug", **OWNER}]},
        "limits[5].subject is 'tug'; allowed: hawser, ship, barge, or left out for all others",
    ),
    "tension of a body": (
        {"limits": [*PROJECT["limits"], PROJECT["limits"][0] | {"subject": "ship"}]},
        "limits[5].subject is ship, a body, and quantity is 'tension / breaking load'; allowed with a body: surge,",
    ),
    "a motion of none": (
        {"simulation": {**PROJECT["simulation"], "linear_damping": {"sway": 2.0}}}, "allowed: ship surge, ship sway"
    ),
    "no time": ({"simulation": None}, "the study has fenders or ropes, which are judged by simulations only"),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_what_such_a_project_may_not_have_is_refused_in_a_line(folder, name):
    change, words = FAULTS[name]
    project = {key: value for key, value in solved(**change).items() if value is not None}
    with pytest.raises(ValueError) as error:
        read_project(written(folder, "fault.toml", project))
    assert words in str(error.value) and "\n" not in str(error.value)


def test_levels_are_refused_beside_a_body_that_stands(tmp_path):
    """A pier on the bed has another draft at high water; floating bodies rise with their hawsers and fenders"""
    pier = {**BARGE, "name": "pier", "fixed": True}
    study = {key: value for key, value in STUDY.items() if key not in ("lines", "rope", "fender", "hulls")}
    written(tmp_path, "study.toml", study | {"hulls": {"ship": {"freeboard": 1.5}}})
    written(tmp_path, "scene.toml", {**SCENE, "bodies": [SHIP, pier]})
    state = {**PROJECT["states"][0], "levels": ["mean", "high"]}
    project = {**PROJECT, "levels": {"high": 1.0}, "states": [state], "limits": PROJECT["limits"][:1]}
    project["simulation"] = {"duration": 15.0}
    with pytest.raises(StudyError, match="levels are given, but pier does not rise with the water"):
        read_project(written(tmp_path, "project.toml", project))
    base = {"water": {"depth": 12.0}, "of_hull": {}, "lines": [], "rope": STUDY["rope"], "fender": STUDY["fender"]}
    base["rope"] = [*STUDY["rope"], {"name": "shore", "bollard": [0.0, 20.0, 4.0]}]
    raised = mooring.at(base, 13.5, {})
    assert raised["rope"] == [STUDY["rope"][0], {"name": "shore", "bollard": [0.0, 20.0, 2.5]}]
    assert raised["fender"] == STUDY["fender"]


def test_a_limit_on_a_motion_is_that_of_the_worst_body_or_of_its_own():
    def own(subject, statistic="largest"):
        return Criterion(
            OWN, "", "sway", "at most", 2.0, None, "m", "any", "any", "any", subject, statistic, 1.0, "", "read"
        )

    case = Case("c", "normal", "intact", "dynamic", {}, {"sway": {"ship": 0.5, "barge": 1.5}}, {})
    found = judge([own(""), own("ship"), own("barge", "peak to peak")], [case])
    assert [(one.governing.item, one.governing.value, one.governing.utilisation) for one in found] == [
        ("barge sway", 1.5, 0.75), ("ship sway", 0.5, 0.25), ("barge sway", 3.0, 1.5)]  # fmt: skip
    assert [one.met for one in found] == [True, True, False]
    runs = case._replace(ranges={"sway": {"ship": 0.7, "barge": 1.9}})  # of a run
    found = judge([own("barge", "peak to peak"), own("", "amplitude"), own("ship", "peak to peak")], [runs])
    assert [one.governing.value for one in found] == [1.9, 1.5, 0.7] and found[0].met


def test_hulls_in_the_plan_move_along_their_own_axes():
    """A barge that heads to +y, turned about a point 1 m ahead of its middle; 2 m ahead of (10, 5) m is (10, 7)"""
    box = ExposedBox(4.0, 2.0, 1.0, 1.0)
    hull = Afloat("barge", box, np.array([1.0, 0.0, 0.0]), np.array([10.0, 5.0]), np.pi / 2, 1025.0)
    still, moved = side_plan.outlines(hull, np.array([2.0, 0.0, 0.0]))
    assert still[0] == pytest.approx([9.0, 7.0]) and moved - still == pytest.approx(np.tile([0.0, 2.0], (5, 1)))
    turned = side_plan.outlines(hull, np.array([0.0, 0.0, np.pi / 2]))[1]
    assert turned[0] == pytest.approx([9.0, 5.0])  # the corner (2, 1) is at (1, 1) from the point: (−1, 1), or (0, 1) m


def test_the_close_view_names_ropes_above_and_fenders_below(pictures, folder, tmp_path):
    db = open_database(folder / "two.h5")
    made = mooring.make_study(STUDY)
    numbers = SimpleNamespace(
        names=("chain", "R"), largest=np.array([20.0, 50.0]), breaking=np.array([100.0, 100.0]),
        anchor=np.array([[50.0, 50.0, -12.0], [-1.0, 1.0, 1.0]]),
        fairlead=np.array([[7.0, 6.0, 0.0], [-3.0, -1.0, 1.0]]),
        parts={"fender strain / allowable strain": {"F": 0.25}}, place=np.zeros((2, 3)),
    )  # fmt: skip
    side_plan.draw_between(made, db, numbers, tmp_path / "p.png")
    far, near, _ = pictures[0].axes
    assert [one.get_text() for one in far.texts] == ["chain 20 %"]
    at = {one.get_text(): one.xyann[1] for one in near.texts}
    assert at["R 50 %"] > 6.0 and at["F 25 %"] < -6.0 and at["G 0 %"] < -6.0 and {"ship", "barge"} <= set(at)
