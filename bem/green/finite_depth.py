"""Green function, with gradient, of a source under a free surface in water of any depth.

    G = 1/r + 1/r₂ + 1/r₁ + g₁(R, Y) + g₂(R, V) + i C Z(z) Z(ζ) J₀(kR),    time factor exp(−iωt)

r₁, r₂ are the distances to the source's images in the surface and in the bed, Y = −(z+ζ), V = |z−ζ|,
Z(z) = cosh k(z+h)/cosh kh and C = 2πk²/((k²−K²)h + K).  With (SR179 report 1982; Wehausen & Laitone 1960)

    f(R, V) = PV∫ (μ+K) e^(−μh) cosh μV / (μ sinh μh − K cosh μh) J₀(μR) dμ
    g₁(R, Y) = f(R, 2h−Y) − 1/√(R²+Y²),    g₂(R, V) = f(R, V)

Where R < h/2, 2K F(KR, KY) of `bem.green.deep_water` is subtracted from g₁. Where R > h/2, the wave −C Z(z) Z(ζ)
Y₀(kR) is subtracted from g₁ + g₂.  The remainder is smooth and interpolated in the tables of `bem.green.tables`.
"""

import math
from typing import NamedTuple

import numpy as np

from ..kernels.jit import kernel
from ..kernels.simd import address, bits_to_float, float_to_bits
from .deep_water import ONE, deep_water
from .deep_water import bessel as bessel_functions
from .piecewise_polynomials import sum_over_x, sum_over_y
from .tables import TABLE_ONLY, WITH_IMAGES, whole_table

BLOCK = 128  # pairs per block: their workspace takes 11 kB of a first-level cache of at least 32 kB
# constants of e^(−x): ln 2 in two parts, n times the first is exact; 1/13! … 1/0!; 1.5 × 2⁵²
LN2_HIGH, LN2_LOW = 0.69314718036912382, 1.9082149292705877e-10
SERIES = tuple(1 / math.factorial(n) for n in range(13, -1, -1))
INTEGER = 1.5 * 2.0**52


class TableView(NamedTuple):
    """A `Table` with addresses in place of arrays; the arrays must exist as long as the view is used."""

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
def table_view(t):
    """`TableView` of a `bem.green.tables.Table`"""
    return TableView(
        t.K, t.k, t.per_metre, t.double_depth, t.entries, t.beyond, t.net, t.mirror,
        address(t.pieces), address(t.zones), address(t.deep), address(t.bessel),
    )  # fmt: skip


@kernel()
def depth_variables(z, zeta):
    """Y = −(z + ζ) and V = |z − ζ| in m, and the sign of ζ − z: at equal depth ∂/∂ζ of g₂ is zero; from a table it is
    nearly zero"""
    return -(z + zeta), abs(z - zeta), (1.0 if zeta > z else 0.0) - (1.0 if zeta < z else 0.0)


@kernel(inline=True)
def table_position(R, depths, view):
    """Position of a pair in the tables: zone, pieces of g₁ and of g₂, local variables (−1 to 1) of R, Y and V.

    To compute the positions of many pairs, then `wave_part_at` of all pairs, takes a quarter less time than to
    compute position and `wave_part_at` pair by pair.
    """
    n = int(R * view.per_metre)
    if n >= view.entries:
        return n, 0, 0, 0.0, 0.0, 0.0
    Y, V, _ = depths
    zones, first = view.zones, 9 * n
    columns, surface_rows, bed_rows = zones[first + 1], zones[first + 2], zones[first + 3]
    x, y, v = (R - zones[first]) * columns, Y * surface_rows, V * bed_rows
    last = int(zones[first + 6])
    i, j, l = min(int(x), last), min(int(y), int(zones[first + 7])), min(int(v), int(zones[first + 8]))
    surface, bed = int(zones[first + 4]) + j * (last + 1) + i, int(zones[first + 5]) + l * (last + 1) + i
    return n, surface, bed, 2 * (x - i) - 1, 2 * (y - j) - 1, 2 * (v - l) - 1


