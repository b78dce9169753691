"""Regular water waves of small amplitude over a flat bed.

    φ_I = −(i g/ω) cosh k(z+h)/cosh kh · exp(ik(x cosβ + y sinβ)),    K = ω²/g = k tanh kh

per unit amplitude, time factor exp(−iωt).
"""

import numpy as np


def wavenumber(omega, depth, gravity=9.80665):
    """k of K = ω²/g = k tanh kh.

    omega : (...,) rad/s, depth : m (may be inf)
    returns : (...,) rad/m; relative error below 1e-15 for every depth
    """
    K = np.asarray(omega, float) ** 2 / gravity
    if np.isinf(depth):
        return K
    y = K * depth
    still, y = y == 0, np.maximum(y, 1e-300)
    x = y / np.sqrt(np.tanh(y))  # Eckart (1952), within 5 % at every depth
    for _ in range(4):  # Newton squares the error: 5e-2, 5e-4, 7e-8, 2e-15, rounding
        t = np.tanh(x)
        x = x - (x * t - y) / (t + x * (1.0 - t * t))
    return np.where(still, 0.0, x / depth)[()]


def depth_factor(z, k, depth):
    """cosh k(z+h) / cosh kh, written so that nothing overflows in deep water."""
    if np.isinf(depth):
        return np.exp(k * z)
    return np.exp(k * z) * (1 + np.exp(-2 * k * (z + depth))) / (1 + np.exp(-2 * k * depth))


def depth_factor_slope(z, k, depth):
    """∂/∂z of `depth_factor`: k sinh k(z+h) / cosh kh."""
    if np.isinf(depth):
        return k * np.exp(k * z)
    return -k * np.exp(k * z) * np.expm1(-2 * k * (z + depth)) / (1 + np.exp(-2 * k * depth))


def depth_values(k, depth):
    """`depth_factor` Z and its slope Z′, 1/m, at z (…) m, from two exponentials; shape (…, 2)"""

    def values(z):
        down = np.exp(k * z)
        if np.isinf(depth):
            return np.stack([down, k * down], axis=-1)
        down, bed = down / (1 + np.exp(-2 * k * depth)), np.expm1(-2 * k * (z + depth))
        return np.stack([down * (2 + bed), -k * down * bed], axis=-1)

    return values


def group_factor(k, depth):
    """n = C_g / C = ½ (1 + 2kh / sinh 2kh), which is ½ in deep water and 1 in shallow water."""
    if np.isinf(depth):
        return np.full_like(np.asarray(k, float), 0.5)
    x = 2 * np.asarray(k, float) * depth
    e = np.exp(-x)
    with np.errstate(invalid="ignore"):
        ratio = np.where(x > 0, 2 * x * e / -np.expm1(-2 * x), 1.0)
    return 0.5 * (1 + ratio)


def incident_wave(points, beta, omega, k, depth, gravity=9.80665):
    """Potential and velocity of a wave of unit amplitude travelling towards `beta`.

    points : (..., 3) m
    returns : φ_I (...,) m²/s per m, ∇φ_I (..., 3) m/s per m; complex
    """
    points = np.asarray(points, float)
    x, y, z = np.moveaxis(points, -1, 0)
    c, s = np.cos(beta), np.sin(beta)
    phase = -1j * gravity / omega * np.exp(1j * k * (x * c + y * s))
    phi = phase * depth_factor(z, k, depth)
    slope = phase * depth_factor_slope(z, k, depth)
    return phi, np.stack([1j * k * c * phi, 1j * k * s * phi, slope], axis=-1)


def exponential_part(sign, phase):
    """The even part (sign 1) or odd part (sign −1) of exp(i phase), or exp(i phase) itself (sign 0), and the
    derivative"""
    factor, value, slope = real_part(sign, phase)
    return factor * value, factor * slope


def real_part(sign, phase):
    """`exponential_part` as a product of a factor and values; the values are real for sign 1 and −1"""
    if sign == 0:
        whole = np.exp(1j * phase)
        return 1.0, whole, 1j * whole
    cosine, sine = np.cos(phase), np.sin(phase)
    return (1.0, cosine, -sine) if sign == 1 else (1j, sine, cosine)


def propagating_factor(omega, k, depth, gravity=9.80665):
    """C = 2πk²/((k²−K²)h + K) = πk²/(nK): the Green function's wave is i C Z(z) Z(ζ) H₀⁽¹⁾(kR)."""
    return np.pi * k * k / (group_factor(k, depth) * omega**2 / gravity)
