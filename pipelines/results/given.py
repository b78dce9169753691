"""The argument of a study function: the path of a file, its tables as a dictionary, or the typed study itself."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from ..common.typed import to_toml, without_none

if TYPE_CHECKING:
    from hakobune.bem.database import Database

File = str | os.PathLike[str]
Tables = dict[str, Any]  # nested, as read from TOML
Typed = TypeVar("Typed")


def given(
    study: File | Tables | Typed,
    kind: type[Typed],
    read: Callable[[File], tuple[Typed, str]] | None,
    make: Callable[[Tables], Typed],
) -> tuple[Typed, str]:
    """(typed study, its text) from a path, a dictionary or a typed study.

    kind : class of the typed study; read : function path → (study, text), None if there are no such files
    make : nested dictionaries → study
    raises : ValueError, with a message of one line, from `read` and `make`; TypeError for any other argument
    """
    if isinstance(study, kind):
        return study, to_toml(study)
    if isinstance(study, dict):
        import tomli_w

        return make(study), tomli_w.dumps(study)
    if read and isinstance(study, str | os.PathLike):
        return read(study)
    allowed = f"{'a path, ' if read else ''}a dictionary or {kind.__name__}"
    raise TypeError(f"the study is of type {type(study).__name__}; allowed: {allowed}")


def words_of(**words) -> str:
    """TOML of the arguments of a study function that has no file, without default values"""
    import tomli_w

    return tomli_w.dumps(without_none(words))


def database_of(database: File | Database) -> Database:
    """An open database from a path, or the open database that was given"""
    from hakobune.bem.database import open_database

    return open_database(database) if isinstance(database, str | os.PathLike) else database
