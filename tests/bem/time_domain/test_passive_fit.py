"""Passive systems of made-up modes: their equations by Lyapunov's, derivatives by differences, a fit of their own H."""

import numpy as np
import pytest
from scipy.linalg import block_diag, solve_continuous_lyapunov

from hakobune.bem.time_domain import passive_fit as module
from hakobune.bem.time_domain.passive_fit import _least_squares, _modes, _Problem, passive_fit

A = block_diag([[-0.4]], [[-0.3, 1.1], [-1.1, -0.3]], [[-0.5, 0.6], [-0.6, -0.5]])
MIX = np.random.default_rng(1).normal(size=(5, 5))
A = MIX @ A @ np.linalg.inv(MIX)
B = np.random.default_rng(2).normal(size=(5, 2))
ONE = B[:, :1]
S = 1j * np.linspace(0.05, 3.0, 30)


def transfer(a, b, c, s):
    return np.array([c @ np.linalg.solve(one * np.eye(len(a)) - a, b) for one in s])


def passive(B=B):
    """C = BᵀP of a loss L with LᵀA⁻¹B = 0, so large that H is 1 at most"""
    m = B.shape[1]
    free = np.linalg.svd(np.linalg.solve(A, B))[0][:, m:]
    L = free @ np.random.default_rng(3).normal(size=(5 - m, m))
    c = B.T @ solve_continuous_lyapunov(A.T, -L @ L.T)
    return c / np.abs(transfer(A, B, c, S)).max()


def test_modes_have_rates_of_the_matrix_and_inputs_of_the_size_of_their_decay():
    """|b|² = 2 Re(−λ): real ones first, then those that turn one way, then the other; the basis is unitary"""
    modes = _modes(A, B)
    assert modes.pairs == 2 and modes.rate[0] == pytest.approx(-0.4) and modes.rate[0].imag == 0
    assert sorted(modes.rate[1:3].imag) == pytest.approx([0.6, 1.1]) and modes.rate[3:] == pytest.approx(
        modes.rate[1:3].conj()
    )
    assert np.linalg.norm(modes.input, axis=1) ** 2 == pytest.approx(-2 * modes.rate.real)
    assert not np.abs(modes.input[0].imag).max() > 1e-12 and modes.input[3:] == pytest.approx(modes.input[1:3].conj())
    basis = modes.basis
    assert basis @ basis.conj().T == pytest.approx(np.eye(5), abs=1e-12)
    real = (basis.conj().T * modes.rate) @ basis
    assert np.abs(real.imag).max() < 1e-12 and np.abs((basis.conj().T @ modes.input).imag).max() < 1e-12


def problem(weight=None):
    H = transfer(A, B, passive(), S)
    return _Problem(_modes(A, B), S, H, np.ones(H.shape) if weight is None else weight), H


def test_what_is_lost_follows_from_the_loss_by_lyapunov_s_equation():
    """AᵀP + PA = −LLᵀ, H = BᵀP (s − A)⁻¹ B, and H(0) = 0 whichever Z"""
    one, _ = problem()
    Z = np.random.default_rng(4).normal(size=(3, 2))
    modes = one.modes
    a = ((modes.basis.conj().T * modes.rate) @ modes.basis).real
    b, L = (modes.basis.conj().T @ modes.input).real, one.free @ Z
    assert np.abs(L.T @ np.linalg.solve(a, b)).max() < 1e-12
    P = solve_continuous_lyapunov(a.T, -L @ L.T)
    true = transfer(a, b, b.T @ P, np.append(1e-12, S))
    assert one.transfer(Z) == pytest.approx(true, abs=1e-9)
    hermitian = one.transfer(Z)[1:] + one.transfer(Z)[1:].conj().swapaxes(1, 2)
    assert np.linalg.eigvalsh(hermitian).min() > -1e-10


def test_slopes_are_those_of_differences():
    weight = np.random.default_rng(5).uniform(1, 3, size=(30, 2, 2))
    one, _ = problem(weight)
    Z, step = np.random.default_rng(6).normal(size=(3, 2)), 1e-6
    slopes = one.slopes(Z)
    for k in range(6):
        change = np.zeros(6)
        change[k] = step
        there, back = (one.misses(Z + sign * change.reshape(3, 2)) for sign in (1, -1))
        assert slopes[k] == pytest.approx((there - back) / (2 * step), abs=1e-5)
    off = (one.transfer(Z) - one.wanted)[1:] * weight
    count = one.wanted.size
    assert one.misses(Z)[4:count] == pytest.approx(off.real.ravel())
    assert one.misses(Z)[:4] == pytest.approx(300 * one.transfer(Z)[0].real.ravel())  # H(0) = 0, a heavy sample
    assert one.weights[0].tolist() == [[300.0, 300.0], [300.0, 300.0]] and np.array_equal(one.weights[1:], weight)
    assert one.worst(Z) == pytest.approx(max(np.abs(off).max(), module.STEADY * np.abs(one.transfer(Z)[0]).max()))


