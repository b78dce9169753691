"""Axisymmetric bodies: a rotation by 2π/N about a vertical axis maps the panels of such a body onto each other.

The influence matrices are block-circulant (Davis, Circulant Matrices, 1979). With i and j among the p nodes of one
sector and R_k the rotation by α_k = 2πk/N, the blocks a(i, R_k j) determine the matrix.  In the Fourier coefficients

    φ(R_k j) = Σ_m φ̂_m(j) exp(imα_k)        Â_m(i, j) = Σ_k a(i, R_k j) exp(imα_k)

each harmonic m has separate equations, p × p. Only harmonics in a right-hand side are solved: one for heave, one for
surge and pitch, and about kR + 10 for incident waves.

With a mirror plane M, which maps m to −m, half the harmonics and half the rows of a sector are enough: M i = R_s(i) i*
implies

    Â_m(i*, j*) = exp(im (α_s(j) − α_s(i))) Â_−m(i, j)

The mesh contains only the part on one side of its mirror planes; arguments and results are split into symmetry classes
(`bem.panels.influence`).
"""

import math
from functools import reduce
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..kernels.jit import kernel
from ..kernels.threads import blas_threads, parallel_rows
from .wave_influence import wave_blocks

COINCIDENT = 1e-7  # distance, over the smallest panel, below which nodes coincide
FEWEST_SECTORS = 3  # least number of sectors in a symmetric part for which the method is faster
NEGLIGIBLE = 1e-13  # harmonics below this fraction of a right-hand side count as rounding


class Sectors(NamedTuple):
    """N sectors with p nodes each.

    node, image : arrays (N, p): node i of the first sector, rotated by α_k, is image image[k, i] of mesh node node[k,
        i]
    hull : whether a node is on the hull; False on the lid, (p,)
    rows : indices, within the sector, of the nodes whose rows are computed, (r,); the mirror plane gives the other rows
    mirror_node, shift : i* and s of every node, (p,); empty without mirror plane
    """

    node: np.ndarray
    image: np.ndarray
    hull: np.ndarray
    rows: np.ndarray
    mirror_node: np.ndarray
    shift: np.ndarray

    @property
    def first(self):
        """Mesh nodes of `rows`, without mirror images; shape (r,)"""
        return self.node[0, self.rows]


def sectors(geometry):
    """`Sectors` of a `bem.panels.influence.Geometry`, or None if it is not axisymmetric."""
    g, e = geometry, geometry.elements
    if g.wall is not None:
        return None
    reflections = np.concatenate([g.images, np.ones((len(g.images), 1))], axis=1)[:, None]
    points = (reflections * e.nodes).reshape(-1, 3)
    axis = points[:, :2].mean(axis=0)
    tolerance = COINCIDENT * e.sizes.min()
    position = points[:, :2] - axis
    R, angle = np.hypot(*position.T), np.arctan2(position[:, 1], position[:, 0])
    rings = _rings(R, points[:, 2], angle, tolerance)
    count = reduce(math.gcd, map(len, rings))
    while count >= FEWEST_SECTORS * len(g.images):
        if all(_maps_to_itself(angle[ring], R[ring], count, tolerance) for ring in rings):
            return _sectors(g, rings, count)
        count = _next_divisor(count)
    return None


def _rings(R, z, angle, tolerance):
    """Arrays of indices of points at the same distance from the axis and the same height, sorted by angle"""
    ring = _groups(R, tolerance) * len(R) + _groups(z, tolerance)
    order = np.lexsort((angle, ring))
    ends = np.flatnonzero(np.diff(ring[order], prepend=-1, append=-1))
    return [order[a:b] for a, b in pairwise(ends)]


def _groups(values, tolerance):
    """Group number of each value; shape (n,); gaps between groups are larger than the tolerance"""
    order = np.argsort(values)
    out = np.empty(len(values), np.int64)
    out[order] = np.cumsum(np.diff(values[order], prepend=values[order[0]]) > tolerance)
    return out


