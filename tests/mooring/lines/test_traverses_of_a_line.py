"""Contacts of a line with the bed from the fairlead to the anchor, step by step, on stand-ins of what they call."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

traverse = plain("mooring.lines.multi_segment.traverse")
stage = plain("mooring.lines.dynamics.lumped.stage")
T = traverse


class Bed:
    """Sinkers of 50 and 80 N at 20 and 60 m of a line of 100 m, a buoy at 90 m, on a bed of three facets

    gaps : {(origin, amount)} or a function of both; said : in which order what was called
    """

    def __init__(self, monkeypatch, gaps=lambda origin, amount: 1.0, length=100.0, **bed):
        self.said = []
        rows = np.array([[0.0, -50.0, 0.1], [30.0, -47.0, 0.2], [60.0, -41.0, -0.1]])
        self.line = SimpleNamespace(
            loads=np.array([[20.0, 50.0, 0.0], [60.0, 80.0, 0.0], [90.0, -30.0, 0.0]]), bed=rows, length=length,
            heap=0.0, foot=0, lowest_buoy=2, to_place=False, weight=400.0, **bed,
        )  # fmt: skip
        self.w = SimpleNamespace(
            q=np.zeros(7), at=np.array([1, 2, 0]), g=np.zeros((11, 0)), rows="rows", trial_q=np.zeros(7),
            trial_at=np.zeros(3, np.int64), states="states", load_weights="weights", count=np.array([0, 1, 5]),
            steps=np.zeros((12, 3), np.int64), unknowns=np.zeros(20),
        )  # fmt: skip
        self.gaps, self.march = gaps, lambda q, at: None
        replaced = dict(
            gap_of=lambda line, w, origin, *of: self.note("gap", origin, *of) or gaps(origin, of[-1]),
            touching_span=lambda line, w, *of: self.note("span", *of) or "span",
            march_on_facet=lambda line, q, g, at, facet, length, until, load, rows: (
                self.note("march", facet, length, int(load)) or self.march(q, at)
            ),
            length_on=lambda line, q, at, facet: 33.0,
            leave_bed=lambda line, q, g: self.note("leave"),
            first_contact=lambda *given: (self.note("contact", given[4]) or self.contact,),
            leave_heap=lambda *given: self.note("heap", given[4]) or self.leaves,
            slides_down=lambda line, at, facet, until: self.note("slides", facet) or self.slides,
        )  # fmt: skip
        for name, stand_in in replaced.items():
            monkeypatch.setattr(traverse, name, stand_in)
        self.contact, self.leaves, self.slides = 1.0, True, False

    def note(self, *what):
        self.said.append(what)

    @property
    def steps(self):
        return self.w.steps[: self.w.count[0]].tolist()


def test_a_span_leaves_a_facet_between_the_sinkers_of_which_one_is_too_far_and_one_too_near(monkeypatch):
    """From 70 m on the line: 10 m to the sinker at 60, 50 m to that at 20"""
    for reached, near, wanted in ((65.0, None, (50.0, 65.0)), (40.0, None, (10.0, 40.0)), (65.0, 60.0, (0.0, 10.0)),
                                  (65.0, 20.0, (10.0, 50.0))):  # fmt: skip
        one = Bed(monkeypatch)
        one.w.q[T.S], one.w.at[1] = 70.0, 1
        weights = {60.0: 80.0 * math.cos(0.2), 20.0: 50.0 * math.cos(0.2)}

        def gap(line, w, origin, facet, amount, one=one, near=near, weights=weights):
            one.note("gap", origin, facet, amount)
            return -1.0 if near is not None and amount in (0.0, weights[near]) else 1.0

        monkeypatch.setattr(traverse, "gap_of", gap)
        assert traverse.lift_off(one.line, one.w, 1, reached) == "span"
        assert one.said[-1] == ("span", T.FROM_FACET, 1, *wanted) and one.steps == [[T.OFF_FACET, 1, T.NOTHING]]
        assert one.said[:3] == [
            ("march", 1, 33.0, 1),
            ("leave",),
            ("gap", T.FROM_SINKER, 1, pytest.approx(weights[60.0])),
        ]
        assert one.w.q[T.S] == 70.0 and one.w.at[1] == 1


def test_a_span_that_clears_the_bed_from_a_sinker_without_weight_and_not_with_it_leaves_there(monkeypatch):
    one = Bed(monkeypatch, lambda origin, amount: 1.0 if amount == 0.0 else -1.0)
    one.w.q[T.S], one.w.at[1] = 70.0, 1
    assert traverse.lift_off(one.line, one.w, 1, 65.0) == "span"
    assert one.steps == [[T.TO_SINKER, 1, 1], [T.OFF_SINKER, 1, T.NOTHING]]
    assert one.said[-1] == ("span", T.FROM_SINKER, 1, 0.0, pytest.approx(80 * math.cos(0.2)))
    rounded = Bed(monkeypatch, lambda origin, amount: 0.0 if amount == 0.0 else -2.0 * T.ROUNDING * 100)
    rounded.w.q[T.S], rounded.w.at[1] = 70.0, 1
    traverse.lift_off(rounded.line, rounded.w, 1, 65.0)
    assert rounded.steps[0] == [T.TO_SINKER, 1, 1]
    rounded = Bed(monkeypatch, lambda origin, amount: 0.0 if amount == 0.0 else -0.5 * T.ROUNDING * 100)
    rounded.w.q[T.S], rounded.w.at[1] = 70.0, 1
    traverse.lift_off(rounded.line, rounded.w, 1, 65.0)
    assert rounded.steps == [[T.OFF_FACET, 1, T.NOTHING]]


def test_buoys_and_sinkers_out_of_reach_are_not_tried(monkeypatch):
    buoy = Bed(monkeypatch)
    buoy.w.q[T.S], buoy.w.at[1] = 95.0, 2
    traverse.lift_off(buoy.line, buoy.w, 1, 65.0)
    assert [said[0] for said in buoy.said] == ["span"] and buoy.said[-1][3:] == (0.0, 65.0)
    far = Bed(monkeypatch)
    far.w.q[T.S], far.w.at[1] = 70.0, 1
    traverse.lift_off(far.line, far.w, 1, 10.0)
    assert [said[0] for said in far.said] == ["span"]


def test_a_length_that_penetrates_the_bed_is_the_first_of_32(monkeypatch):
    asked = []
    one = Bed(monkeypatch, lambda origin, amount: asked.append((origin, amount)) or (-1.0 if amount >= 8.0 else 0.0))
    assert traverse.penetrating_length(one.line, one.w, 1, 32.0) == 8.0
    assert asked == [(T.FROM_FACET, float(i)) for i in range(1, 9)]
    none = Bed(monkeypatch, lambda origin, amount: 0.0)
    assert traverse.penetrating_length(none.line, none.w, 1, 64.0) == 0.0 and len(none.said) == 32


@pytest.mark.parametrize("tension, place, at, found", [
    (-1.0, 59.91, 0, 1), (-1.0, 59.89, 0, T.NOTHING), (0.0, 59.95, 0, T.NOTHING), (-1.0, 89.95, 1, 2),
    (-1.0, 95.0, 2, T.NOTHING),
])  # fmt: skip
def test_the_sinker_that_was_just_passed_is_that_at_the_foot(monkeypatch, tension, place, at, found):
    one = Bed(monkeypatch)
    q = one.w.q
    q[T.T], q[T.S] = tension, place
    assert traverse.sinker_at_foot(one.line, q, np.array([0, at])) == found


def test_after_touchdown_a_span_leaves_from_a_sinker_that_is_lifted_there(monkeypatch):
    for at_sinker, gap, leaves in ((True, -1.0, True), (True, -0.5 * T.ROUNDING * 100, False), (False, -1.0, False)):
        one = Bed(monkeypatch, lambda origin, amount, gap=gap: gap)
        monkeypatch.setattr(traverse, "is_at_sinker", lambda *_, at=at_sinker: at)
        monkeypatch.setattr(traverse, "normal_force_on", lambda *_: 64.0)
        monkeypatch.setattr(traverse, "touch_down", lambda line, q, g, at, facet, one=one: one.note("touch", facet))
        found = traverse.after_touchdown(one.line, one.w, 2)
        if leaves:
            assert found == "span" and one.steps == [[T.OFF_SINKER, 2, T.NOTHING]]
            assert one.said == [("gap", T.FROM_SINKER, 2, 64.0), ("span", T.FROM_SINKER, 2, 0.0, 64.0)]
        else:
            assert found == (T.NONE, 2) and one.said[-1] == ("touch", 2) and not one.steps


@pytest.mark.parametrize("gap, foot, leaves", [(-1.0, 0, True), (0.0, 0, False), (-1.0, 2, False)])
def test_over_a_vertex_a_line_bends_or_leaves_between_the_angles_of_both_facets(monkeypatch, gap, foot, leaves):
    one = Bed(monkeypatch, lambda origin, amount: gap)
    one.line.foot, one.w.q[T.PHI] = foot, 0.77
    monkeypatch.setattr(traverse, "bend_at_vertex", lambda line, q, g, angle, load: one.note("bend", angle, int(load)))
    found = traverse.over_vertex(one.line, one.w, 2)
    if leaves:
        assert found == "span" and one.said == [("gap", T.FROM_VERTEX, 2, 0.2), ("span", T.FROM_VERTEX, 2, 0.77, 0.2)]
        assert one.steps == [[T.OFF_VERTEX, 2, T.NOTHING]]
    else:
        assert (
            found == (T.NONE, 2) and one.steps == [[T.BEND, 2, T.NOTHING]] and one.said[-1] == ("bend", 0.2, T.NOTHING)
        )


@pytest.mark.parametrize("to_place, excess, left", [(False, 7.0, 12.0), (True, 7.0, 7.0), (True, 0.0, 12.0)])
def test_what_is_left_over_is_a_length_or_how_far_the_end_is_beyond_the_anchor(monkeypatch, to_place, excess, left):
    one = Bed(monkeypatch)
    one.line.to_place, one.w.q[T.S], one.w.q[T.X] = to_place, excess, -12.0
    assert traverse.left_over(one.line, one.w) == left


def along(monkeypatch, facet=1, tension=5.0, **changes):
    """(what `along_facet` returns, Bed): 25 m along a facet to 40 m of the line, past the sinker at 60"""
    one = Bed(monkeypatch)
    for name, value in changes.items():
        setattr(one if name in ("contact", "leaves", "slides") else one.line, name, value)

    def march(q, at):
        if not one.steps and q[T.S] == 65.0:
            q[T.S], q[T.T], at[1] = 40.0, tension, 0

    one.march, one.w.q[T.S], one.w.at[1] = march, 65.0, 1
    monkeypatch.setattr(
        traverse, "lift_off", lambda line, w, facet, reached: one.note("lift", facet, reached) or "lifted"
    )
    monkeypatch.setattr(traverse, "penetrating_length", lambda line, w, facet, reached: (
        one.note("through", facet, reached) or changes.get("through", 0.0)))  # fmt: skip
    return traverse.along_facet(one.line, one.w, facet), one


def test_along_a_facet_a_line_gets_to_its_end_where_it_still_lies_on_the_next(monkeypatch):
    found, one = along(monkeypatch)
    assert found == (T.NONE, 1) and one.steps == [[T.ALONG, 1, T.NOTHING]] and ("contact", 0) in one.said
    assert one.w.q[[T.X, T.Z]].tolist() == [30.0, -47.0] and one.w.trial_q[T.S] == 40.0
    assert along(monkeypatch, contact=0.0)[0] == (T.NONE, 1)
    found, one = along(monkeypatch, contact=-1.0)
    assert found == "lifted" and one.said[-1] == ("lift", 1, 25.0) and one.w.q[T.S] == 65.0 and one.w.at[1] == 1


def test_a_buoy_at_the_place_lifts_a_line_wherever_it_is(monkeypatch):
    loads = np.array([[40.0, -50.0, 0.0], [60.0, 80.0, 0.0], [90.0, -30.0, 0.0]])
    assert along(monkeypatch, loads=loads)[0] == "lifted"
    loads[0, 0] = 39.0
    assert along(monkeypatch, loads=loads)[0] == (T.NONE, 1)
    loads[0, :2] = 40.0, 50.0
    assert along(monkeypatch, loads=loads)[0] == (T.NONE, 1)


def test_along_the_first_facet_a_line_ends_at_its_anchor_unless_a_buoy_lifts_it_before(monkeypatch):
    found, one = along(monkeypatch, facet=0)
    assert found == (T.GROUNDED_ANCHOR, 0) and one.steps == [[T.GROUNDED_ANCHOR, 0, T.NOTHING]]
    assert "through" not in [said[0] for said in one.said]
    found, one = along(monkeypatch, facet=0, lowest_buoy=0)
    assert (
        found == (T.GROUNDED_ANCHOR, 0)
        and ("through", 0, 25.0) in one.said
        and one.said[-1] == ("march", 0, math.inf, -1)
    )
    found, one = along(monkeypatch, facet=0, lowest_buoy=0, through=11.0)
    assert found == "lifted" and one.said[-1] == ("lift", 0, 11.0) and one.w.q[T.S] == 65.0


def test_a_line_without_tension_slides_to_a_vertex_or_lies_there_in_a_heap(monkeypatch):
    for slides, foot in ((False, 1), (True, 0)):
        found, one = along(monkeypatch, tension=-1.0, slides=slides)
        assert found == (T.SLID, 1) and one.w.count[2] == foot and ("slides", 0) in one.said and not one.steps
    assert along(monkeypatch, tension=0.0)[0] == (T.NONE, 1)
    found, one = along(monkeypatch, tension=-1.0, foot=1, heap=3.0)
    assert found == (T.NONE, 1) and one.w.q[T.T] == 0.0 and ("heap", 3.0) in one.said
    assert one.steps == [[T.ALONG, 1, T.NOTHING], [T.HEAP_AT_VERTEX, 1, T.NOTHING]] and one.w.unknowns[1] == 3.0
    assert along(monkeypatch, tension=-1.0, foot=1, heap=3.0, leaves=False)[0] == (T.SLID, 1)


class Whole:
    """A traverse whose spans and facets are told; said : what was called, with its facet"""

    def __init__(self, monkeypatch, spans, touchdowns=(), alongs=(), vertices=(), heap=0.0, foot=0, leaves=True):
        self.said = []
        self.line = SimpleNamespace(heap=heap, foot=foot, weight=400.0, length=100.0)
        self.w = SimpleNamespace(q=np.zeros(7), at=np.array([0, 2]), g=0, rows=0, count=np.array([0, 0, 0]),
                                 steps=np.zeros((30, 3), np.int64), unknowns=np.zeros(30))  # fmt: skip
        self.w.q[[T.S, T.T]] = 44.0, -2.0
        given = {"after_touchdown": iter(touchdowns), "along_facet": iter(alongs), "over_vertex": iter(vertices)}

        def told(name):
            def stand_in(line, w, facet):
                self.said.append((name, facet))
                return next(given[name])

            return stand_in

        monkeypatch.setattr(traverse, "start_traverse", lambda line, w, H, x, z: (H, x, z))
        monkeypatch.setattr(traverse, "first_span", lambda line, w, facet: self.said.append(("first", facet)) or spans)
        for name in given:
            monkeypatch.setattr(traverse, name, told(name))
        monkeypatch.setattr(traverse, "left_over", lambda line, w: "left")
        monkeypatch.setattr(traverse, "place_on_vertex", lambda line, q, g, facet: self.said.append(("vertex", facet)))
        monkeypatch.setattr(traverse, "leave_heap", lambda *given: self.said.append(("heap", given[4])) or leaves)

    def __call__(self):
        return traverse.traverse(self.line, self.w, 5.0, 6.0, 7.0)


VERTEX = T.TO_ANCHOR + T.TO_FACET + 17  # any other step


def test_a_traverse_is_a_span_to_the_anchor_or_to_a_facet_and_on_over_facets_and_vertices(monkeypatch):
    one = Whole(monkeypatch, (T.TO_ANCHOR, 0))
    assert (
        one() == "left" and one.said == [("first", (5.0, 6.0, 7.0))] and one.w.steps[0].tolist() == [T.TO_ANCHOR, 0, 2]
    )
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], [(T.NONE, 2), (T.GROUNDED_ANCHOR, 1)], [(T.NONE, 2)])
    assert one() == "left"
    assert one.said[1:] == [("after_touchdown", 2), ("along_facet", 2), ("over_vertex", 2), ("along_facet", 1)]
    one = Whole(monkeypatch, (VERTEX, 2), [], [(T.GROUNDED_ANCHOR, 1)], [(T.NONE, 2)])
    assert one() == "left" and one.said[1:] == [("vertex", 2), ("over_vertex", 2), ("along_facet", 1)]
    assert one.w.unknowns[0] == 44.0
    again = Whole(monkeypatch, (T.TO_FACET, 2), [(VERTEX, 1)], [(T.GROUNDED_ANCHOR, 0)], [(T.NONE, 1)])
    assert again() == "left" and again.w.count[0] == 2 and again.w.steps[1].tolist() == [VERTEX, 1, 2]


def test_a_traverse_without_a_touching_span_has_no_steps_and_one_that_slides_misses_a_tension(monkeypatch):
    one = Whole(monkeypatch, (T.MISSED, 0))
    assert math.isnan(one()) and one.w.count[0] == 0
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], [(T.SLID, 2)])
    assert one() == -2.0 / 400.0 * 100.0 and one.w.count[0] == 0
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], [(T.MISSED, 2)])
    assert math.isnan(one()) and one.w.count[0] == 0


def test_a_heap_lies_at_the_first_touchdown_alone(monkeypatch):
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], [(T.GROUNDED_ANCHOR, 2)], heap=3.0)
    assert one() == "left" and ("heap", 3.0) in one.said
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], heap=3.0, leaves=False)
    assert math.isnan(one())
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(VERTEX, 1)], heap=3.0)
    assert math.isnan(one()) and ("heap", 3.0) not in one.said
    one = Whole(monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2)], [(T.GROUNDED_ANCHOR, 2)], heap=3.0, foot=2, leaves=False)
    assert one() == "left" and ("heap", 3.0) not in one.said
    twice = Whole(
        monkeypatch, (T.TO_FACET, 2), [(T.NONE, 2), (T.NONE, 1)], [(T.TO_FACET, 1), (T.GROUNDED_ANCHOR, 1)], heap=3.0
    )
    assert twice() == "left" and twice.said.count(("heap", 3.0)) == 1


# ------------------------------------------------------------------ a stage of a step in time


def solved(monkeypatch, sizes):
    """(what `solve_stage` returns, what was called) with corrections of these tensions and distances in turn"""
    said, sizes = [], iter(sizes)
    for name in ("node_forces", "factor_line", "correct"):
        monkeypatch.setattr(stage, name, lambda *given, name=name: said.append(name))
    monkeypatch.setattr(stage, "correction", lambda *given: said.append("correction") or next(sizes))
    work = SimpleNamespace(D=0, B=0, bending=0, pivots=0)
    return stage.solve_stage(SimpleNamespace(length=np.ones(3)), work, 0, 0, 0, 1.0, 1.0, 10.0, 2.0), said


@pytest.mark.parametrize("sizes, found", [
    ([(10.0, 2.0)], (stage.CONVERGED, 1)),
    ([(10.1, 1.0), (10.0, 2.0)], (stage.CONVERGED, 1)),
    ([(9.0, 2.1), (9.0, 2.1), (10.0, 1.0)], (stage.CONVERGED, 2)),
    ([(90.0, 2.0), (90.0, 2.0), (80.0, 2.0), (10.0, 2.0)], (stage.CONVERGED, 2)),
    ([(math.nan, 1.0)], (stage.NOT_FINITE, 1)),
    ([(1e2, 1.0), (1e2, 1.0), (1.0, math.inf)], (stage.NOT_FINITE, 2)),
    ([(1e2, 1.0)] * 8 + [(1e2, 41.0)] * 2, (stage.STALLED, 5)),
    ([(1e2, 1.0)] * 6 + [(1e2, 41.0)] * 2 + [(1.0, 1.0)], (stage.CONVERGED, 5)),
    ([(1e2, 1.0)] * 8 + [(200.0, 39.0)] * 2 + [(1.0, 1.0)], (stage.CONVERGED, 6)),
])  # fmt: skip
def test_a_stage_is_solved_within_both_limits_or_stalls_where_its_corrections_double(monkeypatch, sizes, found):
    """Limits of 10 N and 2 m: a correction, and what is then left with the same matrix; stalls from the fifth on"""
    result, said = solved(monkeypatch, sizes)
    assert result == found
    if found[0] == stage.CONVERGED:
        assert said[0] == "node_forces" and said[1:5] == ["factor_line", "correction", "correct", "node_forces"]
        assert said.count("factor_line") == found[1] == said.count("correct")


def test_a_stage_that_goes_on_stalls_in_the_end(monkeypatch):
    result, _ = solved(monkeypatch, [(1e2, 1.0)] * 200)
    assert result == (stage.STALLED, stage.ITERATIONS)
