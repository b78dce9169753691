"""Tables as --csv and --json: whole at any width, numbers with all their digits."""

import csv
import io
import json
import math

import pytest

from hakobune.pipelines.printing.console import new_console, tables_as
from hakobune.pipelines.printing.number import fixed, number, significant


def wide_table():
    from rich.table import Table

    table = Table()
    for column in range(60):
        table.add_column(f"quantity {column}", no_wrap=True)
    table.add_row(*(number(math.pi * 10.0**column) for column in range(-30, 30)))
    return table


@pytest.mark.parametrize("width", ["40", "400"])
def test_a_table_wider_than_the_terminal_is_whole_in_both_forms(width, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", width)
    exact = [math.pi * 10.0**column for column in range(-30, 30)]
    with tables_as("csv"):
        new_console().print(wide_table())
    row = list(csv.reader(io.StringIO(capsys.readouterr().out)))[1]
    assert [float(cell) for cell in row] == exact
    with tables_as("json"):
        new_console().print(wide_table())
    (row,) = json.loads(capsys.readouterr().out)["rows"]
    assert list(row.values()) == exact


def test_what_is_not_finite_is_a_dash_and_nothing_in_files(capsys):
    from rich.table import Table

    table = Table("a", "b")
    table.add_row(number(math.nan), number(math.inf))
    with tables_as("json"):
        new_console().print(table)
    assert json.loads(capsys.readouterr().out)["rows"] == [{"a": None, "b": None}]
    assert significant(math.nan) == "–"


def test_columns_of_one_name_are_all_in_a_row_by_names(capsys):
    from rich.table import Table

    table = Table("", "force kN", "at s", "moment kN m", "at s")
    table.add_row("pile", "1", "2", "3", "4")
    with tables_as("json"):
        new_console().print(table)
    (row,) = json.loads(capsys.readouterr().out)["rows"]
    assert row == {"": "pile", "force kN": "1", "force kN at s": "2", "moment kN m": "3", "moment kN m at s": "4"}


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0132345, "0.01323"), (13.2345, "13.23"), (132345.6, "132346"), (-0.0, "0"), (1.5e-9, "1.5e-09")],
)
def test_a_small_number_keeps_four_digits_and_a_large_one_its_whole_part(value, text):
    assert significant(value) == text
    assert significant(2420.4, 3) == "2420" and significant(9999.7) == "10000" and significant(999.4, 3) == "999"


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [(12.346, 2, "12.35"), (1.0, 2, "1.00"), (0.99951, 2, "1"), (0.012345, 2, "0.0123"), (-0.0357, 2, "-0.0357"),
     (0.0, 2, "0.00"), (-3e-17, 2, "0.00"), (-300.46, 1, "-300.5"), (0.1734, 1, "0.173"), (4217.6, 0, "4218"),
     (12.31, 0, "12.3"), (math.inf, 2, "–"), (math.nan, 0, "–")],
)  # fmt: skip
def test_fixed_decimals_leave_three_digits_of_a_small_number_and_none_of_rounding(value, decimals, text):
    assert fixed(value, decimals) == text
