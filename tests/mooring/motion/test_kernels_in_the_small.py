"""Kernels of a run in time on made-up numbers: waves over a window, tables of lines, lines whose ends move, ropes."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.motion.tables.harmonics import harmonics

waves, tables = plain("mooring.motion.tables.wave_windows"), plain("mooring.motion.force_tables")
ends, uniform = plain("mooring.lines.catenary.moving_end"), plain("mooring.lines.catenary.uniform")
contacts, streams = plain("mooring.motion.contact_loads"), plain("mooring.motion.streams")
integrator, water = plain("mooring.motion.integrator"), plain("mooring.lines.dynamics.lumped.surroundings")

# ------------------------------------------------------------------ waves over a window

OMEGA, OWN = np.array([0.6, 0.9]), np.array([0.55, 0.95])
NUMBER = np.array([[0.04, 0.03], [0.01, -0.08]])
AMPLITUDE, PHASE = np.array([1.2, 0.7]), np.array([0.4, 2.1])
DIRECTION = np.arctan2(NUMBER[1], NUMBER[0])
RING = np.arange(waves.HEADINGS) * 2 * np.pi / waves.HEADINGS
PARTS = np.random.default_rng(3).normal(size=(2, 2, 3, 15))  # of two bodies and components: mean, cos and sin of χ
CENTER, ARM = np.array([[1.0, 2.0], [30.0, -3.0]]), np.array([[0.5, -0.3], [0.2, 0.6]])
STEPS, STEP = 6, 0.5


def a_table():
    around = np.stack([np.ones_like(RING), np.cos(RING), np.sin(RING)])
    force = np.einsum("bcij,in->bcnj", PARTS, around)
    times = STEP * (np.arange(STEPS + 1 + 2 * waves.EDGE) - waves.EDGE)
    of_nodes = harmonics(OMEGA, STEP, STEPS + 1 + waves.EDGE)
    of_drift = harmonics(OMEGA, 2 * STEP, STEPS // 2 + 1 + waves.FAR)
    drift = np.concatenate([force, force[:, :, :6]], axis=2)[..., [12, 13, 14, 14]]
    force[..., 12:] = 0.0
    return waves.WaveTable(
        OMEGA, OWN, NUMBER, AMPLITUDE, PHASE, DIRECTION, np.pad(force, [(0, 0)] * 3 + [(0, 1)]), drift, np.arange(2),
        np.eye(8)[[0, 0]], DIRECTION, of_nodes, of_drift, CENTER, ARM, STEP, STEP * STEPS,
    ), times  # fmt: skip


def in_waves(body, pose, t):
    """Forces (6,), drift with pairs and without (3,), elevation with a body at a pose, as complex numbers"""
    x, y = CENTER[body] + pose[:2] - rotation(0, 0, pose[2])[:2, :2] @ ARM[body]
    crest = AMPLITUDE * np.exp(1j * (NUMBER[0] * x + NUMBER[1] * y + PHASE - OMEGA * t))
    chi = DIRECTION - pose[2]
    parts = PARTS[body, :, 0] + PARTS[body, :, 1] * np.cos(chi)[:, None] + PARTS[body, :, 2] * np.sin(chi)[:, None]
    force = (crest @ (parts[:, :6] + 1j * parts[:, 6:12])).real
    up, down = np.sqrt(np.maximum(parts[:, 12:], 0)), np.sqrt(np.maximum(-parts[:, 12:], 0))
    x, y = CENTER[body] + pose[:2]  # groups of waves are those that pass the rotation centre
    there = AMPLITUDE * np.exp(1j * (NUMBER[0] * x + NUMBER[1] * y + PHASE - OMEGA * t))
    return force, abs(there @ up) ** 2 - abs(there @ down) ** 2, AMPLITUDE**2 @ parts[:, 12:], crest.sum().real


@pytest.mark.parametrize("mean", [True, False])
def test_forces_over_a_window_go_from_those_of_one_pose_to_those_of_the_next(mean):
    table, times = a_table()
    poses, start = np.array([[0.5, -0.2, 0.3], [1.5, 0.4, 0.5]]), 7.0
    given = waves.waves_of(table, mean)
    for body in range(2):
        window = np.ones((waves.ROWS, len(times)))
        waves.meet(given, 1, poses[0], start, body)  # the begin of window number 3, an odd one
        waves.fill_window(given, window, 3, poses[1], start, body)
        for n, t in enumerate(times):
            shares = 1 - t / (STEP * STEPS), t / (STEP * STEPS)
            both = [in_waves(body, pose, start + t) for pose in poses]
            if (n - waves.EDGE) % 2:  # drift is summed at every second step, and is a quintic through six of these
                near = start + t + STEP * np.array([-5, -3, -1, 1, 3, 5])
                for one, pose in zip(both, poses, strict=True):
                    at = np.array([in_waves(body, pose, moment)[1] for moment in near])
                    one[1][:] = np.array([3, -25, 150, 150, -25, 3]) @ at / 256
            parts = zip(*both, strict=True)
            force, pairs, alone, crest = (a * shares[0] + b * shares[1] for a, b in parts)
            assert window[:6, n] == pytest.approx(force, abs=1e-6)
            assert window[6:9, n] == pytest.approx(alone if mean else pairs, abs=1e-6)
            assert window[9, n] == pytest.approx(crest)


def test_without_waves_a_window_is_still():
    table = plain("mooring.motion.wave_loads").no_waves(3.0, 2)
    window = np.ones((waves.ROWS, 4))
    waves.fill_window(waves.waves_of(table), window, 0, np.zeros(3), 0.0)
    assert np.all(window == 0)
    assert (table.step, table.window, table.steps) == (1.0, 3.0, 1)


# ------------------------------------------------------------------ tables of lines

CUBIC = np.random.default_rng(7).normal(size=(2, 4, 4))  # of H and V, powers of chord and height
CUBIC[0, 0, 0] += 80.0  # H stays above 0


def polynomial(c, z, along=0, upwards=0):
    """(2,) H and V, or derivatives, of a polynomial of third degree in the chord and the height, each over ten"""
    u, v = np.polynomial.Polynomial([0, 0.1])(c), 0.1 * z
    out = []
    for part in CUBIC:
        by_u = np.polynomial.polynomial.polyder(part, along) if along else part
        both = np.polynomial.polynomial.polyder(by_u, upwards, axis=1) if upwards else by_u
        out.append(np.polynomial.polynomial.polyval2d(u, v, both) * 0.1 ** (along + upwards))
    return np.array(out)


def a_packed():
    """Two tables of one polynomial: one cell from (5, 1) to (25, 9); 2 × 2 cells, the last in two, halved along c"""
    cells = [(5.0, 1.0, 20.0, 8.0), (5, 1, 10, 4), (5, 5, 10, 4), (15, 1, 10, 4), (15, 5, 4, 4), (19, 5, 6, 4)]
    values = []
    for c, z, dc, dz in cells:
        corners = [(c, z), (c + dc, z), (c, z + dz), (c + dc, z + dz)]
        values.append(np.moveaxis([[polynomial(*corner, i, j) for i, j in ((0, 0), (1, 0), (0, 1), (1, 1))]
                                   for corner in corners], -1, 0))  # fmt: skip
    reach = np.array([[5.0, 25.0], [1.0, 9.0]])
    below = np.array([-1, -2, -3, -4, 5, -5, -6])
    halved, along = np.array([0, 0, 0, 0, 19.0, 0, 0]), np.zeros(7, int)
    return tables.Packed(np.array([reach, reach]), np.array([[1, 1], [2, 2]]), np.array([0, 1]), halved, along, below,
                         np.array(cells, float), np.array(values))  # fmt: skip


@pytest.mark.parametrize("number", [0, 1])
@pytest.mark.parametrize(("c", "z"), [(5.0, 1.0), (8.0, 2.0), (9.5, 7.7), (16.0, 3.0), (17.0, 8.0), (24.0, 6.0)])
def test_a_table_of_a_polynomial_of_third_degree_is_that_polynomial(number, c, z):
    found = tables.packed_pull(a_packed(), number, np.sqrt(c * c - z * z), z)
    assert found == pytest.approx(polynomial(c, z))


def test_beside_a_table_lines_pull_as_at_its_least_chord_straight_beyond_its_greatest_and_not_above_or_below():
    table = a_packed()
    for number in (0, 1):
        assert tables.packed_pull(table, number, 0.1, 2.0) == pytest.approx(polynomial(5.0, 2.0))
        c, z = 27.0, 6.0
        straight = polynomial(25.0, z) + 2.0 * polynomial(25.0, z, 1)
        found = tables.packed_pull(table, number, np.sqrt(c * c - z * z), z)
        assert found == pytest.approx((max(straight[0], 0.0), straight[1]))
        for z in (0.9, 9.1, np.nan):
            assert np.isnan(tables.packed_pull(table, number, 12.0, z)).all()


# ------------------------------------------------------------------ lines whose ends move

LINE = (100.0, 10.0, 1e-6, 0.3)  # m, N/m, 1/N, friction


def test_a_line_that_is_followed_pulls_as_one_that_is_solved_anew():
    """From slack over the bed to free, up and down in height, back at once, and beyond what it can reach"""
    kept = ends.workspace(1)[0][0]
    way = [(60, 20), (88, 20), (90, 20.5), (92, 19), (95, 22), (97.2, 20), (97.9, 20), (97, 21), (94, 20), (70, 22),
           (92, 20), (97.95, 20)]  # fmt: skip
    states = set()
    for x, height in way:
        found = ends.pull(kept, float(x), float(height), *LINE)
        row = np.zeros(uniform.COLUMNS)
        uniform.solve_uniform(row, (float(x), float(height), LINE[0], LINE[1], LINE[2], LINE[3], 0.0), True)
        assert found == pytest.approx(row[:2], rel=1e-6)
        states.add(int(kept[0]))
    assert states == {State.SUSPENDED, State.GROUNDED, State.SLACK}
    assert np.isnan(ends.pull(kept, 50.0, -0.1, *LINE)).all()
    assert np.isnan(ends.pull_of_any(kept, np.zeros(30), 120.0, -20.0, 0.0, -20.0, 100.0, 10.0, 0.0, 0.3)).all()


def test_a_line_held_above_the_bed_pulls_as_a_catenary_between_its_ends_and_one_that_floats_as_its_mirror():
    kept, rows = ends.workspace(1)
    heavy = ends.pull_of_any(kept[0], rows[0], 80.0, -30.0, 0.0, -100.0, *LINE)
    row = np.zeros(uniform.COLUMNS)
    uniform.solve_uniform(row, (80.0, 30.0, LINE[0], LINE[1], LINE[2], 0.0, 0.0), False)
    assert heavy == pytest.approx(row[:2], rel=1e-8)
    kept, rows = ends.workspace(1)
    light = ends.pull_of_any(kept[0], rows[0], 80.0, -60.0, -30.0, -100.0, LINE[0], -LINE[1], LINE[2], 0.0)
    # turned over, its held end hangs 30 m above the other
    uniform.solve_uniform(row, (80.0, -30.0, LINE[0], LINE[1], LINE[2], 0.0, 0.0), False)
    assert light == pytest.approx((row[0], -row[1]), rel=1e-8)


# ------------------------------------------------------------------ ropes, streams, steps


def test_a_rope_pulls_its_body_towards_its_other_end_by_its_stretch():
    """From the origin of the body's axes 10 m ahead and 4 m up to a; the body's point is at (0, 1, 0) of it, turned"""
    R, numbers = rotation(0.1, -0.2, 0.3), np.zeros((1, 10))
    numbers[0, 3:6], numbers[0, 6] = (0.0, 1.0, 0.0), 8.0
    v, f = np.array([10.0, 0.0, 4.0]), np.zeros(3)
    given = SimpleNamespace(numbers=numbers, table=None)
    old, contacts.pressed = contacts.pressed, lambda c, work, i, depth: 5.0 * depth
    try:
        contacts.rope_force(given, SimpleNamespace(shift=np.zeros(3)), 0, R, v, f)
    finally:
        contacts.pressed = old
    way = np.array([10.0, 0.0, 4.0]) - R[:, 1]
    long = np.linalg.norm(way)
    assert f == pytest.approx(5.0 * (long - 8.0) * way / long)
    assert v == pytest.approx(R[:, 1])


@pytest.mark.parametrize("gusts", [False, True])
def test_a_stream_pushes_by_the_square_of_what_passes_the_body(gusts):
    """12 m/s towards 36.87°, half grown, gusts rising by 1 m/s in 5 s; body at 0.2 rad with 1 and −0.5 m/s"""
    around = np.arange(36) * np.pi / 18
    unit = np.stack(
        [np.cos(around), 2 * np.sin(around), 0 * around, 0.1 * np.sin(around), around * 0, np.cos(around)], 1
    )
    record = (1.0 + 0.2 * streams.GUST_STEP * np.arange(30))[None] if gusts else np.zeros((1, 1))
    stream = streams.Stream(streams.ring_table(unit)[None], 12.0 * np.array([0.8, 0.6]), record, 2.0, np.ones(1))
    out = np.zeros(6)
    streams.stream_force(stream, 0, 4.0, 0.5, np.array([0.2, 1.0, -0.5]), np.zeros(6), out, np.zeros(1))
    speed = 0.5 * (12.0 + (1.0 + 0.2 * 2.0 if gusts else 0.0))
    turn = np.arctan2(0.6, 0.8) - 0.2
    along, across = speed * np.cos(turn) - 1.0, speed * np.sin(turn) + 0.5
    square, chi = along**2 + across**2, np.arctan2(across, along)
    wanted = [np.cos(chi), 2 * np.sin(chi), 0.0, 0.1 * np.sin(chi), 0.0, np.cos(chi)]
    assert out == pytest.approx(square * np.array(wanted), rel=1e-4)  # a cubic, 10° apart


@pytest.mark.parametrize("ratio, share", [(0.0, 0.25), (0.2, 0.625), (0.399, 1.0), (0.41, 1.0)])
def test_a_body_that_outruns_a_slow_current_has_less_of_its_drag(ratio, share):
    """0.25 + 0.75 x² (3 − 2x) of unit drag along itself, x the current over 0.4 of the body's 2 m/s"""
    around = np.arange(720) * np.pi / 360
    unit = np.stack([np.cos(around), np.sin(around), *np.zeros((4, 720))], 1)
    table, velocity = streams.ring_table(unit)[None], ratio * 2.0 * np.array([0.0, 1.0])
    for still, wanted in ((0.25, share), (1.0, 1.0)):
        stream = streams.Stream(table, velocity, np.zeros((1, 1)), 0.0, np.array([still]))
        out, moving = np.zeros(6), np.array([0.0, 2.0 * 0.8, 2.0 * 0.6])
        streams.stream_force(stream, 0, 0.0, 1.0, moving, np.zeros(6), out, np.zeros(1))
        past = np.array([-1.6, 2.0 * ratio - 1.2])
        assert out[:2] == pytest.approx(wanted * np.hypot(*past) * past, rel=1e-4)


