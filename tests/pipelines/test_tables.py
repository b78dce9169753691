"""Tables of commands: whole in a narrow terminal, and as CSV and JSON."""

import csv
import io
import json
import re

import pytest

from hakobune.pipelines import cli

FENDER = ["fender", "--family", "cell", "--height", "2"]


def printed(arguments, capsys):
    assert cli.main(arguments) == 0
    return capsys.readouterr()


@pytest.mark.parametrize("columns", ["30", "80"])
def test_a_table_is_not_cut_by_a_narrow_terminal(columns, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    out = printed(FENDER, capsys).out
    assert "…" not in out and "deflection m" in out and "1731.3" in out


def test_csv_and_json_hold_the_numbers_of_the_box(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    box = printed(FENDER, capsys).out
    rows = list(csv.DictReader(io.StringIO(printed([*FENDER, "--csv"], capsys).out)))
    both = printed([*FENDER, "--json"], capsys)
    (line,) = both.out.splitlines()
    assert [row for row in rows if any(row.values())] == json.loads(line)["rows"]
    assert set(re.findall(r"\d+\.\d+", line)) <= set(re.findall(r"\d+\.\d+", box))
    assert both.err  # what is no table


def test_both_forms_at_once_are_refused_and_no_table_is_told(capsys):
    assert cli.main([*FENDER, "--csv", "--json"]) == 2
    assert "allowed: one of the two" in capsys.readouterr().err
    assert "no table was printed" in printed(["new", "--json"], capsys).err
