"""Long-term distribution of a response over all sea states of a climate.

    N(x) = Σ_s p_s ν_s exp(−x²/2σ_s²)     upward crossings of the level x per second
    Q(x) = N(x) / N(0)                    share of all maxima above x
    P(largest in a time t < x) = exp(−t N(x))

p_s is the share of time of the state s (height, period, direction); σ_s = √m₀ and ν_s = 1/T_zero are those of the
response in this state. Maxima are those of a narrow spectrum. For wide spectra Q is then conservative; N is exact
for high x.
"""

from typing import NamedTuple

import numpy as np

YEAR = 365.25 * 86400.0  # s
TINY = 1e-300  # crossings: exp(−x²/2σ²) of a small state may underflow


class LongTerm(NamedTuple):
    """Standard deviation (s,), mean zero-crossing frequency (s,) Hz and share of time (s,) of every sea state."""

    sigma: np.ndarray
    rate: np.ndarray
    probability: np.ndarray

    def crossing_rate(self, x):
        """Upward crossings of x per second; shape (…,)"""
        x = np.asarray(x, float)[..., None]
        sigma = np.where(self.sigma > 0, self.sigma, 1.0)
        return np.sum(np.where(self.sigma > 0, self.probability * self.rate, 0.0) * np.exp(-0.5 * (x / sigma) ** 2), -1)

    def level(self, time):
        """Value exceeded once on average in `time` s. Raises ValueError if all states together have no crossings
        that rare.
        """
        from scipy.optimize import brentq

        cycles = self.crossing_rate(0.0) * time
        if not 1 < cycles < np.inf:
            raise ValueError(f"a time of {time:.3g} s contains {cycles:.3g} cycles; allowed: more than 1, finite")
        largest = self.sigma[self.probability > 0].max()
        high = largest * np.sqrt(2 * np.log(cycles)) + largest
        return brentq(lambda x: np.log(max(self.crossing_rate(x) * time, TINY)), 0.0, high, xtol=1e-12 * high)

    def not_exceeded(self, x, time):
        """Probability that the largest value in `time`, s, is below x, for independent crossings; shape (…,)"""
        return np.exp(-time * self.crossing_rate(x))


def long_term(m0, m2, probability) -> LongTerm:
    """The LongTerm of responses with moments m0, m2 (s,) in sea states with shares `probability` (s,) of the time.

    The shares may sum to less than 1; the rest of the time is calm. Raises ValueError for a sum above 1 or a negative
    share.
    """
    m0, m2, p = (np.asarray(v, float).ravel() for v in (m0, m2, probability))
    if not len(m0) == len(m2) == len(p) > 0:
        raise ValueError(
            f"moments and shares have {len(m0)}, {len(m2)}, {len(p)} values; allowed: one of each per state"
        )
    if np.any(p < 0) or p.sum() > 1 + 1e-6:
        raise ValueError(f"shares of time sum to {p.sum():.6g}, least {p.min():.3g}; allowed: at least 0, sum up to 1")
    if not np.any((m0 > 0) & (p > 0)):
        raise ValueError("the response is zero in every sea state")
    rate = np.sqrt(m2 / np.where(m0 > 0, m0, 1.0)) / (2 * np.pi)
    return LongTerm(np.sqrt(m0), rate, p)
