"""Amplitude-dependent viscous damping by equivalent linearisation."""

import numpy as np
import pytest
from scipy.integrate import quad

from hakobune.bem import DOFS
from hakobune.bem.motions import response
from hakobune.bem.viscous import (
    EQUIVALENT_AMPLITUDE,
    Quadratic,
    Tabulated,
    Viscous,
    linearised_response,
    report_scale,
    yamashita_roll,
)
from hakobune.bem.viscous_table import viscous_of_text

ROLL = DOFS.index("Roll")
INERTIA = np.diag([1e6, 1e6, 1e6, 2e8, 2e8, 2e8])
STIFFNESS = np.diag([0, 0, 4e6, 3e8, 7e8, 0.0])
ADDED = 0.5 * INERTIA
FORCE = np.array([[1e5, 0, 2e6, 3e7, 0, 0]], complex)
RESONANCE = np.sqrt(STIFFNESS[ROLL, ROLL] / (1.5 * INERTIA[ROLL, ROLL]))


def roll_at(wave, omega=RESONANCE, drag=4e9, damping=0.0):
    viscous = Viscous({"Roll": Quadratic(drag)}, wave)
    B = np.eye(6) * damping
    return abs(linearised_response(omega, ADDED, B, FORCE, INERTIA, STIFFNESS, viscous)[0][0, ROLL]) * wave


def test_equivalent_damping_takes_the_energy_of_quadratic_drag_out_of_a_cycle():
    a, omega, law = 0.3, 1.7, Quadratic(5.0)
    lost = quad(lambda t: 5.0 * abs(a * omega * np.sin(omega * t)) ** 3, 0, 2 * np.pi / omega, limit=200)[0]
    assert law.equivalent(omega, a) * np.pi * omega * a**2 == pytest.approx(lost, rel=1e-9)


def test_equivalent_amplitude_takes_the_power_of_irregular_motion():
    """Gaussian velocity: E|v|³ = 2√(2/π) σ³ against N σ²."""
    sigma, omega = 0.2, 1.3
    power = 5.0 * 2 * np.sqrt(2 / np.pi) * (omega * sigma) ** 3
    assert Quadratic(5.0).equivalent(omega, EQUIVALENT_AMPLITUDE * sigma) * (omega * sigma) ** 2 == pytest.approx(power)


def test_resonant_amplitude_without_other_damping_is_the_root_of_the_force():
    """ω N a = F with N = (8/3π) ω a N₂"""
    for wave in (0.5, 2.0):
        expected = np.sqrt(3 * np.pi / 8 * abs(FORCE[0, ROLL]) * wave / (4e9 * RESONANCE**2))
        assert roll_at(wave) == pytest.approx(expected, rel=1e-9)


def test_resonant_response_per_wave_height_falls_as_waves_grow():
    heights = np.array([0.1, 0.5, 1.0, 3.0])
    per_wave = [roll_at(h, damping=1e6) / h for h in heights]
    assert np.all(np.diff(per_wave) < 0)


def test_small_waves_and_distant_frequencies_feel_no_viscous_damping():
    B = 1e6 * np.eye(6)
    for wave, omega in ((1e-9, RESONANCE), (0.01, 0.2 * RESONANCE)):
        free = abs(response(omega, ADDED, B, FORCE, INERTIA, STIFFNESS)[0, ROLL]) * wave
        assert roll_at(wave, omega, damping=1e6) == pytest.approx(free, rel=1e-3)


def test_tabulated_damping_that_grows_with_amplitude_is_quadratic_drag():
    omega = 0.9
    table = Tabulated(3.0, (0.1, 0.2), (0.5, 1.0))
    drag = Quadratic(3.0 * omega * 5.0 * 3 * np.pi / 8)
    for a in (0.0, 0.05, 0.13, 0.2):
        assert table.equivalent(omega, a) == pytest.approx(drag.equivalent(omega, a), rel=1e-12)


def test_yamashita_gives_the_printed_b_at_one_degree():
    """SR179 report (1982), section 2.1.4: N̂ = b_R ξ_B at 1°; the two at B/d = 10 leave b_R √ξ_B open by 1 %."""
    L, B, rho, g = 80.0, 40.0, 1025.0, 9.80665
    for ratio, xi, printed, last in ((5, 0.25, 0.031, 5e-4), (5, 2.25, 0.0103, 5e-5), (10, 0.25, 0.055, 5e-4),
                                     (10, 2.25, 0.0185, 1e-4)):  # fmt: skip
        omega = np.sqrt(2 * g * xi / B)
        N = yamashita_roll(L, B, B / ratio, rho).equivalent(omega, np.radians(1.0))
        b = N * np.sqrt(B / (2 * g)) / (rho * L * B * (B / ratio) * (B / 2) ** 2) / xi
        assert abs(b - printed) <= last
        scale = report_scale("Roll", L, B, B / ratio, rho, g)
        assert Tabulated(scale, (np.radians(1.0),), (b,)).equivalent(omega, np.radians(1.0)) == pytest.approx(N)


