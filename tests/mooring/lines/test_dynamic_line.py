"""Dynamic line against statics, its own derivatives, orders of convergence and the books of energy."""

import numpy as np
import pytest

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.dynamics.simulation import (
    AttachedBody,
    CurrentProfile,
    DynamicLine,
    DynamicSegment,
    ElasticBed,
    FairleadMotion,
    WaveTrain,
    simulate,
)
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.lines.multi_segment import line as static

WEIGHT, EA, MASS = 979.3, 4.933e8, 114.94
STILL = water_arrays(None, None, 9.80665)


def segment(length=300.0, elements=40, **changes):
    given = dict(weight=WEIGHT, mass=MASS, diameter=0.1368, axial_stiffness=EA, drag_normal=1.333)
    given |= dict(drag_tangential=0.2034, added_normal=1.0, added_tangential=0.5)
    return DynamicSegment(length, elements=elements, **(given | changes))


def chain(elements=40, x=290.0, bed=None, **changes):
    """300 m of chain in 50 m of water, fairlead at the origin."""
    return DynamicLine(segment(elements=elements, **changes), (-x, 0.0, -50.0), bed=bed or ElasticBed())


def hanging(elements=40, bodies=(), **changes):
    """A line between two points that touches nothing: smooth, so that orders of convergence show."""
    return DynamicLine(segment(elements=elements, **changes), (-290.0, 0.0, -50.0), bed=None)


def surge(amplitude, period):
    return FairleadMotion.harmonic((0, 0, 0), (1j * amplitude, 0, 0), period)


def quiet(line, motion, duration, **options):
    return simulate(line, motion, duration, check_mesh=False, **options)


def cycle(result, values, period):
    """Change of a history over its last period."""
    return values[-1] - np.interp(result.time[-1] - period, result.time, values)


def test_line_at_rest_converges_to_the_catenary_at_second_order():
    exact = float(solve_lines(290.0, 50.0, 300.0, WEIGHT, EA, bed=False).tension_fairlead)
    errors = []
    for n in (10, 20, 40):
        still = quiet(hanging(n), FairleadMotion.still((0, 0, 0)), 0.1)
        errors.append(abs(still.tension_fairlead[0] / exact - 1))
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.9), errors


@pytest.mark.parametrize("line", [chain(), hanging(), chain(20, bed=ElasticBed(friction=0.6)), chain(x=240.0)])
def test_line_at_rest_stays_at_rest(line):
    still = quiet(line, FairleadMotion.still((0, 0, 0)), 20.0)
    # equilibrium is left by 1e-10 of the line's length and of its tension
    assert np.abs(still.tension_fairlead / still.tension_fairlead[0] - 1).max() < 1e-7
    assert np.abs(still.end.position - quiet(line, FairleadMotion.still((0, 0, 0)), 0.1).end.position).max() < 1e-4


def test_friction_at_rest_leaves_the_anchor_what_the_catenary_leaves():
    exact = solve_lines(290.0, 50.0, 300.0, WEIGHT, EA, 0.6)
    errors = []
    for n in (40, 160):
        still = quiet(chain(n, bed=ElasticBed(friction=0.6)), FairleadMotion.still((0, 0, 0)), 0.1)
        errors.append(abs(still.tension_anchor[0] - exact.tension_anchor) / exact.tension_fairlead)
    # friction of an element is the resolution: 0.6 w ℓ of 3e5 N
    assert errors[0] < 0.015 and errors[1] < 0.005, errors


def test_line_on_a_slope_rests_like_the_catenary_on_that_slope():
    exact = solve_lines(290.0, 50.0, 300.0, WEIGHT, EA, 0.0, 0.05)
    still = quiet(chain(80, bed=ElasticBed(slope=0.05)), FairleadMotion.still((0, 0, 0)), 0.1)
    assert abs(still.tension_fairlead[0] / exact.tension_fairlead - 1) < 5e-3
    assert abs(still.tension_anchor[0] / exact.tension_anchor - 1) < 5e-3


