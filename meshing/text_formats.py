"""Plain-text panel files: GDF of WAMIT, OBJ and STL, and the writers for Nemoh and HAMS, read by `node_lists`.

WAMIT, Nemoh and HAMS number the corners of a panel counter-clockwise seen from the water (WAMIT user manual, section
6.1), like PanelMesh. Normals keep the direction of the file, into the water.  Readers change no orientation;
`meshing.quality.findings` reports wrong ones.
"""

import math
import re

import numpy as np

from .curved.splines import panelled
from .panels import PanelMesh
from .text_files import is_number, read_text
from .whole_files import write_whole

FOOT = 0.3048  # m


def read_gdf(path):
    """Low-order WAMIT geometry: header, ULEN GRAV, ISX ISY, NPAN, then four corners for each panel.

    GRAV determines whether lengths are metres or feet; ULEN does not scale the corners.
    """
    lines = read_text(path, errors="replace").splitlines()
    if len(lines) < 4:
        raise ValueError(f"{path} has {len(lines)} lines; a GDF file needs a header, ULEN GRAV, ISX ISY, NPAN, panels")
    if all(len(line.split()) == 3 and all(map(is_number, line.split())) for line in lines[:4]):
        raise ValueError(f"{path} begins with coordinates; a GDF file has a header, ULEN GRAV, ISX ISY, NPAN, panels")
    _, gravity = _numbers(path, 2, lines[1], 2)
    unit = length_unit(path, gravity)
    symmetry = _symmetry(path, 3, _numbers(path, 3, lines[2], 2))
    (panels,) = _numbers(path, 4, lines[3], 1)
    kind = lines[3].split()[1:2]
    if kind and is_number(kind[0]):
        return _of_patches(path, lines, int(panels), float(kind[0]), unit, symmetry)
    values = _all_numbers(path, lines, 5)
    if values is None or len(values) != 12 * panels:
        values = _panel_by_panel(path, lines, int(panels))
    points = unit * np.reshape(values, (-1, 3))
    return PanelMesh(points, np.arange(len(points)).reshape(-1, 4), symmetry)


def _of_patches(path, lines, patches, kind, unit, symmetry):
    """The panels of a higher-order file of B-splines"""
    if kind != 1:
        raise ValueError(
            f"{path}, line 4: {lines[3].strip()!r} is a higher-order file of kind {kind:g}; allowed: flat panels, or "
            "B-splines (IGDEF 1)"
        )
    numbers = _all_numbers(path, lines, 5)
    if numbers is None:
        raise ValueError(f"{path}: the text after line 4 contains something other than numbers")
    try:
        points, corners = panelled(np.array(numbers), patches)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    return PanelMesh(unit * points, corners, symmetry)


def write_gdf(mesh, path):
    """Write a PanelMesh as low-order WAMIT geometry in metres, its mirror planes as ISX and ISY."""
    head = [
        mesh.name or "panel mesh",
        "1.0 9.80665 ULEN GRAV",
        f"{int('x' in mesh.symmetry)} {int('y' in mesh.symmetry)} ISX ISY",
        f"{len(mesh)} NPAN",
    ]
    panels = [_row(corner) for panel in mesh.vertices for corner in panel]
    write_whole(path, "\n".join([*head, *panels, ""]))


def write_nemoh(mesh, path):
    """Write a PanelMesh for Nemoh, which supports only the mirror plane y = 0; images in x = 0 become panels."""
    if "x" in mesh.symmetry:
        whole = mesh.whole()
        if mesh.symmetry == "xy":
            whole = PanelMesh(mesh.points, mesh.corners, "x", mesh.name).whole()
        mesh = PanelMesh(whole.points, whole.corners, mesh.symmetry.replace("x", ""), mesh.name)
    points = [f"{i} {_row(point)}" for i, point in enumerate(mesh.points, 1)]
    panels = [" ".join(map(str, panel + 1)) for panel in mesh.corners]
    head = f"2 {int(mesh.symmetry == 'y')}"
    write_whole(path, "\n".join([head, *points, "0 0. 0. 0.", *panels, "0 0 0 0", ""]))


def write_pnl(mesh, path):
    """Write a PanelMesh for HAMS, with its mirror planes."""
    quads, triangles, _ = split(mesh.corners)
    panels = [*quads, *triangles]
    lines = [
        f"    --------------{mesh.name or 'Hull Mesh File'}---------------",
        "",
        "    # Number of Panels, Nodes, X-Symmetry and Y-Symmetry",
        f"    {len(panels)} {len(mesh.points)} {int('x' in mesh.symmetry)} {int('y' in mesh.symmetry)}",
        "",
        "    #Start Definition of Node Coordinates     ! node_number   x   y   z",
        *(f"{i} {_row(point)}" for i, point in enumerate(mesh.points, 1)),
        "    #End Definition of Node Coordinates",
        "",
        "    #Start Definition of Node Relations   ! panel_number  number_of_vertices   vertices",
        *(f"{i} {len(panel)} {' '.join(map(str, panel + 1))}" for i, panel in enumerate(panels, 1)),
        "    #End Definition of Node Relations",
        "",
    ]
    write_whole(path, "\n".join(lines))


