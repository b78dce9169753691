"""Memory of a box in shallow water: near its database, passive whatever the motion, the same as convolution."""

import re
import warnings
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from retardation import convolution, from_database

from hakobune.bem.database import open_database
from hakobune.bem.database.reader import reader
from hakobune.bem.modes import words_of
from hakobune.bem.time_domain.memory import CLOSE, _by_causality, _check_deviation, memory_of_database
from hakobune.bem.time_domain.memory_kernels import memory_force, memory_rate
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

BAND = {"band": {"from": 0.1, "to": 2.0}}


def database(path, waves=BAND):
    scene = {
        "water": {"depth": 12.0},
        "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}],
        "waves": waves,
        "tolerance": 0.005,
        "want": ["radiation", "added_mass_infinity"],
    }
    solve(make_scene(scene), path)
    return open_database(path)


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    return reader(database(tmp_path_factory.mktemp("memory") / "box.h5"))


@pytest.fixture(scope="module")
def memory(box):
    return memory_of_database(box, 3e-3)


def difference(memory, body, omega):
    """Largest (6, 6) of B + iω (A(∞) − A), relative to √(ii · jj)"""
    A, B = body.coefficients(omega)
    wanted = B + 1j * omega[:, None, None] * (memory.added_mass_infinity - A)
    size = np.sqrt(np.abs(np.einsum("qii->qi", wanted)).max(axis=0))
    return np.abs(memory.transform(omega) - wanted).max(axis=0) / np.outer(size, size)


def test_the_database_is_met_between_its_frequencies_to_the_reported_error(memory, box):
    off = difference(memory, box, np.linspace(0.107, 1.993, 500))
    assert memory.error.max() <= 3e-3
    # the size of a motion is its largest in the band here, not over all frequencies
    assert np.all(off <= 1.1 * (memory.error + memory.deviation) + 1e-12)


def test_no_history_of_velocities_can_take_energy_out(memory):
    a, b, c = memory.matrices
    P, loss = memory.storage, memory.loss
    size = np.abs(P).max()
    assert np.abs(a.T @ P + P @ a + loss @ loss.T).max() <= 1e-12 * size * np.abs(a).max()
    assert np.abs(P @ b - c.T).max() <= 1e-12 * np.abs(c).max()
    assert np.linalg.eigvalsh(P).min() >= -1e-12 * size
    assert np.linalg.eigvals(a).real.max() < 0


def test_work_of_random_motions_is_stored_or_lost(memory):
    a, b, _ = memory.matrices
    step, rng = 0.02, np.random.default_rng(4)
    turn = np.linalg.inv(np.eye(memory.states) - 0.5 * step * a)
    into = step * turn @ b
    turn = turn @ (np.eye(memory.states) + 0.5 * step * a)
    states, work, lost = np.zeros(memory.states), 0.0, 0.0
    for velocity in rng.standard_normal((4000, 6)) * [1, 1, 1, 0.02, 0.02, 0.02]:
        new = turn @ states + into @ velocity
        middle = 0.5 * (states + new)  # the midpoint rule keeps the balance of energy exactly
        work += step * memory.force(middle) @ velocity
        lost += step * memory.lost_power(middle)
        states = new
        assert work >= 0
    assert work == pytest.approx(memory.stored_energy(states) + lost, rel=1e-10)


def test_steady_motion_is_not_resisted(memory):
    a, b, c = memory.matrices
    size = np.sqrt(np.einsum("qii->qi", np.abs(memory.transform(np.linspace(0.1, 2, 100)))).max(axis=0))
    share = c @ np.linalg.solve(a, b) / np.outer(size, size)
    assert np.abs(share + share.T).max() <= 1e-12  # no work
    assert np.abs(share).max() <= 1e-5


