"""A body in time against what must be true of it: the frequency domain, energy, order, equilibrium, symmetry."""

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.modes import DOFS
from hakobune.bem.time_domain.fast_states import slow_memory
from hakobune.bem.time_domain.memory import MemoryArrays, no_memory
from hakobune.bem.viscous import Quadratic, Viscous
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import issc, jonswap
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_body
from hakobune.mooring.motion.given_forces import GivenForce, drift_of_half_waves
from hakobune.mooring.motion.simulation import SimulationError, moored, simulate, wave_components
from hakobune.mooring.motion.simulation import run as simulation_run
from hakobune.mooring.motion.simulation.body import FASTEST
from hakobune.mooring.motion.simulation.expected import expected_motion
from hakobune.mooring.motion.simulation.realisation import doubt_of, with_error
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.response.drift import mean_in_sea
from hakobune.mooring.response.slow_drift import force_spectrum
from hakobune.mooring.studies.conditions import Current, Waves, Wind

LINEAR = Settings(duration=300.0, ramp=500.0, slow_drift="none", tolerance=1e-5, step=0.2)
CALM = Settings(duration=60.0, ramp=0.0, slow_drift="none")


def harmonic(run, omega, ramp):
    """(6,) complex motion of a run in the steady state of a regular wave"""
    n = run.time >= 0
    t = run.time[n] + ramp
    basis = np.stack([np.cos(omega * t), np.sin(omega * t), np.ones_like(t), t], axis=1)
    cos, sin = np.linalg.lstsq(basis, run.motion[n], rcond=None)[0][:2]
    return cos + 1j * sin


def frequency_answer(moored, omega, direction, memory):
    """(6,) motion per metre with the coefficients of a memory, and the matrix of its equation"""
    reader = moored.reader
    H = memory.transform(np.array([omega]))[0]
    Z = -(omega**2) * (reader.inertia + memory.added_mass_infinity) - 1j * omega * H + reader.stiffness + moored.spring
    return np.linalg.solve(Z, reader.forces([omega], [direction])[0, 0]), Z


@pytest.mark.parametrize(("omega", "degrees"), [(0.4, 0), (0.7, 40), (1.1, 250)])
def test_regular_waves_give_the_motions_of_the_frequency_domain(on_springs, omega, degrees):
    direction = np.radians(degrees)
    damped = replace(on_springs, damping=np.diag([2e6, 2e6, 0, 0, 0, 1e9]))
    run = simulate(damped, Weather(regular=Waves(0.002, 2 * np.pi / omega, direction)), LINEAR)
    found = harmonic(run, omega, LINEAR.ramp) / 0.001
    wanted, Z = frequency_answer(on_springs, omega, direction, on_springs.memory)
    wanted = np.linalg.solve(Z - 1j * omega * damped.damping, Z @ wanted)
    reader = on_springs.reader.restrained(stiffness=on_springs.spring, damping=damped.damping)
    stored = reader.motions([omega], [direction])[0, 0]
    kind = np.repeat([np.abs(wanted[:3]).max(), np.abs(wanted[3:]).max()], 3)
    assert np.all(np.abs(found - wanted) <= 1e-4 * kind)
    fit = on_springs.memory.error.max() + on_springs.memory.deviation.max()
    assert np.all(np.abs(wanted - stored) <= 10 * fit * kind)  # least damping ratio in these waves is about 0.1


def test_viscous_damping_of_a_scene_is_a_drag_in_time(database, on_springs):
    """Roll in regular waves is that of the linear damping 8/(3π) ω a N₂, a the amplitude it leaves; third harmonics of
    |v| v, a fifth of the first, move a body well above its resonance by a hundredth of that"""
    omega, direction, amplitude, drag = 0.62, 0.5 * np.pi, 2.0, 2e10
    reader = replace(database.reader, viscous=Viscous({"Roll": Quadratic(drag)}, 1.0))
    body = moored(reader, spring=on_springs.spring, memory=on_springs.memory)
    run = simulate(body, Weather(regular=Waves(2 * amplitude, 2 * np.pi / omega, direction)), LINEAR)
    found = np.abs(harmonic(run, omega, LINEAR.ramp))
    free, Z = frequency_answer(on_springs, omega, direction, on_springs.memory)
    force, X = Z @ free * amplitude, free * amplitude
    for _ in range(100):
        extra = np.zeros((6, 6))
        extra[3, 3] = 8 / (3 * np.pi) * omega * abs(X[3]) * drag
        X = 0.5 * (X + np.linalg.solve(Z - 1j * omega * extra, force))
    assert abs(X[3]) < 0.8 * amplitude * abs(free[3])
    assert found[3] == pytest.approx(abs(X[3]), rel=0.01)


