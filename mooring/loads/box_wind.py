"""Steady wind force on the part of a box above water.

SR179 report (1982), table 3.6.1.1 and eq. 3.6.6: C_x on B(D−d), C_y on L(D−d), lever a/L.  The report's direction χ
is that from which the wind comes, 0 from ahead. Here the direction is that towards which the wind blows; acute
angles to the axes are equal for both. Superstructures add their front and side areas a_f, a_s to those of the box
(chapter 4, section 5.2).
"""

import numpy as np

from .box_drag import DragTable, box_drag, check_positive, stream_pressure

AIR_DENSITY = 1.226  # kg/m³, 0.125e-3 tf s²/m⁴ in the report

BOX = DragTable(
    np.deg2rad([0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]),
    np.array([1.0, 0.98, 0.91, 0.75, 0.54, 0.28, 0.0]),
    np.array([0.0, 0.17, 0.42, 0.64, 0.81, 0.93, 1.0]),
    np.array([0.0, 0.039, 0.076, 0.09, 0.076, 0.039, 0.0]),
)


def wind_force(
    speed, direction, length, beam, freeboard, density=AIR_DENSITY, table=BOX, *, front_area=0.0, side_area=0.0
):
    """Forces F_x, F_y, N, and moment M_z, N m, about the middle of the box; shape (…, 3).

    speed : (…) m/s; direction : direction towards which the wind blows, (…) rad; freeboard : D − d, m
    front_area, side_area : areas of superstructures seen from ahead and from abeam, m²
    raises : ValueError for impossible sizes, speeds and densities
    """
    check_positive(length=length, beam=beam, freeboard=freeboard)
    for name, area in (("front area", front_area), ("side area", side_area)):
        if not 0 <= area < np.inf:
            raise ValueError(f"{name} of superstructures is {area:g} m²; allowed: at least 0")
    ends, sides = beam * freeboard + front_area, length * freeboard + side_area
    return box_drag(direction, stream_pressure("wind", speed, density), ends, sides, length, table)
