"""Clusters of neighbouring panels, and pairs of clusters far enough apart for a block of low rank."""

from dataclasses import dataclass

import numpy as np

from ..influence import FAR

LEAF = 16  # panels of a leaf at most
# a block has low rank if the clusters are as far apart as SEPARATION of the larger one's diagonal, and beyond the
# distance at which panels are integrated by their nodes alone
SEPARATION = 0.7


@dataclass(frozen=True, eq=False)
class Clusters:
    """Binary trees over the panels of a hull and its lid; the panels of a cluster are consecutive in `order`.

    Of the c clusters, parents come before their children.  The lid has its own root, and so have the hull panels that
    face each of ±x, ±y, ±z: parts of a cluster that extends around an edge see each other edge-on, which cross
    approximation does not detect.  Each body has its own roots for this reason too: with one root for all bodies, two
    boxes of 1 000 panels had errors of 1 %.
    """

    order: np.ndarray  # (panels,) number in the mesh, by place in the tree
    first: np.ndarray  # (c,) place of the first panel
    end: np.ndarray  # (c,) one after that of the last
    children: np.ndarray  # (c, 2), −1 of a leaf
    low: np.ndarray  # (c, 3) m, corner of the box around its panels
    high: np.ndarray  # (c, 3) m
    size: np.ndarray  # (c,) m, of the largest panel
    roots: tuple

    @classmethod
    def of(cls, corners, normals, sizes, hull, body=None):
        """corners : (panels, 4, 3) m; normals : (panels, 3); sizes : (panels,) m
        hull : number of panels of the hull, which come first; body : index of the body of each of these panels,
            (hull,); None for one body
        """
        middles, rows, roots, low = corners.mean(axis=1), [], [], 0
        axis = np.abs(normals).argmax(axis=1)
        kind = 2 * axis + (normals[np.arange(len(axis)), axis] > 0)
        if body is not None:
            kind[:hull] += 7 * body
        kind[hull:] = 6
        order = np.argsort(kind, kind="stable")
        for count in np.unique(kind, return_counts=True)[1]:
            roots.append(len(rows))
            _divide(middles, order, low, low + count, rows)
            low += count
        first, end, one, other = np.array(rows).T
        points = [corners[order[a:b]].reshape(-1, 3) for a, b in zip(first, end, strict=True)]
        low, high = (np.array([f(own, axis=0) for own in points]) for f in (np.min, np.max))
        size = np.array([sizes[order[a:b]].max() for a, b in zip(first, end, strict=True)])
        return cls(order, first, end, np.stack([one, other], axis=1), low, high, size, tuple(roots))

    @property
    def leaves(self):
        """Indices of the clusters without children, in the order of their panels"""
        found = np.flatnonzero(self.children[:, 0] < 0)
        return found[np.argsort(self.first[found])]

    def pairs(self, images):
        """Return (far, near): far blocks and near blocks, which together cover all pairs of panels

        Each is an array (·, 3) of target, source and image. Target and source of a near block are leaves.
        images : signs of x and y of the images of the sources, ±1, (i, 2)
        """
        far, near = [], []
        left = np.array([(t, s, m) for t in self.roots for s in self.roots for m in range(len(images))])
        while len(left):
            t, s, m = left.T
            apart = self._apart(t, s, images[m])
            far.append(left[apart])
            left = left[~apart]
            t, s, _ = left.T
            end_t, end_s = (self.children[c, 0] < 0 for c in (t, s))
            near.append(left[end_t & end_s])
            count_t, count_s = self.end[t] - self.first[t], self.end[s] - self.first[s]
            split_t = ~end_t & (end_s | (count_t >= count_s))
            split_s = ~end_s & (end_t | (count_s >= count_t))  # both, for two of one size
            left = _children(left, split_t, split_s, self.children)
        return tuple(np.concatenate(parts) for parts in (far, near))

    def _apart(self, t, s, image):
        """Whether blocks are of low rank, for targets t, sources s (b,) and their images (b, 2); shape (b,)

        Images in surface and bed, on the other side of both blocks, are never nearer than the source.
        """
        low, high = self.low[s].copy(), self.high[s].copy()
        for axis in (0, 1):
            turned = image[:, axis] < 0
            low[turned, axis], high[turned, axis] = -self.high[s[turned], axis], -self.low[s[turned], axis]
        distance = np.linalg.norm(np.maximum(np.maximum(self.low[t] - high, low - self.high[t]), 0.0), axis=1)
        diagonals = np.linalg.norm(self.high - self.low, axis=1)
        return (distance > SEPARATION * np.maximum(diagonals[t], diagonals[s])) & (distance > FAR * self.size[s])


def _divide(middles, order, low, high, rows):
    """Sort `order` between the places low and high and append the rows (first, end, children) of their clusters"""
    here = len(rows)
    rows.append([low, high, -1, -1])
    if high - low <= LEAF:
        return
    part = order[low:high]
    axis = np.ptp(middles[part], axis=0).argmax()
    order[low:high] = part[np.argsort(middles[part, axis], kind="stable")]
    middle = (low + high) // 2
    for side, bounds in enumerate(((low, middle), (middle, high))):
        rows[here][2 + side] = len(rows)
        _divide(middles, order, *bounds, rows)


def _children(pairs, split_t, split_s, children):
    """The pairs of children of pairs (b, 3), where target, source or both are split"""
    out = []
    for both in ((True, True), (True, False), (False, True)):
        some = pairs[(split_t == both[0]) & (split_s == both[1])]
        targets = children[some[:, 0]].T if both[0] else [some[:, 0]]
        sources = children[some[:, 1]].T if both[1] else [some[:, 1]]
        out += [np.column_stack([t, s, some[:, 2]]) for t in targets for s in sources]
    return np.concatenate(out)
