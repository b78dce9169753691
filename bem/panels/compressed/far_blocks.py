"""Blocks of low rank by adaptive cross approximation: a block A ≈ Σ uᵢ vᵢ is found from some of its rows and columns.

The rows and columns are those in which the residual has its largest entries (Bebendorf, Numerische Mathematik 86,
2000). The single and the double layer of a block lie side by side, [S D] ≈ U [V_S V_D], because one evaluation of the
Green function gives both layers.  The blocks are real parts; the imaginary parts are in `bem.panels.standing_waves`.
If the last term is small, a few other rows are checked: the rows used so far may miss parts of the block, because a
panel has no influence on panels in its own plane.
"""

import math
from typing import NamedTuple

import numpy as np

from ...green.finite_depth import depth_variables, table_position, table_view, wave_part_at
from ...kernels.jit import kernel

GOLDEN = 0.6180339887498949  # golden ratio − 1: its multiples modulo 1 are evenly spread
# rows of a block, after the last term: in one case three of them were all in the sixth part that was represented
# already, nodes above each other on a wall
LOOKED_AT = 8
CAPACITY = 2_000_000  # entries of a buffer to begin with, about
ROOM = 64  # terms of the largest block that they hold to begin with: all that it could have would be its square


class Sources(NamedTuple):
    """q point sources that replace n nodes of panels; the sources of node j are first[j] to first[j + 1]"""

    first: np.ndarray  # (n + 1,)
    points: np.ndarray  # (q, 3) m
    normals: np.ndarray  # (q, 3)
    weights: np.ndarray  # (q,) m²
    depth_z: np.ndarray  # (q, 2) Z and Z′
    hull: np.ndarray  # (n,) whether a node is on the hull: otherwise it is a single layer, times K


class Water(NamedTuple):
    """Data of the Green function and the depth for the kernels"""

    table: object  # `bem.green.tables.Table`
    mirror: float  # factor of 1/r₁
    bed: bool
    shift: float  # m, −2h


class LowRank(NamedTuple):
    """A block ≈ U V of the double layer, with K times the single layer in the columns of the lid; the single layer S
    is ≈ U V_S"""

    U: np.ndarray  # (targets, rank)
    V: np.ndarray  # (rank, sources)
    V_S: np.ndarray  # (rank, sources)


def low_rank_blocks(blocks, nodes, at_depth, sources, water, single, double):
    """Yield `LowRank` of each block, in order.

    blocks : first and end node of the target, first and end node of the source, image ±1, ±1, (b, 6)
    nodes, at_depth : places of the targets, m, (n, 3), and Z at these places, (n,)
    single, double : allowed root mean square error of an entry of the single and of the double layer
    """
    if not len(blocks):
        return
    shapes = np.column_stack([blocks[:, 1] - blocks[:, 0], blocks[:, 3] - blocks[:, 2]])
    most = shapes.max(axis=0)
    left, right, right_single = (np.empty(max(CAPACITY, ROOM * int(most[k]))) for k in (0, 1, 1))
    used = [np.empty(count, np.bool_) for count in most]
    points = int(np.max(sources.first[blocks[:, 3]] - sources.first[blocks[:, 2]]))
    workspace = np.empty((max(points, most[0]), 3), np.int64), np.empty((max(points, most[0]), 5))
    ranks, done = np.empty(len(blocks), np.int64), 0
    given = blocks, nodes, at_depth, sources, water, single, double, *used, *workspace
    while done < len(blocks):
        end = _compress(done, *given, left, right, right_single, ranks)
        if end == done:  # a block that is larger than the buffers
            left, right, right_single = (np.empty(2 * len(buffer)) for buffer in (left, right, right_single))
            continue
        starts = [0, 0]
        for (m, n), rank in zip(shapes[done:end], ranks[done:end], strict=True):
            U = left[starts[0] : starts[0] + m * rank].reshape(rank, m).T
            V, V_S = (part[starts[1] : starts[1] + n * rank].reshape(rank, n) for part in (right, right_single))
            starts = [starts[0] + m * rank, starts[1] + n * rank]
            yield LowRank(U, V, V_S)
        done = end


