"""Force of moving water on slender members, after Morison, O'Brien, Johnson and Schaaf (1950).

    f = ½ρ C_D D |w| w + ρ (V + A) a − ρ A a_b,   w = u − u_b,   V + A = C_M × reference volume

is the force per metre; all vectors are normal to the axis. u is the velocity of the water, waves and current
together, and a its acceleration; u_b, a_b are velocity and acceleration of the member. V is the displaced volume,
and A the volume of the added mass, per metre. SR179 report (1982), chapter 4, section 5.3 (there for a member at
rest). The drag uses one velocity for waves and current together, since |w| w is not additive.
"""

from functools import cache
from typing import NamedTuple

import numpy as np


class Section(NamedTuple):
    """width : D across the flow, m; C_D : drag coefficient, referred to D; displaced, added : V and A, m² (m³ per
    metre)
    """

    width: float
    C_D: float
    displaced: float
    added: float


def circular(diameter, C_D, C_M=2.0):
    """Section of a circular cylinder; C_M refers to π/4 D², in potential flow 2.  Raises ValueError."""
    return _solid(diameter, C_D, np.pi / 4 * diameter**2, C_M)


def square(side, C_D, C_M=2.19):
    """Section of a square prism moved along a side; C_M refers to D², in potential flow 2.19.  Raises ValueError."""
    return _solid(side, C_D, side**2, C_M)


def plate(width, C_D, C_M=1.0):
    """Section of a flat plate across the flow; C_M refers to π/4 D², in potential flow 1, all added mass."""
    _check(width, C_D, C_M, 0.0)
    return Section(width, C_D, 0.0, C_M * np.pi / 4 * width**2)


def force_per_metre(section, axis, velocity, acceleration, own_velocity=0.0, own_acceleration=0.0, density=1025.0):
    """Force per metre, N/m, on a member along `axis` (3,); shape (…, 3); velocity, acceleration : of the water, (…,
    3).

    own_velocity, own_acceleration : (…, 3) of the member
    """
    across = _normal(axis)
    w = (np.asarray(velocity, float) - own_velocity) @ across
    a, own = np.asarray(acceleration, float) @ across, (own_acceleration + np.zeros(3)) @ across
    drag = 0.5 * section.C_D * section.width * np.linalg.norm(w, axis=-1, keepdims=True) * w
    return density * (drag + (section.displaced + section.added) * a - section.added * own)


def member_force(section, start, end, flow, density=1025.0, points=8):
    """Force and moment about the origin, N and N m, on a straight member at rest; shape (6,).

    start, end : ends of the member, (3,) m; it is fully in the water

    flow : function of positions (n, 3) m that returns velocity and acceleration of the water, two (n, 3)
    points : points of Gauss quadrature; 8 are exact for polynomials of degree 15 along the member
    """
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.linalg.norm(end - start)
    if not 0 < length < np.inf:
        raise ValueError(f"member from {start} to {end} is {length:g} m long; allowed: above 0")
    x, weight = _gauss(points)
    places = start + 0.5 * (1 + x)[:, None] * (end - start)
    force = 0.5 * length * weight[:, None] * force_per_metre(section, end - start, *flow(places), density=density)
    return np.concatenate([force.sum(axis=0), np.cross(places, force).sum(axis=0)])


@cache
def _gauss(points):
    return np.polynomial.legendre.leggauss(points)


def _normal(axis):
    """Projector on the plane normal to an axis; shape (3, 3)"""
    axis = np.asarray(axis, float)
    size = np.linalg.norm(axis)
    if not 0 < size < np.inf:
        raise ValueError(f"axis of a member is {axis}; allowed: a vector with a direction")
    return np.eye(3) - np.outer(axis, axis) / size**2


def _solid(width, C_D, volume, C_M):
    _check(width, C_D, C_M, 1.0)
    return Section(width, C_D, volume, (C_M - 1) * volume)


def _check(width, C_D, C_M, least):
    if not 0 < width < np.inf:
        raise ValueError(f"width of a member is {width:g} m; allowed: above 0")
    for name, value, low in (("C_D", C_D, 0.0), ("C_M", C_M, least)):
        if not low <= value < np.inf:
            raise ValueError(f"{name} of a member is {value:g}; allowed: at least {low:g}")
