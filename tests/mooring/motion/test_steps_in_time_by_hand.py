"""How a run goes on in time, as plain Python: steps, windows, breaks and samples of motions with a known solution."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

integrator = plain("mooring.motion.integrator")
BLOCK, SLOW, RATE = integrator.BLOCK, integrator.SLOW, integrator.SLOW_RATE
END, WINDOW = 5.0, 2.0


class Run:
    """Bodies that swing at 1 rad/s from 1 m, 2 m …; said : what the loop called, in order

    follows : whether lines can follow at a time and a step; the slow pose moves by (0.1, 0.2, 0.3) a second
    """

    def __init__(self, monkeypatch, bodies=1, fixed=0.0, tolerance=1e-6, lost=(math.inf,), sample=0.4, buoy=None):
        self.said, self.bodies, self.buoy, self.times = [], bodies, buoy, []
        self.follows, self.force = (lambda t: True), (lambda t, x: -x)
        y = np.zeros(BLOCK * bodies + (6 if buoy else 0))
        for b in range(bodies):
            y[BLOCK * b : BLOCK * b + 6] = 1.0 + b
            y[BLOCK * b + RATE : BLOCK * b + RATE + 3] = 0.1, 0.2, 0.3
        if buoy:
            y[-6:-3] = 5.0
        self.clock = integrator.clock_at_rest(y, END, sample, fixed, np.full((bodies, 12), tolerance))
        self.scene = SimpleNamespace(
            lines=SimpleNamespace(lost=np.array(lost)), line_work="line work",
            work=SimpleNamespace(window=[f"window {b}" for b in range(bodies)], span=np.zeros(2)),
            contact_work=SimpleNamespace(beyond=np.array([-1])),
            body=SimpleNamespace(shapes=SimpleNamespace(owner=np.zeros(0, np.int64))),
        )  # fmt: skip
        table = SimpleNamespace(window=WINDOW, step=0.5)
        self.waves = SimpleNamespace(table=table)
        self.samples = np.full((int(END / sample) + 1, 18 * bodies + (6 if buoy else 0)), np.nan)
        note = self.note
        monkeypatch.setattr(integrator, "rates", self.rates)
        monkeypatch.setattr(integrator, "settle", note("settle"))
        monkeypatch.setattr(integrator, "hold", note("hold"))
        monkeypatch.setattr(integrator, "meet", note("rows"))
        monkeypatch.setattr(integrator, "fill_window", note("window"))
        monkeypatch.setattr(integrator, "keep_links", note("links"))
        monkeypatch.setattr(integrator, "open_water", note("water"))
        monkeypatch.setattr(integrator, "keep_pulls", note("pulls"))

    def note(self, name):
        return lambda *given: self.said.append((name, *(np.copy(x) if isinstance(x, np.ndarray) else x for x in given)))

    def of(self, name):
        return [given[1:] for given in self.said if given[0] == name]

    def rates(self, scene, buoy, links, t, y, k):
        self.times.append(t)
        k[:] = 0.0
        for n in [BLOCK * b for b in range(self.bodies)]:
            k[n : n + 6], k[n + 6 : n + 12] = y[n + 6 : n + 12], self.force(t, y[n : n + 6])
            k[n + SLOW : n + SLOW + 3] = y[n + RATE : n + RATE + 3]
        if self.buoy:
            k[-6:-3], k[-3:] = y[-3:], -y[-6:-3]
        return self.follows(t)

    def __call__(self, most=10_000):
        return integrator.advance(self.scene, self.waves, self.clock, self.samples, most, self.buoy, "links", None)


def exact(time, size):
    return size * np.cos(time), -size * np.sin(time)


@pytest.mark.parametrize("bodies, buoy", [(1, None), (2, None), (1, ("buoy", "water"))])
def test_a_swing_is_followed_to_the_tolerance_and_sampled_at_its_times(bodies, buoy, monkeypatch):
    """Samples of places and velocities, polynomials of fifth degree and cubics between steps; and of the buoy"""
    run = Run(monkeypatch, bodies, buoy=buoy)
    assert run() == integrator.DONE
    time = 0.4 * np.arange(13)
    assert run.clock.counts[integrator.SAMPLES] == 13 and run.clock.now[integrator.TIME] == END
    for b in range(bodies):
        x, v = exact(time, 1.0 + b)
        own = run.samples[:, 18 * b : 18 * b + 18]
        assert own[:, :6] == pytest.approx(np.tile(x, (6, 1)).T, abs=2e-5)
        assert own[:, 6:12] == pytest.approx(np.tile(v, (6, 1)).T, abs=5e-4)
        assert own[:, 12:15] == pytest.approx(np.outer(time, [0.1, 0.2, 0.3]))
    if buoy:
        assert run.samples[:, 18:21] == pytest.approx(np.tile(exact(time, 5.0)[0], (3, 1)).T, abs=2e-3)
        assert len(run.of("pulls")) == run.clock.counts[integrator.STEPS]
        firsts, lasts = np.array([given[1:] for given in run.of("pulls")]).T
        assert firsts[0] == 0 and lasts[-1] == 13 and np.array_equal(firsts[1:], lasts[:-1])
        water = run.of("water")
        assert [(given[4], given[5]) for given in water] == [(0, 0.0), (1, 2.0), (2, 4.0)]
        assert water[1][3] == pytest.approx([5 * math.cos(2.0)] * 3, abs=1e-3) and water[0][1:3] == buoy


def test_every_step_begins_where_the_last_ended_and_ends_with_the_window(monkeypatch):
    """Windows begin at 0, 2 and 4 s with the pose foreseen for their end: slow pose + 2 s · its rate"""
    run = Run(monkeypatch, bodies=2)
    run()
    steps = run.of("links")
    begins, lengths, ends = np.array([given[4:] for given in steps]).T
    assert begins[0] == 0.0 and np.array_equal(begins[1:], ends[:-1]) and ends[-1] == END
    assert begins + lengths == pytest.approx(ends, abs=1e-12) and {2.0, 4.0} <= set(ends)
    assert len(run.of("settle")) == len(steps) == run.clock.counts[integrator.STEPS]
    windows = run.of("window")
    assert [(given[2], given[4], given[5]) for given in windows] == [
        (n, 2.0 * n, b) for n in range(3) for b in range(2)
    ]  # fmt: skip
    assert [given[1] for given in windows[:2]] == ["window 0", "window 1"]
    assert windows[2][3] == pytest.approx([0.4, 0.8, 1.2]) and windows[4][3] == pytest.approx([0.6, 1.2, 1.8])
    rows = run.of("rows")
    assert [(given[1], given[3], given[4]) for given in rows] == [(0, 0.0, 0), (0, 0.0, 1)]
    assert run.clock.counts[integrator.WINDOWS] == 3 and run.scene.work.span.tolist() == [4.0, 0.5]


def test_a_step_ends_where_a_line_breaks_and_rates_begin_anew_there(monkeypatch):
    run = Run(monkeypatch, lost=(3.3, 1.3, 0.0, 9.0))
    assert run() == integrator.DONE
    assert [given for given in run.of("hold")] == [(run.scene.lines, "line work", t) for t in (1.3, 3.3)]
    assert {1.3, 3.3} <= {given[-1] for given in run.of("links")}
    assert [integrator.next_break(run.scene.lines, t) for t in (0.0, 1.3, 3.3, 9.0)] == [1.3, 3.3, 9.0, math.inf]


def test_a_force_that_a_break_changes_is_that_after_it(monkeypatch):
    """Pushed by 1 m/s² from 2.5 s on: x = 1 + ½ (t − 2.5)²"""
    run = Run(monkeypatch, lost=(2.5,))
    run.force = lambda t, x: 0.0 if not run.of("hold") else 1.0
    run()
    time = 0.4 * np.arange(13)
    assert run.samples[:, 0] == pytest.approx(1 + 0.5 * np.maximum(time - 2.5, 0) ** 2, abs=1e-6)


def test_a_step_cut_short_does_not_shorten_the_next(monkeypatch):
    """Lines break 0.1 ms apart: the step between is 0.1 ms, from which a step may grow by `LARGEST` = 4 only; the next
    one is as long as those before, as far as its window lets it"""
    run = Run(monkeypatch, lost=(1.3, 1.3001))
    run()
    lengths = {round(given[4], 6): given[5] for given in run.of("links")}
    usual = np.median(list(lengths.values()))
    assert lengths[1.3] == pytest.approx(1e-4, rel=1e-6) and 0.1 < usual < 1.0
    assert lengths[1.3001] > 0.5 * usual


def test_given_steps_are_kept_and_their_error_is_of_fifth_order(monkeypatch):
    """x″ = x from 1 m at rest is cosh t"""
    errors = []
    for step in (0.25, 0.125):
        run = Run(monkeypatch, fixed=step)
        run.force = lambda t, x: x
        assert run() == integrator.DONE and run.clock.counts[integrator.STEPS] == END / step
        errors.append(abs(run.clock.y[0] - math.cosh(END)))
    assert math.log2(errors[0] / errors[1]) == pytest.approx(5, abs=0.4) and errors[1] < 1e-4


@pytest.mark.parametrize("smooth", [np.inf, 2e3, 8.0])
def test_the_error_of_a_step_is_that_of_both_orders_over_what_is_allowed(smooth, monkeypatch):
    """Dormand and Prince (1980): weights of fifth and fourth order of the same stages; x″ = −x by powers of a matrix.
    Of smooth forces times its ratio to the third derivative h³f‴/144, by Newton's divided differences, if below 1
    """
    run, h = Run(monkeypatch, 2, tolerance=1e-3), 0.7
    run.clock = run.clock._replace(smooth=smooth)
    run.clock.scale[1, 9] = 1e-5
    fifth = np.array([35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84, 0])
    fourth = np.array([5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40])
    integrator.rates(run.scene, None, None, 0.0, run.clock.y, run.clock.stages[0])
    worst, good = integrator.take_step(run.scene, None, None, run.clock, 0.0, h)
    off = h * np.tensordot(fifth - fourth, run.clock.stages, 1) / h
    wanted = max(
        np.abs(off[:12]).max() / 1e-3, np.abs(off[BLOCK : BLOCK + 12]).max() / 1e-3, abs(off[BLOCK + 9]) / 1e-5
    )
    at, column = np.array([0.0, 0.3, 0.8, 1.0]), run.clock.stages[[0, 2, 3, 6]]
    for n in (1, 2, 3):
        column = np.diff(column, axis=0) / (at[n:] - at[:-n])[:, None]
    third = np.abs(column[0]) / 24
    third = max(third[:12].max() / 1e-3, third[BLOCK : BLOCK + 12].max() / 1e-3, third[BLOCK + 9] / 1e-5)
    assert (smooth * wanted < third) == (smooth == 8.0)
    assert worst == pytest.approx(wanted * min(1.0, smooth * wanted / third)) and good
    assert run.clock.trial[0] == pytest.approx(math.cos(h), abs=1e-4)
    assert run.times[1:7] == pytest.approx([h / 5, 0.3 * h, 0.8 * h, 8 * h / 9, h, h])


def test_a_step_grows_by_its_error_at_most_four_times_and_shrinks_to_a_fifth_at_least(monkeypatch):
    run = Run(monkeypatch)
    given = iter([0.5, 1e-9, 1e9, 2.0, 0.5])
    seen, whole = [], integrator.take_step

    def step(scene, buoy, links, clock, t, h):
        seen.append((t, h))
        whole(scene, buoy, links, clock, t, h)
        return next(given), True

    monkeypatch.setattr(integrator, "take_step", step)
    run(5)
    (a, b, c, d, e) = (h for _, h in seen)
    assert a == 0.05 and b == pytest.approx(0.05 * 0.85 * 0.5**-0.25)
    assert c == pytest.approx(4 * b) and d == pytest.approx(0.2 * c)
    assert run.clock.counts[integrator.REFUSED] == 2 and run.clock.counts[integrator.STEPS] == 3
    assert seen[2][0] == seen[3][0] == seen[4][0] == pytest.approx(a + b)
    assert e < d


@pytest.mark.parametrize("change, fixed, why", [
    ({"follows": lambda t: t < 1.0}, 0.25, "NO_LINE"), ({"follows": lambda t: t < 1.0}, 0.0, "NO_LINE"),
    ({"force": lambda t, x: math.nan if t > 1.0 else -x}, 0.25, "NOT_FINITE"),
    ({"force": lambda t, x: math.nan if t > 1.0 else -x}, 0.0, "NOT_FINITE"),
    ({"force": lambda t, x: math.copysign(1e9, math.sin(1e9 * t))}, 0.0, "TOO_SHORT"),
])  # fmt: skip
def test_a_run_that_cannot_go_on_says_why(change, fixed, why, monkeypatch):
    run = Run(monkeypatch, fixed=fixed)
    for name, value in change.items():
        setattr(run, name, value)
    assert run() == getattr(integrator, why)
    if why != "TOO_SHORT":
        assert run.clock.now[integrator.TIME] == pytest.approx(1.0, abs=0.25 if fixed else 1e-4)


def test_a_run_ends_where_a_fender_is_pressed_beyond_its_table_and_waits_after_so_many_steps(monkeypatch):
    run = Run(monkeypatch, fixed=0.25)
    assert run(3) == integrator.RUNNING and run.clock.now[integrator.TIME] == pytest.approx(0.75)
    run.scene.contact_work.beyond[0] = 0
    assert run() == integrator.BEYOND and run.clock.now[integrator.TIME] == pytest.approx(0.75)


def test_the_usual_step_is_a_mean_over_twenty_of_them(monkeypatch):
    """u grows by h/20u of what a step is longer; of steps of 0.25 from 0.25 it stays"""
    run = Run(monkeypatch, fixed=0.25)
    run(4)
    assert run.clock.now[integrator.USUAL] == pytest.approx(0.25)
    run.clock.now[integrator.USUAL] = 0.1
    run(1)
    assert run.clock.now[integrator.USUAL] == pytest.approx(0.1 + 0.25 / 2.0 * 0.15)


class Lines:
    """Two lines with a motion of their own, of numbers 2 and 0, on the second and the first of two bodies

    said : what a step with them does, in order; errors and whether lines have forces, of the first and the second try
    """

    def __init__(self, monkeypatch, errors=(0.5, 0.25), held=(True, True), good=(True, True), follow=True, missed=0.1):
        self.said, self.errors, self.held, self.good = [], list(errors), list(held), list(good)
        size = 2 * BLOCK
        self.clock = SimpleNamespace(
            trial=np.arange(float(size)), y="y", stages=["first stage"], scale=np.zeros((2, 12))
        )
        poses, course = ["pose 0", "pose 1"], np.zeros((2, 3, 2, 3))
        bent = ["bent midway", "bent"]
        self.kept = SimpleNamespace(foreseen=np.zeros((2, 12)), pose=poses, course=course, room="room", bent=bent)
        self.lines = SimpleNamespace(number=np.array([2, 0]))
        work = SimpleNamespace(given="given", span=np.zeros(3), whole="whole")
        self.scene = SimpleNamespace(line_work=work, lines=SimpleNamespace(body=np.array([0, 0, 1])),
                                     body=SimpleNamespace(bent="shapes"))  # fmt: skip
        replaced = dict(
            foresee=lambda lines, kept, h, given: self.note("foresee", h, given),
            rates=lambda scene, buoy, links, t, y, k: self.note("rates", buoy, links, t, y, k) or self.good.pop(0),
            take_step=lambda scene, buoy, links, clock, t, h: (
                self.note("step", scene is self.scene, buoy, links, clock is self.clock, t, h)
                or (self.errors.pop(0), self.held.pop(0))
            ),
            put_sample=lambda clock, b, t, h, at, out: self.note("sample", b, t, h, at, out),
            put_bent=lambda clock, shapes, t, h, at, out: self.note("bend", shapes, t, h, at, out),
            fairlead_of=self.fairlead,
            advance_lines=lambda lines, kept, whole, t, h: self.note("advance", whole, t, h) or follow,
            project=lambda lines, kept, t, h, given: self.note("project", t, h, given),
            missed_course=lambda scene, clock, moving, h: self.note("missed", moving[1] is self.kept, h) or missed,
        )  # fmt: skip
        for name, stand_in in replaced.items():
            monkeypatch.setattr(integrator, name, stand_in)

    def note(self, *what):
        self.said.append(what)

    def fairlead(self, lines, n, state, bent, room, place, velocity):
        self.note("fairlead", n, state if isinstance(state, str) else state.tolist(), bent, room)
        place[:], velocity[:] = 10 * n + len(self.said), -10 * n - len(self.said)

    def __call__(self):
        return integrator.take_step_with_lines(
            self.scene, "buoy", "links", self.clock, (self.lines, self.kept), 5.0, 0.4
        )


def test_a_step_with_lines_goes_out_and_back_with_their_pulls_along_the_course(monkeypatch):
    """Half way by the sample of each body, at the end by the trial state; the worse of both errors counts"""
    one = Lines(monkeypatch)
    assert one() == (0.25, True)
    again = [("rates", "buoy", "links", 5.0, "y", "first stage"), ("step", True, "buoy", "links", True, 5.0, 0.4)]
    ends = [np.arange(BLOCK * b, BLOCK * b + 12.0).tolist() for b in (0, 1)]
    assert one.said == [
        ("foresee", 0.4, "given"), *again,
        ("sample", 0, 5.0, 0.4, 5.2, "pose 0"), ("sample", 1, 5.0, 0.4, 5.2, "pose 1"),
        ("bend", "shapes", 5.0, 0.4, 5.2, "bent midway"), ("bend", "shapes", 5.0, 0.4, 5.4, "bent"),
        ("fairlead", 2, "pose 1", "bent midway", "room"), ("fairlead", 2, ends[1], "bent", "room"),
        ("fairlead", 0, "pose 0", "bent midway", "room"), ("fairlead", 0, ends[0], "bent", "room"),
        ("advance", "whole", 5.0, 0.4), ("project", 5.0, 0.4, "given"), *again, ("missed", True, 0.4),
    ]  # fmt: skip
    assert one.kept.foreseen.tolist() == ends and one.scene.line_work.span[1:].tolist() == [5.0, 0.4]
    course = one.kept.course
    assert course[:, 1:, 0, 0].tolist() == [[28.0, 29.0], [10.0, 11.0]] and np.all(
        course[:, 1:, 1] == -course[:, 1:, 0]
    )
    assert not course[:, 0].any()
    assert Lines(monkeypatch, missed=0.7)() == (0.7, True)


@pytest.mark.parametrize("given, found", [
    (dict(errors=(0.5,), held=(False,), good=(True,)), (0.5, False)),
    (dict(errors=(0.5,), held=(True,), good=(False,)), (0.5, False)),
    (dict(errors=(math.inf,), held=(True,), good=(True,)), (math.inf, True)),
    (dict(follow=False), (math.inf, True)),
    (dict(held=(True, False)), (0.25, False)),
    (dict(good=(True, False)), (0.25, False)),
])  # fmt: skip
def test_a_step_that_lines_cannot_follow_is_not_taken(monkeypatch, given, found):
    one = Lines(monkeypatch, **given)
    assert one() == found
    assert ("project" in [said[0] for said in one.said]) == (
        len(given.get("held", (1, 1))) == 2 and given != {"follow": False}
    )


def test_forces_of_links_are_kept_at_the_samples_of_a_step_and_its_end_is_left_last(monkeypatch):
    """A step from 1.0 to 1.5 s with samples each 0.2 s: at 1.2 and 1.4 of it; states by cubics"""
    said = []
    cubic = lambda t: np.array([1.0, -2.0]) * (1 + t + t**2 - t**3)  # noqa: E731
    rate = lambda t: np.array([1.0, -2.0]) * (1 + 2 * t - 3 * t**2)  # noqa: E731
    monkeypatch.setattr(integrator, "rates", lambda *given: said.append(("rates", *given[1:4], np.copy(given[4]))))
    monkeypatch.setattr(
        integrator,
        "put_forces",
        lambda held, kept, place, row: row.__setitem__(0, len(said)) or said.append((held, place)),
    )
    stages = np.zeros((7, 2))
    stages[0], stages[6] = rate(1.0), rate(1.5)
    trial = cubic(1.5)
    clock = SimpleNamespace(counts=np.full(5, 6), stages=stages, sample_step=0.2, y=cubic(1.0), trial=trial)
    kept = SimpleNamespace(kept=np.zeros((9, 1)), state=np.zeros(2), rate="rate")
    scene = SimpleNamespace(work=SimpleNamespace(place="place"))
    integrator.keep_links(scene, "buoy", ("held", kept), clock, 1.0, 0.5, 1.5)
    at = [one for one in said if one[0] == "rates"]
    assert [one[1:4] for one in at] == [("buoy", ("held", kept), pytest.approx(t)) for t in (1.2, 1.4, 1.5)]
    assert (
        at[0][4] == pytest.approx(cubic(1.2))
        and at[1][4] == pytest.approx(cubic(1.4))
        and at[2][4] == pytest.approx(trial)
    )
    assert said[1] == ("held", "place") and kept.kept[:, 0].tolist() == [0, 0, 0, 0, 0, 0, 1.0, 3.0, 0]
    said.clear()
    clock.counts[:] = 9
    integrator.keep_links(scene, "buoy", ("held", kept), clock, 1.5, 0.5, 2.0)  # no row is left
    clock.counts[:] = 8
    integrator.keep_links(scene, "buoy", ("held", kept), clock, 1.5, 0.05, 1.55)  # the next sample is at 1.6
    assert said == []
