"""Kernels of SIMD vectors with the compiler on and off."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hakobune.bem.green.finite_depth import green

ROOT = Path(__file__).parents[3]
PAIRS = (np.array([0.5, 5.0, 30.0, 400.0]), np.array([-1.0, -2.0, -0.1, -9.0]), np.array([-3.0, -2.5, -4.0, -1.0]))
CODE = """
import numpy as np
from hakobune.bem.green.finite_depth import green
print(repr(np.array(green(*np.load({path!r}), 0.6, {depth})).tolist()))
"""


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_the_green_function_is_the_same_with_the_compiler_off(depth, tmp_path):
    path = tmp_path / "pairs.npy"
    np.save(path, PAIRS)
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT)}
    code = CODE.format(path=str(path), depth=f"float({str(depth)!r})")
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    plain, compiled = np.array(eval(done.stdout)), np.array(green(*PAIRS, 0.6, depth))
    assert np.all(np.abs(plain - compiled) <= 1e-12 * np.abs(compiled).max(axis=1, keepdims=True))
