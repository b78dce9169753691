"""Runs of a body at a single point put together from what is computed elsewhere, which is made up here."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Components
from hakobune.mooring.single_point import history, in_time, runs, two_scale
from hakobune.mooring.single_point.waves import RING

WAVES = SimpleNamespace(omega=np.array([0.5, 1.0]), amplitude=np.array([2.0, 1.0]))  # ω̄ = (4 · 0.5 + 1 · 1)/5 = 0.6
TIMES = runs.Times(600.0, waves_after=100.0, tolerance=1e-3, seed=9)


class Reader:
    """A body whose excitation at ω rad/s in heading β is ω + β in surge, and whose coefficients are ω, 2ω"""

    depth, gravity, rotation_center = np.inf, 9.80665, (3.0, 4.0, 5.0)
    between = SimpleNamespace(span=(0.2, 2.0))
    inertia, damping, stiffness = np.eye(6), 3.0 * np.eye(6), 7.0 * np.eye(6)

    def floating(self):
        return self

    def coefficients(self, omega):
        return omega[:, None, None] * np.eye(6), 2 * omega[:, None, None] * np.eye(6)

    def forces(self, omega, headings):
        assert np.all(np.diff(omega) > 0)
        made = np.zeros((len(omega), len(headings), 6), complex)
        made[..., 0] = omega[:, None] + headings
        return made


def test_a_body_in_waves_has_the_force_of_each_of_them_whatever_their_order():
    """Added mass and damping are those of the mean frequency (1 · 1.2 + 4 · 0.4 + 9 · 0.8)/14 = 0.714, k = ω²/g"""
    omega, amplitude = np.array([1.2, 0.4, 0.8]), np.array([1.0, 2.0, 3.0])
    components = Components(omega, amplitude, np.array([0.1, 0.2, 0.3]), np.array([1.0, 2.0, 3.0]))
    body = two_scale.wave_body(Reader(), components, 5.5)
    mean = (1 * 1.2 + 4 * 0.4 + 9 * 0.8) / 14
    assert body.mean_omega == pytest.approx(mean)
    assert body.force[:, 0, 0] == pytest.approx(omega) and body.force.shape == (3, RING, 6)
    assert body.force[1, RING // 4, 0] == pytest.approx(0.4 + np.pi / 2)
    assert body.number == pytest.approx(omega**2 / 9.80665) and tuple(body.center) == (3.0, 4.0)
    assert (body.omega.tolist(), body.phase.tolist(), body.direction.tolist()) == (
        omega.tolist(), [0.1, 0.2, 0.3], [1.0, 2.0, 3.0],
    )  # fmt: skip
    assert body.lever == 5.5 and body.amplitude.tolist() == amplitude.tolist()
    mass, damping, stiffness = (np.diag(part)[0] for part in (body.added, body.damping, body.stiffness))
    assert (mass, damping, stiffness) == pytest.approx((1 + mean, 3 + 2 * mean, 7.0))


def test_coefficients_of_a_mean_frequency_outside_what_is_stored_are_those_of_its_end():
    components = Components(np.array([3.0]), np.array([1.0]), np.zeros(1), np.zeros(1))
    assert two_scale.wave_body(Reader(), components, 0.0).mean_omega == 2.0


def steady(lengths=(30.0,), wind=None):
    body = SimpleNamespace(position=np.array([1.0, 2.0, 3.0]))
    point = SimpleNamespace(
        lengths=lengths, loads=SimpleNamespace(wind=wind), system=SimpleNamespace(bodies=[body]), origin=np.zeros(2)
    )
    return SimpleNamespace(point=point, heading=0.0, state=np.zeros(6))


def motion(count=400, step=0.5):
    """A slow surge of 10 m in 200 s and one of 0.5 m in 5 s; the rest apart"""
    time = step * np.arange(count)
    found = np.tile([0.0, 2.0, 3.0, 4.0, 5.0, 0.1], (count, 1))
    found[:, 0] = 10 * np.sin(2 * np.pi * time / 200) + 0.5 * np.sin(2 * np.pi * time / 5)
    return SimpleNamespace(time=time, motion=found, buoy=np.ones((count, 3)), hawser=np.ones((count, 1)),
                           findings=("b", "a"), buoy_lines=np.ones((count, 2)), wind_speed=np.zeros(count))  # fmt: skip


@pytest.mark.parametrize("drift", [True, False])
def test_a_run_in_one_equation_is_parted_into_slow_and_wave_motion(drift, monkeypatch):
    """Waves of a mean of 0.6 rad/s grow over two of their periods; the buoy moves from where it lies"""
    asked, found = {}, motion()
    monkeypatch.setattr(runs, "run_in_one", lambda *given, **more: asked.update(more, given=given) or found)
    moved = SimpleNamespace(reader=Reader(), findings=("a",))
    made = runs.full_run(steady(), TIMES, moved, WAVES, drift)
    grown = 2 * 2 * np.pi / 0.6
    assert asked["wave_ramp"] == pytest.approx((100.0, grown)) and asked["given"][2:] == (600.0, 0.5)
    assert (asked["tolerance"], asked["seed"], asked["drift"], asked["gusts"]) == (1e-3, 9, not drift, None)
    record = made.record
    slow = 10 * np.sin(2 * np.pi * found.time / 200) + 3.0
    middle = slice(100, 300)
    assert record.place[middle, 0] == pytest.approx(slow[middle], abs=0.02)
    assert record.place[:, 1] == pytest.approx(np.full(400, 6.0)) and record.heading == pytest.approx(np.full(400, 0.1))
    assert record.place[:, 0] + record.wave[:, 0] - 3.0 == pytest.approx(found.motion[:, 0])
    assert record.wave[5, [2, 3, 4]].tolist() == [3.0, 4.0, 5.0]
    assert record.buoy[0].tolist() == [2.0, 3.0] and made.findings == ("a", "b")
    assert made.full_waves == pytest.approx(100.0 + grown) and made.drifts is drift


def test_a_run_without_waves_is_slow_alone_with_the_gusts_of_its_wind(monkeypatch):
    asked, found = {}, motion()
    monkeypatch.setattr(runs, "run_in_one", lambda *given, **more: asked.update(more) or found)
    moved = SimpleNamespace(reader=Reader(), findings=())
    made = runs.full_run(steady(wind=SimpleNamespace(gusts="gusts")), TIMES, moved)
    assert asked["wave_ramp"] is None and asked["gusts"] == "gusts" and made.full_waves == np.inf
    assert made.record.place[:, 0] == pytest.approx(found.motion[:, 0] + 3.0) and not made.record.wave[:, 0].any()


def test_a_run_of_two_scales_has_thirty_steps_in_a_mean_period(monkeypatch):
    """T = 2π/0.5: steps of T/30 unless given; full waves two periods after they begin"""
    asked, found = [], motion()
    record = history.Record(found.time, found.motion[:, :2], found.motion[:, 5], found.motion, found.buoy[:, :2],
                            found.hawser, found.buoy_lines, found.wind_speed)  # fmt: skip
    monkeypatch.setattr(runs, "two_scale", lambda *given: asked.append(given) or record)
    monkeypatch.setattr(runs, "gusty", lambda point, duration, seed: (duration, seed))
    monkeypatch.setattr(runs, "turned_state", lambda *given: "start")
    body = SimpleNamespace(mean_omega=0.5)
    for step, wanted in ((None, 4 * np.pi / 30), (0.7, 0.7)):
        made = runs.two_scale_run(steady(), replace(TIMES, step=step), body)
        _, start, steps, given, gusts = asked[-1]
        assert (start, given, gusts) == ("start", body, (600.0, 9))
        assert (steps.duration, steps.slow, steps.waves_after) == (600.0, TIMES.slow_step, 100.0)
        assert steps.fast == pytest.approx(wanted)
        assert made.full_waves == pytest.approx(100.0 + 2 * 4 * np.pi) and made.record is record


@pytest.mark.parametrize("height, freedom, z", [
    (None, ("Surge", "Heave"), [0.5, 0.5 + 1]), (None, ("Surge",), [3.0, 3.0]), ([7.0, 8.0], ("Heave",), [7.0, 8.0]),
])  # fmt: skip
def test_lines_at_a_buoy_that_heaves_are_taken_at_its_height(height, freedom, z):
    """The larger of both ends, √(H² + V²): 5 of 3, 4 and 13 of 5, 12; each search begins at the height before"""
    seen = []

    def load(pose):
        seen.append(pose.place[0])
        rows = np.zeros((1, 5))
        rows[0, 1:] = [3.0, 5.0, 4.0, 12.0] if len(seen) == 1 else [8.0, 3.0, 15.0, 4.0]
        return SimpleNamespace(rows=rows)

    body = SimpleNamespace(position=(0.0, 0.0, 3.0), freedom=freedom)
    system = SimpleNamespace(bodies=[body], pose=SimpleNamespace(turn=None), composites=[1], hawsers=[], load=load)
    point = SimpleNamespace(system=system, pull=lambda place, last: SimpleNamespace(height=0.5 + (last or 0) * 2))
    found = history.line_tensions(point, np.array([[1.0, 2.0], [3.0, 4.0]]), height)
    assert found[:, 0].tolist() == [13.0, 17.0]
    assert np.array(seen)[:, 2].tolist() == z and np.array(seen)[:, 0].tolist() == [1.0, 3.0]


def test_slow_steps_have_the_wind_of_their_begin_and_waves_after_their_time(monkeypatch):
    """Steps of 10 s in five of 2 s for 25 s; a stand-in moves the place by the wind's speed and remembers its buoy"""
    asked = []
    held = lambda place, heading: SimpleNamespace(  # noqa: E731
        buoy=np.array([place[0], heading]), tension=np.array([10 * place[0]]), force="force"
    )
    point = SimpleNamespace(hold=held, ends=("one",), loads=SimpleNamespace(wind=SimpleNamespace(speed=8.0)))

    def advanced(point, state, step, parts, speed, near):
        asked.append((step, parts, speed, near.tolist()))
        return state + speed * np.array([1.0, 0.0, 0.5, 0.0, 0.0, 0.0])

    class Newmark:
        def __init__(self, body, step):
            asked.append(("newmark", step))

        def run(self, point, state, held, forces, wave, buoy, hawser):
            wave[:], buoy[:], hawser[:] = forces, -1.0, -2.0

    monkeypatch.setattr(two_scale, "_advanced", advanced)
    monkeypatch.setattr(two_scale, "_Newmark", Newmark)
    monkeypatch.setattr(two_scale, "line_tensions", lambda point, buoy: ("lines", len(buoy)))
    steps = two_scale.Steps(25.0, 10.0, 2.0, 10.0, parts=3)
    start = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0]
    found = two_scale.two_scale(point, start, steps, None, lambda t: 100 + t)
    assert asked == [(10.0, 3, 100.0, [1.0, 3.0]), (10.0, 3, 110.0, [101.0, 53.0]), (10.0, 3, 120.0, [211.0, 108.0])]
    assert found.time.tolist() == [2.0 * n for n in range(1, 13)]
    x = np.repeat([1.0, 101.0, 211.0], [5, 5, 2])
    assert (
        found.place[:, 0].tolist() == x.tolist()
        and found.wind_speed.tolist() == np.repeat([100, 110, 120], [5, 5, 2]).tolist()
    )
    assert found.buoy[:, 0].tolist() == x.tolist() and found.hawser[:, 0].tolist() == (10 * x).tolist()
    assert found.lines == ("lines", 12) and not found.wave.any()
    asked.clear()
    times = lambda state, heading, time: np.outer(time, np.ones(6))  # noqa: E731
    body = SimpleNamespace(mean_omega=2 * np.pi / 10.0, forces_at=times)
    found = two_scale.two_scale(point, start, steps, body)
    assert asked[0] == ("newmark", 2.0) and [one[2] for one in asked[1:]] == [8.0] * 3
    grown = np.clip((found.time - 10.0) / (20.0), 0, 1) * found.time
    grown[:5] = 0.0
    assert found.wave[:, 3] == pytest.approx(grown) and found.hawser[:, 0].tolist() == [10.0] * 5 + [-2.0] * 7


