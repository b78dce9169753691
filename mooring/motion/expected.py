"""What a linear body would do in the same waves: the scale of errors."""

from __future__ import annotations

import numpy as np

from .wave_loads import forces_towards

LEAST = 1e-2  # of the largest translation, that every motion is allowed to be
STILL = 0.1  # m, scale of a body without waves


def expected_motion(moored, components):
    """(12,) standard deviations of the motions and velocities of the linear body, none below a share of the largest.

    Everything is taken at the frequencies of `moored.waves`: seeds differ in theirs, and what the database keeps of
    each would grow with their number.
    """
    reader, waves = moored.reader, moored.waves
    radius = np.sqrt(np.diag(reader.inertia)[3:] / reader.inertia[0, 0])
    unit = np.concatenate([np.ones(3), 1 / radius])
    if components is None:
        motion = STILL * unit
        return np.concatenate([motion, 0.5 * motion])
    energy = 0.5 * components.amplitude**2
    beta = np.arctan2(*(energy @ f(components.direction) for f in (np.sin, np.cos)))
    X = np.linalg.solve(moored.dynamic_stiffness, forces_towards(waves, beta)[:, :, None])[:, :, 0]
    squared = np.minimum(np.abs(X), 20.0 * unit) ** 2
    omega = np.clip(components.omega, waves.omega[0], waves.omega[-1])
    power = energy * np.array([np.interp(omega, waves.omega, one) for one in squared.T])
    motion, speed = np.sqrt(power.sum(axis=1)), np.sqrt(power @ omega**2)
    for part in (motion, speed):
        part[:] = np.maximum(part, LEAST * (part / unit).max() * unit)
    return np.concatenate([motion, speed])
