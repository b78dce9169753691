"""Influence matrices of the direct boundary integral equation, one per symmetry class.

With n out of the body, V = ∂φ/∂n, S and D the panel integrals of G and ∂G/∂n, the potential on the hull and an
auxiliary density φ' on the interior free surface (the lid) satisfy

    hull:  2πφ − Dφ − K S φ' = −S V
    lid:   4πφ' + K S φ' + Dφ =  S V

The exact solution has φ' = 0.  The lid row makes the fictitious flow inside the hull one with ∂w/∂z = 0 on its free
surface, so that it has no resonance: no irregular frequency at any ω (cf. Lee, Newman & Zhu 1996).

Mirror planes split the unknowns into classes, even or odd in x and in y; a class sees each panel together with
its images, their potentials equal or opposite.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
from numba import prange

from .elements import elements, quadrature
from .green import layout_of, levels, wave_part
from .jit import kernel
from .modes import class_of, normal_velocities
from .rankine import panel_moments

# the wave part of a panel is integrated with 4 × 4 instead of 2 × 2 points where its surface image is closer than
# NEAR of its sizes, or where the wave or the depth is shorter than the panel divided by COARSE
NEAR, COARSE = 1.0, 2.2


class Geometry:
    """Everything that depends on the mesh and the depth only: nodes, images, exact 1/r integrals.

    wall : y in m of a vertical wall that reflects all waves, along x; None for open water.  The wall takes the place
    of the mirror plane y = 0: the mesh is shifted by `origin`, what lies behind the wall is the image of the body,
    and flow is even about it.
    """

    def __init__(self, mesh, lid, depth, per_panel=4, wall=None):
        self.wall, self.depth = wall, depth
        self.origin = np.array([0.0, 0.0 if wall is None else -wall, 0.0])
        if wall is not None:
            mesh, lid = (_before_wall(part, wall) for part in (mesh, lid))
        self.mesh = mesh
        self.panels = mesh if lid is None else _stacked(mesh, lid)
        self.elements = elements(self.panels, per_panel)
        self.hull = len(mesh) * per_panel
        self.coarse_points = quadrature(self.panels, self.elements, 2)
        self.fine_points = quadrature(self.panels, self.elements, 4)
        self.images = np.array(mesh.reflections(), float)
        ones = {True: (1, -1), False: (1,)}
        self.classes = tuple(
            (x, y) for y in ones["y" in mesh.symmetry and wall is None] for x in ones["x" in mesh.symmetry]
        )
        self.copies = len(self.images) // (1 if wall is None else 2)

    @cached_property
    def reach(self):
        """m, largest horizontal distance between two points of the whole hull"""
        xy = self.panels.points[:, :2]
        low, high = xy.min(axis=0), xy.max(axis=0)
        for axis in range(2):
            if "xy"[axis] in self.mesh.symmetry:
                high[axis] = max(high[axis], -low[axis])
                low[axis] = -high[axis]
        return float(np.hypot(*(high - low)))

    @cached_property
    def radius(self):
        """m, largest distance of the hull from the vertical axis through the origin"""
        return float(np.hypot(*(self.panels.points - self.origin)[:, :2].T).max())

    @property
    def modes(self):
        """(hull nodes, 6) normal velocities of unit motions about the body's origin"""
        n = self.hull
        return normal_velocities(self.elements.nodes[:n] - self.origin, self.elements.normals[:n])

    def members(self, cls):
        """Degrees of freedom that a symmetry class holds."""
        symmetry = self.mesh.symmetry if self.wall is None else self.mesh.symmetry.replace("y", "")
        return [d for d in range(6) if class_of(d, symmetry) == cls]

    def signs(self, cls):
        """(images,) ±1: the potential of each image in a class"""
        return np.array([(cls[0] if x < 0 else 1) * (cls[1] if y < 0 else 1) for x, y in self.images], float)

    @cached_property
    def rankine(self):
        """S and D of 1/r + 1/r₂ + 1/r₁, then of 1/r₁ alone; each (classes, n, n) and real"""
        e = self.elements
        signs = np.array([self.signs(c) for c in self.classes])
        bed = np.isfinite(self.depth)
        shift = -2 * self.depth if bed else 0.0
        return _rankine_classes(e, self.images, signs, bed, shift)


def _before_wall(mesh, wall):
    """The mesh with the wall in y = 0, on whose other side its image is."""
    if mesh is None:
        return None
    if "y" in mesh.symmetry:
        mesh = replace(replace(mesh, symmetry="y").whole(), symmetry=mesh.symmetry.replace("y", ""))
    points = mesh.points - np.array([0.0, wall, 0.0])
    return replace(mesh, points=points, symmetry=mesh.symmetry + "y")


def _stacked(mesh, lid):
    return replace(
        mesh,
        points=np.concatenate([mesh.points, lid.points]),
        corners=np.concatenate([mesh.corners, lid.corners + len(mesh.points)]),
    )


