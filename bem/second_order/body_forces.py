"""Force of the second-order potential that the moving hull generates in the first-order flow, by the indirect method.

On the mean position of the hull, with u = ∇φ, displacement X, velocity V = ∂X/∂t and rotation α of first order,

    ∂φ₂/∂n = −n·(X·∇)u + (α × n)·(V − u) + ∂(Hx)/∂t·n = n·∇×(X × u) + (α × n)·V + ∂(Hx)/∂t·n

(H: `rotations`).  With ψ the radiation potential of unit velocity at the frequency Ω of the force, the force is −iρΩ
∬ ψ ∂φ₂/∂n dS (Haskind; Molin 1979). Stokes's theorem eliminates second derivatives from this integral:

    ∬ ψ n·∇×(X × u) dS = ∮ ψ {(X·n) u_z − X_z (u·n)} dl − ∬ {(X·n) ∇ψ·u − (u·n) ∇ψ·X} dS,        u·n = V·n.

Products of wave pairs have T as defined in `bem.panels.pressure_drift.mean_drift`.  The forcing of the free surface by
products of first-order waves is not included.
"""

import numpy as np

from ..panels.pressure_drift.hull_flow import unit_displacements
from ..panels.pressure_drift.mean_drift import carried_flow
from .kinds import DIFFERENCE
from .rotations import turned_twice


def body_forces(surfaces, flow, one, two, radiated, problem, kind=DIFFERENCE):
    """Transfer functions T about the origin, N/m² and N m/m², for pairs (one, two) of waves of a `HullFlow`; shape
    (q, 6).

    one, two : indices of waves, (q,); all pairs have the same difference of frequencies, or the same sum, by
    `kinds.Kind`
    radiated : flow of the six motions of unit velocity at this difference or sum (`hull_flow.radiated_flow`)
    """
    omega, second = radiated.omega[0], kind.second
    of_second = 0 if kind.sign > 0 else 1  # row of `linear`: the flow itself, or its conjugate
    X, V = flow.motion, -1j * flow.omega[:, None] * flow.motion
    linear, used = np.zeros((len(X), 2, 6, 6), complex), np.unique(np.concatenate([one, two]))
    linear[used] = _of_flow(surfaces, flow, used, radiated, problem.gravity)
    square = _of_motions(surfaces, radiated)
    out = np.einsum("qm,qkm->qk", X[one], linear[two, of_second])
    out += np.einsum("qm,qkm->qk", second(X[two]), linear[one, 0])
    out += np.einsum("qm,kmv,qv->qk", X[one], square, second(V[two]))
    out += np.einsum("qm,kmv,qv->qk", second(X[two]), square, V[one])
    strain = (radiated.on_hull @ surfaces.strained).reshape(6, 3, 3)
    level = radiated.on_hull @ (surfaces.hull.normals * surfaces.hull.weights[:, None])
    strain -= level[..., None] * np.asarray(problem.rotation_center)
    H = np.array([turned_twice(X[[i, j]], second)[0, 1] for i, j in zip(one, two, strict=True)])
    out = 0.25 * out - 1j * omega * np.einsum("qab,kab->qk", H, strain)
    return -1j * problem.density * omega * out


def _of_flow(surfaces, flow, used, radiated, gravity):
    """Integrals ∮ ψ_k n_m u_z dl − ∬ n_m ∇ψ_k·u dS of the flow of the waves `used`, and with its conjugate; shape (u,
    2, 6, 6)"""
    line, weighted = surfaces.waterline, surfaces.weighted_modes
    steep = (flow.omega[used] ** 2 / gravity)[:, None] * flow.potential[used]
    edge = (radiated.potential[:, None] * (surfaces.waterline_modes * line.weights[:, None]).T).reshape(36, -1)
    out = np.stack([(edge @ z.T).T.reshape(-1, 6, 6) for z in (steep.real, steep.imag)])
    slope = radiated.velocity.reshape(6, -1)[:, : weighted.shape[1]]  # on the meshed part; symmetry gives the rest
    slope = np.ascontiguousarray(slope.real), np.ascontiguousarray(slope.imag)
    for (k, m), parts in zip(surfaces.hull.products, flow.parts, strict=True):
        rows = np.concatenate([part[k] * weighted[m] for part in slope])
        for n, u in enumerate(parts):
            real, imaginary = np.split(rows @ (u if len(used) == len(u) else u[used]).T, 2)
            out[n][:, k, m] -= (real + 1j * imaginary).T
    real, imaginary = out
    return np.stack([real + 1j * imaginary, real - 1j * imaginary], axis=1)


def _of_motions(surfaces, radiated):
    """Integrals ∬ n_v ∇ψ·e_m + ψ (α_m × n)·e_v dS − ∮ ψ e_m·k n_v dl of mode k, displacement m and velocity v; shape
    (6, 6, 6)"""
    line = surfaces.waterline
    out = carried_flow(surfaces, radiated)
    out[:, 3:] += (radiated.on_hull @ surfaces.turned).reshape(6, 3, 6)
    rise = unit_displacements(line.points)[..., 2]
    weighted = radiated.potential * line.weights
    out -= np.einsum("kl,mlv->kmv", weighted, rise[..., None] * surfaces.waterline_modes)
    return out
