"""What bound long waves add to slow drift: a cylinder on the bed against its own sums, the series box in seas.

    python tests/bench/bound_waves.py [--panels 400]

First T of two waves on a cylinder of radius a = 10 m in 20 m, over ρga: by Newman's approximation, with
the bound wave, with the exact quadratic force beside it, and what the panels make of the bound wave.  Then standard
deviations of the slow surge force of the box of 100 × 50 × 10 m in JONSWAP seas of 1 m from ahead.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

from exact.maccamy_fuchs import drift
from exact.second_order_cylinder import long_wave_force, quadratic_force

from bem import DOFS
from bem.methods.panel_problem import PanelProblem
from bem.second_order.bound_waves import bound_waves
from bem.second_order.long_wave_forces import LongWaveBody
from meshing.shapes import box, buoy
from mooring.environment.spectra import jonswap
from mooring.response.bound_wave_drift import bound_wave_forces
from mooring.response.slow_drift import force_spectrum, force_spectrum_with

RADIUS, DEPTH, RHO, G = 10.0, 20.0, 1025.0, 9.80665
PAIRS = ((0.2, 0.4), (0.4, 0.6), (0.6, 0.8), (1.0, 1.2), (1.8, 2.0))


def cylinder(panels):
    side = int(np.sqrt(panels / 4))
    pile = LongWaveBody(PanelProblem(buoy(RADIUS, DEPTH, counts=(side, 1, side), bottom=False), depth=DEPTH))
    print("cylinder on the bed: T over ρga\n  ka          Newman  + bound  exact squares + bound     panels off")
    for pair in PAIRS:
        two, one = (np.sqrt(G * ka / RADIUS * np.tanh(ka / RADIUS * DEPTH)) for ka in pair)
        bound = bound_waves((one, 0.0), (two, 0.0), DEPTH)
        exact = long_wave_force(RADIUS, DEPTH, bound.omega, bound.number[0])
        found = pile.forces(bound.omega, bound.number)[0, 0]
        newman = np.sqrt(drift(RADIUS, DEPTH, one)[0] * drift(RADIUS, DEPTH, two)[0])
        whole = quadratic_force(RADIUS, DEPTH, one, two) + bound.amplitude * exact
        sizes = [abs(value) / (RHO * G * RADIUS) for value in (newman, newman + bound.amplitude * exact, whole)]
        print(
            f"  {pair[0]}, {pair[1]}   {sizes[0]:8.3f} {sizes[1]:8.3f} {sizes[2]:16.3f} {abs(found / exact - 1):20.1e}"
        )


def seas(panels):
    print("series box held fixed, σ of the slow surge force in seas of 1 m, kN: Newman, with bound waves; s to solve")
    for depth in (12.0, 20.0):
        problem = PanelProblem(box(100, 50, 10, panels=panels), depth=depth)
        omega = np.linspace(0.3, 1.5, 61)
        prepared, force = problem.prepared(), []
        for w in omega:
            run = prepared.run(w, [np.pi], {"drift_force_fixed"}, None, DOFS)
            force.append(run.drift(False)[0])
        for peak in (8.0, 10.0, 12.0, 14.0):
            spectrum, difference = jonswap(1.0, peak_period=peak), np.linspace(0.0, 0.2, 41)
            mean = float(spectrum.moment(1) / spectrum.moment(0))
            start = time.perf_counter()
            bound = bound_wave_forces(problem, spectrum.quantile((1e-4, 0.999)), mean, np.pi)
            seconds = time.perf_counter() - start
            newman = force_spectrum(spectrum, omega, np.array(force), difference)[:, 0]
            both = force_spectrum_with(bound, spectrum, omega, np.array(force), difference)[:, 0]
            sigma = [np.sqrt(np.trapezoid(S, difference)) / 1e3 for S in (newman, both)]
            print(f"  {depth:g} m, Tp {peak:g} s: {sigma[0]:7.1f} {sigma[1]:7.1f}   {seconds:.1f} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--panels", type=int, default=400)
    panels = parser.parse_args().panels
    cylinder(panels)
    seas(panels)
