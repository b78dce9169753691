"""Work of random closed paths on a fender with hysteresis: python tests/bench/fender_paths.py --paths 100000

Paths walk on a grid that holds the knots of a fender of straight lines and its return length, so that reaction is a
polynomial of degree two in each step and Simpson's rule gives its work exactly.  They begin without contact and end
there; closed loops inside a path, between two visits of the same deflection and state, are judged too.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2])]
from hakobune.mooring.fenders.fender import fender_of_points
from hakobune.mooring.fenders.hysteresis import advanced, reaction_at

GRID = 0.01  # m
FENDER = fender_of_points(
    "straight",
    1.0,
    [0.0, 0.1, 0.2, 0.3, 0.4],
    [0.0, 0.8, 1.0, 0.9, 1.2],
    [0.0, 0.4, 0.3, 0.85, 0.6],
    return_length=5 * GRID,
    corners=True,
)


def least_work(paths, steps, seed):
    """Smallest work, J, of all closed paths and of all closed loops inside them; reactions are of the order of 1 N."""
    rng = np.random.default_rng(seed)
    at, s = np.zeros(paths), np.ones(paths)
    work, visits = np.zeros(paths), {}
    least = 0.0
    for step in range(steps + 41):
        move = rng.choice([-1, 0, 1], paths) if step < steps else np.where(at > 0, -1, 0)
        after = np.clip(at + move, 0, 40)
        states = [s, advanced(s, GRID * at, GRID * 0.5 * (at + after), FENDER.return_length)]
        states.append(advanced(s, GRID * at, GRID * after, FENDER.return_length))
        forces = [
            reaction_at(FENDER, GRID * x, y) for x, y in zip((at, 0.5 * (at + after), after), states, strict=True)
        ]
        work += (after - at) * GRID / 6 * (forces[0] + 4 * forces[1] + forces[2])
        at, s = after, states[-1]
        if step % 7 == 0:
            visits[step] = (at.copy(), s.copy(), work.copy())
        for x, y, w in visits.values():
            same = (x == at) & (np.abs(y - s) < 1e-9)
            least = min(least, float(np.min((work - w)[same], initial=0.0)))
    return min(least, float(work.min()))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--paths", type=int, default=100_000)
    parser.add_argument("--steps", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    start = time.perf_counter()
    least = min(least_work(1000, given.steps, given.seed + i) for i in range(given.paths // 1000))
    print(
        f"{given.paths} paths of {given.steps} steps: least work {least:.1e} N m, {time.perf_counter() - start:.0f} s"
    )
    sys.exit(least < -1e-12)
