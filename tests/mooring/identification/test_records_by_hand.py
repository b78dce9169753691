"""Records by hand: the sine in one, the swings of one, what can be used and what not."""

import math

import numpy as np
import pytest

from hakobune.mooring.identification.decay import decay
from hakobune.mooring.identification.forced import forced
from hakobune.mooring.identification.record import RecordError, checked, sine_of

T = np.arange(0.0, 60.0, 0.1)


def test_a_sine_has_its_mean_amplitude_frequency_and_phase():
    found = sine_of(T, 0.7 + 2.0 * np.sin(1.3 * T + 0.4))
    assert found == pytest.approx((0.7, 2.0, 1.3, 0.4, 0.0), abs=1e-7)


def test_what_a_sine_leaves_is_a_root_mean_square():
    """The third harmonic of 0.1 over whole cycles leaves 0.1/√2"""
    t = np.arange(0.0, 20 * math.pi, math.pi / 100)
    found = sine_of(t, np.sin(t) + 0.1 * np.sin(3 * t))
    assert (found.amplitude, found.off) == pytest.approx((1.0, 0.1 / math.sqrt(2)), rel=2e-3)


def test_times_begin_at_0_and_a_constant_force_is_of_no_account():
    """Pure B₁ with a mean force; the phase of the harmonics is that of the motion"""
    V = 2.0 * 1.3
    force = 500.0 - 40.0 * V * np.cos(1.3 * T + 0.4) + 7.0 * V * 1.3 * np.sin(1.3 * T + 0.4)
    found = forced(T + 100.0, 0.7 + 2.0 * np.sin(1.3 * T + 0.4), force)
    assert (found.added_mass, found.linear, found.quadratic) == pytest.approx((7.0, 40.0, 0.0), abs=1e-5)
    assert found.by_harmonics == pytest.approx((40.0, 0.0), abs=1e-4)
    assert found.off == pytest.approx(0.0, abs=1e-6)
    assert checked(T + 100.0, T)[0] == pytest.approx(T, abs=1e-12)


def test_what_no_damping_explains_is_left_over():
    """A second harmonic f₂ beside a first f₁: f₂/√(f₁² + f₂²)"""
    t = np.arange(0.0, 20 * math.pi, math.pi / 100)
    found = forced(t, np.sin(t), -3.0 * np.cos(t) + 0.4 * np.sin(2 * t))
    assert found.linear == pytest.approx(3.0, rel=1e-3)
    assert found.off == pytest.approx(0.4 / math.hypot(3.0, 0.4), rel=1e-3)


@pytest.mark.parametrize("mean", [0.0, 2.5])
def test_a_linear_decay_loses_the_same_share_at_every_half_cycle(mean):
    """x = e^(−δt) cos(ω_d t): X_(n+1)/X_n = q = e^(−πδ/ω_d) and a = 2(1 − q)/(1 + q), b = 0, Ω² = ω_d² + δ²"""
    delta, own = 0.03, 1.1
    t = np.arange(0.0, 60.0, 0.1)
    x = np.exp(-delta * t) * (np.cos(own * t) + delta / own * np.sin(own * t))
    found = decay(t, mean + x)
    q = math.exp(-math.pi * delta / own)
    assert found.linear == pytest.approx(2 * delta, rel=1e-5)
    assert found.omega == pytest.approx(math.hypot(own, delta), rel=1e-6)
    assert (found.mean, found.quadratic) == pytest.approx((mean, 0.0), abs=1e-4)
    assert found.extremes[1:-1] / found.extremes[:-2] == pytest.approx(np.full(len(found.extremes) - 2, q), rel=0.02)
    assert found.extremes[0] == pytest.approx(q, rel=5e-3)  # of the first swing to the other side
    assert found.linear_only == pytest.approx(2 * (1 - q) / (1 + q), rel=0.02)
    assert found.off == pytest.approx(0.0, abs=1e-6) and found.fitted == pytest.approx(mean + x, abs=1e-6)


