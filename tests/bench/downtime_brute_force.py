"""Every hour of a record simulated with three seeds, against the interpolant from 200 states: 20 criteria.

    python tests/bench/downtime_brute_force.py box.h5 FOLDER [--hours 2000] [--done N] [--states 200] [--seconds 300]

The body of the database lies on springs.  Criteria are limits on surge, sway, heave, roll and yaw that a fiftieth to a
third of the hours go beyond.  Hours are done one by one and kept in FOLDER, so that the same command goes on.
States are among them, and what they say is compared over the others, whose seeds they have not seen.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem.database import open_database
from hakobune.mooring.downtime.interpolant import fitted, where_it_may_change
from hakobune.mooring.downtime.representative import most_dissimilar
from hakobune.pipelines.downtime import states_file
from hakobune.pipelines.downtime.answers import NORMAL, YEAR
from hakobune.pipelines.downtime.one_state import state
from hakobune.pipelines.downtime.simulated import _features, _weather, prepared_of
from hakobune.pipelines.downtime.study import make_downtime, record_of

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
BEYOND = 0.02, 0.08, 0.18, 0.33  # of the hours, of which the limits are made, to two digits
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
    for row in np.random.default_rng(1).permutation(todo)[: max(0, (asked.done or asked.hours) - len(there))]:
        row, weather = int(row), _weather(read, record, int(row))
        there[row] = {"hour": row, "seeds": state(ready.task, ready.raw, weather,
                                                  [OTHERS + row * SEEDS + k for k in range(SEEDS)])}  # fmt: skip
        states_file.append(path, there[row])
    took = time.perf_counter() - begun
    rows = sorted(there)
    print(f"{len(rows)} hours of {asked.seconds:g} s, {SEEDS} seeds each: {took:.0f} s")
    value = {name: np.array([[one[name]["largest"] for one in there[row]["seeds"]] for row in rows])
             for name in QUANTITIES}  # fmt: skip
    limits = [(name, float(f"{np.quantile(value[name], 1 - share):.2g}")) for name in QUANTITIES for share in BEYOND]
    compared(limits, value, *_features(record.hindcast, np.array(rows)), asked.states)


def compared(limits, value, x, height, states):
    """Interpolants from so many of the hours, half of them where verdicts are open, beside all other hours"""
    begun, used = time.perf_counter(), [value[name] / limit for name, limit in limits]
    chosen = most_dissimilar(x, states // 2, np.argmax(height))
    fits = [fitted(x[chosen], height[chosen], one[chosen]) for one in used]
    free = np.ones(len(x), bool)
    for k in range(0, len(limits), 2):
        mean, error = fits[k].predict(x, height)
        more = where_it_may_change(x, mean, error, fits[k].scatter, free, states // len(limits), x[chosen])
        chosen = np.union1d(chosen, more)
    others = np.setdiff1d(np.arange(len(x)), chosen)
    inside = np.zeros((len(limits), 2), bool)
    for k, (name, limit) in enumerate(limits):
        fit = fitted(x[chosen], height[chosen], used[k][chosen])
        mean, error = fit.predict(x[others], height[others])
        size = YEAR / len(others)
        spread, sea = (size * one for one in fit.spread_of_sum(x[others], height[others], mean, error, free[others]))
        hours, stopped = size * fit.chance(mean, error).sum(), YEAR * (used[k][others] > 1).mean(axis=0)
        for j, (truth, of_sea) in enumerate(((stopped[0], sea), (stopped.mean(), sea / np.sqrt(len(stopped))))):
            inside[k, j] = abs(truth - hours) <= NORMAL * np.hypot(spread, of_sea)
        words = ", mean ".join("inside" if one else "OUTSIDE" for one in inside[k])
        print(
            f"{name:6} ≤ {limit:7.3g}: {hours:6.0f} h a year ± {NORMAL * spread:4.0f} interpolant "
            f"± {NORMAL * sea:4.0f} sea; every hour: {', '.join(f'{one:.0f}' for one in stopped)} {words}"
        )
    print(
        f"{len(chosen)} states, {len(others)} other hours, {time.perf_counter() - begun:.0f} s; inside: "
        f"{inside[:, 0].sum()} of {len(limits)} by one seed, {inside[:, 1].sum()} by the mean of {SEEDS}"
    )


if __name__ == "__main__":
    main()
