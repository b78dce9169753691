"""Green function of a source under a free surface, any depth, with its gradient.

    G = 1/r + 1/r₂ + 1/r₁ + g₁(R, Y) + g₂(R, V) + i C Z(z) Z(ζ) J₀(kR),    time factor exp(−iωt)

r₁, r₂ are the distances to the source's images in the surface and in the bed, Y = −(z+ζ), V = |z−ζ|,
Z(z) = cosh k(z+h)/cosh kh and C = 2πk²/((k²−K²)h + K).  With (SR179 report 1982; Wehausen & Laitone 1960)

    f(R, V) = PV∫ (μ+K) e^(−μh) cosh μV / (μ sinh μh − K cosh μh) J₀(μR) dμ
    g₁(R, Y) = f(R, 2h−Y) − 1/√(R²+Y²),    g₂(R, V) = f(R, V)

Where R < h/2, 2K F(KR, KY) of `bem.green.deep_water` is taken off g₁; beyond, the wave −C Z(z) Z(ζ) Y₀(kR) is taken off
g₁ + g₂.  What is left is smooth and comes from the tables of `bem.green.tables`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..kernels.jit import kernel
from ..kernels.simd import bits, from_bits, plus, times
from .deep_water import ONE, deep_water
from .deep_water import bessel as bessel_functions
from .piecewise_polynomials import address, by_first, by_second
from .tables import TABLE_ONLY, WITH_IMAGES, whole_table

BLOCK = 128  # pairs at a time: what is kept of them takes 11 kB, of the 32 that a processor has nearest
# of e^(−x): ln 2 in two parts, the first of which times n is exact; 1/13! … 1/0!; 1.5 × 2⁵²
LN2_HIGH, LN2_LOW = 0.69314718036912382, 1.9082149292705877e-10
SERIES = tuple(1 / math.factorial(n) for n in range(13, -1, -1))
INTEGER = 1.5 * 2.0**52


class Layout(NamedTuple):
    """A Table with the addresses of its arrays, which must be alive as long as this is used."""

    K: float
    k: float
    per_metre: float
    double_depth: float
    entries: int
    beyond: int
    net: float
    mirror: float
    pieces: object
    zones: object
    deep: object
    bessel: object


@kernel()
def layout_of(t):
    return Layout(
        t.K, t.k, t.per_metre, t.double_depth, t.entries, t.beyond, t.net, t.mirror,
        address(t.pieces), address(t.zones), address(t.deep), address(t.bessel),
    )  # fmt: skip


@kernel()
def levels(z, zeta):
    """Y, V and the sign of ζ − z, the same for every horizontal distance."""
    return -(z + zeta), abs(z - zeta), 1.0 if zeta > z else -1.0


@kernel(inline=True)
def wave_part(R, level, wave, slope, layout):
    """g₁ + g₂ and ∂/∂R, ∂/∂ζ of it, with J₀(kR) and its ∂/∂R; all real.

    level : from `levels`; wave, slope : C Z(z) Z(ζ) and its ∂/∂ζ; layout : `layout_of` the Table
    """
    return wave_part_at(spot(R, level, layout), R, level, wave, slope, layout)


@kernel(inline=True)
def spot(R, level, layout):
    """Where a pair is in the tables: zone, piece of g₁, piece of g₂, local variables of R, Y and V.

    `wave_part_at` of some pairs after `spot` of all of them takes a quarter less time than `wave_part` of each.
    """
    n = int(R * layout.per_metre)
    if n >= layout.entries:
        return n, 0, 0, 0.0, 0.0, 0.0
    Y, V, _ = level
    zones, first = layout.zones, 9 * n
    columns, surface_rows, bed_rows = zones[first + 1], zones[first + 2], zones[first + 3]
    x, y, v = (R - zones[first]) * columns, Y * surface_rows, V * bed_rows
    last = int(zones[first + 6])
    i, j, l = min(int(x), last), min(int(y), int(zones[first + 7])), min(int(v), int(zones[first + 8]))
    surface, bed = int(zones[first + 4]) + j * (last + 1) + i, int(zones[first + 5]) + l * (last + 1) + i
    return n, surface, bed, 2 * (x - i) - 1, 2 * (y - j) - 1, 2 * (v - l) - 1


@kernel(inline=True)
def wave_part_at(place, R, level, wave, slope, layout):
    """`wave_part` of a pair whose `spot` is `place`."""
    Y, V, upwards = level
    g, gr, gz = 0.0, 0.0, 0.0
    K, n = layout.K, place[0]
    if layout.double_depth > 0.0:
        if n < layout.entries:
            g, gr, gz = _tabulated(place, upwards, layout)
        elif layout.beyond != TABLE_ONLY:
            g, gr, gz = _beyond(R, Y, V, upwards, layout)
    explicit = n > 0
    if K > 0.0 and not explicit:
        X = K * R
        F, FX, sink, far = deep_water(X, K * Y, layout.deep)
        g += 2 * K * F
        gr += 2 * K * K * FX
        gz += 2 * K * K * sink
        explicit = far > 0.0 and X > 1.0  # on the axis of the far range the wave is below 1e-13
    j0, j1 = 1.0, 0.0
    if K > 0.0:
        j0, y0, j1, y1 = bessel_functions(layout.k * R, layout.bessel)
        j1 *= layout.k
        if explicit:
            g -= wave * y0
            gr -= wave * layout.k * y1
            gz -= slope * y0
    return g, gr, gz, j0, j1


@kernel(inline=True)
def _tabulated(place, upwards, layout):
    n, surface, bed, x, y, v = place
    zones, first = layout.zones, 9 * n
    f, fy = by_second(layout.pieces, surface, y)
    b, bv = by_second(layout.pieces, bed, v)
    value, slope = by_first(plus(f, b), x)
    rise, _ = by_first(plus(times(bv, 2 * upwards * zones[first + 3]), times(fy, -2 * zones[first + 2])), x)
    return value, 2 * zones[first + 1] * slope, rise


@kernel()
def _beyond(R, Y, V, upwards, layout):
    """g₁ + g₂ without the wave beyond the tables, where G without it is zero; NaN where the tables ended before."""
    if layout.beyond != WITH_IMAGES:
        return math.nan, math.nan, math.nan
    g, gr, gz = 2 * layout.net * math.log(layout.double_depth / R), -2 * layout.net / R, 0.0
    for height, sign, along in (
        (layout.double_depth - Y, 1.0, 1.0), (Y, layout.mirror, -1.0), (V, 1.0, upwards),
    ):  # fmt: skip
        inverse = sign / math.sqrt(R * R + height * height)
        cube = inverse / (R * R + height * height)
        g -= inverse
        gr += R * cube
        gz += along * height * cube
    return g, gr, gz


@kernel(inline=True)
def wave_factors(Y, V, upwards, C, k, q):
    """C Z(z) Z(ζ) and its ∂/∂ζ from the sum and difference of the depths; q = e^(−2kh)."""
    a, b = max(decay(k * Y), 1e-300), max(decay(k * V), 1e-300)
    share = C / ((1 + q) * (1 + q))
    down, up = q * q / a, q / b
    return share * (a + down + up + q * b), share * k * (a - down + upwards * (up - q * b))


@kernel(inline=True)
def decay(x):
    """e^(−x) for x ≥ 0, below e^(−700) of that order; a loop over this becomes vectors, over the library's it does not.

    e^(−x) = 2ⁿ eʳ with |r| ≤ ½ ln 2, eʳ by its series
    """
    n = np.floor(0.5 - min(x, 700.0) * (1 / math.log(2)))
    r = -min(x, 700.0) - n * LN2_HIGH - n * LN2_LOW
    p = SERIES[0]
    for c in SERIES[1:]:
        p = p * r + c
    # the last digits of n + INTEGER are those of the integer n
    return p * from_bits((bits(n + INTEGER) << 52) + ONE)


@kernel()
def pair(R, z, zeta, t):
    """`wave_part` of one pair and a Table."""
    level = levels(z, zeta)
    q = math.exp(-t.k * t.double_depth) if t.double_depth > 0.0 else 0.0
    wave, slope = wave_factors(level[0], level[1], level[2], t.C, t.k, q)
    return wave_part(R, level, wave, slope, layout_of(t))


@kernel()
def _pairs(R, z, zeta, t, whole, room, G):
    """G, ∂G/∂R and ∂G/∂z into G (3, n), as many at a time as the rows of room (11, ·) hold.

    Rows: depth factor and its slope, images and their two derivatives, the six values of `spot`.  What can be done in
    vectors comes first, then `spot` of all: in turn they take 1.5 times as long.
    """
    layout, (_, most) = layout_of(t), room.shape
    for start in range(0, len(R), most):
        end = min(start + most, len(R))
        Rs, zs, zetas = R[start:end], z[start:end], zeta[start:end]
        _all_wave_factors(zs, zetas, t.C, t.k, layout.double_depth, room[0], room[1])
        _all_images(Rs, zs, zetas, layout.double_depth, layout.per_metre if whole else 0.0, room[2], room[3], room[4])
        for i in range(end - start):
            # G is symmetric: the derivative by the source's depth with the two exchanged is the one wanted
            place = spot(Rs[i], levels(zetas[i], zs[i]), layout)
            room[5, i], room[6, i], room[7, i] = place[0], place[1], place[2]
            room[8, i], room[9, i], room[10, i] = place[3], place[4], place[5]
        for i in range(end - start):
            place = int(room[5, i]), int(room[6, i]), int(room[7, i]), room[8, i], room[9, i], room[10, i]
            wave, slope = room[0, i], room[1, i]
            g, gr, gz, j0, j1 = wave_part_at(place, Rs[i], levels(zetas[i], zs[i]), wave, slope, layout)
            G[0, start + i] = complex(g + room[2, i], wave * j0)
            G[1, start + i] = complex(gr + room[3, i], wave * j1)
            G[2, start + i] = complex(gz + room[4, i], slope * j0)


@kernel()
def _all_wave_factors(z, zeta, C, k, double_depth, wave, slope):
    """`wave_factors` of pairs, the derivative by z"""
    q = math.exp(-k * double_depth) if double_depth > 0.0 else 0.0
    for i in range(len(z)):
        Y, V, upwards = levels(zeta[i], z[i])
        wave[i], slope[i] = wave_factors(Y, V, upwards, C, k, q)


@kernel()
def _all_images(R, z, zeta, double_depth, per_metre, value, radial, vertical):
    """1/r + 1/r₂ + 1/r₁ and its derivatives by R and z; zero where R × per_metre ≥ 1, where tables hold them"""
    bed = 1.0 if double_depth > 0.0 else 0.0
    for i in range(len(R)):
        share = 1.0 if R[i] * per_metre < 1.0 else 0.0
        square, V, Y = R[i] * R[i], z[i] - zeta[i], -(z[i] + zeta[i])
        height = double_depth - Y
        one, two = share / math.sqrt(square + V * V), share / math.sqrt(square + Y * Y)
        three = bed * share / math.sqrt(square + height * height)
        a, b, c = one * one * one, two * two * two, three * three * three
        value[i], radial[i], vertical[i] = one + two + three, -R[i] * (a + b + c), Y * b - V * a - height * c


def green(R, z, zeta, omega, depth, gravity=9.80665):
    """G of a unit source 1/r at depth `zeta`, seen from depth `z` at the horizontal distance R, with its gradient.

    R, z, zeta : m, arrays of one shape or numbers; R ≥ 0, −depth ≤ z, zeta ≤ 0; omega : rad/s; depth : m, may be inf
    returns : G in 1/m, ∂G/∂R and ∂G/∂z in 1/m²; complex, of the shape of the arguments
    raises : ValueError for points outside the water or on each other

    Error below 1e-8 of |G| and of |∇G| for 1e-4 ≤ kh ≤ 200 and 1e-3 ≤ R/h ≤ 1e3, as long as they are not less than
    1e-6 of 1/r and its gradient.  The first call of a frequency takes some milliseconds, then a pair 35 to 55 ns.
    """
    R, z, zeta = np.broadcast_arrays(*(np.asarray(a, float) for a in (R, z, zeta)))
    _check(R, z, zeta, omega, depth, gravity)
    G = table_pairs(whole_table(float(omega), float(depth), float(gravity)), R.ravel(), z.ravel(), zeta.ravel(), True)
    return tuple(G.reshape(3, *R.shape))


def table_pairs(table, R, z, zeta, whole=False):
    """G of unit sources 1/r at depths `zeta` through a table, with its gradient.

    table : `bem.green.tables.Table`; R, z, zeta : (n,) m, not checked; whole : the table is one of `whole_table`
    returns : (3, n) complex: G in 1/m, ∂G/∂R and ∂G/∂z in 1/m²; NaN beyond the reach of the table
    """
    G, room = np.empty((3, len(R)), complex), np.empty((11, BLOCK))
    _pairs(R, z, zeta, table, whole, room, G)
    return G


def _check(R, z, zeta, omega, depth, gravity):
    for name, value in (("omega", omega), ("depth", depth), ("gravity", gravity)):
        if not value > 0 or (name != "depth" and np.isinf(value)):
            raise ValueError(f"{name} is {value}; allowed: above 0")
    lowest = -depth * (1 + 1e-12)
    for name, values, low, high in (("R", R, 0.0, np.inf), ("z", z, lowest, 0.0), ("zeta", zeta, lowest, 0.0)):
        bad = ~((values >= low) & (values <= high) & np.isfinite(values))
        if np.any(bad):
            n = np.flatnonzero(bad)[0]
            allowed = "0 or more" if name == "R" else f"{-depth:g} to 0"
            raise ValueError(f"{name} is {values.flat[n]} m at pair {n}; allowed: {allowed}")
    same = (R == 0) & (z == zeta)
    if np.any(same):
        raise ValueError(f"pair {np.flatnonzero(same)[0]}: R is 0 and z is zeta; the Green function is infinite there")


def green_function(points, source, omega, depth, gravity=9.80665):
    """G and ∇G at `points` of a unit source 1/r at `source`, both below the surface; as exact as `green`.

    points : (n, 3) m, source : (3,) m
    returns : G (n,) 1/m, ∇G (n, 3) 1/m²; complex
    """
    d = points - source
    R = np.hypot(d[:, 0], d[:, 1])
    value, radial, vertical = green(R, points[:, 2], source[2], omega, depth, gravity)
    along = radial / np.where(R > 0, R, 1.0)
    return value, np.stack([along * d[:, 0], along * d[:, 1], vertical], axis=-1)
