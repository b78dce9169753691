"""Sweep through the first ten irregular frequencies of two boxes: largest jump against the stored estimated error.

    python tests/bench/irregular.py [panels]

Boxes 100 × 50 × 10 m and 200 × 100 × 20 m over beds at 1.1 to 10 drafts and none:

    panel     lid on, through K = κ coth κd (false resonances of the water inside the hull)
    no lid    the same without, to see that the sweep would find one
    contour   method of `auto` where it takes it, through the same and through k = κ (of the plan, where φ = 0)

with κ² = π²(m²/L² + n²/B²).  A jump is what a polynomial of degree `DEGREE` in ω, fitted to `POINTS` frequencies
within 2 % of the irregular one, leaves of A + iB/ω and excitation, relative to their size (`bem.checks`).
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box
from hakobune.pipelines.validation.stress.scenes import irregular
from hakobune.pipelines.validation.stress.solved import scaled

SCENES = {(100.0, 50.0, 10.0): (12.0, 20.0, 100.0, np.inf), (200.0, 100.0, 20.0): (22.0, 30.0, 100.0, np.inf)}  # depths
WANT = {"added_mass", "radiation_damping", "diffraction_force", "excitation_force"}
HEADINGS = np.radians([0.0, 37.0, 90.0])
POINTS, DEGREE, BESIDE = 15, 5, 0.02
HIGHEST = 21  # drafts, to which `auto` takes the contour method


def panels(sizes, depth, count, with_lid=True):
    """The panel method prepared, with the coarser mesh that its estimate needs"""
    hull, rough = (box(*sizes, panels=n) for n in (count, count // 2))
    lids = [lid(mesh) if with_lid else None for mesh in (hull, rough)]
    return prepare(PanelProblem(hull, lids[0], (rough, lids[1]), depth=depth))


def contour(sizes, depth, tolerance=0.01):
    """The contour method prepared"""
    return prepare(ShapeProblem(method="contour", shape="box", sizes=sizes, depth=depth, tolerance=tolerance))


def jump(prepared, omega):
    """Largest deviation from a smooth curve within 2 % of `omega`, and the least estimated error there"""
    about = np.linspace(-1, 1, POINTS)
    omegas = omega * (1 + BESIDE * about)
    results = [scaled("", 0, prepared, w, solve_frequency(prepared, w, HEADINGS, WANT)) for w in omegas]
    middle = results[POINTS // 2]
    values = [np.concatenate([part.ravel() for part in middle.relative(r.Z, r.X)]) for r in results]
    basis = np.polynomial.legendre.legvander(about, DEGREE)
    left = np.array(values) - basis @ np.linalg.lstsq(basis, np.array(values), rcond=None)[0]
    return float(np.abs(left).max()), float(min(r.estimate for r in results))


def main(count):
    print("| box | depth | what | κ | ω | jump | estimate |\n|---|---|---|---|---|---|---|")
    worst = {}
    for sizes, depths in SCENES.items():
        for depth in depths:
            solvers = {"panel": panels(sizes, depth, count), "no lid": panels(sizes, depth, count, False)}
            if depth <= HIGHEST * sizes[2]:
                solvers |= {"contour": contour(sizes, depth), "contour, plan": contour(sizes, depth)}
            kappa, omegas = irregular("box", {"length": sizes[0], "beam": sizes[1]}, sizes[2], depth)
            for name, prepared in solvers.items():
                rows = [(*jump(prepared, w), k, w) for k, w in zip(kappa, omegas[int("plan" in name)], strict=True)]
                left, estimate, k, w = max(rows, key=lambda row: row[0] / row[1])
                worst[name] = max(worst.get(name, 0.0), left / estimate)
                place = f"{sizes[0]:g} | {depth:g} | {name} | {k:.4f} | {w:.4f}"
                print(f"| {place} | {left:.1e} | {estimate:.1e} |", flush=True)
    print("\nlargest jump over estimate:", ", ".join(f"{name} {value:.2g}" for name, value in worst.items()))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 244)