def _maps_to_itself(angle, R, count, tolerance):
    """Whether a rotation by 2π/count maps a ring onto itself; `angle` sorted"""
    step = len(angle) // count
    turns = np.mod(np.roll(angle, -step) - angle, 2 * np.pi) - 2 * np.pi / count
    return bool(np.abs(turns * R).max() <= tolerance)


def _next_divisor(count):
    return next(n for n in range(count - 1, 0, -1) if count % n == 0)


def _sectors(geometry, rings, count):
    """`Sectors` from rings that rotations map onto themselves; None if weights, or hull and lid, differ on one"""
    g, n = geometry, len(geometry.elements.nodes)
    columns = []
    for ring in rings:
        step = len(ring) // count
        own = ring < n
        start = next(i for i in range(len(ring)) if all(own[(i + j) % len(ring)] for j in range(step)))
        columns.append(np.roll(ring, -start).reshape(count, step))
    all_points = np.concatenate(columns, axis=1)
    image, node = np.divmod(all_points[:, np.argsort(all_points[0])], n)
    weights, hull = g.elements.weights[node], node < g.hull
    if np.any(hull != hull[0]) or np.any(np.abs(weights - weights[0]) > 1e-6 * weights[0]):
        return None
    return Sectors(node, image, hull[0], *_mirror_nodes(node, image, len(g.images)))


def _mirror_nodes(node, image, images):
    """rows, mirror_node and shift of `Sectors`"""
    p = node.shape[1]
    if images == 1:
        return np.arange(p), np.empty(0, int), np.empty(0, int)
    number = np.full(node.max() + 1, -1)
    number[node[image == 1]] = np.flatnonzero(image == 1)
    shift, mirror_node = np.divmod(number[node[0]], p)  # the second image is a reflection
    return np.flatnonzero(np.arange(p) <= mirror_node), mirror_node, shift


def sector_rows(geometry, mirror, table, depth_values):
    """S and D (classes, r, n) at the `first` nodes of the sectors; arguments as in `bem.panels.influence.assembled`"""
    first = geometry.sectors.first
    S, D = wave_blocks(geometry, first, np.arange(len(geometry.elements.nodes)), table, depth_values)
    s, d, s1, d1 = geometry.rankine_of_sector
    S += s + (mirror - 1) * s1
    D += d + (mirror - 1) * d1
    return S, D


def solved_by_harmonics(geometry, S, D, K, velocities, all_harmonics=True):
    """Return ({class: potentials (columns, hull nodes)}, largest residual relative to its right-hand side).

    S, D : `sector_rows`; K : ω²/g in 1/m; velocities : {class: (columns, hull nodes)}, m/s
    all_harmonics : whether all harmonics are solved; False: only those that exert a force, the harmonics of the motions
    raises : LinAlgError if the equations of a harmonic are singular
    """
    from scipy.linalg import solve

    g, on_hull = geometry, geometry.sectors.hull
    given = _spectrum(g, velocities)
    present = _present(given)
    if not all_harmonics:
        present &= _present(_spectrum(g, {cls: g.modes[:, g.members(cls)].T for cls in g.classes})).any(axis=0)
    m = np.flatnonzero(present.any(axis=0))
    sources = _harmonic_matrices(g, S, m)
    operator = np.where(on_hull, _harmonic_matrices(g, D, m), K * sources)
    side, diagonal = np.where(on_hull, -1.0, 1.0)[:, None], np.where(on_hull, 2 * np.pi, 4 * np.pi)
    found, residual = np.zeros_like(given), 0.0
    with blas_threads(len(on_hull)):
        for A, s, number in zip(side * operator, side * sources[..., on_hull], m, strict=True):
            A.flat[:: len(A) + 1] += diagonal
            columns = present[:, number]
            b = s @ given[columns, number].T
            x = solve(A, b, check_finite=False)
            residual = max(residual, float((np.abs(A @ x - b).max(axis=0) / np.abs(b).max(axis=0)).max()))
            found[columns, number] = x[on_hull].T
    return _class_potentials(g, found, velocities), residual


