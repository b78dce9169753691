"""Imaginary part of the influence matrices S and D: a sum over a few standing waves, even or odd at each mirror plane.

    Im G = C Z(z) Z(ζ) J₀(kR),    J₀(kR) = ⟨cos(kΔx cos θ) cos(kΔy sin θ)⟩

where ⟨ ⟩ is the average over a quarter circle of directions θ.  With T equally spaced directions on the circle the
error is at most 2 J_T(kR).
 With f =
Z(z) times cos or sin of kx cos θ times cos or sin of ky sin θ, with cos or sin by the symmetry of the class at each
mirror plane, the sum over the images is Σ f(point) f(source).
The number of columns is the number of functions f and does not grow
with the number of nodes.
"""

from itertools import product

import numpy as np

from .wave_influence import COARSE, close_up_to


def standing_waves(geometry, classes, table, depth_values):
    """f at the nodes, and integrals of f and of ∂f/∂n over the panels; three real arrays (c, n, t).

    Im S = f (∫f)ᵀ, Im D = f (∫∂f/∂n)ᵀ of `bem.panels.wave_influence`; geometry : `bem.panels.influence.Geometry`
    table : `bem.green.tables.Table`; depth_values : z → (…, 2) of Z and Z′
    """
    g, e, k = geometry, geometry.elements, table.k
    if table.C == 0:
        return np.zeros((3, len(classes), len(e.nodes), 0))
    quarter = directions(k * g.reach)
    theta = (np.arange(quarter) + 0.5) * (np.pi / 2 / quarter)
    size = np.sqrt(table.C * len(g.images) / quarter)
    at_nodes = _waves(g, classes, k, theta, e.nodes, e.normals, depth_values)
    integrals = at_nodes * e.weights[:, None]
    short = np.isinf(close_up_to(e.sizes, k, g.depth)) | (e.inverse.shape[2] == 1)
    if np.any(short):
        points, weights, shape = (part[short, COARSE**2 :] for part in g.quadrature)
        normals = np.repeat(e.axes[short, 2], points.shape[1], axis=0)
        there = _waves(g, classes, k, theta, points.reshape(-1, 3), normals, depth_values)
        there = there.reshape(2, len(classes), *weights.shape, -1)
        nodes = np.flatnonzero(np.repeat(short, e.inverse.shape[2]))
        fine = np.einsum("acpqt,pq,pqb->acpbt", there, weights, shape, optimize=True)
        integrals[:, :, nodes] = fine.reshape(2, len(classes), len(nodes), -1)
    return size * np.stack([at_nodes[0], *integrals])


def directions(phase):
    """Number of directions on a quarter circle with which the error of J₀ is 1e-13 up to the phase kR

    Jₙ(x) decays from n = x on like Airy's function, and is 1e-13 after another 10 x^(1/3) orders.
    """
    return int(np.ceil((phase + 10 * phase ** (1 / 3) + 12) / 4))


def _waves(geometry, classes, k, theta, points, normals, depth_values):
    """f and ∂f/∂n (2, c, m, t) at points (m, 3) with normals (m, 3)"""
    images, (Z, slope) = geometry.images, depth_values(points[:, 2]).T
    kx, ky = k * np.cos(theta), k * np.sin(theta)
    along, across = _both(points[:, :1] * kx), _both(points[:, 1:2] * ky)
    kx, ky, upwards = Z[:, None] * normals[:, :1] * kx, Z[:, None] * normals[:, 1:2] * ky, slope * normals[:, 2]
    own = [(1, -1) if np.all(images[:, axis] > 0) else None for axis in range(2)]
    out = [[], []]
    for cls in classes:
        parities = product(*((sign,) if free is None else free for sign, free in zip(cls, own, strict=True)))
        pairs = [(along[a], across[b]) for a, b in parities]
        out[0].append(np.concatenate([Z[:, None] * X * Y for (X, _), (Y, _) in pairs], axis=1))
        parts = [kx * dX * Y + ky * X * dY + upwards[:, None] * X * Y for (X, dX), (Y, dY) in pairs]
        out[1].append(np.concatenate(parts, axis=1))
    return np.array(out)


def _both(phase):
    """{1: cos and its derivative, −1: sin and its derivative}"""
    cosine, sine = np.cos(phase), np.sin(phase)
    return {1: (cosine, -sine), -1: (sine, cosine)}
