"""Parts of a hull that overlap, found from the solid angle under which one part is seen from another.

    w(p) = (1/4π) Σ Ω(p),    tan Ω/2 = a·(b × c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|)

where the sum is over triangles with corners a, b, c from p (Van Oosterom and Strackee, IEEE Transactions on Biomedical
Engineering 30, 1983) and over their images above the water, which close a hull with an open waterline. The winding
number w is ±1 inside the hull and 0 outside.
"""

import numpy as np

from ..hydrostatics import stands
from ..panels import PanelMesh

MOST = 32  # parts; a mesh of more parts has panels that do not meet, for which another finding exists
SAMPLE = 100  # panels of a part that are tested as a sample
BLOCK = 1 << 20  # places times panels at once
AT_SURFACE = 1e-6  # distance from z = 0 below which a point lies in the surface, as a share of the draft
BESIDE = 1e-3  # distance of a tested place from its panel, on the side of the water, over the panel's longest side


def overlaps(welded, depth=np.inf):
    """[(number of panels of a part inside another part, number of panels tested, place of the first such panel, m,
    (3,))]

    The place beside a panel is tested, so a wall that lies on the wall of a closed part counts as inside that part.

    welded : whole PanelMesh whose panels share their points; depth : depth of water, m; the bed closes walls that end
        on it
    """
    part = parts(welded)
    out = []
    if part.max() >= MOST:
        return out
    whole = [PanelMesh(welded.points, welded.corners[part == one]) for one in range(part.max() + 1)]
    whole = [one.closed() if stands(one, depth) else one for one in whole]
    closed = [_is_closed(one) for one in whole]
    for one in range(part.max() + 1):
        panels = np.flatnonzero(part == one)
        some = panels[:: max(1, len(panels) // SAMPLE)]
        for other in (other for other in range(part.max() + 1) if other != one):
            seen = whole[other].vertices
            low, high = seen.reshape(-1, 3).min(axis=0), seen.reshape(-1, 3).max(axis=0)
            apart = BESIDE * closed[other] * welded.sizes[some, None]
            places = welded.centroids[some] + apart * welded.normals[some]
            near = np.all((places[:, :2] > low[:2]) & (places[:, :2] < high[:2]), axis=1)
            inside = np.abs(winding(places[near], seen)) > 0.5 if near.any() else np.zeros(0, bool)
            if inside.any():
                out.append((int(inside.sum()), len(some), welded.centroids[some][near][np.argmax(inside)]))
    return out


def parts(mesh):
    """Number of the part to which each panel belongs; shape (n,). Different parts share no edge"""
    panel, edge, uses = _edges(mesh)
    number = connected(panel, len(mesh) + edge, len(mesh) + len(uses))[: len(mesh)]
    return np.unique(number, return_inverse=True)[1].reshape(-1)


def _edges(mesh):
    """Panel and edge of each side, and how many panels each edge has"""
    a, b = mesh.corners, np.roll(mesh.corners, 1, axis=1)
    real = a != b
    ends = np.sort(np.stack([a[real], b[real]], axis=1), axis=1)
    _, edge, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    return np.nonzero(real)[0], edge.reshape(-1), uses


def _is_closed(mesh):
    """Whether every edge below the surface has two panels"""
    _, edge, uses = _edges(mesh)
    deep = np.minimum(mesh.vertices[..., 2], np.roll(mesh.vertices[..., 2], 1, axis=1)) < -AT_SURFACE * mesh.draft
    deep = deep[mesh.corners != np.roll(mesh.corners, 1, axis=1)]
    return bool(np.all(uses[edge[deep]] > 1))


def connected(a, b, count):
    """Smallest node of the connected part of each node; shape (count,); edges join nodes a (e,) with nodes b (e,).

    Of two parts joined by an edge, the later part takes the number of the earlier, until no edge joins two parts. The
    import of scipy.sparse.csgraph would take longer than the whole check.
    """
    root = np.arange(count)
    while True:
        low, high = np.minimum(root[a], root[b]), np.maximum(root[a], root[b])
        joined = low < high
        if not joined.any():
            return np.unique(root, return_inverse=True)[1].reshape(-1)
        np.minimum.at(root, high[joined], low[joined])
        while np.any(root[root] != root):
            root = root[root]


def winding(places, panels):
    """Winding number at places (p, 3) of panels (n, 4, 3) and their images; shape (p,)"""
    images = panels[:, ::-1] * [1.0, 1.0, -1.0]
    corners = np.concatenate([panels, images])
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    step = max(1, BLOCK // len(triangles))
    return np.concatenate([_solid_angles(places[i : i + step], triangles) for i in range(0, len(places), step)])


def _solid_angles(places, triangles):
    a, b, c = np.moveaxis(triangles[None] - places[:, None, None], 2, 0)
    la, lb, lc = (np.linalg.norm(side, axis=-1) for side in (a, b, c))
    dot = np.einsum("pni,pni->pn", a, b) * lc + np.einsum("pni,pni->pn", b, c) * la
    dot = dot + np.einsum("pni,pni->pn", c, a) * lb + la * lb * lc
    return np.arctan2(np.einsum("pni,pni->pn", a, np.cross(b, c)), dot).sum(axis=1) / (2 * np.pi)
