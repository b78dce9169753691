"""A hull drawn from its parts in a TOML file: cylinders, cones, spheres, boxes and extruded outlines, as one body.

    size = 2.0                      # m, edges of panels
    symmetry = "xy"                 # mirror planes, "x", "y" or "xy"; omit the key for a body without mirror planes
    around = 24                     # smallest number of panels on a circle
    [[parts]] shape = "cylinder" # from, to : ends of the axis, m; radius : m; end_radius : m, for a cone
    from = [0, 0, -120]
    to = [0, 0, 10]
    radius = 4.7
    turns = 3                       # number of copies, in equal steps about the vertical through the origin
    cut = true                      # the shape is removed from the parts before it: a moonpool

    box : center, m, size, [length, breadth, height]
    sphere : center, radius
    outline : points, [[x, z], …] of a side view, m; breadth, m; y, m, of the middle: a barge with raked ends, a bow

The parts below still water, z = 0, are joined, and gmsh meshes their surface.  The waterplane in z = 0 is left open.
Flat panels with corners on a circle enclose less volume than the circle. All radii are therefore enlarged by about 1 %,
so that the panels enclose the volume of the drawing.
"""

import math
import tomllib
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import NamedTuple
from warnings import warn

import numpy as np

from .gmsh_session import panels_of, session
from .hydrostatics import hydrostatics, waterplane_area

NEEDED = {
    "cylinder": ("from", "to", "radius"),
    "box": ("center", "size"),
    "sphere": ("center", "radius"),
    "outline": ("points", "breadth"),
}
ALLOWED = {"cylinder": ("end_radius",), "outline": ("y",)}
EVERY = ("shape", "turns", "cut")
MOST_PARTS, FINEST, COARSEST = 200, 1e-3, 0.5  # panel size as a share of the size of the hull
MOST_TRIES, SAME_VOLUME = 8, 2e-3  # tries; relative error of the enclosed volume while the corners lie on the body
# rad, angle of a cylinder's seam to x, factor on `around`, and gmsh's algorithm, tried in this order: panels of a
# column cut by a mirror plane may enclose 4 % less or more volume than panels of a whole column, and those of algorithm
# 8 up to 8 % less than the column, so that radii for the right volume give a waterplane that is up to 6 % too large
TRIES = ((0.5 * math.pi, 1.0, 8), (0.0, 1.0, 8), (0.5 * math.pi, 1.5, 8), (0.5 * math.pi, 1.0, 6))
SAME_CENTER = 1e-3  # distance in plan of the centres of buoyancy of drawing and panels, over the length
SAME_PLANE = 0.03  # relative difference of the waterplanes of drawing and panels, and of their volumes
AT_SURFACE = 1e-6  # distance from z = 0 below which a point lies in the surface, as a share of the hull's size


class Drawn(NamedTuple):
    """Properties of the exact drawing, without panels: volume, m³, centre of buoyancy, m, (3,), and waterplane area,
    m²"""

    volume: float
    center: np.ndarray
    plane: float


@dataclass
class Drawing:
    """size : edge length of panels, m; symmetry : mirror planes, as in PanelMesh; around : smallest number of panels
    on a circle; parts : [(table of the part, turn in rad)]"""

    size: float
    symmetry: str = ""
    around: int = 24
    parts: list = field(default_factory=list)


