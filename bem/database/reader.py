"""The bodies of a database in any wave: coefficients, forces, motions and drift with estimated errors, for every study.

    {−ω²[M + A] − iω[B + B′] + [C + C′]} X = F,    H = H_D + Σ_j X_j H_j,    drift from H by the far field (`drift`)

A, B, F and the Kochin functions H_j, H_D are interpolated (`between_frequencies`, `between_headings`); motions and
drift are computed from their equations, so that a resonance between stored frequencies is resolved. Where Kochin
functions of the radiation are stored, forces over the headings follow from Haskind's relation,

    F_j(β) = −4i ρg n/k² H_j(β + π),    n = C_g/C,

corrected by its interpolated error at the stored headings.  Drift is of second order and needs more frequencies than
forces, as its error shows.  In a stored wave the result is the stored number.  Without Kochin functions the drift
itself is interpolated, with an error that includes the step to the next stored frequency.

With several bodies the motions are n = 6 for each moving body, one body after another, then the shapes of flexible
bodies, all coupled; drift is that of the whole about the origin, and drift of each body (`drift_of_each`) is the
stored drift of freely floating bodies.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from hakobune.meshing.panels import PanelMesh

from ..drift import OF_EACH, harmonics
from ..hinges import forces_of, free_of, pulls_of, rows_of
from ..modes import moving, names_of, turning, words_of
from ..viscous import Viscous, linearised_response
from ..waves import group_factor, wavenumber
from . import far_field_drift
from .between_frequencies import DRIFT, FORCES, KOCHIN, RADIATION, Between, BetweenError
from .between_frequencies import between as of_database
from .between_headings import at_headings, is_turned, ring, whole_mirrors
from .deviations import carried, interpolated
from .natural_periods import GIVE_GYRATION

NEEDED = {"rao": (*RADIATION, "excitation_force"), "drift_force_fixed": KOCHIN}
NEEDED["drift_force"] = (*KOCHIN, *NEEDED["rao"])


@dataclass(frozen=True, eq=False)
class Reader:
    """One or several bodies of a database, floating freely unless `restrained`; n motions: six per body, and shapes.

    between : stored quantities over frequency; inertia, stiffness : (n, n) or None; damping : (n, n) without radiation
    rotation_center : m; symmetry : planes of hull and water, "", "x", "y" or "xy"
    is_round : whether the hull is one of revolution about the vertical through the origin
    own : whether the stored motions and drift are those of this body; False once a restraint is added
    viscous : damping in addition to radiation, `bem.viscous.Viscous`, valid at its wave amplitude; or None
    mesh : PanelMesh of the hull, or None; bodies : `bem.modes.Body` of each of several, empty for one
    modes : `bem.modes.Mode` of each shape
    links : `bem.hinges.Link` between the bodies, imposed exactly
    """

    between: Between
    density: float
    rotation_center: np.ndarray
    inertia: np.ndarray | None
    stiffness: np.ndarray | None
    damping: np.ndarray
    symmetry: str = ""
    is_round: bool = False
    own: bool = True
    viscous: Viscous | None = None
    mesh: PanelMesh | None = None
    bodies: tuple = ()
    modes: tuple = ()
    links: tuple = ()

    def __repr__(self):
        low, high = self.between.span
        return (
            f"<Reader {len(self.omega)} frequencies {low:.3g} to {high:.3g} rad/s, {len(self.headings)} headings, "
            f"water {self.depth:g} m>"
        )

    @property
    def words(self):
        """Names of the motions, "surge" …, for several bodies "barge surge"; shape (n,)"""
        return words_of(self.bodies, self.modes)

    @property
    def names(self):
        """Names of the motions in the database, "Surge" …, for several bodies "barge__Surge"; shape (n,)"""
        names = names_of(self.bodies, self.modes)
        return tuple(names[d] for d in moving(self.bodies, self.modes))

    @property
    def rigid(self):
        """Number of rigid motions, which are the first"""
        return len(self.words) - len(self.modes)

    @property
    def turning(self):
        """Whether a motion is a rotation; shape (n,)"""
        return turning(self.bodies, self.modes)[moving(self.bodies, self.modes)]

    @property
    def axes_at_rest(self):
        """Place of the rotation centre, m, and rotation of the axes, rad, of each moving body; shape (N, 6)"""
        centers = [(body.rotation_center, body.heading) for body in self.bodies if not body.fixed]
        return np.array([[*center, 0, 0, turn] for center, turn in centers or [(self.rotation_center, 0)]], float)

    @property
    def omega(self):
        """Stored frequencies, rising, rad/s; shape (n,)"""
        return self.between.omega

    @property
    def headings(self):
        """Stored headings, rad; shape (m,)"""
        return self.between.headings

    @property
    def depth(self):
        """m, inf for deep water"""
        return self.between.depth

    @property
    def gravity(self):
        """m/s²"""
        return self.between.gravity

    @property
    def radius(self):
        """Radius of the hull in plan about the origin, m"""
        return float(np.hypot(*self.between.outline.T).max())

    @property
    def knows_drift(self):
        """Whether the database stores mean drift, or the quantities from which drift follows"""
        return self.rebuilds_drift or "drift_force" in self.between.quantities

    @property
    def rebuilds_drift(self):
        """Whether Kochin functions are stored, so that drift between stored waves is computed from the motions"""
        return set(KOCHIN) <= set(self.between.quantities)

    @property
    def knows_drift_of_each(self):
        """Whether the mean drift of each of several bodies is stored"""
        return any(moves and name in self.between.quantities for name, moves in OF_EACH.items())

    def restrained(self, damping=None, stiffness=None):
        """The same body with linear matrices (n, n) added: viscous damping, mooring stiffness."""
        shape = self.damping.shape
        damping, stiffness = _matrix("damping", damping, shape), _matrix("stiffness", stiffness, shape)
        return replace(
            self,
            damping=self.damping + damping,
            stiffness=self.stiffness + stiffness,
            own=self.own and not damping.any() and not stiffness.any(),
        )

    def linked(self, links):
        """The same bodies with `bem.hinges.Link`s between them.  Raises ValueError for impossible links."""
        found = replace(self, links=(*self.links, *links), own=self.own and not links)
        if links:
            free_of(found._held)
        return found

    @cached_property
    def free(self):
        """Motions, in columns, that the links permit; shape (n, m); None without links"""
        return free_of(self._held) if self.links else None

    @cached_property
    def _held(self):
        """Combinations of motions that links constrain to zero; shape (r, n)"""
        return np.vstack([rows_of(self, link) for link in self.links])

    def link_forces(self, omega, headings, motions):
        """Force and moment per metre of wave amplitude that the first body of a link exerts on the second, along axes
        of the first; shape (q, p, links, 6)

        motions : (q, p, n) of these bodies in these waves, with the springs and dampers of links (`hinges.driven`)
        """
        D = self.dynamic_stiffness(self.inside(omega), *self.coefficients(omega))
        left = motions @ D.swapaxes(1, 2) - self.forces(omega, headings)
        return forces_of(self.links, self._held, left) + pulls_of(self, self.inside(omega), motions)

    def floating(self):
        """The same body with motions computed without viscous damping.

        Raises BetweenError, which names the missing quantity.
        """
        self._check_inertia()
        missing = [name for name in NEEDED["rao"] if name not in self.between.quantities]
        if missing:
            raise BetweenError(
                f"{', '.join(missing)} must be stored for motions; repeat the command that made the database, with "
                "--only motions,radiation"
            )
        for name in NEEDED["rao"]:
            _known(name, self.between.quantities[name])
        return replace(self, viscous=None, own=self.own and not self.viscous)

    def without_drift(self):
        """The same body with no mirror images of its motions and drift, as an unsymmetric restraint requires"""
        left_out = (*DRIFT, "kochin_diffraction")
        kept = {name: values for name, values in self.between.quantities.items() if name not in left_out}
        return replace(self, between=replace(self.between, quantities=kept))

    def critical_damping(self, mode):
        """Critical damping 2√(C (M + A)) of one mode alone, with A at its natural frequency, or at the nearest stored
        frequency.

        Raises ValueError for a mode without restoring.
        """
        C, M = self.stiffness[mode, mode], self.inertia[mode, mode]
        if not C > 0:
            raise ValueError(
                f"{self.words[mode]} has no restoring force, so its critical damping is not defined; give its damping "
                f"in N s/m, as linear_damping of a study"
            )

        def own(omega):
            return float(np.sqrt(C / (M + self.held_added_mass(omega)[0, mode, mode])))

        omega = own(self.omega[-1])
        for _ in range(50):  # A changes little over the frequencies; Aitken's process squares the remaining error
            first = own(omega)
            second = own(first)
            bend = second - 2 * first + omega
            before, omega = omega, second if bend == 0 else omega - (first - omega) ** 2 / bend
            if abs(omega - before) <= 1e-12 * abs(omega):
                break
        return 2 * C / omega

    def knows_added_mass(self, omega):
        """Whether added mass is known at omega (q,) rad/s, shape (q,). Inside the stored band it is known; outside it
        is known if the limit of added mass is stored"""
        return np.abs(np.atleast_1d(omega) - self._nearest(omega)) <= 0

    def held_added_mass(self, omega):
        """Added mass at omega (q,) rad/s, which may be 0; shape (q, n, n). Where it is unknown, the value at the
        nearest end of the stored band"""
        return self.between.value(self._nearest(omega), "added_mass")

    def coefficients(self, omega, motions=None):
        """Added mass and radiation damping (q, n, n) at omega (q,) rad/s; 0 for motions that are not requested."""
        omega, known = self.inside(omega), range(len(self.damping))
        out = [] if motions is None else [i for i in known if i not in motions]
        return tuple(_known(name, without_rows(self.between.value(omega, name), out)) for name in RADIATION)

    def inside(self, omega):
        """omega (q,) as an array.  Raises BetweenError outside the stored frequencies, and between too few of them."""
        return self.between.inside(omega)

    def forces(self, omega, headings=None, name="excitation_force"):
        """Wave forces per unit amplitude, N/m and N m/m, complex, at omega (q,) rad/s and headings (p,) rad; shape
        (q, p, n).
        headings : None for the stored headings"""
        stored = self.between.value(self.inside(omega), name)
        if headings is None:
            return stored
        on_ring, over = self.ring.of_forces(stored), self.to_headings(omega, headings)
        if name == "diffraction_force" and set(FORCES) <= set(self.between.quantities):
            return self.forces(omega, headings) - self.forces(omega, headings, "Froude_Krylov_force")
        if name != "excitation_force" or "kochin_radiation" not in self.between.quantities:
            return over.value(on_ring, "force")
        there = self.of_haskind(omega, np.concatenate([self.ring.headings, over.folded]))
        if np.any(np.isnan(there)):
            return over.value(on_ring, "force")
        round_ = len(self.ring.headings)
        return over.unfolded(there[:, round_:], "force") + over.value(on_ring - there[:, :round_], "force")

    def far_field(self, omega, headings=None):
        """Kochin functions of the radiation, (q, n, t), or None if they are not stored, and of the diffraction, (q,
        p, t)."""
        omega, stored = self.inside(omega), [name for name in KOCHIN if name in self.between.quantities]
        *radiated, diffracted = (_known(name, self.between.value(omega, name)) for name in stored)
        radiated = radiated[0] if radiated else None
        if headings is None:
            return radiated, diffracted
        return radiated, self.to_headings(omega, headings).value(self.ring.of_kochin(diffracted), "kochin")

    def motions(self, omega, headings=None):
        """Motions about rotation_center per unit wave amplitude, m/m and rad/m; shape (q, p, n), complex.

        omega : frequencies, rad/s, (q,); headings : directions that waves travel to, rad, (p,); None for the stored
            ones
        raises : BetweenError outside the stored frequencies and headings, and for a body without inertia
        """
        omega = self.inside(omega)
        found = self.where_stored(omega, headings, "rao")
        if found is not None and found.complete:
            return found.values
        self._check_inertia()
        A, B = self.coefficients(omega)
        value = self.solved(omega, A, B, _known("excitation_force", self.forces(omega, headings)))
        return value if found is None else found.over(value)

    def drift(self, omega, headings=None, fixed=False):
        """Mean drift per squared wave amplitude, N/m² and N m/m², of the floating or the fixed body; shape (q, p, 3).

        Raises BetweenError for unknown drift.
        """
        omega, name = self.inside(omega), DRIFT[0] if fixed else DRIFT[1]
        found = self.where_stored(omega, headings, name)
        if found is not None and found.complete:
            return found.values
        value = far_field_drift.drift(self, omega, headings, fixed)
        return value if found is None else found.over(value)

    def body_named(self, name):
        """`bem.modes.Body` of one of several bodies, by name.  Raises BetweenError for an unknown name."""
        found = [body for body in self.bodies if body.name == name]
        if not found:
            known = ", ".join(body.name for body in self.bodies) or "one body without a name"
            raise BetweenError(f"there is no body {name!r}; allowed: {known}")
        return found[0]

    def motions_of(self, motions, body):
        """Motions of one of several bodies from the motions of all bodies (…, n); shape (…, 6); zero for a fixed
        body"""
        if body.fixed:
            return np.zeros((*np.shape(motions)[:-1], 6), complex)
        return motions[..., self.columns_of(body)]

    def columns_of(self, body):
        """Slice of the motions of one of several bodies among all; None for a fixed body"""
        if body.fixed:
            return None
        first = 6 * [one.name for one in self.bodies if not one.fixed].index(body.name)
        return slice(first, first + 6)

    def drift_of_each(self, omega, headings=None, fixed=False):
        """Mean drift per squared wave amplitude on each of several bodies, fixed bodies included; shape (q, p, bodies,
        3). The moment is about the reference point of each body; components are along the axes of the body.
        It is interpolated from the stored drift of fixed bodies or of the stored motions, even if the motions are
        restrained here.

        Raises BetweenError if the drift of each body is not stored.
        """
        omega, (name,) = self.inside(omega), (key for key, moves in OF_EACH.items() if moves != fixed)
        if name not in self.between.quantities:
            raise BetweenError(
                f"{name} is not stored; repeat the command that made the database, with --only drift and --method panel"
            )
        values = self.between.value(omega, name)
        if headings is None:
            return values
        on_ring = self.ring.of_drift(values.swapaxes(1, 2)).swapaxes(1, 2)
        return self.to_headings(omega, headings, name).value(on_ring, "drift")

    def at(self, omega, name, headings=None):
        """A quantity and its estimated error, about one standard deviation, at omega (q,) rad/s and headings (p,) rad.

        headings : None for the stored headings
        returns : value (q, …) as stored, error (q, …) in its unit; for complex quantities the error of the modulus
        raises : BetweenError outside the stored range, which it names
        """
        omega = np.atleast_1d(np.asarray(omega, float))
        if name in NEEDED and (name != "drift_force_fixed" or self.rebuilds_drift):
            value = self.motions(omega, headings) if name == "rao" else self.drift(omega, headings, name == DRIFT[0])
            return value, carried(self, omega, headings, name, NEEDED[name])
        if headings is not None and name == "kochin_diffraction":
            return self.far_field(omega, headings)[1], interpolated(self, omega, headings, name)
        if headings is not None and name in FORCES:
            return self.forces(omega, headings, name), interpolated(self, omega, headings, name)
        if headings is not None and name == "drift_force_fixed":
            return self.drift(omega, headings, fixed=True), interpolated(self, omega, headings, name)
        if headings is not None and name == "pressure":
            raise BetweenError("pressure is available at stored headings only; add the heading to the scene")
        return self.between.value(omega, name), self.between.error(omega, name)

    def ring_of(self, name):
        """`Ring` of stored waves and mirror images; the ring of motions has the symmetry of the moving body"""
        return self._moving_ring if name in ("rao", DRIFT[1]) else self.ring

    def to_headings(self, omega, headings, name=""):
        """`AtHeadings` that transfers a quantity from its ring to headings (p,) rad at omega (q,) rad/s"""
        return at_headings(self.ring_of(name), headings, omega, self.between, name in (*DRIFT, *OF_EACH))

    def of_haskind(self, omega, headings):
        """Excitation from the Kochin functions of the radiation; shape (q, p, n)"""
        order, series = harmonics(self.between.value(omega, "kochin_radiation"), self.between.theta)
        there = series @ np.exp(1j * np.multiply.outer(order, headings + np.pi))
        k = wavenumber(omega, self.depth, self.gravity)
        factor = -4j * self.density * self.gravity * group_factor(k, self.depth) / k**2
        return factor[:, None, None] * there.swapaxes(1, 2)

    def solved(self, omega, A, B, F):
        """Motions that follow from added mass and radiation damping (q, n, n) and forces (q, p, n); shape (q, p, n)"""
        if self.viscous:
            rows = zip(omega, A, B + self.damping, F, strict=True)
            return np.array([linearised_response(*row, self.inertia, self.stiffness, self.viscous)[0] for row in rows])
        D = self.dynamic_stiffness(omega, A, B)
        if self.links:
            Z = self.free
            return np.linalg.solve(Z.T @ D @ Z, (F @ Z).swapaxes(1, 2)).swapaxes(1, 2) @ Z.T
        return np.linalg.solve(D, F.swapaxes(1, 2)).swapaxes(1, 2)

    def dynamic_stiffness(self, omega, A, B):
        """Force per motion of the linear body, N/m … N m/rad, complex; shape (q, n, n)
        A, B : added mass and radiation damping at omega, (q, n, n)"""
        w = omega[:, None, None]
        return -(w**2) * (self.inertia + A) - 1j * w * (B + self.damping) + self.stiffness

    def where_stored(self, omega, headings, name):
        """`Stored` numbers of motions or drift in these waves; None if nothing is stored"""
        place = self.between.stored(omega)
        if name not in self.between.quantities or not (self.own or name == DRIFT[0]) or not np.any(place >= 0):
            return None
        values = self.between.quantities[name][place]
        if headings is None:
            return Stored(values, np.repeat(place[:, None] >= 0, values.shape[1], axis=1))
        ring = self.ring_of(name)
        column = ring.stored(ring.inside(headings))
        values = ring.of_forces(values) if name == "rao" else ring.of_drift(values)
        return Stored(values[:, column], np.logical_and.outer(place >= 0, column >= 0))

    @cached_property
    def missed_drift(self):
        """Deviation of the far field from stored drift of the fixed body at stored waves; shape (n, m, 3)"""
        return far_field_drift.missed(self)

    @cached_property
    def ring(self):
        """`Ring` of the stored waves and their images, for forces"""
        return self._ring_with(())

    @cached_property
    def _moving_ring(self):
        return self._ring_with((self.inertia, self.stiffness, self.damping))

    def _ring_with(self, matrices):
        mirrors = whole_mirrors(self.symmetry, matrices, self.rotation_center)
        is_round = self.is_round and is_turned(matrices, self.rotation_center)
        from_others = self.is_round and self.rebuilds_drift  # motions and drift follow from forces and far field
        given = self.headings, self.between.theta, mirrors, is_round, from_others, self.between.wall
        return ring(*given, len(self.damping))

    def _nearest(self, omega):
        omega, (low, high) = np.atleast_1d(np.asarray(omega, float)), self.between.span
        low = 0.0 if self.between.has_limit("added_mass_zero") else low
        high = np.inf if self.between.has_limit("added_mass_infinity") else high
        return np.clip(omega, low, high)

    def _check_inertia(self):
        if self.inertia is None or self.stiffness is None:
            raise BetweenError(f"the database has no inertia of the body; {GIVE_GYRATION}")


class Stored(NamedTuple):
    """Stored values (q, p, …) where mask (q, p) is true"""

    values: np.ndarray
    mask: np.ndarray

    @property
    def complete(self):
        return bool(self.mask.all()) and bool(np.all(np.isfinite(self.values)))

    def over(self, value):
        return np.where(self.mask[..., None], self.values, value)


def reader(db):
    """`Reader` of the solved rows of a database."""
    between, moved = of_database(db), moving(db.bodies, db.modes)
    _check_rows(db, between.quantities)
    return Reader(
        between,
        db.density,
        np.asarray(db.rotation_center, float),
        _of_moving(db.inertia_matrix, moved),
        _of_moving(db.stiffness, moved),
        np.zeros((len(moved), len(moved))) if db.structural_damping is None else db.structural_damping[moved],
        "" if db.bodies or db.modes else db.symmetry,
        db.is_round and not (db.bodies or db.modes),
        viscous=_viscous(db),
        mesh=db.mesh,
        bodies=db.bodies,
        modes=db.modes,
    )


def _check_rows(db, quantities):
    """Raise BetweenError for numbers that are missing at only some of the stored frequencies: interpolation between
    them would be unknown everywhere"""
    for name in (*RADIATION, "excitation_force"):
        if name in quantities:
            wrong = ~np.isfinite(quantities[name]).reshape(len(db.omega), -1)
            rows = (wrong & ~wrong.all(axis=0)).any(axis=1)
            if rows.any():
                raise BetweenError(
                    f"{db.path}: {name} is not a number at {rows.sum()} of {len(rows)} frequencies, the first "
                    f"at ω = {db.omega[rows][0]:.4g} rad/s; solve it again with --fresh"
                )


def _viscous(db):
    """`Viscous` of stored motions: the laws of the scene at its wave height"""
    if not db.has_viscous_motions:
        return None
    from ..viscous_table import viscous_of_text

    box = db.dimensions if "beam" in db.dimensions else {}
    found = viscous_of_text(db.header.scene, box, db.density, db.gravity)
    names = names_of(db.bodies, db.modes)
    return replace(found, names=tuple(names[d] for d in moving(db.bodies, db.modes)))


def _of_moving(matrix, moved):
    """The part of the moving bodies, shape (n, n), of a matrix (6N, n) of forces on all bodies"""
    return None if matrix is None else np.asarray(matrix, float)[moved]


def _known(name, values):
    if not np.all(np.isfinite(values)):
        raise BetweenError(f"{name} is not stored for all motions; solve again for all motions")
    return values


def without_rows(matrices, motions):
    """Matrices (…, n, n) with zeros in the rows and columns of `motions`"""
    out = np.array(matrices)
    out[..., motions, :] = out[..., :, motions] = 0.0
    return out


def _matrix(name, value, shape):
    if value is None:
        return np.zeros(shape)
    value = np.asarray(value, float)
    if value.shape != shape or not np.all(np.isfinite(value)):
        raise ValueError(f"{name} matrix has shape {value.shape}; allowed: {shape}, finite")
    return value
