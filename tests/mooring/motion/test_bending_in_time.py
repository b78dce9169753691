"""Bodies that bend in time: as in the frequency domain, as by hand, as rigid where stiff, and keeping their energy."""

from dataclasses import replace

import numpy as np
import pytest
from bending_body import bending, hinged_as_a_shape, two_of_which_one_bends
from made_up_body import INERTIA, OMEGA
from two_bodies import DEPTH, coupled_bodies, twice

from hakobune.bem.hinges import Link, driven, forces_of, rows_of
from hakobune.bem.time_domain.memory import MemoryArrays, no_memory
from hakobune.mooring.fenders.fender import fender_of_points
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.ropes import RopePart, rope
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_bodies, moored_body
from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.motion.contacts import QuayFender, berth_of
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.wave_loads import no_wave_forces
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.response.points import Point, of_point
from hakobune.mooring.studies.conditions import Afloat, ExposedBox, Waves

AROUND = np.arange(24) * (np.pi / 12)
RIG = np.diag([3e6, 2e6, 0, 0, 0, 3e9])
STILL = {"memory": "constant", "slow_drift": "none", "tolerance": 1e-5}
I, J = 16, 3  # of frequency and heading
T = 2 * np.pi / OMEGA[I]


def on_springs(body, memory=None, to_shapes=0.0, **more):
    """`Moored` on springs in surge, sway and yaw, with 5 % of the mass as damping; to_shapes : N, N m from these"""
    spring = np.zeros_like(body.inertia)
    for first in range(0, body.rigid, 6):
        spring[first : first + 6, first : first + 6] = RIG
        spring[first : first + 6, body.rigid :] = to_shapes * np.sign(np.diag(RIG))[:, None]
        spring[body.rigid :, first : first + 6] = spring[first : first + 6, body.rigid :].T
    return moored(body, memory=memory or no_memory(body), spring=spring, damping=0.05 * body.inertia, **more)


def remembering(body):
    """Memory of all motions together, of one state that decays and a pair that turns"""
    count = np.arange(len(body.words))
    share = np.sqrt(0.4 * np.diag(body.inertia))[:, None]
    into = share * np.cos(count[:, None] * np.array([1.0, 2.0, 3.0])) * 0.5
    arrays = MemoryArrays(np.array([0.4, 0.3, 0.3]), np.array([0.6]), into, into)
    return replace(no_memory(body), arrays=arrays)


def amplitudes(run, series, late=40):
    """(k,) complex amplitude of series (n, k) over the last periods of a run in the wave I, by least squares"""
    after, t = run.time >= late * T, run.time[run.time >= late * T] + 20 * T
    turn = np.stack([np.cos(OMEGA[I] * t), np.sin(OMEGA[I] * t), np.ones_like(t)], axis=1)
    found = np.linalg.lstsq(turn, series[after], rcond=None)[0]
    return found[0] + 1j * found[1]


@pytest.mark.parametrize(
    ("make", "to_shapes"),
    [(bending, 0.0), (two_of_which_one_bends, 0.0), (two_of_which_one_bends, 1e6)],
    ids=["one", "of two", "sprung"],
)
def test_regular_waves_bend_a_body_as_in_the_frequency_domain(make, to_shapes):
    """Six motions and shapes, eight of them in two groups, amplitude and phase, with the memory of the water"""
    body, a = make(4), 1e-3
    held, w = on_springs(body, remembering(body), to_shapes), OMEGA[I]
    how = Settings(44 * T, 20 * T, T / 20, **STILL | {"memory": "states"})
    run = simulate(held, Weather(regular=Waves(2 * a, T, AROUND[J])), how)
    B = body.damping + held.damping + held.memory.transform(w)[0]
    D = -(w**2) * (body.inertia + held.memory.added_mass_infinity) - 1j * w * B
    F = body.between.quantities["excitation_force"][I, J]
    exact = np.linalg.solve(D + body.stiffness + held.spring, F)
    off = np.abs(amplitudes(run, run.motion / a) - exact)
    assert run.motion.shape[1] == len(body.words) == len(exact)
    assert off[: body.rigid].max() < 1e-4 * np.abs(exact[: body.rigid]).max()
    assert off[body.rigid :].max() < 1e-4 * np.abs(exact[body.rigid :]).max()


