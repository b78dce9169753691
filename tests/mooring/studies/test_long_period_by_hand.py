"""One slow motion by hand: its added mass, its damping, the spectrum of its displacement."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.studies.long_period import _one

MASS, BAND = 3.0e6, np.array([0.2, 2.0])


def body(added, damping=lambda omega: 0.0):
    """Of a mass in surge alone, added(ω) and damping(ω) between the frequencies BAND"""

    def alone(value):
        found = np.zeros((1, 6, 6))
        found[0, 0, 0] = value
        return found

    def coefficients(omega):
        assert BAND[0] <= omega[0] <= BAND[1]
        return alone(added(omega[0])), alone(damping(omega[0]))

    inertia = alone(MASS)[0]
    return SimpleNamespace(
        inertia=inertia, omega=BAND, held_added_mass=lambda omega: alone(added(float(omega))), coefficients=coefficients
    )


def one(held, K, N, omega=None, force=None):
    omega = np.linspace(0, 1.0, 20001)[1:] if omega is None else omega
    force = np.full(len(omega), 1e8) if force is None else force
    return _one(held, K, 0, omega, force, 0.0, lambda sigma: N, 0.0)


@pytest.mark.parametrize("natural", [0.05, 0.3, 0.8])
def test_added_mass_is_that_of_the_natural_frequency(natural):
    """K = ω²{m + A(ω)}, A = 10⁶ (1 + ω/5) kg"""
    added = lambda omega: 1e6 * (1 + omega / 5)  # noqa: E731
    K = natural**2 * (MASS + added(natural))
    period, damping, _ = one(body(added), K, 2e4)
    assert period == pytest.approx(2 * math.pi / natural, rel=1e-5)
    assert damping == pytest.approx(2e4 / (natural * (MASS + added(natural))), rel=1e-5)


@pytest.mark.parametrize(("natural", "share"), [(0.05, 0.25), (0.1, 0.5), (0.2, 1.0), (0.9, 1.0)])
def test_radiation_below_the_stored_frequencies_falls_with_frequency(natural, share):
    """ν = N/√(mK) = N/(m ω₀), with the damping of the first stored frequency times its share below it"""
    mass = MASS + 1e6
    radiated = lambda omega: 1e5 * omega  # noqa: E731
    period, damping, _ = one(body(lambda omega: 1e6, radiated), mass * natural**2, 0.0)
    assert period == pytest.approx(2 * math.pi / natural)
    assert damping == pytest.approx(share * radiated(max(natural, 0.2)) / (mass * natural))


def test_a_flat_spectrum_gives_the_closed_form():
    """σ² = π S/(2 N K) of a force of S over every frequency"""
    mass, natural, N, S = MASS + 1e6, 0.3, 1.2e5, 1e8
    omega = np.linspace(0, 40.0, 400001)[1:]
    K = mass * natural**2
    found = one(body(lambda omega: 1e6), K, N, omega, np.full(len(omega), S))
    assert found[2] == pytest.approx(math.sqrt(math.pi * S / (2 * N * K)), rel=1e-4)


def test_damping_is_of_its_own_velocity_and_that_of_the_waves_together():
    """N = c √(σ_w² + σ_v²), σ_v² = π S/(2 N m) of a flat spectrum: solved by bisection"""
    mass, natural, S, waves, c = MASS + 1e6, 0.3, 1e10, 0.2, 2e5
    low, high = 1.0, 1e7
    for _ in range(200):
        N = math.sqrt(low * high)
        if c * math.sqrt(waves**2 + math.pi * S / (2 * N * mass)) > N:
            low = N
        else:
            high = N
    omega = np.linspace(0, 60.0, 600001)[1:]
    K = mass * natural**2
    force = np.full(len(omega), S)
    _, damping, spread = _one(body(lambda omega: 1e6), K, 0, omega, force, waves, lambda sigma: c * sigma, 0.0)
    assert damping == pytest.approx(N / math.sqrt(mass * K), rel=2e-3)
    assert spread == pytest.approx(math.sqrt(math.pi * S / (2 * N * K)), rel=2e-3)


@pytest.mark.parametrize("K", [0.0, -10.0])
def test_nothing_holds_a_motion_without_stiffness(K):
    assert np.isnan(one(body(lambda omega: 1e6), K, 1.0)).all()
