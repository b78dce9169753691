"""Results of studies in HDF5: written whole and sealed (`meshing.seals`), read only if they are what was written.

Their attribute `schema` is "hakobune", what they are, and a version; databases have none.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import h5py

from meshing import seals

from .integrity import DamagedError, DatabaseError

OURS = "hakobune "
STATUS = (
    20,
    4,
)  # first byte and bytes of the flags in a superblock that change while a file is open or its writer killed


def seal_of(file, image, later=()):
    """The block before the image of an open HDF5 file; later : names of datasets and groups that are filled in later"""
    places, filled, first = {}, [STATUS] if later else [], file.userblock_size

    def add(name, item):
        if isinstance(item, h5py.Dataset) and item.id.get_offset() is not None:
            place = item.id.get_offset() - first, item.id.get_storage_size()
            if name in later or name.partition("/")[0] in later:
                filled.append(place)
            else:
                places[name] = place

    file.visititems(add)
    kind = file.attrs.get("schema", file.attrs.get("format", ""))
    return seals.hdf5_seal(image, places, filled, kind, first or seals.LEAST_BLOCK)


def check_seal(path, remedy=seals.REMEDY):
    """Raise DamagedError, which names what is damaged, unless a file is what was sealed, or has no seal."""
    try:
        damaged = seals.damage(path)
    except OSError as error:
        raise DatabaseError(f"{path} cannot be read: {os.strerror(error.errno)}") from None
    if damaged:
        raise DamagedError(f"{path} is damaged: {damaged}, by its checksum; {remedy}")


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
