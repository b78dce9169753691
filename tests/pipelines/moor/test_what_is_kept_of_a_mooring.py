"""What is kept of a mooring study: every number of a MultiPoint that is made up, under its name, with its unit."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.moor import result

FIRST = {  # name: (first value, unit)
    "load.Fx": (20, "N"), "load.Fz": (22, "N"), "load.Mx": (23, "N m"), "load.Mz": (25, "N m"),
    "period.at_rest": (40, "s"), "period.under_loads": (60, "s"), "mode_shape.at_rest": (40, ""),
    "tension.at_rest": (300, "N"), "tension.horizontal_at_rest": (302, "N"), "tension.steady": (200, "N"),
    "tension.largest": (71, "N"), "tension.used": (0.2, ""), "anchor.largest_vertical": (-404, "N"),
    "anchor.largest_horizontal": (406, "N"), "grounded.at_rest": (308, "m"), "grounded.at_largest": (408, "m"),
    "fairlead.outward": (81, "m"), "fairlead.upward": (91, "m"), "line.breaking_load": (500, "N"),
    "line.length": (61, "m"), "anchor.place": (900, "m"), "fairlead.place": (950, "m"),
    "motion.amplitude": (10, ("m", "m", "m", "rad", "rad", "rad")), "drift.irregular": (100, ("N", "N", "N m")),
    "free_motion.irregular": (110, ("m", "m", "m", "rad", "rad", "rad")),
    "drift_by_current.irregular": (120, ("N", "N", "N m")), "drift.regular_wave": (130, ("N", "N", "N m")),
    "free_motion.regular_wave": (140, ("m", "m", "m", "rad", "rad", "rad")),
    "pose.x": (1, "m"), "pose.y": (2, "m"), "pose.yaw": (3, "rad"), "pose.roll": (5, "rad"), "pose.pitch": (6, "rad"),
    "allowable": (0.4, ""), "motion_factor": (1.5, ""), "stiffness": (220, "N/m, N/rad; N m/m, N m/rad"),
    "residual": (210, ("N", "N", "N m")),
}  # fmt: skip


def lines(start):
    made = {"tension_b": 0, "horizontal_b": 2, "vertical_a": 4, "horizontal_a": 6, "grounded_length": 8}
    return SimpleNamespace(**{name: start + by + np.arange(2.0) for name, by in made.items()})


def periods(start):
    return SimpleNamespace(names=("Surge", "Sway", "Yaw"), period=start + np.arange(3.0), scale=start,
                           shapes=start + np.arange(9.0).reshape(3, 3))  # fmt: skip


@pytest.fixture
def made(monkeypatch):
    ends = 900 + np.arange(6.0).reshape(2, 3), 950 + np.arange(6.0).reshape(2, 3)
    monkeypatch.setattr(result, "line_ends", lambda rest: ends if rest.kind == "rest" else None)
    irregular = SimpleNamespace(drift=100 + np.arange(3.0), amplitudes=110 + np.arange(6.0),
                                by_current=120 + np.arange(3.0))  # fmt: skip
    regular = SimpleNamespace(drift=130 + np.arange(3.0), amplitudes=140 + np.arange(6.0), by_current=None)
    equilibrium = SimpleNamespace(lines=lines(200), residual=210 + np.arange(6.0),
                                  stiffness=220 + np.arange(36.0).reshape(6, 6))  # fmt: skip
    system = SimpleNamespace(line_names=("bow", "stern"), breaking_load=np.array([500.0, np.inf]),
                             lines=[SimpleNamespace(length=61.0), SimpleNamespace(length=62.0)])  # fmt: skip
    return SimpleNamespace(
        allowable=0.4, conditions=SimpleNamespace(motion_factor=1.5, method="irregular"), warnings=("one", "two"),
        displacement=1 + np.arange(3.0), heel=np.array([5.0, 6.0]), equilibrium=equilibrium,
        amplitudes=10 + np.arange(6.0), loads={"wind": 20 + np.arange(6.0), "current": 30 + np.arange(6.0)},
        waves={"irregular": irregular, "regular_wave": regular}, at_rest=periods(40.0), at_equilibrium=periods(60.0),
        system=system, rest=SimpleNamespace(kind="rest", lines=lines(300)), extreme=lines(400),
        tension=np.array([71.0, 72.0]), utilisation=np.array([0.2, 0.3]), outward=np.array([81.0, 82.0]),
        upward=np.array([91.0, 92.0]), steady_force=50 + np.arange(6.0), bent=None,
    )  # fmt: skip


def kept(made):
    parts = (result._steady, result._periods, result._lines, result._waves, result._place)
    return {name: one for part in parts for name, one in part(made).items()}


def test_every_number_is_kept_under_its_name_with_its_unit(made):
    found = kept(made)
    assert {name: (np.ravel(found[name].values)[0], found[name].unit) for name in FIRST} == FIRST
    assert found["residual"].values.tolist() == [210, 211, 215]  # of the plane: surge, sway, yaw
    assert found["load.Fy"].values.tolist() == [21, 31, 51]  # wind, current, sum
    assert {name: one.values.shape for name, one in found.items() if one.values.ndim > 1} == {
        "mode_shape.at_rest": (3, 3), "mode_shape.under_loads": (3, 3), "anchor.place": (2, 3),
        "fairlead.place": (2, 3), "stiffness": (6, 6),
    }  # fmt: skip
    assert found["drift.regular_wave"].description.startswith("not used")
    assert not found["drift.irregular"].description.startswith("not used")


def test_a_study_without_waves_keeps_no_drift(made):
    made.waves = {}
    assert not [name for name in kept(made) if name.startswith(("drift", "free_motion"))]
