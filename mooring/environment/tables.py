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
    text = read_text(path, TableError)
    lines = [line for line in text.splitlines() if _has_data(line)]
    if not lines:
        raise TableError(f"{path} has no rows")
    names = None if _is_number(_split(lines[0])[0]) else _split(lines.pop(0))
    if not lines:
        raise TableError(f"{path} has no rows of numbers")
    width = len(names or _split(lines[0]))
    values = _all_numbers(lines, width)
    return names, _row_by_row(path, text, names is not None, width, blank) if values is None else values


def _all_numbers(lines, width):
    """(n, m) values of rows that are all separated alike, ten times as fast as row by row; None of others"""
    mark = next((mark for mark in (";", ",") if mark in lines[0]), None)
    try:
        values = np.loadtxt(lines, delimiter=mark, comments=None, ndmin=2)
    except ValueError:
        return None
    return values if values.shape == (len(lines), width) and np.all(np.isfinite(values)) else None


def _row_by_row(path, text, named, width, blank):
    """(n, m) values of a text, the first line with data left out if `named`; TableError for the first that is wrong"""
    values, rows = [], ((number, line) for number, line in enumerate(text.splitlines(), 1) if _has_data(line))
    if named:
        next(rows)
    for number, line in rows:
        row = _split(line)
        if len(row) != width:
            raise TableError(f"{path}: line {number} has {len(row)} columns; allowed: {width}, as the first")
        values.append([_number(path, number, word, blank) for word in row])
    return np.array(values)


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
