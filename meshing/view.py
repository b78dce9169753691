"""A picture of a mesh: the whole hull with panel edges, normals, waterline, lid and a field on the panels."""

import math

import numpy as np

from .text_formats import split
from .whole_files import made_beside

HULL, HULL_EDGE = "#c9d6df", "#52616b"
LID, LID_EDGE, WATERLINE, NORMAL, BED, TEXT = "#5ec4b6", "#146c62", "#0b3c5d", "#e07a2f", "#b8a27a", "#1f2933"
MOST_NORMALS = 300  # arrows; more hide the hull


def scene(mesh, lid=None, field=None, field_name="", normals=True, depth=math.inf, off_screen=False, font=None):
    """A pyvista Plotter that shows the whole hull.

    mesh, lid : PanelMesh
    field : one value for each panel of `mesh` or of the whole hull, (n,), shown by colours with a bar named
        `field_name`
    normals : whether arrows point out of the hull, on a part of the panels if there are many panels
    depth : depth of the sea bed, which is drawn if finite, m; font : font file with the letters of the name, or None
    Raises ValueError for a field without one value per panel.
    """
    import pyvista as pv

    whole = mesh.whole()
    values = None if field is None else _on_whole(field, mesh)
    plotter = pv.Plotter(off_screen=off_screen, window_size=(1400, 900))
    plotter.set_background("white", top="#e6eef5")
    _draw_hull(plotter, whole, values, field_name or "field")
    if normals:
        plotter.add_mesh(_arrows(whole), color=NORMAL, lighting=False)
    if lid is not None:
        style = {"opacity": 0.4, "show_edges": True, "edge_color": LID_EDGE, "line_width": 2}
        plotter.add_mesh(_surface(lid.whole()), color=LID, lighting=False, **style)
    line = _waterline(whole)
    if line is not None:
        plotter.add_mesh(line, color=WATERLINE, line_width=5, render_lines_as_tubes=True)
    if math.isfinite(depth):
        plotter.add_mesh(_bed(whole, depth), color=BED, opacity=0.5, lighting=False)
    plotter.add_text(_caption(mesh, lid, depth), position="upper_left", font_size=11, color=TEXT, font_file=font)
    plotter.add_axes(color=TEXT)
    _place_camera(plotter, whole)
    return plotter


def show(plotter, title, screenshot=None):
    """Show a Plotter in a window, or write its picture to the file `screenshot` without a display; then close the
    Plotter."""
    try:
        if screenshot is None:
            plotter.show(title=title)
        else:
            with made_beside(screenshot) as partial:
                plotter.screenshot(str(partial))
    finally:
        plotter.close()


def write_page(plotter, path):
    """Write a Plotter as an HTML page, on which a browser can turn the hull without a network; then close the Plotter.

    Raises ValueError if the packages for pictures are missing.
    """
    import asyncio

    try:
        from trame_pyvista.jupyter import launch_server
    except ImportError:
        raise ValueError(
            "a page that shows a turning mesh needs trame-pyvista; install it by: pip install 'hakobune[page]'"
        ) from None

    async def write(partial):
        await launch_server().ready
        plotter.trame.export_html(str(partial))

    try:
        with made_beside(path) as partial:
            asyncio.run(write(partial))
    finally:
        plotter.close()


def _draw_hull(plotter, whole, values, field_name):
    surface = _surface(whole)
    style = {"show_edges": True, "edge_color": HULL_EDGE, "line_width": 1}
    if values is None:
        plotter.add_mesh(surface, color=HULL, ambient=0.3, **style)
        return
    surface.cell_data[field_name] = values
    bar = {"title": field_name, "color": TEXT, "vertical": True, "fmt": "%.3g", "position_x": 0.9}
    plotter.add_mesh(surface, scalars=field_name, cmap="viridis", scalar_bar_args=bar, ambient=0.3, **style)


def _surface(mesh):
    """PolyData with one cell per panel, in the order of the panels"""
    import pyvista as pv

    quads, triangles, order = split(mesh.corners)
    cells = [[4, *panel] for panel in quads] + [[3, *panel] for panel in triangles]
    back = np.argsort(order)
    return pv.PolyData(mesh.points, np.concatenate([cells[k] for k in back]))


def _arrows(mesh):
    """Arrows as long as a typical panel, on an even selection of panels"""
    import pyvista as pv

    shown = np.arange(0, len(mesh), max(1, math.ceil(len(mesh) / MOST_NORMALS)))
    points = pv.PolyData(mesh.centroids[shown])
    points["normal"] = mesh.normals[shown]
    length = float(np.sqrt(np.median(mesh.areas)))
    arrow = pv.Arrow(tip_length=0.3, tip_radius=0.09, shaft_radius=0.03)
    return points.glyph(orient="normal", scale=False, factor=length, geom=arrow)


def _waterline(mesh):
    """Panel edges in z = 0 that belong to only one panel, as lines; None without such edges"""
    import pyvista as pv

    flat = np.abs(mesh.points[:, 2]) <= 1e-6 * max(mesh.draft, 0.0)
    a, b = mesh.corners, np.roll(mesh.corners, -1, axis=1)
    ours = flat[a] & flat[b] & (a != b) & ~flat[a].all(axis=1)[:, None]
    pairs = np.stack([a[ours], b[ours]], axis=1)
    if not len(pairs):
        return None
    return pv.PolyData(mesh.points, lines=np.insert(pairs, 0, 2, axis=1).ravel())


def _bed(mesh, depth):
    import pyvista as pv

    low, high = mesh.vertices.reshape(-1, 3).min(axis=0), mesh.vertices.reshape(-1, 3).max(axis=0)
    middle, size = (low + high) / 2, 1.3 * (high - low)
    return pv.Plane(center=(middle[0], middle[1], -depth), i_size=size[0], j_size=size[1])


def _caption(mesh, lid, depth):
    v = mesh.whole().vertices.reshape(-1, 3)
    extent = np.ptp(v, axis=0)
    lines = [
        mesh.name or "panel mesh",
        f"{extent[0]:.4g} × {extent[1]:.4g} m, draft {mesh.draft:.4g} m"
        + (f", water {depth:.4g} m deep" if math.isfinite(depth) else ""),
        f"{mesh.total} panels, {mesh.copies * mesh.areas.sum():.5g} m² wetted, {mesh.volume:.6g} m³",
    ]
    if lid is not None:
        lines.append(f"lid of {lid.total} panels")
    return "\n".join(lines)


def _place_camera(plotter, mesh):
    """From starboard ahead, above the water: walls outside, bottom through the lid."""
    v = mesh.vertices.reshape(-1, 3)
    middle = (v.min(axis=0) + v.max(axis=0)) / 2
    distance = 2.0 * float(np.linalg.norm(np.ptp(v, axis=0)))
    direction = np.array([0.75, -1.0, 0.6]) / math.sqrt(0.75**2 + 1 + 0.6**2)
    plotter.camera_position = [tuple(middle + distance * direction), tuple(middle), (0, 0, 1)]


def _on_whole(field, mesh):
    values = np.asarray(field, float)
    if values.shape == (len(mesh),):
        return np.tile(values, mesh.copies)
    if values.shape == (mesh.total,):
        return values
    raise ValueError(f"field has shape {values.shape}; allowed: ({len(mesh)},) or ({mesh.total},)")
