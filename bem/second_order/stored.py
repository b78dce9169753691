"""Forces of wave pairs in a database: groups `qtf`, for differences, and `qtf_sum`, and interpolation of T from `qtf`.

Between stored pairs T is interpolated cubically over the mean (ω₁ + ω₂)/2 at each stored difference, and then over the
difference. As a function of the difference the real part is even, and the imaginary part is odd.
"""

from dataclasses import dataclass

import numpy as np

from .. import DOFS
from ..database.file import DatabaseError
from ..database.widening import read_group, write_group
from .kinds import DIFFERENCE, SUM
from .quadratic_forces import HORIZONTAL, PARTS, QuadraticForces

GROUPS = {DIFFERENCE: "qtf", SUM: "qtf_sum"}
ERRORS, ADDED, COARSER = "estimated_error", "added_by_far_field", "total_of_coarser"
AXES = ("omega", "wave_direction_1", "wave_direction_2", "influenced_dof")  # axes after the frequency of the force
APART = 0.05  # difference of drift by pressure and by far field, over the largest drift, that is accepted
USABLE = 0.25  # and that is still used, with a warning: the bound wave alone gives 0.9 to 1.6 times the complete force
MEANING = {
    DIFFERENCE: "T of Re sum_i sum_j a_i conj(a_j) T_ij exp(-i(omega_i - omega_j)t), of waves omega + difference "
    "towards wave_direction_1 and omega towards wave_direction_2; the other order has the conjugate; T_ii is the mean "
    "drift",
    SUM: "T of Re sum_i sum_j a_i a_j T_ij exp(-i(omega_i + omega_j)t), of waves sum - omega, not below omega, towards "
    "wave_direction_1 and omega towards wave_direction_2; the other order has the same",
}


@dataclass(frozen=True, eq=False)
class Held:
    """Restraint of the body in addition to the water.

    floats : whether the body moves; name : name of the study whose lines hold the floating body, or empty
    lines : stiffness of the lines about the rotation centre, (6, 6), or None without lines
    """

    floats: bool
    name: str = ""
    lines: np.ndarray | None = None

    @property
    def moving(self):
        """Argument `moving` of `quadratic_forces`: the stiffness of the lines or, without lines, whether the body
        floats"""
        return self.floats if self.lines is None else self.lines

    def same_as(self, other):
        lines = [np.zeros((6, 6)) if held.lines is None else held.lines for held in (self, other)]
        return (self.floats, self.name) == (other.floats, other.name) and np.array_equal(*lines)


@dataclass(frozen=True, eq=False)
class StoredForces:
    """Forces of wave pairs in a database, with the body on which they act and the errors of the forces.

    method : "panel" or "contour"; share : share of the surface forcing in the forces, an estimate if it is not
        computed, or None
    errors : estimated errors of the whole force, (d, n, m, m, 6), or None
    coarser : whole force at a coarser resolution, from which the errors are estimated, (d, n, m, m, 6), or None
    asked : largest difference or sum that an unfinished run will store, rad/s, or None for a finished run
    names : names of the forces, like `influenced_dof` in a database
    """

    forces: QuadraticForces
    held: Held
    method: str = "panel"
    share: float | None = None
    errors: np.ndarray | None = None
    coarser: np.ndarray | None = None
    asked: float | None = None
    names: tuple[str, ...] = DOFS

    @property
    def words(self):
        """Names of the forces in results: "surge", for several bodies "barge surge" """
        parts = [name.rpartition("__") for name in self.names]
        return [f"{body} {dof.lower()}".strip() for body, _, dof in parts]


def diagonal_gap(forces):
    """Largest difference between mean drift by pressure and by the far field in surge and sway, over the largest mean
    drift, of `QuadraticForces`; None if unknown"""
    if forces.added is None:
        return None
    h = np.arange(len(forces.headings))
    drift = forces.squares[0][:, h, h][..., :2]
    return float(np.abs(forces.added[:, h, h][..., :2]).max() / max(np.abs(drift).max(), 1e-300))


def failed_gap(forces):
    """Words on a `diagonal_gap` above APART, and the gap; None for one that is accepted or unknown"""
    gap = None if forces.kind is SUM else diagonal_gap(forces)
    if gap is None or gap <= APART:
        return None
    share = f"{100 * gap:.3g}" if gap < 1 else f"{100 * gap:.0f}"
    words = (
        f"mean drift by pressure differs from the far-field drift by {share} % of the largest, limit {100 * APART:g} %"
    )
    return words, gap


