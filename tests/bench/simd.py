"""What SIMD vectors alone gain: a piece of 8 × 8 coefficients with its gradient, with vectors and with plain loops.

python tests/bench/simd.py
"""

import math
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem.green.piecewise_polynomials import aligned, evaluate_piece
from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import address

PIECES, POINTS, REPEATS = 400, 100_000, 15


@kernel(inline=True)
def by_loops(pieces, n, x, y):
    """The same by Horner's rule in both variables on numbers"""
    f, fx, fy = 0.0, 0.0, 0.0
    for a in range(7, -1, -1):
        s, t = pieces[64 * n + 56 + a], 0.0
        for b in range(6, -1, -1):
            t = t * y + s
            s = s * y + pieces[64 * n + 8 * b + a]
        fx = fx * x + f
        f, fy = f * x + s, fy * x + t
    return f, fx, fy


@kernel()
def all_by_vectors(pieces, n, x, y, out):
    start = address(pieces)
    for i in range(len(n)):
        out[i, 0], out[i, 1], out[i, 2] = evaluate_piece(start, n[i], x[i], y[i])


@kernel()
def all_by_loops(pieces, n, x, y, out):
    start = address(pieces)
    for i in range(len(n)):
        out[i, 0], out[i, 1], out[i, 2] = by_loops(start, n[i], x[i], y[i])


def main():
    rng = np.random.default_rng(1)
    pieces, n = aligned(rng.normal(size=(PIECES, 8, 8))).reshape(-1), rng.integers(0, PIECES, POINTS)
    x, y = rng.uniform(-1, 1, (2, POINTS))
    values, times = {}, {}
    for _ in range(REPEATS):
        for work in (all_by_vectors, all_by_loops):
            out = values.setdefault(work, np.empty((POINTS, 3)))
            start = perf_counter()
            work(pieces, n, x, y, out)
            times[work] = min(times.get(work, math.inf), perf_counter() - start)
    vectors, loops = (1e9 * times[work] / POINTS for work in (all_by_vectors, all_by_loops))
    difference = np.abs(values[all_by_vectors] - values[all_by_loops]).max()
    print(f"vectors {vectors:.1f} ns, loops {loops:.1f} ns: {loops / vectors:.2f} times; differ by {difference:.0e}")


if __name__ == "__main__":
    main()
