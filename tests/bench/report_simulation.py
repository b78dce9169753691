"""A simulation of floater A beside the SR179 report's own, Table 3.5.5.5, row by row with ratios.

    cp pipelines/scenes/simulate_chain_12.toml report.toml  # [simulation] stands at its end
    printf 'memory = "constant"\ndynamic_lines = "none"\nqtf = "newman"\n' >> report.toml
    hakobune simulate report.toml --database box_20m.h5 --output run.h5
    python tests/bench/report_simulation.py run.h5 [chain|buoy|sinker]

X_1000 is the report's formula for ours too, as the mean over runs.  The line is the one with the largest mean + X_1000.
Means are compared by size: the report counts them towards the waves' origin.

The last lines are the tension of the same motions, of all six and of surge, sway and yaw alone.  Largest line force of
the chain, mean + X_1000, tonf, five runs: report 457; here 861, of horizontal motions 763.  In waves with a mean period
of 8.5 s, in which the zero-crossing periods and deviations of surge, sway, roll and yaw are the report's within a fifth
(at 10 s they are up to 1.8 times as large): 715, of horizontal motions 549.
"""

import csv
import sys
import tomllib
from pathlib import Path

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.motion.line_loads import body_lines, line_work, tensions_along
from hakobune.mooring.motion.statistics import record_statistics
from hakobune.pipelines.common.units import TONF
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.file import SUMMARY, opened

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


def by_motions(file, kept):
    """(lines, 2) mean and X_1000 in tonf, over the stored records, of tensions at the motions `kept` and no other"""
    study, db = make_study(tomllib.loads(file.attrs["study"])), open_database(file.attrs["database"])
    system = study.system(study.hull_of(db.dimensions), db.rotation_center, db.density, db.gravity)
    lines, step, rows = body_lines(system), float(np.diff(file["time"][:2])[0]), []
    for record in file["motion"][()].astype(float):
        place, tension = np.zeros_like(record), np.zeros((len(record), len(lines.lost)))
        place[:, kept] = record[:, kept]
        tensions_along(lines, line_work(lines), file["time"][()], place[:, None], tension)
        given = step, float(file.attrs["split_frequency"]), 1000 * float(file.attrs["mean_period"])
        rows.append([[(one := record_statistics(x / TONF, *given)).mean, one.extreme] for x in tension.T])
    return np.mean(rows, axis=0)


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
        for name, kept in (("all motions", range(6)), ("surge, sway and yaw", (0, 1, 5))):
            mean, extreme = max(by_motions(file, list(kept)), key=sum)
            print(f"largest line force at {name}: {mean:.0f} + {extreme:.0f} = {mean + extreme:.0f} tonf")


if __name__ == "__main__":
    main(*sys.argv[1:])
