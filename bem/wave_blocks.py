"""Blocks of the wave part of S and D: some points, some sources, all symmetry classes.

S and D are the integrals over panels of `bem.influence`; the exact part of 1/r and its images is there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import prange

from .green import layout_of, levels, wave_part
from .jit import kernel

# the wave part of a panel is integrated with 4 × 4 instead of 2 × 2 points where its surface image is closer than
# NEAR of its sizes, or where the wave or the depth is shorter than the panel divided by COARSE
NEAR, COARSE = 1.0, 2.2


class Sources(NamedTuple):
    """Nodes of some panels: nodes[first[a]:first[a + 1]] are those of panels[a]."""

    nodes: np.ndarray  # (m,)
    panels: np.ndarray  # (s,)
    first: np.ndarray  # (s + 1,)
    corners: np.ndarray  # (m,) which of its panel's nodes each is

    @classmethod
    def of(cls, nodes, per_panel):
        """Sources at the nodes (m,), which increase."""
        nodes = np.asarray(nodes)
        panels, first = np.unique(nodes // per_panel, return_index=True)
        return cls(nodes, panels, np.append(first, len(nodes)), nodes % per_panel)


def wave_blocks(geometry, points, sources, table, depth_values, classes=None):
    """Wave part of S and D at nodes (r,) of `sources` (m), each (classes, r, m) and complex.

    table : `bem.green_tables.Table`; depth_values : z → (…, 2) of Z and Z′; classes : all if None
    """
    g, e = geometry, geometry.elements
    length = min(1 / table.k if table.k > 0 else np.inf, g.depth)
    coarse, fine = ([a[sources.panels] for a in q] for q in (g.coarse_points, g.fine_points))
    at = e.nodes[points]
    return _blocks(
        at, depth_values(at[:, 2])[:, 0].copy(), sources.corners, sources.first,
        e.axes[sources.panels, 2].copy(), e.origins[sources.panels], e.sizes[sources.panels],
        (e.sizes > COARSE * length)[sources.panels],
        g.images, np.array([g.signs(c) for c in (g.classes if classes is None else classes)]),
        *coarse, depth_values(coarse[0][..., 2]), *fine, depth_values(fine[0][..., 2]), table,
    )  # fmt: skip


@kernel(parallel=True)
def _blocks(
    at, at_depth, corners, first, normals, centers, sizes, always_fine, images, signs,
    points, weights, shape, depth_z, fine_points, fine_weights, fine_shape, fine_z, table,
):  # fmt: skip
    """at (r, 3), at_depth (r,) Z; corners (m,), first (s + 1,) of `Sources`; then arrays over the s panels"""
    c, p = len(signs), shape.shape[2]
    S, D = np.zeros((2, c, len(at), len(corners)), np.complex128)
    for i in prange(len(at)):
        work = np.empty((4, c))
        s, d = np.empty((2, c, p), np.complex128)
        for j in range(len(sizes)):
            near = always_fine[j] or _close(at[i], centers[j], NEAR * sizes[j], images)
            # a node of a bilinear panel is one of its 2 × 2 points, and may come alone
            alone = p > 1 and not near and first[j + 1] - first[j] < p
            if not alone:
                s[:], d[:] = 0.0, 0.0
                if near:
                    _panel(at[i], normals[j], images, signs, fine_points[j], fine_weights[j], fine_shape[j],
                           fine_z[j], at_depth[i], table, work, s, d)  # fmt: skip
                else:
                    _panel(at[i], normals[j], images, signs, points[j], weights[j], shape[j], depth_z[j],
                           at_depth[i], table, work, s, d)  # fmt: skip
            for m in range(first[j], first[j + 1]):
                b = corners[m]
                if alone:
                    s[:, b], d[:, b] = 0.0, 0.0
                    q = slice(b, b + 1)
                    _panel(at[i], normals[j], images, signs, points[j, q], weights[j, q], shape[j, q], depth_z[j, q],
                           at_depth[i], table, work, s, d)  # fmt: skip
                for a in range(c):
                    S[a, i, m], D[a, i, m] = s[a, b], d[a, b]
    return S, D


@kernel()
def _close(point, center, distance, images):
    up = point[2] + center[2]
    if -up > distance:
        return False
    for m in range(len(images)):
        dx, dy = point[0] - images[m, 0] * center[0], point[1] - images[m, 1] * center[1]
        if dx * dx + dy * dy + up * up < distance * distance:
            return True
    return False


@kernel()
def _panel(point, normal, images, signs, points, weights, shape, depth_z, node_z, table, work, S, D):
    """Wave part of one panel, all images and classes, added to S and D (classes, p); work : (4, classes) scratch."""
    x, y, z = point[0], point[1], point[2]
    layout = layout_of(table)
    c, p = S.shape
    at_nodes = p > 1 and len(weights) == p  # 2 × 2 points of a bilinear panel are its nodes: shape is the identity
    for q in range(len(weights)):
        level = levels(z, points[q, 2])
        amplitude = table.C * node_z
        wave, wave_slope = amplitude * depth_z[q, 0], amplitude * depth_z[q, 1]
        work[:] = 0.0
        for m in range(len(images)):
            dx, dy = images[m, 0] * points[q, 0] - x, images[m, 1] * points[q, 1] - y
            R = math.sqrt(dx * dx + dy * dy)
            g, gr, gz, j0, j1 = wave_part(R, level, wave, wave_slope, layout)
            along = (images[m, 0] * normal[0] * dx + images[m, 1] * normal[1] * dy) / (R + 1e-300)
            flux = gr * along + gz * normal[2]
            slope = depth_z[q, 0] * j1 * along + depth_z[q, 1] * j0 * normal[2]
            for a in range(c):
                sign = signs[a, m]
                work[0, a] += sign * g
                work[1, a] += sign * j0
                work[2, a] += sign * flux
                work[3, a] += sign * slope
        w, C = weights[q], weights[q] * table.C * node_z
        for a in range(c):
            s = complex(w * work[0, a], C * depth_z[q, 0] * work[1, a])
            d = complex(w * work[2, a], C * work[3, a])
            if at_nodes:
                S[a, q] += s
                D[a, q] += d
            else:
                for b in range(p):
                    S[a, b] += shape[q, b] * s
                    D[a, b] += shape[q, b] * d
