"""`hakobune check`: whether a result or database is unchanged, and whether a database obeys the laws of physics."""

import hashlib
import json
from functools import partial
from pathlib import Path

from hakobune.bem.database import DatabaseError
from hakobune.bem.database.integrity import VersionError
from hakobune.bem.database.results import OURS, check_any_version, file_of, schema_of
from hakobune.meshing.seals import REMEDY, is_sealed, kind_filled_in, text_sealed
from hakobune.meshing.text_files import read_text
from hakobune.mooring.criteria.failing import fails

from .simulate.checking import check_run
from .simulate.file import is_run
from .solve.checking import check as check_database
from .sweep.file import SCHEMA as SWEEP
from .sweep.file import case_count, pending

TEXT = (".csv",)


def check(path, console, repair=False):
    """Print whether a result is intact, or the checks and findings of a database; 0 if nothing fails, else 1.

    repair : mark damaged parts of a database as unsolved first
    raises : ValueError for a file that is neither a result nor a database
    """
    say = partial(console.print, highlight=False, markup=False, soft_wrap=True)
    if is_run(path) and not repair:
        return check_run(path, say)
    return check_result(path, say, repair) if is_result(path) else check_database(path, console, repair)


def is_result(path):
    """Whether a file is the result of a study, judged by its name or its content"""
    if path.suffix.lower() in TEXT:
        return True
    return not kind_filled_in(path) if is_sealed(path) else schema_of(path).startswith(OURS)


def check_result(path, say, repair=False):
    """Report the kind of a result and whether it is intact; returns 0 if it is, else 1.

    say : function that is called with each line; repair : raises DatabaseError, because results cannot be repaired
    raises : ValueError for a missing file, and for one of an unknown version of its schema
    """
    if repair:
        raise DatabaseError(f"{path} is a result, and only a database can be repaired; if it is damaged: {REMEDY}")
    try:
        what, sealed = _found(path)
    except VersionError:
        raise
    except ValueError as damage:
        if not path.is_file():
            raise
        say(fails(str(damage)))
        return 1
    if what == file_of(SWEEP):
        return _check_sweep(path, say)
    if not sealed:
        say(fails(f"{path}: {what} without a checksum, so changes cannot be detected; run the command again"))
        return 1
    say(f"{path}: {what}, unchanged since it was written")
    for remark in () if path.suffix.lower() in TEXT else _remarks(path):
        say(f"warning: {remark}")
    return 0


def _found(path):
    """Kind of a result, and whether it has a seal.  Raises ValueError for a damaged one, or one of another version."""
    if path.suffix.lower() in TEXT:
        return "a table", text_sealed(read_text(path))
    schema = schema_of(path)
    check_any_version(path, schema)
    return file_of(schema), is_sealed(path)


def _check_sweep(path, say):
    """Which cases of a sweep are complete: a sweep is filled case by case, and has no checksums"""
    count, missing = case_count(path), len(pending(path))
    say(f"{path}: a file of a sweep; {count - missing} of {count} cases are stored; a sweep has no checksums")
    if missing:
        say(fails(f"{missing} cases are missing; 'hakobune sweep SWEEP --output {path}' runs them"))
    return int(bool(missing))


def _remarks(path):
    """Remarks on the present state of a result's database"""
    import h5py

    with h5py.File(path) as file:
        origin = json.loads(file.attrs.get("provenance", "{}"))
    source, made_with = origin.get("database"), origin.get("database_sha256")
    if source is None or made_with is None:
        return
    if not Path(source).is_file():
        yield f"the database it was made with, {source}, does not exist"
    elif _sha256(source) != made_with:
        yield f"the database it was made with, {source}, has changed since; run the command of the result again"


def _sha256(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
