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
        """Frequency of the highest peak of all systems, rad/s"""
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
    """A sea of several `environment.sea.Sea`, with the methods of a single Sea"""

    systems: tuple[Sea, ...]

    @cached_property
    def spectrum(self):
        """Sum of the systems'"""
        name = " + ".join(system.spectrum.name for system in self.systems)
        return Sum(tuple(system.spectrum for system in self.systems), name)

    @property
    def direction(self):
        """Mean direction of the energy, rad"""
        return float(np.angle(self._energies @ np.exp(1j * np.array([system.direction for system in self.systems]))))

    @property
    def _energies(self):
        m0 = np.array([system.spectrum.moment(0) for system in self.systems])
        return m0 / m0.sum()

    def directional(self, headings, omega=None):
        """Shares of the energy per heading, as in `Sea.directional`"""
        if omega is None:
            return sum(share * s.directional(headings) for share, s in zip(self._energies, self.systems, strict=True))
        parts = [s.spectrum.density(omega)[:, None] * s.directional(headings, omega) for s in self.systems]
        total = sum(parts)
        return total / np.maximum(total.sum(axis=1, keepdims=True), 1e-300)

    def components(self, count, seed, *, low=None, high=None, **words):
        """`Sea.components` of each system; the number of each is proportional to its frequency range, but at least a
        quarter.

        low, high : frequency range of the whole sea, rad/s; each system covers its own part of this range
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
