"""What a linear body would do in the same waves: the scale of errors."""

from __future__ import annotations

import numpy as np

LEAST = 1e-2  # of the largest translation, that every motion is allowed to be
GROUPS = 48  # of wave components
STILL = 0.1  # m, scale of a body without waves


def expected_motion(moored, components):
    """(12,) standard deviations of the motions and velocities of the linear body, none below a share of the largest."""
    reader = moored.reader
    radius = np.sqrt(np.diag(reader.inertia)[3:] / reader.inertia[0, 0])
    unit = np.concatenate([np.ones(3), 1 / radius])
    if components is None:
        motion = STILL * unit
        return np.concatenate([motion, 0.5 * motion])
    energy = 0.5 * components.amplitude**2
    beta = np.arctan2(*(energy @ f(components.direction) for f in (np.sin, np.cos)))
    at, share = _groups(components.omega, energy)
    omega = np.clip(at, reader.omega[0], reader.omega[-1])
    K = moored.stiffness - reader.stiffness
    X = np.abs(reader.restrained(stiffness=0.5 * (K + K.T), damping=moored.damping).motions(omega, [beta])[:, 0])
    X = np.minimum(X, 20.0 * unit)
    power = share[:, None] * X**2
    motion, speed = np.sqrt(power.sum(axis=0)), np.sqrt((omega[:, None] ** 2 * power).sum(axis=0))
    for part in (motion, speed):
        part[:] = np.maximum(part, LEAST * (part / unit).max() * unit)
    return np.concatenate([motion, speed])


def _groups(omega, energy):
    """At most GROUPS frequencies that stand for all, and the energy of each, m²"""
    order = np.argsort(omega)
    parts = np.array_split(order, min(GROUPS, len(omega)))
    return np.array([omega[p].mean() for p in parts]), np.array([energy[p].sum() for p in parts])
