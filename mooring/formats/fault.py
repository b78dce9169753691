"""The one error of the readers: file, line and section, and what is wrong there."""

from __future__ import annotations


class FormatError(ValueError):
    """A file that cannot be read or written; one line says where and why."""


def fault(path, line, section, what):
    """FormatError at a line (counted from 1, None for the whole file) of a section (None before the first)."""
    place = f"{path}" + (f" line {line}" if line else "") + (f", section {section}" if section else "")
    return FormatError(f"{place}: {what}")
