"""Rational functions of known poles are found again, and reduced by balance as the text-book has it."""

import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

from hakobune.bem.time_domain.rational import System, _blocks, balanced, fitted, fractions

POLES = np.array([-0.3 + 0j, -2.0 + 0j, -0.2 + 1.1j, -0.5 + 2.3j])
S = 1j * np.linspace(0.01, 8.0, 300)


def exact(s):
    """(q, 2, 2) symmetric"""
    R = [np.array([[1, 0.2], [0.2, 0.5]]), np.array([[-0.4, 0.3], [0.3, 1.0]]),
         np.array([[0.6 + 0.2j, 0.1j], [0.1j, 0.3 - 0.4j]]), np.array([[0.2, -0.5j], [-0.5j, 0.7]])]  # fmt: skip
    out = 0
    for p, r in zip(POLES, R, strict=True):
        part = np.multiply.outer(1 / (s - p), r)
        out = out + part + (np.multiply.outer(1 / (s - p.conj()), r.conj()) if p.imag else 0)
    return out


def test_partial_fractions_are_the_response_of_their_blocks():
    """1/(s − p); of a pair 1/(s − p) + 1/(s − p̄) and i times their difference"""
    found = fractions(S, POLES)
    p = POLES[2]
    assert found[:, 0] == pytest.approx(1 / (S + 0.3)) and found.shape == (300, 6)
    assert found[:, 2] == pytest.approx(1 / (S - p) + 1 / (S - p.conj()))
    assert found[:, 3] == pytest.approx(1j / (S - p) - 1j / (S - p.conj()))
    A, b = _blocks(POLES)
    again = np.array([np.linalg.solve(s * np.eye(6) - A, b) for s in S])
    assert found == pytest.approx(again, abs=1e-12)


def test_a_rational_function_is_found_again():
    H = exact(S)
    system, off = fitted(S, H, 8, np.ones(H.shape))
    made = np.array([system.C @ np.linalg.solve(s * np.eye(len(system.A)) - system.A, system.B) for s in S])
    assert np.abs(made - H).max() < 1e-6 * np.abs(H).max() and off == pytest.approx(np.abs(made - H).max(), abs=1e-9)
    assert np.linalg.eigvals(system.A).real.max() < 0
    poles = np.linalg.eigvals(system.A)
    for p in POLES:
        assert np.abs(poles - p).min() < 1e-3


def test_what_is_missed_is_told_times_its_weight():
    H, weight = exact(S), np.ones((300, 2, 2))
    weight[:, 0, 0] = 3.0
    system, off = fitted(S, H, 6, weight)
    made = np.array([system.C @ np.linalg.solve(s * np.eye(len(system.A)) - system.A, system.B) for s in S])
    assert off == pytest.approx((np.abs(made - H) * weight).max(), rel=1e-6)


def test_states_that_are_left_out_of_balance_follow_the_others_at_once():
    """Liu and Anderson (1989): A₁₁ − A₁₂A₂₂⁻¹A₂₁, B₁ − A₁₂A₂₂⁻¹B₂, C₁ − C₂A₂₂⁻¹A₂₁ of the balanced system, whose
    singular values are √λ(W_c W_o)"""
    A, b = _blocks(POLES)
    C = np.array([[1.0, -0.4, 0.6, 0.2, 0.3, -0.1]])
    system = System(A, b[:, None], C)
    whole = balanced(system)
    reached, seen = solve_continuous_lyapunov(A, -system.B @ system.B.T), solve_continuous_lyapunov(A.T, -C.T @ C)
    assert whole.values**2 == pytest.approx(np.sort(np.linalg.eigvals(reached @ seen).real)[::-1], rel=1e-6, abs=1e-12)
    root = np.linalg.cholesky(reached)
    U, size, _ = np.linalg.svd(root.T @ seen @ root)
    turn = root @ U / size**0.25
    A, B, C = np.linalg.solve(turn, A @ turn), np.linalg.solve(turn, system.B), C @ turn
    for n in (3, 5, 6):
        kept, gone = slice(0, n), slice(n, 6)
        at_once = A[kept, gone] @ np.linalg.inv(A[gone, gone])
        back = C[:, gone] @ np.linalg.inv(A[gone, gone])
        less = A[kept, kept] - at_once @ A[gone, kept], B[kept] - at_once @ B[gone], C[:, kept] - back @ A[gone, kept]
        found = whole.reduced(n)
        assert len(found.A) == n and np.linalg.eigvals(found.A).real.max() < 0
        for s in S[::60]:
            ours = found.C @ np.linalg.solve(s * np.eye(n) - found.A, found.B)
            assert ours == pytest.approx(less[2] @ np.linalg.solve(s * np.eye(n) - less[0], less[1]), rel=1e-5)


def test_poles_that_one_entry_lacks_are_found_from_the_others():
    """Common poles follow from the equations of all entries together, whichever comes first"""
    first, other = np.array([-0.2 + 1.1j, -0.5 + 2.3j])
    H = np.zeros((300, 2, 2), complex)
    for (i, j), p in (((0, 0), first), ((1, 1), other), ((0, 1), other), ((1, 0), other)):
        H[:, i, j] = 1 / (S - p) + 1 / (S - p.conj())
    system, off = fitted(S, H, 8, np.ones(H.shape))
    assert off < 1e-6
    found = np.linalg.eigvals(system.A)
    for p in (first, other):
        assert np.abs(found - p).min() < 1e-6
