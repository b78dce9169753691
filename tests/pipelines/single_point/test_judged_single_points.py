"""What fails, is found and is kept of equilibria and runs at a single point that are made up."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.kernels.progress import CYCLE, IN_TIME
from hakobune.mooring.loads.turning import FITTED
from hakobune.mooring.single_point.equilibria import preferred
from hakobune.mooring.single_point.history import Cycle, Record
from hakobune.mooring.single_point.in_time import Run, largest_of
from hakobune.pipelines.common.progress import duration
from hakobune.pipelines.single_point import result, running, telling
from hakobune.pipelines.single_point.findings import findings, overloads, pulled_down
from hakobune.pipelines.single_point.quantities import maps_of, rest_of, run_of
from hakobune.pipelines.single_point.running import words
from hakobune.pipelines.single_point.tables import SlewingTable


def one(growth=-1e-3, heading=0.0, period=250.0, hawser=(1e5, 2e5), used=(0.3, np.nan), breaking=(1e6, np.inf)):
    system = SimpleNamespace(line_names=["a", "b"], breaking_load=np.array(breaking))
    lines = SimpleNamespace(utilisation=np.array(used), grounded_length=np.array([12.3, 45.6]))
    return SimpleNamespace(
        heading=heading, pull=2.5e5, hawser=np.array(hawser), point=SimpleNamespace(system=system), place=(1.0, 2.0),
        slewing=SimpleNamespace(growth=growth, stable=growth < 0, period=period), force=np.ones(3), roots=[-1j, 1j],
        lines=SimpleNamespace(lines=lines, tension=np.array([3e5, 4e5]), position=np.array([[5.0, 6.0, -1.0]])),
        quartic=None, slews=True,
    )  # fmt: skip


def found(rest, turning=False, speed=0.0, direction=0.0, waves=None, run=None):
    water = SimpleNamespace(turning=turning, speed=speed, direction=direction)
    point = SimpleNamespace(loads=SimpleNamespace(water=water), lengths=[30.0, 30.0], system=rest[0].point.system)
    study = SimpleNamespace(waves=waves, buoy=SimpleNamespace(mass=None, diameter=None))
    return SimpleNamespace(best=preferred(rest), rest=rest, point=point, study=study, run=run)


def test_the_equilibrium_that_decays_fastest_is_preferred():
    decays = [one(-1e-3), one(-2e-3), one(1e-3)]
    assert preferred(decays) is decays[1]
    assert preferred([one(3e-3), one(1e-3)]).slewing.growth == 1e-3


def test_headings_of_rest_have_their_pull_and_the_largest_of_their_lines():
    made, axes = rest_of(found([one(heading=-math.pi / 2), one(2e-3, period=np.inf)]))
    assert np.degrees(made["rest.heading"].values) == pytest.approx([270, 0])
    assert made["rest.stable"].values.tolist() == [True, False]
    assert made["rest.growth"].values.tolist() == [-1e-3, 2e-3]
    assert made["rest.pull"].values.tolist() == [2.5e5] * 2 and made["rest.largest_line"].values.tolist() == [4e5] * 2
    assert made["rest.hawser"].values.tolist() == [[1e5, 2e5]] * 2 and made["rest.buoy_z"].values.tolist() == [-1] * 2
    assert axes["line"].values.tolist() == ["a", "b"]


@pytest.mark.parametrize(("sunk", "told"), [(0.12, False), (0.13, True), (-0.13, True), (0.6, True)])
def test_a_buoy_that_its_lines_pull_down_is_told_with_the_key_for_its_draft_with_them(sunk, told):
    """200 t on ρ π D²/4 = 80.50 t/m float with 2.4845 m; 5 % of it is 0.1242 m"""
    rest = one()
    rest.point.system.density, rest.point.system.gravity = 1025.0, 9.80665
    rest.point.system.bodies = [SimpleNamespace(position=np.array([0.0, 0.0, -1.0 + sunk]))]
    said = list(pulled_down(SimpleNamespace(mass=200.0, diameter=10.0, draft=None), rest.point.system, rest))
    assert bool(said) is told
    if told:
        per_metre = 1.025 * math.pi * 25.0
        assert f"with {per_metre * 9.80665 * sunk:.4g} kN to {200 / per_metre + sunk:.3g} m" in said[0]
        assert "give buoy.draft = 2.48 instead of buoy.mass: buoy.z is then the height with lines too" in said[0]


def test_headings_that_are_stable_are_counted():
    assert list(findings(found([one(), one(1e-3)]))) == []
    (said,) = findings(found([one(1e-3), one(2e-3)]))
    assert said.startswith("no heading is stable: the body slews")
    (said,) = findings(found([one(), one(heading=math.pi / 2), one(1e-3)]))
    assert said == "2 headings are stable (0°, 90°): the body comes to rest at the first of them that it reaches"


def test_steady_tensions_in_waves_are_told_to_be_less_than_the_largest():
    (said,) = findings(found([one()], waves="waves"))
    assert said.startswith("left out: pulls by waves and gusts") and "[slewing]" in said
    assert list(findings(found([one()], waves="waves", run=ran()))) == list(findings(found([one()], run=ran()))) == []


def test_chains_in_their_static_shape_are_told_of_where_waves_move_the_hull():
    (said,) = findings(found([one()], waves="waves", run=ran(wave=1.0)))
    assert said.startswith("left out: inertia and drag of the chains") and "snap loads 1.6 to 9 times" in said
    assert 'dynamic_lines = "auto"' in said


def test_a_hawser_that_falls_slack_is_told_with_its_share_of_the_run():
    """3 of 800 samples; a contact buoy has no hawser"""
    run = ran()
    run.record.hawser[100:103] = 0.0
    assert "the hawser falls slack and comes taut again: hawser 1 for 0.38 % of the run" in words(run)
    run.steady.point.lengths[0] = 0.0
    assert not any("slack" in line for line in words(run))


@pytest.mark.parametrize("angle, told", [(59.9, False), (60.1, True), (119.0, True), (121.0, False)])
def test_water_beyond_the_turning_tests_is_told(angle, told):
    """60° from ahead or from astern"""
    assert math.degrees(FITTED) == pytest.approx(60)
    at = dict(turning=True, speed=1.0, direction=math.radians(angle))
    said = list(findings(found([one()], **at)))
    assert len(said) == told
    drift = min(angle, 180 - angle)
    assert all(
        f"meets the hull at {drift:.0f}°, {drift - 60:.0f}° beyond the range of the turning tests (60°)" in s
        for s in said
    )
    for still in ({"speed": 0.0}, {"turning": False}):
        assert list(findings(found([one()], **at | still))) == []


def overloaded(best=None, cycle=None, run=None, load=1000.0, waves=True, allowable=0.4):
    hawser = None if load is None else SimpleNamespace(breaking_load_kN=load, breaking_load_tonf=None)
    study = SimpleNamespace(hawser=hawser, allowable=allowable, waves=waves or None)
    return list(overloads(study, best or one(), cycle, run))


def test_hawsers_and_lines_are_held_to_what_is_allowed_of_them():
    """100 and 200 kN of hawsers of 1 MN, 30 % of a line, another of no known strength"""
    assert overloaded() == overloaded(load=None) == []
    assert overloaded(one(hawser=(1e5, 3.99e5))) == []
    (said,) = overloaded(one(hawser=(1e5, 4.01e5)))
    assert "1 of 4 lines at rest above the allowable 40 % of the breaking load: hawser 2 40" in said
    assert "; give a stronger type or more lines; the limit is the study's own key allowable" in said
    assert overloaded(one(used=(0.399, np.nan))) == []
    (said,) = overloaded(one(used=(0.41, np.nan)), load=None)
    assert "1 of 2 lines at rest above the allowable 40 %" in said and ": a 41 %" in said
    (said,) = overloaded(one(hawser=(1.01e6, 1e5)))
    assert "beyond the breaking load" in said and "hawser 1 101 %" in said


def test_limit_cycles_and_runs_are_held_to_their_largest():
    """In a run with waves and no slow drift the report adds a fifth: 41 % · 0.85 · 1.2 = 41.82 %"""
    pulls = np.array([[1e5, 1e5], [2e5, 4.1e5], [1e5, 1e5]])
    cycle = SimpleNamespace(hawser=pulls, lines=np.array([[3e5, 9e9], [4.2e5, 9e9], [0, 9e9]]))
    (said,) = overloaded(cycle=cycle)
    assert "2 of 4 lines in the limit cycle above the allowable 40 %" in said and ": a 42 %, hawser 2 41 %" in said
    run = SimpleNamespace(drifts=False, record=SimpleNamespace(hawser=pulls * 0.85, lines=np.full((3, 2), 1e5)))
    (said,) = overloaded(run=run)
    assert "in the run in time, with 20 % for slow drift (SR179) above" in said and "hawser 2 41.82 %" in said
    assert overloaded(run=run, waves=False) == []
    run.drifts = True
    assert overloaded(run=run) == []


TIME = np.arange(0.0, 400.0, 0.5)
QUIET = Cycle(math.radians(0.5), np.nan, 1.0, False)


def ran(cycle=None, heading=0.0, wave=0.0, gusts=0.0, drifts=False, settled=np.nan, stable=True, findings=()):
    """A body whose waves of 20 s have 0.01 j + 0.01 of `wave` in the mode j, along x and y"""
    n = len(TIME)
    motion = wave * np.sin(2 * math.pi / 20 * TIME)[:, None] * 0.01 * np.arange(1, 7)
    still = np.zeros((n, 2))
    hawser, lines = np.full((n, 1), 2e5), np.full((n, 2), 3e5)
    hawser[9], lines[7, 1] = 5e5, 9e5
    record = Record(TIME, still, np.full(n, heading), motion, still, hawser, lines, 10 + gusts * np.sin(TIME))
    point = SimpleNamespace(
        system=SimpleNamespace(line_names=["a", "b"]), lengths=np.array([30.0]), origin=np.array([3.0, 4.0])
    )
    steady = SimpleNamespace(
        heading=0.0, hawser=np.array([1e5]), lines=SimpleNamespace(tension=np.array([2e5, 3e5])),
        slewing=SimpleNamespace(stable=stable), point=point, slews=True,
    )  # fmt: skip
    cycle = Cycle(math.radians(5.0), 250.0, 1.0, True) if cycle is None else cycle
    return Run(record, steady, cycle, settled, 12.34, drifts, findings, 100.0)


SLEWS = "the body slews: ±5.0° at a period of 250 s at the end of the run"
SWINGS = (
    "the heading swings ±5.0° at about 250 s at the end: gusts and slow drift drive this motion; "
    "without them the heading is stable"
)


@pytest.mark.parametrize("made, says", [
    (ran(), SLEWS),
    (ran(Cycle(math.radians(5), 250, 1.021, True)), f"{SLEWS}, still growing"),
    (ran(Cycle(math.radians(5), 250, 1.019, True)), SLEWS),
    (ran(gusts=1.0), SWINGS),
    (ran(drifts=True), SWINGS),
    (ran(gusts=1.0, stable=False), SLEWS),
    (ran(QUIET, math.radians(3), settled=1200.0), "the heading decays from 3° to within 0.2° of rest in 1200 s"),
    (ran(QUIET), "the heading is still 0.5° about its mean at the end of the run"),
])  # fmt: skip
def test_what_is_said_of_a_heading(made, says):
    assert list(words(made)) == [says]


def kept(run):
    made, axes = run_of(SimpleNamespace(run=run, point=run.steady.point))
    return {name: quantity.values for name, quantity in made.items()}, axes, made


def test_motions_in_waves_are_along_and_across_the_hull():
    """σ = a/√2; a hull that heads along y has its surge there, and the wave's x across it"""
    run = ran(wave=100.0, heading=math.pi / 2, findings=("found",))
    a = np.arange(1, 7) / math.sqrt(2)
    values, _, _ = kept(run)
    assert values["run.wave_sigma"] == pytest.approx([a[1], a[0], *a[2:]], rel=2e-3)
    said = list(words(run))
    assert said[1:] == ["the run does not include slow drift; the SR179 report adds 20 % for it", "found"]
    assert not any("report adds" in line for line in words(ran(wave=100.0, drifts=True)))


