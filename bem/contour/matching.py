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


class Still(NamedTuple):
    """What no frequency changes in one class of n functions of the plan and d motions; m = e n, e profiles.

    beneath : (m, m) T between profiles; net : (m,) flux of the profiles, None in classes without any
    side : (d, 2n) velocity of the motions; driven : (m, d) potential of ψ beneath, tested with profiles
    carried : (d, m) ∬ φ n dS that velocity of the profiles gives along the motions; volume : (d,) that c gives
    own : (d, d) that ψ give
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


class Flow(NamedTuple):
    """Columns of velocity (e, n, columns) and c (columns,)."""

    velocity: np.ndarray
    constant: np.ndarray
    residual: float


def still(profiles, beneath, unit, motions, bottom):
    """`Still` of profiles with r = e + 2 rows, the last two those of ψ.

    beneath : (r, n, r, n) potentials tested with everything; unit : (n,) coefficients of 1 on the contour or None
    motions : `Motion` with a first axis of d; bottom : (d,) ∬ ψ w dA

    Under the body Green's identity turns the integral over the bottom into one over the profiles.
    """
    e, n, s = len(profiles.mean), beneath.shape[1], profiles.height
    m, d = e * n, len(bottom)
    matrix, slope = beneath.reshape(m + 2 * n, -1), motions.slope.reshape(d, 2 * n)
    tested = np.tensordot(motions.value, [profiles.mean, profiles.second_moment], ((1,), (0,)))
    tested = tested.transpose(0, 2, 1).reshape(d, m)
    squares = np.array([[s, s**3 / 3], [s**3 / 3, s**5 / 5]])  # ∫ of 1, ζ² and ζ⁴
    own = slope @ (squares @ motions.value).reshape(d, 2 * n).T - slope @ matrix[m:, m:] @ slope.T - np.diag(bottom)
    net, volume = None, np.zeros(d)
    if unit is not None:
        net = np.multiply.outer(profiles.mean, unit).ravel()
        volume = profiles.mean_rows[e:] @ (motions.slope @ unit).T
    return Still(
        matrix[:m, :m], net, motions.side.reshape(d, 2 * n),
        matrix[:m, m:] @ slope.T - tested.T, slope @ matrix[m:, :m] - tested, volume, own,
    )  # fmt: skip


def solved(still, outside, drive):
    """`Flow` for the motions, then for potentials φ₀.

    outside : (r n, r n) potentials tested with everything, rows e profiles, then 1 and z of the side
    drive : (r n, b) φ₀ tested with everything
    """
    m = len(still.driven)
    matrix = still.beneath - outside[:m, :m]
    right = np.hstack([still.driven + outside[:m, m:] @ still.side.T, drive[:m]])
    if still.net is not None:
        matrix = np.block([[matrix, still.net[:, None]], [still.net, 0.0]])
        right = np.vstack([right, np.append(still.volume, np.zeros(drive.shape[1]))])
    x = np.linalg.solve(matrix, right)
    scale = np.maximum(np.abs(right).max(axis=0), 1e-300)
    residual = np.max(np.abs(matrix @ x - right) / scale, initial=0.0)
    constant = x[-1] if still.net is not None else np.zeros(right.shape[1])
    return Flow(x[:m].reshape(m // still.functions, still.functions, right.shape[1]), constant, float(residual))


def loads(still, outside, flow, drive):
    """∬ φ n dS along the motions of every column of `flow`, (d, columns); the other arguments as in `solved`"""
    m, d = still.driven.shape
    velocity = flow.velocity.reshape(m, -1)
    out = (still.side @ outside[m:, :m] + still.carried) @ velocity + np.outer(still.volume, flow.constant)
    out[:, :d] += still.side @ outside[m:, m:] @ still.side.T + still.own
    out[:, d:] += still.side @ drive[m:]
    return out
