"""Sums over evanescent modes, in which the maps of the plan are interpolated from a table in κ.

The maps N(κ) of a plan from normal velocity to potential are smooth in log κ and tend to ∓1/κ.  With
M(κ) = κN(κ) known at Chebyshev nodes of log κ, M = Σ ℓ_c(κ) M_c, a sum over the modes becomes one over the nodes,

    Σₙ wᵢₙ wⱼₙ N(kₙ) = Σ_c [Σₙ wᵢₙ wⱼₙ ℓ_c(kₙ) / kₙ] M_c ,

so the cost hardly depends on the number of modes.  Beyond the last node M = ∓1 + a/κ + b/κ², where a and b follow
from value and slope of M at the last node.
"""

from dataclasses import dataclass

import numpy as np

from ..depth_modes.gap import tail_weights


@dataclass(frozen=True)
class ChebyshevNodes:
    """`count` Chebyshev nodes of log κ, increasing from `first` to `last` rad/m; the limit κ → ∞ is an additional
    node."""

    first: float
    last: float
    count: int

    @property
    def kappa(self):
        """Decay rates κ of the evanescent modes, rad/m; shape (count,)"""
        return np.exp(np.log(self.first * self.last) / 2 + np.log(self.last / self.first) / 2 * self._points)

    @property
    def _points(self):
        return -np.cos(np.pi * np.arange(self.count) / (self.count - 1))

    def weights(self, k):
        """ℓ_c(k) in barycentric form (Berrut and Trefethen 2004); shape (k, count + 1); the last column is the node κ
        → ∞"""
        x = np.log(np.minimum(k, self.last) ** 2 / (self.first * self.last)) / np.log(self.last / self.first)
        distance = np.subtract.outer(x, self._points)
        hit = distance == 0
        table = self._signs / np.where(hit, 1.0, distance)
        table = np.where(hit.any(axis=1)[:, None], hit, table)
        table /= table.sum(axis=1, keepdims=True)
        beyond = np.minimum(self.last / k, 1.0)
        linear, square = 2 * beyond - beyond**2, beyond**2 - beyond
        table = table * linear[:, None] - np.multiply.outer(square, self._last_slope)
        return np.column_stack([table, (1 - beyond) ** 2])

    @property
    def _signs(self):
        signs = (-1.0) ** np.arange(self.count)
        signs[[0, -1]] /= 2
        return signs

    @property
    def _last_slope(self):
        """Weights of dM/d log κ at the last node; shape (count,)"""
        x, w = self._points, self._signs
        slope = np.append(w[:-1] / w[-1] / (x[-1] - x[:-1]), 0.0)
        slope[-1] = -slope.sum()
        return slope * 2 / np.log(self.last / self.first)


def contracted(rows, decays, factors, table):
    """Σₙ rowsᵢₙ rowsⱼₙ factorsₙ tableₙ to infinity, (r, r, c).

    rows : terms that fall like n^(−decay) times oscillations, (r, n); factors : terms that fall like 1/n, (n,); table
        : (n, c)
    """
    i, j = np.triu_indices(len(rows))
    powers = np.round(1 + decays[i] + decays[j], 12)
    products = rows[i] * rows[j]
    for power in np.unique(powers):
        products[powers == power] *= factors * tail_weights(rows.shape[1], float(power))
    total = np.empty((len(rows), len(rows), table.shape[1]))
    total[i, j] = total[j, i] = products @ table
    return total
