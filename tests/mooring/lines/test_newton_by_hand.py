"""Newton's method of a line's kernels as plain Python, on equations of few unknowns, and what is done with it."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

newton = plain("mooring.lines.multi_segment.newton")


@pytest.mark.parametrize("n", [1, 2, 4])
def test_linear_equations_are_solved_whichever_rows_come_first(n):
    rng = np.random.default_rng(n)
    A, x = rng.normal(size=(n, n)), rng.normal(size=(n, 3))
    A[0, 0] = 0.0 if n > 1 else 2.0
    made = np.hstack([A, A @ x])
    assert newton.solve_small(made, n) and made[:, n:] == pytest.approx(x)


@pytest.mark.parametrize("bad", [[[1.0, 2.0], [2.0, 4.0]], [[0.0, 1.0], [0.0, 1.0]], [[math.nan, 1.0], [1.0, 1.0]]])
def test_equations_that_do_not_determine_the_unknowns_are_told(bad):
    assert not newton.solve_small(np.hstack([bad, np.ones((2, 1))]), 2)


def test_the_largest_is_by_size_and_what_is_no_number_is_largest():
    assert newton.largest(np.array([1.0, -3.0, 2.0])) == 3.0 and newton.largest(np.zeros(2)) == 0.0
    assert math.isnan(newton.largest(np.array([1.0, math.nan, 0.5]))) and newton.largest(np.array([-math.inf])) > 1e300


def test_a_step_has_the_residual_and_the_derivatives_by_both_coordinates():
    """J u = r, and J ∂u = ∂r by x and z"""
    J = np.array([[2.0, 1.0, 3.0, 5.0], [0.0, 4.0, 8.0, -4.0]])
    A, e = np.full((2, 5), 9.0), SimpleNamespace(u=np.zeros(2), r=np.array([4.0, 8.0]), J=J)
    assert newton.newton_step(e, A)
    assert A[:, 2:] == pytest.approx(np.array([[1.0, 0.5, 3.0], [2.0, 2.0, -1.0]]))


class Equations:
    """r(u) of one unknown about which Newton's method goes from u = start; asked : every u"""

    def __init__(self, monkeypatch, r, slope, start, length=1.0):
        self.r, self.slope, self.asked = r, slope, []
        self.e = SimpleNamespace(u=np.array([start]), r=np.zeros(1), J=np.array([[1.0, 0.0, 0.0]]))
        self.line = SimpleNamespace(length=length)
        monkeypatch.setattr(newton, "equations", self.equations)

    def equations(self, line, e, x, z, steps, left, rows):
        assert (x, z, steps, left, rows) == ("x", "z", "steps", "left", "rows")
        self.asked.append(float(e.u[0]))
        e.r[0], e.J[0] = self.r(e.u[0]), [self.slope(e.u[0]), 0.0, 0.0]

    def __call__(self):
        return newton.newton(self.line, self.e, np.zeros((1, 4)), "x", "z", "steps", "left", "rows")


def test_a_root_is_found_to_rounding_and_the_residual_is_over_the_length(monkeypatch):
    one = Equations(monkeypatch, lambda u: u * u - 2, lambda u: 2 * u, 5.0, length=4.0)
    assert one() == pytest.approx(0.0, abs=1e-15) and one.e.u[0] == pytest.approx(math.sqrt(2), rel=1e-15)
    assert one.asked[1] == pytest.approx(5 - 23 / 10) and len(one.asked) < 12


def test_a_pull_is_taken_down_by_seven_tenths_at_most(monkeypatch):
    """u = 10 goes to 3 and 0.9 before the root at ½; a step up is taken whole"""
    one = Equations(monkeypatch, lambda u: math.log(2 * u), lambda u: 1 / u, 10.0)
    one()
    assert one.asked[:3] == pytest.approx([10.0, 3.0, 0.9])
    up = Equations(monkeypatch, lambda u: u - 100.0, lambda u: 1.0, 1.0)
    assert up() == 0.0 and up.asked[:2] == [1.0, 100.0]


