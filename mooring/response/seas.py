"""Headings of a sea with their shares of its energy, and the energy outside the stored frequencies."""

from __future__ import annotations

import numpy as np

from bem.database.between_frequencies import BetweenError

MOST_OUTSIDE = 0.5  # share of the energy beyond the stored frequencies, above which a response says nothing of the sea
STEP = np.deg2rad(10.0)  # between directions of a short-crested sea


def directions(sea, omega):
    """Headings (p,) rad and shares of the energy (p,) or (q, p) at omega (q,); 10° apart in a short-crested sea."""
    if sea.spreading is None:
        return np.array([sea.direction]), np.ones(1)
    heading = sea.direction + STEP * np.arange(-18, 18)
    weights = sea.directional(heading, omega)
    kept = weights.max(axis=0) > 1e-6
    return heading[kept], weights[:, kept] / weights[:, kept].sum(axis=1, keepdims=True)


def energy_outside(body, spectrum):
    """Shares of the wave energy below and above the stored frequencies."""
    total = spectrum.moment(0)
    return spectrum.moment(0, 0.0, body.omega[0]) / total, spectrum.moment(0, body.omega[-1], np.inf) / total


def check_coverage(body, spectrum):
    """Raise BetweenError where most of the waves are beyond the stored frequencies."""
    missed = sum(energy_outside(body, spectrum))
    if missed > MOST_OUTSIDE:
        low, high = 2 * np.pi / body.omega[-1], 2 * np.pi / body.omega[0]
        raise BetweenError(
            f"{100 * missed:.3g} % of the wave energy of {spectrum.name} waves of mean period {spectrum.T01:.4g} s is "
            f"outside the stored {low:.4g} to {high:.4g} s; allowed: {100 * MOST_OUTSIDE:g} %; add periods to the "
            "scene and solve again"
        )
