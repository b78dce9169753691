"""The single-point series of the SR179 report: cases as studies, tables, faults."""

import csv

import numpy as np
import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.single_point.study import make
from hakobune.pipelines.single_point.tables import make_study
from hakobune.pipelines.validation.series.single_point_cases import TABLE, read_cases, study_of
from hakobune.pipelines.validation.series.single_point_charts import STATEMENTS

MASS = {"added_surge": 0.1, "added_sway": 1.0, "added_yaw": 0.7}


def test_every_case_is_a_study_of_its_printed_numbers():
    cases = read_cases()
    assert len(cases) == 68 and {case.floater for case in cases} == {"A", "B"}
    for case in cases:
        made = make(make_study({**study_of(case), "mass": MASS}))
        tension = made.point.at_rest.tension
        assert np.allclose(tension / 9806.65, case.together * case.values["pretension_ton"], rtol=1e-9)
        assert np.all(np.abs(made.point.origin) < 1e-9)
    assert {name for _, names, _ in STATEMENTS for name in names} <= {case.name for case in cases}


def test_two_cases_are_solved_run_and_tabulated_beside_the_print(tmp_path, capsys):
    """A16 and A17: 20 m, waves of 10 s; the report's ratios of significant to static tension are 1.17 and 1.20

    Printed and computed significant tensions are decimetres of surge apart.
    """
    folder = tmp_path / "series"
    assert cli.main(["series", "single-point", "--only", "A16,A17", "--output", str(folder)]) == 0
    assert {p.name for p in folder.iterdir()} == {
        "A_20m.h5", "A16.toml", "A17.toml", "single_point.csv", "single_point_A.png",
    }  # fmt: skip
    lines = [line for line in (folder / "single_point.csv").read_text().splitlines() if not line.startswith("#")]
    for row in csv.DictReader(lines):
        static, printed = float(row["static_ton"]), float(row["printed_static_ton"])
        assert abs(static / printed - 1) < 0.05  # by the drift of this depth; that of 14 m would be 5 to 18 % too much
        assert 1.1 < float(row["significant_ton"]) / static < 1.35
        assert abs(float(row["apart_m"])) < 0.5
        assert abs(float(row["scope"]) / float(row["printed_scope"]) - 1) < 0.1
    said = capsys.readouterr().out
    assert "A, H 1.5 m, 10 s, 20 m: significant over static" in said and "m of surge" in said
    assert cli.main(["single-point", str(folder / "A16.toml"), "--database", str(folder / "A_20m.h5"), "--output",
                     str(tmp_path / "a.h5")]) == 0  # fmt: skip


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--only", "Z9"], "--only names 'Z9'"),
        (["--seeds", "0"], "--seeds is 0; allowed: 1 to 100"),
        (["--cases", "missing.csv"], "missing.csv"),
    ],
)
def test_a_fault_is_one_line(flags, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["series", "single-point", *flags]) == 2
    shown = capsys.readouterr().err
    assert said in shown and shown.count("\n") == 1


def test_a_row_without_a_number_names_the_case(tmp_path, capsys):
    text = TABLE.read_text().replace("A,1.5,15,25,1.5,0,,12,", "A,1.5,15,25,1.5,0,,,", 1)
    (tmp_path / "t.csv").write_text(text)
    assert cli.main(["series", "single-point", "--cases", str(tmp_path / "t.csv")]) == 2
    assert "A1: " in capsys.readouterr().err


def test_a_table_of_somebody_else_is_not_replaced(tmp_path, capsys):
    (tmp_path / "single_point.csv").write_text("mine\n1\n")
    assert cli.main(["series", "single-point", "--only", "A16", "--output", str(tmp_path)]) == 2
    assert "is not a table of the series and is not replaced" in capsys.readouterr().err
    assert [p.name for p in tmp_path.iterdir()] == ["single_point.csv"]
