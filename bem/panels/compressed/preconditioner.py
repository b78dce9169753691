"""An approximate inverse of the compressed equations: variation from cell to cell directly, the rest leaf by leaf.

With P the functions 1, x, y, z on each cell, orthonormal by area, and R their integrals (R P = 1), B the inverse of the
real diagonal blocks of the leaves and Â = R A P for each symmetry class

    A⁻¹ ≈ P Â⁻¹ R + B (1 − P R)

(cf. two-grid iteration of equations of the second kind, Atkinson 1997, section 6.2).  Such a coarse solution helps
where many iterations are needed: waves and the flow through a gap above the bed vary over more than a cell.
"""

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
        """Products R M P of the blocks of each image; shape (images, f, f)"""
        from scipy.sparse import csr_matrix

        n, f, images = len(equations.tree.nodes), starts[-1], len(equations.tree.geometry.images)
        out = np.zeros((images, f, f), np.float32)
        first, end = (np.array(ends) for ends in zip(*((span.start, span.stop) for span in spans), strict=True))

        def functions(span):
            """slice of the functions on the cells that overlap with a span of nodes"""
            low, high = np.searchsorted(end, span.start, "right"), np.searchsorted(first, span.stop)
            return slice(starts[low], starts[high])

        for span, places, matrix in equations.near:
            own = functions(span)
            rows = self.R[own, span] @ matrix
            for m in range(images):
                some = places // n == m
                if some.any():
                    out[m, own] += rows[:, some] @ self.P[places[some] - m * n]
        rank, lefts, at = equations.far.rank, [], 0
        for span, U, places in equations.far.targets:
            own = functions(span)
            block = self.R[own, span] @ U
            row, column = np.meshgrid(np.arange(own.start, own.stop), places, indexing="ij")
            lefts.append((block.ravel(), row.ravel(), column.ravel()))
        if not lefts:
            return out
        data, row, column = (np.concatenate(parts) for parts in zip(*lefts, strict=True))
        left = csr_matrix((data, (row, column)), (f, rank)).tocsc()
        for m, span, V in equations.far.sources:
            own = functions(span)
            both = left[:, at : at + len(V)]
            touched = np.unique(both.indices)
            out[m, touched, own] += both[touched].toarray() @ (V @ self.P[span, own])
            at += len(V)
        return out


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
