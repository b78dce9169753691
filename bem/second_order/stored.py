"""Difference forces of pairs in a database: its group `qtf`, and T between the frequencies of it.

Between stored pairs T is interpolated over the mean (ω₁ + ω₂)/2, cubically at each stored difference, then over the
difference, in which its real part is even and its imaginary part odd.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import DOFS
from ..database.file import DatabaseError
from ..database.widening import read_group, write_group
from .difference_forces import HORIZONTAL, PARTS, DifferenceForces

GROUP = "qtf"
ERRORS, ADDED, ROUGH = "estimated_error", "added_by_far_field", "total_of_coarser"
AXES = ("difference", "omega", "wave_direction_1", "wave_direction_2", "influenced_dof")
MEANING = (
    "T of Re sum_i sum_j a_i conj(a_j) T_ij exp(-i(omega_i - omega_j)t), of waves omega + difference towards "
    "wave_direction_1 and omega towards wave_direction_2; the other order has the conjugate; T_ii is the mean drift"
)


def write_forces(
    path, forces, moving, share=None, moored="", errors=None, method="panel", *, rough=None, asked=None, lines=None
):
    """Put a `DifferenceForces` into a database.

    errors : (d, n, m, m, 6) estimated, of the whole, or None
    moving : whether of the floating body; share : of the surface's forcing in it, estimated where it is left out
    moored : what holds the floating body beside the water, by name; method : "panel" or "contour"
    rough : (d, n, m, m, 6) the whole at a coarser resolution, of which the errors are; asked : rad/s, the largest
        difference that will be stored, where that of `forces` is not yet; lines : (6, 6) stiffness of what holds it
    """
    unit, names = "N/m2, N m/m2", np.array(DOFS, dtype="S8")
    datasets = {
        "omega": (("omega",), "rad/s", forces.omega),
        "difference": (("difference",), "rad/s", forces.difference),
        "wave_direction_1": (("wave_direction_1",), "rad", forces.headings),
        "wave_direction_2": (("wave_direction_2",), "rad", forces.headings),
        "influenced_dof": (("influenced_dof",), "", names),
        **{part: (AXES, unit, value) for part in PARTS if (value := getattr(forces, part)) is not None},
    }
    if errors is not None:
        datasets[ERRORS] = (AXES, unit, errors)
    if rough is not None:
        datasets[ROUGH] = (AXES, unit, rough)
    if forces.added is not None:
        datasets["horizontal_dof"] = (("horizontal_dof",), "", names[HORIZONTAL])
        datasets[ADDED] = ((*AXES[1:4], "horizontal_dof"), unit, forces.added)
    attributes = {
        "meaning": MEANING,
        "method": method,
        "body": "floating" if moving else "fixed",
        "free_surface_integral": "left out" if forces.surface is None else "included",
    }
    if moored:
        attributes["moored"] = moored
    if share is not None:
        attributes["free_surface_share"] = share
    if asked is not None:
        attributes["difference_asked"] = asked
    if lines is not None:
        attributes["line_stiffness"] = lines
    write_group(path, GROUP, datasets, attributes)


def read_forces(db):
    """`DifferenceForces` of an opened database and whether the body floats.  Raises DatabaseError where it has none."""
    forces, attributes = _read(db)
    return forces, attributes["body"] == "floating"


def stored_share(db):
    """Share of the surface's forcing as stored beside the forces, a number, or None"""
    return _read(db)[1].get("free_surface_share")


def stored_errors(db):
    """(d, n, m, m, 6) estimated errors of the whole, N/m², N m/m², or None"""
    found = read_group(db, GROUP)[0].get(ERRORS)
    return None if found is None else found[2]


def stored_rough(db):
    """(d, n, m, m, 6) the whole at a coarser resolution, N/m², N m/m², or None"""
    found = read_group(db, GROUP)[0].get(ROUGH)
    return None if found is None else found[2]


def unfinished(db):
    """rad/s, the largest difference that was asked for where the run that stores it was ended before, or None"""
    return _read(db)[1].get("difference_asked")


def stored_lines(db):
    """(6, 6) stiffness of the lines that held the body, zero without them"""
    return np.asarray(_read(db)[1].get("line_stiffness", np.zeros((6, 6))))


def stored_method(db):
    """By what method the forces are, "panel" or "contour"; "panel" where an older file does not say"""
    return str(_read(db)[1].get("method", "panel"))


def stored_mooring(db):
    """What held the body whose forces are stored, by name; empty of a free or fixed one"""
    return str(_read(db)[1].get("moored", ""))


def _read(db):
    found = read_group(db, GROUP)
    if found is None:
        raise DatabaseError(f"{db.path} holds no difference forces of pairs; 'hakobune qtf {db.path}' adds them")
    datasets, attributes = found
    values = {name: part[2] for name, part in datasets.items()}
    forces = DifferenceForces(
        values["omega"],
        values["difference"],
        values["wave_direction_1"],
        *(values.get(part) for part in PARTS),
        added=values.get(ADDED),
    )
    return forces, attributes


@dataclass(frozen=True, eq=False)
class BetweenPairs:
    """T of waves of one direction each between stored pairs.

    omega : (n,) rad/s, even; difference : (d,) rad/s, even, from 0; values : (d, n, 6), as a part of
    `DifferenceForces` at two headings
    """

    omega: np.ndarray
    difference: np.ndarray
    values: np.ndarray

    def __call__(self, one, two):
        """(…, 6) complex T(ω₁, ω₂) of frequencies that broadcast, rad/s, those of pairs beyond the stored ones held"""
        one, two = np.broadcast_arrays(np.asarray(one, float), np.asarray(two, float))
        size, middle = np.abs(one - two).ravel(), 0.5 * (one + two).ravel()
        rows = np.stack([self._row(m, middle) for m in range(len(self.difference))])
        out = np.einsum("qd,dqk->qk", self._weights(size), rows)
        out = np.where((one < two).ravel()[:, None], out.conj(), out)
        return out.reshape(*one.shape, 6)

    def _row(self, m, middle):
        """(q, 6) at mean frequencies (q,) and the stored difference m, held beyond the last pairs"""
        known = self.values[m, : len(self.omega) - m]
        at = self.omega[: len(known)] + 0.5 * self.difference[m]
        return _through(at, known, np.clip(middle, at[0], at[-1]))

    def _weights(self, size):
        """(q, d) of the stored differences in T at differences (q,), held beyond the last"""
        d = self.difference
        return _through(d, np.eye(len(d)), np.minimum(size, d[-1]))


def _through(x, y, at):
    """(q, …) at (q,) of a cubic spline through y (n, …), of a polynomial through fewer than four"""
    from scipy.interpolate import BarycentricInterpolator, CubicSpline

    return (CubicSpline if len(x) > 3 else BarycentricInterpolator)(x, y)(at)
