"""Bessel functions of plane potentials, by polynomials on cells of x.

    K₀(x), x K₁(x)                   of waves that decay
    J₀(x), Y₀(x), x J₁(x), x Y₁(x)   of waves that travel

Near x = 0 they are p(x) + q(x) ln x with entire p and q (DLMF 10.8.2, 10.31.2); elsewhere they are p.  The
polynomials pass through twelve Chebyshev points of cells of width ½. The singularity at x = 0 is 18 half widths away
from the first cell without a logarithm, and 18⁻¹² = 1e-15.  One call that gives all functions of a pair of points
takes a quarter, or less, of the time of separate calls.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev
from scipy.special import i0, i1, j0, j1, k0, k1, y0, y1

from ...kernels.jit import kernel

WIDTH, TERMS = 0.5, 12
LOGARITHMIC = 4  # cells in which ln x is separated
FEWEST = 64  # cells of J, Y computed first, then twice as many, and so on
VANISHED = 80  # cells until K₀ < 1e-18, which counts as zero


def decaying_pair(x):
    """K₀(x) and x K₁(x) of finite x > 0, (n,) each"""
    single, radial = np.empty((2, len(x)))
    _decaying(x, _decaying_cells(), WIDTH, LOGARITHMIC, single, radial)
    return single, radial


def radiating_pair(x):
    """Hankel functions of the first kind, H₀(x) and x H₁(x), of finite x > 0, (n,) each"""
    cells = max(FEWEST, int(np.max(x, initial=0.0) / WIDTH) + 1)
    single, radial = np.empty((2, len(x)), complex)
    _radiating(x, _radiating_cells(2 ** int(np.ceil(np.log2(cells)))), WIDTH, LOGARITHMIC, single, radial)
    return single, radial


@lru_cache(maxsize=1)
def _decaying_cells():
    """Coefficients of K₀, xK₁ or their p, and of their q; shape (cells, 4, terms)"""
    x, near = _points(VANISHED)
    log = np.log(x) * near
    parts = k0(x) + log * i0(x), x * k1(x) - log * x * i1(x), -near * i0(x), near * x * i1(x)
    return _cells(parts)


@lru_cache(maxsize=8)
def _radiating_cells(count):
    """Coefficients of J₀, xJ₁, and of Y₀, xY₁ or their p; shape (count, 4, terms); their q are (2/π) J₀ and (2/π)
    xJ₁"""
    x, near = _points(count)
    log = 2 / np.pi * np.log(x) * near
    return _cells((j0(x), x * j1(x), y0(x) - log * j0(x), x * (y1(x) - log * j1(x))))


def _points(count):
    """Chebyshev points of `count` cells, (cells, terms), and 1 where ln x is separated, else 0"""
    cell = np.arange(count)[:, None]
    return WIDTH * (cell + (1 + chebyshev.chebpts1(TERMS)) / 2), 1.0 * (cell < LOGARITHMIC)


def _cells(parts):
    """Coefficients of powers of t, −1 < t < 1 on a cell, the highest first; shape (cells, parts, terms)"""
    basis = chebyshev.chebvander(chebyshev.chebpts1(TERMS), TERMS - 1)
    series = np.stack(parts, axis=1) @ (basis * np.where(np.arange(TERMS), 2, 1) / TERMS)
    powers = np.zeros((TERMS, TERMS))
    for n in range(TERMS):
        powers[n, : n + 1] = chebyshev.cheb2poly(np.eye(n + 1)[n])
    return np.ascontiguousarray((series @ powers)[..., ::-1])


@kernel()
def _decaying(x, cells, width, logarithmic, single, radial):
    for i in range(len(x)):
        place = x[i] / width
        if not place < len(cells):
            single[i] = radial[i] = 0.0 if place > 0 else x[i]  # NaN stays
            continue
        cell = int(place)
        p, t = cells[cell], 2 * (place - cell) - 1
        a, b = p[0, 0], p[1, 0]
        for n in range(1, p.shape[1]):
            a, b = a * t + p[0, n], b * t + p[1, n]
        if cell < logarithmic:
            c, d = p[2, 0], p[3, 0]
            for n in range(1, p.shape[1]):
                c, d = c * t + p[2, n], d * t + p[3, n]
            log = np.log(x[i])
            a, b = a + log * c, b + log * d
        single[i], radial[i] = a, b


@kernel()
def _radiating(x, cells, width, logarithmic, single, radial):
    for i in range(len(x)):
        place = x[i] / width
        cell = int(place)
        p, t = cells[cell], 2 * (place - cell) - 1
        a, b, c, d = p[0, 0], p[1, 0], p[2, 0], p[3, 0]
        for n in range(1, p.shape[1]):
            a, b, c, d = a * t + p[0, n], b * t + p[1, n], c * t + p[2, n], d * t + p[3, n]
        if cell < logarithmic:
            log = 2 / np.pi * np.log(x[i])
            c, d = c + log * a, d + log * b
        single[i], radial[i] = complex(a, c), complex(b, d)
