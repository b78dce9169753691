"""`hakobune doctor --compile`: compile every kernel ahead, by small studies in a temporary folder."""

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

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


def compile_all(tables=(LINES, BODIES)):
    """Run the commands of tables, each in a process, and print progress.  Returns failures, one line each"""
    count, done, begin = sum(map(len, tables)), [], time.monotonic()

    def run(table, folder):
        said = []
        for name, *words in table:
            command = [sys.executable, "-m", "hakobune", *map(str, words)]
            ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=_environment())
            done.append(name)
            print(f"  {len(done)} of {count} {name:<24}{time.monotonic() - begin:5.0f} s", flush=True)
            if ended.returncode not in (0, 1):  # 1 is a verdict
                told = ended.stderr.strip().splitlines() or ["no message"]
                said.append(f"the kernels of {name} could not be compiled: {told[-1]}")
        return said

    print("compiling kernels, by studies")
    processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(min(len(tables), processors)) as pool:
        return [line for said in pool.map(run, tables, [folder] * len(tables)) for line in said]


def _environment():
    """Environment in which these processes find this package"""
    root = Path(__file__).parents[1]
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, (str(root), os.environ.get("PYTHONPATH"))))}