def test_slow_motion_is_a_row_of_catenaries():
    slow = quiet(chain(80), surge(2.0, 4000.0), 6000.0)
    x = 290.0 + np.array([slow_position(t) for t in slow.time])
    exact = solve_lines(x, 50.0, 300.0, WEIGHT, EA).tension_fairlead
    # 80 elements at rest are 0.3 % low; drag at 3 mm/s is 1e-5 of the tension
    assert np.abs(slow.tension_fairlead / exact - 1).max() < 5e-3


def slow_position(t):
    return surge(2.0, 4000.0).at(t)[0, 0]


def test_small_slow_motion_feels_the_stiffness_of_the_catenary():
    a, x = 0.05, 280.0
    line = solve_lines(x, 50.0, 300.0, WEIGHT, EA)
    small = quiet(chain(160, x=x), surge(a, 400.0), 800.0, tolerance=1e-4)
    late = small.time > 400.0
    pull = -small.force_fairlead[late]
    amplitude = 0.5 * np.ptp(pull, axis=0)[[0, 2]]
    # 160 elements: the lift-off moves by a tenth of an element, which limits the resolution of the stiffness
    assert np.allclose(amplitude / a, line.stiffness[:, 0], rtol=0.03)


def test_energy_is_in_the_books_of_every_cycle():
    for line in (chain(30), chain(30, bed=ElasticBed(friction=0.5))):
        moved = quiet(line, surge(2.0, 10.0), 40.0)
        E = moved.energies
        work, lost, stored = (cycle(moved, values, 10.0) for values in (E.work, E.lost, E.stored))
        assert work > 0
        assert abs(work - lost - stored) < 0.01 * work
        assert abs(stored) < 0.01 * work
        assert min(cycle(moved, v, 10.0) for v in (E.drag, E.structural, E.bed)) > 0


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_work_of_a_slow_cycle_is_known_where_a_thousand_times_as_much_goes_in_and_out(friction):
    line, T, found = chain(40, bed=ElasticBed(friction=friction)), 100.0, []
    for tolerance in (1e-3, 1e-5):
        run = quiet(line, surge(0.5, T), 2 * T, stops=[T], tolerance=tolerance)
        found.append(cycle(run, run.energies.supplied, T))
    assert T in run.time and np.ptp(run.energies.work) > 100 * found[1]
    assert abs(found[0] / found[1] - 1) < 0.01


def test_books_of_energy_close_at_second_order_in_time():
    gaps = []
    for step in (0.2, 0.1, 0.05):
        moved = quiet(hanging(10, damping_ratio=0.1), surge(1.0, 12.0), 12.0, tolerance=0.1, longest_step=step)
        E = moved.energies
        gaps.append(abs(E.work - E.lost - E.stored)[-1])
    assert np.all(np.log2(np.divide(gaps[:-1], gaps[1:])) > 1.8), gaps


def test_tension_converges_at_second_order_in_time():
    line, motion = hanging(10), surge(1.0, 12.0)
    fine = quiet(line, motion, 9.0, tolerance=1e-6)
    runs = [quiet(line, motion, 9.0, tolerance=0.1, longest_step=h) for h in (0.1, 0.05, 0.025)]
    errors = [distance(run.time, run.tension_fairlead, fine) for run in runs]
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.8), errors


def distance(time, tension, fine):
    """N, root mean square of the difference from a finer run"""
    return np.sqrt(np.mean((tension - np.interp(time, fine.time, fine.tension_fairlead)) ** 2))


def test_tension_converges_at_second_order_in_the_elements():
    runs = [quiet(hanging(n), surge(2.0, 10.0), 20.0, tolerance=1e-5) for n in (5, 10, 20, 160)]
    errors = [distance(run.time, run.tension_fairlead, runs[-1]) for run in runs[:-1]]
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.7), errors


