"""Steady wind force on the part of a box above water.

SR179 report (1982), table 3.6.1.1 and eq. 3.6.6: C_x on B(D−d), C_y on L(D−d), lever a/L.  The report gives the
direction χ the wind comes from, 0 ahead; here it is the direction blown to, which changes no acute angle.
"""

from __future__ import annotations

import numpy as np

from .box_drag import DragTable, box_drag, check_positive

AIR_DENSITY = 1.226  # kg/m³, 0.125e-3 tf s²/m⁴ in the report

BOX = DragTable(
    np.deg2rad([0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]),
    np.array([1.0, 0.98, 0.91, 0.75, 0.54, 0.28, 0.0]),
    np.array([0.0, 0.17, 0.42, 0.64, 0.81, 0.93, 1.0]),
    np.array([0.0, 0.039, 0.076, 0.09, 0.076, 0.039, 0.0]),
)


def wind_force(speed, direction, length, beam, freeboard, density=AIR_DENSITY, table=BOX):
    """(3,) F_x, F_y in N and M_z in N m about the middle of the box.

    speed : m/s; direction : rad, the wind blows to; freeboard : D − d, m
    """
    check_positive(length=length, beam=beam, freeboard=freeboard, density=density)
    if not 0 <= speed < np.inf:
        raise ValueError(f"wind speed is {speed:g} m/s; allowed: at least 0")
    return box_drag(direction, 0.5 * density * speed**2, beam * freeboard, length * freeboard, length, table)
