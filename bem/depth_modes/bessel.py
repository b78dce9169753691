"""Bessel functions of the keel gap: Jᵥ₊₂ₚ(x), scaled so that the first is 1 at x = 0.

    jₚ(x) = 2^ν Γ(1+ν) J_{ν+2p}(x) / x^ν,     p = 0 … P−1,  ν > 0

Below x = 25 + 2P the recurrence runs downward, in which direction it is stable, and Σ cₖ J_{ν+2k} = (x/2)^ν / Γ(1+ν),
cₖ = (ν+2k) Γ(ν+k) / k! Γ(1+ν), gives the scale (DLMF 10.23.15; Miller's algorithm).  Above x = 25 + 2P Hankel's
expansion (DLMF 10.17.3) starts the upward recurrence.  The absolute error is below 1e-14 / x^(ν+½), measured for ν ≤
1.
"""

import math

import numpy as np

from ..kernels.jit import kernel


def scaled_bessel(orders, x, terms):
    """jₚ of every order at x > 0; shape (orders, terms, x)"""
    out = np.empty((len(orders), terms, len(x)))
    _scaled(orders, x, np.empty(terms), out)
    return out


@kernel()
def _scaled(orders, x, column, out):
    """column : (terms,), workspace"""
    terms = len(column)
    for i in range(len(orders)):
        scale = 2 ** orders[i] * math.gamma(1 + orders[i])
        for n in range(len(x)):
            if x[n] < 25 + 2 * terms:
                factor = 1.0
                _downward(orders[i], x[n], column)
            else:
                factor = scale / x[n] ** orders[i]
                _upward(orders[i], x[n], column)
            for p in range(terms):
                out[i, p, n] = factor * column[p]


@kernel()
def _downward(nu, x, out):
    terms = len(out)
    last = terms + int(0.75 * x) + 12
    above, here, total = 0.0, 1e-300, 0.0
    c = _normalisation(nu, last)
    for k in range(last, -1, -1):  # here is J of order ν + 2k
        total += c * here
        if k < terms:
            out[k] = here
        if k > 0:
            below = 2 * (nu + 2 * k) / x * here - above
            above, here = below, 2 * (nu + 2 * k - 1) / x * below - here
            c *= (nu + 2 * k - 2) * k / ((nu + 2 * k) * (nu + k - 1))
            if abs(here) > 1e200:
                above, here, total = above * 1e-200, here * 1e-200, total * 1e-200
                for p in range(min(k, terms), terms):
                    out[p] *= 1e-200
    for p in range(terms):
        out[p] /= total


@kernel()
def _normalisation(nu, k):
    c = 1.0
    for j in range(k):
        c *= (nu + 2 * j + 2) * (nu + j) / ((nu + 2 * j) * (j + 1))
    return c


@kernel()
def _upward(nu, x, out):
    low, high = _hankel(nu, x), _hankel(nu + 1, x)
    for p in range(len(out)):
        out[p] = low
        low = 2 * (nu + 2 * p + 1) / x * high - low
        high = 2 * (nu + 2 * p + 2) / x * low - high


@kernel()
def _hankel(nu, x):
    even, odd, term = 1.0, 0.0, 1.0
    for k in range(1, 30):
        term *= (4 * nu * nu - (2 * k - 1) ** 2) / (8 * k * x)
        if k % 2 == 1:
            odd += term if k % 4 == 1 else -term
        else:
            even += term if k % 4 == 0 else -term
        if abs(term) < 1e-17:
            break
    angle = x - (0.5 * nu + 0.25) * math.pi
    return math.sqrt(2 / (math.pi * x)) * (even * math.cos(angle) - odd * math.sin(angle))
