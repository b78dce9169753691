"""A project is read once and checked whole: with one thing wrong in it, it is refused before anything is solved.

Every fault is one change of a sound project, its study or its scene; the command ends with 2, in one line that names
the thing and what is allowed, and leaves no file.
"""

import copy
from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w

from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds import mooring
from hakobune.pipelines.design.project import read_project
from hakobune.pipelines.moor import checked as moor_checked
from hakobune.pipelines.moor.checked import body_of_scene
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

SCENE = {
    "water": {"depth": 20.0},
    "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.5, 29.4, 32.3]}],
    "waves": {"periods": [5, 6, 7, 8, 10, 12, 15, 20, 30, 60], "headings_deg": [0, 30, 60, 90]},
    "method": "contour",
    "tolerance": 0.02,
}
CORNERS = {"fore port": (1, 1), "fore starboard": (1, -1), "aft port": (-1, 1), "aft starboard": (-1, -1)}
LINES = [
    {"name": name, "type": "chain", "length": 260.0, "fairlead": [50.0 * x, 25.0 * y, 0.0],
     "anchor": [230.0 * x, 205.0 * y]}
    for name, (x, y) in CORNERS.items()
]  # fmt: skip
CHAIN = {"catalogue": "R3 studlink 76 mm", "bed_friction": 0.6}
MOORING = {"water": {"depth": 20.0}, "hull": {"freeboard": 10.0}, "types": {"chain": CHAIN}, "lines": LINES}
STATES = [
    {"name": "storm", "state": "abnormal", "incidence_deg": [60.0], "levels": ["mean", "high"],
     "lines": ["intact", "one lost"], "wind": {"speed": 30.0, "gusts": "davenport"}, "current": {"speed": 1.0},
     "waves": {"height": 1.0, "period": 7.0}},
    {"name": "work", "state": "normal", "incidence_deg": [0.0, 30.0], "current": {"speed_knots": 1.0}},
]  # fmt: skip
OWN = {"study": "study.toml", "scene": "scene.toml", "service_life": 20.0, "probability": 0.82}
LINES_PROJECT = {
    "project": {"name": "box on chains", **OWN},
    "levels": {"high": 1.5},
    "states": STATES,
    "simulation": {"duration": 600.0, "seeds": 1},
    "rules": [{"rule": "JSCE", "subject": "chain of a multi-point mooring"}],
}


def _rope(name, side):
    return {"name": name, "fairlead": [40.0 * side, 20.0, 9.0], "bollard": [60.0 * side, 60.0, 5.0],
            "pretension_kN": 100.0, "breaking_load_kN": 1600.0, "break_strain": 0.1}  # fmt: skip


