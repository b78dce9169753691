"""Kernels evaluated as Python where none is compiled: the same results, nothing on disk, in time the compiler."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
HOUSE = """import math

from hakobune.bem.kernels.jit import kernel

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
CALLER = """from hakobune.bem.kernels.jit import kernel
from short.kernels import filled as short_filled

@kernel()
def filled(out, by):
    return short_filled(out, by)
"""
RUN = """import json, sys
import numpy as np
from hakobune.bem.kernels import jit, uncompiled
jit.ROOT = jit.Path({house!r})
uncompiled.allow(({package!r},), {seconds}, {calls})
sys.path.insert(0, {house!r})
from short.kernels import filled
out = np.arange(3.0)
results = [filled(out, by) for by in {by}]
print(json.dumps([results, [type(r).__name__ for r in results[0]], out.tolist(), "numba" in sys.modules]))
"""


def run(tmp_path, by, package="short", seconds=10.0, calls=0):
    """Results, types of the first, the array, whether numba was loaded, and the number of kernels on disk"""
    (tmp_path / "short").mkdir(parents=True, exist_ok=True)
    (tmp_path / "short/kernels.py").write_text(HOUSE)
    code = RUN.format(house=str(tmp_path), package=package, seconds=seconds, by=by, calls=calls)
    environment = os.environ | {"PYTHONPATH": str(ROOT), "HAKOBUNE_CACHE": str(tmp_path / "cache")}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return *json.loads(done.stdout), len(list((tmp_path / "cache").rglob("*.nbi")))


def test_a_kernel_of_a_named_package_is_evaluated_and_leaves_nothing_on_disk(tmp_path):
    results, kinds, out, numba, kept = run(tmp_path, [1.0, 1.0])
    assert results == [[6.0, True], [9.0, True]]
    assert kinds == ["float", "bool"]
    assert out == [2.0, 3.0, 4.0]
    assert kept == 0 and not numba


def test_kernels_compile_when_time_is_up_or_not_named_and_give_the_same(tmp_path):
    late = run(tmp_path / "late", [1.0, 1.0], seconds=0.0)
    other = run(tmp_path / "other", [1.0, 1.0], package="elsewhere")
    assert late[:3] == other[:3] == run(tmp_path / "short", [1.0, 1.0])[:3]
    assert late[3:] == other[3:] == (True, 2)


def test_what_is_on_disk_is_used(tmp_path):
    first = run(tmp_path, [1.0], seconds=0.0)
    again = run(tmp_path, [1.0])
    assert first == again and again[3:] == (True, 2)


def test_so_many_calls_are_evaluated_beside_what_is_on_disk_and_the_next_ones_compiled_with_the_same_results(tmp_path):
    by, calls = [1.0] * 3, 8  # two of the outermost calls, each with three within it
    compiled = run(tmp_path, by, seconds=0.0)
    few, more = (run(tmp_path, by, calls=calls + extra) for extra in (0, 4))
    assert compiled[:3] == few[:3] == more[:3]
    assert [result[3:] for result in (compiled, few, more)] == [(True, 2), (True, 2), (False, 2)]


def test_a_compiled_kernel_calls_one_that_may_wait(tmp_path):
    (tmp_path / "long.py").write_text(CALLER)
    code = RUN.replace("short.kernels", "long").format(
        house=str(tmp_path), package="short", seconds=10.0, calls=100, by=[1.0]
    )  # fmt: skip
    (tmp_path / "short").mkdir()
    (tmp_path / "short/kernels.py").write_text(HOUSE)
    environment = os.environ | {"PYTHONPATH": str(ROOT), "HAKOBUNE_CACHE": str(tmp_path / "cache")}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)[0] == [[6.0, True]]


def test_a_call_in_which_python_raises_is_made_again_compiled_from_the_same_arrays(tmp_path):
    results, _, out, _, kept = run(tmp_path, [1.0, 0.0])
    assert out == [2.0, 3.0, 4.0]
    assert results[1][0] == -float("inf")
    assert kept == 2


def test_a_system_of_composite_lines_comes_to_rest_on_any_installation_without_a_compiler(tmp_path):
    scene = ROOT / "pipelines/scenes/lines_barge.toml"
    environment = os.environ | {"PYTHONPATH": str(ROOT)}

    def lines(cache):
        code = "import sys; from hakobune.pipelines.start import main; sys.exit(main() or 'numba' in sys.modules)"
        command = [sys.executable, "-c", code, "lines", scene]
        given = environment | cache
        return subprocess.run(command, env=given, capture_output=True, text=True, check=True).stdout

    new = lines({"HAKOBUNE_CACHE": str(tmp_path)})
    assert not list(tmp_path.rglob("*.nbi"))
    assert [row for row in new.splitlines() if "left" not in row] == [
        row for row in lines({}).splitlines() if "left" not in row
    ]
