"""An approximate inverse of the compressed equations: a direct solution from cell to cell, the remainder leaf by
leaf.

Let P be the functions 1, x, y, z on each cell, orthonormal by area, R their integrals (R P = 1), and B the inverse
of the real diagonal blocks of the leaves. With Â = R A P for each symmetry class

    A⁻¹ ≈ P Â⁻¹ R + B (1 − P R)

(cf. two-grid iteration of equations of the second kind, Atkinson 1997, section 6.2).  The solution from cell to cell
helps where many iterations are needed: waves, and the flow through a gap above the bed, vary over lengths of more
than a cell.
"""

from itertools import pairwise

import numpy as np

MOST_FUNCTIONS = 2500  # approximate number of functions on all cells; their equations are solved directly
LEAST = 1e-3  # singular value, over the largest, above which 1, x, y, z on a cell are independent


class Preconditioner:
    """Approximate inverse of `bem.panels.compressed.operator.CompressedEquations`; n nodes, f functions on cells"""

    def __init__(self, equations):
        self.P, self.R, spans, starts = _cell_functions(equations.tree)
        self.by_image = self._reduced(equations, spans, starts)
        self.standing = {cls: (self.R @ u, (self.P.T @ v).T) for cls, (u, v) in equations.standing.items()}
        cells = np.repeat([span.start for span in spans], np.diff(starts))
        self.side, self.diagonal = equations.side[cells], equations.diagonal[cells, 0]
        self.inverses = _leaf_inverses(equations)
        self.factors = {}

    def __call__(self, values, signs):
        """Approximate A⁻¹ times (n, p); signs (images, p) ±1 of the class of each column"""
        from scipy.linalg import lu_solve

        smooth = self.R @ values
        rest = values - self.P @ smooth
        out = np.empty_like(rest)
        for span, inverse in self.inverses:
            out[span] = inverse @ rest[span]
        solved = np.empty_like(smooth)
        for own in np.unique(signs, axis=1).T:
            some = np.all(signs == own[:, None], axis=0)
            solved[:, some] = lu_solve(self._factors(own), smooth[:, some], check_finite=False)
        return out + self.P @ solved

    def _factors(self, signs):
        """LU of Â of a class"""
        from scipy.linalg import lu_factor

        key = tuple(signs.tolist())
        if key not in self.factors:
            waves, double = self.standing[key]
            matrix = np.tensordot(signs.astype(np.float32), self.by_image, 1) + 1j * (waves @ double).astype(np.float32)
            matrix *= self.side
            matrix.flat[:: len(matrix) + 1] += self.diagonal
            self.factors[key] = lu_factor(matrix, check_finite=False)
        return self.factors[key]

    def _reduced(self, equations, spans, starts):
        """Products R M P of the blocks of each image; shape (images, f, f)

        Small dense products: slices of sparse matrices took five times as long
        """
        n, f, images = len(equations.tree.nodes), starts[-1], len(equations.tree.geometry.images)
        own = [slice(*ends) for ends in pairwise(starts.tolist())]
        cells = [
            (span, its, self.P[span, its].toarray(), self.R[its, span].toarray())
            for span, its in zip(spans, own, strict=True)
        ]
        cell_of = np.repeat(np.arange(len(spans)), [span.stop - span.start for span in spans])

        def parts(span):
            """(slice within the span, functions, P, R) of the cells that overlap with a span of nodes"""
            for nodes, its, P, R in cells[cell_of[span.start] : cell_of[span.stop - 1] + 1]:
                low, high = max(span.start, nodes.start), min(span.stop, nodes.stop)
                within = slice(low - nodes.start, high - nodes.start)
                yield slice(low - span.start, high - span.start), its, P[within], R[:, within]

        out = np.zeros((images, f, f), np.float32)
        for span, places, matrix in equations.near:
            image, node = np.divmod(places, n)
            changes = np.flatnonzero(np.diff(image * len(spans) + cell_of[node])) + 1
            rows = [(its, R @ matrix[here]) for here, its, _, R in parts(span)]
            for low, high in pairwise([0, *changes.tolist(), len(places)]):
                nodes, columns, P, _ = cells[cell_of[node[low]]]
                P = P[node[low:high] - nodes.start]
                for its, left in rows:
                    out[image[low], its, columns] += left[:, low:high] @ P
        left, right, at = _Entries(), _Entries(), 0
        for span, U, places in equations.far.targets:
            for here, its, _, R in parts(span):
                left.add(R @ U[here], np.arange(its.start, its.stop), places)
        for m, span, V in equations.far.sources:
            for here, its, P, _ in parts(span):
                right.add(V[:, here] @ P, np.arange(at, at + len(V)), m * f + np.arange(its.start, its.stop))
            at += len(V)
        rank = equations.far.rank
        far = (left.matrix((f, rank)) @ right.matrix((rank, images * f))).toarray()
        return out + far.reshape(f, images, f).swapaxes(0, 1)


class _Entries:
    """Blocks (values, rows, columns) of a sparse matrix"""

    def __init__(self):
        self.parts = []

    def add(self, block, rows, columns):
        self.parts.append((block.ravel(), np.repeat(rows, len(columns)), np.tile(columns, len(rows))))

    def matrix(self, shape):
        from scipy.sparse import csr_matrix

        if not self.parts:
            return csr_matrix(shape, dtype=np.float32)
        values, rows, columns = (np.concatenate(parts) for parts in zip(*self.parts, strict=True))
        return csr_matrix((values, (rows, columns)), shape)


def _cell_functions(tree):
    """P (n, f) and R (f, n) sparse, the slices of nodes of the cells, the number of the first function of each"""
    from scipy.sparse import csr_matrix

    spans = tree.cells(MOST_FUNCTIONS // 3)
    rows, columns, there, back, starts = [], [], [], [], [0]
    for span in spans:
        points, root = tree.elements.nodes[span], np.sqrt(tree.elements.weights[span])[:, None]
        local = points - points.mean(axis=0)
        local /= max(np.abs(local).max(), 1e-300)
        U, size, _ = np.linalg.svd(np.column_stack([np.ones(len(local)), local]) * root, full_matrices=False)
        U = U[:, size > LEAST * size[0]]
        row, column = np.meshgrid(np.arange(span.start, span.stop), starts[-1] + np.arange(U.shape[1]), indexing="ij")
        for parts, values in ((rows, row), (columns, column), (there, U / root), (back, U * root)):
            parts.append(values.ravel())
        starts.append(starts[-1] + U.shape[1])
    rows, columns = np.concatenate(rows), np.concatenate(columns)
    n, f = len(tree.nodes), starts[-1]
    P = csr_matrix((np.concatenate(there).astype(np.float32), (rows, columns)), (n, f))
    R = csr_matrix((np.concatenate(back).astype(np.float32), (columns, rows)), (f, n))
    return P, R, spans, np.array(starts)


def _leaf_inverses(equations):
    """[(slice of nodes, inverse of the diagonal block)] of the leaves, without their mirror images"""
    out = []
    for span, places, matrix in equations.near:
        own = (places >= span.start) & (places < span.stop)
        block = equations.side[span] * matrix[:, own]
        block.flat[:: len(block) + 1] += equations.diagonal[span, 0]
        out.append((span, np.linalg.inv(block)))
    return out
