"""Reading and writing panel meshes; the suffix of the file determines the format.

.gdf (WAMIT), .nemoh, .mar and .dat (Nemoh), .pnl (HAMS) and .vtu are read and written; .msh is read through meshio and
written by gmsh; .vtk, .vtp, .stl, .ply, .obj, .off, .hst (HydroStar) and .dat of Diodore, Salome and AQWA are read.
A .toml is a drawing, which gmsh meshes (`drawing`).
"""

import contextlib
import io
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from . import node_lists, text_formats
from .panels import NO_AREA, PanelMesh, joined
from .text_files import check_size
from .whole_files import made_beside

TEXT_READERS = {
    ".gdf": text_formats.read_gdf,
    ".nemoh": node_lists.read_nemoh,
    ".mar": node_lists.read_nemoh,
    ".dat": node_lists.read_dat,
    ".pnl": node_lists.read_pnl,
    ".hst": node_lists.read_hydrostar,
    ".obj": text_formats.read_obj,
}
TEXT_WRITERS = {
    ".gdf": text_formats.write_gdf,
    ".nemoh": text_formats.write_nemoh,
    ".mar": text_formats.write_nemoh,
    ".dat": text_formats.write_nemoh,
    ".pnl": text_formats.write_pnl,
}
MESHIO = (".msh", ".vtu", ".vtk", ".stl", ".ply", ".off")
READABLE = (*TEXT_READERS, *MESHIO, ".vtp", ".toml")
WRITABLE = (*TEXT_WRITERS, ".msh", ".vtu")

LARGEST = 32  # MB; a hundred thousand panels with all digits, more than any method of this program solves
COUNTS = re.compile(  # counts from which readers allocate arrays, whatever the file contains
    rb"element[ \t]+\w+[ \t]+(\d+)|POINTS[ \t]+(\d+)|(?:CELLS|POLYGONS)[ \t]+(\d+)[ \t]+(\d+)|"
    rb"NumberOf(?:Points|Cells|Polys)=\"(\d+)\"|\$(?:Nodes|Elements)\s+(\d+)[ \t]*(\d*)|^OFF\s+(\d+)[ \t]+(\d+)"
)
PACKED = 1000.0  # values for a byte, at most, of a compressed file
SAME_POINT = 1e-6  # points closer than this share of the mesh size are one point
DRAWN = 4e-3  # distance from the surface or a mirror plane of points that are moved into it, as a share of its edge


