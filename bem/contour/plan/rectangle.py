"""Plane problems outside and inside a rectangle, for the depth modes of a box; `circle` defines the maps.

Velocity is expanded in Legendre polynomials over each side, P_m(2y/B) on the ends and P_m(2x/L) on the sides. In the
gap under the keel the velocity is smooth along a side up to the corner of the box.
The resulting potentials are not smooth
(r^(2/3) at the corner). They are found at the nodes of `panels` by integral equations of the direct kind,

    outside  (½ − D) φ = −S ∂φ/∂n        inside  (½ + D) φ = S ∂φ/∂n        wall  (½ − D) φ = exp(ik·x)

Outside, the equation of waves is singular where k is an eigenvalue of the interior (φ = 0 on the contour, for instance
k² = π²(1/L² + 1/B²)).  The exterior representation of the potential vanishes inside the contour. This condition, at
some interior points, is added by least squares (Schenck 1968).
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import legvander

from ...froude_krylov import box_incident_force
from .layers import Layers, decaying, laplace, layers, radiating
from .maps import CLASSES, Contour, WaveMap, table_wavenumber
from .panels import Panels, gauss_rule, quarter_panels
from .plane_waves import plane_wave_values

# additional nodes on a panel for κ = 0: the flow in a low gap magnifies the map's errors, and it is computed only once
FURTHER = 3
# nodes that a panel has at least, and for how many polynomials one more.  With as many of them to a wave, panels of six
# left 1e-6 of the forces under 30 waves along a box, 2e-3 under 60, 0.2 under 100
FEWEST, PER_NODE = 5, 64


@dataclass(frozen=True)
class Rectangle:
    """A rectangle `length` along x, `beam` along y, m.

    nodes : Gauss nodes per panel; count : Gauss nodes on a piece of a panel near a target
    extra : polynomials per side and class beyond those needed for waves
    further : further polynomials on the shorter side, added after rounding, and in proportion on the longer side
    """

    length: float
    beam: float
    nodes: int
    count: int
    extra: int
    further: int = 0

    @classmethod
    def to_digits(cls, length, beam, digits):
        """Resolution for a relative error of 10^(−digits), found by tests/bench/contour.py"""
        nodes, count, extra = round(1.6 * digits + 1), round(1.6 * digits + 0.5), round(1.4 * digits - 1)
        return cls(float(length), float(beam), nodes, count, max(extra, 1))

    @property
    def sizes(self):
        """Return (length, beam), m"""
        return self.length, self.beam

    def to(self, accuracy):
        """The same plan resolved for an `accuracy.Accuracy`"""
        return replace(
            Rectangle.to_digits(self.length, self.beam, accuracy.plan), extra=accuracy.extra, further=accuracy.further
        )

    def for_degree(self, degree):
        """The same plan with panels fine enough for polynomials up to `degree`, because errors accumulate along a
        side"""
        least = FEWEST + int(np.ceil(max(degree) / PER_NODE))
        return replace(self, nodes=max(self.nodes, least), count=max(self.count, least))

    @property
    def alphas(self):
        """α of `rigid_motions` in heave, roll and pitch, for which ψ is curved across the body rather than along it"""
        return (self.beam**2 / (self.length**2 + self.beam**2),) * 3

    @property
    def reach(self):
        """Largest distance from the origin, m"""
        return np.hypot(self.length, self.beam) / 2

    @property
    def scale(self):
        """Length, m; κN approaches its limit for waves that are short compared with this length"""
        return min(self.length, self.beam) / 2

    def degree(self, waves, tolerance):
        """Highest polynomial degrees (end, side); `waves`, rad/m, is the largest wavenumber under the keel.

        The flow near a corner extends over the shorter side. To resolve a length δ at the end of a side, polynomials
        need a degree like δ^(−1/2).  The coefficients of the Legendre series of a wave begin to decay at the degree
        x, the phase of the wave along half the side in rad, within a number of degrees proportional to x^(1/3).
        """
        sides = np.array([self.beam, self.length])
        reach = np.sqrt(sides / sides.min())
        turns, digits = waves * sides / 2, -np.log10(tolerance)
        need = 4 * np.ceil((turns + np.maximum(2 * self.extra * reach, (1 + digits / 2) * np.cbrt(turns))) / 4)
        return tuple(int(d) for d in need + 2 * self.further * np.ceil(reach))

    def table_wavenumber(self, waves):
        """Largest wavenumber, rad/m, that a shared table resolves; at least `waves`"""
        return table_wavenumber(waves, max(self.length, self.beam) / 2)

    def orders(self, cls, degree):
        """Orders of the polynomials of a class on the end and on the side"""
        return tuple(
            np.arange(0 if sign == 1 else 1, d + 1, 2) for sign, d in zip((cls[1], cls[0]), degree, strict=True)
        )

    def subset(self, cls, degree, top):
        """Indices of the functions up to `degree` within those up to `top`; shape (n,)"""
        (end, side), first = map(len, self.orders(cls, degree)), len(self.orders(cls, top)[0])
        return np.append(np.arange(end), first + np.arange(side))

    def finest(self, degree):
        """Wavenumber along the contour, rad/m, that functions up to `degree` resolve"""
        return max(2 * np.subtract(degree, self.degree(0.0, 1.0)) / (self.beam, self.length))

    def polynomial_contour(self, degree):
        """Gauss nodes that integrate products of polynomials of `degree` and of the rigid motions exactly."""
        (t, w), (s, v) = (gauss_rule(d + 4) for d in degree) if np.ndim(degree) else [gauss_rule(degree + 4)] * 2
        a, b = self.length / 2, self.beam / 2
        zero, one = np.zeros(len(t)), np.ones(len(t))
        none, ones = np.zeros(len(s)), np.ones(len(s))
        return Contour(
            np.concatenate([a * one, a * s]), np.concatenate([b * t, b * ones]), np.concatenate([one, none]),
            np.concatenate([zero, ones]), np.concatenate([b * w, a * v]),
        )  # fmt: skip

    def basis(self, cls, degree, contour):
        """Functions ψ at the nodes; shape (m, n): end then side, each with its polynomials of the class in increasing
        order"""
        columns = []
        for side, (m, extent) in enumerate(zip(self.orders(cls, degree), (self.beam, self.length), strict=True)):
            here = (contour.nx > 0.5) if side == 0 else (contour.ny > 0.5)
            along = 2 * (contour.y if side == 0 else contour.x)[here] / extent
            columns.append(np.zeros((len(here), len(m))))
            columns[-1][here] = np.sqrt((2 * m + 1) / (2 * extent)) * legvander(along, max(m[-1:], default=0))[:, m]
        return np.hstack(columns)

    def panels(self, k, degree):
        """Panels that resolve waves of `k` rad/m and polynomials up to `degree`"""
        corner, longest = [], []
        for d, extent in zip(degree, (self.beam / 2, self.length / 2), strict=True):
            phase = 0.7 * self.nodes  # rad on a panel; polynomials oscillate with phase d √(2r / extent) near their end
            corner.append(min(self.scale, phase / max(k, 1e-300), extent * (phase / d) ** 2 / 2))
            longest.append(phase / max(k, d / extent))
        return quarter_panels(self.length / 2, self.beam / 2, corner, longest, self.nodes)

    def wave_layout(self, k, degree):
        """`Layout` for waves of k rad/m; all k between neighbouring powers of 1.2 share a layout, and so do all long
        waves."""
        return _wave_layout(*self._wave_arguments(k, degree))

    def _wave_arguments(self, k, degree):
        """Arguments of `_wave_layout` for waves of k rad/m"""
        fine = self.for_degree(degree)
        shortest = fine.nodes / (self.length + self.beam)
        step = np.ceil(np.log(max(k / shortest, 1.0)) / np.log(1.2))
        return fine, shortest * 1.2**step, degree

    def contour(self, k, degree, tolerance):
        """`Contour` of the nodes for waves of k rad/m"""
        return _wave_panels(*self._wave_arguments(k, degree)).contour

    def layers(self, panels, smallest):
        c = panels.contour
        return layers(panels, c.x, c.y, np.arange(len(c.x)), self.count, smallest)

    def maps(self, degree, kappa):
        """{class: κ times the maps outside and inside, two arrays (c, n, n)} at `kappa` (c,) rad/m"""
        fine = self.for_degree(degree)
        panels = fine.panels(0.0, degree)
        on_contour = fine.layers(panels, 3 / kappa[-1])
        bases = {cls: self.basis(cls, degree, panels.contour) for cls in CLASSES}
        weak = {cls: 4 * (bases[cls] * on_contour.weights[:, None]).T for cls in CLASSES}
        half = np.eye(len(on_contour.weights)) / 2
        out = {cls: ([], []) for cls in CLASSES}
        for value in kappa:
            for cls, S, D in zip(CLASSES, *on_contour.matrices(decaying(value), CLASSES), strict=True):
                source = value * S @ bases[cls]
                out[cls][0].append(-weak[cls] @ np.linalg.solve(half - D, source))
                out[cls][1].append(weak[cls] @ np.linalg.solve(half + D, source))
        return {cls: tuple(np.array(m) for m in pair) for cls, pair in out.items()}

    def laplace(self, degree):
        """{class: the maps outside and inside for κ = 0, two arrays (n, n)}, with zero mean where a constant is
        arbitrary"""
        fine = self.for_degree(degree)
        fine = replace(fine, nodes=fine.nodes + FURTHER, count=fine.count + FURTHER)
        panels = fine.panels(0.0, degree)
        on_contour = fine.layers(panels, np.inf)
        half, w, out = np.eye(len(on_contour.weights)) / 2, on_contour.weights / on_contour.weights.sum(), {}
        for cls, S, D in zip(CLASSES, *on_contour.matrices(laplace, CLASSES), strict=True):
            basis = self.basis(cls, degree, panels.contour)
            weak = 4 * (basis * on_contour.weights[:, None]).T
            free = np.outer(np.ones(len(w)), w) if cls == (1, 1) else 0.0
            source = S @ (basis - free @ basis if cls == (1, 1) else basis)
            inner = np.linalg.solve(half + D + free, source)
            inner = inner - free @ inner if cls == (1, 1) else inner
            outer = np.linalg.solve(half - D, source) if cls != (1, 1) else inner * np.nan
            out[cls] = -weak @ outer, weak @ inner
        return out

    def waves(self, classes, degree, k, contour, beta):
        """{class: `WaveMap`} for waves of `k` rad/m and incident waves towards `beta` (b,)"""
        at = self.wave_layout(k, degree)
        kernels, half, out = radiating(k), np.eye(len(contour.x)) / 2, {}
        S, D = at.on_contour.matrices(kernels, classes)
        S_in, D_in = at.at_interior.matrices(kernels, classes)
        for c, cls in enumerate(classes):
            basis = _wave_basis(*self._wave_arguments(k, degree), cls)
            matrix = np.vstack([half - D[c], -D_in[c]])
            velocity = -np.vstack([S[c], S_in[c]]) @ basis
            known = [plane_wave_values(cls, place, k, beta) for place in (contour, at.interior)]
            answer = _least_squares(matrix, np.hstack([velocity, np.vstack(known)]))
            potential, wall = np.split(answer, [basis.shape[1]], axis=1)
            out[cls] = WaveMap.solved(contour, basis, potential, wall)
        return out

    def incident_force(self, draft, depth, k, beta):
        """Force of the undisturbed wave per unit amplitude and ρg; shape (b, 6)"""
        return box_incident_force(self.length, self.beam, draft, depth, k, beta)


class WaveLayout(NamedTuple):
    """Panels, their nodes on the contour, interior points, and `Layers` whose targets are the nodes and the interior
    points."""

    panels: Panels
    contour: Contour
    interior: Contour
    on_contour: Layers
    at_interior: Layers


@lru_cache(maxsize=64)
def _wave_panels(rectangle, k, degree):
    return rectangle.panels(k, degree)


@lru_cache(maxsize=8)
def _wave_layout(rectangle, k, degree):
    panels = _wave_panels(rectangle, k, degree)
    n = np.arange(1, int(8 + k * np.hypot(rectangle.length, rectangle.beam) / 4) + 1)
    x = 0.45 * rectangle.length * ((n * (np.sqrt(5) - 1) / 2) % 1.0)  # irrational steps: no nodal line contains many
    y = 0.45 * rectangle.beam * ((n * (np.sqrt(2) - 1)) % 1.0)
    at_interior = layers(panels, x, y, np.full(len(n), -1), rectangle.count, 3 / k)
    return WaveLayout(
        panels, panels.contour, Contour(x, y, 0 * x, 0 * x, 0 * x), rectangle.layers(panels, 3 / k), at_interior
    )


@lru_cache(maxsize=32)
def _wave_basis(rectangle, k, degree, cls):
    """`Rectangle.basis` at the nodes of a `Layout`"""
    return rectangle.basis(cls, degree, _wave_layout(rectangle, k, degree).contour)


def _least_squares(matrix, right):
    """x of smallest |matrix x − right|; the equations are consistent and well conditioned, so normal equations do."""
    from scipy.linalg.blas import zherk
    from scipy.linalg.lapack import zposv

    normal = zherk(1.0, matrix.T).conj()  # the upper triangle, in half the time of a product
    _, x, fault = zposv(normal, matrix.conj().T @ right)
    if fault:
        raise np.linalg.LinAlgError(f"normal equations of a plane problem: row {fault} is not positive")
    return x
