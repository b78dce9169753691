"""Joint distribution of significant height and period at a place, and its contours by inverse FORM.

    H:      F(h) = 1 − exp(−[(h − γ)/α]^β), h > γ                     Weibull, three parameters
    T | H:  ln T normal, μ(h) = a₁ + a₂ h^a₃, σ(h) = b₁ + b₂ exp(−b₃ h)    DNV-RP-C205, 3.7.2; Bitner-Gregersen (1991)

    contour of R years, seas of D hours:  u₁² + u₂² = β_R²,  Φ(β_R) = 1 − D/(8766 R),
    h = F⁻¹(Φ(u₁)),  ln T = μ(h) + σ(h) u₂                             Winterstein et al. (1993)

A plane tangent to the contour in normal space separates the seas that occur once in R years. A response whose limit
surface in normal space is a plane is largest on the contour, for the median of its short-term extremes.  The largest
height of the contour is the return value of the height alone, with its median period.

Both distributions are fitted with the largest likelihood for the counts in the classes. The law of periods depends
on the mean height of each class. Beyond the table it is an extrapolation, which a finding reports.
"""

from typing import NamedTuple

import numpy as np

HOURS = 8766.0  # hours in a year
FEWEST = 4  # classes of height
POINTS = 73  # points of a closed contour
PARTS = 20  # subdivisions of a class of height
SIMPLEX = {"xatol": 1e-8, "fatol": 1e-12, "maxiter": 3000, "adaptive": True}


class JointLaw(NamedTuple):
    """weibull : γ m, α m, β; mean : a₁, a₂, a₃; spread : b₁, b₂, b₃; period_kind : one of `environment.periods.KINDS`

    highest : m, middle of the highest observed class
    """

    weibull: tuple
    mean: tuple
    spread: tuple
    period_kind: str
    highest: float

    def height(self, probability):
        """Height that this share of the seas does not exceed, m; shape (…)"""
        low, scale, shape = self.weibull
        return low + scale * (-np.log1p(-np.asarray(probability, float))) ** (1 / shape)

    def log_period(self, height):
        """Mean and deviation (…) of ln T in seas of a height, m"""
        (a1, a2, a3), (b1, b2, b3) = self.mean, self.spread
        h = np.maximum(np.asarray(height, float), 0.0)
        return a1 + a2 * h**a3, b1 + b2 * np.exp(-b3 * h)

    def contour(self, years, hours=3.0, points=POINTS):
        """Heights m and periods s (points,) each, closed, of a return period of seas that last `hours`

        raises : ValueError if that many years contain fewer than two seas
        """
        from scipy.special import ndtr

        reach, angle = self.reach(years, hours), np.linspace(0, 2 * np.pi, points)
        height = self.height(ndtr(reach * np.cos(angle)))
        mean, spread = self.log_period(height)
        return height, np.exp(mean + spread * reach * np.sin(angle))

    def top(self, years, hours=3.0):
        """The largest height of a contour, m, and its median period, s"""
        from scipy.special import ndtr

        height = float(self.height(ndtr(self.reach(years, hours))))
        return height, float(np.exp(self.log_period(height)[0]))

    def reach(self, years, hours):
        """β_R.  raises : ValueError for fewer than two seas"""
        from scipy.special import ndtri

        seas = years * HOURS / hours
        if not (np.isfinite(seas) and seas > 2):
            raise ValueError(f"{years:g} years have {seas:.3g} seas of {hours:g} hours; allowed: above 2")
        return float(-ndtri(1 / seas))


def joint_law(scatter) -> JointLaw:
    """`JointLaw` of an `environment.scatter.Scatter`.

    raises : ValueError with fewer than four classes of height, or if none of them has two periods
    """
    share = scatter.probability.sum(axis=1)
    seen = np.flatnonzero(share > 0)
    if len(seen) < FEWEST:
        raise ValueError(f"the scatter has {len(seen)} classes of height with waves; allowed: at least {FEWEST}")
    heights = _weibull(scatter.heights, share)
    mean, spread = _of_periods(scatter, share, _centers(scatter.heights, heights))
    return JointLaw(heights, mean, spread, scatter.period_kind, float(scatter.heights[seen[-1]]))


