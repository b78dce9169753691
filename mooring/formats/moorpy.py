"""MoorPy's YAML, also inside a RAFT design (`mooring:`, `array_mooring:`) and windIO, as a System of lines.

Keys: water_depth (depth), water_density (rho_water, rho), line_types, points, lines; mass_density is mass per metre, so
the submerged weight is (mass_density − ρ π/4 diameter²) g.  Points of type fixed are anchors. Points of type vessel
and fairlead belong to one body "vessel" at the origin; points of type body1 … belong to "body 1" …. Points of type
free and connection are free. anchor_types and costs are ignored.  NREL/MoorPy 1.3, `System.parseYAML`.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from ..lines.system.graph import System
from ..lines.system.parts import Anchor, Fairlead, FreePoint, LineType, MooredBody, UniformLine
from .fault import FormatError
from .moordyn_system import read_moordyn_system
from .orcaflex import is_orcaflex, system_of_orcaflex
from .windio import is_windio, raft_of_windio

LARGEST = 1.0  # MB; a parser in Python takes some seconds
KNOWN = {
    "line_types": {"name", "diameter", "mass_density", "stiffness", "breaking_load", "cost", "transverse_added_mass",
                   "tangential_added_mass", "transverse_drag", "tangential_drag", "damping"},
    "points": {"name", "type", "location", "mass", "volume", "anchor_type"},
    "lines": {"name", "endA", "endB", "type", "length"},
}  # fmt: skip
FAMODEL = {"mooring_line_configs", "mooring_systems", "array_mooring_systems", "mooring_line_types"}
READ = ("water_depth", "depth", "water_density", "rho_water", "rho", *KNOWN, "anchor_types", "bodies", "file")


def system_of_moorpy(data, path="YAML file", depth=None) -> System:
    """The System of nested dictionaries.  Raises FormatError naming table and key."""
    site = {}
    if is_orcaflex(data):
        return system_of_orcaflex(data, path, depth)
    if isinstance(data, dict) and is_windio(data):
        data = raft_of_windio(data, path)
    _check_kind(data, path)
    if isinstance(data.get("array_mooring"), dict) and data["array_mooring"].get("file"):
        file = Path(path).parent / str(data["array_mooring"]["file"])
        return read_moordyn_system(file, depth, turbines=_turbines(data.get("array"), path))
    if isinstance(data.get("mooring"), dict):
        site, data = data.get("site"), data["mooring"]
    unknown = sorted(str(key) for key in data if key not in READ)
    if unknown:
        warnings.warn(
            f"{path}: these tables are not read: {', '.join(unknown)}; known tables: {', '.join(READ)}", stacklevel=3
        )
    data = {**site, **data} if isinstance(site, dict) else data
    if data.get("file"):
        return read_moordyn_system(Path(path).parent / data["file"], depth)
    if data.get("bodies"):
        raise FormatError(
            f"{path}: the table bodies is not read, since MoorPy does not define it yet; use points of type vessel"
        )
    density = _number(data, ("water_density", "rho_water", "rho"), path, "the file", 1025.0)
    given, depth = depth, _number(data, ("water_depth", "depth"), path, "the file", depth)
    if given is not None and given != depth:
        raise FormatError(f"{path}: water_depth is {depth:g} m and the given depth is {given:g} m; give one of them")
    tables = {key: _table(data, key, path) for key in KNOWN}
    types = {row["name"]: _type(row, density, path) for row in tables["line_types"]}
    points = [_point(row, path) for row in tables["points"]]
    bodies = sorted({point.body for point in points if isinstance(point, Fairlead)})
    lines = [_line(row, types, path) for row in tables["lines"]]
    return System(depth, lines, points, [MooredBody(name) for name in bodies], density)


def _check_kind(data, path):
    """Raises FormatError for a file that is no table of MoorPy or RAFT; the message names its kind if known"""
    if not isinstance(data, dict):
        raise FormatError(f"{path}: the file is not a table of keys, so it is not a MoorPy file")
    if FAMODEL & set(data):
        raise FormatError(
            f"{path} is an ontology of FAModel ({', '.join(sorted(FAMODEL & set(data)))}), which describes whole "
            "arrays and is not read; allowed: the system that FAModel builds from it (getMoorPyArray), written as "
            "MoorDyn input"
        )
    known = data.get("mooring") or data
    if not (data.get("array_mooring") or (isinstance(known, dict) and (known.get("file") or set(KNOWN) & set(known)))):
        raise FormatError(
            f"{path} has no mooring: neither line_types, points and lines nor a file of MoorDyn; it has "
            f"{', '.join(list(map(str, data))[:8])}"
        )


def _turbines(array, path):
    """{number: (x, y, z)} m of RAFT's array"""
    try:
        keys, rows = list(array["keys"]), array["data"]
        places = [[float(row[keys.index(key)]) for key in ("x_location", "y_location")] for row in rows]
    except (KeyError, TypeError, ValueError, IndexError):
        raise FormatError(
            f"{path}: the table array lacks x_location or y_location of its turbines; give both"
        ) from None
    return {number: (*place, 0.0) for number, place in enumerate(places, 1)}


