"""Static lines against closed forms, published cases and their own derivatives."""

import csv
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.flat_bed import asinh_ratio_less_one
from hakobune.mooring.lines.catenary.free_piece import asinh_excess
from hakobune.mooring.lines.catenary.solve import profile, solve_lines, span_at_tension
from hakobune.mooring.lines.catenary.state import LineError, State

PUBLISHED = Path(__file__).parents[2] / "published"
KGF = 9.80665


def published(name):
    with open(PUBLISHED / name, encoding="utf-8") as file:
        return [
            {key: float(value) for key, value in row.items()}
            for row in csv.DictReader(line for line in file if not line.startswith("#"))
        ]


def random_lines(n, seed):
    """Lines over six decades of length, weight and stiffness, from slack to stretched by a fifth."""
    rng = np.random.default_rng(seed)
    length, weight = 10 ** rng.uniform(-1, 5, n), 10 ** rng.uniform(-1, 5, n)
    stiffness = weight * length * 10 ** rng.uniform(-1, 5, n)
    stiffness[::7] = np.inf
    reach = length * np.where(np.isinf(stiffness), rng.uniform(0, 1, n), rng.uniform(0, 1.2, n))
    angle = rng.uniform(0, np.pi / 2, n)
    friction = rng.choice([0.0, 0.3, 1.0], n)
    return reach * np.cos(angle), reach * np.sin(angle), length, weight, stiffness, friction


