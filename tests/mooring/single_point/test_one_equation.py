"""A body in one equation with its buoy, against what must be true: statics, linear motion, energy, limits."""

from dataclasses import replace

import numpy as np
import pytest
from boxes import RHO, floater_A
from scipy.linalg import expm

from hakobune.mooring.lines.ropes import RopePart
from hakobune.mooring.lines.system.graph import Pose
from hakobune.mooring.lines.system.parts import MooredBody
from hakobune.mooring.motion import buoy as buoys
from hakobune.mooring.motion.buoy import BuoyBody, pull_of_rope
from hakobune.mooring.motion.simulation import simulate
from hakobune.mooring.motion.wave_loads import no_waves
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.single_point.body import NO_POINTS, Hold, SinglePointError
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.one_equation import body_at, run_in_one
from hakobune.mooring.single_point.slewing import linearised, slew, turned_state

BUOY, ROPE = BuoyBody(150e3, 8.0, 5.0, drag=(0.0, 0.0)), RopePart(2e7, 1.0)
LENGTH = 25.0


def floating_point(current=30.0, turning=True):
    point = floater_A(current, LENGTH)
    body = point.system.bodies[0]
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = RHO * point.system.gravity * 0.25 * np.pi * BUOY.diameter**2
    freed = MooredBody("buoy", body.position, ("Surge", "Sway", "Heave"), stiffness)
    if not turning:
        water = point.loads.water
        still = replace(water, table=water.table * (np.arange(5) == 0)[:, None], turning=False, quadratic=1e9,
                        linear=np.diag([1e4, 3e4, 1e8]))  # fmt: skip
        point = replace(point, loads=replace(point.loads, water=still))
    return replace(point, system=replace(point.system, bodies=(freed,)))


TILTS = replace(BUOY, lever=1.5)


@pytest.fixture(scope="module", params=[True, False], ids=["turning tests", "current coefficients"])
def steady(request):
    return next(one for one in equilibria(floating_point(turning=request.param)) if one.slewing.stable)


def placed(steady, turn=0.0, buoy=BUOY, rope=ROPE):
    return body_at(steady, turned_state(steady.point, steady.state, turn), buoy=buoy, rope=rope)


@pytest.mark.parametrize("kind", [BUOY, TILTS], ids=["upright", "tilts"])
def test_at_rest_the_body_stays_and_pulls_as_in_statics(steady, kind):
    body = placed(steady, buoy=kind)
    found = run_in_one(steady, body, 60.0, 0.5, tolerance=1e-6)
    assert np.abs(found.motion - body.start).max() < 1e-6 and np.abs(found.buoy[:, :3] - body.buoy.start).max() < 1e-6
    assert np.allclose(found.hawser, steady.hawser, rtol=1e-6)
    assert np.allclose(found.buoy_lines, steady.lines.lines.tension_b, rtol=1e-6)


def hawser_forces(steady, body, place, rope):
    """(6,) force on the body in its axes, in the plane, and on the buoy in space; place (6,) x, y, ψ and of the buoy"""
    x, y, psi = place[:3]
    R = np.array([[np.cos(psi), -np.sin(psi)], [np.sin(psi), np.cos(psi)]])
    arm = R @ steady.point.ends[0]
    z0 = steady.point.system.bodies[0].position[2]
    d = np.array([*(place[3:5] - [x, y] - arm), z0 + place[5] + body.buoy.level])
    away = np.sqrt(d @ d)
    pull = rope.breaking_load * ((away - LENGTH) / (LENGTH * rope.strain)) ** rope.exponent
    f = pull * d / away
    return np.array([*(R.T @ f[:2]), arm[0] * f[1] - arm[1] * f[0], *-f])


