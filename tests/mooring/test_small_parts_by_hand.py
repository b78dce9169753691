"""Small parts of moorings by hand that only whole studies reach otherwise: each of them alone, in milliseconds."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from hakobune.bem.time_domain import memory as of_memory
from hakobune.mooring.berthing.energy import BerthingError
from hakobune.mooring.berthing.memory import ship_of_database
from hakobune.mooring.criteria.anchors import Anchor, Chart, stored_anchor
from hakobune.mooring.criteria.fatigue import rainflow_cycles
from hakobune.mooring.downtime import hindcast, planes
from hakobune.mooring.environment.tables import TableError, fault_of_steps
from hakobune.mooring.formats import fast_farm, moorpy
from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moordyn import parse_moordyn
from hakobune.mooring.lines.multi_segment.solution import StaticSolution
from hakobune.mooring.lines.system.parts import Anchor as AnchorPoint
from hakobune.mooring.lines.system.parts import Fairlead, FreePoint
from hakobune.mooring.loads.coefficients import shallow_coefficient
from hakobune.mooring.motion import statistics, wave_loads
from hakobune.mooring.motion.simulation import bending
from hakobune.mooring.motion.simulation import run as of_runs
from hakobune.mooring.motion.tables import groups
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.seas import buoys
from hakobune.mooring.single_point import equilibria, runs, two_scale, waves
from hakobune.mooring.single_point.body import planar_mass_stored
from hakobune.mooring.site import contours
from hakobune.mooring.studies import waves_around
from hakobune.mooring.studies.natural_periods import periods_at_berth


def test_a_berthing_ship_has_its_own_sway_and_yaw_of_a_database_about_its_rotation_centre(monkeypatch):
    """The second of two bodies, whose surge is motion 6: sway 7 and yaw 11; M, M x_G and M (r² + x_G²)"""
    rng = np.random.default_rng(1)
    added, a, b, c = (
        rng.normal(size=(12, 12)),
        rng.normal(size=(3, 3)),
        rng.normal(size=(3, 12)),
        rng.normal(size=(12, 3)),
    )
    asked = []

    def memory_of_database(db, tolerance, own):
        asked.append((db, tolerance, own))
        return SimpleNamespace(matrices=(a, b, c), added_mass_infinity=added, storage="storage", loss="loss")

    monkeypatch.setattr(of_memory, "memory_of_database", memory_of_database)
    ship = ship_of_database("db", 2e6, 30.0, 1e-2, center=4.0, first=6)
    assert asked == [("db", 1e-2, [7, 11])] and ship.center == 4.0
    assert ship.inertia == pytest.approx(2e6 * np.array([[1.0, 4.0], [4.0, 900.0 + 16.0]]))
    assert np.array_equal(ship.added_mass_infinity, added[[7, 11]][:, [7, 11]]) and ship.a is a
    assert np.array_equal(ship.b, b[:, [7, 11]]) and np.array_equal(ship.c, c[[7, 11]])
    assert (ship.storage, ship.loss) == ("storage", "loss")
    ship_of_database("db", 2e6, 30.0)
    assert asked[-1] == ("db", 3e-3, [1, 5])
    for mass, gyration, name in ((0.0, 30.0, "mass"), (math.inf, 30.0, "mass"), (1e6, -1.0, "radius of gyration")):
        with pytest.raises(BerthingError, match=f"the {name} of the ship is"):
            ship_of_database("db", mass, gyration)


@pytest.mark.parametrize("anchor", [
    Anchor("drag", 1e5, 2e4, chart=Chart(4536.0, 1e5, 0.9, "a book", "unverified"), safety=1.5),
    Anchor("sinker", weight=4e5, friction=0.5),
])  # fmt: skip
def test_an_anchor_comes_back_from_what_is_stored_of_it(anchor):
    found = stored_anchor(json.loads(json.dumps(anchor)))
    assert found._replace(chart=None)[5:] == anchor._replace(chart=None)[5:] and found.chart == anchor.chart
    assert found[:5] == pytest.approx(anchor[:5], nan_ok=True) and found.safety == anchor.safety


def test_the_mass_of_slow_motion_is_that_of_a_database_with_the_added_mass_of_no_frequency():
    rng = np.random.default_rng(2)
    inertia, added = rng.normal(size=(2, 6, 6))
    floating = SimpleNamespace(
        inertia=inertia, held_added_mass=lambda omega: (added if omega == 0.0 else added + 1)[None]
    )
    found = planar_mass_stored(SimpleNamespace(floating=lambda: floating))
    assert found == pytest.approx((inertia + added)[np.ix_([0, 1, 5], [0, 1, 5])])


def test_fairleads_of_a_body_that_bends_are_moved_by_its_shapes_and_nothing_else_is(monkeypatch):
    """Two shapes of amplitudes 0.5 and 2.0 of the second body"""
    moved = np.array([[1.0, 0.0, 2.0], [0.0, 3.0, -1.0]])
    asked = []
    monkeypatch.setattr(
        groups, "moved_by_shapes", lambda reader, body, point: asked.append((body, tuple(point))) or [moved]
    )
    point = Fairlead("f", "barge", (10.0, 20.0, 30.0))
    monkeypatch.setattr(groups, "replace", lambda thing, **new: (thing, new))
    anchor = AnchorPoint("a", (0.0, 0.0, -50.0))
    system = SimpleNamespace(
        bodies=[SimpleNamespace(name="ship"), SimpleNamespace(name="barge")], points=(anchor, point)
    )
    of, new = groups.with_bent_fairleads(system, SimpleNamespace(modes=["one", "two"]), np.array([0.5, 2.0]))
    assert of is system and asked == [(1, (10.0, 20.0, 30.0))]
    assert new["points"][0] is anchor and new["points"][1] == (point, dict(position=(10.5, 26.0, 29.0)))
    assert groups.with_bent_fairleads(system, SimpleNamespace(modes=()), np.zeros(0)) is system


def test_windows_of_a_record_have_the_significant_wave_about_their_own_mean():
    """60 s each of surge 2 m at 6 s, then 3 m at 10 s about 5 m; sway is still, yaw has too few waves; 30 s are left"""
    step = 0.05
    t = np.arange(0.0, 150.0 + step / 2, step)
    first = t <= 60.0
    motion = np.zeros((len(t), 6))
    motion[:, 0] = np.where(first, 2 * np.sin(2 * np.pi * t / 6), 5 + 3 * np.sin(2 * np.pi * t / 10))
    motion[:, 5] = 0.1 * np.sin(2 * np.pi * t / 50)
    found = statistics.windows(motion, step, 60.0)
    assert found.start.tolist() == [0.0, 60.0] and found.amplitude.shape == found.period.shape == (2, 3)
    assert found.amplitude[:, 0] == pytest.approx([2.0, 3.0], rel=5e-3) and found.period[:, 0] == pytest.approx(
        [6, 10], rel=5e-3
    )
    assert np.isnan(found.amplitude[:, 1:]).all() and np.isnan(found.period[:, 1:]).all()
    assert len(statistics.windows(motion[:1200], step, 60.0).start) == 0


def test_periods_at_a_berth_are_of_coupled_motions_named_by_their_largest_share():
    """Sway and yaw coupled in mass alone; nothing restores surge"""
    mass, held = np.zeros((6, 6)), np.zeros((6, 6))
    mass[[0, 1, 5], [0, 1, 5]], mass[1, 5], mass[5, 1] = (2e6, 3e6, 5e9), 1e6, 3e6  # as stored: 2e6 on either side
    added = np.zeros((6, 6))
    added[1, 1] = 1e6
    held[[0, 1, 5], [0, 1, 5]], held[2, 2] = (0.0, 4e5, 2e9), 1.0
    moored = SimpleNamespace(reader=SimpleNamespace(inertia=mass), slow_added_mass=added, stiffness=held)
    M, K = np.array([[4e6, 2e6], [2e6, 5e9]]), np.diag([4e5, 2e9])
    squared = np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real)
    found = periods_at_berth(moored)
    assert np.isnan(found[0]) and found[1:] == pytest.approx(2 * np.pi / np.sqrt(squared))


def test_headings_of_rest_have_no_moment_about_the_point_that_holds():
    """N − x F_y + y F_x of a force (3, 4 sin ψ) and a moment of 2 sin ψ, held at (5, −1): zero where 18 sin ψ = −3"""
    rest = lambda psi: np.stack([np.full_like(psi, 3.0), 4 * np.sin(psi), 2 * np.sin(psi)], axis=-1)  # noqa: E731
    found = np.sort(np.mod(equilibria.headings_of_rest(SimpleNamespace(at_rest=rest), (5.0, -1.0)), 2 * np.pi))
    first = math.asin(-3 / 18)
    assert found == pytest.approx([np.pi - first, 2 * np.pi + first], abs=1e-6)


@pytest.mark.parametrize("carried", [False, True])
def test_mean_drift_at_each_heading_is_twice_the_integral_over_the_sea(monkeypatch, carried):
    """2 ∫ D S dω by the trapezium rule, in the one direction of the sea from the bow; with a current D + B V too"""
    count, omega, S = waves.HEADINGS, np.array([0.4, 0.6, 1.0]), np.array([1.0, 3.0, 2.0])
    rng = np.random.default_rng(4)
    D, B = rng.normal(size=(3, count, 3)), rng.normal(size=(3, count, 3, 2))
    step = 2 * np.pi / count
    beta = 7 * step

    def directional(headings):
        return np.isclose(np.mod(headings - beta + np.pi, 2 * np.pi), np.pi).astype(float)

    sea = SimpleNamespace(spectrum=SimpleNamespace(density=lambda omega: S), directional=directional, direction=beta)
    asked = []
    monkeypatch.setattr(waves, "drift_damping", lambda forces, own, depth, gravity: asked.append(own) or (D, B))
    V = np.array([0.6, -0.8])
    found = waves.mean_drift(SimpleNamespace(omega=omega, drift=D), sea, Carrier(tuple(V), False) if carried else None)
    weight = 2 * S * np.array([0.1, 0.3, 0.2])
    for i in (0, 3, 11):
        from_bow = (7 - i) % count
        wanted = weight @ D[:, from_bow]
        if carried:
            c, s = np.cos(i * step), np.sin(i * step)
            own = np.array([c * V[0] + s * V[1], -s * V[0] + c * V[1]])
            wanted = wanted + np.einsum("q,qab,b->a", weight, B[:, from_bow], own)
        assert found[i] == pytest.approx(wanted)
    assert not carried or asked[0] == pytest.approx(omega)


@pytest.mark.parametrize("step, taken", [(None, runs.SLOW_STEP), (3.0, 3.0)])
def test_a_slow_run_is_the_slewing_with_gusts_and_without_waves(monkeypatch, step, taken):
    asked = []
    slow = SimpleNamespace(
        time=np.arange(4.0), place="place", heading="heading", buoy="buoy", hawser="hawser", wind_speed="w"
    )
    monkeypatch.setattr(runs, "gusty", lambda point, duration, seed: ("gusts", point, duration, seed))
    monkeypatch.setattr(runs, "slew", lambda *given, **more: asked.append((given, more)) or slow)
    monkeypatch.setattr(runs, "line_tensions", lambda point, buoy: ("lines", point, buoy))
    monkeypatch.setattr(runs, "_run", lambda record, steady: (record, steady))
    monkeypatch.setattr(runs, "turned_state", lambda point, state, offset: (point, state, offset))
    steady = SimpleNamespace(point="point", state="state")
    record, of = runs.slow_run(steady, runs.Times(duration=600.0, step=step, offset=0.3, tolerance=1e-5, seed=9))
    assert asked == [(("point", ("point", "state", 0.3), 600.0, taken),
                      dict(tolerance=1e-5, wind_speed=("gusts", "point", 600.0, 9)))]  # fmt: skip
    assert (
        of is steady
        and record.lines == ("lines", "point", "buoy")
        and record.wave.tolist() == np.zeros((4, 6)).tolist()
    )
    assert (record.place, record.heading, record.buoy, record.hawser, record.wind_speed) == (
        "place", "heading", "buoy", "hawser", "w",
    )  # fmt: skip


def a_plan(beta=0.0, k=0.1):
    plan = np.array([[10.0, 0.0], [50.0, -5.0], [50.0, 15.0], [10.0, 10.0]])
    return SimpleNamespace(sources=SimpleNamespace(plan=plan), middle=np.array([30.0, 5.0]), beta=beta, k=k)


def test_places_before_and_behind_a_body_are_half_its_length_off_along_the_waves():
    """40 m long: 20 m before its foremost source and behind the last, as far from the middle as it reaches"""
    found = waves_around.sides(a_plan())
    assert found["before it"] == pytest.approx([30.0 - (-10.0 + 20.0), 5.0]) and found["behind it"] == pytest.approx(
        [30.0 + 50.0 + 20.0, 5.0]
    )
    across = waves_around.sides(a_plan(beta=np.pi / 2))
    assert across["behind it"] == pytest.approx([30.0, 5.0 + 15.0 + 20.0]) and across["before it"][1] == pytest.approx(
        5 - 25
    )


@pytest.mark.parametrize("width, k, half", [
    (None, 1.0, 60.0), (None, 0.1, 1.5 * 2 * np.pi / 0.1), (50.0, 0.1, 25.0), (40.0, 0.1, 0), (4e4, 0.1, 0),
    (3.9e4, 0.1, 1.95e4),
])  # fmt: skip
def test_a_map_is_three_bodies_or_three_waves_wide_or_as_wide_as_is_asked(width, k, half):
    if not half:
        with pytest.raises(ValueError, match=f"width is {width:g} m; allowed: from the body's 40 m to a thousand"):
            waves_around.half_width(a_plan(k=k), width)
    else:
        assert waves_around.half_width(a_plan(k=k), width) == pytest.approx(half)


def test_a_map_has_the_elevation_of_each_place_about_the_middle():
    around = SimpleNamespace(middle=np.array([30.0, 5.0]), elevation=lambda at: at[:, 0] + 1j * at[:, 1])
    found = waves_around.mapped(around, 20.0, 5)
    assert found.x.tolist() == [10.0, 20.0, 30.0, 40.0, 50.0] and found.y.tolist() == [-15.0, -5.0, 5.0, 15.0, 25.0]
    assert np.array_equal(found.elevation, found.x[None] + 1j * found.y[:, None]) and found.around is around


@pytest.mark.parametrize("period, omega, found", [
    (10.0, None, 0.2 * np.pi), (None, 0.7, 0.7), (None, None, None), (5.0, 1.0, None), (0.0, None, "period is 0"),
    (None, np.inf, "omega is inf"),
])  # fmt: skip
def test_a_regular_wave_has_a_period_or_a_frequency(period, omega, found):
    if isinstance(found, float):
        assert waves_around.frequency(period, omega) == pytest.approx(found)
    else:
        with pytest.raises(ValueError, match=found or "give either period in s or omega in rad/s"):
            waves_around.frequency(period, omega)


def test_planes_of_a_record_are_read_file_by_file_in_axes_of_the_body(monkeypatch):
    """A tent of 12° about 30° of the compass at 0.1 Hz, between 0.05 and 0.2 Hz: height, energy period, direction

    m₀ of straight lines is 0.5 S 0.15 Hz · 12°; of the x axis at 90°, 30° of the compass is 60°.
    """
    frequency, towards = np.array([0.05, 0.1, 0.2]), np.radians(np.arange(0.0, 360.0, 15.0))
    density = np.zeros((2, 3, 24), np.float32)
    density[0, 1, 2], density[1] = 4.0, np.nan
    files = {"a.nc": [np.array(["2020-01-01T00", "2020-01-01T01"], "datetime64[s]")],
             "b.nc": [np.array(["2020-01-02T00", "2020-01-02T01"], "datetime64[s]")]}  # fmt: skip
    monkeypatch.setattr(
        planes, "planes_of", lambda path, location: [(time, frequency, towards, density) for time in files[path]]
    )
    times, found, (height, period, direction) = planes.read_planes(("a.nc", "b.nc"), 3, np.pi / 2)
    assert times.tolist() == [*files["a.nc"][0].tolist(), *files["b.nc"][0].tolist()] and found.counts == (2, 2)
    assert found.location == 3 and found.omega == pytest.approx(2 * np.pi * frequency)
    assert np.degrees(found.angle[:3]) == pytest.approx([90.0, 75.0, 60.0])
    assert [found.path(row) for row in range(4)] == ["a.nc", "a.nc", "b.nc", "b.nc"]
    m0 = 0.5 * 4.0 * 0.15 * np.radians(15.0)
    assert height[[0, 2]] == pytest.approx(4 * math.sqrt(m0), rel=2e-2) and np.isnan(height[1])
    assert np.degrees(direction[0]) == pytest.approx(60.0, abs=0.1) and period[0] == pytest.approx(10.0, rel=1e-6)
    parts = list(found.density())
    assert len(parts) == 2 and parts[0][0, 1, 2] == pytest.approx(4.0 / (2 * np.pi))
    other = [frequency, frequency * 1.01]
    monkeypatch.setattr(planes, "planes_of", lambda path, location: [(files[path][0], other.pop(0), towards, density)])
    with pytest.raises(TableError, match=r"the frequencies or directions of b\.nc differ from those of a\.nc"):
        planes.read_planes(("a.nc", "b.nc"), 3, np.pi / 2)


def test_centres_of_classes_are_means_of_their_law_and_those_without_waves_their_middles():
    """exp{−(h − 1)/2}: between a and b the mean is 1 + 2 + {(a − 1) e^… − (b − 1) e^…}/(e^… − e^…)"""
    heights = np.array([0.5, 1.5, 2.5, 3.5])
    found = contours._centers(heights, (1.0, 2.0, 1.0))
    left = lambda h: math.exp(-(h - 1) / 2)  # noqa: E731
    for i, (a, b) in enumerate(((0.0, 1.0), (1.0, 2.0), (2.0, 3.0), (3.0, 4.0))):
        if b <= 1.0:
            assert found[i] == heights[i]
            continue
        mean = 3 + ((a - 1) * left(a) - (b - 1) * left(b)) / (left(a) - left(b))
        assert found[i] == pytest.approx(mean, rel=1e-4)
    assert contours._edges(np.array([1.0, 2.0, 4.0])).tolist() == [0.5, 1.5, 3.0, 5.0]
    assert contours._edges(np.array([0.3, 2.0])).tolist() == [0.0, 1.15, 2.85]


def test_a_contour_of_a_law_is_a_circle_of_normal_variables():
    """Heights by Weibull's law, periods ln-normal; one sea of 3 h in 50 years is beyond the circle's radius"""
    law = contours.JointLaw((1.0, 2.0, 1.5), (1.0, 0.8, 0.5), (0.05, 0.1, 0.3), "mean_period", 9.0)
    seas = 50 * 365.25 * 24 / 3
    reach = law.reach(50.0, 3.0)
    assert stats.norm.sf(reach) == pytest.approx(1 / seas, rel=1e-6)
    height, period = law.contour(50.0, points=5)
    for h, t, angle in zip(height, period, np.linspace(0, 2 * np.pi, 5), strict=True):
        wanted = 1 + 2 * (-math.log(stats.norm.sf(reach * math.cos(angle)))) ** (1 / 1.5)
        assert h == pytest.approx(wanted, rel=1e-6)
        mean, spread = 1 + 0.8 * h**0.5, 0.05 + 0.1 * math.exp(-0.3 * h)
        assert t == pytest.approx(math.exp(mean + spread * reach * math.sin(angle)), rel=1e-6)
    top, median = law.top(50.0)
    assert top == pytest.approx(height.max()) and median == pytest.approx(math.exp(1 + 0.8 * math.sqrt(top)))
    with pytest.raises(ValueError, match=r"0\.0001 years have 0\.29"):
        law.reach(1e-4, 3.0)


def test_newmark_s_steps_follow_a_swing_and_what_waves_and_the_mooring_pull(monkeypatch):
    """ω² = 4 of heave with 5 % damping from rest under a step of force: the closed form within the error of 0.02 s"""
    body = SimpleNamespace(
        added=np.diag([1e6] * 6), damping=np.diag([2e5] * 6), stiffness=np.diag([4e6] * 6), lever=3.0
    )
    made = two_scale._Newmark(body, 0.02)
    held = SimpleNamespace(force=np.zeros(3), buoy=np.zeros(2), tension=np.zeros(1))
    point = SimpleNamespace(hold=lambda *given: held)
    count = 400
    forces, wave = np.zeros((count, 6)), np.zeros((count, 6))
    forces[:, 2] = 4e5
    made.run(point, np.zeros(6), held, forces, wave, np.zeros((count, 2)), np.zeros((count, 1)))
    t, n = 0.02 * np.arange(1, count + 1), 0.1
    w = math.sqrt(4 - n * n)
    # the force begins within the first step: mean acceleration sees half of it there
    exact = 0.1 * (1 - np.exp(-n * (t - 0.01)) * (np.cos(w * (t - 0.01)) + n / w * np.sin(w * (t - 0.01))))
    assert wave[:, 2] == pytest.approx(exact, abs=2.5e-4) and not wave[:, [0, 1, 3, 4, 5]].any()


def test_a_frigate_in_shallow_water_is_pushed_as_in_the_published_example():
    """FFG-7 broadside in 1.5 m/s, in MN over T/d: UFC 4-159-03 (2005), table 4-6.  The first and the last give ½ρV²LT
    and C₀; the others follow"""
    draft_over_depth = np.array([0.096, 0.288, 0.576, 0.72, 0.96])
    published = np.array([0.55, 0.66, 1.03, 1.30, 1.90])
    x = draft_over_depth[[0, -1]] ** 2
    pushed, pressure = np.linalg.solve(np.column_stack([1 - x, 3.2 * x]), published[[0, -1]])
    found = [pressure * shallow_coefficient(pushed / pressure, share, 1.0) for share in draft_over_depth]
    assert found == pytest.approx(published, abs=0.01)


def test_a_shallow_coefficient_rises_with_the_square_of_draft_over_depth():
    """C₀ + (C₁ − C₀)(T/d)^K (UFC 4-159-03, eq. 11)"""
    assert shallow_coefficient(0.6, 10.0, 20.0) == pytest.approx(0.6 + 2.6 / 4)
    assert shallow_coefficient(0.6, 10.0, 20.0, exponent=3.0, grounded=2.0) == pytest.approx(0.6 + 1.4 / 8)
    assert shallow_coefficient(0.6, 10.0, 10.0) == pytest.approx(3.2) and shallow_coefficient(3.2, 1.0, 9.0) == 3.2
    for wrong, says in ((dict(depth=9.99), "at least the draft 10 m"), (dict(deep=3.21), "at most the coefficient")):
        with pytest.raises(ValueError, match=says):
            shallow_coefficient(**dict(deep=0.6, draft=10.0, depth=20.0) | wrong)


@pytest.mark.parametrize("V, slope, uplift", [(100.0, 0.0, math.atan(0.1)), (0.0, 0.0, 0.0), (100.0, 0.2, 0.0),
                                              (100.0, -0.2, math.atan(0.1) + 0.2), (-1.0, 0.0, 0.0)])  # fmt: skip
def test_the_uplift_of_an_anchor_is_its_angle_above_the_bed_there(V, slope, uplift):
    one = object.__new__(StaticSolution)
    line = SimpleNamespace(anchor_slope=slope, uplift_limit=0.15)
    for name, value in dict(line=line, horizontal_anchor=np.array(1e3), vertical_anchor=np.array(V)).items():
        object.__setattr__(one, name, value)
    assert one.anchor_uplift == pytest.approx(uplift) and one.anchor_holds == (uplift <= 0.15)
    object.__setattr__(one, "horizontal_anchor", np.array(0.0))
    object.__setattr__(one, "vertical_anchor", np.array(0.0))
    assert one.anchor_uplift == 0.0


def test_a_farm_has_as_many_turbines_as_rows_and_its_lines_in_another_file(monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr(
        fast_farm, "read_moordyn_system", lambda file, depth, turbines: asked.append((file, depth, turbines))
    )
    text = """FAST.Farm input
    2   NumTurbines - count
    "lines\\\\shared.dat"   SharedMoorFile - file
    WT_X  WT_Y  WT_Z  name
    (m)   (m)   (m)   (-)
    0.0   0.0   0.0   a
    1500  -20   1.5   b
    7     7     7     none
    """.replace("\\\\\\\\", "\\\\")
    farm = tmp_path / "farm.fstf"
    farm.write_text(text)
    fast_farm.read_fast_farm(farm, 200.0)
    assert asked == [(tmp_path / "lines/shared.dat", 200.0, {1: (0.0, 0.0, 0.0), 2: (1500.0, -20.0, 1.5)})]
    for wrong, says in ((text.replace("2   Num", "5   Num"), "turbines and"),
                        (text.replace("NumTurbines", "Number"), "lacks NumTurbines"),
                        (text.replace("1500  -20", "1500  x"), "2 turbines and 0 rows")):  # fmt: skip
        farm.write_text(wrong)
        with pytest.raises(FormatError, match=says):
            fast_farm.read_fast_farm(farm)


@pytest.mark.parametrize("omega, links, free, says", [
    (299.0, (), (0, 6, 7), None), (301.0, (), (0, 6, 7), "bend 2 has a natural frequency of 301 rad/s, limit 300"),
    (301.0, (), (0, 6), None), (299.0, ("hinge",), (0, 6, 7), None),
    (299.0, ("hinge",), (0, 6), "holds bend 2, and hinges hinge are given"), (299.0, ("hinge",), (6, 7), None),
])  # fmt: skip
def test_shapes_are_followed_up_to_300_radians_a_second_and_all_are_free_beside_hinges(omega, links, free, says):
    """ω² = K/(M + A∞) of the second shape; a rigid motion may be held"""
    stiffness, inertia, added = np.zeros((8, 8)), 2.0 * np.eye(8), np.zeros((8, 8))
    stiffness[7, 7], added[7, 7], stiffness[6, 6] = 5.0 * omega**2, 3.0, -1.0
    stiffness[0, 0] = 1e9
    body = SimpleNamespace(
        words=[*"abcdef", "bend 1", "bend 2"], rigid=6, links=[SimpleNamespace(name=one) for one in links],
        stiffness=stiffness, inertia=inertia, held_added_mass=lambda omega: added[None] * (omega == np.inf),
    )  # fmt: skip
    if says is None:
        bending.check_bending(body, free)
    else:
        with pytest.raises(ValueError, match=says):
            bending.check_bending(body, free)


@pytest.mark.parametrize("kind, made", [
    ("fixed", AnchorPoint("p", (1.0, 2.0, 3.0))), ("Anchor", AnchorPoint("p", (1.0, 2.0, 3.0))),
    ("body12", Fairlead("p", "body 12", (1.0, 2.0, 3.0))), ("Body", Fairlead("p", "body 1", (1.0, 2.0, 3.0))),
    ("vessel", Fairlead("p", "vessel", (1.0, 2.0, 3.0))), ("fairlead", Fairlead("p", "vessel", (1.0, 2.0, 3.0))),
    ("free", FreePoint("p", (1.0, 2.0, 3.0), 50.0, 0.2)), ("connection", FreePoint("p", (1.0, 2.0, 3.0), 50.0, 0.2)),
])  # fmt: skip
def test_points_of_moorpy_are_anchors_fairleads_of_their_bodies_or_free(kind, made):
    row = {"name": "p", "location": [1, 2.0, 3], "type": kind, "mass": 50.0, "volume": 0.2}
    assert moorpy._point(row, "x.yaml") == made
    with pytest.raises(FormatError, match=r"location of point p is \[1, 2\]; allowed: \[x, y, z\] in m"):
        moorpy._point(row | {"location": [1, 2]}, "x.yaml")
    with pytest.raises(FormatError, match="type of point p is 'coupled'; allowed: fixed, vessel, body1 …, free"):
        moorpy._point(row | {"type": "coupled"}, "x.yaml")


CODES = (-9, -99, -999, -9999, -99.9, -99.99, 99, 99.9, 99.99, 999, 999.9, 9999, -32767, -32768)


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("kind", ["height", "direction"])
def test_what_records_write_where_nothing_was_measured_is_missing(code, kind):
    """In degrees of directions; 99 and less are directions themselves"""
    value = math.radians(code) if kind == "direction" else code
    said = []
    found = hindcast._cleaned("x", [0.5, value, 1.5], kind, "a.csv", said)
    if kind == "direction" and -360 <= code <= 720:
        assert found.tolist() == [0.5, value, 1.5] and not said
    else:
        assert (
            found.tolist()[::2] == [0.5, 1.5] and np.isnan(found[1]) and "1 values of x are taken as codes" in said[0]
        )


def test_a_value_that_is_no_code_and_beyond_its_range_is_refused():
    for value in (30.1, -0.1, 98.9, -998.0):
        with pytest.raises(TableError, match=f"a.csv: x is {value:.6g} in 1 rows; allowed: 0 to 30"):
            hindcast._cleaned("x", [0.5, value], "height", "a.csv", [])
    assert hindcast._cleaned("x", [0.0, 30.0], "height", "a.csv", []).tolist() == [0.0, 30.0]


@pytest.mark.parametrize("times, time, found", [
    (["2020-01-01T00", "2020-01-01T01"], " 2020-01-01T01 ", 1), (["2020"], None, 0),
    (["2020-01", "2020-02"], None, "has several times; it has 2 times from 2020-01 to 2020-02"),
    (["2020-01", "2020-02"], "2020", "has several times 2020;"), (["2020-01", "2020-02"], "2021", "has no time 2021;"),
])  # fmt: skip
def test_a_time_of_a_file_is_chosen_by_how_it_begins(times, time, found):
    if isinstance(found, int):
        assert buoys.one_of("a.nc", times, time) == found
    else:
        with pytest.raises(TableError, match=f"a.nc {found}"):
            buoys.one_of("a.nc", times, time)


def a_solution(rows, slack=False, **of_line):
    """Of pieces (kind, upper end, length, slope and tension); kind 1 lies on the bed"""
    one = object.__new__(StaticSolution)
    bed = SimpleNamespace(friction=0.5)
    line = SimpleNamespace(**dict(length=100.0, weight=1e4, bed=bed, anchor_slope=0.0) | of_line)
    pieces = np.zeros((len(rows), 11))
    for piece, (kind, top, length, slope, tension, rate) in zip(pieces, rows, strict=True):
        piece[[0, 1, 2, 10, 5, 6]] = kind, top, length, slope, tension, rate
    for name, value in dict(line=line, pieces=pieces, slack=slack, _one=pieces).items():
        object.__setattr__(one, name, value)
    return one


FREE = (0, 100.0, 40.0, 0.9, 0.0, 0.0)  # steep and idle, but free


@pytest.mark.parametrize("row, slides", [
    ((1, 60.0, 60.0, math.atan(0.51), 0.0, 0.0), True), ((1, 60.0, 60.0, math.atan(0.49), 0.0, 0.0), False),
    ((1, 60.0, 60.0, -math.atan(0.51), 0.0, 0.0), True), ((1, 60.0, 60.0, math.atan(0.51), 1.0, 0.0), False),
    ((1, 60.0, 60.0, math.atan(0.51), 0.0, -1.0), False), ((1, 60.0, 0.0, math.atan(0.51), 0.0, 0.0), False),
])  # fmt: skip
def test_a_part_without_tension_slides_on_what_is_steeper_than_its_friction(row, slides):
    assert a_solution([FREE, row]).slides == slides
    assert not a_solution([FREE, row], bed=None).slides
    steep = dict(anchor_slope=-math.atan(0.51))
    assert a_solution([FREE], slack=True, **steep).slides and a_solution([FREE], slack=False, **steep).slides is False


def test_parts_on_the_bed_are_told_from_the_anchor_up_and_joined_where_they_meet():
    """90 to 80, free, 60 to 50 and 50 to 30, a heap of no length, 20 to 0"""
    lies = lambda top, length: (1, top, length, 0.0, 5.0, 0.0)  # noqa: E731
    one = a_solution(
        [FREE, lies(90.0, 10.0), FREE, lies(60.0, 10.0), lies(50.0, 20.0), lies(30.0, 0.0), lies(20.0, 20.0)]
    )
    assert one.grounded.tolist() == [[0.0, 20.0], [30.0, 60.0], [80.0, 90.0]] and one.grounded_length == 60.0
    assert a_solution([FREE]).grounded.shape == (0, 2)


@pytest.mark.parametrize("record", [[1.0], [], [[1.0, 2.0], [3.0, 4.0]], [1.0, np.nan, 2.0], [1.0, np.inf]])
def test_cycles_are_of_a_row_of_two_finite_tensions_and_more(record):
    with pytest.raises(ValueError, match="gaps or fewer than two samples"):
        rainflow_cycles(record)
    assert set(rainflow_cycles([1.0, 3.0, 1.0])[0].tolist()) == {2.0} and not len(rainflow_cycles([1.0, 3.0])[0])


def test_poses_are_predicted_over_1_2_mean_periods_of_the_energy_and_6_s_at_most():
    """Amplitudes of 1 and 2 m have a fifth and four fifths of it"""
    made = lambda omega, amplitude: wave_loads._window(np.array(omega), np.array(amplitude))  # noqa: E731
    assert made([2.0, -7.0], [1.0, 2.0]) == pytest.approx(1.2 * 2 * math.pi / 6.0)
    assert made([0.5, 1.0], [1.0, 2.0]) == made([2.0], [0.0]) == made([0.0], [1.0]) == 6.0


@pytest.mark.parametrize("water, current, on_hull, says", [
    ("sea", None, None, "incident waves, without"), ("sea", "current", None, "waves and the current, uniform over the"),
    ("sea", None, "hull", "waves and the current, uniform over the"), ("still", "current", None, "in still water: "),
])  # fmt: skip
def test_what_is_around_lines_that_move_is_told_with_the_current_of_a_box_or_of_a_hull(water, current, on_hull, says):
    weather, settings = SimpleNamespace(current=current, on_hull=on_hull), SimpleNamespace(dynamic_water=water)
    assert says in of_runs._around(weather, settings)


def test_a_column_of_moordyn_that_nobody_knows_is_told_with_the_line_of_the_file():
    """A column that no version has, in place of another one; the names are in line 4"""
    text = "a title\n\n--- LINES ---\nID Odd UnstrLen AttachA AttachB NumSegs Outputs\n() () () () () () ()\n"
    with pytest.raises(FormatError) as refused:
        parse_moordyn(text + "1 chain 100 1 2 20 -\n")
    assert " line 4, section LINES: column 'odd' is unknown" in str(refused.value)


@pytest.mark.parametrize("times, says", [
    ([0, 1, 2, 2, 3], "line 13: the time stays at 2 s; allowed: increasing times at equal steps"),
    ([0, 1, 2, 1.5, 3], "line 13: the time goes back from 2 to 1.5 s; allowed"),
    ([0, 1, 2, 4, 5], "line 13: the time goes from 2 to 4 s, and the step elsewhere is 1 s: 1 row is missing; allowed"),
    ([0, 1, 4, 5, 6, 8], "line 12: the time goes from 1 to 4 s, and the step elsewhere is 1 s: 2 rows are missing, the "
     "first of 2 gaps; allowed"),
    ([0, 1, 2, 3.5, 4.5], "line 13: the time goes from 2 to 3.5 s, and the step elsewhere is 1 s, from 1 to 1.5 s in "
     "the file; allowed: equal steps; interpolate"),
    ([0, 1, 3, 4, 4.4], "line 12: the time goes from 1 to 3 s, and the step elsewhere is 1 s, from 0.4 to 2 s in"),
])  # fmt: skip
def test_uneven_times_of_a_table_have_their_line_and_the_remedy_of_their_kind(times, says):
    """Rows are in lines 10, 11, 12 and so on, and steps may be 1 % off"""
    fault = fault_of_steps("a.csv", np.array(times, float), 0.01, list(range(10, 10 + len(times))))
    assert isinstance(fault, TableError) and str(fault).startswith(f"a.csv: {says}")
