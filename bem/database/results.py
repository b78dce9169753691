"""Results of studies in HDF5: written whole and sealed (`meshing.seals`), read only if they are what was written.

Their attribute `schema` is "hakobune", what they are, and a version; databases have none.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import h5py

from meshing import seals

from .integrity import DatabaseError

OURS = "hakobune "


def seal_of(file, image):
    """The block before the image of an open HDF5 file"""
    places = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset) and item.id.get_offset() is not None:
            places[name] = item.id.get_offset(), item.id.get_storage_size()

    file.visititems(add)
    return seals.hdf5_seal(image, places)


def check_seal(path):
    """Raise DatabaseError, which names what is damaged, unless a file is what was sealed, or has no seal."""
    try:
        damaged = seals.damage(path)
    except OSError as error:
        raise DatabaseError(f"{path} cannot be read: {os.strerror(error.errno)}") from None
    if damaged:
        raise DatabaseError(f"{path} is damaged: {damaged}, by its checksum; {seals.REMEDY}")


def has_schema(path, schema):
    """Whether a file is HDF5 with this attribute `schema`; raises DatabaseError for one whose seal is broken"""
    return schema_of(path) == schema


def schema_of(path):
    """The attribute `schema` of a file, "" where there is no file, or another; raises as `check_seal`"""
    if not Path(path).is_file():
        return ""
    check_seal(path)
    try:
        with h5py.File(path) as file:
            return str(file.attrs.get("schema", ""))
    except (OSError, RuntimeError):
        return ""


@contextlib.contextmanager
def opened_result(path, schema):
    """The open HDF5 file of a result with this `schema`.  Raises DatabaseError, also for one whose seal is broken."""
    path = Path(path)
    if not path.exists():
        raise DatabaseError(f"{path} does not exist")
    if schema_of(path) != schema:
        raise DatabaseError(f"{path} is no file of {named(schema)}")
    with h5py.File(path) as file:
        yield file


def named(schema):
    """What a file with a `schema` is: "hakobune mooring study 1" → "mooring study" """
    return schema.removeprefix(OURS).rsplit(" ", 1)[0]
