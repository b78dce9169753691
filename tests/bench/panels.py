"""What a frequency of the panel method costs and where: beside the limits of this machine, for one band.

    python tests/bench/panels.py [panels …]

Box 100 × 50 × 10 m in 20 m of water, two mirror planes, six motions and one heading, 0.1 to 1.2 rad/s; the least of
several times.  "pair" is a pair of nodes with one image.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np
from scipy.linalg import lu_factor

from hakobune.bem import DOFS
from hakobune.bem.green.tables import wave_table
from hakobune.bem.kernels.threads import thread_count
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.band.one_frequency import BandRun
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.bem.panels.wave_influence import wave_blocks
from hakobune.bem.waves import depth_values, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

BAND, DEPTH, GRAVITY = (0.1, 1.2), 20.0, 9.80665
OMEGAS = 0.6, 1.1  # solved without and with the lid
WANT = {"added_mass", "radiation_damping", "excitation_force"}
DIRECT = 1200  # panels up to which every frequency is solved on its own, too


def least(work, trials=5):
    times = []
    for _ in range(trials):
        start = time.perf_counter()
        out = work()
        times.append(time.perf_counter() - start)
    return min(times), out


def machine():
    """GFLOP/s of a real and a complex product and factorisation, n = 1000"""
    real = np.random.default_rng(0).standard_normal((1000, 1000))
    both = real + 1j * real.T
    product, _ = least(lambda: real @ real)
    factor, _ = least(lambda: lu_factor(real))
    complex_factor, _ = least(lambda: lu_factor(both))
    print(
        f"machine, {thread_count()} threads: product {2e0 / product:.0f}, "
        f"factorisation {2 / 3 / factor:.0f}, complex {8 / 3 / complex_factor:.0f} GFLOP/s\n"
    )


def body(panels):
    mesh = box(100, 50, 10, panels=panels)
    wave = 2 * np.pi / wavenumber(BAND[1], DEPTH)
    return prepare(PanelProblem(mesh, lid(mesh, max(wave / 5, np.sqrt(3 * 5000 / mesh.total))), depth=DEPTH, band=BAND))


def pair_times(prepared):
    """ns of a pair: exact 1/r with its images in surface and bed, and waves"""
    g = prepared.geometry
    nodes = np.arange(0, len(g.elements.nodes), max(len(g.elements.nodes) // 64, 1))
    pairs = len(nodes) * len(g.elements.nodes) * len(g.images)
    exact, _ = least(lambda: g.rankine_rows(g.elements.nodes[nodes]))
    k = float(wavenumber(0.6, DEPTH))
    filling, table = least(lambda: wave_table(0.6, DEPTH, GRAVITY, g.reach, g.mesh.draft))
    everywhere = np.arange(len(g.elements.nodes))
    waves, _ = least(lambda: wave_blocks(g, nodes, everywhere, table, depth_values(k, DEPTH)))
    return 1e9 * exact / pairs, 1e9 * waves / pairs, 1e3 * filling


def frequency(run_class, prepared, omega):
    """ms of a frequency and of its parts"""
    took, run = least(lambda: _run(run_class, prepared, omega))
    return 1e3 * took, {name: round(1e3 * value, 1) for name, value in run.wall_time.items()}


def _run(run_class, prepared, omega):
    run = run_class(prepared, omega, [0.5], WANT, None, DOFS)
    run.result()
    return run


def main(counts):
    machine()
    for panels in counts:
        prepared = body(panels)
        exact, waves, filling = pair_times(prepared)
        n, lid_nodes = prepared.geometry.hull, len(prepared.geometry.elements.nodes) - prepared.geometry.hull
        print(f"{prepared.problem.mesh.total} panels, {n} + {lid_nodes} unknowns to a class")
        print(f"  pair: 1/r {exact:.1f} ns, waves {waves:.1f} ns; table {filling:.1f} ms")
        start = time.perf_counter()
        bases = [part.low_rank for part in prepared.band_equations]
        took = time.perf_counter() - start
        print(f"  band: {took:.2f} s to prepare")
        for omega, basis in zip(OMEGAS, bases, strict=True):
            shared, parts = frequency(BandRun, prepared, omega)
            nodes = f"{len(basis.points)} points, {len(basis.sources)} sources"
            print(f"  ω = {omega} of it: {nodes}, {shared:.1f} ms {parts}")
            if panels <= DIRECT:
                alone, parts = frequency(PanelRun, prepared, omega)
                print(f"  ω = {omega} alone: {alone:.1f} ms {parts}")


if __name__ == "__main__":
    main([int(a) for a in sys.argv[1:]] or [250, 1000, 4000])