def test_what_lines_miss_by_a_body_that_goes_elsewhere_is_held_against_what_is_allowed():
    """Two bodies, the second turned by 0.5 rad; a line on each and one that is lost"""
    rng, h, block = np.random.default_rng(4), 0.4, integrator.BLOCK
    heading, number = np.array([0.0, 0.5]), np.array([0, 2, 1])
    square = rng.normal(size=(12, 12))
    inverse, stretch, spring = square @ square.T, rng.normal(size=(3, 6)), np.array([3.0, 5.0, 1e9])
    given = np.zeros((3, 1, 3))
    given[:, 0] = [(3.0, 4.0, 12.0), (1.0, 0.0, 0.0), (0.0, 0.0, 9.0)]
    trial, foreseen = rng.normal(size=2 * block), rng.normal(size=(2, 12))
    scale = np.abs(rng.normal(size=(2, 12))) + 0.1
    owner = np.array([0, 0, 1])  # of the lines of the scene: number 0, 1 and 2
    scene = SimpleNamespace(
        body=SimpleNamespace(mass_inverse=inverse, heading=heading, shapes=SimpleNamespace(place=np.zeros(0, int))),
        lines=SimpleNamespace(body=owner),
        line_work=SimpleNamespace(whole=np.array([True, False, True]), given=given),
    )  # fmt: skip
    lines = SimpleNamespace(number=number, spring=spring, stretch=stretch, tension=np.array([1.0, 20.0, 1.0]),
                            tolerance=1e-3)  # fmt: skip
    kept = SimpleNamespace(push=np.zeros(12), foreseen=foreseen, room=SimpleNamespace(push=np.zeros(6)))
    clock = SimpleNamespace(trial=trial, scale=scale)
    found = integrator.missed_course(scene, clock, (lines, kept), h)
    worst = []
    for first, share in ((0, h / 12), (6, h / 6)):
        push = np.zeros(12)
        for i, n in ((0, 0), (1, 2)):
            b = owner[n]
            off = trial[block * b + first :][:6] - foreseen[b, first : first + 6]
            if first == 0:
                off[:2] = rotation(0, 0, heading[b])[:2, :2].T @ off[:2]
            pull = spring[i] * stretch[i] @ off
            push[6 * b : 6 * b + 6] += pull * stretch[i]
            if first == 0:
                worst.append(abs(pull) / (1e-3 * max(lines.tension[i], np.linalg.norm(given[n, 0]))))
        worst.append((share * np.abs(inverse @ push).reshape(2, 6) / scale[:, first : first + 6]).max())
    assert found == pytest.approx(max(worst))
    lines = SimpleNamespace(**{**vars(lines), "tolerance": 1e9})  # the course alone
    assert integrator.missed_course(scene, clock, (lines, kept), h) == pytest.approx(max(worst[2], worst[3]))


