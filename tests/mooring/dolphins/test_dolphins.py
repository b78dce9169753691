"""Dolphins: equivalent linearisation, exact periods, design spectrum method, earthquake."""

import numpy as np
import pytest
from scipy.special import ellipk

from hakobune.mooring.dolphins.design_spectrum import (
    LARGEST,
    Beam,
    DolphinError,
    Dolphins,
    limit_height,
    springs,
    strains,
)
from hakobune.mooring.dolphins.earthquake import (
    Fenders,
    Floater,
    Ground,
    by_spectrum,
    course,
    ground_of_record,
    normalised_reaction,
    response_spectrum,
)
from hakobune.mooring.dolphins.linearised import equivalent
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.fenders.fender import fender_of_points
from hakobune.mooring.fenders.hysteresis import followed

K, CUBE, M = 2.0, 1.0, 3.0
K1, K2, CORNER = 5.0, 1.0, 0.4
CELL = fender_of_family("cell", 2.0)


def duffing(y):
    return K * y + CUBE * y**3


def bilinear(y):
    return np.sign(y) * np.where(np.abs(y) < CORNER, K1 * np.abs(y), K1 * CORNER + K2 * (np.abs(y) - CORNER))


@pytest.mark.parametrize("A", [0.5, 1.0, 2.0])
def test_equivalent_stiffness_and_exact_period_of_duffings_oscillator(A):
    """k + ¾εA², whose frequency is within 0.8 % of the exact one, an elliptic integral, up to εA²/k = 2"""
    assert equivalent(duffing, 0.0, A).stiffness == pytest.approx(K + 0.75 * CUBE * A * A, rel=1e-9)
    stiff = K + CUBE * A * A
    exact = 0.5 * np.pi * np.sqrt(stiff / M) / ellipk(CUBE * A * A / (2 * stiff))
    assert np.sqrt(equivalent(duffing, 0.0, A).stiffness / M) == pytest.approx(exact, rel=8e-3)


@pytest.mark.parametrize("A", [0.5, 1.0, 2.0])
def test_equivalent_stiffness_of_a_bilinear_oscillator(A):
    r = CORNER / A
    wanted = K2 + 2 / np.pi * (K1 - K2) * (np.arcsin(r) + r * np.sqrt(1 - r * r))
    assert equivalent(bilinear, 0.0, A).stiffness == pytest.approx(wanted, rel=1e-6)


def test_loss_is_the_work_of_a_loop():
    path = 0.5 + 0.3 * np.cos(2 * np.pi * np.arange(8193) / 4096)
    force = followed(CELL, path)[0][4096:]
    work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(path[4096:]))
    assert np.pi * equivalent(CELL, 0.5, 0.3).loss * 0.3**2 == pytest.approx(work, rel=1e-3) and work > 0


def test_natural_frequency_moves_with_wave_height_as_the_report_found():
    """SR179 (1982), 3.7.2: fender 1, of constant reaction, softens and sways more; 2, hardening, stiffens"""
    constant = [equivalent(bilinear, 0.0, A).stiffness for A in (0.2, 0.5, 1.0, 2.0)]
    hardening = [equivalent(duffing, 0.0, A).stiffness for A in (0.2, 0.5, 1.0, 2.0)]
    assert np.all(np.diff(constant) < 0) and np.all(np.diff(hardening) > 0)


def sway(drift=0.0):
    """`Beam` of a body that only sways, with a force that does not change with frequency"""
    omega = np.linspace(0.05, 3.0, 2000)
    eye = np.diag([1.0, 1e8, 1.0, 1.0, 1.0, 1.0])
    force = np.zeros((2000, 6), complex)
    force[:, 1] = 1e6
    still = np.broadcast_to(np.zeros((6, 6)), (2000, 6, 6))
    hold = np.diag([1.0, 0.0, 1.0, 1.0, 1.0, 1.0])
    inertia = np.broadcast_to(eye, (2000, 6, 6))
    return Beam(omega, inertia, still, hold, force, np.full(2000, drift), np.zeros(3))


def test_stiff_fenders_follow_the_force_and_strains_add_what_the_report_adds():
    stiff = Dolphins(CELL, np.array([[-20.0, 25.0, 0.0], [20.0, 25.0, 0.0]]), 1e13)
    s = strains(sway(drift=3e4), stiff, 1e6, issc(1.0, mean_period=8.0))
    assert s.sigma == pytest.approx(1e6 / 2e13 * 0.25, rel=2e-3)  # √m₀ = Hs/4
    assert s.static == pytest.approx((1e6 + 2 * 3e4 / 16) / 2e13, rel=2e-3)
    assert s.largest == pytest.approx(s.static + LARGEST * s.sigma) and abs(LARGEST - 3.872) < 1e-3
    assert springs(stiff, np.zeros(3), 1.0)[1, 1] == 2.0


def test_limit_height_is_where_the_strain_is_just_allowed_and_grows_with_the_fenders():
    found = []
    for count in (4, 8):
        dolphins = Dolphins(CELL, np.tile([0.0, 25.0, 0.0], (count, 1)), 6.9e8)
        found.append(limit_height(sway(), dolphins, 1e6, issc, 8.0, highest=1e4))
        assert strains(sway(), dolphins, 1e6, issc(1.0, mean_period=8.0), found[-1]).strain == pytest.approx(
            0.35, rel=1e-2
        )
    assert found[1] > found[0]
    with pytest.raises(DolphinError, match="kN; use more or larger fenders"):
        strains(sway(), Dolphins(CELL, np.zeros((1, 3))), 1e9, issc(1.0, mean_period=8.0))


