"""Added mass of a rectangle at ω → 0 and ω → ∞ in finite depth: the flows of `finite_depth` without a wave.

    ω → 0   ∂φ/∂z = 0 on z = 0: kₙ = nπ/h.  Sway and roll have no net flow, and φ tends to a constant far away.
            Heave has the net flow that it displaces, φ ~ |y| − b far away, and B/ω grows like 1/k
    ω → ∞   φ = 0 on z = 0:     kₙ = (n − ½)π/h

The results are the limits of `coefficients.section`. At ω → 0 the part 1/ik of the potential, due to the wave, is
imaginary, so that the added mass of heave remains finite, unlike that in deep water.
"""

import numpy as np

from ..depth_modes.gap import OuterModes, mode_sum
from .coefficients import check_shape, effort, radiation
from .finite_depth import HEAVE, FiniteDepthFlow, SectionFlow, shape

WHICH = ("zero", "infinity")


def added_mass_limit(beam, draft, depth, which, *, density=1025.0, tolerance=1e-6):
    """Added mass of sway, heave and roll, kg/m, kg, kg m; shape (3, 3); which : frequency, "zero" or "infinity"
    Raises ValueError for deep water, and for a section that cannot be solved.
    """
    if which not in WHICH:
        raise ValueError(f"limit is {which!r}; allowed: {' or '.join(WHICH)}")
    check_shape(beam, draft, depth, tolerance)
    if np.isinf(depth):
        raise ValueError("depth is inf; the limits of a section need a finite depth")
    flow = LimitFlow(beam, draft, depth, which == "zero", *effort(beam, draft, depth, tolerance))
    return radiation(flow, density).real


class LimitFlow(FiniteDepthFlow):
    """The radiated flows under a rigid lid (`lid`), or under a surface with zero pressure."""

    def __init__(self, beam, draft, depth, lid, terms, modes):
        self.shape, self.lid = shape(beam, draft, depth, terms, modes), lid
        gap = self.shape.gap
        n = np.arange(1, gap.mode_count(0.0, modes) + 1)
        l = (n if lid else n - 0.5) * np.pi / depth
        means = np.concatenate([gap.mean, [draft, -(draft**2) / 2]])  # means ⟨·, 1⟩ of the rows
        self.modes = OuterModes(0.0, depth, means, l, np.full(len(l), depth / 2), gap.outer_rows(l))
        self.outside = mode_sum(self.modes.rows, gap.outer_decays, -1 / (l * self.modes.norms))
        self.wave_rows = means
        self.radiated = tuple(self._flow(i == HEAVE, motion) for i, motion in enumerate(self.shape.motions))

    def _flow(self, symmetric, motion):
        """Under a lid `incident` is the constant that φ tends to, such that the net flux is zero."""
        plain = super()._flow(symmetric, motion)
        if symmetric or not self.lid:
            return plain
        unit = super()._flow(False, incident=1.0)
        outflow = self.wave_rows @ np.concatenate([plain.velocity, motion.side])
        incident = -outflow / (self.shape.gap.mean @ unit.velocity)
        return SectionFlow(plain.velocity + incident * unit.velocity, 0.0, motion, incident)