def read_drawing(path):
    """PanelMesh of a drawing.  Raises ValueError, which names the file, the part and the allowed values."""
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: {error}") from None
    try:
        return meshed(drawing_of(raw), path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def drawing_of(raw):
    """`Drawing` from nested dictionaries read from TOML.  Raises ValueError."""
    unknown = set(raw) - {"size", "symmetry", "around", "parts"}
    if unknown or not isinstance(raw.get("parts"), list) or not 1 <= len(raw["parts"]) <= MOST_PARTS:
        what = f"{min(unknown)} is unknown" if unknown else "there are no parts"
        raise ValueError(f"{what}; allowed: size, symmetry, around, and 1 to {MOST_PARTS} tables [[parts]]")
    out = Drawing(_number(raw, "size", "the drawing"), raw.get("symmetry", ""), raw.get("around", 24))
    if not (isinstance(out.around, int) and 8 <= out.around <= 200):
        raise ValueError(f"around is {out.around}; allowed: 8 to 200 panels around a circle")
    if out.symmetry not in ("", "x", "y", "xy"):
        raise ValueError(f"symmetry is {out.symmetry!r}; allowed: x, y, xy")
    for i, part in enumerate(raw["parts"]):
        _check(part, f"parts[{i}]")
        turns = int(part.get("turns", 1))
        out.parts += [(part, 2 * math.pi * k / turns) for k in range(turns)]
    return out


def _check(part, where):
    shape = part.get("shape")
    if shape not in NEEDED:
        raise ValueError(f"{where}.shape is {shape!r}; allowed: {', '.join(NEEDED)}")
    known = (*NEEDED[shape], *ALLOWED.get(shape, ()), *EVERY)
    for key in part:
        if key not in known:
            raise ValueError(f"{where}.{key} is unknown; allowed for a {shape}: {', '.join(known)}")
    for key in NEEDED[shape]:
        if key not in part:
            raise ValueError(f"{where}.{key} is missing; a {shape} needs {', '.join(NEEDED[shape])}")
    for key in ("radius", "end_radius", "breadth"):
        if key in part:
            _number(part, key, where)
    for key in ("from", "to", "center", "size"):
        if key in part and not (_finite(part[key]) and np.shape(part[key]) == (3,)):
            raise ValueError(f"{where}.{key} is {part[key]}; allowed: three finite numbers in m")
    if min(part.get("size", [1.0])) <= 0 or part.get("from", 0) == part.get("to", 1):
        raise ValueError(f"{where} has no size; allowed: lengths above 0")
    if "points" in part and not (_finite(part["points"]) and np.shape(part["points"])[1:] == (2,)):
        raise ValueError(f"{where}.points is not a list of points [x, z]; allowed: three points or more, in m")
    if not 1 <= part.get("turns", 1) <= 24:
        raise ValueError(f"{where}.turns is {part['turns']}; allowed: 1 to 24")


def _finite(value):
    try:
        return bool(np.all(np.isfinite(np.array(value, float))))
    except (TypeError, ValueError):
        return False


def _number(table, key, where):
    value = table.get(key)
    if not _finite(value) or np.ndim(value) or not value > 0:
        raise ValueError(f"{where}: {key} is {value}; allowed: m, above 0")
    return float(value)


def meshed(drawing, name=""):
    """PanelMesh of a `Drawing`: the first of several meshes (`TRIES`) whose volume, waterplane and centre agree with it

    If no mesh agrees within the limits, the nearest mesh is returned with a warning.
    Raises ValueError where nothing lies below the surface, or where the panels fail a check.
    """
    if not any(part["shape"] == "cylinder" for part, _ in drawing.parts):
        return _of_volume(drawing, name, 0.0, 8)[0]
    found = []
    for seam, more, algorithm in TRIES:
        mesh, body = _of_volume(replace(drawing, around=math.ceil(more * drawing.around)), name, seam, algorithm)
        found.append((_off(mesh, body), mesh, body))
        if found[-1][0] <= 1.0:
            break
    off, mesh, body = min(found, key=lambda one: one[0])
    if off > 1.0:
        warn(
            f"{name or 'drawing'}: the panels have a volume of {mesh.volume:.4g} m³ and a waterplane of "
            f"{waterplane_area(mesh):.4g} m², but the drawing has {body.volume:.4g} m³ and {body.plane:.4g} "
            f"m²; allowed: a difference of up to {100 * SAME_PLANE:g} %, and the same middle; give smaller "
            "panels or a larger `around`",
            stacklevel=2,
        )
    return mesh


def _off(mesh, body):
    """Largest difference of centre in plan, volume and waterplane of panels and drawing, over the allowed one"""
    length = np.ptp(mesh.whole().points, axis=0).max()
    apart = float(np.abs(_center(mesh) - body.center)[:2].max()) / (SAME_CENTER * length)
    wrong = abs(mesh.volume / body.volume - 1), abs(waterplane_area(mesh) / body.plane - 1) if body.plane > 0 else 0.0
    return max(apart, *(one / SAME_PLANE for one in wrong))


def _center(mesh):
    """Centre of buoyancy of the panels, m; shape (3,)"""
    return hydrostatics(mesh, center_of_mass=np.zeros(3)).center_of_buoyancy


def _of_volume(drawing, name, seam, algorithm):
    """PanelMesh whose radii give the volume of the drawing, and the `Drawn` body"""
    mesh, body = _panels(drawing, name, 1.0, seam, algorithm)
    volume = body.volume
    best, below, above = mesh, (1.0, mesh.volume), None  # the panel number changes as radii grow: volume jumps
    lost = math.copysign(1.0, volume - mesh.volume)  # volume lost to the chords of parts; a round hole gains volume
    for _ in range(MOST_TRIES if any(part["shape"] in ("cylinder", "sphere") for part, _ in drawing.parts) else 0):
        if abs(best.volume / volume - 1) <= SAME_VOLUME:
            break
        reach = 1.5 * abs(volume - below[1]) / (2 * volume) if above is None else 0.5 * (above[0] - below[0])
        grown = below[0] + max(reach, 1e-4)
        mesh = _panels(drawing, name, grown, seam, algorithm)[0]
        if lost * mesh.volume < lost * volume:
            below = grown, mesh.volume
        else:
            above = grown, mesh.volume
        best = min(best, mesh, key=lambda one: abs(one.volume - volume))
    return best, body


def _panels(drawing, name, grown, seam, algorithm):
    """PanelMesh with radii multiplied by `grown`, and the `Drawn` body"""
    with session(name or "drawing") as gmsh:
        occ = gmsh.model.occ
        body = []
        for cut, several in groupby(drawing.parts, lambda one: bool(one[0].get("cut"))):
            made = [_placed(occ, *one, grown, seam) for one in several]
            if cut:
                body = occ.cut(body, made)[0]
            else:
                made = [*body, *made]
                body = occ.fuse(made[:1], made[1:])[0] if made[1:] else made
        occ.synchronize()
        low, high = _extent(gmsh, body)
        length = float((high - low).max())
        if not FINEST * length <= drawing.size <= COARSEST * length:
            raise ValueError(
                f"size is {drawing.size:g} m for a hull of {length:g} m; allowed: {FINEST * length:.3g} to "
                f"{COARSEST * length:.3g} m"
            )
        body = _below(occ, body, low, high, drawing.symmetry) if low[2] < 0 else []
        if not body:
            raise ValueError("no part lies below still water, z = 0")
        occ.synchronize()
        sides = _wetted(gmsh, body, AT_SURFACE * length, drawing.symmetry)
        for option, value in (("MeshSizeMax", drawing.size), ("MeshSizeMin", 0.25 * drawing.size),
                              ("Algorithm", algorithm), ("MeshSizeFromCurvature", 2 * drawing.around),
                              ("RecombineAll", 1), ("MeshSizeExtendFromBoundary", 0)):  # fmt: skip
            gmsh.option.setNumber(f"Mesh.{option}", value)
        gmsh.model.mesh.generate(2)
        mesh = outwards(panels_of(gmsh, dict.fromkeys(sides), drawing.symmetry, name))
        volumes = np.array([occ.getMass(*one) for one in body])
        center = volumes @ np.array([occ.getCenterOfMass(*one) for one in body]) / volumes.sum()
        center[["xy".index(axis) for axis in drawing.symmetry]] = 0.0
        plane = _waterplane(gmsh, body, AT_SURFACE * length)
        return mesh, Drawn(mesh.copies * float(volumes.sum()), center, mesh.copies * plane)


def outwards(mesh):
    """The same panels with outward normals: neighbouring panels have consistent normals, and each connected piece
    encloses a positive volume"""
    sides = {}
    for i, corners in enumerate(mesh.corners.tolist()):
        ring = [a for a, b in zip(corners, corners[1:] + corners[:1], strict=True) if a != b]
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            sides.setdefault((min(a, b), max(a, b)), []).append((i, a < b))
    beside = [[] for _ in mesh.corners]
    for pair in sides.values():
        if len(pair) == 2:
            (i, up), (j, other) = pair
            beside[i].append((j, up == other))
            beside[j].append((i, up == other))
    turned, found = np.zeros(len(mesh), bool), np.zeros(len(mesh), bool)
    height = mesh.centroids[:, 2] * mesh.area_vectors[:, 2]
    for first in range(len(mesh)):
        piece = [] if found[first] else [first]
        found[first] = True
        for i in piece:
            for j, against in beside[i]:
                if not found[j]:
                    found[j], turned[j] = True, turned[i] ^ against
                    piece.append(j)
        if piece and np.sum(np.where(turned[piece], -1, 1) * height[piece]) < 0:
            turned[piece] ^= True
    corners = np.where(turned[:, None], mesh.corners[:, [0, 3, 2, 1]], mesh.corners)
    flat = turned & (mesh.corners[:, 2] == mesh.corners[:, 3])
    corners[flat] = mesh.corners[flat][:, [0, 2, 1, 1]]
    return replace(mesh, corners=corners)


def _placed(occ, part, turn, grown, seam):
    made = 3, _solid(occ, part, grown, seam)
    if turn:
        occ.rotate([made], 0, 0, 0, 0, 0, 1, turn)
    return made


def _solid(occ, part, grown, seam):
    """Tag of the volume of a part; the seam of a cylinder is turned by `seam` rad about the cylinder's axis"""
    shape, radius = part["shape"], grown * part.get("radius", 0.0)
    if shape == "cylinder":
        begin = np.array(part["from"], float)
        axis, end = np.array(part["to"], float) - begin, grown * part.get("end_radius", part["radius"])
        made = occ.addCylinder(*begin, *axis, radius) if end == radius else occ.addCone(*begin, *axis, radius, end)
        occ.rotate([(3, made)], *begin, *axis, seam)
        return made
    if shape == "box":
        size = np.array(part["size"], float)
        return occ.addBox(*(np.array(part["center"], float) - 0.5 * size), *size)
    if shape == "sphere":
        return occ.addSphere(*part["center"], radius)
    y, breadth = part.get("y", 0.0), part["breadth"]
    points = [occ.addPoint(x, y - 0.5 * breadth, z) for x, z in part["points"]]
    lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)]
    face = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return next(tag for dim, tag in occ.extrude([(2, face)], 0, breadth, 0) if dim == 3)


