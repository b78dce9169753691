"""Static lines of many parts against closed forms, the uniform line, their own derivatives and their energy."""

import csv
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from exact.static_line import faults

from hakobune.mooring.lines.catenary.solve import solve_lines, span_at_tension
from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine

PUBLISHED = Path(__file__).parents[2] / "published"


def published(name):
    with open(PUBLISHED / name, encoding="utf-8") as file:
        return [
            {key: float(value) for key, value in row.items()}
            for row in csv.DictReader(line for line in file if not line.startswith("#"))
        ]


def tank_bed(number, friction=0.0):
    """Bed 1 to 6 of the tank test, m."""
    rows = [row for row in published("seabed_profiles.csv") if row["profile"] == number]
    return Bed(np.array([[row["X_cm"], row["Z_cm"]] for row in rows]) / 100, friction)


def forces(line, x, z, state=None):
    found = line.solve(x, z, state)
    return np.array([found.horizontal_fairlead, found.vertical_fairlead])


def difference_stiffness(line, x, z, step):
    """Differences of the forces, Richardson-extrapolated: fourth order in the step."""

    def rough(h):
        right = forces(line, x + h, z) - forces(line, x - h, z)
        up = forces(line, x, z + h) - forces(line, x, z - h)
        return np.stack([right, up], axis=-1) / (2 * h)

    return (4 * rough(step / 2) - rough(step)) / 3


def test_one_segment_on_a_plane_is_the_uniform_line():
    """Two solvers with nothing in common but the equations: a root in one variable, and a system by Newton's method."""
    rng = np.random.default_rng(11)
    for _ in range(60):
        length, weight = 10 ** rng.uniform(0, 3, 2)
        stiffness = weight * length * 10 ** rng.uniform(0, 4)
        slope, friction = rng.choice([0.0, 0.1, -0.15]), rng.choice([0.0, 0.5, 1.0])
        x = length * rng.uniform(0.3, 0.95)
        z = max(0.0, x * np.tan(slope)) + length * rng.uniform(0.05, 0.3)
        uniform = solve_lines(x, z, length, weight, stiffness, friction, slope)
        line = StaticLine([Segment(length, weight, stiffness)], bed=Bed.sloping(slope, friction)).solve(x, z)
        assert not line.slides
        T = uniform.tension_fairlead
        assert abs(line.horizontal_fairlead - uniform.horizontal_fairlead) < 1e-9 * T
        assert abs(line.vertical_fairlead - uniform.vertical_fairlead) < 1e-9 * T
        assert np.abs(line.stiffness - uniform.stiffness).max() < 1e-7 * np.abs(uniform.stiffness).max()
        if not line.slack:
            assert abs(line.tension_anchor - uniform.tension_anchor) < 1e-9 * T
            assert abs(line.grounded_length - uniform.grounded_length) < 1e-9 * length


def test_a_line_that_slides_without_friction_weighs_down_to_the_hollow_and_to_the_bottom_of_its_bight():
    """Without friction T − w z is the same all along an inextensible line; T = 0 where it turns or lies in a heap."""
    hollow = StaticLine([Segment(70.0, 500.0), Segment(90.0, 500.0)], bed=Bed([[0, 0], [30, -8], [90, 12], [120, 15]]))
    found = hollow.solve(80.0, 40.0)
    assert not found.slides and not found.slack
    assert np.isclose(found.tension_fairlead, 500.0 * 48.0, rtol=1e-9)
    assert np.isclose(found.tension_anchor, 500.0 * 8.0, rtol=1e-9)
    bight = StaticLine([Segment(60.0, 500.0), Segment(58.0, 500.0)], bed=Bed([[0, 0], [50, 10], [90, 15]]))
    found = bight.solve(80.0, 40.0)
    lowest = found.profile(2001)[:, 2].min()
    assert not found.slides and lowest < -0.5
    assert np.isclose(found.tension_fairlead, 500.0 * (40.0 - lowest), rtol=1e-3)
    assert np.isclose(found.tension_fairlead - found.tension_anchor, 500.0 * 40.0, rtol=1e-9)