def ground_of_sine(omega, size, duration, step=0.05):
    t = np.arange(0, duration, step)
    turn = omega * t
    return Ground(t, -(omega**2) * size * np.sin(turn), omega * size * np.cos(turn), size * np.sin(turn))


def amplitude(t, x, omega):
    basis = np.stack([np.cos(omega * t), np.sin(omega * t)], axis=1)
    return np.hypot(*np.linalg.lstsq(basis, x, rcond=None)[0])


def spring(k):
    return fender_of_points("spring", 1.0, [0.0, 1.0], [0.0, k])


@pytest.mark.parametrize("omega", [0.8, 2.1])
def test_reaction_to_an_earthquake_is_its_closed_form_in_time(omega):
    mass, added, damping, size = 1e6, 4e5, 8e5, 0.05
    run = course(ground_of_sine(omega, size, 90.0), Floater(mass, added, damping), Fenders(spring(1.5e6), 2))
    late = run.time > 60
    found = amplitude(run.time[late], run.reaction[late], omega) / (omega**2 * size * mass)
    assert found == pytest.approx(normalised_reaction(omega, mass, added, damping, 3e6), rel=1e-6)


def test_memory_of_the_water_has_the_reaction_of_its_coefficients():
    """One state: c/(s + 1/τ) in place of damping, whose added mass and damping vary with frequency"""
    floater = Floater(1e6, 2e5, 4e5, np.array([[-0.5]]), np.array([1.0]), np.array([4e5]))
    A, B = (float(x[0]) for x in floater.water(1.3))
    assert pytest.approx(A, rel=1e-12) == 2e5 - 4e5 / (0.25 + 1.69)
    assert pytest.approx(B, rel=1e-12) == 4e5 + 4e5 * 0.5 / (0.25 + 1.69)
    run = course(ground_of_sine(1.3, 0.05, 120.0), floater, Fenders(spring(3e6)))
    late = run.time > 90
    found = amplitude(run.time[late], run.reaction[late], 1.3) / (1.69 * 0.05 * 1e6)
    assert found == pytest.approx(normalised_reaction(1.3, 1e6, A, B, 3e6), rel=1e-6)


def test_reaction_to_an_earthquake_has_its_limits():
    assert normalised_reaction(0.5, 1e6, 4e5, 10.0, 1e15) == pytest.approx(1.4, rel=1e-6)
    assert normalised_reaction(2e3, 1e6, 4e5, 1e3, 1e6) == pytest.approx(1e6 / (4e6 * 1e6), rel=1e-6)


def test_spectrum_of_a_record_gives_the_reaction_of_springs_in_time():
    rng, t = np.random.default_rng(1), np.arange(0, 20, 0.02)
    record = rng.standard_normal(len(t)) * np.sin(np.pi * t / 20)
    ground = ground_of_record(t, record, after=5.0)
    assert np.allclose(ground.acceleration[: len(t)] - record, np.linspace(*ground.base_line, len(t)), atol=1e-12)
    floater, fenders = Floater(1e6, 4e5, 2 * 0.05 * np.sqrt(1.4e6 * 3e7)), Fenders(spring(1.5e7), 2)
    found = by_spectrum(floater, fenders, lambda T: response_spectrum(ground, [T])[0])
    assert found.ratio == pytest.approx(0.05, rel=1e-6)
    assert found.period == pytest.approx(2 * np.pi * np.sqrt(1.4e6 / 3e7), rel=1e-9)
    run = course(ground, floater, fenders)
    assert found.reaction == pytest.approx(np.abs(run.reaction).max(), rel=0.1)  # damped against water, not ground


def test_clearance_lets_the_ground_go_by_and_returns_lose_energy():
    ground, floater = ground_of_sine(1.3, 0.04, 30.0), Floater(1e6, 4e5, 0.0)
    assert np.abs(course(ground, floater, Fenders(CELL, 1, 0.05)).reaction).max() == 0.0
    quiet = fender_of_points("no loss", 2.0, np.linspace(0, 1.0, 40), CELL.loading(np.linspace(0, 1.0, 40)))
    with_loss, without = (course(ground, floater, Fenders(one)).body[-200:].std() for one in (CELL, quiet))
    assert with_loss < without


def test_record_of_an_earthquake_begins_and_ends_at_rest():
    rng, t = np.random.default_rng(4), np.arange(0, 20, 0.02)
    ground = ground_of_record(t, rng.standard_normal(len(t)) * np.exp(-0.2 * t) + 0.01)
    ends = [ground.velocity[-1], ground.displacement[-1]]
    assert np.abs(ends).max() < 1e-12 and ground.velocity[0] == ground.displacement[0] == 0
    assert response_spectrum(ground, [0.01], 0.05)[0] == pytest.approx(np.abs(ground.acceleration).max(), rel=0.05)
    with pytest.raises(ValueError, match=r"is 0\.04 s after"):
        ground_of_record(np.delete(t, 100), np.zeros(len(t) - 1))
    with pytest.raises(ValueError, match="finite accelerations"):
        ground_of_record(t, np.full(len(t), np.nan))
