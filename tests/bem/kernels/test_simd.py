"""Kernels of SIMD vectors with the compiler on and off."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hakobune.bem.green.finite_depth import green
from hakobune.bem.kernels.simd import (
    address,
    bits_to_float,
    choose_less,
    exponents_and_fractions,
    float_to_bits,
    load_vector,
    repeated,
    root,
    split_halves,
    store_vector,
    to_scalars,
)

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


def every_operation(a, b, out):
    """One after the other: sums, products, both with numbers, halves, choices, roots and bits, of eight numbers each"""
    x, y = load_vector(address(a), 1), load_vector(address(b), 0)
    to = address(out)
    store_vector(to, 0, x + y)
    store_vector(to, 8, x * 3.0)
    store_vector(to, 16, x + y)
    store_vector(to, 24, x - y)
    store_vector(to, 32, x * y)
    store_vector(to, 40, x / y)
    store_vector(to, 48, -x)
    store_vector(to, 56, x - 2.0)
    store_vector(to, 64, 2.0 / y)
    store_vector(to, 72, choose_less(x, y, x, 7.0))
    store_vector(to, 80, choose_less(1.5, y, y, x))
    store_vector(to, 88, root(x * x))
    store_vector(to, 96, repeated(b[3]))
    low, high = split_halves(x)
    first, second = split_halves(high)
    out[104], out[105] = to_scalars(first)
    out[106], out[107] = to_scalars(second)
    out[108], out[109], out[110], out[111] = to_scalars(low + high)
    out[112] = bits_to_float(float_to_bits(b[2]) + (1 << 52))  # twice it: one more in the exponent
    exponents, fractions = exponents_and_fractions(x * x)
    store_vector(to, 113, exponents)
    store_vector(to, 121, fractions)


def test_vectors_are_eight_numbers_whichever_operation():
    from numba import njit

    rng = np.random.default_rng(1)
    a, b, found = rng.normal(size=9), rng.uniform(1, 2, size=8), np.zeros(129)
    njit(every_operation)(a, b, found)
    x = a[1:]
    true = [x + b, 3 * x, x + b, x - b, x * b, x / b, -x, x - 2, 2 / b, np.where(x < b, x, 7), np.where(b > 1.5, b, x),
            np.abs(x), np.full(8, b[3]), x[4:], x[:4] + x[4:], [2 * b[2]],
            np.frexp(x * x)[1] - 1, 2 * np.frexp(x * x)[0]]  # fmt: skip
    assert found == pytest.approx(np.concatenate(true), rel=1e-15)
