"""Wave part of near blocks: one evaluation of G gives single and double layer in both directions of a pair of leaves.

A block and its transpose belong to a pair of leaves and a mirror image. The first leaf of the pair evaluates both
directions. A block whose transpose is a far block, and the block of a leaf with itself, are evaluated in one direction
only.  Integrals are those of `bem.panels.wave_influence`, real parts alone: with the nodes, or with finer points on
panels whose surface image is close.  Two ships of 12 000 nodes take 0.4 s; with separate directions and with
imaginary parts they take 0.95 s.
"""

import math
from typing import NamedTuple

import numpy as np

from ...green.finite_depth import depth_variables, standing_part_at, table_position, table_view
from ...kernels.jit import kernel
from ..reciprocal_pairs import NODES
from ..wave_influence import COARSE, close_up_to


class Share(NamedTuple):
    """Blocks that one leaf evaluates, side by side, with m nodes of other leaves; the first `both` of these nodes in
    both directions"""

    nodes: np.ndarray  # (m,)
    images: np.ndarray  # (m,)
    both: int
    blocks: list  # (number of the other leaf, slice of the m, first column in its own matrix, in that of the other)


class Panels(NamedTuple):
    """Data of s panels with 4 s nodes, and f fine points on each panel, for the kernels"""

    nodes: np.ndarray  # (4 s, 3) m
    weights: np.ndarray  # (4 s,) m²
    depth_z: np.ndarray  # (4 s, 2) Z and Z′
    normals: np.ndarray  # (s, 3)
    centers: np.ndarray  # (s, 3) m
    squares: np.ndarray  # (s,) m², of the distances of `close_up_to`
    lid: np.ndarray  # (s,) whether a panel is of the lid: K times the single layer replaces the double one
    points: np.ndarray  # (s, f, 3) m
    fine_weights: np.ndarray  # (s, f) m²
    shape: np.ndarray  # (s, f, 4)
    fine_z: np.ndarray  # (s, f, 2) Z and Z′

    @classmethod
    def of(cls, elements, quadrature, hull, table, depth, depth_values):
        """hull : whether each node is on the hull, (4 s,); other arguments as in `bem.panels.wave_influence`"""
        e, (points, *others) = elements, (np.ascontiguousarray(part[:, COARSE**2 :]) for part in quadrature)
        close = close_up_to(e.sizes, table.k, depth)
        return cls(
            e.nodes, e.weights, depth_values(e.nodes[:, 2]), e.axes[:, 2].copy(), e.origins, close**2, ~hull[::NODES],
            points, *others, depth_values(points[..., 2]),
        )  # fmt: skip


def shares(spans, near):
    """`Share` of each leaf.

    spans : {leaf: slice of its nodes}, in the order of the leaves; near : target, source and image of near blocks,
        (·, 3)
    """
    number = {leaf: i for i, leaf in enumerate(spans)}
    places, own = {}, {leaf: [] for leaf in spans}
    for t, s, m in near[np.lexsort((near[:, 1], near[:, 2], near[:, 0]))].tolist():
        before = own[t][-1] if own[t] else None
        places[t, s, m] = places[before] + _count(spans[before[1]]) if before else 0
        own[t].append((t, s, m))
    out = []
    for leaf, keys in own.items():
        mutual = [(key[1], leaf, key[2]) in places and key[1] != leaf for key in keys]
        both = [key for key, of_two in zip(keys, mutual, strict=True) if of_two and number[key[1]] > number[leaf]]
        alone = [key for key, of_two in zip(keys, mutual, strict=True) if not of_two]
        ends = np.cumsum([0, *(_count(spans[s]) for _, s, _ in both + alone)])
        blocks = [
            (number[s], slice(*ends[i : i + 2].tolist()), places[t, s, m], places.get((s, t, m)))
            for i, (t, s, m) in enumerate(both + alone)
        ]
        nodes = np.concatenate([np.arange(spans[s].start, spans[s].stop) for _, s, _ in both + alone] or [ends[:0]])
        images = np.repeat([m for *_, m in both + alone], np.diff(ends)).astype(int)
        out.append(Share(nodes, images, int(ends[len(both)]), blocks))
    return out


def _count(span):
    return span.stop - span.start


def near_waves(span, share, images, panels, table):
    """S and D (k, m) at the k nodes of a leaf from the m nodes of its `Share`, and the transposed S and D from the
    leaf to the first `both` of the m nodes

    span : slice of the nodes of the leaf; images : (i, 2) ±1; panels : `Panels`; table : `bem.green.tables.Table`
    """
    k, m = _count(span), len(share.nodes)
    there, back = np.zeros((2, k, m)), np.zeros((2, k, share.both))
    signs = np.ascontiguousarray(images[share.images])
    given = span.start, span.stop, share.nodes, signs, share.both, panels, table
    _at_nodes(*given, np.empty((m, 3), np.int64), np.empty((m, 8)), *there, *back)
    _with_fine_points(*given, *there, *back)
    return (*there, *back)


