"""Rigid-body modes of motion: normal velocities, parity under reflection, change of reference point."""

from __future__ import annotations

import numpy as np

# sign of a mode's potential under x → −x and under y → −y, about the origin
PARITY = ((-1, 1), (1, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


def normal_velocities(centroids, normals):
    """(n, 6) normal velocity of unit surge … yaw about the origin: n and r × n"""
    return np.concatenate([normals, np.cross(centroids, normals)], axis=1)


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
