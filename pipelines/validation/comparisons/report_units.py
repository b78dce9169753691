"""Results of a box in the angles and dimensionless forms of the SR179 report (1982).

    ξ_B = ω²B/2g,    ℓ = 1, 1, 1, B/2, L/2, L/2 for surge … yaw
    A_ij = a_ij / (ρ∇ ℓᵢℓⱼ),    B_ij = b_ij / (ρ∇ω ℓᵢℓⱼ)                       eq. 2.1.5.34
    F_i = F / (ρg ζ_a (LB/2) ℓᵢ)                                             eq. 2.1.5.35
    x_a/ζ_a for surge, sway, heave;  φ_a/(kζ_a), k = 2π/λ, for rotations      Table 2.4.2.1
    D = F_D / (½ρg L ζ_a²), moment M_D / (½ρg L² ζ_a²)                        eq. 3.6.10

χ is 0 in a head sea: the waves travel to β = χ + 180°.  X = |X| cos(ωt − ε), ε = 0 when the crest passes the
origin.  Axes and signs are those of `bem`, with which the signs of the report's sectional tables agree; A15 and
A51 have the sign of a right-handed pitch, bow down.
"""

from typing import NamedTuple

import numpy as np

PAIRS = ("11", "22", "33", "44", "55", "66", "15", "24", "42", "51")
QUIET = 1e-6  # fraction of the largest value of a mode over all headings; less is rounding


class Results(NamedTuple):
    """One case at n frequencies and m headings, dimensionless.

    case : `cases.Case`; db : its `bem.database.Database`; xi : (n,); k : (n,) rad/m; chi : (m,) degrees
    added_mass, damping : (n, 6, 6); forces, motions : (n, m, 6) complex; drift : (n, m, 3), or None
    """

    case: object
    db: object
    xi: np.ndarray
    k: np.ndarray
    chi: np.ndarray
    added_mass: np.ndarray
    damping: np.ndarray
    forces: np.ndarray
    motions: np.ndarray
    drift: np.ndarray | None

    def coefficient(self, name):
        """Coefficient A11, B24, … at each frequency; shape (n,)"""
        matrix = self.added_mass if name[0] == "A" else self.damping
        return matrix[:, int(name[1]) - 1, int(name[2]) - 1]

    def driven(self, kind):
        """Whether waves of a heading drive a mode at all; shape (m, 6); kind : forces or motions"""
        largest = np.abs(getattr(self, kind)).max(axis=0)
        return largest > QUIET * largest.max(axis=0)

    def heading(self, chi):
        """Index of an incidence among those of the case"""
        return int(np.argmin(np.abs(self.chi - chi)))


def travel(chi):
    """Degrees that waves of incidence χ travel to"""
    return (chi + 180.0) % 360.0


def in_report_units(case, db):
    """`Results` of the solved frequencies of a case.

    case : `cases.Case`; db : `bem.database.Database`, which may contain more than the case needs
    """
    rows, columns = _places(case, db)
    size, omega = db.dimensions, db.omega[rows]
    L, B = size["length"], size["beam"]
    arm = np.array([1, 1, 1, B / 2, L / 2, L / 2])
    mass = unit_of_added_mass(db)
    force = db.density * db.gravity * L * B / 2 * arm
    k = db["wavenumber"][rows]
    motion = np.where(np.arange(6) < 3, 1.0, k[:, None, None])
    drift = None
    if "drift_force" in db.names:
        drift = db["drift_force"][rows][:, columns] / (0.5 * db.density * db.gravity * L * np.array([1, 1, L]))
    return Results(
        case,
        db,
        xi=omega**2 * B / (2 * db.gravity),
        k=k,
        chi=np.array(case.chi, float),
        added_mass=db["added_mass"][rows] / mass,
        damping=db["radiation_damping"][rows] / (omega[:, None, None] * mass),
        forces=db["excitation_force"][rows][:, columns] / force,
        motions=db["rao"][rows][:, columns] / motion,
        drift=drift,
    )


def unit_of_added_mass(db):
    """Displaced mass ρ∇ of a box, kg, with half its beam or length for each rotation; shape (6, 6)"""
    L, B = db.dimensions["length"], db.dimensions["beam"]
    arm = np.array([1, 1, 1, B / 2, L / 2, L / 2])
    return db.density * db.displaced_volume * np.outer(arm, arm)


def lag(values):
    """ε of complex amplitudes, degrees from −180 to 180"""
    return np.degrees(np.angle(values))


def _places(case, db):
    """Rows of the case's frequencies, as far as they are solved, and columns of its headings"""
    rows = [np.flatnonzero(np.isclose(db.omega, omega, rtol=1e-8, atol=0)) for omega in case.scene.omegas()]
    apart = np.radians([travel(chi) for chi in case.chi])[:, None] - db.wave_direction
    return np.concatenate(rows).astype(int), np.argmin(1 - np.cos(apart), axis=1)
