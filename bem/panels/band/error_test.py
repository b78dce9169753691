"""Whether few nodes stand for all at a frequency: the waves that some nodes send to others, against
`bem.panels.band.low_rank_waves`.

A space that lacks a frequency misses it nearly everywhere, so a few points are enough; and what all nodes send there
is the sum over samples of them, each for as many as it represents.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...kernels.real_times_complex import complex_times_real, real_times_complex


class Samples(NamedTuple):
    """Some of the nodes of hull and lid in place of all, those of the hull first."""

    nodes: np.ndarray  # (s,)
    represented: np.ndarray  # (s,) for how many each stands
    hull: int  # how many of them are on the hull

    @property
    def on_hull(self):
        return self.nodes[: self.hull]

    @property
    def on_lid(self):
        return self.nodes[self.hull :]


class Trial(NamedTuple):
    """w points on the hull, s samples, e of them on the hull; other letters as of the
    `bem.panels.band.low_rank_waves.WaveSpace`.

    What the space loses at the points is, with N of every node found in the same way as M = N V,

        [W − X W Y] φ − [S_w − X S_w N] V v

    in which sums over all nodes are of what is small, so that samples do instead.
    """

    points: np.ndarray  # (w,)
    samples: Samples
    X: np.ndarray  # (w, r) at the points
    Y: np.ndarray  # (q, s) of the samples
    V: np.ndarray  # (c, e, v) at the samples
    N: np.ndarray  # (c, h, e) of the samples
    point_size: np.ndarray  # (w,) √(area) of a point, relative to that of a mean node
    sample_size: np.ndarray  # (e,) of a sample

    @classmethod
    def of(cls, points, samples, X, Y, V, N, root):
        """X (n, r), Y (q, n), V (c, hull nodes, v) of all nodes, N of the samples; root (hull nodes,) m, of areas"""
        sizes, on_hull = root / np.sqrt(np.mean(root**2)), samples.on_hull
        Y = np.ascontiguousarray(Y[:, samples.nodes])
        return cls(points, samples, X[points], Y, V[:, on_hull], N, sizes[points], sizes[on_hull])

    def lost_waves(self, here, held, potentials, given, mine=slice(None)):
        """Largest part of the waves at the points that the space lacks, relative to 2πφ; NaN of NaN

        Arguments as of `missed`.
        """
        size = 2 * np.pi * np.abs(potentials).max(axis=1, keepdims=True)
        missed = self.missed(here, held, potentials, given, mine)
        return float((np.abs(missed) * self.point_size[:, None] / np.maximum(size, 1e-300)).max())

    def missed(self, here, held, potentials, given, mine=slice(None)):
        """(c, w, columns) what the space loses at the points

        here : W (c, w, s) and S_w (c, w, e) from the samples to the points; held : W (c, r, q) and S_w (c, r, h)
        potentials (c, s, columns) φ, and φ' of the lid; given (c, v, columns) v; columns may be zero
        mine : which classes these are
        """
        e, represented = self.samples.hull, self.samples.represented
        W, S = (real_times_complex(self.X, part) for part in held)
        missed = ((here[0] - complex_times_real(W, self.Y)) * represented) @ potentials
        missed -= ((here[1] - complex_times_real(S, self.N[mine])) * represented[:e]) @ real_times_complex(
            self.V[mine], given
        )
        return missed

    def lost_flux(self, flux, crests):
        """Largest part of ∂φ_I/∂n that the space lacks: of the samples on the hull (m, e) and the crests (m, t)"""
        if not len(flux):
            return 0.0
        Z = self.V[0, :, self.V.shape[2] - crests.shape[1] :]
        missed = np.abs(flux - complex_times_real(crests, Z.T)) * self.sample_size
        size = np.maximum(np.abs(flux).max(axis=1), np.abs(crests).max(axis=1))
        return float((missed.max(axis=1) / size).max())