def read_mesh(path):
    """Panels of the wetted hull in a file, as PanelMesh.

    Points closer than 1e-6 of the mesh size are merged; points within `DRAWN` of a typical edge of z = 0 or of a mirror
    plane are moved into it.  Panels in z = 0 whose normals point up (a lid or a deck) touch no water and are removed,
    as are panels without area.  A half or quarter hull on the negative side of its mirror plane is reflected to the
    positive side.  Nothing else is changed; `meshing.quality.findings` reports faults.
    Raises ValueError, which names the file and its fault, and FileNotFoundError.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in READABLE:
        raise ValueError(f"{path}: cannot read {suffix or 'a file without suffix'}; allowed: {', '.join(READABLE)}")
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such file")
    check_size(path, largest=LARGEST)
    if suffix not in (*TEXT_READERS, ".toml"):
        _check_head(path)
        _check_counts(path)
    if suffix == ".toml":
        from .drawing import read_drawing

        return read_drawing(path)
    read = TEXT_READERS.get(suffix, _read_with_meshio)
    if suffix == ".vtp" or (suffix == ".vtk" and _says(path, b"dataset polydata")):
        read = _read_poly_data
    elif suffix == ".stl" and _says(path, b"facet") and _says(path, b"vertex"):
        read = text_formats.read_stl
    mesh = read(path)
    if not len(mesh):
        raise ValueError(f"{path}: no panels in it")
    if not np.all(np.isfinite(mesh.points)):
        raise ValueError(f"{path}: a coordinate is not a finite number")
    hull = wetted(_as_meant(mesh))
    if not len(hull) or (np.all(hull.vertices[..., 2] == 0) and np.all(hull.area_vectors[:, 2] > 0)):
        raise ValueError(
            f"{path}: all its panels lie in the water surface and face up: it is a lid or a deck, not a hull"
        )
    return replace(wetted(_on_positive_side(hull).merged(SAME_POINT)), name=path.stem)  # merging closes up slivers


def write_mesh(mesh, path, lid=None, fields=None):
    """Write a hull and, if given, the lid of the hull.

    mesh, lid : PanelMesh with the same mirror planes
    path : .gdf, .pnl store the mirror planes; .nemoh, .dat store y = 0; .msh, .vtu store the whole hull
    fields : one real value for each panel, {name: (n,)}, for .vtu
    raises : ValueError for a suffix without a writer, or for fields of the wrong shape
    """
    path, fields = Path(path), fields or {}
    suffix = path.suffix.lower()
    if suffix not in WRITABLE:
        raise ValueError(f"{path}: cannot write {suffix or 'without suffix'}; allowed: {', '.join(WRITABLE)}")
    if fields and suffix != ".vtu":
        raise ValueError(f"{path}: a {suffix} file cannot store fields; allowed: .vtu")
    if suffix in TEXT_WRITERS:
        both = mesh if lid is None else joined([mesh, lid])
        TEXT_WRITERS[suffix](replace(both, name=mesh.name), path)
    elif suffix == ".msh":
        from .gmsh_session import write_msh

        with made_beside(path) as partial:
            write_msh({"hull": mesh.whole()} | ({} if lid is None else {"lid": lid.whole()}), partial)
    else:
        with made_beside(path) as partial:
            _write_vtu(mesh, partial, lid, fields)


def _as_meant(mesh):
    """The mesh with points that lie slightly off the surface or a mirror plane moved into it"""
    reach = DRAWN * float(np.median(mesh.sizes))
    points = mesh.points.copy()
    for axis in ("z", *mesh.symmetry):
        column = points[:, "xyz".index(axis)]
        column[np.abs(column) <= reach] = 0.0
    return replace(mesh, points=points)


def wetted(mesh):
    """The mesh without panels in z = 0 that face the air, and without panels of zero area

    If the top of the mesh is above z = 0 and its lowest point at z = 0, the bottom is kept, whichever side it faces:
    such a mesh is to be moved down.
    """
    flat = np.all(mesh.vertices[..., 2] == 0, axis=1) & np.any(mesh.vertices[..., 2] < 0)
    dry = (flat & (mesh.area_vectors[:, 2] > 0)) | (mesh.areas <= NO_AREA * mesh.sizes**2)
    used, corners = np.unique(mesh.corners[~dry], return_inverse=True)
    return replace(mesh, points=mesh.points[used], corners=corners.reshape(-1, 4))


def _on_positive_side(mesh):
    """The same hull as its half x ≥ 0, y ≥ 0, if the file stores the other half"""
    for axis in mesh.symmetry:
        side = mesh.points[:, "xy".index(axis)]
        if side.max() <= 0 and side.min() < 0:  # `_as_meant` moved points near the plane into it
            points = mesh.points.copy()
            points[:, "xy".index(axis)] *= -1
            mesh = replace(mesh, points=points, corners=mesh.corners[:, ::-1])
    return mesh


def _check_head(path):
    """Raise ValueError where the header of a file has no end: meshio would search for the end without limit."""
    suffix, content = path.suffix.lower(), path.read_bytes()
    said = [line for line in content.splitlines() if line.strip() and not line.lstrip().startswith(b"#")]
    whole = 84 + 50 * int.from_bytes(content[80:84], "little")
    if suffix == ".stl" and b"facet" not in content and 84 <= len(content) < whole:
        raise ValueError(
            f"{path}: its header announces {(whole - 84) // 50} triangles in {whole} bytes, but the file has "
            f"{len(content)} bytes; write or copy it again"
        )
    if (suffix == ".ply" and b"end_header" not in content) or (suffix == ".off" and len(said) < 2):
        raise ValueError(f"{path}: it ends within its header; write or copy it again")


def _check_counts(path):
    """Raise ValueError for a file whose counts of points or panels exceed its size in bytes."""
    content = path.read_bytes()
    most = len(content) * (PACKED if path.suffix.lower() == ".vtu" else 1.0)
    for found in COUNTS.finditer(content):
        for count in filter(None, found.groups()):
            if float(count) > most:
                raise ValueError(
                    f"{path}: it announces {float(count):.6g} points or panels, too many for its {len(content)} "
                    "bytes; write or copy it again"
                )


def _says(path, words):
    with open(path, "rb") as file:
        return words in file.read(4096).lower()


def _read_poly_data(path):
    """Polygons of VTK poly data, in a .vtp or an old .vtk file, as ParaView and meshmagick write them"""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    vtkObject.GlobalWarningDisplayOff()
    reader = vtkXMLPolyDataReader() if path.suffix.lower() == ".vtp" else vtkPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutput()
    polygons = found.GetPolys()
    if reader.GetErrorCode() or not polygons.GetNumberOfCells():
        lines = found.GetNumberOfLines() + found.GetNumberOfStrips() + found.GetNumberOfVerts()
        state = "it has lines, points or strips, but no polygons" if lines else "it cannot be read, or it is empty"
        raise ValueError(f"{path}: {state}; allowed: polygons")
    points = np.array(vtk_to_numpy(found.GetPoints().GetData()), float)
    starts = vtk_to_numpy(polygons.GetOffsetsArray())
    sides, numbers = np.diff(starts), vtk_to_numpy(polygons.GetConnectivityArray())
    if sides.min() < 3 or numbers.min() < 0 or numbers.max() >= len(points):
        raise ValueError(
            f"{path} has polygons of {sides.min()} to {sides.max()} corners; allowed: 3 or more corners, "
            f"all of them points of the file"
        )
    parts = [part for polygon in np.split(numbers, starts[1:-1]) for part in text_formats.cut(polygon.tolist())]
    return PanelMesh(points, np.array([part if len(part) == 4 else [*part, part[-1]] for part in parts]))


def _read_with_meshio(path):
    import meshio

    said = io.StringIO()
    try:
        quiet = np.errstate(over="ignore")  # meshio reads four letters of a text .stl as a count of triangles
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), quiet:
            found = meshio.read(path)
    except (Exception, SystemExit) as error:  # meshio exits the program when it cannot read a file
        cause = str(error) if str(error) not in ("", "1") else " ".join(said.getvalue().split())
        raise ValueError(f"{path}: cannot be read ({cause or type(error).__name__})") from error
    try:
        quads = np.asarray(found.cells_dict.get("quad", np.zeros((0, 4))), np.int64)
        triangles = np.asarray(found.cells_dict.get("triangle", np.zeros((0, 3))), np.int64)
    except (OverflowError, TypeError, ValueError):
        raise ValueError(f"{path}: the point numbers of its panels are not whole numbers") from None
    if not len(quads) + len(triangles):
        kinds = ", ".join(sorted(found.cells_dict)) or "nothing"
        raise ValueError(f"{path} contains {kinds}; allowed: triangle, quad")
    points = found.points if found.points.shape[1] == 3 else np.pad(found.points, ((0, 0), (0, 1)))
    return PanelMesh(points, np.concatenate([quads, triangles[:, [0, 1, 2, 2]]]))


def _write_vtu(mesh, path, lid, fields):
    """The whole hull with cell data: `lid` 0 or 1, and the fields, NaN on the lid."""
    import meshio

    hull = mesh.whole()
    values = {name: _on_whole(name, field, mesh) for name, field in fields.items()}
    whole = hull if lid is None else joined([hull, lid.whole()])
    extra = len(whole) - len(hull)
    values = {name: np.concatenate([v, np.full(extra, math.nan)]) for name, v in values.items()}
    values["lid"] = np.concatenate([np.zeros(len(hull)), np.ones(extra)])
    quads, triangles, order = text_formats.split(whole.corners)
    cells = [(kind, block) for kind, block in (("quad", quads), ("triangle", triangles)) if len(block)]
    cuts = np.cumsum([len(block) for _, block in cells])[:-1]
    data = {name: np.split(v[order], cuts) for name, v in values.items()}
    meshio.Mesh(whole.points, cells, cell_data=data).write(path)


def _on_whole(name, field, mesh):
    values = np.asarray(field, float)
    if values.shape != (len(mesh),):
        raise ValueError(f"field {name!r} has shape {values.shape}; allowed: ({len(mesh)},), one value for each panel")
    return np.tile(values, mesh.copies)
