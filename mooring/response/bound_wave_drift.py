"""Slow force of bound long waves on a body, which Newman's approximation of slow drift neglects.

    F(t) = Re Σᵢ Σⱼ aᵢ āⱼ T_ij exp{−i(ωᵢ − ωⱼ)t},        T_ij = √(DᵢDⱼ) + s_ij D(Ω, κ),    Ω = ωᵢ − ωⱼ, κ = kᵢ − kⱼ

with the mean drift Dᵢ of single waves (`slow_drift`), the bound wave s of a pair (`bem.second_order.bound_waves`),
and the force D(Ω, κ) of a wave of unit amplitude that is not free (`bem.second_order.long_wave_forces`).  This is
the third part of the force by Pinkster (1980), with the diffraction of the bound wave at its own wavenumber. The
other parts, forces on body and surface by products of first-order waves, are approximated by Newman's term.  On a
fixed cylinder whose radius is half the depth, the sum is within 8 % of the full force from ka = 0.2 and 0.4 on;
Newman's term alone is 4 % of it there.

The method is for long-crested waves: all travel in one direction, and Ω/κ lies between their group velocities.  On a
grid over Ω and Ω/κ the force is a polynomial, whose last coefficients are the estimated error.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.kernels.threads import blas_threads, parallel_rows
from hakobune.bem.second_order.bound_waves import bound_waves
from hakobune.bem.waves import group_factor, wavenumber

from ..environment.sea import Sea
from .slow_drift import differences, force_spectrum, force_spectrum_with, held_beyond, sums

FREQUENCIES, SPEEDS = 10, 8  # frequencies and speeds of the grid
RUNG = 1.25  # ratio of the ends of grids: seas whose ends lie between the same two share the solutions of a body
# samples of a record per shortest period: by cubic splines between them errors are those of LEAST, 2e-4 of σ; by
# monotone cubics that took 64
SAMPLES = 12
LEAST = 1e-4  # smallest eigenvalue kept, over the largest
AT_ONCE = 1024  # pairs, whose polynomials stay near the processor: a third of the time of all together
SLOW = (0.4, 0.6)  # difference frequencies over the mean frequency between which the force is faded out
SHALLOW = 1.5  # kh at the mean period below which the neglected force is estimated
PLACES, FOURTH = 161, 4  # frequencies of an estimate; every fourth of the differences
WORTH_NAMING = 0.2  # ratio to the slow force by Newman's approximation from which the force is reported
NOTHING = 1e-6  # force over the weight of the body below which it is negligible
RATIO = 10.0  # ratio to Newman's force, above which Newman's is negligible and no reference for the other
STOKES = 40.0  # Ursell number H λ²/h³ up to which waves are a sum of first and second order (Hedges 1995)


@dataclass(frozen=True, eq=False)
class BoundWaveForces:
    """Force D(Ω, Ω/κ) in waves of one direction, as Chebyshev polynomials.

    direction : rad, relative to the body; highest : highest Ω, rad/s; speeds : smallest and largest Ω/κ, (2,) m/s
    coefficients : (f, s, 6) complex, over Ω from 0 to `end` and over Ω/κ; depth, gravity : m, m/s²
    end : rad/s, of the grid, by default `highest`
    """

    direction: float
    highest: float
    speeds: tuple
    coefficients: np.ndarray
    depth: float
    gravity: float
    end: float | None = None
    level = "bound-wave"

    @property
    def error(self):
        """Size of the last coefficients over the largest force; shape (6,)"""
        size = np.abs(self.coefficients)
        last = size[-2:].sum(axis=(0, 1)) + size[:, -2:].sum(axis=(0, 1))
        return last / np.maximum(size.sum(axis=(0, 1)), 1e-300)

    def of_components(self, components, drift=None):
        """Transfer functions T of all pairs of wave `components` of one direction; shape (n, n, 6); T_ji = conj
        T_ij
        """
        omega = np.asarray(components.omega, float)
        T = np.zeros((len(omega), len(omega), 6), complex)
        apart = omega[:, None] - omega
        one, two = np.nonzero(np.tri(len(omega), dtype=bool) & (np.abs(apart) < self.highest))
        T[one, two] = self(omega[one], omega[two])
        T[two, one] = T[one, two].conj()
        return T

    def __call__(self, one, two):
        """Transfer functions T of the bound waves of pairs of frequencies that broadcast, rad/s; shape (…, 6); N/m², N
        m/m²

        T is zero for differences beyond `highest`; a smooth step over SLOW leads to it.
        """
        one, two = np.broadcast_arrays(np.asarray(one, float), np.asarray(two, float))
        bound = bound_waves((one, 0.0), (two, 0.0), self.depth, self.gravity)
        size, kappa = np.abs(bound.omega), np.abs(bound.number[..., 0])
        with np.errstate(divide="ignore", invalid="ignore"):
            speed = np.where(kappa > 1e-12, size / kappa, group_speed(one, self.depth, self.gravity))
        low, high = self.speeds
        x = np.clip(2 * size / (self.highest if self.end is None else self.end) - 1, -1, 1)
        y = np.clip((2 * speed - low - high) / (high - low), -1, 1)
        value = self._polynomials(x.ravel(), y.ravel()).T.reshape(*x.shape, 6)
        value = np.where((bound.omega < 0)[..., None], value.conj(), value)
        value = np.where((bound.omega == 0)[..., None], value.real, value)
        return value * (bound.amplitude * slow_share(size / self.highest))[..., None]

    def _polynomials(self, x, y):
        """D at places (n,) of both polynomials, −1 to 1; shape (6, n)"""
        parts = [slice(i, i + AT_ONCE) for i in range(0, len(x), AT_ONCE)] or [slice(0, 0)]
        value = np.polynomial.chebyshev.chebval2d
        return np.concatenate([value(x[part], y[part], self.coefficients) for part in parts], axis=1)


def slow_share(x):
    """Weight that is 1 below SLOW[0]/SLOW[1] of the highest difference frequency and 0 from this frequency on, with
    continuous slope
    """
    s = np.clip((1 - np.abs(x)) / (1 - SLOW[0] / SLOW[1]), 0.0, 1.0)
    return s * s * (3 - 2 * s)


def group_speed(omega, depth, gravity):
    """m/s"""
    k = wavenumber(omega, depth, gravity)
    return group_factor(k, depth) * omega / k


def of_sea(db, sea) -> BoundWaveForces:
    """`BoundWaveForces` of an opened database in a Sea.  raises : ValueError for short crests and several systems"""
    if not isinstance(sea, Sea) or sea.spreading is not None:
        raise ValueError("forces of wave pairs need a sea of one long-crested system; this sea has several directions")
    mean = float(sea.spectrum.moment(1) / sea.spectrum.moment(0))
    return bound_wave_forces(problem_of(db), sea.spectrum.quantile((1e-4, 0.999)), mean, sea.direction)


def bound_wave_forces(problem, band, mean, direction) -> BoundWaveForces:
    """`BoundWaveForces` of a `PanelProblem` in waves between two frequencies.

    band : (low, high) rad/s; mean : rad/s, mean frequency; direction : rad, relative to the body
    """
    from hakobune.bem.second_order.long_wave_forces import kept_forces

    depth, g = problem.depth, problem.gravity
    highest = SLOW[1] * mean
    fast, slow = (float(group_speed(w, depth, g)) for w in band)
    x, y = (np.cos(np.pi * (np.arange(n) + 0.5) / n) for n in (FREQUENCIES, SPEEDS))
    speeds = 0.5 * (fast + slow) + 0.5 * (fast - slow) * y
    end = float(RUNG ** np.ceil(np.log(highest) / np.log(RUNG)))
    omega, way = 0.5 * end * (1 + x), np.array([np.cos(direction), np.sin(direction)])
    values = kept_forces(problem, omega, (omega[:, None] / speeds)[..., None] * way)
    basis_x = np.linalg.inv(np.polynomial.chebyshev.chebvander(x, FREQUENCIES - 1))
    basis_y = np.linalg.inv(np.polynomial.chebyshev.chebvander(y, SPEEDS - 1))
    coefficients = np.einsum("ap,bq,pqj->abj", basis_x, basis_y, values)
    return BoundWaveForces(float(direction), highest, (slow, fast), coefficients, depth, g, end)


def problem_of(db):
    """The `PanelProblem` of a database's bodies on their panels, without damping lids.

    raises : ValueError for bodies beside a wall; DatabaseError for flexible bodies
    """
    import tomllib

    from hakobune.bem.methods.panel_problem import PanelProblem

    if "wall" in tomllib.loads(db.header.scene):
        raise ValueError(f"{db.path} is for a body beside a wall; second-order forces need open water")
    db.require_rigid()
    held = {"bodies": db.bodies}
    if db.bodies:
        held |= {"inertia_matrix": db.inertia_matrix, "hydrostatic_stiffness": db.stiffness}
        held |= {"viscous": db.bodies_reader.viscous}
    else:
        body = db.reader
        held |= {"inertia_matrix": body.inertia, "hydrostatic_stiffness": body.stiffness, "viscous": body.viscous}
    return PanelProblem(
        db.mesh,
        db.lid,
        depth=db.water_depth,
        density=db.density,
        gravity=db.gravity,
        rotation_center=tuple(db.rotation_center),
        **held,
    )


def record(forces, components, duration, drift=None, met=None):
    """Times (n,) s from 0 and the force (n, 6) of pairs in a record of waves, about its mean.

    forces : `BoundWaveForces` or of `pair_levels`; components : `mooring.environment.sea.Components`, in directions
        for which the forces are known; drift : mean drift of each component, (n, 3), already included by Newman's rule
    met : frequencies at which the body meets the components on a current, (n,) rad/s, None in still water.
    The matrix T_ij is Hermitian, so the force is a sum of squares |Σ aᵢ u_i exp{i(εᵢ − ωᵢt)}|², one for every
    eigenvalue.
    """
    omega = np.asarray(components.omega if met is None else met, float)
    count = int(np.ceil(duration * forces.highest / (2 * np.pi) * SAMPLES)) + 2
    t = np.linspace(0.0, duration, count)
    T = forces.of_components(components, drift)
    T[np.arange(len(omega)), np.arange(len(omega))] = 0.0
    size, turn, out = np.asarray(components.amplitude), np.exp(1j * np.asarray(components.phase)), np.zeros((count, 6))

    def put(low, high):
        for j in range(low, high):
            value, vector = np.linalg.eigh(size[:, None] * T[:, :, j] * size)
            kept = np.abs(value) > LEAST * np.abs(value).max(initial=1e-300)
            rows = turn * vector[:, kept].T
            if np.any(value):
                out[:, j] = value[kept] @ (np.abs(sums(rows, omega, t)) ** 2 - 1)

    with blas_threads(1):  # modes side by side; the digits are those of one thread
        parallel_rows(put, 6, T.size)
    return t, out


def left_out(body, sea, way='qtf = "auto" in a response study or a simulation includes those in the database'):
    """Messages on the effect of neglected bound waves; none from kh = SHALLOW on, and none for small effects.

    body : `bem.database.reader.Reader` with drift and inertia; sea : its mean direction represents all waves
    way : remedy, in words
    """
    found, kh = _slow_forces(body, sea), depth_in_waves(body, sea)
    if found is None or kh >= SHALLOW:
        return
    bound, newman = found
    if bound <= WORTH_NAMING * newman or bound <= NOTHING * body.inertia[0, 0] * body.gravity:
        return
    if (steep := ursell(body, sea)) > STOKES:
        yield (
            f"left out: the slow force of bound long waves; Hλ²/h³ is {steep:.3g}, allowed: {STOKES:g} (kh is "
            f"{kh:.2g} at the mean wave period): the second-order expansion is not valid for such long and high "
            "waves"
        )
        return
    size = f"{bound / newman:.1f} times the slow force by Newman's approximation"
    if bound > RATIO * newman:
        size = f"σ {bound / 1e3:.3g} kN, against {newman / 1e3:.2g} kN by Newman's approximation"
    yield (
        f"left out: bound long waves; at the mean wave period (kh = {kh:.2f}) their slow force is about {size}; {way}"
    )


def bound_to_newman(body, sea):
    """Estimated slow force of bound waves over that by Newman's approximation; None if drift or inertia are unknown.

    Both are root mean squares of surge and sway over the `differences` of the body.

    On boxes of 60 and 100 m in 12 to 20 m of water, head and beam seas, kh of the peak from 0.3 to 2, the estimate
    is 0.95 to 1.3 times the solved value (`tests/bench/bound_to_newman.py`). Arguments are as in `left_out`
    """
    found = _slow_forces(body, sea)
    return None if found is None else found[0] / max(found[1], 1e-300)


def _slow_forces(body, sea):
    """N, force of bound waves and force by Newman's approximation, for the ratio `bound_to_newman`, or None"""
    spectrum = sea.spectrum
    if not body.knows_drift or body.inertia is None:
        return None
    highest = SLOW[1] * float(spectrum.moment(1) / spectrum.moment(0))
    omega = np.linspace(*np.clip(spectrum.quantile((0.001, 0.999)), body.omega[0], body.omega[-1]), PLACES)
    omega, D = held_beyond(omega, body.drift(omega, [sea.direction])[:, 0], spectrum)
    step = differences(body)[::FOURTH]

    def bound(one, two):
        return estimated_forces(body, one, two, sea.direction, highest)

    alone = force_spectrum_with(bound, spectrum, omega, np.zeros_like(D), step)
    parts = alone, force_spectrum(spectrum, omega, D, step)
    return tuple(float(np.sqrt(np.trapezoid(part[:, :2].sum(axis=1), step))) for part in parts)


