"""Wave part of the influence matrices S and D: blocks of given points and sources for all symmetry classes.

S and D are the integrals of G and ∂G/∂n over panels. `bem.panels.influence` integrates the Rankine part 1/r + 1/r₁ +
1/r₂; this module integrates the remainder of `bem.green.finite_depth` by Gauss quadrature. The imaginary part of G is
as smooth as the wave. On close panels only the real part is integrated with fine points, unless the wave is short
relative to the panels.
"""

import math
from typing import NamedTuple

import numpy as np

from ..green.deep_water import bessel as bessel_functions
from ..green.finite_depth import depth_variables, table_position, table_view, wave_part_at
from ..kernels.jit import kernel
from ..kernels.threads import parallel_rows

# a panel's wave part is integrated with FINE × FINE instead of COARSE × COARSE points if its surface image is closer
# than NEAR of its sizes, or if the wave or the depth is shorter than the panel divided by PER_WAVE
COARSE, FINE = 2, 4
NEAR, PER_WAVE = 1.0, 2.2


class Sources(NamedTuple):
    """m nodes of s panels, in compressed rows: nodes first[a] … first[a + 1] − 1 belong to panels[a]."""

    panels: np.ndarray  # (s,)
    first: np.ndarray  # (s + 1,)
    corners: np.ndarray  # (m,) number of each node within its panel

    @classmethod
    def of(cls, nodes, per_panel):
        """`Sources` from the indices of their nodes (m,), in increasing order."""
        nodes = np.asarray(nodes)
        panels, first = np.unique(nodes // per_panel, return_index=True)
        return cls(panels, np.append(first, len(nodes)), nodes % per_panel)


class Pairs(NamedTuple):
    """Data of r points and m sources on s panels that do not depend on frequency."""

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
        """`Pairs` of a `bem.panels.influence.Geometry`: points at the nodes `points` (r,), sources at `nodes` (m,), in
        increasing order

        classes : symmetry classes; None: all
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

    def blocks(self, table, depth_values, classes=slice(None)):
        """Wave part of S and D, each (classes, r, m) and complex.

        table : `bem.green.tables.Table`; depth_values : function z → (…, 2) of Z and Z′; classes : indices of the
            wanted classes
        """
        where, sources, signs = self.quadrature.points, self.sources, self.signs[classes]
        arguments = (
            self.at, depth_values(self.at[:, 2])[:, 0].copy(), sources.corners, sources.first,
            self.normals, self.origins, close_up_to(self.sizes, table.k, self.depth), self.images, signs, COARSE**2,
            *self.quadrature, depth_values(where[..., 2]), table,
        )  # fmt: skip
        S, D = np.zeros((2, len(signs), len(self.at), len(sources.corners)), complex)
        images, most = len(self.images), len(self.images) * self.quadrature.weights.shape[1]

        def work(low, high):
            workspace = np.empty(images, np.int64), np.empty((most, 3), np.int64), np.empty((most, 5))
            _blocks(low, high, *arguments, *workspace, S, D)

        parallel_rows(work, len(self.at), S[0].size * images)
        return S, D


def close_up_to(sizes, k, depth):
    """Largest distance to the surface image at which panels of the given sizes (m) use the fine points, m; shape
    (s,)"""
    length = min(1 / k if k > 0 else np.inf, depth)
    return np.where(sizes > PER_WAVE * length, np.inf, NEAR * sizes)


def wave_blocks(geometry, points, nodes, table, depth_values, classes=None):
    """Wave part of S and D, each (classes, r, m), for arguments of `Pairs.of` and `Pairs.blocks`"""
    return Pairs.of(geometry, points, nodes, classes).blocks(table, depth_values)


@kernel()
def _blocks(
    first_row, end_row, at, at_depth, corners, first, normals, centers, distances, images, signs,
    coarse, points, weights, shape, depth_z, table, chosen, pieces, values, S, D,
):  # fmt: skip
    """Rows `first_row` to `end_row` of S and D (classes, r, m), which are zero before.

    at (r, 3), at_depth (r,) Z; corners (m,), first (s + 1,) of `Sources`; then arrays over the s panels.

    points, weights, shape, depth_z : quadrature, first of the `coarse` points, then of the fine ones, which images
    closer than `distances` take.  Workspace of one thread: chosen (images,); of all pairs on a panel pieces (·, 3), the
    integers of `table_position`, and values (·, 5): R, ∂R/∂n and the local variables, later the values of G. There are
    no views of arrays and no array arguments of kernels that are not inlined: numba would update their reference
    counts, and two threads with one common count took longer than one; now each call has its own.  Computed indices are
    `uintp`: numba tests signed ones for negative values, an eighth of all time.
    """
    c, several, view = len(signs), shape.shape[2] > 1, table_view(table)
    for i in range(first_row, end_row):
        for j in range(len(distances)):
            for fine in range(2):
                count = _choose(at, i, centers, j, distances[j], images, fine == 1, chosen)
                at_nodes = several and fine == 0  # the 2 × 2 points are the nodes; some of a panel may be missing
                low, high = (coarse, weights.shape[1]) if fine == 1 else (0, coarse)
                if at_nodes:
                    low, high = first[j], first[j + 1]
                if count == 0:
                    continue
                # for waves long relative to the panel their imaginary part needs no fine points
                smooth = several and fine == 1 and distances[j] < math.inf
                if smooth:
                    _add_standing(
                        at, i, points, j, normals, images, count, corners, first, signs, table.C * at_depth[i], depth_z,
                        weights, view, chosen, S, D,
                    )  # fmt: skip
                _locate(
                    at, i, points, j, normals, images, count, corners, at_nodes, low, high, view, chosen, pieces, values
                )
                for n in range(low, high):
                    q = np.uintp(corners[n] if at_nodes else n)
                    depths, factor = depth_variables(at[i, 2], points[j, q, 2]), table.C * at_depth[i]
                    Z = depth_z[j, q, 0], depth_z[j, q, 1]
                    for m in range(count):
                        e = np.uintp((n - low) * count + m)
                        zone, surface, bed = pieces[e, 0], pieces[e, 1], pieces[e, 2]
                        position = zone, surface, bed, values[e, 2], values[e, 3], values[e, 4]
                        values[e, 0], values[e, 1], values[e, 2], values[e, 3] = _green_values(
                            position, values[e, 0], values[e, 1], depths, factor, Z, normals[j, 2], view
                        )
                    for a in range(c):
                        g, j0, flux, slope = 0.0, 0.0, 0.0, 0.0
                        for m in range(count):
                            sign, e = signs[a, np.uintp(chosen[m])], np.uintp((n - low) * count + m)
                            g += sign * values[e, 0]
                            j0 += sign * values[e, 1]
                            flux += sign * values[e, 2]
                            slope += sign * values[e, 3]
                        imaginary = 0.0 if smooth else factor
                        s = weights[j, q] * complex(g, imaginary * j0)
                        d = weights[j, q] * complex(flux, imaginary * slope)
                        if at_nodes:
                            S[a, i, np.uintp(n)] += s
                            D[a, i, np.uintp(n)] += d
                        else:
                            for m in range(first[j], first[j + 1]):
                                S[a, i, np.uintp(m)] += shape[j, q, np.uintp(corners[m])] * s
                                D[a, i, np.uintp(m)] += shape[j, q, np.uintp(corners[m])] * d


@kernel(inline=True)
def _choose(at, i, centers, j, distance, images, close, chosen):
    """Count of the images of panel j whose reflection in the surface is nearer than `distance`, or farther"""
    up = at[i, 2] + centers[j, 2]
    count = 0
    for m in range(len(images)):
        dx, dy = at[i, 0] - images[m, 0] * centers[j, 0], at[i, 1] - images[m, 1] * centers[j, 1]
        if (dx * dx + dy * dy + up * up < distance * distance) == close:
            chosen[count] = m
            count += 1
    return count


@kernel(inline=True)
def _locate(
    at, i, points, j, normals, images, count, corners, at_nodes, low, high, view, chosen, pieces, values
):  # fmt: skip
    """R, ∂R/∂n and `table_position` of the chosen images of all quadrature points of panel j.

    A separate loop before the one that evaluates G: one loop over both takes 1.3 times as long.
    """
    for n in range(low, high):
        q = np.uintp(corners[n] if at_nodes else n)
        depths = depth_variables(at[i, 2], points[j, q, 2])
        for m in range(count):
            e, o = np.uintp((n - low) * count + m), np.uintp(chosen[m])
            sx, sy = images[o, 0], images[o, 1]
            dx, dy = sx * points[j, q, 0] - at[i, 0], sy * points[j, q, 1] - at[i, 1]
            R = math.sqrt(dx * dx + dy * dy)
            values[e, 0] = R
            values[e, 1] = (sx * normals[j, 0] * dx + sy * normals[j, 1] * dy) / (R + 1e-300)
            zone, surface, bed, values[e, 2], values[e, 3], values[e, 4] = table_position(R, depths, view)
            pieces[e, 0], pieces[e, 1], pieces[e, 2] = zone, surface, bed


@kernel(inline=True)
def _add_standing(
    at, i, points, j, normals, images, count, corners, first, signs, factor, depth_z, weights, view, chosen, S, D
):  # fmt: skip
    """Add the imaginary part of the chosen images of panel j, integrated at its nodes"""
    for n in range(first[j], first[j + 1]):
        q = np.uintp(corners[n])
        for m in range(count):
            o = np.uintp(chosen[m])
            sx, sy = images[o, 0], images[o, 1]
            dx, dy = sx * points[j, q, 0] - at[i, 0], sy * points[j, q, 1] - at[i, 1]
            R = math.sqrt(dx * dx + dy * dy)
            along = (sx * normals[j, 0] * dx + sy * normals[j, 1] * dy) / (R + 1e-300)
            j0, _, j1, _ = bessel_functions(view.k * R, view.bessel)
            s = weights[j, q] * factor * depth_z[j, q, 0] * j0
            d = depth_z[j, q, 0] * view.k * j1 * along + depth_z[j, q, 1] * j0 * normals[j, 2]
            for a in range(len(signs)):
                S[a, i, np.uintp(n)] += complex(0.0, signs[a, o] * s)
                D[a, i, np.uintp(n)] += complex(0.0, signs[a, o] * weights[j, q] * factor * d)


@kernel(inline=True)
def _green_values(position, R, along, depths, factor, Z, upwards, view):
    """Real part of G and imaginary part over `factor` of one image, then the same of ∂G/∂n"""
    g, gr, gz, j0, j1 = wave_part_at(position, R, depths, factor * Z[0], factor * Z[1], view)
    return g, Z[0] * j0, gr * along + gz * upwards, Z[0] * j1 * along + Z[1] * j0 * upwards