CONE = {"family": "cone", "height": 2.0, "rated_reaction": 2500.0}
BERTH = {
    "water": {"depth": 20.0},
    "hull": {"freeboard": 10.0},
    "dolphin": [{"name": "D1", "stiffness": 6e4, "yield_force": 6000.0, "stiffness_beyond": 2e4}],
    "fender": [{"name": "F1", "on": "D1", "position": [-25.0, 25.0, 2.0], "friction": 0.2, "shear": 5e3, **CONE},
               {"name": "F2", "position": [25.0, 25.0, 2.0], **CONE}],
    "rope": [_rope("head", 1), _rope("stern", -1)],
}  # fmt: skip
BERTH_PROJECT = {
    **{key: value for key, value in LINES_PROJECT.items() if key != "rules"},
    "limits": [
        {"quantity": "fender strain / allowable strain", "at_most": 1.0, "source": "maker"},
        {"quantity": "tension / breaking load", "at_most": 0.5, "source": "port"},
        {"quantity": "design load of a dolphin / fender reaction", "at_least": 1.0, "source": "port"},
    ],
}
POINT = {
    "water": {"depth": 20.0},
    "hull": {"length": 100.0, "beam": 50.0, "draft": 10.0, "freeboard": 10.0},
    "attachment": {"x": 50.0},
    "hawser": {"length": 30.0, "breaking_load_tonf": 700.0, "strain": 0.4},
    "buoy": {"z": -3.0},
    "types": {"chain": {"catalogue": "R3 studlink 92 mm"}},
    "mooring": {"type": "chain", "length": 250.0, "count": 6, "first_deg": 30.0, "top_tension_tonf": 25.0},
    "current": {"speed_knots": 1.0, "incidence_deg": 30.0, "turning": {"beam_over_draft": 10.0}},
}
POINT_PROJECT = {
    **{key: value for key, value in LINES_PROJECT.items() if key != "simulation"},
    "states": [
        {**STATES[0], "levels": ["mean"], "wind": {"speed": 20.0}, "current": {"speed_knots": 1.0}},
        STATES[1],
    ],
    "rules": [{"rule": "SR179", "subject": "chain of a single-point mooring"}, {"rule": "SR179", "subject": "hawser"}],
}
BREAKWATER = {
    "name": "breakwater",
    "holdings": ["fixed", "taut"],
    "theories": ["potential flow"],
    "water": {"depth": 10.0},
    "section": {"shape": "rectangle", "beam": 10.0, "height": 6.667, "draft": 5.0},
    "body": {"free_draft": 3.367, "center_of_gravity": 3.417, "gyration": 4.4},
    "lines": {"angle_deg": 44.0, "attachment": 5.0, "spacing": 5.0, "allowable_kN": 3000.0},
    "waves": {"height": 1.5, "periods": [6.0, 8.0]},
    "design": {"holding": "taut"},
}
BREAKWATER_PROJECT = {
    "project": {"name": "breakwater", "study": "study.toml"},
    "states": [{"name": "storm", "state": "normal", "incidence_deg": [0.0], "waves": {"height": 1.0, "period": 5.0}}],
    "limits": [{"quantity": "tension / allowable tension", "at_most": 1.0, "source": "owner"}],
}
OF_DATABASE = {
    **{key: value for key, value in LINES_PROJECT.items() if key != "levels"},
    "project": {key: value for key, value in OWN.items() if key != "scene"} | {"name": "box", "database": "box.h5"},
    "states": [{**STATES[0], "incidence_deg": [0.0], "levels": ["mean"]}, STATES[1]],
}
SOUND = {
    "lines": (LINES_PROJECT, MOORING),
    "database": (OF_DATABASE, MOORING),
    "berth": (BERTH_PROJECT, BERTH),
    "single point": (POINT_PROJECT, POINT),
    "breakwater": (BREAKWATER_PROJECT, BREAKWATER),
}


def at(path, value):
    """The change that puts a value, or with ... nothing, at a path of the project, the study or the scene"""

    def change(tables):
        *way, last = path
        for step in way:
            tables = tables[step]
        if value is ...:
            del tables[last]
        elif isinstance(tables, list) and last == len(tables):
            tables.append(value)
        else:
            tables[last] = value

    return change


def project(*path):
    return ("project", *path)


def study(*path):
    return ("study", *path)


def scene(*path):
    return ("scene", *path)


def simulation(key):
    return project("simulation", key)


def storm(*path):
    return project("states", 0, *path)


