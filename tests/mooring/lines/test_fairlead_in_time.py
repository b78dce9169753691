"""Where a fairlead is in time, with its velocity and acceleration as differences; kernels as plain Python."""

from types import SimpleNamespace

import numpy as np
import pytest
from plain import plain

RNG = np.random.default_rng(4)
MOTION = SimpleNamespace(
    knots=np.array([0.0, 5.0, 9.0]), cubics=RNG.normal(size=(3, 4, 3)), omega=np.array([0.7, 1.9]), ramp=6.0,
    real=RNG.normal(size=(2, 3)), imag=RNG.normal(size=(2, 3)),
)  # fmt: skip


def at(t):
    found = np.zeros((3, 3))
    plain("mooring.lines.dynamics.lumped.surroundings").fairlead_at(MOTION, t, *found)
    return found


@pytest.mark.parametrize("t", [1.0, 4.0, 5.5, 8.0, 12.0])
def test_velocity_and_acceleration_are_derivatives_of_the_place_within_the_ramp_and_after(t):
    """Central differences over 1e-4 s, of second order"""
    before, now, after = at(t - 1e-4), at(t), at(t + 1e-4)
    for derivative in (1, 2):
        slope = (after - before)[derivative - 1] / 2e-4
        assert now[derivative] == pytest.approx(slope, rel=1e-6, abs=1e-6)


def test_after_the_ramp_it_is_the_sum_of_a_cubic_and_of_its_waves():
    """a cos ωt + b sin ωt of each frequency"""
    t, (real, imag) = 12.0, (MOTION.real, MOTION.imag)
    x = t - 9.0
    wanted = (x ** np.arange(4)) @ MOTION.cubics[2]
    for w, a, b in zip(MOTION.omega, real, imag, strict=True):
        wanted = wanted + a * np.cos(w * t) + b * np.sin(w * t)
    assert at(t)[0] == pytest.approx(wanted, rel=1e-12)
