"""What the number of periods in `bem.checks.damping_scale` decides: N, below whose damping nothing resonates in time.

    python tests/bench/damping_floor.py [--scenes 60] [--seed 4] [--method panel|contour] [--quick]

First what an error of damping does to resonant motion.  With waves from rest for N' periods the variance is, in the
mean over this time and with x = 2πN'B/ωA,

    V = (1 − (1 − exp(−x))/x) / x,        d ln √V / d ln B = x V' / 2V

(white noise on exp(−Bt / 2A): (A/BT) ∫₀ᵀ (1 − exp(−Bt/A)) dt / T).  The table has the worst change of √V by an error
of 1 % and of 10 % of the floor b = ωA/πN, in damping up to b, for some N'/N.

Then, on random scenes of tests/bench/tolerance.py, for each N: the share of coefficients of damping that are below the
floor, frequencies whose first answer does not keep the tolerance, and the largest estimated error over the tolerance.
"""

import argparse
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

import numpy as np
import tolerance

from hakobune.bem import DOFS
from hakobune.bem.checks import damping_scale
from hakobune.bem.frequency import TRUSTED

PERIODS = (100, 300, 1000, 3000, 10_000)


def variance(x):
    """V of the module's first formula"""
    return (1 + np.expm1(-x) / x) / x


def effect(error, times=1.0):
    """Largest relative change of √V over B up to the floor, N' = `times` N, by this error over damping of the floor"""
    x = 2 * times * np.geomspace(1e-3, 1, 200)
    changed = np.sqrt(variance(x + 2 * times * error) / variance(x))
    return float(np.abs(changed - 1).max())


def first_answers(method, scenes, seed):
    """[(run, errors of radiation)] before any of them is made sharper"""
    found = []
    for i in range(scenes):
        scene = tolerance.drawn(np.random.default_rng([seed, i]), method)
        prepared, headings = tolerance.prepared(scene)
        run = prepared.run(scene.omega, headings, tolerance.WANT, None, DOFS)
        if run.differences is not None:
            found.append((run, run.differences[0]))
    return found


def shares(answers, periods):
    """Share of coefficients below the floor, of answers that are not kept, and the largest error over the tolerance"""
    below, errors = [], []
    for run, error in answers:
        Z, moving = np.diag(run.radiation), run.prepared.displacing
        below.append((np.abs(Z.imag) < np.abs(Z.real) / (np.pi * periods))[moving])
        relative = np.abs(error.imag) / damping_scale(run.radiation, moving, periods)
        errors.append(relative.max() / run.problem.tolerance)
    return np.mean(np.concatenate(below)), np.mean(np.array(errors) > TRUSTED), max(errors)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--method", choices=sorted(tolerance.RANGES), default="panel")
    parser.add_argument("--quick", action="store_true", help="three scenes, some seconds")
    asked = parser.parse_args(words)
    print("| N'/N | 1 % of the floor changes √V by | 10 % |")
    print("|---|---|---|")
    for times in (0.3, 1, 3, 10):
        print(f"| {times:g} | {effect(0.01, times):.2%} | {effect(0.1, times):.2%} |")
    answers = first_answers(asked.method, 3 if asked.quick else asked.scenes, asked.seed)
    print("| N | damping below the floor | not kept by the first answer | largest error / tolerance |")
    print("|---|---|---|---|")
    for periods in PERIODS:
        below, missed, largest = shares(answers, periods)
        print(f"| {periods} | {below:.1%} | {missed:.1%} | {largest:.2g} |", flush=True)


if __name__ == "__main__":
    main()