def test_a_step_is_halved_until_the_residual_falls_and_given_up_after_twelve(monkeypatch):
    """From 1 to −9 by a slope that is ten times too flat: 1 − 10/16 is the first that is nearer to 0.45"""
    one = Equations(monkeypatch, lambda u: abs(u - 0.45), lambda u: -0.055, -0.1)
    one()
    assert one.asked[1] == pytest.approx(-0.1 + 0.55 / 0.055) and one.asked[2] == pytest.approx(-0.1 + 5.0)
    assert one.asked[4] == pytest.approx(-0.1 + 10 / 8) and one.asked[5] == pytest.approx(-0.1 + 10 / 16)
    stuck = Equations(monkeypatch, lambda u: 1.0 + abs(u + 2.0), lambda u: -1e-3, -2.0, length=2.0)
    assert stuck() == 0.5 and stuck.e.u[0] == -2.0
    trials = np.array(stuck.asked[1:])
    assert len(trials) == 13 and trials[:11] + 2.0 == pytest.approx(1000.0 * 0.5 ** np.arange(11.0))
    assert trials[-1] == -2.0


def test_where_no_step_can_be_found_the_residual_is_infinite(monkeypatch):
    flat = Equations(monkeypatch, lambda u: 3.0, lambda u: 0.0, 1.0)
    assert flat() == math.inf and flat.asked == [1.0]


def test_what_is_at_its_rounding_is_settled_and_ends_with_its_derivatives(monkeypatch):
    """A residual of 4e-14 of the length that does not halve is rounding: one more step for the derivatives, unused"""
    one = Equations(monkeypatch, lambda u: 4e-14 if u != 1.0 else 5e-14, lambda u: 1.0, 1.0)
    assert one() == pytest.approx(4e-14) and len(one.asked) == 2
    far = Equations(monkeypatch, lambda u: 4e-13 if u != 1.0 else 5e-13, lambda u: 1.0, 1.0)
    assert far() == pytest.approx(4e-13) and len(far.asked) > 2


def test_unknowns_of_a_traverse_are_followed_by_the_weights_of_buoys_that_float_from_the_top():
    states = np.array([newton.FLOATING, newton.FLOATING + 1, newton.FLOATING])
    w = SimpleNamespace(states=states, count=np.array([7, 2]), unknowns=np.array([3.0, 4.0, 99.0]),
                        load_weights=np.array([10.0, 20.0, 30.0]))  # fmt: skip
    e = newton.equations_for(w)
    assert e.u.tolist() == [3.0, 4.0, 30.0, 10.0] and e.states.tolist() == states.tolist() and e.states is not states


def test_what_is_stored_of_a_line_has_its_stiffness_as_the_slope_of_its_pull():
    """∂(H, V)/∂(x, z) are less the last columns, since J ∂u + ∂r = 0"""
    e = SimpleNamespace(u=np.array([5.0, 6.0]), q=np.zeros(9), at=np.array([0, 0, 4]))
    e.q[[newton.H, newton.V, newton.S]] = 7.0, 8.0, 9.0
    A, result = np.array([[0, 0, 0, 1.0, 2.0], [0, 0, 0, 3.0, 4.0]]), np.zeros(11)
    newton.store(e, A, 1e-12, result)
    assert result.tolist() == [5.0, 6.0, 7.0, 8.0, 9.0, -1.0, -2.0, -3.0, -4.0, 1e-12, 4.0]


class Places:
    """A line whose pull is 2 x + z, solved at places one after the other"""

    def __init__(self, monkeypatch, left=None, limit=math.inf, residual=0.0, pieces=3, good=True):
        self.begun, self.judged, self.good = [], [], good
        self.w = SimpleNamespace(states=np.array([1, 0]), count=np.array([2, 2]), unknowns=np.array([1.0, 8.0]),
                                 load_weights=np.zeros(2), steps=np.array([5, 6, 7]),
                                 trial_q="q", q="below", g="g")  # fmt: skip
        self.left = newton.TAUT if left is None else left
        self.limit, self.residual, self.pieces = limit, residual, pieces
        monkeypatch.setattr(newton, "newton", self.newton)
        monkeypatch.setattr(newton, "stands", self.stands)
        monkeypatch.setattr(newton, "store", lambda e, A, residual, result: result.__setitem__(0, e.u[0]))
        monkeypatch.setattr(newton, "FLOATING", 99)

    def newton(self, line, e, A, x, z, steps, left, rows):
        assert line == "line" and steps.tolist() == [5, 6] and left == self.left
        self.begun.append(float(e.u[0]))
        e.u[0], e.at[2] = (2 * x + z if x < self.limit else -1.0), self.pieces
        e.states[:] += 1
        A[:] = 0.0
        A[0, 3], A[0, 4], A[0, 0], A[0, 1] = -2.0, -1.0, 77.0, 78.0
        A[1, 3], A[1, 4] = -0.1, -0.01
        return self.residual

    def stands(self, line, rows, count, states, slack, *room):
        self.judged.append((line, count, states.tolist(), slack, room))
        return self.good

    def __call__(self, first=0):
        self.result = np.zeros((4, 11))
        x, z = np.array([10.0, 11.0, 13.0, 14.0]), np.array([1.0, 1.0, 5.0, 2.0])
        return newton.continuation("line", self.w, x, z, first, self.left, 42.0, np.zeros((5, 8)), self.result)


