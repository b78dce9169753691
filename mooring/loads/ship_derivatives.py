"""Linear derivatives of the water's force on a ship, from its proportions.

    Y = ½ρL²V (Y'_v v + L Y'_r r),   N = ½ρL³V (N'_v v + L N'_r r)

regressions of captive tests of merchant ships, Clarke, Gedling and Hine, "The application of manoeuvring criteria in
hull design using linear theory", Transactions of RINA 125 (1983), with T the draft and C_B the block coefficient,

    Y'_v = −π(T/L)² (1 + 0.40 C_B B/T)              Y'_r = −π(T/L)² (−1/2 + 2.2 B/L − 0.080 B/T)
    N'_v = −π(T/L)² (1/2 + 2.4 T/L)                 N'_r = −π(T/L)² (1/4 + 0.039 B/T − 0.56 B/L)
    Y'_v̇ = −π(T/L)² (1 + 0.16 C_B B/T − 5.1 (B/L)²)
    N'_ṙ = −π(T/L)² (1/12 + 0.017 C_B B/T − 0.33 B/L)

about midship, in deep water, x forward. y may point to starboard or port, since no derivative changes its sign.
"""

from typing import NamedTuple

import numpy as np

from .box_drag import check_positive


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
