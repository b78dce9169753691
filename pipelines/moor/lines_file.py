"""Mooring lines of a study, read from a file of another program or of `hakobune lines` into the tables [types] and
[[lines]].

    lines_file = "moorings.dat"      # MoorDyn, MoorPy, RAFT or OrcaFlex, beside the study

Each line runs from an anchor to the only body of the file, the hull of the study. If the file has several bodies,
`lines_body` names the hull.  The tables become part of the study, of a state of a design and of a result.  Breaking
loads, which most of these files lack, are given beside lines_file:

    types = { chain = { breaking_load_kN = 2580.0 }, poly = { breaking_load_kN = 3727.0 } }
"""

import math
import re
import warnings
from pathlib import Path

from ..common.line_tables import IN_MOTION
from ..common.quantities import StudyError

KEY, BODY = "lines_file", "lines_body"
BREAKING = ("breaking_load_kN", "breaking_load_tonf")
ON_BED = 1e-6  # m


def with_lines(raw, text, path):
    """Nested dictionaries and text of a study at `path`, with the lines of its file.  Raises StudyError."""
    if not isinstance(raw.get(KEY), str):
        return raw, text
    import tomli_w

    given = [key for key in ("lines", "spreads") if key in raw]
    if given:
        raise StudyError(f"{given[0]} and {KEY} are both given; give one of them, or put all lines in the file")
    file, water = Path(path).parent / raw[KEY], raw.get("water")
    depth = water.get("depth") if isinstance(water, dict) else None
    made = tables_of(file, depth if isinstance(depth, int | float) and math.isfinite(depth) else None)
    if raw.get(BODY):
        made["lines"] = [line | {"body": raw[BODY]} for line in made["lines"]]
    made["types"] = _breaking(made["types"], raw.get("types", {}), file)
    laid = {key: value for key, value in raw.items() if key not in (KEY, BODY)} | made
    return laid, f"# {Path(path).name} with the lines of {raw[KEY]}\n{tomli_w.dumps(laid)}"


def _breaking(types, given, file):
    """The types of a file with the breaking loads of a study; a type that lines differ in ("poly", "poly 2") has one.

    Raises StudyError for a type that the file does not have, and for another key.
    """
    found = dict(types)
    for name, table in given.items() if isinstance(given, dict) else ():
        same = [one for one in types if re.fullmatch(re.escape(name) + r"( \d+)?", one)]
        if not same:
            raise StudyError(f"types: {file.name} has no type {name!r}; allowed: {', '.join(types)}")
        other = sorted(set(table) - set(BREAKING)) if isinstance(table, dict) else [str(table)]
        if other:
            raise StudyError(
                f"types.{name}: {other[0]} is given beside {KEY}; allowed: {' or '.join(BREAKING)}; the other "
                f"values come from {file.name}"
            )
        for one in same:
            found[one] = {key: value for key, value in types[one].items() if key not in BREAKING} | table
    return found


def tables_of(file, depth=None):
    """{"types": …, "lines": …} of a study from a file of lines; depth : depth of the study, m. Raises StudyError."""
    from ..lines.system_file import read_system

    try:
        system = read_system(file, depth)
    except ValueError as error:
        raise StudyError(f"{KEY}: {error}") from None
    if depth is not None and not math.isclose(system.depth, depth, rel_tol=1e-3):
        raise StudyError(
            f"water.depth is {depth:g} m, {file.name} has a depth of {system.depth:g} m; allowed: the same depth"
        )
    bodies, points = {body.name: body for body in system.bodies}, {point.name: point for point in system.points}
    if len(bodies) != 1:
        raise StudyError(f"{KEY}: {file.name} has {len(bodies)} bodies; allowed: one, the hull of the study")
    _tell_displaced(system.bodies[0], file)
    types = {}
    given = points, bodies, system.depth, (system.density, system.gravity), types
    return {"lines": [_table(chain, *given) for chain in _chains(system)], "types": types}


def _tell_displaced(body, file):
    """Say that fairleads are taken of a body that the file does not have at the origin, along x, upright"""
    x, y, _, *turns = body.position
    moved = [f"{name} {value:.4g} m" for name, value in (("x", x), ("y", y)) if abs(value) > ON_BED]
    names = zip(("roll", "pitch", "yaw"), turns, strict=True)
    moved += [f"{name} {math.degrees(angle):.4g}°" for name, angle in names if abs(angle) > ON_BED]
    if moved:
        warnings.warn(
            f"{KEY}: {file.name} has its body {body.name} at {', '.join(moved)}; the fairleads at that place are used "
            "for the hull at rest; if the file has a displaced body, move it to 0 in the file",
            stacklevel=2,
        )


