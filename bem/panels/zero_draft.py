"""A flat plate on the water surface: the limit of vanishing draft.

On the plate ∂φ/∂z = w; elsewhere the surface is free.  The pressure on the plate acts on a free surface as
sources of strength q = w − Kφ,

    4πφ = ∬ q G dS      →      4πq + K ∬ q G dS = 4πw,      φ = (w − q)/K

with G of `bem.green.finite_depth` at z = ζ = 0.  q is P of SR179 report (1982), section 2.1.5.3, eqs. 2.1.5.30-33,
for w = ζ.
Heave, roll and pitch radiate waves, surge, sway and yaw do not.
"""

from dataclasses import replace

import numpy as np

from ..green.tables import limit_table
from ..kernels.threads import blas_threads
from .frequency_limits import added_mass_of, unit_depth_values
from .influence import assembled
from .one_frequency import PanelRun

HORIZONTAL = 1e-6  # sine of the largest slope of a panel of a flat bottom


def bottom(mesh):
    """Whether each panel belongs to the flat bottom; shape (n,)"""
    deepest = mesh.vertices[:, :, 2].max(axis=1) <= -mesh.draft * (1 - HORIZONTAL)
    return deepest & (mesh.normals[:, 2] < 0)


def flattened(mesh):
    """The flat bottom of a hull, moved to the water surface, as a PanelMesh.

    raises : ValueError if the waterplane is not as large as the bottom, because only vertical sides may be neglected
    """
    chosen = bottom(mesh)
    area, waterplane = mesh.areas[chosen].sum(), -mesh.area_vectors[:, 2].sum()
    if not abs(area - waterplane) <= 1e-6 * waterplane:
        raise ValueError(
            f"zero draft needs vertical sides and a flat bottom: the bottom has {mesh.copies * area:.6g} m², and "
            f"the waterplane {mesh.copies * waterplane:.6g} m²; the panel method takes any shape"
        )
    return replace(mesh, points=mesh.points * (1, 1, 0), corners=mesh.corners[chosen])


class ZeroDraftRun(PanelRun):
    """The panel method with the plate's equation in place of the hull's."""

    def equations(self, classes, table, velocities):
        n = self.geometry.hull
        nothing = [np.zeros((1, 0))] * len(classes)
        found = assembled(self.geometry, classes, 1.0, table, self.depth_values, nothing, hull=0)
        sides = np.zeros((len(classes), n, max(map(len, velocities))), complex)
        for side, velocity in zip(sides, velocities, strict=True):
            side[:, : len(velocity)] = -4 * np.pi * velocity.T  # the normal points down
        return found._replace(sides=sides)

    def on_hull(self, solution, velocities):
        K = self.omega**2 / self.problem.gravity
        return np.ascontiguousarray((-velocities - solution.T) / K)

    def pressure(self):
        """Pressure as from `PanelRun.pressure` on the bottom; zero on the sides, which have no height."""
        mesh, plate = self.problem.mesh, bottom(self.problem.mesh)
        out = np.zeros((len(self.headings), self.geometry.copies, len(mesh)), complex)
        out[..., plate] = super().pressure().reshape(len(self.headings), self.geometry.copies, -1)
        return out.reshape(len(self.headings), -1)


def rigid_surface_limit(prepared, which):
    """Added mass (6, 6) about the rotation centre for ω → 0, kg, kg m, kg m², with 4πφ = ∬ w G dS under a rigid
    surface.

    raises : ValueError for ω → ∞, where the equation has no limit
    """
    if which != "zero":
        raise ValueError(
            "a body of zero draft has no added mass at infinite frequency; give a small draft and use the panel method"
        )
    g, problem = prepared.geometry, prepared.problem
    table = limit_table(which, problem.depth, g.reach, g.draft)
    velocities = [g.modes[:, g.members(c)].T.astype(complex) for c in g.classes]
    with blas_threads(len(g.elements.nodes)):
        sides = assembled(g, g.classes, 1.0, table, unit_depth_values, velocities).sides
    potentials = [side.real[:, : len(v)].T / (4 * np.pi) for side, v in zip(sides, velocities, strict=True)]
    return added_mass_of(prepared, potentials, which)
