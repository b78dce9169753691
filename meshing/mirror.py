"""Mirror planes found in the mesh of a whole hull, which is then reduced to half or a quarter of its panels.

Two planes split a problem into four problems of a quarter the size. Dense systems then take a sixteenth of the work.
"""

from dataclasses import replace

import numpy as np

from .panels import PanelMesh

SAME_POINT = 1e-6  # points closer than this share of the mesh size are one point


def healed(mesh, near):
    """The mesh with points closer than `near` m merged at their middle, points within `near` of x = 0, y = 0 or z = 0
    moved into that plane, and panels without area removed"""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import KDTree

    pairs = KDTree(mesh.points).query_pairs(near, output_type="ndarray").T
    linked = coo_array((np.ones(pairs.shape[1]), tuple(pairs)), (len(mesh.points),) * 2)
    count, group = connected_components(linked, directed=False)
    points = np.stack([np.bincount(group, column, count) for column in mesh.points.T], axis=1)
    points /= np.bincount(group, minlength=count)[:, None]
    points[np.abs(points) <= near] = 0.0
    corners = group[mesh.corners]
    kept = np.array([len(set(panel)) > 2 for panel in corners.tolist()], bool)
    return replace(mesh, points=points, corners=np.array([_closed_up(panel) for panel in corners[kept].tolist()]))


def _closed_up(panel):
    """Four corners of a panel without repeated points; a triangle repeats its last corner"""
    ring = list(dict.fromkeys(panel))
    return ring if len(ring) == 4 else [*ring, ring[-1]]


def folded(mesh, tolerance=SAME_POINT):
    """The part of a hull whose images in x = 0 and y = 0 complete the hull; for a hull without such symmetry the mesh
    itself.

    Every point, and every panel with its normal, must have an image within `tolerance` times the size of the hull. A
    panel that crosses the plane is its own image and cannot be halved.  The images of the returned mesh are exact.
    """
    for axis in "xy":
        half = None if axis in mesh.symmetry else _half(mesh, "xy".index(axis), tolerance)
        if half is not None:
            mesh = replace(half, symmetry="".join(sorted(mesh.symmetry + axis)), name=mesh.name)
    return mesh


def _half(mesh, axis, tolerance):
    """Panels on the positive side of a plane, or None where the other side is not their image"""
    length = float(np.ptp(mesh.points, axis=0).max())
    reach = tolerance * length
    # moment about the plane that panels leave that are images of each other as nearly as below: most hulls without a
    # mirror plane have more, and need no tree of their points, which takes a third of a second to load
    least = reach * (mesh.areas.sum() + 2 * len(mesh) * mesh.sizes.max() * length)
    if abs(mesh.areas @ mesh.centroids[:, axis]) > least:
        return None
    from scipy.spatial import KDTree

    mirror = np.where(np.arange(3) == axis, -1.0, 1.0)
    distance, image = KDTree(mesh.points).query(mesh.points * mirror)
    side = np.sign(mesh.centroids[:, axis]) * (np.abs(mesh.centroids[:, axis]) > reach)
    if distance.max() > reach or len(mesh) != 2 * np.count_nonzero(side > 0) or np.any(side == 0):
        return None
    own, other = np.flatnonzero(side > 0), np.flatnonzero(side < 0)
    seen, theirs = np.sort(image[mesh.corners[own]], axis=1), np.sort(mesh.corners[other], axis=1)
    first, second = np.lexsort(seen.T), np.lexsort(theirs.T)
    if not np.array_equal(seen[first], theirs[second]):
        return None
    apart = mesh.area_vectors[own[first]] * mirror - mesh.area_vectors[other[second]]
    crossing = np.any(mesh.points[mesh.corners[own], axis] < -reach)
    if crossing or np.abs(apart).max() > reach * mesh.sizes.max():
        return None
    used, corners = np.unique(mesh.corners[own], return_inverse=True)
    points = mesh.points[used]
    points[np.abs(points[:, axis]) <= reach, axis] = 0.0
    return PanelMesh(points, corners.reshape(-1, 4), mesh.symmetry)
