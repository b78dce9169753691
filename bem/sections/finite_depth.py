"""Waves past a rectangle, beam B and draft d, in two dimensions: matched eigenfunctions over finite depth.

With b = B/2 the flow over y > 0 is symmetric (heave) or antisymmetric (sway, roll).  u(ζ) is the velocity through
the line under the keel's edge, v(z) that of the side, both along y:

    outside   φ = φ₀ + Σ Rₙ Zₙ e^(−kₙ(y−b)) ⟨u + v, Zₙ⟩ / ⟨Zₙ, Zₙ⟩,        R₀ = 1/ik,  Rₙ = −1/kₙ
    beneath   φ = ψ + c + Σ T_q f_q(y) cos l_qζ ⟨u, cos l_qζ⟩ ε_q / s

f_q = cosh l_qy / cosh l_qb, T_q = coth(l_qb) / l_q or sinh l_qy / sinh l_qb, T_q = tanh(l_qb) / l_q; the mean q = 0
has T₀ = b in antisymmetric flow; in symmetric flow it is the free constant c, and the net outflow is given.  ψ has
the velocity 1 or y of the bottom at the keel, no velocity at the bed, and at y = b a uniform outflow or none:

    heave  (ζ² − y² + b²) / 2s − s/6        roll  Σ aₘ sin μₘy cosh μₘζ / cosh μₘs        sway, fixed  0

μₘ = (m − ½)π/b, aₘ = 2 (−1)^(m+1) coth(μₘs) / bμₘ³, m = 1 …  By Green's theorem ⟨ψ(b, ζ), u⟩ is then half of the
integral ∫ φ dy or ∫ yφ dy over the bottom for the flow of u under a fixed keel, and no term of roll grows with the
gap.  (With ψ = (yζ² − y³/3) / 2s, whose outflow is up to s/2, energy was conserved to 1e-12 in water thirty drafts
deep.)

In oblique waves all quantities vary as exp(iκx) along the body, κ = k sinθ. In R, T and f √(kₙ² + κ²) and √(l_q² +
κ²) replace kₙ and l_q, and R₀ = 1/ik cosθ. There is no free constant: the mean q = 0 is a mode like the other modes,
with l₀ = κ, and ψ of heave is cosh κζ / κ sinh κs. In roll λₘ = √(μₘ² + κ²) replaces μₘ in cosh and coth, and aₘ = 2
(−1)^(m+1) coth(λₘs) / bμₘ²λₘ.

Galerkin's method makes the two potentials equal at the gap when tested with every function of `bem.depth_modes.gap`.
These functions are nearly dependent, so their orthonormal combinations in `gap_profiles` are used. Energy is then
conserved to 1e-12 in the highest gaps. With the functions themselves energy is conserved to 4e-10, a number that
changes with the number of threads.
Motions have unit velocity; y is to port, z up, roll from y to z about the origin; the time factor
is exp(−iωt). SR179 report (1982), section 2.1.3;
Garrett, Journal of Fluid Mechanics 46 (1971) for the method; Porter and Evans, in the same journal, 294 (1995), for the
functions of the gap.
"""

from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import spherical_jn

from ..depth_modes.gap import Gap, mode_sum
from ..depth_modes.gap_profiles import Profiles
from ..waves import depth_factor_slope, wavenumber

SWAY, HEAVE, ROLL = range(3)
SMALLEST = 1e-13  # eigenvalue of the profiles, below is rounding: 20 of 36 functions stay, coefficients within 1e-8


class Motion(NamedTuple):
    """A motion of unit velocity.

    side : velocity on the side, (a, b) of a + b z; keel : 1 if the motion moves the bottom up or turns it, otherwise 0
    outflow : outflow of ψ through the gap at y = b, m²/s; bottom : ∫ ψ dy (heave) or ∫ yψ dy (roll) over the bottom
    """

    side: tuple = (0.0, 0.0)
    keel: float = 0.0
    outflow: float = 0.0
    bottom: float = 0.0


FIXED = Motion()


