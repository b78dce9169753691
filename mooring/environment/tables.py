"""Tables of numbers from text files: lines with `#` are comments, the first row may hold names."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from meshing.text_files import read_text


class TableError(ValueError):
    """A file cannot be read as a table; one line names the file, the place and what is allowed."""


def read_table(path, blank=None):
    """Names (a list, or None) and values (n, m) of a file with columns separated by commas, semicolons or blanks.

    blank : value of an empty place; None allows none
    Raises TableError.
    """
    path = Path(path)
    rows = [
        (number, _split(line))
        for number, line in enumerate(read_text(path, TableError).splitlines(), 1)
        if _has_data(line)
    ]
    if not rows:
        raise TableError(f"{path} has no rows")
    names = None if _is_number(rows[0][1][0]) else rows.pop(0)[1]
    width = len(names or (rows[0][1] if rows else ()))
    for number, row in rows:
        if len(row) != width:
            raise TableError(f"{path}: line {number} has {len(row)} columns; allowed: {width}, as the first")
    if not rows:
        raise TableError(f"{path} has no rows of numbers")
    values = [[_number(path, number, word, blank) for word in row] for number, row in rows]
    return names, np.array(values)


def column_of(path, names, wanted):
    """Place of a named column.  Raises TableError."""
    if names is None:
        raise TableError(f"column is {wanted!r}, {path} has no names of columns; leave it out")
    if wanted not in names:
        raise TableError(f"{path} has no column {wanted!r}; allowed: {', '.join(names)}")
    return names.index(wanted)


def _has_data(line):
    return line.strip() and not line.lstrip().startswith("#")


def _split(line):
    line = line.strip()
    for mark in (";", ","):
        if mark in line:
            return [word.strip() for word in line.split(mark)]
    return re.split(r"\s+", line)


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def _number(path, line, word, blank):
    if word == "" and blank is not None:
        return blank
    try:
        value = float(word)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise TableError(f"{path}: line {line} has {word!r}; allowed: finite numbers")
    return value
