"""The panel method at one frequency: potentials on the hull and derived results."""

import time
from functools import cached_property, partial

import numpy as np

from .. import POWER
from ..algebra.systems import solved_beside_few
from ..checks import estimate, share_left
from ..drift import OF_EACH
from ..frequency import FrequencyRun
from ..green.tables import wave_table
from ..kernels.progress import FINER, report_progress
from ..kernels.threads import blas_threads
from ..kochin import far_field_integrals
from ..waves import depth_values
from .incident_waves import class_waves
from .influence import assembled


class PanelRun(FrequencyRun):
    """Potentials and forces of one frequency, by direct boundary elements (`bem.panels.influence`).

    Only symmetry classes with a wanted degree of freedom or an incident wave are assembled and solved.
    refined : the run on fewer panels that this run refines, or None
    """

    most_sharper = 3

    def __init__(self, prepared, omega, headings, want, theta, dofs, refined=None):
        super().__init__(prepared, omega, headings, want, theta, dofs)
        self.refined = refined
        if self.far_field and prepared.problem.wall is not None:
            raise ValueError(
                "beside a wall waves do not travel in all directions: there are no Kochin functions and no drift forces"
            )
        self.geometry = prepared.geometry.at(self.omega**2 / prepared.problem.gravity)
        self.whole_field = bool(self.want & {"pressure", POWER, *OF_EACH})

    @property
    def solves(self):
        """Whether any equations must be solved"""
        return bool(self.columns)

    @property
    def froude_krylov(self):
        return self.incident[1]

    @cached_property
    def residual(self):
        """Largest residual of the linear equations, relative to the right-hand sides"""
        _ = self.force_potentials
        return self._residual

    @cached_property
    def differences(self):
        """Errors by `bem.checks.estimate` from the coarser mesh; None without a coarser mesh"""
        return None if self.coarse is None else estimate(self, self.coarse, self.prepared.refinement)

    @cached_property
    def coarse(self):
        """The same frequency on the coarser mesh, or None"""
        return self.refined or (self.prepared.coarse and self.prepared.coarse.run(*self.question))

    @cached_property
    def extrapolated(self):
        """The same frequency, extrapolated from this mesh and the coarser mesh"""
        from .extrapolated import ExtrapolatedRun

        return ExtrapolatedRun(self)

    @property
    def sharper(self):
        """The run extrapolated from two meshes or, if this is not accurate enough, a run on the next finer mesh

        None if no estimate requires a sharper run, and if the user has set the number of panels
        """
        if self.coarse is None or self.problem.finer is None:
            return None
        return (lambda: self.extrapolated) if self.extrapolated.tolerances <= 1 else self.on_finer_mesh

    @property
    def on_finer_mesh(self):
        """A run on the next finer mesh of the problem; None if there is no finer mesh"""
        finer = self.prepared.finer
        return None if finer is None else partial(self._on, finer)

    def _on(self, finer):
        report_progress(FINER, (finer, self.omega))
        return finer.run(*self.question, refined=self)

    @property
    def kochin_errors(self):
        """Estimated errors of the Kochin functions"""
        share = share_left(self.prepared.refinement)
        return [share * (rough - H) for H, rough in zip(self.kochin, self.coarse.kochin, strict=True)]

    @property
    def depth_values(self):
        """`bem.waves.depth_values` of this frequency"""
        return depth_values(self.k, self.problem.depth)

    @property
    def reach(self):
        """Largest horizontal distance between two interacting points, m"""
        return self.geometry.reach

    @cached_property
    def hull(self):
        """Nodes, weights and normals of the hull, without those of the lid."""
        e, n = self.geometry.elements, self.geometry.hull
        return e.nodes[:n], e.weights[:n], e.normals[:n]

    @cached_property
    def incident(self):
        """{class: φ_I and ∂φ_I/∂n at the nodes, each (m, n)} and the Froude–Krylov force (m, 6) about the origin"""
        g = self.geometry
        waves = np.empty((2, len(g.classes), len(self.headings), g.hull), complex)
        for j, beta in enumerate(self.headings):
            waves[:, :, j] = class_waves(g, beta, self.omega, self.k, self.problem.gravity)
        out, force = {}, np.zeros((len(self.headings), self.count), complex)
        for i, cls in enumerate(g.classes):
            out[cls] = waves[0, i], waves[1, i]
            own = g.members(cls)
            force[:, own] = out[cls][0] @ self.weighted_modes[:, own]
        return out, -1j * self.problem.density * self.omega * force

    @cached_property
    def weighted_modes(self):
        """Generalized normal times area of the node and its images; shape (n, 6)"""
        return self.prepared.modes * self.hull[1][:, None] * self.geometry.copies

    @cached_property
    def columns(self):
        """Right-hand sides {class: (radiating dofs, headings)}; classes without right-hand sides are omitted."""
        table, incident_headings = {}, self.incident_headings if self.diffracts else {}
        for cls in self.geometry.classes:
            own = self.geometry.members(cls)
            moving = [d for d in own if d in self.dofs] if self.radiates else []
            waves = []
            if self.diffracts and (self.far_field or self.whole_field or any(d in self.forced for d in own)):
                waves = incident_headings[cls]
            if moving or waves:
                table[cls] = moving, waves
        return table

    @property
    def incident_headings(self):
        """{class: headings whose waves have a part with the symmetry of the class}"""
        sizes = {cls: np.abs(velocity).max(axis=1) for cls, (_, velocity) in self.incident[0].items()}
        least = 1e-12 * max(size.max() for size in sizes.values())
        return {cls: np.flatnonzero(size > least).tolist() for cls, size in sizes.items()}

    def velocities(self, cls):
        """Normal velocities; shape (columns, n): unit motions, then minus the incident waves"""
        moving, waves = self.columns[cls]
        parts = [self.prepared.modes[:, moving].T.astype(complex)]
        if waves:
            parts.append(-self.incident[0][cls][1][waves])
        return np.concatenate(parts)

    @cached_property
    def potentials(self):
        """{class: potentials (columns, n) on the hull}"""
        return self._solved()

    @property
    def force_potentials(self):
        """{class: potentials (columns, n) on the hull}, possibly without harmonics that exert no force on the body"""
        return self.potentials

    def _solved(self):
        start = time.perf_counter()
        classes = list(self.columns)
        velocities = {c: self.velocities(c) for c in classes}
        self._timed("incident", start)
        start = time.perf_counter()
        _ = self.geometry.rankine
        self._timed("rankine", start)
        start = time.perf_counter()
        g = self.geometry
        table = wave_table(self.omega, self.problem.depth, self.problem.gravity, self.reach, g.draft)
        self._timed("table", start)
        start = time.perf_counter()
        with blas_threads(1):  # its products are small, and its kernels have their own threads
            equations = self.equations(classes, table, [velocities[c] for c in classes])
        self._timed("assemble", start)
        start = time.perf_counter()
        solutions, self._residual = self.solved(equations, [len(velocities[c]) for c in classes])
        if not all(np.all(np.isfinite(x)) for x in solutions):
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
        self.solutions = dict(zip(classes, solutions, strict=True))
        out = {cls: self.on_hull(x, velocities[cls]) for cls, x in self.solutions.items()}
        self._timed("solve", start)
        return out

    def equations(self, classes, table, velocities):
        """`bem.panels.influence.Equations` of the classes"""
        return assembled(self.geometry, classes, 1.0, table, self.depth_values, velocities)

    def solved(self, equations, counts):
        """Solutions (n, columns) of each class, and the largest residual"""
        return solved_beside_few(equations, counts)

    def on_hull(self, solution, velocities):
        """Potentials (columns, hull nodes) from a solution (n, columns) of the equations"""
        return np.ascontiguousarray(solution[: self.geometry.hull].T)

    @cached_property
    def pressure_integrals(self):
        """{class: ∬ φ nⱼ dS (columns, its degrees of freedom)} over the whole hull"""
        members = self.geometry.members
        return {cls: self.force_potentials[cls] @ self.weighted_modes[:, members(cls)] for cls in self.columns}

    @cached_property
    def haskind_integrals(self):
        """{class: ∬ φⱼ ∂φ_I/∂n dS (m, its radiating dofs)} over the whole hull"""
        waves, areas = self.incident[0], self.hull[1] * self.geometry.copies
        return {
            cls: (waves[cls][1] * areas) @ self.force_potentials[cls][: len(moving)].T
            for cls, (moving, _) in self.columns.items()
        }

    @cached_property
    def radiation(self):
        """Complex A + iB/ω (6, 6) about the origin, zero for degrees of freedom that were not solved"""
        out = np.zeros((self.count, self.count), complex)
        for cls, (moving, _) in self.columns.items():
            members = self.geometry.members(cls)
            forced = [d for d in members if d in self.forced]
            own = [members.index(d) for d in forced]
            out[np.ix_(forced, moving)] = -self.problem.density * self.pressure_integrals[cls][: len(moving), own].T
        return out

    @cached_property
    def diffraction(self):
        """Diffraction force (m, 6) about the origin"""
        out = np.zeros((len(self.headings), self.count), complex)
        for cls, (moving, waves) in self.columns.items():
            own, pressure_integrals = self.geometry.members(cls), self.pressure_integrals[cls][len(moving) :]
            out[np.ix_(waves, own)] = -1j * self.problem.density * self.omega * pressure_integrals
        return out

    @cached_property
    def haskind(self):
        """Excitation (m, 6) from the radiation potentials: −iρω ∬ (φ_I nⱼ − φⱼ ∂φ_I/∂n) dS (Haskind 1957)

        None if the radiation or the diffraction is not solved.
        """
        if not (self.radiates and self.diffracts):
            return None
        force = self.incident[1]
        out = np.zeros(force.shape, complex)
        for cls, (moving, _) in self.columns.items():
            out[:, moving] = force[:, moving] + 1j * self.problem.density * self.omega * self.haskind_integrals[cls]
        return out

    @cached_property
    def kochin(self):
        """H and H′ at `theta` and at the headings: radiation (6, t+m), diffraction (m, t+m); about the origin"""
        start = time.perf_counter()
        g = self.geometry
        nodes, weights, normals = self.senders
        at = np.concatenate([self.theta, self.headings])
        radiation = np.zeros((2, self.count, len(at)), complex)
        diffraction = np.zeros((2, len(self.headings), len(at)), complex)
        factor = -(self.k**2) / (4 * self.group_factor * self.omega)
        for cls, (moving, waves) in self.columns.items():
            both = far_field_integrals(
                at, self.k, nodes, weights, normals, self.depth_values(nodes[:, 2]),
                g.images, g.signs(cls), *self.sent(cls),
            )  # fmt: skip
            for i in range(2):
                radiation[i, moving] = -1j * self.omega * factor * both[i][: len(moving)]
                diffraction[i, waves] += factor * both[i][len(moving) :]
        self._timed("far field", start)
        return radiation, diffraction

    @property
    def senders(self):
        """Nodes, weights and normals of all surfaces that radiate waves"""
        return self.hull

    def sent(self, cls):
        """Potentials and normal velocities (columns, nodes of `senders`) of a class"""
        return self.potentials[cls], self.velocities(cls)

    def disturbance(self, heading, motion):
        """{class: φ_D + Σ(−iωX)φ at the nodes (n,)}, and the matching normal velocity.

        motion : (6,) X about the origin
        """
        g, X = self.geometry, -1j * self.omega * motion
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

    def drift_of_each(self, moving):
        """`bem.panels.pressure_drift.of_each_body.drift_of_each`"""
        from .pressure_drift.of_each_body import drift_of_each

        return drift_of_each(self, moving)

    def pressure(self):
        """Mean dynamic pressure iωρφ on each panel, Pa per m of wave amplitude; shape (m, panels of the whole hull)

        The body floats freely if its inertia is known, and is fixed otherwise. Panels are those of `mesh.whole()`,
        also if this run is on a finer mesh.
        """
        if self.refined is not None:
            return self.refined.pressure()
        g, (_, weights, _) = self.geometry, self.hull
        shares = weights.reshape(len(g.mesh), -1)
        shares = shares / shares.sum(axis=1, keepdims=True)
        out = np.empty((len(self.headings), g.copies, len(shares)), complex)
        for j in range(len(self.headings)):
            motion = self.rao[j] @ self.of_motion if self.free else np.zeros(self.count)
            phi = {c: p + self.incident[0][c][0][j] for c, (p, _) in self.disturbance(j, motion).items()}
            for i in range(g.copies):
                total = sum(g.signs(c)[i] * p for c, p in phi.items())
                out[j, i] = np.sum(total.reshape(shares.shape) * shares, axis=1)
        return 1j * self.omega * self.problem.density * out.reshape(len(self.headings), -1)