def test_a_line_that_slides_past_its_fairlead_pulls_both_its_ends_down_the_slope():
    """Friction takes w μ cos β from each of its legs; the profile is drawn from one end to the other."""
    parts = [Segment(60.0, 500.0), Segment(90.0, 500.0)]
    line = StaticLine(parts, bed=Bed.sloping(-0.2, 0.05))
    found = line.solve([40.0, 41.0, 130.0], 30.0)
    assert np.all(found.horizontal_fairlead[:2] < 0) and found.horizontal_fairlead[2] > 0
    found = line.solve(40.0, 30.0)
    assert not faults(found) and not found.slides
    s, x, z, T = found.profile(3001).T
    assert np.allclose([x[0], z[0], x[-1], z[-1]], [0.0, 0.0, 40.0, 30.0], atol=1e-6)
    turn = int(np.argmax(x))
    assert x[turn] > 60.0 and T[turn] < 50.0
    leg = s < s[turn]
    held = 500.0 * (np.sin(0.2) - 0.05 * np.cos(0.2))
    assert np.allclose(np.diff(T[leg]), -held * np.diff(s[leg]), rtol=1e-6)


HOLLOW, FALLING = [[0, 0], [30, -8], [90, 12], [120, 15]], [[0, 0], [150, -45], [200, -40]]


@pytest.mark.parametrize(
    ("bed", "x", "friction"), [(HOLLOW, 80.0, 0.0), (HOLLOW, 80.0, 0.15), (HOLLOW, 70.0, 0.05), (FALLING, 70.0, 0.1)]
)
def test_stiffness_of_a_line_that_slides_into_a_hollow_or_past_its_fairlead_is_the_derivative_of_its_forces(
    bed, x, friction
):
    segments = [Segment(70.0, 500.0, 1e6), Segment(80.0, 700.0, 2e6)]
    line = StaticLine(segments, [PointLoad(95.0, 2e3)], Bed(bed, friction))
    found = line.solve(x, 40.0)
    assert not found.slides and not found.slack and not faults(found)
    assert (found.horizontal_fairlead < 0) == (bed is FALLING)
    rough = difference_stiffness(line, x, 40.0, 0.02)
    assert np.abs(found.stiffness - rough).max() < 1e-6 * np.abs(rough).max()


def test_all_rows_of_the_slope_table_are_met_in_span_and_tension():
    """SR179 report (1982), table 3.1.6.1; the spans are rounded to 1 mm."""
    line = StaticLine([Segment(900.0, 8.06)], bed=Bed.sloping(np.radians(5)))
    rows = published("mooring_slope_line.csv")
    tension = np.array([row["H_tonf"] for row in rows]) * 1e3
    span, _ = span_at_tension(tension, 160.0, 900.0, 8.06, bed_slope=np.radians(5))
    assert np.abs(span - [row["X_closed_form_m"] for row in rows]).max() < 1e-3
    assert np.abs(line.solve(span, 160.0).horizontal_fairlead / tension - 1).max() < 1e-6


def test_line_just_lifting_has_the_tension_of_its_scope():
    for row in published("static_scope_targets.csv"):
        s = row["scope"]
        length, a = 10.0 * s, 5.0 * (s * s - 1)
        x = a * np.arccosh(1 + 10.0 / a)
        found = StaticLine([Segment(length, 3.0)]).solve(x, 10.0)
        assert abs(found.tension_fairlead / (3.0 * length) - (s * s + 1) / (2 * s)) < 1e-9
        assert abs(found.horizontal_fairlead / (3.0 * length) - (s * s - 1) / (2 * s)) < 1e-9
        assert abs(found.horizontal_fairlead / (3.0 * length) - row["H_over_wL"]) < 1e-6
        assert abs(x / np.sqrt(length**2 - 100) - row["X_over_Xmax"]) < 1e-6


@pytest.mark.parametrize("x", [60.0, 88.0, 96.0, 99.5])
def test_one_segment_and_two_hundred_equal_ones_agree(x):
    bed = Bed(((0.0, 0.0), (30.0, 4.0), (55.0, 1.0), (90.0, 2.0)), 0.4)
    whole = StaticLine([Segment(105.0, 12.0, 2e5)], bed=bed).solve(x, 25.0)
    parts = StaticLine([Segment(105.0 / 200, 12.0, 2e5)] * 200, bed=bed).solve(x, 25.0)
    T = whole.tension_fairlead
    assert abs(whole.horizontal_fairlead - parts.horizontal_fairlead) < 1e-10 * T
    assert abs(whole.vertical_fairlead - parts.vertical_fairlead) < 1e-10 * T
    assert np.abs(whole.stiffness - parts.stiffness).max() < 1e-8 * np.abs(whole.stiffness).max()
    assert abs(whole.grounded_length - parts.grounded_length) < 1e-9 * 105


MIXED = StaticLine(
    [Segment(40.0, 30.0, 4e5), Segment(35.0, 8.0, 1e5), Segment(30.0, 15.0, ((0, 0), (0.01, 500), (0.02, 2500)))],
    [PointLoad(50.0, 300.0), PointLoad(80.0, -200.0)],
    Bed(((0.0, 0.0), (30.0, 3.0), (60.0, 2.0)), 0.3),
    surface=34.0,
)


