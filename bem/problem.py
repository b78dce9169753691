"""Data of a radiation–diffraction problem for all methods: water, gravity, inertia and stiffness."""

from dataclasses import dataclass

import numpy as np

from .modes import moving, names_of, transform_of

SMALLEST_GAP = 3e-5  # smallest gap over draft; the number of modes grows as the gap shrinks, here to 10 s and 1.5 GB


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem:
    """A floating body, or several, in water; subclasses add the shape and the method's parameters.

    depth : m, may be inf; density : kg/m³; gravity : m/s²; rotation_center : m
    bodies : `bem.modes.Body` of each of several bodies; the motions of each are about its rotation centre. Empty for
        one body
    modes : `bem.modes.Mode` of each shape beyond the rigid motions
    inertia_matrix, hydrostatic_stiffness : matrices about `rotation_center`, (6, 6), for several bodies or with
        shapes (n, moving); None if motions are not computed. The stiffness includes that of the structure
    structural_damping : (n, moving), or None
    viscous : `bem.viscous.Viscous` or None
    tolerance : requested relative error
    """

    depth: float = np.inf
    density: float = 1025.0
    gravity: float = 9.80665
    rotation_center: tuple = (0.0, 0.0, 0.0)
    bodies: tuple = ()
    modes: tuple = ()
    inertia_matrix: np.ndarray | None = None
    hydrostatic_stiffness: np.ndarray | None = None
    structural_damping: np.ndarray | None = None
    viscous: object = None
    tolerance: float = 1e-2

    @property
    def transform(self):
        """Matrix from generalized normals about the origin to generalized normals about the rotation centre; shape
        (6, 6), for N bodies (6N, 6N)"""
        return transform_of(self.bodies, self.rotation_center, self.modes)

    @property
    def dofs(self):
        """Names of all forces; the names with indices `moving` are also those of the motions"""
        return names_of(self.bodies, self.modes)

    @property
    def moving(self):
        """Indices of the `dofs` of bodies that are not fixed"""
        return moving(self.bodies, self.modes)


def check_gap(draft, depth):
    """Raise ValueError if the gap under the keel is too thin to be resolved; draft, depth : m"""
    if depth - draft < SMALLEST_GAP * draft:
        raise ValueError(
            f"the gap under the keel (depth − draft) is {depth - draft:.3g} m; allowed: "
            f"{SMALLEST_GAP * draft:.3g} m or more ({SMALLEST_GAP:g} of the draft), since a smaller gap is not "
            "resolved"
        )
