"""Sums of many waves at a few equal steps, compiled.

    S(nΔ) = Σ pᵢ cos ωᵢnΔ + Σ qᵢ sin ωᵢnΔ = P(n) + Q(n),    S(−nΔ) = P(n) − Q(n)

so that the steps before and after an instant need only two sums.  A block of eight waves is added to eight
steps at once, in a fixed order. A sum is therefore bitwise the same, whatever else is summed with it.
"""

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, load_vector, store_vector

BLOCK = 8  # waves added at once
LINE = 64  # bytes of a line of the cache: vectors that lie across two of them take twice the time
# π/2 in three parts, of which products with whole numbers up to 10⁶ are exact (Cody and Waite 1980)
PART_1, PART_2, PART_3 = 1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21


def zeros_in_lines(shape):
    """Array of zeros of a shape; its first element lies at the start of a cache line (LINE bytes)"""
    room = np.zeros(int(np.prod(shape)) + LINE // 8)
    first = -room.ctypes.data % LINE // 8
    return room[first : first + int(np.prod(shape))].reshape(shape)


def harmonics(omega, step, count):
    """Values of cos ωt and sin ωt at `count` or a few more steps from 0 s, filled with zeros to full BLOCKs; shape
    (c, 2, m)

    omega : (c,) rad/s; step : s
    """
    out = zeros_in_lines((-(-len(omega) // BLOCK) * BLOCK, 2, -(-count // WIDTH) * WIDTH))
    turn = np.multiply.outer(omega, step * np.arange(out.shape[2]))
    out[: len(omega), 0], out[: len(omega), 1] = np.cos(turn), np.sin(turn)
    return out


@kernel(inline=True, counted=False)
def sum_waves(rows, factor, sums):
    """Fill sums (k, 2, m), P and Q of k quantities, from rows (c, 2, k), p and q, and from factor (c, 2, m) of
    `harmonics`

    Blocks of rows with only zeros are skipped.
    """
    sums[:] = 0.0
    k, m = rows.shape[2], factor.shape[2]
    into, of = address(sums), address(factor)
    for i in range(0, rows.shape[0], BLOCK):
        for part in range(2):
            for j in range(k):
                a, b, c, d = rows[i, part, j], rows[i + 1, part, j], rows[i + 2, part, j], rows[i + 3, part, j]
                e, f, g, h = rows[i + 4, part, j], rows[i + 5, part, j], rows[i + 6, part, j], rows[i + 7, part, j]
                if a == 0.0 and b == 0.0 and c == 0.0 and d == 0.0 and e == 0.0 and f == 0.0 and g == 0.0 and h == 0.0:
                    continue
                for n in range(0, m, WIDTH):
                    p, at = (2 * i + part) * m + n, (2 * j + part) * m + n
                    one = load_vector(into, at) + load_vector(of, p) * a
                    one = one + load_vector(of, p + 2 * m) * b
                    one = one + load_vector(of, p + 4 * m) * c
                    one = one + load_vector(of, p + 6 * m) * d
                    two = load_vector(of, p + 8 * m) * e
                    two = two + load_vector(of, p + 10 * m) * f
                    two = two + load_vector(of, p + 12 * m) * g
                    two = two + load_vector(of, p + 14 * m) * h
                    store_vector(into, at, one + two)


@kernel(inline=True, counted=False)
def at_step(sums, j, n):
    """Sum S of quantity j at step n, from sums (k, 2, m); n may be negative"""
    return sums[j, 0, n] + sums[j, 1, n] if n >= 0 else sums[j, 0, -n] - sums[j, 1, -n]


@kernel(inline=True, counted=False)
def sine_and_cosine(turn):
    """Sine and cosine of an angle up to 10⁶ rad, within 2e-16; without branches, so that loops over it become vector
    instructions

    Polynomials of fdlibm (Sun Microsystems 1993) within ±π/4.
    """
    n = np.floor(turn * (2 / np.pi) + 0.5)
    x = ((turn - n * PART_1) - n * PART_2) - n * PART_3
    z = x * x
    s = 2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
    s = -1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * s))
    c = 2.48015872894767294178e-05 + z * (
        -2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)
    )
    c = 4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * c)
    sine, cosine = x + x * z * s, 1.0 - 0.5 * z + z * z * c
    quarter = n - 4.0 * np.floor(0.25 * n)
    odd = quarter == 1.0 or quarter == 3.0
    first, second = (cosine, sine) if odd else (sine, cosine)
    return (-first if quarter >= 2.0 else first), (-second if quarter == 1.0 or quarter == 2.0 else second)
