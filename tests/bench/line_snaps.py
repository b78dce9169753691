"""Snaps of a chain whose fairlead moves fast: largest tension, steps and time over the elements.

    python tests/bench/line_snaps.py

Chain of `dynamic_lines` at the default tolerance, surge from rest, after the first of three cycles.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from dynamic_lines import chain

from hakobune.mooring.lines.dynamics.simulation import FairleadMotion, simulate

CYCLES = 3


def main():
    print("| A m | T s | elements | largest kN | least kN | steps | repeated | Newton | ms per second |")
    print("|---|---|---|---|---|---|---|---|---|")
    for amplitude, period in ((4.0, 10.0), (3.0, 7.0), (4.0, 5.0)):
        motion = FairleadMotion.harmonic((0, 0, 0), (1j * amplitude, 0, 0), period)
        for elements in (40, 60, 80, 160):
            simulate(chain(elements), motion, 0.1, check_mesh=False)
            begun = time.perf_counter()
            run = simulate(chain(elements), motion, CYCLES * period, check_mesh=False)
            spent = 1e3 * (time.perf_counter() - begun) / (CYCLES * period)
            T = run.tension_fairlead[run.time > period] / 1e3
            print(
                f"| {amplitude:g} | {period:g} | {elements} | {T.max():.1f} | {T.min():.1f} | {run.steps} "
                f"| {run.rejected} | {run.newton} | {spent:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
