"""Forces of a passing ship by formulas fitted to tests in tanks: Kriebel (2005) for an open jetty, Swiegers (2011).

The largest force of each kind is the force by Wang (1975) in deep water, times a factor that depends on the depth:

    F = C ρ U² S₁ S₂/L₂²,   Mz = C_M ρ U² S₁ S₂ L₁/L₂²
    surge 1 + 1.70 e^(2.92 T/d) e^(−0.08 (G/B − 3)²)
    sway  1 + 0.52 e^(4.33 T/d) e^(−0.08 (G/B − 2)²)
    yaw   1 + 0.48 e^(3.87 T/d) e^(−0.08 (G/B − 2)²)

T/d of the moored ship, G the gap between the sides, B the mean beam (Kriebel 2005, Mooring Loads Due to Parallel
Passing Ships, eq. 10).  At a vertical quay the forces are 1.4, 0.4 and 0.5 times as large (Swiegers 2011).  C are
the peaks of `slender.wang`; peaks of the printed curves may be given in their place. The variation over ξ is Wang's,
scaled.
"""

import math
from dataclasses import replace

import numpy as np

from .slender import wang

KINDS = (0, 1, 5)  # surge, sway, yaw of six
# factor and exponents of T/d and G/B for the largest force
FACTORS = (1.70, 2.92, 3.0), (0.52, 4.33, 2.0), (0.48, 3.87, 2.0)
QUAY = (1.4, 0.4, 0.5)
NEAREST, LENGTHS = 0.1, (0.5, 2.0)  # range of distance/L₁ and of L₂/L₁ of the curves


def depth_factors(draft, depth, gap, beam):
    """Factors of surge, sway and yaw for the depth; shape (3,).

    draft : draft of the moored ship, m; gap : distance between the sides, m; beam : mean beam of both ships, m
    """
    if not 0 < draft < depth or not gap > 0:
        raise ValueError(
            f"draft is {draft:g} m, water depth {depth:g} m and gap {gap:g} m; allowed: a depth above the "
            "draft, and a gap above 0"
        )
    return np.array([1 + a * math.exp(b * draft / depth - 0.08 * (gap / beam - place) ** 2) for a, b, place in FACTORS])


def scale(moored, passing, track, density=1025.0):
    """Forces, N, N, N m, that multiply the coefficients of surge, sway and yaw; shape (3,)"""
    unit = density * track.through_water**2 * moored.area * passing.area / passing.length**2
    return np.array([unit, unit, unit * moored.length])


def kriebel(moored, passing, track, stagger, factors, *, quay=False, peaks=None, density=1025.0):
    """`Passage` by tests in tanks.

    moored, passing : `slender.Slender`; stagger : (n,) m; factors : from `depth_factors`; quay : whether there is a
    vertical quay
    peaks : (3,) coefficients C in deep water, read off printed curves, for the largest forces on `stagger`; by default
    from `slender.wang`
    """
    found = wang(moored, passing, track, stagger, density=density)
    factors = np.asarray(factors) * (QUAY if quay else 1.0)
    if peaks is not None:
        own = np.abs(found.changing[:, KINDS]).max(axis=0)
        factors = factors * np.asarray(peaks) * scale(moored, passing, track, density) / own
    force = found.changing.copy()
    force[:, KINDS] *= factors
    return replace(found, changing=force)


def beyond(moored, passing, track):
    """Messages on values beyond the range of the tests"""
    near, share = abs(track.distance) / moored.length, passing.length / moored.length
    if near <= NEAREST:
        yield f"the distance is {near:.3g} of the moored ship's length; the curves are valid above {NEAREST:g}"
    if not LENGTHS[0] <= share <= LENGTHS[1]:
        yield (
            f"the passing ship is {share:.3g} times as long as the moored one; the curves are valid for "
            f"{LENGTHS[0]:g} to {LENGTHS[1]:g}"
        )
