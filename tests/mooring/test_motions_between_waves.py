"""Motions between stored frequencies: the equation of motion, not a mean of its solutions."""

import numpy as np
import pytest

from bem.motions import response
from mooring.environment.between_waves import RangeError, at_wave, motion_amplitudes

INERTIA = np.diag([5e7, 5e7, 5e7, 1.2e10, 4.4e10, 5.3e10])
STIFFNESS = np.diag([0, 0, 5e7, 8e9, 4e10, 0])


class Body:
    """A database whose coefficients are linear in frequency, so that only their solutions are not."""

    omega = np.array([0.5, 0.55, 0.65, 0.8])
    wave_direction = np.radians([0.0, 30.0])
    inertia_matrix, hydrostatic_stiffness = INERTIA, STIFFNESS
    has_viscous_motions = False

    def require(self, *names):
        pass

    def coefficients(self, w):
        added, damping = (0.5 + 0.2 * w) * INERTIA, (0.01 + 0.02 * w) * INERTIA
        force = np.array([1e6, 2e6, 5e6, 2e7, 3e7, 1e7]) * (1 + w) * np.exp(1j * np.arange(6))
        return {"added_mass": added, "radiation_damping": damping, "excitation_force": np.array([force, 2 * force])}

    def __getitem__(self, name):
        if name != "rao":
            return np.array([self.coefficients(w)[name] for w in self.omega])
        return np.array([self.exact(w) for w in self.omega])

    def exact(self, w):
        A, B, F = self.coefficients(w).values()
        return response(w, A, B, F, INERTIA, STIFFNESS)


@pytest.mark.parametrize("omega", [0.5, 0.52, 0.6, 0.7, 0.8])
def test_coefficients_linear_in_frequency_give_exact_motions(omega):
    found = motion_amplitudes(Body(), 3.0, 2 * np.pi / omega, np.radians(30))
    assert np.allclose(found, 1.5 * np.abs(Body().exact(omega)[1]), rtol=1e-12)


def test_resonance_between_two_stored_frequencies_keeps_its_height():
    """At ω² = C/(M + A) the amplitude is |F|/ωB; a mean of both sides of the resonance would cancel."""
    body = Body()
    w = 0.65
    for _ in range(60):
        w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * (1.5 + 0.2 * w)))
    assert 0.55 < w < 0.65
    _, B, F = body.coefficients(w).values()
    peak = abs(F[0, 3]) / (w * B[3, 3])
    assert np.isclose(motion_amplitudes(body, 2.0, 2 * np.pi / w, 0.0)[3], peak, rtol=1e-9)
    assert abs(at_wave(body, "rao", 2 * np.pi / w, 0.0)[3]) < 0.9 * peak


def test_frequency_that_failed_is_named():
    class Failed(Body):
        def __getitem__(self, name):
            values = super().__getitem__(name)
            values[1] = np.nan
            return values

    assert np.all(np.isfinite(motion_amplitudes(Failed(), 2.0, 2 * np.pi / 0.7, 0.0)))
    with pytest.raises(RangeError, match="added_mass is not known at period"):
        motion_amplitudes(Failed(), 2.0, 2 * np.pi / 0.6, 0.0)


def test_motions_with_viscous_damping_are_not_made_between_stored_periods():
    """What is stored has a damping that depends on the wave; without it resonances would be far too high."""

    class Viscous(Body):
        has_viscous_motions = True

    with pytest.raises(RangeError, match="add the period to the scene"):
        motion_amplitudes(Viscous(), 2.0, 2 * np.pi / 0.6, 0.0)
