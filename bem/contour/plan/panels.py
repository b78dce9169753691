"""Panels on the quarter contour of a rectangle, and points on them for singular or nearly singular integrals.

At the corner, where the water has an angle of 270°, potentials behave as r^(2/3), r^(4/3) … with r the distance from
the corner.  The panel at the corner is therefore parametrised by r = c t³, in which all these powers are smooth in
t. The next panels are linear in t, and their lengths grow with the distance from the corner.
A density is given at the Gauss points in t of each panel.

Integrals over panels that are near a target are split until every piece is as far from the target as it is long;
the pieces that end at the target use t = t₀ + (t₁ − t₀) v⁴, which makes a logarithmic singularity smooth.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...kernels.jit import kernel
from .maps import CLASSES, Contour

IMAGES = np.array(CLASSES, float)
# size of the stack of subdivided panels: each halving adds one, and a double halves at most 1075 + 53 times
MOST_PIECES = 1200


class Panels(NamedTuple):
    """p panels; a point of a panel is (x, y) = corner + r · direction, with r its distance from the corner."""

    start: np.ndarray  # (p,) m, r at t = 0
    length: np.ndarray  # (p,) m
    power: np.ndarray  # (p,) r = start + length · t^power
    corner: np.ndarray  # (2,) m
    direction: np.ndarray  # (p, 2)
    normal: np.ndarray  # (p, 2)
    t: np.ndarray  # (g,) Gauss points in 0 < t < 1
    weights: np.ndarray  # (g,)

    @property
    def contour(self):
        """`Contour` of the p · g nodes, panel by panel"""
        r = self.start[:, None] + self.length[:, None] * self.t ** self.power[:, None]
        ds = self.length[:, None] * self.power[:, None] * self.t ** (self.power[:, None] - 1) * self.weights
        points = self.corner + r[..., None] * self.direction[:, None]
        nx, ny = np.repeat(self.normal, len(self.t), axis=0).T
        return Contour(points[..., 0].ravel(), points[..., 1].ravel(), nx, ny, ds.ravel())


class Points(NamedTuple):
    """q integration points for pairs of a target and a near panel."""

    target: np.ndarray  # (q,) index
    panel: np.ndarray  # (q,) index
    image: np.ndarray  # (q,) index into IMAGES
    t: np.ndarray  # (q,)
    distance: np.ndarray  # (q,) m, to the target
    along: np.ndarray  # (q,) component along the panel's normal of (point − target) / distance²
    weights: np.ndarray  # (q,) m


def quarter_panels(half_length, half_beam, corner_length, longest, gauss):
    """Panels of the end x = half_length, then of the side y = half_beam.

    corner_length : length of the panel at the corner on end and side, m, (2,)
    longest : length of the longest panel on end and side, m, (2,); gauss : nodes per panel
    """
    start, length, power, direction, normal = [], [], [], [], []
    for side, extent in enumerate((half_beam, half_length)):
        edges = _edges(extent, min(corner_length[side], extent), longest[side])
        start += list(edges[:-1])
        length += list(np.diff(edges))
        power += [3] + [1] * (len(edges) - 2)
        direction += [(0.0, -1.0) if side == 0 else (-1.0, 0.0)] * (len(edges) - 1)
        normal += [(1.0, 0.0) if side == 0 else (0.0, 1.0)] * (len(edges) - 1)
    t, w = gauss_rule(gauss)
    return Panels(
        np.array(start), np.array(length), np.array(power, float), np.array([half_length, half_beam]),
        np.array(direction), np.array(normal), t, w,
    )  # fmt: skip


def _edges(extent, first, longest):
    """Ends of panels from 0 to `extent`: the first as given, each next one at most twice as long."""
    edges, step = [0.0, first], first
    while extent - edges[-1] > 1e-9 * extent:
        rest = extent - edges[-1]
        step = min(2 * step, longest)
        count = int(np.ceil(rest / step - 1e-9))
        if step == longest or count == 1:
            return np.append(edges[:-1], np.linspace(edges[-1], extent, count + 1))
        edges.append(edges[-1] + min(step, rest))
    return np.array(edges)


@lru_cache(maxsize=256)
def gauss_rule(count):
    """Gauss points and weights on (0, 1)"""
    x, w = np.polynomial.legendre.leggauss(count)
    rule = (x + 1) / 2, w / 2
    for part in rule:
        part.setflags(write=False)
    return rule


def interpolation(nodes, t):
    """Values at t of the polynomials that are 1 at one node and 0 at all other nodes; shape (t, g)"""
    gaps = np.subtract.outer(nodes, nodes) + np.eye(len(nodes))
    scale = 1 / gaps.prod(axis=1)
    distance = np.subtract.outer(t, nodes)
    hit = np.abs(distance) < 1e-15
    table = scale / np.where(hit, 1.0, distance)
    table = np.where(hit.any(axis=1)[:, None], hit, table)
    return table / table.sum(axis=1, keepdims=True)


def is_far(panels, x, y):
    """Whether the distance from a target to the image of a panel is at least the panel's length; shape (targets,
    images, p)"""
    far = np.empty((len(x), len(IMAGES), len(panels.start)), bool)
    _is_far(x, y, _flat(panels), IMAGES, far)
    return far


def near_points(panels, x, y, own, far, count, smallest):
    """`Points` of targets (x, y) on all panels that are not far.

    own : index of the node at each target, −1 for a target that is no node; far : from `is_far`; count : Gauss points
        per piece
    smallest : length down to which pieces that end at the target are halved, m
    """
    v, w = gauss_rule(2 * count)
    rules = np.array(gauss_rule(count)), np.array([v**4, 4 * v**3 * w])
    panel = np.where(own < 0, -1, own // len(panels.t))
    t = np.where(own < 0, 0.0, panels.t[own % len(panels.t)])
    arguments = x, y, panel, t, _flat(panels), IMAGES, far, *rules, smallest, np.empty((MOST_PIECES, 3))
    where, what = np.empty((3, 0), np.int64), np.empty((4, 0))
    points = _near_points(*arguments, where, what)
    where, what = np.empty((3, points), np.int64), np.empty((4, points))
    _near_points(*arguments, where, what)
    return Points(*where, *what)


def _flat(panels):
    """Start, length, power, corner, direction and normal of each panel; shape (p, 9)"""
    corner = np.broadcast_to(panels.corner, panels.direction.shape)
    return np.column_stack([panels.start, panels.length, panels.power, corner, panels.direction, panels.normal])


@kernel()
def _distance(x, y, panel, image, r0, r1):
    """Distance from the target to the piece r0 < r < r1 of a panel's image"""
    dx, dy = image[0] * x - panel[3], image[1] * y - panel[4]
    r = min(max(dx * panel[5] + dy * panel[6], r0), r1)
    return np.hypot(dx - r * panel[5], dy - r * panel[6])


