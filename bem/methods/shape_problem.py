"""The radiation–diffraction problem of boxes and vertical cylinders, for the methods without panels."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..modes import with_net_flux
from ..problem import Problem
from .few_estimates import FEWEST, FewEstimates
from .shape_run import RESOLVED, ShapeRun


@dataclass(frozen=True, eq=False, kw_only=True)
class ShapeProblem(Problem):
    """One box or buoy whose waterplane is centred at the origin, or several boxes and buoys, solved without panels.

    method : "contour", "strip" or "inverse-strip", or "transfer" for several bodies
    shape : box (length, beam, draft) or buoy (radius, draft)
    sizes : sizes of the shape in the order given above, m; tolerance : requested relative error
    shapes : shape and sizes of each of several `bodies`; they replace `shape` and `sizes`
    panels : `bem.methods.panel_problem.PanelProblem` of the same body, for pressures on its panels, or None
    omegas : frequencies of the run, ascending, rad/s, (n,); if there are many, errors are estimated at a few
        frequencies and interpolated (`bem.methods.few_estimates`)
    """

    method: str
    shape: str = ""
    sizes: tuple = ()
    shapes: tuple = ()
    tolerance: float = 1e-3
    panels: object = None
    omegas: object = ()

    def prepared(self):
        """`PreparedShapeProblem`"""
        return PreparedShapeProblem(self)


@dataclass(frozen=True, eq=False)
class PreparedShapeProblem:
    """A `ShapeProblem` and the solver of its method, which keeps all that is equal at all frequencies."""

    problem: ShapeProblem

    @cached_property
    def solver(self):
        """Solver of a frequency: `first_order(omega, headings, theta, dofs, …)` → `bem.first_order.FirstOrder`"""
        s = self.problem
        if s.shapes:
            from ..contour.several.bodies import prepare_several
            from ..contour.several.exterior import Place
            from ..transfer.far_bodies import prepare_far

            places = [Place(*body.place, body.heading) for body in s.bodies]
            prepare = prepare_far if s.method == "transfer" else prepare_several
            return prepare(s.shapes, places, s.depth, s.tolerance)
        if s.method == "contour":
            from ..contour.solver import prepare_box, prepare_cylinder

            return (prepare_box if s.shape == "box" else prepare_cylinder)(*s.sizes, s.depth, s.tolerance)
        from ..sections.strips import Strips

        return Strips(*s.sizes, s.depth, s.tolerance, inverse=s.method == "inverse-strip")

    @cached_property
    def panels(self):
        """The prepared panel problem of the same body.  Raises ValueError for a problem without panels."""
        if self.problem.panels is None:
            raise ValueError(f"method {self.problem.method} has no panels, so there is no pressure on panels")
        return self.problem.panels.prepared()

    @property
    def radius(self):
        """Largest distance of the hull from the vertical axis through the origin, m"""
        problem = self.problem
        if problem.shapes:
            each = zip(problem.shapes, problem.bodies, strict=True)
            return max(_reach(*one) + float(np.hypot(*body.place)) for one, body in each)
        return _reach(problem.shape, problem.sizes)

    @property
    def draft(self):
        """Draft of the hull, or of the deepest of several hulls, m"""
        return max(sizes[-1] for _, sizes in self.shapes)

    @property
    def displacing(self):
        """Whether each mode displaces water; shape (6,), for N bodies (6N,)"""
        return np.array([moves for shape, _ in self.shapes for moves in [True] * 5 + [shape == "box"]])

    @property
    def shapes(self):
        """Shape and sizes of the body, or of each of several bodies"""
        return self.problem.shapes or ((self.problem.shape, self.problem.sizes),)

    def run(self, *arguments):
        """The quantities of one frequency; arguments as in `bem.frequency.FrequencyRun`"""
        return ShapeRun(self, *arguments) if self.few_estimates is None else self.few_estimates.run(*arguments)

    @cached_property
    def few_estimates(self):
        """`bem.methods.few_estimates.FewEstimates`; None if errors are estimated at every frequency"""
        many = self.problem.method in RESOLVED and len(self.problem.omegas) >= FEWEST
        return FewEstimates(self, self.problem.omegas) if many else None

    def added_mass_limit(self, which):
        """Added mass about the rotation centre at the frequency `which`, "zero" or "infinity"; shape (6, 6), for N
        bodies (6N, moving)"""
        if self.problem.shapes:
            return self._limit_of_several(which)
        T, about_origin = self.problem.transform, self.solver.added_mass_limit(which, self.problem.density)
        grows = np.isinf(about_origin[2, 2])
        finite = np.where(np.isinf(about_origin), 0.0, about_origin)
        return with_net_flux(T @ finite @ T.T, T[:, 2] * grows, 1.0)

    def _limit_of_several(self, which):
        problem, T = self.problem, self.problem.transform
        finite, flux = self.solver.limit(which)
        out = with_net_flux(problem.density * T @ finite @ T.T, T @ flux, np.abs(flux).max() or 1.0)
        return out[:, problem.moving]


def _reach(shape, sizes):
    """m, from the middle of a body to its farthest point in plan"""
    return float(np.hypot(sizes[0], sizes[1]) / 2 if shape == "box" else sizes[0])