@pytest.mark.parametrize("drifts", [False, True])
def test_tensions_of_a_run_are_kept_with_the_fifth(drifts):
    """Significant is steady + ⅔ of what the largest is above it: 100 + 267, 300 + 400"""
    values, axes, made = kept(ran(drifts=drifts))
    assert axes["rope"].values.tolist() == ["hawser 1", "a", "b"]
    by_hand = {
        "steady": [100, 200, 300], "mean": [200 + 300 / len(TIME), 300, 300 + 600 / len(TIME)],
        "significant": [100 + 800 / 3, 200 + 200 / 3, 700], "largest": [500, 300, 900],
    }  # fmt: skip
    for name, tension in by_hand.items():
        assert values[f"run.{name}"] / 1e3 == pytest.approx(tension), name
    assert values["run.significant_with_drift"] == pytest.approx(1.2 * values["run.significant"])
    assert bool(made["run.significant_with_drift"].table) is not drifts
    assert values["run.excursion"] == 5.0  # the buoy stays at 0, 0
    assert values["run.radius"] == 12.34 and values["run.amplitude"] == pytest.approx(math.radians(5))


def test_the_report_s_fifth_is_added_where_slow_drift_is_left_out():
    for drifts, waves, factor in ((False, True, 1.2), (True, True, 1.0), (False, False, 1.0)):
        hawser, lines = largest_of(ran(drifts=drifts), waves)
        assert hawser == pytest.approx([factor * 5e5]) and lines == pytest.approx([factor * 3e5, factor * 9e5])


