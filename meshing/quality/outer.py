"""Selection of the panels of a drawing that water reaches: they have water on one side and the body on the other.

The winding number of the hull and its image above the water shows what is on a side of a panel: 0 in water, ±1 in the
body, ±2 where parts overlap. Inner walls have the body on both sides, folds have water on both sides.
"""

from dataclasses import replace

import numpy as np

from ..panels import PanelMesh
from .overlap import parts, winding

SAME_POINT = 1e-6  # points closer than this share of the mesh size are one point
BESIDE = 1e-3  # distance of the places beside a panel, as a share of its area over its longest side
WATER, BODY = 0.3, 0.6  # winding numbers up to and from which a place is told as one and the other: drawings have slits


def beside(hull, panels) -> np.ndarray:
    """Absolute winding numbers on the outer side of panels, where the normal points, and on the inner side; shape (2,
    k)

    hull : whole PanelMesh; panels : indices of panels, (k,)
    """
    apart = BESIDE * (hull.areas[panels] / hull.sizes[panels])[:, None] * hull.normals[panels]
    places = np.concatenate([hull.centroids[panels] + apart, hull.centroids[panels] - apart])
    return np.abs(winding(places, hull.vertices)).reshape(2, -1)


def wet(numbers):
    """Whether panels have water on one side and the body on the other; shape (k,); numbers : winding numbers from
    `beside`"""
    return (numbers.min(axis=0) < WATER) & (numbers.max(axis=0) > BODY)


def outer(mesh) -> PanelMesh:
    """The panels that water reaches, normals to the water: no copies, inner walls, folds, or parts inside another part.

    The mesh keeps its mirror planes.  A panel that crosses the surface of another part is kept or omitted as a whole.
    The gap that remains at such a panel is reported by `findings`.
    """
    mesh = _without_copies(mesh.merged(SAME_POINT))
    numbers = beside(mesh.whole(), np.arange(len(mesh)))  # the meshed part comes first in the whole hull
    turned = np.where((numbers[0] > numbers[1])[:, None], mesh.corners[:, ::-1], mesh.corners)
    return _with_panels(replace(mesh, corners=turned), _reached(mesh, wet(numbers)))


def _without_copies(mesh):
    """One panel of those that have the same corners; none of them where as many face each way"""
    _, number = np.unique(np.sort(mesh.corners, axis=1), axis=0, return_inverse=True)
    number = number.reshape(-1)
    first = np.unique(number, return_index=True)[1][number]
    facing = np.sign(np.einsum("ni,ni->n", mesh.area_vectors, mesh.area_vectors[first]))
    net = np.bincount(number, facing)[number]
    _, kept = np.unique(np.where((net != 0) & (facing == np.sign(net)), number, -1), return_index=True)
    some = np.zeros(len(mesh), bool)
    some[kept] = True
    return _with_panels(mesh, some & (net != 0))


def _reached(mesh, kept):
    """Which of the panels `kept` (n,) are in no part that lies in another; shape (n,)"""
    hull = mesh.whole()
    number = np.full(len(hull), -1)
    tiled = np.tile(kept, mesh.copies)
    number[tiled] = parts(PanelMesh(hull.points, hull.corners[tiled]))
    reached = kept.copy()
    for one in range(number.max() + 1):
        first = np.flatnonzero(number == one)[:1]
        others = [other for other in range(number.max() + 1) if other != one]
        within = (np.abs(winding(hull.centroids[first], hull.vertices[number == other]))[0] > 0.5 for other in others)
        if any(within):
            reached[number[: len(mesh)] == one] = False
    return reached


def _with_panels(mesh, kept):
    used, corners = np.unique(mesh.corners[kept], return_inverse=True)
    return replace(mesh, points=mesh.points[used], corners=corners.reshape(-1, 4))
