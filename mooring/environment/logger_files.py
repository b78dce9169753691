"""Columns of numbers in files of loggers and programs, with headers of several lines, a line of units, and dates.

Columns are separated by ; , tab, : or blanks, whichever separates the first row of numbers.  A comma that does not
separate columns is the decimal mark; points then separate thousands. Lines of words above the numbers are headers.
The last header line with as many columns as the rows of numbers contains the names; a line below it may contain units.
Dates, 2026-01-02 03:04:05.6 or 02.01.2026 03:04:05, are seconds from the first.  An empty place, NaN or "-" is a
gap; gaps matter only in columns that are used. A table (`read_table`) has at most one row of names, then only rows
of numbers. Lines that begin with # are comments.
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
    return _columns(path, dict.fromkeys(GAPS, np.nan))


def read_table(path, blank=None):
    """`Columns` of a table without gaps.  Raises TableError that names the line.

    blank : value of an empty place; None allows none
    """
    return _columns(path, {} if blank is None else {"": blank}, whole=True)


def _columns(path, gaps, whole=False):
    """gaps : {word in small letters: its value}; whole : whether nothing but a row of names may stand beside numbers"""
    text = read_text(path, TableError)
    lines = [(k, line.strip("\r\n ")) for k, line in enumerate(text.splitlines(), 1)]
    lines = [(k, line) for k, line in lines if line.strip() and not line.lstrip().startswith("#")]
    first = next((i for i, (_, line) in enumerate(lines) if _is_value(_words(line, _mark(line))[0])), None)
    if first is None:
        raise TableError(f"{path} has no rows of numbers; allowed: column names, then rows of numbers")
    last = next(i for i in range(len(lines))[::-1] if _is_value(_words(lines[i][1], _mark(lines[i][1]))[0]))
    mark = _mark(lines[first][1])
    width = len(_words(lines[first][1], mark))
    if whole:
        first, last = min(first, 1), len(lines) - 1
        width = len(_words(lines[0][1], _mark(lines[0][1])))
    values = _all_numbers([line for _, line in lines[first : last + 1]], mark, width)
    if values is not None:
        return Columns(_names(lines[:first], mark, width, False), values, [k for k, _ in lines[first : last + 1]])
    rows = [(k, _words(line, mark)) for k, line in lines[first : last + 1]]
    for k, words in rows:
        if len(words) != width:
            raise TableError(f"{path}: line {k} has {len(words)} columns; allowed: {width}, as in the first line")
    comma = mark != "," and any("," in word for _, words in rows for word in words if _seconds(word) is None)
    start = _seconds(rows[0][1][0])
    values = np.array([[_value(path, k, word, comma, start, gaps) for word in words] for k, words in rows])
    if whole and not np.all(np.isfinite(values)):
        i, j = np.argwhere(~np.isfinite(values))[0]
        raise _not_finite(path, rows[i][0], rows[i][1][j])
    return Columns(_names(lines[:first], mark, width, start is not None), values, [k for k, _ in rows])


def _all_numbers(lines, mark, width):
    """(n, m) values of rows of plain numbers, ten times as fast as word by word; None for others"""
    try:
        values = np.loadtxt(lines, delimiter=mark, comments=None, ndmin=2)
    except (ValueError, TypeError):
        return None
    return values if values.shape == (len(lines), width) and np.all(np.isfinite(values)) else None


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


def _value(path, line, word, comma, start, gaps):
    if start is not None and (seconds := _seconds(word)) is not None:
        return seconds - start
    if word.lower() in gaps:
        return gaps[word.lower()]
    number = word
    if comma and "." in word:
        number = word.replace(".", "") if re.fullmatch(r"[-+]?\d{1,3}(\.\d{3})+(,\d+)?", word) else ""
    if comma:
        number = number.replace(",", ".")
    try:
        return float(number)
    except ValueError:
        if np.nan not in gaps.values():
            raise _not_finite(path, line, word) from None
        raise TableError(
            f"{path}: line {line} has {word!r}; allowed: numbers with the same decimal mark, or empty cells"
        ) from None


def _not_finite(path, line, word):
    return TableError(f"{path}: line {line} has {word!r}; allowed: finite numbers; fill in the value")


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
