"""Spectra and cross spectra of the slow forces on a moored body in surge, sway and yaw.

    S_F(Ω) = S_drift(Ω) + (2/U)² F̄ F̄ᵀ S_u(Ω) + S(Ω) ⟨|E|²⟩

The first term is slow drift by Newman's approximation with its cross spectra. The second term is due to gusts of a
wind with force F̄ and speed U, F̄ (1 + 2u/U), in phase over the hull. The third term is due to first-order waves of
low frequency with the exciting force E.

Each of several bodies has its own mean drift and meets the waves at its position r. Between bodies a and b the forces
of two waves differ in phase by (k₁ − k₂)·(r_a − r_b), so a wave group reaches them one after another.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import wavenumber

from ..lines.system.bodies import rotation
from ..on_current.body import carrier_of_body
from ..response.linear import frequencies, over_headings
from ..response.sea_state import drift_on_current
from ..response.seas import directions, heading_step
from ..response.slow_drift import cross_spectrum, held_beyond, signed, signed_pairs, slow_parts
from ..response.wave_drift_damping import mean_damping

PLANE = [0, 1, 5]
COARSE = 121  # difference frequencies at which the smooth drift spectrum is summed


class OfEach:
    """A `bem.database.reader.Reader` of several bodies, whose drift is the drift of each moving body along its own
    axes, one after another; shape (q, p, 3N)"""

    def __init__(self, body):
        self.body, self.moving = body, [i for i, one in enumerate(body.bodies) if not one.fixed]

    def __getattr__(self, name):
        return getattr(self.body, name)

    def drift(self, omega, headings=None, fixed=False):
        value = self.body.drift_of_each(omega, headings, fixed)[:, :, self.moving]
        return value.reshape(*value.shape[:2], -1)


class DriftOfSea(NamedTuple):
    """Mean drift at omega (q,) rad/s and the headings of a sea, (q, p, 3) N/m², for several bodies (q, p, 3N)

    weights : shares of the sea's energy per heading
    """

    spectrum: object
    omega: np.ndarray
    drift: np.ndarray
    weights: np.ndarray
    body: object = None
    heading: np.ndarray | None = None

    def slow_spectrum(self, difference):
        """Spectrum of slow drift at ascending differences (d,) rad/s, N² s/rad (N m for moments); shape (d, 3, 3).

        For several bodies it is complex, shape (d, 3N, 3N)
        """
        return between(self.coarse(difference[-1]), difference)

    def coarse(self, high):
        """The spectrum of `coarse` at COARSE differences up to `high`: these differences, and the spectrum"""
        places, turn = np.linspace(0.0, high, COARSE), self.phases(self.heading)
        if turn is None:
            of = self.body, self.spectrum, self.omega, self.heading, signed_pairs(self.drift), self.weights
            return places, cross_spectrum(*slow_parts(*of), places)
        roots = np.sqrt(signed(self.drift)) * turn[:, :, None]
        shares = np.broadcast_to(self.weights, roots.shape[:2])
        parts = np.einsum("qpsa,qptb,qp->qstab", roots, roots.conj(), shares, optimize=True)
        parts = parts.reshape(len(parts), 4, *parts.shape[-2:])
        return places, cross_spectrum(self.spectrum, *held_beyond(self.omega, parts, self.spectrum), places)

    def phases(self, heading, omega=None):
        """Phases of waves towards heading (p,) at the places of several bodies; shape (q, p, 3N); None for one body"""
        if not isinstance(self.body, OfEach):
            return None
        k = wavenumber(self.omega if omega is None else omega, self.body.depth, self.body.gravity)
        ahead = np.stack([np.cos(heading), np.sin(heading)], axis=-1) @ self.body.axes_at_rest[:, :2].T
        return np.repeat(np.exp(1j * np.multiply.outer(k, ahead)), 3, axis=-1)

    def main_phases(self, omega):
        """`phases` of waves towards the mean direction at omega (q,); shape (q, 1, 3N)"""
        share = np.mean(np.atleast_2d(self.weights), axis=0)
        return self.phases(np.angle([share @ np.exp(1j * np.atleast_1d(self.heading))]), omega)

    def damping(self):
        """Wave drift damping of one or several bodies, N s/m and N s, by velocities along the axes of each; shape (3N,
        2); None without headings on both sides of the waves"""
        _, coefficients, known = drift_on_current(self.body, self.omega, self.heading)
        if not known:
            return None
        found = mean_damping(self.omega, coefficients, self.spectrum.density(self.omega), self.weights)
        turns = [rotation(0.0, 0.0, turn)[:2, :2] for turn in self.body.axes_at_rest[:, 5]]
        return np.concatenate([part @ turn for part, turn in zip(found.reshape(-1, 3, 2), turns, strict=True)])

    def mean_parts(self):
        """Spectrum, omega (q,) up to the end of the waves, and `signed_means` (q, 2, 3) of the drift at omega"""
        return slow_parts(self.body, self.spectrum, self.omega, self.heading, signed(self.drift), self.weights)


def between(known, omega):
    """Spectra (d, n, n) at omega (d,) from `DriftOfSea.coarse`"""
    places, found = known
    columns = [np.interp(omega, places, column) for column in found.reshape(len(places), -1).T]
    return np.stack(columns, axis=-1).reshape(-1, *found.shape[1:])


def drift_of_sea(body, sea):
    """`DriftOfSea` of a `bem.database.reader.Reader`, `floating`.  raises : BetweenError outside what is stored"""
    body = OfEach(body) if getattr(body, "bodies", ()) else body
    around = None if carrier_of_body(body) is None else directions(sea, body.omega)[0]
    omega = frequencies(body, sea.spectrum.density, around)
    heading, weights = directions(sea, omega, heading_step(body, sea, omega))
    drift = body.drift(omega, heading) if around is None else drift_on_current(body, omega, heading)[0]
    return DriftOfSea(sea.spectrum, omega, drift, weights, body, heading)


def gust_spectrum(spectrum, force, omega):
    """Spectrum of the force of gusts at omega (d,) rad/s; shape (d, 3, 3)

    gusts : `environment.gusts.GustSpectrum` and mean wind force (3,), N, N, N m
    """
    slope = 2 * np.asarray(force, float) / spectrum.speed
    return np.multiply.outer(spectrum.density(omega), np.outer(slope, slope))


def wave_spectrum(body, sea, omega):
    """Spectrum of first-order wave forces within the stored band, at omega (d,) rad/s below its middle; shape (d, 3)"""
    inside = np.linspace(body.omega[0], max(omega[-1], body.omega[0] * 1.001), 61)
    heading, weights = directions(sea, inside)
    squares = over_headings(np.abs(body.forces(inside, heading)[:, :, PLANE]) ** 2, weights)
    found = np.asarray(sea.spectrum.density(inside))[:, None] * squares
    return np.stack([np.interp(omega, inside, column, left=0.0) for column in found.T], axis=1)
