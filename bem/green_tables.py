"""Tables of the Green function's wave part for one frequency, filled from exact forms (equations in `bem.green`).

Three forms fill them: an integral with few nodes where R < h/2, John's (1950) eigenfunction series beyond, and
the deep-water function

    F(X, Y) = PV∫ e^(−μY) J₀(μX)/(μ−1) dμ = −(π/2) e^(−Y)(H₀(X)+Y₀(X)) − ∫₀^Y e^(t−Y)/√(X²+t²) dt

(Kim 1965), which holds all of g₁ in infinite depth and its logarithm in any depth.  The integrals separate into a
factor of R and one of depth, so that a table is a product of two matrices.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import special

from .waves import group_factor, propagating_factor, wavenumber

# table spacing as a part of the length over which the function changes; cubic interpolation leaves
# (3/128) part⁴, that is 2e-6 of the wave and 1e-6 of the images
WAVE_PART, IMAGE_PART = 1 / 10, 1 / 12
LARGEST = 2e7  # entries of three values: half a gigabyte


class Table(NamedTuple):
    """What the pair kernel needs of one frequency; the last axis of each table is value, ∂/∂R, ∂/∂Y (or V)."""

    K: float  # ω²/g, the factor of the logarithm; zero for the limits, which have none
    k: float
    C: float  # factor of the propagating part; zero for the limits
    spacing: float
    surface: np.ndarray  # (R, Y, 3): g₁ outside r₁ = radius
    rest: np.ndarray  # (R, Y, 3): g₁ − 2K F inside
    bed: np.ndarray  # (R, V, 3): g₂
    bessel: np.ndarray  # (R, 2): J₀(kR), −k J₁(kR)
    radius: float


def wave_table(omega, depth, gravity, reach, draft):
    """Table of frequency `omega` rad/s for horizontal distances up to `reach` and points down to `draft` (m)."""
    K = omega * omega / gravity
    k = float(wavenumber(omega, depth, gravity))
    C = float(propagating_factor(omega, k, depth, gravity))
    radius = min(1 / K, 0.5 * depth, 0.1 * reach)
    spacing = min(WAVE_PART / k, IMAGE_PART * radius)
    function = None if np.isinf(depth) else _Wave(K, k, depth)
    return _fill(function, K, k, C, depth, radius, spacing, reach, draft)


def limit_table(which, depth, reach, draft):
    """Table of the limit "zero" (rigid lid) or "infinity" (φ = 0 on the surface) of the frequency.

    At zero frequency in finite depth G holds −(2/h) ln R and is fixed only up to a constant, which drops out of
    every mode without net flux.  At infinite frequency 1/r₁ counts negative, and g₁ is what is left of G without it.
    """
    radius = min(0.5 * depth, 0.1 * reach)
    function = _Rigid(depth) if which == "zero" else _Free(depth)
    return _fill(function, 0.0, 0.0, 0.0, depth, radius, IMAGE_PART * radius, reach, draft)


def _fill(function, K, k, C, depth, radius, spacing, reach, draft):
    reach, draft = 1.001 * reach + spacing, 1.001 * draft
    n = max(int(np.ceil(reach / spacing)) + 2, 5)
    if n * 3 * draft / spacing > LARGEST:
        raise ValueError(
            f"waves of {2 * np.pi / k:.3g} m are too short for a body {reach:.4g} m across and {draft:.3g} m deep: "
            f"their table would take {n * 72 * draft / spacing / 1e9:.2g} GB; leave out the highest frequencies"
        )
    R = spacing * np.arange(n)
    Y = spacing * np.arange(max(int(np.ceil(2 * draft / spacing)) + 2, 5))
    surface = _surface(function, K, depth, R, Y)
    small = spacing * np.arange(max(int(np.ceil(radius / spacing)) + 3, 5))
    if np.isinf(depth):
        rest = np.zeros((len(small), len(small), 3))
        bed = np.zeros((n, 4, 3))
    else:
        rest = _near(function.rest, function.rest_series, depth, small, small)
        V = spacing * np.arange(max(int(np.ceil(draft / spacing)) + 2, 5))
        bed = _near(function.bed, function.bed_series, depth, R, V)
    bessel = np.stack([special.j0(k * R), -k * special.j1(k * R)], axis=-1)
    return Table(K, k, C, spacing, surface, rest, bed, bessel, radius)


def _near(integral, series, depth, R, V):
    near = 0.5 * depth > R
    return np.concatenate([integral(R[near], V), series(R[~near], V)])


def _surface(function, K, depth, R, Y):
    """g₁ on the grid; the point R = Y = 0 is never used and left zero."""
    if np.isinf(depth):
        return deep_water(K, R, Y) if K > 0 else np.zeros((len(R), len(Y), 3))
    near = 0.5 * depth > R
    inner = function.rest(R[near], Y)
    if K > 0:
        inner += deep_water(K, R[near], Y)
    return np.concatenate([inner, function.surface_series(R[~near], Y)])


def deep_water(K, R, Y):
    """2K F(KR, KY) and its derivatives on a grid, R and Y equally spaced from 0; (R, Y, 3)."""
    X, y = K * R, K * Y
    step = y[1] - y[0]
    node, weight = np.polynomial.legendre.leggauss(10)
    node, weight = 0.5 * step * (node + 1), 0.5 * step * weight
    weight = weight * np.exp(node - step)
    F, FX = np.zeros((2, len(X), len(y)))
    x = X[1:]
    F[1:, 0] = -0.5 * np.pi * (special.struve(0, x) + special.y0(x))
    FX[1:, 0] = -0.5 * np.pi * (2 / np.pi - special.struve(1, x) - special.y1(x))
    for j in range(len(y) - 1):  # the integral carries on from level to level; its past decays
        square = x[:, None] ** 2 + (y[j] + node) ** 2
        F[1:, j + 1] = np.exp(-step) * F[1:, j] - (1 / np.sqrt(square)) @ weight
        FX[1:, j + 1] = np.exp(-step) * FX[1:, j] + x * (square**-1.5 @ weight)
    F[0, 1:] = _minus_exp_ei(y[1:])
    r = np.hypot(X[:, None], y[None, :])
    r[0, 0] = np.inf
    return 2 * K * np.stack([F, K * FX, K * (-F - 1 / r)], axis=-1)


def _minus_exp_ei(y):
    """−e^(−y) Ei(y), by its asymptotic series where Ei overflows."""
    big = y > 50
    out = np.empty_like(y)
    out[~big] = -np.exp(-y[~big]) * special.expi(y[~big])
    u = 1 / y[big]
    out[big] = -u * (1 + u * (1 + 2 * u * (1 + 3 * u * (1 + 4 * u * (1 + 5 * u * (1 + 6 * u))))))
    return out


def _panels(breaks, count=16):
    """Gauss nodes and weights on consecutive intervals."""
    node, weight = np.polynomial.legendre.leggauss(count)
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


def _combine(R, V, node, even, odd):
    """Σ even(μ,V) J₀(μR) with derivatives, `even`, `odd` (μ, V) being the weighted V factor and its ∂/∂V."""
    j0, j1 = special.j0(np.outer(R, node)), special.j1(np.outer(R, node))
    return np.stack([j0 @ even, -(j1 * node) @ even, j0 @ odd], axis=-1)


class _Wave:
    """f of one frequency and finite depth, as integrals for R < h/2 and as series beyond."""

    def __init__(self, K, k, depth):
        self.K, self.k, self.h = K, k, depth
        far = 40.0 / depth
        self.trapped = k * depth > 40  # the pole carries a factor e^(−2kh) and is left out with the rest
        if self.trapped:
            self.node, self.weight = _panels(_graded(0, far, far / 20, far / 20))
        else:
            self.node, self.weight = self._around(k, max(2 * k, far))
        self.modes = _evanescent(K, depth, 0.5 * depth)

    def _around(self, pole, end):
        """Nodes of a principal value: symmetric about the pole, graded away from it."""
        widest = 2 / self.h
        half = min(pole, widest)
        left = pole - np.array(_graded(0, pole - half, half, widest))[::-1] - half if pole > half else []
        right = _graded(pole + half, end, half, widest)
        breaks = [*left, pole - half, *right] if len(left) else [0.0, *right]
        return _panels(_distinct(breaks))

    def bed(self, R, V):
        """f(R, V) and derivatives, (R, V, 3)."""
        mu, h = self.node[:, None], self.h
        lower = self.weight[:, None] * (mu + self.K) * np.exp(-mu * h)
        scale = lower / ((mu - self.K) - (mu + self.K) * np.exp(-2 * mu * h))
        up, down = np.exp(mu * (V - h)), np.exp(-mu * (V + h))
        return _combine(R, V, self.node, scale * (up + down), scale * mu * (up - down))

    def rest(self, R, Y):
        """f(R, 2h−Y) − 1/r₁ − 2K F: what the bed adds to the deep-water function, (R, Y, 3)."""
        K, h = self.K, self.h
        if self.trapped:
            return self._difference(R, Y, self.node, self.weight)
        end = max(2 * self.k, 2 * K)
        mu, w = self._around(self.k, end)
        m = mu[:, None]
        a = w[:, None] * (m + K) / ((m - K) - (m + K) * np.exp(-2 * m * h))
        up, down = np.exp(-m * Y), np.exp(m * (Y - 4 * h))
        whole = _combine(R, Y, mu, a * (up + down), -a * m * (up - down))
        mu, w = self._around(K, end)
        m = mu[:, None]
        a = w[:, None] * (m + K) / (m - K) * np.exp(-m * Y)
        deep = _combine(R, Y, mu, a, -m * a)
        far = max(40 / h, 2 * end)
        mu, w = _panels(_graded(end, far, min(end, 2 / h), 2 / h))
        return whole - deep + self._difference(R, Y, mu, w)

    def _difference(self, R, Y, mu, w):
        K, h = self.K, self.h
        m = mu[:, None]
        bed = np.exp(-2 * m * h)
        a = w[:, None] * (m + K) / ((m - K) - (m + K) * bed)
        image = np.exp(m * (Y - 4 * h))
        direct = np.exp(-m * Y) * bed * (m + K) / (m - K)
        return _combine(R, Y, mu, a * (image + direct), a * m * (image - direct))

    def _series(self, R, V):
        """John's series for f(R, V) + 1/√(R²+V²), (R, V, 3)."""
        k, K, h = self.k, self.K, self.h
        c = 2 * np.pi * k * k / (2 * group_factor(k, h) * K) / (1 + np.exp(-2 * k * h)) ** 2
        up, down = np.exp(k * (V - 2 * h)), np.exp(-k * (V + 2 * h))
        y0, y1 = special.y0(k * R)[:, None], special.y1(k * R)[:, None]
        even, odd = -c * (up + down), -c * k * (up - down)
        wave = np.stack([y0 * even, -k * y1 * even, y0 * odd], axis=-1)
        return wave + _modes(R, V, *self.modes)

    def surface_series(self, R, Y):
        return _surface_from(self._series, R, Y, self.h)

    def bed_series(self, R, V):
        return self._series(R, V) - _inverse(R, V)

    def rest_series(self, R, Y):
        return self.surface_series(R, Y) - deep_water_points(self.K, R, Y)