# ------------------------------------------------------------------ water about a line


def test_water_is_the_sum_of_waves_that_begin_slowly_and_a_current_over_the_depth():
    """A = 1.2 and 0.7 m, ramps of 10 s and 4 s; u, w of linear waves at depth; du by differences as the water goes"""
    k, depth, t = np.array([0.05, 0.09]), 40.0, 6.0
    heading = np.array([0.3, -0.8])
    q = np.zeros((3, 16))
    q[:, :3] = np.array([[1.0, 5.0, -9.0], [2.0, -3.0, 4.0], [-12.0, -1.0, 0.5]])  # the last above the surface
    level, current = np.array([-40.0, -10.0, 0.0]), np.array([[0.1, 0.0], [0.5, -0.2], [1.0, 0.3]])
    given = SimpleNamespace(
        omega=OWN, wavenumber=k, heading=np.column_stack([np.cos(heading), np.sin(heading)]), met=OMEGA, phase=PHASE,
        amplitude=AMPLITUDE, depth=depth, level=level, current=current, begin=1.0, ramp=10.0, current_ramp=4.0,
        table=np.zeros(0),
    )  # fmt: skip

    def velocity(t, since):
        """At t of what is met until `since` and then followed with the current, which carries it past the place"""
        x = (t - 1.0) / 10.0
        R = x**3 * (10 - 15 * x + 6 * x * x)
        U = min(t / 4.0, 1.0) ** 3 * (10 - 15 * min(t / 4.0, 1.0) + 6 * min(t / 4.0, 1.0) ** 2)
        out = np.zeros((3, 3))
        for j, (x, y, z) in enumerate(q[:, :3].T):
            z = min(z, 0.0)
            for i in range(2):
                theta = (
                    OMEGA[i] * since
                    + OWN[i] * (t - since)
                    - k[i] * (np.cos(heading[i]) * x + np.sin(heading[i]) * y)
                    - PHASE[i]
                )
                size = R * AMPLITUDE[i] * OWN[i] / np.sinh(k[i] * depth)
                along = size * np.cosh(k[i] * (z + depth)) * np.cos(theta)
                out[:, j] += (np.cos(heading[i]) * along, np.sin(heading[i]) * along,
                              -size * np.sinh(k[i] * (z + depth)) * np.sin(theta))  # fmt: skip
            out[:2, j] += U * np.array([np.interp(z, level, current[:, i]) for i in range(2)])
        return out

    u, du = np.ones((3, 16)), np.ones((3, 16))
    for at in (t, 2.5):
        water.water_at(given, q, 3, at, u, du)
        assert u[:, :3] == pytest.approx(velocity(at, at), abs=1e-12)
        assert du[:, :3] == pytest.approx((velocity(at + 1e-5, at) - velocity(at - 1e-5, at)) / 2e-5, abs=1e-8)


