"""Vertical circular cylinder standing on the sea bed.

MacCamy and Fuchs (1954): on the cylinder the incident and diffracted waves together are

    φ = −(i g/ω) cosh k(z+h)/cosh kh Σ εₘ iᵐ · 2i / (π ka Hₘ'(ka)) · cos m(θ − β),

and the disturbance far away η ~ √(2/πkr) exp(i(kr − π/4)) H(θ), H = −Σ εₘ Jₘ'(ka)/Hₘ'(ka) cos m(θ − β).
Time factor exp(−iωt), per unit amplitude; moments about the centre of the waterplane.
"""

from __future__ import annotations

import numpy as np
from scipy.special import h1vp, hankel1, jvp, kve

from .water_waves import evanescent_wavenumbers, group_factor, wavenumber


def excitation(radius, depth, omega, beta=0.0, density=1025.0, gravity=9.80665):
    """(6,) N/m and N m/m, complex"""
    k = wavenumber(omega, depth, gravity)
    scale = 4 * density * gravity / (k**2 * h1vp(1, k * radius))
    surge = scale * np.tanh(k * depth)
    pitch = -scale * (1 - 1 / np.cosh(k * depth)) / k
    c, s = np.cos(beta), np.sin(beta)
    return np.array([surge * c, surge * s, 0, -pitch * s, pitch * c, 0])


def drift(radius, depth, omega, beta=0.0, density=1025.0, gravity=9.80665):
    """Mean (Fx, Fy) per amplitude squared, N/m², from the waves far away"""
    k = wavenumber(omega, depth, gravity)
    h = harmonics(k * radius)
    scale = 2 * density * gravity / k * group_factor(k, depth)
    force = scale * (-h[0].real - 2 * h[1:].real.sum() - 2 * np.sum(h[:-1] * h[1:].conj()).real)
    return force * np.array([np.cos(beta), np.sin(beta)])


def harmonics(x):
    """Coefficient of exp(im(θ − β)) in H for m = 0, 1, … until they vanish; x = ka"""
    m = np.arange(int(np.ceil(x + 6 * np.cbrt(x) + 8)) + 1)
    return -jvp(m, x) / h1vp(m, x)


def surge_radiation(radius, depth, omega, density=1025.0, gravity=9.80665, modes=2000):
    """Added mass (kg) and damping (kg/s) in surge; the error falls like modes⁻⁴."""
    k = wavenumber(omega, depth, gravity)
    kn = evanescent_wavenumbers(omega, depth, modes, gravity)
    x = kn * radius
    ratios = -1 / (kn * (kve(0, x) / kve(1, x) + 1 / x))
    norms = depth / 2 * (1 + np.sin(2 * kn * depth) / (2 * kn * depth))
    local = np.sum(ratios * (np.sin(kn * depth) / kn) ** 2 / norms)
    ratio = hankel1(1, k * radius) / (k * h1vp(1, k * radius))
    wave = ratio * np.tanh(k * depth) / (k * group_factor(k, depth))
    impedance = -density * np.pi * radius * (wave + local)
    return impedance.real, impedance.imag * omega
