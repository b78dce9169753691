"""The same scene gives the same database to the last bit, wall times apart."""

import os
import subprocess
import sys

import h5py
import pytest

SCENE = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.4,0.9 --heading 0,37,90 --gyration 15,29,32"
MADE = """
import sys
from pipelines.cli import main
scene, name = sys.argv[1:]
for method, size in (("contour", "--tolerance 0.01"), ("panel", "--panels 250")):
    assert main(f"{scene} --method {method} {size} --output {name}_{method}.h5".split()) == 0
"""


def made(name, threads):
    """Solved in a process of its own"""
    numbers = dict.fromkeys(("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), str(threads))
    command = [sys.executable, "-c", MADE, SCENE, str(name)]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **numbers})
    assert done.returncode == 0, done.stderr


def contents(path):
    """{name: value} of every dataset and attribute but the wall times"""
    found = {}

    def note(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = (item.dtype.str, item.shape, repr(item[()]) if item.dtype.kind == "O" else item[()].tobytes())
        for key, value in item.attrs.items():
            if key not in ("REFERENCE_LIST", "DIMENSION_LIST"):  # addresses in the file
                found[f"{name}@{key}"] = repr(value)

    with h5py.File(path) as file:
        note("", file)
        file.visititems(note)
    return {name: value for name, value in found.items() if not name.startswith("wall_time")}


@pytest.mark.parametrize("threads", [1, 2])
def test_a_scene_gives_the_same_database_twice(threads, tmp_path):
    for name in "ab":
        made(tmp_path / name, threads)
    for method in ("contour", "panel"):
        one, other = (contents(tmp_path / f"{name}_{method}.h5") for name in "ab")
        assert one.keys() == other.keys()
        assert "added_mass" in one and "drift_force" in one
        differing = [key for key in one if one[key] != other[key]]
        assert not differing, (method, differing)
