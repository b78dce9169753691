"""The error of all readers: file, line and section of the fault, and the fault itself."""


class FormatError(ValueError):
    """A file cannot be read or written; the message gives the place and the reason."""


def fault(path, line, section, what):
    """FormatError at a line of a section; line : counted from 1, None for the whole file; section : None before the
    first section."""
    place = f"{path}" + (f" line {line}" if line else "") + (f", section {section}" if section else "")
    return FormatError(f"{place}: {what}")
