"""Several bodies of a scene: from hulls in their own coordinates to one mesh, and back."""

import math

import numpy as np

from hakobune.meshing.hydrostatics import stands
from hakobune.meshing.mirror import folded
from hakobune.meshing.panels import assembled, with_symmetry
from hakobune.meshing.quality.overlap import winding

from ..scene.scene import SceneError
from .gaps.resonant_water import NARROW, resonant_water

TOUCHING = 1e-6  # distance at which bodies touch, over the size of the whole
NEAR = 8  # panels of another body that are tested from a corner


def arranged(scene, hulls):
    """One mesh of hulls, each in its own coordinates, at the places of the bodies of a scene.

    The mesh has those mirror planes that every body has at its place.
    """
    placed = [folded(_at_place(hull, body.place)) for hull, body in zip(hulls, scene.bodies, strict=True)]
    shared = "".join(axis for axis in "xy" if all(axis in hull.symmetry for hull in placed))
    return assembled([with_symmetry(hull, shared) for hull in placed])


def own_hulls(scene, mesh):
    """Hulls of a mesh of several bodies, each in its own coordinates and with its own mirror planes"""
    return [folded(_at_origin(mesh.of_body(i).whole(), body.place)) for i, body in enumerate(scene.bodies)]


def own_hulls_of_modes(scene, mesh):
    """Argument of `bending.modes` for the mesh of a scene: empty without modes"""
    if not scene.modes:
        return ()
    return own_hulls(scene, mesh) if scene.several else [mesh]


def check_apart(scene, mesh, panels_matter=True):
    """Raise SceneError for two bodies that overlap or touch.

    panels_matter : whether the bodies are solved on these panels
    returns : messages on bodies closer than their panels allow, and on the water between close bodies
    """
    said, gaps = [], []
    _check_wall(scene, mesh)
    hulls = [mesh.of_body(i).whole() for i in range(mesh.bodies)]
    reach = TOUCHING * float(np.ptp(mesh.whole().points, axis=0).max())
    for i, one in enumerate(hulls):
        for j in range(i + 1, len(hulls)):
            if _far(one, hulls[j]):
                continue
            gap, size = _gap(one, hulls[j])
            names = f"{scene.bodies[i].name} and {scene.bodies[j].name}"
            if _overlap(one, hulls[j]) or _overlap(hulls[j], one):
                raise SceneError(f"{names} overlap; allowed: water between them; move one of them with its key place")
            if gap <= reach:
                raise SceneError(f"{names} touch; allowed: water between them (change place), or one mesh of both")
            afloat = [hull for hull in (one, hulls[j]) if not stands(hull, scene.water.depth)]
            if afloat:
                widths = [min(np.ptp(hull.points[:, :2], axis=0)) for hull in afloat]
                draft, wall = min(hull.draft for hull in afloat), len(afloat) == 1
                gaps.append((names, gap, draft, sum(widths) + (0.0 if wall else gap), wall))
            if gap < size / 2 and panels_matter:
                said.append(
                    f"{names} are {gap:.3g} m apart, but their panels are up to {size:.3g} m long; recommended: at "
                    "most twice the gap; give more panels"
                )
    return (*said, *resonant_water(scene, mesh, gaps))


def _check_wall(scene, mesh):
    """Raise SceneError for a body that touches the wall of a scene, or is on the other side than the first body"""
    if scene.wall is None:
        return
    sides = [mesh.of_body(i).whole().points[:, 1] - scene.wall for i in range(mesh.bodies)]
    side = np.sign(sides[0].mean())
    for body, y in zip(scene.bodies, sides, strict=True):
        if np.min(side * y) <= 0:
            raise SceneError(
                f"{body.name} extends from y = {scene.wall + y.min():.6g} to {scene.wall + y.max():.6g} m, and the "
                f"wall is at y = {scene.wall:g} m; allowed: all bodies on one side of it"
            )


def _overlap(one, other):
    """Whether a corner of a hull lies inside another hull"""
    low, high = other.points.min(axis=0), other.points.max(axis=0)
    near = one.centroids[np.all((one.centroids[:, :2] > low[:2]) & (one.centroids[:, :2] < high[:2]), axis=1)]
    return len(near) > 0 and bool(np.any(np.abs(winding(near, other.closed().vertices)) > 0.5))


def _far(one, other):
    """Whether boxes around two hulls are farther apart than any gap of which something is said: twenty bodies are 190
    pairs
    """
    between = np.maximum(
        one.points.min(axis=0) - other.points.max(axis=0), other.points.min(axis=0) - one.points.max(axis=0)
    )
    least = max(NARROW * one.draft, NARROW * other.draft, one.sizes.max(), other.sizes.max())
    return float(np.linalg.norm(np.maximum(between, 0.0))) > least


def _gap(one, other):
    """m, the distance of two hulls, from the corners and centres of one to near panels of the other, and their size"""
    from scipy.spatial import KDTree

    least, size = math.inf, 0.0
    for a, b in ((one, other), (other, one)):
        points = np.concatenate([a.points, a.centroids])
        _, near = KDTree(b.centroids).query(points, k=min(NEAR, len(b)))
        near = near.reshape(len(points), -1)
        distance = _distance(points[:, None], b.flat_vertices[near], b.normals[near])
        place = np.unravel_index(np.argmin(distance), distance.shape)
        if distance[place] < least:
            least, size = float(distance[place]), float(b.sizes[near[place]])
    return least, size


def _distance(point, corners, normal):
    """Distance of points (p, 1, 3) from flat panels (p, k, 4, 3), m; shape (p, k): to the plane above a panel, else to
    its sides"""
    side = np.roll(corners, -1, axis=-2) - corners
    ahead = point[..., None, :] - corners
    above = np.all(np.einsum("...i,...i", np.cross(side, ahead), normal[..., None, :]) >= 0, axis=-1)
    length = np.einsum("...i,...i", side, side)
    share = np.clip(np.einsum("...i,...i", ahead, side) / np.where(length > 0, length, 1.0), 0, 1)
    to_sides = np.linalg.norm(ahead - share[..., None] * side, axis=-1).min(axis=-1)
    return np.where(above, np.abs(np.einsum("...i,...i", ahead[..., 0, :], normal)), to_sides)


def _at_place(hull, place):
    x, y, heading = place
    turned = hull.rotated(math.radians(heading)) if heading else hull
    return turned.moved(dx=x, dy=y)


def _at_origin(hull, place):
    x, y, heading = place
    moved = hull.moved(dx=-x, dy=-y)
    return moved.rotated(-math.radians(heading)) if heading else moved
