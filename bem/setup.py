"""A floating body in water, and the work on it that no frequency changes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from .influence import Geometry
from .modes import normal_velocities, reference_change


@dataclass(frozen=True, eq=False)
class Setup:
    """A floating body in water: everything a frequency needs except the frequency.

    mesh : hull panels; lid : interior free-surface panels or None
    coarse : (mesh, lid) of the same body with about half as many panels, for the error estimate; None does without
    depth : m, may be inf; nodes_per_panel : 4 (bilinear) or 1 (constant)
    inertia_matrix, hydrostatic_stiffness : (6, 6) about `rotation_center`; None leaves the body without motions
    """

    mesh: object
    lid: object = None
    coarse: tuple | None = None
    depth: float = np.inf
    density: float = 1025.0
    gravity: float = 9.80665
    rotation_center: tuple = (0.0, 0.0, 0.0)
    nodes_per_panel: int = 4
    inertia_matrix: np.ndarray | None = None
    hydrostatic_stiffness: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Prepared:
    """A setup with the work that depends on geometry only."""

    setup: Setup
    geometry: Geometry
    modes: np.ndarray = field(repr=False)
    coarse: Prepared | None = None

    @cached_property
    def displacing(self):
        """(6,) whether a mode moves water at all.

        Yaw of a round buoy does not, but for the corners of its polygon, nor does heave of a pile on the bed: a
        relative error of what they give says nothing.  A rotation counts if the mean square of its normal velocity
        is two per cent of that of its arms.
        """
        e, n = self.geometry.elements, self.geometry.hull
        w, (x, y, z) = e.weights[:n], e.nodes[:n].T
        arms = np.stack([np.ones(n)] * 3 + [y * y + z * z, z * z + x * x, x * x + y * y], axis=1)
        share = (w @ self.modes**2) / (w @ arms)
        return share > np.array([1e-6] * 3 + [0.02] * 3)

    @property
    def refinement(self):
        """How many panels the mesh has for one of the coarse mesh."""
        return self.setup.mesh.total / self.coarse.setup.mesh.total

    @property
    def transform(self):
        """(6, 6) from generalized normals about the origin to those about the rotation centre"""
        return reference_change(self.setup.rotation_center)


def prepare(setup):
    """The geometry-only part of a Setup; its exact 1/r integrals follow when the first frequency needs them."""
    geometry = Geometry(setup.mesh, setup.lid, setup.depth, setup.nodes_per_panel)
    e, n = geometry.elements, geometry.hull
    coarse = prepare(replace(setup, mesh=setup.coarse[0], lid=setup.coarse[1], coarse=None)) if setup.coarse else None
    return Prepared(setup, geometry, normal_velocities(e.nodes[:n], e.normals[:n]), coarse)
