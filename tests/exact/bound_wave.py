"""Amplitude of the long wave bound to a pair of waves, in fifty digits.

Longuet-Higgins and Stewart (1962), Sharma and Dean (1981), evaluated as printed with `decimal`: nearly equal waves,
whose differences cancel, leave more digits than a double holds.  Nothing of the product is used.
"""

from __future__ import annotations

from decimal import Decimal, getcontext

getcontext().prec = 50


def amplitude(one, two, angle, depth, gravity=9.80665):
    """m per m² of waves of frequencies `one`, `two` rad/s whose directions are `angle` rad apart"""
    one, two, angle, h, g = (Decimal(float(value)) for value in (one, two, angle, depth, gravity))
    (k, l), (K, L), difference = (_wavenumber(w, h, g) for w in (one, two)), (one**2 / g, two**2 / g), one - two
    q = difference * g**2 / (2 * one * two) * (k * l * _cosine(angle) + K * L)
    q += g**2 / 4 * ((k**2 - K**2) / one - (l**2 - L**2) / two)
    kappa = ((k - l) ** 2 + 2 * k * l * (1 - _cosine(angle))).sqrt()
    return float(-difference * q / (g * (g * kappa * _tanh(kappa * h) - difference**2)))


def _wavenumber(omega, h, g):
    """Newton's method from above, on a function that is convex there"""
    K = omega**2 / g
    k = K + (K / h).sqrt()
    for _ in range(12):
        t = _tanh(k * h)
        k -= (k * t - K) / (t + k * h * (1 - t * t))
    return k


def _tanh(x):
    e = (-2 * x).exp()
    return (1 - e) / (1 + e)


def _cosine(x):
    total = term = Decimal(1)
    for n in range(1, 60):
        term *= -x * x / (2 * n * (2 * n - 1))
        total += term
    return total
