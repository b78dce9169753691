"""Boxes and vertical cylinders side by side by domain decomposition: a gap under each body, and water around all
bodies.

Under each body and in its gap the equations are those of `body.ContourBody`. The maps outside are replaced by maps of
all plans together (`exterior`).
The functions ψ, the nodes and the table in κ are as fine as the water between the bodies requires. Errors are
estimated from finer bodies, as for one body.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product

import numpy as np

from ...kernels.threads import blas_threads
from ...modes import reference_change, turned, with_net_flux
from ...waves import wavenumber
from ..accuracy import accuracy
from ..body import SMALL, memoised
from ..modal_sums import ChebyshevNodes, contracted
from ..one_frequency import degrees
from ..plan.circle import Circle
from ..plan.maps import CLASSES, area_moment
from ..solver import prepare_box, prepare_cylinder
from .exterior import REACH, Exterior
from .fixed import Fixed
from .one_frequency import SeveralFrequency
from .senders import Kernel, sender

NARROWEST = 0.005  # smallest gap over half the width of a body; a hundredth takes minutes per frequency
# digits more for the functions under each keel, since bodies may couple by a hundredth of their own added mass.  At a
# tolerance of 1e-4 the largest error of 14 random arrangements, in coefficients above 0.005 √|ZᵢᵢZⱼⱼ|, is then 1.3e-5
# of their own size (5e-4 without), that of the two published cylinders 1e-6 (2e-4).  A frequency takes a tenth longer.
COUPLED = 1.0


def prepare_several(shapes, places, depth, tolerance=1e-3):
    """`SeveralBodies`.

    shapes : [("box", (length, beam, draft)) or ("buoy", (radius, draft))], m
    places : [`exterior.Place`] of the middle of each body; depth : m, finite
    Raises ValueError for the reasons of `solver.prepare_box`, for bodies that touch, and for gaps below `NARROWEST`.
    """
    makers = {"box": prepare_box, "buoy": prepare_cylinder}
    bodies = [makers[shape](*sizes, depth, tolerance) for shape, sizes in shapes]
    _check_apart([body.plan for body in bodies], places)
    gaps = nearest([body.plan for body in bodies], places)
    for number, (body, gap) in enumerate(zip(bodies, gaps, strict=True), 1):
        least = NARROWEST * body.plan.scale
        if gap < least:
            raise ValueError(
                f"body {number} is {gap:.3g} m from the next; the contour method needs at least {least:.3g} m "
                f"({NARROWEST:g} times half its width); use the panel method"
            )
    bodies = [beside(body, gap) for body, gap in zip(bodies, gaps, strict=True)]
    return SeveralBodies(tuple(bodies), tuple(places), tuple(gaps))


def beside(body, gap):
    """The body with the plan of `near` and the functions of `coupling`"""
    return replace(coupling(body), plan=near(body, gap), cache={})


def coupling(body):
    """The body with functions under its keel for `COUPLED` digits more"""
    height, fine = body.depth - body.draft, body.accuracy
    if height > 0:
        more = accuracy(fine.digits + COUPLED, body.draft, height, body.plan.scale)
        fine = fine._replace(terms=max(fine.terms, more.terms))
    return replace(body, accuracy=fine, cache={})


def near(body, gap):
    """The plan of a body with functions for flows whose length is the gap, m, to the next body

    On a circle the orders of flows at that distance decay like those of the circle's image. A side of a rectangle
    needs more polynomials, in proportion to the width of the plan over the gap, to resolve its ends.
    """
    plan, digits = body.plan, body.accuracy.digits
    if isinstance(plan, Circle):
        orders = int(np.ceil(digits * np.log(10) / np.arccosh(1 + gap / (2 * plan.radius))))
        return replace(plan, lowest=max(plan.lowest, orders))
    shorter = np.sqrt(max(1.0, plan.scale / gap))
    return replace(plan, extra=int(np.ceil(plan.extra * shorter)))


def nearest(plans, places):
    """[Distance from each plan to the nearest other plan, m]"""
    outlines = [place.in_scene(_outline(plan)) for plan, place in zip(plans, places, strict=True)]
    out = []
    for a, one in enumerate(outlines):
        out.append(min(_distance(one, other) for b, other in enumerate(outlines) if b != a))
    return out


def _check_apart(plans, places):
    """Raise ValueError for two plans that touch"""
    outlines = [place.in_scene(_outline(plan, 50)) for plan, place in zip(plans, places, strict=True)]
    for (a, plan), (b, outline) in product(enumerate(plans), enumerate(outlines)):
        if a == b:
            continue
        seen = places[a].own(outline)
        if isinstance(plan, Circle):
            inside = np.abs(seen) <= plan.radius
        else:
            inside = (np.abs(seen.real) <= plan.length / 2) & (np.abs(seen.imag) <= plan.beam / 2)
        if np.any(inside):
            raise ValueError(f"bodies {a + 1} and {b + 1} overlap or touch; allowed: water between them")


def _outline(plan, pieces=1):
    """Points of a circle, or of a rectangle whose sides are divided into `pieces` pieces, complex, m; shape (p,)"""
    if isinstance(plan, Circle):
        return plan.radius * np.exp(2j * np.pi * np.arange(180) / 180)
    corner = (plan.length + 1j * plan.beam) / 2
    corners = np.array([corner, -corner.conjugate(), -corner, corner.conjugate()])
    along = np.roll(corners, -1) - corners
    return (corners[:, None] + along[:, None] * np.arange(pieces) / pieces).ravel()


def _distance(one, other):
    """m, of two closed polygons (p,) and (q,) complex that do not touch"""

    def to_sides(points, polygon):
        along = np.roll(polygon, -1) - polygon
        ahead = points[:, None] - polygon
        share = np.clip((ahead * along.conj()).real / np.abs(along) ** 2, 0, 1)
        return np.abs(ahead - share * along).min()

    return float(min(to_sides(one, other), to_sides(other, one)))


@dataclass(frozen=True, eq=False)
class SeveralBodies:
    """Several `body.ContourBody` in common water.

    places : `exterior.Place` of the middle of each body; gaps : distance from each body to the nearest other body, m
    """

    bodies: tuple
    places: tuple
    gaps: tuple
    cache: dict = field(default_factory=dict, repr=False)

    @property
    def depth(self):
        """m"""
        return self.bodies[0].depth

    @property
    def tolerance(self):
        """Relative error for which the parts are made"""
        return max(body.tolerance for body in self.bodies)

    @property
    def digits(self):
        """Number of digits for which the parts are made"""
        return max(body.accuracy.digits for body in self.bodies)

    def first_order(self, omega, headings=(), theta=(), dofs=None, density=1025.0, gravity=9.80665):
        """`FirstOrder` at one frequency, motions (6N,) about the origin, body by body

        dofs : ignored, because all motions are solved; other arguments as in `ContourBody.first_order`
        """
        if not 0 < omega < np.inf:
            raise ValueError(
                f"omega is {omega} rad/s; allowed: positive and finite (for 0 or infinity use added_mass_limit)"
            )
        with blas_threads(SMALL):
            return SeveralFrequency(self, omega, headings, theta, density, gravity).result()

    def froude_krylov(self, omega, headings, dofs=None, density=1025.0, gravity=9.80665):
        """Force of the undisturbed waves alone, N/m and N m/m, about the origin; shape (m, 6N); dofs : ignored"""
        k, beta = float(wavenumber(omega, self.depth, gravity)), np.atleast_1d(np.asarray(headings, float))
        each = []
        for body, place in zip(self.bodies, self.places, strict=True):
            phase = np.exp(1j * k * (place.x * np.cos(beta) + place.y * np.sin(beta)))
            own = body.froude_krylov(omega, beta - place.heading, range(6), density, gravity)
            each.append(phase[:, None] * own)
        return np.hstack(each) @ self.to_scene.T

    def added_mass_limit(self, which, density=1025.0):
        """Added mass about the origin at the frequency `which`, "zero" or "infinity"; shape (6N, 6N)

        At zero frequency the added mass between motions with a net flux is infinite, as in `frequency_limits`.
        """
        finite, flux = self.limit(which)
        return with_net_flux(density * finite, flux, np.abs(flux).max() or 1.0)

    def limit(self, which):
        """Limit of added mass for unit density, shape (6N, 6N), and net flux of each motion (a source in plan), m²,
        shape (6N,)

        Motions are about the origin. Infinite values between two motions with a net flux are omitted.
        """
        if which not in ("zero", "infinity"):
            raise ValueError(f"limit is {which!r}; allowed: 'zero', 'infinity'")
        contours = [body.plan.polynomial_contour(body.plan.degree(0.0, 1.0)) for body in self.bodies]
        afloat = [body.depth > body.draft for body in self.bodies]
        area = [floats * area_moment(contour, 0, 0) for floats, contour in zip(afloat, contours, strict=True)]
        flux = np.kron(area, [0, 0, which == "zero", 0, 0, 0]).astype(float)
        with blas_threads(SMALL):
            return self._limit(which == "zero"), self.to_scene @ flux

    def _limit(self, zero):
        """Modes as in `frequency_limits`"""
        degrees_, tops = self.degrees(0.0)
        shift = 0.0 if zero else -0.5
        k = (np.arange(1, self.mode_count(0.0) + 1) + shift) * np.pi / self.depth
        fixed, exterior = Fixed(self, degrees_, tops), self._exterior(0.0, degrees_)
        rows = [body.profiles.gap.outer_rows(k) for body in self._first_of_kinds]
        weights = self._weights(rows, k, np.full(len(k), self.depth / 2), tops)
        single, one = np.zeros((exterior.basis.shape[1],) * 2), []
        if zero:
            single = exterior.map(Kernel("laplace")) / self.depth
        for body, _ in self.of_kinds:
            whole = np.concatenate([body.profiles.gap.mean, [body.draft, -(body.draft**2) / 2]])
            one.append(body.profiles.combinations @ (whole if zero else 0 * whole))
        outside, none = fixed.outside(weights, self.outer_maps(degrees_, tops), one, single), np.zeros((fixed.size, 0))
        found = -fixed.loads(outside, *fixed.solved(outside, none)[:2], none)
        return self.to_scene @ found @ self.to_scene.T

    @cached_property
    def finer(self):
        """The same bodies with one more digit, from which the error of these bodies is estimated"""
        return self._by(lambda body: body.finer)

    @cached_property
    def sharper(self):
        """The same bodies for a tenth of the tolerance; None at the smallest tolerance"""
        return None if any(body.sharper is None for body in self.bodies) else self._by(lambda body: body.sharper)

    def _by(self, better):
        made = [better(body) for body in self.bodies]
        made = [beside(body, gap) for body, gap in zip(made, self.gaps, strict=True)]
        return replace(self, bodies=tuple(made), cache={})

    @cached_property
    def to_scene(self):
        """Matrix from forces about the middle of each body in its own axes to forces about the origin in the axes of
        the scene; shape (6N, 6N)"""
        from scipy.linalg import block_diag

        parts = [turned(p.heading) @ reference_change((p.x, p.y, 0.0)) for p in self.places]
        return np.linalg.inv(block_diag(*parts))

    @cached_property
    def of_kinds(self):
        """[(body, index of its kind)]; bodies of one kind have the same draft and functions of the gap"""
        kinds, out = [], []
        for body in self.bodies:
            kind = body.draft, body.accuracy.terms, body.profiles.smallest
            if kind not in kinds:
                kinds.append(kind)
            out.append((body, kinds.index(kind)))
        return out

    @cached_property
    def _first_of_kinds(self):
        kinds = [kind for _, kind in self.of_kinds]
        return [self.bodies[kinds.index(one)] for one in range(max(kinds) + 1)]

    def mode_count(self, k):
        """Number of evanescent modes outside the bodies; k = ω²/g"""
        return max(
            max(body.mode_count(k), body.profiles.gap.mode_count(k, body.accuracy.modes, gap))
            for body, gap in zip(self.bodies, self.gaps, strict=True)
        )

    def outer_modes(self, omega, gravity):
        """[`OuterModes`] of every kind, all with the same number of modes"""
        count = self.mode_count(omega**2 / gravity)
        return [body.profiles.gap.outer_modes(omega, count, gravity) for body in self._first_of_kinds]

    def resolution(self, omega, gravity=9.80665):
        """Resolution of the equations at a frequency, as of `body.ContourBody`"""
        k = float(wavenumber(omega, self.depth, gravity))
        return (*self.degrees(k), self.exterior(k, self.degrees(k)[0]).size)

    def degrees(self, k):
        """Degrees of the functions on each plan, and degrees of the tables of each plan"""
        return tuple(zip(*(degrees(body, k) for body in self.bodies), strict=True))

    def exterior(self, k, degrees_):
        """`Exterior` that resolves waves of k rad/m; all k between neighbouring powers of 1.2 have the same
        `Exterior`"""
        longest = max(body.plan.reach for body in self.bodies)
        step = 1.2 ** np.ceil(np.log(max(k * longest, 1.0)) / np.log(1.2))
        return self._exterior(float(step / longest) if k else 0.0, degrees_)

    @memoised
    def _exterior(self, k, degrees_):
        digits = self.digits + 1
        shortest = min(1 / k if k else np.inf, min(self.gaps) / REACH)
        made = [sender(body.plan, degree, k, gap, digits, shortest)
                for body, degree, gap in zip(self.bodies, degrees_, self.gaps, strict=True)]  # fmt: skip
        return Exterior(made, self.places)

    @memoised
    def nodes(self, tops):
        """`ChebyshevNodes` of κ for all bodies, as `ContourBody.nodes`"""
        each = [body.nodes(top) for body, top in zip(self.bodies, tops, strict=True)]
        first, last = min(one.first for one in each), max(one.last for one in each)
        dense = max((one.count - 2) / np.log(one.last / one.first) for one in each)
        return ChebyshevNodes(first, last, int(np.ceil(dense * np.log(last / first))) + 2)

    def coupled(self, tops):
        """Number of values of κ in the table at which the plans interact"""
        return int(np.sum(self.nodes(tops).kappa * min(self.gaps) <= REACH))

    @memoised
    def maps(self, tops):
        """κN outside at the nodes, followed by its limit −1, shape (c + 1, n, n), and N for κ = 0"""
        nodes, exterior = self.nodes(tops), self._exterior(0.0, tops)
        apart = nodes.kappa * min(self.gaps) > REACH
        size = exterior.basis.shape[1]
        out = np.zeros((len(nodes.kappa) + 1, size, size))
        for c, kappa in enumerate(nodes.kappa[~apart]):
            out[c] = kappa * exterior.map(Kernel("decaying", kappa))
        first = 0
        for body, top in zip(self.bodies, tops, strict=True) if np.any(apart) else ():
            maps = body.plan.maps(top, nodes.kappa[apart])
            for cls in CLASSES:
                at = slice(first, first + maps[cls][0].shape[-1])
                out[len(nodes.kappa) - len(maps[cls][0]) : -1, at, at] = maps[cls][0]
                first = at.stop
        out[-1] = -np.eye(size)
        return out

    @memoised
    def outer_maps(self, degrees_, tops):
        """κN of functions up to `degrees_`, taken from those up to `tops`; shape (c + 1, n, n)"""
        own = self._chosen(degrees_, tops)
        return np.ascontiguousarray(self.maps(tops)[:, own[:, None], own])

    def _chosen(self, degrees_, tops):
        chosen, first = [], 0
        for body, degree, top in zip(self.bodies, degrees_, tops, strict=True):
            for cls in CLASSES:
                chosen.append(first + body.plan.subset(cls, degree, top))
                first += len(body.plan.subset(cls, top, top))
        return np.concatenate(chosen)

    def weights(self, kinds, tops):
        """Weight of each node of the table in sums over the `OuterModes` of all kinds, {(a, b): (r_a, r_b, c + 1)}"""
        return self._weights([one.rows for one in kinds], kinds[0].wavenumbers, kinds[0].norms, tops)

    def _weights(self, rows, k, norms, tops):
        decays, rows = [body.profiles.gap.outer_decays for body in self._first_of_kinds], np.vstack(rows)
        sums = contracted(rows, np.concatenate(decays), 1 / (norms * k), self.nodes(tops).weights(k))
        ends = np.cumsum([0, *map(len, decays)])
        known = {}
        for i, j in product(range(len(decays)), repeat=2):
            left, right = (self._first_of_kinds[one].profiles.combinations for one in (i, j))
            part = sums[ends[i] : ends[i + 1], ends[j] : ends[j + 1]]
            known[i, j] = np.tensordot(left, np.tensordot(part, right, (1, 1)), (1, 0)).transpose(0, 2, 1)
        each = [kind for _, kind in self.of_kinds]
        return {(a, b): known[i, j] for (a, i), (b, j) in product(enumerate(each), repeat=2)}
