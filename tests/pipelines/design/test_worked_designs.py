"""The worked designs among the scenes, each in a reduced form: coarse databases, minutes in place of hours"""

import csv
import tomllib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
import tomli_w

from hakobune import pipelines
from hakobune.bem.time_domain.memory import no_memory
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds.breakwater import _numbers as breakwater_numbers
from hakobune.pipelines.design.project import read_project
from hakobune.pipelines.design.result import made
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.results.file import read

SCENES = Path(pipelines.__file__).parent / "scenes"
COARSE = {"periods": [6.0, 8.0, 11.0, 20.0], "headings_deg": [0.0, 45.0, 90.0, 135.0, 180.0]}


def without_memory(reader, motions=None):
    """Memory without states, so that none has to be fitted, and the added mass of the longest waves; no findings"""
    return replace(no_memory(reader), added_mass_infinity=reader.coefficients(reader.omega[:1])[0][0]), ()


def raw_of(name):
    return tomllib.loads((SCENES / name).read_text(encoding="utf-8"))


def put(folder, name, raw):
    (folder / name).write_text(tomli_w.dumps(raw), encoding="utf-8")


def reduced(folder, name, **states):
    """Files of a worked design in a folder, by their own names: a coarse scene, a minute in time, fewer directions

    states : {state: what changes of it}
    """
    project = raw_of(name)
    own = project["project"]
    for study in (own["study"], *(one["study"] for one in project.get("earthquakes", ()))):
        put(folder, study, raw_of(study))
    if "scene" in own:
        scene = raw_of(own["scene"])
        put(folder, own["scene"], {**scene, "tolerance": 0.1, "waves": COARSE})
    if "simulation" in project:
        project["simulation"] |= {"duration": 60.0, "ramp": 20.0, "seeds": 1, "dynamic_lines": "none", "qtf": "newman"}
        project["simulation"].pop("duration_hours", None)
    project["states"] = [state | states[state["name"]] for state in project["states"] if state["name"] in states]
    used = {level for state in project["states"] for level in state.get("levels", ())}
    project["levels"] = {level: rise for level, rise in project.get("levels", {}).items() if level in used}
    put(folder, name, project)
    return folder / name


def rows(path):
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()[1:]))


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr("hakobune.mooring.motion.simulation.moored_body.fitted_memory", without_memory)


@pytest.fixture(autouse=True)
def with_one_picture(monkeypatch):
    """The page with one plan and without the curves of the body, which take seconds"""
    monkeypatch.setattr("hakobune.pipelines.design.report.body_pictures", lambda database, folder: [])
    monkeypatch.setattr("hakobune.pipelines.design.report_pictures.MOST_PLANS", 1)


