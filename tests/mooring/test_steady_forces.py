"""Drift between stored waves: interpolation, growth with height, limits."""

import numpy as np
import pytest

from mooring.environment.between_waves import RangeError, at_wave, mean_drift


class Waves:
    """Stand-in of a database with drift linear in frequency and heading."""

    omega = np.linspace(0.4, 1.2, 5)
    wave_direction = np.radians([0.0, 30.0, 60.0, 330.0])

    def require(self, *names):
        pass

    def __getitem__(self, name):
        heading = np.degrees((self.wave_direction + np.pi) % (2 * np.pi) - np.pi)
        return np.array([[[w, b, w + b] for b in heading] for w in self.omega])


def test_waves_between_stored_ones_are_linear_and_headings_go_round():
    for omega, direction in ((0.4, 0), (0.47, 12), (1.2, 60), (0.9, -20), (0.9, 340)):
        found = at_wave(Waves(), "drift_force", 2 * np.pi / omega, np.radians(direction))
        wrapped = (direction + 180) % 360 - 180
        assert np.allclose(found, [omega, wrapped, omega + wrapped])


def test_drift_grows_with_the_square_of_the_height():
    one = mean_drift(Waves(), 2.0, 10.0, 0.1)
    assert np.allclose(mean_drift(Waves(), 6.0, 10.0, 0.1), 9 * one)
    assert np.allclose(one, at_wave(Waves(), "drift_force", 10.0, 0.1))


def test_waves_outside_the_database_are_refused_with_its_range():
    with pytest.raises(RangeError, match=r"period 20 s .* 5.236 to 15.71 s"):
        mean_drift(Waves(), 2.0, 20.0, 0.0)
    with pytest.raises(RangeError, match="240° is not between stored headings"):
        mean_drift(Waves(), 2.0, 10.0, np.radians(240))
