"""What a database knows of one floating body, read once: coefficients, forces, far field, drift.

Between stored frequencies added mass and damping follow a monotone cubic (damping cannot turn negative between two
positive values), forces and far field a cubic spline: their phase turns by k R from one frequency to the next, and
a straight line between two such numbers is too short by (Δk R)²/8, 14 % for a body of 100 m between 7 and 8 s.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from bem import DOFS

from ..environment.between_waves import RangeError
from .headings import mirrored, whole_mirrors

SAME = 1e-9  # relative in omega


@dataclass(frozen=True, eq=False)
class Body:
    """Stored results at omega (n,) rad/s rising and heading (m,) rad, with the linear matrices of the motion.

    added_mass, radiation_damping : (n, 6, 6); excitation : (n, m, 6) N/m, N m/m, complex, about rotation_center
    inertia, stiffness, damping : (6, 6); `damping` is what is added to the radiation, N s/m …
    drift, drift_fixed : (n, m, 3) N/m², N m/m² or None; far_field_radiation (n, 6, t), far_field_diffraction
    (n, m, t) : Kochin functions at theta (t,), or None
    symmetry : planes of symmetry of the mesh, "", "x", "y" or "xy"; radius : m, of the hull about the origin
    is_held : whether stiffness was added, so that stored motions and drift are not those of this body
    """

    omega: np.ndarray
    heading: np.ndarray
    added_mass: np.ndarray
    radiation_damping: np.ndarray
    excitation: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    depth: float
    density: float
    gravity: float
    rotation_center: np.ndarray
    symmetry: str = ""
    radius: float = 0.0
    is_held: bool = False
    drift: np.ndarray | None = None
    drift_fixed: np.ndarray | None = None
    theta: np.ndarray | None = None
    far_field_radiation: np.ndarray | None = None
    far_field_diffraction: np.ndarray | None = None

    def __repr__(self):
        return (
            f"<Body {len(self.omega)} frequencies {self.omega[0]:.3g} to {self.omega[-1]:.3g} rad/s, "
            f"{len(self.heading)} headings, water {self.depth:g} m>"
        )

    def restrained(self, damping=None, stiffness=None):
        """The same body with linear matrices (6, 6) added: viscous damping, mooring stiffness."""
        return replace(
            self,
            damping=self.damping + _matrix("damping", damping),
            stiffness=self.stiffness + _matrix("stiffness", stiffness),
            is_held=self.is_held or stiffness is not None,
        )

    def critical_damping(self, mode):
        """2√(C (M + A)) of one mode alone (0 … 5), A at its own natural frequency, held outside the stored ones.

        Raises ValueError for a mode without restoring.
        """
        C, M = self.stiffness[mode, mode], self.inertia[mode, mode]
        if not C > 0:
            raise ValueError(f"{DOFS[mode].lower()} has no restoring and so no critical damping; give a matrix")
        added, omega = self.added_mass[:, mode, mode], self.omega[-1]
        for _ in range(50):  # A changes little over the frequencies, so that each pass gains a digit or more
            omega = np.sqrt(C / (M + np.interp(omega, self.omega, added)))
        return 2 * C / omega

    def thinned(self):
        """The body known at every second frequency and at both ends, to see what interpolation does."""
        keep = np.unique(np.append(np.arange(0, len(self.omega), 2), len(self.omega) - 1))
        names = ("omega", "added_mass", "radiation_damping", "excitation", "drift", "drift_fixed")
        names += ("far_field_radiation", "far_field_diffraction")
        some = {name: getattr(self, name)[keep] for name in names if getattr(self, name) is not None}
        return replace(self, **some)

    @property
    def moving_symmetry(self):
        """Planes in which hull, inertia, stiffness and damping are their own mirror image"""
        return whole_mirrors(self.symmetry, (self.inertia, self.stiffness, self.damping), self.rotation_center)

    @property
    def hull_symmetry(self):
        """Planes of symmetry of the hull through the rotation centre"""
        return whole_mirrors(self.symmetry, (), self.rotation_center)

    def forces(self, omega):
        """Headings (p,) rad of stored waves and their mirror images, and excitation (q, p, 6) at omega (q,)."""
        return mirrored(self.heading, self.at(omega, self.excitation), self.hull_symmetry, "force")

    def coefficients(self, omega):
        """Added mass and radiation damping (q, 6, 6) at omega (q,) rad/s."""
        return _monotone(self.omega, self.added_mass, omega), _monotone(self.omega, self.radiation_damping, omega)

    def at(self, omega, values):
        """A stored quantity (n, …) at omega (q,) rad/s by a cubic spline.  Raises RangeError outside the stored."""
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.omega, values)(self.inside(omega))

    def inside(self, omega):
        """omega (q,) as an array within the stored band.  Raises RangeError naming the first value outside."""
        omega, (low, high) = np.atleast_1d(np.asarray(omega, float)), (self.omega[0], self.omega[-1])
        outside = ~((omega >= low * (1 - SAME)) & (omega <= high * (1 + SAME)))
        if outside.any():
            raise RangeError(
                f"frequency {omega[outside][0]:.4g} rad/s is outside the database, {low:.4g} to {high:.4g} rad/s; "
                "add it to the scene and solve again"
            )
        return np.clip(omega, low, high)


def read_body(db) -> Body:
    """The Body of a database.  Raises ValueError naming what the database lacks."""
    if db.inertia_matrix is None or db.hydrostatic_stiffness is None:
        raise ValueError("the database has no inertia of the body; give --gyration kxx,kyy,kzz and solve again")
    names = ("added_mass", "radiation_damping", "excitation_force")
    db.require(*names)
    if len(db.omega) < 2:
        raise ValueError(f"the database has {len(db.omega)} frequency; allowed: at least 2 for irregular waves")
    coefficients = [_finite(name, db[name]) for name in names]
    optional = {}
    for key, name in (("drift", "drift_force"), ("drift_fixed", "drift_force_fixed")):
        if name in db.names:
            optional[key] = _finite(name, db[name])
    if {"kochin_radiation", "kochin_diffraction"} <= set(db.names) and "drift_fixed" in optional:
        optional["theta"] = np.asarray(db["theta"])
        optional["far_field_radiation"] = _finite("kochin_radiation", db["kochin_radiation"])
        optional["far_field_diffraction"] = _finite("kochin_diffraction", db["kochin_diffraction"])
    return Body(
        np.asarray(db.omega, float),
        np.asarray(db.wave_direction, float),
        *coefficients,
        np.asarray(db.inertia_matrix, float),
        np.asarray(db.hydrostatic_stiffness, float),
        np.zeros((6, 6)),
        db.water_depth,
        db.density,
        db.gravity,
        np.asarray(db.rotation_center, float),
        db.mesh.symmetry,
        float(np.hypot(*db.mesh.points[:, :2].T).max()),
        **optional,
    )


def _monotone(omega, values, wanted):
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(omega, values)(wanted)


def _finite(name, values):
    values = np.asarray(values)
    if not np.all(np.isfinite(values)):
        raise ValueError(f"{name} is not known for all motions; solve again without a choice of motions")
    return values


def _matrix(name, value):
    if value is None:
        return np.zeros((6, 6))
    value = np.asarray(value, float)
    if value.shape != (6, 6) or not np.all(np.isfinite(value)):
        raise ValueError(f"{name} matrix has shape {value.shape}; allowed: (6, 6), finite")
    return value