def test_water_of_a_table_goes_on_from_its_places_by_its_slopes_and_is_carried_past_them():
    """Eight nodes; velocities and slopes of third degree in time, of samples 0.5 s apart from 3 s on"""
    rng, n, t, R, R1 = np.random.default_rng(6), 8, 4.3, 0.7, 0.2
    in_time, place = rng.normal(size=(4, water.OF_PLACE, n)), rng.normal(size=(3, n))
    place[2] -= 3.0
    at = 0.5 * np.arange(water.SAMPLES)
    table = np.einsum("is,ikn->skn", at ** np.arange(4)[:, None], in_time)
    w = 16
    q = np.zeros((3, w))
    q[:, :n] = place + 0.3 * rng.normal(size=(3, n))
    q[2, 0] = 0.4  # above the surface
    current = np.array([0.6, -0.4])
    given = SimpleNamespace(clock=np.array([3.0, 0.5]), weights=np.zeros((2, water.SAMPLES)), table=table, place=place,
                            carried=current)  # fmt: skip

    def values(s, d, slope=False):
        now = np.einsum("i,ikn->kn", [0, 1, 2 * s, 3 * s * s] if slope else s ** np.arange(4), in_time)
        u, (xx, xy, yy, xz, yz), (x, y, z) = now[:3], now[3:], d
        return u + np.array([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y - (xx + yy) * z])

    before, changing = np.arange(3.0 * w).reshape(3, w), -np.arange(3.0 * w).reshape(3, w)
    u, du = before.copy(), changing.copy()
    water.tabled_water(given, q, n, t, R, R1, u, du)
    d = q[:, :n] - place
    d[2] = np.minimum(q[2, :n], 0.0) - place[2]
    flow, there = values(t - 3.0, d), values(t - 3.0, d + np.array([*current, 0.0])[:, None])
    assert u[:, :n] == pytest.approx(before[:, :n] + R * flow)
    assert du[:, :n] == pytest.approx(changing[:, :n] + R * values(t - 3.0, d, True) + R1 * flow + R * (there - flow))


