"""Hinges between bodies in time: as in the frequency domain, as springs that grow stiff, and keeping what they must."""

from dataclasses import replace

import numpy as np
import pytest
from made_up_body import INERTIA, OMEGA, STIFFNESS
from two_bodies import coupled_bodies, two_bodies

from hakobune.bem.hinges import Link
from hakobune.bem.time_domain.memory import MemoryArrays, no_memory
from hakobune.mooring.motion.links import links_of, rows_at
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.simulation.linked import begin_together
from hakobune.mooring.motion.wave_loads import no_wave_forces, wave_table
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Waves

AROUND = np.arange(24) * (np.pi / 12)
SPRING, DRAG = np.diag([3e6, 2e6, 0, 0, 0, 3e9]), 0.05 * INERTIA
STILL = {"memory": "constant", "slow_drift": "none", "tolerance": 1e-5}
AT = (4.0, -30.0, 2.0)  # of the ship: (4, 0, 2) in the scene
JOINT = Link("joint", ("ship", "barge"), AT, (1.0, 0.0, 0.0))
SLIDE = Link("slide", ("ship", "barge"), AT, (0.3, 0.1, 1.0), "slider", 6e6, 2e6)
PIN = Link("pin", ("space", "barge"), (20.0, -25.0, 1.0), kind="ball")
POST = Link("post", ("pier", "barge"), (20.0, -25.0, 1.0), (0.0, 0.0, 1.0))
I, J = 16, 3  # of frequency and heading


def twice(matrix):
    return np.kron(np.eye(2), matrix)


@pytest.fixture(scope="module")
def held(coupled):
    """Function of links and a spring (12, 12) beside that of both"""
    body, waves = coupled

    def made(*links, spring=0.0, memory=None):
        spring, linked = twice(SPRING) + spring, body.linked(links)
        return moored(linked, memory=memory or no_memory(body), spring=spring, damping=twice(DRAG), waves=waves)

    return made


def slides():
    """(3, 12) how far the point AT goes from the ship's to the barge's, which heads the other way: by hand"""
    arms = [np.array([4.0, 0.0, 2.0]) - place for place in ((0.0, 30.0, 1.0), (12.0, -30.0, 1.0))]
    rows = [np.hstack([np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]]) for x, y, z in arms]
    turn = np.kron(np.eye(2), np.diag([-1.0, -1.0, 1.0]))
    return np.hstack([-rows[0], rows[1] @ turn])


