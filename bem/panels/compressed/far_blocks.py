"""Blocks of low rank by adaptive cross approximation: A ≈ Σ uᵢ vᵢ from some of its rows and columns.

Rows and columns are those of the residual with the largest entries (Bebendorf, Numerische Mathematik 86, 2000).  Where
the last term is small a few other rows are checked, since a block may have parts that the rows so far do not show: a
panel has no influence on those of its own plane.
"""

import math
from typing import NamedTuple

import numpy as np

from ...green.finite_depth import depth_variables, table_view, wave_part
from ...kernels.jit import kernel

SINGLE, DOUBLE = 0, 1  # layer
GOLDEN = 0.6180339887498949  # golden ratio − 1: its multiples modulo 1 are evenly spread
# rows of a block, after the last term: in one case three of them were all in the sixth part that was represented
# already, nodes above each other on a wall
LOOKED_AT = 8
CAPACITY = 3_000_000  # entries of a buffer to begin with, about
ROOM = 64  # terms of the largest block that they hold to begin with: all that it could have would be its square


class Sources(NamedTuple):
    """n nodes of panels, replaced by q point sources; the sources of node j are first[j] to first[j + 1]"""

    first: np.ndarray  # (n + 1,)
    points: np.ndarray  # (q, 3) m
    normals: np.ndarray  # (q, 3)
    weights: np.ndarray  # (q,) m²
    depth_z: np.ndarray  # (q, 2) Z and Z′
    hull: np.ndarray  # (n,) whether a node is on the hull: otherwise it is a single layer, times K


class Water(NamedTuple):
    """Data of Green function and depth for the kernels"""

    table: object  # `bem.green.tables.Table`
    mirror: float  # factor of 1/r₁
    bed: bool
    shift: float  # m, −2h


class LowRank(NamedTuple):
    """Block ≈ U V"""

    U: np.ndarray  # (targets, rank)
    V: np.ndarray  # (rank, sources)


def low_rank_blocks(blocks, nodes, at_depth, sources, water, layer, tolerance):
    """Yield `LowRank` of each block, in order.

    blocks : (b, 6) first and end node of target and source, image ±1, ±1; nodes : (n, 3) m and at_depth : (n,) Z of the
    targets; layer : `SINGLE`, or `DOUBLE` with single layers in the columns of the lid
    tolerance : mean error of an entry, root mean square
    """
    if not len(blocks):
        return
    shapes = np.column_stack([blocks[:, 1] - blocks[:, 0], blocks[:, 3] - blocks[:, 2]])
    most = shapes.max(axis=0)
    buffers = [np.empty(max(CAPACITY, ROOM * int(count)), complex) for count in most]
    used = [np.empty(count, np.bool_) for count in most]
    ranks, done = np.empty(len(blocks), np.int64), 0
    while done < len(blocks):
        end = _compress(done, blocks, nodes, at_depth, sources, water, layer, tolerance, *used, *buffers, ranks)
        if end == done:  # a block that is larger than the buffers
            buffers = [np.empty(2 * len(buffer), complex) for buffer in buffers]
            continue
        starts = [0, 0]
        for (m, n), rank in zip(shapes[done:end], ranks[done:end], strict=True):
            U = buffers[0][starts[0] : starts[0] + m * rank].reshape(rank, m).T
            V = buffers[1][starts[1] : starts[1] + n * rank].reshape(rank, n)
            starts = [starts[0] + m * rank, starts[1] + n * rank]
            yield LowRank(U, V)
        done = end


