"""The pull on a moving end is that of the closed forms, wherever it comes from and whatever was solved before."""

import numpy as np
import pytest
from plain import plain

from hakobune.bem.kernels.jit import kernel
from hakobune.mooring.lines.catenary.flat_bed import ROW, solve_line
from hakobune.mooring.lines.catenary.moving_end import pull_of_any, tensions_near, workspace
from hakobune.mooring.lines.catenary.state import BEYOND_REACH, GROUNDED, SUSPENDED


def path(rng, length):
    """Spans and heights of an end that wanders from slack to taut, in steps and jumps"""
    x = length * (0.75 + 0.35 * np.sin(np.arange(400) * rng.uniform(0.01, 0.3)))
    z = length * rng.uniform(0.05, 0.4) * (1 + 0.2 * np.sin(np.arange(400) * 0.2))
    jumps = rng.random(400) < 0.05
    return np.where(jumps, length * rng.uniform(0, 1.05, 400), x), z


def test_a_warm_start_changes_nothing_but_rounding():
    rng, worst = np.random.default_rng(5), 0.0
    for _ in range(60):
        length, weight = 10 ** rng.uniform(1, 3), 10 ** rng.uniform(1, 4) * rng.choice([1, 1, 1, -1])
        flexibility, friction = 10 ** rng.uniform(-10, -6.5), rng.choice([0.0, 0.7])
        low, bed = (0.0, 0.0) if rng.random() < 0.7 else (0.05 * length, 0.0)
        kept, rows = workspace(1)
        for x, z in zip(*path(rng, length), strict=True):
            found = pull_of_any(kept[:, 0], rows[0], x, low, z, bed, length, weight, flexibility, friction)
            row = np.zeros(ROW)
            if weight > 0:
                solve_line(row, x, low, z, length, weight, flexibility, friction if low == bed else 0.0, True)
                wanted = row[2], row[4]
            else:
                solve_line(row, x, -low, -z, length, -weight, flexibility, 0.0, False)
                wanted = row[2], -row[4]
            assert np.isfinite(found).all() == np.isfinite(wanted).all()
            scale = np.hypot(*wanted)
            worst = max(worst, np.abs(np.subtract(found, wanted)).max() / scale)
    assert worst <= 1e-10


def test_lines_side_by_side_pull_as_each_alone():
    """Chains from the bed, from above it and from a deeper place, and one that floats, each with its own numbers"""
    ends = plain("mooring.lines.catenary.moving_end")
    x, low = np.array([90.0, 70.0, 40.0, 60.0]), np.array([-50.0, -45.0, -30.0, -20.0])
    high = np.array([-2.0, -5.0, -1.0, -40.0])
    lines = np.array([[110.0, 800.0, 1e-8, 0.5], [85.0, 600.0, 2e-8, 0.0], [52.0, 400.0, 0.0, 0.0],
                      [70.0, -300.0, 1e-8, 0.0]])  # fmt: skip
    out, (kept, rows) = np.zeros((4, 2)), ends.workspace(4)
    ends.pulls(kept, rows, x, low, high, -50.0, lines, out)
    for i in range(4):
        alone, room = ends.workspace(1)
        found = ends.pull_of_any(alone[:, 0], room[0], x[i], low[i], high[i], -50.0, *lines[i])
        assert out[i] == pytest.approx(found, rel=1e-12) and np.array_equal(kept[:, i], alone[:, 0])
    assert len(np.unique(np.round(out, 3), axis=0)) == 4 and np.all(np.isfinite(out))


@kernel(counted=False)
def follow(kept, lines, ends):
    tensions_near(kept, lines, ends, 0)


def eight_lines(rng):
    """kept, lines and ends of eight lines that were followed to one place of their end and are now at another"""
    kept, rows = workspace(8)
    lines, ends = np.zeros((4, 8)), np.zeros((4, 8))
    for i in range(8):
        length, weight = 10 ** rng.uniform(1.5, 3), 10 ** rng.uniform(2, 4)
        lines[:, i] = length, weight, 10 ** rng.uniform(-10, -8), rng.choice([0.0, 0.7])
        x, z = length * rng.uniform(0.85, 0.99), length * rng.uniform(0.02, 0.15)
        for place in (x, x * (1 - 1e-6)):
            pull_of_any(kept[:, i], rows[i], place, 0.0, z, 0.0, *lines[:, i])
        ends[:2, i] = x * (1 + 1e-4 * rng.normal()), z * (1 + 1e-3 * rng.normal())
    return kept, lines, ends


