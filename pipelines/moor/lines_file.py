"""Lines of a study from a file of another program, or of `hakobune lines`, as the tables [types] and [[lines]].

    lines_file = "moorings.dat"      # MoorDyn, MoorPy, RAFT or OrcaFlex, beside the study

Each line runs from an anchor to the only body of the file, the hull of the study; for a file with several bodies,
`lines_body` names it.  The tables become part of the study, of a state of a design and of a result.
"""

from __future__ import annotations

import math
import warnings
from pathlib import Path

from ..common.quantities import StudyError

KEY, BODY = "lines_file", "lines_body"
ON_BED = 1e-6  # m


def with_lines(raw, text, path):
    """Nested dictionaries and text of a study at `path`, with the lines of its file.  Raises StudyError."""
    if not isinstance(raw.get(KEY), str):
        return raw, text
    import tomli_w

    given = [key for key in ("types", "lines", "spreads") if key in raw]
    if given:
        raise StudyError(f"{given[0]} and {KEY} are both given; give one of them, or put all lines in the file")
    file, water = Path(path).parent / raw[KEY], raw.get("water")
    depth = water.get("depth") if isinstance(water, dict) else None
    made = tables_of(file, depth if isinstance(depth, int | float) and math.isfinite(depth) else None)
    if raw.get(BODY):
        made["lines"] = [line | {"body": raw[BODY]} for line in made["lines"]]
    laid = {key: value for key, value in raw.items() if key not in (KEY, BODY)} | made
    return laid, f"# {Path(path).name} with the lines of {raw[KEY]}\n{tomli_w.dumps(laid)}"


def tables_of(file, depth=None):
    """{"types": …, "lines": …} of a study from a file of lines; depth : m of the study.  Raises StudyError."""
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
         "weight_N": float(water[1] * (points[end].mass - water[0] * points[end].volume))}
        for count, (_, end) in zip(joints[:-1], ends[:-1], strict=True)
        if points[end].mass or points[end].volume
    ]  # fmt: skip
    if len(parts) == 1:
        return made | parts[0]
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
        values = kind.name, kind.weight, kind.axial_stiffness, kind.breaking_load
        return [{"type": _type(types, *values, line.bed_friction), "length": float(line.length)}]
    curved = any(isinstance(part.axial_stiffness, tuple) for part in getattr(line, "segments", ()))
    if not isinstance(line, CompositeLine) or line.bed is not None or line.loads or curved:
        raise StudyError(
            f"{KEY}: line {line.name} has its own bed, bodies between its ends or a rope with a tension curve; "
            "allowed: segments of constant stiffness; `hakobune lines` can compute it"
        )
    values = [(part.name, part.weight, part.axial_stiffness, part.breaking_load) for part in line.segments]
    found = [
        {"type": _type(types, *of, line.bed_friction), "length": float(part.length)}
        for of, part in zip(values, line.segments, strict=True)
    ]
    return found if along else found[::-1]


def _type(types, name, weight, stiffness, load, friction):
    """Name of the type in `types` with these values, N and N/m; a new one is added if none matches"""
    made = {"weight_N_per_m": float(weight), "bed_friction": float(friction)}
    if math.isfinite(stiffness):
        made["axial_stiffness_kN"] = float(stiffness) / 1e3
    if math.isfinite(load):
        made["breaking_load_kN"] = float(load) / 1e3
    i, given = 1, name or "line"
    name = given
    while name in types and types[name] != made:
        i += 1
        name = f"{given} {i}"
    types[name] = made
    return name
