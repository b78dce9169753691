"""Response of a linear body to the same waves: the scale of errors."""

from __future__ import annotations

import numpy as np

from ..wave_loads import forces_towards

LEAST = 1e-2  # smallest expected motion, over the largest translation
STILL = 0.1  # m, scale of a body without waves


def expected_motion(moored, components):
    """(N, 12) standard deviations of motions and velocities of the linear bodies, at least a share of the largest.

    All are computed at the frequencies of `moored.waves`: seeds have different frequencies, for each of which the
    database would store values.
    """
    reader, waves = moored.reader, moored.waves
    inertia = np.diag(reader.inertia).reshape(-1, 6)
    radius = np.sqrt(inertia[:, 3:] / inertia[:, :1])
    unit = np.concatenate([np.ones_like(radius), 1 / radius], axis=1)
    if components is None:
        motion = STILL * unit
        return np.concatenate([motion, 0.5 * motion], axis=1)
    energy = 0.5 * components.amplitude**2
    beta = np.arctan2(*(energy @ f(components.direction) for f in (np.sin, np.cos)))
    towards = beta - reader.axes_at_rest[:, 5]
    force = np.concatenate([forces_towards(*one) for one in zip(waves.each, towards, strict=True)], axis=1)
    D, free = moored.dynamic_stiffness, reader.free
    if free is None:
        X = np.linalg.solve(D, force[:, :, None])[:, :, 0]
    else:
        X = np.linalg.solve(free.T @ D @ free, (force @ free)[:, :, None])[:, :, 0] @ free.T
    squared = np.minimum(np.abs(X), 20.0 * unit.ravel()) ** 2
    omega = np.clip(components.omega, waves.omega[0], waves.omega[-1])
    power = energy * np.array([np.interp(omega, waves.omega, one) for one in squared.T])
    motion, speed = (np.sqrt(part).reshape(unit.shape) for part in (power.sum(axis=1), power @ omega**2))
    for part in (motion, speed):
        part[:] = np.maximum(part, LEAST * (part / unit).max() * unit)
    return np.concatenate([motion, speed], axis=1)