def test_a_map_has_the_share_of_its_answers_that_slews():
    """Of four answers three are above 0; the fifth place has none"""
    growth = np.array([[1.0, 2.0, -1.0, 3.0, np.nan]])
    one = SimpleNamespace(keys=("hawser.length",), growth=growth, period=growth, heading=90 + 0 * growth,
                          x=np.arange(5.0), y=[0.0])  # fmt: skip
    made, axes = maps_of(SimpleNamespace(maps=[one]))
    assert made["map_1.slews"].values == 0.75 and axes["map_1_x"].values.tolist() == [0, 1, 2, 3, 4]
    assert made["map_1.heading"].values[0, 0] == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ("good", "bad", "says"),
    [
        ({"duration": 2e5, "step": 0.2}, {"duration": 2.01e5}, "more than 1000000 samples"),
        ({"duration": 9e5, "step": 1.0}, {"duration": 1.1e6, "step": 1.0}, "more than 1000000 samples"),
        ({"waves_after": 1200.0}, {"waves_after": 1201.0}, "waves_after is 1201 s; allowed: 0 to the duration of 1200"),
        ({"waves_after": 0.0}, {"waves_after": -1.0}, "waves_after is -1 s"),
        ({"offset_deg": -180.0}, {"offset_deg": 181.0}, "offset_deg is 181; allowed: −180 to 180"),
        ({"components": 1, "seed": 0}, {"components": 0}, "components must be at least 1"),
        ({"scheme": "slow"}, {"seed": -1}, "the seed a whole number from 0"),
        ({"tolerance": 1e-9}, {"tolerance": 0.0}, "slewing.tolerance"),
        ({"slow_step": 0.1}, {"slow_step": 0.0}, "slewing.slow_step"),
        ({"step": 0.1}, {"step": 0.0}, "slewing.step"),
        ({"scheme": "full"}, {"scheme": "fast"}, "slewing.scheme is 'fast'; allowed: "),
    ],
)
def test_a_run_in_time_is_taken_up_to_its_limits(good, bad, says):
    running._check(SlewingTable(**good))
    with pytest.raises(ValueError) as refused:
        running._check(SlewingTable(**bad))
    assert says in str(refused.value)


