"""A study is read once and checked whole: with one thing wrong in it, it is refused before anything is solved.

Every fault is one change of a study that comes with the program; the command ends with 2, in one line that names the
thing and what is allowed, and leaves no file.
"""

import copy
import shutil
import tomllib

import pytest
import tomli_w

from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

SCENE = {
    "water": {"depth": 20.0},
    "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.5, 29.4, 32.3]}],
    "waves": {"periods": [4, 5, 6, 7, 8, 10, 12, 15, 20, 30, 60], "headings_deg": [0, 30, 60, 90]},
    "method": "contour",
    "tolerance": 0.02,
}
ON_BOX = ["--database", "box.h5"]
COMMANDS = {  # command: study, words behind it, what may not be reached
    "moor": ("moor_chain_12", [*ON_BOX, "--output", "out.h5"], "mooring.studies.multi_point.rest"),
    "simulate": ("simulate_chain_12", [*ON_BOX, "--output", "out.h5"], "mooring.motion.simulation.moored"),
    "simulate berth": ("simulate_dolphins", [*ON_BOX, "--output", "out.h5"], "mooring.motion.simulation.moored"),
    "response": ("response_box_20m", [*ON_BOX, "--output", "out.csv"], "mooring.response.viscous.in_sea"),
    "response --moored": (
        "response_box_20m",
        [*ON_BOX, "--moored", "moored.toml", "--output", "out.csv"],
        "mooring.studies.multi_point.multi_point",
    ),
    "lines": ("lines_barge", ["--output", "out.csv"], "mooring.lines.system.equilibrium.rest"),
    "line-dynamics": ("line_chain_60m", ["--output", "out.h5"], "mooring.lines.dynamics.simulation.simulate"),
    "single-point": ("single_point_barge", [*ON_BOX, "--output", "out.h5"], "mooring.single_point.equilibria.zeros"),
    "berth": ("berth_tanker", ["--output", "out.csv"], "mooring.berthing.energy.berthing_energy"),
    "breakwater": ("breakwater_rectangle", ["--output", "out.h5"], "mooring.studies.breakwater.results.curves"),
    "site": ("site_bay", ["--output", "out.toml"], "pipelines.site.study.extreme_state"),
    "sweep": ("sweep_berth", ["--output", "out.h5"], "pipelines.sweep.run.one_case"),
}
STRETCH = {"elongation_percent": [0, 1], "tension_kN": [0.0]}
# command, path in the study, value (... for none), words that the line must have: the thing and what is allowed
FAULTS = {
    "type of a spread": ("moor", ("spreads", 0, "type"), "chian", ("spreads[0].type is 'chian'", "chain_142")),
    "type of no line": ("moor", ("types", "x"), {"catalogue": "R9 9 mm"}, ("types.x.catalogue: 'R9 9 mm'", "R3")),
    "ship of the wind": ("moor", ("wind", "ship"), "tankr", ("wind.ship is 'tankr'", "tanker, loaded")),
    "file of the current": ("moor", ("current", "file"), "c.csv", ("c.csv does not exist",)),
    "carried waves": ("moor", ("current", "waves"), "moving", ("current.waves is 'moving'", "intrinsic")),
    "method": ("moor", ("waves", "method"), "regular", ("waves.method is 'regular'", "regular_wave")),
    "site of a study": ("moor", ("site",), {"file": "bay.toml"}, ("bay.toml does not exist",)),
    "fender beside lines": (
        "moor", ("dolphin",), [{"name": "D1", "stiffness": 1e4}], ("one body does not support [[fender]]", "simulate"),
    ),
    "gusts": ("simulate", ("wind", "gusts"), "davenprt", ("wind.gusts is 'davenprt'", "davenport, hino")),
    "line that is lost": (
        "simulate", ("simulation", "lines_lost"), [{"line": "bow", "time": 1.0}],
        ("there is no line 'bow'", "fore port"),
    ),
    "line that moves": (
        "simulate", ("simulation", "dynamic_lines"), ["bow"], ("dynamic_lines: there is no line 'bow'", "fore port"),
    ),
    "word for lines": ("simulate", ("simulation", "dynamic_lines"), "some", ("dynamic_lines is 'some'", '"auto"')),
    "damped motion": (
        "simulate", ("simulation", "damping_ratio"), {"rol": 0.1}, ("damping_ratio.rol is unknown", "roll"),
    ),
    "quadratic damping": (
        "simulate", ("simulation", "quadratic_damping"), {"swai": 1.0}, ("no motion 'swai'", "sway"),
    ),
    "pairs": ("simulate", ("simulation", "qtf"), "ful", ("simulation.qtf is 'ful'", "full")),
    "force": ("simulate", ("simulation", "force"), [{"file": "tug.csv"}], ("tug.csv",)),
    "quay": ("simulate", ("quay",), {"y": 30.0, "method": "far"}, ("quay.method is 'far'", "far-field, panels")),
    "panels of a quay": (
        "simulate", ("quay",), {"y": 30.0, "method": "panels"}, ("box.h5 is of open water", "--wall 30"),
    ),
    "dolphin": ("simulate berth", ("fender", 0, "on"), "D9", ("no dolphin 'D9'", "none is given")),
    "family": ("simulate berth", ("fender", 0, "family"), "cel", ("'cel' is unknown", "cell, v, h")),
    "name of two fenders": ("simulate berth", ("fender", 1, "name"), "port 1", ("'port 1' is the name of two", "own")),
    "harbour": ("simulate berth", ("harbour",), {"periods": [0.0]}, ("harbour.periods[0] is 0", "above 0")),
    "spectrum of a response": ("response", ("sea", "spectrum"), "isc", ("sea.spectrum is 'isc'", "issc")),
    "pairs of a response": ("response", ("sea", "qtf"), "ful", ("sea.qtf is 'ful'", "bound-wave, body, full")),
    "damping of a response": (
        "response", ("body", "damping_ratio"), {"rol": 0.1}, ("body.damping_ratio.rol is unknown", "roll"),
    ),
    "law of a response": ("response", ("body", "viscous"), {"roll": "Yamasita"}, ("'Yamasita'", "Yamashita")),
    "current of a moored response": (
        "response --moored", ("current",), {"speed": 1.0, "incidence_deg": 0.0},
        ("current is given with --moored", "leave it out: moored.toml gives the current"),
    ),
    "law of a moored response": (
        "response --moored", ("body", "viscous"), {"roll": "Yamasita"}, ("'Yamasita'", "Yamashita"),
    ),
    "pairs of a moored response": ("response --moored", ("sea", "qtf"), "full", ("sea.qtf is 'full'", "newman")),
    "name of two points": ("response", ("points", 1, "name"), "bow", ("two points are called 'bow'", "its own name")),
    "duration of a response": ("response", ("sea", "duration_hours"), 0.0, ("sea.duration_hours is 0", "above 0")),
    "file of a sea": (
        "response", ("sea", "swell"), [{"file": "x.sp2", "direction_deg": 0.0}], ("x.sp2",),
    ),
    "end of a line": ("lines", ("lines", 1, "to"), "port bov", ("port bov", "port bow")),
    "body of a fairlead": ("lines", ("fairleads", 0, "body"), "barg", ("barg", "barge")),
    "type of a segment": (
        "lines", ("lines", 0, "segments", 0, "type"), "chian", ("segments[0].type is 'chian'", "chain"),
    ),
    "motion of a body": ("lines", ("bodies", 0, "freedom"), ["Surg"], ("Surg", "Surge")),
    "joint of a body": (
        "lines", ("lines", 0, "bodies", 0, "after_segment"), 9, ("after_segment is 9", "allowed: 1 to 3"),
    ),
    "type of a moving line": ("line-dynamics", ("segments", 0, "type"), "chian", ("'chian'", "allowed: chain")),
    "table of a fairlead": (
        "line-dynamics", ("fairlead",), {"table": "motion.csv"}, ("motion.csv",),
    ),
    "anchor under the bed": ("line-dynamics", ("anchor", 2), -70.0, ("anchor is at z = -70", "allowed: -60")),
    "rope of a moving line": ("line-dynamics", ("types", "chain", "catalogue"), "R9 76 mm", ("'R9 76 mm'", "R3")),
    "type at a single point": ("single-point", ("mooring", "type"), "chian", ("mooring.type is 'chian'", "chain")),
    "coefficients at a single point": (
        "single-point", ("current", "turning"), {"beam_over_draft": 90.0}, ("current", "beam_over_draft = 10"),
    ),
    "ship at a single point": (
        "single-point", ("wind",), {"speed": 9.0, "incidence_deg": 0.0, "ship": "tankr"}, ("'tankr'", "tanker, loaded"),
    ),
    "scheme": ("single-point", ("slewing", "scheme"), "fast", ("slewing.scheme is 'fast'", "two_scale")),
    "waves at a single point": ("single-point", ("waves", "spectrum"), "isc", ("waves.spectrum is 'isc'", "issc")),
    "key of a map": (
        "single-point", ("maps",), [{"x": {"key": "hawser.lenth", "from": 1.0, "to": 2.0}}], ("hawser.lenth",),
    ),
    "virtual mass": ("berth", ("approach", "virtual_mass"), "ued", ("'ued'", "ueda, vasco_costa")),
    "family at a berth": ("berth", ("fender", 0, "family"), "vv", ("family 'vv' is unknown", "cell, v")),
    "table of a fender": (
        "berth", ("fender", 0), {"table": "f.csv", "height": 1.0}, ("f.csv",),
    ),
    "holding": ("breakwater", ("holdings",), ["tight"], ("holdings has 'tight'", "fixed")),
    "theory": ("breakwater", ("theories",), ["flow"], ("theories has 'flow'", "potential flow")),
    "design": ("breakwater", ("design", "holding"), "tight", ("design.holding is 'tight'", "fixed, free")),
    "measured": ("breakwater", ("measured",), "m.csv", ("m.csv",)),
    "anchor's kind": ("breakwater", ("anchors", "sinker", "frction"), 0.5, ("frction is unknown", "friction")),
    "sea at a breakwater": ("breakwater", ("sea", "spectrum"), "isc", ("sea.spectrum is 'isc'", "issc")),
    "map without a database": ("breakwater", ("map",), {"period": 6.0}, ("has a [map]", "give --database")),
    "rule of an earthquake": ("site", ("earthquake", "rule"), "Z", ("'Z'", "A, C, E")),
    "factor of a rule": ("site", ("earthquake", "factors"), {"grund": 1.0}, ("grund",)),
    "family of extremes": ("site", ("wind", "family"), "gumble", ("'gumble'", "gumbel")),
    "file of maxima": ("site", ("waves",), {"file": "w.csv", "period": 7.0}, ("w.csv",)),
    "scatter": ("site", ("climate",), {"scatter": "s.csv"}, ("s.csv",)),
    "command of a sweep": ("sweep", ("command",), "bert", ("command is 'bert'", "berth")),
    "key of a sweep": ("sweep", ("vary", 0, "key"), "approach.sped", ("approach.sped is unknown", "speed")),
    "table of a sweep": (
        "sweep", ("vary", 1, "key"), "fender[3].dolphin", ("no table for the key 'fender[3].dolphin'",),
    ),
    "study of a sweep": ("sweep", ("study",), "b.toml", ("study is 'b.toml'", "no such file")),
    "argument of a sweep": ("sweep", ("arguments",), ["--database", "none.h5"], ("none.h5 does not exist",)),
}  # fmt: skip


