"""Forces of a line with segments, sinkers and buoys over the range of its fairlead's positions, as a table for
kernels.

Forces H, V and their exact derivatives come from the line's solver. They are computed at the corners of cells in the
chord c = √(x² + z²) and the height z, because a line becomes taut at one chord, whatever its height. In a cell the
forces are Adini's polynomials, complete to third degree, from values and derivatives at the four corners,

    ∂f/∂c at z = (c/x) ∂f/∂x,    ∂f/∂z at c = ∂f/∂z − (z/x) ∂f/∂x.

A cell is halved, along the axis with the larger error, until the polynomial is accurate in the middle of the cell
and of its edges. The tolerance is relative to the local tension or to the tension at rest, whichever is larger.
Cells become small along the curves where a sinker lifts, a buoy dives, or the part above a sinker becomes taut. At
the greatest chord the line is taut; beyond it the pull increases with the stiffness at this chord.
"""

import heapq
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from ..lines.catenary.flat_bed import ROW
from ..lines.system.composite import fill_row

TOLERANCE = 5e-3  # error of the table over the tension there, or over the tension at rest if larger
FIRST = (8, 4)  # initial cells, of chord and height
MOST_CELLS = 3000
SMALLEST = 2e-4  # smallest cell over the range
CHECKS = 200  # places, other than those that determined the cells
OVERLOAD, STRAIN = 2.0, 0.02  # ends of the table: tension over the breaking load; strain without a known breaking load


class ForceTable(NamedTuple):
    """A tree of cells.

    ends : limits of chord and height, (2, 2) m; first : number of initial cells along each of the two
    halved : (n,) m, chord (where along (n,) is 0) or height (where it is 1) at which a cell is divided
    below : (n,), number of a cell's lower half (the upper half is the next number); for an undivided cell −1 less
        its row in cells and values
    cells : (m, 4) m, lowest chord and height, and sizes
    values : (m, 2, 4, 4), f, f_c, f_z, f_cz of H and V at the corners (low, low), (high, low), (low, high), (high,
        high)
    error : largest error found at any checked point of any cell, over the tension
    coarse : share of the region in cells whose error exceeds TOLERANCE
    """

    ends: np.ndarray
    first: tuple[int, int]
    halved: np.ndarray
    along: np.ndarray
    below: np.ndarray
    cells: np.ndarray
    values: np.ndarray
    error: float
    coarse: float


def tabulate(composite, breaking_load, span, height, reach):
    """`ForceTable` of a `mooring.lines.system.composite.Composite` about a span and height at rest, m.

    reach : largest decrease of the span, and largest change of the height up or down, (2,) m
    raises : ValueError for a line without a solution at rest
    """
    chord = float(np.hypot(span, height))
    at_rest = _solved(composite, chord, height)
    if np.isnan(at_rest).any():
        raise ValueError(f"the line has no equilibrium at a span of {span:.4g} m and a height of {height:.4g} m")
    floor = float(np.hypot(at_rest[0, 0], at_rest[1, 0]))
    chords = _slackest(chord, span, height, reach), _tautest(composite, breaking_load, chord, height)
    ends = np.array([chords, (height - reach[1], height + reach[1])])
    known = {}

    def solve(c, z):
        if (c, z) not in known:
            known[c, z] = _solved(composite, c, z)
        return known[c, z]

    tree = _Tree(solve, ends, floor)
    tree.grow()
    return tree.table(composite)


