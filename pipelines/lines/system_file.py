"""A system of mooring lines from a file: hakobune's TOML, MoorDyn input, FAST.Farm's .fstf, or YAML of MoorPy, RAFT or
OrcaFlex.

TOML, in m, kg and degrees, with [water], [types.<name>] as in a mooring study, and the lists [[bodies]], [[anchors]],
[[fairleads]], [[points]] (free: buoys, sinkers, joints) and [[lines]].
"""

import math
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, Fairlead, FreePoint, MooredBody

from ..common.anchors import warn_of_anchors
from ..common.line_tables import LineTable, TypeTable, check_types, line_of
from ..common.quantities import StudyError, Table, water_density, water_depth
from ..common.typed import read_toml, typed
from ..common.weather.water import WaterTable
from ..results.heard import heard

YAML, TOML = (".yaml", ".yml"), (".toml",)


class BodyTable(Table):
    """A body held by lines

    name : name of the body, for the key body of fairleads
    position : m, x, y, z at rest
    heading_deg : heading of its x axis, 0 → +x
    freedom : motions that are free under load: Surge, Sway, Heave, Roll, Pitch, Yaw
    force_kN : steady force along x, y, z
    moment_kNm : steady moment about x, y, z
    """

    name: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    heading_deg: float = 0.0
    freedom: list[str] = msgspec.field(default_factory=lambda: ["Surge", "Sway", "Yaw"])
    force_kN: tuple[float, float, float] = (0.0, 0.0, 0.0)
    moment_kNm: tuple[float, float, float] = (0.0, 0.0, 0.0)


class AnchorTable(Table):
    """A fixed end of lines

    name : name of the anchor, for the keys from and to of lines
    position : m, x, y, z in space
    """

    name: str
    position: tuple[float, float, float]


class FairleadTable(Table):
    """A point of a body where lines end

    name : name of the fairlead, for the keys from and to of lines
    body : name of its body
    position : m, x, y, z in the axes of the body
    """

    name: str
    body: str
    position: tuple[float, float, float]


class PointTable(Table):
    """A buoy, sinker or joint, free to move

    name : name of the point, for the keys from and to of lines
    position : m, x, y, z where the search for equilibrium starts
    mass : kg, mass of the buoy or sinker
    volume : m³, volume of the displaced water
    height : m, height of a buoy, over which it emerges from the water
    """

    name: str
    position: tuple[float, float, float]
    mass: float = 0.0
    volume: float = 0.0
    height: float | None = None


class SystemLineTable(LineTable, kw_only=True):
    """A line between two anchors, fairleads or points

    name : name of the line in results and messages
    from : name of the point at its first end
    to : name of the point at its second end
    """

    name: str
    start: str = msgspec.field(name="from")
    end: str = msgspec.field(name="to")


class SystemTable(Table):
    """A system of lines between bodies, anchors and free points"""

    water: WaterTable
    types: dict[str, TypeTable]
    lines: list[SystemLineTable]
    bodies: list[BodyTable] = msgspec.field(default_factory=list)
    anchors: list[AnchorTable] = msgspec.field(default_factory=list)
    fairleads: list[FairleadTable] = msgspec.field(default_factory=list)
    points: list[PointTable] = msgspec.field(default_factory=list)


@dataclass(frozen=True)
class Given:
    """A system read from a file.

    text : text of the file; said : warnings about the file; moordyn : MoorDynFile, or None for other files
    """

    system: System
    text: str = ""
    said: list = field(default_factory=list)
    moordyn: object = None


def read_system(path, depth=None) -> System:
    """The System of a file, by its suffix: .toml, .yaml or .yml, otherwise MoorDyn.

    depth : water depth, m, for a MoorDyn or YAML file without depth. Warns of a file without anchors.
    Raises ValueError, with a message of one line.
    """
    given = read_given(path, depth)
    for line in given.said:
        warnings.warn(line, stacklevel=2)
    return given.system


