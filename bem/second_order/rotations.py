"""Loads of second order on a body that turns: its first-order loads turned with it, and the still water's own part.

    T_ij = ¼ {αᵢ × F̄ⱼ + ᾱⱼ × Fᵢ},    moments  ¼ {αᵢ × M̄ⱼ + X_cᵢ × F̄ⱼ + conjugates with i and j exchanged}

F, M the first-order load of water and weight about the rotation centre, X_c its displacement, α the rotations.  A
finite rotation of vector α is I + [α] + H, H = ½(αα' − α²I).  In still water the body then has, beside these,

    heave −ρg ∬ (Hx)_z dA,    roll, pitch −ρg ∬ (Hx)_z (y, −x) dA − ½ w α_z (α_y, −α_x),

over the waterplane, x from the rotation centre, w = C_44 − ρg ∬ y² dA the moment of weight and buoyancy.  Surge, sway
and yaw have none.
"""

from __future__ import annotations

import numpy as np


def first_order_loads(run, problem, X):
    """(m, 6) first-order load of water and weight in the waves of a run, about the rotation centre

    problem : whose stiffness is that of water and weight alone, while lines may hold the body of the run too
    X : (m, 6) motions
    """
    T, stiffness = problem.transform, problem.hydrostatic_stiffness
    return run.excitation @ T.T + X @ (run.omega**2 * T @ run.radiation @ T.T - stiffness).T


def products(one, two, second=np.conj):
    """(f, f, …) T of the product of two quantities (f, a) and (f, b): ¼(aᵢ b̄ⱼ + āⱼ bᵢ), (f, f, a, b)

    second : as of `bem.panels.pressure_drift.mean_drift.pressure_pairs`, here and below
    """
    first = np.einsum("ia,jb->ijab", one, second(two))
    return 0.25 * (first + np.einsum("ja,ib->ijab", second(one), two))


def rotated_pairs(load, motion, second=np.conj):
    """(f, f, 6) T of loads (f, 6) that turn with the motions (f, 6), both about the rotation centre"""
    turned = products(motion, load, second)
    force = _cross(turned[..., 3:, :3])
    moment = _cross(turned[..., 3:, 3:]) + _cross(turned[..., :3, :3])
    return np.concatenate([force, moment], axis=-1)


def _cross(ab):
    """(…, 3) a × b of products (…, 3, 3)"""
    pairs = ((1, 2), (2, 0), (0, 1))
    return np.stack([ab[..., a, b] - ab[..., b, a] for a, b in pairs], axis=-1)


def turned_twice(motion, second=np.conj):
    """(f, f, 3, 3) T of H = ½(αα' − α²I), of motions (f, 6)"""
    turns = products(motion[:, 3:], motion[:, 3:], second)
    return 0.5 * (turns - np.trace(turns, axis1=2, axis2=3)[..., None, None] * np.eye(3))


def still_water_pairs(motion, problem, surface, second=np.conj):
    """(f, f, 6) T of the still water on a body of finite rotations, about the rotation centre.

    motion : (f, 6); problem : with its stiffness; surface : `hull_flow.Surface` of the hull
    """
    x = surface.points - np.asarray(problem.rotation_center)
    area = -surface.normals[:, 2] * surface.weights  # of the waterplane above each point
    x[:, 2] = -problem.rotation_center[2]
    H, weight = turned_twice(motion, second), problem.density * problem.gravity
    lever = np.stack([np.ones(len(x)), x[:, 1], -x[:, 0]])
    out = np.zeros((*H.shape[:2], 6), complex)
    out[..., 2:5] = -weight * H[..., 2, :] @ ((lever * area) @ x).T
    w = problem.hydrostatic_stiffness[3, 3] - weight * area @ x[:, 1] ** 2
    out[..., 3] -= w * H[..., 1, 2]  # H_yz = ½ α_y α_z
    out[..., 4] += w * H[..., 0, 2]
    return out