def deep_water_points(K, R, Y):
    """As `deep_water`, for R > 0 that need not start at the axis."""
    full = np.concatenate([[0.0], R]) if len(R) else np.zeros(1)
    return deep_water(K, full, Y)[1:]


class _Rigid:
    """f of zero frequency in finite depth: no flow through the surface."""

    def __init__(self, depth):
        self.h = depth
        self.node, self.weight = _panels(_graded(0, 40 / depth, 1 / depth, 2 / depth))
        m = np.arange(1, 30) * np.pi / depth
        self.modes = m, np.full(m.shape, 2 / depth)

    def bed(self, R, V):
        mu, h = self.node[:, None], self.h
        a = self.weight[:, None] * np.exp(-mu * h) / -np.expm1(-2 * mu * h)
        up, down = np.exp(mu * (V - h)), np.exp(-mu * (V + h))
        out = _combine(R, V, self.node, a * (up + down), a * mu * (up - down))
        out[..., 0] -= np.sum(self.weight * np.exp(-self.node * h) / (self.node * h))
        return out

    def rest(self, R, Y):
        mu, h = self.node[:, None], self.h
        a = self.weight[:, None] / -np.expm1(-2 * mu * h)
        image, direct = np.exp(mu * (Y - 4 * h)), np.exp(-mu * (Y + 2 * h))
        out = _combine(R, Y, self.node, a * (image + direct), a * mu * (image - direct))
        out[..., 0] -= np.sum(self.weight * np.exp(-self.node * h) / (self.node * h))
        return out

    def _series(self, R, V):
        out = _modes(R, V, *self.modes)
        # ∫ (J₀(μR) − e^(−μh))/μ dμ = ln(2h/R) fixes the constant that the integrals subtract
        out[..., 0] += (np.log(2 * self.h / R) / self.h)[:, None]
        out[..., 1] -= (1 / (R * self.h))[:, None]
        return out

    def surface_series(self, R, Y):
        return _surface_from(self._series, R, Y, self.h)

    rest_series = surface_series

    def bed_series(self, R, V):
        return self._series(R, V) - _inverse(R, V)


