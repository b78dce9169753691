"""The results of a sweep: one HDF5 file that is filled case by case and survives a kill at any instant.

/keys/NAME (case,); /status (case,): −1 to do, else the status of the command; /message (case,); /results/NAME (case,
…): the quantities of each case's result, or the arrays of its database, with all their digits, their axes and units.
The
status is written last.
"""

import json

import h5py
import numpy as np

from hakobune.bem import __version__
from hakobune.bem.database.file import unlocked
from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.database.results import check_version, named
from hakobune.mooring.criteria.failing import fails

from ..results.quantity import Quantity
from ..results.result import Result, labels

SCHEMA = "hakobune sweep 2"
PENDING = -1
SIZE = 200  # largest size of a quantity that a sweep keeps by default


def is_sweep(path):
    """Whether a file is the result of a sweep"""
    if not (path.is_file() and h5py.is_hdf5(path)):
        return False
    with h5py.File(path) as file:
        return named(str(file.attrs.get("schema", ""))) == named(SCHEMA)


def create(path, keys, values, texts):
    """Make the file with every case pending; texts : {name: text} of sweep and study, kept as attributes"""
    with unlocked(path, "w") as file:
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
    """Number of cases of a sweep"""
    with unlocked(path) as file:
        return len(file["status"])


def pending(path):
    """Numbers of the cases still to do"""
    with unlocked(path) as file:
        return np.flatnonzero(file["status"][()] == PENDING).tolist()


def store(path, results):
    """Store results of cases, then their status; the file is opened once for all cases.

    results : [(case, status, message, quantities, labels)], {name: `Quantity`} and {axis: its `Quantity` of labels}
    """
    with unlocked(path, "r+") as file:
        for case, _, message, quantities, axes in results:
            for name, one in quantities.items():
                message = _store(file, name, case, one, axes) or message
            file["message"][case] = message
        file.flush()
        for case, status, *_ in results:
            file["status"][case] = status


def _store(file, name, case, one, axes):
    """Store a quantity in its dataset; reports another shape or other labels than the first case's"""
    place = f"results/{name}"
    data = file.get(place)
    if data is None:
        data = _made(file, place, one, axes)
    if data.shape[1:] != one.values.shape:
        return (
            f"{name} has the shape {one.values.shape} here and {data.shape[1:]} in the first case, so it is not stored"
        )
    data[case] = one.values.astype(object) if one.values.dtype.kind == "U" else one.values
    return ""


def _made(file, place, one, axes):
    """A dataset for all cases"""
    text, values = one.values.dtype.kind == "U", one.values
    kind = h5py.string_dtype() if text else complex if values.dtype.kind == "c" else float
    nothing = None if text else np.dtype(kind).type(np.nan)
    chunks = (1, *values.shape) if values.size else None
    data = file.create_dataset(place, (len(file["case"]), *values.shape), kind, fillvalue=nothing, chunks=chunks)
    mixed = isinstance(one.unit, tuple)
    data.attrs.update(units=", ".join(one.unit) if mixed else one.unit, mixed_units=mixed, share=one.share)
    data.attrs.update(long_name=one.description, axes=json.dumps(one.axes))
    data.dims[0].attach_scale(file["case"])
    for number, (axis, size) in enumerate(zip(one.axes, values.shape, strict=True), 1):
        data.dims[number].attach_scale(_axis(file, axis, size, axes.get(axis)))
    return data


def _axis(file, axis, size, one):
    """The scale of an axis: its labels, or numbers from 0"""
    place = f"results/axes/{axis}"
    if place not in file:
        values = np.arange(size) if one is None or len(one.values) != size else one.values
        text = values.dtype.kind == "U"
        data = file.create_dataset(place, data=values.astype(object) if text else values,
                                   dtype=h5py.string_dtype() if text else None)  # fmt: skip
        data.make_scale(axis)
        data.attrs.update(units=getattr(one, "unit", ""), long_name=getattr(one, "description", axis))
    return file[place]


def result_of(path):
    """Result of a sweep: its keys and the quantities of each case.  Raises DatabaseError."""
    if not is_sweep(path):
        raise DatabaseError(f"{path} is not the result of a sweep")
    with unlocked(path) as file:
        check_version(path, SCHEMA, str(file.attrs["schema"]))
        quantities = {f"keys.{name}": _read(file["keys"][name], ("case",), name) for name in file["keys"]}
        quantities["status"] = _read(file["status"], ("case",), "status")
        found, axes = file.get("results", {}), dict(labels("case", file["case"][()]))
        for name, data in found.items():
            if isinstance(data, h5py.Dataset):
                quantities[name] = _read(data, ("case", *json.loads(data.attrs["axes"])))
        for axis, data in found.get("axes", {}).items():
            axes[axis] = _read(data, (axis,), axis)
        told = file["message"].asstr()[()]
        study = {name: str(file.attrs[name]) for name in ("sweep", "study")}
    lines = tuple(
        fails(f"case {number}: {line}") if status > 0 else f"case {number}: {line}"
        for number, (line, status) in enumerate(zip(told, quantities["status"].values, strict=True))
        if line
    )
    used = {axis for one in quantities.values() for axis in one.axes}
    return Result("sweep", quantities, {axis: one for axis, one in axes.items() if axis in used}, lines,
                  provenance=study)  # fmt: skip


def _read(data, axes, words=""):
    values = data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
    unit = str(data.attrs.get("units", ""))
    described = str(data.attrs.get("long_name", words))
    return Quantity(np.asarray(values), axes, unit, described, "cases", bool(data.attrs.get("share", False)))
