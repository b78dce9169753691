"""`hakobune check` of a result: is the file still what was written, and is the database it was made with still that."""

from __future__ import annotations

import hashlib
from pathlib import Path

from hakobune.bem.database import DatabaseError
from hakobune.bem.database.results import OURS, named, schema_of
from hakobune.meshing.seals import REMEDY, is_sealed, kind_filled_in, text_sealed
from hakobune.meshing.text_files import read_text
from hakobune.mooring.criteria.failing import fails

TEXT = (".csv",)


def is_result(path):
    """Whether a file is the result of a study, by its name or by what is in it"""
    if path.suffix.lower() in TEXT:
        return True
    return not kind_filled_in(path) if is_sealed(path) else schema_of(path).startswith(OURS)


def check_result(path, say, repair=False):
    """Say what a result is and whether it is whole; returns 0 if it is, else 1.

    say : takes each line; repair : raise DatabaseError, results are not repaired
    raises : ValueError where there is no file
    """
    if repair:
        raise DatabaseError(f"{path} is a result, and no database that can be repaired; if it is damaged: {REMEDY}")
    try:
        what, sealed = _found(path)
    except ValueError as damage:
        if not path.is_file():
            raise
        say(fails(str(damage)))
        return 1
    if not sealed:
        say(fails(f"{path}: a {what} without a checksum: nothing tells whether it is what was written; make it anew"))
        return 1
    say(f"{path}: a {what}, as it was written")
    for remark in () if path.suffix.lower() in TEXT else _remarks(path):
        say(f"warning: {remark}")
    return 0


def _found(path):
    """What a result is, and whether it has a seal.  Raises ValueError for one that is damaged."""
    if path.suffix.lower() in TEXT:
        return "table", text_sealed(read_text(path))
    return named(schema_of(path)), is_sealed(path)


def _remarks(path):
    """What became of the database of a result"""
    import h5py

    with h5py.File(path) as file:
        source, made_with = file.attrs.get("database"), file.attrs.get("database_sha256")
    if source is None or made_with is None:
        return
    if not Path(source).is_file():
        yield f"the database it was made with, {source}, is not there"
    elif _sha256(source) != made_with:
        yield f"the database it was made with, {source}, has changed since; run the command of the result again"


def _sha256(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