@pytest.mark.parametrize("number", [3, 5])
def test_stiffness_over_a_bed_of_the_tank_test_is_the_derivative_of_the_forces(number):
    bed = tank_bed(number, 0.5)
    x, z = 2.5, float(np.interp(2.5, *bed.points.T)) + 0.9
    length = 1.06 * np.hypot(x, z)
    line = StaticLine([Segment(length, 0.662, 500.0)], bed=bed)
    k = line.solve(x, z).stiffness
    assert np.abs(difference_stiffness(line, x, z, 1e-4) - k).max() < 1e-6 * np.abs(k).max()


@pytest.mark.parametrize("number", [2, 4])
def test_a_line_lies_on_or_above_the_bed_and_joins_its_ends(number):
    bed = tank_bed(number)
    x, z = 2.4, float(np.interp(2.4, *bed.points.T)) + 0.8
    for stretch in (1.01, 1.05, 1.12):
        line = StaticLine([Segment(stretch * np.hypot(x, z), 0.662, 1e3)], bed=bed)
        found = line.solve(x, z)
        _, px, pz, tension = found.profile(301).T
        assert bed.depth_below(px, pz).min() > -1e-9
        assert np.abs([px[-1] - x, pz[-1] - z]).max() < 1e-9
        assert np.isclose(tension[-1], found.tension_fairlead, rtol=1e-9)
        if not found.slack:
            assert np.abs([px[0], pz[0]]).max() < 1e-9


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5, 6])
def test_without_friction_the_stiffness_is_symmetric_over_any_bed(number):
    bed = tank_bed(number)
    x, z = 2.6, float(np.interp(2.6, *bed.points.T)) + 0.7
    k = StaticLine([Segment(1.05 * np.hypot(x, z), 0.662, 1e3)], bed=bed).solve(x, z).stiffness
    assert abs(k[0, 1] - k[1, 0]) < 1e-9 * np.abs(k).max()


def test_work_around_a_closed_path_is_nothing_without_friction():
    """Gauss quadrature along the sides of a rectangle; the forces have kinks in their curvature, hence 1e-5."""
    bed = tank_bed(4)
    line = StaticLine([Segment(2.9, 0.662, 300.0)], [PointLoad(1.9, 0.3)], bed)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    low, high = np.array([2.30, 1.0]), np.array([2.55, 1.2])
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    xs, zs = middle[0] + half[0] * nodes, middle[1] + half[1] * nodes
    sides = [
        half[0] * weights @ line.solve(xs, low[1]).horizontal_fairlead,
        half[1] * weights @ line.solve(high[0], zs).vertical_fairlead,
        -half[0] * weights @ line.solve(xs, high[1]).horizontal_fairlead,
        -half[1] * weights @ line.solve(low[0], zs).vertical_fairlead,
    ]
    assert abs(sum(sides)) < 1e-5 * np.abs(sides).sum()


def slid(state, s, flexibility):
    """Tension at s (m from the anchor), nan off the bed, and how far that point is stretched towards the fairlead."""
    p = state.pieces[::-1]
    tension = np.interp(s, np.append(p[:, 0], p[-1, 1]), np.append(p[:, 2], p[-1, 3]))
    stretch = np.concatenate([[0], np.cumsum(0.5 * (tension[1:] + tension[:-1]) * (s[1] - s[0]))]) * flexibility
    return np.where(s <= p[-1, 1], tension, np.nan), stretch


def lost_and_taken(steps):
    """∮ H dx of a cycle on a flat bed, and friction times sliding along the line, J."""
    EA, mu, w = 2e4, 0.6, 10.0
    line = StaticLine([Segment(130.0, w, EA)], bed=Bed.sloping(0.0, mu))
    there = np.linspace(118.0, 124.0, steps + 1)
    x = np.concatenate([there, there[::-1][1:], there[1:], there[::-1][1:]])
    visits = line.path(x, 25.0)[2 * steps :]
    H = np.array([v.horizontal_fairlead for v in visits])
    loop = np.sum(0.5 * (H[1:] + H[:-1]) * np.diff(x[2 * steps :]))
    s = np.linspace(0.0, 129.0, 24001)
    taken = 0.0
    for before, after in pairwise(visits):
        (T0, u0), (T1, u1) = slid(before.state, s, 1 / EA), slid(after.state, s, 1 / EA)
        grip = 0.5 * (np.gradient(T0, s) + np.gradient(T1, s))
        both = np.isfinite(grip)
        taken += np.sum((grip * (u1 - u0))[both]) * (s[1] - s[0])
    return loop, taken


