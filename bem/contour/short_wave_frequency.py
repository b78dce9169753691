"""One frequency of waves too short to be resolved along the body, by domain decomposition and corner diffraction.

The flow of the motions is smooth along the walls and under the keel, apart from waves diffracted by the corners.  Waves
outside, radiated and incident ones in front of a rigid wall, are projected onto a few smooth functions of the contour
in closed form (`plan.wedge_diffraction`; exactly for a circle).  Forces then follow as for resolved waves, by
diffraction and by Haskind's relation.  `short_waves` estimates the neglected part.
"""

from __future__ import annotations

import numpy as np

from ..kochin import angles
from ..waves import group_factor
from .one_frequency import ContourFrequency
from .short_waves import neglected, share_below

CHUNK = 8192  # angles at a time


class ShortWaveFrequency(ContourFrequency):
    """Intermediate quantities of one frequency of a `bem.contour.solver.ContourBody`, without far field."""

    def resolution(self):
        plan = self.body.plan
        degree = plan.asymptotic_degree(self.body.tolerance)
        return degree, degree, plan.polynomial_contour(degree)

    @property
    def corners(self):
        """Whether the plan has corners; on a circle angular orders are uncoupled"""
        return len(self.body.plan.sizes) == 2

    def result(self):
        """`FirstOrder` without Kochin functions, with `radiated` and `neglected`"""
        plain = super().result()
        return plain._replace(
            kochin_radiation=None, kochin_diffraction=None, radiated=self.radiated(), neglected=self.neglected()
        )

    def waves(self):
        return {cls: self.map(cls, self.headings) for cls in self.classes}

    def map(self, cls, beta):
        """`AsymptoticWaveMap` for incident waves towards `beta`"""
        return self.body.plan.asymptotic_map(cls, self.degree, self.k, beta)

    def velocities(self, cls):
        """(dofs, (n, dofs) on the side, (n, dofs) in the gap) ⟨∂φ/∂n, Z₀⟩ of unit motions"""
        dofs, _, side, flow = self.flows[cls]
        side = (self.wave_rows[-2:] @ side).T
        return dofs, side, np.tensordot(self.wave_rows[:-2], flow.velocity[..., : len(dofs)], 1)

    def radiated(self):
        """(6, 6) B/ω by radiated energy: k/8πρgC_gω ∫ X X̄ dβ, X the excitation by waves from all directions (Haskind).

        By symmetry X X̄ is the same in all quadrants.
        """
        out, k = np.zeros((6, 6)), self.k
        count = -(-len(angles(k, self.body.plan.reach)) // 4) if self.corners else self.degree
        beta = (np.arange(count) + 0.5) * np.pi / 2 / count
        for cls in self.flows:
            dofs, side, gap = self.velocities(cls)
            for start in range(0, count, CHUNK):
                X = (side + gap).T @ self.map(cls, beta[start : start + CHUNK]).projected
                out[np.ix_(dofs, dofs)] += (X @ X.conj().T).real
        n = group_factor(k, self.body.depth)
        return out * self.density * k**2 / (4 * n * count) * self.gravity / self.omega**2

    def neglected(self):
        """Bounds of the part of Z (6, 6) and of the excitation (m, 6) that is neglected, by `short_waves.neglected`"""
        radiation, excitation = np.zeros((6, 6)), np.zeros((len(self.headings), 6))
        lengths = self.body.plan.sizes
        if not self.corners:
            return radiation, excitation
        share = share_below(self.k, self.body.draft, self.body.depth)
        fixed_terms, waves = neglected(self.k, lengths, share, self.headings)
        for cls in self.flows:
            dofs, *parts = self.velocities(cls)
            side, gap = (np.linalg.norm(part, axis=0) / np.sqrt(2 * sum(lengths)) for part in parts)
            square = 8 * self.density / (self.k**2 * self.modes.wave_norm)
            radiation[np.ix_(dofs, dofs)] = square * fixed_terms * np.outer(side + gap, side + gap)
            excitation[:, dofs] = self.density * self.gravity / self.k * (np.outer(waves, side) + gap)
        return radiation, excitation
