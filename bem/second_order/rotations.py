"""Second-order loads on a rotating body: first-order loads that turn with the body, and loads of still water.

    T_ij = ¼ {αᵢ × F̄ⱼ + ᾱⱼ × Fᵢ},    moments  ¼ {αᵢ × M̄ⱼ + X_cᵢ × F̄ⱼ + conjugates with i and j exchanged}

F and M are the first-order load of water and weight about the rotation centre, X_c is the displacement of the
rotation centre, and α are the rotations.  A finite rotation of vector α is I + [α] + H, H = ½(αα' − α²I).  In still
water a finite rotation causes the additional loads

    heave −ρg ∬ (Hx)_z dA,    roll, pitch −ρg ∬ (Hx)_z (y, −x) dA − ½ w α_z (α_y, −α_x),

with integrals over the waterplane, x from the rotation centre, and w = C_44 − ρg ∬ y² dA the moment of weight and
buoyancy.  In surge, sway and yaw there is no additional load.
"""

import numpy as np

from ..panels.pressure_drift.turned_loads import products


def first_order_loads(run, problem, X):
    """First-order load of water and weight in the waves of a run, about the rotation centre; shape (m, 6)

    problem : problem whose stiffness is that of water and weight alone; in the run, lines may also restrain the body
    X : motions, (m, 6)
    """
    T, stiffness = problem.transform, problem.hydrostatic_stiffness
    return run.excitation @ T.T + X @ (run.omega**2 * T @ run.radiation @ T.T - stiffness).T


def turned_twice(motion, second=np.conj):
    """Transfer function T of H = ½(αα' − α²I) for motions (f, 6); shape (f, f, 3, 3)"""
    turns = products(motion[:, 3:], motion[:, 3:], second)
    return 0.5 * (turns - np.trace(turns, axis1=2, axis2=3)[..., None, None] * np.eye(3))


def still_water_pairs(motion, surface, center, roll_stiffness, weight, second=np.conj, axes=None):
    """Transfer function T of the load of still water on a body with finite rotations, about the rotation centre; shape
    (f, f, 6).

    motion : motions, (f, 6); surface : `hull_flow.Surface` of the hull; center : rotation centre, m, (3,)
    roll_stiffness : C_44, N m; weight : specific weight of water, N/m³; axes : axes of the body in columns, (3, 3)
    """
    x = surface.points - np.asarray(center)
    x = x if axes is None else x @ axes
    area = -surface.normals[:, 2] * surface.weights  # area of the waterplane above each point
    x[:, 2] = -center[2]
    H = turned_twice(motion, second)
    lever = np.stack([np.ones(len(x)), x[:, 1], -x[:, 0]])
    out = np.zeros((*H.shape[:2], 6), complex)
    out[..., 2:5] = -weight * H[..., 2, :] @ ((lever * area) @ x).T
    w = roll_stiffness - weight * area @ x[:, 1] ** 2
    out[..., 3] -= w * H[..., 1, 2]  # H_yz = ½ α_y α_z
    out[..., 4] += w * H[..., 0, 2]
    return out
