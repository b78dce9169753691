"""What a frequency costs when less is asked for: symmetry classes solved, right-hand sides, time (warm).

    python tests/bench/skips.py

Box 100 × 50 × 10 m in 20 m of water, 244 panels on the whole hull, ω = 0.6 rad/s.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, box_counts

DRIFT = {"kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force"}
FORCES = {"added_mass", "radiation_damping", "excitation_force", "rao"}
CASES = (
    ("everything, headings 0 45 90", (0, 45, 90), FORCES | DRIFT, DOFS),
    ("everything, heading 0", (0,), FORCES | DRIFT, DOFS),
    ("no drift, no Kochin functions", (0, 45, 90), FORCES, DOFS),
    ("fixed body: excitation", (0, 45, 90), {"excitation_force"}, DOFS),
    ("fixed body, heading 0, surge heave pitch", (0,), {"excitation_force"}, ("Surge", "Heave", "Pitch")),
    ("added mass in surge", (), {"added_mass"}, ("Surge",)),
    ("Froude–Krylov force", (0, 45, 90), {"Froude_Krylov_force"}, DOFS),
)


def body(symmetry):
    mesh = box(100, 50, 10, counts=box_counts(100, 50, 10, 250), symmetry=symmetry)
    mass, buoyancy = 1025 * 50000, 1025 * 9.80665 * 50000
    inertia = mass * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
    stiffness = buoyancy * np.diag([0, 0, 0.1, 15.83, 78.33, 0])
    return prepare(PanelProblem(mesh, lid(mesh), depth=20.0, inertia_matrix=inertia, hydrostatic_stiffness=stiffness))


def best(work, times=7):
    work()
    return min(_seconds(work) for _ in range(times))


def _seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main():
    bodies = {s: body(s) for s in ("xy", "y", "")}
    print("| case | mirror planes | classes | right-hand sides | ms |\n|---|---|---|---|---|")
    for symmetry, prepared in bodies.items():
        for name, degrees, want, dofs in CASES if symmetry == "xy" else CASES[:1]:
            headings, theta = np.radians(degrees), 2 * np.pi * np.arange(120) / 120
            run = PanelRun(prepared, 0.6, headings, want, theta, dofs)
            run.result()
            sides = sum(len(moving) + len(waves) for moving, waves in run.columns.values())
            ms = 1e3 * best(lambda: solve_frequency(prepared, 0.6, headings, want, theta, dofs))  # noqa: B023
            print(f"| {name} | {len(symmetry)} | {len(run.columns)} | {sides} | {ms:.0f} |")


if __name__ == "__main__":
    main()
