"""The floating hemisphere in deep water: limits, radiated energy, convergence."""

import numpy as np
import pytest
from exact.hemisphere import HEAVE, SURGE, hemisphere, singularities


def test_long_waves_leave_half_the_mass_of_the_sphere_in_surge():
    """A rigid lid mirrors the hemisphere into a whole sphere in unbounded water."""
    mass, damping = hemisphere(1e-4, SURGE)
    assert mass == pytest.approx(0.5, abs=1e-4)
    assert damping < 1e-10


def test_short_waves_leave_half_the_mass_of_the_sphere_in_heave():
    """φ = 0 on z = 0 continues the flow to a whole sphere moving rigidly; waves add terms of order 1/Ka."""
    errors = [abs(hemisphere(Ka, HEAVE)[0] - 0.5) for Ka in (10, 20, 40)]
    assert errors[0] < 0.03
    assert errors[2] < 0.55 * errors[1] < 0.55**2 * errors[0]


def legendre_limit(mode, terms=400):
    """Added mass with φ_z = 0 (heave) or φ = 0 (surge) on z = 0, by Legendre series on the sphere.

    The normal velocity is continued evenly (heave) or oddly (surge) and expanded in Pₙᵐ, φₙ = −gₙ Pₙᵐ/(n+1).
    """
    x, w = np.polynomial.legendre.leggauss(3 * terms)
    x, w = (x + 1) / 2, w / 2
    total, m = 0.0, 0 if mode == HEAVE else 1
    low, high = np.zeros_like(x), np.ones_like(x) if m == 0 else np.sqrt(1 - x * x)
    for n in range(m, terms):
        even = (n - m) % 2 == 0
        if even == (mode == HEAVE):
            normal = -x if mode == HEAVE else np.sqrt(1 - x * x)
            size = np.sum(w * high**2)
            total += np.sum(w * normal * high) ** 2 / size / (n + 1)
        low, high = high, ((2 * n + 1) * x * high - (n + m) * low) / (n - m + 1)
    return 1.5 * (2 if mode == HEAVE else 1) * total


def test_surge_tends_to_the_value_without_waves():
    limit = legendre_limit(SURGE)
    assert limit == pytest.approx(0.2732, abs=1e-4)  # Hulme (1982)
    errors = [abs(hemisphere(Ka, SURGE)[0] - limit) for Ka in (10, 20, 40)]
    assert errors[2] < 0.6 * errors[1] < 0.6**2 * errors[0]


def test_heave_tends_to_the_value_under_a_lid():
    """The lid value 0.8310 is approached like Ka ln Ka."""
    limit = legendre_limit(HEAVE)
    assert limit == pytest.approx(0.8310, abs=1e-4)  # Hulme (1982)
    small = 1e-4
    assert abs(hemisphere(small, HEAVE)[0] - limit) < small * abs(np.log(small))


def test_damping_in_long_waves_is_that_of_a_source_or_a_dipole():
    """Haskind with the undisturbed wave and, in surge, half again as much for the accelerated body."""
    Ka = 1e-3
    assert hemisphere(Ka, HEAVE)[1] == pytest.approx(0.75 * np.pi * Ka, rel=5e-3)
    assert hemisphere(Ka, SURGE)[1] == pytest.approx(1.5**2 * np.pi / 6 * Ka**3, rel=5e-3)


@pytest.mark.parametrize("mode", [HEAVE, SURGE])
@pytest.mark.parametrize("Ka", [0.05, 1.0, 8.0])
def test_singularities_are_harmonic_and_obey_the_free_surface(Ka, mode):
    """Radial velocities match a difference quotient of the same functions scaled to another radius."""
    theta, step = np.linspace(0.2, 1.5, 7), 1e-4

    def at(radius):  # Φ(Rx; K) is homogeneous in R and 1/K
        n = np.arange(1, 6)
        m = 0 if mode == HEAVE else 1
        powers = np.append(1 + m, 2 * n + 1 + m)
        return singularities(Ka * radius, mode, theta, 5)[0] * radius ** -powers.astype(float)

    quotient = (at(1 + step) - at(1 - step)) / (2 * step)
    slope = singularities(Ka, mode, theta, 5)[1]
    np.testing.assert_allclose(slope, quotient, rtol=1e-5, atol=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("mode", [HEAVE, SURGE])
@pytest.mark.parametrize("Ka", [0.05, 1.0, 8.0])
def test_more_singularities_change_nothing_that_matters(Ka, mode):
    np.testing.assert_allclose(hemisphere(Ka, mode), hemisphere(Ka, mode, terms=90), atol=5e-6)


@pytest.mark.parametrize("mode", [HEAVE, SURGE])
def test_damping_at_all_frequencies_accounts_for_the_added_mass_at_none(mode):
    """Kramers and Kronig at ω = 0: A(0) − A(∞) = (1/π) ∫ (B/ω) dK / K, here over ln K from e⁻⁹ to e⁴.

    Left out: B/ω ~ K below, 1e-4 at most, and ~ K⁻² above, half its last value.
    """
    step = 0.25
    damping = np.array([hemisphere(K, mode, terms=30)[1] for K in np.exp(np.arange(-9, 4 + step / 2, step))])
    total = step * (damping.sum() - (damping[0] + damping[-1]) / 2) + damping[0] + damping[-1] / 2
    lid, surface = (0.5, legendre_limit(SURGE)) if mode == SURGE else (legendre_limit(HEAVE), 0.5)
    assert total / np.pi == pytest.approx(lid - surface, abs=1e-4)


def test_what_it_cannot_compute_is_refused():
    with pytest.raises(ValueError, match="Ka"):
        hemisphere(0.0, HEAVE)
    with pytest.raises(ValueError, match="mode 'pitch'"):
        hemisphere(1.0, "pitch")