# ------------------------------------------------------------------ the sea around moving lines

sea = plain("mooring.motion.moving_lines.sea")


def test_sine_cosine_and_what_dies_with_depth_are_near_enough():
    for turn in np.linspace(-20.0, 20.0, 41):
        assert sea.sine_and_cosine(turn) == pytest.approx((np.sin(turn), np.cos(turn)), abs=2e-7)
    for x in np.linspace(-12.0, 0.0, 25):
        assert sea.falling(x) == pytest.approx(np.exp(x), rel=1e-6)


def test_a_table_of_the_sea_has_velocities_and_slopes_of_linear_waves_where_nodes_will_be():
    """Two waves at 25 m carried by (0.4, 0.1) m/s; two lines of two nodes and one, of which one is above the surface"""
    k, depth, start = np.hypot(*NUMBER), 25.0, 3.0
    carried = np.array([0.4, 0.1])
    given = sea.line_sea((OWN, AMPLITUDE, PHASE, DIRECTION), NUMBER, depth, None, (0.0, 1.0), 1.0, carried)
    water, *room = sea.water_of(given, 3, 2)
    position = np.array([[1.0, 2.0, -3.0], [4.0, 1.0, 0.2], [-2.0, 5.0, -10.0]])
    velocity = np.array([[0.1, 0.2, -0.1], [0.0, 0.0, 0.5], [300.0, 0.0, -400.0]])
    sea.open_sea(given, water, np.array([0, 2, 3]), position, velocity, room, start)
    later = 0.5 * (sea.SAMPLES - 1) * given.step
    places = position + later * velocity
    places[2] = position[2] + np.array([0.6, 0.0, -0.8]) / k.max()  # no farther than 1/k
    places[:, 2] = np.minimum(places[:, 2], 0.0)
    met = OWN + carried @ NUMBER
    assert given.step == pytest.approx(0.3 / met.max())
    assert sea.sea_ahead(given) == pytest.approx(2 * later)
    assert water.clock[0] == start

    def flow(at, t):
        theta = met * t - NUMBER.T @ at[:2] - PHASE
        size = AMPLITUDE * OWN / np.sinh(k * depth)
        along = size * np.cosh(k * (at[2] + depth)) * np.cos(theta)
        return np.array([*(NUMBER / k @ along), -(size * np.sinh(k * (at[2] + depth))) @ np.sin(theta)])

    h, table = 1e-4, water.table
    for node, (first, n, j) in enumerate(((0, 2, 0), (0, 2, 1), (2, 1, 0))):
        own = table[sea.SAMPLES * sea.OF_PLACE * first :][: sea.SAMPLES * sea.OF_PLACE * n]
        own = own.reshape(sea.SAMPLES, sea.OF_PLACE, n)[:, :, j]
        assert water.place[3 * first :][: 3 * n].reshape(3, n)[:, j] == pytest.approx(places[node])
        for i, t in enumerate(start + given.step * np.arange(sea.SAMPLES)):
            slopes = np.array(
                [(flow(places[node] + h * e, t) - flow(places[node] - h * e, t)) / (2 * h) for e in np.eye(3)]
            )
            wanted = [*flow(places[node], t), slopes[0, 0], slopes[0, 1], slopes[1, 1], slopes[0, 2], slopes[1, 2]]
            assert own[i] == pytest.approx(np.array(wanted), abs=3e-6)


