"""Solution of one frequency of one problem: the wanted quantities, and only the quantities needed for them."""

import time
from functools import cached_property

import numpy as np

from . import ESTIMATE, INTERPOLATED, POWER
from .checks import at_least_haskind, check, damping_error, largest_error
from .drift import OF_EACH, about, drift_of_two, mean_drift
from .free_body import motions
from .kochin import angles
from .waves import group_factor, wavenumber

RADIATION = {"added_mass", "radiation_damping", "kochin_radiation"}
DIFFRACTION = {
    "damping_lid_power",
    "diffraction_force",
    "excitation_force",
    "kochin_diffraction",
    "drift_force_fixed",
    "pressure",
}
FREE = {"rao", "drift_force", "body_drift_force"}
DRIFT = {"drift_force_fixed", "drift_force"}
# largest trusted estimate as a fraction of the tolerance: for 92 random bodies it was at least two thirds of the error
TRUSTED = 0.6


def solve_frequency(prepared, omega, headings, want, theta=None, dofs=None):
    """All quantities in `want` at one frequency, as a dictionary with the names of the database.

    prepared : prepared problem from `bem.methods.panel_problem.prepare`
    omega : frequency, rad/s; headings : directions that the waves travel to, rad, (m,); want : names of datasets
    theta : equally spaced angles of the Kochin functions, rad, (t,); dofs : names of the needed motions; None: all
    returns : arrays over the forces and motions of the problem (NaN where not in `dofs`), "checks", "wall_time" (s)
        and, if the method estimates errors, "estimated_error" of names in `schema.ESTIMATES`
    """
    start = time.perf_counter()
    run = prepared.run(omega, headings, want, theta, dofs).within_tolerance()
    estimating = time.perf_counter() - start - sum(run.wall_time.values())
    result = run.result()
    if run.solves:
        start = time.perf_counter()
        result["checks"]["estimated_error"] = run.estimated_error()
        result["estimated_error"] = run.estimated_errors()
        step = INTERPOLATED if run.interpolated else ESTIMATE
        result["wall_time"][step] = estimating + time.perf_counter() - start
    return result


