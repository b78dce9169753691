"""What a linear body would do in the same waves: the scale of errors, and the drift damping of its slow motion."""

from __future__ import annotations

import numpy as np

from ..response.wave_drift_damping import damping_coefficients
from .interpolation import ring_table

RING = 36  # headings, 10° apart
LEAST = 1e-2  # of the largest translation, that every motion is allowed to be
STILL = 0.1  # m, scale of a body without waves


def expected_motion(moored, components):
    """(12,) standard deviations of the motions and velocities of the linear body, none below a share of the largest."""
    reader = moored.reader
    radius = np.sqrt(np.diag(reader.inertia)[3:] / reader.inertia[0, 0])
    unit = np.concatenate([np.ones(3), 1 / radius])
    if components is None:
        motion = STILL * unit
        return np.concatenate([motion, 0.5 * motion])
    omega = np.clip(components.omega, reader.omega[0], reader.omega[-1])
    beta = np.arctan2(*(components.amplitude**2 @ f(components.direction) for f in (np.sin, np.cos)))
    K = moored.stiffness - reader.stiffness
    X = np.abs(reader.restrained(stiffness=0.5 * (K + K.T), damping=moored.damping).motions(omega, [beta])[:, 0])
    X = np.minimum(X, 20.0 * unit)
    power = 0.5 * components.amplitude[:, None] ** 2 * X**2
    motion, speed = np.sqrt(power.sum(axis=0)), np.sqrt((components.omega[:, None] ** 2 * power).sum(axis=0))
    for part in (motion, speed):
        part[:] = np.maximum(part, LEAST * (part / unit).max() * unit)
    return np.concatenate([motion, speed])


def drift_damping_ring(reader, weather):
    """(RING + 3, 6) B over headings of the body, rows (surge, sway, yaw) by (surge, sway), in its axes; N s/m …

    Wave drift damping of all seas together, each about its mean direction with its spreading.
    """
    headings = np.arange(RING) * (2 * np.pi / RING)
    total = np.zeros((RING, 3, 2))
    if weather.regular is not None:
        w = weather.regular
        omega = np.clip(w.omega * np.array([0.98, 1.0, 1.02]), reader.omega[0], reader.omega[-1])
        B = damping_coefficients(reader, omega, w.direction - headings)[1]
        return ring_table((B * (0.5 * w.height) ** 2).reshape(RING, 6))
    omega = np.linspace(reader.omega[0], reader.omega[-1], 96)
    on_ring = damping_coefficients(reader, omega, headings)
    for sea in weather.seas:
        density = np.asarray(sea.spectrum.density(omega))
        mean = 2 * np.trapezoid(on_ring * density[:, None, None, None], omega, axis=0)
        for i, heading in enumerate(headings):
            share = sea.directional(headings + heading)
            total[i] += np.einsum("p,pjk->jk", share, mean)
    return ring_table(total.reshape(RING, 6))
