"""Retardation functions: the memory of the water, from damping over a band and beyond.

    K(t) = (2/π) ∫₀^∞ B(ω) cos ωt dω,    B(ω) = ∫₀^∞ K cos ωt dt,    A(ω) = A(∞) − (1/ω) ∫₀^∞ K sin ωt dt

(Cummins 1962, Ogilvie 1964; A + iB/ω at exp(−iωt)).  Damping outside the band, and A(∞) if it is not given, are those
of `whole_axis`.
"""

from __future__ import annotations

from dataclasses import dataclass
from warnings import warn

import numpy as np

from ..database.reader import Reader, reader
from .whole_axis import Causal, ends_of, whole_axis

WARN = 0.02  # relative error of the transform


@dataclass(frozen=True, eq=False)
class Retardation(Causal):
    """K (m, 6, 6) kg/s² … at times (m,) s from 0 in equal steps, added_mass_infinity (6, 6).

    error : (6, 6) largest relative difference of the transform from A and B of the band, A and B by √(ii · jj)
    """

    times: np.ndarray
    K: np.ndarray
    added_mass_infinity: np.ndarray
    error: np.ndarray | None = None

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
    raises : ValueError for times that cannot hold the band, and fewer than 20 frequencies
    """
    omega, times = np.asarray(omega, float), np.asarray(times, float)
    _check(omega, times)
    axis = whole_axis(omega, added_mass, radiation_damping, added_mass_infinity, monopole)
    K = (2 / np.pi) * np.tensordot(fourier_weights(times, axis.omega).real, axis.damping, axes=1)
    out = Retardation(times, K, axis.added_mass_infinity)
    error = _error(out, omega, added_mass, radiation_damping)
    if error.max() > WARN:
        warn(
            f"retardation functions return added mass and damping to {error.max():.2g} only; good: below {WARN}; "
            "give longer times, or a band that begins and ends where damping is small",
            stacklevel=2,
        )
    return Retardation(times, out.K, out.added_mass_infinity, error)


def from_database(db, times, points=1200):
    """`Retardation` of a `bem.database.Database` or `Reader` by its fit between the frequencies, with A(∞) if stored"""
    body = db if isinstance(db, Reader) else reader(db)
    omega = np.linspace(*body.between.span, points)
    return retardation(omega, *body.coefficients(omega), times, *ends_of(body))


def _check(omega, times):
    if len(omega) < 20 or np.any(np.diff(omega) <= 0) or omega[0] <= 0:
        raise ValueError(f"{len(omega)} frequencies are given; allowed: at least 20, rising, above 0 (Database.at)")
    if len(times) < 2 or not np.all(np.isfinite(times)):
        raise ValueError(f"times are {times}; allowed: at least two, finite, from 0 s in equal steps")
    step = times[1] - times[0]
    if times[0] != 0 or not np.allclose(np.diff(times), step):
        steps = f"start at {times[0]:g} s with steps from {np.diff(times).min():g} to {np.diff(times).max():g} s"
        raise ValueError(f"times {steps}; allowed: from 0 s in equal steps")
    if not 0 < step <= 0.25 / omega[-1] * (1 + 1e-9):  # straight lines between times are (ω step)²/12 off
        raise ValueError(
            f"time step is {step:g} s; allowed: above 0, at most {0.25 / omega[-1]:.3g} s (0.25 / highest)"
        )


def _error(made, omega, added_mass, damping):
    at = slice(0, None, max(1, len(omega) // 200))
    worst = np.zeros(damping.shape[1:])
    for ours, given in (
        (made.added_mass(omega[at]), added_mass[at]),
        (made.damping(omega[at]), damping[at]),
    ):
        size = np.sqrt(np.abs(np.einsum("nii->ni", given)).max(axis=0))
        scale = np.outer(size, size)
        worst = np.maximum(worst, np.abs(ours - given).max(axis=0) / np.where(scale > 0, scale, np.inf))
    return worst
