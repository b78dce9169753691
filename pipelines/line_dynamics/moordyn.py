"""One line of a MoorDyn file as the study of a moving line: water, segments, bodies, anchor, and place of its fairlead.

The line includes the free points that join two lines, which become the bodies between its segments.  The line ends at
an anchor and at the moving point, whatever the attachment of the point in the file.  Damping BA keeps its value or, if
negative, its meaning in MoorDyn, a fraction of critical damping.  Parts out of the water have their weight in air and
no water loads, as in MoorDyn.
"""

import math
from itertools import pairwise
from pathlib import Path

import msgspec

from ..common.line_tables import AttachedTable, SegmentTable
from ..common.quantities import StudyError
from .study import BedTable, DynamicTypeTable, WaterTable

LEAST = 4  # elements of a segment
BED = {"stiffness_kPa_per_m": ("kBot", "kb"), "damping_kPa_s_per_m": ("cBot", "cb")}  # options in Pa/m and Pa s/m


def with_moordyn(study, folder):
    """The study with its line read from the file that `moordyn` names, in the folder `folder`.

    Warns of the parts of the file that are not used.
    raises : StudyError, FormatError for a file that cannot be read
    """
    from hakobune.mooring.formats.moordyn import read_moordyn
    from hakobune.mooring.formats.moordyn_system import system_of_moordyn

    path = Path(folder) / study.moordyn.file
    file = read_moordyn(path)
    system = system_of_moordyn(file, path, study.moordyn.depth, moves=True)
    lines, joints, anchor, end = _way(system, str(study.moordyn.line))
    places = dict(zip((point.name for point in system.points), system.load().points, strict=True))
    types = {f"line {line.name}": _type(line, path) for line in lines}
    segments = [SegmentTable(f"line {line.name}", line.length, max(line.elements or LEAST, LEAST)) for line in lines]
    bodies = [
        AttachedTable(i + 1, joint.mass, joint.volume, None, joint.drag_area, joint.added_mass)
        for i, joint in enumerate(joints)
        if joint.mass or joint.volume
    ]
    given = {key: file.option(*names) for key, names in BED.items()}
    bed = BedTable(friction=lines[0].bed_friction, **{k: 1e-3 * _number(v, path) for k, v in given.items() if v})
    fairlead = study.fairlead
    if fairlead.position is None and fairlead.table is None:
        fairlead = msgspec.structs.replace(fairlead, position=tuple(map(float, places[end])))
    return msgspec.structs.replace(
        study,
        water=WaterTable(system.depth, system.density, system.gravity),
        types=types,
        segments=segments,
        bodies=bodies,
        anchor=tuple(map(float, places[anchor])),
        bed=study.bed or bed,
        surface=study.surface is not False,
        fairlead=fairlead,
    )


def _way(system, name):
    """Lines from the anchor to the moving end, the free points between them, and the names of both ends"""
    from hakobune.mooring.lines.system.parts import Anchor, CompositeLine, FreePoint

    lines = {line.name: line for line in system.lines}
    if name not in lines:
        raise StudyError(f"moordyn.line is {name!r}; allowed: {', '.join(lines)}")
    points, at = {point.name: point for point in system.points}, {}
    for line in system.lines:
        for end in (line.a, line.b):
            at.setdefault(end, []).append(line)
    way, ends = [lines[name]], [lines[name].a, lines[name].b]
    for side in (0, 1):
        while isinstance(points[ends[side]], FreePoint) and len(at[ends[side]]) == 2:
            (following,) = (line for line in at[ends[side]] if line is not way[-side])
            if following in way:
                raise StudyError(f"moordyn: line {name} forms a closed loop; allowed: lines that end at an anchor")
            way.insert(len(way) if side else 0, following)
            ends[side] = following.b if following.a == ends[side] else following.a
    if not isinstance(points[ends[0]], Anchor):
        way, ends = way[::-1], ends[::-1]
    first, last = (points[end] for end in ends)
    for end, good in ((ends[0], isinstance(first, Anchor)), (ends[1], not isinstance(last, FreePoint))):
        if not good:
            what = f"point {end}, a {type(points[end]).__name__} shared by {len(at[end])} lines"
            raise StudyError(f"moordyn: line {name} ends at {what}; allowed: an anchor and a moving point")
    table = [line.name for line in way if isinstance(line, CompositeLine)]
    if table:
        raise StudyError(
            f"moordyn: EA of line {table[0]} is a table or a Syrope rope; allowed in motion: a number or a|b; for a "
            "table give elongation_percent and tensions in the study"
        )
    joints = [points[({one.a, one.b} & {two.a, two.b}).pop()] for one, two in pairwise(way)]
    return way, joints, *ends


def _type(line, path):
    kind = line.type
    own = kind.dynamics
    for name, value in (("axial stiffness EA", kind.axial_stiffness), ("mass", kind.mass), ("diameter", kind.diameter)):
        if not (value and value > 0 and math.isfinite(value)):
            raise StudyError(f"{path}: {name} of line type {kind.name} is {value:g}; allowed: finite, above 0")
    if kind.weight <= 0:
        raise StudyError(
            f"{path}: the weight of line type {kind.name} in water is {kind.weight:g} N/m; allowed: above 0"
        )
    ratio = -own.damping
    if own.damping > 0:
        size = max(line.length / max(line.elements or LEAST, LEAST), line.length / 40)
        ratio = own.damping / (size * math.sqrt(kind.axial_stiffness * kind.mass))
    return DynamicTypeTable(
        weight_N_per_m=kind.weight,
        axial_stiffness_kN=1e-3 * kind.axial_stiffness,
        breaking_load_kN=1e-3 * kind.breaking_load if math.isfinite(kind.breaking_load) else None,
        mass_kg_per_m=kind.mass,
        diameter=kind.diameter,
        drag_normal=own.drag_normal,
        drag_tangential=own.drag_tangential,
        added_normal=own.added_mass_normal,
        added_tangential=own.added_mass_tangential,
        damping_ratio=ratio,
        bending_stiffness_kN_m2=1e-3 * own.bending_stiffness,
    )


def _number(text, path):
    try:
        return float(text)
    except ValueError:
        raise StudyError(f"{path}: an option of the bed is {text!r}; allowed: a number") from None