def test_refining_the_line_at_a_fixed_step_does_not_blow_up():
    """Taut line, 300 m, 226 kg/m, heave 3 m in 10 s: tensions iterated at lagged angles fail at c Δt/ℓ > 0.45."""
    motion = FairleadMotion.harmonic((0, 0, 0), (0, 0, 3j), 10.0)
    peaks = []
    for n in (20, 40, 80, 160):
        heavy = segment(elements=n, mass=226.0, weight=1930.0, axial_stiffness=9e8)
        line = DynamicLine(heavy, (-285.0, 0.0, -80.0), bed=None)
        run = quiet(line, motion, 20.0, tolerance=0.1, longest_step=0.06)
        peaks.append(run.tension_fairlead.max())
    assert np.all(np.isfinite(peaks))
    assert np.ptp(peaks[1:]) < 0.02 * peaks[-1], peaks


def test_snap_after_slack_is_bounded_and_converges():
    """Bound: a taut elastic line jerked at speed v takes up v √(EA m) on top of its tension."""
    peaks, least = [], []
    for n in (10, 20, 40):
        snap = quiet(chain(n, structural_damping=3e7), surge(3.0, 7.0), 28.0)
        peaks.append(snap.tension_fairlead.max())
        least.append(snap.least_tension.min())
    assert max(least) == 0.0
    speed = 2 * np.pi / 7.0 * 3.0
    taut = float(solve_lines(293.0, 50.0, 300.0, WEIGHT, EA).tension_fairlead)
    assert max(peaks) < taut + speed * np.sqrt(EA * MASS)
    assert np.ptp(peaks) < 0.01 * peaks[-1] and abs(peaks[2] - peaks[1]) < abs(peaks[1] - peaks[0]), peaks


def test_a_snap_is_the_line_s_and_not_that_of_its_elements():
    peaks = [quiet(chain(n), surge(3.0, 7.0), 14.0, tolerance=5e-3).tension_fairlead.max() for n in (40, 80)]
    assert abs(peaks[1] / peaks[0] - 1) < 0.01, peaks


def test_a_run_in_two_parts_is_the_run_in_one():
    line, motion = chain(20), surge(2.0, 10.0)
    whole = quiet(line, motion, 12.0, tolerance=1e-4)
    first = quiet(line, motion, 7.0, tolerance=1e-4)
    second = quiet(line, motion, 5.0, tolerance=1e-4, start=first.end)
    assert second.time[0] == 7.0 and second.time[-1] == 12.0
    assert abs(second.tension_fairlead[-1] / whole.tension_fairlead[-1] - 1) < 1e-3


def test_a_host_that_moves_the_fairlead_step_by_step_gets_the_same_force():
    """Coupling: the host gives position and velocity at both ends of its step and takes the force at the end."""
    line, motion, dt, end = chain(20), surge(2.0, 10.0), 0.1, None
    whole = quiet(line, motion, 6.0)
    for k in range(60):
        both = np.array([motion.at(k * dt), motion.at((k + 1) * dt)])
        given = FairleadMotion.table([k * dt, (k + 1) * dt], both[:, 0], both[:, 1])
        part = quiet(line, given, dt, start=end)
        end = part.end
    assert np.isclose(part.time[-1], 6.0)
    assert abs(part.tension_fairlead[-1] / whole.tension_fairlead[-1] - 1) < 2e-3


def test_frames_and_stations_belong_to_the_run():
    line = chain(20)
    run = quiet(line, surge(2.0, 10.0), 12.0, frames=7, stations=(0, 10, 20), tolerance=5e-2)
    assert np.allclose(run.frame_time, np.linspace(0, 12, 7))
    assert np.array_equal(run.frames[-1], run.end.position)
    for t, nodes in zip(run.frame_time, run.frames, strict=True):
        assert np.allclose(nodes[-1], surge(2.0, 10.0).at(t)[0], atol=1e-3)
        assert np.allclose(nodes[0], line.anchor)
    assert np.all(run.station_tension <= run.largest_tension[:, None])
    assert np.all(run.station_tension >= run.least_tension[:, None])


