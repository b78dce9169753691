"""Return values of yearly maxima by three distributions, with intervals valid for few years.

    gumbel    P(x) = exp(−exp(−(x − b)/s))                          maximum likelihood
    weibull   P(x) = 1 − exp(−(x/λ)^k), x > 0                        maximum likelihood; −ln x is Gumbel's
    gev       P(x) = exp(−[1 − κ (x − b)/s]^(1/κ))                   L-moments (Hosking, Wallis & Wood, 1985)

    x_R : P(x_R) = 1 − 1/R

Interval.  For gumbel, and for weibull in −ln x, (x̂_R − x_R)/ŝ has a distribution free of b and s (Lawless, 1982). Its
quantiles come from samples of the standard distribution, and the interval is exact except for the number of samples.
For gev, every sample of uniform numbers is converted to the distribution for which these numbers reproduce the
L-moments and κ̂ of the maxima; the quantiles are those of its x_R (the generalised fiducial distribution, Hannig
2009): the interval is exact in location and scale, and approximate in κ for few years.
"""

from typing import NamedTuple

import numpy as np

FAMILIES = ("gumbel", "weibull", "gev")
FEWEST, ENOUGH = 5, 10  # years: fewer give no scale; below ten a finding warns
SAMPLES, SEED = 4000, 1982
SHAPES = (-0.6, 0.9)  # range of the moment estimate κ
WIDEST = (-1.0, 1.5)  # range of κ whose samples have such an estimate
SAME = 1e-6  # |κ| below which the distribution equals Gumbel's
TURNS = 10  # iterations of the search; the estimate follows κ nearly one to one
GRINGORTEN = 0.44


class ExtremeFit(NamedTuple):
    """family : one of FAMILIES; location, scale, shape : b, s, κ (weibull: 0, λ, k; gumbel: κ = 0); maxima : (n,)"""

    family: str
    location: float
    scale: float
    shape: float
    maxima: np.ndarray

    def value(self, period):
        """X_R of return periods in years, above 1; shape (…)"""
        return _value(self.family, (self.location, self.scale, self.shape), _checked(period))

    def interval(self, period, confidence=0.9, samples=SAMPLES):
        """Interval (low, high) of x_R for one return period in years. It is reproducible for a given fit.

        raises : ValueError for a confidence outside 0.5 to 0.99
        """
        if not 0.5 <= confidence <= 0.99:
            raise ValueError(f"confidence is {confidence:g}; allowed: 0.5 to 0.99")
        period = float(_checked(period))
        drawn = np.random.default_rng(SEED).exponential(size=(samples, len(self.maxima)))
        tails = 0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence
        if self.family == "weibull":
            reduced, place = np.log(np.log(period)), (-np.log(self.scale), 1 / self.shape)
            low, high = _pivotal(-np.log(drawn), place, -reduced, tails)
            return float(np.exp(-high)), float(np.exp(-low))
        if self.family == "gumbel":
            place = self.location, self.scale
            return _pivotal(-np.log(drawn), place, -np.log(-np.log1p(-1 / period)), tails)
        return self._of_shape(drawn, period, tails)

    def _of_shape(self, drawn, period, tails):
        shape = np.full(len(drawn), self.shape)
        for _ in range(TURNS):
            location, scale, found = _moment_fit(_gev_of(drawn, shape[:, None]))
            shape = np.clip(shape + self.shape - found, *WIDEST)
        shape = np.where(np.abs(shape) < SAME, SAME, shape)
        reached = self.location + self.scale * (_value("gev", (0.0, 1.0, shape), period) - location) / scale
        return tuple(map(float, np.quantile(reached, tails)))


def fit_extremes(maxima, family="gumbel"):
    """ExtremeFit of maxima (n,), one a year.

    raises : ValueError for an unknown family, for fewer than 5 years, for equal maxima, and with weibull for maxima
        that are not above 0
    """
    x = np.asarray(maxima, float)
    if family not in FAMILIES:
        raise ValueError(f"family is {family!r}; allowed: {', '.join(FAMILIES)}")
    if x.ndim != 1 or not np.all(np.isfinite(x)):
        raise ValueError("yearly maxima are not one row of finite numbers")
    if len(x) < FEWEST:
        raise ValueError(f"there are {len(x)} yearly maxima; allowed: at least {FEWEST}, and {ENOUGH} are better")
    if not np.ptp(x) > 1e-9 * np.abs(x).max():
        raise ValueError("all yearly maxima are equal; there is no distribution to fit")
    if family == "gev":
        return ExtremeFit(family, *(float(value[0]) for value in _moment_fit(x[None])), x)
    if family == "gumbel":
        b, s = (float(value[0]) for value in _likely_fit(x[None]))
        return ExtremeFit(family, b, s, 0.0, x)
    if not x.min() > 0:
        raise ValueError(f"smallest yearly maximum is {x.min():g}; allowed for weibull: above 0")
    b, s = (float(value[0]) for value in _likely_fit(-np.log(x)[None]))
    return ExtremeFit(family, 0.0, float(np.exp(-b)), 1 / s, x)