def test_a_run_begins_where_it_is_put(on_springs):
    """Offset and velocity at the start, and a decay back through rest with the signs of a pendulum on its spring"""
    start = {"offset": (0.5, 0, 0, 0, 0.01, 0), "velocity": (0, 0.2, 0, 0, 0, 0)}
    run = simulate(on_springs, Weather(), Settings(duration=60.0, ramp=0.0, step=0.1, **start))
    motion = run.motion
    assert motion[0] == pytest.approx([0.5, 0, 0, 0, 0.01, 0], abs=1e-12)
    assert (motion[1, 1] - motion[0, 1]) / 0.1 == pytest.approx(0.2, rel=0.01)
    assert motion[1, 0] < 0.5 and motion[:, 0].min() < -0.1 and motion[:, 1].max() > 0.1


def test_states_that_decay_at_once_change_the_memory_by_their_speed_squared(on_springs):
    memory, omega = on_springs.memory, np.linspace(0.1, 1.5, 15)
    slow = slow_memory(memory, FASTEST)
    left = replace(memory, arrays=slow.arrays)
    H = left.transform(omega) + slow.damping - 1j * omega[:, None, None] * slow.inertia
    size = np.sqrt(np.abs(np.einsum("qii->qi", memory.transform(omega))).max(axis=0))
    assert np.abs((H - memory.transform(omega)) / np.outer(size, size)).max() <= (1.5 / FASTEST) ** 2 * 0.1


def test_the_integrator_is_of_fifth_order(without_hull):
    moved = replace(without_hull, start=without_hull.start + [1.5, -1.0, 0.3, 0.01, 0.01, 0.02])
    steps = np.array([0.25, 0.125, 0.0625])
    settings = Settings(duration=24.0, ramp=0.0, memory="states", fixed_step=1 / 128)
    exact = simulate(moved, Weather(), settings).motion[-1]
    errors = [np.abs(simulate(moved, Weather(), replace(settings, fixed_step=h)).motion[-1] - exact)[0] for h in steps]
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 4.5), errors


def test_work_of_all_loads_is_the_change_of_energy(on_chains):
    sea = Sea(jonswap(2.0, peak_period=9.0), 0.6)
    weather = Weather(seas=(sea,), wind=Wind(30.0, 0.5), current=Current(1.0, 0.7))
    settings = Settings(duration=120.0, ramp=60.0, tolerance=1e-7, components=60)
    run = simulate(on_chains, weather, settings, seed=2)
    reader = on_chains.reader
    slow = slow_memory(on_chains.memory, FASTEST)
    M = reader.inertia + on_chains.memory.added_mass_infinity + slow.inertia
    nu, eta = run.velocity[-1], run.motion[-1]
    C = reader.stiffness
    stored = 0.5 * nu @ M @ nu + 0.5 * (eta @ C @ eta - on_chains.start @ C @ on_chains.start)
    done = sum(run.work.values())
    assert abs(done - stored) <= 1e-6 * max(abs(w) for w in run.work.values())
    assert run.work["damping"] <= 0 and run.work["memory"] < 0


def test_a_body_settles_where_the_lines_balance_it(on_chains):
    damped = replace(on_chains, damping=np.diag([2e7, 2e7, 4e7, 4e9, 1e10, 2e10]), hull=None)
    moved = replace(damped, start=damped.start + [0.8, -0.5, 0.2, 0.005, 0.003, 0.02])
    run = simulate(moved, Weather(), replace(CALM, duration=6000.0, step=100.0, tolerance=1e-6))
    assert np.abs(run.motion[-1] - on_chains.start).max() <= 1e-8


