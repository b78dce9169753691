"""Damping at every frequency, and the added mass that follows from this damping by causality.

    A(ω) = A(∞) + (2/π) ⨍₀^∞ B(x) / (x² − ω²) dx        (Kramers and Kronig)

Between the frequencies of the band damping is linear in frequency.  Outside the ends ω₁ and Ω of the band damping
follows powers,

    Bᵢⱼ = Mᵢⱼ(ω) + [Bᵢⱼ(ω₁) − Mᵢⱼ(ω₁)] (ω/ω₁)^{(pᵢ + pⱼ)/2} below,    Bᵢⱼ = Bᵢⱼ(Ω) (Ω/ω)^{(rᵢ + rⱼ)/2} above,

with pᵢ, rᵢ from the slopes of the diagonal. A matrix that dissipates energy at an end of the band then also
dissipates energy beyond this end.
The added mass of the band may require more damping above Ω, for example if damping still rises at Ω. This damping has
the shapes (Ω/ω)³ − (Ω/ω)⁵ and (Ω/ω)⁵ − (Ω/ω)⁹, with factors by least squares, limited so that no energy is added.
M is the damping, as ω → 0, of a body that changes the volume below the surface by qᵢ m² per unit of motion (a pulsating
source; Newman, Marine Hydrodynamics, 1977, section 6.18, and the limit of shallow water):

    M = ρ ω q qᵀ / 4h  in water of depth h,    M = ρ ω³ q qᵀ / 2g  in deep water.

Motions without change of volume are dipoles, whose damping falls like ω³ or faster as ω → 0.  In short waves the
damping by a vertical side falls like ω⁻³, and that by a horizontal side faster than any power.
"""

from dataclasses import dataclass

import numpy as np

from ..database.reader import without_rows

LOWEST, DIPOLE, HIGHEST = 1.0, 3.0, 12.0  # plausible powers of ω
SIDE = 3.0  # slowest plausible power of ω⁻¹
END = 0.85  # share of the band, above which the upper slope is computed
CUT = 300.0  # upper limit over Ω; the part beyond it is below 1/CUT² of the part above the band
BUMPS = ((3, 5), (5, 9))  # powers of Ω/ω of damping that rises and falls beyond the band
FEEBLE = 0.01
COMPARED = 60  # frequencies at which added mass is compared


class Causal:
    """Added mass and damping of a subclass that has a `transform` B + iω [A(∞) − A] and an `added_mass_infinity`"""

    def damping(self, omega):
        """Damping B, kg/s …, (q, 6, 6), at omega (q,) rad/s"""
        return self.transform(omega).real

    def added_mass(self, omega):
        """Added mass A, kg …, (q, 6, 6), at omega (q,) rad/s, above 0"""
        omega = np.atleast_1d(omega)
        return self.added_mass_infinity - self.transform(omega).imag / omega[:, None, None]


@dataclass(frozen=True, eq=False)
class WholeAxis:
    """Damping, kg/s …, (n, 6, 6), linear between omega (n,) rad/s, which begin at 0, and added_mass_infinity, kg …,
    (6, 6)"""

    omega: np.ndarray
    damping: np.ndarray
    added_mass_infinity: np.ndarray

    def transform(self, omega):
        """Transform B + iω [A(∞) − A] (q, 6, 6) at omega (q,) rad/s; no value of omega may be in `self.omega`"""
        omega = np.atleast_1d(omega)
        at, share = self._gap(omega)
        share = share[:, None, None]
        B = (1 - share) * self.damping[at] + share * self.damping[at + 1]
        return B - 1j * omega[:, None, None] * self.excess(omega)

    def excess(self, omega):
        """Difference A − A(∞) (q, 6, 6) at omega (q,) rad/s"""
        weights = (2 / np.pi) * kramers_kronig(omega, self.omega)
        return np.tensordot(weights, self.damping, axes=1)

    def between(self, omega):
        """Middle frequencies, rad/s, of the gaps of `self.omega` that contain omega, without repetition; shape (q,)"""
        at = np.unique(self._gap(np.asarray(omega))[0])
        return 0.5 * (self.omega[at] + self.omega[at + 1])

    def _gap(self, omega):
        at = np.clip(np.searchsorted(self.omega, omega) - 1, 0, len(self.omega) - 2)
        return at, (omega - self.omega[at]) / (self.omega[at + 1] - self.omega[at])


def whole_axis(omega, added_mass, damping, added_mass_infinity=None, monopole=None):
    """`WholeAxis` from coefficients (n, 6, 6) at rising omega (n,) rad/s, dense enough for linear interpolation.

    added_mass_infinity : (6, 6); if None, the matrix with which causality best reproduces the added mass of the band
    monopole : function from ω (q,) to M, kg/s …, (q, 6, 6), or None if unknown
    """
    below, low = _below(omega, damping, monopole)
    above, high = _above(omega, damping)
    axis = np.concatenate([below, omega, above])
    first = WholeAxis(axis, np.concatenate([low, damping, high]), added_mass_infinity)
    more, limit = _unseen(omega, added_mass, first, above)
    high = without_negative(high + more, damping)
    return WholeAxis(axis, np.concatenate([low, damping, high]), limit)


