"""Galerkin equations of several bodies: the `matching.FixedTerms` of all bodies and symmetry classes in one system."""

from itertools import pairwise, product

import numpy as np

from ...modes import class_of
from ..plan.maps import CLASSES


class Fixed:
    """Terms of `bodies.SeveralBodies` that do not depend on frequency, about the middle of each body, along its axes.

    layout : slices of the unknowns in the gap of each body, and of the velocities on its side
    functions : slices of the functions ψ of each body; side : (6N, sides); the other fields as in `matching.FixedTerms`
    """

    def __init__(self, bodies, degrees, tops):
        each = [_of_body(*one) for one in zip(bodies.bodies, degrees, tops, strict=True)]
        gaps, counts = [len(one["net"]) for one in each], [one["n"] for one in each]
        self.gaps = sum(gaps)
        ends, sides = np.cumsum([0, *gaps]), self.gaps + np.cumsum([0, *(2 * n for n in counts)])
        self.layout = _slices(ends), _slices(sides)
        self.functions, self.size = _slices(np.cumsum([0, *counts])), int(sides[-1])
        self.beneath, self.side, self.driven, self.carried, self.volume, self.own, self.net = (
            _joined([one[name] for one in each])
            for name in ("beneath", "side", "driven", "carried", "volume", "own", "net")
        )

    def outside(self, weights, maps, rows, single):
        """Sum over the evanescent modes and one separate mode, tested with all functions; shape (size, size)

        weights : {(a, b): (r_a, r_b, c)}; maps : (c, n, n); rows, single : [(r,)] and (n, n) of the separate mode
        """
        gaps, sides = self.layout
        out = np.empty((self.size,) * 2, np.result_type(single, float))
        for a, b in product(range(len(rows)), repeat=2):
            i, j = self.functions[a], self.functions[b]
            pairs = weights[a, b].reshape(-1, len(maps)) @ maps[:, i, j].reshape(len(maps), -1)
            block = pairs.reshape(len(rows[a]), len(rows[b]), *single[i, j].shape)
            block = (block + np.multiply.outer(np.multiply.outer(rows[a], rows[b]), single[i, j])).transpose(0, 2, 1, 3)
            for to, left in ((gaps[a], block[:-2]), (sides[a], block[-2:])):
                for of, part in ((gaps[b], left[:, :, :-2]), (sides[b], left[:, :, -2:])):
                    out[to, of] = part.reshape(to.stop - to.start, of.stop - of.start)
        return out

    def solved(self, outside, incident):
        """Solutions as in `matching.solved`, for the motions and then for the potentials of waves"""
        m, B = self.gaps, self.net.shape[1]
        matrix = np.block([[self.beneath - outside[:m, :m], self.net], [self.net.T, np.zeros((B, B))]])
        right = np.hstack([self.driven + outside[:m, m:] @ self.side.T, incident[:m]])
        right = np.vstack([right, np.hstack([self.volume.T, np.zeros((B, incident.shape[1]))])])
        x = np.linalg.solve(matrix, right)
        scale = np.abs(right).max(axis=0, initial=1e-300)
        return x[:m], x[m:], float(np.max(np.abs(matrix @ x - right) / scale, initial=0.0))

    def loads(self, outside, velocity, constant, incident):
        """∬ φ n dS along the motions; shape (6N, columns)"""
        m, d = self.driven.shape
        out = (self.side @ outside[m:, :m] + self.carried) @ velocity + self.volume @ constant
        out[:, :d] += self.side @ outside[m:, m:] @ self.side.T + self.own
        out[:, d:] += self.side @ incident[m:]
        return out


def _of_body(body, degree, top):
    """Terms of one body with its classes one after the other in the functions of each profile"""
    e, counts = len(body.profiles.mean), [len(body.plan.subset(cls, degree, top)) for cls in CLASSES]
    n, at = sum(counts), _slices(np.cumsum([0, *counts]))
    water = int(e > 0)  # a body on the bed has none under it, whose volume would be conserved
    out = {name: np.zeros(shape) for name, shape in {
        "beneath": (e, n, e, n), "side": (6, 2, n), "driven": (e, n, 6), "carried": (6, e, n), "volume": (6, water),
        "own": (6, 6), "net": (e, n, water)}.items()}  # fmt: skip
    for cls, own in zip(CLASSES, at, strict=True):
        dofs = [d for d in range(6) if class_of(d, "xy") == cls]
        one, c = body.fixed_terms(cls, degree, top, tuple(dofs)), own.stop - own.start
        out["beneath"][:, own, :, own] = one.beneath.reshape(e, c, e, c)
        out["side"][dofs, :, own] = one.side.reshape(len(dofs), 2, c)
        out["driven"][:, own, dofs] = one.driven.reshape(e, c, len(dofs))
        out["carried"][dofs, :, own] = one.carried.reshape(len(dofs), e, c)
        out["own"][np.ix_(dofs, dofs)] = one.own
        if one.net is not None:
            out["net"][:, own, 0] = one.net.reshape(e, c)
            out["volume"][dofs, 0] = one.volume
    flat = {
        "beneath": (e * n, e * n),
        "side": (6, 2 * n),
        "driven": (e * n, 6),
        "carried": (6, e * n),
        "net": (e * n, water),
    }
    return {name: value.reshape(flat.get(name, value.shape)) for name, value in out.items()} | {"n": n}


def _joined(parts):
    from scipy.linalg import block_diag

    return block_diag(*parts)


def _slices(ends):
    return [slice(int(a), int(b)) for a, b in pairwise(ends)]