def test_an_output_free_of_conditions_is_found_by_least_squares():
    """Of a system that is not passive, all of it"""
    c = np.random.default_rng(7).normal(size=(2, 5))
    c -= c @ np.linalg.solve(A, B) @ np.linalg.pinv(np.linalg.solve(A, B))  # H(0) = 0
    H = transfer(A, B, c, S)
    one = _Problem(_modes(A, B), S, H, np.ones(H.shape))
    found, miss = one.output()
    assert miss < 1e-9
    real = (
        one.modes.basis.conj().T @ one.modes.input,
        ((one.modes.basis.conj().T * one.modes.rate) @ one.modes.basis).real,
    )
    assert transfer(real[1], real[0].real, found, S) == pytest.approx(H, abs=1e-8)


def test_a_passive_system_is_found_again_and_keeps_its_equations():
    H = transfer(A, ONE, passive(ONE), S)
    found, error = passive_fit(A, ONE, S, H)
    assert error < 1e-9
    n, p = len(found.decay), len(found.turn)
    a = -np.diag(found.decay)
    for i in range(p):
        k = n - 2 * p + i
        a[k, k + p], a[k + p, k] = found.turn[i], -found.turn[i]
    assert transfer(a, found.input.T, found.output, S) == pytest.approx(H, abs=1e-6)
    assert a.T @ found.storage + found.storage @ a == pytest.approx(-found.loss @ found.loss.T, abs=1e-8)
    assert found.output == pytest.approx(found.input @ found.storage, abs=1e-8)
    assert np.abs(found.loss.T @ np.linalg.solve(a, found.input.T)).max() < 1e-8
    assert (
        sorted(found.decay) == pytest.approx(sorted([0.4, 0.3, 0.3, 0.5, 0.5]))
        and np.linalg.eigvalsh(found.storage).min() > -1e-9
    )


def test_what_an_output_without_conditions_misses_by_a_fifth_more_than_allowed_is_not_tried():
    H = transfer(A, B, passive(), S)
    H[10] += 0.5  # no system of these modes has it
    _, miss = _Problem(_modes(A, B), S, H, np.ones(H.shape)).output()
    assert passive_fit(A, B, S, H, miss / 1.21) == (None, pytest.approx(miss))
    found, error = passive_fit(A, B, S, H, miss / 1.19)
    assert found is not None and error > 0.5 * miss


def test_rounds_end_at_the_tolerance():
    H = transfer(A, ONE, passive(ONE), S)
    one = _Problem(_modes(A, ONE), S, H, np.ones(H.shape))
    Z = one.start(one.output()[0]) + 0.1
    rough, fine = (_least_squares(one, Z, share * np.abs(H).max()) for share in (0.1, 1e-7))
    assert one.worst(rough) <= 0.1 * np.abs(H).max() and one.worst(fine) < one.worst(Z)
    assert np.array_equal(_least_squares(one, Z, 2 * one.worst(Z)), Z)


def test_the_largest_miss_of_an_output_counts_over_all_entries_and_at_rest():
    """|C (s − A)⁻¹ B − H| times its weight; at ω = 0 |C A⁻¹ B| times 300"""
    weight = np.random.default_rng(8).uniform(1, 3, size=(30, 2, 2))
    H = transfer(A, B, passive(), S)
    H[7, 1, 0] += 0.3
    modes = _modes(A, B)
    one = _Problem(modes, S, H, weight)
    found, miss = one.output()
    a, b = ((modes.basis.conj().T * modes.rate) @ modes.basis).real, (modes.basis.conj().T @ modes.input).real
    off = np.abs(transfer(a, b, found, S) - H) * weight
    at_rest = 300.0 * np.abs(found @ np.linalg.solve(a, b))
    assert miss == pytest.approx(max(off.max(), at_rest.max())) and miss > 3 * off.mean()
