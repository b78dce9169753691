"""Work per cycle of a moving chain at the default tolerance, beside the same line with steps a tenth as long.

    python tests/bench/line_energy.py [FRICTION]

Chain of `dynamic_lines`, 40 elements; surge of 0.5 to 4 m in 5 to 100 s, the last of four cycles.  "supplied" is what
is lost and stored, "integral" that of force and velocity at the ends; both against the finer run's supplied work.
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from dataclasses import replace

import numpy as np
from dynamic_lines import chain

from hakobune.mooring.lines.dynamics.simulation import ElasticBed, FairleadMotion, simulate

AMPLITUDES, PERIODS = (0.5, 1.0, 2.0, 4.0), (5.0, 7.0, 10.0, 14.0, 20.0, 30.0, 45.0, 70.0, 100.0)
CYCLES, FINE = 4, 1e-6


def last_cycle(line, amplitude, period, tolerance):
    """Work supplied, its integral, work lost to friction (J), largest tension (N) and steps, all of the last cycle."""
    motion = FairleadMotion.harmonic((0, 0, 0), (1j * amplitude, 0, 0), period)
    begin = (CYCLES - 1) * period
    run = simulate(line, motion, CYCLES * period, tolerance=tolerance, check_mesh=False, stops=[begin])
    E = run.energies

    def change(values):
        return values[-1] - np.interp(begin, run.time, values)

    peak = run.tension_fairlead[run.time >= begin].max()
    return change(E.supplied), change(E.work), change(E.friction), peak, run.steps


def main(friction=0.0):
    line = replace(chain(40), bed=ElasticBed(friction=float(friction)))
    print("| A m | T s | fine J | supplied | integral | friction | largest tension | steps |")
    print("|---|---|---|---|---|---|---|---|")
    for period in PERIODS:
        for amplitude in AMPLITUDES:
            ours, fine = (last_cycle(line, amplitude, period, tolerance) for tolerance in (1e-3, FINE))
            errors = (
                ours[0] / fine[0] - 1,
                ours[1] / fine[0] - 1,
                ours[2] / (fine[2] or np.nan) - 1,
                ours[3] / fine[3] - 1,
            )
            shown = " | ".join(f"{100 * e:.2f} %" for e in errors)
            print(f"| {amplitude:g} | {period:g} | {fine[0]:.5g} ({fine[1]:.5g}) | {shown} | {ours[4]} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:2])