class _Free:
    """f of infinite frequency in finite depth: φ = 0 on the surface; g₁ here is f + 1/r₁."""

    def __init__(self, depth):
        self.h = depth
        self.node, self.weight = _panels(_graded(0, 40 / depth, 1 / depth, 2 / depth))
        m = (np.arange(1, 30) - 0.5) * np.pi / depth
        self.modes = m, np.full(m.shape, 2 / depth)

    def bed(self, R, V):
        mu, h = self.node[:, None], self.h
        a = -self.weight[:, None] * np.exp(-mu * h) / (1 + np.exp(-2 * mu * h))
        up, down = np.exp(mu * (V - h)), np.exp(-mu * (V + h))
        return _combine(R, V, self.node, a * (up + down), a * mu * (up - down))

    def rest(self, R, Y):
        mu, h = self.node[:, None], self.h
        a = -self.weight[:, None] / (1 + np.exp(-2 * mu * h))
        image, direct = np.exp(mu * (Y - 4 * h)), np.exp(-mu * (Y + 2 * h))
        return _combine(R, Y, self.node, a * (image - direct), a * mu * (image + direct))

    def surface_series(self, R, Y):
        return _surface_from(self._series, R, Y, self.h) + 2 * _inverse(R, Y)

    rest_series = surface_series

    def _series(self, R, V):
        return _modes(R, V, *self.modes)

    def bed_series(self, R, V):
        return self._series(R, V) - _inverse(R, V)