def test_a_line_that_breaks_leaves_the_system_without_it(on_chains):
    name = on_chains.system.line_names[0]
    damped = replace(on_chains, damping=np.diag([2e7, 2e7, 4e7, 4e9, 1e10, 2e10]), hull=None)
    settings = replace(CALM, duration=3000.0, step=5.0, lines_lost=((name, 33.3),), tolerance=1e-6)  # of 1 m, at rest
    run = simulate(damped, Weather(), settings)
    assert np.abs(run.motion[run.time < 33] - on_chains.start).max() <= 1e-6
    assert np.all(run.tension[run.time > 34, 0] == 0) and np.all(run.tension[run.time < 33, 0] > 0)
    body = replace(on_chains.system.bodies[0], hydrostatic_stiffness=on_chains.reader.stiffness)
    body = replace(body, freedom=("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"))
    left = rest(replace(on_chains.system, bodies=(body,)).without(name)).position[0]
    assert np.abs(run.motion[-1] - left).max() <= 1e-5


def test_the_same_seed_gives_the_same_bits_and_another_another_sea(on_chains):
    weather = Weather(seas=(Sea(issc(3.0, mean_period=9.0), 0.3),), wind=Wind(20.0, 0.0))
    settings = Settings(duration=60.0, ramp=30.0, components=50)
    first, again, other = (simulate(on_chains, weather, settings, seed) for seed in (4, 4, 5))
    assert np.array_equal(first.motion, again.motion) and np.array_equal(first.tension, again.tension)
    assert not np.allclose(first.wave, other.wave)


def test_forces_on_a_body_have_the_same_bits_whatever_was_read_from_its_database_before(database):
    """As in a process that is given the memory, beside the one that fitted it and has read coefficients since"""
    reader = database.bodies_reader
    memory, spring = no_memory(reader), np.diag([5e6, 8e6, 0.0, 0.0, 0.0, 2e10])
    one = moored(database, spring=spring, memory=memory).waves
    reader.between.forget()
    reader.forces(one.omega[::7], [0.1])
    other = moored(database, spring=spring, memory=memory).waves
    assert np.array_equal(one.omega, other.omega) and np.array_equal(one.force, other.force)


def test_waves_from_the_other_side_give_the_mirror_image(on_chains):
    settings = Settings(duration=100.0, ramp=50.0, tolerance=1e-5)
    runs = [
        simulate(on_chains, Weather(regular=Waves(3.0, 9.0, side * 0.7), current=Current(1.0, side * 0.4)), settings)
        for side in (1, -1)
    ]
    flip = np.array([1, -1, 1, -1, 1, -1])
    difference = np.abs(runs[0].motion - runs[1].motion * flip)
    assert np.all(difference.max(axis=0) <= 1e-3 * np.abs(runs[0].motion).max(axis=0))


def test_the_spread_of_linear_motions_is_that_of_the_spectrum(on_springs):
    damped = replace(on_springs, damping=np.diag([4e6, 4e6, 0, 5e8, 0, 1e10]))
    weather = Weather(seas=(Sea(issc(0.5, mean_period=8.0), 0.8),))
    settings = Settings(duration=600.0, ramp=200.0, slow_drift="none", memory="states", tolerance=1e-2, components=100)
    power = np.array([simulate(damped, weather, settings, seed).motion[400:].var(axis=0) for seed in range(12)])
    reader = damped.reader.restrained(stiffness=damped.spring, damping=damped.damping)
    omega = np.linspace(reader.omega[0], reader.omega[-1], 800)
    X = np.abs(reader.motions(omega, [0.8])[:, 0]) ** 2
    wanted = np.trapezoid(X * weather.seas[0].spectrum.density(omega)[:, None], omega, axis=0)
    off = (power.mean(axis=0) - wanted) / (power.std(axis=0, ddof=1) / np.sqrt(len(power)))
    assert np.sum(np.abs(off) <= 2.2) >= 5 and np.all(np.abs(off) <= 4.0)  # Student's t with 11 degrees of freedom


