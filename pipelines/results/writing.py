"""The HDF5 file of a result: one schema for all kinds of results, with a seal; xarray reads it.

Datasets have the names of quantities and of axes, with dimension scales, units and long_name. Attributes of the file
are its kind, findings, notes and provenance.
"""

import json

from hakobune.bem.database.file import beside
from hakobune.bem.database.results import OURS, RESULT_VERSION, named, schema_of

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
    """Write a result whole.  Raises `meshing.whole_files.NotWritten` if it cannot be written to the disk."""
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
