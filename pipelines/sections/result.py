"""`hakobune.sections`: sectional coefficients of rectangles over B/d, H/d and ξ_B."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence

import numpy as np

from hakobune.bem.sections.tables import BEAM_DRAFT, COLUMNS, DEPTH_DRAFT, FIXED, SHAPE_COLUMNS, XI, tables

from ..common.bounds import Pace, check_memory
from ..results.given import File, Tables
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from .study import SectionsStudy

NOTES = (
    "Rectangle of beam B and draft d in water of depth H, two-dimensional, ideal fluid; matched eigenfunctions",
    "Definitions: SR179 report (1982), section 2.1.3; the table of the report is named for shapes that it covers",
    "Axes: y to the right, z up, roll from y to z about the middle of the waterline; waves towards +y",
    "Force = |E| cos(omega t - eps) per unit amplitude, eps in degrees, 0 when the crest passes y = 0",
    "xi_B = (omega^2/g)(B/2), S = B d; M_H, M_S: M/(rho S); M_R: M/(rho S (B/2)^2); M_SR: M/(rho S (B/2))",
    "N likewise and over omega; E_H, E_S: |E|/(rho g (B/2)); E_R: |E|/(rho g (B/2)^2)",
    "Of the fixed body: waves reflected and transmitted per unit amplitude; drift: mean sway force/(rho g a^2/2)",
)
BYTES = 2000  # bytes per row
LARGEST = sys.float_info.max
ALLOWED = {  # lower limit, upper limit and words of each axis
    "beam_draft": (0, LARGEST, "above 0, finite"),
    "depth_draft": (1, math.inf, "above 1, or inf"),
    "xi": (0, LARGEST, "above 0, finite"),
}
WORDS = {"M": "added mass", "N": "damping", "E": "wave force", "eps": "phase of the wave force"}
FIXED_WORDS = {
    "reflected": "reflection of the fixed body",
    "transmitted": "transmission past the fixed body",
    "drift": "mean sway force on the fixed body",
}
MOTIONS = {"H": "heave", "S": "sway", "R": "roll", "SR": "sway and roll"}


def sections(
    study: File | Tables | SectionsStudy | None = None,
    /,
    *,
    beam_draft: Sequence[float] = BEAM_DRAFT,
    depth_draft: Sequence[float] = DEPTH_DRAFT,
    xi: Sequence[float] = XI,
    tolerance: float = 1e-6,
) -> Result:
    """Added mass, damping and excitation of rectangular sections, as in the SR179 report's Tables 2.1.3.1 to 2.1.3.20.

    A study describes sections side by side in beam waves, free or held together by hinges.

    study : path of a study of sections side by side, its tables as a dictionary, or a `study.SectionsStudy`; without
        a study a table of rectangles is computed:
    beam_draft : B/d; depth_draft : H/d, above 1, or inf; xi : ξ_B = ω²B/2g; tolerance : relative error
    returns : Result, without units as in the report; its `detail` has the rows of `bem.sections.tables.tables`
    raises : ValueError, with a message of one line
    """
    if study is not None:
        from .side_by_side import side_by_side

        return side_by_side(study)
    grid = {"beam_draft": beam_draft, "depth_draft": depth_draft, "xi": xi}
    for name, values in grid.items():
        low, largest, allowed = ALLOWED[name]
        wrong = [value for value in values if not low < value <= largest]
        if wrong:
            raise ValueError(f"{name.replace('_', '-')} is {wrong[0]:g}; allowed: {allowed}")
    count, way_out = math.prod(map(len, grid.values())), "give fewer values of beam-draft, depth-draft or xi"
    check_memory(f"{count} sections need", BYTES * count, way_out)
    rows = tables(beam_draft, depth_draft, xi, tolerance, Pace(f"{count} sections take", count, way_out).step)
    axes = dict(zip(SHAPE_COLUMNS, (depth_draft, beam_draft, xi), strict=True))
    found = {}
    for name in COLUMNS[len(SHAPE_COLUMNS) :]:
        values = np.reshape([row[name] for row in rows], [len(axis) for axis in axes.values()])
        if name in FIXED:
            found[name] = values, "", FIXED_WORDS[name]
            continue
        kind, motion, *degrees = name.split("_")
        values, unit = (np.radians(values), "rad") if degrees else (values, "")
        found[f"{kind}_{motion}"] = values, unit, f"{WORDS[kind]}, {MOTIONS[motion]}"
    made = {axis: labels(axis, np.asarray(values, float))[axis] for axis, values in axes.items()}
    return Result("sections", quantities("", found, *SHAPE_COLUMNS), made, notes=NOTES,
                  provenance=provenance(tolerance=repr(tolerance)), detail=rows)  # fmt: skip
