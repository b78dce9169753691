"""Parts of a hull that overlap, found from the solid angle under which one part is seen from another.

    w(p) = (1/4π) Σ Ω(p),    tan Ω/2 = a·(b × c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|)

of triangles with corners a, b, c from p (Van Oosterom and Strackee, IEEE Transactions on Biomedical Engineering 30,
1983) and of their
images above the water, which close a hull with an open waterline: ±1 inside, 0 outside.
"""

import numpy as np

from ..hydrostatics import stands
from ..panels import PanelMesh

MOST = 32  # parts; a mesh of more parts has panels that do not meet, for which another finding exists
SAMPLE = 100  # panels of a part that are tested as a sample
BLOCK = 1 << 20  # places times panels at once


def overlaps(welded, depth=np.inf):
    """[(panels of one part inside another, panels tested, (3,) m place of the first of these panels)] of parts of a
    hull.

    welded : whole PanelMesh whose panels share their points; depth : m of water, whose bed closes walls that end on it
    """
    part = _parts(welded)
    out = []
    if part.max() >= MOST:
        return out
    whole = [PanelMesh(welded.points, welded.corners[part == one]) for one in range(part.max() + 1)]
    whole = [one.closed() if stands(one, depth) else one for one in whole]
    for one in range(part.max() + 1):
        panels = np.flatnonzero(part == one)
        some = panels[:: max(1, len(panels) // SAMPLE)]
        for other in (other for other in range(part.max() + 1) if other != one):
            seen = whole[other].vertices
            low, high = seen.reshape(-1, 3).min(axis=0), seen.reshape(-1, 3).max(axis=0)
            centres = welded.centroids[some]
            near = centres[np.all((centres[:, :2] > low[:2]) & (centres[:, :2] < high[:2]), axis=1)]
            inside = np.abs(winding(near, seen)) > 0.5 if len(near) else np.zeros(0, bool)
            if inside.any():
                out.append((int(inside.sum()), len(some), near[np.argmax(inside)]))
    return out


def _parts(mesh):
    """Number of the part that each panel belongs to; shape (n,); parts share no point"""
    a, b = mesh.corners.reshape(-1), np.roll(mesh.corners, 1, axis=1).reshape(-1)
    number = connected(a, b, len(mesh.points))
    return np.unique(number[mesh.corners[:, 0]], return_inverse=True)[1].reshape(-1)


def connected(a, b, count):
    """Number of the connected part of each node, which is the smallest node in the part; shape (count,); edges join a
    (e,) and b (e,).

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
