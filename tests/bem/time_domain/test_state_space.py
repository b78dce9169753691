"""State space of memories that are, and are not, of finite order."""

import numpy as np
import pytest

from bem.time_domain.retardation import Retardation
from bem.time_domain.state_space import state_space

TIMES = np.arange(0, 100.01, 0.05)
OMEGA = np.linspace(0.05, 3.0, 60)
COUPLED = np.diag([2.0, 3.0, 0, 1.0, 1.0, 0]) + 0.5 * np.eye(6, k=4) + 0.5 * np.eye(6, k=-4)
COUPLED[5, 1] = COUPLED[1, 5] = 0


def memory(function):
    return Retardation(TIMES, np.multiply.outer(function(TIMES), COUPLED), np.zeros((6, 6)))


def damped_wave(t):
    return np.exp(-0.2 * t) * np.cos(0.8 * t)


def test_a_mode_that_is_two_states_per_motion_is_found_exactly_and_passive():
    ranks = np.linalg.matrix_rank(COUPLED)
    system = state_space(memory(damped_wave), OMEGA, 0.001)
    assert system.states == 2 * ranks
    exact = np.multiply.outer(damped_wave(TIMES[::50]), COUPLED)
    assert np.abs(system.memory(TIMES[::50]) - exact).max() < 1e-8
    assert system.passive and system.least_damping > -1e-12


def test_every_system_is_stable_and_as_near_as_it_says():
    slow = memory(lambda t: 1 / (1 + 0.3 * t) ** 3 * np.cos(0.5 * t))
    for tolerance in (0.1, 0.03, 0.01):
        system = state_space(slow, OMEGA, tolerance)
        assert np.linalg.eigvals(system.A).real.max() < 0
        wanted = slow.transform(OMEGA)
        size = np.sqrt(np.abs(np.einsum("qii->qi", wanted)).max(axis=0))
        scale = np.outer(size, size)
        off = np.abs(system.transform(OMEGA) - wanted)[:, scale > 0] / scale[scale > 0]
        assert off.max() == pytest.approx(system.error, rel=1e-6) and system.error <= tolerance


def test_less_tolerance_takes_more_states_and_twice_the_same_gives_the_same():
    slow = memory(lambda t: 1 / (1 + 0.3 * t) ** 3 * np.cos(0.5 * t))
    coarse, fine, again = (state_space(slow, OMEGA, t) for t in (0.1, 0.01, 0.01))
    assert coarse.states < fine.states == again.states
    assert np.array_equal(fine.A, again.A)


def test_a_tolerance_out_of_reach_or_reason_is_refused():
    with pytest.raises(ValueError, match=r"tolerance is 0; allowed: 1e-4 to 0.5"):
        state_space(memory(damped_wave), OMEGA, 0)
    with pytest.raises(ValueError, match=r"no stable system within tolerance 0.001"):
        state_space(memory(lambda t: np.cos(0.8 * t)), OMEGA, 0.001)
