"""Each command in a pipe of 40 columns: --csv, --json and its file have the same quantities, to the bit."""

import csv
import io
import json
import math
import shlex
import shutil
from pathlib import Path

import pytest

from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.results.file import read
from hakobune.pipelines.results.tables import tables

COMMANDS = {
    "line": "line --type 'R3 studless 76 mm' --length 300 --depth 60 --tension 300 --characteristic",
    "lines": "lines lines_barge.toml --characteristic stern --offset 2 --direction 30 --broken",
    "line-dynamics": "line-dynamics line_chain_60m.toml --duration 20",
    "single-point": "single-point single_point_A.toml",
    "site": "site site_bay.toml",
    "breakwater": "breakwater breakwater_circle.toml",
}


@pytest.mark.parametrize("command", COMMANDS)
def test_csv_json_and_file_of_a_command_have_the_same_quantities_to_the_bit(command, tmp_path, monkeypatch, capsys):
    words = shlex.split(COMMANDS[command])
    monkeypatch.setenv("COLUMNS", "40")
    monkeypatch.chdir(tmp_path)
    for name in (Path(word).stem for word in words if word.endswith(".toml")):
        for path in SCENES.glob(f"{name}.*"):
            shutil.copy(path, tmp_path)
    said = {}
    for form in ("csv", "json"):
        assert main([*words, "--output", "found.h5", f"--{form}"]) in (0, 1)
        said[form] = capsys.readouterr().out
    result = read("found.h5")
    document = json.loads(said["json"])
    assert document["quantities"].keys() == {name for name, one in result.quantities.items() if not one.record}
    for name, made in document["quantities"].items():
        assert _alike(made["values"], result.quantities[name].values.tolist()), name
    cells = [row for row in csv.reader(io.StringIO(said["csv"])) if row]
    assert cells == [row for row in csv.reader(io.StringIO(result.to_csv())) if row]
    numbers = [float(cell) for row in cells for cell in row if _number(cell)]
    for column in (column for shown in tables(result, True) for column in shown.columns):
        wanted = [value for value in column.values.tolist() if isinstance(value, float) and math.isfinite(value)]
        assert set(wanted) <= set(numbers), column.name


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
