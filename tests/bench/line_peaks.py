"""Largest tensions of random lines at the default tolerance, at the fairlead and inside, beside finer steps.

    python tests/bench/line_peaks.py [--lines 60] [--seed 1]

Chains, wires and polyester ropes in 20 to 300 m of water, taut to slack, whose fairlead moves by up to 4 m in any
direction in 4 to 16 s: three cycles from rest, 30 elements.
"""

import argparse
import sys
import time
import warnings
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, ElasticBed, FairleadMotion, simulate

ELEMENTS, CYCLES, GRAVITY = 30, 3, 9.80665
# kg/m over d², of the displaced diameter over d, EA over d² in Pa, drag of its own diameter
KINDS = {
    "chain": (19.9e3, 1.8, 8.5e10, 1.33, 0.2),
    "wire": (3.6e3, 0.85, 4.0e10, 1.2, 0.05),
    "polyester": (0.75e3, 0.88, 3.0e9, 1.4, 0.05),
}


def random_line(rng):
    """A line, the motion of its fairlead, and what it is in words"""
    kind = list(KINDS)[rng.integers(3)]
    per_area, displaced, modulus, normal, tangential = KINDS[kind]
    d = rng.uniform(0.05, 0.15) * (1.5 if kind == "polyester" else 1.0)
    depth = float(np.exp(rng.uniform(np.log(20), np.log(300))))
    mass, D = per_area * d**2, displaced * d
    weight = (mass - 1025 * np.pi / 4 * D**2) * GRAVITY
    span = depth * rng.uniform(1.5, 6.0)
    straight = np.hypot(span, depth)
    slack = rng.uniform(0.0, 1.0) ** 2
    length = straight * (1.0 + 1e-3 * rng.uniform()) + slack * (span + depth - straight) * 0.9
    segment = DynamicSegment(
        length,
        mass,
        weight,
        D,
        modulus * d**2,
        ELEMENTS,
        damping_ratio=float(rng.choice([0.1, 0.3, 1.0])),
        drag_normal=normal,
        drag_tangential=tangential,
    )
    bed = ElasticBed(friction=float(rng.choice([0.0, 0.5])))
    line = DynamicLine(segment, (-span, 0.0, -depth), bed=bed)
    way = rng.standard_normal(3)
    amplitude, period = rng.uniform(0.5, 4.0), rng.uniform(4.0, 16.0)
    stretch = 0.3 if kind == "polyester" else 0.05
    reach = length * (1 + 0.1 * stretch) - straight
    amplitude = min(amplitude, max(0.2, 2 * reach))
    X = 1j * amplitude * way / np.linalg.norm(way)
    motion = FairleadMotion.harmonic((0, 0, -2.0), X, period)
    words = f"{kind} {length:.0f} m, depth {depth:.0f}, span {span:.0f}, {amplitude:.2f} m in {period:.1f} s"
    return line, motion, CYCLES * period, words


def timed(*given, **options):
    """A run and its processor time in ms per second; warnings are what is counted here, not shown."""
    begun = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run = simulate(*given, **options)
    return run, 1e3 * (time.process_time() - begun) / given[2]


def errors(line, motion, duration, fine):
    """Run at the default tolerance, the errors of its largest tensions, at the fairlead and inside, and two times"""
    run, spent = timed(line, motion, duration)
    other, longer = timed(line, motion, duration, tolerance=fine, check_mesh=False)
    of_fairlead = run.tension_fairlead.max() / other.tension_fairlead.max() - 1
    return run, of_fairlead, run.largest_tension.max() / other.largest_tension.max() - 1, spent, longer


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lines", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--fine", type=float, default=1e-5, help="tolerance of the finer run")
    given = parser.parse_args()
    print("| line | least kN | fairlead % | inside % | told % | steps | ms/s | fine ms/s |")
    print("|---|---|---|---|---|---|---|---|")
    actual, told = [], []
    for k in range(given.lines):
        line, motion, duration, words = random_line(np.random.default_rng([given.seed, k]))
        try:
            run, end, inside, spent, longer = errors(line, motion, duration, given.fine)
        except ValueError as error:
            print(f"| {k} {words} | {str(error)[:80]} |", flush=True)
            continue
        actual.append(max(abs(end), abs(inside)))
        told.append(run.step_error)
        print(
            f"| {k} {words} | {run.least_tension.min() / 1e3:.2f} | {100 * end:.2f} | {100 * inside:.2f} "
            f"| {100 * told[-1]:.2f} | {run.steps} | {spent:.1f} | {longer:.1f} |",
            flush=True,
        )
    actual, told = np.array(actual), np.array(told)
    silent = (actual > 0.02) & (told <= 0.02)
    print(
        f"{actual.size} lines: {np.sum(actual > 0.02)} off by more than 2 %, {silent.sum()} of them in silence; "
        f"told covers the error in {np.mean(told >= actual):.1%}, half of it in {np.mean(told >= actual / 2):.1%}; "
        f"{np.sum((told > 0.02) & (actual < 0.005))} warned of within 0.5 %"
    )


if __name__ == "__main__":
    main()
