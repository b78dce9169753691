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


def swing(point, state, sign, longest, accuracy):
    """To the lowest heading of a swing of 2 s from cos t down, or up again to 0.8 of what it was"""
    assert (longest, accuracy) == (50.0, cycle.ACCURACY)
    mean, size = 0.3, state[2] - 0.3
    last = mean + (-size if sign > 0 else -0.8 * size)
    path = lambda t: np.array([t, 10 * t, mean + size * np.cos(np.pi * t) * (1 if sign > 0 else 0.9), 0, 0, 0])  # noqa: E731
    end = np.array([1.0, 10.0, last, 0.0, 0.0, 0.0])
    return SimpleNamespace(
        t=np.array([0.0, 1.0]), y=np.array([state, end]).T, sol=lambda t: np.array([path(one) for one in t]).T
    )


def test_a_period_goes_down_and_up_with_its_amplitude_and_what_it_loses(monkeypatch):
    """From 0.3 + 0.2 down to 0.3 − 0.2 and up to 0.3 + 0.16: ½ of what is between the lowest and the mean highest"""
    monkeypatch.setattr(cycle, "until_turn", swing)
    state = np.array([0.0, 0.0, 0.5, 0.0, 0.0, 0.0])
    one = cycle._period("point", state, 50.0)
    assert one.length == 2.0 and one.end[2] == pytest.approx(0.46)
    assert one.amplitude == pytest.approx(0.5 * (0.48 - 0.1)) and one.change == pytest.approx(-0.04 / 0.19)
    found = one.samples(np.array([0.0, 0.5, 1.0, 1.5]))
    assert found.shape == (4, 6) and found[:, 0] == pytest.approx([0.0, 0.5, 0.0, 0.5])
    assert found[:2, 2] == pytest.approx([0.5, 0.3]) and found[2, 2] == pytest.approx(0.3 - 0.9 * 0.2)
    still = cycle._period("point", np.array([0.0, 0.0, 0.3, 0.0, 0.0, 0.0]), 50.0)
    assert still.change == 0.0 and still.amplitude == pytest.approx(0.0)


def test_a_state_is_scaled_about_the_mean_of_its_period_and_less_where_lines_do_not_reach(monkeypatch):
    """Mean 2 of every motion and an end of 6: by 4 to 18, which is beyond reach above 11, by 2 to 10"""
    asked = []

    def period(point, state, longest):
        asked.append(state.tolist())
        if state[0] > reach:
            raise cycle.SinglePointError("beyond")
        return SimpleNamespace(end=("end of", state[0]))

    monkeypatch.setattr(cycle, "_period", period)
    one = SimpleNamespace(
        length=8.0, end=np.full(6, 6.0), samples=lambda t: np.full((len(t), 6), 2.0) + (t[:, None] - t.mean())
    )
    reach = 11.0
    assert cycle._scaled("point", one, 4.0, 50.0) == ("end of", 10.0) and asked == [[18.0] * 6, [10.0] * 6]
    reach = 0.0
    assert cycle._scaled("point", one, 4.0, 50.0) is one.end and len(asked) == 2 + cycle.HALVED
