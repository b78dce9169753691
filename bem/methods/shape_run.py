"""One frequency of a box or vertical cylinder by a method without panels."""

import time
from functools import cached_property, partial

import numpy as np

from ..frequency import DRIFT, FrequencyRun

RESOLVED = ("contour", "transfer")  # methods that have finer bodies


class ShapeRun(FrequencyRun):
    """One frequency of a method without panels, by the prepared solver or by a more accurate solver.

    Few problems need the more accurate solver: those whose gap height and draft make the waves radiated by keel and
    sides nearly cancel.
    """

    most_sharper = 2  # number of additional digits beyond the tolerance

    def __init__(self, prepared, omega, headings, want, theta, dofs, solver=None):
        super().__init__(prepared, omega, headings, want, theta, dofs)
        self.solver = prepared.solver if solver is None else solver

    @property
    def sharper(self):
        """The same run with a solver that is accurate to one more digit; None if this is not possible"""
        if self.problem.method not in RESOLVED or self.solver.sharper is None:
            return None
        return partial(ShapeRun, self.prepared, *self.question, self.solver.sharper)

    @property
    def solves(self):
        """Whether any equations must be solved"""
        return bool(self.want - {"Froude_Krylov_force", "pressure"})

    @cached_property
    def first_order(self):
        """`bem.first_order.FirstOrder` at the angles `theta` followed by the headings"""
        start = time.perf_counter()
        found = self._first_order(self.solver, self.far_field)
        self._timed("solve", start)
        return found

    @cached_property
    def finer(self):
        """The same frequency by the finer body of the contour method"""
        return self._first_order(self.solver.finer, self.want & DRIFT)

    def _first_order(self, solver, far_field):
        at = np.concatenate([self.theta, self.headings]) if far_field else ()
        return solver.first_order(self.omega, self.waves, at, self.dofs, self.problem.density, self.problem.gravity)

    @property
    def waves(self):
        """Headings of the waves, rad, shape (m,); empty if no diffraction is wanted"""
        return self.headings if self.diffracts else np.empty(0)

    @cached_property
    def differences(self):
        """Differences from the finer body; None for strips, because the larger error of strip theory itself is not
        estimated"""
        if self.problem.method not in RESOLVED:
            return None
        ours, fine = self.first_order, self.finer
        force, better = (r.froude_krylov + r.diffraction for r in (ours, fine))
        return ours.radiation - fine.radiation, force - better

    @cached_property
    def kochin_differences(self):
        """Like `differences`, for Kochin functions"""
        fine = self.finer.kochin_radiation, self.finer.kochin_diffraction
        return [H - better for H, better in zip(self.kochin, fine, strict=True)]

    @property
    def kochin_errors(self):
        """Like `errors`, for Kochin functions"""
        return self.kochin_differences

    @property
    def radiation(self):
        return self.first_order.radiation

    @property
    def froude_krylov(self):
        if self.diffracts:
            return self.first_order.froude_krylov
        problem = self.problem
        return self.solver.froude_krylov(self.omega, self.headings, self.dofs, problem.density, problem.gravity)

    @property
    def diffraction(self):
        return self.first_order.diffraction

    @property
    def haskind(self):
        return self.first_order.haskind

    @property
    def kochin(self):
        return self.first_order.kochin_radiation, self.first_order.kochin_diffraction

    @property
    def residual(self):
        return self.first_order.residual

    def drift_of_each(self, moving):
        """Mean surge, sway and yaw drift of each body by `bem.transfer.drift`; shape (m, bodies, 3). The drift is
        about the reference point of the body, in the axes of the body"""
        problem = self.problem
        motions = np.zeros((len(self.headings), self.count), complex)
        if moving:
            motions = self.rao @ self.of_motion
        coupled = self.solver.at(self.omega, problem.gravity)
        found = coupled.drift_of_each(self.headings, motions, problem.density)
        for i, body in enumerate(problem.bodies):
            x, y, moment = found[:, i].T
            c, s, arm = np.cos(body.heading), np.sin(body.heading), np.subtract(body.rotation_center[:2], body.place)
            found[:, i] = np.stack([c * x + s * y, c * y - s * x, moment - arm[0] * y + arm[1] * x], axis=-1)
        return found

    def pressure(self):
        """Pressure on the hull, which only the panel method computes"""
        return self.prepared.panels.run(self.omega, self.headings, {"pressure"}, None, None).pressure()
