"""A line that touches nothing between its ends: the elastic catenary as one monotone equation.

Point (V, H) of the force plane is written in elliptic coordinates about (0, 0) and (wL, 0), c = wL/2:

    V = c (1 + √(1+t²) cos ν),    H = c t sin ν,    κ = wL / 2EA

With these the textbook equations (SR179 report, 1982, section 3.1.1, integrated) become a pair of products

    x = L sin ν · t (asinh(1/t) + κ),    z = L cos ν · (1 + κ √(1+t²)),

so that t solves (x/LP)² + (z/LQ)² = 1 with P = t (asinh 1/t + κ) and Q = 1 + κ√(1+t²).  Both grow with t:
there is one root, it has a proven bracket, and no difference of large numbers is left when the line is taut.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .roots import asinh_excess, falling_root


class Shape(NamedTuple):
    """Elliptic coordinates of a suspended line: t, sin ν, cos ν, each (n,)."""

    t: np.ndarray
    sine: np.ndarray
    cosine: np.ndarray


def shape_between(x, z, length, weight, flexibility):
    """Shape of lines with span x ≥ 0 and height z; t is infinite where nothing inextensible can reach.

    x, z, length : (n,) m; weight : (n,) N/m; flexibility : (n,) 1/EA in 1/N
    """
    X, Z, kappa = x / length, z / length, 0.5 * flexibility * weight * length
    hanging = 1 + kappa
    reach2 = X * X + Z * Z
    beyond = (kappa == 0) & (reach2 >= 1)
    plumb = (X == 0) & ~beyond
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        # √t asinh(1/t) < 1.1, hence P(low) ≤ X; P, Q ≥ κt and P² ≥ 1 − 1/3t², hence the sum is ≤ 1 at high
        low = np.minimum((X / 2.2) ** 2, np.where(kappa > 0, X / (2 * kappa), np.inf))
        high = np.minimum(
            np.where(kappa > 0, 1.5 * np.maximum(X, np.abs(Z)) / kappa, np.inf),
            np.where(reach2 < 1, 1 / np.sqrt(3 * np.maximum(1 - reach2, 1e-300)), np.inf),
        )
        upright = np.sqrt(np.maximum(((np.abs(Z) - 1) / np.where(kappa > 0, kappa, 1)) ** 2 - 1, 0.0))
    easy = plumb | beyond
    low, high = np.where(easy, 1.0, np.minimum(low, high)), np.where(easy, 1.0, high)

    def excess(q):
        t = np.exp(q)
        bend = np.arcsinh(1 / t)
        root = np.sqrt(1 + t * t)
        P, Q = t * (bend + kappa), 1 + kappa * root
        horizontal, vertical = (X / P) ** 2, (Z / Q) ** 2
        total = horizontal + vertical
        slope = horizontal * (asinh_excess(1 / t) + kappa) / (bend + kappa) + vertical * kappa * t * t / (root * Q)
        total = np.where(easy, 1.0, total)
        return np.log(total), -2 * slope / total

    t = np.exp(falling_root(excess, np.log(low), np.log(high), np.log(high)))
    stretched = np.abs(Z) > hanging
    t = np.where(plumb, np.where(stretched, upright, 0.0), np.where(beyond, np.inf, t))
    with np.errstate(invalid="ignore", divide="ignore"):
        sine = X / (t * (np.arcsinh(1 / t) + kappa))
        cosine = Z / (1 + kappa * np.sqrt(1 + t * t))
    loop = np.sqrt(np.maximum(1 - np.clip(Z / hanging, -1, 1) ** 2, 0.0))
    sine = np.where(plumb, np.where(stretched, 0.0, loop), sine)
    return Shape(t, np.minimum(sine, 1.0), np.where(beyond, Z, np.clip(cosine, -1, 1)))


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


def forces(shape, length, weight):
    """H and V at the upper end, N."""
    half = 0.5 * weight * length
    with np.errstate(invalid="ignore"):
        return half * shape.t * shape.sine, half * (1 + np.sqrt(1 + shape.t**2) * shape.cosine)


def stiffness(shape, length, weight, flexibility):
    """(n, 2, 2) N/m: ∂(H, V)/∂(x, z) at the upper end, every term of one sign.

    The compliance is 2/w · [[κ+h+a, −d], [−d, κ+b]] with ab = d², so its determinant has no difference.
    """
    t, s, c = shape
    kappa = 0.5 * flexibility * weight * length
    root = np.sqrt(1 + t * t)
    with np.errstate(divide="ignore", invalid="ignore"):
        norm = t * t + s * s
        a = t * t * c * c / (root * norm)
        b = root * s * s / norm
        d = t * s * c / norm
        h = asinh_excess(1 / t)
        determinant = kappa * kappa + kappa * (h + a + b) + h * b
        k = np.stack([kappa + b, d, d, kappa + h + a], axis=-1) / determinant[..., None]
        plumb = np.stack([0 * t, 0 * t, 0 * t, 1 / (kappa + 1)], axis=-1)
    k = np.where((t == 0)[..., None], plumb, k)
    return (0.5 * weight[..., None] * k).reshape(*t.shape, 2, 2)
