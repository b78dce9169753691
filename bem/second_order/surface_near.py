"""Quadrature points on the free surface between a hull and a circle about it, and the potential at these points.

Each panel side on the waterline begins a strip that ends on the circle.  A strip has Radau points from waterline to
circle, the first of which is on the hull, and Gauss points along the side. Derivatives are those of the polynomials
through these points.
Potentials at points on the hull are interpolated (`hull_interpolation`). Potentials at points off the hull follow
from φ and the normal derivative V on the panels,

    4πφ = ∬ (φ ∂G/∂n − V G) dS.
"""

from dataclasses import dataclass

import numpy as np

from ..green.tables import wave_table
from ..panels.elements import quadrature
from ..panels.wave_influence import COARSE, PER_WAVE, Pairs
from ..waves import depth_values

BEYOND, SIDES_BEYOND = 1.08, 2.0  # radius of the circle over that of the body; sides of panels beyond it, at least
ROWS = 256  # points at once
OUTWARDS, PER_RADIAN = 8, 0.4  # points of a strip from hull to circle, for a radian of the wave between
LEAST_OUTWARDS, CLOSEST = 5, 19.0  # the least of them; as many as keep off the hull by a tenth of the side
FEWEST, MOST = 3, 9  # along a side
SPREADS = 0.3, 0.15, 0.0  # blending of strips, from rays of the centre to those of an ellipse
LEAST = 1e-4  # smallest weight in a strip, of the largest
CLOSE = 10  # points each way on panels close to a point, where the wave part of G is singular at the point's image


@dataclass(frozen=True, eq=False)
class Circle:
    """centre, radius : centre, m, (2,), and radius, m, of a circle around the hull; half : half extents of the
    waterline, m, (2,)"""

    centre: np.ndarray
    radius: float
    half: np.ndarray


