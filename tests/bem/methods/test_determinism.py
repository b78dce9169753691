"""The same scene gives the same database to the last bit, wall times apart."""

import os
import subprocess
import sys

import h5py

from hakobune.bem.kernels.threads import UNKNOWNS_WORTH_THREADS
from hakobune.meshing.shapes import box
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.large import PER_PANEL, shared_band

SCENE = "box --length 100 --beam 50 --draft 10 --depth 20 --heading 0,37,90 --gyration 15,29,32"
RUNS = {
    "contour": "--method contour --tolerance 0.01 --omega 0.4,0.9",
    "panel": "--method panel --panels 250 --omega 0.4,0.9",
    # frequencies that share their work (`pipelines.solve.large`), in systems that are worth two threads
    # (`bem.kernels.threads`)
    "band": "--method panel --panels 800 --omega 0.4:1.0:25 --only added_mass,excitation_force",
}
MADE = """
import sys
from hakobune.pipelines.cli import main
for command in sys.argv[1:]:
    assert main(command.split()) == 0
"""


def test_one_run_shares_its_work_in_systems_worth_threads():
    scene = make_scene(
        {
            "water": {"depth": 20.0},
            "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}],
            "waves": {"omegas": {"from": 0.4, "to": 1.0, "count": 25}},
            "method": "panel",
        }
    )
    mesh = box(100, 50, 10, panels=800)
    assert shared_band(scene, mesh) is not None and PER_PANEL * len(mesh) >= UNKNOWNS_WORTH_THREADS


def made(name):
    """Solved in a process of its own, by two threads: their order is what might differ"""
    numbers = dict.fromkeys(("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "2")
    # 2⁴ turns of waiting for each other; by itself BLAS takes twice the processor time, most of it in waiting
    environment = {**os.environ, **numbers, "OPENBLAS_THREAD_TIMEOUT": "4"}
    commands = [f"{SCENE} {how} --output {name}_{run}.h5" for run, how in RUNS.items()]
    done = subprocess.run([sys.executable, "-c", MADE, *commands], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr


def contents(path):
    """{name: value} of every dataset and attribute but the wall times, and the checksums that cover them"""
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
    return {name: value for name, value in found.items() if not name.startswith(("wall_time", "row_checksum"))}


def test_a_scene_gives_the_same_database_twice_by_two_threads(tmp_path):
    for name in "ab":
        made(tmp_path / name)
    for run in RUNS:
        one, other = (contents(tmp_path / f"{name}_{run}.h5") for name in "ab")
        assert one.keys() == other.keys()
        assert "added_mass" in one and ("drift_force" in one) == (run != "band")
        differing = [key for key in one if one[key] != other[key]]
        assert not differing, (run, differing)
