"""`hakobune series multi-point`: its cases, one of them made and made again, tables and charts."""

import csv

import numpy as np
import pytest

from hakobune.mooring.response.extremes import expected_maximum
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.validation.series.multi_point import Result, statements, table_text
from hakobune.pipelines.validation.series.multi_point_cases import LENGTHS, STRENGTH, WEIGHT, cases, scene, study
from hakobune.pipelines.validation.series.multi_point_charts import draw
from hakobune.pipelines.validation.series.multi_point_statistics import QUANTITIES, Statistics, printed_rows
from hakobune.pipelines.validation.series.multi_point_statistics import statements as told
from hakobune.pipelines.validation.series.multi_point_statistics import table_text as beside


def test_there_are_36_cases_each_with_its_own_name_and_a_study_that_reads():
    every = cases()
    assert len({one.name for one in every}) == len(every) == 36
    assert all(make_study(study(one, 3.0, 2)).water.depth == scene(one)["water"]["depth"] for one in every)
    assert [one.name for one in cases("B-sinker,A-chain-base")] == [
        "A-chain-base", "B-sinker-base", "B-sinker-100m", "B-sinker-Hs6",
    ]  # fmt: skip
    with pytest.raises(StudyError, match="--only 'A-rope' is no case"):
        cases("A-rope")


def test_chains_are_as_long_as_two_fifths_of_their_strength_holds_up():
    """S = √(H(2T/w − H)), rounded up to tens of metres (Table 3.5.5.4)"""
    for depth, (chain, *_) in LENGTHS.items():
        held = np.sqrt(depth * (2 * 0.4 * STRENGTH * 1e3 / WEIGHT - depth))
        assert held - 0.2 < chain < held + 15


def made_up(case, regular, simulated, notes=()):
    none = np.full(3, 0.5 * simulated)
    pair = (simulated, simulated)
    return Result(
        case, regular, 2 * regular, simulated, simulated, pair, pair, none, none, none, none, none, none, notes
    )


def test_tables_and_charts_show_both_methods_and_what_is_missing(tmp_path):
    results = [made_up(one, 400.0, 500.0 if one.depth < 40 else 300.0) for one in cases("A,B-chain")]
    results[3] = made_up(results[3].case, np.nan, np.nan, ("simulation: a line is lost",))
    rows = list(csv.DictReader(table_text(results, 3.0, 1).splitlines()[1:]))
    assert rows[0]["simulated_over_regular"] == "1.25" and rows[0]["method"] == rows[0]["larger"] == "simulation"
    assert rows[2]["method"] == rows[2]["larger"] == "simplified"
    assert rows[3]["simulated"] == "" and rows[3]["note"] == "simulation: a line is lost"
    names = {path.name for path in draw(results, tmp_path)}
    assert names == {"multi_point_A.png", "multi_point_B.png", "multi_point_slow.png"}
    said = list(statements(results))
    assert any("in up to 20 m of water the simulation exceeds" in line and "23 of 23" in line for line in said)
    assert rows[0]["simulated_over_irregular"] == "0.625"


@pytest.mark.parametrize("kind", ["chain", "buoy", "sinker"])
def test_the_printed_largest_values_are_those_of_gaussian_records_of_their_sigma(kind):
    """Eq. 3.5.1.5 and 3.5.1.6 of 1000 mean periods of 10 s; table 3.5.5.5 rounds to two digits"""
    rows = printed_rows(kind)
    assert set(rows) == {*QUANTITIES, "force"}
    for row in rows.values():
        assert row["largest"] == pytest.approx(expected_maximum(row["sigma"], 1e4, row["T_zero"]), rel=0.02)


def test_the_table_of_the_report_stands_beside_the_computed():
    made = [Statistics("chain", "force", "one leg", 10.0, 7.0, 0.7, 170.0, 100.0, 400.0, 30.0)]
    (row,) = csv.DictReader(beside(made, 1.0).splitlines()[1:])
    assert row["mean_and_largest"] == "570" and row["mean_and_largest_printed"] == "457"
    assert "force 170 + 400 = 570 tonf (printed 457)" in next(told(made))


def test_a_case_is_made_once_and_kept_as_a_study(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["series", "multi-point", "--only", "A-chain-50m", "--hours", "0.1", "--output", "made"]
    assert main(words) == 0
    (row,) = csv.DictReader((tmp_path / "made" / "multi_point.csv").read_text().splitlines()[1:])
    assert 0 < float(row["regular"]) < float(row["irregular"])
    assert float(row["simulated"]) > float(row["simulated_mean"])
    assert 2 < float(row["T_surge_over_period"]) < 10 and float(row["surge_slow_sigma"]) > 0
    kept = {path: path.read_bytes() for path in (tmp_path / "made").rglob("*") if path.suffix in (".csv", ".h5")}
    assert main(words) == 0
    assert all(path.read_bytes() == content for path, content in kept.items())
    assert main([*words[:4], "--seeds", "0"]) == 2 and main(["series", "single-point", "--hours", "1"]) == 2
    assert "--hours is given with single-point; allowed: with multi-point" in capsys.readouterr().err
