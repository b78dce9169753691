"""What `hakobune single-point` says, stores and draws of runs in time and maps that are made up."""

import io
import math
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hakobune.mooring.single_point.history import Cycle, Record
from hakobune.pipelines.single_point import command, maps, running
from hakobune.pipelines.single_point.running import Run, datasets, largest_of, show, words

TIME = np.arange(0.0, 400.0, 0.5)
W = 2 * math.pi / 20


def run(cycle=None, heading=0.0, wave=0.0, gusts=0.0, drifts=False, settled=np.nan, stable=True, findings=()):
    """A body whose waves of 20 s have 0.01 j + 0.01 of `wave` in the mode j, along x and y"""
    n = len(TIME)
    motion = wave * np.sin(W * TIME)[:, None] * 0.01 * np.arange(1, 7)
    still = np.zeros((n, 2))
    hawser, lines = np.full((n, 1), 2e5), np.full((n, 2), 3e5)
    hawser[9], lines[7, 1] = 5e5, 9e5
    record = Record(TIME, still, np.full(n, heading), motion, still, hawser, lines, 10 + gusts * np.sin(TIME))
    names = SimpleNamespace(line_names=["a", "b"])
    steady = SimpleNamespace(
        heading=0.0, hawser=np.array([1e5]), lines=SimpleNamespace(tension=np.array([2e5, 3e5])),
        slewing=SimpleNamespace(stable=stable), point=SimpleNamespace(system=names, lengths=np.array([30.0])),
    )  # fmt: skip
    cycle = Cycle(math.radians(5.0), 250.0, 1.0, True) if cycle is None else cycle
    return Run(record, steady, cycle, settled, 12.34, drifts, findings, 100.0)


QUIET = Cycle(math.radians(0.5), np.nan, 1.0, False)


@pytest.mark.parametrize("made, says", [
    (run(), "the body slews: ±5.0° at a period of 250 s at the end of the run"),
    (run(Cycle(math.radians(5), 250, 1.021, True)),
     "the body slews: ±5.0° at a period of 250 s at the end of the run, still growing"),
    (run(Cycle(math.radians(5), 250, 1.019, True)), "the body slews: ±5.0° at a period of 250 s at the end of the run"),
    (run(gusts=1.0), "the heading swings ±5.0° at about 250 s at the end: gusts and slow drift drive it, at rest it is "
                     "stable"),
    (run(drifts=True), "the heading swings ±5.0° at about 250 s at the end: gusts and slow drift drive it, at rest it "
                       "is stable"),
    (run(gusts=1.0, stable=False), "the body slews: ±5.0° at a period of 250 s at the end of the run"),
    (run(QUIET, math.radians(3), settled=1200.0), "the heading decays from 3° to within 0.2° of rest in 1200 s"),
    (run(QUIET), "the heading is still 0.5° about its mean at the end of the run"),
])  # fmt: skip
def test_what_is_said_of_a_heading(made, says):
    said = list(words(made))
    assert said[0] == says
    assert said[-1] == "watch circle of the centre of mass about the buoy at rest: 12.3 m" and len(said) == 2


def test_motions_in_waves_are_told_along_and_across_the_hull_with_angles_in_degrees():
    """σ = a/√2; a hull that heads along y has its surge there"""
    s = [0.01 * j / math.sqrt(2) for j in range(1, 7)]
    said = list(words(run(wave=100.0, heading=math.pi / 2, findings=("found",))))
    angles = [math.degrees(100 * one) for one in s[3:]]
    assert said[1] == (
        f"wave motion, standard deviations: surge {100 * s[1]:.2g} m, sway {100 * s[0]:.2g} m, heave {100 * s[2]:.2g} "
        f"m, roll {angles[0]:.2g}°, pitch {angles[1]:.2g}°, yaw {angles[2]:.2g}°"
    )
    assert said[2] == "slow drift is not in the run; the report adds 20 % for it" and said[-1] == "found"
    assert not any("report adds" in line for line in words(run(wave=100.0, drifts=True)))


def test_the_report_s_fifth_is_added_where_slow_drift_is_left_out():
    for drifts, waves, factor in ((False, True, 1.2), (True, True, 1.0), (False, False, 1.0)):
        hawser, lines = largest_of(run(drifts=drifts), waves)
        assert hawser == pytest.approx([factor * 5e5]) and lines == pytest.approx([factor * 3e5, factor * 9e5])


def test_tensions_stand_in_kilonewtons_and_with_the_fifth():
    """Significant is steady + ⅔ of what the largest is above it: 100 + 267, 300 + 400"""
    for drifts in (False, True):
        console = Console(file=io.StringIO(), width=200)
        show(console, run(drifts=drifts))
        said = console.file.getvalue().splitlines()
        assert said[0].strip() == "400 s in time, kN"  # 399.5 s
        rows = {
            line.split("│")[1].strip(): [one.strip() for one in line.split("│")[2:-1]] for line in said if "│" in line
        }
        mean, mean_b = 200 + 300 / len(TIME), 300 + 600 / len(TIME)
        expected = {"hawser 1": (100, mean, 366.7, 500), "a": (200, 300, 266.7, 300), "b": (300, mean_b, 700, 900)}
        for name, values in expected.items():
            fifth = [] if drifts else [1.2 * values[2]]
            assert [float(one) for one in rows[name]] == pytest.approx([*values, *fifth], rel=1e-3)
        assert ("significant + 20 %" in " ".join(said)) is not drifts


