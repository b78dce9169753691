"""Statistics of maxima of a Gaussian response of any bandwidth, and of the peaks of a record.

A process with moments m₀, m₂, m₄ has maxima x = ησ of density (Cartwright and Longuet-Higgins 1956)

    Q(η) = P(maximum > η) = Φ(−η/ε) + √(1−ε²) exp(−η²/2) Φ(η√(1−ε²)/ε),    ε² = 1 − m₂²/m₀m₄ = 1 − (T_pp/T_zero)²

with T_zero = 2π√(m₀/m₂) between upward zero crossings and T_pp = 2π√(m₂/m₄) between maxima.  ε = 0 is Rayleigh's
distribution, ε = 1 the normal one.  SR179 report (1982), eqs 3.5.1.3 to 3.5.1.6:

    X̄_1/3 = C(ε) σ,    X_max = σ {s + γ_E/s},  s = √(2 ln(n√(1−ε²))),  n = duration / T_pp,  γ_E = 0.5772

n√(1−ε²) is the number of zero crossings, so X_max needs no fourth moment.  All values are amplitudes, not heights.
"""

import numpy as np

EULER = 0.5772156649015329
LEAST, HIGHEST = -10.0, 40.0  # standard deviations; values beyond have no weight
PANELS = 51  # Gauss panels between the limits
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


def bandwidth(m0, m2, m4):
    """ε from moments; 0 for one frequency.  Raises ValueError for moments that no spectrum has."""
    m0, m2, m4 = (np.asarray(m, float) for m in (m0, m2, m4))
    if np.any(m0 <= 0) or np.any(m2 <= 0) or np.any(m2**2 > m0 * m4 * (1 + 1e-9)):
        raise ValueError(
            "the moments m0, m2 and m4 do not belong to a spectrum; allowed: above 0, with m2² at most m0 m4"
        )
    return np.sqrt(np.maximum(1 - m2**2 / (m0 * m4), 0.0))


def exceedance(eta, epsilon):
    """Probability that a maximum is above η standard deviations; both broadcast."""
    from scipy.special import ndtr

    eta, eps = np.asarray(eta, float), _checked_bandwidth(epsilon)
    narrow, safe = np.sqrt(1 - eps**2), np.maximum(eps, 1e-12)
    return ndtr(-eta / safe) + narrow * np.exp(-0.5 * eta**2) * ndtr(eta * narrow / safe)


def mean_of_highest(share, epsilon):
    """Mean of the highest fraction `share` of all maxima, in standard deviations: C(ε) for a third, the mean of all
    maxima for 1.

    η₀ + (1/p) ∫ Q dη above η₀, where Q(η₀) = p.
    """
    if not 0 < share <= 1:
        raise ValueError(f"share of the maxima is {share:g}; allowed: above 0, at most 1")
    eps = float(_checked_bandwidth(epsilon))
    low, high = LEAST, HIGHEST
    while share < 1 and high - low > 1e-13 * HIGHEST:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if exceedance(middle, eps) > share else (low, middle)
    # Q bends within a few ε of 0; it is analytic elsewhere
    edges = np.union1d(np.linspace(low, HIGHEST, PANELS), eps * np.array([-8, -4, -2, -1, 0, 1, 2, 4, 8]))
    edges = edges[edges >= low]
    half, middle = 0.5 * np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    above = half @ (exceedance(middle[:, None] + half[:, None] * NODES, eps) @ WEIGHTS)
    return low + above / share


def significant_factor(epsilon):
    """C(ε), mean of the highest third of the maxima over the standard deviation; 2.00 for a narrow spectrum"""
    return mean_of_highest(1 / 3, epsilon)


def crossings(duration, zero_crossing):
    """Number of upward zero crossings in `duration` s, n√(1−ε²); ValueError where it is too small for an extreme."""
    count = np.asarray(duration, float) / zero_crossing
    if np.any(~(count > np.e)):
        raise ValueError(f"the duration contains {np.min(count):.3g} zero crossings; allowed: above 3")
    return count


def expected_maximum(sigma, duration, zero_crossing):
    """Mean of the largest value in `duration` s, eq. 3.5.1.5; `zero_crossing` is the mean period T_zero, s."""
    s = np.sqrt(2 * np.log(crossings(duration, zero_crossing)))
    return sigma * (s + EULER / s)


def maximum_not_exceeded(sigma, duration, zero_crossing, probability):
    """Value not exceeded by the largest in `duration` s with `probability`: exp(−N exp(−x²/2σ²)) = p."""
    p = np.asarray(probability, float)
    if np.any(~((p > 0) & (p < 1))):
        raise ValueError(f"probability is {probability}; allowed: between 0 and 1")
    return sigma * np.sqrt(2 * np.log(np.maximum(crossings(duration, zero_crossing) / -np.log(p), 1.0)))


def record_peaks(record):
    """Largest value between successive upward crossings of the mean, less the mean; shape (n,)

    `mooring.site.extremes.fit_extremes` fits Weibull's law to them.
    """
    record = np.asarray(record, float)
    if record.ndim != 1 or not np.all(np.isfinite(record)):
        raise ValueError("a record has to be a one-dimensional array of finite numbers")
    y = record - record.mean()
    up = np.flatnonzero((y[:-1] <= 0) & (y[1:] > 0)) + 1
    if len(up) < 2:
        raise ValueError(f"the record has {len(up)} upward crossings of its mean; allowed: at least 2")
    return np.maximum.reduceat(y[: up[-1]], up[:-1])


def _checked_bandwidth(epsilon):
    eps = np.asarray(epsilon, float)
    if np.any(~((eps >= 0) & (eps <= 1))):
        raise ValueError(f"bandwidth ε is {epsilon}; allowed: 0 to 1")
    return eps