def linear_system(steady, body, rope):
    """(12, 12) derivative of place and velocity of body and buoy about their equilibrium, from their parts"""
    point, base = steady.point, np.array([*body.start[:2], body.start[5], *body.buoy.start])
    G = np.empty((6, 6))
    for j in range(6):
        h = np.eye(6)[j] * (1e-6 if j == 2 else 1e-5)
        G[:, j] = hawser_forces(steady, body, base + h, rope) - hawser_forces(steady, body, base - h, rope)
        G[:, j] /= 2 * h[j]
    held = Hold(-steady.force, steady.hawser, steady.buoy)
    J = np.zeros((12, 12))
    J[:6, 6:] = np.eye(6)
    hull = linearised(point, steady.state, held)
    cos, sin = np.cos(steady.heading), np.sin(steady.heading)
    R = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    J[6:9, 6:9] = hull[3:, 3:]
    J[6:9, :3] = hull[3:, :3] + R @ point.inverse @ point.stiffness(steady.heading, held)  # no mooring is left
    J[6:9, :6] += R @ point.inverse @ G[:3]
    system = point.system
    z = system.bodies[0].position[2] + body.buoy.start[2]
    lines = system.load(Pose(np.array([[*steady.buoy, z]]), system.pose.turn, NO_POINTS))
    K = lines.stiffness[:3, :3].copy()
    K[2, 2] += system.bodies[0].hydrostatic_stiffness[2, 2]
    moved = 1 / (BUOY.mass * (1 + np.array(BUOY.added)[[0, 0, 1]]))
    J[9:, :6] = moved[:, None] * (G[3:] - np.hstack([np.zeros((3, 3)), K]))
    arm = R[:2, :2] @ point.ends[0]
    along = -np.array(hawser_forces(steady, body, base, rope)[3:])
    along /= np.linalg.norm(along)
    rate = np.array([-along[0], -along[1], -(arm[0] * along[1] - arm[1] * along[0]), *along])  # of its elongation
    damping = (
        2
        * buoys.DAMPING
        * np.sqrt(body.buoy.stiffness[0] * BUOY.mass)
        * rate
        * float(steady.hawser[0])
        / (buoys.FULL * rope.breaking_load)
    )
    J[6:9, 6:] += np.outer(R @ point.inverse @ np.array([*(R[:2, :2].T @ -rate[:2]), -rate[2]]), damping)
    J[9:, 6:] += np.outer(-moved * along, damping)
    return J


def test_small_motions_are_those_of_the_linear_system_of_body_and_buoy(steady):
    """Let go beside its rest: displacements in time are those of expm(J t), so that roots and modes are"""
    body = placed(steady)
    J = linear_system(steady, body, ROPE)
    assert np.linalg.eigvals(J).real.max() < 0
    away = 1e-4 * np.array([1.0, -2.0, 0.05, 2.0, 1.0, -1.0])
    start = body.start.copy()
    start[[0, 1, 5]] += away[:3]
    moved = replace(body, start=start, buoy=replace(body.buoy, start=body.buoy.start + away[3:]))
    found = run_in_one(steady, moved, 120.0, 0.5, tolerance=1e-9)
    one, state, exact = expm(0.5 * J), np.array([*away, *np.zeros(6)]), []
    for _ in found.time:
        exact.append(state[:6])
        state = one @ state
    own = np.column_stack([found.motion[:, [0, 1, 5]], found.buoy[:, :3]])
    own -= np.array([*body.start[[0, 1, 5]], *body.buoy.start])
    assert np.abs(own - exact).max(axis=0) == pytest.approx(0, abs=2e-3 * np.abs(away).max())
    assert np.abs(own - exact)[:, 2].max() < 2e-3 * np.abs(np.array(exact)[:, 2]).max()


