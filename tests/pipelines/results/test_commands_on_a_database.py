"""Studies on a database in a pipe of 40 columns: JSON, CSV and file have the quantities of the function, to the bit."""

import json
import re

import numpy as np
import pytest

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --method contour --gyration 15.6,29.4,32.3 --heading 0:330:12"
STUDIES = {"moor": "moor_chain_12", "response": "response_box_20m"}


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("box") / "box.h5"
    assert main([*BOX.split(), "--omega", "0.2:1.6:29", "--output", str(path)]) in (0, 1)
    return path


@pytest.mark.parametrize("command", STUDIES)
def test_json_csv_and_file_of_a_study_have_the_quantities_of_its_function(
    command, database, tmp_path, monkeypatch, capsys
):
    monkeypatch.setenv("COLUMNS", "40")
    study = SCENES / f"{STUDIES[command]}.toml"
    made, printed = getattr(hakobune, command)(study, database), {}
    for form, file in (("csv", tmp_path / "found.csv"), ("json", tmp_path / "found.h5")):
        words = [command, str(study), "--database", str(database), "--output", str(file)]
        assert main([*words, f"--{form}"]) == made.status
        printed[form] = capsys.readouterr().out
    found = json.loads(printed["json"])["quantities"]
    numbers = {cell for cell in re.split(r"[,\n]", printed["csv"]) if re.match(r"-?\d", cell)}
    for name, one in made.quantities.items():
        if one.record:
            assert name not in found
            continue
        values = np.array(found[name]["values"], float) if one.numeric else np.array(found[name]["values"])
        finite = np.where(np.isfinite(one.values), one.values, np.nan) if one.numeric else one.values
        assert np.array_equal(values, finite, equal_nan=one.numeric), name
        if one.numeric:
            assert {repr(value) for value in one.values[np.isfinite(one.values)].tolist()} <= numbers, name
    lines = (tmp_path / "found.csv").read_text().splitlines(keepends=True)
    assert "".join(line for line in lines if line[0] != "#") == made.to_csv() == printed["csv"]
    assert main(["check", str(tmp_path / "found.csv")]) == 0
    found = hakobune.read(tmp_path / "found.h5")
    assert found.quantities == made.quantities and found.told == made.told
