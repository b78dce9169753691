"""What a database knows of its body in any wave: one value, asked by every study.

    {−ω²[M + A] − iω[B + B′] + [C + C′]} X = F,    H = H_D + Σ_j X_j H_j,    drift from H by the far field (`drift`)

A, B, F and the Kochin functions H_j, H_D are interpolated (`between_frequencies`, `between_headings`); motions and
drift are never: they follow by their equations, so that a resonance between stored frequencies keeps its height.
Forces over the headings are those of Haskind's relation where Kochin functions of the radiation are stored,

    F_j(β) = −4i ρg n/k² H_j(β + π),    n = C_g/C,

less what this errs at the stored headings, interpolated.  Drift needs more frequencies than forces, being of second
order in them; its error says so.  In a stored wave the answer is the stored number.  Where no Kochin functions are
stored the drift itself is interpolated, with an error that counts the step to the next stored frequency.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .. import DOFS
from ..drift import about, mean_drift
from ..viscous import Viscous, linearised_response
from ..waves import group_factor, wavenumber
from .between_frequencies import DRIFT, FORCES, KOCHIN, RADIATION, Between, BetweenError
from .between_frequencies import between as of_database
from .between_headings import Ring, ring, turned, whole_mirrors
from .deviations import by_chance, one_by_one

NEEDED = {"rao": (*RADIATION, "excitation_force"), "drift_force_fixed": KOCHIN}
NEEDED["drift_force"] = (*KOCHIN, *NEEDED["rao"])


@dataclass(frozen=True, eq=False)
class Reader:
    """A body of a database, freely floating unless `restrained`.

    between : stored quantities over frequency; inertia, stiffness : (6, 6) or None; damping : (6, 6) beside radiation
    rotation_center : m; symmetry : planes of the hull, "", "x", "y" or "xy"
    own : whether stored motions and drift are those of this body; viscous : what damps them beside radiation, a
    `bem.viscous.Viscous`, or True for damping that is not known here
    """

    between: Between
    density: float
    rotation_center: np.ndarray
    inertia: np.ndarray | None
    stiffness: np.ndarray | None
    damping: np.ndarray
    symmetry: str = ""
    own: bool = True
    viscous: Viscous | bool = False

    def __repr__(self):
        low, high = self.between.span
        return (
            f"<Reader {len(self.omega)} frequencies {low:.3g} to {high:.3g} rad/s, {len(self.headings)} headings, "
            f"water {self.depth:g} m>"
        )

    @property
    def omega(self):
        """(n,) rad/s stored, rising"""
        return self.between.omega

    @property
    def headings(self):
        """(m,) rad stored"""
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
        """m, of the hull about the origin"""
        return float(np.hypot(*self.between.outline.T).max())

    @property
    def knows_drift(self):
        """Whether mean drift is stored, or what it follows from"""
        return self.rebuilds_drift or "drift_force" in self.between.quantities

    @property
    def rebuilds_drift(self):
        """Whether Kochin functions are stored, so that drift between stored waves follows the motions"""
        return set(KOCHIN) <= set(self.between.quantities)

    def restrained(self, damping=None, stiffness=None):
        """The same body with linear matrices (6, 6) added: viscous damping, mooring stiffness."""
        damping, stiffness = _matrix("damping", damping), _matrix("stiffness", stiffness)
        return replace(
            self,
            damping=self.damping + damping,
            stiffness=self.stiffness + stiffness,
            own=self.own and not damping.any() and not stiffness.any(),
        )

    def floating(self):
        """The same body without the viscous damping of stored motions, with everything motions follow from.

        Raises BetweenError naming what is missing.
        """
        self._check_inertia()
        missing = [name for name in NEEDED["rao"] if name not in self.between.quantities]
        if missing:
            raise BetweenError(
                f"{', '.join(missing)} must be stored for motions; run its command again with --only motions,radiation"
            )
        for name in NEEDED["rao"]:
            _known(name, self.between.quantities[name])
        return replace(self, viscous=False, own=self.own and not self.viscous)

    def damped(self, laws):
        """The same body with a `bem.viscous.Viscous` in place of the viscous damping of stored motions"""
        return replace(self, viscous=laws, own=False)

    def critical_damping(self, mode):
        """2√(C (M + A)) of one mode alone (0 … 5), A at its own natural frequency, held outside the stored ones.

        Raises ValueError for a mode without restoring.
        """
        C, M = self.stiffness[mode, mode], self.inertia[mode, mode]
        if not C > 0:
            raise ValueError(f"{DOFS[mode].lower()} has no restoring and so no critical damping; give a matrix")

        def own(omega):
            return float(np.sqrt(C / (M + self.held_added_mass(omega)[0, mode, mode])))

        omega = own(self.omega[-1])
        for _ in range(50):  # A changes little over the frequencies; Aitken's process squares what is left
            first = own(omega)
            second = own(first)
            bend = second - 2 * first + omega
            before, omega = omega, second if bend == 0 else omega - (first - omega) ** 2 / bend
            if abs(omega - before) <= 1e-12 * abs(omega):
                break
        return 2 * C / omega

    def knows_added_mass(self, omega):
        """(q,) whether added mass is known at omega (q,) rad/s: in the band, or beyond where its limit is stored"""
        return np.abs(np.atleast_1d(omega) - self._nearest(omega)) <= 0

    def held_added_mass(self, omega):
        """(q, 6, 6) at omega (q,) rad/s from 0, with the end value where it is not known"""
        return self.between.value(self._nearest(omega), "added_mass")

    def coefficients(self, omega):
        """Added mass and radiation damping (q, 6, 6) at omega (q,) rad/s."""
        omega = self.inside(omega)
        return tuple(_known(name, self.between.value(omega, name)) for name in RADIATION)

    def inside(self, omega):
        """omega (q,) as an array.  Raises BetweenError outside the stored frequencies, and between too few of them."""
        return self.between.inside(omega)

    def forces(self, omega, headings=None, name="excitation_force"):
        """(q, p, 6) complex, N/m and N m/m, at omega (q,) rad/s and headings (p,) rad, None for those stored."""
        stored = self.between.value(self.inside(omega), name)
        if headings is None:
            return stored
        on_ring, over = self._ring.of_forces(stored), self._turned(omega, headings)
        if name == "diffraction_force" and set(FORCES) <= set(self.between.quantities):
            return self.forces(omega, headings) - self.forces(omega, headings, "Froude_Krylov_force")
        if name != "excitation_force" or "kochin_radiation" not in self.between.quantities:
            return over.value(on_ring, "force")
        there = self._haskind(omega, np.concatenate([self._ring.headings, over.wanted]))
        if np.any(np.isnan(there)):
            return over.value(on_ring, "force")
        round_ = len(self._ring.headings)
        return there[:, round_:] + over.value(on_ring - there[:, :round_], "force")

    def far_field(self, omega, headings=None):
        """Kochin functions (q, 6, t) of the radiation and (q, p, t) of the diffraction."""
        omega = self.inside(omega)
        radiated, diffracted = (_known(name, self.between.value(omega, name)) for name in KOCHIN)
        if headings is None:
            return radiated, diffracted
        return radiated, self._turned(omega, headings).value(self._ring.of_kochin(diffracted), "kochin")

    def motions(self, omega, headings=None):
        """(q, p, 6) complex motion about rotation_center per unit wave amplitude, m/m and rad/m.

        omega : (q,) rad/s; headings : (p,) rad, travelled to, None for those stored
        raises : BetweenError outside the database, and for damping that is known at stored waves only
        """
        omega = self.inside(omega)
        found = self._where_stored(omega, headings, "rao", Ring.of_forces)
        if found is not None and found.complete:
            return found.values
        self._check_motions()
        A, B = self.coefficients(omega)
        value = self._solved(omega, A, B, _known("excitation_force", self.forces(omega, headings)))
        return value if found is None else found.over(value)

    def drift(self, omega, headings=None, fixed=False):
        """(q, p, 3) mean drift per squared wave amplitude, N/m² and N m/m², of the floating or the fixed body.

        Raises BetweenError where it is not known.
        """
        omega, name = self.inside(omega), DRIFT[0] if fixed else DRIFT[1]
        found = self._where_stored(omega, headings, name, Ring.of_drift)
        if found is not None and found.complete:
            return found.values
        value = self._drift(omega, headings, fixed)
        return value if found is None else found.over(value)

    def at(self, omega, name, headings=None):
        """A quantity and its estimated error, about one standard deviation, at omega (q,) rad/s and headings (p,) rad.

        headings : None for those stored
        returns : value (q, …) as stored, error (q, …) in its unit, of a complex quantity that of the modulus
        raises : BetweenError outside what is stored, naming it
        """
        omega = np.atleast_1d(np.asarray(omega, float))
        if name in NEEDED and (name != "drift_force_fixed" or self.rebuilds_drift):
            return self._carried(omega, name, headings)
        if headings is not None and name == "kochin_diffraction":
            return self.far_field(omega, headings)[1], self._turned_error(omega, headings, name)
        if headings is not None and name in FORCES:
            return self.forces(omega, headings, name), self._turned_error(omega, headings, name)
        if headings is not None and name == "drift_force_fixed":
            return self.drift(omega, headings, fixed=True), self._turned_error(omega, headings, name)
        if headings is not None and name == "pressure":
            raise BetweenError("pressure is known at stored headings only; add the heading to the scene")
        return self.between.value(omega, name), self.between.error(omega, name)

    @cached_property
    def _ring(self):
        return ring(self.headings, self.between.theta, whole_mirrors(self.symmetry, (), self.rotation_center))

    @cached_property
    def _moving_ring(self):
        matrices = (self.inertia, self.stiffness, self.damping)
        return ring(
            self.headings, self.between.theta, whole_mirrors(self.symmetry, matrices, self.rotation_center)
        )  # fmt: skip

    def _turned(self, omega, headings, quadratic=False, of=None):
        return turned(self._ring if of is None else of, headings, omega, self.between, quadratic)

    def _nearest(self, omega):
        omega, (low, high) = np.atleast_1d(np.asarray(omega, float)), self.between.span
        low = 0.0 if self.between.has_limit("added_mass_zero") else low
        high = np.inf if self.between.has_limit("added_mass_infinity") else high
        return np.clip(omega, low, high)

    def _check_inertia(self):
        if self.inertia is None or self.stiffness is None:
            raise BetweenError("the database has no inertia of the body; give --gyration kxx,kyy,kzz and solve again")

    def _check_motions(self):
        self._check_inertia()
        if self.viscous is True:
            raise BetweenError(
                "the database has viscous damping in its motions, which depend on the wave height and are known in "
                "stored waves only; add the frequency and the heading to the scene and solve again"
            )

    def _haskind(self, omega, headings):
        """(q, p, 6) excitation from the Kochin functions of the radiation"""
        t = len(self.between.theta)
        order = np.fft.fftfreq(t, 1 / t)
        series = np.fft.fft(self.between.value(omega, "kochin_radiation"), axis=-1) / t
        there = series @ np.exp(1j * np.multiply.outer(order, headings + np.pi))
        k = wavenumber(omega, self.depth, self.gravity)
        factor = -4j * self.density * self.gravity * group_factor(k, self.depth) / k**2
        return factor[:, None, None] * there.swapaxes(1, 2)

    def _where_stored(self, omega, headings, name, mirrored):
        """`_Stored` of `omega` and `headings`, None where there is nothing stored"""
        place = self.between.stored(omega)
        if name not in self.between.quantities or not (self.own or name == DRIFT[0]) or not np.any(place >= 0):
            return None
        values = self.between.quantities[name][place]
        if headings is None:
            return _Stored(values, np.repeat(place[:, None] >= 0, values.shape[1], axis=1))
        of = self._ring if name == DRIFT[0] else self._moving_ring
        column = of.stored(of.inside(headings))
        return _Stored(mirrored(of, values)[:, column], np.logical_and.outer(place >= 0, column >= 0))

    def _solved(self, omega, A, B, F):
        """(q, p, 6) motions of given coefficients and forces"""
        if self.viscous:
            rows = zip(omega, A, B + self.damping, F, strict=True)
            return np.array([linearised_response(*row, self.inertia, self.stiffness, self.viscous)[0] for row in rows])
        w = omega[:, None, None]
        dynamic = -(w**2) * (self.inertia + A) - 1j * w * (B + self.damping) + self.stiffness
        return np.linalg.solve(dynamic, F.swapaxes(1, 2)).swapaxes(1, 2)

    def _absorbed(self, omega, X):
        """(q, p) W/m², ½ω² X* B′ X of the damping beside radiation"""
        loss = np.einsum("qpi,ij,qpj->qp", X.conj(), self.damping, X).real
        if self.viscous:
            laws = self.viscous
            damped = np.array(
                [
                    [laws.damping(w, laws.wave_amplitude * np.abs(x)) for x in row]
                    for w, row in zip(omega, X, strict=True)
                ]
            )
            loss = loss + np.einsum("qpi,qpij,qpj->qp", X.conj(), damped, X).real
        return 0.5 * omega[:, None] ** 2 * loss

    def _drift(self, omega, headings, fixed):
        """(q, p, 3) where no stored number serves"""
        if self.rebuilds_drift:
            radiated, H = self.far_field(omega, headings)
            X = None if fixed else self.motions(omega, headings)
            return self._far_field_drift(omega, headings, radiated, H, X) - self._amiss(omega, headings)
        name = DRIFT[0] if fixed else DRIFT[1]
        if name not in self.between.quantities:
            raise BetweenError(
                f"{', '.join(KOCHIN)} must be stored for {name}; run its command again with --only kochin,drift"
            )
        if not fixed and not self.own:
            raise BetweenError(
                "drift of a body with added damping or stiffness is rebuilt from Kochin functions, which the database "
                "lacks; run its command again with --only kochin,drift"
            )
        values = self.between.value(omega, name)
        if headings is None:
            return values
        of = self._ring if fixed else self._moving_ring
        return self._turned(omega, headings, True, of).value(of.of_drift(values), "drift")

    def _far_field_drift(self, omega, headings, radiated, H, X):
        """(q, p, 3) about rotation_center; motions X (q, p, 6) or None for the fixed body

        Energy, −Re H(β) = (1/2π) ∫|H|² dθ + kP/(2ρgC_g) with the power P absorbed, stands for the forward value in
        the forces, which would else be the small difference of what errors do not respect; the moment has none.
        """
        k = wavenumber(omega, self.depth, self.gravity)[:, None]
        n, beta = group_factor(k, self.depth), self.headings if headings is None else np.atleast_1d(headings)
        absorbed = 0.0
        if X is not None:
            H = H + X @ radiated
            speed = n * omega[:, None] / k
            absorbed = k * self._absorbed(omega, X) / (2 * self.density * self.gravity * speed)
        t = len(self.between.theta)
        order = np.fft.fftfreq(t, 1 / t)
        series = np.fft.fft(H, axis=-1) / t
        slopes = 1j * np.where(np.abs(order) == t / 2, 0.0, order) * series
        forward = -np.mean(np.abs(H) ** 2, axis=-1) - absorbed
        forward_slope = np.einsum("qpt,pt->qp", slopes, np.exp(1j * np.multiply.outer(beta, order)))
        force = mean_drift(
            H, np.fft.ifft(slopes * t, axis=-1), forward, forward_slope, self.between.theta, beta, k, n, self.density,
            self.gravity,
        )  # fmt: skip
        return about(force, self.rotation_center)

    def _amiss(self, omega, headings):
        """(q, p, 3) by how much the far field misses stored drift of the fixed body, straight between frequencies"""
        if DRIFT[0] not in self.between.quantities:
            return 0.0
        low = np.clip(np.searchsorted(self.omega, omega) - 1, 0, max(len(self.omega) - 2, 0))
        high = np.minimum(low + 1, len(self.omega) - 1)
        step = self.omega[high] - self.omega[low]
        share = np.where(step > 0, (omega - self.omega[low]) / np.where(step > 0, step, 1.0), 0.0)[:, None, None]
        missed = (1 - share) * self._missed[low] + share * self._missed[high]
        return (
            missed
            if headings is None
            else self._turned(omega, headings, True).value(self._ring.of_drift(missed), "drift")
        )

    @cached_property
    def _missed(self):
        """(n, m, 3) `_amiss` at stored waves"""
        radiated, H = self.far_field(self.omega)
        return self._far_field_drift(self.omega, None, radiated, H, None) - self.between.quantities[DRIFT[0]]

    def _carried(self, omega, name, headings):
        """Motions or drift, and the deviations of what they follow from carried through their equations"""
        omega, fixed = self.inside(omega), name == DRIFT[0]
        value = self.motions(omega, headings) if name == "rao" else self.drift(omega, headings, fixed)
        found = self._where_stored(omega, headings, name, Ring.of_forces if name == "rao" else Ring.of_drift)
        if found is not None and found.complete:
            return value, np.zeros(value.shape)
        if not self.rebuilds_drift and name != "rao":
            return value, self._turned_error(omega, headings, name)
        names = NEEDED[name]
        radiated, H = self.far_field(omega, headings) if self.rebuilds_drift else (None, None)
        parts = {
            "added_mass": lambda: self.coefficients(omega)[0],
            "radiation_damping": lambda: self.coefficients(omega)[1],
            "excitation_force": lambda: self.forces(omega, headings),
            "kochin_radiation": lambda: radiated,
            "kochin_diffraction": lambda: H,
        }
        parts = {part: parts[part]() for part in names}
        errors = {part: self._turned_error(omega, headings, part) for part in names}
        if name == "rao":
            error = one_by_one(lambda p: self._solved(omega, *p.values()), parts, errors)
        else:
            waves = wavenumber(omega, self.depth, self.gravity) * self.radius

            def equation(p):
                R, D, *others = p.values()
                X = self._solved(omega, *others) if others else None
                return self._far_field_drift(omega, headings, R, D, X)

            error = by_chance(equation, parts, errors, KOCHIN, waves)
        return value, error if found is None else np.where(found.mask[..., None], 0.0, error)

    def _turned_error(self, omega, headings, name):
        """Estimated error of a quantity at omega (q,) and headings (p,): of both interpolations"""
        error = self.between.error(omega, name)
        if headings is None or name in (*RADIATION, "kochin_radiation"):
            return error
        values, drift = self.between.value(omega, name), name in DRIFT
        of = self._moving_ring if name == DRIFT[1] else self._ring
        mirrored = of.of_drift if drift else of.of_kochin if name == "kochin_diffraction" else of.of_forces
        values, error = mirrored(values), np.abs(mirrored(error))
        over = self._turned(omega, headings, drift, of)
        independent = len(of.headings)
        if name != "kochin_diffraction":  # what symmetry makes zero says nothing
            size = np.abs(values).max(axis=0)
            independent = np.sum(size > 1e-6 * size.max(axis=0), axis=0) / 2 ** len(of.images)
        if name == "excitation_force" and "kochin_radiation" in self.between.quantities:
            there = self._haskind(omega, of.headings)
            values = np.where(np.isnan(there), values, values - there)
        spread = np.sqrt(np.abs(over.weights) ** 2 @ (error**2).reshape(*error.shape[:2], -1))
        spread = spread.reshape(*spread.shape[:2], *error.shape[2:])
        return np.hypot(spread, over.deviation(values, independent))


class _Stored(NamedTuple):
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
    between = of_database(db)
    return Reader(
        between,
        db.density,
        np.asarray(db.rotation_center, float),
        _or_none(db.inertia_matrix),
        _or_none(db.hydrostatic_stiffness),
        np.zeros((6, 6)),
        db.mesh.symmetry,
        viscous=db.has_viscous_motions,
    )


def _or_none(matrix):
    return None if matrix is None else np.asarray(matrix, float)


def _known(name, values):
    if not np.all(np.isfinite(values)):
        raise BetweenError(f"{name} is not known for all motions; solve again without a choice of motions")
    return values


def _matrix(name, value):
    if value is None:
        return np.zeros((6, 6))
    value = np.asarray(value, float)
    if value.shape != (6, 6) or not np.all(np.isfinite(value)):
        raise ValueError(f"{name} matrix has shape {value.shape}; allowed: (6, 6), finite")
    return value
