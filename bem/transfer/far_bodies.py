"""Bodies far from each other: each shape is solved once a frequency, and coupled by partial waves.

With T what a body scatters of regular waves, R what its motions send, E the forces of waves and S what others see of
what one sends (`partial_waves`),

    a = S (T a + T a₀ + R v),    b = T (a + a₀) + R v,    force = E (a + a₀) + Z v

a, b regular and outgoing waves of all bodies, a₀ the plane wave, v the motions: Kagemoto & Yue, J. Fluid Mech. 166
(1986).  It is exact where no body reaches into the circle around another, and takes the more orders the nearer it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..contour.several.bodies import SeveralBodies, nearest
from ..contour.solver import SMALL, prepare_box, prepare_cylinder
from ..depth_modes.gap import OuterModes
from ..first_order import FirstOrder
from ..kernels.threads import blas_threads
from ..waves import group_factor
from .circles import overlapping
from .contour_shape import answers
from .drift import mean_force
from .partial_waves import PartialWaves, highest_order, to_complex, to_real

LEAST_ORDER, MOST_ORDERS = 2, 60
SHARE = 0.3  # of the tolerance, that orders and modes left out may take


def prepare_far(shapes, places, depth, tolerance=1e-3):
    """`FarBodies`; arguments as of `contour.several.bodies.prepare_several`

    Raises ValueError as `solver.prepare_box`, and for bodies whose circles overlap.
    """
    makers, known = {"box": prepare_box, "buoy": prepare_cylinder}, {}
    for shape, sizes in shapes:
        if (shape, sizes) not in known:
            known[shape, sizes] = makers[shape](*sizes, depth, tolerance)
    bodies = [known[one] for one in shapes]
    found = overlapping([place.x + 1j * place.y for place in places], [body.plan.reach for body in bodies])
    if found:
        raise ValueError(
            f"the circles around bodies {found[0] + 1} and {found[1] + 1} overlap by {found[2]:.3g} m; allowed by "
            "transfer matrices: circles apart; take contours or panels"
        )
    gaps = nearest([body.plan for body in bodies], places)
    return FarBodies(tuple(bodies), tuple(places), tuple(gaps))


@dataclass(frozen=True, eq=False)
class FarBodies(SeveralBodies):
    """Several `bem.contour.solver.ContourBody`, equal ones the same object; the rest as of `SeveralBodies`"""

    def first_order(self, omega, headings=(), theta=(), dofs=None, density=1025.0, gravity=9.80665):
        """`FirstOrder` at one frequency, motions (6N,) about the origin, body by body; as `SeveralBodies.first_order`"""
        return self.at(omega, gravity).first_order(headings, theta, density)

    def at(self, omega, gravity=9.80665):
        """`Coupled` at one frequency; the last one is kept"""
        if not 0 < omega < np.inf:
            raise ValueError(f"omega is {omega} rad/s; allowed: positive and finite (limits: added_mass_limit)")
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
        return FarBodies(self._each(better), self.places, self.gaps)

    def _each(self, better):
        made = {body: better(body) for body in self.alone}
        return tuple(made[body] for body in self.bodies)

    @cached_property
    def alone(self):
        """The bodies that differ"""
        return tuple(dict.fromkeys(self.bodies))

    def resolution(self, omega, gravity=9.80665):
        """As of `solver.ContourBody`"""
        return tuple(body.resolution(omega, gravity) for body in self.alone)

    @cached_property
    def axes(self):
        """(N,) complex m"""
        return np.array([place.x + 1j * place.y for place in self.places])

    @cached_property
    def radii(self):
        """(N,) m, of the circles around the bodies"""
        return np.array([body.plan.reach for body in self.bodies])

    @cached_property
    def apart(self):
        """m, (N, N) between axes, ∞ of one body"""
        return np.where(np.eye(len(self.axes), dtype=bool), np.inf, np.abs(self.axes[:, None] - self.axes))

    def waves(self, kind, modes):
        """[`PartialWaves`] that get from one body to another"""
        tolerance, nearest_axis = SHARE * self.tolerance, self.apart.min(axis=1)

        def of(kind, k):
            each = zip(self.radii, nearest_axis, self.gaps, strict=True)
            orders = (highest_order(kind, float(k), *one, tolerance, MOST_ORDERS) for one in each)
            return PartialWaves(kind, float(k), max(LEAST_ORDER, *orders))

        kappa = modes.wavenumbers
        count = max(1, int(np.sum(np.exp(-2 * kappa * min(self.gaps)) > tolerance)))
        first = [] if kind == "decaying" else [of(kind, modes.k)]
        return [*first, *(of("decaying", k) for k in kappa[:count])]


class Coupled:
    """Bodies coupled at one frequency, or in a limit of it.

    modes : {body: `OuterModes`}; kind : of the first partial waves
    """

    def __init__(self, bodies, modes, kind, omega, gravity):
        self.bodies, self.modes, self.omega, self.gravity = bodies, modes, omega, gravity
        self.k = next(iter(modes.values())).k
        self.waves = bodies.waves(kind, next(iter(modes.values())))
        ends = np.cumsum([0, *(2 * one.last + 1 for one in self.waves)])
        self.parts, self.count = [slice(*pair) for pair in pairwise(ends)], int(ends[-1])

    @cached_property
    def alone(self):
        """{body: `Answers`, in exp(imθ) of its own axes}"""
        from scipy.linalg import block_diag

        into, back = (block_diag(*(turn(one.orders) for one in self.waves)) for turn in (to_real, to_complex))
        out = {}
        for body, modes in self.modes.items():
            one = answers(body, modes, self.waves)
            out[body] = one._replace(sent=back @ one.sent, scattered=back @ one.scattered @ into,
                                     pressed=one.pressed @ into)  # fmt: skip
        return out

    @cached_property
    def each(self):
        """[`Answers`] of all, partial waves in axes of the scene"""
        out, orders = [], np.concatenate([one.orders for one in self.waves])
        for body, place in zip(self.bodies.bodies, self.bodies.places, strict=True):
            one, turn = self.alone[body], np.exp(1j * orders * place.heading)
            out.append(one._replace(sent=one.sent / turn[:, None], pressed=one.pressed * turn,
                                    scattered=one.scattered * turn / turn[:, None]))  # fmt: skip
        return out

    @cached_property
    def seen(self):
        """(N, q, N, q) S"""
        axes, radii, known = self.bodies.axes, self.bodies.radii, {}
        n = len(axes)
        out = np.zeros((n, self.count, n, self.count), complex)
        for one, part in zip(self.waves, self.parts, strict=True):
            for i in range(n):
                for j in range(n):
                    there = axes[i] - axes[j]
                    if i == j or one.kind == "decaying" and one.k * (abs(there) - radii[i] - radii[j]) > 40:
                        continue
                    key = one, complex(np.round(there, 9)), radii[i], radii[j]
                    if key not in known:
                        known[key] = one.seen_from(there, radii[j], radii[i])
                    out[i, part, j, part] = known[key]
        return out

    @cached_property
    def answer(self):
        """(Nq, 6N) a of unit velocities, and the factored I − S T"""
        from scipy.linalg import lu_factor, lu_solve

        n, q = len(self.each), self.count
        matrix, sent = np.empty((n, q, n, q), complex), np.empty((n, q, n, 6), complex)
        for j, one in enumerate(self.each):
            matrix[:, :, j] = -self.seen[:, :, j] @ one.scattered
            sent[:, :, j] = self.seen[:, :, j] @ one.sent
        matrix = matrix.reshape(n * q, n * q)
        matrix[np.diag_indices(n * q)] += 1
        factors = lu_factor(matrix, check_finite=False)
        return lu_solve(factors, sent.reshape(n * q, -1), check_finite=False), factors

    @cached_property
    def radiation(self):
        """(6N, 6N) ∬ φⱼ nᵢ dS about the axes, in own axes"""
        from scipy.linalg import block_diag

        alone = block_diag(*(one.radiation for one in self.each))
        return alone + self.pressed @ self.answer[0]

    @cached_property
    def pressed(self):
        """(6N, Nq) forces of regular waves"""
        from scipy.linalg import block_diag

        return block_diag(*(one.pressed for one in self.each))

    def incident(self, headings):
        """(Nq, m) regular waves of plane waves of unit amplitude"""
        beta, one, out = np.atleast_1d(np.asarray(headings, float)), self.waves[0], []
        m = one.orders
        for at, a in zip(self.bodies.axes, self.bodies.radii, strict=True):
            phase = np.exp(1j * self.k * (at * np.exp(-1j * beta)).real) * -1j * self.gravity / self.omega
            wave = np.zeros((self.count, len(beta)), complex)
            turn = 1j ** np.abs(m) / one.size(a)[np.abs(m)]
            wave[self.parts[0]] = turn[:, None] * np.exp(-1j * np.outer(m, beta)) * phase
            out.append(wave)
        return np.vstack(out)

    def diffracted(self, headings):
        """(Nq, m) regular waves about the bodies in plane waves of unit amplitude, those of all others among them"""
        from scipy.linalg import lu_solve

        wave = self.incident(headings)
        scattered = self.scattered(wave)
        return wave + lu_solve(self.answer[1], self._seen(scattered), check_finite=False)

    def _seen(self, sent):
        n = len(self.each) * self.count
        return self.seen.reshape(n, n) @ sent

    def scattered(self, regular):
        """(Nq, ·) what bodies scatter of regular waves"""
        n, q = len(self.each), self.count
        parts = regular.reshape(n, q, -1)
        return np.vstack([one.scattered @ part for one, part in zip(self.each, parts, strict=True)])

    def sent(self, headings):
        """(Nq, 6N + m) what bodies send of unit velocities, about axes, and in plane waves"""
        from scipy.linalg import block_diag

        moved = block_diag(*(one.sent for one in self.each)) + self.scattered(self.answer[0])
        return np.hstack([moved, self.scattered(self.diffracted(headings))])

    def drift_of_each(self, headings, motions, density):
        """(m, N, 3) N/m², N m/m² mean force along x and y of the scene and moment about each axis

        motions : (m, 6N) m, rad about the origin, per metre of each wave
        """
        N, q = len(self.each), self.count
        with blas_threads(SMALL):
            velocity = (-1j * self.omega * motions @ self.bodies.to_scene).T
            regular = self.diffracted(headings) + self.answer[0] @ velocity
            own = (one.sent @ v for one, v in zip(self.each, np.split(velocity, N), strict=True))
            sent = self.scattered(regular) + np.vstack(list(own))
        modes = next(iter(self.modes.values()))
        norms = [modes.wave_norm, *modes.norms[: len(self.waves) - 1]]
        parts = zip(self.bodies.radii, regular.reshape(N, q, -1), sent.reshape(N, q, -1), strict=True)
        return np.stack([mean_force(self.waves, norms, a, *both, density) for a, *both in parts], axis=1)

    def first_order(self, headings, theta, density):
        """`FirstOrder`, about the origin"""
        headings, theta = (np.atleast_1d(np.asarray(a, float)) for a in (headings, theta))
        with blas_threads(SMALL):
            T, omega, d = self.bodies.to_scene, self.omega, 6 * len(self.each)
            radiation = -density * T @ self.radiation @ T.T
            excitation = -1j * density * omega * (T @ (self.pressed @ self.diffracted(headings))).T
            known = self.bodies.froude_krylov(omega, headings, None, density, self.gravity)
            sent = self.sent(headings)
            haskind = self._haskind(sent[:, :d], headings, density) @ T.T
            far = self._kochin(sent, theta)
            kochin = -1j * omega * np.einsum("ij,pjt->pit", T, far[:, :d])
            residual = max(one.residual for one in self.each)
        return FirstOrder(radiation, known, excitation - known, haskind, kochin, far[:, d:], residual)

    def _kochin(self, sent, theta):
        """H and H′ of columns of `sent`, (2, columns, t)"""
        one, n, total = self.waves[0], len(self.each), 0.0
        m = one.orders
        parts = sent.reshape(n, self.count, -1)[:, self.parts[0]]
        c, s = np.cos(theta), np.sin(theta)
        for at, a, part in zip(self.bodies.axes, self.bodies.radii, parts, strict=True):
            turn = (-1j) ** np.abs(m) / one.size(a)[np.abs(m)]
            wave = np.exp(1j * np.outer(m, theta) - 1j * self.k * (at.real * c + at.imag * s))
            slope = 1j * (m[:, None] - self.k * (at.imag * c - at.real * s)) * wave
            total = total + np.stack([(part * turn[:, None]).T @ wave, (part * turn[:, None]).T @ slope])
        return 1j * self.omega / self.gravity * total

    def _haskind(self, sent, headings, density):
        """(m, 6N) excitation −4ρgnω/k² H(β + π) from what unit velocities send, by Haskind's relation"""
        beta = np.atleast_1d(np.asarray(headings, float))
        if not len(beta):
            return np.zeros((0, sent.shape[1]), complex)
        back = self._kochin(sent, beta + np.pi)[0]
        n = float(group_factor(self.k, self.bodies.depth))
        return (-4 * density * self.gravity * n * self.omega / self.k**2 * back).T
