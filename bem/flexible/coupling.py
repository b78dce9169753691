"""Mass and restoring of rigid motions and of shapes, from displacements u_i and their products u_ij.

    x = X + Σ ξ_i u_i(X) + ½ Σ ξ_i ξ_j u_ij(X),        M_ij = ∫ u_i·u_j dm
    C_ij = −ρg ∬ {(w_i + z ∇·u_i) u_j·n + z (u_ij − (u_j·∇) u_i)·n} dS + g ∫ w_ij dm

with n out of the body and w the vertical displacement. C are the second derivatives of the potential energy of water
and weight, so that C = Cᵀ.  The
first part is that of J. N. Newman (Wave effects on deformable bodies, Applied Ocean Research 16, 1994); the term z
∇·u is due to the deformation of the wetted surface.  For a rotation about e, u_ij = e × u_j and the second part is
zero; for rigid motions C is the classical matrix.
Beams provide their u_ij (`beams.second`): pressure on their ends compresses
them.  For shapes from files u_ij is unknown, and ½ {(u_j·∇) u_i + (u_i·∇) u_j} is used.
"""

import numpy as np

# finite-difference step over the size of the body: rounding gives 1e-10 of a gradient, the third derivative less
STEP = 1e-5


def gradients(displacement, points, size):
    """Gradients ∂u_a/∂x_b of a function of points (q, 3), m; shape (q, 3, 3); size : size of the body, m"""
    step = STEP * size
    sides = [(displacement(points + d) - displacement(points - d)) / (2 * step) for d in step * np.eye(3)]
    return np.stack(sides, axis=-1)


def inertia(displacements, masses):
    """Modal mass, kg, of displacements (m, p, 3) at points of mass (p,), kg; shape (m, m)"""
    return np.einsum("ipa,jpa,p->ij", displacements, displacements, masses)


def of_weight(displacements, slopes, masses, gravity, rigid, second=None):
    """Stiffness of the weight, N/m, for displacements (m, p, 3) and gradients (m, p, 3, 3) at points of mass (p,), kg;
    shape (m, m)

    rigid : number of rigid motions, which come first; second : u_ij of the f shapes, (f, f, p, 3), or None
    """
    out = np.einsum("ipb,jpb,p->ij", slopes[:, :, 2], displacements, masses)
    if second is not None:
        out[rigid:, rigid:] = second[..., 2] @ masses
    return gravity * _symmetric(out, rigid)


def of_water(displacements, slopes, depths, area_vectors, density, gravity, rigid, second=None):
    """Stiffness of the water, N/m, for displacements (m, q, 3) and gradients (m, q, 3, 3) at points of the hull at z
    (q,), m; shape (m, m)

    area_vectors : area vectors out of the body, m², (q, 3); rigid, second : as in `of_weight`
    """
    rise = displacements[:, :, 2] + depths * np.einsum("iqaa->iq", slopes)
    out = rise @ np.einsum("jqa,qa->qj", displacements, area_vectors)
    if second is not None:
        pressed, flexible = depths[:, None] * area_vectors, slice(rigid, None)
        carried = np.einsum("iqab,jqb,qa->ij", slopes[flexible], displacements[flexible], pressed)
        out[flexible, flexible] += np.einsum("ijqa,qa->ij", second, pressed) - carried
    return -density * gravity * _symmetric(out, rigid)


def _symmetric(matrix, rigid):
    """The matrix with its coupling of rigid motions to shapes copied from the transposed block, whose u_ij is known"""
    matrix[rigid:, :rigid] = matrix[:rigid, rigid:].T
    own = matrix[rigid:, rigid:]
    matrix[rigid:, rigid:] = 0.5 * (own + own.T)
    return matrix
