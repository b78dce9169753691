"""What is said of a run of a dynamic line, on both sides of each limit, from numbers that are made up."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.dynamics import figures, simulation
from hakobune.pipelines.line_dynamics.findings import findings


def said(used=None, uniform=True, regime="none", fairlead=(1.0, 1.0), **more):
    """Lines on a run of 1000 kN at the fairlead, 900 kN at the anchor and 1000 kN anywhere, which repeats"""
    run = {"time": np.array([0.0, 1.0, 2.5]), "tension_fairlead": [1e6] * 3, "tension_anchor": [9e5] * 3,
           "largest_tension": [1e6] * 3}  # fmt: skip
    found = {"change": 0.0, "imbalance": 0.0, "exchanged": 1.0, "largest": 1e6} | {
        key: value for key, value in more.items() if key not in run
    }
    result = SimpleNamespace(**{key: np.array(more.get(key, value)) for key, value in run.items()})
    ratio, static = fairlead
    figures = SimpleNamespace(
        fairlead=SimpleNamespace(largest=found.pop("largest"), over_quasi_static=ratio, quasi_static=static),
        regime=regime, **found,
    )  # fmt: skip
    strength = SimpleNamespace(most_used=lambda line, result: used, uniform=uniform, names=("chain", "wire"))
    return [str(line) for line in findings(figures, result, strength, None)]


@pytest.mark.parametrize(
    ("quiet", "told", "words"),
    [
        ({"largest_tension": [0, 1.049e6, 0]}, {"largest_tension": [0, 1.0e6, 1.051e6]},
         "the largest tension lies between the ends of the line: 1051 kN at t = 2.50 s"),
        ({"largest": 0.9902e6}, {"largest": 0.99e6, "tension_fairlead": [1e6, 1.2e6, 1e6]},
         "the largest fairlead tension, 1200 kN at t = 1.00 s, occurs before the evaluated time"),
        ({"change": 0.0199}, {"change": 0.0201}, "changes by 2.0% between the last two cycles, allowed 2%"),
        ({"imbalance": -0.0199, "exchanged": 2.0}, {"imbalance": -0.0301, "exchanged": 2.0},
         "1.5% of the work at the ends is neither dissipated nor stored, allowed 1%"),
        ({"fairlead": (1.099, 1.0), "regime": SimpleNamespace(regime=1)},
         {"fairlead": (0.89, 1.0), "regime": SimpleNamespace(regime=1)},
         "predicts a quasi-static line, but the run differs by -11% from statics, allowed 10%"),
        ({"fairlead": (1.3, 1.0), "regime": SimpleNamespace(regime=2)}, {"fairlead": (1.0, np.nan)},
         "the line has no static shape at any position of its fairlead, so no quasi-static tension is given"),
        ({"fairlead": (1.3, 1.0), "regime": "not of this method"},
         {"fairlead": (1.101, 1.0), "regime": SimpleNamespace(regime=1)}, "+10% from statics"),
        ({"imbalance": 0.5, "exchanged": 0.0}, {"imbalance": 0.5, "exchanged": 1.0}, "50.0% of the work"),
    ],
)  # fmt: skip
def test_each_finding_is_told_beyond_its_limit(quiet, told, words):
    assert said(**quiet) == []
    (line,) = said(**told)
    assert words in line


@pytest.mark.parametrize(("share", "parts"), [(0.999, False), (1.01, True)])
def test_a_line_that_parts_is_named_with_its_segment(share, parts):
    used = SimpleNamespace(share=share, tension=2.02e6, time=3.25, breaking=2e6, segment=1)
    lines = said(used, uniform=False)
    assert bool(lines) is parts
    if parts:
        assert "the tension of segment 2 (wire) is 2020 kN at t = 3.25 s, 101 % of the breaking load 2000" in lines[0]
        assert "segment" not in said(used)[0]


@pytest.mark.parametrize("cycle, begin", [(None, 10.0), (8.0, 22.0)])
def test_a_line_is_at_rest_at_49_places_of_a_cycle_or_of_the_whole_window(cycle, begin, monkeypatch):
    """Both ends included; a place without a static shape has no tension, the others have theirs"""
    asked = []

    def simulate(line, motion, until, current, check_mesh):
        asked.append((line, motion, current, check_mesh))
        if len(asked) == 3:
            raise LineError("too short")
        return SimpleNamespace(tension_fairlead=[10.0 * len(asked), 0.0], tension_anchor=[1.0 * len(asked), 0.0])

    monkeypatch.setattr(simulation, "simulate", simulate)
    monkeypatch.setattr(simulation.FairleadMotion, "still", lambda place: tuple(place))
    course = SimpleNamespace(cycle=cycle, motion=SimpleNamespace(at=lambda t: (np.array([t, 2.0, -t]), None)))
    found, places = figures.quasi_static("line", course, (10.0, 30.0), "current")
    assert places.tolist() == [[t, 2.0, -t] for t in np.linspace(begin, 30.0, 49)]
    assert asked == [("line", tuple(place), "current", False) for place in places]
    assert np.isnan(found[2]).all() and np.delete(found, 2, axis=0).tolist() == [
        [10.0 * n, 1.0 * n] for n in range(1, 50) if n != 3
    ]