LIMIT = {"quantity": "surge", "at_most": 1.0, "source": "owner"}
ANCHOR = {"quantity": "holding capacity / horizontal force", "at_least": 1.0, "source": "owner"}
WORN = "tension / breaking load, worn"
UNTIMED = [(project("project", key), ...) for key in ("service_life", "probability")]
# kind of the project, changes, words that the line must have: the thing and what is allowed
FAULTS = {
    "line type": ("lines", [(study("lines", 0, "type"), "chian")], ("lines[0].type is 'chian'", "allowed: chain")),
    "catalogue of a type without lines": (
        "lines", [(study("types", "wire"), {"catalogue": "R9 76 mm"})], ("types.wire.catalogue: 'R9 76 mm'", "R3"),
    ),
    "name of two lines": (
        "lines", [(study("lines", 1, "name"), "fore port")], ("'fore port' is used twice", "a name of its own")
    ),
    "anchor of a line": ("lines", [(study("lines", 1, "anchor"), ...)], ("lines[1] (fore starboard)", "anchor")),
    "line that is lost": (
        "lines", [(simulation("lines_lost"), [{"line": "bow", "time": 3.0}])],
        ("simulation.lines_lost: there is no line 'bow'", "allowed: fore port"),
    ),
    "line that moves": (
        "lines", [(simulation("dynamic_lines"), ["bow"])],
        ("simulation.dynamic_lines: there is no line 'bow'", "allowed: fore port"),
    ),
    "word for lines that move": ("lines", [(simulation("dynamic_lines"), "some")], ("dynamic_lines is 'some'", "auto")),
    "motion that is damped": (
        "lines", [(simulation("damping_ratio"), {"rol": 0.1})], ("damping_ratio.rol is unknown", "roll, pitch"),
    ),
    "motion that is damped linearly": (
        "lines", [(simulation("linear_damping"), {"swai": 1.0})], ("there is no motion 'swai'", "sway"),
    ),
    "slow drift": ("lines", [(simulation("slow_drift"), "neuman")], ("slow_drift is 'neuman'", "newman")),
    "pairs of waves": ("lines", [(simulation("qtf"), "ful")], ("simulation.qtf is 'ful'", "bound-wave, body, full")),
    "pairs without waves": ("lines", [(simulation("qtf"), "full")], ("work", "simulation.qtf is 'full'", "irregular")),
    "memory": ("lines", [(simulation("memory"), "state")], ("memory is 'state'", "states, constant")),
    "duration": ("lines", [(simulation("duration"), ...)], ("simulation: neither is given", "duration_hours")),
    "file of a force": ("lines", [(simulation("force"), [{"file": "tug.csv"}])], ("tug.csv does not exist",)),
    "direction of a further sea": (
        "lines", [(simulation("sea"), [{"height": 1.0, "period": 9.0}])], ("simulation.sea", "one of direction_deg"),
    ),
    "type of a ship for the wind": (
        "lines", [(storm("wind", "ship"), "tankr")], ("states[0].wind.ship is 'tankr'", "tanker, loaded"),
    ),
    "ship of the hull's wind": ("lines", [(study("wind"), {"ship": "tankr"})], ("wind.ship is 'tankr'", "tanker")),
    "file of wind coefficients": (
        "lines", [(storm("wind", "file"), "w.csv")], ("states[0].wind.file", "does not exist"),
    ),
    "lever of a current all round": (
        "lines",
        [(storm("current", "coefficients"),
          {"angles_deg": [0, 90, 180], "x": [1, 0, -1], "y": [0, 1, 0], "lever": [0, 0, 0]})],
        ("states[0].current.coefficients.lever is given", "angles_deg up to 90"),
    ),
    "gusts": ("lines", [(storm("wind", "gusts"), "davenprt")], ("wind.gusts is 'davenprt'", "davenport, hino")),
    "key of other gusts": ("lines", [(storm("wind", "gust_height"), 9.0)], ("wind.gust_height", "surface_drag")),
    "waves on the current": ("lines", [(storm("current", "waves"), "moving")], ("current.waves is 'moving'", "still")),
    "method of the waves": ("lines", [(storm("waves", "method"), "regular")], ("method is 'regular'", "regular_wave")),
    "spectrum": (
        "lines", [(storm("waves", "spectrum"), "jonswp")], ("states[0].waves.spectrum is 'jonswp'", "jonswap"),
    ),
    "spreading": ("lines", [(storm("waves", "spreading"), "cos:4")], ("waves.spreading is 'cos:4'", "cosine:N")),
    "waves that are not solved for": (
        "lines", [(storm("waves", "period"), 52.0)], ("storm", "outside the stored frequencies", "allowed: 25 %"),
    ),
    "regular wave that is not solved for": (
        "lines", [(storm("waves"), {"height": 1.0, "period": 90.0, "method": "regular_wave"})],
        ("waves of 90 s lie outside", "5 to 60 s", "s; solve this period as well"),
    ),
    "waves of the simplified method": (
        "lines", [(project("simulation"), ...), (storm("waves", "period"), 200.0)],
        ("of the wave energy", "allowed: 50 %", "add periods"),
    ),
    "direction that is not solved for": (
        "lines", [(scene("waves", "headings_deg"), [0, 30])],
        ("wave direction 240°", "at most 45° apart", "add this direction"),
    ),
    "radii of gyration": ("lines", [(scene("bodies", 0, "gyration"), ...)], ("radii of gyration", "give gyration")),
    "what of the waves is wanted": (
        "lines", [(scene("want"), ["radiation", "diffraction"])], ("does not list drift_force", "leave the key out"),
    ),
    "shape": ("lines", [(scene("bodies", 0, "shape"), "bax")], ("bodies[0].shape is 'bax'", "box, buoy")),
    "size of another hull": ("lines", [(study("hull", "length"), 90.0)], ("hull.length is 90 m", "100 m")),
    "scene": ("lines", [(project("project", "scene"), "sc.toml")], ("sc.toml does not exist",)),
    "study": ("lines", [(project("project", "study"), "s.toml")], ("s.toml does not exist",)),
    "database": (
        "lines",
        [(project("project", "scene"), ...), (project("project", "database"), "b.h5"), (project("levels"), {}),
         (storm("levels"), ["mean"])],
        ("b.h5 does not exist",),
    ),
    "level": ("lines", [(storm("levels"), ["hihg"])], ("states[0].levels is 'hihg'", "allowed: mean, high")),
    "level in the ground": ("lines", [(project("levels", "high"), -21.0)], ("levels.high is -21 m", "above the bed")),
    "level of the keel": ("lines", [(project("levels", "high"), -12.0)], ("draft is 10.0 m", "below the depth")),
    "kind of a state": ("lines", [(storm("state"), "calm")], ("states[0].state is 'calm'", "normal, abnormal")),
    "which line is lost": ("lines", [(storm("lost"), "best")], ("states[0].lost is 'best'", "worst, each")),
    "states of one file": (
        "lines", [(project("states", 1, "name"), "storm!"), (project("states", 1, "incidence_deg"), [60.0])],
        ("'storm' and 'storm!'", "its own name"),
    ),
    "weather of no site": ("lines", [(storm("weather"), "extreme")], ("project.site is missing;", "give the file")),
    "site": ("lines", [(project("project", "site"), "bay.toml")], ("bay.toml does not exist",)),
    "rule set": ("lines", [(project("rules", 0, "rule"), "JSCEE")], ("rule set 'JSCEE' is unknown", "JSCE, JSRA")),
    "subject": (
        "lines", [(project("rules", 0, "subject"), "chains")], ("no criterion for 'chains'", "multi-point mooring")
    ),
    "file of rules": ("lines", [(project("rules", 1), {"rule": "x", "file": "r.csv"})], ("r.csv does not exist",)),
    "quantity": (
        "lines", [(project("limits"), [{**LIMIT, "quantity": "surg"}])], ("quantity is 'surg'", "surge; sway"),
    ),
    "statistic": (
        "lines", [(project("limits"), [{**LIMIT, "statistic": "mean"}])],
        ("limits[0].statistic is 'mean'", "largest, amplitude, peak to peak"),
    ),
    "hawser that there is not": (
        "lines", [(project("limits"), [{**LIMIT, "quantity": "tension / breaking load", "subject": "hawser"}])],
        ("limits[0].subject is 'hawser'", "but the study has no hawser; leave the subject out"),
    ),
    "quantity of a value": (
        "lines", [(project("values"), [{"quantity": "gust", "value": 1.0, "source": "x"}])],
        ("values[0].quantity is 'gust'", "allowed by the chosen criteria"),
    ),
    "line of an anchor": (
        "lines", [(project("anchors"), {"holding_kN": 1e4, "lines": {"bow": 1e4}}), (project("limits"), [ANCHOR])],
        ("anchors.lines: there is no line 'bow'", "allowed: fore port"),
    ),
    "anchors twice": (
        "lines",
        [(project("anchors"), {"holding_kN": 1e4}), (project("limits"), [ANCHOR]),
         (study("anchors"), [{"kind": "pile", "holding_kN": 1e4}])],
        ("[anchors] of the project", "[[anchors]] of its study", "one of them"),
    ),
    "holding capacity": (
        "lines", [(project("anchors"), {"holding_kN": -1.0}), (project("limits"), [ANCHOR])],
        ("anchors.holding_kN is -1", "above 0"),
    ),
    "wear": (
        "lines",
        [(project("wear"), {"mm_per_year": 3.0}),
         (project("limits"), [{**LIMIT, "quantity": "tension / breaking load, worn"}])],
        ("wear of type 'chain'", "at least half of the diameter"),
    ),
    "service life": ("lines", [(project("project", "service_life"), -1.0)], ("service_life is -1", "above 0")),
    "probability": ("lines", [(project("project", "probability"), 1.0)], ("probability is 1", "above 0, below 1")),
    "probability of nothing": (
        "lines", [(project("project", "probability"), 0.0)], ("probability is 0", "above 0, below 1"),
    ),
    "level without end": (
        "lines", [(project("levels", "high"), float("inf"))], ("levels.high is inf m", "allowed: finite"),
    ),
    "years of wear": (
        "lines", [(project("wear"), {"mm_per_year": 0.1}), *UNTIMED],
        ("wear: the number of years is missing", "give wear.years or project.service_life"),
    ),
    "wear below nothing": (
        "lines", [(project("wear"), {"mm_per_year": -0.1})], ("wear.mm_per_year is -0.1", "at least 0"),
    ),
    "wear twice": (
        "lines", [(project("wear"), {"mm_per_year": 0.1}), (study("types", "chain", "corrosion_mm"), 1.0)],
        ("[wear] and types.chain.corrosion_mm are both given", "one of them"),
    ),
    "diameter that wears": (
        "lines",
        [(project("wear"), {"mm_per_year": 0.1}),
         (study("types", "chain"), {"weight_kg_per_m": 100.0, "breaking_load_tonf": 500.0})],
        ("wear of type 'chain' needs a diameter", "name a size of the catalogue, such as catalogue ="),
    ),
    "diameter that tires": (
        "lines",
        [(project("fatigue"), {"curve": "DNV studless chain"}), (storm("share"), 0.1),
         (study("types", "chain"), {"weight_kg_per_m": 100.0, "breaking_load_tonf": 500.0})],
        ("fatigue of type 'chain' needs a diameter", "name a size of the catalogue"),
    ),
    "share of the time": ("lines", [(storm("share"), 1.01)], ("shares of the time are [1.01, 0.0]", "at most 1")),
    "factor of fatigue": (
        "lines", [(project("fatigue"), {"curve": "DNV studless chain", "factor": 0.99}), (storm("share"), 0.1)],
        ("fatigue.factor is 0.99", "at least 1"),
    ),
    "curve of fatigue": ("lines", [(project("fatigue"), {"curve": "x"})], ("fatigue.curve is 'x'", "DNV studless")),
    "line that does not reach": (
        "lines", [(study("lines", 0, "length"), 90.0)], ("line fore port is 90 m long", "limit 50 %", "longer line"),
    ),
    "no lines": ("lines", [(study("lines"), ...)], ("the study has no lines", "at least one")),
    "quay without a berth": ("lines", [(study("quay"), {"y": 30.0})], ("has a quay", "the study has a quay but "
    "neither fenders nor ropes; a project allows a quay only with fenders or ropes")),
    "freeboard": ("lines", [(study("hull", "freeboard"), -1.0)], ("hull.freeboard is -1", "above 0")),
    "earthquake of lines": ("lines", [(project("earthquakes"), [{"name": "q", "study": "q.toml"}])], ("no fenders",)),
    "direction of a database": (
        "database", [(storm("incidence_deg"), [0.0, 60.0])], ("box.h5", "wave direction 240°", "at most 45° apart"),
    ),
    "water of a database": (
        "database", [(study("water", "depth"), 25.0)], ("water.depth is 25 m", "box.h5 is for 20 m"),
    ),
    "waves of a database": (
        "database", [(storm("waves", "period"), 200.0)], ("of the wave energy", "stored 5 to 60 s", "allowed: 50 %"),
    ),
    "level of a database": (
        "database", [(project("levels"), {"high": 1.0})], ("a database for each depth", "project.scene"),
    ),
    "dolphin of a fender": ("berth", [(study("fender", 0, "on"), "D9")], ("no dolphin 'D9'", "allowed: D1")),
    "dolphin without a fender": ("berth", [(study("fender", 0, "on"), ...)],
                                ("'D1' carries no fender", "name the dolphin")),
    "family of a fender": (
        "berth", [(study("fender", 1, "family"), "coen")], ("'coen' is unknown", "cell, v, h, cone"),
    ),
    "place of a fender": (
        "berth", [(study("fender", 1, "position"), [25.0, 45.0, 2.0])], ("fender[1] (F2)", "at most 10 m from it"),
    ),
    "name of two ropes": ("berth", [(study("rope", 1, "name"), "head")], ("'head' is the name of two", "its own")),
    "tail of a rope": (
        "berth", [(study("rope", 1, "tail_length"), 9.0)], ("rope stern", "tail_break_strain is missing"),
    ),
    "strain of a rope": ("berth", [(study("rope", 1, "break_strain"), -0.1)], ("rope stern", "strain -0.1", "0 to 2")),
    "period of the harbour": (
        "berth", [(study("harbour"), {"periods": [-3.0]})], ("harbour.periods[0] is -3", "above 0"),
    ),
    "method of a quay": (
        "berth", [(study("quay"), {"y": 30.0, "method": "far"})], ("quay.method is 'far'", "far-field, panels"),
    ),
    "quay of panels in open water": (
        "berth", [(study("quay"), {"y": 30.0, "method": "panels"})], ("scene.toml is of open water", "--wall 30"),
    ),
    "pairs before a quay": (
        "berth", [(study("quay"), {"y": 30.0}), (simulation("qtf"), "full")], ("'full' in front of a quay", "newman"),
    ),
    "rope that is lost": (
        "berth", [(simulation("lines_lost"), [{"line": "head", "time": 1.0}])], ("no line 'head'", "allowed: none"),
    ),
    "berth that is not simulated": ("berth", [(project("simulation"), ...)], ("the study has fenders or ropes, "
    "which are judged by simulations only; give the project", "[simulation]")),
    "earthquake": ("berth", [(project("earthquakes"), [{"name": "q", "study": "q.toml"}])], ("q.toml does not exist",)),
    "line type at a single point": (
        "single point", [(study("mooring", "type"), "chian")], ("mooring.type is 'chian'", "allowed: chain"),
    ),
    "coefficients of a current": (
        "single point", [(study("current", "turning"), {"beam_over_draft": 90.0})],
        ("current", "beam_over_draft = 10"),
    ),
    "scheme": ("single point", [(study("slewing"), {"scheme": "fast"})], ("slewing.scheme is 'fast'", "two_scale")),
    "hawsers": ("single point", [(study("hawser", "count"), 3)], ("hawser.count is 3", "1 or 2")),
    "wind without a freeboard": (
        "single point", [(study("hull", "freeboard"), ...)],
        ("freeboard is missing", "give hull.freeboard, or wind.file"),
    ),
    "simulation of a single point": (
        "single point", [(project("simulation"), {"duration": 600.0})], ("[simulation] is given", "[slewing]"),
    ),
    "holding of a breakwater": ("breakwater", [(study("design", "holding"), "tight")], ("is 'tight'", "fixed, taut")),
    "wind on a breakwater": (
        "breakwater", [(storm("wind"), {"speed": 9.0})], ("states[0].wind is given", "loaded by waves only"),
    ),
    "spectrum at a breakwater": ("breakwater", [(storm("waves", "spectrum"), "isc")], ("is 'isc'", "issc")),
    "body deeper than it floats": (
        "breakwater", [(study("body", "free_draft"), 6.0)], ("body.free_draft is 6 m", "give a lighter body"),
    ),
}  # fmt: skip


