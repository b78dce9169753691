"""Bodies far from each other: each kind of body is solved once per frequency, and the bodies are coupled by partial
waves.

The matrix T gives the waves that a body scatters from regular waves, R the waves that its motions radiate, E the
forces of waves, and S the regular waves at one body due to outgoing waves of another body (`partial_waves`);

    a = a₀ + S b,    b = T a + R v,    force = E a + Z v

a and b are the regular and outgoing waves about all bodies, a₀ the regular waves of the plane wave, and v the motions
(Kagemoto & Yue, J. Fluid Mech. 166, 1986). A body responds only to few combinations y = Q a of the waves
about it, 20 to 40 of 150: the singular vectors of T and E. Therefore

    (I − Q S T Q⁺) y = Q a₀ + Q S R v
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from ..contour.body import SMALL
from ..contour.several.bodies import SeveralBodies, coupling, nearest
from ..contour.solver import prepare_box, prepare_cylinder
from ..depth_modes.gap import OuterModes
from ..first_order import FirstOrder
from ..kernels.threads import blas_threads
from ..waves import group_factor
from .circles import SHARE_OF_DEPTH, too_near
from .contour_shape import answers
from .drift import mean_force
from .partial_waves import PartialWaves, highest_order, to_complex, to_real

LEAST_ORDER, MOST_ORDERS = 2, 60
SHARE = 0.1  # of the tolerance, that orders and modes left out may take
# of the tolerance, that what few numbers leave out of a body's answers is of the largest: coefficients and forces of 16
# arrangements, circles 0.03 to 0.3 of the depth apart, change by about a hundredth of the tolerance
RANK = 3e-2
GONE = 40.0  # κ times the water between two circles, beyond which nothing arrives


def prepare_far(shapes, places, depth, tolerance=1e-3):
    """`FarBodies`; arguments as in `contour.several.bodies.prepare_several`

    Raises ValueError for the reasons of `solver.prepare_box`, and for bodies whose circles are too near (`circles`).
    """
    makers, known = {"box": prepare_box, "buoy": prepare_cylinder}, {}
    for shape, sizes in shapes:
        if (shape, sizes) not in known:
            known[shape, sizes] = coupling(makers[shape](*sizes, depth, tolerance))
    bodies = [known[one] for one in shapes]
    found = too_near([place.x + 1j * place.y for place in places], [body.plan.reach for body in bodies], depth)
    if found:
        raise ValueError(
            f"the circles around bodies {found[0] + 1} and {found[1] + 1} {found[2]}; transfer matrices need "
            f"at least {SHARE_OF_DEPTH * depth:.3g} m between two circles, which is {SHARE_OF_DEPTH:g} of the "
            "depth; use method contour or panel"
        )
    gaps = nearest([body.plan for body in bodies], places)
    return FarBodies(tuple(bodies), tuple(places), tuple(gaps))


@dataclass(frozen=True, eq=False)
class FarBodies(SeveralBodies):
    """Several bodies far from each other; bodies : `bem.contour.body.ContourBody` of each, one object for equal
    bodies; other arguments as in `SeveralBodies`"""

    def first_order(self, omega, headings=(), theta=(), dofs=None, density=1025.0, gravity=9.80665):
        """`FirstOrder` at one frequency, motions (6N,) about the origin, body by body

        dofs : ignored, because all motions are solved"""
        return self.at(omega, gravity).first_order(headings, theta, density)

    def at(self, omega, gravity=9.80665):
        """`Coupled` at one frequency; the last result is kept"""
        if not 0 < omega < np.inf:
            raise ValueError(
                f"omega is {omega} rad/s; allowed: positive and finite (for 0 or infinity use added_mass_limit)"
            )
        if self.cache.get("frequency") != (omega, gravity):
            count = self.mode_count(omega**2 / gravity)
            modes = {body: body.profiles.gap.outer_modes(omega, count, gravity) for body in self.alone}
            coupled = Coupled(self, modes, "radiating", float(omega), gravity)
            self.cache.update(frequency=(omega, gravity), coupled=coupled)
        return self.cache["coupled"]

    def _limit(self, zero):
        shift = 0.0 if zero else -0.5
        k = (np.arange(1, self.mode_count(0.0) + 1) + shift) * np.pi / self.depth
        modes = {}
        for body in self.alone:
            gap, d = body.profiles.gap, body.draft
            first = np.concatenate([gap.mean, [d, -(d**2) / 2]]) * zero
            modes[body] = OuterModes(0.0, self.depth, first, k, np.full(len(k), self.depth / 2), gap.outer_rows(k))
        found = Coupled(self, modes, "laplace" if zero else "decaying", np.nan, np.nan).radiation
        return self.to_scene @ -found.real @ self.to_scene.T

    def _by(self, better):
        made = {body: coupling(better(body)) for body in self.alone}
        return FarBodies(tuple(made[body] for body in self.bodies), self.places, self.gaps)

    @cached_property
    def alone(self):
        """The different bodies, each once"""
        return tuple(dict.fromkeys(self.bodies))

    def resolution(self, omega, gravity=9.80665):
        """Resolution of the equations at a frequency; errors are smooth over frequencies of equal resolution"""
        return tuple(body.resolution(omega, gravity) for body in self.alone)

    @cached_property
    def axes(self):
        """Axes of the bodies, complex, m; shape (N,)"""
        return np.array([place.x + 1j * place.y for place in self.places])

    @cached_property
    def radii(self):
        """Radii of the circles around the bodies, m; shape (N,)"""
        return np.array([body.plan.reach for body in self.bodies])

    @cached_property
    def apart(self):
        """Distances between axes, m, ∞ from a body to itself; shape (N, N)"""
        return np.where(np.eye(len(self.axes), dtype=bool), np.inf, np.abs(self.axes[:, None] - self.axes))

    @cached_property
    def clear(self):
        """Distance from the circle around each body to the nearest other circle, m; shape (N,)"""
        return (self.apart - self.radii).min(axis=1) - self.radii

    def waves(self, kind, modes):
        """[`PartialWaves`] that reach another body"""
        tolerance, nearest_axis = SHARE * self.tolerance, self.apart.min(axis=1)

        def of(kind, k):
            each = zip(self.radii, nearest_axis, self.gaps, strict=True)
            orders = max(highest_order(kind, float(k), *one, tolerance, MOST_ORDERS) for one in each)
            return PartialWaves(kind, float(k), max(LEAST_ORDER, orders))

        kappa = modes.wavenumbers
        count = max(1, int(np.sum(np.exp(-2 * kappa * min(self.gaps)) > tolerance)))
        first = [] if kind == "decaying" else [of(kind, modes.k)]
        return [*first, *(of("decaying", k) for k in kappa[:count])]


class Response(NamedTuple):
    """Response of one body to regular waves a about its axis, through few numbers y = Q a.

    few : Q, (r, q); scattered : outgoing waves of y, (q, r); pressed : ∬ φ nᵢ dS of y, (6, r)
    sent : outgoing waves of unit velocities, in axes of the body, (q, 6)
    """

    few: np.ndarray
    scattered: np.ndarray
    pressed: np.ndarray
    sent: np.ndarray

    def turned(self, turn):
        """This Response with partial waves about axes rotated by an angle; turn : exp(im · angle), (q,)"""
        few, back = self.few * turn, turn[:, None]
        return Response(few, self.scattered / back, self.pressed, self.sent / back)


class Coupled:
    """Bodies coupled at one frequency, or at zero or infinite frequency.

    modes : {body: `OuterModes`}; kind : kind of the first partial waves
    """

    def __init__(self, bodies, modes, kind, omega, gravity):
        self.bodies, self.modes, self.omega, self.gravity = bodies, modes, omega, gravity
        self.k = next(iter(modes.values())).k
        self.waves = bodies.waves(kind, next(iter(modes.values())))
        self.parts = slices(np.cumsum([0, *(2 * one.last + 1 for one in self.waves)]))
        self.orders = np.concatenate([one.orders for one in self.waves])

    @cached_property
    def alone(self):
        """{body: `Answers`}"""
        return {body: answers(body, modes, self.waves) for body, modes in self.modes.items()}

    @cached_property
    def each(self):
        """[`Response`] of every body, with partial waves exp(imθ) in axes of the scene"""
        few = {body: self._response(body, one) for body, one in self.alone.items()}
        places = zip(self.bodies.bodies, self.bodies.places, strict=True)
        return [few[body].turned(np.exp(1j * self.orders * place.heading)) for body, place in places]

    def _response(self, body, one):
        """`Response` by the singular vectors of what matters at the nearest circle, to `RANK` of the tolerance"""
        from scipy.linalg import block_diag

        size, found = self._size(body), []
        for own in one.members:
            T, E = size[own, None] * one.scattered[np.ix_(own, own)] * size[own], one.pressed[:, own] * size[own]
            strength = np.linalg.norm(E, axis=1, keepdims=True)
            E = np.linalg.norm(T) * E / np.where(strength > 1e-9 * strength.max(), strength, np.inf)
            found.append(np.linalg.svd(np.vstack([T, E]), full_matrices=False)[1:])
        least, few, back = RANK * self.bodies.tolerance * max(sigma[0] for sigma, _ in found), [], []
        for own, (sigma, rows) in zip(one.members, found, strict=True):
            for row in rows[sigma > least]:
                few.append(np.zeros(len(size), complex))
                few[-1][own] = row / size[own]
                back.append(np.zeros(len(size), complex))
                back[-1][own] = row.conj() * size[own]
        back = np.array(back).T
        into, out = (block_diag(*(turn(wave.orders) for wave in self.waves)) for turn in (to_real, to_complex))
        return Response(np.array(few) @ into, out @ (one.scattered @ back), one.pressed @ back, out @ one.sent)

    def _size(self, body):
        """Size of the regular waves about a body's axis as they come from the edge of the nearest circle, or as plane
        waves bring them; shape (q,)

        What a body sends begins on its hull, which its circle touches, and not at its axis: where circles are near each
        other high orders arrive nearly as large as low ones.
        """
        own, a, out = [one is body for one in self.bodies.bodies], body.plan.reach, []
        for wave in self.waves:
            one = wave.outgoing(a, a + self.bodies.clear[own].min())
            if wave.kind == "radiating":
                one = np.maximum(one, 1 / wave.size(a))
            out += [one, one[1:]]
        out = np.concatenate(out)
        if out.max() < 1e-100:  # nothing arrives, and all waves may count alike
            return np.ones(len(out))
        return np.maximum(out / out.max(), 1e-12)

    @cached_property
    def first(self):
        """[slice] of the numbers y of each body"""
        return slices(np.cumsum([0, *(len(one.few) for one in self.each)]))

    def pairs(self):
        """Return ((i, j), S) of all pairs: S [(q, q)] of each mode gives waves about i that j sends, or None if no wave
        arrives

        Pairs of equal bodies at equal distance and direction are consecutive and share one matrix S.
        """
        alike = {}
        for i, j in product(range(len(self.each)), repeat=2):
            there = complex(np.round(self.bodies.axes[i] - self.bodies.axes[j], 9))
            if i != j:
                alike.setdefault((there, self.bodies.radii[i], self.bodies.radii[j]), []).append((i, j))
        for (there, a, b), found in alike.items():
            clear = abs(there) - a - b
            seen = [
                one.seen_from(there, b, a) if one.kind != "decaying" or one.k * clear < GONE else None
                for one in self.waves
            ]
            yield from ((pair, seen) for pair in found)

    @cached_property
    def equations(self):
        """Factors of I − Q S T, and the matrix Q S R, (y, 6N)"""
        from scipy.linalg import lu_factor

        count, last, known = self.first[-1].stop, None, {}
        matrix, sent = np.eye(count, dtype=complex), np.zeros((count, 6 * len(self.each)), complex)
        for (i, j), seen in self.pairs():
            if seen is not last:
                last, known = seen, {}
            kind = tuple((self.bodies.bodies[n], self.bodies.places[n].heading) for n in (i, j))
            if kind not in known:
                one, other = self.each[i], self.each[j]
                known[kind] = one.few @ self._arriving(seen, np.hstack([other.scattered, other.sent]))
            passed, of_motion = np.split(known[kind], [-6], axis=1)
            matrix[self.first[i], self.first[j]] = -passed
            sent[self.first[i], 6 * j : 6 * j + 6] = of_motion
        return lu_factor(matrix, check_finite=False), sent

    def _arriving(self, seen, sent):
        """S times the waves that are sent; shape (q, ·)"""
        parts = zip(seen, self.parts, strict=True)
        return np.vstack([np.zeros_like(sent[part]) if S is None else S @ sent[part] for S, part in parts])

    @cached_property
    def moved(self):
        """Unknowns y for unit velocities about the axes; shape (y, 6N)"""
        return self._solved(self.equations[1])

    def diffracted(self, headings):
        """Unknowns y for plane waves of unit amplitude, including the waves from all other bodies; shape (y, m)"""
        incident = self.incident(headings)
        return self._solved(np.vstack([one.few @ wave for one, wave in zip(self.each, incident, strict=True)]))

    def _solved(self, right):
        from scipy.linalg import lu_solve

        return lu_solve(self.equations[0], right, check_finite=False)

    @cached_property
    def radiation(self):
        """Integrals ∬ φⱼ nᵢ dS, about the vertical axis and along the axes of each body; shape (6N, 6N)"""
        from scipy.linalg import block_diag

        return block_diag(*(self.alone[body].radiation for body in self.bodies.bodies)) + self.pressed(self.moved)

    def pressed(self, y):
        """Integrals ∬ φ nᵢ dS of y (·, ·); shape (6N, ·)"""
        return np.vstack([one.pressed @ y[at] for one, at in zip(self.each, self.first, strict=True)])

    def incident(self, headings):
        """Regular waves of plane waves of unit amplitude; shape (N, q, m)"""
        beta, one = np.atleast_1d(np.asarray(headings, float)), self.waves[0]
        m, out = one.orders, np.zeros((len(self.each), len(self.orders), len(beta)), complex)
        turn = 1j ** np.abs(m)[:, None] * np.exp(-1j * np.outer(m, beta)) * -1j * self.gravity / self.omega
        for i, (at, a) in enumerate(zip(self.bodies.axes, self.bodies.radii, strict=True)):
            phase = np.exp(1j * self.k * (at * np.exp(-1j * beta)).real)
            out[i, self.parts[0]] = turn * phase / one.size(a)[np.abs(m)][:, None]
        return out

    def sent(self, y, velocity):
        """Outgoing waves of the unknowns y and of velocities (6N, ·) about the axes; shape (N, q, ·)"""
        own = np.split(velocity, len(self.each))
        each = zip(self.each, self.first, own, strict=True)
        return np.stack([one.scattered @ y[at] + one.sent @ v for one, at, v in each])

    def drift_of_each(self, headings, motions, density):
        """Mean force along x and y of the scene, and moment about the axis of each body, N/m², N m/m²; shape (m, N, 3)

        motions : motions about the origin, m and rad per metre of each wave, (m, 6N)
        """
        with blas_threads(SMALL):
            velocity = (-1j * self.omega * motions @ self.bodies.to_scene).T
            sent = self.sent(self.diffracted(headings) + self.moved @ velocity, velocity)
            regular = self.incident(headings)
            for (i, j), seen in self.pairs():
                regular[i] += self._arriving(seen, sent[j])
        modes = next(iter(self.modes.values()))
        norms = [modes.wave_norm, *modes.norms[: len(self.waves) - 1]]
        parts = zip(self.bodies.radii, regular, sent, strict=True)
        return np.stack([mean_force(self.waves, norms, a, *both, density) for a, *both in parts], axis=1)

    def first_order(self, headings, theta, density):
        """`FirstOrder` with motions about the origin"""
        headings, theta = (np.atleast_1d(np.asarray(a, float)) for a in (headings, theta))
        with blas_threads(SMALL):
            T, omega, d = self.bodies.to_scene, self.omega, 6 * len(self.each)
            radiation = -density * T @ self.radiation @ T.T
            y = self.diffracted(headings)
            excitation = -1j * density * omega * (T @ self.pressed(y)).T
            known = self.bodies.froude_krylov(omega, headings, None, density, self.gravity)
            velocity = np.eye(d, d + len(headings))
            sent = self.sent(np.hstack([self.moved, y]), velocity)
            haskind = self._haskind(sent[..., :d], headings, density) @ T.T
            far = self._kochin(sent, theta)
            kochin = -1j * omega * (T @ far[:, :d])
            residual = max(one.residual for one in self.alone.values())
            if not (residual < 1e-6 and np.all(np.isfinite(radiation)) and np.all(np.isfinite(excitation))):
                raise FloatingPointError(
                    f"ω = {omega:.6g} rad/s: the equations of the bodies leave a residual of {residual:.1e}, or "
                    "are not finite"
                )
        return FirstOrder(radiation, known, excitation - known, haskind, kochin, far[:, d:], residual)

    def _kochin(self, sent, theta):
        """H and H′ of what is sent (N, q, columns), (2, columns, t)"""
        one, total = self.waves[0], 0.0
        m, parts = one.orders, sent[:, self.parts[0]]
        c, s = np.cos(theta), np.sin(theta)
        for at, a, part in zip(self.bodies.axes, self.bodies.radii, parts, strict=True):
            turn = (-1j) ** np.abs(m) / one.size(a)[np.abs(m)]
            wave = np.exp(1j * np.outer(m, theta) - 1j * self.k * (at.real * c + at.imag * s))
            slope = 1j * (m[:, None] - self.k * (at.imag * c - at.real * s)) * wave
            part = (part * turn[:, None]).T
            total = total + np.stack([part @ wave, part @ slope])
        return 1j * self.omega / self.gravity * total

    def _haskind(self, sent, headings, density):
        """Excitation −4ρgnω/k² H(β + π), by Haskind's relation, from the waves that unit velocities send; shape (m,
        6N)"""
        beta = np.atleast_1d(np.asarray(headings, float))
        if not len(beta):
            return np.zeros((0, sent.shape[-1]), complex)
        back = self._kochin(sent, beta + np.pi)[0]
        n = float(group_factor(self.k, self.bodies.depth))
        return (-4 * density * self.gravity * n * self.omega / self.k**2 * back).T


def slices(ends):
    """[slice] between consecutive ends"""
    return [slice(int(a), int(b)) for a, b in pairwise(ends)]