def test_a_record_at_either_side_of_what_is_used():
    checked(T[:16], T[:16])
    with pytest.raises(RecordError, match="15 times; allowed: 16 or more"):
        checked(T[:15], T[:15])
    with pytest.raises(RecordError, match="600 times; allowed"):
        checked(T, T[:599])
    uneven = T.copy()
    uneven[30:] += 4.5e-4
    checked(uneven, T)
    uneven[30:] += 1.0e-4
    with pytest.raises(RecordError, match=r"is 0.10055 s after 2.9 s and 0.1 s elsewhere;"):
        checked(uneven, T)
    with pytest.raises(RecordError, match="s elsewhere; allowed: increasing times without gaps"):
        checked(-T, T)
    bad = T.copy()
    bad[6] = np.inf
    with pytest.raises(RecordError, match="row 7 of the record"):
        checked(T, T, bad)


@pytest.mark.parametrize(("cycles", "fine"), [(2.02, True), (1.95, False)])
def test_a_sine_needs_two_cycles(cycles, fine):
    motion = np.sin(2 * math.pi * cycles * T / T[-1])
    if fine:
        assert sine_of(T, motion).omega * T[-1] == pytest.approx(2 * math.pi * cycles)
        return
    with pytest.raises(RecordError, match="cycles; allowed: two or more"):
        sine_of(T, motion)


def test_a_body_that_does_not_move_has_no_damping():
    with pytest.raises(RecordError, match="does not move"):
        forced(T, np.zeros(len(T)), np.sin(T))


@pytest.mark.parametrize(("rate", "fine"), [(0.01, True), (-0.01, False)])
def test_a_motion_that_grows_has_no_decay(rate, fine):
    motion = np.exp(-rate * T) * np.cos(1.1 * T)
    if fine:
        assert decay(T, motion).linear == pytest.approx(2 * rate, rel=1e-4)
        return
    with pytest.raises(RecordError, match=r"grows by .* % in half a cycle"):
        decay(T, motion)


def test_errors_of_damping_are_those_of_what_is_left_of_the_force():
    """s √[(BᵀB)⁻¹] with s = 0.4/√2; sums of cos², |cos|³ and cos⁴ are n/2, 4n/3π and 3n/8"""
    t = np.arange(0.0, 40 * math.pi, math.pi / 100)
    found = forced(t, np.sin(t), -3.0 * np.cos(t) + 0.4 * np.sin(2 * t))
    determinant = 3 / 16 - (4 / (3 * math.pi)) ** 2
    wanted = (0.4 / math.sqrt(2) * math.sqrt(share / (len(t) * determinant)) for share in (3 / 8, 1 / 2))
    assert found.error == pytest.approx(tuple(wanted), rel=2e-3)


def test_an_uneven_motion_leaves_a_doubt_of_its_phase_and_so_of_the_damping():
    """σ/a √(2/n) rad of a sine with the rest σ = 0.1/√2 beside its amplitude a = 2, and A ω times as much of B₁"""
    t = np.arange(0.0, 40 * math.pi, math.pi / 100)
    found = forced(t, 2 * np.sin(t) + 0.1 * np.sin(3 * t), 7.0 * 2 * np.sin(t))
    assert found.added_mass == pytest.approx(7.0, rel=1e-3)
    assert found.motion.off == pytest.approx(0.1 / math.sqrt(2), rel=2e-3)
    assert found.error[0] == pytest.approx(7.0 * 1.0 * math.sqrt(2 / len(t)) * 0.1 / math.sqrt(2) / 2, rel=0.02)


def test_one_damping_of_the_same_energy_and_of_the_same_force_have_their_share_of_the_quadratic_one():
    """8/3π ωa B₂ beside B₁, and ωa B₂"""
    t = np.arange(0.0, 40 * math.pi, math.pi / 100)
    v = 2 * 1.5 * np.cos(1.5 * t)
    found = forced(t, 2 * np.sin(1.5 * t), -3 * v - 0.5 * v * np.abs(v))
    assert (found.linear, found.quadratic) == pytest.approx((3.0, 0.5), rel=1e-3)
    assert found.same_energy == pytest.approx(3.0 + 8 / (3 * math.pi) * 3.0 * 0.5, rel=1e-3)
    assert found.same_force == pytest.approx(3.0 + 3.0 * 0.5, rel=1e-3)
    assert found.fitted(t + 5.0) == pytest.approx(-3 * v - 0.5 * v * np.abs(v), abs=0.02)
