"""`OF_SUMS` of `bem.second_order.quadratic_forces.panel_errors` fitted again: errors of panels at sums of frequencies.

    python tests/bench/sum_errors.py [--scenes 12] [--seed 5] [--quick]

Random cylinders, radius 10 m, draft 0.4 to 2 and depth 1.15 to 3 of it, held and afloat, on 250 to 700 panels; the
reference is the contour method.  Printed are, for each mode that has a force, the median of estimate over error and how
many of the pairs have it within a factor of three, of those whose error is above 1e-3 of the force's root mean square.
"""

import argparse
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.quadratic_forces import OF_SUMS, QuadraticRun, panel_errors
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import buoy

RADIUS, PAIRS, MODES = 10.0, 5, {"surge": 0, "heave": 2, "pitch": 4}
NEGLIGIBLE = 1e-3


def outcomes(rng):
    """{mode: estimate over error (q,) of the pairs that count} of a random cylinder"""
    draft, count, moving = (
        RADIUS * np.exp(rng.uniform(np.log(0.4), np.log(2.0))),
        rng.integers(250, 700),
        rng.random() < 0.5,
    )
    depth = draft * np.exp(rng.uniform(np.log(1.15), np.log(3.0)))
    low = rng.uniform(0.3, 0.6)
    omega = np.linspace(low, low + rng.uniform(0.3, 0.6), PAIRS)
    meshes = [buoy(RADIUS, draft, panels=int(n)) for n in (count, count // 2)]
    still = hydrostatics(meshes[0])
    gyration = RADIUS * rng.uniform(0.4, 0.7)
    inertia = inertia_matrix(1025.0 * still.volume, (0.0, 0.0, 0.0), (gyration,) * 3, (0.0, 0.0, 0.0))
    body = dict(depth=depth, inertia_matrix=inertia, hydrostatic_stiffness=still.stiffness)
    exact = ShapeProblem(method="contour", shape="buoy", sizes=(RADIUS, draft), tolerance=1e-5, **body)
    problems = [PanelProblem(mesh, lid(mesh), **body) for mesh in meshes]
    highest = 2 * omega[-1]
    runs = [QuadraticRun(p, omega, [0.0], highest, moving, surface=True, kind=SUM) for p in (exact, problems[0])]
    swayed = runs[1].motions if moving else None
    runs.append(QuadraticRun(problems[1], omega, [0.0], highest, moving, surface=True, swayed=swayed, kind=SUM))
    known, fine, rough = (run.all() for run in runs)
    told = panel_errors(fine, rough.total, meshes[0].total / meshes[1].total, runs[2].by_motions)
    out = {}
    for name, mode in MODES.items():
        error, force = np.abs(fine.total - known.total)[..., mode], np.abs(known.total)[..., mode]
        seen = error > NEGLIGIBLE * np.sqrt(np.nanmean(force**2))
        out[name] = (told[..., mode] / error)[seen]
    return out


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=12)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--quick", action="store_true")
    asked = parser.parse_args(words)
    rng = np.random.default_rng(asked.seed)
    scenes = [outcomes(rng) for _ in range(1 if asked.quick else asked.scenes)]
    ratios = {name: np.concatenate([scene[name] for scene in scenes]) for name in MODES}
    print(f"OF_SUMS in the code {OF_SUMS:g}")
    for name, ratio in ratios.items():
        right = np.mean(np.abs(np.log(ratio)) < np.log(3))
        print(
            f"  {name:6} {len(ratio):4d} pairs, estimate over error {np.median(ratio):.2f}, {100 * right:.0f} % right"
        )
    every = np.concatenate(list(ratios.values()))
    print(f"right in the median with {OF_SUMS / np.median(every):.2g}, {100 * np.mean(every < 1 / 3):.0f} % too small")


if __name__ == "__main__":
    main()
