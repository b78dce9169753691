"""Free decay on linear springs against the inverse Fourier transform of the database, without our fit of its memory.

    x(t) = (2/π) ∫ Re X(ω) cos ωt dω

Surge, heave and roll of the box in 12 and in 20 m of water, and of the buoy, whose surge at 0.19 rad/s has a seventh of
the damping that the scale of its memory is.
"""

from dataclasses import replace

import numpy as np
import pytest
from retardation import fourier_weights

from hakobune.bem.database import open_database
from hakobune.bem.time_domain.whole_axis import ends_of, whole_axis
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.pipelines.cli import main

START = 0.01 * np.array([1.0, 0, 0.5, 0.02, 0, 0])  # together: what turns of the axes couple is of second order
MODES = (0, 2, 3)
SETTINGS = Settings(duration=60.0, ramp=0.0, slow_drift="none", tolerance=1e-7)
BAND = "--omega 0.12:2:50 --heading 0:90:4"
SOLVED = {
    "box 12 m": f"box --length 100 --beam 50 --draft 10 --depth 12 --gyration 15.55,29.44,32.28 {BAND}",
    "buoy": f"buoy --radius 10 --draft 10 --depth 30 --gyration 6,6,7 --center-of-gravity 0,0,-6 {BAND}",
}
SPRING = {"box": np.diag([5e6, 8e6, 0, 0, 0, 2e10]), "buoy": np.diag([2e5, 2e5, 0, 0, 0, 0.0])}
DAMPING = {"box": np.diag([2e6, 2e6, 0, 5e8, 5e8, 1e9]), "buoy": np.diag([1e5, 1e5, 0, 1e7, 1e7, 0.0])}


@pytest.fixture(params=["box 12 m", "box 20 m", "buoy"])
def body(request, tmp_path):
    """A body on springs, with so much damping that its resonances are wide enough for the quadrature"""
    kind = request.param.split()[0]
    if request.param not in SOLVED:
        return replace(request.getfixturevalue("on_springs"), damping=DAMPING[kind])
    path = tmp_path / "body.h5"
    assert main([*SOLVED[request.param].split(), "--output", str(path)]) == 0
    return moored(open_database(path), spring=SPRING[kind], damping=DAMPING[kind])


def transformed(body, times):
    """(t, 6) motion by quadrature"""
    reader = body.reader
    band = np.linspace(reader.omega[0], reader.omega[-1], 800)
    axis = whole_axis(band, *reader.coefficients(band), *ends_of(reader))
    parts = np.geomspace(1e-7, 1e-3, 40)[:-1], np.linspace(1e-3, 1.2, 9000)[:-1], np.geomspace(1.2, 200.0, 3000)
    omega = np.concatenate(parts) * (1 + 1e-9)  # none of those of the axis
    K, s = axis.transform(omega) + body.damping, -1j * omega[:, None, None]
    M = reader.inertia + axis.added_mass_infinity
    X = np.linalg.solve(s**2 * M + s * K + reader.stiffness + body.spring, (s * M + K) @ START[:, None])[..., 0]
    return (2 / np.pi) * (fourier_weights(times, omega).real @ X.real)


def test_free_decay_is_the_inverse_fourier_transform_of_the_database(body):
    run = simulate(replace(body, start=START), Weather(), SETTINGS)
    off = np.abs(run.motion - transformed(body, run.time))[run.time > 0].max(axis=0)
    assert np.all(off[[*MODES]] <= 1e-4 * START[[*MODES]]), off[[*MODES]] / START[[*MODES]]
