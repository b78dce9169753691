"""Curves through points beside those of scipy, which has the same slopes and cubics."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from hakobune.mooring.loads.smooth import parabolic, smooth


def points(rng):
    """x rising and y of random points: some in one column, some monotone, some with a step that is level"""
    n = rng.integers(2, 9)
    x, y = np.sort(rng.random(n)), rng.standard_normal((n, 2) if rng.random() < 0.5 else n)
    y = np.sort(y, axis=0) if rng.random() < 0.3 else y
    y[rng.integers(n)] = y[0]
    return x, y, [rng.integers(n)] if rng.random() < 0.5 else []


@pytest.mark.parametrize("curve", [smooth, parabolic])
def test_curves_are_the_cubics_of_scipy(curve):
    rng = np.random.default_rng(1984)
    for _ in range(300):
        x, y, flat = points(rng)
        slope = PchipInterpolator(x, y).derivative()(x) if curve is smooth else np.gradient(y, x, axis=0)
        slope[flat] = 0.0
        at = np.concatenate([x, rng.uniform(x[0], x[-1], 5)])
        np.testing.assert_allclose(curve(x, y, flat)(at), CubicHermiteSpline(x, y, slope)(at), rtol=1e-9, atol=1e-9)


def test_a_single_point_is_a_constant():
    np.testing.assert_array_equal(smooth([1.0], [[2.0, 3.0]])(np.zeros(4)), np.tile([2.0, 3.0], (4, 1)))