class Beneath(NamedTuple):
    """Terms beneath the body for one parity, which do not depend on frequency.

    ratios : T_q, (q,); matrix : potential beneath of the functions of the gap, tested with these functions, (f, f)
    bottom : ∫ φ dy (heave) or ∫ yφ dy (roll) over the bottom for each function, (f,)
    """

    ratios: np.ndarray
    matrix: np.ndarray
    bottom: np.ndarray


class Shape(NamedTuple):
    """Data of a shape: gap, profiles in terms of functions, (p, f), half beam b, inner modes, motions, and `Beneath`
    for antisymmetric and symmetric flow"""

    gap: Gap
    profiles: np.ndarray
    half: float
    modes: object
    motions: tuple
    beneath: tuple


class SectionFlow(NamedTuple):
    """A solved flow: u, (f,), c, the motion, and the factor `incident` of φ₀ = incident · Z₀"""

    velocity: np.ndarray
    constant: complex
    motion: Motion
    incident: complex


@lru_cache(maxsize=64)
def shape(beam, draft, depth, terms, modes, along=0.0):
    """`Shape` with 3 · `terms` functions in the gap and `modes` modes per smallest length; along : κ, rad/m"""
    b = beam / 2
    gap, inner, profiles = _gap(beam, draft, depth, terms, modes)
    s = gap.height
    heave = Motion(keel=1.0, outflow=-b, bottom=2 * b * (s + b * b / s) / 3)
    if along:
        heave = Motion(keel=1.0, bottom=2 * b / (along * np.tanh(along * s)))
    mu, a = _roll_series(b, s, along)
    roll = Motion((0.0, -1.0), keel=1.0, bottom=2 * np.abs(a) @ mu**-2.0)
    motions = (Motion(side=(1.0, 0.0)), heave, roll)
    beneath = tuple(_beneath(gap, b, inner, symmetric, along) for symmetric in (False, True))
    return Shape(gap, profiles, b, inner, motions, beneath)


@lru_cache(maxsize=64)
def _gap(beam, draft, depth, terms, modes):
    """`Gap`, its modes beneath the body, and its profiles (p, f) of functions"""
    gap = Gap(draft, depth, terms)
    return gap, gap.inner_modes(gap.inner_count(modes, beam / 2)), Profiles(gap, SMALLEST).combinations[:-2, :-2]


@lru_cache(maxsize=256)
def _outer(gap, k, omega, modes, gravity):
    """Modes outside at ω, the same for waves at any angle"""
    return gap.outer_modes(omega, gap.mode_count(k, modes), gravity)


def _roll_series(b, s, along=0.0, count=1000):
    """μₘ (m,) rad/m and aₘ (m,) of ψ in roll; its sums over the bottom, of m^(−5), leave 1e-14 of themselves"""
    mu = (np.arange(count) + 0.5) * np.pi / b
    rate = np.hypot(mu, along)
    return mu, 2 * (-1.0) ** np.arange(count) / (b * mu**2 * rate * np.tanh(rate * s))


def _beneath(gap, b, inner, symmetric, along):
    ratios, over_bottom = _under(np.hypot(inner.wavenumbers, along), b, symmetric)
    rows = np.vstack([inner.rows[:-2], over_bottom * np.cos(inner.wavenumbers * gap.height)])
    matrix = mode_sum(rows, np.append(gap.decays, 1.0), 2 / gap.height * ratios)
    if along:
        ratio, over_bottom = _under(along, b, symmetric)
        mean = np.append(gap.mean, over_bottom)
        matrix += ratio / gap.height * np.outer(mean, mean)
    elif not symmetric:
        mean = np.append(gap.mean, 2 * b * b / 3)  # the last is the mean of y/b times y
        matrix += b / gap.height * np.outer(mean, mean)
    return Beneath(ratios, matrix[:-1, :-1], matrix[-1, :-1])


def _under(l, b, symmetric):
    """T of modes with rates l, and ∫ f dy or ∫ yf dy over the bottom"""
    tanh = np.tanh(l * b)
    return (1 / tanh / l, 2 * tanh / l) if symmetric else (tanh / l, 2 * (b / tanh - 1 / l) / l)


