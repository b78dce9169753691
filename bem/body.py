"""A floating body in water as every method sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .modes import reference_change


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """What all methods need besides the shape.

    depth : m, may be inf; density : kg/m³; gravity : m/s²; rotation_center : m
    inertia_matrix, hydrostatic_stiffness : (6, 6) about `rotation_center`; None leaves the body without motions
    viscous : `bem.viscous.Viscous` or None
    """

    depth: float = np.inf
    density: float = 1025.0
    gravity: float = 9.80665
    rotation_center: tuple = (0.0, 0.0, 0.0)
    inertia_matrix: np.ndarray | None = None
    hydrostatic_stiffness: np.ndarray | None = None
    viscous: object = None

    @property
    def transform(self):
        """(6, 6) from generalized normals about the origin to those about the rotation centre"""
        return reference_change(self.rotation_center)
