"""What a line is made of, as a table of a study."""

from __future__ import annotations

import math

from .quantities import StudyError, Table, force, one_of
from .units import KGF


class LineType(Table):
    """Submerged weight, axial stiffness EA and breaking load, each in one of its units; EA left out: inextensible

    catalogue : a name such as "R3 studless 76 mm", for what is not given
    """

    catalogue: str | None = None
    weight_kg_per_m: float | None = None
    weight_N_per_m: float | None = None
    axial_stiffness_tonf: float | None = None
    axial_stiffness_kN: float | None = None
    breaking_load_tonf: float | None = None
    breaking_load_kN: float | None = None
    bed_friction: float = 0.0


def line_properties(where, kind, density=1025.0):
    """weight, axial_stiffness, bed_friction and breaking_load of a LineType, in SI; density : kg/m³ of the water"""
    from mooring.lines.catalogue import line_type

    try:
        known = None if kind.catalogue is None else line_type(kind.catalogue, density)
    except ValueError as error:
        raise StudyError(f"{where}.catalogue: {error}") from None
    weight = one_of(where, kind, {"weight_kg_per_m": KGF, "weight_N_per_m": 1.0}, required=known is None)
    if not (kind.bed_friction >= 0 and math.isfinite(kind.bed_friction)):
        raise StudyError(f"{where}.bed_friction is {kind.bed_friction:g}; allowed: at least 0")
    return {
        "weight": weight or known.weight,
        "axial_stiffness": force(where, kind, "axial_stiffness") or (known.axial_stiffness if known else math.inf),
        "bed_friction": kind.bed_friction,
        "breaking_load": force(where, kind, "breaking_load") or (known.breaking_load if known else math.inf),
    }
