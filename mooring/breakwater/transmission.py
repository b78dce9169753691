"""A sea behind a breakwater: S_t = K_T² S_i.  Kihara, Kitatani & Todoroki (1975), eq. 6.1 to 6.4."""

from __future__ import annotations

import numpy as np

CELLS = 2000


def transmitted_height(spectrum, transmission, low, high):
    """4√m₀ of the transmitted sea, m, and the incident one, between two frequencies.

    spectrum : `Spectrum`; transmission : ω (m,) rad/s → K_T (m,); low, high : rad/s
    Raises ValueError where the band holds less than 0.999 of the energy.
    """
    if not 0 < low < high < np.inf:
        raise ValueError(f"band from {low:g} to {high:g} rad/s; allowed: 0 < low < high")
    share = spectrum.moment(0, low, high) / spectrum.moment(0)
    if share < 0.999:
        raise ValueError(f"{low:g} to {high:g} rad/s hold {share:.4f} of the sea's energy; allowed: 0.999 or more")
    edges = np.geomspace(low, high, CELLS + 1)
    middle = np.sqrt(edges[1:] * edges[:-1])
    energy = spectrum.moment(0, edges[:-1], edges[1:])
    return 4 * np.sqrt(np.abs(transmission(middle)) ** 2 @ energy), 4 * np.sqrt(energy.sum())
