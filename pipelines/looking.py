"""`hakobune look`: the mesh of a database, a scene or a mesh file, and a value on its panels."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .picture import VIEWS, check_display, check_picture
from .scene import SceneError, make_scene, read_scene

FIELDS = {
    "area": ("panel area, m²", lambda mesh: mesh.areas),
    "size": ("longest edge, m", lambda mesh: mesh.sizes),
    "aspect": ("longest edge over area per longest edge", lambda mesh: mesh.sizes**2 / mesh.areas),
}
DATABASES = (".h5", ".hdf5")


@dataclass(frozen=True, eq=False)
class Picture:
    """What is shown: hull, lid or None, depth in m, and one value a panel of the hull or of its whole, or None"""

    mesh: object
    lid: object = None
    depth: float = np.inf
    field: np.ndarray | None = None
    field_name: str = ""


def look(path, screenshot=None, field=None, omega=None, heading=None):
    """Show a mesh in a window, or write a picture of it.

    field : one of FIELDS, or pressure, coloured on the panels
    omega : rad/s, heading : degrees, of the pressure; the nearest stored ones are taken
    """
    if screenshot is None:
        check_display()
    else:
        check_picture(screenshot, VIEWS)
    if field is not None and field not in (*FIELDS, "pressure"):
        raise SceneError(f"field is {field!r}; allowed: {', '.join(FIELDS)}, pressure")
    if field != "pressure" and (omega, heading) != (None, None):
        raise SceneError("--omega and --heading belong to --field pressure; leave them out or ask for it")
    _show(_pressure(path, omega, heading) if field == "pressure" else _mesh(path, field), screenshot)
    if screenshot:
        print(screenshot)
    return 0


def _show(picture, screenshot):
    from vtkmodules.vtkCommonCore import vtkLogger

    from meshing.view import look as show

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # it warns in colour of a display nobody asked for
    show(
        picture.mesh,
        picture.lid,
        field=picture.field,
        field_name=picture.field_name,
        normals=picture.field is None,
        depth=picture.depth,
        screenshot=screenshot,
    )


def _mesh(path, field):
    mesh, lid, depth = _meshes(path)
    name, values = FIELDS[field] if field else ("", lambda mesh: None)
    return Picture(mesh, lid, depth, values(mesh), name)


def _meshes(path):
    """(hull, lid or None, depth in m) of any file that has a mesh"""
    if path.suffix in DATABASES:
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


def _pressure(path, omega, heading):
    """Amplitude of the dynamic pressure at the stored frequency and heading nearest to those asked for"""
    from bem.database import open_database

    if path.suffix not in DATABASES:
        raise SceneError(f"{path} holds no pressure; allowed: a database made with --only pressure")
    if omega is None or heading is None:
        raise SceneError("the pressure has a frequency and a heading; give --omega rad/s and --heading degrees")
    db = open_database(path)
    amplitude = np.abs(db["pressure"])
    i, j = _nearest(db, omega, heading)
    state = "fixed" if db.inertia_matrix is None else "floating freely"
    place = f"omega {db.omega[i]:.4g} rad/s, heading {np.degrees(db.wave_direction[j]):.4g}°"  # VTK has no Greek
    title = f"dynamic pressure in Pa per m of wave, {place}: {db.mesh.name}, {state}"
    return Picture(replace(db.mesh, name=title), None, db.water_depth, amplitude[i, j], "Pa/m")


def _nearest(db, omega, heading):
    """Numbers of the nearest stored frequency and heading.  Raises SceneError for what is not within reach."""
    if not db.omega[0] * 0.9 <= omega <= db.omega[-1] * 1.1:
        raise SceneError(f"--omega is {omega:g}; stored in {db.path}: {db.omega[0]:.4g} to {db.omega[-1]:.4g} rad/s")
    if not -360 <= heading <= 360:
        raise SceneError(f"--heading is {heading:g}; allowed: -360 to 360")
    turn = np.angle(np.exp(1j * (db.wave_direction - np.radians(heading))))
    return int(np.argmin(np.abs(db.omega - omega))), int(np.argmin(np.abs(turn)))