def test_a_table_of_a_harmonic_motion_gives_the_same_tensions():
    motion = surge(2.0, 10.0)
    t = np.linspace(0, 15.0, 301)
    table = FairleadMotion.table(t, [motion.at(s)[0] for s in t])
    one, other = (quiet(chain(20), m, 15.0) for m in (motion, table))
    assert abs(one.tension_fairlead.max() / other.tension_fairlead.max() - 1) < 2e-3


def test_a_clump_and_a_buoy_hang_with_their_weight():
    """Plumb line, nothing on the bed: the fairlead carries all weights less all buoyancies."""
    parts = (segment(20.0, 5), segment(30.0, 6), segment(20.0, 5))
    bodies = (AttachedBody(mass=3000.0, volume=0.5), AttachedBody(mass=500.0, volume=2.0))
    line = DynamicLine(parts, (0.0, 0.0, -80.0), bodies, bed=None)
    still = quiet(line, FairleadMotion.still((0, 0, -8.0)), 0.1)
    weight = 70.0 * WEIGHT + 9.80665 * (3500.0 - 2.5 * 1025.0)
    assert np.isclose(-still.force_fairlead[0, 2] - still.force_anchor[0, 2], weight, rtol=1e-8)


def test_a_buoy_that_pulls_its_line_up_floats_where_its_weight_is_carried():
    """A light buoy in mid-line comes to the surface; there half weight means half immersion."""
    parts = (segment(60.0, 12, weight=50.0), segment(60.0, 12, weight=50.0))
    line = DynamicLine(parts, (-30.0, 0.0, -40.0), (AttachedBody(mass=1000.0, volume=4.0),), bed=None)
    still = quiet(line, FairleadMotion.still((30.0, 0, -1.0)), 0.1)
    z, radius = still.end.position[12, 2], (3.0 / np.pi) ** (1 / 3)
    assert -radius < z < radius
    share = (1 - z / radius) ** 2 * (2 + z / radius) / 4
    carried = -still.force_fairlead[0, 2] - still.force_anchor[0, 2]
    assert np.isclose(carried, 9.80665 * (1000.0 - share * 4 * 1025.0) + 120.0 * 50.0, rtol=1e-8)


def test_current_across_a_taut_line_is_carried_by_its_ends():
    line = DynamicLine(segment(100.0, 30, weight=1e-3), (-100.5, 0.0, -30.0), bed=None)
    still = quiet(line, FairleadMotion.still((0, 0, -30.0)), 0.1, current=CurrentProfile([-50.0, 0.0], [[0, 0.5]] * 2))
    drag = 0.5 * 1025.0 * 1.333 * 0.1368 * 100.0 * 0.5**2
    # the stretched line bends by 2 (drag/8T) or less: cos³ differs from 1 by less than 1 in 1000
    assert np.isclose(still.force_fairlead[0, 1] + still.force_anchor[0, 1], drag, rtol=2e-3)


def test_waves_move_the_water_as_the_potential_says():
    from hakobune.bem.waves import incident_wave, wavenumber
    from hakobune.mooring.lines.dynamics.lumped.surroundings import water_at

    waves = WaveTrain([1.5, 0.7], [8.0, 11.0], [0.4, 2.0], [0.3, 1.0], depth=25.0, ramp=0.0)
    points, t = np.array([[3.0, -2.0, -4.0], [40.0, 7.0, -20.0]]), 3.7
    u, du, expected = np.zeros((3, 2)), np.zeros((3, 2)), np.zeros((2, 3))
    water = water_arrays(None, waves, 9.80665)
    there = points.T.copy()
    water_at(water, there, 2, t, u, du)
    for a, T, beta, lag in zip([1.5, 0.7], [8.0, 11.0], [0.4, 2.0], [0.3, 1.0], strict=True):
        omega = 2 * np.pi / T
        _, gradient = incident_wave(points, beta, omega, wavenumber(omega, 25.0), 25.0)
        expected += np.real(a * np.exp(1j * lag) * gradient * np.exp(-1j * omega * t))
    assert np.allclose(u.T, expected, rtol=1e-9)
    ahead, back, none = np.zeros((3, 3, 2))
    water_at(water, there, 2, t + 1e-4, ahead, none)
    water_at(water, there, 2, t - 1e-4, back, none)
    assert np.allclose(du, (ahead - back) / 2e-4, atol=1e-6)


