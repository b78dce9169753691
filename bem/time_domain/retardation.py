"""Retardation functions: the memory of the water, from damping over a band and beyond.

    K(t) = (2/π) ∫₀^∞ B(ω) cos ωt dω,    B(ω) = ∫₀^∞ K cos ωt dt,    A(ω) = A(∞) − (1/ω) ∫₀^∞ K sin ωt dt

(Cummins 1962, Ogilvie 1964; A + iB/ω at exp(−iωt)).  Damping is straight between its frequencies; below the band it is
ω (a + bω²) with the value and the slope at its lower end; above it is c₃ (Ω/ω)³ + c₅ (Ω/ω)⁵: a vertical side
damps like ω⁻³ in short waves, a horizontal one less than any power.  The cₚ are what makes B continuous at the end
Ω of the band and Kramers and Kronig's relation

    A(ω) = A(∞) + (2/π) ⨍₀^∞ B(x) / (x² − ω²) dx

true for the added mass of the band, by least squares.  A(∞), if not given, is a further unknown of these.
"""

from __future__ import annotations

from dataclasses import dataclass
from warnings import warn

import numpy as np

POWERS = (3, 5)
CUT = 300.0  # times Ω: what is beyond is below 1/CUT² of what is above the band
WARN = 0.02  # relative error of the transform
FIT = 60  # frequencies at which A is compared


@dataclass(frozen=True, eq=False)
class Retardation:
    """K (m, 6, 6) kg/s² … at times (m,) s from 0 in equal steps, added_mass_infinity (6, 6).

    error : (6, 6) largest relative difference of the transform from A and B of the band, A and B by √(ii · jj)
    """

    times: np.ndarray
    K: np.ndarray
    added_mass_infinity: np.ndarray
    error: np.ndarray | None = None

    def damping(self, omega):
        """B (q, 6, 6) kg/s … of K at omega (q,) rad/s"""
        return self.transform(omega).real

    def added_mass(self, omega):
        """A (q, 6, 6) kg … of K and A(∞) at omega (q,) rad/s"""
        omega = np.atleast_1d(omega)
        return self.added_mass_infinity - self.transform(omega).imag / omega[:, None, None]

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


def retardation(omega, added_mass, radiation_damping, times, added_mass_infinity=None):
    """`Retardation` of coefficients (n, 6, 6) at omega (n,) rad/s rising, dense enough for straight lines between.

    times : (m,) s, from 0 in equal steps, at most 0.25/Ω; added_mass_infinity : (6, 6) of `added_mass_limit`
    raises : ValueError for times that cannot hold the band, and fewer than 20 frequencies
    """
    omega, times = np.asarray(omega, float), np.asarray(times, float)
    _check(omega, times)
    below, above = np.linspace(0, omega[0], 30)[:-1], _above(omega[-1])
    tails = (omega[-1] / above) ** np.array(POWERS)[:, None]
    joined = np.concatenate([below, omega, above[1:]])
    B = radiation_damping.reshape(len(omega), -1)
    known = np.concatenate([_below(below, omega, B), B, np.zeros((len(above) - 1, B.shape[1]))])
    shapes = np.concatenate([np.zeros((len(below) + len(omega), len(POWERS))), tails[:, 1:].T])
    A = added_mass.reshape(len(omega), -1)
    limit = None if added_mass_infinity is None else np.asarray(added_mass_infinity).ravel()
    weights, limit = _tail(omega, A, B[-1], joined, known, shapes, limit)
    spectrum = known + shapes @ weights
    K = (2 / np.pi) * fourier_weights(times, joined).real @ spectrum
    shape = radiation_damping.shape[1:]
    out = Retardation(times, K.reshape(-1, *shape), limit.reshape(shape))
    error = _error(out, omega, added_mass, radiation_damping)
    if error.max() > WARN:
        warn(
            f"retardation functions return added mass and damping to {error.max():.2g} only; good: below {WARN}; "
            "give longer times, or a band that begins and ends where damping is small",
            stacklevel=2,
        )
    return Retardation(times, out.K, out.added_mass_infinity, error)


def from_database(db, times, points=1200):
    """`Retardation` of a database: its fit between the frequencies (`bem.database.between_frequencies`), its A(∞)
    if it is stored.
    """
    omega = np.linspace(db.omega[0], db.omega[-1], points)
    A, B = (db.at(omega, name)[0] for name in ("added_mass", "radiation_damping"))
    limit = db["added_mass_infinity"] if "added_mass_infinity" in db.names else None
    return retardation(omega, A, B, times, limit)


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


def _above(end):
    """Frequencies from Ω on, ever farther apart, to where nothing is left"""
    return end * np.geomspace(1, CUT, 600)


def _below(omega, band, B):
    """ω (a + bω²) with the value and the slope of B at the lower end of the band"""
    w = band[0]
    slope = (B[1] - B[0]) / (band[1] - band[0])
    b = (slope * w - B[0]) / (2 * w**3)
    return np.outer(omega, B[0] / w - b * w * w) + np.outer(omega**3, b)


def _tail(omega, A, last, joined, known, shapes, limit):
    """cₚ (p, c) and A(∞) (c,)"""
    at = np.linspace(omega[0], omega[0] + 0.95 * (omega[-1] - omega[0]), FIT)
    at = omega[np.unique(np.searchsorted(omega, at))][:-1] + 0.5 * np.diff(omega).mean()  # off the corners of B
    relation = (2 / np.pi) * kramers_kronig(at, joined)
    measured = np.array([np.interp(at, omega, column) for column in A.T]).T
    right = measured - relation @ known
    left = relation @ shapes
    if limit is None:
        left = np.column_stack([left, np.ones(len(at))])
    else:
        right = right - limit
    # B is continuous at Ω: c₃ = B(Ω) − c₄ − c₅ − …; a known starts with the straight line from B(Ω) down to the tail
    first, others = left[:, 0], left[:, 1 : len(POWERS)] - left[:, [0]]
    free = np.column_stack([others, left[:, len(POWERS) :]])
    solved = np.linalg.lstsq(free, right - np.outer(first, last), rcond=1e-6)[0]
    c = solved[: len(POWERS) - 1]
    weights = np.vstack([last - c.sum(axis=0), c])
    return weights, limit if limit is not None else solved[-1]


def kramers_kronig(omega, points):
    """w (q, n) with Σ w B = ⨍ B(x) / (x² − ω²) dx for B straight between points (n,), none of them at omega (q,)."""
    a, b = points[:-1], points[1:]
    w = np.atleast_1d(omega)[:, None]

    def zeroth(x):  # ∫ dx / (x² − ω²)
        return np.log(np.abs((x - w) / (x + w))) / (2 * w)

    def first(x):  # ∫ x dx / (x² − ω²)
        return 0.5 * np.log(np.abs(x * x - w * w))

    plain, moment = zeroth(b) - zeroth(a), first(b) - first(a)
    out = np.zeros((len(w), len(points)))
    out[:, :-1] += (b * plain - moment) / (b - a)
    out[:, 1:] += (moment - a * plain) / (b - a)
    return out


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