class _Tree:
    """Cells of a table during their division; `whole` is a heap of (−error, number) of divisible ones."""

    def __init__(self, solve, ends, floor):
        self.solve, self.ends, self.floor = solve, ends, floor
        self.boxes, self.cut, self.whole, self.errors = [], {}, [], []
        c, z = (np.linspace(*pair, count + 1) for pair, count in zip(ends, FIRST, strict=True))
        for i in range(FIRST[0]):
            for j in range(FIRST[1]):
                self._add((c[i], z[j], c[i + 1], z[j + 1]))

    def _add(self, box):
        """A cell (low chord, low height, high chord, high height), with its error and the axis to halve it on"""
        (c0, z0, c1, z1), number = box, len(self.boxes)
        corners = [self.solve(c, z) for z in (z0, z1) for c in (c0, c1)]
        values, size = _with_twist(np.array(corners), c1 - c0, z1 - z0), (c1 - c0, z1 - z0)
        error = np.zeros(5)
        for place, (s, t) in enumerate(MIDDLES):
            found = self.solve(c0 + s * size[0], z0 + t * size[1])[:, 0]
            read = np.array(cell_pull(values, size[0], size[1], s, t))
            error[place] = np.nan_to_num(np.abs(read - found).max() / max(float(np.hypot(*found)), self.floor))
        self.boxes.append(box)
        self.errors.append(float(error.max()))
        may = [size[i] > 2 * SMALLEST * np.ptp(self.ends[i]) for i in range(2)]
        if self.errors[-1] > TOLERANCE and any(may):
            axis = int(error[3:].max() > error[1:3].max())
            heapq.heappush(self.whole, (-self.errors[-1], number, axis if may[axis] else 1 - axis))

    def grow(self):
        """Halve the worst cell until all cells are accurate or as small as allowed, or their number reaches its
        limit.
        """
        while self.whole and len(self.boxes) < 2 * MOST_CELLS:
            _, number, axis = heapq.heappop(self.whole)
            low, high = list(self.boxes[number]), list(self.boxes[number])
            middle = 0.5 * (low[axis] + low[axis + 2])
            high[axis] = low[axis + 2] = middle
            self.cut[number] = (middle, axis, len(self.boxes))
            self._add(tuple(low))
            self._add(tuple(high))

    def table(self, composite):
        """The `ForceTable` of the cells"""
        count = len(self.boxes)
        halved, along, below = np.zeros(count), np.zeros(count, np.int64), np.zeros(count, np.int64)
        cells, values = [], []
        for number, (c0, z0, c1, z1) in enumerate(self.boxes):
            if number in self.cut:
                halved[number], along[number], below[number] = self.cut[number]
                continue
            below[number] = -1 - len(cells)
            cells.append((c0, z0, c1 - c0, z1 - z0))
            corners = [self.solve(c, z) for z in (z0, z1) for c in (c0, c1)]
            values.append(_with_twist(np.array(corners), c1 - c0, z1 - z0))
        cells = np.array(cells)
        errors = np.array([self.errors[number] for number in range(count) if number not in self.cut])
        area = cells[:, 2] * cells[:, 3]
        coarse = float(area[errors > TOLERANCE].sum() / area.sum())
        table = ForceTable(self.ends, FIRST, halved, along, below, cells, np.array(values), errors.max(), coarse)
        return table._replace(error=max(float(errors.max()), self._elsewhere(table, composite)))

    def _elsewhere(self, table, composite):
        """Largest error at CHECKS places in equally probable cells, so that small ones are tested too"""
        rng, worst, tables = np.random.default_rng(1), 0.0, packed([table])
        for number in rng.integers(0, len(table.cells), CHECKS):
            c0, z0, dc, dz = table.cells[number]
            c, z = c0 + rng.uniform() * dc, z0 + rng.uniform() * dz
            found = _solved(composite, c, z)[:, 0]
            read = packed_pull(tables, 0, float(np.sqrt(max(c * c - z * z, 0.0))), z)
            if np.all(np.isfinite(found)) and np.all(np.isfinite(read)):
                worst = max(worst, np.abs(np.subtract(read, found)).max() / max(float(np.hypot(*found)), self.floor))
        return float(worst)


# centres of a cell and of its edges along c and z
MIDDLES = ((0.5, 0.5), (0.5, 0.0), (0.5, 1.0), (0.0, 0.5), (1.0, 0.5))


def _with_twist(corners, dc, dz):
    """H and V at the corners of a cell, with the mixed derivatives of Adini's polynomial; shape (2, 4, 4)

    corners : (4, 2, 3) f, f_c, f_z at (low, low), (high, low), (low, high), (high, high) chord and height
    """
    f, f_c, f_z = np.moveaxis(corners, -1, 0)  # (4, 2)
    saddle = (f[3] - f[2] - f[1] + f[0]) / (dc * dz)
    across = (f_c[[2, 3, 2, 3]] - f_c[[0, 1, 0, 1]]) / dz
    upward = (f_z[[1, 1, 3, 3]] - f_z[[0, 0, 2, 2]]) / dc
    return np.ascontiguousarray(np.moveaxis(np.stack([f, f_c, f_z, across + upward - saddle], axis=-1), 0, 1))


def _slackest(chord, span, height, reach):
    """m, smallest chord: that of the reduced span, and longer than any height"""
    return max(float(np.hypot(max(span - reach[0], 0.0), height)), 1.01 * (abs(height) + reach[1]), 0.02 * chord)


def _solved(composite, chord, height):
    """H and V with their derivatives to chord and height, nan without a solution; shape (2, 3)"""
    row, span = np.zeros(ROW), float(np.sqrt(max(chord**2 - height**2, 0.0)))
    fill_row(row, composite, np.zeros(3), np.array([span, 0.0, height]))
    out = np.full((2, 3), np.nan)
    if span > 0 and np.all(np.isfinite(row)):
        for part, (f, f_x, f_z) in zip(out, ((row[2], row[9], row[11]), (row[4], row[15], row[17])), strict=True):
            part[:] = f, f_x * chord / span, f_z - f_x * height / span
    return out


