"""The water outside a vertical-sided body joined to the water under it, for one angular or parity mode.

With the horizontal velocity u(ζ) in the gap and v(z) on the side, both measured away from the body,

    outside   φ = φ₀ + Σ Rₙ Zₙ ⟨u + v, Zₙ⟩ / ⟨Zₙ, Zₙ⟩
    beneath   φ = ψ + c + Σ T_q cos l_qζ ⟨u − ψ', cos l_qζ⟩ ε_q / s

at the side.  Rₙ and T_q, potential over velocity, hold the plan geometry; ψ is any potential with the
bottom's velocity at the keel and none at the bed; the constant c exists in symmetric flow only and lets
no net volume accumulate.  Galerkin: both are equal when tested with every function of the gap.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Motion:
    """A motion with unit velocity: what it does at the side of the body.

    side : velocity a + b z of the side as (a, b)
    value, slope : ψ and its outward derivative at the side, a + b ζ² as (a, b)
    """

    side: tuple[float, float] = (0.0, 0.0)
    value: tuple[float, float] = (0.0, 0.0)
    slope: tuple[float, float] = (0.0, 0.0)


FIXED = Motion()


@dataclass(frozen=True)
class Flow:
    """u as coefficients (f,), c, the motion that makes the flow and φ₀ = drive · Z₀."""

    velocity: np.ndarray
    constant: complex
    motion: Motion
    drive: complex


@dataclass(frozen=True)
class TwoRegions:
    """gap : `Gap`; outside, beneath : its matrices for Rₙ and T_q; symmetric : whether c exists"""

    gap: object = field(repr=False)
    outside: np.ndarray = field(repr=False)
    beneath: np.ndarray = field(repr=False)
    symmetric: bool = False

    def flow(self, motion=FIXED, drive=0.0):
        """`Flow` of a body in `motion`, in outside potential `drive` · Z₀ where there is no flow through the side."""
        gap, f = self.gap, len(self.gap.mean)
        matrix = self.beneath[:f, :f] - self.outside[:f, :f]
        right = (
            self.beneath[:f, f:] @ motion.slope
            + self.outside[:f, f:] @ motion.side
            + drive * gap.wave_rows[:f]
            - np.column_stack([gap.mean, gap.second_moment]) @ motion.value
        )
        if not self.symmetric:
            return Flow(np.linalg.solve(matrix, right), 0.0, motion, drive)
        volume = gap.mean_rows[f:] @ motion.slope
        bordered = np.block([[matrix, gap.mean[:, None]], [gap.mean[None], np.zeros((1, 1))]])
        *u, c = np.linalg.solve(bordered, np.append(right, volume))
        return Flow(np.array(u), c, motion, drive)

    def wave(self, flow):
        """⟨u + v, Z₀⟩ / ⟨Z₀, Z₀⟩ : velocity of the propagating mode at the side"""
        return self.gap.wave_rows @ np.concatenate([flow.velocity, flow.motion.side]) / self.gap.wave_norm

    def pressure(self, flow, motion, bottom=0.0):
        """∬ φ n dS along `motion` per unit length of the side, m³/s · (unit of n).

        bottom : ∬ ψ ∂ψ_flow/∂z over the bottom per unit length of the side, ψ that of `motion`

        Under the body Green's identity turns the integral over the bottom into one over the gap.
        """
        gap, f = self.gap, len(self.gap.mean)
        outer = np.concatenate([flow.velocity, flow.motion.side])
        inner = np.concatenate([flow.velocity, np.negative(flow.motion.slope)])
        side = motion.side @ (self.outside[f:] @ outer + flow.drive * gap.wave_rows[f:])
        through = motion.value @ np.array([gap.mean @ flow.velocity, gap.second_moment @ flow.velocity])
        value = motion.slope @ (self.beneath[f:] @ inner + flow.constant * gap.mean_rows[f:])
        value += self._product(flow.motion.value, motion.slope)
        return side - (bottom + through - value)

    def _product(self, p, q):
        s = self.gap.height
        return s * p[0] * q[0] + s**3 / 3 * (p[0] * q[1] + p[1] * q[0]) + s**5 / 5 * p[1] * q[1]
