"""Bodies of revolution: panels that a turn of 2π/N about a vertical axis carries into each other.

The rows of one wedge are those of all others, turned: a(i, R_k j), with i and j among the p nodes of a wedge and
R_k the turn by α_k = 2πk/N, is all there is of an influence matrix, a block-circulant one.  On

    φ(R_k j) = Σ_m φ̂_m(j) exp(imα_k)        Â_m(i, j) = Σ_k a(i, R_k j) exp(imα_k)

every harmonic m has equations of its own, p × p, and only those that a right-hand side contains are solved: one for
heave, one for surge and pitch, for waves about kR + 10.

A mirror plane M sends m to −m, of which one is enough, and halves the wedge: M i = R_s(i) i* says that

    Â_m(i*, j*) = exp(im (α_s(j) − α_s(i))) Â_−m(i, j)

The mesh stays the part that its mirror planes leave; symmetry classes (`panels.influence`) go in and come out.  Davis,
Circulant Matrices (1979), for the harmonics of such matrices.
"""

from __future__ import annotations

import math
from functools import reduce
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..kernels.jit import kernel
from ..kernels.threads import blas_threads, parallel_rows
from .wave_influence import wave_blocks

SAME = 1e-7  # of the smallest panel: nodes are carried into each other
FEWEST = 3  # wedges to a symmetric part, with fewer little is gained
ABSENT = 1e-13  # of a right-hand side: a harmonic so small is rounding


class Wedges(NamedTuple):
    """N wedges with p nodes each.

    node, image : (N, p) the k-th turn of each node of the first wedge is that image of that node
    hull : (p,) whether it is on the hull, not on the lid
    rows : (r,) nodes of the first wedge from which the others follow, by their number in it
    twin, shift : (p,) i* and s of every node, or nothing without mirror plane
    """

    node: np.ndarray
    image: np.ndarray
    hull: np.ndarray
    rows: np.ndarray
    twin: np.ndarray
    shift: np.ndarray

    @property
    def first(self):
        """(r,) nodes of the mesh that the rows belong to, none of them an image"""
        return self.node[0, self.rows]


def wedges(geometry):
    """`Wedges` of a `bem.panels.influence.Geometry`, or None if it is not a body of revolution."""
    g, e = geometry, geometry.elements
    if g.wall is not None:
        return None
    reflections = np.concatenate([g.images, np.ones((len(g.images), 1))], axis=1)[:, None]
    points = (reflections * e.nodes).reshape(-1, 3)
    axis = points[:, :2].mean(axis=0)
    tolerance = SAME * e.sizes.min()
    place = points[:, :2] - axis
    R, angle = np.hypot(*place.T), np.arctan2(place[:, 1], place[:, 0])
    rings = _rings(R, points[:, 2], angle, tolerance)
    count = reduce(math.gcd, map(len, rings))
    while count >= FEWEST * len(g.images):
        if all(_turned(angle[ring], R[ring], count, tolerance) for ring in rings):
            return _wedges(g, rings, count)
        count = _next_divisor(count)
    return None


def _rings(R, z, angle, tolerance):
    """Arrays of points at the same distance from the axis and the same height, by angle"""
    ring = _groups(R, tolerance) * len(R) + _groups(z, tolerance)
    order = np.lexsort((angle, ring))
    ends = np.flatnonzero(np.diff(ring[order], prepend=-1, append=-1))
    return [order[a:b] for a, b in pairwise(ends)]


def _groups(values, tolerance):
    """(n,) numbers of groups of values, the gaps between which are larger than the tolerance"""
    order = np.argsort(values)
    out = np.empty(len(values), np.int64)
    out[order] = np.cumsum(np.diff(values[order], prepend=values[order[0]]) > tolerance)
    return out


def _turned(angle, R, count, tolerance):
    """Whether a turn of 2π/count carries a ring into itself; `angle` sorted"""
    step = len(angle) // count
    turns = np.mod(np.roll(angle, -step) - angle, 2 * np.pi) - 2 * np.pi / count
    return bool(np.abs(turns * R).max() <= tolerance)


def _next_divisor(count):
    return next(n for n in range(count - 1, 0, -1) if count % n == 0)


def _wedges(geometry, rings, count):
    """`Wedges` from rings of which each turns into itself; None if weights or hull and lid differ on one"""
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
    return Wedges(node, image, hull[0], *_twins(node, image, len(g.images)))


def _twins(node, image, images):
    """rows, twin and shift of `Wedges`"""
    p = node.shape[1]
    if images == 1:
        return np.arange(p), np.empty(0, int), np.empty(0, int)
    number = np.full(node.max() + 1, -1)
    number[node[image == 1]] = np.flatnonzero(image == 1)
    shift, twin = np.divmod(number[node[0]], p)  # the second image is a reflection
    return np.flatnonzero(np.arange(p) <= twin), twin, shift


def wedge_rows(geometry, mirror, table, depth_values):
    """S and D (classes, r, n) at the `first` nodes of the wedges; arguments as of `bem.panels.influence.assembled`"""
    first = geometry.wedges.first
    S, D = wave_blocks(geometry, first, np.arange(len(geometry.elements.nodes)), table, depth_values)
    s, d, s1, d1 = geometry.rankine_of_wedge
    S += s + (mirror - 1) * s1
    D += d + (mirror - 1) * d1
    return S, D


