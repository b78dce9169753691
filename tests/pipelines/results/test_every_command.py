"""Each command in a pipe of 40 columns: CSV, JSON and files have the quantities of its function, to the bit."""

import csv
import io
import json
import math
import shlex
import shutil

import numpy as np
import pytest
import xarray

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.results.tables import tables

LINE = "line --type 'R3 studless 76 mm' --length 300 --depth 60 --tension 300 --characteristic"
COMMANDS = {  # words: what the function of the same name makes of the same input
    "fender --family cell --height 2 --angle 8 --width 2.4 --dolphin 14000 --energy 900": lambda: hakobune.fender(
        {"family": "cell", "height": 2.0, "angle_deg": 8.0, "width": 2.4, "dolphin": 14000.0}, energy=9e5
    ),
    "berth berth_tanker.toml": lambda: hakobune.berth("berth_tanker.toml"),
    "members members_dolphin.toml": lambda: hakobune.members("members_dolphin.toml"),
    "earthquake earthquake_box.toml": lambda: hakobune.earthquake("earthquake_box.toml"),
    "sections --beam-draft 5 --depth-draft 2,3 --xi 0.5,1": lambda: hakobune.sections(
        beam_draft=[5.0], depth_draft=[2.0, 3.0], xi=[0.5, 1.0]
    ),
    "damping decay.csv --mass 2000": lambda: hakobune.damping("decay.csv", mass=2e6),
    "sea --height 3 --mean-period 8 --record waves.csv --duration 600 --components 60 --direction 30": lambda: (
        hakobune.sea(
            {"height": 3.0, "mean_period": 8.0}, record={"duration": 600.0, "components": 60, "direction": 30.0}
        )
    ),
    LINE: lambda: hakobune.line(type="R3 studless 76 mm", length=300.0, depth=60.0, tension=3e5, characteristic=True),
    "lines lines_barge.toml --characteristic stern --offset 2 --direction 30 --broken": lambda: hakobune.lines(
        "lines_barge.toml", characteristic="stern", offset=2.0, directions=[np.radians(30.0)], broken=True
    ),
    "line-dynamics line_chain_60m.toml --duration 20": lambda: hakobune.line_dynamics(
        "line_chain_60m.toml", duration=20.0
    ),
    "single-point single_point_A.toml": lambda: hakobune.single_point("single_point_A.toml"),
    "site site_bay.toml --output site.h5": lambda: hakobune.site("site_bay.toml"),
    "breakwater breakwater_circle.toml": lambda: hakobune.breakwater("breakwater_circle.toml"),
}
KEPT = ("lines", "line-dynamics", "single-point", "breakwater")  # write a result as .h5 and as .csv


@pytest.fixture(autouse=True)
def _inputs(tmp_path, monkeypatch):
    """A folder with our studies and a record of a decay, in a pipe of 40 columns"""
    monkeypatch.setenv("COLUMNS", "40")
    monkeypatch.chdir(tmp_path)
    for name in (word.removesuffix(".toml") for words in COMMANDS for word in words.split() if word.endswith(".toml")):
        for path in SCENES.glob(f"{name}.*"):
            shutil.copy(path, tmp_path)
    t = np.arange(0.0, 400.0)
    rows = np.stack([t, 2.0 * np.exp(-0.004 * t) * np.cos(0.125 * t)], axis=1)
    np.savetxt("decay.csv", rows, delimiter=",", header="time_s,motion_m", comments="")


@pytest.mark.parametrize("words", COMMANDS)
def test_csv_json_and_files_of_a_command_have_the_quantities_of_its_function(words, tmp_path, capsys):
    made, said = COMMANDS[words](), {}
    kept = words.split()[0] in KEPT
    for form, file in (("csv", "found.csv"), ("json", "found.h5")):
        assert main([*shlex.split(words), f"--{form}", *(["--output", file] if kept else [])]) == made.status
        said[form] = capsys.readouterr().out
    document = json.loads(said["json"])["quantities"]
    assert list(document) == [name for name, one in made.quantities.items() if not one.record]
    for name, one in document.items():
        assert _alike(one["values"], made.quantities[name].values.tolist()), name
    _check_csv(said["csv"], made)
    if kept:
        lines = (tmp_path / "found.csv").read_text().splitlines(keepends=True)
        _check_csv("".join(line for line in lines if line[0] != "#"), made)
        assert main(["check", "found.csv"]) == 0
    else:
        made.write("found.h5")
    found = hakobune.read("found.h5")
    assert found.quantities == made.quantities and found.labels == made.labels and found.told == made.told
    with xarray.open_dataset("found.h5", engine="h5netcdf") as data:
        assert set(made) <= set(data.variables) and set(data.dims) == set(made.labels)
        for name, one in made.quantities.items():
            assert data[name].dims == one.axes and np.array_equal(data[name].values, one.values, one.numeric), name


def _check_csv(text, made):
    """All numbers of a result stand in CSV, under the names of their tables"""
    rows = [row for row in csv.reader(io.StringIO(text)) if row]
    assert rows == [row for row in csv.reader(io.StringIO(made.to_csv())) if row]
    cells = [cell for row in rows for cell in row]
    numbers = {float(cell) for cell in cells if _number(cell)}
    for column in (column for shown in tables(made, True) for column in shown.columns):
        assert any(column.name in cell for cell in cells), column.name
        wanted = [value for value in column.values.tolist() if isinstance(value, float) and math.isfinite(value)]
        assert set(wanted) <= numbers, column.name


def _alike(one, other):
    """Whether values of a document are those of a file; what is not finite is null there"""
    if isinstance(other, list):
        return len(one) == len(other) and all(map(_alike, one, other))
    if isinstance(other, complex):
        return _alike(one, [other.real, other.imag])
    return one is None if isinstance(other, float) and not math.isfinite(other) else one == other


def _number(cell):
    try:
        float(cell)
    except ValueError:
        return False
    return True
