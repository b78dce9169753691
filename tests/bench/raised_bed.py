"""The contour method over a raised bed beside beds four times as deep and the panel method in endless depth.

    python tests/bench/raised_bed.py [--panels 400] [--quick]

Waves from the longest that `bem.contour.raised_bed` takes to ten times shorter; tolerance 1 %.  Columns: differences of
A + iB/ω, of damping by its own size and of the excitation (`bem.checks`) from the deeper bed at a tenth of the
tolerance, the stored estimate and the bed's part of it, the first and last of these from so many panels (or none) and
their estimate, seconds of the two.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.checks import damping_scale, excitation_scale, radiation_scale
from hakobune.bem.contour.raised_bed import effect_of_bed, raised_bed
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

BODIES = [
    (100, 1), (100, 5), (40, 10), (10, 10), (10, 20), (10, 50), (10, 100),
    (40, 40, 2), (40, 40, 10), (100, 40, 12), (100, 50, 1), (300, 60, 20), (100, 10, 1), (200, 20, 10), (400, 20, 5),
    (1000, 50, 1), (200, 40, 40), (20, 2, 2), (20, 2, 10), (1.04, 0.745, 3.73),
]  # fmt: skip
GRAVITY, TOLERANCE, MOST_WAVES = 9.80665, 0.01, 30
WANT, HEADINGS = {"added_mass", "radiation_damping", "excitation_force"}, np.radians([0.0, 30.0, 77.0])


def contour(shape, sizes, bed, tolerance=TOLERANCE, depth=np.inf):
    return ShapeProblem(method="contour", shape=shape, sizes=sizes, tolerance=tolerance, depth=depth, bed=bed)


def panels(shape, sizes, count):
    make = box if shape == "box" else buoy
    mesh, rough = (make(*sizes, panels=n) for n in (count, count // 2))
    return PanelProblem(mesh, lid(mesh), (rough, lid(rough)))


def solved(problem, k, estimated=True):
    """The run at k rad/m, and seconds"""
    start = time.perf_counter()
    run = problem.prepared().run(np.sqrt(GRAVITY * k), HEADINGS, WANT, None, DOFS)
    _ = run.estimated_error() if estimated else run.radiation
    return run, time.perf_counter() - start


def difference(one, other):
    radiation = np.abs(one.radiation - other.radiation) / radiation_scale(other)
    size = damping_scale(other.radiation, other.prepared.displacing)
    damping = np.abs((one.radiation - other.radiation).imag) / size
    return radiation.max(), damping.max(), (np.abs(one.excitation - other.excitation) / excitation_scale(other)).max()


def longest_wave(shape, sizes):
    """Smallest k that is answered over a bed, rad/m, to a per cent"""
    k = 2 * np.pi / (max(sizes[:-1]) * (1 if shape == "box" else 2))
    while raised_bed(shape, sizes, TOLERANCE, k) is None:
        k *= 1.01
    return k


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--panels", type=int, default=0)
    parser.add_argument("--quick", action="store_true", help="two bodies, some seconds")
    asked = parser.parse_args(words)
    highest = bem.contour.solver.HIGHEST_GAP
    bem.contour.solver.HIGHEST_GAP = np.inf  # for the deeper beds
    try:
        table(BODIES[2:6:3] if asked.quick else BODIES, asked.panels)
    finally:
        bem.contour.solver.HIGHEST_GAP = highest


def table(bodies, count):
    print(
        "| body | waves | kd | A + iB/ω | damping | excitation | estimate | bed | panels: A + iB/ω, X | estimate "
        "| s | s |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for sizes in bodies:
        shape = "box" if len(sizes) == 3 else "buoy"
        across, k0 = max(sizes[:-1]) * (1 if shape == "box" else 2), longest_wave(shape, sizes)
        for k in (k0, 3 * k0, 10 * k0):
            if k * across > 2 * np.pi * MOST_WAVES:
                continue
            bed = raised_bed(shape, sizes, TOLERANCE, k)
            ours, seconds = solved(contour(shape, sizes, bed), k)
            deep, _ = solved(contour(shape, sizes, sizes[-1] + 4 * (bed - sizes[-1]), TOLERANCE / 10), k, False)
            row = [*difference(ours, deep), ours.estimated_error(), effect_of_bed(shape, sizes, bed)]
            cells = [f"{v:.1e}" for v in row]
            if count and k == k0:
                other, slow = solved(panels(shape, sizes, count), k)
                z, _, x = difference(ours, other)
                cells += [f"{z:.1e}, {x:.1e}", f"{other.estimated_error():.1e}", f"{seconds:.2f}", f"{slow:.1f}"]
            else:
                cells += ["", "", f"{seconds:.2f}", ""]
            name = " × ".join(map(str, sizes))
            phase = k * sizes[-1]
            print(f"| {name} | {k * across / 2 / np.pi:.1f} | {phase:.2g} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
