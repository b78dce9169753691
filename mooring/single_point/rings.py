"""Functions of an angle around the circle, as periodic cubic splines: the steady loads on a turning body.

The zeros of a ring are the zeros of its cubics, so a search finds all of them.
They are then polished on the exact function,
and an extremum that just touches 0 is examined closely.
"""

import numpy as np

COUNT = 720  # half a degree; tables of coefficients have nodes every 5° or more
SCAN = 360  # points of the search for zeros; where the spline is too coarse the exact function decides
TOUCH = 1e-3  # extrema closer to 0 than this fraction of the largest value are searched on the exact function
NARROW, STRAIGHT = 1e-5, 1e-6  # a chord tells a zero: of a step, at most, and of its rise, by which it is bent
WIDTHS = np.concatenate([-np.array([0.5, 0.1, 1e-3, 1e-4, 1e-5, 1e-6]), [0.0], [1e-6, 1e-5, 1e-4, 1e-3, 0.1, 0.5]])


def angles(count=COUNT):
    """Angles of the table from 0, rad; shape (count,)"""
    return np.arange(count) * (2 * np.pi / count)


class Ring:
    """Spline through values (count, …) at evenly spaced angles from 0."""

    def __init__(self, values):
        from scipy.fft import irfft, rfft

        f = np.asarray(values, float)
        n, h = len(f), 2 * np.pi / len(f)
        # second derivatives M: M₋ + 4M + M₊ = 6 (f₋ − 2f + f₊)/h², a circulant, which Fourier's sums solve
        cos = np.cos(np.arange(n // 2 + 1) * h)
        gain = (6 * (cos - 1) / (h * h * (2 + cos))).reshape(-1, *[1] * (f.ndim - 1))
        M = irfft(gain * rfft(f, axis=0), n, axis=0)
        pieces = np.empty((n, 4, *f.shape[1:]))  # coefficients of each interval, the cubic one first
        for now, after in ((slice(0, -1), slice(1, None)), (slice(-1, None), slice(0, 1))):
            pieces[now, 0] = (M[after] - M[now]) / (6 * h)
            pieces[now, 2] = (f[after] - f[now]) / h - h / 6 * (2 * M[now] + M[after])
        pieces[:, 1], pieces[:, 3] = 0.5 * M, f
        self._pieces, self.step = pieces, h

    def part(self, k):
        """Ring of component k of the values"""
        out = object.__new__(Ring)
        out._pieces, out.step = self._pieces[:, :, k], self.step
        return out

    def __call__(self, angle):
        """Values of the table at one angle, rad; shape (…)"""
        place = (angle / self.step) % len(self._pieces)
        whole = int(place)
        s = (place - whole) * self.step
        a, b, c, d = self._pieces[whole % len(self._pieces)]
        return ((a * s + b) * s + c) * s + d

    def along(self, angle):
        """Values of the table at angles (n,), rad; shape (n, …)"""
        place = np.asarray(angle, float) / self.step
        whole = np.floor(place)
        s = ((place - whole) * self.step).reshape(-1, *[1] * (self._pieces.ndim - 2))
        at = self._pieces[whole.astype(np.int64) % len(self._pieces)]
        return ((at[:, 0] * s + at[:, 1]) * s + at[:, 2]) * s + at[:, 3]

    def crests(self):
        """Angles, rising, where a Ring of numbers has zero slope, rad; shape (k,): the slope of each cubic is a
        parabola"""
        a, b, c = self._pieces[:, :3].T
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(b * b - 3 * a * c)
            larger = -(b + np.copysign(root, b))
            at = np.stack([larger / (3 * a), c / larger], axis=1)  # 3a s² + 2b s + c = 0 without cancellation
        inside = (at >= 0) & (at < self.step)
        starts = self.step * np.arange(len(a))[:, None]
        return np.sort((starts + np.where(inside, at, 0.0))[inside])


def zeros(function, count=SCAN):
    """Rising angles (k,) in 0 … 2π at which a smooth periodic function is 0.

    function : callable of angles (n,) rad → (n,); if it is 0 everywhere the result is empty
    """
    from scipy.optimize import brentq

    at = angles(count)
    values = np.asarray(function(at), float)
    size = np.abs(values).max()
    if not size > 0:
        return np.zeros(0)
    ring = Ring(values / size)

    def exact(angle):
        return float(function(np.array([angle]))[0]) / size

    crests = ring.crests()
    heights = ring.along(crests)
    found = []
    for crest in crests[np.abs(heights) < TOUCH]:
        found += _beside_crest(exact, crest, ring.step)
    # between nodes and extrema the spline is monotone, so that it has one zero where its sign changes
    order = np.argsort(np.concatenate([at, crests]), kind="stable")
    place, value = np.concatenate([at, crests])[order], np.concatenate([values / size, heights])[order]
    after = np.append(value[1:], value[0])
    for i in np.flatnonzero((value == 0) | (value * after < 0)):
        end = place[i + 1] if i + 1 < len(place) else 2 * np.pi
        zero = place[i] if value[i] == 0 else brentq(ring, place[i], end, xtol=1e-12, disp=False)
        found += _near(function, exact, zero, ring.step)
    return _distinct(np.mod(found, 2 * np.pi))


def _near(function, exact, zero, step):
    """[the zero of a function near that of its spline], empty where its sign does not change there

    All widths are evaluated in one call.  Where the narrowest bracket is straight its chord gives the zero to 1e-13
    rad, and no more calls are needed.
    """
    from scipy.optimize import brentq

    at = zero + step * WIDTHS
    g = np.asarray(function(at), float)
    middle = len(WIDTHS) // 2
    if g[middle] == 0.0:
        return [zero]
    for i in range(middle - 1, -1, -1):
        low, high = g[i], g[-1 - i]
        if low * high <= 0.0:
            if WIDTHS[-1 - i] <= NARROW and abs(g[middle] - 0.5 * (low + high)) <= STRAIGHT * abs(high - low):
                return [at[i] - low * (at[-1 - i] - at[i]) / (high - low)]
            return [brentq(exact, at[i], at[-1 - i], xtol=1e-13)]
    return []


def _beside_crest(exact, crest, step):
    """Zeros on both sides of an extremum of the function, if it crosses 0"""
    from scipy.optimize import brentq, minimize_scalar

    sides = [crest - step, crest + step]
    ends = [exact(side) for side in sides]
    if ends[0] * ends[1] <= 0.0:
        return []
    sign = np.sign(ends[0])
    best = minimize_scalar(lambda a: sign * exact(a), bounds=sides, method="bounded", options={"xatol": 1e-10})
    if sign * exact(best.x) >= 0.0:
        return []
    return [brentq(exact, *sorted((side, best.x)), xtol=1e-13) for side in sides]


def _distinct(found):
    """Rising angles without those equal to rounding"""
    found = np.sort(found)
    if len(found) < 2:
        return found
    gap = np.diff(np.append(found, found[0] + 2 * np.pi))
    return found[gap > 1e-9]
