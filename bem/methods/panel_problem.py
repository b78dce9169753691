"""The radiation–diffraction problem of a panel mesh, and its frequency-independent part."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..kernels.threads import blas_threads
from ..modes import normal_velocities
from ..panels.axisymmetric_frequency import AxisymmetricRun
from ..panels.band.one_frequency import BandRun
from ..panels.frequency_limits import added_mass_limit
from ..panels.influence import Geometry
from ..panels.one_frequency import PanelRun
from ..panels.zero_draft import ZeroDraftRun, flattened, rigid_surface_limit
from ..problem import Problem


@dataclass(frozen=True, eq=False)
class PanelProblem(Problem):
    """A floating body in water for the panel method: all input except frequency and headings.

    mesh : hull panels; lid : interior free-surface panels or None
    coarse : (mesh, lid) of the same body with about half as many panels, for the error estimate; None does without
    nodes_per_panel : 4 (bilinear) or 1 (constant)
    wall : y in m of a vertical wall along x that reflects all waves; None for open water
    zero_draft : the flat bottom of the hull laid into the water surface, `bem.panels.zero_draft`
    band : (low, high) rad/s, where many frequencies will be asked for: they then share the work of
        `bem.panels.band.equations`
    """

    mesh: object
    lid: object = None
    coarse: tuple | None = None
    nodes_per_panel: int = 4
    wall: float | None = None
    zero_draft: bool = False
    band: tuple | None = None

    def prepared(self):
        """`PreparedPanelProblem`: with elements, images and what else depends on the geometry only"""
        coarse = self.coarse and replace(self, mesh=self.coarse[0], lid=self.coarse[1], coarse=None).prepared()
        mesh, lid = (flattened(self.mesh), None) if self.zero_draft else (self.mesh, self.lid)
        return PreparedPanelProblem(self, Geometry(mesh, lid, self.depth, self.nodes_per_panel, self.wall), coarse)


@dataclass(frozen=True, eq=False)
class PreparedPanelProblem:
    """A `PanelProblem` with its frequency-independent part, computed when first needed."""

    problem: PanelProblem
    geometry: Geometry
    coarse: PreparedPanelProblem | None = None

    @cached_property
    def modes(self):
        """(hull nodes, 6) normal velocities of unit motions about the origin"""
        return self.geometry.modes

    @cached_property
    def displacing(self):
        """(6,) whether a mode moves water at all.

        Yaw of a round buoy does not, but for the corners of its polygon, nor does heave of a pile on the bed: a
        relative error of what they give says nothing.  A rotation counts if the mean square of its normal velocity
        is two per cent of that of its arms, both about the vertical axis through the middle of the hull's surface,
        so that it does not matter where the mesh lies.
        """
        g, n = self.geometry, self.geometry.hull
        w, nodes = g.elements.weights[:n], g.elements.nodes[:n]
        alone = np.mean(g.classes, axis=0)  # 0 along axes with a mirror image, where the middle lies on the plane
        middle = g.origin + np.append(alone * (w @ (nodes - g.origin)[:, :2]) / w.sum(), 0.0)
        modes, (x, y, z) = normal_velocities(nodes - middle, g.elements.normals[:n]), (nodes - middle).T
        arms = np.stack([np.ones(n)] * 3 + [y * y + z * z, z * z + x * x, x * x + y * y], axis=1)
        share = (w @ modes**2) / (w @ arms)
        return share > np.array([1e-6] * 3 + [0.02] * 3)

    @cached_property
    def axisymmetric_geometry(self):
        """The geometry of an axisymmetric body with an axisymmetric lid, which replaces one that is not.

        φ' vanishes on the lid, so that any will do.
        """
        g, problem = self.geometry, self.problem
        if problem.lid is None or g.sectors or not g.without_lid.sectors:
            return g
        from meshing.lid import polar_lid

        lid = polar_lid(problem.mesh, float(np.sqrt(problem.lid.areas.mean())))
        return g if lid is None else Geometry(problem.mesh, lid, problem.depth, problem.nodes_per_panel)

    @cached_property
    def band_equations(self):
        """(`bem.panels.band.equations.BandEquations`, …) of the problem's band, of its lower part without lid first"""
        from ..panels.band.equations import band_equations, sufficient_accuracy

        problem = self.problem
        with blas_threads(len(self.geometry.elements.nodes)):
            return band_equations(self.geometry, problem.band, problem.gravity, sufficient_accuracy(problem.mesh.total))

    @property
    def refinement(self):
        """How many panels the mesh has for one of the coarse mesh."""
        return self.problem.mesh.total / self.coarse.problem.mesh.total

    @property
    def radius(self):
        """m, largest distance of the hull from the vertical axis through the origin"""
        return self.geometry.radius

    @property
    def draft(self):
        """m, of the hull"""
        return self.geometry.draft

    def run(self, *arguments):
        """The quantities of one frequency; arguments as in `bem.frequency.FrequencyRun`"""
        if self.problem.zero_draft:
            return ZeroDraftRun(self, *arguments)
        if self.in_band(arguments[0]):
            return BandRun(self, *arguments)
        axisymmetric = self.axisymmetric_geometry.at(arguments[0] ** 2 / self.problem.gravity).sectors
        return (AxisymmetricRun if axisymmetric else PanelRun)(self, *arguments)

    def in_band(self, omega):
        """Whether a frequency lies in the problem's band, to rounding"""
        band = self.problem.band
        return band is not None and band[0] * (1 - 1e-9) <= omega <= band[1] * (1 + 1e-9)

    def added_mass_limit(self, which):
        """`bem.panels.frequency_limits.added_mass_limit`"""
        return (rigid_surface_limit if self.problem.zero_draft else added_mass_limit)(self, which)


def prepare(problem):
    """A `PanelProblem` or `ShapeProblem` prepared; its expensive parts are computed with the first frequency."""
    return problem.prepared()
