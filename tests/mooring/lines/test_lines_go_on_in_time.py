"""How a dynamic line goes on in time, as plain Python: nodes on springs with a known motion, steps by a known error."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

esdirk = plain("mooring.lines.dynamics.lumped.esdirk")
N = 3  # elements
START = np.array([[1.0, 2.0, 3.0], [0.5, -1.0, 0.2], [-2.0, 1.5, 1.0], [9.0, 9.0, 9.0]])  # the last is the fairlead's


class Line:
    """Nodes that swing at 1 rad/s from START; a step of h s has an error of (h/at)³ of what is allowed

    power of each of six kinds : 1, 2, … times the square of the first node's speed
    """

    def __init__(self, monkeypatch, at=0.05, step=0.04, longest=1.0, shortest=1e-6, tension=100.0, moving=False):
        self.at, self.lead, self.refuse, self.fails = at, [], (), lambda now: False
        self.water = "water" if moving else None
        self.control = SimpleNamespace(
            tolerance=1e-2, tension=tension, distance=7.0, longest=longest, shortest=shortest
        )
        self.state = SimpleNamespace(time=2.0, step=step, position=START.copy(), velocity=np.zeros((N + 1, 3)),
                                     acceleration=-START, slip=np.ones((N + 1, 3)))  # fmt: skip
        zeros = lambda *shape: np.zeros(shape)  # noqa: E731
        self.work = SimpleNamespace(kept=zeros(12, 3, N + 1), powers=zeros(3, 6), energy=zeros(6), q=zeros(3, N + 1),
                                    v=zeros(3, N + 1), u="u", du="du", T=zeros(N + 1), power=zeros(6),
                                    fairlead="room")  # fmt: skip
        self.rows, self.said, self.limits = [], [], []
        names = ("node_forces", "record", "solve_stage", "error", "fairlead_at", "begin_stage", "keep_slip", "water_at")
        for name in names:
            monkeypatch.setattr(esdirk, name, getattr(self, name))
        monkeypatch.setattr(esdirk, "lead", lambda motion, t, room, q, v, a, last: self.lead.append((t, room, last)))
        monkeypatch.setattr(esdirk, "worst_element", lambda work, last: 17 + last)

    def __call__(self, until=3.0, frames=(), rows=1000, first=()):
        table = np.zeros((rows, 20))
        table[0, 7:13] = 10.0
        table[0, : len(first)] = first
        self.frames, self.stations = np.zeros((len(frames), N + 1, 3)), np.zeros((rows, 3))
        self.table = table
        return esdirk.run(SimpleNamespace(length=np.ones(N)), self.work, self.water, "motion", self.control,
                          esdirk.tableau(), self.state, until, table, np.array(frames), self.frames,
                          np.array([0, 2, 3]), self.stations)  # fmt: skip

    def node_forces(self, s, work, a, slip, q, cq, cv):
        assert (cq, cv) == (0.0, 0.0) and np.all(slip == 1.0)
        work.T[:] = 0.0, 10.0, 20.0, 40.0
        work.power[:] = 0.0

    def record(self, row, t, step, s, work, energy):
        self.rows.append((t, step, work.q.copy(), work.v.copy(), energy.copy()))

    def begin_stage(self, work, qh, vh, k, last, cq, cv):
        self.begun = qh.copy(), vh.copy(), k.copy()

    def solve_stage(self, s, work, k, slip, q, cq, cv, tension, distance):
        qh, vh, before = self.begun
        self.limits.append((tension, distance))
        if self.fails(len(self.limits)):
            return esdirk.CONVERGED + 1, 5
        assert k == pytest.approx(before)
        k[:] = -qh / (1 + cq)
        work.q[:], work.v[:] = qh + cq * k, vh + cv * k
        work.power[:] = np.arange(1.0, 7.0) * work.v[0, 0] ** 2
        work.T[:] = 0.0, 10.0, 20.0, 40.0
        return esdirk.CONVERGED, 2

    def error(self, s, work, K, V, db, step, hd):
        assert hd == pytest.approx(step * (1 - np.sqrt(0.5)))
        size = (step / self.at) ** 3
        return size * 1e-2 * max(self.control.tension, 40.0), 0.5 * size * 1e-2 * 7.0

    def fairlead_at(self, *given): ...

    def keep_slip(self, s, q, v, slip, before, speed):
        assert np.any(q != before)
        slip += 1.0
        return 3.0

    def water_at(self, water, q, count, t, u, du):
        self.said.append((water, count, t, u, du))

    @property
    def steps(self):
        return [row[1] for row in self.rows[1:]]


def test_nodes_follow_their_motion_and_energies_its_work(monkeypatch):
    """q = q₀ cos t; ∫ v² = q₀² (t − sin t cos t)/2 of each kind, and 3 J of friction a step"""
    line = Line(monkeypatch)
    why, used, drawn, t, h, rejected, iterations, worst = line(until=3.0, frames=(2.0, 2.37, 2.8, 3.5))
    assert (why, used, drawn, t, rejected, iterations, worst) == (esdirk.DONE, 26, 3, 3.0, 0, 100, 0)
    assert h == pytest.approx(0.04) and line.steps == pytest.approx([0.04] * 25)
    time, _, q, v, energy = line.rows[-1]
    assert time == 3.0 and q == pytest.approx(START.T * np.cos(1.0), abs=1e-3)
    assert v == pytest.approx(-START.T * np.sin(1.0), abs=2e-3)
    work = 0.5 * (1 - np.sin(1.0) * np.cos(1.0))
    assert energy[:5] == pytest.approx(10.0 + work * np.arange(1.0, 6.0), rel=1e-3)
    assert energy[5] == pytest.approx(10.0 + 3.0 * 25)
    for frame, at in zip(line.frames, (0.0, 0.37, 0.8), strict=False):
        assert frame == pytest.approx(START * np.cos(at), abs=1e-3)
    assert not line.frames[3].any()
    for name, wanted in (("position", START * np.cos(1.0)), ("velocity", -START * np.sin(1.0)),
                         ("acceleration", -START * np.cos(1.0))):  # fmt: skip
        assert getattr(line.state, name) == pytest.approx(wanted, abs=2e-3)
    assert line.stations[:used] == pytest.approx(np.tile([10.0, 30.0, 40.0], (used, 1)))
    assert [one[0] for one in line.rows] == pytest.approx(2.0 + 0.04 * np.arange(26))


def test_stages_are_led_by_the_fairlead_and_judged_by_the_largest_tension(monkeypatch):
    """Of the tolerance a fiftieth; the scale is that of the study or the largest that there was"""
    for tension, first, scale in ((100.0, (), 100.0), (5.0, [0.0] * 18 + [60.0], 60.0), (5.0, (), 5.0)):
        line = Line(monkeypatch, tension=tension, step=0.125, at=10.0)
        line(until=2.25, first=first)
        (of_force, of_place), last = line.limits[0], line.limits[-1]
        assert (of_force, of_place) == pytest.approx((1e-2 * scale / 50, 1e-2 * 7.0 / 50))
        assert last[0] == pytest.approx(1e-2 * max(scale, 40.0) / 50)
    c = esdirk.tableau()[2]
    assert [one[0] for one in line.lead] == pytest.approx([2 + c[1] / 8, 2.125, 2.125 + c[1] / 8, 2.25])
    assert {one[1:] for one in line.lead} == {("room", N)}


@pytest.mark.parametrize("moving", [True, False])
def test_water_that_moves_is_that_of_the_begin_and_of_each_stage(monkeypatch, moving):
    line = Line(monkeypatch, moving=moving, step=0.125, at=10.0)
    line(until=2.125)
    times = [2.0, *(2 + 0.125 * c for c in esdirk.tableau()[2][1:])] if moving else []
    assert [one[2] for one in line.said] == pytest.approx(times)
    assert all(one[:2] == ("water", N + 1) and one[3:] == ("u", "du") for one in line.said)


def test_a_step_grows_by_its_error_but_not_by_more_than_six_tenths_nor_beyond_the_longest(monkeypatch):
    """0.8 of the step with the whole error; halved where two and less remain, and whole again for what is then left"""
    line = Line(monkeypatch, step=0.01, at=0.1)
    line(until=2.2)
    first = [0.01, 0.016, 0.0256, 0.04096]
    assert line.steps[:4] == pytest.approx(first)
    left = 0.2 - sum(first)
    assert line.steps[4:] == pytest.approx([0.5 * left, 0.5 * left])
    line = Line(monkeypatch, step=0.01, at=0.1, longest=0.02)
    line(until=2.2)
    assert line.steps[:3] == pytest.approx([0.01, 0.016, 0.02]) and max(line.steps) == 0.02
    assert Line(monkeypatch, step=0.5, at=10.0, longest=0.02)(until=2.1)[4] == 0.02


def test_a_step_with_too_large_an_error_is_taken_again_and_the_next_does_not_grow(monkeypatch):
    """0.8/2 of one that is twice too long, never below a fifth; rejected once and taken a step later alike"""
    line = Line(monkeypatch, step=0.2, at=0.1)
    _, _, _, _, _, rejected, _, _ = line(until=3.0)
    assert rejected == 1 and line.steps[:4] == pytest.approx([0.08] * 4) and line.rows[1][0] == pytest.approx(2.08)
    line = Line(monkeypatch, step=0.4, at=0.01)
    assert line(until=2.9)[5] == 3  # 0.4, 0.08, 0.016 and 0.008
    assert line.steps[0] == pytest.approx(0.4 * 0.2 * 0.2 * 0.5)
    near = Line(monkeypatch, step=0.11, at=0.1)
    near(until=4.0)
    assert near.steps[:2] == pytest.approx([0.08, 0.08])


def test_a_stage_that_is_not_solved_takes_a_quarter_of_the_step(monkeypatch):
    line = Line(monkeypatch, step=0.04)
    line.fails = lambda now: now == 2
    _, used, _, _, _, rejected, iterations, _ = line(until=2.1)
    assert rejected == 1 and line.steps[:2] == pytest.approx([0.01, 0.01]) and iterations == 2 + 5 + 4 * (used - 1)
    assert line.rows[1][0] == pytest.approx(2.01)


def test_a_run_ends_where_steps_are_too_short_or_its_rows_are_full_and_can_go_on(monkeypatch):
    line = Line(monkeypatch, step=0.04, shortest=0.009)
    line.fails = lambda now: now > 4
    why, used, _, t, _, _, _, worst = line(until=3.0)
    assert (why, used, worst) == (esdirk.TOO_SHORT, 3, 17 + N) and t == pytest.approx(2.08)
    line = Line(monkeypatch, step=0.04)
    why, used, _, t, h, _, _, worst = line(until=3.0, rows=5)
    assert (why, used, worst) == (esdirk.FULL, 5, 0) and t == pytest.approx(2.16) and h == pytest.approx(0.04)
    assert line.state.position == pytest.approx(START * np.cos(0.16), abs=1e-4)
    assert line.state.slip == pytest.approx(np.full((N + 1, 3), 5.0))


def test_a_row_has_forces_works_energies_and_the_range_of_tensions(monkeypatch):
    monkeypatch.setattr(esdirk, "stored_energy", lambda s, q, v: (1.0, 2.0, 3.0, 4.0))
    for tension, least, most in (([99.0, 5.0, 3.0, 7.0], 3.0, 7.0), ([0.0, 5.0, 6.0, 4.0], 4.0, 6.0)):
        work = SimpleNamespace(r=np.arange(12.0).reshape(3, 4), q=0, v=0, T=np.array(tension))
        row = np.zeros(esdirk.COLUMNS)
        esdirk.record(row, 7.5, 0.3, SimpleNamespace(length=np.ones(N)), work, np.arange(10.0, 16.0))
        wanted = [7.5, 3, 7, 11, 0, 4, 8, *range(10, 16), 1, 2, 3, 4, least, most, 0.3]
        assert row.tolist() == wanted


def test_a_tension_at_a_node_is_the_mean_of_the_elements_beside_it():
    row = np.zeros(4)
    esdirk.mark(row, np.array([0, 1, 2, 3]), np.array([99.0, 10.0, 20.0, 40.0]), N)
    assert row.tolist() == [10.0, 15.0, 30.0, 40.0]


def test_a_frame_within_a_step_is_a_cubic():
    """1 + 2 t − t² + 3 t³ of one node and its halves, from 0.5 to 0.9"""
    rates = np.array([2.0, -2.0, 9.0])
    place = lambda t: np.outer([1.0, 0.5, -2.0], [1 + 2 * t - t**2 + 3 * t**3] * 2)  # noqa: E731
    speed = lambda t: np.outer([1.0, 0.5, -2.0], [rates @ [1, t, t * t]] * 2)  # noqa: E731
    out = np.zeros((2, 3))
    for share in (0.0, 0.3, 1.0):
        esdirk.frame(out, share, 0.4, place(0.5), speed(0.5), place(0.9), speed(0.9))
        assert out == pytest.approx(place(0.5 + 0.4 * share).T)


def test_the_last_node_is_where_the_fairlead_is(monkeypatch):
    def fairlead_at(motion, t, place, velocity, acceleration):
        place[:], velocity[:], acceleration[:] = np.add.outer([0, 10, 20], [1.0, 2.0, 3.0]) * t

    monkeypatch.setattr(esdirk, "fairlead_at", fairlead_at)
    q, v, a = np.zeros((3, 3, 4))
    esdirk.lead("motion", 2.0, np.zeros((3, 3)), q, v, a, 2)
    assert q[:, 2].tolist() == [2.0, 4.0, 6.0] and v[:, 2].tolist() == [22.0, 24.0, 26.0]
    assert a[:, 2].tolist() == [42.0, 44.0, 46.0] and not q[:, [0, 1, 3]].any()
