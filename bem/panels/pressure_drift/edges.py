"""Sharp edges of a hull, and interpolation stencils: panels in a row, up to an edge or across mirror planes.

At an edge where the hull turns by α the water fills the angle π + α; at a distance r from the edge the potential is a
series of powers of r^μ, μ = π / (π + α): 2/3 at the edges of a box.
"""

from typing import NamedTuple

import numpy as np

SHARP = np.pi / 3  # rad, the smallest turn of an edge: smaller turns occur between panels of a curved hull
SIDES = (3, 1), (0, 2)  # indices of the sides of a panel where s is −1 and 1, and where t is −1 and 1


def sharp_sides(mesh):
    """Exponent μ of the flow at the side from corner i to i + 1 of every panel; 1 for a side that is no sharp edge;
    shape (n, 4)"""
    hull = mesh.whole()
    out, (one, other) = np.ones(4 * len(hull)), _neighbours(hull)
    a, b = one // 4, other // 4
    turn = np.arccos(np.clip(np.sum(hull.normals[a] * hull.normals[b], axis=1), -1, 1))
    convex = np.sum((hull.centroids[b] - hull.centroids[a]) * hull.normals[a], axis=1) < 0
    out[one] = out[other] = np.where(convex & (turn > SHARP), np.pi / (np.pi + turn), 1.0)
    return out.reshape(-1, 4)[: len(mesh)]


class Stencils(NamedTuple):
    """Up to three panels in a row for each of n panels, in one direction of the panel; φ is interpolated between
    their nodes.

    For a panel at an edge, and for its neighbour, these are the first three panels from the edge. Elsewhere they are
    the panel and its two neighbours, including mirror images. Distances are measured from the outer end of the first
    panel.
    """

    at_edge: np.ndarray  # (n,) whether the row begins at an edge
    own: np.ndarray  # (n,) index of the panel itself among the three
    end: np.ndarray  # (n,) −1 or 1, the end of the panel from which distances grow
    mu: np.ndarray  # (n,) exponent of the flow, 1 without an edge
    panels: np.ndarray  # (n, 3) numbers; arbitrary beyond `count`
    images: np.ndarray  # (n, 3) index in `mesh.reflections()` of the image on which they lie, seen from the panel
    forward: np.ndarray  # (n, 3) whether distances grow with s or t
    lengths: np.ndarray  # (n, 3) m; at an edge the last one is repeated for missing panels
    across: np.ndarray  # (n, 3) m, of the panels on the other face of the edge
    gap: np.ndarray  # (n,) m of water under that face if it is a flat bottom and this one a side, else infinite
    count: np.ndarray  # (n,) panels of the stencil, 1 to 3
    row: np.ndarray  # (n, 3) `panels` including those whose stencil is the panel alone, as others need them

    @property
    def first(self):
        """The panel at the edge, or the panel itself if there is no edge; shape (n,)"""
        return np.where(self.at_edge, self.panels[:, 0], np.arange(len(self.at_edge)))

    def replaced(self, where, others):
        """A copy in which the stencils of `others` replace those where `where` (n,) is true"""
        return Stencils(
            *(np.where(where.reshape(-1, *[1] * (a.ndim - 1)), b, a) for a, b in zip(self, others, strict=True))
        )

    def where(self, used, alone):
        """A copy that keeps the stencils where `used` (n,) is true, and elsewhere has the stencils `alone` of single
        panels at
            the same edges"""
        first = self.at_edge & (self.own == 0)
        across = np.where(first[:, None], self.across, alone.across), np.where(first, self.gap, alone.gap)
        return self.replaced(~used, alone._replace(across=across[0], gap=across[1]))._replace(row=self.row)

    def same_layout(self, panel):
        """Whether the stencils of `panel` (n,) have the same layout; shape (n,); panels, lengths and angles may
        differ"""
        measured = dict.fromkeys(("panels", "mu", "lengths", "across", "gap", "row"), self.at_edge)
        parts = self._replace(**measured)
        return np.all([np.all((a == a[panel]).reshape(len(panel), -1), axis=1) for a in parts], axis=0)


