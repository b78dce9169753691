"""Tables of sectional coefficients over B/d, H/d and ξ_B.

The SR179 report (1982) gives twenty tables, 2.1.3.1-20: one for each pair of H/d (outer order) and B/d (inner order),
with ten values of ξ_B in each table. The design guideline of the report interpolates the tables in B/d and H/d.
Here any shape is solved in milliseconds, without interpolation.
"""

import numpy as np

from .coefficients import TOLERANCE, frequency_of, report_row, section

BEAM_DRAFT = (5.0, 10.0, 15.0, 20.0)
DEPTH_DRAFT = (1.2, 1.4, 2.0, 3.0, 10.0)
XI = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 2.5, 3.0)
SHAPE_COLUMNS = ("H_over_d", "B_over_d", "xi_B")
IMPEDANCES = ("H", "S", "R", "SR")
FORCES = ("H", "S", "R")
FIXED = ("reflected", "transmitted", "drift")
COLUMNS = (
    *SHAPE_COLUMNS,
    *(f"{part}_{name}" for name in IMPEDANCES for part in "MN"),
    *(name for mode in FORCES for name in (f"E_{mode}", f"eps_{mode}_deg")),
    *FIXED,
)


def tables(beam_draft=BEAM_DRAFT, depth_draft=DEPTH_DRAFT, xi=XI, tolerance=TOLERANCE, progress=None):
    """Rows of all tables in the report's order: H/d, then B/d, then ξ_B; a list of dictionaries with `COLUMNS`.

    depth_draft may contain inf; progress : function called after each row; the order of rows allows an estimate of
    the remaining time
    Raises ValueError for a shape that cannot be solved to the tolerance.
    """
    shapes = [(B, H, x) for H in depth_draft for B in beam_draft for x in xi]
    rows = [{} for _ in shapes]
    for i in np.random.default_rng(0).permutation(len(shapes)):  # deep water takes a hundred times as long
        rows[i] = row_of(*shapes[i], tolerance)
        if progress is not None:
            progress()
    return rows


def row_of(beam_draft, depth_draft, xi, tolerance=TOLERANCE):
    """One row of a table, {column: number}"""
    if not 0 < xi < np.inf:
        raise ValueError(f"xi_B is {xi:g}; allowed: above 0 and finite")
    values = report_row(section(beam_draft, 1.0, depth_draft, frequency_of(xi, beam_draft), tolerance=tolerance))
    return values | {"H_over_d": depth_draft, "B_over_d": beam_draft, "xi_B": xi}


def table_name(row):
    """ "2.1.3.1" … "2.1.3.20" for the shapes of the report, "" for other shapes"""
    try:
        order = DEPTH_DRAFT.index(row["H_over_d"]) * len(BEAM_DRAFT) + BEAM_DRAFT.index(row["B_over_d"])
    except ValueError:
        return ""
    return f"2.1.3.{order + 1}"
