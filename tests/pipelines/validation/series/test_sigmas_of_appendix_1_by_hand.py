"""What is told of a test of appendix 1, from records that are made up: σ of motions and tensions of the model."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.motion import simulation
from hakobune.pipelines.simulate import study
from hakobune.pipelines.validation.series import appendix_1

SIZE = 46.5  # of prototype M3B over its model
N, STEP = 400, 0.5  # in 200 s
SLOW, QUICK = 2 * np.pi * 4 / (N * STEP), 2 * np.pi * 40 / (N * STEP)  # rad/s, whole cycles
ROW = {"source": "test", "line": "chain", "incidence_deg": "0", "gain": "0.9", "wave_cm": "3.0"}
PRINTED = {"surge_cm": "2.0", "heave_cm": "", "roll_deg": "0.5", "stern_starboard_kgf": "0.25"}


@pytest.fixture
def runs(monkeypatch):
    """Seeds asked for, of runs with amplitudes of seed + 1, 2 … 10 times a slow cosine and a quick one beside it"""
    time = STEP * np.arange(-100, N)  # the first 50 s belong to no result
    asked = []

    def simulate(body, weather, settings, seed):
        asked.append((body, weather, settings.step, seed))
        wave = 3 * np.cos(SLOW * time) + 4 * np.sin(QUICK * time)
        records = 7.0 + (seed + np.arange(1.0, 11.0)) * np.where(time < 0, 1e9, wave)[:, None]
        return SimpleNamespace(time=time, motion=records[:, :6], tension=records[:, 6:])

    plan = SimpleNamespace(weather="sea", settings=SimpleNamespace(step=STEP), seeds=[0, 2], split=(SLOW + QUICK) / 2)
    monkeypatch.setattr(study, "plan_of", lambda made, omega: plan)
    monkeypatch.setattr(simulation, "simulate", simulate)
    return asked


def test_sigmas_are_those_of_all_runs_together_in_the_units_of_the_model(runs):
    """A cosine of amplitude a has σ = a/√2: 5/√2 of both together, 3/√2 of the slow one; of two runs that are k and
    k + 2 times as large, the root of the mean square.  Lengths over 46.5 in cm, forces over 46.5³ in kgf of 9.80665 N,
    angles in degrees; a column that is not printed is not told"""
    body = SimpleNamespace(reader=SimpleNamespace(omega=None))
    row = dict.fromkeys(appendix_1.COLUMNS, "") | ROW | PRINTED
    found = appendix_1.computed(row, "full", body, 2)
    assert runs == [(body, "sea", STEP, 0), (body, "sea", STEP, 2)]
    assert [one["quantity"] for one in found] == ["surge_cm", "roll_deg", "stern_starboard_kgf"]
    units = SIZE / 100, math.pi / 180, 9.80665 * SIZE**3
    for one, k, unit, printed in zip(found, (1, 4, 10), units, (2.0, 0.5, 0.25), strict=True):
        size = math.sqrt((k**2 + (k + 2) ** 2) / 2) / math.sqrt(2) / unit
        assert one["sigma"] == pytest.approx(5 * size) and one["slow_sigma"] == pytest.approx(3 * size)
        assert one["printed"] == printed and one["over_printed"] == pytest.approx(5 * size / printed)
        assert one["wave_cm"] == 3.0 and one["variant"] == "full" and one["gain"] == "0.9"
    assert found[1]["test"] == "chain-0-0.9 full roll_deg"


@pytest.mark.parametrize(("incidence", "gain", "wave"), [("0", "0.9", 3.0), ("45", "0.9", 2.994), ("45", "0.5", 1.802)])
def test_waves_at_45_degrees_are_those_of_the_tests_without_reflection(incidence, gain, wave):
    """H = 4σ at the size of the prototype; the report's own calculation has neither memory nor wave drift damping"""
    row = ROW | {"incidence_deg": incidence, "gain": gain}
    made = appendix_1.simulation_of(row, "full", 5)
    assert made["waves"]["height"] == pytest.approx(0.04 * wave * SIZE)
    assert made["waves"]["incidence_deg"] == float(incidence)
    assert made["waves"]["period"] == pytest.approx(2.19 * math.sqrt(SIZE))
    own = made["simulation"]
    assert (own["memory"], own["slow_drift"], own["wave_drift_damping"]) == ("states", "newman", True)
    assert (own["seeds"], own["duration_hours"], own["dynamic_lines"]) == (5, 3.0, "none")
    own = appendix_1.simulation_of(row, "report", 1)["simulation"]
    assert (own["memory"], own["slow_drift"], own["wave_drift_damping"]) == ("constant", "half-waves", False)


def test_a_row_of_the_reports_own_calculation_is_named_as_such():
    assert appendix_1.name_of(ROW) == "chain-0-0.9"
    assert appendix_1.name_of(ROW | {"source": "report"}) == "chain-0-0.9-report"


def test_a_model_at_rest_is_told_at_its_own_size_beside_what_was_measured(monkeypatch):
    """Periods over √46.5 without that of heave, the mean pull of all lines over 46.5³"""
    from hakobune.pipelines.moor import result

    at_rest = SimpleNamespace(period=math.sqrt(SIZE) * np.array([16.0, 18.0, 99.0, 1.5, 1.75, 17.0]))
    pull = 9.80665 * SIZE**3 * np.array([2.0, 3.0, 2.0, 4.0])
    monkeypatch.setattr(result, "studied", lambda made, db: [SimpleNamespace(at_rest=at_rest, tension=pull)])
    found = appendix_1.at_rest("M3B", "sinker", None)
    assert found == pytest.approx(
        {"model": "M3B sinker", "tension_kgf": 2.75, "catenary_tension_kgf": 3.03, "measured_tension_kgf": 3.35,
         "surge_s": 16.0, "measured_surge_s": 14.7, "sway_s": 18.0, "measured_sway_s": 15.69, "roll_s": 1.5,
         "measured_roll_s": 1.78, "pitch_s": 1.75, "measured_pitch_s": 1.81, "yaw_s": 17.0, "measured_yaw_s": 14.72}
    )  # fmt: skip
