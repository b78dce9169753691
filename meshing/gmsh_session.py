"""The only import of gmsh: meshes are made in a session that is always closed, and returned as values.

gmsh keeps one global state per process.  A session therefore holds a lock, reads no user settings and prints nothing.
If the caller has opened gmsh before, the session restores the caller's state.
"""

import signal
import threading
from contextlib import contextmanager

import numpy as np

from .panels import PanelMesh
from .text_formats import split

TRIANGLE, QUADRANGLE = 2, 3  # gmsh element types
SYSTEM_LIBRARIES = "libglu1-mesa libxcursor1 libxft2 libxinerama1 libxrender1 libgl1"

_lock = threading.RLock()


def _import_gmsh():
    try:
        import gmsh
    except OSError as error:
        raise ImportError(
            f"gmsh lacks a system library ({error}); on Debian: apt-get install {SYSTEM_LIBRARIES}; "
            "meshes from files work without gmsh"
        ) from error
    except ImportError as error:
        raise ImportError(f"gmsh is not installed ({error}); pip install gmsh, or give a mesh file") from error
    return gmsh


@contextmanager
def session(name="hakobune"):
    """Context with the gmsh module and an empty model `name`; gmsh prints nothing and is always closed again.

    The session works outside the main thread and does not change Ctrl-C. With `interruptible=False` gmsh sets no
    handler of its own; its handler would replace Python's, and can be set in the main thread only.
    Raises ImportError, which names the missing system library, if gmsh cannot be loaded.
    """
    gmsh = _import_gmsh()
    with _lock:
        already_open = bool(gmsh.isInitialized())
        if not already_open:
            gmsh.initialize(readConfigFiles=False, interruptible=False)
            _restore_sigpipe()
        terminal = gmsh.option.getNumber("General.Terminal")
        before = gmsh.model.getCurrent()
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.model.add(name)
            yield gmsh
        finally:
            if already_open:
                gmsh.model.setCurrent(name)
                gmsh.model.remove()
                gmsh.model.setCurrent(before)
                gmsh.option.setNumber("General.Terminal", terminal)
            else:
                gmsh.finalize()


def _restore_sigpipe():
    """Undo a change by gmsh: with it a closed pipe ends the process, and Python raises no BrokenPipeError."""
    if hasattr(signal, "SIGPIPE") and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGPIPE, signal.getsignal(signal.SIGPIPE))


def graded_patches(patches, symmetry="", name=""):
    """Flat patches filled with structured quadrilaterals whose outer corners are the given points of the sides.

    patches : list of patches; a patch is a list of 4 (or 3) sides, counter-clockwise seen from the water, and a side
        is a polyline (k, 3) m that shares its ends with its neighbours.
        Opposite sides have equal numbers of points.  A
        patch of three sides is polar about the first point of the first side. The third side has as many points as the
        first, and the panels at that point are triangles.
    returns : PanelMesh in which patches share their common points

    gmsh has no cosine spacing for the points of a side. Every segment is therefore a line of one element, and the
    corners of the patch are passed to gmsh.
    """
    with session(name or "patches") as gmsh:
        build = _Builder(gmsh)
        surfaces = [build.patch(sides) for sides in patches]
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(2)
        outward = {tag: _ring_vector(_around(sides)) for tag, sides in zip(surfaces, patches, strict=True)}
        return _poles_last(panels_of(gmsh, outward, symmetry, name), [s[0][0] for s in patches if len(s) == 3])


def _poles_last(mesh, poles):
    """The same mesh with the pole as last corner of each triangle there, so that the elements are symmetric"""
    corners = mesh.corners.copy()
    for pole in poles:
        for shift in (1, 2):
            here = (corners[:, 2] == corners[:, 3]) & np.all(mesh.points[corners[:, shift - 1]] == pole, axis=1)
            corners[here] = np.roll(corners[here, :3], -shift, axis=1)[:, [0, 1, 2, 2]]
    return PanelMesh(mesh.points, corners, mesh.symmetry, mesh.name)


def filled(outer, holes=(), size=1.0, symmetry="", name=""):
    """A flat polygon filled with quadrilaterals (a few triangles) of edges about `size`.

    outer : closed polygon, m, (k, 3), without repeating the first point, counter-clockwise seen from the side that
        the normals point to; holes : polygons inside the outer polygon, of any orientation
    """
    with session(name or "filled") as gmsh:
        build = _Builder(gmsh)
        loops = [build.loop(ring, size) for ring in (outer, *holes)]
        surface = gmsh.model.geo.addPlaneSurface(loops)
        gmsh.model.geo.mesh.setRecombine(2, surface)
        gmsh.model.geo.synchronize()
        gmsh.option.setNumber("Mesh.Algorithm", 8)  # frontal Delaunay for quadrilaterals
        gmsh.model.mesh.generate(2)
        return panels_of(gmsh, {surface: _ring_vector(outer)}, symmetry, name)


