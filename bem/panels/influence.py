"""Influence matrices of the direct boundary integral equation, one per symmetry class.

With n out of the body, V = ∂φ/∂n, S and D the panel integrals of G and ∂G/∂n, the potential on the hull and an
auxiliary density φ' on the interior free surface (the lid) satisfy

    hull:  2πφ − Dφ − K S φ' = −S V
    lid:   4πφ' + K S φ' + Dφ =  S V

The exact solution has φ' = 0.  The lid row imposes ∂w/∂z = 0 on the free surface of the fictitious flow inside the
hull, so that this flow has no resonance: no irregular frequency at any ω (cf. Lee, Newman & Zhu 1996).

Mirror planes split the unknowns into classes that are even or odd in x and in y. In a class, the potentials on the
images of a panel are equal or opposite to the potential on the panel.
"""

import math
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..algebra.real_times_complex import real_times_complex
from ..green.rankine import panel_moments
from ..kernels.jit import kernel
from ..kernels.threads import parallel_rows
from ..modes import class_of, modes_of, normal_velocities
from .elements import elements, quadrature
from .irregular_frequencies import extent, lid_needed_from
from .reciprocal_pairs import NODES, add_wave_part
from .standing_waves import standing_waves
from .wave_influence import COARSE, FINE, wave_blocks

ROWS = 256  # rows of the matrices computed together
# 1/r is integrated with 2 × 2 points beyond FAR sizes of a panel: error 1e-6 of a smooth potential
FAR = 5.0


