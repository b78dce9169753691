"""Plane problems outside and inside a circle, for the depth modes of a vertical cylinder.

A plan has the Neumann-to-Dirichlet maps of a body's plan contour, from normal velocity to potential. The maps are
matrices in real functions ψ, here cos mθ and sin mθ, that are orthonormal on the whole contour and have parity (sign
in x, sign in y).
With r the
distance from the axis the maps from ∂φ/∂r to φ are diagonal:

    outside, decaying like exp(−κr)    Kₘ(κR) / κKₘ'(κR)         inside     Iₘ(κR) / κIₘ'(κR)
    outside, waves                     Hₘ(kR) / kHₘ'(kR)         κ → 0      −R/m outside, R/m inside

and the wave exp(ik(x cosβ + y sinβ)) with its diffraction by the rigid wall is Σ εₘ iᵐ (2i / πkR Hₘ'(kR)) cos m(θ − β)
on the wall (MacCamy and Fuchs, 1954).  Time factor exp(−iωt).
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import hankel1, ive, jv, kve

from ...froude_krylov import side_integrals
from ...waves import depth_factor
from .maps import CLASSES, Contour, WaveMap, table_wavenumber

LOWEST = 3  # highest order of the rigid motions' velocities in the gap, and one more


@dataclass(frozen=True)
class Circle:
    """radius : m; lowest : smallest value of the highest order of functions on the circle"""

    radius: float
    lowest: int = LOWEST

    @property
    def scale(self):
        """Length, m; κN approaches its limit for waves that are short compared with this length"""
        return self.radius

    @property
    def alphas(self):
        """α of `rigid_motions` in heave, roll and pitch, for which ψ has one angular order"""
        return 1 / 2, 1 / 4, 3 / 4

    @property
    def reach(self):
        """Largest distance from the origin, m"""
        return self.radius

    @property
    def sizes(self):
        """The radius alone, m, as a tuple"""
        return (self.radius,)

    def to(self, accuracy):
        """The plan for another `accuracy.Accuracy`: the same circle, because its maps are exact"""
        return self

    def degree(self, waves, tolerance):
        """Highest order that velocities in the gap need; waves : largest wavenumber under the keel, rad/m"""
        return max(self.lowest, _last_order(waves * self.radius, tolerance))

    def table_wavenumber(self, waves):
        """Largest wavenumber, rad/m, that a shared table resolves; at least `waves`"""
        return table_wavenumber(waves, self.radius)

    def subset(self, cls, degree, top):
        """Indices of the functions up to `degree` within those up to `top`; shape (n,)"""
        return np.arange(len(self.orders(cls, degree)))

    def finest(self, degree):
        """Wavenumber along the contour, rad/m, that functions up to `degree` resolve"""
        return (degree - LOWEST) / self.radius

    def contour(self, k, degree, tolerance):
        """`Contour` on the quarter 0 < θ < π/2 that resolves waves of `k` rad/m and functions up to `degree`."""
        orders = max(degree, _last_order(k * self.radius, tolerance))
        count = (orders + 4) // 2 + 4
        theta = (np.arange(count) + 0.5) * np.pi / 2 / count
        normal = np.stack([np.cos(theta), np.sin(theta)])
        return Contour(*(self.radius * normal), *normal, np.full(count, self.radius * np.pi / 2 / count))

    def polynomial_contour(self, degree):
        """Nodes on which products of functions up to `degree` and of the rigid motions are integrated exactly."""
        return self.contour(0.0, degree + 4, 1e-3)

    def orders(self, cls, degree):
        """Orders m of a symmetry class, from 0 to `degree`."""
        even = cls[0] * cls[1] == 1
        m = np.arange(0 if even else 1, degree + 1, 2)
        return m[1:] if cls == (-1, -1) else m

    def basis(self, cls, degree, contour):
        """Functions ψ at the nodes of a contour; shape (m, n)"""
        m = self.orders(cls, degree)
        turn = np.multiply.outer(np.arctan2(contour.y, contour.x), m)
        wave = np.cos(turn) if cls[1] == 1 else np.sin(turn)
        return wave / np.sqrt(np.pi * self.radius * np.where(m, 1, 2))

    def maps(self, degree, kappa):
        """{class: κ times the maps outside and inside, two arrays (c, n, n)} at `kappa` (c,) rad/m"""
        outer, inner = _bessel_ratios(degree, kappa * self.radius)
        orders = {cls: self.orders(cls, degree) for cls in CLASSES}
        return {cls: tuple(r[m].T[:, :, None] * np.eye(len(m)) for r in (outer, inner)) for cls, m in orders.items()}

    def laplace(self, degree):
        """{class: the maps outside and inside for κ = 0, two arrays (n, n)}, zero for the constant function"""
        orders = {cls: self.orders(cls, degree) for cls in CLASSES}
        inner = {cls: np.diag(np.where(m, self.radius / np.maximum(m, 1), 0.0)) for cls, m in orders.items()}
        return {cls: (-matrix, matrix) for cls, matrix in inner.items()}

    def waves(self, classes, degree, k, contour, beta):
        """{class: `WaveMap`} for waves of `k` rad/m and incident waves towards `beta` (b,)"""
        x = k * self.radius
        last = max(degree, len(contour.x) * 2 - 8)
        m = np.arange(last + 1)
        below = _hankel_ratios(last, x)
        slope = below - m / x  # Hₘ' / Hₘ
        inverse = np.concatenate([[1.0], np.cumprod(below[1:])]) / hankel1(0, x)  # 1 / Hₘ, vanishing without overflow
        wall = np.where(m, 2, 1) * 1j**m * 2j / (np.pi * x) * inverse / slope
        theta, out = np.arctan2(contour.y, contour.x), {}
        for cls in classes:
            own, all_mine = self.orders(cls, degree), self.orders(cls, last)
            ratio = 1 / (k * slope[own])
            part = np.cos if cls[1] == 1 else np.sin
            total = part(np.multiply.outer(theta, all_mine)) @ (wall[all_mine, None] * part(np.outer(all_mine, beta)))
            basis = self.basis(cls, degree, contour)
            projected = 4 * (basis * contour.weights[:, None]).T @ total
            out[cls] = WaveMap(np.diag(ratio), basis * ratio, total, projected, basis)
        return out

    def incident_force(self, draft, depth, k, beta):
        """Force of the undisturbed wave per unit amplitude and ρg; shape (b, 6)

        ∮ n₁ exp(ikx) ds = 2πiR J₁(kR),  ∬ exp(ikx) dA = 2πR J₁(kR)/k,  ∬ x exp(ikx) dA = 2πiR² J₂(kR)/k
        """
        one, z = side_integrals(draft, depth, k)
        keel, x = float(depth_factor(-draft, k, depth)) / k, k * self.radius
        around = 2j * np.pi * self.radius * jv(1, x)
        turning = z * around + 2j * np.pi * self.radius**2 * jv(2, x) * keel
        force = np.zeros((len(beta), 6), complex)
        force[:, 0], force[:, 1] = -one * around * np.cos(beta), -one * around * np.sin(beta)
        force[:, 2] = 2 * np.pi * self.radius * jv(1, x) * keel
        force[:, 3], force[:, 4] = turning * np.sin(beta), -turning * np.cos(beta)
        return force


def _last_order(x, tolerance):
    """Highest angular order of a wave on a circle of kR = x: amplitudes fall faster than exponentially beyond x."""
    digits = -np.log10(tolerance)
    return int(np.ceil(x + (1 + 0.7 * digits) * np.cbrt(x) + digits / 2 + 1))


def _bessel_ratios(last, x):
    """Kₘ/Kₘ' and Iₘ/Iₘ' for m = 0 … last, two (last + 1, x) arrays; recurrences run in their stable direction."""
    outer, inner = np.empty((last + 1, len(x))), np.empty((last + 1, len(x)))
    below = kve(1, x) / kve(0, x)  # K_{m−1} / K_m
    for m in range(last + 1):
        outer[m] = -1 / (below + m / x)
        below = 1 / (below + 2 * m / x) if m else 1 / below
    above = x / (last + 1 + np.hypot(last + 1, x))  # I_{m+1} / I_m, started by its bound (Amos 1974)
    there = ive(last, x) > 0
    above[there] = ive(last + 1, x[there]) / ive(last, x[there])
    for m in range(last, -1, -1):
        inner[m] = 1 / (above + m / x)
        above = 1 / (above + 2 * m / x) if m else above
    return outer, inner


def _hankel_ratios(last, x):
    """H_{m−1} / H_m for m = 0 … last at one x, upwards as H grows"""
    ratios = np.empty(last + 1, complex)
    ratios[0] = -hankel1(1, x) / hankel1(0, x)
    for m in range(last):
        ratios[m + 1] = 1 / (2 * m / x - ratios[m])
    return ratios
