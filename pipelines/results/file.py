"""The HDF5 file of a result: one schema for all kinds, sealed, which xarray reads.

Datasets have the names of quantities and of axes, with dimension scales, units and long_name; attributes of the file
are its kind, findings, notes and provenance.
"""

from __future__ import annotations

import json

import numpy as np

from hakobune.bem.database.file import beside
from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.database.results import OURS, RESULT_VERSION, check_version, named, opened_result, schema_of

from .quantity import Quantity
from .result import Result

LINES = ("findings", "notes", "first")
NAMES = {
    "moor": "mooring study",
    "response": "response study",
    "breakwater": "breakwater study",
    "line-dynamics": "channels",
    "single-point": "single point",
}


def schema(kind):
    """The attribute `schema` of the file of a kind of result"""
    return f"{OURS}{NAMES.get(kind, kind)} {RESULT_VERSION}"


def kind_of(path):
    """Kind of the result in a file, "" for another file"""
    named_so = {schema(kind): kind for kind in NAMES}
    found = schema_of(path)
    return named_so.get(found, named(found) if found.endswith(f" {RESULT_VERSION}") else "")


def write(result, path):
    """Write a result whole.  Raises `meshing.whole_files.NotWritten` where it does not arrive on the disk."""
    with beside(path) as file:
        file.attrs.update(schema=schema(result.kind), provenance=json.dumps(result.provenance))
        file.attrs.update({part: "\n".join(getattr(result, part)) for part in LINES})
        for name, one in result.labels.items():
            _put(file, name, one).make_scale(name)
        for name, one in result.quantities.items():
            data = _put(file, name, one)
            for place, axis in enumerate(one.axes):
                data.dims[place].attach_scale(file[axis])
        file.attrs["quantities"] = json.dumps(list(result.quantities))
        file.attrs["axes"] = json.dumps(list(result.labels))


def _put(file, name, one):
    import h5py

    text = one.values.dtype.kind in "US"
    values = one.values.astype(object) if text else one.values
    data = file.create_dataset(name, data=values, dtype=h5py.string_dtype() if text else None)
    data.attrs.update(long_name=one.description, table=one.table, share=one.share, record=one.record)
    mixed = isinstance(one.unit, tuple)
    data.attrs.update(units=", ".join(one.unit) if mixed else one.unit, mixed_units=mixed)
    data.attrs["axes"] = json.dumps(one.axes)
    return data


def read(path, kind=None):
    """The Result of a file; kind : that it has to be of, None for any.  Raises DatabaseError."""
    kind = kind or kind_of(path)
    if not kind:
        raise DatabaseError(f"{path} is no file of a result")
    check_version(path, schema(kind))
    with opened_result(path, schema(kind)) as file:
        if "quantities" not in file.attrs:
            raise DatabaseError(f"{path} fills case by case; hakobune.read reads it")
        names, axes = (json.loads(str(file.attrs[key])) for key in ("quantities", "axes"))
        lines = {key: tuple(filter(None, str(file.attrs[key]).split("\n"))) for key in LINES}
        return Result(
            kind, {name: _got(file[name]) for name in names}, {axis: _got(file[axis]) for axis in axes},
            provenance=json.loads(str(file.attrs["provenance"])), **lines,
        )  # fmt: skip


def _got(data):
    import h5py

    values = data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
    unit = str(data.attrs["units"])
    return Quantity(
        np.asarray(values), tuple(json.loads(data.attrs["axes"])),
        tuple(unit.split(", ")) if data.attrs["mixed_units"] else unit,
        str(data.attrs["long_name"]), str(data.attrs["table"]), bool(data.attrs["share"]), bool(data.attrs["record"]),
    )  # fmt: skip
