"""A System of lines as a MoorDyn v2 input file, with a time step at which its lines are stable.

An axial wave of the shortest segment, l long, has the angular frequency and the rate of decay

    ω = 2 √(EA/m) / l,    σ = 4 BA / (m l²) = 2 ζ ω,

a node at the bed has ω² = k d/m and σ = c d/m with the bed's kBot and cBot, and a node of a bent line ω = 4 √(EI/m)
/ l². A free point has its own mass and half the mass of the segments at the point. With ω² ≤ 2 Σ(EA/l) / (½ Σ m l +
M) the point is not faster than the fastest of its lines. MoorDyn's scheme, Runge–Kutta of second order, is stable
for a decaying motion up to σ dt = 2; an undamped motion grows by (ω dt)⁴/8 in each step. dtM is the smaller of 0.2/ω
and 1/σ, rounded down.  Masses are masses in air; added mass, which only slows the nodes down, is not included.
MoorDyn 2.7 documentation, "Inputs" (names of options) and "Troubleshooting" (time step).
"""

from __future__ import annotations

import warnings

import numpy as np

from ..lines.system.graph import System
from ..lines.system.parts import Fairlead, FreePoint, LineDynamics, UniformLine
from .fault import FormatError
from .moordyn import MoorDynFile
from .moordyn_dry import weighed_differently
from .moordyn_rows import BodyRow, LineRow, LineTypeRow, PointRow

SEGMENTS = 20  # segments of a line without a number of segments
LONGEST_STEP = 0.05  # s
# settings of a run in time under the names of versions 2 and 1; a System gives all others
SETTINGS = {
    "kBot": ("kBot", "kb"),
    "cBot": ("cBot", "cb"),
    "dtIC": ("dtIC", "ICdt"),
    "TmaxIC": ("TmaxIC", "ICTmax"),
    "CdScaleIC": ("CdScaleIC", "ICDfac"),
    "threshIC": ("threshIC", "ICthresh"),
    "ICgenDynamic": ("ICgenDynamic", "genDynamicIC"),
    "tScheme": ("tScheme",),
    "FricDamp": ("FricDamp",),
    "StatDynFricScale": ("StatDynFricScale",),
    "dtOut": ("dtOut",),
}
BED = {"kBot": "3.0e6", "cBot": "3.0e5"}  # MoorDyn's defaults, Pa/m and Pa s/m
# MoorDyn's static solution can leave free points far from rest (65 times the tension in one file)
RELAXED = {"ICgenDynamic": "1"}


def moordyn_of_system(system: System, source: MoorDynFile | None = None) -> MoorDynFile:
    """The MoorDynFile of a System, for a dynamic run.

    source : the file that the System was read from, whose settings of a run in time are kept.
    Bodies are written as Coupled and fixed in place: MoorDyn receives neither their hydrostatics nor their loads.
    raises : FormatError for a type without mass or diameter, friction that differs between lines, or a line with
        segments
    """
    types, friction = _types(system), _friction(system)
    given = source or MoorDynFile()
    kept = {name: given.option(*names, default=(BED | RELAXED).get(name)) for name, names in SETTINGS.items()}
    kept = {name: value for name, value in kept.items() if value is not None}
    longest = _positive("dtM", given.option("dtM", "dt", default=repr(LONGEST_STEP)))
    bed = [_positive(name, kept[name]) for name in BED]
    for told in _differences(system):
        warnings.warn(told, stacklevel=2)
    points = {point.name: str(i) for i, point in enumerate(system.points, 1)}
    bodies = {body.name: str(i) for i, body in enumerate(system.bodies, 1)}
    return MoorDynFile(
        ("MoorDyn input file written by hakobune",),
        tuple(_type_row(kind) for kind in types),
        bodies=tuple(_body_row(body, bodies[body.name]) for body in system.bodies),
        points=tuple(_point_row(point, points, bodies) for point in system.points),
        lines=tuple(_line_row(str(i), line, points) for i, line in enumerate(system.lines, 1)),
        options={
            "dtM": repr(stable_step(system, longest, *bed)),
            **kept,
            "WtrDpth": repr(float(system.depth)),
            "WtrDnsty": repr(float(system.density)),
            "g": repr(float(system.gravity)),
            **({"FrictionCoefficient": repr(float(friction))} if friction > 0 else {}),
        },
        outputs=tuple(f"{what}{i}" for i in range(1, len(system.lines) + 1) for what in ("FairTen", "AnchTen")),
    )


