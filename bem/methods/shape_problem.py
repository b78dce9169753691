"""The radiation–diffraction problem of a box or vertical cylinder, for the methods that need no panels."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ..checks import enlarged
from ..contour.raised_bed import SHARE, bed_share, with_bed
from ..frequency import DRIFT, FrequencyRun
from ..modes import with_net_flux
from ..problem import Problem


@dataclass(frozen=True, eq=False, kw_only=True)
class ShapeProblem(Problem):
    """A box or buoy in water, its waterplane centred at the origin.

    method : contour, strip or inverse-strip; shape : box (length, beam, draft) or buoy (radius, draft)
    sizes : m, in that order; tolerance : relative error asked for
    panels : `bem.methods.panel_problem.PanelProblem` of the same body, for pressures on its panels and limits over a
        raised bed; or None
    omegas : (n,) rad/s, ascending, that will be asked for: of many some tell the errors of the others
        (`bem.methods.few_estimates`)
    bed : m, of `bem.contour.raised_bed`, at most `depth`: the contour method works over it; None for the bed that
        there is
    """

    method: str
    shape: str
    sizes: tuple
    tolerance: float = 1e-3
    panels: object = None
    omegas: object = ()
    bed: float | None = None

    def prepared(self):
        """`PreparedShapeProblem`"""
        return PreparedShapeProblem(self)


@dataclass(frozen=True, eq=False)
class PreparedShapeProblem:
    """A `ShapeProblem` and the solver of its method, whose frequency-independent part is kept."""

    problem: ShapeProblem

    @cached_property
    def solver(self):
        """What solves a frequency: `first_order(omega, headings, theta, dofs, …)` → `bem.first_order.FirstOrder`"""
        s = self.problem
        if s.method == "contour":
            from ..contour.solver import TOLERANCES, prepare_box, prepare_cylinder

            water = (s.depth, s.tolerance) if s.bed is None else (s.bed, max(SHARE * s.tolerance, TOLERANCES[0]))
            return (prepare_box if s.shape == "box" else prepare_cylinder)(*s.sizes, *water)
        from ..sections.strips import Strips

        return Strips(*s.sizes, s.depth, s.tolerance, inverse=s.method == "inverse-strip")

    @cached_property
    def panels(self):
        """The panels prepared; raises ValueError where there are none"""
        if self.problem.panels is None:
            raise ValueError(f"method {self.problem.method} has no panels to give pressures on")
        return self.problem.panels.prepared()

    @property
    def radius(self):
        """m, largest distance of the hull from the vertical axis through the origin"""
        s = self.problem.sizes
        return float(np.hypot(s[0], s[1]) / 2 if self.problem.shape == "box" else s[0])

    @property
    def draft(self):
        """m, of the hull"""
        return self.problem.sizes[-1]

    @property
    def displacing(self):
        """(6,) whether a mode moves water at all"""
        return np.array([True] * 5 + [self.problem.shape == "box"])

    def run(self, *arguments):
        """The quantities of one frequency; arguments as in `bem.frequency.FrequencyRun`"""
        return ShapeRun(self, *arguments) if self.few_estimates is None else self.few_estimates.run(*arguments)

    @cached_property
    def few_estimates(self):
        """`bem.methods.few_estimates.FewEstimates`, or None where each frequency has an estimate of its own"""
        from .few_estimates import FEWEST, FewEstimates

        many = self.problem.method == "contour" and len(self.problem.omegas) >= FEWEST
        return FewEstimates(self, self.problem.omegas) if many else None

    def added_mass_limit(self, which):
        """A (6, 6) about the rotation centre for `which` "zero" or "infinity" of the frequency

        Not over a raised bed, where heave has another limit at zero, and no estimate tells what the bed does.
        """
        if self.problem.bed is not None:
            return self.panels.added_mass_limit(which)
        T, about_origin = self.problem.transform, self.solver.added_mass_limit(which, self.problem.density)
        grows = np.isinf(about_origin[2, 2])
        finite = np.where(np.isinf(about_origin), 0.0, about_origin)
        return with_net_flux(T @ finite @ T.T, T[:, 2] * grows, 1.0)


class ShapeRun(FrequencyRun):
    """One frequency of a method without panels, by the prepared solver or a sharper one.

    Few problems need one: heights of a gap and drafts at which what keel and sides radiate nearly cancels.
    """

    most_sharper = 2  # digits more than the tolerance asks for

    def __init__(self, prepared, omega, headings, want, theta, dofs, solver=None):
        super().__init__(prepared, omega, headings, want, theta, dofs)
        self.solver = prepared.solver if solver is None else solver

    @property
    def sharper(self):
        """By a digit more; None at the last, and where what is left out of short waves is the error"""
        if self.problem.method != "contour" or self.first_order.neglected is not None or self.solver.sharper is None:
            return None
        return partial(ShapeRun, self.prepared, *self.question, self.solver.sharper)

    @property
    def solves(self):
        """Whether any equations have to be solved"""
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
        """The same by the finer body of the contour method"""
        return self._first_order(self.solver.finer, self.want & DRIFT)

    def _first_order(self, solver, far_field):
        at = np.concatenate([self.theta, self.headings]) if far_field else ()
        return solver.first_order(self.omega, self.waves, at, self.dofs, self.problem.density, self.problem.gravity)

    @property
    def waves(self):
        """(m,) headings; empty where no diffraction is wanted"""
        return self.headings if self.diffracts else np.empty(0)

    def enlarged(self, radiation, excitation):
        """Errors with what is left out of short waves and what a raised bed adds"""
        neglected = self.first_order.neglected
        if neglected is not None:
            A, B = (enlarged(part, neglected[0]) for part in (radiation.real, radiation.imag))
            radiation, excitation = A + 1j * B, enlarged(excitation, neglected[1])
        return with_bed(self, radiation, excitation)

    @cached_property
    def differences(self):
        """Of the contour method, from the finer body; None for strips, whose error is that of strip theory"""
        if self.problem.method != "contour":
            return None
        ours, fine = self.first_order, self.finer
        force, better = (r.froude_krylov + r.diffraction for r in (ours, fine))
        return ours.radiation - fine.radiation, force - better

    @cached_property
    def kochin_differences(self):
        """As `differences`, of `kochin`"""
        fine = self.finer.kochin_radiation, self.finer.kochin_diffraction
        return [H - better for H, better in zip(self.kochin, fine, strict=True)]

    @property
    def kochin_errors(self):
        """As `errors`, of `kochin`"""
        share = bed_share(self.problem)
        return [error + share * H for H, error in zip(self.kochin, self.kochin_differences, strict=True)]

    @property
    def radiated(self):
        mine = self.first_order.radiated if self.radiates else None
        return super().radiated if mine is None else mine

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

    def pressure(self):
        """Of the panel method"""
        return self.prepared.panels.run(self.omega, self.headings, {"pressure"}, None, None).pressure()
