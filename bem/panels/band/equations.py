"""Integral equations of a band of frequencies, with a Rankine part common to all and low-rank wave matrices.

The equations are those of `bem.panels.influence`, with the equations of the lid multiplied by −1. S₀ and D₀ are the
Rankine part of S and D; W, S_w are the wave part in the low-rank form of `bem.panels.band.low_rank_waves`. With f on
the hull and g on the lid they are

    2πφ − D₀φ − K S₀φ' = f,    −4πφ' − K S₀φ' − D₀φ = g,    (f, g) = X m − S₀V v
    m = W[points, sources] α − S_w[points, monopoles] M v,    α = Y (φ, φ')

Only K and the complex W and S_w depend on the frequency.  2π − D₀ is factored once for each symmetry class.  On the lid
the Schur complement, with T = S₀ + D₀ (2π − D₀)⁻¹ S₀,

    K φ' = −(4π/K + T)⁻¹ (g + D₀ (2π − D₀)⁻¹ f)

is a real system of the size of the lid; eliminating φ by the Woodbury identity leaves a complex system for m, of the
rank of W.
"""

from typing import NamedTuple

import numpy as np

from ...kernels.progress import FACTORS, MATRICES, report_progress
from ..wave_influence import Pairs
from .low_rank_waves import low_rank_waves

# rows of the Rankine matrices in one block; twice as many need 65 MB more at 4 000 panels, without gain in time
ROWS = 128


class BandEquations(NamedTuple):
    """Solutions of the equations for unit right-hand sides, which do not depend on frequency.

    c classes, n hull nodes, l lid nodes, r points, q sources, v normal velocities, e samples on the hull; u = r + v + l
    unit columns: of m, of −v and of Kφ'
    """

    geometry: object  # `Geometry`, with or without lid
    accuracy: float
    low_rank: object  # `bem.panels.band.low_rank_waves.LowRankWaves`
    unit_potentials: np.ndarray  # (c, n, u) φ of the unit columns, (2π − D₀)⁻¹ [X, S₀V, S₀ of the lid]
    potentials_at_samples: np.ndarray  # (c, e, u) the same at the samples of `bem.panels.band.error_test`
    integrals: np.ndarray  # (c, v, u) ∬ V φ dS over the whole hull
    at_sources: np.ndarray  # (c, q, u) Y φ
    on_lid: np.ndarray  # (c, l, u) D₀φ + [X, S₀V, S₀] on the lid; the last l columns are T
    from_lid: np.ndarray  # (q, l) Y of the lid nodes
    pairs: object  # `bem.panels.wave_influence.Pairs` of points and sources
    test_pairs: object  # pairs of the test points and samples in `bem.panels.band.error_test`

    @classmethod
    def empty(cls, geometry, accuracy, low_rank):
        """Equations with empty arrays, which `solve_class` fills"""
        c, n, v = low_rank.velocities.shape
        lid, (q, _) = len(geometry.elements.nodes) - n, low_rank.Y.shape
        u = len(low_rank.points) + v + lid
        arrays = (np.empty((c, rows, u)) for rows in (n, low_rank.error_test.samples.hull, v, q, lid))
        from_lid, error_test = np.ascontiguousarray(low_rank.Y[:, n:]), low_rank.error_test
        pairs = Pairs.of(geometry, low_rank.points, low_rank.sources)
        test_pairs = Pairs.of(geometry, error_test.points, error_test.samples.nodes)
        return cls(geometry, accuracy, low_rank, *arrays, from_lid, pairs, test_pairs)

    def solve_class(self, i, factors, on_lid, sides):
        """Fill the arrays of class i; factors : LU of 2π − D₀; on_lid, sides : from `_rankine_equations`"""
        from scipy.linalg import lu_solve

        low_rank, n, lid = self.low_rank, self.geometry.hull, self.on_lid.shape[1]
        columns = sides.shape[1] - (len(on_lid) - lid)
        known = np.concatenate([low_rank.X, sides[: n + lid, :columns]], axis=1)
        unit_potentials = self.unit_potentials[i] = lu_solve(factors, known[:n], trans=1, check_finite=False)
        if not np.all(np.isfinite(unit_potentials)):
            raise FloatingPointError(f"the equations of the hull (symmetry class {i}) have no finite solution")
        areas = self.geometry.elements.weights[:n, None] * self.geometry.copies
        self.potentials_at_samples[i] = unit_potentials[low_rank.error_test.samples.on_hull]
        self.integrals[i] = (low_rank.velocities[i] * areas).T @ unit_potentials
        self.at_sources[i] = low_rank.Y[:, :n] @ unit_potentials
        self.on_lid[i] = on_lid[:lid] @ unit_potentials + known[n:]


