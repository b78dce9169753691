"""Tables of sections in the report's order, and the command that writes them."""

import csv
import io

import numpy as np
import pytest
import xarray

import hakobune
from hakobune.bem.sections.tables import COLUMNS, table_name, tables
from hakobune.pipelines.cli import main
from hakobune.pipelines.sections.command import csv_text


def test_the_twenty_tables_come_in_the_order_of_the_report():
    names = [
        table_name({"H_over_d": H, "B_over_d": B}) for H in (1.2, 1.4, 2.0, 3.0, 10.0) for B in (5.0, 10.0, 15.0, 20.0)
    ]
    assert names == [f"2.1.3.{i}" for i in range(1, 21)]
    assert table_name({"H_over_d": 2.0, "B_over_d": 6.0}) == ""


def test_rows_run_over_frequency_first_then_beam_then_depth():
    told = []
    rows = tables((5.0, 6.0), (1.4, np.inf), (0.5, 1.0), tolerance=1e-3, progress=lambda: told.append(1))
    assert len(told) == len(rows) == 8
    order = [(row["H_over_d"], row["B_over_d"], row["xi_B"]) for row in rows]
    assert order == [(H, B, x) for H in (1.4, np.inf) for B in (5.0, 6.0) for x in (0.5, 1.0)]
    text = [line for line in csv_text(rows, 1e-3).splitlines() if not line.startswith("#")]
    read = list(csv.DictReader(io.StringIO("\n".join(text))))
    assert [row["table"] for row in read] == ["2.1.3.5"] * 2 + [""] * 6
    assert list(read[0])[1:] == list(COLUMNS)
    assert float(read[3]["M_H"]) == pytest.approx(rows[3]["M_H"], rel=1e-6)


def test_the_command_writes_the_same_numbers_as_text_and_as_hdf5(tmp_path):
    flags = ["--beam-draft", "5,10", "--depth-draft", "1.4", "--xi", "0.5:1.5:3", "--tolerance", "1e-4"]
    for name in ("a.csv", "a.h5"):
        assert main(["sections", *flags, "--output", str(tmp_path / name)]) == 0
    lines = (line for line in (tmp_path / "a.csv").read_text().splitlines() if not line.startswith("#"))
    text = list(csv.DictReader(lines))
    made = hakobune.read(tmp_path / "a.h5")
    assert made["M_H"].shape == (1, 2, 3) and made.quantity("M_H").axes == ("H_over_d", "B_over_d", "xi_B")
    assert made == hakobune.sections(beam_draft=[5, 10], depth_draft=[1.4], xi=[0.5, 1.0, 1.5], tolerance=1e-4)
    with xarray.open_dataset(tmp_path / "a.h5", engine="h5netcdf") as data:
        assert data["M_H"].sel(H_over_d=1.4, B_over_d=10, xi_B=0.5) == made["M_H"][0, 1, 0]
    for name in COLUMNS[3:]:
        degrees = name.endswith("_deg")
        values = np.degrees(made[name.removesuffix("_deg")]) if degrees else made[name]
        assert [float(row[name]) for row in text] == pytest.approx(values.ravel(), rel=1e-6)


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--depth-draft", "0.9"], "depth-draft is 0.9; allowed: above 1, or inf"),
        (["--beam-draft", "0", "--depth-draft", "2", "--xi", "1"], "beam-draft is 0; allowed: above 0, finite"),
        (["--xi", "-1"], "xi is -1; allowed: above 0, finite"),
        (["--output", "a.txt"], "allowed suffixes: .csv, .h5"),
        (["--output", "nowhere/a.csv"], "the folder nowhere does not exist"),
        (["--beam-draft", "wide"], "--beam-draft is 'wide'; allowed: a,b,c or start:stop:count"),
        (["--tolerance", "0"], "tolerance is 0; allowed: 1e-08 to below 1"),
    ],
)
def test_what_cannot_be_tabulated_is_one_line(flags, said, capsys):
    assert main(["sections", *flags]) == 2
    line = capsys.readouterr().err
    assert said in line
    assert line.count("\n") == 1