@pytest.mark.parametrize("kind", [BUOY, TILTS], ids=["upright", "tilts"])
def test_energy_is_kept_by_a_buoy_that_snaps_between_a_drifting_body_and_its_lines(steady, kind, monkeypatch):
    """No water, no loss in the hawser: kinetic energy, buoyancy, lines, hawser and tilt, c(1 − cos θ), together"""
    monkeypatch.setattr(buoys, "DAMPING", 0.0)
    body = placed(steady, buoy=kind)
    settings = Settings(500.0, 0.0, 0.5, 1e-6, slow_drift="none")
    found = simulate(body, Weather(), settings)
    slack = int(np.argmax(found.hawser[:, 0] == 0.0))
    assert slack > 0 and found.hawser[slack:].max() > 0.5 * steady.hawser[0]
    T = steady.point.mass
    own = found.velocity[:, [0, 1, 5]]
    kinetic = 0.5 * np.einsum("ni,ij,nj->n", own, T, own)
    assert np.allclose(kinetic[-1], sum(found.work.values()), rtol=1e-4)
    mass = BUOY.mass * (1 + np.array(BUOY.added)[[0, 0, 1]])
    kinetic = kinetic + 0.5 * (found.buoy[:, 3:] ** 2 @ mass)
    system = steady.point.system
    floats = 0.5 * system.bodies[0].hydrostatic_stiffness[2, 2] * found.buoy[:, 2] ** 2
    cos, sin, end = np.cos(found.motion[:, 5]), np.sin(found.motion[:, 5]), steady.point.ends[0]
    bow = found.motion[:, :2] + np.stack([cos * end[0] - sin * end[1], sin * end[0] + cos * end[1]], axis=1)
    d = np.column_stack([found.buoy[:, :2] - bow, system.bodies[0].position[2] + found.buoy[:, 2] + body.buoy.level])
    stretch = np.maximum(np.linalg.norm(d, axis=1) - LENGTH, 0.0)
    hard = ROPE.breaking_load / (LENGTH * ROPE.strain)
    c = kind.mass * system.gravity * kind.metacentric_height(system.density)
    pulls = np.linspace(0.0, 2 * found.hawser.max(), 20001)
    tilts = np.arctan(pulls * kind.lever / c)
    tilt = np.interp(stretch, pulls / hard + kind.lever * np.sin(tilts), tilts)
    elastic = 0.5 * hard * (stretch - kind.lever * np.sin(tilt)) ** 2 + c * (1 - np.cos(tilt))
    rows = np.arange(0, len(found.time), 12)
    total = np.array([kinetic[i] + floats[i] + elastic[i] + work_to(system, found.buoy[i, :3]) for i in rows])
    assert np.ptp(total) < 1e-3 * (kinetic + elastic).max()


def work_to(system, place):
    """J stored in the lines of a buoy at (3,) m beside its place in the system"""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    origin = np.array(system.bodies[0].position[:3])
    forces = [system.load(Pose((origin + 0.5 * (1 + s) * place)[None], system.pose.turn, NO_POINTS)).force
              for s in nodes]  # fmt: skip
    return -0.5 * weights @ np.array(forces)[:, :3] @ place


def test_a_buoy_without_mass_on_a_stiff_hawser_is_a_hawser_in_series_with_the_lines(steady):
    slow = slew(steady.point, turned_state(steady.point, steady.state, np.radians(4)), 200.0, 1.0, tolerance=1e-7)
    apart = []
    for mass, stiff in ((12e3, 5e7), (3e3, 2e8)):
        light = replace(BUOY, mass=mass, added=(0.0, 0.0))
        body = placed(steady, np.radians(4), light, RopePart(stiff, 1.0))
        body = replace(body, buoy=replace(body.buoy, start=np.array([*slow.buoy[0], body.buoy.start[2]])))
        found = run_in_one(steady, body, 200.0, 1.0, tolerance=1e-5)
        apart.append([np.abs(found.motion[:, 5] - slow.heading).max(), np.abs(found.buoy[:, :2] - slow.buoy).max()])
    assert np.degrees(apart[1][0]) < 0.05 and apart[1][1] < 0.03
    assert np.all(np.array(apart[1]) < 0.5 * np.array(apart[0])), apart


