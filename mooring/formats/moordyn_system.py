"""A MoorDyn file as a System of lines, and a System as a MoorDyn file.

Points that are Coupled belong to one body named "vessel" at the origin, those of bodies 1, 2 … to "body 1" …;
other names are the ids of the file.  A free body has its weight at its CG and its buoyancy, whole, at its origin.
Submerged weight is (mass − ρ π/4 d²) g.  What statics cannot represent is refused by name.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bem import DOFS

from ..lines.system.graph import System
from ..lines.system.parts import Anchor, Body, Fairlead, FreePoint, LineType, UniformLine
from .fault import FormatError
from .moordyn import MoorDynFile, read_moordyn
from .moordyn_rows import BodyRow, LineRow, LineTypeRow, PointRow

FIXED, COUPLED, FREE = ("fixed", "fix", "anchor"), ("coupled", "vessel", "ves"), ("free", "connect", "con")
VESSEL = "vessel"


def system_of_moordyn(file: MoorDynFile, path="MoorDyn file") -> System:
    """The System of what was read.  Raises FormatError for what is not represented, ValueError for what cannot be."""
    if file.rods:
        raise FormatError(f"{path}: rod {file.rods[0].id} is no part of statics; replace it by a point")
    depth = _option(file, path, None, "WtrDpth", "depth", "WaterDepth")
    density = _option(file, path, 1025.0, "rhoW", "rho", "WtrDnsty", "WtrDens")
    gravity = _option(file, path, 9.80665, "g", "gravity", "grav")
    friction = _option(file, path, 0.0, "FrictionCoefficient", "mu_kT", "FricCoeff")
    types = {row.name: _type(row, density, gravity, path) for row in file.line_types}
    bodies = [_body(row, density, gravity, path) for row in file.bodies]
    points = [_point(row, file.bodies, path) for row in file.points]
    if any(isinstance(point, Fairlead) and point.body == VESSEL for point in points):
        bodies.insert(0, Body(VESSEL))
    lines = [UniformLine(row.id, types[row.type], row.length, _end(row.a), _end(row.b), friction) for row in file.lines]
    return System(depth, lines, points, bodies, density, gravity)


def read_moordyn_system(path) -> System:
    """The System of a MoorDyn input file."""
    return system_of_moordyn(read_moordyn(path), path)


def _option(file, path, default, *names):
    text = file.option(*names, default=None)
    if text is None:
        if default is None:
            raise FormatError(f"{path}, section OPTIONS: {names[0]} is missing; allowed: the water depth in m")
        return default
    try:
        return float(text)
    except ValueError:
        raise FormatError(f"{path}, section OPTIONS: {names[0]} is {text!r}; allowed: a number (no file)") from None


def _type(row, density, gravity, path):
    try:
        stiffness = float(row.EA.split("|")[0])
    except ValueError:
        what = f"EA of {row.name} is {row.EA!r}; allowed: a number or a|b"
        raise FormatError(f"{path}, section LINE TYPES: {what}") from None
    weight = (row.mass - density * np.pi / 4 * row.diameter**2) * gravity
    return LineType(row.name, weight, stiffness, row.mass, row.diameter, source=str(path))


def _end(name):
    """Point 3 may be written 3, P3 or Point3"""
    plain = name.lower().removeprefix("point").removeprefix("connection").removeprefix("p").removeprefix("c")
    return plain if plain.isdigit() else name


def _point(row, bodies, path):
    kind, place, name = row.attachment.lower(), (row.x, row.y, row.z), _end(row.id)
    if kind in FIXED:
        return Anchor(name, place)
    if kind in COUPLED:
        return Fairlead(name, VESSEL, place)
    if kind in FREE:
        return FreePoint(name, place, row.mass, row.volume)
    body = kind.removeprefix("body").removeprefix("b")
    if kind[0] == "b" and body in [b.id for b in bodies]:
        return Fairlead(name, f"body {body}", place)
    raise FormatError(
        f"{path}, section POINTS: attachment of point {row.id} is {row.attachment!r}; "
        "allowed: Fixed, Coupled, Free, or Body and the id of one of BODIES"
    )


def _numbers(row, name, path, count):
    try:
        values = [float(part) for part in getattr(row, name).split("|")]
    except ValueError:
        values = []
    if len(values) not in (1, count):
        raise FormatError(
            f"{path}, section BODIES: {name} of body {row.id} is {getattr(row, name)!r}; "
            f"allowed: 1 or {count} numbers with | between"
        )
    return values


def _body(row, density, gravity, path):
    turns = np.radians([row.roll0, row.pitch0, row.yaw0])
    if np.count_nonzero(turns) > 1:
        raise FormatError(
            f"{path}, section BODIES: body {row.id} has {np.count_nonzero(turns)} angles that are not 0, "
            "and MoorDyn's versions turn in different orders; allowed: one"
        )
    position = (row.x0, row.y0, row.z0, *turns)
    kind, name = row.attachment.lower(), f"body {row.id}"
    if kind in FIXED:
        return Body(name, position, freedom=())
    if kind in COUPLED:
        return Body(name, position)
    if kind not in FREE:
        raise FormatError(
            f"{path}, section BODIES: attachment of body {row.id} is {row.attachment!r}; allowed: Fixed, Coupled, Free"
        )
    if np.any(turns[:2]):
        raise FormatError(f"{path}, section BODIES: free body {row.id} starts heeled; allowed: r0 = p0 = 0")
    cg = _numbers(row, "CG", path, 3)
    x, y, z = cg if len(cg) == 3 else (0.0, 0.0, cg[0])
    weight = row.mass * gravity
    load = (0.0, 0.0, density * gravity * row.volume - weight, -weight * y, weight * x, 0.0)
    return Body(name, position, DOFS, np.diag([0.0, 0.0, 0.0, -weight * z, -weight * z, 0.0]), load)


def moordyn_of_system(system: System, segments=20, coefficients=(1.33, 1.0, 0.64, 0.5), damping="-1.0") -> MoorDynFile:
    """The MoorDynFile of a System, for a dynamic run.

    segments : of each line; coefficients : Cd, Ca, CdAx, CaAx of every type; damping : BA or −fraction of critical
    Bodies are written as Coupled: their hydrostatics and loads are not MoorDyn's to know.
    raises : FormatError where a type has no mass or diameter, the friction differs from line to line, or a line has
        segments
    """
    cut = [line.name for line in system.lines if not isinstance(line, UniformLine)]
    if cut:
        raise FormatError(
            f"line {cut[0]} has several segments; allowed for MoorDyn: uniform lines, joined at free points"
        )
    types = {line.type.name: line.type for line in system.lines}
    for line in system.lines:
        if types[line.type.name] != line.type:
            raise FormatError(f"line type {line.type.name!r} stands for two types; allowed: one name for each")
    friction = {line.bed_friction for line in system.lines}
    if len(friction) > 1:
        raise FormatError(f"bed friction is {min(friction):g} and {max(friction):g}; allowed for MoorDyn: one value")
    points = {point.name: str(i) for i, point in enumerate(system.points, 1)}
    bodies = {body.name: str(i) for i, body in enumerate(system.bodies, 1)}
    options = {
        "dtM": "0.001",
        "kBot": "3.0e6",
        "cBot": "3.0e5",
        "WtrDpth": repr(float(system.depth)),
        "rhoW": repr(float(system.density)),
        "g": repr(float(system.gravity)),
    }
    if max(friction) > 0:
        options["FrictionCoefficient"] = repr(float(max(friction)))
    names = [name.replace(" ", "_") for name in types]
    if len(set(names)) < len(names):
        raise FormatError("two line types have the same name once blanks are replaced; rename one")
    return MoorDynFile(
        ("MoorDyn input file written by hakobune",),
        tuple(_type_row(kind, coefficients, damping) for kind in types.values()),
        bodies=tuple(_body_row(body, bodies[body.name]) for body in system.bodies),
        points=tuple(_point_row(point, points, bodies) for point in system.points),
        lines=tuple(_line_row(str(i), line, points, segments) for i, line in enumerate(system.lines, 1)),
        options=options,
        outputs=tuple(f"{what}{i}" for i in range(1, len(system.lines) + 1) for what in ("FairTen", "AnchTen")),
    )


def _line_row(number, line, points, segments):
    name = line.type.name.replace(" ", "_")
    return LineRow(number, name, points[line.a], points[line.b], float(line.length), segments, "p")


def _type_row(kind, coefficients, damping):
    if kind.mass is None or kind.diameter is None:
        raise FormatError(f"line type {kind.name!r} has no mass or no diameter, which MoorDyn needs; give both")
    if not np.isfinite(kind.axial_stiffness):
        raise FormatError(f"line type {kind.name!r} is inextensible, and a MoorDyn file needs EA; give it")
    name = kind.name.replace(" ", "_")
    return LineTypeRow(
        name, float(kind.diameter), float(kind.mass), repr(float(kind.axial_stiffness)), damping, "0", *coefficients
    )


def _body_row(body, number):
    x, y, z = map(float, body.position[:3])
    angles = map(float, np.degrees(body.position[3:]))
    return BodyRow(number, "Coupled", x, y, z, *angles, 0.0, "0", "0", 0.0, "0", "0")


def _point_row(point, points, bodies):
    place = tuple(map(float, point.position))
    if isinstance(point, FreePoint):
        return PointRow(points[point.name], "Free", *place, float(point.mass), float(point.volume))
    kind = f"Body{bodies[point.body]}" if isinstance(point, Fairlead) else "Fixed"
    return PointRow(points[point.name], kind, *place)


def renamed(system: System) -> System:
    """The system with the names a MoorDyn file gives: numbers for points and lines, "body n" for bodies."""
    points = {point.name: str(i) for i, point in enumerate(system.points, 1)}
    bodies = {body.name: f"body {i}" for i, body in enumerate(system.bodies, 1)}
    lines = [replace(x, name=str(i), a=points[x.a], b=points[x.b]) for i, x in enumerate(system.lines, 1)]
    renamed_points = [
        replace(p, name=points[p.name], **({"body": bodies[p.body]} if isinstance(p, Fairlead) else {}))
        for p in system.points
    ]
    renamed_bodies = tuple(replace(body, name=bodies[body.name]) for body in system.bodies)
    return replace(system, lines=tuple(lines), points=tuple(renamed_points), bodies=renamed_bodies)