def integrated(line, length, weight, stiffness, friction):
    """Fairlead position by Gauss quadrature of cos φ (1 + T/EA) along the line, from its forces alone."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    free = length - line.grounded_length
    s = 0.5 * free * (1 + nodes)
    V = line.vertical_fairlead - weight * (free - s)
    T = np.hypot(line.horizontal_fairlead, V)
    stretch = 1 / T + 1 / stiffness
    x = 0.5 * free * np.sum(weights * line.horizontal_fairlead * stretch)
    z = 0.5 * free * np.sum(weights * V * stretch)
    lying = 0.5 * line.grounded_length * (1 + nodes)
    on_bed = np.maximum(line.horizontal_fairlead - friction * weight * lying, 0.0)
    return x + 0.5 * line.grounded_length * np.sum(weights * (1 + on_bed / stiffness)), z


def test_line_on_a_slope_has_the_published_span_where_its_anchor_is_lifted():
    for row in (r for r in published("mooring_slope_line.csv") if r["H_tonf"] >= 40):
        span, lying = span_at_tension(row["H_tonf"] * 1e3, 160.0, 900.0, 8.06, bed_slope=np.radians(5))
        assert lying == 0
        assert abs(span - row["X_catenary_m"]) < 1e-3


def test_line_on_a_slope_follows_the_closed_form_in_every_row():
    rows = published("mooring_slope_line.csv")
    tension = np.array([r["H_tonf"] for r in rows]) * 1e3
    span, _ = span_at_tension(tension, 160.0, 900.0, 8.06, bed_slope=np.radians(5))
    assert np.abs(span - [r["X_closed_form_m"] for r in rows]).max() < 1e-3


def test_solving_for_the_span_of_a_tension_gives_that_tension():
    tension = np.geomspace(1e3, 1.5e5, 30)
    for slope, stiffness, friction in ((0, np.inf, 0), (0.09, 1e7, 0.5), (-0.05, 1e6, 0.0), (0, 1e6, 1.0)):
        span, lying = span_at_tension(tension, 160.0, 900.0, 8.06, stiffness, friction, slope)
        line = solve_lines(span, 160.0, 900.0, 8.06, stiffness, friction, slope)
        # the span of an inextensible line fixes its tension to rounding over the stiffness
        assert np.abs(line.horizontal_fairlead / tension - 1).max() < 1e-9
        assert np.allclose(line.grounded_length, lying, atol=1e-6)


def test_model_chains_have_the_published_pretensions():
    """SR179 report, appendix 1, table 1.2: 2.55 and 3.03 kgf at the fairlead."""
    line = solve_lines(7.100, 1.200, [7.530, 7.482], 0.871)
    assert np.abs(line.tension_fairlead - [2.55, 3.03]).max() < 0.01


def test_deep_hanging_line_has_the_forces_other_programs_agree_on():
    line = solve_lines(800.0, 100.0, 1000.0, 1962.0, 64e9, bed=False)
    assert abs(line.horizontal_fairlead - 671_447) < 0.5
    assert abs(line.vertical_fairlead - 1_100_067) < 0.5


def test_riser_of_low_and_langley_has_its_end_tensions():
    """Low & Langley (2006): L 170 m, span 100 m by 50 m, EA 5e8 N, 165 kg/m, 0.396 m, 1000 kg/m³."""
    weight = (165 - 1000 * np.pi / 4 * 0.396**2) * 9.807
    line = solve_lines(100.0, 50.0, 170.0, weight, 5e8, bed=False)
    assert abs(line.tension_fairlead / 1e3 - 47.1395) < 1e-4
    assert abs(line.tension_anchor / 1e3 - 26.6263) < 1e-4


def test_line_just_lifting_has_the_tension_of_its_scope():
    scope, height = np.array([2, 3.26, 4, 6, 8, 10]), 10.0
    length = scope * height
    a = (length**2 - height**2) / (2 * height)
    line = solve_lines(a * np.arccosh(1 + height / a), height, length, 3.0)
    load = 3.0 * length
    assert np.allclose(line.tension_fairlead / load, (scope**2 + 1) / (2 * scope), rtol=1e-10)
    assert np.allclose(line.horizontal_fairlead / load, (scope**2 - 1) / (2 * scope), rtol=1e-10)


def test_chain_lengths_of_the_report_lift_at_the_allowable_tension():
    for row in published("mooring_chain_lengths.csv"):
        depth, weight, allowable = row["depth_m"], 406.0, 680e3
        a = (allowable - weight * depth) / weight
        needed = np.sqrt(depth**2 + 2 * a * depth)
        assert needed - 0.5 <= row["chain_m"] < needed + 15
        _, lying = span_at_tension(weight * a, depth, 1.1 * needed, weight)
        assert abs(lying - 0.1 * needed) < 1e-9 * needed


@pytest.mark.parametrize("bed", [True, False])
def test_no_random_line_is_left_unsolved(bed):
    """solve_lines itself raises if a fairlead is missed by more than 1e-10 of the length."""
    x, z, length, weight, stiffness, friction = random_lines(20_000, 1)
    line = solve_lines(x, z, length, weight, stiffness, friction, bed=bed)
    assert np.all(line.status != State.BEYOND_REACH)
    assert np.all(np.isfinite(line.stiffness))
    assert np.all(line.horizontal_fairlead >= 0)
    if bed:
        assert set(np.unique(line.status)) == {State.SLACK, State.GROUNDED, State.SUSPENDED}
        assert np.all(line.vertical_anchor >= -1e-9 * weight * length)


def test_no_random_line_on_a_slope_is_left_unsolved():
    x, z, length, weight, stiffness, friction = random_lines(5_000, 2)
    slope = np.random.default_rng(3).uniform(-0.3, 0.3, len(x))
    z = np.maximum(z, x * np.tan(slope) + 0.01 * length)
    reach = np.hypot(x, z) < length
    chosen = reach | np.isfinite(stiffness)
    values = [v[chosen] for v in (x, z, length, weight, stiffness, friction, slope)]
    line = solve_lines(*values)
    assert np.all(np.isfinite(line.tension_fairlead))


def test_forces_integrate_back_to_the_fairlead():
    """An independent quadrature of the equations of the line; smooth cases, where 60 nodes give all digits."""
    for x, z, length, weight, stiffness, friction in (
        (84, 20, 100, 10.0, 1e4, 0.0),
        (95, 20, 100, 10.0, 1e5, 0.4),
        (90, 50, 100, 10.0, 1e3, 0.0),
        (104, 20, 100, 10.0, 2e4, 0.0),
    ):
        line = solve_lines(x, z, length, weight, stiffness, friction)
        found = integrated(line, length, weight, stiffness, friction)
        assert np.allclose(found, (x, z), rtol=0, atol=1e-9 * length)


@pytest.mark.parametrize(("bed", "tilt"), [(True, 0.0), (False, 0.0), (True, 0.2)])
def test_stiffness_is_the_derivative_of_the_forces(bed, tilt):
    rng = np.random.default_rng(5)
    n = 1500
    length, weight = 10 ** rng.uniform(0, 4, n), 10 ** rng.uniform(0, 4, n)
    stiffness = weight * length * 10 ** rng.uniform(0, 3, n)
    x, z = length * rng.uniform(0.05, 0.95, n), length * rng.uniform(0.25, 0.5, n)
    friction, slope = rng.choice([0.0, 0.5], n), rng.uniform(-tilt, tilt, n)

    def forces(dx, dz):
        line = solve_lines(x + dx, z + dz, length, weight, stiffness, friction, slope, bed=bed)
        return np.stack([line.horizontal_fairlead, line.vertical_fairlead], axis=-1), line

    def differences(h):
        h = h * length
        right, up = forces(h, 0)[0] - forces(-h, 0)[0], forces(0, h)[0] - forces(0, -h)[0]
        return np.stack([right, up], axis=-1) / (2 * h)[:, None, None]

    _, line = forces(0, 0)
    # Richardson: the error of the pair is of fourth order in the step; lines that change state inside it are left out
    states = [
        forces(*(sign * 2e-4 * length * np.array(way)[:, None]))[1].status
        for sign in (1, -1)
        for way in ((1, 0), (0, 1))
    ]
    steady = np.all(np.array(states) == line.status, axis=0)
    fine = (4 * differences(1e-4) - differences(2e-4)) / 3
    error = np.abs(fine - line.stiffness).max(axis=(1, 2)) / np.abs(line.stiffness).max(axis=(1, 2))
    # the step has to be small beside the distance to the taut limit and to the slack one, where ∂²H/∂x² is singular
    taut = np.hypot(x, z) > 0.97 * length
    loose = (line.horizontal_fairlead < 1e-3 * weight * length) & (line.status != State.SLACK)
    # where friction has just been used up the second derivative jumps
    end = line.horizontal_anchor / np.where(line.horizontal_fairlead > 0, line.horizontal_fairlead, 1.0)
    kink = (friction > 0) & (end > 0) & (end < 1e-2)
    usable = steady & ~taut & ~loose & ~kink
    assert usable.sum() > 0.7 * n
    assert error[usable].max() < 1e-6


def test_stiffness_without_friction_is_symmetric_and_positive():
    x, z, length, weight, stiffness, _ = random_lines(3000, 7)
    line = solve_lines(x, z, length, weight, stiffness)
    k = line.stiffness
    size = np.abs(k).max(axis=(1, 2))
    assert np.all(np.abs(k[:, 0, 1] - k[:, 1, 0]) <= 1e-8 * size)
    assert np.all(np.linalg.det(k / size[:, None, None]) > -1e-12)


def test_stiff_line_approaches_the_inextensible_one_at_first_order():
    exact = solve_lines(240.0, 20.0, 250.0, 4e3).horizontal_fairlead
    error = [abs(solve_lines(240.0, 20.0, 250.0, 4e3, EA).horizontal_fairlead / exact - 1) for EA in (1e10, 1e11, 1e12)]
    assert np.all(np.abs(np.log10(np.divide(error[:-1], error[1:])) - 1) < 0.02)


def test_weightless_limit_is_a_straight_spring():
    x, z, length, stiffness = 80.0, 70.0, 100.0, 1e6
    pull = stiffness * (np.hypot(x, z) / length - 1)
    for weight in (1e-2, 1e-3):
        line = solve_lines(x, z, length, weight, stiffness)
        # the mean tension of a taut line departs from the spring's by half its weight at first order
        assert abs(line.tension_fairlead - pull) < weight * length


def test_line_above_its_anchor_has_no_horizontal_force():
    slack = solve_lines(0.0, 20.0, 30.0, 100.0, 1e6)
    assert slack.horizontal_fairlead == 0
    assert slack.grounded_length > 0
    hung = solve_lines(0.0, 20.0, 10.0, 100.0, 1e4)
    assert hung.horizontal_fairlead == 0
    # a plumb line of weight w stretches by VL/EA − wL²/2EA under the pull V at its top
    assert np.isclose(20.0, 10.0 + (hung.vertical_fairlead * 10 - 100 * 10**2 / 2) / 1e4, rtol=1e-12)


def test_friction_lowers_only_the_anchor_tension_of_an_inextensible_line():
    smooth, rough = (solve_lines(85.0, 20.0, 100.0, 50.0, bed_friction=mu) for mu in (0.0, 0.5))
    assert rough.horizontal_fairlead == smooth.horizontal_fairlead
    expected = max(0.0, smooth.horizontal_fairlead - 0.5 * 50.0 * smooth.grounded_length)
    assert np.isclose(rough.horizontal_anchor, expected)


def test_fairlead_over_deeper_water_is_held_more_softly():
    """SR179 report, section 3.1.7.3: the more negative the slope, the gentler the rise of tension."""
    tension = np.array([2e5, 4e5])
    rise = []
    for slope in (-0.05, 0.0, 0.05):
        span, _ = span_at_tension(tension, 60.0 + 300 * slope, 360.0, 1e3, bed_slope=slope)
        rise.append((tension[1] - tension[0]) / (span[1] - span[0]))
    assert rise[0] < rise[1] < rise[2]


def test_profile_ends_at_the_anchor_and_the_fairlead():
    for x, z, length, options in (
        (80.0, 20.0, 95.0, {"bed_friction": 1.0, "axial_stiffness": 1e4}),
        (10.0, 20.0, 95.0, {}),
        (85.0, 30.0, 95.0, {"bed_slope": 0.1, "axial_stiffness": 1e5}),
        (60.0, -10.0, 95.0, {"bed": False}),
    ):
        points = profile(x, z, length, 10.0, **options)
        assert np.allclose(points[[0, -1]], [[0, 0], [x, z]], atol=1e-9 * length)


def test_inextensible_line_out_of_reach_is_an_error_or_marked():
    with pytest.raises(LineError, match=r"x = 100 m.*length 90"):
        solve_lines(100.0, 10.0, 90.0, 10.0)
    line = solve_lines([100.0, 50.0], 10.0, 90.0, 10.0, beyond_reach="mark")
    assert list(line.status) == [State.BEYOND_REACH, State.SLACK]
    assert np.isinf(line.tension_fairlead[0])
    assert np.isfinite(line.tension_fairlead[1])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": -1.0}, "x is -1"),
        ({"z": np.nan}, "z is nan"),
        ({"z": -1.0}, "above the bed"),
        ({"length": 0.0}, "length is 0"),
        ({"weight": -2.0}, "weight is -2"),
        ({"axial_stiffness": 0.0}, "axial_stiffness is 0"),
        ({"bed_friction": -0.1}, "bed_friction is -0.1"),
    ],
)
def test_impossible_line_is_refused_by_name(change, message):
    good = dict(x=80.0, z=20.0, length=100.0, weight=10.0)
    with pytest.raises(ValueError, match=message):
        solve_lines(**{**good, **change})


def test_asinh_excess_follows_its_series_on_both_sides_of_the_switch():
    s = [1e-8, 1e-4, 0.0999, 0.1001, 3.0, 1e9]

    def series(value, terms=40):
        total, a = 0.0, 1.0
        for n in range(1, terms):
            a *= (2 * n - 1) / (2 * n)
            total += (-1) ** (n + 1) * a * 2 * n / (2 * n + 1) * float(Fraction(value)) ** (2 * n + 1)
        return total

    assert np.allclose([asinh_excess(v) for v in s[:4]], [series(v) for v in s[:4]], rtol=1e-12, atol=0)
    assert np.isclose(asinh_excess(s[4]), np.arcsinh(3.0) - 3 / np.sqrt(10), rtol=1e-15)
    assert np.isclose(asinh_excess(s[5]), np.log(2e9) - 1, rtol=1e-12)


@pytest.mark.parametrize("u", [1e-6, 0.01, 0.05, 0.0999, 0.1001, 2.0])
def test_series_of_short_pieces_are_their_integrals_to_the_last_digits(u):
    """asinh u − u/√(1+u²) = ∫ t²/(1+t²)^{3/2} dt and asinh u − u = −∫ t²/(√(1+t²)(1+√(1+t²))) dt, by Gauss's rule on
    positive integrands, which loses nothing: the last coefficient of either series counts 1e-12 at u = 0.1."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    t, w = 0.5 * u * (1 + nodes), 0.5 * u * weights
    root = np.sqrt(1 + t * t)
    digits = 2e-14 if u < 0.1 else 2e-13  # beyond, the difference itself loses that
    assert asinh_excess(u) == pytest.approx(w @ (t**2 / root**3), rel=digits, abs=0)
    assert asinh_ratio_less_one(u) == pytest.approx(-w @ (t**2 / (root * (1 + root))) / u, rel=1e-13, abs=0)