class Reached(BaseException):
    """Work began"""


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    path = tmp_path_factory.mktemp("box") / "box.h5"
    solve(make_scene(SCENE), path)
    return path


@pytest.fixture
def asked(box, tmp_path, monkeypatch, capsys):
    """Runs a command on its study with a change, where no work may begin; gives its status and what it says"""

    def reached(*_, **__):
        raise Reached

    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.h5").symlink_to(box)
    for name in ("berth_tanker.toml", "breakwater_rectangle.csv"):
        shutil.copy(SCENES / name, tmp_path)
    shutil.copy(SCENES / "moor_chain_12.toml", tmp_path / "moored.toml")

    def run(command, path, value):
        name, words, work = COMMANDS[command]
        study = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
        put(study, path, value)
        (tmp_path / "study.toml").write_text(tomli_w.dumps(study))
        monkeypatch.setattr(f"hakobune.{work}", reached)
        before = sorted(one.name for one in tmp_path.iterdir())
        status = main([command.split()[0], "study.toml", *words])
        assert sorted(one.name for one in tmp_path.iterdir()) == before
        return status, capsys.readouterr()

    return run


def put(tables, path, value):
    """Put a value, or with ... nothing, at a path; nothing is done without one"""
    if not path:
        return
    *way, last = path
    for step in way:
        tables = tables.setdefault(step, {}) if isinstance(tables, dict) else tables[step]
    if value is ...:
        del tables[last]
    else:
        tables[last] = copy.deepcopy(value)


@pytest.mark.parametrize("command", COMMANDS)
def test_work_begins_on_a_sound_study(command, asked):
    with pytest.raises(Reached):
        asked(command, (), None)


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_one_line_before_anything_is_solved(fault, asked):
    command, path, value, words = FAULTS[fault]
    status, said = asked(command, path, value)
    assert status == 2 and said.out == "", said
    assert said.err.startswith(f"hakobune {command.split()[0]}: ") and said.err.count("\n") == 1, said.err
    assert all(word in said.err for word in words), said.err
