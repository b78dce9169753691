"""Regular waves over a flat bed, by formulas of the textbook and bisection: the oracles' own, to judge the product by.

    ω²/g = k tanh kh,     ω²/g = −kₙ tan kₙh,  (n − ½)π < kₙh < nπ,     Z₀ = cosh kζ / cosh kh

ζ is the height above the bed.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

STEPS = 60  # bisections of an interval of π: to rounding


def wavenumber(omega, depth, gravity=9.80665):
    """k, rad/m; omega : rad/s, depth : m, both finite"""
    y = omega**2 / gravity * depth
    root = brentq(lambda x: x * np.tanh(x) - y, 0.0, y + np.sqrt(y) + 1.0, xtol=1e-300, rtol=1e-15)
    return root / depth


def evanescent_wavenumbers(omega, depth, count, gravity=9.80665):
    """kₙ in increasing order, (count,) rad/m"""
    y = omega**2 / gravity * depth
    turns = np.arange(1, count + 1) * np.pi
    low, high = np.full(count, -np.pi / 2), np.zeros(count)  # of kₙh − nπ, at which y cos + kₙh sin changes its sign
    for _ in range(STEPS):
        middle = (low + high) / 2
        above = y * np.cos(middle) + (turns + middle) * np.sin(middle) > 0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return (turns + (low + high) / 2) / depth


def cosh_ratio(zeta, k, depth):
    """Z₀ = cosh kζ / cosh kh"""
    return (np.exp(k * (zeta - depth)) + np.exp(-k * (zeta + depth))) / (1 + np.exp(-2 * k * depth))


def sinh_ratio(zeta, k, depth):
    """sinh kζ / cosh kh"""
    return np.exp(k * (zeta - depth)) * -np.expm1(-2 * k * zeta) / (1 + np.exp(-2 * k * depth))


def group_factor(k, depth):
    """C_g / C = ½ + kh / sinh 2kh"""
    x = 2 * k * depth
    return 0.5 + x * np.exp(-x) / -np.expm1(-2 * x)


def wave_norm(k, depth):
    """∫ Z₀² dζ over the depth, m"""
    return group_factor(k, depth) * np.tanh(k * depth) / k