def stencils(mesh, exponents, depth=np.inf, steady=lambda stencil: True):
    """`Stencils` along s and along t; exponents : (n, 4) as in `sharp_sides`; depth : m

    The two directions form a product stencil. The stencil is the panel alone if the panels of one direction have
    different layouts in the other direction, or if `steady` (n,) of a stencil is false.
    """
    adjacency = _Adjacency(_continuations(mesh), _planes(mesh))
    (s, single_s), (t, single_t) = (_in_direction(mesh, exponents, adjacency, *sides) for sides in SIDES)
    s, t = (_with_other_face(mesh, stencil, sides, (s, t), depth) for stencil, sides in zip((s, t), SIDES, strict=True))
    one, two = (_alike(*pair) & steady(pair[0]) for pair in ((s, t), (t, s)))
    return s.where(one, single_s), t.where(two, single_t)


def coarsest_at_gap(mesh, depth):
    """Length of a panel next to the keel, m, and gap under this panel, m, where length over gap is largest

    Returns 0 and infinity for a hull without panels next to the keel.
    """
    length, gap = 0.0, np.inf
    for stencil in stencils(mesh, sharp_sides(mesh), depth):
        for size, under in zip(np.maximum(stencil.lengths, stencil.across)[:, 0], stencil.gap, strict=True):
            if size / under > length / gap:
                length, gap = size, under
    return length, gap


class _Adjacency(NamedTuple):
    """beside : (n, 4) panel beyond each side, without an edge between and with corners in the same order; else −1

    plane : (n, 4) mirror image on which the panel itself continues beyond the side, 0 where no mirror plane is
    """

    beside: np.ndarray
    plane: np.ndarray

    def beyond(self, panel, image, side):
        """Panel beyond a side of panels on mirror images (−1 for none), its image, and its opposite side"""
        after, plane = self.beside[panel, side], self.plane[panel, side]
        mirrored = (after < 0) & (plane > 0)
        return np.where(mirrored, panel, after), image ^ np.where(mirrored, plane, 0), (side + 2 * mirrored) % 4


def _in_direction(mesh, exponents, adjacency, minus, plus):
    """`Stencils` in one direction, and those of every panel alone"""
    one, two = exponents[:, minus], exponents[:, plus]
    own, zero, open_ = np.arange(len(mesh)), np.zeros(len(mesh), int), np.full(len(mesh), np.inf)
    sharp, free = (one < 1) ^ (two < 1), (one == 1) & (two == 1)  # between two edges: straight lines only
    end, mu = np.where(sharp & (two < 1), 1, -1), np.where(sharp, np.minimum(one, two), 1.0)
    middles = mesh.flat_vertices + np.roll(mesh.flat_vertices, -1, axis=1)
    size = np.linalg.norm(middles[:, plus] - middles[:, minus], axis=1) / 2

    def line(parts, count, place):
        panels, images, sides = (np.stack(part, axis=1) for part in zip(*parts, strict=True))
        lengths = size[panels]
        return Stencils(sharp, place, end, mu, panels, images, sides == plus, lengths, lengths, open_, count, panels)

    here = own, zero, np.where(end < 0, plus, minus)
    single = line([here] * 3, zero + 1, zero)
    first, second = _from_edges(line, adjacency, here, sharp, free)
    out = single.replaced(free, _between(line, adjacency, own, minus, plus)).replaced(sharp, first)
    has = np.flatnonzero(second.count > 1)
    for part, values in zip(out, second, strict=True):
        part[second.panels[has, 1]] = values[has]
    return out, single


def _from_edges(line, adjacency, here, sharp, free):
    """`Stencils` of the panels at the edges, and those of the panels behind them, in the same order"""
    parts, known, count = [here], sharp, np.ones(len(sharp), int)
    for _ in range(2):
        after = adjacency.beyond(*parts[-1])
        known = known & (after[0] >= 0) & free[after[0]]
        parts.append(_where(known, after, here))
        count = count + known
    out, last = line(parts, count, 0 * count), np.minimum(np.arange(3), count[:, None] - 1)
    out = out._replace(lengths=np.take_along_axis(out.lengths, last, axis=1))
    return out._replace(count=np.minimum(count, 2)), out._replace(own=0 * count + 1)


