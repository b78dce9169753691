"""Twelve chains that move with a body, beside MoorDyn 2.7.2 driven with the same courses of their fairleads.

    python tests/bench/moving_chains.py PYTHON_WITH_MOORDYN [--minutes 10] [--height 4.5] [--elements 20] [--folder DIR]

The scene of `three_hours.py` (series box, 20 m of water, chains of 142 mm, still water).  Ours is the
whole run, body and memory of the water included; MoorDyn has the lines alone, on the bed that ours have, at the step
that its stability allows.  One thread each, processor time, one after the other.
"""

import argparse
import json
import subprocess
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
from scipy.interpolate import CubicSpline

from hakobune.mooring.environment.gusts import davenport
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.formats.moordyn import write_moordyn
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.motion.moving_lines.prepare import FIRM, ends_of
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.pipelines.moor.study import read_study

EVERY = 0.05  # s, from one place given to MoorDyn to the next
PEER = """
import json, sys, time
import moordyn, numpy as np
file, course = sys.argv[1], np.load(sys.argv[2])
system = moordyn.Create(file)
moordyn.Init(system, course["place"][0].tolist(), course["speed"][0].tolist())
lines = [moordyn.GetLine(system, i + 1) for i in range(int(sys.argv[3]))]
begun, pulls, dt = time.process_time(), [], float(sys.argv[4])
for i, (place, speed) in enumerate(zip(course["place"], course["speed"])):
    moordyn.Step(system, place.tolist(), speed.tolist(), i * dt, dt)
    pulls.append([moordyn.GetLineFairTen(line) for line in lines])
seconds = time.process_time() - begun
np.save(sys.argv[5], pulls)
print("\\n" + json.dumps(seconds))
"""


def scene(folder, height):
    """(Moored, Weather, System)"""
    db = databases(folder)["box 20 m"]
    scenes = ROOT / "pipelines" / "scenes"
    given = read_study(scenes / "moor_chain_12.toml")[0].conditions()
    study, _ = read_study(scenes / "moor_catalogue_chain_12.toml")
    hull = study.hull_of(db.dimensions)
    system = study.system(hull, db.rotation_center, db.density, db.gravity)
    weather = Weather(
        (Sea(issc(height, mean_period=10.0), given.waves.direction),), None, given.wind, davenport(50.0, 0.003)
    )
    return moored(db, system, hull), weather, system


def ours(body, weather, settings):
    """(Realisation, s of processor time)"""
    simulate(body, weather, replace(settings, duration=20.0, ramp=10.0))  # compile
    started = time.process_time()
    run = simulate(body, weather, settings)
    return run, time.process_time() - started


def courses(run, body, system):
    """Times, places (n, 3 lines) m and speeds m/s of the fairleads, in the order of the lines."""
    at = np.array([ends_of(line, system)[1].position for line in system.lines], float)
    centre = np.asarray(system.bodies[0].position[:3], float)
    moved = run.motion + body.start
    places = np.array([centre + m[:3] + at @ rotation(*m[3:]).T for m in moved]).reshape(len(moved), -1)
    spline, times = CubicSpline(run.time, places), np.arange(run.time[0], run.time[-1], EVERY)
    return times, spline(times), spline(times, 1)


def theirs(python, system, places, speeds, folder, elements):
    """(n, lines) N of MoorDyn and its s of processor time"""
    lines = tuple(replace(line, elements=elements) for line in system.lines)
    file = moordyn_of_system(replace(system, lines=lines))
    order = {end: i for i, line in enumerate(file.lines) for end in (line.a, line.b)}
    free = [point.id for point in file.points if point.attachment.startswith("Body")]

    def placed(point):
        if point.id not in free:
            return point
        x, y, z = places[0, 3 * order[point.id] :][:3].tolist()
        return point._replace(attachment="Coupled", x=x, y=y, z=z)

    rows = tuple(placed(point) for point in file.points)
    options = file.options | {"kBot": repr(FIRM["stiffness"]), "cBot": repr(FIRM["damping"])}
    write_moordyn(replace(file, points=rows, bodies=(), options=options), folder / "lines.txt")
    columns = np.concatenate([3 * order[number] + np.arange(3) for number in free])
    np.savez(folder / "course.npz", place=places[:, columns], speed=speeds[:, columns])
    words = [folder / "lines.txt", folder / "course.npz", len(lines), EVERY, folder / "pulls.npy"]
    done = subprocess.run(
        [python, "-c", PEER, *map(str, words)], capture_output=True, text=True, check=True, cwd=folder
    )
    return np.load(folder / "pulls.npy"), json.loads(done.stdout.splitlines()[-1]), file.options["dtM"]


def main(options, folder):
    body, weather, system = scene(options.folder or folder, options.height)
    settings = Settings(60.0 * options.minutes, step=0.1, dynamic_lines="all", dynamic_elements=options.elements)
    run, seconds = ours(body, weather, settings)
    times, places, speeds = courses(run, body, system)
    pulls, peer, step = theirs(options.python, system, places, speeds, Path(folder), options.elements)
    simulated = run.time[-1] - run.time[0]
    whole = settings.duration + settings.ramp
    print(f"ours {1e3 * seconds / whole:.2f} ms a simulated second, body included")
    print(f"MoorDyn {1e3 * peer / simulated:.2f} ms a simulated second, dtM {step} s")
    settled = times > times[0] + 60.0
    print(f"{'line':20} {'σ kN':>8} {'MoorDyn':>8} {'largest':>9} {'MoorDyn':>9}")
    for i, name in enumerate(system.line_names):
        own, other = run.tension[run.time > times[0] + 60.0, i] / 1e3, pulls[settled, i] / 1e3
        print(f"{name:20} {own.std():8.1f} {other.std():8.1f} {own.max():9.0f} {other.max():9.0f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("python")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--height", type=float, default=4.5, help="m, of the waves")
    parser.add_argument("--elements", type=int, default=20, help="of each line")
    parser.add_argument("--folder", default=None, help="where the database is kept; a temporary one if not given")
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        main(parser.parse_args(), temporary)
