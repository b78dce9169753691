"""A coefficient over breadth/draft b = B/d and depth/draft h = H/d with a crest, interpolated along the crest.

The current force on a box is largest on a line b = r(h) of the b-h plane: at fixed b, in ever shallower water, the
force rises, passes the crest and falls.  Linear interpolation between two columns of h would cut the crest off.
Here each column is a curve over b with the crest among its points. Between columns, points at the same fraction u of
the way from the edge of the tests to the crest are joined:

    deep side     u = (b − b₀) / (r − b₀),    shallow side   u = (b₁ − b) / (b₁ − r)
    f = F(u, h) + (13u¹² − 12u¹³) (f_crest(h) − F(1, h))

F connects the columns, and the second term adds crests that were measured between columns.  The curves over h are
interpolated in d/H. Every given value is returned exactly. The value and both slopes are continuous, also across the
crest, where ∂f/∂b = 0. The deepest values belong to a tank that is `tank` beams deep, d/H = 1/(tank b); deeper water
has these values too.
"""

from collections import defaultdict
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .smooth import parabolic, smooth


class Point(NamedTuple):
    """beam/draft, depth/draft, coefficient, and whether the point lies on the crest"""

    b: float
    h: float
    value: float
    crest: bool


class CrestSurface:
    """Surface through Points: full columns of h, crests, and deepest values at h = tank b.

    The last crest is the one at the largest b: in deeper water the coefficient rises up to this edge.
    """

    def __init__(self, points, tank):
        self.tank = tank
        columns = defaultdict(list)
        for p in points:
            columns["deep" if np.isclose(p.h, tank * p.b) else p.h].append(p)
        self._deep_points = sorted(columns.pop("deep"))
        self._columns = {h: sorted(column) for h, column in sorted(columns.items()) if len(column) > 1}
        self._crest = sorted((p for p in points if p.crest), key=lambda p: p.h)
        self._low, self._high = self._deep_points[0].b, self._deep_points[-1].b

    def __call__(self, b, h):
        """Coefficient at b and h inside the tests"""
        edge = float(self._edge(1 / h))
        if b <= edge:
            return self._between(1 / h, (b - self._low) / (edge - self._low), b, deep=True)
        return self._between(1 / h, (self._high - b) / (self._high - edge), b, deep=False)

    def _between(self, x, u, b, deep):
        last = 1 / self._crest[-1].h
        nodes = [1 / (self.tank * b)] if deep else [last]
        nodes += [1 / h for h, _ in self._sides(deep)]
        rise = 13 * u**12 - 12 * u**13  # a power of 3 instead of 12 raised a second crest at b = 12, h = 2.4
        here, crest = (self._values(share, deep) for share in (u, 1.0))
        x = max(x, nodes[0])
        order = np.argsort(nodes)
        plain, below = (parabolic(np.take(nodes, order), np.take(v, order), flat=[0])(x) for v in (here, crest))
        return float(plain + rise * (self._crest_value(x, b) - below))

    def _sides(self, deep):
        return [(h, c) for h, c in self._columns.items() if deep or self._edge(1 / h) < self._high * (1 - 1e-9)]

    def _values(self, u, deep):
        """Coefficients of all columns at the fraction u, beginning with the deepest values or the last crest"""
        first = self._curves["deep"](self._low + u * (self._high - self._low)) if deep else self._crest[-1].value
        foot = self._low if deep else self._high
        return [first] + [self._curves[h](foot + u * (self._edge(1 / h) - foot)) for h, _ in self._sides(deep)]

    @cached_property
    def _curves(self):
        """{h or "deep": curve over b}; curves without an inner crest end flat, as those with one do there"""
        curves = {"deep": smooth(*_over_b(self._deep_points), flat=[-1])}
        for h, column in self._columns.items():
            b, values = _over_b(column)
            curves[h] = smooth(b, values, flat=[i for i, p in enumerate(column) if p.crest] or [-1])
        return curves

    @cached_property
    def _edge(self):
        """Curve over d/H: b of the crest, or of the edge of the tests where the crest lies beyond it"""
        beyond = [h for h in self._columns if h > self._crest[-1].h]
        x = [0.0, *sorted(1 / h for h in beyond), *(1 / p.h for p in self._crest[::-1])]
        return smooth(x, [self._high] * (1 + len(beyond)) + [p.b for p in self._crest[::-1]])

    def _crest_value(self, x, b):
        """Coefficient at the crest, or at the edge of the tests where the crest lies beyond it"""
        beyond = [(1 / h, column[-1].value) for h, column in self._columns.items() if h > self._crest[-1].h]
        points = [(1 / (self.tank * b), self._deep_points[-1].value), *sorted(beyond)]
        last = len(points)
        points += [(1 / p.h, p.value) for p in self._crest[::-1]]
        return smooth(*np.transpose(points), flat=[0, last])(x)


def _over_b(column):
    return [p.b for p in column], [p.value for p in column]
