"""Regimes in which a line's inertia and drag matter, and the simplified dynamic tension of a line without buoys.

SR179 report (1982), section 3.2.1 (equation numbers 3.2.1 to 3.2.11).  The suspended part of the line, of length S₀,
is one mass M + ΔM that moves with its centroid by Z_m cos ωt; α = ω² Z_m / g sorts the motion:

    α < α_H   quasi-static    statics alone
    α < α_S   harmonic        the formula below
    α < α_F   slack–taut      the dynamic force exceeds the submerged weight: lumped mass
    else      free fall       the line falls more slowly than the fairlead, and snaps: lumped mass

    F_v1 = ω²(M + ΔM) Z_m,   F_v2 = 4ρ C_d D S₀ cos³θ_m Z_m² ω² / 3π                                  (3.2.1)
    T_v = T_v0 + (C_xz X + C_zz Z − F_v1) cos ωt − F_v2 sin ωt,   T_H = T_v T_H0/T_v0                 (3.2.3 to 3.2.8)

The print has 3λ for 3π in (3.2.1); (3.2.10) confirms π.  By text and formula of (3.2.9), dynamic effects begin where
the inertia is twice the static restoring force; a fifth would be expected. `onset` is this factor.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import as_python

from .catenary.solve import solve_lines
from .catenary.state import State


class Regime(IntEnum):
    """Motion of the line in one cycle; SLACK_TAUT and FREE_FALL need `dynamics.simulation.simulate`."""

    QUASI_STATIC = 1
    HARMONIC = 2
    SLACK_TAUT = 3
    FREE_FALL = 4


class CatenaryStiffness(NamedTuple):
    """Stiffness ∂(H, V)/∂(x, z), N/m, of an inextensible line partly on a flat bed."""

    xx: np.ndarray
    xz: np.ndarray
    zz: np.ndarray


class HarmonicTension(NamedTuple):
    """Pull at the fairlead: mean + cosine cos ωt − sine sin ωt, each (2,) N, horizontal and down; outermost at t = 0.

    largest : N; acceleration : α; harmonic, slack, fall : boundaries α_H, α_S, α_F of the regimes
    """

    mean: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray
    largest: float
    acceleration: float
    harmonic: float
    slack: float
    fall: float

    @property
    def regime(self):
        """Regime of the line; the tensions of a HarmonicTension do not apply beyond HARMONIC"""
        return Regime(
            1 + sum(self.acceleration >= a for a in (self.harmonic, max(self.harmonic, self.slack), self.fall))
        )


def catenary_stiffness(horizontal_tension, span, weight):
    """(3.2.5), with η = w span / 2H:  C_xx = w / 2(η − tanh η),  C_xz = C_xx tanh η, and C_zz.

    horizontal_tension : N; span : m, horizontal length of the suspended part; weight : submerged weight, N/m
    """
    eta = 0.5 * np.asarray(weight * span / horizontal_tension, float)
    t = np.tanh(eta)
    xx = 0.5 * weight / (eta - t)
    return CatenaryStiffness(xx, xx * t, xx * (eta * (1 + t * t) - t) / t)


def centroid_height(horizontal_tension, span, weight):
    """(3.2.2): g_c = (H/w) [½ cosh D − 1 + D / (2 sinh D)], m over the bed, D = w span / H."""
    D = np.asarray(weight * span / horizontal_tension, float)
    return horizontal_tension / weight * (0.5 * np.cosh(D) - 1 + 0.5 * D / np.sinh(D))


def _rounded(amplitude):
    """Text of a motion, m, without rounding errors"""
    return f"{round(abs(amplitude), 6):.3g}"


def harmonic_tension(
    x,
    z,
    length,
    weight,
    mass,
    diameter,
    amplitude,
    period,
    *,
    axial_stiffness=np.inf,
    drag=1.2,
    added_mass=1.0,
    density=1025.0,
    gravity=9.80665,
    onset=2.0,
):
    """Dynamic tension by the simplified method and its regime, for one uniform line on a flat bed.

    x, z : mean position of the fairlead from the anchor, m; length : m; weight : submerged weight, N/m; mass : in
        air, kg/m
    diameter : m
    amplitude : amplitudes outward and upward, in phase, (2,) m; period : s
    raises : ValueError if no part of the line lies on the bed at rest or at the outermost position
    """
    out, up = (float(value) for value in amplitude)
    for name, value, good in (
        ("period", period, period > 0),
        ("mass", mass, mass > 0),
        ("diameter", diameter, diameter > 0),
    ):
        if not (good and np.isfinite(value)):
            raise ValueError(f"{name} is {value:g}; allowed: finite, above 0")
    with as_python():
        line = solve_lines(np.array([x, x + out]), np.array([z, z + up]), length, weight, axial_stiffness)
    if np.any(line.status != State.GROUNDED):
        raise ValueError(
            f"the line of {length:g} m with its fairlead at x = {x:g} ± {_rounded(out)} m, z = {z:g} ± "
            f"{_rounded(up)} m does not always have a part on the bed and a tension, at rest and at the "
            "outermost position; the simplified method needs both"
        )
    H, V = line.horizontal_fairlead, line.vertical_fairlead
    span = H / weight * np.arcsinh(V / H)
    C = catenary_stiffness(H[0], span[0], weight)
    S = V[0] / weight
    rise = abs(np.diff(centroid_height(H, span, weight))[0])
    omega, water = 2 * np.pi / period, density * np.pi / 4 * diameter**2
    M, dM, slant = mass * S, added_mass * water * S, np.cos(np.arctan2(z, span[0])) ** 3
    drag_force = 4 * density * drag * diameter * S * slant * rise**2 / (3 * np.pi)
    static = C.xz * out + C.zz * up
    direction, mean = np.array([H[0] / V[0], 1.0]), np.array([H[0], V[0]])
    cosine, sine = static - omega**2 * (M + dM) * rise, omega**2 * drag_force
    dynamic = np.hypot(1 + dM / M, drag_force / (M * rise) if rise > 0 else 0.0)
    return HarmonicTension(
        mean,
        cosine * direction,
        sine * direction,
        float(np.hypot(*mean) * (1 + np.hypot(cosine, sine) / V[0])),
        acceleration=float(omega**2 * rise / gravity),
        harmonic=float(onset * abs(static) / (gravity * (M + dM))),
        slack=float(weight * S / (M * gravity) / dynamic),
        fall=1.0,
    )
