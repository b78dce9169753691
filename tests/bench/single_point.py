"""Single-point mooring: equilibria that a dense scan finds and we miss, and growth in time beside the quartic's.

    python tests/bench/single_point.py [--loads 10000] [--systems 200]

Headings of rest are compared with the changes of sign of the same function on 36 000 headings; growth rate and period
of small motions with those of the quartic, fitted to a record of the integrated equations.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "mooring" / "single_point")]

from boxes import random_head_on, random_loads

from mooring.single_point.body import SinglePointError
from mooring.single_point.criterion import roots
from mooring.single_point.equilibria import equilibria, headings_of_rest
from mooring.single_point.slewing import linearised, slew

DENSE = 36_000
SMALL = 1e-4  # m and 1/100 rad of the motion that is fitted


def missed(seed):
    """Zeros of random loads, and how many changes of sign on DENSE headings no zero explains"""
    rng = np.random.default_rng(seed)
    loads, (L, _, _) = random_loads(rng)
    end = np.array([rng.uniform(-0.6, 0.6) * L, rng.uniform(-0.1, 0.1) * L])
    ours = headings_of_rest(loads, end)
    psi = np.arange(DENSE + 1) * (2 * np.pi / DENSE)
    force = loads.at_rest(psi)
    g = force[:, 2] - end[0] * force[:, 1] + end[1] * force[:, 0]
    changes = psi[:-1][np.sign(g[:-1]) * np.sign(g[1:]) < 0] + np.pi / DENSE
    gap = np.abs(np.mod(changes[:, None] - ours[None] + np.pi, 2 * np.pi) - np.pi)
    return len(ours), int(np.sum(gap.min(axis=1, initial=np.inf) > 2 * np.pi / DENSE))


def difference_in_time(seed):
    """Relative difference of the root that dominates, fitted to a record, from the quartic's; None: no such system

    The motion starts along the mode; a fit of two exponentials to six samples a period gives rate and period.
    """
    rng = np.random.default_rng(seed)
    try:
        state = min(equilibria(random_head_on(rng)), key=lambda one: abs(np.sin(one.heading / 2)))
    except SinglePointError:
        return None
    if state.quartic is None:
        return None
    wanted = roots(state.quartic)[0]
    J = linearised(state.point, state.state)
    values, vectors = np.linalg.eig(J)
    which = int(np.argmin(np.abs(values - wanted)))
    mode = vectors[:, which] / np.abs(vectors[2, which]) * SMALL / 100
    if wanted.imag == 0:
        mode = mode.real
    span = 2 * np.pi / abs(wanted) * 1.5
    start = state.state.copy()
    turn = np.real(mode[2])
    over = np.real(mode[3:5])
    u = start[3:5] + start[4] * turn * np.array([1.0, 0.0]) - start[3] * turn * np.array([0.0, 1.0])
    start[:3] += np.real(mode[:3])
    start[3:5] = u + over
    start[5] += np.real(mode[5])
    record = slew(state.point, start, span, span / 12, tolerance=1e-12)
    x = record.heading - state.heading
    if wanted.imag == 0:
        ratio = np.linalg.lstsq(x[:-1, None], x[1:], rcond=None)[0][0]
        found = np.log(ratio) / (span / 12)
    else:
        a, b = np.linalg.lstsq(np.stack([x[1:-1], x[:-2]], axis=1), x[2:], rcond=None)[0]
        pole = np.roots([1, -a, -b])
        found = np.log(pole[np.argmax(pole.imag)]) / (span / 12)
    return abs(found - wanted) / abs(wanted)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--loads", type=int, default=10_000)
    parser.add_argument("--systems", type=int, default=200)
    given = parser.parse_args(arguments)
    begin = time.perf_counter()
    counts, lost = np.array([missed(seed) for seed in range(given.loads)]).T
    spread = ", ".join(f"{np.sum(counts == n)} with {n}" for n in np.unique(counts))
    print(f"{given.loads} random loads: headings of rest {spread}; missed {lost.sum()}; "
          f"{time.perf_counter() - begin:.0f} s")  # fmt: skip
    begin, found, seed = time.perf_counter(), [], 0
    while len(found) < given.systems:
        one = difference_in_time(seed)
        seed += 1
        if one is not None:
            found.append(one)
    print(f"{given.systems} random systems of {seed}: root in time from the quartic's, median {np.median(found):.2g}, "
          f"largest {max(found):.2g}; {time.perf_counter() - begin:.0f} s")  # fmt: skip
    return int(lost.sum() > 0 or max(found) > 1e-4)


if __name__ == "__main__":
    sys.exit(main())
