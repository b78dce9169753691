"""Several bodies in time: as in the frequency domain, each as alone, and what one does to the other goes back to it."""

from dataclasses import replace

import numpy as np
import pytest
from made_up_body import INERTIA, OMEGA, STIFFNESS
from two_bodies import ASTERN, BODIES, DEPTH, G, two_bodies

from hakobune.bem.drift import sum_about_origin
from hakobune.bem.time_domain.memory import no_memory
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.dynamics.simulation import FairleadMotion
from hakobune.mooring.lines.dynamics.simulation import simulate as drive
from hakobune.mooring.lines.ropes import RopePart, rope
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_bodies
from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.motion.contacts import berth_of
from hakobune.mooring.motion.line_loads import body_lines, fairlead_course, line_work, loads_at
from hakobune.mooring.motion.moving_lines.prepare import dynamic_line
from hakobune.mooring.motion.simulation import SimulationError, moored, simulate
from hakobune.mooring.motion.wave_loads import no_wave_forces
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Afloat, ExposedBox, Waves

AROUND = np.arange(24) * (np.pi / 12)
SPRING = np.diag([3e6, 2e6, 0, 0, 0, 3e9])
STILL = {"memory": "constant", "slow_drift": "none", "tolerance": 1e-5}


def system(*legs, depth=DEPTH):
    moving = {body.name: (body.rotation_center, body.heading) for body in BODIES if not body.fixed}
    return moored_bodies(legs, moving, depth, 1025.0, G)


def hawser(name, body, fairlead, end, to="", stiffness=2e5, slack=0.9):
    """A Leg of a straight line, whose ends are given in space"""
    away = float(np.linalg.norm(np.subtract(end, fairlead)))
    pull = pull_of_points(name, [0.0, 100.0], [0.0, 100.0 * stiffness])
    return Leg(Hawser(name, pull, slack * away, "", ""), end, fairlead, body, to)


@pytest.fixture(scope="module")
def pair(coupled):
    """Two bodies whose motions are coupled by the water, the second heading the other way, on springs"""
    body, waves = coupled
    spring, damping = (np.kron(np.eye(2), one) for one in (SPRING, 0.05 * INERTIA))
    return moored(body, memory=no_memory(body), spring=spring, damping=damping, waves=waves)


def test_regular_waves_move_both_as_in_the_frequency_domain(pair):
    """Waves small enough that springs and phases are linear; after the ramp, by least squares over four periods"""
    i, j = 16, 3
    w, beta, a = OMEGA[i], AROUND[j], 1e-3
    T = 2 * np.pi / w
    run = simulate(pair, Weather(regular=Waves(2 * a, T, beta)), Settings(84 * T, 20 * T, T / 20, **STILL))
    body = pair.reader
    (A,), (B,) = body.coefficients(np.array([w]))
    stiffness, damping = (np.kron(np.eye(2), part) for part in (STIFFNESS + SPRING, 0.05 * INERTIA))
    D = -(w**2) * (np.kron(np.eye(2), INERTIA) + A) - 1j * w * (B + damping) + stiffness
    exact = np.linalg.solve(D, body.between.quantities["excitation_force"][i, j])
    late = run.time >= 80 * T  # resonance in heave takes its time
    t = run.time[late] + 20 * T
    turn = np.stack([np.cos(w * t), np.sin(w * t), np.ones_like(t)], axis=1)
    found = np.linalg.lstsq(turn, run.motion[late] / a, rcond=None)[0]
    assert np.abs(found[0] + 1j * found[1] - exact).max() < 1e-4 * np.abs(exact).max()
    scale = np.repeat(np.abs(exact).reshape(-1, 3).max(axis=1), 3)  # translations, rotations of each
    assert np.all(np.abs(found[0] + 1j * found[1] - exact) < 3e-4 * scale)


def test_a_spring_between_two_bodies_is_refused(coupled):
    spring = np.kron(np.eye(2), SPRING)
    spring[1, 7] = spring[7, 1] = -4e5
    with pytest.raises(
        ValueError, match=r"spring between ship sway and barge sway is -4e\+05 .*allowed: 0; give a line"
    ):
        moored(coupled[0], memory=no_memory(coupled[0]), spring=spring)
    with pytest.raises(ValueError, match=r"spring has the shape \(6, 6\); allowed: \(12, 12\)"):
        moored(coupled[0], memory=no_memory(coupled[0]), spring=SPRING)


