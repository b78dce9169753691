"""A table of a line's forces over the region its fairlead visits, for use in the time domain.

Forces and their exact stiffness stand at the nodes of a grid; in between they follow bicubic Hermite polynomials, whose
error falls with the fourth power of the spacing and is largest in the middle of a cell, at t²(1−t)² f⁗/24.  The grid is
refined until the error measured there, in every cell, is below the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

LARGEST = 200_000  # nodes
MARGIN = 1.5  # of the measured error, for derivatives that are not constant within a cell


@dataclass(frozen=True)
class LineTable:
    """Forces over a region; make one with `tabulate`.

    x : (n,) m; z : (m,) m; values : (n, m, 2, 4) of H and V: f, ∂f/∂x, ∂f/∂z, ∂²f/∂x∂z
    error : bound on the error of (H, V) over the tension, measured in the middle of every cell
    """

    x: np.ndarray
    z: np.ndarray
    values: np.ndarray = field(repr=False)
    error: float

    def forces(self, x, z):
        """(H, V), each (...), at fairleads (x, z), and their stiffness (..., 2, 2), that of the table.

        raises : ValueError outside the table
        """
        x, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(z, float))
        for name, value, axis in (("x", x, self.x), ("z", z, self.z)):
            if not np.all((value >= axis[0]) & (value <= axis[-1])):
                worst = value.flat[np.argmax(np.maximum(axis[0] - value, value - axis[-1]))]
                raise ValueError(f"{name} is {worst:g} m; the table holds {axis[0]:g} to {axis[-1]:g} m; tabulate more")
        i, t, dx = _cell(self.x, x)
        j, u, dz = _cell(self.z, z)
        f, f_t, f_u = _hermite(self.values, i, j, t, u, dx, dz)
        k = np.stack([f_t / dx[..., None], f_u / dz[..., None]], axis=-1)
        return f[..., 0], f[..., 1], k


def tabulate(solve, x_range, z_range, tolerance=1e-4):
    """A LineTable within `tolerance` of the tension.

    solve : (x, z) → a solution with horizontal_fairlead, vertical_fairlead and stiffness, for example
        `StaticLine.solve`, or `mooring.catenary.solve_lines` with the line's properties bound
    x_range, z_range : (from, to) m
    raises : ValueError where the tolerance is not reached, as across the slack limit, at which stiffness jumps
    """
    for name, (low, high) in (("x_range", x_range), ("z_range", z_range)):
        if not low < high:
            raise ValueError(f"{name} is {low:g} to {high:g} m; allowed: from the smaller to the larger")
    n, m = 9, 5
    while n * m <= LARGEST:
        x, z = np.linspace(*x_range, n), np.linspace(*z_range, m)
        table = LineTable(x, z, _node_values(solve, x, z), np.inf)
        across, up = _measured(solve, table, 0.5, 0.0), _measured(solve, table, 0.0, 0.5)
        error = MARGIN * max(across + up, _measured(solve, table, 0.5, 0.5))
        if error <= tolerance:
            return LineTable(x, z, table.values, error)
        n, m = (2 * n - 1, m) if across >= up else (n, 2 * m - 1)
    raise ValueError(
        f"table error is {error:.3g} with {x.size} × {z.size} nodes; allowed: {tolerance:g}; narrow the region "
        "(keep clear of where the line goes slack or floats a buoy), or allow a larger error"
    )


def _node_values(solve, x, z):
    line = solve(x[:, None], z[None, :])
    k = line.stiffness
    f = np.stack([line.horizontal_fairlead, line.vertical_fairlead], axis=-1)
    f_x, f_z = k[..., 0], k[..., 1]
    cross = 0.5 * (np.gradient(f_x, z, axis=1, edge_order=2) + np.gradient(f_z, x, axis=0, edge_order=2))
    return np.stack([f, f_x, f_z, cross], axis=-1)


def _measured(solve, table, t, u):
    """Largest error over the tension a share t, u into the cells."""
    x = table.x[:-1] + t * np.diff(table.x) if t else table.x
    z = table.z[:-1] + u * np.diff(table.z) if u else table.z
    line = solve(x[:, None], z[None, :])
    H, V, _ = table.forces(x[:, None], z[None, :])
    wrong = np.hypot(H - line.horizontal_fairlead, V - line.vertical_fairlead)
    return float(np.max(wrong / np.hypot(line.horizontal_fairlead, line.vertical_fairlead)))


def _cell(axis, value):
    i = np.clip(np.searchsorted(axis, value, side="right") - 1, 0, axis.size - 2)
    width = axis[i + 1] - axis[i]
    return i, (value - axis[i]) / width, width


def _basis(t, width):
    """Weights of f and f' at both ends of an interval, and their derivatives with respect to t."""
    a, b = t * t * (3 - 2 * t), 6 * t * (1 - t)
    slopes = width * t * (1 - t) ** 2, -width * t * t * (1 - t)
    rates = width * (1 - t) * (1 - 3 * t), width * t * (3 * t - 2)
    return np.stack([1 - a, a, *slopes], axis=-1), np.stack([-b, b, *rates], axis=-1)


def _hermite(values, i, j, t, u, dx, dz):
    """Value and derivatives with respect to t and u, (..., 2)."""
    p, dp = _basis(t, dx)
    q, dq = _basis(u, dz)
    corners = np.empty((*np.shape(t), 2, 4, 4))
    for a in (0, 1):
        for b in (0, 1):
            node = values[i + a, j + b]
            corners[..., a, b], corners[..., 2 + a, b] = node[..., 0], node[..., 1]
            corners[..., a, 2 + b], corners[..., 2 + a, 2 + b] = node[..., 2], node[..., 3]

    def at(p, q):
        return np.einsum("...a,...fab,...b->...f", p, corners, q)

    return at(p, q), at(dp, q), at(p, dq)