@pytest.mark.parametrize(("seconds", "lines"), [(9.0, 0), (11.0, 1), (33.0, 2)])
def test_a_limit_cycle_is_told_of_every_ten_seconds(monkeypatch, capsys, seconds, lines):
    """Three periods in so many seconds; the first begins the clock, so that 97 more take 97/3 of them"""
    clock = [0.0]
    monkeypatch.setattr(telling, "time", SimpleNamespace(monotonic=lambda: clock[0]))
    now = telling.Telling()
    now("waves", 5)
    for part in (1, 2, 3):
        clock[0] = seconds * part / 3
        now(CYCLE, (math.radians(7.0), 0.02))
    said = capsys.readouterr().err.splitlines()
    assert len(said) == lines
    if lines:
        assert said[-1].startswith("limit cycle, period 3 of") and "swings 7° to either side, +2 % a period" in said[-1]
        assert said[-1].endswith(f"; at most {duration(seconds / 3 * 97)} left")


def test_a_run_in_time_is_told_of_with_the_time_left(monkeypatch, capsys):
    """A fifth in 15 s, so four fifths in 60 s more; a run that begins again has its own clock"""
    clock = [0.0]
    monkeypatch.setattr(telling, "time", SimpleNamespace(monotonic=lambda: clock[0]))
    now = telling.Telling()
    for at, share in ((0.0, 0.0), (15.0, 0.2), (20.0, 0.9), (21.0, 0.1), (41.0, 0.6)):
        clock[0] = at
        now(IN_TIME, share)
    assert capsys.readouterr().err.splitlines() == [
        "run in time: 20 %, 1 min 00 s left", "run in time: 60 %, 16 s left",
    ]  # fmt: skip