def test_the_scale_of_errors_is_the_spread_by_the_database_and_seeds_add_nothing_to_what_that_keeps(on_springs):
    sea, between = Sea(issc(2.0, mean_period=8.0), direction=0.6), on_springs.reader.between
    parts = [wave_components(on_springs, Weather(seas=(sea,)), CALM, seed) for seed in (1, 2, 3)]
    reader = on_springs.reader.restrained(stiffness=on_springs.stiffness - on_springs.reader.stiffness)
    X = np.abs(reader.motions(parts[0].omega, [0.6])[:, 0])
    wanted = np.sqrt(0.5 * parts[0].amplitude ** 2 @ X**2)
    found = expected_motion(on_springs, parts[0])[0]
    moving = wanted > 0.05 * wanted.max()
    assert np.allclose(found[:6][moving], wanted[moving], rtol=0.01)
    kept = {name: known.size for name, (known, _) in between._values.items()}
    for one in parts[1:]:
        expected_motion(on_springs, one)
    assert {name: known.size for name, (known, _) in between._values.items()} == kept


def test_components_are_as_many_as_the_record_needs(on_springs):
    weather = Weather(seas=(Sea(issc(2.0, mean_period=9.0), 0.0),))
    counts = [len(wave_components(on_springs, weather, Settings(duration=t), 0).omega) for t in (600.0, 10800.0)]
    assert counts == [200, 600]


def test_a_line_that_cannot_reach_is_named_with_its_time(on_chains):
    weather = Weather(current=Current(15.0, 0.0))
    with pytest.raises(SimulationError, match=r"cannot reach|steps below"):
        stiff = replace(on_chains.system, lines=[replace(line, type=replace(line.type, axial_stiffness=np.inf))
                                                 for line in on_chains.system.lines])  # fmt: skip
        simulate(replace(on_chains, system=stiff), weather, Settings(duration=300.0, ramp=10.0))


def test_the_estimated_error_is_that_of_the_run(on_chains):
    weather = Weather(seas=(Sea(issc(3.0, mean_period=9.0), 0.3),))
    settings = Settings(duration=200.0, ramp=50.0, components=60, tolerance=1e-2, estimate_error=True)
    run = simulate(on_chains, weather, settings, seed=1)
    exact = simulate(on_chains, weather, replace(settings, tolerance=1e-6, estimate_error=False), seed=1)
    late = run.time >= 0
    error = np.sqrt(np.mean((run.motion - exact.motion)[late] ** 2, axis=0))
    assert np.all((run.estimated_error <= 3 * error) & (error <= 3 * run.estimated_error))
    assert np.all(error <= settings.tolerance * run.motion[late].std(axis=0))


def test_slow_surge_on_a_spring_has_the_spectrum_of_newmans_drift(on_springs):
    damped = replace(on_springs, damping=np.diag([4e6, 1e7, 0, 0, 0, 1e11]))
    sea = Sea(issc(0.5, mean_period=8.0), 0.0)
    settings = Settings(1200.0, 300.0, tolerance=1e-2, components=150, wave_drift_damping=False, step=2.0)
    slow = []
    for seed in range(10):
        run, linear = (
            simulate(damped, Weather(seas=(sea,)), replace(settings, slow_drift=kind), seed)
            for kind in ("newman", "none")
        )
        slow.append((run.motion - linear.motion)[run.time >= 0, 0])
    reader = damped.reader
    omega = np.linspace(reader.omega[0], reader.omega[-1], 600)
    drift = reader.drift(omega, [0.0])[:, 0]
    difference = np.linspace(0.005, 0.8, 160)
    force = force_spectrum(sea.spectrum, omega, drift, difference)[:, 0]
    H = damped.memory.transform(difference)[:, 0, 0]
    mass = reader.inertia[0, 0] + damped.memory.added_mass_infinity[0, 0]
    Z = damped.spring[0, 0] - difference**2 * mass - 1j * difference * (H + damped.damping[0, 0])
    wanted = np.trapezoid(force / np.abs(Z) ** 2, difference)
    power = np.array([np.var(part) for part in slow])
    assert abs(power.mean() - wanted) <= 2.5 * power.std(ddof=1) / np.sqrt(len(power))
    mean = mean_in_sea(omega, drift[:, None], sea.spectrum.density(omega))[0] / damped.spring[0, 0]
    found = np.array([part.mean() for part in slow])
    assert abs(found.mean() - mean) <= 2.5 * found.std(ddof=1) / np.sqrt(len(found)) + 0.02 * abs(mean)


