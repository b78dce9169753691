"""Cases of commands swept, and the same commands alone: equal to the bit, close values apart.

Berths are in `test_sweep.py`.
"""

import contextlib
import io
import tomllib

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.pipelines.keys.kinds import SCENES

CHEAP = {"duration_hours": 0.1, "seeds": 1, "memory": "constant", "dynamic_lines": "none", "qtf": "newman"}
SWEPT = {  # command: study, changes of its tables, key, two close values
    "line-dynamics": ("line_chain_60m", {"duration": 20.0}, "current.speed_knots", (1.0, 1.0001)),
    "single-point": ("single_point_A", {}, "wind.speed", (25.0, 25.0001)),
    "breakwater": ("breakwater_circle", {"sea": None, "measured": None}, "waves.height", (3.0, 3.00001)),
    "passing": ("passing_tanker", {"method": "wang"}, "track.distance", (110.0, 110.001)),
    "lines": ("lines_barge", {}, "bodies[0].force_kN[0]", (120.0, 120.001)),
}
OF_A_BODY = {
    "moor": ("moor_chain_12", {}, "waves.height", (2.0, 2.00001)),
    "response": ("response_box_20m", {}, "sea.height", (4.5, 4.50001)),
    "simulate": ("simulate_chain_12", {"simulation": CHEAP}, "waves.height", (2.0, 2.00001)),
}
SCENE = {
    "tolerance": 0.01,
    "water": {"depth": 20.0},
    "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.6, 29.4, 32.3]}],
    "waves": {"periods": {"from": 4.0, "to": 60.0, "count": 16}, "headings_deg": {"from": 0, "to": 330, "count": 12}},
}


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    path = tmp_path_factory.mktemp("box") / "box.h5"
    with contextlib.redirect_stdout(io.StringIO()):
        hakobune.solve(SCENE, path)
    return path


def tables(name, changed):
    raw = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8")) | changed
    return {table: value for table, value in raw.items() if value is not None}


def placed(raw, key, value):
    """The tables with a value at a key, as "waves.height" or "lines[0].length"."""
    *parts, last = key.replace("[0]", ".0").split(".")
    place = raw
    for part in parts:
        place = place[int(part) if part.isdigit() else part]
    place[int(last) if last.isdigit() else last] = value
    return raw


def compare(found, alone):
    """Every number of the command alone is in the sweep, to the bit; whether any differs between the two cases"""
    apart = []
    for case, one in enumerate(alone):
        shared = [name for name in one.quantities if name in found.quantities and one.quantities[name].numeric]
        assert shared
        for name in shared:
            assert np.array_equal(found[name][case], one[name], equal_nan=True), name
            apart.append(not np.array_equal(found[name][0], found[name][1], equal_nan=True))
    return any(apart)


def swept(command, raw, key, values, arguments=()):
    sweep = {"command": command, "study": "study.toml", "vary": [{"key": key, "values": list(values)}]}
    for file, content in (("study", raw), ("sweep", sweep | {"arguments": [*map(str, arguments)]})):
        with open(f"{file}.toml", "wb") as written:
            tomli_w.dump(content, written)
    return hakobune.sweep("sweep.toml", "all.h5")


@pytest.mark.parametrize("command", SWEPT)
def test_a_case_has_what_the_command_alone_has(command, tmp_path, monkeypatch):
    name, changed, key, values = SWEPT[command]
    monkeypatch.chdir(tmp_path)
    raw = tables(name, changed)
    if command == "breakwater":
        raw["waves"]["periods"]["count"] = 3
    found = swept(command, raw, key, values)
    run = getattr(hakobune, command.replace("-", "_"))
    assert compare(found, [run(placed(raw, key, value)) for value in values])


@pytest.mark.parametrize("command", OF_A_BODY)
def test_a_case_of_a_body_has_what_the_command_alone_has(command, tmp_path, monkeypatch, box):
    name, changed, key, values = OF_A_BODY[command]
    monkeypatch.chdir(tmp_path)
    raw = tables(name, changed)
    found = swept(command, raw, key, values, ("--database", box))
    alone = [getattr(hakobune, command)(placed(raw, key, value), box) for value in values]
    assert compare(found, alone)


def test_a_case_of_a_scene_has_what_the_scene_alone_has(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = SCENE | {"waves": {"omegas": [0.5, 0.9], "headings_deg": [0.0]}}
    depths = (20.0, 20.001)
    found = swept("solve", scene, "water.depth", depths)
    for case, depth in enumerate(depths):
        hakobune.solve(placed(scene, "water.depth", depth), f"{case}.h5")
        alone = hakobune.open_database(f"{case}.h5")
        for name in ("added_mass", "radiation_damping", "excitation_force", "rao"):
            assert np.array_equal(found[name][case], alone[name], equal_nan=True), name
    assert not np.array_equal(found["added_mass"][0], found["added_mass"][1])
