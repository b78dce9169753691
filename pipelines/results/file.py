"""Reading the HDF5 file of a result (`writing`)."""

import json

import numpy as np

from hakobune.bem.database.integrity import DatabaseError
from hakobune.bem.database.results import opened_result

from .quantity import Quantity
from .result import Result
from .writing import LINES, kind_of, schema


def read(path, kind=None):
    """The Result of a file; kind : required kind, None for any.  Raises DatabaseError."""
    kind = kind or kind_of(path)
    if not kind:
        raise DatabaseError(f"{path} is not a result file")
    with opened_result(path, schema(kind)) as file:
        if "quantities" not in file.attrs:
            raise DatabaseError(f"{path} is a sweep, which is filled case by case; read it with hakobune.read")
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
