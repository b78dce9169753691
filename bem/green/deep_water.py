"""The Green function of deep water without its 1/r terms, and Bessel functions, tabulated once for all frequencies.

    F(X, Y) = PV∫ e^(−μY) J₀(μX)/(μ−1) dμ = −π e^(−Y) Y₀(X) + N(X, Y),   N = −∫₀^∞ e^(−s) (X² + (Y−s)²)^(−½) ds

(Kim 1965; Newman 1985), ∂F/∂Y = −F − 1/r, r² = X² + Y², c = Y/r.  Four ranges:

    r < 1           F + e^(−Y) J₀(X) ln r is smooth in r and c
    r < 4           F is smooth in r and c
    X, Y < 32       F is smooth in X and Y
    beyond          N = −Σ n! Pₙ(c)/r^(n+1), smooth in 1/r and c; the caller adds the wave −π e^(−Y) Y₀(X)

In each range piecewise polynomials of degree 7 in both variables approximate these functions. The error of F,
measured in tests/bem/green/test_green.py, is below 1e-10 of |F| + 1/r.
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from scipy import special

from ..kernels.jit import kernel
from ..kernels.simd import bits_to_float, float_to_bits
from .piecewise_polynomials import aligned, evaluate_line, evaluate_piece, fit_line, fit_pieces, sample_points

FAR = 32.0  # distance with an error of the asymptotic series of 24!/32²⁴ = 5e-13
POLAR_RINGS, POLAR_SECTORS = 16, 8  # r of 0 … 4, c of 0 … 1
FAR_RINGS, FAR_SECTORS = 4, 4  # 32/r and c of 0 … 1
COLUMNS, ROWS = 64, 32  # X by halves, Y by ones: only F_X is differentiated
FAR_START = POLAR_RINGS * POLAR_SECTORS
SQUARE_START = FAR_START + FAR_RINGS * FAR_SECTORS
# the Bessel functions' pieces: eighths of octaves from SMALLEST to 2, then halves
FIRST_OCTAVE = -40
SMALLEST, OCTAVE_PIECES = 2.0**FIRST_OCTAVE, 8 * (1 - FIRST_OCTAVE)
# the bits of a number: FIRST_EIGHTH are exponent and first three of the fraction of SMALLEST, ONE all 64 of 1.0
FIRST_EIGHTH, FRACTION, ONE = 8 * (1023 + FIRST_OCTAVE), (1 << 52) - 1, 1023 << 52


class UniversalTables(NamedTuple):
    """Tables that are valid at every frequency: coefficients of `bem.green.piecewise_polynomials`"""

    deep: np.ndarray  # (pieces, 8, 8): rings, the far range, the square
    bessel: np.ndarray  # (pieces, 4, 8): J₀, Y₀, −J₁, −Y₁


@cache
def universal():
    """The tables, made on first use (15 ms)."""
    return UniversalTables(aligned(np.concatenate([_polar(), _far(), _square()])), aligned(_bessel_lines()))


def exact(X, Y, order=24):
    """F by Gauss quadrature in u, with s = Y + X sinh u in the integral; X > 0 and 0 ≤ Y ≤ 4 of one shape"""
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
    return fit_pieces(F + np.where(r[:, None] < 1, inside, 0.0))


def _far():
    """r N + 1 in u = 32/r and c, by n! Pₙ(c): N + 1/r is needed to all digits."""
    u = sample_points(np.linspace(0, 1, FAR_RINGS + 1))
    c = sample_points(np.linspace(0, 1, FAR_SECTORS + 1))
    n = np.arange(1, 25)
    size = special.factorial(n) * (u[:, None] / FAR) ** n
    return fit_pieces(-size @ np.array([special.eval_legendre(i, c) for i in n]))


def _square():
    """F on the grid of X and Y: F(X, Y + t) = e^(−t) F(X, Y) − ∫₀ᵗ e^(s−t) / r(X, Y + s) ds from level to level"""
    X = sample_points(np.linspace(0, FAR, COLUMNS + 1))
    Y = sample_points(np.arange(ROWS + 1.0)).reshape(ROWS, 8)
    t, W = _level_weights(np.append(Y[0], 1.0))
    F = np.zeros((len(X), ROWS, 8))
    for part, first in ((X < 3, 2), (X >= 3, 0)):  # rows before `first` have r < 4 and are never used
        x = X[part]
        now = exact(x, np.full(len(x), float(first)))
        for j in range(first, ROWS):
            add = (x[:, None] ** 2 + (j + t) ** 2) ** -0.5 @ W.T
            F[part, j] = np.exp(j - Y[j]) * now[:, None] - add[:, :-1]
            now = math.exp(-1) * now - add[:, -1]
    return fit_pieces(F.reshape(len(X), -1))


def _level_weights(y, order=16):
    """Gauss nodes t of (0, 1) and weights W (y, t) of ∫₀^y e^(t−y) q(t) dt."""
    node, weight = np.polynomial.legendre.leggauss(order)
    legendre = np.polynomial.legendre.legvander
    inner = 0.5 * y[:, None] * (node + 1)
    scaled = 0.5 * y[:, None] * weight * np.exp(inner - y[:, None])
    moments = np.einsum("yt,ytk->yk", scaled, legendre(2 * inner - 1, order - 1))
    return 0.5 * (node + 1), moments @ np.linalg.inv(legendre(node, order - 1))


def _bessel_lines():
    octaves = 2.0 ** np.arange(FIRST_OCTAVE, 1)[:, None] * (1 + np.arange(8) / 8)
    x = sample_points(np.concatenate([octaves.ravel(), np.arange(4, 2 * FAR + 1) / 2]))
    return fit_line(np.stack([special.j0(x), special.y0(x), -special.j1(x), -special.y1(x)], axis=-1))


@kernel(inline=True)
def bessel(x, lines):
    """J₀, Y₀ and their derivatives −J₁, −Y₁ at x ≥ 0; Y₀ and Y₁ at x ≥ SMALLEST.

    Below x = 2 the pieces are eighths of octaves, so that the polynomials include the logarithm and 1/x of Y₀ and Y₁;
    the separate computation of these terms would cost 8 ns.
    """
    if x < 32.0:
        if x < 2.0:
            b = float_to_bits(max(x, SMALLEST))
            n, a = (b >> 49) - FIRST_EIGHTH, 2 * bits_to_float((b << 3 & FRACTION) | ONE) - 3
        else:
            n = int(2 * x)
            a = 4 * x - 2 * n - 1
            n += OCTAVE_PIECES - 4
        return evaluate_line(lines, n, a)
    # Hankel's expansion (DLMF 10.17.3) with θ = x − π/4
    quarter_turns = math.floor(x * (2 / math.pi) + 0.5)
    a = x - quarter_turns * (0.5 * math.pi)
    a2 = a * a
    sine = a * (1 - a2 * (1 / 6 - a2 * (1 / 120 - a2 * (1 / 5040 - a2 * (1 / 362880 - a2 * 2.505210838544172e-8)))))
    cosine = 1 - a2 * (
        0.5 - a2 * (1 / 24 - a2 * (1 / 720 - a2 * (1 / 40320 - a2 * (1 / 3628800 - a2 * 2.08767569878681e-9))))
    )
    quarter = int(quarter_turns) & 3
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
    """F, ∂F/∂X, F + 1/r and 0, or in the far range N, ∂N/∂X, N + 1/r and 1; pieces : address of
    `UniversalTables.deep`"""
    square = X * X + Y * Y
    r = math.sqrt(square)
    if square >= 16.0 and X < 32.0 and Y < 32.0:
        i, j = int(2 * X), int(Y)
        F, slope, _ = evaluate_piece(pieces, SQUARE_START + j * COLUMNS + i, 4 * X - 2 * i - 1, 2 * (Y - j) - 1)
        return F, 4 * slope, F + 1 / r, 0.0
    inverse = 1 / r
    c = Y * inverse
    if square < 16.0:
        i, j = int(4 * r), min(int(POLAR_SECTORS * c), POLAR_SECTORS - 1)
        F, by_r, by_c = evaluate_piece(pieces, j * POLAR_RINGS + i, 8 * r - 2 * i - 1, 2 * (POLAR_SECTORS * c - j) - 1)
        FX = (8 * by_r - 2 * POLAR_SECTORS * by_c * c * inverse) * X * inverse
        if square < 1.0:
            q = 0.25 * X * X
            decay = math.exp(-Y)
            j0 = decay * (1 - q * (1 - q * (1 / 4 - q * (1 / 36 - q * (1 / 576 - q * (1 / 14400 - q * (1 / 518400)))))))
            j1 = 0.5 * decay * (1 - q * (1 / 2 - q * (1 / 12 - q * (1 / 144 - q * (1 / 2880 - q * (1 / 86400))))))
            log = 0.5 * math.log(square)
            F -= j0 * log
            FX += X * (j1 * log - j0 * inverse * inverse)
        return F, FX, F + inverse, 0.0
    u = FAR * inverse
    i, j = min(int(FAR_RINGS * u), FAR_RINGS - 1), min(int(FAR_SECTORS * c), FAR_SECTORS - 1)
    x, y = 2 * (FAR_RINGS * u - i) - 1, 2 * (FAR_SECTORS * c - j) - 1
    M, by_u, by_c = evaluate_piece(pieces, FAR_START + j * FAR_RINGS + i, x, y)
    rest = M * inverse
    N = rest - inverse
    return N, -(N + 2 * (FAR_RINGS * u * by_u + FAR_SECTORS * c * by_c) * inverse) * X * inverse * inverse, rest, 1.0
