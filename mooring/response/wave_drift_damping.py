"""Wave drift damping: what a slow velocity of the body changes in its mean drift.

A body that moves with the slow velocity U, along the waves U_L and across them (to the left) U_T, meets them at the
frequency ω − kU_L and in the direction β − U_T/C_g, and its drift is

    D(U) = {1 + (ω dn/dω − 2) U_L/C_g} D(ω − kU_L, β − U_T/C_g),    n = C_g/C

    B_jk = −∂F_j/∂U_k = [k ∂D_j/∂ω + (2 − ω dn/dω) D_j/C_g] e_L,k + (∂D_j/∂β)/C_g e_T,k

In deep water n = ½ and 1/C_g = 2ω/g: the formula of Aranha (1994), ω²/g ∂D/∂ω + 4ω/g D along and 2ω/g ∂D/∂β across.
In finite depth it follows from the same two balances, of wave action and momentum along rays; they give a totally
reflecting wall, and a body that scatters evenly, {1 − 2U_L/C_g} of the drift at rest in any depth.  The long waves
bound to wave groups, and currents, are not in it.  The yaw moment is treated as the forces are; nothing is said of a
velocity of yaw.
"""

from __future__ import annotations

import numpy as np

from bem.waves import group_factor, wavenumber

from .drift import drift_slopes
from .linear import over_headings


def drift_and_damping(body, omega, heading):
    """Mean drift D (q, p, 3) and B (q, p, 3, 2) per squared wave amplitude: of surge, sway, yaw against velocities
    along x and y, N s/m³ ….

    omega : (q,) rad/s rising and close enough to differentiate the drift, from `linear.frequencies`; heading : (p,) rad
    """
    value, by_omega, by_heading = drift_slopes(body, omega, heading)
    k = wavenumber(omega, body.depth, body.gravity)
    return value, from_slopes(omega, heading, k, body.depth, value, by_omega, by_heading)


def from_slopes(omega, heading, k, depth, value, by_omega, by_heading):
    """(q, p, …, 2) B from the drift D (q, p, …) and its derivatives per rad/s and per rad."""
    omega, heading = np.asarray(omega, float), np.atleast_1d(heading)
    n = group_factor(k, depth)
    group_speed = n * omega / k
    column = (-1,) + (1,) * (np.ndim(value) - 1)
    slope = omega * _factor_slope(omega, k, n, depth)
    along = np.reshape(k, column) * by_omega + np.reshape((2 - slope) / group_speed, column) * value
    across = by_heading / np.reshape(group_speed, column)
    row = (1, -1) + (1,) * (np.ndim(value) - 2)
    c, s = (np.reshape(f(heading), row) for f in (np.cos, np.sin))
    return np.stack([along * c - across * s, along * s + across * c], axis=-1)


def mean_damping(omega, coefficients, density, weights=(1.0,)):
    """(3, 2) N s/m and N m s/m in irregular waves: 2 ∫ Σ_β w_β B S dω; arguments as in `drift.mean_in_sea`."""
    return 2 * np.trapezoid(over_headings(coefficients, weights) * np.reshape(density, (-1, 1, 1)), omega, axis=0)


def _factor_slope(omega, k, n, depth):
    """dn/dω of n = ½(1 + 2kh/sinh 2kh); 0 in deep water, and dk/dω = 1/C_g elsewhere"""
    if np.isinf(depth):
        return np.zeros_like(omega)
    x = 2 * k * depth
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = 2 * x * np.exp(-x) / -np.expm1(-2 * x)  # x / sinh x
        by_x = 0.5 * np.where(x > 1e-3, ratio * (1 / x - 1 / np.tanh(x)), -x / 3)
    return by_x * 2 * depth * k / (n * omega)