def test_the_last_sample_is_that_of_the_end_whatever_the_rounding(on_springs):
    moved = replace(on_springs, start=np.array([1.0, 0, 0, 0, 0, 0]))
    settings = replace(CALM, duration=3.3, step=0.1)  # 33 · 0.1 is 4e-16 beyond 3.3
    run = simulate(moved, Weather(), settings)
    longer = simulate(moved, Weather(), replace(settings, duration=4.0))
    assert len(run.motion) == 34 and abs(run.motion[-1] - longer.motion[33]).max() < 1e-3


def test_a_line_lost_at_the_start_never_pulls(on_chains):
    name = on_chains.system.line_names[0]
    run = simulate(on_chains, Weather(), replace(CALM, duration=20.0, lines_lost=((name, 0.0),)))
    assert np.all(run.tension[:, 0] == 0) and np.abs(run.motion[-1] - on_chains.start).max() > 0.01
    assert f"line {name} breaks 0 s after the ramp" in run.findings


def test_a_line_that_would_break_after_the_end_is_said_not_to(on_chains):
    name = on_chains.system.line_names[0]
    run = simulate(on_chains, Weather(), replace(CALM, duration=20.0, lines_lost=((name, 30.0),)))
    assert run.tension[-1, 0] > 0
    assert (
        f"line {name} does not break, since its break time is 30 s after the ramp and a run lasts 20 s" in run.findings
    )


def test_constant_coefficients_without_waves_are_refused(on_springs):
    with pytest.raises(SimulationError, match="give waves"):
        simulate(on_springs, Weather(), replace(CALM, memory="constant"))


def test_wind_and_current_grow_with_the_ramp(on_chains):
    weather = Weather(wind=Wind(40.0, 0.0), current=Current(1.5, 0.0))
    run = simulate(on_chains, weather, replace(CALM, ramp=100.0, duration=10.0))
    begun = np.abs(run.motion[run.time < -95] - on_chains.start).max()
    assert begun <= 1e-4 * np.abs(run.motion[-1] - on_chains.start).max()


def test_a_force_given_in_time_moves_the_body_as_a_spring_of_its_frequency(on_springs):
    omega, t = 0.5, np.arange(-1.0, 801.0, 0.25)
    damped = replace(on_springs, damping=np.diag([2e6, 2e6, 0, 0, 0, 1e9]))
    force = GivenForce(t, np.cos(omega * t)[:, None] * [1e5, 0, 0, 0, 0, 0])
    run = simulate(damped, Weather(forces=(force,)), replace(LINEAR, ramp=0.0, duration=800.0, tolerance=1e-4))
    late = run._replace(time=run.time[3000:], motion=run.motion[3000:])
    _, Z = frequency_answer(on_springs, omega, 0.0, on_springs.memory)
    wanted = np.linalg.solve(Z - 1j * omega * damped.damping, [1e5, 0, 0, 0, 0, 0])
    assert np.abs(harmonic(late, omega, 0.0) - wanted)[0] <= 2e-3 * abs(wanted[0])
    with pytest.raises(SimulationError, match="given from"):
        simulate(damped, Weather(forces=(force,)), replace(LINEAR, duration=900.0))


def test_drift_by_half_waves_of_a_regular_wave_is_its_mean_drift(on_springs):
    reader, omega, direction = on_springs.reader, 0.8, 0.7
    one = Components(*(np.array([value]) for value in (omega, 1.5, 0.3, direction)))
    wanted = 1.5**2 * reader.drift([omega], [direction])[0, 0]
    by_halves = drift_of_half_waves(reader, one, 0.0, 20.0, 100.0)
    found = by_halves.force[(by_halves.times > -15) & (by_halves.times < 95)][:, [0, 1, 5]].mean(axis=0)
    assert found == pytest.approx(wanted, rel=5e-3)  # the record's mean over part of a wave is not 0
    weather = Weather(regular=Waves(2.0, 2 * np.pi / omega, direction))
    damped = replace(on_springs, damping=np.diag([4e7, 6e7, 0, 0, 0, 5e10]))
    runs = [
        simulate(damped, weather, replace(CALM, duration=60.0, ramp=120.0, slow_drift=word))
        for word in ("half-waves", "mean", "none")
    ]
    halves, mean, none = (run.motion[run.time >= 0, :2].mean(axis=0) for run in runs)
    assert halves - none == pytest.approx(mean - none, rel=0.02)