# ------------------------------------------------------------------ the water around a buoy

buoys = plain("mooring.motion.buoy")


def test_water_at_a_buoy_goes_from_that_of_the_begin_of_a_window_to_that_of_its_end():
    """The buoy at (1, −2) m off its place; sums of the end become those of the next begin"""
    table, times = a_table()
    m, start = len(times), 7.0
    buoy = SimpleNamespace(depth=30.0, draft=2.0, origin=np.array([4.0, 5.0, 0.0]),
                           lines=SimpleNamespace(place=np.array([[50.0, 10.0, 0.0]])))  # fmt: skip
    waves, _, steps = table.of_nodes.shape
    work = SimpleNamespace(window=np.ones((buoys.WATER, m)), factor=table.of_nodes, place=np.zeros(2),
                           rows=np.zeros((waves, 2, buoys.WATER)),
                           sums=np.zeros((2, buoys.WATER, 2, steps)))  # fmt: skip
    at = np.array([50.0 + 1.0 - 4.0, 10.0 - 2.0 - 5.0]) + table.center[0]
    for number in (0, 1):
        begin = start + number * table.window
        buoys.open_water(table, buoy, work, np.array([1.0, -2.0, 0.0]), number, begin)
        assert work.place == pytest.approx(at)
        for n, t in enumerate(times):
            crest = AMPLITUDE * np.exp(1j * (at @ NUMBER + PHASE - OMEGA * (begin + t)))
            assert work.window[0, n] == pytest.approx(crest.sum().real)  # at one place both ends say the same
            k = np.hypot(*NUMBER)
            over = np.cosh(k * (30.0 - 1.0)) / np.sinh(k * 30.0)
            for j in range(2):
                assert work.window[1 + j, n] == pytest.approx((crest.real * OWN * over * NUMBER[j] / k).sum())
    still = SimpleNamespace(window=np.full((buoys.WATER, 1), 9.0))
    buoys.open_water(table, buoy, still, np.zeros(3), 0, 0.0)
    assert np.all(still.window == 9.0)


