"""Results of studies in HDF5: written whole and sealed (`meshing.seals`), read only if unchanged.

The attribute `schema` of a result is "hakobune", the kind of result, and a version; databases have no such attribute.
"""

import contextlib
import mmap
import os
import re
import struct
from pathlib import Path

import h5py
import numpy as np

from hakobune.meshing import seals

from .integrity import DamagedError, DatabaseError, VersionError
from .schema import FORMAT, SCHEMA_VERSION

OURS = "hakobune "
MAKES = {  # commands, by their results
    FORMAT: "solve SCENE --output {} --fresh",
    "mooring study": "moor STUDY --database DATABASE --output {}",
    "response study": "response STUDY --database DATABASE --output {}",
    "simulation": "simulate STUDY --database DATABASE --output {} --fresh",
    "single point": "single-point STUDY --output {}",
    "breakwater study": "breakwater STUDY --output {}",
    "sections": "sections --output {}",
    "channels": "line-dynamics STUDY --output {}",
    "sweep": "sweep SWEEP --output {} --fresh",
}
COMMAND = "{} STUDY --output {}"  # command of results named after their command
RESULT_VERSION = 2  # version of the common schema of result files (version 1: one schema per command)
READS = {kind: RESULT_VERSION for kind in MAKES if kind != FORMAT}  # version that is read
# the name of the attribute, its type and its space as HDF5 writes them, and the number
NUMBER = re.compile(rb"schema_version\0.{25}(.{8})", re.DOTALL)
HIGHEST = 1000  # highest plausible version; a higher number is damage
STATUS = (
    20,
    4,
)  # first byte and length of the flags in a superblock that change while a file is open or its writer killed


def seal_of(file, image, later=()):
    """The seal of an open HDF5 file, a block that stands before the image of the file
    later : names of datasets and groups that are filled in later"""
    places, filled, first = {}, [STATUS] if later else [], file.userblock_size
    for name, item in _datasets(file).items():
        if item.id.get_offset() is not None:
            place = item.id.get_offset() - first, item.id.get_storage_size()
            if name in later or name.partition("/")[0] in later:
                filled.append(place)
            else:
                places[name] = place
    kind = file.attrs.get("schema", file.attrs.get("format", ""))
    return seals.hdf5_seal(image, places, filled, kind, first or seals.LEAST_BLOCK)


def _datasets(group, within=""):
    """{name: dataset} of a group and of all groups in it"""
    found = {}
    for name, item in group.items():
        found |= {within + name: item} if isinstance(item, h5py.Dataset) else _datasets(item, f"{within}{name}/")
    return found


def check_seal(path, remedy=seals.REMEDY):
    """Raises DamagedError with the name of the damaged part if a file differs from its seal; a file without a seal
    passes."""
    try:
        damaged = seals.damage(path)
    except OSError as error:
        raise DatabaseError(f"{path} cannot be read: {os.strerror(error.errno)}") from None
    if damaged:
        raise DamagedError(f"{path} is damaged: {damaged}, by its checksum; {remedy}")


def check_any_version(path, found=None):
    """Raise VersionError for a result or database with another version; found : attribute `schema` of the file, or
    None"""
    for kind, version in READS.items():
        check_version(path, f"{OURS}{kind} {version}", found)
    if found is None:
        check_database_version(path)


def has_schema(path, schema):
    """Whether a file is HDF5 of this kind, of any version; raises DatabaseError for a broken seal"""
    return named(schema_of(path)) == named(schema)


def check_version(path, schema, found=None):
    """Raise VersionError for a file of the kind `schema` with another version, even if its checksum is wrong.

    found : attribute `schema` of the file; None to search its bytes, because HDF5 may fail on a damaged file
    """
    kind, version = named(schema), schema.rsplit(" ", 1)[1]
    if found is None:
        pattern = re.compile(re.escape(OURS + kind).encode() + rb" (\d{1,3})(?!\d)")
        others = [part.decode() for part in _numbers(path, pattern)]
    else:
        others = [found.rsplit(" ", 1)[1]] if named(found) == kind else []
    others = [other for other in others if other != version]
    if others:
        raise VersionError(another_version(path, f"a file of {kind}", others[-1], version, MAKES.get(kind)))


def check_database_version(path, found=None):
    """Raise VersionError for a database with another version; found : its version number; None to search the bytes"""
    if found is None:
        found = [struct.unpack("<q", part)[0] for part in _numbers(path, NUMBER)]
        found = [one for one in found if 0 <= one <= HIGHEST and one != SCHEMA_VERSION][-1:]
    for one in (one for one in np.atleast_1d(found) if one != SCHEMA_VERSION):
        raise VersionError(another_version(path, "a database", one, SCHEMA_VERSION, MAKES[FORMAT]))


def another_version(path, what, found, ours, makes):
    """Message about a file with another version of its schema"""
    again = f"make it again by 'hakobune {makes.format(path)}'" if makes else "make it again"
    return (
        f"{path} is {what} of schema version {found}, and this program reads version {ours}; {again}, or "
        f"read it with the program that wrote it"
    )


def _numbers(path, pattern):
    """Groups of a pattern of bytes at every match in a file; [] for an unreadable file"""
    try:
        with Path(path).open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as image:
            found = [match[1] for match in pattern.finditer(image)]
    except (OSError, ValueError):  # an empty file cannot be mapped
        return []
    return found


def schema_of(path):
    """The attribute `schema` of a file; "" where the file or the attribute is missing

    raises : DamagedError for a broken seal; VersionError if this file may be an intact file of another version
    """
    if not Path(path).is_file():
        return ""
    try:
        check_seal(path)
    except DamagedError:
        check_any_version(path)
        raise
    try:
        with h5py.File(path) as file:
            return str(file.attrs.get("schema", ""))
    except (OSError, RuntimeError):
        return ""


@contextlib.contextmanager
def opened_result(path, schema):
    """The open HDF5 file of a result with this `schema`.  Raises DatabaseError for another kind of file and for a
    broken seal."""
    path = Path(path)
    if not path.exists():
        raise DatabaseError(f"{path} does not exist")
    found = schema_of(path)
    check_version(path, schema, found or None)
    if found != schema:
        raise DatabaseError(no_file_of(path, schema))
    with h5py.File(path) as file:
        yield file


def named(schema):
    """The kind of a file with this `schema`: "hakobune mooring study 1" → "mooring study" """
    return schema.removeprefix(OURS).rsplit(" ", 1)[0]


def file_of(schema):
    """ "hakobune mooring study 1" → "a file of mooring study" """
    return f"a file of {named(schema)}"


def what_is(file):
    """Kind of an open HDF5 file, in words"""
    schema = str(file.attrs.get("schema", ""))
    if schema.startswith(OURS):
        return file_of(schema)
    return "a hakobune database" if file.attrs.get("format") == FORMAT else "an HDF5 file of another program"


def no_file_of(path, schema):
    """Message about a file without the wanted `schema`, with the command that makes such files"""
    kind = named(schema)
    try:
        with h5py.File(path) as file:
            what = f"{what_is(file)}, and not {file_of(schema)}"
    except (OSError, RuntimeError):
        what = f"neither a file of {kind} nor a readable HDF5 file"
    makes = MAKES.get(kind, COMMAND.format(kind, "{}")).format("NAME.h5").removesuffix(" --fresh")
    return f"{path} is {what}; 'hakobune {makes}' writes the right one"
