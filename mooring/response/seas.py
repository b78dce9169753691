"""Headings of a sea with shares of its energy, and the energy outside the stored frequencies.

    ∫ D(θ) f(θ) dθ ≈ Σ_i w_i f(β_i),    w_i ∝ D(β_i − β₀),    β_i = i Δβ

On equal steps the error of the rule comes only from harmonics of D f beyond 2π/Δβ, since D f is periodic and |X|² has
few harmonics beyond 2kR.  The headings are equal steps of the full circle, the same for every sea. Seas of several
directions then share headings, and a force that is zero at 0° or 90° by symmetry changes its sign exactly at a heading.
"""

import warnings

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError

from .slow_drift import signed_means

MOST_OUTSIDE = 0.5  # largest share of the energy beyond the stored frequencies for which a response is meaningful
STEP = 10.0  # degrees between directions of a short-crested sea, halved until results converge
FINEST = STEP / 32
CLOSE = 1e-3  # relative convergence of every result
SMALL = 1e-4  # motions with less than this fraction of the energy of the largest of their kind are ignored
PLACES = 64  # number of frequencies at which steps are compared


def directions(sea, omega, step=STEP):
    """Headings (p,) rad, `step` degrees apart if short-crested, and shares of the energy (p,) or (q, p) at omega.

    sea : `environment.sea.Sea`, or `seas.systems.Systems`, whose shares follow the energy of each system
    """
    systems = _systems(sea)
    if len(systems) == 1:
        return _of_one(systems[0], omega, step)
    parts = [_of_one(system, omega, step) for system in systems]
    heading, place = np.unique(
        np.round(np.mod(np.concatenate([beta for beta, _ in parts]), 2 * np.pi), 9), return_inverse=True
    )
    total, first = np.zeros((len(omega), len(heading))), 0
    for system, (beta, weights) in zip(systems, parts, strict=True):
        density = system.spectrum.density(omega)[:, None]
        np.add.at(total, (slice(None), place[first : first + len(beta)]), density * _rows(weights, omega))
        first += len(beta)
    return heading, total / np.maximum(total.sum(axis=1, keepdims=True), 1e-300)


def is_long_crested(sea):
    """Whether no system of the sea has spreading"""
    return all(system.spreading is None for system in _systems(sea))


def _systems(sea):
    return getattr(sea, "systems", (sea,))


def _of_one(sea, omega, step):
    if sea.spreading is None:
        return np.array([sea.direction]), np.ones(1)
    heading = np.deg2rad(np.arange(0.0, 360.0, step))
    away = np.mod(heading - sea.direction + np.pi, 2 * np.pi) - np.pi
    column = np.asarray(omega)[:, None] if sea.spreading.depends_on_frequency else None
    weights = np.atleast_2d(sea.spreading.density(away, column))
    kept = weights.max(axis=0) > 1e-9 * weights.max()
    weights = weights[:, kept] / np.maximum(weights[:, kept].sum(axis=1, keepdims=True), 1e-300)
    return heading[kept], weights if sea.spreading.depends_on_frequency else weights[0]


def heading_step(body, sea, omega):
    """Step between directions, degrees, at which motions, mean drift, and the drift's positive and negative parts
    converge to 1e-3.

    body : `bem.database.reader.Reader`, or an object with its motions and computed drift.
    The step is halved until all these values, integrated over the spectrum, change by less than 1e-3. Warns if 0.3°
    is not enough.
    """
    if is_long_crested(sea):
        return STEP
    places = omega[np.unique(np.linspace(0, len(omega) - 1, PLACES).astype(int))]
    step, before = 2 * STEP, None
    while step > FINEST:
        step = 0.5 * step
        found = _integrals(body, sea, places, step)
        change = np.inf if before is None else _change(found, before) / 3  # a quarter of the previous error remains
        change = max(change, _lost(sea, places, step))
        if change <= CLOSE:
            return step
        before = found
    warnings.warn(
        f"results change by {100 * change:.3g} % from {2 * step:.2g}° to {step:.2g}° between directions; limit "
        f"{100 * CLOSE:g} %; the spreading is too narrow for this step; use a long-crested sea",
        stacklevel=2,
    )
    return step


