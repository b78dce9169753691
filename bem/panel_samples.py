"""Potential and its slopes on every panel of a hull: straight lines between the nodes, but not near sharp edges.

At a distance r from an edge φ = c₀ + c₁ r^μ + c₂ r^(2μ) + c₃ r^(3μ) …, and |∇φ|² is singular like r^(2μ−2).  Next to
an edge φ is drawn so through nodes of three panels that lie behind one another, on the first two of them; with fewer
of them there are fewer powers.

Straight lines on the panels answer r^μ with values that are 6 % too large at the first node, 1 % at the second and
less behind, and no finer mesh has less.  That is a matter of the edge alone: between its faces, γ = 2π − π/μ apart,

    φ(r) = (1/π) ∫ r sin γ φ(ρ) dρ / (r² + ρ² − 2rρ cos γ),    φ = r^μ on the one and −r^μ on the other,

and solved with straight lines on the panels of the strip, taken to lie on both faces alike, this gives the values at
the nodes that mean c₁ = 1.

On the panel at the edge the points are at r ~ t³, t those of Gauss, which makes the integrand smooth for μ = 2/3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .panel_edges import strips

POINTS = 4  # in each direction of a panel
DRAWN = (0, 1), (0, 1, 2, 3), (1, 2, 3, 4)  # nodes, from the edge, of strips of one, two, three panels
NODES = 4  # in each direction, at most
NEAR, FAR = (1 - 1 / np.sqrt(3)) / 2, (1 + 1 / np.sqrt(3)) / 2  # nodes of a panel of unit length, from one end


class Samples(NamedTuple):
    """n panels with q points each; the potential is given at m of the nodes of `elements`."""

    points: np.ndarray  # (n, q, 3) m
    weights: np.ndarray  # (n, q) m²
    nodes: np.ndarray  # (n, m) their numbers
    shape: np.ndarray  # (n, q, m)
    gradient: np.ndarray  # (n, q, 3, m) 1/m, along the panel
    edge: np.ndarray  # (n, 3) m, a point of the edge, NaN where there is none


def samples(mesh, exponents):
    """`Samples` of a PanelMesh; exponents : (n, 4) as of `panel_edges.sharp_sides`"""
    v, both = mesh.flat_vertices, strips(mesh, exponents)
    s, t = (_line(strip) for strip in both)
    corner_s, corner_t = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    S, T = s.at[:, :, None, None], t.at[:, None, :, None]
    points = np.einsum("nija,nac->nijc", (1 + corner_s * S) * (1 + corner_t * T) / 4, v)
    along = np.einsum("nja,nac->njc", corner_s * (1 + corner_t * t.at[:, :, None]) / 4, v)
    across = np.einsum("nia,nac->nic", corner_t * (1 + corner_s * s.at[:, :, None]) / 4, v)
    along, across = np.broadcast_arrays(along[:, None], across[:, :, None])
    normal = np.cross(along, across)
    area = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = normal / area
    # ∇ = (b × n ∂/∂s + n × a ∂/∂t) / |a × b|
    shape, d_s, d_t = (
        np.einsum("nia,njb->nijab", a, b).reshape(*area.shape[:3], -1)
        for a, b in ((s.shape, t.shape), (s.slope, t.shape), (s.shape, t.slope))
    )
    up, left = (np.cross(*pair) / area for pair in ((across, normal), (normal, along)))
    gradient = up[..., None] * d_s[..., None, :] + left[..., None] * d_t[..., None, :]
    weights = s.weights[:, :, None] * t.weights[:, None] * area[..., 0]
    flat = (part.reshape(len(v), POINTS**2, *part.shape[3:]) for part in (points, weights, shape, gradient))
    points, weights, shape, gradient = flat
    return Samples(points, weights, _nodes(*both), shape, gradient, _edge(v, *both))


class Line(NamedTuple):
    """q points between −1 and 1 across each of n panels and the functions that are one at one of the nodes."""

    at: np.ndarray  # (n, q)
    weights: np.ndarray  # (n, q)
    shape: np.ndarray  # (n, q, NODES)
    slope: np.ndarray  # (n, q, NODES)


def _line(strip):
    """`Line` across panels of `Strips`; r is measured from the edge, in lengths of the panel"""
    x, w = np.polynomial.legendre.leggauss(POINTS)
    lengths = strip.lengths / strip.lengths[np.arange(len(strip.place)), np.maximum(strip.place, 0), None]
    u, power = (1 + x) / 2, np.where(strip.place == 0, 3, 1)[:, None]
    inside, before = u**power, np.where(strip.place == 1, lengths[:, 0], 0.0)[:, None]
    value, slope = _powers(before + inside, strip.mu)
    factors, end = _factors(strip, lengths), strip.end[:, None]
    return Line(
        end * (1 - 2 * inside), power * u ** (power - 1) * w,
        value @ factors, -end[..., None] / 2 * (slope @ factors),
    )  # fmt: skip


def _powers(r, mu):
    """r^(pμ), p = 0 … NODES − 1, and their derivatives, two (n, q, NODES)"""
    p, r = mu[:, None, None] * np.arange(NODES), r[..., None]
    return r**p, p * r ** (p - 1)


def _factors(strip, lengths):
    """(n, NODES, NODES) from values at the nodes to factors of the powers, of as many of both as there are"""
    out = np.zeros((len(lengths), NODES, NODES))
    for panels, nodes in enumerate(DRAWN, start=1):
        here, m = strip.count == panels, len(nodes)
        at, mu = _at_nodes(lengths[here, :panels]), strip.mu[here]
        values = _powers(at[:, nodes], mu)[0][..., :m]
        values[..., 1] *= 1 + nodal_errors(lengths[here, :panels], mu)[:, nodes]
        out[here, :m, :m] = np.linalg.inv(values)
    return out


def _at_nodes(lengths):
    """(n, 2 m) distances from the edge of the nodes of m panels of `lengths` (n, m)"""
    start = np.cumsum(lengths, axis=1) - lengths
    return (start[..., None] + lengths[..., None] * [NEAR, FAR]).reshape(len(lengths), 2 * lengths.shape[1])


def nodal_errors(lengths, mu):
    """(n, 2 m) relative errors of the nodes of m panels, `lengths` (n, m) from the edge, that answer r^μ, mu (n,)"""
    x, w = np.polynomial.legendre.leggauss(16)
    u, start, at = (1 + x) / 2, np.cumsum(lengths, axis=1) - lengths, _at_nodes(lengths)
    power = np.where(np.arange(lengths.shape[1]) == 0, 3, 1)[:, None]
    t = u**power  # (m, q)
    rho = start[..., None] + lengths[..., None] * t
    weights = lengths[..., None] * power * u ** (power - 1) * w / 2
    gamma, r = (2 * np.pi - np.pi / mu)[:, None, None, None], at[:, :, None, None]
    kernel = weights[:, None] * r * np.sin(gamma) / (r**2 + rho[:, None] ** 2 - 2 * r * rho[:, None] * np.cos(gamma))
    lines = np.stack([FAR - t, t - NEAR], axis=-1) / (FAR - NEAR)
    drawn = np.einsum("nimq,mqa->nima", kernel, lines).reshape(*at.shape, at.shape[1]) / np.pi
    exact = np.einsum("nimq,nmq->ni", kernel, rho ** mu[:, None, None]) / np.pi
    values = at ** mu[:, None]
    missed = np.einsum("nij,nj->ni", drawn, values) - exact
    return np.linalg.solve(np.eye(at.shape[1]) - drawn, missed[..., None])[..., 0] / values


def _nodes(s, t):
    """(n, NODES²) numbers of the nodes through which φ is drawn"""
    (panel_s, at_s), (panel_t, at_t) = _through(s), _through(t)
    panel = panel_t[panel_s]
    return (4 * panel + 2 * at_s[:, :, None] + at_t[:, None]).reshape(len(panel), -1)


def _through(strip):
    """Panels of the nodes and which of the two there, (n, NODES) each; what there is none of is any"""
    nodes = np.array([(*nodes, *[0] * (NODES - len(nodes))) for nodes in DRAWN])[strip.count - 1]
    order = nodes % 2  # 0 towards the edge
    panel = np.take_along_axis(strip.chain, nodes // 2, axis=1)
    return panel, np.where(strip.end[:, None] < 0, order, 1 - order)


def _edge(v, s, t):
    """(n, 3) the point of the edge next to the middle of the panel, or the corner of two edges"""
    corner = t.chain[s.chain[:, 0], 0]
    S, T = (np.where(strip.place >= 0, strip.end, 0)[:, None] for strip in (s, t))
    shape = (1 + np.array([-1, 1, 1, -1]) * S) * (1 + np.array([-1, -1, 1, 1]) * T) / 4
    point = np.einsum("na,nac->nc", shape, v[corner])
    return np.where(((s.place >= 0) | (t.place >= 0))[:, None], point, np.nan)