def remembering(body):
    """Memory of both together, of one state that decays and a pair that turns"""
    share = np.sqrt(0.4 * np.tile(np.diag(INERTIA), 2))[:, None]
    into = share * np.array([[1.0, 0.5, 0.2], [0.3, -1.0, 0.4]])[np.arange(12) // 6] * np.cos(np.arange(12))[:, None]
    arrays = MemoryArrays(np.array([0.4, 0.3, 0.3]), np.array([0.6]), into, into)
    return replace(no_memory(body), arrays=arrays)


@pytest.mark.parametrize("link", [JOINT, SLIDE, PIN])
def test_regular_waves_move_linked_bodies_as_in_the_frequency_domain(held, link, coupled):
    """Amplitudes, phases and what the link holds; after the ramp, by least squares over four periods

    A slider with its spring and damper, and the memory of the water with it; a ball from space.
    """
    w, a, memory = OMEGA[I], 1e-3, remembering(coupled[0]) if link is SLIDE else None
    T = 2 * np.pi / w
    bodies, how = held(link, memory=memory), STILL | {"memory": "states" if memory else "constant"}
    run = simulate(bodies, Weather(regular=Waves(2 * a, T, AROUND[J])), Settings(44 * T, 20 * T, T / 20, **how))
    (A,), (B,) = bodies.reader.coefficients(np.array([w]))
    D = -(w**2) * (twice(INERTIA) + A) - 1j * w * (B + twice(DRAG)) + twice(STIFFNESS + SPRING)
    if memory:
        D = -(w**2) * (twice(INERTIA) + memory.added_mass_infinity) + twice(STIFFNESS + SPRING)
        D = D - 1j * w * (twice(DRAG) + memory.transform(w)[0])
        row = np.array(link.axis) @ slides() / np.linalg.norm(link.axis)
        D = D + (link.stiffness - 1j * w * link.damping) * np.outer(row, row)
    F = bodies.reader.between.quantities["excitation_force"][I, J]
    G = rows_at(links_of(bodies.reader), bodies.reader.axes_at_rest * [0, 0, 0, 0, 0, 1])[0]
    exact = np.linalg.solve(np.block([[D, -G.T], [G, np.zeros((len(G),) * 2)]]), np.concatenate([F, np.zeros(len(G))]))
    mu = exact[12:]  # along and about the axes of the first, as of a slider those that it holds
    exact = np.concatenate([exact[:12], mu[: len(link.along)] @ link.along])
    if memory:
        exact = np.append(exact, row @ exact[:12])
        exact[12:15] += (1j * w * link.damping - link.stiffness) * exact[15] * np.array(link.axis) / np.sqrt(1.1)
    late = run.time >= 40 * T
    t = run.time[late] + 20 * T
    turn = np.stack([np.cos(w * t), np.sin(w * t), np.ones_like(t)], axis=1)
    series = np.column_stack([run.motion, run.links[:, 0, :3], run.links[:, 0, 6]])[late]
    found = np.linalg.lstsq(turn, series / a, rcond=None)[0]
    off = np.abs((found[0] + 1j * found[1])[: len(exact)] - exact)
    assert off[:12].max() < 5e-5 * np.abs(exact[:12]).max() and off[12:15].max() < 5e-5 * np.abs(exact[12:15]).max()
    if link is PIN:
        assert not run.links[:, 0, 3:].any()
    elif link is JOINT:
        assert np.abs(run.links[:, 0, 3]).max() < 1e-9 * np.abs(run.links[:, 0, 4]).max()  # none about its axis
    else:
        assert off[15] < 5e-5 * abs(exact[15])


def test_the_course_of_a_model_is_foreseen_as_far_in_periods_as_that_of_a_ship(held):
    """1:70: over one of its waves, not ten; of ships in waves of 5 s and more 6 s"""
    forces = held().waves
    for period, window in ((12.0, 6.0), (5.0, 6.0), (0.6, 0.72)):
        one = (np.array([part]) for part in (2 * np.pi / period, 1.0, 0.0, 0.0))
        table = wave_table(forces, tuple(one), 20.0, np.zeros((2, 3)), 9.80665, heading=(0.0, 0.0))
        assert window <= table.window < window + table.step


@pytest.mark.parametrize("kind", ["slider", "hinge"])
def test_a_spring_moves_two_bodies_as_far_as_by_hand(held, kind):
    """k (s − rest) between two equal bodies 12 m and 60 m apart, of C and K22 each, at a point between and 1 m above

    Slider along z: heave −z and z, roll φ, pitch θ of both: Cz = F, 2C₄₄φ = 60F, 2C₅₅θ = −12F, s = 2z + 60φ − 12θ.
    Hinge about x: roll −φ and φ, sway −φ and φ 1 m: (C₄₄ + K₂₂)φ = M, s = 2φ.
    """
    C33, C44, C55, K22 = STIFFNESS[2, 2], STIFFNESS[3, 3], STIFFNESS[4, 4], SPRING[1, 1]
    k, rest = (3e6, 0.01) if kind == "slider" else (2e9, 1e-3)
    gives = 2 / C33 + 1800 / C44 + 72 / C55 if kind == "slider" else 2 / (C44 + K22)
    pull = k * rest / (1 + k * gives)
    bodies = held(JOINT._replace(kind=kind, axis=(0.0, 0.0, 1.0) if kind == "slider" else (1.0, 0.0, 0.0),
                                 stiffness=k, rest=rest))  # fmt: skip
    if kind == "slider":
        wanted = {2: -pull / C33, 8: pull / C33, 3: 30 * pull / C44, 9: -30 * pull / C44}  # the barge heads astern
    else:
        wanted = {3: -pull / (C44 + K22), 9: -pull / (C44 + K22)}
    assert [bodies.start[i] for i in wanted] == pytest.approx(list(wanted.values()), rel=1e-4)
    run = simulate(bodies, Weather(), Settings(10.0, 0.0, 1.0, **STILL | {"constant_period": 9.0}))
    assert np.abs(run.motion - run.motion[0]).max() < 1e-8
    told = run.links[-1, 0]
    assert told[2 if kind == "slider" else 3] == pytest.approx(pull, rel=1e-4)
    assert told[6] == pytest.approx(pull * gives, rel=1e-4)


def test_a_hinge_is_where_springs_grow_stiff_to_first_order(held):
    """On a pier: springs of k at the same point, and k (30 m)² against turning about x and y"""
    waves, how = Weather(regular=Waves(2e-3, 2 * np.pi / OMEGA[I], AROUND[J])), Settings(10.0, 10.0, 1.0, **STILL)
    bodies = held(POST)
    G = rows_at(links_of(bodies.reader), bodies.reader.axes_at_rest * [0, 0, 0, 0, 0, 1])[0]
    G[3:] *= 30.0
    exact = simulate(bodies, waves, how).motion
    errors = [np.abs(simulate(held(spring=k * G.T @ G), waves, how).motion - exact).max() for k in (5e8, 2e9)]
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)


