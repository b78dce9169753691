"""Flow on panels that end at a sharp edge of the hull.

Where the hull turns by α, water of the angle π + α flows round an edge, and at a distance r from it the potential is

    φ = c₀ + c₁ r^μ + …,    μ = π / (π + α)        (2/3 at the edges of a box)

so that |∇φ|² is singular like r^(2μ−2).  Across a panel that ends there φ is interpolated by 1 and r^μ in place of
1 and r, and integrated at points of r ~ t³, t those of Gauss, which makes the integrand smooth for μ = 2/3.
Straight lines would miss 44 % of ∫ |∇φ|² dr on that panel.  In the rows behind r^μ gains nothing: what is left is the
error of c₁, which the solution with straight lines has.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

SHARP = np.pi / 3  # rad that the hull has to turn by: less is how panels draw a round hull
POINTS = 4  # in each direction of a panel


class Samples(NamedTuple):
    """n panels with q points each; the potential is given at the four nodes of `elements`."""

    points: np.ndarray  # (n, q, 3) m
    weights: np.ndarray  # (n, q) m²
    shape: np.ndarray  # (n, q, 4)
    gradient: np.ndarray  # (n, q, 3, 4) 1/m, along the panel


def samples(mesh, exponents):
    """`Samples` of a PanelMesh; exponents : (n, 4) as of `sharp_sides`"""
    s, t = (_line(exponents[:, a], exponents[:, b]) for a, b in ((3, 1), (0, 2)))
    n, v = len(mesh), mesh.flat_vertices
    corner_s, corner_t = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    S, T = s.at[:, :, None, None], t.at[:, None, :, None]
    points = np.einsum("nija,nac->nijc", (1 + corner_s * S) * (1 + corner_t * T) / 4, v).reshape(n, -1, 3)
    along = np.einsum("nja,nac->njc", corner_s * (1 + corner_t * t.at[:, :, None]) / 4, v)
    across = np.einsum("nia,nac->nic", corner_t * (1 + corner_s * s.at[:, :, None]) / 4, v)
    along, across = np.broadcast_arrays(along[:, None], across[:, :, None])
    normal = np.cross(along, across)
    area = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = normal / area
    # ∇ = (b × n ∂/∂s + n × a ∂/∂t) / |a × b|
    shape = np.einsum("nia,njb->nijab", s.shape, t.shape)
    d_s = np.einsum("nia,njb->nijab", s.slope, t.shape).reshape(*area.shape[:3], 1, 4)
    d_t = np.einsum("nia,njb->nijab", s.shape, t.slope).reshape(*area.shape[:3], 1, 4)
    up, left = (np.cross(*pair) / area for pair in ((across, normal), (normal, along)))
    gradient = up[..., None] * d_s + left[..., None] * d_t
    weights = s.weights[:, :, None] * t.weights[:, None] * area[..., 0]
    return Samples(points, weights.reshape(n, -1), shape.reshape(n, -1, 4), gradient.reshape(n, -1, 3, 4))


class Line(NamedTuple):
    """q points between −1 and 1 on each of n lines and the two functions, one at one of the Gauss points ±1/√3."""

    at: np.ndarray  # (n, q)
    weights: np.ndarray  # (n, q)
    shape: np.ndarray  # (n, q, 2)
    slope: np.ndarray  # (n, q, 2)


def _line(minus, plus):
    """`Line` for exponents (n,) at the ends −1 and 1; a line with two sharp ends is treated as if it had none."""
    x, w = np.polynomial.legendre.leggauss(POINTS)
    both = (minus < 1) & (plus < 1)
    mu = np.where(both, 1.0, np.minimum(minus, plus))[:, None]
    end, power = np.where(plus < 1, 1, -1)[:, None], np.where(mu < 1, 3, 1)
    u = (1 + x) / 2
    r = u**power  # from the end, of the length of the line
    nodes = ((1 - end * np.array([-1, 1]) / np.sqrt(3)) / 2) ** mu
    first, second = nodes[:, :1], nodes[:, 1:]
    shape = np.stack([second - r**mu, r**mu - first], axis=-1) / (second - first)[..., None]
    slope = (mu * r ** (mu - 1) * -end / 2 / (second - first))[..., None] * np.array([-1, 1])
    return Line(end * (1 - 2 * r), power * u ** (power - 1) * w, shape, slope)


def sharp_sides(mesh):
    """(n, 4) exponent μ of the flow at the side from corner i to i + 1 of every panel, 1 where it is not sharp"""
    hull = mesh.whole()
    out, (one, other) = np.ones(4 * len(hull)), _neighbours(hull)
    a, b = one // 4, other // 4
    turn = np.arccos(np.clip(np.sum(hull.normals[a] * hull.normals[b], axis=1), -1, 1))
    convex = np.sum((hull.centroids[b] - hull.centroids[a]) * hull.normals[a], axis=1) < 0
    out[one] = out[other] = np.where(convex & (turn > SHARP), np.pi / (np.pi + turn), 1.0)
    return out.reshape(-1, 4)[: len(mesh)]


def _neighbours(mesh):
    """Sides (4 · panel + side) that two panels share, two arrays"""
    v = mesh.vertices
    place = np.round(v.reshape(-1, 3) / (1e-6 * mesh.sizes.max())).astype(np.int64)
    number = np.unique(place, axis=0, return_inverse=True)[1].reshape(-1, 4)
    ends = np.sort(np.stack([number, np.roll(number, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    _, side, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    first = np.argsort(side.ravel(), kind="stable")[np.repeat(count, count) == 2]
    return first[::2], first[1::2]
