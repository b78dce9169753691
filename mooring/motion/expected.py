"""What a linear body would do in the same waves: the scale of errors, and the drift damping of its slow motion."""

from __future__ import annotations

import numpy as np

from bem.waves import wavenumber

from ..response.wave_drift_damping import from_slopes
from .interpolation import ring_table
from .wave_loads import HEADINGS

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


def drift_damping_ring(forces, weather, depth, gravity):
    """(HEADINGS + 3, 6) B over headings of the body, rows (surge, sway, yaw) by (surge, sway), in its axes; N s/m …

    Wave drift damping (`mooring.response.wave_drift_damping`) of all seas together, from the drift of `WaveForces`.
    """
    headings, omega = np.arange(HEADINGS) * (2 * np.pi / HEADINGS), forces.omega
    by_omega = forces.curves[1](omega, 1)
    around = np.concatenate([forces.drift[:, -1:], forces.drift, forces.drift[:, :1]], axis=1)
    by_heading = (around[:, 2:] - around[:, :-2]) * (HEADINGS / (4 * np.pi))
    k = wavenumber(omega, depth, gravity)
    B = from_slopes(omega, headings, k, depth, forces.drift, by_omega, by_heading).reshape(len(omega), HEADINGS, 6)
    if weather.regular is not None:
        w = weather.regular
        place = np.clip(w.omega, omega[0], omega[-1])
        one = np.array([[np.interp(place, omega, B[:, j, c]) for c in range(6)] for j in range(HEADINGS)])
        turned = np.mod(w.direction - headings, 2 * np.pi)
        rows = [np.interp(turned, headings, one[:, c], period=2 * np.pi) for c in range(6)]
        return ring_table((0.5 * w.height) ** 2 * np.stack(rows, axis=-1))
    total = np.zeros((HEADINGS, 6))
    for sea in weather.seas:
        mean = 2 * np.trapezoid(B * np.asarray(sea.spectrum.density(omega))[:, None, None], omega, axis=0)
        for i, heading in enumerate(headings):
            total[i] += sea.directional(headings + heading) @ mean
    return ring_table(total)
