"""The equation of two bodies with three groups of shapes, by matrices: every term, its sign, its bodies, its work."""

import numpy as np
import pytest
from plain import plain

from hakobune.bem.time_domain.memory import MemoryArrays

equation, streams = plain("mooring.motion.equation"), plain("mooring.motion.streams")
line_loads, contact_loads = plain("mooring.motion.line_loads"), plain("mooring.motion.contact_loads")
OWNER, SHAPES = np.array([0, 1, 1]), np.array([0, 1, 7, 12, 15])
BODIES, GROUPS, BLOCK, T = 2, 3, equation.BLOCK, 7.0
BEFORE, N = 6 * BODIES, 6 * (BODIES + GROUPS)
PLACE = np.array([[1.0, 2.0, -1.0], [20.0, 1.0, -1.5]])
DECAY, TURN = np.array([0.4, 0.2, 0.3, 0.2, 0.3]), np.array([0.7, 0.9])


def ramp(t, length):
    """The polynomial of degree five from 0 to 1 with no slope and no curvature at its ends"""
    s = min(max(t / length, 0.0), 1.0)
    return 10 * s**3 - 15 * s**4 + 6 * s**5


@pytest.fixture(scope="module")
def random():
    """Numbers of all that is in an equation, by their names"""
    draw = np.random.default_rng(61)
    normal = lambda *shape: draw.normal(size=shape)  # noqa: E731
    stiffness = normal(N, N)
    stiffness[:BEFORE, :BEFORE] = 0.0
    shapes = equation.Shapes(OWNER, SHAPES, stiffness)
    memory = MemoryArrays(DECAY, TURN, normal(N, 5), normal(N, 5))
    ring = np.broadcast_to(normal(BODIES, 1, 6), (BODIES, 75, 6)).copy()
    given = np.broadcast_to(normal(BEFORE, 1), (BEFORE, 40)).copy()
    return equation.Body(
        normal(N, N), normal(BODIES, 6, 6), normal(BODIES, 6, 6), normal(BODIES, 6, 6), normal(BODIES, 6, 6),
        normal(N, N), abs(normal(N)), normal(BODIES), 0.31, 20.0, np.array([2.0, 10.0]), 0.0, memory, ring, given, 0.5,
        shapes, shapes,
    )  # fmt: skip


def scene_of(body, waves):
    """waves : (N + G, ROWS), the same at all times"""
    lines = line_loads.body_lines(None, bodies=BODIES)
    lines = lines._replace(bent=np.zeros((2, 0, len(SHAPES), 3)))
    none, bent = np.zeros((0, 10)), np.zeros((2, 0, len(SHAPES), 3))
    contacts = contact_loads.Contacts(None, none, np.zeros(0, int), np.zeros(0, int), PLACE, bent)
    work = equation.room(40, BODIES, GROUPS)
    work.window[:], work.span[:] = waves[:, :, None], (0.0, 0.5)
    return equation.Scene(
        body, lines, line_loads.line_work(lines), streams.calm(BODIES), streams.calm(BODIES), contacts,
        contact_loads.contact_work(contacts), None, work,
    )  # fmt: skip


@pytest.fixture(scope="module")
def found(random):
    """Body, waves, state and its rates"""
    draw = np.random.default_rng(62)
    waves = draw.normal(size=(BODIES + GROUPS, equation.ROWS))
    y = draw.normal(size=equation.memory_at(BODIES, GROUPS) + len(DECAY))
    rate = np.full(len(y), np.nan)
    assert equation.rates(scene_of(random, waves), None, None, T, y, rate)
    return random, waves, y, rate


def parts(y):
    """η and ν of bodies (2, 6), slow poses and their rates (2, 3), amplitudes and their rates (18,), memory (5,)"""
    own, shapes = equation.blocks(y, BODIES), y[equation.shapes_at(BODIES) :][: 12 * GROUPS].reshape(GROUPS, 2, 6)
    memory = y[equation.memory_at(BODIES, GROUPS) :]
    return own[:, :6], own[:, 6:12], own[:, 12:15], own[:, 15:18], shapes[:, 0].ravel(), shapes[:, 1].ravel(), memory


