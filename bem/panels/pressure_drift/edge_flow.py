"""Flow around a sharp edge, and the collocation error of panels with linear potential next to the edge.

The two faces of an edge enclose the angle γ = 2π − π/μ; φ is r^μ on one face and −r^μ on the other, and

    φ(r) = −(1/π) ∫ K φ(ρ) dρ,    K = r sin γ / (r² + ρ² − 2rρ cos γ).

If the panels of both faces have equal size, collocation with φ linear on every panel gives values that are 6 % too
large at the first node, 1 % too large at the second node, and less wrong beyond. A finer mesh has the same relative
errors.

If a side stands on a flat bottom with a gap of height s above the bed, and the panels are not small relative to the
gap, the flow at the edge is the flow out of the gap, by a conformal map,

    φ = a ln(1 + q²)  on the side,  q − arctan q = πr/2s,        φ = −2a ln cosh u  below,  u − tanh u = πr/2s,

with a = (2s/3π)^(2/3). This φ tends to ±r^(2/3) at the edge, to ln r far up the side, and to uniform flow far inside
the gap.  The images of both faces in the bed are included.
"""

from typing import NamedTuple

import numpy as np

NEAR, FAR = (1 - 1 / np.sqrt(3)) / 2, (1 + 1 / np.sqrt(3)) / 2  # nodes of a panel of unit length, from one end


def at_nodes(lengths):
    """Distances of nodes from an edge, with two nodes on each of m panels of `lengths` (n, m); shape (n, 2 m)"""
    start = np.cumsum(lengths, axis=1) - lengths
    return (start[..., None] + lengths[..., None] * [NEAR, FAR]).reshape(len(lengths), 2 * lengths.shape[1])


def nodal_errors(lengths, across, mu, gap=np.inf):
    """Relative collocation errors of φ = r^μ at the nodes of m panels, `lengths` (n, m), m, from the edge; shape (n, 2
    m).

    across : lengths of the panels on the other face, m, (n, m); mu : exponents μ, (n,)
    gap : height of water between the other face and the bed, m, (n,), for an edge of 270° with a side above it; or
        infinite. The quadrature does not resolve gaps below a tenth of the first panel; `mean_drift` warns at larger
        gaps
    """
    flow = EdgeFlow(mu[:, None, None, None], np.broadcast_to(gap, mu.shape)[:, None, None, None])
    here, there = (at_nodes(face)[:, :, None, None] for face in (lengths, across))
    above, below = (flow.above, here, lengths), (flow.below, there, across)
    to_above, missed_above = _interpolated_integral(flow.onto_above, here, *below)
    to_below, missed_below = _interpolated_integral(flow.onto_below, there, *above)
    below_itself, missed_itself = _interpolated_integral(flow.bed, there, *below)
    zero = np.zeros_like(below_itself)
    matrix = np.concatenate(
        [np.concatenate(pair, axis=2) for pair in ((zero, to_above), (to_below, below_itself))], axis=1
    )
    missed = np.concatenate([missed_above, missed_below + missed_itself], axis=1)
    errors = np.linalg.solve(np.eye(matrix.shape[1]) - matrix, missed[..., None])[:, : here.shape[1], 0]
    return errors / here[..., 0, 0] ** mu[:, None]


def _interpolated_integral(kernel, at, flow, nodes, lengths):
    """(1/π) ∫ kernel · φ dρ at points `at` (n, k, 1, 1), with φ linear on every panel.

    returns : matrix (n, k, 2 m) from nodal values to the integral, and its error (n, k) for the φ of `flow`
    """
    x, w = np.polynomial.legendre.leggauss(16)
    u, start = (1 + x) / 2, np.cumsum(lengths, axis=1) - lengths
    power = np.where(np.arange(lengths.shape[1]) == 0, 3, 1)[:, None]
    t = u**power  # (m, q)
    rho = (start[..., None] + lengths[..., None] * t)[:, None]
    weights = lengths[..., None] * power * u ** (power - 1) * w / 2
    weighted = weights[:, None] * kernel(at, rho) / np.pi
    lines = np.stack([FAR - t, t - NEAR], axis=-1) / (FAR - NEAR)
    matrix = np.einsum("nimq,mqa->nima", weighted, lines).reshape(*at.shape[:2], nodes.shape[1])
    exact = np.sum(weighted * flow(rho), axis=(2, 3))
    return matrix, np.einsum("nij,nj->ni", matrix, flow(nodes)[..., 0, 0]) - exact


class EdgeFlow(NamedTuple):
    """|φ| on the two faces of edges, and the kernels K(r, ρ) of each face on the other, including images in the bed.

    mu, gap : arrays that broadcast with the distances; r : distance of the point, m; rho : distance of the source, m
    """

    mu: np.ndarray
    gap: np.ndarray

    def above(self, r):
        q = _inverse(lambda q: q - np.arctan(q), lambda q: q * q / (1 + q * q), self._part(r))
        return self._or_power(r, np.log1p(q * q))

    def below(self, r):
        u = _inverse(lambda u: u - np.tanh(u), lambda u: np.tanh(u) ** 2, self._part(r))
        return self._or_power(r, 2 * (u + np.log1p(np.exp(-2 * u)) - np.log(2)))

    def onto_above(self, r, rho):
        down = r + 2 * self._height
        return self._between(r, rho) - self._image(down / (down**2 + rho**2))

    def onto_below(self, r, rho):
        return self._between(r, rho) + self._image(r / (r**2 + (rho + 2 * self._height) ** 2))

    def bed(self, r, rho):
        """Kernel of the bottom face on itself"""
        return self._image(2 * self._height / ((r - rho) ** 2 + 4 * self._height**2))

    @property
    def _height(self):
        return np.where(np.isfinite(self.gap), self.gap, 1.0)

    def _image(self, value):
        return np.where(np.isfinite(self.gap), value, 0.0)

    def _between(self, r, rho):
        gamma = 2 * np.pi - np.pi / self.mu
        return r * np.sin(gamma) / (r**2 + rho**2 - 2 * r * rho * np.cos(gamma))

    def _part(self, r):
        return np.pi * r / (2 * self._height)

    def _or_power(self, r, value):
        return np.where(np.isfinite(self.gap), value * (2 * self._height / (3 * np.pi)) ** (2 / 3), r**self.mu)


def _inverse(function, slope, value):
    """x of function(x) = value ≥ 0, for a function like x³/3 at small x and x minus a constant at large x"""
    x = value + np.cbrt(3 * value)
    for _ in range(8):  # Newton's method, from above the root of a convex function
        x -= (function(x) - value) / slope(x)
    return x