def test_what_a_hinge_gives_one_body_it_takes_from_the_other():
    """Its work is nothing where both move as one, along and about any axis, in any place that it holds them in"""
    rng = np.random.default_rng(5)
    for kind in ("hinge", "ball", "rigid", "slider"):
        body = two_bodies().linked([JOINT._replace(kind=kind)])
        links, rest = links_of(body), body.axes_at_rest * [0, 0, 0, 0, 0, 1]
        poses = rest + rng.normal(size=(2, 6)) * [2, 2, 1, 0.2, 0.2, 0.3]
        poses, _ = begin_together(links, np.diag(1 / np.diag(body.inertia)), poses, np.zeros((2, 6)))
        G, gap = rows_at(links, poses)
        speed, turn = rng.normal(size=(2, 3))
        moves = []
        for pose, place in zip(poses, links.place, strict=True):
            _, b, c = pose[3:]
            heading = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
            about = heading @ [[np.cos(b), 0, 0], [0, 1, 0], [-np.sin(b), 0, 1]]
            moves += [*(heading.T @ (speed + np.cross(turn, place + pose[:3]))), *np.linalg.solve(about, turn)]
        assert np.abs(gap).max() < 1e-11 and np.abs(G @ moves).max() < 1e-11 * np.abs(moves).max()


def test_a_hinged_pair_that_floats_freely_keeps_energy_and_its_hinge():
    """Rolling against each other and turning, about a point far from both"""
    added, damping = (np.array([share * twice(INERTIA)] * len(OMEGA)) for share in (0.5, 1e-12))
    quiet = two_bodies(AROUND, added_mass=added, radiation_damping=damping).linked([JOINT._replace(kind="ball")])
    free = moored(quiet, memory=no_memory(quiet), waves=no_wave_forces(quiet))
    speed = np.zeros(12)
    speed[[0, 1, 2, 3, 5, 8, 9, 11]] = 0.3, 0.2, 0.3, 0.02, 0.01, -0.2, 0.03, -0.005
    how = STILL | {"constant_period": 10.0, "tolerance": 1e-6}
    run = simulate(free, Weather(), Settings(100.0, 0.0, 1.0, **how, velocity=tuple(speed)))
    energy = sum(0.75 * INERTIA[i, i] * run.velocity[:, i::6] ** 2 for i in range(6)).sum(axis=1)
    energy += sum(0.5 * STIFFNESS[i, i] * (run.motion[:, i::6]) ** 2 for i in (2, 3, 4)).sum(axis=1)
    gaps = [np.abs(rows_at(links_of(quiet), pose)[1]).max() for pose in run.poses]
    assert np.ptp(energy) < 1e-6 * energy.max() and max(gaps) < 1e-6 and np.ptp(run.motion[:, 5]) > 0.1


def test_a_hinge_to_a_pier_holds_and_an_offset_is_carried_to_where_it_can_be(held):
    bodies = held(JOINT, POST)
    offset = np.zeros(12)
    offset[5] = 0.3
    run = simulate(
        bodies, Weather(), Settings(20.0, 0.0, 1.0, **STILL | {"constant_period": 9.0}, offset=tuple(offset))
    )
    links = links_of(bodies.reader)
    assert max(np.abs(rows_at(links, pose)[1]).max() for pose in run.poses) < 1e-5
    assert np.abs(rows_at(links, run.poses[0])[1]).max() < 1e-11 and abs(run.motion[0, 5]) > 0.05
    assert np.abs(run.motion[:, 9:11]).max() < 1e-6  # the barge turns about the post alone


def test_a_top_heavy_pair_is_refused():
    bodies = coupled_bodies(AROUND).linked([JOINT])
    C = twice(STIFFNESS)
    C[3, 3] = C[9, 9] = -C[3, 3]
    with pytest.raises(ValueError, match=r"hinges joint: .* roll is unstable at rest"):
        moored(replace(bodies, stiffness=C), memory=no_memory(bodies))