@kernel(counted=False)
def _compress(
    done, blocks, nodes, at_depth, sources, water, single, double, used_rows, used_columns, pieces, values,
    left, right, right_single, ranks,
):  # fmt: skip
    """Fill the buffers with blocks from index `done` on until they are full; returns the index of the next one.

    pieces (·, 3) and values (·, 5) : workspace of `_line`
    """
    view = table_view(water.table)
    at_left, at_right = 0, 0
    for b in range(done, len(blocks)):
        low, high, start, end = blocks[b, 0], blocks[b, 1], blocks[b, 2], blocks[b, 3]
        sx, sy = float(blocks[b, 4]), float(blocks[b, 5])
        m, n = high - low, end - start
        most, count = min(m, n), float(m * n)
        of_single, of_double = 1 / (single * single * count), 1 / (double * double * count)
        for i in range(m):
            used_rows[i] = False
        for j in range(n):
            used_columns[j] = False
        rank, row, looked, asked, full = 0, m // 2, 0, 0, False
        while rank < most and looked < LOOKED_AT:
            if at_left + (rank + 1) * m > len(left) or at_right + (rank + 1) * n > len(right):
                full = True
                break
            used_rows[row] = True
            # the row of the residual
            v, u = at_right + rank * n, at_left + rank * m
            first, last = sources.first[start], sources.first[end]
            _line(low + row, 0, first, 1, last - first, sx, sy, nodes, at_depth, sources, water, view, pieces, values)
            for j in range(n):
                right[v + j], right_single[v + j] = _summed(start + j, first, sources, water.table.K, values)
            _subtract(right, at_right, n, rank, left, at_left + row, m)
            _subtract(right_single, at_right, n, rank, left, at_left + row, m)
            column, largest, square = _largest(right, v, n, used_columns)
            other, largest_single, square_single = _largest(right_single, v, n, used_columns)
            by_single = largest_single * of_single > largest * of_double
            if by_single:
                column = other
            if column < 0 or (square * of_double * m <= 1.0 and square_single * of_single * m <= 1.0):
                looked, asked = looked + 1, asked + 1  # nothing is left of this row
                row = _unused(used_rows, m, int(asked * GOLDEN % 1.0 * m))
                if row < 0:
                    break
                continue
            used_columns[column] = True
            pivot = 1 / (right_single[v + column] if by_single else right[v + column])
            for j in range(n):
                right[v + j] *= pivot
                right_single[v + j] *= pivot
            size = max(square * of_double, square_single * of_single) * pivot**2
            for i in range(m):
                left[u + i] = 0.0
            for q in range(sources.first[start + column], sources.first[start + column + 1]):
                _line(low, 1, q, 0, m, sx, sy, nodes, at_depth, sources, water, view, pieces, values)
                for i in range(m):
                    left[u + i] += _layer(i, by_single, sources.hull[start + column], water.table.K, values)
            if by_single:
                _subtract(left, at_left, m, rank, right_single, at_right + column, n)
            else:
                _subtract(left, at_left, m, rank, right, at_right + column, n)
            row, _, column_square = _largest(left, u, m, used_rows)
            rank += 1
            looked = looked + 1 if size * column_square <= 1.0 else 0
            if row < 0 or looked:
                asked += 1
                row = _unused(used_rows, m, int(asked * GOLDEN % 1.0 * m))
            if row < 0:
                break
        if full:
            return b
        ranks[b] = rank
        at_left += rank * m
        at_right += rank * n
    return len(blocks)


@kernel(inline=True, counted=False)
def _subtract(values, begin, count, rank, factors, at, step):
    """Subtract from the row or column number `rank` of a buffer, `count` long, the contribution of the previous ones

    factors : the other buffer, in which the factor of each is `step` after the previous one, from `at` on
    """
    for term in range(rank):
        factor = factors[at + term * step]
        for j in range(count):
            values[begin + rank * count + j] -= factor * values[begin + term * count + j]


