"""Columns of a hindcast by name, converted to SI from the units of their headers: CSV, netCDF, NDBC, SWAN tables.

A header is a name, or a name with its unit in brackets: `hs [cm]`, `wind (knots)`. In netCDF the unit is an attribute;
in files of NDBC (`#YY MM DD hh mm WDIR …`) and tables of SWAN (`% Time Hsig …`) the units are in a separate line.
The default units are m, s, degrees, m/s.
"""

import csv
import re
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import read_text

from ..environment.tables import TableError
from .clock import times

DEGREE = np.pi / 180
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 1e-3, "ft": 0.3048, "feet": 0.3048, "meters": 1.0}
SPEEDS = {"m/s": 1.0, "m s-1": 1.0, "m s**-1": 1.0, "m.s^{-1}": 1.0, "knots": 1852 / 3600, "kn": 1852 / 3600,
          "kt": 1852 / 3600, "km/h": 1 / 3.6}  # fmt: skip
TURNS = "deg", "°", "degr", "degree", "degrees", "degree true", "degree_true", "degrees true", "degrees_true", "degt"
UNITS = {  # units by kind of column, {unit: size in SI}; the first is the default
    "height": LENGTHS,
    "level": LENGTHS,
    "period": {"s": 1.0, "sec": 1.0, "seconds": 1.0, "min": 60.0},
    "direction": {**dict.fromkeys(TURNS, DEGREE), "rad": 1.0},
    "speed": SPEEDS,
    "component": SPEEDS,
    "share": {"1": 1.0, "-": 1.0, "(0 - 1)": 1.0, "%": 0.01},
}
HEAD = re.compile(r"\s*(.*?)\s*(?:[\[(]([^\[\]]*)[\])])?\s*$")
TIMES = "time", "valid_time", "time_index", "ocean_time", "Time"  # alternative names of the time variable


def read_columns(path, time, zone, wanted, location=None):
    """Return times (n,), datetime64[s] in UTC; {name: values (n,) in SI, nan for empty fields}; messages on assumptions

    time : name of the column of times; zone : as in `clock.times`; wanted : {name of a column: its kind, from UNITS
        or any other}
    location : number of the place in a netCDF file of several places, from 1; the count runs fastest along the last
        axis
    raises : TableError, one line
    """
    path = Path(path)
    if path.suffix.lower() in (".nc", ".nc4", ".cdf", ".netcdf"):
        units, found, moments = _netcdf(path, time, list(wanted), location)
    else:
        units, found, moments = _text(path, time, list(wanted))
        moments = times(moments, zone, path.name)
    bare = [name for name, kind in wanted.items() if units[name] is None and kind in UNITS]
    found = {name: found[name] * _size(path, name, units[name], kind) for name, kind in wanted.items()}
    said = [f"{', '.join(bare)} in {path.name} have no units; m, s, degrees and m/s are assumed"] if bare else []
    return moments, found, said


def _size(path, name, unit, kind):
    known = UNITS.get(kind)
    if unit is None or known is None:
        return next(iter(known.values())) if known else 1.0
    if unit.strip().lower() not in known:
        raise TableError(f"{path.name}: {name} has the unit {unit!r}; allowed: {', '.join(known)}")
    return known[unit.strip().lower()]


def _text(path, time, wanted):
    head, rows, comma = _table(path)
    places = [_place(path, head, name) for name in (_time_of(time, [own for own, _ in head]), *wanted)]
    columns, width = [[] for _ in places], len(head)
    for number, row in enumerate(rows, 2):
        if len(row) != width:
            raise TableError(f"{path.name}, row {number}: {len(row)} cells; allowed: {width}, as in the header")
        for column, place in zip(columns, places, strict=True):
            column.append(row[place])
    if not columns[0]:
        raise TableError(f"{path} has a header and no rows; give a row for each hour")
    units = {name: head[place][1] for name, place in zip(wanted, places[1:], strict=True)}
    return units, {name: _numbers(path, name, columns[1 + i], comma) for i, name in enumerate(wanted)}, columns[0]


def _table(path):
    """Headers [(name, unit or None)], rows of cells, and whether commas are decimal points"""
    lines = [line for line in read_text(path, TableError).splitlines() if line.strip()]
    if lines and re.match(r"#?YY(YY)?\s+MM\s+DD\s+hh\s+mm\b", lines[0]):
        return _of_ndbc(lines)
    if lines and lines[0].lstrip().startswith("%"):
        return _of_swan(path, [line.split() for line in lines])
    lines = [line for line in lines if line.lstrip()[0] != "#"]
    if not lines:
        raise TableError(f"{path} has no rows; give a header and a row for each hour")
    mark = next((mark for mark in (";", "\t") if mark in lines[0]), ",")
    head = [HEAD.match(cell).groups() for cell in next(csv.reader(lines[:1], delimiter=mark))]
    return head, csv.reader(lines[1:], delimiter=mark), mark == ";"


