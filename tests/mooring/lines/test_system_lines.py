"""The compiled line between two ends over a flat bed, against the vectorised solution and against itself."""

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.flat_bed import BELOW_BED, ROW, mirror, solve_line
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import State


def solved(x, a, b, length, weight, axial_stiffness, friction=0.0, bed=True):
    arrays = np.broadcast_arrays(*(np.asarray(v, float) for v in (x, a, b, length, weight, axial_stiffness, friction)))
    x, a, b, length, weight, axial_stiffness, friction = (v.ravel().copy() for v in arrays)
    rows = np.zeros((x.size, ROW))
    for row, one in zip(rows, zip(x, a, b, length, weight, 1 / axial_stiffness, friction, strict=True), strict=True):
        if one[4] > 0:
            solve_line(row, *one, bed)
        else:  # a line that pulls upwards is one that hangs, upside down
            solve_line(row, one[0], -one[1], -one[2], one[3], -one[4], one[5], 0.0, False)
            mirror(row)
    return rows


def random_lines(n=4000, seed=3):
    rng = np.random.default_rng(seed)
    length, weight = 10 ** rng.uniform(0.5, 3.5, n), 10 ** rng.uniform(0, 4, n)
    z, x = length * rng.uniform(0, 1, n), length * rng.uniform(0, 1.1, n)
    axial = weight * length * 10 ** rng.uniform(0.5, 5, n)
    friction = np.where(rng.random(n) < 0.5, 0.0, rng.uniform(0, 1, n))
    return x, z, length, weight, axial, friction


def test_a_line_from_an_anchor_is_that_of_the_vectorised_solution():
    x, z, length, weight, axial, friction = random_lines()
    other = solve_lines(x, z, length, weight, axial, friction)
    rows = solved(x, 0.0, z, length, weight, axial, friction)
    assert np.array_equal(rows[:, 0].astype(int), other.status)
    scale = weight * length + other.tension_fairlead
    for column, value in ((1, other.horizontal_anchor), (2, other.horizontal_fairlead), (4, other.vertical_fairlead)):
        assert np.abs(rows[:, column] - value).max() < np.inf
        assert (np.abs(rows[:, column] - value) / scale).max() < 1e-11
    assert (np.abs(rows[:, 5] - other.grounded_length) / length).max() < 1e-11
    k = other.stiffness.reshape(-1, 4)
    assert (np.abs(rows[:, [9, 11, 15, 17]] - k).max(axis=1) / np.abs(k).max(axis=1)).max() < 1e-9


def test_a_line_hung_between_two_heights_is_two_lines_from_an_anchor_back_to_back():
    rng = np.random.default_rng(5)
    h, length, x = rng.uniform(5, 60, 200), rng.uniform(80, 300, 200), rng.uniform(0.2, 0.98, 200)
    x = x * np.sqrt(length**2 - h**2)
    half = solved(x, 0.0, h, length, 500.0, 1e7)
    whole = solved(2 * x, h, h, 2 * length, 500.0, 1e7)
    bed = (half[:, 0] == State.GROUNDED) | (half[:, 0] == State.SLACK)
    assert bed.sum() > 50
    for column in (2, 4):
        assert np.allclose(whole[bed, column], half[bed, column], rtol=1e-11, atol=1e-6)
    assert np.allclose(whole[bed, 5], 2 * half[bed, 5], rtol=1e-11, atol=1e-9)
    assert np.allclose(whole[bed, 3], whole[bed, 4], rtol=1e-12)


