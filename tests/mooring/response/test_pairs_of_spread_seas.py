"""Slow force of pairs of waves from several directions: limits in which it is that of long crests, and its size."""

import numpy as np
import pytest

from hakobune.bem.second_order.stored import BetweenPairs
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.response.pair_levels import PairForces, SpreadPairForces
from hakobune.mooring.response.slow_drift import HORIZONTAL, force_spectrum_with

OMEGA, DIFFERENCE = np.linspace(0.3, 1.5, 25), 0.05 * np.arange(9)
FINE = np.linspace(0.3, 1.5, 200)
HEADINGS = np.radians([-90.0, -45.0, 0.0, 45.0, 90.0])
SPECTRUM = jonswap(1.0, peak_period=10.0)
BEATS = np.linspace(0.0, 0.2, 11)


def pair(first, second=None):
    """Pairs of T = (1 + i Ω)(f_a f_b) cos ω̄ of two headings, as factors of a force and its mean drift"""
    second = first if second is None else second
    middle = OMEGA + 0.5 * DIFFERENCE[:, None]
    values = first * second * (np.cos(middle) * (1 + 1j * DIFFERENCE[:, None]))[..., None] * np.arange(1.0, 7.0)
    drift = np.cos(FINE)[:, None] * np.array([1.0, 2.0, 6.0])
    return PairForces(BetweenPairs(OMEGA, DIFFERENCE, values), FINE, first**2 * drift, "body", second**2 * drift)


def spread(factors):
    pairs = {(a, b): pair(factors[a], factors[b]) for a in range(5) for b in range(5)}
    return SpreadPairForces(pairs, HEADINGS, Sea(SPECTRUM, 0.0, CosinePower(4)), "body")


def test_a_force_that_knows_no_direction_is_that_of_long_crests():
    alone = pair(1.0)
    long = force_spectrum_with(alone, SPECTRUM, FINE, alone.drift, BEATS)
    np.testing.assert_allclose(spread(np.ones(5)).spectrum(FINE, BEATS), long, rtol=1e-9)


def test_of_separable_forces_it_is_the_square_of_their_mean_over_directions():
    factors = np.array([0.2, 0.5, 1.0, 0.7, 0.1])
    share = Sea(SPECTRUM, 0.0, CosinePower(4)).directional(HEADINGS)
    mean = share @ factors**2
    alone = pair(1.0)
    long = force_spectrum_with(alone, SPECTRUM, FINE, alone.drift, BEATS)
    assert spread(factors).spectrum(FINE, BEATS) == pytest.approx(mean**2 * long, rel=1e-9)


def test_components_between_headings_have_forces_between_theirs_and_none_beside_newmans_twice():
    factors = np.array([0.2, 0.5, 1.0, 0.7, 0.1])
    rng = np.random.default_rng(2)
    omega, direction = np.sort(rng.uniform(0.5, 0.8, 20)), rng.uniform(-np.pi / 2, np.pi / 2, 20)
    components = Components(omega, np.ones(20), np.zeros(20), direction)
    between = np.interp(direction, HEADINGS, factors)
    alone = pair(1.0)
    drift = (between**2 * np.cos(omega))[:, None] * np.array([1.0, 2.0, 6.0])
    whole = alone(omega[:, None], omega)
    whole[..., HORIZONTAL] += (np.cos(omega) * np.cos(omega[:, None]))[..., None] ** 0.5 * [1.0, 2.0, 6.0]
    expected = np.multiply.outer(between, between)[..., None] * whole
    expected[..., HORIZONTAL] -= np.sqrt(drift[:, None] * drift)
    found = spread(factors).of_components(components, drift)
    near = np.abs(np.subtract.outer(omega, omega)) < 0.2  # whole, beyond it tapers
    assert found[near] == pytest.approx(expected[near], rel=1e-4, abs=1e-3)
    assert found == pytest.approx(found.conj().swapaxes(0, 1), abs=1e-12)
