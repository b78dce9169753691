"""`hakobune look`: the mesh of a database, a scene or a mesh file, and a value on its panels."""

from dataclasses import dataclass, replace

import numpy as np

from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.quality import findings
from hakobune.mooring.criteria.failing import fails

from ..common.bounds import told
from ..common.gaps import gaps_of
from ..common.picture import VIEWS, check_display, check_picture, font_file
from ..printing.verdict import tell
from ..scene.scene import Scene, SceneError, make_scene, read_scene

FIELDS = {
    "area": ("panel area, m²", lambda mesh: mesh.areas),
    "size": ("longest edge, m", lambda mesh: mesh.sizes),
    "aspect": ("edge² / area", lambda mesh: mesh.sizes**2 / mesh.areas),
}
DATABASES = (".h5", ".hdf5")
PAGES = (".html",)
SAME_HEADING = 1e-6  # degrees
A_PANEL = 3e-5  # s, to be checked and drawn
MOST_LISTED = 12  # headings in a message


@dataclass(frozen=True, eq=False)
class Picture:
    """Content of a picture: hull; lid or None; depth, m; and a value on each panel of the stored part or of the full
    hull, or None
    """

    mesh: object
    lid: object = None
    depth: float = np.inf
    field: np.ndarray | None = None
    field_name: str = ""


def look(path, screenshot=None, field=None, omega=None, heading=None, page=None):
    """Show a mesh in a window, or write a picture or a page that can be turned, which need no display.

    field : one of FIELDS, or pressure, coloured on the panels
    omega : rad/s, heading : degrees, of the pressure; the nearest stored frequency is used, a heading must be stored
    returns : the exit status
    """
    if field is not None and field not in (*FIELDS, "pressure"):
        raise SceneError(f"field is {field!r}; allowed: {', '.join(FIELDS)}, pressure")
    if field != "pressure" and (omega, heading) != (None, None):
        raise SceneError("--omega and --heading are for --field pressure only; leave them out, or add --field pressure")
    source, told_of = _opened(path), []
    if isinstance(source, PanelMesh):
        told(f"{path}: {len(source)} panels take", len(source) * A_PANEL)
        told_of += [
            fails(f"{path}: {one.text}") if one.severity == "error" else f"{path}: {one}" for one in findings(source)
        ]
    elif not isinstance(source, Scene):
        told_of += map(fails, gaps_of(source).words())
    check_picture(screenshot, VIEWS)
    check_picture(page, PAGES)
    if screenshot is None and page is None:
        check_display()
    picture = _pressure(source, path, omega, heading) if field == "pressure" else _mesh(source, field)
    if page is not None:
        _write_page(picture, page)
    if page is None or screenshot is not None:
        _show(picture, screenshot)
    for made in (page, screenshot):
        if made is not None:
            print(made)
    return tell(told_of, remark="")


def _write_page(picture, page):
    from hakobune.meshing.view import write_page

    _quiet()
    write_page(drawn(picture), page)


def _show(picture, screenshot):
    from hakobune.meshing.view import show

    _quiet()
    show(drawn(picture, off_screen=screenshot is not None), picture.mesh.name or "panel mesh", screenshot)


def _quiet():
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # it warns in colour of a display nobody asked for


def drawn(picture, off_screen=True):
    """A pyvista Plotter that shows a whole Picture"""
    from hakobune.meshing.view import scene

    from .camera import fit

    plotter = scene(
        picture.mesh,
        picture.lid,
        field=picture.field,
        field_name=picture.field_name,
        normals=picture.field is None,
        depth=picture.depth,
        off_screen=off_screen,
        font=font_file(picture.mesh.name),
    )
    fit(plotter, picture.mesh, bar=picture.field is not None)
    return plotter


def _opened(path):
    """The database, Scene or PanelMesh of a file"""
    if path.suffix in DATABASES:
        from hakobune.bem.database import open_database

        return open_database(path)
    if path.suffix == ".toml":
        return make_scene(read_scene(path))
    from hakobune.meshing.files import read_mesh

    return read_mesh(path)


def _mesh(source, field):
    mesh, lid, depth = _meshes(source)
    name, values = FIELDS[field] if field else ("", lambda mesh: None)
    return Picture(mesh, lid, depth, values(mesh), name)


def _meshes(source):
    """Return (hull, lid or None, depth in m) of a database, a Scene or a PanelMesh"""
    if isinstance(source, PanelMesh):
        return source, None, np.inf
    if isinstance(source, Scene):
        from ..solve.hull import make_hull

        hull = make_hull(source)
        return hull.mesh, hull.lid, source.water.depth
    return source.mesh, source.lid, source.water_depth


def _pressure(db, path, omega, heading):
    """Amplitude of the dynamic pressure at a stored heading and the stored frequency nearest to the requested one"""
    if path.suffix not in DATABASES:
        raise SceneError(f"{path} contains no pressure; repeat the command that made it, with --only pressure")
    if omega is None or heading is None:
        raise SceneError("the pressure depends on frequency and heading; give --omega rad/s and --heading degrees")
    amplitude = np.abs(db["pressure"])
    i, j = _nearest(db, omega), _stored(db, heading)
    if abs(db.omega[i] - omega) > 1e-9 * omega:
        print(f"note: omega {omega:g} rad/s is not stored; the nearest, {db.omega[i]:.4g} rad/s, is shown")
    if not np.any(np.isfinite(amplitude[i, j])):
        raise SceneError(
            f"the pressure at {db.omega[i]:.4g} rad/s is not a number on any panel; solve it again with --fresh"
        )
    state = "fixed" if db.inertia_matrix is None else "floating freely"
    place = f"omega {db.omega[i]:.4g} rad/s, heading {np.degrees(db.wave_direction[j]):.4g}°"  # VTK has no Greek
    title = f"dynamic pressure in Pa per m of wave, {place}: {db.mesh.name}, {state}"
    return Picture(replace(db.mesh, name=title), None, db.water_depth, amplitude[i, j], "Pa/m")


def _nearest(db, omega):
    """Index of the nearest stored frequency.  Raises SceneError if none is close enough."""
    if not db.omega[0] * 0.9 <= omega <= db.omega[-1] * 1.1:
        raise SceneError(f"--omega is {omega:g}; stored in {db.path}: {db.omega[0]:.4g} to {db.omega[-1]:.4g} rad/s")
    return int(np.argmin(np.abs(db.omega - omega)))


def _stored(db, heading):
    """Index of a stored heading in degrees, modulo full circles.  Raises SceneError if it is not stored."""
    if not -360 <= heading <= 360:
        raise SceneError(f"--heading is {heading:g}; allowed: -360 to 360")
    stored = np.degrees(db.wave_direction)
    turn = np.abs((stored - heading + 180) % 360 - 180)
    if turn.min() > SAME_HEADING:
        raise SceneError(
            f"--heading is {heading:g}; stored in {db.path}: {_listed(stored)} degrees; "
            f"give one of these, or add it by the command that made the file, with --heading {heading:g}"
        )
    return int(np.argmin(turn))


def _listed(degrees):
    shown = ", ".join(f"{value:.7g}" for value in degrees[:MOST_LISTED])
    return shown + (f" … {degrees[-1]:.7g} ({len(degrees)} in all)" if len(degrees) > MOST_LISTED else "")
