"""Utilisation of a limit in every hour, from states simulated with a few seeds each: a Gaussian process with noise.

    y = ln used = a + b ln H + f(x) + e,    f ~ GP(0, c² Matérn₅⸝₂(x/ℓ)),    e ~ N(0, σ²)

σ is the scatter of seeds in one sea, pooled over the states. It represents the randomness of the sea and is not an
error. In an hour the operation stops with the probability

    P = Φ(μ / √(σ² + s²))

where s is the error of the interpolated μ. The effect of this error on the sum of all probabilities is found from
joint draws of f at the undecided hours. The Gaussian process is that of scikit-learn, with lengths ℓ by maximum
likelihood.
"""

import warnings
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr

AT_ONCE = 20_000  # hours of a prediction
OPEN = 1e-3  # probability of an hour above which its verdict may change
DRAWS, PLACES, SEED = 200, 600, 58
LEAST = 1e-6  # smallest response considered, over the limit
MISSING = "simulated states need scikit-learn; install it by: pip install 'hakobune[downtime]'"


@dataclass(frozen=True, eq=False)
class Interpolant:
    """process : `GaussianProcessRegressor` fitted to the deviation from the trend; trend : a, b; scatter : σ"""

    process: object
    trend: np.ndarray
    scatter: float

    def predict(self, x, height):
        """Mean μ and error s, each (n,), at features x (n, d) of seas of height (n,) m"""
        parts = [self.process.predict(x[i : i + AT_ONCE], return_std=True) for i in range(0, len(x), AT_ONCE)]
        mean, error = (np.concatenate(part) for part in zip(*parts, strict=True))
        return mean + _trend(height) @ self.trend, error

    def chance(self, mean, error):
        """Probability P (n,) of hours with μ, s"""
        return ndtr(mean / np.sqrt(self.scatter**2 + error**2 + LEAST**2))

    def spread_of_sum(self, x, height, mean, error, free):
        """Two standard deviations of Σ P over hours: due to the interpolant alone, and due to the randomness of the
        sea alone.

        free : (n,) whether no other limit stops the hour
        """
        chance = self.chance(mean, error)
        sea = float(np.sqrt(np.sum((chance * (1 - chance))[free])))
        rows = np.flatnonzero(free & (chance > OPEN) & (chance < 1 - OPEN))
        if not len(rows):
            return 0.0, sea
        rng = np.random.default_rng(SEED)
        weight = len(rows) / min(len(rows), PLACES)
        rows = np.sort(rng.choice(rows, min(len(rows), PLACES), replace=False))
        drawn = self.process.sample_y(x[rows], DRAWS, random_state=SEED)
        drawn += (_trend(height[rows]) @ self.trend)[:, None]
        sums = ndtr(drawn / max(self.scatter, 1e-3)).sum(axis=0) * weight
        return float(sums.std()), sea


def fitted(x, height, used):
    """The Interpolant of states with features x (s, d), height (s,) m and the utilisation (s, seeds) of a limit by each
    seed

    raises : ImportError without scikit-learn
    """
    try:
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import ConstantKernel, Matern
        from threadpoolctl import threadpool_limits
    except ImportError:
        raise ImportError(MISSING) from None
    y = np.log(np.maximum(used, LEAST))
    seeds = y.shape[1]
    scatter = float(np.sqrt(y.var(axis=1, ddof=1).mean())) if seeds > 1 else 0.0
    middle = y.mean(axis=1)
    trend = np.linalg.lstsq(_trend(height), middle, rcond=None)[0]
    left = middle - _trend(height) @ trend
    size = max(float(left.var()), 1e-4)
    kernel = ConstantKernel(size, (1e-3 * size, 1e3 * size)) * Matern(np.full(x.shape[1], 0.5), (0.05, 20.0), nu=2.5)
    process = GaussianProcessRegressor(kernel, alpha=scatter**2 / seeds + 1e-6 * size, n_restarts_optimizer=1,
                                       random_state=SEED)  # fmt: skip
    with warnings.catch_warnings(), threadpool_limits(1):  # matrices so small that threads would wait for each other
        warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its bound belongs to a feature without effect
        process.fit(x, left)
    return Interpolant(process, trend, scatter)


def where_it_may_change(x, mean, error, scatter, free, count, taken):
    """Numbers (at most count) of the hours at which a further state would change the verdicts most; no two are close
    together

    taken : (s, d) features of the existing states
    """
    total = np.sqrt(scatter**2 + error**2 + LEAST**2)
    gain = np.where(free, error * np.exp(-0.5 * (mean / total) ** 2) / total, 0.0)
    gain *= np.sqrt(_nearest(x, taken))
    chosen = []
    for _ in range(count):
        best = int(np.argmax(gain))
        if not gain[best] > 0:
            break
        chosen.append(best)
        gain *= 1 - np.exp(-np.sum((x - x[best]) ** 2, axis=1) / 0.02)
    return np.array(chosen, int)


def _nearest(x, taken):
    """Squared distance to the nearest of states; shape (n,)"""
    nearest = np.full(len(x), np.inf)
    for one in taken:
        nearest = np.minimum(nearest, np.sum((x - one) ** 2, axis=1))
    return nearest


def _trend(height):
    return np.stack([np.ones(len(height)), np.log(np.maximum(height, 0.05))], axis=1)