@kernel(inline=True, counted=False)
def _largest(values, begin, count, used):
    """The index of the largest of `count` unused values, −1 if there are only zeros, its square and the sum of all"""
    found, largest, total = -1, 0.0, 0.0
    for j in range(count):
        square = values[begin + j] ** 2
        total += square
        if not used[j] and square > largest:
            found, largest = j, square
    return found, largest, total


@kernel(inline=True, counted=False)
def _unused(used, count, begin):
    """The next unused index from `begin` on, or −1"""
    for i in range(count):
        at = (begin + i) % count
        if not used[at]:
            return at
    return -1


@kernel(inline=True, counted=False)
def _layer(e, single, on_hull, K, values):
    """Value number e of `_line`, of the single layer or of the double one, on the lid K times the single one"""
    if single:
        return values[e, 0]
    return values[e, 1] if on_hull else K * values[e, 0]


@kernel(inline=True, counted=False)
def _summed(j, first, sources, K, values):
    """Double and single layer of node j from the values of its sources; first : the source of the first value"""
    double, single = 0.0, 0.0
    for q in range(sources.first[j], sources.first[j + 1]):
        double += _layer(q - first, False, sources.hull[j], K, values)
        single += _layer(q - first, True, sources.hull[j], K, values)
    return double, single


@kernel(inline=True, counted=False)
def _line(i, next_point, q, next_source, count, sx, sy, nodes, at_depth, sources, water, view, pieces, values):
    """Single and double layer of `count` pairs of a point and a source, into the first two columns of `values`.

    The points are i, i + next_point, …, mirrored by sx and sy, the sources q, q + next_source, …  With places in the
    table in a loop of their own a pair takes 24 ns, in one loop 66 ns, and 157 ns if references to arrays are counted.
    """
    points, normals, weights, depth_z = sources.points, sources.normals, sources.weights, sources.depth_z
    for e in range(count):
        a, b = np.uintp(i + e * next_point), np.uintp(q + e * next_source)
        dx, dy = points[b, 0] - sx * nodes[a, 0], points[b, 1] - sy * nodes[a, 1]
        R, k = math.sqrt(dx * dx + dy * dy), np.uintp(e)
        values[k, 0] = R
        values[k, 1] = (normals[b, 0] * dx + normals[b, 1] * dy) / (R + 1e-300)
        zone, surface, bed, values[k, 2], values[k, 3], values[k, 4] = table_position(
            R, depth_variables(nodes[a, 2], points[b, 2]), view
        )
        pieces[k, 0], pieces[k, 1], pieces[k, 2] = zone, surface, bed
    for e in range(count):
        a, b, k = np.uintp(i + e * next_point), np.uintp(q + e * next_source), np.uintp(e)
        z, R, flat, up, weight = nodes[a, 2], values[k, 0], values[k, 1], normals[b, 2], weights[b]
        factor, square = water.table.C * at_depth[a], R * R
        Z, slope = depth_z[b, 0], depth_z[b, 1]
        position = pieces[k, 0], pieces[k, 1], pieces[k, 2], values[k, 2], values[k, 3], values[k, 4]
        depths = depth_variables(z, points[b, 2])
        g, gr, gz, _, _ = wave_part_at(position, R, depths, factor * Z, factor * slope, view)
        height, above = points[b, 2] - z, points[b, 2] + z
        one = 1 / math.sqrt(square + height * height)
        two = 1 / math.sqrt(square + above * above)
        cube, mirrored = one * one * one, water.mirror * two * two * two
        third, below, below_cube = 0.0, 0.0, 0.0
        if water.bed:
            below = above - water.shift
            third = 1 / math.sqrt(square + below * below)
            below_cube = third * third * third
        radial, vertical = gr - R * (cube + mirrored + below_cube), gz - height * cube
        vertical -= above * mirrored + below * below_cube
        values[k, 0] = weight * (one + water.mirror * two + third + g)
        values[k, 1] = weight * (radial * flat + vertical * up)