@kernel()
def _compress(
    done, blocks, nodes, at_depth, sources, water, layer, tolerance, used_rows, used_columns, left, right, ranks
):  # fmt: skip
    """Fill the buffers with blocks from index `done` on until they are full; returns the index of the next one."""
    view = table_view(water.table)
    at_left, at_right = 0, 0
    for b in range(done, len(blocks)):
        low, high, start, end = blocks[b, 0], blocks[b, 1], blocks[b, 2], blocks[b, 3]
        sx, sy = float(blocks[b, 4]), float(blocks[b, 5])
        m, n = high - low, end - start
        most, enough = min(m, n), tolerance * math.sqrt(m * n)
        used_rows[:m] = False
        used_columns[:n] = False
        rank, row, looked, asked, full = 0, m // 2, 0, 0, False
        while rank < most and looked < LOOKED_AT:
            if at_left + (rank + 1) * m > len(left) or at_right + (rank + 1) * n > len(right):
                full = True
                break
            used_rows[row] = True
            # the row of the residual
            v, u = at_right + rank * n, at_left + rank * m
            x, y, z = sx * nodes[low + row, 0], sy * nodes[low + row, 1], nodes[low + row, 2]
            for j in range(n):
                right[v + j] = _entry(x, y, z, at_depth[low + row], start + j, sources, water, layer, view)
            _subtract(right, at_right, n, rank, left, at_left + row, m)
            column, square = _largest(right, v, n, used_columns)
            if column < 0 or square * m <= enough * enough:  # nothing is left of this row
                looked, asked = looked + 1, asked + 1
                row = _unused(used_rows, m, int(asked * GOLDEN % 1.0 * m))
                if row < 0:
                    break
                continue
            used_columns[column] = True
            pivot = 1 / right[v + column]
            for j in range(n):
                right[v + j] *= pivot
            square *= pivot.real**2 + pivot.imag**2
            for i in range(m):
                x, y, z = sx * nodes[low + i, 0], sy * nodes[low + i, 1], nodes[low + i, 2]
                left[u + i] = _entry(x, y, z, at_depth[low + i], start + column, sources, water, layer, view)
            _subtract(left, at_left, m, rank, right, at_right + column, n)
            row, column_square = _largest(left, u, m, used_rows)
            rank += 1
            looked = looked + 1 if square * column_square <= enough * enough else 0
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


@kernel(inline=True)
def _subtract(values, begin, count, rank, factors, at, step):
    """Subtract from the row or column number `rank` of a buffer, `count` long, the contribution of the previous ones

    factors : the other buffer, in which the factor of each is `step` after the previous one, from `at` on
    """
    for term in range(rank):
        factor = factors[at + term * step]
        for j in range(count):
            values[begin + rank * count + j] -= factor * values[begin + term * count + j]


@kernel(inline=True)
def _largest(values, begin, count, used):
    """The index of the largest of `count` unused values, −1 if there are only zeros, and the sum of all squares"""
    found, largest, total = -1, 0.0, 0.0
    for j in range(count):
        square = values[begin + j].real ** 2 + values[begin + j].imag ** 2
        total += square
        if not used[j] and square > largest:
            found, largest = j, square
    return found, total


@kernel(inline=True)
def _unused(used, count, begin):
    """The next unused index from `begin` on, or −1"""
    for i in range(count):
        at = (begin + i) % count
        if not used[at]:
            return at
    return -1


@kernel(inline=True)
def _entry(x, y, z, at_depth, j, sources, water, layer, view):
    """Layer of node j of the sources at the point (x, y, z)"""
    points, normals, weights, depth_z = sources.points, sources.normals, sources.weights, sources.depth_z
    factor, on_hull = water.table.C * at_depth, sources.hull[j]
    real, imaginary = 0.0, 0.0
    for q in range(sources.first[j], sources.first[j + 1]):
        dx, dy = points[q, 0] - x, points[q, 1] - y
        square = dx * dx + dy * dy
        R = math.sqrt(square)
        depths = depth_variables(z, points[q, 2])
        Z, slope = depth_z[q, 0], depth_z[q, 1]
        g, gr, gz, j0, j1 = wave_part(R, depths, factor * Z, factor * slope, view)
        height, above = points[q, 2] - z, points[q, 2] + z
        one = 1 / math.sqrt(square + height * height)
        two = 1 / math.sqrt(square + above * above)
        cube, mirrored = one * one * one, water.mirror * two * two * two
        third, below, below_cube = 0.0, 0.0, 0.0
        if water.bed:
            below = above - water.shift
            third = 1 / math.sqrt(square + below * below)
            below_cube = third * third * third
        if layer == SINGLE or not on_hull:
            real += weights[q] * (one + water.mirror * two + third + g)
            imaginary += weights[q] * factor * Z * j0
        else:
            flat = (normals[q, 0] * dx + normals[q, 1] * dy) / (R + 1e-300)
            radial, up = gr - R * (cube + mirrored + below_cube), normals[q, 2]
            vertical = gz - height * cube - above * mirrored - below * below_cube
            real += weights[q] * (radial * flat + vertical * up)
            imaginary += weights[q] * factor * (Z * j1 * flat + slope * j0 * up)
    if layer == DOUBLE and not on_hull:
        return water.table.K * complex(real, imaginary)
    return complex(real, imaginary)
