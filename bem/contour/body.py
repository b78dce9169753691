"""Box or vertical cylinder in finite depth by domain decomposition.

Outside and under the body the potential is a sum of eigenfunctions of depth (`bem.depth_modes.gap`). Each
eigenfunction has a Neumann-to-Dirichlet map of the plan contour (`plan.circle`, `plan.rectangle`). Velocity profiles
in the gap under the keel have the singularity of the keel's edge (`bem.depth_modes.gap_profiles`). Galerkin's method
makes the potentials on both sides of the gap equal (`matching`).
Sources: Ijima's method in the SR179 report (1982), section 2.1.5, eqs 2.1.5.18-28, and Garrett, J. Fluid
Mech. 46 (1971).  Conventions as in `bem`.

Two parts do not depend on frequency: the maps under the body, and a table in κ of the maps outside, from which
evanescent modes are summed (`modal_sums`).
The functions of the plan are hierarchical in their degree, so that one table of a degree serves every frequency that
needs this degree or a lower one.  A frequency solves one plane Helmholtz problem around the plan.
"""

from dataclasses import dataclass, field
from functools import cached_property, wraps

import numpy as np

from ..depth_modes.gap import Gap
from ..depth_modes.gap_profiles import DEPENDENT, Profiles
from ..kernels.threads import blas_threads
from ..modes import class_of
from ..waves import wavenumber
from .accuracy import DIGIT, Accuracy, accuracy, finer
from .frequency_limits import infinite_frequency, zero_frequency
from .matching import fixed_terms
from .modal_sums import ChebyshevNodes, contracted
from .one_frequency import ContourFrequency, combined, degrees
from .rigid_motions import Motion, bottom_integral, motion

TOLERANCES = (1e-7, 0.1)
MARGIN = 0.5  # digits in addition to the requested ones
# fraction of the largest wavenumber along the contour at which the asymptotic range of the table in κ begins
ALONG = 0.25
SMALL = 100  # unknowns of a class or a plane problem, a few hundred at most


def memoised(method):
    """Decorator: memoise a method in the `cache` of its object, for every set of arguments."""

    @wraps(method)
    def cache(self, *arguments):
        key = (method.__name__, *arguments)
        if key not in self.cache:
            self.cache[key] = method(self, *arguments)
        return self.cache[key]

    return cache


