"""Where a free span begins and first touches the bed, and how a line lies along a facet, kernel by kernel."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

touchdown, on_bed = (plain(f"mooring.lines.multi_segment.{name}") for name in ("touchdown", "on_bed"))
H, V, X, Z, S, T, PHI, LENGTH, END, LOW, HIGH = range(11)


@pytest.mark.parametrize("origin, called, found", [
    ("FROM_FAIRLEAD", [], 3), ("FROM_FACET", ["march", "leave"], 3), ("FROM_SINKER", ["sinker"], 3),
    ("FROM_VERTEX", ["bend", "leave"], 2),
])  # fmt: skip
def test_a_span_begins_at_the_fairlead_on_a_facet_at_a_sinker_or_at_a_vertex(monkeypatch, origin, called, found):
    """What is sought is V, a length along the facet, a normal force, or an angle"""
    said, none = [], touchdown.NOTHING
    for name, stand_in in dict(
        march_on_facet=lambda line, q, g, at, facet, amount, unknown, load, rows: said.append(
            ("march", facet, amount, unknown == load == none, rows)
        ),
        leave_bed=lambda line, q, g: said.append(("leave",)),
        pass_grounded_sinker=lambda line, q, g, at, facet, force, unknown: said.append(
            ("sinker", facet, force, unknown == none)
        ),
        bend_at_vertex=lambda line, q, g, angle, unknown: said.append(("bend", angle, unknown == none)),
    ).items():
        monkeypatch.setattr(touchdown, name, stand_in)
    q = np.zeros(7)
    assert touchdown.start_span("line", getattr(touchdown, origin), q, "g", "at", 3, 7.5, "rows") == found
    assert [one[0] for one in said] == called and (q[V] == 7.5) == (origin == "FROM_FAIRLEAD")
    if "march" in called:
        assert said[0] == ("march", 3, 7.5, True, "rows")
    elif called:
        assert said[0] == ("sinker", 3, 7.5, True) if "sinker" in called else said[0] == ("bend", 7.5, True)


def test_the_trial_of_a_span_leaves_the_state_where_it_began(monkeypatch):
    monkeypatch.setattr(
        touchdown, "start_span", lambda line, origin, q, g, at, facet, amount, rows: q.fill(amount) or 5
    )
    monkeypatch.setattr(touchdown, "first_contact", lambda line, q, g, at, facet, *more: (q[0], at[0], facet))
    q0, at0, q, at = np.ones(7), np.array([4, 4, 4]), np.zeros(7), np.zeros(3, int)
    assert touchdown.try_span("line", 1, q0, at0, 3, 2.5, q, "g", at, "s", "w", "r") == (2.5, 4, 5)
    assert np.all(q0 == 1.0) and np.all(q == 2.5)


class Spans:
    """Spans of which a start above `root` penetrates; asked : every start in order"""

    def __init__(self, monkeypatch, root, step=lambda amount: 11, scale=3.0, origin=None):
        self.root, self.step, self.scale, self.asked = root, step, scale, []
        self.origin = touchdown.FROM_FACET if origin is None else origin
        monkeypatch.setattr(touchdown, "try_span", self.trial)

    def trial(self, line, origin, q0, at0, facet, amount, q, *more):
        assert origin == self.origin and facet == 2
        self.asked.append(amount)
        q[0] = amount
        return self.scale * (self.root - amount), self.step(amount), 7

    def __call__(self, low, high, close=0.0):
        self.q, line = np.zeros(7), SimpleNamespace(close=close)
        return touchdown.touching_start(line, self.origin, self.q, "g", np.zeros(3, int), 2, low, high, "s", "w", "r")


@pytest.mark.parametrize("root", [0.3, 5.0, 9.999])
def test_the_start_of_a_touching_span_is_between_one_that_clears_and_one_that_does_not(monkeypatch, root):
    """The step told is that of the last that penetrated, and the state is left there"""
    one = Spans(monkeypatch, root, lambda amount: 11 if amount > root else 12)
    start, step, index = one(0.0, 10.0)
    assert start == pytest.approx(root, rel=1e-13) and start >= root and (step, index) == (11, 7)
    assert one.q[0] == start and len(one.asked) < 70
    rough = Spans(monkeypatch, root)
    start, _, _ = rough(0.0, 10.0, close=1e-2)
    assert abs(start - root) <= 0.03 * root and len(rough.asked) < len(one.asked)


def test_guesses_at_the_fairlead_are_moved_apart_until_they_bracket_the_start(monkeypatch):
    """Down by 1, 2, 4 … of what was between them, up to four times as far"""
    low = Spans(monkeypatch, -20.0, origin=touchdown.FROM_FAIRLEAD)
    assert low(4.0, 6.0)[0] == pytest.approx(-20.0) and low.asked[:5] == [4.0, 2.0, -2.0, -10.0, -26.0]
    high = Spans(monkeypatch, 100.0, origin=touchdown.FROM_FAIRLEAD)
    assert high(4.0, 6.0)[0] == pytest.approx(100.0) and high.asked[:5] == [4.0, 6.0, 12.0, 36.0, 132.0]


def test_a_span_that_never_penetrates_is_missed_and_one_that_touches_its_own_start_begins_there(monkeypatch):
    none = Spans(monkeypatch, 100.0, lambda amount: touchdown.NONE)
    _, step, index = none(0.0, 10.0)
    assert (step, index) == (touchdown.MISSED, 2)
    at_once = Spans(monkeypatch, -1e-9)
    assert at_once(0.0, 10.0)[0] < 1e-12


@pytest.mark.parametrize("normal, slides", [(30.0, True), (2e3, False)])
def test_a_grounded_sinker_takes_what_it_weighs_less_its_normal_force_and_friction(normal, slides):
    """On a slope of 0.2 with μ = 0.5; a span below keeps the least tension, and then friction is what is needed

    H falls by N (sin + μ cos), V by W − N (cos − μ sin); derivatives beside differences.
    """
    angle, mu, weight = 0.2, 0.5, 400.0
    line = SimpleNamespace(
        bed=np.array([[0.0, -50.0, angle]]), friction=mu, least=5.0, loads=np.array([[20.0, weight, 0]])
    )

    def passed(normal, h=1e3):
        q, g = np.zeros(7), np.zeros((11, 2))
        q[[H, V, X]] = h, 600.0, 12.0
        g[H, 1], g[X, 1] = 1.0, 0.5
        at = np.array([0, 0, 0])
        on_bed.pass_grounded_sinker(line, q, g, at, 0, normal, 0)
        assert at[1] == -1 and q[Z] == pytest.approx(-50.0 + 12.0 * math.tan(angle))
        return q, g

    q, g = passed(normal)
    along, across = math.sin(angle) + mu * math.cos(angle), math.cos(angle) - mu * math.sin(angle)
    if slides:
        assert q[H] == pytest.approx(1e3 - normal * along) and q[V] == pytest.approx(600 - weight + normal * across)
    else:  # the part of H beyond the least, and a force along the slope that takes it
        assert q[H] == 5.0
        pull = np.array([1e3 - 5.0, 600.0 - weight - q[V]])  # what the bed carries: N across and the rest along
        assert pull[0] * math.sin(angle) - pull[1] * math.cos(angle) == pytest.approx(normal)
    for row in (H, V):
        by_normal = (passed(normal + 1e-3)[0][row] - passed(normal - 1e-3)[0][row]) / 2e-3
        by_h = (passed(normal, 1e3 + 1e-3)[0][row] - passed(normal, 1e3 - 1e-3)[0][row]) / 2e-3
        assert g[row].tolist() == pytest.approx([by_normal, by_h], abs=1e-7)
    assert g[Z].tolist() == pytest.approx([0.0, 0.5 * math.tan(angle)])


def test_a_line_that_touches_down_lies_along_its_facet_and_a_sinker_there_is_carried_in_part(monkeypatch):
    """T = H/cos β; of a sinker with V = 150 above, H tan β below: the bed carries what is left of 400 N"""
    passed = []
    monkeypatch.setattr(on_bed, "pass_weight_on_bed", lambda line, q, g, angle, force: passed.append((angle, force)))
    line = SimpleNamespace(bed=np.array([[0.0, -50.0, 0.2]]), loads=np.array([[20.0, 400.0, 0.0]]))
    for place, count in ((20.0, 1), (21.0, 0)):
        q, g, at = np.zeros(7), np.ones((11, 2)), np.array([0, 0, 0])
        q[[H, V, X, S]] = 1e3, 150.0, 12.0, place
        on_bed.touch_down(line, q, g, at, 0)
        assert q[T] == pytest.approx(1e3 / math.cos(0.2)) and q[PHI] == 0.2 and len(passed) == count
        assert q[Z] == pytest.approx(-50 + 12 * math.tan(0.2)) and at[1] == (-1 if count else 0)
        assert g[T] == pytest.approx([1 / math.cos(0.2)] * 2) and not g[PHI].any()
        passed[1:] = []
        if count:
            assert passed.pop() == (0.2, pytest.approx(1e3 * math.tan(0.2) - (150.0 - 400.0)))
            assert g[LENGTH] == pytest.approx([math.tan(0.2) - 1.0] * 2)


@pytest.mark.parametrize(
    "place, number, weight, is_one",
    [(20.0, 0, 5.0, True), (20.0, 0, -5.0, False), (20.1, 0, 5.0, False), (20.0, -1, 5.0, False)],
)
def test_a_sinker_is_a_weight_at_the_place(place, number, weight, is_one):
    q = np.zeros(7)
    q[S] = place
    line = SimpleNamespace(loads=np.array([[20.0, weight, 0.0]]))
    assert on_bed.is_at_sinker(line, q, np.array([0, number, 0])) == is_one


def test_the_normal_force_of_a_sinker_is_what_the_line_on_either_side_does_not_carry():
    q = np.zeros(7)
    q[[H, V]] = 1e3, 150.0
    line = SimpleNamespace(loads=np.array([[20.0, 400.0, 0.0]]), bed=np.array([[0.0, 0.0, 0.2]]))
    wanted = (1e3 * math.tan(0.2) - 150.0 + 400.0) * math.cos(0.2)
    assert on_bed.normal_force_on(line, q, np.array([0, 0, 0]), 0) == pytest.approx(wanted)


@pytest.mark.parametrize("flexibility", [0.0, 1e-5])
@pytest.mark.parametrize("rate", [-300.0, 0.0, 300.0])
def test_the_length_that_covers_a_distance_stretches_by_its_mean_tension(rate, flexibility):
    """s (a + T₀/EA) − ½ rate s²/EA, with tension that falls by `rate`; none where it never gets there"""
    s = on_bed.length_for(40.0, 2e4, rate, 1.02, flexibility)
    assert s * (1.02 + flexibility * 2e4) - 0.5 * flexibility * rate * s * s == pytest.approx(40.0)
    assert on_bed.length_for(1e6, 2e4, 300.0, 1.0, 1e-5) == math.inf


@pytest.mark.parametrize("tension, folds, left, folded", [
    (900.0, True, 900.0 - 400 * (math.sin(0.6) + 0.3 * math.cos(0.6)), False),
    (100.0, False, 100.0 - 400 * (math.sin(0.6) + 0.3 * math.cos(0.6)), False),
    (100.0, True, 400 * (math.sin(0.6) - 0.3 * math.cos(0.6)) - 100.0, True),
    (200.0, True, 0.0, True),
])  # fmt: skip
def test_a_sinker_where_a_line_slides_hangs_between_both_legs_where_the_upper_does_not_hold_it(
    tension, folds, left, folded
):
    q, g, at = np.zeros(7), np.ones((11, 2)), np.array([0, 0, 0])
    q[T] = tension
    line = SimpleNamespace(loads=np.array([[20.0, 400.0, 0.0]]), friction=0.3)
    assert on_bed.pass_sliding_sinker(line, q, g, at, 0.6, folds) == folded
    assert q[T] == pytest.approx(left) and at[1] == -1
    assert g[T].tolist() == ([0.0 if left == 0.0 else -1.0] * 2 if folded else [1.0] * 2)


def test_what_lies_on_the_bed_is_marched_to_its_end_and_a_line_that_slides_or_ends_with_itself_not():
    q = np.zeros(7)
    q[S] = 33.0
    for facet, to_place, slides, length in ((0, False, False, 33.0), (0, True, False, math.inf), (0, True, True, 33.0),
                                            (1, False, True, math.inf)):  # fmt: skip
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(on_bed, "slides_down", lambda *_, slides=slides: slides)
            assert on_bed.length_on(SimpleNamespace(to_place=to_place), q, "at", facet) == length


def test_a_joint_on_the_bed_changes_the_segment_and_a_sinker_pulls_by_its_weight(monkeypatch):
    passed = []
    monkeypatch.setattr(on_bed, "pass_weight_on_bed", lambda line, q, g, angle, force: passed.append((angle, force)))
    line, at, g = (
        SimpleNamespace(loads=np.array([[20.0, 400.0, 0], [60.0, 50.0, 0]])),
        np.array([2, 1, 0]),
        np.ones((11, 2)),
    )
    on_bed.pass_on_bed(line, "q", g, at, 0.2, False)
    assert at.tolist() == [1, 1, 0] and not passed
    on_bed.pass_on_bed(line, "q", g, at, 0.2, True)
    assert at.tolist() == [1, 0, 0] and passed == [(0.2, 50.0)] and not g[LENGTH].any()
    at[0] = 0
    on_bed.pass_on_bed(line, "q", g, at, 0.2, False)
    assert at[0] == 0
