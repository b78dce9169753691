"""Forces of pairs of waves: the diagonal beside the far field, shallow water, and what they cost.

    python tests/bench/pairs.py drift|momentum|shallow|times [--panels 400] [--surface]

drift    box of 100 × 50 × 10 m in 12, 20 and 100 m, held and afloat at 150°: largest difference of the pressure's mean
         drift from that of the far field, of the largest force
momentum the same box's pairs by a control surface around it (`control_surface`): largest differences of the pressure
         alone and with what the far field adds, of the largest force, by the difference of frequencies
shallow  cylinder on the bed of 10 m radius at kh = 0.2, as its frequencies meet: panels against its own sums
times    65 × 65 pairs at 150° on the floating box, processor seconds of the first order and of what comes after it
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

from bench.control_surface import by_momentum
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.quadratic_forces import quadratic_forces
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

RHO, G, VOLUME, RADIUS = 1025.0, 9.80665, 100 * 50 * 10.0, 10.0
INERTIA = RHO * VOLUME * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
STIFFNESS = RHO * G * np.diag([0, 0, 5000.0, 15.83 * VOLUME, 78.33 * VOLUME, 0])
HEADING = np.radians([150.0])


def floating(panels, depth):
    mesh = box(100, 50, 10, panels=panels)
    return PanelProblem(mesh, lid(mesh), depth=depth, inertia_matrix=INERTIA, hydrostatic_stiffness=STIFFNESS)


def drift(panels):
    omega = np.linspace(0.4, 1.2, 7)
    for depth in (12.0, 20.0, 100.0):
        problem = floating(panels, depth)
        for moving in (False, True):
            found = quadratic_forces(problem, omega, HEADING, 0.01, moving)
            far = found.squares[0, :, 0, 0][:, :2].real
            off = np.abs(found.added[:, 0, 0]).max(axis=0) / np.abs(far).max() / [1, 1, 50]
            numbers = ", ".join(f"{100 * value:.2f}" for value in off)
            print(f"{depth:5g} m, {problem.mesh.total} panels, {'afloat' if moving else 'held':6}: {numbers} %")


def momentum(panels):
    omega = np.linspace(0.4, 1.2, 7)
    for depth in (12.0, 20.0, 100.0):
        problem = floating(panels, depth)
        for moving in (False, True):
            right, *others = by_momentum(problem, omega, HEADING[0], moving)
            scale = np.abs(right[..., :2]).max() * np.array([1, 1, 50])
            print(f"{depth:5g} m, {problem.mesh.total} panels, {'afloat' if moving else 'held'}:")
            for m in range(len(omega)):
                one, two = np.arange(m, len(omega)), np.arange(len(omega) - m)
                off = [100 * np.abs(found - right)[one, two].max(axis=0) / scale for found in others]
                numbers = (", ".join(f"{value:.2f}" for value in part) for part in off)
                print(f"  Ω {omega[m] - omega[0]:.3f}: {next(numbers)} %, with the far field's {next(numbers)} %")


def shallow(panels):
    side = max(int(np.sqrt(panels / 4)), 4)
    for depth in (2.0, 4.0, 8.0):
        problem = PanelProblem(buoy(RADIUS, depth, counts=(side, 1, max(side // 2, 2)), bottom=False), depth=depth)
        omega = np.sqrt(G * 0.2 / depth * np.tanh(0.2))
        for apart in (1e-3, 1e-2, 0.1):
            two, one = omega * (1 - apart / 2), omega * (1 + apart / 2)
            found = quadratic_forces(problem, [two, one], [0.0], 9.0, False, surface=True).total[1, 0, 0, 0, 0]
            bound = bound_waves((one, 0.0), (two, 0.0), depth)
            exact = bound.amplitude * long_wave_force(RADIUS, depth, bound.omega, bound.number[0])
            exact += sum(force(RADIUS, depth, one, two) for force in (quadratic_force, free_surface_force))
            size, off = abs(exact) / (RHO * G * RADIUS), abs(found / exact - 1)
            print(f"kh 0.2, ka {0.2 * RADIUS / depth:.2f}, Ω/ω {apart:5g}: T/ρga {size:8.4f}, off {off:.1e}")


def times(panels, surface):
    problem, omega, marks = floating(panels, 20.0), np.linspace(0.3, 1.5, 65), {}
    start = time.process_time()

    def report(part, done, of):
        marks[part] = time.process_time() - start

    quadratic_forces(problem, omega, HEADING, 9.0, True, report, surface)
    whole, first = time.process_time() - start, marks["frequencies"]
    what = "with its forcing on the surface" if surface else "without"
    print(f"{problem.mesh.total} panels, {what}: first order {first:.1f} s, after it {whole - first:.1f} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=("drift", "momentum", "shallow", "times"))
    parser.add_argument("--panels", type=int, default=400)
    parser.add_argument("--surface", action="store_true")
    given = parser.parse_args()
    if given.what == "times":
        times(given.panels, given.surface)
    else:
        {"drift": drift, "momentum": momentum, "shallow": shallow}[given.what](given.panels)
