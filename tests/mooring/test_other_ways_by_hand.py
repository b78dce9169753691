"""Other ways of data through moorings: lines from either end, lost lines, currents on several hulls, no hours."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria import strength
from hakobune.mooring.criteria.anchors import Anchor as Holding
from hakobune.mooring.criteria.anchors import Chart
from hakobune.mooring.dolphins import linearised
from hakobune.mooring.downtime import every_hour
from hakobune.mooring.downtime.interpolant import Interpolant
from hakobune.mooring.environment import logger_files
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import EquilibriumError
from hakobune.mooring.lines.system.hawser import Hawser
from hakobune.mooring.lines.system.parts import (
    Anchor,
    CompositeLine,
    Fairlead,
    FreePoint,
    LineType,
    UniformLine,
)
from hakobune.mooring.loads.box_current import box_table
from hakobune.mooring.motion import line_loads, statistics
from hakobune.mooring.motion.moving_lines import prepare
from hakobune.mooring.motion.simulation import run
from hakobune.mooring.response import bound_wave_drift, sea_state
from hakobune.mooring.seas import buoys
from hakobune.mooring.studies import long_period, system_at_rest

KIND = LineType("chain", 780.0, 5e8, 90.0, 0.1, 5e6)

# ------------------------------------------------------------------ lines in runs

POINTS = {"bed": Anchor("bed", (0.0, 0.0, -50.0)), "bow": Fairlead("bow", "ship", (50.0, 0.0, 0.0)),
          "stern": Fairlead("stern", "ship", (-50.0, 0.0, 0.0)),
          "quarter": Fairlead("quarter", "barge", (0.0, 0.0, 0.0)),
          "joint": FreePoint("joint", (1.0, 2.0, -3.0))}  # fmt: skip
ROPE = object.__new__(Hawser)
for name, value in (("name", "one"), ("a", "stern"), ("b", "quarter")):
    object.__setattr__(ROPE, name, value)


@pytest.mark.parametrize("a, b, kind, ends", [
    ("bed", "bow", UniformLine, ("bed", "bow")), ("bow", "bed", UniformLine, ("bed", "bow")),
    ("stern", "quarter", Hawser, ("stern", "quarter")),
])  # fmt: skip
def test_a_line_in_a_run_goes_from_its_anchor_to_the_body_whichever_end_is_first(a, b, kind, ends):
    line = UniformLine("one", KIND, 70.0, a, b) if kind is UniformLine else ROPE
    assert tuple(point.name for point in line_loads.ends_in_time(line, POINTS)) == ends


@pytest.mark.parametrize("a, b, says", [
    ("bed", "joint", "line one runs from bed to joint; allowed: from an anchor to the body"),
    ("joint", "bow", "line one runs from joint to bow; allowed: from an"),
    ("joint", "bed", "runs from joint to bed"),
    ("bow", "stern", "line one runs from ship to itself"), ("bow", "quarter", "line one hangs between ship and barge"),
])  # fmt: skip
def test_lines_that_a_run_cannot_follow_are_refused(a, b, says):
    with pytest.raises(ValueError, match=says):
        line_loads.ends_in_time(UniformLine("one", KIND, 70.0, a, b), POINTS)


SYSTEM = SimpleNamespace(depth=50.0, density=1000.0, gravity=10.0, points=tuple(POINTS.values()))
BED = SimpleNamespace(friction=0.6, points=((0.0, 0.0), (50.0, 5.0)))


def composite(a="bed", b="bow", **more):
    parts = (Segment(40.0, 780.0, 5e8, kind=KIND, elements=7), Segment(60.0, 780.0, 2e8, kind=KIND))
    given = {"loads": (PointLoad(40.0, 2e3, 2.3e3, "clump", 1.5, 0.7),), "bed_friction": 0.4}
    return CompositeLine("two", parts, a, b, **given | more)


@pytest.mark.parametrize("a, b", [("bed", "bow"), ("bow", "bed")])
def test_a_line_of_segments_begins_at_its_anchor_whichever_end_is_first(a, b):
    """40 m with 7 elements and 60 m with its share of 50, 30; a clump between them of 2.3 kN in air"""
    line = composite(a, b)
    made = prepare.dynamic_line(line, (0.0, 0.0, -50.0), SYSTEM, 50, True, 0.3)
    order = [(40.0, 7), (60.0, 30)] if a == "bed" else [(60.0, 30), (40.0, 7)]
    assert [(one.length, one.elements) for one in made.segments] == order
    assert [one.stiffness for one in made.segments] == ([5e8, 2e8] if a == "bed" else [2e8, 5e8])
    (body,) = made.bodies
    assert (body.mass, body.drag_area, body.added_mass) == (230.0, 1.5, 0.7) and body.volume == pytest.approx(0.03)
    assert (made.bed.below, made.bed.friction, made.surface) == (0.0, 0.4, True)
    assert (made.density, made.gravity, made.anchor) == (1000.0, 10.0, (0.0, 0.0, -50.0))


def test_a_line_of_segments_may_lie_on_a_bed_of_its_own():
    line = composite()
    object.__setattr__(line, "bed", BED)
    made = prepare.dynamic_line(line, (0.0, 0.0, -50.0), SYSTEM, 50, False, 0.3)
    assert made.bed.uphill == 0.3 and made.bed.friction == 0.6 and made.bed.points == ((0.0, 0.0), (50.0, 5.0))
    assert (made.bed.stiffness, made.bed.damping) == (3e6, 3e5) and made.surface is False


@pytest.mark.parametrize("line, says", [
    (composite(loads=(PointLoad(39.0, 2e3),)),
     "sinkers or buoys within a segment or two at one joint; allowed: one at each joint of two segments"),
    (composite(loads=(PointLoad(40.0, 2e3), PointLoad(40.0, 1e3))),
     "sinkers or buoys within a segment or two at one joint; allowed: one at each joint of two"),
    (CompositeLine("two", (Segment(40.0, 780.0, 5e8, kind=None),), "bed", "bow"), "has no mass"),
])  # fmt: skip
def test_lines_of_segments_without_a_mass_or_with_loads_within_a_segment_do_not_move(line, says):
    with pytest.raises(ValueError, match=says):
        prepare.dynamic_line(line, (0.0, 0.0, -50.0), SYSTEM, 50, True, 0.3)


@pytest.mark.parametrize("on_hull, current, wanted", [
    (None, None, None), (None, SimpleNamespace(speed=2.0, direction=math.pi / 6), (math.sqrt(3), 1.0)),
    (SimpleNamespace(water=SimpleNamespace(velocity=(0.3, 0.4))), "another", (0.3, 0.4)),
])  # fmt: skip
def test_the_current_at_lines_is_that_of_the_study_or_of_the_file_of_the_hull(on_hull, current, wanted):
    found = run._current_at_lines(SimpleNamespace(on_hull=on_hull, current=current))
    assert found is None if wanted is None else found == pytest.approx(wanted)


def test_what_is_left_after_the_loss_of_each_line_begins_where_all_held(monkeypatch):
    """Free points that hang on a lost line alone are gone; a system without equilibrium tells its fault"""
    asked, ticks = [], []

    def without(name):
        kept = [SimpleNamespace(name=point) for point in ("p", "q") if point != f"of {name}" and not (
            name == "b" and point == "p")]  # fmt: skip
        return SimpleNamespace(name=name, free_points=kept)

    def rest(left, pose):
        asked.append((left.name, pose.free.tolist()))
        if left.name == "c":
            raise EquilibriumError("it drifts away")
        return f"rest without {left.name}"

    monkeypatch.setattr(system_at_rest, "rest", rest)
    pose = SimpleNamespace(free=np.array([[1.0, 2, 3], [4, 5, 6]]), _replace=lambda free: SimpleNamespace(free=free))
    system = SimpleNamespace(line_names=("a", "b", "c"), without=without,
                             free_points=[SimpleNamespace(name="p"), SimpleNamespace(name="q")])  # fmt: skip
    found = system_at_rest.one_line_broken(SimpleNamespace(system=system, pose=pose), lambda: ticks.append(1))
    assert found["a"] == "rest without a" and found["b"] == "rest without b" and len(ticks) == 3
    assert isinstance(found["c"], EquilibriumError)
    assert asked == [("a", [[1, 2, 3], [4, 5, 6]]), ("b", [[4, 5, 6]]), ("c", [[1, 2, 3], [4, 5, 6]])]


# ------------------------------------------------------------------ responses, studies


@dataclass
class Stream:
    speed: float
    direction: float


@pytest.mark.parametrize("current", [None, Stream(1.0, 0.5)])
def test_the_drag_of_each_hull_is_in_the_current_from_its_own_heading(current, monkeypatch):
    """Three motions of each of two hulls, the second headed to 0.2 rad"""
    told = []

    def drag_of(current, box, db):
        told.append((current and current.direction, box, db.density, db.water_depth))
        return lambda mode, sigma: 100 * len(told) + 10 * mode + sigma

    monkeypatch.setattr(
        long_period, "with_coefficients", lambda conditions, box, depth: SimpleNamespace(current=current)
    )
    monkeypatch.setattr(long_period, "_drag_of", drag_of)
    hulls = [
        SimpleNamespace(box="a", density=1000.0, heading=0.0),
        SimpleNamespace(box="b", density=1025.0, heading=0.2),
    ]
    found = long_period.drag_of_each(None, hulls, 20.0)(np.array([1.0, 2, 3, 4, 5, 6]))
    ways = (None, None) if current is None else (0.5, pytest.approx(0.3))
    assert told == [(ways[0], "a", 1000.0, 20.0), (ways[1], "b", 1025.0, 20.0)]
    assert found.tolist() == [201, 212, 223, 204, 215, 226]


@pytest.mark.parametrize("spread", [False, True])
def test_bound_waves_add_their_spectrum_of_long_crests_or_of_all_directions(spread, monkeypatch):
    body = SimpleNamespace(bodies=(), carrier=None)
    value = np.ones((2, 1, 3))
    monkeypatch.setattr(sea_state, "drift_on_current", lambda *_: (value, "B", False))
    monkeypatch.setattr(sea_state, "mean_drift", lambda *_: (np.ones(3), np.full((2, 3), 0.25)))
    monkeypatch.setattr(sea_state, "carrier_of_body", lambda body: None)
    monkeypatch.setattr(sea_state, "differences", lambda body: "Δ")
    monkeypatch.setattr(sea_state, "held_beyond", lambda omega, drift, spectrum: ("held ω", "held D"))
    monkeypatch.setattr(sea_state, "slow_parts", lambda *_: ("S", "ω", "D"))
    monkeypatch.setattr(sea_state, "force_spectrum", lambda *given: given)
    monkeypatch.setattr(sea_state, "force_spectrum_with", lambda bound, spectrum, omega, D, step, met: (
        "long", omega, D, step))  # fmt: skip
    monkeypatch.setattr(sea_state, "_met_of", lambda body, heading: None)
    sea = SimpleNamespace(spectrum=SimpleNamespace(density=lambda w: w), spreading="wide" if spread else None)
    bound = SimpleNamespace(spectrum=lambda omega, step: ("spread", omega, step), level="body")
    found = sea_state.slow_forces(body, sea, np.ones(2), np.zeros(1), np.ones(1), bound)
    assert found.drift == pytest.approx(np.full(3, 1.5)) and found.spectrum == ("S", "ω", "D", "Δ")
    assert found.of_pairs == (("spread", "held ω", "Δ") if spread else ("long", "held ω", "held D", "Δ"))
    assert (found.level, found.by_current, found.damping, found.of_each) == ("body", None, None, None)
    alone = sea_state.slow_forces(body, sea, np.ones(2), np.zeros(1), np.ones(1))
    assert alone.of_pairs is None and alone.level == "newman"


# ------------------------------------------------------------------ files of buoys and loggers


@pytest.mark.parametrize("name, letters", [
    ("46042w2015.txt", ["46042d2015.txt", "46042i2015.txt", "46042j2015.txt", "46042k2015.txt"]),
    ("46042.data_spec", [f"46042{ending}" for ending in buoys.DAYS]), ("46042.txt", None), ("4604w2015.txt", None),
])  # fmt: skip
def test_files_of_directions_lie_beside_that_of_densities_all_four_or_none(name, letters, tmp_path):
    """NDBC: d α₁, i α₂, j r₁, k r₂"""
    path = tmp_path / name
    assert buoys._directions_beside(path) is None
    for other in letters or ():
        assert buoys._directions_beside(path) is None
        (tmp_path / other).write_text("")
    found = buoys._directions_beside(path)
    assert found is None if letters is None else [one.name for one in found] == letters


def test_a_spread_of_a_buoy_is_of_directions_with_an_axis_and_of_none_without():
    """Densities in m²/Hz over Hz: m₀ = ∫ S df, the frequency 0 left out"""
    frequency, density = np.array([0.0, 0.1, 0.2, 0.3]), np.array([9.0, 4.0, 2.0, 0.0])
    plain = buoys._spread("b.txt", frequency, density, None, None)
    assert plain.spreading is None and plain.direction == 0.0
    assert plain.spectrum.moment(0) == pytest.approx(0.1 * (4 / 2 + 2 + 0), rel=0.02)


@pytest.mark.parametrize("word, seconds", [
    ("2020-02-30 00:00:00", None), ("2020-13-01 00:00:00", None), ("noon", None), ("12.5", None),
])  # fmt: skip
def test_days_that_are_none_are_no_times(word, seconds):
    assert logger_files._seconds(word) is seconds


# ------------------------------------------------------------------ anchors, dolphins, downtime


def test_only_a_sinker_and_an_anchor_of_a_chart_have_a_size_that_is_needed():
    """γ (T/μ + V) N of a sinker; m₀ (γ T/T₀)^(1/b) kg of a chart; else none"""
    sinker = Holding("sinker", weight=1e5, friction=0.5, safety=1.5)
    assert sinker.needed(2e4, 3e3) == pytest.approx(1.5 * (4e4 + 3e3)) and sinker.needed(2e4, -3e3) == pytest.approx(
        6e4
    )
    assert sinker.used(2e4, 3e3) == pytest.approx(1.5 * 43e3 / 1e5) and sinker.capacity(2e4) == pytest.approx(4e4)
    chart = Chart(*[1.0] * len(Chart._fields))._replace(holding=1e6, reference=1e4, exponent=0.5)
    drag = Holding("drag", holding=2e6, chart=chart, safety=2.0)
    assert drag.needed(1e6, 0.0) == pytest.approx(1e4 * 2.0**2) and drag.used(1e6, 0.0) == pytest.approx(1.0)
    assert math.isnan(Holding("drag", holding=2e6).needed(1e6, 0.0))


def test_a_fender_that_returns_all_of_its_energy_has_the_loop_of_its_curve():
    """A cubic x² + 1 pressed from 0.1 to 0.3 and back: the mean and the first harmonic of (0.2 + 0.1 cos θ)²"""
    curve = SimpleNamespace(coefficients=np.ones(3))
    loading = type("Curve", (), {"coefficients": np.ones(3), "__call__": lambda self, x: x**2})()
    fender = SimpleNamespace(return_length=0.1, loading=loading, unloading=curve, reaction=lambda x: x)
    found = linearised.equivalent(fender, 0.2, 0.1)
    assert tuple(found)[:3] == pytest.approx((0.2**2 + 0.1**2 / 2, 2 * 0.2, 0.0), abs=1e-9)


class Process:
    """μ and s by the first feature, and draws about it"""

    def predict(self, x, return_std):
        return x[:, 0], np.full(len(x), 0.3)

    def sample_y(self, x, draws, random_state):
        rng = np.random.default_rng(random_state)
        return x[:, :1] + 0.0 * rng.normal(size=(len(x), draws))


def test_hours_that_no_interpolant_leaves_open_scatter_by_the_sea_alone():
    """Σ P (1 − P) of hours that no other limit stops; of draws alike the interpolant adds nothing"""
    made = Interpolant(Process(), np.zeros(2), 0.4)
    x, height = np.zeros((4, 1)), np.ones(4)
    mean, error = np.array([0.0, 0.0, 50.0, -50.0]), np.zeros(4)
    free = np.array([True, False, True, True])
    assert made.spread_of_sum(x, height, mean, error, free) == pytest.approx((0.0, 0.5), abs=1e-9)
    sure = made.spread_of_sum(x, height, np.full(4, 50.0), error, free)
    assert sure == pytest.approx((0.0, 0.0), abs=1e-6)
    assert made.chance(np.array([0.3]), np.array([0.3])) == pytest.approx(
        [0.5 * (1 + math.erf(0.6 / math.sqrt(2)))], rel=1e-3
    )


def test_hours_without_waves_have_no_moments():
    """Of a shape that changes with the period too; unknown hours stay unknown"""
    response = SimpleNamespace(omega=np.array([0.5, 1.0]), names=("a", "b"), power=np.ones((2, 4, 2)))
    waves = SimpleNamespace(height=np.array([0.0, np.nan, 0.0]), period=np.ones(3), direction=np.zeros(3))
    found = every_hour._by_periods(response, None, waves, (0, 2))
    assert found.shape == (2, 3, 2) and not found[:, [0, 2]].any() and np.isnan(found[:, 1]).all()


@pytest.mark.parametrize("t", [0.0, 0.3, 1.0])
def test_weights_of_six_nodes_are_those_of_the_polynomial_through_them(t):
    weights = every_hour.lagrange(np.array([t]))[0]
    for power in range(6):
        assert weights @ every_hour.NODES.astype(float) ** power == pytest.approx(t**power, abs=1e-12)


def test_the_rule_over_frequency_is_the_trapezium_s():
    """∫ ω dω and ∫ ω³ dω of straight pieces over unequal steps"""
    omega = np.array([0.5, 0.7, 1.1, 1.2])
    found = every_hour.rule_of(omega, (0, 2))
    assert found[0, [0, -1]] == pytest.approx([0.1, 0.05]) and found.shape == (2, 4)
    assert found[1] == pytest.approx(found[0] * omega**2)


# ------------------------------------------------------------------ loads, records, terminations


@pytest.mark.parametrize("ratio, part", [(1.0, 1.0), (1.1, 0.5), (1.15, 0.25), (1.2, 0.0)])
def test_a_square_hull_has_the_mean_of_both_sides_of_the_squarest_that_was_tested(ratio, part):
    """Between L/B = 1 and 1.2 in proportion; B/d = 10 in deep water"""
    tested = box_table(12.0, 10.0, 1.0, math.inf)
    found = box_table(10.0 * ratio, 10.0, 1.0, math.inf)
    mean = 0.5 * (np.array(tested.x) + np.array(tested.y)[::-1])
    assert found.x == pytest.approx((1 - part) * np.array(tested.x) + part * mean)
    assert found.y == pytest.approx((1 - part) * np.array(tested.y) + part * mean[::-1])


@pytest.mark.parametrize("below, above", [(0.7, 1.3), (0.52, 1.9), (0.98, 1.02)])
def test_parts_of_a_record_below_and_above_a_frequency_are_those_of_its_sines(below, above):
    """3 sin ω₁t + 4 sin ω₂t over whole periods: 3/√2 and 4/√2"""
    step, count, split = 0.5, 4000, 0.4
    unit = 2 * math.pi / (count * step)
    one, two = (round(share * split / unit) * unit for share in (below, above))
    t = step * np.arange(count)
    record = 3 * np.sin(one * t + 0.3) + 4 * np.cos(two * t)
    assert statistics.parts(record, step, split) == pytest.approx([3 / math.sqrt(2), 4 / math.sqrt(2)])
    assert statistics.slow_part(2.0 + record, step, split) == pytest.approx(2.0 + 3 * np.sin(one * t + 0.3))


def test_pairs_of_waves_in_either_order_have_conjugate_forces(monkeypatch):
    """T_ij of ω_i ≥ ω_j within the highest difference, else its conjugate, and none beyond"""
    monkeypatch.setattr(bound_wave_drift.BoundWaveForces, "__call__", lambda self, one, two: (
        (one * two + 1j * (one - two))[..., None] * np.arange(1.0, 7.0)))  # fmt: skip
    made = bound_wave_drift.BoundWaveForces(0.0, 0.5, (1.0, 2.0), np.zeros((2, 2, 6)), 20.0, 9.8)
    omega = np.array([0.5, 0.9, 1.3])
    T = made.of_components(SimpleNamespace(omega=omega))
    for i, one in enumerate(omega):
        for j, two in enumerate(omega):
            wanted = one * two + 1j * (one - two) if abs(one - two) < 0.5 else 0.0
            assert T[i, j] == pytest.approx(wanted * np.arange(1.0, 7.0))


@pytest.mark.parametrize("x, share", [(0.0, 1.0), (0.66, 1.0), (0.8, None), (1.0, 0.0), (1.2, 0.0), (-0.5, 1.0)])
def test_forces_fade_out_between_four_and_six_tenths_of_the_mean_frequency(x, share):
    """A cubic step 3s² − 2s³ with s = (1 − x)/(1 − ⅔)"""
    s = (1 - abs(x)) * 3
    assert bound_wave_drift.slow_share(x) == pytest.approx(3 * s**2 - 2 * s**3 if share is None else share)


@pytest.mark.parametrize("kind, share", [
    ("socket", 1.0), ("swaged socket", 0.95), ("sleeve", 0.925), ("splice", 0.8), ("wedge socket", 0.75),
    ("clips", 0.8),
])  # fmt: skip
def test_terminations_leave_the_share_of_their_table(kind, share):
    """TM 5-3810-305-10, table 4, the lower value of each kind"""
    assert strength.TERMINATIONS[kind] == share


def test_a_worn_chain_holds_by_what_is_left_of_its_diameter():
    """76 mm less 0.4 mm a year for 20 years: d² (44 − 0.08 d) of 68 mm over that of 76 mm; half may be lost"""
    wanted = 5e6 * 68**2 * (44 - 0.08 * 68) / (76**2 * (44 - 0.08 * 76))
    assert strength.worn_breaking_load(5e6, 76.0, 0.4, 20.0) == pytest.approx(wanted)
    assert strength.worn_breaking_load(5e6, 76.0, 0.0, 20.0) == 5e6
    strength.worn_breaking_load(5e6, 80.0, 2.0, 20.0)
    with pytest.raises(ValueError, match=r"leaves 39.8 mm of 80 mm after 20.1 years; allowed: at least half"):
        strength.worn_breaking_load(5e6, 80.0, 2.0, 20.1)
    for wrong in ((-0.1, 1.0), (0.1, -1.0)):
        with pytest.raises(ValueError, match="allowed: at least 0"):
            strength.worn_breaking_load(5e6, 80.0, *wrong)


@pytest.mark.parametrize("name, sizes", [
    ("R3 studless 76 mm", [78, 80, 82]), ("grade 3 98 mm", [100, 105, 110]), ("ORQ 210 mm", [215]),
    ("wire 6x36 IWRC 1960 60 mm", [64, 72, 80]), ("nylon 16 mm", [20, 24, 28]), ("nylon 256 mm", []),
])  # fmt: skip
def test_larger_sizes_of_a_kind_are_those_that_are_made(name, sizes):
    """Chain by 2 mm up to 98 mm and by 5 mm from 100 mm; rope by 4 mm up to 60 mm and by 8 mm from 64 mm"""
    kind = name.rsplit(" ", 2)[0]
    assert strength.larger_sizes(name, 3) == [f"{kind} {size} mm" for size in sizes]
