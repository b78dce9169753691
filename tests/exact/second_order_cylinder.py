"""Second-order surge force of two waves on a cylinder that stands on the sea bed, at their difference frequency.

On the cylinder the first-order potential is that of MacCamy and Fuchs (1954).  Coefficients T are those of
Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp(−i(ωᵢ − ωⱼ)t), so that T_ii is the mean drift and of a pair of waves 2T the amplitude.  Both
waves travel along x; time factor exp(−iωt); nothing of the product is used.
"""

from __future__ import annotations

import numpy as np
from scipy.special import h1vp, hankel1, jv, jvp, kve

from .water_waves import cosh_ratio, evanescent_wavenumbers, sinh_ratio, wave_norm, wavenumber

POINTS = 60  # Gauss points over the depth


def long_wave_force(radius, depth, omega, kappa, density=1025.0, gravity=9.80665, modes=4000):
    """Surge force N/m of a wave of unit amplitude with any wavenumber κ, and of the free waves it diffracts

    Z_κ is a sum of the eigenfunctions of the frequency, each of which diffracts by itself; the error falls like
    modes⁻³.
    """
    a, h = radius, depth
    k, kn = wavenumber(omega, h, gravity), evanescent_wavenumbers(omega, h, modes, gravity)
    K = omega**2 / gravity
    # ∫ Z_κ f dζ = (f Z_κ′ − f′ Z_κ) / (κ² − k²) at the surface, where f = 1 and f′ = K f
    jump = kappa * np.tanh(kappa * h) - K
    over_wave, over_local = jump / (kappa**2 - k**2), jump / (kappa**2 + kn**2)
    norms = h / 2 * (1 + np.sin(2 * kn * h) / (2 * kn * h)) / np.cos(kn * h) ** 2
    heights = np.tanh(k * h) / k, np.tan(kn * h) / kn  # ∫ f dζ, f = 1 at the surface
    x = kn * a
    ratios = hankel1(1, k * a) / (k * h1vp(1, k * a)), -1 / (kn * (kve(0, x) / kve(1, x) + 1 / x))
    diffracted = over_wave / wave_norm(k, h) * heights[0] * ratios[0]
    diffracted = diffracted + np.sum(over_local / norms * heights[1] * ratios[1])
    incident = jv(1, kappa * a) * np.tanh(kappa * h) / kappa
    return -2j * np.pi * a * density * gravity * (incident - kappa * jvp(1, kappa * a) * diffracted)


def quadratic_force(radius, depth, one, two, density=1025.0, gravity=9.80665):
    """Surge T, N/m², of the first-order pressures: waterline and velocities squared"""
    (Z, slope, side), (Y, steep, other) = (_wave(radius, depth, w, gravity) for w in (one, two))
    _, w = np.polynomial.legendre.leggauss(POINTS)
    w = w * depth / 2
    m = np.arange(max(len(side), len(other)) + 1)
    p, q = (np.concatenate([s, np.zeros(len(m) - len(s))]) for s in (side, other))
    # φ = Σ p_m cos mθ: ∫ cosθ cos mθ cos nθ dθ and ∫ cosθ m n sin mθ sin nθ dθ, |m − n| = 1
    share = np.where(m[:-1] == 0, np.pi, np.pi / 2)
    cosines = np.sum(share * (p[:-1] * q[1:].conj() + p[1:] * q[:-1].conj()))
    along = m[:-1] * m[1:] * np.pi / 2
    sines = np.sum(along * (p[:-1] * q[1:].conj() + p[1:] * q[:-1].conj()))
    crest = -density * gravity / 4 * (one * two / gravity**2) * cosines * radius
    speed = sines / radius * (w @ (Z * Y)) + cosines * radius * (w @ (slope * steep))
    return crest + density / 4 * speed


def _wave(radius, depth, omega, gravity):
    """Z and Z′ at Gauss points over the depth; amplitudes of cos mθ of the potential at the waterline"""
    k = wavenumber(omega, depth, gravity)
    x = k * radius
    m = np.arange(int(x + 6 * np.cbrt(x) + 14))
    side = np.where(m, 2, 1) * 1j**m * 2j / (np.pi * x * h1vp(m, x)) * -1j * gravity / omega
    zeta = depth * (np.polynomial.legendre.leggauss(POINTS)[0] + 1) / 2
    return cosh_ratio(zeta, k, depth), k * sinh_ratio(zeta, k, depth), side
