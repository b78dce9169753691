"""Rigid-body modes of motion: normal velocities, parity under reflection, change of reference point."""

from __future__ import annotations

import numpy as np

# sign of a mode's potential under x → −x and under y → −y, about the origin
PARITY = ((-1, 1), (1, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


def normal_velocities(centroids, normals):
    """(n, 6) normal velocity of unit surge … yaw about the origin: n and r × n"""
    return np.concatenate([normals, np.cross(centroids, normals)], axis=1)


def displacing(mesh):
    """(6,) whether a mode of a hull, a `meshing.panels.PanelMesh`, moves water at all.

    Yaw of a round buoy does not, but for the corners of its polygon, nor does heave of a pile on the bed: a relative
    error of what they give says nothing.  A rotation counts if the mean square of its normal velocity is two per cent
    of that of its arms, both about the vertical axis through the middle of the hull's surface, so that it does not
    matter where the mesh lies.
    """
    whole = mesh.whole()
    weights, centroids = whole.areas, whole.centroids
    middle = np.append(weights @ centroids[:, :2] / weights.sum(), 0.0)
    velocities, (x, y, z) = normal_velocities(centroids - middle, whole.normals), (centroids - middle).T
    arms = np.stack([np.ones(len(x))] * 3 + [y * y + z * z, z * z + x * x, x * x + y * y], axis=1)
    return (weights @ velocities**2) / (weights @ arms) > np.array([1e-6] * 3 + [0.02] * 3)


def reference_change(center):
    """T (6, 6) with generalized normal about `center` = T · generalized normal about the origin."""
    x, y, z = center
    T = np.eye(6)
    T[3:, :3] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    return T


def class_of(dof, symmetry):
    """Symmetry class (sign in x, sign in y) that holds mode number `dof`."""
    x, y = PARITY[dof]
    return (x if "x" in symmetry else 1, y if "y" in symmetry else 1)


def with_net_flux(added_mass, flux, area):
    """`added_mass` with infinite entries between modes whose net flux (6,) m² is more than rounding of `area` m²."""
    product = np.outer(flux, flux)
    significant = np.abs(product) > 1e-9 * area * area
    return np.where(significant, np.copysign(np.inf, product), added_mass)
