"""Incident waves at the nodes of a hull, one part for each symmetry class of its panels.

    φ_I = −(ig/ω) Z(z) X(x) Y(y),    X = exp(ikx cos β),    Y = exp(iky sin β)

In a class even in x, X is replaced by cos(kx cos β), in a class odd in x by i sin(kx cos β); without the mirror plane
x = 0 it is X itself. Y is replaced in the same way. A vertical wall in the plane y = 0 reflects the wave, which
doubles the part even in y.
"""

import numpy as np

from ..waves import depth_values, real_part


def class_waves(geometry, beta, omega, k, gravity=9.80665, nodes=None):
    """φ_I (m²/s) and ∂φ_I/∂n (m/s) per m of amplitude, two (classes, n), towards `beta` at the nodes of the hull.

    geometry : `bem.panels.influence.Geometry`; phases are about the origin of the body
    nodes : slice of other nodes, in place of those of the hull
    """
    g, nodes = geometry, slice(geometry.hull) if nodes is None else nodes
    (x, y, z), (nx, ny, nz) = g.elements.nodes[nodes].T, g.elements.normals[nodes].T
    kx, ky = k * np.cos(beta), k * np.sin(beta)
    there_and_back = len(g.images) // g.copies
    start = there_and_back * -1j * gravity / omega * np.exp(-1j * (kx * g.origin[0] + ky * g.origin[1]))
    Z, slope = depth_values(k, g.depth)(z).T
    upwards = slope * nz
    along = {sign: real_part(sign if "x" in g.mesh.symmetry else 0, kx * x) for sign in {c[0] for c in g.classes}}
    across = {sign: real_part(sign if "y" in g.mesh.symmetry else 0, ky * y) for sign in {c[1] for c in g.classes}}
    along_normal, across_normal = kx * Z * nx, ky * Z * ny
    phi, flux = np.empty((2, len(g.classes), len(x)), complex)
    for i, cls in enumerate(g.classes):
        (of_x, X, dX), (of_y, Y, dY) = along[cls[0]], across[cls[1]]
        factor, both = start * of_x * of_y, X * Y
        np.multiply(factor, Z * both, out=phi[i])
        np.multiply(factor, along_normal * (dX * Y) + across_normal * (X * dY) + upwards * both, out=flux[i])
    return phi, flux