def test_waves_alone_shake_a_line():
    waves = WaveTrain(2.0, 8.0, 0.0, depth=50.0)
    shaken = quiet(chain(20), FairleadMotion.still((0, 0, -2.0)), 30.0, waves=waves)
    assert np.ptp(shaken.tension_fairlead) > 100.0


def test_tangent_is_the_derivative_of_the_forces(tangent_fault):
    # drag and added mass turn with the line, which the tangent leaves out; the rest is exact
    plain = dict(drag_normal=0.0, drag_tangential=0.0, added_tangential=1.0)
    parts = (segment(200.0, 6, **plain), segment(100.0, 4, **plain))
    line = DynamicLine(
        parts, (-290.0, 0, -50.0), (AttachedBody(2000.0, 1.0, 3.0),), bed=ElasticBed(friction=0.4, slope=0.02)
    )
    rest, rng = start(line, (0, 0, 0), STILL), np.random.default_rng(1)
    n, cq, cv = line.elements + 1, 1e-3, 0.03
    since = rest.position
    moved = since + 1e-3 * rng.standard_normal((n, 3))
    speed = 0.05 * rng.standard_normal((n, 3))
    a, direction = rng.standard_normal((2, n, 3))

    assert tangent_fault(line.system, moved, speed, a, direction, since, cq, cv) < 1e-5


def test_block_elimination_solves_the_equations():
    from hakobune.mooring.lines.dynamics.lumped.block_tridiagonal import factor, substitute

    rng, n = np.random.default_rng(2), 7
    D, B, r = rng.standard_normal((n, 3, 3)) + 8 * np.eye(3), rng.standard_normal((n, 3, 3)), np.ones((n, 3))
    dense = np.zeros((n, 3, n, 3))
    for j in range(n):
        dense[j, :, j] = D[j]
        if j + 1 < n:
            dense[j, :, j + 1] = dense[j + 1, :, j] = -B[j]
    expected = np.linalg.solve(dense.reshape(3 * n, 3 * n), r.ravel())
    nodes, elements, pivots, x = D.reshape(n, 9).T.copy(), np.zeros((9, n)), np.zeros((n, 27)), np.zeros((3, n))
    elements[:, 1:] = B[:-1].reshape(n - 1, 9).T  # element e is column e + 1
    factor(nodes, elements, pivots, 0, n - 1)
    substitute(pivots, r.T.copy(), x, 0, n - 1)
    assert np.allclose(x.T.ravel(), expected)


@pytest.mark.parametrize(
    ("line", "fairlead"),
    [
        (DynamicLine(DynamicSegment(1000.0, 30.0, 240.0, 0.08, 6.4e10, 50), (-800.0, 0.0, -300.0)), (0, 0, 0)),
        (DynamicLine(DynamicSegment(120.0, 20.0, -30.0, 0.18, 2e7, 30), (-80.0, 0.0, -50.0), bed=None), (0, 0, -10.0)),
        (chain(500), (0, 0, 0)),
        (chain(40, x=0.0), (0, 0, 0)),
        (chain(40, x=100.0), (0, 0, 0)),
        (DynamicLine(segment(), (-290.0, 0.0, -48.0), bed=ElasticBed(below=2.0)), (0, 0, 0)),
    ],
    ids=["stiff wire", "floating line", "500 elements", "plumb over its anchor", "slack", "anchor above the bed"],
)
def test_lines_that_are_hard_to_start_are_in_equilibrium(line, fairlead):
    still = quiet(line, FairleadMotion.still(fairlead), 0.1)
    ends = -still.force_fairlead[0, 2] - still.force_anchor[0, 2]
    on_bed = line.bed is not None
    weight = line.segments[0].weight * line.length
    # what the ends do not carry the bed does
    assert (0 < ends < weight) if on_bed else np.isclose(ends, weight, rtol=1e-6)
    assert np.abs(still.tension_fairlead / still.tension_fairlead[0] - 1).max() < 1e-6


