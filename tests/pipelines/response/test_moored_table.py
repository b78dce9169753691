"""The table of `hakobune response --moored` on the terminal, in CSV and in files: each number in its column."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.spectra import issc
from hakobune.pipelines.response import moored

DEGREE = math.pi / 180


def three(surge, unit=DEGREE):
    """Surge, sway and yaw of 1, 2 and 3 times a number, the last in degrees"""
    return np.array([surge, 2 * surge, 3 * surge * unit])


MOTION = SimpleNamespace(
    offset=three(1.0), period=three(10.0, 1), ratio=three(0.03, 1), slow=three(0.5), drift_share=three(0.2, 1),
    fast_sigma=three(0.7), estimates=np.stack([three(1.1), three(1.3)], axis=1), largest=three(1.7), rule=three(1.9),
    omega=np.array([0.1, 0.2]), force=np.ones((2, 3, 3)), spectrum=np.full((2, 3), 2.0),
)  # fmt: skip
COLUMNS = {"mean_offset": 1, "natural_period_s": 10, "damping_percent": 3, "slow_deviation": 0.5,
           "of_drift_percent": 20, "wave_deviation": 0.7, "flat_spectrum_estimate": 1.1, "beating_force_estimate": 1.3,
           "largest": 1.7, "largest_by_rule": 1.9}  # fmt: skip


@pytest.mark.parametrize("depth, told", [(0.99, True), (1.01, False)])
def test_bound_waves_are_told_where_kh_at_the_peak_is_below_one(depth, told):
    """kh = 1 is ω²h/g = tanh 1"""
    spectrum = issc(1.0, peak_period=10.0)
    h = depth * 9.81 * math.tanh(1.0) / spectrum.peak_omega**2
    said = list(moored._of_bound_waves(spectrum, SimpleNamespace(water_depth=h, gravity=9.81)))
    assert len(said) == told and all(
        "bound long waves, which are not included, may move the body more than slow drift" in s for s in said
    )
