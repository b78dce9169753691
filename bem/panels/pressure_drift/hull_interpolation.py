"""Potential and its gradient at quadrature points of a hull, interpolated from the nodes of panels in a row.

Away from edges φ is the polynomial through the six nodes of a panel and its neighbours in each direction.  At a
distance r from an edge φ = c₀ + c₁ r^μ + c₂ r^(2μ) + c₃ r^(3μ) …, and |∇φ|² is singular like r^(2μ−2): on the panel
at the edge these powers are fitted to the nodes of two panels, on the next panel to the nodes of three panels. The
nodal values near the edge are corrected for their known collocation error (`edge_flow`).
Fewer panels in the row give fewer powers.
Twisted panels are solved as flat ones with gaps between them, and the errors of their nodal values alternate from node
to node: in a row with a twisted panel half of the powers, and one more, are fitted by least squares. With interpolation
instead, the drift by pressure of a ship with V-shaped ends had an error of 7 times the largest drift; it has 0.06 times
now.

On the panel at the edge the points are at r ~ t³, with t the Gauss points, so that the integrand is smooth for μ = 2/3.
"""

from typing import NamedTuple

import numpy as np

from .edge_flow import at_nodes, nodal_errors
from .edges import SIDES, Stencils, stencils

POINTS = 4  # interpolation points in each direction of a panel
NODES = 6  # largest number of nodes in each direction
LARGEST = 25.0  # growth of errors in one direction: up to 12 on graded boxes and buoys, 70 to 230 at the ends of ships
TWIST = 1e-3  # distance of corners from the flat panel over its shortest side, above which a panel is twisted
SLIVER = 0.3  # collocation error of the first node of panels that are thin relative to those beyond the edge


class HullQuadrature(NamedTuple):
    """n panels with q points each; φ is interpolated from m nodes of `bem.panels.elements`."""

    panels: np.ndarray  # (n,)
    points: np.ndarray  # (n, q, 3) m
    weights: np.ndarray  # (n, q) m², or m on a line
    nodes: np.ndarray  # (n, m) numbers of the nodes
    images: np.ndarray  # (n, m) index in `mesh.reflections()` of their image, seen from the panel
    shape: np.ndarray  # (n, q, m) from nodal values to φ
    gradient: np.ndarray  # (n, q, 3, m) 1/m, to ∇φ along the panel
    edge: np.ndarray  # (n, 3) m, a point of the edge, NaN without one


def hull_quadrature(mesh, exponents, depth=np.inf):
    """`HullQuadrature` on the panels of a PanelMesh; exponents : (n, 4) as in `edges.sharp_sides`; depth : m"""
    both, twisted = _stencils(mesh, exponents, depth), twisted_panels(mesh)
    return _quadrature(mesh, np.arange(len(mesh)), both, [_line_rule(stencil, twisted) for stencil in both])


def side_quadrature(mesh, exponents, panels, sides, depth=np.inf):
    """`HullQuadrature` along sides (0 … 3, from corner i to i + 1) of panels, weights in m"""
    both, twisted, out = _stencils(mesh, exponents, depth), twisted_panels(mesh), []
    for across, ends in enumerate(SIDES):  # across : direction that leads to the side
        for end, side in zip((-1, 1), ends, strict=True):
            selected = panels[sides == side]
            rows = [Stencils(*(part[selected] for part in stencil)) for stencil in both]
            rules = [_line_rule(row, twisted) for row in rows]
            rules[across] = _line_rule(rows[across], twisted, end)
            out.append(_quadrature(mesh, selected, both, rules, 1 - across))
    return HullQuadrature(*(np.concatenate(parts) for parts in zip(*out, strict=True)))


def _stencils(mesh, exponents, depth):
    """Both `Stencils` of a mesh, with a count of 0 where φ is constant in a direction: across triangles, whose width is
    zero at a corner, and on twisted panels alone at two edges.  From nodal values with errors both would have flow
    without bound"""
    twisted, sides = twisted_panels(mesh), _side_lengths(mesh)
    both = stencils(mesh, exponents, depth, lambda stencil: _steady(stencil, twisted))
    corner = twisted & np.all([one.at_edge & (one.count == 1) for one in both], axis=0)
    narrow = [corner | (sides[:, ends] == 0).any(axis=1) for ends in SIDES[::-1]]
    return tuple(one._replace(count=np.where(there, 0, one.count)) for one, there in zip(both, narrow, strict=True))


def _side_lengths(mesh):
    """m, 0 where corners coincide; shape (n, 4)"""
    return np.linalg.norm(np.roll(mesh.vertices, -1, axis=1) - mesh.vertices, axis=2)


def twisted_panels(mesh):
    """Whether the corners of each panel are off its plane; shape (n,)"""
    off = np.linalg.norm(mesh.flat_vertices - mesh.vertices, axis=2).max(axis=1)
    sides = _side_lengths(mesh)
    return off > TWIST * np.where(sides > 0, sides, np.inf).min(axis=1)


def _steady(stencil, *twisted):
    """Whether errors of nodal values grow at most LARGEST times between nodes of `Stencils`, without slivers; shape
    (n,)"""
    growth = np.abs(_line_rule(stencil, *twisted).shape).sum(axis=-1).max(axis=1)
    return (growth < LARGEST) & (_missed(stencil).max(axis=1) < SLIVER)


