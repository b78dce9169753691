"""A sea that is too steep is a finding of `moor` and `simulate`, and no line of Python on the standard error."""

import math
import tomllib
import warnings
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.study import plan_of

SCENE = Path(pipelines.__file__).parent / "scenes" / "moor_chain_12.toml"
OMEGA = np.linspace(0.1, 3.0, 30)


@pytest.mark.parametrize("period, told", [(4.5, True), (7.0, False)])
def test_a_steep_sea_is_told_once_and_is_in_the_findings(period, told):
    """2πH/gT₀₂² of 4 m, limit 0.1; of an ISSC spectrum T₀₂ is some 0.92 T₀₁"""
    assert (2 * math.pi * 4.0 / 9.80665 / (0.92 * period) ** 2 > 0.1) is told
    raw = tomllib.loads(SCENE.read_text(encoding="utf-8"))
    raw["waves"] = {"height": 4.0, "period": period, "direction_deg": 90.0}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        study = make_study(raw)
        plan = plan_of(study, OMEGA, duration=600.0)
        _, said = study.conditions_and_warnings()
    for lines in (said, plan.findings):
        assert sum("steepness" in line for line in lines) == told
