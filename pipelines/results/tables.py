"""A result as tables: which quantities form a table, and how they are printed.

Quantities with the same `table` and the same first axis become columns of one table. The labels of that axis are the
rows; further axes are spread over columns. Quantities without axes are rows of a table of names, values and units.
Numbers are printed with significant digits, in print units; --csv and --json give all digits, in SI.
"""

import itertools
import textwrap
from typing import NamedTuple

import numpy as np

from ..printing.number import NOTHING, number
from .quantity import READ_IN, read_in

LINE = 80  # characters of a table
# reductions of heading width and cell padding, tried in order until a table fits
WIDTHS = (14, 1), (10, 1), (6, 1), (6, 0)
TEXT = 36  # characters of a line of text in a cell
LONG, PRINTED = 40, 12  # rows of a table over numbers above which only some are printed, and their number
FEW = 3  # rows that are printed as columns if there are more than twice as many columns
ROUNDING = 1e-10  # numbers below this fraction of the largest with the same unit in a table are printed as 0


class Column(NamedTuple):
    """name : name of the quantity, with the label of its second axis; heading : printed heading; values : (rows,)

    units : one unit for each row, or one for all rows; read_in : (print unit, its size) if all rows share a unit
    """

    name: str
    heading: str
    values: np.ndarray
    units: tuple[str, ...]
    read_in: tuple[str, float]


class Shown(NamedTuple):
    """title; axis : axis of the rows, "" if each row is a separate quantity; labels : (rows,); columns"""

    title: str
    axis: str
    labels: tuple
    columns: tuple[Column, ...]


def tables(result, all_of_them=False):
    """[Shown, …] of a result, in the order of its quantities; with all_of_them also quantities that are not printed"""
    groups = {}
    for name, one in result.quantities.items():
        if not one.record and (all_of_them or (one.table and not _unknown(one))):
            groups.setdefault((one.table, one.axes[:1]), []).append((name, one))
    return [_shown(result, title, axes, members) for (title, axes), members in groups.items()]


def _unknown(one):
    """Whether a share, such as one of an unknown breaking load, has no known value"""
    return one.share and one.values.dtype.kind == "f" and bool(np.isnan(one.values).all())


def _shown(result, title, axes, members):
    common = _common([one for _, one in members])
    if not axes:
        columns = tuple(
            Column(name, one.description or name, one.values[None], one.units(), _read_in(one, common))
            for name, one in members
        )
        return Shown(title, "", tuple(n for n, _ in members), columns)
    axis = axes[0]
    columns = [column for name, one in members for column in columns_of(result, name, one, common)]
    return Shown(title, axis, tuple(result.labels[axis].values.tolist()), tuple(columns))


def columns_of(result, name, one, common=None):
    """[Column, …] of a quantity with a first axis: one column for each label of its further axes

    common : {unit: size} of the quantities that are printed beside this one
    """
    words, units = one.description or name, _read_in(one, common or _common([one]))
    if one.values.ndim == 1:
        yield Column(name, words, one.values, one.units(), units)
        return
    for place in itertools.product(*map(range, one.values.shape[1:])):
        at = [(result.labels[axis], k) for axis, k in zip(one.axes[1:], place, strict=True)]
        exact = ", ".join(str(labels.values[k]) for labels, k in at)
        said = ", ".join(_label(labels.values[k], labels.unit) for labels, k in at)
        values = one.values[(slice(None), *place)]
        yield Column(f"{name}[{exact}]", f"{words} {said}".strip(), values, one.units(), units)


def _label(value, unit):
    """The text of a label in a heading: 90°, 0.5 rad/s, fore port"""
    if isinstance(value, str):
        return value
    name, size = READ_IN[unit] if unit == "rad" else (unit, 1.0)
    return f"{value / size:.6g}{name if name == '°' else f' {name}' if name else ''}"


def _common(quantities):
    """{unit: sizes of all values in it}, which have one print unit if they are in one table"""
    found = {}
    for one in quantities:
        if not isinstance(one.unit, tuple):
            found.setdefault(one.unit, []).append(_sizes(one.values).ravel())
    return {unit: np.concatenate(sizes) for unit, sizes in found.items()}


def _read_in(one, common):
    unit = one.units()[0]
    return read_in(unit, common.get(unit, _sizes(one.values)), one.share)


def printed(result, console=None):
    """Print the tables, notes and findings of a result; returns the exit status"""
    from ..printing.console import document, new_console
    from ..printing.verdict import tell

    console = console or new_console()
    if document(result):
        return tell(result.told, console)
    status = tell(result.first, console)
    for shown in tables(result):
        console.print(rich_table(shown, result.labels))
    for line in result.notes:
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    return tell(result.findings, console) or status


def rich_table(shown, labels):
    """A rich table; it keeps within LINE characters if narrow headings or exchanging rows and columns achieve that"""
    from rich.console import Console

    measured = Console(width=10 * LINE).measure
    for width, beside in WIDTHS:
        table = _table(shown, labels, width, beside)
        if measured(table).maximum <= LINE:
            return table
    turned = _table(shown, labels, *WIDTHS[0], turned=True)
    return turned if measured(turned).maximum <= LINE else table