def _of_ndbc(lines):
    """Standard meteorological data of NDBC: five columns of time; MM is missing, the second line may have units"""
    names, rows = lines[0].lstrip("#").split()[5:], [line.split() for line in lines[1:]]
    units = rows.pop(0)[5:] if rows and rows[0][0].startswith("#") else [None] * len(names)
    cells = ([f"{row[0]}-{row[1]}-{row[2]}T{row[3]}:{row[4]}", *("nan" if one == "MM" else one for one in row[5:])]
             for row in rows)  # fmt: skip
    return [("time", None), *zip(names, units, strict=True)], cells, False


def _of_swan(path, rows):
    """A table of SWAN: two % lines with names, and units in brackets; times as 20161011.060000"""
    heads = [row[1:] for row in rows if row[0] == "%" and len(row) > 1]
    at = next((i for i, row in enumerate(heads) if i and all(re.fullmatch(r"\[.*\]?|.*\]", one) for one in row)), None)
    if at is None:
        raise TableError(f"{path.name} has no line of column names and no line of [units] above its rows; give both")
    units = re.findall(r"\[\s*(.*?)\s*\]", " ".join(heads[at]))
    rows = ([re.sub(r"^(\d{4})(\d\d)(\d\d)\.(\d\d)(\d\d)(\d\d)$", r"\1-\2-\3T\4:\5:\6", one) for one in row]
            for row in rows if row[0] != "%")  # fmt: skip
    return list(zip(heads[at - 1], [unit or None for unit in units], strict=True)), rows, False


def _time_of(asked, names):
    return asked if asked in names or asked != "time" else next((one for one in TIMES if one in names), asked)


def _place(path, head, name):
    asked = HEAD.match(name)[1]
    found = [i for i, (own, _) in enumerate(head) if own == asked]
    if len(found) != 1:
        shown = ", ".join(own + (f" [{unit}]" if unit else "") for own, unit in head)
        state = "no column" if not found else f"{len(found)} columns"
        raise TableError(f"{path.name} has {state} {asked!r}; it has {shown}")
    return found[0]


def _numbers(path, name, cells, comma):
    cells = [cell.strip() or "nan" for cell in cells]
    if comma:
        cells = [cell.replace(",", ".") for cell in cells]
    try:
        return np.array(cells).astype(float)
    except ValueError:
        for number, cell in enumerate(cells, 2):
            try:
                float(cell)
            except ValueError:
                raise TableError(
                    f"{path.name}, row {number}: {name} is {cell!r}; allowed: a number, or an empty cell"
                ) from None
        raise


def _netcdf(path, time, wanted, location):
    try:
        import xarray
    except ImportError:
        raise TableError(f"{path} is netCDF; pip install 'hakobune[xarray]' to read it") from None
    try:
        with xarray.open_dataset(path) as data:
            time = _time_of(time, list(data.variables))
            for name in (time, *wanted):
                if name not in data.variables:
                    raise TableError(
                        f"{path.name} has no variable {name!r}; it has {', '.join(map(str, data.variables))}"
                    )
            moments = data[time]
            if moments.dtype.kind != "M":
                raise TableError(
                    f"{path.name}: {time} is not a time; allowed: a variable with units such as 'hours since "
                    f"1900-01-01'"
                )
            found = {name: _at(path, data[name], moments, location) for name in wanted}
            moments = np.asarray(moments.values).ravel().astype("datetime64[s]")
            return {name: data[name].attrs.get("units") for name in wanted}, found, moments
    except TableError:
        raise
    except Exception as error:
        raise TableError(
            f"{path} cannot be read ({str(error).splitlines()[0] if str(error) else type(error)})"
        ) from None


def _at(path, values, time, location):
    """Values of a variable at a place, index `location` over all axes except time; shape (n,)"""
    axes = [axis for axis in values.dims if axis not in time.dims]
    sizes = [values.sizes[axis] for axis in axes]
    count = int(np.prod(sizes))
    if values.size != count * time.size or (count > 1 and location is None) or not 1 <= (location or 1) <= count:
        shown = ", ".join(f"{axis} {size}" for axis, size in values.sizes.items())
        raise TableError(f"{path.name}: {values.name} has the axes {shown}, but only {time.name} is expected; give "
            f"hindcast.location from 1 to {count}, the number of a place along the other axes, of which the last "
            "changes first")  # fmt: skip
    place = np.unravel_index((location or 1) - 1, sizes) if sizes else ()
    return np.asarray(values.isel(dict(zip(axes, map(int, place), strict=True))).values, float).ravel()