def test_an_error_beyond_the_tolerance_is_said(on_springs):
    still = simulate(on_springs, Weather(), replace(CALM, duration=5.0))
    motion = np.sin(still.time)[:, None] * np.ones(6)
    run, told = still._replace(motion=motion), []
    for off in (5e-4, 2e-3, 0.3):
        told.append(with_error(run, doubt_of(run, motion * (1 + off)), 1e-3, DOFS).findings)
    assert told[0] == () and "give a smaller one" in told[1][0] and "chaotic" in told[2][0]


@pytest.mark.parametrize("ratio", [0.1, 0.5, 0.8])
def test_errors_that_fall_slowly_with_the_tolerance_are_carried_on(on_springs, ratio):
    """Of errors e, qe, q²e, … the difference of the first two runs is (1 − q) e: the three of them tell e."""
    still = simulate(on_springs, Weather(), replace(CALM, duration=5.0))
    motion, error = np.sin(still.time)[:, None] * np.ones(6), 2e-3
    runs = [motion * (1 + error * ratio**k) for k in range(3)]
    found = still._replace(motion=runs[0])
    assert doubt_of(found, runs[1]).worst == pytest.approx((1 - ratio) * error, rel=1e-2)
    doubt = doubt_of(found, *runs[1:])
    assert doubt.worst == pytest.approx(error, rel=1e-2)
    assert "give a smaller one" in with_error(found, doubt, 0.99 * error / 1.01, DOFS).findings[-1]
    assert with_error(found, doubt, 1.02 * error, DOFS).findings == found.findings


def test_a_third_run_is_made_only_where_the_second_is_near_the_tolerance(on_springs, monkeypatch):
    made, followed = [], simulation_run._followed

    def counted(moored, settings, begun, progress):
        made.append(settings.tolerance)
        return followed(moored, settings, begun, progress)

    monkeypatch.setattr(simulation_run, "_followed", counted)
    weather = Weather(seas=(Sea(issc(2.0, mean_period=9.0), 0.3),))
    settings = Settings(duration=60.0, ramp=20.0, components=40, tolerance=1e-2, estimate_error=True)
    runs = []
    for doubted, tolerances in ((1.0, [1e-2, 1e-3]), (0.0, [1e-2, 1e-3, 1e-4])):
        made.clear()
        monkeypatch.setattr(simulation_run, "DOUBTED", doubted)
        runs.append(simulate(on_springs, weather, settings, seed=1))
        assert made == pytest.approx(tolerances)
    np.testing.assert_array_equal(runs[0].motion, runs[1].motion)
    assert np.all(np.abs(runs[0].estimated_error / runs[1].estimated_error - 1) < 0.5)


