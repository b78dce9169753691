"""Lines as tables of a study, with the same keys in all studies: types, segments, and the bodies between them.

Segments, and the bodies between them, count from the first end of the line: its anchor, or the point named in `from`.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import msgspec

from hakobune.mooring.lines.multi_segment.bed import Bed
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.hawser import Hawser, elongation_at, pull_of_points
from hakobune.mooring.lines.system.parts import CompositeLine, LineDynamics, LineType, UniformLine

from .quantities import HEAVIEST, LONGEST, StudyError, Table, below, force, friction, one_of, positive
from .units import KGF, TONF

FAR_BEYOND = 10.0  # end of a table of tensions, over the breaking load: more is another unit
IN_MOTION = {  # keys of a MaterialTable, and names in LineDynamics
    "drag_normal": "drag_normal", "drag_tangential": "drag_tangential", "added_normal": "added_mass_normal",
    "added_tangential": "added_mass_tangential", "damping_ratio": "damping",
    "bending_stiffness_kN_m2": "bending_stiffness",
}  # fmt: skip


class MaterialTable(Table):
    """Submerged weight, axial stiffness EA and breaking load, each given in one of several units

    catalogue : name in the catalogue, such as "R3 studless 76 mm", for values that are not given
    weight : submerged weight for each metre
    axial_stiffness : axial stiffness EA; by default the line is inextensible
    breaking_load : breaking load of a new line
    termination : end of a wire rope, which reduces its breaking load: "socket", "swaged socket", "sleeve", "splice",
        "wedge socket" or "clips"
    efficiency : efficiency of the termination, above 0, at most 1, in place of its name
    corrosion_mm : loss of diameter of a chain of the catalogue by wear and corrosion
    mass_kg_per_m : mass in air, for a line in motion; by default the catalogue's value
    diameter : m, diameter of the displaced volume, for a line in motion; by default the catalogue's value
    drag_normal : normal drag coefficient, referred to D; by default the catalogue's value, or 1.2
    drag_tangential : tangential drag coefficient, referred to πD; by default the catalogue's value, or 0.1
    added_normal : normal added mass coefficient; by default the catalogue's value, or 1
    added_tangential : tangential added mass coefficient; by default the catalogue's value, or 0
    damping_ratio : structural damping over the critical damping of one element, or of a fortieth of the segment
        where elements are shorter; by default the catalogue's value, or 1
    bending_stiffness : bending stiffness EI of a line in motion, with hinged ends; by default 0
    """

    catalogue: str | None = None
    weight_kg_per_m: float | None = None
    weight_N_per_m: float | None = None
    axial_stiffness_tonf: float | None = None
    axial_stiffness_kN: float | None = None
    breaking_load_tonf: float | None = None
    breaking_load_kN: float | None = None
    termination: str | None = None
    efficiency: float | None = None
    corrosion_mm: float | None = None
    mass_kg_per_m: float | None = None
    diameter: float | None = None
    drag_normal: float | None = None
    drag_tangential: float | None = None
    added_normal: float | None = None
    added_tangential: float | None = None
    damping_ratio: float | None = None
    bending_stiffness_kN_m2: float | None = None


class TypeTable(MaterialTable):
    """A type of line, by its name

    bed_friction : coefficient of friction on the bed, 0 to 5
    elongation_percent : elongation of a hawser, % of its length, from 0 on; a smooth curve goes through the points
    tension : tension of a hawser at each elongation, from 0 on
    spring_kN_per_m : kN/m, stiffness of a spring that pulls only
    """

    bed_friction: float = 0.0
    elongation_percent: list[float] | None = None
    tension_tonf: list[float] | None = None
    tension_kN: list[float] | None = None
    spring_kN_per_m: float | None = None

    @property
    def straight(self):
        """Whether the line is a hawser or a spring"""
        return self.elongation_percent is not None or self.spring_kN_per_m is not None


class SegmentTable(Table):
    """A segment of a line, counted from the anchor upwards

    type : name of one of the types
    length : m, unstretched length
    elements : number of elements of a line in motion; by default 40 over its whole length, in a simulation
        `dynamic_elements`
    """

    type: str
    length: float
    elements: int | None = None


class AttachedTable(Table):
    """A clump weight or a buoy between two segments of a line

    after_segment : number, counted from 1, of the segment with the body at its upper end
    mass : kg, mass of the body
    volume : m³, volume of the displaced water
    weight_N : N, weight in water, negative for a buoy; by default from mass and volume in the water of the study
    drag_area : m², drag area C_d A, for a line in motion
    added_mass : added mass over the displaced mass, for a line in motion
    """

    after_segment: int
    mass: float
    volume: float = 0.0
    weight_N: float | None = None
    drag_area: float = 0.0
    added_mass: float = 0.5


class OwnBedTable(Table):
    """The sea bed under a line

    friction : coefficient of friction; by default that of the types of its segments
    points : m, points [x, z], … of the bed, x from the anchor along the line; by default flat
    """

    friction: float | None = None
    points: list[tuple[float, float]] = msgspec.field(default_factory=list)


class LineTable(Table):
    """A line: either type and length of a uniform line, or segments with the bodies between them

    type : name of one of the types
    length : m, unstretched length
    """

    type: str | None = None
    length: float | None = None
    segments: list[SegmentTable] = msgspec.field(default_factory=list)
    bodies: list[AttachedTable] = msgspec.field(default_factory=list)
    bed: OwnBedTable | None = None


def line_type(where, table, density=1025.0, gravity=9.80665, name=None) -> LineType:
    """The LineType of a MaterialTable; density : density of the water, kg/m³; name : by default the catalogue name"""
    from hakobune.mooring.lines.catalogue import line_type as of_catalogue

    try:
        known = None if table.catalogue is None else of_catalogue(table.catalogue, density, gravity)
    except ValueError as error:
        raise StudyError(f"{where}.catalogue: {error}") from None
    weight = one_of(where, table, {"weight_kg_per_m": KGF, "weight_N_per_m": 1.0}, required=known is None)
    if weight is not None:
        below(f"{where}: weight in N/m", weight, HEAVIEST)
    return LineType(
        name or table.catalogue or where,
        weight or known.weight,
        force(where, table, "axial_stiffness") or (known.axial_stiffness if known else math.inf),
        *(_given(where, table, key, known) for key in ("mass_kg_per_m", "diameter")),
        _strength_left(where, table)
        * (force(where, table, "breaking_load") or (known.breaking_load if known else math.inf)),
        dynamics=_dynamics(where, table, known.dynamics if known else None),
    )


def _given(where, table, key, known):
    """A value above 0 of a MaterialTable, by default that of the LineType of its catalogue, None without one"""
    value = getattr(table, key)
    if value is not None:
        return positive(f"{where}.{key}", value)
    return getattr(known, key.removesuffix("_kg_per_m")) if known else None


def _dynamics(where, table, known):
    """`LineDynamics` of a MaterialTable, by default those of its catalogue.  Raises StudyError."""
    given = {name: getattr(table, key) for key, name in IN_MOTION.items() if getattr(table, key) is not None}
    for key, name in IN_MOTION.items():
        if name in given and not 0 <= given[name] < math.inf:
            raise StudyError(f"{where}.{key} is {given[name]:g}; allowed: at least 0, finite")
    if table.damping_ratio is not None:
        given["damping"] = -given["damping"]
    if table.bending_stiffness_kN_m2 is not None:
        given["bending_stiffness"] *= 1e3
    return replace(known or LineDynamics(), **given) if given else known


def _strength_left(where, table):
    """Share of the breaking load after the termination and corrosion of a MaterialTable.  Raises StudyError."""
    from hakobune.mooring.criteria.strength import TERMINATIONS, kind_and_size, worn_breaking_load
    from hakobune.mooring.lines.catalogue import line_type as of_catalogue

    if table.termination is not None and table.efficiency is not None:
        raise StudyError(f"{where}: termination and efficiency are both given; give one of them")
    if table.termination is not None and table.termination not in TERMINATIONS:
        raise StudyError(
            f"{where}.termination is {table.termination!r}; allowed: {', '.join(TERMINATIONS)}, or efficiency"
        )
    left = TERMINATIONS.get(table.termination, 1.0)
    if table.efficiency is not None:
        left = below(f"{where}.efficiency", table.efficiency, 1.0)
    if table.corrosion_mm is None:
        return left
    if table.catalogue is None or of_catalogue(table.catalogue).proof_load is None:
        raise StudyError(
            f'{where}.corrosion_mm is given without a chain; this key needs a chain of the catalogue, such as "R3 '
            f'studless 76 mm"'
        )
    try:
        return left * worn_breaking_load(1.0, kind_and_size(table.catalogue)[1], table.corrosion_mm, 1.0)
    except ValueError as error:
        raise StudyError(f"{where}.corrosion_mm: {error}") from None


def of_types(where, name, types):
    """The table of a type by its name"""
    if name not in types:
        raise StudyError(f"{where}.type is {name!r}; allowed: {', '.join(types)}")
    return types[name]


def line_of(where, name, table, types, ends=("", ""), density=1025.0, gravity=9.80665, level=-math.inf):
    """The UniformLine or CompositeLine of a LineTable between two points

    types : {name: TypeTable}; level : z of the anchor, where a bed of this line begins, m
    """
    whole = table.type, table.length
    if whole != (None, None) if table.segments else None in whole:
        raise StudyError(f"{where} ({name}): give either type and length, or segments")
    if table.type in types and types[table.type].straight:
        if table.bodies or table.bed:
            raise StudyError(
                f"{where} ({name}): a hawser has neither bodies nor a bed; give these only for a line of segments"
            )
        return hawser_of(where, name, table.type, types[table.type], _length(where, table), ends)
    parts = {f"{where}.segments[{i}]": part for i, part in enumerate(table.segments)}
    parts = parts or {where: SegmentTable(type=table.type, length=table.length)}
    pieces = [_piece(place, part, types, density, gravity) for place, part in parts.items()]
    if not (table.segments or table.bodies or table.bed):
        (whole,) = pieces
        return UniformLine(name, whole.type, whole.length, *ends, whole.friction)
    for place, piece in zip(parts, pieces, strict=True):
        if piece.type.weight <= 0:
            raise StudyError(
                f"{place} ({name}): the weight of {piece.type.name} in water is {piece.type.weight:.4g} N/m; allowed: "
                "above 0; a segment lighter than water has to be a separate line between two points in `hakobune lines`"
            )
    try:
        segments = [piece.segment() for piece in pieces]
    except ValueError as error:
        raise StudyError(f"{where} ({name}): {error}") from None
    loads = _point_loads(where, table.bodies, [piece.length for piece in pieces], density, gravity)
    on_bed = _friction(where, table.bed, [piece.friction for piece in pieces])
    return CompositeLine(name, segments, *ends, loads, on_bed, _own_bed(where, table.bed, on_bed, level))


class _Piece(NamedTuple):
    """type : LineType; length : m; friction : on the bed; elements : number of a line in motion, None for any"""

    type: LineType
    length: float
    friction: float
    elements: int | None

    def segment(self):
        """Raises ValueError."""
        kind = self.type
        return Segment(self.length, kind.weight, kind.axial_stiffness, kind.diameter or 0.0, kind.breaking_load,
                       kind.name, kind, self.elements)  # fmt: skip


def _piece(place, part, types, density, gravity):
    """The `_Piece` of a SegmentTable.  Raises StudyError."""
    kind, of_type = of_types(place, part.type, types), f"types.{part.type}"
    if kind.straight:
        raise StudyError(f"{place}.type {part.type} is a hawser; segments need a weight")
    made = line_type(of_type, kind, density, gravity, part.type)
    return _Piece(made, _length(place, part), friction(f"{of_type}.bed_friction", kind.bed_friction), part.elements)


def hawser_of(where, name, kind_name, kind, length, ends=("", "")):
    """The Hawser of a straight TypeTable; length : m without tension"""
    place = f"types.{kind_name}"
    heavy = [key for key in MaterialTable.__struct_fields__ if not key.startswith("breaking")
             and getattr(kind, key) is not None]  # fmt: skip
    if heavy:
        raise StudyError(
            f"{place}: {heavy[0]} does not apply to a hawser; give its table or spring, and a breaking load"
        )
    pull, most = _pull(place, name, kind, length)
    return Hawser(name, pull, length, *ends, force(place, kind, "breaking_load") or math.inf, most)


def hawser_at_tension(where, name, kind_name, kind, distance, tension):
    """The Hawser with a given tension, N, between points at a distance, m"""
    place = f"types.{kind_name}"
    if kind.spring_kN_per_m is None:  # table of elongations: the strain follows from a rope of unit length
        length = distance / (1 + elongation_at(_pull(place, name, kind, 1.0)[0], tension))
    else:
        length = distance - tension / (1e3 * positive(f"{place}.spring_kN_per_m", kind.spring_kN_per_m))
    if not length > 0:
        raise StudyError(
            f"{where} ({name}): for this pretension over {distance:.4g} m the unstretched spring would be "
            f"{length:.4g} m long; allowed: above 0 m; give a stiffer spring or less pretension"
        )
    return hawser_of(where, name, kind_name, kind, length)


def _length(place, table):
    return below(f"{place}.length", table.length, LONGEST)


def check_types(types):
    """Raise StudyError for an impossible type, also if no line uses it; types : {name: TypeTable}"""
    for name, kind in types.items():
        if kind.straight:
            _pull(f"types.{name}", name, kind, 1.0)
        else:
            line_type(f"types.{name}", kind, name=name)


def _pull(place, name, kind, length):
    """Fender of the pull, N over m, and N at the end of its table"""
    given = [key for key in ("tension_tonf", "tension_kN") if getattr(kind, key) is not None]
    if kind.spring_kN_per_m is not None:
        if kind.elongation_percent is not None or given:
            raise StudyError(f"{place} has both a spring and a table; give one of spring_kN_per_m, elongation_percent")
        stiffness = 1e3 * positive(f"{place}.spring_kN_per_m", kind.spring_kN_per_m)
        return pull_of_points(name, [0.0, length], [0.0, stiffness * length]), math.inf
    if len(given) != 1:
        raise StudyError(f"{place} has {' and '.join(given) or 'no tensions'}; give one of tension_tonf, tension_kN")
    tension = [value * (TONF if given[0] == "tension_tonf" else 1e3) for value in getattr(kind, given[0])]
    elongation = [length * value / 100 for value in kind.elongation_percent]
    breaking = force(place, kind, "breaking_load") or math.inf
    if tension[-1] > FAR_BEYOND * breaking:
        raise StudyError(
            f"{place}: its table ends at {tension[-1] / 1e3:.4g} kN, {tension[-1] / breaking:.3g} times its breaking "
            f"load of {breaking / 1e3:.4g} kN; allowed: up to {FAR_BEYOND:g} times; tensions are in kN or tonf"
        )
    return pull_of_points(name, elongation, tension), tension[-1]


def attached(where, bodies, joints):
    """The AttachedTable at each of the joints between segments, or None at a joint without a body"""
    found = [None] * joints
    for i, body in enumerate(bodies):
        place, at = f"{where}bodies[{i}]", body.after_segment
        if not 1 <= at <= joints:
            allowed = (
                f"1 to {joints}" if joints else ("none, since the line has one segment; divide the segment at the body")
            )
            raise StudyError(f"{place}.after_segment is {at}; allowed: {allowed}")
        if found[at - 1] is not None:
            raise StudyError(
                f"{place}.after_segment is {at}, a joint that has another body; allowed: one body at a joint"
            )
        for key in ("mass", "volume"):
            if not 0 <= getattr(body, key) < math.inf:
                raise StudyError(f"{place}.{key} is {getattr(body, key):g}; allowed: at least 0, finite")
        found[at - 1] = body
    return found


def _point_loads(where, bodies, lengths, density, gravity):
    loads = []
    for i, body in enumerate(attached(f"{where}.", bodies, len(lengths) - 1)):
        if body is not None:
            weight = gravity * (body.mass - density * body.volume) if body.weight_N is None else body.weight_N
            felt = body.drag_area, body.added_mass
            loads.append(PointLoad(sum(lengths[: i + 1]), weight, gravity * body.mass, f"after segment {i + 1}", *felt))
    return loads


def _friction(where, bed, of_segments):
    if bed is not None and bed.friction is not None:
        return friction(f"{where}.bed.friction", bed.friction)
    if len(set(of_segments)) > 1:
        low, high = min(of_segments), max(of_segments)
        raise StudyError(
            f"{where}: bed_friction of its types is {low:g} to {high:g}, but a line has only one friction; give "
            f"bed.friction"
        )
    return of_segments[0]


def check_bed(where, points, level):
    """Raise StudyError for a bed with a point [x, z] above still water; level : z of the first point, under the
    anchor, m
    """
    for i, (x, z) in enumerate(points):
        height = level + z - points[0][1]
        if height > 0:
            raise StudyError(
                f"{where}.points[{i}] is [{x:g}, {z:g}], {height:g} m above still water; allowed: z up to "
                f"{z - height:g}, since points[0] is the bed under the anchor, {-level:g} m below still water"
            )


def _own_bed(where, bed, friction, level):
    if bed is None or not bed.points:
        return None
    check_bed(f"{where}.bed", bed.points, level)
    try:
        return Bed(bed.points, friction)
    except ValueError as error:
        raise StudyError(f"{where}.bed: {error}") from None
