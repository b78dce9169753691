"""Tables of numbers from text files: lines with `#` are comments, the first row may contain names and units.

Where semicolons separate columns a comma is a decimal mark, as in files of loggers.
"""

import re
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import is_number, read_text


class TableError(ValueError):
    """A file cannot be read as a table; the message names the file, the place and the allowed values."""


def read_table(path, blank=None):
    """Names (a list, or None) and values (n, m) of a file with columns separated by commas, semicolons or blanks.

    blank : value of an empty place; None allows none
    Raises TableError.
    """
    path = Path(path)
    text = read_text(path, TableError)
    text = _decimal_points(text)
    lines = [line for line in text.splitlines() if _has_data(line)]
    if not lines:
        raise TableError(f"{path} has no rows; give rows of numbers")
    names = None if is_number(_split(lines[0])[0]) else _split(lines.pop(0))
    if not lines:
        raise TableError(f"{path} has no rows of numbers")
    width = len(names or _split(lines[0]))
    values = _all_numbers(lines, width)
    return names, _row_by_row(path, text, names is not None, width, blank) if values is None else values


def _decimal_points(text):
    """A text with decimal commas, between two digits, replaced by points, where semicolons separate its columns"""
    first = next((line for line in text.splitlines() if _has_data(line) and not line.strip()[0].isalpha()), "")
    return re.sub(r"(?<=\d),(?=\d)", ".", text) if ";" in first else text


COARSEST, ROUNDED = 0.25, 0.6  # last digit of times over a step; what rounding leaves, over the last digit, with room
UNITS = {  # size of units, in m and s
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "dm": 0.1, "km": 1e3, "ft": 0.3048, "in": 0.0254, "feet": 0.3048},
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "hr": 3600.0, "hours": 3600.0, "seconds": 1.0},
}


def unit_of(path, name, kind):
    """Size in m or s of the unit at the end of a column name, "eta (mm)", "Time [ms]", "eta_cm"; 1 without a unit

    kind : "length" or "time".  Raises TableError for an unknown unit in brackets.
    """
    known = UNITS[kind]
    bracket = re.search(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$", name)
    if bracket and bracket[1]:
        if bracket[1] not in known:
            raise TableError(f"{path}: column {name!r} has the unit {bracket[1]!r}; allowed: {', '.join(known)}")
        return known[bracket[1]]
    ending = re.search(r"[_ ,/]\s*([A-Za-z]+)\s*$", name)
    return known.get(ending[1], 1.0) if ending else 1.0


def _all_numbers(lines, width):
    """Values of rows with one kind of separator, ten times as fast as row by row; shape (n, m); None for others"""
    mark = next((mark for mark in (";", ",") if mark in lines[0]), None)
    try:
        values = np.loadtxt(lines, delimiter=mark, comments=None, ndmin=2)
    except ValueError:
        return None
    return values if values.shape == (len(lines), width) and np.all(np.isfinite(values)) else None


def _row_by_row(path, text, named, width, blank):
    """Values of a text, without the first line of data if `named`; shape (n, m).  Raises TableError for the first wrong
    value."""
    values, rows = [], ((number, line) for number, line in enumerate(text.splitlines(), 1) if _has_data(line))
    if named:
        next(rows)
    for number, line in rows:
        row = _split(line)
        if len(row) != width:
            raise TableError(f"{path}: line {number} has {len(row)} columns; allowed: {width}, as in the first line")
        values.append([_number(path, number, word, blank) for word in row])
    return np.array(values)


def column_of(path, names, wanted):
    """Place of a named column.  Raises TableError."""
    if names is None:
        raise TableError(f"column is {wanted!r}, but {path} has no column names; leave column out")
    if wanted not in names:
        raise TableError(f"{path} has no column {wanted!r}; allowed: {', '.join(names)}")
    return names.index(wanted)


def without_rounding(time):
    """The evenly spaced times (n,) s from which the given times differ only by rounding in the file; if there are none,
    the given times

    0, 0.8, 1.6, 2.4, 3.3, … are steps of 0.814 s.  The last digit is at most a quarter of a step: no row is lost.
    """
    n = np.arange(len(time))
    if len(time) < 3 or not np.all(np.isfinite(time)) or np.ptp(np.diff(time)) <= 1e-9 * np.abs(time).max():
        return time
    step, start = np.polyfit(n, time, 1)
    digits = (10.0**-k for k in range(7))
    last = next((d for d in digits if np.all(np.abs(time / d - np.round(time / d)) < 1e-6)), 0.0)
    even = start + step * n
    return even if last <= COARSEST * step and np.abs(time - even).max() <= ROUNDED * last else time


def check_even(path, time, off):
    """Raise TableError where the times (n,) of a table have uneven steps; `off` is the tolerance over a step"""
    steps = np.diff(time)
    if len(steps) and not np.all(np.abs(steps - np.median(steps)) <= off * np.median(steps)):
        raise fault_of_steps(path, time, off)


def fault_of_steps(path, time, off, lines=None):
    """`TableError` for times (n,) of a table with steps uneven beyond `off` of a step: its line and a remedy

    lines : (n,) line numbers in the file, where `line_of` does not apply
    """
    steps = np.diff(time)
    usual = float(np.median(steps))
    falling, wrong = np.flatnonzero(steps <= 0), np.flatnonzero(np.abs(steps - usual) > off * abs(usual))
    i = int(falling[0]) if len(falling) else int(wrong[0]) if len(wrong) else int(np.argmax(np.abs(steps - usual)))
    line = line_of(path, i + 1) if lines is None else lines[i + 1]
    where, a, b = f"{path}: line {line}", time[i], time[i + 1]
    if len(falling):
        moved = f"stays at {a:g} s" if a == b else f"goes back from {a:.8g} to {b:.8g} s"
        return TableError(
            f"{where}: the time {moved}; allowed: increasing times at equal steps; sort the rows and remove duplicates"
        )
    told = f"{where}: the time goes from {a:.8g} to {b:.8g} s, and the step elsewhere is {usual:.6g} s"
    lost = [max(0, round(step / usual) - 1) for step in steps[wrong]]
    whole = np.abs(steps[wrong] - usual * (1 + np.array(lost))) <= max(off, 0.05) * usual
    if len(wrong) and np.all(whole) and min(lost) > 0:
        more = f", the first of {len(wrong)} gaps" if len(wrong) > 1 else ""
        count = f"{lost[0]} row is" if lost[0] == 1 else f"{lost[0]} rows are"
        return TableError(f"{told}: {count} missing{more}; allowed: equal steps; fill the gap, or cut the record there")
    return TableError(
        f"{told}, from {steps.min():.4g} to {steps.max():.4g} s in the file; allowed: equal steps; interpolate "
        f"to equal steps"
    )


def line_of(path, row):
    """Line number, from 1, in the file of a row of numbers, from 0, as read by `read_table`"""
    lines = [(n, line) for n, line in enumerate(read_text(Path(path), TableError).splitlines(), 1) if _has_data(line)]
    named = not is_number(_split(lines[0][1])[0])
    return lines[row + named][0]


def _has_data(line):
    return line.strip() and not line.lstrip().startswith("#")


def _split(line):
    line = line.strip()
    for mark in (";", ","):
        if mark in line:
            return [word.strip() for word in line.split(mark)]
    return re.split(r"\s+", line)


def _number(path, line, word, blank):
    if word == "" and blank is not None:
        return blank
    try:
        value = float(word)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise TableError(f"{path}: line {line} has {word!r}; allowed: finite numbers; fill in the value")
    return value