def test_states_and_convolution_differ_by_no_more_than_their_transforms(memory, box):
    from scipy.signal import lsim

    step, count = 0.1, 2000
    direct = from_database(box, np.arange(0, 200, step), 600)
    frequencies = np.fft.rfftfreq(count, step) * 2 * np.pi
    noise = np.fft.rfft(np.random.default_rng(3).standard_normal((count, 6)), axis=0)
    noise = np.fft.irfft(noise * np.exp(-0.5 * (frequencies / 0.7) ** 2)[:, None], count, axis=0)
    velocity = np.vstack([noise * np.sin(np.linspace(0, np.pi, count))[:, None] ** 2, np.zeros((1000, 6))])
    points = np.linspace(0.001, 6, 2000)
    size = np.sqrt(np.einsum("qii->qi", np.abs(memory.transform(points))).max(axis=0))
    gap = (memory.transform(points) - direct.transform(points)) / np.outer(size, size)
    velocity /= size  # power counts alike in all motions
    a, b, c = memory.matrices
    states = lsim((a, b, c, np.zeros((6, 6))), velocity, step * np.arange(len(velocity)))[1]
    apart = np.linalg.norm((states - convolution(direct, velocity)) / size)
    largest = np.linalg.norm(gap, 2, axis=(1, 2)).max()
    # Parseval, and (ωh)²/12 of the trapezium rule up to 2 rad/s, beyond which nothing moves
    assert apart <= (largest + (2 * step) ** 2 / 12) * np.linalg.norm(velocity * size)
    assert largest <= 2 * (memory.error + memory.deviation).max()


def test_motions_that_symmetry_keeps_apart_stay_apart(memory):
    assert set(memory.groups) == {(0, 4), (1, 3), (2,), (5,)}
    apart = np.ones((6, 6), bool)
    for group in memory.groups:
        apart[np.ix_(group, group)] = False
    assert np.all(memory.transform([0.3, 1.0])[:, apart] == 0)


def test_states_grow_as_the_tolerance_shrinks(box, memory):
    finer = memory_of_database(box, 1e-3)
    assert memory.states < finer.states
    assert finer.error.max() <= 1e-3 < memory.error.max()


def test_kernels_are_the_equation(memory):
    rng = np.random.default_rng(1)
    states, velocity = rng.standard_normal(memory.states), rng.standard_normal(6)
    rate, force = np.zeros(memory.states), np.zeros(6)
    memory_rate(memory.arrays, states, velocity, rate)
    memory_force(memory.arrays, states, force)
    assert np.allclose(rate, memory.rate(states, velocity), rtol=1e-12, atol=1e-12 * np.abs(rate).max())
    assert np.allclose(force, memory.force(states), rtol=1e-12, atol=1e-12 * np.abs(force).max())


def test_retardation_is_the_answer_to_a_push(memory):
    from scipy.linalg import expm

    a, b, c = memory.matrices
    exact = c @ expm(3.7 * a) @ b
    assert memory.retardation([3.7])[0] == pytest.approx(exact, abs=1e-11 * np.abs(exact).max())


def test_bands_and_tolerances_that_cannot_do_are_refused(box, tmp_path):
    with pytest.raises(
        ValueError, match=r"tolerance of the memory of the water \(retardation functions\) is 0; allowed: 1e-5 to 0.1"
    ):
        memory_of_database(box, 0)
    few = database(tmp_path / "few.h5", {"omegas": [0.3, 0.6, 0.9]})
    with pytest.raises(
        ValueError,
        match="the memory of the water needs radiation at 8 or more frequencies, and 3 are stored; solve a band",
    ):
        memory_of_database(few)


def changed(box, **values):
    return replace(box, between=replace(box.between, quantities=box.between.quantities | values))


def test_rounding_of_yaw_is_no_motion(box):
    """A mesh of revolution: added mass in yaw of its facets, with another limit, beside a thousand times the inertia"""
    A, B = (np.array(box.between.quantities[name]) for name in ("added_mass", "radiation_damping"))
    inertia = np.diag([6e7] * 3 + [2e10, 6e10, 1e6])
    A[:, 5, 5] = 1e6 + np.linspace(-500.0, 300.0, len(A))
    B[:, 5, 5] = -1e-6
    found = memory_of_database(replace(changed(box, added_mass=A, radiation_damping=B), inertia=inertia), 3e-2)
    assert (5,) not in found.groups and found.groups
    assert found.added_mass_infinity[5, 5] == pytest.approx(1e6, rel=1e-3)  # not what is stored as the limit


