"""Floating hemisphere in deep water: heave and surge, after Hulme, J. Fluid Mech. 121 (1982).

Radius one, polar angle θ from the downward vertical, K = ω²/g.  The potential is a singularity that makes
waves and a series of ones that do not:

    heave   Φ₀ = 1/R + K W,      Φₙ = P₂ₙ(cosθ)/R^(2n+1) + (K/2n) P₂ₙ₋₁(cosθ)/R^(2n)
    surge   Φ₀ = ∂/∂r of it,     Φₙ = P¹₂ₙ₊₁(cosθ)/R^(2n+2) + (K/2n) P¹₂ₙ(cosθ)/R^(2n+1)

with W = ∫ exp(μz) J₀(μr) / (μ − K) dμ passing under the pole.  W comes from ∂W/∂z = 1/R + K W and its
value on z = 0; Hulme expands it in Legendre functions instead, which fails for large K.  The coefficients
follow from the normal velocity on the sphere by least squares on Gauss points.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.special import j0, j1, struve, y0, y1

HEAVE, SURGE = "heave", "surge"


@lru_cache(maxsize=256)
def hemisphere(Ka, mode, terms=60):
    """Added mass / (⅔πρa³) and damping / (⅔πρa³ω).

    Ka : ω²a/g, positive; mode : "heave" or "surge"; terms : wave-free singularities
    """
    if not 0 < Ka < np.inf:
        raise ValueError(f"Ka {Ka}: must be positive and finite")
    if mode not in (HEAVE, SURGE):
        raise ValueError(f"mode {mode!r}: must be 'heave' or 'surge'")
    theta, weight = quarter_circle(6 * terms)
    normal = -np.cos(theta) if mode == HEAVE else np.sin(theta)
    value, slope = singularities(Ka, mode, theta, terms)
    root = np.sqrt(weight * np.sin(theta))
    size = np.linalg.norm(slope * root[:, None], axis=0)
    strengths = np.linalg.lstsq(slope / size * root[:, None], normal * root, rcond=None)[0] / size
    around = 2 if mode == HEAVE else 1
    impedance = -1.5 * around * np.sum(weight * np.sin(theta) * normal * (value @ strengths))
    return float(impedance.real), float(impedance.imag)


def quarter_circle(count):
    """Gauss angles and weights on 0 < θ < π/2"""
    x, w = np.polynomial.legendre.leggauss(count)
    return np.pi / 4 * (x + 1), np.pi / 4 * w


def singularities(K, mode, theta, terms):
    """Potential and radial velocity of Φ₀, Φ₁, … on the unit sphere, two (t, terms + 1) complex arrays"""
    n = np.arange(1, terms + 1)
    m = 0 if mode == HEAVE else 1
    P = legendre(2 * terms + 1, m, np.cos(theta))
    high, low = P[2 * n + m].T, P[2 * n + m - 1].T
    free = high + K / (2 * n) * low
    free_slope = -(2 * n + m + 1) * high - K / (2 * n) * (2 * n + m) * low
    wave, wave_slope = wave_maker(K, mode, theta)
    return np.column_stack([wave, free]), np.column_stack([wave_slope, free_slope])


def legendre(highest, m, x):
    """Pₙᵐ(x) for n = 0 … highest and m = 0 or 1 (without the sign of Condon and Shortley), (highest + 1, x)"""
    P = np.zeros((highest + 1, len(x)))
    P[m] = 1 if m == 0 else np.sqrt(1 - x * x)
    for n in range(m, highest):
        P[n + 1] = ((2 * n + 1) * x * P[n] - (n + m) * P[n - 1] * (n > m)) / (n - m + 1)
    return P


def wave_maker(K, mode, theta):
    """Φ₀ and its radial derivative on the unit sphere, (t,) complex"""
    r, z = np.sin(theta), -np.cos(theta)
    W, W_r = wave_integral(K, r, z)
    source, source_r, source_z = 1 / K, -r / K, -z / K  # 1/R and its slopes at R = 1, over K
    W_z = K * (source + W)
    if mode == HEAVE:
        return K * (source + W), K * (r * (source_r + W_r) + z * (source_z + W_z))
    W_rz = K * (source_r + W_r)
    W_rr = -(K * (source_z + W_z)) - W_r / r  # Laplace
    invert_rr, invert_rz = (3 * r * r - 1) / K, 3 * r * z / K
    return K * (source_r + W_r), K * (r * (invert_rr + W_rr) + z * (invert_rz + W_rz))


def wave_integral(K, r, z):
    """W and ∂W/∂r

    W(r, 0) = −½π (𝐇₀ + Y₀)(Kr) + iπ J₀(Kr); below, W = exp(Kz) (W(r, 0) − ∫₀^|z| exp(Kt) dt / √(r² + t²)),
    where t = r sinh s makes the integrand smooth.
    """
    x, w = np.polynomial.legendre.leggauss(120)
    top = np.arcsinh(-z / r)[:, None]
    s, w = top * (x + 1) / 2, top * w / 2
    decay = w * np.exp(K * (r[:, None] * np.sinh(s) + z[:, None]))
    W = np.exp(K * z) * (-np.pi / 2 * (struve(0, K * r) + y0(K * r)) + 1j * np.pi * j0(K * r))
    slope = -np.pi / 2 * (2 / np.pi - struve(1, K * r) - y1(K * r)) - 1j * np.pi * j1(K * r)
    W_r = K * np.exp(K * z) * slope + np.sum(decay / np.cosh(s) ** 2, axis=1) / r
    return W - decay.sum(axis=1), W_r
