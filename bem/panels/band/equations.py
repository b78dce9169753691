"""The integral equations of a band of frequencies, with waves between few nodes only.

With f on the hull and g on the lid the equations of `bem.panels.influence`, those of the lid with the other sign, are

    2πφ − D₀φ − K S₀φ' = f,    −4πφ' − K S₀φ' − D₀φ = g,    (f, g) = X m − S₀V v
    m = W[points, sources] α − S_w[points, monopoles] M v,    α = Y (φ, φ')

of which only W and S_w are of the frequency, and complex (`bem.panels.band.low_rank_waves`).  2π − D₀ is factored
once for each
symmetry class; with T = S₀ + D₀ (2π − D₀)⁻¹ S₀ on the lid, K φ' = −(4π/K + T)⁻¹ (g + D₀ (2π − D₀)⁻¹ f) is real
algebra of the size of the lid, and what remains is a complex system of the size of the space (Sherman, Morrison &
Woodbury).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...checks import ERROR_ORDER
from ...kernels.progress import FACTORS, MATRICES, report_progress
from ..wave_influence import Pairs
from .low_rank_waves import wave_space

ROWS = 128  # of the matrices made at once: with twice as many 4 000 panels took 65 MB more, and as long


class Reduced(NamedTuple):
    """The space of a band of frequencies, and what each symmetry class makes of it.

    c classes, n hull nodes, l lid nodes, r points, q sources, v given normal velocities, u = r + v + l, e samples on
    the hull
    """

    geometry: object  # with or without lid
    accuracy: float
    space: object  # `WaveSpace`
    response: np.ndarray  # (c, n, u) (2π − D₀)⁻¹ [X, S₀V, S₀ of the lid]
    at_samples: np.ndarray  # (c, e, u) of it, at the samples of `bem.panels.band.error_test`
    integrals: np.ndarray  # (c, v, u) ∬ V times it dS over the whole hull
    at_sources: np.ndarray  # (c, q, u) Y of it
    on_lid: np.ndarray  # (c, l, u) D₀ of it on the lid, plus [X, S₀V, S₀] there: the last part is T
    from_lid: np.ndarray  # (q, l) Y of the lid
    pairs: object  # `bem.panels.wave_influence.Pairs` of points and sources
    trial_pairs: object  # and of those of `bem.panels.band.error_test`

    @classmethod
    def empty(cls, geometry, accuracy, space):
        """With room for what the classes make of it"""
        c, n, v = space.velocities.shape
        lid, (q, _) = len(geometry.elements.nodes) - n, space.Y.shape
        u = len(space.points) + v + lid
        rooms = (np.empty((c, rows, u)) for rows in (n, space.trial.samples.hull, v, q, lid))
        from_lid, trial = np.ascontiguousarray(space.Y[:, n:]), space.trial
        pairs = Pairs.of(geometry, space.points, space.sources)
        trial_pairs = Pairs.of(geometry, trial.points, trial.samples.nodes)
        return cls(geometry, accuracy, space, *rooms, from_lid, pairs, trial_pairs)

    def fill(self, i, factors, on_lid, sides):
        """Class number i from the factored 2π − D₀; on_lid and sides as of `_exact`, of the larger geometry"""
        from scipy.linalg import lu_solve

        space, n, lid = self.space, self.geometry.hull, self.on_lid.shape[1]
        columns = sides.shape[1] - (len(on_lid) - lid)
        known = np.concatenate([space.X, sides[: n + lid, :columns]], axis=1)
        response = self.response[i] = lu_solve(factors, known[:n], trans=1, check_finite=False)
        if not np.all(np.isfinite(response)):
            raise FloatingPointError(f"class {i} of the mesh: the equations of the hull have no finite solution")
        areas = self.geometry.elements.weights[:n, None] * self.geometry.copies
        self.at_samples[i] = response[space.trial.samples.on_hull]
        self.integrals[i] = (space.velocities[i] * areas).T @ response
        self.at_sources[i] = space.Y[:, :n] @ response
        self.on_lid[i] = on_lid[:lid] @ response + known[n:]


def sufficient_accuracy(panels):
    """A twentieth of the error that so many panels leave (`bem.checks.ERROR_ORDER`, one per cent at 250)"""
    return float(np.clip(0.05 * 0.01 * (250 / panels) ** ERROR_ORDER, 2e-5, 1e-4))


def reduced(geometry, band, gravity, accuracy):
    """`Reduced` equations of a `bem.panels.influence.Geometry` for frequencies band = (low, high) rad/s.

    returns : one, or two of the frequencies without and with the lid, which share the exact part
    """
    parts = parted(geometry, band, gravity)
    spaces = [wave_space(g, part, gravity, accuracy) for g, part in parts]
    out = [Reduced.empty(g, accuracy, space) for (g, _), space in zip(parts, spaces, strict=True)]
    velocities = np.concatenate([space.velocities for space in spaces], axis=2)
    matrices, on_lid, sides = _exact(parts[-1][0], velocities)
    for i, side in enumerate(sides):
        factors = _factored(matrices.pop(0))
        before = 0
        for part in out:
            count = part.space.velocities.shape[2]
            mine = np.r_[before : before + count, velocities.shape[2] : side.shape[1]]
            part.fill(i, factors, on_lid[i], side[:, mine])
            before += count
        report_progress(FACTORS, 1)
    return tuple(out)


def parted(geometry, band, gravity):
    """[(geometry without lid, frequencies below those that need one), (geometry, the others)], without empty parts"""
    low, high = band
    border = float(np.sqrt(geometry.lid_from * gravity))
    lower, upper = (geometry.without_lid, (low, min(high, border))), (geometry, (max(low, border), high))
    return [part for part, there in ((lower, low <= border), (upper, border < high)) if there]


def _exact(geometry, velocities):
    """Lists over the classes: 2π − D₀ (n, n), D₀ of the lid (l, n), [S₀V, S₀ of the lid] (n + l, v + l)"""
    g, n = geometry, geometry.hull
    nodes = g.elements.nodes
    lid = len(nodes) - n
    matrices = [np.empty((n, n)) for _ in velocities]
    on_lid = [np.empty((lid, n)) for _ in velocities]
    sides = [np.empty((n + lid, v.shape[1] + lid)) for v in velocities]
    for start in range(0, n + lid, ROWS):
        stop = min(start + ROWS, n + lid)
        s, d, _, _ = g.rankine_rows(nodes[start:stop])
        hull = max(min(stop, n) - start, 0)
        for i, v in enumerate(velocities):
            np.negative(d[i, :hull, :n], out=matrices[i][start : start + hull])
            on_lid[i][max(start - n, 0) : max(stop - n, 0)] = d[i, hull:, :n]
            sides[i][start:stop, : v.shape[1]] = s[i, :, :n] @ v
            sides[i][start:stop, v.shape[1] :] = s[i, :, n:]
        report_progress(MATRICES, stop - start)
    for A in matrices:
        A.flat[:: n + 1] += 2 * np.pi
    return matrices, on_lid, sides


def _factored(matrix):
    from scipy.linalg import lu_factor

    # LAPACK wants columns: the transposed view is factored in place and solved transposed
    return lu_factor(matrix.T, overwrite_a=True, check_finite=False)