class Reached(Exception):
    """Work began"""


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    path = tmp_path_factory.mktemp("box") / "box.h5"
    solve(make_scene({**SCENE, "waves": {**SCENE["waves"], "headings_deg": [0, 30]}}), path)
    return path


@pytest.fixture
def designed(box, tmp_path, monkeypatch, capsys):
    """Runs design on a sound project with changes, where no work may begin; gives its status and its line"""

    def reached(*_, **__):
        raise Reached

    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.h5").symlink_to(box)
    monkeypatch.setattr("hakobune.pipelines.solve.run.solve", reached)
    monkeypatch.setattr("hakobune.pipelines.design.result.made", reached)

    def run(kind, changes):
        tables = dict(zip(("project", "study"), copy.deepcopy(SOUND[kind]), strict=True)) | {
            "scene": copy.deepcopy(SCENE)
        }
        for path, value in changes:
            at(path, value)(tables)
        for name, table in tables.items():
            (tmp_path / f"{name}.toml").write_text(tomli_w.dumps(table))
        return main(["design", "project.toml", "--output", "out"]), capsys.readouterr()

    return run


@pytest.mark.parametrize("kind", SOUND)
def test_work_begins_on_a_sound_project(kind, designed):
    with pytest.raises(Reached):
        designed(kind, [])


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_one_line_before_anything_is_solved(fault, designed, tmp_path):
    kind, changes, words = FAULTS[fault]
    status, said = designed(kind, changes)
    assert status == 2 and said.out == "", said
    assert said.err.startswith("hakobune design: ") and said.err.count("\n") == 1, said.err
    assert all(word in said.err for word in words), said.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["box.h5", "project.toml", "scene.toml", "study.toml"]


