"""Potential and its slopes on every panel of a hull, drawn through the nodes of panels that lie in line.

Away from edges φ is the polynomial through the six nodes of a panel and its neighbours in each direction.  At a
distance r from an edge φ = c₀ + c₁ r^μ + c₂ r^(2μ) + c₃ r^(3μ) …, and |∇φ|² is singular like r^(2μ−2): on the panel
there these powers are drawn through the nodes of two panels, on the one behind through those of three, and the values
at the nodes are known to answer r^μ wrongly (`edge_flow`).  With fewer panels in line there are fewer powers.

On the panel at the edge the points are at r ~ t³, t those of Gauss, which makes the integrand smooth for μ = 2/3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .edge_flow import at_nodes, nodal_errors
from .edges import SIDES, Strips, strips

POINTS = 4  # in each direction of a panel
NODES = 6  # in each direction, at most


class Samples(NamedTuple):
    """n panels with q points each; the potential is given at m of the nodes of `elements`."""

    panels: np.ndarray  # (n,)
    points: np.ndarray  # (n, q, 3) m
    weights: np.ndarray  # (n, q) m², or m on a line
    nodes: np.ndarray  # (n, m) their numbers
    images: np.ndarray  # (n, m) of `mesh.reflections()` on which they lie, seen from the panel
    shape: np.ndarray  # (n, q, m)
    gradient: np.ndarray  # (n, q, 3, m) 1/m, along the panel
    edge: np.ndarray  # (n, 3) m, a point of the edge, NaN where there is none


def samples(mesh, exponents, depth=np.inf):
    """`Samples` on the panels of a PanelMesh; exponents : (n, 4) as of `panel_edges.sharp_sides`; depth : m"""
    both = strips(mesh, exponents, depth)
    return _samples(mesh, np.arange(len(mesh)), both, [_line(strip) for strip in both])


def line_samples(mesh, exponents, panels, sides, depth=np.inf):
    """The same on sides (0 … 3, from corner i to i + 1) of panels, weighted with their lengths"""
    both, out = strips(mesh, exponents, depth), []
    for across, ends in enumerate(SIDES):  # across : which direction leads to the side
        for end, side in zip((-1, 1), ends, strict=True):
            mine = panels[sides == side]
            lines = [_line(Strips(*(part[mine] for part in strip))) for strip in both]
            lines[across] = _line(Strips(*(part[mine] for part in both[across])), end)
            out.append(_samples(mesh, mine, both, lines, 1 - across))
    return Samples(*(np.concatenate(parts) for parts in zip(*out, strict=True)))


def _samples(mesh, panels, both, lines, along=None):
    """`Samples` of some panels, or of lines on them in direction `along`, 0 of s, 1 of t"""
    (s, t), v = lines, mesh.flat_vertices[panels]
    corner_s, corner_t = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    S, T = s.at[:, :, None, None], t.at[:, None, :, None]
    points = np.einsum("nija,nac->nijc", (1 + corner_s * S) * (1 + corner_t * T) / 4, v)
    with_s = np.einsum("nja,nac->njc", corner_s * (1 + corner_t * t.at[:, :, None]) / 4, v)
    with_t = np.einsum("nia,nac->nic", corner_t * (1 + corner_s * s.at[:, :, None]) / 4, v)
    with_s, with_t = np.broadcast_arrays(with_s[:, None], with_t[:, :, None])
    normal = np.cross(with_s, with_t)
    area = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = normal / area
    # ∇ = (b × n ∂/∂s + n × a ∂/∂t) / |a × b|
    shape, d_s, d_t = (
        np.einsum("nia,njb->nijab", a, b).reshape(*area.shape[:3], NODES**2)
        for a, b in ((s.shape, t.shape), (s.slope, t.shape), (s.shape, t.slope))
    )
    up, left = (np.cross(*pair) / area for pair in ((with_t, normal), (normal, with_s)))
    gradient = up[..., None] * d_s[..., None, :] + left[..., None] * d_t[..., None, :]
    stretch = area[..., 0] if along is None else np.linalg.norm((with_s, with_t)[along], axis=-1)
    weights = s.weights[:, :, None] * t.weights[:, None] * stretch
    parts = points, weights, shape, gradient
    points, weights, shape, gradient = (p.reshape(len(v), s.at.shape[1] * t.at.shape[1], *p.shape[3:]) for p in parts)
    nodes, images = (part[panels] for part in _nodes(*both))
    return Samples(panels, points, weights, nodes, images, shape, gradient, _edge(mesh.flat_vertices, *both)[panels])


class Line(NamedTuple):
    """q points between −1 and 1 across each of n panels and the functions that are one at one of the nodes."""

    at: np.ndarray  # (n, q)
    weights: np.ndarray  # (n, q)
    shape: np.ndarray  # (n, q, NODES)
    slope: np.ndarray  # (n, q, NODES)


def _line(strip, at_end=None):
    """`Line` across panels of `Strips`, or at one end of all of them, −1 or 1; distances are in lengths of the panel"""
    x, w = np.polynomial.legendre.leggauss(POINTS)
    own = np.arange(len(strip.own)), strip.own
    lengths, end = strip.lengths / strip.lengths[own][:, None], strip.end[:, None]
    if at_end is None:
        u, power = (1 + x) / 2, np.where(strip.near & (strip.own == 0), 3, 1)[:, None]
        inside, weights = u**power, power * u ** (power - 1) * w
    else:
        inside, weights = (1 - end * at_end) / 2, np.ones(end.shape)
    before = (np.cumsum(lengths, axis=1) - lengths)[own][:, None]
    value, slope = _powers(before + inside, strip.mu)
    factors = _factors(strip, lengths)
    return Line(end * (1 - 2 * inside), weights, value @ factors, -end[..., None] / 2 * (slope @ factors))


def _powers(r, mu):
    """r^(pμ), p = 0 … NODES − 1, and their derivatives, two (n, q, NODES)"""
    p, r = mu[:, None, None] * np.arange(NODES), r[..., None]
    return r**p, p * r ** np.where(p == 0, 0, p - 1)


def _factors(strip, lengths):
    """(n, NODES, NODES) from values at the nodes to factors of the powers, of as many of both as there are"""
    missed, out = np.zeros((len(lengths), NODES)), np.zeros((len(lengths), NODES, NODES))
    near = strip.near
    missed[near] = nodal_errors(strip.lengths[near], strip.across[near], strip.mu[near], strip.gap[near])
    for panels in (1, 2, 3):
        here, m = strip.count == panels, 2 * panels
        values = _powers(at_nodes(lengths[here, :panels]), strip.mu[here])[0][..., :m]
        values[..., 1] *= 1 + missed[here, :m]
        out[here, :m, :m] = np.linalg.inv(values)
    return out


def _nodes(s, t):
    """(n, NODES²) numbers of the nodes through which φ is drawn, and the images on which they lie"""
    (panel_s, at_s, image_s), (panel_t, at_t, image_t) = _through(s), _through(t)
    panel = panel_t[panel_s]
    nodes = 4 * panel + 2 * at_s[:, :, None] + at_t[:, None]
    return nodes.reshape(len(nodes), -1), (image_s[:, :, None] ^ image_t[:, None]).reshape(len(nodes), -1)


def _through(strip):
    """Panels of the nodes, which of the two there, and their images, (n, NODES) each; what there is none of is any"""
    panels, images, forward = (part.repeat(2, axis=1) for part in (strip.panels, strip.images, strip.forward))
    order = np.arange(NODES) % 2  # 0 where distances begin
    return panels, np.where(forward, order, 1 - order), images


def _edge(v, s, t):
    """(n, 3) the point of the edge next to the middle of the panel, or the corner of two edges"""
    corner = t.first[s.first]
    S, T = (np.where(strip.near, strip.end, 0)[:, None] for strip in (s, t))
    shape = (1 + np.array([-1, 1, 1, -1]) * S) * (1 + np.array([-1, -1, 1, 1]) * T) / 4
    point = np.einsum("na,nac->nc", shape, v[corner])
    return np.where((s.near | t.near)[:, None], point, np.nan)