@pytest.fixture(scope="module")
def tanker(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tanker")
    states = {"storm": {"incidence_deg": [-90.0]}, "loading": {"incidence_deg": [120.0], "levels": ["mean"]}}
    return reduced(folder, "design_tanker_berth.toml", **states)


def test_a_tanker_berth_is_judged_by_ropes_fenders_dolphins_and_motions(tanker, quick):
    from hakobune.bem.database import open_database
    from hakobune.mooring.motion.contacts import courses
    from hakobune.pipelines.moor.study import make_study
    from hakobune.pipelines.simulate.file import opened

    out = tanker.parent / "out"
    verdict, names, _ = made(read_project(tanker), out, Here(), None)
    assert [one.fault for one in verdict.ran if one.fault] == []
    assert names == ("report.html", "cases.csv", "criteria.csv", "parts.csv")
    cases = {one.case.name: one for one in verdict.ran}
    storm = cases["storm, -90 deg"]
    (lost,) = [one for one in verdict.ran if one.case.lost]
    assert lost.case.lost == storm.numbers.names[int(np.argmax(storm.largest))] and len(lost.numbers.names) == 15
    asked = {one.criterion.quantity: one.governing for one in verdict.judged}
    for quantity, use in asked.items():  # the governing one is the worst of all that are in the tables
        found = [float(row["value"]) for row in rows(out / "parts.csv") if row["quantity"] == quantity]
        if found:
            assert use.value == pytest.approx(min(found) if "design load" in quantity else max(found), rel=1e-9)
    assert {"tension / breaking load", "surge", "fender energy / rated energy"} <= set(asked)
    # forces of ropes where they are largest, and strains, by the stored course of the body
    study = make_study(tomllib.loads((out / "cases" / "storm_-90_deg.toml").read_text(encoding="utf-8")))
    db = open_database(out / "databases" / "mean.h5")
    berth = study.berth(study.hull_of(db.dimensions), db.rotation_center)
    with opened(out / "cases" / "storm_-90_deg_runs.h5") as file:
        motion, tension, pressed = (file[name][0].astype(float) for name in ("motion", "tension", "deflection"))
    depth, force = courses(berth, motion)
    np.testing.assert_allclose(force[:, 4:], tension, rtol=1e-3, atol=1.0)
    np.testing.assert_allclose(np.maximum(depth[:, :4], 0.0), pressed, atol=1e-6)
    one = study.fender[0]
    reaction = np.interp(pressed[:, 0].max(), *series_of(berth.fenders[0].fender))
    alone = pressed[:, 0].max() - reaction / (1e3 * study.dolphin[0].stiffness)
    assert storm.numbers.parts["fender strain, total"][one.name] >= alone / one.height * (1 - 1e-3)


def series_of(pair):
    """Deflections and reactions of a fender on its dolphin"""
    y = np.linspace(0.0, pair.limit, 2000)
    return y, pair.loading(y)


def test_a_berth_at_high_water_has_its_bollards_and_fenders_lower_on_the_hull(tanker):
    from hakobune.pipelines.design.kinds import mooring

    read = read_project(tanker)
    base = {key: value for key, value in read.study.items() if key != "waves"}
    base |= {"lines": [], "of_hull": {"wind": {}, "current": {}}}
    study = mooring.at(base, 24.0, {})
    assert study["rope"][0]["bollard"][2] == base["rope"][0]["bollard"][2] - 2.0
    assert study["fender"][0]["position"][2] == base["fender"][0]["position"][2] - 2.0
    assert study["rope"][0]["fairlead"] == base["rope"][0]["fairlead"]


def test_names_in_the_plan_of_a_berth_lie_over_none_of_their_row():
    from hakobune.pipelines.design.kinds.berth_plan import LETTER, in_rows

    rng = np.random.default_rng(1)
    for scale in (0.01, 0.03, 0.2):
        words = [("x" * rng.integers(3, 20), rng.uniform(-150, 150, 2)) for _ in range(24)]
        rows = in_rows(words, scale)
        assert sorted(text for row in rows for text, _ in row) == sorted(text for text, _ in words)
        for row in rows:
            half = np.array([0.5 * LETTER * len(text) / scale for text, _ in row])
            x = np.array([place[0] for _, place in row])
            assert np.all(np.diff(x) > half[:-1] + half[1:])


def test_a_berth_without_time_is_refused(tanker):
    raw = tomllib.loads(tanker.read_text(encoding="utf-8"))
    del raw["simulation"]
    put(tanker.parent, "still.toml", raw)
    with pytest.raises(
        StudyError,
        match=r"the study has fenders or ropes, which are judged by simulations only; "
        r"give the project \[simulation\] \(the \[simulation\] of the study is not read\)",
    ):
        read_project(tanker.parent / "still.toml")


@pytest.fixture(scope="module")
def barge(tmp_path_factory):
    states = {
        "extreme": {"incidence_deg": [30.0], "current_off_deg": [30.0]},
        "loading": {"levels": ["high"], "lines": ["intact"]},
    }
    folder = tmp_path_factory.mktemp("barge")
    path = reduced(folder, "design_single_point_barge.toml", **states)
    study = raw_of("single_point_barge.toml")
    put(folder, "single_point_barge.toml", {**study, "slewing": {"duration": 200.0, "scheme": "slow"}})
    return path


def test_a_barge_at_a_single_point_is_judged_by_hawser_lines_and_slewing(barge, monkeypatch):
    from hakobune.bem.database import open_database
    from hakobune.mooring.single_point.equilibria import equilibria, preferred
    from hakobune.pipelines.single_point.reading import read_study
    from hakobune.pipelines.single_point.study import make

    out = barge.parent / "out"
    verdict, _, _ = made(read_project(barge), out, Here(), None)
    assert [one.fault for one in verdict.ran if one.fault] == []
    of = {one.criterion.subject: one.governing for one in verdict.judged}
    assert of["hawser"].item == "hawser 1" and of["chain of a single-point mooring"].item.startswith("line at ")
    (intact,) = [one for one in verdict.ran if one.case.state == "extreme" and not one.case.lost]
    (lost,) = [one for one in verdict.ran if one.case.lost]
    assert lost.case.lost in intact.numbers.names and lost.case.lost not in lost.numbers.names
    assert len(lost.numbers.names) == len(intact.numbers.names) - 1
    # the case's own file, by its door
    study, _, _ = read_study(out / "cases" / "extreme_30_deg_current_+30.toml")
    best = preferred(equilibria(make(study, open_database(out / "databases" / "mean.h5")).point))
    np.testing.assert_allclose(intact.numbers.static, [*best.hawser, *best.lines.tension], rtol=1e-9)
    # waves without their slow drift, for which the report (3.6) adds a fifth
    pulled = read(intact.path, "single-point")["run.line_tension"].max(axis=0)
    np.testing.assert_allclose(intact.numbers.largest[1:], 1.2 * pulled, rtol=1e-9)
    # what an anchor bears grows with the tension of its line, from what it bears at rest
    at_rest = np.stack([best.lines.lines.horizontal_a, -best.lines.lines.vertical_a])
    borne = np.stack([intact.numbers.horizontal, intact.numbers.uplift])
    np.testing.assert_allclose(borne[:, 1:], at_rest * (1.2 * pulled / best.lines.tension), rtol=1e-9)
    assert not borne[:, 0].any()
    monkeypatch.setattr(
        "hakobune.pipelines.design.kinds.single_point._found", None
    )  # again: taken from the file, the same
    again, _ = read_project(barge).kind.run(intact.case.study, out / "databases" / "mean.h5", intact.path, [1.0])
    for name, value in again._asdict().items():
        np.testing.assert_equal(value, getattr(intact.numbers, name))


@pytest.mark.parametrize(
    ("drop", "message"),
    [
        ("hawser", r"a hawser \(hawser\), but no chosen criterion judges them; .* with subject = \"hawser\""),
        ("chain of a single-point mooring", r"lines at the buoy \(mooring\), but no chosen criterion judges them"),
    ],
)
def test_a_hawser_and_the_lines_of_its_buoy_are_each_judged(barge, drop, message):
    """A limit of one's own is of either"""
    project = tomllib.loads(barge.read_text(encoding="utf-8"))
    project["rules"] = [one for one in project["rules"] if one["subject"] != drop]
    worn = project["limits"].pop(0)
    del project["wear"]
    put(barge.parent, "unjudged.toml", project)
    with pytest.raises(StudyError, match=message):
        read_project(barge.parent / "unjudged.toml")
    own = {**worn, "quantity": "tension / breaking load"} | ({"subject": "hawser"} if drop == "hawser" else {})
    put(barge.parent, "judged.toml", {**project, "limits": [own]})
    assert read_project(barge.parent / "judged.toml").criteria[-1].subject == own.get("subject", "")


def test_lines_of_a_buoy_end_at_the_same_anchors_at_every_level(barge):
    from hakobune.pipelines.design.kinds import single_point
    from hakobune.pipelines.single_point.study import DENSITY, system_of
    from hakobune.pipelines.single_point.tables import make_study

    base = single_point.base(read_project(barge).study, None)
    systems = [
        system_of(make_study(single_point.at(base, depth, {})), depth, DENSITY)[0] for depth in (20.0, 21.5, 18.0)
    ]
    anchors = np.array([[point.position[:2] for point in system.points[::2]] for system in systems])
    np.testing.assert_allclose(anchors[1:], np.broadcast_to(anchors[0], anchors[1:].shape), atol=1e-5)
    with pytest.raises(StudyError, match="do not reach their anchors"):
        single_point.at(base, 200.0, {})


def test_a_floater_between_dolphins_is_judged_by_strains_and_loads_of_dolphins(tmp_path, quick):
    path = reduced(tmp_path, "design_dolphins_B.toml", extreme={"incidence_deg": [90.0]})
    body = {"mass": 410000.0, "added_mass": 2e5, "damping": 2e4}  # the coarse database has no memory
    put(tmp_path, "earthquake_dolphins_B.toml", {**raw_of("earthquake_dolphins_B.toml"), "body": body})
    verdict, _, _ = made(read_project(path), tmp_path / "out", Here(), None)
    assert [one.fault for one in verdict.ran if one.fault] == []
    one, shaken = verdict.ran
    parts, met = one.numbers.parts, ("starboard aft", "starboard fore")  # wind and waves push to starboard
    assert one.numbers.names == () and one.numbers.place[1] < 0
    for name in met:
        steady, total = parts["fender strain, steady"][name], parts["fender strain, total"][name]
        assert 0 < steady <= total and total > parts["fender strain, total"]["fore"]
    strains = [use for use in verdict.judged if "fender strain" in use.criterion.quantity]
    assert strains and {u.item for use in strains for u in use.uses if u.case == one.case.name} <= set(met)
    assert any("design spectrum method, 2 fenders" in line for line in one.numbers.warnings)
    # the earthquake by its own door: strain of the fender alone, and what of the dolphin's strength it takes
    from scipy.optimize import brentq

    from hakobune.mooring.dolphins.methods import methods
    from hakobune.pipelines.earthquake.study import quake_of, read_study

    study, _ = read_study(tmp_path / "earthquake_dolphins_B.toml")
    (row,) = methods(quake_of(study, tmp_path))[0]
    alone = fender_alone(study)

    def left(own):  # of the deflection, where both carry what the fender does: the dolphin yields at 23333 kN
        force = float(alone.loading(own))
        return own + min(force, 23333e3) / 166667e3 + max(force - 23333e3, 0.0) / 66667e3 - row.deflection

    fender = brentq(left, 0.0, row.deflection)
    assert shaken.numbers.parts["fender strain, total"][row.name] == pytest.approx(fender / 3.0, rel=1e-4)
    strength = shaken.numbers.parts["design load of a dolphin / fender reaction"][row.name]
    assert strength == pytest.approx(6 * 23333e3 / row.reaction, rel=1e-9)
    judged = {use.criterion.quantity: [u.case for u in use.uses] for use in verdict.judged}
    assert shaken.case.name in judged["fender strain, total"] and shaken.case.name not in judged["surge"]


def fender_alone(study):
    """The fender of an earthquake study without its dolphin"""
    from hakobune.pipelines.common.fender_tables import fender_of

    return fender_of(msgspec.structs.replace(study.fender, count=1))


@pytest.fixture(scope="module")
def marina(tmp_path_factory):
    folder = tmp_path_factory.mktemp("marina")
    calm = {"waves": {"height": 0.5, "period": 5.0}}  # in which no line goes slack, as snaps are followed in time
    path = reduced(folder, "design_breakwater.toml", working={"incidence_deg": [0.0]}, design=calm)
    study = raw_of("breakwater_rectangle.toml")
    study["waves"]["periods"] = [6.0, 9.0, 12.0]
    put(folder, "breakwater_rectangle.toml", {**study, "holdings": ["taut"], "theories": ["potential flow"]})
    return path


def test_a_breakwater_is_judged_by_what_passes_it(marina):
    """A case by its own door; the highest of N waves of Rayleigh's law, whose most probable value is H₁/₃ √(½ ln N)"""
    from hakobune.mooring.studies.breakwater.results import results
    from hakobune.mooring.studies.breakwater.tides import Snapping
    from hakobune.pipelines.breakwater.build import breakwater_of
    from hakobune.pipelines.breakwater.study import read_breakwater

    out = marina.parent / "out"
    verdict, _, _ = made(read_project(marina), out, Here(), None)
    assert [one.fault for one in verdict.ran if one.fault] == []
    study, _ = read_breakwater(out / "cases" / "design_0_deg.toml")
    found = results(breakwater_of(study))
    (design,) = [one for one in verdict.ran if one.case.state == "design"]
    assert design.numbers.parts["transmitted wave height"] == {
        "taut": pytest.approx(found.sea.heights["taut"], rel=1e-12)
    }
    waves = 3 * 3600 / 5.0
    above = np.exp(-2 * (study.waves.height / study.sea.height) ** 2)
    assert waves * above == pytest.approx(1.0, rel=1e-9)
    (passed,) = [one for one in verdict.judged if one.criterion.quantity == "transmitted wave height"]
    assert passed.governing.case == "working, 0 deg"  # the limit is of normal states
    snap = SimpleNamespace(largest=(1e6, 0.0))  # N/m in time, of the front line; of the back line less than in the sea
    snaps = breakwater_numbers(breakwater_of(study), found._replace(snapping=Snapping("mean", 6.0, snap)))
    in_sea = study.lines.spacing * np.array(found.sea.tension)
    assert np.allclose(snaps.largest, [1e6 * study.lines.spacing, in_sea[1]], rtol=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda p: p["states"][0].update(wind={"speed": 10.0}),
            r"states\[0\].wind is given; a breakwater",
        ),
        (lambda p: p["states"][0].update(lines=["one lost"]), r"states\[0\].lines is .*; allowed: intact"),
        (
            lambda p: p.update(levels={"high": 1.0}),
            "levels are given; a breakwater takes its water levels from water.tide of its study",
        ),
        (
            lambda p: p["project"].update(scene="box.toml"),
            "a study of a breakwater defines its own section; leave it out",
        ),
        (lambda p: p["limits"][0].update(at_least=1.0), r"limits\[0\]: give one of at_most, at_least"),
        (lambda p: p["limits"][0].update(state="calm"), r"limits\[0\].state is 'calm'"),
        (lambda p: p["limits"].pop(1), r"the study has lines \(lines\), but no .* 'tension / allowable tension'"),
        (lambda p: p["limits"].pop(2), r"the study has anchors of a known capacity \(anchors\), but no"),
        (lambda p: p["limits"][3].update(unit="%"), "unit of slack share of the cycles is '%'; allowed: -"),
    ],
)
def test_what_a_breakwater_has_not_is_told_in_one_line(marina, change, message):
    project = tomllib.loads(marina.read_text(encoding="utf-8"))
    change(project)
    put(marina.parent, "wrong.toml", project)
    with pytest.raises(ValueError, match=message) as fault:
        read_project(marina.parent / "wrong.toml")
    assert "\n" not in str(fault.value)
