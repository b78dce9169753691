"""Compiling of kernels ahead of their use: all kernels by small studies in a temporary folder, or those of a running
command by a second process.

`hakobune doctor --compile` compiles all kernels ahead.  A command whose kernels are missing starts a second process,
which runs this module and compiles the kernels that the command needs last (`executors.beside`).
"""

import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .executors.beside import environment, processors

SCENES = Path(__file__).parent / "scenes"
BOX = ("--database", "box.h5")
# runs that compile most kernels of each study: the rows of a table one after another, both tables in parallel
LINES = (
    ("one line", "line", "--weight", "4000", "--stiffness", "2e6", "--length", "260", "--depth", "20", "--span", "240"),
    ("a system of lines", "lines", SCENES / "lines_barge.toml"),
    ("a line in motion", "line-dynamics", SCENES / "line_chain_and_wire.toml", "--duration", "24"),
    ("a body on a buoy", "single-point", SCENES / "single_point_tanker.toml"),
)
BODIES = (
    ("a body by contours", "solve", SCENES / "series_box_20m.toml", "--method", "contour", "--output", "contour.h5"),
    ("a body by panels", "solve", SCENES / "series_box_20m.toml", "--output", "box.h5"),
    ("a moored body", "moor", SCENES / "moor_chain_12.toml", *BOX),
    ("a moored body in time", "simulate", SCENES / "simulate_chain_12.toml", *BOX,
     "--output", "run.h5", "--seeds", "1", "--duration", "60"),
)  # fmt: skip
SHORT = 18.0  # s, of runs that only compile: two cycles of the chain of 315 m


def compile_all(tables=(LINES, BODIES)):
    """Run the commands of tables, each in a process, and print progress.  Returns failures, one line each"""
    count, done, begin = sum(map(len, tables)), [], time.monotonic()

    def run(table, folder):
        said = []
        for name, *words in table:
            command = [sys.executable, "-m", "hakobune", *map(str, words)]
            ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment())
            done.append(name)
            print(f"  {len(done)} of {count} {name:<24}{time.monotonic() - begin:5.0f} s", flush=True)
            if ended.returncode not in (0, 1):  # 1 is a verdict
                told = ended.stderr.strip().splitlines() or ["no message"]
                said.append(f"the kernels of {name} could not be compiled: {told[-1]}")
        return said

    print("compiling kernels, by studies")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(min(len(tables), processors())) as pool:
        return [line for said in pool.map(run, tables, [folder] * len(tables)) for line in said]


def _of_line_dynamics(study):
    """Steps of the line of a study, from a straight line in place of its shape at rest, for which the command compiles
    the forces meanwhile"""
    import numpy as np

    from hakobune.mooring.lines.dynamics.lumped.esdirk import compile_steps
    from hakobune.mooring.lines.dynamics.lumped.system import State
    from hakobune.mooring.lines.dynamics.simulation import simulate

    from .line_dynamics.motion import course_of
    from .line_dynamics.parts import current_of, line_of, wave_of
    from .line_dynamics.study import read_line_dynamics

    read = read_line_dynamics(study)[0]
    line, course = line_of(read)[0], course_of(read, Path(study).parent)
    compile_steps(line.system)
    along = (line.nodes / line.length)[:, None]
    place = (1 - along) * line.anchor + along * course.motion.at(0.0)[0]
    zero = np.zeros_like(place)
    start = State(0.0, place, zero, zero.copy(), zero.copy(), np.inf)
    simulate(line, course.motion, SHORT, start=start, current=current_of(read), waves=wave_of(read, None))


def _of_moving_line(study):
    """Steps of the line of a study in still water, alone and with a body"""
    import numpy as np

    from hakobune.mooring.lines.dynamics.lumped.esdirk import compile_steps
    from hakobune.mooring.motion.moving_lines.steps import compile_moving

    from .line_dynamics.parts import line_of
    from .line_dynamics.study import read_line_dynamics

    read = read_line_dynamics(study)[0]
    line = line_of(read)[0]
    compile_steps(line.system)
    compile_moving(line, np.asarray(read.fairlead.position, float))


def _of_simulate(study, database):
    """Pairs of waves of a study, a line in motion, and a short run whose lines all move"""
    from msgspec.structs import replace

    from .moor.study import SimulationTable
    from .results.given import database_of
    from .simulate.result import simulate
    from .simulate.run import input_of
    from .simulate.study import moving_lines, plan_of
    from .simulate.work import with_pairs

    read, _, folder, _ = input_of(study)
    db, table = database_of(database), read.simulation or SimulationTable()
    if not (db.bodies or db.modes):
        reader = db.bodies_reader
        with_pairs(plan_of(read, reader.omega, 1, SHORT, folder, reader.words), read, db, reader)
    if (read.lines or read.spreads) and moving_lines(table):
        (_of_line_dynamics if table.dynamic_water == "sea" else _of_moving_line)(SCENES / "line_chain_60m.toml")
        simulate(replace(read, simulation=replace(table, dynamic_lines="all")), db, seeds=1, duration=SHORT)


OF_COMMANDS = {"simulate": _of_simulate, "line-dynamics": _of_line_dynamics}


if __name__ == "__main__":
    OF_COMMANDS[sys.argv[1]](*sys.argv[2:])
