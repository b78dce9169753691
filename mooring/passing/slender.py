"""Forces of a passing ship by slender bodies (Wang 1975, Journal of the Waterways, Harbors and Coastal Engineering
Division 101).

The surface is a rigid lid.  The passing ship is a line of sources, whose strength is the slope of its section area
S₂. Each section of the moored ship is exposed to the flow at its place, and has the added mass ρS₁ of a circle, so
that

    φ = −U/(2π) ∫ S₂′ Σₙ 1/rₙ dx₂,   rₙ² = (x₂ + ξ − x₁)² + η² + (2nh)²
    Fx = ρ ∫ S₁ dφₓ/dt dx₁,   Fy = 2ρ ∫ S₁ dφ_y/dt dx₁,   Mz = 2ρ ∫ x₁ S₁ dφ_y/dt dx₁,   d/dt = U d/dξ

Images in the bed, n from −∞ to ∞, are summed in shallow water as 1/h [−ln R + 2 Σₘ K₀(mπR/h)] (Poisson), with R² = (x₂
+ ξ − x₁)² + η². Section areas are parabolas as in Wang's paper, S (1 − 4x²/L²).  The theory neglects that the moored
hull S₁ blocks the flow under its keel.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import k0, k1

from .passage import Passage

POINTS = 64  # Gauss points over each ship
LAST = 36.0  # largest mπR/h; beyond it K₀ is below 1e-16
IMAGES = 20


@dataclass(frozen=True)
class Slender:
    """A ship as its length, m, and the area of its largest section, m²"""

    length: float
    area: float

    def __post_init__(self):
        if not (0 < self.length < math.inf and 0 < self.area < math.inf):
            raise ValueError(
                f"the length is {self.length} m and the section area {self.area} m²; allowed: positive, finite"
            )


def wang(moored, passing, track, stagger, depth=math.inf, density=1025.0):
    """`Passage` by slender bodies.

    moored, passing : Slender; track : Track; stagger : (n,) m; depth : m, may be inf; density : kg/m³
    """
    stagger = np.asarray(stagger, float)
    unit = np.array([_unit(moored, passing, abs(track.distance), one, depth) for one in stagger])
    surge, sway, yaw = density * track.through_water**2 * moored.area * passing.area * unit.T
    side = np.sign(track.distance)
    force = np.zeros((len(stagger), 6))
    force[:, 0], force[:, 1], force[:, 5] = surge, side * sway, side * yaw
    return Passage(track, stagger, force, np.zeros_like(force))


def _unit(moored, passing, distance, stagger, depth):
    """Fx, Fy, Mz over ρU²S₁S₂ of a stagger, with the ship on the positive side; shape (3,)"""
    x, weight = np.polynomial.legendre.leggauss(POINTS)
    x1, x2 = 0.5 * moored.length * x, 0.5 * passing.length * x
    first, last = 0.5 * moored.length * weight, 0.5 * passing.length * weight
    along = x2[None, :] + stagger - x1[:, None]
    source = -8 * x2 / passing.length**2 * last
    slope, inverse = _slopes(np.hypot(along, distance), depth)
    area = first * (1 - 4 * x1**2 / moored.length**2)
    surge = -((source * along * slope).sum(axis=1) * first * (-8 * x1 / moored.length**2)).sum() / (2 * math.pi)
    across = (source * along * distance * inverse).sum(axis=1)
    return np.array([surge, -(area * across).sum() / math.pi, -(area * x1 * across).sum() / math.pi])


def _slopes(R, depth):
    """G′/R and (G′/R)′/R of G = Σₙ (R² + 4n²h²)^(−1/2), at any R > 0; G is of R alone, d²G/dξdη is ξη (G′/R)′/R"""
    if math.isinf(depth):
        return -1.0 / R**3, 3.0 / R**5
    if math.pi * R.min() < depth:
        return _by_images(R, depth)
    wave = np.arange(1, math.ceil(LAST * depth / (math.pi * R.min())) + 1)[:, None, None] * math.pi / depth
    zero, one = k0(wave * R), k1(wave * R)
    slope = -(1.0 / R + 2 * (wave * one).sum(axis=0)) / depth
    second = (1.0 / R**2 + 2 * (wave**2 * zero + wave * one / R).sum(axis=0)) / depth
    return slope / R, (second - slope / R) / R**2


def _by_images(R, depth):
    """Like `_slopes`, image by image, with those beyond the last replaced by integrals from half a step behind it"""
    high = 2 * depth * np.arange(1, IMAGES + 1)[:, None, None]
    r = np.sqrt(R**2 + high**2)
    end = 2 * depth * (IMAGES + 0.5)
    slope = -1.0 / R**3 - 2 * (r**-3.0).sum(axis=0) - 1.0 / (2 * depth * end**2)
    return slope, 3.0 / R**5 + 6 * (r**-5.0).sum(axis=0) + 3.0 / (4 * depth * end**4)