def test_on_a_contact_buoy_the_body_moves_as_in_its_own_slow_equation(steady):
    """Beside current coefficients the inertia of turning axes is that of the filtered velocity: a little off"""
    point = replace(floater_A(30.0), loads=steady.point.loads)
    rest = next(one for one in equilibria(point) if one.slewing.stable)
    start = turned_state(point, rest.state, np.radians(3))
    slow = slew(point, start, 200.0, 1.0, tolerance=1e-9)
    found = run_in_one(rest, body_at(rest, start), 200.0, 1.0, tolerance=1e-7)
    near = 1e-5 if point.loads.water.turning else 1e-3
    assert np.abs(found.motion[:, 5] - slow.heading).max() < near * np.ptp(slow.heading)
    assert np.abs(found.motion[:, :2] - slow.place).max() < near * np.ptp(slow.place, axis=0).max()


def test_a_rope_hardens_slackens_and_never_pushes():
    rope = np.array([10.0, 1e6, 0.2, 2.0, 1e4, 0.6])
    assert pull_of_rope(rope, -0.1, 5.0) == 0.0 and pull_of_rope(rope, 0.1, -100.0) == 0.0
    assert pull_of_rope(rope, 2.0, 0.0) == pytest.approx(1e6)
    assert pull_of_rope(rope, 1.0, 0.0) == pytest.approx(0.25e6)
    assert pull_of_rope(rope, 1e-6, 5.0) == pytest.approx(0.0, abs=0.1)  # without a jump where it comes taut


def test_a_buoy_that_tilts_yields_to_its_hawsers_as_far_as_its_moments_say():
    """Rope and tilt in series: e = L ε_B (T/B)^(1/n) + h sin θ with ΣT h cos θ = c sin θ; two hawsers share the tilt"""
    kind, rope = BuoyBody(5.8, 0.33, 0.11, lever=0.1), RopePart(4e3, 0.25, 2.0)
    system = floating_point().system
    c = kind.mass * system.gravity * kind.metacentric_height(system.density)
    ends = np.zeros((2, 3))
    hung = buoys.BuoyOnLines(kind, system, rope, [1.25, 1.3], ends, np.zeros(3), np.zeros(3), 0.0, np.zeros(2))
    made, work = buoys.buoy_of(hung, no_waves(), 0)
    for first, second in ((30.0, 0.0), (30.0, 5.0), (1e-3, 2e-3), (800.0, 900.0)):
        pull = np.array([first, second])
        theta = np.arctan(pull.sum() * kind.lever / c)
        assert kind.yields(pull.sum(), system) == pytest.approx(kind.lever * np.sin(theta), rel=1e-12)
        work.reach[:, 3] = [1.25, 1.3] * rope.strain_at(pull) + kind.lever * np.sin(theta)
        work.rope[:] = 0.0
        shift, _ = buoys.yielded(made, work)
        found = [pull_of_rope(one, e - shift, 0.0) for one, e in zip(made.ropes, work.reach[:, 3], strict=True)]
        assert np.allclose(found, pull, rtol=1e-7, atol=1e-9 * pull.sum())


def test_a_buoy_that_would_sink_and_a_contact_buoy_are_refused(steady):
    with pytest.raises(SinglePointError, match="floats at"):
        placed(steady, buoy=replace(BUOY, mass=900e3))
    with pytest.raises(SinglePointError, match=r"metacentric height is -\d.* does not float upright"):
        placed(steady, buoy=BuoyBody(20e3, 2.0, 12.0, lever=1.0))
    with pytest.raises(SinglePointError, match="needs the buoy's mass"):
        body_at(steady, steady.state)
    contact = next(one for one in equilibria(floater_A()) if one.slewing.stable)
    with pytest.raises(SinglePointError, match="give a hawser"):
        body_at(contact, contact.state, buoy=BUOY, rope=ROPE)