def test_work_lost_in_a_cycle_tends_to_what_friction_takes():
    """First order: what lands or turns within a step slides within it, and both are as long as the step."""
    gaps = []
    for steps in (10, 20, 40, 80):
        loop, taken = lost_and_taken(steps)
        assert loop > 0
        gaps.append(loop / taken - 1)
    orders = np.log2(np.divide(gaps[:-1], gaps[1:]))
    assert np.all(np.abs(orders - 1) < 0.1), (gaps, orders)
    assert abs(2 * gaps[-1] - gaps[-2]) < 0.1 * abs(gaps[-1]), gaps


def test_hysteresis_of_the_report_runs_between_pulling_and_giving_way():
    """SR179 report (1982), figure 3.1.7.3: bed 6, friction 1.0; the way back carries less tension at the fairlead."""
    bed = tank_bed(6, 1.0)
    line = StaticLine([Segment(3.32, 0.662, 200.0)], bed=bed)
    there = np.linspace(2.95, 3.12, 18)
    visits = line.path(np.concatenate([there, there[::-1]]), 0.9)
    H = np.array([v.horizontal_fairlead for v in visits])
    up, down = H[:18], H[18:][::-1]
    assert np.all(np.diff(up) > 0)
    assert np.all(down <= up * (1 + 1e-9))
    assert np.max(1 - down / up) > 1e-3


def test_a_line_that_is_not_moved_keeps_its_forces():
    line = StaticLine([Segment(110.0, 10.0, 2e4)], bed=Bed(((0, 0), (40, 3), (80, 2)), 0.5))
    first = line.solve(98.0, 25.0)
    again = line.solve(98.0, 25.0, first.state)
    assert np.isclose(first.horizontal_fairlead, again.horizontal_fairlead, rtol=1e-10)
    assert np.isclose(first.tension_anchor, again.tension_anchor, rtol=1e-9)


def test_pulling_out_in_steps_ends_where_one_pull_does():
    """Friction has no clock: a way that never turns back leaves no trace of its steps."""
    line = StaticLine([Segment(110.0, 10.0, 2e4)], bed=Bed.sloping(0.05, 0.5))
    last = line.path(np.linspace(95.0, 104.0, 10), 25.0)[-1]
    once = line.solve(104.0, 25.0)
    assert np.isclose(last.horizontal_fairlead, once.horizontal_fairlead, rtol=1e-9)
    assert np.isclose(last.tension_anchor, once.tension_anchor, rtol=1e-9)


def test_a_buoy_goes_under_as_the_line_is_pulled():
    """In the surface on a loose line, under water on a tight one; its lift never exceeds its own."""
    line = StaticLine([Segment(120.0, 10.0, 1e6)], [PointLoad(85.0, -900.0)], surface=30.0)
    seen = []
    for x in (90.0, 104.0, 110.0, 114.0, 116.0):
        found = line.solve(x, 29.0)
        s, _, z, _ = found.profile(1201).T
        height = np.interp(85.0, s, z)
        jump = np.diff(_vertical(found, (85.0 - 1e-9, 85.0 + 1e-9)))[0]
        seen.append(found.loads[0])
        assert height < 30.0 + 1e-6 * line.length
        assert -900.0 - 1e-6 <= jump <= 1e-6
        if found.loads[0] == "floating":
            assert abs(height - 30.0) < 1e-6 * line.length
    assert seen[0] == "floating"
    assert seen[-1] == "submerged"


def _vertical(found, s):
    """V along the line from its weight alone, N."""
    p = found.pieces[found.pieces[:, 0] == 0]
    values = []
    for place in s:
        row = p[(p[:, 1] >= place) & (p[:, 1] - p[:, 2] <= place)][-1 if place < 85 else 0]
        values.append(row[6] - row[7] * (row[1] - place))
    return np.array(values)


def test_a_sinker_on_the_bed_is_felt_only_once_it_lifts():
    plain = StaticLine([Segment(110.0, 10.0, 1e6)])
    loaded = StaticLine([Segment(110.0, 10.0, 1e6)], [PointLoad(60.0, 500.0)])
    lying = plain.solve(92.0, 25.0)
    assert lying.grounded_length > 60.0
    assert np.isclose(loaded.solve(92.0, 25.0).horizontal_fairlead, lying.horizontal_fairlead, rtol=1e-10)
    assert loaded.solve(103.0, 25.0).tension_fairlead > plain.solve(103.0, 25.0).tension_fairlead


