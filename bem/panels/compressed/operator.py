"""The equations of `bem.panels.influence` at one frequency, as an operator on the nodes, for all symmetry classes.

Blocks are real, because the imaginary part is a sum over few standing waves (`bem.panels.standing_waves`). Real
blocks need half the operations and memory of complex blocks.  Each block belongs to a mirror image of the sources,
not to a class: images lie farther from the targets than the panels themselves. All classes use the same blocks, with
columns multiplied by the signs of the class.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...kernels.threads import blas_threads, parallel_rows
from ..elements import Elements
from ..influence import rankine_of_panels
from ..standing_waves import standing_waves
from ..wave_influence import COARSE, PER_WAVE
from .clusters import Clusters
from .far_blocks import Sources, Water, low_rank_blocks
from .near_blocks import Panels, near_waves, shares

# most entries of near blocks whose Rankine parts are kept for other frequencies, 8 bytes each: a tenth of their time
MOST_KEPT = 40_000_000
PARTS = 16  # groups of blocks whose sums are added in a fixed order, for any number of threads


class Tree:
    """Data of compressed equations that do not depend on frequency, with the panels of a
    `bem.panels.influence.Geometry` in the order of their clusters.

    There are n nodes; in the order of the clusters the nodes of panel p begin at 4 p.
    """

    def __init__(self, geometry):
        g = self.geometry = geometry
        per_panel = g.elements.inverse.shape[2]
        panels, hull = g.panels, g.hull // per_panel
        self.clusters = Clusters.of(panels.flat_vertices, panels.normals, panels.sizes, hull, g.mesh.body)
        order = self.clusters.order
        self.nodes = (order[:, None] * per_panel + np.arange(per_panel)).ravel()  # number in the mesh
        self.elements = Elements(*(a[order if len(a) == len(order) else self.nodes] for a in g.elements))
        self.quadrature = g.quadrature._make(a[order] for a in g.quadrature)
        self.hull = self.nodes < g.hull
        self.per_panel = per_panel
        self.far, self.near = self.clusters.pairs(g.images)
        counts = per_panel * (self.clusters.end - self.clusters.first)
        few = counts[self.near[:, 0]] @ counts[self.near[:, 1]] <= MOST_KEPT
        self.kept = [None] * len(self.clusters.leaves) if few else None

    def span(self, cluster):
        """Slice of the nodes of a cluster"""
        c = self.clusters
        return slice(self.per_panel * c.first[cluster], self.per_panel * c.end[cluster])

    def cells(self, most):
        """Slices of the nodes of clusters that together cover all nodes: the leaves, or about `most` larger clusters"""
        c, limit = self.clusters, 1
        counts = c.end - c.first
        while True:
            small = counts <= limit
            whole = small | (c.children[:, 0] < 0)
            parent = np.full(len(counts), -1)
            for side in range(2):
                has = c.children[:, 0] >= 0
                parent[c.children[has, side]] = np.flatnonzero(has)
            top = whole & ((parent < 0) | ~whole[parent])
            if top.sum() <= most:
                found = np.flatnonzero(top)
                return [self.span(k) for k in found[np.argsort(c.first[found])]]
            limit *= 2

    @cached_property
    def neighbours(self):
        """[(leaf, [(image, (panels,))])] of the near blocks"""
        c, near = self.clusters, self.near[np.lexsort((self.near[:, 2], self.near[:, 0]))]
        out = []
        for leaf in c.leaves:
            own = near[near[:, 0] == leaf]
            found = []
            for m in np.unique(own[:, 2]):
                ranges = [np.arange(c.first[s], c.end[s]) for s in np.sort(own[own[:, 2] == m, 1])]
                found.append((m, np.concatenate(ranges)))
            out.append((leaf, found))
        return out

    @cached_property
    def shares(self):
        """`bem.panels.compressed.near_blocks.shares` of the near blocks"""
        spans = {leaf: self.span(leaf) for leaf in self.clusters.leaves.tolist()}
        return shares(spans, self.near)

    def near_rankine(self, number):
        """[(S, D)] (points, nodes) of 1/r + 1/r₂ + 1/r₁ with each image in `neighbours[number]`, in single precision"""
        if self.kept is None or self.kept[number] is None:
            leaf, neighbours = self.neighbours[number]
            at = self.elements.nodes[self.span(leaf)]
            every = [self.rankine(at, m, panels)[:2] for m, panels in neighbours]
            found = [tuple(part.astype(np.float32) for part in both) for both in every]
            if self.kept is None:
                return found
            self.kept[number] = found
        return self.kept[number]

    def rankine(self, at, m, panels):
        """Rankine integrals, as `bem.panels.influence.Geometry.rankine_rows`, of image `m` of the given panels;
        (points, nodes)"""
        g = self.geometry
        image, one = g.images[m : m + 1], np.ones((1, 1))
        return tuple(a[0] for a in rankine_of_panels(at, self.elements_of(panels), image, one, g.depth))

    def elements_of(self, panels):
        """`Elements` of the given panels, in the given order"""
        nodes = self.nodes_of(panels)
        return Elements(*(a[panels if len(a) == len(self.clusters.order) else nodes] for a in self.elements))

    def nodes_of(self, panels):
        """Indices, in the tree, of the nodes of the given panels; shape (nodes,)"""
        return (panels[:, None] * self.per_panel + np.arange(self.per_panel)).ravel()


class Columns(NamedTuple):
    """Right-hand sides or potentials of several classes side by side: p columns of n nodes in the order of the tree"""

    values: np.ndarray  # (n, p)
    signs: np.ndarray  # (images, p) ±1 of each column's class on the mirror images

    @property
    def images(self):
        """Values on all mirror images; shape (images, n, p)"""
        return self.values * self.signs[:, None]


class LowRankPart(NamedTuple):
    """All far blocks: T = V x at the sources, cluster by cluster and image by image, then y = U T at the targets"""

    sources: list  # (image, slice of nodes, V (rank, nodes)) each, in the order of their ranks in T
    targets: list  # (slice of nodes, U (nodes, rank), places (rank,) in T) each
    rank: int

    @classmethod
    def of(cls, blocks, tree):
        """blocks : list of (target, source, image, U, V), emptied here because it may hold most of the memory"""
        lefts, rights = [U for *_, U, _ in blocks], [V for *_, V in blocks]
        keys = [key for *key, _, _ in blocks]
        blocks.clear()
        starts, at, sources, targets = [0] * len(keys), 0, [], []
        for group in _groups([(m, s) for _, s, m in keys]):
            m, s = keys[group[0]][2], keys[group[0]][1]
            sources.append((m, tree.span(s), _stacked(rights, group, 0)))
            for i in group:
                starts[i], at = at, at + lefts[i].shape[1]
        for group in _groups([t for t, _, _ in keys]):
            places = np.concatenate([np.arange(starts[i], starts[i] + lefts[i].shape[1]) for i in group])
            targets.append((tree.span(keys[group[0]][0]), _stacked(lefts, group, 1), places))
        return cls(sources, targets, at)


def _groups(keys):
    """Lists of the indices of equal keys, in the order of the keys"""
    out = {}
    for i, key in enumerate(keys):
        out.setdefault(key, []).append(i)
    return [out[key] for key in sorted(out)]


def _stacked(arrays, group, axis):
    """The arrays of a group as one array, removed from the list"""
    one = np.concatenate([arrays[i] for i in group], axis=axis)
    for i in group:
        arrays[i] = None
    return one


class CompressedEquations:
    """The equations A x = b of one frequency for all classes at once, with n nodes in the order of the tree.

    x contains φ on the hull and φ' on the lid, as in `bem.panels.influence`
    """

    KEPT = np.float32  # number type of the stored blocks

    def __init__(self, tree, table, mirror, depth_values, velocities, tolerance):
        """velocities : `Columns` of normal velocities, zero on the lid; tolerance : tolerance of A relative to 2π"""
        self.tree = tree
        self.side = np.where(tree.hull, -1.0, 1.0)[:, None]
        self.diagonal = np.where(tree.hull, 2 * np.pi, 4 * np.pi)[:, None]
        self.arguments = table, mirror, depth_values
        images = np.ascontiguousarray(velocities.images)
        sides = np.zeros(velocities.values.shape, complex)
        with blas_threads(1):
            self.near = self._near_blocks(images, sides)
            self.far = LowRankPart.of(self._far_blocks(images, sides, tolerance), tree)
            self.of_cells, self.of_more = self._by_cells()
        self.standing = {}
        for some, signs in _by_class(velocities.signs):
            waves, single, double = self._standing_waves(signs)
            sides[:, some] += 1j * (waves @ (single.T @ velocities.values[:, some]))
            self.standing[tuple(signs)] = waves, np.where(tree.hull[:, None], double, table.K * single)
        self.sides = self.side * sides

    def _standing_waves(self, signs):
        """`bem.panels.standing_waves.standing_waves` of the class with these signs, in the order of the tree"""
        g, (table, _, depth_values) = self.tree.geometry, self.arguments
        cls = g.classes[g.all_signs.tolist().index(signs.tolist())]
        return standing_waves(g, [cls], table, depth_values)[:, 0, self.tree.nodes]

    def _near_blocks(self, images, sides):
        """[(slice of targets, nodes among all images, matrix)]; adds the single layers of the hull to `sides`"""
        tree, n = self.tree, len(self.tree.nodes)
        found, parts = [None] * len(tree.neighbours), [None] * PARTS
        for i, (leaf, neighbours) in enumerate(tree.neighbours):
            places = np.concatenate([m * n + tree.nodes_of(panels) for m, panels in neighbours])
            span = tree.span(leaf)
            found[i] = span, places, np.empty((span.stop - span.start, len(places)), self.KEPT)
        rows = [(span, matrix) for span, _, matrix in found]

        def rankine(low, high):
            for i in range(low, high):
                self._put_rankine(i, rows[i], images, sides)

        def waves(low, high):
            for part in range(low, high):
                own = parts[part] = np.zeros_like(sides)
                for i in range(part, len(found), PARTS):
                    self._put_waves(i, rows, images, own)

        parallel_rows(rankine, len(found), n**2)
        parallel_rows(waves, PARTS, n**2)
        for own in parts:
            sides += own
        return found

    def _put_rankine(self, number, row, images, sides):
        """Put the Rankine part of the block of one leaf of targets into its matrix, its single layer into `sides`"""
        tree, K, mirror = self.tree, self.arguments[0].K, self.arguments[1]
        span, matrix = row
        neighbours = tree.neighbours[number][1]
        at = tree.elements.nodes[span]
        known = tree.near_rankine(number) if mirror == 1 else [tree.rankine(at, *one) for one in neighbours]
        first = 0
        for (m, panels), (S, D, *of_mirror) in zip(neighbours, known, strict=True):
            nodes = tree.nodes_of(panels)
            if mirror != 1:
                S, D = S + (mirror - 1) * of_mirror[0], D + (mirror - 1) * of_mirror[1]
            sides[span] += (S @ images[m][nodes].view(float)).view(complex)  # velocities are zero on the lid
            hull, end = tree.hull[nodes], first + len(nodes)
            matrix[:, first:end] = D if hull.all() else np.where(hull, D, K * S)
            first = end

    def _put_waves(self, number, rows, images, sides):
        """Add the wave part of the blocks of one leaf's `Share` to their matrices, their single layers to `sides`"""
        tree, (span, matrix), share = self.tree, rows[number], self.tree.shares[number]
        S, D, S_back, D_back = near_waves(span, share, tree.geometry.images, self.panels, self.arguments[0])
        sides[span] += (S @ images[share.images, share.nodes].view(float)).view(complex)
        for other, columns, here, there in share.blocks:
            matrix[:, here : here + columns.stop - columns.start] += D[:, columns]
            if columns.stop <= share.both:
                its, back = rows[other]
                back[:, there : there + span.stop - span.start] += D_back[:, columns].T
                velocities = images[share.images[columns.start], span].view(float)
                sides[its] += (S_back[:, columns].T @ velocities).view(complex)

    @cached_property
    def panels(self):
        """`bem.panels.compressed.near_blocks.Panels` in the order of the tree"""
        tree, (table, _, depth_values) = self.tree, self.arguments
        return Panels.of(tree.elements, tree.quadrature, tree.hull, table, tree.geometry.depth, depth_values)

    def _by_cells(self):
        """Sort the blocks: [(near blocks, far targets)] of cells without common nodes, and far targets of more than a
        cell"""
        cells, more = self.tree.cells(PARTS), []
        first, parts = np.array([cell.start for cell in cells]), [([], []) for _ in cells]
        for kind, blocks in enumerate((self.near, self.far.targets)):
            for block in blocks:
                cell = np.searchsorted(first, block[0].start, "right") - 1
                (parts[cell][kind] if block[0].stop <= cells[cell].stop else more).append(block)
        return parts, more

    def _far_blocks(self, images, sides, tolerance):
        """[(target, source, image, U, V)] of all far blocks; adds the single layers, which are not kept, to `sides`"""
        tree, found, parts = self.tree, [None] * PARTS, self._parts()
        # S of a unit velocity is of the order of the body's length
        size = np.abs(sides).max() / np.abs(images).max()
        each = tolerance / (len(tree.geometry.images) * len(tree.nodes))

        def work(low, high):
            for part in range(low, high):
                kept, own = found[part] = [], np.zeros_like(sides)
                made = self._compressed(parts[part], size * each, 2 * np.pi * each)
                for (t, s, m), (U, V, V_S) in zip(parts[part], made, strict=True):
                    own[tree.span(t)] += U @ (V_S @ images[m][tree.span(s)])
                    kept.append((t, s, m, U.astype(self.KEPT), V.astype(self.KEPT)))

        parallel_rows(work, PARTS, len(tree.nodes) ** 2)
        for _, own in found:
            sides += own
        return [block for kept, _ in found for block in kept]

    def _parts(self):
        """The far blocks (·, 3) in `PARTS` parts, each with blocks of all sizes"""
        far = self.tree.far
        return [far[start::PARTS] for start in range(PARTS)]

    def _compressed(self, blocks, single, double):
        """`LowRank` of each of the blocks (b, 3), one after the other"""
        tree, g = self.tree, self.tree.geometry
        c, p = tree.clusters, tree.per_panel
        t, s, m = blocks.T
        spans = np.column_stack([p * c.first[t], p * c.end[t], p * c.first[s], p * c.end[s]])
        numbers = np.column_stack([spans, g.images[m].astype(int)])
        nodes = tree.elements.nodes
        return low_rank_blocks(numbers, nodes, self.at_depth, self.sources, self.water, single, double)

    @cached_property
    def water(self):
        g, (table, mirror, _) = self.tree.geometry, self.arguments
        bed = bool(np.isfinite(g.depth))
        return Water(table, float(mirror), bed, -2 * g.depth if bed else 0.0)

    @cached_property
    def at_depth(self):
        return self.arguments[2](self.tree.elements.nodes[:, 2])[:, 0].copy()

    @cached_property
    def sources(self):
        """`bem.panels.compressed.far_blocks.Sources`: nodes, or FINE × FINE points of panels that are long for waves"""
        tree, (table, _, depth_values) = self.tree, self.arguments
        e, p = tree.elements, tree.per_panel
        shortest = min(1 / table.k if table.k > 0 else np.inf, tree.geometry.depth)
        fine = np.repeat(e.sizes > PER_WAVE * shortest, p)
        many = tree.quadrature.weights.shape[1] - COARSE**2
        counts = np.where(fine, many, 1)
        first = np.concatenate([[0], np.cumsum(counts)])
        node = np.repeat(np.arange(len(fine)), counts)
        points, weights = e.nodes[node].copy(), e.weights[node].copy()
        if fine.any():
            some, panel, corner = fine[node], node // p, node % p
            which = (np.arange(len(node)) - first[node])[some] + COARSE**2
            points[some] = tree.quadrature.points[panel[some], which]
            shape = tree.quadrature.shape[panel[some], which, corner[some]]
            weights[some] = tree.quadrature.weights[panel[some], which] * shape
        return Sources(first, points, e.normals[node].copy(), weights, depth_values(points[:, 2]), tree.hull)

    def apply(self, columns, exactly=False):
        """A x for x in `Columns`; shape (n, p)

        exactly : whether products are in double precision; False: in the precision of the stored blocks"""
        kind, part = (complex, float) if exactly else (np.complex64, np.float32)
        values = np.ascontiguousarray(columns.values, kind)
        # real and imaginary parts side by side: the blocks are real
        images = np.ascontiguousarray(columns._replace(values=values).images, kind).view(part)
        flat = images.reshape(-1, images.shape[-1])
        out = np.zeros((len(values), images.shape[-1]), part)
        T, sources = np.empty((self.far.rank, images.shape[-1]), part), self.far.sources
        ends = np.cumsum([len(V) for *_, V in sources])

        def to_ranks(low, high):
            for (m, span, V), end in zip(sources[low:high], ends[low:high], strict=True):
                np.matmul(V, images[m, span], out=T[end - len(V) : end])

        def to_nodes(low, high):
            for near, targets in self.of_cells[low:high]:
                for span, places, matrix in near:
                    out[span] += matrix @ flat[places]
                for span, U, places in targets:
                    out[span] += U @ T[places]

        with blas_threads(1):
            parallel_rows(to_ranks, len(sources), out.size)
            for span, U, places in self.of_more:
                out[span] += U @ T[places]
            parallel_rows(to_nodes, len(self.of_cells), out.size)
        out = out.view(kind)
        for some, signs in _by_class(columns.signs):
            waves, double = self.standing[tuple(signs)]
            out[:, some] += 1j * _product(waves, _product(double.T, values[:, some]))
        return self.side * out + self.diagonal * columns.values

    @property
    def bytes(self):
        """of the blocks"""
        return (
            sum(a.nbytes for *_, a in self.near)
            + sum(a.nbytes for *_, a in self.far.sources)
            + sum(a.nbytes for _, a, _ in self.far.targets)
        )


def _product(real, values):
    """real (a, b) @ complex (b, c) in the precision of the second: numpy would make a complex copy of the first"""
    part = values.real.dtype
    return (real.astype(part, copy=False) @ np.ascontiguousarray(values).view(part)).view(values.dtype)


def _by_class(signs):
    """(numbers of the columns, signs (images,)) of each class; signs : signs of `Columns`"""
    every, which = np.unique(signs, axis=1, return_inverse=True)
    return [(np.flatnonzero(which.ravel() == i), own) for i, own in enumerate(every.T)]
