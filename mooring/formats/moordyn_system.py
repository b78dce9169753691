"""A MoorDyn file as a System of lines at rest.

Coupled points and bodies, which a run in time would move with the vessel, are fixed at their given positions.
Coupled points belong to one body named "vessel" at the origin; points of bodies 1, 2 … belong to "body 1" …. All
other names are the ids of the file.  Ends of a fixed rod are points "R1A", "R1B". A free rod without length is one
free point "R1"; a free rod with a length is a body "rod 1" that floats or sinks as a whole. A free body has its
weight at its CG and its full buoyancy at its origin. The submerged weight of a line is (mass − ρ π/4 d²) g; above
the water its weight is mass g (`moordyn_dry`). Content that statics cannot represent is refused by name, or omitted
with a warning for each kind.
"""

from __future__ import annotations

import re
import warnings
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.bem import DOFS

from ..lines.system.graph import System
from ..lines.system.parts import (
    Anchor,
    CompositeLine,
    Fairlead,
    FreePoint,
    LineDynamics,
    LineType,
    MooredBody,
    UniformLine,
)
from .fault import FormatError
from .moordyn import MoorDynFile, read_moordyn
from .moordyn_dry import STILL, in_air, out_of_water
from .moordyn_left_out import left_out
from .moordyn_ropes import curve_of_line, is_tabulated, largest_tensions, segment_of_curve
from .moordyn_rows import COUPLED, FIXED, FREE, LineTypeRow, finite_number

VESSEL = "vessel"
DEPTH = ("WtrDpth", "depth", "WaterDepth")
DENSITY = ("WtrDnsty", "rho", "rhoW", "WtrDens")
GRAVITY = ("g", "gravity", "grav")
FRICTION = ("FrictionCoefficient", "mu_kT", "FricCoeff")


class _Water(NamedTuple):
    density: float
    gravity: float
    path: object


def system_of_moordyn(file: MoorDynFile, path="MoorDyn file", depth=None, moves=False, turbines=None) -> System:
    """The System of a MoorDynFile.

    turbines : {number: (x, y, z)}, positions of a farm's turbines, m, whose points are named Turbine1 …
    depth : m, for a file without depth or with a bathymetry; by default the depth of its lowest point, with a warning
    moves : whether the lines will be simulated in time; above the water they then have their weight in air
    warns : for each kind of omitted content
    raises : FormatError for unsupported content, ValueError for impossible values
    """
    if not file.lines:
        others = ", ".join(title for title, rows in (("BODIES", file.bodies), ("RODS", file.rods)) if rows)
        raise FormatError(f"{path} has no section LINES, only {others}; give lines")
    depth, said = _depth(file, path, depth)
    water = _Water(_option(file, path, 1025.0, DENSITY), _option(file, path, 9.80665, GRAVITY), path)
    friction = _option(file, path, 0.0, FRICTION)
    types = {row.name: _type(row, water) for row in file.line_types}
    lines = _lines(file, types, friction, path)
    points, bodies, idle = _points_and_bodies(file, water, lines, turbines or {})
    lines, out = _joined(lines, points), []
    if not moves:
        lines, dry = in_air(lines, points, bodies, water)
        lines, out = out_of_water(lines, points, bodies, dry, water)
    system = System(depth, lines, points, bodies, water.density, water.gravity)
    for text in (
        *said,
        *left_out(file, moves),
        *idle,
        *_weightless(types.values()),
        *out,
    ):
        warnings.warn(f"{path}: {text}", stacklevel=2)
    return system


def _lines(file, types, friction, path):
    """A UniformLine each, or a CompositeLine if its type is a table over strain"""
    tabulated = {row.name: row for row in file.line_types if is_tabulated(row)}
    syrope, made = largest_tensions(file, path) if tabulated else {}, []
    for row in file.lines:
        kind, ends = types[row.type], (_end(row.a), _end(row.b))
        if row.type in tabulated:
            curve = curve_of_line(row, tabulated[row.type], syrope, path)
            segment = segment_of_curve(kind, row.length, curve)
            made.append(CompositeLine(row.id, (segment,), *ends, bed_friction=friction))
        else:
            made.append(UniformLine(row.id, kind, row.length, *ends, friction, row.segments or None))
    return made


