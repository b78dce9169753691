"""Lines and line types of OrcaFlex's text data file, NAME.yml (OrcaFlex help, "Text data files", "Lines").

    units as UnitsSystem of General says;  an end is Fixed (X Y Z in space), Anchored (Z above the bed there) or on a
    vessel (in its axes, from InitialPosition and Orientation); sections of LineType and Length from end A
    submerged weight of a type: (MassPerUnitLength + contents − ρ π/4 OD²) g

A key may stand alone with its place in brackets, Length[1]: 660; or several keys stand together with rows,
"LineType, Length: [[chain, 660]]". Before OrcaFlex 11 the keys of ends are EndAConnection, EndAX.  Vessels are held
in heave, roll and pitch.  Drag, added mass and bending are not read. Content that would change the lines at rest but
cannot be represented is refused by name.
"""

from __future__ import annotations

import re
import warnings

import numpy as np

from hakobune.bem.formats.orcaflex import _units

from ..lines.multi_segment.segments import Segment
from ..lines.system.graph import System
from ..lines.system.parts import Anchor, CompositeLine, Fairlead, LineType, MooredBody, UniformLine
from .fault import FormatError

GRAVITY = 9.80665


def is_orcaflex(data):
    """Whether nested dictionaries are a model of OrcaFlex"""
    return (
        isinstance(data, dict)
        and ("BaseFile" in data or {"General", "Environment"} & set(data))
        and ("line_types" not in data)
    )


def system_of_orcaflex(data, path="YAML file", depth=None) -> System:
    """The System of nested dictionaries; depth : m, if the file has none.  Raises FormatError, which names the key."""
    rows = data.get("Lines")
    if not rows:
        more = f": it contains only the differences from {data['BaseFile']}" if data.get("BaseFile") else ""
        raise FormatError(f"{path} has no Lines{more}; allowed: a complete model saved as text")
    units = _units(data.get("General") or {}, path)
    water = data.get("Environment") or {}
    depth = _number(water, "WaterDepth", "Environment", path, units.length, depth)
    density = _number(water, "Density", "Environment", path, units.mass / units.length**3, 1025.0)
    named = _named(data, "LineTypes", path)
    vessels = _named(data, "Vessels", path) if data.get("Vessels") else {}
    points, lines, bodies = [], [], {}
    for name, row in _named(data, "Lines", path).items():
        kinds = _types(row, name, named, units, density, path)
        if light := next((kind for kind, _ in kinds if kind.weight <= 0), None):
            warnings.warn(
                f"{path}: line {name} floats ({light.name}, {light.weight:.4g} N/m in water) and is left out together "
                "with its pull; allowed: sections that sink",
                stacklevel=3,
            )
            continue
        ends = []
        for number, letter in enumerate("AB"):
            point, body = _end(row, name, number, letter, vessels, units, depth, path)
            points.append(point)
            ends.append(point.name)
            bodies |= {body.name: body} if body else {}
        lines.append(_line(row, name, ends, kinds, path))
    return System(depth, lines, points, list(bodies.values()), density, GRAVITY)


def column(row, key):
    """Values of a key at all places of an OrcaFlex table; [] for a missing key"""
    for names, values in row.items():
        parts = [part.strip() for part in str(names).split(",")]
        if key in parts and isinstance(values, list) and values and isinstance(values[0], list):
            return [one[parts.index(key)] for one in values]
        if parts == [key]:
            return values if isinstance(values, list) else [values]
    places = {int(found[1]): value for name, value in row.items()
              if (found := re.fullmatch(rf"{key}\[(\d+)\]", str(name)))}  # fmt: skip
    return [places[number] for number in sorted(places)]


def _named(data, section, path):
    """{name: row} of a section, a list of rows with a Name or a table by names"""
    rows = data.get(section) or []
    if isinstance(rows, dict):
        rows = [{"Name": name, **(row or {})} for name, row in rows.items()]
    if not isinstance(rows, list) or not all(isinstance(row, dict) and row.get("Name") for row in rows):
        raise FormatError(
            f"{path}: {section} is not a list of entries with a Name each; allowed: the list that OrcaFlex writes"
        )
    return {str(row["Name"]): row for row in rows}


def _number(row, key, where, path, unit, default=None):
    """SI; a number as text is accepted, since YAML 1.1 reads 854e3 as text"""
    value = next((value for value in column(row, key) if value is not None), default)
    if value is default and default is not None:
        return float(default)
    try:
        found = float(value)
    except (TypeError, ValueError):
        state = "missing" if value is None else f"{value!r}, as variable data are"
        raise FormatError(f"{path}: {key} of {where} is {state}; allowed: a number") from None
    if not np.isfinite(found):
        raise FormatError(f"{path}: {key} of {where} is {value}; allowed: finite")
    return found * unit