def _extent(gmsh, body):
    ends = np.array([gmsh.model.getBoundingBox(*one) for one in body])
    return ends[:, :3].min(axis=0), ends[:, 3:].max(axis=0)


def _below(occ, body, low, high, symmetry):
    """The part of the body below z = 0 and on the positive side of its mirror planes"""
    reach = (high - low).max()
    low, high = low - reach, high + reach
    high[2] = 0.0
    for axis in symmetry:
        low["xy".index(axis)] = 0.0
    return occ.intersect(body, [(3, occ.addBox(*low, *(high - low)))])[0]


def _wetted(gmsh, body, near, symmetry):
    """Surfaces of the boundary that do not lie in z = 0 or a mirror plane"""
    out = []
    flat = [2, *("xy".index(axis) for axis in symmetry)]
    for dim, tag in gmsh.model.getBoundary(body, combined=True, oriented=True):
        if not any(_lies(gmsh, (dim, abs(tag)), i, near) for i in flat):
            out.append(abs(tag))
    return out


def _waterplane(gmsh, body, near):
    """m², of the surfaces of the boundary that lie in z = 0"""
    sides = gmsh.model.getBoundary(body, combined=True, oriented=False)
    return float(sum(gmsh.model.occ.getMass(*one) for one in sides if _lies(gmsh, one, 2, near)))


def _lies(gmsh, surface, axis, near):
    """Whether a surface (2, tag) lies in the plane through the origin across an axis, 0 to 2"""
    box = np.array(gmsh.model.getBoundingBox(*surface))
    return bool(np.all(np.abs(box[[axis, axis + 3]]) <= near))