FULL = {"curve": "DNV studless chain", "factor": 1.0}
AT_THE_LIMIT = {
    "shares of all time": [(storm("share"), 0.4), (project("states", 1, "share"), 0.6)],
    "probability": [(project("project", "probability"), 0.999)],
    "wear of its own years": [
        (project("wear"), {"mm_per_year": 0.0, "years": 9.0}), (project("limits"), [{**LIMIT, "quantity": WORN}]),
        *UNTIMED,
    ],
    "fatigue of a share": [(project("fatigue"), FULL), (storm("share"), 0.1)],
    "a line that reaches": [(study("lines", 0, "length"), 254.0)],
}  # fmt: skip


@pytest.mark.parametrize("name", AT_THE_LIMIT)
def test_up_to_its_limits_a_project_is_worked_on(name, designed):
    with pytest.raises(Reached):
        designed("lines", AT_THE_LIMIT[name])


def test_a_file_of_a_simulation_lies_beside_the_project(designed, tmp_path):
    """Studies of load cases, which name it, lie in another folder"""
    force = (project("simulation", "force"), [{"file": "tug.csv"}])
    (tmp_path / "tug.csv").write_text("t,Fx,Fy,Fz,Mx,My,Mz\n0,1e5,0,0,0,0,0\n1000,1e5,0,0,0,0,0\n")
    with pytest.raises(Reached):
        designed("lines", [force])
    read = read_project(tmp_path / "project.toml")
    assert read.raw["simulation"]["force"] == [{"file": str(tmp_path / "tug.csv")}]


