"""Slow forces of pairs of waves by level: a cylinder on the bed against its own sums, the series box in seas.

    python tests/bench/bound_waves.py [--panels 400] [--plot docs/slow_forces.png]

First T of two waves on a cylinder of radius a = 10 m in 20 m, over ρga: by Newman's approximation, with the bound
wave, with the exact squares beside it, with the forcing of the surface; and how far off are panels in what they solve
and the contour method as its gap closes.  Then standard deviations of the slow surge force of the box of 100 × 50 ×
10 m in JONSWAP seas of 1 m from ahead, held and afloat, and what each level costs in processor time; drawn afloat.
"""

import argparse
import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

from exact.maccamy_fuchs import drift
from exact.second_order_cylinder import free_surface_force, long_wave_force, quadratic_force

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.second_order.quadratic_forces import quadratic_forces
from hakobune.bem.second_order.stored import BetweenPairs
from hakobune.meshing.shapes import box, buoy
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.response.bound_wave_drift import bound_wave_forces
from hakobune.mooring.response.pair_levels import PairForces
from hakobune.mooring.response.slow_drift import force_spectrum, force_spectrum_with

RADIUS, DEPTH, RHO, G = 10.0, 20.0, 1025.0, 9.80665
GAPS = 0.4, 0.2, 0.1, 0.05
PEAKS, LEVELS = (8.0, 10.0, 12.0, 14.0), ("newman", "bound-wave", "body", "full")
PAIRS = ((0.2, 0.4), (0.4, 0.6), (0.6, 0.8), (1.0, 1.2), (1.8, 2.0))


VOLUME = 100 * 50 * 10.0
INERTIA = RHO * VOLUME * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
STIFFNESS = RHO * G * np.diag([0, 0, 5000.0, 15.83 * VOLUME, 78.33 * VOLUME, 0])


def cylinder(panels):
    side = int(np.sqrt(panels / 4))
    problem = PanelProblem(buoy(RADIUS, DEPTH, counts=(side, 1, side), bottom=False), depth=DEPTH)
    print("cylinder on the bed: T over ρga, and how far panels are off: squares, + bound, surface, all")
    print("  ka          Newman  + bound  squares  + surface")
    for pair in PAIRS:
        two, one = (np.sqrt(G * ka / RADIUS * np.tanh(ka / RADIUS * DEPTH)) for ka in pair)
        bound = bound_waves((one, 0.0), (two, 0.0), DEPTH)
        long = bound.amplitude * long_wave_force(RADIUS, DEPTH, bound.omega, bound.number[0])
        squares, surface = (force(RADIUS, DEPTH, one, two) for force in (quadratic_force, free_surface_force))
        newman = np.sqrt(drift(RADIUS, DEPTH, one)[0] * drift(RADIUS, DEPTH, two)[0])
        levels = (newman, newman + long, squares + long, squares + long + surface)
        sizes = [abs(value) / (RHO * G * RADIUS) for value in levels]
        found = quadratic_forces(problem, [two, one], [0.0], 9.0, False, surface=True)
        known = (
            (found.squares, squares),
            (found.to_body, squares + long),
            (found.surface, surface),
            (found.total, squares + long + surface),
        )
        off = [abs(value[1, 0, 0, 0, 0] / exact - 1) for value, exact in known]
        print(
            f"  {pair[0]}, {pair[1]}   {sizes[0]:8.4f} {sizes[1]:8.4f} {sizes[2]:8.4f} {sizes[3]:10.4f} "
            f"{off[0]:12.1e} {off[1]:9.1e} {off[2]:9.1e} {off[3]:9.1e}"
        )