def read_obj(path):
    """Wavefront OBJ: points `v x y z` and panels `f` with numbers of points, from 1, or −1 for the last point read;
    normals are ignored.

    A corner may be point/texture/normal: only the first number is a point. Polygons of more than four corners are cut,
    which preserves the surface of convex polygons.  Coordinates are taken as m.
    Raises ValueError, which names the line.
    """
    points, panels = [], []
    for k, line in enumerate(read_text(path, errors="replace").replace("\\\n", " ").splitlines(), 1):
        what, *words = line.split("#")[0].split() or [""]
        if what == "v":
            points.append(_numbers(path, k, " ".join(words), 3))
        elif what == "f":
            corners = [_number(path, k, word.split("/")[0]) for word in words]
            corners = [value if value > 0 else len(points) + 1 + value for value in corners]
            panels += [(k, part) for part in cut(corners)]
    numbers = {number: place for place, number in enumerate(range(1, len(points) + 1))}
    corners = [_panel(path, k, row, numbers) for k, row in panels]
    return PanelMesh(np.reshape(points, (-1, 3)), np.reshape(corners, (-1, 4)).astype(int))


def read_stl(path):
    """Triangles of a text .stl: a triangle is three lines `vertex x y z`, with any lines between them; coordinates in m

    raises : ValueError, which names a word that is no number, or vertices not in groups of three
    """
    words = re.findall(r"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", read_text(path, errors="replace"), re.IGNORECASE)
    wrong = next((word for row in words for word in row if not is_number(word)), None)
    if wrong is not None:
        raise ValueError(f"{path}: {_shown(wrong)} of a vertex is not a number")
    points = np.array(words, float)
    if not len(points) or len(points) % 3:
        raise ValueError(f"{path} has {len(points)} vertices; allowed: three for each triangle")
    return PanelMesh(points, np.arange(len(points)).reshape(-1, 3)[:, [0, 1, 2, 2]])


def cut(corners):
    """Panels of three or four corners cut from a polygon at its first corner; a polygon of three or four corners is
    kept"""
    last = max(len(corners) - 1, 2)
    return [[corners[0], *corners[i : i + 3]] for i in range(1, last, 2)]


def split(corners):
    """Panels (n, 4) as quadrilaterals (q, 4) and triangles (t, 3), and the panel numbers (n,) in this new order.

    Raises ValueError for a panel with fewer than three different corners.
    """
    repeated = corners == np.roll(corners, -1, axis=1)
    is_triangle = repeated.any(axis=1)
    if np.any(repeated.sum(axis=1) > 1):
        raise ValueError(
            f"panel {int(repeated.sum(axis=1).argmax())} has fewer than three different corners; see the mesh findings"
        )
    triangles = corners[is_triangle][~repeated[is_triangle]].reshape(-1, 3)
    return corners[~is_triangle], triangles, np.argsort(is_triangle, kind="stable")


def _row(point):
    return " ".join(repr(float(c) + 0.0) for c in point)  # + 0.0: minus zero is zero


def _panel(path, k, row, numbers):
    """Point numbers of a panel, from those of the file; shape (4,); a triangle repeats its last one"""
    if len(row) < 3:
        raise ValueError(f"{path}, line {k} has {len(row)} nodes; a panel has 3 or 4")
    try:
        corners = [numbers[value] for value in row[:4]]
    except KeyError as error:
        raise ValueError(
            f"{path}, line {k}: there is no point {error.args[0]:g}; the file has {len(numbers)}"
        ) from None
    return corners if len(corners) == 4 else [*corners, corners[-1]]


def length_unit(path, gravity):
    """Unit of length of a GDF file, m, from its acceleration of gravity.  Raises ValueError if it is neither m nor
    ft."""
    if 9.7 < gravity < 9.9:
        return 1.0
    if 31.8 < gravity < 32.5:
        return FOOT
    raise ValueError(f"{path}, line 2: GRAV is {gravity:g}; allowed: 9.80665 (metres) or 32.174 (feet)")


def _symmetry(path, k, flags):
    if any(flag not in (0, 1) for flag in flags):
        raise ValueError(f"{path}, line {k}: symmetry {flags[0]:g} {flags[1]:g}; allowed: 0 or 1 each")
    return "".join(axis for axis, flag in zip("xy", flags, strict=True) if flag)


def _numbers(path, k, line, count):
    words = line.split()
    if len(words) < count:
        raise ValueError(f"{path}, line {k} is {line.strip()!r}; it needs {count} numbers")
    return [_number(path, k, word) for word in words[:count]]


def _all_numbers(path, lines, first):
    """Numbers of all words from line `first` on, counted from 1; None where a word is no number"""
    try:
        values = [float(word) for line in lines[first - 1 :] for word in line.split()]
    except ValueError:
        return None
    return values if np.all(np.isfinite(values)) else None


def _panel_by_panel(path, lines, panels):
    """Twelve numbers of each panel, as WAMIT reads them: each panel begins a new line and may continue on further lines

    Text after the twelfth number on its line is a remark, as is text after the last panel, except dipole panels.
    """
    values, k = [], 4
    for number in range(1, panels + 1):
        wanted = 12
        while wanted:
            if k >= len(lines):
                raise ValueError(
                    f"{path}: {len(values)} coordinates after line 4; {panels} panels need {12 * panels}, and panel "
                    f"{number} is incomplete"
                )
            words, k = lines[k].replace(",", " ").split(), k + 1
            values += [_number(path, k, word) for word in words[:wanted]]
            wanted -= min(wanted, len(words))
    for i, line in enumerate(lines[k:], k + 1):
        words = line.split()
        if words and is_number(words[0]) and float(words[0]) > 0:
            raise ValueError(
                f"{path}, line {i}: {line.strip()!r} follows the {panels} panels: either dipole panels (NPAND) or a "
                "wrong NPAN; allowed: bodies with a volume, and NPAN equal to the number of panels"
            )
        break
    return values


def _number(path, k, word):
    try:
        value = float(word.rstrip(",").replace("D", "E").replace("d", "e"))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{path}, line {k}: {_shown(word)} is not a finite number")
    return value


def _shown(word):
    return repr(word if len(word) <= 40 else f"{word[:40]}…")
