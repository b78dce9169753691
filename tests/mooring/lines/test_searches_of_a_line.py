"""Searches of a line of segments as plain Python, on stand-ins of what they call: tension, heaps, positions."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

search, traverse = (plain(f"mooring.lines.multi_segment.{name}") for name in ("search", "traverse"))
line = plain("mooring.lines.multi_segment.line")
REACH = int(search.BEYOND_REACH)


def varied(line, heap, foot, close):
    return SimpleNamespace(**vars(line) | dict(heap=heap, foot=foot, close=close))


class Tension:
    """A line whose excess length is f(H); asked : every H and the heap and vertex that it was asked with"""

    def __init__(self, monkeypatch, f, steps=lambda H: 3, foot=lambda H: 0, length=100.0, weight=500.0):
        self.f, self.steps, self.foot, self.asked = f, steps, foot, []
        self.line = SimpleNamespace(length=length, weight=weight, least=1e-6, close=0.25, heap=0.0, foot=0)
        self.w = SimpleNamespace(count=np.zeros(3, np.int64))
        monkeypatch.setattr(search, "traverse", self.traverse)
        monkeypatch.setattr(search, "varied", varied)

    def traverse(self, line, w, H, x, z):
        assert (x, z) == (70.0, 30.0)
        self.asked.append((H, line.heap, line.foot, line.close))
        w.count[0], w.count[2] = self.steps(H), self.foot(H)
        return self.f(H)

    def __call__(self, guess=1e4, tolerance=1e-6):
        return search.horizontal_tension(self.line, self.w, 70.0, 30.0, guess, tolerance)


@pytest.mark.parametrize("guess", [2e3, 1e4, 5e6, 0.0])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-6])
def test_a_tension_is_sought_until_its_excess_is_within_the_tolerance(monkeypatch, guess, tolerance):
    """Excess of 40 ln(H/H₀) m about 8 kN, of a line of 100 m"""
    one = Tension(monkeypatch, lambda H: 40 * math.log(H / 8e3))
    H, state = one(guess, tolerance)
    assert state == search.SOLVED and abs(40 * math.log(H / 8e3)) <= 100 * tolerance
    assert one.asked[0][0] == pytest.approx(max(guess, 1e-6)) and len(one.asked) < 40


def test_a_line_with_some_length_left_without_tension_is_slack_and_one_that_never_gets_there_beyond_reach(monkeypatch):
    slack = Tension(monkeypatch, lambda H: 1.0 + H)
    assert slack() == (1e-6, search.SLACK) and slack.asked[-1][0] == 1e-6
    short = Tension(monkeypatch, lambda H: -1.0)
    H, state = short()
    assert state == REACH and math.log(H / 1e4) > 25
    last = math.log(short.asked[-1][0] / 1e4)
    assert 23 <= last <= 25
    assert Tension(monkeypatch, lambda H: -1.0)(1.0)[0] > 500.0 * math.exp(
        25
    )  # counted from the weight of a light start


def test_steps_up_double_to_two_and_down_until_the_least_is_tried(monkeypatch):
    up = Tension(monkeypatch, lambda H: 1.0 if 1e4 * math.exp(7) < H else -1.0)
    up()
    assert [math.log(one[0] / 1e4) for one in up.asked[:6]] == pytest.approx([0.0, 0.25, 0.75, 1.75, 3.75, 5.75])
    down = Tension(monkeypatch, lambda H: 1.0 if H > 1.0 else -1.0)
    down()
    asked = [one[0] for one in down.asked]
    assert [math.log(H / 1e4) for H in asked[:3]] == pytest.approx([0.0, -0.25, -0.75]) and asked[3] == 1e-6
    assert [math.log(H / 1e4) for H in asked[4:6]] == pytest.approx([-2.75, -4.75])


def test_a_jump_of_the_excess_ends_where_its_sides_are_next_to_each_other(monkeypatch):
    for tolerance, narrow in ((1e-2, 1e-5), (1e-6, 1e-11)):
        one = Tension(monkeypatch, lambda H: 5.0 if H > 3e4 else -5.0)
        H, state = one(tolerance=tolerance)
        assert state == search.SOLVED and abs(math.log(H / 3e4)) < 30 * narrow
        before = abs(math.log(one.asked[-3][0] / 3e4))
        assert before > 0.01 * narrow


def test_a_line_that_slides_is_lost_unless_it_arrives_at_a_vertex_with_the_least_tension(monkeypatch):
    """Below 9 kN it has no steps and slides to vertex 4; there, with a heap, it has some length to spare or not"""
    for room, state in ((1.0, search.SLIDES), (-1.0, search.LOST)):
        one = Tension(monkeypatch, lambda H: 1.0 - 6.0 * (H < 9e3), steps=lambda H: 3 * (H >= 9e3),
                      foot=lambda H: 4 * (H < 9e3))  # fmt: skip
        f = one.f
        of_line = one.traverse

        def either(made, w, H, x, z, one=one, f=f, of_line=of_line, room=room):
            one.f = (lambda _: room) if made.foot == 4 else f
            return of_line(made, w, H, x, z)

        monkeypatch.setattr(search, "traverse", either)
        H, found = one()
        assert found == state and pytest.approx(9e3, rel=1e-9) == H
        assert one.w.count[2] == (4 if state == search.SLIDES else one.w.count[2])
        assert any(asked[1:] == (0.0, 4, 0.25) for asked in one.asked)


def test_a_heap_takes_what_a_line_can_spare(monkeypatch):
    """38 m less the heap, and nothing known beyond 60 m, where all of the line is in it"""
    one = Tension(monkeypatch, None)

    def of_heap(made, w, H, x, z):
        one.asked.append((H, made.heap, made.foot, made.close))
        return 38.0 - made.heap if made.heap < 60.0 else math.nan

    monkeypatch.setattr(search, "traverse", of_heap)
    found = search.fill_heap(one.line, one.w, 7, 123.0, 70.0, 30.0, 1e-9)
    assert found == pytest.approx(38.0, abs=1e-7) and found <= 38.0
    assert one.asked[-1] == (123.0, found, 7, 0.25) and len(one.asked) < 60


class Positions:
    """Positions of which a search says the state; continuation goes on for so many of them; said : in which order"""

    def __init__(self, monkeypatch, states, goes_on, to_place=False, last=None, count=3):
        self.states, self.goes_on, self.said = list(states), list(goes_on), []
        steps = np.full((5, 3), search.GROUNDED_ANCHOR if last is None else last)
        self.w = SimpleNamespace(count=np.array([count, 0, 9]), steps=steps)
        self.line = SimpleNamespace(least=0.5, to_place=to_place, heap=2.0, foot=0, close=None)
        monkeypatch.setattr(search, "varied", varied)
        monkeypatch.setattr(search, "horizontal_tension", self.tension)
        monkeypatch.setattr(search, "fill_heap", self.heap)
        monkeypatch.setattr(search, "continuation", self.continuation)

    def tension(self, line, w, x, z, guess, tolerance):
        self.said.append(("search", line.close, guess, tolerance))
        return guess + 1.0, self.states.pop(0)

    def heap(self, line, w, foot, H, x, z, tolerance):
        self.said.append(("heap", int(foot), H, tolerance))
        return 42.0

    def continuation(self, line, w, x, z, first, left, heap, pieces, found):
        self.said.append(("solve", first, int(left), heap))
        return first + self.goes_on.pop(0)

    def __call__(self, tolerances, first=1):
        return search.solve_some(self.line, self.w, np.zeros(4), np.zeros(4), first, 10.0, "pieces", "found",
                                 np.array(tolerances))  # fmt: skip


SOLVED, LOST, SLIDES, SLACK = search.SOLVED, search.LOST, search.SLIDES, search.SLACK
EXACTLY = [("search", 0.0, 10.0, 1e-6)]
TAUT, AT_ANCHOR, AT_TOUCHDOWN = map(int, (search.TAUT, search.HEAP_AT_ANCHOR, search.HEAP_AT_TOUCHDOWN))


@pytest.mark.parametrize("given, tolerances, found, said", [
    (dict(states=[SOLVED], goes_on=[2]), [1e-2], (3, SOLVED), [("search", 1e-7, 10.0, 1e-2), ("solve", 1, TAUT, 0.0)]),
    (dict(states=[SOLVED, SOLVED], goes_on=[0, 1]), [1e-3, 1e-6], (2, SOLVED),
     [("search", 1e-7, 10.0, 1e-3), ("solve", 1, TAUT, 0.0), ("search", 0.0, 11.0, 1e-6), ("solve", 1, TAUT, 0.0)]),
    (dict(states=[SOLVED], goes_on=[0]), [1e-6], (1, LOST), [("search", 0.0, 10.0, 1e-6), ("solve", 1, TAUT, 0.0)]),
    (dict(states=[REACH], goes_on=[]), [1e-6], (1, REACH), [("search", 0.0, 10.0, 1e-6)]),
    (dict(states=[LOST], goes_on=[]), [1e-2, 1e-6], (1, LOST), [("search", 1e-7, 10.0, 1e-2)]),
    (dict(states=[SOLVED], goes_on=[], count=0), [1e-2], (1, LOST), [("search", 1e-7, 10.0, 1e-2)]),
    (dict(states=[SLIDES], goes_on=[1]), [1e-6], (2, SOLVED),
     [("search", 0.0, 10.0, 1e-6), ("heap", 9, 11.0, 1e-6), ("solve", 1, TAUT, 0.0)]),
    (dict(states=[SLACK], goes_on=[1]), [1e-6], (2, SLACK), [*EXACTLY, ("solve", 1, AT_ANCHOR, 0.0)]),
    (dict(states=[SLACK], goes_on=[0, 1]), [1e-6], (2, SLACK),
     [*EXACTLY, ("solve", 1, AT_ANCHOR, 0.0), ("heap", 0, 0.5, 1e-15), ("solve", 1, AT_TOUCHDOWN, 42.0)]),
    (dict(states=[SLACK, SLACK], goes_on=[0, 1]), [1e-3, 1e-6], (2, SLACK),
     [("search", 1e-7, 10.0, 1e-3), ("solve", 1, AT_ANCHOR, 0.0), ("search", 0.0, 11.0, 1e-6),
      ("solve", 1, AT_ANCHOR, 0.0)]),
    (dict(states=[SLACK], goes_on=[0, 0]), [1e-6, 1e-9], (1, LOST),
     [*EXACTLY, ("solve", 1, AT_ANCHOR, 0.0), ("heap", 0, 0.5, 1e-15), ("solve", 1, AT_TOUCHDOWN, 42.0)]),
    (dict(states=[SLACK], goes_on=[1], to_place=True), [1e-6], (2, SLACK),
     [("search", 0.0, 10.0, 1e-6), ("solve", 1, AT_ANCHOR, 0.0)]),
    (dict(states=[SLACK], goes_on=[1], to_place=True, last=search.GROUNDED_ANCHOR + 1), [1e-6], (2, SOLVED),
     [("search", 0.0, 10.0, 1e-6), ("solve", 1, TAUT, 0.0)]),
])  # fmt: skip
def test_contacts_of_a_search_are_solved_and_followed_as_far_as_they_hold(monkeypatch, given, tolerances, found, said):
    one = Positions(monkeypatch, **given)
    assert one(tolerances) == found and one.said == said


def test_positions_go_on_from_the_last_that_was_solved(monkeypatch):
    """The second is lost, and keeps the guess of the first; two more are solved together"""
    asked = []
    ends = iter([(1, SOLVED), (1, LOST), (4, SLACK)])

    def solve_some(line, w, x, z, first, guess, pieces, found, tolerances):
        asked.append((first, guess, pieces.shape, tolerances))
        after, state = next(ends)
        if after > first:
            found[after - 1, 0], found[after - 1, 10] = 100.0 + after, 2
        return after, state

    monkeypatch.setattr(search, "solve_some", solve_some)
    monkeypatch.setattr(search, "workspace_for", lambda line: SimpleNamespace(states="states"))
    found, status, pieces, states = search.solve_positions("line", np.zeros(4), np.zeros(4), 7.0, 6, "tolerances")
    assert status.tolist() == [SOLVED, LOST, SLACK, SLACK] and states == "states"
    assert asked == [
        (0, 7.0, (6, 11), "tolerances"),
        (1, 101.0, (6, 11), "tolerances"),
        (2, 101.0, (6, 11), "tolerances"),
    ]
    assert pieces.shape == (2, 11) and found[0, 9] == math.inf and found[3, 0] == 104.0


def test_a_line_that_is_not_found_is_sought_the_other_way_with_softer_buoys_less_friction_and_parts_that_are_held():
    from collections import namedtuple

    Data = namedtuple("Data", "to_place lowest_buoy loads soft friction held")
    plainest = Data(True, 1, [0], 0.1, 0.0, 0)
    one = SimpleNamespace(surface=math.inf, length=200.0, loads=(), _steep=False)
    tries = line.StaticLine._further_tries(one, plainest)
    other = plainest._replace(to_place=False)
    assert [way for way, _ in tries] == [plainest, other, other]
    assert [t.tolist() for _, t in tries] == [[1e-6], [1e-2], [1e-6]]
    buoys = plainest._replace(loads=[0, 1], friction=0.4)
    one = SimpleNamespace(surface=5.0, length=200.0, loads=(1,), _steep=True)
    tries = line.StaticLine._further_tries(one, buoys)[3:]
    assert tries[0][0].soft == line.SOFTER * 200.0 and tries[0][1].tolist() == [1e-6]
    count = len(line.MOBILISED)
    assert [way.friction for way, _ in tries[1 : 1 + count]] == [share * 0.4 for share in line.MOBILISED]
    assert [(way.held, way.to_place, t.tolist()) for way, t in tries[1 + count :]] == [
        (1, False, [1e-6]), (2, False, [1e-6]), (1, True, [1e-3]),
    ]  # fmt: skip
    one.surface = math.inf
    assert line.StaticLine._further_tries(one, buoys)[3][0].soft == 0.1
    one._steep = False
    assert len(line.StaticLine._further_tries(one, buoys)) == 3 + count


def test_every_position_that_is_lost_is_sought_again_and_the_last_gives_the_shape():
    """Of five the second and fourth are found by a first further try, the last by another; the others stand"""
    asked, ways = [], [("exact", 1e-6), ("other", 1e-2), ("never", 0.0)]
    answers = {("exact", 1.0): 11.0, ("exact", 3.0): 13.0, ("other", 4.0): 14.0}

    def once(way, x, z, tolerances):
        asked.append((way, *x, *z, tolerances))
        found = answers.get((way, float(x[0])))
        state = LOST if found is None else SOLVED
        return found, state, f"pieces by {way}", f"loads by {way}"

    def solve_positions(data, x, z, guess, capacity, begin):
        return np.arange(5.0), np.array([SOLVED, LOST, SLACK, LOST, LOST]), "pieces", "loads"

    data = SimpleNamespace(lowest_buoy=0, loads=(), kept=())
    one = SimpleNamespace(_like_a_uniform_line=lambda x, z: 1.0, _capacity=lambda given: 9, _mirrored=None,
                          _once=once, _further_tries=lambda given: ways)  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "solve_positions", solve_positions)
        patch.setattr(line, "_search", lambda: search)
        found, status, pieces, loads = line.StaticLine._solve(one, data, np.arange(5.0), np.arange(5.0) + 50)
    assert found.tolist() == [0.0, 11.0, 2.0, 13.0, 14.0]
    assert status.tolist() == [SOLVED, SOLVED, SLACK, SOLVED, SOLVED]
    assert (pieces, loads) == ("pieces by other", "loads by other")
    assert asked == [("exact", k, k + 50.0, 1e-6) for k in (1.0, 3.0, 4.0)] + [("other", 4.0, 54.0, 1e-2)]
