"""One frequency of one body: what is wanted, what that needs, and nothing else."""

from __future__ import annotations

import time
from functools import cached_property

import numpy as np

from . import DOFS
from .checks import check, estimated_error
from .drift import about, mean_drift
from .green_tables import wave_table
from .influence import assembled
from .kochin import angles, far_field_integrals
from .modes import class_of
from .motions import response
from .threads import blas_threads
from .waves import depth_factor, depth_factor_slope, group_factor, incident_wave, wavenumber

RADIATION = {"added_mass", "radiation_damping", "kochin_radiation"}
DIFFRACTION = {"diffraction_force", "excitation_force", "kochin_diffraction", "drift_force_fixed", "pressure"}
FREE = {"rao", "drift_force"}


def solve_frequency(prepared, omega, headings, want, theta=None, dofs=DOFS):
    """Everything in `want` at one frequency, as a dictionary with the names of the database.

    omega : rad/s, headings : (m,) rad towards which the waves travel, want : names of datasets
    theta : (t,) rad equally spaced, angles of the Kochin functions; dofs : degrees of freedom that are needed
    returns : arrays over 6 degrees of freedom (NaN where not in `dofs`), "checks" and "wall_time" (s)

    Only symmetry classes that hold a wanted degree of freedom or a wave are assembled and solved.
    """
    run = FrequencyRun(prepared, omega, headings, want, theta, dofs)
    result = run.result()
    if prepared.coarse is not None and run.columns:
        start = time.perf_counter()
        rough = FrequencyRun(prepared.coarse, omega, headings, want, run.theta, dofs)
        result["checks"]["estimated_error"] = estimated_error(run, rough, prepared.refinement)
        result["wall_time"]["error estimate"] = time.perf_counter() - start
    return result


