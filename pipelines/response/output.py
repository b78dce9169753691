"""Files of a response: the table as CSV, everything as HDF5 in SI units."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from hakobune.bem.database.results import has_schema
from hakobune.meshing.seals import write_sealed

from ..common.outputs import opening

SCHEMA = "hakobune response study 1"


def write_csv(path, rows, notes):
    """Write Rows with `notes` before them in # lines."""
    lines = [f"# {line}" for line in notes] + [",".join(("response", "unit", *rows.columns))]
    for name, unit, values in zip(rows.names, rows.units, rows.values, strict=True):
        lines.append(",".join([name, unit, *(f"{value:.6g}" for value in values)]))
    write_sealed(path, "\n".join(lines) + "\n")


def write_h5(path, result, rows, text, database, warned, more):
    """Write a SeaState or a Climate with the table of Rows; more : {name: (value, unit)} beside them."""
    import h5py

    from hakobune.bem.database.file import beside

    with beside(path) as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["study"] = text
        file.attrs["database"] = str(database)
        file.attrs["database_sha256"] = hashlib.sha256(Path(database).read_bytes()).hexdigest()
        file.attrs["warnings"] = "\n".join(warned)
        for name, words in (("names", result.names), ("units", result.units)):
            file.create_dataset(f"response/{name}", data=words, dtype=h5py.string_dtype())
        for name, (value, unit) in (_values(result) | more).items():
            file.create_dataset(name, data=np.asarray(value, float)).attrs["units"] = unit
        table = file.create_dataset("table", data=rows.values)
        table.attrs["columns"], table.attrs["rows"] = list(rows.columns), rows.names
        table.attrs["units"] = rows.units


def is_response(path):
    """Whether a file was written here"""
    if path.suffix == ".csv":
        return opening(path)[1].startswith("response,unit,")
    return has_schema(path, SCHEMA)


def _values(result):
    """{name: (value, unit)}"""
    return _climate_values(result) if hasattr(result, "probability") else _sea_values(result)


def _sea_values(result):
    values = {
        "omega": (result.omega, "rad/s"),
        "wave_spectrum": (result.sea.spectrum.density(result.omega), "m2 s/rad"),
        "response/spectrum": (result.spectrum, "unit2 s/rad"),
    }
    for n, moment in zip((0, 1, 2, 4), result.moments, strict=True):
        values[f"response/m{n}"] = (moment, f"unit2 (rad/s){n}")
    slow = result.slow
    if slow is not None:
        values["drift/mean"] = (slow.drift, "N, N, N m")
        values["drift/mean_beyond_stored_frequencies"] = (slow.beyond, "N, N, N m")
        values["drift/difference"] = (slow.difference, "rad/s")
        values["drift/spectrum"] = (slow.spectrum, "N2 s/rad, N2 s/rad, N2 m2 s/rad")
        if slow.of_pairs is not None:
            unit = ", ".join(["N2 s/rad"] * 3 + ["N2 m2 s/rad"] * 3)
            values["drift/spectrum_qtf"] = (slow.of_pairs, unit)
        if slow.damping is not None:
            values["drift/damping"] = (slow.damping, "N s/m, N s/m, N s")
    return values


def _climate_values(result):
    values = {
        "state/height": (result.height, "m"),
        "state/period": (result.period, "s"),
        "state/direction": (result.direction, "rad"),
        "state/probability": (result.probability, "1"),
        "response/m0": (result.m0, "unit2"),
        "response/m2": (result.m2, "unit2 (rad/s)2"),
    }
    if result.drift is not None:
        values["state/drift"] = (result.drift, "N, N, N m")
    return values
