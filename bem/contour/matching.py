"""Matching of the water outside and under a vertical-sided body by Galerkin's method, in one symmetry class of the
plan.

The normal velocity u in the gap under the keel and v on the side, both away from the body, give

    outside   φ = φ₀ + Σ Zₙ N(kₙ) ⟨u + v, Zₙ⟩ / ⟨Zₙ, Zₙ⟩
    beneath   φ = ψ + c + Σ (ε_q / s) cos l_qζ T(l_q) ⟨u − ∂ψ/∂n, cos l_qζ⟩

on the contour, N and T the Neumann-to-Dirichlet maps of the plan, from normal velocity to potential.  u = Σ u_pj U_p(ζ)
ψ_j(contour), U_p the profiles of the gap; both potentials are equal when tested with every U_p ψ_j.  The constant c,
the multiplier of the conservation of volume under the body, exists only in the class with net flux.
φ₀ is the incident wave with its reflection and diffraction by a rigid plan contour: the normal velocity of φ₀ is zero.
"""

from typing import NamedTuple

import numpy as np


class FixedTerms(NamedTuple):
    """Terms of one class that do not depend on frequency, for n functions of the plan, d motions, and m = e n with e
    profiles.

    beneath : T tested with profiles, (m, m); net : flux of the profiles, (m,), or None in classes without net flux
    side : velocity of the motions on the side, (d, 2n); driven : potential of ψ beneath, tested with profiles, (m, d)
    carried, volume, own : contributions to ∬ φ n dS along the motions by the profiles' velocity, (d, m), by c, (d,),
        and by ψ, (d, d)
    """

    beneath: np.ndarray
    net: np.ndarray | None
    side: np.ndarray
    driven: np.ndarray
    carried: np.ndarray
    volume: np.ndarray
    own: np.ndarray

    @property
    def functions(self):
        """n"""
        return self.side.shape[1] // 2


class GapVelocity(NamedTuple):
    """Solutions: velocity u in the gap, (e, n, columns), constants c, (columns,), and relative residual of the
    equations."""

    velocity: np.ndarray
    constant: np.ndarray
    residual: float


def fixed_terms(profiles, beneath, unit, motions, bottom):
    """`FixedTerms` from potentials under the body, in r = e + 2 rows: e rows of profiles and two rows of ψ.

    beneath : projections of the potentials of all rows, (r, n, r, n)
    unit : coefficients of the constant 1 on the contour, (n,), or None
    motions : `Motion` with a first axis of d; bottom : ∬ ψ w dA, (d,)

    Green's identity turns the integral over the bottom into an integral over the profiles in the gap.
    """
    e, n, s = len(profiles.mean), beneath.shape[1], profiles.height
    m, d = e * n, len(bottom)
    matrix, slope = beneath.reshape(m + 2 * n, -1), motions.slope.reshape(d, 2 * n)
    projected = np.tensordot(motions.value, [profiles.mean, profiles.second_moment], ((1,), (0,)))
    projected = projected.transpose(0, 2, 1).reshape(d, m)
    squares = np.array([[s, s**3 / 3], [s**3 / 3, s**5 / 5]])  # ∫ of 1, ζ² and ζ⁴
    own = slope @ (squares @ motions.value).reshape(d, 2 * n).T - slope @ matrix[m:, m:] @ slope.T - np.diag(bottom)
    net, volume = None, np.zeros(d)
    if unit is not None:
        net = np.multiply.outer(profiles.mean, unit).ravel()
        volume = profiles.mean_rows[e:] @ (motions.slope @ unit).T
    return FixedTerms(
        matrix[:m, :m], net, motions.side.reshape(d, 2 * n),
        matrix[:m, m:] @ slope.T - projected.T, slope @ matrix[m:, :m] - projected, volume, own,
    )  # fmt: skip


def solved(fixed_terms, outside, incident):
    """`Flow` for the motions, then for potentials φ₀.

    outside : potentials tested with all functions, (r n, r n), in rows of e profiles, then of 1 and z on the side
    incident : φ₀ tested with all functions, (r n, b)
    """
    m = len(fixed_terms.driven)
    matrix = fixed_terms.beneath - outside[:m, :m]
    right = np.hstack([fixed_terms.driven + outside[:m, m:] @ fixed_terms.side.T, incident[:m]])
    if fixed_terms.net is not None:
        matrix = np.block([[matrix, fixed_terms.net[:, None]], [fixed_terms.net, 0.0]])
        right = np.vstack([right, np.append(fixed_terms.volume, np.zeros(incident.shape[1]))])
    x = np.linalg.solve(matrix, right)
    scale = np.abs(right).max(axis=0, initial=1e-300)
    residual = np.max(np.abs(matrix @ x - right) / scale, initial=0.0)
    constant = x[-1] if fixed_terms.net is not None else np.zeros(right.shape[1])
    return GapVelocity(
        x[:m].reshape(m // fixed_terms.functions, fixed_terms.functions, right.shape[1]), constant, float(residual)
    )


def loads(fixed_terms, outside, flow, incident):
    """∬ φ n dS along the motions for every column of a `GapVelocity`; shape (d, columns); other arguments as in
    `solved`"""
    m, d = fixed_terms.driven.shape
    velocity = flow.velocity.reshape(m, flow.velocity.shape[-1])
    out = (fixed_terms.side @ outside[m:, :m] + fixed_terms.carried) @ velocity + np.outer(
        fixed_terms.volume, flow.constant
    )
    out[:, :d] += fixed_terms.side @ outside[m:, m:] @ fixed_terms.side.T + fixed_terms.own
    out[:, d:] += fixed_terms.side @ incident[m:]
    return out