def _table(shown, labels, width, beside, turned=False):
    """width, beside : of headings, and beside cells; turned : rows for columns if there are more columns"""
    from rich.table import Table

    rows, title = _printed_rows(shown, labels), shown.title
    if len(rows) < len(shown.labels):
        title = f"{title}, {len(rows)} of {len(shown.labels)} rows".removeprefix(", ")
    table = Table(title=title or None, title_justify="left", padding=(0, beside))
    if not shown.axis:
        return _in_list(table, shown)
    few = len(shown.labels) <= FEW and len(shown.columns) > 2 * len(shown.labels)
    one_unit = all(len(column.units) == 1 for column in shown.columns)
    if one_unit and (few or (turned and len(shown.labels) < len(shown.columns))):
        return _turned(table, shown, labels[shown.axis])
    return _in_columns(table, shown, labels[shown.axis], rows, width)


def _in_list(table, shown):
    """A row for each quantity"""
    for name in ("quantity", "value", "unit"):
        table.add_column(name, justify="right" if name == "value" else "left", no_wrap=True)
    largest = _largest(shown)
    for column in shown.columns:
        (unit,), (cell,) = _filled(column, largest)
        table.add_row(column.heading, cell, unit)
    return table


def _in_columns(table, shown, head, rows, width):
    """A column for each quantity; units that differ from row to row stand beside its label"""
    unit, size = read_in(head.unit, _sizes(head.values)) if head.numeric else ("", 1.0)
    table.add_column(_heading(shown.axis.replace("_", " "), unit, width), justify="left", no_wrap=True)
    largest, narrow = _largest(shown), width < WIDTHS[0][0]
    filled = [_filled(column, largest) for column in shown.columns]
    for column, (units, _) in zip(shown.columns, filled, strict=True):
        heading = _heading(column.heading, "" if len(units) > 1 else units[0], width)
        text = narrow and column.values.dtype.kind in "US"
        table.add_column(heading, justify="right", no_wrap=not text, max_width=TEXT if text else None)
    of_rows = next((units for units, _ in filled if len(units) > 1), None)
    for row in rows:
        label = _cell(shown.labels[row], size) if head.numeric else str(shown.labels[row])
        table.add_row(f"{label}, {of_rows[row]}" if of_rows else label, *(cells[row] for _, cells in filled))
    return table


def _printed_rows(shown, labels):
    """Indices of the printed rows: all, or an even selection of a long table over numbers"""
    count = len(shown.labels)
    if not shown.axis or count <= LONG or not labels[shown.axis].numeric:
        return list(range(count))
    return np.linspace(0, count - 1, PRINTED).round().astype(int).tolist()


def _turned(table, shown, head):
    """A row for each column and a column for each row"""
    table.add_column("quantity", no_wrap=True)
    for label in shown.labels:
        table.add_column(_label(label, head.unit), justify="right", no_wrap=True)
    table.add_column("unit", no_wrap=True)
    largest = _largest(shown)
    for column in shown.columns:
        (unit,), cells = _filled(column, largest)
        table.add_row(column.heading, *cells, unit)
    return table


def _largest(shown):
    """{unit: largest size in a table}"""
    found = {}
    for column in shown.columns:
        for unit, values in zip(
            column.units, [column.values] if len(column.units) == 1 else column.values, strict=True
        ):
            sizes = _sizes(values)
            found[unit] = max(found.get(unit, 0.0), np.max(sizes[np.isfinite(sizes)], initial=0.0))
    return found


def _filled(column, largest):
    """Return (print units, cells) of a column; if units differ by row each row has its own, the same in all columns

    largest : {unit: largest size in the table}, which determines the print unit, and the limit of rounding printed as 0
    """
    column = column._replace(values=_without_rounding(column, largest))
    if len(column.units) == 1:
        unit, size = column.read_in
        return (unit,), [_cell(value, size) for value in column.values]
    found = [read_in(unit, np.array([largest[unit]])) for unit in column.units]
    return [unit for unit, _ in found], [
        _cell(value, size) for value, (_, size) in zip(column.values, found, strict=True)
    ]


def _without_rounding(column, largest):
    if column.values.dtype.kind != "f":
        return column.values
    limit = ROUNDING * np.array([largest[unit] for unit in column.units])
    return np.where(np.abs(column.values) < limit, 0.0, column.values)


def _heading(words, unit, width):
    """Over a column, in lines of up to `width` characters"""
    return textwrap.fill(f"{words}, {unit}" if unit else words, width, break_long_words=False)


def _sizes(values):
    values = np.asarray(values)
    return np.atleast_1d(np.abs(values)) if values.dtype.kind in "fiuc" else np.zeros(0)


def _cell(value, size):
    value = value.item() if isinstance(value, np.generic) else value
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, complex):
        return number(abs(value), size)
    return number(value, size) if isinstance(value, float) else str(value) or NOTHING
