"""Error of the low-rank wave matrices at a solved frequency, estimated at a few test points.

If the basis of `bem.panels.band.low_rank_waves` does not represent a frequency, the matrices are wrong nearly
everywhere. A few test points are therefore enough. At a test point the error is a sum over all nodes. This sum is
estimated from random samples of the nodes; each sample is weighted with the inverse of its probability.
"""

from typing import NamedTuple

import numpy as np

from ...algebra.real_times_complex import complex_times_real, real_times_complex


class Samples(NamedTuple):
    """s random nodes of hull and lid, the nodes of the hull first."""

    nodes: np.ndarray  # (s,) numbers
    weights: np.ndarray  # (s,) 1/probability: a sum over all nodes is estimated by the weighted sum over samples
    hull: int  # number of them on the hull

    @property
    def on_hull(self):
        return self.nodes[: self.hull]

    @property
    def on_lid(self):
        return self.nodes[self.hull :]


class ErrorTest(NamedTuple):
    """Error test with w test points on the hull and s samples, e of them on the hull; other letters as in
    `bem.panels.band.low_rank_waves.LowRankWaves`.

    The error of the wave potentials at the test points is

        [W − X W Y] φ − [S_w − X S_w N] V v

    with the second W and S_w, to the right of X, at the interpolation nodes. N has the columns of all nodes, so that
    M = N V.
    """

    points: np.ndarray  # (w,)
    samples: Samples
    X: np.ndarray  # (w, r) at the test points
    Y: np.ndarray  # (q, s) of the samples
    V: np.ndarray  # (c, e, v) at the samples
    N: np.ndarray  # (c, h, e) of the samples
    point_size: np.ndarray  # (w,) √(area) of a test point, relative to that of a mean node
    sample_size: np.ndarray  # (e,) of a sample

    @classmethod
    def of(cls, points, samples, X, Y, V, N, root):
        """X (n, r), Y (q, n) and V (c, hull nodes, v) are those of all nodes, N is that of the samples

        root : square roots of the areas of the hull nodes, m, (hull nodes,)"""
        sizes, on_hull = root / np.sqrt(np.mean(root**2)), samples.on_hull
        Y = np.ascontiguousarray(Y[:, samples.nodes])
        return cls(points, samples, X[points], Y, V[:, on_hull], N, sizes[points], sizes[on_hull])

    def wave_error(self, exact, low_rank, potentials, velocity, classes=slice(None)):
        """Largest error of the wave potentials at the test points relative to 2πφ; NaN if a potential is NaN

        Arguments as in `errors`.
        """
        size = 2 * np.pi * np.abs(potentials).max(axis=1, keepdims=True)
        errors = self.errors(exact, low_rank, potentials, velocity, classes)
        return float((np.abs(errors) * self.point_size[:, None] / np.maximum(size, 1e-300)).max())

    def errors(self, exact, low_rank, potentials, velocity, classes=slice(None)):
        """Errors of the wave potentials at the test points; shape (c, w, columns)

        exact : W (c, w, s) and S_w (c, w, e) from the samples to the test points
        low_rank : W (c, r, q) and S_w (c, r, h) between the interpolation nodes
        potentials : φ, and φ' on the lid, (c, s, columns); velocity : v, (c, v, columns); columns may be zero
        classes : indices of these c classes among all classes
        """
        e, weights = self.samples.hull, self.samples.weights
        W, S = (real_times_complex(self.X, part) for part in low_rank)
        errors = ((exact[0] - complex_times_real(W, self.Y)) * weights) @ potentials
        by_velocity = real_times_complex(self.V[classes], velocity)
        errors -= ((exact[1] - complex_times_real(S, self.N[classes])) * weights[:e]) @ by_velocity
        return errors

    def flux_error(self, flux, at_flux_nodes):
        """Largest error of ∂φ_I/∂n at the samples, relative to the largest |∂φ_I/∂n| of the same wave

        flux : ∂φ_I/∂n at the samples on the hull, (m, e); at_flux_nodes : ∂φ_I/∂n at the interpolation nodes, (m, t)
        """
        if not len(flux):
            return 0.0
        Z = self.V[0, :, self.V.shape[2] - at_flux_nodes.shape[1] :]
        errors = np.abs(flux - complex_times_real(at_flux_nodes, Z.T)) * self.sample_size
        size = np.maximum(np.abs(flux).max(axis=1), np.abs(at_flux_nodes).max(axis=1))
        return float((errors.max(axis=1) / size).max())
