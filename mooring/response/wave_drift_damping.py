"""Wave drift damping: change of the mean drift by a slow velocity of the body.

A body has the slow velocity U, with components U_L along the waves and U_T across the waves (to the left). It meets
the waves at the frequency ω − kU_L and in the direction β − U_T/C_g. Its drift is

    D(U) = {1 + (ω dn/dω − 2) U_L/C_g} D(ω − kU_L, β − U_T/C_g),    n = C_g/C

    B_jk = −∂F_j/∂U_k = [k ∂D_j/∂ω + (2 − ω dn/dω) D_j/C_g] e_L,k + (∂D_j/∂β)/C_g e_T,k

In deep water n = ½ and 1/C_g = 2ω/g: the formula of Aranha (1994), ω²/g ∂D/∂ω + 4ω/g D along and 2ω/g ∂D/∂β across. In
finite depth it follows from the same two balances, of wave action and momentum along rays. For a totally reflecting
wall, and for a body that scatters evenly, the balances give {1 − 2U_L/C_g} times the drift at rest in any depth. The
long waves bound to wave groups are neglected.  The yaw moment is treated like the forces; a yaw velocity is not
included.

On a current V the velocity through the water is U = ẋ − V: the force on a body at rest is, to first order,

    D(V) = D + B V

This derivative keeps the wave in the water unchanged: its intrinsic frequency ω, and therefore its length, its
amplitude and the direction β of its crests. A vertical cylinder on the bed (radius 10 m, depth 20 m) has (dD/dV)/D =
0.4464, 0.3598, 0.4769 s/m at ka = 0.5, 1, 1.5.  If the frequency at a fixed place is held instead
(`on_current.waves`, "absolute"), the intrinsic frequency falls by kV, which removes k ∂D/∂ω.
Along the waves (2 − ω dn/dω)/C_g remains: 0.2512, 0.4277, 0.5164 s/m for that
cylinder.
"""

import numpy as np

from hakobune.bem.waves import group_factor, wavenumber

from ..on_current.body import carrier_of_body
from .drift import drift_slopes
from .linear import over_headings

LEAST = 0.05  # smallest dσ/dω before a current blocks waves given in absolute frequencies


def drift_and_damping(body, omega, heading, fixed=False):
    """Mean drift D (q, p, 3) of surge, sway and yaw per squared wave amplitude; and damping B (q, p, 3, 2), N s/m³ ….

    B is the negative slope of D over velocities along x and y.

    omega : (q,) rad/s, from `linear.frequencies`, rising and close enough to differentiate the drift; heading : (p,)
    rad
    fixed : True for the fixed body, False for the floating body
    """
    value, by_omega, by_heading = drift_slopes(body, omega, heading, fixed)
    return value, _damping(body, omega, heading, value, by_omega, by_heading)


def along_waves(body, omega, heading):
    """Like `drift_and_damping`, for drift known only at single headings: the derivative over heading is taken as
    zero
    """
    value = body.drift(omega, heading)
    return value, _damping(body, omega, heading, value, np.gradient(value, omega, axis=0, edge_order=2), 0 * value)


def of_current(body, coefficients):
    """Damping force B V, from B (…, 3, 2), on the current of an `on_current.body.OnCurrent`, 0 in still water; shape
    (…, 3)"""
    carrier = carrier_of_body(body)
    return coefficients @ np.array((0.0, 0.0) if carrier is None else carrier.velocity)


def _damping(body, omega, heading, value, by_omega, by_heading):
    carrier, heading = carrier_of_body(body), np.atleast_1d(heading)
    if carrier is None or not carrier.absolute:
        k = wavenumber(omega, body.depth, body.gravity)
        return from_slopes(omega, heading, k, body.depth, value, by_omega, by_heading)
    own = body.intrinsic(omega, heading)
    by_own = by_omega / np.maximum(np.gradient(own, omega, axis=0), LEAST)[..., None]
    rows = []
    for p, beta in enumerate(heading):
        k, one = wavenumber(own[:, p], body.depth, body.gravity), slice(p, p + 1)
        slopes = value[:, one], by_own[:, one], by_heading[:, one]
        rows.append(from_slopes(own[:, p], beta, k, body.depth, *slopes))
    return np.concatenate(rows, axis=1)


def from_slopes(omega, heading, k, depth, value, by_omega, by_heading):
    """Damping B from the drift D (q, p, …) and its derivatives per rad/s and per rad; shape (q, p, …, 2)."""
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
    """Mean damping, N s/m and N m s/m, in irregular waves: 2 ∫ Σ_β w_β B S dω; shape (3, 2); arguments as in
    `drift.mean_in_sea`."""
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
