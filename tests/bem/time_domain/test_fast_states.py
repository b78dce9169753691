"""States that follow the motion at once, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
from retardation import convolution, history_weights

from hakobune.bem.time_domain.fast_states import slow_memory
from hakobune.bem.time_domain.memory import Memory, MemoryArrays, no_memory

SQUARE = np.zeros((6, 6))


def memory():
    """One slow and one fast state that decay, and a slow and a fast pair; of random inputs and outputs"""
    rng = np.random.default_rng(7)
    decay, turn = np.array([0.5, 40.0, 0.2, 9.0, 0.2, 9.0]), np.array([1.5, 12.0])  # |pole| of the pairs 1.513 and 15
    arrays = MemoryArrays(decay, turn, rng.normal(size=(6, 6)), rng.normal(size=(6, 6)))
    return Memory(arrays, np.eye(6), np.eye(6), SQUARE, SQUARE, SQUARE, (0.1, 2.0), ())


@pytest.mark.parametrize("fastest, kept", [(14.9, 3), (15.1, 5), (39.9, 5), (40.1, 6), (0.4, 0), (1.52, 3), (1.51, 1)])
def test_states_with_poles_beyond_a_frequency_become_a_damping_and_an_inertia(fastest, kept):
    """c (s − a)⁻¹ b → −c a⁻¹ b − s c a⁻² b; the rest of the transform as it was, to the second order in s"""
    whole = memory()
    slow = slow_memory(whole, fastest)
    assert len(slow.arrays.decay) == kept
    rest = Memory(slow.arrays, SQUARE, SQUARE, SQUARE, SQUARE, SQUARE, (0, 1), ())
    a, b, c = whole.matrices
    for s in (0.01j, 0.02j):
        exact = c @ np.linalg.solve(s * np.eye(6) - a, b)
        ours = rest.transform([s.imag])[0].conj() + slow.damping + s * slow.inertia
        gone = c @ np.linalg.matrix_power(np.linalg.inv(a), 3) @ b
        assert np.abs(ours - exact).max() <= 1.2 * abs(s) ** 2 * np.abs(gone).max() * (1 if kept < 6 else 1e-9) + 1e-12
    if kept == 6:
        assert not slow.damping.any() and not slow.inertia.any()


def test_a_body_without_memory_has_the_added_mass_of_its_highest_frequency():
    A = np.diag(np.arange(1.0, 7))
    between = SimpleNamespace(span=(0.2, 1.7))
    body = SimpleNamespace(between=between, coefficients=lambda w: (A[None] * w[0], None), words=tuple("abcdef"))
    found = no_memory(body)
    assert found.states == 0 and found.band == (0.2, 1.7) and found.added_mass_infinity == pytest.approx(1.7 * A)
    assert found.force(np.zeros(0)).tolist() == [0.0] * 6


def made(K, step=0.1):
    return SimpleNamespace(K=K, times=step * np.arange(len(K)))


def test_a_history_is_weighed_by_the_trapezium_rule():
    K = np.arange(1.0, 6)[:, None, None] * np.eye(6)
    weights = history_weights(made(K))
    assert weights[:, 0, 0] == pytest.approx(0.1 * np.array([0.5, 2, 3, 4, 2.5])) and K[0, 0, 0] == 1.0
    velocity = np.zeros((8, 6))
    velocity[2, 3] = 2.0
    found = convolution(made(K), velocity)
    assert found[:, 3] == pytest.approx(0.2 * np.array([0, 0, 0.5, 2, 3, 4, 2.5, 0])) and not found[:, 0].any()