def plotting_positions(count):
    """Probabilities of sorted maxima on probability paper (Gringorten, 1963); shape (count,)"""
    return (np.arange(1, count + 1) - GRINGORTEN) / (count + 1 - 2 * GRINGORTEN)


def _pivotal(drawn, place, reduced, tails):
    """Interval (low, high) of b + s·reduced for Gumbel's b, s, from standard samples (m, n)"""
    b, s = _likely_fit(drawn)
    low, high = np.quantile((b + s * reduced - reduced) / s, tails)
    value = place[0] + place[1] * reduced
    return float(value - high * place[1]), float(value - low * place[1])


def _likely_fit(x):
    """Location and scale (m,) of samples (m, n): the root of s = x̄ − Σ x e^(−x/s) / Σ e^(−x/s), by Newton in ln s"""
    u = x - x.min(axis=1, keepdims=True)
    mean, log_s = u.mean(axis=1), np.log(u.std(axis=1) * np.sqrt(6) / np.pi)
    for _ in range(50):
        s = np.exp(log_s)
        weight = np.exp(-u / s[:, None])
        total = weight.sum(axis=1)
        first, second = (weight * u).sum(axis=1) / total, (weight * u * u).sum(axis=1) / total
        # d/ds of the weighted mean is its variance over s²
        step = (s + first - mean) / (s + (second - first**2) / s)
        log_s = log_s - np.clip(step, -1.0, 1.0)
        if np.abs(step).max() < 1e-13:
            break
    s = np.exp(log_s)
    return x.min(axis=1) - s * np.log(np.exp(-u / s[:, None]).mean(axis=1)), s


def _moment_fit(x):
    """Location, scale and κ (m,) of samples (m, n) by L-moments, κ by Hosking's approximation"""
    from scipy.special import gamma

    x, n = np.sort(x, axis=1), x.shape[1]
    i = np.arange(n)
    b0, b1 = x.mean(axis=1), x @ i / (n * (n - 1))
    b2 = x @ (i * (i - 1)) / (n * (n - 1) * (n - 2))
    second, third = 2 * b1 - b0, 6 * b2 - 6 * b1 + b0
    c = 2 / (3 + third / second) - np.log(2) / np.log(3)
    k = np.clip(7.8590 * c + 2.9554 * c * c, *SHAPES)
    k = np.where(np.abs(k) < SAME, SAME, k)
    s = second * k / ((1 - 2.0**-k) * gamma(1 + k))
    return b0 - s * (1 - gamma(1 + k)) / k, s, k


def _gev_of(exponential, shape):
    """Standard values of κ, which broadcasts, from standard exponential ones"""
    shape = np.where(np.abs(shape) < SAME, SAME, shape)
    return -np.expm1(shape * np.log(exponential)) / shape


def _value(family, place, period):
    b, s, k = place
    if family == "weibull":
        return s * np.log(period) ** (1 / k)
    reduced = -np.log(-np.log1p(-1 / period))
    return b + s * reduced if family == "gumbel" else b - s * np.expm1(-k * reduced) / k


def _checked(period):
    period = np.asarray(period, float)
    if not np.all((period > 1) & (period < np.inf)):
        raise ValueError(f"return period is {period} years; allowed: above 1, finite")
    return period


class Extreme(NamedTuple):
    """value; low and high : interval of the value (all equal if the user gives the value); fit : ExtremeFit, or None"""

    value: float
    low: float
    high: float
    fit: ExtremeFit | None


def extreme(maxima, family, years, confidence):
    """Extreme of a return period, of yearly maxima (n,), and findings on this extreme, one line each.

    Raises ValueError for maxima that are not numbers, and where the value is not above 0.
    """
    maxima = np.asarray(maxima, float)
    if np.any(maxima <= 0):  # such as −999 where a year is missing
        raise ValueError(
            f"a yearly maximum is {maxima.min():g}; allowed: above 0; leave out a year without a known maximum"
        )
    fit = fit_extremes(maxima, family)
    found = Extreme(float(fit.value(years)), *fit.interval(years, confidence), fit)
    if not found.value > 0:
        raise ValueError(f"the value of {years:.0f} years is {found.value:.4g}; allowed: above 0")
    return found, tuple(_doubts(found, years, confidence))


def _doubts(found, years, confidence):
    count, most = len(found.fit.maxima), float(found.fit.maxima.max())
    if count < ENOUGH:
        yield (
            f"{count} yearly maxima, fewer than {ENOUGH}: the value of {years:.0f} years is "
            f"{found.value:.4g}, its {100 * confidence:.0f} % interval {found.low:.4g} to {found.high:.4g}"
        )
    if years > 4 * count:
        yield (
            f"{years:.0f} years are more than four times the {count} measured years, so this value is an extrapolation"
        )
    if years >= count and found.value < most:
        yield (
            f"the value of {years:.0f} years by {found.fit.family}, {found.value:.4g}, is below {most:.4g}, the "
            f"largest of the {count} measured years; use another family, or the measured value"
        )
