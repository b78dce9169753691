"""Free decay of moored bodies on linear springs against the inverse Fourier transform of the frequency domain.

    python tests/bench/free_decay.py [--folder DIR] [--tolerance 1e-4]

x(t) = (2/π) ∫ Re X(ω) cos ωt dω with X from added mass and damping at every frequency (`bem.time_domain.whole_axis`),
by quadrature and without our fit of the memory.  Each motion starts alone; printed is the largest difference of 60 s,
over the start.  A little damping makes the resonances wide enough for the quadrature: twice the points change the table
by a tenth.  --tolerance : of the memory, in place of the one that a simulation takes.

The differences are of the fit: quadrature with the fitted memory in X is as far off.  An error E of the impedance at
the natural frequency moves a lightly damped decay by up to E/(e B) of its start, with B all damping there: 7 times E
over the largest impedance in surge of the buoy at 0.19 rad/s.  So the fit is nearer there, by its
`bem.time_domain.sensitivity`: no nearer than 3e-4 of the largest, as elsewhere, it left 3e-4 of the start.
"""

import argparse
import sys
import tempfile
import warnings
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "bench")]

import numpy as np
from moored_in_time import databases
from retardation import fourier_weights

from hakobune.bem.time_domain.memory import memory_of_database
from hakobune.bem.time_domain.whole_axis import ends_of, whole_axis
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather

SPRING = {"box": np.diag([5e6, 8e6, 0, 0, 0, 2e10]), "buoy": np.diag([2e5, 2e5, 0, 0, 0, 0.0])}
DAMPING = {"box": np.diag([2e6, 2e6, 0, 5e8, 5e8, 1e9]), "buoy": np.diag([1e5, 1e5, 0, 1e7, 1e7, 0.0])}
START = {"surge": (0, 1.0), "heave": (2, 0.5), "roll": (3, 0.02)}
POINTS = 12000


def spectrum(body):
    """ω (q,) and the transforms of the equation: what multiplies −iω and (−iω)², (q, 6, 6) and (6, 6)"""
    reader = body.reader
    band = np.linspace(reader.omega[0], reader.omega[-1], 800)
    axis = whole_axis(band, *reader.coefficients(band), *ends_of(reader))
    ends = np.geomspace(1e-7, 1e-3, 40)[:-1], np.geomspace(4.0, 200.0, POINTS // 2)
    omega = np.concatenate([ends[0], np.linspace(1e-3, 4.0, POINTS)[:-1], ends[1]]) * (1 + 1e-9)
    return omega, axis.transform(omega) + body.damping, reader.inertia + axis.added_mass_infinity


def difference(body, omega, K, M, mode, size):
    """Largest difference of a motion that starts alone, over its start"""
    start = np.zeros(6)
    start[mode] = size
    settings = Settings(60.0, ramp=0.0, slow_drift="none", tolerance=1e-6)
    run = simulate(replace(body, start=start), Weather(), settings)
    s = -1j * omega[:, None, None]
    X = np.linalg.solve(s**2 * M + s * K + body.reader.stiffness + body.spring, (s * M + K) @ start[:, None])
    found = (2 / np.pi) * (fourier_weights(run.time, omega).real @ X[:, mode, 0].real)
    return np.abs(run.motion[1:, mode] - found[1:]).max() / size


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", default=None, help="where the databases are kept; a temporary one if not given")
    parser.add_argument("--tolerance", type=float, default=None)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        found = databases(given.folder or temporary)
        for name, db in found.items():
            kind = name.split()[0]
            memory = None if given.tolerance is None else memory_of_database(db, given.tolerance)
            body = moored(db, memory=memory, spring=SPRING[kind], damping=DAMPING[kind])
            parts = spectrum(body)
            cells = [f"{mode} {difference(body, *parts, *start):.1e}" for mode, start in START.items()]
            print(f"{name}: {', '.join(cells)}, {body.memory}", flush=True)