def test_a_bent_body_let_go_swings_as_a_mass_on_a_spring():
    """x₀ e^{−dt} (cos pt + d/p sin pt), d = B/2(m + A), p² = K/(m + A) − d², of a shape that nothing couples

    B of the structure, of the water and what is given.
    """
    body, at = bending(1, more=10.0, coupled=False, kinds=("vertical bending",)), 6
    held = moored(body, memory=no_memory(body), damping=0.1 * body.inertia, waves=no_wave_forces(body))
    (A,), (B,) = body.coefficients(np.array([2 * np.pi / 8]))
    start = np.zeros(7)
    start[at] = 0.1
    run = simulate(held, Weather(), Settings(20.0, 0.0, 0.1, **STILL, constant_period=8.0, offset=tuple(start)))
    mass = body.inertia[at, at] + A[at, at]
    d = 0.5 * (0.1 * body.inertia[at, at] + body.damping[at, at] + B[at, at]) / mass
    p = np.sqrt(body.stiffness[at, at] / mass - d**2)
    exact = 0.1 * np.exp(-d * run.time) * (np.cos(p * run.time) + d / p * np.sin(p * run.time))
    assert p * 20.0 > 30 and np.abs(run.motion[:, at] - exact).max() < 2e-5 * 0.1
    assert np.abs(run.motion[:, :6]).max() < 1e-12


def test_a_stiff_body_moves_as_a_rigid_one_and_nearer_the_stiffer_it_is():
    """By 1/EI; coefficients at one frequency"""
    off, a = [], 1e-2
    weather, how = Weather(regular=Waves(2 * a, T, AROUND[J])), Settings(4 * T, 2 * T, T / 20, **STILL)
    soft = bending(1)
    six = np.ix_(range(6), range(6))
    quantities = {name: value[..., :6] for name, value in soft.between.quantities.items()}
    quantities |= {name: quantities[name][:, :6] for name in ("added_mass", "radiation_damping")}
    rigid = replace(
        soft, between=replace(soft.between, quantities=quantities, shapes=()), inertia=soft.inertia[six],
        stiffness=soft.stiffness[six], damping=soft.damping[six], modes=(),
    )  # fmt: skip
    wanted = simulate(on_springs(rigid), weather, how).motion
    fixed = simulate(on_springs(bending(1, more=1e6), motions=range(6)), weather, how).motion
    assert np.abs(fixed[:, :6] - wanted).max() < 1e-9 * a and not fixed[:, 6:].any()
    for more in (400.0, 1600.0):
        run = simulate(on_springs(bending(1, more=more)), weather, how)
        off.append(np.abs(run.motion[:, :6] - wanted).max(axis=0) / np.abs(wanted).max(axis=0))
    assert off[1].max() < 1e-3 and 3.0 < off[0].max() / off[1].max() < 5.0, off