def by_contour():
    """Cylinders with GAPS under the keel by the contour method: each halving is of first order, second, third in it"""
    print("the same by the contour method, extrapolated to no gap: how far it is off, and with the smallest gap")
    for pair in PAIRS:
        two, one = (np.sqrt(G * ka / RADIUS * np.tanh(ka / RADIUS * DEPTH)) for ka in pair)
        bound = bound_waves((one, 0.0), (two, 0.0), DEPTH)
        exact = bound.amplitude * long_wave_force(RADIUS, DEPTH, bound.omega, bound.number[0])
        exact += sum(force(RADIUS, DEPTH, one, two) for force in (quadratic_force, free_surface_force))
        found = []
        for gap in GAPS:
            body = ShapeProblem(
                method="contour", shape="buoy", sizes=(RADIUS, DEPTH - gap), depth=DEPTH, tolerance=1e-5
            )
            forces = quadratic_forces(body, [two, one], [0.0], 9.0, False, surface=True)
            found.append(forces.total[1, 0, 0, 0, 0])
        last, order = found[-1], 1
        while len(found) > 1:
            found = [(2**order * b - a) / (2**order - 1) for a, b in pairwise(found)]
            order += 1
        print(f"  {pair[0]}, {pair[1]}   {abs(found[0] / exact - 1):.1e} {abs(last / exact - 1):.1e}", flush=True)


def seas(panels):
    """{(depth, afloat): (peak periods, 4) kN by level}"""
    out = {}
    omega, difference = np.linspace(0.3, 1.8, 51), np.linspace(0.0, 0.2, 41)
    for depth in (12.0, 20.0):
        mesh = box(100, 50, 10, panels=panels)
        problem = PanelProblem(mesh, depth=depth, inertia_matrix=INERTIA, hydrostatic_stiffness=STIFFNESS)
        for moving in (False, True):
            start = time.process_time()
            found = quadratic_forces(problem, omega, [np.pi], 0.36, moving, surface=True)
            seconds = time.process_time() - start
            D = found.squares[0, :, 0, 0][:, [0, 1, 5]].real
            pairs = [
                PairForces(BetweenPairs(omega, found.frequency, values[:, :, 0, 0]), omega, D)
                for values in (found.to_body, found.total)
            ]
            print(f"series box {'afloat' if moving else 'held'} in {depth:g} m, {mesh.total} panels, σ of surge, kN")
            heads = f"  {'Newman':>15} {'+ bound wave':>13} {'body':>8} {'full':>8}"
            print(f"{heads}   s of processor: bound wave; full {seconds:.1f}")
            out[depth, moving] = np.empty((len(PEAKS), len(LEVELS)))
            for i, peak in enumerate(PEAKS):
                spectrum = jonswap(1.0, peak_period=peak)
                mean = float(spectrum.moment(1) / spectrum.moment(0))
                start = time.process_time()
                bound = bound_wave_forces(problem, spectrum.quantile((1e-4, 0.999)), mean, np.pi)
                seconds_bound = time.process_time() - start
                spectra = [force_spectrum(spectrum, omega, D, difference)]
                spectra += [force_spectrum_with(part, spectrum, omega, D, difference) for part in (bound, *pairs)]
                sigma = [np.sqrt(np.trapezoid(S[:, 0], difference)) / 1e3 for S in spectra]
                values = " ".join(f"{value:{width}.1f}" for value, width in zip(sigma, (8, 13, 8, 8), strict=True))
                print(f"  Tp {peak:2g} s {values} {seconds_bound:12.1f}")
                out[depth, moving][i] = sigma
    return out


def draw(sigma, path):
    """The slow force of the floating box over the peak period, by level, a picture for each depth"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 3.4), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for axis, depth in zip(axes, (12.0, 20.0), strict=True):
        for name, values in zip(LEVELS, sigma[depth, True].T, strict=True):
            axis.plot(PEAKS, values, "o-" if name == "full" else "o--", lw=2.2 if name == "full" else 1.2, label=name)
        axis.set(title=f"{depth:g} m of water", xlabel="peak period of the waves,  s", xticks=PEAKS, ylim=(0, None))
        axis.grid(True, color="0.9", linewidth=0.6)
    axes[0].set_ylabel("σ of slow surge force  kN")
    axes[0].legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--panels", type=int, default=400)
    parser.add_argument("--plot", help="picture of the floating box")
    asked = parser.parse_args()
    cylinder(asked.panels)
    by_contour()
    found = seas(asked.panels)
    if asked.plot:
        draw(found, asked.plot)
