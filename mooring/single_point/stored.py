"""What a database gives a body at a single point: its mean drift at every heading."""

from __future__ import annotations

import numpy as np

from ..motion.wave_loads import HEADINGS, drift_damping


def mean_drift(forces, sea, carrier=None, depth=np.inf, gravity=9.80665):
    """(HEADINGS, 3) N, N, N m of mean drift in axes of the body, at headings from 0 round, in a `Sea`.

    forces : `mooring.motion.wave_loads.WaveForces` with drift
    carrier : `mooring.on_current.waves.Carrier` of the waves in `depth` m, of which D + B V is taken; None for none
    """
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    density = np.asarray(sea.spectrum.density(forces.omega))
    mean = 2 * np.trapezoid(forces.drift * density[:, None, None], forces.omega, axis=0)
    if carrier is None:
        return np.stack([sea.directional(headings + heading) @ mean for heading in headings])
    own = np.clip(
        carrier.own(forces.omega, sea.direction, depth, gravity), forces.omega[0], forces.omega[-1]
    )  # of a spread sea that of its mean direction
    drift, B = drift_damping(forces, own, depth, gravity)
    mean, damping = (2 * np.trapezoid((of.T * density).T, forces.omega, axis=0) for of in (drift, B))
    towards, speed, rows = np.arctan2(carrier.velocity[1], carrier.velocity[0]), np.hypot(*carrier.velocity), []
    for heading in headings:
        velocity = speed * np.array([np.cos(towards - heading), np.sin(towards - heading)])
        rows.append(sea.directional(headings + heading) @ (mean + damping @ velocity))
    return np.stack(rows)
