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
        layout = layout_of(table)
        work, near = np.empty((4, c)), np.empty(len(images), np.bool_)
        s, d = np.empty((2, c, p), np.complex128)
        for j in range(len(sizes)):
            near[:] = always_fine[j]
            close = _mark_close(near, at, i, centers, j, NEAR * sizes[j], images)
            begin, end = first[j], first[j + 1]
            between = close > 0 or p == 1
            if between:
                s[:], d[:] = 0.0, 0.0
                if close > 0:
                    _add_points(at, i, at_depth[i], normals, j, images, signs, near, True, fine_points, fine_weights,
                                fine_shape, fine_z, table.C, layout, work, s, d)  # fmt: skip
                if close < len(images) and p == 1:
                    _add_points(at, i, at_depth[i], normals, j, images, signs, near, False, points, weights, shape,
                                depth_z, table.C, layout, work, s, d)  # fmt: skip
                for m in range(begin, end):
                    for a in range(c):
                        S[a, i, m], D[a, i, m] = s[a, corners[m]], d[a, corners[m]]
            if close < len(images) and p > 1:  # the 2 × 2 points are the nodes, and may come alone
                for m in range(begin, end):
                    q = corners[m]
                    amplitude = table.C * at_depth[i]
                    _sum_images(
                        at, i, normals, j, images, signs, near, False, points, q, depth_z, amplitude, layout, work
                    )
                    w, imaginary = weights[j, q], weights[j, q] * amplitude
                    for a in range(c):
                        S[a, i, m] += complex(w * work[0, a], imaginary * depth_z[j, q, 0] * work[1, a])
                        D[a, i, m] += complex(w * work[2, a], imaginary * work[3, a])
    return S, D


@kernel()
def _mark_close(near, at, i, centers, j, distance, images):
    """Sets near (images,) where the surface's image of an image is closer than `distance`; how many are set"""
    up = at[i, 2] + centers[j, 2]
    if -up <= distance:
        for m in range(len(images)):
            dx, dy = at[i, 0] - images[m, 0] * centers[j, 0], at[i, 1] - images[m, 1] * centers[j, 1]
            near[m] |= dx * dx + dy * dy + up * up < distance * distance
    return np.count_nonzero(near)


@kernel()
def _add_points(
    at, i, at_depth, normals, j, images, signs, near, wanted, points, weights, shape, depth_z, C, layout, work, S, D
):
    """Wave part of panel j, integrated over `points`, added to S and D (classes, p)."""
    c, p = S.shape
    for q in range(weights.shape[1]):
        _sum_images(at, i, normals, j, images, signs, near, wanted, points, q, depth_z, C * at_depth, layout, work)
        w, imaginary = weights[j, q], weights[j, q] * C * at_depth
        for a in range(c):
            s = complex(w * work[0, a], imaginary * depth_z[j, q, 0] * work[1, a])
            d = complex(w * work[2, a], imaginary * work[3, a])
            for b in range(p):
                S[a, b] += shape[j, q, b] * s
                D[a, b] += shape[j, q, b] * d


@kernel()
def _sum_images(at, i, normals, j, images, signs, near, wanted, points, q, depth_z, amplitude, layout, work):
    """Real and imaginary part of G and ∂G/∂n of point q of panel j, summed over images into work (4, classes).

    Images whose `near` is `wanted` count; the imaginary parts lack C Z(z), that of G lacks Z(ζ) too
    """
    x, y, z, px, py = at[i, 0], at[i, 1], at[i, 2], points[j, q, 0], points[j, q, 1]
    nx, ny, nz = normals[j, 0], normals[j, 1], normals[j, 2]
    value, slope = depth_z[j, q, 0], depth_z[j, q, 1]
    level = levels(z, points[j, q, 2])
    work[:] = 0.0
    for m in range(len(images)):
        if near[m] != wanted:
            continue
        dx, dy = images[m, 0] * px - x, images[m, 1] * py - y
        R = math.sqrt(dx * dx + dy * dy)
        g, gr, gz, j0, j1 = wave_part(R, level, amplitude * value, amplitude * slope, layout)
        along = (images[m, 0] * nx * dx + images[m, 1] * ny * dy) / (R + 1e-300)
        flux = gr * along + gz * nz
        imaginary = value * j1 * along + slope * j0 * nz
        for a in range(signs.shape[0]):
            sign = signs[a, m]
            work[0, a] += sign * g
            work[1, a] += sign * j0
            work[2, a] += sign * flux
            work[3, a] += sign * imaginary
