"""Damping and added mass of a body in sinusoidal forced motion: linear and quadratic.

    x = X sin ωt,    reaction of the water F = −A ẍ − B₁ ẋ − B₂ ẋ|ẋ| = F₀ + Σ Fₙ sin(nωt + εₙ)

by least squares of the whole record, or with − B₃ ẋ³ in place of the square; and from its first and third harmonics,

    B₁ = (−F₁ sin ε₁ + 5 F₃ sin ε₃)/(ωX),    B₂ = −15π F₃ sin ε₃/(8 ω²X²)

(Shiraishi et al., Port and Airport Research Institute, eq. 1, 2; ẋ|ẋ| = V² [(8/3π) cos ωt + (8/15π) cos 3ωt − …]).  One
coefficient with the same energy in a cycle is B₁ + (8/3π) ωX B₂; one coefficient with the same largest force is B₁ + ωX
B₂.

Noise without memory on the force perturbs B₁ and B₂ by the covariance of least squares, s² (MᵀM)⁻¹, with M the columns
of the fit and s its residual. No unbiased estimate has a smaller covariance (Cramér and Rao).
Noise on the motion shifts its phase by δφ, which adds a part A ω δφ of the inertia to B₁.
"""

from typing import NamedTuple

import numpy as np

from .record import RecordError, Sine, checked, sine_of


class Forced(NamedTuple):
    """added_mass : kg; linear, quadratic : B₁ N s/m, B₂ N s²/m²; by_harmonics : B₁ and B₂ by the formulas of the paper

    motion : `record.Sine`; off : deviation from the force over the force's standard deviation
    error : standard errors of B₁ and B₂ by noise without memory
    with_cubic : B₁, N s/m, B₃, N s³/m³, and the remaining deviation with both
    """

    added_mass: float
    linear: float
    quadratic: float
    by_harmonics: tuple
    motion: Sine
    off: float
    error: tuple
    with_cubic: tuple

    @property
    def same_energy(self):
        """N s/m"""
        return self.linear + 8 / (3 * np.pi) * self.motion.omega * self.motion.amplitude * self.quadratic

    @property
    def same_force(self):
        """N s/m"""
        return self.linear + self.motion.omega * self.motion.amplitude * self.quadratic

    def fitted(self, time):
        """Fitted force, N, about its mean, at times of the record, s"""
        basis = _basis(self.motion, np.asarray(time) - time[0])
        return basis[:, :3] @ (self.added_mass, self.linear, self.quadratic)


def forced(time, motion, force):
    """`Forced` of a record: s, m, and the reaction of the water on the body, N.  Raises RecordError."""
    t, x, F = checked(time, motion, force)
    if not np.ptp(x) > 0:
        raise RecordError("the body does not move in the record")
    sine = sine_of(t, x)
    theta, basis = sine.omega * t + sine.phase, _basis(sine, t)
    size = np.abs(basis).max(axis=0)
    share, left = _shares(basis, F)
    cubed, left_by_cubes = _shares(_basis(sine, t, 3), F)
    spread = np.sqrt(np.diag(np.linalg.inv((basis / size).T @ (basis / size)))) / size * left * np.std(F)
    phase = np.sqrt(2 / len(t)) * sine.off / sine.amplitude
    error = float(np.hypot(spread[1], share[0] * sine.omega * phase)), float(spread[2])
    return Forced(
        *map(float, share[:3]), _by_harmonics(theta, F, sine), sine, left, error, (*cubed[1:3], left_by_cubes)
    )


def _shares(basis, force):
    """Share of each column (n, 4) in a force (n,), shape (4,), and the relative deviation that remains"""
    size = np.abs(basis).max(axis=0)
    share = np.linalg.lstsq(basis / size, force, rcond=None)[0] / size
    return share, float(np.std(force - basis @ share) / np.std(force)) if np.std(force) > 0 else 0.0


def _basis(sine, t, power=2):
    """Columns of the reaction, −a, −v, −v|v| or −v³, and 1, at times from the first; shape (n, 4)"""
    theta, V = sine.omega * t + sine.phase, sine.omega * sine.amplitude
    v, a = V * np.cos(theta), -V * sine.omega * np.sin(theta)
    return np.stack([-a, -v, -v * np.abs(v) ** (power - 1), np.ones_like(t)], axis=1)


def _by_harmonics(theta, force, sine):
    columns = [np.ones_like(theta)]
    for n in range(1, 6):
        columns += [np.sin(n * theta), np.cos(n * theta)]
    share = np.linalg.lstsq(np.stack(columns, axis=1), force, rcond=None)[0]
    first, third = share[2], share[6]  # Fₙ sin εₙ, of cos nωt
    V = sine.omega * sine.amplitude
    return float((-first + 5 * third) / V), float(-15 * np.pi * third / (8 * V**2))
