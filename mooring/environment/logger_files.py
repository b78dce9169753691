"""Columns of numbers from loggers and programs: headers of several lines, a line of units, dates.

Columns are separated by ; , tab, : or blanks, as in the first row of numbers.  Where it does not separate, a comma is
the decimal mark and a point stands between thousands.  Lines of words above the numbers are headers: the last header
with as many columns as the numbers has the names, and a line of units below that header has the units of these names.
Dates, 2026-01-02 03:04:05.6 or 02.01.2026 03:04:05, are seconds from the first.  An empty place, NaN or "-" is a gap,
which counts only in a column that is used.
"""

import re
from datetime import datetime
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import read_text

from .tables import TableError

GAPS = ("", "nan", "na", "n/a", "-", "null", "none")
MARKS = (";", "\t", ",", " : ")
DATES = (r"(\d{4})-(\d\d)-(\d\d)", r"(?P<day>\d\d)\.(?P<month>\d\d)\.(?P<year>\d{4})")
CLOCK = r"[T ](\d\d):(\d\d):(\d\d(?:\.\d+)?)Z?"
UNIT = re.compile(r"[(\[].*[)\]]|-")


class Columns(NamedTuple):
    """names : list or None; values : (n, m), NaN at gaps; lines : (n,) line numbers in the file"""

    names: list | None
    values: np.ndarray
    lines: list


def read_columns(path):
    """`Columns` of a text file.  Raises TableError that names the line."""
    text = read_text(path, TableError)
    lines = [(k, line.strip("\r\n ")) for k, line in enumerate(text.splitlines(), 1)]
    lines = [(k, line) for k, line in lines if line.strip() and not line.lstrip().startswith("#")]
    first = next((i for i, (_, line) in enumerate(lines) if _is_value(_words(line, _mark(line))[0])), None)
    if first is None:
        raise TableError(f"{path} has no rows of numbers; allowed: column names, then rows of numbers")
    last = max(i for i, (_, line) in enumerate(lines) if _is_value(_words(line, _mark(line))[0]))
    mark = _mark(lines[first][1])
    rows = [(k, _words(line, mark)) for k, line in lines[first : last + 1]]
    width = len(rows[0][1])
    for k, words in rows:
        if len(words) != width:
            raise TableError(f"{path}: line {k} has {len(words)} columns; allowed: {width}, as in the first line")
    comma = mark != "," and any("," in word for _, words in rows for word in words if _seconds(word) is None)
    start = _seconds(rows[0][1][0])
    values = np.array([[_value(path, k, word, comma, start) for word in words] for k, words in rows])
    return Columns(_names(lines[:first], mark, width, start is not None), values, [k for k, _ in rows])


def _mark(line):
    return next((mark for mark in MARKS if mark in line and not (mark == "," and _all_commas(line))), None)


def _all_commas(line):
    """Whether the commas of a line are decimal marks: one in each word"""
    words = line.split()
    return len(words) > 1 and all(re.fullmatch(r"[-+]?\d+,\d+", word) for word in words)


def _words(line, mark):
    if mark is None and _seconds(line[:19]) is not None:
        line = line.replace(" ", "T", 1) if line[10:11] == " " else line
    return [word.strip() for word in (line.split() if mark is None else line.split(mark))]


def _is_value(word):
    return _seconds(word) is not None or bool(re.match(r"[-+]?[.,]?\d", word))


def _seconds(word):
    """s of a date and time, None of other words"""
    for date in DATES:
        found = re.fullmatch(date + CLOCK, word.replace(",", "."))
        if found:
            a, b, c, hour, minute, second = found.groups()
            day = (a, b, c) if "year" not in found.groupdict() else (c, b, a)
            try:
                days = datetime(*map(int, day)).toordinal()
            except ValueError:
                return None
            return 86400.0 * days + 3600 * int(hour) + 60 * int(minute) + float(second)
    return None


def _value(path, line, word, comma, start):
    if start is not None and (seconds := _seconds(word)) is not None:
        return seconds - start
    if word.lower() in GAPS:
        return np.nan
    number = word
    if comma and "." in word:
        number = word.replace(".", "") if re.fullmatch(r"[-+]?\d{1,3}(\.\d{3})+(,\d+)?", word) else ""
    if comma:
        number = number.replace(",", ".")
    try:
        return float(number)
    except ValueError:
        raise TableError(
            f"{path}: line {line} has {word!r}; allowed: numbers with the same decimal mark, or empty cells"
        ) from None


def _names(heads, mark, width, dated):
    """Names of the columns with units from a line of their own; None if no line above has as many words"""
    rows = []
    for _, line in heads:
        ways = [re.split(r"\t+|\s{2,}", line), line.split()] if mark is None else [line.split(mark)]
        rows += [[word.strip() for word in words] for words in ways if len(words) == width][:1]
    if not rows:
        return None
    names = rows[-1]
    if len(rows) > 1 and all(UNIT.fullmatch(word) for word in names):
        names = [f"{name} {unit}" if UNIT.fullmatch(unit) else name for name, unit in zip(rows[-2], names, strict=True)]
    return ["time (s)", *names[1:]] if dated else names
