"""A simulation of floater A beside the SR179 report's own, Table 3.5.5.5, row by row with ratios.

    hakobune simulate pipelines/scenes/simulate_chain_12.toml --database box_20m.h5 --output run.h5
    python tests/bench/report_simulation.py run.h5 [chain|buoy|sinker]

X_1000 is the report's formula for ours too, as the mean over runs.  The line is the one with the largest mean + X_1000.
Means are compared by size: the report counts them towards the waves' origin.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from pipelines.common.units import TONF
from pipelines.simulate.file import SUMMARY, opened

TABLE = Path(__file__).parents[1] / "published" / "simulation_statistics.csv"
COLUMNS = {"T_zero_s": "T_zero", "T_pp_s": "T_peak", "eps": "epsilon", "mean": "mean", "sigma": "sigma",
           "significant_amp": "mean_third", "X_1000": "extreme"}  # fmt: skip
SCALED = ("mean", "sigma", "significant_amp", "X_1000")


def printed(line_type):
    """Rows of the table for a kind of line"""
    lines = (line for line in TABLE.read_text(encoding="utf-8").splitlines() if line[0] != "#")
    return [row for row in csv.DictReader(lines) if row["line_type"] == line_type]


def ours(file, quantity):
    """{statistic: value} in the table's units, of a motion or of the line with the largest mean + X_1000"""
    names = list(file["quantity"].asstr()[()])
    values = [dict(zip(SUMMARY, row, strict=True)) for row in file["summary"][()]]
    if quantity in names:
        return values[names.index(quantity)], 1.0
    tensions = [value for name, value in zip(names, values, strict=True) if name.startswith("tension")]
    return max(tensions, key=lambda value: value["mean"] + value["extreme"]), 1 / TONF


def main(path, line_type="chain"):
    print(f"{'':18}" + "".join(f"{name:>26}" for name in COLUMNS))
    with opened(path) as file:
        for row in printed(line_type):
            value, factor = ours(file, row["quantity"])
            cells = []
            for name, key in COLUMNS.items():
                mine = value[key] * (factor if name in SCALED else 1.0)
                theirs = float(row[name]) if row[name] else np.nan
                ratio = abs(mine / theirs) if theirs else np.nan
                cells.append(f"{theirs:9.4g}{mine:10.4g}{ratio:7.2f}")
            print(f"{row['quantity']:18}" + "".join(cells))


if __name__ == "__main__":
    main(*sys.argv[1:])