def test_lines_and_fenders_on_a_body_that_bends_keep_its_energy():
    """Kinetic energy, that of water and structure, T²/2k of a hawser and a rope, kδ²/2 of a fender, less what damping
    takes; let go, bent and moved, with the hawser at one end and fender and rope at the other"""
    body, k = bending(2), 2e7
    away = np.hypot(np.hypot(40.0, 15.0), 3.0)
    tie = Leg(Hawser("tie", pull_of_points("tie", [0.0, 10.0], [0.0, 10 * k]), 0.99 * away, "", ""),
              (-88.0, 25.0, 4.0), (-48.0, 10.0, 1.0))  # fmt: skip
    lines = moored_body([tie], DEPTH, body.rotation_center, 1025.0, 9.80665)
    spring = fender_of_points("spring", 1.0, [0.0, 1.0], [0.0, 2e7])
    fender = QuayFender("F", spring, np.array([40.0, 20.0, 1.0]), np.array([0.0, 1.0, 0.0]), 20.0)
    tight = rope("R", (70.0, 40.0, 4.0), (45.0, 20.0, 5.0), RopePart(2e7, 0.2), 5e5)
    berth = berth_of([fender], [tight], body.rotation_center)
    held = moored(body, lines, memory=no_memory(body), berth=berth, waves=no_wave_forces(body))
    start = np.zeros(len(body.words))
    start[[1, 3, 6, 7, 8]] = -0.1, 0.01, 0.2, -0.1, 0.01
    how = Settings(20.0, 0.0, 0.05, memory="constant", slow_drift="none", tolerance=1e-7, constant_period=8.0,
                   offset=tuple(start))  # fmt: skip
    run = simulate(held, Weather(), how)
    (A,) = body.coefficients(np.array([2 * np.pi / 8]))[0]
    kinetic = 0.5 * np.einsum("ti,ij,tj->t", run.velocity, body.inertia + A, run.velocity)
    still = 0.5 * np.einsum("ti,ij,tj->t", run.motion, body.stiffness, run.motion)
    of_rope = 2e7 / (0.2 * tight.length)
    pulls = np.stack([run.tension[:, 0] ** 2 / k, run.pull[:, 0] ** 2 / of_rope, 2e7 * run.deflection[:, 0] ** 2])
    total = kinetic + still + 0.5 * pulls.sum(axis=0)
    assert np.all(np.ptp(pulls, axis=1) > 1e-3 * total[0]), np.ptp(pulls, axis=1) / total[0]
    assert np.abs(run.motion[:, 6]).max() > 0.15
    assert abs(total[-1] - total[0] - run.work["damping"]) < 1e-6 * total[0]


def test_what_joins_two_bodies_keeps_the_energy_of_the_one_that_bends():
    """A hawser with its fairlead on the barge, one with its bollard there, a rope and a fender of the barge"""
    pair, k = two_of_which_one_bends(2, ("vertical bending", "horizontal bending")), 5e6
    ship, _, barge = pair.bodies
    pull = pull_of_points("tie", [0.0, 10.0], [0.0, 10 * k])
    ends = ((-35.0, 20.0, 1.0), (-35.0, -20.0, 2.0), "barge"), ((50.0, -18.0, 2.0), (52.0, 20.0, 1.0), "ship")
    legs = [Leg(Hawser(f"to {to}", pull, 0.99 * np.linalg.norm(np.subtract(end, lead)), "", ""), end, lead, body, to)
            for (end, lead, body), to in zip(ends, ("ship", "barge"), strict=True)]  # fmt: skip
    lines = moored_bodies(legs, {one.name: (one.rotation_center, one.heading) for one in (ship, barge)}, DEPTH)
    box = ExposedBox(100.0, 30.0, 8.0, 5.0)
    hulls = [Afloat(one.name, box, one.own_center, np.array(one.place), one.heading, 1025.0) for one in (ship, barge)]
    spring = fender_of_points("spring", 1.0, [0.0, 1.0], [0.0, 5e6])
    fender = QuayFender("F", spring, np.array([45.0, 15.0, 1.0]), np.array([0.0, -1.0, 0.0]), 15.0)
    tight = rope("R", (-30.0, -12.0, 3.0), (-30.0, 16.0, 5.0), RopePart(2e7, 0.2), 5e5)
    berth = berth_of([fender], [tight], None, hulls, [(0, 1), (0, 1)])
    held = on_springs(pair, system=lines, berth=berth, waves=no_wave_forces(pair))
    start = np.zeros(len(pair.words))
    start[[1, 7, 9, 12, 13, 14, 15]] = 0.1, 0.1, 0.01, 0.3, -0.1, 0.3, 0.1
    how = Settings(20.0, 0.0, 0.05, **STILL | {"tolerance": 1e-7}, constant_period=8.0, offset=tuple(start))
    run = simulate(held, Weather(), how)
    (A,) = pair.coefficients(np.array([2 * np.pi / 8]))[0]
    total = 0.5 * np.einsum("ti,ij,tj->t", run.velocity, pair.inertia + A, run.velocity)
    total += 0.5 * np.einsum("ti,ij,tj->t", run.motion, pair.stiffness + held.spring, run.motion)
    of_rope = 2e7 / (0.2 * tight.length)
    pulls = [*(run.tension**2 / k).T, run.pull[:, 0] ** 2 / of_rope, 5e6 * run.deflection[:, 0] ** 2]
    total += 0.5 * np.sum(pulls, axis=0)
    assert np.all(np.ptp(pulls, axis=1) > 1e-3 * total[0]) and np.all(np.ptp(run.motion[:, 12:], axis=0) > 0.02)
    assert abs(total[-1] - total[0] - run.work["damping"]) < 1e-6 * total[0]


