"""Difference and sum of two frequencies, at which a pair of waves exerts a force.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        F(t) = Re Σᵢ Σⱼ aᵢ aⱼ T⁺_ij exp{−i(ωᵢ + ωⱼ)t}

A real wave Re φ exp(−iωt) is also Re φ̄ exp(−i(−ω)t). The effect of two waves at the sum of their frequencies is
therefore their effect at the difference, if the second wave is written in this form.
A formula for differences becomes a formula for sums if −ωⱼ replaces ωⱼ and the conjugates of the second wave are
omitted; T⁺_ij = T⁺_ji.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Kind(NamedTuple):
    """name : name of the axis of force frequencies; sign : sign of the second wave frequency in a force frequency
    second : function that converts the first-order amplitudes of the second wave for products
    """

    name: str
    sign: int
    second: Callable

    def of(self, one, two):
        """Frequencies of the force of pairs, rad/s"""
        return one + self.sign * two

    def negative(self, two):
        """Frequencies of the second waves, with the sign needed in formulas for differences"""
        return -self.sign * two

    def rows(self, omega, highest):
        """Frequencies of the force up to `highest`, rad/s, shape (d,), for pairs of the evenly spaced frequencies
        (n,)"""
        step, lowest = (omega[-1] - omega[0]) / (len(omega) - 1), self.of(omega[0], omega[0])
        most = (len(omega) - 1) * (2 if self.sign > 0 else 1)
        return lowest + step * np.arange(min(int(np.floor((highest - lowest) / step + EVEN)), most) + 1)

    def pairs(self, row, count):
        """Indices of the higher frequency, (q,), and of the lower frequency, (q,), in each pair of a row, for `count`
        frequencies"""
        if self.sign < 0:
            lower = np.arange(count - row)
            return lower + row, lower
        lower = np.arange(max(0, row - count + 1), row // 2 + 1)
        return row - lower, lower


EVEN = 1e-6  # largest deviation of a frequency step, over the step
DIFFERENCE = Kind("difference", -1, np.conj)
SUM = Kind("sum", 1, np.positive)
