"""Estimated errors of slow forces of pairs against what four times as many panels give, in random scenes.

    python tests/bench/pair_errors.py [--scenes 40] [--first 0] [--seed 1] [--surface]

Boxes and buoys, floating or held, in water from a tenth of their draft under the keel to deep, oblique waves; three
frequencies whose shortest wave is three panels long or more; the coarser mesh as `hakobune qtf` takes it.  Prints the
share whose error is within a factor of three of the estimate: of single pairs and components, and of root mean squares
over pairs, as `hakobune qtf` prints them, without those below a thousandth of the largest force, also of meshes with
three panels or more in every direction.  A median of root mean squares is what to multiply `quadratic_forces.SIZES`
by; of the difference of both meshes in heave, roll and pitch its power in a geometric mean with squares and whole, and
the factor, by least squares.  A scene depends on its number and the seed alone: many are run in slices.
"""

import argparse
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.second_order.quadratic_forces import ORDER, QuadraticRun, panel_errors, quadratic_forces
from hakobune.meshing.hydrostatics import hydrostatics, inertia_matrix
from hakobune.meshing.lid import lid
from hakobune.pipelines.qtf.problem import FEWEST
from hakobune.pipelines.solve.panel_counts import coarse_counts, counts_of, meshed

G = 9.80665
SMALL = 1e-3  # of the largest force: errors below it count as met


def scene(rng):
    """The body; panels; depth; whether it floats"""
    panels = int(rng.uniform(120, 260))
    if rng.random() < 0.6:
        length = rng.uniform(20, 150)
        sizes = length, length * rng.uniform(0.2, 1.0), length * rng.uniform(0.05, 0.2)
        body = SimpleNamespace(shape="box", length=sizes[0], beam=sizes[1], draft=sizes[2])
    else:
        radius = rng.uniform(3, 20)
        sizes = radius, radius * rng.uniform(0.3, 1.5)
        body = SimpleNamespace(shape="buoy", radius=sizes[0], draft=sizes[1])
    depth = sizes[-1] * (1 + np.exp(rng.uniform(np.log(0.1), np.log(10))))
    return body, panels, depth if rng.random() < 0.85 else np.inf, rng.random() < 0.7


def problems(body, panels, depth, floats):
    """[`PanelProblem`] of the coarser mesh, of so many panels and of four times as many"""
    fine, finest = (meshed(body, None, panels=n) for n in (panels, 4 * panels))
    still = hydrostatics(finest)
    radii = np.array([0.35, 0.25, 0.3]) * np.ptp(finest.whole().points, axis=0)[[1, 0, 0]]
    moving = {}
    if floats:
        moving = {
            "inertia_matrix": inertia_matrix(still.mass, (0, 0, 0), radii, (0, 0, 0)),
            "hydrostatic_stiffness": still.stiffness,
        }
    meshes = meshed(body, coarse_counts(body, fine, FEWEST)), fine, finest
    return [PanelProblem(mesh, lid(mesh), depth=depth, **moving) for mesh in meshes]


def ratios(rng, surface):
    """Errors over their estimates: of pairs and components (…,) that are not both below SMALL of the largest force, and
    root mean squares over pairs (6,), NaN for those; the largest error over the force; root mean squares (2, 6) of
    errors and differences of both meshes over the mean of squares and whole; whether there are three panels or more in
    every direction
    """
    body, panels, depth, floats = scene(rng)
    rough, fine, finest = problems(body, panels, depth, floats)
    size = np.sqrt(fine.mesh.areas.mean())
    length = size * np.exp(rng.uniform(np.log(6), np.log(30)))  # of the shortest waves
    high = np.sqrt(G * 2 * np.pi / length * np.tanh(2 * np.pi / length * min(depth, 1e4)))
    omega, beta = high * (1 - 0.08 * np.arange(3)[::-1]), [rng.uniform(0, np.pi)]
    run = QuadraticRun(fine, omega, beta, high, floats, surface=surface)
    coarser = QuadraticRun(rough, omega, beta, high, floats, surface=surface, swayed=run.motions if floats else None)
    coarse, found = coarser.all(), run.all()
    best = quadratic_forces(finest, omega, beta, high, floats, surface=surface)
    refinement = fine.mesh.total / rough.mesh.total
    estimate = panel_errors(found, coarse.total, refinement, coarser.by_motions)
    error = np.abs(found.total - best.total) / (1 - 4.0**-1.16)  # what the finest has left
    scale = np.nanmax(np.abs(best.total), axis=(0, 1, 2, 3))
    scale = np.array([max(scale[:3])] * 3 + [max(scale[3:])] * 3)
    known = np.isfinite(error) & (np.maximum(error, estimate) > SMALL * scale)
    off = np.abs(found.total - coarse.total) / (refinement**ORDER - 1)
    parts = error, estimate, off, found.squares, found.total
    rms = [np.sqrt(np.nanmean(np.abs(part) ** 2, axis=(0, 1, 2, 3))) for part in parts]
    small = np.maximum(*rms[:2]) < SMALL * scale
    together = np.where(small, np.nan, rms[0] / np.maximum(rms[1], 1e-300))
    to_both = np.where(small, np.nan, np.array([rms[0], rms[2]]) / np.maximum(np.sqrt(rms[3] * rms[4]), 1e-300))
    several = min(counts_of(body, fine.mesh)) >= 3
    return error[known] / estimate[known], together, np.nanmax(error / scale), to_both, several


def told(name, found):
    found = found[np.isfinite(found)]
    within, below = (100 * np.mean(part) for part in ((found > 1 / 3) & (found < 3), found < 3))
    print(
        f"{name}: {len(found)}, within a factor of three {within:.1f} %, not underestimated by more {below:.1f} %; "
        f"median {np.median(found):.2f}"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", type=int, default=40)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--surface", action="store_true")
    given = parser.parse_args()
    found = []
    warnings.simplefilter("ignore")
    for number in range(given.first, given.first + given.scenes):
        found.append(ratios(np.random.default_rng([given.seed, number]), given.surface))
        single, _, largest, _, _ = found[-1]
        print(f"{number}: median {np.median(single):.2f}, largest error {100 * largest:.2g} % of the force", flush=True)
    singles, means, _, to_both, several = zip(*found, strict=True)
    means, to_both, several = (np.array(part) for part in (means, to_both, several))
    told("pairs and components", np.concatenate(singles))
    for name, columns in (("surge, sway and yaw", [0, 1, 5]), ("heave, roll and pitch", [2, 3, 4])):
        told(f"root mean squares of {name}", means[:, columns])
        told("  three panels or more in every direction", means[several][:, columns])
    error, off = np.log(to_both[:, :, 2:5]).swapaxes(0, 1).reshape(2, -1)
    known = np.isfinite(error)
    power, factor = np.polyfit(off[known], error[known], 1)
    print(f"heave, roll and pitch by least squares: power {power:.2f}, factor {np.exp(factor):.2f}")