def chains(body):
    """`System` of two chains at the ends of the beam"""
    kind = line_type("R3 studless 76 mm")
    legs = [
        Leg(UniformLine(name, kind, 170.0, "", ""), (x * 4.2, y, -DEPTH), (x, y, -1.0))
        for name, x, y in (("fore", 49.0, 15.0), ("aft", -49.0, 15.0))
    ]
    return moored_body(legs, DEPTH, body.rotation_center, 1025.0, 9.80665)


def test_chains_bend_a_body_at_rest_by_their_pull_on_its_shapes():
    """K ξ = Σ f · u of the two fairleads, u by hand: (−(z − z₀) w′, 0, w) at 49 m, 1 m below the axis"""
    body = bending(2, coupled=False, kinds=("vertical bending",))
    held = moored(body, chains(body), memory=no_memory(body), waves=no_wave_forces(body))
    run = simulate(held, Weather(), Settings(10.0, 0.0, 0.5, **STILL, constant_period=8.0))
    assert np.abs(run.motion - run.motion[0]).max() < 1e-7  # it is at rest
    fore = run.tension[0, 0]
    xi, shapes = held.start[6:], [mode.shape for mode in body.modes]
    place = np.array([49.0, 15.0, -1.0])
    system = held.system
    pull = system.load(system.pose).force  # of the undisturbed place: heave changes the pull by a few per mille
    for i, shape in enumerate(shapes):
        w, slope = shape.along(49.0), shape.along(49.0, 1)
        both = (w, shape.along(-49.0)), (slope, shape.along(-49.0, 1))
        down = 0.5 * pull[2]
        ahead = -np.sqrt(fore**2 - down**2)  # of the fore chain, to its anchor: +x
        by_hand = down * sum(both[0]) + abs(ahead) * (both[1][0] - both[1][1])
        assert body.stiffness[6 + i, 6 + i] * xi[i] == pytest.approx(by_hand, rel=0.02, abs=1e-3 * abs(down)), (
            i,
            place,
        )


def test_a_hinge_as_a_shape_moves_as_a_hinge_that_is_held():
    """Two bodies with a hinge, and the same as one body whose shape it is; in a wave, and the moments are small"""
    a, pair = 1e-3, coupled_bodies(AROUND)
    one, to_pair = hinged_as_a_shape(pair, JOINT)
    weather, how = Weather(regular=Waves(2 * a, T, AROUND[J])), Settings(4 * T, 2 * T, T / 20, **STILL)
    spring, drag = twice(RIG), 0.05 * twice(INERTIA)
    held = moored(pair.linked((JOINT,)), memory=no_memory(pair), spring=spring, damping=drag)
    shape = moored(
        one, memory=no_memory(one), damping=to_pair.T @ drag @ to_pair, spring=to_pair.T @ spring @ to_pair,
    )  # fmt: skip
    runs = [simulate(body, weather, how).motion for body in (held, shape)]
    assert np.abs(runs[1] @ to_pair.T - runs[0]).max() < 1e-4 * np.abs(runs[0]).max()


