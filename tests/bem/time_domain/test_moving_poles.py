"""Poles that move: derivatives by differences, passivity whatever they are, and fits that come nearer."""

import numpy as np
import pytest

from hakobune.bem.time_domain.moving_poles import (
    Moving,
    _across,
    _shifted,
    _slopes,
    _steady,
    _steady_slopes,
    _step,
    moved,
    real_basis,
    storage,
    transfer,
)
from hakobune.bem.time_domain.passive_fit import _least_squares, _Modes, _Problem

S = 1j * np.linspace(0.05, 4.0, 60)


def system(motions, seed=0, alone=3, pairs=4):
    rng = np.random.default_rng(seed)
    basis = real_basis(alone, pairs)
    upper = -rng.uniform(0.1, 0.8, pairs) + 1j * np.linspace(0.3, 2.5, pairs)
    rate = np.concatenate([-rng.uniform(0.2, 3.0, alone), upper, upper.conj()])
    into, loss = (basis @ rng.standard_normal((len(rate), motions)) for _ in range(2))
    into *= (np.sqrt(-2 * rate.real) / np.linalg.norm(into, axis=1))[:, None]
    return _steady(Moving(rate, into, loss, pairs))


def steady_output(one):
    return (one.loss.conj().T @ (one.input / one.rate[:, None])).real


@pytest.mark.parametrize("motions", [1, 2, 3])
def test_derivatives_are_those_of_differences(motions):
    one, h = system(motions), 1e-6
    across = _across(one)
    slopes, held = _slopes(one, S, across), _steady_slopes(one, across)
    for k in range(len(slopes)):
        step = np.zeros(len(slopes))
        step[k] = h
        up, down = _shifted(one, step), _shifted(one, -step)
        by_difference = (transfer(up, S) - transfer(down, S)).ravel() / (2 * h)
        assert np.abs(slopes[k] - by_difference).max() <= 1e-6 * (1 + np.abs(by_difference).max())
        by_difference = (steady_output(up) - steady_output(down)).ravel() / (2 * h)
        assert np.abs(held[k] - by_difference).max() <= 1e-6 * (1 + np.abs(by_difference).max())


@pytest.mark.parametrize("motions", [1, 2])
def test_derivatives_of_a_fit_with_the_same_poles_are_those_of_differences(motions):
    """Misses are of second degree in Z: central differences are exact"""
    one, rng = system(motions), np.random.default_rng(2)
    weight = rng.uniform(0.5, 2.0, (len(S), motions, motions))
    problem = _Problem(_Modes(one.rate, one.input, real_basis(3, 4), 4), S, transfer(one, S), weight)
    Z = rng.standard_normal((len(one.rate) - motions, motions))
    slopes = problem.slopes(Z)
    assert len(slopes) == Z.size
    for k, step in enumerate(np.eye(Z.size).reshape(-1, *Z.shape)):
        by_difference = (problem.misses(Z + step) - problem.misses(Z - step)) / 2
        assert np.abs(slopes[k] - by_difference).max() <= 1e-10 * np.abs(by_difference).max()


@pytest.mark.parametrize("motions", [1, 2])
def test_energy_is_only_stored_and_lost_wherever_the_poles_are(motions):
    one = system(motions, seed=5)
    H, P = transfer(one, S), storage(one)
    lost = np.einsum("nl,qn,nj->qlj", one.loss.conj(), 1 / (S[:, None] - one.rate), one.input)
    assert np.allclose(H + H.conj().swapaxes(1, 2), lost.conj().swapaxes(1, 2) @ lost, atol=1e-10 * np.abs(H).max())
    assert np.linalg.eigvalsh(P).min() >= -1e-12 * np.abs(P).max()
    assert np.abs(steady_output(one)).max() <= 1e-12 * np.abs(one.loss).max()


def test_a_system_that_was_shifted_is_found_again():
    exact = system(2, seed=2)
    off = 0.02 * np.random.default_rng(1).standard_normal(len(_slopes(exact, S, _across(exact))))
    wanted = transfer(exact, S)
    begun, weight = _steady(_shifted(exact, off)), np.full(wanted.shape, 1e4 / np.abs(wanted).max())
    found = moved(begun, S, wanted, weight)
    first, last = (np.abs((transfer(one, S) - wanted) * weight).max() for one in (begun, found))
    assert last <= 1 < 0.02 * first


class Valley:
    """Misses 10 (y − x²) and 1 − x of Rosenbrock's valley, one complex miss, whose slopes run across it"""

    def misses(self, Z):
        x, y = Z.ravel()
        return np.array([10 * (y - x * x), 1 - x])

    def slopes(self, Z):
        return np.array([[-20 * Z[0, 0], -1.0], [10.0, 0.0]])


