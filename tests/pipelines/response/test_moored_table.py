"""The table of `hakobune response --moored` on the terminal, in CSV and in files: each number in its column."""

import io
import math
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

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


def test_lines_of_csv_have_yaw_in_degrees_and_shares_in_per_cent():
    head, *rows = moored.Moored(MOTION, (), (), None).csv()
    assert head == "moored: motion,unit," + ",".join(COLUMNS)
    for factor, name, row in zip((1, 2, 3), ("surge,m", "sway,m", "yaw,°"), rows, strict=True):
        assert row.startswith(f"moored: {name},")
        values = [float(one) for one in row.split(",")[2:]]
        assert values == pytest.approx([factor * one for one in COLUMNS.values()], rel=1e-5)


def test_the_terminal_shows_the_same_table():
    console = Console(file=io.StringIO(), width=200)
    moored.Moored(MOTION, (), (), None).show(console)
    said = [line.split() for line in console.file.getvalue().splitlines() if line.strip()]
    for factor, name, row in zip((1, 2, 3), ("surge,", "sway,", "yaw,"), said[-3:], strict=True):
        assert row[:2] == [name, "°" if name == "yaw," else "m"]
        assert [float(one) for one in row[2:]] == pytest.approx([factor * v for v in COLUMNS.values()], rel=5e-3)
    assert " ".join(said[0]) == "moored, mean and slow motion"
    order = ["mean", "T natural", "damping %", "σ slow", "of drift %", "σ waves", "√(πS/2NC)", "x_s/2ν", "largest"]
    assert " ".join(said[1]) == " ".join([*order, "by rule"])


def test_files_have_the_numbers_in_si_units():
    held = moored.Moored(MOTION, (), (), None).datasets()
    assert {name: np.ravel(values)[-1] for name, (values, _) in held.items()} == pytest.approx({
        "moored/offset": 3 * DEGREE, "moored/natural_period": 30, "moored/damping_ratio": 0.09, "moored/omega": 0.2,
        "moored/force_spectrum": 1, "moored/motion_spectrum": 2, "moored/slow_deviation": 1.5 * DEGREE,
        "moored/wave_deviation": 2.1 * DEGREE, "moored/largest": 5.1 * DEGREE, "moored/largest_by_rule": 5.7 * DEGREE,
    })  # fmt: skip
    assert [unit for _, unit in held.values()] == [
        "m, m, rad", "s", "1", "rad/s", "N2 s/rad; of moments N m", "m2 s/rad, m2 s/rad, rad2 s/rad",
        *["m, m, rad"] * 4,
    ]  # fmt: skip


@pytest.mark.parametrize("depth, told", [(0.99, True), (1.01, False)])
def test_bound_waves_are_told_where_kh_at_the_peak_is_below_one(depth, told):
    """kh = 1 is ω²h/g = tanh 1"""
    spectrum = issc(1.0, peak_period=10.0)
    h = depth * 9.81 * math.tanh(1.0) / spectrum.peak_omega**2
    said = list(moored._of_bound_waves(spectrum, SimpleNamespace(water_depth=h, gravity=9.81)))
    assert len(said) == told and all("bound long waves, left out, may move the body more than drift" in s for s in said)
