"""Steady current force on a box.

SR179 report (1982), tables 2.2.3.2 and 2.2.3.5: tank tests of a fixed box with L/B = 2 in uniform current, C_x on
B d, C_y on L d, for B/d = 5 … 20 and depth over draft H/d = 1.2, 1.6 and deep (the tank, 1.8 beams deep).  The
moment is not tabulated; the report's text gives the lever 0.09 (sin 2χ)^1.2 of the length.
Two printed values look low beside their neighbours (C_y at B/d = 15, H/d = 1.6, 15°; B/d = 10, deep, 30°).
"""

from __future__ import annotations

import numpy as np

from .box_drag import DragTable, box_drag, check_positive

ANGLES = np.deg2rad([0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0])
BEAM_OVER_DRAFT = np.array([5.0, 10.0, 15.0, 20.0])
TANK_DEPTH_OVER_BEAM = 1.8

# rows: B/d; in each: H/d = 1.2, 1.6, deep; columns: angles
C_X = np.array(
    [
        [
            [1.42, 1.47, 1.67, 1.65, 1.18, 0.45, 0.00],
            [1.25, 1.30, 1.40, 1.35, 0.80, 0.33, 0.00],
            [0.92, 0.91, 0.91, 0.77, 0.57, 0.29, 0.00],
        ],
        [
            [1.76, 2.00, 2.43, 2.33, 1.55, 0.55, 0.00],
            [1.36, 1.41, 1.59, 1.63, 1.12, 0.43, 0.00],
            [0.93, 0.91, 0.89, 0.75, 0.55, 0.28, 0.00],
        ],
        [
            [1.37, 1.40, 1.50, 1.47, 1.02, 0.40, 0.00],
            [1.81, 1.88, 2.11, 2.17, 1.57, 0.60, 0.00],
            [0.94, 0.92, 0.87, 0.72, 0.51, 0.26, 0.00],
        ],
        [
            [1.13, 1.15, 1.20, 1.12, 0.76, 0.31, 0.00],
            [1.39, 1.44, 1.63, 1.65, 1.17, 0.47, 0.00],
            [0.95, 0.92, 0.85, 0.69, 0.49, 0.25, 0.00],
        ],
    ]
)
C_Y = np.array(
    [
        [
            [0.00, 0.18, 0.83, 1.33, 1.49, 1.50, 1.47],
            [0.00, 0.28, 0.69, 0.97, 1.13, 1.21, 1.24],
            [0.00, 0.15, 0.40, 0.60, 0.75, 0.83, 0.88],
        ],
        [
            [0.00, 0.24, 1.12, 2.02, 2.18, 2.22, 2.22],
            [0.00, 0.31, 0.80, 1.19, 1.40, 1.50, 1.57],
            [0.00, 0.13, 0.25, 0.55, 0.69, 0.76, 0.80],
        ],
        [
            [0.00, 0.21, 1.01, 1.73, 1.94, 1.97, 1.97],
            [0.00, 0.32, 1.20, 1.80, 2.08, 2.22, 2.31],
            [0.00, 0.12, 0.31, 0.50, 0.64, 0.72, 0.77],
        ],
        [
            [0.00, 0.19, 0.89, 1.46, 1.62, 1.62, 1.59],
            [0.00, 0.34, 0.89, 1.30, 1.52, 1.64, 1.70],
            [0.00, 0.11, 0.28, 0.46, 0.60, 0.68, 0.74],
        ],
    ]
)


def box_table(length, beam, draft, depth):
    """DragTable of a box with L/B = 2, linear in B/d and in d/H between the tests.

    d/H runs from 1/1.2 to that of the tank; a deeper sea is taken as deep as the tank.
    raises : ValueError outside the tests, where coefficients have to be given
    """
    check_positive(length=length, beam=beam, draft=draft, depth=depth)
    slender, wide, relative = length / beam, beam / draft, depth / draft
    for name, value, low, high in (
        ("L/B", slender, 1.95, 2.05),
        ("B/d", wide, 5.0, 20.0),
        ("H/d", relative, 1.2, np.inf),
    ):
        if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
            raise ValueError(
                f"{name} = {value:.4g} is outside the current force tests ({low:g} to {high:g}); "
                "give current coefficients"
            )
    i = int(np.clip(np.searchsorted(BEAM_OVER_DRAFT, wide) - 1, 0, 2))
    share = np.clip((wide - BEAM_OVER_DRAFT[i]) / 5.0, 0.0, 1.0)
    deep = 1 / (TANK_DEPTH_OVER_BEAM * wide)
    shallowness = np.array([deep, 1 / 1.6, 1 / 1.2])

    def at(table):
        rows = (1 - share) * table[i] + share * table[i + 1]
        return [np.interp(1 / relative, shallowness, column[::-1]) for column in rows.T]

    return DragTable(ANGLES, np.array(at(C_X)), np.array(at(C_Y)), 0.09 * np.maximum(np.sin(2 * ANGLES), 0.0) ** 1.2)


def current_force(speed, direction, length, beam, draft, density=1025.0, table=None, depth=np.inf):
    """(3,) F_x, F_y in N and M_z in N m about the middle of the box.

    speed : m/s; direction : rad, the current flows to
    table : DragTable; without it that of `box_table` at the water depth `depth`
    """
    check_positive(length=length, beam=beam, draft=draft, density=density)
    if not 0 <= speed < np.inf:
        raise ValueError(f"current speed is {speed:g} m/s; allowed: at least 0")
    table = box_table(length, beam, draft, depth) if table is None else table
    return box_drag(direction, 0.5 * density * speed**2, beam * draft, length * draft, length, table)
