"""The water in a regular wave: what every flow without vortices obeys, and what stretching is to keep."""

import numpy as np
import pytest

from hakobune.mooring.environment.current_profile import power_law
from hakobune.mooring.loads.regular_wave import RegularWave

OMEGA, DEPTH, TOWARDS = 0.8, 15.0, np.radians(30)
PLACES = np.random.default_rng(1).uniform([-40, -40, -14], [40, 40, -1], (20, 3))


def slopes(wave, phase, step=1e-3):
    """∂u_i/∂x_j (n, 3, 3)"""
    return np.stack(
        [
            (wave.flow(PLACES + step * e, phase)[0] - wave.flow(PLACES - step * e, phase)[0]) / (2 * step)
            for e in np.eye(3)
        ],
        axis=-1,
    )


@pytest.mark.parametrize("depth", [DEPTH, np.inf])
def test_water_keeps_its_volume_and_has_no_vortices(depth):
    """∇·u = 0 and ∂u_i/∂x_j = ∂u_j/∂x_i; a wave so low that nothing is stretched, 1e-6 of its size"""
    wave = RegularWave(1e-6, OMEGA, TOWARDS, depth)
    J = slopes(wave, 0.7)
    assert np.abs(np.trace(J, axis1=1, axis2=2)).max() < 1e-5 * np.abs(J).max()
    assert np.abs(J - J.swapaxes(1, 2)).max() < 1e-5 * np.abs(J).max()


def test_accelerations_are_the_change_of_velocities_and_the_surface_moves_with_the_water():
    wave, step = RegularWave(1e-6, OMEGA, TOWARDS, DEPTH), 1e-4
    changed = (wave.flow(PLACES, 0.7 + step)[0] - wave.flow(PLACES, 0.7 - step)[0]) / (2 * step / OMEGA)
    assert np.allclose(wave.flow(PLACES, 0.7)[1], changed, rtol=1e-6, atol=1e-6 * np.abs(changed).max())
    top = PLACES * [1, 1, 0]
    rise = (wave.elevation(top, 0.7 + step) - wave.elevation(top, 0.7 - step)) / (2 * step / OMEGA)
    assert np.allclose(wave.flow(top, 0.7)[0][:, 2], rise, rtol=1e-5, atol=1e-5 * np.abs(rise).max())
    bed = PLACES * [1, 1, 0] - [0, 0, DEPTH]
    assert np.abs(wave.flow(bed, 0.7)[0][:, 2]).max() < 1e-15


def test_at_the_crest_water_moves_as_at_still_water_and_the_current_reaches_it():
    """U + aω/tanh kh at the crest, the bed stays where it is"""
    wave = RegularWave(1.5, OMEGA, 0.0, DEPTH, power_law(1.0, 0.0, DEPTH, 1 / 7))
    crest = np.array([[0.0, 0.0, 1.5]])
    assert wave.unstretched(crest, 0.0) == pytest.approx(0.0, abs=1e-12)
    assert wave.flow(crest, 0.0)[0][0, 0] == pytest.approx(1 + 1.5 * OMEGA / np.tanh(wave.k * DEPTH), rel=1e-9)
    assert wave.unstretched([[0.0, 0.0, -DEPTH]], 0.0) == pytest.approx(-DEPTH)