def _chains(system):
    """[(line, whether it runs from a to b), …] of each path from an anchor over joints of two lines to the body"""
    from hakobune.mooring.lines.system.parts import Anchor, Fairlead

    points, at = {point.name: point for point in system.points}, {}
    for line in system.lines:
        for end in (line.a, line.b):
            at.setdefault(end, []).append(line)
    for point in (point for point in system.points if isinstance(point, Anchor)):
        for line in at.get(point.name, ()):
            chain, here = [], point.name
            while True:
                chain.append((line, line.a == here))
                here = line.b if line.a == here else line.a
                if isinstance(points[here], Fairlead):
                    break
                if isinstance(points[here], Anchor) or len(at[here]) != 2:
                    what = "an anchor" if isinstance(points[here], Anchor) else f"a joint of {len(at[here])} lines"
                    raise StudyError(
                        f"{KEY}: line {line.name} ends at {what}, {here}; allowed: a line from an anchor to the body, "
                        "over joints of two lines; `hakobune lines` can compute it"
                    )
                line = next(one for one in at[here] if one is not line)
            yield chain


def _table(chain, points, bodies, depth, water, types):
    """A table of [[lines]] for one of the `_chains`; its types are added to `types`

    water : its density and gravity in the file, for the submerged weight of lines and attached bodies
    """
    ends = [(line.a, line.b) if along else (line.b, line.a) for line, along in chain]
    anchor, fairlead = points[ends[0][0]], points[ends[-1][1]]
    place = [float(value) for value in anchor.position]
    made = {"name": " ".join(str(line.name) for line, _ in chain), "fairlead": _in_space(fairlead, bodies)}
    made |= {"anchor": place[:2]} if abs(place[2] + depth) < ON_BED else {"bollard": place}
    parts, joints = [], []
    for line, along in chain:
        parts += _parts(line, along, types)
        joints.append(len(parts))
    loads = [
        {"after_segment": count, "mass": float(points[end].mass), "volume": float(points[end].volume),
         "weight_N": float(water[1] * (points[end].mass - water[0] * points[end].volume)),
         "drag_area": float(points[end].drag_area), "added_mass": float(points[end].added_mass)}
        for count, (_, end) in zip(joints[:-1], ends[:-1], strict=True)
        if points[end].mass or points[end].volume
    ]  # fmt: skip
    if len(parts) == 1:
        return made | {key: parts[0][key] for key in ("type", "length")}
    rough = max(types[part["type"]]["bed_friction"] for part in parts)
    return made | {"segments": parts, "bed": {"friction": rough}} | ({"bodies": loads} if loads else {})


def _in_space(fairlead, bodies):
    """[x, y, z] m of a fairlead with its body at rest"""
    from hakobune.mooring.lines.system.bodies import rotation

    *place, roll, pitch, yaw = bodies[fairlead.body].position
    return [float(value) for value in place + rotation(roll, pitch, yaw) @ fairlead.position]


def _parts(line, along, types):
    """[{type, length}, …] of a line of the file from its end a, or else from its end b"""
    from hakobune.mooring.lines.system.parts import CompositeLine, UniformLine

    if isinstance(line, UniformLine):
        kind = line.type
        part = {"type": _type(types, kind, kind.axial_stiffness, line), "length": float(line.length)}
        return [part | ({"elements": line.elements} if line.elements else {})]
    curved = any(isinstance(part.axial_stiffness, tuple) for part in getattr(line, "segments", ()))
    if not isinstance(line, CompositeLine) or line.bed is not None or line.loads or curved:
        raise StudyError(
            f"{KEY}: line {line.name} has its own bed, bodies between its ends or a rope with a tension curve; "
            "allowed: segments of constant stiffness; `hakobune lines` can compute it"
        )
    found = [
        {"type": _type(types, part.kind or part, part.axial_stiffness, line), "length": float(part.length)}
        for part in line.segments
    ]
    return found if along else found[::-1]


def _type(types, kind, stiffness, line):
    """Name of the type in `types` with the values of a LineType or a Segment of a line; new if none matches

    stiffness : N, EA
    """
    made = {"weight_N_per_m": float(kind.weight), "bed_friction": float(line.bed_friction)}
    if math.isfinite(stiffness):
        made["axial_stiffness_kN"] = float(stiffness) / 1e3
    if math.isfinite(kind.breaking_load):
        made["breaking_load_kN"] = float(kind.breaking_load) / 1e3
    made |= {key: float(value) for key, value in _in_motion(kind, stiffness, line) if value is not None}
    i, given = 1, kind.name or "line"
    name = given
    while name in types and types[name] != made:
        i += 1
        name = f"{given} {i}"
    types[name] = made
    return name


def _in_motion(kind, stiffness, line):
    """Return (key, value) of a type in motion, of a LineType or a Segment; a damping BA as its share of the critical"""
    from hakobune.mooring.lines.dynamics.line import DAMPED

    mass, own = getattr(kind, "mass", None), getattr(kind, "dynamics", None)
    if not mass or not kind.diameter:
        return
    yield from (("mass_kg_per_m", mass), ("diameter", kind.diameter))
    if own is not None:
        yield from ((key, getattr(own, name)) for key, name in IN_MOTION.items() if key.startswith(("drag", "added")))
        ratio = -own.damping
        if own.damping >= 0 and math.isfinite(stiffness):  # over that of an element, which is as long as in the file
            size = max(line.length / (getattr(line, "elements", None) or DAMPED), line.length / DAMPED)
            ratio = own.damping / (size * math.sqrt(stiffness * mass))
        yield "damping_ratio", ratio if ratio >= 0 else None
        yield "bending_stiffness_kN_m2", 1e-3 * own.bending_stiffness or None
