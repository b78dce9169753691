"""A box or vertical cylinder that stands on the bed. There is no water under it, so the solution has only
eigenfunctions of depth and the plan.

With N the maps of the plan outside, φ = φ₀ + Σ Zₙ N(kₙ) ⟨v, Zₙ⟩ / ⟨Zₙ, Zₙ⟩ for the velocity v of the wall.  For a
cylinder held in a wave this is the solution of R. C. MacCamy and R. A. Fuchs (1954).  In the equations of `matching`
this body has no velocities in a gap, and its heave makes no waves.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..depth_modes.gap import Gap, rounded
from ..froude_krylov import side_integrals
from ..waves import wavenumber
from .accuracy import DIGIT, accuracy, finer
from .body import MARGIN, TOLERANCES, ContourBody, memoised
from .matching import FixedTerms
from .rigid_motions import side

GAP = 0.01  # of the scale of the plan: gap by whose formulas the accuracy of plan and modes is chosen


def standing(plan, depth, tolerance):
    """`StandingBody` of a plan, `Circle` or `Rectangle`, in water of `depth` m"""
    fine = accuracy(MARGIN - np.log10(tolerance), depth, GAP * plan.scale, plan.scale)
    return StandingBody(plan.to(fine), depth, depth, fine)


@dataclass(frozen=True)
class NoGap(Gap):
    """Stand-in for a `Gap` without functions of the gap: only the rows 1 and z of the wall, over the whole depth"""

    def cosine_moments(self, l):
        """Integrals of cosines over the gap: none, since a body on the bed has no gap; shape (0, l)"""
        return np.zeros((0, len(l)))

    def wave_moments(self, k):
        """Integrals of the wave over the gap: none, since a body on the bed has no gap"""
        return np.zeros(0)

    @property
    def outer_decays(self):
        return np.array([2.0, 2.0])

    def mode_count(self, k, modes, shortest=np.inf, further=8):
        """As of `Gap`"""
        return rounded(max(modes * self.depth / min(self.depth, shortest), 8) + 4 * k * self.depth)


@dataclass(frozen=True)
class WallProfiles:
    """`gap_profiles.Profiles` without profiles: the rows 1 and z of the wall"""

    gap: NoGap
    smallest: float = 0.0

    @property
    def combinations(self):
        """Combinations of the two profiles of a side that reaches the bed; shape (2, 2)"""
        return np.eye(2)

    @property
    def mean(self):
        """Means of the profiles over the gap: none, since a body on the bed has no gap"""
        return np.zeros(0)

    def products(self, values):
        """Products of the profiles of the side with the depth modes; shape (2, 2, c)"""
        return values


@dataclass(frozen=True, eq=False)
class StandingBody(ContourBody):
    """A `ContourBody` that stands on the bed; motions are about the middle of its waterplane"""

    def froude_krylov(self, omega, headings, dofs=range(6), density=1025.0, gravity=9.80665):
        """Force of the undisturbed waves on the wall alone; arguments as in `ContourBody.froude_krylov`"""
        force = super().froude_krylov(omega, headings, range(6), density, gravity)
        force[:, 2] = 0.0
        plain, moment = side_integrals(self.depth, self.depth, float(wavenumber(omega, self.depth, gravity)))
        force[:, 3], force[:, 4] = -moment / plain * force[:, 1], moment / plain * force[:, 0]
        return np.where(np.isin(np.arange(6), dofs), force, 0)

    @cached_property
    def finer(self):
        """As of `ContourBody`"""
        return self._to(finer(self.accuracy, self.draft, GAP * self.plan.scale, self.plan.scale))

    @cached_property
    def sharper(self):
        """As of `ContourBody`"""
        digits = self.accuracy.digits + DIGIT
        if digits > MARGIN - np.log10(TOLERANCES[0]) + 1e-9:
            return None
        return self._to(accuracy(digits, self.draft, GAP * self.plan.scale, self.plan.scale))

    def _to(self, fine):
        return replace(self, plan=self.plan.to(fine), accuracy=fine, cache={})

    @cached_property
    def profiles(self):
        """`WallProfiles`"""
        return WallProfiles(NoGap(self.draft, self.depth, 0))

    @memoised
    def fixed_terms(self, cls, degree, top, dofs):
        """`bem.contour.matching.FixedTerms` of a body without a gap; arguments as in `ContourBody.fixed_terms`"""
        own, d = self.plan.subset(cls, degree, top), len(dofs)
        contour = self.plan.polynomial_contour(top)
        sides = [side(dof, contour, self.plan.basis(cls, top, contour))[:, own] for dof in dofs]
        side_velocity, none = np.reshape(sides, (d, 2 * len(own))), np.zeros((0, d))
        return FixedTerms(np.zeros((0, 0)), None, side_velocity, none, none.T, np.zeros(d), np.zeros((d, d)))