def test_a_fairlead_under_the_bed_is_said():
    with pytest.warns(UserWarning, match="below the bed"):
        quiet(chain(10), FairleadMotion.harmonic((0, 0, -48.0), (0, 0, 5.0), 10.0), 8.0)


def test_few_elements_are_said():
    with pytest.warns(UserWarning, match="give more elements"):
        simulate(chain(3), surge(2.0, 10.0), 20.0)


def test_a_fairlead_that_starts_with_a_jerk_is_said():
    with pytest.warns(UserWarning, match="give the motion a ramp"):
        quiet(hanging(10), FairleadMotion.harmonic((0, 0, 0), (1j, 0, 0), 10.0, ramp=0.0), 1.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(duration=-1.0), "duration is -1"),
        (dict(tolerance=0.0), "tolerance is 0"),
        (dict(stations=(99,)), "stations is"),
        (dict(longest_step=0.0), "longest_step is 0"),
    ],
)
def test_wrong_input_is_named(change, words):
    given = dict(duration=1.0) | change
    with pytest.raises(ValueError, match=words):
        simulate(chain(10), surge(1.0, 10.0), **given)


def test_impossible_lines_are_named():
    with pytest.raises(ValueError, match="length is -1"):
        segment(-1.0)
    with pytest.raises(ValueError, match="bodies; allowed: one body fewer"):
        DynamicLine((segment(), segment()), (0, 0, -50.0), (None, None))
    with pytest.raises((LineError, ValueError)):
        simulate(chain(10), FairleadMotion.still((0, 0, -60.0)), 1.0)
    with pytest.raises(ValueError, match="motion's end"):
        simulate(chain(10), FairleadMotion.table([0, 1.0], np.zeros((2, 3))), 5.0)


@pytest.mark.parametrize("current", [None, CurrentProfile([0.0], [[0.0, 0.5]])])
@pytest.mark.parametrize("friction", [0.3, 0.6, 1.0])
def test_a_line_with_friction_has_a_static_shape_wherever_one_without_has(friction, current):
    water = water_arrays(current, None, 9.80665)
    for n in (20, 80):
        for x in (265.0, 280.0, 290.0):
            start(chain(n, x, ElasticBed(friction=friction)), (0, 0, 0), water)


def test_chain_clump_and_wire_at_rest_pull_as_the_static_line_of_the_same_parts_does():
    wire = dict(weight=115.0, mass=14.0, diameter=0.05, axial_stiffness=1.3e8)
    parts = (segment(200.0), segment(120.0, **wire))
    exact = static.StaticLine(
        [static.Segment(s.length, s.weight, s.axial_stiffness) for s in parts],
        [static.PointLoad(200.0, 30e3)],
        static.Bed.sloping(0.0, 0.5),
    ).solve(308.0, 58.0)
    errors = []
    for n in (1, 3):
        line = DynamicLine(
            parts, (0, 0, -58.0), (AttachedBody(30e3 / 9.80665),), ElasticBed(friction=0.5)
        ).with_elements(n)
        still = quiet(line, FairleadMotion.still((308.0, 0, 0)), 0.1)
        pulls = still.tension_fairlead[0] - exact.tension_fairlead, still.tension_anchor[0] - exact.tension_anchor
        errors.append(np.abs(pulls).max())
    # friction comes in pieces of an element: 0.5 w l of 2500 N with 40 on the chain
    assert errors[0] < 2500.0 and errors[1] < 2500.0 / 3, errors
