"""Parts of the search for a cycle by hand: what is foreseen, and what is sampled of a period."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.single_point import limit_cycle as cycle
from hakobune.mooring.single_point.limit_cycle import SAMPLES, _foreseen, _Period, _sampled


def found_at(amplitude, change):
    return _Period(amplitude, change, 1.0, None, None)


def test_a_period_that_changes_by_a_line_in_the_square_of_the_amplitude_foresees_the_cycle():
    """g = 0.3 − 1.2 A²: nothing changes at A = 1/2, from either side"""
    g = lambda A: 0.3 - 1.2 * A * A  # noqa: E731
    for first, second in ((0.1, 0.2), (0.9, 0.7), (0.2, 0.8)):
        assert _foreseen(found_at(first, g(first)), found_at(second, g(second))) == pytest.approx(0.5)
    assert _foreseen(found_at(0.2, 0.1), found_at(0.4, 0.0)) == 0.4


def test_where_a_swing_grows_the_faster_the_larger_or_dies_out_no_cycle_is_in_sight():
    assert _foreseen(found_at(0.1, 0.1), found_at(0.2, 0.2)) is None
    assert _foreseen(found_at(0.2, 0.1), found_at(0.2, 0.05)) is None
    assert _foreseen(found_at(0.1, -0.2), found_at(0.2, -0.4)) is None  # g = 0 at A² < 0


def test_every_state_of_a_period_has_its_hawsers_and_lines(monkeypatch):
    """Tensions that are the place and the heading; each state is sought from the buoy of the one before"""
    seen = []

    def hold(place, heading, near):
        seen.append(near)
        return SimpleNamespace(buoy=np.array([place[0], heading]), tension=np.array([5 + place[1], 7 + heading]))

    monkeypatch.setattr(cycle, "line_tensions", lambda point, buoy: 3 * buoy)
    point = SimpleNamespace(hold=hold, ends=np.zeros((2, 2)))
    length = 80.0

    def samples(t):
        a = 2 * math.pi * t / length
        return np.stack([np.sin(a), np.cos(a), 0.1 + 0.3 * np.cos(a), 0 * a, 0 * a, 0 * a], axis=1)

    found = _sampled(point, _Period(0.0, 0.0, length, samples, None))
    states = samples(np.linspace(0, length, SAMPLES + 1))
    assert (found.period, found.amplitude, found.middle) == pytest.approx((80.0, 0.3, 0.1))
    assert found.time[[0, 1, -1]] == pytest.approx([0.0, 80 / SAMPLES, 80.0])
    assert found.states == pytest.approx(states)
    assert found.hawser == pytest.approx(np.stack([5 + states[:, 1], 7 + states[:, 2]], axis=1))
    assert found.lines == pytest.approx(3 * states[:, [0, 2]])
    assert seen[0] is None and np.array(seen[1:]) == pytest.approx(states[:-1][:, [0, 2]])
