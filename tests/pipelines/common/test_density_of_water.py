"""The density of water in t/m³, 1.025 for 1025 kg/m³: every study that has a density refuses it in one line."""

import tomllib
from pathlib import Path

import pytest

import hakobune
from hakobune import pipelines

SCENES = Path(pipelines.__file__).parent / "scenes"
STUDIES = [
    ("berth", "berth_tanker.toml", "ship"), ("breakwater", "breakwater_rectangle.toml", "water"),
    ("lines", "lines_barge.toml", "water"), ("line_dynamics", "line_chain_60m.toml", "water"),
    ("members", "members_dolphin.toml", "water"), ("passing", "passing_tanker.toml", "water"),
]  # fmt: skip


@pytest.mark.parametrize("command, scene, table", STUDIES, ids=lambda text: text[:13])
@pytest.mark.parametrize("density", [1.025, 899.0, 1301.0])
def test_a_density_that_no_water_has_is_refused(command, scene, table, density):
    study = tomllib.loads((SCENES / scene).read_text(encoding="utf-8"))
    study[table] = study.get(table, {}) | {"density": density}
    with pytest.raises(ValueError, match=rf"{table}\.density is {density:g}; allowed: 900 to 1300 kg/m³, as for water"):
        getattr(hakobune, command)(study)
