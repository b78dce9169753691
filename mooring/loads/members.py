"""Drag of the wind on single members of a structure.

    F = ½ρ C_d U(z)² A    SR179 report (1982), chapter 4, section 5.2 and table 2

A is the area projected along the wind, U(z) the wind at the height of its centre.  Shielding is neglected.
"""

from typing import NamedTuple

import numpy as np

from ..environment.wind_profile import speed_at
from .box_wind import AIR_DENSITY

C_D = {
    "sphere": 0.4,
    "cylinder": 0.5,
    "hull side": 1.0,
    "deck house": 1.0,
    "isolated member": 1.5,  # cranes, sections, beams
    "underside, smooth": 1.0,
    "underside, exposed beams": 1.3,
    "derrick, each face": 1.25,
}


class Member(NamedTuple):
    """shape : key of C_D, or a drag coefficient; area : m², projected along the wind; position : (x, y, z) m, centre"""

    shape: str | float
    area: float
    position: tuple[float, float, float]


def wind_on_members(members, speed_10, direction, exponent=None, density=AIR_DENSITY):
    """Force and moment, N and N m, about the origin, z = 0 at the waterline, of wind towards `direction`, rad, on
    Members; shape (6,).

    speed_10 : m/s at 10 m; exponent : exponent of the power law over height, by default the report's table
    raises : ValueError naming the member whose shape or area is impossible
    """
    if not 0 < density < np.inf:
        raise ValueError(f"density is {density:g} kg/m³; allowed: above 0")
    blown = np.array([np.cos(direction), np.sin(direction), 0.0])
    total = np.zeros(6)
    for i, member in enumerate(members):
        coefficient = _checked(f"wind member {i}", member)
        speed = float(speed_at(member.position[2], speed_10, exponent))
        force = 0.5 * density * coefficient * speed**2 * member.area * blown
        total += np.concatenate([force, np.cross(member.position, force)])
    return total


def _checked(where, member):
    """Drag coefficient of a member.  Raises ValueError for an impossible one."""
    if isinstance(member.shape, str) and member.shape not in C_D:
        raise ValueError(f"{where}: shape is {member.shape!r}; allowed: {', '.join(C_D)}, or a drag coefficient")
    coefficient = C_D[member.shape] if isinstance(member.shape, str) else member.shape
    if not 0 <= coefficient < np.inf:
        raise ValueError(f"{where}: drag coefficient is {coefficient:g}; allowed: at least 0")
    if not 0 < member.area < np.inf:
        raise ValueError(f"{where}: area is {member.area:g} m²; allowed: above 0")
    return coefficient
