"""Kernels evaluated as Python where none is compiled: the same results, nothing on disk, in time the compiler."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
HOUSE = """import math

from bem.kernels.jit import kernel

@kernel()
def step(x, by):
    return x + math.log(by)

@kernel()
def filled(out, by):
    total = 0.0
    for i in range(out.size):
        out[i] += 1.0
        total += step(out[i], by)
    return total, out.size > 2
"""
RUN = """import json, sys
import numpy as np
from bem.kernels import jit, uncompiled
jit.ROOT = jit.Path({house!r})
uncompiled.allow(({package!r},), {seconds})
sys.path.insert(0, {house!r})
from short.kernels import filled
out = np.arange(3.0)
results = [filled(out, by) for by in {by}]
print(json.dumps([results, [type(r).__name__ for r in results[0]], out.tolist()]))
"""


def run(tmp_path, by, package="short", seconds=10.0):
    """Results, types of the first, the array, and the number of kernels on disk"""
    (tmp_path / "short").mkdir(parents=True, exist_ok=True)
    (tmp_path / "short/kernels.py").write_text(HOUSE)
    code = RUN.format(house=str(tmp_path), package=package, seconds=seconds, by=by)
    environment = os.environ | {"PYTHONPATH": str(ROOT), "HAKOBUNE_CACHE": str(tmp_path / "cache")}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return *json.loads(done.stdout), len(list((tmp_path / "cache").rglob("*.nbi")))


def test_a_kernel_of_a_named_package_is_evaluated_and_leaves_nothing_on_disk(tmp_path):
    results, kinds, out, kept = run(tmp_path, [1.0, 1.0])
    assert results == [[6.0, True], [9.0, True]]
    assert kinds == ["float", "bool"]
    assert out == [2.0, 3.0, 4.0]
    assert kept == 0


def test_kernels_compile_when_time_is_up_or_not_named_and_give_the_same(tmp_path):
    late = run(tmp_path / "late", [1.0, 1.0], seconds=0.0)
    other = run(tmp_path / "other", [1.0, 1.0], package="elsewhere")
    assert late[:3] == other[:3] == run(tmp_path / "short", [1.0, 1.0])[:3]
    assert late[3] == other[3] == 2


def test_what_is_on_disk_is_used(tmp_path):
    first = run(tmp_path, [1.0], seconds=0.0)
    again = run(tmp_path, [1.0])
    assert first == again and again[3] == 2


def test_a_call_in_which_python_raises_is_made_again_compiled_from_the_same_arrays(tmp_path):
    results, _, out, kept = run(tmp_path, [1.0, 0.0])
    assert out == [2.0, 3.0, 4.0]
    assert results[1][0] == -float("inf")
    assert kept == 2


def test_a_system_of_composite_lines_comes_to_rest_on_a_new_installation_without_a_compiler(tmp_path):
    scene = ROOT / "pipelines/scenes/lines_barge.toml"
    environment = os.environ | {"PYTHONPATH": str(ROOT)}

    def lines(cache):
        command = [
            sys.executable,
            "-c",
            "import sys; from pipelines.start import main; sys.exit(main())",
            "lines",
            scene,
        ]
        given = environment | cache
        return subprocess.run(command, env=given, capture_output=True, text=True, check=True).stdout

    new = lines({"HAKOBUNE_CACHE": str(tmp_path)})
    assert not list(tmp_path.rglob("*.nbi"))
    assert [row for row in new.splitlines() if "left" not in row] == [
        row for row in lines({}).splitlines() if "left" not in row
    ]