class FiniteDepthFlow:
    """The three radiated flows and the diffracted flows at one frequency.

    beam, draft, depth : m; omega : rad/s; gravity : m/s²; terms, modes : see `shape`; sine : sine of the angle θ of
        the waves with the normal; Haskind's integrals are for flows that do not vary along the body
    """

    along = 0.0  # κ

    def __init__(self, beam, draft, depth, omega, gravity, terms, modes, sine=0.0):
        self.along = float(wavenumber(omega, depth, gravity)) * sine
        self.shape = shape(beam, draft, depth, terms, modes, self.along)
        self.beam, self.draft, self.depth = beam, draft, depth
        self.omega, self.gravity = omega, gravity
        gap = self.shape.gap
        self.k = float(wavenumber(omega, depth, gravity))
        self.across = self.k * np.sqrt(1 - sine**2)
        self.modes = _outer(gap, self.k, omega, modes, gravity)
        self.outside, self.wave_rows = self._outside()
        self.radiated = tuple(self._flow(i == HEAVE, motion) for i, motion in enumerate(self.shape.motions))

    def _outside(self):
        """Outer potential tested with the rows: functions, then 1, z and Z₀ on the side; (f + 3, f + 3), (f + 3,)"""
        gap, modes = self.shape.gap, self.modes
        with_wave, with_others = gap.side_wave_moments(self.k, modes.wavenumbers)
        rows, wave_rows = np.vstack([modes.rows, with_others]), np.append(modes.wave_rows, with_wave)
        rates = np.hypot(modes.wavenumbers, self.along)
        local = mode_sum(rows, np.append(gap.outer_decays, 1.0), -1 / (rates * modes.norms))
        return local + np.outer(wave_rows, wave_rows) / (1j * self.across * modes.wave_norm), wave_rows

    def _flow(self, symmetric, motion=FIXED, incident=0.0):
        beneath, profiles = self.shape.beneath[symmetric], self.shape.profiles
        f = len(beneath.bottom)
        matrix = profiles @ (beneath.matrix - self.outside[:f, :f]) @ profiles.T
        right = self.outside[:f, f : f + 2] @ motion.side + incident * self.wave_rows[:f]
        right = profiles @ (right - motion.keel / 2 * beneath.bottom)
        if not symmetric or self.along:
            return SectionFlow(np.linalg.solve(matrix, right) @ profiles, 0.0, motion, incident)
        mean = profiles @ self.shape.gap.mean
        bordered = np.block([[matrix, mean[:, None]], [mean[None], np.zeros((1, 1))]])
        solution = np.linalg.solve(bordered, np.append(right, motion.outflow))
        return SectionFlow(solution[:-1] @ profiles, solution[-1], motion, incident)

    @cached_property
    def diffracted(self):
        """Flows of the antisymmetric and of the symmetric part of a unit wave towards +y past the fixed body"""
        incident = -1j * self.gravity / self.omega * np.exp(-1j * self.across * self.shape.half)
        return self._flow(False, incident=-incident), self._flow(True, incident=incident)

    @property
    def wave_exciting(self):
        """∮ (φ_I + φ_D) n dl of sway, heave, roll on the fixed body in a unit wave towards +y; shape (3,)"""
        odd, even = self.diffracted
        return np.array([self.force(odd, SWAY), self.force(even, HEAVE), self.force(odd, ROLL)])

    def force(self, flow, mode):
        """∮ φ n dl along `mode` over the whole contour, n out of the body"""
        motion = self.shape.motions[mode]
        side = motion.side @ self._side(flow)[:2]
        return 2 * side - (0.0 if mode == SWAY else self._bottom(flow, mode == HEAVE))

    def _side(self, flow):
        """∫ φ · {1, z, Z₀} dz over the side y = b, (3,)"""
        f = len(flow.velocity)
        velocity = np.concatenate([flow.velocity, flow.motion.side])
        return self.outside[f:, : f + 2] @ velocity + flow.incident * self.wave_rows[f:]

    def _bottom(self, flow, symmetric):
        """∫ φ dy or ∫ yφ dy over the bottom"""
        of_gap = self.shape.beneath[symmetric].bottom @ flow.velocity
        return of_gap + flow.motion.bottom + 2 * self.shape.half * flow.constant

    def radiated_wave(self, mode):
        """Potential at z = 0 of the wave that `mode` radiates towards y → ∞, referred to y = 0"""
        return self.sent(self.radiated[mode])

    def sent(self, flow):
        """Potential at z = 0 of the wave of a `SectionFlow` towards y → ∞, referred to y = 0"""
        f = len(flow.velocity)
        velocity = self.wave_rows[: f + 2] @ np.concatenate([flow.velocity, flow.motion.side])
        return velocity / (1j * self.across * self.modes.wave_norm) * np.exp(-1j * self.across * self.shape.half)

    def reflection_transmission(self):
        """Complex R and T of the fixed body for a wave towards +y, both referred to y = 0"""
        amplitude = -1j * self.gravity / self.omega
        odd, even = (self.sent(flow) / amplitude for flow in self.diffracted)
        back = np.exp(-2j * self.across * self.shape.half)  # reflection of the incident wave by the wall y = b
        return back + even - odd, even + odd

    def haskind_integral(self, sines):
        """∮ φⱼ ∂φ_I/∂n dl of the three radiated flows for φ_I = −(ig/ω) Z₀ exp(iky sinβ); shape (m, 3)

        sines : sinβ of the waves, (m,)"""
        b, d, h, k = self.shape.half, self.shape.gap.draft, self.shape.gap.depth, self.k
        kappa = k * np.asarray(sines, float)
        side = np.array([self._side(flow)[2] for flow in self.radiated])
        keel = depth_factor_slope(-d, k, h)
        bottom = self._bottom_haskind(kappa)
        x = kappa[:, None] * b
        both_sides = 2j * kappa[:, None] * np.where([False, True, False], 1j * np.sin(x), np.cos(x))
        return -1j * self.gravity / self.omega * (both_sides * side - keel * bottom)

    def _bottom_haskind(self, kappa):
        """∫ φⱼ exp(iκy) dy over the bottom of the three radiated flows, (κ, 3)"""
        gap, b, l = self.shape.gap, self.shape.half, self.shape.modes.wavenumbers
        out = np.empty((len(kappa), 3), complex)
        c, s = np.cos(kappa * b)[:, None], np.sin(kappa * b)[:, None]
        tanh, kp = np.tanh(l * b), kappa[:, None]
        over_bottom = (
            2j * (l / tanh * s - kp * c) / (l**2 + kp**2),  # ∫ sinh ly / sinh lb exp(iκy) dy
            2 * (l * tanh * c + kp * s) / (l**2 + kp**2),
        )
        one, y, y2 = _moments_over_bottom(kappa * b, b)
        even = (gap.height / 3 + b * b / (2 * gap.height)) * one - y2 / (2 * gap.height)
        own = (0 * one, even, _roll_moment_over_bottom(kappa, b, gap.height))
        for mode, flow in enumerate(self.radiated):
            symmetric = mode == HEAVE
            rows = np.vstack([self.shape.modes.rows[:-2], over_bottom[symmetric] * np.cos(l * gap.height)])
            decays = np.append(gap.decays, np.ones(len(kappa)))
            f = len(gap.decays)
            products = mode_sum(rows, decays, 2 / gap.height * self.shape.beneath[symmetric].ratios)[f:, :f]
            mean = one * flow.constant if symmetric else y * (gap.mean @ flow.velocity) / gap.height
            out[:, mode] = products @ flow.velocity + mean + own[mode]
        return out


def _roll_moment_over_bottom(kappa, b, s):
    """∫ ψ exp(iκy) dy of roll over the bottom, (κ,)"""
    mu, a = _roll_series(b, s)
    apart, together = (np.sinc((mu + sign * kappa[:, None]) * b / np.pi) for sign in (-1, 1))
    return 1j * b * (apart - together) @ a


def _moments_over_bottom(x, b):
    """∫ {1, y, y²} exp(ixy/b) dy over −b < y < b, from that of Legendre's polynomials, 2 iⁿ jₙ(x)"""
    j0, j1, j2 = (spherical_jn(n, x) for n in range(3))
    return 2 * b * j0, 2j * b**2 * j1, b**3 * (2 * j0 - 4 * j2) / 3
