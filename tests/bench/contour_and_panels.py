"""Contour method beside the panel method on boxes: largest difference of A + iB/ω and excitation, and the panel
method's own estimate of its error.

    python tests/bench/contour_and_panels.py [panels]

Six modes, headings 0, 30, 60 and 90°, ξ_B 0.1, 0.5 and 1.5; measures are those of `bem.checks`.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.checks import excitation_scale, radiation_scale
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

BEAM, DRAFT, GRAVITY = 50.0, 10.0, 9.80665
WANT = {"added_mass", "radiation_damping", "excitation_force"}
HEADINGS = np.radians([0.0, 30.0, 60.0, 90.0])


def compared(length, depth, omega, panels):
    """Difference, panels' own estimate, seconds of the two"""
    mesh, rough = (box(length, BEAM, DRAFT, panels=n) for n in (panels, panels // 2))
    problems = (
        PanelProblem(mesh, lid(mesh), (rough, lid(rough)), depth=depth),
        ShapeProblem(method="contour", shape="box", sizes=(length, BEAM, DRAFT), depth=depth, tolerance=1e-5),
    )
    runs, seconds = [], []
    for problem in problems:
        start = time.perf_counter()
        run = problem.prepared().run(omega, HEADINGS, WANT, None, ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"))
        _ = run.radiation, run.diffraction
        seconds.append(time.perf_counter() - start)
        runs.append(run)
    one, other = runs
    radiation = np.abs(one.radiation - other.radiation) / radiation_scale(one)
    force = np.abs(one.excitation - other.excitation) / excitation_scale(one)
    return radiation.max(), force.max(), one.estimated_error(), *seconds


def main(panels):
    print("| L/B | H/d | ξ_B | A + iB/ω | excitation | estimate | panels s | contour s |")
    print("|---|---|---|---|---|---|---|---|")
    for slender in (1, 2, 4, 8):
        for shallow in (1.2, 2.0, 10.0):
            for xi in (0.1, 0.5, 1.5):
                omega = np.sqrt(2 * GRAVITY * xi / BEAM)
                row = compared(slender * BEAM, shallow * DRAFT, omega, panels)
                values = " | ".join(f"{v:.1e}" for v in row[:3])
                print(f"| {slender} | {shallow} | {xi} | {values} | {row[3]:.2f} | {row[4]:.2f} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 800)
