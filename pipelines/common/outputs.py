"""Where a result may be written: in a folder that is there, over a result of the same kind, over nothing else."""

from __future__ import annotations

import os
from pathlib import Path

from hakobune.bem.database.file import check_place

DATABASE = (".h5", ".hdf5")


def check_ending(path, endings):
    """Raise ValueError unless the name of a result ends in a way that says what is in it."""
    path = Path(path)
    if path.suffix.lower() not in endings:
        has = f"the suffix {path.suffix!r}" if path.suffix else "no suffix"
        raise ValueError(f"{path} has {has}; allowed: {', '.join(endings)}")


def check_output(path, kind, is_one, endings, inputs=()):
    """Raise ValueError unless a file can be made under this name and no other is lost; before any work for it.

    kind : what may be replaced, "the result of a study"; is_one : tells of a path whether such a file is there
    endings : of the name, that are allowed; inputs : paths of files that are read; path : None where none is asked for
    """
    if path is None:
        return
    path = Path(path)
    for given in map(Path, inputs):
        if path.exists() and given.exists() and path.samefile(given):
            raise ValueError(f"{path} is an input of the study; give another name")
    check_place(path)
    if path.is_file() and not is_one(path):
        raise ValueError(f"{path} is not {kind}, so it is not replaced; give another name")
    check_ending(path, endings)


def check_folder(path):
    """Raise ValueError unless files can be made in this folder, or in one that is made under this name."""
    path = Path(path)
    there = next((place for place in (path, *path.parents) if place.exists()), path)
    if not there.is_dir():
        raise ValueError(f"{path} cannot be written: {there} is not a folder")
    if not os.access(there, os.W_OK):
        raise ValueError(f"{path} cannot be written: no permission in {there}")


def opening(path):
    """First line of a text file and its first line without # before it, the names of columns; "" where it is no text"""
    try:
        with Path(path).open(encoding="utf-8") as file:
            first = line = file.readline()
            while line.startswith("#"):
                line = file.readline()
    except (OSError, UnicodeDecodeError):
        return "", ""
    return first.rstrip("\n"), line.rstrip("\n")
