"""The wave bound to a pair of waves, at the difference or the sum of the two frequencies.

At second order a sea Re Σ aᵢ exp{i(kᵢ·x − ωᵢt)} carries the bound waves Re Σᵢ Σⱼ aᵢ āⱼ s_ij exp{i(κ·x − Ωt)}, with Ω
= ωᵢ − ωⱼ and κ = kᵢ − kⱼ. No free wave has this frequency and this wavenumber. The potential of a bound wave of
amplitude s is (Longuet-Higgins and Stewart 1962; Sharma and Dean 1981):

    φ = −(ig/Ω) s cosh κ(z+h)/cosh κh · exp{i(κ·x − Ωt)},        s = −Ω q / {g (gκ tanh κh − Ω²)},

    q = (Ωg²/2ωᵢωⱼ) (kᵢ·kⱼ + KᵢKⱼ) + (g²/4) {(kᵢ² − Kᵢ²)/ωᵢ − (kⱼ² − Kⱼ²)/ωⱼ},        K = ω²/g.

The pressure −ρ ∂φ/∂t at z = 0 is ρg s, which is negative under groups of high waves.  The sum contains the pairs ij
and ji, with s_ij = s_ji, so that for two waves the bound wave has the amplitude 2 s aᵢaⱼ.
In deep water s of two waves in one direction is −Ωωᵢ/2g, with ωᵢ the larger frequency; it is zero only in the limit
of long groups (Longuet-Higgins 1963).

At the sum frequency the second wave has −ωⱼ and −kⱼ (`kinds`): Ω = ωᵢ + ωⱼ, κ = kᵢ + kⱼ.  For a single wave s = ¾K
cosh 2kh / sinh⁴kh, as found by Stokes (1847). In deep water s at sum frequencies is zero for waves in one direction.
"""

from typing import NamedTuple

import numpy as np

from ..waves import wavenumber

NEAREST = 1e-9  # smallest relative frequency difference; smaller ones use this value, since s is even in Ω


class BoundWaves(NamedTuple):
    """omega : frequency of the bound wave, rad/s; number : wavenumber, rad/m, (…, 2); amplitude : s, m per m²"""

    omega: np.ndarray
    number: np.ndarray
    amplitude: np.ndarray


def bound_waves(first, second, depth, gravity=9.80665):
    """`BoundWaves` of pairs of waves.

    first, second : (frequency, rad/s, direction, rad), scalars or arrays that broadcast; for sum frequencies the
        frequencies of `second` are negative; depth : m, may be inf
    """
    (one, beta), (two, gamma) = ([np.asarray(part, float) for part in wave] for wave in (first, second))
    k, l = wavenumber(one, depth, gravity), np.copysign(wavenumber(two, depth, gravity), two)
    number = np.stack([k * np.cos(beta) - l * np.cos(gamma), k * np.sin(beta) - l * np.sin(gamma)], axis=-1)
    angle = beta - gamma - np.where(two < 0, np.pi, 0.0)
    return BoundWaves(one - two, number, _amplitude(one, two, angle, depth, gravity))


def _amplitude(one, two, angle, depth, gravity):
    """s of frequencies whose directions are `angle` apart"""
    middle, half = (one + two) / 2, (one - two) / 2
    half = np.where(np.abs(half) < NEAREST * middle, NEAREST * middle, half)
    one, two, difference = middle + half, middle - half, 2 * half
    k, l, apart = _wavenumbers(one, two, middle, half, depth, gravity)
    K, L = one**2 / gravity, two**2 / gravity
    below = l**2 / np.cosh(np.minimum(l * depth, 300.0)) ** 2  # l² − L² without cancellation
    # (k² − K²)/ω₁ − (l² − L²)/ω₂
    own = (apart * (k + l) - 2 * middle * difference / gravity * (K + L)) / one - below * difference / (one * two)
    q = difference * gravity**2 / (2 * one * two) * (k * l * np.cos(angle) + K * L) + gravity**2 / 4 * own
    kappa = np.sqrt(apart**2 + 4 * k * l * np.sin(angle / 2) ** 2)
    return -difference * q / (gravity * (gravity * kappa * np.tanh(kappa * depth) - difference**2))


def _wavenumbers(one, two, middle, half, depth, gravity):
    """k, l and k − l with all its digits: of x ± e,  x (tanh a − tanh b) + e (tanh a + tanh b) = (ω₁² − ω₂²)/g"""
    k, l = wavenumber(one, depth, gravity), wavenumber(two, depth, gravity)
    x, e, jump = (k + l) / 2, (k - l) / 2, 4 * middle * half / gravity
    if np.isinf(depth):
        return k, l, jump
    for _ in range(2):  # Newton, from all but the last digits
        a, b = (x + e) * depth, (x - e) * depth
        ta, tb = np.tanh(a), np.tanh(b)
        steep = 1 / (np.cosh(np.minimum(a, 300.0)) * np.cosh(np.minimum(b, 300.0)))
        value = x * np.sinh(np.clip(2 * e * depth, -600, 600)) * steep + e * (ta + tb)
        value = np.where(np.minimum(a, b) < 300.0, value, 2 * e)
        slope = sum(t + y * (1 - t * t) for y, t in ((a, ta), (b, tb)))
        e = e + (jump - value) / slope
    return k, l, 2 * e
