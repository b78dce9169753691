"""Sections: error of the tolerance against a finer solution, and what it costs (warm, least of ten).

    OPENBLAS_NUM_THREADS=1 python tests/bench/sections.py

Errors are the largest of A + iB/ω and of the exciting forces, relative, over sway, heave and roll.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.sections.coefficients import frequency_of, section
from hakobune.bem.sections.tables import tables

SHAPES = ((5, 1.2, 1.0), (20, 1.2, 1.0), (5, 3.0, 1.0), (20, 10.0, 1.0), (5, 10.0, 3.0), (10, np.inf, 1.0))


def values(found):
    impedance = found.added_mass + 1j * found.damping / found.omega
    return np.concatenate([impedance.diagonal(), found.excitation])


def least(work, times=10):
    work()
    return min(_seconds(work) for _ in range(times))


def _seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main():
    print("| B/d | H/d | xi_B | tolerance | error | ms |\n|---|---|---|---|---|---|")
    for beam, depth, xi in SHAPES:
        omega = float(frequency_of(xi, beam))
        fine = values(section(beam, 1.0, depth, omega, tolerance=1e-8))
        for tolerance in (1e-3, 1e-4, 1e-6):
            rough = values(section(beam, 1.0, depth, omega, tolerance=tolerance))
            error = np.max(np.abs(rough / fine - 1))
            seconds = least(lambda b=beam, h=depth, w=omega, t=tolerance: section(b, 1.0, h, w, tolerance=t))
            print(f"| {beam} | {depth:g} | {xi:g} | {tolerance:g} | {error:.0e} | {1e3 * seconds:.2f} |")
    print(f"\nall twenty tables of the report, 200 sections: {least(tables, 3):.2f} s")


if __name__ == "__main__":
    main()
