"""Error against time of the contour method: cylinders against the exact one, boxes against a tolerance of 1e-7.

    python tests/bench/contour.py [--quick] [tolerance …]

Errors are the largest over the frequencies of A + iB/ω (relative to √|ZᵢᵢZⱼⱼ|), excitation and fixed drift at three
headings; `law` is the worst of reciprocity, Haskind and energy.  Times are processor times of one thread, the least
of five, median over the frequencies: all modes, one heading, Kochin functions.  The layout of the waves' plane
problem, which frequencies within a fifth share, is not counted.  `waves` is the part of that problem, `modes` that
of the sums over all other modes.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from exact.truncated_cylinder import TruncatedCylinder
from identities.test_contour_exact import HEADINGS, RHO, G, Solved, frequency

from hakobune.bem.contour.one_frequency import ContourFrequency
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.kernels.threads import blas_threads
from hakobune.bem.kochin import angles
from hakobune.bem.waves import wavenumber

KH = (0.05, 0.2, 1.0, 3.0, 8.0, 20.0)
CYLINDERS = ((10, 10, 10.2), (10, 10, 12), (10, 10, 30), (10, 10, 100), (50, 10, 12), (2, 10, 20))
BOXES = (
    (100, 50, 10, 12), (100, 50, 10, 14), (100, 50, 10, 20), (100, 50, 10, 50), (100, 50, 10, 100),
    (50, 50, 10, 20), (200, 50, 10, 20), (400, 50, 10, 20),
)  # fmt: skip


def least(function, repeat=5):
    """Seconds"""
    times = []
    for _ in range(repeat):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def times(body, omega):
    """Seconds of a whole frequency, of its waves and of its mode sums"""
    theta = angles(float(wavenumber(omega, body.depth)), body.plan.reach)

    def fresh():
        return ContourFrequency(body, omega, [0.6], theta, range(6), RHO, G)

    one = fresh()
    whole = least(lambda: body.first_order(omega, [0.6], np.append(theta, 0.6)))
    waves = least(lambda: one.body.plan.waves(one.classes, one.degree, one.k, one.contour, one.headings))
    return whole, waves, least(lambda: fresh().outer_weights)


def row(name, prepare, reference, dimensions, tolerance):
    """One line of the table"""
    start = time.perf_counter()
    body = prepare(*dimensions, tolerance=tolerance)
    body.first_order(frequency(1.0, body.depth), [0.6])
    prepared = time.perf_counter() - start
    errors, laws, seconds = [], [], []
    for kh in KH:
        omega = frequency(kh, body.depth)
        ours = Solved(body, omega)
        errors.append(ours.error(*reference(dimensions, omega)))
        laws.append(max(ours.defects().values()))
        seconds.append(times(body, omega))
    whole, waves, modes = 1e3 * np.median(seconds, axis=0)
    one, fine = (Solved(b, frequency(1.0, body.depth)) for b in (body, body.finer))
    estimate = one.error(fine.Z, fine.force, fine.drift)
    size = " × ".join(f"{d:g}" for d in dimensions)
    print(
        f"| {name} {size} | {tolerance:.0e} | {max(errors):.1e} | {estimate:.1e} | {max(laws):.1e} | {prepared:.2f} "
        f"| {whole:.1f} | {1e3 * max(s[0] for s in seconds):.0f} | {waves:.1f} | {modes:.1f} |",
        flush=True,
    )


def exact(dimensions, omega):
    body = TruncatedCylinder(*dimensions, omega, RHO, G)
    force = np.array([body.excitation(b) for b in HEADINGS])
    drift = np.array([[*body.drift_fixed(b), 0.0] for b in HEADINGS])
    return body.added_mass() + 1j * body.damping() / omega, force, drift


FINE = {}


def finest(dimensions, omega):
    body = FINE.setdefault(dimensions, prepare_box(*dimensions, tolerance=1e-7))
    if (dimensions, omega) not in FINE:
        FINE[dimensions, omega] = Solved(body, omega)
    solved = FINE[dimensions, omega]
    return solved.Z, solved.force, solved.drift


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tolerances", type=float, nargs="*", default=[1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
    parser.add_argument("--quick", action="store_true", help="a cylinder and a box at 1e-3, some seconds")
    asked = parser.parse_args(words)
    if asked.quick:
        table([1e-3], CYLINDERS[2:3], BOXES[2:3])
    else:
        table(asked.tolerances, CYLINDERS, BOXES)


def table(tolerances, cylinders, boxes):
    print("| body (m) | tolerance | error | estimate | law | prepare s | ms | longest ms | waves ms | modes ms |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    with blas_threads(1):
        for tolerance in tolerances:
            for dimensions in cylinders:
                row("cylinder", prepare_cylinder, exact, dimensions, tolerance)
            for dimensions in boxes:
                row("box", prepare_box, finest, dimensions, tolerance)


if __name__ == "__main__":
    main()
