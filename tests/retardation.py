"""Retardation functions and convolution with them, the reference of `bem.time_domain.memory`.

    K(t) = (2/π) ∫₀^∞ B(ω) cos ωt dω,    B(ω) = ∫₀^∞ K cos ωt dt,    A(ω) = A(∞) − (1/ω) ∫₀^∞ K sin ωt dt

(Cummins 1962, Ogilvie 1964; A + iB/ω at exp(−iωt)).  Damping outside the band, and A(∞) if it is not given, are those
of `bem.time_domain.whole_axis`.

    y(t) = ∫₀^T K(τ) ν(t − τ) dτ ≈ Σ_j W_j ν(t − j h),    W_j = h K(j h), half of it at j = 0 and at the end T

over velocities that are zero before t = 0, by the trapezium rule, of second order in h.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hakobune.bem.database.reader import Reader, reader
from hakobune.bem.time_domain.whole_axis import Causal, ends_of, whole_axis


@dataclass(frozen=True, eq=False)
class Retardation(Causal):
    """K (m, 6, 6) kg/s² … at times (m,) s from 0 in equal steps, added_mass_infinity (6, 6)."""

    times: np.ndarray
    K: np.ndarray
    added_mass_infinity: np.ndarray

    def transform(self, omega):
        """∫ K exp(iωt) dt = B + iω [A(∞) − A] (q, 6, 6) at omega (q,) rad/s"""
        return np.tensordot(fourier_weights(omega, self.times), self.K, axes=1)


def fourier_weights(frequencies, points):
    """w (q, n) with Σ w f = ∫ f exp(i frequency x) dx exactly for f straight between rising points (n,)."""
    h = np.diff(points)
    turn = np.multiply.outer(np.atleast_1d(np.asarray(frequencies, float)), h)
    small = np.abs(turn) < 1e-3
    safe = np.where(small, 1.0, turn)
    e = np.exp(1j * safe)
    # of the falling and the rising side of a hat: series where the quotients cancel
    rising = np.where(small, 0.5 + 1j * turn / 3 - turn**2 / 8, (e * (1 - 1j * safe) - 1) / safe**2)
    whole = np.where(small, 1 + 1j * turn / 2 - turn**2 / 6, (e - 1) / (1j * safe))
    start = np.exp(1j * np.multiply.outer(np.atleast_1d(frequencies), points[:-1])) * h
    out = np.zeros((len(turn), len(points)), complex)
    out[:, :-1] += start * (whole - rising)
    out[:, 1:] += start * rising
    return out


def retardation(omega, added_mass, radiation_damping, times, added_mass_infinity=None, monopole=None):
    """`Retardation` of coefficients (n, 6, 6) at omega (n,) rad/s rising, dense enough for straight lines between.

    times : (m,) s, from 0 in equal steps, at most 0.25/Ω; added_mass_infinity, monopole : as in `whole_axis`
    """
    omega, times = np.asarray(omega, float), np.asarray(times, float)
    axis = whole_axis(omega, added_mass, radiation_damping, added_mass_infinity, monopole)
    K = (2 / np.pi) * np.tensordot(fourier_weights(times, axis.omega).real, axis.damping, axes=1)
    return Retardation(times, K, axis.added_mass_infinity)


def from_database(db, times, points=1200):
    """`Retardation` of a `bem.database.Database` or `Reader` by its fit between the frequencies, with A(∞) if stored"""
    body = db if isinstance(db, Reader) else reader(db)
    omega = np.linspace(*body.between.span, points)
    return retardation(omega, *body.coefficients(omega), times, *ends_of(body))


def history_weights(retardation):
    """W (m, 6, 6) of a `retardation.Retardation` with m times: forces a unit of velocity now, a step ago, …"""
    weights = retardation.K * (retardation.times[1] - retardation.times[0])
    weights[[0, -1]] *= 0.5
    return weights


def convolution(retardation, velocity):
    """y (n, 6) N, N m against the motion of velocity (n, 6) m/s, rad/s at the steps of the retardation function"""
    weights = history_weights(retardation)
    length = len(weights) + len(velocity) - 1
    spectrum = np.einsum("qij,qj->qi", np.fft.rfft(weights, length, axis=0), np.fft.rfft(velocity, length, axis=0))
    return np.fft.irfft(spectrum, length, axis=0)[: len(velocity)]
