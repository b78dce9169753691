"""MoorDyn input files, read and written: tables of text under headings of dashes.

Columns are found by the names in the table's first line, so files of version 1 and 2 are both read. If the names are
unknown, the order of version 2 is assumed. A row has an entry for every column; text after # or ! is a comment. All
content is kept as written, including content that the statics of `mooring.lines` cannot use. `moordyn_system` makes
a System of the file, or reports why it cannot. MoorDyn 2.7 documentation, "Inputs" (moordyn.readthedocs.io).
"""

from __future__ import annotations

import difflib
import re
import typing
from dataclasses import dataclass, field

from hakobune.meshing.text_files import read_text
from hakobune.meshing.whole_files import write_whole

from .fault import FormatError, fault
from .moordyn_rows import (
    OPTIONAL,
    SECTIONS,
    BodyRow,
    FailureRow,
    LineRow,
    LineTypeRow,
    PointRow,
    RodRow,
    RodTypeRow,
    early_body,
    finite_number,
)


@dataclass(frozen=True)
class MoorDynFile:
    """All sections of a file; options : {name: value as text}; outputs : channel names

    syrope, control, external : the lines of these sections as written
    """

    title: tuple[str, ...] = ()
    line_types: tuple[LineTypeRow, ...] = ()
    rod_types: tuple[RodTypeRow, ...] = ()
    bodies: tuple[BodyRow, ...] = ()
    rods: tuple[RodRow, ...] = ()
    points: tuple[PointRow, ...] = ()
    lines: tuple[LineRow, ...] = ()
    failures: tuple[FailureRow, ...] = ()
    syrope: tuple[str, ...] = ()
    control: tuple[str, ...] = ()
    external: tuple[str, ...] = ()
    options: dict[str, str] = field(default_factory=dict)
    outputs: tuple[str, ...] = ()

    def __repr__(self):
        return f"<MoorDynFile {len(self.lines)} lines, {len(self.points)} points, {len(self.bodies)} bodies>"

    def option(self, *names, default=None):
        """The value of the first option that the file gives among some names; upper and lower case are equal."""
        given = {name.lower(): value for name, value in self.options.items()}
        return next((given[name.lower()] for name in names if name.lower() in given), default)


LARGEST = 8  # MB
NOTE = re.compile("[#!]")
LAST = "END", "NEED THIS LINE"  # of the heading that ends a file
COUNT = re.compile(r"\s*\d+\s+N[A-Z][A-Za-z]+\b")  # version 1.01 gives the number of rows first: "2 NTypes"
IDLE = ("fx", "fy", "fz", "ctrlchan", "calcchans", "control")  # forces on points and winch channels: only 0 is accepted


def read_moordyn(path) -> MoorDynFile:
    """The MoorDynFile of a path.  Raises FormatError with line and section."""
    # units such as m³ are often in a code page of Windows; all content that is read is ASCII
    return parse_moordyn(read_text(path, FormatError, errors="replace", largest=LARGEST), path)


def parse_moordyn(text, path="MoorDyn file") -> MoorDynFile:
    """The MoorDynFile of a text; `path` is its name in error messages."""
    title, found = _sections(text, path)
    if "lines" not in found and not (found.get("rods") or found.get("bodies")):
        what = "it has POINTS but no lines" if found.get("points") else "this is not a MoorDyn input file"
        raise fault(path, None, None, f"there is no section LINES; {what}")
    made = {key: _rows(key, rows, path) for key, rows in found.items() if SECTIONS[key].row is not None}
    for key in ("syrope", "control", "external"):
        made[key] = tuple(line.rstrip() for _, line in found.get(key, []))
    options = _options(found.get("options", []), path)
    outputs = tuple(name for _, line in found.get("outputs", []) for name in line.split("#")[0].split())
    checked = MoorDynFile(tuple(title), options=options, outputs=outputs, **made)
    _check_references(checked, found, path)
    return checked