def test_a_file_has_each_record_under_its_name():
    made = run(wave=1.0, gusts=2.0, heading=0.1)
    held = datasets(made)
    assert {name: unit for name, (unit, _) in held.items()} == {
        "time": "s", "place": "m", "heading": "rad", "wave_motion": "m, m, m, rad, rad, rad", "buoy": "m",
        "hawser_tension": "N", "line_tension": "N", "wind_speed": "m/s",
    }  # fmt: skip
    assert held["line_tension"][1] is made.record.lines and held["hawser_tension"][1] is made.record.hawser
    assert held["wave_motion"][1] is made.record.wave and held["heading"][1] is made.record.heading


def test_a_run_is_drawn_in_degrees_and_kilonewtons(tmp_path, pictures, monkeypatch):
    from hakobune.pipelines.single_point import pictures as drawn

    hulls = []
    monkeypatch.setattr(drawn, "draw_hull", lambda axis, study, point, place, heading, **_: hulls.append(heading))
    monkeypatch.setattr(drawn, "draw_lines", lambda *_: None)
    made = run(wave=1.0, heading=0.1)
    running.draw(SimpleNamespace(hull=SimpleNamespace(length=100.0)), made, tmp_path / "run.png")
    heading, hawser, lines, plan = pictures[0].axes
    turned = np.degrees(0.1 + 0.06 * np.sin(W * TIME))
    assert heading.lines[0].get_ydata() == pytest.approx(turned) and heading.get_ylabel() == "heading, °"
    assert hawser.lines[0].get_ydata().max() == 500.0 and hawser.get_ylabel() == "hawser, kN"
    assert lines.lines[0].get_ydata().max() == 900.0 and lines.get_ylabel() == "b, kN"
    assert (lines.get_xlabel(), plan.get_xlabel(), plan.get_ylabel()) == ("time, s", "x, m", "y, m")
    assert len(hulls) == 7 and plan.get_xlim() == (-80.0, 120.0) and plan.get_ylim() == (-120.0, 120.0)


def found(growth, keys=("hawser.length",), failed=0):
    growth = np.atleast_2d(growth)
    return maps.Map(**{name: None for name in maps.Map._fields} | {
        "keys": keys, "x": np.arange(growth.shape[1]) + 1.0, "y": np.arange(growth.shape[0]) + 5.0, "growth": growth,
        "failed": failed, "reason": "why"})  # fmt: skip


def test_maps_tell_how_much_of_them_slews_and_what_has_no_answer(tmp_path, monkeypatch, capsys):
    """Of four answers three are above 0; the fifth place has none"""
    made = found([1.0, 2.0, -1.0, 3.0, np.nan], failed=1)
    monkeypatch.setattr(maps, "computed", lambda *_: made)
    monkeypatch.setattr(maps, "draw", lambda *_: None)
    console = Console(file=io.StringIO(), width=200)
    for count, names in ((1, ["s_slewing.png"]), (2, ["s_slewing_1.png", "s_slewing_2.png"])):
        study = SimpleNamespace(maps=[None] * count)
        paths, lost = command._maps(study, None, None, ("s.toml", None), console)
        assert [path.name for path in paths] == names
        assert lost == ["map over hawser.length: 1 of 5 places have no answer: why"] * count
    assert console.file.getvalue().splitlines()[0] == "map over hawser.length: 75 % of it slews"
    made = found([1.0, 2.0])
    monkeypatch.setattr(maps, "computed", lambda *_: made)
    assert command._maps(SimpleNamespace(maps=[None]), None, None, ("s.toml", None), console)[1] == []


def test_growth_is_drawn_per_hour(tmp_path, pictures):
    maps.draw(found([1e-3, -2e-3]), tmp_path / "a.png")
    maps.draw(found([[1e-3, -2e-3], [5e-4, 1e-4]], ("hawser.length", "wind.speed")), tmp_path / "b.png")
    one, two = pictures
    assert one.axes[0].lines[0].get_xydata() == pytest.approx(np.array([[1, 3.6], [2, -7.2]]))
    assert one.axes[0].get_xlabel() == "hawser.length, m"
    assert one.axes[0].get_ylabel() == "growth of the slowest motion, 1/h (above 0 it slews)"
    mesh = two.axes[0].collections[0]
    assert np.asarray(mesh.get_array()).ravel() == pytest.approx(np.array([3.6, -7.2, 1.8, 0.36]))
    assert mesh.get_clim() == pytest.approx((-7.2, 7.2))
    assert two.axes[0].get_ylabel() == "wind.speed, m/s" and len(two.axes[0].collections) == 2
    assert two.axes[1].get_ylabel() == "growth of the slowest motion, 1/h (red: it slews)"
