"""One frequency with more waves along the body than can be resolved, by domain decomposition.

The flow that the motions make is smooth along the walls and under the keel but for the waves of the corners; their
waves outside, and the incident ones in front of a rigid wall, are tested with a few smooth functions of the contour
and need no nodes (`plan_short`; about a circle exactly).  The forces then follow as those of resolved waves do, and
both ways of Haskind.  `short_waves` tells what this is worth.
"""

from __future__ import annotations

import numpy as np

from ..kochin import angles
from ..waves import group_factor
from .one_frequency import ContourFrequency
from .short_waves import doubt, share_below

CHUNK = 8192  # angles at a time


class ShortFrequency(ContourFrequency):
    """Intermediate quantities of one frequency of a `bem.contour.solver.ContourBody`, without far field."""

    def resolution(self):
        plan = self.body.plan
        degree = plan.short_degree(self.body.tolerance)
        return degree, degree, plan.polynomial_contour(degree)

    @property
    def corners(self):
        """Whether the plan has any; about a circle orders do not mix"""
        return len(self.body.plan.sizes) == 2

    def result(self):
        """`FirstOrder` without Kochin functions, with `radiated` and `doubt`"""
        plain = super().result()
        return plain._replace(
            kochin_radiation=None, kochin_diffraction=None, radiated=self.radiated(), doubt=self.doubt()
        )

    def waves(self):
        return {cls: self.map(cls, self.headings) for cls in self.classes}

    def map(self, cls, beta):
        """`ShortMap` for incident waves towards `beta`"""
        return self.body.plan.short_map(cls, self.degree, self.k, beta)

    def velocities(self, cls):
        """(dofs, (n, dofs) on the side, (n, dofs) in the gap) ⟨∂φ/∂n, Z₀⟩ of unit motions"""
        dofs, _, side, flow = self.flows[cls]
        side = (self.wave_rows[-2:] @ side).T
        return dofs, side, np.tensordot(self.wave_rows[:-2], flow.velocity[..., : len(dofs)], 1)

    def radiated(self):
        """(6, 6) B/ω from the waves far away: k/8πρgC_gω ∫ X X̄ dβ, X of waves from everywhere by Haskind.

        All quarters of the circle have the same X X̄.
        """
        out, k = np.zeros((6, 6)), self.k
        count = -(-len(angles(k, self.body.plan.reach)) // 4) if self.corners else self.degree
        beta = (np.arange(count) + 0.5) * np.pi / 2 / count
        for cls in self.flows:
            dofs, side, gap = self.velocities(cls)
            for start in range(0, count, CHUNK):
                X = (side + gap).T @ self.map(cls, beta[start : start + CHUNK]).tested
                out[np.ix_(dofs, dofs)] += (X @ X.conj().T).real
        n = group_factor(k, self.body.depth)
        return out * self.density * k**2 / (4 * n * count) * self.gravity / self.omega**2

    def doubt(self):
        """What `short_waves` says is left out of Z (6, 6) and excitation (m, 6), at most"""
        radiation, excitation = np.zeros((6, 6)), np.zeros((len(self.headings), 6))
        lengths = self.body.plan.sizes
        if not self.corners:
            return radiation, excitation
        share = share_below(self.k, self.body.draft, self.body.depth)
        still, waves = doubt(self.k, lengths, share, self.headings)
        for cls in self.flows:
            dofs, *parts = self.velocities(cls)
            side, gap = (np.linalg.norm(part, axis=0) / np.sqrt(2 * sum(lengths)) for part in parts)
            square = 8 * self.density / (self.k**2 * self.modes.wave_norm)
            radiation[np.ix_(dofs, dofs)] = square * still * np.outer(side + gap, side + gap)
            excitation[:, dofs] = self.density * self.gravity / self.k * (np.outer(waves, side) + gap)
        return radiation, excitation