def ends_of(body, motions=None):
    """A(∞) (6, 6) and M of a `bem.database.reader.Reader` for `whole_axis`, each None if unknown

    motions : indices of the requested motions, None for all; A(∞) and M are 0 for other motions
    """
    count = len(body.words)
    out = [] if motions is None else [i for i in range(count) if i not in motions]
    limit = body.between.limits.get("added_mass_infinity")
    if limit is not None:
        limit = without_rows(limit, out)
    if limit is not None and not np.all(np.isfinite(limit)):
        limit = None
    if body.stiffness is None:
        return limit, None
    flux, heaves = np.zeros(count), range(2, body.rigid, 6)
    for heave in heaves:
        own = slice(heave, heave + 3)
        flux[own] = body.stiffness[heave, own] / (body.density * body.gravity)
    shapes = slice(body.rigid, None)
    flux[shapes] = body.stiffness[heaves, shapes].sum(axis=0) / (body.density * body.gravity)
    flux[out] = 0.0
    return limit, monopole_damping(flux, body.density, body.depth, body.gravity)


def monopole_damping(flux, density, depth, gravity):
    """M of the module as a function of omega (q,) rad/s.

    flux : volume that a unit of each motion displaces, m² (for rotations m³ per radian), (n,): the waterplane area,
    its moments, and the volume that the wetted surface displaces in a shape
    """
    square = density * np.outer(flux, flux)

    def damping(omega):
        omega = np.atleast_1d(omega)
        share = omega / (4 * depth) if np.isfinite(depth) else omega**3 / (2 * gravity)
        return np.multiply.outer(share, square)

    return damping


def kramers_kronig(omega, points):
    """Weights w (q, n) with Σ w B = ⨍ B(x) / (x² − ω²) dx for B linear between points (n,); no point is at omega
    (q,)."""
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
    """Frequencies beyond Ω, ever farther apart, to where damping vanishes, and the damping there"""
    last = omega[-1]
    axis = last * np.geomspace(1, CUT, 600)[1:]
    some = omega >= omega[0] + END * (last - omega[0])
    own = np.einsum("qii->qi", damping[some])
    seen = np.all(own > 0, axis=0)
    x = np.log(omega[some]) - np.mean(np.log(omega[some]))
    power = -(x @ np.log(np.where(seen, own, 1.0))) / (x @ x)
    power = np.clip(np.where(seen, power, SIDE), SIDE, HIGHEST)
    return axis, damping[-1] * (last / axis)[:, None, None] ** _paired(power)


def _unseen(omega, added_mass, axis, above):
    """Damping (q, 6, 6) beyond Ω in addition to its power, and A(∞), required by the added mass of the band"""
    step = max(1, len(omega) // COMPARED)
    at = 0.5 * (omega[:-1] + omega[1:])[step // 2 :: step]
    flat = added_mass.reshape(len(omega), -1)
    measured = np.stack([np.interp(at, omega, column) for column in flat.T], axis=1)
    missing = measured - axis.excess(at).reshape(len(at), -1)
    x = omega[-1] / above
    shapes = np.stack([x**low - x**high for low, high in BUMPS], axis=1)
    left = (2 / np.pi) * kramers_kronig(at, axis.omega)[:, -len(above) :] @ shapes
    known = axis.added_mass_infinity is not None
    if known:
        missing = missing - axis.added_mass_infinity.ravel()
    else:
        left = np.column_stack([left, np.ones(len(at))])
    # rows times ω give impedance, of the size of the damping; motions with small forces in the band stay small
    keep = FEEBLE * np.sqrt(len(at)) * np.eye(len(BUMPS), left.shape[1])
    right = np.vstack([at[:, None] * missing, np.zeros((len(BUMPS), missing.shape[1]))])
    found = np.linalg.lstsq(np.vstack([at[:, None] * left, keep]), right, rcond=None)[0]
    shape = added_mass.shape[1:]
    more = (shapes @ found[: len(BUMPS)]).reshape(-1, *shape) * np.any(axis.damping, axis=0)
    return more, axis.added_mass_infinity if known else found[-1].reshape(shape)


def without_negative(matrices, damping):
    """Matrices (q, 6, 6) without parts that would add energy; motions are scaled by their largest `damping` (n, 6,
    6)"""
    size = np.sqrt(np.abs(np.einsum("qii->qi", damping)).max(axis=0))
    scale = np.outer(size, size)
    scale[scale == 0] = 1.0
    values, vectors = np.linalg.eigh(0.5 * (matrices + matrices.swapaxes(1, 2)) / scale)
    mended = (vectors * np.maximum(values, 0)[:, None]) @ vectors.swapaxes(1, 2) * scale
    mended[:, ~np.any(damping, axis=0)] = 0.0  # exact zeros for motions uncoupled by symmetry
    return np.where((values[:, 0] < 0)[:, None, None], mended, matrices)


def _paired(power):
    return 0.5 * (power[:, None] + power)