def by_matrices(body, waves, y):
    """(N,) forces, and what each of them is, by the module's equation"""
    eta, nu, slow, slow_rate, xi, xi_rate, memory = parts(y)
    V = np.concatenate([nu.ravel(), xi_rate])
    grown, share = ramp(T - 2.0, 10.0), ramp(T, 20.0)
    told = {
        "damping": -body.damping @ V - body.quadratic * V * abs(V),
        "memory": -body.memory.output @ memory,
        "waves": grown * waves[:, :6].ravel(),
        "given": np.concatenate([share * body.given[:, 0], np.zeros(6 * GROUPS)]),
    }
    drift, inertial, restoring = np.zeros((3, BODIES + GROUPS, 6))
    for b in range(BODIES):
        c, s = np.cos(slow[b, 2]), np.sin(slow[b, 2])
        along_slow = np.array([[c, s], [-s, c]]) @ slow_rate[b, :2]
        drift[b, [0, 1, 5]] = grown**2 * (waves[b, 6:9] - body.drift_damping[b, 0].reshape(3, 2) @ along_slow)
        c, s = np.cos(eta[b, 5]), np.sin(eta[b, 5])
        turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])  # from space to the axes of the heading
        planar = turn @ slow_rate[b]
        at = np.ix_([0, 1], [0, 1, 5])
        rigid, with_water = body.rigid[b][at] @ planar, (body.rigid + body.slow)[b][at] @ planar
        r = nu[b, 5]
        inertial[b, [0, 1]] = np.cross([*with_water, 0], [0, 0, r])[:2]
        inertial[b, 5] = np.cross([*rigid, 0], [*nu[b, :2], 0])[2]
        away = eta[b] - [0, 0, 0, 0, 0, body.heading[b]]
        spring = -body.spring[b] @ away
        spring[:3] = turn @ spring[:3]
        restoring[b] = spring - body.stiffness[b][:, 2:5] @ eta[b, 2:5]
    told |= {"drift": drift.ravel(), "current": inertial.ravel(), "restoring": restoring.ravel()}
    felt = eta.copy()  # what shapes feel: places along the axes of the heading, yaw from the heading at rest
    for b in range(BODIES):
        c, s = np.cos(eta[b, 5]), np.sin(eta[b, 5])
        felt[b, :2], felt[b, 5] = np.array([[c, s], [-s, c]]) @ eta[b, :2], eta[b, 5] - body.heading[b]
    told["shapes"] = -body.shapes.stiffness @ np.concatenate([felt.ravel(), xi])
    return sum(told.values()), told


def test_velocities_change_by_all_forces_on_all_motions(found):
    body, waves, y, rate = found
    change = body.mass_inverse @ by_matrices(body, waves, y)[0]
    _, acceleration, _, _, velocity, of_shapes, _ = parts(rate)
    assert acceleration.ravel() == pytest.approx(change[:BEFORE], rel=1e-9)
    assert of_shapes == pytest.approx(change[BEFORE:], rel=1e-9)
    assert velocity == pytest.approx(parts(y)[5], rel=1e-12)


def test_places_change_by_velocities_along_the_heading_and_slow_poses_follow_by_their_filter(found):
    body, _, y, rate = found
    eta, nu, slow, slow_rate, *_ = parts(y)
    moved, _, slow_moved, slow_change, *_ = parts(rate)
    for b in range(BODIES):
        c, s = np.cos(eta[b, 5]), np.sin(eta[b, 5])
        assert moved[b] == pytest.approx([*(np.array([[c, -s], [s, c]]) @ nu[b, :2]), *nu[b, 2:]])
        w = body.filter_rate
        assert slow_change[b] == pytest.approx(w**2 * (eta[b, [0, 1, 5]] - slow[b]) - 2 * w * slow_rate[b])
    assert slow_moved == pytest.approx(slow_rate)


def test_states_of_the_memory_decay_turn_and_are_driven_by_all_velocities(found):
    body, _, y, rate = found
    *_, memory = parts(y)
    A = -np.diag(DECAY)
    A[[1, 2], [3, 4]], A[[3, 4], [1, 2]] = TURN, -TURN
    V = np.concatenate([parts(y)[1].ravel(), parts(y)[5]])
    assert parts(rate)[6] == pytest.approx(A @ memory + body.memory.input.T @ V, rel=1e-9)


def test_each_force_does_its_work_and_that_on_shapes_counts_with_their_body(found):
    body, waves, y, rate = found
    _, told = by_matrices(body, waves, y)
    _, nu, _, _, _, xi_rate, _ = parts(y)
    V = np.concatenate([nu, xi_rate.reshape(GROUPS, 6)])
    works = equation.blocks(rate, BODIES)[:, equation.FIRST_WORK :]
    assert works.shape[1] == len(equation.WORKS)
    for i, name in enumerate(equation.WORKS):
        power = np.einsum("ij,ij->i", told.get(name, np.zeros(N)).reshape(-1, 6), V)
        wanted = [power[b] + power[BODIES:][b == OWNER].sum() for b in range(BODIES)]
        assert works[:, i] == pytest.approx(wanted, rel=1e-9, abs=1e-12), name
