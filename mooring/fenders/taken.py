"""Effect of an energy on fenders: deflection of each fender, and its largest reaction up to this deflection."""

import numpy as np

from .fender import FenderError


def deflection_of(fender, energy):
    """Deflection, m, at which a fender has absorbed an energy, J; nan if the fender's table ends at a smaller
    energy
    """
    try:
        return fender.deflection_at_energy(energy)
    except FenderError:
        return np.nan


def at_deflections(fenders, deflections):
    """Strain of each fender without its dolphin, and its largest reaction, N, up to its deflection, m; nan where the
    deflection is nan"""
    strain, reaction = np.full((2, len(fenders)), np.nan)
    for k, (one, x) in enumerate(zip(fenders, deflections, strict=True)):
        if np.isfinite(x):
            strain[k], reaction[k] = one.own(x) / one.height, one.largest_reaction(x)
    return strain, reaction
