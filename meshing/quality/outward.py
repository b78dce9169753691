"""Normals of a drawing, which may point to either side, turned to the side of the water."""

from dataclasses import replace

import numpy as np

from ..panels import PanelMesh

SAME_POINT = 1e-6  # points closer than this share of the mesh size are one point


def outward(mesh) -> PanelMesh:
    """A copy in which neighbouring panels run along their common edge in opposite directions. If neighbours already
    do so, and no part differs from the other parts, all panels are reversed.

    A part is a set of panels joined by common edges. Each part is turned so that its volume ∬ x·n dS / 3 is positive.
    An open waterplane in z = 0, or a cut at x = 0 or y = 0, does not change this volume.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    welded, n = mesh.merged(SAME_POINT), len(mesh)
    start, end = welded.corners.ravel(), np.roll(welded.corners, -1, axis=1).ravel()
    real = start != end
    start, end, panel = start[real], end[real], np.repeat(np.arange(n), 4)[real]
    _, edge, uses = np.unique(
        np.sort(np.stack([start, end], 1), axis=1), axis=0, return_inverse=True, return_counts=True
    )
    edge = edge.reshape(-1)
    order = np.argsort(edge, kind="stable")
    first, second = order[uses[edge][order] == 2].reshape(-1, 2).T
    i, j, against = panel[first], panel[second], start[first] == start[second]
    # two copies of each panel, as it is and reversed; neighbours that agree join like copies, others unlike ones
    a, b = np.concatenate([i, i + n]), np.concatenate([j + n * against, j + n * ~against])
    _, side = connected_components(coo_array((np.ones(len(a)), (a, b)), (2 * n, 2 * n)), directed=False)
    part = np.minimum(side[:n], side[n:])
    sign = np.where(side[:n] == part, 1.0, -1.0)  # of a Möbius strip both copies are one part, and stay
    share = sign * np.einsum("ni,ni->n", mesh.centroids, mesh.area_vectors)
    inward = np.bincount(part, share) < 0
    if not against.any() and len(np.unique(inward[part])) == 1:
        return mesh.flipped()
    sign *= np.where(inward, -1.0, 1.0)[part]
    return replace(mesh, corners=np.where(sign[:, None] > 0, mesh.corners, mesh.corners[:, ::-1]))
