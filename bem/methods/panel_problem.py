"""The radiation–diffraction problem of a panel mesh, and the part of its solution that is equal at all frequencies."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..kernels.threads import blas_threads
from ..modes import displacing
from ..problem import Problem

# nodes of a symmetric part times the root of its classes, from which equations by blocks of low rank are solved; they
# take less time than full ones from 2 800 on (of 3 136 nodes of one class 0.4 for 0.5 s, of 1 900 of four 0.4 for 0.8
# s), but bound the error of weak damping, as in roll, ten times less sharply
WORTH_COMPRESSING = 4000

if TYPE_CHECKING:  # the methods load their kernels when they run: a contour needs none of them
    from ..panels.influence import Geometry

PROBES = 5  # frequencies that determine which others need a finer mesh
RADIATION = {"added_mass", "radiation_damping"}


@dataclass(frozen=True, eq=False)
class PanelProblem(Problem):
    """A floating body in water for the panel method: all input except frequency and headings.

    mesh : hull panels; lid : interior free-surface panels or None
    coarse : (mesh, lid) of the same body with about half as many panels, for the error estimate; None: no estimate
    finer : object that refines the mesh at frequencies whose estimated error exceeds the tolerance even after
        extrapolation from the two meshes; or None. finer(mesh, lid) returns a mesh and a lid of the body with about
        twice as many panels, or None at the limit; finer.omegas (n,) are the frequencies of the run, rad/s;
        finer.band(mesh, lid, omegas) gives the `band` of frequencies on that mesh, or None
    nodes_per_panel : 4 (bilinear) or 1 (constant)
    wall : y of a vertical wall along x that reflects all waves, m; None for open water
    zero_draft : whether the flat bottom of the hull lies in the water surface (`bem.panels.zero_draft`)
    damping_lids : `bem.panels.damping_lid.DampingLid` of each damped water area; with them each frequency is solved
        alone
    band : lowest and highest frequency of a run, rad/s, whose frequencies share the work of `bem.panels.band.equations`
    """

    mesh: object
    lid: object = None
    coarse: tuple | None = None
    finer: object = None
    nodes_per_panel: int = 4
    wall: float | None = None
    zero_draft: bool = False
    damping_lids: tuple = ()
    band: tuple | None = None

    def prepared(self):
        """`PreparedPanelProblem`: the elements, images and all other data that depend only on geometry"""
        coarse = self.coarse and self._on(*self.coarse, finer=None).prepared()
        return self.prepared_beside(coarse)

    def prepared_beside(self, coarse):
        """`PreparedPanelProblem` combined with the prepared problem of a coarser mesh, or None"""
        from ..panels.zero_draft import flattened

        mesh, lid = (flattened(self.mesh), None) if self.zero_draft else (self.mesh, self.lid)
        return PreparedPanelProblem(self, _geometry(self, mesh, lid), coarse)

    def _on(self, mesh, lid, **changes):
        return replace(self, mesh=mesh, lid=lid, coarse=None, **changes)

    def refined(self):
        """The same problem on more panels, with each frequency solved alone; None at the limit. A problem without a lid
        gives a problem without a lid"""
        found = None if self.finer is None else self.finer(self.mesh, self.lid)
        return None if found is None else self._on(*found, band=None)


@dataclass(frozen=True, eq=False)
class PreparedPanelProblem:
    """A `PanelProblem` and the part of its solution that is equal at all frequencies, computed when first needed."""

    problem: PanelProblem
    geometry: Geometry
    coarse: PreparedPanelProblem | None = None

    @cached_property
    def modes(self):
        """Normal velocities of unit motions about the origin; shape (hull nodes, 6)"""
        return self.geometry.modes

    @cached_property
    def displacing(self):
        """Whether a mode displaces water, `bem.modes.displacing`; shape (6,)"""
        return displacing(self.geometry.mesh, self.problem.modes)

    @cached_property
    def axisymmetric_geometry(self):
        """Geometry of an axisymmetric body with an axisymmetric lid, which replaces the lid of the problem.

        φ' vanishes on the lid, so that any lid is valid.
        """
        g, problem = self.geometry, self.problem
        if problem.lid is None or g.sectors or not g.without_lid.sectors:
            return g
        from hakobune.meshing.lid import polar_lid

        lid = polar_lid(problem.mesh, float(np.sqrt(problem.lid.areas.mean())))
        return g if lid is None else _geometry(problem, problem.mesh, lid)

    @cached_property
    def with_damping_lids(self):
        """`bem.panels.damping_lid.with_damping_lids` of the problem"""
        from ..panels.damping_lid import with_damping_lids

        return with_damping_lids(self.problem)

    @cached_property
    def band_equations(self):
        """The `bem.panels.band.equations.BandEquations` of the problem's band, beginning with its lower part, without
        lid"""
        from ..checks import sufficient_accuracy
        from ..panels.band.equations import band_equations

        problem = self.problem
        with blas_threads(len(self.geometry.elements.nodes)):
            return band_equations(self.geometry, problem.band, problem.gravity, sufficient_accuracy(problem.mesh.total))

    @property
    def refinement(self):
        """Number of panels over the number of panels of the coarse mesh."""
        return self.problem.mesh.total / self.coarse.problem.mesh.total

    @cached_property
    def finer(self):
        """The same problem on more panels, whose coarser problem is this problem; None at the limit"""
        problem = self.problem.refined()
        if problem is None:
            return None
        few = problem.finer.band(problem.mesh, problem.lid, problem.finer.omegas) is None
        band = None if few else problem.finer.band(problem.mesh, problem.lid, self._beyond_tolerance)
        return replace(problem, band=band).prepared_beside(self)

    @property
    def _beyond_tolerance(self):
        """Frequencies, rad/s, that need a finer mesh: those between the outermost of some `PROBES` that keep the
        tolerance, if need be extrapolated, below and above all that do not; shape (n,), independent of the order of
        solution"""
        omegas = self.problem.finer.omegas
        probes = np.unique(np.linspace(0, len(omegas) - 1, PROBES).astype(int))
        if len(omegas) < 2 * len(probes):
            return omegas[:0]
        runs = (self.run(omegas[i], (), RADIATION, None, None) for i in probes)
        beyond = np.flatnonzero([run.tolerances > 1 and run.extrapolated.tolerances > 1 for run in runs])
        if not len(beyond):
            return omegas[:0]
        around = np.concatenate([[-1], probes, [len(omegas)]])
        return omegas[around[beyond[0]] + 1 : around[beyond[-1] + 2]]

    @property
    def radius(self):
        """Largest distance of the hull from the vertical axis through the origin, m"""
        return self.geometry.radius

    @property
    def draft(self):
        """Draft of the hull, m"""
        return self.geometry.draft

    def run(self, omega, *arguments, **more):
        """The quantities of one frequency; arguments as in `bem.panels.one_frequency.PanelRun`"""
        return self._kind(omega)(self, omega, *arguments, **more)

    def _kind(self, omega):
        if self.problem.zero_draft:
            from ..panels.zero_draft import ZeroDraftRun

            return ZeroDraftRun
        if self.problem.damping_lids:
            from ..panels.damping_lid import DampedRun

            return DampedRun
        if self.in_band(omega):
            from ..panels.band.one_frequency import BandRun

            return BandRun
        from ..panels.axisymmetric_frequency import AxisymmetricRun
        from ..panels.one_frequency import PanelRun

        K = omega**2 / self.problem.gravity
        if self.axisymmetric_geometry.at(K).sectors:
            return AxisymmetricRun
        if not self.compressed:
            return PanelRun
        from ..panels.compressed.one_frequency import CompressedRun

        return CompressedRun

    @property
    def compressed(self):
        """Whether frequencies outside the band are solved by `bem.panels.compressed`"""
        problem, g = self.problem, self.geometry
        size = len(g.elements.nodes) * len(g.classes) ** 0.5
        return not problem.zero_draft and problem.nodes_per_panel == 4 and size > WORTH_COMPRESSING

    def in_band(self, omega):
        """Whether a frequency lies in the problem's band, up to rounding"""
        band = self.problem.band
        return band is not None and band[0] * (1 - 1e-9) <= omega <= band[1] * (1 + 1e-9)

    def added_mass_limit(self, which):
        """`bem.panels.frequency_limits.added_mass_limit`"""
        from ..panels.frequency_limits import added_mass_limit
        from ..panels.zero_draft import rigid_surface_limit

        if self.problem.zero_draft:
            return rigid_surface_limit(self, which)
        if self.compressed and not self.geometry.without_lid.sectors:
            from ..panels.compressed.one_frequency import added_mass_limit
        return added_mass_limit(self, which)


def _geometry(problem, mesh, lid):
    from ..panels.influence import Geometry

    return Geometry(mesh, lid, problem.depth, problem.nodes_per_panel, problem.wall, problem.modes)


def prepare(problem):
    """The prepared problem of a `PanelProblem` or `ShapeProblem`; its expensive parts are computed at the first
    frequency."""
    return problem.prepared()