def test_hawsers_that_snap_taut_keep_energy_and_pull_as_the_system_says(on_springs):
    """A body thrown between four hawsers that fall slack, without water that moves"""
    pull = pull_of_points("rope", [0.0, 1.0, 2.0, 4.0], [0.0, 1e6, 4e6, 2e7])
    ends = [
        ((110, 0, 3), (50, 0, 5)),
        ((-110, 5, 3), (-50, 0, 5)),
        ((0, 65, 5), (0, 25, 5)),
        ((0, -65, 5), (0, -25, 5)),
    ]
    legs = [
        Leg(Hawser(f"H{i}", pull, float(np.linalg.norm(np.subtract(a, b))) - 0.1, "", ""), a, b)
        for i, (a, b) in enumerate(ends)
    ]
    reader = on_springs.reader
    system = moored_body(legs, 20.0, reader.rotation_center)
    none = np.zeros((6, 0))
    memory = replace(on_springs.memory, arrays=MemoryArrays(np.zeros(0), np.zeros(0), none, none))
    thrown = np.array([1.5, -1.0, 0.0, 0.0, 0.0, 0.01])
    body = replace(on_springs, memory=memory, system=system, start=thrown, spring=np.zeros((6, 6)))
    run = simulate(body, Weather(), replace(CALM, duration=200.0, tolerance=1e-6, step=0.1))
    slow = slow_memory(memory, FASTEST)
    M = reader.inertia + memory.added_mass_infinity + slow.inertia
    distance = np.array(
        [
            [np.linalg.norm(rotation(*pose[3:]) @ leg.fairlead + pose[:3] - leg.anchor) for leg in legs]
            for pose in run.motion
        ]
    )
    elongation = distance - [leg.line.length for leg in legs]
    assert (elongation < 0).any(axis=0).all() and (elongation > 0.5).any(axis=0).all()
    assert run.tension == pytest.approx(pull.loading(elongation), rel=1e-9, abs=1e-3)
    energy = (
        0.5 * np.einsum("ti,ij,tj->t", run.velocity, M, run.velocity)
        + pull.energy(np.maximum(elongation, 0.0)).sum(axis=1)
        + 0.5 * np.einsum("ti,ij,tj->t", run.motion, reader.stiffness, run.motion)
    )
    assert np.ptp(energy) < 1e-6 * energy[0]


def test_coefficients_of_a_wave_are_named_where_they_damp_slow_motion(on_springs):
    """Free surge decays by what the database radiates at its natural frequency, not by what waves take"""
    soft = replace(on_springs, stiffness=np.diag([3e5, 3e5, *np.diag(on_springs.stiffness)[2:]]))
    sea = Sea(jonswap(2.0, peak_period=10.0), 0.0)
    said = [simulate(soft, Weather(seas=(sea,)), replace(CALM, duration=2.0, memory=m)) for m in ("constant", "states")]
    named = [
        line
        for line in said[0].findings
        if 'left out: the memory of the water; memory = "constant" gives slow motion the damping at' in line
    ]
    assert len(named) == 1 and "surge" in named[0] and "states" in named[0]
    assert not any(
        'left out: the memory of the water; memory = "constant" gives slow motion the damping at' in line
        for line in said[1].findings
    )
    assert any("slow motion is lightly damped: surge" in line for line in said[1].findings)


@pytest.mark.parametrize("share, capsizes", [(0.99, False), (1.01, True)])
def test_a_body_that_capsizes_is_refused_before_it_is_moved(database, on_springs, share, capsizes):
    """A spring that takes all of its restoring in roll, and a little less"""
    taken = on_springs.spring - np.diag([0, 0, 0, share * database.reader.floating().stiffness[3, 3], 0, 0])
    with pytest.raises(ValueError, match="the body capsizes: its restoring in roll") if capsizes else nullcontext():
        moored(database, spring=taken, memory=on_springs.memory)


def test_motions_that_are_not_asked_for_are_held_and_their_water_is_not_fitted(database, on_springs):
    """Surge alone, from 1 m: T = 2π √((M + A)/K) with A at that frequency; a roll that capsizes is held too"""
    taken = on_springs.spring - np.diag([0, 0, 0, 2 * database.reader.floating().stiffness[3, 3], 0, 0])
    alone = moored(database, spring=taken, motions=(0,))
    assert alone.memory.groups == ((0,),)
    settings = replace(CALM, offset=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0), duration=300.0, step=0.25)
    run = simulate(alone, Weather(), settings)
    assert np.all(run.motion[:, 1:] == alone.start[1:])
    omega = np.sqrt(on_springs.spring[0, 0] / 1e8)
    for _ in range(20):
        A, _ = database.reader.coefficients(np.array([omega]))
        omega = np.sqrt(on_springs.spring[0, 0] / (database.reader.inertia[0, 0] + A[0, 0, 0]))
    down = np.flatnonzero((run.motion[:-1, 0] > 0) & (run.motion[1:, 0] <= 0))
    crossed = run.time[down] + 0.25 * run.motion[down, 0] / (run.motion[down, 0] - run.motion[down + 1, 0])
    assert np.diff(crossed) == pytest.approx(2 * np.pi / omega, rel=0.01)