@dataclass(frozen=True, eq=False)
class ContourBody:
    """A body of constant plan from z = −draft to the surface, with all quantities that do not depend on frequency.

    plan : `Circle` or `Rectangle`; draft, depth : m; accuracy : `Accuracy` of the parts of the method
    """

    plan: object
    draft: float
    depth: float
    accuracy: Accuracy
    cache: dict = field(default_factory=dict, repr=False)

    def first_order(self, omega, headings=(), theta=(), dofs=range(6), density=1025.0, gravity=9.80665):
        """`FirstOrder` at one frequency.

        omega : frequency, rad/s; headings : directions that the waves travel to, rad, (m,); theta : angles of the
            Kochin functions, rad, (t,)
        dofs : needed degrees of freedom 0 … 5; the others remain zero
        Raises ValueError for a frequency that is not positive and finite, and for an angle that is not finite.
        """
        if not 0 < omega < np.inf:
            raise ValueError(
                f"omega is {omega} rad/s; allowed: positive and finite (for 0 or infinity use added_mass_limit)"
            )
        if not (np.all(np.isfinite(headings)) and np.all(np.isfinite(theta))):
            raise ValueError("headings or theta contain a value that is not finite; allowed: finite angles, rad")
        with blas_threads(SMALL):
            return ContourFrequency(self, omega, headings, theta, dofs, density, gravity).result()

    def resolution(self, omega, gravity=9.80665):
        """Resolution of the equations at a frequency. Errors are smooth over frequencies of equal resolution"""
        k = float(wavenumber(omega, self.depth, gravity))
        degree, top = degrees(self, k)
        return degree, top, len(self.plan.contour(k, degree, self.tolerance).weights)

    def froude_krylov(self, omega, headings, dofs=range(6), density=1025.0, gravity=9.80665):
        """Force of the undisturbed waves alone, N/m and N m/m; shape (m, 6); arguments as in `first_order`"""
        k = float(wavenumber(omega, self.depth, gravity))
        force = self.plan.incident_force(self.draft, self.depth, k, np.atleast_1d(np.asarray(headings, float)))
        return density * gravity * np.where(np.isin(np.arange(6), dofs), force, 0)

    def added_mass_limit(self, which, density=1025.0):
        """Added mass about the origin at the frequency `which`, "zero" or "infinity", kg, kg m, kg m²; shape (6, 6)

        Heave is infinite at zero frequency, as A ~ −(ρ area² / 2πh) ln k in finite depth.
        """
        if which not in ("zero", "infinity"):
            raise ValueError(f"limit is {which!r}; allowed: 'zero', 'infinity'")
        with blas_threads(SMALL):
            return density * (zero_frequency(self) if which == "zero" else infinite_frequency(self))

    @cached_property
    def finer(self):
        """The same body with one more digit, from which the error of this body is estimated"""
        fine = finer(self.accuracy, self.draft, self.depth - self.draft, self.plan.scale)
        return ContourBody(self.plan.to(fine), self.draft, self.depth, fine)

    @cached_property
    def sharper(self):
        """The same body for a tenth of the tolerance; None at the smallest tolerance"""
        digits = self.accuracy.digits + DIGIT
        if digits > MARGIN - np.log10(TOLERANCES[0]) + 1e-9:
            return None
        sharp = accuracy(digits, self.draft, self.depth - self.draft, self.plan.scale)
        return ContourBody(self.plan.to(sharp), self.draft, self.depth, sharp)

    @property
    def tolerance(self):
        """Relative error for which the parts are made"""
        return 10**-self.accuracy.digits

    @cached_property
    def profiles(self):
        """`Profiles` of the gap"""
        return Profiles(Gap(self.draft, self.depth, self.accuracy.terms), self.accuracy.smallest)

    @memoised
    def nodes(self, degree):
        """Values of κ, rising from below the first modes of both regions, at which the maps of functions up to
        `degree` are known.

        The nearest singularities of the maps lie at arg κ = ±π/2: the error of Chebyshev interpolation falls by a
        factor of ten for every 0.73 nodes per factor e in κ.  One digit and a half are lost to the size of κT in long
        waves.  A wave of m rad/m along a wall has κN = −κ / √(κ² + m²), which approaches its limit −1 only for κ
        larger than all m.
        """
        first, digits = np.pi / (2 * self.depth), self.accuracy.kappa
        shortest = max(1 / self.plan.scale, first, ALONG * self.plan.finest(degree))
        last = 10 ** (digits / 3 + 0.1) * shortest
        return ChebyshevNodes(first, last, int(np.ceil(0.8 * (digits + 1.5) * np.log(last / first))) + 2)

    @memoised
    def maps(self, degree):
        """{class: κN and κT at the nodes, followed by their limits −1 and 1, two arrays (c + 1, n, n)}"""

        def with_limit(values, limit):
            return np.concatenate([values, limit * np.eye(values.shape[1])[None]])

        tables = self.plan.maps(degree, self.nodes(degree).kappa)
        return {cls: (with_limit(outer, -1), with_limit(inner, 1)) for cls, (outer, inner) in tables.items()}

    @memoised
    def laplace(self, degree):
        """{class: the maps outside and inside for κ = 0, two (n, n)}"""
        return self.plan.laplace(degree)

    def contracted(self, degree, rows, wavenumbers, norms, decays):
        """Weight of each node of the table in the sum of ⟨·, Zₙ⟩⟨·, Zₙ⟩ N(kₙ) / norm over modes; shape (r, r, c + 1)"""
        sums = contracted(rows, decays, 1 / (norms * wavenumbers), self.nodes(degree).weights(wavenumbers))
        return self.profiles.products(sums)

    @memoised
    def outer_maps(self, cls, degree, top):
        """κN at the nodes and its limit, for functions up to `degree`, taken from those up to `top`; shape (c + 1, n,
        n)"""
        own = self.plan.subset(cls, degree, top)
        return np.ascontiguousarray(self.maps(top)[cls][0][:, own[:, None], own])

    def mode_count(self, k):
        """Number of evanescent modes outside the body; k = ω²/g"""
        return self.profiles.gap.mode_count(k, self.accuracy.modes, self.plan.scale, DEPENDENT)

    @memoised
    def inner_weights(self, degree):
        gap = self.profiles.gap
        inner = gap.inner_modes(gap.inner_count(2 * self.accuracy.modes, self.plan.scale))
        return self.contracted(degree, inner.rows, inner.wavenumbers, gap.height / 2, gap.inner_decays)

    @memoised
    def beneath(self, cls, degree):
        """Potentials under the body, tested with the profiles and with 1 and ζ²; shape (r, n, r, n)"""
        rows = self.profiles.mean_rows
        mean = np.multiply.outer(rows, rows) / self.profiles.height
        return combined(self.inner_weights(degree), self.maps(degree)[cls][1], mean, self.laplace(degree)[cls][1])

    @memoised
    def fixed_terms(self, cls, degree, top, dofs):
        """`bem.contour.matching.FixedTerms` of the motions `dofs`; functions up to `degree`, taken from those up to
        `top`"""
        own, unit = self.plan.subset(cls, degree, top), self.unit(cls, top)
        each, shape = [self.motion(d, top) for d in dofs], (len(dofs), 2, len(own))
        motions = Motion(*(np.reshape([m[i][:, own] for m in each], shape) for i in range(3)))
        beneath = self.beneath(cls, top)[:, own][:, :, :, own]
        unit = None if unit is None else unit[own]
        return fixed_terms(self.profiles, beneath, unit, motions, np.array([self.bottom(d) for d in dofs]))

    @memoised
    def motion(self, dof, degree):
        cls = class_of(dof, "xy")
        contour = self.plan.polynomial_contour(degree)
        return motion(dof, contour, self.plan.basis(cls, degree, contour), self.profiles.height, self.plan.alphas)

    @memoised
    def bottom(self, dof):
        """∬ ψ w dA"""
        contour = self.plan.polynomial_contour(self.plan.degree(0.0, self.tolerance))
        return bottom_integral(dof, contour, self.profiles.height, self.plan.alphas)

    @memoised
    def unit(self, cls, degree):
        """Coefficients of the constant function 1; shape (n,); None if the class has no net flux"""
        if cls != (1, 1):
            return None
        contour = self.plan.polynomial_contour(degree)
        return 4 * contour.weights @ self.plan.basis(cls, degree, contour)
