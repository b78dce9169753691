"""The cubic spline, beside the cubic it goes through, scipy's, and its order of convergence."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from hakobune.bem.algebra.cubic_spline import cubic_spline


def test_a_cubic_is_its_own_spline_with_its_slope_also_beyond_the_ends():
    x, at = np.array([0.0, 0.3, 0.8, 2.0, 2.1]), np.array([[-0.5, 0.3], [1.1, 2.6]])
    spline = cubic_spline(x, np.stack([x**3 - 2 * x, 1 + x**2], axis=1))
    assert spline(at) == pytest.approx(np.stack([at**3 - 2 * at, 1 + at**2], axis=-1), abs=1e-13)
    assert spline.slope(at) == pytest.approx(np.stack([3 * at**2 - 2, 2 * at], axis=-1), abs=1e-12)


@pytest.mark.parametrize("n", [2, 3, 4, 41])
def test_values_are_those_of_scipy_in_every_bit(n):
    random = np.random.default_rng(n)
    x, y = np.sort(random.uniform(0, 2, n)), random.normal(size=(2, n, 3, 4))
    at = np.concatenate([x, random.uniform(-0.2, 2.2, 200)])
    for through in (y[0], y[0] + 1j * y[1], y[0, :, 0, 0]):
        found, known = cubic_spline(x, through), CubicSpline(x, through)
        assert np.array_equal(found(at), known(at)) and np.array_equal(found.slope(at), known(at, 1))
        assert np.array_equal(found(x[1]), known(x[1])) and np.array_equal(found(x), known(x))


def test_the_error_falls_with_the_fourth_power_of_the_step_and_values_must_be_finite():
    at = np.linspace(0, 3, 500)
    errors = [
        np.abs(cubic_spline(x, np.exp(x))(at) - np.exp(at)).max() for x in (np.linspace(0, 3, n) for n in (20, 40))
    ]
    assert np.log(errors[0] / errors[1]) / np.log(39 / 19) > 3.7
    with pytest.raises(ValueError):
        cubic_spline(np.arange(5.0), np.array([0, 1, np.nan, 0, 0]))