@pytest.mark.parametrize("waves", [True, False])
def test_a_buoy_is_in_the_water_of_its_window_and_goes_where_all_forces_push_it(waves, monkeypatch):
    """Water of a cubic in time, none without a window; ẋ = v, v̇ = F/m of lines, hawsers, weight and water together"""
    made, rng, at, WATER = {}, np.random.default_rng(4), 6.3, 7
    cubic = rng.normal(size=(WATER, 4))
    course = np.stack([row @ np.arange(14.0) ** np.arange(4)[:, None] for row in cubic])
    window = course if waves else np.zeros((WATER, 1))
    buoy = SimpleNamespace(inverse=np.array([0.5, 0.25, 0.2]), lines="lines")
    work = SimpleNamespace(window=window, weights=np.zeros(6), water=np.zeros(WATER), pose=np.zeros(6),
                           R=np.zeros((3, 3)), force=np.full(6, 99.0), lines="line work")  # fmt: skip
    place, rate = np.array([1.0, 2.0, 3.0, 0.4, 0.5, 0.6]), np.zeros(6)

    def line_loads(lines, of_lines, pose, R, force):
        made.update(lines=(lines, of_lines, pose[0, :3].tolist()))
        force[0, :3] = 1.0, 2.0, 3.0
        return False

    def hawsers(buoy, work, y, place, R):
        work.force[:] -= 10.0

    def floats(buoy, work, place, share, waves):
        made.update(floats=(share, waves), water=work.water.copy())
        work.force[:] += 100.0

    monkeypatch.setattr(buoys, "line_loads", line_loads)
    monkeypatch.setattr(buoys, "hawsers", hawsers)
    monkeypatch.setattr(buoys, "floats", floats)
    assert buoys.buoy_rates(buoy, work, "y", place, "R", at, 0.7, 0.8, rate) is False
    assert made["lines"] == ("lines", "line work", [1.0, 2.0, 3.0]) and made["floats"] == (0.7, 0.8)
    assert made["water"] == pytest.approx(cubic @ at ** np.arange(4) if waves else np.zeros(WATER))
    assert rate.tolist() == pytest.approx([0.4, 0.5, 0.6, 0.5 * 91.0, 0.25 * 92.0, 0.2 * 93.0])


def test_lines_hold_until_the_time_at_which_each_breaks():
    loads = plain("mooring.motion.line_loads")
    work = SimpleNamespace(whole=np.array([False] * 4))
    loads.hold(SimpleNamespace(lost=np.array([3.0, 5.0, np.inf, 4.0])), work, 4.0)
    assert work.whole.tolist() == [False, True, True, False]