def _sections(text, path):
    """Lines of the title, and {section: [(number, line)]}.  Raises FormatError."""
    title, found, key, first = [], {}, None, 0
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith("---"):
            if key is None and _is_title(line, lines[number:]):
                title.append(line.rstrip())
                continue
            key = _section_of(line, number, path)
            if key == "end":
                break
            if key in found:
                raise fault(path, number, SECTIONS[key].title, f"appears twice, first at line {first}")
            first = number
            found[key] = []
        elif key is None:
            title += [line.rstrip()] if line.strip() else []
        elif SECTIONS[key].row is None:
            found[key] += [(number, line)] if line.strip() else []
        elif NOTE.split(line)[0].strip() or len(found[key]) < 2:  # the names may begin with #, and units may be "(#)"
            found[key] += [(number, line)] if line.strip() and not COUNT.match(line) else []
    return title, found


def _is_title(line, following):
    """Whether a line of dashes before the first section is free text: no heading, nor nearly one, nor one of a table
    without the name of any column in the next of the lines that follow"""
    words = _words(line)
    if "FILE" in words or not words:
        return True
    key = _known(words)
    if key is not None and SECTIONS[key].row is not None and words not in SECTIONS[key].words:
        head = next((row for row in following if row.strip() and not COUNT.match(row)), "")
        return not set(head.lower().split()) & set(_fields(key))
    near = difflib.get_close_matches(
        words, [word for section in SECTIONS.values() for word in section.words], cutoff=0.6
    )
    return not near and _known(words) is None and not words.startswith(LAST)


def _words(line):
    return " ".join(line.replace("-", " ").upper().split())


def _known(words):
    """Key of the section of a heading, None without one"""
    for key, section in SECTIONS.items():
        if any(words.startswith(word) or f" {word}" in f" {words}" for word in section.words):
            return key
    return None


def _section_of(line, number, path):
    words = _words(line)
    if (key := _known(words)) is not None:
        return key
    if words.startswith(LAST) or not words:
        return "end"
    known = ", ".join(section.title for section in SECTIONS.values())
    raise fault(path, number, words, f"is not a section; allowed: {known}, END")


def _fields(key):
    """Names of the columns in lower case → field of the row"""
    section = SECTIONS[key]
    own = dict(zip((name.lower() for name, _ in section.columns), section.row._fields, strict=True))
    # x0, y0 (a position) and y0 (an angle) differ in MoorDyn's heading by case only
    return own | section.aliases


def _rows(key, rows, path):
    section = SECTIONS[key]
    if len(rows) < 2:
        raise fault(
            path,
            rows[0][0] if rows else None,
            section.title,
            "the section needs a line of column names and a line of units",
        )
    names, entries = rows[0][1].split(), [NOTE.split(line)[0].split() for _, line in rows[2:]]
    if key == "bodies" and "xcg" in map(str.lower, names):
        entries = [early_body(words) for words in entries]
    if key == "failures" and names[0].lower() == "node":  # early drafts of MoorDyn, without a number for each failure
        names, entries = ["FailureID", "Point", *names[1:]], [[str(i), *words] for i, words in enumerate(entries, 1)]
    fields = _columns(key, names, {len(words) for words in entries}, (path, rows[0][0], section.title))
    made = tuple(_row(key, fields, number, words, path) for (number, _), words in zip(rows[2:], entries, strict=True))
    seen = set()
    for (number, _), row in zip(rows[2:], made, strict=True):
        if row[0] in seen:
            raise fault(path, number, section.title, f"{row._fields[0]} {row[0]} is used twice; give each number once")
        seen.add(row[0])
    return made


def _columns(key, names, counts, place):
    """Fields in the order of a file's columns; None for those in IDLE

    counts : number of entries per row; words after this number of known names are a remark
    place : path, line and section, for the fault of an unknown name where the order of other names differs
    """
    known = _fields(key)
    names = [name.lower() for name in names]
    strange = [name for name in names if name not in known and name not in IDLE]
    if strange and counts == {names.index(strange[0])}:
        names, strange = names[: names.index(strange[0])], []
    if key == "bodies" or strange:
        usual = SECTIONS[key].row._fields
        moved = [name for name, field in zip(names, usual, strict=False) if known.get(name, field) != field]
        if key == "lines" and moved:
            raise fault(
                *place, f"column {strange[0]!r} is unknown, and {moved[0]!r} is not in its place in MoorDyn version 2"
            )
        return usual
    return [known.get(name) for name in names]


