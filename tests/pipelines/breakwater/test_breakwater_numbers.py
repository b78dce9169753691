"""Pretension, tide and anchors that `hakobune breakwater` prints of a rectangle, by hand."""

import json

import h5py
import numpy as np
import pytest

from hakobune.pipelines.cli import main

RHO, G, BEAM, DRAFT, FREE, TIDE, ANGLE = 1025.0, 9.80665, 10.0, 5.0, 3.4, 0.5, np.radians(60)
STUDY = f"""
holdings = ["taut"]
theories = ["long waves"]
[water]
depth = 10.0
tide = {TIDE}
density = {RHO}
gravity = {G}
[section]
shape = "rectangle"
beam = {BEAM}
height = 6.7
draft = {DRAFT}
[body]
free_draft = {FREE}
center_of_gravity = 3.4
gyration = 4.4
[lines]
angle_deg = 60.0
attachment = 5.0
spacing = 4.0
allowable_kN = 3000.0
[waves]
height = 0.5
periods = [6.0, 8.0, 10.0]
[anchors]
sinker = {{ friction = 0.5, width = 16.0, unit_weight_kN_per_m3 = 13.0, lifted = true }}
holding = {{ capacity_kN = 8000.0, spacing = 5.0 }}
"""


def test_pretension_tide_and_anchors_are_sums_by_hand(tmp_path, capsys):
    """2 P₀ sin α carries what the body displaces beyond its weight, ΔP₀ what the tide adds; the greatest tension is
    that of high water and waves, the least pretension what low water and waves take, the most what is left of the
    allowable per metre; a sinker has W = P cos α/μ, and P sin α where it is lifted, and is W/(width · unit weight) high
    (Kihara et al. 1975, chapter 6)"""
    (tmp_path / "study.toml").write_text(STUDY)
    assert main(["breakwater", str(tmp_path / "study.toml"), "--output", str(tmp_path / "o.h5"), "--json"]) == 0
    tables, _ = capsys.readouterr()
    rows = [row for line in tables.splitlines() for row in json.loads(line)["rows"]]
    pull = RHO * G * BEAM * (DRAFT - FREE) / (2 * np.sin(ANGLE))
    change = RHO * G * BEAM * TIDE / (2 * np.sin(ANGLE))
    with h5py.File(tmp_path / "o.h5") as file:
        level = {name: {key: value[()] for key, value in group.items()} for name, group in file["tide"].items()}
        found = {key: value[()] for key, value in file["pretension"].items()}
        needed = {key: value[()] for key, value in file["anchors"].items()}
        K_T, K_R = (np.abs(file[f"taut, long waves/{key}"][()]) for key in ("transmission", "reflection"))
        front = np.abs(file["taut, long waves/front"][()]) / 1e3
    assert found["given"] == found["used"] == pytest.approx(pull)
    assert [level[name]["change"] for name in ("low", "mean", "high")] == pytest.approx([-change, 0.0, change])
    greatest = [pull + max(one["change"] + one[side] for one in level.values()) for side in ("front", "back")]
    assert found["greatest"] == pytest.approx(greatest)
    waves = {name: max(one["front"], one["back"]) for name, one in level.items()}
    assert found["least"] == pytest.approx(max(waves[name] - level[name]["change"] for name in level))
    assert found["most"] == pytest.approx(3000e3 / 4.0 - max(waves[name] + level[name]["change"] for name in level))
    weights = [p / 1e3 * (np.cos(ANGLE) / 0.5 + np.sin(ANGLE)) for p in greatest]
    assert [needed["sinker, front"], needed["sinker, back"]] == pytest.approx(weights)
    assert [needed["anchor, front"], needed["anchor, back"]] == pytest.approx([5.0 * p / 1e3 for p in greatest])
    printed = {row[""]: row for row in rows if "needed" in row}
    assert printed["sinker, front"]["needed"] == f"{weights[0]:.4g} kN/m"
    assert f"{weights[0] / (16.0 * 13.0):.3g} m high" in printed["sinker, front"]["size"]
    tides = {row["level"]: row for row in rows if "level" in row}
    for name, one in level.items():
        assert float(tides[name]["front, kN/m"]) == pytest.approx(one["front"] / 1e3, rel=1e-3)
        assert float(tides[name]["front, kN/m at, s"]) == one["front_at"]
        assert float(tides[name]["back, kN/m at, s"]) == one["back_at"]
    # transmission and tension amplitudes of each period, and that no energy is lost
    assert pytest.approx(np.ones(3)) == K_T**2 + K_R**2
    column = "taut, long waves"
    by_period = [row for row in rows if column in row]
    assert [float(row[column]) for row in by_period[:3]] == pytest.approx(K_T, abs=6e-4)
    assert [float(row[column].split(",")[0]) for row in by_period[3:6]] == pytest.approx(front, rel=1e-3)
    assert [float(row["period, s"]) for row in by_period[:3]] == [6.0, 8.0, 10.0]
