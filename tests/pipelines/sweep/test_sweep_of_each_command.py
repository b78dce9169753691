"""Cases of commands swept, and the same commands alone: equal to the bit, close values apart.

Berths are in `test_sweep.py`; bodies of a database and passages, which take longer, are run by the same function.
"""

import tomllib

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.pipelines.keys.kinds import SCENES

SWEPT = {  # command: study, changes of its tables, key, two close values
    "line-dynamics": ("line_chain_60m", {"duration": 20.0}, "current.speed_knots", (1.0, 1.0001)),
    "single-point": ("single_point_A", {}, "wind.speed", (25.0, 25.0001)),
    "breakwater": ("breakwater_circle", {"sea": None}, "waves.height", (3.0, 3.00001)),
}


@pytest.mark.parametrize("command", SWEPT)
def test_a_case_has_what_the_command_alone_has(command, tmp_path, monkeypatch):
    name, changed, key, values = SWEPT[command]
    monkeypatch.chdir(tmp_path)
    raw = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8")) | changed
    raw = {table: value for table, value in raw.items() if value is not None}
    if command == "breakwater":
        raw["waves"]["periods"]["count"] = 3
        raw.pop("measured", None)
    sweep = {"command": command, "study": "study.toml", "vary": [{"key": key, "values": list(values)}]}
    for file, tables in (("study", raw), ("sweep", sweep)):
        (tmp_path / f"{file}.toml").write_text(tomli_w.dumps(tables))
    found, apart = hakobune.sweep("sweep.toml", "all.h5"), []
    *tables, last = key.split(".")
    place = raw
    for table in tables:
        place = place[table]
    for case, value in enumerate(values):
        place[last] = value
        alone = getattr(hakobune, command.replace("-", "_"))(raw)
        shared = [one for one in alone.quantities if one in found.quantities and alone.quantities[one].numeric]
        assert shared
        for one in shared:
            assert np.array_equal(found[one][case], alone[one], equal_nan=True), one
            apart.append(not np.array_equal(found[one][0], found[one][1], equal_nan=True))
    assert any(apart)