def read_moordyn_system(path, depth=None, turbines=None) -> System:
    """The System of a MoorDyn input file; depth : m, if the file does not give it; turbines : `system_of_moordyn`"""
    return system_of_moordyn(read_moordyn(path), path, depth, turbines=turbines)


def _option(file, path, default, names):
    text = file.option(*names, default=None)
    if text is None:
        return default
    try:
        return float(text.lower().replace("d", "e"))
    except ValueError:
        raise FormatError(f"{path}, section OPTIONS: {names[0]} is {text!r}; allowed: a number (no file)") from None


def _depth(file, path, given):
    """m, and a message on it; a point below the bed lowers the bed, as in MoorDyn"""
    text, said = file.option(*DEPTH), []
    lowest = max((-row.z for row in file.points if row.attachment.lower() in (*FIXED, *COUPLED, *FREE)), default=0.0)
    try:
        own = None if text is None else float(text)
    except ValueError:
        own = None
        if given is None:
            what = f"WtrDpth is {text!r}, a bathymetry; allowed: a number, or a depth given beside the file"
            raise FormatError(f"{path}, section OPTIONS: {what}") from None
        said.append(f"the bathymetry {text} (WtrDpth) is left out; the bed is flat at {given:g} m")
    if own is not None and given is not None and own != given:
        raise FormatError(f"{path}: WtrDpth is {own:g} m and the given depth is {given:g} m; give one of them")
    depth = own if own is not None else given
    if depth is None:
        said.append(
            f"WtrDpth is missing; the bed is assumed at the lowest point, {lowest:g} m; give the depth if this is wrong"
        )
    elif depth < lowest:
        said.append(
            f"depth is {depth:g} m, but the lowest point lies at {lowest:g} m; the bed is taken at the lowest point"
        )
    return max(lowest, depth or 0.0), said


def _type(row: LineTypeRow, water):
    for key, value, unit in (("Diam", row.diameter, "m"), ("Mass/m", row.mass, "kg/m")):
        if not value > 0:
            where = f"{water.path}, section LINE TYPES: {key} of {row.name}"
            raise FormatError(f"{where} is {value:g} {unit}; allowed: above 0")
    stiffness = np.inf if is_tabulated(row) else float(row.EA.split("|")[0].lower().replace("d", "e"))
    dynamics = LineDynamics(
        row.Cd, row.CdAx, row.Ca, row.CaAx, _number(row.BA.split("|")[0], -1.0), _number(row.EI, 0.0)
    )
    weight = (row.mass - water.density * np.pi / 4 * row.diameter**2) * water.gravity
    return LineType(
        row.name, weight or STILL, stiffness, row.mass, row.diameter, source=str(water.path), dynamics=dynamics
    )


def _number(text, default):
    """A number, or the default for the name of a file"""
    value = finite_number(text)
    return default if value is None else value


def _weightless(types):
    names = [kind.name for kind in types if kind.weight == STILL]
    return [f"line type {', '.join(names)} has no weight in water; {STILL:g} N/m is used"] if names else []


def _end(name):
    """Point 3 may be written 3, P3 or Point3; the ends of rod 1 R1A, Rod1A"""
    plain = name.lower().removeprefix("point").removeprefix("connection").removeprefix("p").removeprefix("c")
    rod = name.lower().removeprefix("rod").removeprefix("r")
    if rod[:-1].isdigit() and rod[-1] in "ab":
        return f"R{rod.upper()}"
    return plain if plain.isdigit() else name


