"""Pretension, tide and anchors of a rectangle, by hand."""

import numpy as np
import pytest

from hakobune.pipelines.breakwater.result import breakwater

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


def test_pretension_tide_and_anchors_are_sums_by_hand(tmp_path):
    """2 P₀ sin α carries what the body displaces beyond its weight, ΔP₀ what the tide adds; the greatest tension is
    that of high water and waves, the least pretension what low water and waves take, the most what is left of the
    allowable per metre; a sinker has W = P cos α/μ, and P sin α where it is lifted, and is W/(width · unit weight) high
    (Kihara et al. 1975, chapter 6)"""
    (tmp_path / "study.toml").write_text(STUDY)
    found = breakwater(tmp_path / "study.toml")
    pull = RHO * G * BEAM * (DRAFT - FREE) / (2 * np.sin(ANGLE))
    change = RHO * G * BEAM * TIDE / (2 * np.sin(ANGLE))
    names = found.labels["level"].values.tolist()
    parts = ("change", "front", "back")
    level = {name: {part: found[f"tide[{name}].{part}"] for part in parts} for name in names}
    assert found["pretension.used"] == pytest.approx(pull)
    assert [level[name]["change"] for name in ("low", "mean", "high")] == pytest.approx([-change, 0.0, change])
    greatest = [pull + max(one["change"] + one[side] for one in level.values()) for side in ("front", "back")]
    assert found["pretension.greatest"] == pytest.approx(greatest)
    waves = {name: max(one["front"], one["back"]) for name, one in level.items()}
    assert found["pretension.least"] == pytest.approx(max(waves[name] - level[name]["change"] for name in level))
    assert found["pretension.most"] == pytest.approx(
        3000e3 / 4.0 - max(waves[name] + level[name]["change"] for name in level)
    )
    weights = [p * (np.cos(ANGLE) / 0.5 + np.sin(ANGLE)) for p in greatest]
    needed = dict(zip(found.labels["anchor"].values, found["anchor.needed"], strict=True))
    assert [needed["sinker, front"], needed["sinker, back"]] == pytest.approx(weights)
    assert [needed["anchor, front"], needed["anchor, back"]] == pytest.approx([5.0 * p for p in greatest])
    assert found["anchor[anchor, front].used"] == pytest.approx(5.0 * greatest[0] / (8000e3 / 2.0))  # safety
    assert found.quantity("anchor[sinker, front].needed").unit == "N/m"
    assert f"{weights[0] / (16.0 * 13e3):.3g} m high" in found["anchor[sinker, front].size"]
    assert set(found["tide.front_at"]) | set(found["tide.back_at"]) <= {6.0, 8.0, 10.0}
    # no energy is lost
    assert found.labels["period"].values.tolist() == [6.0, 8.0, 10.0]
    assert np.hypot(found["transmission"], found["reflection"]) == pytest.approx(np.ones((3, 1)))
