"""Forces of a line of segments, sinkers and buoys over the region that its fairlead visits, as a table for kernels.

Forces H, V and their exact derivatives come from the line's own solver at nodes of the chord c = √(x² + z²) and the
height z: a line becomes taut at one chord, whatever its height.  Between them they are bicubic Hermite polynomials,

    ∂f/∂c at z = (c/x) ∂f/∂x,    ∂f/∂z at c = ∂f/∂z − (z/x) ∂f/∂x.

Intervals are halved until the polynomial is right in the middle of each, within a tolerance of the tension there or at
rest, whichever is larger.  Where a sinker lifts or a buoy dives stiffness has a kink, and the nodes are close.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bem.kernels.jit import kernel

from ..lines.catenary.flat_bed import ROW
from ..lines.system.composite import fill_row

TOLERANCE = 2e-3  # of the tension there, or at rest if that is larger
CHORDS, HEIGHTS = 161, 65  # nodes at most
SAMPLES = 40
SMALLEST = 2e-3  # of the range, between nodes
OVERLOAD, STRAIN = 2.0, 0.02  # ends of the table: tension over the breaking load, strain where none is known


class ForceTable(NamedTuple):
    """chords (p,), heights (q,) m; values (p, q, 2, 4) of H and V: f, f_c, f_z, f_cz; error at random places"""

    chords: np.ndarray
    heights: np.ndarray
    values: np.ndarray
    error: float


def tabulate(composite, breaking_load, span, height, reach):
    """`ForceTable` of a `mooring.lines.system.composite.Composite` about a span and height at rest, m.

    reach : (2,) m, how far the span may fall and the height may change either way
    raises : ValueError where the line has no solution at rest
    """
    chord = float(np.hypot(span, height))
    at_rest = _solved(composite, chord, height)
    if np.isnan(at_rest).any():
        raise ValueError(f"the line has no equilibrium at a span of {span:.4g} m and a height of {height:.4g} m")
    floor = float(np.hypot(at_rest[0, 0], at_rest[1, 0]))
    low, high = _slackest(chord, span, height, reach), _tautest(composite, breaking_load, chord, height)
    ends = height - reach[1], height + reach[1]
    some = np.linspace(*ends, 5)
    chords = _nodes(lambda c: np.vstack([_solved(composite, c, z) for z in some]), low, high, 1, CHORDS, floor)
    close = np.sort(chords[np.argsort(np.diff(chords))[:6]])  # where the line's forces bend most
    heights = _nodes(lambda z: np.vstack([_solved(composite, c, z) for c in close]), *ends, 2, HEIGHTS, floor)
    grid = np.array([[_solved(composite, c, z) for z in heights] for c in chords])
    values = np.concatenate([grid, np.gradient(grid[..., 1], heights, axis=1)[..., None]], axis=-1)
    values = np.ascontiguousarray(values)
    error = _sampled_error(composite, chords, heights, values, floor)
    return ForceTable(chords, heights, values, error)


def _sampled_error(composite, chords, heights, values, floor):
    """Largest error over the tension at SAMPLES random places, between all nodes"""
    rng, worst = np.random.default_rng(1), 0.0
    for c, z in zip(rng.uniform(*chords[[0, -1]], SAMPLES), rng.uniform(*heights[[0, -1]], SAMPLES), strict=True):
        found = _solved(composite, c, z)[:, 0]
        read = table_pull(chords, heights, values, float(np.sqrt(c * c - z * z)), z)
        if np.all(np.isfinite(found)):
            worst = max(worst, np.abs(np.subtract(read, found)).max() / max(float(np.hypot(*found)), floor))
    return float(worst)


def _slackest(chord, span, height, reach):
    """m, smallest chord: that of a span that has fallen, and longer than any height"""
    return max(float(np.hypot(max(span - reach[0], 0.0), height)), 1.01 * (abs(height) + reach[1]), 0.02 * chord)


def _solved(composite, chord, height):
    """(2, 3) H and V with their derivatives to chord and height, nan where there is no solution"""
    row, span = np.zeros(ROW), float(np.sqrt(max(chord**2 - height**2, 0.0)))
    fill_row(row, composite, np.zeros(3), np.array([span, 0.0, height]))
    out = np.full((2, 3), np.nan)
    if span > 0 and np.all(np.isfinite(row)):
        for part, (f, f_x, f_z) in zip(out, ((row[2], row[9], row[11]), (row[4], row[15], row[17])), strict=True):
            part[:] = f, f_x * chord / span, f_z - f_x * height / span
    return out


def _tautest(composite, breaking_load, chord, height):
    """m, chord at which the line carries OVERLOAD times its breaking load, or has STRAIN where none is known"""
    length = sum(segment.length for segment in composite.line.segments)
    limit = OVERLOAD * breaking_load
    low, high = chord, max(chord, length) * (1 + STRAIN)
    if not np.isfinite(limit):
        return high
    for _ in range(30):
        middle = 0.5 * (low + high)
        found = _solved(composite, middle, height)
        beyond = np.isnan(found).any() or np.hypot(found[0, 0], found[1, 0]) > limit
        low, high = (low, middle) if beyond else (middle, high)
    return low


def _nodes(solve, low, high, column, most, floor):
    """Rising nodes of one axis"""
    x = list(np.linspace(low, high, 9))
    f = [solve(v) for v in x]
    gap = SMALLEST * (high - low)
    errors = [None] * 8
    while True:
        for i, known in enumerate(errors):
            if known is None:
                errors[i] = _middle(solve, x, f, i, column, floor)
        open_ = [e[0] if x[i + 1] - x[i] > 2 * gap else 0.0 for i, e in enumerate(errors)]
        worst = int(np.argmax(open_))
        if open_[worst] <= TOLERANCE or len(x) >= most:
            return np.array(x)
        middle, values = 0.5 * (x[worst] + x[worst + 1]), errors[worst][1]
        x.insert(worst + 1, middle)
        f.insert(worst + 1, values)
        errors[worst : worst + 1] = [None, None]


def _middle(solve, x, f, i, column, floor):
    """Error of the cubics in the middle of interval i over the tension, and the solutions there"""
    h = x[i + 1] - x[i]
    found = solve(x[i] + 0.5 * h)
    cubic = 0.5 * (f[i][:, 0] + f[i + 1][:, 0]) + 0.125 * h * (f[i][:, column] - f[i + 1][:, column])
    size = np.maximum(np.hypot(found[::2, 0], found[1::2, 0]), floor)
    error = np.abs(cubic - found[:, 0]) / np.repeat(size, 2)
    return float(np.nan_to_num(error).max()), found


class Packed(NamedTuple):
    """Tables of any size in three arrays: nodes (n,), values (m, 2, 4), and places (k, 5) of each table in them."""

    nodes: np.ndarray
    values: np.ndarray
    places: np.ndarray


def packed(tables):
    """`Packed` of ForceTables"""
    nodes, values, places, n, m = [np.zeros(0)], [np.zeros((0, 2, 4))], [], 0, 0
    for table in tables:
        p, q = len(table.chords), len(table.heights)
        nodes += [table.chords, table.heights]
        values.append(table.values.reshape(p * q, 2, 4))
        places.append((n, p, n + p, q, m))
        n, m = n + p + q, m + p * q
    return Packed(np.concatenate(nodes), np.concatenate(values), np.array(places, np.int64).reshape(-1, 5))


@kernel()
def table_pull(chords, heights, values, x, z):
    """(H, V) N of a `ForceTable` at a span x and height z; nan beyond it.  Below its least chord it is that there."""
    x = max(np.sqrt(x * x + z * z), chords[0])
    if not (x <= chords[-1] and heights[0] <= z <= heights[-1]):
        return np.nan, np.nan
    i = min(max(np.searchsorted(chords, x) - 1, 0), chords.size - 2)
    j = min(max(np.searchsorted(heights, z) - 1, 0), heights.size - 2)
    dx, dz = chords[i + 1] - chords[i], heights[j + 1] - heights[j]
    s, t = (x - chords[i]) / dx, (z - heights[j]) / dz
    a, b = (1 + 2 * s) * (1 - s) ** 2, s * s * (3 - 2 * s)
    c, d = dx * s * (1 - s) ** 2, -dx * s * s * (1 - s)
    e, f = (1 + 2 * t) * (1 - t) ** 2, t * t * (3 - 2 * t)
    g, h = dz * t * (1 - t) ** 2, -dz * t * t * (1 - t)
    H = V = 0.0
    for k in range(2):
        p, q, r, w = values[i, j, k], values[i + 1, j, k], values[i, j + 1, k], values[i + 1, j + 1, k]
        low = a * p[0] + b * q[0] + c * p[1] + d * q[1]
        high = a * r[0] + b * w[0] + c * r[1] + d * w[1]
        low_z = a * p[2] + b * q[2] + c * p[3] + d * q[3]
        high_z = a * r[2] + b * w[2] + c * r[3] + d * w[3]
        total = e * low + f * high + g * low_z + h * high_z
        H, V = (total, V) if k == 0 else (H, total)
    return max(H, 0.0), V


@kernel()
def packed_pull(tables, number, x, z):
    """`table_pull` of one table of a `Packed`"""
    first, p, second, q, start = tables.places[number]
    values = tables.values[start : start + p * q].reshape(p, q, 2, 4)
    return table_pull(tables.nodes[first : first + p], tables.nodes[second : second + q], values, x, z)