def a_run(drifts=False):
    """Of two hawsers and a line over three times; amplitudes of significant values are of the largest from steady"""
    record = SimpleNamespace(
        hawser=np.array([[10.0, 1.0], [40.0, 3.0], [25.0, 5.0]]), lines=np.array([[6.0], [9.0], [3.0]])
    )
    steady = SimpleNamespace(hawser=np.array([10.0, 2.0]), lines=SimpleNamespace(tension=np.array([6.0])))
    return SimpleNamespace(record=record, steady=steady, drifts=drifts)


def test_tensions_of_a_run_are_steady_mean_significant_and_largest_and_a_fifth_stands_for_slow_drift():
    """Significant: steady + ⅔ of the largest amplitude (SR179, 3.6)"""
    found = in_time.ropes_of(a_run())
    significant = np.array([10 + 20.0, 2 + 2.0, 6 + 2.0])
    wanted = dict(steady=[10, 2, 6], mean=[25, 3, 6], largest=[40, 5, 9], significant=significant,
                  significant_with_drift=1.2 * significant)  # fmt: skip
    assert list(found) == ["steady", "mean", "significant", "largest", "significant_with_drift"]
    for name, values in wanted.items():
        assert found[name] == pytest.approx(np.array(values, float)), name


@pytest.mark.parametrize("waves, drifts, more", [(True, False, 1.2), (True, True, 1.0), (False, False, 1.0)])
def test_a_fifth_is_added_in_waves_without_slow_drift(waves, drifts, more):
    hawsers, lines = in_time.largest_of(a_run(drifts), waves)
    assert hawsers == pytest.approx(more * np.array([40.0, 5.0])) and lines == pytest.approx([more * 9.0])


