"""Water outside joined to water under a vertical-sided body, in one symmetry class of the plan.

The normal velocity u in the gap under the keel and v on the side, both away from the body, give

    outside   φ = φ₀ + Σ Zₙ N(kₙ) ⟨u + v, Zₙ⟩ / ⟨Zₙ, Zₙ⟩
    beneath   φ = ψ + c + Σ (ε_q / s) cos l_qζ T(l_q) ⟨u − ∂ψ/∂n, cos l_qζ⟩

on the contour, N and T the maps of the plan from velocity to potential.  u = Σ u_pj U_p(ζ) ψ_j(contour), U_p
the profiles of the gap; both sides are equal when tested with every U_p ψ_j.  c exists in the class with net flux
only, where it lets no volume accumulate.  φ₀ is the incident wave in front of a rigid wall, so that it drives no
velocity of its own.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .contour_profiles import Profiles


class System(NamedTuple):
    """Rows r = e + 2: the profiles of the gap, then those of the side (outside) or of ψ (beneath); n of the plan.

    outside, beneath : (r, n, r, n) potentials tested with everything
    unit : (n,) coefficients of 1 on the contour, None in classes without net flux
    """

    profiles: Profiles
    outside: np.ndarray
    beneath: np.ndarray
    unit: np.ndarray | None


class Flow(NamedTuple):
    """Columns of velocity (e, n, columns) and c (columns,)."""

    velocity: np.ndarray
    constant: np.ndarray
    residual: float


def solved(system, motions, drive):
    """`Flow` for `motions`, then for potentials φ₀ tested with every function, drive (e, n, b)."""
    e, n = drive.shape[:2]
    right = np.concatenate([_motion_sides(system, motions, e), drive], axis=2).reshape(e * n, -1)
    matrix = (system.beneath[:e, :, :e] - system.outside[:e, :, :e]).reshape(e * n, e * n)
    if system.unit is not None:
        net = np.multiply.outer(system.profiles.mean, system.unit).ravel()
        volume = [system.profiles.mean_rows[e:] @ m.slope @ system.unit for m in motions] + [0.0] * drive.shape[2]
        matrix = np.block([[matrix, net[:, None]], [net[None], np.zeros((1, 1))]])
        right = np.vstack([right, volume])
    x = np.linalg.solve(matrix, right)
    scale = np.maximum(np.abs(right).max(axis=0), 1e-300)
    residual = np.max(np.abs(matrix @ x - right) / scale, initial=0.0)
    constant = x[-1] if system.unit is not None else np.zeros(right.shape[1])
    return Flow(x[: e * n].reshape(e, n, -1), constant, float(residual))


def _motion_sides(system, motions, e):
    profiles, n = system.profiles, system.outside.shape[1]
    sides = np.empty((e, n, len(motions)), system.outside.dtype)
    for j, m in enumerate(motions):
        sides[..., j] = (
            np.tensordot(system.beneath[:e, :, e:], m.slope, 2)
            + np.tensordot(system.outside[:e, :, e:], m.side, 2)
            - np.multiply.outer(profiles.mean, m.value[0])
            - np.multiply.outer(profiles.second_moment, m.value[1])
        )
    return sides


def pressure_integrals(system, flow, motions, drive, along):
    """∬ φ n dS of every column of `flow` along one motion, m³/s · (unit of n), less ∬ ψ w dA of the column's own ψ.

    drive : (2, n, b) φ₀ tested with the side's rows; along : `Motion`

    Under the body Green's identity turns the integral over the bottom into one over the profiles.
    """
    profiles, (e, n, columns) = system.profiles, flow.velocity.shape
    outer, inner = np.zeros((2, e + 2, n, columns), complex)
    outer[:e] = inner[:e] = flow.velocity
    for j, m in enumerate(motions):
        outer[e:, :, j], inner[e:, :, j] = m.side, -m.slope
    side = np.tensordot(np.tensordot(along.side, system.outside[e:], 2), outer, 2)
    side[len(motions) :] += np.tensordot(along.side, drive, 2)
    through = np.tensordot(along.value, np.tensordot([profiles.mean, profiles.second_moment], flow.velocity, 1), 2)
    value = np.tensordot(np.tensordot(along.slope, system.beneath[e:], 2), inner, 2)
    if system.unit is not None:
        value += flow.constant * (profiles.mean_rows[e:] @ along.slope @ system.unit)
    value[: len(motions)] += [_product(m.value, along.slope, profiles.height) for m in motions]
    return side - (through - value)


def _product(p, q, s):
    """∬ (p₀ + p₁ζ²)(q₀ + q₁ζ²) over the gap"""
    return s * p[0] @ q[0] + s**3 / 3 * (p[0] @ q[1] + p[1] @ q[0]) + s**5 / 5 * p[1] @ q[1]
