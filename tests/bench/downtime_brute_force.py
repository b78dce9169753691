"""Every hour of a record simulated with three seeds, against the interpolant from 200 states: 20 criteria.

    python tests/bench/downtime_brute_force.py box.h5 FOLDER [--hours 2000] [--done N] [--states 200] [--seconds 300]

The body of the database lies on springs.  Criteria are limits on surge, sway, heave, roll and yaw that a fiftieth to a
third of the hours go beyond.  Hours are done one by one and kept in FOLDER, so that the same command goes on.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem.database import open_database
from hakobune.pipelines.downtime import states_file
from hakobune.pipelines.downtime.answers import NORMAL, YEAR
from hakobune.pipelines.downtime.limits import limits_of
from hakobune.pipelines.downtime.one_state import UNITS, state
from hakobune.pipelines.downtime.simulated import _weather, prepared_of, simulated
from hakobune.pipelines.downtime.study import make_downtime, record_of
from hakobune.pipelines.executors.choice import Here

SCENES = Path(__file__).parents[2] / "pipelines" / "scenes"
MOORED = """\
[water]
depth = 20.0
[hull]
length = 100.0
beam = 50.0
draft = 10.0
freeboard = 10.0
[simulation]
duration = 300
ramp = 100
qtf = "newman"
wave_drift_damping = false
spring = { surge = 3000.0, sway = 3000.0, yaw = 3.0e6 }
damping_ratio = { roll = 0.05 }
linear_damping = { surge = 600.0, sway = 600.0, yaw = 6.0e5 }
"""
QUANTITIES = "surge", "sway", "heave", "roll", "yaw"
BEYOND = 0.02, 0.08, 0.18, 0.33  # of the hours, by the first seed
SEEDS = 3
OTHERS = 10_000_000  # seeds of every hour, beside those of the states


def study(limits, asked):
    waves = {"height": "hs", "peak_period": "tp", "direction_from": "from", "spreading": "cosine:4"}
    return make_downtime({
        "hindcast": {"file": "h.csv", "x_axis_compass_deg": 60.0, "waves": [waves]},
        "simulation": {"study": "moored.toml", "states": asked.states // 2, "most_states": asked.states, "batch": 50,
                       "seeds": SEEDS, "duration_hours": asked.seconds / 3600, "tolerance_hours": 1e-3},
        "operations": [{"name": f"{name} {limit:.3g}", "limits": [{"quantity": name, "at_most": limit}]}
                       for name, limit in limits],
    })  # fmt: skip


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("database")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--hours", type=int, default=2000)
    parser.add_argument("--done", type=int, help="compare over so many of the hours, drawn by chance")
    parser.add_argument("--states", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=300.0)
    asked = parser.parse_args()
    asked.folder.mkdir(exist_ok=True)
    lines = (SCENES / "downtime_hindcast.csv").read_text().splitlines()[1:]
    (asked.folder / "h.csv").write_text("\n".join(lines[: asked.hours + 1]) + "\n")
    (asked.folder / "moored.toml").write_text(MOORED)
    db, read = open_database(asked.database), study([("roll", 1.0)], asked)
    record, ready = record_of(read.hindcast, asked.folder), prepared_of(read.simulation, asked.folder, db)
    path, begun = asked.folder / "every_hour.jsonl", time.perf_counter()
    there = states_file.read(path, f"every hour {asked.seconds:g} s")
    todo = [row for row in range(len(record.hindcast.time)) if row not in there]
    for row in np.random.default_rng(1).permutation(todo)[: max(0, (asked.done or len(todo)) - len(there))]:
        row, weather = int(row), _weather(read, record, int(row))
        there[row] = {"hour": row, "seeds": state(ready.task, ready.raw, weather,
                                                  [OTHERS + row * SEEDS + k for k in range(SEEDS)])}  # fmt: skip
        states_file.append(path, there[row])
    took = time.perf_counter() - begun
    rows = sorted(there)
    print(f"{len(rows)} hours of {asked.seconds:g} s, {SEEDS} seeds each: {took:.0f} s")
    value = {name: np.array([[one[name]["largest"] for one in there[row]["seeds"]] for row in rows])
             for name in QUANTITIES}  # fmt: skip
    limits = [(name, float(np.quantile(value[name][:, 0], 1 - share))) for name in QUANTITIES for share in BEYOND]
    read, begun = study(limits, asked), time.perf_counter()
    judged = limits_of(read, [], {}, {name: UNITS[name] for name in ready.names})
    found = simulated(
        read, record, judged, ready, asked.folder / f"states_{asked.states}.jsonl", Here(), lambda line: None
    )
    print(f"interpolant of {len(found.rows)} states: {time.perf_counter() - begun:.0f} s")
    inside = np.zeros((len(limits), 2), bool)
    for k, (name, limit) in enumerate(limits):
        stopped, chance = YEAR * (value[name] > limit).mean(axis=0), found.verdicts.chance[rows, k]
        hours, of_sea = YEAR * chance.mean(), YEAR * np.sqrt(np.sum(chance * (1 - chance))) / len(rows)
        for j, (truth, sea) in enumerate(((stopped[0], of_sea), (stopped.mean(), of_sea / np.sqrt(SEEDS)))):
            inside[k, j] = abs(truth - hours) <= NORMAL * np.hypot(found.error[k], sea)
        print(f"{name:6} ≤ {limit:7.3g}: {hours:6.0f} h a year ± {NORMAL * found.error[k]:4.0f} interpolant "
              f"± {NORMAL * of_sea:4.0f} sea; every hour: {', '.join(f'{one:.0f}' for one in stopped)} "
              f"{'inside' if inside[k, 0] else 'OUTSIDE'}, mean {'inside' if inside[k, 1] else 'OUTSIDE'}")  # fmt: skip
    print(f"inside: {inside[:, 0].sum()} of {len(limits)} by one seed, {inside[:, 1].sum()} by the mean of {SEEDS}")


if __name__ == "__main__":
    main()
