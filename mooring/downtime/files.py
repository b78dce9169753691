"""Columns of a hindcast in CSV or netCDF, by their names, in SI by the units of their heads.

A head is a name, or a name with its unit in brackets, `hs [cm]`, `wind (knots)`; in netCDF the unit is an attribute.
Without one a column is in m, s, degrees, m/s.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import read_text

from ..environment.tables import TableError
from .clock import times

DEGREE = np.pi / 180
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 1e-3, "ft": 0.3048, "feet": 0.3048}
UNITS = {  # of a kind of column: {unit: its size in SI}, the first where none is named
    "height": LENGTHS,
    "level": LENGTHS,
    "period": {"s": 1.0, "sec": 1.0, "seconds": 1.0, "min": 60.0},
    "direction": {"deg": DEGREE, "°": DEGREE, "degree": DEGREE, "degrees": DEGREE, "degree true": DEGREE, "rad": 1.0},
    "speed": {"m/s": 1.0, "m s-1": 1.0, "m s**-1": 1.0, "knots": 1852 / 3600, "kn": 1852 / 3600, "kt": 1852 / 3600,
              "km/h": 1 / 3.6},
    "share": {"1": 1.0, "-": 1.0, "(0 - 1)": 1.0, "%": 0.01},
}  # fmt: skip
HEAD = re.compile(r"\s*(.*?)\s*(?:[\[(]([^\[\]]*)[\])])?\s*$")


def read_columns(path, time, zone, wanted):
    """(n,) datetime64[s] in UTC, {name: (n,) in SI, nan where a place is empty}, lines on what was taken for granted

    time : name of its column; zone : as of `clock.times`; wanted : {name of a column: its kind, of UNITS or another}
    raises : TableError, one line
    """
    path = Path(path)
    netcdf = path.suffix.lower() in (".nc", ".nc4", ".cdf", ".netcdf")
    heads, get, moments = (_netcdf if netcdf else _text)(path, time, list(wanted))
    found, bare = {}, []
    for name, kind in wanted.items():
        unit = heads[name]
        if unit is None and kind in UNITS:
            bare.append(name)
        found[name] = get(name) * _size(path, name, unit, kind)
    moments = moments if netcdf else times(moments, zone, path.name)
    said = [f"{', '.join(bare)} of {path.name} have no unit; taken in m, s, degrees, m/s"] if bare else []
    return moments, found, said


def _size(path, name, unit, kind):
    known = UNITS.get(kind)
    if unit is None or known is None:
        return next(iter(known.values())) if known else 1.0
    if unit.strip().lower() not in known:
        raise TableError(f"{path.name}: {name} has the unit {unit!r}; allowed: {', '.join(known)}")
    return known[unit.strip().lower()]


def _text(path, time, wanted):
    lines = [line for line in read_text(path, TableError).splitlines() if line.strip() and line.lstrip()[0] != "#"]
    if not lines:
        raise TableError(f"{path} has no rows; allowed: a head and rows of hours")
    mark = next((mark for mark in (";", "\t") if mark in lines[0]), ",")
    head = [HEAD.match(cell).groups() for cell in next(csv.reader(lines[:1], delimiter=mark))]
    places = [_place(path, head, name) for name in (time, *wanted)]
    columns, width = [[] for _ in places], len(head)
    for number, row in enumerate(csv.reader(lines[1:], delimiter=mark), 2):
        if len(row) != width:
            raise TableError(f"{path.name}, row {number}: {len(row)} cells; allowed: {width}, as the head")
        for column, place in zip(columns, places, strict=True):
            column.append(row[place])
    if not columns[0]:
        raise TableError(f"{path} has a head and no rows; allowed: rows of hours")

    def get(name):
        return _numbers(path, name, columns[1 + wanted.index(name)], mark == ";")

    return {name: head[place][1] for name, place in zip(wanted, places[1:], strict=True)}, get, columns[0]


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
                    f"{path.name}, row {number}: {name} is {cell!r}; allowed: a number, or nothing"
                ) from None
        raise


def _netcdf(path, time, wanted):
    try:
        import xarray
    except ImportError:
        raise TableError(f"{path} is netCDF; pip install 'hakobune[xarray]' to read it") from None
    try:
        with xarray.open_dataset(path) as data:
            data = data.load()
    except Exception as error:
        raise TableError(
            f"{path} cannot be read ({str(error).splitlines()[0] if str(error) else type(error)})"
        ) from None
    for name in (time, *wanted):
        if name not in data.variables:
            raise TableError(f"{path.name} has no variable {name!r}; it has {', '.join(map(str, data.variables))}")
        if data[name].size != data[time].size:
            sizes = ", ".join(f"{axis} {size}" for axis, size in data[name].sizes.items())
            raise TableError(f"{path.name}: {name} has {sizes}; allowed: {time} alone; cut one place out of the file")
    if data[time].dtype.kind != "M":
        raise TableError(f"{path.name}: {time} is no time; allowed: a variable with units as 'hours since 1900-01-01'")

    def get(name):
        return np.asarray(data[name].values, float).ravel()

    moments = np.asarray(data[time].values).ravel().astype("datetime64[s]")
    return {name: data[name].attrs.get("units") for name in wanted}, get, moments