def slopes_that_do_not_hold(count, seed):
    """Lines (x, z, length, weight, EA, friction, slope) on beds that rise or fall more steeply than friction holds."""
    rng = np.random.default_rng(seed)
    slope = rng.uniform(0.05, 0.5, count) * rng.choice([-1, 1], count)
    length, weight = 10 ** rng.uniform(0, 3, count), 10 ** rng.uniform(0, 4, count)
    friction = rng.choice([0.0, 0.5, 0.9], count) * np.tan(np.abs(slope))
    x = length * rng.uniform(0.1, 0.9, count)
    z = x * np.tan(slope) + length * rng.uniform(0.01, 0.4, count)
    return np.column_stack([x, z, length, weight, weight * length * 10 ** rng.uniform(0, 4, count), friction, slope])


def test_on_a_slope_without_friction_tensions_differ_by_weight_times_height():
    """A line that slides is held by its anchor: nothing on the way takes up what it weighs."""
    lines = slopes_that_do_not_hold(400, 3)
    lines[:, 4], lines[:, 5] = np.inf, 0.0
    lines = lines[np.hypot(lines[:, 0], lines[:, 1]) < 0.98 * lines[:, 2]]
    found = solve_lines(*lines.T)
    assert np.any(found.horizontal_fairlead < 0)
    assert np.any(found.horizontal_anchor < 0)
    expected = lines[:, 3] * lines[:, 1]
    wrong = np.abs(found.tension_fairlead - found.tension_anchor - expected)
    assert np.max(wrong / (lines[:, 3] * lines[:, 2])) < 1e-9
    one = solve_lines(100, 40, 118, 1000, np.inf, 0, np.radians(10))
    assert np.isclose(one.tension_fairlead - one.tension_anchor, 40e3, rtol=1e-12)


