"""Estimated errors of slow forces of pairs against what four times as many panels give, in random scenes.

    python tests/bench/pair_errors.py [--scenes 40] [--first 0] [--seed 1] [--surface]

Boxes and buoys, floating or held, in water from a tenth of their draft under the keel to deep, oblique waves; three
frequencies whose shortest wave is three panels long or more.  Prints the share whose error is within a factor of three
of the estimate: of single pairs and components, and of root mean squares over pairs, as `hakobune qtf` prints them,
without those below a thousandth of the largest force.  A median of root mean squares is what to multiply
`difference_forces.SIZES` by.  A scene depends on its number and the seed alone: many are run in slices.
"""

import argparse
import sys
import warnings
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from bem.methods.panel_problem import PanelProblem
from bem.second_order.difference_forces import difference_forces, panel_errors
from meshing.hydrostatics import hydrostatics, inertia_matrix
from meshing.lid import lid
from meshing.shapes import box, buoy

G = 9.80665
SMALL = 1e-3  # of the largest force: errors below it count as met


def scene(rng):
    """Function of a number of panels that gives a mesh; panels; depth; whether it floats"""
    panels = int(rng.uniform(120, 260))
    if rng.random() < 0.6:
        length = rng.uniform(20, 150)
        sizes = length, length * rng.uniform(0.2, 1.0), length * rng.uniform(0.05, 0.2)
        make = lambda n: box(*sizes, panels=n)  # noqa: E731
    else:
        radius = rng.uniform(3, 20)
        sizes = radius, radius * rng.uniform(0.3, 1.5)
        make = lambda n: buoy(*sizes, panels=n)  # noqa: E731
    depth = sizes[-1] * (1 + np.exp(rng.uniform(np.log(0.1), np.log(10))))
    return make, panels, depth if rng.random() < 0.85 else np.inf, rng.random() < 0.7


def problems(make, panels, depth, floats):
    """The `PanelProblem` of a quarter, half and all of four times as many panels, and how many these have"""
    finest = make(4 * panels)
    still = hydrostatics(finest)
    radii = np.array([0.35, 0.25, 0.3]) * np.ptp(finest.whole().points, axis=0)[[1, 0, 0]]
    moving = {}
    if floats:
        moving = {
            "inertia_matrix": inertia_matrix(still.mass, (0, 0, 0), radii, (0, 0, 0)),
            "hydrostatic_stiffness": still.stiffness,
        }
    meshes = make(panels // 2), make(panels), finest
    return [PanelProblem(mesh, lid(mesh), depth=depth, **moving) for mesh in meshes], [mesh.total for mesh in meshes]


def ratios(rng, surface):
    """Errors over their estimates: of pairs and components (…,) that are not both below SMALL of the largest force, and
    root mean squares over pairs (6,), NaN for those; the largest error over the force"""
    make, panels, depth, floats = scene(rng)
    (rough, fine, finest), totals = problems(make, panels, depth, floats)
    size = np.sqrt(fine.mesh.areas.mean())
    length = size * np.exp(rng.uniform(np.log(6), np.log(30)))  # of the shortest waves
    high = np.sqrt(G * 2 * np.pi / length * np.tanh(2 * np.pi / length * min(depth, 1e4)))
    omega, beta = high * (1 - 0.08 * np.arange(3)[::-1]), [rng.uniform(0, np.pi)]
    found = [difference_forces(p, omega, beta, high, floats, surface=surface) for p in (rough, fine, finest)]
    estimate = panel_errors(found[1], found[0].total, totals[1] / totals[0])
    error = np.abs(found[1].total - found[2].total) / (1 - 4.0**-1.16)  # what the finest has left
    scale = np.nanmax(np.abs(found[2].total), axis=(0, 1, 2, 3))
    scale = np.array([max(scale[:3])] * 3 + [max(scale[3:])] * 3)
    known = np.isfinite(error) & (np.maximum(error, estimate) > SMALL * scale)
    rms = [np.sqrt(np.nanmean(part**2, axis=(0, 1, 2, 3))) for part in (error, estimate)]
    together = np.where(np.maximum(*rms) > SMALL * scale, rms[0] / np.maximum(rms[1], 1e-300), np.nan)
    return error[known] / estimate[known], together, np.nanmax(error / scale)


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
    everything, means = [], []
    warnings.simplefilter("ignore")
    for number in range(given.first, given.first + given.scenes):
        found, together, largest = ratios(np.random.default_rng([given.seed, number]), given.surface)
        everything.append(found)
        means.append(together)
        print(f"{number}: median {np.median(found):.2f}, largest error {100 * largest:.2g} % of the force", flush=True)
    told("pairs and components", np.concatenate(everything))
    told("root mean squares of surge, sway and yaw", np.array(means)[:, [0, 1, 5]])
    told("root mean squares of heave, roll and pitch", np.array(means)[:, 2:5])
