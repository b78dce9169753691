"""Which lines need a motion of their own: what the simplified method says beforehand, beside runs.

    python tests/bench/line_regimes.py [--lines 200] [--seed 1]

Random chains, wires and ropes of `line_peaks.py`.  A line needs it whose largest tension is more than a tenth off that
of its static shape at the same places.  Printed: how many, by what was said.
"""

import argparse
import sys
import warnings
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from line_peaks import CYCLES, random_line

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.dynamics.regime import regime_of
from hakobune.mooring.lines.dynamics.simulation import simulate

OFF = 0.1  # of the largest tension
POSITIONS = 32


def static_largest(line, places):
    """N, largest tension of the static shape at places (n, 3) of the fairlead"""
    away, segment = places - np.array(line.anchor), line.segments[0]
    found = solve_lines(np.hypot(*away.T[:2]), away[:, 2], segment.length, segment.weight, segment.stiffness)
    return float(found.tension_fairlead.max())


def judged(rng):
    """(what is said, dynamic over static largest tension − 1, words); None where a line cannot be run"""
    line, motion, duration, words = random_line(rng)
    period = duration / CYCLES
    try:
        run = simulate(line, motion, duration, check_mesh=False)
        places = np.array([motion.at(t)[0] for t in np.linspace(duration - period, duration, POSITIONS)])
        static = static_largest(line, places)
    except (ValueError, RuntimeError):
        return None
    outermost = places[np.argmax(np.linalg.norm(places - np.array(line.anchor), axis=1))] - motion.mean
    found = regime_of(line, motion.mean, outermost, period)
    last = run.tension_fairlead[run.time > duration - period].max()
    return found, last / static - 1, words


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lines", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    rng = np.random.default_rng(arguments.seed)
    table = {}
    for _ in range(arguments.lines):
        one = judged(rng)
        if one is None:
            continue
        found, off, words = one
        said = "not judged" if isinstance(found, str) else found.regime.name.lower().replace("_", " ")
        print(f"{said:14s} {off:+8.3f}  {words}")
        table.setdefault(said, [0, 0])[int(abs(off) > OFF)] += 1
    for said, (near, far) in sorted(table.items()):
        print(f"{said}: {near} within a tenth of the static shape, {far} beyond")