class FrequencyRun:
    """The intermediate quantities of one frequency, each computed once and only when asked for."""

    def __init__(self, prepared, omega, headings, want, theta, dofs):
        if not (np.isfinite(omega) and omega > 0):
            raise ValueError(f"omega is {omega} rad/s; allowed: positive and finite (limits are in bem.limits)")
        self.prepared, self.geometry, self.setup = prepared, prepared.geometry, prepared.setup
        self.omega, self.want = float(omega), frozenset(want)
        self.headings = np.atleast_1d(np.asarray(headings, float))
        want = self.want
        self.k = float(wavenumber(omega, self.setup.depth, self.setup.gravity))
        self.theta = theta if theta is not None else angles(self.k, self.geometry.radius)
        self.asked = [DOFS.index(d) for d in dofs]
        self.free = bool(want & FREE | want & {"pressure"}) and self.setup.inertia_matrix is not None
        # motions couple; a moment about another point than the origin needs forces too
        self.dofs = [d for d in range(6) if self.free or np.any(prepared.transform[self.asked, d])]
        self.radiates = bool(want & RADIATION) or self.free
        self.diffracts = bool(want & DIFFRACTION) or self.free
        self.whole_field = "pressure" in want
        self.far_field = bool(want & {"kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force"})
        self.wall_time = {}

    def _timed(self, name, start):
        self.wall_time[name] = self.wall_time.get(name, 0.0) + time.perf_counter() - start

    def depth_values(self, z):
        """(q, 2) Z and Z′"""
        h = self.setup.depth
        return np.stack([depth_factor(z, self.k, h), depth_factor_slope(z, self.k, h)], axis=-1)

    @cached_property
    def hull(self):
        """Nodes, weights and normals of the hull (without the lid)."""
        e, n = self.geometry.elements, self.geometry.hull
        return e.nodes[:n], e.weights[:n], e.normals[:n]

    @cached_property
    def incident(self):
        """{class: φ_I and ∂φ_I/∂n at the nodes, each (m, n)} and the Froude–Krylov force (m, 6) about the origin"""
        g = self.geometry
        nodes, weights, normals = self.hull
        phi, flux = np.empty((2, len(g.images), len(self.headings), len(weights)), complex)
        for i, (x, y) in enumerate(g.images):
            mirror = np.array([x, y, 1.0])
            for j, beta in enumerate(self.headings):
                phi[i, j], gradient = incident_wave(
                    nodes * mirror, beta, self.omega, self.k, self.setup.depth, self.setup.gravity
                )
                flux[i, j] = np.einsum("qi,qi->q", gradient, normals * mirror)
        out, force = {}, np.zeros((len(self.headings), 6), complex)
        for cls in g.classes:
            out[cls] = tuple(np.tensordot(g.signs(cls), f, 1) / len(g.images) for f in (phi, flux))
            mine = self.members(cls)
            force[:, mine] = out[cls][0] @ self.weighted_modes[:, mine]
        return out, -1j * self.setup.density * self.omega * force

    def members(self, cls):
        """Degrees of freedom that a symmetry class holds."""
        return [d for d in range(6) if class_of(d, self.setup.mesh.symmetry) == cls]

    @cached_property
    def weighted_modes(self):
        """(n, 6) generalized normal times area of the node and its images"""
        return self.prepared.modes * self.hull[1][:, None] * len(self.geometry.images)

    @cached_property
    def columns(self):
        """{class: (its radiating dofs, its headings)}, empty classes left out."""
        table = {}
        for cls in self.geometry.classes:
            mine = self.members(cls)
            moving = [d for d in mine if d in self.dofs] if self.radiates else []
            waves = []
            if self.diffracts and (self.far_field or self.whole_field or any(d in self.dofs for d in mine)):
                velocity = self.incident[0][cls][1]
                largest = max(np.abs(v).max() for _, v in self.incident[0].values())
                waves = [j for j in range(len(self.headings)) if np.abs(velocity[j]).max() > 1e-12 * largest]
            if moving or waves:
                table[cls] = moving, waves
        return table

    def velocities(self, cls):
        """(columns, n) normal velocities: unit motions, then minus the incident waves"""
        moving, waves = self.columns[cls]
        parts = [self.prepared.modes[:, moving].T.astype(complex)]
        if waves:
            parts.append(-self.incident[0][cls][1][waves])
        return np.concatenate(parts)

    @cached_property
    def potentials(self):
        """{class: potentials (columns, n) on the hull}"""
        with blas_threads(len(self.geometry.elements.nodes)):
            return self._solved()

    def _solved(self):
        from scipy.linalg import lu_factor, lu_solve

        start = time.perf_counter()
        classes = list(self.columns)
        velocities = {c: self.velocities(c) for c in classes}
        self._timed("incident", start)
        start = time.perf_counter()
        _ = self.geometry.rankine
        self._timed("rankine", start)
        start = time.perf_counter()
        g = self.geometry
        table = wave_table(self.omega, self.setup.depth, self.setup.gravity, g.reach, g.mesh.draft)
        self._timed("table", start)
        start = time.perf_counter()
        matrices, sides = assembled(g, classes, 1.0, table, self.depth_values, [velocities[c] for c in classes])
        self._timed("assemble", start)
        start = time.perf_counter()
        out, self.residual = {}, 0.0
        for cls, A, b in zip(classes, matrices, sides, strict=True):
            b = b[:, : len(velocities[cls])]
            # LAPACK wants columns: the transposed view is factored and solved transposed, nothing is copied twice
            x = lu_solve(lu_factor(A.T, check_finite=False), b, trans=1, check_finite=False)
            if not np.all(np.isfinite(x)):
                raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
            scale = np.maximum(np.abs(b).max(axis=0), 1e-300)
            self.residual = max(self.residual, float((np.abs(A @ x - b).max(axis=0) / scale).max()))
            out[cls] = np.ascontiguousarray(x[: g.hull].T)
        self._timed("solve", start)
        return out

    @cached_property
    def radiation(self):
        """Complex A + iB/ω (6, 6) about the origin, zero where a degree of freedom was left out"""
        out = np.zeros((6, 6), complex)
        for cls, (moving, _) in self.columns.items():
            if moving:
                phi = self.potentials[cls][: len(moving)]
                out[np.ix_(moving, moving)] = -self.setup.density * (phi @ self.weighted_modes[:, moving]).T
        return out

    @cached_property
    def diffraction(self):
        """Diffraction force (m, 6) about the origin"""
        out = np.zeros((len(self.headings), 6), complex)
        for cls, (moving, waves) in self.columns.items():
            mine = self.members(cls)
            phi = self.potentials[cls][len(moving) :]
            out[np.ix_(waves, mine)] = -1j * self.setup.density * self.omega * (phi @ self.weighted_modes[:, mine])
        return out

    @cached_property
    def haskind(self):
        """Excitation (m, 6) from the radiation potentials: −iρω ∬ (φ_I nⱼ − φⱼ ∂φ_I/∂n) dS (Haskind 1957)"""
        waves, force = self.incident
        out = np.zeros(force.shape, complex)
        areas = self.hull[1] * len(self.geometry.images)
        for cls, (moving, _) in self.columns.items():
            if moving:
                phi = self.potentials[cls][: len(moving)]
                scattered = 1j * self.setup.density * self.omega * (waves[cls][1] * areas) @ phi.T
                out[:, moving] = force[:, moving] + scattered
        return out

    @cached_property
    def kochin(self):
        """H and H′ at `theta` and at the headings: radiation (6, t+m), diffraction (m, t+m); about the origin"""
        start = time.perf_counter()
        g = self.geometry
        nodes, weights, normals = self.hull
        at = np.concatenate([self.theta, self.headings])
        radiation = np.zeros((2, 6, len(at)), complex)
        diffraction = np.zeros((2, len(self.headings), len(at)), complex)
        factor = -(self.k**2) / (4 * self.group_factor * self.omega)
        for cls, (moving, waves) in self.columns.items():
            both = far_field_integrals(
                at, self.k, nodes, weights, normals, self.depth_values(nodes[:, 2]),
                g.images, g.signs(cls), self.potentials[cls], self.velocities(cls),
            )  # fmt: skip
            for i in range(2):
                radiation[i, moving] = -1j * self.omega * factor * both[i][: len(moving)]
                diffraction[i, waves] += factor * both[i][len(moving) :]
        self._timed("far field", start)
        return radiation, diffraction

    @property
    def group_factor(self):
        """C_g / C"""
        return float(group_factor(self.k, self.setup.depth))

    @cached_property
    def excitation(self):
        return self.incident[1] + self.diffraction

    @cached_property
    def rao(self):
        """(m, 6) about the rotation centre"""
        T, Z = self.prepared.transform, self.radiation
        A = T @ Z @ T.T
        return response(
            self.omega, A.real, self.omega * A.imag, self.excitation @ T.T,
            self.setup.inertia_matrix, self.setup.hydrostatic_stiffness,
        )  # fmt: skip

    def drift(self, moving):
        (radiation, dradiation), (H, slope) = self.kochin
        if moving:
            T = self.prepared.transform
            H, slope = H + self.rao @ (T @ radiation), slope + self.rao @ (T @ dradiation)
        t, m = len(self.theta), np.arange(len(self.headings))
        force = mean_drift(
            H[:, :t], slope[:, :t], H[m, t + m], slope[m, t + m], self.theta, self.headings, self.k,
            self.group_factor, self.setup.density, self.setup.gravity,
        )  # fmt: skip
        return about(force, self.setup.rotation_center)

    def disturbance(self, heading, moving):
        """{class: φ_D + Σ(−iωX)φ at the nodes (n,)}, and the matching normal velocity"""
        g = self.geometry
        X = -1j * self.omega * self.prepared.transform.T @ self.rao[heading] if moving else np.zeros(6, complex)
        out = {}
        for cls in g.classes:
            phi, velocity = np.zeros((2, g.hull), complex)
            if cls in self.columns:
                moved, waves = self.columns[cls]
                solved, given = self.potentials[cls], self.velocities(cls)
                for i, d in enumerate(moved):
                    phi, velocity = phi + X[d] * solved[i], velocity + X[d] * given[i]
                if heading in waves:
                    i = len(moved) + waves.index(heading)
                    phi, velocity = phi + solved[i], velocity + given[i]
            out[cls] = phi, velocity
        return out

    def pressure(self):
        """(m, panels of the whole hull) mean dynamic pressure iωρφ on each panel, Pa per m of wave amplitude

        Of the freely floating body where its inertia is known, else of the fixed one; panels as in `mesh.whole()`.
        """
        g, (_, weights, _) = self.geometry, self.hull
        shares = weights.reshape(len(self.setup.mesh), -1)
        shares = shares / shares.sum(axis=1, keepdims=True)
        out = np.empty((len(self.headings), len(g.images), len(shares)), complex)
        for j in range(len(self.headings)):
            phi = {c: p + self.incident[0][c][0][j] for c, (p, _) in self.disturbance(j, self.free).items()}
            for i in range(len(g.images)):
                total = sum(g.signs(c)[i] * p for c, p in phi.items())
                out[j, i] = np.sum(total.reshape(shares.shape) * shares, axis=1)
        return 1j * self.omega * self.setup.density * out.reshape(len(self.headings), -1)

    def asked_only(self, values):
        """`values` (…, 6) with NaN in place of degrees of freedom nobody asked for"""
        out = np.full_like(values, np.nan)
        out[..., self.asked] = values[..., self.asked]
        return out

    def result(self):
        T, want = self.prepared.transform, self.want
        out = {}
        if want & {"added_mass", "radiation_damping"}:
            Z = self.asked_only(self.asked_only(T @ self.radiation @ T.T).T).T
            out |= {"added_mass": Z.real, "radiation_damping": self.omega * Z.imag}
        if want & {"Froude_Krylov_force", "excitation_force"}:
            out["Froude_Krylov_force"] = self.asked_only(self.incident[1] @ T.T)
        if want & {"diffraction_force", "excitation_force"}:
            out["diffraction_force"] = self.asked_only(self.diffraction @ T.T)
            out["excitation_force"] = self.asked_only(self.excitation @ T.T)
        if "kochin_radiation" in want:
            out["kochin_radiation"] = T @ self.kochin[0][0][:, : len(self.theta)]
        if "kochin_diffraction" in want:
            out["kochin_diffraction"] = self.kochin[1][0][:, : len(self.theta)]
        if "drift_force_fixed" in want:
            out["drift_force_fixed"] = self.drift(False)
        if "pressure" in want:
            out["pressure"] = self.pressure()
        if self.free and "rao" in want:
            out["rao"] = self.asked_only(self.rao)
        if self.free and "drift_force" in want:
            out["drift_force"] = self.drift(True)
        out = {name: value for name, value in out.items() if name in want}
        if self.columns:
            _ = self.potentials
            out["checks"] = check(self)
        else:
            out["checks"] = {}
        out["wall_time"] = self.wall_time
        return out
