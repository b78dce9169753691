"""`hakobune look`: the mesh of a database, a scene or a mesh file."""

from __future__ import annotations

import numpy as np

from .scene import SceneError, make_scene, read_scene

FIELDS = {
    "area": ("panel area, m²", lambda mesh: mesh.areas),
    "size": ("longest edge, m", lambda mesh: mesh.sizes),
    "aspect": ("longest edge over area per longest edge", lambda mesh: mesh.sizes**2 / mesh.areas),
}


def look(path, screenshot=None, field=None):
    """Show a mesh in a window, or write a picture of it.

    field : one of FIELDS, coloured on the panels
    """
    from meshing.view import look as show

    if field is not None and field not in FIELDS:
        raise SceneError(f"field is {field!r}; allowed: {', '.join(FIELDS)}")
    mesh, lid, depth = _meshes(path)
    name, values = FIELDS[field] if field else ("", None)
    show(
        mesh,
        lid,
        field=values(mesh) if values else None,
        field_name=name,
        depth=depth,
        screenshot=screenshot,
    )
    if screenshot:
        print(screenshot)
    return 0


def _meshes(path):
    """(hull, lid or None, depth in m) of any file that has a mesh"""
    if path.suffix in (".h5", ".hdf5"):
        from bem.database import open_database

        db = open_database(path)
        return db.mesh, db.lid, db.water_depth
    if path.suffix == ".toml":
        from .hull import make_hull

        scene = make_scene(read_scene(path))
        hull = make_hull(scene, scene.omegas())
        return hull.mesh, hull.lid, scene.water.depth
    from meshing.files import read_mesh

    return read_mesh(path), None, np.inf