def _table(data, key, path):
    rows = data.get(key)
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise FormatError(f"{path}: {key} is {type(rows).__name__}; allowed: a list of tables")
    for i, row in enumerate(rows):
        where = f"{key}[{i}]"
        unknown = {str(name) for name in row} - KNOWN[key]
        if unknown:
            raise FormatError(f"{path}: {where}.{min(unknown)} is unknown; allowed: {', '.join(sorted(KNOWN[key]))}")
        if row.get("name") is None:
            raise FormatError(f"{path}: {where}.name is missing; allowed: text")
        row["name"] = str(row["name"])
    return rows


def _number(row, keys, path, where, default=None):
    value = next((row[key] for key in keys if row.get(key) is not None), default)
    if not _is_number(value):
        state = "missing" if value is None else repr(value)
        raise FormatError(f"{path}: {keys[0]} of {where} is {state}; allowed: a number")
    return float(value)


def _is_number(value):
    """Finite; true and false are words, a whole number of four hundred digits has no place among the others"""
    return isinstance(value, int | float) and not isinstance(value, bool) and -1e300 < value < 1e300


def _type(row, density, path):
    where = f"line type {row['name']}"
    diameter, mass, stiffness = (_number(row, (key,), path, where) for key in ("diameter", "mass_density", "stiffness"))
    breaking = _number(row, ("breaking_load",), path, where, 0.0) or np.inf
    weight = (mass - density * np.pi / 4 * diameter**2) * 9.80665
    return LineType(row["name"], weight, stiffness, mass, diameter, breaking, source=str(path))


def _point(row, path):
    name, place, kind = row["name"], row.get("location"), str(row.get("type", "")).lower()
    if not isinstance(place, list) or len(place) != 3 or not all(map(_is_number, place)):
        raise FormatError(f"{path}: location of point {name} is {place!r}; allowed: [x, y, z] in m")
    place = tuple(map(float, place))
    if "anch" in kind or "fix" in kind:
        return Anchor(name, place)
    if "body" in kind:
        return Fairlead(name, f"body {''.join(filter(str.isdigit, kind)) or 1}", place)
    if "fair" in kind or "ves" in kind:
        return Fairlead(name, "vessel", place)
    if "con" in kind or "free" in kind:
        where = f"point {name}"
        return FreePoint(
            name, place, _number(row, ("mass",), path, where, 0.0), _number(row, ("volume",), path, where, 0.0)
        )
    raise FormatError(f"{path}: type of point {name} is {row.get('type')!r}; allowed: fixed, vessel, body1 …, free")


def _line(row, types, path):
    where = f"line {row['name']}"
    if str(row.get("type")) not in types:
        raise FormatError(f"{path}: type of {where} is {row.get('type')!r}; allowed: {', '.join(types)}")
    length = _number(row, ("length",), path, where)
    return UniformLine(row["name"], types[str(row["type"])], length, str(row.get("endA")), str(row.get("endB")))