def write_forces(path, stored):
    """Store `StoredForces` in a database, replacing stored forces of the same kind"""
    forces, unit, names = stored.forces, "N/m2, N m/m2", np.array(stored.names, dtype=np.bytes_)
    name_of_axis = forces.kind.name
    datasets = {
        "omega": (("omega",), "rad/s", forces.omega),
        name_of_axis: ((name_of_axis,), "rad/s", forces.frequency),
        "wave_direction_1": (("wave_direction_1",), "rad", forces.headings),
        "wave_direction_2": (("wave_direction_2",), "rad", forces.headings),
        "influenced_dof": (("influenced_dof",), "", names),
    }
    values = {part: getattr(forces, part) for part in PARTS} | {ERRORS: stored.errors, COARSER: stored.coarser}
    datasets |= {name: ((name_of_axis, *AXES), unit, value) for name, value in values.items() if value is not None}
    if forces.added is not None:
        datasets["horizontal_dof"] = (("horizontal_dof",), "", names[HORIZONTAL])
        datasets[ADDED] = ((*AXES[:3], "horizontal_dof"), unit, forces.added)
    held = stored.held
    attributes = {
        "meaning": MEANING[forces.kind],
        "method": stored.method,
        "body": "floating" if held.floats else "fixed",
        "free_surface_integral": "left out" if forces.surface is None else "included",
        "moored": held.name or None,
        "line_stiffness": held.lines,
        "free_surface_share": stored.share,
        f"{name_of_axis}_asked": stored.asked,
    }
    known = {name: value for name, value in attributes.items() if value is not None}
    write_group(path, GROUPS[forces.kind], datasets, known)


def read_forces(db, kind=DIFFERENCE):
    """`StoredForces` of a kind in an open database.  Raises DatabaseError if it has none."""
    found = read_group(db, GROUPS[kind])
    if found is None:
        adds = f"hakobune qtf {db.path}{' --sum' if kind is SUM else ''}"
        raise DatabaseError(f"{db.path} contains no {kind.name} forces of wave pairs; '{adds}' computes them")
    datasets, attributes = found
    values = {name: part[2] for name, part in datasets.items()}
    axes = values["omega"], values[kind.name], values["wave_direction_1"]
    lines = attributes.get("line_stiffness")
    return StoredForces(
        QuadraticForces(*axes, *(values.get(part) for part in PARTS), added=values.get(ADDED), kind=kind),
        Held(
            attributes["body"] == "floating",
            str(attributes.get("moored", "")),
            None if lines is None else np.asarray(lines),
        ),
        str(attributes.get("method", "panel")),
        attributes.get("free_surface_share"),
        values.get(ERRORS),
        values.get(COARSER),
        attributes.get(f"{kind.name}_asked"),
        tuple(name.decode() for name in values["influenced_dof"]),
    )


@dataclass(frozen=True, eq=False)
class BetweenPairs:
    """T between stored pairs, for one direction of the first waves and one of the second.

    omega : evenly spaced frequencies, rad/s, (n,); difference : evenly spaced differences from 0, rad/s, (d,)
    values : T at the two headings, as in a part of `QuadraticForces`, (d, n, 6)
    """

    omega: np.ndarray
    difference: np.ndarray
    values: np.ndarray

    def __call__(self, one, two):
        """Complex T(ω₁, ω₂) of frequencies that broadcast, rad/s; shape (…, 6); beyond the stored pairs the end
        values"""
        one, two = np.broadcast_arrays(np.asarray(one, float), np.asarray(two, float))
        size, middle = np.abs(one - two).ravel(), 0.5 * (one + two).ravel()
        rows = np.stack([self._row(m, middle) for m in range(len(self.difference))])
        out = np.einsum("qd,dqk->qk", self._weights(size), rows)
        out = np.where((one < two).ravel()[:, None], out.conj(), out)
        return out.reshape(*one.shape, 6)

    def _row(self, m, middle):
        """T at mean frequencies (q,) and the stored difference m; shape (q, 6); beyond the last pairs the end values"""
        known = self.values[m, : len(self.omega) - m]
        at = self.omega[: len(known)] + 0.5 * self.difference[m]
        return _through(at, known, np.clip(middle, at[0], at[-1]))

    def _weights(self, size):
        """Weights of the stored differences in T at differences (q,); shape (q, d); beyond the last the end value"""
        d = self.difference
        return _through(d, np.eye(len(d)), np.minimum(size, d[-1]))


def _through(x, y, at):
    """Values at (q,) of a cubic spline through y (n, …), or of a polynomial through fewer than four; shape (q, …)"""
    from scipy.interpolate import BarycentricInterpolator, CubicSpline

    return (CubicSpline if len(x) > 3 else BarycentricInterpolator)(x, y)(at)
