"""Wave part of the Green function of a source under a free surface, any depth, with its gradient.

    G = 1/r + 1/r₂ + 1/r₁ + g₁(R, Y) + g₂(R, V) + i C Z(z) Z(ζ) J₀(kR),    time factor exp(−iωt)

r₁, r₂ are the distances to the source's images in the surface and in the bed, Y = −(z+ζ), V = |z−ζ|,
Z(z) = cosh k(z+h)/cosh kh and C = 2πk²/((k²−K²)h + K).  With (SR179 report 1982; Wehausen & Laitone 1960)

    f(R, V) = PV∫ (μ+K) e^(−μh) cosh μV / (μ sinh μh − K cosh μh) J₀(μR) dμ
    g₁(R, Y) = f(R, 2h−Y) − 1/√(R²+Y²),    g₂(R, V) = f(R, V)

both are tables of one frequency (`bem.green_tables`).  Near r₁ = 0 the logarithm of g₁ would defeat a table: there the
deep-water function is summed as a series and only the smooth rest is looked up.
"""

from __future__ import annotations

import math

import numpy as np

from .green_tables import wave_table
from .jit import kernel
from .waves import depth_factor, depth_factor_slope


@kernel()
def logarithmic(X, Y):
    """F and ∂F/∂X of the deep-water function by its series about the origin, for X² + Y² ≤ 1 to 1e-9.

    e^Y F = −J₀(X)(ln ½(r+Y) + γ) − Σ hₘ(−1)^(m+1)(X/2)²ᵐ/m!² − Σ Iₙ/n!, where Iₙ is ∫₀^Y tⁿ/√(X²+t²) dt without its
    logarithm and its odd powers of X: those cancel against J₀ and Struve's function and never appear.
    """
    square = X * X
    r = math.sqrt(square + Y * Y)
    inverse = 1 / r
    log = math.log(0.5 * (r + Y)) + 0.5772156649015329
    quarter = 0.25 * square
    # J₀ and the regular part of ½πY₀, with their derivatives divided by X
    j0, dj0, y0, dy0 = 1.0, 0.0, 0.0, 0.0
    term, slope, harmonic = 1.0, 1.0, 0.0
    for m in range(1, 7):
        over = 1.0 / m
        slope = -0.5 * over * term  # derivative of the next term divided by X
        term *= -quarter * over * over
        harmonic += over
        j0 += term
        y0 -= harmonic * term
        dj0 += slope
        dy0 -= harmonic * slope
    total = -j0 * log - y0
    dtotal = -dj0 * log - j0 * inverse / (r + Y) - dy0  # divided by X as well
    # Iₙ = (Yⁿ⁻¹ r − (n−1) X² Iₙ₋₂)/n
    past, dpast, now, dnow = 0.0, 0.0, r, inverse
    power, share = 1.0, 1.0
    for n in range(1, 13):
        total -= share * now
        dtotal -= share * dnow
        power *= Y
        over = 1.0 / (n + 1)
        share *= over
        following = over * (power * r - n * square * past)
        dfollowing = over * (power * inverse - n * (2 * past + square * dpast))
        past, dpast, now, dnow = now, dnow, following, dfollowing
    decay = math.exp(-Y)
    return decay * total, decay * X * dtotal


@kernel()
def cubic_weights(x, count):
    """First of four neighbouring grid numbers about x and the cubic Lagrange weights."""
    i = min(max(int(x) - 1, 0), count - 4)
    a = x - i
    b, c, d = a - 1, a - 2, a - 3
    return i, -b * c * d * (1 / 6), a * c * d * 0.5, -a * b * d * 0.5, a * b * c * (1 / 6)


@kernel()
def _look(table, i, w0, w1, w2, w3, j, v0, v1, v2, v3):
    f, fr, fy = 0.0, 0.0, 0.0
    for a in range(4):
        w = w0 if a == 0 else (w1 if a == 1 else (w2 if a == 2 else w3))
        t = table[i + a]
        f += w * (v0 * t[j, 0] + v1 * t[j + 1, 0] + v2 * t[j + 2, 0] + v3 * t[j + 3, 0])
        fr += w * (v0 * t[j, 1] + v1 * t[j + 1, 1] + v2 * t[j + 2, 1] + v3 * t[j + 3, 1])
        fy += w * (v0 * t[j, 2] + v1 * t[j + 1, 2] + v2 * t[j + 2, 2] + v3 * t[j + 3, 2])
    return f, fr, fy


