"""Damping lids of a scene: their places on the water, and the mirror planes that a mesh with these lids keeps."""

import numpy as np

from hakobune.bem.panels.damping_lid import DampingLid
from hakobune.meshing.panels import with_symmetry
from hakobune.meshing.surface.patches import counter_clockwise, covered, mirrored_in, moonpools

from ...scene.scene import SceneError


def damping_lids_of(scene, mesh):
    """Return a `DampingLid` for each lid of a scene.  Raises SceneError for a lid on a hull, or a missing moonpool."""
    out = []
    for number, table in enumerate(scene.damping_lids or ()):
        key, given = f"damping_lids[{number}]", table.corners is not None
        polygons = [counter_clockwise(table.corners)] if given else moonpools(mesh)
        if not polygons:
            raise SceneError(f"{key} has no corners, and no body has a moonpool; give corners = [[x, y], …], m")
        try:
            out += [DampingLid(counter_clockwise(polygon), table.damping) for polygon in polygons]
        except ValueError as error:
            raise SceneError(f"{key}: the moonpool {error}") from None
        if given:
            _check_on_water(key, polygons[0], mesh)
    return tuple(out)


def with_planes_of(mesh, lids):
    """The mesh with only the mirror planes that its damping lids share"""
    return with_symmetry(mesh, mirrored_in([lid.corners for lid in lids], mesh.symmetry)) if lids else mesh


def _check_on_water(key, corners, mesh):
    """Points of a polygon a little inside its corners and sides, and its middle, on no waterplane"""
    middle = corners.mean(axis=0)
    sides = 0.5 * (corners + np.roll(corners, -1, axis=0))
    points = np.concatenate([middle + 0.98 * (np.concatenate([corners, sides]) - middle), middle[None]])
    dry = covered(points, mesh)
    if np.any(dry):
        x, y = points[np.argmax(dry)]
        raise SceneError(f"{key} covers a hull at x = {x:.4g}, y = {y:.4g} m; allowed: open water only")
