"""What three hours of a moored body in time cost, one thread, warm: the parts of a run and how it grows.

    python tests/bench/three_hours.py [--hours 3] [--folder DIR]

The series box in 20 m of water on the twelve chains of `pipelines/scenes/moor_chain_12.toml`: irregular waves
(Hs 4.5 m, mean period 10 s), Newman drift, gusts, current, memory, tolerance 1e-3.  Then the same body on twelve chains
of a catalogue that move, each in 20 elements, for one hour, in still water and in the sea.  Processor time, best of
three.
"""

import argparse
import sys
import tempfile
import time
import warnings
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "bench")]

import numpy as np
from moored_in_time import databases

from hakobune.mooring.environment.gusts import davenport
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.pipelines.moor.study import read_study


def best_of_three(body, weather, settings):
    """(s of processor time, steps)"""
    times = []
    for seed in range(3):
        started = time.process_time()
        run = simulate(body, weather, settings, seed)
        times.append(time.process_time() - started)
    return min(times), run.steps


def cases(folder, hours):
    """(name, seconds, steps, simulated seconds a second)"""
    db = databases(folder)["box 20 m"]
    study, _ = read_study(ROOT / "pipelines" / "scenes" / "moor_chain_12.toml")
    hull, given = study.hull_of(db.dimensions), study.conditions()
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    started = time.process_time()
    body = moored(db, system, hull)
    yield "body, memory, waves: once", time.process_time() - started, 0
    sea = Sea(issc(4.5, mean_period=10.0), given.waves.direction)
    weather = Weather((sea,), None, given.wind, davenport(50.0, 0.003), given.current)
    settings = Settings(3600.0 * hours)
    simulate(body, weather, Settings(20.0, 10.0))  # compile
    half = replace(system, lines=system.lines[::2])
    for name, one, what, how in (
        ("12 chains, memory, drift, gusts", body, weather, settings),
        ("half the time", body, weather, replace(settings, duration=settings.duration / 2)),
        ("6 chains", moored(db, half, hull, memory=body.memory), weather, settings),
        ("no lines", replace(body, system=None, tables=((), ()), spring=0.5 * (body.stiffness - body.reader.stiffness)
                             + 0.5 * (body.stiffness - body.reader.stiffness).T), weather, settings),
        ("constant coefficients", body, weather, replace(settings, memory="constant")),
        ("tolerance 1e-4", body, weather, replace(settings, tolerance=1e-4)),
    ):  # fmt: skip
        yield name, *best_of_three(one, what, how)
    quay, _ = read_study(ROOT / "pipelines" / "scenes" / "simulate_quay.toml")
    berth = quay.berth(quay.hull_of(db.dimensions), db.rotation_center)
    ship = moored(db, memory=body.memory, berth=berth, damping=np.diag([1e5, 3e5, 0, 1e8, 0, 1e8]))
    waves = Weather((Sea(issc(0.8, mean_period=8.0), 0.5 * np.pi),))
    yield "at a quay: 12 ropes, 4 fenders", *best_of_three(ship, waves, settings)
    study, _ = read_study(ROOT / "pipelines" / "scenes" / "moor_catalogue_chain_12.toml")
    chains = study.system(hull, db.rotation_center, db.density, db.gravity)
    moving = moored(db, chains, hull, memory=body.memory), weather
    for name, water in (("one hour of 12 moving chains", "still"), ("in the waves and the current", "sea")):
        yield name, *best_of_three(*moving, Settings(3600.0, dynamic_lines="all", dynamic_water=water))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hours", type=float, default=3.0)
    parser.add_argument("--folder", default=None, help="where the database is kept; a temporary one if not given")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        for name, seconds, steps in cases(arguments.folder or temporary, arguments.hours):
            print(f"{name:36s} {seconds:8.2f} s {steps:8d} steps")
