"""Short-crested seas against sums over directions of one degree, with spreading functions written out here."""

import numpy as np
import pytest
from made_up_body import made_up_body

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import CosinePower, WrappedNormal
from hakobune.mooring.response.seas import directions, heading_step

DEGREES = np.radians(np.arange(360.0))
TEN = np.radians(10.0)
SPREADINGS = {
    "cos2": (CosinePower(2), lambda a: np.maximum(np.cos(a), 0.0) ** 2),
    "cos4": (CosinePower(4), lambda a: np.maximum(np.cos(a), 0.0) ** 4),
    "cos20": (CosinePower(20), lambda a: np.maximum(np.cos(a), 0.0) ** 20),
    "normal": (WrappedNormal(TEN), lambda a: np.exp(-0.5 * (a / TEN) ** 2)),
}


def over_spectrum(body, spectrum, omega, heading, share):
    """σ (6,), mean drift (3,) and (2, 3) integrals of the squares of ⟨D⁺⟩S and ⟨D⁻⟩S over omega"""
    X, D, S = body.motions(omega, heading), body.drift(omega, heading), spectrum.density(omega)[:, None]
    sigma = np.sqrt(np.trapezoid(np.einsum("qpj,p->qj", np.abs(X) ** 2, share) * S, omega, axis=0))
    mean = 2 * np.trapezoid(np.einsum("qpj,p->qj", D, share) * S, omega, axis=0)
    parts = [np.einsum("qpj,p->qj", np.maximum(sign * D, 0), share) for sign in (1, -1)]
    return sigma, mean, np.sqrt(8 * np.trapezoid(sum(part**2 for part in parts) * S**2, omega, axis=0))


@pytest.mark.parametrize("name", SPREADINGS)
def test_short_crested_results_are_sums_over_directions_of_a_degree(box_body, name):
    """Deviations, mean drift and slow force to 1e-3, in short waves towards 40°."""
    spreading, spread = SPREADINGS[name]
    spectrum, towards = issc(2.0, mean_period=8.0), np.radians(40.0)
    omega, sea = np.linspace(0.4, 1.05, 27), Sea(spectrum, towards, spreading)
    away = np.mod(DEGREES - towards + np.pi, 2 * np.pi) - np.pi
    direct = over_spectrum(box_body, spectrum, omega, DEGREES, spread(away) / spread(away).sum())
    heading, share = directions(sea, omega, heading_step(box_body, sea, omega))
    sigma, mean, slow = over_spectrum(box_body, spectrum, omega, heading, share)
    assert np.allclose(sigma, direct[0], rtol=1e-3)
    assert np.allclose(mean, direct[1], rtol=1e-3, atol=1e-3 * np.abs(direct[1][:2]).max())
    assert np.allclose(slow, direct[2], rtol=1e-3)


def test_directions_are_as_close_as_waves_and_spreading_ask_for():
    body = made_up_body()
    omega = np.linspace(0.3, 1.0, 29)
    steps = [
        heading_step(body, Sea(issc(1.0, mean_period=9.0), 0.3, WrappedNormal(np.radians(sigma))), omega)
        for sigma in (60.0, 10.0, 2.0)
    ]
    assert steps[0] >= steps[1] > steps[2]


def test_a_spreading_narrower_than_the_closest_directions_is_named():
    body, omega = made_up_body(), np.linspace(0.3, 1.0, 29)
    sea = Sea(issc(1.0, mean_period=9.0), np.radians(31.7), WrappedNormal(np.radians(0.1)))
    with pytest.warns(UserWarning, match="the spreading is too narrow for this step; use a long-crested sea"):
        heading_step(body, sea, omega)
