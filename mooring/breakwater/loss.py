"""Head loss of the flow under a keel, which potential theory does not include: K_T² + K_R² < 1.

    ΔH = C |U| U / 2g,     U = Q/s under the keel, linearised  (8/3π) C |Q| Q / (2g s²)

The flow from side to side is the odd part of the waves, O = (K_R − K_T) e^(2ikb) at the sides y = ∓b; before a wall
O = 1. For the propagating mode, as in `long_waves`, the head between the sides is f_B a (1 + O), and the discharge
is Q = (ω n / k f_B) (a/2) (1 − O). The loss is added to the impedance of this flow:

    Z = (1 + O)/(1 − O),    Z′ = Z + r,    r |Z + 1 + r| = (2C/3πg) (ωn/ks)² a / f_B³

The even part, K_R + K_T, has no flow underneath and is unchanged.  The difference of the two tensions of a fixed
body grows with the head. Motions and tensions of a moving body remain those of potential flow, since its odd waves
depend on more than the head. For rectangles, `bem.sections.keel_loss` applies this loss in the exact flow, with
motions and tensions. The lost power is that of the head loss, ½ρg Re ΔH Q*. s is the keel clearance; the user gives C.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import depth_factor_slope, group_factor, wavenumber

GAUSSIAN = 3 * np.pi / 8 * np.sqrt(8 / np.pi)  # amplitude of regular waves with the loss of a sea of σ = 1 m
LARGEST = 1e4


class Keel(NamedTuple):
    """half : half width b of the waterline, m; draft, depth : m; gravity : m/s²"""

    half: float
    draft: float
    depth: float
    gravity: float


def with_loss(response, coefficient, amplitude, omega, keel):
    """`Response` of a symmetric body with head loss in the flow underneath.

    response : `Response` by potential theory, (n,); coefficient : C; amplitude : amplitude of the waves, m; omega :
        (n,) rad/s
    keel : `Keel`.  Raises ValueError for a negative coefficient or amplitude.
    """
    if not 0 <= coefficient <= LARGEST or not 0 <= amplitude < np.inf:
        raise ValueError(
            f"loss coefficient is {coefficient:g} and amplitude {amplitude:g} m; allowed: coefficient 0 to "
            f"{LARGEST:g}, amplitude 0 or more"
        )
    aside = np.exp(2j * wavenumber(omega, keel.depth, keel.gravity) * keel.half)
    odd, even = (response.reflection - response.transmission) * aside, response.reflection + response.transmission
    impedance = (1 + odd) / (1 - odd)
    asked = coefficient * amplitude * _share(omega, keel)
    impedance = impedance + _resistance(impedance + 1, asked)
    lossy = (impedance - 1) / (impedance + 1)
    fixed = not np.any(response.sway) and not np.any(response.roll)
    more = (1 + lossy) / (1 + odd) if fixed else 1.0
    mean, half = (response.front + response.back) / 2, (response.front - response.back) / 2 * more
    through = lossy / aside
    return response._replace(
        transmission=(even - through) / 2, reflection=(even + through) / 2, front=mean + half, back=mean - half
    )


def _share(omega, keel):
    """(2/3πg) (ωn/ks)² / f_B³, 1/m"""
    k = wavenumber(omega, keel.depth, keel.gravity)
    gap = keel.depth - keel.draft
    f_B = depth_factor_slope(-keel.draft, k, keel.depth) / (k * k * gap)
    return 2 / (3 * np.pi * keel.gravity) * (omega * group_factor(k, keel.depth) / (k * gap)) ** 2 / f_B**3


def _resistance(around, asked):
    """r ≥ 0 of r |around + r| = asked, by bisection: the left side rises from 0, since Re around ≥ 1"""
    low, high = np.zeros_like(asked), np.array(asked, float)
    for _ in range(60):
        middle = (low + high) / 2
        less = middle * np.abs(around + middle) < asked
        low, high = np.where(less, middle, low), np.where(less, high, middle)
    return (low + high) / 2
