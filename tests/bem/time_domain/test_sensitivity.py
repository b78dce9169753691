"""The answer of a body to an error of its memory, against one motion on a spring."""

from types import SimpleNamespace

import numpy as np

from hakobune.bem.time_domain.sensitivity import NEAR, SHARES, sensitivity

OMEGA = np.linspace(0.05, 2.0, 400)
M, B = 4e6, 3e5
SIZE = np.full(6, 800.0)


def answered(mass, stiffness):
    H = np.tile(B * np.eye(6), (len(OMEGA), 1, 1)).astype(complex)
    body = SimpleNamespace(inertia=mass, stiffness=stiffness)
    return sensitivity(body, OMEGA, H, np.zeros((6, 6)), SIZE)


def test_at_resonance_the_answer_is_that_of_all_damping():
    found = answered(M * np.eye(6), M * np.eye(6))  # of 1 rad/s
    near = np.abs(np.log(OMEGA)) <= NEAR
    expected = SIZE[2] ** 2 / (B + 2 * SHARES[2] * M)
    assert np.allclose(found[near, 2], expected, rtol=0.01)
    assert np.all(found[np.abs(np.log(OMEGA)) > 3 * NEAR, 2] < 0.9 * expected)


def test_below_heave_a_mooring_may_make_surge_resonant_at_any_frequency():
    found = answered(M * np.eye(6), np.diag([0, 0, M, M, M, 0.0]))
    low = (OMEGA > 0.1) & (OMEGA < 0.9)
    expected = SIZE[0] ** 2 / (B + 2 * SHARES[0] * M * OMEGA)
    assert np.all(found[low, 0] >= expected[low])
    assert np.all(found[low, 0] <= (1 + NEAR) * expected[low])


def test_a_body_without_mass_answers_nothing():
    assert not np.any(answered(None, np.eye(6))) and not np.any(answered(np.full((6, 6), np.nan), np.eye(6)))