@kernel()
def _is_far(x, y, panels, images, far):
    for i in range(len(x)):
        for g in range(len(images)):
            for p in range(len(panels)):
                r0, r1 = panels[p, 0], panels[p, 0] + panels[p, 1]
                far[i, g, p] = _distance(x[i], y[i], panels[p], images[g], r0, r1) >= panels[p, 1]


@kernel()
def _near_points(x, y, own, own_t, panels, images, far, smooth, singular, smallest, pieces, where, what):
    """The number of points

    where, what : (3, q) and (4, q), filled with the fields of `Points` if q is this number
    pieces : (·, 3) stack of the pieces of a panel: their ends in t, and whether the first is the target
    """
    points, most = 0, what.shape[1]
    for i in range(len(x)):
        for g in range(len(images)):
            for p in range(len(panels)):
                if far[i, g, p]:
                    continue
                panel, image = panels[p], images[g]
                waiting = 1
                pieces[0, 0], pieces[0, 1], pieces[0, 2] = 0.0, 1.0, 0.0
                if g == 0 and p == own[i]:
                    waiting = 2
                    pieces[0, 0], pieces[0, 1], pieces[0, 2] = own_t[i], 1.0, 1.0
                    pieces[1, 0], pieces[1, 1], pieces[1, 2] = own_t[i], 0.0, 1.0
                while waiting > 0:
                    waiting -= 1
                    t0, t1, ends_here = pieces[waiting, 0], pieces[waiting, 1], pieces[waiting, 2] == 1.0
                    a = panel[0] + panel[1] * min(t0, t1) ** panel[2]
                    b = panel[0] + panel[1] * max(t0, t1) ** panel[2]
                    rule = singular if ends_here else smooth
                    if ends_here:
                        split = b - a > smallest
                    else:
                        # an upper bound of halvings for a target at the end of a piece
                        split = b - a > max(_distance(x[i], y[i], panel, image, a, b), 1e-13 * panel[1])
                    middle = 0.5 * (t0 + t1)
                    if split and t0 != middle and t1 != middle:
                        pieces[waiting, 1] = middle  # its first end and `ends_here` are unchanged
                        pieces[waiting + 1, 0], pieces[waiting + 1, 1], pieces[waiting + 1, 2] = middle, t1, 0.0
                        waiting += 2
                        continue
                    points += rule.shape[1]
                    if points > most:
                        continue
                    n = points - rule.shape[1]
                    for q in range(rule.shape[1]):
                        step = (t1 - t0) * rule[0, q]
                        t = t0 + step
                        r = panel[0] + panel[1] * t ** panel[2]
                        dx = image[0] * (panel[3] + r * panel[5]) - x[i]
                        dy = image[1] * (panel[4] + r * panel[6]) - y[i]
                        d = np.hypot(dx, dy)
                        if ends_here:  # point on the target's own line, without cancellation
                            stretch = t * t + t * t0 + t0 * t0 if panel[2] > 1 else 1.0
                            d = panel[1] * abs(step) * stretch
                        where[0, n + q], where[1, n + q], where[2, n + q] = i, p, g
                        what[0, n + q], what[1, n + q] = t, d
                        what[2, n + q] = (dx * image[0] * panel[7] + dy * image[1] * panel[8]) / (d * d)
                        what[3, n + q] = abs(t1 - t0) * rule[1, q] * panel[1] * panel[2] * t ** (panel[2] - 1)
    return points