def _points_and_bodies(file, water, lines, turbines):
    """Points for points and rods, bodies with lines, and a message on bodies without lines"""
    used = {end for line in lines for end in (line.a, line.b)}
    points = [_point(row, file.bodies, water.path, turbines) for row in file.points]
    idle = [point.name for point in points if isinstance(point, FreePoint) and point.name not in used]
    points = [point for point in points if point.name not in idle]
    said = [f"point {', '.join(idle)} is free and no line holds it, so it is ignored"] if idle else []
    bodies, idle = [], []
    for row in file.rods:
        if {f"R{row.id}A", f"R{row.id}B"} & used:
            made, moving = _rod(row, file, water)
            points += made
            bodies += moving
        else:
            _check_idle(row, file, water.path)
            idle.append(row.id)
    said += (
        [f"rod {', '.join(idle)} carries no line, so it is ignored except for its weight on a free body"]
        if idle
        else []
    )
    borne = {point.body for point in points if isinstance(point, Fairlead)}
    idle = [row.id for row in file.bodies if f"body {row.id}" not in borne]
    said += [f"body {', '.join(idle)} carries no line, so it is ignored"] if idle else []
    bodies = [_body(row, file, water) for row in file.bodies if row.id not in idle] + bodies
    placed = [(f"turbine {number}", place) for number, place in turbines.items()]
    bodies = [MooredBody(name, (*place, 0.0, 0.0, 0.0), ()) for name, place in placed if name in borne] + bodies
    if VESSEL in borne:
        bodies.insert(0, MooredBody(VESSEL, freedom=()))
    return points, bodies, said


def _check_idle(row, file, path):
    """A rod without lines has no effect at rest, unless it turns about a point of a moving body"""
    kind = row.attachment.lower()
    body = _body_of(kind.removesuffix("pinned"), file.bodies)
    if kind.endswith("pinned") and body is not None and body.attachment.lower() in FREE:
        raise FormatError(
            f"{path}, section RODS: rod {row.id} is attached to {row.attachment} by a hinge; allowed on a free body: "
            "rods fixed rigidly to it (Body and its id)"
        )


def _body_of(attachment, bodies):
    """The BodyRow named by an attachment "Body1"; None without one"""
    kind = attachment.lower()
    number = kind.removeprefix("body").removeprefix("b")
    return next((row for row in bodies if kind.startswith("b") and row.id == number), None)


def _rod(row, file, water):
    """Points at the ends of a rod, and the body of a moving rod"""
    names, kind = (f"R{row.id}A", f"R{row.id}B"), row.attachment.lower()
    ends = (row.xa, row.ya, row.za), (row.xb, row.yb, row.zb)
    if kind in FIXED:
        return [Anchor(name, place) for name, place in zip(names, ends, strict=True)], []
    if kind in COUPLED:
        return [Fairlead(name, VESSEL, place) for name, place in zip(names, ends, strict=True)], []
    if kind in FREE:
        return _free_rod(row, names, np.array(ends), file, water)
    body = _body_of(row.attachment, file.bodies)
    if body is None:
        raise FormatError(
            f"{water.path}, section RODS: attachment of rod {row.id} is {row.attachment!r}; "
            "allowed: Fixed, Coupled, Free, or Body and the id of one of BODIES (not pinned)"
        )
    return [Fairlead(name, f"body {body.id}", place) for name, place in zip(names, ends, strict=True)], []


def _free_rod(row, names, ends, file, water):
    length = float(np.linalg.norm(ends[1] - ends[0]))
    if length == 0:
        return [FreePoint(f"R{row.id}", tuple(map(float, ends[0])))], []
    weight, middle = _weight(row, file, water), ends.mean(axis=0)
    body = MooredBody(
        f"rod {row.id}", (*map(float, middle), 0.0, 0.0, 0.0), DOFS, load=(0.0, 0.0, -weight, 0.0, 0.0, 0.0)
    )
    made = [Fairlead(n, body.name, tuple(map(float, end - middle))) for n, end in zip(names, ends, strict=True)]
    return made, [body]