@kernel(inline=True)
def wave_part_at(position, R, depths, wave, slope, view):
    """Real g₁ + g₂ and its ∂/∂R and ∂/∂ζ, and J₀(kR) and its ∂/∂R.

    position : from `table_position`; R : m; depths : from `depth_variables`
    wave, slope : C Z(z) Z(ζ) and its ∂/∂ζ; view : `TableView`
    """
    Y, V, upwards = depths
    g, gr, gz = 0.0, 0.0, 0.0
    K, n = view.K, position[0]
    if view.double_depth > 0.0:
        if n < view.entries:
            g, gr, gz = _tabulated(position, upwards, view)
        elif view.beyond != TABLE_ONLY:
            g, gr, gz = _beyond(R, Y, V, upwards, view)
    explicit = n > 0
    if K > 0.0 and not explicit:
        X = K * R
        F, FX, sink, far = deep_water(X, K * Y, view.deep)
        g += 2 * K * F
        gr += 2 * K * K * FX
        gz += 2 * K * K * sink
        explicit = far > 0.0 and X > 1.0  # elsewhere in the far range the wave is below 1e-13
    j0, j1 = 1.0, 0.0
    if K > 0.0:
        j0, y0, j1, y1 = bessel_functions(view.k * R, view.bessel)
        j1 *= view.k
        if explicit:
            g -= wave * y0
            gr -= wave * view.k * y1
            gz -= slope * y0
    return g, gr, gz, j0, j1


@kernel(inline=True)
def standing_part_at(position, R, depths, wave, slope, slope_back, view):
    """g₁ + g₂, which is the real part of G without the terms 1/r, and its ∂/∂R, ∂/∂ζ and ∂/∂z, at a `table_position`.

    slope_back : ∂/∂z of C Z(z) Z(ζ), the derivative at the first point; other arguments as in `wave_part_at`
    """
    Y, V, upwards = depths
    g, gr, by_zeta, by_z = 0.0, 0.0, 0.0, 0.0
    K, n = view.K, position[0]
    if view.double_depth > 0.0:
        if n < view.entries:
            g, gr, by_zeta, by_z = _tabulated_both_ways(position, upwards, view)
        elif view.beyond != TABLE_ONLY:
            g, gr, by_zeta = _beyond(R, Y, V, upwards, view)
            _, _, by_z = _beyond(R, Y, V, -upwards, view)
    if K > 0.0:
        explicit = n > 0
        if not explicit:
            X = K * R
            F, FX, sink, far = deep_water(X, K * Y, view.deep)
            g += 2 * K * F
            gr += 2 * K * K * FX
            by_zeta += 2 * K * K * sink
            by_z += 2 * K * K * sink
            explicit = far > 0.0 and X > 1.0  # same condition as in `wave_part_at`
        if explicit:
            _, y0, _, y1 = bessel_functions(view.k * R, view.bessel)
            g -= wave * y0
            gr -= wave * view.k * y1
            by_zeta -= slope * y0
            by_z -= slope_back * y0
    return g, gr, by_zeta, by_z


@kernel(inline=True)
def _tabulated_both_ways(position, upwards, view):
    """`_tabulated` and its ∂/∂z"""
    n, surface, bed, x, y, v = position
    zones, first = view.zones, 9 * n
    f, fy = sum_over_y(view.pieces, surface, y)
    b, bv = sum_over_y(view.pieces, bed, v)
    value, slope = sum_over_x(f + b, x)
    of_surface, of_bed = sum_over_x(fy, x)[0], sum_over_x(bv, x)[0]
    sinking, rising = -2 * zones[first + 2] * of_surface, 2 * upwards * zones[first + 3] * of_bed
    return value, 2 * zones[first + 1] * slope, sinking + rising, sinking - rising


@kernel(inline=True)
def _tabulated(position, upwards, view):
    """Interpolated remainder of g₁ + g₂ and its ∂/∂R, ∂/∂ζ"""
    n, surface, bed, x, y, v = position
    zones, first = view.zones, 9 * n
    f, fy = sum_over_y(view.pieces, surface, y)
    b, bv = sum_over_y(view.pieces, bed, v)
    value, slope = sum_over_x(f + b, x)
    rise, _ = sum_over_x(bv * (2 * upwards * zones[first + 3]) + fy * (-2 * zones[first + 2]), x)
    return value, 2 * zones[first + 1] * slope, rise


@kernel()
def _beyond(R, Y, V, upwards, view):
    """g₁ + g₂ minus the wave beyond the last zone, where G minus the wave vanishes; NaN if the zones end earlier"""
    if view.beyond != WITH_IMAGES:
        return math.nan, math.nan, math.nan
    g, gr, gz = 2 * view.net * math.log(view.double_depth / R), -2 * view.net / R, 0.0
    for height, sign, along in (
        (view.double_depth - Y, 1.0, 1.0), (Y, view.mirror, -1.0), (V, 1.0, upwards),
    ):  # fmt: skip
        inverse = sign / math.sqrt(R * R + height * height)
        cube = inverse / (R * R + height * height)
        g -= inverse
        gr += R * cube
        gz += along * height * cube
    return g, gr, gz


