"""First-order waves of a box or vertical cylinder by the contour method, for forces of pairs.

The integrals over sides and bottom include the exact singular flow at the edge. The integral of the bound wave is
over the wall of the plan (`bem.contour.hull`), and the potential on the surface around a cylinder is a sum of Bessel
functions (`contour_surface`). The contour method gives only means of the flow under a box. A box must therefore be
fixed; its heave, roll and pitch loads, and the forcing of the surface around the box, are not computed.
"""

import numpy as np

from .. import DOFS
from ..contour.hull.flow import HullPoints, SharedFrequency, radiated_flow, wave_flow
from ..contour.hull.long_waves import long_wave_forces
from ..contour.pressure_drift import refined
from ..contour.short_waves import too_many
from ..waves import wavenumber
from .contour_surface import CylinderSurface
from .first_order_waves import FirstOrderWaves
from .kinds import DIFFERENCE

VERTICAL = [2, 3, 4]


class ContourWaves(FirstOrderWaves):
    """First-order waves, as `first_order_waves.PanelWaves`, of a `bem.methods.shape_problem.ShapeProblem`

    raises : ValueError for a method other than contour, infinite depth, a floating box, the surface around a box, and
        unresolved waves
    """

    def __init__(
        self, problem, omega, headings, moving, of_force, surface=False, lines=None, swayed=None, kind=DIFFERENCE
    ):
        super().__init__(problem, headings, moving, lines, swayed, kind)
        if problem.method != "contour" or not np.isfinite(problem.depth):
            raise ValueError(
                f"the method is {problem.method} and the depth {problem.depth:g} m; wave pairs need method "
                "panel, or method contour in finite depth"
            )
        self.prepared = self.held.prepared()
        self.body = refined(self.prepared.solver)
        highest, rising = max(omega[-1], of_force[-1]), of_force[of_force > 0]
        k = float(wavenumber(highest, problem.depth, problem.gravity))
        if too_many((*self.body.plan.sizes, self.body.draft), k):
            raise ValueError(
                f"the contour method does not resolve the waves of wave pairs up to {highest:.4g} rad/s; give lower "
                f"frequencies, or use panels"
            )
        self.points = HullPoints(self.body, k)
        surface = surface and len(rising) > 0
        if (moving or surface) and not self.points.whole:
            raise ValueError(
                "the contour method computes wave pairs of a box only if the box is fixed, and without the "
                "free-surface forcing; use panels in other cases"
            )
        first = self._frequency(omega[-1], [])
        self.surfaces = self.points.surfaces(first)
        self.around = CylinderSurface(problem, self.points, self.surfaces, omega, rising) if surface else None

    def _frequency(self, omega, headings):
        return SharedFrequency(self.points, omega, headings, self.problem.density, self.problem.gravity)

    def solve(self, omega):
        run = self.prepared.run(omega, self.headings, self.wanted, None, DOFS)
        freq = self._frequency(omega, self.headings)
        motions = self.take(run, lambda motions: wave_flow(freq, self.points, self.surfaces, motions))
        if self.around is not None:
            self.around.add(freq, motions)

    def radiation(self, omega):
        """`SharedFrequency` at a frequency of the force"""
        return self._frequency(max(omega, self.least), [])

    def radiated(self, freq):
        """`HullFlow` of the six motions of unit velocity"""
        return radiated_flow(freq, self.points, self.surfaces)

    def long_waves(self, freq, number):
        """Forces of long waves about the origin, by `bem.contour.hull.long_waves`; shape (w, 6)"""
        return long_wave_forces(freq, number)

    def joined(self):
        flow, squares = super().joined()
        if not self.points.whole:
            squares[..., VERTICAL] = np.nan
        return flow, squares