def _weight(row, file, water):
    """N, weight of a rod in water, which acts at its middle"""
    kind = next((kind for kind in file.rod_types if kind.name == row.type), None)
    if kind is None:
        raise FormatError(f"{water.path}, section RODS: rod {row.id}: type {row.type!r} is unknown")
    length = np.hypot(np.hypot(row.xb - row.xa, row.yb - row.ya), row.zb - row.za)
    return float(water.gravity * length * (kind.mass - water.density * np.pi / 4 * kind.diameter**2))


def _joined(lines, points):
    """Both ends of a rod without length are one point"""
    one = {f"{p.name}{end}": p.name for p in points if p.name[0] == "R" and p.name[1:].isdigit() for end in "AB"}
    return [replace(line, a=one.get(line.a, line.a), b=one.get(line.b, line.b)) for line in lines]


def _point(row, bodies, path, turbines):
    kind, place, name = row.attachment.lower(), (row.x, row.y, row.z), _end(row.id)
    if kind in FIXED:
        return Anchor(name, place)
    if kind.removesuffix("1") in COUPLED:  # Vessel1 of version 1, which has no other vessel
        return Fairlead(name, VESSEL, place)
    if kind in FREE:
        return FreePoint(name, place, row.mass, row.volume, drag_area=row.CdA, added_mass=row.Ca)
    body = _body_of(row.attachment, bodies)
    if body is not None:
        return Fairlead(name, f"body {body.id}", place)
    if farm := re.fullmatch(r"turbine(\d+)", kind):
        return Fairlead(name, f"turbine {_turbine(row, int(farm[1]), turbines, path)}", place)
    raise FormatError(
        f"{path}, section POINTS: attachment of point {row.id} is {row.attachment!r}; "
        "allowed: Fixed, Coupled, Free, or Body and the id of one of BODIES"
    )


def _turbine(row, number, turbines, path):
    if number in turbines:
        return number
    known = f"1 to {len(turbines)} are known" if turbines else "this file does not give its position"
    raise FormatError(
        f"{path}, section POINTS: point {row.id} is in the axes of {row.attachment}, and {known}; give "
        "FAST.Farm's NAME.fstf or RAFT's design with its array; both refer to this file and give the "
        "positions"
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


def _body(row, file, water):
    path = water.path
    turns = np.radians([row.roll0, row.pitch0, row.yaw0])
    if np.count_nonzero(turns) > 1:
        raise FormatError(
            f"{path}, section BODIES: body {row.id} has {np.count_nonzero(turns)} angles that are not 0, and versions "
            "of MoorDyn apply them in different orders; allowed: one angle"
        )
    position = (row.x0, row.y0, row.z0, *turns)
    kind, name = row.attachment.lower().rstrip("0123456789"), f"body {row.id}"  # MoorDyn counts them: Coupled1
    if kind in (*FIXED, *COUPLED):
        return MooredBody(name, position, freedom=())
    if kind not in FREE:
        raise FormatError(
            f"{path}, section BODIES: attachment of body {row.id} is {row.attachment!r}; allowed: Fixed, Coupled, Free"
        )
    position = (*position[:3], 0.0, 0.0, position[5])  # a heeled start only: see `left_out`
    cg = _numbers(row, "CG", path, 3)
    x, y, z = cg if len(cg) == 3 else (0.0, 0.0, cg[0])
    buoyancy = water.density * water.gravity * row.volume
    weights = [(row.mass * water.gravity, x, y, z)]  # N, at a place in the body's axes
    for rod in file.rods:
        if _body_of(rod.attachment, file.bodies) is row:
            middle = 0.5 * (rod.xa + rod.xb), 0.5 * (rod.ya + rod.yb), 0.5 * (rod.za + rod.zb)
            weights.append((_weight(rod, file, water), *middle))
    weight, at = zip(*((w, place) for w, *place in weights), strict=True)
    mx, my, mz = map(float, np.array(weight) @ np.array(at))
    load = (0.0, 0.0, buoyancy - sum(weight), -my, mx, 0.0)
    return MooredBody(name, position, DOFS, np.diag([0.0, 0.0, 0.0, -mz, -mz, 0.0]), load)
