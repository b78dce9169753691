"""`hakobune series lines`: the statements of section 3.1.7 of the SR179 report (1982) on charts 1.7.1 to 1.7.6."""

import csv

import numpy as np

from hakobune.pipelines import cli


def test_every_statement_of_the_report_on_its_charts_is_so_here(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["series", "lines", "--output", "made"]) == 0
    told = capsys.readouterr().out.splitlines()
    assert sum(line.endswith(": so here") for line in told) == 7 and not any("NOT" in line for line in told)
    with open("made/lines.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["chart"] for row in rows} == {f"1.7.{i}" for i in range(1, 7)}
    values = np.array([float(row["anchor_t_over_wl"] or row["fairlead_t_over_wl"]) for row in rows])
    assert np.all(np.isfinite(values)) and np.all(values >= 0)
    assert (tmp_path / "made" / "lines.png").stat().st_size > 1e4