def test_pulls_are_those_at_rest_and_of_what_there_is_of_a_cycle_and_a_run():
    best = a_run().steady
    assert list(in_time.pulls(best)) == ["at rest"] and in_time.pulls(best)["at rest"][1].tolist() == [6.0]
    found = in_time.pulls(best, a_run().record, a_run(), True)
    fifth = "in the run in time, with 20 % for slow drift (SR179)"
    assert list(found) == ["at rest", "in the limit cycle", fifth]
    assert found["in the limit cycle"][0].tolist() == [40.0, 5.0] and found["in the limit cycle"][1].tolist() == [9.0]
    assert found[fifth][1] == pytest.approx([10.8])
    assert in_time.pulls(best, None, a_run(drifts=True), True)["in the run in time"][1] == pytest.approx([9.0])
    assert in_time.pulls(best, None, a_run())["in the run in time"][1] == pytest.approx([9.0])


@pytest.mark.parametrize("hawser, first", [(50.0, [0.8, 0.1]), (np.nan, [np.nan, np.nan]), (None, [])])
def test_what_is_used_of_lines_is_that_of_their_weakest_segment_and_of_hawsers_that_of_their_own(hawser, first):
    """Lines break at 20 and at an unknown load; a segment below a buoy uses 0.1 more than the pull at the body says"""
    system = SimpleNamespace(breaking_load=np.array([20.0, np.inf]))
    lines = SimpleNamespace(tension=np.array([6.0, 7.0]), lines=SimpleNamespace(utilisation=np.array([0.4, np.nan])))
    best = SimpleNamespace(hawser=np.array([10.0, 2.0]), lines=lines, point=SimpleNamespace(system=system))
    pulled = {"at rest": (best.hawser, lines.tension), "run": (np.array([40.0, 5.0]), np.array([12.0, 9.0]))}
    found = in_time.used_in(pulled, best, hawser)
    assert found["run"] == pytest.approx([*first, 0.7, np.nan], nan_ok=True)
    at_rest = [] if hawser is None else [10.0 / hawser, 2.0 / hawser]
    assert found["at rest"] == pytest.approx([*at_rest, 0.4, np.nan], nan_ok=True)
    lines.lines.utilisation = np.array([0.2, 0.3])  # less than the pull says, and of a load that only a segment has
    found = in_time.used_in(pulled, best, hawser)
    assert found["run"][-2:] == pytest.approx([0.6, np.nan], nan_ok=True)
    assert found["at rest"][-2:] == pytest.approx([0.2, 0.3])


def test_gusts_are_those_of_the_report_s_band_about_the_mean_wind_and_straight_between_half_seconds(monkeypatch):
    asked = []

    def record(gusts, t, seed, low, high, count):
        asked.append((gusts, t[[0, 1, -1]].tolist(), seed, low, high, count))
        return t**2

    monkeypatch.setattr(in_time, "gust_record", record)
    wind = SimpleNamespace(gusts="gusts", speed=20.0)
    blown = in_time.gusty(SimpleNamespace(loads=SimpleNamespace(wind=wind)), 30.0, 5)
    assert asked == [
        ("gusts", [0.0, 0.5, 31.5], 5 + 104729, pytest.approx(2e-3 * np.pi), pytest.approx(2 * np.pi), 400)
    ]
    assert blown(3.0) == 29.0 and blown(3.25) == pytest.approx(20 + (9.0 + 12.25) / 2)
    wind.gusts = None
    assert in_time.gusty(SimpleNamespace(loads=SimpleNamespace(wind=wind)), 30.0, 5) is None
    assert in_time.gusty(SimpleNamespace(loads=SimpleNamespace(wind=None)), 30.0, 5) is None