def solved_by_harmonics(geometry, S, D, K, velocities, whole=True):
    """({class: potentials (columns, hull nodes)}, largest residual relative to its right-hand side).

    S, D : `wedge_rows`; K : ω²/g in 1/m; velocities : {class: (columns, hull nodes)}
    whole : False for what pushes the body alone, the harmonics of its modes of motion
    raises : LinAlgError if the equations of a harmonic are singular
    """
    from scipy.linalg import solve

    g, on_hull = geometry, geometry.wedges.hull
    given = _spectrum(g, velocities)
    contained = _contained(given)
    if not whole:
        contained &= _contained(_spectrum(g, {cls: g.modes[:, g.members(cls)].T for cls in g.classes})).any(axis=0)
    m = np.flatnonzero(contained.any(axis=0))
    sources = _of_harmonics(g, S, m)
    acting = np.where(on_hull, _of_harmonics(g, D, m), K * sources)
    side, diagonal = np.where(on_hull, -1.0, 1.0)[:, None], np.where(on_hull, 2 * np.pi, 4 * np.pi)
    found, residual = np.zeros_like(given), 0.0
    with blas_threads(len(on_hull)):
        for A, s, number in zip(side * acting, side * sources[..., on_hull], m, strict=True):
            A.flat[:: len(A) + 1] += diagonal
            columns = contained[:, number]
            b = s @ given[columns, number].T
            x = solve(A, b, check_finite=False)
            residual = max(residual, float((np.abs(A @ x - b).max(axis=0) / np.abs(b).max(axis=0)).max()))
            found[columns, number] = x[on_hull].T
    return _in_classes(g, found, velocities), residual


def _contained(spectrum):
    """(columns, m) which harmonics are more than rounding"""
    size = np.abs(spectrum).max(axis=2)
    return size > ABSENT * size.max(axis=1, keepdims=True)


def _spectrum(geometry, velocities):
    """(columns, m, hull nodes of a wedge) harmonics of all classes' values, which are (columns, hull nodes)"""
    g, (node, image, on_hull, *_) = geometry, geometry.wedges
    rings = [values[:, node[:, on_hull]] * g.signs(cls)[image[:, on_hull]] for cls, values in velocities.items()]
    return np.fft.fft(np.concatenate(rings), axis=1, norm="forward")[:, : _harmonics(g)]


def _harmonics(geometry):
    """How many: with a mirror plane m and −m are one"""
    count = len(geometry.wedges.node)
    return count if len(geometry.images) == 1 else count // 2 + 1


def _of_harmonics(geometry, rows, m):
    """Â_m (m, p, p) from the rows (classes, r, n)"""
    mine, signs = geometry.wedges, geometry.all_signs / len(rows)
    count, p = mine.node.shape
    turn, place = np.empty((2, *signs.shape[1:], rows.shape[2]), np.int64)
    turn[mine.image, mine.node], place[mine.image, mine.node] = np.arange(count)[:, None], np.arange(p)
    both = np.concatenate([m, -m]) if len(mine.twin) else m
    factors = np.exp(2j * np.pi / count * np.outer(np.arange(count), both))
    of_rows = np.zeros((len(mine.rows), p, len(both)), complex)

    def work(low, high):
        _add_harmonics(low, high, rows, signs, turn, place, factors, of_rows)

    parallel_rows(work, len(mine.rows), len(mine.rows) * mine.node.size)
    of_rows = np.moveaxis(of_rows, 2, 0)
    if not len(mine.twin):
        return of_rows
    out = np.empty((len(m), p, p), complex)
    turned = mine.shift - mine.shift[mine.rows][:, None]
    back = factors[turned % count, : len(m)].transpose(2, 0, 1)
    out[:, mine.twin[mine.rows][:, None], mine.twin] = of_rows[len(m) :] * back
    out[:, mine.rows] = of_rows[: len(m)]
    return out


@kernel()
def _add_harmonics(low, high, rows, signs, turn, place, factors, out):
    """Σ_k a(i, R_k j) exp(imα_k), a from the classes, of the rows `low` to `high` into out (r, p, m)

    turn, place : (images, n) k and j of every image of a node; signs : over the number of classes
    """
    for i in range(low, high):
        for u in range(rows.shape[2]):
            for s in range(len(turn)):
                a = 0j
                for c in range(len(signs)):
                    a += signs[c, s] * rows[c, i, u]
                k, j = turn[s, u], place[s, u]
                for m in range(factors.shape[1]):
                    out[i, j, m] += a * factors[k, m]


def _in_classes(geometry, spectrum, velocities):
    """{class: (columns, hull nodes)}, what `_spectrum` takes, from (columns, m, hull nodes of a wedge)"""
    g, (node, image, on_hull, *_) = geometry, geometry.wedges
    count, whole = len(node), np.zeros((len(spectrum), len(node), spectrum.shape[2]), complex)
    whole[:, : spectrum.shape[1]] = spectrum
    if spectrum.shape[1] < count:  # the mirror planes of the classes add −m, but to 0 and N/2
        whole[:, 1 : (count + 1) // 2] *= 2
    rings = np.fft.ifft(whole, axis=1, norm="forward").reshape(len(spectrum), -1)
    place = np.empty((len(g.images), g.hull), np.int64)
    place[image[:, on_hull], node[:, on_hull]] = np.arange(rings.shape[1]).reshape(count, -1)
    out, start = {}, 0
    for cls, values in velocities.items():
        mine = rings[start : start + len(values)]
        out[cls] = np.einsum("s,csu->cu", g.signs(cls) / len(place), mine[:, place])
        start += len(values)
    return out