def test_a_body_that_heads_the_other_way_rests_as_one_that_does_not():
    """On a spring that couples sway and roll, pulled down and aside by a rope at its side: along its own axes alike"""
    body, K = two_bodies(AROUND), SPRING.copy()
    K[1, 3] = K[3, 1] = 4e6
    main = RopePart(1.2e6, 0.1)
    moving = [one for one in BODIES if not one.fixed]
    bollard, lead = np.array([[30.0, 60.0, -4.0], [28.0, 15.0, 3.0]])  # from the rotation centre
    ropes = [
        rope(one.name, one.in_scene(one.own_center + bollard), one.in_scene(one.own_center + lead), main, 8e5)
        for one in moving
    ]
    box = ExposedBox(100.0, 30.0, 8.0, 5.0)
    hulls = [Afloat(one.name, box, one.own_center, np.array(one.place), one.heading, 1025.0) for one in moving]
    berth = berth_of((), ropes, None, hulls, [(0, -1), (1, -1)])
    held = moored(body, memory=no_memory(body), spring=np.kron(np.eye(2), K), berth=berth)
    ship, barge = np.split(held.start, 2)
    assert abs(ship[3]) > 3e-4 and barge == pytest.approx(ship * [-1, -1, 1, 1, 1, 1], rel=1e-6, abs=1e-9)
    assert held.stiffness[6:, 6:] == pytest.approx(held.stiffness[:6, :6], rel=1e-6, abs=1e-6 * np.abs(K).max())
    run = simulate(held, Weather(), Settings(20.0, 0.0, 1.0, **STILL | {"constant_period": 9.0}))
    assert run.motion[-1] == pytest.approx(run.motion[0], abs=1e-6)