def test_eight_lines_at_once_are_those_solved_alone_and_not_changed_by_their_neighbours():
    rng, solved = np.random.default_rng(8), 0
    for _ in range(40):
        kept, lines, ends = eight_lines(rng)
        before, other_kept, beside = kept.copy(), kept.copy(), ends.copy()
        beside[:2, 1::2], other_kept[1:, 1::2] = np.nan, 7.0
        follow(kept, lines, ends)
        follow(other_kept, lines, beside)
        assert np.array_equal(ends[:, ::2], beside[:, ::2], equal_nan=True) and np.isnan(beside[2:, 1::2]).all()
        assert np.array_equal(kept[:, ::2], other_kept[:, ::2])
        for i in range(8):
            row, (x, z) = np.zeros(ROW), ends[:2, i]
            length, weight, flexibility, friction = lines[:, i]
            solve_line(row, x, 0.0, z, length, weight, flexibility, friction, True)
            if before[0, i] != GROUNDED or np.isnan(ends[2, i]):
                continue
            assert row[0] == GROUNDED and kept[1, i] == ends[2, i]
            assert np.abs(ends[2:, i] - row[[2, 4]]).max() <= 1e-10 * np.hypot(row[2], row[4])
            solved += 1
        still = np.isnan(ends[2])
        assert np.array_equal(kept[:, still], before[:, still])
    assert solved >= 150  # others hang free, or need a fourth iteration


@pytest.mark.parametrize("flexibility, friction", [(0.0, 0.0), (2e-6, 0.0), (2e-6, 0.05), (3e-6, 0.9), (0.0, 0.6)])
def test_the_tangents_that_are_kept_are_the_slopes_of_the_pull(flexibility, friction):
    """∂H/∂x and ∂H/∂h beside differences of H over 2 mm, of a line alone and of one of eight; H within its friction
    along the whole part on the bed, and beyond it"""
    ends = plain("mooring.lines.catenary.moving_end")
    length, weight, x, height, off = 200.0, 500.0, 182.0, 40.0, 1e-3

    def pull(x, height):
        row = np.zeros(ROW)
        ends.solve_line(row, x, 0.0, height, length, weight, flexibility, friction, True)
        assert row[0] == GROUNDED
        return row[2]

    by_x = (pull(x + off, height) - pull(x - off, height)) / (2 * off)
    by_height = (pull(x, height + off) - pull(x, height - off)) / (2 * off)
    kept = np.array([GROUNDED, pull(x - 0.05, height + 0.02), x - 0.05, height + 0.02, by_x, by_height])
    H, _ = ends.tension_near(kept, x, height, length, weight, flexibility, friction)
    assert pytest.approx(pull(x, height), rel=1e-9) == H and kept[1:4].tolist() == [H, x, height]
    assert kept[4:] == pytest.approx([by_x, by_height], rel=1e-5)


@pytest.mark.parametrize("flexibility, friction", [(0.0, 0.0), (2e-6, 0.05), (3e-6, 0.9)])
def test_eight_lines_at_once_keep_the_slopes_of_their_pulls(flexibility, friction):
    length, weight, off = 200.0, 500.0, 1e-3
    x, height = np.linspace(178.0, 184.0, 8), np.linspace(35.0, 42.0, 8)

    def pull(x, height):
        row = np.zeros(ROW)
        solve_line(row, x, 0.0, height, length, weight, flexibility, friction, True)
        assert row[0] == GROUNDED
        return row[2]

    of = lambda x, height: np.array([pull(*place) for place in zip(x, height, strict=True)])  # noqa: E731
    by_x = (of(x + off, height) - of(x - off, height)) / (2 * off)
    by_height = (of(x, height + off) - of(x, height - off)) / (2 * off)
    kept = np.array([np.full(8, GROUNDED), of(x - 0.01, height), x - 0.01, height, by_x, by_height], float)
    lines = np.repeat([[length], [weight], [flexibility], [friction]], 8, axis=1)
    ends = np.array([x, height, np.zeros(8), np.zeros(8)])
    follow(kept, lines, ends)
    assert ends[2] == pytest.approx(of(x, height), rel=1e-9) and np.array_equal(kept[1:4], [ends[2], x, height])
    assert kept[4] == pytest.approx(by_x, rel=1e-4) and kept[5] == pytest.approx(by_height, rel=1e-4)


@pytest.mark.parametrize("before, x, height, flexibility, state", [
    (SUSPENDED, 99.0, 14.2, 0.0, BEYOND_REACH), (SUSPENDED, 99.0, 14.0, 0.0, SUSPENDED),
    (SUSPENDED, 99.0, 40.0, 1e-7, SUSPENDED), (GROUNDED, 90.0, 20.0, 0.0, GROUNDED),
])  # fmt: skip
def test_an_inextensible_line_that_would_have_to_be_longer_has_no_pull_and_no_state_to_go_on_from(
    before, x, height, flexibility, state
):
    """100 m: 99² + 14.2² is beyond 100², 99² + 14.0² within; √(99² + 40²) is reached by a line that stretches"""
    ends = plain("mooring.lines.catenary.moving_end")
    found, H, V, of = ends.pull_anew(before, 0.0, x, height, 100.0, 500.0, flexibility, 0.0)
    assert found == state and np.isfinite(H) == np.isfinite(V) == np.isfinite(of) == (state != BEYOND_REACH)
