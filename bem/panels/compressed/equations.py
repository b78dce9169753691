"""Solutions of the compressed equations, and bounds of the errors by the compression."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..influence import layers
from .iteration import gmres
from .operator import Columns, CompressedEquations, Tree
from .preconditioner import Preconditioner

RESIDUAL = 3e-7  # residual of the iteration, relative to the right-hand sides
ITERATIONS = 400
ALLOWED = 2e-3  # largest accepted error of the potentials by compression
SAMPLES, SAMPLES_AT_ONCE = 32, 8  # rows of the full equations that are sampled
SEED = 1_982


class Solution(NamedTuple):
    """potentials : {class: (columns, n)} in the order of the mesh, φ on the hull and φ' on the lid
    residual : largest residual of the compressed equations, relative to the right-hand sides
    compression : root mean square of the residual of the full equations, relative to their right-hand sides. It
        bounds the error of the potentials. It is at least the tolerance of the blocks, because the few tested rows
        may miss a block with larger errors
    """

    potentials: dict
    residual: float
    compression: float


@lru_cache(maxsize=4)
def tree_of(geometry):
    """`Tree` of a `bem.panels.influence.Geometry`, kept for later frequencies of this geometry"""
    return Tree(geometry)


def solved(geometry, velocities, mirror, table, depth_values, tolerance):
    """`Solution` of the equations of `bem.panels.influence`.

    velocities : {class: (columns, hull nodes)}; tolerance : relative error of the matrices; other arguments as in
    `bem.panels.influence.assembled`
    raises : FloatingPointError if the iteration does not end, or if the error of the compression exceeds `ALLOWED`
    """
    tree, given = tree_of(geometry), {cls: v for cls, v in velocities.items() if len(v)}
    signs = [geometry.signs(cls) for cls, v in given.items() for _ in v]
    on_all = np.zeros((len(tree.nodes), len(signs)), complex)
    on_all[: geometry.hull] = np.concatenate(list(given.values())).T
    columns = Columns(on_all[tree.nodes], np.array(signs).T)
    equations = CompressedEquations(tree, table, mirror, depth_values, columns, tolerance)
    x, left = gmres(equations, Preconditioner(equations), columns, RESIDUAL, ITERATIONS)
    if not left <= 10 * RESIDUAL:  # written so that a NaN raises too
        raise FloatingPointError(
            f"{len(tree.nodes)} compressed equations: a residual of {left:.1e} is left after {ITERATIONS} iterations; "
            f"allowed: {10 * RESIDUAL:g}; give fewer panels (--panels)"
        )
    in_mesh = np.empty_like(x)
    in_mesh[tree.nodes] = x
    ends = np.cumsum([len(v) for v in given.values()])[:-1]
    potentials = dict(zip(given, np.split(in_mesh.T, ends), strict=True))
    left_of_full = _left_of_full(geometry, potentials, given, mirror, table, depth_values)
    compression = float(np.maximum(tolerance, left_of_full))  # of NaN NaN
    if not compression <= ALLOWED:  # written so that a NaN raises too
        raise FloatingPointError(
            f"{len(tree.nodes)} compressed equations have an error of {compression:.1e}; allowed: {ALLOWED:g}; "
            "give fewer panels (--panels)"
        )
    return Solution({cls: potentials.get(cls, np.zeros((0, len(x)))) for cls in velocities}, left, compression)


def _left_of_full(geometry, potentials, velocities, mirror, table, depth_values):
    """Root mean square residual of the full equations, from random rows, relative to their right-hand sides"""
    g, n = geometry, len(geometry.elements.nodes)
    rows = np.sort(np.random.default_rng(SEED).choice(n, min(SAMPLES, n), replace=False))
    squares = {cls: np.zeros((2, len(phi))) for cls, phi in potentials.items()}
    for some in np.array_split(rows, -(-len(rows) // SAMPLES_AT_ONCE)):
        S, D = layers(g, some, list(potentials), mirror, table, depth_values)
        hull = some < g.hull
        side = np.where(hull, -1.0, 1.0)[:, None]
        for i, (cls, phi) in enumerate(potentials.items()):
            right = side * (S[i, :, : g.hull] @ velocities[cls].T)
            left = side * (D[i, :, : g.hull] @ phi[:, : g.hull].T + table.K * S[i, :, g.hull :] @ phi[:, g.hull :].T)
            left += np.where(hull, 2 * np.pi, 4 * np.pi)[:, None] * phi[:, some].T
            for total, part in zip(squares[cls], (left - right, right), strict=True):
                total += np.sum(np.abs(part) ** 2, axis=0)
    return float(np.max([np.sqrt(error / np.maximum(size, 1e-300)).max() for error, size in squares.values()]))
