"""Damping at every frequency, and the added mass that belongs to it by causality.

    A(ω) = A(∞) + (2/π) ⨍₀^∞ B(x) / (x² − ω²) dx        (Kramers and Kronig)

Damping is straight between the frequencies of the band.  Beyond its ends ω₁ and Ω it follows powers of its own,

    Bᵢⱼ = Mᵢⱼ(ω) + [Bᵢⱼ(ω₁) − Mᵢⱼ(ω₁)] (ω/ω₁)^{(pᵢ + pⱼ)/2} below,    Bᵢⱼ = Bᵢⱼ(Ω) (Ω/ω)^{(rᵢ + rⱼ)/2} above,

with pᵢ, rᵢ from the slopes of the diagonal, so that a matrix that takes energy out at an end does so beyond it too.
M are the waves of a body that changes the volume below the surface by qᵢ m² a unit of motion, ω → 0 (the pulsating
source; Newman, Marine Hydrodynamics, 1977, section 6.18, and its limit in shallow water):

    M = ρ ω q qᵀ / 4h  in water of depth h,    M = ρ ω³ q qᵀ / 2g  in deep water.

Motions that change no volume make dipoles, B like ω³ and more; a vertical side damps like ω⁻³ in short waves, a
horizontal one less than any power.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LOWEST, DIPOLE, HIGHEST = 1.0, 3.0, 12.0  # powers of ω that are believed
SIDE = 3.0  # slowest power of ω⁻¹ that is believed
END = 0.85  # share of the band above which its upper slope is taken
CUT = 300.0  # times Ω: what is beyond is below 1/CUT² of what is above the band
COMPARED = 60  # frequencies at which added mass is compared


@dataclass(frozen=True, eq=False)
class WholeAxis:
    """Damping (n, 6, 6) kg/s … straight between omega (n,) rad/s from 0, and added_mass_infinity (6, 6) kg …"""

    omega: np.ndarray
    damping: np.ndarray
    added_mass_infinity: np.ndarray

    def transform(self, omega):
        """B + iω [A(∞) − A] (q, 6, 6) at omega (q,) rad/s, none of them one of `self.omega`"""
        omega = np.atleast_1d(omega)
        at, share = self._gap(omega)
        share = share[:, None, None]
        B = (1 - share) * self.damping[at] + share * self.damping[at + 1]
        return B - 1j * omega[:, None, None] * self.excess(omega)

    def excess(self, omega):
        """A − A(∞) (q, 6, 6) at omega (q,) rad/s"""
        weights = (2 / np.pi) * kramers_kronig(omega, self.omega)
        return np.tensordot(weights, self.damping, axes=1)

    def between(self, omega):
        """(q,) rad/s in the middle of the gaps of `self.omega` that omega (q,) lie in, each once"""
        at = np.unique(self._gap(np.asarray(omega))[0])
        return 0.5 * (self.omega[at] + self.omega[at + 1])

    def _gap(self, omega):
        at = np.clip(np.searchsorted(self.omega, omega) - 1, 0, len(self.omega) - 2)
        return at, (omega - self.omega[at]) / (self.omega[at + 1] - self.omega[at])


def whole_axis(omega, added_mass, damping, added_mass_infinity=None, monopole=None):
    """`WholeAxis` of coefficients (n, 6, 6) at omega (n,) rad/s rising, dense enough for straight lines between.

    added_mass_infinity : (6, 6), None for that with which causality returns the added mass of the band in the mean
    monopole : function of ω (q,) giving M (q, 6, 6) kg/s …, None where it is not known
    """
    below, low = _below(omega, damping, monopole)
    above, high = _above(omega, damping)
    axis = np.concatenate([below, omega, above])
    out = WholeAxis(axis, np.concatenate([low, damping, high]), added_mass_infinity)
    if added_mass_infinity is not None:
        return out
    step = max(1, len(omega) // COMPARED)
    at = 0.5 * (omega[:-1] + omega[1:])[step // 2 :: step]
    measured = np.stack([np.interp(at, omega, column) for column in added_mass.reshape(len(omega), -1).T], axis=1)
    limit = np.mean(measured.reshape(-1, *added_mass.shape[1:]) - out.excess(at), axis=0)
    return WholeAxis(axis, out.damping, limit)


def monopole_damping(flux, density, depth, gravity):
    """M of the module as a function of omega (q,) rad/s.

    flux : (6,) m² (m³ a radian) of volume that a unit of each motion displaces: the waterplane and its moments
    """
    square = density * np.outer(flux, flux)

    def damping(omega):
        omega = np.atleast_1d(omega)
        share = omega / (4 * depth) if np.isfinite(depth) else omega**3 / (2 * gravity)
        return np.multiply.outer(share, square)

    return damping


def kramers_kronig(omega, points):
    """w (q, n) with Σ w B = ⨍ B(x) / (x² − ω²) dx for B straight between points (n,), none of them at omega (q,)."""
    a, b = points[:-1], points[1:]
    w = np.atleast_1d(omega)[:, None]

    def zeroth(x):  # ∫ dx / (x² − ω²)
        return np.log(np.abs((x - w) / (x + w))) / (2 * w)

    def first(x):  # ∫ x dx / (x² − ω²)
        return 0.5 * np.log(np.abs(x * x - w * w))

    plain, moment = zeroth(b) - zeroth(a), first(b) - first(a)
    out = np.zeros((len(w), len(points)))
    out[:, :-1] += (b * plain - moment) / (b - a)
    out[:, 1:] += (moment - a * plain) / (b - a)
    return out


def _below(omega, damping, monopole):
    """Frequencies from 0 to ω₁, without it, and the damping there"""
    first = omega[0]
    axis = np.concatenate([[0.0], first * np.geomspace(1e-3, 1, 60)[:-1]])
    step = omega[1] - first
    known = np.zeros((3, *damping.shape[1:])) if monopole is None else monopole(np.array([first, omega[1], first]))
    rest, further = damping[0] - known[0], damping[1] - known[1]
    own, slope = np.diag(rest), (np.diag(further) - np.diag(rest)) / step
    seen = np.abs(own) > 0
    power = np.where(seen, first * slope / np.where(seen, own, 1), DIPOLE)
    sources = np.diag(known[0]) > 0.1 * np.abs(np.diag(damping[0])) if monopole is not None else np.full(len(own), True)
    power = np.clip(power, np.where(sources, LOWEST, DIPOLE), HIGHEST)
    out = rest * (axis / first)[:, None, None] ** _paired(power)
    return axis, out if monopole is None else out + monopole(axis)


def _above(omega, damping):
    """Frequencies beyond Ω, ever farther apart, to where nothing is left, and the damping there"""
    last = omega[-1]
    axis = last * np.geomspace(1, CUT, 600)[1:]
    some = omega >= omega[0] + END * (last - omega[0])
    own = np.einsum("qii->qi", damping[some])
    seen = np.all(own > 0, axis=0)
    x = np.log(omega[some]) - np.mean(np.log(omega[some]))
    power = -(x @ np.log(np.where(seen, own, 1.0))) / (x @ x)
    power = np.clip(np.where(seen, power, SIDE), SIDE, HIGHEST)
    return axis, damping[-1] * (last / axis)[:, None, None] ** _paired(power)


def _paired(power):
    return 0.5 * (power[:, None] + power)