def test_only_the_motions_asked_for_are_fitted(box):
    A = np.array(box.between.quantities["added_mass"])
    A[:, 4] = A[:, :, 4] = np.nan
    holed = changed(box, added_mass=A)
    found = memory_of_database(holed, 1e-2, motions=(1, 5))
    assert found.groups == ((1,), (5,)) and not found.matrices[2][[0, 2, 3, 4]].any()
    with pytest.raises(ValueError, match="added_mass is not stored for all motions"):
        memory_of_database(holed, 1e-2)


def test_frequencies_that_contradict_the_rest_are_left_out(box):
    A, high = np.array(box.between.quantities["added_mass"]), box.omega > 1.85
    A[high, 1, 1] *= np.where(np.arange(np.sum(high)) % 2, 3.0, 0.3)
    with pytest.warns(
        UserWarning, match=r"above 1.81 rad/s contradict those at lower frequencies by .* leave out the higher"
    ):
        found = memory_of_database(changed(box, added_mass=A), 1e-2, motions=(1,))
    assert found.band[1] == pytest.approx(0.1 + 0.9 * 1.9)


@pytest.mark.parametrize("share, told", [(0.9, ""), (1.1, "warned"), (9.9, "warned"), (10.1, "refused")])
def test_coefficients_that_contradict_each_other_are_told_and_then_refused(share, told):
    """By more than what is good, and by more than what is allowed; the pair and its damping at both ends are named"""
    good, allowed = CLOSE
    worst = share * good if share < 5 else share / 10 * allowed
    deviation, size = np.zeros((6, 6)), np.ones(6)
    deviation[0, 4] = worst
    damping = np.stack([np.diag([0.25, 1, 1, 1, 1, 1.0]), np.diag([0.5, 1, 1, 1, 1, 1.0])])
    call = lambda: _check_deviation(deviation, (0.2, 1.5), damping, size, words_of(()))  # noqa: E731
    words = "from 0.2 to 1.5 rad/s contradict each other by .*surge–pitch.*surge is 0.25 of the largest .* and 0.5 at"
    if told == "refused":
        with pytest.raises(ValueError, match=words):
            call()
        return
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    assert len(caught) == (told == "warned")
    assert not caught or re.search(words, str(caught[0].message))


@pytest.mark.parametrize(("by_damping", "taken"), [(0.099, True), (0.101, False)])
def test_a_stored_limit_that_denies_the_band_gives_way_to_that_of_damping(monkeypatch, by_damping, taken):
    """Where the other agrees; what is stored stays, to be refused, where neither does"""
    goals = {
        stored: SimpleNamespace(deviation=np.array([[off]]), band=(0.2, 2.0))
        for stored, off in ((True, 0.27), (False, by_damping))
    }
    module = "hakobune.bem.time_domain.memory._goal"
    monkeypatch.setattr(module, lambda body, band, motions, stored=True: goals[stored])
    body = SimpleNamespace(between=SimpleNamespace(span=(0.2, 2.0)))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        assert _by_causality(body, goals[True], ()) is goals[not taken]
    assert len(said) == taken and (not taken or "by 0.27 of the largest from" in str(said[0].message))


def test_a_band_whose_limit_and_upper_end_are_off_is_taken_as_far_as_it_agrees(monkeypatch):
    """WAMIT's set of RM3: A(∞) denies every part of the band, and its upper half the lower"""

    def goal(body, band, motions, stored=True):
        off = 0.34 if stored else 0.5 * (band[1] - 1.0)
        return SimpleNamespace(deviation=np.array([[off]]), band=band)

    monkeypatch.setattr("hakobune.bem.time_domain.memory._goal", goal)
    body = SimpleNamespace(between=SimpleNamespace(span=(0.2, 2.0), ringing=()))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = _by_causality(body, goal(body, (0.2, 2.0), ()), ())
    assert found.band == pytest.approx((0.2, 1.1)) and found.deviation == pytest.approx(0.05)
    assert "above 1.1 rad/s" in str(said[0].message) and "0.34 of the largest" in str(said[1].message)
