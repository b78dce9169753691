"""What fenders do with an energy: how far each is pressed, and how hard it pushes on the way."""

from __future__ import annotations

import numpy as np

from .fender import FenderError


def deflection_of(fender, energy):
    """m at which a fender has taken up an energy, J; nan where its table ends before"""
    try:
        return fender.deflection_at_energy(energy)
    except FenderError:
        return np.nan


def at_deflections(fenders, deflections):
    """Strain of each fender itself, and its largest reaction, N, on the way to its deflection, m; nan where that is"""
    strain, reaction = np.full((2, len(fenders)), np.nan)
    for k, (one, x) in enumerate(zip(fenders, deflections, strict=True)):
        if np.isfinite(x):
            strain[k], reaction[k] = one.own(x) / one.height, one.largest_reaction(x)
    return strain, reaction
