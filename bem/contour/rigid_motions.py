"""Boundary data of the rigid motions of a vertical-sided body on its plan contour, in the functions of the contour.

With unit velocity, ζ measured from the bed, s the height of the gap and w the vertical velocity of the bottom,

    side     ∂φ/∂n = n₁, n₂, 0, −z n₂, z n₁, x n₂ − y n₁                   surge … yaw
    bottom   w = 0, 0, 1, y, −x, 0

and under the keel a particular solution ψ, harmonic, at rest on the bed and moving with the bottom (SR179 report
(1982), eq. 2.1.5.25, has α = ½ in heave and ¼, ¾ in roll and pitch):

    heave  [ζ² − αx² − (1−α)y²] / 2s
    roll   [ζ²y − αx²y − (1−α)y³/3] / 2s        pitch  −[ζ²x − αx³/3 − (1−α)xy²] / 2s

Every α is admissible. The α of the plan keeps ψ small on a long body, where cancellation would lose digits.
"""

from typing import NamedTuple

import numpy as np

from .plan.maps import area_moment


class Motion(NamedTuple):
    """Coefficients of one rigid motion in the n functions of its class; for several motions with an additional first
    axis.

    side : a and b of the velocity a + b z on the side, (2, n)
    value, slope : a and b of ψ and of ∂ψ/∂n, each a + b ζ², (2, n)
    """

    side: np.ndarray
    value: np.ndarray
    slope: np.ndarray


def motion(dof, contour, basis, gap_height, alphas):
    """`Motion` of degree of freedom 0 … 5.

    basis : functions of the class at the nodes of the contour, (m, n); alphas : α in heave, roll and pitch
    """
    c, none = contour, 0 * contour.x
    value = slope = (none, none)
    if dof in (2, 3, 4):
        value, slope = _particular(dof, c, alphas[dof - 2])
    fields = (np.divide(value, 2 * gap_height), np.divide(slope, 2 * gap_height))
    return Motion(side(dof, c, basis), *(_projected(pair, c, basis) for pair in fields))


def side(dof, contour, basis):
    """`Motion.side` of a motion; shape (2, n); arguments as in `motion`"""
    c, none = contour, 0 * contour.x
    both = (
        (c.nx, none), (c.ny, none), (none, none), (none, -c.ny), (none, c.nx), (c.x * c.ny - c.y * c.nx, none)
    )[dof]  # fmt: skip
    return _projected(both, c, basis)


def _projected(pair, contour, basis):
    project = 4 * (basis * contour.weights[:, None]).T
    return np.array([project @ part for part in pair])


def _particular(dof, c, a):
    """2sψ and its normal derivative, each as factors of 1 and ζ²"""
    x, y, nx, ny, b = c.x, c.y, c.nx, c.ny, 1 - a
    square = a * x**2 + b * y**2
    if dof == 2:
        return (-square, 1 + 0 * x), (-2 * (a * x * nx + b * y * ny), 0 * x)
    if dof == 3:
        return (-(a * x**2 + b * y**2 / 3) * y, y), (-2 * a * x * y * nx - square * ny, ny)
    return ((a * x**2 / 3 + b * y**2) * x, -x), (square * nx + 2 * b * x * y * ny, -nx)


def bottom_integral(dof, contour, gap_height, alphas):
    """∬ ψ w dA over the bottom for one motion, m³ or m⁵"""
    if dof not in (2, 3, 4):
        return 0.0
    s, a = gap_height, alphas[dof - 2]
    b = 1 - a

    def m(i, j):
        return area_moment(contour, i, j)

    if dof == 2:
        return (s * s * m(0, 0) - a * m(2, 0) - b * m(0, 2)) / (2 * s)
    if dof == 3:
        return (s * s * m(0, 2) - a * m(2, 2) - b / 3 * m(0, 4)) / (2 * s)
    return (s * s * m(2, 0) - a / 3 * m(4, 0) - b * m(2, 2)) / (2 * s)
