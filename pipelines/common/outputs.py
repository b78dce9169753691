"""Checks of where a result may be written: in an existing folder, as a new file or over a result of its kind."""

import os
from pathlib import Path

from hakobune.bem.database.file import check_place

DATABASE = (".h5", ".hdf5")


def check_ending(path, endings):
    """Raise ValueError unless the ending of a result's name gives its format."""
    path = Path(path)
    if path.suffix.lower() not in endings:
        has = f"the suffix {path.suffix!r}" if path.suffix else "no suffix"
        raise ValueError(f"{path} has {has}; allowed suffixes: {', '.join(endings)}")


def check_output(path, kind, is_one, endings, inputs=()):
    """Raise ValueError unless a file can be made under this name and no other file is lost; called before any work for
    the file.

    kind : content that may be replaced, such as "the result of a study"; is_one : function that tells whether a path
        has this content
    endings : allowed endings of the name; inputs : paths of files that are read; path : None for no output
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
    """Raise ValueError unless files can be made in this folder, or in a new one under this name."""
    path = Path(path)
    there = next((place for place in (path, *path.parents) if place.exists()), path)
    if not there.is_dir():
        raise ValueError(f"{path} cannot be written: {there} is not a folder")
    if not os.access(there, os.W_OK):
        raise ValueError(f"{path} cannot be written: no permission in {there}")


def opening(path):
    """First line of a text file, and its first line without #, which has the column names; "" for any other file"""
    try:
        with Path(path).open(encoding="utf-8") as file:
            first = line = file.readline()
            while line.startswith("#"):
                line = file.readline()
    except (OSError, UnicodeDecodeError):
        return "", ""
    return first.rstrip("\n"), line.rstrip("\n")
