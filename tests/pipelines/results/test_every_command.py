"""Every command in a pipe of 40 columns gives the quantities of its function, to the bit: CSV, JSON and file."""

import csv
import io
import json
import shlex

import numpy as np
import pytest

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES

COMMANDS = {  # words: what the function of the same name makes of the same input
    "fender --family cell --height 2 --angle 8 --width 2.4 --dolphin 14000 --energy 900": lambda: hakobune.fender(
        {"family": "cell", "height": 2.0, "angle_deg": 8.0, "width": 2.4, "dolphin": 14000.0}, energy=9e5
    ),
    f"berth {SCENES / 'berth_tanker.toml'}": lambda: hakobune.berth(SCENES / "berth_tanker.toml"),
    f"members {SCENES / 'members_dolphin.toml'}": lambda: hakobune.members(SCENES / "members_dolphin.toml"),
    f"earthquake {SCENES / 'earthquake_box.toml'}": lambda: hakobune.earthquake(SCENES / "earthquake_box.toml"),
    "sections --beam-draft 5 --depth-draft 2,3 --xi 0.5,1": lambda: hakobune.sections(
        beam_draft=[5.0], depth_draft=[2.0, 3.0], xi=[0.5, 1.0]
    ),
    "damping decay.csv --mass 2000": lambda: hakobune.damping("decay.csv", mass=2e6),
}


@pytest.fixture(autouse=True)
def _inputs(tmp_path, monkeypatch):
    """An empty folder with a record of a decay"""
    monkeypatch.chdir(tmp_path)
    t = np.arange(0.0, 400.0)
    rows = np.stack([t, 2.0 * np.exp(-0.004 * t) * np.cos(0.125 * t)], axis=1)
    np.savetxt("decay.csv", rows, delimiter=",", header="time_s,motion_m", comments="")


def same(found, kept):
    """Whether numbers as JSON and CSV have them are those of a quantity"""
    flat = np.array([np.nan if value in (None, "") else value for value in np.ravel(np.array(found, object))], float)
    numbers = np.where(np.isfinite(kept.values), kept.values, np.nan)
    return np.array_equal(flat, np.ravel(numbers), equal_nan=True)


def columns(text):
    """{name without unit: [cells]} of CSV, names of one value likewise"""
    found = {}
    for block in text.strip().split("\n\n"):
        head, *rows = csv.reader(io.StringIO(block))
        if head == ["quantity", "value", "unit"]:
            found |= {name: [value] for name, value, _ in rows}
        else:
            found |= {name.rpartition(" [")[0] or name: [row[k] for row in rows] for k, name in enumerate(head) if k}
    return found


@pytest.mark.parametrize("words", COMMANDS)
def test_csv_json_and_file_of_a_command_have_the_quantities_of_its_function(words, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "40")
    made, printed = COMMANDS[words](), {}
    for form in ("csv", "json"):
        assert main([*shlex.split(words), f"--{form}"]) == made.status
        printed[form] = capsys.readouterr().out
    document, cells = json.loads(printed["json"]), columns(printed["csv"])
    kept = {name: one for name, one in made.quantities.items() if not one.record}
    assert list(document["quantities"]) == list(kept)
    for name, one in kept.items():
        values = document["quantities"][name]["values"]
        if one.values.dtype.kind in "fi":
            assert same(values, one), name
            assert one.values.ndim > 1 or same(cells[name], one), name
        elif one.values.dtype.kind == "U":
            assert np.array_equal(values, one.values), name
    made.write(tmp_path / "a.h5")
    assert hakobune.read(tmp_path / "a.h5") == made
