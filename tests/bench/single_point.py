"""Single-point mooring: equilibria that a dense scan finds and we miss, growth in time beside the quartic's, speed.

    python tests/bench/single_point.py [--loads 10000] [--systems 200] [--repeats 20]

Headings of rest are compared with the changes of sign of the same function on 36 000 headings; growth rate and period
of small motions with those of the quartic, fitted to a record of the integrated equations.  Speed is the processor time
of statics and criterion of floater A, and of 1 200 s of its slewing by two scales in 60 components of waves.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "mooring" / "single_point")]

from boxes import floater_A, random_head_on, random_loads

from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.single_point.criterion import roots
from hakobune.mooring.single_point.equilibria import equilibria, headings_of_rest
from hakobune.mooring.single_point.slewing import linearised, slew, turned_state
from hakobune.mooring.single_point.two_scale import RING, Steps, WaveBody, two_scale

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


def spent(action, repeats):
    """Processor times, s, of an action, the shortest and the middle one, after one run that does not count"""
    action()
    times = []
    for _ in range(repeats):
        begin = time.process_time()
        action()
        times.append(time.process_time() - begin)
    return min(times), float(np.median(times))


def in_waves(point, mean=0.8, components=60):
    """WaveBody of a box in a made-up sea: only the number of steps and components matters"""
    rng, scale = np.random.default_rng(1), np.diag(point.mass)[[0, 1, 0, 2, 2, 2]]
    omega = np.linspace(0.5 * mean, 2 * mean, components)
    force = np.tile(5e-3 * scale * (rng.normal(size=6) + 1j * rng.normal(size=6)), (components, RING, 1))
    restoring = np.diag(scale * np.array([0, 0, 1.2, 0.8, 0.9, 0]))
    one, phase = np.ones(components), rng.uniform(0, 2 * np.pi, components)
    return WaveBody(np.diag(scale), 0.2 * np.diag(scale), restoring, force, omega, 0.1 * one, phase, np.pi * one,
                    omega**2 / 9.81, 3.0, np.zeros(2), mean)  # fmt: skip


def answered(point):
    """Equilibria with their roots, and the quartic where there is one"""
    return [(one, one.roots, one.quartic) for one in equilibria(point)]


def speeds(repeats):
    """Lines on the time of one case, on a contact buoy and on a hawser of 25 m"""
    for name, hawser in (("contact buoy", 0.0), ("hawser", 25.0)):
        point = floater_A(30.0, hawser)
        least, middle = spent(lambda point=point: answered(point), repeats)
        yield f"{name}: statics and criterion {1e3 * least:.1f} ms, middle of {repeats} runs {1e3 * middle:.1f} ms"
        made = [floater_A(30.0, hawser) for _ in range(repeats + 1)]
        least, middle = spent(lambda made=made: answered(made.pop()), repeats)
        yield f"{name}: with splines and lines anew {1e3 * least:.1f} ms, middle {1e3 * middle:.1f} ms"
        stable = next(one for one in equilibria(point) if one.slewing.stable)
        start, body = turned_state(point, stable.state, np.radians(2)), in_waves(point)
        steps = Steps(1200.0, 10.0, 2 * np.pi / body.mean_omega / 30)
        least, middle = spent(lambda run=(point, start, steps, body): two_scale(*run), min(repeats, 5))
        yield f"{name}: 1 200 s of slewing with waves {least:.2f} s, middle {middle:.2f} s"


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--loads", type=int, default=10_000)
    parser.add_argument("--systems", type=int, default=200)
    parser.add_argument("--repeats", type=int, default=20)
    given = parser.parse_args(arguments)
    for line in speeds(given.repeats):
        print(line)
    if not (given.loads and given.systems):
        return 0
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
    return int(lost.sum() > 0 or max(found, default=0.0) > 1e-4)


if __name__ == "__main__":
    sys.exit(main())
