"""The records of a result, as time series, in a file: CSV of all records on one axis, or HDF5 of the whole result."""

import csv
import io

import numpy as np

from hakobune.bem.database.results import has_schema
from hakobune.meshing.whole_files import write_whole

from ..common.outputs import DATABASE, check_output, opening
from .tables import columns_of
from .writing import schema


def check_records(path, kind, inputs=()):
    """Raise ValueError unless records of a `kind` of result can be written to a path.

    inputs : paths of the study's input files, none of which is overwritten
    """

    def is_one(place):
        return opening(place)[0] == _mark(kind) or has_schema(place, schema(kind))

    check_output(path, f"a course of {kind}", is_one, (".csv", *DATABASE), inputs)


def is_hdf5(path):
    """Whether a file of this name contains the whole result, not only records"""
    return path.suffix.lower() in DATABASE


def write_records(result, path):
    """Write the records in time, in SI, or the whole result for an HDF5 name."""
    if is_hdf5(path):
        result.write(path)
        return
    head = result.labels["time"]
    made = [("time", head.unit, head.values)]
    for name, one in result.quantities.items():
        if one.record and one.axes[:1] == ("time",):
            made += [(column.name, column.units[0], column.values) for column in columns_of(result, name, one)]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([f"{name} [{unit}]" if unit else name for name, unit, _ in made])
    writer.writerows(np.stack([values for _, _, values in made], axis=1).tolist())
    write_whole(path, f"{_mark(result.kind)}\n{out.getvalue()}".encode())


def _mark(kind):
    """The first line"""
    return f"# hakobune {kind}, records"
