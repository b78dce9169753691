"""`LEFT` and `OF_WAVES` of `bem.panels.extrapolated` fitted again, and what `TRUSTED` keeps.

    python tests/bench/extrapolated.py [--scenes 300] [--seed 3] [--quick]

Scenes of tests/bench/tolerance.py by panels, each at its tolerance and on fewer panels (`COARSER`).  What is left is
the worst error of the extrapolated coefficients and forces, as in `bem.checks`, over the worst one that two meshes
show; the reference is the contour method.  Fitted are the constants whose shares are within a factor of three of most
of these.  Frequencies beyond their tolerance are taken if what is left is trusted to keep it: how many of them, and how
many do not.
"""

import argparse
import sys
from itertools import pairwise
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from bench.tolerance import WANT, drawn, prepared, reference

from hakobune.bem import DOFS
from hakobune.bem.checks import damping_error, largest_error
from hakobune.bem.panels.extrapolated import LEFT, OF_WAVES, TRUSTED

COARSER = (1.0, 1.7)  # times the tolerance that sets the number of panels
CHOICES = [(left, of_waves) for left in (0.08, 0.1, 0.12, 0.15, 0.2) for of_waves in (0.0, 2.0, 4.0, 6.0)]
BINS = (0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 1.0)


def outcomes(scenes, seed):
    """Rows: panel over wave, shares left of the worst error and of damping, tolerances before, after and in truth"""
    rows = []
    for coarser in COARSER:
        rng = np.random.default_rng(seed)
        for _ in range(scenes):
            scene = drawn(rng, "panel")
            body, headings = prepared(scene._replace(tolerance=coarser * scene.tolerance))
            if body.coarse is not None:
                rows.append(_row(scene, body, headings))
    return np.array(rows)


def _row(scene, body, headings):
    run, exact = body.run(scene.omega, headings, WANT, None, DOFS), reference(scene, headings, body.problem)
    after = run.extrapolated
    true = after.radiation - exact.radiation, after.excitation - exact.excitation
    shown, left = (np.array([largest_error(run, *e), damping_error(run, e[0])]) for e in (run.differences, true))
    a_wave = run.problem.mesh.sizes.max() * run.k / (2 * np.pi)
    scale = run.problem.tolerance / scene.tolerance
    return a_wave, *(left / shown), run.tolerances * scale, after.tolerances * scale, left.max() / scene.tolerance


def right(shares, a_wave, left, of_waves):
    """Share of the outcomes of which what is expected to be left is within a factor of three"""
    return np.mean(np.abs(np.log((left + of_waves * a_wave**2) / shares)) < np.log(3))


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=300)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    asked = parser.parse_args(words)
    a_wave, worst, damping, before, after, true = outcomes(6 if asked.quick else asked.scenes, asked.seed).T
    print("left of the worst error: panel over wave, scenes, median, nine of ten, largest")
    for low, high in pairwise(BINS):
        inside = worst[(a_wave >= low) & (a_wave < high)]
        if len(inside):
            print(f"  {low:4.2f} … {high:4.2f} {len(inside):5d}", *np.round(np.quantile(inside, [0.5, 0.9, 1.0]), 2))
    scores = [right(worst, a_wave, *choice) + right(damping, a_wave, *choice) for choice in CHOICES]
    best = CHOICES[int(np.argmax(scores))]
    for name, choice in (("best", best), ("in the code", (LEFT, OF_WAVES))):
        shares = [f"{100 * right(kind, a_wave, *choice):.1f} %" for kind in (worst, damping)]
        print(f"LEFT, OF_WAVES {name}: {choice[0]:g}, {choice[1]:g}; within a factor of three {', '.join(shares)}")
    beyond, taken = before > 1, (before > 1) & (after <= 1)
    missed = np.sum(true[taken] > 1)
    print(
        f"TRUSTED {TRUSTED:.3g}: of {beyond.sum()} beyond the tolerance {taken.sum()} are extrapolated, {missed} miss"
    )


if __name__ == "__main__":
    main()
