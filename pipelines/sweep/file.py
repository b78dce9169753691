"""The results of a sweep: one HDF5 file that fills case by case and can be killed at any instant.

/keys/NAME (case,);  /status (case,): −1 to do, else that of the command;  /message (case,);  /tables/N/COLUMN
(case, row) with its title as an attribute and the labels of its rows in /tables/N/row.  Numbers have the digits that
the command gives with --json; what is no number is NaN.  A sweep of scenes has /results/NAME (case, …) instead, the
arrays of each case's database with all their digits.  The status is written last.
"""

from __future__ import annotations

import h5py
import numpy as np

from hakobune.bem import __version__
from hakobune.bem.database.results import named
from hakobune.bem.database.schema import DOFS, DRIFT_DOFS

SCHEMA = "hakobune sweep 1"
PENDING = -1


def is_sweep(path):
    """Whether a file is the result of a sweep"""
    if not (path.is_file() and h5py.is_hdf5(path)):
        return False
    with h5py.File(path) as file:
        return named(str(file.attrs.get("schema", ""))) == named(SCHEMA)


def create(path, keys, values, texts):
    """Make the file with every case to do; texts : {name: text} of sweep and study, kept as attributes"""
    with h5py.File(path, "w") as file:
        file.attrs.update({"schema": SCHEMA, "software_version": __version__, **texts})
        count = len(values)
        file.create_dataset("case", data=np.arange(count)).make_scale("case")
        for name, column in zip(keys, zip(*values, strict=True), strict=True):
            numbers = all(isinstance(value, int | float) for value in column)
            data = np.array(column, float if numbers else h5py.string_dtype())
            _on(file, f"keys/{name}", data)
        _on(file, "status", np.full(count, PENDING, np.int16))
        _on(file, "message", np.array([""] * count, h5py.string_dtype()))


def _on(file, name, data):
    dataset = file.create_dataset(name, data=data)
    dataset.dims[0].attach_scale(file["case"])
    return dataset


def case_count(path):
    """How many cases a sweep has, run or not"""
    with h5py.File(path) as file:
        return len(file["case"])


def pending(path):
    """Numbers of the cases still to do"""
    with h5py.File(path) as file:
        return np.flatnonzero(file["status"][()] == PENDING).tolist()


def store(path, results):
    """Keep what cases gave, then their status; the file is opened once for all of them.

    results : [(case, status, message, tables, arrays)]; tables : [{"title", "rows": [{name: text}]}]
    arrays : {name: (axes, unit, array)}
    """
    with h5py.File(path, "r+") as file:
        for case, _, message, tables, arrays in results:
            for number, table in enumerate(tables):
                message = _store_table(file, number, case, table) or message
            for name, (axes, unit, array) in arrays.items():
                message = _store_array(file, name, case, axes, unit, np.asarray(array)) or message
            file["message"][case] = message
        file.flush()
        for case, status, *_ in results:
            file["status"][case] = status


def _store_table(file, number, case, table):
    """Numbers of a table into its columns; says why where it is another than the first case's"""
    rows = table["rows"]
    if not rows:
        return ""
    names = list(rows[0])
    labels = [row[names[0]] for row in rows]
    place = f"tables/{number}"
    if place not in file:
        group = file.create_group(place)
        group.attrs["title"] = table["title"]
        group.create_dataset("row", data=np.array(labels, h5py.string_dtype())).make_scale("row")
        for name in names:
            data = np.full((len(file["case"]), len(rows)), np.nan)
            made = _on(file, f"{place}/{_safe(name)}", data)
            made.dims[1].attach_scale(group["row"])
    group = file[place]
    if len(group["row"]) != len(rows) or any(_safe(name) not in group for name in names):
        return f"table {number} has {len(rows)} rows, {len(group['row'])} in the first case; it is left out"
    for name in names:
        group[_safe(name)][case] = [_number(row[name]) for row in rows]
    return ""


def _store_array(file, name, case, axes, unit, array):
    """An array into its dataset; says why where it has another shape than the first case's"""
    place = f"results/{name}"
    data = file.get(place)
    if data is None:
        array = array.astype(complex if array.dtype.kind == "c" else float)
        nothing = array.dtype.type(np.nan)
        shape = len(file["case"]), *array.shape
        data = file.create_dataset(place, shape, array.dtype, fillvalue=nothing, chunks=(1, *array.shape))
        data.attrs["units"] = unit
        for number, (axis, size) in enumerate(zip(("case", *axes), data.shape, strict=True)):
            data.dims[number].attach_scale(file["case"] if axis == "case" else _axis(file, axis, size))
    if data.shape[1:] != array.shape:
        return f"{name} has the shape {array.shape}, {data.shape[1:]} in the first case; it is left out"
    data[case] = array
    return ""


def _axis(file, axis, size):
    """The scale of an axis: labels of degrees of freedom, or numbers from 0"""
    place = f"results/{axis}"
    if place not in file:
        labels = {"drift_dof": DRIFT_DOFS, "xyz": ("x", "y", "z")}.get(axis, DOFS if axis.endswith("_dof") else None)
        data = np.arange(size) if labels is None else np.array(labels, h5py.string_dtype())
        file.create_dataset(place, data=data).make_scale(axis)
    return file[place]


def _safe(name):
    return name.strip().replace("/", " per ") or "label"


def _number(cell):
    """A number of a table, or of its text; NaN of what is none"""
    try:
        return float(cell.replace("−", "-") if isinstance(cell, str) else np.nan if cell is None else cell)
    except ValueError:
        return np.nan
