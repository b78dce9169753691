"""Whether few nodes stand for all at a frequency: the waves that some nodes send to others, against `bem.wave_space`.

A space that lacks a frequency misses it nearly everywhere, so a few points are enough; and what all nodes send there
is the sum over samples of them, each for as many as it represents.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .mixed_products import acted, times


class Samples(NamedTuple):
    """Some of the nodes of hull and lid in place of all, those of the hull first."""

    nodes: np.ndarray  # (s,)
    represented: np.ndarray  # (s,) for how many each stands
    hull: int  # how many of them are on the hull

    @property
    def on_hull(self):
        return self.nodes[: self.hull]


class Trial(NamedTuple):
    """w points on the hull, s samples; r points, q sources and t crests of the `bem.wave_space.WaveSpace` tested."""

    points: np.ndarray  # (w,)
    samples: Samples
    X: np.ndarray  # (w, r) at the points
    Y: np.ndarray  # (q, s) of the samples
    Z: np.ndarray  # (s, t) of the samples on the hull
    point_size: np.ndarray  # (w,) √(area) of a point, relative to that of a mean node
    sample_size: np.ndarray  # (s,) of a sample on the hull

    @classmethod
    def of(cls, points, samples, X, Y, Z, root):
        """X (n, r), Y (q, n), Z (hull nodes, t) of all nodes; root (hull nodes,) m, of their areas"""
        sizes, on_hull = root / np.sqrt(np.mean(root**2)), samples.on_hull
        Y = np.ascontiguousarray(Y[:, samples.nodes])
        return cls(points, samples, X[points], Y, Z[on_hull], sizes[points], sizes[on_hull])

    def lost_waves(self, between, W, potentials):
        """Largest part of the waves at the points that the space lacks, relative to 2πφ; NaN of NaN

        between (c, w, s) : W from the samples to the points; W (c, r, q); potentials (c, s, columns) φ, and φ' of the
        lid, of which columns may be zero
        """
        missed = ((between - acted(times(self.X, W), self.Y)) * self.samples.represented) @ potentials
        size = 2 * np.pi * np.abs(potentials).max(axis=1, keepdims=True)
        return float((np.abs(missed) * self.point_size[:, None] / np.maximum(size, 1e-300)).max())

    def lost_flux(self, flux, crests):
        """Largest part of ∂φ_I/∂n that the space lacks: of the samples on the hull (m, s) and the crests (m, t)"""
        missed = np.abs(flux - acted(crests, self.Z.T)) * self.sample_size
        return float((missed.max(axis=1) / np.abs(flux).max(axis=1)).max(initial=0.0))
