"""A line that touches nothing between its ends: the elastic catenary as one monotone equation.

Point (V, H) of the force plane is written in elliptic coordinates about (0, 0) and (wL, 0), c = wL/2:

    V = c (1 + √(1+t²) cos ν),    H = c t sin ν,    κ = wL / 2EA

With these the textbook equations (SR179 report, 1982, section 3.1.1, integrated) become a pair of products

    x = L sin ν · t (asinh(1/t) + κ),    z = L cos ν · (1 + κ √(1+t²)),

so that t solves (x/LP)² + (z/LQ)² = 1 with P = t (asinh 1/t + κ) and Q = 1 + κ√(1+t²).  Both grow with t:
there is one root, it has a proven bracket, and no difference of large numbers is left when the line is taut.
Here the span is sought at a given tension; `lines.hanging.uniform` seeks the tension at a given span.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .roots import falling_root


class Shape(NamedTuple):
    """Elliptic coordinates of a suspended line: t, sin ν, cos ν, each (n,)."""

    t: np.ndarray
    sine: np.ndarray
    cosine: np.ndarray


def shape_at_tension(horizontal, z, length, weight, flexibility):
    """Shape of lines that carry the horizontal tension `horizontal` > 0 N over the height z; the span is open."""
    Z, kappa = z / length, 0.5 * flexibility * weight * length
    pull = horizontal / (0.5 * weight * length)
    inside = np.where(kappa > 0, -1.0, 1 - Z * Z)
    if np.any((kappa == 0) & (inside <= 0)):
        raise ValueError("an inextensible line shorter than the height of its fairlead cannot be hung")
    with np.errstate(divide="ignore"):
        high = np.minimum(
            np.where(inside > 0, pull / np.sqrt(np.maximum(inside, 1e-300)), np.inf),
            np.where(kappa > 0, 1.5 * np.maximum(pull, np.abs(Z) / np.where(kappa > 0, kappa, 1)), np.inf),
        )

    def excess(q):
        t = np.exp(q)
        root = np.sqrt(1 + t * t)
        Q = 1 + kappa * root
        horizontal2, vertical2 = (pull / t) ** 2, (Z / Q) ** 2
        total = horizontal2 + vertical2
        slope = horizontal2 + vertical2 * kappa * t * t / (root * Q)
        return np.log(total), -2 * slope / total

    t = np.exp(falling_root(excess, np.log(pull), np.log(high), np.log(high)))
    return Shape(t, np.minimum(pull / t, 1.0), Z / (1 + kappa * np.sqrt(1 + t * t)))
