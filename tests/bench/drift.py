"""Mean drift of the series box by pressure on the hull beside the far field, over depths, headings, frequencies.

    python tests/bench/drift.py [contour | panel | cylinder]

Largest of surge, sway and yaw at half the length, as parts of the largest force on the fixed box.  `estimate` is that
of the pressures, `near_field.near_field_error`, of panels from a mesh with half as many, and `part` the largest part of
it that near and far field differ by at any heading; `change` is what a tenth of the tolerance, or twice the panels,
makes of the two together.  The frequencies hold that of the resonance in roll, where the drift is what large pressures
leave: then `roll`, the motion of the side in m per m of wave, is several.
Times are the least of three, of the motions, forces and far-field drift with their own error estimate, and of the
near field of all headings.

`cylinder`: a cylinder of radius and draft 10 m beside its exact far field, parts of the largest force on the fixed one.
"""

import sys
import time
from functools import partial
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from exact.truncated_cylinder import TruncatedCylinder

from hakobune.bem import DOFS
from hakobune.bem.methods.near_field import near_field_drift, near_field_error
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

RHO, G = 1025.0, 9.80665
SIZES = LENGTH, BEAM, DRAFT = 100.0, 50.0, 10.0
MASS = RHO * LENGTH * BEAM * DRAFT
FLOATING = {
    "inertia_matrix": MASS * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2]),
    "hydrostatic_stiffness": G * np.diag([0, 0, RHO * LENGTH * BEAM, 15.83 * MASS, 78.33 * MASS, 0]),
}
WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed", "drift_force", "rao"}
HEADINGS = np.radians([0, 15, 30, 45, 60, 75, 90])
OMEGAS = (0.3, 0.5, 0.7, 0.9, 1.1, 1.5)
RESONANCE = {12.0: 0.425, 20.0: 0.575}  # rad/s of roll, elsewhere
DEEP = 0.62
ARMS = np.array([1, 1, LENGTH / 2])


def contour(depth, tolerance):
    return ShapeProblem(
        method="contour", shape="box", sizes=SIZES, depth=depth, tolerance=tolerance, **FLOATING
    ).prepared()


def panel(depth, panels):
    mesh, half = box(*SIZES, panels=panels), box(*SIZES, panels=panels // 2)
    return PanelProblem(mesh, lid(mesh), coarse=(half, lid(half)), depth=depth, **FLOATING).prepared()


def drifts(body, omega):
    """(3, 2, m, 3) near, far and estimated error, fixed and floating; seconds of first order and near field; roll"""
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        run = body.run(omega, HEADINGS, WANT, None, DOFS)
        far = [run.drift(moving) for moving in (False, True)]
        run.estimated_error()
        middle = time.perf_counter()
        near = [near_field_drift(run, True)]
        seconds.append((middle - start, time.perf_counter() - middle))
    near.insert(0, near_field_drift(run, False))
    roll = BEAM / 2 * np.abs(run.rao[:, 3]).max()
    estimated = [near_field_error(run, moving) for moving in (False, True)]
    return np.array([near, far, estimated]) / ARMS, np.min(seconds, axis=0), roll


def rows(name, depth, rough, fine):
    for omega in sorted([*OMEGAS, RESONANCE.get(depth, DEEP)]):
        ours, seconds, roll = drifts(rough, omega)
        better, *_ = drifts(fine, omega)
        scale = np.abs(ours[1, 0, :, :2]).max()
        gap, estimated = np.abs(ours[0] - ours[1]), ours[2]  # fixed and floating, headings, components
        part = (gap / estimated).max(axis=(1, 2))
        change = np.abs(ours - better)[:2].max(axis=(2, 3)).sum(axis=0)
        parts = (
            f"{gap[i].max() / scale:.1e} | {estimated[i].max() / scale:.1e} | {part[i]:.2f} | {change[i] / scale:.1e}"
            for i in range(2)
        )
        cells = name, f"{depth:g}", str(omega), f"{roll:.1f}", *parts, *(f"{s:.3f}" for s in seconds)
        print(f"| {' | '.join(cells)} |", flush=True)


def cylinder_rows(depth, radius=10.0, draft=10.0, heading=0.6):
    """Largest errors of surge and sway near and far, fixed and floating, of the contour method and of 400 panels"""
    mass = RHO * np.pi * radius**2 * draft
    moving = {
        "inertia_matrix": mass * np.diag([1, 1, 1, radius**2 / 3, radius**2 / 3, radius**2 / 2]),
        "hydrostatic_stiffness": RHO * G * np.pi * radius**2 * np.diag([0, 0, 1, radius**2 / 4, radius**2 / 4, 0]),
    }
    mesh = buoy(radius, draft, panels=400)
    bodies = {
        "contour 0.001": ShapeProblem(
            method="contour", shape="buoy", sizes=(radius, draft), depth=depth, tolerance=1e-3, **moving
        ),
        "400 panels": PanelProblem(mesh, lid(mesh), depth=depth, **moving),
    }
    for name, problem in bodies.items():
        body, worst = problem.prepared(), np.zeros((2, 2))
        for kr in (0.5, 1.0, 2.0, 3.0):
            omega = np.sqrt(G * kr / radius * np.tanh(kr * depth / radius))
            exact = TruncatedCylinder(radius, draft, depth, omega, RHO, G)
            right = exact.drift_fixed(heading), exact.drift_free(heading, *moving.values())
            run = body.run(omega, [heading], WANT, None, DOFS)
            fields = partial(near_field_drift, run), run.drift
            found = [[field(free)[0, :2] for free in (False, True)] for field in fields]
            worst = np.maximum(worst, np.abs(found - np.array(right)).max(axis=-1) / np.abs(right[0]).max())
        print(f"| {name} | {depth:g} | {' | '.join(f'{w:.1e}' for w in worst.ravel())} |", flush=True)


def boxes(methods):
    each = "near − far | estimate | part | change"
    print(f"| method | depth m | ω rad/s | roll | fixed: {each} | floating: {each} | far s | near s |")
    print("|---" * 14 + "|")
    for depth in (12.0, 20.0, 100.0, 2000.0):
        for tolerance in (1e-2, 1e-3, 1e-4) if "contour" in methods else ():
            bodies = contour(depth, tolerance), contour(depth, tolerance / 10)
            rows(f"contour {tolerance:g}", depth, *bodies)
    for depth in (12.0, 20.0, 100.0, np.inf):
        for panels in (100, 400) if "panel" in methods else ():
            rows(f"{panels} panels", depth, panel(depth, panels), panel(depth, 2 * panels))


def cylinders():
    print("| cylinder | depth m | near: fixed | floating | far: fixed | floating |")
    print("|---" * 6 + "|")
    for depth in (12.0, 30.0, 100.0):
        cylinder_rows(depth)


def main(methods):
    if {"contour", "panel"} & set(methods):
        boxes(methods)
    if "cylinder" in methods:
        cylinders()


if __name__ == "__main__":
    main(sys.argv[1:] or ("contour", "panel", "cylinder"))
