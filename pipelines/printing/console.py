"""The single way to print: a console whose tables are never cut, or are printed as CSV or JSON on request.

A table wider than its terminal is printed at its own width.  With --csv or --json (`tables_as`) each table is a block
of lines with its names first, or one line {"title", "rows": [{name: text or number}]}. Everything else goes to stderr.
Cells made by `number` have all their digits; a number that is not finite is empty in CSV and null in JSON.
"""

import contextlib
import csv
import io
import json
import math
import sys
from functools import cache

FORMS = ("csv", "json")
WIDEST = 1000  # characters
_asked = None  # (form, file of tables) while another form than boxes is requested


@contextlib.contextmanager
def tables_as(form):
    """Context in which tables are printed as "csv" or "json", or with None as boxes; reports a command without
    tables"""
    global _asked
    if form is None:
        yield
        return
    out, made = sys.stdout, io.StringIO()
    _asked = form, made
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield
        if not made.getvalue():
            print(f"there is no table for --{form}", file=sys.stderr)
    finally:
        _asked = None
        out.write(made.getvalue())


def document(result):
    """Whether a `results.Result` was written as CSV or JSON, as requested on the command line"""
    if _asked is None:
        return False
    form, file = _asked
    file.write(result.to_csv() if form == "csv" else result.to_json())
    return True


def taken(arguments):
    """Arguments without --csv and --json, and the requested format. Raises ValueError if both are given."""
    given = [form for form in FORMS if f"--{form}" in arguments]
    if len(given) > 1:
        raise ValueError("--csv and --json are both given; give one of them")
    return [word for word in arguments if not given or word != f"--{given[0]}"], given[0] if given else None


def new_console(**options):
    """A rich console for the output of a command"""
    return _kind()(**options)


@cache
def _kind():
    from rich.console import Console
    from rich.table import Table

    class PipedConsole(Console):
        def on_broken_pipe(self):
            """The reader has closed the pipe: an error for the command line, where rich would end with status 1"""
            raise BrokenPipeError

    class TableConsole(PipedConsole):
        def print(self, *objects, **options):
            if not (len(objects) == 1 and isinstance(objects[0], Table)):
                return super().print(*objects, **options)
            (table,) = objects
            if _asked is not None:
                form, file = _asked
                file.write(as_csv(table) if form == "csv" else as_json(table))
                return None
            whole = Console(width=WIDEST).measure(table).maximum
            if whole <= self.width:
                return super().print(table, **options)
            return PipedConsole(file=self.file, width=whole, force_terminal=self.is_terminal).print(table, **options)

    return TableConsole


def _cells(table):
    """Names of the columns of a rich table, and its rows, as texts and numbers"""
    columns = [[_value(cell) for cell in column.cells] for column in table.columns]
    names = _distinct([_plain(column.header) for column in table.columns])
    return names, list(zip(*columns, strict=True))


def _distinct(names):
    """Names of columns of which those alike have that of the column before them in front: a row by names keeps all"""
    return [f"{names[i - 1]} {name}".strip() if i and names.count(name) > 1 else name for i, name in enumerate(names)]


def _value(cell):
    value = getattr(cell, "value", None)
    if value is None:
        return _plain(cell)
    return value if math.isfinite(value) else None


def _plain(cell):
    from rich.text import Text

    return " ".join((Text.from_markup(cell) if isinstance(cell, str) else cell).plain.split())


def as_csv(table):
    names, rows = _cells(table)
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([names, *rows])
    return text.getvalue() + "\n"


def as_json(table):
    names, rows = _cells(table)
    title = "" if table.title is None else _plain(table.title)
    made = {"title": title, "rows": [dict(zip(names, row, strict=True)) for row in rows]}
    return json.dumps(made, ensure_ascii=False) + "\n"