def circle_about(mesh):
    """`Circle` about a hull"""
    points = mesh.whole().points[:, :2] if mesh.symmetry else mesh.points[:, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    centre = 0.5 * (low + high)
    radius = float(np.hypot(*(points - centre).T).max())
    sides = _sides(mesh)[1]
    longest = float(np.hypot(*(sides[:, 1] - sides[:, 0]).T).max())
    return Circle(centre, max(BEYOND * radius, radius + SIDES_BEYOND * longest), 0.5 * (high - low))


@dataclass(frozen=True, eq=False)
class Strips:
    """s strips, each with a points along and b points across, of which the first are on the hull.

    points : m, (s, a, b, 2); weights : m², (s, a, b)
    along, across : gradients of the coordinates along and across, 1/m, (s, a, b, 2)
    over_side, outwards : matrices from values at the points to derivatives along, (a, a), and across, (b, b)
    known : indices of the points of the waterline's quadrature on each side, (s, 4)
    from_known : interpolation from these points, (a, 4)
    """

    points: np.ndarray
    weights: np.ndarray
    along: np.ndarray
    across: np.ndarray
    over_side: np.ndarray
    outwards: np.ndarray
    known: np.ndarray
    from_known: np.ndarray

    @property
    def even(self):
        """Whether all strips are far from folding"""
        area = self.weights[..., 1:] / self.weights.max(axis=(1, 2), keepdims=True)
        return bool(np.all(area > LEAST**2)) and bool(np.all(self.weights > 0))

    def values(self, on_line, beside):
        """Values on these strips, shape (…, s, a, b), from values along the waterline, (…, l), and off the waterline,
        (…, s a (b − 1))"""
        s, a, b = self.weights.shape
        hull = np.einsum("sak,...sk->...sa", self.from_known, on_line[..., self.known])
        return np.concatenate([hull[..., None], beside.reshape(*beside.shape[:-1], s, a, b - 1)], axis=-1)

    def gradient(self, values):
        """Gradient of values (…, s, a, b); shape (…, s, a, b, 2)"""
        s = np.einsum("ij,...sjb->...sib", self.over_side, values)
        t = np.einsum("ij,...saj->...sai", self.outwards, values)
        return s[..., None] * self.along + t[..., None] * self.across


def strips_about(mesh, line, circle, k):
    """[`Strips`] of the meshed part of a hull, grouped by their number of points.

    line : `hull_interpolation.HullQuadrature` of the waterline; k : wavenumber of the shortest waves, rad/m
    raises : ValueError for a hull without a waterline, or whose waterline is not one star-shaped curve
    """
    panels, sides = _sides(mesh)
    start, end = (_angles(sides[:, i], np.zeros(2), circle, 0.0)[0] for i in range(2))
    turn = np.angle(np.exp(1j * (end - start)))
    if not (np.all(turn > 0) and abs(np.sum(turn) * len(mesh.reflections()) - 2 * np.pi) < 1e-6):
        raise ValueError(
            "the free-surface forcing needs a waterline that is one closed curve, with each point visible from its "
            "middle; give --level body, which leaves out only this part of the force (the forcing between several "
            "columns is not computed at any level)"
        )
    length = np.hypot(*(sides[:, 1] - sides[:, 0]).T)
    counts = np.clip(np.ceil(2 + k * np.maximum(turn * circle.radius, length)), FEWEST, MOST).astype(int)
    wide = circle.radius - np.hypot(*(sides.mean(axis=1) - circle.centre).T)
    waves = PER_RADIAN * k * wide
    across = np.maximum(np.minimum(OUTWARDS + waves, np.sqrt(CLOSEST * wide / length)), LEAST_OUTWARDS + waves)
    kinds, kind = np.unique(np.stack([counts, np.ceil(across).astype(int)], axis=1), axis=0, return_inverse=True)
    known = _known(panels, sides, line)
    for spread in SPREADS:
        out = []
        for number, (count, outwards) in enumerate(kinds):
            own = kind.ravel() == number
            out.append(_strips(sides[own], [part[own] for part in known], circle, count, outwards, spread))
        if all(part.even for part in out):
            break
    return out


def _sides(mesh):
    """Panels (s,) along the waterline and ends (s, 2, 2) of their sides there, counter-clockwise about the body"""
    v, level = mesh.vertices, 1e-6 * mesh.draft
    wet = v[:, :, 2] > -level
    following = np.roll(v, -1, axis=1)
    long = np.linalg.norm(following - v, axis=2) > 0
    panel, corner = np.nonzero(wet & np.roll(wet, -1, axis=1) & long)
    if not len(panel):
        raise ValueError("the free-surface forcing needs a hull with a waterline; allowed: --level body")
    ends = np.stack([v[panel, corner], following[panel, corner]], axis=1)[..., :2]
    along, normal = ends[:, 1] - ends[:, 0], mesh.normals[panel, :2]
    backwards = normal[:, 0] * along[:, 1] - normal[:, 1] * along[:, 0] < 0
    ends[backwards] = ends[backwards, ::-1]
    return panel, ends


def _known(panels, sides, line):
    """Numbers (s, 4) of the waterline's points on each side, in order, and the end (s,) where they are dense: 0, −1,
    1"""
    points, count = line.points[..., :2], line.points.shape[1]
    x = np.polynomial.legendre.leggauss(count)[0]
    order, dense = np.empty((len(sides), count), int), np.empty(len(sides), int)
    kinds = {0: (1 + x) / 2, -1: ((1 + x) / 2) ** 3, 1: 1 - ((1 - x) / 2) ** 3}
    for n, (panel, (start, end)) in enumerate(zip(panels, sides, strict=True)):
        rows, along = np.flatnonzero(line.panels == panel), end - start
        away = points[rows] - start
        off = np.abs(away[..., 0] * along[1] - away[..., 1] * along[0]).max(axis=1)
        row = rows[np.argmin(off)]
        place = (points[row] - start) @ along / (along @ along)
        order[n] = row * count + np.argsort(place)
        dense[n] = min(kinds, key=lambda kind: np.abs(np.sort(place) - kinds[kind]).max())
    return order, dense


def _angles(points, slope, circle, spread):
    """Angle on the circle at which the strips of waterline points (…, 2) end, and its change with theirs, `slope`

    spread : 0 for the rays from the middle, 1 for what these are on the ellipse of the same extents
    """
    out = []
    for half in (np.ones(2), circle.half):
        (x, y), (dx, dy) = (np.moveaxis(part / half, -1, 0) for part in (points - circle.centre, slope))
        out.append((np.arctan2(y, x), (x * dy - y * dx) / (x * x + y * y)))
    (ray, turn), (other, other_turn) = out
    return ray + spread * np.angle(np.exp(1j * (other - ray))), turn + spread * (other_turn - turn)


def _strips(sides, known, circle, along, across, spread):
    (x, w), (y, v), (order, dense) = np.polynomial.legendre.leggauss(along), _radau(across), known
    out = (1 + y) / 2
    side = (sides[:, 1] - sides[:, 0])[:, None]
    inside = (1 + x) / 2
    P, slope = sides[:, :1] + inside[:, None] * side, 0.5 * side + np.zeros((len(x), 1))  # (s, a, 2)
    angle, turn = _angles(P, slope, circle, spread)
    ray, normal = (np.stack([np.cos(a), np.sin(a)], axis=-1) for a in (angle, angle + np.pi / 2))
    C, turn = circle.centre + circle.radius * ray, circle.radius * turn[..., None] * normal
    share = out[:, None]
    points = P[:, :, None] * (1 - share) + C[:, :, None] * share
    a = slope[:, :, None] * (1 - share) + turn[:, :, None] * share  # ∂/∂x
    b = 0.5 * (C - P)[:, :, None] + 0 * a  # ∂/∂y
    area = b[..., 0] * a[..., 1] - b[..., 1] * a[..., 0]
    gradient_a = np.stack([-b[..., 1], b[..., 0]], axis=-1) / area[..., None]
    gradient_b = np.stack([a[..., 1], -a[..., 0]], axis=-1) / area[..., None]
    graded = np.select(
        [dense[:, None] == -1, dense[:, None] == 1], [2 * np.cbrt(inside) - 1, 1 - 2 * np.cbrt(1 - inside)], x
    )
    given, vander = np.polynomial.legendre.leggauss(order.shape[1])[0], np.polynomial.legendre.legvander
    from_known = vander(graded, len(given) - 1) @ np.linalg.inv(vander(given, len(given) - 1))
    weights = area * w[:, None] * v
    return Strips(points, weights, gradient_a, gradient_b, _derivative(x), _derivative(y), order, from_known)


def _radau(count):
    """Points and weights of Gauss and Radau on −1 … 1, −1 the first"""
    legendre = np.polynomial.legendre
    last = legendre.legadd([0] * (count - 1) + [1], [0] * count + [1])
    x = np.sort(legendre.legroots(last).real)
    x[0] = -1.0
    return x, (1 - x) / (count * legendre.legval(x, [0] * (count - 1) + [1])) ** 2


def _derivative(x):
    """Derivative at points of the polynomial through values there; shape (n, n)"""
    n = len(x)
    powers = np.polynomial.legendre.legvander(x, n - 1)
    slopes = np.polynomial.legendre.legval(x, np.polynomial.legendre.legder(np.eye(n))).T
    return slopes @ np.linalg.inv(powers)


class SurfaceInfluence:
    """Potentials at points (p, 3) in the water from the potentials on the hull of a `Geometry` without lid"""

    def __init__(self, geometry, points):
        self.geometry, self.points = geometry, points
        self.reach = 1.01 * float(np.hypot(*points[:, :2].T).max() + geometry.radius)
        self.deepest = max(geometry.draft, float(-points[:, 2].min()))
        self.S, self.D = geometry.rankine_rows(self.points)[:2]
        self.close = quadrature(geometry.panels, geometry.elements, COARSE, CLOSE)

    def values(self, run, flows, count=None):
        """Potentials {class: (c, p)} of flows {class: (φ (c, n), V (c, n))} at the frequency of a run, at the first
        `count`
            points"""
        g, problem, classes = self.geometry, run.problem, list(flows)
        table = wave_table(run.omega, problem.depth, problem.gravity, self.reach, self.deepest)
        Z, count = depth_values(run.k, problem.depth), len(self.points) if count is None else count
        nodes = np.arange(g.hull)
        longest = PER_WAVE * min(1 / run.k, problem.depth)  # with larger sizes all points would need the finer rule
        pairs = Pairs.of(g, nodes[:1], nodes, classes)
        pairs = pairs._replace(quadrature=self.close, sizes=np.minimum(pairs.sizes, longest))
        out = {cls: np.empty((len(phi), count), complex) for cls, (phi, _) in flows.items()}
        for start in range(0, count, ROWS):
            rows = slice(start, min(start + ROWS, count))
            S, D = pairs._replace(at=self.points[rows]).blocks(table, Z)
            for i, cls in enumerate(classes):
                own = g.classes.index(cls)
                phi, V = flows[cls]
                S[i] += self.S[own, rows]
                D[i] += self.D[own, rows]
                out[cls][:, rows] = (phi @ D[i].T - V @ S[i].T) / (4 * np.pi)
        return out
