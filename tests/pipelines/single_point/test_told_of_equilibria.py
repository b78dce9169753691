"""Findings, overloads and tables of `hakobune single-point`, of equilibria that are made up."""

import io
import math
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hakobune.mooring.loads.turning import FITTED
from hakobune.pipelines.single_point import report


def one(growth=-1e-3, heading=0.0, period=250.0, hawser=(1e5, 2e5), used=(0.3, np.nan), breaking=(1e6, np.inf)):
    system = SimpleNamespace(line_names=["a", "b"], breaking_load=np.array(breaking))
    lines = SimpleNamespace(utilisation=np.array(used), grounded_length=np.array([12.3, 45.6]))
    return SimpleNamespace(
        heading=heading, pull=2.5e5, hawser=np.array(hawser), point=SimpleNamespace(system=system),
        slewing=SimpleNamespace(growth=growth, stable=growth < 0, period=period),
        lines=SimpleNamespace(lines=lines, tension=np.array([3e5, 4e5])),
    )  # fmt: skip


def findings(found, turning=False, speed=0.0, direction=0.0, told=()):
    water = SimpleNamespace(turning=turning, speed=speed, direction=direction)
    made = SimpleNamespace(findings=told, point=SimpleNamespace(loads=SimpleNamespace(water=water)))
    return list(report.findings(None, made, found))


def test_the_equilibrium_that_decays_fastest_is_preferred():
    found = [one(-1e-3), one(-2e-3), one(1e-3)]
    assert report.preferred(found) is found[1]
    assert report.preferred([one(3e-3), one(1e-3)]).slewing.growth == 1e-3


@pytest.mark.parametrize("degrees, bow", [(0.0, 0.0), (-90.0, 270.0), (360.004, 0.0), (-1e-9, 0.0), (359.996, 0.0)])
def test_the_bow_is_from_0_up_to_360_degrees(degrees, bow):
    assert report.bow(one(heading=math.radians(degrees))) == bow


def test_headings_that_are_stable_are_counted():
    assert findings([one(), one(1e-3)], told=("before",)) == ["before"]
    (said,) = findings([one(1e-3), one(2e-3)])
    assert said.startswith("no heading is stable: the body slews")
    (said,) = findings([one(), one(heading=math.pi / 2), one(1e-3)])
    assert said == "2 headings are stable (0°, 90°): the body lies at the one it comes to"


@pytest.mark.parametrize("angle, told", [(59.9, False), (60.1, True), (119.0, True), (121.0, False)])
def test_water_beyond_the_turning_tests_is_told(angle, told):
    """60° from ahead or from astern"""
    assert math.degrees(FITTED) == pytest.approx(60)
    at = dict(turning=True, speed=1.0, direction=math.radians(angle))
    said = findings([one()], **at)
    assert len(said) == told
    drift = min(angle, 180 - angle)
    assert all(f"meets the hull at {drift:.0f}°, {drift - 60:.0f}° beyond the turning tests (60°)" in s for s in said)
    assert findings([one()], **at | {"speed": 0.0}) == findings([one()], **at | {"turning": False}) == []


def overloads(best=None, cycle=None, run=None, load=1000.0, waves=True, allowable=0.4):
    hawser = None if load is None else SimpleNamespace(breaking_load_kN=load, breaking_load_tonf=None)
    study = SimpleNamespace(hawser=hawser, allowable=allowable, waves=waves or None)
    return list(report.overloads(study, best or one(), cycle, run))


@pytest.fixture
def load(monkeypatch):
    monkeypatch.setattr(report, "force", lambda name, table, key: 1e3 * table.breaking_load_kN)


def test_hawsers_and_lines_are_held_to_what_is_allowed_of_them(load):
    """100 and 200 kN of hawsers of 1 MN, 30 % of a line, another of no known strength"""
    assert overloads() == overloads(load=None) == []
    assert overloads(one(hawser=(1e5, 3.99e5))) == []
    (said,) = overloads(one(hawser=(1e5, 4.01e5)))
    assert "1 of 4 lines at rest above the allowable 40 % of the breaking load: hawser 2 40" in said
    assert said.endswith("give a stronger type or more lines")
    assert overloads(one(used=(0.399, np.nan))) == []
    (said,) = overloads(one(used=(0.41, np.nan)), load=None)
    assert "1 of 2 lines at rest above the allowable 40 %" in said and ": a 41 %" in said
    (said,) = overloads(one(hawser=(1.01e6, 1e5)))
    assert "beyond the breaking load" in said and "hawser 1 101 %" in said


def test_limit_cycles_and_runs_are_held_to_their_largest(load):
    pulls = np.array([[1e5, 1e5], [2e5, 4.1e5], [1e5, 1e5]])
    cycle = SimpleNamespace(hawser=pulls, lines=np.array([[3e5, 9e9], [4.2e5, 9e9], [0, 9e9]]))
    (said,) = overloads(cycle=cycle)
    assert "2 of 4 lines in the limit cycle above the allowable 40 %" in said and ": a 42 %, hawser 2 41 %" in said
    run = SimpleNamespace(drifts=False, record=SimpleNamespace(hawser=pulls * 0.85, lines=np.full((3, 2), 1e5)))
    (said,) = overloads(run=run)  # 41 % · 0.85 · 1.2
    assert "in the run in time above" in said and "hawser 2 41.82 %" in said
    assert overloads(run=run, waves=False) == []
    run.drifts = True
    assert overloads(run=run) == []


def shown(table):
    console = Console(file=io.StringIO(), width=160)
    console.print(table)
    lines = [line for line in console.file.getvalue().splitlines() if line.strip()]
    return lines[0].strip(), [[cell.strip() for cell in line.split("│")[1:-1]] for line in lines if "│" in line]


def test_tables_of_equilibria_and_lines():
    title, rows = shown(report._equilibria_table([one(heading=-math.pi / 2), one(2e-3, period=np.inf)]))
    assert title == "headings of rest"
    assert rows == [["270.00", "yes", "-1.00e-03", "250", "250.0", "100.0 200.0", "400.0"],
                    ["0.00", "no", "2.00e-03", "–", "250.0", "100.0 200.0", "400.0"]]  # fmt: skip
    title, rows = shown(report._lines_table(one(heading=math.pi / 4), 0.4))
    assert title == "lines at 45.0°"
    assert rows == [["a", "300.0", "12", "30.0"], ["b", "400.0", "46", "unknown"]]


@pytest.mark.parametrize("used, red", [(0.399, False), (0.401, True)])
def test_lines_above_what_is_allowed_are_red(used, red):
    rows = report._lines_table(one(used=(used, 0.1)), 0.4).rows
    assert [row.style == "red" for row in rows] == [red, False]
