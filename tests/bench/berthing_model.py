"""Berthing of Ueda's model tanker by memory, beside his measured virtual masses: python tests/bench/berthing_model.py

A box of the model's length, beam and draft (C_B 1 for 0.902) in open water of its depth, sway and yaw, contact where
C_e is 0.7 (not printed); structures A, B, C stood 20, 130, 200 cm before a wall.  Bands are (α ± deviation)² over them.
"""

import argparse
import contextlib
import csv
import io
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune.bem.database import open_database
from hakobune.mooring.berthing.energy import offset_of
from hakobune.mooring.berthing.memory import berth, ship_of_database
from hakobune.mooring.fenders.fender import fender_of_points
from hakobune.pipelines import cli

TABLE = Path(__file__).parents[1] / "published" / "berthing_model.csv"
LENGTH, BEAM, DEPTH, SPEED, SHARE = 7.289, 1.32, 0.65, 0.014, 0.7
SPRINGS = {"X": 12.8 * 980.665, "Y": 25.0 * 980.665}  # N/m
RATIOS = (1.1, 1.25, 1.5, 2.0, 2.5)
LEAST = 0.25  # distance from the bands that is allowed


def rows_of(ratio, spring):
    rows = csv.DictReader(line for line in TABLE.read_text().splitlines() if line[0] != "#")
    return [row for row in rows if float(row["depth_over_draft"]) == ratio and row["case"][1] == spring]


def measured_bands(ratio, spring):
    """Lowest and highest (α ± deviation)² of the structures"""
    alpha, deviation = np.array([[float(r["alpha"]), float(r["deviation"])] for r in rows_of(ratio, spring)]).T
    return float(((alpha - deviation) ** 2).min()), float(((alpha + deviation) ** 2).max())


def virtual_masses_of(ratio, folder, tolerance=0.02):
    """{spring: C_M} of the box with the mean draft of the structures at a depth over draft"""
    draft = np.mean([float(row["draft_cm"]) for row in rows_of(ratio, "X")]) / 100
    path = Path(folder) / f"model_{ratio}.h5"
    words = f"box --length {LENGTH} --beam {BEAM} --draft {draft:.4f} --depth {DEPTH} --omega auto:0.2:8 --density 1000"
    with contextlib.redirect_stdout(io.StringIO()):
        status = cli.main([*words.split(), "--only", "radiation", f"--tolerance={tolerance}", "--output", str(path)])
    assert status == 0
    gyration = LENGTH / 4
    ship = ship_of_database(open_database(path), 1000 * LENGTH * BEAM * draft, gyration, tolerance=0.01)
    out = {}
    for name, stiffness in SPRINGS.items():
        spring = fender_of_points(name, 1.0, [0.0, 1.0], [0.0, stiffness])
        out[name] = berth(ship, [(spring, offset_of(SHARE, gyration), 0.0)], SPEED, steps=400).virtual_mass
    return out


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__).parse_args()
    print("H/d   spring  C_M by memory  measured A B C       band        distance")
    worst, found = 0.0, {}
    with tempfile.TemporaryDirectory() as folder:
        for ratio in RATIOS:
            found[ratio] = virtual_masses_of(ratio, folder)
            for spring, value in found[ratio].items():
                low, high = measured_bands(ratio, spring)
                off = max(low / value - 1, value / high - 1, 0.0)
                worst = max(worst, off)
                squares = " ".join(f"{float(r['alpha']) ** 2:.2f}" for r in rows_of(ratio, spring))
                print(
                    f"{ratio:4}  {spring:6}  {value:12.3f}   {squares:18}  {low:.2f} to {high:.2f}  {100 * off:5.1f} %"
                )
    falls = all(found[a][s] > found[b][s] for s in SPRINGS for a, b in pairwise(RATIOS))
    print(f"farthest from a band: {100 * worst:.1f} %; C_M falls with H/d: {falls}")
    sys.exit(worst > LEAST or not falls)
