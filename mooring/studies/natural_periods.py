"""Natural periods of the moored body with added mass taken at each mode's own frequency.

    (C + K_mooring) q = ω² (M + A(ω)) q

For the j-th smallest eigenvalue λⱼ(ω) the natural frequency is the root of ω² = λⱼ(ω).  λⱼ is continuous,
positive and bounded, so every j has a root and none can be lost in a change of order between two frequencies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lines.system.equilibrium import SystemEquilibrium
from ..lines.system.studies import about_body_axes, body_number, mooring_stiffness

NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")


@dataclass(frozen=True)
class NaturalPeriods:
    """Modes in the order Surge … Yaw of the motion that carries most of their kinetic energy.

    names : (6,); period : (6,) s, inf without restoring, nan where the body is unstable
    shapes : (6, 6), rows are modes, largest component 1 after rotations are multiplied by `scale` m
    inside : (6,) False where the added mass had to be held at the end of the stored frequencies
    """

    names: tuple[str, ...]
    period: np.ndarray
    shapes: np.ndarray
    inside: np.ndarray
    scale: float

    def __repr__(self):
        return (
            "<NaturalPeriods " + ", ".join(f"{n} {t:.4g} s" for n, t in zip(self.names, self.period, strict=True)) + ">"
        )


def natural_periods(omega, added_mass, inertia, stiffness, added_mass_zero=None, tolerance=1e-9) -> NaturalPeriods:
    """Natural periods of a body with frequency-dependent added mass.

    omega : (n,) rad/s rising; added_mass : (n, 6, 6); inertia, stiffness : (6, 6)
    added_mass_zero : (6, 6) limit ω → 0, used below the lowest frequency if it is finite
    Between stored frequencies the added mass is linear; outside it keeps its end value, and `inside` says so.
    """
    from scipy.linalg import eigh

    omega, added = np.asarray(omega, float), np.asarray(added_mass, float)
    inertia, stiffness = np.asarray(inertia, float), np.asarray(stiffness, float)
    if added.shape != (len(omega), 6, 6) or len(omega) == 0:
        raise ValueError(f"added_mass has shape {added.shape}; allowed: ({len(omega)}, 6, 6) with at least one row")
    if added_mass_zero is not None and np.all(np.isfinite(added_mass_zero)) and omega[0] > 0:
        omega, added = np.concatenate([[0.0], omega]), np.concatenate([[added_mass_zero], added])
    scale = float(np.sqrt(inertia[5, 5] / inertia[0, 0]))
    unit = np.array([1, 1, 1, scale, scale, scale])
    C = 0.5 * (stiffness + stiffness.T) / np.outer(unit, unit)

    def modes(w):
        M = (inertia + _at(w, omega, added)) / np.outer(unit, unit)
        return eigh(C, 0.5 * (M + M.T))

    frequencies, shapes, energies = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
    for j in range(6):
        w = _own_frequency(lambda w, j=j: modes(w)[0][j], tolerance)
        vector = modes(abs(w))[1][:, j]
        M = (inertia + _at(abs(w), omega, added)) / np.outer(unit, unit)
        frequencies[j], shapes[j] = w, vector / vector[np.argmax(np.abs(vector))]
        energies[j] = np.abs(vector * (M @ vector))
    order = _by_motion(energies)
    frequencies, shapes = frequencies[order], shapes[order]
    # eigenvalues of a mode without restoring are rounding errors of the stiffest one
    free = np.abs(frequencies) <= 1e-6 * np.abs(frequencies).max()
    with np.errstate(divide="ignore"):
        period = np.where(free, np.inf, np.where(frequencies < 0, np.nan, 2 * np.pi / np.abs(frequencies)))
    inside = (frequencies >= omega[0]) & (frequencies <= omega[-1])
    return NaturalPeriods(NAMES, period, shapes, inside, scale)


def _at(w, omega, matrices):
    """Matrix at frequency w, linear between the stored ones, held outside."""
    i = int(np.clip(np.searchsorted(omega, w), 1, max(len(omega) - 1, 1)))
    if len(omega) == 1:
        return matrices[0]
    share = np.clip((w - omega[i - 1]) / (omega[i] - omega[i - 1]), 0.0, 1.0)
    return (1 - share) * matrices[i - 1] + share * matrices[i]


def _own_frequency(eigenvalue, tolerance):
    """ω with ω² = λ(ω); −√−λ for an unstable mode."""
    start = eigenvalue(0.0)
    if start <= 0:
        return -float(np.sqrt(-start))
    low, high = 0.0, float(np.sqrt(start))
    while eigenvalue(high) > high * high:
        low, high = high, 2 * high
    while high - low > tolerance * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if eigenvalue(middle) > middle * middle else (low, middle)
    return 0.5 * (low + high)


def _by_motion(energies):
    """Which mode is called Surge, Sway, …: the assignment with the largest sum of energy shares."""
    from scipy.optimize import linear_sum_assignment

    shares = energies / energies.sum(axis=1, keepdims=True)
    modes, motions = linear_sum_assignment(-shares)
    return modes[np.argsort(motions)]


def moored_periods(state: SystemEquilibrium, body, db):
    """NaturalPeriods of one body of the system, its hydrodynamics from an opened database of the same body.

    The axes of the body are those of the database; the stiffness is taken to them and to its rotation centre.
    raises : ValueError where the database lacks added mass, inertia or hydrostatics
    """
    if db.inertia_matrix is None or db.hydrostatic_stiffness is None:
        raise ValueError(
            "natural periods need inertia_matrix and hydrostatic_stiffness, which the database does not have"
        )
    db.require("added_mass")
    i = body_number(state.system, body)
    pull = state.system.load(state.pose).force[6 * i : 6 * i + 3]
    K = about_body_axes(mooring_stiffness(state, body), pull, state.pose.turn[i], np.asarray(db.rotation_center, float))
    zero = db["added_mass_zero"] if "added_mass_zero" in db.names else None
    total = np.asarray(db.hydrostatic_stiffness, float) + K
    return natural_periods(db.omega, db["added_mass"], db.inertia_matrix, total, zero)
