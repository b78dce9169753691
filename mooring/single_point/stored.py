"""What a database gives a body at a single point: its mean drift at every heading."""

from __future__ import annotations

import numpy as np

from ..motion.wave_loads import HEADINGS


def mean_drift(forces, sea):
    """(HEADINGS, 3) N, N, N m of mean drift in axes of the body, at headings from 0 round, in a `Sea`.

    forces : `mooring.motion.wave_loads.WaveForces` with drift
    """
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    density = np.asarray(sea.spectrum.density(forces.omega))
    mean = 2 * np.trapezoid(forces.drift * density[:, None, None], forces.omega, axis=0)
    return np.stack([sea.directional(headings + heading) @ mean for heading in headings])
