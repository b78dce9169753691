"""Processor time of the whole job for twenty modules of an airport, or any number, beside that for one.

    python tests/bench/twenty_modules.py 20

Boxes of 100 × 25 × 4 m in a row, 5 m apart in 20 m of water, twenty periods and three headings, without gyration.  Each
job is a process of its own, and both run in turns.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

PITCH, TURNS = 105.0, 3
HEAD = """tolerance = 0.01
[water]
depth = 20.0
[waves]
periods = { from = 6.0, to = 16.0, count = 20 }
headings_deg = [0, 45, 90]
"""
BODY = '[[bodies]]\nshape = "box"\nlength = 100.0\nbeam = 25.0\ndraft = 4.0\n'


def scene(count):
    """Text of a scene of so many modules"""
    if count == 1:
        return HEAD + BODY
    return HEAD + "".join(f'{BODY}name = "m{i:02d}"\nplace = [{PITCH * i}, 0.0, 0.0]\n' for i in range(count))


def seconds(path):
    """Processor time of `hakobune solve`"""
    before = os.times()
    command = [
        sys.executable,
        "-m",
        "hakobune",
        "solve",
        str(path),
        "--output",
        str(path.with_suffix(".h5")),
        "--fresh",
    ]
    subprocess.run(command, check=True, capture_output=True)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for count in (1, int(sys.argv[1])):
            paths.append(Path(folder) / f"m{count}.toml")
            paths[-1].write_text(scene(count))
        for _ in range(TURNS):
            one, many = map(seconds, paths)
            print(f"one {one:.2f} s, {sys.argv[1]} {many:.2f} s, {many / one:.1f} times")
