"""Forces of waves on bodies of a run, of cubics over frequency and sines over heading, which tables hold exactly."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_body import made_up_body

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.modes import Body
from hakobune.mooring.environment.sea import Components
from hakobune.mooring.motion import wave_loads
from hakobune.mooring.motion.tables.interpolation import EDGE
from hakobune.mooring.motion.tables.wave_windows import HEADINGS, ROWS, fill_window, meet, waves_of

OMEGA = np.linspace(0.2, 2.0, 130)  # two parts of 64 and some
RING = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
G = 10.0


def same(found, wanted, rtol=1e-9, atol=1e-9):
    """Whether large arrays are alike; `pytest.approx` takes seconds for them"""
    return np.allclose(found, wanted, rtol=rtol, atol=atol)


def force_at(omega, heading, columns=6):
    """(1 + i ω) (j + 1) cos β + ω² sin β of column j"""
    w, b, j = np.ix_(omega, heading, np.arange(columns))
    return (1 + 1j * w) * (j + 1) * np.cos(b) + w**2 * np.sin(b)


def drift_at(omega, heading, columns=3):
    w, b, j = np.ix_(omega, heading, np.arange(columns))
    return (j + 1) * w**2 * np.cos(b) - w * np.sin(b)


def lone(knows=True, **more):
    return SimpleNamespace(bodies=(), modes=(), rigid=6, knows_drift=knows, forces=force_at, drift=drift_at,
                           omega=OMEGA, axes_at_rest=np.zeros((1, 6)), **more)  # fmt: skip


@pytest.fixture
def frequencies(monkeypatch):
    monkeypatch.setattr(wave_loads, "frequencies", lambda body: OMEGA)


@pytest.mark.parametrize("knows", [True, False])
def test_a_body_has_its_forces_and_drift_on_a_ring_of_headings(knows, frequencies):
    found = wave_loads.wave_forces(lone(knows))
    wanted = force_at(OMEGA, RING)
    assert same(found.force[..., :6], wanted.real) and same(found.force[..., 6:], wanted.imag)
    assert (found.drift is not None) == knows and found.others == () and found.each == (found,)
    if knows:
        assert same(found.drift, drift_at(OMEGA, RING))


@pytest.mark.parametrize("stored", [True, False])
def test_each_of_several_bodies_has_its_own_columns_at_headings_from_its_own(stored, frequencies):
    """Two that move, the second headed to 0.3 rad, and one fixed between them: its drift is the third of the rows"""
    bodies = (Body("a"), Body("quay", fixed=True), Body("b", heading=0.3))
    columns = {"a": slice(0, 6), "b": slice(6, 12)}

    def drift_of_each(omega, heading):
        return np.stack([drift_at(omega, heading) * size for size in (1.0, 5.0, 7.0)], axis=2)

    body = SimpleNamespace(bodies=bodies, modes=(), rigid=12, forces=lambda w, b: force_at(w, b, 12), omega=OMEGA,
                           columns_of=lambda one: columns[one.name], knows_drift_of_each=stored,
                           drift_of_each=drift_of_each, axes_at_rest=np.zeros((2, 6)))  # fmt: skip
    first, second = wave_loads.wave_forces(body).each
    here, there = force_at(OMEGA, RING, 12)[..., :6], force_at(OMEGA, RING + 0.3, 12)[..., 6:]
    assert same(first.force, np.concatenate([here.real, here.imag], axis=-1))
    assert same(second.force, np.concatenate([there.real, there.imag], axis=-1))
    if stored:
        assert same(first.drift, drift_at(OMEGA, RING))
        assert same(second.drift, 7 * drift_at(OMEGA, RING + 0.3))
    else:
        assert first.drift is None and second.drift is None
    none = wave_loads.no_wave_forces(body).each
    assert len(none) == 2 and not none[0].force.any() and none[1].force.shape == (130, HEADINGS, 12)


def test_shapes_of_a_body_follow_it_in_groups_of_six(frequencies):
    """Seven shapes of a body headed to 0.3 rad: six and one, no drift"""
    modes = tuple(SimpleNamespace(moves=(0,)) for _ in range(7))
    body = lone()
    body.modes, body.forces, body.axes_at_rest = (
        modes,
        lambda w, b: force_at(w, b, 13),
        np.array([[0, 0, 0, 0, 0, 0.3]]),
    )
    first, six, one = wave_loads.wave_forces(body).each
    wanted = force_at(OMEGA, RING + 0.3, 13)
    assert same(six.force[..., :6], wanted[..., 6:12].real)
    assert same(six.force[..., 6:], wanted[..., 6:12].imag)
    assert same(one.force[..., 0], wanted[..., 12].real) and six.drift is None
    assert same(one.force[..., 6], wanted[..., 12].imag)
    assert not one.force[..., [1, 2, 3, 4, 5, 7, 8, 9, 10, 11]].any()
    assert same(first.force[..., :6], force_at(OMEGA, RING).real)


@pytest.fixture
def forces(frequencies):
    return wave_loads.wave_forces(lone())


@pytest.mark.parametrize("direction", [0.0, 0.03, 2.5, -3.1, 7.0])
def test_between_headings_and_frequencies_forces_and_drift_are_interpolated(direction, forces):
    found = wave_loads.forces_towards(forces, direction)
    assert same(found, force_at(OMEGA, np.array([direction]))[:, 0], rtol=1e-6, atol=1e-6)
    waves = Components(np.array([0.1, 0.733, 3.0]), np.ones(3), np.zeros(3), np.full(3, direction))
    drift = wave_loads.drift_of(forces, waves, 0.4)
    wanted = drift_at(np.array([0.2, 0.733, 2.0]), np.array([direction - 0.4]))[:, 0]  # held at the ends of the band
    assert same(drift, wanted, rtol=1e-6, atol=1e-6)


def test_wave_drift_damping_in_deep_water_is_aranha_s(forces):
    """B = (ω²/g D′_ω + 4ω/g D) (cos β, sin β) + 2ω/g D′_β (−sin β, cos β), D over a ring of differences"""
    omega = np.array([0.733, 1.1])
    D, B = wave_loads.drift_damping(forces, omega, np.inf, G)
    w, b, j = np.ix_(omega, RING, np.arange(3))
    wanted = drift_at(omega, RING)
    slope, turn = 2 * (j + 1) * w * np.cos(b) - np.sin(b), -(j + 1) * w**2 * np.sin(b) - w * np.cos(b)
    turn = turn * math.sin(2 * math.pi / HEADINGS) / (2 * math.pi / HEADINGS)
    along, across = w**2 / G * slope + 4 * w / G * wanted, 2 * w / G * turn
    assert pytest.approx(wanted, rel=1e-7, abs=1e-7) == D
    assert same(B[..., 0], along * np.cos(b) - across * np.sin(b), rtol=1e-5, atol=1e-6)
    assert same(B[..., 1], along * np.sin(b) + across * np.cos(b), rtol=1e-5, atol=1e-6)


def test_drift_on_a_current_is_that_in_still_water_and_damping_times_its_velocity(forces):
    """A current of 2 m/s at 0.5 rad from waves towards 0.2 rad: it keeps that angle to them at every heading"""
    omega, direction = np.array([0.733, 1.1]), np.array([0.2, 0.2])
    velocity = 2.0 * np.array([math.cos(0.7), math.sin(0.7)])
    found = wave_loads.drift_on_current(forces, omega, direction, velocity, np.inf, G)
    D, B = wave_loads.drift_damping(forces, omega, np.inf, G)
    way = RING + 0.5
    wanted = D + 2.0 * (B[..., 0] * np.cos(way)[None, :, None] + B[..., 1] * np.sin(way)[None, :, None])
    assert same(found, wanted, rtol=1e-9, atol=1e-9)


WAVES = Components(np.array([0.1, 0.733, 3.0]), np.array([1.0, 2.0, 0.5]), np.array([0.1, 0.2, 0.3]),
                   np.array([0.0, 1.0, 2.0]))  # fmt: skip


@pytest.mark.parametrize("drift", [True, False])
@pytest.mark.parametrize("current", [None, (0.6, -0.8)])
def test_components_beyond_what_is_stored_exert_no_force_but_the_nearest_drift(drift, current, forces):
    carrier = None if current is None else SimpleNamespace(velocity=current)
    table = wave_loads.wave_table(forces, WAVES, np.inf, (3.0, 4.0, 5.0), G, drift, carrier, (0.5,))
    held = np.array([0.2, 0.733, 2.0])
    wanted = force_at(held[1:2], RING)[0]
    assert not table.force[0, [0, 2], :, :12].any()
    assert same(table.force[0, 1, :, :6], wanted.real, rtol=1e-6, atol=1e-6)
    assert same(table.force[0, 1, :, 6:12], wanted.imag, rtol=1e-6, atol=1e-6)
    if not drift:
        assert not table.drift.any()
    elif current is None:
        assert same(table.drift[0, :, :HEADINGS, :3], drift_at(held, RING), rtol=1e-6, atol=1e-6)
        assert np.array_equal(table.drift[:, :, HEADINGS:], table.drift[:, :, :6])
    else:
        there = wave_loads.drift_on_current(forces, held, WAVES.direction, current, np.inf, G)
        assert same(table.drift[0, :, :HEADINGS, :3], there)
    k = WAVES.omega**2 / G
    assert table.number == pytest.approx(k * np.array([np.cos(WAVES.direction), np.sin(WAVES.direction)]))
    doppler = 0.0 if current is None else np.array(current) @ table.number
    assert table.omega == pytest.approx(WAVES.omega + doppler) and table.own == pytest.approx(WAVES.omega)
    c, s = math.cos(0.5), math.sin(0.5)
    assert table.center == pytest.approx(np.array([[3.0, 4.0]]))
    assert table.arm == pytest.approx(np.array([[3 * c + 4 * s, 4 * c - 3 * s]]))
    assert table.step <= 0.3 / np.abs(table.omega).max() and table.steps == round(table.window / table.step) + 7


def test_shares_on_nodes_are_those_of_a_polynomial_of_fifth_degree():
    nodes, omega = np.linspace(0.2, 2.0, 19), np.array([0.2, 0.21, 0.733, 1.01, 1.99, 2.0])
    near, share = wave_loads.on_nodes(omega, nodes)
    at = nodes[near[:, None] + np.arange(6)]
    for power in range(6):
        assert (share * at**power).sum(axis=1) == pytest.approx(omega**power, rel=1e-12)
    assert near.tolist() == [0, 0, 3, 6, 13, 13]


def sea(directions):
    """300 waves of 0.3 to 1.9 rad/s in bands of one width, like those of a sea"""
    rng = np.random.default_rng(5)
    omega = 0.3 + 1.6 * (np.arange(300) + rng.uniform(size=300)) / 300
    return Components(
        omega,
        rng.uniform(0.1, 0.3, 300),
        rng.uniform(-3, 3, 300),
        np.asarray(directions)[np.arange(300) % len(directions)],
    )


@pytest.mark.parametrize("current", [None, (0.9, -1.2)])
@pytest.mark.parametrize("directions, alone", [([0.4], False), ([0.4, 0.5], True)])
def test_forces_of_a_sea_from_one_direction_are_those_of_few_frequencies(directions, alone, current, forces):
    """Beside the sum over all its waves, on a moved and turned body; of two directions all waves are summed"""
    waves, pose = sea(directions), np.array([3.0, -2.0, 0.1])
    carrier = None if current is None else SimpleNamespace(velocity=current)
    table = wave_loads.wave_table(forces, waves, np.inf, np.zeros(3), G, True, carrier)
    assert (len(table.towards) == 300) == alone and (alone or len(table.towards) < 80)
    window, given = np.zeros((ROWS, table.steps)), waves_of(table)
    meet(given, 0, pose, 50.0)
    fill_window(given, window, 0, pose, 50.0)
    t = 50.0 + table.step * (np.arange(table.steps) - EDGE)
    k, b = waves.omega**2 / G, waves.direction
    met = waves.omega + (0.0 if current is None else k * (current[0] * np.cos(b) + current[1] * np.sin(b)))
    phase = k * (pose[0] * np.cos(b) + pose[1] * np.sin(b)) + waves.phase - np.multiply.outer(t, met)
    crest = waves.amplitude * np.exp(1j * phase)
    X = np.array([force_at([w], [one - pose[2]])[0, 0] for w, one in zip(waves.omega, b, strict=True)])
    wanted, rise = (crest @ X).real.T, crest.sum(axis=1).real
    close = 1e-9 if alone else 2e-5
    assert np.abs(window[:6] - wanted).max() <= max(close, 1e-7) * np.abs(wanted).max()
    assert np.abs(window[9] - rise).max() <= close * np.abs(rise).max()


def test_nodes_are_closer_where_forces_change_quickly():
    """exp(i 40 ω) turns by 1.6 rad between nodes 0.04 rad/s apart, which six of them cannot follow, as they can ω³"""
    omega = np.linspace(0.2, 2.0, 600)
    force = np.zeros((600, HEADINGS, 12))
    force[:, :, 0], force[:, :, 6] = np.cos(40 * omega)[:, None], np.sin(40 * omega)[:, None]
    slow = wave_loads.WaveForces(omega, np.multiply.outer(omega**3, np.ones((HEADINGS, 12))), None)
    quick = wave_loads.WaveForces(omega, force, None)
    (few, _), (many, found) = slow.at_nodes, quick.at_nodes
    assert 40 <= len(few) <= 50 and len(many) >= 1.9 * len(few)
    assert found[0, :, 3, 0] == pytest.approx(np.cos(40 * many), abs=1e-4)


@pytest.mark.parametrize("count, phase", [(40, 0.3), (41, 0.6)])
def test_steps_of_forces_are_a_share_of_the_quickest_wave_and_fill_a_window(count, phase, forces):
    """0.3 rad of it with few components, 0.6 rad with many; windows of 6 s, or of 1.2 mean periods of short waves"""
    waves = Components(np.full(count, 3.0), np.ones(count), np.zeros(count), np.zeros(count))
    table = wave_loads.wave_table(forces, waves, np.inf, np.zeros(3), G)
    assert table.step == pytest.approx(phase / 3.0) and table.steps == 7 + math.ceil(
        1.2 * 2 * math.pi / 3.0 / table.step
    )
    slow = Components(np.full(count, 0.9), np.ones(count), np.zeros(count), np.zeros(count))
    table = wave_loads.wave_table(forces, slow, np.inf, np.zeros(3), G)
    assert table.window == pytest.approx(6.0, abs=table.step) and table.window >= 6.0


@pytest.mark.parametrize("window, bodies, count", [(6.0, 1, 6), (1.5, 2, 2), (7.9, 3, 7)])
def test_a_run_without_waves_has_windows_without_components(window, bodies, count):
    table = wave_loads.no_waves(window, bodies)
    assert table.step == pytest.approx(window / count) and table.window == window and len(table.omega) == 0
    assert table.force.shape == (bodies, 0, HEADINGS, 16) and table.center.shape == table.arm.shape == (bodies, 2)


@pytest.mark.parametrize("turns", [0, 2, -1])
def test_halfway_between_two_headings_the_three_on_either_side_count(turns):
    """Lagrange's weights of six points in their middle: 3, −25, 150, 150, −25, 3 over 256, here of a force and its
    imaginary part, and nothing of any other heading"""
    ring = np.zeros((1, HEADINGS, 12))
    ring[0, :, 0], ring[0, :, 8] = np.arange(HEADINGS) == 0, 1.0
    weights = [0, 3, -25, 150, 150, -25, 3, 0]
    for k, weight in enumerate(weights):
        place = turns * HEADINGS + 3.5 - k  # of the heading 0, k-th of eight about the place
        forces = wave_loads.WaveForces(np.ones(1), ring, None)
        found = wave_loads.forces_towards(forces, place * 2 * np.pi / HEADINGS)
        assert found[0, 0] == pytest.approx(weight / 256, abs=1e-11) and found[0, 2] == pytest.approx(1j)


@pytest.mark.parametrize(("symmetry", "refused"), [("xy", False), ("", True)])
def test_a_body_that_turns_needs_waves_from_all_round(symmetry, refused):
    """Stored 0 to 90°: all round with two planes of symmetry, a quarter without"""
    body = made_up_body(symmetry=symmetry)
    if not refused:
        assert wave_loads.wave_forces(body).force.shape[-1] == 12
        return
    with pytest.raises(BetweenError, match=r"the body turns in time, so that .* all round .*: wave direction"):
        wave_loads.wave_forces(body)
