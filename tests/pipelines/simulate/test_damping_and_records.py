"""Damping of a study in SI units, and which records and waves a database can take, each on both sides of its limit."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from test_quay import FENDER

from hakobune.mooring.environment.wave_records import Record, write_record
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.response.study import ONE_BODY
from hakobune.pipelines.simulate import study as simulate_study
from hakobune.pipelines.simulate.study import damping, motions_of, plan_of, quadratic

OMEGA = np.linspace(0.1, 2.0, 20)
SHIP = {"water": {"depth": 20}, "hull": {"freeboard": 10}, "fender": [FENDER]}


def test_ratios_and_kilonewtons_of_damping_add_up():
    """b = ζ b_c + 1000 · what is given in kN s/m"""
    body = SimpleNamespace(critical_damping=lambda mode: 1e5 * (mode + 1), damping=np.zeros((6, 6)), words=ONE_BODY)
    table = {"duration": 9.0, "damping_ratio": {"roll": 0.05}, "linear_damping": {"roll": 3.0, "surge": 2.0},
             "quadratic_damping": {"yaw": 7.0}}  # fmt: skip
    made = make_study(SHIP | {"simulation": table})
    assert damping(made, body) == pytest.approx(np.diag([2e3, 0, 0, 0.05 * 4e5 + 3e3, 0, 0]))
    assert quadratic(made) == pytest.approx([0, 0, 0, 0, 0, 7e3])
    bare = make_study(SHIP)
    assert np.all(damping(bare, body) == 0) and damping(bare, body).shape == (6, 6) and np.all(quadratic(bare) == 0)


def test_a_share_of_critical_damping_counts_the_spring_of_the_motion():
    """Surge has no other restoring: 2 ζ √(K M) of K = 80 kN/m"""
    rest = {"damping": np.zeros((6, 6)), "words": ONE_BODY}

    def restrained(stiffness):
        return SimpleNamespace(critical_damping=lambda mode: 2 * np.sqrt(stiffness[mode, mode] * 5e5), **rest)

    body = SimpleNamespace(restrained=restrained, **rest)
    table = {"duration": 9.0, "damping_ratio": {"surge": 0.1}, "spring": {"surge": 80.0}}
    assert damping(make_study(SHIP | {"simulation": table}), body)[0, 0] == pytest.approx(0.2 * np.sqrt(8e4 * 5e5))


def test_motions_of_a_study_are_named_and_one_that_is_held_does_not_start_elsewhere():
    study = lambda **table: make_study(SHIP | {"simulation": {"duration": 9.0, "memory": "constant"} | table})  # noqa: E731
    assert motions_of(study()) == (0, 1, 2, 3, 4, 5) and motions_of(study(motions=["yaw", "Surge"])) == (0, 5)
    with pytest.raises(StudyError, match="motions: there is no motion 'sorge'; allowed: surge, sway"):
        plan_of(study(motions=["sorge"]), OMEGA)
    with pytest.raises(StudyError, match=r"heave is given, but simulation\.motions holds this motion fixed"):
        plan_of(study(motions=["surge"], offset={"heave": 1.0}), OMEGA)


@pytest.mark.parametrize("key", ["linear_damping", "quadratic_damping"])
def test_damping_below_nothing_is_refused(key):
    body = SimpleNamespace(critical_damping=lambda mode: 1.0, damping=np.zeros((6, 6)), words=ONE_BODY)
    find = (lambda made: damping(made, body)) if key[0] == "l" else quadratic
    for value in (-0.1, math.inf):
        made = make_study(SHIP | {"simulation": {"duration": 9.0, key: {"heave": value}}})
        with pytest.raises(StudyError, match=re.escape(f"simulation.{key}.heave is {value:g}; allowed: 0 or more")):
            find(made)
    find(make_study(SHIP | {"simulation": {"duration": 9.0, key: {"heave": 0.0}}}))


@pytest.mark.parametrize("period, inside", [(3.13, False), (3.15, True), (62.8, True), (62.9, False)])
def test_regular_waves_are_to_lie_between_the_stored_periods(period, inside):
    """2π/2 = 3.142 s to 2π/0.1 = 62.83 s"""
    waves = {"method": "regular_wave", "height": 1.0, "period": period, "direction_deg": 90}
    study = make_study(SHIP | {"waves": waves, "simulation": {"duration": 100.0}})
    if inside:
        plan = plan_of(study, OMEGA)
        assert plan.weather.waves.period == pytest.approx(period) and not plan.weather.seas
        assert plan.split == pytest.approx(math.pi / period)  # slow is below half of its frequency
        return
    words = f"waves of {period:g} s lie outside the stored periods, 3.142 to 62.83 s"
    with pytest.raises(StudyError, match=re.escape(words)):
        plan_of(study, OMEGA)


def recorded(folder, elevation, step=1.0, duration=200.0, **record):
    write_record(folder / "berth.csv", Record(np.asarray(elevation), step))
    table = {"duration": duration, "ramp": 50.0, "record": {"file": "berth.csv", "direction_deg": 90, **record}}
    return plan_of(make_study(SHIP | {"simulation": table}), OMEGA, folder=folder)


@pytest.mark.parametrize("small, told", [(0.098, False), (0.104, True)])
def test_energy_of_a_record_outside_the_band_is_told_above_one_per_cent(tmp_path, small, told):
    """Waves of 3 s, shorter than the band's 3.14 s, of a share s²/(1 + s²) of the energy; 252 s hold all periods"""
    t = np.arange(252.0)
    made = recorded(tmp_path, np.sin(2 * np.pi * t / 12) + small * np.sin(2 * np.pi * t / 3), duration=201.0,
                    shortest=2.5)  # fmt: skip
    said = [line for line in made.findings if "of the record's energy" in line]
    assert bool(said) is told
    if told:
        assert said[0].startswith(f"{100 * small**2 / (1 + small**2):.3g} % of the record's energy lies outside")
        assert "0.1 to 2 rad/s" in said[0] and said[0].endswith(
            "rad/s, and is not included; solve 0.524 rad/s and above"
        )
    waves = made.weather.components
    assert waves.amplitude[np.isclose(waves.omega, np.pi / 6)] == pytest.approx([1.0])


