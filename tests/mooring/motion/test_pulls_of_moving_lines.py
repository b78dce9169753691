"""Pulls of moving lines over a step of the body: a parabola in time is kept whole, in own steps of any size."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

steps = plain("mooring.motion.moving_lines.steps")
T0, H = 5.0, 0.8
PARABOLA = np.array([[3.0, -1.0, 7.0], [2.0, 0.5, -4.0], [-1.5, 1.0, 0.7]])  # N of 1, t, t²
TIMES = [[5.0, 5.1, 5.45, 5.8], [5.0, 5.8]]  # of two lines; number 2 and number 0 of three


def force(t):
    return np.array([1.0, t, t * t]) @ PARABOLA


@pytest.fixture
def lines():
    """(moving, work) after a step from T0; before it both lines took a step of 0.3 s"""
    moving = SimpleNamespace(number=np.array([2, 0]))
    time, pull = np.zeros((2, 6)), np.zeros((2, 6, 3))
    for i, own in enumerate(TIMES):
        time[i, : len(own)], pull[i, : len(own)] = own, [force(t) for t in own]
    before = np.array([[T0 - 0.3, *force(T0 - 0.3)]] * 2)
    parts = {name: np.arange(2.0 * 5 * 3).reshape(2, 5, 3) + k
             for k, name in enumerate(("position", "velocity", "acceleration", "slip"))}  # fmt: skip
    return moving, SimpleNamespace(
        time=time, pull=pull, before=before, slope=np.zeros((2, 6, 3)), used=np.array([4, 2]), last=np.zeros((3, 4, 3)),
        length=np.zeros(1), step=np.array([[0.1, 0.1], [0.2, 0.3]]), steps=np.array([10, 20]),
        tension=np.zeros((2, 2)), **parts,
    )  # fmt: skip


def test_a_cubic_goes_from_one_place_and_velocity_to_another():
    p, v, q, w = np.random.default_rng(1).normal(size=(4, 3))
    c = np.zeros((4, 3))
    steps.piece(p, v, q, w, 0.4, c)
    t = 0.4
    assert (c[0], c[1]) == (pytest.approx(p), pytest.approx(v))
    assert c[0] + t * (c[1] + t * (c[2] + t * c[3])) == pytest.approx(q)
    assert c[1] + t * (2 * c[2] + 3 * t * c[3]) == pytest.approx(w)


def test_slopes_of_a_parabola_are_its_own_and_it_is_met_between_the_ends_of_own_steps(lines):
    _, work = lines
    for i, own in enumerate(TIMES):
        steps.slopes(work, i)
        for j, t in enumerate(own):
            assert work.slope[i, j] == pytest.approx(PARABOLA[1] + 2 * t * PARABOLA[2])
        for j, (a, b) in enumerate(pairwise(own)):
            at = a + 0.3 * (b - a)
            assert [steps.between(work, i, j, at, k) for k in range(3)] == pytest.approx(force(at))


def test_a_parabola_has_three_moments_over_the_step_and_goes_on_straight(lines):
    """With s = (1 + x)/2: F(T0 + Hs) = c₀ + c₁P₁(x) + c₂P₂(x), x² = (1 + 2P₂)/3; drawn on as c₀ + c₁P₁"""
    moving, work = lines
    for i in range(2):
        steps.slopes(work, i)
    given = np.full((3, 4, 3), 9.0)
    steps.project(moving, work, T0, H, given)
    middle, half = T0 + H / 2, H / 2
    square = PARABOLA[2] * half**2
    wanted = [force(middle) + square / 3, (PARABOLA[1] + 2 * middle * PARABOLA[2]) * half, 2 * square / 3]
    for number in (2, 0):
        assert given[number, :3] == pytest.approx(np.array(wanted))
        assert given[number, 3] == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.all(given[1] == 9.0)  # no line that moves

    work.last[:], work.length[0] = given, H
    foreseen = np.full((3, 4, 3), 9.0)
    steps.foresee(moving, work, 0.2, foreseen)
    straight = [wanted[0] + (1 + 0.25) * wanted[1], 0.25 * wanted[1], 0 * wanted[0], 0 * wanted[0]]
    for number in (2, 0):
        assert foreseen[number] == pytest.approx(np.array(straight))
    assert np.all(foreseen[1] == 9.0)


def test_what_was_on_trial_is_kept_and_the_end_of_the_last_own_step_but_one(lines):
    moving, work = lines
    work.used[1] = 0  # lost, and so left as it is
    old, given = work.before.copy(), np.arange(36.0).reshape(3, 4, 3)
    steps.keep_lines(moving, work, H, given)
    for name in ("position", "velocity", "acceleration", "slip"):
        now, trial = getattr(work, name)
        assert np.array_equal(now, trial)
    assert np.array_equal(work.last, given)
    assert (work.length[0], work.step[0].tolist(), work.steps.tolist()) == (H, [0.2, 0.3], [13, 20])
    assert work.before[0] == pytest.approx([5.45, *force(5.45)])
    assert np.array_equal(work.before[1], old[1])


def test_tensions_are_those_of_the_own_step_that_a_time_is_in(lines):
    moving, work = lines
    for i in range(2):
        steps.slopes(work, i)
    for t in (5.0, 5.05, 5.2, 5.6, 5.8):
        steps.put_tensions(moving, work, 1, t)
        assert work.tension == pytest.approx(np.array([[0.0, 0.0], [np.linalg.norm(force(t))] * 2]))
    work.used[0] = 1
    work.tension[:] = 0
    steps.put_tensions(moving, work, 0, 5.2)
    assert work.tension[0] == pytest.approx([0.0, np.linalg.norm(force(5.2))])