JOINT = Link("joint", ("ship", "barge"), (4.0, -30.0, 2.0), (1.0, 0.0, 0.0))


def test_a_hinge_on_a_body_that_bends_holds_the_point_that_its_shapes_move():
    """A ball from space and a hinge from the rigid ship, in the frequency domain: its point is still, or moves alike"""
    pair, waves = two_of_which_one_bends(2), (OMEGA[[4, I]], AROUND[[J]])
    ship, _, barge = pair.bodies
    pin = Link("pin", ("space", "barge"), (20.0, -25.0, 1.0), kind="ball")
    for link, place, others in ((pin, pin.position, ()), (JOINT, (4.0, 0.0, 2.0), (ship,))):
        held = pair.linked((link,))
        X, ends = held.motions(*waves), []
        for one in (barge, *others):
            own = one.axes.T @ (place - np.array((*one.place, 0.0)))
            ends.append(of_point(held, X, Point("", tuple(own), None, one.name))[0] @ one.axes.T)
        assert np.abs(X[..., 12:]).max() > 1e-3 * np.abs(X).max()
        assert np.abs(ends[0] - (ends[1] if others else 0.0)).max() < 1e-9 * np.abs(X).max()


@pytest.mark.parametrize("link", [
    JOINT, JOINT._replace(kind="slider", axis=(0.3, 0.1, 1.0), damping=6e5, stiffness=2e6),
], ids=lambda one: one.kind)  # fmt: skip
def test_a_hinge_on_a_body_that_bends_moves_as_in_the_frequency_domain(link):
    """Amplitude and phase of all motions in a regular wave, with the memory of the water; its forces too"""
    free, a, w = two_of_which_one_bends(2), 1e-3, OMEGA[I]
    body = free.linked((link,))
    held = on_springs(body, remembering(body))
    how = Settings(44 * T, 20 * T, T / 20, **STILL | {"memory": "states"})
    run = simulate(held, Weather(regular=Waves(2 * a, T, AROUND[J])), how)
    whole = driven(body)
    B = whole.damping + held.damping + held.memory.transform(w)[0]
    D = -(w**2) * (body.inertia + held.memory.added_mass_infinity) - 1j * w * B + whole.stiffness + held.spring
    F, Z = body.between.quantities["excitation_force"][I, J], body.free
    exact = Z @ np.linalg.solve(Z.T @ D @ Z, Z.T @ F)
    off = np.abs(amplitudes(run, run.motion / a) - exact)
    assert off[:12].max() < 1e-4 * np.abs(exact[:12]).max() and off[12:].max() < 1e-4 * np.abs(exact[12:]).max()
    parts = slice(0, 3) if link.kind == "hinge" else slice(3, 6)  # without its spring and damper
    rows = rows_of(body, link)
    (pull,) = forces_of((link,), rows, (D @ exact - F)[None, None])[0]
    off = np.abs(amplitudes(run, run.links[:, 0, parts] / a) - pull[0, parts])
    assert off.max() < 1e-3 * np.abs(pull[0, parts]).max() and np.abs(pull[0, parts]).max() > 1e4


def test_what_cannot_be_followed_is_refused_in_a_line():
    stiff = bending(1, more=1e6)
    with pytest.raises(
        ValueError, match=r"vertical bending 1 has a natural frequency of .* rad/s, limit 300: .* fewer"
    ):
        on_springs(stiff)
    held = on_springs(stiff, motions=range(6))  # the way out
    assert held.free == tuple(range(6))
    top = bending(1)
    top.stiffness[3, 3] = -1e9
    with pytest.raises(ValueError, match="the body capsizes: its restoring in roll"):
        on_springs(top)
    pinned = bending(1).linked((Link("pin", ("space", "body"), (0.0, 0.0, 0.0), kind="ball"),))
    with pytest.raises(ValueError, match=r"simulation\.motions holds vertical bending 1, torsion 1, and hinges pin"):
        on_springs(pinned, motions=range(6))
