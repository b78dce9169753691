"""The deep-water function and the Bessel functions of the wave, tabulated once for every frequency.

    F(X, Y) = PV∫ e^(−μY) J₀(μX)/(μ−1) dμ = −π e^(−Y) Y₀(X) + N(X, Y),   N = −∫₀^∞ e^(−s) (X² + (Y−s)²)^(−½) ds

(Kim 1965; Newman 1985), ∂F/∂Y = −F − 1/r, r² = X² + Y², c = Y/r.  Four ranges:

    r < 1           F + e^(−Y) J₀(X) ln r is smooth in r and c
    r < 4           F is smooth in r and c
    X, Y < 32       F is smooth in X and Y
    beyond          N = −Σ n! Pₙ(c)/r^(n+1), smooth in 1/r and c; the wave is left to the caller

all as pieces of degree 7; error of F below 1e-10 of |F| + 1/r, measured in tests/bem/test_green.py.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from scipy import special

from .green_pieces import fitted, fitted_line, look, look_line, sample_points
from .jit import kernel

FAR = 32.0  # where the asymptotic series is good to 24!/32²⁴ = 5e-13
POLAR_RINGS, POLAR_SECTORS = 16, 8  # r of 0 … 4, c of 0 … 1
FAR_RINGS, FAR_SECTORS = 4, 4  # 32/r and c of 0 … 1
COLUMNS, ROWS = 64, 32  # X by halves, Y by ones: only F_X is differentiated
FAR_START = POLAR_RINGS * POLAR_SECTORS
SQUARE_START = FAR_START + FAR_RINGS * FAR_SECTORS
EULER = 0.5772156649015329


class Universal(NamedTuple):
    """What holds for every frequency."""

    deep: np.ndarray  # (pieces, 8, 8): rings, the far range, the square
    bessel: np.ndarray  # (64, 8, 2): J₀ and Y₀ of x by halves; below 4 without (2/π) J₀ ln x


@cache
def universal():
    """The tables, made on first use (15 ms)."""
    return Universal(np.concatenate([_polar(), _far(), _square()]), _bessel_lines())


def exact(X, Y, order=24):
    """F by quadrature in u, s = Y + X sinh u; X > 0 and 0 ≤ Y ≤ 4 of one shape."""
    u0 = -np.arcsinh(Y / X)
    width = (np.arcsinh((45 - Y) / X) - u0) / 6
    node, weight = np.polynomial.legendre.leggauss(order)
    steps = (np.arange(6)[:, None] + 0.5 * (node + 1)).ravel()
    u = u0[..., None] + width[..., None] * steps
    integral = np.exp(-(Y[..., None] + X[..., None] * np.sinh(u))) @ np.tile(0.5 * weight, 6) * width
    return -np.pi * np.exp(-Y) * special.y0(X) - integral


def _polar():
    r = sample_points(np.linspace(0, 4, POLAR_RINGS + 1))
    c = sample_points(np.linspace(0, 1, POLAR_SECTORS + 1))
    Y = r[:, None] * c
    X = r[:, None] * np.sqrt(1 - c * c)
    F = exact(X, Y)
    inside = np.exp(-Y) * special.j0(X) * np.log(r[:, None])
    return fitted(F + np.where(r[:, None] < 1, inside, 0.0))


def _far():
    """r N + 1 in u = 32/r and c, by n! Pₙ(c): N + 1/r is needed to all digits."""
    u = sample_points(np.linspace(0, 1, FAR_RINGS + 1))
    c = sample_points(np.linspace(0, 1, FAR_SECTORS + 1))
    n = np.arange(1, 25)
    size = special.factorial(n) * (u[:, None] / FAR) ** n
    return fitted(-size @ np.array([special.eval_legendre(i, c) for i in n]))


def _square():
    """F in X and Y: the integral carries on from level to level, its past decays."""
    X = sample_points(np.linspace(0, FAR, COLUMNS + 1))
    Y = sample_points(np.arange(ROWS + 1.0)).reshape(ROWS, 8)
    t, W = _level_weights(np.append(Y[0], 1.0))
    F = np.zeros((len(X), ROWS, 8))
    for part, first in ((X < 3, 2), (X >= 3, 0)):  # below both r < 4: never used
        x = X[part]
        now = exact(x, np.full(len(x), float(first)))
        for j in range(first, ROWS):
            add = (x[:, None] ** 2 + (j + t) ** 2) ** -0.5 @ W.T
            F[part, j] = np.exp(j - Y[j]) * now[:, None] - add[:, :-1]
            now = math.exp(-1) * now - add[:, -1]
    return fitted(F.reshape(len(X), -1))


def _level_weights(y, order=16):
    """Gauss nodes t of (0, 1) and weights W (y, t) of ∫₀^y e^(t−y) q(t) dt."""
    node, weight = np.polynomial.legendre.leggauss(order)
    legendre = np.polynomial.legendre.legvander
    inner = 0.5 * y[:, None] * (node + 1)
    scaled = 0.5 * y[:, None] * weight * np.exp(inner - y[:, None])
    moments = np.einsum("yt,ytk->yk", scaled, legendre(2 * inner - 1, order - 1))
    return 0.5 * (node + 1), moments @ np.linalg.inv(legendre(node, order - 1))


def _bessel_lines():
    x = sample_points(np.linspace(0, FAR, 65))
    j0, y0 = special.j0(x), special.y0(x)
    return fitted_line(np.stack([j0, y0 - np.where(x < 4, 2 / np.pi * j0 * np.log(x), 0.0)], axis=-1))


@kernel()
def bessel(x, lines, both):
    """J₀, Y₀ and their derivatives −J₁, −Y₁ at x ≥ 0; unless `both`, the second two are without their logarithm."""
    if x < 32.0:
        n = int(2 * x)
        j, dj, y, dy = look_line(lines, n, 4 * x - 2 * n - 1)
        dj, dy = 4 * dj, 4 * dy
        if both and x < 4.0:
            x = max(x, 1e-300)
            log = 2 / math.pi * math.log(x)
            y += log * j
            dy += log * dj + 2 / math.pi * j / x
        return j, y, dj, dy
    # Hankel's expansion (DLMF 10.17.3) with θ = x − π/4
    turns = math.floor(x * (2 / math.pi) + 0.5)
    a = x - turns * (0.5 * math.pi)
    a2 = a * a
    sine = a * (1 - a2 * (1 / 6 - a2 * (1 / 120 - a2 * (1 / 5040 - a2 * (1 / 362880 - a2 / 39916800)))))
    cosine = 1 - a2 * (0.5 - a2 * (1 / 24 - a2 * (1 / 720 - a2 * (1 / 40320 - a2 * (1 / 3628800 - a2 / 479001600)))))
    quarter = int(turns) & 3
    if quarter & 1:
        sine, cosine = cosine, -sine
    if quarter & 2:
        sine, cosine = -sine, -cosine
    v = 1 / x
    u = v * v
    size = math.sqrt(v * (1 / math.pi))  # √(2/πx) and the √½ of θ
    p = 1 - u * (0.0703125 - u * (0.112152099609375 - u * (0.5725014209747314 - u * 6.074042001273483)))
    q = -v * (0.125 - u * (0.0732421875 - u * (0.22710800170898438 - u * 1.7277275025844574)))
    s = 1 + u * (0.1171875 - u * (0.1441955566406250 - u * (0.6765925884246826 - u * 6.883914268109947)))
    t = v * (0.375 - u * (0.1025390625 - u * (0.2775764465332031 - u * 1.993531733751297)))
    plus, minus = cosine + sine, sine - cosine  # √2 cos θ, √2 sin θ
    j0, y0 = size * (p * plus - q * minus), size * (p * minus + q * plus)
    j1, y1 = size * (s * minus + t * plus), size * (t * minus - s * plus)
    return j0, y0, -j1, -y1


@kernel()
def deep_water(X, Y, pieces):
    """F, ∂F/∂X and r; beyond FAR N in place of F, with 1 as the fourth value; pieces : address."""
    square = X * X + Y * Y
    r = math.sqrt(square)
    if square >= 16.0 and X < 32.0 and Y < 32.0:
        i, j = int(2 * X), int(Y)
        F, slope, _ = look(pieces, SQUARE_START + j * COLUMNS + i, 4 * X - 2 * i - 1, 2 * (Y - j) - 1)
        return F, 4 * slope, F + 1 / r, 0.0
    inverse = 1 / r
    c = Y * inverse
    if square < 16.0:
        i, j = int(4 * r), min(int(POLAR_SECTORS * c), POLAR_SECTORS - 1)
        F, by_r, by_c = look(pieces, j * POLAR_RINGS + i, 8 * r - 2 * i - 1, 2 * (POLAR_SECTORS * c - j) - 1)
        FX = (8 * by_r - 2 * POLAR_SECTORS * by_c * c * inverse) * X * inverse
        if square < 1.0:
            q = 0.25 * X * X
            decay = math.exp(-Y)
            j0 = decay * (1 - q * (1 - q * (1 / 4 - q * (1 / 36 - q * (1 / 576 - q * (1 / 14400 - q / 518400))))))
            j1 = 0.5 * decay * (1 - q * (1 / 2 - q * (1 / 12 - q * (1 / 144 - q * (1 / 2880 - q / 86400)))))
            log = 0.5 * math.log(square)
            F -= j0 * log
            FX += X * (j1 * log - j0 * inverse * inverse)
        return F, FX, F + inverse, 0.0
    u = FAR * inverse
    i, j = min(int(FAR_RINGS * u), FAR_RINGS - 1), min(int(FAR_SECTORS * c), FAR_SECTORS - 1)
    x, y = 2 * (FAR_RINGS * u - i) - 1, 2 * (FAR_SECTORS * c - j) - 1
    M, by_u, by_c = look(pieces, FAR_START + j * FAR_RINGS + i, x, y)
    rest = M * inverse
    N = rest - inverse
    return N, -(N + 2 * (FAR_RINGS * u * by_u + FAR_SECTORS * c * by_c) * inverse) * X * inverse * inverse, rest, 1.0