def test_orderings_of_the_design_charts():
    """SR179 report (1982), section 3.1.7: friction, scope, slope, a sinker, a buoy, elasticity."""
    w, z = 10.0, 20.0

    def tension(x_share, scope=6.0, bed=None, loads=(), stiffness=np.inf):
        length = scope * z
        line = StaticLine([Segment(length, w, stiffness)], loads, bed or Bed.sloping())
        return line.solve(x_share * np.sqrt(length**2 - z * z), z)

    smooth, rough = tension(0.97), tension(0.97, bed=Bed.sloping(0.0, 0.8))
    assert rough.tension_anchor < smooth.tension_anchor
    assert np.isclose(rough.tension_fairlead, smooth.tension_fairlead, rtol=1e-9)
    gentle = [tension(0.985, bed=Bed.sloping(slope)).tension_fairlead for slope in (-0.05, -0.02, 0.0, 0.02, 0.05)]
    assert np.all(np.diff(gentle) != 0)
    assert tension(0.985, loads=[PointLoad(80.0, 300.0)]).tension_fairlead > smooth.tension_fairlead
    assert tension(0.97, loads=[PointLoad(100.0, -60.0)]).tension_fairlead < smooth.tension_fairlead
    assert tension(0.995, stiffness=2e4).tension_fairlead < tension(0.995).tension_fairlead


def test_table_of_strain_and_tension_with_one_slope_is_a_number():
    number = StaticLine([Segment(100.0, 10.0, 1e5)]).solve(97.0, 20.0)
    table = StaticLine([Segment(100.0, 10.0, ((0, 0), (0.001, 100.0), (0.03, 3000.0)))]).solve(97.0, 20.0)
    assert np.isclose(number.horizontal_fairlead, table.horizontal_fairlead, rtol=1e-12)
    assert np.allclose(number.stiffness, table.stiffness, rtol=1e-9)


def test_uplift_at_the_anchor_is_measured_from_the_bed():
    line = StaticLine([Segment(100.0, 10.0, 1e6)], bed=Bed.sloping(0.1), uplift_limit=0.05)
    assert line.solve(80.0, 30.0).anchor_uplift == 0
    found = line.solve(95.0, 35.0)
    assert np.isclose(found.anchor_uplift, np.arctan2(found.vertical_anchor, found.horizontal_anchor) - 0.1)
    assert line.solve(80.0, 30.0).anchor_holds
    assert not found.anchor_holds


def test_a_section_of_a_plane_grid_is_a_plane():
    x, y = np.linspace(0, 100, 6), np.linspace(-50, 50, 5)
    z = 0.1 * x[:, None] + 0.05 * y[None, :] - 30
    bed = Bed.under(x, y, z, (5.0, 0.0), (85.0, 30.0))
    way = np.array([80.0, 30.0]) / np.hypot(80, 30)
    assert np.allclose(bed.points[:, 1], bed.points[:, 0] * (0.1 * way[0] + 0.05 * way[1]))
    assert len(bed.points) > 5
    with pytest.raises(ValueError, match=r"fairlead at .* outside the bed grid"):
        Bed.under(x, y, z, (5.0, 0.0), (185.0, 30.0))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Segment(-1.0, 2.0), "length is -1 m"),
        (lambda: Segment(1.0, 0.0), "weight is 0 N/m"),
        (lambda: Segment(1.0, 2.0, ((0, 0), (0.1, -5))), "is not a table of"),
        (lambda: StaticLine([]), "at least one segment"),
        (lambda: StaticLine([Segment(10.0, 1.0)], [PointLoad(12.0, 5.0)]), "position is 12 m"),
        (lambda: Bed(((0, 0), (0, 1))), "without vertical walls"),
        (lambda: Bed.sloping(0.1, -1), "friction is -1"),
        (lambda: StaticLine([Segment(10.0, 1.0)]).solve(-1.0, 2.0), "x is -1 m"),
        (lambda: StaticLine([Segment(10.0, 1.0)]).solve(5.0, -2.0), "2 m below the bed"),
        (lambda: StaticLine([Segment(10.0, 1.0)]).solve([5.0, 6.0], 2.0).profile(), "one position"),
    ],
)
def test_impossible_input_is_refused_by_name(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_inextensible_line_out_of_reach_is_an_error():
    with pytest.raises(LineError, match="x = 100 m, z = 5 m cannot be reached"):
        StaticLine([Segment(50.0, 1.0), Segment(40.0, 2.0)]).solve(100.0, 5.0)
