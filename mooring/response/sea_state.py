"""A body in one sea state: standard deviations, extremes and drift, with warnings on their limits.

The spectrum is integrated over the stored frequencies only.  The part of a response outside the stored frequencies is
estimated with constant transfer functions, and reported if above 1 %.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError

from ..on_current.body import carrier_of_body
from ..on_current.waves import check_blocked
from ..seas.breaking import too_high
from . import drift as drifts
from . import findings
from .bound_wave_drift import left_out
from .extremes import bandwidth, expected_maximum, maximum_not_exceeded, significant_factor
from .linear import Moments, frequencies, moments, moments_met, response_spectrum
from .points import KeelPoint, Point, keel_name, relative_name, transfer_functions
from .seas import check_coverage, directions, heading_step
from .slow_drift import differences, force_spectrum, force_spectrum_with, held_beyond, signed, slow_parts
from .wave_drift_damping import along_waves, drift_and_damping, mean_damping, of_current

TINY = 1e-6  # standard deviations below this fraction of the largest with the same unit count as zero by symmetry


@dataclass(frozen=True, eq=False)
class SlowForces:
    """Second-order forces in one sea state: N, N, N m.

    drift : mean drift, (3,); beyond : its parts due to waves below and above the stored band, (2, 3), with D
        constant beyond the ends
    difference : (d,) rad/s; spectrum : spectrum of the slow drift force, (d, 3) N² s/rad, with D constant above the
        stored band
    of_pairs : spectrum for all modes at a level above Newman's approximation, (d, 6), None if not requested; level :
        name of the level
    damping : (3, 2) N s/m, N s: wave drift damping for velocities along x and y, from waves within the stored band;
    None where drift has no slope over the headings, because the direction has no stored neighbours
    by_current : addition of the current to the mean drift, (3,), None in still water
    of_each : mean drift of each of several bodies about its rotation centre, in its axes, (bodies, 3), None if
        unknown for these motions; `drift` is the drift of all bodies about the origin
    """

    drift: np.ndarray
    beyond: np.ndarray
    difference: np.ndarray
    spectrum: np.ndarray
    damping: np.ndarray | None
    of_pairs: np.ndarray | None = None
    level: str = "newman"
    by_current: np.ndarray | None = None
    of_each: np.ndarray | None = None

    @property
    def sigma_of_pairs(self):
        """Standard deviation of the slow force of wave pairs in all motions, as in `sigma`; shape (6,)"""
        return np.sqrt(np.trapezoid(self.of_pairs, self.difference, axis=0))

    @property
    def sigma(self):
        """Standard deviation of the slow drift force, integrated up to the last difference frequency; shape (3,)"""
        return np.sqrt(np.trapezoid(self.spectrum, self.difference, axis=0))


@dataclass(frozen=True, eq=False)
class SeaState:
    """Result of `sea_state`; arrays follow `names` (c,).

    duration : s; spectrum : (q, c) at omega (q,), unit² s/rad; moments : Moments of it, each (c,)
    slow : SlowForces, None without drift in the database; errors : `findings.Errors` between stored waves
    missed : fraction of the waves that is missing at points, as in `points.Transfer.missed`
    """

    sea: object
    duration: float
    points: tuple[Point, ...]
    names: tuple[str, ...]
    units: tuple[str, ...]
    omega: np.ndarray
    spectrum: np.ndarray
    moments: Moments
    slow: SlowForces | None
    errors: findings.Errors
    warnings: tuple[str, ...]
    missed: float | None = None

    def __repr__(self):
        height = self.sea.spectrum.significant_height
        return f"<SeaState {height:.3g} m, {len(self.names)} responses, {len(self.warnings)} warnings>"

    @property
    def sigma(self):
        """Standard deviation; shape (c,)"""
        return np.sqrt(self.moments.m0)

    @property
    def zero_period(self):
        """Mean period between upward zero crossings, s; shape (c,); nan for a zero response"""
        return _ratio(self.moments.m0, self.moments.m2)

    @property
    def peak_period(self):
        """Mean period between maxima, s; shape (c,)"""
        return _ratio(self.moments.m2, self.moments.m4)

    @property
    def bandwidth(self):
        """Bandwidth ε of the spectrum; shape (c,); 0 for a zero response"""
        return self._each(lambda m, _: float(bandwidth(m.m0, m.m2, m.m4)))

    @property
    def significant(self):
        """Mean of the highest third of the maxima, C(ε) σ; shape (c,)"""
        return self._each(lambda m, _: significant_factor(float(bandwidth(m.m0, m.m2, m.m4))) * np.sqrt(m.m0))

    @property
    def expected_maximum(self):
        """Mean of the largest value in `duration`; shape (c,)"""
        return self._each(lambda m, T: expected_maximum(np.sqrt(m.m0), self.duration, T))

    def not_exceeded(self, probability):
        """Value that the largest in `duration` does not exceed with `probability`; shape (c,)"""
        return self._each(lambda m, T: maximum_not_exceeded(np.sqrt(m.m0), self.duration, T, probability))

    def air_gaps(self):
        """{name of a point with a clearance: (clearance, m, air gap left by the expected largest rise, m,
        probability of contact)}.
        """
        return {
            point.name: self._left(relative_name(point), point.clearance)
            for point in self.points
            if isinstance(point, Point) and point.clearance is not None
        }

    def under_keel(self):
        """{name of KeelPoint: (gap at rest, water left under the expected largest drop, probability of touching)}"""
        return {
            point.name: self._left(keel_name(point), point.gap) for point in self.points if isinstance(point, KeelPoint)
        }

    def reached(self, name, level):
        """Probability that a response rises (or falls) to a level in `duration`, for independent crossings

        Conservative: below 3.5 deviations crossings occur in groups; at 3 the probability is a tenth too high.
        """
        i = self.names.index(name)
        if not self.sigma[i] > 0:
            return 0.0
        cycles = self.duration / self.zero_period[i]
        return float(-np.expm1(-cycles * np.exp(-0.5 * (level / self.sigma[i]) ** 2))) if level > 0 else 1.0

    def _left(self, name, level):
        return level, level - self.expected_maximum[self.names.index(name)], self.reached(name, level)

    def _each(self, function):
        """Function(moments, zero period) of each nonzero response, 0 for the others; shape (c,)"""
        parts = zip(*self.moments, self.zero_period, strict=True)
        return np.array([function(Moments(*m), T) if np.isfinite(T) else 0.0 for *m, T in parts])


def sea_state(body, sea, duration, points=(), bound=None) -> SeaState:
    """A `bem.database.reader.Reader`, `floating`, in a Sea for `duration` s.

    points : `Point`s and `KeelPoint`s; bound : from `pair_levels.beside_newman`
    raises : ValueError for a duration that is not above 0, BetweenError outside the stored headings
    """
    if not 0 < duration < np.inf:
        raise ValueError(f"duration is {duration:g} s; allowed: above 0, finite")
    check_coverage(body, sea.spectrum)
    broken = list(too_high(sea.spectrum, body.depth, body.gravity))
    carrier = carrier_of_body(body)
    broken += check_blocked(carrier, sea, body.depth, body.gravity)
    omega = frequencies(body, sea.spectrum.density, None if carrier is None else directions(sea, body.omega)[0])
    step = heading_step(body, sea, omega)
    heading, weights = directions(sea, omega, step)
    transfer = transfer_functions(body, omega, heading, points)
    spectrum, found = linear_response(sea, transfer, weights)
    found = _without_rounding(found, transfer.units)
    warnings = [
        *broken,
        *findings.waves_outside(body, sea.spectrum),
        *findings.responses_outside(body, sea.spectrum, transfer, weights, found.m0),
        *findings.waves_missed(transfer),
    ]
    slow, inside = None, None
    if body.knows_drift:
        slow = slow_forces(body, sea, omega, heading, weights, bound)
        warnings += left_out(body, sea) if bound is None else ()
        warnings += findings.current_along_waves(carrier, heading, weights, slow.damping)
        warnings += findings.drift_of_each(body, slow)
        inside = slow.drift - slow.beyond.sum(axis=0)
        warnings += findings.drift_outside(body, sea.spectrum, inside, slow.beyond)
    errors = findings.errors_between(body, sea, omega, found.m0[: len(body.words)], inside, slow and slow.damping)
    warnings += findings.between_waves(body, errors)
    return SeaState(
        sea, float(duration), tuple(points), transfer.names, transfer.units, omega, spectrum, found, slow,
        errors, tuple(warnings), transfer.missed,
    )  # fmt: skip


def linear_response(sea, transfer, weights):
    """Spectrum (q, c) of every response, unit² s/rad, and its Moments; weights (p,) or (q, p) of the headings"""
    density = sea.spectrum.density(transfer.omega)
    spectrum = response_spectrum(transfer.value, density, weights)
    if transfer.met is None:
        return spectrum, moments(transfer.omega, spectrum)
    return spectrum, moments_met(transfer.omega, transfer.met, transfer.value, density, weights)


def mean_drift(body, sea, omega, drift, weights):
    """Mean drift, N, N, N m, by waves within the stored band (3,), and below and above it (2, 3); drift : at omega,
    (q, p, 3)
    """
    ends = weights if weights.ndim == 1 else weights[[0, -1]]
    inside = drifts.mean_in_sea(omega, drift, sea.spectrum.density(omega), weights)
    return inside, drifts.mean_in_sea_beyond(body, sea.spectrum, drift[[0, -1]], ends)


def slow_forces(body, sea, omega, heading, weights, bound=None) -> SlowForces:
    """Mean drift, spectrum of slow drift and wave drift damping; omega (q,) rad/s, heading (p,) rad, weights (p,) of
    the headings.

    bound : from `pair_levels.beside_newman`, in a spread sea with its `spectrum`
    """
    value, coefficients, known = drift_on_current(body, omega, heading)
    damping = mean_damping(omega, coefficients, sea.spectrum.density(omega), weights) if known else None
    inside, beyond = mean_drift(body, sea, omega, value, weights)
    carrier, by_current = carrier_of_body(body), None
    if carrier is not None:
        still = mean_drift(body, sea, omega, value - of_current(body, coefficients), weights)
        by_current = inside - still[0] + (beyond - still[1]).sum(axis=0)
    difference, with_bound = differences(body), None
    if bound is not None:
        held = held_beyond(omega, value[:, 0], sea.spectrum)
        if sea.spreading is None:
            with_bound = force_spectrum_with(bound, sea.spectrum, *held, difference, _met_of(body, heading))
        else:
            with_bound = bound.spectrum(held[0], difference)
    return SlowForces(
        inside + beyond.sum(axis=0),
        beyond,
        difference,
        force_spectrum(*slow_parts(body, sea.spectrum, omega, heading, signed(value), weights), difference),
        damping,
        with_bound,
        "newman" if bound is None else bound.level,
        by_current,
        None if carrier is not None else drift_of_each(body, sea, omega, heading, weights),
    )


def drift_of_each(body, sea, omega, heading, weights):
    """Mean drift of each of several bodies, None if unknown; shape (bodies, 3); arguments as in `slow_forces`"""
    if not body.bodies:
        return None
    try:
        value = body.drift_of_each(omega, heading)
    except BetweenError:
        return None
    inside, beyond = mean_drift(body, sea, omega, value.reshape(*value.shape[:2], -1), weights)
    return (inside + beyond.sum(axis=0)).reshape(-1, 3)


def drift_on_current(body, omega, heading):
    """Drift D (q, p, 3) on the body's current, if any; B (q, p, 3, 2); and whether B includes the change of D over
    headings.

    In still water B is None if unknown
    """
    try:
        value, coefficients = drift_and_damping(body, omega, heading)
        known = True
    except BetweenError:
        if carrier_of_body(body) is None:
            return body.drift(omega, heading), None, False
        value, coefficients = along_waves(body, omega, heading)
        known = False
    return value + of_current(body, coefficients), coefficients, known


def _met_of(body, heading):
    """Function of frequencies (q,) → (q,) rad/s at which the body meets long-crested waves; None in still water"""
    carrier = carrier_of_body(body)
    if carrier is None:
        return None
    return lambda omega: carrier.met(omega, float(heading[0]), body.depth, body.gravity)


def _without_rounding(found, units):
    """Moments of responses, set to 0 where they are zero by symmetry"""
    largest = {unit: max(m for m, u in zip(found.m0, units, strict=True) if u == unit) for unit in units}
    real = found.m0 > TINY**2 * np.array([largest[unit] for unit in units])
    return Moments(*(np.where(real, m, 0.0) for m in found))


def _ratio(above, below):
    """2π√(above/below), nan for below = 0"""
    return np.where(below > 0, 2 * np.pi * np.sqrt(above / np.where(below > 0, below, 1.0)), np.nan)
