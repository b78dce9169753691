"""States of a moored body that are added until the hours are known: which hours, how many, what is told and when it
ends.  The interpolant and the runs are stand-ins."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.downtime import simulated
from hakobune.pipelines.downtime.answers import NORMAL, YEAR, Verdicts

HOURS = 20
NAN = np.nan


@pytest.fixture
def call(monkeypatch):
    """simulated() with errors of the fits by the number of states; returns it, and what was run, said and asked"""
    known = SimpleNamespace(ran=[], said=[], asked=[], each=[], failing={}, errors={}, added=[])
    first = np.ones(HOURS)
    first[4] = NAN
    second = np.where(np.arange(HOURS) == 7, NAN, 2.0)

    def run(read, record, ready, path, executor, say, there, rows):
        known.ran.append(list(map(int, rows)))
        for row in map(int, rows):
            there[row] = {"failed": known.failing[row]} if row in known.failing else {"seeds": [row]}

    def used(limits, there, rows, seeds):
        return np.array([[[NAN if "failed" in there[int(row)] else 1.0] * 2] * seeds for row in rows])

    def fits(read, limits, x, height, at, used, exact):
        known.fitted = list(map(int, at)), len(used), exact.shape
        return [
            SimpleNamespace(name=name, hours=100.0, error=error, sea=2.0, mean="m", spread="s", free="f",
                            fit=SimpleNamespace(scatter="c"))
            for name, error in known.errors[len(at)]
        ]  # fmt: skip

    def more(x, mean, spread, scatter, free, count, taken):
        known.asked.append((mean, spread, scatter, free, count, len(taken)))
        return known.added.pop(0)

    monkeypatch.setattr(simulated, "_features", lambda hindcast, rows: (np.arange(len(rows))[:, None], 1.0 * rows))
    monkeypatch.setattr(simulated.states_file, "read", lambda path, identity: known.each.append((path, identity)) or {})
    monkeypatch.setattr(simulated, "_identity", lambda *given: "identity")
    monkeypatch.setattr(simulated, "_weather_used", lambda one, hindcast: np.full(HOURS, one))
    monkeypatch.setattr(simulated, "most_dissimilar", lambda x, count, first: np.arange(count) + (int(first) - 17))
    monkeypatch.setattr(simulated, "_run", run)
    monkeypatch.setattr(simulated, "_used", used)
    monkeypatch.setattr(simulated, "_fits", fits)
    monkeypatch.setattr(simulated, "where_it_may_change", more)
    monkeypatch.setattr(simulated, "_each", lambda limits, x, height, at, used: {"each": len(at)})
    chance = np.tile([0.25, 0.5], (HOURS, 1))
    verdicts = Verdicts(np.ones((HOURS, 2), bool), None, chance, None, None, None)
    monkeypatch.setattr(simulated, "_verdicts", lambda *given: verdicts)

    def ask(states=8, most=12, batch=2, tolerance=10.0):
        table = SimpleNamespace(states=states, most_states=most, batch=batch, seeds=3, tolerance_hours=tolerance)
        names = [SimpleNamespace(name="cranes"), SimpleNamespace(name="arms"), SimpleNamespace(name="by the weather")]
        read = SimpleNamespace(simulation=table, operations=names)
        hindcast = SimpleNamespace(waves=[SimpleNamespace(height=first), SimpleNamespace(height=second)])
        record = SimpleNamespace(hindcast=hindcast)
        return simulated.simulated(read, record, [0.5, NAN], "ready", "path", "executor", known.said.append)

    return ask, known


def test_hours_whose_seas_are_all_known_are_run_until_the_error_is_within_the_tolerance(call):
    """Of 20 hours the fourth and the seventh lack a sea.  18 are left, the highest of which is the last; two more
    twice, the second time without one that is there"""
    ask, known = call
    known.errors = {8: [("cranes", 20.0), ("arms", 30.0)], 10: [("cranes", 9.0), ("arms", 1.0)],
                    11: [("cranes", 1.0), ("arms", 6.0)]}  # fmt: skip
    known.added = [np.array([10, 11]), np.array([12, 3])]
    found = ask()
    eight = [0, 1, 2, 3, 5, 6, 8, 9]
    assert known.ran == [eight, [*eight, 12, 13], [*eight, 12, 13, 14]]
    assert known.asked == [("m", "s", "c", "f", 2, 8), ("m", "s", "c", "f", 2, 10)]
    assert known.fitted == ([0, 1, 2, 3, 4, 5, 6, 7, 10, 11, 12], 11, (18, 2)) and found.each == {"each": 11}
    assert found.rows.tolist() == [*eight, 12, 13, 14] and len(found.hours_at) == 18 and found.used.shape == (11, 3, 2)
    assert found.said == () and found.failed == () and known.each == [("path", "identity")]
    assert found.error.tolist() == [1.0, 6.0, 0.0] and found.sea.tolist() == [2.0, 2.0, 0.0]
    assert found.hours == pytest.approx([YEAR * 0.25, YEAR * 0.5])
    assert known.said[0] == (
        f"8 states: cranes 100 h a year, interpolation ± {NORMAL * 20:.3g} h, random sea ± {NORMAL * 2:.3g} h"
    )
    assert [line.split(" h a")[0] for line in known.said[1:3]] == ["8 states: arms 100", "10 states: cranes 100"]


def test_states_end_at_the_most_that_are_allowed_and_the_hours_left_open_are_told(call):
    """The last addition is the rest up to the most; 1.645 σ against the tolerance"""
    ask, known = call
    inside, outside = 0.99 * 10.0 / NORMAL, 1.01 * 10.0 / NORMAL
    known.errors = {8: [("cranes", 99.0), ("arms", 1.0)], 9: [("cranes", outside), ("arms", inside)]}
    known.added = [np.array([12])]
    found = ask(most=9)
    assert known.asked == [("m", "s", "c", "f", 1, 8)]
    assert found.said == (
        "cranes: the interpolation over 9 states is uncertain by ± 10.1 h a year, tolerance 10 h; raise most_states",
    )


def test_states_end_where_no_further_hour_would_change_anything(call):
    ask, known = call
    known.errors = {8: [("cranes", 99.0)]}
    known.added = [np.array([1, 2])]
    assert len(ask().rows) == 8 and len(known.ran) == 1


def test_states_without_an_answer_are_left_out_of_the_fit_and_told_with_their_hour(call):
    ask, known = call
    known.failing = {5: "no equilibrium"}
    known.errors = {8: [("cranes", 1.0)]}
    found = ask(states=9)
    assert known.fitted[0] == [0, 1, 2, 3, 5, 6, 7, 8] and found.rows.tolist() == [0, 1, 2, 3, 6, 8, 9, 10]
    assert found.failed == ((5, "no equilibrium; left out, its hour follows from other states"),)


def test_fewer_than_eight_states_with_an_answer_are_refused_with_the_first_reason(call):
    ask, known = call
    known.failing = {3: "first\u00a0reason", 5: "second"}
    with pytest.raises(StudyError) as refused:
        ask(states=9)
    assert str(refused.value) == ("only 7 of 9 states could be simulated, and at least 8 are needed: first\u00a0reason")
