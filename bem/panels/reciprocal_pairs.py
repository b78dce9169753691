"""Real wave part of S and D between all nodes; one evaluation of G gives the entries of a pair of nodes in both
directions.

G is symmetric in its two points, and its ∂/∂R, ∂/∂z and ∂/∂ζ follow from the same polynomials. Half of all evaluations
are therefore enough.
`bem.panels.standing_waves` gives the imaginary part. Integrals are those of `bem.panels.wave_influence`: with the
nodes, or with finer points on panels whose surface image is close.
"""

import math

import numpy as np

from ..green.finite_depth import depth_variables, standing_part_at, table_position, table_view
from ..kernels.jit import kernel
from ..kernels.simd import address, load_vector, split_halves, to_scalars
from ..kernels.threads import parallel_rows
from .wave_influence import COARSE, close_up_to

NODES = 4  # nodes of a panel
TILE = 2  # panels whose nodes fill a cache line of a column of the matrices


def add_wave_part(geometry, classes, table, depth_values, S, D):
    """Add the real wave part to S and D (c, n, n) of symmetry classes of a `bem.panels.influence.Geometry`.

    The panels have four nodes.
    table : `bem.green.tables.Table`; depth_values : function z → (…, 2) of Z and Z′
    """
    e, images, signs = geometry.elements, geometry.images, np.array([geometry.signs(c) for c in classes])
    close = close_up_to(e.sizes, table.k, geometry.depth)
    normals, depth_z = e.axes[:, 2].copy(), depth_values(e.nodes[:, 2])
    arguments = e.nodes, normals, e.weights, e.origins, close**2, images, signs, depth_z, table
    most = NODES * NODES * len(images)

    def at_nodes(low, high):
        workspace = np.empty((most, 3), np.int64), np.empty((most, 8)), np.empty((most // 2, 8))
        _rows_and_columns(low, high, *arguments, *workspace, S, D)

    panels = len(e.origins)
    parallel_rows(at_nodes, (panels + 2 * TILE - 1) // (2 * TILE), S[0].size * len(images) // 2)
    reached = np.flatnonzero(close + e.origins[:, 2] > 0)
    if not len(reached):
        return
    quadrature = (part[reached][:, COARSE**2 :] for part in geometry.quadrature)
    points, weights, shape = map(np.ascontiguousarray, quadrature)
    of_panels = points, weights, shape, normals[reached], e.origins[reached], close[reached] ** 2
    arguments = e.nodes, depth_z, reached, *of_panels, depth_values(points[..., 2]), images, signs, table

    def with_fine_points(low, high):
        _close_panels(low, high, *arguments, S, D)

    parallel_rows(with_fine_points, len(e.nodes), len(e.nodes) * points[..., 0].size)


@kernel()
def _close_panels(
    low, high, at, at_z, panels, points, weights, shape, normals, centers, squares, depth_z, images, signs, table, S, D
):
    """Rows `low` to `high` of the images of the `panels` (s,) that are close to a node; arrays over these s panels"""
    view = table_view(table)
    for i in range(low, high):
        factor = table.C * at_z[i, 0]
        for b in range(len(panels)):
            up = at[i, 2] + centers[b, 2]
            for m in range(len(images)):
                sx, sy = images[m, 0], images[m, 1]
                ex, ey = at[i, 0] - sx * centers[b, 0], at[i, 1] - sy * centers[b, 1]
                if ex * ex + ey * ey + up * up >= squares[b]:
                    continue
                for q in range(weights.shape[1]):
                    depths = depth_variables(at[i, 2], points[b, q, 2])
                    dx, dy = sx * points[b, q, 0] - at[i, 0], sy * points[b, q, 1] - at[i, 1]
                    R = math.sqrt(dx * dx + dy * dy)
                    along = (sx * normals[b, 0] * dx + sy * normals[b, 1] * dy) / (R + 1e-300)
                    g, gr, by_zeta, _ = standing_part_at(
                        table_position(R, depths, view), R, depths,
                        factor * depth_z[b, q, 0], factor * depth_z[b, q, 1], 0.0, view,
                    )  # fmt: skip
                    s, d = weights[b, q] * g, weights[b, q] * (gr * along + by_zeta * normals[b, 2])
                    for p in range(4):
                        j = np.uintp(4 * panels[b] + p)
                        for c in range(len(signs)):
                            S[c, i, j] += signs[c, m] * shape[b, q, p] * s
                            D[c, i, j] += signs[c, m] * shape[b, q, p] * d


@kernel()
def _rows_and_columns(
    low, high, nodes, normals, weights, centers, squares, images, signs, depth_z, table, pieces, values, found, S, D
):
    """Rows of panels from the diagonal on and their columns: tiles `low` to `high` and those as far from the last.

    nodes (n, 3), weights (n,), depth_z (n, 2) Z and Z′; normals (s, 3), centers (s, 3), squares (s,) m² of the
    distances of `close_up_to`.  Workspace of one thread, for all pairs of nodes of two panels and images: pieces and
    values of (·, 3) and (·, 8), and found (· / 2, 8), two pairs in a row.
    """
    view, panels = table_view(table), len(centers)
    last = (panels - 1) // TILE
    for t in range(low, high):
        for mirrored in range(2):
            tile = last - t if mirrored == 1 else t
            if mirrored == 1 and tile <= t:
                continue
            for b in range(TILE * tile, panels):
                for a in range(TILE * tile, min(TILE * tile + TILE, b + 1)):
                    _locate(a, b, nodes, normals, centers, squares, images, view, pieces, values)
                    _evaluate(a, b, nodes, normals, len(images), depth_z, table.C, view, pieces, values, found)
                    _add(a, b, weights, signs, len(images), address(found), S, D)


@kernel(inline=True)
def _evaluate(a, b, nodes, normals, count, depth_z, C, view, pieces, values, found):
    """G and ∂G/∂n for the values of `_locate`: for b seen from a, for a from b, then the same of ∂G/∂n, or zeros"""
    for p in range(4):
        i = np.uintp(4 * a + p)
        for q in range(4):
            j, row, column = np.uintp(4 * b + q), (2 * p + q // 2) * count, np.uintp(4 * (q % 2))
            depths = depth_variables(nodes[i, 2], nodes[j, 2])
            wave, slope, slope_back = (
                C * depth_z[i, 0] * depth_z[j, 0],
                C * depth_z[i, 0] * depth_z[j, 1],
                C * depth_z[i, 1] * depth_z[j, 0],
            )
            for m in range(count):
                e, f = np.uintp((4 * p + q) * count + m), np.uintp(row + m)
                there, back = values[e, 6], values[e, 7]
                g, flux, flux_back = 0.0, 0.0, 0.0
                if there + back > 0.0:
                    position = pieces[e, 0], pieces[e, 1], pieces[e, 2], values[e, 3], values[e, 4], values[e, 5]
                    g, gr, by_zeta, by_z = standing_part_at(
                        position, values[e, 0], depths, wave, slope, slope_back, view
                    )
                    flux = gr * values[e, 1] + by_zeta * normals[b, 2]
                    flux_back = gr * values[e, 2] + by_z * normals[a, 2]
                found[f, column], found[f, column + np.uintp(1)] = there * g, back * g
                found[f, column + np.uintp(2)], found[f, column + np.uintp(3)] = there * flux, back * flux_back


@kernel(inline=True)
def _locate(a, b, nodes, normals, centers, squares, images, view, pieces, values):
    """For all pairs of nodes of panels a and b and images: R, ∂R/∂n at b and at a, local variables of `table_position`,
    and whether panel b seen from the node of a, and a from that of b, is integrated at its nodes (1, else 0)
    """
    count = len(images)
    for p in range(4):
        i = np.uintp(4 * a + p)
        for q in range(4):
            j = np.uintp(4 * b + q)
            depths = depth_variables(nodes[i, 2], nodes[j, 2])
            rise, rise_back = nodes[i, 2] + centers[b, 2], nodes[j, 2] + centers[a, 2]
            for m in range(count):
                e, sx, sy = np.uintp((4 * p + q) * count + m), images[m, 0], images[m, 1]
                dx, dy = sx * nodes[j, 0] - nodes[i, 0], sy * nodes[j, 1] - nodes[i, 1]
                R = math.sqrt(dx * dx + dy * dy)
                inverse = 1 / (R + 1e-300)
                values[e, 0] = R
                values[e, 1] = (sx * normals[b, 0] * dx + sy * normals[b, 1] * dy) * inverse
                values[e, 2] = -(normals[a, 0] * dx + normals[a, 1] * dy) * inverse
                zone, surface, bed, values[e, 3], values[e, 4], values[e, 5] = table_position(R, depths, view)
                pieces[e, 0], pieces[e, 1], pieces[e, 2] = zone, surface, bed
                ex, ey = nodes[i, 0] - sx * centers[b, 0], nodes[i, 1] - sy * centers[b, 1]
                fx, fy = nodes[j, 0] - sx * centers[a, 0], nodes[j, 1] - sy * centers[a, 1]
                values[e, 6] = 1.0 if ex * ex + ey * ey + rise * rise >= squares[b] else 0.0
                back = a != b and fx * fx + fy * fy + rise_back * rise_back >= squares[a]
                values[e, 7] = 1.0 if back else 0.0


@kernel(inline=True)
def _add(a, b, weights, signs, count, found, S, D):
    """Add the pairs of nodes of two panels to the rows of panel a, and to those of b unless it is the same"""
    for c in range(len(signs)):
        for half in range(2):
            j = np.uintp(4 * b + 2 * half)
            k = j + np.uintp(1)
            for p in range(4):
                i, first = np.uintp(4 * a + p), (2 * p + half) * count
                total = load_vector(found, 8 * first) * signs[c, 0]
                for m in range(1, count):
                    total = total + load_vector(found, 8 * (first + m)) * signs[c, m]
                one, two = split_halves(total)
                first_two, last_two = split_halves(one)
                there, back = to_scalars(first_two)
                flux, flux_back = to_scalars(last_two)
                S[c, i, j] += weights[j] * there
                D[c, i, j] += weights[j] * flux
                if a != b:
                    S[c, j, i] += weights[i] * back
                    D[c, j, i] += weights[i] * flux_back
                first_two, last_two = split_halves(two)
                there, back = to_scalars(first_two)
                flux, flux_back = to_scalars(last_two)
                S[c, i, k] += weights[k] * there
                D[c, i, k] += weights[k] * flux
                if a != b:
                    S[c, k, i] += weights[i] * back
                    D[c, k, i] += weights[i] * flux_back
