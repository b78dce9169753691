"""Lines that go slack and snap, one metre of a breakwater in time, beside the elastic lines and the tests of 1975."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune.bem.sections.any_section import any_section
from hakobune.bem.sections.coefficients import section
from hakobune.bem.sections.outline import circle, rectangle
from hakobune.mooring.breakwater.anchors import goes_slack
from hakobune.mooring.breakwater.body import TautBody
from hakobune.mooring.breakwater.elastic import elastic_exact, stiffness_of
from hakobune.mooring.breakwater.exact import taut_exact
from hakobune.mooring.breakwater.snap import IN_PLANE, frequencies, one_metre, snap

WATER = {"density": 1000.0, "gravity": 9.8}
PUBLISHED = Path(__file__).parents[2] / "published"


def published(name):
    with open(PUBLISHED / name, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if line[0] != "#")
        return [{key: float(value) for key, value in row.items()} for row in rows]


def of_table_3_2(depth, draft, mass):
    """The circle of 50 cm on lines at 45° towards its centre, and the section under water"""
    wet, arm, z = circle(0.5).wetted(draft), 0.25 * np.sqrt(0.5), 0.25 - draft
    body = TautBody(
        mass=mass, z0=z, inertia=0.04 * mass, area=wet.area, buoyancy_z=wet.center.imag, waterline=wet.waterline,
        draft=draft, depth=depth, angle=np.pi / 4, attachment=arm, attachment_z=z - arm,
        line=(depth + z - arm) * np.sqrt(2), **WATER,
    )  # fmt: skip
    return body, wet


def waters(body, wet, omega):
    return [any_section(wet, body.depth, w, **WATER) for w in frequencies(body, omega)]


def test_lines_without_pretension_go_slack_and_snap_two_to_three_times_the_taut_tension():
    """Table 3.2, the four periods that snapped; the stiffness, which is not printed, is one number for all of them"""
    (taut, deep), (loose, shallow) = of_table_3_2(0.5, 0.25, 57.4), of_table_3_2(0.4, 0.15, 49.5)
    ratios, ours, measured = [], [], []
    for row in published("breakwater_slack.csv")[:4]:
        slack, still, omega = row["slack_height_cm"] / 200, row["taut_height_cm"] / 200, 2 * np.pi / row["period_s"]
        linear = abs(taut_exact(taut, any_section(deep, 0.5, omega, **WATER)).front)
        assert goes_slack(loose.pretension, 0.0, linear * slack)
        assert not goes_slack(taut.pretension, 0.0, linear * still)
        found = snap(loose, waters(loose, shallow, omega), 1e4, omega, slack)
        assert min(found.slack) > 0.1 and not found.findings
        ratios.append(found.peaks[0] / (linear * slack))
        ours.append(found.peaks[0])
        measured.append(row["slack_front"] * 9.8 / 0.235)
    assert ours == pytest.approx(measured, rel=0.1)
    assert all(2 < ratio < 3 for ratio in ratios)


@pytest.mark.parametrize("memory", ["states", "constant"])
def test_lines_that_stay_taut_do_not_snap(memory):
    """Small motions of a run are those of the linear equations; the memory is fitted to 1e-3 of its largest"""
    taut, wet = of_table_3_2(0.5, 0.25, 57.4)
    omega = np.pi
    found = snap(taut, waters(taut, wet, omega), 3e4, omega, 0.005, memory)
    linear = elastic_exact(taut, any_section(wet, 0.5, omega, **WATER), 3e4)
    assert max(found.slack) == 0
    amplitudes = [(P.max() - P.min()) / 2 for P in (found.front, found.back)]
    assert amplitudes == pytest.approx([0.005 * abs(P) for P in (linear.front, linear.back)], rel=1e-2)
    assert (found.front.mean(), found.back.mean()) == pytest.approx((taut.pretension, taut.pretension), rel=1e-2)


@pytest.mark.parametrize("degrees", [44, 90, 120])
def test_a_metre_in_time_rests_where_its_lines_hold_it_with_their_stiffness(degrees):
    angle, wet = np.radians(degrees), rectangle(0.6, 0.4).wetted(0.3)
    body = TautBody(
        mass=121.2, z0=-0.095, inertia=8.4, area=wet.area, buoyancy_z=-0.15, waterline=0.6, draft=0.3, depth=0.6,
        angle=angle, attachment=0.3, attachment_z=-0.3, line=0.3 / np.sin(angle), **WATER,
    )  # fmt: skip
    still = one_metre(body, [section(0.6, 0.3, 0.6, w, **WATER) for w in frequencies(body, 3.0)], 1e5)
    rise = 2 * body.pretension * np.sin(angle) / body.heave_stiffness
    assert still.start == pytest.approx([0, 0, -rise, 0, 0, 0], abs=1e-9)
    expected = stiffness_of(body, 1e5)[0]
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    assert np.abs(still.stiffness[IN_PLANE] - expected).max() < 1e-9 * scale.max()
    assert still.stiffness[IN_PLANE] / scale == pytest.approx(expected / scale, abs=1e-7)


def test_without_any_pretension_the_run_begins_at_rest():
    body, wet = of_table_3_2(0.4, 0.15, 1000 * circle(0.5).wetted(0.15).area)
    assert body.pretension == pytest.approx(0, abs=1e-9)
    found = snap(body, waters(body, wet, 4.0), 1e4, 4.0, 0.016)
    assert np.isfinite(found.peaks).all() and min(found.slack) > 0.1