@kernel(inline=True)
def wave_factors(Y, V, upwards, C, k, q):
    """C Z(z) Z(ζ) and its ∂/∂ζ, from sum and difference of the depths; q = e^(−2kh)."""
    a, b = max(decay(k * Y), 1e-300), max(decay(k * V), 1e-300)
    share = C / ((1 + q) * (1 + q))
    down, up = q * q / a, q / b
    return share * (a + down + up + q * b), share * k * (a - down + upwards * (up - q * b))


@kernel(inline=True)
def decay(x):
    """e^(−x) for x ≥ 0, at least e^(−700); the compiler vectorises a loop over this function, but not a loop over the
    library's exp.

    The function computes e^(−x) = 2ⁿ eʳ with |r| ≤ ½ ln 2, and eʳ by its series.
    """
    n = np.floor(0.5 - min(x, 700.0) * (1 / math.log(2)))
    r = -min(x, 700.0) - n * LN2_HIGH - n * LN2_LOW
    p = SERIES[0]
    for c in SERIES[1:]:
        p = p * r + c
    # the lowest bits of n + INTEGER are those of the integer n
    return p * bits_to_float((float_to_bits(n + INTEGER) << 52) + ONE)


@kernel()
def _pairs(R, z, zeta, t, whole, workspace, G):
    """G, ∂G/∂R and ∂G/∂z into G (3, n), in blocks of as many pairs as workspace (11, ·) has columns.

    Its rows: depth factor and its slope, images and their two derivatives, the six values of `table_position`.  A block
    runs through three loops, of which the first is vectorised: one loop over all steps takes 1.5 times as long.
    """
    view, (_, most) = table_view(t), workspace.shape
    for start in range(0, len(R), most):
        end = min(start + most, len(R))
        Rs, zs, zetas = R[start:end], z[start:end], zeta[start:end]
        _all_wave_factors(zs, zetas, t.C, t.k, view.double_depth, workspace[0], workspace[1])
        _all_images(
            Rs, zs, zetas, view.double_depth, view.per_metre if whole else 0.0, workspace[2], workspace[3], workspace[4]
        )
        for i in range(end - start):
            # G is symmetric: ∂/∂z is ∂/∂ζ with z and ζ exchanged
            position = table_position(Rs[i], depth_variables(zetas[i], zs[i]), view)
            workspace[5, i], workspace[6, i], workspace[7, i] = position[0], position[1], position[2]
            workspace[8, i], workspace[9, i], workspace[10, i] = position[3], position[4], position[5]
        for i in range(end - start):
            position = (
                int(workspace[5, i]),
                int(workspace[6, i]),
                int(workspace[7, i]),
                workspace[8, i],
                workspace[9, i],
                workspace[10, i],
            )
            wave, slope = workspace[0, i], workspace[1, i]
            g, gr, gz, j0, j1 = wave_part_at(position, Rs[i], depth_variables(zetas[i], zs[i]), wave, slope, view)
            G[0, start + i] = complex(g + workspace[2, i], wave * j0)
            G[1, start + i] = complex(gr + workspace[3, i], wave * j1)
            G[2, start + i] = complex(gz + workspace[4, i], slope * j0)


@kernel()
def _all_wave_factors(z, zeta, C, k, double_depth, wave, slope):
    """`wave_factors` of pairs, the derivative by z"""
    q = math.exp(-k * double_depth) if double_depth > 0.0 else 0.0
    for i in range(len(z)):
        Y, V, upwards = depth_variables(zeta[i], z[i])
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
    raises : ValueError for points outside the water, and for two points at one place

    The error is below 1e-8 of |G| and of |∇G| for 1e-4 ≤ kh ≤ 200 and 1e-3 ≤ R/h ≤ 1e3, if |G| and |∇G| are not less
    than 1e-6 of 1/r and its gradient.  The first call at a frequency takes some milliseconds, and then a pair takes
    35 to 55 ns.
    """
    R, z, zeta = np.broadcast_arrays(*(np.asarray(a, float) for a in (R, z, zeta)))
    _check(R, z, zeta, omega, depth, gravity)
    G = table_pairs(whole_table(float(omega), float(depth), float(gravity)), R.ravel(), z.ravel(), zeta.ravel(), True)
    return tuple(G.reshape(3, *R.shape))


def table_pairs(table, R, z, zeta, whole=False):
    """G of unit sources 1/r at depths `zeta` through a table, with its gradient.

    table : `bem.green.tables.Table`; R, z, zeta : m, (n,), not checked; whole : whether the table is from `whole_table`
    returns : G, 1/m, ∂G/∂R and ∂G/∂z, 1/m², complex, (3, n); NaN beyond the reach of the table
    """
    G, workspace = np.empty((3, len(R)), complex), np.empty((11, BLOCK))
    _pairs(R, z, zeta, table, whole, workspace, G)
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