def panels_of(gmsh, surfaces=None, symmetry="", name=""):
    """PanelMesh of the triangles and quadrilaterals of the current model.

    surfaces : {surface tag: vector (3,) to the side of the normals, or None to keep the normals}; None: all surfaces
        of the model
    """
    if surfaces is None:
        surfaces = {tag: None for _, tag in gmsh.model.getEntities(2)}
    tags, points, _ = gmsh.model.mesh.getNodes()
    points = np.reshape(points, (-1, 3))
    row = np.zeros(int(tags.max(initial=0)) + 1, np.int64)
    row[tags.astype(np.int64)] = np.arange(len(tags))
    blocks = [_surface_panels(gmsh, tag, row, points, along) for tag, along in surfaces.items()]
    corners = np.concatenate(blocks) if blocks else np.zeros((0, 4), np.int64)
    used, back = np.unique(corners, return_inverse=True)
    return PanelMesh(points[used], back.reshape(-1, 4), symmetry, name)


def write_msh(meshes, path):
    """Write a .msh file (format 4.1): every mesh is one surface and one physical group.

    meshes : {name of the group: PanelMesh without mirror planes}
    """
    with session("write") as gmsh:
        first_node = first_element = 1
        for group, mesh in meshes.items():
            surface = gmsh.model.addDiscreteEntity(2)
            gmsh.model.mesh.addNodes(2, surface, np.arange(len(mesh.points)) + first_node, mesh.points.ravel())
            quads, triangles, _ = split(mesh.corners)
            for kind, corners in ((QUADRANGLE, quads), (TRIANGLE, triangles)):
                if len(corners):
                    tags = np.arange(len(corners)) + first_element
                    gmsh.model.mesh.addElementsByType(surface, kind, tags, (corners + first_node).ravel())
                    first_element += len(corners)
            first_node += len(mesh.points)
            gmsh.model.addPhysicalGroup(2, [surface], name=group)
        gmsh.write(str(path))


class _Builder:
    """Points and lines identified by their coordinates, so that neighbouring patches share them."""

    def __init__(self, gmsh):
        self.geo = gmsh.model.geo
        self.points, self.lines = {}, {}

    def ring(self, corners, size=0.0):
        """Tags of the points of a closed polygon (k, 3) m, with elements of about `size` m, and signed tags of its
        sides"""
        points, lines = [], []
        for key in map(tuple, (np.asarray(corners, float) + 0.0).tolist()):  # + 0.0: minus zero is zero
            if key not in self.points:
                self.points[key] = self.geo.addPoint(*key, size)
            points.append(self.points[key])
        for a, b in zip(points, points[1:] + points[:1], strict=True):
            if (a, b) not in self.lines:
                self.lines[a, b] = self.geo.addLine(a, b)
                self.lines[b, a] = -self.lines[a, b]
            lines.append(self.lines[a, b])
        return points, lines

    def patch(self, sides):
        """Tag of a surface that has one element between every two points of its sides, as in `graded_patches`"""
        points, lines = self.ring(_around(sides))
        for line in lines:
            self.geo.mesh.setTransfiniteCurve(abs(line), 2)
        surface = self.geo.addPlaneSurface([self.geo.addCurveLoop(lines)])
        first = np.cumsum([0, *map(len, sides[:-1])]) - np.arange(len(sides))
        self.geo.mesh.setTransfiniteSurface(surface, cornerTags=[points[i] for i in first])
        self.geo.mesh.setRecombine(2, surface)
        return surface

    def loop(self, ring, size):
        """Tag of the loop of a closed polygon (k, 3) m"""
        return self.geo.addCurveLoop(self.ring(ring, size)[1])


def _surface_panels(gmsh, surface, row, points, along):
    """Corners on one surface, oriented so that normals point along the vector `along`; shape (n, 4)"""
    quads = row[gmsh.model.mesh.getElementsByType(QUADRANGLE, surface)[1].astype(np.int64)].reshape(-1, 4)
    triangles = row[gmsh.model.mesh.getElementsByType(TRIANGLE, surface)[1].astype(np.int64)].reshape(-1, 3)
    corners = np.concatenate([quads, triangles[:, [0, 1, 2, 2]]])
    if along is None or not len(corners):
        return corners
    v = points[corners]
    vector = 0.5 * np.cross(v[:, 2] - v[:, 0], v[:, 3] - v[:, 1]).sum(axis=0)
    return corners if vector @ along > 0 else corners[:, [0, 3, 2, 1]]


def _ring_vector(ring):
    """Vector area of a closed polygon (k, 3); shape (3,)"""
    ring = np.asarray(ring, float) - np.asarray(ring, float)[0]
    return 0.5 * np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0)


def _around(sides):
    """The polygon of the sides of a patch, m; shape (k, 3)"""
    return np.concatenate([np.asarray(side)[:-1] for side in sides])
