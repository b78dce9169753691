"""Error against time on the truncated cylinder: radius 10, draft 10 m, kh 0.05 to 20, all coefficients and drift.

    python tests/bench/cylinder.py [depth …]

Errors in per cent of the largest value of each coefficient over the frequencies; time per frequency (warm) of
radiation, diffraction at one heading, Kochin functions and drift, with the threads of this process.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

from identities.test_solver_exact import KH, WANT, cylinder_errors, frequencies, prepared

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.kernels.threads import thread_count
from hakobune.meshing.shapes import buoy

COUNTS = ((3, 2, 3), (4, 3, 4), (5, 5, 7), (7, 7, 10), (11, 9, 13))


def seconds(counts, depth):
    """Median time of a frequency, the first not counted."""
    body, times = prepared(buoy(10, 10, counts=counts), depth), []
    for omega in frequencies(KH, depth):
        start = time.perf_counter()
        solve_frequency(body, omega, [0.0], WANT)
        times.append(time.perf_counter() - start)
    return sorted(times[1:])[len(times) // 2]


def main(depths):
    print(f"threads: {thread_count()}\n")
    print("| depth m | panels | A % | B % | excitation % | drift % | ms per frequency |")
    print("|---|---|---|---|---|---|---|")
    for depth in depths:
        for counts in COUNTS:
            e = {name: 100 * value for name, value in cylinder_errors(counts, depth).items()}
            panels = 4 * counts[0] * (counts[1] + counts[2])
            print(
                f"| {depth:g} | {panels} | {e['A']:.2f} | {e['B']:.2f} | {e['excitation']:.2f} | {e['drift']:.2f} "
                f"| {1e3 * seconds(counts, depth):.0f} |"
            )


if __name__ == "__main__":
    main([float(d) for d in sys.argv[1:]] or [10.2, 15.0, 30.0, 100.0])