def test_a_quay_stands_in_the_load_cases_of_its_berth():
    """It stands still where the water rises"""
    box = SCENE["bodies"][0]
    sizes = {name: box[name] for name in ("length", "beam", "draft")}
    water = {"density": 1025.0, "gravity": 9.80665}
    body = SimpleNamespace(dimensions=sizes, sizes=sizes, rotation_center=np.zeros(3), bodies=(), **water)
    base = mooring.base({**BERTH, "quay": {"y": 30.0}}, body)
    assert mooring.at(base, 21.5, {})["quay"] == {"y": 30.0}


def test_a_scene_of_several_bodies_gives_their_sizes_unless_a_mesh_has_them():
    box = {"shape": "box", "length": 20.0, "beam": 6.0, "draft": 2.0}
    bodies = [{**box, "name": "ship", "place": [0.0, 5.0, 0.0]}, {**box, "name": "barge", "place": [0.0, -5.0, 0.0]}]
    scene = make_scene({"water": {"depth": 12.0}, "bodies": bodies, "waves": {"periods": [6.0], "headings_deg": [0.0]}})
    body = body_of_scene("two.toml", scene)
    assert [(one.name, one.place) for one in body.bodies] == [("ship", (0.0, 5.0)), ("barge", (0.0, -5.0))]
    sizes = {"length": 20.0, "beam": 6.0, "draft": 2.0}
    assert body.boxes == {"ship": sizes, "barge": sizes}
    assert body.words[::6] == ("ship surge", "barge surge") and body.ring is None
    buoy = {"name": "buoy", "shape": "buoy", "radius": 2.0, "draft": 3.0, "place": [0.0, -5.0, 0.0]}
    found = moor_checked._box("two.toml", SimpleNamespace(name="buoy"), buoy)
    assert {name: found[name] for name in ("length", "beam", "draft", "radius")} == {
        "length": 4, "beam": 4, "draft": 3, "radius": 2,
    }  # fmt: skip
    with pytest.raises(
        StudyError, match=r"two.toml: the size of hull is known once its mesh file is solved; solve the"
    ):
        moor_checked._box("two.toml", SimpleNamespace(name="hull"), {})