def test_drift_on_a_current_is_that_of_still_water_and_what_its_parts_along_and_across_the_waves_add(monkeypatch):
    """V of 1.3 m/s towards 0.7 rad; waves towards 0.2 and −1.0 in space, met at each of the headings"""
    waves = plain("mooring.motion.wave_loads")
    rng = np.random.default_rng(5)
    ring = 2 * np.pi * np.arange(waves.HEADINGS) / waves.HEADINGS
    D, B = rng.normal(size=(2, waves.HEADINGS, 3)), rng.normal(size=(2, waves.HEADINGS, 3, 2))
    monkeypatch.setattr(waves, "drift_damping", lambda forces, omega, depth, gravity: (D, B))
    V, direction = 1.3 * np.array([np.cos(0.7), np.sin(0.7)]), np.array([0.2, -1.0])
    found = waves.drift_on_current(None, None, direction, V, 30.0, 9.8)
    for q in range(2):
        for p in (0, 5, waves.HEADINGS - 1):
            heading = direction[q] - ring[p]  # of the body
            x = V @ [np.cos(heading), np.sin(heading)]
            y = V @ [-np.sin(heading), np.cos(heading)]
            assert found[q, p] == pytest.approx(D[q, p] + B[q, p, :, 0] * x + B[q, p, :, 1] * y)


def test_tensions_along_a_run_are_those_of_each_time_of_lines_that_hold_and_of_bodies_as_they_are_bent(monkeypatch):
    """Four bodies, two lines, of which the second breaks at 4 s; a stand-in pulls by places and amplitudes"""
    loads = plain("mooring.motion.line_loads")
    work = SimpleNamespace(whole=np.zeros(2, bool), tension=np.zeros((2, 2)), bent=np.zeros(3))
    lines = SimpleNamespace(place=np.zeros((4, 3)), lost=np.array([np.inf, 4.0]))

    def pull(lines, work, positions, R, force):
        assert R.shape == (4, 3, 3) and force.shape == (4, 6)
        work.tension[:] = np.where(work.whole, positions[0, 0] + work.bent.sum(), 0.0)[:, None] * [3.0, 4.0]

    monkeypatch.setattr(loads, "line_loads", pull)
    times, positions, out = np.array([3.0, 5.0]), np.zeros((2, 4, 6)), np.zeros((2, 2))
    positions[:, 0, 0] = 2.0, 7.0
    loads.tensions_along(lines, work, times, positions, out)
    assert out.tolist() == [[10.0, 10.0], [35.0, 0.0]]
    loads.tensions_along(lines, work, times, positions, out, np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]]))
    assert out.tolist() == [[15.0, 15.0], [45.0, 0.0]]


def test_water_around_lines_has_room_for_all_their_nodes_and_sums_of_the_longest():
    made = SimpleNamespace(waves=np.zeros((9, 6)), step=0.25, ramp=(10.0, 20.0), carried=np.array([1.0, 2.0]),
                           current=np.array([0.5, 0.0]), current_ramp=7.0)  # fmt: skip
    around, rows, velocity, sums = sea.water_of(made, 11, 5)
    each = sea.SAMPLES * sea.OF_PLACE
    assert around.table.size >= each * 11 and around.place.size >= 3 * 11 and around.clock.tolist() == [-np.inf, 0.25]
    assert (around.begin, around.ramp, around.current_ramp) == (10.0, 20.0, 7.0) and around.carried is made.carried
    assert around.current.tolist() == [[0.5, 0.0]] and around.level.tolist() == [0.0]
    assert (
        around.weights.shape == (2, sea.SAMPLES) and rows.shape == (sea.OF_PLACE * 5, 12) and velocity.shape == (4, 6)
    )
    assert sums.shape == (each * 5,)
    part = sea.line_water(around._replace(table=np.arange(around.table.size), place=np.arange(around.place.size)), 4, 7)
    assert part.table.tolist() == list(range(each * 4, each * 7)) and part.place.tolist() == list(range(12, 21))
    still = SimpleNamespace(**vars(made) | dict(waves=np.zeros((9, 0)), current=np.zeros(2)))
    none = sea.water_of(still, 11, 5)[0]
    assert none.table.size == 0 and sea.line_water(none, 4, 7) is none