def _lost(sea, omega, step):
    """Share of the energy missing in the sum over directions: spreading between two headings is not captured"""
    return max(_lost_of_one(system, omega, step) for system in _systems(sea))


def _lost_of_one(sea, omega, step):
    if sea.spreading is None:
        return 0.0
    away = np.deg2rad(np.arange(0.0, 360.0, step)) - sea.direction
    column = omega[:, None] if sea.spreading.depends_on_frequency else None
    away = np.mod(away + np.pi, 2 * np.pi) - np.pi
    total = np.atleast_2d(sea.spreading.density(away, column)).sum(axis=1) * np.deg2rad(step)
    density = sea.spectrum.density(omega) if len(total) > 1 else np.ones(1)
    return float(np.abs(total - 1) @ density / max(density.sum(), 1e-300)) if density.any() else 0.0


def _integrals(body, sea, omega, step):
    """Integrals ∫⟨|X|²⟩S dω, shape (n,), and ∫⟨D±⟩S dω, shape (2, 3)"""
    heading, weights = directions(sea, omega, step)
    density = sea.spectrum.density(omega)
    power = np.abs(body.motions(omega, heading)) ** 2
    rows = [np.trapezoid(np.einsum("qpc,qp->qc", power, _rows(weights, omega)) * density[:, None], omega, axis=0)]
    parts = np.zeros((len(omega), 2, 3))
    if body.knows_drift:
        parts = signed_means(body.drift(omega, heading), weights)
    return (*rows, np.trapezoid(parts * density[:, None, None], omega, axis=0))


def _change(found, before):
    """Largest relative change of the compared values; drift relative to both parts together"""
    (motion, drift), (motion_before, drift_before) = found, before
    kinds = motion.reshape(-1, 2, 3)
    kind = np.broadcast_to(kinds.max(axis=(0, 2))[:, None], kinds.shape).ravel()
    seen = motion > SMALL * kind
    change = np.abs(motion - motion_before)[seen] / motion[seen]
    total = drift.sum(axis=0)
    seen = total > SMALL * np.array([*2 * [total[:2].max()], total[2]])
    changes = np.abs(drift - drift_before)[:, seen] / total[seen]
    # σ is the root of the compared values of motions
    return max(0.5 * change.max(initial=0.0), changes.max(initial=0.0))


def _rows(weights, omega):
    return np.broadcast_to(weights, (len(omega), np.shape(weights)[-1]))


def energy_outside(omega, spectrum):
    """Shares of the wave energy below and above the stored frequencies (n,) rad/s."""
    total = spectrum.moment(0)
    return spectrum.moment(0, 0.0, omega[0]) / total, spectrum.moment(0, omega[-1], np.inf) / total


def outside(spectrum, omega, most):
    """Share of the energy outside the stored frequencies (n,) rad/s, and words on a band just wide enough for `most`

    An end beyond which less than half of `most` lies stays, and the other end takes the rest, less a hundredth.
    """
    below, above = (float(share) for share in energy_outside(omega, spectrum))
    first = min(below, max(0.99 * most - above, 0.495 * most))
    low, high = spectrum.quantile((first, 1 - (0.99 * most - first)))
    return below + above, f"{min(low, omega[0]):.3g} to {max(high, omega[-1]):.3g} rad/s"


def check_coverage(body, spectrum):
    """Raise BetweenError where most of the waves are beyond the stored frequencies."""
    missed = sum(energy_outside(body.omega, spectrum))
    if missed > MOST_OUTSIDE:
        low, high = 2 * np.pi / body.omega[-1], 2 * np.pi / body.omega[0]
        raise BetweenError(
            f"{100 * missed:.3g} % of the wave energy of {spectrum.name} waves of mean period {spectrum.T01:.4g} s is "
            f"outside the stored {low:.4g} to {high:.4g} s; allowed: {100 * MOST_OUTSIDE:g} %; add periods to the "
            "scene and solve again"
        )
