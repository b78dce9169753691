"""Parts of a line: uniform segments with constant stiffness or a tension table, and point loads."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Segment:
    """A uniform piece of line.

    length : unstretched length, m; weight : submerged weight, N/m, above 0
    axial_stiffness : EA, N, may be inf; or a table of (strain, tension) pairs, ascending from (0, 0), linear between
        and beyond its points
    diameter : m, breaking_load : N; for drawings and verdicts
    kind : `system.parts.LineType` with its mass and drag, None if unknown; elements : number of elements in a
        dynamic run, or None
    """

    length: float
    weight: float
    axial_stiffness: float | tuple = np.inf
    diameter: float = 0.0
    breaking_load: float = np.inf
    name: str = ""
    kind: Any = field(default=None, compare=False, repr=False)
    elements: int | None = field(default=None, compare=False)

    def __post_init__(self):
        for word, unit in (("length", "m"), ("weight", "N/m")):
            value = getattr(self, word)
            if not (np.isfinite(value) and value > 0):
                raise ValueError(f"segment {self.name}: {word} is {value:g} {unit}; allowed: finite, above 0")
        if not self.breaking_load > 0:
            raise ValueError(f"segment {self.name}: breaking_load is {self.breaking_load:g} N; allowed: above 0")
        _ = self.strain_table

    @property
    def strain_table(self):
        """Rows of a strain table: tension from which a row applies, and its λ and 1/EA in strain = λ − 1 + T/EA; shape
        (k, 3)."""
        stiffness = self.axial_stiffness
        if np.ndim(stiffness) == 0:
            if not stiffness > 0:
                raise ValueError(f"segment {self.name}: axial_stiffness is {stiffness:g} N; allowed: above 0, or inf")
            return np.array([[0.0, 1.0, 1.0 / stiffness]])
        table = np.asarray(stiffness, float)
        good = table.ndim == 2 and len(table) > 1 and table.shape[1] == 2 and np.all(np.isfinite(table))
        if not good or np.any(table[0] != 0) or np.any(np.diff(table[:, 0]) < 0) or np.any(np.diff(table[:, 1]) <= 0):
            raise ValueError(
                f"segment {self.name}: axial_stiffness is not a table of (strain, tension); "
                "allowed: at least two rows rising from (0, 0)"
            )
        strain, tension = table.T
        flexibility = np.diff(strain) / np.diff(tension)
        return np.column_stack([tension[:-1], 1 + strain[:-1] - flexibility * tension[:-1], flexibility])


@dataclass(frozen=True)
class PointLoad:
    """A sinker (weight > 0) or a buoy (weight < 0, its net buoyancy when submerged) at one point of a line.

    position : unstretched length from the anchor, m; weight : submerged weight, N
    weight_in_air : weight of a buoy out of the water, N, at least 0; the SR179 report (1982) takes 0
    drag_area : C_d A, m², and added_mass : added mass over the displaced mass; both only for lines in motion
    """

    position: float
    weight: float
    weight_in_air: float = 0.0
    name: str = field(default="")
    drag_area: float = field(default=0.0, compare=False)
    added_mass: float = field(default=0.5, compare=False)

    def __post_init__(self):
        if not np.isfinite(self.weight):
            raise ValueError(f"point load {self.name}: weight is {self.weight:g} N; allowed: finite")
        if not (np.isfinite(self.weight_in_air) and self.weight_in_air >= 0):
            raise ValueError(f"point load {self.name}: weight_in_air is {self.weight_in_air:g} N; allowed: at least 0")