def test_bodies_that_do_not_see_each_other_are_each_as_alone():
    """With drift and its damping, from another side of the one that heads the other way"""
    drift = np.einsum("w,b,m,d->wmbd", 1e4 * OMEGA**2, [1.0, 0.0, 1.0], 1 + 0.1 * np.cos(AROUND), [1.0, 0.5, 30.0])
    drift[:, :, 2] = np.roll(drift[:, :, 2], -12, axis=1)  # the same from 180° on, along axes that have turned
    both = two_bodies(AROUND, body_drift_force=drift, drift_force=sum_about_origin(drift, BODIES))
    K = np.kron(np.eye(2), SPRING)
    w, how = OMEGA[16], Settings(60.0, 20.0, 1.0, **STILL | {"slow_drift": "mean", "tolerance": 1e-4})

    def run(body, beta, spring):
        held = moored(body, memory=no_memory(body), spring=spring)
        return simulate(held, Weather(regular=Waves(2.0, 2 * np.pi / w, beta)), how)

    found = run(both, AROUND[2], K)
    assert np.abs(found.motion[:, [0, 6]]).max() > 0.01
    for own, number, turn in ((slice(0, 6), 0, np.eye(6)), (slice(6, 12), 2, ASTERN)):
        b = both.between
        stored = {name: b.quantities[name][:, own, own] for name in ("added_mass", "radiation_damping")}
        shift = 12 if number else 0  # headings in the axes of the body
        stored |= {
            "excitation_force": np.roll(b.quantities["excitation_force"], -shift, axis=1)[:, :, own],
            "drift_force": np.roll(drift[:, :, number], -shift, axis=1),
        }
        center = np.array(BODIES[number].rotation_center) * ([1, 1, 1] if number == 0 else [-1, -1, 1])
        plan = b.outlines[own.start // 6] * (1 if number == 0 else -1)
        alone = replace(
            both, between=replace(b, quantities=stored, outline=plan, outlines=()), bodies=(), rotation_center=center,
            inertia=INERTIA, stiffness=STIFFNESS, damping=np.zeros((6, 6)),
        )  # fmt: skip
        single = run(alone, AROUND[2] + (0 if number == 0 else np.pi), SPRING)
        size = np.abs(single.motion).max(axis=0)
        assert np.all(np.abs(found.motion[:, own] - single.motion).max(axis=0) < 2e-3 * size + 1e-9), turn
        assert np.all(np.abs(found.slow[:, own.start // 2 : own.start // 2 + 3] - single.slow).max(axis=0) < 2e-3)


def test_a_hawser_between_two_pulls_both_alike_wherever_they_are():
    """Forces add up to nothing, and so do moments about a point in space, for any place, heel and heading"""
    lines = body_lines(system(hawser("tie", "barge", (0.0, -25.0, 2.0), (5.0, 25.0, 3.0), "ship", slack=0.5)))
    assert (lines.body.tolist(), lines.other.tolist()) == ([1], [0])
    rng, work = np.random.default_rng(3), line_work(lines)
    for _ in range(5):
        poses = rng.normal(size=(2, 6)) * [3, 3, 1, 0.2, 0.2, 0.5] + [[0] * 6, [0, 0, 0, 0, 0, np.pi]]
        assert loads_at(lines, work, poses, np.zeros((2, 3, 3)), np.zeros((2, 6)))
        force, moment = work.sums[:, :3], work.sums[:, 3:]
        assert np.linalg.norm(force[0]) == pytest.approx(np.hypot(*work.tension[0]), rel=1e-12)
        about = moment + np.cross(lines.place + poses[:, :3], force)
        assert np.abs(force.sum(axis=0)).max() < 1e-12 * np.abs(force).max()
        assert np.abs(about.sum(axis=0)).max() < 1e-12 * np.abs(about).max()


def test_a_pair_that_floats_freely_keeps_momentum_and_energy():
    """On a hawser between their centres alone: (M + A) v of both together, and their energy with that of the hawser"""
    added, damping = (np.array([share * np.kron(np.eye(2), INERTIA)] * len(OMEGA)) for share in (0.5, 1e-12))
    quiet = two_bodies(AROUND, added_mass=added, radiation_damping=damping)
    tie = system(hawser("tie", "barge", (12.0, -30.0, 1.0), (0.0, 30.0, 1.0), "ship", slack=1.001))
    free = moored(quiet, tie, memory=no_memory(quiet), waves=no_wave_forces(quiet))
    moves, away = (
        np.zeros(12),
        np.array([12.0, -60.0]) / np.hypot(12, 60),
    )  # apart, along the hawser
    moves[:2], moves[6:8] = -0.1 * away, -0.02 * away  # the barge heads the other way
    how = STILL | {"constant_period": 10.0, "tolerance": 1e-7}
    run = simulate(free, Weather(), Settings(80.0, 0.0, 1.0, **how, velocity=tuple(moves)))
    assert run.tension.max() > 1e4 and run.tension[0].max() == 0.0
    cos, sin = np.cos(run.motion[:, 5::6] + [0, np.pi]), np.sin(run.motion[:, 5::6] + [0, np.pi])
    u, v = run.velocity[:, ::6], run.velocity[:, 1::6]
    momentum = np.stack([(cos * u - sin * v).sum(axis=1), (sin * u + cos * v).sum(axis=1)])
    assert np.abs(momentum - momentum[:, :1]).max() < 1e-5 * 0.1
    energy = sum(0.75 * INERTIA[i, i] * run.velocity[:, i::6] ** 2 for i in range(6)).sum(axis=1)
    energy += sum(0.5 * STIFFNESS[i, i] * (run.motion[:, i::6]) ** 2 for i in (2, 3, 4)).sum(axis=1)
    stretch = run.tension[:, 0] / 2e5
    assert np.ptp(energy + 0.5 * 2e5 * stretch**2) < 1e-6 * energy.max()


def test_a_chain_of_either_body_pulls_as_the_same_chain_driven_alone(pair):
    """In waves from abeam, along the course of its own fairlead, of the body that heads the other way too"""
    chain = UniformLine("", line_type("R3 studless 76 mm"), 160.0, "", "")
    legs = [
        Leg(replace(chain, name=f"chain of {body}"), (x + 150.0, y, -DEPTH), (x, y, -1.0), body)
        for body, x, y in (("ship", 40.0, 30.0), ("barge", 50.0, -30.0))
    ]
    held = replace(pair, system=system(*legs))
    how = Settings(20.0, 20.0, 0.05, **STILL | {"tolerance": 1e-4}, dynamic_lines="all")
    run = simulate(held, Weather(regular=Waves(2.0, 9.0, AROUND[4])), how)
    lines, states = body_lines(held.system), np.stack([run.motion, run.velocity]).reshape(2, len(run.time), 2, 6)
    for i, body in enumerate(("ship", "barge")):
        assert lines.body[i] == i, body
        own = np.concatenate(list(states[:, :, i]), axis=1)
        heading = pair.reader.axes_at_rest[i, 5]  # a course in space, of motions along the body's axes at rest
        own[:, :2] = own[:, :2] @ [[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]]
        own[:, 5] += heading
        place, velocity = fairlead_course(lines, i, own)
        t = run.time - run.time[0]
        line = dynamic_line(held.system.lines[i], lines.anchor[i], held.system, how.dynamic_elements)
        alone = drive(line, FairleadMotion.table(t, place, velocity), t[-1], tolerance=1e-5, check_mesh=False)
        pull = np.interp(t, alone.time, alone.tension_fairlead)
        late = t > 10.0  # it begins at rest
        off = np.sqrt(np.mean((run.tension[late, i] - pull[late]) ** 2))
        assert off <= 1e-3 * pull.max() and pull[late].std() > 1e-2 * pull.max(), (body, off / pull.max())


def test_what_there_is_not_yet_is_refused_in_a_line(pair):
    own = hawser("own", "ship", (0.0, 25.0, 1.0), (5.0, 25.0, 1.0), "ship")
    with pytest.raises(ValueError, match="line own runs from ship to itself; allowed: to an anchor or another body"):
        body_lines(system(own))
    with pytest.raises(SimulationError, match='"half-waves" with several bodies; allowed: "newman"'):
        known = replace(pair.reader, between=replace(pair.reader.between, quantities={
            **pair.reader.between.quantities, "drift_force": np.zeros((len(OMEGA), 24, 3))}))  # fmt: skip
        waves = Weather(regular=Waves(1.0, 9.0, 0.0))
        simulate(replace(pair, reader=known), waves, Settings(10.0, memory="constant", slow_drift="half-waves"))
    with pytest.raises(SimulationError, match="offset or velocity has 6 numbers for 12 motions"):
        simulate(pair, Weather(), Settings(10.0, **STILL | {"constant_period": 9.0}, offset=(1.0,) * 6))