def _edges(middles):
    """Ends (n + 1,) of classes with the middles (n,); the first begins at 0 or above"""
    inner = 0.5 * (middles[1:] + middles[:-1])
    first, last = 2 * middles[0] - inner[0], 2 * middles[-1] - inner[-1]
    return np.concatenate([[max(first, 0.0)], inner, [last]])


def _weibull(heights, share):
    """γ, α, β of the largest likelihood of the shares in classes"""
    from scipy.optimize import minimize

    edges, there = _edges(heights), share > 0
    first = edges[np.flatnonzero(there)[0] + 1]  # γ is below the end of the lowest class with waves

    def unlikely(x):
        low, scale, shape = first * x[0], np.exp(x[1]), np.exp(x[2])
        if not x[0] < 1:
            return 1e6 * (1 + x[0])
        left = np.exp(-((np.maximum(edges - low, 0.0) / scale) ** shape))
        left[0] = 1.0  # heights below the table belong to its first class
        return -share[there] @ np.log(np.maximum(left[:-1] - left[1:], 1e-300)[there])

    start = 0.0, np.log(share @ heights / share.sum()), np.log(1.3)
    for _ in range(3):  # once more from its end point: a simplex may have collapsed
        found = minimize(
            unlikely, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-13, "maxiter": 4000}
        )
        start = found.x
    return float(first * start[0]), float(np.exp(start[1])), float(np.exp(start[2]))


def _centers(heights, weibull):
    """Mean height within each class by its distribution, m; shape (n,)"""
    (low, scale, shape), ends = weibull, _edges(heights)
    fine = ends[:-1, None] + np.diff(ends)[:, None] * np.linspace(0, 1, PARTS + 1)
    left = np.exp(-((np.maximum(fine - low, 0.0) / scale) ** shape))
    weight, middle = left[:, :-1] - left[:, 1:], 0.5 * (fine[:, 1:] + fine[:, :-1])
    total = weight.sum(axis=1)
    return np.where(total > 0, np.sum(weight * middle, axis=1) / np.maximum(total, 1e-300), heights)


def _of_periods(scatter, share, heights):
    """Coefficients (a₁, a₂, a₃) and (b₁, b₂, b₃) of the largest likelihood of the period classes at each height"""
    from scipy.optimize import minimize
    from scipy.special import ndtr

    there = share > 0
    h, counts = heights[there], scatter.probability[there]
    ends = np.log(np.maximum(_edges(scatter.periods), 1e-9))
    if not np.any(np.count_nonzero(counts, axis=1) > 1):
        raise ValueError("every class of height has only one class of period, so there is no scatter of periods to fit")

    def unlikely(x):
        mean, spread = x[0] + x[1] * h ** np.exp(x[2]), np.exp(x[3]) + np.exp(x[4] - np.exp(x[5]) * h)
        place = (ends - mean[:, None]) / spread[:, None]
        inside = np.where(place[:, :-1] > 0, ndtr(-place[:, :-1]) - ndtr(-place[:, 1:]), np.diff(ndtr(place)))
        return -np.sum(counts * np.log(np.maximum(inside, 1e-300)))

    logs = counts @ (0.5 * (ends[1:] + ends[:-1])) / counts.sum(axis=1)
    slope, level = np.polyfit(np.sqrt(h), logs, 1, w=np.sqrt(share[there]))
    start = np.array([level, slope, np.log(0.5), np.log(0.06), np.log(0.1), np.log(0.3)])
    for _ in range(4):
        start = minimize(unlikely, start, method="Nelder-Mead", options=SIMPLEX).x
    a, b = start[:3], np.exp(start[3:])
    return (float(a[0]), float(a[1]), float(np.exp(a[2]))), tuple(map(float, b))
