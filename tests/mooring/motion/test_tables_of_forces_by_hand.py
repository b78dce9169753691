"""Tables of forces of lines whose solver is replaced by a function of chord and height; room of lines that move."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

tables, at_rest = plain("mooring.motion.force_tables"), plain("mooring.motion.moving_lines.at_rest")
ENDS = np.array([[50.0, 90.0], [-5.0, 15.0]])
LENGTH = 70.0


def cubic(c, z):
    """H and V with their derivatives, polynomials of third degree"""
    H = [1e4 + 30 * c + 0.2 * c * c * z + z**3, 30 + 0.4 * c * z, 0.2 * c * c + 3 * z * z]
    V = [2e4 - 5 * c * z + 0.01 * c**3, -5 * z + 0.03 * c * c, -5 * c]
    return np.array([H, V])


def corner(c, z):
    """A line that comes taut at a chord of 70 m, of 1e5 N/m beyond it"""
    longer = max(c - LENGTH, 0.0)
    return np.array([[1e4 + 1e5 * longer, 1e5 * (c > LENGTH), 0.0], [3e4 + 10 * z, 0.0, 10.0]])


def made(solve, monkeypatch, floor=1e4):
    monkeypatch.setattr(tables, "_solved", lambda composite, c, z: solve(c, z))
    tree = tables._Tree(solve, ENDS, floor)
    tree.grow()
    return tree.table("line")


def test_a_table_of_third_degree_is_right_everywhere_in_its_first_cells(monkeypatch):
    """8 by 4 of them, of 5 m of chord and height"""
    table = made(cubic, monkeypatch)
    assert table.error < 1e-9 and table.coarse == 0.0 and not table.halved.any()
    assert table.cells.shape == (32, 4) and table.cells[0].tolist() == [50.0, -5.0, 5.0, 5.0]
    assert table.cells[-1].tolist() == [85.0, 10.0, 5.0, 5.0] and table.below.tolist() == [-1 - n for n in range(32)]
    assert table.values[5, 0, 3, 0] == pytest.approx(cubic(60.0, 5.0)[0, 0])  # the high corner of the sixth: 55…60, 0…5
    packed = tables.packed([table])
    for c, z in ((51.0, -4.9), (77.7, 14.9), (89.9, 3.3)):
        assert tables.packed_pull(packed, 0, np.sqrt(c * c - z * z), z) == pytest.approx(cubic(c, z)[:, 0])


def test_a_table_that_is_wrong_between_its_places_is_found_out(monkeypatch):
    """2 % of the pull more than the solver has, and 100 N where that is less than what counts"""
    table = made(cubic, monkeypatch)
    tree = tables._Tree(cubic, ENDS, 1e4)
    wrong = table._replace(values=1.02 * table.values)
    assert tree._elsewhere(wrong, "line") == pytest.approx(0.02, rel=0.2)
    tree.floor = 1e9
    most = 0.02 * max(np.abs(cubic(c, z)[:, 0]).max() for c in ENDS[0] for z in ENDS[1])
    assert 0.3 * most / 1e9 < tree._elsewhere(wrong, "line") <= most / 1e9


def test_cells_are_halved_along_the_chord_at_which_a_line_comes_taut(monkeypatch):
    table = made(lambda c, z: corner(c + 1.3, z), monkeypatch)
    cut = table.halved > 0
    assert cut.any() and not table.along[cut].any() and np.all(np.abs(table.halved[cut] - 68.7) <= 2.5)
    small = table.cells[table.cells[:, 2] < 4.9]
    assert np.all(small[:, 0] <= 70.0 + 1e-9) and np.all(small[:, 0] + small[:, 2] >= 65.0 - 1e-9)
    assert (table.cells[:, 2] * table.cells[:, 3]).sum() == pytest.approx(40 * 20)
    assert small[:, 2].min() > 1e-4 * 40 and table.coarse < 0.01


def test_cells_are_halved_along_the_height_where_that_is_worse(monkeypatch):
    def lifts(c, z):
        return np.array([[1e4, 0.0, 0.0], [3e4 + 1e5 * max(z - 2.2, 0.0), 0.0, 1e5 * (z > 2.2)]])

    table = made(lifts, monkeypatch)
    cut = table.halved != 0
    assert cut.any() and np.all(table.along[cut] == 1) and np.all(np.abs(table.halved[cut] - 2.2) <= 2.5)


@pytest.mark.parametrize("chord, span, height, reach, least", [
    (60.0, 50.0, 10.0, (5.0, 2.0), np.hypot(45.0, 10.0)), (60.0, 50.0, 10.0, (60.0, 2.0), 1.01 * 12.0),
    (60.0, 50.0, -10.0, (60.0, 2.0), 1.01 * 12.0), (60.0, 1.0, 0.0, (60.0, 0.1), 1.2),
])  # fmt: skip
def test_the_smallest_chord_is_that_of_a_fallen_span_and_longer_than_any_height(chord, span, height, reach, least):
    assert tables._slackest(chord, span, height, reach) == pytest.approx(least)


@pytest.mark.parametrize("load, most", [(2e5, 71.0), (np.inf, 1.02 * 80.0), (1e9, 1.02 * 80.0), (1e-9, 65.0)])
def test_the_largest_chord_is_where_a_line_carries_twice_its_breaking_load(load, most, monkeypatch):
    """H = 4e5 N/m beyond 70 m: 2 · 200 kN at 71 m; never beyond 2 % of strain of 80 m, nor below that at rest, 65 m"""

    def solve(composite, c, z):
        assert z == 3.0
        return np.array([[max(4e5 * (c - 70.0), 1e-6), 0, 0], [0.0, 0, 0]])

    monkeypatch.setattr(tables, "_solved", solve)
    line = SimpleNamespace(line=SimpleNamespace(segments=[SimpleNamespace(length=n) for n in (50.0, 30.0)]))
    assert tables._tautest(line, load, 65.0, 3.0) == pytest.approx(most, abs=1e-4)
    monkeypatch.setattr(tables, "_solved", lambda *_: np.full((2, 3), np.nan))
    assert tables._tautest(line, 1e9, 65.0, 3.0) == pytest.approx(65.0)


def test_room_of_moving_lines_has_their_pull_at_their_own_numbers(monkeypatch):
    """Lines 3 and 1 of four, of two and three nodes; both ends of a step begin at rest; nothing is stuck"""
    monkeypatch.setattr(at_rest, "state_pull", lambda moving, i, state: np.array([10.0 * i, 20.0, state[1][0, 0]]))
    states = [(0.0, *(np.full((n, 3), 10.0 * n + k) for k in range(4))) for n in (2, 3)]
    work = at_rest.moving_work(SimpleNamespace(number=np.array([3, 1])), states, 7, 4, (2, 18))
    pulls = [[0.0, 20.0, 20.0], [10.0, 20.0, 30.0]]
    assert work.last[3, 0].tolist() == pulls[0] and work.last[1, 0].tolist() == pulls[1]
    assert not work.last[[0, 2]].any() and not work.last[:, 1:].any() and len(work.last) == 4
    assert work.before[:, 0].tolist() == [-1.0, -1.0] and work.before[:, 1:].tolist() == pulls
    for k, name in enumerate(("position", "velocity", "acceleration", "slip")):
        kept = getattr(work, name)
        assert kept.shape == (2, 5, 3) and np.all(kept[:, :2] == 20 + k) and np.all(kept[:, 2:] == 30 + k)
    assert work.tension.shape == (7, 2) and work.pose.shape == (2, 18) and work.push.shape == (12,)
    assert work.foreseen.shape == (2, 12) and work.course.shape == (2, 3, 2, 3) and work.stuck.tolist() == [-1]
    assert np.all(work.step == at_rest.FIRST) and work.step.shape == (2, 2) and work.length.tolist() == [1.0]


def test_the_worst_cell_is_halved_first_where_there_is_room_for_a_few_alone(monkeypatch):
    """The pull kinks at 62.3 m a little, and ten times as much at 82.7 m: two cells more are of the latter"""
    monkeypatch.setattr(tables, "MOST_CELLS", 18)  # 36 of both kinds: two cuts

    def kinks(c, z):
        H = 1e4 + 4e3 * max(c - 62.3, 0.0) + 4e4 * max(c - 82.7, 0.0)
        slope = 4e3 * (c > 62.3) + 4e4 * (c > 82.7)
        return np.array([[H, slope, 0.0], [3e4, 0.0, 0.0]])

    tree = tables._Tree(kinks, ENDS, 1e4)
    worst = {number for _, number, _ in tree.whole if 80.0 <= tree.boxes[number][0] < 85.0}
    slight = {number for _, number, _ in tree.whole if 60.0 <= tree.boxes[number][0] < 65.0}
    assert len(worst) == len(slight) == 4 and tree.whole[0][1] in worst
    assert min(tree.errors[n] for n in worst) > max(tree.errors[n] for n in slight) > tables.TOLERANCE
    tree.grow()
    assert len(tree.boxes) == 36 and set(tree.cut) <= worst and len(tree.cut) == 2


def test_forces_of_a_composite_are_told_by_the_chord_and_the_height():
    """Of f(x, z) at x = √(c² − z²): ∂f/∂c = f_x c/x and ∂f/∂z = f_z − f_x z/x; nothing without a span or a solution"""
    rows = []

    def fill_row(row, composite, anchor, end):
        rows.append((composite, anchor.tolist(), end.tolist()))
        row[[2, 4, 9, 11, 15, 17]] = (100.0, 200.0, 3.0, 5.0, 7.0, 11.0) if composite == "line" else np.nan

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tables, "fill_row", fill_row)
        found = tables._solved("line", 50.0, -30.0)
        assert rows == [("line", [0.0, 0.0, 0.0], [40.0, 0.0, -30.0])]
        assert found == pytest.approx(
            np.array([[100.0, 3 * 50 / 40, 5 + 3 * 30 / 40], [200.0, 7 * 50 / 40, 11 + 7 * 30 / 40]])
        )
        assert np.isnan(tables._solved("line", 30.0, 30.0)).all() and np.isnan(tables._solved("none", 50.0, 30.0)).all()
