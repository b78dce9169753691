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


def test_every_motion_answers_by_its_damping_mass_and_springs():
    """1/|B + 2ζω(M + A) + i(C/ω − ω(M + A))| of one motion, A = A∞ − Im H/ω; ζ 5 % in surge, sway and yaw, 1 % else;
    the largest within 5 % of the frequency"""
    added, mass, C = 1e6, 3e6, 2e6
    H = np.tile((B - 2e5j) * np.eye(6), (len(OMEGA), 1, 1))
    body = SimpleNamespace(inertia=mass * np.eye(6), stiffness=C * np.eye(6))
    found = sensitivity(body, OMEGA, H, added * np.eye(6), SIZE)
    total = mass + added + 2e5 / OMEGA
    alone = [
        SIZE[0] ** 2 / np.abs(B + 2 * zeta * OMEGA * total + 1j * (C / OMEGA - OMEGA * total)) for zeta in (0.05, 0.01)
    ]
    near = np.abs(np.log(OMEGA[:, None] / OMEGA)) <= 0.05
    for mode, one in zip((0, 1, 2, 3, 4, 5), (0, 0, 1, 1, 1, 0), strict=True):
        expected = alone[one]
        if mode in (0, 1, 5):  # held at resonance below that of heave
            resonant = SIZE[0] ** 2 / (B + 2 * 0.05 * OMEGA * total)
            expected = np.where(OMEGA**2 * total < C, np.maximum(expected, resonant), expected)
        np.testing.assert_allclose(found[:, mode], [expected[some].max() for some in near], rtol=1e-9)
