"""Mass and restoring of motions u_i(x), rigid ones and shapes alike.

    M_ij = ∫ u_i·u_j dm,      C_ij = −ρg ∬ (w_i + z ∇·u_i) u_j·n dS + g ∫ (u_j·∇) w_i dm

n out of the body, w the vertical part of u (J. N. Newman, Wave effects on deformable bodies, Applied Ocean Research 16,
1994).  z ∇·u is of a wetted surface that deforms, the last term of weight; of rigid motions C is the classical matrix.
Water and weight of a section need not balance: the still-water stress that carries the rest has a stiffness of its own,
which is not here, and without which C is not quite symmetric.
"""

from __future__ import annotations

import numpy as np

STEP = 1e-5  # of the size of the body, of differences: 1e-10 of a gradient by rounding, less by the third derivative


def gradients(displacement, points, size):
    """(q, 3, 3) ∂u_a/∂x_b of a function of points (q, 3) m; size : m, of the body"""
    step = STEP * size
    sides = [(displacement(points + d) - displacement(points - d)) / (2 * step) for d in step * np.eye(3)]
    return np.stack(sides, axis=-1)


def inertia(displacements, masses):
    """(m, m) kg, of displacements (m, p, 3) at points of mass (p,) kg"""
    return np.einsum("ipa,jpa,p->ij", displacements, displacements, masses)


def of_weight(displacements, slopes, masses, gravity):
    """(m, m) N/m; displacements (m, p, 3) and gradients (m, p, 3, 3) at points of mass (p,) kg"""
    return gravity * np.einsum("ipb,jpb,p->ij", slopes[:, :, 2], displacements, masses)


def of_water(displacements, slopes, depths, area_vectors, density, gravity):
    """(m, m) N/m; displacements (m, q, 3) and gradients (m, q, 3, 3) at points of the hull z (q,) m

    area_vectors : (q, 3) m², out of the body
    """
    rise = displacements[:, :, 2] + depths * np.einsum("iqaa->iq", slopes)
    return -density * gravity * rise @ np.einsum("jqa,qa->qj", displacements, area_vectors)
