"""Computed values beside published ones: the rows of a table, the requested cases, and one result.

Numbers remain in the units of the publication. The unit is the end of the column name (height_m, static_tonf).
"""

import sys

import numpy as np
import tomli_w

from hakobune.bem.database import open_database
from hakobune.meshing.text_files import csv_rows, read_text
from hakobune.meshing.whole_files import write_whole

from ..common.quantities import StudyError
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result

UNITS = {"_t_m": "t/m", "_m_s": "m/s", "_m": "m", "_cm": "cm", "_mm": "mm", "_s": "s", "_ms": "ms",
         "_mb": "MB", "_kn": "kn", "_tonf": "tonf", "_kgf": "kgf", "_deg": "°"}  # fmt: skip
LONG = 100  # rows above which a table is in files only


def read_rows(path):
    """Rows of a CSV as [{column: text}]; its # lines, which name the source, are skipped.  Raises StudyError."""
    return list(csv_rows(read_text(path, StudyError, largest=1)))


def number(text):
    """Number of a text, NaN of none"""
    return float(text) if text else np.nan


def chosen(named, only):
    """Cases of {name: case} by a list a,b,c of names, or of their beginnings up to a -.  Raises StudyError."""
    words = [""] if only is None else [f"{word.strip()}-" for word in only.split(",")]
    for word in words:
        if not any(f"{name}-".startswith(word) for name in named):
            raise StudyError(f"--only names {word[:-1]!r}; allowed: {', '.join(named)}, or beginnings of names")
    return [case for name, case in named.items() if any(f"{name}-".startswith(word) for word in words)]


def one_by_one(cases, name):
    """Yields cases one after another and announces each on the standard error; name : function of a case that gives its
    name"""
    for count, case in enumerate(cases, 1):
        print(f"{count}/{len(cases)}  {name(case)}", file=sys.stderr, flush=True)
        yield case


def database(scene, path, fresh):
    """The open database of a Scene, solved if it is missing.

    raises : StudyError if it is incomplete, KeyboardInterrupt after Ctrl-C with all solved frequencies stored
    """
    from ..solve.run import solve

    path.parent.mkdir(parents=True, exist_ok=True)
    outcome = solve(scene, path, fresh=fresh)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if outcome.exit_status:
        raise StudyError(f"{path} is incomplete: not all frequencies are stored; see hakobune check {path}")
    return open_database(path)


def keep(path, raw):
    """Write nested dictionaries of a study as a TOML file, for the command of its kind"""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, tomli_w.dumps(raw).encode())


def result(kind, source, tables, notes=(), findings=(), shown=True):
    """The Result of {axis: [{column: number or text}, …]}; the first column of each table names its rows

    Quantities are named axis.column, without the unit. source : title and year of the publication; shown : whether
    tables are printed, if they have at most LONG rows; detail : rows of the table
    """
    quantities, labels = {}, {}
    for axis, rows in ((axis, rows) for axis, rows in tables.items() if rows):
        head, *columns = rows[0]
        title = f"{kind}, each {axis}, beside {source}" if shown and len(rows) <= LONG else ""
        labels[axis] = Quantity(_values(rows, head), (axis,), description=axis)
        for column in columns:
            end = max((end for end in UNITS if column.endswith(end)), key=len, default="")
            name = column.removesuffix(end)
            values, words = _values(rows, column), name.replace("_", " ")
            quantities[f"{axis}.{name}"] = Quantity(values, (axis,), UNITS.get(end, ""), words, title)
    told = provenance(source=source)
    return Result(kind, quantities, labels, tuple(findings), tuple(notes), provenance=told, detail=tables)


def _values(rows, column):
    return np.array([row[column] for row in rows])