def _end(row, line, number, letter, vessels, units, depth, path):
    """Point of an end, and the MooredBody that it belongs to, or None"""
    kinds = column(row, "Connection") or [*column(row, "EndAConnection"), *column(row, "EndBConnection")]
    if len(kinds) != 2:
        raise FormatError(
            f"{path}: line {line} has {len(kinds)} connections; allowed: two, one for each of ends A and B"
        )
    new = [column(row, f"Connection{axis}") for axis in "XYZ"]
    old = [column(row, f"End{letter}{axis}") for axis in "XYZ"]
    place = [values[number] for values in new] if all(new) else [values[0] for values in old if values]
    try:
        place = tuple(units.length * float(value) for value in place)
    except (TypeError, ValueError):
        place = ()
    if len(place) != 3:
        raise FormatError(f"{path}: end {letter} of line {line} has no X, Y, Z; allowed: numbers")
    kind, name = str(kinds[number]), f"{line} {letter}"
    if kind == "Fixed":
        return Anchor(name, place), None
    if kind == "Anchored":
        return Anchor(name, (*place[:2], place[2] - depth)), None
    if kind not in vessels:
        raise FormatError(
            f"{path}: end {letter} of line {line} is connected to {kind}; allowed: Fixed, Anchored, or one of Vessels"
        )
    return Fairlead(name, kind, place), _vessel(vessels[kind], kind, units, path)


def _vessel(row, name, units, path):
    position = [*column(row, "InitialPosition")] or [v for axis in "XYZ" for v in column(row, f"Initial{axis}")]
    turn = [*column(row, "Orientation")] or [v for a in ("Heel", "Trim", "Heading") for v in column(row, f"Initial{a}")]
    try:
        position, turn = ([float(value) for value in values or (0, 0, 0)] for values in (position, turn))
    except (TypeError, ValueError):
        position = []
    if len(position) != 3 or len(turn) != 3 or np.count_nonzero(turn[:2]):
        raise FormatError(
            f"{path}: vessel {name} has no InitialPosition of three numbers, or it heels; allowed: an upright vessel"
        )
    return MooredBody(name, (*(units.length * value for value in position), 0.0, 0.0, float(np.radians(turn[2]))))


def _types(row, name, types, units, density, path):
    """[(LineType, m)] of the sections of a line"""
    kinds, lengths = column(row, "LineType"), column(row, "Length")
    if not kinds or len(kinds) != len(lengths) or any(str(kind) not in types for kind in kinds):
        raise FormatError(
            f"{path}: line {name} has the types {', '.join(map(str, kinds)) or 'none'} and {len(lengths)} lengths; "
            f"allowed: types of LineTypes ({', '.join(types)}), each with a length"
        )
    contents = _number(row, "ContentsDensity", f"line {name}", path, units.mass / units.length**3, 0.0)
    made = [_type(types[str(kind)], str(kind), units, density, contents, path) for kind in kinds]
    lengths = [_number({"Length": [length]}, "Length", f"line {name}", path, units.length) for length in lengths]
    return list(zip(made, lengths, strict=True))


def _line(row, name, ends, kinds, path):
    if column(row, "AttachmentType"):
        warnings.warn(f"{path}: attachments of line {name} are not read: clump weights, floats", stacklevel=4)
    if len(kinds) == 1:
        return UniformLine(name, *kinds[0], *ends)
    pieces = [Segment(length, one.weight, one.axial_stiffness, one.diameter, one.breaking_load)
              for one, length in kinds]  # fmt: skip
    return CompositeLine(name, tuple(pieces), *ends)


def _type(row, name, units, density, contents, path):
    where, each = f"line type {name}", units.mass / units.length
    outer, mass, stiffness = (
        _number(row, key, where, path, unit)
        for key, unit in (("OD", units.length), ("MassPerUnitLength", each), ("EA", units.force))
    )
    inner = _number(row, "ID", where, path, units.length, 0.0)
    mass += contents * np.pi / 4 * inner**2
    weight = GRAVITY * (mass - density * np.pi / 4 * outer**2)
    breaking = _number(row, "MinimumBreakingLoad", where, path, units.force, 0.0) or np.inf
    return LineType(name, weight, stiffness, mass, outer, breaking, source=str(path))
