"""Floating vertical circular cylinder in water of finite depth, exact by matched eigenfunctions.

    outside   Rₙ = Kₘ(kₙa) / kₙ Kₘ'(kₙa),  R₀ = Hₘ(ka) / k Hₘ'(ka);   beneath   T_q = Iₘ(l_q a) / l_q Iₘ'(l_q a)

in the two regions of `two_regions`, angular mode cos mθ, time factor exp(−iωt).  The disturbance far away
is η ~ √(2/πkr) exp(i(kr − π/4)) H(θ).  Garrett, J. Fluid Mech. 46 (1971); Yeung, Appl. Ocean Res. 3 (1981).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import h1vp, hankel1, ive, jvp, kve

from .gap_modes import Gap
from .two_regions import Motion, TwoRegions
from .water_waves import group_factor

SURGE, HEAVE, PITCH = range(3)


@dataclass(frozen=True)
class TruncatedCylinder:
    """Cylinder of `radius` and `draft` in water of `depth` at one frequency; rotations about the origin.

    radius, draft, depth : m, depth finite; omega : rad/s; density : kg/m³; gravity : m/s²
    terms : functions of the gap, the parameter of convergence
    modes : evanescent modes per smallest length of the geometry

    Relative error below 3e-7, and mostly 1e-8, while depth − draft is below 10 times the smaller of radius and draft;
    4e-6 at 30 to 100 times, where more functions help.  Drift loses digits for ka < 1e-3, where it is the small
    difference of large terms.
    """

    radius: float
    draft: float
    depth: float
    omega: float
    density: float = 1025.0
    gravity: float = 9.80665
    terms: int = 20
    modes: int = 60

    def __post_init__(self):
        if not self.radius > 0:
            raise ValueError(f"radius {self.radius} m: must be positive")
        _ = self.gap

    @cached_property
    def gap(self):
        return Gap(self.draft, self.depth, self.omega, self.radius, self.gravity, self.terms, self.modes)

    @property
    def k(self):
        """rad/m"""
        return self.gap.k

    @cached_property
    def orders(self):
        """Highest angular mode; the amplitudes fall faster than exponentially beyond m = ka."""
        x = self.k * self.radius
        return int(np.ceil(x + 6 * np.cbrt(x) + 8))

    def _motion(self, mode):
        a, s = self.radius, self.gap.height
        if mode == SURGE:
            return Motion(side=(1.0, 0.0))
        if mode == HEAVE:  # ψ = (ζ² − r²/2) / 2s
            return Motion(value=(-a * a / (4 * s), 1 / (2 * s)), slope=(-a / (2 * s), 0.0))
        # ψ = −(rζ² − r³/4) / 2s
        return Motion((0.0, 1.0), (a**3 / (8 * s), -a / (2 * s)), (3 * a * a / (8 * s), -1 / (2 * s)))

    def _bottom(self, mode):
        """∫ ψ ∂ψ/∂z r dr / a over the bottom"""
        a, s = self.radius, self.gap.height
        if mode == HEAVE:
            return a * (s * s / 2 - a * a / 8) / (2 * s)
        return a**3 * (s * s / 4 - a * a / 24) / (2 * s) if mode == PITCH else 0.0

    @staticmethod
    def _decaying(m, x):
        """x Kₘ'(x) / Kₘ(x)"""
        return -x * kve(abs(m - 1), x) / kve(m, x) - m

    @staticmethod
    def _growing(m, x):
        """x Iₘ'(x) / Iₘ(x)"""
        return x * ive(m + 1, x) / ive(m, x) + m

    def _regions(self, m):
        gap, a = self.gap, self.radius
        wave_ratio = hankel1(m, self.k * a) / (self.k * h1vp(m, self.k * a))
        outer, inner = a / self._decaying(m, gap.outer_wavenumbers * a), a / self._growing(m, gap.inner_wavenumbers * a)
        outside = gap.outside(wave_ratio, outer, 1 / (2 * a))
        return TwoRegions(gap, outside, gap.beneath(a / m if m else 0.0, inner, 1 / (2 * a)), symmetric=m == 0)

    @cached_property
    def _all_regions(self):
        return [self._regions(m) for m in range(self.orders + 1)]

    @cached_property
    def _radiated(self):
        """(regions, flow) of surge, heave, pitch"""
        regions = [self._all_regions[m] for m in (1, 0, 1)]
        return [(region, region.flow(self._motion(i))) for i, region in enumerate(regions)]

    @cached_property
    def _incident(self):
        """Cₘ of φ_I = Σ Cₘ Jₘ(kr) Z₀ cos m(θ − β) for unit amplitude, (orders + 1,)"""
        m = np.arange(self.orders + 1)
        return -1j * self.gravity / self.omega * np.where(m, 2, 1) * 1j**m

    @cached_property
    def _diffracted(self):
        """Flow of incident and diffracted wave past the fixed cylinder for every m"""
        x = self.k * self.radius
        drives = [2j * c / (np.pi * x * h1vp(m, x)) for m, c in enumerate(self._incident)]
        return [region.flow(drive=drive) for region, drive in zip(self._all_regions, drives, strict=True)]

    @cached_property
    def _impedance(self):
        """A + iB/ω of surge, heave, pitch, (3, 3)"""
        result = np.zeros((3, 3), complex)
        for i, j in ((SURGE, SURGE), (SURGE, PITCH), (PITCH, SURGE), (PITCH, PITCH), (HEAVE, HEAVE)):
            region, flow = self._radiated[j]
            bottom = self._bottom(i) if i == j else 0.0
            around = (2 if i == HEAVE else 1) * np.pi * self.radius
            result[i, j] = -self.density * around * region.pressure(flow, self._motion(i), bottom)
        return result

    def _six(self, three):
        """Six by six from surge, heave, pitch of a body of revolution"""
        full = np.zeros((6, 6))
        full[2, 2] = three[HEAVE, HEAVE]
        full[0, 0] = full[1, 1] = three[SURGE, SURGE]
        full[3, 3] = full[4, 4] = three[PITCH, PITCH]
        full[0, 4], full[4, 0] = three[SURGE, PITCH], three[PITCH, SURGE]
        full[1, 3], full[3, 1] = -three[SURGE, PITCH], -three[PITCH, SURGE]
        return full

    def added_mass(self):
        """(6, 6) kg, kg m, kg m²"""
        return self._six(self._impedance.real)

    def damping(self):
        """(6, 6) kg/s, kg m/s, kg m²/s"""
        return self._six(self._impedance.imag * self.omega)

    def excitation(self, beta):
        """Force per unit amplitude of the wave towards `beta` on the fixed cylinder, (6,) N/m and N m/m, complex."""
        values = []
        for i, m in ((SURGE, 1), (HEAVE, 0), (PITCH, 1)):
            around = (1 if m else 2) * np.pi * self.radius
            integral = self._all_regions[m].pressure(self._diffracted[m], self._motion(i))
            values.append(-1j * self.density * self.omega * around * integral)
        x, z, pitch = values
        c, s = np.cos(beta), np.sin(beta)
        return np.array([x * c, x * s, z, -pitch * s, pitch * c, 0.0])

    def _outgoing(self, m, velocity):
        """H of a propagating mode of given velocity at the side, in cos m(θ − β)"""
        b = velocity / (self.k * h1vp(m, self.k * self.radius))
        return 1j * self.omega / self.gravity * b * (-1j) ** m

    @cached_property
    def _scattered(self):
        """H of the diffracted wave in cos m(θ − β), (orders + 1,)"""
        x = self.k * self.radius
        pairs = zip(self._all_regions, self._diffracted, self._incident, strict=True)
        return np.array([self._outgoing(m, r.wave(f) - c * self.k * jvp(m, x)) for m, (r, f, c) in enumerate(pairs)])

    def _harmonics_diffraction(self, beta):
        """Coefficients of exp(imθ), m = −orders … orders, of H of the diffracted wave"""
        half = self._scattered / np.where(np.arange(self.orders + 1), 2, 1)
        m = np.arange(-self.orders, self.orders + 1)
        return half[np.abs(m)] * np.exp(-1j * m * beta)

    def _harmonics_radiation(self):
        """Coefficients of exp(imθ) of H per unit velocity in six degrees of freedom, (6, 2 orders + 1)"""
        x, z, pitch = (self._outgoing(m, r.wave(f)) for m, (r, f) in zip((1, 0, 1), self._radiated, strict=True))
        result = np.zeros((6, 2 * self.orders + 1), complex)
        o = self.orders
        result[2, o] = z
        for row, value in ((0, x), (4, pitch)):
            result[row, [o - 1, o + 1]] = value / 2
        for row, value in ((1, x), (3, -pitch)):  # sin θ
            result[row, [o - 1, o + 1]] = value * 0.5j, value * -0.5j
        return result

    def kochin_diffraction(self, beta, theta):
        """H(θ) of the diffracted wave per unit amplitude, same shape as `theta`, dimensionless."""
        return self._on(self._harmonics_diffraction(beta), theta)

    def kochin_radiation(self, theta):
        """H(θ) of the wave radiated per unit velocity, (6, t) s and s·m/m."""
        return self._on(self._harmonics_radiation(), theta)

    def _on(self, harmonics, theta):
        m = np.arange(-self.orders, self.orders + 1)
        return harmonics @ np.exp(1j * np.multiply.outer(m, np.asarray(theta, float)))

    def motions(self, beta, inertia, stiffness):
        """Complex amplitudes per unit wave amplitude of the freely floating cylinder, (6,); yaw is zero.

        inertia, stiffness : (6, 6) SI about the origin
        """
        w, used = self.omega, np.arange(5)
        matrix = -w * w * (inertia + self.added_mass()) - 1j * w * self.damping() + stiffness
        return np.append(np.linalg.solve(matrix[np.ix_(used, used)], self.excitation(beta)[used]), 0.0)

    def drift_fixed(self, beta):
        """Mean (Fx, Fy) on the fixed cylinder per amplitude squared, N/m²."""
        return self._drift(self._harmonics_diffraction(beta), beta)

    def drift_free(self, beta, inertia, stiffness):
        """Mean (Fx, Fy) on the freely floating cylinder per amplitude squared, N/m²."""
        velocities = -1j * self.omega * self.motions(beta, inertia, stiffness)
        return self._drift(self._harmonics_diffraction(beta) + velocities @ self._harmonics_radiation(), beta)

    def _drift(self, harmonics, beta):
        """(ρg/πk)(C_g/C) [−2π e^{iβ} Re H(β) − ∫ |H|² e^{iθ} dθ] as real and imaginary part"""
        scale = self.density * self.gravity / (np.pi * self.k) * group_factor(self.k, self.depth)
        forward = self._on(harmonics, beta).real * np.exp(1j * beta)
        scattered = np.sum(harmonics[:-1] * harmonics[1:].conj())
        force = -2 * np.pi * scale * (forward + scattered)
        return np.array([force.real, force.imag])
