"""Exact forms of the finite-depth Green function that fill its tables (equations in `bem.green.finite_depth`).

The forms are a quadrature of the integral for R < h/2, and John's (1950) eigenfunction series for larger R.
Every term is a product of a function of R and a function of a depth, so a table is a product of two matrices.
The classes for positive, zero and infinite frequency have these members:

    near(R, Y, V)   g₁ − 2KF at (R, Y) and g₂ at (R, V), which are smooth up to the next images in surface and bed
    modes           wavenumbers km, and factors in E(R, V) = Σ factor K₀(km R) cos(km V), f = E + the propagating wave
    net             factor of ln(2h/R) in E
    mirror          sign of 1/r₁ in G
"""

import math
from functools import cache

import numpy as np
from scipy import special


def _gauss_intervals(breaks, digits):
    """Gauss nodes and weights on consecutive intervals.

    The nearest pole is 1.57 half-widths away: the error is 3.4^(−2n) for n nodes.  n is even, so that no node lies in
    the middle of an interval, where the pole of a principal value is.
    """
    node, weight = _gauss(2 * math.ceil(digits / 4.4))
    breaks = np.asarray(breaks)
    half = 0.5 * np.diff(breaks)[:, None]
    middle = 0.5 * (breaks[1:] + breaks[:-1])[:, None]
    return (middle + half * node).ravel(), (half * weight).ravel()


def _graded(a, b, first, widest):
    """Breaks from a to b, growing twofold from `first` up to `widest`."""
    breaks, width = [a], first
    while breaks[-1] < b:
        breaks.append(min(breaks[-1] + width, b))
        width = min(2 * width, widest)
    return breaks


@cache
def _gauss(order):
    return np.polynomial.legendre.leggauss(order)


def _principal_value_nodes(pole, end, widest, digits):
    """Nodes of a principal value from 0 to `end`: symmetric about the pole, graded away from it."""
    half = min(pole, widest)
    if half < pole:
        left = [pole - b for b in _graded(half, pole, half, widest)][::-1]
        left[0] = 0.0
    else:
        left = [0.0]
    right = _graded(pole + half, max(end, pole + half), half, widest)
    return _gauss_intervals(left + right, digits)


class PositiveFrequency:
    """0 < ω < ∞; K = ω²/g, 1/m; k : wavenumber, rad/m; depth : m; digits : −ln of the allowed truncation error"""

    net, mirror = 0.0, 1.0

    def __init__(self, K, k, depth, digits):
        self.K, self.k, self.h = K, k, depth
        far = digits / depth
        if k > far:  # waves beyond this have a factor e^(−kh), negligible except for the deep-water function
            self.whole = self.deep = None
            self.tail = _gauss_intervals(_graded(0.0, far, 2 / depth, 2 / depth), digits)
        else:
            end = max(2 * k, 2 * K)
            self.whole, self.deep = (_principal_value_nodes(pole, end, 2 / depth, digits) for pole in (k, K))
            breaks = _graded(end, far, min(end, 2 / depth), 2 / depth)
            self.tail = _gauss_intervals(breaks, digits) if far > end else None

    def near(self, R, Y, V):
        K, h = self.K, self.h
        surface, bed = np.zeros((len(R), len(Y))), np.zeros((len(R), len(V)))
        for part in (self.whole, self.tail):
            if part is None:
                continue
            mu, w = part[0][:, None], part[1][:, None]
            decay = np.exp(-2 * mu * h)
            a = w * (mu + K) / (-mu * np.expm1(-2 * mu * h) - K * (1 + decay))
            # the deep-water integrand is subtracted: in the same quadrature beyond the poles, in its own up to them
            direct = 1.0 if part is self.whole else (mu + K) / (mu - K) * decay
            j0 = special.j0(R[:, None] * part[0])
            surface += j0 @ (a * (direct * np.exp(-mu * Y) + np.exp(mu * (Y - 4 * h))))
            bed += j0 @ (a * (np.exp(mu * (V - 2 * h)) + np.exp(-mu * (V + 2 * h))))
        if self.deep is not None:
            mu, w = self.deep[0][:, None], self.deep[1][:, None]
            surface -= special.j0(R[:, None] * self.deep[0]) @ (w * (mu + K) / (mu - K) * np.exp(-mu * Y))
        return surface, bed

    def modes(self, count):
        """Roots km of km tan(km h) = −K, and their factors"""
        K, h = self.K, self.h
        m = np.arange(1, count + 1) * np.pi
        # x tan x = −Kh on ((m−½)π, mπ): with x = mπ − y, (mπ − y) tan y = Kh, y in (0, π/2)
        y = np.arctan2(K * h, m)
        for _ in range(60):
            step = (np.arctan2(K * h, m - y) - y) / (1 - K * h / ((m - y) ** 2 + (K * h) ** 2))
            y = np.clip(y + step, 0.0, 0.5 * np.pi)
            if np.all(np.abs(step) <= 4e-16 * m):
                break
        km = (m - y) / h
        return km, 2 * (km**2 + K * K) / ((km**2 + K * K) * h - K)


class ZeroFrequency:
    """ω = 0, ∂φ/∂z = 0 on the surface; G is defined up to a constant, which the regularised integrals determine
    here."""

    mirror = 1.0

    def __init__(self, depth, digits):
        self.h, self.net = depth, 1 / depth
        self.node, self.weight = _gauss_intervals(_graded(0.0, digits / depth, 1 / depth, 2 / depth), digits)

    def near(self, R, Y, V):
        mu, h = self.node[:, None], self.h
        a = self.weight[:, None] / -np.expm1(-2 * mu * h)
        constant = np.sum(self.weight * np.exp(-self.node * h) / (self.node * h))
        j0 = special.j0(R[:, None] * self.node)
        surface = j0 @ (a * (np.exp(mu * (Y - 4 * h)) + np.exp(-mu * (Y + 2 * h))))
        bed = j0 @ (a * (np.exp(mu * (V - 2 * h)) + np.exp(-mu * (V + 2 * h))))
        return surface - constant, bed - constant

    def modes(self, count):
        m = np.arange(1, count + 1) * np.pi / self.h
        return m, np.full(m.shape, 2 / self.h)


class InfiniteFrequency:
    """ω = ∞, φ = 0 on the surface: G = 1/r + 1/r₂ − 1/r₁ + g₁ + g₂."""

    net, mirror = 0.0, -1.0

    def __init__(self, depth, digits):
        self.h = depth
        self.node, self.weight = _gauss_intervals(_graded(0.0, digits / depth, 1 / depth, 2 / depth), digits)

    def near(self, R, Y, V):
        mu, h = self.node[:, None], self.h
        a = -self.weight[:, None] / (1 + np.exp(-2 * mu * h))
        j0 = special.j0(R[:, None] * self.node)
        surface = j0 @ (a * (np.exp(mu * (Y - 4 * h)) - np.exp(-mu * (Y + 2 * h))))
        bed = j0 @ (a * (np.exp(mu * (V - 2 * h)) + np.exp(-mu * (V + 2 * h))))
        return surface, bed

    def modes(self, count):
        m = (np.arange(1, count + 1) - 0.5) * np.pi / self.h
        return m, np.full(m.shape, 2 / self.h)