def test_forces_put_the_end_where_it_was_asked_for_on_six_decades_of_lines():
    """Span and rise from the forces, with the textbook formula of a hanging piece between tensions."""
    rng = np.random.default_rng(21)
    n = 30_000
    length, weight = 10 ** rng.uniform(0, 4, n), 10 ** rng.uniform(-1, 5, n)
    axial = weight * length * 10 ** rng.uniform(0, 6, n)
    a, b, x = (length * rng.uniform(0, top, n) for top in (0.6, 0.6, 1.2))
    a[: n // 3] = 0.0
    row = solved(x, a, b, length, weight, axial)
    assert np.all(np.isin(row[:, 0], [State.SLACK, State.GROUNDED, State.SUSPENDED]))
    H, Va, Vb, lying = row[:, 1], row[:, 3], row[:, 4], row[:, 5]

    def hung(low, high):
        """Span and rise of the piece whose vertical tension goes from low to high."""
        with np.errstate(divide="ignore", invalid="ignore"):
            bend = np.where(H > 0, H * (np.arcsinh(high / H) - np.arcsinh(low / H)), 0.0)
        span = (bend + H * (high - low) / axial) / weight
        rise = np.hypot(H, high) - np.hypot(H, low) + 0.5 * (high * high - low * low) / axial
        return span, rise / weight

    span, rise = hung(-Va, Vb)
    on_bed = row[:, 0] != State.SUSPENDED
    reach = span + np.where(on_bed, lying * (1 + H / axial), 0.0)
    taut = (np.hypot(H, np.maximum(abs(Va), abs(Vb))) / weight / length)[:, None]  # cancels in these formulas
    wrong = np.column_stack([reach - x, rise - (b - a)]) / length[:, None] / np.maximum(taut, 1.0)
    wrong[row[:, 0] == State.SLACK, 0] = 0.0
    assert np.abs(wrong).max() < 1e-12
    assert np.all(reach[row[:, 0] == State.SLACK] >= x[row[:, 0] == State.SLACK] * (1 - 1e-12))


def test_exchanging_the_ends_exchanges_the_forces():
    rng = np.random.default_rng(8)
    a, b = rng.uniform(0, 50, 500), rng.uniform(0, 50, 500)
    a[:100] = 0.0
    length, x = rng.uniform(60, 200, 500), rng.uniform(1, 150, 500)
    one, other = (solved(x, p, q, length, 300.0, 1e6, 0.2) for p, q in ((a, b), (b, a)))
    assert np.allclose(one[:, [1, 2, 3, 4, 5]], other[:, [2, 1, 4, 3, 5]], rtol=1e-10, atol=1e-8)
    swap = [9, 11, 10, 6, 8, 7, 15, 17, 16, 12, 14, 13]
    assert np.allclose(one[:, 6:], other[:, swap], rtol=1e-8, atol=1e-6)


def test_a_line_on_its_way_from_grounded_to_free_has_no_jump():
    for a in (0.0, 12.0):
        x = np.linspace(60.0, 106.0, 4001)
        rows = solved(x, a, 30.0, 100.0, 400.0, 1e6)
        change = np.flatnonzero((rows[:-1, 0] == State.GROUNDED) & (rows[1:, 0] == State.SUSPENDED))
        assert len(change) == 1
        i = change[0]
        # lifting off an anchor the slope is the same on both sides, lifting off the open bed it drops
        slopes = np.sort(rows[[i, i + 1], 9]) * (x[i + 1] - x[i])
        assert slopes[0] * (1 - 1e-3) <= rows[i + 1, 2] - rows[i, 2] <= slopes[1] * (1 + 1e-3)
        assert (slopes[1] / slopes[0] < 1.001) == (a == 0.0)


def test_derivatives_are_those_of_finite_differences():
    """Where a step does not change the state of the line, which few of four hundred are near enough for"""
    rng = np.random.default_rng(11)
    n = 400
    a, b = rng.uniform(0.5, 40, n), rng.uniform(0.5, 40, n)
    a[: n // 2] = 0.0  # with friction towards the end on the bed
    length, x = rng.uniform(50, 150, n), rng.uniform(5, 140, n)
    friction = np.where(rng.random(n) < 0.5, 0.0, 0.4)
    row, h = solved(x, a, b, length, 500.0, 1e6, friction), 1e-3
    scale = np.abs(row[:, 6:]).max(axis=1) + 1.0
    for k, step in enumerate(np.eye(3)):
        of = np.flatnonzero(a > 0) if k == 1 else np.arange(n)  # an end on the bed does not move up and down
        ends = [v + s * h * step[j] for s in (1, -1, 2, -2) for j, v in enumerate((x, a, b))]
        f = [solved(*ends[3 * i : 3 * i + 3], length, 500.0, 1e6, friction)[of] for i in range(4)]
        same = np.all([g[:, 0] == row[of, 0] for g in f], axis=0)
        assert same.mean() > 0.95
        difference = (8 * (f[0] - f[1]) - (f[2] - f[3])) / (12 * h)
        for i in range(4):
            wrong = np.abs(difference[:, 1 + i] - row[of, 6 + 3 * i + k]) / scale[of]
            assert wrong[same].max() < 1e-6


def test_without_friction_the_derivatives_are_those_of_an_energy():
    rng = np.random.default_rng(12)
    a, b, length, x = (
        rng.uniform(0.5, 40, 300),
        rng.uniform(0.5, 40, 300),
        rng.uniform(50, 150, 300),
        rng.uniform(5, 140, 300),
    )
    row = solved(x, a, b, length, 500.0, 1e6)
    k = row[:, [9, 10, 11, 12, 13, 14, 15, 16, 17]].reshape(-1, 3, 3)
    assert (np.abs(k - k.transpose(0, 2, 1)).max(axis=(1, 2)) / np.abs(k).max(axis=(1, 2))).max() < 1e-11


def test_a_line_lighter_than_water_is_the_mirror_image_of_a_heavy_one():
    heavy = solved(80.0, 10.0, 40.0, 100.0, 300.0, 1e6, bed=False)[0]
    light = solved(80.0, -10.0, -40.0, 100.0, -300.0, 1e6)[0]
    assert np.allclose(light[[1, 2]], heavy[[1, 2]]) and np.allclose(light[[3, 4]], -heavy[[3, 4]])
    turned = np.outer([1, 1, -1, -1], [1, -1, -1])  # horizontal pulls keep their sign, vertical ones and heights do not
    assert np.allclose(light[6:].reshape(4, 3), turned * heavy[6:].reshape(4, 3)) and np.abs(heavy[6:]).min() > 0


def test_an_end_below_the_bed_is_marked():
    assert solved(10.0, -0.1, 5.0, 20.0, 100.0, 1e6)[0, 0] == BELOW_BED


@pytest.mark.parametrize("span", [99.0, 101.0, 120.0])
def test_a_line_along_the_bed_is_slack_or_a_straight_spring(span):
    row = solved(span, 0.0, 0.0, 100.0, 300.0, 1e6)[0]
    assert row[2] == pytest.approx(max(span - 100.0, 0.0) / 100.0 * 1e6, rel=1e-10)