def band_equations(geometry, band, gravity, accuracy):
    """Tuple of `BandEquations` of a `bem.panels.influence.Geometry` for frequencies band = (low, high) rad/s.

    accuracy : relative accuracy of the low-rank wave matrices
    returns : one element, or two for the frequencies without and with the lid, which share the Rankine matrices
    raises : FloatingPointError if the Rankine matrices are singular
    """
    parts = split_by_lid(geometry, band, gravity)
    bases = [low_rank_waves(g, part, gravity, accuracy) for g, part in parts]
    out = [BandEquations.empty(g, accuracy, low_rank) for (g, _), low_rank in zip(parts, bases, strict=True)]
    velocities = np.concatenate([low_rank.velocities for low_rank in bases], axis=2)
    matrices, on_lid, sides = _rankine_equations(parts[-1][0], velocities)
    for i, side in enumerate(sides):
        factors = _factored(matrices.pop(0))
        before = 0
        for part in out:
            count = part.low_rank.velocities.shape[2]
            own = np.r_[before : before + count, velocities.shape[2] : side.shape[1]]
            part.solve_class(i, factors, on_lid[i], side[:, own])
            before += count
        report_progress(FACTORS, 1)
    return tuple(out)


def split_by_lid(geometry, band, gravity):
    """[(geometry without lid, frequencies below those that need a lid), (geometry, the other frequencies)], without
    empty parts"""
    low, high = band
    border = float(np.sqrt(geometry.lid_from * gravity))
    lower, upper = (geometry.without_lid, (low, min(high, border))), (geometry, (max(low, border), high))
    return [part for part, there in ((lower, low <= border), (upper, border < high)) if there]


def _rankine_equations(geometry, velocities):
    """Lists over the classes: 2π − D₀ (n, n), D₀ on the lid (l, n), [S₀V, S₀ of the lid] (n + l, v + l)"""
    g, n = geometry, geometry.hull
    nodes = g.elements.nodes
    lid = len(nodes) - n
    matrices = [np.empty((n, n)) for _ in velocities]
    on_lid = [np.empty((lid, n)) for _ in velocities]
    sides = [np.empty((n + lid, v.shape[1] + lid)) for v in velocities]
    for start in range(0, n + lid, ROWS):
        end = min(start + ROWS, n + lid)
        s, d, _, _ = g.rankine_rows(nodes[start:end])
        hull = max(min(end, n) - start, 0)
        for i, v in enumerate(velocities):
            np.negative(d[i, :hull, :n], out=matrices[i][start : start + hull])
            on_lid[i][max(start - n, 0) : max(end - n, 0)] = d[i, hull:, :n]
            sides[i][start:end, : v.shape[1]] = s[i, :, :n] @ v
            sides[i][start:end, v.shape[1] :] = s[i, :, n:]
        report_progress(MATRICES, end - start)
    for A in matrices:
        A.flat[:: n + 1] += 2 * np.pi
    return matrices, on_lid, sides


def _factored(matrix):
    from scipy.linalg import lu_factor

    # LAPACK needs columns: the transposed view is factored in place and solved transposed
    return lu_factor(matrix.T, overwrite_a=True, check_finite=False)