def test_yamashitas_damping_is_of_the_size_that_the_model_in_irregular_waves_had():
    """M3B, L × B × d = 3.872 × 1.936 × 0.194 m: Table 2.4.4.1 has k_xx 0.674 m and T 1.78 s; appendix 1 has rolls of
    2° (σ 1.06°) that two per cent of critical damping explain.  A factor of two is what its scatter leaves."""
    L, B, d, rho = 3.872, 1.936, 0.194, 1000.0
    omega, mass = 2 * np.pi / 1.78, rho * L * B * d
    inertia = mass * 0.674**2 + 0.566 * mass * (B / 2) ** 2  # added inertia of section 2.4.4
    damping = yamashita_roll(L, B, d, rho).equivalent(omega, np.radians(2.0))
    assert 0.01 < damping / (2 * inertia * omega) < 0.04


def test_boxes_outside_the_theory_are_refused():
    with pytest.raises(ValueError, match="give b_R"):
        yamashita_roll(100, 60, 3, 1025)
    with pytest.raises(ValueError, match="increase"):
        Tabulated(1.0, (0.2, 0.1), (1.0, 2.0))


def test_a_motion_that_only_another_motion_brings_about_is_found():
    """Heave moves pitch by the stiffness between them; no wave does"""
    inertia, stiffness = np.diag([1e6] * 3 + [1e8] * 3), np.diag([1e6] * 3 + [1e8] * 3)
    stiffness[2, 4] = stiffness[4, 2] = 1e6
    force = np.zeros((1, 6), complex)
    force[0, 2] = 1e5
    law = Viscous({"Pitch": Quadratic(1e8)}, 1.0)
    X, extra = linearised_response(0.8, np.zeros((6, 6)), np.zeros((6, 6)), force, inertia, stiffness, law)
    again = response(0.8, np.zeros((6, 6)), law.damping(0.8, np.abs(X[0])), force, inertia, stiffness)
    assert np.abs(X[0, 4]) > 0 and extra[0, 4, 4] > 0
    np.testing.assert_allclose(X, again, rtol=1e-8, atol=1e-12)


def test_the_reports_normalisation_of_pitch_is_that_of_roll_with_length_and_beam_exchanged():
    """Eq. 2.1.4.6 by hand: N = b ρ B d L √(B/2g) ω² B/2g √(2g/B) (B/2)² = b ρ L B d √(B/2g) (B/2)² ω² in roll; a box
    that is turned a quarter pitches as it rolled, so L stands for B; heave has no lever."""
    rho, g, d = 1000.0, 10.0, 3.0
    L, B = 80.0, 20.0  # √(B/2g) = 1 s, √(L/2g) = 2 s
    assert report_scale("Heave", L, B, d, rho, g) == pytest.approx(1000 * 80 * 20 * 3 * 1.0)
    assert report_scale("Roll", L, B, d, rho, g) == pytest.approx(1000 * 80 * 20 * 3 * 1.0 * 10**2)
    assert report_scale("Pitch", L, B, d, rho, g) == pytest.approx(1000 * 80 * 20 * 3 * 2.0 * 40**2)
    # through the table that users write: b 0.02 at 2° of each
    text = "[viscous]\nwave_height = 2.0\n" + "".join(
        f"{mode} = {{ amplitudes{unit} = [2.0], b = [0.02] }}\n"
        for mode, unit in (("heave", ""), ("roll", "_deg"), ("pitch", "_deg"))
    )
    viscous = viscous_of_text(text, {"length": L, "beam": B, "draft": d}, rho, g)
    damping = viscous.damping(0.5, np.array([0, 0, 1.0, np.radians(2), np.radians(1), 0]))
    hand = 4.8e6 * 0.25 * np.array([0.01, 0.02 * 100, 0.01 * 2 * 1600])
    assert np.diag(damping)[2:5] == pytest.approx(hand)
    assert viscous.wave_amplitude == 1.0
