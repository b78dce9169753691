"""A sea at a breakwater: S_t = K_T² S_i behind the breakwater, and tensions in its lines.

    σ_P² = ∫ |P|² S_i dω,    slack in a cycle  exp(−½ ((P₀ − ΔP₀)/σ_P)²),    greatest of N  σ_P √(2 ln N)

Kihara, Kitatani & Todoroki (1975), eq. 6.1 to 6.4; crests of a narrow spectrum (Longuet-Higgins 1952).
"""

from typing import NamedTuple

import numpy as np

LEAST_SHARE = 0.999


class Cells(NamedTuple):
    """A sea in frequency cells; omega : middles of the cells, (m,) rad/s; width : (m,) rad/s; energy : energy of
    each cell, (m,) m²
    """

    omega: np.ndarray
    width: np.ndarray
    energy: np.ndarray

    @property
    def height(self):
        """4√m₀, m"""
        return 4 * np.sqrt(self.energy.sum())

    def deviation(self, response):
        """Standard deviation of a response, (m,) complex per unit amplitude"""
        return np.sqrt(np.abs(response) ** 2 @ self.energy)


def equal_cells(spectrum, count):
    """`Cells` of nearly equal energy of a `Spectrum`. 0.0004 of the energy at each end is left out, since it would
    leave few cells for the rest of the long tail. All cells together have the significant height of the spectrum.
    """
    outside = (1 - LEAST_SHARE) * 0.4
    cells = _between(spectrum, spectrum.quantile(np.linspace(outside, 1 - outside, count + 1)))
    return cells._replace(energy=cells.energy * (spectrum.significant_height / cells.height) ** 2)


def _between(spectrum, edges):
    return Cells(np.sqrt(edges[1:] * edges[:-1]), np.diff(edges), spectrum.moment(0, edges[:-1], edges[1:]))


def greatest_of(deviation, waves):
    """Expected largest crest of a response among `waves` waves"""
    return deviation * np.sqrt(2 * np.log(max(waves, np.e)))


def slack_share(margin, deviation):
    """Fraction of cycles in which a line goes slack; margin : tension without waves; deviation : standard deviation
    in waves, N/m
    """
    return float(np.exp(-0.5 * (max(margin, 0.0) / deviation) ** 2)) if deviation > 0 else 0.0