@pytest.mark.parametrize(("offset", "period", "growth", "lasts"), [
    (2.0, 900.0, 1e-3, 5400.0),  # six periods
    (2.0, 90.0, 1e-3, 3355.1),  # ln(1/0.0349066) = 3.3551
    (-0.01, 90.0, 1e-3, 8653.4),  # ln(1/1.745329e-4) = 8.65340
    (0.0, 90.0, 1e-3, math.inf),
    (2.0, math.inf, 1e-3, math.inf),
])  # fmt: skip
def test_a_run_shows_slewing_after_periods_and_after_it_has_grown(offset, period, growth, lasts):
    found = result._grown(SlewingTable(offset_deg=offset), one(growth, period=period))
    assert found == pytest.approx(lasts, abs=0.1)


def test_a_run_that_shows_the_slewing_takes_the_place_of_the_limit_cycle(monkeypatch, capsys):
    """The run lasts for 399.5 s"""
    monkeypatch.setattr(result, "limit_cycle", lambda one: "cycle")
    slews, run = one(1e-3), ran()
    none, why = result._cycle_of(slews, run, 399.0)
    assert none is None and why.startswith("limit cycle: not computed, since the run in time shows the slewing")
    assert result._cycle_of(slews, run, 401.0) == ("cycle", None)
    assert (
        "a run of 399.5 s is too short to show it fully grown; give slewing.duration = 500" in capsys.readouterr().err
    )
    assert result._cycle_of(slews) == ("cycle", None)


def test_a_run_refuses_before_the_limit_cycle_is_computed(monkeypatch):
    """It took minutes to find that the waves lie outside the database"""
    made = SimpleNamespace(point="point", findings=())
    study = SimpleNamespace(slewing="slewing", maps=())
    for name, value in {"given": (study, ""), "make": made, "equilibria": [1], "preferred": one(), "check_maps": None,
                        "check_buoy": None}.items():  # fmt: skip
        monkeypatch.setattr(result, name, lambda *given, value=value: value)
    monkeypatch.setattr(result, "_cycle_of", lambda *given: pytest.fail("the limit cycle was computed"))
    monkeypatch.setattr(running, "check", lambda study, db: None)

    def refused(*given):
        raise ValueError("waves outside")

    monkeypatch.setattr(running, "run", refused)
    with pytest.raises(ValueError, match="waves outside"):
        result.single_point({})