def _missed(stencil):
    """`edge_flow.nodal_errors`, 0 away from edges; shape (n, NODES)"""
    at_edge, out = stencil.at_edge, np.zeros((len(stencil.own), NODES))
    measures = stencil.lengths, stencil.across, stencil.mu, stencil.gap
    out[at_edge] = nodal_errors(*(part[at_edge] for part in measures))
    return out


def _quadrature(mesh, panels, both, rules, along=None):
    """`HullQuadrature` of some panels, or of lines on them in direction `along`, 0 of s, 1 of t"""
    (s, t), v = rules, mesh.flat_vertices[panels]
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
    return HullQuadrature(
        panels, points, weights, nodes, images, shape, gradient, _edge(mesh.flat_vertices, *both)[panels]
    )


class LineRule(NamedTuple):
    """One-dimensional rule across each of n panels: q points between −1 and 1, and the nodal basis functions at these
    points."""

    at: np.ndarray  # (n, q)
    weights: np.ndarray  # (n, q)
    shape: np.ndarray  # (n, q, NODES)
    slope: np.ndarray  # (n, q, NODES)


def _line_rule(stencil, twisted=None, at_end=None):
    """`LineRule` across panels of `Stencils`, or at one end of them, −1 or 1; distances are in lengths of the panel

    twisted : (n,) of all panels, as `twisted_panels`, or None for flat ones
    """
    x, w = np.polynomial.legendre.leggauss(POINTS)
    own = np.arange(len(stencil.own)), stencil.own
    lengths, end = stencil.lengths / stencil.lengths[own][:, None], stencil.end[:, None]
    if at_end is None:
        u, power = (1 + x) / 2, np.where(stencil.at_edge & (stencil.own == 0), 3, 1)[:, None]
        inside, weights = u**power, power * u ** (power - 1) * w
    else:
        inside, weights = (1 - end * at_end) / 2, np.ones(end.shape)
    before = (np.cumsum(lengths, axis=1) - lengths)[own][:, None]
    value, slope = _powers(before + inside, stencil.mu)
    factors = _factors(stencil, lengths, False if twisted is None else twisted[stencil.panels].any(axis=1))
    return LineRule(end * (1 - 2 * inside), weights, value @ factors, -end[..., None] / 2 * (slope @ factors))


def _powers(r, mu):
    """r^(pμ), p = 0 … NODES − 1, and their derivatives, two (n, q, NODES)"""
    p, r = mu[:, None, None] * np.arange(NODES), r[..., None]
    return r**p, p * r ** np.where(p == 0, 0, p - 1)


def _factors(stencil, lengths, fitted=False):
    """Factors from nodal values to coefficients of the powers; shape (n, NODES, NODES); zero beyond the existing
    nodes

    fitted : (n,) whether fewer powers than nodes are fitted by least squares
    """
    missed, out = _missed(stencil), np.zeros((len(lengths), NODES, NODES))
    for panels in (1, 2, 3):
        here, m = stencil.count == panels, 2 * panels
        values = _powers(at_nodes(lengths[here, :panels]), stencil.mu[here])[0][..., :m]
        values[..., 1] *= 1 + missed[here, :m]
        out[here, :m, :m] = np.linalg.inv(values)
        some = here & fitted
        out[some, panels + 1 :] = 0.0
        out[some, : panels + 1, :m] = np.linalg.pinv(values[some[here], :, : panels + 1])
    sliver = (stencil.count == 1) & (missed[:, 0] >= SLIVER)  # only the second node is usable
    out[sliver] = 0.0
    out[sliver, 0, 1] = 1.0
    out[stencil.count == 0, 0, :2] = 0.5
    return out


def _nodes(s, t):
    """Indices of the nodes of the product stencils, and their images; shape (n, NODES²)"""
    (panel_s, at_s, image_s), (_, at_t, image_t) = _through(s), _through(t)
    panel_t = t.row.repeat(2, axis=1)
    panel = np.where(t.count[:, None, None] > 1, panel_t[panel_s], panel_s[:, :, None])
    nodes = 4 * panel + 2 * at_s[:, :, None] + at_t[:, None]
    return nodes.reshape(len(nodes), -1), (image_s[:, :, None] ^ image_t[:, None]).reshape(len(nodes), -1)


def _through(stencil):
    """Panels of the nodes, index of the node on each, and their images, (n, NODES) each; arbitrary beyond `count`"""
    panels, images, forward = (part.repeat(2, axis=1) for part in (stencil.panels, stencil.images, stencil.forward))
    order = np.arange(NODES) % 2  # 0 where distances begin
    return panels, np.where(forward, order, 1 - order), images


def _edge(v, s, t):
    """The point of the edge nearest to the panel's middle, or the corner of two edges, m; shape (n, 3); NaN without
    edge"""
    corner = np.where(t.at_edge & (t.count > 1), t.row[s.first, 0], s.first)
    S, T = (np.where(stencil.at_edge, stencil.end, 0)[:, None] for stencil in (s, t))
    shape = (1 + np.array([-1, 1, 1, -1]) * S) * (1 + np.array([-1, -1, 1, 1]) * T) / 4
    point = np.einsum("na,nac->nc", shape, v[corner])
    return np.where((s.at_edge | t.at_edge)[:, None], point, np.nan)
