"""A dynamic line beside MoorDyn 2.7.2: tension, work and time of a chain in surge.

    python tests/bench/dynamic_lines.py [PYTHON_WITH_MOORDYN]

Chain of 300 m, 0.1368 m, 114.94 kg/m, EA 4.933e8 N in 50 m of water, span 290 m; surge 2 m in 10 s from rest, the
sixth cycle; MoorDyn with RK4 and CFL 0.1.  Best of several runs; the first, which compiles, is not counted.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, FairleadMotion, simulate
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays

DIAMETER, MASS, GRAVITY = 0.1368, 114.94, 9.80665
AMPLITUDE, PERIOD, DURATION = 2.0, 10.0, 60.0
OURS = (20, 60, 160)


def chain(elements):
    weight = (MASS - 1025 * np.pi / 4 * DIAMETER**2) * GRAVITY
    segment = DynamicSegment(
        300.0,
        MASS,
        weight,
        DIAMETER,
        4.933e8,
        elements,
        drag_normal=1.333,
        drag_tangential=0.2034,
        added_normal=1.0,
        added_tangential=0.5,
    )
    return DynamicLine(segment, (-290.0, 0.0, -50.0))


def best(work, times=5):
    """Result and least seconds of a call."""
    found, seconds = work(), []
    for _ in range(times):
        begun = time.perf_counter()
        found = work()
        seconds.append(time.perf_counter() - begun)
    return found, min(seconds)


def ours(elements):
    line = chain(elements)
    motion = FairleadMotion.harmonic((0, 0, 0), (1j * AMPLITUDE, 0, 0), PERIOD)
    still = water_arrays(None, None, GRAVITY)
    _, ready = best(lambda: start(line, (0.0, 0.0, 0.0), still))
    found, seconds = best(lambda: simulate(line, motion, DURATION, check_mesh=False))
    last = found.time >= DURATION - PERIOD
    return dict(
        largest=found.tension_fairlead[last].max(),
        least=found.tension_fairlead[last].min(),
        work=found.energies.work[-1] - np.interp(DURATION - PERIOD, found.time, found.energies.work),
        start_ms=1e3 * ready,
        ms_per_second=1e3 * seconds / DURATION,
    )


def peer(python, elements):
    """What MoorDyn finds, in a process of its own."""
    file = Path(__file__).with_name("moordyn_chain.py")
    command = [python, str(file), *map(str, (elements, AMPLITUDE, PERIOD, DURATION))]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def main(python=None):
    print("| program | elements | largest kN | least kN | work per cycle kJ | start ms | ms per second |")
    print("|---|---|---|---|---|---|---|")
    rows = [("hakobune", n, ours(n)) for n in OURS]
    if python:
        rows += [("MoorDyn 2.7.2", n, peer(python, n)) for n in (20, 60, 160)]
    for name, n, r in rows:
        print(
            f"| {name} | {n} | {r['largest'] / 1e3:.1f} | {r['least'] / 1e3:.1f} | {r['work'] / 1e3:.1f} "
            f"| {r['start_ms']:.2f} | {r['ms_per_second']:.2f} |"
        )


if __name__ == "__main__":
    main(*sys.argv[1:2])