def test_steps_that_make_a_miss_larger_are_damped_until_they_do_not():
    """From (−1.2, 1), of size 4.9, where a whole step goes up to 48"""
    far = np.array([[-1.2, 1.0]])
    found = _least_squares(Valley(), far, 1e-9)
    assert found == pytest.approx(np.ones((1, 2)), abs=1e-6)


@pytest.mark.parametrize("motions", [2, 3])
def test_inputs_turn_across_themselves_and_alike_in_conjugate_modes(motions):
    """Unit vectors at right angles to b_k and to each other; those of conjugate modes are conjugate, so that the
    system stays real"""
    one = system(motions)
    across = np.array(_across(one))
    assert across.shape == (motions - 1, len(one.rate), motions)
    for k, b in enumerate(one.input):
        own = across[:, k]
        assert np.abs(own @ b.conj()).max() < 1e-12
        assert own @ own.conj().T == pytest.approx(np.eye(motions - 1), abs=1e-12)
    assert np.array_equal(across[:, 7:], across[:, 3:7].conj())
    step = 0.1 * np.random.default_rng(8).standard_normal(len(_slopes(one, S, list(across))))
    turned = _shifted(one, step)
    assert transfer(turned, S.conj()) == pytest.approx(transfer(turned, S).conj())


def test_a_decay_changes_by_half_at_most_and_becomes_no_slower_than_the_slowest():
    """exp(±0.7) in a step; what is slower already stays"""
    one = system(1)
    for size in (5.0, -5.0):
        step = np.zeros(len(_slopes(one, S, [])))
        step[:7] = size
        assert _shifted(one, step).rate.real[:7] / one.rate.real[:7] == pytest.approx(
            np.exp(np.clip(size, -0.7, 0.7)) * np.ones(7)
        )
    slowest = 0.9 * -one.rate.real.max()
    step = np.zeros(len(_slopes(one, S, [])))
    step[:7] = -0.7
    assert -_shifted(one, step, slowest).rate.real.max() == pytest.approx(slowest)
    assert -_shifted(one, step, 100.0).rate.real[:7] == pytest.approx(-one.rate.real[:7])


def test_a_system_stays_passive_and_real_and_its_size_is_in_its_losses():
    """|b_k| = √(2 decay) after any step; H turns with the angle of turns over |λ|"""
    one = system(2)
    rng = np.random.default_rng(4)
    step = 0.2 * rng.standard_normal(len(_slopes(one, S, _across(one))))
    there = _shifted(one, step)
    assert np.linalg.norm(there.input, axis=1) == pytest.approx(np.sqrt(-2 * there.rate.real))
    old = one.rate[3:7]
    assert there.rate[3:7].imag == pytest.approx(old.imag + step[7:11] * np.abs(old))
    assert np.array_equal(there.rate[7:], there.rate[3:7].conj())


@pytest.mark.parametrize("motions, power", [(1, 4), (2, 8)])
def test_a_step_goes_down_the_slope_of_the_power_sum_and_leaves_steady_motion_free(motions, power):
    """Σ|e|ᵖ by differences over p; of a large damping the step is that slope over the damping and the diagonal
    Σ |e|ᵖ⁻² [(p − 1) (∂|e|)² + (|e| ∂ arg e)²]; the last condition holds to first order"""
    one, rng = system(motions), np.random.default_rng(9)
    weight = rng.uniform(0.5, 2.0, (len(S), motions, motions))
    wanted = transfer(one, S) + rng.normal(size=weight.shape) + 1j * rng.normal(size=weight.shape)
    count, h = len(_slopes(one, S, _across(one))), 1e-6

    def misses(step):
        return (transfer(_shifted(one, step), S) - wanted) * weight

    off = misses(np.zeros(count))
    step = _step(one, S, off, weight, power)
    by_difference, own = np.zeros(count), np.zeros(count)
    for k, way in enumerate(np.eye(count) * h):
        there, back = misses(way), misses(-way)
        by_difference[k] = (np.sum(np.abs(there) ** power) - np.sum(np.abs(back) ** power)) / (2 * h * power)
        slope = (there - back) / (2 * h) * off.conj() / np.abs(off)
        own[k] = np.sum(np.abs(off) ** (power - 2) * ((power - 1) * slope.real**2 + slope.imag**2))
    held = _steady_slopes(one, _across(one))
    damping = 1e9
    normal = 1e6 * own.mean() * (held @ held.T) + damping * np.diag(own)
    assert step(damping) == pytest.approx(-np.linalg.solve(normal, by_difference), rel=1e-3, abs=1e-14)
    least = step(1e-2)
    assert np.abs(held.T @ least).max() < 1e-3 * np.abs(held).max() * np.abs(least).max()
    assert by_difference @ least < 0