def test_each_place_begins_where_the_derivatives_of_the_last_lead(monkeypatch):
    one = Places(monkeypatch)
    assert one(1) == 4 and one.begun == pytest.approx([1.0, 31.0, 30.0])
    assert one.result[:, 0].tolist() == [0.0, 23.0, 31.0, 30.0] and one.w.states.tolist() == [4, 3]
    assert one.judged[0] == ("line", 3, [2, 1], False, ("q", "below", "g"))


@pytest.mark.parametrize(
    "given, solved",
    [(dict(), 4), (dict(limit=12.0), 2), (dict(residual=2e-10), 0), (dict(residual=0.9e-10), 4), (dict(pieces=5), 0),
     (dict(pieces=4), 4), (dict(good=False), 0), (dict(residual=math.nan), 0)],
)  # fmt: skip
def test_places_are_solved_as_long_as_the_pieces_stand(monkeypatch, given, solved):
    assert Places(monkeypatch, **given)() == solved


def test_a_line_that_is_not_taut_is_solved_at_one_place_and_from_its_heap(monkeypatch):
    for left, begun in ((newton.HEAP_AT_TOUCHDOWN, 42.0), (newton.HEAP_AT_ANCHOR, 1.0)):
        one = Places(monkeypatch, left=left)
        assert one() == 1 and one.begun == [begun]
        assert one.judged[0][3] == (left == newton.HEAP_AT_ANCHOR)


@pytest.mark.parametrize("target", [25.0, math.nan])
@pytest.mark.parametrize("begins, at, V, ends, left", [
    (100.0, (1, 0, 0), 6e4, 17.5, 7e3),  # 60 − 36 − 8 − 3 kN are 9 kN above H tan β, or 22.5 m
    (35.0, (0, -1, 0), 12e3, 15.0, 8e3),  # below joint and sinker, 8 kN above it
])  # fmt: skip
def test_a_span_ends_at_a_place_or_parallel_to_a_facet_with_the_slopes_of_differences(
    target, begins, at, V, ends, left
):
    """Down a line of 900 over 400 N/m, past a joint at 60 and 3 kN at 40 m, to 25 m or to where V = H tan β;
    slopes by H and V where it begins, its end and its begin"""
    equations = plain("mooring.lines.multi_segment.equations")
    line = SimpleNamespace(
        bed=np.array([[0.0, -100.0, math.atan(0.2)]]), segments=np.array([[0.0, 400.0], [60.0, 900.0]]), surface=1e3,
        loads=np.array([[40.0, 3e3, 4e3]]), first_row=np.array([0, 1, 2]),
        strain_table=np.array([[0.0, 1.0, 1e-6], [0.0, 1.0, 2e-6]]),
    )  # fmt: skip
    to_facet, given, rows = math.isnan(target), np.array([2e4, V, 25.0, begins]), [equations.H, equations.V]

    def marched(H, V, end, begin):
        e = equations.empty_equations(2, np.zeros(1, np.int64))  # with four columns of derivatives
        e.q[equations.H], e.q[equations.V], e.q[equations.S] = H, V, begin
        e.g[[*rows, equations.S], [0, 1, 3]] = 1.0
        e.at[:] = at
        to = (math.nan, -1) if to_facet else (end, 2)
        equations.march_span(line, e, 0, np.int64(-1), *to, np.zeros((9, 11)))
        return e.q, e.g

    q, g = marched(*given)
    assert q[equations.S] == pytest.approx(ends if to_facet else 25.0)
    assert q[equations.V] == pytest.approx(4e3 if to_facet else left)
    for column, step in enumerate((1.0, 1.0, 1e-3, 1e-3)):
        moved = step * np.eye(4)[column]
        slope = (marched(*(given + moved))[0] - marched(*(given - moved))[0]) / (2 * step)
        for row in (equations.X, equations.Z, equations.V, equations.S):
            assert g[row, column] == pytest.approx(slope[row], rel=1e-5, abs=1e-9), (row, column)