def _types(system):
    """The line types of a System, each once.  Raises FormatError for lines that MoorDyn does not have."""
    cut = [line.name for line in system.lines if not isinstance(line, UniformLine)]
    if cut:
        raise FormatError(
            f"line {cut[0]} has several segments or stretches by a table; allowed for MoorDyn: uniform lines, joined "
            "at free points, with a number as EA"
        )
    types = {line.type.name: line.type for line in system.lines}
    for line in system.lines:
        if types[line.type.name] != line.type:
            raise FormatError(f"two line types have the name {line.type.name!r}; give each type its own name")
    if len({_word(name) for name in types}) < len(types):
        raise FormatError("two line types have the same name once blanks are replaced; rename one")
    return list(types.values())


def _word(name):
    return name.replace(" ", "_")


def _friction(system):
    """The coefficient of all lines.  Raises FormatError."""
    friction = {line.bed_friction for line in system.lines}
    if len(friction) > 1:
        raise FormatError(f"bed friction is {min(friction):g} and {max(friction):g}; allowed for MoorDyn: one value")
    return max(friction)


def _differences(system):
    """What a System has and its MoorDyn file does not, a text for each"""
    lighter = weighed_differently(system)
    if lighter:
        yield (
            f"line {', '.join(lighter)} comes out of the water; its part in the air has its weight in air in "
            "MoorDyn, and its weight in water in hakobune"
        )
    lost = [line.name for line in system.lines if np.isfinite(line.breaking_load)]
    told = f"; breaking loads are not in the file: those of {', '.join(lost)} are lost" if lost else ""
    if lost or any(not line.name.isdigit() for line in system.lines):
        numbers = ", ".join(f"{i} is {line.name}" for i, line in enumerate(system.lines, 1))
        yield f"the MoorDyn file has numbers instead of names for lines: {numbers}{told}; keep the original file"
    moved = [body.name for body in system.bodies if body.freedom]
    if moved:
        yield (f"{', '.join(moved)} may move in hakobune, but the MoorDyn file holds it at its given place, as Coupled")


def _positive(name, text):
    """The number of an option of the source file"""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < np.inf or (value == 0 and name == "dtM"):
        raise FormatError(f"option {name} of the file that was read is {text!r}; allowed: a number above 0")
    return value


def stable_step(system, longest, bed_stiffness, bed_damping):
    """Stable time step, s; longest : upper limit of the step, s; bed_stiffness, bed_damping : Pa/m and Pa s/m"""
    fastest, decay = [0.2 / longest], []
    for line in system.lines:
        kind, felt = line.type, line.type.dynamics or LineDynamics()
        step, EA, m = line.length / (line.elements or SEGMENTS), kind.axial_stiffness, kind.mass
        axial = 2 * np.sqrt(EA / m) / step
        fastest += [
            axial,
            np.sqrt(bed_stiffness * kind.diameter / m),
            4 * np.sqrt(felt.bending_stiffness / m) / step**2,
        ]
        decay += [4 * felt.damping / (m * step**2) if felt.damping > 0 else -2 * felt.damping * axial]
        decay += [bed_damping * kind.diameter / m]
    return _down(min(0.2 / max(fastest), 1 / max(*decay, 1e-9)))


def _down(value):
    """The next lower number of two digits"""
    unit = 10.0 ** (np.floor(np.log10(value)) - 1)
    return float(f"{np.floor(value / unit * (1 + 1e-12)) * unit:.1e}")


def _line_row(number, line, points):
    segments = line.elements or SEGMENTS
    return LineRow(number, _word(line.type.name), points[line.a], points[line.b], float(line.length), segments, "p")


def _type_row(kind):
    if kind.mass is None or kind.diameter is None:
        raise FormatError(f"line type {kind.name!r} has no mass or no diameter, which MoorDyn needs; give both")
    if not np.isfinite(kind.axial_stiffness):
        raise FormatError(f"line type {kind.name!r} is inextensible, and a MoorDyn file needs EA; give EA")
    felt = kind.dynamics or LineDynamics()
    texts = (repr(float(value)) for value in (kind.axial_stiffness, felt.damping, felt.bending_stiffness))
    coefficients = felt.drag_normal, felt.added_mass_normal, felt.drag_tangential, felt.added_mass_tangential
    return LineTypeRow(_word(kind.name), float(kind.diameter), float(kind.mass), *texts, *map(float, coefficients))


def _body_row(body, number):
    x, y, z = map(float, body.position[:3])
    angles = map(float, np.degrees(body.position[3:]))
    return BodyRow(number, "Coupled", x, y, z, *angles, 0.0, "0", "0", 0.0, "0", "0")


def _point_row(point, points, bodies):
    place = tuple(map(float, point.position))
    if isinstance(point, FreePoint):
        return PointRow(
            points[point.name],
            "Free",
            *place,
            *map(float, (point.mass, point.volume, point.drag_area, point.added_mass)),
        )
    kind = f"Body{bodies[point.body]}" if isinstance(point, Fairlead) else "Fixed"
    return PointRow(points[point.name], kind, *place)