class Geometry:
    """Elements, mirror images and Rankine integrals of a mesh and its lid in water of given depth, valid at all
    frequencies.

    modes : `bem.modes.Mode`s beyond the rigid motions, with the mirror planes of the mesh

    wall : y of a vertical wall along x that reflects all waves, m; None for open water
    The wall replaces the mirror plane y = 0: the mesh is shifted by `origin`, the mirror image of the body is behind
    the wall, and the flow is even in y.
    """

    def __init__(self, mesh, lid, depth, per_panel=4, wall=None, modes=()):
        self.given, self.larger = (mesh, lid, depth, per_panel, wall, modes), None
        self.shapes = modes
        self.wall, self.depth = wall, depth
        self.origin = np.array([0.0, 0.0 if wall is None else -wall, 0.0])
        if wall is not None:
            mesh, lid = (_before_wall(part, wall) for part in (mesh, lid))
        self.mesh = mesh
        self.panels = mesh if lid is None else _stacked(mesh, lid)
        self.elements = elements(self.panels, per_panel)
        self.hull = len(mesh) * per_panel
        self.quadrature = quadrature(self.panels, self.elements, COARSE, FINE)
        self.images = np.array(mesh.reflections(), float)
        ones = {True: (1, -1), False: (1,)}
        self.classes = tuple(
            (x, y) for y in ones["y" in mesh.symmetry and wall is None] for x in ones["x" in mesh.symmetry]
        )
        self.copies = len(self.images) // (1 if wall is None else 2)

    @cached_property
    def without_lid(self):
        """The same geometry without the lid, for low frequencies and limits"""
        mesh, lid, *others = self.given
        if lid is None:
            return self
        out = Geometry(mesh, None, *others)
        out.larger = self
        return out

    def at(self, K):
        """The `Geometry` to use at K = ω²/g, 1/m; it has the lid only where irregular frequencies may be near"""
        return self if self.lid_from < K else self.without_lid

    @cached_property
    def lid_from(self):
        """K above which the lid is needed, 1/m (`bem.panels.irregular_frequencies`); infinite without a lid"""
        mesh, lid, *_ = self.given
        return np.inf if lid is None else lid_needed_from(mesh)

    @cached_property
    def reach(self):
        """Largest horizontal distance between two points of the whole hull, m"""
        return float(np.hypot(*extent(self.mesh)))

    @cached_property
    def draft(self):
        """m"""
        return self.mesh.draft

    @cached_property
    def radius(self):
        """Largest distance of the hull from the vertical axis through the origin, m"""
        return float(np.hypot(*(self.mesh.points - self.origin)[:, :2].T).max())

    @property
    def modes(self):
        """Normal velocities of unit motions about the body's origin; shape (hull nodes, 6), for N bodies (hull nodes,
        6N)"""
        n, body = self.hull, self.mesh.body
        points, normals = self.elements.nodes[:n] - self.origin, self.elements.normals[:n]
        if body is None and not self.shapes:
            return normal_velocities(points, normals)
        owner = np.zeros(n, int) if body is None else np.repeat(body, n // len(body))
        return modes_of(self.mesh.bodies, owner, points, normals, self.shapes)

    def members(self, cls):
        """Degrees of freedom of a symmetry class, indices 0 … 5, or 0 … 6N − 1 for N bodies"""
        return self._members[cls]

    @cached_property
    def _members(self):
        symmetry = self.mesh.symmetry if self.wall is None else self.mesh.symmetry.replace("y", "")
        classes = [class_of(d, symmetry) for d in range(6 * self.mesh.bodies)]
        for mode in self.shapes:
            signs = dict(zip("xy", mode.parity(self._points_of(mode.moves)), strict=True))
            if any(signs[axis] == 0 for axis in symmetry):
                raise ValueError(
                    f"the shape of {mode.name} is not symmetric about {symmetry}; allowed: a mesh without that plane"
                )
            classes.append(tuple(signs[axis] if axis in symmetry else 1 for axis in "xy"))
        return {cls: [d for d, own in enumerate(classes) if own == cls] for cls in self.classes}

    def _points_of(self, numbers):
        """Nodes of some of the bodies, m; shape (n, 3)"""
        points, body = self.elements.nodes[: self.hull] - self.origin, self.mesh.body
        return points if body is None else points[np.isin(np.repeat(body, self.hull // len(body)), numbers)]

    def signs(self, cls):
        """Sign ±1 of the potential on each mirror image, in a class; shape (images,)"""
        return self.all_signs[self.classes.index(cls)]

    @cached_property
    def all_signs(self):
        """`signs` of every class; shape (classes, images)"""
        of = [[(x if a < 0 else 1) * (y if b < 0 else 1) for a, b in self.images] for x, y in self.classes]
        return np.array(of, float)

    def rankine_rows(self, points):
        """S and D of 1/r + 1/r₂ + 1/r₁, then of 1/r₁ alone at points (m, 3); each (classes, m, n) and real"""
        return rankine_of_panels(points, self.elements, self.images, self.all_signs, self.depth)

    @cached_property
    def rankine(self):
        """`rankine_rows` at all nodes"""
        if self.larger is not None:
            return tuple(a[:, : self.hull, : self.hull] for a in self.larger.rankine)
        return self.rankine_rows(self.elements.nodes)

    def rankine_of(self, nodes):
        """`rankine_rows` at `nodes`, taken from `rankine` if an earlier frequency has computed `rankine`"""
        if "rankine" in vars(self.larger or self):
            return tuple(a[:, nodes] for a in self.rankine)
        return self.rankine_rows(self.elements.nodes[nodes])

    @cached_property
    def sectors(self):
        """`bem.panels.axisymmetric.Sectors` of an axisymmetric body, else None"""
        from .axisymmetric import sectors

        return sectors(self) if self.mesh.body is None and not self.shapes else None

    @cached_property
    def rankine_of_sector(self):
        """`rankine_rows` at the nodes of the first sector"""
        return self.rankine_rows(self.elements.nodes[self.sectors.first])


def rankine_of_panels(points, e, images, signs, depth):
    """`Geometry.rankine_rows` of the panels of `Elements` e; images (i, 2) ±1, signs (classes, i) ±1, depth in m"""
    bed = bool(np.isfinite(depth))
    rows = np.zeros((4, len(signs), len(points), len(e.nodes)))
    arguments = points, e, images, signs, bed, -2 * depth if bed else 0.0

    def work(low, high):
        _rankine_rows(low, high, *arguments, np.empty((2, e.inverse.shape[2])), *rows)

    parallel_rows(work, len(points), rows[0, 0].size * len(images))
    return tuple(rows)


def _before_wall(mesh, wall):
    """The mesh moved so that the wall is y = 0, as a mirror plane"""
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
        body=None,
    )


@kernel()
def _rankine_rows(low, high, points, e, images, signs, bed, shift, moments, s, d, s1, d1):
    """`Geometry.rankine_rows` of the points `low` to `high`; moments : (2, nodes of a panel), workspace"""
    for i in range(low, high):
        for m in range(len(images)):
            # reflecting the point instead of the panel does not change the integrals
            x, y, z = images[m, 0] * points[i, 0], images[m, 1] * points[i, 1], points[i, 2]
            _add_row(x, y, z, e, signs[:, m], moments, s[:, i], d[:, i])
            if bed:
                _add_row(x, y, shift - z, e, signs[:, m], moments, s[:, i], d[:, i])
            _add_row(x, y, -z, e, signs[:, m], moments, s1[:, i], d1[:, i])
        for c in range(len(signs)):
            for j in range(s.shape[2]):
                s[c, i, j] += s1[c, i, j]
                d[c, i, j] += d1[c, i, j]


@kernel()
def _add_row(x, y, z, e, signs, moments, s, d):
    """Integrals of all panels at one point, added to the rows (classes, n) of s and d."""
    origins, axes, corners, inverse, nodes, weights = e.origins, e.axes, e.corners, e.inverse, e.nodes, e.weights
    sizes, p = e.sizes, inverse.shape[2]
    S, D = moments[0], moments[1]
    for j in range(len(origins)):
        dx, dy, dz = x - origins[j, 0], y - origins[j, 1], z - origins[j, 2]
        far = FAR * sizes[j]
        up = axes[j, 2, 0] * dx + axes[j, 2, 1] * dy + axes[j, 2, 2] * dz
        if p > 1 and dx * dx + dy * dy + dz * dz > far * far:
            for m in range(p * j, p * j + p):  # the nodes are Gauss points
                dx, dy, dz = x - nodes[m, 0], y - nodes[m, 1], z - nodes[m, 2]
                inverse_square = 1 / (dx * dx + dy * dy + dz * dz)
                u = weights[m] * math.sqrt(inverse_square)
                v = up * inverse_square * u  # all nodes lie in the panel's plane
                for c in range(len(signs)):
                    s[c, m] += signs[c] * u
                    d[c, m] += signs[c] * v
            continue
        panel_moments(
            axes[j, 0, 0] * dx + axes[j, 0, 1] * dy + axes[j, 0, 2] * dz,
            axes[j, 1, 0] * dx + axes[j, 1, 1] * dy + axes[j, 1, 2] * dz,
            up, corners[j], S, D,
        )  # fmt: skip
        for b in range(p):
            u, v = 0.0, 0.0
            for m in range(p):
                u += inverse[j, m, b] * S[m]
                v += inverse[j, m, b] * D[m]
            for c in range(len(signs)):
                s[c, p * j + b] += signs[c] * u
                d[c, p * j + b] += signs[c] * v


def layers(geometry, rows, classes, mirror, table, depth_values):
    """S and D (c, rows, n) of symmetry classes at the nodes `rows`; other arguments as in `assembled`"""
    S, D = wave_blocks(geometry, rows, np.arange(len(geometry.elements.nodes)), table, depth_values, classes)
    rankine = geometry.rankine_of(rows)
    for i, cls in enumerate(classes):
        s, d, s1, d1 = (a[geometry.classes.index(cls)] for a in rankine)
        S[i] += s + (mirror - 1) * s1 if mirror != 1 else s
        D[i] += d + (mirror - 1) * d1 if mirror != 1 else d
    return S, D


class Equations(NamedTuple):
    """Matrices A + i U Vᵀ and right-hand sides b of c symmetry classes, n nodes; U Vᵀ are a few standing waves."""

    matrices: np.ndarray  # (c, n, n) real, A
    from_waves: np.ndarray  # (c, n, t) real, U
    to_waves: np.ndarray  # (c, n, t) real, V
    sides: np.ndarray  # (c, n, columns) complex, b


def assembled(geometry, classes, mirror, table, depth_values, velocities, hull=None):
    """`Equations` of the given symmetry classes.

    mirror : factor of the 1/r₁ part (1 for waves, −1 at infinite frequency); table : wave part of G
    depth_values : function z → (…, 2) of Z and Z′
    velocities : (columns, hull nodes) of each class, padded with zeros to an equal number of columns
    hull : number of nodes on the hull; the remaining nodes are on the lid
    """
    g, n = geometry, len(geometry.elements.nodes)
    hull, nodes = g.hull if hull is None else hull, np.arange(n)
    S, A = _all_layers(g, classes, mirror, table, depth_values)
    waves, single, double = standing_waves(g, classes, table, depth_values)
    V = np.zeros((len(classes), hull, max(map(len, velocities))), complex)
    for given, velocity in zip(V, velocities, strict=True):
        given[:, : len(velocity)] = velocity.T[:hull]
    side = np.where(nodes < hull, -1.0, 1.0)[:, None]
    sides = side * (
        real_times_complex(S[:, :, :hull], V) + 1j * (waves @ real_times_complex(single[:, :hull].swapaxes(1, 2), V))
    )
    A[:, :, hull:] = table.K * S[:, :, hull:]
    A[:, :hull] *= -1
    A[:, nodes, nodes] += np.where(nodes < hull, 2 * np.pi, 4 * np.pi)
    double[:, hull:] = table.K * single[:, hull:]
    return Equations(A, side * waves, double, sides)


def _all_layers(geometry, classes, mirror, table, depth_values):
    """Real parts of S and D (c, n, n) of symmetry classes, arrays of their own"""
    own = [geometry.classes.index(c) for c in classes]
    s, d, s1, d1 = geometry.rankine
    S, D = (np.array([a[i] for i in own]) for a in (s, d))
    if mirror != 1:
        S += (mirror - 1) * s1[own]
        D += (mirror - 1) * d1[own]
    if geometry.elements.inverse.shape[2] == NODES:
        add_wave_part(geometry, classes, table, depth_values, S, D)
        return S, D
    nodes = np.arange(len(geometry.elements.nodes))
    for start in range(0, len(nodes), ROWS):
        rows = nodes[start : start + ROWS]
        for whole, part in zip((S, D), wave_blocks(geometry, rows, nodes, table, depth_values, classes), strict=True):
            whole[:, rows] += part.real
    return S, D
