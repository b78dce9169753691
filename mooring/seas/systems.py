"""Several systems of waves together: swell and wind sea, long waves of a harbour, each with its own direction.

    S(ω) = Σ_i S_i(ω),    D(θ; ω) = Σ_i S_i(ω) D_i(θ) / S(ω)

Systems are independent: their energies add up, and so do their mean forces.  Slow forces include pairs of all waves.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..environment.sea import BAND, Sea, joined
from ..environment.spectrum import Spectrum


@dataclass(frozen=True, repr=False, eq=False)
class Sum(Spectrum):
    """Spectra `parts` added"""

    parts: tuple[Spectrum, ...]
    name: str = "sum"

    @cached_property
    def peak_omega(self):
        """rad/s of the highest of the peaks"""
        peaks = np.array([part.peak_omega for part in self.parts])
        return float(peaks[np.argmax(self.density(peaks))])

    def density(self, omega):
        return sum(part.density(omega) for part in self.parts)

    def _moment(self, order, low, high):
        return sum(np.asarray(part.moment(order, low, high)) for part in self.parts)

    def _grid(self):
        return np.unique(np.concatenate([part._grid() for part in self.parts]))


@dataclass(frozen=True, eq=False)
class Systems:
    """A sea of several `environment.sea.Sea`, with the methods of a Sea for all together"""

    systems: tuple[Sea, ...]

    @cached_property
    def spectrum(self):
        """Sum of the systems'"""
        name = " + ".join(system.spectrum.name for system in self.systems)
        return Sum(tuple(system.spectrum for system in self.systems), name)

    @property
    def direction(self):
        """rad, mean direction of the energy"""
        return float(np.angle(self._energies @ np.exp(1j * np.array([system.direction for system in self.systems]))))

    @property
    def _energies(self):
        m0 = np.array([system.spectrum.moment(0) for system in self.systems])
        return m0 / m0.sum()

    def directional(self, headings, omega=None):
        """Shares per heading as in `Sea.directional`"""
        if omega is None:
            return sum(share * s.directional(headings) for share, s in zip(self._energies, self.systems, strict=True))
        parts = [s.spectrum.density(omega)[:, None] * s.directional(headings, omega) for s in self.systems]
        total = sum(parts)
        return total / np.maximum(total.sum(axis=1, keepdims=True), 1e-300)

    def components(self, count, seed, *, low=None, high=None, **words):
        """`Sea.components` of each system, numbered in proportion to its range of frequencies; at least a quarter each.

        low, high : rad/s of the whole sea; each system has its own share of them
        """
        widths = np.array([np.ptp(system.spectrum.quantile(BAND)) for system in self.systems])
        shares = np.maximum(widths / widths.sum(), 0.25)
        numbers = np.maximum(np.round(count * shares / shares.sum()).astype(int), 1)
        parts = []
        for i, (system, number) in enumerate(zip(self.systems, numbers, strict=True)):
            ends = system.spectrum.quantile(BAND)
            one_low = ends[0] if low is None else np.clip(low, *ends)
            one_high = ends[1] if high is None else np.clip(high, *ends)
            if one_low < one_high:
                parts.append(system.components(number, seed + i, low=one_low, high=one_high, **words))
        return joined(*parts)