def test_records_are_to_last_as_long_as_ramp_and_duration_and_to_have_waves(tmp_path, monkeypatch):
    t = np.arange(0.0, 251.0)
    record = np.sin(2 * np.pi * t / 12.5)
    assert recorded(tmp_path, record).weather.components is not None
    with pytest.raises(
        StudyError, match=r"simulation.record lasts 249 s; allowed: ramp and duration, 250 s, or longer"
    ):
        recorded(tmp_path, record[:-1])
    with pytest.raises(StudyError, match=r"simulation.record has no waves of 300 s or longer; lower shortest"):
        recorded(tmp_path, record, shortest=300.0)
    count = len(recorded(tmp_path, record).weather.components.omega)
    monkeypatch.setattr(simulate_study, "MOST_OF_RECORD", count)
    recorded(tmp_path, record)
    monkeypatch.setattr(simulate_study, "MOST_OF_RECORD", count - 1)
    with pytest.raises(StudyError, match=f"simulation.record has {count} waves; allowed: {count - 1}"):
        recorded(tmp_path, record)


@pytest.mark.parametrize("tables, says", [
    ({"waves": {"height": 1.0, "period": 8.0, "direction_deg": 90}}, "given together with [waves] or simulation.sea"),
    ({"qtf": "full"}, "simulation.qtf is 'full'; allowed: newman, auto"),
])  # fmt: skip
def test_a_record_takes_the_place_of_other_waves(tmp_path, tables, says):
    table = {"duration": 9.0, "record": {"file": "berth.csv", "direction_deg": 90}}
    study = SHIP | ({"simulation": table | tables} if "qtf" in tables else {"simulation": table} | tables)
    with pytest.raises(StudyError, match=re.escape(says)):
        plan_of(make_study(study), OMEGA, folder=tmp_path)
