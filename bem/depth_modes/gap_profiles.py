"""Velocity profiles in the gap: orthonormal combinations of the functions of `gap`.

The three families are nearly dependent: with nine functions the eigenvalues of ⟨U, Σ cos l_qζ cos l_qζ / l_q U⟩ reach
down to 1e-13.  Combinations that are small in this norm are dropped. The remaining combinations are normalised, which
magnifies the truncation error of the sums over modes. With T functions in each family and 8 T² modes per gap height
this error is 3e-8; with 24 T² modes it is 7e-11. Fewer modes, at a tolerance of 1e-6, gave an error of 7e-6 in yaw
for a box of 100 × 50 × 10 m in 100 m of water.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .gap import Gap, mode_sum

DEPENDENT = 24  # modes to the gap per T², see above


@dataclass(frozen=True)
class Profiles:
    """e orthonormal profiles, combinations of the functions of a `Gap`, with r = e + 2 rows as in `Gap`.

    smallest : smallest eigenvalue that is kept, for functions of unit norm
    """

    gap: Gap
    smallest: float

    @property
    def height(self):
        """Height s of the gap, m"""
        return self.gap.height

    @cached_property
    def combinations(self):
        """Matrix from rows of functions to rows of profiles; shape (r, f + 2); the last two rows are unchanged"""
        modes, f = self.gap.inner_modes(self.gap.inner_count(800, np.inf)), len(self.gap.mean)
        norm = mode_sum(modes.rows, self.gap.inner_decays, 2 / self.height / modes.wavenumbers)[:f, :f]
        norm += np.outer(self.gap.mean, self.gap.mean)
        size = np.sqrt(np.diag(norm))
        value, vector = np.linalg.eigh(norm / np.outer(size, size))
        keep = value > self.smallest
        out = np.zeros((keep.sum() + 2, f + 2))
        out[:-2, :f] = (vector[:, keep] / np.sqrt(value[keep]) / size[:, None]).T
        out[-2:, f:] = np.eye(2)
        return out

    @cached_property
    def mean(self):
        """∫ u dζ of each profile; shape (e,)"""
        return self.combinations[:-2, :-2] @ self.gap.mean

    @cached_property
    def second_moment(self):
        """∫ ζ² u dζ of each profile; shape (e,)"""
        return self.combinations[:-2, :-2] @ self.gap.second_moment

    @cached_property
    def mean_rows(self):
        """⟨·, 1⟩ of the profiles, and of 1 and ζ²; shape (r,)"""
        return self.combinations @ self.gap.mean_rows()

    def products(self, values):
        """Products of pairs of profiles, shape (r, r, c), from values (f + 2, f + 2, c) for pairs of functions"""
        both = np.tensordot(self.combinations, np.tensordot(self.combinations, values, (1, 0)), (1, 1))
        return both.transpose(1, 0, 2)