@kernel()
def levels(z, zeta, spacing, surface_count, bed_count):
    """What a pair of depths needs of the tables, the same for every horizontal distance."""
    Y, V = -(z + zeta), abs(z - zeta)
    surface = cubic_weights(Y / spacing, surface_count)
    bed = cubic_weights(V / spacing, bed_count)
    return Y, 1.0 if zeta > z else -1.0, surface, bed


@kernel()
def wave_part(R, level, K, spacing, radius, surface, rest, bed, bessel):
    """g₁ + g₂ and ∂/∂R, ∂/∂ζ of it, with J₀(kR) and its ∂/∂R; all real.

    level : from `levels`.  The arrays of a Table come one by one: taken out of the tuple for every pair, their
    reference counts would cost 50 ns on top of 35.
    """
    Y, upwards, (j, v0, v1, v2, v3), (l, u0, u1, u2, u3) = level
    x = R / spacing
    i, w0, w1, w2, w3 = cubic_weights(x, len(bessel))
    square = R * R + Y * Y
    if square > radius * radius:
        f, fr, fy = _look(surface, i, w0, w1, w2, w3, j, v0, v1, v2, v3)
    else:
        f, fr, fy = _inside(R, Y, math.sqrt(square), x, rest, spacing, K)
    b, br, bv = _look(bed, i, w0, w1, w2, w3, l, u0, u1, u2, u3)
    j0 = w0 * bessel[i, 0] + w1 * bessel[i + 1, 0] + w2 * bessel[i + 2, 0] + w3 * bessel[i + 3, 0]
    j1 = w0 * bessel[i, 1] + w1 * bessel[i + 1, 1] + w2 * bessel[i + 2, 1] + w3 * bessel[i + 3, 1]
    return f + b, fr + br, upwards * bv - fy, j0, j1


@kernel()
def _inside(R, Y, r, x, rest, spacing, K):
    """g₁ close to the image in the surface: the logarithm summed, the smooth rest looked up."""
    i, w0, w1, w2, w3 = cubic_weights(x, len(rest))
    j, v0, v1, v2, v3 = cubic_weights(Y / spacing, rest.shape[1])
    f, fr, fy = _look(rest, i, w0, w1, w2, w3, j, v0, v1, v2, v3)
    if K > 0.0:
        F, FX = logarithmic(K * R, K * Y)
        f += 2 * K * F
        fr += 2 * K * K * FX
        fy -= 2 * K * (K * F + 1 / r)
    return f, fr, fy


@kernel()
def pair(R, z, zeta, t):
    """`wave_part` of one pair of depths and a Table."""
    level = levels(z, zeta, t.spacing, t.surface.shape[1], t.bed.shape[1])
    return wave_part(R, level, t.K, t.spacing, t.radius, t.surface, t.rest, t.bed, t.bessel)


@kernel()
def _pairs(R, z, zeta, t):
    out = np.empty((5, len(R)))
    for i in range(len(R)):
        out[0, i], out[1, i], out[2, i], out[3, i], out[4, i] = pair(R[i], z, zeta[i], t)
    return out


def green_function(points, source, omega, depth, gravity=9.80665):
    """G and ∇G at `points` of a unit source 1/r at `source`, both below the surface.

    points : (n, 3) m, source : (3,) m
    returns : G (n,) 1/m, ∇G (n, 3) 1/m²; complex
    """
    d = points - source
    R = np.hypot(d[:, 0], d[:, 1])
    table = wave_table(omega, depth, gravity, R.max(), -min(points[:, 2].min(), source[2]))
    # G is symmetric: the derivative by the source's depth with the two exchanged is the one wanted
    g, gr, gz, j0, j1 = _pairs(R, float(source[2]), points[:, 2].copy(), table)
    Z, slope = depth_factor(points[:, 2], table.k, depth), depth_factor_slope(points[:, 2], table.k, depth)
    C = 1j * table.C * depth_factor(source[2], table.k, depth)
    value, radial, vertical = g + C * Z * j0, gr + C * Z * j1, gz + C * slope * j0
    images = [d[:, 2], points[:, 2] + source[2]]
    if np.isfinite(depth):
        images.append(points[:, 2] + source[2] + 2 * depth)
    for height in images:
        r = np.hypot(R, height)
        value, radial, vertical = value + 1 / r, radial - R / r**3, vertical - height / r**3
    along = radial / np.where(R > 0, R, 1.0)
    return value, np.stack([along * d[:, 0], along * d[:, 1], vertical], axis=-1)