@kernel(parallel=True)
def _rankine_classes(e, images, signs, bed, shift):
    nodes, n, c = e.nodes, len(e.nodes), len(signs)
    s, d, s1, d1 = np.zeros((c, n, n)), np.zeros((c, n, n)), np.zeros((c, n, n)), np.zeros((c, n, n))
    for i in prange(n):
        for m in range(len(images)):
            # reflecting the point instead of the panel leaves the integrals as they are
            x, y, z = images[m, 0] * nodes[i, 0], images[m, 1] * nodes[i, 1], nodes[i, 2]
            _add_row(x, y, z, e, signs[:, m], s[:, i], d[:, i])
            if bed:
                _add_row(x, y, shift - z, e, signs[:, m], s[:, i], d[:, i])
            _add_row(x, y, -z, e, signs[:, m], s1[:, i], d1[:, i])
        s[:, i] += s1[:, i]
        d[:, i] += d1[:, i]
    return s, d, s1, d1


@kernel()
def _add_row(x, y, z, e, signs, s, d):
    """Integrals of all panels at one point, added to the rows (classes, n) of s and d."""
    origins, axes, corners, inverse = e.origins, e.axes, e.corners, e.inverse
    p = inverse.shape[2]
    S, D = np.empty(p), np.empty(p)
    for j in range(len(origins)):
        dx, dy, dz = x - origins[j, 0], y - origins[j, 1], z - origins[j, 2]
        a = axes[j]
        panel_moments(
            a[0, 0] * dx + a[0, 1] * dy + a[0, 2] * dz,
            a[1, 0] * dx + a[1, 1] * dy + a[1, 2] * dz,
            a[2, 0] * dx + a[2, 1] * dy + a[2, 2] * dz,
            corners[j], S, D,
        )  # fmt: skip
        for b in range(p):
            u, v = 0.0, 0.0
            for m in range(p):
                u += inverse[j, m, b] * S[m]
                v += inverse[j, m, b] * D[m]
            for c in range(len(signs)):
                s[c, p * j + b] += signs[c] * u
                d[c, p * j + b] += signs[c] * v


def assembled(geometry, classes, mirror, table, depth_values, velocities, hull=None):
    """Matrices (c, n, n) and right-hand sides (c, n, columns) of the given symmetry classes.

    mirror : factor of the 1/r₁ part (1 for waves, −1 at infinite frequency); table : wave part of G
    depth_values : z → (…, 2) of Z and Z′; velocities : per class (columns, hull nodes), shorter lists are
    filled up with zeros; hull : nodes that are hull, the others are lid
    """
    g, e = geometry, geometry.elements
    hull = g.hull if hull is None else hull
    sides = np.zeros((len(classes), hull, max(len(v) for v in velocities)), complex)
    for i, v in enumerate(velocities):
        sides[i, :, : len(v)] = v.T
    s, d, s1, d1 = g.rankine
    chosen = [g.classes.index(c) for c in classes]
    if len(chosen) < len(g.classes):
        s, d, s1, d1 = s[chosen], d[chosen], s1[chosen], d1[chosen]
    if mirror != 1:
        s, d = s + (mirror - 1) * s1, d + (mirror - 1) * d1
    length = min(1 / table.k if table.k > 0 else np.inf, g.depth)
    return _assemble(
        e, hull, g.images, np.array([g.signs(c) for c in classes]),
        s, d, g.coarse_points, g.fine_points, depth_values(g.coarse_points.points[..., 2]),
        depth_values(g.fine_points.points[..., 2]), depth_values(e.nodes[:, 2])[:, 0].copy(),
        e.sizes > COARSE * length, table, sides,
    )  # fmt: skip


@kernel(parallel=True)
def _assemble(
    e, hull, images, signs, s_exact, d_exact, coarse, fine, coarse_z, fine_z, node_z,
    always_fine, table, velocities,
):  # fmt: skip
    """A (c, n, n) and b (c, n, r) of `assembled`; row by row, so that S never has to be kept.

    s_exact, d_exact : (c, n, n) integrals of 1/r and its images; coarse, fine : Quadrature, with Z and Z′ there in
    coarse_z, fine_z (panels, q, 2); node_z : (n,) Z; always_fine : (panels,) bool; velocities : (c, hull, r)
    """
    nodes, axes, centers, sizes = e.nodes, e.axes, e.origins, e.sizes
    n, c, r = len(nodes), len(signs), velocities.shape[2]
    p = coarse.shape.shape[2]
    A = np.empty((c, n, n), np.complex128)
    b = np.zeros((c, n, r), np.complex128)
    for i in prange(n):
        S, D = np.zeros((c, n), np.complex128), np.zeros((c, n), np.complex128)
        work = np.empty((4, c))
        for j in range(len(axes)):
            part = slice(p * j, p * j + p)
            if always_fine[j] or _close(nodes[i], centers[j], NEAR * sizes[j], images):
                _panel(nodes[i], axes[j, 2], images, signs, fine.points[j], fine.weights[j], fine.shape[j], fine_z[j],
                       node_z[i], table, work, S[:, part], D[:, part])  # fmt: skip
            else:
                _panel(nodes[i], axes[j, 2], images, signs, coarse.points[j], coarse.weights[j], coarse.shape[j],
                       coarse_z[j], node_z[i], table, work, S[:, part], D[:, part])  # fmt: skip
        side = -1.0 if i < hull else 1.0
        for q in range(c):
            for j in range(n):
                S[q, j] += s_exact[q, i, j]
                D[q, j] += d_exact[q, i, j]
                A[q, i, j] = side * (D[q, j] if j < hull else table.K * S[q, j])
            A[q, i, i] += 2 * math.pi if i < hull else 4 * math.pi
            for j in range(hull):
                for a in range(r):
                    b[q, i, a] += side * S[q, j] * velocities[q, j, a]
    return A, b


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