def _between(line, adjacency, own, minus, plus):
    """`Stencils` of panels without an edge: the panel and its neighbours"""
    zero = 0 * own
    panel, image, side = adjacency.beyond(own, zero, zero + minus)
    here, before = (own, zero, zero + plus), (panel, image, (side + 2) % 4)
    after = adjacency.beyond(*here)
    behind, ahead = panel >= 0, after[0] >= 0
    after = _where(ahead, after, here)
    parts = _where(behind, before, here), _where(behind, here, after), _where(behind, after, here)
    return line(parts, 1 + behind + ahead, behind.astype(int))


def _where(condition, parts, others):
    return tuple(np.where(condition, a, b) for a, b in zip(parts, others, strict=True))


def _with_other_face(mesh, stencil, sides, both, depth):
    """`Stencils` with lengths and gap of the other face of the edge; if that is the mirror image, with its own"""
    other = np.arange(4 * len(mesh))
    one, two = _neighbours(mesh)
    other[one], other[two] = two, one
    panel, side = divmod(other[4 * stencil.first + np.take(sides, (stencil.end + 1) // 2)], 4)
    lengths = stencil.lengths
    for facing, ends in zip(both, SIDES, strict=True):
        begins = facing.at_edge & (facing.own == 0)
        here = stencil.at_edge & begins[panel] & (side == np.take(ends, (facing.end[panel] + 1) // 2))
        lengths = np.where(here[:, None], facing.lengths[panel], lengths)
    upright, flat = np.abs(mesh.normals[:, 2]) < 1e-6, mesh.normals[panel, 2] < -1 + 1e-6
    gap = depth + mesh.vertices[panel, :, 2].mean(axis=1)
    gap = np.where(stencil.at_edge & upright & flat & (gap > 0), gap, np.inf)
    return stencil._replace(across=lengths, gap=gap)


def _alike(own_rows, across):
    """Whether the panels of each stencil have the same layout across it, so that a product stencil exists; shape
    (n,)"""
    out = np.all([across.same_layout(panel) for panel in own_rows.panels.T], axis=0)
    beside = own_rows.panels[across.panels]
    return out & np.all(beside == across.panels[own_rows.panels].transpose(0, 2, 1), axis=(1, 2))


def _planes(mesh):
    """Mirror image on which a panel continues beyond each side; shape (n, 4); 0 without one, or if the hull bends
    there"""
    v, out = mesh.vertices, np.zeros((len(mesh), 4), int)
    for image, (x, y) in enumerate(mesh.reflections()):
        if x * y < 0:
            axis = 0 if x < 0 else 1
            on = np.abs(v[..., axis]) < 1e-6 * mesh.sizes.max()
            smooth = np.abs(mesh.normals[:, axis]) < np.sin(SHARP / 2)
            out[on & np.roll(on, -1, axis=1) & smooth[:, None]] = image
    return out


def _continuations(mesh):
    """Panel beyond each side, without an edge between and with corners in the same order; shape (n, 4); −1 if there is
    none"""
    one, other = _neighbours(mesh)
    smooth = np.sum(mesh.normals[one // 4] * mesh.normals[other // 4], axis=1) > np.cos(SHARP)
    same_layout = smooth & (one % 4 == (other + 2) % 4)
    out = np.full(4 * len(mesh), -1)
    for a, b in ((one, other), (other, one)):
        out[a[same_layout]] = b[same_layout] // 4
    return out.reshape(-1, 4)


def _neighbours(mesh):
    """Sides, as 4 · panel + side, that two panels share: two arrays"""
    v = mesh.vertices
    place = np.round(v.reshape(-1, 3) / (1e-6 * mesh.sizes.max())).astype(np.int64)
    number = np.unique(place, axis=0, return_inverse=True)[1].reshape(-1, 4)
    ends = np.sort(np.stack([number, np.roll(number, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    _, side, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    first = np.argsort(side.ravel(), kind="stable")[np.repeat(count, count) == 2]
    return first[::2], first[1::2]
