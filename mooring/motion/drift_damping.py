"""Wave drift damping of a body that turns: what slow surge and sway change of the drift, for every heading."""

from __future__ import annotations

import numpy as np

from bem.waves import wavenumber

from ..response.wave_drift_damping import from_slopes
from .interpolation import ring_table
from .wave_loads import HEADINGS


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