@kernel(counted=False)
def _at_nodes(low, high, columns, signs, both, panels, table, pieces, values, S, D, S_back, D_back):
    """Pairs of the nodes `low` to `high` and `columns` that are integrated at the nodes; workspace (m, 3) and (m, 8)"""
    view, C, K = table_view(table), table.C, table.K
    nodes, weights, depth_z, normals = panels.nodes, panels.weights, panels.depth_z, panels.normals
    centers, squares, lid = panels.centers, panels.squares, panels.lid
    for i in range(low, high):
        a, row = i // 4, np.uintp(i - low)
        x, y, z = nodes[i, 0], nodes[i, 1], nodes[i, 2]
        nx, ny = normals[a, 0], normals[a, 1]
        for e in range(len(columns)):
            c, j = np.uintp(e), np.uintp(columns[e])
            b, sx, sy = np.uintp(columns[e] // 4), signs[e, 0], signs[e, 1]
            dx, dy = sx * nodes[j, 0] - x, sy * nodes[j, 1] - y
            R = math.sqrt(dx * dx + dy * dy)
            inverse = 1 / (R + 1e-300)
            values[c, 0] = R
            values[c, 1] = (sx * normals[b, 0] * dx + sy * normals[b, 1] * dy) * inverse
            values[c, 2] = -(nx * dx + ny * dy) * inverse
            zone, surface, bed, values[c, 3], values[c, 4], values[c, 5] = table_position(
                R, depth_variables(z, nodes[j, 2]), view
            )
            pieces[c, 0], pieces[c, 1], pieces[c, 2] = zone, surface, bed
            ex, ey, up = x - sx * centers[b, 0], y - sy * centers[b, 1], z + centers[b, 2]
            values[c, 6] = weights[j] if ex * ex + ey * ey + up * up >= squares[b] else 0.0
            ex, ey, up = nodes[j, 0] - sx * centers[a, 0], nodes[j, 1] - sy * centers[a, 1], nodes[j, 2] + centers[a, 2]
            values[c, 7] = weights[i] if e < both and ex * ex + ey * ey + up * up >= squares[a] else 0.0
        for e in range(len(columns)):
            c, j, b = np.uintp(e), np.uintp(columns[e]), np.uintp(columns[e] // 4)
            there, back = values[c, 6], values[c, 7]
            if there + back == 0.0:
                continue
            position = pieces[c, 0], pieces[c, 1], pieces[c, 2], values[c, 3], values[c, 4], values[c, 5]
            factor, factor_back = C * depth_z[i, 0], C * depth_z[i, 1]
            g, gr, by_zeta, by_z = standing_part_at(
                position, values[c, 0], depth_variables(z, nodes[j, 2]),
                factor * depth_z[j, 0], factor * depth_z[j, 1], factor_back * depth_z[j, 0], view,
            )  # fmt: skip
            S[row, c] = there * g
            D[row, c] = there * (K * g if lid[b] else gr * values[c, 1] + by_zeta * normals[b, 2])
            if e < both:
                S_back[row, c] = back * g
                D_back[row, c] = back * (K * g if lid[a] else gr * values[c, 2] + by_z * normals[a, 2])


@kernel(counted=False)
def _with_fine_points(low, high, columns, signs, both, panels, table, S, D, S_back, D_back):
    """The other pairs, panel by panel, with the fine points of the panel"""
    view, nodes, centers, squares = table_view(table), panels.nodes, panels.centers, panels.squares
    for a in range(low // 4, high // 4):
        row = 4 * a - low
        for first in range(0, len(columns), 4):
            b, sx, sy = columns[first] // 4, signs[first, 0], signs[first, 1]
            for p in range(4):
                i, j = 4 * a + p, 4 * b + p
                ex, ey, up = (
                    nodes[i, 0] - sx * centers[b, 0],
                    nodes[i, 1] - sy * centers[b, 1],
                    nodes[i, 2] + centers[b, 2],
                )
                if ex * ex + ey * ey + up * up < squares[b]:
                    for q in range(panels.fine_weights.shape[1]):
                        s, d = _of_fine_point(i, b, q, sx, sy, panels, table.C, table.K, view)
                        for k in range(4):
                            S[np.uintp(row + p), np.uintp(first + k)] += panels.shape[b, q, k] * s
                            D[np.uintp(row + p), np.uintp(first + k)] += panels.shape[b, q, k] * d
                ex, ey, up = (
                    nodes[j, 0] - sx * centers[a, 0],
                    nodes[j, 1] - sy * centers[a, 1],
                    nodes[j, 2] + centers[a, 2],
                )
                if first < both and ex * ex + ey * ey + up * up < squares[a]:
                    for q in range(panels.fine_weights.shape[1]):
                        s, d = _of_fine_point(j, a, q, sx, sy, panels, table.C, table.K, view)
                        for k in range(4):
                            S_back[np.uintp(row + k), np.uintp(first + p)] += panels.shape[a, q, k] * s
                            D_back[np.uintp(row + k), np.uintp(first + p)] += panels.shape[a, q, k] * d


@kernel(inline=True, counted=False)
def _of_fine_point(i, b, q, sx, sy, panels, C, K, view):
    """Weighted G and ∂G/∂n, or K G on the lid, of fine point q of panel b, mirrored, at node i"""
    nodes, points, normals = panels.nodes, panels.points, panels.normals
    dx, dy = sx * points[b, q, 0] - nodes[i, 0], sy * points[b, q, 1] - nodes[i, 1]
    R, depths = math.sqrt(dx * dx + dy * dy), depth_variables(nodes[i, 2], points[b, q, 2])
    along = (sx * normals[b, 0] * dx + sy * normals[b, 1] * dy) / (R + 1e-300)
    factor = C * panels.depth_z[i, 0]
    g, gr, by_zeta, _ = standing_part_at(
        table_position(R, depths, view), R, depths,
        factor * panels.fine_z[b, q, 0], factor * panels.fine_z[b, q, 1], 0.0, view,
    )  # fmt: skip
    weight = panels.fine_weights[b, q]
    return weight * g, weight * (K * g if panels.lid[b] else gr * along + by_zeta * normals[b, 2])
