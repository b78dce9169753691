"""Tables of commands: whole in a narrow terminal, and in one form at a time."""

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
    assert "…" not in out and "deflection, m" in out and "1731" in out


def test_both_forms_at_once_are_refused_and_no_table_is_told(capsys):
    assert cli.main([*FENDER, "--csv", "--json"]) == 2
    assert "give one of them" in capsys.readouterr().err
    assert "there is no table for --" in printed(["new", "--json"], capsys).err
