"""Lines that move over a step of their body, as plain Python: what is on trial, pulls between own steps, moments."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

steps = plain("mooring.motion.moving_lines.steps")
esdirk = plain("mooring.lines.dynamics.lumped.esdirk")
T0, H = 3.0, 0.8
NODES = np.array([0, 2, 5, 9])  # of three lines


def work(lines=3, rows=9):
    rng, total = np.random.default_rng(2), int(NODES[-1])
    pair = {name: rng.normal(size=(2, total, 3)) for name in ("position", "velocity", "acceleration", "slip")}
    return SimpleNamespace(
        **pair, step=np.array([[0.1, 0.2, 0.3], [0.0, 0.0, 0.0]]), course=rng.normal(size=(lines, 3, 2, 3)),
        time=np.zeros((lines, rows)), pull=np.zeros((lines, rows, 3)), slope=np.zeros((lines, rows, 3)),
        used=np.zeros(lines, np.int64), before=np.zeros((lines, 4)), last=np.zeros((6, steps.TERMS, 3)),
        length=np.array([0.5]), tension=np.zeros((4, lines)), steps=np.zeros(lines, np.int64), stuck=np.array([7]),
        foreseen=None,
    )  # fmt: skip


MOVING = SimpleNamespace(number=np.array([4, 0, 2]), nodes=NODES, tolerance=1e-3, tension=np.array([10.0, 20.0, 30.0]),
                         distance=np.array([1.0, 2.0, 3.0]), systems=["line 0", "line 1", "line 2"],
                         rooms=["room 0", "room 1", "room 2"],
                         waters=[("water", *ends) for ends in pairwise(NODES)])  # fmt: skip


def test_lines_go_on_trial_from_where_the_body_left_them(monkeypatch):
    """Each from its own nodes at [0] into [1], along its course; a line that is not whole stays, the other two run"""
    asked, own = [], work()
    before = {name: getattr(own, name).copy() for name in ("position", "velocity", "acceleration", "slip", "course")}

    def run(system, room, sea, motion, control, scheme, state, until, rows, *more):
        asked.append((system, room, sea, control, state.time, state.step, until, [part.copy() for part in state[1:5]]))
        assert not rows[0, 7:13].any()
        rows[:3, 0] = T0, T0 + 0.3, until
        rows[:3, 1:4] = len(asked) * np.arange(1.0, 4.0)[:, None]
        rows[0, 7:13] = 9.0  # works of this line
        cubics.append(motion.cubics.copy() if hasattr(motion, "cubics") else motion[1].copy())
        return steps.DONE, 3, 0, until, 0.05 * len(asked), 0, 0, 0

    cubics, sloped = [], []
    monkeypatch.setattr(steps, "run", run)
    monkeypatch.setattr(steps, "slopes", lambda work, i: sloped.append(i))
    whole = np.array([True, False, False, False, True])
    assert steps.advance_lines(MOVING, own, whole, T0, H)
    assert own.stuck.tolist() == [-1] and sloped == [0, 1] and own.used.tolist() == [3, 3, 0]
    for i, (system, room, sea, control, time, step, until, parts) in enumerate(asked):
        at = slice(NODES[i], NODES[i + 1])
        assert (system, room, sea) == (f"line {i}", f"room {i}", ("water", NODES[i], NODES[i + 1]))
        assert (time, until) == (T0, T0 + H)
        assert step == own.step[0, i] and own.step[1, i] == pytest.approx(0.05 * (i + 1))
        for part, name in zip(parts, ("position", "velocity", "acceleration", "slip"), strict=True):
            assert np.array_equal(part, before[name][0, at]) and np.array_equal(getattr(own, name)[1, at], part)
        assert (control[0], control[1], control[2]) == (1e-3, MOVING.tension[i], MOVING.distance[i])
        assert control[3] == H and control[4] == pytest.approx(steps.SHORTEST * H)
        assert own.time[i, :3].tolist() == [T0, T0 + 0.3, T0 + H]
        assert np.array_equal(own.pull[i, :3], (i + 1) * np.repeat([[1.0], [2.0], [3.0]], 3, axis=1))
        start, middle, end = parts[0][-1], *before["course"][i, 1:, 0]
        for k, (a, b) in enumerate(((start, middle), (middle, end))):
            assert cubics[i][k, 0] == pytest.approx(a)
            assert cubics[i][k].T @ (0.5 * H) ** np.arange(4) == pytest.approx(b)
    assert np.array_equal(own.position[1, NODES[2] :], before["position"][1, NODES[2] :])


def test_a_line_that_cannot_follow_is_named_by_its_number(monkeypatch):
    monkeypatch.setattr(steps, "slopes", lambda *_: None)
    answers = iter([steps.DONE, steps.DONE + 1])
    monkeypatch.setattr(steps, "run", lambda *_: (next(answers), 1, 0, 0.0, 0.1, 0, 0, 0))
    own = work()
    assert not steps.advance_lines(MOVING, own, np.ones(5, bool), T0, H)
    assert own.stuck.tolist() == [0] and own.used[2] == 0


def test_a_cubic_has_places_and_velocities_of_both_ends():
    p, v, q, w = np.random.default_rng(3).normal(size=(4, 3))
    out = np.zeros((4, 3))
    steps.piece(p, v, q, w, 0.7, out)
    powers = 0.7 ** np.arange(4)
    assert out[0] == pytest.approx(p) and out[1] == pytest.approx(v) and powers @ out == pytest.approx(q)
    assert np.array([0, 1, 2 * 0.7, 3 * 0.49]) @ out == pytest.approx(w)


def quadratic(t, k):
    return (k + 1) * (2.0 - 3.0 * t + 0.5 * t * t)


def filled(times, before=2.7):
    """Work in which the pull of line 1 is `quadratic` at its own ends, and at a time before them"""
    own = work()
    own.used[:] = 0
    own.used[1] = len(times)
    own.time[1, : len(times)] = times
    for k in range(3):
        own.pull[1, : len(times), k] = quadratic(np.array(times), k)
    own.before[1] = before, *(quadratic(before, k) for k in range(3))
    return own


@pytest.mark.parametrize("times", [(3.0, 3.8), (3.0, 3.1, 3.8), (3.0, 3.2, 3.5, 3.8)])
def test_slopes_are_those_of_a_parabola_and_pulls_between_are_exact_for_it(times):
    own = filled(times)
    steps.slopes(own, 1)
    for j, t in enumerate(times):
        for k in range(3):
            assert own.slope[1, j, k] == pytest.approx((k + 1) * (t - 3.0))
    for j, (a, b) in enumerate(pairwise(times)):
        t = a + 0.3 * (b - a)
        assert steps.between(own, 1, j, t, 2) == pytest.approx(quadratic(t, 2))
    for row, t in enumerate((3.0, 3.15, 3.6, 3.8)):
        steps.put_tensions(MOVING, own, row, t)
        assert own.tension[row, 1] == pytest.approx(np.sqrt(14) * abs(quadratic(t, 0))) and own.tension[row, 0] == 0.0


def test_what_a_body_feels_keeps_the_impulse_and_the_moments_of_a_pull():
    """c_k = (2k + 1) ∫ F P_k ds against 4000 places, at the number of each line; a line that did not move pulls none"""
    own = filled((3.0, 3.2, 3.5, 3.8))
    steps.slopes(own, 1)
    given = np.ones((5, steps.TERMS, 3))
    steps.project(MOVING, own, T0, H, given)
    s = (np.arange(4000) + 0.5) / 4000
    for k in range(steps.TERMS):
        P = np.polynomial.legendre.Legendre.basis(k)(2 * s - 1)
        for m in range(3):
            assert given[0, k, m] == pytest.approx((2 * k + 1) * np.mean(quadratic(T0 + H * s, m) * P), abs=1e-5)
    assert not given[[2, 4]].any() and np.all(given[[1, 3]] == 1.0)


def test_the_straight_part_of_a_pull_is_drawn_on():
    """F = 5 + 2 P₁ over 0.5 s rises by 4: over the next 0.8 s it goes from 7 by 8 N/s: 10.2 ± 3.2"""
    own, given = work(), np.ones((5, steps.TERMS, 3))
    own.last[2, 0, 1], own.last[2, 1, 1], own.last[2, 2, 1] = 5.0, 2.0, 9.0
    steps.foresee(MOVING, own, H, given)
    assert given[2, :2, 1].tolist() == pytest.approx([10.2, 3.2]) and not given[2, 2:].any()
    assert np.all(given[[1, 3]] == 1.0) and not given[[0, 4]].any()


def test_a_step_that_was_taken_is_where_the_next_begins():
    own, given = filled((3.0, 3.2, 3.8)), np.random.default_rng(5).normal(size=(6, steps.TERMS, 3))
    own.step[1] = 0.7, 0.8, 0.9
    own.before[0] = 1.0, 2.0, 3.0, 4.0
    steps.keep_lines(MOVING, own, H, given)
    for name in ("position", "velocity", "acceleration", "slip"):
        assert np.array_equal(*getattr(own, name))
    assert np.array_equal(own.last, given) and own.length.tolist() == [H] and own.step[0].tolist() == [0.7, 0.8, 0.9]
    assert own.steps.tolist() == [0, 2, 0] and own.before[0].tolist() == [1.0, 2.0, 3.0, 4.0]
    assert own.before[1] == pytest.approx([3.2, *(quadratic(3.2, k) for k in range(3))])


def test_a_sea_around_lines_is_opened_where_the_last_does_not_last(monkeypatch):
    opened = []
    monkeypatch.setattr(steps, "open_sea", lambda *given: opened.append(given[-1]))
    monkeypatch.setattr(steps, "sea_ahead", lambda sea: 2.0)
    moving = SimpleNamespace(water=SimpleNamespace(clock=np.array([3.0])), nodes=None, room_of_sea=None)
    own = work()
    for t, h, opens in ((3.0, 2.0, False), (4.0, 1.0, False), (4.0, 1.01, True), (3.0, 2.1, True)):
        opened.clear()
        steps.sea_for_step("sea", moving, own, t, h)
        assert opened == ([t] if opens else [])
        steps.sea_for_step(None, None, own, t, h)  # still water
        assert len(opened) == opens


def test_a_scheme_of_kernels_is_one_of_third_order_beside_second_and_cannot_be_written():
    """TR-BDF2: Σ b = 1, Σ b c = ½; its b̂ with Σ b̂ c² = ⅓ (Hosea and Shampine 1996); stiffly accurate"""
    a, off, c = esdirk.tableau()
    b = a[-1]
    assert a.sum(axis=1) == pytest.approx(c) and c[-1] == pytest.approx(1.0) and a[1, 1] == a[2, 2]
    assert (b.sum(), b @ c) == pytest.approx((1.0, 0.5))
    third = b - off
    assert (third.sum(), third @ c, third @ c**2) == pytest.approx((1.0, 0.5, 1 / 3))
    assert not any(part.flags.writeable for part in (a, off, c))


def test_the_error_of_a_step_is_the_difference_of_two_formulas_in_all_three_directions(monkeypatch):
    """step · m Σ db (V + h d K) of every inner node, through the last matrix"""
    seen, rng = {}, np.random.default_rng(9)
    n, stages, step, hd = 5, 4, 0.3, 0.07
    K, V, db, inertia = *rng.normal(size=(2, stages, 3, n + 1)), rng.normal(size=stages), rng.uniform(1, 2, n + 1)
    node = np.zeros((esdirk.INERTIA + 1, n + 1))
    node[esdirk.INERTIA] = inertia
    work = SimpleNamespace(x=np.full((3, n + 1), 7.0), node=node, pivots="pivots", bending="bending")
    monkeypatch.setattr(esdirk, "substitute_line", lambda *given: seen.update(given=given, x=given[2].copy()))
    monkeypatch.setattr(esdirk, "spread", lambda work, last: ("spread", last))
    assert esdirk.error(SimpleNamespace(length=np.ones(n)), work, K, V, db, step, hd) == ("spread", n)
    wanted = step * inertia * np.einsum("k,kij->ij", db, V + hd * K)
    assert seen["x"][:, 1:n] == pytest.approx(wanted[:, 1:n]) and np.all(seen["x"][:, [0, n]] == 7.0)
    assert seen["given"][:2] == ("pivots", "bending") and seen["given"][4] == n and seen["given"][3] is work.x
