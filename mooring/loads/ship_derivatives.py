"""Linear derivatives of the water's force on a ship, from its proportions.

    Y = ½ρL²V (Y'_v v + L Y'_r r),   N = ½ρL³V (N'_v v + L N'_r r)

regressions of captive tests of merchant ships, Clarke, Gedling and Hine, "The application of manoeuvring criteria in
hull design using linear theory", Transactions of RINA 125 (1983), with T the draft and C_B the block coefficient,

    Y'_v = −π(T/L)² (1 + 0.40 C_B B/T)              Y'_r = −π(T/L)² (−1/2 + 2.2 B/L − 0.080 B/T)
    N'_v = −π(T/L)² (1/2 + 2.4 T/L)                 N'_r = −π(T/L)² (1/4 + 0.039 B/T − 0.56 B/L)
    Y'_v̇ = −π(T/L)² (1 + 0.16 C_B B/T − 5.1 (B/L)²)
    N'_ṙ = −π(T/L)² (1/12 + 0.017 C_B B/T − 0.33 B/L)

about midship, in deep water, x forward. y may point to starboard or port, since no derivative changes its sign.

Steady current on a full ship as a tanker, UFC 4-159-03, Design: Moorings (2005), eq. 10 to 21, on L T, for a current
that flows to the angle α from the bow, in water of depth h:

    C_x = (0.1 B T + S C_f + A_p)/(L T) cos α,    S = 1.7 T L + V/T,    C_f = 0.075/(log₁₀ R − 2)²
    C_y = (C₀ + (3.2 − C₀)(T/h)²) sin α,          C₀ = 0.22 √χ,         χ = L² A_m/(B V)

with A_p = L B/(270 · 0.838) of the propeller, and C_f at 1 m/s.  The lever of the side force runs evenly with the angle
from one end to the other, as in eq. 25, here to ±N'_v/Y'_v, the one of small angles.  Beside the curves of OCIMF for
h = 1.1 T (Mooring Equipment Guidelines, 2nd edition, 1997, figures 2.5, 2.6) C_x from ahead and C_y abeam are within
4 %, C_y 20° from the ends 17 to 27 % low, and the moment 20 to 60° from them 26 % low to 36 % high.
"""

from typing import NamedTuple

import numpy as np

from .box_drag import check_positive
from .coefficients import hull_coefficients, shallow_coefficient

BLOCK, MIDSHIP = 0.83, 0.99  # coefficients of a loaded tanker
VISCOSITY = 1.19e-6  # m²/s, sea water at 15 °C
STEP = 5.0  # °, of the coefficients


class ShipDerivatives(NamedTuple):
    """Dimensionless derivatives in the equations of the module"""

    Y_v: float
    Y_r: float
    N_v: float
    N_r: float
    Y_vdot: float
    N_rdot: float


def clarke(length, beam, draft, block) -> ShipDerivatives:
    """ShipDerivatives of a ship of length, beam, draft, m, and a block coefficient, above 0, at most 1.

    raises : ValueError
    """
    check_positive(length=length, beam=beam, draft=draft, block=block)
    if not block <= 1:
        raise ValueError(f"block coefficient is {block:g}; allowed: above 0, at most 1")
    wide, slender = beam / draft, beam / length
    return ShipDerivatives(
        *-np.pi
        * (draft / length) ** 2
        * np.array(
            [
                1 + 0.40 * block * wide,
                -0.5 + 2.2 * slender - 0.080 * wide,
                0.5 + 2.4 * draft / length,
                0.25 + 0.039 * wide - 0.56 * slender,
                1 + 0.16 * block * wide - 5.1 * slender**2,
                1 / 12 + 0.017 * block * wide - 0.33 * slender,
            ]
        )
    )


def by_yaw_rate(derivatives: ShipDerivatives, length, density, added_surge, angles):
    """Forces due to the yaw rate over V (rL), N, against the direction of flow, rad from the bow; shape (n, 3)

    added_surge : m_x, kg; its part −m_x u r of Y_r is already in the equation of motion
    """
    ahead = -np.cos(angles)
    half = 0.5 * density * length**2
    sideways = (half * derivatives.Y_r + added_surge / length) * ahead
    return np.stack([np.zeros(len(angles)), sideways, np.full(len(angles), half * length * derivatives.N_r)], axis=-1)


def tanker_current(length, beam, draft, depth):
    """HullCoefficients of a current on a loaded tanker, sizes and depth (inf allowed) in m.  Raises ValueError."""
    volume, area = BLOCK * length * beam * draft, length * draft
    found = clarke(length, beam, draft, BLOCK)
    deep = 0.22 * np.sqrt(length**2 * MIDSHIP * beam * draft / (beam * volume))
    side = shallow_coefficient(deep, draft, depth)
    friction = 0.075 / (np.log10(length / VISCOSITY) - 2) ** 2
    ahead = 0.1 * beam * draft + (1.7 * draft * length + volume / draft) * friction + length * beam / (270 * 0.838)
    angle = np.radians(np.arange(0.0, 180.0 + 0.5 * STEP, STEP))
    y = side * np.sin(angle)
    y[[0, -1]] = 0.0
    turn = y * (found.N_v / found.Y_v) * (2 * angle / np.pi - 1)
    water = f"water of {depth / draft:.3g} drafts" if np.isfinite(depth) else "deep water"
    told = (
        f"current force: generic coefficients of a loaded tanker (UFC 4-159-03, 2005), C_y {side:.3g} abeam in "
        f"{water}; their moment is up to 40 % off OCIMF's; give current.file for the ship"
    )
    sizes = {"area_x": area, "area_y": area, "length": length, "notes": (told,)}
    return hull_coefficients(angle, ahead / area * np.cos(angle), y, turn, **sizes)