def _row(key, fields, number, words, path):
    section = SECTIONS[key]
    kinds = typing.get_type_hints(section.row)
    values = {}
    if len(words) > len(fields):
        if fields[-1] != "outputs":
            raise fault(path, number, section.title, f"{len(words)} entries; allowed: {len(fields)}")
        words = [*words[: len(fields) - 1], "".join(words[len(fields) - 1 :])]
    for name, word in zip(fields, words, strict=False):
        if name is None:
            if finite_number(word) != 0:
                raise fault(
                    path,
                    number,
                    section.title,
                    f"{word} is a force on a point or a winch channel, which is not supported; allowed: 0",
                )
            continue
        values[name] = _value(kinds[name], name, word, number, section, path)
    wanted = [*section.row._fields[: -len(section.row._field_defaults) or None], *filter(None, fields)]
    missing = [name for name in dict.fromkeys(wanted) if name not in values and name not in OPTIONAL]
    if missing:
        what = f"{len(words)} entries, {', '.join(missing)} missing; allowed: one for each of {len(fields)} columns"
        raise fault(path, number, section.title, what)
    return section.row(**values)


def _value(kind, name, word, number, section, path):
    if kind is str:
        return word
    value = finite_number(word)
    if value is None:
        raise fault(path, number, section.title, f"{name} is {word!r}; allowed: a number")
    if kind is int:
        if value != int(value):
            raise fault(path, number, section.title, f"{name} is {word}; allowed: a whole number")
        return int(value)
    return value


def _options(rows, path):
    """{name: value}; a table may begin with a line of names and one of units"""
    made = {}
    for number, line in rows:
        words = line.split()
        if words[0].lower() == "option" or words[0].startswith("("):
            continue
        if len(words) < 2:
            raise fault(path, number, "OPTIONS", f"{line.strip()!r} is not a value and a name")
        made[words[1]] = words[0]
    return made


def _check_references(file, found, path):
    types = [row.name for row in file.line_types]
    points = {row.id.lower().removeprefix("p").removeprefix("oint") for row in file.points}
    places = [number for number, _ in found.get("lines", [])[2:]]
    for number, row in zip(places, file.lines, strict=True):
        if row.type not in types:
            what = f"line {row.id}: type {row.type!r} is unknown; allowed: {', '.join(types)}"
            raise fault(path, number, "LINES", what)
        for end in (row.a, row.b):
            plain = end.lower().removeprefix("point").removeprefix("p").removeprefix("connection").removeprefix("c")
            if plain.isdigit() and plain not in points:
                raise fault(path, number, "LINES", f"line {row.id}: its end {end} is not a point of the file")


def moordyn_text(file: MoorDynFile) -> str:
    """The text of a MoorDyn v2 input file."""
    out = list(file.title) or ["MoorDyn input file"]
    for key, section in SECTIONS.items():
        value = getattr(file, key)
        if not value and key not in ("line_types", "points", "lines", "options"):
            continue
        out.append(f"{'-' * 22} {section.title} {'-' * max(1, 60 - len(section.title))}")
        if section.row is not None:
            out += _table(section, value)
        elif key == "options":
            out += [f"{text:<16} {name}" for name, text in value.items()]
        else:
            out += list(value)
    return "\n".join([*out, f"{'-' * 22} END {'-' * 57}", ""])


def _table(section, rows):
    """Lines of a table; columns that are empty in all rows are omitted"""
    used = [
        i
        for i, name in enumerate(section.row._fields)
        if name not in section.row._field_defaults
        or section.row._field_defaults[name] is not None
        or any(row[i] is not None for row in rows)
    ]
    cells = [[section.columns[i][0] for i in used], [section.columns[i][1] for i in used]]
    cells += [[_cell(row[i]) for i in used] for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(used))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in cells]


def _cell(value):
    if value is None:
        return "0"
    return repr(value) if isinstance(value, float) else str(value)


def write_moordyn(file: MoorDynFile, path):
    """Write a MoorDyn v2 input file, replacing an existing one.  Raises `meshing.whole_files.NotWritten`."""
    write_whole(path, moordyn_text(file))