class FrequencyRun:
    """The quantities of one frequency, each computed once, when first used; every method of solution is a subclass.

    A method provides `radiation`, `froude_krylov`, `diffraction`, `haskind`, `kochin` and `residual` as in
    `bem.first_order.FirstOrder`; `kochin` is at `theta` and at the headings, and `haskind` is None where it is
    unknown. It also provides `solves`, and `differences`: signed errors of `radiation` (6, 6) and `excitation` (m, 6)
    from two resolutions, or None; `kochin_errors` are the signed errors of `kochin`.
    """

    most_sharper = 0  # largest number of sharper runs, one after another
    interpolated = False  # whether `differences` are interpolated from other frequencies
    taken_at_rest = 0.0  # (m,) energy absorbed by damping lids in the balance of fixed bodies
    margin = 1.0  # factor on the error that follows from `differences`

    def __init__(self, prepared, omega, headings, want, theta, dofs):
        if not (np.isfinite(omega) and omega > 0):
            raise ValueError(
                f"omega is {omega} rad/s; allowed: positive and finite (for 0 or infinity use `frequency_limits`)"
            )
        self.prepared, self.problem = prepared, prepared.problem
        self.omega, self.want = float(omega), frozenset(want)
        self.headings = np.atleast_1d(np.asarray(headings, float))
        want = self.want
        self.k = float(wavenumber(omega, self.problem.depth, self.problem.gravity))
        self.theta = theta if theta is not None else angles(self.k, prepared.radius)
        names = self.problem.dofs
        self.count, self.asked = len(names), [names.index(d) for d in (names if dofs is None else dofs)]
        self.free = bool(want & (FREE | {"pressure", POWER})) and self.problem.inertia_matrix is not None
        # motions couple; a moment about another point than the origin also needs forces
        needed = np.any(self.problem.transform[self.asked], axis=0) | self.free
        self.forced = np.flatnonzero(needed).tolist()
        self.dofs = [d for d in self.forced if d in self.problem.moving]
        self.radiates = bool(want & RADIATION) or self.free
        self.diffracts = bool(want & (DIFFRACTION | {*OF_EACH})) or self.free
        self.far_field = bool(want & {"kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force"})
        self.wall_time = {}

    @property
    def question(self):
        """Arguments of a run of this frequency that follow the prepared problem"""
        return self.omega, self.headings, self.want, self.theta, [self.problem.dofs[d] for d in self.asked]

    def _timed(self, name, start):
        self.wall_time[name] = self.wall_time.get(name, 0.0) + time.perf_counter() - start

    @property
    def group_factor(self):
        """C_g / C"""
        return float(group_factor(self.k, self.problem.depth))

    @property
    def radiated(self):
        """B/ω from the far field, with B = 2ρgC_g/(πkω²) ∫ Hᵢ H̄ⱼ dθ; shape (6, 6); None if it is not computed"""
        if not self.far_field:
            return None
        H = self.kochin[0][0][:, : len(self.theta)]
        factor = 4 * self.problem.density * self.problem.gravity * self.group_factor / (self.k * self.omega) ** 2
        return factor * (H @ H.conj().T).real / len(self.theta)

    @cached_property
    def excitation(self):
        return self.froude_krylov + self.diffraction

    def within_tolerance(self):
        """A run whose estimated errors are within the tolerance; errors of damping are relative to the size of
        damping.

        While the errors of a run exceed the tolerance, the frequency is run again by `sharper`, up to `most_sharper`
        times while the error decreases.
        The number of repetitions is limited because, on panels a thousand times as long as wide, the error remains
        while work and memory grow fourfold.
        """
        run = self
        for _ in range(self.most_sharper if self.solves else 0):
            if run.differences is None or run.tolerances <= 1:
                break
            sharper = run.sharper  # the sharper run may use its own mesh and band
            if sharper is None:
                break
            before, run = run, sharper()
            if run.tolerances >= before.tolerances:
                break
        return run

    @cached_property
    def tolerances(self):
        """Largest difference between two resolutions, divided by the tolerance, or, for damping, by a fraction of the
        tolerance"""
        errors = self._at_least_haskind(*self.bounds)
        return max(largest_error(self, *errors), damping_error(self, errors[0]) / TRUSTED) / self.problem.tolerance

    @property
    def bounds(self):
        """`differences`, or upper bounds of their size if they are interpolated"""
        return self.differences

    @property
    def sharper(self):
        """A run of the same frequency with a smaller error, or None"""
        return None

    @cached_property
    def errors(self):
        """Estimated errors of `radiation` and `excitation`, or None; errors of excitation are at least the difference
        from `haskind`"""
        return None if self.bounds is None else self.enlarged(*self._at_least_haskind(*self.bounds))

    def enlarged(self, radiation, excitation):
        """Errors enlarged by the contributions that the difference between two resolutions does not contain"""
        return radiation, excitation

    def _at_least_haskind(self, radiation, excitation):
        if not self.diffracts or self.haskind is None:
            return radiation, excitation
        return radiation, at_least_haskind(excitation, self.excitation, self.haskind, self.dofs)

    @cached_property
    def rao(self):
        """Motions about the rotation centre of all bodies that are not fixed; shape (m, moving)"""
        return self._motions(self.radiation, self.excitation)

    @property
    def of_motion(self):
        """Matrix from the motions of `rao` to motions about the origin; shape (moving, 6); for N bodies (moving, 6N)"""
        return self.problem.transform[self.problem.moving]

    def _motions(self, radiation, excitation):
        T = self.problem.transform
        Z = T @ radiation @ self.of_motion.T
        return motions(self.problem, self.omega, Z.real, self.omega * Z.imag, excitation @ T.T)

    def drift(self, moving):
        """Mean drift about the rotation centre; shape (m, 3)"""
        return self._mean_drift(*self.kochin, self.rao if moving else None)

    def drift_of_two(self, moving):
        """Complex drift of pairs of headings about the rotation centre, by `bem.drift.drift_of_two`; shape (m, m, 3)"""
        H, slope = self._sent(*self.kochin, self.rao if moving else None)
        t = len(self.theta)
        force = drift_of_two(
            H[:, :t], slope[:, :t], H[:, t:], slope[:, t:], self.theta, self.headings, self.k,
            self.group_factor, self.problem.density, self.problem.gravity,
        )  # fmt: skip
        return about(force, self.problem.rotation_center)

    def _sent(self, radiation, diffraction, rao):
        """H and H′ of the whole"""
        (radiation, dradiation), (H, slope) = radiation, diffraction
        if rao is not None:
            T = self.of_motion
            H, slope = H + rao @ (T @ radiation), slope + rao @ (T @ dradiation)
        return H, slope

    def _mean_drift(self, radiation, diffraction, rao):
        H, slope = self._sent(radiation, diffraction, rao)
        t, m = len(self.theta), np.arange(len(self.headings))
        force = mean_drift(
            H[:, :t], slope[:, :t], H[m, t + m], slope[m, t + m], self.theta, self.headings, self.k,
            self.group_factor, self.problem.density, self.problem.gravity,
        )  # fmt: skip
        return about(force, self.problem.rotation_center)

    def asked_only(self, values):
        """`values` (…, 6), for several bodies (…, 6N), with NaN for degrees of freedom that were not requested"""
        out = np.full_like(values, np.nan)
        out[..., self.asked] = values[..., self.asked]
        return out

    def asked_radiation(self, radiation):
        """Matrix of the requested pairs about the rotation centre, NaN where not requested; shape (6, 6), for several
        bodies (6N, moving)"""
        T = self.problem.transform
        return self.asked_only(self.asked_only(T @ radiation @ T.T).T).T[:, self.problem.moving]

    def asked_motions(self, rao):
        """Motions (m, moving), with NaN for motions that were not requested"""
        left_out = ~np.isin(self.problem.moving, self.asked)
        return np.where(left_out, np.nan, rao)

    def estimated_error(self):
        """The largest relative error, `bem.checks.largest_error`; NaN without an estimate"""
        return np.nan if self.errors is None else largest_error(self, *self.errors)

    def estimated_errors(self):
        """{name: absolute errors} of the wanted `schema.ESTIMATES`, about the rotation centre.

        Errors of motions and drift are their changes when coefficients, forces and Kochin functions change by their
        errors. In long waves these changes nearly cancel, and at resonance the dependence is not linear.
        For this purpose all errors are differences between two resolutions: errors raised by `haskind` would destroy
        the cancellation.
        """
        if self.errors is None:
            return {}
        (radiation, excitation), T = self.errors, self.problem.transform
        Z = self.asked_radiation(radiation)
        out = {
            "added_mass": np.abs(Z.real),
            "radiation_damping": self.omega * np.abs(Z.imag),
            "excitation_force": np.abs(self.asked_only(excitation @ T.T)),
        }
        rao = None
        if self.free and self.want & FREE:
            radiation, excitation = self.enlarged(*self.differences)
            rao = self._motions(self.radiation - radiation, self.excitation - excitation)
            out["rao"] = self.margin * np.abs(self.asked_motions(self.rao - rao))
        if self.want & DRIFT and self.kochin_errors is not None:
            corrected = [H - error for H, error in zip(self.kochin, self.kochin_errors, strict=True)]
            for name, motion in (("drift_force_fixed", None), ("drift_force", rao)):
                if name in self.want and (motion is not None or name == "drift_force_fixed"):
                    change = self.drift(motion is not None) - self._mean_drift(*corrected, motion)
                    out[name] = self.margin * np.abs(change)
        return {name: value for name, value in out.items() if name in self.want}

    def result(self):
        T, want = self.problem.transform, self.want
        out = {}
        if want & {"added_mass", "radiation_damping"}:
            Z = self.asked_radiation(self.radiation)
            out |= {"added_mass": Z.real, "radiation_damping": self.omega * Z.imag}
        if want & {"Froude_Krylov_force", "excitation_force"}:
            out["Froude_Krylov_force"] = self.asked_only(self.froude_krylov @ T.T)
        if want & {"diffraction_force", "excitation_force"}:
            out["diffraction_force"] = self.asked_only(self.diffraction @ T.T)
            out["excitation_force"] = self.asked_only(self.excitation @ T.T)
        if "kochin_radiation" in want:
            out["kochin_radiation"] = self.of_motion @ self.kochin[0][0][:, : len(self.theta)]
        if "kochin_diffraction" in want:
            out["kochin_diffraction"] = self.kochin[1][0][:, : len(self.theta)]
        if "drift_force_fixed" in want:
            out["drift_force_fixed"] = self.drift(False)
        for name, moving in OF_EACH.items():
            if name in want and (self.free or not moving):
                out[name] = self.drift_of_each(moving)
        if POWER in want:
            out[POWER] = self.damping_lid_power()
        if "pressure" in want:
            out["pressure"] = self.pressure()
        if self.free and "rao" in want:
            out["rao"] = self.asked_motions(self.rao)
        if self.free and "drift_force" in want:
            out["drift_force"] = self.drift(True)
        out = {name: value for name, value in out.items() if name in want}
        out["checks"] = check(self) if self.solves else {}
        out["wall_time"] = self.wall_time
        return out