def ursell(body, sea):
    """Number Hλ²/h³ from the significant height and mean frequency of a sea; beyond STOKES, first plus second order
    does not apply
    """
    return sea.spectrum.significant_height * (2 * np.pi / depth_in_waves(body, sea)) ** 2 / body.depth


def depth_in_waves(body, sea):
    """kh at the mean frequency of a sea, k the wavenumber; body : `bem.database.reader.Reader`"""
    mean = float(sea.spectrum.moment(1) / sea.spectrum.moment(0))
    return float(wavenumber(mean, body.depth, body.gravity)) * body.depth


def estimated_forces(body, one, two, direction, highest):
    """Estimated transfer functions T of bound waves in surge and sway, shape (…, 6): a long wave exerts the force of
    its slope.

    D = iκ ρg (∇ + A/ρ) (cos β, sin β) f, f = sinc(κa cos β) sinc(κb sin β), the mean of the slope over a plan of 2a
    by 2b

    A is the added mass at the lowest known frequency. body : `bem.database.reader.Reader` with its inertia
    highest : rad/s, highest difference frequency, as in `BoundWaveForces`
    """
    bound = bound_waves((one, 0.0), (two, 0.0), body.depth, body.gravity)
    kappa, amplitude = bound.number[..., 0], bound.amplitude * slow_share(bound.omega / highest)
    way = np.array([np.cos(direction), np.sin(direction)])
    half = np.ptp(body.between.outline, axis=0) / 2
    mean = np.prod(np.sinc(kappa[..., None] * half * way / np.pi), axis=-1)
    out = np.zeros((*kappa.shape, 6), complex)
    mass = body.inertia[0, 0] + np.diag(body.held_added_mass(0.0)[0])[:2]
    out[..., :2] = 1j * (kappa * amplitude * mean)[..., None] * body.gravity * mass * way
    return out
