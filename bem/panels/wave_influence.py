"""Blocks of the wave part of S and D: some points, some sources, all symmetry classes.

S and D are the integrals over panels of `bem.panels.influence`; the exact part of 1/r and its images is there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..green.finite_depth import layout_of, levels, spot, wave_part_at
from ..kernels.jit import kernel
from ..kernels.threads import share_rows

# the wave part of a panel is integrated with FINE × FINE instead of COARSE × COARSE points where its surface image is
# closer than NEAR of its sizes, or where the wave or the depth is shorter than the panel divided by PER_WAVE
COARSE, FINE = 2, 4
NEAR, PER_WAVE = 1.0, 2.2


class Sources(NamedTuple):
    """m nodes of s panels: first[a] to first[a + 1] are those of panels[a]."""

    panels: np.ndarray  # (s,)
    first: np.ndarray  # (s + 1,)
    corners: np.ndarray  # (m,) which of its panel's nodes each is

    @classmethod
    def of(cls, nodes, per_panel):
        """Sources at the nodes (m,), which increase."""
        nodes = np.asarray(nodes)
        panels, first = np.unique(nodes // per_panel, return_index=True)
        return cls(panels, np.append(first, len(nodes)), nodes % per_panel)


class Pairs(NamedTuple):
    """Some points, some sources and what no frequency changes about them; arrays over the panels of the sources."""

    at: np.ndarray  # (r, 3) m
    sources: Sources
    normals: np.ndarray  # (s, 3)
    origins: np.ndarray  # (s, 3) m
    sizes: np.ndarray  # (s,) m
    quadrature: object  # `bem.panels.elements.Quadrature`
    images: np.ndarray  # (images, 2) ±1
    signs: np.ndarray  # (classes, images) ±1
    depth: float

    @classmethod
    def of(cls, geometry, points, nodes, classes=None):
        """The nodes `points` (r,) of a `bem.panels.influence.Geometry`, sources at `nodes` (m,), which increase

        classes : all if None
        """
        g, e = geometry, geometry.elements
        sources = Sources.of(nodes, e.inverse.shape[2])
        its = sources.panels
        quadrature = g.quadrature._make(a[its] for a in g.quadrature)
        signs = g.all_signs if classes is None else np.array([g.signs(c) for c in classes])
        return cls(
            e.nodes[points], sources, e.axes[its, 2].copy(), e.origins[its], e.sizes[its],
            quadrature, g.images, signs, g.depth,
        )  # fmt: skip

    def blocks(self, table, depth_values, mine=slice(None)):
        """Wave part of S and D, each (classes, r, m) and complex.

        table : `bem.green.tables.Table`; depth_values : z → (…, 2) of Z and Z′; mine : which of the classes
        """
        where, sources, signs = self.quadrature.points, self.sources, self.signs[mine]
        length = min(1 / table.k if table.k > 0 else np.inf, self.depth)
        question = (
            self.at, depth_values(self.at[:, 2])[:, 0].copy(), sources.corners, sources.first,
            self.normals, self.origins, np.where(self.sizes > PER_WAVE * length, np.inf, NEAR * self.sizes),
            self.images, signs, COARSE**2, *self.quadrature, depth_values(where[..., 2]), table,
        )  # fmt: skip
        S, D = np.zeros((2, len(signs), len(self.at), len(sources.corners)), complex)
        images, most = len(self.images), len(self.images) * self.quadrature.weights.shape[1]

        def work(low, high):
            room = np.empty(images, np.int64), np.empty((most, 3), np.int64), np.empty((most, 5))
            _blocks(low, high, *question, *room, S, D)

        share_rows(work, len(self.at), S[0].size * images)
        return S, D


def wave_blocks(geometry, points, nodes, table, depth_values, classes=None):
    """`Pairs.blocks` of `Pairs.of` the same arguments"""
    return Pairs.of(geometry, points, nodes, classes).blocks(table, depth_values)


@kernel()
def _blocks(
    first_row, end_row, at, at_depth, corners, first, normals, centers, distances, images, signs,
    coarse, points, weights, shape, depth_z, table, chosen, pieces, seen, S, D,
):  # fmt: skip
    """Of the points `first_row` to `end_row` into S and D (classes, r, m), zero before.

    at (r, 3), at_depth (r,) Z; corners (m,), first (s + 1,) of `Sources`; then arrays over the s panels.

    points, weights, shape, depth_z : of the `coarse` points, then of the fine ones, which images closer than
    `distances` take.  Room for one thread: chosen (images,), and of all pairs of a panel the `pieces` (·, 3) and
    `seen` (·, 5), R, its slope and the pieces' variables, later the values.  No part of an array has a name here, and
    no array goes to a kernel that is not put in place: it would be counted each time.  Where all threads shared one
    count two of them took longer than one; now each call has its own.  Indices that are computed or read are `uintp`:
    of signed ones numba asks each time whether they count from the end, an eighth of all time.
    """
    c, several, layout = len(signs), shape.shape[2] > 1, layout_of(table)
    for i in range(first_row, end_row):
        for j in range(len(distances)):
            for fine in range(2):
                count = _choose(at, i, centers, j, distances[j], images, fine == 1, chosen)
                at_nodes = several and fine == 0  # the 2 × 2 points are the nodes, and may come alone
                low, high = (coarse, weights.shape[1]) if fine == 1 else (0, coarse)
                if at_nodes:
                    low, high = first[j], first[j + 1]
                if count == 0:
                    continue
                _look_out(
                    at, i, points, j, normals, images, count, corners, at_nodes, low, high, layout, chosen, pieces, seen
                )
                for n in range(low, high):
                    q = np.uintp(corners[n] if at_nodes else n)
                    level, factor = levels(at[i, 2], points[j, q, 2]), table.C * at_depth[i]
                    Z = depth_z[j, q, 0], depth_z[j, q, 1]
                    for m in range(count):
                        e = np.uintp((n - low) * count + m)
                        zone, surface, bed = pieces[e, 0], pieces[e, 1], pieces[e, 2]
                        place = zone, surface, bed, seen[e, 2], seen[e, 3], seen[e, 4]
                        seen[e, 0], seen[e, 1], seen[e, 2], seen[e, 3] = _see(
                            place, seen[e, 0], seen[e, 1], level, factor, Z, normals[j, 2], layout
                        )
                    for a in range(c):
                        g, j0, flux, slope = 0.0, 0.0, 0.0, 0.0
                        for m in range(count):
                            sign, e = signs[a, np.uintp(chosen[m])], np.uintp((n - low) * count + m)
                            g += sign * seen[e, 0]
                            j0 += sign * seen[e, 1]
                            flux += sign * seen[e, 2]
                            slope += sign * seen[e, 3]
                        s = weights[j, q] * complex(g, factor * j0)
                        d = weights[j, q] * complex(flux, factor * slope)
                        if at_nodes:
                            S[a, i, np.uintp(n)] += s
                            D[a, i, np.uintp(n)] += d
                        else:
                            for m in range(first[j], first[j + 1]):
                                S[a, i, np.uintp(m)] += shape[j, q, np.uintp(corners[m])] * s
                                D[a, i, np.uintp(m)] += shape[j, q, np.uintp(corners[m])] * d


@kernel(inline=True)
def _choose(at, i, centers, j, distance, images, close, chosen):
    """The images whose own images in the surface are closer than `distance`, or if not `close` the others; how many"""
    up = at[i, 2] + centers[j, 2]
    count = 0
    for m in range(len(images)):
        dx, dy = at[i, 0] - images[m, 0] * centers[j, 0], at[i, 1] - images[m, 1] * centers[j, 1]
        if (dx * dx + dy * dy + up * up < distance * distance) == close:
            chosen[count] = m
            count += 1
    return count


@kernel(inline=True)
def _look_out(
    at, i, points, j, normals, images, count, corners, at_nodes, low, high, layout, chosen, pieces, seen
):  # fmt: skip
    """`spot` of the chosen images of all points of panel j, R and its derivative along the normal.

    All before the first is evaluated: the processor sees few pairs at a time, and in turn they take 1.3 times as long.
    """
    for n in range(low, high):
        q = np.uintp(corners[n] if at_nodes else n)
        level = levels(at[i, 2], points[j, q, 2])
        for m in range(count):
            e, o = np.uintp((n - low) * count + m), np.uintp(chosen[m])
            sx, sy = images[o, 0], images[o, 1]
            dx, dy = sx * points[j, q, 0] - at[i, 0], sy * points[j, q, 1] - at[i, 1]
            R = math.sqrt(dx * dx + dy * dy)
            seen[e, 0] = R
            seen[e, 1] = (sx * normals[j, 0] * dx + sy * normals[j, 1] * dy) / (R + 1e-300)
            zone, surface, bed, seen[e, 2], seen[e, 3], seen[e, 4] = spot(R, level, layout)
            pieces[e, 0], pieces[e, 1], pieces[e, 2] = zone, surface, bed


@kernel(inline=True)
def _see(place, R, along, level, factor, Z, upwards, layout):
    """Of one image the real part of G and the imaginary part over `factor`, then the same of ∂G/∂n."""
    g, gr, gz, j0, j1 = wave_part_at(place, R, level, factor * Z[0], factor * Z[1], layout)
    return g, Z[0] * j0, gr * along + gz * upwards, Z[0] * j1 * along + Z[1] * j0 * upwards
