"""The outline of a section: straight edges and circular arcs, closed, and its part under water.

    τ(u) = s + (e − s) u,      or the arc  c + (s − c) exp(iφu),  φ = 4 arctan b,      0 ≤ u ≤ 1

s and e are the ends of an edge. The bulge b of an edge is the tangent of a quarter of the arc's angle, positive where
the edge turns to the left, as in DXF files. Points are complex, y + iz. Outlines run counterclockwise, with the body
on the left.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

U, WEIGHTS = (np.polynomial.legendre.leggauss(24)[0] + 1) / 2, np.polynomial.legendre.leggauss(24)[1] / 2
CHORDS = 64  # chords per arc in the test for self-crossing outlines
SHARPEST = np.radians(1)  # angle of an edge with the water


class OutlineError(ValueError):
    """An outline is no valid section; the message names the place."""


class Edge(NamedTuple):
    """start, end : complex, m; bulge : 0 for a straight edge"""

    start: complex
    end: complex
    bulge: float = 0.0

    @property
    def angle(self):
        """Angle φ of the arc, rad; 0 for a straight edge"""
        return 4 * np.arctan(self.bulge)

    @property
    def center(self):
        """Centre c of an arc, complex, m"""
        b = self.bulge
        return (self.start + self.end) / 2 + 1j * (self.end - self.start) / 2 * (1 - b * b) / (2 * b)

    @property
    def length(self):
        """m"""
        return abs(self.end - self.start) if self.bulge == 0 else abs((self.start - self.center) * self.angle)

    def at(self, u):
        """Point τ at u, complex, m"""
        if self.bulge == 0:
            return self.start + (self.end - self.start) * np.asarray(u)
        return self.center + (self.start - self.center) * np.exp(1j * self.angle * np.asarray(u))

    def slope(self, u):
        """Slope dτ/du at u, complex, m"""
        if self.bulge == 0:
            return np.full(np.shape(u), self.end - self.start)
        return 1j * self.angle * (self.start - self.center) * np.exp(1j * self.angle * np.asarray(u))

    def part(self, u0, u1):
        """The `Edge` from u0 to u1"""
        start, end = (self.start if u0 == 0 else complex(self.at(u0))), (self.end if u1 == 1 else complex(self.at(u1)))
        return Edge(start, end, float(np.tan(np.arctan(self.bulge) * (u1 - u0))))

    def at_height(self, z):
        """Ascending places u, strictly within the edge, at which the edge has the height z"""
        if self.bulge == 0:
            rise = self.end.imag - self.start.imag
            found = [] if rise == 0 else [(z - self.start.imag) / rise]
        else:
            c, arm = self.center, self.start - self.center
            up = (z - c.imag) / abs(arm)
            angles = [] if abs(up) >= 1 else [np.arcsin(up), np.pi - np.arcsin(up)]
            sense = np.sign(self.angle)
            found = [(sense * (a - np.angle(arm))) % (2 * np.pi) / abs(self.angle) for a in angles]
        return sorted(float(u) for u in found if 1e-12 < u < 1 - 1e-12)


class Wetted(NamedTuple):
    """The part of an outline under water, z = 0 at the surface.

    edges : from the waterline at the left along the bottom to the waterline at the right; area : m²
    center : centre of the area, complex, m; left, right : y of the two ends of the waterline, m; draft : m
    symmetric : whether the part is symmetric about y = 0
    """

    edges: tuple
    area: float
    center: complex
    left: float
    right: float
    draft: float
    symmetric: bool

    @property
    def waterline(self):
        """Width at the surface, m"""
        return self.right - self.left


@dataclass(frozen=True)
class Outline:
    """A closed section; edges : `Edge`s, each of which begins at the end of the previous edge, in either sense of
    rotation

    Raises OutlineError for an outline that is open, crosses itself or has no area.
    """

    edges: tuple

    def __post_init__(self):
        _check_closed(self.edges)
        _check_simple(self.edges)
        area = _integral(self.edges, lambda p: p.real)
        if area < 0:
            reverse = tuple(Edge(e.end, e.start, -e.bulge) for e in self.edges[::-1])
            object.__setattr__(self, "edges", reverse)
        size = max(abs(e.end - self.edges[0].start) for e in self.edges)
        if not abs(area) > 1e-9 * size**2:
            raise OutlineError(f"the outline encloses {abs(area):.3g} m²; allowed: above 0")

    @cached_property
    def bottom(self):
        """z of the lowest point, m"""
        return min(_heights(self.edges))

    @cached_property
    def height(self):
        """m"""
        return max(_heights(self.edges)) - self.bottom

    def wetted(self, draft):
        """`Wetted` with the lowest point `draft` under water.

        Raises OutlineError if the waterline does not cut the section in one piece.
        """
        if not 0 < draft < self.height:
            raise OutlineError(
                f"draft is {draft:g} m, but the section is {self.height:.6g} m high; allowed: above 0, below its height"
            )
        edges = _one_chain(self._cut(draft), draft)
        area = float(_integral(edges, lambda p: p.real))
        moment = complex(_integral(edges, lambda p: p.real * (p.real / 2 + 1j * p.imag)))
        left, right = edges[0].start.real, edges[-1].end.real
        return Wetted(edges, area, moment / area, left, right, draft, _is_mirrored(edges))

    def draft_of(self, area):
        """Draft at which the section displaces `area`, m².  Raises OutlineError if the section sinks."""
        from scipy.optimize import brentq

        whole = float(_integral(self.edges, lambda p: p.real))
        if not 0 < area < whole:
            raise OutlineError(
                f"the section has to displace {area:.6g} m², and its whole area is {whole:.6g} m²; allowed: "
                f"less than the whole area"
            )

        def more(draft):
            wet = [part for part in self._cut(draft) if complex(part.at(0.5)).imag < 0]
            return float(_integral(wet, lambda p: p.real)) - area

        return brentq(more, 1e-9 * self.height, (1 - 1e-9) * self.height, xtol=1e-13 * self.height)

    def meets(self, start, end):
        """Whether the straight line between two points, complex, touches the outline"""
        points = self._points()
        return bool(np.any(_cross(points[:-1], points[1:], start, end)))

    def distance(self, point):
        """Distance from a point, complex, to the outline, m; 0 for a point inside"""
        to = self._points() - point
        if abs(np.sum(np.angle(to[1:] / np.where(to[:-1] == 0, 1, to[:-1])))) > np.pi:
            return 0.0
        along = np.diff(to)
        length = np.where(along == 0, 1, np.abs(along) ** 2)
        share = np.clip(-(to[:-1] * along.conj()).real / length, 0, 1)
        return float(np.abs(to[:-1] + share * along).min())

    def _points(self):
        """Along the outline, complex, those of arcs close together"""
        return np.concatenate([edge.at(np.linspace(0, 1, 2 if edge.bulge == 0 else CHORDS + 1)) for edge in self.edges])

    def _cut(self, draft):
        """Edges with the lowest point at z = −draft, cut at the water"""
        parts = []
        for edge in self.edges:
            raised = _raised(edge, -draft - self.bottom)
            cuts = [0.0, *raised.at_height(0.0), 1.0]
            parts += [raised.part(u0, u1) for u0, u1 in pairwise(cuts)]
        return parts


def rectangle(beam, height):
    """`Outline` of a rectangle, m"""
    corners = np.array([0, beam, beam + 1j * height, 1j * height]) - beam / 2
    return closed(corners)


def circle(diameter):
    """`Outline` of a circle, m"""
    ends = np.array([-diameter / 2, diameter / 2])
    return closed(ends, (1.0, 1.0))


def closed(points, bulges=None):
    """`Outline` through points, complex, m; bulges : bulges of the edge from each point to the next"""
    bulges = np.zeros(len(points)) if bulges is None else bulges
    ends = zip(points, np.roll(points, -1), bulges, strict=True)
    return Outline(tuple(Edge(complex(s), complex(e), float(b)) for s, e, b in ends))


def _check_closed(edges):
    if len(edges) < 2:
        raise OutlineError(f"the outline has {len(edges)} edges; allowed: 2 or more")
    for i, (one, after) in enumerate(zip(edges, [*edges[1:], edges[0]], strict=True), 1):
        if not np.isfinite([one.start, one.end, one.bulge]).all():
            raise OutlineError(f"edge {i} has a number that is not finite")
        if one.start == one.end:
            raise OutlineError(f"edge {i} has zero length at {_named(one.start)}; leave out one point")
        if abs(after.start - one.end) > 0:
            raise OutlineError(
                f"the outline is not closed: edge {i} ends at {_named(one.end)}, and the next begins at "
                f"{_named(after.start)}, {abs(after.start - one.end):.3g} m away; give the same point"
            )


def _check_simple(edges):
    """Edges as chords: two that are not neighbours must not touch."""
    chords = []
    for i, edge in enumerate(edges):
        points = edge.at(np.linspace(0, 1, 2 if edge.bulge == 0 else CHORDS + 1))
        chords += [(i, a, b) for a, b in pairwise(points)]
    starts, ends = (np.array([chord[k] for chord in chords]) for k in (1, 2))
    count = len(chords)
    first, second = (np.array(x) for x in zip(*combinations(range(count), 2), strict=True))
    apart = (second - first > 1) & ~((first == 0) & (second == count - 1))
    first, second = first[apart], second[apart]
    a, b, c, d = starts[first], ends[first], starts[second], ends[second]
    crossing = _cross(a, b, c, d)
    if crossing.any():
        k = int(np.argmax(crossing))
        one, other = chords[first[k]][0] + 1, chords[second[k]][0] + 1
        raise OutlineError(f"the outline crosses itself: edges {one} and {other} meet near {_named(a[k])}")


def _cross(a, b, c, d):
    """Whether the chords a to b and c to d touch"""
    beside = (_side(a, b, c) * _side(a, b, d) > 0) | (_side(c, d, a) * _side(c, d, b) > 0)
    for part in (np.real, np.imag):  # collinear chords that do not overlap
        (a0, b0), (c0, d0) = ((part(u), part(v)) for u, v in ((a, b), (c, d)))
        beside = beside | (np.maximum(a0, b0) < np.minimum(c0, d0)) | (np.maximum(c0, d0) < np.minimum(a0, b0))
    return ~beside


def _side(a, b, p):
    return np.sign(((b - a).conjugate() * (p - a)).imag)


def _named(point):
    return f"({point.real:g}, {point.imag:g})"


def _integral(edges, function):
    """∮ function(τ) dz along edges, complex where the function is"""
    return sum(np.sum(WEIGHTS * function(edge.at(U)) * edge.slope(U).imag) for edge in edges)


def _heights(edges):
    for edge in edges:
        yield from (edge.start.imag, edge.end.imag)
        if edge.bulge:
            for top in (1, -1):
                u = (np.sign(edge.angle) * np.angle(1j * top / (edge.start - edge.center))) % (2 * np.pi)
                if u < abs(edge.angle):
                    yield edge.center.imag + top * abs(edge.start - edge.center)


def _raised(edge, height):
    return Edge(edge.start + 1j * height, edge.end + 1j * height, edge.bulge)


def _one_chain(parts, draft):
    """The one chain of edges below z = 0, from the left to the right"""
    wet = np.array([complex(part.at(0.5)).imag < 0 for part in parts])
    begins = np.flatnonzero(wet & ~np.roll(wet, 1))
    if len(begins) != 1:
        raise OutlineError(f"at draft {draft:g} m the water cuts the section into {len(begins)} pieces; allowed: 1")
    chain = [parts[i] for i in np.roll(np.arange(len(parts)), -begins[0]) if wet[i]]
    chain[0] = chain[0]._replace(start=complex(chain[0].start.real, 0.0))
    chain[-1] = chain[-1]._replace(end=complex(chain[-1].end.real, 0.0))
    for edge, u in ((chain[0], 0.0), (chain[-1], 1.0)):
        slope = complex(edge.slope(u))
        if abs(np.arcsin(slope.imag / abs(slope))) < SHARPEST:
            raise OutlineError(f"at draft {draft:g} m the section touches the water at an angle below 1°")
    return tuple(chain)


def _is_mirrored(edges):
    size = max(abs(edge.start) for edge in edges)
    pairs = zip(edges, edges[::-1], strict=True)
    ends = (abs(one.start + other.end.conjugate()) for one, other in pairs)
    bulges = [edge.bulge for edge in edges]
    return max(ends) < 1e-9 * size and np.allclose(bulges, bulges[::-1], rtol=0, atol=1e-9)