def _tautest(composite, breaking_load, chord, height):
    """m, chord at which the line carries OVERLOAD times its breaking load, or has STRAIN without a known one"""
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


@in_memory
class Packed(NamedTuple):
    """Several tables in joint arrays, as in `ForceTable`; ends (k, 2, 2), first (k, 2) and root (k,), first cell, of
    each table.
    """

    ends: np.ndarray
    first: np.ndarray
    root: np.ndarray
    halved: np.ndarray
    along: np.ndarray
    below: np.ndarray
    cells: np.ndarray
    values: np.ndarray


def packed(tables):
    """`Packed` of ForceTables"""
    below, nodes, whole = [np.zeros(0, np.int64)], 0, 0
    root = []
    for table in tables:
        root.append(nodes)
        below.append(np.where(table.below < 0, table.below - whole, table.below + nodes))
        nodes, whole = nodes + len(table.below), whole + len(table.cells)

    def joined(name, shape, kind=float):
        return np.concatenate([np.zeros((0, *shape), kind), *(getattr(one, name) for one in tables)])

    return Packed(
        np.array([table.ends for table in tables], float).reshape(-1, 2, 2),
        np.array([table.first for table in tables], np.int64).reshape(-1, 2),
        np.array(root, np.int64),
        joined("halved", ()),
        joined("along", (), np.int64),
        np.concatenate(below),
        joined("cells", (4,)),
        joined("values", (2, 4, 4)),
    )


@kernel(inline=True, counted=False)
def cell_pull(values, dc, dz, s, t):
    """Forces (H, V), N, from the values (2, 4, 4) of a cell at its local coordinates s, t, 0 to 1"""
    a, b = (1 + 2 * s) * (1 - s) ** 2, s * s * (3 - 2 * s)
    c, d = dc * s * (1 - s) ** 2, -dc * s * s * (1 - s)
    e, f = (1 + 2 * t) * (1 - t) ** 2, t * t * (3 - 2 * t)
    g, h = dz * t * (1 - t) ** 2, -dz * t * t * (1 - t)
    H = V = 0.0
    for k in range(2):
        p, q, r, w = values[k, 0], values[k, 1], values[k, 2], values[k, 3]
        low = a * p[0] + b * q[0] + c * p[1] + d * q[1]
        high = a * r[0] + b * w[0] + c * r[1] + d * w[1]
        low_z = a * p[2] + b * q[2] + c * p[3] + d * q[3]
        high_z = a * r[2] + b * w[2] + c * r[3] + d * w[3]
        total = e * low + f * high + g * low_z + h * high_z
        H, V = (total, V) if k == 0 else (H, total)
    return H, V


@kernel(counted=False)
def packed_pull(tables, number, x, z):
    """Forces (H, V), N, from a table of a `Packed` at a span x and height z; nan above and below the heights of the
    table.

    Below the smallest chord, the value at the smallest chord holds; beyond the greatest chord it is extrapolated
    along the chord.
    """
    ends, first = tables.ends[number], tables.first[number]
    c = max(np.sqrt(x * x + z * z), ends[0, 0])
    known = np.isfinite(c) and ends[1, 0] <= z <= ends[1, 1]
    if not known:
        c, z = ends[0, 0], ends[1, 0]
    at = min(c, ends[0, 1])
    i = min(int((at - ends[0, 0]) / (ends[0, 1] - ends[0, 0]) * first[0]), first[0] - 1)
    j = min(int((z - ends[1, 0]) / (ends[1, 1] - ends[1, 0]) * first[1]), first[1] - 1)
    node = tables.root[number] + i * first[1] + j
    while tables.below[node] >= 0:
        here = at if tables.along[node] == 0 else z
        node = tables.below[node] + (1 if here > tables.halved[node] else 0)
    cell = -1 - tables.below[node]
    c0, z0, dc, dz = tables.cells[cell, 0], tables.cells[cell, 1], tables.cells[cell, 2], tables.cells[cell, 3]
    t = (z - z0) / dz
    values = tables.values[cell]
    H, V = cell_pull(values, dc, dz, (at - c0) / dc, t)
    e, f = (1 + 2 * t) * (1 - t) ** 2, t * t * (3 - 2 * t)
    g, h = dz * t * (1 - t) ** 2, -dz * t * t * (1 - t)
    for k in range(2):
        slope = e * values[k, 1, 1] + f * values[k, 3, 1] + g * values[k, 1, 3] + h * values[k, 3, 3]
        H, V = (H + slope * (c - at), V) if k == 0 else (H, V + slope * (c - at))
    return (max(H, 0.0), V) if known else (np.nan, np.nan)