def _distinct(breaks):
    breaks = np.asarray(breaks)
    return breaks[np.concatenate([[True], np.diff(breaks) > 1e-14 * breaks[-1]])]


def _inverse(R, V):
    """1/√(R²+V²) and its derivatives, (R, V, 3)."""
    square = R[:, None] ** 2 + V[None, :] ** 2
    one, three = square**-0.5, square**-1.5
    return np.stack([one, -R[:, None] * three, -V[None, :] * three], axis=-1)


def _surface_from(series, R, Y, h):
    """g₁ from the series of the whole function: f(R, 2h−Y) − 1/r₁, ∂/∂Y = −∂/∂V."""
    flip = np.array([1.0, 1.0, -1.0])
    V = 2 * h - Y
    return (series(R, V) - _inverse(R, V)) * flip - _inverse(R, Y)


def _evanescent(K, h, nearest):
    """k_m of k_m tan k_m h = −K and the factors of ½ cos k_m V K₀(k_m R) that matter beyond `nearest` (m)."""
    count = int(np.ceil(36 * h / (np.pi * nearest))) + 1
    m = np.arange(1, count + 1)
    # x tan x = −Kh on ((m−½)π, mπ): with x = mπ − y, (mπ − y) tan y = Kh, y in (0, π/2)
    y = np.arctan2(K * h, m * np.pi)
    for _ in range(60):
        step = (np.arctan2(K * h, m * np.pi - y) - y) / (1 - K * h / ((m * np.pi - y) ** 2 + (K * h) ** 2))
        y = np.clip(y + step, 0.0, 0.5 * np.pi)
        if np.all(np.abs(step) <= 4e-16 * m * np.pi):
            break
    km = (m * np.pi - y) / h
    return km, 2 * (km**2 + K * K) / ((km**2 + K * K) * h - K)


def _modes(R, V, km, factor):
    k0, k1 = special.k0(np.outer(R, km)), special.k1(np.outer(R, km))
    cos, sin = factor[:, None] * np.cos(np.outer(km, V)), (factor * km)[:, None] * np.sin(np.outer(km, V))
    return np.stack([k0 @ cos, -(k1 * km) @ cos, -(k0 @ sin)], axis=-1)