def _present(spectrum):
    """Whether a harmonic exceeds rounding; shape (columns, m)"""
    size = np.abs(spectrum).max(axis=2)
    return size > NEGLIGIBLE * size.max(axis=1, keepdims=True)


def _spectrum(geometry, velocities):
    """Harmonics, shape (columns, m, hull nodes of a sector), of values {class: (columns, hull nodes)}, all classes
    stacked"""
    g, (node, image, on_hull, *_) = geometry, geometry.sectors
    rings = [values[:, node[:, on_hull]] * g.signs(cls)[image[:, on_hull]] for cls, values in velocities.items()]
    return np.fft.fft(np.concatenate(rings), axis=1, norm="forward")[:, : _harmonics(g)]


def _harmonics(geometry):
    """Number of harmonics to solve: with a mirror plane −m follows from m"""
    count = len(geometry.sectors.node)
    return count if len(geometry.images) == 1 else count // 2 + 1


def _harmonic_matrices(geometry, rows, m):
    """Â_m (m, p, p) from the rows (classes, r, n)"""
    own, signs = geometry.sectors, geometry.all_signs / len(rows)
    count, p = own.node.shape
    rotation, position = np.empty((2, *signs.shape[1:], rows.shape[2]), np.int64)
    rotation[own.image, own.node], position[own.image, own.node] = np.arange(count)[:, None], np.arange(p)
    both = np.concatenate([m, -m]) if len(own.mirror_node) else m
    factors = np.exp(2j * np.pi / count * np.outer(np.arange(count), both))
    of_rows = np.zeros((len(own.rows), p, len(both)), complex)

    def work(low, high):
        _add_harmonics(low, high, rows, signs, rotation, position, factors, of_rows)

    parallel_rows(work, len(own.rows), len(own.rows) * own.node.size)
    of_rows = np.moveaxis(of_rows, 2, 0)
    if not len(own.mirror_node):
        return of_rows
    out = np.empty((len(m), p, p), complex)
    shifts = own.shift - own.shift[own.rows][:, None]
    back = factors[shifts % count, : len(m)].transpose(2, 0, 1)
    out[:, own.mirror_node[own.rows][:, None], own.mirror_node] = of_rows[len(m) :] * back
    out[:, own.rows] = of_rows[: len(m)]
    return out


@kernel()
def _add_harmonics(low, high, rows, signs, rotation, position, factors, out):
    """Σ_k a(i, R_k j) exp(imα_k), a from the classes, of the rows `low` to `high` into out (r, p, m)

    rotation, position : (images, n) k and j of every image of a node; signs : over the number of classes
    """
    for i in range(low, high):
        for u in range(rows.shape[2]):
            for s in range(len(rotation)):
                a = 0j
                for c in range(len(signs)):
                    a += signs[c, s] * rows[c, i, u]
                k, j = rotation[s, u], position[s, u]
                for m in range(factors.shape[1]):
                    out[i, j, m] += a * factors[k, m]


def _class_potentials(geometry, spectrum, velocities):
    """{class: (columns, hull nodes)} from harmonics (columns, m, hull nodes of a sector): the inverse of `_spectrum`"""
    g, (node, image, on_hull, *_) = geometry, geometry.sectors
    count, whole = len(node), np.zeros((len(spectrum), len(node), spectrum.shape[2]), complex)
    whole[:, : spectrum.shape[1]] = spectrum
    if spectrum.shape[1] < count:  # the mirror planes of the classes add −m, but to 0 and N/2
        whole[:, 1 : (count + 1) // 2] *= 2
    rings = np.fft.ifft(whole, axis=1, norm="forward").reshape(len(spectrum), -1)
    position = np.empty((len(g.images), g.hull), np.int64)
    position[image[:, on_hull], node[:, on_hull]] = np.arange(rings.shape[1]).reshape(count, -1)
    out, start = {}, 0
    for cls, values in velocities.items():
        own = rings[start : start + len(values)]
        out[cls] = np.einsum("s,csu->cu", g.signs(cls) / len(position), own[:, position])
        start += len(values)
    return out