def read_given(system, depth=None) -> Given:
    """The system of a path, a dictionary or a System; depth as in `read_system`.  Raises ValueError, with a message
    of one line."""
    if isinstance(system, System):
        return Given(system)
    if depth is not None and not 0 < depth < math.inf:
        raise StudyError(f"--depth is {depth:g} m; allowed: above 0, finite")
    with heard() as said:
        if isinstance(system, dict):
            import tomli_w

            made, text, moordyn = make_system(system), tomli_w.dumps(system), None
        else:
            made, text, moordyn = _read(Path(system), depth)
        heights = {one.name: one.position[2] for one in made.points if isinstance(one, Anchor)}
        warn_of_anchors(heights, made.depth)
    return Given(made, text, said, moordyn)


def _read(path, depth):
    """System, text and MoorDynFile of a path, or None for missing ones"""
    if path.suffix.lower() in TOML:
        if depth is not None:
            raise StudyError(
                f"--depth is {depth:g} m, but {path} has its own depth; leave --depth out, or change [water] depth"
            )
        raw, text = read_toml(path, "a system", StudyError)
        return make_system(raw), text, None
    from hakobune.meshing.text_files import read_text
    from hakobune.mooring.formats import moordyn, moorpy
    from hakobune.mooring.formats.fault import FormatError
    from hakobune.mooring.formats.yaml_text import parse_yaml

    if path.suffix.lower() in YAML:
        text = read_text(path, FormatError, largest=moorpy.LARGEST)
        return moorpy.system_of_moorpy(parse_yaml(text, path), path, depth), text, None
    from hakobune.mooring.formats.moordyn_system import system_of_moordyn

    if path.suffix.lower() == ".fstf":
        from hakobune.mooring.formats.fast_farm import read_fast_farm

        return read_fast_farm(path, depth), read_text(path, FormatError, errors="replace"), None
    text = read_text(path, FormatError, errors="replace", largest=moordyn.LARGEST)
    file = moordyn.parse_moordyn(text, path)
    return system_of_moordyn(file, path, depth), text, file


def make_system(raw) -> System:
    """The System of nested dictionaries read from TOML.  Raises ValueError, with a message of one line."""
    table = typed(raw, SystemTable, StudyError)
    bodies = [
        MooredBody(
            body.name,
            (*body.position, 0.0, 0.0, math.radians(body.heading_deg)),
            tuple(body.freedom),
            load=tuple(1e3 * value for value in (*body.force_kN, *body.moment_kNm)),
        )
        for body in table.bodies
    ]
    _warn_of_no_water(table.bodies)
    points = [Anchor(point.name, point.position) for point in table.anchors]
    points += [Fairlead(point.name, point.body, point.position) for point in table.fairleads]
    points += [FreePoint(p.name, p.position, p.mass, p.volume, p.height) for p in table.points]
    water = table.water
    water_density("water.density", water.density)
    check_types(table.types)
    z = {point.name: point.position[2] for point in table.anchors}
    lines = [
        line_of(
            f"lines[{i}]",
            line.name,
            line,
            table.types,
            (line.start, line.end),
            water.density,
            water.gravity,
            z.get(line.start, z.get(line.end, -math.inf)),
        )
        for i, line in enumerate(table.lines)
    ]
    return System(
        water_depth("water.depth", water.depth), lines, points, bodies, table.water.density, table.water.gravity
    )


def _warn_of_no_water(bodies):
    """Warn of bodies that would sink or turn over: a system in TOML has neither their weight nor buoyancy"""
    for body in bodies:
        loose = [name for name in ("Heave", "Roll", "Pitch") if name in body.freedom]
        if body.force_kN[2] != 0 and "Heave" in loose:  # its buoyancy minus its weight is given
            loose.remove("Heave")
        if loose:
            warnings.warn(
                f"{body.name} is free in {', '.join(loose)}, but this command knows no weight and no buoyancy, so "
                'that only the lines hold it; allowed: freedom = ["Surge", "Sway", "Yaw"], or Heave with buoyancy '
                "minus weight as the third number of force_kN; `hakobune moor` includes buoyancy",
                stacklevel=3,
            )
