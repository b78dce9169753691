"""Difference and sum of two frequencies, at which a pair of waves exerts a force.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        F(t) = Re Σᵢ Σⱼ aᵢ aⱼ T⁺_ij exp{−i(ωᵢ + ωⱼ)t}

A real wave Re φ exp(−iωt) is also Re φ̄ exp(−i(−ω)t). The effect of two waves at the sum of their frequencies is
therefore the effect, at the difference, of the first wave and of the second wave written in this form.
A formula for differences
becomes one for sums with −ωⱼ for ωⱼ and without the conjugates of the second wave; T⁺_ij = T⁺_ji.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Kind(NamedTuple):
    """name : name of the axis of force frequencies; sign : sign of the second wave frequency in a force frequency

    second : function of first-order amplitudes that gives those of the second wave in products
    """

    name: str
    sign: int
    second: Callable

    def of(self, one, two):
        """rad/s, frequencies of the force of pairs"""
        return one + self.sign * two

    def negative(self, two):
        """Second frequencies with the sign for formulas of differences"""
        return -self.sign * two

    def rows(self, omega, highest):
        """Frequencies of the force up to `highest` of pairs of frequencies (n,) at even steps, rad/s; shape (d,)"""
        step, lowest = (omega[-1] - omega[0]) / (len(omega) - 1), self.of(omega[0], omega[0])
        most = (len(omega) - 1) * (2 if self.sign > 0 else 1)
        return lowest + step * np.arange(min(int(np.floor((highest - lowest) / step + EVEN)), most) + 1)

    def pairs(self, row, count):
        """Numbers (q,) and (q,) of the higher and the lower frequency of the pairs of a row, of `count` frequencies"""
        if self.sign < 0:
            lower = np.arange(count - row)
            return lower + row, lower
        lower = np.arange(max(0, row - count + 1), row // 2 + 1)
        return row - lower, lower


EVEN = 1e-6  # largest deviation of a frequency step, over the step
DIFFERENCE = Kind("difference", -1, np.conj)
SUM = Kind("sum", 1, np.positive)
