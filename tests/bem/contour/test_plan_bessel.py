"""Bessel functions on cells against the laws that bind them and against those of SciPy."""

import numpy as np
import pytest
from scipy import special

from hakobune.bem.contour.plan.bessel import WIDTH, decaying_pair, radiating_pair

RANGES = [(1e-12, 1e-3), (1e-3, 2.0), (2.0, 8.0), (8.0, 35.0)]


def between(low, high):
    return np.geomspace(low, high, 4001)


@pytest.mark.parametrize("low, high", [*RANGES, (35.0, 1000.0)])
def test_functions_of_travelling_waves_have_their_wronskian(low, high):
    """J₁Y₀ − J₀Y₁ = 2/πx (DLMF 10.5.2); a thousand radians are known to 1e-13 only"""
    x = between(low, high)
    H0, H1 = radiating_pair(x)
    np.testing.assert_allclose(H1.real * H0.imag - H0.real * H1.imag, 2 / np.pi, rtol=3e-13)


@pytest.mark.parametrize("low, high", RANGES)
def test_functions_of_decaying_waves_have_their_wronskian(low, high):
    """I₀K₁ + I₁K₀ = 1/x (DLMF 10.28.2)"""
    x = between(low, high)
    K0, K1 = decaying_pair(x)
    np.testing.assert_allclose(special.i0(x) * K1 + x * special.i1(x) * K0, 1, rtol=3e-14)


@pytest.mark.parametrize("low, high", RANGES)
def test_functions_are_those_of_scipy(low, high):
    x = between(low, high)
    expected = special.k0(x), x * special.k1(x), special.hankel1(0, x), x * special.hankel1(1, x)
    for ours, theirs in zip((*decaying_pair(x), *radiating_pair(x)), expected, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=3e-14)


def test_there_is_no_step_between_cells():
    edges = WIDTH * np.arange(1, 60)
    for pair in (decaying_pair, radiating_pair):
        for below, above in zip(pair(np.nextafter(edges, 0)), pair(edges), strict=True):
            np.testing.assert_allclose(below, above, rtol=3e-14)


def test_what_has_died_away_is_zero_and_no_points_give_none():
    for part in decaying_pair(np.array([40.0, 1e3, 1e300, np.nan])):
        assert np.all(part[:3] == 0) and np.isnan(part[3])
    assert all(len(part) == 0 for pair in (decaying_pair, radiating_pair) for part in pair(np.empty(0)))