def test_stiffness_of_a_line_that_slides_is_the_derivative_of_its_forces():
    for x, z, length, *rest in slopes_that_do_not_hold(60, 4):
        step = 1e-4 * length
        ends = np.array([[x + step, z], [x - step, z], [x, z + step], [x, z - step], [x, z]]).T
        found = solve_lines(*ends, length, *rest)
        if np.ptp(np.sign(found.horizontal_anchor)) > 0 or np.ptp(np.sign(found.horizontal_fairlead)) > 0:
            continue  # between two of the states the stiffness jumps
        F = np.stack([found.horizontal_fairlead, found.vertical_fairlead])
        differences = np.column_stack([F[:, 0] - F[:, 1], F[:, 2] - F[:, 3]]) / (2 * step)
        assert np.abs(differences - found.stiffness[4]).max() < 1e-3 * np.abs(found.stiffness[4]).max()


def test_a_line_that_slides_joins_its_ends_on_or_above_the_bed():
    for given in slopes_that_do_not_hold(40, 5):
        x, z, length, slope = given[0], given[1], given[2], given[6]
        points = profile(*given, points=4001)
        assert np.abs(points[[0, -1]] - [[0, 0], [x, z]]).max() < 1e-9 * length
        assert np.min(points[:, 1] - points[:, 0] * np.tan(slope)) > -1e-9 * length
        assert np.hypot(*np.diff(points, axis=0).T).sum() > (1 - 1e-3) * length
