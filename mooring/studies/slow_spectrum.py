"""Spectra and cross spectra of the slow forces on a moored body in surge, sway and yaw.

    S_F(Ω) = S_drift(Ω) + (2/U)² F̄ F̄ᵀ S_u(Ω) + S(Ω) ⟨|E|²⟩

Slow drift by Newman's approximation with its cross spectra; gusts of a wind of force F̄ and speed U, F̄ (1 + 2u/U), in
phase over the hull; first-order waves of low frequency, E their exciting force.
"""

from typing import NamedTuple

import numpy as np

from ..on_current.body import carrier_of_body
from ..response.linear import frequencies, over_headings
from ..response.sea_state import drift_on_current
from ..response.seas import directions, heading_step
from ..response.slow_drift import cross_spectrum, signed, signed_pairs, slow_parts

PLANE = [0, 1, 5]
COARSE = 121  # difference frequencies at which the smooth drift spectrum is summed


class DriftOfSea(NamedTuple):
    """Mean drift (q, p, 3) N/m² at omega (q,) rad/s and the headings of a sea; weights : their shares of its energy"""

    spectrum: object
    omega: np.ndarray
    drift: np.ndarray
    weights: np.ndarray
    body: object = None
    heading: np.ndarray | None = None

    def slow_spectrum(self, difference):
        """Spectrum of slow drift at rising differences (d,), rad/s, N² s/rad, of moments with N m; shape (d, 3, 3)"""
        coarse, parts = np.linspace(0.0, difference[-1], COARSE), signed_pairs(self.drift)
        of = self.body, self.spectrum, self.omega, self.heading, parts, self.weights
        found = cross_spectrum(*slow_parts(*of), coarse)
        columns = [np.interp(difference, coarse, column) for column in found.reshape(COARSE, -1).T]
        return np.stack(columns, axis=-1).reshape(-1, 3, 3)

    def mean_parts(self):
        """Spectrum, omega (q,) up to the end of the waves, and `signed_means` (q, 2, 3) of the drift at omega"""
        return slow_parts(self.body, self.spectrum, self.omega, self.heading, signed(self.drift), self.weights)


def drift_of_sea(body, sea):
    """`DriftOfSea` of a `bem.database.reader.Reader`, `floating`.  raises : BetweenError outside what is stored"""
    around = None if carrier_of_body(body) is None else directions(sea, body.omega)[0]
    omega = frequencies(body, sea.spectrum.density, around)
    heading, weights = directions(sea, omega, heading_step(body, sea, omega))
    drift = body.drift(omega, heading) if around is None else drift_on_current(body, omega, heading)[0]
    return DriftOfSea(sea.spectrum, omega, drift, weights, body, heading)


def gust_spectrum(spectrum, force, omega):
    """Spectrum of the force of gusts; shape (d, 3, 3); gusts: `environment.gusts.GustSpectrum` and mean wind force
    (3,), N, N, N m, at omega (d,), rad/s"""
    slope = 2 * np.asarray(force, float) / spectrum.speed
    return np.multiply.outer(spectrum.density(omega), np.outer(slope, slope))


def wave_spectrum(body, sea, omega):
    """Spectrum of first-order wave forces within the stored band, at omega (d,) rad/s below its middle; shape (d, 3)"""
    inside = np.linspace(body.omega[0], max(omega[-1], body.omega[0] * 1.001), 61)
    heading, weights = directions(sea, inside)
    squares = over_headings(np.abs(body.forces(inside, heading)[:, :, PLANE]) ** 2, weights)
    found = np.asarray(sea.spectrum.density(inside))[:, None] * squares
    return np.stack([np.interp(omega, inside, column, left=0.0) for column in found.T], axis=1)
