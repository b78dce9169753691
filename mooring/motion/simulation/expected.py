"""Response of a linear body to the waves of a run, as the scale of errors."""

import numpy as np

from ..contacts import units_of
from ..tables.groups import groups_of
from ..wave_loads import forces_towards

LEAST = 1e-2  # smallest expected motion, over the largest translation
STILL = 0.1  # m, scale of a body without waves


def expected_motion(moored, components):
    """Standard deviations of motions and velocities of the linear bodies, and of groups of their shapes; shape (N + G,
    12)

    Each value is at least a fraction of the largest; for shapes, at least a fraction of the largest value of the
    shapes.

    All values are computed at the frequencies of `moored.waves`. Each seed has different frequencies; using those
    would require stored values at each of them.
    """
    reader, waves, groups = moored.reader, moored.waves, groups_of(moored.reader)
    count = len(reader.axes_at_rest)
    unit = units_of(reader)
    if components is None:
        motion = STILL * _in_sixes(unit, groups)
        return np.concatenate([motion, 0.5 * motion], axis=1)
    energy = 0.5 * components.amplitude**2
    beta = np.arctan2(*(energy @ f(components.direction) for f in (np.sin, np.cos)))
    towards = beta - reader.axes_at_rest[[*range(count), *groups.owner], 5]
    force = np.concatenate([forces_towards(*one) for one in zip(waves.each, towards, strict=True)], axis=1)
    force = force[:, [*range(reader.rigid), *(reader.rigid + groups.place)]]
    D, free = moored.dynamic_stiffness, reader.free
    if free is None:
        X = np.linalg.solve(D, force[:, :, None])[:, :, 0]
    else:
        X = np.linalg.solve(free.T @ D @ free, (force @ free)[:, :, None])[:, :, 0] @ free.T
    squared = np.minimum(np.abs(X), 20.0 * unit) ** 2
    omega = np.clip(components.omega, waves.omega[0], waves.omega[-1])
    power = energy * np.array([np.interp(omega, waves.omega, one) for one in squared.T])
    motion, speed = (np.sqrt(part) for part in (power.sum(axis=1), power @ omega**2))
    for part in (motion, speed):
        for own in (slice(0, reader.rigid), slice(reader.rigid, None)):
            part[own] = np.maximum(part[own], LEAST * (part / unit)[own].max(initial=0.0) * unit[own])
    return np.concatenate([_in_sixes(motion, groups), _in_sixes(speed, groups)], axis=1)


def _in_sixes(values, groups):
    """Values of all motions in rows of six, 1 for motions that do not exist; shape (N + G, 6)"""
    out = groups.padded(values).reshape(-1, 6)
    return np.where(groups.padded(np.ones_like(values)).reshape(-1, 6) > 0, out, 1.0)
